//! The CIE's transform of 1994, which bends responses by how bright the fields are.

use super::ConeTransform;
use crate::{Error, ErrorKind, Result, math};
use glam::DVec3;
use std::f64::consts::PI;

/// What an eye is adapted to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cie1994Field {
    /// Chromaticity x, y of the illuminant.
    pub white_xy: [f64; 2],
    /// Illuminance in lux.
    pub illuminance: f64,
}

/// Corresponding colours of surfaces before one grey background under two illuminants \[CIE109\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cie1994 {
    from: Response,
    to: Response,
    /// Luminance factor of the background and the noise term, in percent as in the publication.
    background: f64,
    noise: f64,
}

/// A field as the model sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Response {
    /// ξ, η, ζ.
    cone: DVec3,
    exponents: DVec3,
}

impl Cie1994 {
    /// The transform between two fields.
    ///
    /// `background` is the luminance factor of the background, in [0.18, 1]; `noise` is 0.01 in the publication, 0.001
    /// for observers with little noise.
    ///
    /// # Errors
    /// A background outside of its range; a noise that is negative; an illuminance or a y that is not positive; anything
    /// that is not finite.
    pub fn new(from: Cie1994Field, to: Cie1994Field, background: f64, noise: f64) -> Result<Self> {
        let out_of_range = |message: String| Err(Error::new(ErrorKind::OutOfRange, message));
        if !(0.18..=1.0).contains(&background) {
            return out_of_range(format!("background of luminance factor {background}; expected one in [0.18, 1]"));
        }
        if !(noise >= 0.0 && noise.is_finite()) {
            return out_of_range(format!("noise {noise}; expected a finite number of at least 0"));
        }
        for field in [from, to] {
            let [x, y] = field.white_xy;
            let positive = field.illuminance > 0.0 && y > 0.0;
            if !(positive && [x, y, field.illuminance].into_iter().all(f64::is_finite)) {
                return out_of_range(format!("{field:?}; expected a finite field with y and illuminance above 0"));
            }
        }
        let background = 100.0 * background;
        let [from, to] = [from, to].map(|field| Response::new(field, background));
        Ok(Self { from, to, background, noise: 100.0 * noise })
    }

    /// XYZ under the second illuminant that looks as `xyz` does under the first.
    pub fn forward(&self, xyz: DVec3) -> DVec3 {
        let cone_from_xyz = ConeTransform::VonKries.cone_from_xyz();
        let response = cone_from_xyz * (100.0 * xyz) + self.noise;
        let (before, after) = (self.white(self.from), self.white(self.to));
        let mut adapted = DVec3::ZERO;
        for i in 0..3 {
            let (beta_1, beta_2) = (self.from.exponents[i], self.to.exponents[i]);
            let ratio = math::signed_pow(response[i] / before[i], beta_1 / beta_2);
            adapted[i] = after[i] * math::pow(self.brightness_ratio(), 1.0 / beta_2) * ratio - self.noise;
        }
        cone_from_xyz.inverse() * adapted / 100.0
    }

    /// XYZ under the first illuminant that looks as `xyz` does under the second.
    pub fn inverse(&self, xyz: DVec3) -> DVec3 {
        Self { from: self.to, to: self.from, ..*self }.forward(xyz)
    }

    /// Responses to the background, with noise.
    fn white(&self, field: Response) -> DVec3 {
        self.background * field.cone + self.noise
    }

    /// K, which keeps a grey of 20 % as bright as it was.
    fn brightness_ratio(&self) -> f64 {
        let brightness = |field: Response| {
            let ratio = self.white(field) / (20.0 * field.cone + self.noise);
            let red = math::signed_pow(ratio.x, 2.0 / 3.0 * field.exponents.x);
            red * math::signed_pow(ratio.y, 1.0 / 3.0 * field.exponents.y)
        };
        brightness(self.from) / brightness(self.to)
    }
}

impl Response {
    fn new(field: Cie1994Field, background: f64) -> Self {
        let [x, y] = field.white_xy;
        let cone = DVec3::new(
            0.48105 * x + 0.78841 * y - 0.08081,
            -0.27200 * x + 1.11962 * y + 0.04570,
            0.91822 * (1.0 - x - y),
        ) / y;
        let adapting = background * field.illuminance / (100.0 * PI) * cone;
        let beta_1 = |response: f64| {
            let power = math::signed_pow(response, 0.4495);
            (6.469 + 6.362 * power) / (6.469 + power)
        };
        let power = math::signed_pow(adapting.z, 0.5128);
        let beta_2 = 0.7844 * (8.414 + 8.091 * power) / (8.414 + power);
        Self { cone, exponents: DVec3::new(beta_1(adapting.x), beta_1(adapting.y), beta_2) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::xyz_from_xy;

    const A: Cie1994Field = Cie1994Field { white_xy: [0.44758, 0.40745], illuminance: 1000.0 };
    const D65: Cie1994Field = Cie1994Field { white_xy: [0.3127, 0.3290], illuminance: 1000.0 };

    /// The example of colour-science's documentation.
    #[test]
    fn has_the_published_example() {
        let from = Cie1994Field { white_xy: [0.4476, 0.4074], ..A };
        let model = Cie1994::new(from, D65, 0.2, 0.01).unwrap();
        let adapted = model.forward(DVec3::new(0.2800, 0.2126, 0.0527));
        assert!((adapted - DVec3::new(0.24034, 0.21156, 0.17643)).abs().max_element() < 5e-5, "{adapted}");
    }

    #[test]
    fn the_inverse_undoes_it() {
        let dim = Cie1994Field { illuminance: 50.0, ..D65 };
        let model = Cie1994::new(A, dim, 0.3, 0.01).unwrap();
        for xyz in [[0.0; 3], [0.3, 0.2, 0.1], [1.0985, 1.0, 0.3558], [-0.05, -0.02, 0.3]].map(DVec3::from) {
            let back = model.inverse(model.forward(xyz));
            assert!((back - xyz).abs().max_element() < 1e-13, "{xyz} {back}");
        }
    }

    #[test]
    fn equal_fields_change_nothing_and_the_background_stays_the_background() {
        let same = Cie1994::new(D65, D65, 0.2, 0.01).unwrap();
        let xyz = DVec3::new(0.3, 0.2, 0.1);
        assert!((same.forward(xyz) - xyz).abs().max_element() < 1e-15);
        // A grey of 20 % is what brightness is kept for.
        let model = Cie1994::new(A, D65, 0.2, 0.01).unwrap();
        let grey = model.forward(0.2 * xyz_from_xy(A.white_xy));
        assert!((grey - 0.2 * xyz_from_xy(D65.white_xy)).abs().max_element() < 1e-4, "{grey}");
    }

    #[test]
    fn impossible_fields_are_errors() {
        let dark = Cie1994Field { illuminance: 0.0, ..A };
        for result in [
            Cie1994::new(dark, D65, 0.2, 0.01),
            Cie1994::new(A, Cie1994Field { white_xy: [0.3, f64::NAN], ..A }, 0.2, 0.01),
            Cie1994::new(A, D65, 0.1, 0.01),
            Cie1994::new(A, D65, 0.2, -1.0),
        ] {
            assert_eq!(result.unwrap_err().kind, ErrorKind::OutOfRange);
        }
    }
}
