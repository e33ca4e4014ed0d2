//! Scenes: description (the file's words) → compile → [`Scene`] (what the renderer sees).

pub mod description;
