//! What a material's quantity is at a point.

use crate::scene::SpectrumId;

/// A spectral quantity of a material, such as its reflectance. What varies over a surface becomes a variant here, evaluated
/// by the coordinates that [`Scene::uv`](crate::scene::Scene::uv) gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// The same spectrum everywhere.
    Spectrum(SpectrumId),
}
