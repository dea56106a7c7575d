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

    /// Returns the lanes in order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.contains(*lane))
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
    }
}
