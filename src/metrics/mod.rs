//! How far a picture is from a reference: relative errors, what an observer would see, and whether there is a bias.
//!
//! Everything is computed over a [`Pair`] of pictures of the same size; pixels that a mask leaves out, or that are NaN or
//! infinite in either picture, do not count (and are counted, see [`Pair::non_finite`]).
//!
//! | metric | of | function |
//! |---|---|---|
//! | relMSE, also without the worst 0.1 % | linear values | [`relative_mse`], [`trimmed_relative_mse`] |
//! | MAPE, SMAPE | linear values | [`mape`], [`smape`] |
//! | bias with its confidence interval | linear values | [`bias`] |
//! | PSNR, ΔE 2000, FLIP | pictures on a display | [`psnr`], [`color_difference`], [`flip`] |

mod bias;
mod difference;
mod display;
mod flip;
mod pair;
mod percentage;
mod psnr;
mod relmse;
pub mod stats;

pub use bias::{Bias, bias};
pub use difference::{ColorDifference, color_difference, color_difference_map};
pub use display::Displayed;
pub use flip::{FLIP_PIXELS_PER_DEGREE, flip, flip_map};
pub use pair::Pair;
pub use percentage::{mape, smape};
pub use psnr::psnr;
pub use relmse::{relative_error_map, relative_mse, trimmed_relative_mse};
