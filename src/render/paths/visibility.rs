//! Shadow rays: what lies between a surface and a light or the camera.

use super::walk::Walk;
use super::workspace::Workspace;
use crate::geometry::Ray;
use crate::optics;
use crate::scene::Surface;
use crate::spectrum::SampledSpectrum;
use glam::Vec3;

impl Walk<'_> {
    /// Returns the share of light that arrives at a surface from `target` (or, without one, from infinity) along `wi`, or
    /// `None` if something is in the way. Boundaries that bend or reflect nothing are no obstacle. `crosses` tells that `wi`
    /// lies past the surface, which is a boundary then.
    pub fn visibility<const INTERIORS: bool>(
        &mut self,
        surface: &Surface,
        wi: Vec3,
        target: Option<Vec3>,
        crosses: bool,
    ) -> Option<SampledSpectrum> {
        let mut ray = surface.spawn(wi);
        // Up to a target the ray's direction is the whole way, and distances end at 1.
        let limit = match target {
            Some(target) => {
                ray.direction = target - ray.origin;
                1.0 - 16.0 * f32::EPSILON
            }
            None => f32::INFINITY,
        };
        if !INTERIORS {
            let occluded = self.workspace.counters.occluded(self.scene, &ray, limit);
            return (!occluded).then_some(SampledSpectrum::ONE);
        }
        let Workspace { interiors, shadow_interiors, .. } = &mut *self.workspace;
        match self.scene.objects.get(surface.object.0 as usize).and_then(|object| object.material.medium()) {
            Some(medium) if crosses => {
                shadow_interiors.set_past(interiors, self.scene, surface, medium, wi);
            }
            _ => shadow_interiors.copy_from(interiors),
        }
        self.visibility_through_media(ray, limit, target)
    }

    fn visibility_through_media(&mut self, mut ray: Ray, limit: f32, target: Option<Vec3>) -> Option<SampledSpectrum> {
        let Workspace { spectra, shadow_interiors, beyond, counters, .. } = &mut *self.workspace;
        let mut transmittance = SampledSpectrum::ONE;
        loop {
            counters.shadow_rays += 1;
            let hit = counters.closest(self.scene, &ray, limit);
            let medium = shadow_interiors.medium(self.scene);
            let distance =
                hit.map_or(if target.is_some() { 1.0 } else { f32::INFINITY }, |h| h.t) * ray.direction.length();
            if let Some(absorption) = medium.and_then(|m| self.scene.medium(m).absorption) {
                transmittance *= optics::transmittance(spectra.spectrum(self.scene, absorption), distance);
            }
            let Some(surface) = hit else { return Some(transmittance) };
            let object = self.scene.object(surface.object);
            let inside = object.material.medium()?;
            beyond.set_past(shadow_interiors, self.scene, &surface, inside, ray.direction);
            let past = beyond.medium(self.scene);
            if medium != past {
                let [here, beyond] = spectra.both_indices(self.scene, [medium, past]);
                if here.eta != beyond.eta {
                    return None;
                }
            }
            std::mem::swap(shadow_interiors, beyond);
            ray = surface.spawn(ray.direction);
            if let Some(target) = target {
                ray.direction = target - ray.origin;
            }
        }
    }
}
