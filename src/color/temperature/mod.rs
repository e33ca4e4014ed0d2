//! Correlated colour temperature: the Planckian radiator whose chromaticity is nearest, and how far away it is.
//!
//! [`correlated`] follows the definition to rounding. The published approximations are there by name to compare with.

mod approximation;
mod locus;
pub mod ohno;
pub mod robertson;

pub use approximation::Approximation;
pub use locus::PlanckianLocus;

use super::thermal::RadiationConstants;
use crate::Result;
use glam::DVec3;

/// A colour temperature and the distance from the Planckian locus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correlated {
    /// Temperature of the nearest Planckian radiator, K; from [`correlated`] by the exact constants of the SI \[SI2019\].
    pub kelvin: f64,
    /// Distance from it in CIE 1960 u, v; positive above the locus, towards green \[Ohno2014\].
    pub duv: f64,
}

/// A temperature in K on the scale of 1990 (c₂ = 1.4388·10⁻² m·K), in which the CIE states colour temperatures, from one by
/// the exact constants of the SI: larger by a factor of 1.000016.
pub fn its_90_from_si(kelvin: f64) -> f64 {
    kelvin * (RadiationConstants::ITS_90.c2 / RadiationConstants::SI_2019.c2)
}

/// Correlated colour temperature of CIE 1960 u, v for the CIE 1931 observer, by the definition
/// ([`PlanckianLocus::correlated`]).
///
/// ```
/// use abbe::color::{temperature, xyz_from_xy};
/// let d65 = temperature::correlated(temperature::uv_from_xyz(xyz_from_xy([0.31271, 0.32902])))?;
/// assert!((temperature::its_90_from_si(d65.kelvin) - 6504.0).abs() < 2.0 && (d65.duv - 0.0032).abs() < 1e-4);
/// # Ok::<(), abbe::Error>(())
/// ```
///
/// # Errors
/// As [`PlanckianLocus::correlated`].
pub fn correlated(uv: [f64; 2]) -> Result<Correlated> {
    PlanckianLocus::cie_1931_2deg().correlated(uv)
}

/// CIE 1960 u, v of a temperature in K and a distance from the locus: the inverse of [`correlated`].
///
/// # Errors
/// As [`PlanckianLocus::uv_at`].
pub fn uv_at(kelvin: f64, duv: f64) -> Result<[f64; 2]> {
    PlanckianLocus::cie_1931_2deg().uv_at(kelvin, duv)
}

/// CIE 1960 u, v of XYZ; NaN for black.
pub fn uv_from_xyz(xyz: DVec3) -> [f64; 2] {
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    [4.0 * xyz.x / sum, 6.0 * xyz.y / sum]
}

/// CIE 1960 u, v of a chromaticity x, y.
pub fn uv_from_xy([x, y]: [f64; 2]) -> [f64; 2] {
    let sum = 12.0 * y - 2.0 * x + 3.0;
    [4.0 * x / sum, 6.0 * y / sum]
}

/// Chromaticity x, y of CIE 1960 u, v.
pub fn xy_from_uv([u, v]: [f64; 2]) -> [f64; 2] {
    let sum = 2.0 * u - 8.0 * v + 4.0;
    [3.0 * u / sum, 2.0 * v / sum]
}
