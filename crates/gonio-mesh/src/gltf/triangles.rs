//! Lists, strips and fans of triangles (glTF 2.0, section 3.7.2.1), and the vertices that they use.

use std::ops::Range;

/// The topology of a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Topology {
    List,
    Strip,
    Fan,
}

impl Topology {
    pub fn of_mode(mode: u64) -> Option<Self> {
        match mode {
            4 => Some(Topology::List),
            5 => Some(Topology::Strip),
            6 => Some(Topology::Fan),
            _ => None,
        }
    }

    /// Returns the number of triangles that `corners` make, including degenerate ones.
    pub fn triangles(self, corners: usize) -> usize {
        match self {
            Topology::List => corners / 3,
            Topology::Strip | Topology::Fan => corners.saturating_sub(2),
        }
    }
}

/// Returns three corners for each triangle, and the number of leftover corners. Degenerate triangles of strips and fans
/// only connect others and are left out.
pub(super) fn corners(list: Vec<u32>, topology: Topology) -> (Vec<u32>, usize) {
    let leftover = match topology {
        Topology::List => list.len() % 3,
        Topology::Strip | Topology::Fan if list.len() < 3 => list.len(),
        Topology::Strip | Topology::Fan => 0,
    };
    let corners = match topology {
        Topology::List => {
            let mut list = list;
            list.truncate(list.len() - leftover);
            list
        }
        // Every other triangle of a strip has the opposite winding.
        Topology::Strip => list
            .array_windows()
            .enumerate()
            .map(|(i, &[a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
            .filter(is_no_joint)
            .flatten()
            .collect(),
        Topology::Fan => match list.split_first() {
            Some((&center, rim)) => {
                rim.array_windows().map(|&[a, b]| [a, b, center]).filter(is_no_joint).flatten().collect()
            }
            None => Vec::new(),
        },
    };
    (corners, leftover)
}

fn is_no_joint([a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// The vertices of its arrays that a primitive uses: exporters let many primitives share large arrays.
pub(super) struct Used {
    /// From the first to the last used vertex.
    pub range: Range<usize>,
    /// Number of used vertices.
    pub count: usize,
    /// For each vertex of the range; empty if all are used.
    is_used: Vec<bool>,
}

impl Used {
    /// Finds the vertices of corners and renumbers the corners, so that the used vertices count from 0.
    pub fn by_corners(corners: &mut [u32]) -> Option<Used> {
        let (first, last) = (*corners.iter().min()?, *corners.iter().max()?);
        let range = first as usize..last as usize + 1;
        let mut is_used = vec![false; range.len()];
        for corner in corners.iter_mut() {
            *corner -= first;
            is_used[*corner as usize] = true;
        }
        let count = is_used.iter().filter(|used| **used).count();
        if count == is_used.len() {
            return Some(Used { range, count, is_used: Vec::new() });
        }
        let mut next = 0_u32;
        let renumbered: Vec<u32> = is_used
            .iter()
            .map(|used| {
                next += u32::from(*used);
                next.saturating_sub(1)
            })
            .collect();
        corners.iter_mut().for_each(|corner| *corner = renumbered[*corner as usize]);
        Some(Used { range, count, is_used })
    }

    /// Keeps the values of used vertices.
    pub fn gather<T>(&self, values: Vec<T>) -> impl Iterator<Item = T> {
        let is_used = |i: usize| self.is_used.get(i).copied().unwrap_or(true);
        values.into_iter().enumerate().filter(move |(i, _)| is_used(*i)).map(|(_, value)| value)
    }
}
