//! The rough metal.

use super::conductor::Conductor;
use super::microfacet::{Ggx, lit_of_visible};
use super::{BsdfSample, Carried, Evaluation, ScatteringModel};
use crate::geometry::Frame;
use crate::optics;
use glam::{DVec3, Vec3};

/// Facets of a metal. The direction of reflection is that of a facet whatever the wavelength, so lanes never separate and
/// have one density in common.
#[derive(Debug, Clone, Copy)]
pub struct RoughConductor {
    /// What the facets are made of.
    pub facets: Conductor,
    /// How they are turned.
    pub ggx: Ggx,
}

/// What the lobe's value and its density are made of.
struct Geometry {
    wo: DVec3,
    m: DVec3,
    /// Density of the sampled direction.
    pdf: f64,
    /// G₂ / G₁.
    lit: f64,
}

impl RoughConductor {
    /// `None` where nothing is reflected.
    fn geometry(&self, frame: &Frame, wo: Vec3, wi: DVec3) -> Option<Geometry> {
        let (normal, wo) = (frame.geometric, wo.as_dvec3().normalize());
        let (cos_o, cos_i) = (wo.dot(normal), wi.dot(normal));
        if cos_o <= 0.0 || cos_i <= 0.0 {
            return None;
        }
        let m = (wo + wi).normalize();
        let (lambda_o, lambda_i) = (self.ggx.lambda(cos_o), self.ggx.lambda(cos_i));
        // Visible normals per solid angle, and dm / dwi = 1 / (4 wo·m).
        let pdf = self.ggx.density(normal, m) / (4.0 * cos_o * (1.0 + lambda_o));
        (pdf > 0.0).then_some(Geometry { wo, m, pdf, lit: lit_of_visible(lambda_o, lambda_i, false) })
    }
}

impl ScatteringModel for RoughConductor {
    const SPECULAR: bool = false;
    const ROUGH: bool = true;
    const TRANSMITS: bool = false;

    /// Draws a facet among those that `wo` sees; `None` if it reflects into the surface.
    #[inline]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, u: [f32; 2], _: f32) -> Option<BsdfSample> {
        let view = wo.as_dvec3().normalize();
        if view.dot(frame.geometric) <= 0.0 {
            return None;
        }
        let m = self.ggx.sample_visible(frame.geometric, view, u);
        let wi = optics::reflect(-view, m);
        let geometry = self.geometry(frame, wo, wi)?;
        let wi = wi.as_vec3();
        let weight = self.facets.reflectance(geometry.wo.dot(geometry.m)) * geometry.lit as f32;
        frame.same_side(wo, wi).then_some(BsdfSample::reflected(wi, weight, geometry.pdf as f32))
    }

    /// The density is D G₁ / (4 cos θ_o).
    fn evaluate(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation> {
        let Geometry { wo, m, pdf, lit } = self.geometry(frame, wo, wi.as_dvec3().normalize())?;
        Some(Evaluation::reflected(self.facets.reflectance(wo.dot(m)) * (pdf * lit) as f32, pdf as f32))
    }
}
