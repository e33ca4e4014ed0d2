//! A shape under an affine transform.

use super::super::hit::{AnalyticHit, F64_CHAIN, HALF_ULP, LocalHit, inflated};
use super::super::offset_origin;
use super::super::shape::{LocalShape, Parametrization};
use super::super::sphere::{PlacedBall, Sphere};
use super::kinds::AnalyticShape;
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// A shape with the transforms between its local space and the world.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Transformed {
    shape: AnalyticShape,
    world_from_local: DAffine3,
    local_from_world: DAffine3,
}

/// Largest condition number of a transform: beyond it f64 cannot tell where the object's surface is.
const MAX_CONDITION: f64 = 1e12;
/// Doublings of the error bound until both offset points lie on their sides.
const MAX_DOUBLINGS: u32 = 12;

impl Transformed {
    /// Errors: `NotFinite` or `Degenerate` for a transform that is not finite or (numerically) singular.
    pub fn new(shape: AnalyticShape, world_from_object: &DAffine3) -> Result<Self> {
        let object_from_local = shape.object_from_local();
        let object_from_world = inverse(world_from_object)?;
        Ok(Self {
            shape,
            world_from_local: *world_from_object * object_from_local,
            local_from_world: object_from_local.inverse() * object_from_world,
        })
    }

    /// The sphere that this still is in the world, if it is one.
    pub fn as_ball(&self) -> Option<PlacedBall> {
        let AnalyticShape::Sphere(_) = self.shape else { return None };
        let radius = similarity(&self.world_from_local.matrix3)?;
        let sphere = Sphere { center: self.world_from_local.translation, radius };
        Some(PlacedBall::new(sphere, self.world_from_local.matrix3))
    }

    pub fn shape(&self) -> &AnalyticShape {
        &self.shape
    }

    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.shape.bounds(&self.world_from_local)
    }

    pub fn contains(&self, point: DVec3) -> bool {
        self.shape.contains(self.local_from_world.transform_point3(point))
    }

    pub fn intersect(&self, o: DVec3, d: DVec3, t_max: f64) -> Option<AnalyticHit> {
        let (o, d) = self.line_to_local(o, d);
        Some(self.hit_to_world(&self.shape.intersect(o, d, t_max)?))
    }

    pub fn hits(&self, o: DVec3, d: DVec3, t_max: f64) -> bool {
        let (o, d) = self.line_to_local(o, d);
        self.shape.hits(o, d, t_max)
    }

    /// Unit normals of flat facets, and the distances of their planes from the origin.
    pub fn planes(&self) -> Vec<(DVec3, f64)> {
        let plane = |(normal, point): (DVec3, DVec3)| {
            let normal = self.normal_to_world(normal);
            (normal, normal.dot(self.world_from_local.transform_point3(point)))
        };
        self.shape.facets().into_iter().map(plane).collect()
    }

    /// Surface coordinates at a point in the world.
    pub fn parametrization(&self, face: u8, point: DVec3) -> Option<Parametrization> {
        let local = self.shape.parametrization(face, self.local_from_world.transform_point3(point))?;
        let to_world = |v: DVec3| self.world_from_local.transform_vector3(v);
        Some(Parametrization { uv: local.uv, dp_du: to_world(local.dp_du), dp_dv: to_world(local.dp_dv) })
    }

    /// A ray in local space. The direction keeps its length, so that t means the same in both spaces.
    fn line_to_local(&self, o: DVec3, d: DVec3) -> (DVec3, DVec3) {
        (self.local_from_world.transform_point3(o), self.local_from_world.transform_vector3(d))
    }

    fn normal_to_world(&self, normal: DVec3) -> DVec3 {
        (self.local_from_world.matrix3.transpose() * normal).normalize()
    }

    /// Takes a hit to the world. The bound of its error starts from rounding and grows until the points that
    /// [`offset_origin`] makes of it lie on their sides of the exact surface, which covers curvature of any kind.
    fn hit_to_world(&self, hit: &LocalHit) -> AnalyticHit {
        let m = &self.world_from_local.matrix3;
        let point = self.world_from_local.transform_point3(hit.point);
        let normal = self.normal_to_world(hit.normal);
        let reach = m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs();
        let f64_error = reach * (hit.distance + hit.point.length() * F64_CHAIN) + point.abs() * F64_CHAIN;
        let mut error = inflated(point.abs() * HALF_ULP + f64_error);
        let (p, n) = (point.as_vec3(), normal.as_vec3());
        let side = |direction: Vec3, error: Vec3| {
            let start = offset_origin(p, error, n, direction).as_dvec3();
            self.shape.side(hit.face, self.local_from_world.transform_point3(start))
        };
        let mut doubled = error;
        for _ in 0..=MAX_DOUBLINGS {
            if side(n, doubled) > 0.0 && side(-n, doubled) < 0.0 {
                error = doubled;
                break;
            }
            doubled *= 2.0;
        }
        AnalyticHit { t: hit.t, point, normal, error, face: hit.face }
    }
}

/// The inverse of a transform that has one.
fn inverse(transform: &DAffine3) -> Result<DAffine3> {
    if !transform.is_finite() {
        return Err(Error::new(ErrorKind::NotFinite, format!("transform {transform} is not finite")));
    }
    let inverse = transform.inverse();
    let size = |m: &DMat3| m.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    let condition = size(&transform.matrix3) * size(&inverse.matrix3);
    if !inverse.is_finite() || condition >= MAX_CONDITION {
        let message =
            format!("the transform is singular (condition {condition:.1e}); expected below {MAX_CONDITION:.0e}");
        return Err(Error::new(ErrorKind::Degenerate, message));
    }
    Ok(inverse)
}

/// The factor of a matrix that is a rotation (or reflection) times a factor, up to the rounding of a long product.
fn similarity(m: &DMat3) -> Option<f64> {
    let tolerance = 4096.0 * f64::EPSILON;
    let gram = m.transpose() * *m;
    let square = (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
    let difference = (gram - DMat3::from_diagonal(DVec3::splat(square))).to_cols_array();
    difference.into_iter().all(|x| x.abs() <= tolerance * square).then(|| square.sqrt())
}
