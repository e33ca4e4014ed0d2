//! The builder's second half: the binary tree becomes one of eight children a node, at the least expected cost, found
//! exactly by dynamic programming \[Ylitie2017\].

use super::node::{Node, Packet, Reference, WIDTH};
use super::tree::{Item, Subtree};
use glam::Vec3;

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
