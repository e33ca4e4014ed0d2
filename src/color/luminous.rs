//! Luminous flux, and how much of a radiation is light.

use super::{Observer, integration::integral_of_product_2, table};
use crate::spectrum::resample::{Extrapolation, Grid, Interpolation, align};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use std::sync::LazyLock;

/// Stefan's constant, W·m⁻²·K⁻⁴ \[SI2019\].
const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;
/// Luminous efficacy of a photopic function at its largest, lm/W.
const PHOTOPIC_LM_PER_W: f64 = 683.0;
/// Largest luminous efficacy of scotopic vision, such that both agree at 540 THz.
const SCOTOPIC_LM_PER_W: f64 = 1700.0;

/// Names of those that are an observer's ȳ, with the observer.
const OF_OBSERVERS: [(&str, &str); 4] = [
    ("photopic-1924", "1931-2"),
    ("photopic-1964-10", "1964-10"),
    ("photopic-2008-2", "2015-2"),
    ("photopic-2008-10", "2015-10"),
];

static ALL: LazyLock<Vec<LuminousEfficiency>> = LazyLock::new(|| {
    let text = include_str!("../../data/quality/luminous_efficiency.csv");
    let of_observers = OF_OBSERVERS.into_iter().map(|(name, observer)| LuminousEfficiency::of_observer(name, observer));
    let of_columns = table::column_names(text).map(|name| LuminousEfficiency::of_column(name, text));
    let all: Result<_> = of_observers.chain(of_columns).collect();
    all.expect("the observers of colour-matching functions and data/quality/luminous_efficiency.csv exist")
});

/// How efficiently an eye sees the wavelengths: 1 at the most efficient, 0 where the table ends.
#[derive(Debug, Clone, PartialEq)]
pub struct LuminousEfficiency {
    name: &'static str,
    curve: PiecewiseLinear,
    lm_per_w: f64,
}

impl LuminousEfficiency {
    fn of_observer(name: &'static str, observer: &str) -> Result<Self> {
        let curve = Observer::by_name(observer)?.curves()[1].clone();
        Ok(Self { name, curve, lm_per_w: PHOTOPIC_LM_PER_W })
    }

    /// Tables coarser than 1 nm are interpolated by Sprague's polynomials.
    fn of_column(name: &'static str, text: &str) -> Result<Self> {
        let samples = table::column(text, name)?;
        let lambdas = samples.lambdas_nm();
        let grid = Grid::new(lambdas[0], lambdas[lambdas.len() - 1], 1.0)?;
        let curve = align(&samples, &grid, Interpolation::Sprague, Extrapolation::Zero)?;
        let lm_per_w = if name.starts_with("scotopic") { SCOTOPIC_LM_PER_W } else { PHOTOPIC_LM_PER_W };
        Ok(Self { name, curve, lm_per_w })
    }

    /// V(λ) of 1924, by which the lumen is defined for daylight vision: the ȳ of the CIE 1931 observer.
    pub fn photopic() -> &'static Self {
        &ALL[0]
    }

    /// `photopic-1924`, `photopic-1964-10` (10° field), `photopic-2008-2` and `photopic-2008-10` (from cone
    /// fundamentals), `scotopic-1951` (dark-adapted rods), `judd-1951` and `judd-vos-1978` (V(λ) corrected in the blue).
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<&'static Self> {
        ALL.iter()
            .find(|known| known.name == name)
            .ok_or_else(|| Error::unknown_name("luminous efficiency function", name, Self::names()))
    }

    /// Names that [`Self::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ALL.iter().map(|known| known.name)
    }

    /// The function at 1 nm; 0 beyond the ends.
    pub fn curve(&self) -> &PiecewiseLinear {
        &self.curve
    }

    /// Efficacy where the function is 1, lm/W: 683, of the scotopic one 1700.
    pub fn lm_per_w(&self) -> f64 {
        self.lm_per_w
    }

    /// Luminous flux K ∫ V S dλ, exactly (but for rounding): lm for W/nm, cd/m² for W·m⁻²·sr⁻¹·nm⁻¹.
    ///
    /// A table counts from its first to its last wavelength: what was not measured is not made up.
    pub fn flux(&self, radiation: &Spectrum) -> f64 {
        let table = radiation.tabulate();
        let (first, last) = match radiation {
            Spectrum::PiecewiseLinear(own) => ends(own),
            _ => (LAMBDA_MIN_NM, LAMBDA_MAX_NM),
        };
        let (from, to) = ends(&self.curve);
        let (from, to) = (from.max(first), to.min(last));
        if from < to { self.lm_per_w * integral_of_product_2(&self.curve, &table, from, to) } else { 0.0 }
    }

    /// The part of a radiation that is light: ∫ V S dλ / ∫ S dλ, between 0 and 1.
    ///
    /// A table counts from its first to its last wavelength, a constant over 360–830 nm, a blackbody and a line as a whole.
    ///
    /// # Errors
    /// A radiation without power.
    pub fn efficiency(&self, radiation: &Spectrum) -> Result<f64> {
        share(self.flux(radiation) / self.lm_per_w, power(radiation))
    }

    /// Luminous efficacy of a radiation, lm/W: [`Self::efficiency`] times [`Self::lm_per_w`].
    ///
    /// # Errors
    /// A radiation without power.
    pub fn efficacy(&self, radiation: &Spectrum) -> Result<f64> {
        Ok(self.lm_per_w * self.efficiency(radiation)?)
    }

    /// The flux as a trapezoid sum of V S at a table's own wavelengths, as instruments and other programs report it.
    ///
    /// At 5 nm it is off by up to 1 % for lamps with lines.
    pub fn flux_at_samples(&self, samples: &PiecewiseLinear) -> f64 {
        self.lm_per_w * trapezoids(samples, |lambda| self.eval(lambda))
    }

    /// The part that is light, both integrals as trapezoid sums at a table's own wavelengths.
    ///
    /// # Errors
    /// A radiation without power.
    pub fn efficiency_at_samples(&self, samples: &PiecewiseLinear) -> Result<f64> {
        share(trapezoids(samples, |lambda| self.eval(lambda)), trapezoids(samples, |_| 1.0))
    }

    /// V at a wavelength in nm.
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        let (from, to) = ends(&self.curve);
        if (from..=to).contains(&lambda_nm) { self.curve.eval(lambda_nm) } else { 0.0 }
    }
}

/// Photopic luminous flux: lm for a spectrum in W/nm, cd/m² for one in W·m⁻²·sr⁻¹·nm⁻¹; see [`LuminousEfficiency::flux`].
///
/// ```
/// use abbe::{color::luminous, spectrum::Spectrum};
/// let green = Spectrum::line(555.0, 0.01)?;
/// assert!((luminous::luminous_flux(&green) - 683.0).abs() < 1e-2);
/// # Ok::<(), abbe::Error>(())
/// ```
pub fn luminous_flux(radiation: &Spectrum) -> f64 {
    LuminousEfficiency::photopic().flux(radiation)
}

/// The part of a radiation that is light, [0, 1]; see [`LuminousEfficiency::efficiency`].
///
/// # Errors
/// A radiation without power.
pub fn efficiency(radiation: &Spectrum) -> Result<f64> {
    LuminousEfficiency::photopic().efficiency(radiation)
}

/// Photopic luminous efficacy of a radiation, lm/W; see [`LuminousEfficiency::efficacy`].
///
/// # Errors
/// A radiation without power.
pub fn efficacy(radiation: &Spectrum) -> Result<f64> {
    LuminousEfficiency::photopic().efficacy(radiation)
}

fn ends(table: &PiecewiseLinear) -> (f64, f64) {
    let lambdas = table.lambdas_nm();
    (lambdas[0], lambdas[lambdas.len() - 1])
}

/// ∫ S dλ over what counts.
fn power(radiation: &Spectrum) -> f64 {
    match radiation {
        Spectrum::Constant(value) => value * (LAMBDA_MAX_NM - LAMBDA_MIN_NM),
        Spectrum::PiecewiseLinear(table) => trapezoids(table, |_| 1.0),
        Spectrum::Blackbody { kelvin, factor } => {
            let square = kelvin * kelvin;
            factor * STEFAN_BOLTZMANN * square * square / std::f64::consts::PI
        }
        Spectrum::Line { factor, .. } => *factor,
    }
}

fn trapezoids(samples: &PiecewiseLinear, weight: impl Fn(f64) -> f64) -> f64 {
    let knots: Vec<(f64, f64)> = samples.knots().map(|(lambda, value)| (lambda, weight(lambda) * value)).collect();
    knots.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum()
}

fn share(part: f64, whole: f64) -> Result<f64> {
    if whole > 0.0 && whole.is_finite() {
        return Ok(part / whole);
    }
    Err(Error::new(ErrorKind::OutOfRange, format!("a radiation of power {whole:e}; expected a positive one")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{illuminant, xyz_of_emission};
    use approx::assert_relative_eq;

    #[test]
    fn a_photopic_flux_is_the_luminance_of_colorimetry() {
        let observer = Observer::cie_1931_2deg();
        for light in [Spectrum::blackbody(2856.0).unwrap(), Spectrum::Constant(0.3), illuminant::by_name("E").unwrap()]
        {
            let y = xyz_of_emission(&light, observer).y;
            assert_relative_eq!(luminous_flux(&light), 683.0 * observer.y_integral() * y, max_relative = 1e-13);
        }
    }

    #[test]
    fn efficacies_are_the_known_ones() {
        // Equal energy over 360–830 nm: 683 · 106.857 / 470.
        assert_relative_eq!(efficacy(&Spectrum::Constant(2.0)).unwrap(), 683.0 * 106.857 / 470.0, max_relative = 1e-5);
        // The best blackbody, at about 6640 K, has 95 lm/W.
        let of_body = |kelvin| efficacy(&Spectrum::blackbody(kelvin).unwrap()).unwrap();
        assert!((94.5..95.5).contains(&of_body(6640.0)), "{}", of_body(6640.0));
        assert!(of_body(6640.0) > of_body(6300.0) && of_body(6640.0) > of_body(7000.0));
        let rods = LuminousEfficiency::by_name("scotopic-1951").unwrap();
        assert_relative_eq!(rods.efficacy(&Spectrum::line(507.0, 0.01).unwrap()).unwrap(), 1700.0, max_relative = 1e-4);
    }

    #[test]
    fn every_function_peaks_at_1_and_is_0_beyond_its_ends() {
        // Judd's table at 10 nm peaks between two samples.
        for name in LuminousEfficiency::names() {
            let function = LuminousEfficiency::by_name(name).unwrap();
            assert!((function.curve().max() - 1.0).abs() < 2e-4, "{name}: {}", function.curve().max());
            assert_eq!((function.eval(359.0), function.eval(831.0)), (0.0, 0.0), "{name}");
            assert!(function.efficiency(&Spectrum::Constant(1.0)).unwrap() > 0.2, "{name}");
        }
        let error = LuminousEfficiency::by_name("photopic").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("photopic-1924")));
    }

    #[test]
    fn a_table_counts_between_its_ends() {
        let table = |from: f64, to: f64| PiecewiseLinear::new(vec![from, to], vec![1.0, 1.0]).unwrap();
        let halves = [table(360.0, 555.0), table(555.0, 830.0)].map(|t| luminous_flux(&Spectrum::PiecewiseLinear(t)));
        assert_relative_eq!(halves[0] + halves[1], luminous_flux(&Spectrum::Constant(1.0)), max_relative = 1e-13);
        assert_eq!(luminous_flux(&Spectrum::PiecewiseLinear(table(900.0, 1000.0))), 0.0);
        let (narrow, wide) = (table(555.0, 556.0), table(555.0, 557.0));
        let shares = [narrow, wide].map(|t| efficiency(&Spectrum::PiecewiseLinear(t)).unwrap());
        assert!(shares[0] > 0.999 && shares[1] < shares[0], "{shares:?}");
    }

    #[test]
    fn sums_at_samples_are_near_the_integral_and_darkness_is_an_error() {
        for (name, tolerance) in [("D65", 1e-3), ("FL11", 2e-2), ("HP1", 2e-2)] {
            let samples = illuminant::relative_power(name).unwrap();
            let sum = LuminousEfficiency::photopic().flux_at_samples(&samples);
            let difference = sum / luminous_flux(&Spectrum::PiecewiseLinear(samples)) - 1.0;
            assert!(difference.abs() < tolerance && difference != 0.0, "{name}: {difference}");
        }
        assert_eq!(efficiency(&Spectrum::Constant(0.0)).unwrap_err().kind, ErrorKind::OutOfRange);
    }
}
