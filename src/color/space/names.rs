//! The spaces by name, all of one form.

use super::*;
use crate::{Error, Result};
use glam::DVec3;

/// A colour space as a pair of functions of coordinates and the white's XYZ.
#[derive(Debug, Clone, Copy)]
pub struct Space {
    /// Lower-case name with hyphens.
    pub name: &'static str,
    /// What the three coordinates are called.
    pub axes: [&'static str; 3],
    /// Whether XYZ is absolute, in cd/m², instead of relative to white.
    pub is_absolute: bool,
    /// Whether the space is for D65 alone, so that other whites have to be adapted first; the white is ignored then.
    pub is_for_d65: bool,
    /// Coordinates from XYZ and the white.
    pub from_xyz: fn(DVec3, DVec3) -> DVec3,
    /// XYZ from coordinates and the white.
    pub to_xyz: fn(DVec3, DVec3) -> DVec3,
}

impl Space {
    const fn new(
        name: &'static str,
        axes: [&'static str; 3],
        from_xyz: fn(DVec3, DVec3) -> DVec3,
        to_xyz: fn(DVec3, DVec3) -> DVec3,
    ) -> Self {
        Self { name, axes, is_absolute: false, is_for_d65: false, from_xyz, to_xyz }
    }

    const fn for_d65(mut self) -> Self {
        self.is_for_d65 = true;
        self
    }

    const fn absolute(mut self) -> Self {
        self.is_absolute = true;
        self.for_d65()
    }
}

/// All spaces. Those with parameters have their reference conditions.
static SPACES: [Space; 30] = [
    Space::new("xyz", ["X", "Y", "Z"], |xyz, _| xyz, |xyz, _| xyz),
    Space::new("xyy", ["x", "y", "Y"], |xyz, _| xyy_from_xyz(xyz), |xyy, _| xyz_from_xyy(xyy)),
    Space::new("lab", ["L*", "a*", "b*"], lab_from_xyz, xyz_from_lab),
    Space::new(
        "lch-ab",
        ["L*", "C*ab", "hab"],
        |xyz, white| lch_from_lab(lab_from_xyz(xyz, white)),
        |lch, white| xyz_from_lab(lab_from_lch(lch), white),
    ),
    Space::new("luv", ["L*", "u*", "v*"], luv_from_xyz, xyz_from_luv),
    Space::new(
        "lch-uv",
        ["L*", "C*uv", "huv"],
        |xyz, white| lch_from_lab(luv_from_xyz(xyz, white)),
        |lch, white| xyz_from_luv(lab_from_lch(lch), white),
    ),
    Space::new(
        "uv-1976",
        ["u'", "v'", "Y"],
        |xyz, _| with_y(uv_1976_from_xyz(xyz), xyz),
        |uvy, _| xyz_from_uv_1976_y([uvy.x, uvy.y], uvy.z),
    ),
    Space::new(
        "uv-1960",
        ["u", "v", "Y"],
        |xyz, _| with_y(uv_1960_from_xyz(xyz), xyz),
        |uvy, _| xyz_from_uv_1960_y([uvy.x, uvy.y], uvy.z),
    ),
    Space::new("ucs-1960", ["U", "V", "W"], |xyz, _| ucs_from_xyz(xyz), |ucs, _| xyz_from_ucs(ucs)),
    Space::new("uvw-1964", ["U*", "V*", "W*"], uvw_from_xyz, xyz_from_uvw),
    Space::new("oklab", ["L", "a", "b"], |xyz, _| oklab_from_xyz(xyz), |lab, _| xyz_from_oklab(lab)).for_d65(),
    Space::new(
        "oklch",
        ["L", "C", "h"],
        |xyz, _| lch_from_lab(oklab_from_xyz(xyz)),
        |lch, _| xyz_from_oklab(lab_from_lch(lch)),
    )
    .for_d65(),
    Space::new("ictcp", ["I", "Ct", "Cp"], |xyz, _| ictcp_from_xyz(xyz), |v, _| xyz_from_ictcp(v)).absolute(),
    Space::new("icacb", ["I", "Ca", "Cb"], |xyz, _| icacb_from_xyz(xyz), |v, _| xyz_from_icacb(v)).absolute(),
    Space::new("jzazbz", ["Jz", "az", "bz"], |xyz, _| jzazbz_from_xyz(xyz), |v, _| xyz_from_jzazbz(v)).absolute(),
    Space::new("ipt", ["I", "P", "T"], |xyz, _| ipt_from_xyz(xyz), |v, _| xyz_from_ipt(v)).for_d65(),
    Space::new(
        "ipt-ragoo2021",
        ["I", "P", "T"],
        |xyz, _| ipt_ragoo2021_from_xyz(xyz),
        |v, _| xyz_from_ipt_ragoo2021(v),
    )
    .for_d65(),
    Space::new("igpgtg", ["Ig", "Pg", "Tg"], |xyz, _| igpgtg_from_xyz(xyz), |v, _| xyz_from_igpgtg(v)).for_d65(),
    Space::new("sucs", ["I", "a", "b"], |xyz, _| sucs_from_xyz(xyz), |v, _| xyz_from_sucs(v)).for_d65(),
    Space::new(
        "hdr-cielab",
        ["Lhdr", "ahdr", "bhdr"],
        |xyz, white| hdr_cielab_from_xyz(xyz, white, HdrConditions::default()),
        |lab, white| xyz_from_hdr_cielab(lab, white, HdrConditions::default()),
    ),
    Space::new(
        "hdr-ipt",
        ["Ihdr", "Phdr", "Thdr"],
        |xyz, _| hdr_ipt_from_xyz(xyz, HdrConditions::default()),
        |ipt, _| xyz_from_hdr_ipt(ipt, HdrConditions::default()),
    )
    .for_d65(),
    Space::new(
        "din99",
        ["L99", "a99", "b99"],
        |xyz, white| din99(xyz, white, Din99::Standard),
        |v, white| from_din99(v, white, Din99::Standard),
    ),
    Space::new(
        "din99b",
        ["L99b", "a99b", "b99b"],
        |xyz, white| din99(xyz, white, Din99::B),
        |v, white| from_din99(v, white, Din99::B),
    ),
    Space::new(
        "din99c",
        ["L99c", "a99c", "b99c"],
        |xyz, white| din99(xyz, white, Din99::C),
        |v, white| from_din99(v, white, Din99::C),
    ),
    Space::new(
        "din99d",
        ["L99d", "a99d", "b99d"],
        |xyz, white| din99(xyz, white, Din99::D),
        |v, white| from_din99(v, white, Din99::D),
    ),
    Space::new(
        "hunter-lab",
        ["L", "a", "b"],
        |xyz, white| hunter_lab_from_xyz(xyz, white, hunter_coefficients(white)),
        |lab, white| xyz_from_hunter_lab(lab, white, hunter_coefficients(white)),
    ),
    Space::new(
        "hunter-rdab",
        ["Rd", "a", "b"],
        |xyz, white| hunter_rdab_from_xyz(xyz, white, hunter_coefficients(white)),
        |rdab, white| xyz_from_hunter_rdab(rdab, white, hunter_coefficients(white)),
    ),
    Space::new("osa-ucs", ["L", "j", "g"], |xyz, _| osa_ucs_from_xyz(xyz), |ljg, _| xyz_from_osa_ucs(ljg)).for_d65(),
    Space::new("prolab", ["L+", "a+", "b+"], prolab_from_xyz, xyz_from_prolab),
    Space::new("yrg", ["Y", "r", "g"], |xyz, _| yrg_from_xyz(xyz), |yrg, _| xyz_from_yrg(yrg)).for_d65(),
];

fn with_y(uv: [f64; 2], xyz: DVec3) -> DVec3 {
    DVec3::new(uv[0], uv[1], xyz.y)
}

fn din99(xyz: DVec3, white_xyz: DVec3, formula: Din99) -> DVec3 {
    din99_from_lab(lab_from_xyz(xyz, white_xyz), formula, Din99Factors::REFERENCE)
}

fn from_din99(din99: DVec3, white_xyz: DVec3, formula: Din99) -> DVec3 {
    xyz_from_lab(lab_from_din99(din99, formula, Din99Factors::REFERENCE), white_xyz)
}

/// Names of all spaces.
pub fn names() -> impl Iterator<Item = &'static str> {
    SPACES.iter().map(|space| space.name)
}

/// A space by its name.
///
/// # Errors
/// [`UnknownName`](crate::ErrorKind::UnknownName) with the nearest name.
pub fn by_name(name: &str) -> Result<&'static Space> {
    SPACES.iter().find(|space| space.name == name).ok_or_else(|| Error::unknown_name("colour space", name, names()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::color::xyz_from_xy;

    #[test]
    fn every_space_round_trips() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        for space in &SPACES {
            let scale = if space.is_absolute { 100.0 } else { 1.0 };
            for xyz in [[0.2, 0.3, 0.1], [0.4, 0.2, 0.9], [0.9, 0.9, 1.0]] {
                let xyz = DVec3::from(xyz) * scale;
                let back = (space.to_xyz)((space.from_xyz)(xyz, white), white);
                assert!((back - xyz).abs().max_element() < 1e-11 * scale, "{}: {back} {xyz}", space.name);
            }
        }
    }

    #[test]
    fn names_are_distinct_and_found() {
        for (i, name) in names().enumerate() {
            assert_eq!(by_name(name).unwrap().name, name);
            assert!(names().skip(i + 1).all(|other| other != name));
        }
        let error = by_name("OKLba").unwrap_err();
        assert_eq!((error.kind, error.nearest.as_deref()), (ErrorKind::UnknownName, Some("oklab")));
    }
}
