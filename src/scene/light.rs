//! Lights: sampled from a point (next-event estimation), met by a ray, or the start of light paths.

use super::{Scene, SpectrumId, Surface};
use crate::geometry::{Aabb, offset_origin, orthonormal_basis, sample_triangle};
use crate::math;
use crate::sampling::{
    AliasTable, concentric_disk, concentric_disk_inverse, cosine_hemisphere, uniform_cone, uniform_cone_inverse,
    uniform_sphere,
};
use crate::spectrum::WavelengthDensity;
use glam::Vec3;
use std::f32::consts::{FRAC_1_PI, PI, TAU};

/// A light. Its radiance (or intensity, irradiance, power) is `factor` times its spectrum, in units of the compiled scene.
#[derive(Debug, Clone)]
pub struct Light {
    /// Where the light comes from.
    pub kind: LightKind,
    /// Spectral shape.
    pub spectrum: SpectrumId,
    /// Wavelengths of light paths that start here.
    pub wavelengths: WavelengthDensity,
    /// Whether its starting points can lie inside a transparent object.
    pub may_be_inside: bool,
}

/// The kinds of light.
#[derive(Debug, Clone)]
pub enum LightKind {
    /// A surface that emits `radiance` diffusely.
    Area {
        /// Its shape, for drawing points.
        shape: AreaShape,
        /// Area of one side.
        area: f32,
        /// Whether the back emits as well.
        two_sided: bool,
    },
    /// A point of equal intensity in all directions.
    Point {
        /// Where.
        position: Vec3,
    },
    /// A cone of light with a smooth edge.
    Spot {
        /// Where.
        position: Vec3,
        /// Unit axis.
        axis: Vec3,
        /// 1 − cos of the half angle of full intensity.
        inner: f32,
        /// 1 − cos of the half angle where it ends.
        outer: f32,
    },
    /// A disc at infinity, or parallel light if its size is 0.
    Directional {
        /// Unit direction of travel.
        direction: Vec3,
        /// 1 − cos of the disc's angular radius.
        one_minus_cos: f32,
    },
    /// Parallel light through a disc.
    Beam {
        /// Centre of the disc.
        origin: Vec3,
        /// Unit direction of travel.
        direction: Vec3,
        /// Radius.
        radius: f32,
    },
    /// The same radiance from all directions.
    Environment,
}

/// Shapes that points can be drawn from uniformly by area.
#[derive(Debug, Clone)]
pub enum AreaShape {
    /// Triangles from `first` on, drawn by area.
    Triangles {
        /// Index of the first.
        first: u32,
        /// By area.
        table: AliasTable,
    },
    /// A parallelogram.
    Parallelogram {
        /// Corner.
        origin: Vec3,
        /// Edge.
        u: Vec3,
        /// Edge.
        v: Vec3,
        /// Unit normal along u × v.
        normal: Vec3,
    },
    /// An ellipse.
    Ellipse {
        /// Centre.
        center: Vec3,
        /// Half axis.
        u: Vec3,
        /// Half axis, conjugate to the first.
        v: Vec3,
        /// Unit normal along u × v.
        normal: Vec3,
    },
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
    /// A shape that no points are drawn from: only camera paths find it.
    Unsampled,
}

impl LightKind {
    /// Power per unit of the light's spectrum.
    pub fn power(&self, scene_radius: f32) -> f64 {
        let (pi, radius) = (std::f64::consts::PI, f64::from(scene_radius));
        match *self {
            Self::Area { area, two_sided, .. } => pi * f64::from(area) * if two_sided { 2.0 } else { 1.0 },
            Self::Point { .. } => 4.0 * pi,
            Self::Spot { inner, outer, .. } => pi * f64::from(inner + outer),
            Self::Directional { .. } => pi * radius * radius,
            Self::Beam { .. } => 1.0,
            Self::Environment => 4.0 * pi * pi * radius * radius,
        }
    }
}

/// A direction towards a light.
#[derive(Debug, Clone, Copy)]
pub struct LightSample {
    /// Where the light is; `None` at infinity.
    pub target: Option<Vec3>,
    /// Unit direction towards it.
    pub wi: Vec3,
    /// Factor of the light's spectrum, divided by the density in solid angle.
    pub weight: f32,
    /// Density in solid angle; `None` if no other technique can find this direction.
    pub pdf: Option<f32>,
}

/// The start of a light path.
#[derive(Debug, Clone, Copy)]
pub struct Emission {
    /// Point on the light.
    pub start: EmissionStart,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Factor of the light's spectrum: radiance · cos θ / density of point and direction.
    pub weight: f32,
}

/// How light leaves a light: what the density of light paths depends on.
#[derive(Debug, Clone, Copy)]
pub struct Exit {
    /// Where.
    pub point: Vec3,
    /// Unit direction of travel.
    pub direction: Vec3,
    /// Cosine to the light's normal; 1 off surfaces.
    pub cos: f32,
}

/// One of the pairs of random numbers of [`Light::emit`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GuidedPair {
    /// The first: the point that a path starts from.
    Point,
    /// The second: its direction.
    Direction,
}

impl Emission {
    /// How the path leaves its light.
    pub fn exit(&self) -> Exit {
        let cos = if self.start.normal == Vec3::ZERO { 1.0 } else { self.start.normal.dot(self.direction) };
        Exit { point: self.start.point, direction: self.direction, cos }
    }
}

/// Where a light path starts.
#[derive(Debug, Clone, Copy)]
pub struct EmissionStart {
    /// The point.
    pub point: Vec3,
    /// Bound of its error; 0 off surfaces.
    pub error: Vec3,
    /// Unit normal on the emitting side; 0 off surfaces.
    pub normal: Vec3,
}

impl EmissionStart {
    fn free(point: Vec3) -> Self {
        Self { point, error: Vec3::ZERO, normal: Vec3::ZERO }
    }

    /// Where a ray in this direction starts.
    pub fn origin(&self, direction: Vec3) -> Vec3 {
        if self.normal == Vec3::ZERO {
            self.point
        } else {
            offset_origin(self.point, self.error, self.normal, direction)
        }
    }
}

impl Light {
    /// Whether next-event estimation can find it. The environment is found by the rays that scattering sends out anyway.
    pub fn is_sampled(&self) -> bool {
        !matches!(self.kind, LightKind::Environment | LightKind::Area { shape: AreaShape::Unsampled, .. })
    }

    /// Whether it lights so little of the scene that next-event estimation asks it at every point instead of drawing it: a
    /// beam, of which a point knows at once whether it lies in it.
    pub fn is_local(&self) -> bool {
        matches!(self.kind, LightKind::Beam { .. })
    }

    /// Share of its power that light paths send to what they are aimed at, roughly.
    pub fn aimed_share(&self, bounds: Option<Aabb>, aim: &Aim, scene_radius: f32) -> f64 {
        let share = match (&self.kind, bounds) {
            (LightKind::Directional { .. } | LightKind::Environment, _) => {
                let ratio = aim.radius / scene_radius;
                ratio * ratio
            }
            (LightKind::Spot { outer, .. }, Some(bounds)) => {
                aim.cone(bounds.center()).map_or(1.0, |(_, cone)| cone / outer.max(f32::MIN_POSITIVE))
            }
            (LightKind::Point { .. } | LightKind::Area { .. }, Some(bounds)) => {
                aim.cone(bounds.center()).map_or(1.0, |(_, cone)| 0.5 * cone)
            }
            _ => 1.0,
        };
        f64::from(share.min(1.0))
    }

    /// Whether a ray could run into it.
    pub fn has_extent(&self) -> bool {
        self.is_infinite() || matches!(self.kind, LightKind::Area { .. })
    }

    /// Whether light paths can start from it.
    pub fn can_emit(&self) -> bool {
        !matches!(self.kind, LightKind::Area { shape: AreaShape::Unsampled, .. })
    }

    /// Whether a ray that leaves the scene can run into it.
    pub fn is_infinite(&self) -> bool {
        matches!(self.kind, LightKind::Environment)
            || matches!(self.kind, LightKind::Directional { one_minus_cos, .. } if one_minus_cos > 0.0)
    }

    /// Draws a direction from `from` towards the light.
    pub fn sample(&self, scene: &Scene, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
        match &self.kind {
            LightKind::Area { shape: AreaShape::Sphere { center, radius }, two_sided: false, .. } => {
                sample_sphere(*center, *radius, from, u)
            }
            LightKind::Area { area, two_sided, .. } => {
                let start = self.area_point(scene, u)?;
                let to_light = start.point - from;
                let distance2 = to_light.length_squared();
                let wi = to_light / distance2.sqrt();
                let cos = -start.normal.dot(wi);
                let facing = if *two_sided { cos.abs() } else { cos };
                if facing.is_nan() || facing <= 0.0 || distance2 == 0.0 {
                    return None;
                }
                let solid_angle = facing * area / distance2;
                let target = offset_origin(start.point, start.error, start.normal, -wi);
                Some(LightSample { target: Some(target), wi, weight: solid_angle, pdf: Some(1.0 / solid_angle) })
            }
            LightKind::Point { position } => point_sample(*position, from, |_| 1.0),
            LightKind::Spot { position, axis, inner, outer } => {
                point_sample(*position, from, |to_light| spot_falloff(-to_light, *axis, *inner, *outer))
            }
            LightKind::Directional { direction, one_minus_cos } => {
                if *one_minus_cos == 0.0 {
                    return Some(LightSample { target: None, wi: -*direction, weight: 1.0, pdf: None });
                }
                let (s, t) = orthonormal_basis(-*direction);
                let local = uniform_cone(u, *one_minus_cos);
                let wi = s * local.x + t * local.y - *direction * local.z;
                let pdf = 1.0 / (TAU * one_minus_cos);
                Some(LightSample { target: None, wi, weight: disc_radiance(*one_minus_cos) / pdf, pdf: Some(pdf) })
            }
            LightKind::Beam { origin, direction, radius } => {
                let along = (from - *origin).dot(*direction);
                let target = from - *direction * along;
                if along <= 0.0 || target.distance_squared(*origin) > radius * radius {
                    return None;
                }
                Some(LightSample {
                    target: Some(target),
                    wi: -*direction,
                    weight: 1.0 / (PI * radius * radius),
                    pdf: None,
                })
            }
            LightKind::Environment => None,
        }
    }

    /// Density with which [`Self::sample`] draws the direction of a ray from `from` that met this light's surface.
    pub fn pdf_surface(&self, from: Vec3, direction: Vec3, surface: &Surface) -> f32 {
        match &self.kind {
            LightKind::Area { shape: AreaShape::Unsampled, .. } => 0.0,
            LightKind::Area { shape: AreaShape::Sphere { center, radius }, two_sided: false, .. } => {
                sphere_cone(*center, *radius, from).map_or(0.0, |one_minus_cos| 1.0 / (TAU * one_minus_cos))
            }
            LightKind::Area { area, .. } => {
                let cos = surface.geometric.as_vec3().dot(direction).abs();
                from.distance_squared(surface.point) / (cos * area)
            }
            _ => 0.0,
        }
    }

    /// Factor of the light's spectrum, and density of [`Self::sample`], for a ray that escapes the scene.
    pub fn escaped(&self, direction: Vec3) -> Option<(f32, f32)> {
        match self.kind {
            LightKind::Environment => Some((1.0, 0.0)),
            LightKind::Directional { direction: axis, one_minus_cos } if one_minus_cos > 0.0 => {
                // 1 − cos of the angle between unit vectors is half their squared distance: no digits are lost.
                let inside = 0.5 * (direction + axis).length_squared() <= one_minus_cos;
                inside.then(|| (disc_radiance(one_minus_cos), 1.0 / (TAU * one_minus_cos)))
            }
            _ => None,
        }
    }

    /// Whether a surface hit from the side of `-direction` emits towards it.
    pub fn emits(&self, surface: &Surface, direction: Vec3) -> bool {
        match self.kind {
            LightKind::Area { two_sided, .. } => two_sided || surface.geometric.as_vec3().dot(direction) < 0.0,
            _ => false,
        }
    }

    /// Density of [`Self::emit`] per unit of étendue (area times projected solid angle) for light that leaves in
    /// this way; `None` for delta lights and the environment.
    pub fn emission_density(&self, exit: &Exit, aim: &Aim) -> Option<f32> {
        match self.kind {
            LightKind::Area { area, two_sided, .. } => {
                let per_area = 1.0 / (area * if two_sided { 2.0 } else { 1.0 });
                Some(match aim.cone(exit.point) {
                    Some((_, one_minus_cos)) if !two_sided => per_area / (TAU * one_minus_cos * exit.cos),
                    _ => per_area * FRAC_1_PI,
                })
            }
            LightKind::Directional { one_minus_cos, .. } if one_minus_cos > 0.0 => {
                Some(1.0 / (TAU * one_minus_cos * PI * aim.radius * aim.radius))
            }
            _ => None,
        }
    }

    /// Which of the pairs of random numbers that [`Self::emit`] takes decides what a path of this light meets.
    pub fn guided_pair(&self) -> Option<GuidedPair> {
        match self.kind {
            LightKind::Point { .. } | LightKind::Spot { .. } | LightKind::Area { two_sided: false, .. } => {
                Some(GuidedPair::Direction)
            }
            LightKind::Directional { .. } | LightKind::Beam { .. } => Some(GuidedPair::Point),
            LightKind::Area { two_sided: true, .. } | LightKind::Environment => None,
        }
    }

    /// The guided pair of numbers from which [`Self::emit`] makes this way of leaving the light. `None` if it makes it from
    /// no such pair, or if the light has no extent, so that nobody asks.
    pub fn guided_numbers(&self, exit: &Exit, aim: &Aim) -> Option<[f32; 2]> {
        match self.kind {
            LightKind::Area { two_sided: false, .. } => {
                let (axis, one_minus_cos) = aim.cone(exit.point)?;
                let (s, t) = orthonormal_basis(axis);
                let local = Vec3::new(s.dot(exit.direction), t.dot(exit.direction), axis.dot(exit.direction));
                Some(uniform_cone_inverse(local, one_minus_cos))
            }
            LightKind::Directional { one_minus_cos, .. } if one_minus_cos > 0.0 => {
                let (s, t) = orthonormal_basis(exit.direction);
                let offset = (exit.point - aim.center) / aim.radius;
                Some(concentric_disk_inverse([s.dot(offset), t.dot(offset)]))
            }
            _ => None,
        }
    }

    /// Starts a light path towards what is aimed at: `u` draws the point, `v` the direction.
    pub fn emit(&self, scene: &Scene, aim: &Aim, u: [f32; 2], v: [f32; 2]) -> Option<Emission> {
        match &self.kind {
            LightKind::Area { area, two_sided, .. } => self.emit_from_surface(scene, aim, *area, *two_sided, u, v),
            LightKind::Point { position } => {
                let start = EmissionStart::free(*position);
                Some(match aim.sample(*position, v) {
                    Some((direction, solid_angle)) => Emission { start, direction, weight: solid_angle },
                    None => Emission { start, direction: uniform_sphere(v).normalize(), weight: 4.0 * PI },
                })
            }
            LightKind::Spot { position, axis, inner, outer } => {
                let narrower = aim.cone(*position).is_some_and(|(_, one_minus_cos)| one_minus_cos < *outer);
                let aimed = if narrower { aim.sample(*position, v) } else { None };
                let (direction, solid_angle) =
                    aimed.unwrap_or_else(|| (turned(*axis, uniform_cone(v, *outer)), TAU * outer));
                let weight = solid_angle * spot_falloff(direction, *axis, *inner, *outer);
                (weight > 0.0).then_some(Emission { start: EmissionStart::free(*position), direction, weight })
            }
            LightKind::Directional { direction: axis, one_minus_cos } => {
                let direction = turned(*axis, uniform_cone(v, *one_minus_cos));
                // Radiance times solid angle: 1 up to the cosine in `disc_radiance`.
                Some(from_infinity(scene, direction, aim, 2.0 / (2.0 - one_minus_cos), u))
            }
            LightKind::Beam { origin, direction, radius } => {
                let point = *origin + disc_offset(*direction, *radius, u);
                Some(Emission { start: EmissionStart::free(point), direction: *direction, weight: 1.0 })
            }
            LightKind::Environment => {
                let direction = uniform_sphere(v).normalize();
                Some(from_infinity(scene, direction, aim, 4.0 * PI, u))
            }
        }
    }

    fn emit_from_surface(
        &self,
        scene: &Scene,
        aim: &Aim,
        area: f32,
        two_sided: bool,
        u: [f32; 2],
        v: [f32; 2],
    ) -> Option<Emission> {
        // A two-sided light uses the first number to choose a side as well.
        let (side, u) = match two_sided {
            true if u[0] < 0.5 => (-1.0, [2.0 * u[0], u[1]]),
            true => (1.0, [2.0 * u[0] - 1.0, u[1]]),
            false => (1.0, u),
        };
        let start = self.area_point(scene, u)?;
        let normal = start.normal * side;
        let start = EmissionStart { normal, ..start };
        let area = area * if two_sided { 2.0 } else { 1.0 };
        let aimed = if two_sided { None } else { aim.sample(start.point, v) };
        let (direction, weight) = match aimed {
            Some((direction, solid_angle)) => (direction, area * solid_angle * normal.dot(direction)),
            None => (turned(normal, cosine_hemisphere(v)), area * PI),
        };
        (weight > 0.0).then_some(Emission { start, direction, weight })
    }

    /// A point uniform over the area of an area light, with its outward normal.
    fn area_point(&self, scene: &Scene, u: [f32; 2]) -> Option<EmissionStart> {
        let LightKind::Area { shape, .. } = &self.kind else { return None };
        let start = match shape {
            AreaShape::Triangles { first, table } => {
                let draw = table.sample(u[0])?;
                let vertices = scene.triangles[*first as usize + draw.index].map(|i| scene.positions[i as usize]);
                let weights = sample_triangle([draw.rest, u[1]]);
                let normal = crate::geometry::geometric_normal(vertices[0], vertices[1], vertices[2])?.as_vec3();
                let parts = std::array::from_fn::<Vec3, 3, _>(|i| vertices[i] * weights[i]);
                let size = parts[0].abs() + parts[1].abs() + parts[2].abs();
                EmissionStart { point: parts[0] + parts[1] + parts[2], error: size * math::gamma(7), normal }
            }
            AreaShape::Parallelogram { origin, u: a, v: b, normal } => on_plane(*origin, *a * u[0], *b * u[1], *normal),
            AreaShape::Ellipse { center, u: a, v: b, normal } => {
                let [x, y] = concentric_disk(u);
                on_plane(*center, *a * x, *b * y, *normal)
            }
            AreaShape::Sphere { center, radius } => {
                let normal = uniform_sphere(u).normalize();
                let error = (center.abs() + *radius) * math::gamma(5);
                EmissionStart { point: *center + normal * *radius, error, normal }
            }
            AreaShape::Unsampled => return None,
        };
        Some(start)
    }
}

/// What light paths are aimed at: a sphere that holds all that matters to them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aim {
    /// Centre.
    pub center: Vec3,
    /// Radius.
    pub radius: f32,
}

impl Aim {
    /// Axis and 1 − cos of the half angle of the cone in which it is seen; `None` from inside.
    fn cone(&self, from: Vec3) -> Option<(Vec3, f32)> {
        let one_minus_cos = sphere_cone(self.center, self.radius, from)?;
        Some(((self.center - from).normalize(), one_minus_cos))
    }

    /// A direction uniform in that cone, and the cone's solid angle.
    fn sample(&self, from: Vec3, u: [f32; 2]) -> Option<(Vec3, f32)> {
        let (axis, one_minus_cos) = self.cone(from)?;
        Some((turned(axis, uniform_cone(u, one_minus_cos)), TAU * one_minus_cos))
    }
}

/// A direction about +z, turned so that +z becomes `axis`.
fn turned(axis: Vec3, local: Vec3) -> Vec3 {
    let (s, t) = orthonormal_basis(axis);
    (s * local.x + t * local.y + axis * local.z).normalize()
}

fn on_plane(origin: Vec3, a: Vec3, b: Vec3, normal: Vec3) -> EmissionStart {
    EmissionStart { point: origin + a + b, error: (origin.abs() + a.abs() + b.abs()) * math::gamma(7), normal }
}

/// Radiance per unit of irradiance of a disc at infinity, facing it: 1 / ∫ cos θ dω = 1 / (π sin²θ).
fn disc_radiance(one_minus_cos: f32) -> f32 {
    1.0 / (PI * one_minus_cos * (2.0 - one_minus_cos))
}

/// A sample of a light at a point whose intensity towards −`to_light` has this factor.
fn point_sample(position: Vec3, from: Vec3, factor: impl Fn(Vec3) -> f32) -> Option<LightSample> {
    let to_light = position - from;
    let distance2 = to_light.length_squared();
    let wi = to_light / distance2.sqrt();
    let weight = factor(wi) / distance2;
    (weight > 0.0 && weight.is_finite()).then_some(LightSample { target: Some(position), wi, weight, pdf: None })
}

/// 1 inside the inner cone, 0 outside the outer, smooth in between.
fn spot_falloff(direction: Vec3, axis: Vec3, inner: f32, outer: f32) -> f32 {
    let off_axis = 0.5 * (direction - axis).length_squared();
    if off_axis <= inner {
        return 1.0;
    }
    let t = ((outer - off_axis) / (outer - inner)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// 1 − cos of the half angle under which a sphere is seen; `None` from inside.
fn sphere_cone(center: Vec3, radius: f32, from: Vec3) -> Option<f32> {
    let distance2 = f64::from(center.distance_squared(from));
    let sin2 = f64::from(radius) * f64::from(radius) / distance2;
    // 1 − √(1 − s) = s / (1 + √(1 − s)), without cancellation for far spheres.
    (sin2 < 1.0).then(|| (sin2 / (1.0 + (1.0 - sin2).sqrt())) as f32)
}

/// Uniform directions in the cone of a sphere that emits outward; the target is where they meet it.
fn sample_sphere(center: Vec3, radius: f32, from: Vec3, u: [f32; 2]) -> Option<LightSample> {
    let one_minus_cos = sphere_cone(center, radius, from)?;
    let to_center = center - from;
    let distance = to_center.length();
    let axis = to_center / distance;
    let (s, t) = orthonormal_basis(axis);
    let local = uniform_cone(u, one_minus_cos);
    let wi = s * local.x + t * local.y + axis * local.z;
    // Normal at the hit, from the triangle of centre, reference point and hit: cos of the angle at the centre.
    let sin2 = local.x * local.x + local.y * local.y;
    let half_chord = (radius * radius - distance * distance * sin2).max(0.0).sqrt();
    let normal = (wi * (distance * local.z - half_chord) - to_center) / radius;
    let normal = normal.normalize();
    let error = (center.abs() + radius) * math::gamma(5);
    let target = offset_origin(center + normal * radius, error, normal, normal);
    let pdf = 1.0 / (TAU * one_minus_cos);
    Some(LightSample { target: Some(target), wi, weight: 1.0 / pdf, pdf: Some(pdf) })
}

/// A point of a disc of `radius` across `direction`.
fn disc_offset(direction: Vec3, radius: f32, u: [f32; 2]) -> Vec3 {
    let (s, t) = orthonormal_basis(direction);
    let [x, y] = concentric_disk(u);
    (s * x + t * y) * radius
}

/// A ray from outside the scene onto a disc that faces it.
fn from_infinity(scene: &Scene, direction: Vec3, aim: &Aim, solid_angle: f32, u: [f32; 2]) -> Emission {
    let Aim { center, radius } = *aim;
    let point = center + disc_offset(direction, radius, u) - direction * (2.0 * scene.radius + center.length());
    Emission { start: EmissionStart::free(point), direction, weight: solid_angle * PI * radius * radius }
}
