//! How many single mistakes may still be predicted in one check, whatever the number of roles that its inputs may have.

use std::cell::Cell;

/// Most predictions of single mistakes at few places, with open strengths and lights.
const MOST_SINGLES: usize = 2_500_000;

/// What may still be predicted.
#[derive(Debug)]
pub(crate) struct Budget(Cell<usize>);

impl Default for Budget {
    fn default() -> Self {
        Budget(Cell::new(MOST_SINGLES))
    }
}

impl Budget {
    /// Takes a number of predictions; false if fewer are left.
    pub fn take(&self, count: usize) -> bool {
        let left = self.0.get().checked_sub(count);
        self.0.set(left.unwrap_or(self.0.get()));
        left.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_never_overdrawn() {
        let budget = Budget::default();
        assert!(budget.take(MOST_SINGLES - 10));
        assert!(!budget.take(11));
        assert!(budget.take(10));
        assert!(!budget.take(1));
    }
}
