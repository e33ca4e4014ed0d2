//! The closed set of functions of wavelength that a scene can contain.

use super::PiecewiseLinear;
use crate::{Error, ErrorKind, Result, math};
use std::f64::consts::PI;

/// Shortest wavelength of the rendering range, nm.
pub const LAMBDA_MIN_NM: f64 = 360.0;
/// Longest wavelength of the rendering range, nm.
pub const LAMBDA_MAX_NM: f64 = 830.0;

/// Planck constant, J·s (exact, \[SI2019\]).
pub(crate) const PLANCK: f64 = 6.626_070_15e-34;
/// Speed of light, m/s (exact, \[SI2019\]).
pub(crate) const LIGHT_SPEED: f64 = 299_792_458.0;
/// Boltzmann constant, J/K (exact, \[SI2019\]).
pub(crate) const BOLTZMANN: f64 = 1.380_649e-23;
/// First radiation constant for radiance 2hc², W·m²·sr⁻¹.
const C1_RADIANCE: f64 = 2.0 * PLANCK * LIGHT_SPEED * LIGHT_SPEED;
/// Second radiation constant hc/k, m·K.
const C2: f64 = PLANCK * LIGHT_SPEED / BOLTZMANN;
/// Wavelength of the largest radiance times temperature (Wien), nm·K.
const WIEN_NM_KELVIN: f64 = 2.897_771_955e6;

/// Full width at half maximum of a Gaussian over its standard deviation: 2 √(2 ln 2).
pub(crate) const FWHM_PER_SIGMA: f64 = 2.354_820_045_030_949_3;
/// Narrowest line: below it, f64 wavelengths near 500 nm are too coarse to tabulate a Gaussian.
const FWHM_MIN_NM: f64 = 1e-6;
/// A tabulated line ends this many standard deviations from its centre, where 3e-12 of its area is left outside.
const LINE_REACH_SIGMAS: f64 = 7.0;
/// Knots per standard deviation of a tabulated line: chords then miss the curve by 1 / (8 · 40²) of its peak.
const LINE_KNOTS_PER_SIGMA: f64 = 40.0;
/// Widest step of a tabulated line, nm: with it the XYZ of a wide line are right to 1e-5.
const LINE_STEP_MAX_NM: f64 = 0.2;
/// Largest error of a chord of a blackbody, relative to its radiance there.
const BLACKBODY_CHORD_ERROR: f64 = 1e-5;

/// A function of wavelength.
///
/// Its unit is that of what it describes: a reflectance is dimensionless, an emission W·m⁻²·sr⁻¹·nm⁻¹.
#[derive(Debug, Clone, PartialEq)]
pub enum Spectrum {
    /// A value that is the same at every wavelength.
    Constant(f64),
    /// A table.
    PiecewiseLinear(PiecewiseLinear),
    /// Planck's law, W·m⁻²·sr⁻¹·nm⁻¹, times a factor.
    Blackbody {
        /// Temperature, K.
        kelvin: f64,
        /// Dimensionless factor.
        factor: f64,
    },
    /// A Gaussian whose integral over wavelength is `factor`.
    Line {
        /// Centre, nm.
        center_nm: f64,
        /// Full width at half maximum, nm.
        fwhm_nm: f64,
        /// Area.
        factor: f64,
    },
}

impl Spectrum {
    /// Planck's law at a temperature in K.
    ///
    /// # Errors
    /// A temperature that is not positive and finite.
    pub fn blackbody(kelvin: f64) -> Result<Self> {
        check_positive(kelvin, 0.0, "temperature", "K")?;
        Ok(Self::Blackbody { kelvin, factor: 1.0 })
    }

    /// A Gaussian line of unit area: its centre and full width at half maximum, nm.
    ///
    /// # Errors
    /// A centre that is not positive and finite; a width under 1e-6 nm or not finite.
    pub fn line(center_nm: f64, fwhm_nm: f64) -> Result<Self> {
        check_positive(center_nm, 0.0, "line centre", "nm")?;
        check_positive(fwhm_nm, FWHM_MIN_NM, "line width", "nm")?;
        Ok(Self::Line { center_nm, fwhm_nm, factor: 1.0 })
    }

    /// The value at a positive wavelength in nm.
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::PiecewiseLinear(table) => table.eval(lambda_nm),
            Self::Blackbody { kelvin, factor } => factor * planck_radiance(lambda_nm, *kelvin),
            Self::Line { center_nm, fwhm_nm, factor } => factor * gaussian(lambda_nm - center_nm, *fwhm_nm),
        }
    }

    /// The function times a number.
    pub fn scaled(self, scale: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(value * scale),
            Self::PiecewiseLinear(table) => Self::PiecewiseLinear(table.scaled(scale)),
            Self::Blackbody { kelvin, factor } => Self::Blackbody { kelvin, factor: factor * scale },
            Self::Line { center_nm, fwhm_nm, factor } => Self::Line { center_nm, fwhm_nm, factor: factor * scale },
        }
    }

    /// The value, if it is the same at every wavelength: a constant, or a table of equal values.
    pub fn is_constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::PiecewiseLinear(table) => (table.min() == table.max()).then(|| table.min()),
            Self::Blackbody { .. } | Self::Line { .. } => None,
        }
    }

    /// Smallest and largest value over the rendering range 360–830 nm.
    pub fn range(&self) -> (f64, f64) {
        match self {
            Self::Constant(value) => (*value, *value),
            Self::PiecewiseLinear(table) => {
                let visible = table.restricted(LAMBDA_MIN_NM, LAMBDA_MAX_NM);
                (visible.min(), visible.max())
            }
            // One maximum and no other extremum: with the ends of the range it gives the bounds.
            Self::Blackbody { kelvin, .. } => self.range_of_single_peak(WIEN_NM_KELVIN / kelvin),
            Self::Line { center_nm, .. } => self.range_of_single_peak(*center_nm),
        }
    }

    fn range_of_single_peak(&self, peak_nm: f64) -> (f64, f64) {
        let inside = peak_nm.clamp(LAMBDA_MIN_NM, LAMBDA_MAX_NM);
        let values = [LAMBDA_MIN_NM, inside, LAMBDA_MAX_NM].map(|lambda| self.eval(lambda));
        (values.into_iter().fold(f64::INFINITY, f64::min), values.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }

    /// Knots over 360–830 nm between which straight lines are the function within 1e-4 of its peak.
    ///
    /// A table keeps its own knots, so that it is reproduced exactly. A blackbody gets 1 nm, and finer where it is cold and
    /// steep. A line gets 40 knots per standard deviation, which keeps the area of a whole line to 1e-10, and at least
    /// five per nm. Integrals against the CIE observers are then right to 1e-5.
    pub fn tabulate(&self) -> PiecewiseLinear {
        match self {
            Self::Constant(value) => {
                PiecewiseLinear::from_valid_knots(vec![LAMBDA_MIN_NM, LAMBDA_MAX_NM], vec![*value; 2])
            }
            Self::PiecewiseLinear(table) => table.restricted(LAMBDA_MIN_NM, LAMBDA_MAX_NM),
            Self::Blackbody { kelvin, .. } => self.tabulate_at(blackbody_knots(*kelvin)),
            Self::Line { center_nm, fwhm_nm, .. } => self.tabulate_line(*center_nm, fwhm_nm / FWHM_PER_SIGMA),
        }
    }

    fn tabulate_at(&self, lambda_nm: Vec<f64>) -> PiecewiseLinear {
        let values = lambda_nm.iter().map(|&lambda| self.eval(lambda)).collect();
        PiecewiseLinear::from_valid_knots(lambda_nm, values)
    }

    /// A line is 0 from its reach on: a chord from its last value to the end of the range would add area.
    fn tabulate_line(&self, center_nm: f64, sigma_nm: f64) -> PiecewiseLinear {
        let reach_nm = LINE_REACH_SIGMAS * sigma_nm;
        let step_nm = (sigma_nm / LINE_KNOTS_PER_SIGMA).min(LINE_STEP_MAX_NM);
        let steps = (2.0 * reach_nm / step_nm).ceil();
        let from = center_nm - reach_nm;
        let knots = (0..=steps as usize).map(|i| from + 2.0 * reach_nm * (i as f64 / steps));
        let lambda_nm = within_range(knots);
        let inside_nm = reach_nm - 0.5 * step_nm;
        let value = |&lambda: &f64| if (lambda - center_nm).abs() < inside_nm { self.eval(lambda) } else { 0.0 };
        let values = lambda_nm.iter().map(value).collect();
        PiecewiseLinear::from_valid_knots(lambda_nm, values)
    }
}

/// Spectral radiance of a blackbody in vacuum, W·m⁻²·sr⁻¹·nm⁻¹ \[Planck1901\], with the exact SI constants.
///
/// Positive wavelength in nm, positive temperature in K; 0 where the radiance is below the smallest f64.
pub fn planck_radiance(lambda_nm: f64, kelvin: f64) -> f64 {
    let lambda = lambda_nm * 1e-9;
    let lambda_2 = lambda * lambda;
    // 2 h c² / λ⁵ / (exp(h c / λ k T) − 1), per metre; 1e-9 makes it per nm.
    1e-9 * C1_RADIANCE / (lambda_2 * lambda_2 * lambda * math::exp_m1(C2 / (lambda * kelvin)))
}

/// Gaussian of unit area, 1/nm, at a distance in nm from its centre.
fn gaussian(distance_nm: f64, fwhm_nm: f64) -> f64 {
    let sigma_nm = fwhm_nm / FWHM_PER_SIGMA;
    let x = distance_nm / sigma_nm;
    math::exp(-0.5 * x * x) / (sigma_nm * (2.0 * PI).sqrt())
}

/// 1 nm cells of the rendering range, subdivided where the radiance of a cold body rises steeply.
fn blackbody_knots(kelvin: f64) -> Vec<f64> {
    let mut knots = Vec::new();
    for cell in 0..(LAMBDA_MAX_NM - LAMBDA_MIN_NM) as usize {
        let lambda = LAMBDA_MIN_NM + cell as f64;
        // With x = hc/λkT and u = x / (1 − e⁻ˣ) − 5: L' / L = u / λ and |L''| / L < (|u² − u| + x) / λ².
        // A chord of length h misses by h² L'' / 8. Beyond x = 745 the radiance is 0 in f64 anyway.
        let x = (C2 / (lambda * 1e-9 * kelvin)).min(745.0);
        let u = -x / math::exp_m1(-x) - 5.0;
        let curvature = ((u * u - u).abs() + x) / (lambda * lambda);
        let parts = (curvature / (8.0 * BLACKBODY_CHORD_ERROR)).sqrt().ceil().max(1.0);
        // A power of two keeps the knots on a grid that `SpectrumTable` finds its way in without a search.
        let parts = (parts as usize).next_power_of_two();
        knots.extend((0..parts).map(|part| lambda + part as f64 / parts as f64));
    }
    knots.push(LAMBDA_MAX_NM);
    knots
}

/// The strictly ascending ones of ascending knots that lie inside the rendering range, and its ends.
fn within_range(knots: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut inside = vec![LAMBDA_MIN_NM];
    for knot in knots {
        if inside[inside.len() - 1] < knot && knot < LAMBDA_MAX_NM {
            inside.push(knot);
        }
    }
    inside.push(LAMBDA_MAX_NM);
    inside
}

fn check_positive(value: f64, least: f64, what: &str, unit: &str) -> Result<()> {
    if !value.is_finite() {
        let message = format!("{what} {value} {unit}; expected a finite number");
        return Err(Error::new(ErrorKind::NotFinite, message));
    }
    if value <= 0.0 || value < least {
        let expected = if least > 0.0 { format!("at least {least:e} {unit}") } else { "a positive number".to_owned() };
        return Err(Error::new(ErrorKind::OutOfRange, format!("{what} {value} {unit}; expected {expected}")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Largest distance between a function and its table, relative to the table's peak.
    fn chord_error(spectrum: &Spectrum) -> f64 {
        let table = spectrum.tabulate();
        let between = |pair: &[f64]| {
            let middle = 0.5 * (pair[0] + pair[1]);
            (spectrum.eval(middle) - table.eval(middle)).abs()
        };
        table.lambdas_nm().windows(2).map(between).fold(0.0, f64::max) / table.max()
    }

    #[test]
    fn planck_integrates_to_stefan_boltzmann() {
        // ∫ L dλ = σ T⁴ / π, with σ = 5.670374419e-8; x = ln λ turns the integral smooth and its ends negligible.
        let (kelvin, step) = (5600.0, 1e-3);
        let radiance_sum: f64 = (0..14_000)
            .map(|i| math::exp(f64::from(i) * step + math::ln(50.0)))
            .map(|lambda| planck_radiance(lambda, kelvin) * lambda * step)
            .sum();
        let expected = 5.670_374_419e-8 * kelvin * kelvin * kelvin * kelvin / PI;
        assert_relative_eq!(radiance_sum, expected, max_relative = 1e-7);
    }

    #[test]
    fn planck_is_stable_at_both_ends() {
        assert_eq!(planck_radiance(400.0, 10.0), 0.0);
        // Rayleigh–Jeans: 2 c k T / λ⁴ for x → 0, relative error x / 2.
        let (lambda, kelvin) = (1e9, 1e9);
        let rayleigh_jeans = 2.0 * LIGHT_SPEED * BOLTZMANN * kelvin * 1e-9;
        assert_relative_eq!(planck_radiance(lambda, kelvin), rayleigh_jeans, max_relative = 1e-10);
    }

    #[test]
    fn wien_gives_the_peak() {
        let body = Spectrum::blackbody(5000.0).unwrap();
        let peak = WIEN_NM_KELVIN / 5000.0;
        assert!(body.eval(peak) > body.eval(peak - 0.01) && body.eval(peak) > body.eval(peak + 0.01));
        assert_eq!(body.range(), (body.eval(360.0), body.eval(peak)));
    }

    #[test]
    fn a_tabulated_line_keeps_its_area() {
        for (center, fwhm) in [(546.1, 0.1), (632.816, 1e-6), (589.3, 0.01), (550.0, 2.0), (600.0, 20.0)] {
            let line = Spectrum::line(center, fwhm).unwrap();
            let area = line.tabulate().integral(360.0, 830.0);
            assert_relative_eq!(area, 1.0, epsilon = if fwhm < 1e-3 { 1e-6 } else { 1e-10 });
            assert!(chord_error(&line) < 1e-4, "{fwhm}: {}", chord_error(&line));
        }
    }

    #[test]
    fn a_line_at_the_edge_is_cut_and_one_outside_is_dark() {
        let half = Spectrum::line(360.0, 1.0).unwrap().tabulate().integral(360.0, 830.0);
        assert_relative_eq!(half, 0.5, epsilon = 1e-6);
        let outside = Spectrum::line(300.0, 1.0).unwrap().tabulate();
        assert_eq!((outside.min(), outside.max()), (0.0, 0.0));
    }

    #[test]
    fn blackbodies_are_tabulated_within_1e_5() {
        for kelvin in [1.0, 20.0, 300.0, 1000.0, 2856.0, 6500.0, 25_000.0, 1e9] {
            let body = Spectrum::blackbody(kelvin).unwrap();
            if body.range().1 > 0.0 {
                assert!(chord_error(&body) < BLACKBODY_CHORD_ERROR, "{kelvin} K: {}", chord_error(&body));
            }
        }
        assert_eq!(Spectrum::blackbody(6500.0).unwrap().tabulate().lambdas_nm().len(), 471);
    }

    #[test]
    fn a_table_keeps_its_knots() {
        let table = PiecewiseLinear::new(vec![300.0, 400.25, 900.0], vec![0.0, 1.0, 0.5]).unwrap();
        let tabulated = Spectrum::PiecewiseLinear(table.clone()).tabulate();
        assert_eq!(tabulated.lambdas_nm(), [360.0, 400.25, 830.0]);
        for lambda in [360.0, 399.0, 400.25, 777.7, 830.0] {
            assert_relative_eq!(tabulated.eval(lambda), table.eval(lambda), max_relative = 1e-15);
        }
    }

    #[test]
    fn scaling_constancy_and_range() {
        let spectra = [
            Spectrum::Constant(2.0),
            Spectrum::blackbody(3000.0).unwrap(),
            Spectrum::line(500.0, 30.0).unwrap(),
            Spectrum::PiecewiseLinear(PiecewiseLinear::new(vec![400.0, 600.0], vec![1.0, 2.0]).unwrap()),
        ];
        for spectrum in spectra {
            let (least, most) = spectrum.range();
            for lambda in [360.0, 499.0, 700.0, 830.0] {
                let value = spectrum.eval(lambda);
                assert!(least <= value && value <= most, "{spectrum:?} at {lambda}");
                assert_relative_eq!(spectrum.clone().scaled(2.5).eval(lambda), 2.5 * value, max_relative = 1e-15);
            }
        }
        assert_eq!(Spectrum::Constant(2.0).is_constant(), Some(2.0));
        let flat = PiecewiseLinear::new(vec![400.0, 500.0], vec![0.3, 0.3]).unwrap();
        assert_eq!(Spectrum::PiecewiseLinear(flat).is_constant(), Some(0.3));
        assert_eq!(Spectrum::line(500.0, 1.0).unwrap().is_constant(), None);
    }

    #[test]
    fn rejects_impossible_parameters() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Spectrum::blackbody(bad).is_err() && Spectrum::line(bad, 1.0).is_err());
            assert!(Spectrum::line(500.0, bad).is_err());
        }
        let error = Spectrum::line(500.0, 1e-9).unwrap_err();
        assert_eq!(error.to_string(), "line width 0.000000001 nm; expected at least 1e-6 nm");
    }
}
