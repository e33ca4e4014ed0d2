//! Names that options take.

use super::usage;
use crate::Result;
use crate::develop::Tonemap;
use crate::scene::Integrator;

/// The integrators by name.
pub const INTEGRATORS: [(&str, Integrator); 5] = [
    ("auto", Integrator::Auto),
    ("path", Integrator::Path),
    ("light", Integrator::Light),
    ("merge", Integrator::Merge),
    ("hero", Integrator::Hero),
];

/// The tone mapping operators by name.
pub const TONEMAPS: [(&str, Tonemap); 3] =
    [("srgb", Tonemap::Srgb), ("exponential", Tonemap::Exponential), ("reinhard", Tonemap::Reinhard)];

/// The name of an integrator.
pub fn integrator_name(integrator: Integrator) -> &'static str {
    INTEGRATORS.iter().find(|(_, known)| *known == integrator).map_or("unknown", |(name, _)| name)
}

/// The value of this name in a list; `option` is what errors name.
pub fn named<T: Copy>(option: &str, name: &str, known: &[(&str, T)]) -> Result<T> {
    let names = known.iter().map(|(n, _)| *n);
    known
        .iter()
        .find(|(n, _)| *n == name)
        .map(|(_, value)| *value)
        .ok_or_else(|| usage(format!("{option} {name}: expected one of {}", listed(known))).nearest(name, names))
}

/// The names of a list, for help and errors.
pub fn listed<T>(known: &[(&str, T)]) -> String {
    known.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}
