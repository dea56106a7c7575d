//! How much of the search for mistakes is left to one check, whatever the number of roles that its inputs may have.

use std::cell::Cell;

/// Most predictions of single mistakes at few places, with open strengths and lights.
const MOST_SINGLES: usize = 2_500_000;
/// Most predictions of pairs at few places.
const MOST_PAIRS: usize = 120_000;
/// Most pairs that are predicted at all places.
const MOST_WHOLE: usize = 240;

/// What may still be predicted.
#[derive(Debug)]
pub(crate) struct Budget {
    /// Single mistakes at places, with open strengths and lights.
    singles: Cell<usize>,
    /// Pairs at few places.
    pub pairs: Cell<usize>,
    /// Pairs at all places.
    pub whole: Cell<usize>,
}

impl Default for Budget {
    fn default() -> Self {
        Budget { singles: MOST_SINGLES.into(), pairs: MOST_PAIRS.into(), whole: MOST_WHOLE.into() }
    }
}

impl Budget {
    /// Takes the cost of single mistakes; false if too little is left.
    pub fn take_singles(&self, cost: usize) -> bool {
        let left = self.singles.get().checked_sub(cost);
        self.singles.set(left.unwrap_or(self.singles.get()));
        left.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_never_overdrawn() {
        let budget = Budget::default();
        assert!(budget.take_singles(MOST_SINGLES - 10));
        assert!(!budget.take_singles(11));
        assert!(budget.take_singles(10));
        assert!(!budget.take_singles(1));
    }
}
