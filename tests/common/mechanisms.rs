//! A scene with every mechanism, as JSON that tests take apart: every shape, material, light and way to write a
//! spectrum, a thin lens, light paths and camera paths.

use std::path::{Path, PathBuf};

use abbe::film::Film;
use abbe::render::{Progress, Statistics, render, render_with_everything};
use abbe::scene::description::parse_str;
use abbe::scene::{Compiled, compile};
use serde_json::{Value, json};

/// A folder in which [`everything`] finds its mesh; removed at the end.
pub struct SceneFolder(PathBuf);

impl SceneFolder {
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("abbe-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("tetrahedron.obj"), include_str!("../assets/tetrahedron.obj")).unwrap();
        Self(folder)
    }

    pub fn compile(&self, scene: &Value) -> Compiled {
        let parsed = parse_str(&scene.to_string(), &self.0.join("scene.json")).unwrap_or_else(|e| panic!("{e}"));
        compile(&parsed.description).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Renders a scene with what it needs.
    pub fn film(&self, scene: &Value) -> Film {
        render_all(&self.compile(scene)).0
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

/// Renders with the mechanisms that the scene needs.
pub fn render_all(compiled: &Compiled) -> (Film, Statistics) {
    let proceed = &mut |_: Progress| true;
    let rendering = render(&compiled.scene, &compiled.render, &compiled.film, proceed);
    (rendering.film, rendering.statistics)
}

/// Renders with all mechanisms, needed or not.
#[allow(dead_code, reason = "not every test that uses this module forces mechanisms")]
pub fn render_forced(compiled: &Compiled) -> (Film, Statistics) {
    let proceed = &mut |_: Progress| true;
    let rendering = render_with_everything(&compiled.scene, &compiled.render, &compiled.film, proceed);
    (rendering.film, rendering.statistics)
}

/// The scene, `tests/assets/everything.json`.
pub fn everything() -> Value {
    serde_json::from_str(include_str!("../assets/everything.json")).unwrap()
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
