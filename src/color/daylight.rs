//! Phases of daylight as the CIE defines them: chromaticity and spectrum for a correlated colour temperature.

use super::table;
use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};
use std::sync::LazyLock;

/// Range of the definition, K.
const KELVIN_RANGE: (f64, f64) = (4000.0, 25_000.0);

static COMPONENTS: LazyLock<[PiecewiseLinear; 3]> = LazyLock::new(|| {
    let text = include_str!("../../data/illuminants/daylight_components.csv");
    let column = |name| table::column(text, name);
    ["S0", "S1", "S2"].map(|name| column(name).expect("daylight_components.csv has the columns S0, S1, S2"))
});

/// What is done to the factors of the second and third component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factors {
    /// Rounded to three decimals (ties to even), as CIE 15 prescribes and as the tables of D50 … D75 were made.
    Rounded,
    /// The factors as the formula gives them.
    Exact,
}

/// y of a phase of daylight with the chromaticity coordinate x \[CIE15\].
pub fn locus_y(x: f64) -> f64 {
    (-3.0 * x + 2.87) * x - 0.275
}

/// Chromaticity x, y of daylight at a correlated colour temperature of 4000 to 25 000 K (on the scale of 1990) \[CIE15\].
///
/// The nominal temperature of an illuminant is on an older scale: D65 is at 6500 · 1.4388 / 1.4380 K = 6504 K.
///
/// # Errors
/// A temperature outside that range.
pub fn xy(kelvin: f64) -> Result<[f64; 2]> {
    if !(KELVIN_RANGE.0..=KELVIN_RANGE.1).contains(&kelvin) {
        let message = format!("daylight of {kelvin} K; expected {} to {} K", KELVIN_RANGE.0, KELVIN_RANGE.1);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(xy_unchecked(kelvin))
}

/// Chromaticity of daylight without a check of the temperature's range.
pub(super) fn xy_unchecked(kelvin: f64) -> [f64; 2] {
    let t = 1e3 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
    } else {
        ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
    };
    [x, locus_y(x)]
}

/// Relative spectral power of the daylight of a chromaticity, 100 at 560 nm, every 5 nm over 300–830 nm \[CIE15\].
///
/// Negative values are possible far from daylight.
///
/// # Errors
/// A chromaticity that is not finite or has no such combination of the three components.
pub fn of_xy([x, y]: [f64; 2], factors: Factors) -> Result<PiecewiseLinear> {
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let exact = [(-1.3515 - 1.7703 * x + 5.9114 * y) / m, (0.0300 - 31.4424 * x + 30.0717 * y) / m];
    if !(exact[0].is_finite() && exact[1].is_finite()) {
        let message = format!("chromaticity {x}, {y}; expected one near the daylight locus");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let [m1, m2] = match factors {
        Factors::Rounded => exact.map(|factor| (factor * 1e3).round_ties_even() / 1e3),
        Factors::Exact => exact,
    };
    let [s0, s1, s2] = &*COMPONENTS;
    let values = s0.values().iter().zip(s1.values()).zip(s2.values()).map(|((a, b), c)| a + m1 * b + m2 * c);
    PiecewiseLinear::new(s0.lambdas_nm().to_vec(), values.collect())
}

/// Relative spectral power of daylight at a correlated colour temperature, 100 at 560 nm, every 5 nm over 300–830 nm.
///
/// ```
/// use abbe::color::{daylight, illuminant};
/// let d65 = daylight::of_kelvin(6500.0 * 1.4388 / 1.4380, daylight::Factors::Rounded)?;
/// assert!((d65.eval(450.0) - illuminant::relative_power("D65")?.eval(450.0)).abs() < 2e-2);
/// # Ok::<(), abbe::Error>(())
/// ```
///
/// # Errors
/// A temperature outside 4000 to 25 000 K.
pub fn of_kelvin(kelvin: f64, factors: Factors) -> Result<PiecewiseLinear> {
    of_xy(xy(kelvin)?, factors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::illuminant;

    #[test]
    fn the_standard_illuminants_follow() {
        for (name, nominal) in [("D50", 5000.0), ("D55", 5500.0), ("D65", 6500.0), ("D75", 7500.0)] {
            let computed = of_kelvin(nominal * 1.4388 / 1.4380, Factors::Rounded).unwrap();
            let published = illuminant::relative_power(name).unwrap();
            let worst = published.knots().map(|(l, v)| (computed.eval(l) - v).abs()).fold(0.0, f64::max);
            assert!(worst < 0.05, "{name}: {worst}");
        }
    }

    #[test]
    fn exact_factors_differ_a_little() {
        let [rounded, exact] = [Factors::Rounded, Factors::Exact].map(|f| of_kelvin(6504.0, f).unwrap());
        let worst = exact.knots().map(|(l, v)| (rounded.eval(l) - v).abs()).fold(0.0, f64::max);
        assert!(1e-4 < worst && worst < 0.1, "{worst}");
        assert_eq!((exact.eval(560.0), exact.lambdas_nm().len()), (100.0, 107));
    }

    #[test]
    fn chromaticities() {
        let [x, y] = xy(6504.0).unwrap();
        assert!((x - 0.31271).abs() < 2e-5 && (y - 0.32902).abs() < 1e-4, "{x} {y}");
        // The two formulas meet at 7000 K.
        let (below, above) = (xy(7000.0).unwrap()[0], xy(7000.0_f64.next_up()).unwrap()[0]);
        assert!((below - above).abs() < 1e-5, "{below} {above}");
        for kelvin in [3999.0, 25_001.0, f64::NAN] {
            assert_eq!(xy(kelvin).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        for xy in [[f64::NAN, 0.3], [0.3, f64::INFINITY]] {
            assert_eq!(of_xy(xy, Factors::Exact).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
