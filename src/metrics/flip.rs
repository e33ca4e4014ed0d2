//! FLIP: what flickers when a viewer switches between two pictures \[Andersson2020\].
//!
//! Both pictures are blurred as the eye blurs them at a viewing distance and compared in Hunt-adjusted CIE Lab by the
//! HyAB distance; where edges or points differ as well, the difference counts for more.

use super::{Displayed, Pair, stats};
use crate::Image;
use crate::color::RgbSpace;
use crate::color::space::lab_from_xyz;
use crate::math;
use glam::DVec3;
use std::f64::consts::PI;

/// Pixels per degree of visual angle that the paper assumes: a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
pub const FLIP_PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// Contrast sensitivity of the achromatic channel and the two chromatic ones as sums of a √(π/b) exp(−π² x² / b), x in
/// degrees: pairs (a, b), table 1 of the paper. In two dimensions the factor stays √(π/b), as in the authors' programs,
/// with whose figures ours are compared.
const SENSITIVITY: [&[(f64, f64)]; 3] = [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];
/// Largest b: all filters end at three of its standard deviations.
const WIDEST: f64 = 0.04;
/// Exponent of colour differences, q_c.
const COLOR_EXPONENT: f64 = 0.7;
/// Share of the largest colour difference, p_c, below which differences are small; they fill [`KNEE_ERROR`] of the range.
const KNEE: f64 = 0.4;
/// Share of the range, p_t, that small differences fill.
const KNEE_ERROR: f64 = 0.95;
/// Width of an edge that is seen as one, w, degrees.
const FEATURE_WIDTH: f64 = 0.082;
/// Exponent of feature differences, q_f.
const FEATURE_EXPONENT: f64 = 0.5;

/// Computes the mean of a [`flip_map`] over the pixels of `pair` that count, in [0, 1].
pub fn flip(pair: &Pair, map: &Image) -> f64 {
    stats::mean(&pair.counted_values(map.plane(0)).collect::<Vec<_>>())
}

/// Computes FLIP of every pixel, in [0, 1], as a picture of one channel. This is the variant for pictures of low dynamic range,
/// over sRGB clipped to [0, 1]. Both pictures have the same size.
pub fn flip_map(test: &Displayed, reference: &Displayed, pixels_per_degree: f64) -> Image {
    let size = test.size();
    let [test, reference] = [test, reference].map(|picture| Seen::new(picture, pixels_per_degree));
    let largest = largest_difference();
    let error = |i: usize| {
        let color = redistributed(math::pow(hyab(test.lab[i], reference.lab[i]), COLOR_EXPONENT), largest);
        let [edges, points] = [0, 1].map(|k| (test.features[k][i] - reference.features[k][i]).abs());
        let feature = math::pow(edges.max(points) / 2f64.sqrt(), FEATURE_EXPONENT);
        if color == 0.0 { 0.0 } else { math::pow(color, 1.0 - feature) }
    };
    Image::new(size, &["FLIP"], (0..test.lab.len()).map(error).collect())
}

/// What the eye receives of a picture.
struct Seen {
    /// Colours of the blurred picture, in Hunt-adjusted Lab.
    lab: Vec<DVec3>,
    /// Strengths of edges and of points in every pixel.
    features: [Vec<f64>; 2],
}

impl Seen {
    fn new(picture: &Displayed, pixels_per_degree: f64) -> Self {
        let width = picture.size()[0] as usize;
        let (space, white) = (RgbSpace::srgb(), RgbSpace::srgb().white_xyz());
        let opponent: Vec<DVec3> =
            picture.linear_srgb().map(|rgb| opponent_from_relative(space.xyz_from_rgb * rgb / white)).collect();
        let plane = |c: usize| Plane { width, values: opponent.iter().map(|v| v[c]).collect() };
        let blurred = [0, 1, 2].map(|c| plane(c).seen(SENSITIVITY[c], pixels_per_degree));
        let lab = (0..opponent.len())
            .map(|i| {
                let xyz = relative_from_opponent(DVec3::from(blurred.each_ref().map(|p| p[i]))) * white;
                let rgb = (space.rgb_from_xyz * xyz).clamp(DVec3::ZERO, DVec3::ONE);
                hunt_adjusted(lab_from_xyz(space.xyz_from_rgb * rgb, white))
            })
            .collect();
        let lightness = Plane { width, values: opponent.iter().map(|v| (v.x + 16.0) / 116.0).collect() };
        Self { lab, features: lightness.features(pixels_per_degree) }
    }
}

/// Turns XYZ relative to white into achromatic, red–green and blue–yellow values: CIE Lab without its cube roots.
fn opponent_from_relative(xyz: DVec3) -> DVec3 {
    DVec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
}

fn relative_from_opponent(v: DVec3) -> DVec3 {
    let y = (v.x + 16.0) / 116.0;
    DVec3::new(y + v.y / 500.0, y, y - v.z / 200.0)
}

/// Makes dark colours less colourful, as they look.
fn hunt_adjusted(lab: DVec3) -> DVec3 {
    DVec3::new(lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z)
}

/// Computes the HyAB distance: the difference in lightness plus the distance in the plane of a and b.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let d = a - b;
    d.x.abs() + (d.y * d.y + d.z * d.z).sqrt()
}

/// Computes the largest difference of two colours of sRGB, green and blue, to the power q_c.
fn largest_difference() -> f64 {
    let space = RgbSpace::srgb();
    let [green, blue] =
        [DVec3::Y, DVec3::Z].map(|rgb| hunt_adjusted(lab_from_xyz(space.xyz_from_rgb * rgb, space.white_xyz())));
    math::pow(hyab(green, blue), COLOR_EXPONENT)
}

/// Compresses large differences into what small ones leave of [0, 1].
fn redistributed(difference: f64, largest: f64) -> f64 {
    let knee = KNEE * largest;
    if difference < knee {
        KNEE_ERROR / knee * difference
    } else {
        KNEE_ERROR + (difference - knee) / (largest - knee) * (1.0 - KNEE_ERROR)
    }
}

/// One channel of a picture.
struct Plane {
    width: usize,
    values: Vec<f64>,
}

impl Plane {
    /// Blurs the plane by a contrast sensitivity. Each of its Gaussians is a product of one in x and one in y.
    fn seen(&self, sensitivity: &[(f64, f64)], pixels_per_degree: f64) -> Vec<f64> {
        let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i64;
        let mut sum = vec![0.0; self.values.len()];
        let mut total = 0.0;
        for &(a, b) in sensitivity {
            let kernel: Vec<f64> = (-radius..=radius)
                .map(|i| math::exp(-PI * PI * (i * i) as f64 / (pixels_per_degree * pixels_per_degree * b)))
                .collect();
            let (weight, area) = (a * (PI / b).sqrt(), kernel.iter().sum::<f64>());
            total += weight * area * area;
            for (sum, value) in sum.iter_mut().zip(self.convolved(&kernel, &kernel)) {
                *sum += weight * value;
            }
        }
        sum.iter_mut().for_each(|value| *value /= total);
        sum
    }

    /// Computes the magnitudes of the first derivative (edges) and of the second (points) of the plane under a Gaussian.
    fn features(&self, pixels_per_degree: f64) -> [Vec<f64>; 2] {
        let sd = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * sd).ceil() as i64;
        let gaussian = |x: f64| math::exp(-x * x / (2.0 * sd * sd));
        let kernel = |weight: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (-radius..=radius).map(|i| weight(i as f64) * gaussian(i as f64)).collect()
        };
        let smooth = normalized(kernel(&|_| 1.0));
        let edge = normalized(kernel(&|x| -x));
        let point = normalized(kernel(&|x| x * x / (sd * sd) - 1.0));
        [edge, point].map(|derivative| {
            let (x, y) = (self.convolved(&derivative, &smooth), self.convolved(&smooth, &derivative));
            x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        })
    }

    /// Filters the plane along x, then along y. Beyond the border the last pixel is repeated.
    fn convolved(&self, kernel_x: &[f64], kernel_y: &[f64]) -> Vec<f64> {
        let (width, height) = (self.width, self.values.len() / self.width);
        let clamped =
            |at: usize, tap: usize, taps: usize, size: usize| (at + tap).saturating_sub(taps / 2).min(size - 1);
        let mut rows = Vec::with_capacity(self.values.len());
        for row in self.values.chunks(width) {
            rows.extend((0..width).map(|x| {
                let taps = kernel_x.iter().enumerate();
                taps.map(|(k, weight)| weight * row[clamped(x, k, kernel_x.len(), width)]).sum::<f64>()
            }));
        }
        let mut out = vec![0.0; self.values.len()];
        for (y, out) in out.chunks_mut(width).enumerate() {
            for (k, weight) in kernel_y.iter().enumerate() {
                let from = clamped(y, k, kernel_y.len(), height) * width;
                for (out, value) in out.iter_mut().zip(&rows[from..from + width]) {
                    *out += weight * value;
                }
            }
        }
        out
    }
}

/// Scales a kernel so that its positive values add up to 1 and its negative ones, if any, to −1.
fn normalized(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|v| **v > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|v| **v < 0.0).sum::<f64>();
    kernel.into_iter().map(|v| if v > 0.0 { v / positive } else { v / negative.max(f64::MIN_POSITIVE) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(width: u32, rgb: &[[f64; 3]]) -> Displayed {
        let xyz = rgb.iter().map(|rgb| (RgbSpace::srgb().xyz_from_rgb * DVec3::from(*rgb)).to_array()).collect();
        Displayed::new(&Image::xyz(width, xyz).unwrap(), 1.0)
    }

    fn map(width: u32, test: &[[f64; 3]], reference: &[[f64; 3]]) -> Vec<f64> {
        flip_map(&shown(width, test), &shown(width, reference), FLIP_PIXELS_PER_DEGREE).plane(0).collect()
    }

    #[test]
    fn the_ends_of_the_range() {
        let (green, blue) = (vec![[0.0, 1.0, 0.0]; 600], vec![[0.0, 0.0, 1.0]; 600]);
        assert!(map(30, &green, &green).iter().all(|&e| e == 0.0));
        // Uniform pictures have no features: FLIP is the redistributed colour difference, here the largest.
        assert!(map(30, &green, &blue).iter().all(|&e| (e - 1.0).abs() < 1e-9));
    }

    /// Black against white: HyAB is 100, without features.
    #[test]
    fn a_uniform_difference_by_hand() {
        let error = map(20, &[[0.0; 3]; 400], &[[1.0; 3]; 400]);
        let expected = redistributed(math::pow(100.0, 0.7), largest_difference());
        assert!(error.iter().all(|e| (e - expected).abs() < 1e-9), "{} {expected}", error[0]);
    }

    #[test]
    fn a_pixel_counts_for_more_than_its_color() {
        let mut test = vec![[0.5; 3]; 41 * 41];
        let reference = test.clone();
        test[20 * 41 + 20] = [1.0; 3];
        let error = map(41, &test, &reference);
        let worst = error.iter().copied().fold(0.0, f64::max);
        assert_eq!(worst, error[20 * 41 + 20]);
        // Alike in x and y, and nothing far away.
        assert!((error[20 * 41 + 23] - error[23 * 41 + 20]).abs() < 1e-12);
        assert_eq!(error[0], 0.0);
        assert!(worst > 0.1 && worst < 1.0, "{worst}");
    }
}
