//! The CIE colour rendering index.

use super::reference;
use super::sampling::{Lamp, reflectances, sample};
use crate::color::space::uv_1960_from_xyz;
use crate::color::{Observer, temperature};
use crate::spectrum::Spectrum;
use crate::spectrum::resample::{Extrapolation, Interpolation};
use crate::{Result, math};
use glam::DVec3;
use std::sync::LazyLock;

/// Test colour samples 1 to 15 on the grid of [`reference::wide_grid`].
static SAMPLES: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| {
    let text = include_str!("../../../data/quality/cri.csv");
    reflectances(text, &reference::wide_grid()).expect("data/quality/cri.csv holds reflectances every 5 nm")
});

/// Colour rendering of a light \[CIE13.3\]: 100 where colours look as under the reference, less where they do not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cri {
    /// Ra: mean of R1 to R8.
    pub ra: f64,
    /// R1 to R14: special indices. Strong shifts make them negative.
    pub r: [f64; 14],
    /// R15: Japanese skin, which later editions add.
    pub r15: f64,
    /// Correlated colour temperature, K (c₂ = 1.4388·10⁻² m·K); that of the reference.
    pub kelvin: f64,
}

/// The CIE colour rendering index of a light \[CIE13.3\].
///
/// The reference is a blackbody below 5000 K and daylight from there on, of the light's correlated colour temperature by
/// Robertson's method \[Robertson1968\], as is customary; below 1667 K, where that ends, by definition. Robertson's method is
/// up to 1 K off; for the temperature by definition see [`cri_against`].
///
/// # Errors
/// A light without luminance, or whose colour temperature has no reference: above 25 000 K.
pub fn cri(light: &Spectrum) -> Result<Cri> {
    let lamp = lamp(light)?;
    index(&lamp, customary_kelvin(uv_1960_from_xyz(lamp.white))?)
}

/// The index against the reference of a stated colour temperature in K, on the scale of 1990
/// ([`temperature::its_90_from_si`]).
///
/// # Errors
/// A light without luminance; a temperature that is not positive, or above 25 000 K.
pub fn cri_against(light: &Spectrum, kelvin: f64) -> Result<Cri> {
    index(&lamp(light)?, kelvin)
}

fn customary_kelvin(uv: [f64; 2]) -> Result<f64> {
    let by_definition = |_| temperature::correlated(uv).map(|found| temperature::its_90_from_si(found.kelvin));
    temperature::robertson::correlated(uv).map(|found| found.kelvin).or_else(by_definition)
}

fn lamp(light: &Spectrum) -> Result<Lamp> {
    let grid = reference::wide_grid();
    let values = sample(light, &grid, Interpolation::Sprague, Extrapolation::Constant)?;
    Lamp::new(&values, &grid, Observer::cie_1931_2deg())
}

fn index(lamp: &Lamp, kelvin: f64) -> Result<Cri> {
    let grid = reference::wide_grid();
    let values = reference::wide_reference(kelvin, &grid)?;
    let reference = Lamp::new(&values, &grid, Observer::cie_1931_2deg())?;
    let colors = |lamp: &Lamp| SAMPLES.iter().map(|sample| lamp.xyz_of(sample)).collect::<Vec<_>>();
    let special = special_indices(lamp.white, &colors(lamp), reference.white, &colors(&reference));
    let mut r = [0.0; 14];
    r.copy_from_slice(&special[..14]);
    Ok(Cri { ra: r[..8].iter().sum::<f64>() / 8.0, r, r15: special[14], kelvin })
}

/// 100 − 4.6 ΔE for the colours of samples under a light and its reference, all with Y = 1 for the white.
fn special_indices(white: DVec3, colors: &[DVec3], reference_white: DVec3, reference_colors: &[DVec3]) -> Vec<f64> {
    let index = |(color, reference): (&DVec3, &DVec3)| {
        let seen = uvw(color.y, adapted(uv_1960_from_xyz(*color), white, reference_white), reference_white);
        let expected = uvw(reference.y, uv_1960_from_xyz(*reference), reference_white);
        100.0 - 4.6 * (seen - expected).length()
    };
    colors.iter().zip(reference_colors).map(index).collect()
}

/// U*, V*, W* of a luminance factor and a chromaticity.
fn uvw(y: f64, uv: [f64; 2], white: DVec3) -> DVec3 {
    let [white_u, white_v] = uv_1960_from_xyz(white);
    let w = 25.0 * math::cbrt(100.0 * y) - 17.0;
    DVec3::new(13.0 * w * (uv[0] - white_u), 13.0 * w * (uv[1] - white_v), w)
}

/// The chromaticity seen under the reference that looks as `uv` does under the light: von Kries' rule in u, v.
fn adapted(uv: [f64; 2], white: DVec3, reference_white: DVec3) -> [f64; 2] {
    let responses = |[u, v]: [f64; 2]| [(4.0 - u - 10.0 * v) / v, (1.708 * v + 0.404 - 1.481 * u) / v];
    let of_white = |white| responses(uv_1960_from_xyz(white));
    let ([c, d], [c_t, d_t], [c_r, d_r]) = (responses(uv), of_white(white), of_white(reference_white));
    let (c, d) = (c * c_r / c_t, d * d_r / d_t);
    let denominator = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / denominator, 5.520 / denominator]
}
