//! Colours that no reflectance has are brought to the nearest one of their luminance and dominant wavelength.
//!
//! Nothing that reflects at most all light has the brightest saturated colours of wide spaces. The limit is known: at a
//! luminance the most saturated reflectances are 1 on one interval of wavelengths (which may wrap around the ends) and 0
//! elsewhere \[MacAdam1935\]. A colour beyond it moves straight to the grey of its luminance until it is inside.

use super::natural::Natural;
use super::target::{KNOTS, REFLECTANCE, Target};
use crate::color::RgbSpace;
use crate::spectrum::Spectrum;
use crate::{Error, ErrorKind, Result};
use glam::DVec3;

/// A projected colour stays this share of its saturation inside the limit, where logits are finite.
const MARGIN: f64 = 1e-3;
/// Further shares that are tried if no solution is found there.
const FALLBACKS: [f64; 4] = [1.0, 0.99, 0.9, 0.5];
/// Halvings of an interval of knots: to 1e-12 nm.
const BISECTIONS: usize = 50;

/// A reflectance, and what became of the colour that was asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Projected {
    /// The reflectance, in [0, 1].
    pub spectrum: Spectrum,
    /// Colour of the reflectance under D65: linear RGB of the space that was asked for.
    pub rgb: [f64; 3],
    /// What is left of the colour's distance from the grey of its luminance, in [0, 1]; 1 if nothing had to change.
    pub saturation: f64,
}

impl Projected {
    /// Whether the colour is another than was asked for.
    pub fn is_changed(&self, asked: [f64; 3]) -> bool {
        self.rgb != asked
    }
}

/// The natural reflectance of a colour, or of the nearest to it in the direction of grey that can be a reflectance.
///
/// Any finite linear RGB is accepted. Luminance and dominant wavelength stay, unless the luminance is not in (0, 1): then
/// the result is black or white.
///
/// # Errors
/// Components that are not finite.
///
/// ```
/// use abbe::color::{RgbSpace, upsample};
/// let rec2020 = RgbSpace::by_name("rec2020")?;
/// assert!(upsample::reflectance([0.0, 1.0, 0.0], rec2020).is_err());
/// let green = upsample::projected([0.0, 1.0, 0.0], rec2020)?;
/// assert!(green.saturation > 0.5 && green.saturation < 1.0);
/// # Ok::<(), abbe::Error>(())
/// ```
pub fn projected(rgb: [f64; 3], space: &RgbSpace) -> Result<Projected> {
    if let Some(bad) = rgb.into_iter().find(|c| !c.is_finite()) {
        return Err(Error::new(ErrorKind::NotFinite, format!("{bad} in {rgb:?}; expected finite components")));
    }
    let target = &*REFLECTANCE;
    let color = target.rgb_from(space) * DVec3::from(rgb);
    let is_grey = rgb[0] == rgb[1] && rgb[1] == rgb[2];
    if (is_grey || is_within_srgb(color))
        && let Ok(spectrum) = Natural::new().reflectance(rgb, space)
    {
        return Ok(Projected { spectrum, rgb, saturation: 1.0 });
    }
    let (projected, saturation, spectrum) = towards_grey(target, color);
    let rgb = if saturation == 1.0 { rgb } else { (target.space_from_rgb(space) * projected).to_array() };
    Ok(Projected { spectrum, rgb, saturation })
}

/// A colour inside the limit of reflectances: the same one, or one moved towards the grey of its luminance.
pub(super) fn within_limit(color: DVec3) -> DVec3 {
    if is_within_srgb(color) {
        return color;
    }
    let luminance = REFLECTANCE.xyz_from_rgb.row(1).dot(color);
    if !(luminance > 0.0 && luminance < 1.0) {
        return DVec3::splat(if luminance > 0.0 { 1.0 } else { 0.0 });
    }
    let grey = DVec3::splat(luminance);
    let limit = limit_of_saturation(&REFLECTANCE, luminance, color - grey) * (1.0 - MARGIN);
    grey + limit.min(1.0) * (color - grey)
}

/// Every colour of sRGB is a reflectance.
fn is_within_srgb(color: DVec3) -> bool {
    color.min_element() >= 0.0 && color.max_element() <= 1.0
}

/// The colour that is left, its share of saturation and its reflectance.
fn towards_grey(target: &Target, color: DVec3) -> (DVec3, f64, Spectrum) {
    let luminance = target.xyz_from_rgb.row(1).dot(color);
    if !(luminance > 0.0 && luminance < 1.0) {
        let end = if luminance > 0.0 { 1.0 } else { 0.0 };
        return (DVec3::splat(end), 0.0, Spectrum::Constant(end));
    }
    let grey = DVec3::splat(luminance);
    let limit = limit_of_saturation(target, luminance, color - grey);
    // Colours within the limit need no margin; next to it a solution may be too steep to be found.
    let first = (limit > 1.0 - MARGIN).then_some(1.0);
    let rest = FALLBACKS.into_iter().map(|share| share * (1.0 - MARGIN) * limit.min(1.0));
    for saturation in first.into_iter().chain(rest) {
        let candidate = grey + saturation * (color - grey);
        if let Some(spectrum) = Natural::new().of_color(candidate) {
            return (candidate, saturation, spectrum);
        }
    }
    (grey, 0.0, Spectrum::Constant(luminance))
}

/// The largest factor of a direction of luminance 0 that leads from the grey of a luminance to a reflectance.
fn limit_of_saturation(target: &Target, luminance: f64, direction: DVec3) -> f64 {
    let band = Bands::new(target, luminance);
    let aside = |start: f64| {
        let offset = band.color(start) - luminance;
        // Two coordinates are enough: luminance is 0 in both.
        (offset.x * direction.z - offset.z * direction.x, offset)
    };
    let along = |offset: DVec3| {
        let (a, b) = (DVec3::new(offset.x, 0.0, offset.z), DVec3::new(direction.x, 0.0, direction.z));
        a.dot(b) / b.length_squared()
    };
    let mut limit = 0.0_f64;
    let mut before = aside(0.0).0;
    for i in 0..KNOTS {
        let (mut low, mut high) = (i as f64, (i + 1) as f64);
        let (after, _) = aside(high);
        if (before < 0.0) != (after < 0.0) {
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if (aside(middle).0 < 0.0) == (before < 0.0) { low = middle } else { high = middle }
            }
            limit = limit.max(along(aside(low).1));
        }
        before = after;
    }
    limit
}

/// The reflectances of one luminance that are 1 on an interval of knots, by its start.
struct Bands {
    luminance: f64,
    /// Colours, and luminances, of the knots before each; one more than there are knots.
    colors: Vec<DVec3>,
    luminances: Vec<f64>,
}

impl Bands {
    fn new(target: &Target, luminance: f64) -> Self {
        let row = target.xyz_from_rgb.row(1);
        let (mut colors, mut luminances) = (vec![DVec3::ZERO], vec![0.0]);
        let (mut color, mut sum) = (DVec3::ZERO, 0.0);
        for &weight in &target.weights {
            color += weight;
            // Rounding must not make the sum descend.
            sum += row.dot(weight).max(0.0);
            colors.push(color);
            luminances.push(sum);
        }
        Self { luminance, colors, luminances }
    }

    /// The colour of the band that starts at a knot from 0 to their number; between two, a part of the first belongs to it.
    fn color(&self, start: f64) -> DVec3 {
        let (color, from) = self.before(start);
        let (all, white) = (self.luminances[KNOTS], self.colors[KNOTS]);
        let to = from + self.luminance;
        if to <= all { self.up_to(to) - color } else { self.up_to(to - all) + white - color }
    }

    /// Colour and luminance of what lies before a position.
    fn before(&self, position: f64) -> (DVec3, f64) {
        let cell = (position as usize).min(KNOTS - 1);
        let t = position - cell as f64;
        let luminance = self.luminances[cell] + t * (self.luminances[cell + 1] - self.luminances[cell]);
        (self.colors[cell].lerp(self.colors[cell + 1], t), luminance)
    }

    /// Colour of the first knots up to a luminance.
    fn up_to(&self, luminance: f64) -> DVec3 {
        let above = self.luminances.partition_point(|&l| l <= luminance).clamp(1, KNOTS);
        let (low, high) = (self.luminances[above - 1], self.luminances[above]);
        let t = if high > low { ((luminance - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        self.colors[above - 1].lerp(self.colors[above], t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::upsample::{reflectance, rgb_of_reflectance};

    fn space(name: &str) -> &'static RgbSpace {
        RgbSpace::by_name(name).unwrap()
    }

    #[test]
    fn possible_colours_stay_what_they_are() {
        for (rgb, name) in [([0.2, 0.5, 0.1], "srgb"), ([0.3; 3], "rec2020"), ([0.5, 0.2, 0.4], "prophoto-rgb")] {
            let got = projected(rgb, space(name)).unwrap();
            assert_eq!((got.rgb, got.saturation), (rgb, 1.0));
            assert_eq!(got.spectrum, reflectance(rgb, space(name)).unwrap());
        }
    }

    #[test]
    fn impossible_colours_keep_luminance_and_direction() {
        for name in ["display-p3", "rec2020", "acescg", "aces2065-1", "prophoto-rgb"] {
            for rgb in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]] {
                let got = projected(rgb, space(name)).unwrap();
                let (least, most) = got.spectrum.range();
                assert!(0.0 <= least && most <= 1.0);
                let back = DVec3::from(rgb_of_reflectance(&got.spectrum, space(name)));
                assert!((back - DVec3::from(got.rgb)).abs().max_element() < 1e-9, "{name} {rgb:?}: {back}");
                let to_d65 = REFLECTANCE.xyz_from_rgb * REFLECTANCE.rgb_from(space(name));
                let [asked, given] = [rgb, got.rgb].map(|rgb| to_d65 * DVec3::from(rgb));
                // Where a primary has negative luminance, as ACES blue has, others exceed 1 without it.
                if asked.y > 0.0 && asked.y < 1.0 {
                    assert!((asked.y - given.y).abs() < 1e-12, "{name} {rgb:?}");
                    let grey = REFLECTANCE.white * asked.y;
                    let turn = (asked - grey).normalize().cross((given - grey).normalize()).length();
                    assert!(turn < 1e-9, "{name} {rgb:?}: {turn:e}");
                }
            }
        }
    }

    #[test]
    fn the_limit_is_that_of_reflectances() {
        // Just inside there is a reflectance, just outside none.
        for direction in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 1.0)] {
            for luminance in [0.03, 0.2, 0.5, 0.9] {
                let grey = DVec3::splat(luminance);
                let away = direction - REFLECTANCE.xyz_from_rgb.row(1).dot(direction);
                let limit = limit_of_saturation(&REFLECTANCE, luminance, away);
                assert!(limit > 0.0, "{direction} {luminance}");
                assert!(
                    Natural::new().of_color(grey + limit * (1.0 - 2e-3) * away).is_some(),
                    "{direction} {luminance}"
                );
                assert!(
                    Natural::new().of_color(grey + limit * (1.0 + 1e-3) * away).is_none(),
                    "{direction} {luminance}"
                );
            }
        }
    }

    #[test]
    fn ends_of_luminance_are_black_and_white() {
        for (rgb, value) in [([-1.0, 0.0, 0.0], 0.0), ([2.0; 3], 1.0), ([1.0; 3], 1.0), ([0.0; 3], 0.0)] {
            assert_eq!(projected(rgb, RgbSpace::srgb()).unwrap().spectrum, Spectrum::Constant(value));
        }
        assert!(projected([f64::NAN, 0.0, 0.0], RgbSpace::srgb()).is_err());
        // A negative component of a colour inside the locus is no obstacle.
        let outside = projected([-0.05, 0.4, 0.1], RgbSpace::srgb()).unwrap();
        assert!(outside.saturation == 1.0 && outside.rgb[0] < 0.0);
    }
}
