//! The builder's second half: the binary tree becomes one of eight children a node, at the least expected cost, found
//! exactly by dynamic programming \[Ylitie2017\].

use super::super::Aabb;
use super::build::{Item, Subtree};
use super::node::{Node, Packet, Reference, WIDTH};
use glam::Vec3;

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
    left_share: [u8; WIDTH + 1],
    /// Whether the one child is a leaf.
    leaf: bool,
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

/// The finished tree's parts.
#[derive(Debug)]
pub(super) struct Emitter<'a> {
    pub nodes: Vec<Node>,
    pub packets: Vec<Packet>,
    items: &'a [Item],
    positions: &'a [Vec3],
    triangles: &'a [[u32; 3]],
}

impl<'a> Emitter<'a> {
    pub fn new(items: &'a [Item], positions: &'a [Vec3], triangles: &'a [[u32; 3]]) -> Self {
        Self { nodes: Vec::new(), packets: Vec::new(), items, positions, triangles }
    }

    /// Appends a subtree; gives its reference and how many entries its traversal can have on the stack at once.
    pub fn emit(&mut self, tree: &Subtree) -> (Reference, usize) {
        if tree.plan.leaf {
            return (self.emit_leaf(tree), 0);
        }
        let place = self.nodes.len();
        self.nodes.push(Node::new(&[]));
        let mut roots = Vec::with_capacity(WIDTH);
        collect(tree, WIDTH, true, &mut roots);
        let mut deepest = 0;
        let mut children = Vec::with_capacity(WIDTH);
        for root in &roots {
            let (reference, entries) = self.emit(root);
            children.push((root.bounds, reference));
            deepest = deepest.max(entries);
        }
        self.nodes[place] = Node::new(&children);
        (Reference::node(place), deepest + children.len() - 1)
    }

    fn emit_leaf(&mut self, tree: &Subtree) -> Reference {
        let items = &self.items[tree.first..tree.first + tree.count];
        if let [item] = items
            && item.analytic
        {
            return Reference::analytic(item.key - self.triangles.len() as u32);
        }
        let corners = |key: u32| self.triangles[key as usize].map(|vertex| self.positions[vertex as usize]);
        let triangles: Vec<_> = items.iter().map(|item| (item.key, corners(item.key))).collect();
        self.packets.push(Packet::new(&triangles));
        Reference::packet(self.packets.len() - 1)
    }
}

/// The subtrees that become a wide node's children. `open`: the subtree itself is the node, so it has to be split.
fn collect<'t>(tree: &'t Subtree, children: usize, open: bool, roots: &mut Vec<&'t Subtree>) {
    let share = usize::from(tree.plan.left_share[children]);
    match &tree.children {
        Some(halves) if open || (share > 0 && children < WIDTH) => {
            collect(&halves[0], share, false, roots);
            collect(&halves[1], children - share, false, roots);
        }
        Some(_) if children > 1 => collect(tree, children - 1, false, roots),
        _ => roots.push(tree),
    }
}
