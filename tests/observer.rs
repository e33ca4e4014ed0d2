//! A film records the XYZ of the observer that the scene names: lamps of several spectra, seen directly, against the
//! integrals of their spectra in the colour library.

#[path = "common/render.rs"]
mod common;

use abbe::color::{Observer, xyz_of_emission};
use abbe::film::Film;
use abbe::spectrum::{PiecewiseLinear, Spectrum};
use common::{render_json, with};
use serde_json::{Value, json};

/// Flat, sloped and narrow: the last lies where observers differ most.
const SPECTRA: [(&[f64], &[f64]); 4] = [
    (&[360.0, 830.0], &[1.0, 1.0]),
    (&[360.0, 830.0], &[0.2, 2.0]),
    (&[360.0, 430.0, 450.0, 470.0, 830.0], &[0.0, 0.0, 1.0, 0.0, 0.0]),
    (&[360.0, 480.0, 490.0, 510.0, 520.0, 830.0], &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0]),
];

/// One lamp before the camera that fills the picture.
fn scene((lambda_nm, values): (&[f64], &[f64])) -> Value {
    json!({
        "camera": { "type": "perspective", "from": [0, 0, 1], "to": [0, 0, 0] },
        "film": { "width": 16, "height": 16 },
        "render": { "samples_per_pixel": 64 },
        "objects": [],
        "environment": { "radiance": { "wavelengths_nm": lambda_nm, "values": values } }
    })
}

fn mean(film: &Film) -> [f64; 3] {
    let picture = film.to_image();
    let pixels = picture.triples();
    std::array::from_fn(|c| pixels.iter().map(|xyz| xyz[c]).sum::<f64>() / pixels.len() as f64)
}

#[test]
fn films_hold_the_xyz_of_their_observer() {
    for (lambda_nm, values) in SPECTRA {
        let spectrum = Spectrum::PiecewiseLinear(PiecewiseLinear::new(lambda_nm.to_vec(), values.to_vec()).unwrap());
        for name in Observer::names() {
            let scene =
                with(&scene((lambda_nm, values)), "/film", json!({ "width": 16, "height": 16, "observer": name }));
            let found = mean(&render_json(&scene).0);
            let expected = xyz_of_emission(&spectrum, Observer::by_name(name).unwrap()).to_array();
            let largest = expected.into_iter().fold(0.0, f64::max);
            for c in 0..3 {
                let off = (found[c] - expected[c]).abs() / largest;
                assert!(off < 1e-3, "{name}, {values:?}: {found:?}, not {expected:?}");
            }
        }
    }
}

/// The observers do differ where it matters, and the film is 1931's unless it is told otherwise.
#[test]
fn the_default_is_1931() {
    let scene = scene(SPECTRA[3]);
    let default = mean(&render_json(&scene).0);
    let of = |name: &str| {
        let film = json!({ "width": 16, "height": 16, "observer": name });
        mean(&render_json(&with(&scene, "/film", film)).0)
    };
    assert_eq!(default, of("1931-2"));
    assert!(["1964-10", "2015-2", "2015-10"].iter().all(|name| (of(name)[1] / default[1] - 1.0).abs() > 0.01));
}
