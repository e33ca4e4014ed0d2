//! The builder's first half: a binary tree by the binned surface-area heuristic \[Wald2007\], in parallel. Every choice
//! depends on exact minima, maxima and counts alone, so the tree is the same for any number of threads.

use super::super::Aabb;
use super::tree::{Item, Plan, Subtree};
use rayon::prelude::*;

/// Bins per axis.
const BINS: usize = 16;
/// Triangles that are not worth splitting further; the second half joins them to packets.
const SMALL: usize = 4;
/// Ranges longer than this are built by two tasks.
const PARALLEL: usize = 4096;
/// Binning of ranges longer than this is itself cut in pieces of this length.
const BINNING_PIECE: usize = 32_768;
/// Levels of the binary tree. Where a subtree is about to need more, ranges are halved instead.
pub(super) const MAX_DEPTH: u32 = 64;

/// Builds the tree over items that are reordered into its leaves' order. `first` is the index of `items[0]` in the whole.
pub(super) fn build(items: &mut [Item], first: usize, depth: u32) -> Subtree {
    let count = items.len();
    if count <= 1 || (count <= SMALL && !items.iter().any(|item| item.analytic)) {
        let bounds = items.iter().fold(Aabb::EMPTY, |bounds, item| bounds.union(item.bounds));
        let plan = Plan::leaf(&bounds, items.iter().any(|item| item.analytic));
        return Subtree { bounds, first, count, plan, children: None };
    }
    let middle = split(items, depth);
    let (left, right) = items.split_at_mut(middle);
    let only_triangles = |tree: &Subtree| tree.plan.only_triangles;
    let children = if count > PARALLEL {
        let (a, b) = rayon::join(|| build(left, first, depth + 1), || build(right, first + middle, depth + 1));
        [a, b]
    } else {
        [build(left, first, depth + 1), build(right, first + middle, depth + 1)]
    };
    let bounds = children[0].bounds.union(children[1].bounds);
    let packable = count <= super::node::PACKET && children.iter().all(only_triangles);
    let only_triangles = children.iter().all(only_triangles);
    let plan = Plan::inner(&bounds, &children[0].plan, &children[1].plan, packable, only_triangles);
    Subtree { bounds, first, count, plan, children: Some(Box::new(children)) }
}

/// Reorders the items into two non-empty parts and gives the length of the first.
fn split(items: &mut [Item], depth: u32) -> usize {
    let levels_needed = usize::BITS - (items.len() - 1).leading_zeros();
    if depth + levels_needed < MAX_DEPTH
        && let Some(cut) = best_cut(items)
    {
        let middle = partition(items, |item| cut.grid.bin(cut.axis, item) <= cut.last_left);
        if middle > 0 && middle < items.len() {
            return middle;
        }
    }
    halve(items)
}

/// Puts the lower half of the centres along the longest axis first; equal centres are told apart by their key.
fn halve(items: &mut [Item]) -> usize {
    let centers = center_bounds(items);
    let size = centers.max - centers.min;
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| a.place(axis).total_cmp(&b.place(axis)).then(a.key.cmp(&b.key)));
    middle
}

/// Moves the items that pass to the front; gives their number.
fn partition(items: &mut [Item], pass: impl Fn(&Item) -> bool) -> usize {
    let (mut low, mut high) = (0, items.len());
    while low < high {
        if pass(&items[low]) {
            low += 1;
        } else {
            high -= 1;
            items.swap(low, high);
        }
    }
    low
}

/// The bounds of the doubled centres.
fn center_bounds(items: &[Item]) -> Aabb {
    let of = |items: &[Item]| {
        items.iter().fold(Aabb::EMPTY, |bounds, item| bounds.with_point(item.bounds.min + item.bounds.max))
    };
    if items.len() <= BINNING_PIECE {
        return of(items);
    }
    items.par_chunks(BINNING_PIECE).map(of).reduce(|| Aabb::EMPTY, Aabb::union)
}

/// Equal bins over the doubled centres.
#[derive(Debug, Clone, Copy)]
struct Grid {
    low: glam::Vec3,
    bins_per_length: glam::Vec3,
}

impl Grid {
    fn new(centers: &Aabb) -> Self {
        Self { low: centers.min, bins_per_length: BINS as f32 / (centers.max - centers.min) }
    }

    /// The bin of an item; NaN (an axis without extent) goes to the first.
    #[inline(always)]
    fn bin(&self, axis: usize, item: &Item) -> usize {
        (((item.place(axis) - self.low[axis]) * self.bins_per_length[axis]) as usize).min(BINS - 1)
    }
}

/// Bounds and number of the items in each bin of each axis.
#[derive(Debug, Clone)]
struct Histogram {
    bounds: [[Aabb; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Histogram {
    const EMPTY: Self = Self { bounds: [[Aabb::EMPTY; BINS]; 3], counts: [[0; BINS]; 3] };

    fn of(items: &[Item], grid: &Grid) -> Self {
        let mut histogram = Self::EMPTY;
        for item in items {
            for axis in 0..3 {
                let bin = grid.bin(axis, item);
                let bounds = &mut histogram.bounds[axis][bin];
                *bounds = bounds.union(item.bounds);
                histogram.counts[axis][bin] += 1;
            }
        }
        histogram
    }

    fn join(mut self, other: Self) -> Self {
        for axis in 0..3 {
            for bin in 0..BINS {
                let bounds = &mut self.bounds[axis][bin];
                *bounds = bounds.union(other.bounds[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }
}

/// Where to cut: bins up to `last_left` go left.
struct Cut {
    grid: Grid,
    axis: usize,
    last_left: usize,
}

/// The cut of least expected cost, area × count summed over both sides; `None` if no bin boundary separates anything.
fn best_cut(items: &[Item]) -> Option<Cut> {
    let grid = Grid::new(&center_bounds(items));
    let histogram = if items.len() <= BINNING_PIECE {
        Histogram::of(items, &grid)
    } else {
        let pieces = items.par_chunks(BINNING_PIECE).map(|piece| Histogram::of(piece, &grid));
        pieces.reduce(|| Histogram::EMPTY, Histogram::join)
    };
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in 0..3 {
        if let Some((cost, last_left)) = best_cut_on(&histogram.bounds[axis], &histogram.counts[axis])
            && cost < least
        {
            least = cost;
            best = Some(Cut { grid, axis, last_left });
        }
    }
    best
}

/// The best cut on one axis: its cost and the last bin on the left.
fn best_cut_on(bounds: &[Aabb; BINS], counts: &[u32; BINS]) -> Option<(f32, usize)> {
    let mut right_cost = [0.0; BINS];
    let (mut right, mut number) = (Aabb::EMPTY, 0);
    for bin in (1..BINS).rev() {
        right = right.union(bounds[bin]);
        number += counts[bin];
        right_cost[bin] = right.half_area() * number as f32;
    }
    let all = number + counts[0];
    let mut best: Option<(f32, usize)> = None;
    let (mut left, mut number) = (Aabb::EMPTY, 0);
    for bin in 0..BINS - 1 {
        left = left.union(bounds[bin]);
        number += counts[bin];
        if number == 0 || number == all {
            continue;
        }
        let cost = left.half_area() * number as f32 + right_cost[bin + 1];
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, bin));
        }
    }
    best
}
