//! Published approximations of correlated colour temperature, by name.

use super::{ohno, robertson, uv_from_xy, xy_from_uv};
use crate::color::daylight;
use crate::{Error, ErrorKind, Result, math};
use glam::DVec2;

/// A published approximation, each on the temperature scale of its authors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Approximation {
    /// A table 0.1 % apart, triangle and parabola \[Ohno2014\]; 1000–100 000 K.
    Ohno2013,
    /// Between 31 isotemperature lines \[Robertson1968\]; 1667–100 000 K.
    Robertson1968,
    /// The nearest point of a rational curve in u, v \[Krystek1985\]; 1000–15 000 K.
    Krystek1985,
    /// A cubic in x, y \[McCamy1992\]; some 2000–12 500 K.
    McCamy1992,
    /// Exponentials in x, y \[Hernandez1999\]; 3000–800 000 K.
    Hernandez1999,
    /// The nearest point of a curve of cubics in x, y \[Kang2002\]; 1667–25 000 K.
    Kang2002,
    /// The nearest point of the daylight locus in x, y \[CIE15\]; 4000–25 000 K.
    CieD,
}

/// Points of a curve among which the nearest is looked for first.
const COARSE_POINTS: usize = 256;
/// Halvings of an interval of the curve until neither end changes.
const HALVINGS: usize = 60;
/// Step of the central difference, relative to the reciprocal temperature: its error, near 1e-10, is that of its square.
const DIFFERENCE: f64 = 1e-5;
/// A colour of an end of a curve may lie beyond it by rounding: so much of the curve is added.
const END: f64 = 1e-6;

impl Approximation {
    const NAMED: [(&'static str, Self); 7] = [
        ("ohno-2013", Self::Ohno2013),
        ("robertson-1968", Self::Robertson1968),
        ("krystek-1985", Self::Krystek1985),
        ("mccamy-1992", Self::McCamy1992),
        ("hernandez-1999", Self::Hernandez1999),
        ("kang-2002", Self::Kang2002),
        ("cie-d", Self::CieD),
    ];

    /// "ohno-2013", "robertson-1968", "krystek-1985", "mccamy-1992", "hernandez-1999", "kang-2002" or "cie-d".
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn by_name(name: &str) -> Result<Self> {
        Self::NAMED
            .into_iter()
            .find(|(known, _)| *known == name)
            .map(|(_, value)| value)
            .ok_or_else(|| Error::unknown_name("method", name, Self::names()))
    }

    /// The names that [`Approximation::by_name`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::NAMED.into_iter().map(|(name, _)| name)
    }

    /// Temperature in K of CIE 1960 u, v.
    ///
    /// # Errors
    /// A colour outside the range of the method (of [`Approximation::McCamy1992`] and [`Approximation::Hernandez1999`]:
    /// one that gives no positive, finite temperature).
    pub fn kelvin(self, uv: [f64; 2]) -> Result<f64> {
        match self {
            Self::Ohno2013 => ohno::correlated(uv).map(|c| c.kelvin),
            Self::Robertson1968 => robertson::correlated(uv).map(|c| c.kelvin),
            Self::McCamy1992 => checked(mccamy_1992(xy_from_uv(uv)), uv),
            Self::Hernandez1999 => checked(hernandez_1999(xy_from_uv(uv)), uv),
            Self::Krystek1985 => nearest(krystek_1985, (1000.0, 15_000.0), uv, uv),
            Self::Kang2002 => nearest(kang_2002, (1667.0, 25_000.0), xy_from_uv(uv), uv),
            Self::CieD => nearest(daylight::xy_unchecked, (4000.0, 25_000.0), xy_from_uv(uv), uv),
        }
    }

    /// CIE 1960 u, v of a temperature in K on the method's curve.
    ///
    /// # Errors
    /// A temperature outside the method's range; [`ErrorKind::Unsupported`] for the two that have no curve.
    pub fn uv(self, kelvin: f64) -> Result<[f64; 2]> {
        match self {
            Self::Ohno2013 => ohno::uv_at(kelvin, 0.0),
            Self::Robertson1968 => robertson::uv_at(kelvin, 0.0),
            Self::Krystek1985 => inside(kelvin, (1000.0, 15_000.0)).map(krystek_1985),
            Self::Kang2002 => inside(kelvin, (1667.0, 25_000.0)).map(|t| uv_from_xy(kang_2002(t))),
            Self::CieD => daylight::xy(kelvin).map(uv_from_xy),
            Self::McCamy1992 | Self::Hernandez1999 => {
                let message = "a formula from colours to temperatures; expected a method with a curve of colours";
                Err(Error::new(ErrorKind::Unsupported, message))
            }
        }
    }
}

/// The temperature \[McCamy1992\] gives for x, y.
fn mccamy_1992([x, y]: [f64; 2]) -> f64 {
    let n = (x - 0.3320) / (y - 0.1858);
    ((-449.0 * n + 3525.0) * n - 6823.3) * n + 5520.33
}

/// The temperature \[Hernandez1999\] give for x, y: a second set of constants holds above 50 000 K.
fn hernandez_1999([x, y]: [f64; 2]) -> f64 {
    let n = (x - 0.3366) / (y - 0.1735);
    let term = |factor: f64, n: f64, width: f64| factor * math::exp(-n / width);
    let kelvin = -949.86315 + term(6253.80338, n, 0.92159) + term(28.70599, n, 0.20039) + term(0.00004, n, 0.07125);
    if kelvin <= 50_000.0 {
        return kelvin;
    }
    let n = (x - 0.3356) / (y - 0.1691);
    36284.48953 + term(0.00228, n, 0.07861) + term(5.4535e-36, n, 0.01543)
}

/// u, v of the curve of \[Krystek1985\].
fn krystek_1985(t: f64) -> [f64; 2] {
    let u =
        (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) / (1.0 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    let v =
        (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) / (1.0 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    [u, v]
}

/// x, y of the curve of \[Kang2002\].
fn kang_2002(kelvin: f64) -> [f64; 2] {
    let t = 1e3 / kelvin;
    let x = if kelvin <= 4000.0 {
        ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
    } else {
        ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390
    };
    let y = if kelvin <= 2222.0 {
        ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
    } else if kelvin <= 4000.0 {
        ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    } else {
        ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483
    };
    [x, y]
}

/// A temperature that a formula gave.
fn checked(kelvin: f64, uv: [f64; 2]) -> Result<f64> {
    if kelvin > 0.0 && kelvin.is_finite() {
        return Ok(kelvin);
    }
    let message = format!("u, v = {}, {} gives {kelvin} K; expected a colour near the Planckian locus", uv[0], uv[1]);
    Err(Error::new(ErrorKind::OutOfRange, message))
}

fn inside(kelvin: f64, (from, to): (f64, f64)) -> Result<f64> {
    if (from..=to).contains(&kelvin) {
        return Ok(kelvin);
    }
    Err(Error::new(ErrorKind::OutOfRange, format!("{kelvin} K; expected {from} to {to} K")))
}

/// The temperature of the point of a curve that is nearest to a chromaticity; `uv` is what errors show.
fn nearest(curve: fn(f64) -> [f64; 2], (from, to): (f64, f64), target: [f64; 2], uv: [f64; 2]) -> Result<f64> {
    let at = |mired: f64| DVec2::from(curve(1e6 / mired));
    let target = DVec2::from(target);
    let (first, last) = (1e6 / to * (1.0 - END), 1e6 / from * (1.0 + END));
    let mired = |i: usize| first + (last - first) * (i as f64 / (COARSE_POINTS - 1) as f64);
    let distance = |i: &usize| at(mired(*i)).distance_squared(target);
    let best = (0..COARSE_POINTS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    let (mut low, mut high) = (mired(best.saturating_sub(1)), mired((best + 1).min(COARSE_POINTS - 1)));
    // The sign of d|p − q|²/dm says on which side of the nearest point p(m) is.
    let beyond = |m: f64| (at(m) - target).dot(at(m * (1.0 + DIFFERENCE)) - at(m * (1.0 - DIFFERENCE))) > 0.0;
    if !target.is_finite() || beyond(low) || !beyond(high) {
        let message = format!("u, v = {}, {}; expected a colour of {from} to {to} K", uv[0], uv[1]);
        return Err(Error::new(ErrorKind::OutOfRange, message));
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if beyond(middle) { &mut high } else { &mut low }) = middle;
    }
    Ok((1e6 / (0.5 * (low + high))).clamp(from, to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::temperature;

    #[test]
    fn each_is_as_near_the_definition_as_its_authors_say() {
        let uv = temperature::uv_at(5000.0, 0.0).unwrap();
        for (name, within) in [
            ("ohno-2013", 0.1),
            ("robertson-1968", 5.0),
            ("krystek-1985", 20.0),
            ("mccamy-1992", 10.0),
            ("hernandez-1999", 30.0),
            ("kang-2002", 10.0),
        ] {
            let found = Approximation::by_name(name).unwrap().kelvin(uv).unwrap();
            assert!((found - 5000.0).abs() < within, "{name}: {found}");
        }
        let daylight = uv_from_xy(daylight::xy(5003.0).unwrap());
        assert!((Approximation::CieD.kelvin(daylight).unwrap() - 5003.0).abs() < 1e-6);
    }

    #[test]
    fn curves_lead_there_and_back() {
        for (name, range) in [("krystek-1985", (1000.0, 15e3)), ("kang-2002", (1667.0, 25e3)), ("cie-d", (4e3, 25e3))] {
            let method = Approximation::by_name(name).unwrap();
            for kelvin in [range.0, 4321.0, 7000.0, 12_345.6, range.1] {
                let back = method.kelvin(method.uv(kelvin).unwrap()).unwrap();
                assert!((back / kelvin - 1.0).abs() < 1e-8, "{name} {kelvin}: {back}");
            }
            for kelvin in [range.0 - 1.0, range.1 + 1.0, f64::NAN] {
                assert_eq!(method.uv(kelvin).unwrap_err().kind, ErrorKind::OutOfRange, "{name} {kelvin}");
            }
        }
    }

    #[test]
    fn colours_without_a_temperature() {
        for name in Approximation::names() {
            let method = Approximation::by_name(name).unwrap();
            assert!(method.kelvin([f64::NAN, 0.3]).is_err(), "{name}");
            if !["mccamy-1992", "hernandez-1999"].contains(&name) {
                assert!(method.kelvin([0.16, 0.24]).is_err(), "{name}");
            }
        }
        assert_eq!(Approximation::McCamy1992.uv(5000.0).unwrap_err().kind, ErrorKind::Unsupported);
        assert_eq!(Approximation::by_name("ohno").unwrap_err().nearest.as_deref(), Some("ohno-2013"));
    }
}
