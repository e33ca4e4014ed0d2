//! Shapes in their own coordinates.

mod brilliant;
mod implicit;
mod lens;
mod triangles;

use std::path::PathBuf;

use super::codec::{Bool, Defined, FileName, Number, Object, Range, Record, Variant, error};
use super::path::Path;
use super::text::show;
use super::vector::{DIRECTION, POINT, are_parallel};
use crate::{ErrorKind, Result};

pub use brilliant::BrilliantDescription;
pub use implicit::ImplicitDescription;

/// The shapes.
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeDescription {
    /// A sphere.
    Sphere {
        /// Centre, metres.
        center: [f64; 3],
        /// Radius, metres, > 0.
        radius: f64,
    },
    /// A parallelogram with normal u × v.
    Quad {
        /// A corner.
        origin: [f64; 3],
        /// First edge.
        u: [f64; 3],
        /// Second edge.
        v: [f64; 3],
    },
    /// A flat disk.
    Disk {
        /// Centre.
        center: [f64; 3],
        /// Normal, not zero.
        normal: [f64; 3],
        /// Radius, > 0.
        radius: f64,
    },
    /// A box with edges along the axes.
    Box {
        /// Smallest corner, metres.
        min: [f64; 3],
        /// Largest corner, metres.
        max: [f64; 3],
    },
    /// A cylinder: axis y, centred.
    Cylinder {
        /// Radius, metres, > 0.
        radius: f64,
        /// Height, metres, > 0.
        height: f64,
        /// Whether it is without caps.
        open: bool,
    },
    /// Triangles given in the file.
    Triangles {
        /// Vertices.
        positions: Vec<[f64; 3]>,
        /// Vertex triples, in range.
        indices: Vec<[u32; 3]>,
        /// One a vertex, or empty.
        normals: Vec<[f64; 3]>,
        /// One a vertex, or empty.
        uvs: Vec<[f64; 2]>,
    },
    /// Triangles from an .obj or .ply file, relative to the scene file.
    Mesh {
        /// The file.
        file: PathBuf,
    },
    /// A surface given by an equation.
    Implicit(ImplicitDescription),
    /// An isosceles prism along y, centred, apex towards +x.
    Prism {
        /// Angle at the apex, degrees in (0, 180).
        apex_degrees: f64,
        /// Length of the two equal sides, metres.
        side: f64,
        /// Length along y, metres.
        length: f64,
    },
    /// A round brilliant: axis y, table up, girdle plane y = 0.
    Brilliant(BrilliantDescription),
    /// A spherical lens: axis z, centred, radii positive when convex.
    Lens {
        /// Radii of curvature of the faces towards −z and +z, metres; infinite (written as null) for a flat face.
        radii: [f64; 2],
        /// Thickness at the centre, metres.
        thickness: f64,
        /// Diameter, metres.
        diameter: f64,
    },
}

/// A length > 0.
pub const LENGTH: Number = Number(Range::LENGTH);

#[rustfmt::skip] // one shape a line
const SHAPES: &[Variant<ShapeDescription>] = &[
    Variant { name: "sphere", what: "a sphere", doc: "A sphere.", read: sphere },
    Variant { name: "quad", what: "a quad", doc: "A parallelogram; its normal is u × v.", read: quad },
    Variant { name: "disk", what: "a disk", doc: "A flat disk.", read: disk },
    Variant { name: "box", what: "a box", doc: "A box with edges along the axes.", read: cuboid },
    Variant { name: "cylinder", what: "a cylinder", doc: "A cylinder: axis y, centred.", read: cylinder },
    Variant { name: "triangles", what: "triangles", doc: "Triangles given in the scene file.", read: triangles::read },
    Variant { name: "mesh", what: "a mesh", doc: "Triangles from a file.", read: mesh },
    Variant { name: "implicit", what: "an implicit shape", doc: "A closed surface given by an equation.", read: implicit::read },
    Variant { name: "prism", what: "a prism", doc: "An isosceles triangular prism along y, centred, apex towards +x.", read: prism },
    Variant { name: "brilliant", what: "a brilliant", doc: "A round brilliant cut: axis y, table up, girdle plane y = 0.", read: brilliant::read },
    Variant { name: "lens", what: "a lens", doc: "A spherical lens: axis z, centred.", read: lens::read },
];

/// A shape.
pub const SHAPE: Defined<Record<ShapeDescription>> = Defined {
    name: "shape",
    codec: || Record { what: "a shape", doc: "A shape in its own coordinates.", read: shape },
};

fn shape(o: &mut Object) -> Result<ShapeDescription> {
    let shape = o.tagged("type", SHAPES)?;
    o.name()?;
    Ok(shape)
}

fn sphere(o: &mut Object) -> Result<ShapeDescription> {
    Ok(ShapeDescription::Sphere {
        center: o.required("center", POINT, "Centre, metres.")?,
        radius: o.required("radius", LENGTH, "Radius, metres.")?,
    })
}

fn quad(o: &mut Object) -> Result<ShapeDescription> {
    let origin = o.required("origin", POINT, "A corner, metres.")?;
    let u = o.required("u", DIRECTION, "First edge, metres.")?;
    let v = o.required("v", DIRECTION, "Second edge, metres; not parallel to the first.")?;
    let parallel = || "`u` and `v` are parallel; expected two directions".into();
    o.refuse_if(are_parallel(u, v), ErrorKind::Degenerate, "", parallel)?;
    Ok(ShapeDescription::Quad { origin, u, v })
}

fn disk(o: &mut Object) -> Result<ShapeDescription> {
    Ok(ShapeDescription::Disk {
        center: o.required("center", POINT, "Centre, metres.")?,
        normal: o.required("normal", DIRECTION, "Normal, of any length but 0.")?,
        radius: o.required("radius", LENGTH, "Radius, metres.")?,
    })
}

fn cuboid(o: &mut Object) -> Result<ShapeDescription> {
    let min = o.required("min", POINT, "Smallest corner, metres.")?;
    let max = o.required("max", POINT, "Largest corner, metres; each component above that of `min`.")?;
    o.check(|value| {
        let Some(axis) = (0..3).find(|&axis| min[axis] >= max[axis]) else { return Ok(()) };
        let message = format!("expected more than the {} of `min`, found {}", show(min[axis]), show(max[axis]));
        Err(error(ErrorKind::Degenerate, &Path::Index(&Path::Key(value.path, "max"), axis), message))
    })?;
    Ok(ShapeDescription::Box { min, max })
}

fn cylinder(o: &mut Object) -> Result<ShapeDescription> {
    Ok(ShapeDescription::Cylinder {
        radius: o.required("radius", LENGTH, "Radius, metres.")?,
        height: o.required("height", LENGTH, "Height, metres.")?,
        open: o.default("open", Bool, "false", "Whether it is without caps.")?,
    })
}

fn mesh(o: &mut Object) -> Result<ShapeDescription> {
    let file = FileName { what: "a mesh", extensions: &["obj", "ply"] };
    Ok(ShapeDescription::Mesh { file: o.required("file", file, "Path of the mesh.")? })
}

fn prism(o: &mut Object) -> Result<ShapeDescription> {
    let angle = Number(Range::between(0.0, 180.0));
    Ok(ShapeDescription::Prism {
        apex_degrees: o.required("apex_degrees", angle, "Angle at the apex, degrees.")?,
        side: o.required("side", LENGTH, "Length of the two equal sides, metres.")?,
        length: o.required("length", LENGTH, "Length along y, metres.")?,
    })
}
