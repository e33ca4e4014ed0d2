//! Spaces for high dynamic range that compress absolute cone responses with the perceptual quantiser: ICtCp, Jzazbz, ICaCb.
//!
//! XYZ is absolute here, in cd/m² and for D65. The quantiser is meant for responses of 0 to 10 000 cd/m². Real lights have
//! no negative responses; for others the curve goes on point-symmetrically about its value at 0, so that everything stays
//! monotone, continuous and invertible.

use crate::color::RgbSpace;
use crate::math;
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Peak luminance of the quantiser, cd/m².
const PEAK: f64 = 10_000.0;
const M_1: f64 = 2610.0 / 16_384.0;
const C_1: f64 = 3424.0 / 4096.0;
const C_2: f64 = 2413.0 / 128.0;
const C_3: f64 = 2392.0 / 128.0;
/// The outer exponent of SMPTE ST 2084 \[ST2084\].
const M_2_ST2084: f64 = 2523.0 / 32.0;
/// The outer exponent of Jzazbz.
const M_2_JZAZBZ: f64 = 1.7 * 2523.0 / 32.0;

/// Response in cd/m² to code value.
fn quantize(response: f64, m_2: f64) -> f64 {
    let power = math::pow(response.abs() / PEAK, M_1);
    let code = math::pow((C_1 + C_2 * power) / (1.0 + C_3 * power), m_2);
    if response < 0.0 { 2.0 * math::pow(C_1, m_2) - code } else { code }
}

/// Inverse of [`quantize`]; infinite for a code that no response reaches, which is beyond twice that of the peak.
fn dequantize(code: f64, m_2: f64) -> f64 {
    let black = math::pow(C_1, m_2);
    let above = if code < black { 2.0 * black - code } else { code };
    let root = math::pow(above, 1.0 / m_2);
    let power = (root - C_1).max(0.0) / (C_2 - C_3 * root).max(0.0);
    let response = PEAK * math::pow(power, 1.0 / M_1);
    if code < black { -response } else { response }
}

/// Matrices and curve of one space, with the inverses.
struct QuantizedSpace {
    cones_from_xyz: DMat3,
    xyz_from_cones: DMat3,
    m_2: f64,
    opponent_from_codes: DMat3,
    codes_from_opponent: DMat3,
}

impl QuantizedSpace {
    fn new(cones_from_xyz: DMat3, m_2: f64, opponent_from_codes: [[f64; 3]; 3]) -> Self {
        let opponent_from_codes = rows(opponent_from_codes);
        Self {
            cones_from_xyz,
            xyz_from_cones: cones_from_xyz.inverse(),
            m_2,
            opponent_from_codes,
            codes_from_opponent: opponent_from_codes.inverse(),
        }
    }

    fn encode(&self, xyz: DVec3) -> DVec3 {
        let cones = (self.cones_from_xyz * xyz).to_array();
        self.opponent_from_codes * DVec3::from(cones.map(|cone| quantize(cone, self.m_2)))
    }

    fn decode(&self, opponent: DVec3) -> DVec3 {
        let codes = (self.codes_from_opponent * opponent).to_array();
        self.xyz_from_cones * DVec3::from(codes.map(|code| dequantize(code, self.m_2)))
    }
}

fn rows(rows: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&rows).transpose()
}

static ICTCP: LazyLock<QuantizedSpace> = LazyLock::new(|| {
    let opponent = [[2048.0, 2048.0, 0.0], [6610.0, -13_613.0, 7003.0], [17_933.0, -17_390.0, -543.0]];
    QuantizedSpace::new(ictcp_cones_from_xyz(), M_2_ST2084, opponent.map(|row| row.map(|x| x / 4096.0)))
});

/// The responses of BT.2100, defined on linear BT.2020 RGB.
fn ictcp_cones_from_xyz() -> DMat3 {
    let from_rgb = rows([[1688.0, 2146.0, 262.0], [683.0, 2951.0, 462.0], [99.0, 309.0, 3688.0]]) * (1.0 / 4096.0);
    let bt2020 = RgbSpace::by_name("rec2020").expect("rec2020 is one of the RGB spaces");
    from_rgb * bt2020.rgb_from_xyz
}

/// ICtCp of absolute XYZ, by the quantiser of BT.2100 \[BT2100\]; greys have Ct = Cp = 0.
pub fn ictcp_from_xyz(xyz_cd_m2: DVec3) -> DVec3 {
    ICTCP.encode(xyz_cd_m2)
}

/// Inverse of [`ictcp_from_xyz`], cd/m².
pub fn xyz_from_ictcp(ictcp: DVec3) -> DVec3 {
    ICTCP.decode(ictcp)
}

static ICACB: LazyLock<QuantizedSpace> = LazyLock::new(|| {
    let cones = rows([[0.37613, 0.70431, -0.05675], [-0.21649, 1.14744, 0.05356], [0.02567, 0.16713, 0.74235]]);
    let opponent = [[0.4949, 0.5037, 0.0015], [4.2854, -4.5462, 0.2609], [0.3605, 1.1499, -1.5105]];
    QuantizedSpace::new(cones, M_2_ST2084, opponent)
});

/// ICaCb of absolute XYZ \[Froehlich2017\].
pub fn icacb_from_xyz(xyz_cd_m2: DVec3) -> DVec3 {
    ICACB.encode(xyz_cd_m2)
}

/// Inverse of [`icacb_from_xyz`], cd/m².
pub fn xyz_from_icacb(icacb: DVec3) -> DVec3 {
    ICACB.decode(icacb)
}

static JZAZBZ: LazyLock<QuantizedSpace> = LazyLock::new(|| {
    let cones = rows([
        [0.414_789_72, 0.579_999, 0.014_648_0],
        [-0.201_510_0, 1.120_649, 0.053_100_8],
        [-0.016_600_8, 0.264_800, 0.668_479_9],
    ]);
    let opponent = [[0.5, 0.5, 0.0], [3.524_000, -4.066_708, 0.542_708], [0.199_076, 1.096_799, -1.295_875]];
    // X′ = 1.15 X − 0.15 Z and Y′ = 0.66 Y + 0.34 X straighten blue.
    let corrected = rows([[1.15, 0.0, -0.15], [0.34, 0.66, 0.0], [0.0, 0.0, 1.0]]);
    QuantizedSpace::new(cones * corrected, M_2_JZAZBZ, opponent)
});
/// d and d₀ of Jzazbz: the curvature of lightness, and what makes black 0.
const JZAZBZ_D: f64 = -0.56;
const JZAZBZ_D_0: f64 = 1.629_549_953_282_156_6e-11;

/// Jz, az, bz of absolute XYZ \[Safdar2017\]; black is 0, and Jz of 10 000 cd/m² is near 1.
pub fn jzazbz_from_xyz(xyz_cd_m2: DVec3) -> DVec3 {
    let opponent = JZAZBZ.encode(xyz_cd_m2);
    let i = opponent.x;
    let lightness = (1.0 + JZAZBZ_D) * i / (1.0 + JZAZBZ_D * i) - JZAZBZ_D_0;
    DVec3::new(lightness, opponent.y, opponent.z)
}

/// Inverse of [`jzazbz_from_xyz`], cd/m².
pub fn xyz_from_jzazbz(jzazbz: DVec3) -> DVec3 {
    let lightness = jzazbz.x + JZAZBZ_D_0;
    let i = lightness / (1.0 + JZAZBZ_D - JZAZBZ_D * lightness);
    JZAZBZ.decode(DVec3::new(i, jzazbz.y, jzazbz.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;
    use proptest::prelude::*;

    type Conversion = fn(DVec3) -> DVec3;
    const SPACES: [(&str, Conversion, Conversion); 3] = [
        ("ICtCp", ictcp_from_xyz, xyz_from_ictcp),
        ("ICaCb", icacb_from_xyz, xyz_from_icacb),
        ("Jzazbz", jzazbz_from_xyz, xyz_from_jzazbz),
    ];

    #[test]
    fn the_quantiser_has_its_published_values() {
        // ST 2084: 10 000 cd/m² is 1, 100 cd/m² is 0.508 078.
        assert_eq!(quantize(10_000.0, M_2_ST2084), 1.0);
        assert!((quantize(100.0, M_2_ST2084) - 0.508_078).abs() < 1e-6);
        for response in [-1e4, -100.0, -1e-12, 0.0, 1e-12, 0.005, 100.0, 1e4, 3e4] {
            let back = dequantize(quantize(response, M_2_JZAZBZ), M_2_JZAZBZ);
            assert!((back - response).abs() <= 1e-12 * (1.0 + response.abs()), "{response:e}: {back:e}");
        }
        assert_eq!(dequantize(3.0, M_2_ST2084), f64::INFINITY);
    }

    #[test]
    fn greys_are_neutral() {
        let d65 = xyz_from_xy([0.3127, 0.3290]);
        for y in [0.0, 1e-3, 1.0, 203.0, 10_000.0] {
            let ictcp = ictcp_from_xyz(d65 * y);
            assert!(ictcp.y.abs() < 1e-12 && ictcp.z.abs() < 1e-12, "{y}: {ictcp}");
            // The others have matrices of four to eight digits.
            let [jzazbz, icacb] = [jzazbz_from_xyz(d65 * y), icacb_from_xyz(d65 * y)];
            assert!(jzazbz.y.abs() < 5e-4 && jzazbz.z.abs() < 5e-4, "{y}: {jzazbz}");
            assert!(icacb.y.abs() < 2e-3 && icacb.z.abs() < 2e-3, "{y}: {icacb}");
        }
        assert!(jzazbz_from_xyz(DVec3::ZERO).x.abs() < 1e-15);
        assert!((ictcp_from_xyz(d65 * 10_000.0).x - 1.0).abs() < 1e-13);
    }

    proptest! {
        #[test]
        fn round_trips(x in -0.2..1.0_f64, y in -0.2..1.0_f64, z in -0.2..1.0_f64, exponent in -3.0..4.0_f64) {
            let xyz = DVec3::new(x, y, z) * math::pow(10.0, exponent);
            for (name, from_xyz, to_xyz) in SPACES {
                let back = to_xyz(from_xyz(xyz));
                // A code has 1e-16 of 1, which the inverse curve stretches at high luminance.
                let tolerance = 1e-11 * (xyz.abs().max_element() + 1e-3);
                prop_assert!((back - xyz).abs().max_element() < tolerance, "{name}: {back} {xyz}");
            }
        }

        #[test]
        fn lightness_of_greys_is_monotone(y in 0.0..9000.0_f64, step in 1e-6..1000.0_f64) {
            let d65 = xyz_from_xy([0.3127, 0.3290]);
            for (name, from_xyz, _) in SPACES {
                prop_assert!(from_xyz(d65 * y).x < from_xyz(d65 * (y + step)).x, "{name}");
            }
        }
    }
}
