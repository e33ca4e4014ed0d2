//! The smooth boundary between two transparent media.

use super::carried::Lanes;
use super::{Aside, BsdfSample, Carried, Density, Evaluation, Outgoing, ScatteringModel};
use crate::geometry::Frame;
use crate::optics::{self, Refraction};
use crate::spectrum::{LANES, SampledSpectrum};
use glam::{DVec3, Vec3};

/// Indices of refraction of a medium at a path's wavelengths, relative to air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indices {
    /// One a lane.
    pub eta: [f64; LANES],
    /// Whether they differ from lane to lane by the nature of the medium. A fact of the data, not of these lanes.
    pub dispersive: bool,
}

impl Indices {
    /// Air, and empty space.
    pub const AIR: Self = Self { eta: [1.0; LANES], dispersive: false };
}

/// A boundary that a path meets, from the medium `from` towards `to`.
#[derive(Debug, Clone, Copy)]
pub struct Dielectric {
    /// The medium the path is in.
    pub from: Indices,
    /// The medium on the other side.
    pub to: Indices,
}

/// How a path arrives at a boundary.
#[derive(Debug, Clone, Copy)]
pub struct Incidence {
    /// Unit direction of travel.
    direction: DVec3,
    /// Unit normal on the side where the path comes from.
    normal: DVec3,
    cos_theta: f64,
}

impl Incidence {
    /// Of a path that travels along the unit `direction` and meets a surface whose unit `normal` faces it.
    pub fn new(direction: Vec3, normal: DVec3) -> Self {
        Self::of(direction.as_dvec3().normalize(), normal)
    }

    /// The same for a direction that is a unit vector in f64.
    pub fn of(direction: DVec3, normal: DVec3) -> Self {
        Self { direction, normal, cos_theta: (-direction.dot(normal)).clamp(0.0, 1.0) }
    }

    /// The direction of reflection, the same in every lane.
    pub fn reflected(&self) -> Vec3 {
        optics::reflect(self.direction, self.normal).as_vec3()
    }
}

/// How the flux of a path is divided at the boundary. Radiance changes by (η_from / η_to)² besides where it is refracted; as
/// that telescopes along a path, it is applied where light is collected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// Share of each lane's flux that is reflected: its own Fₖ.
    pub reflectance: SampledSpectrum,
    /// Share of the flux of all lanes together that is reflected, q = Σ βₖFₖ / Σ βₖ with throughputs βₖ.
    pub reflected: f32,
}

/// A choice between reflection and refraction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DielectricChoice {
    /// Whether the path crosses; see [`Dielectric::refracted`]. Otherwise it goes on along [`Incidence::reflected`].
    pub refracted: bool,
    /// Share of the flux that each lane carries on, divided by the probability of the choice.
    pub weight: SampledSpectrum,
}

impl Dielectric {
    /// Whether directions of refraction depend on the wavelength.
    pub fn is_dispersive(&self) -> bool {
        self.from.dispersive || self.to.dispersive
    }

    /// How flux is divided between reflection and refraction.
    pub fn divide(&self, incidence: &Incidence, lanes: Lanes, throughput: SampledSpectrum) -> Division {
        let f = |lane: usize| reflectance(optics::refract(incidence.cos_theta, self.from.eta[lane], self.to.eta[lane]));
        let (reflectance, reflected) = match lanes {
            Lanes::Shared if self.is_dispersive() => {
                let reflectance = SampledSpectrum::from_fn(f);
                let total = throughput.sum();
                let q = if total > 0.0 { (throughput * reflectance).sum() / total } else { reflectance.mean() };
                (reflectance, q)
            }
            Lanes::Shared => (SampledSpectrum::splat(f(0)), f(0)),
            Lanes::Bundled(lane) | Lanes::Only(lane) => (SampledSpectrum::splat(f(lane)), f(lane)),
        };
        Division { reflectance, reflected }
    }

    /// The direction in which a lane is refracted; `None` beyond its critical angle.
    pub fn refracted(&self, incidence: &Incidence, lane: usize) -> Option<Vec3> {
        self.refracted_exactly(incidence, lane).map(|direction| direction.as_vec3())
    }

    /// The same in f64.
    pub(crate) fn refracted_exactly(&self, incidence: &Incidence, lane: usize) -> Option<DVec3> {
        let (from, to) = (self.from.eta[lane], self.to.eta[lane]);
        let Incidence { direction, normal, cos_theta } = *incidence;
        let refraction = optics::refract(cos_theta, from, to)?;
        Some(refraction.direction(direction, normal, cos_theta, from, to))
    }
}

impl Division {
    /// Share of each lane's flux that is refracted.
    pub fn transmittance(&self) -> SampledSpectrum {
        SampledSpectrum::ONE - self.reflectance
    }

    /// Chooses between reflection and refraction by `u` in [0, 1).
    ///
    /// Lanes that share the ray share the choice. A reflection is drawn with q, and each lane keeps its own Fₖ / q or
    /// (1 − Fₖ) / (1 − q): no lane is lost, and lanes beyond their critical angle have weight 0 on the other side. A lane on
    /// its own compares `u` with its own F, so that its weight is 1 whatever happens, and lanes with the same `u` part only
    /// where their F differ.
    pub fn choose(&self, u: f32) -> DielectricChoice {
        let q = self.reflected;
        if u < q {
            DielectricChoice { refracted: false, weight: self.reflectance * (1.0 / q) }
        } else {
            DielectricChoice { refracted: true, weight: self.transmittance() * (1.0 / (1.0 - q)) }
        }
    }
}

fn reflectance(refraction: Option<Refraction>) -> f32 {
    refraction.map_or(1.0, |r| r.reflectance as f32)
}

impl ScatteringModel for Dielectric {
    const SPECULAR: bool = true;
    const ROUGH: bool = false;
    const TRANSMITS: bool = true;

    /// Chooses between reflection and refraction by `choice`, or takes both where the path forks: the reflection is put aside then.
    /// Where lanes share the ray and the boundary is dispersive, refraction gives a direction to each lane that goes on.
    #[inline(always)]
    fn sample(&self, frame: &Frame, wo: Vec3, carried: &Carried, _: [f32; 2], choice: f32) -> Option<BsdfSample> {
        let incidence = Incidence::new(-wo, frame.geometric);
        let division = self.divide(&incidence, carried.lanes, carried.throughput);
        let forks = carried.forks(division.reflected);
        let aside = forks.then(|| Aside { wi: incidence.reflected(), weight: division.reflectance });
        let DielectricChoice { refracted, weight } = match forks {
            true => DielectricChoice { refracted: true, weight: division.transmittance() },
            false => division.choose(choice),
        };
        // The sample is large: each kind is built where it is returned.
        let sample = |wi| BsdfSample { wi, weight, pdf: Density::Delta, crosses: refracted, odds: None, aside };
        if !refracted {
            return Some(sample(Outgoing::Shared(incidence.reflected())));
        }
        if carried.lanes != Lanes::Shared || !self.is_dispersive() {
            let wi = self.refracted(&incidence, carried.lanes.single().unwrap_or(0))?;
            return Some(sample(Outgoing::Shared(wi)));
        }
        let mut directions = [None; LANES];
        carried.ways().for_each(|lane| directions[lane] = self.refracted(&incidence, lane));
        Some(sample(Outgoing::PerLane(directions)))
    }

    fn evaluate(&self, _: &Frame, _: Vec3, _: Vec3) -> Option<Evaluation> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math;

    fn glass() -> Indices {
        Indices { eta: std::array::from_fn(|k| 1.8 - 0.01 * k as f64), dispersive: true }
    }

    /// Averaged over the choice, every lane gets its reflectance and its transmittance back, whether lanes share it or not,
    /// also where some lanes are beyond their critical angle and others are not.
    #[test]
    fn every_lane_keeps_its_energy() {
        let boundary = Dielectric { from: glass(), to: Indices::AIR };
        let beta = SampledSpectrum::from_fn(|k| 0.1 + 0.2 * k as f32);
        for degrees in [0.0, 20.0, 33.6, 33.9, 34.5, 60.0] {
            let angle = f64::to_radians(degrees);
            let direction = Vec3::new(math::sin(angle) as f32, 0.0, -math::cos(angle) as f32);
            let incidence = Incidence::new(direction, DVec3::Z);
            let n = 2000;
            for lane in 0..LANES {
                for lanes in [Lanes::Shared, Lanes::Bundled(lane), Lanes::Only(lane)] {
                    let (mut reflected, mut refracted) = (0.0, 0.0);
                    for i in 0..n {
                        let u = (i as f32 + 0.5) / n as f32;
                        let s = boundary.divide(&incidence, lanes, beta).choose(u);
                        let w = f64::from(s.weight.lane(lane)) / f64::from(n);
                        if !s.refracted {
                            reflected += w;
                        } else if boundary.refracted(&incidence, lane).is_some() {
                            refracted += w;
                        } else {
                            assert_eq!(w, 0.0, "a lane beyond its critical angle is refracted");
                        }
                    }
                    let f = optics::refract(incidence.cos_theta, boundary.from.eta[lane], 1.0);
                    let f = f.map_or(1.0, |r| r.reflectance);
                    assert!((reflected - f).abs() < 5e-3 * f.max(0.05), "{degrees} {lanes:?}: {reflected} {f}");
                    assert!((refracted - (1.0 - f)).abs() < 5e-3 * (1.0 - f).max(0.1), "{degrees} {lanes:?}");
                }
            }
        }
    }
}
