//! The whole file.

use std::path::PathBuf;

use super::JsonPath;
use super::camera::{CAMERA, CameraDescription};
use super::codec::{Bool, Checked, Codec, Integer, Kind, List, Map, Name, Object, Record, Text, Value};
use super::context::Names;
use super::film::{FILM, FilmDescription};
use super::lights::{ENVIRONMENT, EnvironmentDescription, LIGHT, LightDescription};
use super::materials::{MaterialDescription, NAMED_MATERIALS};
use super::named_spectra::resolve;
use super::settings::{DEVELOP, DevelopDescription, RENDER, RenderDescription};
use super::shapes::{SHAPE, ShapeDescription};
use super::spectrum::{EMISSION, Role, Spectrum, SpectrumDescription};
use super::transform::{TRANSFORM, TransformStep};
use crate::Result;

/// The version of the format that this program reads.
pub const VERSION: i64 = 1;

/// Most objects, and most lights.
const MAX_OBJECTS: usize = 10_000_000;

/// A whole scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDescription {
    /// The file it was read from; relative paths inside are relative to its folder.
    pub file: PathBuf,
    /// The camera.
    pub camera: CameraDescription,
    /// Picture size and reconstruction filter.
    pub film: FilmDescription,
    /// Sampling and integrator.
    pub render: RenderDescription,
    /// Named spectra, in file order.
    pub spectra: Vec<(String, SpectrumDescription)>,
    /// Named materials, in file order.
    pub materials: Vec<(String, MaterialDescription)>,
    /// Shapes with their materials.
    pub objects: Vec<ObjectDescription>,
    /// Lights without a shape of their own.
    pub lights: Vec<LightDescription>,
    /// Radiance from infinitely far away.
    pub environment: Option<EnvironmentDescription>,
    /// How the film becomes a picture.
    pub develop: DevelopDescription,
}

/// A shape in the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectDescription {
    /// Name for messages.
    pub name: Option<String>,
    /// The shape in its own coordinates.
    pub shape: ShapeDescription,
    /// Applied in order.
    pub transform: Vec<TransformStep>,
    /// Index into `SceneDescription::materials`; without one the surface is black.
    pub material: Option<usize>,
    /// Emitted radiance.
    pub emission: Option<SpectrumDescription>,
    /// Whether the back side emits as well.
    pub emission_two_sided: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The whole file; the path to it is filled in by whoever reads it.
pub const SCENE: Record<SceneDescription> =
    Record { what: "a scene", doc: "A scene for abbe, version 1.", read: scene };

const OBJECT: Record<ObjectDescription> = Record { what: "an object", doc: "A shape with its material.", read: object };

/// Spectra by name. Spectra may refer to each other, so they are looked at together once all are read.
const SPECTRA: Checked<Map<Spectrum>> = Checked {
    codec: Map { what: "a spectrum", item: Spectrum(Role::Named) },
    check: |value, named| resolve(value, named),
};

/// Materials by name.
const MATERIALS: Checked<Map<Record<MaterialDescription>>> = Checked {
    codec: NAMED_MATERIALS,
    check: |value, named| {
        *value.context.materials.borrow_mut() = Names::new(named.iter().map(|(name, _)| name.clone()));
        Ok(())
    },
};

#[rustfmt::skip] // one key a line
fn scene(o: &mut Object) -> Result<SceneDescription> {
    o.optional("$schema", Text, "Where the JSON Schema of this format is, for editors.")?;
    o.default("abbe", Integer { min: VERSION, max: VERSION }, "1", "Version of the format: 1.")?;
    // Names are read before what refers to them.
    let scene = SceneDescription {
        file: PathBuf::new(),
        camera: o.required("camera", CAMERA, "The camera.")?,
        film: o.required("film", FILM, "Picture size and reconstruction filter.")?,
        render: o.default("render", RENDER, "{}", "Sampling and integrator.")?,
        spectra: o.default("spectra", SPECTRA, "{}", "Spectra by name.")?,
        materials: o.default("materials", MATERIALS, "{}", "Materials by name.")?,
        objects: o.default("objects", list("an object", OBJECT), "[]", "Shapes with their materials.")?,
        lights: o.default("lights", list("a light", LIGHT), "[]", "Lights without a shape; a lamp with one is an object with `emission`.")?,
        environment: o.optional("environment", ENVIRONMENT, "Light from infinitely far away; none by default.")?,
        develop: o.default("develop", DEVELOP, "{}", "How the film becomes a PNG; no effect on EXR.")?,
    };
    o.name()?;
    Ok(scene)
}

const fn list<T>(what: &'static str, item: Record<T>) -> List<Record<T>> {
    List { what, item, min: 0, max: MAX_OBJECTS }
}

#[rustfmt::skip] // one key a line
fn object(o: &mut Object) -> Result<ObjectDescription> {
    let shape = o.required("shape", SHAPE, "The shape in its own coordinates.")?;
    let material = o.optional("material", MaterialName, "The name of one of `materials`; black if only `emission` is given.")?;
    let emission = o.optional("emission", EMISSION, "Emitted radiance, W·m⁻²·sr⁻¹·nm⁻¹.")?;
    let emission_two_sided = o.default("emission_two_sided", Bool, "false", "Whether the back side emits as well.")?;
    let transform = o.default("transform", TRANSFORM, "[]", "Steps from the shape's coordinates to the scene's, applied in order.")?;
    o.any_of(&[&["material"], &["emission"]]);
    Ok(ObjectDescription { name: o.name()?, shape, transform, material, emission, emission_two_sided, at: o.at() })
}

/// The name of a material, read as its index.
struct MaterialName;

impl Codec for MaterialName {
    type Value = usize;

    fn kind(&self) -> Kind {
        Name("one of `materials`").kind()
    }

    fn read(&self, value: &Value) -> Result<usize> {
        let name = Name("one of `materials`").read(value)?;
        value.context.materials.borrow_mut().find(&name, "material", "materials", &value.path.to_string())
    }

    fn placeholder(&self) -> usize {
        0
    }
}
