//! The light pass: traces some light paths. Threads work on blocks, whose splats reach the film in their order.

use super::blocks::{BLOCK, blocks_of, replicate_of};
use super::job::Job;
use super::streams::{Stream, render_seed};
use super::threads::in_parallel;
use crate::bsdf::Branching;
use crate::film::{Film, LIGHT_REPLICATES, Splats};
use crate::render::paths::{Counters, Place, Workspace};
use crate::render::techniques::{LightTracer, Splatter, Techniques};
use std::ops::Range;

/// Blocks that are traced before their splats go to the film, in order.
const BLOCKS_AT_ONCE: usize = 256;

/// Traces some light paths. Splats reach the film in their order.
pub fn light_pass<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    film: &mut Film,
    paths: Range<u64>,
    weight: f64,
) -> Counters {
    let mut counters = Counters::default();
    let Some(tracer) = light_tracer(job, job.plan.light) else { return counters };
    for blocks in blocks_of(paths).chunks(BLOCKS_AT_ONCE) {
        let (results, count) =
            in_parallel(job.scene, blocks, |workspace, block| light_block(job, &tracer, workspace, block.clone()));
        for (block, splats) in blocks.iter().zip(results) {
            film.add_splats(replicate_of(block), block.end - block.start, weight, &splats);
        }
        counters.add(count);
    }
    counters
}

/// Traces the light paths of one block: replicates have blocks in turns, each with a sequence of its own.
fn light_block<const INTERIORS: bool>(
    job: &Job<INTERIORS>,
    tracer: &LightTracer,
    workspace: &mut Workspace,
    paths: Range<u64>,
) -> Splats {
    let stream = Stream::Light { replicate: replicate_of(&paths) as u8 };
    let sobol = stream.sequence(render_seed(job.settings.seed));
    let mut splatter = Splatter::new(&job.film.sensor, &job.film.filter, &job.plan.techniques);
    let before = paths.start / BLOCK / LIGHT_REPLICATES as u64 * BLOCK;
    for path in paths {
        let place = Place { sobol, index: before + path % BLOCK };
        tracer.trace::<INTERIORS>(workspace, place, None, &mut splatter);
    }
    splatter.splats
}

/// Makes the tracer of the light paths that the plan asks for, which branch in a given way; `None` if it asks for none.
pub fn light_tracer<'j, const INTERIORS: bool>(
    job: &'j Job<INTERIORS>,
    branching: Branching,
) -> Option<LightTracer<'j>> {
    let techniques = &job.plan.techniques;
    let (guide, caustics_only) = (techniques.guide()?, !matches!(techniques, Techniques::Light { .. }));
    Some(LightTracer { scene: job.scene, guide, caustics_only, branching, max_depth: job.settings.max_depth })
}
