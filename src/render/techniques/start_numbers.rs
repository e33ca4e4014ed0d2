//! The random numbers with which paths start, by what they decide: the first group of a path's sequence. Those of its
//! vertices are in the groups that follow.

use crate::render::paths::Place;
use crate::spectrum::LANES;

/// The random numbers of a camera path's start, each in [0, 1).
#[derive(Debug, Clone, Copy)]
pub struct CameraNumbers {
    /// Draws the point of the film, either in the square of a pixel or by the pixel's filter.
    pub film: [f32; 2],
    /// Draws the wavelengths.
    pub wavelengths: f32,
    /// Draws the point of the lens.
    pub lens: [f32; 2],
    /// The lane that goes on for all others where they cannot go on together.
    pub hero: usize,
}

impl CameraNumbers {
    /// Draws the numbers of the path at a place of its sequence.
    pub fn of(place: Place) -> Self {
        let u = place.sobol.group(place.index, 0);
        Self { film: [u[0], u[1]], wavelengths: u[2], lens: [u[3], u[4]], hero: lane(u[5]) }
    }
}

/// The random numbers of a light path's start, each in [0, 1). The point, the wavelengths and the direction have the first
/// dimensions, which are spread best: they make the picture of a caustic.
#[derive(Debug, Clone, Copy)]
pub struct LightNumbers {
    /// Draws the point of the light, unless the guide moves the pair first.
    pub point: [f32; 2],
    /// Draws the wavelengths.
    pub wavelengths: f32,
    /// Draws the direction in which the path leaves the light, unless the guide moves the pair first.
    pub direction: [f32; 2],
    /// Draws the light.
    pub light: f32,
    /// The lane that goes on for all others where they cannot go on together.
    pub hero: usize,
}

impl LightNumbers {
    /// Draws the numbers of the path at a place of its sequence.
    pub fn of(place: Place) -> Self {
        let u = place.sobol.group(place.index, 0);
        Self { point: [u[0], u[1]], wavelengths: u[2], direction: [u[3], u[4]], light: u[5], hero: lane(u[6]) }
    }
}

/// Draws a lane, each with the same probability.
fn lane(u: f32) -> usize {
    (u * LANES as f32) as usize
}
