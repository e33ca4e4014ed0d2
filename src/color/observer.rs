//! Colour-matching functions.

use super::integration::integral_of_product_2;
use super::table;
use crate::Result;
use crate::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, PiecewiseLinear};
use glam::DVec3;
use std::sync::LazyLock;

static CIE_1931_2DEG: LazyLock<Observer> = LazyLock::new(|| {
    let text = include_str!("../../data/observers/cie_1931_2deg.csv");
    Observer::from_table(text).expect("data/observers/cie_1931_2deg.csv has the columns x_bar, y_bar, z_bar")
});

/// A standard observer: x̄, ȳ, z̄ over 360–830 nm, linear between samples 1 nm apart, 0 outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Observer {
    curves: [PiecewiseLinear; 3],
    y_integral: f64,
}

impl Observer {
    /// The CIE 1931 standard observer for a field of 2° \[CIE15\].
    pub fn cie_1931_2deg() -> &'static Observer {
        &CIE_1931_2DEG
    }

    fn from_table(text: &str) -> Result<Self> {
        let curves = [table::column(text, "x_bar")?, table::column(text, "y_bar")?, table::column(text, "z_bar")?];
        let one = PiecewiseLinear::new(vec![LAMBDA_MIN_NM], vec![1.0])?;
        let y_integral = integral_of_product_2(&one, &curves[1], LAMBDA_MIN_NM, LAMBDA_MAX_NM);
        Ok(Self { curves, y_integral })
    }

    /// x̄, ȳ, z̄ at a wavelength in nm; 0 outside 360–830 nm.
    pub fn eval(&self, lambda_nm: f64) -> DVec3 {
        if !(LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&lambda_nm) {
            return DVec3::ZERO;
        }
        let [x, y, z] = self.curves().map(|curve| curve.eval(lambda_nm));
        DVec3::new(x, y, z)
    }

    /// The tables of x̄, ȳ, z̄.
    pub fn curves(&self) -> [&PiecewiseLinear; 3] {
        self.curves.each_ref()
    }

    /// ∫ ȳ dλ, nm.
    pub fn y_integral(&self) -> f64 {
        self.y_integral
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn has_the_published_values() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(observer.eval(555.0), DVec3::new(0.512_050_1, 1.0, 0.005_749_999));
        assert_eq!(observer.curves()[0].lambdas_nm().len(), 471);
        // CIE 15 gives the sum of ȳ at 1 nm as 106.857.
        assert_relative_eq!(observer.y_integral(), 106.857, epsilon = 5e-4);
    }

    #[test]
    fn sees_nothing_outside_its_range() {
        let observer = Observer::cie_1931_2deg();
        assert_eq!(observer.eval(359.999), DVec3::ZERO);
        assert_eq!(observer.eval(830.001), DVec3::ZERO);
        assert!(observer.eval(360.0).min_element() > 0.0);
    }
}
