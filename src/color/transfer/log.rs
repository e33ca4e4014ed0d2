//! Logarithmic curves: of cameras, of ACES, of film scanners.

use crate::math;

/// Base of a logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Base {
    Two,
    E,
    Ten,
}

/// `slope·x + intercept` below the cut, `scale·log(gain·x + offset) + shift` from it on.
///
/// Curves without a straight piece end where the logarithm does: the code is −∞ there and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LinLog {
    slope: f64,
    intercept: f64,
    base: Base,
    gain: f64,
    offset: f64,
    scale: f64,
    shift: f64,
    /// The least linear value that belongs to the logarithm.
    cut: f64,
    /// The least encoded value that does, as the maker gives it.
    encoded_cut: f64,
}

impl LinLog {
    pub(super) fn encode(&self, linear: f64) -> f64 {
        if linear < self.cut {
            return self.slope * linear + self.intercept;
        }
        let inside = (self.gain * linear + self.offset).max(0.0);
        let log = match self.base {
            Base::Two => math::log2(inside),
            Base::E => math::ln(inside),
            Base::Ten => math::log10(inside),
        };
        self.scale * log + self.shift
    }

    pub(super) fn decode(&self, encoded: f64) -> f64 {
        if encoded < self.encoded_cut {
            return (encoded - self.intercept) / self.slope;
        }
        let log = (encoded - self.shift) / self.scale;
        let inside = match self.base {
            Base::Two => math::exp2(log),
            Base::E => math::exp(log),
            Base::Ten => math::exp10(log),
        };
        (inside - self.offset) / self.gain
    }
}

/// A logarithm alone, down to where it ends.
const fn only_log(base: Base, gain: f64, offset: f64, scale: f64, shift: f64) -> LinLog {
    let (cut, encoded_cut) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    LinLog { slope: 1.0, intercept: 0.0, base, gain, offset, scale, shift, cut, encoded_cut }
}

/// ACEScct, S-2016-001 of \[ACES\]: 2⁻⁷ belongs to the straight piece.
pub(super) const ACES_CCT: LinLog = LinLog {
    slope: 10.540_237_741_654_5,
    intercept: 0.072_905_534_195_835_5,
    base: Base::Two,
    gain: 1.0,
    offset: 0.0,
    scale: 1.0 / 17.52,
    shift: 9.72 / 17.52,
    cut: 0.007_812_5_f64.next_up(),
    encoded_cut: 0.155_251_141_552_511_f64.next_up(),
};

/// ARRI LogC3 for exposure index `ei`, of linear scene exposure \[ARRI2017\]: cut, a, b, c, d, e, f by index.
pub(super) const LOG_C3: [(u16, LinLog); 11] = [
    log_c3(160, [0.005561, 5.555556, 0.080216, 0.269036, 0.381991, 5.842037, 0.092778]),
    log_c3(200, [0.006208, 5.555556, 0.076621, 0.266007, 0.382478, 5.776265, 0.092782]),
    log_c3(250, [0.006871, 5.555556, 0.072941, 0.262978, 0.382966, 5.710494, 0.092786]),
    log_c3(320, [0.007622, 5.555556, 0.068768, 0.259627, 0.383508, 5.637732, 0.092791]),
    log_c3(400, [0.008318, 5.555556, 0.064901, 0.256598, 0.383999, 5.571960, 0.092795]),
    log_c3(500, [0.009031, 5.555556, 0.060939, 0.253569, 0.384493, 5.506188, 0.092800]),
    log_c3(640, [0.009840, 5.555556, 0.056443, 0.250219, 0.385040, 5.433426, 0.092805]),
    log_c3(800, [0.010591, 5.555556, 0.052272, 0.247190, 0.385537, 5.367655, 0.092809]),
    log_c3(1000, [0.011361, 5.555556, 0.047996, 0.244161, 0.386036, 5.301883, 0.092814]),
    log_c3(1280, [0.012235, 5.555556, 0.043137, 0.240810, 0.386590, 5.229121, 0.092819]),
    log_c3(1600, [0.013047, 5.555556, 0.038625, 0.237781, 0.387093, 5.163350, 0.092824]),
];

const fn log_c3(ei: u16, [cut, a, b, c, d, e, f]: [f64; 7]) -> (u16, LinLog) {
    let curve = LinLog {
        slope: e,
        intercept: f,
        base: Base::Ten,
        gain: a,
        offset: b,
        scale: c,
        shift: d,
        cut: cut.next_up(),
        encoded_cut: (e * cut + f).next_up(),
    };
    (ei, curve)
}

/// a, b, c, s and t of \[ARRI2022\].
const LOG_C4_A: f64 = (262_144.0 - 16.0) / 117.45;
const LOG_C4_B: f64 = (1023.0 - 95.0) / 1023.0;
const LOG_C4_C: f64 = 95.0 / 1023.0;
const LOG_C4_S: f64 = 0.113_597_208_610_589_1;
const LOG_C4_T: f64 = -0.018_056_996_119_911_31;

/// ARRI LogC4 \[ARRI2022\].
pub(super) const LOG_C4: LinLog = LinLog {
    slope: 1.0 / LOG_C4_S,
    intercept: -LOG_C4_T / LOG_C4_S,
    base: Base::Two,
    gain: LOG_C4_A,
    offset: 64.0,
    scale: LOG_C4_B / 14.0,
    shift: LOG_C4_C - 6.0 / 14.0 * LOG_C4_B,
    cut: LOG_C4_T,
    encoded_cut: 0.0,
};

/// Sony S-Log of scene reflectance, as 10-bit code of legal range over 1023 \[Sony2016\].
pub(super) const S_LOG: LinLog = s_log(1.0);

/// Sony S-Log2 \[Sony2016\]: S-Log of 155/219 of the exposure.
pub(super) const S_LOG2: LinLog = s_log(155.0 / 219.0);

const fn s_log(exposure: f64) -> LinLog {
    let legal = (940.0 - 64.0) / 1023.0;
    LinLog {
        slope: 5.0 * exposure / 0.9 * legal,
        intercept: 0.030_001_222_851_889_303 * legal + 64.0 / 1023.0,
        base: Base::Ten,
        gain: exposure / 0.9,
        offset: 0.037_584,
        scale: 0.432_699 * legal,
        shift: (0.616_596 + 0.03) * legal + 64.0 / 1023.0,
        cut: 0.0,
        encoded_cut: S_LOG_BLACK,
    }
}

/// The code of black, from the logarithm.
const S_LOG_BLACK: f64 = 0.088_251_291_513_445_77;

/// Sony S-Log3 of scene reflectance \[Sony2016\].
pub(super) const S_LOG3: LinLog = LinLog {
    slope: (171.210_294_692_9 - 95.0) / 0.011_25 / 1023.0,
    intercept: 95.0 / 1023.0,
    base: Base::Ten,
    gain: 1.0 / 0.19,
    offset: 0.01 / 0.19,
    scale: 261.5 / 1023.0,
    shift: 420.0 / 1023.0,
    cut: 0.011_25,
    encoded_cut: 171.210_294_692_9 / 1023.0,
};

/// Panasonic V-Log \[Panasonic2014\].
pub(super) const V_LOG: LinLog = LinLog {
    slope: 5.6,
    intercept: 0.125,
    base: Base::Ten,
    gain: 1.0,
    offset: 0.008_73,
    scale: 0.241_514,
    shift: 0.598_206,
    cut: 0.01,
    encoded_cut: 0.181,
};

/// Log3G10, version 3 \[RED2017\].
pub(super) const LOG3G10: LinLog = LinLog {
    slope: 15.1927,
    intercept: 0.01 * 15.1927,
    base: Base::Ten,
    gain: 155.975_327,
    offset: 0.01 * 155.975_327 + 1.0,
    scale: 0.224_282,
    shift: 0.0,
    cut: -0.01,
    encoded_cut: 0.0,
};

/// What the density of unexposed film adds, 10^((95 − 685) / 300).
const FILM_BLACK: f64 = 0.010_797_751_623_277_1;

/// Cineon, printing density of film \[Kodak1995\]; RED's REDLogFilm is the same curve.
pub(super) const CINEON: LinLog = only_log(Base::Ten, 1.0 - FILM_BLACK, FILM_BLACK, 300.0 / 1023.0, 685.0 / 1023.0);

/// GoPro Protune \[GoPro2016\]: the logarithm of 1 + 112 x, to the base 113.
pub(super) const PROTUNE: LinLog = only_log(Base::E, 112.0, 1.0, 1.0 / LN_113, 0.0);

const LN_113: f64 = 4.727_387_818_712_341;

/// Fujifilm F-Log \[Fujifilm2022\].
pub(super) const F_LOG: LinLog = LinLog {
    slope: 8.735_631,
    intercept: 0.092_864,
    base: Base::Ten,
    gain: 0.555_556,
    offset: 0.009_468,
    scale: 0.344_676,
    shift: 0.790_453,
    cut: 0.000_89,
    encoded_cut: 0.100_537_775_223_865,
};

/// Fujifilm F-Log2 \[Fujifilm2022\].
pub(super) const F_LOG2: LinLog = LinLog {
    slope: 8.799_461,
    intercept: 0.092_864,
    base: Base::Ten,
    gain: 5.555_556,
    offset: 0.064_829,
    scale: 0.245_281,
    shift: 0.384_316,
    cut: 0.000_889,
    encoded_cut: 0.100_686_685_370_811,
};

/// Leica L-Log \[Leica2022\]: both cuts belong to the straight piece.
pub(super) const L_LOG: LinLog = LinLog {
    slope: 8.0,
    intercept: 0.09,
    base: Base::Ten,
    gain: 1.3,
    offset: 0.0115,
    scale: 0.27,
    shift: 0.6,
    cut: 0.006_f64.next_up(),
    encoded_cut: 0.138_f64.next_up(),
};

/// DaVinci Intermediate \[Blackmagic2021\]: both cuts belong to the straight piece.
pub(super) const DAVINCI_INTERMEDIATE: LinLog = LinLog {
    slope: 10.444_268_55,
    intercept: 0.0,
    base: Base::Two,
    gain: 1.0,
    offset: 0.0075,
    scale: 0.073_292_48,
    shift: 0.073_292_48 * 7.0,
    cut: 0.002_624_09_f64.next_up(),
    encoded_cut: 0.027_406_68_f64.next_up(),
};

/// Blackmagic Film of generation 5 \[Blackmagic2021\].
pub(super) const BLACKMAGIC_FILM_5: LinLog = LinLog {
    slope: 8.283_605_932_402_494,
    intercept: 0.092_465_753_424_657_53,
    base: Base::E,
    gain: 1.0,
    offset: 0.005_494_072_432_257_808,
    scale: 0.086_928_760_654_912_24,
    shift: 0.530_013_339_229_193_9,
    cut: 0.005,
    encoded_cut: 8.283_605_932_402_494 * 0.005 + 0.092_465_753_424_657_53,
};

/// FilmLight T-Log, from w = 128, g = 16, o = 0.075 \[FilmLight2018\].
pub(super) const T_LOG: LinLog = LinLog {
    slope: 16.184_376_489_665_897,
    intercept: 0.075,
    base: Base::E,
    gain: 1.0,
    offset: 0.005_704_824_404_247_378_5,
    scale: 0.092_329_025_965_773_53,
    shift: 0.552_012_656_860_665_5,
    cut: 0.0,
    encoded_cut: 0.075,
};

/// ERIMM RGB, exposures of 0.001 to 316.2 \[Spaulding2000\]: straight up to 0.001 e, which belongs to it.
pub(super) const ERIMM: LinLog = LinLog {
    slope: 1.0 / (ERIMM_LN_RANGE * ERIMM_CUT),
    intercept: 0.0,
    base: Base::E,
    gain: 1.0,
    offset: 0.0,
    scale: 1.0 / ERIMM_LN_RANGE,
    shift: 0.545_458_327_405_112_5,
    cut: ERIMM_CUT.next_up(),
    encoded_cut: (1.0 / ERIMM_LN_RANGE).next_up(),
};

const ERIMM_CUT: f64 = std::f64::consts::E * 0.001;
/// ln(316.2 / 0.001).
const ERIMM_LN_RANGE: f64 = 12.664_130_203_757_509;

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn pieces_meet_within_the_rounding_of_the_makers() {
        let mut curves = vec![
            (ACES_CCT, 1e-13),
            (LOG_C4, 1e-14),
            (S_LOG, 2e-8),
            (S_LOG2, 2e-8),
            (S_LOG3, 1e-8),
            (V_LOG, 1e-4),
            (LOG3G10, 1e-15),
            (F_LOG, 2e-4),
            (F_LOG2, 3e-5),
            (L_LOG, 1e-3),
            (DAVINCI_INTERMEDIATE, 1e-7),
            (BLACKMAGIC_FILM_5, 1e-14),
            (T_LOG, 1e-14),
            (ERIMM, 1e-14),
        ];
        curves.extend(LOG_C3.map(|(_, curve)| (curve, 5e-6)));
        for (curve, step) in curves {
            let (below, above) = (curve.encode(curve.cut.next_down()), curve.encode(curve.cut));
            assert!((above - below).abs() <= step, "{curve:?}: {below} {above}");
            let (below, above) = (curve.decode(curve.encoded_cut.next_down()), curve.decode(curve.encoded_cut));
            assert!((above - below).abs() <= step, "{curve:?}: {below} {above}");
        }
    }

    #[test]
    fn derived_constants_follow_from_the_makers_formulas() {
        let exponent = 14.0 * LOG_C4_C / LOG_C4_B;
        let s = 7.0 * std::f64::consts::LN_2 * math::exp2(7.0 - exponent) / (LOG_C4_A * LOG_C4_B);
        assert_relative_eq!(LOG_C4_S, s, max_relative = 1e-15);
        assert_relative_eq!(LOG_C4_T, (math::exp2(6.0 - exponent) - 64.0) / LOG_C4_A, max_relative = 1e-14);
        assert_relative_eq!(S_LOG_BLACK, S_LOG.encode(0.0), max_relative = 1e-15);
        assert_relative_eq!(FILM_BLACK, math::exp10((95.0 - 685.0) / 300.0), max_relative = 1e-14);
        assert_relative_eq!(LN_113, math::ln(113.0), max_relative = 1e-15);
        assert_relative_eq!(ERIMM_LN_RANGE, math::ln(316.2 / 0.001), max_relative = 1e-15);
        assert_relative_eq!(ERIMM.shift, -math::ln(0.001) / ERIMM_LN_RANGE, max_relative = 1e-15);
    }

    #[test]
    fn t_log_follows_from_its_three_parameters() {
        let (w, g, o) = (128.0, 16.0, 0.075);
        let b = 1.0 / (0.7107 + 1.2359 * math::ln(w * g));
        let gain = g / (1.0 - o);
        let c = b / gain;
        let a = 1.0 - b * math::ln(w + c);
        let s = (1.0 - o) / (1.0 - (a + b * math::ln(c)));
        assert_relative_eq!(T_LOG.shift, 1.0 + (a - 1.0) * s, max_relative = 1e-15);
        assert_relative_eq!(T_LOG.scale, b * s, max_relative = 1e-15);
        assert_relative_eq!(T_LOG.slope, gain * s, max_relative = 1e-15);
        assert_relative_eq!(T_LOG.offset, c, max_relative = 1e-15);
    }

    #[test]
    fn logarithms_end_at_minus_infinity() {
        for curve in [CINEON, PROTUNE] {
            assert_eq!(curve.encode(-1.0), f64::NEG_INFINITY);
            assert!(curve.decode(f64::NEG_INFINITY) < 0.0);
        }
        assert_eq!((PROTUNE.encode(0.0), PROTUNE.decode(0.0)), (0.0, 0.0));
    }
}
