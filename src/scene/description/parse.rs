//! From a scene file to a [`SceneDescription`].

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path as FilePath, PathBuf};

use super::decode_shape::{are_parallel, decode_shape, decode_transform, direction};
use super::decode_spectrum::Spectra;
use super::fields::{Fields, items, named};
use super::json::{self, Json, quote};
use super::path::Path;
use super::tables::*;
use super::types::*;
use super::validate::{check, error, with_nearest};
use crate::{Error, ErrorKind, Result};

/// Most warnings that are kept one by one.
const MAX_WARNINGS: usize = 20;

/// A scene with what deserves a look in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Parsed {
    /// The scene.
    pub description: SceneDescription,
    /// One line each, with file and JSON path.
    pub warnings: Vec<String>,
}

/// Reads a scene file. Errors name the file, the place in it, what was found and what was expected.
pub fn parse_file(path: &FilePath) -> Result<Parsed> {
    let read = || -> Result<Vec<u8>> {
        let not_found = |error: std::io::Error| Error::new(ErrorKind::FileNotFound, format!("cannot open: {error}"));
        let metadata = std::fs::metadata(path).map_err(not_found)?;
        if !metadata.is_file() {
            return Err(Error::new(ErrorKind::FileNotFound, "not a regular file; expected a scene in JSON"));
        }
        json::check_size(metadata.len())?;
        json::read_limited(File::open(path).map_err(not_found)?)
    };
    parse_bytes(&read().map_err(|error| error.in_file(path))?, path)
}

/// Reads a scene from a stream such as stdin; `file` stands for it in messages, its folder is that of relative paths.
pub fn parse_reader(reader: impl Read, file: &FilePath) -> Result<Parsed> {
    parse_bytes(&json::read_limited(reader).map_err(|error| error.in_file(file))?, file)
}

/// Parses a scene; `file` is where the text is from, its folder is that of relative paths.
pub fn parse_str(text: &str, file: &FilePath) -> Result<Parsed> {
    parse_bytes(text.as_bytes(), file)
}

/// Like [`parse_str`], of bytes that need not be UTF-8.
pub fn parse_bytes(bytes: &[u8], file: &FilePath) -> Result<Parsed> {
    let parsed = json::parse(bytes).and_then(|json| decode(&json, file));
    parsed.map_err(|error| error.in_file(file))
}

fn decode(json: &Json, file: &FilePath) -> Result<Parsed> {
    check_version(json)?;
    check(&Kind::Object(&SCENE), json, &Path::Root)?;
    let scene = Fields::new(&SCENE, json, &Path::Root);
    let folder: PathBuf = file.parent().map(FilePath::to_owned).unwrap_or_default();
    let spectra = Spectra::decode(folder.clone(), &scene.value("spectra"), &scene.at("spectra"))?;
    let mut decoder = Decoder { folder, spectra, material_index: HashMap::new(), material_used: Vec::new() };
    let camera = decode_camera(&scene.value("camera"), &scene.at("camera"))?;
    let film = decode_film(&scene.value("film"), &scene.at("film"))?;
    let render = decode_render(&scene.value("render"), &scene.at("render"));
    let develop = decode_develop(&scene.value("develop"), &scene.at("develop"));
    let materials = decoder.materials(&scene.value("materials"), &scene.at("materials"))?;
    let objects = list(&scene, "objects", |json, path| decoder.object(json, path))?;
    let lights = list(&scene, "lights", |json, path| decoder.light(json, path))?;
    let environment = match scene.given("environment") {
        Some(json) => Some(decoder.environment(json, &scene.at("environment"))?),
        None => None,
    };
    let warnings = decoder.warnings(&materials, &objects, file);
    let spectra = decoder.spectra.named;
    let file = file.to_owned();
    let description =
        SceneDescription { file, camera, film, render, spectra, materials, objects, lights, environment, develop };
    Ok(Parsed { description, warnings })
}

/// Decodes each item of a list.
fn list<T>(scene: &Fields, key: &str, mut decode: impl FnMut(&Json, &Path) -> Result<T>) -> Result<Vec<T>> {
    let path = Path::Key(scene.path(), key);
    items(&scene.value(key)).iter().enumerate().map(|(i, json)| decode(json, &Path::Index(&path, i))).collect()
}

/// Scenes of another version are refused before anything else in them is judged.
fn check_version(json: &Json) -> Result<()> {
    match json.get("abbe").map(|version| (version.as_integer(), version)) {
        Some((Some(version), _)) if version != VERSION => {
            let message = format!("this is a scene of version {version}; expected version {VERSION}");
            Err(error(ErrorKind::Version, &Path::Key(&Path::Root, "abbe"), message))
        }
        _ => Ok(()),
    }
}

fn decode_camera(json: &Json, path: &Path) -> Result<CameraDescription> {
    let (_, fields) = Fields::tagged(&CAMERA, json, path)?;
    let (from, to, up): ([f64; 3], [f64; 3], _) = (fields.array("from"), fields.array("to"), direction(&fields, "up")?);
    if from == to {
        return Err(error(ErrorKind::Degenerate, path, "`from` and `to` are the same point; expected two"));
    }
    let view = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    if are_parallel(view, up) {
        return Err(error(ErrorKind::Degenerate, path, "`up` is parallel to the view; expected another direction"));
    }
    let distance = (view[0] * view[0] + view[1] * view[1] + view[2] * view[2]).sqrt();
    Ok(CameraDescription {
        from,
        to,
        up,
        fov_degrees: fields.number("fov_degrees"),
        fov_axis: if fields.text("fov_axis") == "y" { FovAxis::Y } else { FovAxis::X },
        aperture_radius: fields.number("aperture_radius"),
        focus_distance: fields.number_if_given("focus_distance").unwrap_or(distance),
        at: path.to_string(),
    })
}

fn decode_film(json: &Json, path: &Path) -> Result<FilmDescription> {
    let fields = Fields::new(&FILM, json, path);
    let (width, height) = (fields.integer("width") as u32, fields.integer("height") as u32);
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        let message = format!("{width} × {height} pixels; the limit is {MAX_PIXELS} pixels in all");
        return Err(error(ErrorKind::LimitExceeded, path, message));
    }
    let (filter_path, filter_json) = (fields.at("filter"), fields.value("filter"));
    let (name, filter) = Fields::tagged(&FILTER, &filter_json, &filter_path)?;
    let kind = match name {
        "gaussian" => FilterKind::Gaussian,
        "blackman-harris" => FilterKind::BlackmanHarris,
        _ => FilterKind::Box,
    };
    let observer = fields.text("observer");
    Ok(FilmDescription { width, height, filter: kind, filter_radius: filter.number("radius"), observer })
}

fn decode_render(json: &Json, path: &Path) -> RenderDescription {
    let fields = Fields::new(&RENDER, json, path);
    RenderDescription {
        samples_per_pixel: fields.integer("samples_per_pixel") as u64,
        max_depth: fields.integer("max_depth") as u32,
        seed: fields.integer("seed") as u64,
        integrator: match fields.text("integrator").as_str() {
            "path" => Integrator::Path,
            "light" => Integrator::Light,
            "merge" => Integrator::Merge,
            "hero" => Integrator::Hero,
            _ => Integrator::Auto,
        },
    }
}

fn decode_develop(json: &Json, path: &Path) -> DevelopDescription {
    let fields = Fields::new(&DEVELOP, json, path);
    let tonemap = match fields.text("tonemap").as_str() {
        "exponential" => Tonemap::Exponential,
        "reinhard" => Tonemap::Reinhard,
        _ => Tonemap::Srgb,
    };
    DevelopDescription { exposure_ev: fields.value("exposure_ev").as_number(), tonemap }
}

/// What decoding materials, objects and lights needs to know of the rest of the file.
struct Decoder {
    folder: PathBuf,
    spectra: Spectra,
    material_index: HashMap<String, usize>,
    material_used: Vec<bool>,
}

impl Decoder {
    /// The spectrum of a key.
    fn spectrum(&mut self, fields: &Fields, key: &str, role: Role) -> Result<SpectrumDescription> {
        self.spectra.spectrum(role, &fields.value(key), &Path::Key(fields.path(), key))
    }

    /// The spectrum of a key that may be absent.
    fn spectrum_if_given(&mut self, fields: &Fields, key: &str, role: Role) -> Result<Option<SpectrumDescription>> {
        fields.given(key).map(|_| self.spectrum(fields, key, role)).transpose()
    }

    fn materials(&mut self, json: &Json, path: &Path) -> Result<Vec<(String, MaterialDescription)>> {
        let mut materials = Vec::new();
        for (name, value) in named(json) {
            self.material_index.insert(name.clone(), materials.len());
            materials.push((name.clone(), self.material(value, &Path::Key(path, name))?));
        }
        self.material_used = vec![false; materials.len()];
        Ok(materials)
    }

    fn material(&mut self, json: &Json, path: &Path) -> Result<MaterialDescription> {
        let (name, fields) = Fields::tagged(&MATERIAL, json, path)?;
        let kind = match name {
            "diffuse" => {
                MaterialKind::Diffuse { reflectance: self.spectrum(&fields, "reflectance", Role::Reflectance)? }
            }
            "mirror" => MaterialKind::Mirror { reflectance: self.spectrum(&fields, "reflectance", Role::Reflectance)? },
            "conductor" => {
                let index = match fields.text_if_given("metal") {
                    Some(metal) => ConductorDescription::Metal(metal),
                    None => ConductorDescription::EtaK {
                        eta: self.spectrum(&fields, "eta", Role::Index)?,
                        k: self.spectrum(&fields, "k", Role::Index)?,
                    },
                };
                MaterialKind::Conductor { index, roughness: roughness(&fields)? }
            }
            "dielectric" => MaterialKind::Dielectric {
                ior: self.spectra.ior(&fields.value("ior"), &fields.at("ior"))?,
                roughness: roughness(&fields)?,
                absorption_per_m: self.spectrum_if_given(&fields, "absorption_per_m", Role::Absorption)?,
                priority: fields.integer("priority") as i32,
            },
            other => unreachable!("the table has no material {other}"),
        };
        let two_sided = !matches!(kind, MaterialKind::Dielectric { .. }) && fields.flag("two_sided");
        Ok(MaterialDescription { kind, two_sided, at: path.to_string() })
    }

    fn object(&mut self, json: &Json, path: &Path) -> Result<ObjectDescription> {
        let fields = Fields::new(&OBJECT, json, path);
        let material = match fields.text_if_given("material") {
            Some(name) => Some(self.material_named(&name, &fields.at("material"))?),
            None => None,
        };
        Ok(ObjectDescription {
            name: fields.text_if_given("name"),
            shape: decode_shape(&self.folder, &fields.value("shape"), &fields.at("shape"))?,
            transform: decode_transform(&fields.value("transform"), &fields.at("transform"))?,
            material,
            emission: self.spectrum_if_given(&fields, "emission", Role::Emission)?,
            emission_two_sided: fields.flag("emission_two_sided"),
            at: path.to_string(),
        })
    }

    fn material_named(&mut self, name: &str, path: &Path) -> Result<usize> {
        let Some(&index) = self.material_index.get(name) else {
            let message = match self.material_index.is_empty() {
                true => format!("no material named {}; the file has no `materials`", quote(name)),
                false => format!("no material named {}; expected one of `materials`", quote(name)),
            };
            let mut names: Vec<&str> = self.material_index.keys().map(String::as_str).collect();
            names.sort_unstable();
            return Err(with_nearest(error(ErrorKind::UnknownName, path, message), name, names));
        };
        self.material_used[index] = true;
        Ok(index)
    }

    fn light(&mut self, json: &Json, path: &Path) -> Result<LightDescription> {
        let (kind, fields) = Fields::tagged(&LIGHT, json, path)?;
        let kind = match kind {
            "point" => LightKind::Point {
                position: fields.array("position"),
                intensity: self.spectrum(&fields, "intensity", Role::Emission)?,
            },
            "spot" => self.spot(&fields)?,
            "directional" => LightKind::Directional {
                direction: direction(&fields, "direction")?,
                irradiance: self.spectrum(&fields, "irradiance", Role::Emission)?,
                angular_diameter_degrees: fields.number("angular_diameter_degrees"),
            },
            "beam" => LightKind::Beam {
                origin: fields.array("origin"),
                direction: direction(&fields, "direction")?,
                radius: fields.number("radius"),
                power: self.spectrum(&fields, "power", Role::Emission)?,
            },
            other => unreachable!("the table has no light {other}"),
        };
        Ok(LightDescription { kind, name: fields.text_if_given("name"), at: path.to_string() })
    }

    fn spot(&mut self, fields: &Fields) -> Result<LightKind> {
        let (inner_degrees, outer_degrees) = (fields.number("inner_degrees"), fields.number("outer_degrees"));
        if inner_degrees > outer_degrees || outer_degrees == 0.0 {
            let message =
                format!("expected more than 0 and at least `inner_degrees`, {inner_degrees}, found {outer_degrees}");
            return Err(error(ErrorKind::OutOfRange, &fields.at("outer_degrees"), message));
        }
        Ok(LightKind::Spot {
            position: fields.array("position"),
            direction: direction(fields, "direction")?,
            intensity: self.spectrum(fields, "intensity", Role::Emission)?,
            inner_degrees,
            outer_degrees,
        })
    }

    fn environment(&mut self, json: &Json, path: &Path) -> Result<EnvironmentDescription> {
        let fields = Fields::new(&ENVIRONMENT, json, path);
        Ok(EnvironmentDescription {
            radiance: self.spectrum(&fields, "radiance", Role::Emission)?,
            at: path.to_string(),
        })
    }

    /// Everything that deserves a look, with the file's name in front.
    fn warnings(
        &self,
        materials: &[(String, MaterialDescription)],
        objects: &[ObjectDescription],
        file: &FilePath,
    ) -> Vec<String> {
        let mut warnings = self.spectra.warnings.clone();
        let unused = materials.iter().zip(&self.material_used).filter(|(_, used)| !**used);
        warnings.extend(unused.map(|((_, material), _)| format!("{}: no object has this material", material.at)));
        let place = |name: &str| Path::Key(&Path::Key(&Path::Root, "spectra"), name).to_string();
        warnings.extend(self.spectra.unused().map(|name| format!("{}: nothing uses this spectrum", place(name))));
        let dark = objects.iter().filter(|object| object.emission_two_sided && object.emission.is_none());
        warnings.extend(dark.map(|object| format!("{}: `emission_two_sided` without `emission`", object.at)));
        let more = warnings.len().saturating_sub(MAX_WARNINGS);
        warnings.truncate(MAX_WARNINGS);
        if more > 0 {
            warnings.push(format!("and {more} more warnings"));
        }
        warnings.iter().map(|warning| format!("{}: {warning}", file.display())).collect()
    }
}

/// GGX α. Shapes have no directions along them so far, which [αx, αy] would refer to.
fn roughness(fields: &Fields) -> Result<f64> {
    let value = fields.value("roughness");
    if let Some(alpha) = value.as_number() {
        return Ok(alpha);
    }
    let [x, y]: [f64; 2] = fields.array("roughness");
    if x == y {
        return Ok(x);
    }
    let message = format!(
        "anisotropic roughness [{x}, {y}] is not supported yet, as surfaces have no directions to which it could refer; \
         expected one number, or two equal ones"
    );
    Err(error(ErrorKind::Unsupported, &fields.at("roughness"), message))
}
