//! Correlated colour temperature by the method of Ohno \[Ohno2014\], on the scale of 1990, as colour-science computes it.
//!
//! The locus is summed at 1 nm over 360–780 nm at temperatures 0.1 % apart and less at high ones; the nearest three give
//! the result, by a triangle close to the locus and by a parabola elsewhere.

use super::{Correlated, correlated as by_definition, its_90_from_si, uv_from_xyz};
use crate::color::{Observer, thermal::RadiationConstants};
use crate::{Error, ErrorKind, Result};
use glam::{DVec2, DVec3};
use std::sync::LazyLock;

/// Range of the table, K.
const RANGE: (f64, f64) = (1000.0, 100_000.0);
/// Ratio of neighbouring temperatures at the cold end.
const SPACING: f64 = 1.001;
/// The distance from the locus at which the parabola takes over from the triangle.
const PARABOLA_FROM: f64 = 0.002;
/// Difference in temperature from which the direction of the locus is found, K.
const DIRECTION_STEP: f64 = 0.01;

static TEMPERATURES: LazyLock<Vec<f64>> = LazyLock::new(temperatures);

/// A temperature, its point of the locus and how far that is from the colour.
#[derive(Clone, Copy)]
struct Near {
    kelvin: f64,
    uv: DVec2,
    distance: f64,
}

/// Temperature (K, on the scale of 1990) and distance of CIE 1960 u, v.
///
/// # Errors
/// A chromaticity that is not finite, or not nearest to the inside of 1000 to 100 000 K.
pub fn correlated(uv: [f64; 2]) -> Result<Correlated> {
    let target = DVec2::from(uv);
    let three = nearest_three(target)?;
    let triangle = triangle(target, three);
    Ok(if triangle.duv.abs() < PARABOLA_FROM { triangle } else { parabola(three, triangle.duv.signum()) })
}

/// CIE 1960 u, v of a temperature (K, on the scale of 1990) and a distance.
///
/// # Errors
/// A temperature outside 1000 to 100 000 K, a distance that is not finite.
pub fn uv_at(kelvin: f64, duv: f64) -> Result<[f64; 2]> {
    if !(RANGE.0..=RANGE.1).contains(&kelvin) || !duv.is_finite() {
        let message = format!("{kelvin} K, Duv {duv}; expected {} to {} K and a finite distance", RANGE.0, RANGE.1);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let uv = locus(kelvin);
    let towards_red = (uv - locus(kelvin + DIRECTION_STEP)).normalize();
    Ok((uv + duv * towards_red.perp()).to_array())
}

/// CIE 1960 u, v of a Planckian radiator by sums at 1 nm over 360–780 nm.
fn locus(kelvin: f64) -> DVec2 {
    let observer = Observer::cie_1931_2deg();
    let radiance = |lambda| RadiationConstants::ITS_90.planck_radiance(lambda, kelvin);
    let xyz: DVec3 = (360..=780).map(f64::from).map(|lambda| observer.eval(lambda) * radiance(lambda)).sum();
    DVec2::from(uv_from_xyz(xyz))
}

/// The temperatures of the table: ratios fall from 1.001 to 1.0001 in proportion to the temperature.
fn temperatures() -> Vec<f64> {
    let mut list = vec![RANGE.0, RANGE.0 + 1.0];
    let (mut next, mut ratio) = (RANGE.0 + 1.0, SPACING);
    loop {
        next *= ratio;
        if next >= RANGE.1 {
            break;
        }
        list.push(next);
        let hot = ((next - RANGE.0) / (RANGE.1 - RANGE.0)).clamp(0.0, 1.0);
        ratio = SPACING * (1.0 - hot) + (1.0 + (SPACING - 1.0) / 10.0) * hot;
    }
    list.extend([RANGE.1 - 1.0, RANGE.1]);
    list
}

/// The entry of the table that is nearest to a colour, and its neighbours.
///
/// It is looked for around the temperature by definition, which saves computing the table.
fn nearest_three(target: DVec2) -> Result<[Near; 3]> {
    let list = &*TEMPERATURES;
    let last = list.len() - 1;
    let near = |i: usize| {
        let uv = locus(list[i]);
        Near { kelvin: list[i], uv, distance: uv.distance(target) }
    };
    let expected = its_90_from_si(by_definition(target.to_array())?.kelvin);
    let mut i = list.partition_point(|kelvin| *kelvin < expected).clamp(1, last - 1);
    let mut three = [near(i - 1), near(i), near(i + 1)];
    while i > 1 && three[0].distance <= three[1].distance {
        i -= 1;
        three = [near(i - 1), three[0], three[1]];
    }
    while i < last - 1 && three[2].distance < three[1].distance {
        i += 1;
        three = [three[1], three[2], near(i + 1)];
    }
    if three[0].distance <= three[1].distance || three[2].distance < three[1].distance {
        let message = format!("u, v = {}, {}; expected a colour of {} to {} K", target.x, target.y, RANGE.0, RANGE.1);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(three)
}

/// From the chord between the outer two: its point nearest to the colour.
fn triangle(target: DVec2, [before, _, after]: [Near; 3]) -> Correlated {
    let chord = after.uv - before.uv;
    let length = chord.length();
    let (d0, d1) = (before.distance, after.distance);
    let along = (d0 * d0 - d1 * d1 + length * length) / (2.0 * length);
    let foot = before.uv + chord * (along / length);
    let distance = (d0 * d0 - along * along).max(0.0).sqrt();
    let kelvin = before.kelvin + (after.kelvin - before.kelvin) * (along / length);
    Correlated { kelvin, duv: if target.y >= foot.y { distance } else { -distance } }
}

/// The least distance of the parabola through the three, with a sign.
fn parabola([before, at, after]: [Near; 3], sign: f64) -> Correlated {
    // In temperatures relative to the middle one: d(x) = at + b x + a x².
    let (x0, x1) = (before.kelvin - at.kelvin, after.kelvin - at.kelvin);
    let (s0, s1) = ((before.distance - at.distance) / x0, (after.distance - at.distance) / x1);
    let a = (s1 - s0) / (x1 - x0);
    let b = s0 - a * x0;
    let x = -b / (2.0 * a);
    Correlated { kelvin: at.kelvin + x, duv: sign * (at.distance + 0.5 * b * x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_definition() {
        for kelvin in [1700.0, 2856.0, 6504.0, 20_000.0] {
            for duv in [-0.02, -0.001, 0.0, 0.001, 0.02] {
                let found = correlated(super::super::uv_at(kelvin, duv).unwrap()).unwrap();
                let error = found.kelvin - its_90_from_si(kelvin);
                // Sums at 1 nm over 360–780 nm are not integrals; the table itself is good for 0.06 K.
                assert!(error.abs() < 0.06 + 3e-5 * kelvin, "{kelvin} {duv}: {error}");
                assert!((found.duv - duv).abs() < 1e-6, "{kelvin} {duv}: {}", found.duv);
            }
        }
    }

    #[test]
    fn there_and_back() {
        for (kelvin, duv) in [(1500.0, 0.01), (4000.0, -0.01), (12_000.0, 0.005)] {
            let back = correlated(uv_at(kelvin, duv).unwrap()).unwrap();
            assert!((back.kelvin - kelvin).abs() < 0.05 && (back.duv - duv).abs() < 1e-7, "{back:?}");
        }
        for kelvin in [999.0, 100_001.0, f64::NAN] {
            assert_eq!(uv_at(kelvin, 0.0).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        for uv in [[0.16, 0.24], [0.6, 0.34]] {
            assert_eq!(correlated(uv).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
