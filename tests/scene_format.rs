//! Good scenes parse to exactly what they say, with the documented defaults.

#[path = "common/full_scene.rs"]
mod full;

use std::path::{Path, PathBuf};

use abbe::scene::description::*;
use full::FULL;

fn parse(text: &str) -> Parsed {
    parse_str(text, Path::new("folder/scene.json")).unwrap_or_else(|error| panic!("{error}"))
}

fn constant(value: f64, at: &str) -> SpectrumDescription {
    SpectrumDescription { kind: SpectrumKind::Constant(value), scale: 1.0, at: at.into() }
}

#[test]
fn a_minimal_scene_has_the_documented_defaults() {
    let text =
        r#"{"camera": {"type": "perspective", "from": [0, 3, 4], "to": [0, 0, 0]}, "film": {"width": 3, "height": 2}}"#;
    let expected = SceneDescription {
        file: "folder/scene.json".into(),
        camera: CameraDescription {
            from: [0.0, 3.0, 4.0],
            to: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov_degrees: 40.0,
            fov_axis: FovAxis::X,
            aperture_radius: 0.0,
            focus_distance: 5.0,
            at: "camera".into(),
        },
        film: FilmDescription {
            width: 3,
            height: 2,
            filter: FilterKind::Box,
            filter_radius: 0.5,
            observer: "1931-2".to_owned(),
        },
        render: RenderDescription { samples_per_pixel: 64, max_depth: 64, seed: 0, integrator: Integrator::Auto },
        spectra: vec![],
        materials: vec![],
        objects: vec![],
        lights: vec![],
        environment: None,
        develop: DevelopDescription { exposure_ev: None, tonemap: Tonemap::Srgb },
    };
    assert_eq!(parse(text), Parsed { description: expected, warnings: vec![] });
}

#[test]
fn objects_materials_and_lights_have_the_documented_defaults() {
    let scene = parse(
        r#"{"camera": {"type": "perspective", "from": [0, 3, 4], "to": [0, 0, 0]}, "film": {"width": 3, "height": 2},
        "materials": {"a": {"type": "diffuse", "reflectance": 0.5}, "b": {"type": "dielectric", "ior": 1.5}},
        "objects": [{"shape": {"type": "sphere", "center": [0, 0, 0], "radius": 1}, "material": "b"},
                    {"shape": {"type": "brilliant", "radius": 1}, "material": "a"},
                    {"shape": {"type": "implicit", "surface": "tanglecube", "size": 1}, "emission": {"rgb": [1, 1, 1]}}],
        "lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": {"blackbody_kelvin": 3000}}]}"#,
    );
    let scene = scene.description;
    let diffuse = MaterialKind::Diffuse { reflectance: constant(0.5, "materials.a.reflectance") };
    assert_eq!(scene.materials[0].1, MaterialDescription { kind: diffuse, two_sided: true, at: "materials.a".into() });
    let ior = IorDescription { kind: IorKind::Constant(1.5), hold: false, at: "materials.b.ior".into() };
    assert_eq!(
        scene.materials[1].1.kind,
        MaterialKind::Dielectric { ior, roughness: 0.0, absorption_per_m: None, priority: 0 }
    );
    assert_eq!(
        scene.objects[0],
        ObjectDescription {
            name: None,
            shape: ShapeDescription::Sphere { center: [0.0; 3], radius: 1.0 },
            transform: vec![],
            material: Some(1),
            emission: None,
            emission_two_sided: false,
            at: "objects[0]".into(),
        }
    );
    let cut = BrilliantDescription {
        radius: 1.0,
        table: 0.57,
        crown_degrees: 34.5,
        pavilion_degrees: 40.75,
        girdle: 0.03,
        star: 0.5,
        lower_half: 0.77,
    };
    assert_eq!(scene.objects[1].shape, ShapeDescription::Brilliant(cut));
    let tanglecube = ImplicitDescription::Tanglecube { size: 1.0, level: 11.8 };
    assert_eq!(scene.objects[2].shape, ShapeDescription::Implicit(tanglecube));
    let white = SpectrumKind::Rgb { rgb: [1.0; 3], space: "srgb".into() };
    let emission = SpectrumDescription { kind: white, scale: 1.0, at: "objects[2].emission".into() };
    assert_eq!((scene.objects[2].material, scene.objects[2].emission.clone()), (None, Some(emission)));
    let LightKind::Directional { irradiance, angular_diameter_degrees, .. } = &scene.lights[0].kind else { panic!() };
    assert_eq!(*angular_diameter_degrees, 0.0);
    assert_eq!(irradiance.kind, SpectrumKind::Blackbody { kelvin: 3000.0, normalize: true });
}

#[test]
fn the_full_scene_is_read_field_for_field() {
    let Parsed { description: scene, warnings } = parse(FULL);
    assert_eq!(scene.camera.fov_axis, FovAxis::Y);
    assert_eq!((scene.camera.focus_distance, scene.camera.aperture_radius), (4.0, 0.01));
    assert_eq!((scene.film.filter, scene.film.filter_radius), (FilterKind::BlackmanHarris, 1.5));
    assert_eq!((scene.render.seed, scene.render.integrator), (1 << 53, Integrator::Merge));
    assert_eq!(scene.develop, DevelopDescription { exposure_ev: Some(-1.5), tonemap: Tonemap::Reinhard });

    let names: Vec<&str> = scene.spectra.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["red", "dark red", "alias", "measured", "half"]);
    let dark = SpectrumKind::Named("red".into());
    assert_eq!(scene.spectra[1].1, SpectrumDescription { kind: dark, scale: 0.5, at: "spectra[\"dark red\"]".into() });
    let file = SpectrumKind::File(PathBuf::from("folder/data/red.csv"));
    assert_eq!(scene.spectra[3].1, SpectrumDescription { kind: file, scale: 2.0, at: "spectra.measured".into() });

    assert_eq!((scene.materials.len(), scene.objects.len(), scene.lights.len()), (11, 16, 4));
    assert!(!scene.materials[0].1.two_sided);
    let MaterialKind::Dielectric { ior, absorption_per_m, priority, .. } = &scene.materials[4].1.kind else { panic!() };
    assert_eq!((&ior.kind, ior.hold, *priority), (&IorKind::Glass("N-SF11".into()), true, -2));
    assert_eq!(absorption_per_m.as_ref().unwrap().scale, 4.0);
    let index = ConductorDescription::Metal("Au".into());
    assert_eq!(scene.materials[2].1.kind, MaterialKind::Conductor { index, roughness: 0.0 });

    let ball = &scene.objects[0];
    assert_eq!((ball.name.as_deref(), ball.material), (Some("ball"), Some(4)));
    assert_eq!(ball.transform[1], TransformStep::Rotate { degrees: 30.0, axis: [0.0, 2.0, 0.0] });
    assert_eq!(ball.transform[2], TransformStep::Scale([2.0; 3]));
    let triangles = ShapeDescription::Triangles {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        indices: vec![[0, 1, 2]],
        normals: vec![[0.0, 0.0, 1.0]; 3],
        uvs: vec![[0.0; 2], [1.0, 0.0], [0.0, 1.0]],
    };
    assert_eq!(scene.objects[3].shape, triangles);
    assert_eq!(scene.objects[4].shape, ShapeDescription::Mesh { file: PathBuf::from("folder/meshes/bunny.PLY") });
    let lens = ShapeDescription::Lens { radii: [0.5, f64::INFINITY], thickness: 0.1, diameter: 0.4 };
    assert_eq!(scene.objects[7].shape, lens);
    let union = ImplicitDescription::SmoothUnion {
        centers: vec![[0.0; 3], [1.0, 0.0, 0.0]],
        radii: vec![1.0, 0.5],
        blend: 0.2,
    };
    assert_eq!(scene.objects[12].shape, ShapeDescription::Implicit(union));
    assert_eq!(scene.objects[15].shape, ShapeDescription::Cylinder { radius: 1.0, height: 2.0, open: true });
    assert_eq!(scene.objects[14].shape, ShapeDescription::Box { min: [0.0; 3], max: [1.0, 2.0, 3.0] });
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn the_schema_accepts_the_full_scene() {
    let value: serde_json::Value = serde_json::from_str(FULL).unwrap();
    let validator = jsonschema::validator_for(&schema()).unwrap();
    let errors: Vec<String> = validator.iter_errors(&value).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:?}");
}

#[test]
fn the_committed_reference_is_what_the_declarations_say() {
    let committed = include_str!("../docs/scene-reference.md");
    assert!(committed == reference(), "run `abbe scene reference > docs/scene-reference.md`");
    for kind in ["sphere", "smooth-union", "dielectric", "directional", "blackbody_kelvin", "sellmeier", "matrix"] {
        assert!(committed.contains(&format!("{kind}`")) || committed.contains(&format!("\"{kind}\"`")), "{kind}");
    }
}

#[test]
fn tables_that_end_in_the_visible_and_unused_things_are_warned_of() {
    let edited = FULL
        .replace("[380, 500, 600, 780]", "[400, 500, 600, 690]")
        .replace("\"material\": \"gold\"", "\"material\": \"steel\"");
    let warnings = parse(&edited).warnings;
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].starts_with("folder/scene.json: spectra.red: the table covers 400–690 nm"));
    assert_eq!(warnings[1], "folder/scene.json: materials.gold: no object has this material");
}

/// Nothing gives light: a beginner's black picture is foretold.
#[test]
fn a_scene_without_light_is_warned_about() {
    let dark = r#"{ "camera": { "type": "perspective", "from": [0, 0, 4], "to": [0, 0, 0] }, "film": { "width": 4, "height": 4 } }"#;
    let warnings = |text: &str| abbe::scene::compile(&parse(text).description).unwrap().warnings;
    let told = warnings(dark);
    assert!(matches!(told.as_slice(), [only] if only.contains("nothing gives light")), "{told:?}");
    let lit = dark.replace(r#""film""#, r#""environment": { "radiance": 1 }, "film""#);
    assert!(warnings(&lit).is_empty());
}
