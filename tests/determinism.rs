//! What must not change a single bit of a picture: threads, passes, features that are not needed, names, and powers of
//! two in lengths and light.

#[path = "common/mechanisms.rs"]
mod mechanisms;

use std::time::Duration;

use abbe::film::Film;
use abbe::render::{Progress, Rendering, render};
use abbe::scene::SceneFeatures;
use mechanisms::*;
use serde_json::{Value, json};

fn threads<T: Send>(n: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap().install(work)
}

/// Asserts that two films agree in every bit, once `b` is divided by a power of two.
fn assert_same_bits(a: &Film, b: &Film, scale: f64, what: &str) {
    let bits = |film: &Film, scale: f64| -> Vec<[u64; 3]> {
        film.to_image().triples().iter().map(|xyz| xyz.map(|v| (v / scale).to_bits())).collect()
    };
    let (bits_a, bits_b) = (bits(a, 1.0), bits(b, scale));
    let differing = bits_a.iter().zip(&bits_b).filter(|(a, b)| a != b).count();
    if let Some(first) = bits_a.iter().zip(&bits_b).position(|(a, b)| a != b) {
        let (x, y) = (first % a.width() as usize, first / a.width() as usize);
        panic!(
            "{what}: {differing} of {} pixels differ, first ({x}, {y}): {:?} and {:?}",
            bits_a.len(),
            a.to_image().triples()[first],
            b.to_image().triples()[first].map(|v| v / scale)
        );
    }
    assert_eq!((a.camera_paths(), a.light_paths()), (b.camera_paths(), b.light_paths()), "{what}");
    assert_eq!((a.non_finite_samples, b.non_finite_samples), (0, 0), "{what}");
}

/// The scene, with the films in it being worth comparing: both parts have light, in nearly every pixel. Samples reach one
/// pixel beyond the film, as its filter does.
fn reference(folder: &SceneFolder) -> (Value, Film) {
    let scene = everything();
    let film = folder.film(&scene);
    let lit = film.to_image().triples().iter().filter(|xyz| xyz[1] > 0.0).count();
    assert!(lit > 1000 && film.camera_paths() == 42 * 30 * 6 && film.light_paths() > 0, "{lit}");
    (scene, film)
}

/// The relations below say nothing about what the camera never sees.
#[test]
fn every_object_and_light_shows_in_the_film() {
    let folder = SceneFolder::new("shows");
    let mut scene = everything();
    scene["render"]["samples_per_pixel"] = json!(2);
    let film = folder.film(&scene);
    for list in ["objects", "lights"] {
        for i in 0..scene[list].as_array().unwrap().len() {
            let mut without = scene.clone();
            let removed = without[list].as_array_mut().unwrap().remove(i);
            let (with, without) = (film.to_image(), folder.film(&without).to_image());
            let changed = with.triples().iter().zip(without.triples()).filter(|(a, b)| a != b).count();
            assert!(changed >= 3, "{changed} pixels change without {removed}");
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let folder = SceneFolder::new("threads");
    let compiled = folder.compile(&everything());
    let mut films = [1, 2, 8].map(|n| threads(n, || render_all(&compiled))).into_iter();
    let (one, statistics) = films.next().unwrap();
    for (film, others) in films {
        assert_same_bits(&one, &film, 1.0, "threads");
        assert_eq!(one, film);
        assert_eq!(counted(&statistics), counted(&others));
    }
    assert!(compiled.scene.features.dispersion && statistics.light_paths > 0 && statistics.camera_paths > 0);
}

#[test]
fn compiling_on_other_threads_changes_no_bit() {
    let folder = SceneFolder::new("compile");
    let films = [1, 8].map(|n| threads(n, || folder.film(&everything())));
    assert_same_bits(&films[0], &films[1], 1.0, "compiling");
}

/// Forces all features on a scene and expects the same film.
fn check_features(name: &str, scene: &Value, needed: SceneFeatures) {
    let folder = SceneFolder::new(name);
    let compiled = folder.compile(scene);
    assert_eq!(compiled.scene.features, needed, "{name}");
    let (plain, statistics) = render_all(&compiled);
    let (forced, forced_statistics) = render_forced(&compiled);
    assert_same_bits(&plain, &forced, 1.0, name);
    assert_eq!((plain, counted(&statistics)), (forced, counted(&forced_statistics)), "{name}");
}

#[test]
fn features_that_a_scene_does_not_need_change_no_bit() {
    let mut scene = everything();
    for material in materials_of(&mut scene) {
        if material["type"] == "dielectric" {
            material["ior"] = json!(1.5);
        }
    }
    check_features("one-index", &scene, SceneFeatures { dispersion: false, interiors: true });

    let mut scene = everything();
    for material in materials_of(&mut scene) {
        if material["type"] == "dielectric" {
            *material = json!({ "type": "diffuse", "reflectance": 0.5 });
        }
    }
    check_features("no-glass", &scene, SceneFeatures { dispersion: false, interiors: false });
}

#[test]
fn lengths_times_a_power_of_two_change_no_bit() {
    let folder = SceneFolder::new("lengths");
    let (scene, film) = reference(&folder);
    let factor = f64::from(1 << 20);
    for factor in [factor, 1.0 / factor] {
        let mut scaled = scene.clone();
        multiply_lengths(&mut scaled, factor);
        assert_same_bits(&film, &folder.film(&scaled), 1.0, &format!("lengths × {factor}"));
    }
}

#[test]
fn light_times_a_power_of_two_is_the_film_times_it() {
    let folder = SceneFolder::new("light");
    let (scene, film) = reference(&folder);
    let factor = (1u64 << 33) as f64;
    for factor in [factor, 1.0 / factor] {
        let mut scaled = scene.clone();
        multiply_light(&mut scaled, factor);
        assert_same_bits(&film, &folder.film(&scaled), factor, &format!("light × {factor}"));
    }
}

/// Gives every entry of `materials` or `spectra` another name, so that their order is reversed.
fn rename(scene: &mut Value, key: &str) {
    let entries = std::mem::take(scene[key].as_object_mut().unwrap());
    let names: Vec<String> = entries.keys().cloned().collect();
    let new_name = |old: &str| {
        let rank = names.iter().position(|name| name == old).unwrap();
        format!("{:03} {old}", names.len() - rank)
    };
    let renamed = entries.into_iter().map(|(name, value)| (new_name(&name), value)).collect();
    scene[key] = Value::Object(renamed);
    if key == "materials" {
        for material in elements(scene, "objects").filter_map(|object| object.get_mut("material")) {
            *material = json!(new_name(material.as_str().unwrap()));
        }
    } else {
        rename_in(scene, &|text| names.iter().any(|name| name == text).then(|| new_name(text)));
    }
}

/// Renames strings that stand for spectra: whole values other than materials and types.
fn rename_in(value: &mut Value, new_name: &impl Fn(&str) -> Option<String>) {
    match value {
        Value::String(text) => {
            if let Some(new) = new_name(text) {
                *text = new;
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| rename_in(item, new_name)),
        Value::Object(map) => {
            map.iter_mut()
                .filter(|(key, _)| !["material", "type"].contains(&key.as_str()))
                .for_each(|(_, item)| rename_in(item, new_name));
        }
        _ => {}
    }
}

#[test]
fn names_order_and_unused_entries_change_no_bit() {
    let folder = SceneFolder::new("names");
    let (scene, film) = reference(&folder);
    let mut changed = scene.clone();
    rename(&mut changed, "spectra");
    rename(&mut changed, "materials");
    assert_ne!(changed, scene);
    assert_same_bits(&film, &folder.film(&changed), 1.0, "names");

    let mut changed = scene.clone();
    changed["materials"]["a spare one"] = json!({ "type": "dielectric", "ior": { "glass": "N-BK7" } });
    changed["spectra"]["a spare one"] = json!({ "wavelengths_nm": [400, 700], "values": [0.1, 0.9] });
    assert_same_bits(&film, &folder.film(&changed), 1.0, "unused entries");
}

#[test]
fn passes_change_no_bit() {
    let folder = SceneFolder::new("passes");
    let mut scene = everything();
    scene["render"]["samples_per_pixel"] = json!(17);
    let compiled = folder.compile(&scene);
    let samples = compiled.render.samples_per_pixel;
    // A pass that seems to have taken long is followed by a shorter one.
    let with_delay = |delay: Duration| {
        let mut seen = Vec::new();
        let proceed = &mut |progress: Progress| {
            seen.push(progress.samples);
            std::thread::sleep(delay);
            true
        };
        let film = render(&compiled.scene, &compiled.render, &compiled.film, proceed).film;
        (film, seen)
    };
    let (slow, slow_passes) = with_delay(Duration::from_millis(310));
    let (fast, fast_passes) = with_delay(Duration::ZERO);
    assert!(slow_passes.len() > fast_passes.len(), "{slow_passes:?} {fast_passes:?}");
    assert_eq!(slow_passes.last(), Some(&samples));
    assert_same_bits(&slow, &fast, 1.0, "passes");
    assert_eq!(slow, fast);
}

/// A render that is stopped where the split of its work would have been looked at again is one of so many samples.
#[test]
fn an_interrupted_render_is_one_of_fewer_samples() {
    let folder = SceneFolder::new("interrupted");
    let mut scene = everything();
    scene["render"]["samples_per_pixel"] = json!(16);
    let compiled = folder.compile(&scene);
    let stop = &mut |progress: Progress| progress.samples < 8;
    let Rendering { film, statistics, .. } = render(&compiled.scene, &compiled.render, &compiled.film, stop);
    assert!(!statistics.complete && film.camera_paths() > 0 && film.light_paths() > 0);
    scene["render"]["samples_per_pixel"] = json!(8);
    assert_same_bits(&film, &folder.film(&scene), 1.0, "interrupted");
}

#[test]
fn another_seed_gives_another_film() {
    let folder = SceneFolder::new("seed");
    let (mut scene, film) = reference(&folder);
    scene["render"]["seed"] = json!(8);
    let other = folder.film(&scene);
    let same = film.to_image().triples().iter().zip(other.to_image().triples()).filter(|(a, b)| a == b).count();
    assert!(same < 5, "{same} pixels are the same");
}
