//! Spectra are three types: a *function* of wavelength ([`Spectrum`], or compiled for speed, [`SpectrumTable`]); the
//! *values* of such a function at a path's wavelengths ([`SampledSpectrum`]); and the *wavelengths* with their
//! densities ([`Wavelengths`]), passed beside the values. Knows nothing of colour or rendering.

mod function;
mod piecewise_linear;
pub mod resample;
mod sampled;
mod table;
mod wavelengths;

pub(crate) use function::{BOLTZMANN, FWHM_PER_SIGMA, LIGHT_SPEED, PLANCK};
pub use function::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum, planck_radiance};
#[cfg(feature = "render")]
pub(crate) use piecewise_linear::check_knot;
pub use piecewise_linear::{MAX_TABULATED_VALUE, PiecewiseLinear};
pub use sampled::{LANES, SampledSpectrum};
pub use table::SpectrumTable;
pub use wavelengths::{WavelengthDensity, Wavelengths};
