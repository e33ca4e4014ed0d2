//! The spectral layout: a channel for each wavelength, named after it \[Fichet2021\].

use crate::color::Observer;
use crate::color::integration::integral_of_product_2;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear};
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// Speed of light in vacuum, nm·Hz \[SI2019\].
const SPEED_OF_LIGHT_NM_HZ: f64 = 299_792_458e9;

/// Splits the name of a channel of emitted light of any polarisation, such as `left.S0.550,000000nm`, into what stands before
/// `S0` and the wavelength in nm. The name may have another unit of length, or of frequency. Returns `None` for other channels.
pub fn emissive_channel(name: &str) -> Option<(&str, f64)> {
    let start = if name.starts_with("S0.") { 0 } else { name.find(".S0.")? + 1 };
    let (prefix, quantity) = (&name[..start], &name[start + 3..]);
    // The unit starts at the first letter that is no exponent's.
    let is_number = |c: char| c.is_ascii_digit() || [',', '+', '-'].contains(&c);
    let unit_at = quantity.char_indices().find(|&(i, c)| {
        let exponent =
            c.eq_ignore_ascii_case(&'e') && quantity[i + 1..].starts_with(|d: char| is_number(d) && d != ',');
        !is_number(c) && !exponent
    })?;
    let (number, unit) = quantity.split_at(unit_at.0);
    let number: f64 = number.replace(',', ".").parse().ok()?;
    let lambda_nm = match (unit.strip_suffix("Hz"), unit.strip_suffix('m')) {
        (Some(multiple), _) => SPEED_OF_LIGHT_NM_HZ / (number * power_of_ten(multiple)?),
        (None, Some(multiple)) => number * power_of_ten(multiple)? * 1e9,
        (None, None) => return None,
    };
    (lambda_nm.is_finite() && lambda_nm > 0.0).then_some((prefix, lambda_nm))
}

fn power_of_ten(multiple: &str) -> Option<f64> {
    Some(match multiple {
        "Y" => 1e24,
        "Z" => 1e21,
        "E" => 1e18,
        "P" => 1e15,
        "T" => 1e12,
        "G" => 1e9,
        "M" => 1e6,
        "k" => 1e3,
        "h" => 1e2,
        "da" => 1e1,
        "" => 1.0,
        "d" => 1e-1,
        "c" => 1e-2,
        "m" => 1e-3,
        "u" => 1e-6,
        "n" => 1e-9,
        "p" => 1e-12,
        _ => return None,
    })
}

/// Computes what a radiance of 1 in each channel adds to X, Y and Z. The spectrum is linear between the channels' wavelengths and
/// constant for half a step beyond the first and the last; a radiance of 1 at all wavelengths has Y = 1.
pub fn weights(lambdas_nm: &[f64]) -> Result<Vec<DVec3>> {
    let n = lambdas_nm.len();
    if n < 2 || lambdas_nm.windows(2).any(|pair| pair[0] >= pair[1]) {
        let message = format!("{n} spectral channels, or two of one wavelength; expected at least two different ones");
        return Err(Error::new(ErrorKind::FileFormat, message));
    }
    let observer = Observer::cie_1931_2deg();
    let step = |i: usize| lambdas_nm[i + 1] - lambdas_nm[i];
    (0..n)
        .map(|i| {
            let (mut knots, mut values) = (vec![lambdas_nm[i]], vec![1.0]);
            let mut from = lambdas_nm[0] - 0.5 * step(0);
            let mut to = lambdas_nm[n - 1] + 0.5 * step(n - 2);
            if i > 0 {
                from = lambdas_nm[i - 1];
                knots.insert(0, from);
                values.insert(0, 0.0);
            }
            if i + 1 < n {
                to = lambdas_nm[i + 1];
                knots.push(to);
                values.push(0.0);
            }
            let hat = PiecewiseLinear::new(knots, values)?;
            let (from, to) = (from.max(LAMBDA_MIN_NM), to.min(LAMBDA_MAX_NM));
            let part = |curve| if from < to { integral_of_product_2(&hat, curve, from, to) } else { 0.0 };
            Ok(DVec3::from(observer.curves().map(part)) / observer.y_integral())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_channels() {
        let is = |name: &str, prefix: &str, expected: f64| {
            let (p, nm) = emissive_channel(name).unwrap_or_else(|| panic!("{name}"));
            assert!(p == prefix && (nm / expected - 1.0).abs() < 1e-12, "{name}: {p} {nm}");
        };
        is("S0.550,000000nm", "", 550.0);
        is("S0.5,5E-1um", "", 550.0);
        is("S0.55e1nm", "", 550.0);
        is("S0.0,00055mm", "", 550.0);
        is("S0.500THz", "", 599.584916);
        is("S0.5E14Hz", "", 599.584916);
        is("left.S0.400nm", "left.", 400.0);
        for name in
            ["S1.550nm", "T.550,0nm", "S0", "S0.", "S0.nm", "S0.550", "S0.550xm", "S0.-5nm", "S0.0nm", "XS0.5nm"]
        {
            assert_eq!(emissive_channel(name), None, "{name}");
        }
    }

    #[test]
    fn equal_energy_has_unit_luminance() {
        // Hats sum to 1, so that any set of channels that covers the range gives the white of equal energy.
        let observer = Observer::cie_1931_2deg();
        let one = PiecewiseLinear::new(vec![400.0], vec![1.0]).unwrap();
        let expected = DVec3::from(observer.curves().map(|c| integral_of_product_2(&one, c, 360.0, 830.0)));
        for lambdas in [vec![350.0, 500.0, 840.0], (36..=83).map(|i| f64::from(i) * 10.0).collect()] {
            let sum: DVec3 = weights(&lambdas).unwrap().into_iter().sum();
            assert!(sum.abs_diff_eq(expected / observer.y_integral(), 1e-12), "{sum}");
        }
        // Half a step beyond the ends, no further.
        let narrow: DVec3 = weights(&[500.0, 510.0]).unwrap().into_iter().sum();
        let expected = integral_of_product_2(&one, observer.curves()[1], 495.0, 515.0) / observer.y_integral();
        assert!((narrow.y - expected).abs() < 1e-12);
        assert_eq!(weights(&[200.0, 210.0]).unwrap(), [DVec3::ZERO; 2]);
        assert!(weights(&[500.0]).is_err() && weights(&[500.0, 500.0]).is_err());
    }
}
