//! What several test programs share.

pub mod bad_scenes;
