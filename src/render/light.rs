//! Light paths, splatted where the camera sees them.

use super::bounce;
use super::path::camera_density;
use super::techniques::Techniques;
use super::walk::{Crossing, Parting, Walk};
use crate::bsdf::Bsdf;
use crate::film::{Filter, Sensor, Splat};
use crate::geometry::{Frame, Ray, offset_origin};
use crate::sampling::{Draw, Sobol, balance_heuristic};
use crate::scene::{Emission, Light, LightKind, Material, Scene, Surface};
use crate::spectrum::{LANES, SampledSpectrum};
use glam::Vec3;

/// What light paths are traced for, and onto what.
#[derive(Debug)]
pub struct LightTracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The colour observer.
    pub sensor: &'a Sensor,
    /// The reconstruction filter.
    pub filter: &'a Filter,
    /// Who else finds the same paths.
    pub techniques: &'a Techniques,
    /// Largest number of scattering events.
    pub max_depth: u32,
}

/// One light path's view of the film.
struct Target<'a> {
    tracer: &'a LightTracer<'a>,
    /// Density of light paths where camera paths could find the same; see [`Techniques::light_path_density`].
    density: Option<f32>,
    /// Whether the light is local: light paths own all that bounces off what it lights.
    local: bool,
    /// Power of the path in each lane, before any scattering.
    power: SampledSpectrum,
    weights: [SampledSpectrum; 3],
    splats: &'a mut Vec<Splat>,
}

impl LightTracer<'_> {
    /// Traces path `index` of a sequence and appends what the film gets of it.
    pub fn trace<const DISPERSION: bool, const INTERIORS: bool>(
        &self,
        workspace: &mut super::workspace::Workspace,
        sobol: Sobol,
        index: u64,
        splats: &mut Vec<Splat>,
    ) {
        // Point, wavelengths and direction first: that is where the picture of a caustic comes from.
        let scene = self.scene;
        let u = sobol.group(index, 0);
        let table = if self.caustics_only() { &scene.caustic_table } else { &scene.emission_table };
        let Some(Draw { index: light_index, probability, .. }) = table.sample(u[5]) else { return };
        let light = &scene.lights[light_index];
        let wavelengths = light.wavelengths.sample(u[2]);
        let aim = if self.caustics_only() { scene.caustic_aim } else { None }.unwrap_or(scene.everything());
        let Some(emission) = light.emit(scene, &aim, [u[0], u[1]], [u[3], u[4]]) else { return };
        workspace.spectra.begin(wavelengths);
        let hero = (u[6] * LANES as f32) as usize;
        let parting = if self.caustics_only() { Parting::Ways(2) } else { Parting::Ways(1) };

        let origin = emission.start.origin(emission.direction);
        let inside = if INTERIORS && light.may_be_inside { scene.interiors_at(origin) } else { Vec::new() };
        workspace.interiors.reset(&inside);
        let spectrum = workspace.spectra.spectrum(scene, light.spectrum);
        let mut walk = Walk::start(
            scene,
            workspace,
            Ray { origin, direction: emission.direction },
            (hero, parting),
            (sobol, index),
        );
        let mut target = Target {
            tracer: self,
            density: self.techniques.light_path_density(scene, light_index as u32, &emission.exit()),
            local: light.is_local(),
            power: spectrum * (emission.weight / probability),
            weights: self.sensor.weights(&wavelengths),
            splats,
        };
        if !self.caustics_only() {
            target.splat_emitter::<INTERIORS>(&mut walk, light, &emission, spectrum * (1.0 / probability));
        }
        self.follow::<DISPERSION, INTERIORS>(&mut walk, &mut target, false);
    }

    fn caustics_only(&self) -> bool {
        !matches!(self.techniques, Techniques::Light)
    }

    /// Follows a path from surface to surface.
    fn follow<const DISPERSION: bool, const INTERIORS: bool>(
        &self,
        walk: &mut Walk,
        target: &mut Target,
        mut focused: bool,
    ) {
        let mut diffused = false;
        while walk.depth < self.max_depth {
            let Some(surface) = walk.advance::<INTERIORS>() else { break };
            let object = &self.scene.objects[surface.object as usize];
            let u = walk.random();
            if let Material::Dielectric { medium } = object.material {
                match walk.meet_dielectric::<DISPERSION>(&surface, medium, u[2]) {
                    Crossing::Passed => continue,
                    Crossing::Ended => break,
                    Crossing::Scattered => focused |= !diffused,
                    Crossing::Parted(bundle) => {
                        for way in 0..bundle.ways {
                            if walk.set_out(&bundle, way) {
                                self.follow::<DISPERSION, INTERIORS>(walk, target, true);
                            }
                        }
                        break;
                    }
                }
            } else {
                let Some((bsdf, frame)) = walk.bsdf::<INTERIORS>(object, &surface) else { break };
                if bsdf.is_specular() {
                    focused |= !diffused;
                } else {
                    let owned = !self.caustics_only() || focused || (target.local && diffused);
                    if owned {
                        target.splat_surface::<INTERIORS>(walk, &surface, &bsdf, &frame, [u[4], u[5]]);
                    } else if !target.local {
                        break;
                    }
                    diffused = true;
                    if !walk.diffused() {
                        break;
                    }
                }
                walk.throughput *= adjoint(&frame, -walk.ray.direction);
                if bounce(walk, &surface, &bsdf, &frame.without_shading(), [u[0], u[1]]).is_none() {
                    break;
                }
            }
            if !walk.survives(u[3]) {
                break;
            }
        }
    }
}

/// Correction of light paths where shading and geometric normal differ. Camera paths see a diffuse surface as
/// f |wi·n_s| whatever side of n_s they come from; the adjoint of that is f |wo·n_s| |wi·n_g| / |wo·n_g| with wo towards
/// the light [Veach1997, 5.3]. So light arrives by n_s, which is this factor, and leaves by n_g.
fn adjoint(frame: &Frame, wo: Vec3) -> f32 {
    let geometric = frame.geometric.as_vec3();
    if geometric == frame.shading {
        return 1.0;
    }
    let factor = wo.dot(frame.shading).max(0.0) / wo.dot(geometric).abs();
    if factor.is_finite() { factor } else { 0.0 }
}

impl Target<'_> {
    /// What the camera sees of the light that a path brings to a diffuse surface.
    fn splat_surface<const INTERIORS: bool>(
        &mut self,
        walk: &mut Walk,
        surface: &Surface,
        bsdf: &Bsdf,
        frame: &Frame,
        lens: [f32; 2],
    ) {
        let scene = walk.scene;
        let Some(seen) = scene.camera.connect(surface.point, lens, self.tracer.filter.radius()) else { return };
        let wi = (seen.lens - surface.point).normalize_or_zero();
        let wo = -walk.ray.direction;
        let reflected = bsdf.eval(&frame.without_shading(), wo, wi) * adjoint(frame, wo);
        if reflected.is_zero() {
            return;
        }
        let Some(transmittance) = walk.visibility::<INTERIORS>(surface, wi, Some(seen.lens)) else { return };
        let camera = camera_density(scene, surface, wi);
        let weight = self.density.map_or(1.0, |light| balance_heuristic(light, camera));
        let radiance = self.power * walk.throughput * reflected * transmittance;
        self.deposit(seen.film, radiance * (weight * seen.importance));
    }

    /// A light that the camera sees directly: its own surface is where the path "ends".
    fn splat_emitter<const INTERIORS: bool>(
        &mut self,
        walk: &mut Walk,
        light: &Light,
        emission: &Emission,
        radiance: SampledSpectrum,
    ) {
        let LightKind::Area { area, two_sided, .. } = light.kind else { return };
        let (scene, start) = (walk.scene, emission.start);
        let Some(seen) = scene.camera.connect(start.point, [0.5; 2], self.tracer.filter.radius()) else { return };
        let to_camera = seen.lens - start.point;
        let cos = start.normal.dot(to_camera.normalize_or_zero());
        if cos <= 0.0 {
            return;
        }
        // The start belongs to one side of the light: a two-sided one has twice the area to draw from.
        let per_area = area * if two_sided { 2.0 } else { 1.0 };
        let surface = Surface {
            t: 0.0,
            point: offset_origin(start.point, start.error, start.normal, start.normal),
            error: Vec3::ZERO,
            geometric: start.normal.as_dvec3(),
            shading: start.normal,
            object: u32::MAX,
        };
        if let Some(transmittance) = walk.visibility::<INTERIORS>(&surface, to_camera, Some(seen.lens)) {
            self.deposit(seen.film, radiance * transmittance * (per_area * cos * seen.importance));
        }
    }

    fn deposit(&mut self, film: [f32; 2], radiance: SampledSpectrum) {
        let xyz = Sensor::xyz(&self.weights, radiance);
        let [width, height] = self.tracer.scene.camera.size();
        self.tracer.filter.splat(film, width, height, |x, y, weight| {
            let pixel = y * width + x;
            self.splats.push(Splat { pixel, xyz: xyz.map(|v| v * f64::from(weight)) });
        });
    }
}
