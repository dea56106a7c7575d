//! Lists, strips and fans of triangles (glTF 2.0, section 3.7.2.1).

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
