//! Tristimulus values of reflectances by the practice of ASTM E308 \[E308\], for parity with instruments and programs.
//!
//! Reflectances are measured every 1, 5, 10 or 20 nm. The first two are summed as they are, over 360–780 nm. The others
//! are summed with weights that integrate the illuminant and the observer at 1 nm against a cubic interpolation of the
//! reflectance, computed as ASTM E2022 \[E2022\] says; at 20 nm the practice interpolates the reflectance to 10 nm first.

use super::{Observer, sums};
use crate::spectrum::resample::{Grid, trim};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// Range of the practice, nm.
const FROM_NM: f64 = 360.0;
const TO_NM: f64 = 780.0;
/// Reflectances of at least this many samples can be interpolated and extrapolated as the practice says.
const LEAST_SAMPLES: usize = 4;

/// Weights of samples every 10 or 20 nm for one illuminant and observer: the columns of a table of ASTM E308.
///
/// They sum to the white point, with Y = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    first_nm: f64,
    step_nm: f64,
    rows: Vec<DVec3>,
}

impl Weights {
    /// The weights of an illuminant and an observer for samples every `step_nm`.
    ///
    /// They are for 360–780 nm, or from where the observer's table begins.
    ///
    /// # Errors
    /// A step other than 10 and 20 nm; an illuminant without luminance.
    pub fn new(illuminant: &Spectrum, observer: &Observer, step_nm: f64) -> Result<Self> {
        if ![10.0, 20.0].contains(&step_nm) {
            return Err(Error::new(ErrorKind::OutOfRange, format!("a step of {step_nm} nm; expected 10 or 20 nm")));
        }
        let first_nm = range_of(observer).0;
        let step = step_nm as usize;
        let fine = (TO_NM - first_nm) as usize;
        let mut rows = vec![DVec3::ZERO; fine / step + 1];
        for i in 0..=fine {
            let lambda = first_nm + i as f64;
            let product = observer.eval(lambda) * illuminant.eval(lambda);
            let (row, coefficients) = lagrange(i, step, rows.len());
            for (k, coefficient) in coefficients.into_iter().enumerate().filter(|(_, c)| *c != 0.0) {
                rows[row + k] += product * coefficient;
            }
        }
        let y = rows.iter().sum::<DVec3>().y;
        if !(y > 0.0 && y.is_finite()) {
            let message = format!("luminance {y:e} of the illuminant; expected a positive one to normalise by");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        rows.iter_mut().for_each(|row| *row /= y);
        Ok(Self { first_nm, step_nm, rows })
    }

    /// Wavelengths in nm and the weights of X, Y, Z there.
    pub fn rows(&self) -> impl Iterator<Item = (f64, DVec3)> {
        self.rows.iter().enumerate().map(|(i, row)| (self.first_nm + i as f64 * self.step_nm, *row))
    }

    /// The white point: XYZ of the perfect diffuser.
    pub fn white(&self) -> DVec3 {
        self.rows.iter().sum()
    }

    /// XYZ of a reflectance sampled at wavelengths of the table.
    ///
    /// Samples outside the table's range are left out; weights outside the samples' range count for the nearest sample.
    ///
    /// # Errors
    /// Samples that are not at the table's step and on its wavelengths.
    pub fn xyz(&self, reflectance: &PiecewiseLinear) -> Result<DVec3> {
        let last_nm = self.first_nm + (self.rows.len() - 1) as f64 * self.step_nm;
        let inside = trim(reflectance, self.first_nm, last_nm)?;
        let step = grid_of(&inside).map(|grid| grid.step_nm());
        let offset = (inside.lambdas_nm()[0] - self.first_nm) / self.step_nm;
        if step.is_ok_and(|step| step != self.step_nm) || offset.fract() != 0.0 {
            let message = format!(
                "samples from {} nm; expected samples every {} nm on wavelengths of the table from {} nm",
                inside.lambdas_nm()[0],
                self.step_nm,
                self.first_nm
            );
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let values = inside.values();
        let nearest = |i: usize| values[i.saturating_sub(offset as usize).min(values.len() - 1)];
        Ok(self.rows.iter().enumerate().map(|(i, row)| *row * nearest(i)).sum())
    }
}

/// XYZ of a reflectance under an illuminant by the practice, Y = 1 for the perfect diffuser.
///
/// The illuminant is read at 1 nm by straight lines. Outside its samples the reflectance is held constant.
///
/// # Errors
/// Samples that are not every 1, 5, 10 or 20 nm at multiples of 1, 5, 10, 10 nm; less than 4 of those every 20 nm; none
/// within 360–780 nm; an illuminant without luminance.
pub fn xyz_of_reflectance(reflectance: &PiecewiseLinear, illuminant: &Spectrum, observer: &Observer) -> Result<DVec3> {
    let (from_nm, to_nm) = range_of(observer);
    let grid = grid_of(reflectance)?;
    let (first_nm, step_nm) = (grid.from_nm(), grid.step_nm());
    let unit = step_nm.min(10.0);
    if ![1.0, 5.0, 10.0, 20.0].contains(&step_nm) || first_nm % unit != 0.0 {
        let message = format!(
            "samples every {step_nm} nm from {first_nm} nm; expected every 1, 5, 10 or 20 nm at multiples of 1, 5, 10, 10 nm"
        );
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    if step_nm < 10.0 {
        let inside = Spectrum::PiecewiseLinear(trim(reflectance, from_nm, to_nm)?);
        let xyz = sums::xyz_of_reflectance(&inside, illuminant, observer, &Grid::new(from_nm, to_nm, step_nm)?);
        return if xyz.is_finite() { Ok(xyz) } else { Err(no_luminance()) };
    }
    let weights = Weights::new(illuminant, observer, 10.0)?;
    if step_nm == 20.0 { weights.xyz(&halved(&trim(reflectance, from_nm, to_nm)?)?) } else { weights.xyz(reflectance) }
}

/// First and last wavelength of the practice for an observer.
fn range_of(observer: &Observer) -> (f64, f64) {
    let (from_nm, to_nm) = observer.published_range_nm();
    (FROM_NM.max(from_nm), TO_NM.min(to_nm))
}

fn grid_of(samples: &PiecewiseLinear) -> Result<Grid> {
    Grid::of_samples(samples).ok_or_else(|| {
        let message = "samples at unequal distances, or one alone; expected several at equal distances";
        Error::new(ErrorKind::OutOfRange, message)
    })
}

fn no_luminance() -> Error {
    Error::new(ErrorKind::OutOfRange, "an illuminant without luminance; expected a positive one to normalise by")
}

/// The first of the samples that stand for the function `i` nm from the first one, and their coefficients.
///
/// Between the outer two samples at either end the quadratic through three, elsewhere the cubic through four; beyond the
/// last sample its value.
fn lagrange(i: usize, step: usize, count: usize) -> (usize, [f64; 4]) {
    let (cell, t) = (i / step, (i % step) as f64 / step as f64);
    let last = count - 1;
    if cell >= last {
        return (last, [1.0, 0.0, 0.0, 0.0]);
    }
    let [a, b, c] = [t + 1.0, t - 1.0, t - 2.0];
    if cell == 0 {
        (0, [0.5 * b * c, -t * c, 0.5 * t * b, 0.0])
    } else if cell == last - 1 {
        (cell - 1, [0.5 * t * b, -a * b, 0.5 * a * t, 0.0])
    } else {
        (cell - 1, [-t * b * c / 6.0, 0.5 * a * b * c, -0.5 * a * t * c, a * t * b / 6.0])
    }
}

/// Samples twice as dense: cubics at the middles, with a sample more at either end by a quadratic.
fn halved(samples: &PiecewiseLinear) -> Result<PiecewiseLinear> {
    let values = samples.values();
    let n = values.len();
    if n < LEAST_SAMPLES {
        let message = format!("{n} samples within the range; expected at least {LEAST_SAMPLES} to interpolate");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let outer = |a: f64, b: f64, c: f64| 3.0 * a - 3.0 * b + c;
    let before = outer(values[0], values[1], values[2]);
    let after = outer(values[n - 1], values[n - 2], values[n - 3]);
    let extended: Vec<f64> =
        std::iter::once(before).chain(values.iter().copied()).chain(std::iter::once(after)).collect();
    let middle = |four: &[f64]| (9.0 * (four[1] + four[2]) - (four[0] + four[3])) / 16.0;
    let mut dense = Vec::with_capacity(2 * n - 1);
    for (value, four) in values.iter().zip(extended.windows(4)) {
        dense.extend([*value, middle(four)]);
    }
    dense.push(values[n - 1]);
    let lambdas = samples.lambdas_nm();
    let half = 0.5 * (lambdas[n - 1] - lambdas[0]) / (n - 1) as f64;
    PiecewiseLinear::new((0..dense.len()).map(|i| lambdas[0] + i as f64 * half).collect(), dense)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{illuminant, xyz};
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn samples(from: f64, to: f64, step: f64, f: impl Fn(f64) -> f64) -> PiecewiseLinear {
        let lambdas = Grid::new(from, to, step).unwrap().lambdas_nm();
        let values = lambdas.iter().map(|&l| f(l)).collect();
        PiecewiseLinear::new(lambdas, values).unwrap()
    }

    #[test]
    fn weights_sum_to_the_white_of_the_sums_at_1_nm() {
        for observer in Observer::names().map(|name| Observer::by_name(name).unwrap()) {
            for lamp in ["A", "D65", "FL11", "HP1"].map(|name| illuminant::by_name(name).unwrap()) {
                let (from, to) = range_of(observer);
                let grid = Grid::new(from, to, 1.0).unwrap();
                let white = sums::xyz_of_reflectance(&Spectrum::Constant(1.0), &lamp, observer, &grid);
                for step in [10.0, 20.0] {
                    let weights = Weights::new(&lamp, observer, step).unwrap();
                    assert!((weights.white() - white).abs().max_element() < 1e-13);
                    assert_relative_eq!(weights.white().y, 1.0, max_relative = 1e-14);
                }
            }
        }
    }

    #[test]
    fn weights_are_near_the_products_at_their_wavelengths() {
        let (observer, lamp) = (Observer::cie_1931_2deg(), illuminant::relative_power("D65").unwrap());
        let weights = Weights::new(illuminant::d65(), observer, 10.0).unwrap();
        let product = |lambda: f64| observer.eval(lambda) * lamp.eval(lambda);
        let total: f64 = weights.rows().map(|(lambda, _)| product(lambda).y).sum();
        for (lambda, row) in weights.rows() {
            let plain = product(lambda) / total;
            assert!((row - plain).abs().max_element() < 5e-3, "{lambda}: {row} {plain}");
        }
    }

    #[test]
    fn smooth_reflectances_agree_with_the_exact_rule_at_every_step() {
        let observer = Observer::cie_1931_2deg();
        let lamp = illuminant::by_name("FL11").unwrap();
        let curve = |l: f64| 0.5 + 0.4 * crate::math::sin(l / 60.0);
        let exact =
            xyz::xyz_of_reflectance(&Spectrum::PiecewiseLinear(samples(360.0, 830.0, 1.0, curve)), &lamp, observer);
        for (step, within) in [(1.0, 3e-4), (5.0, 3e-3), (10.0, 3e-4), (20.0, 2e-3)] {
            let found = xyz_of_reflectance(&samples(360.0, 780.0, step, curve), &lamp, observer).unwrap();
            assert!((found - exact).abs().max_element() < within, "{step}: {found} {exact}");
        }
    }

    #[test]
    fn cubics_between_samples_every_20_nm() {
        let cubic = |l: f64| {
            let x = (l - 560.0) / 200.0;
            x * x * x + 1.0
        };
        let dense = halved(&samples(400.0, 700.0, 20.0, cubic)).unwrap();
        assert_eq!(dense.lambdas_nm().len(), 31);
        for (lambda, value) in dense.knots().filter(|(l, _)| (420.0..=680.0).contains(l)) {
            assert!((value - cubic(lambda)).abs() < 1e-14, "{lambda}: {value}");
        }
    }

    #[test]
    fn says_what_is_wrong() {
        let observer = Observer::cie_1931_2deg();
        let lamp = illuminant::d65();
        for (from, to, step) in [(400.0, 700.0, 2.0), (405.0, 705.0, 10.0), (400.0, 440.0, 20.0), (300.0, 350.0, 10.0)]
        {
            let error = xyz_of_reflectance(&samples(from, to, step, |_| 0.5), lamp, observer).unwrap_err();
            assert_eq!(error.kind, ErrorKind::OutOfRange, "{error}");
        }
        let grey = samples(400.0, 700.0, 5.0, |_| 0.5);
        let dark = Spectrum::Constant(0.0);
        assert!(xyz_of_reflectance(&grey, &dark, observer).is_err());
        assert!(Weights::new(&dark, observer, 10.0).is_err() && Weights::new(lamp, observer, 5.0).is_err());
        // Samples at 400, 420, … do not lie on a table that begins at 390 nm with steps of 20 nm.
        let weights = Weights::new(lamp, Observer::by_name("2015-2").unwrap(), 20.0).unwrap();
        assert!(weights.xyz(&samples(400.0, 700.0, 20.0, |_| 0.5)).is_err());
    }

    proptest! {
        #[test]
        fn one_value_gives_the_white_times_it(value in 0.0..1.0_f64, first in 0_u32..8, last in 0_u32..8) {
            let observer = Observer::cie_1931_2deg();
            let (from, to) = (360.0 + 20.0 * f64::from(first), 780.0 - 20.0 * f64::from(last));
            let white = Weights::new(illuminant::d65(), observer, 10.0).unwrap().white();
            for step in [10.0, 20.0] {
                let found = xyz_of_reflectance(&samples(from, to, step, |_| value), illuminant::d65(), observer).unwrap();
                prop_assert!((found - white * value).abs().max_element() < 1e-14);
            }
        }
    }
}
