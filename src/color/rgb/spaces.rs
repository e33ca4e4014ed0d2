//! The RGB spaces by name.
//!
//! Sources of primaries and whites: \[IEC61966\], \[BT601\], \[BT709\], \[BT2020\], \[BT2100\], \[DCI2012\], \[AdobeRGB1998\],
//! \[Spaulding2000\], \[ACES\], \[SMPTE240M\], \[H273\] and the makers' papers that `transfer` names; the older working spaces of
//! photography as \[Lindbloom2017\] gives them.

use super::RgbSpace;
use crate::color::Transfer::*;
use crate::color::transfer::{ADOBE_GAMMA, ExposureIndex};
use std::sync::LazyLock;

/// Chromaticities x, y of red, green and blue.
type Primaries = [[f64; 2]; 3];

/// Chromaticity of D65 as the RGB standards give it.
const D65: [f64; 2] = [0.3127, 0.3290];
/// Chromaticity of D55.
const D55: [f64; 2] = [0.33243, 0.34744];
/// Chromaticity of D50 as ROMM RGB gives it.
const D50: [f64; 2] = [0.3457, 0.3585];
/// Chromaticity of illuminant C.
const C: [f64; 2] = [0.31006, 0.31616];
/// Chromaticity of equal energy.
const E: [f64; 2] = [1.0 / 3.0, 1.0 / 3.0];
/// Chromaticity of the ACES white, near D60.
const ACES_WHITE: [f64; 2] = [0.32168, 0.33767];
/// Chromaticity of the white of digital cinema projectors.
const DCI_WHITE: [f64; 2] = [0.314, 0.351];

/// Primaries of BT.709 and sRGB.
const REC709: Primaries = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]];
/// Primaries of BT.2020, which are monochromatic.
const REC2020: Primaries = [[0.708, 0.292], [0.17, 0.797], [0.131, 0.046]];
/// Primaries of digital cinema projectors.
const P3: Primaries = [[0.68, 0.32], [0.265, 0.69], [0.15, 0.06]];
/// Primaries of European television, BT.601 with 625 lines.
const PAL: Primaries = [[0.64, 0.33], [0.29, 0.6], [0.15, 0.06]];
/// Primaries of American television, BT.601 with 525 lines.
const SMPTE_C: Primaries = [[0.63, 0.34], [0.31, 0.595], [0.155, 0.07]];
/// Primaries of the first colour television.
const NTSC: Primaries = [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08]];
/// Primaries of Adobe RGB.
const ADOBE: Primaries = [[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]];
/// Primaries of ROMM RGB and its relatives.
const ROMM: Primaries = [[0.7347, 0.2653], [0.1596, 0.8404], [0.0366, 0.0001]];
/// AP1 of ACES.
const AP1: Primaries = [[0.713, 0.293], [0.165, 0.83], [0.128, 0.044]];
/// Primaries of S-Gamut and S-Gamut3.
const S_GAMUT3: Primaries = [[0.73, 0.28], [0.14, 0.855], [0.1, -0.05]];
/// The axes of XYZ.
const X_Y_Z: Primaries = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];

/// Other names of spaces above: (other, name in the table).
pub(super) const OTHER_NAMES: [(&str, &str); 3] =
    [("a98-rgb", "adobe-rgb"), ("romm-rgb", "prophoto-rgb"), ("ntsc-1953", "rec470-525")];

static SPACES: LazyLock<Vec<RgbSpace>> = LazyLock::new(|| {
    let new = RgbSpace::derived;
    vec![
        new("srgb", REC709, D65, Srgb),
        new("rec709", REC709, D65, Bt709),
        new("rec2020", REC2020, D65, Bt2020),
        new("rec2100-pq", REC2020, D65, Pq),
        new("rec2100-hlg", REC2020, D65, Hlg),
        new("display-p3", P3, D65, Srgb),
        new("p3-d65", P3, D65, Gamma(2.6)),
        new("dci-p3", P3, DCI_WHITE, Gamma(2.6)),
        new("dci-p3-plus", [[0.74, 0.27], [0.22, 0.78], [0.09, -0.09]], DCI_WHITE, Gamma(2.6)),
        new("adobe-rgb", ADOBE, D65, Gamma(ADOBE_GAMMA)),
        new("adobe-wide-gamut-rgb", [[0.7347, 0.2653], [0.1152, 0.8264], [0.1566, 0.0177]], D50, Gamma(ADOBE_GAMMA)),
        new("prophoto-rgb", ROMM, D50, Romm),
        new("rimm-rgb", ROMM, D50, Rimm),
        new("erimm-rgb", ROMM, D50, Erimm),
        new("aces2065-1", [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077]], ACES_WHITE, Linear),
        new("acescg", AP1, ACES_WHITE, Linear),
        new("acescc", AP1, ACES_WHITE, AcesCc),
        new("acescct", AP1, ACES_WHITE, AcesCct),
        new("acesproxy", AP1, ACES_WHITE, AcesProxy10),
        new("arri-wide-gamut-3", [[0.684, 0.313], [0.221, 0.848], [0.0861, -0.102]], D65, LogC3(ExposureIndex::EI_800)),
        new("arri-wide-gamut-4", [[0.7347, 0.2653], [0.1424, 0.8576], [0.0991, -0.0308]], D65, LogC4),
        new("s-gamut", S_GAMUT3, D65, SLog2),
        new("s-gamut3", S_GAMUT3, D65, SLog3),
        new("s-gamut3-cine", [[0.766, 0.275], [0.225, 0.8], [0.089, -0.087]], D65, SLog3),
        new(
            "venice-s-gamut3",
            [
                [0.740_464_264_304_292, 0.279_364_374_750_66],
                [0.089_241_145_423_286, 0.893_809_528_608_105],
                [0.110_488_236_673_827, -0.052_579_333_080_476],
            ],
            D65,
            SLog3,
        ),
        new(
            "venice-s-gamut3-cine",
            [
                [0.775_901_871_567_345, 0.274_502_392_854_799],
                [0.188_682_902_773_355, 0.828_684_937_020_288],
                [0.101_337_382_499_301, -0.089_187_517_306_263],
            ],
            D65,
            SLog3,
        ),
        new("v-gamut", [[0.73, 0.28], [0.165, 0.84], [0.1, -0.03]], D65, VLog),
        new(
            "red-wide-gamut-rgb",
            [[0.780_308, 0.304_253], [0.121_595, 1.493_994], [0.095_612, -0.084_589]],
            D65,
            Log3G10,
        ),
        new(
            "red-color",
            [
                [0.701_058_563_171_395, 0.330_180_975_940_326],
                [0.298_811_317_306_316, 0.625_169_245_953_133],
                [0.135_038_675_201_355, 0.035_261_776_551_191],
            ],
            D65,
            RedLogFilm,
        ),
        new(
            "red-color2",
            [
                [0.897_407_221_929_776, 0.330_776_225_980_398],
                [0.296_022_094_516_625, 0.684_635_550_900_945],
                [0.099_799_512_883_393, -0.023_000_513_177_992],
            ],
            D65,
            RedLogFilm,
        ),
        new(
            "red-color3",
            [
                [0.702_598_658_589_917, 0.330_185_588_938_484],
                [0.295_782_235_737_268, 0.689_748_258_397_534],
                [0.111_090_529_079_787, -0.004_332_320_984_771],
            ],
            D65,
            RedLogFilm,
        ),
        new(
            "red-color4",
            [
                [0.702_598_154_635_438, 0.330_185_096_210_515],
                [0.295_782_328_047_083, 0.689_748_253_964_859],
                [0.144_459_236_489_795, 0.050_837_720_977_386],
            ],
            D65,
            RedLogFilm,
        ),
        new(
            "dragon-color",
            [
                [0.758_655_892_599_321, 0.330_355_348_611_293],
                [0.294_923_619_810_175, 0.708_053_242_065_117],
                [0.085_961_601_167_585, -0.045_879_436_983_969],
            ],
            D65,
            RedLogFilm,
        ),
        new(
            "dragon-color2",
            [
                [0.758_656_214_177_604, 0.330_355_835_762_678],
                [0.294_923_887_732_982, 0.708_053_363_192_126],
                [0.144_168_726_866_337, 0.050_357_384_587_121],
            ],
            D65,
            RedLogFilm,
        ),
        new("cinema-gamut", [[0.74, 0.27], [0.17, 1.14], [0.08, -0.1]], D65, Linear),
        new("f-gamut", REC2020, D65, FLog),
        new("f-gamut-c", [[0.7347, 0.2653], [0.0263, 0.9737], [0.1173, -0.0224]], D65, FLog2),
        new("n-gamut", REC2020, D65, NLog),
        new("d-gamut", [[0.71, 0.31], [0.21, 0.88], [0.09, -0.08]], D65, DLog),
        new(
            "protune-native",
            [
                [0.698_480_461_493_841, 0.193_026_445_370_121],
                [0.329_555_378_387_345, 1.024_596_624_134_644],
                [0.108_442_631_407_675, -0.034_678_569_754_016],
            ],
            D65,
            Protune,
        ),
        new("davinci-wide-gamut", [[0.8, 0.313], [0.1682, 0.9877], [0.079, -0.1155]], D65, DavinciIntermediate),
        new(
            "blackmagic-wide-gamut",
            [[0.717_721_5, 0.317_118_1], [0.228_041, 0.861_569], [0.100_584_1, -0.082_045_2]],
            [0.312_717, 0.329_031_2],
            BlackmagicFilm5,
        ),
        new("filmlight-e-gamut", [[0.8, 0.3177], [0.18, 0.9], [0.065, -0.0805]], D65, TLog),
        new("filmlight-e-gamut-2", [[0.83, 0.31], [0.15, 0.95], [0.065, -0.0805]], D65, TLog),
        new("rec470-525", NTSC, C, Gamma(2.8)),
        new("rec470-625", PAL, D65, Gamma(2.8)),
        new("rec601-525", SMPTE_C, D65, Bt709),
        new("rec601-625", PAL, D65, Bt709),
        new("smpte-c", SMPTE_C, D65, Gamma(2.2)),
        new("smpte-240m", SMPTE_C, D65, Smpte240m),
        new("ebu-3213", PAL, [0.313, 0.329], Linear),
        new("plasa-e1.54", ROMM, [0.4254, 0.4044], Linear),
        new("h273-film", [[0.681, 0.319], [0.243, 0.692], [0.145, 0.049]], [0.310, 0.316], Linear),
        new("h273-22", [[0.63, 0.34], [0.295, 0.605], [0.155, 0.077]], D65, Linear),
        new("dcdm-xyz", X_Y_Z, E, Dcdm),
        new(
            "cie-rgb",
            [
                [0.734_742_840_005_998, 0.265_257_159_994_002],
                [0.273_779_033_824_958, 0.717_477_700_256_116],
                [0.166_555_629_580_28, 0.008_910_726_182_545],
            ],
            E,
            Gamma(2.2),
        ),
        new("apple-rgb", [[0.625, 0.34], [0.28, 0.595], [0.155, 0.07]], D65, Gamma(1.8)),
        new(
            "best-rgb",
            [
                [0.735_191_637_630_662, 0.264_808_362_369_338],
                [0.215_336_134_453_781, 0.774_159_663_865_546],
                [0.130_122_950_819_672, 0.034_836_065_573_77],
            ],
            D50,
            Gamma(2.2),
        ),
        new("beta-rgb", [[0.6888, 0.3112], [0.1986, 0.7551], [0.1265, 0.0352]], D50, Gamma(2.2)),
        new("colormatch-rgb", [[0.63, 0.34], [0.295, 0.605], [0.15, 0.075]], D50, Gamma(1.8)),
        new(
            "don-rgb-4",
            [
                [0.696_120_689_655_172, 0.299_568_965_517_241],
                [0.214_682_981_090_1, 0.765_294_771_968_854],
                [0.129_937_629_937_63, 0.035_343_035_343_035],
            ],
            D50,
            Gamma(2.2),
        ),
        new(
            "eci-rgb-v2",
            [
                [0.670_103_092_783_505, 0.329_896_907_216_495],
                [0.209_905_660_377_358, 0.709_905_660_377_358],
                [0.140_061_791_967_044, 0.080_329_557_157_57],
            ],
            D50,
            CieLightness,
        ),
        new(
            "ekta-space-ps5",
            [
                [0.694_736_842_105_263, 0.305_263_157_894_737],
                [0.26, 0.7],
                [0.109_728_506_787_33, 0.004_524_886_877_828],
            ],
            D50,
            Gamma(2.2),
        ),
        new(
            "max-rgb",
            [[0.734_133_79, 0.265_866_21], [0.100_391_13, 0.899_608_87], [0.036_214_95, 0.0]],
            D50,
            Gamma(2.2),
        ),
        new("russell-rgb", [[0.69, 0.31], [0.18, 0.77], [0.1, 0.02]], D55, Gamma(2.2)),
        new("sharp-rgb", [[0.6898, 0.3206], [0.0736, 0.9003], [0.1166, 0.0374]], E, Linear),
        new("xtreme-rgb", X_Y_Z, D50, Gamma(2.2)),
    ]
});

/// sRGB first.
pub(super) fn all() -> &'static [RgbSpace] {
    &SPACES
}
