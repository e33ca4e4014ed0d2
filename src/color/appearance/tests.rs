use super::*;

fn book() -> ViewingConditions {
    ViewingConditions {
        white_xyz: DVec3::new(0.9505, 1.0, 1.0888),
        adapting_luminance: 318.31,
        background_y: 0.2,
        surround: Surround::AVERAGE,
        discount_illuminant: false,
    }
}

/// Every model under every surround at four levels of adaptation, with the scale of its XYZ.
fn models() -> Vec<(String, AppearanceModel, DVec3)> {
    let mut models = Vec::new();
    for name in AppearanceModel::names() {
        for surround in Surround::names() {
            for adapting_luminance in [0.2, 4.0, 64.0, 2000.0] {
                let scale = if name == "zcam" { 5.0 * adapting_luminance } else { 1.0 };
                let white_xyz = DVec3::new(0.9642, 1.0, 0.8252) * scale;
                let conditions = ViewingConditions {
                    white_xyz,
                    adapting_luminance,
                    background_y: 0.2 * scale,
                    surround: Surround::by_name(surround).unwrap(),
                    discount_illuminant: surround == "dim",
                };
                let model = AppearanceModel::by_name(name, &conditions).unwrap();
                models.push((format!("{name} {surround} {adapting_luminance}"), model, white_xyz));
            }
        }
    }
    models
}

fn colors() -> impl Iterator<Item = DVec3> {
    let steps = [0.001, 0.02, 0.2, 0.55, 1.0];
    let grid = steps.into_iter().flat_map(move |x| steps.into_iter().map(move |y| (x, y)));
    grid.flat_map(move |(x, y)| [0.5, 1.0, 1.6].map(|z| DVec3::new(y * (0.7 + 0.5 * x), y, y * z)))
}

#[test]
fn models_have_the_values_of_their_publications() {
    let xyz = DVec3::new(0.1901, 0.20, 0.2178);
    let close = |value: f64, published: f64| (value - published).abs() < 1e-6 * published.abs().max(0.1);
    // Fairchild, Color Appearance Models, case 1 (J 41.73, C 0.1, h 219.0, s 2.36, Q 195.37, M 0.11, H 278.1), with more digits.
    let seen = Ciecam02::new(&book()).unwrap().appearance_from_xyz(xyz);
    let expected = [41.7310911, 0.1047077, 219.0484326, 2.3603053, 195.3713259, 0.1088421, 278.0607358];
    let values = [
        seen.lightness,
        seen.chroma,
        seen.hue_degrees,
        seen.saturation,
        seen.brightness,
        seen.colorfulness,
        seen.hue_quadrature,
    ];
    assert!(values.iter().zip(expected).all(|(v, e)| close(*v, e)), "{seen:?}");
    let seen = Cam16::new(&book()).unwrap().appearance_from_xyz(xyz);
    assert!(close(seen.lightness, 41.7312079) && close(seen.chroma, 0.1033557), "{seen:?}");
    assert!(close(seen.hue_degrees, 217.0679597) && close(seen.hue_quadrature, 275.5949861), "{seen:?}");
    let model = Hellwig2022::new(&book()).unwrap();
    let seen = model.appearance_from_xyz(xyz);
    let hk = model.helmholtz_kohlrausch(&seen);
    assert!(close(seen.chroma, 0.0257636) && close(seen.brightness, 55.8523226), "{seen:?}");
    assert!(close(hk.lightness, 41.8802782) && close(hk.brightness, 56.0518358), "{hk:?}");
}

#[test]
fn zcam_has_the_values_of_its_supplement() {
    // Two of the worked examples, to the digits that their rounded intermediate values leave.
    let conditions = ViewingConditions {
        white_xyz: DVec3::new(256.0, 264.0, 202.0),
        adapting_luminance: 264.0,
        background_y: 100.0,
        ..book()
    };
    let model = Zcam::new(&conditions).unwrap();
    let examples = [
        (DVec3::new(185.0, 206.0, 163.0), [92.2520, 3.0216, 196.3524, 321.3464, 10.5252, 237.6401, 34.7022, 91.6837]),
        (DVec3::new(89.0, 96.0, 120.0), [71.2071, 6.8539, 250.6422, 248.0394, 23.8744, 307.0595, 18.2796, 70.4026]),
    ];
    for (xyz, published) in examples {
        let seen = model.appearance_from_xyz(xyz);
        let scales = Zcam::scales(&seen);
        let values = [
            seen.lightness,
            seen.chroma,
            seen.hue_degrees,
            seen.brightness,
            seen.colorfulness,
            seen.hue_quadrature,
            scales.vividness,
            scales.whiteness,
        ];
        for (value, published) in values.into_iter().zip(published) {
            assert!((value / published - 1.0).abs() < 5e-4, "{values:?}");
        }
    }
}

#[test]
fn the_white_is_white_and_black_is_black() {
    for (name, model, white) in models() {
        let seen = model.appearance_from_xyz(white);
        // CIECAM models: exact by definition. ZCAM compares the adapted white with the white as it is.
        let tolerance = if name.starts_with("zcam") { 25.0 } else { 1e-10 };
        assert!((seen.lightness - 100.0).abs() < tolerance, "{name}: {seen:?}");
        let black = model.appearance_from_xyz(DVec3::ZERO);
        let sizes = [black.lightness, black.chroma, black.brightness, black.colorfulness, black.saturation];
        // I_z of black is 0 to the digits of the constant that makes it so; small powers of what is left are not small.
        let tolerance = if name.starts_with("zcam") { 2e-3 } else { 0.0 };
        assert!(sizes[..2].iter().all(|size| size.abs() <= tolerance), "{name}: {black:?}");
        assert!(sizes.iter().all(|size| size.is_finite()), "{name}: {black:?}");
    }
}

#[test]
fn colors_return() {
    for (name, model, white) in models() {
        for color in colors() {
            let xyz = color * white;
            let seen = model.appearance_from_xyz(xyz);
            for back in [model.xyz_from_jch(seen.jch()), model.xyz_from_jmh(seen.jmh())] {
                let error = (back - xyz).abs().max_element() / xyz.max_element();
                assert!(error < 1e-10, "{name}: {xyz} {back}, {seen:?}");
            }
        }
    }
}

#[test]
fn every_finite_color_has_a_finite_appearance() {
    for (name, model, white) in models() {
        for color in
            [DVec3::new(-0.5, 0.01, 0.3), DVec3::new(0.3, -0.2, -0.1), DVec3::splat(50.0), DVec3::new(0.0, 0.0, 1.0)]
        {
            let seen = model.appearance_from_xyz(color * white);
            let finite = [seen.lightness, seen.chroma, seen.brightness, seen.colorfulness, seen.saturation];
            assert!(finite.iter().all(|x| x.is_finite()), "{name}: {color} {seen:?}");
            assert!((0.0..360.0).contains(&seen.hue_degrees) && (0.0..400.0).contains(&seen.hue_quadrature), "{name}");
        }
    }
}

#[test]
fn negative_responses_return_from_the_models_that_have_no_pole_there() {
    for (name, model, white) in models().into_iter().filter(|m| m.0.starts_with("zcam") || m.0.starts_with("ciecam16"))
    {
        for color in [DVec3::new(0.1, 0.3, -0.05), DVec3::new(0.5, 0.1, 0.02), DVec3::new(0.1, 0.02, 0.9)] {
            let seen = model.appearance_from_xyz(color * white);
            let back = model.xyz_from_jch(seen.jch()) / white;
            assert!((back - color).abs().max_element() < 1e-9, "{name}: {color} {back} {seen:?}");
        }
    }
}

#[test]
fn hue_quadrature_passes_the_unique_hues_without_steps() {
    let hues = &response::UNIQUE_HUES;
    for (i, degrees) in hues.degrees.into_iter().enumerate() {
        assert!((hues.quadrature(degrees) - 100.0 * i as f64).abs() < 1e-12, "{degrees}");
    }
    let mut last = hues.quadrature(hues.degrees[0]);
    for step in 1..3600 {
        let here = hues.quadrature((hues.degrees[0] + 0.1 * f64::from(step)) % 360.0);
        assert!(here > last && here - last < 0.35, "{step}: {last} {here}");
        last = here;
    }
    assert!((last - 400.0).abs() < 0.35, "{last}");
}

#[test]
fn the_helmholtz_kohlrausch_effect_lightens_colors_and_returns() {
    let model = Hellwig2022::new(&book()).unwrap();
    for color in colors() {
        let seen = model.appearance_from_xyz(color);
        let hk = model.helmholtz_kohlrausch(&seen);
        assert!(hk.lightness >= seen.lightness && hk.brightness >= seen.brightness, "{color}");
        let back = model.xyz_from_jch_hk(DVec3::new(hk.lightness, seen.chroma, seen.hue_degrees));
        assert!((back - color).abs().max_element() < 1e-10, "{color} {back}");
    }
}

#[test]
fn ciecam16_is_cam16_between_its_straight_ends() {
    let (straight, curved) = (Ciecam16::new(&book()).unwrap(), Cam16::new(&book()).unwrap());
    let grey = DVec3::new(0.3, 0.31, 0.29);
    assert_eq!(straight.appearance_from_xyz(grey), curved.appearance_from_xyz(grey));
    for beyond in [grey * 0.004, grey * 8.0] {
        let difference = straight.appearance_from_xyz(beyond).lightness - curved.appearance_from_xyz(beyond).lightness;
        assert!(difference.abs() > 1e-3, "{difference}");
    }
    // Continuous with its slope where the upper line begins: Y ≈ 1.5.
    let j = |y: f64| straight.appearance_from_xyz(book().white_xyz * y).lightness;
    let slopes = [(j(1.4999) - j(1.4989)) / 0.001, (j(1.5011) - j(1.5001)) / 0.001];
    assert!((slopes[0] / slopes[1] - 1.0).abs() < 2e-3, "{slopes:?}");
}

#[test]
fn uniform_spaces_return_and_measure() {
    for name in UniformSpace::names() {
        let space = UniformSpace::by_name(name).unwrap();
        for jmh in [DVec3::new(50.0, 30.0, 200.0), DVec3::new(0.1, 90.0, 359.0), DVec3::new(99.0, 1e-6, 5.0)] {
            let back = space.jmh_from_ucs(space.ucs_from_jmh(jmh));
            assert!((back - jmh).abs().max_element() < 1e-9, "{name}: {jmh} {back}");
        }
        let [a, b] = [DVec3::new(10.0, 3.0, 4.0), DVec3::new(10.0, 0.0, 0.0)];
        assert!((space.difference(a, b) - 5.0).abs() < 1e-14);
        let lighter = a + DVec3::X;
        assert!((space.difference(a, lighter) - 1.0 / space.lightness_divisor).abs() < 1e-14);
        assert!((space.ucs_from_jmh(DVec3::new(100.0, 0.0, 0.0)).x - 100.0).abs() < 1e-12);
    }
}

#[test]
fn conditions_out_of_range_and_unknown_names_are_errors() {
    let wrong = [
        ViewingConditions { adapting_luminance: 0.0, ..book() },
        ViewingConditions { background_y: f64::NAN, ..book() },
        ViewingConditions { white_xyz: DVec3::new(0.9, 0.0, 1.0), ..book() },
        ViewingConditions { white_xyz: DVec3::new(0.9, 1.0, -1.0), ..book() },
        ViewingConditions { white_xyz: DVec3::new(f64::INFINITY, 1.0, 1.0), ..book() },
    ];
    for conditions in wrong {
        for name in AppearanceModel::names() {
            let error = AppearanceModel::by_name(name, &conditions).unwrap_err();
            assert_eq!(error.kind, ErrorKind::OutOfRange, "{name}: {error}");
        }
    }
    let error = AppearanceModel::by_name("CAM-16", &book()).unwrap_err();
    assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("cam16")));
    assert_eq!(Surround::by_name("darl").unwrap_err().nearest.as_deref(), Some("dark"));
    assert_eq!(UniformSpace::by_name("uc").unwrap_err().nearest.as_deref(), Some("ucs"));
}
