//! Maps from the unit square to directions and discs that keep areas in proportion and neighbours together.

use crate::math;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_4, TAU};

/// Uniform points on the unit disc \[ShirleyChiu1997\].
#[inline]
pub fn concentric_disk(u: [f32; 2]) -> [f32; 2] {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    // The wedges about the y axis are those about the x axis with the axes exchanged. Selected, not branched over: which
    // wedge it is cannot be foreseen.
    let about_x = a.abs() > b.abs();
    let (radius, across) = if about_x { (a, b) } else { (b, a) };
    let ratio = if radius == 0.0 { 0.0 } else { across / radius };
    let (sin, cos) = math::sin_cos_eighth_turns(ratio);
    let (along, across) = (radius * cos, radius * sin);
    if about_x { [along, across] } else { [across, along] }
}

/// The numbers from which [`concentric_disk`] makes a point of the unit disc; clamped to the unit square.
pub fn concentric_disk_inverse([x, y]: [f32; 2]) -> [f32; 2] {
    let radius = (x * x + y * y).sqrt();
    // The map works on wedges of 45° about the axes; the angle is measured from the nearest.
    let angle_from = |across: f32, along: f32| math::atan2(f64::from(across), f64::from(along)) as f32 / FRAC_PI_4;
    let (a, b) = if x.abs() > y.abs() {
        let a = radius.copysign(x);
        (a, a * angle_from(y * x.signum(), x.abs()))
    } else {
        let b = radius.copysign(y);
        (b * angle_from(x * y.signum(), y.abs()), b)
    };
    [a, b].map(|c| (0.5 * (c + 1.0)).clamp(0.0, 1.0))
}

/// Directions about +z with density cos θ / π. Never exactly horizontal.
#[inline]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let [x, y] = concentric_disk(u);
    let z = (1.0 - x * x - y * y).max(f32::EPSILON * f32::EPSILON).sqrt();
    Vec3::new(x, y, z)
}

/// Uniform directions on the unit sphere, density 1 / 4π.
pub fn uniform_sphere(u: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u[0];
    around_z(z, (1.0 - z * z).max(0.0).sqrt(), u[1])
}

/// Uniform directions in the cone about +z whose half angle θ has 1 − cos θ = `one_minus_cos`; density
/// 1 / (2π `one_minus_cos`). The cone is given by 1 − cos θ since narrow ones (the sun: 1.1e-5) need its digits.
pub fn uniform_cone(u: [f32; 2], one_minus_cos: f32) -> Vec3 {
    let h = u[0] * one_minus_cos;
    around_z(1.0 - h, (h * (2.0 - h)).max(0.0).sqrt(), u[1])
}

/// The numbers from which [`uniform_cone`] makes a unit direction; clamped to the unit square.
pub fn uniform_cone_inverse(direction: Vec3, one_minus_cos: f32) -> [f32; 2] {
    // 1 − z = (x² + y²) / (1 + z), without cancellation.
    let h = (direction.x * direction.x + direction.y * direction.y) / (1.0 + direction.z);
    let turn = math::atan2(f64::from(direction.y), f64::from(direction.x)) as f32 / TAU;
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    [(h / one_minus_cos).clamp(0.0, 1.0), turn.clamp(0.0, 1.0)]
}

/// A unit vector of height `z` and distance `radius` from the z axis, `turn` of the way around it.
fn around_z(z: f32, radius: f32, turn: f32) -> Vec3 {
    let (sin, cos) = math::sin_cos_turns(turn);
    Vec3::new(radius * cos, radius * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sobol;

    #[test]
    fn inverses() {
        let sobol = Sobol::new(4);
        for i in 0..4096 {
            let u = sobol.group(i, 0);
            for (u, back) in [
                ([u[0], u[1]], concentric_disk_inverse(concentric_disk([u[0], u[1]]))),
                ([u[2], u[3]], uniform_cone_inverse(uniform_cone([u[2], u[3]], 0.3), 0.3)),
                ([u[4], u[5]], uniform_cone_inverse(uniform_cone([u[4], u[5]], 1e-5), 1e-5)),
            ] {
                assert!((u[0] - back[0]).abs() < 1e-5 && (u[1] - back[1]).abs() < 1e-5, "{u:?} {back:?}");
            }
        }
    }

    fn mean(f: impl Fn([f32; 2]) -> f64) -> f64 {
        let sobol = Sobol::new(11);
        let n = 1 << 14;
        (0..n).map(|i| sobol.group(i, 0)).map(|p| f([p[0], p[1]])).sum::<f64>() / n as f64
    }

    /// Moments of each density against closed forms.
    #[test]
    fn moments() {
        assert!((mean(|u| f64::from(cosine_hemisphere(u).z)) - 2.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| f64::from(cosine_hemisphere(u).x).abs()) - 4.0 / (3.0 * std::f64::consts::PI)).abs() < 1e-3);
        assert!(mean(|u| f64::from(uniform_sphere(u).z)).abs() < 1e-3);
        assert!((mean(|u| f64::from(uniform_sphere(u).y).abs()) - 0.5).abs() < 1e-3);
        let h = 0.25;
        assert!((mean(|u| f64::from(uniform_cone(u, h).z)) - (1.0 - f64::from(h) / 2.0)).abs() < 1e-4);
        let [x2, y2] = [0, 1].map(|k| mean(|u| f64::from(concentric_disk(u)[k]) * f64::from(concentric_disk(u)[k])));
        assert!((x2 - 0.25).abs() < 1e-3 && (y2 - 0.25).abs() < 1e-3);
    }

    #[test]
    fn unit_length() {
        let sobol = Sobol::new(4);
        for i in 0..10_000 {
            let p = sobol.group(i, 0);
            let n = uniform_sphere([p[0], p[1]]);
            assert!((n.length() - 1.0).abs() < 1e-6);
            assert!((uniform_cone([p[2], p[3]], 1e-5).length() - 1.0).abs() < 1e-6);
        }
    }
}
