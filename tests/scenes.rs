//! Every scene in scenes/ and every recipe renders: no lost samples, no glass left that was never entered, not black.

use std::path::PathBuf;

use abbe::render::{Rendering, render};
use abbe::scene::compile;
use abbe::scene::description::parse_file;

fn scenes() -> Vec<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let folders = [root.clone(), root.join("recipes")];
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let mut scenes: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
    scenes.sort();
    assert!(scenes.len() >= 25);
    scenes
}

#[test]
fn every_scene_renders() {
    for path in scenes() {
        let name = path.display();
        let parsed = parse_file(&path).unwrap_or_else(|e| panic!("{e}"));
        assert!(parsed.warnings.is_empty(), "{name}: {:?}", parsed.warnings);
        let mut description = parsed.description;
        description.film.height = (48 * description.film.height / description.film.width).max(1);
        description.film.width = 48;
        description.render.samples_per_pixel = 4;
        let compiled = compile(&description).unwrap_or_else(|e| panic!("{e}"));

        let Rendering { film, statistics, .. } =
            render(&compiled.scene, &compiled.render, &compiled.film, &mut |_| true);
        assert!(statistics.complete, "{name}");
        assert_eq!(film.non_finite_samples, 0, "{name}");
        let (underflows, rays) = (statistics.counters.medium_underflows, statistics.counters.rays);
        assert!(underflows as f64 <= 1e-6 * rays as f64, "{name}: {underflows} underflows in {rays} rays");
        let picture = film.to_image();
        let xyz = picture.triples();
        assert!(xyz.iter().flatten().all(|v| v.is_finite()), "{name}");
        let lit = xyz.iter().filter(|xyz| xyz[1] > 0.0).count();
        assert!(2 * lit > xyz.len(), "{name}: only {lit} of {} pixels are lit", xyz.len());
    }
}
