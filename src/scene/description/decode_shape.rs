//! Shapes and transforms, with the checks that their geometry has extent.

use super::fields::{Fields, items};
use super::json::{Json, show};
use super::path::Path;
use super::tables::*;
use super::types::*;
use super::validate::error;
use crate::{Error, ErrorKind, Result};

/// Below this sine of the angle between them, two directions count as parallel: a few roundings of f64.
const PARALLEL: f64 = 64.0 * f64::EPSILON;

/// A shape in its own coordinates; `folder` is that of the scene file.
pub fn decode_shape(folder: &std::path::Path, json: &Json, path: &Path) -> Result<ShapeDescription> {
    let (name, fields) = Fields::tagged(&SHAPE, json, path)?;
    Ok(match name {
        "sphere" => ShapeDescription::Sphere { center: fields.array("center"), radius: fields.number("radius") },
        "quad" => quad(&fields)?,
        "disk" => ShapeDescription::Disk {
            center: fields.array("center"),
            normal: direction(&fields, "normal")?,
            radius: fields.number("radius"),
        },
        "box" => cuboid(&fields)?,
        "cylinder" => ShapeDescription::Cylinder {
            radius: fields.number("radius"),
            height: fields.number("height"),
            open: fields.flag("open"),
        },
        "triangles" => triangles(&fields)?,
        "mesh" => ShapeDescription::Mesh { file: folder.join(fields.text("file")) },
        "prism" => ShapeDescription::Prism {
            apex_degrees: fields.number("apex_degrees"),
            side: fields.number("side"),
            length: fields.number("length"),
        },
        "brilliant" => ShapeDescription::Brilliant(BrilliantDescription {
            radius: fields.number("radius"),
            table: fields.number("table"),
            crown_degrees: fields.number("crown_degrees"),
            pavilion_degrees: fields.number("pavilion_degrees"),
            girdle: fields.number("girdle"),
            star: fields.number("star"),
            lower_half: fields.number("lower_half"),
        }),
        "lens" => lens(&fields)?,
        surface => ShapeDescription::Implicit(implicit(surface, &fields)?),
    })
}

/// A vector that is not 0.
pub fn direction(fields: &Fields, key: &str) -> Result<[f64; 3]> {
    let vector = fields.array(key);
    if vector == [0.0; 3] {
        let message = format!("`{key}` is the zero vector; expected a direction");
        return Err(error(ErrorKind::Degenerate, &Path::Key(fields.path(), key), message));
    }
    Ok(vector)
}

/// Whether two vectors span no plane: one is 0, or they are parallel to within rounding.
pub fn are_parallel(u: [f64; 3], v: [f64; 3]) -> bool {
    let (Some(u), Some(v)) = (unit(u), unit(v)) else { return true };
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    norm(cross) <= PARALLEL
}

fn norm(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// The direction of a vector of any size; `None` for 0.
fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    if largest == 0.0 {
        return None;
    }
    let v = v.map(|x| x / largest);
    let length = norm(v);
    Some(v.map(|x| x / length))
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn quad(fields: &Fields) -> Result<ShapeDescription> {
    let (u, v) = (direction(fields, "u")?, direction(fields, "v")?);
    if are_parallel(u, v) {
        return Err(error(ErrorKind::Degenerate, fields.path(), "`u` and `v` are parallel; expected two directions"));
    }
    Ok(ShapeDescription::Quad { origin: fields.array("origin"), u, v })
}

fn cuboid(fields: &Fields) -> Result<ShapeDescription> {
    let (min, max): ([f64; 3], [f64; 3]) = (fields.array("min"), fields.array("max"));
    if let Some(axis) = (0..3).find(|&axis| min[axis] >= max[axis]) {
        let message = format!("expected more than the {} of `min`, found {}", show(min[axis]), show(max[axis]));
        return Err(error(ErrorKind::Degenerate, &Path::Index(&fields.at("max"), axis), message));
    }
    Ok(ShapeDescription::Box { min, max })
}

fn triangles(fields: &Fields) -> Result<ShapeDescription> {
    let positions: Vec<[f64; 3]> = fields.tuples("positions");
    let count = positions.len();
    let flat: Vec<[f64; 3]> = fields.tuples("indices");
    let indices: Vec<[u32; 3]> = flat.iter().map(|triple| triple.map(|index| index as u32)).collect();
    if let Some(i) = indices.as_flattened().iter().position(|&index| index as usize >= count) {
        let message = format!(
            "expected the index of one of {count} vertices (0 to {}), found {}",
            count - 1,
            indices.as_flattened()[i]
        );
        return Err(error(ErrorKind::OutOfRange, &Path::Index(&fields.at("indices"), i), message));
    }
    let corner = |index: u32| positions[index as usize];
    let flat = |t: &[u32; 3]| are_parallel(subtract(corner(t[1]), corner(t[0])), subtract(corner(t[2]), corner(t[0])));
    if indices.iter().all(flat) {
        return Err(error(ErrorKind::Degenerate, fields.path(), "no triangle has an area; expected at least one"));
    }
    let normals: Vec<[f64; 3]> = fields.tuples("normals");
    if let Some(i) = normals.iter().position(|normal| *normal == [0.0; 3]) {
        let message = format!("the normal of vertex {i} is the zero vector; expected a direction");
        return Err(error(ErrorKind::Degenerate, &Path::Index(&fields.at("normals"), 3 * i), message));
    }
    let uvs: Vec<[f64; 2]> = fields.tuples("uvs");
    for (key, given) in [("normals", normals.len()), ("uvs", uvs.len())] {
        if given != count && given != 0 {
            let message = format!("{given} {key} for {count} vertices; expected as many");
            return Err(error(ErrorKind::WrongType, &fields.at(key), message));
        }
    }
    Ok(ShapeDescription::Triangles { positions, indices, normals, uvs })
}

fn lens(fields: &Fields) -> Result<ShapeDescription> {
    let radii: [f64; 2] = fields.array("radii");
    let (thickness, diameter) = (fields.number("thickness"), fields.number("diameter"));
    let half = 0.5 * diameter;
    let path = fields.at("radii");
    for (i, radius) in radii.into_iter().enumerate() {
        if radius.abs() < half {
            let message = format!(
                "a face of radius {} cannot span the diameter {}; expected at least {}, or null for a flat face",
                show(radius),
                show(diameter),
                show(half)
            );
            return Err(error(ErrorKind::OutOfRange, &Path::Index(&path, i), message));
        }
    }
    // sag = |R| − √(R² − h²), without cancellation h² / (|R| + √(R² − h²))
    let sag = |radius: f64| {
        let size = radius.abs();
        if size.is_infinite() {
            0.0
        } else {
            (half / (size + ((size - half) * (size + half)).sqrt()) * half).copysign(radius)
        }
    };
    let edge = thickness - sag(radii[0]) - sag(radii[1]);
    if edge < -8.0 * f64::EPSILON * thickness.max(half) {
        let message = format!(
            "the faces meet before the rim: at this diameter and these radii the thickness must be at least {}, found {}",
            show(thickness - edge),
            show(thickness)
        );
        return Err(error(ErrorKind::Degenerate, &fields.at("thickness"), message));
    }
    Ok(ShapeDescription::Lens { radii, thickness, diameter })
}

fn implicit(surface: &str, fields: &Fields) -> Result<ImplicitDescription> {
    Ok(match surface {
        "torus" => {
            let (major_radius, minor_radius) = (fields.number("major_radius"), fields.number("minor_radius"));
            less(fields, "minor_radius", minor_radius, "`major_radius`", major_radius)?;
            ImplicitDescription::Torus { major_radius, minor_radius }
        }
        "superquadric" => ImplicitDescription::Superquadric {
            radii: fields.array("radii"),
            exponent_y: fields.number("exponent_y"),
            exponent_xz: fields.number("exponent_xz"),
        },
        "gyroid" => {
            let (period, thickness) = (fields.number("period"), fields.number("thickness"));
            less(fields, "thickness", thickness, "half of `period`", 0.5 * period)?;
            ImplicitDescription::Gyroid { period, thickness, radius: fields.number("radius") }
        }
        "smooth-union" => smooth_union(fields)?,
        "tanglecube" => ImplicitDescription::Tanglecube { size: fields.number("size"), level: fields.number("level") },
        other => unreachable!("the table has no surface {other}"),
    })
}

fn less(fields: &Fields, key: &str, value: f64, than: &str, limit: f64) -> Result<()> {
    if value < limit {
        return Ok(());
    }
    let message = format!("expected less than {than}, {}, found {}", show(limit), show(value));
    Err(error(ErrorKind::OutOfRange, &Path::Key(fields.path(), key), message))
}

fn smooth_union(fields: &Fields) -> Result<ImplicitDescription> {
    let centers: Vec<[f64; 3]> = items(&fields.value("centers"))
        .iter()
        .map(|center| match center {
            Json::Numbers(xyz) => [xyz[0], xyz[1], xyz[2]],
            other => unreachable!("checked to be a vector, but is {}", other.found()),
        })
        .collect();
    let radii = fields.numbers("radii");
    if centers.len() != radii.len() {
        let message = format!("{} radii for {} centres; expected as many", radii.len(), centers.len());
        return Err(error(ErrorKind::WrongType, &fields.at("radii"), message));
    }
    Ok(ImplicitDescription::SmoothUnion { centers, radii, blend: fields.number("blend") })
}

/// The steps of a transform.
pub fn decode_transform(json: &Json, path: &Path) -> Result<Vec<TransformStep>> {
    items(json).iter().enumerate().map(|(i, step)| decode_step(step, &Path::Index(path, i))).collect()
}

fn decode_step(json: &Json, path: &Path) -> Result<TransformStep> {
    let (form, fields) = Fields::form(&TRANSFORM_STEP, json, path)?;
    Ok(match form {
        "translate" => TransformStep::Translate(fields.array("translate")),
        "rotate_degrees" => {
            TransformStep::Rotate { degrees: fields.number("rotate_degrees"), axis: direction(&fields, "axis")? }
        }
        "scale" => {
            let factors = match fields.given("scale").and_then(Json::as_number) {
                Some(factor) => [factor; 3],
                None => fields.array("scale"),
            };
            if factors.contains(&0.0) {
                return Err(singular(&fields.at("scale"), "a factor of 0"));
            }
            TransformStep::Scale(factors)
        }
        "matrix" => matrix(&fields)?,
        other => unreachable!("the table has no transform step {other}"),
    })
}

fn singular(path: &Path, why: &str) -> Error {
    error(ErrorKind::Degenerate, path, format!("{why}; expected a transform that can be undone"))
}

fn matrix(fields: &Fields) -> Result<TransformStep> {
    let m: [f64; 16] = fields.array("matrix");
    let path = fields.at("matrix");
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let row = m[12..].iter().map(|x| show(*x)).collect::<Vec<_>>().join(" ");
        let message = format!("the last row must be 0 0 0 1 (row-major, the shift in the last column), found {row}");
        return Err(error(ErrorKind::OutOfRange, &path, message));
    }
    // the volume spanned by the columns' directions: 0 when they lie in a plane, whatever their lengths
    let column = |i: usize| unit([m[i], m[4 + i], m[8 + i]]);
    let (Some(a), Some(b), Some(c)) = (column(0), column(1), column(2)) else {
        return Err(singular(&path, "the matrix is singular, a column is 0"));
    };
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let volume = cross[0] * c[0] + cross[1] * c[1] + cross[2] * c[2];
    if volume.abs() <= PARALLEL {
        return Err(singular(&path, "the matrix is singular, its columns lie in a plane"));
    }
    Ok(TransformStep::Matrix(m))
}
