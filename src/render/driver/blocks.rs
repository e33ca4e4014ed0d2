//! Blocks of light paths. A block is what one thread traces at a time; replicates have blocks in turns.

use crate::film::LIGHT_REPLICATES;
use std::ops::Range;

/// Light paths in a block.
pub const BLOCK: u64 = 512;

/// Divides light paths into blocks, of which the first and the last may be incomplete.
pub fn blocks_of(paths: Range<u64>) -> Vec<Range<u64>> {
    let blocks = paths.start / BLOCK..paths.end.div_ceil(BLOCK);
    let block = |block: u64| (block * BLOCK).max(paths.start)..((block + 1) * BLOCK).min(paths.end);
    blocks.map(block).filter(|paths| !paths.is_empty()).collect()
}

/// Returns the replicate that a block, or a part of one, belongs to.
pub fn replicate_of(block: &Range<u64>) -> usize {
    (block.start / BLOCK % LIGHT_REPLICATES as u64) as usize
}

/// Returns how many blocks hold so many light paths.
pub fn block_count(paths: u64) -> u64 {
    paths.div_ceil(BLOCK)
}

/// Returns the light paths of a block.
pub fn block(block: u64) -> Range<u64> {
    block * BLOCK..(block + 1) * BLOCK
}
