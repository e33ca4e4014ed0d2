//! Contact: opaque surfaces that lie where a transparent object ends, within the rounding of both.
//!
//! A ray meets one of two such surfaces first, and which one is decided by rounding. What is right does not depend on it:
//! a glass that stands on a table is in optical contact with it, as if it were sunk by a hair. So where an opaque surface
//! touches a transparent one, the opaque one is met, and the boundary of the glass is as good as absent. Of several opaque
//! surfaces the lamp is met, and of equals the one that comes later in the file.

use super::{Object, ObjectId, Scene, Surface};
use crate::geometry::{Aabb, AnalyticId, Bvh, Primitive, Ray, TriangleId};
use glam::Vec3;

/// The opaque surfaces that may touch a transparent object.
#[derive(Debug)]
pub(super) struct Contacts {
    /// A tree over them alone.
    tree: Bvh,
    /// The scene's triangles that the tree's stand for.
    triangles: Vec<TriangleId>,
    /// The scene's analytic shapes that the tree's stand for.
    analytic: Vec<AnalyticId>,
}

/// Bound of the distance to which rounding can bring apart two surfaces that touch, besides the error of the hit: the
/// error of a point on a triangle and the steps of a ray's start, in a scene of unit size.
const REACH: f32 = 1.0 / (1 << 19) as f32;

impl Contacts {
    /// Finds the opaque surfaces that may touch a transparent object, and marks such objects. `None` if there are none.
    pub fn find(scene: &mut Scene) -> Option<Self> {
        let glass: Vec<(ObjectId, Aabb)> = scene.solids.iter().map(|s| (s.object, s.bounds.grown(REACH))).collect();
        let everything = glass.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let near = |bounds: &Aabb| -> Vec<usize> {
            if !bounds.overlaps(&everything) {
                return Vec::new();
            }
            (0..glass.len()).filter(|i| glass[*i].1.overlaps(bounds)).collect()
        };
        let (mut triangles, mut analytic, mut boxes, mut touching) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (index, object) in (0..).zip(&scene.triangle_objects) {
            if scene.object(*object).material.medium().is_some() {
                continue;
            }
            let corners = scene.triangles[index as usize].map(|i| scene.positions[i as usize]);
            let touched = near(&Aabb::from_points(corners));
            if !touched.is_empty() {
                triangles.push(TriangleId(index));
                touching.extend(touched);
            }
        }
        for (index, object) in (0..).zip(&scene.analytic_objects) {
            if scene.object(*object).material.medium().is_some() {
                continue;
            }
            let shape = scene.analytic(AnalyticId(index));
            let mut touched = near(&shape.bounds());
            touched.retain(|i| !shape.encloses(&glass[*i].1));
            if !touched.is_empty() {
                analytic.push(AnalyticId(index));
                boxes.push(shape.bounds());
                touching.extend(touched);
            }
        }
        for i in &touching {
            scene.objects[glass[*i].0.0 as usize].touched = true;
        }
        let corners: Vec<_> = triangles.iter().map(|TriangleId(i)| scene.triangles[*i as usize]).collect();
        let tree = Bvh::build(&scene.positions, &corners, &boxes);
        (!touching.is_empty()).then_some(Self { tree, triangles, analytic })
    }

    /// Calls `found` with every hit of a ray on these surfaces.
    fn visit(&self, scene: &Scene, ray: &Ray, t_max: f32, mut found: impl FnMut(Surface)) {
        let analytic = |AnalyticId(i): AnalyticId, t_max: f32| {
            let hit = scene.analytic(self.analytic[i as usize]).intersect(ray, t_max)?;
            Some(hit.t as f32)
        };
        self.tree.visit(ray, t_max, analytic, |primitive, t| {
            let primitive = match primitive {
                Primitive::Triangle(TriangleId(i)) => Primitive::Triangle(self.triangles[i as usize]),
                Primitive::Analytic(AnalyticId(i)) => Primitive::Analytic(self.analytic[i as usize]),
            };
            if let Some(surface) = scene.surface_on(ray, primitive, t, t_max) {
                found(surface);
            }
        });
    }
}

impl Object {
    /// Which of several opaque surfaces in contact is met: the greatest.
    fn precedence(&self, ObjectId(index): ObjectId) -> (bool, u32) {
        (self.light.is_some(), index)
    }
}

impl Scene {
    /// A point near a surface, moved along its normal out of the reach of whatever touches it.
    pub fn clear_of_contacts(&self, point: Vec3, normal: Vec3) -> Vec3 {
        if self.contacts.is_some() { point + normal * (2.0 * REACH) } else { point }
    }

    /// Whether a ray that meets a surface set out from what touches it: it is on the other side already if it was before.
    pub fn sets_out_in_contact(&self, surface: &Surface, direction: Vec3) -> bool {
        let normal = surface.geometric.as_vec3();
        let reach = || normal.abs().dot(surface.error) + REACH;
        self.object(surface.object).touched && surface.t * normal.dot(direction).abs() <= 4.0 * reach()
    }

    /// What a ray meets that has come upon a transparent object which others may touch.
    #[cold]
    #[inline(never)]
    pub(super) fn in_contact(&self, ray: &Ray, surface: Surface, t_max: f32) -> Option<Surface> {
        match self.touching(ray, &surface) {
            Some(other) => (other.t < t_max).then_some(other),
            None => Some(surface),
        }
    }

    /// The opaque surface that touches another at its hit, if the ray meets it and does not leave it.
    fn touching(&self, ray: &Ray, surface: &Surface) -> Option<Surface> {
        let contacts = self.contacts.as_ref()?;
        let normal = surface.geometric.as_vec3();
        let reach = normal.abs().dot(surface.error) + REACH;
        let across = |to: Vec3| (to - surface.point).dot(normal).abs();
        // What is there is asked along the normal, so that the answer depends on the place and not on the ray.
        let probe = Ray { origin: surface.point + normal * (2.0 * reach), direction: -normal };
        let rounding = normal.abs().dot(surface.error + surface.point.abs() * (4.0 * f32::EPSILON));
        let mut touching: Option<Surface> = None;
        contacts.visit(self, &probe, 4.0 * reach, |other| {
            let gap = across(other.point);
            let precedence = |s: &Surface| self.object(s.object).precedence(s.object);
            let first = touching.is_none_or(|best| precedence(&best) < precedence(&other));
            if first && gap <= rounding + normal.abs().dot(other.error) + f32::EPSILON * 0.25 {
                touching = Some(other);
            }
        });
        let touching = touching?;
        let slope = normal.dot(ray.direction).abs().max(f32::MIN_POSITIVE);
        let mut ahead: Option<Surface> = None;
        contacts.visit(self, ray, surface.t + 4.0 * reach / slope, |other| {
            let same = other.object == touching.object && across(other.point) <= 2.0 * reach;
            if same && ahead.is_none_or(|best| other.t < best.t) {
                ahead = Some(other);
            }
        });
        // A ray from afar that meets nothing there passes beside the other's rim.
        let from_afar = across(ray.origin) > 4.0 * reach;
        ahead.or_else(|| from_afar.then_some(Surface { t: surface.t, ..touching }))
    }
}
