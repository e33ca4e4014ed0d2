//! Spectra are three types: a *function* of wavelength ([`Spectrum`], or compiled for speed, [`SpectrumTable`]); the
//! *values* of such a function at a path's wavelengths ([`SampledSpectrum`]); and the *wavelengths* with their
//! densities ([`Wavelengths`]), passed beside the values.

mod sampled;
mod table;
mod wavelengths;

pub use sampled::{LANES, SampledSpectrum};
pub use table::SpectrumTable;
pub use wavelengths::{WavelengthDensity, Wavelengths};
