//! Finds vertices at the same place.

const EMPTY: u32 = u32::MAX;

/// Returns a place for each vertex, equal for equal positions (bit by bit, except that -0 is 0), numbered from 0 in the
/// order of their first vertices. Also returns their number.
pub(crate) fn places(positions: &[[f32; 3]]) -> (Vec<u32>, usize) {
    let mut table = Table::with_room_for(positions.len());
    let mut place_of_vertex = Vec::with_capacity(positions.len());
    let mut first_vertices: Vec<u32> = Vec::new();
    for (vertex, position) in positions.iter().enumerate() {
        let key = position.map(bits);
        let hash = u64::from(key[0]) | u64::from(key[1]) << 32;
        let hash = mix(mix(hash) ^ u64::from(key[2]));
        let found = table.find(hash, |place| positions[first_vertices[place as usize] as usize].map(bits) == key);
        place_of_vertex.push(found.unwrap_or_else(|slot| {
            let place = first_vertices.len() as u32;
            table.fill(slot, place);
            first_vertices.push(vertex as u32);
            place
        }));
    }
    (place_of_vertex, first_vertices.len())
}

/// Returns the bits of a coordinate, equal for 0 and -0.
fn bits(value: f32) -> u32 {
    (value + 0.0).to_bits()
}

/// A bijection of 64 bits in which each bit of the input affects half of the output (the finisher of SplitMix64: G.
/// Steele, D. Lea, C. Flood, 2014).
#[inline]
pub(crate) fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A hash table of numbers with open addressing, at most half full, with a fixed size.
pub(crate) struct Table {
    slots: Vec<u32>,
    mask: usize,
}

impl Table {
    /// Creates a table for at most `count` entries.
    pub(crate) fn with_room_for(count: usize) -> Self {
        let size = (2 * count).next_power_of_two().max(2);
        Table { slots: vec![EMPTY; size], mask: size - 1 }
    }

    /// Returns the entry with this hash for which `is_it` holds, or the slot where it belongs.
    #[inline]
    pub(crate) fn find(&self, hash: u64, is_it: impl Fn(u32) -> bool) -> Result<u32, usize> {
        let mut slot = hash as usize & self.mask;
        loop {
            let entry = self.slots[slot];
            if entry == EMPTY {
                return Err(slot);
            }
            if is_it(entry) {
                return Ok(entry);
            }
            slot = (slot + 1) & self.mask;
        }
    }

    /// Stores an entry in a slot returned by [`Self::find`].
    pub(crate) fn fill(&mut self, slot: usize, entry: u32) {
        self.slots[slot] = entry;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_a_place() {
        let positions = [[0.0, 1.0, 2.0], [-0.0, 1.0, 2.0], [0.0, 1.0, 2.000_000_2], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
        assert_eq!(places(&positions), (vec![0, 0, 1, 2, 0], 3));
        assert_eq!(places(&[]), (vec![], 0));
    }
}
