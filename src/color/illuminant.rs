//! The standard illuminants by name.

use super::{Observer, normalized_to_unit_luminance, table};
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, Result, math};
use std::sync::LazyLock;

/// The tables of data/illuminants, one a family.
const FAMILIES: [&str; 5] = [
    include_str!("../../data/illuminants/standard.csv"),
    include_str!("../../data/illuminants/fluorescent.csv"),
    include_str!("../../data/illuminants/fluorescent_3.csv"),
    include_str!("../../data/illuminants/high_pressure.csv"),
    include_str!("../../data/illuminants/led.csv"),
];

static D65: LazyLock<Spectrum> =
    LazyLock::new(|| by_name("D65").expect("data/illuminants/standard.csv has a column D65 of positive luminance"));

/// Names of all illuminants: A, B, C, D50 … D75, E, ID50, ID65, FL1 … FL12, FL3.1 … FL3.15, HP1 … HP5, LED-B1 … LED-V2.
pub fn names() -> impl Iterator<Item = &'static str> {
    FAMILIES.into_iter().flat_map(table::column_names)
}

/// An illuminant of CIE 15 \[CIE15\], scaled to Y = 1: ∫ S ȳ dλ = ∫ ȳ dλ.
///
/// The samples are joined by straight lines and held constant beyond the table's ends (380 or 300 nm, 780 or 830 nm).
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn by_name(name: &str) -> Result<Spectrum> {
    let table = Spectrum::PiecewiseLinear(relative_power(name)?);
    normalized_to_unit_luminance(table, Observer::cie_1931_2deg())
}

/// An illuminant's samples as published: relative spectral power, not normalised.
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn relative_power(name: &str) -> Result<PiecewiseLinear> {
    match FAMILIES.into_iter().find(|text| table::column_names(text).any(|n| n == name)) {
        Some(text) => table::column(text, name),
        None => {
            Err(Error::unknown_name_of("illuminant", name, "a CIE name such as \"D65\", \"A\" or \"FL11\"", names()))
        }
    }
}

/// Relative spectral power of CIE standard illuminant A by its formula, 100 at 560 nm: a Planckian radiator of 2848 K with
/// c₂ = 1.435·10⁻² m·K \[CIE15\], at a positive wavelength in nm.
pub fn standard_a(lambda_nm: f64) -> f64 {
    let exponential = |lambda_nm: f64| math::exp_m1(1.435e7 / (2848.0 * lambda_nm));
    let ratio = 560.0 / lambda_nm;
    let ratio_2 = ratio * ratio;
    100.0 * ratio_2 * ratio_2 * ratio * exponential(560.0) / exponential(lambda_nm)
}

/// CIE D65 at Y = 1.
pub fn d65() -> &'static Spectrum {
    &D65
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::color::{chromaticity, xyz_of_emission};

    #[test]
    fn every_name_gives_a_positive_table_of_unit_luminance() {
        assert_eq!(names().count(), 52);
        for name in names() {
            let spectrum = by_name(name).unwrap();
            let y = xyz_of_emission(&spectrum, Observer::cie_1931_2deg()).y;
            assert!((y - 1.0).abs() < 1e-14, "{name}: {y}");
            assert!(spectrum.range().0 >= 0.0, "{name}");
            assert!(relative_power(name).unwrap().lambdas_nm().len() >= 81, "{name}");
        }
    }

    #[test]
    fn chromaticities_are_the_published_ones() {
        // CIE 15, tables T.3 and T.8, from sums at 5 nm; the exact integral differs by less than 5e-5, by up to 3e-4 for C
        // and for lamps with lines.
        let published = [
            ("A", 0.44758, 0.40745),
            ("C", 0.31006, 0.31616),
            ("D50", 0.34567, 0.35851),
            ("D55", 0.33243, 0.34744),
            ("D65", 0.31272, 0.32903),
            ("D75", 0.29903, 0.31488),
            ("E", 0.33333, 0.33333),
            ("FL2", 0.3721, 0.3751),
            ("FL7", 0.3129, 0.3292),
            ("FL11", 0.3805, 0.3769),
        ];
        for (name, x, y) in published {
            let xy = chromaticity(xyz_of_emission(&by_name(name).unwrap(), Observer::cie_1931_2deg()));
            let tolerance = if name.starts_with("FL") || name == "C" { 3e-4 } else { 5e-5 };
            assert!((xy[0] - x).abs() < tolerance && (xy[1] - y).abs() < tolerance, "{name}: {xy:?}");
        }
    }

    #[test]
    fn illuminant_a_follows_its_formula() {
        let table = relative_power("A").unwrap();
        for (lambda, value) in table.knots() {
            assert!((standard_a(lambda) / value - 1.0).abs() < 5e-6, "{lambda}: {value}");
        }
    }

    #[test]
    fn equal_energy_is_a_constant() {
        assert_eq!(by_name("E").unwrap(), Spectrum::Constant(1.0));
        assert_eq!(relative_power("E").unwrap().values()[0], 100.0);
    }

    #[test]
    fn an_unknown_name_suggests_the_nearest() {
        for (wrong, right) in [("d65", "D65"), ("F11", "FL11"), ("LED-RGB", "LED-RGB1")] {
            let error = by_name(wrong).unwrap_err();
            assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some(right)));
        }
    }
}
