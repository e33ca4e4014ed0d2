//! The binary tree between the builder's halves, and the plans of its collapse.

use super::super::Aabb;
use super::node::WIDTH;

/// One primitive while the tree is built.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    pub bounds: Aabb,
    /// Number of the primitive: triangles in their order, then analytic primitives.
    pub key: u32,
    pub analytic: bool,
}

impl Item {
    /// Twice the centre on an axis; finite bounds may overflow to infinity, which only costs quality.
    pub fn place(&self, axis: usize) -> f32 {
        self.bounds.min[axis] + self.bounds.max[axis]
    }
}

/// A binary subtree over a range of the items, with the plan of its collapse.
#[derive(Debug)]
pub(super) struct Subtree {
    pub bounds: Aabb,
    pub first: usize,
    pub count: usize,
    pub plan: Plan,
    pub children: Option<Box<[Subtree; 2]>>,
}

/// Cost of testing a node's eight boxes, of a packet's eight triangles, and of one analytic primitive.
const NODE_COST: f32 = 1.0;
const PACKET_COST: f32 = 1.0;
const ANALYTIC_COST: f32 = 1.0;

/// How to represent a binary subtree at least cost by at most 1, 2, … 8 children of a wide node above it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    /// `cost[i]`: expected cost with at most i < 8 children; index 0 is unused.
    cost: [f32; WIDTH],
    /// `left_share[i]`: how many of i children go to the left half; 0: use i − 1 children (or, for i = 1, stop here).
    pub left_share: [u8; WIDTH + 1],
    /// Whether the one child is a leaf.
    pub leaf: bool,
    pub only_triangles: bool,
}

impl Plan {
    /// The plan of a binary leaf: one packet, or one analytic primitive.
    pub fn leaf(bounds: &Aabb, analytic: bool) -> Self {
        let cost = bounds.half_area() * if analytic { ANALYTIC_COST } else { PACKET_COST };
        Self { cost: [cost; WIDTH], left_share: [0; WIDTH + 1], leaf: true, only_triangles: !analytic }
    }

    /// The plan of an inner binary node from those of its halves; `packable` if its triangles fit one packet.
    /// Costs that are not finite lead to some valid plan.
    pub fn inner(bounds: &Aabb, left: &Self, right: &Self, packable: bool, only_triangles: bool) -> Self {
        let mut plan =
            Self { cost: [f32::INFINITY; WIDTH], left_share: [0; WIDTH + 1], leaf: packable, only_triangles };
        let distribute = |children: usize| {
            let mut best = (f32::INFINITY, children as u8 / 2);
            for share in 1..children {
                let cost = left.cost[share] + right.cost[children - share];
                if cost < best.0 {
                    best = (cost, share as u8);
                }
            }
            best
        };
        let (below, share) = distribute(WIDTH);
        plan.left_share[WIDTH] = share;
        let inner_cost = bounds.half_area() * NODE_COST + below;
        plan.cost[1] = inner_cost;
        if packable {
            let packet_cost = bounds.half_area() * PACKET_COST;
            plan.leaf = packet_cost <= inner_cost;
            plan.cost[1] = inner_cost.min(packet_cost);
        }
        for children in 2..WIDTH {
            let (cost, share) = distribute(children);
            let fewer = plan.cost[children - 1];
            plan.cost[children] = fewer.min(cost);
            plan.left_share[children] = if cost < fewer { share } else { 0 };
        }
        plan
    }
}
