//! ANSI/IES TM-30-18.

use super::fidelity::{Shifts, index_of_difference, shifts};
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result, math};
use std::f64::consts::PI;

const BINS: usize = 16;

/// Colour rendition of a light \[TM30\].
#[derive(Debug, Clone, PartialEq)]
pub struct Tm30 {
    /// R_f: fidelity, from 0 to 100; the same as [`super::fidelity`]'s.
    pub rf: f64,
    /// R_g: gamut. 100 where colours are as saturated as under the reference, more where they are more.
    pub rg: f64,
    /// R_f,1 to R_f,99: fidelity of the samples.
    pub rs: Vec<f64>,
    /// Correlated colour temperature, K (c₂ = 1.4388·10⁻² m·K); that of the reference.
    pub kelvin: f64,
    /// Distance from the Planckian locus in CIE 1960 u, v; positive above it.
    pub duv: f64,
    /// The sixteen hue bins, 22.5° each, from hue 0 on; `None` where no sample has such a hue under the reference, which
    /// happens below 1140 K alone.
    pub bins: [Option<HueBin>; BINS],
}

/// The colours of one hue bin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HueBin {
    /// How many of the 99 samples have such hues under the reference.
    pub samples: usize,
    /// Mean a', b' under the light.
    pub seen: [f64; 2],
    /// Mean a', b' under the reference.
    pub expected: [f64; 2],
    /// R_f,h: local fidelity.
    pub fidelity: f64,
    /// R_cs,h: local shift of chroma, % of the reference's.
    pub chroma_shift_percent: f64,
    /// R_hs,h: local shift of hue, about radians.
    pub hue_shift: f64,
}

/// Colour rendition of a light by ANSI/IES TM-30-18 \[TM30\], on the samples of the CIE 2017 colour fidelity index.
///
/// # Errors
/// As [`super::fidelity`].
pub fn tm30(light: &Spectrum) -> Result<Tm30> {
    let shifts = shifts(light)?;
    let bins = std::array::from_fn(|bin| hue_bin(&shifts, bin));
    let present: Vec<HueBin> = bins.iter().flatten().copied().collect();
    let area = |corner: fn(&HueBin) -> [f64; 2]| polygon_area(&present.iter().map(corner).collect::<Vec<_>>());
    let (seen, expected) = (area(|bin| bin.seen), area(|bin| bin.expected));
    if expected <= 0.0 {
        let message =
            format!("a reference at {} K whose gamut has no area; expected colours of all hues", shifts.kelvin);
        return Err(Error::new(ErrorKind::Degenerate, message));
    }
    let mean = shifts.differences.iter().sum::<f64>() / shifts.differences.len() as f64;
    Ok(Tm30 {
        rf: index_of_difference(mean),
        rg: 100.0 * seen / expected,
        rs: shifts.differences.iter().map(|difference| index_of_difference(*difference)).collect(),
        kelvin: shifts.kelvin,
        duv: shifts.duv,
        bins,
    })
}

fn hue_bin(shifts: &Shifts, bin: usize) -> Option<HueBin> {
    let width = 360.0 / BINS as f64;
    let members: Vec<usize> = (0..shifts.hues.len()).filter(|&i| (shifts.hues[i] / width) as usize == bin).collect();
    if members.is_empty() {
        return None;
    }
    let mean = |value: &dyn Fn(usize) -> f64| members.iter().map(|&i| value(i)).sum::<f64>() / members.len() as f64;
    let seen = [mean(&|i| shifts.seen[i].y), mean(&|i| shifts.seen[i].z)];
    let expected = [mean(&|i| shifts.expected[i].y), mean(&|i| shifts.expected[i].z)];
    let (da, db) = (seen[0] - expected[0], seen[1] - expected[1]);
    let middle = width * (bin as f64 + 0.5) * (PI / 180.0);
    let (cos, sin) = (math::cos(middle), math::sin(middle));
    let chroma = (expected[0] * expected[0] + expected[1] * expected[1]).sqrt();
    Some(HueBin {
        samples: members.len(),
        seen,
        expected,
        fidelity: index_of_difference(mean(&|i| shifts.differences[i])),
        chroma_shift_percent: 100.0 * (da * cos + db * sin) / chroma,
        hue_shift: (db * cos - da * sin) / chroma,
    })
}

/// Area of a polygon whose corners go round anticlockwise.
fn polygon_area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(u, v)| u[0] * v[1] - u[1] * v[0]).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{illuminant, quality};

    fn lamp_named(name: &str) -> Spectrum {
        Spectrum::PiecewiseLinear(illuminant::relative_power(name).unwrap())
    }

    #[test]
    fn fidelity_is_that_of_the_cie() {
        let light = lamp_named("FL11");
        let (found, cie) = (tm30(&light).unwrap(), quality::fidelity(&light).unwrap());
        assert_eq!((found.rf, found.kelvin, found.duv), (cie.rf, cie.kelvin, cie.duv));
        assert_eq!(found.rs, cie.rs.to_vec());
    }

    #[test]
    fn a_reference_shifts_nothing() {
        let found = tm30(&Spectrum::blackbody(2856.0).unwrap()).unwrap();
        assert!((found.rg - 100.0).abs() < 0.01, "{}", found.rg);
        assert_eq!(found.bins.iter().flatten().map(|bin| bin.samples).sum::<usize>(), 99);
        for bin in found.bins.iter().flatten() {
            assert!(bin.fidelity > 99.9 && bin.chroma_shift_percent.abs() < 0.05 && bin.hue_shift.abs() < 5e-4);
        }
    }

    #[test]
    fn gamuts_of_lamps() {
        // Of sodium half, of three narrow diodes more than the reference's.
        assert!((tm30(&lamp_named("HP1")).unwrap().rg - 53.966_905).abs() < 1e-6);
        let diodes = tm30(&lamp_named("LED-RGB1")).unwrap();
        assert!(diodes.rg > 105.0, "{}", diodes.rg);
        let gains = diodes.bins.iter().flatten().filter(|bin| bin.chroma_shift_percent > 0.0).count();
        assert!((4..=12).contains(&gains), "{gains}");
    }

    #[test]
    fn candles_leave_bins_empty() {
        let bins = tm30(&Spectrum::blackbody(1080.0).unwrap()).unwrap().bins;
        assert!(bins.iter().any(Option::is_none) && bins.iter().flatten().count() > 8);
    }

    #[test]
    fn areas() {
        let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        assert_eq!(polygon_area(&square), 4.0);
        assert_eq!(polygon_area(&square[..2]), 0.0);
    }
}
