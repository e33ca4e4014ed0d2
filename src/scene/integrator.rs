//! Light transport techniques.

/// Light transport techniques that there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// Camera paths, and light paths for the caustics of lights that camera paths hardly find.
    Auto,
    /// Camera paths alone.
    Path,
    /// Light paths alone, of all kinds, each with one wavelength past a dispersive refraction.
    Light,
    /// As `Auto`, with photon merging for every light that light paths can start from.
    Merge,
    /// The baseline: camera paths with four wavelengths, of which a dispersive surface leaves one.
    Hero,
}
