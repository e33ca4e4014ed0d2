//! Spaces of one build: XYZ to cone-like responses, a power that keeps the sign, and a matrix to a lightness and two
//! opponent coordinates. Oklab, IPT and its relatives. All are for D65, and total: negative responses keep their sign.

use crate::math;
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Matrices and exponent of one space, with the inverses.
struct PowerSpace {
    cones_from_xyz: DMat3,
    xyz_from_cones: DMat3,
    exponent: f64,
    opponent_from_compressed: DMat3,
    compressed_from_opponent: DMat3,
}

impl PowerSpace {
    /// Makes a space of its matrices, written in rows.
    fn new(cones_from_xyz: [[f64; 3]; 3], exponent: f64, opponent_from_compressed: [[f64; 3]; 3]) -> Self {
        let [cones_from_xyz, opponent_from_compressed] =
            [cones_from_xyz, opponent_from_compressed].map(|rows| DMat3::from_cols_array_2d(&rows).transpose());
        Self::from_matrices(cones_from_xyz, exponent, opponent_from_compressed)
    }

    fn from_matrices(cones_from_xyz: DMat3, exponent: f64, opponent_from_compressed: DMat3) -> Self {
        Self {
            cones_from_xyz,
            xyz_from_cones: cones_from_xyz.inverse(),
            exponent,
            opponent_from_compressed,
            compressed_from_opponent: opponent_from_compressed.inverse(),
        }
    }

    fn encode(&self, xyz: DVec3) -> DVec3 {
        self.opponent_from_compressed * signed_pow(self.cones_from_xyz * xyz, self.exponent)
    }

    fn decode(&self, opponent: DVec3) -> DVec3 {
        self.xyz_from_cones * signed_pow(self.compressed_from_opponent * opponent, 1.0 / self.exponent)
    }
}

/// |v|^p with the sign of v, by component.
fn signed_pow(v: DVec3, exponent: f64) -> DVec3 {
    DVec3::from(v.to_array().map(|x| if x == 0.0 { 0.0 } else { math::pow(x.abs(), exponent).copysign(x) }))
}

/// Hunt-Pointer-Estevez responses normalised to D65, of IPT and sUCS.
const HPE_D65: [[f64; 3]; 3] = [[0.4002, 0.7075, -0.0807], [-0.2280, 1.1500, 0.0612], [0.0, 0.0, 0.9184]];

/// XYZ under D65 to the cone responses of Oklab \[Ottosson2020\].
pub(in crate::color) const OKLAB_CONES_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.818_933_010_1, 0.032_984_543_6, 0.048_200_301_8),
    DVec3::new(0.361_866_742_4, 0.929_311_871_5, 0.264_366_269_1),
    DVec3::new(-0.128_859_713_7, 0.036_145_638_7, 0.633_851_707_0),
);

static OKLAB: LazyLock<PowerSpace> = LazyLock::new(|| {
    let opponent_from_compressed = DMat3::from_cols(
        DVec3::new(0.210_454_255_3, 1.977_998_495_1, 0.025_904_037_1),
        DVec3::new(0.793_617_785_0, -2.428_592_205_0, 0.782_771_766_2),
        DVec3::new(-0.004_072_046_8, 0.450_593_709_9, -0.808_675_766_0),
    );
    PowerSpace::from_matrices(OKLAB_CONES_FROM_XYZ, 1.0 / 3.0, opponent_from_compressed)
});

static IPT: LazyLock<PowerSpace> = LazyLock::new(|| {
    PowerSpace::new(HPE_D65, 0.43, [[0.4, 0.4, 0.2], [4.455, -4.851, 0.396], [0.8056, 0.3572, -1.1628]])
});

/// The matrices of IPT, XYZ to cones and compressed cones to I, P, T.
pub(super) fn ipt_matrices() -> [DMat3; 2] {
    [IPT.cones_from_xyz, IPT.opponent_from_compressed]
}

static IPT_RAGOO2021: LazyLock<PowerSpace> = LazyLock::new(|| {
    PowerSpace::new(
        [[0.4321, 0.6906, -0.0930], [-0.1793, 1.1458, 0.0226], [0.0631, 0.1532, 0.7226]],
        0.4071,
        [[0.3037, 0.6688, 0.0276], [3.9247, -4.7339, 0.8093], [1.5932, -0.5205, -1.0727]],
    )
});

static IGPGTG: LazyLock<PowerSpace> = LazyLock::new(|| {
    // The responses are divided by these before the power; a factor of the rows does the same.
    let divisors = [18.36, 21.46, 19_435.0];
    #[expect(clippy::approx_constant, reason = "-0.318 is no 1/π")]
    let rows = [[2.968, 2.741, -0.649], [1.237, 5.969, -0.173], [-0.318, 0.387, 2.311]];
    let scaled = [0, 1, 2].map(|i| rows[i].map(|x| x / divisors[i]));
    PowerSpace::new(scaled, 0.427, [[0.117, 1.464, 0.130], [8.285, -8.361, 21.400], [-1.208, 2.412, -36.530]])
});

static SUCS: LazyLock<PowerSpace> = LazyLock::new(|| {
    let intensity = [200.0 / 3.05, 100.0 / 3.05, 5.0 / 3.05];
    PowerSpace::new(HPE_D65, 0.43, [intensity, [430.0, -470.0, 40.0], [49.0, 49.0, -98.0]])
});

/// Oklab L, a, b of XYZ under D65 \[Ottosson2020\], with the matrices as first published; white is near (1, 0, 0).
pub fn oklab_from_xyz(xyz: DVec3) -> DVec3 {
    // The exponent is exactly 1/3, for which there is a better function than the power.
    let cones = OKLAB.cones_from_xyz * xyz;
    OKLAB.opponent_from_compressed * DVec3::from(cones.to_array().map(math::cbrt))
}

/// Inverse of [`oklab_from_xyz`].
pub fn xyz_from_oklab(oklab: DVec3) -> DVec3 {
    let roots = OKLAB.compressed_from_opponent * oklab;
    OKLAB.xyz_from_cones * (roots * roots * roots)
}

/// I, P, T of XYZ under D65 \[Ebner1998\]; white is near (1, 0, 0).
pub fn ipt_from_xyz(xyz: DVec3) -> DVec3 {
    IPT.encode(xyz)
}

/// Inverse of [`ipt_from_xyz`].
pub fn xyz_from_ipt(ipt: DVec3) -> DVec3 {
    IPT.decode(ipt)
}

/// I, P, T optimised for chromatic differences \[Ragoo2021\], of XYZ under D65.
pub fn ipt_ragoo2021_from_xyz(xyz: DVec3) -> DVec3 {
    IPT_RAGOO2021.encode(xyz)
}

/// Inverse of [`ipt_ragoo2021_from_xyz`].
pub fn xyz_from_ipt_ragoo2021(ipt: DVec3) -> DVec3 {
    IPT_RAGOO2021.decode(ipt)
}

/// Ig, Pg, Tg of XYZ under D65 \[Hellwig2020\].
pub fn igpgtg_from_xyz(xyz: DVec3) -> DVec3 {
    IGPGTG.encode(xyz)
}

/// Inverse of [`igpgtg_from_xyz`].
pub fn xyz_from_igpgtg(igpgtg: DVec3) -> DVec3 {
    IGPGTG.decode(igpgtg)
}

/// sUCS I, a, b of XYZ under D65 \[Li2024\]; white is near (100, 0, 0).
pub fn sucs_from_xyz(xyz: DVec3) -> DVec3 {
    SUCS.encode(xyz)
}

/// Inverse of [`sucs_from_xyz`].
pub fn xyz_from_sucs(sucs: DVec3) -> DVec3 {
    SUCS.decode(sucs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    #[test]
    fn white_is_grey_within_the_digits_of_the_matrices() {
        let white = xyz_from_xy([0.3127, 0.3290]);
        for (name, value, lightness) in [
            ("Oklab", oklab_from_xyz(white), 1.0),
            ("IPT", ipt_from_xyz(white), 1.0),
            ("IPT Ragoo 2021", ipt_ragoo2021_from_xyz(white), 1.0),
            ("sUCS", sucs_from_xyz(white) / 100.0, 1.0),
        ] {
            assert!((value - DVec3::new(lightness, 0.0, 0.0)).abs().max_element() < 1e-3, "{name}: {value}");
        }
    }

    #[test]
    fn the_published_example_of_oklab() {
        // Ottosson's table of four XYZ, to three digits.
        for (xyz, oklab) in [
            ([0.950, 1.000, 1.089], [1.000, 0.000, 0.000]),
            ([1.000, 0.000, 0.000], [0.450, 1.236, -0.019]),
            ([0.000, 1.000, 0.000], [0.922, -0.671, 0.263]),
            ([0.000, 0.000, 1.000], [0.153, -1.415, -0.449]),
        ] {
            let value = oklab_from_xyz(DVec3::from(xyz));
            assert!((value - DVec3::from(oklab)).abs().max_element() < 5.1e-4, "{value}");
        }
    }

    proptest! {
        #[test]
        fn round_trips(x in -0.5..2.0_f64, y in -0.5..2.0_f64, z in -0.5..2.0_f64) {
            let xyz = DVec3::new(x, y, z);
            for back in [
                xyz_from_oklab(oklab_from_xyz(xyz)),
                xyz_from_ipt(ipt_from_xyz(xyz)),
                xyz_from_ipt_ragoo2021(ipt_ragoo2021_from_xyz(xyz)),
                xyz_from_igpgtg(igpgtg_from_xyz(xyz)),
                xyz_from_sucs(sucs_from_xyz(xyz)),
            ] {
                prop_assert!((back - xyz).abs().max_element() < 1e-12, "{back} {xyz}");
            }
        }
    }
}
