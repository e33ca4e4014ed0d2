//! How saturated a chromaticity is.

use super::{Dominant, dominant_wavelength};
use crate::color::Observer;

/// Excitation purity relative to a white \[CIE15\]: 0 for the white, 1 on the locus and on the line of purples, above 1
/// outside. `None` if the white is outside the locus or a coordinate is not finite.
pub fn excitation_purity(xy: [f64; 2], white_xy: [f64; 2], observer: &Observer) -> Option<f64> {
    of_dominant(xy, white_xy, observer, |dominant| dominant.excitation_purity)
}

/// Colorimetric purity relative to a white \[CIE15\]: the share of luminance that the light on the boundary has in a mixture
/// with white; for purples the light on the line of purples. Infinite for y = 0. `None` as [`excitation_purity`] has it.
pub fn colorimetric_purity(xy: [f64; 2], white_xy: [f64; 2], observer: &Observer) -> Option<f64> {
    of_dominant(xy, white_xy, observer, |dominant| dominant.colorimetric_purity)
}

fn of_dominant(xy: [f64; 2], white: [f64; 2], observer: &Observer, purity: fn(Dominant) -> f64) -> Option<f64> {
    if xy == white { Some(0.0) } else { dominant_wavelength(xy, white, observer).map(purity) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{chromaticity, xyz_from_xy};

    const D65: [f64; 2] = [0.3127, 0.3290];

    #[test]
    fn a_mixture_has_the_share_it_was_mixed_with() {
        let observer = Observer::cie_1931_2deg();
        let light = observer.eval(580.3);
        for share in [0.001, 0.25, 0.9, 1.0] {
            let mixture = xyz_from_xy(D65) * (1.0 - share) + light / light.y * share;
            let purity = colorimetric_purity(chromaticity(mixture), D65, observer).unwrap();
            assert!((purity - share).abs() < 1e-12, "{share}: {purity}");
        }
    }

    #[test]
    fn the_white_has_none() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(excitation_purity(D65, D65, observer), Some(0.0));
        assert_eq!(colorimetric_purity(D65, D65, observer), Some(0.0));
        assert_eq!(excitation_purity([0.3, 0.3], [0.8, 0.8], observer), None);
    }
}
