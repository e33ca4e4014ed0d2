//! Work that is spread over threads, each of which has a workspace of its own.

use crate::render::paths::{Counters, Workspace};
use crate::scene::Scene;
use rayon::prelude::*;

/// Does pieces of work in parallel. Returns what each of them gives, in their order whatever the number of threads, and what
/// has been counted meanwhile.
pub fn in_parallel<Piece: Send, Result: Send>(
    scene: &Scene,
    pieces: impl IntoParallelIterator<Item = Piece>,
    work: impl Fn(&mut Workspace, Piece) -> Result + Sync,
) -> (Vec<Result>, Counters) {
    let counted = |workspace: &mut Workspace, piece| {
        workspace.counters = Counters::default();
        let result = work(workspace, piece);
        (result, workspace.counters)
    };
    let done: Vec<_> = pieces.into_par_iter().map_init(|| Workspace::new(scene), counted).collect();
    let mut counters = Counters::default();
    done.iter().for_each(|(_, count)| counters.add(*count));
    (done.into_iter().map(|(result, _)| result).collect(), counters)
}
