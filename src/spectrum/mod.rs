//! Functions of wavelength. Knows nothing of colour or rendering.

mod function;
mod piecewise_linear;

pub use function::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum, planck_radiance};
pub(crate) use piecewise_linear::check_knot;
pub use piecewise_linear::{MAX_TABULATED_VALUE, PiecewiseLinear};
