//! The errors of a picture against the reference.

use super::measure::{Image, Run};
use super::variant::{Kind, Variant};
use super::{reference::Reference, work::Work};
use crate::Result;
use crate::metrics::{self, Pair};

impl Run {
    /// Fills in the errors of a picture.
    pub fn judge(&mut self, work: &Work, picture: &Image, reference: &Reference, mask: Option<&[bool]>) -> Result<()> {
        let pair = Pair::new(work.size()[0], picture, &reference.mean, mask)?;
        self.raw_relmse = metrics::relative_mse(&pair);
        self.trimmed_relmse = metrics::trimmed_relative_mse(&pair);
        self.non_finite_pixels = pair.non_finite()[0];
        Ok(())
    }
}

/// Brings the picture of another program to the reference's scale.
pub fn rescale(work: &Work, variant: &Variant, picture: &mut Image, reference: &Reference) -> Result<()> {
    let Kind::Command { scale, .. } = variant.kind else { return Ok(()) };
    let factor = match scale {
        Some(factor) => factor,
        None => {
            let pair = Pair::new(work.size()[0], picture, &reference.mean, None)?;
            let mean = pair.pixels().flat_map(|(test, _)| test).sum::<f64>() / (3 * pair.count()) as f64;
            if mean > 0.0 { pair.mean() / mean } else { 1.0 }
        }
    };
    picture.iter_mut().for_each(|pixel| *pixel = pixel.map(|v| v * factor));
    Ok(())
}
