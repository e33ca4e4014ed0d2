//! One camera path: from its random numbers and its pixel to the radiance that it finds.

use super::job::Job;
use super::streams::Stream;
use super::tiles::square;
use crate::bsdf::{Branching, Carried, Parting};
use crate::film::CAMERA_REPLICATES;
use crate::render::paths::{Place, TransportMode, Walk, Workspace};
use crate::render::techniques::{CameraNumbers, baseline, radiance};
use crate::scene::FilmSettings;
use crate::spectrum::{SampledSpectrum, Wavelengths};

/// Where a camera path starts.
pub struct CameraStart {
    /// Column and row of its pixel.
    pub pixel: [i32; 2],
    /// Offset of its point on the film from the corner of the pixel.
    pub offset: [f32; 2],
    /// The wavelengths of its lanes.
    pub wavelengths: Wavelengths,
    /// The random numbers of its start.
    pub numbers: CameraNumbers,
}

/// What a camera path has found.
pub struct CameraSample {
    /// Offset of its point on the film from the corner of its pixel; `None` if it counts in that pixel alone.
    pub offset: Option<[f32; 2]>,
    /// Number of its replicate.
    pub replicate: usize,
    /// The wavelengths of its lanes.
    pub wavelengths: Wavelengths,
    /// The radiance that it has found at each of them.
    pub radiance: SampledSpectrum,
}

/// Traces one camera path of the sequences of a seed, in the square of a pixel of the film or just beyond.
pub fn camera_sample<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    workspace: &mut Workspace,
    pixel: [i32; 2],
    sample: u64,
    seed: u64,
    branching: Branching,
) -> CameraSample {
    let replicate = (sample % CAMERA_REPLICATES as u64) as usize;
    let index = sample / CAMERA_REPLICATES as u64;
    let stream = Stream::Camera { square: square(job.film, pixel), replicate: replicate as u8 };
    let place = Place { sobol: stream.sequence(seed), index };
    let numbers = CameraNumbers::of(place);
    let baseline = branching.parting == Parting::Terminate;
    let wavelengths = if baseline {
        baseline::wavelengths(numbers.wavelengths)
    } else {
        job.scene.wavelengths.sample(numbers.wavelengths)
    };
    let offset = if baseline { offset_by_filter(job.film, numbers.film) } else { numbers.film };
    let start = CameraStart { pixel, offset, wavelengths, numbers };
    let mut walk = camera_walk(job, workspace, start, branching, place);
    if baseline {
        (walk.carried.hero, walk.carried.throughput) = (0, baseline::throughput());
    }
    let radiance = radiance::<INTERIORS>(&mut walk, &job.plan.techniques, job.settings.max_depth);
    CameraSample { offset: (!baseline).then_some(offset), replicate, wavelengths, radiance }
}

/// Draws an offset from the corner of a pixel by the filter.
pub fn offset_by_filter(film: &FilmSettings, u: [f32; 2]) -> [f32; 2] {
    film.filter.sample(u).map(|d| 0.5 + d)
}

/// Starts a camera path.
pub fn camera_walk<'a: 'w, 'w, const INTERIORS: bool>(
    job: &Job<'a, INTERIORS>,
    workspace: &'w mut Workspace,
    CameraStart { pixel: [x, y], offset, wavelengths, numbers }: CameraStart,
    branching: Branching,
    place: Place,
) -> Walk<'w> {
    let ray = job.scene.camera.ray([x as f32 + offset[0], y as f32 + offset[1]], numbers.lens);
    workspace.spectra.begin(wavelengths);
    if INTERIORS {
        match &job.camera_interiors {
            Some(interiors) => workspace.interiors.reset(interiors),
            None => workspace.interiors.reset(&job.scene.interiors_at(ray.origin)),
        }
    }
    let carried = Carried::new(numbers.hero, branching);
    Walk::start(job.scene, workspace, ray, TransportMode::Radiance, carried, place)
}
