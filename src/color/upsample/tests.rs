use super::*;
use crate::color::srgb_decode;
use proptest::prelude::*;

/// n³ colours uniform in encoded sRGB.
fn cube(n: usize) -> Vec<[f64; 3]> {
    let level = |i: usize| srgb_decode(i as f64 / (n - 1) as f64);
    (0..n * n * n).map(|i| [level(i / n / n), level(i / n % n), level(i % n)]).collect()
}

fn largest_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (DVec3::from(a) - DVec3::from(b)).abs().max_element()
}

#[test]
fn the_srgb_cube_makes_the_round_trip_within_bounds() {
    let mut worst = 0.0_f64;
    for rgb in cube(9) {
        for method in [Method::Natural, Method::Smoothest] {
            let spectrum = reflectance_by(method, rgb, RgbSpace::srgb()).unwrap();
            let (least, most) = spectrum.range();
            let is_end = rgb == [0.0; 3] || rgb == [1.0; 3];
            assert!(is_end || (0.0 < least && most < 1.0), "{method:?} {rgb:?}: {least} {most}");
            worst = worst.max(largest_difference(rgb_of_reflectance(&spectrum, RgbSpace::srgb()), rgb));
        }
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn greys_are_constant_and_the_ends_exact() {
    for grey in [0.0, 1e-9, 0.18, 0.5, 1.0] {
        for space in RgbSpace::all() {
            for method in [Method::Natural, Method::Smoothest, Method::JakobHanika, Method::Meng] {
                assert_eq!(reflectance_by(method, [grey; 3], space).unwrap(), Spectrum::Constant(grey));
            }
        }
    }
    let white = rgb_of_reflectance(&Spectrum::Constant(1.0), RgbSpace::srgb());
    assert!(largest_difference(white, [1.0; 3]) < 1e-14);
}

#[test]
fn dark_and_light_colours_are_solved_relative_to_their_size() {
    let nearly = 1.0 - 1e-7;
    for rgb in [[1e-9, 0.0, 0.0], [0.0, 1e-7, 1e-7], [1.0, 1.0, nearly], [nearly, 1.0, 1.0], [1.0, nearly, 1.0]] {
        for method in [Method::Natural, Method::Smoothest] {
            let spectrum = reflectance_by(method, rgb, RgbSpace::srgb()).unwrap();
            let back = rgb_of_reflectance(&spectrum, RgbSpace::srgb());
            let largest = rgb.into_iter().fold(0.0, f64::max);
            assert!(largest_difference(back, rgb) < 1e-9 * largest, "{rgb:?} {back:?}");
        }
    }
}

#[test]
fn neighbouring_colours_have_neighbouring_spectra() {
    // A step of 1e-4 in colour moves r by no more than 60 times that anywhere, saturated corners included.
    for rgb in cube(5) {
        let near = rgb.map(|c| if c > 0.5 { c - 1e-4 } else { c + 1e-4 });
        let near = [near[0], rgb[1], near[2]];
        for method in [Method::Natural, Method::Smoothest] {
            let [a, b] = [rgb, near].map(|rgb| reflectance_by(method, rgb, RgbSpace::srgb()).unwrap());
            let change = knots_nm().into_iter().map(|l| (a.eval(l) - b.eval(l)).abs()).fold(0.0, f64::max);
            assert!(change < 6e-3, "{method:?} {rgb:?}: {change}");
        }
    }
}

#[test]
fn emissions_have_the_colour_and_are_positive() {
    let mut worst = 0.0_f64;
    for rgb in cube(6) {
        let spectrum = emission(rgb, RgbSpace::srgb()).unwrap();
        assert!(spectrum.range().0 >= 0.0);
        let xyz = xyz_of_emission(&spectrum, Observer::cie_1931_2deg());
        let expected = RgbSpace::srgb().xyz_from_rgb * DVec3::from(rgb);
        worst = worst.max((xyz - expected).abs().max_element());
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn emissions_scale() {
    let unit = emission([0.2, 1.0, 0.4], RgbSpace::srgb()).unwrap();
    let bright = emission([2e6, 1e7, 4e6], RgbSpace::srgb()).unwrap();
    for lambda in [360.0, 450.0, 555.5, 830.0] {
        assert!((bright.eval(lambda) / unit.eval(lambda) - 1e7).abs() < 1.0);
    }
    assert_eq!(emission([0.0; 3], RgbSpace::srgb()).unwrap(), Spectrum::Constant(0.0));
}

#[test]
fn other_spaces_are_adapted_to_d65() {
    for space in RgbSpace::all() {
        let rgb = [0.35, 0.3, 0.25];
        let back = rgb_of_reflectance(&reflectance(rgb, space).unwrap(), space);
        assert!(largest_difference(back, rgb) < 1e-10, "{}: {back:?}", space.name);
        let back = rgb_of_emission(&emission(rgb, space).unwrap(), space);
        assert!(largest_difference(back, rgb) < 1e-10, "{}: {back:?}", space.name);
        let white = rgb_of_emission(&emission([1.0; 3], space).unwrap(), RgbSpace::srgb());
        assert!(largest_difference(white, [1.0; 3]) < 1e-10, "{}: {white:?}", space.name);
    }
}

#[test]
fn published_methods_have_roughly_the_colour() {
    // What they miss the colour by at most over the cube, and how far they exceed 1; measured in validation.
    let limits = [
        (Method::JakobHanika, 1e-10, 0.0),
        (Method::Mallett, 2e-3, 1e-8),
        (Method::Smits, 0.06, 0.015),
        (Method::SmitsLinear, 0.1, 0.015),
        (Method::Meng, 1e-9, 0.21),
    ];
    for (method, error, excess) in limits {
        for rgb in cube(5) {
            let spectrum = reflectance_by(method, rgb, RgbSpace::srgb()).unwrap();
            let (least, most) = spectrum.range();
            assert!(least >= 0.0 && most <= 1.0 + excess, "{method:?} {rgb:?}: {least} {most}");
            let back = rgb_of_reflectance(&spectrum, RgbSpace::srgb());
            assert!(largest_difference(back, rgb) <= error, "{method:?} {rgb:?}: {back:?}");
        }
    }
    for rgb in [[0.3, 0.25, 0.2], [0.1, 0.2, 0.15]] {
        let back = rgb_of_reflectance(&reflectance_by(Method::Otsu, rgb, RgbSpace::srgb()).unwrap(), RgbSpace::srgb());
        assert!(largest_difference(back, rgb) < 2e-3, "{rgb:?}: {back:?}");
    }
    for method in Method::ALL {
        assert_eq!(reflectance_by(method, [0.0; 3], RgbSpace::srgb()).unwrap(), Spectrum::Constant(0.0));
    }
    let rec2020 = RgbSpace::by_name("rec2020").unwrap();
    for method in [Method::Mallett, Method::Smits, Method::SmitsLinear, Method::JakobHanika] {
        assert!(reflectance_by(method, [0.0, 1.0, 0.0], rec2020).is_err());
    }
}

#[test]
fn lamps_are_tinted() {
    let lamp = illuminant::by_name("FL11").unwrap();
    for rgb in [[0.2, 1.0, 0.4], [3.0, 0.1, 0.0], [0.5; 3]] {
        let tinted = emission_of_lamp(rgb, RgbSpace::srgb(), &lamp).unwrap();
        assert!(tinted.range().0 >= 0.0);
        let observer = Observer::cie_1931_2deg();
        let target = Target::new(xyz_of_emission(&lamp, observer), EMISSION.weights.clone());
        let got = target.rgb_from_xyz * xyz_of_emission(&tinted, observer);
        // The lamp's samples are 5 nm apart, at whole nanometres: nothing of it is lost.
        assert!(largest_difference(got.into(), rgb) < 1e-9, "{rgb:?}: {got}");
    }
    let white = emission_of_lamp([1.0; 3], RgbSpace::srgb(), &lamp).unwrap();
    assert!((white.eval(545.0) / lamp.eval(545.0) - 1.0).abs() < 1e-15);
    assert!(emission_of_lamp([1.0; 3], RgbSpace::srgb(), &Spectrum::Constant(0.0)).is_err());
    assert!(emission_of_lamp([1.0, 0.5, 0.5], RgbSpace::srgb(), &Spectrum::Constant(-1.0)).is_err());
}

#[test]
fn impossible_colours_are_errors() {
    let rec2020 = RgbSpace::by_name("rec2020").unwrap();
    let error = reflectance([0.0, 1.0, 0.0], rec2020).unwrap_err();
    assert_eq!(error.kind, ErrorKind::OutOfRange);
    assert!(error.message.contains("cannot be a reflectance"), "{error}");
    let prophoto = RgbSpace::by_name("prophoto-rgb").unwrap();
    assert!(emission([0.0, 0.0, 1.0], prophoto).unwrap_err().message.contains("cannot be an emission"));
    for bad in [1.5, -0.1, f64::NAN, f64::INFINITY] {
        assert!(reflectance([0.5, bad, 0.5], RgbSpace::srgb()).is_err());
    }
    for bad in [-1e-12, f64::NAN, f64::INFINITY, 1e31] {
        assert!(emission([0.5, bad, 0.5], RgbSpace::srgb()).is_err());
    }
}

proptest! {
    #[test]
    fn any_srgb_colour_makes_the_round_trip(rgb in prop::array::uniform3(0.0..=1.0_f64)) {
        let spectrum = reflectance(rgb, RgbSpace::srgb()).unwrap();
        prop_assert!(largest_difference(rgb_of_reflectance(&spectrum, RgbSpace::srgb()), rgb) < 1e-9);
        let spectrum = emission(rgb, RgbSpace::srgb()).unwrap();
        prop_assert!(largest_difference(rgb_of_emission(&spectrum, RgbSpace::srgb()), rgb) < 1e-9);
    }
}
