//! High dynamic range: the perceptual quantiser, hybrid log-gamma, and what their displays add.

use crate::color::{EncodedRgb, LinearRgb};
use crate::{Error, ErrorKind, Result, math};
use glam::DVec3;

/// m₁, m₂, c₁, c₂, c₃ of \[ST2084\].
const M1: f64 = 2610.0 / 16_384.0;
const M2: f64 = 2523.0 / 4096.0 * 128.0;
const C1: f64 = 3424.0 / 4096.0;
const C2: f64 = 2413.0 / 4096.0 * 32.0;
const C3: f64 = 2392.0 / 4096.0 * 32.0;
/// Luminance of code 1, cd/m².
const PQ_PEAK: f64 = 10_000.0;

/// Code of a luminance in cd/m²; negative ones have the code of 0.
pub(super) fn pq_encode(luminance: f64) -> f64 {
    let y = math::pow((luminance / PQ_PEAK).max(0.0), M1);
    math::pow((C1 + C2 * y) / (1.0 + C3 * y), M2)
}

/// Luminance in cd/m²; codes of 1.99 and more, where the curve has its pole, are infinite.
pub(super) fn pq_decode(encoded: f64) -> f64 {
    let v = math::pow(encoded.max(0.0), 1.0 / M2);
    let below = C2 - C3 * v;
    if below <= 0.0 {
        return f64::INFINITY;
    }
    PQ_PEAK * math::pow((v - C1).max(0.0) / below, 1.0 / M1)
}

/// The scene-to-display part of \[BT2100\] PQ: display luminance in cd/m² of a scene-linear component in [0, 1].
///
/// It is the look of a \[BT709\] camera (of 59.5208 times the component) shown by a \[BT1886\] display of 100 cd/m².
/// Negative components have no luminance.
pub fn pq_ootf(scene: f64) -> f64 {
    let video = super::power::BT709.encode(59.5208 * scene);
    100.0 * math::pow(video.max(0.0), 2.4)
}

/// Scene-linear component of a display luminance in cd/m², the inverse of [`pq_ootf`].
pub fn pq_ootf_inverse(luminance: f64) -> f64 {
    let video = math::pow((luminance / 100.0).max(0.0), 1.0 / 2.4);
    super::power::BT709.decode(video) / 59.5208
}

/// a of \[BT2100\] HLG; b = 1 − 4 a; c = 1/2 − a ln 4 a.
const A: f64 = 0.178_832_77;
const B: f64 = 1.0 - 4.0 * A;
const C: f64 = 0.559_910_729_529_562;

/// Code of a scene-linear component: a square root, mirrored at 0, then from 1/12 on a logarithm.
pub(super) fn hlg_encode(scene: f64) -> f64 {
    let e = 12.0 * scene;
    if e <= 1.0 { (e.abs().sqrt() * 0.5).copysign(e) } else { A * math::ln(e - B) + C }
}

pub(super) fn hlg_decode(encoded: f64) -> f64 {
    let e = if encoded <= 0.5 { 4.0 * encoded * encoded.abs() } else { math::exp((encoded - C) / A) + B };
    e / 12.0
}

/// Luminance weights of \[BT2100\], as it rounds them.
const HLG_LUMINANCE: DVec3 = DVec3::new(0.2627, 0.6780, 0.0593);

/// A display of hybrid log-gamma \[BT2100\]: what it shows depends on its black and its peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HlgDisplay {
    black: f64,
    peak: f64,
    gamma: f64,
    /// β: what black lifts the signal by.
    lift: f64,
}

impl HlgDisplay {
    /// A display by its luminance of black and of peak white in cd/m².
    ///
    /// # Errors
    /// Luminances that are not finite, a black that is negative or not below the peak, a peak so low (1.4 cd/m²) that
    /// the standard's system gamma is not positive.
    pub fn new(black_luminance: f64, peak_luminance: f64) -> Result<Self> {
        check_luminances(black_luminance, peak_luminance)?;
        let gamma = 1.2 + 0.42 * math::log10(peak_luminance / 1000.0);
        if gamma <= 0.0 {
            let message = format!("a peak of {peak_luminance} cd/m²; expected an HLG display of at least 1.4 cd/m²");
            return Err(Error::new(ErrorKind::OutOfRange, message));
        }
        let lift = (3.0 * math::pow(black_luminance / peak_luminance, 1.0 / gamma)).sqrt();
        Ok(Self { black: black_luminance, peak: peak_luminance, gamma, lift })
    }

    /// The exponent by which luminance grows from scene to display: 1.2 at 1000 cd/m².
    pub fn system_gamma(&self) -> f64 {
        self.gamma
    }

    /// Luminance of black, cd/m².
    pub fn black_luminance(&self) -> f64 {
        self.black
    }

    /// What the display shows of a signal, R, G and B in cd/m².
    pub fn eotf(&self, signal: EncodedRgb) -> LinearRgb {
        let lifted = signal.0 * (1.0 - self.lift) + self.lift;
        let scene = lifted.map(|x| hlg_decode(x.max(0.0)));
        let luminance = HLG_LUMINANCE.dot(scene);
        if luminance == 0.0 {
            return LinearRgb(DVec3::ZERO);
        }
        LinearRgb(self.peak * math::pow(luminance, self.gamma - 1.0) * scene)
    }

    /// The signal that makes the display show R, G and B in cd/m², the inverse of [`HlgDisplay::eotf`].
    pub fn eotf_inverse(&self, display: LinearRgb) -> EncodedRgb {
        let relative = display.0 / self.peak;
        let luminance = HLG_LUMINANCE.dot(relative);
        let scene = if luminance <= 0.0 {
            DVec3::ZERO
        } else {
            relative * math::pow(luminance, (1.0 - self.gamma) / self.gamma)
        };
        EncodedRgb((scene.map(hlg_encode) - self.lift) / (1.0 - self.lift))
    }
}

/// A reference display for studio video \[BT1886\]: gamma 2.4 with a lifted black.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bt1886Display {
    gain: f64,
    lift: f64,
}

impl Bt1886Display {
    /// A display by its luminance of black and of white in cd/m².
    ///
    /// # Errors
    /// Luminances that are not finite; a black that is negative or not below white.
    pub fn new(black_luminance: f64, white_luminance: f64) -> Result<Self> {
        check_luminances(black_luminance, white_luminance)?;
        let [black, white] = [black_luminance, white_luminance].map(|l| math::pow(l, 1.0 / 2.4));
        Ok(Self { gain: math::pow(white - black, 2.4), lift: black / (white - black) })
    }

    /// Luminance in cd/m² of a signal, 0 at black and 1 at white; signals that would need a negative one give 0.
    pub fn eotf(&self, signal: f64) -> f64 {
        self.gain * math::pow((signal + self.lift).max(0.0), 2.4)
    }

    /// Signal of a luminance in cd/m²; negative ones count as 0.
    pub fn eotf_inverse(&self, luminance: f64) -> f64 {
        math::pow((luminance / self.gain).max(0.0), 1.0 / 2.4) - self.lift
    }
}

fn check_luminances(black: f64, white: f64) -> Result<()> {
    if black.is_finite() && white.is_finite() && (0.0..white).contains(&black) {
        return Ok(());
    }
    let message = format!("black of {black} and white of {white} cd/m²; expected 0 ≤ black < white, both finite");
    Err(Error::new(ErrorKind::OutOfRange, message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn pq_has_the_published_codes() {
        // BT.2100 and BT.2408: 100 cd/m² is 50.8 %, 203 is 58 %, 1000 is 75.2 %, 10 000 is 1.
        for (luminance, code) in [(100.0, 0.508), (203.0, 0.581), (1000.0, 0.752), (10_000.0, 1.0)] {
            assert_relative_eq!(pq_encode(luminance), code, epsilon = 5e-4);
        }
        assert_eq!((pq_encode(-1.0), pq_decode(0.0)), (pq_encode(0.0), 0.0));
        assert_eq!(pq_decode(2.5), f64::INFINITY);
    }

    #[test]
    fn hlg_has_the_published_codes() {
        assert_eq!((hlg_encode(0.0), hlg_encode(1.0 / 12.0)), (0.0, 0.5));
        assert_relative_eq!(hlg_encode(1.0), 1.0, epsilon = 1e-8);
        assert_relative_eq!(C, 0.5 - A * math::ln(4.0 * A), max_relative = 1e-15);
        assert_relative_eq!(hlg_decode(hlg_encode(-0.3)), -0.3, max_relative = 1e-15);
    }

    #[test]
    fn displays_show_their_black_and_white() {
        let display = HlgDisplay::new(0.005, 1000.0).unwrap();
        assert_relative_eq!(display.system_gamma(), 1.2, max_relative = 1e-15);
        let white = display.eotf(EncodedRgb(DVec3::ONE));
        assert!((white.0 - 1000.0).abs().max_element() < 1e-3, "{white:?}");
        let black = display.eotf(EncodedRgb(DVec3::ZERO));
        assert_relative_eq!(black.0.y, display.black_luminance(), max_relative = 1e-12);
        let video = Bt1886Display::new(0.05, 100.0).unwrap();
        assert_relative_eq!(video.eotf(1.0), 100.0, max_relative = 1e-14);
        assert_relative_eq!(video.eotf(0.0), 0.05, max_relative = 1e-14);
        assert_eq!(video.eotf(-1.0), 0.0);
    }

    #[test]
    fn displays_are_inverted() {
        let display = HlgDisplay::new(0.1, 400.0).unwrap();
        let video = Bt1886Display::new(0.01, 203.0).unwrap();
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let signal = EncodedRgb(DVec3::new(x, 0.3, 1.0 - x));
            let back = display.eotf_inverse(display.eotf(signal));
            assert!((back.0 - signal.0).abs().max_element() < 1e-13, "{back:?}");
            assert_relative_eq!(video.eotf_inverse(video.eotf(x)), x, epsilon = 1e-14);
            assert_relative_eq!(pq_ootf_inverse(pq_ootf(x)), x, epsilon = 1e-14, max_relative = 1e-13);
        }
        assert_eq!(display.eotf_inverse(LinearRgb(DVec3::ZERO)).0.x, -display.lift / (1.0 - display.lift));
    }

    #[test]
    fn impossible_displays_are_errors() {
        for (black, white) in [(-0.1, 100.0), (100.0, 100.0), (f64::NAN, 100.0), (0.0, f64::INFINITY)] {
            assert!(HlgDisplay::new(black, white).is_err() && Bt1886Display::new(black, white).is_err());
        }
        assert!(HlgDisplay::new(0.0, 1.0).unwrap_err().message.contains("1.4"));
    }
}
