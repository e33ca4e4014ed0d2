//! Correlated colour temperature between the isotemperature lines of Robertson \[Robertson1968\].

use super::Correlated;
use crate::{Error, ErrorKind, Result};
use glam::DVec2;

/// Reciprocal temperature in 10⁶/K, u, v and slope of 31 isotemperature lines \[Robertson1968\]; u at 325 with the
/// correction of a misprint, 0.24702, that is customary.
const LINES: [[f64; 4]; 31] = [
    [0.0, 0.18006, 0.26352, -0.24341],
    [10.0, 0.18066, 0.26589, -0.25479],
    [20.0, 0.18133, 0.26846, -0.26876],
    [30.0, 0.18208, 0.27119, -0.28539],
    [40.0, 0.18293, 0.27407, -0.30470],
    [50.0, 0.18388, 0.27709, -0.32675],
    [60.0, 0.18494, 0.28021, -0.35156],
    [70.0, 0.18611, 0.28342, -0.37915],
    [80.0, 0.18740, 0.28668, -0.40955],
    [90.0, 0.18880, 0.28997, -0.44278],
    [100.0, 0.19032, 0.29326, -0.47888],
    [125.0, 0.19462, 0.30141, -0.58204],
    [150.0, 0.19962, 0.30921, -0.70471],
    [175.0, 0.20525, 0.31647, -0.84901],
    [200.0, 0.21142, 0.32312, -1.0182],
    [225.0, 0.21807, 0.32909, -1.2168],
    [250.0, 0.22511, 0.33439, -1.4512],
    [275.0, 0.23247, 0.33904, -1.7298],
    [300.0, 0.24010, 0.34308, -2.0637],
    [325.0, 0.24792, 0.34655, -2.4681],
    [350.0, 0.25591, 0.34951, -2.9641],
    [375.0, 0.26400, 0.35200, -3.5814],
    [400.0, 0.27218, 0.35407, -4.3633],
    [425.0, 0.28039, 0.35577, -5.3762],
    [450.0, 0.28863, 0.35714, -6.7262],
    [475.0, 0.29685, 0.35823, -8.5955],
    [500.0, 0.30505, 0.35907, -11.324],
    [525.0, 0.31320, 0.35968, -15.628],
    [550.0, 0.32129, 0.36011, -23.325],
    [575.0, 0.32931, 0.36038, -40.770],
    [600.0, 0.33724, 0.36051, -116.45],
];

/// A line: reciprocal temperature, where it meets the locus, and its direction, away from green.
#[derive(Clone, Copy)]
struct Line {
    mired: f64,
    uv: DVec2,
    direction: DVec2,
}

impl Line {
    fn at(i: usize) -> Self {
        let [mired, u, v, slope] = LINES[i];
        Self { mired, uv: DVec2::new(u, v), direction: DVec2::new(1.0, slope).normalize() }
    }

    /// Distance of a colour from the isotherm, positive on its hot side.
    fn distance_of(&self, uv: DVec2) -> f64 {
        self.direction.perp_dot(uv - self.uv)
    }

    /// Between two lines, `share` of the way to the other.
    fn towards(self, other: Self, share: f64) -> Self {
        Self {
            mired: self.mired + (other.mired - self.mired) * share,
            uv: self.uv.lerp(other.uv, share),
            direction: self.direction.lerp(other.direction, share).normalize(),
        }
    }
}

/// Temperature (K) and distance of CIE 1960 u, v; within 2 K below 20 000 K \[Robertson1968\].
///
/// # Errors
/// A colour that does not lie between the lines of 1667 and 100 000 K, or is not finite.
pub fn correlated(uv: [f64; 2]) -> Result<Correlated> {
    let target = DVec2::from(uv);
    let behind = (1..LINES.len()).find(|&i| Line::at(i).distance_of(target) <= 0.0);
    let out_of_range = || {
        let message = format!("u, v = {}, {}; expected a colour of 1667 to 100000 K", uv[0], uv[1]);
        Error::new(ErrorKind::OutOfRange, message)
    };
    let i = behind.ok_or_else(out_of_range)?;
    let (before, after) = (Line::at(i - 1), Line::at(i));
    let (d0, d1) = (before.distance_of(target), -after.distance_of(target));
    // The first line of the table, of an infinite temperature, is there to find the way only.
    let line = match i {
        1 if d1 > 0.0 => return Err(out_of_range()),
        1 => after,
        _ => before.towards(after, d0 / (d0 + d1)),
    };
    Ok(Correlated { kelvin: 1e6 / line.mired, duv: -(target - line.uv).dot(line.direction) })
}

/// CIE 1960 u, v of a temperature in K and a distance.
///
/// # Errors
/// A temperature below 1667 K (600 mired) or not finite, a distance that is not finite.
pub fn uv_at(kelvin: f64, duv: f64) -> Result<[f64; 2]> {
    let mired = 1e6 / kelvin;
    if !(kelvin.is_finite() && duv.is_finite() && (0.0..=600.0).contains(&mired)) {
        let message = format!("{kelvin} K, Duv {duv}; expected at least 1667 K and a finite distance");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let i = (1..LINES.len() - 1).find(|&i| mired < LINES[i][0]).unwrap_or(LINES.len() - 1);
    let (before, after) = (Line::at(i - 1), Line::at(i));
    let line = before.towards(after, (mired - before.mired) / (after.mired - before.mired));
    Ok((line.uv - line.direction * duv).to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_definition() {
        for kelvin in [1700.0, 2856.0, 6504.0, 15_000.0] {
            for duv in [-0.01, 0.0, 0.01] {
                let found = correlated(super::super::uv_at(kelvin, duv).unwrap()).unwrap();
                assert!((found.kelvin - kelvin).abs() < 2e-3 * kelvin, "{kelvin} {duv}: {found:?}");
                assert!((found.duv - duv).abs() < 1e-4, "{kelvin} {duv}: {found:?}");
            }
        }
    }

    #[test]
    fn there_and_back() {
        for (kelvin, duv) in [(1700.0, 0.0), (2500.0, 0.02), (10_000.0, 0.0), (40_000.0, -0.01)] {
            let back = correlated(uv_at(kelvin, duv).unwrap()).unwrap();
            assert!((back.kelvin / kelvin - 1.0).abs() < 3e-3 && (back.duv - duv).abs() < 1e-5, "{back:?}");
        }
        for kelvin in [1600.0, -5.0, f64::NAN, f64::INFINITY] {
            assert_eq!(uv_at(kelvin, 0.0).unwrap_err().kind, ErrorKind::OutOfRange, "{kelvin}");
        }
        for uv in [[0.17, 0.25], [0.5, 0.36], [f64::NAN, 0.3]] {
            assert_eq!(correlated(uv).unwrap_err().kind, ErrorKind::OutOfRange, "{uv:?}");
        }
    }
}
