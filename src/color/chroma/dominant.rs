//! Dominant and complementary wavelength, and purity.
//!
//! The observer is linear between its samples, so its locus in the chromaticity diagram is a chain of straight pieces, and
//! where a line from the white cuts a piece the wavelength follows exactly: nothing is quantised to the samples.

use super::locus::Locus;
use crate::color::Observer;
use glam::DVec2;

/// Point at which the half-line from the white through a chromaticity leaves the diagram, and what follows from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dominant {
    /// Dominant wavelength, nm; of a purple the complementary wavelength.
    pub lambda_nm: f64,
    /// Whether the chromaticity is a purple, so that `lambda_nm` lies on the other side of the white.
    pub is_complementary: bool,
    /// Chromaticity of `lambda_nm`.
    pub spectral_xy: [f64; 2],
    /// Point at which the half-line leaves the diagram: on the locus, for purples on the line that joins the locus' ends.
    pub boundary_xy: [f64; 2],
    /// Distance from the white over that of the boundary: 0 for white, 1 on the boundary, above 1 outside.
    pub excitation_purity: f64,
    /// Luminance of the boundary light over all of it, in the mixture with white that has this chromaticity:
    /// the excitation purity times y of the boundary over y.
    pub colorimetric_purity: f64,
}

/// Dominant wavelength and purities of a chromaticity relative to a white \[CIE15\].
///
/// Where the half-line cuts the locus more than once (its red end runs back and forth by 1e-5), the outermost cut counts.
/// `None` if the chromaticity is the white, if the white is outside the locus, or a coordinate is not finite.
pub fn dominant_wavelength(xy: [f64; 2], white_xy: [f64; 2], observer: &Observer) -> Option<Dominant> {
    let (xy, white) = (DVec2::from(xy), DVec2::from(white_xy));
    let direction = xy - white;
    let locus = Locus::new(observer);
    if !direction.is_finite() || direction == DVec2::ZERO || !locus.contains(white) {
        return None;
    }
    let boundary = locus.outermost_cut(white, direction)?;
    let spectral = match boundary.lambda_nm {
        Some(_) => boundary,
        None => locus.outermost_cut(white, -direction)?,
    };
    let excitation_purity = direction.length() / (boundary.at - white).length();
    Some(Dominant {
        lambda_nm: spectral.lambda_nm?,
        is_complementary: boundary.lambda_nm.is_none(),
        spectral_xy: spectral.at.into(),
        boundary_xy: boundary.at.into(),
        excitation_purity,
        colorimetric_purity: excitation_purity * boundary.at.y / xy.y,
    })
}

/// The wavelength, in nm, whose light mixes with a chromaticity to the white; `None` where there is no such light (greens,
/// whose complements are purples) and as [`dominant_wavelength`] has it.
pub fn complementary_wavelength(xy: [f64; 2], white_xy: [f64; 2], observer: &Observer) -> Option<f64> {
    let opposite = DVec2::from(white_xy) * 2.0 - DVec2::from(xy);
    let dominant = dominant_wavelength(opposite.into(), white_xy, observer)?;
    (!dominant.is_complementary).then_some(dominant.lambda_nm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::chroma::is_within_locus;
    use crate::color::{RgbSpace, chromaticity};
    use proptest::prelude::*;

    const D65: [f64; 2] = [0.3127, 0.3290];

    fn of(xy: [f64; 2]) -> Dominant {
        dominant_wavelength(xy, D65, Observer::cie_1931_2deg()).unwrap()
    }

    fn mixture(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
        DVec2::from(a).lerp(b.into(), t).into()
    }

    #[test]
    fn a_spectral_light_has_its_own_wavelength_between_the_samples_too() {
        let observer = Observer::cie_1931_2deg();
        for tenth in 4100..6600 {
            let lambda = f64::from(tenth) / 10.0 + 0.037;
            let xy = chromaticity(observer.eval(lambda));
            let dominant = of(xy);
            assert!((dominant.lambda_nm - lambda).abs() < 1e-7, "{lambda}: {dominant:?}");
            assert!((dominant.excitation_purity - 1.0).abs() < 1e-12 && !dominant.is_complementary);
            assert!((dominant.colorimetric_purity - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn every_observer_has_a_locus() {
        for name in Observer::names() {
            let observer = Observer::by_name(name).unwrap();
            let white = [1.0 / 3.0, 1.0 / 3.0];
            for lambda in [430.25, 505.5, 560.75, 615.125] {
                let xy = mixture(white, chromaticity(observer.eval(lambda)), 0.7);
                let dominant = dominant_wavelength(xy, white, observer).unwrap();
                assert!((dominant.lambda_nm - lambda).abs() < 1e-8, "{name} {lambda}: {dominant:?}");
            }
        }
    }

    #[test]
    fn half_way_to_a_spectral_light_the_wavelength_is_the_same() {
        let spectral = chromaticity(Observer::cie_1931_2deg().eval(487.25));
        let dominant = of(mixture(D65, spectral, 0.5));
        assert!((dominant.lambda_nm - 487.25).abs() < 1e-9, "{dominant:?}");
        assert!((dominant.excitation_purity - 0.5).abs() < 1e-12);
    }

    #[test]
    fn primaries_of_srgb() {
        // Hand-checked on the diagram: red 611.4 nm, green 549.1 nm, blue 464.2 nm.
        for (xy, lambda) in RgbSpace::srgb().primaries.into_iter().zip([611.4, 549.1, 464.2]) {
            assert!((of(xy).lambda_nm - lambda).abs() < 0.15, "{:?}", of(xy));
        }
    }

    #[test]
    fn purples_have_a_complementary_wavelength() {
        let magenta = [0.3209, 0.1542];
        let dominant = of(magenta);
        assert!(dominant.is_complementary);
        assert!((540.0..560.0).contains(&dominant.lambda_nm), "{dominant:?}");
        // The white is on the line between the boundary and the spectral light.
        let [boundary, spectral] =
            [dominant.boundary_xy, dominant.spectral_xy].map(|p| DVec2::from(p) - DVec2::from(D65));
        assert!(boundary.perp_dot(spectral).abs() < 1e-15 && boundary.dot(spectral) < 0.0);
        assert_eq!(complementary_wavelength(magenta, D65, Observer::cie_1931_2deg()), Some(dominant.lambda_nm));
    }

    #[test]
    fn complements() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(complementary_wavelength([0.30, 0.60], D65, observer), None);
        let blue = complementary_wavelength([0.5, 0.48], D65, observer).unwrap();
        assert!((440.0..490.0).contains(&blue), "{blue}");
        // The complement of the complement is the dominant wavelength.
        let back = complementary_wavelength(chromaticity(observer.eval(blue)), D65, observer).unwrap();
        assert!((back - of([0.5, 0.48]).lambda_nm).abs() < 1e-9);
    }

    #[test]
    fn what_has_no_wavelength() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(dominant_wavelength(D65, D65, observer), None);
        assert_eq!(dominant_wavelength([0.3, 0.3], [0.9, 0.9], observer), None);
        assert_eq!(dominant_wavelength([f64::NAN, 0.3], D65, observer), None);
        assert_eq!(dominant_wavelength([0.3, 0.3], [f64::INFINITY, 0.3], observer), None);
    }

    proptest! {
        #[test]
        fn the_boundary_is_on_the_half_line_at_the_inverse_of_the_purity(x in 0.0..0.8_f64, y in 0.001..0.85_f64) {
            let dominant = of([x, y]);
            let (white, boundary) = (DVec2::from(D65), DVec2::from(dominant.boundary_xy));
            let again = white.lerp(boundary, dominant.excitation_purity);
            prop_assert!((again - DVec2::new(x, y)).length() < 1e-12);
            // The outline is concave by up to 1e-4, where mixtures of its lights are outside.
            let is_light = is_within_locus([x, y], Observer::cie_1931_2deg());
            let bounds = if is_light { 0.0..1.0005 } else { 1.0..f64::INFINITY };
            prop_assert!(bounds.contains(&dominant.excitation_purity));
        }
    }
}
