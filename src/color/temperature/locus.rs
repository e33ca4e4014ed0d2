//! The Planckian locus of an observer, and the point of it that is nearest to a chromaticity.

use super::Correlated;
use crate::color::{Observer, thermal::RadiationConstants};
use crate::{Error, ErrorKind, Result, math};
use glam::{DVec2, DVec3};
use std::sync::LazyLock;

/// Range of reciprocal temperature, 10⁶/K: 1 000 000 K to 500 K.
const MIRED_RANGE: (f64, f64) = (1.0, 2000.0);
/// Step of the table in which the search begins, 10⁶/K.
const COARSE_STEP: f64 = 8.0;
/// Newton's method ends when its step is this part of the reciprocal temperature.
const NEWTON_STEP: f64 = 1e-12;
/// Steps after which halving alone would have reached [`NEWTON_STEP`].
const NEWTON_LIMIT: usize = 64;
/// Abscissa, in half cells, and weights, in cells, of three-point Gauss–Legendre quadrature.
const GAUSS_ABSCISSA: f64 = 0.774_596_669_241_483_4;
const GAUSS_WEIGHTS: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];

static CIE_1931_2DEG: LazyLock<PlanckianLocus> = LazyLock::new(|| PlanckianLocus::new(Observer::cie_1931_2deg()));

/// The chromaticities of Planckian radiators for an observer, by the exact constants of the SI.
///
/// Tristimulus values are integrated by Gauss quadrature in each cell of the observer's table, with an error below
/// rounding. Everything is done in reciprocal temperature, in which the locus has no ends of its own.
#[derive(Debug, Clone)]
pub struct PlanckianLocus {
    nodes: Vec<Node>,
    coarse: Vec<DVec2>,
}

/// A wavelength and x̄, ȳ, z̄ there, times the quadrature's weight and λ⁻⁴.
#[derive(Debug, Clone, Copy)]
struct Node {
    lambda_nm: f64,
    weights: DVec3,
}

/// A point of the locus and its first two derivatives in reciprocal temperature.
struct Motion {
    uv: DVec2,
    velocity: DVec2,
    acceleration: DVec2,
}

impl PlanckianLocus {
    /// The locus of an observer.
    pub fn new(observer: &Observer) -> Self {
        let knots = observer.curves()[0].lambdas_nm();
        let nodes: Vec<Node> = knots.windows(2).flat_map(|cell| nodes_of_cell(cell[0], cell[1], observer)).collect();
        let mut locus = Self { nodes, coarse: Vec::new() };
        let steps = ((MIRED_RANGE.1 - MIRED_RANGE.0) / COARSE_STEP).ceil() as usize;
        locus.coarse = (0..=steps).map(|i| locus.uv_of_mired(coarse_mired(i, steps))).collect();
        locus
    }

    /// The locus of the CIE 1931 standard observer, for which correlated colour temperatures are defined.
    pub fn cie_1931_2deg() -> &'static PlanckianLocus {
        &CIE_1931_2DEG
    }

    /// CIE 1960 u, v of a Planckian radiator.
    ///
    /// # Errors
    /// A temperature that is not between 500 and 1 000 000 K.
    pub fn uv(&self, kelvin: f64) -> Result<[f64; 2]> {
        Ok(self.uv_of_mired(mired_of(kelvin)?).to_array())
    }

    /// CIE 1960 u, v at a distance from the radiator's, towards green if positive: the inverse of
    /// [`PlanckianLocus::correlated`].
    ///
    /// # Errors
    /// A temperature that is not between 500 and 1 000 000 K, a distance that is not finite.
    pub fn uv_at(&self, kelvin: f64, duv: f64) -> Result<[f64; 2]> {
        if !duv.is_finite() {
            return Err(Error::new(ErrorKind::NotFinite, format!("Duv {duv}; expected a finite number")));
        }
        let Motion { uv, velocity, .. } = self.motion(mired_of(kelvin)?);
        Ok((uv + duv * velocity.normalize().perp()).to_array())
    }

    /// Temperature of the radiator whose CIE 1960 u, v are nearest, and the distance to it.
    ///
    /// By Newton's method on the definition, begun at the nearest of 251 points of the locus; within 1e-6 K of it up to
    /// 25 000 K. The CIE uses the result only up to a distance of 0.05 \[CIE15\], which is not checked.
    ///
    /// # Errors
    /// A chromaticity that is not finite, or whose nearest point is an end of the range 500 to 1 000 000 K.
    pub fn correlated(&self, uv: [f64; 2]) -> Result<Correlated> {
        let target = DVec2::from(uv);
        if !target.is_finite() {
            let message = format!("u, v = {}, {}; expected finite numbers", uv[0], uv[1]);
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        let (low, start, high) = self.bracket(target);
        let mired = self.nearest_mired(target, low, start, high);
        if mired <= MIRED_RANGE.0 || mired >= MIRED_RANGE.1 {
            let message = format!(
                "u, v = {}, {} is nearest to an end of the Planckian locus; expected a colour between 500 and 1000000 K",
                uv[0], uv[1]
            );
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let Motion { uv, velocity, .. } = self.motion(mired);
        let duv = (target - uv).dot(velocity.normalize().perp());
        Ok(Correlated { kelvin: 1e6 / mired, duv })
    }

    /// Reciprocal temperatures around and at the nearest point of the table.
    fn bracket(&self, target: DVec2) -> (f64, f64, f64) {
        let last = self.coarse.len() - 1;
        let distance = |i: &usize| self.coarse[*i].distance_squared(target);
        let nearest = (0..=last).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
        let mired = |i| coarse_mired(i, last);
        (mired(nearest.saturating_sub(1)), mired(nearest), mired((nearest + 1).min(last)))
    }

    /// The zero of ½ d|p − q|²/dm inside a bracket: Newton's method, or halving where it would leave the bracket.
    fn nearest_mired(&self, target: DVec2, mut low: f64, start: f64, mut high: f64) -> f64 {
        let mut mired = start;
        for _ in 0..NEWTON_LIMIT {
            let Motion { uv, velocity, acceleration } = self.motion(mired);
            let slope = (uv - target).dot(velocity);
            if slope > 0.0 {
                high = mired;
            } else {
                low = mired;
            }
            let newton = mired - slope / (velocity.length_squared() + (uv - target).dot(acceleration));
            let next = if low <= newton && newton <= high { newton } else { 0.5 * (low + high) };
            let step = (next - mired).abs();
            mired = next;
            if step <= NEWTON_STEP * mired {
                break;
            }
        }
        mired
    }

    fn uv_of_mired(&self, mired: f64) -> DVec2 {
        let c = RadiationConstants::SI_2019.c2 * 1e3 * mired;
        let xyz: DVec3 = self.nodes.iter().map(|node| node.weights * planck_shape(c / node.lambda_nm)[0]).sum();
        DVec2::from(super::uv_from_xyz(xyz))
    }

    fn motion(&self, mired: f64) -> Motion {
        let per_mired = RadiationConstants::SI_2019.c2 * 1e3;
        let [mut value, mut first, mut second] = [DVec3::ZERO; 3];
        for node in &self.nodes {
            let rate = per_mired / node.lambda_nm;
            let [b, b1, b2] = planck_shape(rate * mired);
            value += node.weights * b;
            first += node.weights * (b1 * rate);
            second += node.weights * (b2 * rate * rate);
        }
        motion_in_uv(value, first, second)
    }
}

/// A temperature in K as reciprocal temperature.
fn mired_of(kelvin: f64) -> Result<f64> {
    let mired = 1e6 / kelvin;
    if (MIRED_RANGE.0..=MIRED_RANGE.1).contains(&mired) {
        return Ok(mired);
    }
    Err(Error::new(ErrorKind::OutOfRange, format!("temperature {kelvin} K; expected 500 to 1000000 K")))
}

/// Reciprocal temperature of a point of the table; both ends are exact.
fn coarse_mired(i: usize, last: usize) -> f64 {
    MIRED_RANGE.0 + (MIRED_RANGE.1 - MIRED_RANGE.0) * (i as f64 / last as f64)
}

fn nodes_of_cell(from_nm: f64, to_nm: f64, observer: &Observer) -> [Node; 3] {
    let (middle, half) = (0.5 * (from_nm + to_nm), 0.5 * (to_nm - from_nm));
    [0, 1, 2].map(|i| {
        let lambda_nm = middle + half * GAUSS_ABSCISSA * (i as f64 - 1.0);
        // λ in units of 500 nm: numbers near 1.
        let scaled_2 = (lambda_nm / 500.0) * (lambda_nm / 500.0);
        let weight = 2.0 * half * GAUSS_WEIGHTS[i] / (scaled_2 * scaled_2);
        Node { lambda_nm, weights: observer.eval(lambda_nm) * weight }
    })
}

/// B = x / (eˣ − 1) and its first two derivatives; Planck's law is proportional to B(c₂/λT) T / λ⁴.
fn planck_shape(x: f64) -> [f64; 3] {
    let e = math::exp_m1(x);
    let b = x / e;
    let ratio = (1.0 - b) / e;
    let first = ratio - b;
    [b, first, -(1.0 + 1.0 / e) * (first + ratio)]
}

/// CIE 1960 u, v and derivatives from XYZ and derivatives: u = 4X/s, v = 6Y/s with s = X + 15Y + 3Z.
fn motion_in_uv(value: DVec3, first: DVec3, second: DVec3) -> Motion {
    let sum = |xyz: DVec3| xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    let numerator = |xyz: DVec3| DVec2::new(4.0 * xyz.x, 6.0 * xyz.y);
    let s = sum(value);
    let uv = numerator(value) / s;
    // n = uv s, so n' = uv' s + uv s' and n'' = uv'' s + 2 uv' s' + uv s''.
    let velocity = (numerator(first) - uv * sum(first)) / s;
    let acceleration = (numerator(second) - 2.0 * velocity * sum(first) - uv * sum(second)) / s;
    Motion { uv, velocity, acceleration }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{illuminant, xyz_of_emission};
    use crate::spectrum::Spectrum;
    use proptest::prelude::*;

    #[test]
    fn the_locus_is_that_of_tabulated_blackbodies() {
        for kelvin in [1000.0, 2856.0, 6500.0, 25_000.0, 1e6] {
            let xyz = xyz_of_emission(&Spectrum::blackbody(kelvin).unwrap(), Observer::cie_1931_2deg());
            let tabulated = DVec2::from(super::super::uv_from_xyz(xyz));
            let exact = DVec2::from(PlanckianLocus::cie_1931_2deg().uv(kelvin).unwrap());
            assert!(tabulated.distance(exact) < 1e-6, "{kelvin}: {tabulated} {exact}");
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let locus = PlanckianLocus::cie_1931_2deg();
        for mired in [2.0, 40.0, 154.0, 500.0, 1500.0] {
            let h = 1e-3 * mired;
            let [before, at, after] = [mired - h, mired, mired + h].map(|m| locus.motion(m));
            let velocity = (after.uv - before.uv) / (2.0 * h);
            let acceleration = (after.velocity - before.velocity) / (2.0 * h);
            assert!(velocity.distance(at.velocity) < 1e-5 * velocity.length(), "{mired}");
            assert!(acceleration.distance(at.acceleration) < 1e-4 * acceleration.length(), "{mired}");
        }
    }

    #[test]
    fn daylight_and_tungsten() {
        let correlated = |name: &str| {
            let xyz = xyz_of_emission(&illuminant::by_name(name).unwrap(), Observer::cie_1931_2deg());
            PlanckianLocus::cie_1931_2deg().correlated(super::super::uv_from_xyz(xyz)).unwrap()
        };
        // Temperatures of CIE 15, on the scale of 1990.
        for (name, kelvin, within) in
            [("A", 2856.0, 1.0), ("D50", 5003.0, 2.0), ("D65", 6504.0, 2.0), ("D75", 7504.0, 3.0)]
        {
            let found = super::super::its_90_from_si(correlated(name).kelvin);
            assert!((found - kelvin).abs() < within, "{name}: {found}");
        }
        assert!((correlated("D65").duv - 0.0032).abs() < 1e-4 && correlated("A").duv.abs() < 1e-5);
    }

    #[test]
    fn other_observers_have_their_own_locus() {
        let ten = PlanckianLocus::new(Observer::by_name("2015-10").unwrap());
        let (two, ten) = (PlanckianLocus::cie_1931_2deg().uv(6500.0).unwrap(), ten.uv(6500.0).unwrap());
        assert!(DVec2::from(two).distance(DVec2::from(ten)) > 1e-4);
    }

    #[test]
    fn says_what_is_out_of_range() {
        let locus = PlanckianLocus::cie_1931_2deg();
        for kelvin in [499.9, 1.1e6, 0.0, -6500.0, f64::NAN, f64::INFINITY] {
            assert_eq!(locus.uv(kelvin).unwrap_err().kind, ErrorKind::OutOfRange, "{kelvin}");
        }
        assert_eq!(locus.uv_at(6500.0, f64::NAN).unwrap_err().kind, ErrorKind::NotFinite);
        assert_eq!(locus.correlated([f64::NAN, 0.3]).unwrap_err().kind, ErrorKind::NotFinite);
        // Bluer than an infinitely hot body, redder than one of 500 K.
        for uv in [[0.16, 0.24], [0.9, 0.3]] {
            assert_eq!(locus.correlated(uv).unwrap_err().kind, ErrorKind::OutOfRange, "{uv:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn there_and_back(mired in 40.0..600.0_f64, duv in -0.03..0.03_f64) {
            let locus = PlanckianLocus::cie_1931_2deg();
            let kelvin = 1e6 / mired;
            let back = locus.correlated(locus.uv_at(kelvin, duv).unwrap()).unwrap();
            prop_assert!((back.kelvin - kelvin).abs() < 1e-6, "{} {}", kelvin, back.kelvin);
            prop_assert!((back.duv - duv).abs() < 1e-14, "{} {}", duv, back.duv);
        }
    }
}
