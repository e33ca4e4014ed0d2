//! Seven basis reflectances of ten bins, mixed by the order of the components \[Smits1999\].
//!
//! The tables were made for the white E. Red reaches 1.0149 and cyan 1.0007, so that saturated colours gain energy.

use super::data::rows;
use crate::spectrum::{PiecewiseLinear, Spectrum};
use glam::DVec3;
use std::sync::LazyLock;

/// Start of a bin in nm, then white, cyan, magenta, yellow, red, green, blue.
static BINS: LazyLock<Vec<[f64; 8]>> = LazyLock::new(|| rows(include_str!("../../../data/recovery/smits.csv")));

/// Ends of the tables' range.
const FROM_NM: f64 = 380.0;
const TO_NM: f64 = 720.0;

/// The reflectance of linear components in [0, 1]: ten steps, the outer ones held beyond 380 and 720 nm.
pub(super) fn binned(rgb: DVec3) -> Spectrum {
    let values = mixture(rgb);
    let (mut knots, mut steps) = (vec![BINS[0][0]], vec![values[0]]);
    for i in 1..values.len() {
        // A step is as narrow as numbers allow.
        knots.extend([BINS[i][0].next_down(), BINS[i][0]]);
        steps.extend([values[i - 1], values[i]]);
    }
    Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots, steps))
}

/// The same values at ten wavelengths evenly spaced from 380 to 720 nm and joined by straight lines, which is not what
/// the paper defines.
pub(super) fn linear(rgb: DVec3) -> Spectrum {
    let values = mixture(rgb);
    let last = (values.len() - 1) as f64;
    let knots = (0..values.len()).map(|i| FROM_NM + (TO_NM - FROM_NM) * (i as f64 / last)).collect();
    Spectrum::PiecewiseLinear(PiecewiseLinear::from_valid_knots(knots, values))
}

/// Adds as much white as the smallest component, then the secondary colour of the others, then the primary of the largest.
fn mixture(rgb: DVec3) -> Vec<f64> {
    let components = rgb.to_array();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| components[a].total_cmp(&components[b]));
    let [least, middle, most] = order.map(|i| components[i]);
    // Cyan, magenta, yellow lack red, green, blue; the primaries come last in a row.
    let (secondary, primary) = (2 + order[0], 5 + order[2]);
    let value = |row: &[f64; 8]| row[1] * least + row[secondary] * (middle - least) + row[primary] * (most - middle);
    BINS.iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, illuminant, xyz_of_reflectance};

    #[test]
    fn bins_are_constant_and_meet_at_their_edges() {
        let red = binned(DVec3::X);
        assert_eq!([360.0, 380.0, 413.9].map(|l| red.eval(l)), [0.1012; 3]);
        assert_eq!([414.0, 430.0, 447.99].map(|l| red.eval(l)), [0.0515; 3]);
        assert_eq!(red.eval(830.0), red.eval(690.0));
        assert_eq!(red.range().1, 1.0149);
    }

    #[test]
    fn mixtures_are_continuous_where_components_change_order() {
        let h = 1e-9;
        for (a, b) in [
            (DVec3::new(0.5, 0.5 + h, 0.2), DVec3::new(0.5 + h, 0.5, 0.2)),
            (DVec3::new(0.9, 0.3, 0.3 + h), DVec3::new(0.9, 0.3 + h, 0.3)),
            (DVec3::new(0.1, 0.1 + h, 0.1), DVec3::new(0.1 + h, 0.1, 0.1)),
        ] {
            let distance = mixture(a).iter().zip(mixture(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(distance < 4.0 * h, "{a} {b}: {distance}");
        }
    }

    #[test]
    fn bins_have_the_colour_under_the_white_of_their_design() {
        let (e, observer) = (illuminant::by_name("E").unwrap(), Observer::cie_1931_2deg());
        let white = xyz_of_reflectance(&Spectrum::Constant(1.0), &e, observer);
        let got = xyz_of_reflectance(&binned(DVec3::ONE), &e, observer);
        assert!((got - white).abs().max_element() < 1e-3, "{got} {white}");
    }
}
