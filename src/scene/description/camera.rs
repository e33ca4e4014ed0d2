//! The camera.

use super::JsonPath;
use super::codec::{Choice, Number, Object, Range, Record, Variant};
use super::shapes::LENGTH;
use super::vector::{DIRECTION, POINT, are_parallel, norm, subtract};
use crate::{ErrorKind, Result};

/// A perspective camera: pinhole if `aperture_radius` is 0, else a thin lens.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraDescription {
    /// Position of the pinhole or lens centre, metres.
    pub from: [f64; 3],
    /// Point looked at, metres.
    pub to: [f64; 3],
    /// Direction that is up in the picture.
    pub up: [f64; 3],
    /// Field of view along `fov_axis`, degrees in (0, 180).
    pub fov_degrees: f64,
    /// The axis that `fov_degrees` spans.
    pub fov_axis: FovAxis,
    /// Lens radius, metres.
    pub aperture_radius: f64,
    /// Distance of the plane in focus, metres; |to − from| by default.
    pub focus_distance: f64,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The axis of the picture that the field of view spans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FovAxis {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
}

const CAMERAS: &[Variant<CameraDescription>] = &[Variant {
    name: "perspective",
    what: "a perspective camera",
    doc: "A pinhole camera, or a thin lens if `aperture_radius` is not 0.",
    read: perspective,
}];

const FOV_AXIS: Choice<FovAxis> =
    Choice { what: "an axis", names: &[("x", FovAxis::X, "Horizontal."), ("y", FovAxis::Y, "Vertical.")] };

/// The camera.
pub const CAMERA: Record<CameraDescription> = Record { what: "a camera", doc: "The camera.", read: camera };

fn camera(o: &mut Object) -> Result<CameraDescription> {
    let camera = o.tagged("type", CAMERAS)?;
    o.name()?;
    Ok(camera)
}

#[rustfmt::skip] // one key a line
fn perspective(o: &mut Object) -> Result<CameraDescription> {
    let from = o.required("from", POINT, "Position of the pinhole or of the lens's centre, metres.")?;
    let to = o.required("to", POINT, "Point looked at, metres.")?;
    let up = o.default("up", DIRECTION, "[0, 1, 0]", "Direction that is up in the picture.")?;
    let fov_degrees = o.default("fov_degrees", Number(Range::between(0.0, 180.0)), "40", "Full field of view along `fov_axis`, degrees.")?;
    let fov_axis = o.default("fov_axis", FOV_AXIS, "\"x\"", "The axis of the picture that `fov_degrees` spans.")?;
    let aperture_radius = o.default("aperture_radius", Number(Range::LENGTH_OR_ZERO), "0", "Lens radius, metres; 0 is a pinhole.")?;
    let focus_distance = o.optional("focus_distance", LENGTH, "Distance in focus, metres; |to − from| by default.")?;
    let view = subtract(to, from);
    let same = || "`from` and `to` are the same point; expected two".into();
    o.refuse_if(from == to, ErrorKind::Degenerate, "", same)?;
    let parallel = || "`up` is parallel to the view; expected another direction".into();
    o.refuse_if(are_parallel(view, up), ErrorKind::Degenerate, "", parallel)?;
    let focus_distance = focus_distance.unwrap_or(norm(view));
    Ok(CameraDescription { from, to, up, fov_degrees, fov_axis, aperture_radius, focus_distance, at: o.at() })
}
