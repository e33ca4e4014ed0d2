//! Meshes from files: the reader is chosen by the extension.

use super::{obj, ply};
use crate::geometry::Mesh;
use crate::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Longest mesh file that is read, in bytes.
pub const MAX_MESH_BYTES: u64 = 2 << 30;

/// Extensions of the files that [`read`] can read.
pub const MESH_EXTENSIONS: [&str; 2] = ["obj", "ply"];

/// Reads a mesh from an OBJ or PLY file. Polygons are cut into fans; vertices that are equal in every respect are merged,
/// so that a closed surface is closed by shared positions; materials and groups are ignored.
///
/// # Errors
/// The file cannot be opened or is not a regular file, is longer than [`MAX_MESH_BYTES`], has another extension than
/// [`MESH_EXTENSIONS`], or its content is not what the format demands: the error names the line where there is one.
/// Coordinates that are not finite, indices out of range and meshes without triangles are errors as well.
pub fn read(path: &Path) -> Result<Mesh> {
    read_inner(path).map_err(|error| error.in_file(path))
}

fn read_inner(path: &Path) -> Result<Mesh> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let parse = match extension.as_str() {
        "obj" => obj::parse,
        "ply" => ply::parse,
        "gltf" | "glb" => {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "glTF meshes are not read yet: expected an .obj or .ply file",
            ));
        }
        other => {
            let message = format!("unknown mesh extension \"{other}\": expected one of .obj, .ply");
            return Err(Error::new(ErrorKind::Unsupported, message).nearest(other, MESH_EXTENSIONS));
        }
    };
    let mut mesh = parse(&read_bytes(path)?)?;
    check(&mesh)?;
    mesh.weld();
    Ok(mesh)
}

fn read_bytes(path: &Path) -> Result<Vec<u8>> {
    let not_found = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => Error::new(ErrorKind::FileNotFound, "no such file"),
        _ => Error::new(ErrorKind::FileNotFound, format!("cannot be opened: {error}")),
    };
    let metadata = std::fs::metadata(path).map_err(not_found)?;
    if !metadata.is_file() {
        return Err(Error::new(ErrorKind::FileNotFound, "not a regular file"));
    }
    let too_long = || {
        let message = format!("longer than {MAX_MESH_BYTES} bytes, the limit for a mesh file");
        Error::new(ErrorKind::LimitExceeded, message)
    };
    if metadata.len() > MAX_MESH_BYTES {
        return Err(too_long());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(not_found)?;
    let failed = |error| Error::new(ErrorKind::Io, format!("reading failed: {error}"));
    file.take(MAX_MESH_BYTES.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > MAX_MESH_BYTES {
        return Err(too_long());
    }
    Ok(bytes)
}

/// Checks what must hold for meshes of any format. Readers of text have checked it already, to name the line.
fn check(mesh: &Mesh) -> Result<()> {
    if mesh.indices.is_empty() {
        return Err(Error::new(ErrorKind::Degenerate, "no triangles: expected a mesh with at least one face"));
    }
    let finite = mesh.positions.iter().chain(&mesh.normals).all(|v| v.is_finite());
    if !finite || !mesh.uvs.iter().all(|uv| uv.is_finite()) {
        return Err(Error::new(ErrorKind::NotFinite, "a vertex is not finite: expected finite numbers"));
    }
    let count = mesh.positions.len();
    match mesh.indices.iter().flatten().find(|&&index| index as usize >= count) {
        Some(index) => {
            let message = format!("a face uses vertex {index}: expected less than {count}, the number of vertices");
            Err(Error::new(ErrorKind::OutOfRange, message))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(path: &str) -> ErrorKind {
        read(Path::new(path)).expect_err("a bad path").kind
    }

    #[test]
    fn reads_a_real_mesh() {
        let mesh = read(Path::new("tests/assets/spot.obj")).expect("spot");
        assert_eq!((mesh.positions.len(), mesh.indices.len(), mesh.uvs.len()), (3225, 5856, 3225));
        assert!(mesh.is_closed());
        // Oracle: the same sum over the file's faces in a few lines of Python.
        let volume = mesh.signed_volume();
        assert!((volume - 0.718_258_788_099_865_3).abs() < 1e-12, "volume {volume}");
        let mut open = mesh.clone();
        open.indices.pop();
        assert!(!open.is_closed());
    }

    #[test]
    fn bad_paths_are_told_apart() {
        assert_eq!(kind("tests/assets/absent.obj"), ErrorKind::FileNotFound);
        assert_eq!(kind("tests/assets"), ErrorKind::Unsupported);
        assert_eq!(kind("x.glb"), ErrorKind::Unsupported);
        assert_eq!(kind("src/geometry.obj"), ErrorKind::FileNotFound);
        let error = read(Path::new("x.opj")).expect_err("an unknown extension");
        assert_eq!(error.nearest.as_deref(), Some("obj"));
        assert!(error.to_string().contains(".obj, .ply"), "{error}");
    }
}
