use super::*;
use crate::color::{Observer, xyz_of_emission};
use crate::spectrum::Spectrum;

#[test]
fn srgb_has_the_published_matrices() {
    // IEC 61966-2-1 prints four digits, of white D65 with the same rounding.
    let published = RgbSpace::by_name("srgb-published").unwrap();
    assert_eq!(published.rgb_from_xyz.row(0), DVec3::new(3.2406, -1.5372, -0.4986));
    assert_eq!(published.xyz_from_rgb.row(1), DVec3::new(0.2126, 0.7152, 0.0722));
    assert!(RgbSpace::srgb().rgb_from_xyz.abs_diff_eq(published.rgb_from_xyz, 5e-4));
    assert!(RgbSpace::srgb().xyz_from_rgb.abs_diff_eq(published.xyz_from_rgb, 5e-5));
}

#[test]
fn published_matrices_are_near_the_derived_ones() {
    for space in RgbSpace::published() {
        let derived = RgbSpace::by_name(space.name.strip_suffix("-published").unwrap()).unwrap();
        assert!(space.xyz_from_rgb.abs_diff_eq(derived.xyz_from_rgb, 2.1e-4), "{}", space.name);
        assert!((space.rgb_from_xyz * space.xyz_from_rgb).abs_diff_eq(DMat3::IDENTITY, 2e-4), "{}", space.name);
        assert_eq!((space.primaries, space.white), (derived.primaries, derived.white));
    }
}

#[test]
fn matrices_cancel_and_take_one_to_white() {
    for space in RgbSpace::all() {
        let identity = space.rgb_from_xyz * space.xyz_from_rgb;
        assert!(identity.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{}", space.name);
        let white = space.xyz_from_linear(LinearRgb(DVec3::ONE));
        assert!((white - space.white_xyz()).abs().max_element() < 5e-15, "{}", space.name);
        assert!((space.luminance(LinearRgb(DVec3::ONE)) - 1.0).abs() < 5e-15, "{}", space.name);
    }
}

#[test]
fn primaries_have_their_chromaticities() {
    for space in RgbSpace::all() {
        for (axis, [x, y]) in DMat3::IDENTITY.to_cols_array_2d().into_iter().zip(space.primaries) {
            let xyz = space.xyz_from_linear(axis.into());
            assert!((xyz / xyz.element_sum() - DVec3::new(x, y, 1.0 - x - y)).abs().max_element() < 1e-14);
        }
    }
}

#[test]
fn unit_radiance_develops_to_the_documented_rgb() {
    let xyz = xyz_of_emission(&Spectrum::Constant(1.0), Observer::cie_1931_2deg());
    let rgb = RgbSpace::srgb().linear_from_xyz(xyz);
    assert!((rgb.0 - DVec3::new(1.205, 0.948, 0.909)).abs().max_element() < 5e-4, "{rgb:?}");
}

#[test]
fn encoding_is_inverted_component_by_component() {
    let linear = LinearRgb::new(0.02, 0.3, 0.9);
    for space in RgbSpace::all().iter().filter(|space| space.name != "acesproxy") {
        let encoded = space.encode(linear);
        assert_eq!(encoded.0.y, space.transfer.encode(0.3));
        let back = space.decode(encoded);
        assert!((back.0 - linear.0).abs().max_element() < 2e-5, "{}: {back:?}", space.name);
    }
}

#[test]
fn spaces_convert_into_each_other() {
    let (srgb, acescg) = (RgbSpace::srgb(), RgbSpace::by_name("acescg").unwrap());
    let there = acescg.rgb_from(srgb, Some(ConeTransform::Bradford));
    assert!((there * DVec3::ONE - 1.0).abs().max_element() < 1e-14);
    let both = srgb.rgb_from(acescg, Some(ConeTransform::Bradford)) * there;
    assert!(both.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{both}");
    // Unadapted, the colour is the same and white is not.
    let unadapted = acescg.rgb_from(srgb, None);
    assert_eq!(unadapted, acescg.rgb_from_xyz * DMat3::IDENTITY * srgb.xyz_from_rgb);
    assert!((unadapted * DVec3::ONE - 1.0).abs().max_element() > 0.01);
}

#[test]
fn names_are_unique_and_unknown_ones_suggest_the_nearest() {
    let names: Vec<_> = RgbSpace::names().collect();
    let unique: std::collections::HashSet<_> = names.iter().collect();
    assert_eq!(names.len(), unique.len());
    for name in names {
        assert!(RgbSpace::by_name(name).is_ok(), "{name}");
    }
    assert_eq!(RgbSpace::by_name("rec2020").unwrap().white, [0.3127, 0.3290]);
    assert_eq!(RgbSpace::by_name("a98-rgb").unwrap().name, "adobe-rgb");
    let error = RgbSpace::by_name("sRGB").unwrap_err();
    assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("srgb")));
}

#[test]
fn impossible_spaces_are_errors() {
    let new = |primaries, white| RgbSpace::new("mine", primaries, white, Transfer::Linear);
    let triangle = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
    assert_eq!(new(triangle, [0.3127, 0.3290]).unwrap().xyz_from_rgb, RgbSpace::srgb().xyz_from_rgb);
    let line = [[0.0, 0.0], [0.25, 0.25], [0.5, 0.5]];
    assert_eq!(new(line, [0.3127, 0.3290]).unwrap_err().kind, ErrorKind::Degenerate);
    assert_eq!(new(triangle, [0.3, 0.0]).unwrap_err().kind, ErrorKind::OutOfRange);
    assert_eq!(new(triangle, [f64::NAN, 0.3]).unwrap_err().kind, ErrorKind::NotFinite);
}
