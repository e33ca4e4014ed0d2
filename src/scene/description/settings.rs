//! Settings of rendering and developing.

use super::codec::{Choice, Integer, NumberOr, Object, Range, Record};
use crate::Result;
use crate::develop::{TONEMAPS, Tonemap};
use crate::scene::Integrator;

/// Most samples of a pixel.
const MAX_SAMPLES: i64 = 1 << 40;

/// Largest seed: every integer up to it is a number of JSON's.
const MAX_SEED: i64 = 1 << 53;

/// Exposures that are allowed, stops.
pub(crate) const EXPOSURES_EV: (f64, f64) = (-200.0, 200.0);

/// Sampling options.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderDescription {
    /// Camera paths per pixel.
    pub samples_per_pixel: u64,
    /// Largest number of scattering events on a path.
    pub max_depth: u32,
    /// Seed of every random sequence.
    pub seed: u64,
    /// Light transport technique.
    pub integrator: Integrator,
}

/// How the film is developed for PNG.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DevelopDescription {
    /// Exposure in stops; `None` is automatic.
    pub exposure_ev: Option<f64>,
    /// Tone mapping operator.
    pub tonemap: Tonemap,
}

/// Light transport techniques, by the names that scenes and the command line give them.
#[rustfmt::skip] // one technique a line
pub const INTEGRATORS: &[(&str, Integrator, &str)] = &[
    ("auto", Integrator::Auto, "Each class of paths by the technique that suits it."),
    ("path", Integrator::Path, "Camera paths with next-event estimation."),
    ("light", Integrator::Light, "Light paths, splatted onto the film."),
    ("merge", Integrator::Merge, "Photon merging."),
    ("hero", Integrator::Hero, "The baseline: 4 wavelengths, one kept after any dispersive hit."),
];

/// Sampling options.
pub const RENDER: Record<RenderDescription> = Record { what: "render", doc: "Sampling and integrator.", read: render };

/// Developing options.
pub const DEVELOP: Record<DevelopDescription> =
    Record { what: "develop", doc: "How the film becomes a PNG.", read: develop };

fn render(o: &mut Object) -> Result<RenderDescription> {
    let samples = Integer { min: 1, max: MAX_SAMPLES };
    let depth = Integer { min: 0, max: 10_000_000 };
    let depth_doc = "Largest number of scattering events on a path: 0 is emitted light only, 1 direct light; each \
                     refraction counts.";
    let integrator = Choice { what: "an integrator", names: INTEGRATORS };
    let render = RenderDescription {
        samples_per_pixel: o.default("samples_per_pixel", samples, "64", "Camera paths per pixel.")? as u64,
        max_depth: o.default("max_depth", depth, "64", depth_doc)? as u32,
        seed: o.default("seed", Integer { min: 0, max: MAX_SEED }, "0", "Seed of every random sequence.")? as u64,
        integrator: o.default("integrator", integrator, "\"auto\"", "Light transport technique.")?,
    };
    o.name()?;
    Ok(render)
}

fn develop(o: &mut Object) -> Result<DevelopDescription> {
    let exposure = NumberOr {
        range: Range::from_to(EXPOSURES_EV.0, EXPOSURES_EV.1),
        from_number: Some,
        other: Choice { what: "an exposure", names: &[("auto", None, "From the picture.")] },
    };
    let tonemap = Choice { what: "a tone mapping operator", names: TONEMAPS };
    let develop = DevelopDescription {
        exposure_ev: o.default("exposure_ev", exposure, "\"auto\"", "Exposure in stops, or \"auto\".")?,
        tonemap: o.default("tonemap", tonemap, "\"srgb\"", "Tone mapping operator.")?,
    };
    o.name()?;
    Ok(develop)
}
