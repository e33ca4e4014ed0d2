//! Reflection at a smooth metal.

/// Fresnel reflectance of unpolarised light that arrives with `cos_theta_i` in [0, 1] in a medium of index `eta_i` at a
/// metal of complex index `eta + i k` [BornWolf1999, 14.2]. All three indices are absolute (relative to air).
pub fn fresnel_conductor(cos_theta_i: f64, eta_i: f64, eta: f64, k: f64) -> f64 {
    let (n, k) = (eta / eta_i, k / eta_i);
    let cos2 = cos_theta_i * cos_theta_i;
    let sin2 = 1.0 - cos2;
    // a² + b² and a, where a + i b = √(m² − sin²θ), m = n + i k.
    let real = n * n - k * k - sin2;
    let squares = (real * real + 4.0 * n * n * k * k).sqrt();
    let a = (0.5 * (squares + real)).max(0.0).sqrt();
    let (sum_s, cross_s) = (squares + cos2, 2.0 * a * cos_theta_i);
    let r_s = (sum_s - cross_s) / (sum_s + cross_s);
    // |r_p|² = |r_s|² · |cos θ (a + i b) − sin²θ|² / |cos θ (a + i b) + sin²θ|²
    let (sum_p, cross_p) = (cos2 * squares + sin2 * sin2, cross_s * sin2);
    let r_p = r_s * (sum_p - cross_p) / (sum_p + cross_p);
    if sum_s + cross_s == 0.0 || sum_p + cross_p == 0.0 {
        return 1.0;
    }
    (0.5 * (r_s + r_p)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math;

    /// Complex arithmetic, straight from the textbook.
    fn textbook(c: f64, n: f64, k: f64) -> f64 {
        type C = (f64, f64);
        let mul = |a: C, b: C| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let abs2 = |a: C| a.0 * a.0 + a.1 * a.1;
        let sqrt = |a: C| {
            let r = abs2(a).sqrt();
            (((r + a.0) / 2.0).max(0.0).sqrt(), ((r - a.0) / 2.0).max(0.0).sqrt().copysign(a.1))
        };
        let m = (n, k);
        let m2 = mul(m, m);
        let root = sqrt((m2.0 - (1.0 - c * c), m2.1));
        let r_s = abs2((c - root.0, -root.1)) / abs2((c + root.0, root.1));
        let r_p = abs2((m2.0 * c - root.0, m2.1 * c - root.1)) / abs2((m2.0 * c + root.0, m2.1 * c + root.1));
        0.5 * (r_s + r_p)
    }

    #[test]
    fn against_complex_arithmetic() {
        for (n, k) in [(0.05, 4.2), (0.2, 3.0), (1.5, 7.0), (2.9, 3.1), (0.97, 1.87)] {
            for i in 0..=1000 {
                let c = math::cos(std::f64::consts::FRAC_PI_2 * f64::from(i) / 1000.0).max(0.0);
                let f = fresnel_conductor(c, 1.0, n, k);
                assert!((f - textbook(c, n, k)).abs() < 1e-12, "{n} {k} {c}: {f} {}", textbook(c, n, k));
            }
        }
    }

    /// With k = 0 a metal is a dielectric; under water the ratio of indices counts.
    #[test]
    fn limits() {
        for i in 0..=100 {
            let c = f64::from(i) / 100.0;
            let dielectric = crate::optics::refract(c, 1.33, 1.7).map_or(1.0, |r| r.reflectance);
            assert!((fresnel_conductor(c, 1.33, 1.7, 0.0) - dielectric).abs() < 1e-12);
        }
        assert_eq!(fresnel_conductor(0.0, 1.0, 0.2, 3.0), 1.0);
    }
}
