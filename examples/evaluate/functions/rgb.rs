//! Nothing can be asked for yet.

use super::Function;

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[];
