//! The rough metal.

use super::conductor::Conductor;
use super::microfacet::{Ggx, lit_of_visible};
use super::{BsdfSample, Carried, Density, ScatteringModel};
use crate::geometry::Frame;
use crate::optics;
use crate::spectrum::SampledSpectrum;
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
    /// f · |cos θ_i|.
    pub fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        let geometry = self.geometry(frame, wo, wi.as_dvec3().normalize());
        geometry.map_or(SampledSpectrum::ZERO, |g| self.facets.reflectance(g.wo.dot(g.m)) * (g.pdf * g.lit) as f32)
    }

    /// Draws a facet among those that `wo` sees; `None` if it reflects into the surface.
    #[inline]
    pub fn sample(&self, frame: &Frame, wo: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
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

    /// D G₁ / (4 cos θ_o).
    pub fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> f32 {
        self.geometry(frame, wo, wi.as_dvec3().normalize()).map_or(0.0, |g| g.pdf as f32)
    }

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

    fn eval(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        Self::eval(self, frame, wo, wi)
    }

    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, _: &Carried, u: [f32; 2], _: f32) -> Option<BsdfSample> {
        Self::sample(self, frame, wo, u)
    }

    fn pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Density {
        Density::Shared(Self::pdf(self, frame, wo, wi))
    }

    fn own_pdf(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> SampledSpectrum {
        SampledSpectrum::splat(Self::pdf(self, frame, wo, wi))
    }
}
