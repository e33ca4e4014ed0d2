//! The rough boundary between two transparent media \[Walter2007\]: facets that reflect and refract as [`Dielectric`] does.
//!
//! # Lanes that share a ray
//!
//! Refracted into one direction, each lane needs a facet turned otherwise, as its index differs. So one lane, the hero,
//! draws the direction ω from its own density pₕ, and every lane k takes its value fₖ there: a spectral path is one sample of
//! a technique drawn out of C = 8, "lane j led", each with probability 1 / C \[Wilkie2014\]. After n such events the density
//! of the path's directions is the mixture
//!
//! > P(ω₁ … ωₙ) = (1 / C) Σⱼ Πᵢ pⱼ(ωᵢ | ω₁ … ωᵢ₋₁),
//!
//! and Πᵢ fₖ / P is the estimate of lane k under the balance heuristic: with ratios rⱼ = Πᵢ pⱼ / pₕ it is
//! βₖ / ((1 / C) Σⱼ rⱼ), where βₖ = Πᵢ fₖ / pₕ. It is unbiased for every lane, since P > 0 wherever fₖ > 0, and never more
//! than C times what lane k alone would give, as P ≥ pₖ / C.
//!
//! P is a product of conditional densities, which lets a path carry nothing but *odds* oⱼ = C · P(lane j led | ω₁ … ωᵢ),
//! 1 each at the start: by Bayes' rule oⱼ = rⱼ / ((1 / C) Σₗ rₗ), and at the next vertex
//!
//! > p(ω) = (1 / C) Σⱼ oⱼ pⱼ(ω),  βₖ ← βₖ fₖ(ω) / p(ω),  oⱼ ← oⱼ pⱼ(ω) / p(ω).
//!
//! This β is the whole weight at every vertex: emission is counted with it as it is, and next-event estimation is balanced
//! against p, the density with which a path that has come here goes on to ω. Other surfaces leave the odds as they are, as
//! all lanes have one density there. Where lanes part for good the prefix keeps its weight, and a lane stands for others in
//! proportion to what its odds leave over: see `Walk::set_out`. Where lobes are much narrower than what dispersion makes of
//! one direction, the odds of the hero become C and those of the others 0: it is alone, and its weight is right.

use super::carried::Lanes;
use super::dielectric::{Dielectric, Incidence};
use super::microfacet::{Ggx, lit_of_visible};
use super::{BsdfSample, Carried, Density, Evaluation, Outgoing, ScatteringModel};
use crate::geometry::Frame;
use crate::optics;
use crate::spectrum::{LANES, SampledSpectrum};
use glam::{DVec3, Vec3};

/// Least relative difference of indices: lobes of refraction are as narrow as it is small, down to the digits of f64.
const LEAST_CONTRAST: f64 = 1e-9;

/// Lanes part at the facet where dispersion spreads a direction by more than so many widths of the lobe; see
/// [`RoughDielectric::parts`]. Measured with a prism of dense flint, eight ways: the variance of colour is less than that
/// of single lanes by 123 for α = 0.1 and 40 for 0.02; with a limit of 0 by 95 and 40, with 1 by 112 and 15.
const PARTING_SPREAD: f64 = 1.0 / 3.0;

/// Facets between two media, met by a path's lanes.
///
/// Values are shares of flux: radiance changes by (η_from / η_to)² besides, where it crosses. See
/// [`DielectricChoice::weight`](super::DielectricChoice::weight).
#[derive(Debug, Clone, Copy)]
pub struct RoughDielectric {
    /// The media.
    pub boundary: Dielectric,
    /// How the facets are turned.
    pub ggx: Ggx,
    /// Which lanes the path carries.
    pub lanes: Lanes,
    /// The lane that draws directions for all that share the ray.
    pub hero: usize,
    /// Number of lanes times the probability of each to be the hero, given the path so far.
    pub odds: SampledSpectrum,
    /// Whether refraction at one facet sends the lanes apart instead of keeping them together; see [`Self::parts`].
    pub parts: bool,
}

/// What the lanes make of a direction.
struct Lobe {
    /// f · |cos θ_i| of each lane.
    value: SampledSpectrum,
    /// The density with which each lane would draw the direction if it were alone.
    own_pdf: SampledSpectrum,
}

/// A surface seen from somewhere.
struct View {
    normal: DVec3,
    wo: DVec3,
    cos: f64,
    lambda: f64,
}

impl RoughDielectric {
    /// Whether refraction sends lanes that share a ray apart by more than the roughness does. Snell's law at the mean
    /// facet gives the tangential part of the refracted direction as η sin θ_o, η = η_from / η_to, which lanes make
    /// different by Δη sin θ_o; facets turned by α move it by α |η cos θ_o − cos θ_t|. Depends on what is known before
    /// a facet is drawn alone, so that it cannot bias what is drawn.
    pub fn parts(boundary: &Dielectric, ggx: Ggx, frame: &Frame, wo: Vec3) -> bool {
        if !boundary.is_dispersive() {
            return false;
        }
        let ratios = boundary.from.eta.iter().zip(&boundary.to.eta).map(|(from, to)| from / to);
        let (low, high) = ratios.fold((f64::INFINITY, 0.0f64), |(low, high), r| (low.min(r), high.max(r)));
        let cos = wo.as_dvec3().normalize().dot(frame.geometric).clamp(0.0, 1.0);
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let ratio = 0.5 * (low + high);
        let cos_t = (1.0 - ratio * ratio * sin * sin).max(0.0).sqrt();
        (high - low) * sin > PARTING_SPREAD * ggx.alpha() * (ratio * cos - cos_t).abs()
    }

    /// The density by which a lane's sample of this direction is balanced against other techniques: that of the mixture
    /// where lanes stay together, the lane's own where they part.
    fn balance_pdf(&self, own_pdf: SampledSpectrum, crosses: bool) -> SampledSpectrum {
        match self.lanes {
            Lanes::Shared if !(self.parts && crosses) => SampledSpectrum::splat(self.mixture(&own_pdf)),
            _ => own_pdf,
        }
    }

    /// (η_from / η_to)² of each lane for what crosses, else 1: what radiance from there is multiplied by.
    pub fn radiance_change(&self, crosses: bool) -> SampledSpectrum {
        if !crosses {
            return SampledSpectrum::ONE;
        }
        SampledSpectrum::from_fn(|k| {
            let ratio = self.boundary.from.eta[k] / self.boundary.to.eta[k];
            (ratio * ratio) as f32
        })
    }

    /// The same facets met from where a direction goes, with the frame turned to it.
    pub fn reversed(&self, frame: &Frame, crosses: bool) -> (Self, Frame) {
        if !crosses {
            return (*self, *frame);
        }
        let boundary = Dielectric { from: self.boundary.to, to: self.boundary.from };
        (Self { boundary, ..*self }, Frame { geometric: -frame.geometric, shading: -frame.shading })
    }

    /// Lanes that go on together in a direction that one of them has drawn.
    fn together(&self, frame: &Frame, view: &View, wi: DVec3, crosses: bool) -> Option<BsdfSample> {
        let lobe = self.lobe_towards(view, wi, crosses)?;
        let wi = wi.as_vec3();
        if self::crosses(frame, wi) != Some(crosses) {
            return None;
        }
        let pdf = self.mixture(&lobe.own_pdf);
        if !(pdf > 0.0 && pdf.is_finite()) {
            return None;
        }
        let odds = match self.lanes {
            Lanes::Shared if self.boundary.is_dispersive() => self.odds * lobe.own_pdf * (1.0 / pdf),
            _ => self.odds,
        };
        let (wi, weight) = (Outgoing::Shared(wi), lobe.value * (1.0 / pdf));
        Some(BsdfSample { wi, weight, pdf: Density::Shared(pdf), crosses, odds: Some(odds), aside: None })
    }

    /// Lanes that share a facet: as [`Dielectric`], with its normal.
    fn sample_parting(
        &self,
        frame: &Frame,
        view: &View,
        m: DVec3,
        throughput: SampledSpectrum,
        u: f32,
    ) -> Option<BsdfSample> {
        let incidence = Incidence::of(-view.wo, m);
        let choice = self.boundary.divide(&incidence, Lanes::Shared, throughput).choose(u);
        if !choice.refracted {
            let wi = optics::reflect(-view.wo, m);
            let lobe = self.lobe_towards(view, wi, false)?;
            let wi = wi.as_vec3();
            if crosses(frame, wi) != Some(false) {
                return None;
            }
            let lambda_i = self.ggx.lambda(wi.as_dvec3().dot(view.normal));
            let weight = choice.weight * lit_of_visible(view.lambda, lambda_i, false) as f32;
            return Some(BsdfSample::reflected(wi, weight, self.mixture(&lobe.own_pdf)));
        }
        let (mut directions, mut weight, mut own_pdf) = ([None; LANES], [0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let Some(wi) = self.boundary.refracted_exactly(&incidence, lane) else { continue };
            if crosses(frame, wi.as_vec3()) != Some(true) {
                continue;
            }
            let lit = lit_of_visible(view.lambda, self.ggx.lambda(wi.dot(view.normal)), true);
            directions[lane] = Some(wi.as_vec3());
            weight[lane] = choice.weight.lane(lane) * lit as f32;
            own_pdf[lane] = self.density(view, wi, true, lane) as f32;
        }
        Some(BsdfSample {
            wi: Outgoing::PerLane(directions),
            weight: SampledSpectrum::new(weight),
            pdf: Density::PerLane(SampledSpectrum::new(own_pdf)),
            crosses: true,
            odds: None,
            aside: None,
        })
    }

    fn view(&self, frame: &Frame, wo: Vec3) -> Option<View> {
        let (normal, wo) = (frame.geometric, wo.as_dvec3().normalize());
        let cos = wo.dot(normal);
        (cos > 0.0).then(|| View { normal, wo, cos, lambda: self.ggx.lambda(cos) })
    }

    /// (1 / C) Σⱼ oⱼ pⱼ, or the density of the only lane there is.
    fn mixture(&self, own_pdf: &SampledSpectrum) -> f32 {
        match self.lanes {
            Lanes::Shared if self.boundary.is_dispersive() => (self.odds * *own_pdf).mean(),
            Lanes::Shared => own_pdf.lane(0),
            Lanes::Bundled(lane) | Lanes::Only(lane) => own_pdf.lane(lane),
        }
    }

    fn lobe_towards(&self, view: &View, wi: DVec3, crosses: bool) -> Option<Lobe> {
        let density = |lane: usize| self.density(view, wi, crosses, lane) as f32;
        let own_pdf = match self.lanes {
            Lanes::Shared if self.boundary.is_dispersive() => SampledSpectrum::from_fn(density),
            Lanes::Shared => SampledSpectrum::splat(density(0)),
            Lanes::Bundled(lane) | Lanes::Only(lane) => SampledSpectrum::splat(density(lane)).only(lane),
        };
        if own_pdf.is_zero() {
            return None;
        }
        // Facets that are seen scatter with the density of their directions; of that, this share gets out.
        let lit = lit_of_visible(view.lambda, self.ggx.lambda(wi.dot(view.normal)), crosses) as f32;
        Some(Lobe { value: own_pdf * lit, own_pdf })
    }

    /// Indices of a lane, which differ at least by a little.
    fn indices(&self, lane: usize) -> (f64, f64) {
        let (from, to) = (self.boundary.from.eta[lane], self.boundary.to.eta[lane]);
        if (to - from).abs() < LEAST_CONTRAST * from { (from, from * (1.0 + LEAST_CONTRAST)) } else { (from, to) }
    }

    /// The density of the unit `wi` if the lane were alone: that of the facet that sends it there, as it is seen, times
    /// the share that it reflects or refracts, times dm / dwi \[Walter2007, 4.2\].
    fn density(&self, view: &View, wi: DVec3, crosses: bool, lane: usize) -> f64 {
        let (from, to) = self.indices(lane);
        let half = if crosses { view.wo * from + wi * to } else { view.wo + wi };
        let length2 = half.length_squared();
        let m = half / length2.sqrt();
        let m = if m.dot(view.normal) < 0.0 { -m } else { m };
        let (cos_o, cos_i) = (view.wo.dot(m).min(1.0), wi.dot(m));
        if cos_o.is_nan() || cos_o <= 0.0 || (cos_i < 0.0) != crosses {
            return 0.0;
        }
        let reflectance = optics::refract(cos_o, from, to).map_or(1.0, |r| r.reflectance);
        let seen = self.ggx.density(view.normal, m) * cos_o / (view.cos * (1.0 + view.lambda));
        if crosses {
            (1.0 - reflectance) * seen * -cos_i * to * to / length2
        } else {
            reflectance * seen / (4.0 * cos_o)
        }
    }
}

/// Whether a direction is on the other side of the surface, by the very numbers by which rays leave it; `None` in between.
fn crosses(frame: &Frame, wi: Vec3) -> Option<bool> {
    let cos = frame.geometric.as_vec3().dot(wi);
    (cos != 0.0).then_some(cos < 0.0)
}

impl ScatteringModel for RoughDielectric {
    const SPECULAR: bool = false;
    const ROUGH: bool = true;
    const TRANSMITS: bool = true;

    /// Draws a facet among those that `wo` sees by `u`, and whether it refracts by `choice`; `None` if light
    /// that comes from there meets a second facet, which this model leaves out.
    fn sample(&self, frame: &Frame, wo: Vec3, carried: &Carried, u: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let view = self.view(frame, wo)?;
        let m = self.ggx.sample_visible(view.normal, view.wo, u);
        if self.parts && self.lanes == Lanes::Shared {
            return self.sample_parting(frame, &view, m, carried.throughput, choice);
        }
        let lane = match self.lanes {
            Lanes::Shared => self.hero,
            Lanes::Bundled(lane) | Lanes::Only(lane) => lane,
        };
        let (from, to) = self.indices(lane);
        let cos = view.wo.dot(m).clamp(0.0, 1.0);
        let refraction = optics::refract(cos, from, to);
        let (wi, refracts) = match refraction {
            Some(r) if f64::from(choice) >= r.reflectance => (r.direction(-view.wo, m, cos, from, to), true),
            _ => (optics::reflect(-view.wo, m), false),
        };
        self.together(frame, &view, wi, refracts)
    }

    fn evaluate(&self, frame: &Frame, wo: Vec3, wi: Vec3) -> Option<Evaluation> {
        let crosses = crosses(frame, wi)?;
        let Lobe { value, own_pdf } = self.lobe_towards(&self.view(frame, wo)?, wi.as_dvec3().normalize(), crosses)?;
        let pdf = Density::PerLane(self.balance_pdf(own_pdf, crosses));
        Some(Evaluation { value, pdf, own_pdf, crosses })
    }
}
