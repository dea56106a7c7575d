//! How many single mistakes may still be predicted in one check, whatever the number of roles that its inputs may have.

use std::cell::Cell;

/// Most predictions of single mistakes at few places, with open strengths and lights.
const MOST_SINGLES: usize = 2_500_000;
/// The same for what is left wrong beside a repaired value. It is explained soon or not at all, and several values are tried.
const MOST_BESIDE: usize = 400_000;
/// Most single mistakes that are drawn at all places. Where most places are white or black, few places tell little.
const MOST_DRAWN: usize = 300;

/// What may still be predicted.
#[derive(Debug)]
pub(crate) struct Budget {
    at_few: Cell<usize>,
    drawn: Cell<usize>,
}

impl Default for Budget {
    fn default() -> Self {
        Budget { at_few: Cell::new(MOST_SINGLES), drawn: Cell::new(MOST_DRAWN) }
    }
}

impl Budget {
    /// For what is left wrong beside repaired values, all of them together.
    pub fn beside() -> Self {
        Budget { at_few: Cell::new(MOST_BESIDE), ..Budget::default() }
    }

    /// What is left.
    pub fn left(&self) -> [usize; 2] {
        [self.at_few.get(), self.drawn.get()]
    }

    /// An equal part of what is left for one of `count` sets of roles, whatever the others take.
    pub fn part([at_few, drawn]: [usize; 2], count: usize) -> Self {
        let of = |left: usize| Cell::new(left / count.max(1));
        Budget { at_few: of(at_few), drawn: of(drawn) }
    }

    /// Takes a number of predictions at few places; false if fewer are left.
    pub fn take(&self, count: usize) -> bool {
        take(&self.at_few, count)
    }

    /// Takes a prediction at all places; false if none is left.
    pub fn take_drawn(&self) -> bool {
        take(&self.drawn, 1)
    }
}

fn take(of: &Cell<usize>, count: usize) -> bool {
    let left = of.get().checked_sub(count);
    of.set(left.unwrap_or(of.get()));
    left.is_some()
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
        assert_eq!(Budget::part(budget.left(), 3).left(), [0, MOST_DRAWN / 3]);
        assert_eq!((0..2 * MOST_DRAWN).filter(|_| budget.take_drawn()).count(), MOST_DRAWN);
    }
}
