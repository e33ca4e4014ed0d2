//! Tests of what branches of camera paths bring together.

use super::camera::radiance;
use super::start_numbers::CameraNumbers;
use super::table::Techniques;
use crate::bsdf::{Branching, Carried, NEVER, Parting};
use crate::render::paths::{Place, TransportMode, Walk, Workspace};
use crate::sampling::{Sobol, mix};
use crate::scene::{Compiled, Scene};
use crate::spectrum::SampledSpectrum;
use std::path::Path;

/// Radiance that arrives along the first camera path of a sequence, somewhere in a film of 16 × 16 pixels.
fn traced(
    scene: &Scene,
    workspace: &mut Workspace,
    sobol: Sobol,
    carried: impl FnOnce(usize) -> Carried,
    max_depth: u32,
) -> SampledSpectrum {
    let place = Place { sobol, index: 0 };
    let numbers = CameraNumbers::of(place);
    let ray = scene.camera.ray(numbers.film.map(|u| 16.0 * u), [0.5; 2]);
    workspace.spectra.begin(scene.wavelengths.sample(numbers.wavelengths));
    workspace.interiors.reset(&[]);
    let carried = carried(numbers.hero);
    let mut walk = Walk::start(scene, workspace, ray, TransportMode::Radiance, carried, place);
    radiance::<true>(&mut walk, &Techniques::Path, max_depth)
}

/// A ball of glass with a core of another in a furnace.
fn furnace(core: &str) -> Compiled {
    let text = format!(
        r#"{{
        "camera": {{ "type": "perspective", "from": [0, 0, 5], "to": [0, 0, 0], "fov_degrees": 25 }},
        "film": {{ "width": 16, "height": 16 }},
        "materials": {{
            "shell": {{ "type": "dielectric", "ior": {{ "glass": "SF11" }} }},
            "core": {{ "type": "dielectric", "ior": {core}, "priority": 1 }}
        }},
        "objects": [
            {{ "shape": {{ "type": "sphere", "center": [0, 0, 0], "radius": 1 }}, "material": "shell" }},
            {{ "shape": {{ "type": "sphere", "center": [0.1, 0.2, 0], "radius": 0.5 }}, "material": "core" }}
        ],
        "environment": {{ "radiance": 1 }}
    }}"#
    );
    let parsed = crate::scene::description::parse_str(&text, Path::new("furnace.json")).unwrap();
    crate::scene::compile(&parsed.description).unwrap()
}

/// Parts make a whole: whatever a path forks for, its branches together bring what one path would, here 1 in every lane
/// that stands for itself, and the mean of 1 where one stands for others.
#[test]
fn branches_bring_what_one_path_does() {
    for core in [r#"{ "glass": "N-BK7" }"#, "2.4"] {
        let compiled = furnace(core);
        let scene = &compiled.scene;
        let mut workspace = Workspace::new(scene);
        let mut rays = [0; 2];
        for (trial, least_share) in [NEVER, 1.0 / 256.0].into_iter().enumerate() {
            for i in 0..4000 {
                workspace.counters = Default::default();
                let branching = Branching { parting: Parting::Ways(8), least_share };
                let start = |_| Carried::new(0, branching);
                let radiance = traced(scene, &mut workspace, Sobol::new(mix(i)), start, 4096);
                rays[trial] += workspace.counters.rays;
                let radiance = radiance * scene.radiance_scale as f32;
                assert!((radiance.mean() - 1.0).abs() < 1e-4, "{core} {least_share} {i}: {radiance:?}");
                assert_eq!(workspace.branches.pending, 0);
            }
        }
        assert!(rays[1] > 2 * rays[0], "paths fork: {rays:?} rays");
    }
}

/// A prism of flint in front of a lamp and a coloured wall, rough by `alpha`.
fn prism(alpha: f32) -> Compiled {
    let text = format!(
        r#"{{
        "camera": {{ "type": "perspective", "from": [0.0, 0.02, 0.5], "to": [0, 0, 0], "fov_degrees": 8 }},
        "film": {{ "width": 16, "height": 16 }},
        "materials": {{
            "flint": {{ "type": "dielectric", "ior": {{ "glass": "N-SF66", "extrapolate": "hold" }}, "roughness": {alpha} }},
            "wall": {{ "type": "diffuse", "reflectance": {{ "wavelengths_nm": [400, 700], "values": [0.2, 0.8] }} }}
        }},
        "objects": [
            {{ "shape": {{ "type": "prism", "apex_degrees": 40, "side": 0.1, "length": 0.1 }}, "material": "flint" }},
            {{ "shape": {{ "type": "quad", "origin": [-1, -1, -1], "u": [2, 0, 0], "v": [0, 2, 0] }}, "material": "wall" }},
            {{ "shape": {{ "type": "quad", "origin": [-0.3, -0.1, -0.6], "u": [0.25, 0, 0], "v": [0, 0.2, 0] }},
               "emission": {{ "illuminant": "D65" }} }}
        ]
    }}"#
    );
    let parsed = crate::scene::description::parse_str(&text, Path::new("prism.json")).unwrap();
    crate::scene::compile(&parsed.description).unwrap()
}

/// Ways of treating lanes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Treatment {
    /// One is followed from the start and stands for all.
    Single,
    /// They stay together wherever a rough surface lets them.
    Together,
    /// They may part at facets.
    Parting,
}

/// Mean and variance of what paths bring: of all lanes together, and of the long waves' lead over the short ones.
fn moments(compiled: &Compiled, treatment: Treatment, n: u64) -> [[f64; 2]; 2] {
    let scene = &compiled.scene;
    let mut workspace = Workspace::new(scene);
    let (mut sum, mut squares) = ([0.0; 2], [0.0; 2]);
    for i in 0..n {
        // Independent numbers: each path has a sequence of its own.
        let sobol = Sobol::new(mix(i ^ (treatment as u64) << 40));
        let ways = if treatment == Treatment::Parting { 8 } else { 1 };
        let branching = Branching { parting: Parting::Ways(ways), least_share: NEVER };
        let start = |hero| {
            let mut carried = Carried::new(hero, branching);
            if treatment == Treatment::Single {
                carried.leave_to_hero();
            }
            carried
        };
        let radiance = traced(scene, &mut workspace, sobol, start, 12);
        let lanes = radiance.lanes().map(f64::from);
        let (short, long): (f64, f64) = (lanes[..4].iter().sum(), lanes[4..].iter().sum());
        for (k, value) in [short + long, long - short].into_iter().enumerate() {
            sum[k] += value;
            squares[k] += value * value;
        }
    }
    let n = n as f64;
    [0, 1].map(|k| [sum[k] / n, squares[k] / n - sum[k] * sum[k] / (n * n)])
}

/// Lanes that share rays through rough glass bring what each brings alone. Most of the variance is that of finding the
/// lamp, which all share; that of colour is less by far, also where lobes hardly overlap any more, and less still where
/// the lanes part then.
#[test]
fn lanes_together_and_alone() {
    let n = 30_000;
    for (alpha, together, parting) in [(0.4, 100.0, 100.0), (0.1, 50.0, 50.0), (0.02, 7.0, 20.0), (0.002, 6.0, 40.0)] {
        let compiled = prism(alpha);
        let single = moments(&compiled, Treatment::Single, n);
        for (treatment, gain) in [(Treatment::Together, together), (Treatment::Parting, parting)] {
            let all = moments(&compiled, treatment, n);
            for (k, gain) in [0.9, gain].into_iter().enumerate() {
                let ([mean, variance], [single, single_variance]) = (all[k], single[k]);
                let sigma = ((variance + single_variance) / n as f64).sqrt();
                let ratio = single_variance / variance;
                println!(
                    "α = {alpha}, {treatment:?}: {mean:.4}, alone {single:.4} ± {sigma:.4}; variance / {ratio:.2}"
                );
                assert!((mean - single).abs() < 4.0 * sigma, "{alpha} {treatment:?}: {mean} {single} ± {sigma}");
                assert!(ratio > gain, "{alpha} {treatment:?}: variance {variance}, alone {single_variance}");
            }
        }
    }
}
