//! The CIE colour rendering index.

use super::reference;
use super::sampling::{Lamp, reflectances, sample};
use crate::color::space::uv_1960_from_xyz;
use crate::color::{Observer, temperature};
use crate::spectrum::Spectrum;
use crate::spectrum::resample::Extrapolation;
use crate::{Result, math};
use glam::DVec3;
use std::sync::LazyLock;

/// Test colour samples 1 to 15 on the grid of [`reference::wide_grid`].
static SAMPLES: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| {
    let text = include_str!("../../../data/quality/cri.csv");
    reflectances(text, &reference::wide_grid()).expect("data/quality/cri.csv holds reflectances every 5 nm")
});

/// Colour rendering of a light \[CIE13.3\]: 100 where colours look as under the reference, less where they do not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cri {
    /// Ra: mean of R1 to R8.
    pub ra: f64,
    /// R1 to R14: special indices. Strong shifts make them negative.
    pub r: [f64; 14],
    /// R15: Japanese skin, which later editions add.
    pub r15: f64,
    /// Correlated colour temperature, K (c₂ = 1.4388·10⁻² m·K); that of the reference.
    pub kelvin: f64,
}

/// The CIE colour rendering index of a light \[CIE13.3\].
///
/// The reference is a blackbody below 5000 K and daylight from there on, of the light's correlated colour temperature by
/// Robertson's method \[Robertson1968\], as is customary; below 1667 K, where that ends, by definition. Robertson's method is
/// up to 2 K off, which changes Ra by up to 0.016; for the temperature by definition see [`cri_against`].
///
/// # Errors
/// A light without luminance, or whose colour temperature has no reference: above 25 000 K.
pub fn cri(light: &Spectrum) -> Result<Cri> {
    let lamp = lamp(light)?;
    index(&lamp, customary_kelvin(uv_1960_from_xyz(lamp.white))?)
}

/// The index against the reference of a stated colour temperature in K, on the scale of 1990
/// ([`temperature::its_90_from_si`]).
///
/// # Errors
/// A light without luminance; a temperature that is not positive, or above 25 000 K.
pub fn cri_against(light: &Spectrum, kelvin: f64) -> Result<Cri> {
    index(&lamp(light)?, kelvin)
}

fn customary_kelvin(uv: [f64; 2]) -> Result<f64> {
    let by_definition = |_| temperature::correlated(uv).map(|found| temperature::its_90_from_si(found.kelvin));
    temperature::robertson::correlated(uv).map(|found| found.kelvin).or_else(by_definition)
}

fn lamp(light: &Spectrum) -> Result<Lamp> {
    let grid = reference::wide_grid();
    let values = sample(light, &grid, Extrapolation::Constant)?;
    Lamp::new(&values, &grid, Observer::cie_1931_2deg())
}

fn index(lamp: &Lamp, kelvin: f64) -> Result<Cri> {
    let grid = reference::wide_grid();
    let values = reference::wide_reference(kelvin, &grid)?;
    let reference = Lamp::new(&values, &grid, Observer::cie_1931_2deg())?;
    let colors = |lamp: &Lamp| SAMPLES.iter().map(|sample| lamp.xyz_of(sample)).collect::<Vec<_>>();
    let special = special_indices(lamp.white, &colors(lamp), reference.white, &colors(&reference));
    let mut r = [0.0; 14];
    r.copy_from_slice(&special[..14]);
    Ok(Cri { ra: r[..8].iter().sum::<f64>() / 8.0, r, r15: special[14], kelvin })
}

/// 100 − 4.6 ΔE for the colours of samples under a light and its reference, all with Y = 1 for the white.
fn special_indices(white: DVec3, colors: &[DVec3], reference_white: DVec3, reference_colors: &[DVec3]) -> Vec<f64> {
    let index = |(color, reference): (&DVec3, &DVec3)| {
        let seen = uvw(color.y, adapted(uv_1960_from_xyz(*color), white, reference_white), reference_white);
        let expected = uvw(reference.y, uv_1960_from_xyz(*reference), reference_white);
        100.0 - 4.6 * (seen - expected).length()
    };
    colors.iter().zip(reference_colors).map(index).collect()
}

/// U*, V*, W* of a luminance factor and a chromaticity.
fn uvw(y: f64, uv: [f64; 2], white: DVec3) -> DVec3 {
    let [white_u, white_v] = uv_1960_from_xyz(white);
    let w = 25.0 * math::cbrt(100.0 * y) - 17.0;
    DVec3::new(13.0 * w * (uv[0] - white_u), 13.0 * w * (uv[1] - white_v), w)
}

/// The chromaticity seen under the reference that looks as `uv` does under the light: von Kries' rule in u, v.
fn adapted(uv: [f64; 2], white: DVec3, reference_white: DVec3) -> [f64; 2] {
    let responses = |[u, v]: [f64; 2]| [(4.0 - u - 10.0 * v) / v, (1.708 * v + 0.404 - 1.481 * u) / v];
    let of_white = |white| responses(uv_1960_from_xyz(white));
    let ([c, d], [c_t, d_t], [c_r, d_r]) = (responses(uv), of_white(white), of_white(reference_white));
    let (c, d) = (c * c_r / c_t, d * d_r / d_t);
    let denominator = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / denominator, 5.520 / denominator]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{daylight, illuminant, xyz_of_emission, xyz_of_reflectance};
    use crate::spectrum::PiecewiseLinear;
    use crate::{ErrorKind, nearest_name};

    fn lamp_named(name: &str) -> Spectrum {
        Spectrum::PiecewiseLinear(illuminant::relative_power(name).unwrap())
    }

    fn table(values: &[f64]) -> Spectrum {
        let lambdas = reference::wide_grid().lambdas_nm();
        Spectrum::PiecewiseLinear(PiecewiseLinear::new(lambdas, values.to_vec()).unwrap())
    }

    #[test]
    fn lamps_have_the_known_indices() {
        let known = [("FL2", 64.233_724), ("FL11", 82.859_147), ("LED-B3", 84.844_064), ("HP1", 8.498_155)];
        for (name, ra) in known {
            let found = cri(&lamp_named(name)).unwrap();
            assert!((found.ra - ra).abs() < 6e-7, "{name}: {found:?}");
            assert!(found.r.iter().any(|r| *r < found.ra), "{name}");
        }
        // CIE 13.3 and the makers' data sheets: FL4 has R9 = −111.
        assert!((cri(&lamp_named("FL4")).unwrap().r[8] + 111.0).abs() < 1.0);
    }

    #[test]
    fn references_are_perfect() {
        let lights = [2000.0, 2856.0, 4990.0].map(|kelvin| Spectrum::blackbody(kelvin).unwrap());
        let phase = |kelvin| daylight::of_kelvin(kelvin, daylight::Factors::Exact).unwrap();
        let phases = [5010.0, 6504.0, 12_000.0].map(|kelvin| Spectrum::PiecewiseLinear(phase(kelvin)));
        for light in lights.into_iter().chain(phases) {
            let found = cri(&light).unwrap();
            // Robertson's temperature is off by up to 1 K; factors of daylight are rounded.
            assert!(found.r.iter().chain([&found.r15]).all(|r| (99.8..=100.0).contains(r)), "{found:?}");
        }
    }

    #[test]
    fn against_another_reference_it_is_worse() {
        let (light, warm) = (lamp_named("FL2"), Spectrum::blackbody(2000.0).unwrap());
        let own = cri(&light).unwrap();
        assert_eq!(cri_against(&light, own.kelvin).unwrap(), own);
        assert!(cri_against(&warm, 2300.0).unwrap().ra < 97.0);
        // Below the end of Robertson's table the definition takes over.
        let cold = cri(&Spectrum::blackbody(1500.0).unwrap()).unwrap().kelvin;
        assert!((cold - 1500.0).abs() < 0.3, "{cold}");
        assert!((cri(&warm).unwrap().kelvin - 2000.0).abs() < 1.0);
    }

    #[test]
    fn scale_and_finer_tables_change_nothing() {
        let light = lamp_named("LED-RGB1");
        let found = cri(&light).unwrap();
        let scaled = cri(&light.clone().scaled(1e-7)).unwrap();
        assert!((found.ra - scaled.ra).abs() < 1e-10 && (found.kelvin - scaled.kelvin).abs() < 1e-8);
        // The same straight lines at 0.5 nm: means under triangles round the corners off.
        let Spectrum::PiecewiseLinear(coarse) = &light else { unreachable!("a table") };
        let lambdas: Vec<f64> = (0..=800).map(|i| 380.0 + 0.5 * f64::from(i)).collect();
        let fine = PiecewiseLinear::new(lambdas.clone(), coarse.eval_ascending(&lambdas)).unwrap();
        let fine = cri(&Spectrum::PiecewiseLinear(fine)).unwrap();
        assert!((found.ra - fine.ra).abs() < 0.03, "{} {}", found.ra, fine.ra);
    }

    #[test]
    fn narrow_lines_lose_nothing() {
        // Three laser lines: the index does not depend on their width or on where they lie between whole wavelengths.
        let white = |width: f64, shift: f64| {
            let sum = [(450.0, 1.0), (530.0, 0.9), (610.0, 1.1)]
                .map(|(center, power)| Spectrum::line(center + shift, width).unwrap().scaled(power).tabulate());
            let knots = crate::color::integration::merged_knots(&[&sum[0], &sum[1], &sum[2]], 360.0, 830.0);
            let values = knots.iter().map(|&l| sum.iter().map(|line| line.eval(l)).sum()).collect();
            cri(&Spectrum::PiecewiseLinear(PiecewiseLinear::new(knots, values).unwrap())).unwrap()
        };
        let [reference, thin, shifted] = [white(0.4, 0.0), white(0.01, 0.0), white(0.01, 0.01)];
        assert!((reference.ra - thin.ra).abs() < 0.02, "{} {}", reference.ra, thin.ra);
        assert!((shifted.ra - thin.ra).abs() < 0.05, "{} {}", shifted.ra, thin.ra);
    }

    /// Ra by exact integrals over 360–830 nm, against the same reference.
    fn exact_ra(light: &Spectrum, kelvin: f64) -> f64 {
        let observer = Observer::cie_1931_2deg();
        let reference = table(&reference::wide_reference(kelvin, &reference::wide_grid()).unwrap());
        let colors = |light: &Spectrum| {
            let white = xyz_of_emission(light, observer);
            let of = |sample: &Vec<f64>| xyz_of_reflectance(&table(sample), light, observer);
            (white / white.y, SAMPLES.iter().take(8).map(of).collect::<Vec<_>>())
        };
        let ((white, seen), (reference_white, expected)) = (colors(light), colors(&reference));
        special_indices(white, &seen, reference_white, &expected).iter().sum::<f64>() / 8.0
    }

    #[test]
    fn exact_integrals_and_temperatures_hardly_change_it() {
        let (mut by_integral, mut by_temperature) = (0.0_f64, 0.0_f64);
        // Of all CIE illuminants these change most.
        for name in ["HP1", "LED-RGB1", "HP2", "FL3.7", "D55", "D60", "D75", "E"] {
            let light = lamp_named(name);
            let found = cri(&light).unwrap();
            let uv = uv_1960_from_xyz(lamp(&light).unwrap().white);
            let kelvin = temperature::its_90_from_si(temperature::correlated(uv).unwrap().kelvin);
            let a = (found.ra - exact_ra(&light, found.kelvin)).abs();
            let b = (found.ra - cri_against(&light, kelvin).unwrap().ra).abs();
            (by_integral, by_temperature) = (by_integral.max(a), by_temperature.max(b));
        }
        assert!(by_integral < 0.021 && by_temperature < 0.016, "{by_integral} {by_temperature}");
    }

    #[test]
    fn lights_without_luminance_or_reference_are_errors() {
        let infrared = Spectrum::PiecewiseLinear(PiecewiseLinear::new(vec![300.0, 900.0], vec![0.0, 0.0]).unwrap());
        let blue = Spectrum::line(450.0, 10.0).unwrap();
        for light in [infrared, blue, Spectrum::Constant(-1.0)] {
            assert_eq!(cri(&light).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        for kelvin in [0.0, -5.0, 26_000.0, f64::NAN] {
            assert_eq!(cri_against(&Spectrum::Constant(1.0), kelvin).unwrap_err().kind, ErrorKind::OutOfRange);
        }
        assert_eq!(nearest_name("FL22", illuminant::names()), Some("FL2"));
    }
}
