//! Reflectances as a mean and three principal components, by the cluster that a chromaticity falls into \[Otsu2018\].
//!
//! Tables and weights of wavelengths are those of colour-science, 380–730 nm in steps of 10 nm.

use super::data::rows;
use crate::color::chromaticity;
use crate::spectrum::{PiecewiseLinear, Spectrum};
use crate::{Error, ErrorKind, Result};
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

/// Clusters of the published model.
const CLUSTERS: usize = 8;
/// Wavelength, weights of X, Y, Z, then mean and three components of each cluster.
const COLUMNS: usize = 4 + 4 * CLUSTERS;

static TABLE: LazyLock<Vec<[f64; COLUMNS]>> = LazyLock::new(|| rows(include_str!("../../../data/recovery/otsu.csv")));

/// Threshold, axis, where to go at most at it and where above it.
static TREE: LazyLock<Vec<[f64; 4]>> = LazyLock::new(|| rows(include_str!("../../../data/recovery/otsu_tree.csv")));

/// The reflectance of XYZ under D65 (white has Y = 1), before it is cut off: it may leave [0, 1].
///
/// # Errors
/// Components that are not finite; black, which has no chromaticity.
pub fn unclipped(xyz: [f64; 3]) -> Result<Spectrum> {
    spectrum(values(xyz.into())?)
}

/// The reflectance of XYZ under D65 (white has Y = 1), cut off at 0 and 1: saturated and very dark colours change.
///
/// # Errors
/// Those of [`unclipped`].
pub fn clipped(xyz: [f64; 3]) -> Result<Spectrum> {
    spectrum(values(xyz.into())?.into_iter().map(|value| value.clamp(0.0, 1.0)).collect())
}

fn spectrum(values: Vec<f64>) -> Result<Spectrum> {
    PiecewiseLinear::new(TABLE.iter().map(|row| row[0]).collect(), values).map(Spectrum::PiecewiseLinear)
}

fn values(xyz: DVec3) -> Result<Vec<f64>> {
    if !(xyz.is_finite() && xyz.element_sum() > 0.0) {
        let message = format!("XYZ {xyz}; expected finite components with a positive sum");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    let first = 4 + 4 * cluster(chromaticity(xyz));
    // Colours of the mean and of the components.
    let mut colors = [DVec3::ZERO; 4];
    for row in TABLE.iter() {
        let weight = DVec3::new(row[1], row[2], row[3]);
        for (color, value) in colors.iter_mut().zip(&row[first..]) {
            *color += weight * value;
        }
    }
    let [mean, a, b, c] = colors;
    let amounts = DMat3::from_cols(a, b, c).inverse() * (xyz - mean);
    let value =
        |row: &[f64; COLUMNS]| row[first] + amounts.dot(DVec3::new(row[first + 1], row[first + 2], row[first + 3]));
    Ok(TABLE.iter().map(value).collect())
}

/// The cluster of a chromaticity.
fn cluster(xy: [f64; 2]) -> usize {
    let mut node = 0;
    loop {
        let [threshold, axis, at_most, above] = TREE[node];
        let next = if xy[axis as usize] <= threshold { at_most } else { above };
        // Children have larger numbers than their parents, so the walk ends.
        if next >= 0.0 {
            return next as usize;
        }
        node = -next as usize;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Observer, illuminant, xyz_of_reflectance};

    #[test]
    fn every_cluster_is_reached_and_gives_its_colour() {
        let mut reached = [false; CLUSTERS];
        for i in 0..400 {
            let xy = [0.15 + 0.025 * (i % 20) as f64, 0.1 + 0.025 * (i / 20) as f64];
            reached[cluster(xy)] = true;
        }
        assert_eq!(reached, [true; CLUSTERS]);
        let xyz = DVec3::new(0.20654008, 0.12197225, 0.05136952);
        let got = xyz_of_reflectance(&unclipped(xyz.to_array()).unwrap(), illuminant::d65(), Observer::cie_1931_2deg());
        assert!((got - xyz).abs().max_element() < 1e-3, "{got}");
    }

    #[test]
    fn bad_input_is_an_error() {
        for bad in [[0.0; 3], [f64::NAN, 1.0, 1.0], [f64::INFINITY, 1.0, 1.0]] {
            assert_eq!(clipped(bad).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
