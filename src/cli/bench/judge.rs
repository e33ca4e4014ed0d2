//! The errors of a picture against the reference.

use super::measure::Run;
use super::reference::Reference;
use super::variant::{Kind, Variant};
use crate::metrics::{self, Pair};
use crate::{Image, Result};

impl Run {
    /// Fills in the errors of a picture.
    pub fn judge(&mut self, picture: &Image, reference: &Reference, mask: Option<&[bool]>) -> Result<()> {
        let pair = Pair::new(picture, &reference.mean, mask)?;
        self.raw_relmse = metrics::relative_mse(&pair);
        self.trimmed_relmse = metrics::trimmed_relative_mse(&pair);
        self.non_finite_pixels = pair.non_finite()[0];
        Ok(())
    }
}

/// Brings the picture of another program to the reference's scale.
pub fn rescale(variant: &Variant, picture: Image, reference: &Reference) -> Result<Image> {
    let Kind::Command { scale, .. } = variant.kind else { return Ok(picture) };
    let factor = match scale {
        Some(factor) => factor,
        None => {
            let pair = Pair::new(&picture, &reference.mean, None)?;
            let mean = pair.pixels().flat_map(|(test, _)| test).sum::<f64>() / (3 * pair.count()) as f64;
            if mean > 0.0 { pair.mean() / mean } else { 1.0 }
        }
    };
    Ok(picture.map(|v| v * factor))
}
