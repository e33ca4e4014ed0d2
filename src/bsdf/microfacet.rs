//! Rough surfaces as mirrors too small to see: facets whose normals have the distribution GGX \[Walter2007\] and hide each
//! other as Smith's uncorrelated surfaces do, with heights that correlate \[Heitz2014\]. In f64: lobes of α = 10⁻⁴ are
//! narrower than what is left of f32 after half vectors have been taken.

use crate::math;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The distribution of facet normals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ggx {
    alpha: f64,
}

impl Ggx {
    /// Facets narrower than this are smooth: directions are f32, and the lobe would be no wider than some hundred of them.
    pub const SMOOTHEST: f64 = 1e-4;

    /// Of roughness α in [[`Self::SMOOTHEST`], 1]: the root mean square of slopes would be α if it existed.
    pub fn new(alpha: f32) -> Self {
        Self { alpha: f64::from(alpha) }
    }

    /// The roughness.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Area of facets with the unit normal `m`, per area of the surface with unit `normal` and per solid angle, so that
    /// ∫ D (m·n) dm = 1.
    pub fn density(&self, normal: DVec3, m: DVec3) -> f64 {
        let cos = m.dot(normal);
        if cos <= 0.0 {
            return 0.0;
        }
        // α² / (π (cos²θ (α² − 1) + 1)²), with sin²θ where small angles keep their digits.
        let alpha2 = self.alpha * self.alpha;
        let spread = m.cross(normal).length_squared() + alpha2 * cos * cos;
        alpha2 / (PI * spread * spread)
    }

    /// Smith's Λ for a unit direction with this cosine to the surface's normal: the facets that hide others per facet that
    /// is seen.
    pub fn lambda(&self, cos: f64) -> f64 {
        // Directions are f32: nothing is known of cosines below their rounding.
        let cos2 = (cos * cos).max(1e-16);
        let x = self.alpha * self.alpha * (1.0 - cos2).max(0.0) / cos2;
        // (√(1 + x) − 1) / 2
        0.5 * x / (1.0 + (1.0 + x).sqrt())
    }

    /// Density per solid angle of the facets' normals `m` as they are seen from `wo`: G₁ (wo·m) D / (wo·n). What
    /// [`Self::sample_visible`] draws.
    #[cfg(test)]
    fn visible_density(&self, normal: DVec3, wo: DVec3, m: DVec3) -> f64 {
        let cos = wo.dot(normal);
        wo.dot(m).max(0.0) * self.density(normal, m) / ((1.0 + self.lambda(cos)) * cos)
    }

    /// Draws the normal of a facet that is seen from the unit `wo`, which is on the side of the unit `normal`: with the
    /// slopes stretched the facets are a hemisphere, of which a shifted cap of the sphere gives the halfway vectors
    /// \[DupuyBenyoub2023\].
    pub(crate) fn sample_visible(&self, normal: DVec3, wo: DVec3, u: [f32; 2]) -> DVec3 {
        let (s, t) = normal.any_orthonormal_pair();
        let view = DVec3::new(self.alpha * wo.dot(s), self.alpha * wo.dot(t), wo.dot(normal)).normalize();
        let phi = TAU * f64::from(u[0]);
        let v = f64::from(u[1]);
        let z = (1.0 - v) * (1.0 + view.z) - view.z;
        let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        let half = view + DVec3::new(radius * math::cos(phi), radius * math::sin(phi), z);
        (s * (self.alpha * half.x) + t * (self.alpha * half.y) + normal * half.z.max(f64::MIN_POSITIVE)).normalize()
    }
}

/// Share of the facets seen from a direction with `lambda_o` that is also lit along one with `lambda_i`: G₂ / G₁(wo) of
/// Smith with correlated heights. Reflected light climbs from where it has come down, 1 / (1 + Λₒ + Λᵢ); refracted light
/// leaves on the other side, where what is high is deep: Euler's B(1 + Λₒ, 1 + Λᵢ) \[Heitz2014\].
pub(crate) fn lit_of_visible(lambda_o: f64, lambda_i: f64, crosses: bool) -> f64 {
    let (a, b) = (1.0 + lambda_o, 1.0 + lambda_i);
    if crosses {
        // Γ(a) Γ(b) / Γ(a + b) · a
        math::exp(math::ln_gamma(a) + math::ln_gamma(b) - math::ln_gamma(a + b)) * a
    } else {
        a / (a + lambda_i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sobol;

    const ALPHAS: [f32; 5] = [1e-4, 0.01, 0.1, 0.5, 1.0];

    fn normal() -> DVec3 {
        DVec3::new(0.3, -0.8, 0.5).normalize()
    }

    fn directions() -> [DVec3; 4] {
        let (s, t) = normal().any_orthonormal_pair();
        [0.0, 0.7, 1.3, 1.565]
            .map(|theta| (normal() * math::cos(theta) + (s * 0.6 + t * 0.8) * math::sin(theta)).normalize())
    }

    /// ∫ f(m) dm over the hemisphere, m by tan θ = α r: equal steps of r / (1 + r), finest where D has its weight.
    fn over_facets(alpha: f32, f: impl Fn(DVec3) -> f64) -> f64 {
        let (s, t) = normal().any_orthonormal_pair();
        let alpha = f64::from(alpha);
        let (n, turns) = (1000, 32);
        let mut sum = 0.0;
        for i in 0..n {
            let x = (f64::from(i) + 0.5) / f64::from(n);
            let tan = alpha * x / (1.0 - x);
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            // dω = sin θ dθ dφ, dθ = cos²θ d(tan θ)
            let ring = tan * cos * cos * cos * alpha / ((1.0 - x) * (1.0 - x)) / f64::from(n);
            for j in 0..turns {
                let phi = TAU * (f64::from(j) + 0.5) / f64::from(turns);
                let m = normal() * cos + (s * math::cos(phi) + t * math::sin(phi)) * (tan * cos);
                sum += f(m.normalize()) * ring * TAU / f64::from(turns);
            }
        }
        sum
    }

    /// Facets project to the surface, and what is seen of them to the projected surface: the condition from which Smith's
    /// masking follows.
    #[test]
    fn projected_areas() {
        for alpha in ALPHAS {
            let ggx = Ggx::new(alpha);
            let area = over_facets(alpha, |m| ggx.density(normal(), m) * m.dot(normal()));
            assert!((area - 1.0).abs() < 1e-4, "{alpha}: {area}");
            for wo in directions() {
                let seen = over_facets(alpha, |m| ggx.visible_density(normal(), wo, m));
                assert!((seen - 1.0).abs() < 2e-3, "{alpha} {wo}: {seen}");
            }
        }
    }

    /// Moments of samples against quadrature: of slopes across and along, bounded so that they have a variance.
    #[test]
    fn samples_have_the_visible_density() {
        let sobol = Sobol::new(3);
        let n = 1 << 12;
        for alpha in ALPHAS {
            let ggx = Ggx::new(alpha);
            for wo in directions() {
                let moment = |m: DVec3, k: usize| {
                    let (s, t) = normal().any_orthonormal_pair();
                    let x = m.dot([s, t][k % 2]) / (m.dot(normal()) * f64::from(alpha));
                    if k < 2 { x / (1.0 + x * x).sqrt() } else { x * x / (1.0 + x * x) }
                };
                for k in 0..4 {
                    let exact = over_facets(alpha, |m| ggx.visible_density(normal(), wo, m) * moment(m, k));
                    let sampled = (0..n).map(|i| sobol.group(i, 0));
                    let sampled = sampled.map(|u| moment(ggx.sample_visible(normal(), wo, [u[0], u[1]]), k));
                    let mean = sampled.sum::<f64>() / n as f64;
                    assert!((mean - exact).abs() < 5e-3, "{alpha} {wo} {k}: {mean} {exact}");
                }
            }
        }
    }

    /// The beta function against its integral, and what holds of shares: in [0, 1], symmetric once G₁ is put back.
    #[test]
    fn masking_of_both_sides() {
        for (a, b) in [(0.0, 0.0), (0.3, 2.0), (5.0, 0.1), (40.0, 40.0), (1e6, 0.5)] {
            let n = 20_000;
            // B(1 + a, 1 + b) = ∫ tᵃ (1 − t)ᵇ dt; t = 1 − x² keeps the peak in sight for large a.
            let integral = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n)).map(|x| {
                let x = x * x;
                2.0 * x.sqrt() * math::exp(a * math::ln_1p(-x)) * math::pow(x, b)
            });
            let integral = integral.sum::<f64>() / f64::from(n);
            let share = lit_of_visible(a, b, true);
            if a < 1e3 {
                assert!((share / (1.0 + a) - integral).abs() < 1e-4 * integral, "{a} {b}: {share} {integral}");
            }
            for crosses in [false, true] {
                let (there, back) = (lit_of_visible(a, b, crosses), lit_of_visible(b, a, crosses));
                assert!((0.0..=1.0).contains(&there), "{a} {b}: {there}");
                assert!((there / (1.0 + a) - back / (1.0 + b)).abs() < 1e-6 * back, "{a} {b}");
            }
        }
        assert_eq!(lit_of_visible(0.0, 0.0, false), 1.0);
    }

    /// At extremes numbers stay finite and normals on their side.
    #[test]
    fn extremes() {
        let ggx = Ggx::new(1e-4);
        let (s, _) = normal().any_orthonormal_pair();
        for wo in [normal(), (s + normal() * 1e-9).normalize(), (s + normal() * 1e-300).normalize()] {
            for u in [[0.0, 0.0], [0.3, 1.0 - f32::EPSILON], [1.0 - f32::EPSILON, 0.5]] {
                let m = ggx.sample_visible(normal(), wo, u);
                assert!(m.is_finite() && m.dot(normal()) > -1e-15, "{wo} {u:?}: {m}");
            }
            assert!(ggx.lambda(wo.dot(normal())).is_finite());
        }
    }
}
