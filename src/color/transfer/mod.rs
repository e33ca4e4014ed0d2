//! Transfer functions: how linear components become the numbers that files and signals hold.
//!
//! [`Transfer`] is the closed set of them. Linear 1 is the white of the space and code 1 the full signal, except for
//! `pq` and `dcdm`, which encode luminance in cd/m².
//!
//! # Outside of the nominal range
//! Nothing is clipped: outside of the range of its standard a curve goes on with the piece at its end, so that decoding
//! undoes encoding there too. Powers are mirrored at 0. Exceptions, which the standards demand: `pq`, `bt1886`,
//! `acescc`, `acesproxy-10`, `acesproxy-12` and `apple-log` have one code for black and everything below, and ACESproxy
//! has integer codes only. Curves that are a logarithm alone (`cineon`, `red-log-film`, `protune`) end at code −∞.
//!
//! # Sources
//! Video: \[IEC61966\], \[BT601\], \[BT709\], \[BT1886\], \[BT2020\], \[BT2100\], \[ST2084\], \[SMPTE240M\].
//! Cinema and stills: \[DCI2012\], \[AdobeRGB1998\], \[Spaulding2000\], \[ECI2007\], \[Kodak1995\], \[ACES\].
//! Cameras and grading: \[ARRI2017\], \[ARRI2022\], \[Sony2016\], \[Panasonic2014\], \[RED2017\], \[Canon2020\],
//! \[Fujifilm2022\], \[Nikon2018\], \[Leica2022\], \[DJI2017\], \[GoPro2016\], \[Apple2023\], \[Blackmagic2021\],
//! \[FilmLight2018\].

mod aces;
mod camera;
mod hdr;
mod log;
mod power;

pub use hdr::{Bt1886Display, HlgDisplay, pq_ootf, pq_ootf_inverse};

use crate::color::lightness::CIE_1976_BREAK;
use crate::{Error, ErrorKind, Result, math};
use std::borrow::Cow;

/// A transfer function. Codes are relative to the full scale of their integers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Transfer {
    /// Code is linear.
    Linear,
    /// The code to this power is linear, mirrored at 0.
    Gamma(f64),
    /// sRGB, and Display P3.
    Srgb,
    /// BT.709, and BT.601.
    Bt709,
    /// BT.2020 of 10 bits, which rounds its constants to those of BT.709.
    Bt2020,
    /// BT.2020 of 12 bits.
    Bt2020TwelveBit,
    /// BT.2020 with unrounded constants.
    Bt2020Exact,
    /// The ideal display of BT.1886: gamma 2.4, nothing below black. See [`Bt1886Display`] for real ones.
    Bt1886,
    /// SMPTE 240M.
    Smpte240m,
    /// Digital cinema distribution master: gamma 2.6, code 1 is 52.37 cd/m².
    Dcdm,
    /// CIE lightness over 100, of ECI RGB v2.
    CieLightness,
    /// ROMM RGB, which is ProPhoto RGB.
    Romm,
    /// RIMM RGB: code 1 is twice white.
    Rimm,
    /// ERIMM RGB: code 1 is 316.2 times white.
    Erimm,
    /// Perceptual quantiser of ST 2084: code 1 is 10 000 cd/m².
    Pq,
    /// Hybrid log-gamma of a scene-linear component. See [`HlgDisplay`] for what displays show.
    Hlg,
    /// ACEScc.
    AcesCc,
    /// ACEScct.
    AcesCct,
    /// ACESproxy of 10 bits.
    AcesProxy10,
    /// ACESproxy of 12 bits.
    AcesProxy12,
    /// ARRI LogC3 at an exposure index.
    LogC3(ExposureIndex),
    /// ARRI LogC4.
    LogC4,
    /// Sony S-Log.
    SLog,
    /// Sony S-Log2.
    SLog2,
    /// Sony S-Log3.
    SLog3,
    /// Panasonic V-Log.
    VLog,
    /// RED Log3G10, version 3.
    Log3G10,
    /// RED REDLogFilm, which is Cineon.
    RedLogFilm,
    /// Cineon.
    Cineon,
    /// Canon Log, version 1.2.
    CanonLog,
    /// Canon Log 2, version 1.2.
    CanonLog2,
    /// Canon Log 3, version 1.2.
    CanonLog3,
    /// Fujifilm F-Log.
    FLog,
    /// Fujifilm F-Log2.
    FLog2,
    /// Nikon N-Log.
    NLog,
    /// Leica L-Log.
    LLog,
    /// DJI D-Log.
    DLog,
    /// GoPro Protune.
    Protune,
    /// Apple Log.
    AppleLog,
    /// DaVinci Intermediate.
    DavinciIntermediate,
    /// Blackmagic Film, generation 5.
    BlackmagicFilm5,
    /// FilmLight T-Log.
    TLog,
}

/// An exposure index that ARRI gives a LogC3 curve for: 160, 200, 250, …, 1600.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExposureIndex(usize);

impl ExposureIndex {
    /// EI 800, the usual one.
    pub const EI_800: Self = Self(7);

    /// An exposure index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for one without a curve.
    pub fn new(ei: u16) -> Result<Self> {
        log::LOG_C3.iter().position(|(known, _)| *known == ei).map(Self).ok_or_else(|| {
            let known = log::LOG_C3.map(|(known, _)| known.to_string()).join(", ");
            Error::new(ErrorKind::OutOfRange, format!("exposure index {ei}; expected one of {known}"))
        })
    }

    /// The number.
    pub fn value(self) -> u16 {
        log::LOG_C3[self.0].0
    }
}

/// Adobe RGB's exponent, 2 + 51/256.
pub(super) const ADOBE_GAMMA: f64 = 2.199_218_75;

/// Luminance of DCDM code 1, cd/m².
const DCDM_PEAK: f64 = 52.37;

const NAMED: [(&str, Transfer); 59] = [
    ("linear", Transfer::Linear),
    ("gamma-1.8", Transfer::Gamma(1.8)),
    ("gamma-2.0", Transfer::Gamma(2.0)),
    ("gamma-2.2", Transfer::Gamma(2.2)),
    ("gamma-2.4", Transfer::Gamma(2.4)),
    ("gamma-2.6", Transfer::Gamma(2.6)),
    ("gamma-2.8", Transfer::Gamma(2.8)),
    ("adobe-rgb", Transfer::Gamma(ADOBE_GAMMA)),
    ("srgb", Transfer::Srgb),
    ("bt601", Transfer::Bt709),
    ("bt709", Transfer::Bt709),
    ("bt2020", Transfer::Bt2020),
    ("bt2020-12bit", Transfer::Bt2020TwelveBit),
    ("bt2020-exact", Transfer::Bt2020Exact),
    ("bt1886", Transfer::Bt1886),
    ("smpte-240m", Transfer::Smpte240m),
    ("dcdm", Transfer::Dcdm),
    ("cie-lightness", Transfer::CieLightness),
    ("romm", Transfer::Romm),
    ("rimm", Transfer::Rimm),
    ("erimm", Transfer::Erimm),
    ("pq", Transfer::Pq),
    ("hlg", Transfer::Hlg),
    ("acescc", Transfer::AcesCc),
    ("acescct", Transfer::AcesCct),
    ("acesproxy-10", Transfer::AcesProxy10),
    ("acesproxy-12", Transfer::AcesProxy12),
    ("logc3", Transfer::LogC3(ExposureIndex::EI_800)),
    ("logc3-ei160", Transfer::LogC3(ExposureIndex(0))),
    ("logc3-ei200", Transfer::LogC3(ExposureIndex(1))),
    ("logc3-ei250", Transfer::LogC3(ExposureIndex(2))),
    ("logc3-ei320", Transfer::LogC3(ExposureIndex(3))),
    ("logc3-ei400", Transfer::LogC3(ExposureIndex(4))),
    ("logc3-ei500", Transfer::LogC3(ExposureIndex(5))),
    ("logc3-ei640", Transfer::LogC3(ExposureIndex(6))),
    ("logc3-ei1000", Transfer::LogC3(ExposureIndex(8))),
    ("logc3-ei1280", Transfer::LogC3(ExposureIndex(9))),
    ("logc3-ei1600", Transfer::LogC3(ExposureIndex(10))),
    ("logc4", Transfer::LogC4),
    ("s-log", Transfer::SLog),
    ("s-log2", Transfer::SLog2),
    ("s-log3", Transfer::SLog3),
    ("v-log", Transfer::VLog),
    ("log3g10", Transfer::Log3G10),
    ("red-log-film", Transfer::RedLogFilm),
    ("cineon", Transfer::Cineon),
    ("canon-log", Transfer::CanonLog),
    ("canon-log2", Transfer::CanonLog2),
    ("canon-log3", Transfer::CanonLog3),
    ("f-log", Transfer::FLog),
    ("f-log2", Transfer::FLog2),
    ("n-log", Transfer::NLog),
    ("l-log", Transfer::LLog),
    ("d-log", Transfer::DLog),
    ("protune", Transfer::Protune),
    ("apple-log", Transfer::AppleLog),
    ("davinci-intermediate", Transfer::DavinciIntermediate),
    ("blackmagic-film-5", Transfer::BlackmagicFilm5),
    ("t-log", Transfer::TLog),
];

impl Transfer {
    /// Names that [`Transfer::by_name`] knows; `gamma-X` works for other X too.
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMED.into_iter().map(|(name, _)| name)
    }

    /// A transfer function by its name, or `gamma-X` for a positive number X.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        let named = NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, transfer)| transfer);
        named
            .or_else(|| gamma_by_name(name))
            .ok_or_else(|| Error::unknown_name("transfer function", name, Self::names().chain(["gamma-X"])))
    }

    /// A name that [`Transfer::by_name`] finds it by.
    pub fn name(self) -> Cow<'static, str> {
        let named = NAMED.into_iter().find(|(_, known)| *known == self);
        match (named, self) {
            (Some((name, _)), _) => Cow::Borrowed(name),
            (None, Transfer::Gamma(exponent)) => Cow::Owned(format!("gamma-{exponent}")),
            (None, other) => Cow::Owned(format!("{other:?}")),
        }
    }

    /// Code of a linear component.
    pub fn encode(self, linear: f64) -> f64 {
        if let Some(curve) = self.offset_power() {
            return curve.encode(linear);
        }
        if let Some(curve) = self.lin_log() {
            return curve.encode(linear);
        }
        match self {
            Transfer::Gamma(exponent) => math::signed_pow(linear, 1.0 / exponent),
            Transfer::Bt1886 => math::pow(linear.max(0.0), 1.0 / 2.4),
            Transfer::Dcdm => math::signed_pow(linear / DCDM_PEAK, 1.0 / 2.6),
            Transfer::CieLightness => lightness_encode(linear),
            Transfer::Pq => hdr::pq_encode(linear),
            Transfer::Hlg => hdr::hlg_encode(linear),
            Transfer::AcesCc => aces::cc_encode(linear),
            Transfer::AcesProxy10 => aces::PROXY_10.encode(linear),
            Transfer::AcesProxy12 => aces::PROXY_12.encode(linear),
            Transfer::CanonLog => camera::CANON_LOG.encode(linear),
            Transfer::CanonLog2 => camera::CANON_LOG2.encode(linear),
            Transfer::CanonLog3 => camera::CANON_LOG3.encode(linear),
            Transfer::NLog => camera::n_log_encode(linear),
            Transfer::DLog => camera::d_log_encode(linear),
            Transfer::AppleLog => camera::apple_log_encode(linear),
            _ => linear,
        }
    }

    /// Linear component of a code.
    pub fn decode(self, encoded: f64) -> f64 {
        if let Some(curve) = self.offset_power() {
            return curve.decode(encoded);
        }
        if let Some(curve) = self.lin_log() {
            return curve.decode(encoded);
        }
        match self {
            Transfer::Gamma(exponent) => math::signed_pow(encoded, exponent),
            Transfer::Bt1886 => math::pow(encoded.max(0.0), 2.4),
            Transfer::Dcdm => DCDM_PEAK * math::signed_pow(encoded, 2.6),
            Transfer::CieLightness => lightness_decode(encoded),
            Transfer::Pq => hdr::pq_decode(encoded),
            Transfer::Hlg => hdr::hlg_decode(encoded),
            Transfer::AcesCc => aces::cc_decode(encoded),
            Transfer::AcesProxy10 => aces::PROXY_10.decode(encoded),
            Transfer::AcesProxy12 => aces::PROXY_12.decode(encoded),
            Transfer::CanonLog => camera::CANON_LOG.decode(encoded),
            Transfer::CanonLog2 => camera::CANON_LOG2.decode(encoded),
            Transfer::CanonLog3 => camera::CANON_LOG3.decode(encoded),
            Transfer::NLog => camera::n_log_decode(encoded),
            Transfer::DLog => camera::d_log_decode(encoded),
            Transfer::AppleLog => camera::apple_log_decode(encoded),
            _ => encoded,
        }
    }

    fn offset_power(self) -> Option<&'static power::OffsetPower> {
        Some(match self {
            Transfer::Srgb => &power::SRGB,
            Transfer::Bt709 | Transfer::Bt2020 => &power::BT709,
            Transfer::Bt2020TwelveBit => &power::BT2020_TWELVE_BIT,
            Transfer::Bt2020Exact => &power::BT2020_EXACT,
            Transfer::Smpte240m => &power::SMPTE_240M,
            Transfer::Romm => &power::ROMM,
            Transfer::Rimm => &power::RIMM,
            _ => return None,
        })
    }

    fn lin_log(self) -> Option<&'static log::LinLog> {
        Some(match self {
            Transfer::Erimm => &log::ERIMM,
            Transfer::AcesCct => &log::ACES_CCT,
            Transfer::LogC3(index) => log_c3(index),
            Transfer::LogC4 => &log::LOG_C4,
            Transfer::SLog => &log::S_LOG,
            Transfer::SLog2 => &log::S_LOG2,
            Transfer::SLog3 => &log::S_LOG3,
            Transfer::VLog => &log::V_LOG,
            Transfer::Log3G10 => &log::LOG3G10,
            Transfer::Cineon | Transfer::RedLogFilm => &log::CINEON,
            Transfer::FLog => &log::F_LOG,
            Transfer::FLog2 => &log::F_LOG2,
            Transfer::LLog => &log::L_LOG,
            Transfer::Protune => &log::PROTUNE,
            Transfer::DavinciIntermediate => &log::DAVINCI_INTERMEDIATE,
            Transfer::BlackmagicFilm5 => &log::BLACKMAGIC_FILM_5,
            Transfer::TLog => &log::T_LOG,
            _ => return None,
        })
    }
}

fn log_c3(index: ExposureIndex) -> &'static log::LinLog {
    static CURVES: [(u16, log::LinLog); 11] = log::LOG_C3;
    &CURVES[index.0].1
}

fn gamma_by_name(name: &str) -> Option<Transfer> {
    let exponent: f64 = name.strip_prefix("gamma-")?.parse().ok()?;
    (exponent > 0.0 && exponent.is_finite()).then_some(Transfer::Gamma(exponent))
}

/// Slope of CIE lightness near black, over 100 \[CIE15\].
const LIGHTNESS_SLOPE: f64 = 24_389.0 / 2700.0;

fn lightness_encode(linear: f64) -> f64 {
    if linear <= CIE_1976_BREAK { LIGHTNESS_SLOPE * linear } else { 1.16 * math::cbrt(linear) - 0.16 }
}

fn lightness_decode(encoded: f64) -> f64 {
    if encoded <= 0.08 {
        return encoded / LIGHTNESS_SLOPE;
    }
    let root = (encoded + 0.16) / 1.16;
    root * root * root
}

/// Linear component to encoded sRGB component \[IEC61966\]; 0 and 1 map to themselves. As [`Transfer::Srgb`].
pub fn srgb_encode(linear: f64) -> f64 {
    power::SRGB.encode(linear)
}

/// Encoded sRGB component to linear component, the inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    power::SRGB.decode(encoded)
}

#[cfg(test)]
mod tests;
