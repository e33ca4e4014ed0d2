//! Single rays of one wavelength through a compiled scene: the library's shapes, intersections and refraction, and none of
//! its random choices. All that the closed-form tests of optics know of the insides of the library is in this file.
#![allow(dead_code, reason = "every test file uses its own part")]

use abbe::geometry::Ray;
use abbe::optics::{reflect, refract};
use abbe::scene::{Compiled, ObjectId, Scene};
use glam::DVec3;
use serde_json::Value;

/// What a ray does at a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    Refract,
    Reflect,
}

/// A ray, in metres and the coordinates of the scene file.
#[derive(Debug, Clone, Copy)]
pub struct Traced {
    /// A point on it: where it left the last boundary.
    pub point: DVec3,
    /// Unit direction of travel.
    pub direction: DVec3,
}

impl Traced {
    /// Where it crosses a plane at right angles to a unit axis, at this coordinate along the axis.
    pub fn at(&self, axis: DVec3, coordinate: f64) -> DVec3 {
        self.point + self.direction * ((coordinate - self.point.dot(axis)) / self.direction.dot(axis))
    }
}

/// Traces rays through a scene.
pub struct Tracer<'a> {
    scene: &'a Scene,
    /// The compiled scene's origin and unit of length, in the file's metres.
    center: DVec3,
    unit: f64,
}

impl<'a> Tracer<'a> {
    /// For a compiled scene and the file it came from. A compiled scene is recentred: by how much, its camera tells.
    pub fn new(compiled: &'a Compiled, file: &Value) -> Self {
        let scene = &compiled.scene;
        let from: [f64; 3] = serde_json::from_value(file["camera"]["from"].clone()).expect("camera.from");
        let unit = scene.meters_per_unit;
        Self { scene, center: DVec3::from(from) - scene.camera.position().as_dvec3() * unit, unit }
    }

    /// Follows a ray from a point in air through the boundaries for which events are given, and insists that there are no
    /// others. What lies between equal media is no boundary.
    pub fn trace(&self, from: DVec3, direction: DVec3, lambda_nm: f64, events: &[Event]) -> Traced {
        let mut ray = Ray { origin: ((from - self.center) / self.unit).as_vec3(), direction: direction.as_vec3() };
        let mut inside: Vec<ObjectId> = Vec::new();
        let (mut point, mut met) = (from, 0);
        while let Some(surface) = self.scene.closest(&ray, f32::INFINITY) {
            let d = ray.direction.as_dvec3().normalize();
            let entering = surface.geometric.dot(d) < 0.0;
            let mut beyond = inside.clone();
            if entering {
                beyond.push(surface.object);
            } else {
                beyond.retain(|object| *object != surface.object);
                assert_eq!(beyond.len() + 1, inside.len(), "a ray leaves what it has entered");
            }
            let (eta_i, eta_t) = (self.index(&inside, lambda_nm), self.index(&beyond, lambda_nm));
            if eta_i == eta_t {
                (ray, inside) = (surface.spawn(ray.direction), beyond);
                continue;
            }
            assert!(met < events.len(), "more boundaries than the {met} expected");
            let normal = if entering { surface.geometric } else { -surface.geometric };
            let cos = -d.dot(normal);
            let next = match events[met] {
                Event::Reflect => reflect(d, normal),
                Event::Refract => {
                    inside = beyond;
                    let refraction = refract(cos, eta_i, eta_t).expect("no total reflection is expected");
                    refraction.direction(d, normal, cos, eta_i, eta_t)
                }
            };
            ray = surface.spawn(next.as_vec3());
            point = surface.point.as_dvec3() * self.unit + self.center;
            met += 1;
        }
        assert_eq!(met, events.len(), "fewer boundaries than expected");
        Traced { point, direction: ray.direction.as_dvec3().normalize() }
    }

    /// Index of what wins among objects: the highest priority, and of equals the one entered last.
    fn index(&self, inside: &[ObjectId], lambda_nm: f64) -> f64 {
        let medium = |object: &ObjectId| {
            let medium = self.scene.object(*object).material.medium();
            &self.scene.media[medium.expect("rays are traced through glass alone").0 as usize]
        };
        inside.iter().map(medium).max_by_key(|m| m.priority).map_or(1.0, |m| m.ior.eval(lambda_nm))
    }
}
