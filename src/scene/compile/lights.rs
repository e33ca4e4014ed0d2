//! Lights, and what is drawn from them: which light, and which wavelengths.

use super::geometry::{Geometry, Source};
use super::normalize::{Normalization, power_of_two_above};
use super::spectra::{Role, Spectra};
use crate::Result;
use crate::color::{Observer, xyz_of_emission};
use crate::geometry::{Aabb, AnalyticShape, triangle_area};
use crate::math;
use crate::sampling::AliasTable;
use crate::scene::description::{self, LightDescription, ObjectDescription, SceneDescription, ShapeDescription};
use crate::scene::solid::any_overlaps;
use crate::scene::{Aim, AreaShape, Light, LightKind, Solid};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum, WavelengthDensity};
use glam::{DAffine3, DVec3};

/// The lights of a scene and the tables that draw one.
pub struct Lights {
    pub lights: Vec<Light>,
    pub sampled: AliasTable,
    pub caustic: AliasTable,
    pub emitting: AliasTable,
    pub infinite: Vec<u32>,
    pub local: Vec<u32>,
    pub wavelengths: WavelengthDensity,
    pub radiance_scale: f64,
    /// A sphere around everything that can focus light.
    pub caustic_aim: Option<Aim>,
}

/// A light before its spectrum has been scaled.
struct Raw {
    kind: LightKind,
    spectrum: Spectrum,
    /// From the user's units to those of the compiled scene.
    factor: f64,
    bounds: Option<Aabb>,
    /// The object that it belongs to.
    object: Option<usize>,
    at: String,
}

/// Share of the brightest light below which one is warned about: in f32 it would vanish beside it.
const FAINTEST: f64 = 1.0 / (1u128 << 100) as f64;

pub fn compile(
    description: &SceneDescription,
    observer: &Observer,
    geometry: &mut Geometry,
    solids: &[Solid],
    spectra: &mut Spectra,
    normalization: &Normalization,
    warnings: &mut Vec<String>,
) -> Result<Lights> {
    let raw = raw_lights(description, geometry, spectra, normalization)?;
    let peak = |r: &Raw| r.spectrum.range().1 * r.factor;
    let brightest = raw.iter().map(peak).fold(0.0, f64::max);
    let radiance_scale = power_of_two_above(brightest);
    for light in raw.iter().filter(|r| peak(r) < brightest * FAINTEST) {
        let file = description.file.display();
        warnings
            .push(format!("{file}: {}: this light is 2^-100 of the brightest or less, and will not be seen", light.at));
    }

    let spectral = SpectralGrid::new(&raw, observer);
    let mut lights = Lights {
        lights: Vec::new(),
        sampled: AliasTable::default(),
        caustic: AliasTable::default(),
        emitting: AliasTable::default(),
        infinite: Vec::new(),
        local: Vec::new(),
        wavelengths: spectral.density(&raw, normalization.radius),
        radiance_scale,
        caustic_aim: focusing_aim(geometry),
    };
    let (mut sampled, mut caustic, mut emitting) = (Vec::new(), Vec::new(), Vec::new());
    for raw in raw {
        let index = lights.lights.len() as u32;
        let factor = raw.factor / radiance_scale;
        let light = Light {
            spectrum: spectra.add(&raw.spectrum, factor),
            wavelengths: spectral.density(std::slice::from_ref(&raw), normalization.radius),
            may_be_inside: raw.bounds.is_some_and(|b| any_overlaps(solids, &b)),
            kind: raw.kind,
        };
        let luminance = xyz_of_emission(&raw.spectrum, Observer::cie_1931_2deg()).y * factor;
        let power = luminance * light.kind.power(normalization.radius);
        sampled.push(if light.is_sampled() && !light.is_local() { power } else { 0.0 });
        emitting.push(if light.can_emit() { power } else { 0.0 });
        caustic.push(match lights.caustic_aim {
            Some(aim) if makes_caustics(&light, raw.bounds, &aim) => {
                power * light.aimed_share(raw.bounds, &aim, normalization.radius)
            }
            _ => 0.0,
        });
        if light.is_local() {
            lights.local.push(index);
        }
        if let Some(object) = raw.object {
            geometry.objects[object].light = Some(index);
        }
        if light.is_infinite() {
            lights.infinite.push(index);
        }
        lights.lights.push(light);
    }
    lights.sampled = AliasTable::new(&sampled);
    lights.caustic = AliasTable::new(&caustic);
    lights.emitting = AliasTable::new(&emitting);
    Ok(lights)
}

fn raw_lights(
    description: &SceneDescription,
    geometry: &Geometry,
    spectra: &mut Spectra,
    normalization: &Normalization,
) -> Result<Vec<Raw>> {
    let mut raw = Vec::new();
    for (index, object) in description.objects.iter().enumerate() {
        if let Some(emission) = &object.emission {
            let spectrum = spectra.resolve(emission, Role::Emission)?;
            raw.push(Raw {
                kind: area_light(object, &geometry.sources[index], geometry),
                spectrum,
                factor: 1.0,
                bounds: Some(geometry.objects[index].bounds),
                object: Some(index),
                at: emission.at.clone(),
            });
        }
    }
    for light in &description.lights {
        raw.push(shapeless_light(light, spectra, normalization)?);
    }
    if let Some(environment) = &description.environment {
        raw.push(Raw {
            kind: LightKind::Environment,
            spectrum: spectra.resolve(&environment.radiance, Role::Emission)?,
            factor: 1.0,
            bounds: None,
            object: None,
            at: environment.at.clone(),
        });
    }
    // Black lights are no lights.
    raw.retain(|r| r.spectrum.range().1 > 0.0);
    Ok(raw)
}

fn shapeless_light(light: &LightDescription, spectra: &mut Spectra, normalization: &Normalization) -> Result<Raw> {
    use description::LightKind as Kind;
    let unit = |v: [f64; 3]| DVec3::from(v).normalize().as_vec3();
    let point = |p: [f64; 3]| normalization.point(DVec3::from(p)).as_vec3();
    let one_minus_cos = |degrees: f64| {
        let s = math::sin(0.5 * degrees.to_radians());
        (2.0 * s * s) as f32
    };
    // Irradiance at a distance is intensity / distance²: lengths in units instead of metres change it by their square.
    let per_area = 1.0 / (normalization.meters_per_unit * normalization.meters_per_unit);
    let (kind, spectrum, factor, bounds) = match &light.kind {
        Kind::Point { position, intensity } => {
            let position = point(*position);
            (LightKind::Point { position }, intensity, per_area, Some(Aabb::from_points([position])))
        }
        Kind::Spot { position, direction, intensity, inner_degrees, outer_degrees } => {
            let position = point(*position);
            let (inner, outer) = (one_minus_cos(*inner_degrees), one_minus_cos(*outer_degrees));
            let kind = LightKind::Spot { position, axis: unit(*direction), inner, outer };
            (kind, intensity, per_area, Some(Aabb::from_points([position])))
        }
        Kind::Directional { direction, irradiance, angular_diameter_degrees } => {
            let one_minus_cos = one_minus_cos(0.5 * angular_diameter_degrees);
            (LightKind::Directional { direction: unit(*direction), one_minus_cos }, irradiance, 1.0, None)
        }
        Kind::Beam { origin, direction, radius, power } => {
            let (origin, radius) = (point(*origin), normalization.length(*radius) as f32);
            let bounds = Aabb { min: origin - radius, max: origin + radius };
            (LightKind::Beam { origin, direction: unit(*direction), radius }, power, per_area, Some(bounds))
        }
    };
    let spectrum = spectra.resolve(spectrum, Role::Emission)?;
    Ok(Raw { kind, spectrum, factor, bounds, object: None, at: light.at.clone() })
}

fn area_light(object: &ObjectDescription, source: &Source, geometry: &Geometry) -> LightKind {
    let (shape, area) = match source {
        Source::Triangles(range) => triangle_light(&object.shape, range.clone(), geometry),
        Source::Analytic(AnalyticShape::Sphere(sphere), transform) => {
            sphere_light(sphere.center, sphere.radius, transform)
        }
        Source::Analytic(AnalyticShape::Disk(disk), transform) => {
            let placed = *transform * disk.object_from_unit();
            let (u, v) = (placed.matrix3.x_axis, placed.matrix3.y_axis);
            // Mirrored, the front stays where the shape's normal goes.
            let v = if transform.matrix3.determinant() < 0.0 { -v } else { v };
            let area = std::f64::consts::PI * u.cross(v).length();
            let center = placed.translation.as_vec3();
            let normal = u.cross(v).normalize().as_vec3();
            (AreaShape::Ellipse { center, u: u.as_vec3(), v: v.as_vec3(), normal }, area as f32)
        }
        Source::Analytic(..) | Source::Polyhedron => (AreaShape::Unsampled, 0.0),
    };
    LightKind::Area { shape, area, two_sided: object.emission_two_sided }
}

fn triangle_light(shape: &ShapeDescription, range: std::ops::Range<u32>, geometry: &Geometry) -> (AreaShape, f32) {
    let corners = |t: u32| geometry.triangles[t as usize].map(|i| geometry.positions[i as usize]);
    if let ShapeDescription::Quad { .. } = shape {
        let [[o, a, c], [_, d, e]] = [corners(range.start), corners(range.start + 1)];
        // Triangles (0 1 2), (0 2 3), or with the last two swapped after a mirroring.
        let (u, v) = if c == d { (a - o, e - o) } else { (d - o, c - o) };
        let normal = u.as_dvec3().cross(v.as_dvec3()).normalize().as_vec3();
        return (AreaShape::Parallelogram { origin: o, u, v, normal }, u.cross(v).length());
    }
    let areas: Vec<f64> = range
        .clone()
        .map(|t| {
            let [a, b, c] = corners(t);
            f64::from(triangle_area(a, b, c))
        })
        .collect();
    let area = areas.iter().sum::<f64>() as f32;
    (AreaShape::Triangles { first: range.start, table: AliasTable::new(&areas) }, area)
}

fn sphere_light(center: DVec3, radius: f64, transform: &DAffine3) -> (AreaShape, f32) {
    let [x, y, z] = [transform.matrix3.x_axis, transform.matrix3.y_axis, transform.matrix3.z_axis];
    let scale2 = x.length_squared();
    let tolerance = 1024.0 * f64::EPSILON * scale2;
    let similar = [y.length_squared() - scale2, z.length_squared() - scale2, x.dot(y), y.dot(z), z.dot(x)]
        .into_iter()
        .all(|difference| difference.abs() <= tolerance);
    if !similar {
        return (AreaShape::Unsampled, 0.0);
    }
    let radius = radius * scale2.sqrt();
    let center = transform.transform_point3(center).as_vec3();
    (AreaShape::Sphere { center, radius: radius as f32 }, (4.0 * std::f64::consts::PI * radius * radius) as f32)
}

/// A sphere around everything that can focus light; `None` if nothing can.
fn focusing_aim(geometry: &Geometry) -> Option<Aim> {
    let casters = geometry.objects.iter().filter(|o| o.material.focuses());
    let bounds = casters.fold(Aabb::EMPTY, |bounds, o| bounds.union(o.bounds));
    let half = (bounds.max - bounds.min) * 0.5;
    half.is_finite().then(|| Aim { center: bounds.center(), radius: half.length() * (1.0 + 4.0 * f32::EPSILON) })
}

/// Solid angle, seen from what focuses it, below which camera paths hardly find a light: by scattering diffusely they
/// hit it once in 30 times or less, and light paths take part.
const SMALL_LIGHT_SR: f32 = 0.1;

fn makes_caustics(light: &Light, bounds: Option<Aabb>, aim: &Aim) -> bool {
    match light.kind {
        LightKind::Environment => false,
        LightKind::Directional { one_minus_cos, .. } => std::f32::consts::TAU * one_minus_cos < SMALL_LIGHT_SR,
        LightKind::Area { area, .. } => {
            let distance2 =
                bounds.map_or(0.0, |b| b.center().distance_squared(aim.center)).max(aim.radius * aim.radius);
            light.can_emit() && area < SMALL_LIGHT_SR * distance2
        }
        LightKind::Point { .. } | LightKind::Spot { .. } | LightKind::Beam { .. } => true,
    }
}

/// Wavelengths at which light and observer are multiplied: 1 nm, and the knots of all emission spectra.
struct SpectralGrid {
    lambda_nm: Vec<f64>,
    /// x̄ + ȳ + z̄.
    sensitivity: Vec<f64>,
}

impl SpectralGrid {
    fn new(lights: &[Raw], observer: &Observer) -> Self {
        let mut lambda_nm: Vec<f64> = (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(f64::from).collect();
        for light in lights.iter().filter(|l| l.spectrum.is_constant().is_none()) {
            lambda_nm.extend_from_slice(light.spectrum.tabulate().lambdas_nm());
        }
        lambda_nm.retain(|l| (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(l));
        lambda_nm.sort_by(f64::total_cmp);
        // Knots that f32 cannot tell apart are one.
        lambda_nm.dedup_by(|a, b| *a as f32 == *b as f32);
        let sensitivity = lambda_nm.iter().map(|&l| observer.eval(l).element_sum()).collect();
        Self { lambda_nm, sensitivity }
    }

    /// The density for light from all of these, each with its share of the power.
    fn density(&self, lights: &[Raw], radius: f32) -> WavelengthDensity {
        let mut power = vec![0.0; self.lambda_nm.len()];
        for raw in lights {
            let probe = raw.kind.power(radius) * raw.factor;
            let peak = raw.spectrum.range().1;
            for (sum, &l) in power.iter_mut().zip(&self.lambda_nm) {
                *sum += probe * raw.spectrum.eval(l).min(peak);
            }
        }
        // Only the shape counts; unit peak keeps extreme powers from overflowing.
        let peak = power.iter().copied().fold(0.0, f64::max);
        if peak > 0.0 {
            power.iter_mut().for_each(|p| *p /= peak);
        }
        WavelengthDensity::new(&self.lambda_nm, &power, &self.sensitivity)
    }
}
