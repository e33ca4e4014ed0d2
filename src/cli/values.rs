//! Values that options of several commands take.

use super::usage;
use crate::Result;

/// Most pixels along a side.
const MAX_SIDE: u32 = 1 << 20;
/// Most pixels.
const MAX_PIXELS: u64 = 1 << 32;

/// Parses `--resolution WIDTHxHEIGHT`.
pub fn resolution(text: &str) -> Result<(u32, u32)> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    let size = text.split_once(['x', 'X']).and_then(|(width, height)| Some((side(width)?, side(height)?)));
    size.filter(|(width, height)| u64::from(*width) * u64::from(*height) <= MAX_PIXELS)
        .ok_or_else(|| usage(format!("--resolution {text}: expected WIDTHxHEIGHT in pixels, such as 640x480")))
}

/// Parses `--exposure EV|auto`; `None` is automatic.
pub fn exposure(text: &str) -> Result<Option<f64>> {
    if text == "auto" {
        return Ok(None);
    }
    let stops = text.parse().ok().filter(|stops: &f64| stops.abs() <= 200.0);
    stops.map(Some).ok_or_else(|| usage(format!("--exposure {text}: expected stops in [-200, 200], or auto")))
}
