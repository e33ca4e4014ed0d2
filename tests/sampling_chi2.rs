//! χ² tests of every sample against the density that it claims to have, on independent random numbers; and of the
//! densities themselves, which must integrate to 1 where the whole domain is covered.

#[path = "common/render.rs"]
mod common;

use abbe::bsdf::{
    Branching, Carried, Conductor, Dielectric, Diffuse, Ggx, Indices, Lanes, NEVER, Parting, RoughConductor,
    RoughDielectric, ScatteringModel,
};
use abbe::film::Filter;
use abbe::geometry::{Frame, sample_triangle};
use abbe::math;
use abbe::sampling::{
    AliasTable, PiecewiseLinearDensity, concentric_disk, cosine_hemisphere, mix, uniform_cone, uniform_sphere,
};
use abbe::scene::{Aim, AreaLight, AreaShape, Light, LightKind, Scene};
use abbe::spectrum::{SampledSpectrum, WavelengthDensity};
use common::{chi2_sigmas, compile_json};
use glam::{DVec3, Vec3};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const SAMPLES: u64 = 200_000;

/// Independent uniform numbers.
fn uniform(index: u64, dimension: u64) -> f32 {
    (mix(mix(index) ^ (dimension << 40)) >> 40) as f32 / (1u64 << 24) as f32
}

fn pair(index: u64, dimension: u64) -> [f32; 2] {
    [uniform(index, dimension), uniform(index, dimension + 1)]
}

/// Compares counts with expected shares of `samples`; cells that expect fewer than five are pooled.
fn assert_fits(what: &str, counts: &[u64], shares: &[f64], samples: u64) {
    let (mut chi2, mut cells) = (0.0, 0);
    let (mut rare_count, mut rare_expected) = (0.0, 0.0);
    for (&count, share) in counts.iter().zip(shares) {
        let expected = share * samples as f64;
        if expected < 5.0 {
            rare_count += count as f64;
            rare_expected += expected;
            continue;
        }
        chi2 += (count as f64 - expected) * (count as f64 - expected) / expected;
        cells += 1;
    }
    if rare_expected > 0.0 {
        chi2 += (rare_count - rare_expected) * (rare_count - rare_expected) / rare_expected.max(1.0);
        cells += 1;
    } else {
        // Slivers of the domain fall between the points of the quadrature.
        assert!(rare_count <= 3e-4 * samples as f64, "{what}: {rare_count} samples where the density is 0");
    }
    let sigmas = chi2_sigmas(chi2, f64::from(cells - 1));
    println!("{what}: χ² {chi2:.1} in {cells} cells, {sigmas:+.2} σ");
    assert!(sigmas < 4.0 && sigmas > -4.0, "{what}: χ² {chi2} in {cells} cells");
}

const CELLS_Z: usize = 24;
const CELLS_PHI: usize = 24;

/// Directions about an axis, in cells of cos θ over [`low`, 1] and φ.
fn test_directions(what: &str, axis: DVec3, low: f64, sample: impl Fn(u64) -> Option<Vec3>, pdf: impl Fn(Vec3) -> f32) {
    let s = axis.any_orthonormal_vector();
    let t = axis.cross(s);
    let mut counts = vec![0; CELLS_Z * CELLS_PHI + 1];
    for index in 0..SAMPLES {
        let Some(d) = sample(index) else {
            counts[CELLS_Z * CELLS_PHI] += 1;
            continue;
        };
        let d = d.as_dvec3();
        assert!((d.length() - 1.0).abs() < 1e-5, "{what}: not a unit vector");
        let z = (d.dot(axis) - low) / (1.0 - low);
        assert!(z > -1e-3 && z < 1.0 + 1e-3, "{what}: outside the domain");
        let phi = math::atan2(d.dot(t), d.dot(s)) / TAU + 0.5;
        let cell = |x: f64, n: usize| ((x * n as f64) as usize).min(n - 1);
        counts[cell(z.max(0.0), CELLS_Z) * CELLS_PHI + cell(phi, CELLS_PHI)] += 1;
    }
    let fine = 48;
    let mut shares = vec![0.0; CELLS_Z * CELLS_PHI + 1];
    for iz in 0..CELLS_Z * fine {
        let z = low + (1.0 - low) * (iz as f64 + 0.5) / (CELLS_Z * fine) as f64;
        let r = (1.0 - z * z).sqrt();
        for ip in 0..CELLS_PHI * fine {
            let phi = TAU * ((ip as f64 + 0.5) / (CELLS_PHI * fine) as f64 - 0.5);
            let d = axis * z + (s * math::cos(phi) + t * math::sin(phi)) * r;
            let solid_angle = TAU * (1.0 - low) / (CELLS_Z * CELLS_PHI * fine * fine) as f64;
            shares[iz / fine * CELLS_PHI + ip / fine] += f64::from(pdf(d.as_vec3())) * solid_angle;
        }
    }
    let total: f64 = shares.iter().sum();
    assert!(total < 1.0 + 2e-3, "{what}: the density integrates to {total}");
    // What is missing from 1 are the samples that came to nothing.
    shares[CELLS_Z * CELLS_PHI] = (1.0 - total).max(0.0);
    if (1.0 - total).abs() < 2e-3 {
        shares.pop();
        assert!(counts.pop() < Some(SAMPLES / 200), "{what}: samples are lost");
        shares.iter_mut().for_each(|s| *s /= total);
    }
    let kept = counts.iter().sum();
    assert_fits(what, &counts, &shares, kept);
}

#[test]
fn warps() {
    let up = DVec3::Z;
    test_directions("cosine hemisphere", up, 0.0, |i| Some(cosine_hemisphere(pair(i, 0))), |d| d.z / PI as f32);
    test_directions("uniform sphere", up, -1.0, |i| Some(uniform_sphere(pair(i, 0))), |_| (0.25 / PI) as f32);
    for h in [1.1e-5f32, 0.1, 0.7] {
        let low = 1.0 - f64::from(h);
        let pdf = 1.0 / (TAU * f64::from(h)) as f32;
        let sample = |i| Some(uniform_cone(pair(i, 0), h));
        if h > 1e-3 {
            test_directions(&format!("cone of {h}"), up, low, sample, |_| pdf);
        } else {
            // 1 − cos θ is below the rounding of z: look across instead, where 1 − cos θ = r² / 2.
            let radius2 = |i| (0..2).map(|k| f64::from(uniform_cone(pair(i, 0), h)[k])).map(|x| x * x).sum::<f64>();
            let mut counts = vec![0; 50];
            (0..SAMPLES).for_each(|i| counts[((radius2(i) / (2.0 * f64::from(h)) * 50.0) as usize).min(49)] += 1);
            assert_fits("cone of the sun", &counts, &[0.02; 50], SAMPLES);
        }
    }
    let mut counts = vec![0; 400];
    for i in 0..SAMPLES {
        let [x, y] = concentric_disk(pair(i, 0)).map(f64::from);
        let (r2, phi) = (x * x + y * y, math::atan2(y, x) / TAU + 0.5);
        counts[((r2 * 20.0) as usize).min(19) * 20 + ((phi * 20.0) as usize).min(19)] += 1;
    }
    assert_fits("disk", &counts, &[1.0 / 400.0; 400], SAMPLES);
}

/// A path that has just started.
fn carried() -> Carried {
    Carried::new(0, Branching { parting: Parting::Ways(1), least_share: NEVER })
}

/// The density with which a reflecting model draws a direction.
fn density(model: &impl ScatteringModel, frame: &Frame, wo: Vec3, wi: Vec3) -> f32 {
    model.evaluate(frame, wo, wi).and_then(|evaluation| evaluation.pdf.shared()).unwrap_or(0.0)
}

#[test]
fn diffuse() {
    let bsdf = Diffuse { reflectance: SampledSpectrum::splat(0.5) };
    let geometric = DVec3::new(0.2, 0.9, -0.3).normalize();
    let tilted = (geometric + DVec3::new(0.5, 0.1, 0.4)).normalize();
    for (what, shading) in [("diffuse", geometric), ("diffuse, tilted normal", tilted)] {
        let frame = Frame { geometric, shading: shading.as_vec3() };
        let wo = (geometric + DVec3::new(0.3, 0.0, 0.0)).normalize().as_vec3();
        let sample = |i| bsdf.sample(&frame, wo, &carried(), pair(i, 0), 0.0).and_then(|s| s.wi.shared());
        test_directions(what, shading, 0.0, sample, |d| density(&bsdf, &frame, wo, d));
        for i in 0..1000 {
            let Some(s) = bsdf.sample(&frame, wo, &carried(), pair(i, 0), 0.0) else { continue };
            let wi = s.wi.shared().unwrap();
            let pdf = density(&bsdf, &frame, wo, wi);
            assert!((s.pdf.shared().unwrap() / pdf - 1.0).abs() < 1e-4);
            let weight = bsdf.evaluate(&frame, wo, wi).unwrap().value.lane(0) / pdf;
            assert!((s.weight.lanes()[0] - weight).abs() < 1e-4, "{:?} {weight}", s.weight);
        }
    }
}

/// A scene with one light, whose coordinates are compiled; a floor that is far from it.
fn light_scene(light: Value) -> Scene {
    let mut objects = vec![
        json!({ "material": "glass", "shape": { "type": "sphere", "center": [0.5, 0.2, 0.1], "radius": 0.2 } }),
        json!({ "material": "grey", "shape": { "type": "quad", "origin": [-1, 0, 1], "u": [2, 0, 0], "v": [0, 0, -2] } }),
    ];
    let mut lights = Vec::new();
    if light["type"].is_string() {
        lights.push(light)
    } else {
        objects.push(light)
    }
    compile_json(&json!({
        "camera": { "type": "perspective", "from": [0, 1, 0], "to": [0, 0, 0], "up": [0, 0, -1] },
        "film": { "width": 1, "height": 1 },
        "materials": { "grey": { "type": "diffuse", "reflectance": 0.5 }, "glass": { "type": "dielectric", "ior": 1.5 } },
        "objects": objects,
        "lights": lights
    }))
    .scene
}

/// Directions to spherical lights and to discs at infinity are uniform in a cone, and the density that a ray reports
/// which runs into the light is that of the sample.
#[test]
fn light_cones() {
    let scene =
        light_scene(json!({ "emission": 1, "shape": { "type": "sphere", "center": [0.2, 0.8, 0.1], "radius": 0.3 } }));
    let light: &Light = &scene.lights[0];
    for from in [Vec3::new(0.0, -0.2, 0.0), Vec3::new(-0.2, 0.0, 0.3)] {
        let samples: Vec<_> = (0..SAMPLES).map(|i| light.sample(&scene, from, pair(i, 0)).unwrap()).collect();
        let LightKind::Area(AreaLight { shape: AreaShape::Sphere { center, .. }, .. }) = light.kind else { panic!() };
        let axis = (center - from).as_dvec3().normalize();
        let pdf = samples[0].pdf.unwrap();
        let low = 1.0 - 1.0 / (TAU * f64::from(pdf));
        test_directions("sphere light", axis, low, |i| Some(samples[i as usize].wi), |_| pdf);
        agrees_with_rays(&scene, light, from, 1500, 0.0);
    }
    let sun = light_scene(
        json!({ "type": "directional", "direction": [0.3, -1, 0.2], "irradiance": 1, "angular_diameter_degrees": 30 }),
    );
    let light = &sun.lights[0];
    let axis = -DVec3::new(0.3, -1.0, 0.2).normalize();
    let pdf = light.sample(&sun, Vec3::ZERO, [0.5, 0.5]).unwrap().pdf.unwrap();
    let low = math::cos(15f64.to_radians());
    let sample = |i| Some(light.sample(&sun, Vec3::ZERO, pair(i, 0)).unwrap().wi);
    test_directions("sun of 30°", axis, low, sample, |d| light.escaped(d).map_or(pdf, |(_, pdf)| pdf));
}

/// Every direction drawn meets the light, and there the density is the same. Of the 2000 points drawn from a closed surface
/// only some face the reference point. On a curved one, the cosine of a grazing ray depends on the last bits of the point.
fn agrees_with_rays(scene: &Scene, light: &Light, from: Vec3, least_met: u32, curvature: f32) {
    let mut met = 0;
    for i in 0..2000 {
        let Some(sample) = light.sample(scene, from, pair(i, 7)) else { continue };
        let ray = abbe::geometry::Ray { origin: from, direction: sample.wi };
        let Some(surface) = scene.closest(&ray, f32::INFINITY) else { continue };
        if scene.object(surface.object).light.is_none() || !light.emits(&surface, sample.wi) {
            continue;
        }
        met += 1;
        let pdf = light.pdf_surface(from, sample.wi, &surface);
        let cos = surface.geometric.as_vec3().dot(sample.wi);
        let tolerance = 1e-3 + 2e-6 * curvature / (cos * cos);
        assert!((pdf / sample.pdf.unwrap() - 1.0).abs() < tolerance, "{pdf} {:?}", sample.pdf);
        assert!((sample.weight * pdf - 1.0).abs() < tolerance);
    }
    assert!(met > least_met, "{met}");
}

/// Points drawn by area: the density in solid angle fits the directions, for every shape of light.
#[test]
fn area_lights() {
    let lights = [
        (
            "quad light",
            json!({ "shape": { "type": "quad", "origin": [-0.4, 0.9, -0.3], "u": [0.7, 0, 0.1], "v": [0, 0.1, 0.6] } }),
        ),
        (
            "mesh light",
            json!({ "shape": { "type": "triangles", "positions": [-0.4, 0.9, -0.3, 0.5, 0.8, -0.3, 0, 0.9, 0.5, -0.5, 0.7, 0.4],
            "indices": [0, 1, 2, 0, 2, 3] } }),
        ),
        (
            "disk light",
            json!({ "shape": { "type": "disk", "center": [0, 0.8, 0.1], "normal": [0.1, -1, 0.1], "radius": 0.5 } }),
        ),
        ("box light", json!({ "shape": { "type": "box", "min": [-0.3, 0.4, -0.2], "max": [0.2, 0.9, 0.5] } })),
        (
            "sheared box light",
            json!({ "shape": { "type": "box", "min": [-0.3, -0.2, -0.2], "max": [0.2, 0.2, 0.5] },
            "transform": [{ "matrix": [-1, 0.2, 0, 0, 0.1, 1, 0.3, 0.7, 0, 0, 0.8, 0.1, 0, 0, 0, 1] }] }),
        ),
        (
            "cylinder light",
            json!({ "shape": { "type": "cylinder", "radius": 0.25, "height": 0.5 },
            "transform": [{ "rotate_degrees": 50, "axis": [1, 0, 0.5] }, { "translate": [0, 0.7, 0.1] }] }),
        ),
        (
            "open cylinder light",
            json!({ "shape": { "type": "cylinder", "radius": 0.3, "height": 0.9, "open": true },
            "transform": [{ "rotate_degrees": 80, "axis": [1, 0, 0.5] }, { "translate": [0, 0.7, 0.1] }] }),
        ),
    ];
    for (what, mut light) in lights {
        light["emission"] = json!(1);
        let scene = light_scene(light);
        let light = &scene.lights[0];
        let from = Vec3::new(0.05, -0.2, 0.05);
        let axis = DVec3::Y;
        let density = |d: Vec3| {
            let ray = abbe::geometry::Ray { origin: from, direction: d };
            let Some(surface) = scene.closest(&ray, f32::INFINITY) else { return 0.0 };
            let hit = scene.object(surface.object).light.is_some() && light.emits(&surface, d);
            if hit { light.pdf_surface(from, d, &surface) } else { 0.0 }
        };
        let sample = |i| light.sample(&scene, from, pair(i, 0)).map(|s| s.wi);
        let is_closed = what.contains("box") || what.contains("cylinder");
        let curvature = if what.contains("cylinder") { 4.0 } else { 0.0 };
        agrees_with_rays(&scene, light, from, if is_closed { 300 } else { 1500 }, curvature);
        if curvature == 0.0 {
            test_directions(what, axis, 0.0, sample, density);
            continue;
        }
        // The density has no bound at the outline of a curved surface, where the quadrature fails: compare solid angles.
        let weights = (0..SAMPLES).filter_map(|i| light.sample(&scene, from, pair(i, 0))).map(|s| f64::from(s.weight));
        let by_light = weights.sum::<f64>() / SAMPLES as f64;
        let met = (0..SAMPLES).filter(|&i| density(uniform_sphere(pair(i, 3))) > 0.0).count();
        let by_rays = 2.0 * TAU * met as f64 / SAMPLES as f64;
        assert!((by_light / by_rays - 1.0).abs() < 0.03, "{what}: {by_light} {by_rays}");
    }
}

/// Light paths leave with the density that camera paths weigh them by: weight × density per unit of étendue = 1.
#[test]
fn emission() {
    let quad = json!({ "emission": 1, "shape": { "type": "quad", "origin": [-0.4, 0.9, -0.3], "u": [0.7, 0, 0.1], "v": [0, 0.1, 0.6] } });
    let mut two_sided = quad.clone();
    two_sided["emission_two_sided"] = json!(true);
    let sphere = json!({ "emission": 1, "shape": { "type": "sphere", "center": [-0.3, 0.8, 0.1], "radius": 0.1 } });
    let sun =
        json!({ "type": "directional", "direction": [0.3, -1, 0.2], "irradiance": 1, "angular_diameter_degrees": 10 });
    let crate_like =
        json!({ "emission": 1, "shape": { "type": "box", "min": [-0.4, 0.7, -0.3], "max": [-0.2, 0.9, 0.3] } });
    let tube = json!({ "emission": 1, "shape": { "type": "cylinder", "radius": 0.1, "height": 0.4 },
        "transform": [{ "rotate_degrees": 70, "axis": [1, 0, 0] }, { "translate": [-0.3, 0.8, 0] }] });
    for (what, light) in [
        ("quad", quad),
        ("two-sided quad", two_sided),
        ("sphere", sphere),
        ("sun", sun),
        ("box", crate_like),
        ("cylinder", tube),
    ] {
        let scene = light_scene(light);
        let light = &scene.lights[0];
        // The disc's radiance is what the light's weight contains besides the density.
        let radiance = light.escaped(Vec3::new(-0.3, 1.0, -0.2).normalize()).map_or(1.0, |(radiance, _)| radiance);
        for aim in [scene.caustic_aim.unwrap(), scene.everything()] {
            let mut left = 0;
            for i in 0..5000 {
                let Some(e) = light.emit(&scene, &aim, pair(i, 0), pair(i, 2)) else { continue };
                left += 1;
                let density = light.emission_density(&e.exit(), &aim).unwrap();
                let product = e.weight * density / radiance;
                assert!((product - 1.0).abs() < 2e-3, "{what}: {product}");
                assert!(
                    towards(&aim, e.start.point, e.direction) || what == "two-sided quad",
                    "{what}: misses its aim"
                );
            }
            assert!(left > 1000, "{what}: {left}");
        }
    }
}

/// Whether a ray meets the sphere that was aimed at, or starts in it.
fn towards(aim: &Aim, from: Vec3, direction: Vec3) -> bool {
    let (to, d) = ((aim.center - from).as_dvec3(), direction.as_dvec3());
    let off = (to - d * to.dot(d)).length();
    to.length() <= f64::from(aim.radius) || (off <= f64::from(aim.radius) * 1.0001 && to.dot(d) > 0.0)
}

#[test]
fn wavelengths() {
    let lambda: Vec<f64> = (360..=830).map(f64::from).collect();
    let light: Vec<f64> = lambda.iter().map(|&l| if (l - 546.0).abs() < 2.0 { 50.0 } else { 0.2 }).collect();
    let eye: Vec<f64> = lambda.iter().map(|&l| math::exp(-(l - 550.0) * (l - 550.0) / 5000.0)).collect();
    let density = WavelengthDensity::new(&lambda, &light, &eye);
    let cells = 94;
    let mut counts = vec![0; cells];
    for i in 0..SAMPLES {
        // One lane of each set: lanes are stratified among themselves.
        let w = density.sample(uniform(i, 0));
        let lane = (uniform(i, 1) * 8.0) as usize;
        // The density has steps, and a wavelength may be rounded onto one.
        let lambda = w.lambda_nm[lane];
        let near = [lambda.next_down(), lambda, lambda.next_up()];
        assert!(near.iter().any(|&lambda| (w.pdf[lane] / density.density(lambda) - 1.0).abs() < 1e-2), "{lambda}");
        counts[(((f64::from(w.lambda_nm[lane]) - 360.0) / 5.0) as usize).min(cells - 1)] += 1;
    }
    assert_fits(
        "wavelengths",
        &counts,
        &shares_of(|x| f64::from(density.density(x as f32)), 360.0, 5.0, cells),
        SAMPLES,
    );
}

fn shares_of(density: impl Fn(f64) -> f64, first: f64, width: f64, cells: usize) -> Vec<f64> {
    let fine = 200;
    let at = |cell: usize, k: usize| first + width * (cell as f64 + (k as f64 + 0.5) / fine as f64);
    (0..cells).map(|c| (0..fine).map(|k| density(at(c, k))).sum::<f64>() * width / fine as f64).collect()
}

#[test]
fn tables() {
    let weights = [0.1, 3.0, 0.0, 1.0, 7.0, 0.5];
    let table = AliasTable::new(&weights);
    let mut counts = vec![0; weights.len()];
    let mut rests = vec![0; 20];
    for i in 0..SAMPLES {
        let draw = table.sample(uniform(i, 0)).unwrap();
        counts[draw.index] += 1;
        rests[(draw.rest * 20.0) as usize] += 1;
        assert!((f64::from(draw.probability) - weights[draw.index] / 11.6).abs() < 1e-6);
    }
    assert_fits("alias table", &counts, &weights.map(|w| w / 11.6), SAMPLES);
    assert_fits("what is left of the number", &rests, &[0.05; 20], SAMPLES);
    let linear = PiecewiseLinearDensity::new(&[0.0, 1.0, 1.5, 4.0], &[1.0, 0.0, 5.0, 0.5]);
    let mut counts = vec![0; 80];
    (0..SAMPLES).for_each(|i| counts[((linear.sample(uniform(i, 0)).0 * 20.0) as usize).min(79)] += 1);
    assert_fits(
        "piecewise linear",
        &counts,
        &shares_of(|x| f64::from(linear.density(x as f32)), 0.0, 0.05, 80),
        SAMPLES,
    );
}

/// Points of a triangle, in cells of (√(1 − b₀), b₁ / (b₁ + b₂)), which have equal areas.
#[test]
fn triangles() {
    let mut counts = vec![0; 400];
    for i in 0..SAMPLES {
        let [b0, b1, b2] = sample_triangle(pair(i, 0)).map(f64::from);
        let (x, y) = ((1.0 - b0) * (1.0 - b0), if b1 + b2 > 0.0 { b1 / (b1 + b2) } else { 0.0 });
        counts[((x * 20.0) as usize).min(19) * 20 + ((y * 20.0) as usize).min(19)] += 1;
    }
    assert_fits("triangle", &counts, &[1.0 / 400.0; 400], SAMPLES);
}

/// Camera samples and splats use the same filter: the mean weight of splats at a distance is the density of samples there.
#[test]
fn filters() {
    for (what, filter) in [
        ("box", Filter::boxed(0.5)),
        ("wide box", Filter::boxed(1.2)),
        ("gaussian", Filter::gaussian(1.5)),
        ("blackman-harris", Filter::blackman_harris(2.0)),
    ] {
        let radius = f64::from(filter.radius());
        let cells = 20;
        let mut counts = vec![0; cells];
        let mut weights = vec![0.0; cells];
        let cell = |x: f64| (((x / radius + 1.0) * 0.5 * cells as f64) as usize).min(cells - 1);
        for i in 0..SAMPLES {
            counts[cell(f64::from(filter.sample(pair(i, 0))[0]))] += 1;
            // Splats uniform over the picture's pixel 5, 5 and around.
            let [x, y] = pair(i, 2).map(|u| 5.5 + 2.0 * radius as f32 * (u - 0.5));
            let area = 4.0 * radius * radius;
            filter.splat([x, y], 11, 11, |column, row, weight| {
                if (column, row) == (5, 5) {
                    weights[cell(f64::from(x) - 5.5)] += f64::from(weight) * area / SAMPLES as f64;
                }
            });
        }
        let total: f64 = weights.iter().sum();
        assert!((total - 1.0).abs() < 0.02, "{what}: splats add up to {total}");
        for (count, weight) in counts.iter().zip(&weights) {
            let share = *count as f64 / SAMPLES as f64;
            assert!((share - weight).abs() < 0.06 * share.max(0.05), "{what}: {share} {weight}");
        }
    }
}

/// Boundaries: the share of reflections is Fresnel's, lane by lane.
#[test]
fn dielectric_choice() {
    use abbe::bsdf::{Dielectric, Incidence, Indices};
    let glass = Indices { eta: std::array::from_fn(|k| 1.9 - 0.02 * k as f64), dispersive: true };
    let boundary = Dielectric { from: Indices::AIR, to: glass };
    for degrees in [0.0, 50.0, 85.0f64] {
        let (sin, cos) = (math::sin(degrees.to_radians()), math::cos(degrees.to_radians()));
        let incidence = Incidence::new(Vec3::new(sin as f32, 0.0, -cos as f32), DVec3::Z);
        for lane in 0..8 {
            let one = SampledSpectrum::ONE.only(lane);
            let reflected = (0..SAMPLES / 10)
                .filter(|&i| {
                    !boundary.divide(&incidence, Lanes::Only(lane), one).choose(uniform(i, lane as u64)).refracted
                })
                .count() as u64;
            let f = common::fresnel(sin, 1.0, glass.eta[lane]);
            assert_fits("reflections", &[reflected, SAMPLES / 10 - reflected], &[f, 1.0 - f], SAMPLES / 10);
        }
    }
}

/// Rough surfaces: each lane of glass alone, from either side; all lanes led by one drawn among them; and a metal.
#[test]
fn rough_surfaces() {
    let geometric = DVec3::new(0.2, 0.9, -0.3).normalize();
    let frame = Frame { geometric, shading: geometric.as_vec3() };
    let wo = (geometric + DVec3::new(0.9, 0.1, -0.4)).normalize().as_vec3();
    let flint = Indices { eta: std::array::from_fn(|k| 1.95 - 0.02 * k as f64), dispersive: true };
    for (alpha, lanes, from, to) in [
        (0.3, Lanes::Only(2), Indices::AIR, flint),
        (0.5, Lanes::Only(7), flint, Indices::AIR),
        (1.0, Lanes::Only(0), Indices::AIR, flint),
        (0.4, Lanes::Shared, Indices::AIR, flint),
        (0.4, Lanes::Shared, flint, Indices::AIR),
    ] {
        let (boundary, odds) = (Dielectric { from, to }, SampledSpectrum::ONE);
        let bsdf = RoughDielectric { boundary, ggx: Ggx::new(alpha), lanes, hero: 0, odds, parts: false };
        let sample = |i| {
            let hero = (uniform(i, 3) * 8.0) as usize;
            let bsdf = RoughDielectric { hero, ..bsdf };
            bsdf.sample(&frame, wo, &carried(), [uniform(i, 0), uniform(i, 1)], uniform(i, 2))?.wi.shared()
        };
        let pdf = |wi| {
            let own = bsdf.evaluate(&frame, wo, wi).map_or(SampledSpectrum::ZERO, |evaluation| evaluation.own_pdf);
            if let Lanes::Only(lane) = lanes { own.lane(lane) } else { own.mean() }
        };
        test_directions(&format!("rough glass, {alpha}, {lanes:?}"), geometric, -1.0, sample, pdf);
    }
    let (eta, k) = (SampledSpectrum::splat(0.2), SampledSpectrum::splat(3.0));
    let metal = RoughConductor { facets: Conductor { eta, k, eta_outside: [1.0; 8] }, ggx: Ggx::new(0.4) };
    let sample = |i| metal.sample(&frame, wo, &carried(), pair(i, 0), 0.0).and_then(|s| s.wi.shared());
    test_directions("rough metal", geometric, -1.0, sample, |wi| density(&metal, &frame, wo, wi));
}
