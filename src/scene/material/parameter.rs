//! What a material's quantity is at a point, and the indices that it is made of.

/// Index into [`Scene::spectra`](crate::scene::Scene::spectra).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SpectrumId(pub u32);

/// Index into [`Scene::media`](crate::scene::Scene::media).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MediumId(pub u32);

/// A spectral quantity of a material, such as its reflectance. What varies over a surface becomes a variant here, evaluated
/// by the coordinates that [`Scene::uv`](crate::scene::Scene::uv) gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// The same spectrum everywhere.
    Spectrum(SpectrumId),
}
