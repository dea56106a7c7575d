//! Merges equal corners into one vertex.

use std::collections::HashMap;

const NONE: u32 = u32::MAX;

/// Most vertices at one position that are searched linearly.
const MOST_IN_A_CHAIN: usize = 16;

/// The vertices made so far, each from the index of a position and `N` other indices.
pub(crate) struct Joiner<const N: usize> {
    /// For each position its latest vertex.
    first: Vec<u32>,
    /// For each vertex the previous one at the same position.
    next: Vec<u32>,
    /// For each vertex the other indices.
    made_of: Vec<[u32; N]>,
    /// Vertices of positions with many of them.
    crowded: HashMap<(u32, [u32; N]), u32>,
}

impl<const N: usize> Joiner<N> {
    /// Creates a table for indices below `positions`.
    pub(crate) fn new(positions: usize) -> Self {
        Joiner { first: vec![NONE; positions], next: Vec::new(), made_of: Vec::new(), crowded: HashMap::new() }
    }

    /// Returns the vertex of a corner and whether it is new. Vertices are numbered from 0 in the order of first use.
    #[inline]
    pub(crate) fn vertex(&mut self, position: u32, rest: [u32; N]) -> (u32, bool) {
        let first = self.first[position as usize];
        let mut vertex = first;
        let mut steps = 0;
        while vertex != NONE && steps < MOST_IN_A_CHAIN {
            if self.made_of[vertex as usize] == rest {
                return (vertex, false);
            }
            vertex = self.next[vertex as usize];
            steps += 1;
        }
        let made = self.made_of.len() as u32;
        if steps == MOST_IN_A_CHAIN {
            if let Some(&vertex) = self.crowded.get(&(position, rest)) {
                return (vertex, false);
            }
            self.crowded.insert((position, rest), made);
            self.next.push(NONE);
        } else {
            self.first[position as usize] = made;
            self.next.push(first);
        }
        self.made_of.push(rest);
        (made, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_corners_are_one_vertex() {
        let mut joiner = Joiner::new(2);
        let corners = [(0, [5]), (1, [5]), (0, [6]), (0, [5]), (1, [5])];
        let vertices = corners.map(|(position, rest)| joiner.vertex(position, rest));
        assert_eq!(vertices, [(0, true), (1, true), (2, true), (0, false), (1, false)]);
    }

    /// Far more vertices at one position than are searched linearly.
    #[test]
    fn crowded_positions_are_looked_up() {
        let mut joiner = Joiner::new(1);
        for round in 0..2 {
            for rest in 0..1000 {
                assert_eq!(joiner.vertex(0, [rest, 7]), (rest, round == 0));
            }
        }
    }
}
