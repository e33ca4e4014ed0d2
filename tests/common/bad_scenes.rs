//! Malformed scenes, each with what the error must say.

/// A malformed scene.
pub struct BadScene {
    /// What is wrong, as a file name.
    pub name: &'static str,
    /// The scene.
    pub text: String,
    /// `ErrorKind::code` of the error.
    pub code: &'static str,
    /// JSON path or line of the error.
    pub place: &'static str,
    /// Part of the error's line.
    pub fragment: &'static str,
    /// Whether parsing accepts it and only compiling, which reads files and tables, can tell.
    pub needs_compile: bool,
}

/// A small valid scene; each bad one differs from it in one place.
pub const GOOD: &str = r#"{
  "abbe": 1,
  "camera": { "type": "perspective", "from": [0, 1, 5], "to": [0, 0, 0] },
  "film": { "width": 8, "height": 8 },
  "render": {},
  "spectra": { "red_paint": { "wavelengths_nm": [380, 600, 780], "values": [0.1, 0.5, 0.6] } },
  "materials": { "floor": { "type": "diffuse", "reflectance": "red_paint" }, "glass": { "type": "dielectric", "ior": 1.5 } },
  "objects": [ { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "material": "floor" },
               { "shape": { "type": "sphere", "center": [3, 0, 0], "radius": 1 }, "material": "glass" } ],
  "lights": [ { "type": "point", "position": [0, 3, 0], "intensity": 1.0 } ],
  "environment": { "radiance": 0.05 },
  "develop": {}
}"#;

/// Every malformed scene.
pub fn bad_scenes() -> Vec<BadScene> {
    let whole = WHOLE.iter().map(|&(name, text, code, place, fragment)| BadScene {
        name,
        text: text.to_owned(),
        code,
        place,
        fragment,
        needs_compile: false,
    });
    let edit = |&(name, from, to, code, place, fragment): &Edit, needs_compile| {
        assert_eq!(GOOD.matches(from).count(), 1, "{name}: {from:?} must occur once in the good scene");
        BadScene { name, text: GOOD.replace(from, to), code, place, fragment, needs_compile }
    };
    let shapes = SHAPES
        .iter()
        .map(|&(name, shape, code, place, fragment)| edit(&(name, FIRST_SHAPE, shape, code, place, fragment), false));
    let edits = EDITS.iter().map(|row| edit(row, false));
    let compiled = COMPILED.iter().map(|row| edit(row, true));
    whole.chain(edits).chain(shapes).chain(compiled).collect()
}

type Edit = (&'static str, &'static str, &'static str, &'static str, &'static str, &'static str);
type Whole = (&'static str, &'static str, &'static str, &'static str, &'static str);

/// Whole files: name, text, code, place, fragment.
#[rustfmt::skip] // one scene a line
const WHOLE: &[Whole] = &[
    ("empty file", "", "syntax", "line 1 column 1", "empty"),
    ("only spaces", " \n ", "syntax", "line 2", "empty"),
    ("not an object", "[1]", "wrong_type", "", "expected an object (a scene), found a list of 1 numbers"),
    ("empty object", "{}", "missing", "", "missing key `camera`; a scene needs camera, film"),
    ("cut off", "{\"camera\": {\"type\"", "syntax", "line 1 column 18", "ends too soon"),
    ("trailing garbage", "{\n} }", "syntax", "line 2 column 3", "expected nothing more"),
    ("not a number", "{\"film\": {\"width\": NaN}}", "not_finite", "line 1 column 20", "NaN is not a JSON number"),
    ("infinity", "{\"film\": {\"width\": Infinity}}", "not_finite", "line 1 column 20", "finite"),
    ("overflow", "{\"film\": {\"width\": 1e999}}", "not_finite", "line 1", "beyond the largest number"),
    ("comment", "// a scene\n{}", "syntax", "line 1 column 1", "JSON has no comments"),
    ("single quotes", "{'camera': 1}", "syntax", "line 1 column 2", "key must be a string"),
    ("other version", "{\"abbe\": 2, \"world\": []}", "version", "abbe", "version 2; expected version 1"),
];

/// Edits of the good scene: name, from, to, code, place, fragment.
#[rustfmt::skip] // one scene a line
const EDITS: &[Edit] = &[
    ("version is text", "\"abbe\": 1", "\"abbe\": \"1\"", "wrong_type", "abbe", "expected an integer"),
    ("unknown top-level key", "\"lights\"", "\"ligths\"", "unknown_key", "ligths", "did you mean \"lights\"?"),
    ("duplicate key", "\"width\": 8", "\"width\": 8, \"width\": 9", "duplicate", "film.width", "given twice"),
    ("duplicate material", "\"glass\": {", "\"floor\": {", "duplicate", "materials.floor", "\"floor\""),
    // camera
    ("camera without type", "\"type\": \"perspective\", ", "", "missing", "camera", "missing key `type`"),
    ("unknown camera", "\"perspective\"", "\"perpective\"", "unknown_name", "camera.type", "did you mean \"perspective\"?"),
    ("camera without to", ", \"to\": [0, 0, 0]", "", "missing", "camera", "missing key `to`; a perspective camera needs from, to"),
    ("camera from is short", "[0, 1, 5]", "[0, 1]", "wrong_type", "camera.from", "expected a list of 3 numbers"),
    ("camera from has text", "[0, 1, 5]", "[0, \"1 m\", 5]", "wrong_type", "camera.from[1]", "found a string: \"1 m\""),
    ("camera too far", "[0, 1, 5]", "[0, 1, 1e31]", "out_of_range", "camera.from[2]", "1e31"),
    ("camera at its target", "\"to\": [0, 0, 0]", "\"to\": [0, 1, 5]", "degenerate", "camera", "same point"),
    ("up along the view", "\"to\": [0, 0, 0]", "\"to\": [0, 1, 0], \"up\": [0, 0, 3]", "degenerate", "camera", "parallel"),
    ("up is zero", "\"to\": [0, 0, 0]", "\"to\": [0, 1, 0], \"up\": [0, 0, 0]", "degenerate", "camera.up", "zero vector"),
    ("fov too wide", "\"to\": [0, 0, 0]", "\"to\": [0, 0, 0], \"fov_degrees\": 180", "out_of_range", "camera.fov_degrees", "(0, 180)"),
    ("fov without unit", "\"to\": [0, 0, 0]", "\"to\": [0, 0, 0], \"fov\": 30", "unknown_key", "camera.fov", "did you mean"),
    ("unknown fov axis", "\"to\": [0, 0, 0]", "\"to\": [0, 0, 0], \"fov_axis\": \"z\"", "unknown_name", "camera.fov_axis", "\"x\", \"y\""),
    ("negative aperture", "\"to\": [0, 0, 0]", "\"to\": [0, 0, 0], \"aperture_radius\": -1", "out_of_range", "camera.aperture_radius", "found -1"),
    ("no focus", "\"to\": [0, 0, 0]", "\"to\": [0, 0, 0], \"focus_distance\": 0", "out_of_range", "camera.focus_distance", "(0, 1e30]"),
    // film, render, develop
    ("film without width", "\"width\": 8, ", "", "missing", "film", "missing key `width`; a film needs width, height"),
    ("width of half a pixel", "\"width\": 8", "\"width\": 8.5", "wrong_type", "film.width", "expected an integer"),
    ("width is zero", "\"width\": 8", "\"width\": 0", "out_of_range", "film.width", "found 0"),
    ("width is huge", "\"width\": 8", "\"width\": 1048577", "out_of_range", "film.width", "1048577"),
    ("too many pixels", "\"width\": 8, \"height\": 8", "\"width\": 1048576, \"height\": 4097", "limit_exceeded", "film", "pixels"),
    ("unknown filter", "\"height\": 8", "\"height\": 8, \"filter\": {\"type\": \"gauss\"}", "unknown_name", "film.filter.type", "did you mean \"gaussian\"?"),
    ("filter radius zero", "\"height\": 8", "\"height\": 8, \"filter\": {\"type\": \"box\", \"radius\": 0}", "out_of_range", "film.filter.radius", "found 0"),
    ("no samples", "\"render\": {}", "\"render\": {\"samples_per_pixel\": 0}", "out_of_range", "render.samples_per_pixel", "found 0"),
    ("negative depth", "\"render\": {}", "\"render\": {\"max_depth\": -1}", "out_of_range", "render.max_depth", "found -1"),
    ("seed beyond f64", "\"render\": {}", "\"render\": {\"seed\": 9007199254740993}", "out_of_range", "render.seed", "9007199254740993"),
    ("seed beyond u64", "\"render\": {}", "\"render\": {\"seed\": 1e30}", "out_of_range", "render.seed", "1e30"),
    ("unknown integrator", "\"render\": {}", "\"render\": {\"integrator\": \"paths\"}", "unknown_name", "render.integrator", "did you mean \"path\"?"),
    ("render is a list", "\"render\": {}", "\"render\": []", "wrong_type", "render", "expected an object"),
    ("exposure is text", "\"develop\": {}", "\"develop\": {\"exposure_ev\": \"bright\"}", "unknown_name", "develop.exposure_ev", "\"auto\""),
    ("exposure is true", "\"develop\": {}", "\"develop\": {\"exposure_ev\": true}", "wrong_type", "develop.exposure_ev", "\"auto\" or a number"),
    ("unknown tonemap", "\"develop\": {}", "\"develop\": {\"tonemap\": \"reinhart\"}", "unknown_name", "develop.tonemap", "did you mean \"reinhard\"?"),
    ("later tonemap", "\"develop\": {}", "\"develop\": {\"tonemap\": \"drago\"}", "unknown_name", "develop.tonemap", "expected \"srgb\", \"exponential\", \"reinhard\""),
    // spectra
    ("empty spectrum name", "\"red_paint\": {", "\"\": {", "missing", "spectra[\"\"]", "empty name"),
    ("empty spectrum", "[380, 600, 780]", "[]", "missing", "spectra.red_paint.wavelengths_nm", "empty list"),
    ("lengths differ", "[0.1, 0.5, 0.6]", "[0.1, 0.5]", "wrong_type", "spectra.red_paint.values", "2 values for 3 wavelengths"),
    ("wavelengths descend", "[380, 600, 780]", "[380, 780, 600]", "out_of_range", "spectra.red_paint.wavelengths_nm[2]", "600 after 780"),
    ("wavelengths repeat", "[380, 600, 780]", "[380, 380, 600]", "out_of_range", "spectra.red_paint.wavelengths_nm[1]", "ascend"),
    ("wavelength zero", "[380, 600, 780]", "[0, 600, 780]", "out_of_range", "spectra.red_paint.wavelengths_nm[0]", "> 0"),
    ("micrometres", "[380, 600, 780]", "[0.38, 0.6, 0.78]", "out_of_range", "spectra.red_paint.wavelengths_nm", "micrometres (780 nm)"),
    ("metres", "[380, 600, 780]", "[3.8e-7, 6e-7, 7.8e-7]", "out_of_range", "spectra.red_paint.wavelengths_nm", "metres (780 nm)"),
    ("no form", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"comment\": \"none\"}", "missing", "materials.floor.reflectance", "a spectrum has just one of name, wavelengths_nm"),
    ("two forms", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"rgb\": [1, 1, 1], \"illuminant\": \"D65\"}", "unknown_key", "materials.floor.reflectance.illuminant", "does not go with `rgb`"),
    ("unknown form", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"rgbs\": [1, 1, 1]}", "unknown_key", "materials.floor.reflectance.rgbs", "did you mean \"rgb\"?"),
    ("unknown spectrum", "\"reflectance\": \"red_paint\"", "\"reflectance\": \"red_pant\"", "unknown_name", "materials.floor.reflectance", "did you mean \"red_paint\"?"),
    ("spectrum refers to itself", "\"spectra\": {", "\"spectra\": { \"a\": \"a\",", "bad_reference", "spectra.a", "\"a\" → \"a\""),
    ("spectra in a circle", "\"spectra\": {", "\"spectra\": { \"x\": \"a\", \"a\": {\"name\": \"b\"}, \"b\": \"a\",", "bad_reference", "spectra.a", "\"a\" → \"b\" → \"a\""),
    ("reflectance above 1", "\"reflectance\": \"red_paint\"", "\"reflectance\": 1.5", "out_of_range", "materials.floor.reflectance", "[0, 1], found 1.5"),
    ("table above 1", "[0.1, 0.5, 0.6]", "[0.1, 50, 60]", "out_of_range", "materials.floor.reflectance", "spectra.red_paint.values[2]"),
    ("scaled above 1", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"name\": \"red_paint\", \"scale\": 2}", "out_of_range", "materials.floor.reflectance", "found 1.2"),
    ("rgb of 255", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"rgb\": [255, 1, 1]}", "out_of_range", "materials.floor.reflectance.rgb[0]", "found 255"),
    ("negative rgb", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"rgb\": [0, 0, -0.1]}", "out_of_range", "materials.floor.reflectance.rgb[2]", "found -0.1"),
    ("negative scale", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"name\": \"red_paint\", \"scale\": -1}", "out_of_range", "materials.floor.reflectance.scale", "found -1"),
    ("negative emission", "\"intensity\": 1.0", "\"intensity\": -1", "out_of_range", "lights[0].intensity", "expected an emission"),
    ("zero kelvin", "\"intensity\": 1.0", "\"intensity\": {\"blackbody_kelvin\": 0}", "out_of_range", "lights[0].intensity.blackbody_kelvin", "found 0"),
    ("line without width", "\"intensity\": 1.0", "\"intensity\": {\"line_nm\": 589.3}", "missing", "lights[0].intensity", "missing key `fwhm_nm`"),
    ("line of width 0", "\"intensity\": 1.0", "\"intensity\": {\"line_nm\": 589.3, \"fwhm_nm\": 0}", "out_of_range", "lights[0].intensity.fwhm_nm", "> 0"),
    ("line in micrometres", "\"intensity\": 1.0", "\"intensity\": {\"line_nm\": 0.5893, \"fwhm_nm\": 0.1}", "out_of_range", "lights[0].intensity.line_nm", "589.3 nm"),
    ("emission overflows", "\"intensity\": 1.0", "\"intensity\": {\"wavelengths_nm\": [300, 900], \"values\": [1, 1e300], \"scale\": 1e300}", "out_of_range", "lights[0].intensity.values[1]", "found inf"),
    ("spectrum file of unknown type", "\"intensity\": 1.0", "\"intensity\": {\"file\": \"lamp.xls\"}", "file_format", "lights[0].intensity.file", ".csv, .txt, .tsv, .dat, .spd, .spdx, .xml"),
    // materials
    ("unknown material type", "\"diffuse\"", "\"difuse\"", "unknown_name", "materials.floor.type", "did you mean \"diffuse\"?"),
    ("later material", "\"type\": \"diffuse\"", "\"type\": \"layered\"", "unknown_name", "materials.floor.type", "\"layered\" is not the type of a material; expected \"diffuse\""),
    ("material without reflectance", ", \"reflectance\": \"red_paint\"", "", "missing", "materials.floor", "missing key `reflectance`"),
    ("ior zero", "\"ior\": 1.5", "\"ior\": 0", "out_of_range", "materials.glass.ior", "> 0"),
    ("ior is a glass's name", "\"ior\": 1.5", "\"ior\": \"N-BK7\"", "wrong_type", "materials.glass.ior", "a glass is {\"glass\": \"N-BK7\"}"),
    ("ior key misspelt", "\"ior\": 1.5", "\"ior\": {\"galss\": \"N-BK7\"}", "unknown_key", "materials.glass.ior.galss", "did you mean \"glass\"?"),
    ("empty glass", "\"ior\": 1.5", "\"ior\": {\"glass\": \"\"}", "missing", "materials.glass.ior.glass", "empty string"),
    ("abbe number missing", "\"ior\": 1.5", "\"ior\": {\"nd\": 1.5}", "missing", "materials.glass.ior", "missing key `vd`"),
    ("sellmeier lengths", "\"ior\": 1.5", "\"ior\": {\"sellmeier\": {\"b\": [1, 2], \"c_um2\": [1]}}", "wrong_type", "materials.glass.ior.sellmeier.c_um2", "1 poles for 2 strengths"),
    ("cauchy empty", "\"ior\": 1.5", "\"ior\": {\"cauchy_um\": []}", "missing", "materials.glass.ior.cauchy_um", "empty list"),
    ("negative index table", "\"ior\": 1.5", "\"ior\": {\"wavelengths_nm\": [400, 700], \"values\": [1.5, -1]}", "out_of_range", "materials.glass.ior.values[1]", "> 0"),
    ("unknown extrapolation", "\"ior\": 1.5", "\"ior\": {\"glass\": \"N-BK7\", \"extrapolate\": \"linear\"}", "unknown_name", "materials.glass.ior.extrapolate", "\"hold\""),
    ("anisotropic glass", "\"ior\": 1.5", "\"ior\": 1.5, \"roughness\": [0, 0.1]", "unsupported", "materials.glass.roughness", "anisotropic roughness [0, 0.1] is not supported yet"),
    ("roughness above 1", "\"ior\": 1.5", "\"ior\": 1.5, \"roughness\": 2", "out_of_range", "materials.glass.roughness", "[0, 1]"),
    ("rgb absorption", "\"ior\": 1.5", "\"ior\": 1.5, \"absorption_per_m\": {\"rgb\": [1, 0, 0]}", "wrong_type", "materials.glass.absorption_per_m", "cannot be an RGB colour"),
    ("negative absorption", "\"ior\": 1.5", "\"ior\": 1.5, \"absorption_per_m\": -1", "out_of_range", "materials.glass.absorption_per_m", "an absorption"),
    ("fractional priority", "\"ior\": 1.5", "\"ior\": 1.5, \"priority\": 0.5", "wrong_type", "materials.glass.priority", "integer"),
    ("conductor with eta alone", "\"dielectric\", \"ior\": 1.5", "\"conductor\", \"eta\": 1", "missing", "materials.glass", "missing key `k`; a conductor needs metal, or eta and k"),
    ("conductor with too much", "\"dielectric\", \"ior\": 1.5", "\"conductor\", \"eta\": 1, \"k\": 1, \"metal\": \"Au\"", "unknown_key", "materials.glass", "just one of"),
    ("conductor in rgb", "\"dielectric\", \"ior\": 1.5", "\"conductor\", \"eta\": {\"rgb\": [1, 1, 1]}, \"k\": 1", "wrong_type", "materials.glass.eta", "RGB"),
    // objects
    ("unknown material", "\"material\": \"glass\"", "\"material\": \"glas\"", "unknown_name", "objects[1].material", "did you mean \"glass\"?"),
    ("object without material", ", \"material\": \"glass\"", "", "missing", "objects[1]", "an object needs material, or emission"),
    ("object without shape", "\"shape\": { \"type\": \"sphere\", \"center\": [3, 0, 0], \"radius\": 1 }, ", "", "missing", "objects[1]", "missing key `shape`"),
    ("inline material", "\"material\": \"glass\"", "\"material\": {\"type\": \"mirror\"}", "wrong_type", "objects[1].material", "found an object"),
    ("object is a number", "\"objects\": [ {", "\"objects\": [ 3, {", "wrong_type", "objects[0]", "expected an object"),
    ("objects are an object", "\"lights\": [ {", "\"lights\": {\"a\": 1}, \"comment\": [ {", "wrong_type", "lights", "expected a list"),
    ("scale zero", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"scale\": [1, 0, 1]}]", "degenerate", "objects[1].transform[0].scale", "factor of 0"),
    ("zero axis", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"rotate_degrees\": 3, \"axis\": [0, 0, 0]}]", "degenerate", "objects[1].transform[0].axis", "zero vector"),
    ("singular matrix", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"matrix\": [1,2,3,0, 4,5,6,0, 7,8,9,0, 0,0,0,1]}]", "degenerate", "objects[1].transform[0].matrix", "singular"),
    ("projective matrix", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]}]", "out_of_range", "objects[1].transform[0].matrix", "last row must be 0 0 0 1"),
    ("unknown step", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"translation\": [1, 0, 0]}]", "unknown_key", "objects[1].transform[0].translation", "did you mean \"translate\"?"),
    ("transform not a list", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": {\"scale\": 2}", "wrong_type", "objects[1].transform", "expected a list"),
    // lights, environment
    ("unknown light", "\"type\": \"point\"", "\"type\": \"poin\"", "unknown_name", "lights[0].type", "did you mean \"point\"?"),
    ("spot angles", "\"type\": \"point\"", "\"type\": \"spot\", \"direction\": [0, -1, 0], \"inner_degrees\": 30, \"outer_degrees\": 20", "out_of_range", "lights[0].outer_degrees", "at least `inner_degrees`, 30, found 20"),
    ("spot direction", "\"type\": \"point\"", "\"type\": \"spot\", \"direction\": [0, 0, 0], \"inner_degrees\": 10, \"outer_degrees\": 20", "degenerate", "lights[0].direction", "zero vector"),
    ("sun too wide", "\"type\": \"point\", \"position\": [0, 3, 0], \"intensity\": 1.0", "\"type\": \"directional\", \"direction\": [0, -1, 0], \"irradiance\": 1, \"angular_diameter_degrees\": 181", "out_of_range", "lights[0].angular_diameter_degrees", "[0, 180]"),
    ("beam without radius", "\"type\": \"point\", \"position\": [0, 3, 0], \"intensity\": 1.0", "\"type\": \"beam\", \"origin\": [0, 3, 0], \"direction\": [0, -1, 0], \"power\": 1", "missing", "lights[0]", "missing key `radius`"),
    ("environment image", "{ \"radiance\": 0.05 }", "{ \"image\": \"sky.exr\" }", "unknown_key", "environment.image", "an environment has radiance, name"),
    ("comment is a number", "{ \"radiance\": 0.05 }", "{ \"radiance\": 0.05, \"comment\": 3 }", "wrong_type", "environment.comment", "expected a string"),
];

const FIRST_SHAPE: &str = "{ \"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1 }";

/// Shapes in place of the first object's: name, shape, code, place, fragment.
#[rustfmt::skip] // one scene a line
const SHAPES: &[Whole] = &[
    ("unknown shape", r#"{"type": "sfere"}"#, "unknown_name", "objects[0].shape.type", "did you mean \"sphere\"?"),
    ("sphere without radius", r#"{"type": "sphere", "center": [0, 0, 0]}"#, "missing", "objects[0].shape", "missing key `radius`; a sphere needs center, radius"),
    ("sphere key misspelt", r#"{"type": "sphere", "center": [0, 0, 0], "raduis": 1}"#, "unknown_key", "objects[0].shape.raduis", "did you mean \"radius\"?"),
    ("negative radius", r#"{"type": "sphere", "center": [0, 0, 0], "radius": -1}"#, "out_of_range", "objects[0].shape.radius", "found -1"),
    ("radius is text", r#"{"type": "sphere", "center": [0, 0, 0], "radius": "1"}"#, "wrong_type", "objects[0].shape.radius", "found a string"),
    ("radius is null", r#"{"type": "sphere", "center": [0, 0, 0], "radius": null}"#, "wrong_type", "objects[0].shape.radius", "found null"),
    ("quad flat", r#"{"type": "quad", "origin": [0, 0, 0], "u": [0.1, 0.2, 0.3], "v": [0.3, 0.6, 0.9]}"#, "degenerate", "objects[0].shape", "parallel"),
    ("quad edge zero", r#"{"type": "quad", "origin": [0, 0, 0], "u": [0, 0, 0], "v": [0, 1, 0]}"#, "degenerate", "objects[0].shape.u", "zero vector"),
    ("disk normal", r#"{"type": "disk", "center": [0, 0, 0], "normal": [0, 0, 0], "radius": 1}"#, "degenerate", "objects[0].shape.normal", "zero vector"),
    ("box inside out", r#"{"type": "box", "min": [0, 0, 0], "max": [1, 0, 1]}"#, "degenerate", "objects[0].shape.max[1]", "more than the 0 of `min`"),
    ("cylinder without height", r#"{"type": "cylinder", "radius": 1}"#, "missing", "objects[0].shape", "a cylinder needs radius, height"),
    ("no triangles", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": []}"#, "missing", "objects[0].shape.indices", "empty list"),
    ("positions not in threes", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1], "indices": [0, 1, 2]}"#, "wrong_type", "objects[0].shape.positions", "3 for each entry, found 8"),
    ("positions nested", r#"{"type": "triangles", "positions": [[0,0,0], [1,0,0], [0,1,0]], "indices": [0, 1, 2]}"#, "wrong_type", "objects[0].shape.positions[0]", "found a list"),
    ("indices not in threes", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": [0, 1, 2, 0]}"#, "wrong_type", "objects[0].shape.indices", "found 4"),
    ("index too large", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": [0, 1, 3]}"#, "out_of_range", "objects[0].shape.indices[2]", "one of 3 vertices (0 to 2), found 3"),
    ("index negative", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": [0, 1, -1]}"#, "out_of_range", "objects[0].shape.indices[2]", "found -1"),
    ("index fractional", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": [0, 1, 1.5]}"#, "wrong_type", "objects[0].shape.indices[2]", "integer"),
    ("triangles without area", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 2,0,0], "indices": [0, 1, 2]}"#, "degenerate", "objects[0].shape", "area"),
    ("normals too few", r#"{"type": "triangles", "positions": [0,0,0, 1,0,0, 0,1,0], "indices": [0, 1, 2], "normals": [0,0,1]}"#, "wrong_type", "objects[0].shape.normals", "1 normals for 3 vertices"),
    ("gltf mesh", r#"{"type": "mesh", "file": "a.GLB"}"#, "file_format", "objects[0].shape.file", "expected a path to a mesh (.obj, .ply)"),
    ("mesh of unknown type", r#"{"type": "mesh", "file": "a.stl"}"#, "file_format", "objects[0].shape.file", ".obj, .ply"),
    ("unknown surface", r#"{"type": "implicit", "surface": "tours"}"#, "unknown_name", "objects[0].shape.surface", "did you mean \"torus\"?"),
    ("implicit without surface", r#"{"type": "implicit", "radius": 1}"#, "missing", "objects[0].shape", "missing key `surface`"),
    ("fat torus", r#"{"type": "implicit", "surface": "torus", "major_radius": 1, "minor_radius": 1}"#, "out_of_range", "objects[0].shape.minor_radius", "less than `major_radius`"),
    ("fat gyroid", r#"{"type": "implicit", "surface": "gyroid", "period": 1, "thickness": 0.25, "radius": 1}"#, "out_of_range", "objects[0].shape.thickness", "less than a quarter of `period`, 0.25"),
    ("gyroid of too many periods", r#"{"type": "implicit", "surface": "gyroid", "period": 1, "thickness": 0.1, "radius": 101}"#, "out_of_range", "objects[0].shape.radius", "at most 100 periods, 100, found 101"),
    ("smooth union lengths", r#"{"type": "implicit", "surface": "smooth-union", "centers": [[0,0,0], [1,0,0]], "radii": [1]}"#, "wrong_type", "objects[0].shape.radii", "1 radii for 2 centres"),
    ("prism apex", r#"{"type": "prism", "apex_degrees": 180, "side": 1, "length": 1}"#, "out_of_range", "objects[0].shape.apex_degrees", "(0, 180)"),
    ("brilliant crown", r#"{"type": "brilliant", "radius": 1, "crown_degrees": 90}"#, "out_of_range", "objects[0].shape.crown_degrees", "(0, 90)"),
    ("box without height", r#"{"type": "box", "min": [0, 0, 0], "max": [1, 0, 1]}"#, "degenerate", "objects[0].shape.max[1]", "more than the 0"),
    ("lens of small radius", r#"{"type": "lens", "radii": [0.1, null], "thickness": 0.1, "diameter": 1}"#, "out_of_range", "objects[0].shape.radii[0]", "at least 0.5"),
    ("lens too thin", r#"{"type": "lens", "radii": [0.5, 0.5], "thickness": 0.9, "diameter": 1}"#, "degenerate", "objects[0].shape.thickness", "at least 1"),
    ("lens radius is text", r#"{"type": "lens", "radii": [1, "flat"], "thickness": 0.9, "diameter": 1}"#, "wrong_type", "objects[0].shape.radii[1]", "or null"),
];

/// Scenes that parse, and that compiling must refuse.
#[rustfmt::skip] // one scene a line
const COMPILED: &[Edit] = &[
    ("unknown glass", "\"ior\": 1.5", "\"ior\": {\"glass\": \"N-SF12\"}", "unknown_name", "materials.glass.ior.glass", "N-SF12"),
    ("unknown metal", "\"dielectric\", \"ior\": 1.5", "\"conductor\", \"metal\": \"Unobtainium\"", "unknown_name", "materials.glass.metal", "Unobtainium"),
    ("unknown illuminant", "\"intensity\": 1.0", "\"intensity\": {\"illuminant\": \"D66\"}", "unknown_name", "lights[0].intensity.illuminant", "D66"),
    ("unknown RGB space", "\"intensity\": 1.0", "\"intensity\": {\"rgb\": [1, 1, 1], \"space\": \"srbg\"}", "unknown_name", "lights[0].intensity.space", "srbg"),
    ("spectrum file missing", "\"intensity\": 1.0", "\"intensity\": {\"file\": \"no/such.csv\"}", "file_not_found", "lights[0].intensity.file", "no/such.csv"),
    ("index file missing", "\"ior\": 1.5", "\"ior\": {\"file\": \"no/such.yml\"}", "file_not_found", "materials.glass.ior.file", "no/such.yml"),
    ("index table too short", "\"ior\": 1.5", "\"ior\": {\"wavelengths_nm\": [500, 600], \"values\": [1.5, 1.49]}", "out_of_range", "materials.glass.ior", "500"),
    ("mesh missing", FIRST_SHAPE, "{\"type\": \"mesh\", \"file\": \"no/such.obj\"}", "file_not_found", "objects[0].shape.file", "no/such.obj"),
    ("pole in the visible", "\"ior\": 1.5", "\"ior\": {\"sellmeier\": {\"b\": [1], \"c_um2\": [0.2]}}", "out_of_range", "materials.glass.ior", "a pole at 447.214 nm"),
    ("negative index", "\"ior\": 1.5", "\"ior\": {\"cauchy_um\": [-3]}", "out_of_range", "materials.glass.ior", "the index at 360 nm is -3"),
    ("index beyond belief", "\"ior\": 1.5", "\"ior\": {\"nd\": 1.5, \"vd\": 0.01}", "out_of_range", "materials.glass.ior", "at most 100"),
    ("blackbody too cold", "\"intensity\": 1.0", "\"intensity\": {\"blackbody_kelvin\": 1e-3}", "out_of_range", "lights[0].intensity.blackbody_kelvin", "luminance 0"),
    ("emission outside the locus", "\"intensity\": 1.0", "\"intensity\": {\"rgb\": [0, 0, 1], \"space\": \"rec2020\"}", "out_of_range", "lights[0].intensity.rgb", "less saturated"),
    ("transform underflows", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"scale\": 1e-30}, {\"scale\": 1e-30}, {\"scale\": 1e-30}, {\"scale\": 1e-30}]", "degenerate", "objects[1].transform", "singular"),
    ("transform too uneven", "\"material\": \"glass\"", "\"material\": \"glass\", \"transform\": [{\"scale\": [1e25, 1e-25, 1]}]", "degenerate", "objects[1].transform", "expected below 1e12"),
    ("illuminant as reflectance", "\"reflectance\": \"red_paint\"", "\"reflectance\": {\"illuminant\": \"D65\"}", "out_of_range", "materials.floor.reflectance", "[0, 1]"),
];
