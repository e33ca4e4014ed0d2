//! ACEScc and ACESproxy, the logarithmic working encodings of \[ACES\] that no straight-and-log pair describes.

use crate::math;

/// Stops from black to white of ACEScc, and how far below 1 its middle lies.
const STOPS: f64 = 17.52;
const BELOW: f64 = 9.72;
/// Where the toe begins: exposures below 2⁻¹⁵.
const TOE: f64 = 1.0 / 32_768.0;
/// The largest half-precision number, which the standard's decoder does not exceed.
const LARGEST_HALF: f64 = 65_504.0;

/// S-2014-003: the toe averages the exposure with 2⁻¹⁵; 0 and below are the same code.
pub(super) fn cc_encode(linear: f64) -> f64 {
    let exposure = if linear < TOE { 0.5 * TOE + 0.5 * linear.max(0.0) } else { linear };
    (math::log2(exposure) + BELOW) / STOPS
}

pub(super) fn cc_decode(encoded: f64) -> f64 {
    let exposure = math::exp2(encoded * STOPS - BELOW);
    if encoded < (BELOW - 15.0) / STOPS { (exposure - 0.5 * TOE) * 2.0 } else { exposure.min(LARGEST_HALF) }
}

/// The integer codes of ACESproxy, S-2013-001.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Proxy {
    least_code: f64,
    largest_code: f64,
    codes_per_stop: f64,
    middle_code: f64,
    full_scale: f64,
}

/// Codes of 10 bits.
pub(super) const PROXY_10: Proxy =
    Proxy { least_code: 64.0, largest_code: 940.0, codes_per_stop: 50.0, middle_code: 425.0, full_scale: 1023.0 };

/// Codes of 12 bits.
pub(super) const PROXY_12: Proxy =
    Proxy { least_code: 256.0, largest_code: 3760.0, codes_per_stop: 200.0, middle_code: 1700.0, full_scale: 4095.0 };

/// log₂ of the exposure of the middle code.
const MIDDLE_STOP: f64 = -2.5;
/// 2^−9.72: exposures up to here have the least code.
const PROXY_BLACK: f64 = 0.001_185_737_191_792_037_4;

impl Proxy {
    pub(super) fn encode(&self, linear: f64) -> f64 {
        if linear <= PROXY_BLACK {
            return self.least_code / self.full_scale;
        }
        let code = (math::log2(linear) - MIDDLE_STOP) * self.codes_per_stop + self.middle_code;
        code.round().clamp(self.least_code, self.largest_code) / self.full_scale
    }

    pub(super) fn decode(&self, encoded: f64) -> f64 {
        let code = encoded * self.full_scale;
        math::exp2((code - self.middle_code) / self.codes_per_stop + MIDDLE_STOP)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants() {
        assert!((PROXY_BLACK - math::exp2(-9.72)).abs() < 1e-18);
        assert_eq!(TOE, math::exp2(-15.0));
    }

    /// The middle code is 18 % grey within one code, and every code survives decoding.
    #[test]
    fn proxy_codes_are_integers_that_come_back() {
        for proxy in [PROXY_10, PROXY_12] {
            let mut code = proxy.least_code + 1.0;
            while code <= proxy.largest_code {
                let encoded = code / proxy.full_scale;
                assert!((proxy.encode(proxy.decode(encoded)) * proxy.full_scale - code).abs() < 1e-9, "{code}");
                code += 1.0;
            }
            assert_eq!(proxy.encode(-1.0), proxy.least_code / proxy.full_scale);
            assert_eq!(proxy.encode(1e9), proxy.largest_code / proxy.full_scale);
        }
        assert!((PROXY_10.encode(0.18) * 1023.0 - 426.0).abs() < 1e-9);
    }

    #[test]
    fn the_toe_is_continuous_and_ends_at_zero() {
        assert_eq!(cc_encode(-1.0), cc_encode(0.0));
        assert!((cc_encode(TOE) - cc_encode(TOE.next_down())).abs() < 1e-15);
        assert!(cc_decode(cc_encode(0.0)).abs() < 1e-19);
        assert_eq!(cc_decode(2.0), LARGEST_HALF);
    }
}
