//! Dispersion formulas: index of refraction as a function of wavelength, the nine of refractiveindex.info.
//!
//! Wavelengths are in micrometres inside this file, as in the formulas' coefficients; everywhere else abbe uses
//! nanometres. The formulas are numbered and written as in \[Polyanskiy2024\].

use crate::{Error, ErrorKind, Result, math};

/// The closed set of dispersion formulas.
///
/// Built from the coefficients of a refractiveindex.info file with [`Dispersion::from_coefficients`].
#[derive(Debug, Clone, PartialEq)]
pub enum Dispersion {
    /// Formulas 1 and 2 (Sellmeier): n² = 1 + offset + Σ b λ² / (λ² − c).
    Sellmeier {
        /// Added to n² beside the 1.
        offset: f64,
        /// Resonances.
        terms: Vec<Sellmeier>,
    },
    /// Formulas 3 (polynomial) and 4 (general): n² = constant + Σ b λᵉ / (λ² − c) + Σ a λᵉ.
    General {
        /// The term without a wavelength.
        constant: f64,
        /// Fractions; none in formula 3.
        resonances: Vec<Resonance>,
        /// Powers of the wavelength.
        powers: Vec<Power>,
    },
    /// Formula 5 (Cauchy): n = constant + Σ a λᵉ.
    Cauchy {
        /// The term without a wavelength.
        constant: f64,
        /// Powers of the wavelength.
        powers: Vec<Power>,
    },
    /// Formula 6 (gases): n = 1 + offset + Σ b / (c − λ⁻²).
    Gases {
        /// Added to n beside the 1.
        offset: f64,
        /// Strengths b in µm⁻² and squared wave numbers c in µm⁻².
        terms: Vec<[f64; 2]>,
    },
    /// Formula 7 (Herzberger): n = a₀ + a₁ L + a₂ L² + a₃ λ² + a₄ λ⁴ + a₅ λ⁶ with L = 1 / (λ² − 0.028).
    Herzberger([f64; 6]),
    /// Formula 8 (retro): (n² − 1) / (n² + 2) = a₀ + a₁ λ² / (λ² − a₂) + a₃ λ².
    Retro([f64; 4]),
    /// Formula 9 (exotic): n² = a₀ + a₁ / (λ² − a₂) + a₃ (λ − a₄) / ((λ − a₄)² + a₅).
    Exotic([f64; 6]),
}

/// One resonance b λ² / (λ² − c) of a Sellmeier formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sellmeier {
    /// Strength.
    pub b: f64,
    /// Square of the resonance wavelength, µm².
    pub c_um2: f64,
}

/// One fraction b λᵉ / (λ² − c) of the general formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Strength.
    pub b: f64,
    /// Exponent of λ in the numerator.
    pub exponent: f64,
    /// Square of the resonance wavelength, µm².
    pub c_um2: f64,
}

/// One term a λᵉ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// Strength.
    pub a: f64,
    /// Exponent of λ.
    pub exponent: f64,
}

/// The pole that formula 7 has in every material, µm².
const HERZBERGER_POLE_UM2: f64 = 0.028;

impl Dispersion {
    /// A formula by its number in refractiveindex.info (1 to 9) and its coefficients in the order of that database.
    ///
    /// # Errors
    /// `Unsupported` for another number, `NotFinite` for NaN or infinite coefficients, `Missing` for a number of
    /// coefficients that does not fit the formula.
    pub fn from_coefficients(number: u32, coefficients: &[f64]) -> Result<Self> {
        if !(1..=9).contains(&number) {
            return Err(Error::new(ErrorKind::Unsupported, format!("formula {number}: expected formula 1 to 9")));
        }
        if let Some(i) = coefficients.iter().position(|c| !c.is_finite()) {
            let message = format!("coefficient {} is {}: expected a finite number", i + 1, coefficients[i]);
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        let wrong_count = || {
            let expected = match number {
                4 => "1, 5, 9, 11, 13, …",
                7 => "1 to 6",
                8 => "4",
                9 => "6",
                _ => "an odd number of",
            };
            let message = format!("formula {number}: expected {expected} coefficients, found {}", coefficients.len());
            Error::new(ErrorKind::Missing, message)
        };
        let Some((&first, rest)) = coefficients.split_first() else { return Err(wrong_count()) };
        let pairs = || paired(rest).ok_or_else(wrong_count);
        Ok(match number {
            1 => sellmeier(first, pairs()?, |c| c * c),
            2 => sellmeier(first, pairs()?, |c| c),
            3 => Self::General { constant: first, resonances: Vec::new(), powers: powers(pairs()?) },
            4 => general(first, rest).ok_or_else(wrong_count)?,
            5 => Self::Cauchy { constant: first, powers: powers(pairs()?) },
            6 => Self::Gases { offset: first, terms: pairs()?.to_vec() },
            7 => Self::Herzberger(zero_padded(coefficients).ok_or_else(wrong_count)?),
            8 => Self::Retro(coefficients.try_into().map_err(|_| wrong_count())?),
            _ => Self::Exotic(coefficients.try_into().map_err(|_| wrong_count())?),
        })
    }

    /// Index of refraction at a wavelength in micrometres; NaN where the formula has none (n² < 0).
    #[inline]
    pub fn eval_um(&self, lambda_um: f64) -> f64 {
        let l2 = lambda_um * lambda_um;
        match self {
            Self::Sellmeier { offset, terms } => {
                terms.iter().fold(1.0 + offset, |sum, t| sum + t.b * l2 / (l2 - t.c_um2)).sqrt()
            }
            Self::General { constant, resonances, powers } => {
                let fraction = |r: &Resonance| r.b * power(lambda_um, r.exponent) / (l2 - r.c_um2);
                let sum = resonances.iter().fold(*constant, |sum, r| sum + fraction(r));
                add_powers(sum, powers, lambda_um).sqrt()
            }
            Self::Cauchy { constant, powers } => add_powers(*constant, powers, lambda_um),
            Self::Gases { offset, terms } => {
                let nu2 = 1.0 / l2;
                terms.iter().fold(1.0 + offset, |sum, [b, c]| sum + b / (c - nu2))
            }
            Self::Herzberger(a) => {
                let l = 1.0 / (l2 - HERZBERGER_POLE_UM2);
                a[0] + a[1] * l + a[2] * l * l + a[3] * l2 + a[4] * l2 * l2 + a[5] * l2 * l2 * l2
            }
            Self::Retro(a) => {
                let x = a[0] + a[1] * l2 / (l2 - a[2]) + a[3] * l2;
                ((2.0 * x + 1.0) / (1.0 - x)).sqrt()
            }
            Self::Exotic(a) => {
                let shift = lambda_um - a[4];
                (a[0] + a[1] / (l2 - a[2]) + a[3] * shift / (shift * shift + a[5])).sqrt()
            }
        }
    }

    /// Squares of the wavelengths (µm²) at which a term divides by zero. The index jumps there, perhaps between two
    /// wavelengths that are looked at, so they are looked for by themselves.
    pub fn poles_um2(&self) -> Vec<f64> {
        match self {
            Self::Sellmeier { terms, .. } => terms.iter().filter(|t| t.b != 0.0).map(|t| t.c_um2).collect(),
            Self::General { resonances, .. } => resonances.iter().map(|r| r.c_um2).collect(),
            Self::Cauchy { .. } => Vec::new(),
            Self::Gases { terms, .. } => terms.iter().filter(|[b, _]| *b != 0.0).map(|[_, c]| 1.0 / c).collect(),
            Self::Herzberger(_) => vec![HERZBERGER_POLE_UM2],
            Self::Retro(a) => {
                if a[1] == 0.0 {
                    Vec::new()
                } else {
                    vec![a[2]]
                }
            }
            Self::Exotic(a) => {
                if a[1] == 0.0 {
                    Vec::new()
                } else {
                    vec![a[2]]
                }
            }
        }
    }

    /// Name of the formula for people.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sellmeier { .. } => "Sellmeier",
            Self::General { resonances, .. } if resonances.is_empty() => "polynomial",
            Self::General { .. } => "general",
            Self::Cauchy { .. } => "Cauchy",
            Self::Gases { .. } => "gases",
            Self::Herzberger(_) => "Herzberger",
            Self::Retro(_) => "retro",
            Self::Exotic(_) => "exotic",
        }
    }
}

/// Reads coefficients two by two; `None` if one is left over.
fn paired(coefficients: &[f64]) -> Option<&[[f64; 2]]> {
    let (pairs, rest) = coefficients.as_chunks::<2>();
    rest.is_empty().then_some(pairs)
}

fn sellmeier(offset: f64, pairs: &[[f64; 2]], c_um2: impl Fn(f64) -> f64) -> Dispersion {
    let terms = pairs.iter().map(|&[b, c]| Sellmeier { b, c_um2: c_um2(c) }).collect();
    Dispersion::Sellmeier { offset, terms }
}

fn powers(pairs: &[[f64; 2]]) -> Vec<Power> {
    pairs.iter().map(|&[a, exponent]| Power { a, exponent }).collect()
}

/// Formula 4: up to two groups of four (b, e, c, f) for b λᵉ / (λ² − cᶠ), then pairs. Groups of strength 0 are padding.
fn general(constant: f64, rest: &[f64]) -> Option<Dispersion> {
    let (groups, pairs) = if rest.len() < 8 { (rest, &[][..]) } else { rest.split_at(8) };
    let (groups, left_over) = groups.as_chunks::<4>();
    if !left_over.is_empty() {
        return None;
    }
    let resonance = |&[b, exponent, c, f]: &[f64; 4]| Resonance { b, exponent, c_um2: power(c, f) };
    let resonances = groups.iter().filter(|group| group[0] != 0.0).map(resonance).collect();
    Some(Dispersion::General { constant, resonances, powers: powers(paired(pairs)?) })
}

/// Fills the coefficients up with zeros; `None` if there are too many.
fn zero_padded<const N: usize>(coefficients: &[f64]) -> Option<[f64; N]> {
    let mut padded = [0.0; N];
    padded.get_mut(..coefficients.len())?.copy_from_slice(coefficients);
    Some(padded)
}

#[inline]
fn add_powers(start: f64, powers: &[Power], lambda_um: f64) -> f64 {
    powers.iter().fold(start, |sum, p| sum + p.a * power(lambda_um, p.exponent))
}

/// x to the power e. Whole exponents, which nearly all published formulas have, are multiplied out: `pow` is many times
/// slower, and an index is wanted for eight wavelengths on every path.
#[inline]
fn power(x: f64, exponent: f64) -> f64 {
    let whole = exponent as i32;
    if f64::from(whole) != exponent || whole.unsigned_abs() > 16 {
        return math::pow(x, exponent);
    }
    let (mut result, mut square, mut bits) = (1.0, x, whole.unsigned_abs());
    while bits > 0 {
        if bits & 1 == 1 {
            result *= square;
        }
        square *= square;
        bits >>= 1;
    }
    if whole < 0 { 1.0 / result } else { result }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expected values worked out by hand (exact fractions or a few digits of a square root) from the definitions.
    #[test]
    fn formulas_match_hand_computed_values() {
        let at = |number, coefficients: &[f64], lambda_um| {
            Dispersion::from_coefficients(number, coefficients).unwrap().eval_um(lambda_um)
        };
        let cases = [
            // 1 + 0.25 + 0.75·4/(4 − 0.25) + 0.5·4/(4 − 1) = 2.05 + 2/3
            (at(1, &[0.25, 0.75, 0.5, 0.5, 1.0], 2.0), f64::sqrt(2.05 + 2.0 / 3.0)),
            // 1 + 1·0.25/(0.25 − 0.01) = 49/24
            (at(2, &[0.0, 1.0, 0.01], 0.5), f64::sqrt(49.0 / 24.0)),
            // 2 − 0.1·0.25 + 0.04·4 + 0.5·0.5^1.5
            (
                at(3, &[2.0, -0.1, 2.0, 0.04, -2.0, 0.5, 1.5], 0.5),
                f64::sqrt(2.0 - 0.025 + 0.16 + 0.5 * 0.125_f64.sqrt()),
            ),
            // 2 + 0.5·0.5²/(0.25 − 0.2²) + 0.3·0.5/(0.25 − 0.04) − 0.01·4
            (
                at(4, &[2.0, 0.5, 2.0, 0.2, 2.0, 0.3, 1.0, 0.04, 1.0, -0.01, -2.0], 0.5),
                f64::sqrt(2.0 + 0.125 / 0.21 + 0.15 / 0.21 - 0.04),
            ),
            // 1.5 + 0.004/0.25 + 0.0002/0.0625
            (at(5, &[1.5, 0.004, -2.0, 0.0002, -4.0], 0.5), 1.5192),
            // 1 + 0.001 + 0.05/(54 − 4)
            (at(6, &[0.001, 0.05, 54.0], 0.5), 1.002),
            // L = 1/(1.028 − 0.028) = 1: 2.5 + 0.1 + 0.01 + 0.02·1.028 + 0.03·1.028² + 0.04·1.028³
            (
                at(7, &[2.5, 0.1, 0.01, 0.02, 0.03, 0.04], 1.028_f64.sqrt()),
                2.61 + 0.02056 + 0.03 * 1.056784 + 0.04 * 1.086373952,
            ),
            // x = 0.2 + 0.1·1/(1 − 0.5) − 0.1 = 0.3: n² = 1.6/0.7
            (at(8, &[0.2, 0.1, 0.5, -0.1], 1.0), f64::sqrt(1.6 / 0.7)),
            // 2 + 0.03/(0.25 − 0.1) + 0.04·0.2/(0.04 + 0.04)
            (at(9, &[2.0, 0.03, 0.1, 0.04, 0.3, 0.04], 0.5), f64::sqrt(2.3)),
        ];
        for (i, (got, expected)) in cases.into_iter().enumerate() {
            assert!((got - expected).abs() <= 1e-15 * expected * 4.0, "case {i}: {got} is not {expected}");
        }
    }

    #[test]
    fn padding_of_formula_4_does_not_make_a_pole() {
        let formula = Dispersion::from_coefficients(4, &[5.0, 0.2, 0.0, 0.08, 1.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
        assert_eq!(formula.eval_um(1.0), f64::sqrt(5.0 + 0.2 / 0.92));
        assert_eq!(formula.poles_um2(), [0.08]);
    }

    #[test]
    fn whole_powers_agree_with_pow() {
        for exponent in -16..=16 {
            for x in [0.36, 0.5875618, 0.83, 1.0, 2.5] {
                let (got, expected) = (power(x, f64::from(exponent)), math::pow(x, f64::from(exponent)));
                assert!((got - expected).abs() <= 4e-15 * expected, "{x}^{exponent}: {got} is not {expected}");
            }
        }
        assert_eq!(power(0.25, -0.5), 2.0);
        assert_eq!(power(0.0, 0.0), 1.0);
    }

    #[test]
    fn wrong_coefficients_are_errors() {
        let kind = |number, coefficients: &[f64]| Dispersion::from_coefficients(number, coefficients).unwrap_err().kind;
        assert_eq!(kind(0, &[1.0]), ErrorKind::Unsupported);
        assert_eq!(kind(10, &[1.0]), ErrorKind::Unsupported);
        for number in 1..=9 {
            assert_eq!(kind(number, &[]), ErrorKind::Missing, "formula {number}");
            assert_eq!(kind(number, &[1.0, f64::NAN, 0.0]), ErrorKind::NotFinite, "formula {number}");
        }
        for number in 1..=6 {
            assert_eq!(kind(number, &[1.0, 2.0]), ErrorKind::Missing, "formula {number}");
        }
        assert_eq!(kind(4, &[1.0; 7]), ErrorKind::Missing);
        assert_eq!(kind(4, &[1.0; 10]), ErrorKind::Missing);
        assert_eq!(kind(7, &[1.0; 7]), ErrorKind::Missing);
        assert_eq!(kind(8, &[1.0; 3]), ErrorKind::Missing);
        assert_eq!(kind(9, &[1.0; 7]), ErrorKind::Missing);
    }
}
