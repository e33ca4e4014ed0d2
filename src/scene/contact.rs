//! Contact: opaque surfaces that lie where a transparent object ends, within the rounding of both.
//!
//! A ray meets one of two such surfaces first, and which one is decided by rounding. What is right does not depend on it:
//! a glass that stands on a table is in optical contact with it, as if it were sunk by a hair. So where an opaque surface
//! touches a transparent one, the opaque one is met, and the boundary of the glass is as good as absent.
//!
//! Of several opaque surfaces that touch glass in one place a ray that comes upon the glass first meets a lamp, and of equals
//! the one later in the file. A ray that comes upon one of them first meets that one: opaque surfaces in one plane are told
//! apart by rounding, with or without glass.

use super::{EmissionStart, Object, ObjectId, Scene, Surface};
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

/// Bound of the error with which f64 places a shape in a scene of unit size whose centre is up to 10⁵ sizes from the origin.
const PLACING: f32 = 1.0 / (1u64 << 34) as f32;

/// How far from a point on a surface along its normal what touches it can be, and half of how far a ray that leaves either
/// can start.
fn reach(normal: Vec3, error: Vec3) -> f32 {
    normal.abs().dot(error) + REACH
}

/// How far apart two surfaces in one place can come to lie along the opaque one's normal, as far as rounding can tell: the
/// errors of a point on each, the steps by which the start of a ray is rounded, and the placing of shapes in f64.
fn rounding(opaque: (Vec3, Vec3), face: &Surface) -> f32 {
    let (normal, error) = opaque;
    normal.abs().dot(error + face.error + face.point.abs() * (4.0 * f32::EPSILON)) + PLACING
}

/// The transparent objects of a scene, each with a box around it and whether something may touch it.
struct Glass {
    objects: Vec<(ObjectId, Aabb, bool)>,
    bounds: Aabb,
}

impl Glass {
    fn of(scene: &Scene) -> Self {
        let objects: Vec<_> = scene.solids.iter().map(|s| (s.object, s.bounds.grown(REACH), false)).collect();
        let bounds = objects.iter().fold(Aabb::EMPTY, |all, (_, bounds, _)| all.union(*bounds));
        Self { objects, bounds }
    }

    /// Marks the objects that what is in a box may touch, unless it is `clear` of theirs; tells whether there are any.
    fn mark_near(&mut self, bounds: &Aabb, clear: impl Fn(&Aabb) -> bool) -> bool {
        let mut any = false;
        if bounds.overlaps(&self.bounds) {
            for (_, own, touched) in &mut self.objects {
                let near = own.overlaps(bounds) && !clear(own);
                (*touched, any) = (*touched || near, any || near);
            }
        }
        any
    }
}

impl Contacts {
    /// Finds the opaque surfaces that may touch a transparent object, and marks such objects. `None` if there are none.
    pub fn find(scene: &mut Scene) -> Option<Self> {
        let mut glass = Glass::of(scene);
        let is_opaque = |object: &ObjectId| scene.object(*object).material.medium().is_none();
        let near = (0..).zip(&scene.triangle_objects).filter(|&(index, object)| {
            let corners = scene.triangles[index as usize].map(|i| scene.positions[i as usize]);
            is_opaque(object) && glass.mark_near(&Aabb::from_points(corners), |_| false)
        });
        let triangles: Vec<_> = near.map(|(index, _)| TriangleId(index)).collect();
        let near = (0..).zip(&scene.analytic_objects).filter(|&(index, object)| {
            let shape = scene.analytic(AnalyticId(index));
            is_opaque(object) && glass.mark_near(&shape.bounds(), |glass| shape.encloses(glass))
        });
        let analytic: Vec<_> = near.map(|(index, _)| AnalyticId(index)).collect();

        let corners: Vec<_> = triangles.iter().map(|TriangleId(i)| scene.triangles[*i as usize]).collect();
        let boxes: Vec<_> = analytic.iter().map(|id| scene.analytic(*id).bounds()).collect();
        let tree = Bvh::build(&scene.positions, &corners, &boxes);
        for (ObjectId(index), _, touched) in glass.objects {
            scene.objects[index as usize].touched = touched;
        }
        (!(triangles.is_empty() && analytic.is_empty())).then_some(Self { tree, triangles, analytic })
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
    /// A point just off the start of a light path on the side of the start's normal: past the face of a transparent object
    /// that the start is in contact with, so that it tells what the path is inside of.
    pub fn clear_of_contacts(&self, start: &EmissionStart, origin: Vec3) -> Vec3 {
        let EmissionStart { point, error, normal } = *start;
        let reach = reach(normal, error);
        let probe = Ray { origin: point + normal * (2.0 * reach), direction: -normal };
        let mut clear = origin;
        let analytic = |index, t_max| Some(self.analytic(index).intersect(&probe, t_max)?.t as f32);
        if self.contacts.is_some() && normal != Vec3::ZERO {
            self.bvh.visit(&probe, 4.0 * reach, analytic, |primitive, t| {
                let Some(face) = self.surface_on(&probe, primitive, t, 4.0 * reach) else { return };
                let rounding = rounding((normal, error), &face);
                if self.object(face.object).touched && (face.point - point).dot(normal).abs() <= rounding {
                    clear = point + normal * (2.0 * rounding);
                }
            });
        }
        clear
    }

    /// Whether a ray that meets a surface set out from what touches it: it is on the other side already if it was before.
    pub fn sets_out_in_contact(&self, surface: &Surface, direction: Vec3) -> bool {
        let climb = || surface.t * surface.geometric.as_vec3().dot(direction).abs();
        self.object(surface.object).touched && climb() <= 4.0 * reach(surface.geometric.as_vec3(), surface.error)
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
        let reach = reach(normal, surface.error);
        let across = |to: Vec3| (to - surface.point).dot(normal).abs();
        // What is there is asked along the normal, so that the answer depends on the place and not on the ray.
        let probe = Ray { origin: surface.point + normal * (2.0 * reach), direction: -normal };
        let mut touching: Option<Surface> = None;
        contacts.visit(self, &probe, 4.0 * reach, |other| {
            let precedence = |s: &Surface| self.object(s.object).precedence(s.object);
            let first = touching.is_none_or(|best| precedence(&best) < precedence(&other));
            let opaque = other.geometric.as_vec3();
            let gap = (other.point - surface.point).dot(opaque).abs();
            if first && gap <= rounding((opaque, other.error), surface) {
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
