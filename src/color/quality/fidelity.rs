//! The CIE 2017 colour fidelity index.

use super::reference::{narrow_grid, narrow_reference};
use super::sampling::{Lamp, reflectances, sample};
use crate::color::appearance::{Ciecam02, Surround, UniformSpace, ViewingConditions};
use crate::color::space::uv_1960_from_xyz;
use crate::color::{Observer, temperature};
use crate::spectrum::Spectrum;
use crate::spectrum::resample::{Extrapolation, Grid};
use crate::{Result, math};
use glam::DVec3;
use std::sync::LazyLock;

/// Steps of the sums, nm.
const STEPS_NM: [f64; 2] = [1.0, 5.0];
/// Index lost per unit of ΔE', before the scale is bent away from 0.
const SCALE: f64 = 6.73;
const COUNT: usize = 99;

/// The colour evaluation samples on the grids of both steps, of which the coarse one is every fifth of the fine one.
static SAMPLES: LazyLock<[Vec<Vec<f64>>; 2]> = LazyLock::new(|| {
    let text = include_str!("../../../data/quality/cie2017.csv");
    let fine = reflectances(text, &narrow_grid(STEPS_NM[0])).expect("data/quality/cie2017.csv holds reflectances");
    let coarse = fine.iter().map(|sample| sample.iter().copied().step_by(5).collect()).collect();
    [fine, coarse]
});

/// Colour fidelity of a light \[CIE224\]: 100 where colours look as under the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fidelity {
    /// R_f: of the mean shift of all samples, from 0 on.
    pub rf: f64,
    /// R_f,1 to R_f,99: of the samples.
    pub rs: [f64; COUNT],
    /// Correlated colour temperature, K (c₂ = 1.4388·10⁻² m·K); that of the reference.
    pub kelvin: f64,
    /// Distance from the Planckian locus in CIE 1960 u, v; positive above it.
    pub duv: f64,
}

/// How the samples look under a light and its reference.
pub(super) struct Shifts {
    pub kelvin: f64,
    pub duv: f64,
    /// J', a', b' under the light, and under the reference.
    pub seen: Vec<DVec3>,
    pub expected: Vec<DVec3>,
    /// Hues under the reference, degrees.
    pub hues: Vec<f64>,
    /// ΔE' of each sample.
    pub differences: Vec<f64>,
}

/// The CIE 2017 colour fidelity index of a light \[CIE224\].
///
/// The colour temperature is that of Ohno's method \[Ohno2014\], which the standard recommends. The standard wants tables at
/// 5 nm or finer; coarser ones are interpolated here, which is only as good as they are smooth.
///
/// # Errors
/// A light without luminance, or whose colour temperature has no reference: below 1000 or above 25 000 K.
pub fn fidelity(light: &Spectrum) -> Result<Fidelity> {
    let shifts = shifts(light)?;
    let mut rs = [0.0; COUNT];
    for (r, difference) in rs.iter_mut().zip(&shifts.differences) {
        *r = index_of_difference(*difference);
    }
    let mean = shifts.differences.iter().sum::<f64>() / COUNT as f64;
    Ok(Fidelity { rf: index_of_difference(mean), rs, kelvin: shifts.kelvin, duv: shifts.duv })
}

/// 10 ln(1 + exp((100 − 6.73 ΔE') / 10)): the index of a difference; straight near 100 and never negative.
pub(super) fn index_of_difference(difference: f64) -> f64 {
    let straight = (100.0 - SCALE * difference) / 10.0;
    10.0 * math::ln_1p(math::exp(straight))
}

pub(super) fn shifts(light: &Spectrum) -> Result<Shifts> {
    let which = usize::from(is_at_5_nm(light));
    let grid = narrow_grid(STEPS_NM[which]);
    let values = sample(light, &grid, Extrapolation::Zero)?;
    let white_2deg = Lamp::new(&values, &grid, Observer::cie_1931_2deg())?.white;
    let temperature = temperature::ohno::correlated(uv_1960_from_xyz(white_2deg))?;
    let reference = narrow_reference(temperature.kelvin, &grid)?;
    let (seen, _) = appearances(&values, &grid, &SAMPLES[which])?;
    let (expected, hues) = appearances(&reference, &grid, &SAMPLES[which])?;
    let differences = seen.iter().zip(&expected).map(|(a, b)| UniformSpace::UCS.difference(*a, *b)).collect();
    Ok(Shifts { kelvin: temperature.kelvin, duv: temperature.duv, seen, expected, hues, differences })
}

/// Whether a light is a table at 5 nm whose wavelengths are multiples of 5 nm.
fn is_at_5_nm(light: &Spectrum) -> bool {
    let Spectrum::PiecewiseLinear(table) = light else { return false };
    Grid::of_samples(table)
        .is_some_and(|own| (own.step_nm() - 5.0).abs() < 1e-6 && (own.from_nm() / 5.0).fract() == 0.0)
}

/// J', a', b' and hues of the samples under a light, seen by the CIE 1964 observer.
fn appearances(values: &[f64], grid: &Grid, samples: &[Vec<f64>]) -> Result<(Vec<DVec3>, Vec<f64>)> {
    let lamp = Lamp::new(values, grid, Observer::by_name("1964-10")?)?;
    let model = Ciecam02::new(&ViewingConditions {
        white_xyz: lamp.white,
        adapting_luminance: 100.0,
        background_y: 0.2,
        surround: Surround::AVERAGE,
        discount_illuminant: true,
    })?;
    let jmh = samples.iter().map(|sample| model.appearance_from_xyz(lamp.xyz_of(sample)).jmh());
    Ok(jmh.map(|jmh| (UniformSpace::UCS.ucs_from_jmh(jmh), jmh.z)).unzip())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::color::{daylight, illuminant};
    use crate::spectrum::PiecewiseLinear;

    fn lamp_named(name: &str) -> Spectrum {
        Spectrum::PiecewiseLinear(illuminant::relative_power(name).unwrap())
    }

    #[test]
    fn lamps_have_the_known_indices() {
        let known = [("FL2", 70.120_824), ("FL11", 80.040_413), ("LED-B3", 85.324_309), ("HP1", 34.192_104)];
        for (name, rf) in known {
            let found = fidelity(&lamp_named(name)).unwrap();
            assert!((found.rf - rf).abs() < 6e-7, "{name}: {}", found.rf);
            assert!(found.rs.iter().all(|r| (0.0..=100.1).contains(r)), "{name}: {:?}", found.rs);
        }
        let fl2 = fidelity(&lamp_named("FL2")).unwrap();
        assert!((fl2.kelvin - 4224.4776).abs() < 1e-3 && (fl2.duv - 1.78856e-3).abs() < 1e-8, "{fl2:?}");
    }

    #[test]
    fn references_are_perfect() {
        let body = |kelvin| Spectrum::blackbody(kelvin).unwrap();
        let phase = Spectrum::PiecewiseLinear(daylight::of_kelvin(6504.0, daylight::Factors::Rounded).unwrap());
        for light in [body(1200.0), body(2856.0), body(3990.0), phase] {
            let found = fidelity(&light).unwrap();
            assert!(found.rf > 99.98, "{}", found.rf);
        }
        // Between 4000 and 5000 K the reference is a mixture.
        let mixed = fidelity(&body(4500.0)).unwrap().rf;
        assert!((98.0..99.0).contains(&mixed), "{mixed}");
    }

    #[test]
    fn the_index_is_straight_near_100_and_never_negative() {
        assert!((index_of_difference(0.0) - 100.0).abs() < 1e-3);
        assert!((index_of_difference(5.0) - (100.0 - 5.0 * SCALE)).abs() < 0.02);
        assert!((0.0..1e-10).contains(&index_of_difference(60.0)), "{}", index_of_difference(60.0));
    }

    #[test]
    fn what_a_table_lacks_is_dark() {
        let Spectrum::PiecewiseLinear(whole) = lamp_named("FL2") else { panic!("a table") };
        let inside: Vec<(f64, f64)> = whole.knots().filter(|k| (420.0..=680.0).contains(&k.0)).collect();
        let cut = PiecewiseLinear::new(inside.iter().map(|k| k.0).collect(), inside.iter().map(|k| k.1).collect());
        let dark = |k: (f64, f64)| if (420.0..=680.0).contains(&k.0) { k.1 } else { 0.0 };
        let filled = PiecewiseLinear::new(whole.lambdas_nm().to_vec(), whole.knots().map(dark).collect());
        let [cut, filled] = [cut, filled].map(|t| fidelity(&Spectrum::PiecewiseLinear(t.unwrap())).unwrap());
        assert_eq!(cut.rf, filled.rf);
        assert!((cut.rf - 70.12).abs() > 1e-3, "{}", cut.rf);
    }

    #[test]
    fn sums_at_1_nm_are_near_those_at_5_nm() {
        let Spectrum::PiecewiseLinear(coarse) = lamp_named("LED-B3") else { panic!("a table") };
        let lambdas: Vec<f64> = (380..=780).map(f64::from).collect();
        let fine = PiecewiseLinear::new(lambdas.clone(), coarse.eval_ascending(&lambdas)).unwrap();
        let [at_5, at_1] = [coarse, fine].map(|t| fidelity(&Spectrum::PiecewiseLinear(t)).unwrap().rf);
        assert!(at_5 != at_1 && (at_5 - at_1).abs() < 0.1, "{at_5} {at_1}");
    }

    #[test]
    fn lights_without_a_reference_are_errors() {
        for light in [Spectrum::Constant(0.0), Spectrum::line(460.0, 5.0).unwrap(), Spectrum::blackbody(700.0).unwrap()]
        {
            assert_eq!(fidelity(&light).unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
