//! Sets of lanes: the points of one block that an instruction applies to.

/// Points that are evaluated together. A row of this many 32-bit numbers is 1 KiB, so that the live values of a usual
/// shader stay in a CPU's first-level cache.
pub const LANES: usize = 256;

const WORDS: usize = LANES / 64;

/// A set of lanes of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LaneSet([u64; WORDS]);

impl LaneSet {
    /// No lane.
    pub const EMPTY: Self = Self([0; WORDS]);
    /// All lanes.
    pub const FULL: Self = Self([u64::MAX; WORDS]);

    /// Returns the first `count` lanes; all if there are fewer.
    #[must_use]
    pub fn first(count: usize) -> Self {
        Self(std::array::from_fn(|word| {
            let inside = count.saturating_sub(word * 64);
            if inside >= 64 { u64::MAX } else { (1 << inside) - 1 }
        }))
    }

    /// Returns the lanes that satisfy a condition.
    #[must_use]
    pub fn filter(mut holds: impl FnMut(usize) -> bool) -> Self {
        Self(std::array::from_fn(|word| (0..64).fold(0, |bits, bit| bits | u64::from(holds(word * 64 + bit)) << bit)))
    }

    /// Returns the lanes whose numbers are not 0.
    #[must_use]
    pub fn not_zero(row: &[u32; LANES]) -> Self {
        // The product gathers one bit of each byte in the highest byte.
        const GATHER: u64 = 0x0102_0408_1020_4080;
        let mut bytes = [0_u8; LANES];
        for (byte, bits) in bytes.iter_mut().zip(row) {
            *byte = u8::from(*bits != 0);
        }
        let mut words = [0; WORDS];
        for (at, eight) in bytes.as_chunks::<8>().0.iter().enumerate() {
            words[at / 8] |= (u64::from_le_bytes(*eight).wrapping_mul(GATHER) >> 56) << (at % 8 * 8);
        }
        Self(words)
    }

    /// Writes all ones at the lanes of the set, and 0 at others.
    pub fn spread(self, row: &mut [u32; LANES]) {
        for (chunk, half) in
            row.as_chunks_mut::<32>().0.iter_mut().zip(self.0.iter().flat_map(|w| [*w as u32, (w >> 32) as u32]))
        {
            for (at, bits) in chunk.iter_mut().enumerate() {
                *bits = if half & 1 << at == 0 { 0 } else { u32::MAX };
            }
        }
    }

    /// Returns the lanes in both sets.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(std::array::from_fn(|word| self.0[word] & other.0[word]))
    }

    /// Returns the lanes in either set.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self(std::array::from_fn(|word| self.0[word] | other.0[word]))
    }

    /// Returns the lanes that are not in the other set.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(std::array::from_fn(|word| self.0[word] & !other.0[word]))
    }

    /// Whether there is no lane.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self == Self::EMPTY
    }

    /// Whether all lanes of the other set are in this one.
    #[must_use]
    pub fn covers(self, other: Self) -> bool {
        other.without(self).is_empty()
    }

    /// Whether a lane is in the set.
    #[must_use]
    pub fn contains(self, lane: usize) -> bool {
        self.0.get(lane / 64).is_some_and(|word| word >> (lane % 64) & 1 == 1)
    }

    /// Returns the number of lanes.
    #[must_use]
    pub fn count(self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Returns the first lane.
    #[must_use]
    pub fn lowest(self) -> Option<usize> {
        let word = self.0.iter().position(|word| *word != 0)?;
        Some(word * 64 + self.0[word].trailing_zeros() as usize)
    }

    /// Returns the last lane.
    #[must_use]
    pub fn highest(self) -> Option<usize> {
        let word = self.0.iter().rposition(|word| *word != 0)?;
        Some(word * 64 + 63 - self.0[word].leading_zeros() as usize)
    }

    /// Returns the lanes in order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().enumerate().flat_map(|(word, mut bits)| {
            std::iter::from_fn(move || {
                let bit = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
                bits &= bits - 1;
                Some(word * 64 + bit)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_sets() {
        let (a, b) = (LaneSet::first(70), LaneSet::filter(|lane| lane % 2 == 1));
        assert_eq!((a.count(), b.count(), a.and(b).count(), a.or(b).count()), (70, 128, 35, 163));
        assert_eq!(a.without(b).lowest(), Some(0));
        assert_eq!(b.and(LaneSet::FULL.without(LaneSet::first(65))).lowest(), Some(65));
        assert!(a.contains(69) && !a.contains(70) && !a.contains(9999));
        assert!(LaneSet::FULL.covers(a) && !a.covers(b) && LaneSet::first(999) == LaneSet::FULL);
        assert_eq!(LaneSet::first(3).iter().collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!((LaneSet::first(70).highest(), b.highest(), LaneSet::EMPTY.highest()), (Some(69), Some(255), None));
        let row: [u32; LANES] =
            std::array::from_fn(|lane| if lane % 7 == 3 || lane > 250 { 1 << (lane % 32) } else { 0 });
        let set = LaneSet::filter(|lane| row[lane] != 0);
        assert_eq!(LaneSet::not_zero(&row), set);
        let mut ones = row;
        set.spread(&mut ones);
        assert_eq!(ones, row.map(|bits| if bits == 0 { 0 } else { u32::MAX }));
    }
}
