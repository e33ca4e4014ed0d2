//! A sigmoid of a quadratic polynomial of wavelength \[Jakob2019\]: solved directly, or read from a table of coefficients.

use super::linear::solve_dense;
use super::target::{KNOTS, REFLECTANCE, knots_nm, spectrum_of};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;
use std::sync::LazyLock;

/// Most Newton steps; colours within sRGB take 6 on average and under 30.
const MAX_STEPS: usize = 100;
/// Most halvings of a step.
const MAX_HALVINGS: usize = 30;
/// Largest accepted error of the colour, relative to its largest component.
const COLOR_TOLERANCE: f64 = 1e-10;
/// Error at which no further step is made.
const SOLVED: f64 = 1e-14;

/// Middle and half width of the range of wavelengths, nm: polynomials are solved in (λ − middle) / half.
const MIDDLE_NM: f64 = 0.5 * (LAMBDA_MIN_NM + LAMBDA_MAX_NM);
const HALF_NM: f64 = 0.5 * (LAMBDA_MAX_NM - LAMBDA_MIN_NM);

/// 1, t and t² with the weight of each knot.
static POWERS: LazyLock<Vec<DVec3>> = LazyLock::new(|| {
    let powers = |lambda| {
        let t = (lambda - MIDDLE_NM) / HALF_NM;
        DVec3::new(t * t, t, 1.0)
    };
    knots_nm().into_iter().map(powers).collect()
});

/// r(λ) = S(c₀ λ² + c₁ λ + c₂), λ in nm, with the sigmoid S(x) = ½ + x / (2 √(1 + x²)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigmoidPolynomial {
    /// c₀, c₁, c₂, as tables of coefficients hold them.
    pub coefficients: [f64; 3],
}

impl SigmoidPolynomial {
    /// The polynomial whose colour under D65 is `rgb`, linear RGB of the sRGB primaries in (0, 1); `None` if there is none.
    pub(super) fn solve(rgb: DVec3) -> Option<Self> {
        let scale = rgb.abs().max_element();
        let start = sigmoid_inverse((rgb.element_sum() / 3.0).clamp(1e-12, 1.0 - 1e-9));
        let mut at = DVec3::new(0.0, 0.0, start);
        let (mut residual, mut slopes) = linearize(rgb, at);
        for _ in 0..MAX_STEPS {
            let error = residual.abs().max_element();
            if error <= SOLVED * scale {
                break;
            }
            let [r, g, b] = slopes.map(|slope| slope.to_array());
            let rows = [[r[0], r[1], r[2], residual.x], [g[0], g[1], g[2], residual.y], [b[0], b[1], b[2], residual.z]];
            let step = DVec3::from(solve_dense(rows)?);
            let Some(next) = (0..MAX_HALVINGS)
                .map(|halvings| at + step / f64::from(1 << halvings))
                .find(|&next| residual_of(rgb, next).abs().max_element() < error)
            else {
                break;
            };
            at = next;
            (residual, slopes) = linearize(rgb, at);
        }
        (residual.abs().max_element() <= COLOR_TOLERANCE * scale).then(|| Self::from_centered(at))
    }

    /// Makes the spectrum of the polynomial in t = (λ − middle) / half.
    fn from_centered(c: DVec3) -> Self {
        let (a, b) = (c.x / (HALF_NM * HALF_NM), c.y / HALF_NM);
        Self { coefficients: [a, b - 2.0 * a * MIDDLE_NM, (a * MIDDLE_NM - b) * MIDDLE_NM + c.z] }
    }

    /// The reflectance at a wavelength in nm, within [0, 1].
    pub fn eval(&self, lambda_nm: f64) -> f64 {
        let [a, b, c] = self.coefficients;
        sigmoid((a * lambda_nm + b) * lambda_nm + c)
    }

    /// Tabulates the spectrum with knots 1 nm apart.
    pub fn to_spectrum(&self) -> Spectrum {
        spectrum_of(knots_nm().into_iter().map(|lambda| self.eval(lambda)).collect())
    }
}

fn sigmoid(x: f64) -> f64 {
    // Infinite coefficients stand for black and white.
    if x.is_infinite() {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    0.5 + 0.5 * x / (1.0 + x * x).sqrt()
}

fn sigmoid_inverse(value: f64) -> f64 {
    let u = 2.0 * value - 1.0;
    u / (1.0 - u * u).sqrt()
}

fn residual_of(rgb: DVec3, c: DVec3) -> DVec3 {
    let values: [f64; KNOTS] = std::array::from_fn(|j| sigmoid(c.dot(POWERS[j])));
    rgb - REFLECTANCE.rgb_of(&values)
}

/// Target minus colour, and the gradients of red, green and blue by the coefficients.
fn linearize(rgb: DVec3, c: DVec3) -> (DVec3, [DVec3; 3]) {
    let (mut color, mut gradients) = (DVec3::ZERO, [DVec3::ZERO; 3]);
    for (&weight, &powers) in REFLECTANCE.weights.iter().zip(POWERS.iter()) {
        let x = c.dot(powers);
        let root = (1.0 + x * x).sqrt();
        color += weight * (0.5 + 0.5 * x / root);
        let slope = powers * (0.5 / (root * root * root));
        for (gradient, w) in gradients.iter_mut().zip(weight.to_array()) {
            *gradient += slope * w;
        }
    }
    (rgb - color, gradients)
}

/// A table of coefficients in the format `.coeff` that the authors' program, Mitsuba and colour-science write.
///
/// Three blocks, one for each component that may be the largest; in each a cube over the largest component and the two
/// others relative to it.
#[derive(Debug, Clone, PartialEq)]
pub struct CoefficientTable {
    /// Largest components of the table's layers, ascending from 0 to 1.
    scale: Vec<f32>,
    /// Coefficients by block, layer, row and column.
    coefficients: Vec<[f32; 3]>,
}

/// Start of every file.
const MAGIC: &[u8; 4] = b"SPEC";
/// Largest resolution read: its table has 1.2 GB.
const MAX_RESOLUTION: usize = 512;

impl CoefficientTable {
    /// Reads the content of a file.
    ///
    /// # Errors
    /// Content that does not start with `SPEC`, or has another length than its resolution demands; a resolution under 2
    /// or over 512; a scale that does not ascend.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let error = |message: String| Err(Error::new(ErrorKind::FileFormat, message));
        let Some((magic, rest)) = bytes.split_first_chunk::<4>().filter(|(magic, _)| *magic == MAGIC) else {
            let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4)]).into_owned();
            return error(format!("the content starts with {start:?}; expected \"SPEC\", a table of coefficients"));
        };
        let Some((resolution, rest)) = rest.split_first_chunk::<4>() else {
            return error(format!("{} bytes; expected a resolution behind the first {}", bytes.len(), magic.len()));
        };
        let resolution = i32::from_le_bytes(*resolution);
        let n = match usize::try_from(resolution) {
            Ok(n) if (2..=MAX_RESOLUTION).contains(&n) => n,
            _ => return error(format!("resolution {resolution}; expected 2 to {MAX_RESOLUTION}")),
        };
        let expected = 4 * (n + 9 * n * n * n);
        if rest.len() != expected {
            return error(format!("{} bytes behind a resolution of {n}; expected {expected}", rest.len()));
        }
        let (numbers, _) = rest.as_chunks::<4>();
        let numbers: Vec<f32> = numbers.iter().map(|b| f32::from_le_bytes(*b)).collect();
        let (scale, coefficients) = numbers.split_at(n);
        if !scale.windows(2).all(|pair| pair[0] < pair[1]) {
            return error("a scale that does not ascend; expected layers from dark to bright".to_owned());
        }
        Ok(Self { scale: scale.to_vec(), coefficients: coefficients.as_chunks::<3>().0.to_vec() })
    }

    /// The content of a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend((self.scale.len() as i32).to_le_bytes());
        let numbers = self.scale.iter().chain(self.coefficients.iter().flatten());
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        bytes
    }

    /// The polynomial of linear components of the table's own RGB space, interpolated linearly.
    ///
    /// # Errors
    /// Components outside of [0, 1].
    pub fn lookup(&self, rgb: [f64; 3]) -> Result<SigmoidPolynomial> {
        super::check_components(rgb, 1.0, "reflectance")?;
        let largest = (1..3).fold(0, |best, i| if rgb[i] > rgb[best] { i } else { best });
        let value = rgb[largest];
        let n = self.scale.len();
        let ratio = |i: usize| if value > 0.0 { rgb[i % 3] / value * (n - 1) as f64 } else { 0.0 };
        let above = self.scale.partition_point(|&s| f64::from(s) <= value).clamp(1, n - 1);
        let (dark, bright) = (f64::from(self.scale[above - 1]), f64::from(self.scale[above]));
        let layer = (above - 1, (value - dark) / (bright - dark));
        let [row, column] = [ratio(largest + 2), ratio(largest + 1)].map(|at| {
            let cell = (at as usize).min(n - 2);
            (cell, at - cell as f64)
        });
        let mut sum = DVec3::ZERO;
        for corner in 0..8_usize {
            let mut weight = 1.0;
            let mut index = largest;
            for (bit, (cell, t)) in [layer, row, column].into_iter().enumerate() {
                let upper = corner >> bit & 1;
                weight *= if upper == 1 { t } else { 1.0 - t };
                index = index * n + cell + upper;
            }
            sum += weight * DVec3::from(self.coefficients[index].map(f64::from));
        }
        Ok(SigmoidPolynomial { coefficients: sum.to_array() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn direct_solutions_have_the_colour() {
        for rgb in [[0.2, 0.5, 0.1], [0.9, 0.05, 0.02], [1e-6, 3e-6, 1e-6], [0.999, 0.97, 0.2], [0.0, 0.0, 1.0]] {
            let rgb = DVec3::from(rgb);
            let spectrum = SigmoidPolynomial::solve(rgb).unwrap().to_spectrum();
            let values = spectrum.tabulate();
            let error = (REFLECTANCE.rgb_of(values.values()) - rgb).abs().max_element();
            assert!(error < 1e-9 * rgb.max_element().max(1e-2), "{rgb}: {error:e}");
            assert!(values.min() > 0.0 && values.max() < 1.0);
        }
        assert_eq!(SigmoidPolynomial::solve(DVec3::new(0.5, 1.2, 0.5)), None);
    }

    /// A table whose coefficients are linear in all three coordinates, so that interpolation is exact.
    fn table(n: usize) -> CoefficientTable {
        let scale: Vec<f32> = (0..n).map(|i| i as f32 / (n - 1) as f32).collect();
        let index = (0..3 * n * n * n).map(|i| [i / (n * n * n), i / (n * n) % n, i / n % n, i % n].map(|v| v as f32));
        let last = (n - 1) as f32;
        let coefficients = index.map(|[block, z, y, x]| [z / last + block, y / last, x / last]).collect();
        CoefficientTable { scale, coefficients }
    }

    #[test]
    fn tables_are_read_back_and_interpolated() {
        let table = table(5);
        assert_eq!(CoefficientTable::from_bytes(&table.to_bytes()).unwrap(), table);
        let c = table.lookup([0.3, 0.6, 0.15]).unwrap().coefficients;
        // Green is the largest: blocks of 1, then its value, then red and blue relative to it.
        for (value, expected) in c.into_iter().zip([1.6, 0.5, 0.25]) {
            assert!((value - expected).abs() < 1e-6, "{c:?}");
        }
        assert_eq!(table.lookup([0.0; 3]).unwrap().coefficients, [0.0; 3]);
        assert!((table.lookup([1.0; 3]).unwrap().coefficients[2] - 1.0).abs() < 1e-12);
        assert!(table.lookup([0.5, 1.5, 0.0]).is_err());
    }

    #[test]
    fn malformed_tables_are_refused() {
        let good = table(3).to_bytes();
        let mut wrong_scale = good.clone();
        wrong_scale[8..12].copy_from_slice(&9.0_f32.to_le_bytes());
        let mut huge = good.clone();
        huge[4..8].copy_from_slice(&i32::MAX.to_le_bytes());
        for bad in [&b""[..], b"SPE", b"SPEC", b"SPEC\x01\0\0\0", &good[..good.len() - 1], &wrong_scale, &huge] {
            assert_eq!(CoefficientTable::from_bytes(bad).unwrap_err().kind, ErrorKind::FileFormat);
        }
    }

    #[test]
    fn infinite_coefficients_are_black_and_white() {
        for (c, value) in [(f64::INFINITY, 1.0), (f64::NEG_INFINITY, 0.0)] {
            assert_eq!(SigmoidPolynomial { coefficients: [0.0, 0.0, c] }.eval(500.0), value);
        }
    }
}
