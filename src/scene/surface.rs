//! Where a ray meets a surface, and the coordinates of that point on it.

use super::{EmissionStart, ObjectId, Scene};
use crate::geometry::{
    Analytic, AnalyticHit, AnalyticId, Parametrization, Primitive, Ray, TriangleHit, TriangleId, geometric_normal,
    offset_origin,
};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A hit on a surface.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// Distance.
    pub t: f32,
    /// The point, on the surface within `error`.
    pub point: Vec3,
    /// Bound of the error of each component of `point`.
    pub error: Vec3,
    /// Unit outward normal.
    pub geometric: DVec3,
    /// Interpolated normal, on the same side.
    pub shading: Vec3,
    /// The object.
    pub object: ObjectId,
    /// Which primitive was hit, and where; `None` for a point that no ray has met.
    pub place: Option<Place>,
}

/// A place on a primitive: what [`Scene::uv`] and [`Scene::parametrization`] start from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// On a triangle.
    Triangle {
        /// The triangle.
        index: TriangleId,
        /// Weights of the second and of the third vertex.
        barycentrics: [f32; 2],
    },
    /// On an analytic shape.
    Analytic {
        /// The shape.
        index: AnalyticId,
        /// Which of the shape's surfaces.
        face: u8,
    },
}

impl Surface {
    /// A ray that leaves the surface.
    pub fn spawn(&self, direction: Vec3) -> Ray {
        Ray { origin: offset_origin(self.point, self.error, self.geometric.as_vec3(), direction), direction }
    }

    /// The point just off a light from which a light path starts. It belongs to no object.
    pub fn of_emission(start: &EmissionStart) -> Self {
        Self {
            t: 0.0,
            point: offset_origin(start.point, start.error, start.normal, start.normal),
            error: Vec3::ZERO,
            geometric: start.normal.as_dvec3(),
            shading: start.normal,
            object: ObjectId::NONE,
            place: None,
        }
    }
}

impl Scene {
    /// The first surface on a ray. Where an opaque surface touches a transparent object, it is the opaque one.
    pub fn closest(&self, ray: &Ray, t_max: f32) -> Option<Surface> {
        let mut last: Option<(AnalyticId, AnalyticHit)> = None;
        let hit = self.bvh.closest(ray, t_max, |index, t_max| {
            let hit = self.analytic(index).intersect(ray, t_max)?;
            last = Some((index, hit));
            Some(hit.t as f32)
        })?;
        let surface = match (hit.primitive, last) {
            (Primitive::Analytic(index), Some((last, hit))) if last == index => self.analytic_surface(index, &hit),
            (primitive, _) => self.surface_on(ray, primitive, hit.t, t_max)?,
        };
        if self.object(surface.object).touched {
            return self.in_contact(ray, surface, t_max);
        }
        Some(surface)
    }

    /// The surface of a primitive that a ray is known to meet.
    #[inline]
    pub(super) fn surface_on(&self, ray: &Ray, primitive: Primitive, t: f32, t_max: f32) -> Option<Surface> {
        match primitive {
            Primitive::Triangle(index) => self.triangle_surface(ray, index, t),
            Primitive::Analytic(index) => {
                Some(self.analytic_surface(index, &self.analytic(index).intersect(ray, t_max)?))
            }
        }
    }

    #[inline]
    fn analytic_surface(&self, index: AnalyticId, hit: &AnalyticHit) -> Surface {
        Surface {
            t: hit.t as f32,
            point: hit.point.as_vec3(),
            error: hit.error,
            geometric: hit.normal,
            shading: hit.normal.as_vec3(),
            object: self.analytic_objects[index.0 as usize],
            place: Some(Place::Analytic { index, face: hit.face }),
        }
    }

    #[inline]
    fn triangle(&self, TriangleId(index): TriangleId) -> [u32; 3] {
        self.triangles[index as usize]
    }

    #[inline]
    pub(super) fn analytic(&self, AnalyticId(index): AnalyticId) -> &Analytic {
        &self.analytic[index as usize]
    }

    /// Whether anything is in the way.
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        self.bvh.occluded(ray, t_max, |index, t_max| self.analytic(index).hits(ray, t_max))
    }

    fn triangle_surface(&self, ray: &Ray, index: TriangleId, t: f32) -> Option<Surface> {
        let [a, b, c] = self.triangle(index);
        let vertices = [a, b, c].map(|i| self.positions[i as usize]);
        let hit = TriangleHit::new(ray, vertices)?;
        let geometric = geometric_normal(vertices[0], vertices[1], vertices[2])?;
        let object = self.triangle_objects[index.0 as usize];
        let mut shading = geometric.as_vec3();
        let [wa, wb, wc] = hit.barycentrics;
        if !self.normals.is_empty() && self.object(object).material.uses_shading_normals() {
            let [na, nb, nc] = [a, b, c].map(|i| self.normals[i as usize]);
            let smooth = (na * wa + nb * wb + nc * wc).normalize_or_zero();
            if smooth.dot(shading) > 0.0 {
                shading = smooth;
            }
        }
        let place = Some(Place::Triangle { index, barycentrics: [wb, wc] });
        Some(Surface { t, point: hit.point, error: hit.error, geometric, shading, object, place })
    }

    /// Texture coordinates at a surface: those of the mesh, or the natural ones of the shape. `None` for a mesh without, for
    /// most implicit surfaces, for points that no ray has met, and for convex glass that is kept as a polyhedron.
    pub fn uv(&self, surface: &Surface) -> Option<Vec2> {
        match surface.place? {
            Place::Triangle { index, barycentrics: [b, c] } => {
                let [uv_a, uv_b, uv_c] = self.triangle_uvs(index)?;
                Some(uv_a * (1.0 - b - c) + uv_b * b + uv_c * c)
            }
            Place::Analytic { .. } => Some(self.parametrization(surface)?.uv.as_vec2()),
        }
    }

    /// Texture coordinates at a surface with the derivatives of the point by them, for the footprint of a texture lookup.
    /// `None` where [`Self::uv`] is, and where the coordinates of a triangle have no area.
    pub fn parametrization(&self, surface: &Surface) -> Option<Parametrization> {
        match surface.place? {
            Place::Triangle { index, .. } => {
                let [a, b, c] = self.triangle(index).map(|i| self.positions[i as usize].as_dvec3());
                let [uv_a, uv_b, uv_c] = self.triangle_uvs(index)?.map(|uv| uv.as_dvec2());
                let (p, q) = (b - a, c - a);
                let (s, t): (DVec2, DVec2) = (uv_b - uv_a, uv_c - uv_a);
                let determinant = s.perp_dot(t);
                let (dp_du, dp_dv) = ((p * t.y - q * s.y) / determinant, (q * s.x - p * t.x) / determinant);
                let uv = self.uv(surface)?.as_dvec2();
                (determinant != 0.0).then_some(Parametrization { uv, dp_du, dp_dv })
            }
            Place::Analytic { index, face } => self.analytic(index).parametrization(face, surface.point.as_dvec3()),
        }
    }

    /// Texture coordinates of a triangle's corners, if its mesh has any.
    fn triangle_uvs(&self, index: TriangleId) -> Option<[Vec2; 3]> {
        let [a, b, c] = self.triangle(index).map(|i| self.uvs.get(i as usize).copied());
        let uvs = [a?, b?, c?];
        uvs.iter().all(|uv| uv.is_finite()).then_some(uvs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{compile, description};

    /// A scene with one object.
    fn scene(shape: &str, material: &str) -> Scene {
        scaled_scene(shape, material, [0.9, 0.8, 1.1])
    }

    fn scaled_scene(shape: &str, material: &str, scale: [f64; 3]) -> Scene {
        let text = format!(
            r#"{{ "camera": {{ "type": "perspective", "from": [0, 0, 4], "to": [0, 0, 0] }},
                  "film": {{ "width": 4, "height": 4 }},
                  "materials": {{ "grey": {{ "type": "diffuse", "reflectance": 0.5 }},
                                  "glass": {{ "type": "dielectric", "ior": 1.5 }} }},
                  "objects": [ {{ "shape": {shape}, "material": "{material}",
                                  "transform": [ {{ "scale": {scale:?} }},
                                                 {{ "rotate_degrees": 35, "axis": [1, 2, -1] }} ] }} ],
                  "environment": {{ "radiance": 1 }} }}"#
        );
        compile(&description::parse_str(&text, "test.json".as_ref()).unwrap().description).unwrap().scene
    }

    /// Centre of the object's box and half of its diagonal: compiling has shifted and scaled the scene.
    fn place_of_object(scene: &Scene) -> (Vec3, f32) {
        let bounds = scene.objects[0].bounds;
        (bounds.center(), 0.5 * (bounds.max - bounds.min).length())
    }

    /// Rays from everywhere towards points near the middle of the object, each with one that starts close by.
    fn ray_pairs(scene: &Scene) -> impl Iterator<Item = [Ray; 2]> {
        let (center, size) = place_of_object(scene);
        let fraction = |i: u32, factor: f64| (f64::from(i) * factor).fract() as f32;
        (1..4000).map(move |i| {
            let spread = |factors: [f64; 3]| Vec3::from_array(factors.map(|f| 2.0 * fraction(i, f) - 1.0));
            let origin = spread([0.754_877, 0.569_841, 0.327_109]).normalize() * 2.0;
            let target = spread([0.618_034, 0.414_214, 0.732_051]) * 0.4;
            let near = origin + spread([0.302_776, 0.236_068, 0.645_751]) * 1e-3;
            [origin, near]
                .map(|origin| Ray { origin: center + origin * size, direction: (target - origin).normalize() })
        })
    }

    /// From one point to another nearby the surface moves as its derivatives by u and v say, and u × v points outward.
    fn check_coordinates(shape: &str, scale: [f64; 3]) {
        let scene = scaled_scene(shape, "grey", scale);
        let (_, size) = place_of_object(&scene);
        let mut compared = 0;
        for rays in ray_pairs(&scene) {
            let [Some(a), Some(b)] = rays.map(|ray| scene.closest(&ray, f32::INFINITY)) else { continue };
            let (Some(at_a), Some(at_b)) = (scene.parametrization(&a), scene.parametrization(&b)) else { continue };
            let uv = scene.uv(&a).unwrap().as_dvec2();
            assert!(uv.cmpge(DVec2::ZERO - 1e-5).all() && uv.cmple(DVec2::ONE + 1e-5).all(), "{shape}: {uv}");
            assert!(uv.distance(at_a.uv) < 1e-5, "{shape}: {uv} {at_a:?}");
            assert!(at_a.dp_du.cross(at_a.dp_dv).dot(a.geometric) > 0.0, "{shape}: {at_a:?}");
            let (step, moved) = (at_b.uv - at_a.uv, b.point.as_dvec3() - a.point.as_dvec3());
            // Another face, beyond a seam, or too strongly curved to compare.
            if a.geometric.distance(b.geometric) > 0.01 || step.abs().max_element() > 0.05 {
                continue;
            }
            let (du, dv) = ((at_a.dp_du + at_b.dp_du) * 0.5, (at_a.dp_dv + at_b.dp_dv) * 0.5);
            let off = (du * step.x + dv * step.y).distance(moved);
            assert!(off < 1e-2 * moved.length() + 1e-5 * f64::from(size), "{shape}: {off:e} of {:e}", moved.length());
            compared += 1;
        }
        assert!(compared > 300, "{shape}: {compared}");
    }

    #[test]
    fn coordinates_and_their_derivatives_agree() {
        for shape in [
            r#"{ "type": "sphere", "center": [0.05, 0, 0.1], "radius": 0.5 }"#,
            r#"{ "type": "disk", "center": [0, 0.1, 0], "normal": [1, 2, 0.5], "radius": 0.6 }"#,
            r#"{ "type": "quad", "origin": [-0.5, -0.4, 0.1], "u": [1, 0.2, 0], "v": [0.1, 0.9, 0.3] }"#,
            r#"{ "type": "box", "min": [-0.5, -0.3, -0.4], "max": [0.4, 0.5, 0.3] }"#,
            r#"{ "type": "cylinder", "radius": 0.4, "height": 0.7 }"#,
            r#"{ "type": "lens", "radii": [0.8, -1.2], "thickness": 0.3, "diameter": 1 }"#,
            r#"{ "type": "implicit", "surface": "torus", "major_radius": 0.4, "minor_radius": 0.25 }"#,
            r#"{ "type": "triangles", "positions": [-0.5, 0, -0.5, 0.5, 0, -0.5, 0, 0.1, 0.6], "indices": [0, 2, 1],
                 "uvs": [0.1, 0.1, 0.1, 0.8, 0.9, 0.2] }"#,
        ] {
            check_coordinates(shape, [1.0; 3]);
            check_coordinates(shape, [0.9, 0.8, 1.1]);
        }
    }

    #[test]
    fn a_turned_ball_takes_its_coordinates_with_it() {
        let text = r#"{ "type": "sphere", "center": [0, 0, 0], "radius": 0.5 }"#;
        // The pole of v = 1 lies where the turn takes +y.
        let up = glam::Quat::from_axis_angle(Vec3::new(1.0, 2.0, -1.0).normalize(), 35f32.to_radians()) * Vec3::Y;
        for scale in [[0.9; 3], [0.9, 0.8, 1.1]] {
            let scene = scaled_scene(text, "grey", scale);
            let (center, size) = place_of_object(&scene);
            let ray = Ray { origin: center + up * (2.0 * size), direction: -up };
            let surface = scene.closest(&ray, f32::INFINITY).unwrap();
            assert!(scene.uv(&surface).unwrap().y > 0.999);
        }
    }

    #[test]
    fn what_has_no_coordinates_says_so() {
        let uv = |shape: &str, material: &str| {
            let scene = scene(shape, material);
            let surfaces = ray_pairs(&scene).filter_map(|[ray, _]| scene.closest(&ray, f32::INFINITY));
            surfaces.map(|surface| scene.uv(&surface)).next().unwrap()
        };
        let prism = r#"{ "type": "prism", "apex_degrees": 60, "side": 1, "length": 2 }"#;
        assert_eq!((uv(prism, "grey"), uv(prism, "glass")), (None, None));
        let gyroid = r#"{ "type": "implicit", "surface": "gyroid", "period": 0.5, "thickness": 0.1, "radius": 1 }"#;
        assert_eq!(uv(gyroid, "grey"), None);
    }
}
