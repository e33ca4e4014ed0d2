//! The NIST colour quality scale.

use super::reference;
use super::sampling::{Lamp, reflectances, sample};
use crate::color::adaptation::ConeTransform;
use crate::color::space::{lab_from_xyz, uv_1960_from_xyz};
use crate::color::{Observer, temperature, xyz_from_xy};
use crate::spectrum::Spectrum;
use crate::spectrum::resample::Extrapolation;
use crate::{Error, ErrorKind, Result, math};
use glam::DVec3;
use std::sync::LazyLock;

const COUNT: usize = 15;
/// Gamut area of the samples under D65, in squares of a*, b*.
const GAMUT_OF_D65: f64 = 8210.0;
/// Q_p lost per unit of difference.
const PREFERENCE_SCALE: f64 = 3.6;

static SAMPLES: LazyLock<[Vec<Vec<f64>>; 2]> = LazyLock::new(|| {
    let texts = [include_str!("../../../data/quality/cqs_7.4.csv"), include_str!("../../../data/quality/cqs_9.0.csv")];
    texts.map(|text| {
        reflectances(text, &reference::wide_grid()).expect("data/quality/cqs_*.csv hold reflectances every 5 nm")
    })
});

/// Version of NIST's computer program, which differ in samples and scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CqsVersion {
    /// 7.4 of 2008: penalises very low colour temperatures, and has scales of preference and of gamut.
    V7_4,
    /// 9.0 of 2013.
    V9_0,
}

impl CqsVersion {
    const NAMED: [(&str, Self); 2] = [("7.4", Self::V7_4), ("9.0", Self::V9_0)];

    /// `7.4` or `9.0`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`].
    pub fn by_name(name: &str) -> Result<Self> {
        Self::NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, version)| version).ok_or_else(|| {
            let message = format!("unknown version {name:?} of the colour quality scale; expected \"7.4\" or \"9.0\"");
            Error::new(ErrorKind::UnknownName, message)
        })
    }

    fn samples(self) -> &'static [Vec<f64>] {
        match self {
            Self::V7_4 => &SAMPLES[0],
            Self::V9_0 => &SAMPLES[1],
        }
    }

    /// Scale points lost per unit of difference: of Q_a and of Q_f.
    fn scales(self) -> [f64; 2] {
        match self {
            Self::V7_4 => [3.104, 2.928],
            Self::V9_0 => [3.2, 2.93 * 1.0343],
        }
    }
}

/// Colour quality of a light \[Davis2010\]: 100 where colours look as under the reference or are more saturated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cqs {
    /// Q_a: quality, from 0 on; gains of chroma do not count.
    pub qa: f64,
    /// Q_f: fidelity; gains of chroma count as losses do.
    pub qf: f64,
    /// Q_p: preference, in which gains of chroma are good; version 7.4 alone.
    pub qp: Option<f64>,
    /// Q_g: gamut area, % of that under D65.
    pub qg: f64,
    /// Q_d: gamut area, % of that under the reference; version 7.4 alone.
    pub qd: Option<f64>,
    /// Q_a of the 15 samples.
    pub q: [f64; COUNT],
    /// Correlated colour temperature by Ohno's method, K (c₂ = 1.4388·10⁻² m·K); that of the reference.
    pub kelvin: f64,
}

/// A sample's shift.
struct Shift {
    /// ΔC*: gain of chroma.
    chroma: f64,
    /// ΔE*.
    difference: f64,
    /// ΔE* without a gain of chroma.
    without_gain: f64,
}

/// The NIST colour quality scale of a light \[Davis2010\].
///
/// # Errors
/// A light without luminance, or whose colour temperature has no reference: above 25 000 K.
pub fn cqs(light: &Spectrum, version: CqsVersion) -> Result<Cqs> {
    let grid = reference::wide_grid();
    let values = sample(light, &grid, Extrapolation::Constant)?;
    let lamp = Lamp::new(&values, &grid, Observer::cie_1931_2deg())?;
    let kelvin = temperature::ohno::correlated(uv_1960_from_xyz(lamp.white))?.kelvin;
    let reference = Lamp::new(&reference::wide_reference(kelvin, &grid)?, &grid, Observer::cie_1931_2deg())?;
    let adaptation = ConeTransform::Cmccat2000.adaptation(lamp.white, reference.white);
    let lab = |xyz| lab_from_xyz(xyz, reference.white);
    let samples = version.samples();
    let seen: Vec<DVec3> = samples.iter().map(|sample| lab(adaptation * lamp.xyz_of(sample))).collect();
    let expected: Vec<DVec3> = samples.iter().map(|sample| lab(reference.xyz_of(sample))).collect();
    let shifts: Vec<Shift> = seen.iter().zip(&expected).map(|(seen, expected)| shift(*seen, *expected)).collect();

    let factor = match version {
        CqsVersion::V7_4 => temperature_factor(samples, &reference),
        CqsVersion::V9_0 => 1.0,
    };
    let [scale_a, scale_f] = version.scales();
    let mut q = [0.0; COUNT];
    for (q, shift) in q.iter_mut().zip(&shifts) {
        *q = points(shift.without_gain, scale_a) * factor;
    }
    let (difference, without_gain) = (rms(&shifts, |s| s.difference), rms(&shifts, |s| s.without_gain));
    let area = gamut_area(&seen);
    let gain = shifts.iter().map(|shift| shift.chroma.max(0.0)).sum::<f64>() / COUNT as f64;
    let of_7_4 = |value: f64| (version == CqsVersion::V7_4).then_some(value);
    Ok(Cqs {
        qa: points(without_gain, scale_a) * factor,
        qf: points(difference, scale_f) * factor,
        qp: of_7_4(100.0 - PREFERENCE_SCALE * (without_gain - gain)),
        qg: 100.0 * area / GAMUT_OF_D65,
        qd: of_7_4(100.0 * area / gamut_area(&expected) * factor),
        q,
        kelvin,
    })
}

fn shift(seen: DVec3, expected: DVec3) -> Shift {
    let chroma = math::hypot(seen.y, seen.z) - math::hypot(expected.y, expected.z);
    let difference = (seen - expected).length();
    // Rounding may leave a difference of nothing but chroma a little too small.
    let rest = (difference * difference - chroma * chroma).max(0.0).sqrt();
    Shift { chroma, difference, without_gain: if chroma > 0.0 { rest } else { difference } }
}

/// Root of the mean square.
fn rms(shifts: &[Shift], value: fn(&Shift) -> f64) -> f64 {
    (shifts.iter().map(|shift| value(shift) * value(shift)).sum::<f64>() / shifts.len() as f64).sqrt()
}

/// 100 for no difference; straight, but never negative.
fn points(difference: f64, scale: f64) -> f64 {
    10.0 * math::ln_1p(math::exp((100.0 - scale * difference) / 10.0))
}

/// Sum of the triangles that neighbouring samples and grey make in a*, b*, whichever way they turn.
fn gamut_area(lab: &[DVec3]) -> f64 {
    let next = lab.iter().cycle().skip(1);
    0.5 * lab.iter().zip(next).map(|(a, b)| (a.y * b.z - a.z * b.y).abs()).sum::<f64>()
}

/// What a reference of very low colour temperature, under which colours are dull, costs: its gamut over that of D65, at most 1.
fn temperature_factor(samples: &[Vec<f64>], reference: &Lamp) -> f64 {
    let d65 = xyz_from_xy([0.3127, 0.3290]);
    let adaptation = ConeTransform::Cmccat2000.adaptation(reference.white, d65);
    let lab: Vec<DVec3> =
        samples.iter().map(|sample| lab_from_xyz(adaptation * reference.xyz_of(sample), d65)).collect();
    (gamut_area(&lab) / GAMUT_OF_D65).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::illuminant;
    use crate::color::quality::cri;

    fn lamp_named(name: &str) -> Spectrum {
        Spectrum::PiecewiseLinear(illuminant::relative_power(name).unwrap())
    }

    #[test]
    fn a_lamp_has_the_known_scale() {
        let found = cqs(&lamp_named("FL2"), CqsVersion::V9_0).unwrap();
        assert!((found.qa - 64.111_822).abs() < 1e-6, "{found:?}");
        assert_eq!((found.qp, found.qd), (None, None));
        let older = cqs(&lamp_named("FL2"), CqsVersion::V7_4).unwrap();
        assert!(older.qp.is_some() && older.qd.is_some() && (older.qa - 64.774_587).abs() < 1e-6);
    }

    #[test]
    fn references_are_perfect_but_candles_of_version_7_4() {
        for kelvin in [2000.0, 2856.0, 4900.0] {
            let light = Spectrum::blackbody(kelvin).unwrap();
            let found = cqs(&light, CqsVersion::V9_0).unwrap();
            assert!(found.qa > 99.99 && found.qf > 99.99 && found.q.iter().all(|q| *q > 99.9), "{found:?}");
        }
        let candle = cqs(&Spectrum::blackbody(1800.0).unwrap(), CqsVersion::V7_4).unwrap();
        assert!((70.0..98.0).contains(&candle.qa), "{candle:?}");
    }

    #[test]
    fn gains_of_chroma_do_not_count() {
        let diodes = lamp_named("LED-RGB1");
        let found = cqs(&diodes, CqsVersion::V9_0).unwrap();
        assert!(found.qa > found.qf && found.qa > cri(&diodes).unwrap().ra + 10.0, "{found:?}");
        let grey = DVec3::new(50.0, 10.0, 0.0);
        let gain = shift(DVec3::new(50.0, 13.0, 0.0), grey);
        assert_eq!((gain.chroma, gain.difference, gain.without_gain), (3.0, 3.0, 0.0));
        let loss = shift(DVec3::new(54.0, 7.0, 0.0), grey);
        assert_eq!((loss.chroma, loss.difference, loss.without_gain), (-3.0, 5.0, 5.0));
    }

    #[test]
    fn areas_and_names() {
        let square = [[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0]].map(|[a, b]| DVec3::new(1.0, a, b));
        assert_eq!(gamut_area(&square), 18.0);
        assert_eq!(CqsVersion::by_name("7.4").unwrap(), CqsVersion::V7_4);
        assert_eq!(CqsVersion::by_name("8").unwrap_err().kind, ErrorKind::UnknownName);
        assert_eq!(cqs(&Spectrum::Constant(0.0), CqsVersion::V9_0).unwrap_err().kind, ErrorKind::OutOfRange);
    }
}
