//! The bounding volume hierarchy: a tree of eight boxes a node over triangles and over primitives known only by a box
//! and a closure.
//!
//! Built by the binned surface-area heuristic, collapsed to eight children at least cost, traversed eight boxes or eight
//! triangles at a time \[Wald2008\], \[Ylitie2017\]. Nothing leaks: triangles are tested watertight \[Woop2013\], boxes
//! conservatively \[Ize2013\]. Nothing depends on the number of threads, on the instruction set or on the order in which
//! nodes are visited: of hits at equal distance the primitive that comes first wins.

mod build;
mod collapse;
mod node;
#[cfg(test)]
mod tests;
mod tree;

use super::triangle::double_area_vector;
use super::{Aabb, Ray};
use glam::Vec3;
use node::{Node, PACKET, Packet, RayLanes, Reference, Target, WIDTH};
use tree::Item;
use wide::{f32x8, i32x8};

/// Boxes grow by this share of the largest coordinate: the rounding of a vertex relative to a ray's origin (12u), so
/// that a ray that the rounded triangle takes is not lost at its box. Holds for origins up to twice as far out.
const BOX_GROWTH: f32 = 16.0 * 0.5 * f32::EPSILON;

/// Boxes and stack entries up to this factor beyond the nearest hit are still visited, so that rounding does not decide
/// between hits at equal distance.
const TIE_SLACK: f32 = 1.0 + 8.0 * f32::EPSILON;

/// Stack sizes: each ray clears its stack, so small trees get small ones. The last holds any tree: at most 7 entries for
/// each level of [`build::MAX_DEPTH`], and the one that is about to be visited.
const SMALL_STACK: usize = 16;
const MEDIUM_STACK: usize = 64;
const LARGE_STACK: usize = (WIDTH - 1) * build::MAX_DEPTH as usize + 1;

/// A bounding volume hierarchy. Its nodes hold boxes of eight children.
#[derive(Debug, Clone)]
pub struct Bvh {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    root: Reference,
    bounds: Aabb,
    /// Most entries that a traversal can have on its stack.
    stack_entries: usize,
    triangle_count: u32,
}

/// Index of a triangle in the array given to [`Bvh::build`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TriangleId(pub u32);

/// Index of an analytic primitive in the array of boxes given to [`Bvh::build`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AnalyticId(pub u32);

/// What was hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Primitive {
    /// A triangle.
    Triangle(TriangleId),
    /// An analytic primitive.
    Analytic(AnalyticId),
}

/// The nearest hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BvhHit {
    /// What was hit.
    pub primitive: Primitive,
    /// Distance, in units of the ray's direction.
    pub t: f32,
}

/// What a traversal collects. Keys number the triangles, then the analytic primitives.
trait Hits {
    /// Whether one hit is enough: boxes are then visited in the order of the node, not from near to far.
    const ANY: bool;

    /// Distance at which hits on triangles cease to matter.
    fn t_max(&self) -> f32;

    /// Distance at which hits on analytic primitives cease to matter.
    fn analytic_t_max(&self) -> f32;

    /// Takes a hit.
    fn offer(&mut self, t: f32, key: u32);

    /// Distance up to which boxes are still to be visited, if the hits so far limit it.
    fn limit(&self) -> Option<f32>;
}

/// The best hit so far.
struct Nearest<const ANY: bool> {
    t: f32,
    key: Option<u32>,
}

impl<const ANY: bool> Hits for Nearest<ANY> {
    const ANY: bool = ANY;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.t
    }

    /// A hit as near as the best so far may still come first in order.
    #[inline(always)]
    fn analytic_t_max(&self) -> f32 {
        if self.key.is_some() { self.t.next_up() } else { self.t }
    }

    /// Takes a hit that is nearer, or as near and earlier in order.
    #[inline(always)]
    fn offer(&mut self, t: f32, key: u32) {
        if t < self.t || (t == self.t && self.key.is_some_and(|best| key < best)) {
            self.t = t;
            self.key = Some(key);
        }
    }

    #[inline(always)]
    fn limit(&self) -> Option<f32> {
        self.key.is_some().then_some(self.t * TIE_SLACK)
    }
}

/// All hits, each handed on as it is found.
struct Each<F> {
    t_max: f32,
    found: F,
}

impl<F: FnMut(f32, u32)> Hits for Each<F> {
    const ANY: bool = false;

    fn t_max(&self) -> f32 {
        self.t_max
    }

    fn analytic_t_max(&self) -> f32 {
        self.t_max
    }

    fn offer(&mut self, t: f32, key: u32) {
        (self.found)(t, key);
    }

    fn limit(&self) -> Option<f32> {
        None
    }
}

/// A stack entry: the entry distance's bits above a reference. Distances are ≥ 0, so integers order as they do.
#[inline(always)]
fn stack_entry(t: f32, reference: Reference) -> u64 {
    u64::from(t.to_bits()) << 32 | u64::from(reference.0)
}

impl Bvh {
    /// Builds the tree over triangles (indices into `positions`, f32 coordinates of a scene of about unit size) and over
    /// the boxes of analytic primitives. Runs in rayon's current pool; the result is the same for any number of threads.
    ///
    /// Triangles without area, with an index out of range or a coordinate that is not finite, and empty boxes are left
    /// out: nothing hits them. At most 2³⁰ triangles and as many analytic primitives; what is beyond is left out as well.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]], analytic: &[Aabb]) -> Self {
        let mut items = items(positions, triangles, analytic);
        let bounds = items.iter().fold(Aabb::EMPTY, |bounds, item| bounds.union(item.bounds));
        let mut bvh = Self {
            nodes: Vec::new(),
            packets: Vec::new(),
            root: Reference::EMPTY,
            bounds,
            stack_entries: 0,
            triangle_count: triangles.len().min(Reference::MAX_INDEX) as u32,
        };
        if !items.is_empty() {
            let tree = build::build(&mut items, 0, 0);
            let mut emitter = collapse::Emitter::new(&items, positions, triangles);
            (bvh.root, bvh.stack_entries) = emitter.emit(&tree);
            (bvh.nodes, bvh.packets) = (emitter.nodes, emitter.packets);
        }
        bvh
    }

    /// The box around everything; empty if there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Heap memory of the tree with its copies of the vertices.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.packets.capacity() * size_of::<Packet>()
    }

    /// The nearest hit with 0 < t < `t_max`. Of hits at equal t the first triangle wins, or the first analytic primitive
    /// where there is no triangle.
    ///
    /// `analytic(index, t_max)` gives the nearest distance in (0, `t_max`) at which the ray meets one analytic primitive.
    #[inline]
    pub fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        analytic: impl FnMut(AnalyticId, f32) -> Option<f32>,
    ) -> Option<BvhHit> {
        let mut nearest = Nearest::<false> { t: t_max, key: None };
        self.dispatch(ray, &mut nearest, analytic)?;
        Some(BvhHit { primitive: self.primitive(nearest.key?), t: nearest.t })
    }

    /// The primitive of a key.
    #[inline]
    fn primitive(&self, key: u32) -> Primitive {
        match key.checked_sub(self.triangle_count) {
            None => Primitive::Triangle(TriangleId(key)),
            Some(index) => Primitive::Analytic(AnalyticId(index)),
        }
    }

    /// Whether anything is hit with 0 < t < `t_max`. `analytic(index, t_max)` tells it of one analytic primitive.
    #[inline]
    pub fn occluded(&self, ray: &Ray, t_max: f32, mut analytic: impl FnMut(AnalyticId, f32) -> bool) -> bool {
        let mut any = Nearest::<true> { t: t_max, key: None };
        let complete = self.dispatch(ray, &mut any, |index, t_max| analytic(index, t_max).then_some(0.0));
        complete.is_some() && any.key.is_some()
    }

    /// Calls `found` for each primitive that the ray meets with 0 < t < `t_max`, in no order; of an analytic primitive for
    /// its nearest hit.
    pub fn visit(
        &self,
        ray: &Ray,
        t_max: f32,
        analytic: impl FnMut(AnalyticId, f32) -> Option<f32>,
        mut found: impl FnMut(Primitive, f32),
    ) {
        let mut each = Each { t_max, found: |t, key| found(self.primitive(key), t) };
        // A ray without a direction meets nothing.
        let _ = self.dispatch(ray, &mut each, analytic);
    }

    #[inline]
    fn dispatch<H: Hits>(
        &self,
        ray: &Ray,
        hits: &mut H,
        analytic: impl FnMut(AnalyticId, f32) -> Option<f32>,
    ) -> Option<()> {
        if self.stack_entries < SMALL_STACK {
            self.traverse::<SMALL_STACK, H>(ray, hits, analytic)
        } else if self.stack_entries < MEDIUM_STACK {
            self.traverse::<MEDIUM_STACK, H>(ray, hits, analytic)
        } else {
            self.traverse::<LARGE_STACK, H>(ray, hits, analytic)
        }
    }

    /// The traversal: boxes from near to far, or for `ANY` in the order of the node and only up to the first hit. `None` for
    /// a ray that has no direction.
    fn traverse<const STACK: usize, H: Hits>(
        &self,
        ray: &Ray,
        collected: &mut H,
        mut analytic: impl FnMut(AnalyticId, f32) -> Option<f32>,
    ) -> Option<()> {
        let lanes = RayLanes::new(ray)?;
        let mut limit = collected.t_max();
        let mut stack = Stack::<STACK> { entries: [0; STACK], len: 0 };
        let mut current = self.root;
        loop {
            match current.target() {
                Target::Node(index) => {
                    let node = self.nodes.get(index)?;
                    let (near, hits) = node.intersect(&lanes, limit);
                    if hits != 0 {
                        current = if H::ANY {
                            stack.push_children::<true>(node, near, hits)
                        } else {
                            stack.push_children::<false>(node, near, hits)
                        };
                        continue;
                    }
                }
                Target::Packet(index) => {
                    let packet = self.packets.get(index)?;
                    let (t, doubt, mut hits) = packet.intersect(&lanes, collected.t_max());
                    let (t, doubt) = (t.to_array(), doubt.to_array());
                    while hits != 0 {
                        let lane = hits.trailing_zeros() as usize % PACKET;
                        hits &= hits - 1;
                        let distance =
                            if t[lane] > doubt[lane] { Some(t[lane]) } else { packet.exact_distance(lane, ray) };
                        if let Some(distance) = distance {
                            collected.offer(distance, packet.triangles[lane]);
                        }
                    }
                }
                Target::Analytic(index) => {
                    if let Some(t) = analytic(AnalyticId(index), collected.analytic_t_max()) {
                        collected.offer(t, self.triangle_count + index);
                    }
                }
            }
            if let Some(nearer) = collected.limit() {
                if H::ANY {
                    return Some(());
                }
                limit = nearer;
            }
            match stack.pop(limit) {
                Some(reference) => current = reference,
                None => return Some(()),
            }
        }
    }
}

/// What is still to visit.
struct Stack<const SIZE: usize> {
    entries: [u64; SIZE],
    len: usize,
}

impl<const SIZE: usize> Stack<SIZE> {
    /// The next reference no farther than `limit`.
    #[inline(always)]
    fn pop(&mut self, limit: f32) -> Option<Reference> {
        loop {
            self.len = self.len.checked_sub(1)?;
            let entry = *self.entries.get(self.len)?;
            if f32::from_bits((entry >> 32) as u32) <= limit {
                return Some(Reference(entry as u32));
            }
        }
    }

    /// Pushes all hit children but the nearest, farthest first, and gives the nearest. For `ANY`: in any order.
    #[inline(always)]
    fn push_children<const ANY: bool>(&mut self, node: &Node, near: f32x8, hits: u32) -> Reference {
        let first = hits.trailing_zeros() as usize % WIDTH;
        let count = hits.count_ones() as usize;
        // The size is chosen by the tree's depth, so there always is room.
        let (true, Some(slots)) = (count > 1, self.entries.get_mut(self.len..self.len + count)) else {
            return node.children[first];
        };
        // Every child goes straight to its place, as many from the top as are nearer: no sort, whose jumps cannot be
        // foreseen. Distances are ≥ 0, so their bits order as they do; the last three tell lanes apart.
        let order = near.to_array().map(|t| (t.to_bits() & !(WIDTH as u32 - 1)) as i32);
        let order = i32x8::new(order) | i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let (order_of, near) = (order.to_array(), near.to_array());
        let mut left = hits;
        for place in 0..count {
            let lane = left.trailing_zeros() as usize % WIDTH;
            left &= left - 1;
            let nearer = if ANY {
                place
            } else {
                (i32x8::splat(order_of[lane]).simd_gt(order).to_bitmask() & hits).count_ones() as usize
            };
            if let Some(slot) = slots.get_mut(count - 1 - nearer) {
                *slot = stack_entry(near[lane], node.children[lane]);
            }
        }
        let nearest = Reference(slots[count - 1] as u32);
        self.len += count - 1;
        nearest
    }
}

/// What the tree is built over.
fn items(positions: &[Vec3], triangles: &[[u32; 3]], analytic: &[Aabb]) -> Vec<Item> {
    let limit = Reference::MAX_INDEX;
    let mut items = Vec::with_capacity(triangles.len().min(limit) + analytic.len().min(limit));
    for (key, indices) in triangles.iter().enumerate().take(limit) {
        let [Some(&a), Some(&b), Some(&c)] = indices.map(|index| positions.get(index as usize)) else { continue };
        if a.is_finite() && b.is_finite() && c.is_finite() && double_area_vector(a, b, c) != glam::DVec3::ZERO {
            items.push(Item { bounds: Aabb::from_points([a, b, c]), key: key as u32, analytic: false });
        }
    }
    let triangle_count = triangles.len().min(limit) as u32;
    for (index, &bounds) in analytic.iter().enumerate().take(limit) {
        if bounds.min.is_finite() && bounds.max.is_finite() && bounds.min.cmple(bounds.max).all() {
            items.push(Item { bounds, key: triangle_count + index as u32, analytic: true });
        }
    }
    let largest = items.iter().map(|item| item.bounds.min.abs().max(item.bounds.max.abs()).max_element());
    let growth = largest.fold(0.0, f32::max) * BOX_GROWTH;
    for item in &mut items {
        item.bounds = item.bounds.grown(growth);
    }
    items
}
