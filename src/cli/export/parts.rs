//! A scene in the terms that renderers share: world space in metres, spectra as tables.

use crate::geometry::Mesh;
use crate::scene::description::{
    CameraDescription, FilmDescription, LightKind, MaterialKind, ObjectDescription, SceneDescription, ShapeDescription,
    TransformStep,
};
use crate::scene::{
    Compiled, ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, MirrorMaterial, Parameter, Scene,
    world_mesh,
};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, SpectrumTable};
use crate::{Error, ErrorKind, Result, math};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, Vec3};

/// Everything to be written.
pub struct Parts {
    /// Names the scene in a comment.
    pub title: String,
    /// The camera, in metres.
    pub camera: CameraDescription,
    /// Picture size and filter.
    pub film: FilmDescription,
    /// Samples per pixel that the scene asks for.
    pub samples_per_pixel: u64,
    /// Largest number of scattering events.
    pub max_depth: u32,
    /// Shapes.
    pub objects: Vec<Object>,
    /// Lights without a shape, with their places in the scene.
    pub lights: Vec<(LightKind, Table, String)>,
    /// Radiance from infinity.
    pub environment: Option<Table>,
    /// PLY files by name.
    pub meshes: Vec<(String, Vec<u8>)>,
}

/// A shape with its surface.
pub struct Object {
    /// Shape of the object.
    pub shape: Shape,
    /// How it scatters.
    pub surface: Surface,
    /// Whether both sides scatter alike.
    pub two_sided: bool,
    /// Emitted radiance, and whether by both sides.
    pub emission: Option<(Table, bool)>,
    /// JSON path of the object in the scene.
    pub at: String,
}

/// Geometry.
pub enum Shape {
    /// A sphere.
    Sphere {
        /// Centre.
        center: DVec3,
        /// Radius.
        radius: f64,
    },
    /// The image of the unit disc with normal +z.
    Disk(DAffine3),
    /// A file of triangles.
    Ply {
        /// Its name.
        file: String,
        /// Whether it has vertex normals.
        smooth: bool,
    },
}

/// Surfaces.
pub enum Surface {
    /// Lambertian.
    Diffuse(Table),
    /// Perfect mirror.
    Mirror(Table),
    /// Metal: real and imaginary part of the index, GGX α (0 is smooth).
    Conductor(Table, Table, f32),
    /// Boundary of a transparent volume in air: its index, GGX α (0 is smooth).
    Dielectric(Table, f32),
}

/// A spectrum: a constant, or values at wavelengths in nm.
#[derive(Debug, Clone, PartialEq)]
pub enum Table {
    /// Makes a table with the same value at every wavelength.
    Constant(f64),
    /// Linear between knots over the whole range.
    Sampled(Vec<(f64, f64)>),
}

impl Table {
    /// From a function of wavelength: at every nm, or closer where that would lose a line.
    pub fn new(value: impl Fn(f64) -> f64) -> Self {
        let coarse = Self::at_steps(&value, 1);
        let fine = Self::at_steps(&value, 20);
        if fine.iter().all(|knot| knot.1 == fine[0].1) {
            return Self::Constant(fine[0].1);
        }
        let [a, b] = [&coarse, &fine].map(|knots| area(knots));
        let same = (a - b).abs() <= 1e-4 * b.abs();
        Self::Sampled(if same { coarse } else { fine })
    }

    fn at_steps(value: &impl Fn(f64) -> f64, per_nm: u32) -> Vec<(f64, f64)> {
        let count = (LAMBDA_MAX_NM - LAMBDA_MIN_NM) as u32 * per_nm;
        let knot = |i: u32| LAMBDA_MIN_NM + f64::from(i) / f64::from(per_nm);
        (0..=count).map(|i| (knot(i), value(knot(i)))).collect()
    }

    fn of(table: &SpectrumTable, factor: f64) -> Self {
        Self::new(|nm| f64::from(table.eval(nm as f32)) * factor)
    }

    /// Integral over the range, weighted by a function of wavelength.
    pub fn integral(&self, weight: impl Fn(f64) -> f64) -> f64 {
        let at = |(nm, value): &(f64, f64)| (*nm, value * weight(*nm));
        match self {
            Self::Constant(value) => area(&Self::at_steps(&|nm| value * weight(nm), 1)),
            Self::Sampled(knots) => area(&knots.iter().map(at).collect::<Vec<_>>()),
        }
    }
}

fn area(knots: &[(f64, f64)]) -> f64 {
    knots.windows(2).map(|w| 0.5 * (w[1].0 - w[0].0) * (w[0].1 + w[1].1)).sum()
}

impl Parts {
    /// Collects the parts of a scene from its description and from the compiled scene. Indices that depend on the
    /// wavelength are taken at `at_nm`, or kept.
    pub fn new(description: &SceneDescription, compiled: &Compiled, stem: &str, at_nm: Option<f64>) -> Result<Self> {
        let scene = &compiled.scene;
        let mut meshes = Vec::new();
        let mut objects = Vec::new();
        for (index, object) in description.objects.iter().enumerate() {
            objects.push(self::object(description, scene, index, object, (stem, at_nm), &mut meshes)?);
        }
        refuse_overlaps(scene, description)?;
        // Compiled lights that have no object come in the order of the description; black ones are left out.
        let mut shapeless =
            scene.lights.iter().filter(|light| !matches!(light.kind, crate::scene::LightKind::Area { .. }));
        let per_area = scene.meters_per_unit * scene.meters_per_unit;
        let mut lights = Vec::new();
        for light in &description.lights {
            let factor = match light.kind {
                LightKind::Directional { .. } => scene.radiance_scale,
                _ => scene.radiance_scale * per_area,
            };
            let Some(found) = shapeless.next() else { break };
            lights.push((light.kind.clone(), Table::of(scene.spectrum(found.spectrum), factor), light.at.clone()));
        }
        let environment = description.environment.as_ref().and_then(|_| shapeless.next());
        if lights.len() + usize::from(environment.is_some())
            < description.lights.len() + usize::from(description.environment.is_some())
        {
            let message = "a light that is black at every wavelength; expected it to be left out";
            return Err(Error::new(ErrorKind::Unsupported, message).at("lights"));
        }
        Ok(Self {
            title: description.file.display().to_string(),
            camera: description.camera.clone(),
            film: description.film.clone(),
            samples_per_pixel: compiled.render.samples_per_pixel,
            max_depth: compiled.render.max_depth,
            objects,
            lights,
            environment: environment.map(|light| Table::of(scene.spectrum(light.spectrum), scene.radiance_scale)),
            meshes,
        })
    }
}

/// Nested and touching volumes mean something else in every renderer.
fn refuse_overlaps(scene: &Scene, description: &SceneDescription) -> Result<()> {
    let solids: Vec<usize> =
        (0..scene.objects.len()).filter(|&i| scene.objects[i].material.medium().is_some()).collect();
    for (k, &i) in solids.iter().enumerate() {
        for &j in &solids[k + 1..] {
            let (a, b) = (scene.objects[i].bounds, scene.objects[j].bounds);
            if a.min.cmple(b.max).all() && b.min.cmple(a.max).all() {
                let message =
                    "transparent objects that overlap or touch cannot be written: other renderers read them otherwise";
                return Err(Error::new(ErrorKind::Unsupported, message).at(description.objects[j].at.clone()));
            }
        }
    }
    Ok(())
}

fn object(
    description: &SceneDescription,
    scene: &Scene,
    index: usize,
    object: &ObjectDescription,
    (stem, at_nm): (&str, Option<f64>),
    meshes: &mut Vec<(String, Vec<u8>)>,
) -> Result<Object> {
    let compiled = &scene.objects[index];
    let material = object.material.map(|i| &description.materials[i].1);
    let shape = shape(scene, index, object, stem, meshes)?;
    let emission = compiled.light.map(|light| {
        let table = Table::of(scene.spectrum(scene.light(light).spectrum), scene.radiance_scale);
        (table, object.emission_two_sided)
    });
    Ok(Object {
        shape,
        surface: surface(scene, compiled.material, at_nm, material.map_or("", |m| &m.at))?,
        two_sided: material.is_none_or(|m| m.two_sided || matches!(m.kind, MaterialKind::Dielectric { .. })),
        emission,
        at: object.at.clone(),
    })
}

fn surface(scene: &Scene, material: Material, at_nm: Option<f64>, place: &str) -> Result<Surface> {
    let table = |parameter: Parameter| match parameter {
        Parameter::Spectrum(id) => Table::of(scene.spectrum(id), 1.0),
    };
    Ok(match material {
        Material::Black(_) => Surface::Diffuse(Table::Constant(0.0)),
        Material::Diffuse(DiffuseMaterial { reflectance }) => Surface::Diffuse(table(reflectance)),
        Material::Mirror(MirrorMaterial { reflectance }) => Surface::Mirror(table(reflectance)),
        Material::Conductor(ConductorMaterial { eta, k, alpha }) => Surface::Conductor(table(eta), table(k), alpha),
        Material::Dielectric(DielectricMaterial { medium, alpha }) => {
            let medium = scene.medium(medium);
            if medium.absorption.is_some() {
                let message =
                    "absorption inside a volume cannot be written: other renderers have it in media of their own";
                return Err(Error::new(ErrorKind::Unsupported, message).at(place));
            }
            let index = match at_nm {
                Some(nm) => Table::Constant(medium.ior.eval(nm)),
                None => Table::new(|nm| medium.ior.eval(nm)),
            };
            Surface::Dielectric(index, alpha)
        }
    })
}

fn shape(
    scene: &Scene,
    index: usize,
    object: &ObjectDescription,
    stem: &str,
    meshes: &mut Vec<(String, Vec<u8>)>,
) -> Result<Shape> {
    let world_from_object = transform(&object.transform);
    let refused = |what: &str| {
        let message =
            format!("{what} cannot be written for other renderers; expected spheres, disks, quads or triangles");
        Err(Error::new(ErrorKind::Unsupported, message).at(format!("{}.shape", object.at)))
    };
    match &object.shape {
        ShapeDescription::Sphere { center, radius } => {
            let m = world_from_object.matrix3;
            let scale = m.x_axis.length();
            let similar = (m.transpose() * m - DMat3::from_diagonal(DVec3::splat(scale * scale)))
                .to_cols_array()
                .iter()
                .all(|v| v.abs() <= 1e-12 * scale * scale);
            if !similar {
                return refused("an ellipsoid");
            }
            Ok(Shape::Sphere {
                center: world_from_object.transform_point3(DVec3::from(*center)),
                radius: radius * scale,
            })
        }
        ShapeDescription::Disk { center, normal, radius } => {
            let turn = DQuat::from_rotation_arc(DVec3::Z, DVec3::from(*normal).normalize());
            let unit = DAffine3::from_scale_rotation_translation(DVec3::splat(*radius), turn, DVec3::from(*center));
            Ok(Shape::Disk(world_from_object * unit))
        }
        ShapeDescription::Implicit(_) => refused("an implicit surface"),
        ShapeDescription::Lens { .. } => refused("a lens"),
        _ => {
            let Some(mesh) = world_mesh(object)? else { return refused("a shape without triangles") };
            let file = format!("{stem}-{index}.ply");
            let (bytes, smooth) = ply(&mesh, scene.objects[index].material.uses_shading_normals());
            meshes.push((file.clone(), bytes));
            Ok(Shape::Ply { file, smooth })
        }
    }
}

/// The transform of an object, its steps in order.
fn transform(steps: &[TransformStep]) -> DAffine3 {
    steps.iter().fold(DAffine3::IDENTITY, |before, step| {
        let step = match step {
            TransformStep::Translate(shift) => DAffine3::from_translation(DVec3::from(*shift)),
            TransformStep::Rotate { degrees, axis } => {
                let half = 0.5 * degrees.to_radians();
                let v = DVec3::from(*axis).normalize() * math::sin(half);
                DAffine3::from_quat(DQuat::from_xyzw(v.x, v.y, v.z, math::cos(half)))
            }
            TransformStep::Scale(factors) => DAffine3::from_scale(DVec3::from(*factors)),
            TransformStep::Matrix(rows) => DAffine3::from_mat4(DMat4::from_cols_array(rows).transpose()),
        };
        step * before
    })
}

/// Triangles in metres as binary PLY; and whether with vertex normals, which diffuse surfaces alone are rendered with.
fn ply(mesh: &Mesh, diffuse: bool) -> (Vec<u8>, bool) {
    let Mesh { positions, indices, normals, .. } = mesh;
    let normals: Vec<Vec3> = normals.iter().map(|n| n.normalize_or_zero().as_vec3()).collect();
    let smooth = diffuse && normals.len() == positions.len() && normals.iter().all(|n| *n != Vec3::ZERO);
    let normal_lines = if smooth { "property float nx\nproperty float ny\nproperty float nz\n" } else { "" };
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         {normal_lines}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        indices.len()
    )
    .into_bytes();
    for (i, position) in positions.iter().enumerate() {
        let values = position
            .as_vec3()
            .to_array()
            .into_iter()
            .chain(smooth.then(|| normals[i].to_array()).into_iter().flatten());
        values.for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    for triangle in indices {
        bytes.push(3);
        triangle.iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    }
    (bytes, smooth)
}
