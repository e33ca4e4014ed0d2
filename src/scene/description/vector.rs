//! Points and directions, and when two of them span no plane.

use super::codec::{Array, Checked, Range};
use super::path::Path;
use crate::ErrorKind;

/// Below this sine of the angle between them, two directions count as parallel: a few roundings of f64.
pub const PARALLEL: f64 = 64.0 * f64::EPSILON;

/// A point or vector.
pub const POINT: Array<3> = Array::of(Range::COORDINATE);

/// A vector that is not 0.
pub const DIRECTION: Checked<Array<3>> = Checked {
    codec: POINT,
    check: |value, vector| match (vector, value.path) {
        ([0.0, 0.0, 0.0], Path::Key(_, key)) => {
            let message = format!("`{key}` is the zero vector; expected a direction");
            Err(value.error(ErrorKind::Degenerate, message))
        }
        _ => Ok(()),
    },
};

/// Whether two vectors span no plane: one is 0, or they are parallel to within rounding.
pub fn are_parallel(u: [f64; 3], v: [f64; 3]) -> bool {
    let (Some(u), Some(v)) = (unit(u), unit(v)) else { return true };
    norm(cross(u, v)) <= PARALLEL
}

/// The vector product.
pub fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The length of a vector.
pub fn norm(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// The direction of a vector of any size; `None` for 0.
pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    if largest == 0.0 {
        return None;
    }
    let v = v.map(|x| x / largest);
    let length = norm(v);
    Some(v.map(|x| x / length))
}

/// The difference of two points.
pub fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
