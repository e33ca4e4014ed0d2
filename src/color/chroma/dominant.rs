//! Dominant and complementary wavelength, and purity.
//!
//! The observer is linear between its samples, so its locus in the chromaticity diagram is a chain of straight pieces, and
//! where a line from the white cuts a piece the wavelength follows exactly: nothing is quantised to the samples.

use crate::color::{Observer, chromaticity};
use glam::{DVec2, DVec3};

/// Where the half-line from the white through a chromaticity leaves the diagram, and what follows from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dominant {
    /// Dominant wavelength, nm; of a purple the complementary wavelength.
    pub lambda_nm: f64,
    /// Whether the chromaticity is a purple, so that `lambda_nm` lies on the other side of the white.
    pub is_complementary: bool,
    /// Chromaticity of `lambda_nm`.
    pub spectral_xy: [f64; 2],
    /// Where the half-line leaves the diagram: on the locus, for purples on the line that joins the locus' ends.
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

/// Whether a chromaticity is that of some light: inside the locus and the line that joins its ends.
///
/// On the boundary itself rounding decides.
pub fn is_within_locus(xy: [f64; 2], observer: &Observer) -> bool {
    Locus::new(observer).contains(xy.into())
}

/// The observer's knots that see anything.
struct Locus {
    lambda_nm: Vec<f64>,
    xyz: Vec<DVec3>,
    xy: Vec<DVec2>,
}

/// Where a half-line leaves the diagram; no wavelength on the line of purples.
#[derive(Clone, Copy)]
struct Cut {
    lambda_nm: Option<f64>,
    at: DVec2,
    /// Distance from the start of the half-line in lengths of its direction.
    distance: f64,
}

impl Locus {
    fn new(observer: &Observer) -> Self {
        let [x, y, z] = observer.curves();
        let knots =
            y.lambdas_nm().iter().map(|&lambda| (lambda, DVec3::new(x.eval(lambda), y.eval(lambda), z.eval(lambda))));
        let (lambda_nm, xyz): (Vec<_>, Vec<_>) = knots.filter(|(_, xyz)| xyz.element_sum() > 0.0).unzip();
        let xy = xyz.iter().map(|&xyz| chromaticity(xyz).into()).collect();
        Self { lambda_nm, xyz, xy }
    }

    /// Pairs of neighbours on the closed outline; the last pair is the line of purples.
    fn sides(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.xy.len()).map(|i| (i, (i + 1) % self.xy.len()))
    }

    /// Even-odd rule.
    fn contains(&self, point: DVec2) -> bool {
        let crosses = |&(i, j): &(usize, usize)| {
            let (a, b) = (self.xy[i] - point, self.xy[j] - point);
            (a.y > 0.0) != (b.y > 0.0) && (a.perp_dot(b) > 0.0) == (b.y > 0.0)
        };
        self.sides().filter(crosses).count() % 2 == 1
    }

    fn outermost_cut(&self, start: DVec2, direction: DVec2) -> Option<Cut> {
        let cuts = self.sides().filter_map(|(i, j)| self.cut(i, j, start, direction));
        cuts.filter(|cut| cut.distance > 0.0).max_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// The cut of a whole line with the side between two knots.
    fn cut(&self, i: usize, j: usize, start: DVec2, direction: DVec2) -> Option<Cut> {
        let purple = j < i;
        let [from, to] =
            [i, j].map(|k| if purple { self.xy[k].extend(1.0 - self.xy[k].element_sum()) } else { self.xyz[k] });
        // Linear in XYZ, and 0 where the chromaticity is on the line.
        let side = |xyz: DVec3| (xyz.truncate() - start * xyz.element_sum()).perp_dot(direction);
        let (a, b) = (side(from), side(to));
        if (a >= 0.0) == (b >= 0.0) {
            return None;
        }
        let t = a / (a - b);
        let at = DVec2::from(chromaticity(from.lerp(to, t)));
        let lambda_nm = (!purple).then(|| self.lambda_nm[i] + t * (self.lambda_nm[j] - self.lambda_nm[i]));
        Some(Cut { lambda_nm, at, distance: (at - start).dot(direction) / direction.length_squared() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::RgbSpace;
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

    #[test]
    fn the_locus_is_the_border() {
        let observer = Observer::cie_1931_2deg();
        for lambda in 410..650 {
            let xy = chromaticity(observer.eval(f64::from(lambda) + 0.5));
            assert!(is_within_locus(mixture(D65, xy, 1.0 - 1e-9), observer), "{lambda}");
            assert!(!is_within_locus(mixture(D65, xy, 1.0 + 1e-9), observer), "{lambda}");
        }
        assert!(is_within_locus([0.4, 0.16], observer) && !is_within_locus([0.4, 0.1], observer));
    }

    proptest! {
        #[test]
        fn the_boundary_is_on_the_half_line_at_the_inverse_of_the_purity(x in 0.0..0.8_f64, y in 0.001..0.85_f64) {
            let dominant = of([x, y]);
            let (white, boundary) = (DVec2::from(D65), DVec2::from(dominant.boundary_xy));
            let again = white.lerp(boundary, dominant.excitation_purity);
            prop_assert!((again - DVec2::new(x, y)).length() < 1e-12);
            prop_assert_eq!(dominant.excitation_purity <= 1.0, is_within_locus([x, y], Observer::cie_1931_2deg()));
        }
    }
}
