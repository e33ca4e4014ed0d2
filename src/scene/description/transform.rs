//! Transforms of objects.

use super::codec::{Array, Checked, Defined, List, Number, NumberOr, Object, Range, Record, Value, Variant};
use super::text::show;
use super::vector::{DIRECTION, PARALLEL, POINT, cross, unit};
use crate::{Error, ErrorKind, Result};

/// One step of an object's transform.
#[derive(Debug, Clone, PartialEq)]
pub enum TransformStep {
    /// Shift, metres.
    Translate([f64; 3]),
    /// Rotation about an axis through the origin, right-handed.
    Rotate {
        /// Angle, degrees.
        degrees: f64,
        /// Axis, not zero.
        axis: [f64; 3],
    },
    /// Factors along x, y, z.
    Scale([f64; 3]),
    /// An affine matrix in row-major order; its last row is 0 0 0 1.
    Matrix([f64; 16]),
}

/// Most steps of a transform.
const MAX_STEPS: usize = 64;

/// The steps of a transform.
pub const TRANSFORM: List<Defined<Record<TransformStep>>> =
    List { what: "a transform step", item: STEP, min: 0, max: MAX_STEPS };

const STEP: Defined<Record<TransformStep>> = Defined {
    name: "transform_step",
    codec: || Record { what: "a transform step", doc: "One step of a transform.", read: |o| o.form(STEPS) },
};

#[rustfmt::skip] // one form a line
const STEPS: &[Variant<TransformStep>] = &[
    Variant { name: "translate", what: "a translation", doc: "A shift.", read: translate },
    Variant { name: "rotate_degrees", what: "a rotation", doc: "A rotation about an axis through the origin.", read: rotate },
    Variant { name: "scale", what: "a scaling", doc: "A scaling about the origin.", read: scale },
    Variant { name: "matrix", what: "a matrix", doc: "An affine map.", read: matrix },
];

fn translate(o: &mut Object) -> Result<TransformStep> {
    Ok(TransformStep::Translate(o.required("translate", POINT, "Shift, metres.")?))
}

fn rotate(o: &mut Object) -> Result<TransformStep> {
    let angle = Number(Range::from_to(-1e6, 1e6));
    Ok(TransformStep::Rotate {
        degrees: o.required("rotate_degrees", angle, "Angle, degrees; right-handed about the axis.")?,
        axis: o.required("axis", DIRECTION, "Axis through the origin, of any length but 0.")?,
    })
}

fn scale(o: &mut Object) -> Result<TransformStep> {
    let factors = NumberOr { range: Range::COORDINATE, from_number: |factor| [factor; 3], other: POINT };
    let factors = Checked { codec: factors, check: check_factors };
    Ok(TransformStep::Scale(o.required("scale", factors, "One factor, or one for each axis; not 0.")?))
}

fn check_factors(value: &Value, factors: &[f64; 3]) -> Result<()> {
    if factors.contains(&0.0) { Err(singular(value, "a factor of 0")) } else { Ok(()) }
}

fn matrix(o: &mut Object) -> Result<TransformStep> {
    let matrix = Checked { codec: Array::of(Range::COORDINATE), check: check_matrix };
    let doc = "An affine matrix, row by row; its last row is 0 0 0 1.";
    Ok(TransformStep::Matrix(o.required("matrix", matrix, doc)?))
}

fn check_matrix(value: &Value, m: &[f64; 16]) -> Result<()> {
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let row = m[12..].iter().map(|x| show(*x)).collect::<Vec<_>>().join(" ");
        let message = format!("the last row must be 0 0 0 1 (row-major, the shift in the last column), found {row}");
        return Err(value.error(ErrorKind::OutOfRange, message));
    }
    // The volume that the columns' directions span is 0 when they lie in a plane, whatever their lengths.
    let column = |i: usize| unit([m[i], m[4 + i], m[8 + i]]);
    let (Some(a), Some(b), Some(c)) = (column(0), column(1), column(2)) else {
        return Err(singular(value, "the matrix is singular, a column is 0"));
    };
    let normal = cross(a, b);
    let volume = normal[0] * c[0] + normal[1] * c[1] + normal[2] * c[2];
    if volume.abs() <= PARALLEL {
        return Err(singular(value, "the matrix is singular, its columns lie in a plane"));
    }
    Ok(())
}

fn singular(value: &Value, why: &str) -> Error {
    value.error(ErrorKind::Degenerate, format!("{why}; expected a transform that can be undone"))
}
