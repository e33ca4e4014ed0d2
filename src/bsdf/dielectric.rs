//! The smooth boundary between two transparent media. The only place where lanes can part.

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

/// Which lanes of a path are alive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lanes {
    /// All share the ray.
    Shared,
    /// They have parted: only this one goes on.
    Only(usize),
}

/// A boundary that a path meets, from the medium `from` towards `to`.
#[derive(Debug, Clone, Copy)]
pub struct Dielectric {
    /// The medium the path is in.
    pub from: Indices,
    /// The medium on the other side.
    pub to: Indices,
}

/// What became of a path at the boundary.
#[derive(Debug, Clone, Copy)]
pub struct DielectricSample {
    /// Direction of travel afterwards.
    pub direction: Vec3,
    /// Share of the flux that this path carries on, divided by the probability of the choice. Radiance changes by
    /// (η_from / η_to)² besides; as that telescopes along a path, it is applied where light is collected.
    pub weight: SampledSpectrum,
    /// Whether the path crossed.
    pub refracted: bool,
    /// Whether the new direction depends on the wavelength: lanes that shared the ray have to part.
    pub parts_lanes: bool,
}

impl Dielectric {
    /// Whether the boundary is optically absent: equal indices at every wavelength.
    pub fn is_invisible(&self) -> bool {
        self.from.eta == self.to.eta
    }

    /// Reflects or refracts a path that travels along the unit `direction` and meets the surface whose unit `normal`
    /// faces it. The choice, by `u` in [0, 1), is shared by all lanes; `hero` gives the direction where lanes part.
    ///
    /// With shared lanes a reflection is drawn with q = Σ βₖFₖ / Σ βₖ (`throughput` β), which is the balance heuristic \[Wilkie2014\]
    /// over the heroes that could have been, so that all lanes keep their own Fₖ / q. A dispersive refraction leaves the
    /// hero alone, which then stands for all eight: the caller multiplies by [`LANES`] when it parts them.
    pub fn sample<const DISPERSION: bool>(
        &self,
        direction: Vec3,
        normal: DVec3,
        lanes: Lanes,
        hero: usize,
        throughput: SampledSpectrum,
        u: f32,
    ) -> DielectricSample {
        let d = direction.as_dvec3().normalize();
        let cos_theta_i = (-d.dot(normal)).clamp(0.0, 1.0);
        let of_lane = |lane: usize| optics::refract(cos_theta_i, self.from.eta[lane], self.to.eta[lane]);
        let dispersive = DISPERSION && (self.from.dispersive || self.to.dispersive);

        // Reflectance of each lane, and the probability of choosing the reflection.
        let refraction = of_lane(hero);
        let (reflectance, q) = match lanes {
            Lanes::Shared if dispersive => {
                let f = SampledSpectrum::from_fn(|lane| reflectance(of_lane(lane)));
                let total = throughput.sum();
                (f, if total > 0.0 { (throughput * f).sum() / total } else { f.mean() })
            }
            _ => {
                let f = reflectance(refraction);
                (SampledSpectrum::splat(f), f)
            }
        };

        match refraction {
            Some(refraction) if u >= q => DielectricSample {
                direction: refraction
                    .direction(d, normal, cos_theta_i, self.from.eta[hero], self.to.eta[hero])
                    .as_vec3(),
                weight: (SampledSpectrum::ONE - reflectance) * (1.0 / (1.0 - q)),
                refracted: true,
                parts_lanes: dispersive,
            },
            // Chosen to refract, but this hero is reflected totally: its path ends, the other heroes stand for the rest.
            None if u >= q => {
                DielectricSample { direction, weight: SampledSpectrum::ZERO, refracted: true, parts_lanes: dispersive }
            }
            _ => DielectricSample {
                direction: optics::reflect(d, normal).as_vec3(),
                weight: reflectance * (1.0 / q),
                refracted: false,
                parts_lanes: false,
            },
        }
    }
}

fn reflectance(refraction: Option<Refraction>) -> f32 {
    refraction.map_or(1.0, |r| r.reflectance as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math;

    fn glass() -> Indices {
        Indices { eta: std::array::from_fn(|k| 1.8 - 0.01 * k as f64), dispersive: true }
    }

    /// Averaged over the choice and the hero, every lane gets its reflectance and its transmittance back, also where some
    /// lanes are beyond their critical angle and others are not.
    #[test]
    fn every_lane_keeps_its_energy() {
        let boundary = Dielectric { from: glass(), to: Indices::AIR };
        let beta = SampledSpectrum::from_fn(|k| 0.1 + 0.2 * k as f32);
        for degrees in [0.0, 20.0, 33.6, 33.9, 34.5, 60.0] {
            let angle = f64::to_radians(degrees);
            let direction = Vec3::new(math::sin(angle) as f32, 0.0, -math::cos(angle) as f32);
            let (mut reflected, mut refracted) = ([0.0f64; LANES], [0.0f64; LANES]);
            let n = 2000;
            for i in 0..n {
                let u = (i as f32 + 0.5) / n as f32;
                for hero in 0..LANES {
                    let s = boundary.sample::<true>(direction, DVec3::Z, Lanes::Shared, hero, beta, u);
                    let w = s.weight.lanes();
                    if s.refracted {
                        refracted[hero] += f64::from(w[hero]) / f64::from(n);
                    } else {
                        for lane in 0..LANES {
                            reflected[lane] += f64::from(w[lane]) / f64::from(n) / LANES as f64;
                        }
                    }
                }
            }
            let c = -f64::from(direction.z) / direction.as_dvec3().length();
            for lane in 0..LANES {
                let f = optics::refract(c, boundary.from.eta[lane], 1.0).map_or(1.0, |r| r.reflectance);
                assert!((reflected[lane] - f).abs() < 5e-3 * f.max(0.05), "{degrees} {lane}: {} {f}", reflected[lane]);
                assert!((refracted[lane] - (1.0 - f)).abs() < 2e-2 * (1.0 - f).max(0.1), "{degrees} {lane}");
            }
        }
    }

    /// Forcing dispersion on changes no bit where indices are constant.
    #[test]
    fn constant_indices_take_the_plain_path() {
        let boundary = Dielectric { from: Indices::AIR, to: Indices { eta: [1.5; LANES], dispersive: false } };
        for i in 0..100 {
            let direction = Vec3::new(0.01 * i as f32, 0.1, -1.0).normalize();
            let u = (i as f32 * 0.37).fract();
            let beta = SampledSpectrum::from_fn(|k| k as f32);
            let a = boundary.sample::<true>(direction, DVec3::Z, Lanes::Shared, 3, beta, u);
            let b = boundary.sample::<false>(direction, DVec3::Z, Lanes::Shared, 3, beta, u);
            assert_eq!((a.direction, a.weight), (b.direction, b.weight));
            assert!(!a.parts_lanes);
        }
    }
}
