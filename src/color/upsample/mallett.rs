//! Three basis reflectances, one a primary of sRGB \[Mallett2019\]: their sum is 1 within 1e-5, each lies in [0, 1].

use super::data::rows;
use crate::spectrum::{PiecewiseLinear, Spectrum};
use glam::DVec3;
use std::sync::LazyLock;

/// Wavelength, red, green, blue.
static BASIS: LazyLock<Vec<[f64; 4]>> = LazyLock::new(|| rows(include_str!("../../../data/recovery/mallett.csv")));

/// The reflectance of linear sRGB components in [0, 1].
pub(super) fn reflectance(rgb: DVec3) -> Spectrum {
    let knots = BASIS.iter().map(|row| row[0]).collect();
    let values = BASIS.iter().map(|&[_, r, g, b]| rgb.dot(DVec3::new(r, g, b))).collect();
    Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots, values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
    use crate::color::upsample::rgb_of_reflectance;

    #[test]
    fn white_is_one_and_the_primaries_are_near_themselves() {
        let (least, most) = reflectance(DVec3::ONE).range();
        assert!(least > 1.0 - 1e-5 && most < 1.0 + 1e-8, "{least} {most}");
        for (i, primary) in DVec3::AXES.into_iter().enumerate() {
            let spectrum = reflectance(primary);
            assert!(spectrum.range().0 >= 0.0);
            let rgb = DVec3::from(rgb_of_reflectance(&spectrum, RgbSpace::srgb()));
            // Its tables were fitted with sums at 5 nm.
            assert!((rgb - primary).abs().max_element() < 2e-3, "{i}: {rgb}");
        }
    }
}
