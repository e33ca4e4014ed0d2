//! Names that options take.

use super::usage;
use crate::Result;
use crate::scene::Integrator;

pub use crate::scene::description::{INTEGRATORS, TONEMAPS};

/// The name of an integrator.
pub fn integrator_name(integrator: Integrator) -> &'static str {
    INTEGRATORS.iter().find(|(_, known, _)| *known == integrator).map_or("unknown", |(name, ..)| name)
}

/// The value of this name in a list; `option` is what errors name.
pub fn named<T: Copy>(option: &str, name: &str, known: &[(&str, T, &str)]) -> Result<T> {
    let names = known.iter().map(|(n, ..)| *n);
    known
        .iter()
        .find(|(n, ..)| *n == name)
        .map(|(_, value, _)| *value)
        .ok_or_else(|| usage(format!("{option} {name}: expected one of {}", listed(known))).nearest(name, names))
}

/// The names of a list, for help and errors.
pub fn listed<T>(known: &[(&str, T, &str)]) -> String {
    known.iter().map(|(name, ..)| *name).collect::<Vec<_>>().join(", ")
}
