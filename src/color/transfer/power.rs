//! Curves made of a straight piece near black and a power with an offset: video, sRGB, ROMM.

use crate::math;

/// `slope·x` below the cut, `gain·x^exponent − offset` from it on.
///
/// Below black the straight piece goes on, above white the power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OffsetPower {
    slope: f64,
    gain: f64,
    offset: f64,
    exponent: f64,
    inverse_exponent: f64,
    /// The least linear value that belongs to the power.
    cut: f64,
    /// The least encoded value that does, as the standard gives it.
    encoded_cut: f64,
}

impl OffsetPower {
    pub(super) fn encode(&self, linear: f64) -> f64 {
        if linear < self.cut { self.slope * linear } else { self.gain * math::pow(linear, self.exponent) - self.offset }
    }

    pub(super) fn decode(&self, encoded: f64) -> f64 {
        if encoded < self.encoded_cut {
            encoded / self.slope
        } else {
            math::pow((encoded + self.offset) / self.gain, self.inverse_exponent)
        }
    }
}

/// \[IEC61966\]: both cuts belong to the straight piece.
pub(super) const SRGB: OffsetPower = OffsetPower {
    slope: 12.92,
    gain: 1.055,
    offset: 0.055,
    exponent: 1.0 / 2.4,
    inverse_exponent: 2.4,
    cut: 0.003_130_8_f64.next_up(),
    encoded_cut: 0.040_45_f64.next_up(),
};

/// \[BT709\], \[BT601\] and \[BT2020\] for 10 bits.
pub(super) const BT709: OffsetPower = video(1.099, 0.018);

/// \[BT2020\] for 12 bits.
pub(super) const BT2020_TWELVE_BIT: OffsetPower = video(1.0993, 0.0181);

/// \[BT2020\] with the numbers that make value and slope continuous, not rounded for bits.
pub(super) const BT2020_EXACT: OffsetPower = video(1.099_296_826_809_44, 0.018_053_968_510_807);

const fn video(alpha: f64, beta: f64) -> OffsetPower {
    OffsetPower {
        slope: 4.5,
        gain: alpha,
        offset: alpha - 1.0,
        exponent: 0.45,
        inverse_exponent: 1.0 / 0.45,
        cut: beta,
        encoded_cut: 4.5 * beta,
    }
}

/// \[SMPTE240M\]; the code of the cut, which it rounds to 0.0913, as the power gives it: so decoding undoes encoding.
pub(super) const SMPTE_240M: OffsetPower = OffsetPower {
    slope: 4.0,
    gain: 1.1115,
    offset: 0.1115,
    exponent: 0.45,
    inverse_exponent: 1.0 / 0.45,
    cut: 0.0228,
    encoded_cut: 0.091_259_003_526_327_61,
};

/// \[Spaulding2000\], output-referred: the pieces meet at 16^(1.8 / (1 − 1.8)) = 2⁻⁹.
pub(super) const ROMM: OffsetPower = OffsetPower {
    slope: 16.0,
    gain: 1.0,
    offset: 0.0,
    exponent: 1.0 / 1.8,
    inverse_exponent: 1.8,
    cut: 1.0 / 512.0,
    encoded_cut: 1.0 / 32.0,
};

/// Code of the scene-referred \[Spaulding2000\] curve's white clip of 2, before it is scaled to 1: 1.099 · 2^0.45 − 0.099.
const RIMM_CLIP: f64 = 1.402_278_242_173_080_6;

/// \[Spaulding2000\], scene-referred: the video curve scaled so that an exposure of 2 is 1.
pub(super) const RIMM: OffsetPower = OffsetPower {
    slope: 4.5 / RIMM_CLIP,
    gain: 1.099 / RIMM_CLIP,
    offset: 0.099 / RIMM_CLIP,
    encoded_cut: 0.081 / RIMM_CLIP,
    ..BT709
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_meet_within_the_rounding_of_the_standards() {
        for (curve, step) in [
            (SRGB, 3e-8),
            (BT709, 2.5e-4),
            (BT2020_TWELVE_BIT, 4e-5),
            (BT2020_EXACT, 1e-14),
            (SMPTE_240M, 7e-5),
            (ROMM, 1e-16),
            (RIMM, 2e-4),
        ] {
            let (below, above) = (curve.encode(curve.cut.next_down()), curve.encode(curve.cut));
            assert!((above - below).abs() <= step, "{curve:?}: {below} {above}");
            let (below, above) = (curve.decode(curve.encoded_cut.next_down()), curve.decode(curve.encoded_cut));
            assert!((above - below).abs() <= step, "{curve:?}: {below} {above}");
        }
    }

    #[test]
    fn derived_constants_are_those_of_the_standards() {
        assert_eq!(RIMM_CLIP, 1.099 * math::pow(2.0, 0.45) - 0.099);
        assert_eq!(ROMM.cut, math::pow(16.0, 1.8 / (1.0 - 1.8)));
        assert!((ROMM.encode(ROMM.cut) - ROMM.encoded_cut).abs() < 1e-17);
        assert!((SMPTE_240M.encode(SMPTE_240M.cut) - SMPTE_240M.encoded_cut).abs() < 1e-16);
        assert!((RIMM.encode(2.0) - 1.0).abs() < 1e-15);
    }
}
