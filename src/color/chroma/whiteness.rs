//! Indices of whiteness.
//!
//! XYZ has Y = 1 for the perfect diffuser, and indices are on the scale on which that has 100, where a formula has it so.
//! Every formula is for near-whites under a certain illuminant, which its documentation names; none checks it.

use crate::color::{chromaticity, space::lab_from_xyz};
use glam::DVec3;

/// A whiteness and its tint: positive is greenish, negative reddish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Whiteness {
    /// The whiter, the higher; 100 for the perfect diffuser.
    pub whiteness: f64,
    /// 0 for the neutral white.
    pub tint: f64,
}

/// The field of view that a formula has coefficients for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// 2°, CIE 1931.
    Degrees2,
    /// 10°, CIE 1964.
    Degrees10,
}

/// \[Berger1959\]: 0.333 Y + 125 Z/Z₀ − 125 X/X₀.
pub fn whiteness_berger1959(xyz: DVec3, white_xyz: DVec3) -> f64 {
    33.3 * xyz.y + 125.0 * (xyz.z / white_xyz.z) - 125.0 * (xyz.x / white_xyz.x)
}

/// \[Taube1960\]: 400 Z/Z₀ − 3 Y.
pub fn whiteness_taube1960(xyz: DVec3, white_xyz: DVec3) -> f64 {
    400.0 * (xyz.z / white_xyz.z) - 300.0 * xyz.y
}

/// \[Stensby1968\] of CIE Lab: L − 3 b + 3 a.
pub fn whiteness_stensby1968(lab: DVec3) -> f64 {
    lab.x - 3.0 * lab.z + 3.0 * lab.y
}

/// [`whiteness_stensby1968`] of XYZ.
pub fn whiteness_stensby1968_from_xyz(xyz: DVec3, white_xyz: DVec3) -> f64 {
    whiteness_stensby1968(lab_from_xyz(xyz, white_xyz))
}

/// ASTM E313 in its form of before 1998, for illuminant C \[ASTME313\]: 3.388 Z − 3 Y.
pub fn whiteness_astm_e313(xyz: DVec3) -> f64 {
    338.8 * xyz.z - 300.0 * xyz.y
}

/// \[Ganz1979\] for D65 and 10°, with the coefficients of the reference instrument. NaN for black.
pub fn whiteness_ganz1979(xyz: DVec3) -> Whiteness {
    let [x, y] = chromaticity(xyz);
    Whiteness {
        whiteness: 100.0 * xyz.y - 1868.322 * x - 3695.690 * y + 1809.441,
        tint: -1001.223 * x + 748.366 * y + 68.261,
    }
}

/// CIE 2004 for D65 \[CIE15\]; valid for whiteness from 40 to 5 Y − 280 (Y in per cent) and tints from −4 to 2. NaN for black.
pub fn whiteness_cie2004(xyz: DVec3, white_xyz: DVec3, field: Field) -> Whiteness {
    let ([x, y], [white_x, white_y]) = (chromaticity(xyz), chromaticity(white_xyz));
    let red = match field {
        Field::Degrees2 => 1000.0,
        Field::Degrees10 => 900.0,
    };
    Whiteness {
        whiteness: 100.0 * xyz.y + 800.0 * (white_x - x) + 1700.0 * (white_y - y),
        tint: red * (white_x - x) - 650.0 * (white_y - y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    #[test]
    fn the_perfect_diffuser() {
        let white = xyz_from_xy([0.3138, 0.3310]);
        for field in [Field::Degrees2, Field::Degrees10] {
            assert_eq!(whiteness_cie2004(white, white, field), Whiteness { whiteness: 100.0, tint: 0.0 });
        }
        assert!((whiteness_berger1959(white, white) - 33.3).abs() < 1e-12);
        assert!((whiteness_taube1960(white, white) - 100.0).abs() < 1e-12);
        assert!((whiteness_stensby1968_from_xyz(white, white) - 100.0).abs() < 1e-12);
        let ganz = whiteness_ganz1979(white);
        assert!((ganz.whiteness - 100.0).abs() < 0.2 && ganz.tint.abs() < 2.0, "{ganz:?}");
        let c = xyz_from_xy([0.31006, 0.31616]);
        assert!((whiteness_astm_e313(c) - 100.0).abs() < 1.0);
    }

    #[test]
    fn bluish_is_whiter_and_yellowish_less_white() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        let (blue, yellow) = (DVec3::new(0.90, 0.95, 1.10), DVec3::new(0.90, 0.95, 0.90));
        let indices: [fn(DVec3, DVec3) -> f64; 6] = [
            whiteness_berger1959,
            whiteness_taube1960,
            whiteness_stensby1968_from_xyz,
            |xyz, _| whiteness_astm_e313(xyz),
            |xyz, _| whiteness_ganz1979(xyz).whiteness,
            |xyz, white| whiteness_cie2004(xyz, white, Field::Degrees2).whiteness,
        ];
        for index in indices {
            assert!(index(blue, white) > index(yellow, white));
        }
    }
}
