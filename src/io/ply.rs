//! PLY \[Turk1994\], ASCII and both binary encodings, over the crate `ply-rs-bw`. What its headers announce is held against
//! the file's length before anything is read, so that time and memory stay in proportion to the file.

use crate::geometry::Mesh;
use crate::{Error, ErrorKind, Result};
use glam::{DVec2, DVec3};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

/// Names of the properties that are texture coordinates.
const UV_NAMES: [[&str; 2]; 4] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];
const INDEX_NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// One vertex: position, normal, texture coordinates.
#[derive(Default)]
struct Vertex {
    values: [f64; 8],
}

/// One polygon. Indices that are negative or no integers become `u32::MAX`, which is out of range.
#[derive(Default)]
struct Face {
    corners: Vec<u32>,
}

/// An element of another name, read only to get past it.
struct Other;

impl Vertex {
    /// Finds the place of a property in `values`.
    fn slot(name: &str) -> Option<usize> {
        let named = ["x", "y", "z", "nx", "ny", "nz"].iter().position(|&known| known == name);
        let uv = |side: usize| UV_NAMES.iter().any(|pair| pair[side] == name).then_some(6 + side);
        named.or_else(|| uv(0)).or_else(|| uv(1))
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if let (Some(slot), Some(value)) = (Self::slot(name), number(&property)) {
            self.values[slot] = value;
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if INDEX_NAMES.contains(&name) {
            self.corners = indices(property);
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}

/// Returns the value of a scalar of any type.
fn number(property: &Property) -> Option<f64> {
    Some(match *property {
        Property::Char(value) => f64::from(value),
        Property::UChar(value) => f64::from(value),
        Property::Short(value) => f64::from(value),
        Property::UShort(value) => f64::from(value),
        Property::Int(value) => f64::from(value),
        Property::UInt(value) => f64::from(value),
        Property::Float(value) => f64::from(value),
        Property::Double(value) => value,
        _ => return None,
    })
}

/// Returns the integers of a list of any type.
fn indices(property: Property) -> Vec<u32> {
    fn convert<T: TryInto<u32>>(list: Vec<T>) -> Vec<u32> {
        list.into_iter().map(|index| index.try_into().unwrap_or(u32::MAX)).collect()
    }
    match property {
        Property::ListChar(list) => convert(list),
        Property::ListUChar(list) => convert(list),
        Property::ListShort(list) => convert(list),
        Property::ListUShort(list) => convert(list),
        Property::ListInt(list) => convert(list),
        Property::ListUInt(list) => list,
        _ => Vec::new(),
    }
}

/// Parses a file's bytes. Polygons are cut into fans around their first corner; the vertices keep their numbers.
///
/// # Errors
/// A header that is not PLY's, lacks what a mesh needs or announces more than the file holds; elements that cannot be
/// read, with the line in ASCII files; faces of fewer than 3 corners or with an index out of range.
pub(super) fn parse(bytes: &[u8]) -> Result<Mesh> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader).map_err(|error| translate(error, true))?;
    let text = header.encoding == Encoding::Ascii;
    check_size(&header, bytes.len())?;
    let layout = Layout::of(&header)?;
    let mut mesh = Mesh::default();
    for (name, element) in &header.elements {
        let result = match name.as_str() {
            "vertex" => Parser::new()
                .read_payload_for_element(&mut reader, element, &header)
                .map(|vertices| layout.take_vertices(vertices, &mut mesh)),
            "face" => match Parser::<Face>::new().read_payload_for_element(&mut reader, element, &header) {
                Ok(faces) => {
                    add_faces(&faces, layout.vertex_count, &mut mesh)?;
                    Ok(())
                }
                Err(error) => Err(error),
            },
            _ => Parser::<Other>::new().read_payload_for_element(&mut reader, element, &header).map(|_| ()),
        };
        result.map_err(|error| translate(error, text))?;
    }
    Ok(mesh)
}

/// What the header announces of vertices: their number and which properties they have.
struct Layout {
    vertex_count: usize,
    has_normals: bool,
    has_uvs: bool,
}

impl Layout {
    fn of(header: &Header) -> Result<Self> {
        let element = |name: &str| {
            let missing = || {
                let message = format!("no element \"{name}\": expected a mesh with elements vertex and face");
                Error::new(ErrorKind::FileFormat, message)
            };
            header.elements.get(name).ok_or_else(missing)
        };
        let (vertex, face) = (element("vertex")?, element("face")?);
        let scalars = |names: &[&str]| {
            names.iter().all(|&name| {
                vertex.properties.get(name).is_some_and(|p| matches!(p.data_type, PropertyType::Scalar(_)))
            })
        };
        if !scalars(&["x", "y", "z"]) {
            return Err(Error::new(
                ErrorKind::FileFormat,
                "vertices without scalar properties x, y, z: expected all three",
            ));
        }
        if !INDEX_NAMES.iter().any(|&name| face.properties.get(name).is_some_and(is_index_list)) {
            let message = "faces without a list of integers vertex_indices or vertex_index: expected one";
            return Err(Error::new(ErrorKind::FileFormat, message));
        }
        Ok(Self {
            vertex_count: vertex.count,
            has_normals: scalars(&["nx", "ny", "nz"]),
            has_uvs: UV_NAMES.iter().any(|pair| scalars(pair)),
        })
    }

    fn take_vertices(&self, vertices: Vec<Vertex>, mesh: &mut Mesh) {
        for Vertex { values: [x, y, z, nx, ny, nz, u, v] } in vertices {
            mesh.positions.push(DVec3::new(x, y, z));
            if self.has_normals {
                mesh.normals.push(DVec3::new(nx, ny, nz));
            }
            if self.has_uvs {
                mesh.uvs.push(DVec2::new(u, v));
            }
        }
    }
}

fn is_index_list(property: &ply_rs_bw::ply::PropertyDef) -> bool {
    matches!(&property.data_type, PropertyType::List(_, item) if !matches!(item, ScalarType::Float | ScalarType::Double))
}

fn add_faces(faces: &[Face], vertex_count: usize, mesh: &mut Mesh) -> Result<()> {
    for (number, Face { corners }) in faces.iter().enumerate() {
        let place = || format!("face {number}");
        let [first, rest @ ..] = corners.as_slice() else {
            return Err(too_few_corners(0).at(place()));
        };
        if rest.len() < 2 {
            return Err(too_few_corners(corners.len()).at(place()));
        }
        if let Some(index) = corners.iter().find(|&&index| index as usize >= vertex_count) {
            let found = if *index == u32::MAX { "a negative index".to_owned() } else { format!("vertex {index}") };
            let message = format!("{found}: expected less than {vertex_count}, the number of vertices");
            return Err(Error::new(ErrorKind::OutOfRange, message).at(place()));
        }
        mesh.indices.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
    Ok(())
}

fn too_few_corners(count: usize) -> Error {
    Error::new(ErrorKind::FileFormat, format!("a face of {count} vertices: expected 3 or more"))
}

/// Refuses headers that announce more than `length` bytes can hold.
fn check_size(header: &Header, length: usize) -> Result<()> {
    let mut total = 0usize;
    for (name, element) in &header.elements {
        let least = least_size(element, header.encoding).max(1);
        let sum = element.count.checked_mul(least).and_then(|size| total.checked_add(size));
        total = sum.filter(|&sum| sum <= length).ok_or_else(|| {
            let message = format!(
                "the header announces {} elements \"{name}\" of {least} bytes or more: expected no more than the file's \
                 {length} bytes hold",
                element.count
            );
            Error::new(ErrorKind::FileFormat, message)
        })?;
    }
    Ok(())
}

/// Computes the fewest bytes that one element can take.
fn least_size(element: &ElementDef, encoding: Encoding) -> usize {
    let size = |scalar: &ScalarType| match scalar {
        _ if encoding == Encoding::Ascii => 2,
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    let sizes = element.properties.iter().map(|(_, property)| match &property.data_type {
        PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => size(scalar),
    });
    sizes.fold(0, usize::saturating_add)
}

/// Turns the crate's error into one line of bounded length, without a line number for binary data.
fn translate(error: ParseError, text: bool) -> Error {
    let message: String = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    let message: String = message.chars().flat_map(char::escape_default).take(300).collect();
    let error_in_file = Error::new(ErrorKind::FileFormat, format!("not readable as PLY: {message}"));
    match error.line() {
        Some(line) if text => error_in_file.at(format!("line {line}")),
        _ => error_in_file,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const HEADER: &str = "element vertex 4\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n\
                          element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";

    fn ascii() -> String {
        format!(
            "ply\nformat ascii 1.0\ncomment made by hand\n{HEADER}0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0.5 4\n\
                 0 4 0 1 2 3\n1 3 2 1 0\n"
        )
    }

    fn binary(big: bool) -> Vec<u8> {
        let name = if big { "binary_big_endian" } else { "binary_little_endian" };
        let mut bytes = format!("ply\nformat {name} 1.0\n{HEADER}").into_bytes();
        let f32_bytes = |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        let f64_bytes = |x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        let i32_bytes = |x: i32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        for (x, y, z, red) in [(0.0, 0.0, 0.0, 1), (1.0, 0.0, 0.0, 2), (1.0, 1.0, 0.0, 3), (0.0, 1.0, 0.5, 4)] {
            bytes.extend(f32_bytes(x));
            bytes.extend(f64_bytes(y));
            bytes.extend(f32_bytes(z));
            bytes.push(red);
        }
        for (flags, corners) in [(0, &[0, 1, 2, 3][..]), (1, &[2, 1, 0][..])] {
            bytes.extend([flags, corners.len() as u8]);
            bytes.extend(corners.iter().flat_map(|&corner| i32_bytes(corner)));
        }
        bytes
    }

    fn error(text: &str) -> Error {
        parse(text.as_bytes()).expect_err("bad text")
    }

    #[test]
    fn the_three_encodings_agree() {
        let mesh = parse(ascii().as_bytes()).expect("ascii");
        assert_eq!(mesh.indices, [[0, 1, 2], [0, 2, 3], [2, 1, 0]]);
        assert_eq!(mesh.positions[3], DVec3::new(0.0, 1.0, 0.5));
        assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
        assert_eq!(parse(&binary(false)).expect("little"), mesh);
        assert_eq!(parse(&binary(true)).expect("big"), mesh);
    }

    #[test]
    fn normals_and_texture_coordinates_are_read() {
        let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                    property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n\
                    element face 1\nproperty list uint8 uint32 vertex_index\nelement edge 1\nproperty int a\nend_header\n\
                    0 0 0 0 0 1 .25 0.5\n";
        assert_eq!(error(text).kind, ErrorKind::FileFormat);
        let text = text.replace(" .25", " 0.25") + "1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1e-1\n3 0 1 2\n7\n";
        let mesh = parse(text.as_bytes()).expect("a mesh");
        assert_eq!(mesh.normals, [DVec3::Z; 3]);
        assert_eq!(mesh.uvs[0], DVec2::new(0.25, 0.5));
    }

    #[test]
    fn bad_files_are_told_apart() {
        let good = ascii();
        let cases = [
            (good.replace("vertex 4", "vertex 4000000000000"), ErrorKind::FileFormat, "announces"),
            (good.replace("face 2", "face 99999"), ErrorKind::FileFormat, "announces"),
            (good.replace("3 2 1 0", "3 2 1 4"), ErrorKind::OutOfRange, "vertex 4"),
            (good.replace("3 2 1 0", "3 2 1 -1"), ErrorKind::OutOfRange, "negative"),
            (good.replace("3 2 1 0", "2 2 1"), ErrorKind::FileFormat, "2 vertices"),
            (good.replace("3 2 1 0", "0"), ErrorKind::FileFormat, "0 vertices"),
            (good.replace("float x", "list uchar float x"), ErrorKind::FileFormat, "x, y, z"),
            (good.replace("_indices", "_list"), ErrorKind::FileFormat, "vertex_indices"),
            (good.replace("uchar int", "uchar float"), ErrorKind::FileFormat, "integers"),
            (good.replace("element face", "element fase"), ErrorKind::FileFormat, "\"face\""),
            (good.replace("1 1 0 3\n", "1 one 0 3\n"), ErrorKind::FileFormat, "line 15"),
            ("solid cube".to_owned(), ErrorKind::FileFormat, "line 1"),
        ];
        for (text, kind, part) in cases {
            let error = error(&text);
            assert!(error.kind == kind && error.to_string().contains(part), "{part}: {error:?}");
            assert!(!error.to_string().contains('\n'));
        }
        let short = binary(false);
        assert_eq!(parse(&short[..short.len() - 1]).expect_err("truncated").kind, ErrorKind::FileFormat);
    }

    #[test]
    fn empty_elements_do_not_run_on() {
        let text = ascii().replace("element face", "element void 1000000000000000000\nelement face");
        for format in ["ascii", "binary_little_endian"] {
            assert!(error(&text.replace("ascii", format)).to_string().contains("void"));
        }
    }

    proptest! {
        #[test]
        fn mutated_files_do_not_panic(
            encoding in 0..3usize,
            edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
            length in any::<prop::sample::Index>(),
            cut in any::<bool>(),
        ) {
            let mut bytes = [ascii().into_bytes(), binary(false), binary(true)][encoding].clone();
            for (place, byte) in edits {
                let place = place.index(bytes.len());
                bytes[place] = byte;
            }
            if cut {
                bytes.truncate(length.index(bytes.len()));
            }
            if let Ok(mesh) = parse(&bytes) {
                let count = mesh.positions.len();
                prop_assert!(mesh.indices.iter().flatten().all(|&index| (index as usize) < count));
            }
        }

        #[test]
        fn arbitrary_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = parse(&bytes);
        }
    }
}
