//! Lights, and what is drawn from them: which light, and which wavelengths.

use super::compiler::Compiler;
use super::geometry::{Geometry, Source};
use super::normalize::power_of_two_above;
use super::spectra::Role;
use crate::Result;
use crate::color::{Observer, xyz_of_emission};
use crate::geometry::{Aabb, Patch, TriangleId, triangle_area};
use crate::math;
use crate::sampling::AliasTable;
use crate::scene::description::{self, LightDescription, ObjectDescription, ShapeDescription};
use crate::scene::solid::any_overlaps;
use crate::scene::{
    Aim, AreaLight, AreaShape, BeamLight, DirectionalLight, EnvironmentLight, Light, LightId, LightKind, PointLight,
    Solid, SpotLight,
};
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum, WavelengthDensity};
use glam::DVec3;

/// The lights of a scene and the tables that draw one.
pub struct Lights {
    pub lights: Vec<Light>,
    pub sampled: AliasTable,
    pub caustic: AliasTable,
    pub emitting: AliasTable,
    pub infinite: Vec<LightId>,
    pub local: Vec<LightId>,
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
    /// Index of the object that it belongs to.
    object: Option<usize>,
    at: String,
}

/// Share of the brightest light's radiance below which a light vanishes beside it in f32, so that it deserves a warning.
const FAINTEST: f64 = 1.0 / (1u128 << 100) as f64;

pub fn compile(
    compiler: &mut Compiler,
    observer: &Observer,
    geometry: &mut Geometry,
    solids: &[Solid],
) -> Result<Lights> {
    let raw = raw_lights(compiler, geometry)?;
    let radius = compiler.normalization.radius;
    let peak = |r: &Raw| r.spectrum.range().1 * r.factor;
    let brightest = raw.iter().map(peak).fold(0.0, f64::max);
    let radiance_scale = power_of_two_above(brightest);
    for light in raw.iter().filter(|r| peak(r) < brightest * FAINTEST) {
        compiler.warn(&light.at, "this light is 2^-100 of the brightest or less, and will not be seen");
    }

    let spectral = SpectralGrid::new(&raw, observer);
    let mut lights = Lights {
        lights: Vec::new(),
        sampled: AliasTable::default(),
        caustic: AliasTable::default(),
        emitting: AliasTable::default(),
        infinite: Vec::new(),
        local: Vec::new(),
        wavelengths: spectral.density(&raw, radius),
        radiance_scale,
        caustic_aim: focusing_aim(geometry),
    };
    let (mut sampled, mut caustic, mut emitting) = (Vec::new(), Vec::new(), Vec::new());
    for raw in raw {
        let index = LightId(lights.lights.len() as u32);
        let factor = raw.factor / radiance_scale;
        let light = Light {
            spectrum: compiler.spectra.add(&raw.spectrum, factor),
            wavelengths: spectral.density(std::slice::from_ref(&raw), radius),
            may_be_inside: raw.bounds.is_some_and(|b| any_overlaps(solids, &b)),
            kind: raw.kind,
        };
        let luminance = xyz_of_emission(&raw.spectrum, Observer::cie_1931_2deg()).y * factor;
        let power = luminance * light.kind.power(radius);
        sampled.push(if light.is_sampled() && !light.is_local() { power } else { 0.0 });
        emitting.push(if light.can_emit() { power } else { 0.0 });
        caustic.push(match lights.caustic_aim {
            Some(aim) if light.makes_caustics(raw.bounds, &aim) => power * light.aimed_share(raw.bounds, &aim, radius),
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

fn raw_lights(compiler: &Compiler, geometry: &Geometry) -> Result<Vec<Raw>> {
    let Compiler { description, spectra, .. } = compiler;
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
        raw.push(shapeless_light(light, compiler)?);
    }
    if let Some(environment) = &description.environment {
        raw.push(Raw {
            kind: LightKind::Environment(EnvironmentLight),
            spectrum: spectra.resolve(&environment.radiance, Role::Emission)?,
            factor: 1.0,
            bounds: None,
            object: None,
            at: environment.at.clone(),
        });
    }
    // Drop lights that emit nothing.
    raw.retain(|r| r.spectrum.range().1 > 0.0);
    Ok(raw)
}

fn shapeless_light(light: &LightDescription, compiler: &Compiler) -> Result<Raw> {
    let normalization = &compiler.normalization;
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
            (LightKind::Point(PointLight { position }), intensity, per_area, Some(Aabb::from_points([position])))
        }
        Kind::Spot { position, direction, intensity, inner_degrees, outer_degrees } => {
            let position = point(*position);
            let (inner, outer) = (one_minus_cos(*inner_degrees), one_minus_cos(*outer_degrees));
            let kind = LightKind::Spot(SpotLight { position, axis: unit(*direction), inner, outer });
            (kind, intensity, per_area, Some(Aabb::from_points([position])))
        }
        Kind::Directional { direction, irradiance, angular_diameter_degrees } => {
            let one_minus_cos = one_minus_cos(0.5 * angular_diameter_degrees);
            let light = DirectionalLight { direction: unit(*direction), one_minus_cos };
            (LightKind::Directional(light), irradiance, 1.0, None)
        }
        Kind::Beam { origin, direction, radius, power } => {
            let (origin, radius) = (point(*origin), normalization.length(*radius) as f32);
            let bounds = Aabb { min: origin - radius, max: origin + radius };
            let light = BeamLight { origin, direction: unit(*direction), radius };
            (LightKind::Beam(light), power, per_area, Some(bounds))
        }
    };
    let spectrum = compiler.spectra.resolve(spectrum, Role::Emission)?;
    Ok(Raw { kind, spectrum, factor, bounds, object: None, at: light.at.clone() })
}

fn area_light(object: &ObjectDescription, source: &Source, geometry: &Geometry) -> LightKind {
    let (shape, area) = match source {
        Source::Triangles(range) => triangle_light(&object.shape, range.clone(), geometry),
        Source::Analytic(shape, transform) => match shape.patches(transform) {
            Some(patches) => (AreaShape::of(&patches), patches.iter().map(Patch::area).sum::<f64>() as f32),
            None => (AreaShape::Unsampled, 0.0),
        },
        Source::Polyhedron => (AreaShape::Unsampled, 0.0),
    };
    LightKind::Area(AreaLight { shape, area, two_sided: object.emission_two_sided })
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
    (AreaShape::Triangles { first: TriangleId(range.start), table: AliasTable::new(&areas) }, area)
}

/// A sphere around everything that can focus light; `None` if nothing can.
fn focusing_aim(geometry: &Geometry) -> Option<Aim> {
    let casters = geometry.objects.iter().filter(|o| o.material.focuses());
    let bounds = casters.fold(Aabb::EMPTY, |bounds, o| bounds.union(o.bounds));
    let half = (bounds.max - bounds.min) * 0.5;
    half.is_finite().then(|| Aim { center: bounds.center(), radius: half.length() * (1.0 + 4.0 * f32::EPSILON) })
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
