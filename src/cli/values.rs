//! Values that options of several commands take.

use super::usage;
use crate::Result;
use crate::scene::description::{EXPOSURES_EV, MAX_PIXELS, MAX_SIDE};

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
    let (low, high) = EXPOSURES_EV;
    let stops = text.parse::<f64>().ok().filter(|stops| (low..=high).contains(stops));
    stops.map(Some).ok_or_else(|| usage(format!("--exposure {text}: expected stops in [{low}, {high}], or auto")))
}
