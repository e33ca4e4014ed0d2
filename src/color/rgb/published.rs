//! RGB spaces with the rounded matrices that their standards print.

use super::RgbSpace;
use glam::DMat3;
use std::sync::LazyLock;

/// A matrix as printed, by rows.
type Rows = [[f64; 3]; 3];

static SPACES: LazyLock<Vec<RgbSpace>> = LazyLock::new(|| {
    vec![
        published(
            "srgb",
            "srgb-published",
            [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]],
            Some([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.204, 1.057]]),
        ),
        published(
            "adobe-rgb",
            "adobe-rgb-published",
            [[0.576_67, 0.185_56, 0.188_23], [0.297_34, 0.627_36, 0.075_29], [0.027_03, 0.070_69, 0.991_34]],
            Some([[2.041_59, -0.565_01, -0.344_73], [-0.969_24, 1.875_97, 0.041_56], [0.013_44, -0.118_36, 1.015_17]]),
        ),
        published(
            "prophoto-rgb",
            "prophoto-rgb-published",
            [[0.7977, 0.1352, 0.0313], [0.288, 0.7119, 0.0001], [0.0, 0.0, 0.8249]],
            Some([[1.346, -0.2556, -0.0511], [-0.5446, 1.5082, 0.0205], [0.0, 0.0, 1.2123]]),
        ),
        published(
            "aces2065-1",
            "aces2065-1-published",
            [
                [0.952_552_395_9, 0.0, 0.000_093_678_6],
                [0.343_966_449_8, 0.728_166_096_6, -0.072_132_546_4],
                [0.0, 0.0, 1.008_825_184_4],
            ],
            Some([
                [1.049_811_017_5, 0.0, -0.000_097_484_5],
                [-0.495_903_023_1, 1.373_313_045_8, 0.098_240_036_1],
                [0.0, 0.0, 0.991_252_018_2],
            ]),
        ),
        published(
            "arri-wide-gamut-3",
            "arri-wide-gamut-3-published",
            [[0.638_008, 0.214_704, 0.097_744], [0.291_954, 0.823_841, -0.115_795], [0.002_798, -0.067_034, 1.153_294]],
            Some([
                [1.789_066, -0.482_534, -0.200_076],
                [-0.639_849, 1.3964, 0.194_432],
                [-0.041_532, 0.082_335, 0.878_868],
            ]),
        ),
        published(
            "s-gamut3",
            "s-gamut3-published",
            [
                [0.706_482_713_2, 0.128_801_049_8, 0.115_172_164_1],
                [0.270_979_670_8, 0.786_606_411_2, -0.057_586_082],
                [-0.009_677_845_4, 0.004_600_037_5, 1.094_135_558_7],
            ],
            Some([
                [1.507_399_899_1, -0.245_822_137_4, -0.171_611_680_8],
                [-0.518_151_727_1, 1.355_391_240_9, 0.125_878_668_2],
                [0.015_511_698_2, -0.007_872_771_4, 0.911_916_365_6],
            ]),
        ),
        published(
            "s-gamut3-cine",
            "s-gamut3-cine-published",
            [
                [0.599_083_920_8, 0.248_925_516_1, 0.102_446_490_2],
                [0.215_075_820_1, 0.885_068_501_7, -0.100_144_321_9],
                [-0.032_065_849_5, -0.027_658_390_7, 1.148_781_991],
            ],
            Some([
                [1.846_778_969_3, -0.525_986_123, -0.210_545_211_4],
                [-0.444_153_262_9, 1.259_442_902_8, 0.149_399_972_9],
                [0.040_855_421_2, 0.015_640_889_3, 0.868_207_248_7],
            ]),
        ),
        published(
            "v-gamut",
            "v-gamut-published",
            [[0.679_644, 0.152_211, 0.1186], [0.260_686, 0.774_894, -0.035_58], [-0.009_31, -0.004_612, 1.102_98]],
            Some([
                [1.589_012, -0.313_204, -0.180_965],
                [-0.534_053, 1.396_011, 0.102_458],
                [0.011_179, 0.003_194, 0.905_535],
            ]),
        ),
        published(
            "red-wide-gamut-rgb",
            "red-wide-gamut-rgb-published",
            [
                [0.735_275, 0.068_609, 0.146_571],
                [0.286_694, 0.842_979, -0.129_673],
                [-0.079_681, -0.347_343, 1.516_082],
            ],
            None,
        ),
        published(
            "d-gamut",
            "d-gamut-published",
            [[0.6482, 0.194, 0.1082], [0.283, 0.8132, -0.0962], [-0.0183, -0.0832, 1.1903]],
            Some([[1.7257, -0.4314, -0.1917], [-0.6025, 1.3906, 0.1671], [-0.0156, 0.0905, 0.8489]]),
        ),
        published(
            "filmlight-e-gamut-2",
            "filmlight-e-gamut-2-published",
            [[0.736_478, 0.130_74, 0.083_239], [0.275_07, 0.828_018, -0.103_088], [-0.124_225, -0.087_16, 1.300_443]],
            None,
        ),
    ]
});

pub(super) fn all() -> &'static [RgbSpace] {
    &SPACES
}

/// The space `of` with other matrices; `rgb_from_xyz` is the inverse of the other if it is not printed.
fn published(of: &str, name: &'static str, xyz_from_rgb: Rows, rgb_from_xyz: Option<Rows>) -> RgbSpace {
    let matrix = |rows: Rows| DMat3::from_cols_array_2d(&rows).transpose();
    let derived = RgbSpace::all().iter().find(|space| space.name == of).expect("a name of the table of spaces");
    let xyz_from_rgb = matrix(xyz_from_rgb);
    let rgb_from_xyz = rgb_from_xyz.map_or_else(|| xyz_from_rgb.inverse(), matrix);
    RgbSpace { name, xyz_from_rgb, rgb_from_xyz, ..derived.clone() }
}
