//! Triangles given in the scene file.

use super::super::codec::{Object, Range, Tuples, Value, error};
use super::super::path::Path;
use super::super::vector::{are_parallel, subtract};
use super::ShapeDescription;
use crate::{ErrorKind, Result};

const POINTS: Tuples<3> = Tuples { item: Range::COORDINATE, integer: false };
const UVS: Tuples<2> = Tuples { item: Range::COORDINATE, integer: false };
const INDICES: Tuples<3> = Tuples { item: Range::from_to(0.0, u32::MAX as f64), integer: true };

pub fn read(o: &mut Object) -> Result<ShapeDescription> {
    let positions = o.required("positions", POINTS, "Vertices, flat: x, y, z, x, …; metres.")?;
    let doc = "Vertices of each triangle, flat, counted from 0; counter-clockwise seen from outside.";
    let indices: Vec<[u32; 3]> =
        o.required("indices", INDICES, doc)?.into_iter().map(|triple| triple.map(|index| index as u32)).collect();
    let normals = o.optional("normals", POINTS, "Shading normals, flat, one for each vertex.")?.unwrap_or_default();
    let uvs = o.optional("uvs", UVS, "Texture coordinates, flat, one for each vertex.")?.unwrap_or_default();
    o.check(|value| check_indices(value, &positions, &indices))?;
    o.check(|value| check_normals(value, &normals))?;
    for (key, given) in [("normals", normals.len()), ("uvs", uvs.len())] {
        let count = positions.len();
        o.refuse_if(given != count && given != 0, ErrorKind::WrongType, key, || {
            format!("{given} {key} for {count} vertices; expected as many")
        })?;
    }
    Ok(ShapeDescription::Triangles { positions, indices, normals, uvs })
}

fn check_indices(value: &Value, positions: &[[f64; 3]], indices: &[[u32; 3]]) -> Result<()> {
    let (count, flat) = (positions.len(), indices.as_flattened());
    if let Some(i) = flat.iter().position(|&index| index as usize >= count) {
        let message = format!("expected the index of one of {count} vertices (0 to {}), found {}", count - 1, flat[i]);
        let path = Path::Key(value.path, "indices");
        return Err(error(ErrorKind::OutOfRange, &Path::Index(&path, i), message));
    }
    let corner = |index: u32| positions[index as usize];
    let flat = |t: &[u32; 3]| are_parallel(subtract(corner(t[1]), corner(t[0])), subtract(corner(t[2]), corner(t[0])));
    if indices.iter().all(flat) {
        return Err(value.error(ErrorKind::Degenerate, "no triangle has an area; expected at least one"));
    }
    Ok(())
}

fn check_normals(value: &Value, normals: &[[f64; 3]]) -> Result<()> {
    let Some(i) = normals.iter().position(|normal| *normal == [0.0; 3]) else { return Ok(()) };
    let message = format!("the normal of vertex {i} is the zero vector; expected a direction");
    let path = Path::Key(value.path, "normals");
    Err(error(ErrorKind::Degenerate, &Path::Index(&path, 3 * i), message))
}
