//! The Academy's spectral similarity index.

use super::sampling::sample;
use crate::spectrum::Spectrum;
use crate::spectrum::resample::{Extrapolation, Grid};
use crate::{Error, ErrorKind, Result};

/// Bands of 10 nm from 375 to 675 nm.
const BANDS: usize = 30;
/// Weights of the bands at the ends of the sensitivity of cameras, in 45ths; 1 between.
const FIRST_WEIGHTS: [f64; 5] = [12.0, 22.0, 32.0, 40.0, 44.0];
const LAST_WEIGHTS: [f64; 2] = [33.0, 9.0];

/// How like a light is to a reference for any camera \[SSI2020\]: 100 if they are proportional, less the more their bands
/// differ, without a lower bound. The index is published rounded to whole numbers; this is not.
///
/// Both are read from 375 to 675 nm, tables by straight lines and as 0 beyond their ends, and their scale does not matter.
///
/// # Errors
/// A light without power in that range.
pub fn ssi(light: &Spectrum, reference: &Spectrum) -> Result<f64> {
    let (light, reference) = (bands(light, "light")?, bands(reference, "reference")?);
    let mut weighted = [0.0; BANDS + 2];
    for (i, weighted) in weighted[1..=BANDS].iter_mut().enumerate() {
        *weighted = weight(i) * (light[i] - reference[i]) / (reference[i] + 1.0 / BANDS as f64);
    }
    // Smoothed over neighbours, with 0 beyond both ends.
    let smooth = |w: &[f64]| 0.22 * w[0] + 0.56 * w[1] + 0.22 * w[2];
    let square: f64 = weighted.windows(3).map(|w| smooth(w) * smooth(w)).sum();
    Ok(100.0 - 32.0 * square.sqrt())
}

/// Power of the bands over their sum.
fn bands(light: &Spectrum, what: &str) -> Result<[f64; BANDS]> {
    let grid = Grid::new(375.0, 675.0, 1.0)?;
    let values = sample(light, &grid, Extrapolation::Zero)?;
    let trapezoids = |i: usize| {
        let band = &values[10 * i..=10 * i + 10];
        band.iter().sum::<f64>() - 0.5 * (band[0] + band[10])
    };
    let bands: [f64; BANDS] = std::array::from_fn(trapezoids);
    let sum: f64 = bands.iter().sum();
    if !(sum > 0.0 && (1.0 / sum).is_finite()) {
        let message = format!("a {what} of power {sum:e} over 375–675 nm; expected a positive one");
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    Ok(bands.map(|band| band / sum))
}

fn weight(band: usize) -> f64 {
    let from_end = BANDS - 1 - band;
    if band < FIRST_WEIGHTS.len() {
        FIRST_WEIGHTS[band] / 45.0
    } else if from_end < LAST_WEIGHTS.len() {
        LAST_WEIGHTS[LAST_WEIGHTS.len() - 1 - from_end] / 45.0
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::illuminant;

    fn lamp_named(name: &str) -> Spectrum {
        Spectrum::PiecewiseLinear(illuminant::relative_power(name).unwrap())
    }

    #[test]
    fn like_lights_have_100() {
        for name in ["D65", "FL11", "HP1"] {
            let light = lamp_named(name);
            assert!((ssi(&light.clone().scaled(3e-5), &light).unwrap() - 100.0).abs() < 1e-6, "{name}");
        }
    }

    #[test]
    fn lights_by_likeness() {
        // 94 is the published example.
        let d65 = lamp_named("D65");
        let found = ["C", "D55", "LED-B4", "FL2", "HP1"].map(|name| ssi(&lamp_named(name), &d65).unwrap());
        assert_eq!(found[0].round(), 94.0);
        assert!(found.windows(2).all(|pair| pair[0] > pair[1]), "{found:?}");
    }

    #[test]
    fn weights_fall_at_both_ends() {
        let weights: Vec<f64> = (0..BANDS).map(weight).collect();
        assert_eq!(weights.iter().filter(|w| **w == 1.0).count(), 23);
        assert!(weights[..6].is_sorted() && (weights[28] - 11.0 / 15.0).abs() < 1e-15 && weights[29] == 0.2);
    }

    #[test]
    fn darkness_is_an_error() {
        let infrared = Spectrum::line(900.0, 1.0).unwrap();
        let error = ssi(&infrared, &Spectrum::Constant(1.0)).unwrap_err();
        assert!(error.to_string().contains("light"), "{error}");
        assert!(ssi(&Spectrum::Constant(1.0), &infrared).unwrap_err().to_string().contains("reference"));
    }
}
