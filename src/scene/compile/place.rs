//! Shapes in the world, in metres: descriptions become meshes and analytic shapes with their transforms, checked.

use super::spectra::in_referenced_file;
use crate::geometry::{
    Aabb, Analytic, AnalyticShape, BrilliantCut, Cuboid, Cylinder, Disk, Implicit, Lens, Mesh, Sphere, TriangleSoup,
    brilliant, implicit, prism,
};
use crate::io;
use crate::math;
use crate::scene::description::{
    BrilliantDescription, ImplicitDescription, MaterialKind, ObjectDescription, SceneDescription, ShapeDescription,
    TransformStep,
};
use crate::{Error, ErrorKind, Result};
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// An object's shape, checked, before normalisation.
pub enum Placed {
    /// Triangles with vertices in world metres.
    Mesh(Mesh),
    /// An analytic shape with its transform.
    Analytic(AnalyticShape, DAffine3, Aabb),
}

impl Placed {
    /// Corners of a box around it, metres.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Self::Mesh(mesh) => mesh
                .positions
                .iter()
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), p| (min.min(*p), max.max(*p))),
            Self::Analytic(_, _, bounds) => (bounds.min.as_dvec3(), bounds.max.as_dvec3()),
        }
    }
}

/// Builds every object's shape in world metres.
pub fn place(description: &SceneDescription, warnings: &mut Vec<String>) -> Result<Vec<Placed>> {
    description
        .objects
        .iter()
        .map(|object| {
            let placed = place_object(object)?;
            lint(description, object, &placed, warnings);
            Ok(placed)
        })
        .collect()
}

/// The triangles of an object in world metres; `None` for a shape that is none of triangles.
///
/// # Errors
/// Whatever is wrong with the shape, a file that it names, or its transform.
pub fn world_mesh(object: &ObjectDescription) -> Result<Option<Mesh>> {
    Ok(match place_object(object)? {
        Placed::Mesh(mesh) => Some(mesh),
        Placed::Analytic(..) => None,
    })
}

fn place_object(object: &ObjectDescription) -> Result<Placed> {
    let at = format!("{}.shape", object.at);
    let transform_at = format!("{}.transform", object.at);
    let transform = transform(&object.transform).map_err(|e| e.at(transform_at.clone()))?;
    let shape = shape(&object.shape, &at).map_err(|e| if e.place.is_empty() { e.at(at.clone()) } else { e })?;
    match shape {
        Shape::Mesh(mesh) => Ok(Placed::Mesh(transformed(mesh, &transform))),
        Shape::Analytic(shape) => {
            // What is wrong with a good shape once it is placed is wrong with the transform, if it has one.
            let placed_at = if object.transform.is_empty() { at } else { transform_at };
            let bounds = Analytic::new(shape.clone(), transform).map_err(|e| e.at(placed_at))?.bounds();
            Ok(Placed::Analytic(shape, transform, bounds))
        }
    }
}

/// A shape in its own coordinates, checked.
enum Shape {
    Mesh(Mesh),
    Analytic(AnalyticShape),
}

fn shape(shape: &ShapeDescription, at: &str) -> Result<Shape> {
    Ok(match shape {
        ShapeDescription::Sphere { center, radius } => {
            Shape::Analytic(AnalyticShape::Sphere(Sphere::new(DVec3::from(*center), *radius)?))
        }
        ShapeDescription::Disk { center, normal, radius } => {
            Shape::Analytic(AnalyticShape::Disk(Disk::new(DVec3::from(*center), DVec3::from(*normal), *radius)?))
        }
        ShapeDescription::Box { min, max } => {
            Shape::Analytic(AnalyticShape::Cuboid(Cuboid::new(DVec3::from(*min), DVec3::from(*max))?))
        }
        ShapeDescription::Cylinder { radius, height, open } => {
            Shape::Analytic(AnalyticShape::Cylinder(Cylinder::new(*radius, *height, *open)?))
        }
        ShapeDescription::Lens { radii, thickness, diameter } => {
            Shape::Analytic(AnalyticShape::Lens(Lens::new(*radii, *thickness, *diameter)?))
        }
        ShapeDescription::Implicit(surface) => Shape::Analytic(AnalyticShape::Implicit(implicit_surface(surface)?)),
        ShapeDescription::Quad { origin, u, v } => Shape::Mesh(quad(*origin, *u, *v)),
        ShapeDescription::Triangles { positions, indices, normals, uvs } => Shape::Mesh(Mesh {
            positions: positions.iter().copied().map(DVec3::from).collect(),
            indices: indices.clone(),
            normals: normals.iter().copied().map(DVec3::from).collect(),
            uvs: uvs.iter().copied().map(DVec2::from).collect(),
        }),
        ShapeDescription::Mesh { file } => {
            Shape::Mesh(io::mesh::read(file).map_err(|e| in_referenced_file(e, file, format!("{at}.file")))?)
        }
        ShapeDescription::Prism { apex_degrees, side, length } => {
            Shape::Mesh(solid(prism(*apex_degrees, *side, *length)?))
        }
        ShapeDescription::Brilliant(cut) => Shape::Mesh(solid(brilliant(&brilliant_cut(cut))?)),
    })
}

/// A parallelogram as two triangles.
fn quad(origin: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Mesh {
    let [o, u, v] = [origin, u, v].map(DVec3::from);
    let positions = vec![o, o + u, o + u + v, o + v];
    let uvs = vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    Mesh { positions, indices: vec![[0, 1, 2], [0, 2, 3]], uvs, ..Mesh::default() }
}

fn brilliant_cut(cut: &BrilliantDescription) -> BrilliantCut {
    let BrilliantDescription { radius, table, crown_degrees, pavilion_degrees, girdle, star, lower_half } = *cut;
    BrilliantCut { radius, table, crown_degrees, pavilion_degrees, girdle, star, lower_half }
}

fn solid(soup: TriangleSoup) -> Mesh {
    Mesh { positions: soup.positions, indices: soup.indices, ..Mesh::default() }
}

fn implicit_surface(surface: &ImplicitDescription) -> Result<Implicit> {
    Ok(match surface {
        ImplicitDescription::Torus { major_radius, minor_radius } => {
            Implicit::Torus(implicit::Torus::new(*major_radius, *minor_radius)?)
        }
        ImplicitDescription::Superquadric { radii, exponent_y, exponent_xz } => {
            Implicit::Superquadric(implicit::Superquadric::new(*radii, *exponent_y, *exponent_xz)?)
        }
        ImplicitDescription::Gyroid { period, thickness, radius } => {
            Implicit::Gyroid(implicit::Gyroid::new(*period, *thickness, *radius)?)
        }
        ImplicitDescription::SmoothUnion { centers, radii, blend } => {
            Implicit::SmoothUnion(implicit::SmoothUnion::new(centers, radii, *blend)?)
        }
        ImplicitDescription::Tanglecube { size, level } => {
            Implicit::Tanglecube(implicit::Tanglecube::new(*size, *level)?)
        }
    })
}

/// The steps of a transform as one map.
fn transform(steps: &[TransformStep]) -> Result<DAffine3> {
    let step = |step: &TransformStep| match step {
        TransformStep::Translate(t) => DAffine3::from_translation(DVec3::from(*t)),
        TransformStep::Scale(s) => DAffine3::from_scale(DVec3::from(*s)),
        TransformStep::Rotate { degrees, axis } => DAffine3::from_mat3(rotation(DVec3::from(*axis), *degrees)),
        TransformStep::Matrix(m) => DAffine3::from_mat3_translation(
            DMat3::from_cols_array(&[m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]]),
            DVec3::new(m[3], m[7], m[11]),
        ),
    };
    let whole = steps.iter().fold(DAffine3::IDENTITY, |before, next| step(next) * before);
    let determinant = whole.matrix3.determinant();
    if whole.is_finite() && determinant.is_finite() && determinant != 0.0 {
        return Ok(whole);
    }
    let message = "the transform is singular or not finite; expected an invertible one";
    Err(Error::new(ErrorKind::Degenerate, message))
}

/// Rotation about an axis through the origin, right-handed \[Rodrigues1840\]. Multiples of 90° are exact.
fn rotation(axis: DVec3, degrees: f64) -> DMat3 {
    let turn = degrees.rem_euclid(360.0);
    let (sin, cos) = match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => (math::sin(turn.to_radians()), math::cos(turn.to_radians())),
    };
    let a = axis.normalize();
    let column = |v: DVec3| v * cos + a.cross(v) * sin + a * (a.dot(v) * (1.0 - cos));
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// A mesh in world metres, with its front where it was outside also after mirroring.
fn transformed(mut mesh: Mesh, transform: &DAffine3) -> Mesh {
    if *transform == DAffine3::IDENTITY {
        return mesh;
    }
    for p in &mut mesh.positions {
        *p = transform.transform_point3(*p);
    }
    let of_normals = transform.matrix3.inverse().transpose();
    for n in &mut mesh.normals {
        *n = of_normals * *n;
    }
    if transform.matrix3.determinant() < 0.0 {
        mesh.indices.iter_mut().for_each(|t| t.swap(1, 2));
    }
    mesh
}

/// Warns about glass that has no inside.
fn lint(description: &SceneDescription, object: &ObjectDescription, placed: &Placed, warnings: &mut Vec<String>) {
    let is_glass =
        object.material.is_some_and(|m| matches!(description.materials[m].1.kind, MaterialKind::Dielectric { .. }));
    let name = object.name.as_ref().map_or(String::new(), |n| format!(" (\"{n}\")"));
    let mut warn = |text: &str| {
        warnings.push(format!("{}: {}{name}: {text}", description.file.display(), object.at));
    };
    match placed {
        Placed::Mesh(mesh) if is_glass && !mesh.is_closed() => {
            warn("a dielectric that is not closed has no inside; light that enters it never leaves");
        }
        Placed::Mesh(mesh) if is_glass && mesh.signed_volume() < 0.0 => {
            warn("the dielectric is inside out: its triangles run clockwise seen from outside");
        }
        Placed::Analytic(shape, ..) if is_glass && !shape.is_closed() => {
            warn("a dielectric that is not closed has no inside; light that enters it never leaves");
        }
        _ => {}
    }
}
