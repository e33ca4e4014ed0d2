//! A scene with every mechanism, as JSON that tests take apart: every shape, material, light and way to write a
//! spectrum, a thin lens, light paths and camera paths.

use std::path::{Path, PathBuf};

use abbe::film::Film;
use abbe::render::{Progress, Statistics, render};
use abbe::scene::description::parse_str;
use abbe::scene::{Compiled, SceneFeatures, compile};
use serde_json::{Value, json};

/// No mechanism beyond those that the scene needs.
pub const NEEDED: SceneFeatures = SceneFeatures { dispersion: false, interiors: false };

/// A folder in which [`everything`] finds its mesh; removed at the end.
pub struct SceneFolder(PathBuf);

impl SceneFolder {
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("abbe-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let mesh = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
        std::fs::write(folder.join("tetrahedron.obj"), mesh).unwrap();
        Self(folder)
    }

    pub fn compile(&self, scene: &Value) -> Compiled {
        let parsed = parse_str(&scene.to_string(), &self.0.join("scene.json")).unwrap_or_else(|e| panic!("{e}"));
        compile(&parsed.description).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Renders a scene with what it needs.
    pub fn film(&self, scene: &Value) -> Film {
        render_all(&self.compile(scene), NEEDED).0
    }

    #[allow(dead_code, reason = "not every test that uses this module writes files")]
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for SceneFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub fn render_all(compiled: &Compiled, features: SceneFeatures) -> (Film, Statistics) {
    let proceed = &mut |_: Progress| true;
    let rendering = render(&compiled.scene, &compiled.render, &compiled.film, features, proceed);
    (rendering.film, rendering.statistics)
}

pub fn everything() -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0.3, 1.9, 5.2], "to": [0, 0.5, 0], "fov_degrees": 42,
                    "aperture_radius": 0.03, "focus_distance": 5.1 },
        "film": { "width": 40, "height": 28, "filter": { "type": "blackman-harris" } },
        "render": { "samples_per_pixel": 6, "max_depth": 24, "seed": 7 },
        "spectra": {
            "paint": { "wavelengths_nm": [380, 500, 600, 780], "values": [0.2, 0.7, 0.5, 0.8] },
            "dark": { "name": "paint", "scale": 0.5 }
        },
        "materials": materials(),
        "objects": objects(),
        "lights": [
            { "type": "point", "position": [-2.5, 3, 1], "intensity": { "blackbody_kelvin": 4000, "scale": 0.7 } },
            { "type": "spot", "position": [2.5, 3, 2], "direction": [-1, -1.2, -0.8], "intensity": { "rgb": [3, 2, 1] },
              "inner_degrees": 12, "outer_degrees": 25 },
            { "type": "directional", "direction": [0.3, -1, -0.4], "irradiance": { "illuminant": "D65", "scale": 0.3 } },
            { "type": "directional", "direction": [-0.5, -1, 0.2], "irradiance": 0.2, "angular_diameter_degrees": 3 },
            { "type": "beam", "origin": [-3, 0.45, 0.2], "direction": [1, 0, 0], "radius": 0.05,
              "power": { "line_nm": 589.3, "fwhm_nm": 4, "scale": 0.05 } }
        ],
        "environment": { "radiance": { "illuminant": "D65", "scale": 0.05 } }
    })
}

fn materials() -> Value {
    json!({
        "floor": { "type": "diffuse", "reflectance": "paint" },
        "clay": { "type": "diffuse", "reflectance": { "rgb": [0.7, 0.4, 0.3] }, "two_sided": false },
        "mirror": { "type": "mirror", "reflectance": "dark" },
        "gold": { "type": "conductor", "metal": "Au" },
        "steel": { "type": "conductor", "eta": 2.5, "k": { "wavelengths_nm": [400, 700], "values": [2.5, 3.5] },
                   "roughness": 0.2 },
        "flint": { "type": "dielectric", "ior": { "glass": "N-SF11" }, "absorption_per_m": { "name": "paint", "scale": 0.9 } },
        "water": { "type": "dielectric", "ior": { "cauchy_um": [1.32, 0.003] }, "priority": 1, "absorption_per_m": 0.3 },
        "crown": { "type": "dielectric", "ior": { "sellmeier": { "b": [1.03961212, 0.231792344, 1.01046945],
                   "c_um2": [0.00600069867, 0.0200179144, 103.560653] } }, "roughness": 0.05 },
        "plastic": { "type": "dielectric", "ior": { "nd": 1.49, "vd": 57 } },
        "table": { "type": "dielectric", "ior": { "wavelengths_nm": [350, 850], "values": [1.53, 1.51] } },
        "plain": { "type": "dielectric", "ior": 1.5, "roughness": 0.15 }
    })
}

fn objects() -> Value {
    let at = |x: f64, z: f64| json!([{ "rotate_degrees": 30, "axis": [1, 2, 0] }, { "translate": [x, 0.45, z] }]);
    json!([
        { "shape": { "type": "quad", "origin": [-4, 0, 4], "u": [8, 0, 0], "v": [0, 0, -8] }, "material": "floor" },
        { "shape": { "type": "sphere", "center": [0, 0.5, 0.4], "radius": 0.4 }, "material": "flint" },
        { "shape": { "type": "sphere", "center": [0.1, 0.5, 0.4], "radius": 0.15 }, "material": "water" },
        { "shape": { "type": "sphere", "center": [0, 0.3, 0], "radius": 0.25 }, "material": "clay",
          "transform": [{ "scale": [1, 1.3, 0.8] }, { "translate": [1, 0, 1] }] },
        { "shape": { "type": "disk", "center": [0, 1, -2], "normal": [0.2, 0.1, 1], "radius": 0.9 }, "material": "mirror" },
        { "shape": { "type": "triangles", "positions": [-0.3, 0, 0.3, 0.3, 0, 0.3, 0, 0.6, 0, 0, 0, -0.3],
                     "indices": [0, 1, 2, 1, 3, 2, 3, 0, 2], "normals": [-1, 0.3, 1, 1, 0.3, 1, 0, 1, 0, 0, 0.3, -1] },
          "material": "clay", "transform": [{ "translate": [-1, 0, 1.4] }] },
        { "shape": { "type": "mesh", "file": "tetrahedron.obj" }, "material": "gold",
          "transform": [{ "scale": 0.25 }, { "rotate_degrees": 20, "axis": [0, 1, 0] }, { "translate": [1.7, 0.4, 0.4] }] },
        { "shape": { "type": "implicit", "surface": "torus", "major_radius": 0.25, "minor_radius": 0.1 },
          "material": "plain", "transform": at(-1.0, 0.2) },
        { "shape": { "type": "implicit", "surface": "superquadric", "radii": [0.3, 0.25, 0.3], "exponent_y": 0.5, "exponent_xz": 1.4 },
          "material": "table", "transform": at(1.0, -0.2) },
        { "shape": { "type": "implicit", "surface": "gyroid", "period": 0.4, "thickness": 0.06, "radius": 0.35 },
          "material": "clay", "transform": at(-1.9, -0.2) },
        { "shape": { "type": "implicit", "surface": "smooth-union", "centers": [[0, 0, 0], [0.3, 0, 0]], "radii": [0.25, 0.2], "blend": 0.1 },
          "material": "plastic", "transform": at(-0.5, -0.9) },
        { "shape": { "type": "implicit", "surface": "tanglecube", "size": 0.12 }, "material": "steel", "transform": at(0.5, -0.9) },
        { "shape": { "type": "prism", "apex_degrees": 60, "side": 0.6, "length": 0.8 }, "material": "crown",
          "transform": [{ "matrix": [1, 0, 0, -1.8, 0, 0, -1, 0.4, 0, 1, 0, 0.8, 0, 0, 0, 1] }] },
        { "shape": { "type": "brilliant", "radius": 0.3 }, "material": "flint",
          "transform": [{ "scale": [1, 1, -1] }, { "translate": [0.6, 0.4, 1.6] }] },
        { "shape": { "type": "lens", "radii": [0.5, null], "thickness": 0.1, "diameter": 0.5 }, "material": "crown",
          "transform": [{ "translate": [-0.35, 0.4, 1.6] }] },
        { "shape": { "type": "sphere", "center": [0.4, 2.6, 0.3], "radius": 0.06 },
          "emission": { "blackbody_kelvin": 3000, "scale": 60 } },
        { "shape": { "type": "disk", "center": [-1.5, 2.4, 0], "normal": [0.3, -1, 0], "radius": 0.2 },
          "emission": { "illuminant": "A", "scale": 3 }, "emission_two_sided": true },
        { "shape": { "type": "quad", "origin": [1.2, 2.4, -0.6], "u": [0.5, 0, 0], "v": [0, 0, 0.4] }, "material": "clay",
          "emission": { "rgb": [2, 3, 4] } },
        { "shape": { "type": "triangles", "positions": [-3, 0.2, -1, -3, 1, -1, -2.8, 0.2, 0.5], "indices": [0, 2, 1] },
          "material": "clay", "emission": "paint" },
        { "shape": { "type": "implicit", "surface": "torus", "major_radius": 0.2, "minor_radius": 0.05 },
          "emission": 1.5, "transform": [{ "translate": [2.4, 0.3, 1.4] }] },
        { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 0.2 },
          "emission": 1, "transform": [{ "scale": [1, 0.5, 1] }, { "translate": [0, 1.3, -0.8] }] }
    ])
}

/// Multiplies a number, a list of numbers (null stays), or a spectrum.
pub fn multiply(value: &mut Value, factor: f64) {
    match value {
        Value::Number(number) => *value = json!(number.as_f64().unwrap() * factor),
        Value::Array(items) => items.iter_mut().for_each(|item| multiply(item, factor)),
        Value::String(name) => *value = json!({ "name": name, "scale": factor }),
        Value::Object(spectrum) => {
            let scale = spectrum.get("scale").map_or(1.0, |scale| scale.as_f64().unwrap());
            spectrum.insert("scale".to_owned(), json!(scale * factor));
        }
        Value::Null => {}
        Value::Bool(_) => panic!("{value} has no size"),
    }
}

/// Multiplies the values of some keys, where they are.
pub fn multiply_keys(object: &mut Value, keys: &[&str], factor: f64) {
    for key in keys {
        if let Some(value) = object.get_mut(key) {
            multiply(value, factor);
        }
    }
}

/// The elements of a list in a scene; none if it is absent.
pub fn elements<'a>(scene: &'a mut Value, key: &str) -> impl Iterator<Item = &'a mut Value> {
    scene.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten()
}

/// The materials of a scene.
pub fn materials_of(scene: &mut Value) -> impl Iterator<Item = &mut Value> {
    scene["materials"].as_object_mut().unwrap().values_mut()
}

/// Multiplies every light's power, leaving the lengths alone.
pub fn multiply_light(scene: &mut Value, factor: f64) {
    elements(scene, "objects").for_each(|object| multiply_keys(object, &["emission"], factor));
    elements(scene, "lights").for_each(|light| multiply_keys(light, &["intensity", "irradiance", "power"], factor));
    if let Some(environment) = scene.get_mut("environment") {
        multiply_keys(environment, &["radiance"], factor);
    }
}

/// Multiplies every length of a scene, keeping its look: intensities and powers grow with areas, and absorption falls.
pub fn multiply_lengths(scene: &mut Value, factor: f64) {
    multiply_keys(&mut scene["camera"], &["from", "to", "aperture_radius", "focus_distance"], factor);
    for object in elements(scene, "objects") {
        multiply_shape(object, factor);
        for step in elements(object, "transform") {
            multiply_keys(step, &["translate"], factor);
            if let Some(matrix) = step.get_mut("matrix") {
                [3, 7, 11].into_iter().for_each(|i| multiply(&mut matrix[i], factor));
            }
        }
    }
    for light in elements(scene, "lights") {
        multiply_keys(light, &["position", "origin", "radius"], factor);
        multiply_keys(light, &["intensity", "power"], factor * factor);
    }
    for material in materials_of(scene) {
        multiply_keys(material, &["absorption_per_m"], 1.0 / factor);
    }
}

/// Multiplies the lengths of a shape; a mesh in a file by a first step of the transform.
fn multiply_shape(object: &mut Value, factor: f64) {
    let shape = &mut object["shape"];
    let name = shape.get("surface").unwrap_or(&shape["type"]).as_str().unwrap().to_owned();
    let keys: &[&str] = match name.as_str() {
        "sphere" => &["center", "radius"],
        "quad" => &["origin", "u", "v"],
        "disk" => &["center", "radius"],
        "box" => &["min", "max"],
        "cylinder" => &["radius", "height"],
        "triangles" => &["positions"],
        "torus" => &["major_radius", "minor_radius"],
        "superquadric" => &["radii"],
        "gyroid" => &["period", "thickness", "radius"],
        "smooth-union" => &["centers", "radii", "blend"],
        "tanglecube" => &["size"],
        "prism" => &["side", "length"],
        "brilliant" => &["radius"],
        "lens" => &["radii", "thickness", "diameter"],
        "mesh" => {
            let steps = object["transform"].as_array_mut().unwrap();
            return steps.insert(0, json!({ "scale": factor }));
        }
        other => panic!("the lengths of a {other} are not known here"),
    };
    multiply_keys(shape, keys, factor);
}

/// What a render has counted, without the times.
#[allow(dead_code, reason = "not every test that uses this module compares it")]
pub fn counted(statistics: &Statistics) -> impl PartialEq + std::fmt::Debug + use<> {
    let Statistics { samples, camera_paths, light_paths, photon_paths, decisions, counters, error_bound, complete } =
        *statistics;
    let rays = [counters.rays, counters.shadow_rays, counters.shared_segments, counters.medium_underflows];
    (samples, camera_paths, light_paths, photon_paths, decisions, rays, error_bound, complete)
}
