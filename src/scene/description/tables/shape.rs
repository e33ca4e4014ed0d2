//! Shapes and transforms.

use super::kinds::*;
use super::scene::NAME;

/// A point or vector.
pub const VECTOR: Kind = Kind::Numbers(Numbers::exactly(3, Range::COORDINATE));

const LENGTH: Kind = Kind::Number(Range::LENGTH);
const ACUTE: Kind = Kind::Number(Range::between(0.0, 90.0));
const SHARE: Kind = Kind::Number(Range::between(0.0, 1.0));

/// A shape in its own coordinates.
pub static SHAPE: Tagged = Tagged {
    what: "a shape",
    tag: "type",
    variants: &[
        ("sphere", Body::Table(&SPHERE)),
        ("quad", Body::Table(&QUAD)),
        ("disk", Body::Table(&DISK)),
        ("box", Body::Table(&BOX)),
        ("cylinder", Body::Table(&CYLINDER)),
        ("triangles", Body::Table(&TRIANGLES)),
        ("mesh", Body::Table(&MESH)),
        ("implicit", Body::Tagged(&IMPLICIT)),
        ("prism", Body::Table(&PRISM)),
        ("brilliant", Body::Table(&BRILLIANT)),
        ("lens", Body::Table(&LENS)),
    ],
    later: &[],
};

/// Built-in implicit surfaces.
static IMPLICIT: Tagged = Tagged {
    what: "an implicit shape",
    tag: "surface",
    variants: &[
        ("torus", Body::Table(&TORUS)),
        ("superquadric", Body::Table(&SUPERQUADRIC)),
        ("gyroid", Body::Table(&GYROID)),
        ("smooth-union", Body::Table(&SMOOTH_UNION)),
        ("tanglecube", Body::Table(&TANGLECUBE)),
    ],
    later: &[],
};

const fn shape(what: &'static str, doc: &'static str, fields: &'static [Field]) -> Table {
    Table { what, doc, fields, common: NAME, rule: Rule::Free, later: &[] }
}

static SPHERE_FIELDS: [Field; 2] =
    [required("center", VECTOR, "Centre, metres."), required("radius", LENGTH, "Radius, metres.")];
static SPHERE: Table = shape("a sphere", "A sphere.", &SPHERE_FIELDS);

static QUAD_FIELDS: [Field; 3] = [
    required("origin", VECTOR, "A corner, metres."),
    required("u", VECTOR, "First edge, metres."),
    required("v", VECTOR, "Second edge, metres; not parallel to the first."),
];
static QUAD: Table = shape("a quad", "A parallelogram; its normal is u × v.", &QUAD_FIELDS);

static DISK_FIELDS: [Field; 3] = [
    required("center", VECTOR, "Centre, metres."),
    required("normal", VECTOR, "Normal, of any length but 0."),
    required("radius", LENGTH, "Radius, metres."),
];
static DISK: Table = shape("a disk", "A flat disk.", &DISK_FIELDS);

static BOX_FIELDS: [Field; 2] = [
    required("min", VECTOR, "Smallest corner, metres."),
    required("max", VECTOR, "Largest corner, metres; each component above that of `min`."),
];
static BOX: Table = shape("a box", "A box with edges along the axes.", &BOX_FIELDS);

static CYLINDER_FIELDS: [Field; 3] = [
    required("radius", LENGTH, "Radius, metres."),
    required("height", LENGTH, "Height, metres."),
    default("open", Kind::Bool, "false", "Whether it is without caps."),
];
static CYLINDER: Table = shape("a cylinder", "A cylinder: axis y, centred.", &CYLINDER_FIELDS);

const POINTS: Kind = Kind::Numbers(Numbers::tuples(3, Range::COORDINATE));
static TRIANGLES_FIELDS: [Field; 4] = [
    required("positions", POINTS, "Vertices, flat: x, y, z, x, …; metres."),
    required(
        "indices",
        Kind::Numbers(Numbers { integer: true, ..Numbers::tuples(3, Range::from_to(0.0, u32::MAX as f64)) }),
        "Vertices of each triangle, flat, counted from 0; counter-clockwise seen from outside.",
    ),
    optional("normals", POINTS, "Shading normals, flat, one for each vertex."),
    optional(
        "uvs",
        Kind::Numbers(Numbers::tuples(2, Range::COORDINATE)),
        "Texture coordinates, flat, one for each vertex.",
    ),
];
static TRIANGLES: Table = shape("triangles", "Triangles given in the scene file.", &TRIANGLES_FIELDS);

static MESH_FILE: FileKind = FileKind { what: "a mesh", extensions: &["obj", "ply"], later: &["gltf", "glb"] };
static MESH_FIELDS: [Field; 1] = [required("file", Kind::File(&MESH_FILE), "Path of the mesh.")];
static MESH: Table = shape("a mesh", "Triangles from a file.", &MESH_FIELDS);

static PRISM_FIELDS: [Field; 3] = [
    required("apex_degrees", Kind::Number(Range::between(0.0, 180.0)), "Angle at the apex, degrees."),
    required("side", LENGTH, "Length of the two equal sides, metres."),
    required("length", LENGTH, "Length along y, metres."),
];
static PRISM: Table =
    shape("a prism", "An isosceles triangular prism along y, centred, apex towards +x.", &PRISM_FIELDS);

static BRILLIANT_FIELDS: [Field; 7] = [
    required("radius", LENGTH, "Girdle radius, metres."),
    default("table", SHARE, "0.57", "Table diameter as a fraction of the girdle's."),
    default("crown_degrees", ACUTE, "34.5", "Angle of the crown mains to the girdle plane, degrees."),
    default("pavilion_degrees", ACUTE, "40.75", "Angle of the pavilion mains to the girdle plane, degrees."),
    default("girdle", SHARE, "0.03", "Girdle thickness as a fraction of its diameter."),
    default("star", SHARE, "0.5", "Length of the star facets: share of the way from table to girdle."),
    default("lower_half", SHARE, "0.77", "Length of the lower halves: share of the way from girdle to culet."),
];
static BRILLIANT: Table =
    shape("a brilliant", "A round brilliant cut: axis y, table up, girdle plane y = 0.", &BRILLIANT_FIELDS);

static LENS_FIELDS: [Field; 3] = [
    required(
        "radii",
        Kind::Numbers(Numbers { null: true, ..Numbers::exactly(2, Range::COORDINATE) }),
        "Radii of curvature of the faces towards −z and +z, metres: positive when convex, negative when concave, null when flat.",
    ),
    required("thickness", LENGTH, "Thickness on the axis, metres."),
    required("diameter", LENGTH, "Diameter, metres."),
];
static LENS: Table = shape("a lens", "A spherical lens: axis z, centred.", &LENS_FIELDS);

static TORUS_FIELDS: [Field; 2] = [
    required("major_radius", LENGTH, "Radius of the centre line, metres."),
    required("minor_radius", LENGTH, "Radius of the tube, metres; less than `major_radius`."),
];
static TORUS: Table = shape("a torus", "A torus about the y axis.", &TORUS_FIELDS);

const EXPONENT: Kind = Kind::Number(Range::from_to(0.1, 2.0));
static SUPERQUADRIC_FIELDS: [Field; 3] = [
    required("radii", Kind::Numbers(Numbers::exactly(3, Range::LENGTH)), "Half axes along x, y, z, metres."),
    default("exponent_y", EXPONENT, "1", "e₁, north–south: 1 is round, 2 an octahedron's edge, towards 0 boxy."),
    default("exponent_xz", EXPONENT, "1", "e₂, east–west, likewise."),
];
static SUPERQUADRIC: Table = shape(
    "a superquadric",
    "(|x/a|^(2/e₂) + |z/c|^(2/e₂))^(e₂/e₁) + |y/b|^(2/e₁) = 1 [Barr1981].",
    &SUPERQUADRIC_FIELDS,
);

static GYROID_FIELDS: [Field; 3] = [
    required("period", LENGTH, "Period of the surface, metres."),
    required("thickness", LENGTH, "Thickness of the wall, metres; less than half the period."),
    required("radius", LENGTH, "Radius of the sphere about the origin that cuts it, metres."),
];
static GYROID: Table = shape("a gyroid", "A wall along Schoen's gyroid, cut by a sphere.", &GYROID_FIELDS);

static CENTERS: List = List { what: "a centre", item: VECTOR, min: 1, max: 64 };
static SMOOTH_UNION_FIELDS: [Field; 3] = [
    required("centers", Kind::List(&CENTERS), "Centres of the spheres, each [x, y, z], metres."),
    required("radii", Kind::Numbers(Numbers::several(1, 64, Range::LENGTH)), "Radii, one for each centre, metres."),
    default("blend", Kind::Number(Range::LENGTH_OR_ZERO), "0", "Width of the blend, metres."),
];
static SMOOTH_UNION: Table = shape("a smooth union", "Spheres melted into each other.", &SMOOTH_UNION_FIELDS);

static TANGLECUBE_FIELDS: [Field; 2] = [
    required("size", LENGTH, "Length of one unit of the equation, metres."),
    default(
        "level",
        Kind::Number(Range { below: true, ..Range::from_to(-100.0, 18.75) }),
        "11.8",
        "The constant term; the solid is empty from 18.75 on.",
    ),
];
static TANGLECUBE: Table =
    shape("a tanglecube", "x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + level = 0, in units of `size`.", &TANGLECUBE_FIELDS);

/// Most steps of a transform.
const MAX_STEPS: usize = 64;

/// The steps of a transform.
pub static TRANSFORM: List =
    List { what: "a transform step", item: Kind::Forms(&TRANSFORM_STEP), min: 0, max: MAX_STEPS };

/// One step of a transform.
pub static TRANSFORM_STEP: Forms =
    Forms { what: "a transform step", number: None, text: None, forms: &[&TRANSLATE, &ROTATE, &SCALE, &MATRIX] };

const fn step(what: &'static str, doc: &'static str, fields: &'static [Field]) -> Table {
    Table { what, doc, fields, common: &[], rule: Rule::Free, later: &[] }
}

static TRANSLATE_FIELDS: [Field; 1] = [required("translate", VECTOR, "Shift, metres.")];
static TRANSLATE: Table = step("a translation", "A shift.", &TRANSLATE_FIELDS);

static ROTATE_FIELDS: [Field; 2] = [
    required("rotate_degrees", Kind::Number(Range::from_to(-1e6, 1e6)), "Angle, degrees; right-handed about the axis."),
    required("axis", VECTOR, "Axis through the origin, of any length but 0."),
];
static ROTATE: Table = step("a rotation", "A rotation about an axis through the origin.", &ROTATE_FIELDS);

static SCALE_KINDS: [Kind; 2] = [Kind::Number(Range::COORDINATE), VECTOR];
static SCALE_FIELDS: [Field; 1] =
    [required("scale", Kind::Either(&SCALE_KINDS), "One factor, or one for each axis; not 0.")];
static SCALE: Table = step("a scaling", "A scaling about the origin.", &SCALE_FIELDS);

static MATRIX_FIELDS: [Field; 1] = [required(
    "matrix",
    Kind::Numbers(Numbers::exactly(16, Range::COORDINATE)),
    "An affine matrix, row by row; its last row is 0 0 0 1.",
)];
static MATRIX: Table = step("a matrix", "An affine map.", &MATRIX_FIELDS);
