//! Wavefront OBJ \[Wavefront1995\]: `v`, `vt`, `vn` and `f`; every other statement (groups, materials, lines, curves) is
//! passed over.

use crate::geometry::Mesh;
use crate::{Error, ErrorKind, Result};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// A face's corner: index of its position, texture coordinate and normal.
type Corner = (u32, Option<u32>, Option<u32>);

/// What the statements of a file have said so far.
#[derive(Default)]
struct Statements {
    positions: Vec<DVec3>,
    uvs: Vec<DVec2>,
    normals: Vec<DVec3>,
    triangles: Vec<[Corner; 3]>,
}

/// Parses a file's bytes. Texture coordinates and normals are kept only if every corner of every face has them.
///
/// # Errors
/// With the line: a number or index that cannot be read, is not finite or out of range; a face of fewer than 3 corners.
pub(super) fn parse(bytes: &[u8]) -> Result<Mesh> {
    let mut statements = Statements::default();
    let mut joined = Vec::new();
    for (number, line) in (1u64..).zip(bytes.split(|&byte| byte == b'\n')) {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if let Some(begun) = line.strip_suffix(b"\\") {
            joined.extend_from_slice(begun);
            joined.push(b' ');
            continue;
        }
        let result = if joined.is_empty() {
            statements.read(line)
        } else {
            joined.extend_from_slice(line);
            let result = statements.read(&joined);
            joined.clear();
            result
        };
        result.map_err(|error| error.at(format!("line {number}")))?;
    }
    statements.into_mesh()
}

impl Statements {
    fn read(&mut self, line: &[u8]) -> Result<()> {
        let code = line.split(|&byte| byte == b'#').next().unwrap_or_default();
        let mut words = code.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => {
                let [x, y, z] = numbers(words, 3)?;
                self.positions.push(DVec3::new(x, y, z));
            }
            Some(b"vn") => {
                let [x, y, z] = numbers(words, 3)?;
                self.normals.push(DVec3::new(x, y, z));
            }
            Some(b"vt") => {
                let [u, v, _] = numbers(words, 1)?;
                self.uvs.push(DVec2::new(u, v));
            }
            Some(b"f") => self.face(words)?,
            _ => {}
        }
        Ok(())
    }

    /// Cuts a face into a fan around its first corner.
    fn face<'a>(&mut self, mut words: impl Iterator<Item = &'a [u8]>) -> Result<()> {
        let mut corner = || words.next().map(|word| self.corner(word)).transpose();
        let (Some(first), Some(mut previous), Some(mut last)) = (corner()?, corner()?, corner()?) else {
            return Err(Error::new(ErrorKind::FileFormat, "a face of fewer than 3 vertices: expected 3 or more"));
        };
        let mut fan = Vec::with_capacity(2);
        loop {
            fan.push([first, previous, last]);
            previous = last;
            match corner()? {
                Some(next) => last = next,
                None => break,
            }
        }
        self.triangles.append(&mut fan);
        Ok(())
    }

    /// Parses a corner: `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &[u8]) -> Result<Corner> {
        let mut parts = word.split(|&byte| byte == b'/');
        let position = index(parts.next().unwrap_or_default(), self.positions.len(), "v")?;
        let mut optional = |count: usize, name: &str| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(part) => index(part, count, name).map(Some),
        };
        let uv = optional(self.uvs.len(), "vt")?;
        let normal = optional(self.normals.len(), "vn")?;
        match parts.next() {
            Some(_) => Err(unreadable(word, "a corner of the form v/vt/vn")),
            None => Ok((position, uv, normal)),
        }
    }

    fn into_mesh(self) -> Result<Mesh> {
        let corners = || self.triangles.iter().flatten();
        let has_uvs = corners().all(|corner| corner.1.is_some());
        let has_normals = corners().all(|corner| corner.2.is_some());
        let mut mesh = Mesh { indices: Vec::with_capacity(self.triangles.len()), ..Mesh::default() };
        let mut numbers: HashMap<Corner, u32> = HashMap::new();
        for triangle in &self.triangles {
            let vertices = triangle.map(|(position, uv, normal)| {
                let corner = (position, uv.filter(|_| has_uvs), normal.filter(|_| has_normals));
                *numbers.entry(corner).or_insert_with(|| {
                    let number = mesh.positions.len();
                    mesh.positions.push(self.positions[position as usize]);
                    mesh.uvs.extend(corner.1.map(|uv| self.uvs[uv as usize]));
                    mesh.normals.extend(corner.2.map(|normal| self.normals[normal as usize]));
                    number as u32
                })
            });
            mesh.indices.push(vertices);
        }
        Ok(mesh)
    }
}

/// Parses up to three finite numbers, at least `required` of them. Those that are not there are 0.
fn numbers<'a>(mut words: impl Iterator<Item = &'a [u8]>, required: usize) -> Result<[f64; 3]> {
    let mut values = [0.0; 3];
    for (position, value) in values.iter_mut().enumerate() {
        let Some(word) = words.next() else {
            if position >= required {
                break;
            }
            let message = format!("{position} numbers: expected at least {required}");
            return Err(Error::new(ErrorKind::FileFormat, message));
        };
        let number = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f64>().ok());
        *value = number.ok_or_else(|| unreadable(word, "a number"))?;
        if !value.is_finite() {
            let message = format!("{}: expected a finite number", excerpt(word));
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
    }
    Ok(values)
}

/// Parses an index, which counts from 1, or backwards from −1, among the `count` statements so far.
fn index(word: &[u8], count: usize, name: &str) -> Result<u32> {
    let number = std::str::from_utf8(word).ok().and_then(|text| text.parse::<i64>().ok());
    let number = number.ok_or_else(|| unreadable(word, "an index"))?;
    let from_zero = if number < 0 {
        i64::try_from(count).ok().and_then(|count| count.checked_add(number))
    } else {
        number.checked_sub(1)
    };
    let valid = from_zero.and_then(|index| u32::try_from(index).ok()).filter(|&index| (index as usize) < count);
    valid.ok_or_else(|| {
        let message = format!("index {number}: expected 1 to {count} or −{count} to −1, the {name} lines so far");
        Error::new(ErrorKind::OutOfRange, message)
    })
}

fn unreadable(word: &[u8], expected: &str) -> Error {
    Error::new(ErrorKind::FileFormat, format!("\"{}\": expected {expected}", excerpt(word)))
}

/// Returns the beginning of a word in printable characters, for messages.
fn excerpt(word: &[u8]) -> String {
    word.iter().take(40).copied().flat_map(std::ascii::escape_default).map(char::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn error(text: &str) -> Error {
        parse(text.as_bytes()).expect_err("bad text")
    }

    #[test]
    fn polygons_are_cut_into_fans() {
        let text = "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\r\nv 1 1 0 1.0\nv 0 1 0\nv -1 .5 0 # five\nusemtl x\n\
                    f 1 2 3 4 5\nf -5 -4 \\\n-3\nf 1 2 3 4";
        let mesh = parse(text.as_bytes()).expect("a mesh");
        assert_eq!(mesh.indices, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 2], [0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.positions[4], DVec3::new(-1.0, 0.5, 0.0));
        assert!(mesh.uvs.is_empty() && mesh.normals.is_empty());
    }

    #[test]
    fn seams_double_vertices_and_partial_attributes_are_dropped() {
        let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt .5\nvn 0 0 1\n";
        let full = parse(format!("{head}f 1/1/1 2/2/1 3/3/1\nf 3/1/1 2/2/1 4/3/1\n").as_bytes()).expect("full");
        assert_eq!((full.positions.len(), full.uvs.len(), full.normals.len()), (5, 5, 5));
        assert_eq!(full.uvs[3], DVec2::ZERO);
        let partial = parse(format!("{head}f 1/1/1 2/2/1 3/3/1\nf 3//1 2//1 4//1\n").as_bytes()).expect("partial");
        assert_eq!((partial.positions.len(), partial.uvs.len(), partial.normals.len()), (4, 0, 4));
    }

    #[test]
    fn errors_name_the_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        let cases = [
            ("v 0 0", ErrorKind::FileFormat),
            ("v 0 0 zero", ErrorKind::FileFormat),
            ("v 0 0 nan", ErrorKind::NotFinite),
            ("v 0 0 1e999", ErrorKind::NotFinite),
            ("f 1 2", ErrorKind::FileFormat),
            ("f 1 2 4", ErrorKind::OutOfRange),
            ("f 1 2 0", ErrorKind::OutOfRange),
            ("f 1 2 -4", ErrorKind::OutOfRange),
            ("f 1 2 -9223372036854775808", ErrorKind::OutOfRange),
            ("f 1/1 2/1 3/1", ErrorKind::OutOfRange),
            ("f 1/9223372036854775807 2 3", ErrorKind::OutOfRange),
            ("f 1 2 3/1/1/1", ErrorKind::OutOfRange),
            ("f 1 2 3///", ErrorKind::FileFormat),
            ("f 1 2 \u{fe}", ErrorKind::FileFormat),
        ];
        for (line, kind) in cases {
            let error = error(&format!("{vertices}{line}\n"));
            assert_eq!((error.kind, error.place.as_str()), (kind, "line 4"), "{line}: {error}");
        }
    }

    proptest! {
        #[test]
        fn arbitrary_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            let _ = parse(&bytes);
        }

        #[test]
        fn arbitrary_statements_do_not_panic(text in "((v|vt|vn|f)( [-0-9/.e]{1,4}){0,5}\n){0,30}") {
            if let Ok(mesh) = parse(text.as_bytes()) {
                let count = mesh.positions.len();
                prop_assert!(mesh.indices.iter().flatten().all(|&index| (index as usize) < count));
            }
        }
    }
}
