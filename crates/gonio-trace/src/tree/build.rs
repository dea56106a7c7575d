//! From triangles to the tree.

use super::packet::{self, Packet};
use super::{LEAF, Node, Tree};
use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// Children per node.
const WIDTH: usize = 8;

impl Tree {
    /// `corners`: of each triangle; all finite.
    pub fn new(corners: &[[Vec3; 3]]) -> Self {
        if corners.is_empty() {
            return Tree::default();
        }
        let boxes: Vec<Aabb> = corners
            .iter()
            .map(|&[a, b, c]| Aabb { min: Vec3A::from(a.min(b).min(c)), max: Vec3A::from(a.max(b).max(c)) })
            .collect();
        let indices = (0..corners.len() as u32).collect();
        let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::Low,
            &boxes,
            indices,
            SortPrecision::U64,
            1,
        );
        // A packet costs little more with eight triangles than with one, so leaves are filled.
        collapse(&mut bvh, packet::SIZE as u32, 10.0);
        let mut tree = Tree { nodes: Vec::with_capacity(bvh.nodes.len() / 4 + 1), ..Tree::default() };
        tree.add_nodes(&bvh, corners);
        tree
    }

    /// Adds the nodes of `bvh`, without recursion: a tree of equal boxes may be deep.
    fn add_nodes(&mut self, bvh: &Bvh2, corners: &[[Vec3; 3]]) {
        // A node to fill, and the nodes of `bvh` below it.
        let mut todo = vec![(0, first_children(bvh))];
        self.nodes.push(Node::EMPTY);
        while let Some((index, mut children)) = todo.pop() {
            while children.len() < WIDTH {
                let largest = children
                    .iter()
                    .enumerate()
                    .filter(|(_, child)| !child.is_leaf())
                    .max_by(|(_, a), (_, b)| a.aabb().half_area().total_cmp(&b.aabb().half_area()))
                    .map(|(i, _)| i);
                let Some(largest) = largest else { break };
                let first = children.swap_remove(largest).first_index as usize;
                children.extend([bvh.nodes[first], bvh.nodes[first + 1]]);
            }
            for (lane, child) in children.iter().enumerate() {
                let aabb = child.aabb();
                for axis in 0..3 {
                    self.nodes[index].bounds[axis][0][lane] = aabb.min[axis];
                    self.nodes[index].bounds[axis][1][lane] = aabb.max[axis];
                }
                let first = child.first_index as usize;
                if child.is_leaf() {
                    let triangles = &bvh.primitive_indices[first..first + child.prim_count as usize];
                    self.nodes[index].children[lane] = LEAF | self.packets.len() as u32;
                    self.packets.push(Packet::new(triangles, corners));
                } else {
                    let inner = self.nodes.len();
                    self.nodes[index].children[lane] = inner as u32;
                    self.nodes.push(Node::EMPTY);
                    todo.push((inner, vec![bvh.nodes[first], bvh.nodes[first + 1]]));
                }
            }
        }
    }
}

/// The nodes below the root; the root itself where it is a leaf.
fn first_children(bvh: &Bvh2) -> Vec<Bvh2Node> {
    let root = bvh.nodes[0];
    if root.is_leaf() {
        vec![root]
    } else {
        let first = root.first_index as usize;
        vec![bvh.nodes[first], bvh.nodes[first + 1]]
    }
}
