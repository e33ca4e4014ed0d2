//! The file's top level, camera, film, render, develop, materials, objects, lights and environment.

use super::kinds::*;
use super::shape::{SHAPE, TRANSFORM, VECTOR};
use super::spectrum::IOR;

/// The version of the format that this program reads.
pub const VERSION: i64 = 1;

/// Largest width or height, pixels.
const MAX_SIDE: f64 = (1u64 << 20) as f64;

/// Most pixels of a picture.
pub const MAX_PIXELS: u64 = 1 << 32;

const MAX_SAMPLES: f64 = (1u64 << 40) as f64;
const MAX_SEED: f64 = (1u64 << 53) as f64;
const MAX_OBJECTS: usize = 10_000_000;

/// The key that every scene object may have.
pub static NAME: &[Field] = &[optional("name", Kind::Name("a name for messages"), "A name for messages.")];

const fn table(what: &'static str, doc: &'static str, fields: &'static [Field]) -> Table {
    Table { what, doc, fields, common: NAME, rule: Rule::Free, later: &[] }
}

/// The whole file.
pub static SCENE: Table = table("a scene", "A scene for abbe, version 1.", &SCENE_FIELDS);
static SCENE_FIELDS: [Field; 11] = [
    optional("$schema", Kind::Text, "Where the JSON Schema of this format is, for editors."),
    default("abbe", Kind::Integer(Range::from_to(VERSION as f64, VERSION as f64)), "1", "Version of the format: 1."),
    required("camera", Kind::Tagged(&CAMERA), "The camera."),
    required("film", Kind::Object(&FILM), "Picture size and reconstruction filter."),
    default("render", Kind::Object(&RENDER), "{}", "Sampling and integrator."),
    default("spectra", Kind::Map(&SPECTRA), "{}", "Spectra by name."),
    default("materials", Kind::Map(&MATERIALS), "{}", "Materials by name."),
    default("objects", Kind::List(&OBJECTS), "[]", "Shapes with their materials."),
    default(
        "lights",
        Kind::List(&LIGHTS),
        "[]",
        "Lights without a shape; a lamp with one is an object with `emission`.",
    ),
    optional("environment", Kind::Object(&ENVIRONMENT), "Light from infinitely far away; none by default."),
    default("develop", Kind::Object(&DEVELOP), "{}", "How the film becomes a PNG; no effect on EXR."),
];

static SPECTRA: Map = Map { what: "a spectrum", item: Kind::Spectrum(Role::Named) };
static MATERIALS: Map = Map { what: "a material", item: Kind::Tagged(&MATERIAL) };
static OBJECTS: List = List { what: "an object", item: Kind::Object(&OBJECT), min: 0, max: MAX_OBJECTS };
static LIGHTS: List = List { what: "a light", item: Kind::Tagged(&LIGHT), min: 0, max: MAX_OBJECTS };

/// The camera.
pub static CAMERA: Tagged =
    Tagged { what: "a camera", tag: "type", variants: &[("perspective", Body::Table(&PERSPECTIVE))], later: &[] };
static FOV_AXIS: Choice = Choice { what: "an axis", names: &[("x", "Horizontal."), ("y", "Vertical.")], later: &[] };
static PERSPECTIVE_FIELDS: [Field; 7] = [
    required("from", VECTOR, "Position of the pinhole or of the lens's centre, metres."),
    required("to", VECTOR, "Point looked at, metres."),
    default("up", VECTOR, "[0, 1, 0]", "Direction that is up in the picture."),
    default(
        "fov_degrees",
        Kind::Number(Range::between(0.0, 180.0)),
        "40",
        "Full field of view along `fov_axis`, degrees.",
    ),
    default("fov_axis", Kind::Choice(&FOV_AXIS), "\"x\"", "The axis of the picture that `fov_degrees` spans."),
    default("aperture_radius", Kind::Number(Range::LENGTH_OR_ZERO), "0", "Lens radius, metres; 0 is a pinhole."),
    optional("focus_distance", Kind::Number(Range::LENGTH), "Distance in focus, metres; |to − from| by default."),
];
static PERSPECTIVE: Table = table(
    "a perspective camera",
    "A pinhole camera, or a thin lens if `aperture_radius` is not 0.",
    &PERSPECTIVE_FIELDS,
);

/// The film.
static FILM_FIELDS: [Field; 4] = [
    required("width", Kind::Integer(Range::from_to(1.0, MAX_SIDE)), "Pixels in a row."),
    required("height", Kind::Integer(Range::from_to(1.0, MAX_SIDE)), "Rows; width × height is at most 2^32."),
    default(
        "filter",
        Kind::Tagged(&FILTER),
        "{\"type\": \"box\"}",
        "Reconstruction filter; a box of 0.5 pixel by default.",
    ),
    default(
        "observer",
        Kind::Choice(&OBSERVER),
        "\"1931-2\"",
        "Whose XYZ the film records, and by whose eyes wavelengths are chosen.",
    ),
];
/// Standard observers.
static OBSERVER: Choice = Choice {
    what: "an observer",
    names: &[
        ("1931-2", "CIE 1931, 2 degrees."),
        ("1964-10", "CIE 1964, 10 degrees."),
        ("2015-2", "CIE 2015, 2 degrees, from cone fundamentals."),
        ("2015-10", "CIE 2015, 10 degrees, from cone fundamentals."),
    ],
    later: &[],
};
/// Picture size and filter.
pub static FILM: Table = table("a film", "Picture size and reconstruction filter.", &FILM_FIELDS);

/// Reconstruction filters.
pub static FILTER: Tagged = Tagged {
    what: "a filter",
    tag: "type",
    variants: &[
        ("box", Body::Table(&BOX)),
        ("gaussian", Body::Table(&GAUSSIAN)),
        ("blackman-harris", Body::Table(&BLACKMAN_HARRIS)),
    ],
    later: &[],
};
const FILTER_RADIUS: Kind = Kind::Number(Range { above: true, ..Range::from_to(0.0, 64.0) });
static BOX_FIELDS: [Field; 1] = [default("radius", FILTER_RADIUS, "0.5", "Half width, pixels.")];
static BOX: Table = table("a box filter", "Constant.", &BOX_FIELDS);
static WIDE_FIELDS: [Field; 1] = [default("radius", FILTER_RADIUS, "1.5", "Half width, pixels.")];
static GAUSSIAN: Table =
    table("a Gaussian filter", "A Gaussian of standard deviation radius / 3, cut at the radius.", &WIDE_FIELDS);
static BLACKMAN_HARRIS: Table = table("a Blackman–Harris filter", "The Blackman–Harris window.", &WIDE_FIELDS);

/// Integrators.
pub static INTEGRATOR: Choice = Choice {
    what: "an integrator",
    names: &[
        ("auto", "Each class of paths by the technique that suits it."),
        ("path", "Camera paths with next-event estimation."),
        ("light", "Light paths, splatted onto the film."),
        ("merge", "Photon merging."),
        ("hero", "The baseline: 4 wavelengths, one kept after any dispersive hit."),
    ],
    later: &[],
};
static RENDER_FIELDS: [Field; 4] = [
    default("samples_per_pixel", Kind::Integer(Range::from_to(1.0, MAX_SAMPLES)), "64", "Camera paths per pixel."),
    default(
        "max_depth",
        Kind::Integer(Range::from_to(0.0, 1e7)),
        "64",
        "Largest number of scattering events on a path: 0 is emitted light only, 1 direct light; each refraction counts.",
    ),
    default("seed", Kind::Integer(Range::from_to(0.0, MAX_SEED)), "0", "Seed of every random sequence."),
    default("integrator", Kind::Choice(&INTEGRATOR), "\"auto\"", "Light transport technique."),
];
/// Sampling options.
pub static RENDER: Table = table("render", "Sampling and integrator.", &RENDER_FIELDS);

/// Tone mapping operators.
pub static TONEMAP: Choice = Choice {
    what: "a tone mapping operator",
    names: &[
        ("srgb", "None: linear up to 1, clipped above."),
        ("exponential", "1 − exp(−x) on each channel."),
        ("reinhard", "Reinhard's global operator on luminance [Reinhard2002]."),
    ],
    later: &["drago", "ashikhmin", "durand", "tumblin", "schlick", "logarithmic", "filmic", "aces", "agx", "lcis"],
};
static AUTO: Choice = Choice { what: "an exposure", names: &[("auto", "From the picture.")], later: &[] };
static EXPOSURE_KINDS: [Kind; 2] = [Kind::Choice(&AUTO), Kind::Number(Range::from_to(-200.0, 200.0))];
static DEVELOP_FIELDS: [Field; 2] = [
    default("exposure_ev", Kind::Either(&EXPOSURE_KINDS), "\"auto\"", "Exposure in stops, or \"auto\"."),
    default("tonemap", Kind::Choice(&TONEMAP), "\"srgb\"", "Tone mapping operator."),
];
/// Developing options.
pub static DEVELOP: Table = table("develop", "How the film becomes a PNG.", &DEVELOP_FIELDS);

/// Materials.
pub static MATERIAL: Tagged = Tagged {
    what: "a material",
    tag: "type",
    variants: &[
        ("diffuse", Body::Table(&DIFFUSE)),
        ("mirror", Body::Table(&MIRROR)),
        ("conductor", Body::Table(&CONDUCTOR)),
        ("dielectric", Body::Table(&DIELECTRIC)),
    ],
    later: &["principled", "layered", "iridescent", "measured", "cloth", "glints", "mix"],
};
const TWO_SIDED: Field = default("two_sided", Kind::Bool, "true", "Whether the back side scatters like the front.");
const ALPHA: Range = Range::FRACTION;
static ROUGHNESS_KINDS: [Kind; 2] = [Kind::Number(ALPHA), Kind::Numbers(Numbers::exactly(2, ALPHA))];
const ROUGHNESS: Field = default(
    "roughness",
    Kind::Either(&ROUGHNESS_KINDS),
    "0",
    "GGX alpha, or [ax, ay], which must be equal in this version; 0 is smooth.",
);
static REFLECTOR_FIELDS: [Field; 2] =
    [required("reflectance", Kind::Spectrum(Role::Reflectance), "Reflectance in [0, 1]."), TWO_SIDED];
static DIFFUSE: Table = table("a diffuse material", "Lambertian reflection.", &REFLECTOR_FIELDS);
static MIRROR: Table = table("a mirror", "A perfect mirror.", &REFLECTOR_FIELDS);
static CONDUCTOR_FIELDS: [Field; 5] = [
    optional("metal", Kind::Name("a metal of the library"), "A metal by name; instead of eta and k."),
    optional("eta", Kind::Spectrum(Role::Index), "Real part of the complex index."),
    optional("k", Kind::Spectrum(Role::Index), "Imaginary part of the complex index."),
    ROUGHNESS,
    TWO_SIDED,
];
static CONDUCTOR: Table = Table {
    what: "a conductor",
    doc: "A metal by its complex index of refraction.",
    fields: &CONDUCTOR_FIELDS,
    common: NAME,
    rule: Rule::OneOf(&[&["metal"], &["eta", "k"]]),
    later: &[],
};
static DIELECTRIC_FIELDS: [Field; 4] = [
    required("ior", Kind::Forms(&IOR), "Index of refraction relative to air."),
    ROUGHNESS,
    optional("absorption_per_m", Kind::Spectrum(Role::Absorption), "Absorption coefficient inside, per metre."),
    default(
        "priority",
        Kind::Integer(Range::from_to(i32::MIN as f64, i32::MAX as f64)),
        "0",
        "Where volumes overlap the higher wins; ties are won by the object entered last.",
    ),
];
static DIELECTRIC: Table = table("a dielectric", "A transparent solid.", &DIELECTRIC_FIELDS);

static OBJECT_FIELDS: [Field; 5] = [
    required("shape", Kind::Tagged(&SHAPE), "The shape in its own coordinates."),
    optional(
        "material",
        Kind::Name("one of `materials`"),
        "The name of one of `materials`; black if only `emission` is given.",
    ),
    optional("emission", Kind::Spectrum(Role::Emission), "Emitted radiance, W·m⁻²·sr⁻¹·nm⁻¹."),
    default("emission_two_sided", Kind::Bool, "false", "Whether the back side emits as well."),
    default(
        "transform",
        Kind::List(&TRANSFORM),
        "[]",
        "Steps from the shape's coordinates to the scene's, applied in order.",
    ),
];
/// A shape with its material.
pub static OBJECT: Table = Table {
    what: "an object",
    doc: "A shape with its material.",
    fields: &OBJECT_FIELDS,
    common: NAME,
    rule: Rule::AnyOf(&[&["material"], &["emission"]]),
    later: &[],
};

/// Lights without a shape.
pub static LIGHT: Tagged = Tagged {
    what: "a light",
    tag: "type",
    variants: &[
        ("point", Body::Table(&POINT)),
        ("spot", Body::Table(&SPOT)),
        ("directional", Body::Table(&DIRECTIONAL)),
        ("beam", Body::Table(&BEAM)),
    ],
    later: &[],
};
const EMISSION: Kind = Kind::Spectrum(Role::Emission);
const HALF_ANGLE: Kind = Kind::Number(Range::from_to(0.0, 180.0));
const DIRECTION: Field = required("direction", VECTOR, "Direction of travel, of any length but 0.");
static POINT_FIELDS: [Field; 2] =
    [required("position", VECTOR, "Position, metres."), required("intensity", EMISSION, "W·sr⁻¹·nm⁻¹.")];
static POINT: Table = table("a point light", "Equal intensity in every direction.", &POINT_FIELDS);
static SPOT_FIELDS: [Field; 5] = [
    required("position", VECTOR, "Position, metres."),
    DIRECTION,
    required("intensity", EMISSION, "Intensity on the axis, W·sr⁻¹·nm⁻¹."),
    required("inner_degrees", HALF_ANGLE, "Half angle of full intensity, degrees."),
    required("outer_degrees", HALF_ANGLE, "Half angle where the light ends, degrees; at least `inner_degrees`."),
];
static SPOT: Table = table("a spot light", "A cone with a smooth edge.", &SPOT_FIELDS);
static DIRECTIONAL_FIELDS: [Field; 3] = [
    DIRECTION,
    required("irradiance", EMISSION, "On a plane facing the light, W·m⁻²·nm⁻¹."),
    default(
        "angular_diameter_degrees",
        HALF_ANGLE,
        "0",
        "Full angle of the disc, degrees; 0.53 is the sun, 0 parallel light.",
    ),
];
static DIRECTIONAL: Table = table("a directional light", "Light from infinitely far away.", &DIRECTIONAL_FIELDS);
static BEAM_FIELDS: [Field; 4] = [
    required("origin", VECTOR, "Centre of the disc it starts from, metres."),
    DIRECTION,
    required("radius", Kind::Number(Range::LENGTH), "Radius, metres."),
    required("power", EMISSION, "W·nm⁻¹."),
];
static BEAM: Table = table("a beam", "A collimated beam of circular section.", &BEAM_FIELDS);

static ENVIRONMENT_FIELDS: [Field; 1] =
    [required("radiance", EMISSION, "Radiance from every direction, W·m⁻²·sr⁻¹·nm⁻¹.")];
/// Light from infinitely far away.
pub static ENVIRONMENT: Table = Table {
    what: "an environment",
    doc: "Light from infinitely far away, the same from every direction.",
    fields: &ENVIRONMENT_FIELDS,
    common: NAME,
    rule: Rule::Free,
    later: &["image", "mapping", "scale", "rotate_degrees"],
};
