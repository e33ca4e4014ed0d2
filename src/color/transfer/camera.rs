//! Camera curves that are not a straight piece and one logarithm.

use crate::math;

/// Canon's curves are mirrored at black; version 1.2, of scene reflectance \[Canon2020\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CanonLog {
    gain: f64,
    scale: f64,
    /// Codes that the mirrored and the upright logarithm start from.
    shift: [f64; 2],
    /// The straight piece between them, if any: slope, intercept.
    straight: [f64; 2],
    /// Codes where it begins and ends.
    encoded_cuts: [f64; 2],
}

/// Reflectance of the white that Canon counts as 1.
const CANON_WHITE: f64 = 0.9;

/// Canon Log.
pub(super) const CANON_LOG: CanonLog = canon_without_straight(10.1596, 0.453_101_79, 0.125_122_48);

/// Canon Log 2.
pub(super) const CANON_LOG2: CanonLog = canon_without_straight(87.099_375_46, 0.241_360_77, 0.092_864_125);

/// Canon Log 3.
pub(super) const CANON_LOG3: CanonLog = CanonLog {
    gain: 14.983_25,
    scale: 0.367_268_45,
    shift: [0.127_839_01, 0.122_405_37],
    straight: [1.975_479_8, 0.125_122_19],
    encoded_cuts: [0.097_465_473, 0.152_778_91],
};

const fn canon_without_straight(gain: f64, scale: f64, black: f64) -> CanonLog {
    CanonLog { gain, scale, shift: [black; 2], straight: [1.0, black], encoded_cuts: [black; 2] }
}

impl CanonLog {
    pub(super) fn encode(&self, linear: f64) -> f64 {
        let x = linear / CANON_WHITE;
        let [slope, intercept] = self.straight;
        let [from, to] = self.encoded_cuts.map(|code| (code - intercept) / slope);
        if x < from {
            self.shift[0] - self.scale * math::log10(1.0 - self.gain * x)
        } else if x <= to {
            slope * x + intercept
        } else {
            self.scale * math::log10(self.gain * x + 1.0) + self.shift[1]
        }
    }

    pub(super) fn decode(&self, encoded: f64) -> f64 {
        let [slope, intercept] = self.straight;
        let [from, to] = self.encoded_cuts;
        let x = if encoded < from {
            (1.0 - math::exp10((self.shift[0] - encoded) / self.scale)) / self.gain
        } else if encoded <= to {
            (encoded - intercept) / slope
        } else {
            (math::exp10((encoded - self.shift[1]) / self.scale) - 1.0) / self.gain
        };
        x * CANON_WHITE
    }
}

/// Nikon N-Log of scene reflectance \[Nikon2018\]: a cube root, then a logarithm.
pub(super) fn n_log_encode(linear: f64) -> f64 {
    if linear < 0.328 {
        650.0 / 1023.0 * math::cbrt(linear + 0.0075)
    } else {
        150.0 / 1023.0 * math::ln(linear) + 619.0 / 1023.0
    }
}

pub(super) fn n_log_decode(encoded: f64) -> f64 {
    if encoded < 452.0 / 1023.0 {
        let root = encoded / (650.0 / 1023.0);
        root * root * root - 0.0075
    } else {
        math::exp((encoded - 619.0 / 1023.0) / (150.0 / 1023.0))
    }
}

/// DJI D-Log \[DJI2017\], whose two directions were rounded apart: they are inverse to about 1e-5.
pub(super) fn d_log_encode(linear: f64) -> f64 {
    if linear <= 0.0078 {
        6.025 * linear + 0.0929
    } else {
        math::log10(linear * 0.9892 + 0.0108) * 0.256_663 + 0.584_555
    }
}

pub(super) fn d_log_decode(encoded: f64) -> f64 {
    if encoded <= 0.14 {
        (encoded - 0.0929) / 6.025
    } else {
        (math::exp10(3.896_16 * encoded - 2.277_52) - 0.0108) / 0.9892
    }
}

/// Where Apple's parabola begins and where the logarithm takes over.
const APPLE_BLACK: f64 = -0.056_410_88;
const APPLE_CUT: f64 = 0.01;
const APPLE_CURVATURE: f64 = 47.287_112_36;

/// Apple Log \[Apple2023\]: a parabola, then a logarithm; below −0.0564 the code is 0.
pub(super) fn apple_log_encode(linear: f64) -> f64 {
    if linear >= APPLE_CUT {
        0.085_504_79 * math::log2(linear + 0.009_640_52) + 0.693_369_45
    } else {
        let above = (linear - APPLE_BLACK).max(0.0);
        APPLE_CURVATURE * above * above
    }
}

pub(super) fn apple_log_decode(encoded: f64) -> f64 {
    if encoded >= APPLE_CURVATURE * ((APPLE_CUT - APPLE_BLACK) * (APPLE_CUT - APPLE_BLACK)) {
        math::exp2((encoded - 0.693_369_45) / 0.085_504_79) - 0.009_640_52
    } else {
        (encoded.max(0.0) / APPLE_CURVATURE).sqrt() + APPLE_BLACK
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_meet_within_the_rounding_of_the_makers() {
        type Function = fn(f64) -> f64;
        let meets = |curve: Function, at: f64, step: f64| {
            let (below, above) = (curve(at.next_down()), curve(at.next_up()));
            assert!((above - below).abs() <= step, "{at}: {below} {above}");
        };
        meets(|x| CANON_LOG.encode(x), 0.0, 1e-15);
        meets(|x| CANON_LOG2.encode(x), 0.0, 1e-15);
        meets(|x| CANON_LOG3.encode(x), 0.0126, 1e-7);
        meets(|x| CANON_LOG3.encode(x), -0.0126, 1e-7);
        meets(|x| CANON_LOG3.decode(x), 0.097_465_473, 1e-7);
        meets(|x| CANON_LOG3.decode(x), 0.152_778_91, 1e-7);
        meets(n_log_encode, 0.328, 2e-4);
        meets(n_log_decode, 452.0 / 1023.0, 2e-3);
        meets(d_log_encode, 0.0078, 1e-4);
        meets(apple_log_encode, APPLE_CUT, 1e-7);
        meets(apple_log_encode, APPLE_BLACK, 1e-15);
    }
}
