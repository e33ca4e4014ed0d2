//! Measured reflectances and lamps of data/, by name.
//!
//! Names are in lower case with hyphens: "colorchecker-n-ohta", "dark-skin", "f32t8-tl830-triphosphor".

use super::table;
use crate::spectrum::Spectrum;
use crate::{Error, Result};

/// Names and tables of data/reflectances.
const CHECKERS: [(&str, &str); 4] = [
    ("babelcolor-average", include_str!("../../data/reflectances/babelcolor_average.csv")),
    ("colorchecker-n-ohta", include_str!("../../data/reflectances/colorchecker_n_ohta.csv")),
    ("iso-17321-1", include_str!("../../data/reflectances/iso_17321_1.csv")),
    ("pmc", include_str!("../../data/reflectances/preferred_memory_colors.csv")),
];

/// The tables of data/lamps, one a family.
const LAMPS: [&str; 5] = [
    include_str!("../../data/lamps/pointer.csv"),
    include_str!("../../data/lamps/nist_traditional.csv"),
    include_str!("../../data/lamps/nist_led.csv"),
    include_str!("../../data/lamps/nist_philips.csv"),
    include_str!("../../data/lamps/projectors.csv"),
];

/// Names of the charts: ColorChecker Classic as averaged by BabelColor, as measured by Ohta and as in ISO 17321-1 (the
/// same samples), and the preferred memory colours by Luo.
pub fn checkers() -> impl Iterator<Item = &'static str> {
    CHECKERS.into_iter().map(|(name, _)| name)
}

/// The patches of a chart in its order: name and reflectance as measured, every 5 or 10 nm.
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn checker(name: &str) -> Result<Vec<(&'static str, Spectrum)>> {
    let Some((_, text)) = CHECKERS.into_iter().find(|(known, _)| *known == name) else {
        return Err(Error::unknown_name("chart", name, checkers()));
    };
    table::column_names(text).map(|patch| Ok((patch, Spectrum::PiecewiseLinear(table::column(text, patch)?)))).collect()
}

/// Names of the measured lamps: 8 of Pointer's, 47 of the NIST colour quality simulation, a projector's xenon arc.
pub fn lamps() -> impl Iterator<Item = &'static str> {
    LAMPS.into_iter().flat_map(table::column_names)
}

/// A lamp's relative spectral power as published, every 5 nm (the xenon arc: 2 nm); not normalised.
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn lamp(name: &str) -> Result<Spectrum> {
    match LAMPS.into_iter().find(|text| table::column_names(text).any(|known| known == name)) {
        Some(text) => table::column(text, name).map(Spectrum::PiecewiseLinear),
        None => Err(Error::unknown_name_of("lamp", name, "a name such as \"cool-white-fl\" or \"hps\"", lamps())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::color::{Observer, chromaticity, illuminant, xyz_of_emission, xyz_of_reflectance};
    use std::collections::BTreeSet;

    #[test]
    fn every_patch_reflects_between_nothing_and_everything() {
        let sizes: Vec<usize> = checkers()
            .map(|name| {
                let patches = checker(name).unwrap();
                for (patch, spectrum) in &patches {
                    let (least, most) = spectrum.range();
                    assert!(0.0 < least && most < 1.0, "{name} {patch}: {least} {most}");
                }
                patches.len()
            })
            .collect();
        assert_eq!(sizes, [24, 24, 24, 30]);
    }

    #[test]
    fn the_white_patch_is_nearly_white_and_the_red_one_red() {
        let patches = checker("colorchecker-n-ohta").unwrap();
        let xyz = |name: &str| {
            let spectrum = &patches.iter().find(|patch| patch.0 == name).unwrap().1;
            xyz_of_reflectance(spectrum, illuminant::d65(), Observer::cie_1931_2deg())
        };
        let white = xyz("white-9.5-.05-d");
        assert!(white.y > 0.85 && (chromaticity(white)[0] - 0.3127).abs() < 3e-3, "{white}");
        assert!(chromaticity(xyz("red"))[0] > 0.5);
    }

    #[test]
    fn every_lamp_shines() {
        let names: BTreeSet<_> = lamps().collect();
        assert_eq!((names.len(), lamps().count()), (56, 56));
        for name in names {
            let lamp = lamp(name).unwrap();
            assert!(lamp.range().0 >= 0.0 && xyz_of_emission(&lamp, Observer::cie_1931_2deg()).y > 0.0, "{name}");
        }
    }

    #[test]
    fn an_unknown_name_suggests_the_nearest() {
        let error = checker("colorchecker").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("colorchecker-n-ohta")));
        let error = lamp("Kinoton 75P").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("kinoton-75p")));
    }
}
