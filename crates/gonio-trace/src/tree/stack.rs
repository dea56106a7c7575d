//! Nodes of a tree that are yet to be visited.

/// Nodes to visit, with the distance at which the ray enters them.
pub(super) struct Stack {
    /// The distance's bits above the child's: distances are not negative, so their order is that of the integers.
    entries: [u64; Stack::SIZE],
    length: usize,
    /// What does not fit: only for trees of thousands of equal boxes.
    rest: Vec<u64>,
}

impl Stack {
    const SIZE: usize = 32;

    #[inline(always)]
    pub fn new() -> Self {
        Stack { entries: [0; Stack::SIZE], length: 0, rest: Vec::new() }
    }

    #[inline(always)]
    pub fn len(&self) -> usize {
        self.length
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<(f32, u32)> {
        let top = if self.rest.is_empty() {
            self.length = self.length.checked_sub(1)?;
            self.entries[self.length]
        } else {
            self.rest.pop()?
        };
        Some((f32::from_bits((top >> 32) as u32), top as u32))
    }

    /// Pushes, `SORTED` between the entries from `bottom` on, which are sorted from far to near.
    #[inline(always)]
    pub fn insert<const SORTED: bool>(&mut self, bottom: usize, entry: f32, child: u32) {
        let packed = u64::from(entry.to_bits()) << 32 | u64::from(child);
        if self.length == Stack::SIZE || !self.rest.is_empty() {
            self.rest.push(packed);
            return;
        }
        let mut at = self.length;
        self.length += 1;
        while SORTED && at > bottom && self.entries[at - 1] < packed {
            self.entries[at] = self.entries[at - 1];
            at -= 1;
        }
        self.entries[at] = packed;
    }
}
