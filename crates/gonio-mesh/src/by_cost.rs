//! Entries of a heap whose cheapest comes first.

use std::cmp::Ordering;

/// Something with a cost. The cheapest is the greatest, for [`std::collections::BinaryHeap`]; of equal costs the one with the least
/// `of`, so that the order is the same on every machine.
#[derive(Clone, Copy, Debug)]
pub struct ByCost<T> {
    /// Any number, NaN included: `f64::total_cmp` orders it.
    pub cost: f64,
    /// What costs that.
    pub of: T,
}

impl<T: Ord> PartialEq for ByCost<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T: Ord> Eq for ByCost<T> {}

impl<T: Ord> PartialOrd for ByCost<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T: Ord> Ord for ByCost<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| other.of.cmp(&self.of))
    }
}
