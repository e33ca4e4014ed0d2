//! The spherical lens.

use super::super::codec::{Array, Object, Range, Value, error};
use super::super::path::Path;
use super::super::text::show;
use super::{LENGTH, ShapeDescription};
use crate::{ErrorKind, Result};

const RADII: Array<2> = Array { item: Range::COORDINATE, null: true };

pub fn read(o: &mut Object) -> Result<ShapeDescription> {
    let doc = "Radii of curvature of the faces towards −z and +z, metres: positive when convex, negative when concave, \
               null when flat.";
    let radii = o.required("radii", RADII, doc)?;
    let thickness = o.required("thickness", LENGTH, "Thickness on the axis, metres.")?;
    let diameter = o.required("diameter", LENGTH, "Diameter, metres.")?;
    o.check(|value| check_radii(value, radii, diameter))?;
    let edge = thickness - sag(radii[0], 0.5 * diameter) - sag(radii[1], 0.5 * diameter);
    let meet = edge < -8.0 * f64::EPSILON * thickness.max(0.5 * diameter);
    o.refuse_if(meet, ErrorKind::Degenerate, "thickness", || {
        format!(
            "the faces meet before the rim: at this diameter and these radii the thickness must be at least {}, found {}",
            show(thickness - edge),
            show(thickness)
        )
    })?;
    Ok(ShapeDescription::Lens { radii, thickness, diameter })
}

/// Checks that each face spans the diameter.
fn check_radii(value: &Value, radii: [f64; 2], diameter: f64) -> Result<()> {
    let half = 0.5 * diameter;
    let Some(i) = radii.iter().position(|radius| radius.abs() < half) else { return Ok(()) };
    let message = format!(
        "a face of radius {} cannot span the diameter {}; expected at least {}, or null for a flat face",
        show(radii[i]),
        show(diameter),
        show(half)
    );
    let path = Path::Key(value.path, "radii");
    Err(error(ErrorKind::OutOfRange, &Path::Index(&path, i), message))
}

/// The height of a face's bulge at half the diameter from the axis: |R| − √(R² − h²), written without cancellation as
/// h² / (|R| + √(R² − h²)).
fn sag(radius: f64, half: f64) -> f64 {
    let size = radius.abs();
    if size.is_infinite() {
        return 0.0;
    }
    (half / (size + ((size - half) * (size + half)).sqrt()) * half).copysign(radius)
}
