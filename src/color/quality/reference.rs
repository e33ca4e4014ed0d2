//! The lights that others are compared with.

use crate::color::thermal::RadiationConstants;
use crate::color::{Observer, daylight};
use crate::spectrum::resample::{Extrapolation, Grid, Interpolation, align};
use crate::{Error, ErrorKind, Result};

/// Temperature at which the reference of the older indices turns from a blackbody to daylight, K.
const DAYLIGHT_FROM_KELVIN: f64 = 5000.0;
/// Temperature at which the reference of CIE 224 begins to turn; it has turned at [`DAYLIGHT_FROM_KELVIN`].
const MIXED_FROM_KELVIN: f64 = 4000.0;
/// Highest temperature for which the CIE defines daylight, K.
const DAYLIGHT_TO_KELVIN: f64 = 25_000.0;

/// 360–780 nm at 1 nm.
pub(super) fn wide_grid() -> Grid {
    Grid::new(360.0, 780.0, 1.0).expect("420 steps of 1 nm")
}

/// 380–780 nm at a step of 1 or 5 nm.
pub(super) fn narrow_grid(step_nm: f64) -> Grid {
    Grid::new(380.0, 780.0, step_nm).expect("a whole number of steps of 1 or 5 nm")
}

fn check(kelvin: f64) -> Result<()> {
    if kelvin > 0.0 && kelvin <= DAYLIGHT_TO_KELVIN {
        return Ok(());
    }
    let message =
        format!("no reference for a colour temperature of {kelvin} K; expected one up to {DAYLIGHT_TO_KELVIN} K");
    Err(Error::new(ErrorKind::OutOfRange, message))
}

fn planckian(kelvin: f64, grid: &Grid) -> Vec<f64> {
    grid.lambdas_nm().into_iter().map(|lambda| RadiationConstants::ITS_90.planck_radiance(lambda, kelvin)).collect()
}

fn daylight(kelvin: f64, grid: &Grid, interpolation: Interpolation) -> Result<Vec<f64>> {
    let table = daylight::of_kelvin(kelvin, daylight::Factors::Rounded)?;
    Ok(align(&table, grid, interpolation, Extrapolation::Constant)?.values().to_vec())
}

/// The reference of the colour rendering index and of the colour quality scale: a blackbody below 5000 K, daylight above,
/// joined by straight lines as CIE 15 prescribes.
///
/// # Errors
/// A temperature that is not in (0, 25 000] K.
pub(super) fn wide_reference(kelvin: f64, grid: &Grid) -> Result<Vec<f64>> {
    check(kelvin)?;
    if kelvin < DAYLIGHT_FROM_KELVIN {
        Ok(planckian(kelvin, grid))
    } else {
        daylight(kelvin, grid, Interpolation::Linear)
    }
}

/// The reference of CIE 224: a blackbody up to 4000 K, daylight from 5000 K, and between them a mixture of both at equal
/// luminance whose share of daylight grows linearly. Daylight is interpolated by Sprague's polynomials at 1 nm.
///
/// # Errors
/// A temperature that is not in (0, 25 000] K.
pub(super) fn narrow_reference(kelvin: f64, grid: &Grid) -> Result<Vec<f64>> {
    check(kelvin)?;
    if kelvin < MIXED_FROM_KELVIN {
        return Ok(planckian(kelvin, grid));
    }
    let daylight = daylight(kelvin, grid, Interpolation::Sprague)?;
    if kelvin > DAYLIGHT_FROM_KELVIN {
        return Ok(daylight);
    }
    let planckian = planckian(kelvin, grid);
    let share = (kelvin - MIXED_FROM_KELVIN) / (DAYLIGHT_FROM_KELVIN - MIXED_FROM_KELVIN);
    let (of_planckian, of_daylight) = ((1.0 - share) / luminance(&planckian, grid), share / luminance(&daylight, grid));
    Ok(planckian.iter().zip(&daylight).map(|(p, d)| of_planckian * p + of_daylight * d).collect())
}

/// Σ S ȳ of the CIE 1931 observer.
fn luminance(values: &[f64], grid: &Grid) -> f64 {
    let observer = Observer::cie_1931_2deg();
    grid.lambdas_nm().into_iter().zip(values).map(|(lambda, value)| observer.eval(lambda).y * value).sum()
}
