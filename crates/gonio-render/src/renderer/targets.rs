//! The targets that are kept between frames.

use gonio_gl::target::{Precision, Sampling, Target};
use std::rc::Rc;

/// Most panes of a window that are drawn in turn.
pub(super) const PANES: usize = 4;

/// Targets, the one that was used last in front, each with the number of its last use.
#[derive(Default)]
pub(crate) struct Targets {
    kept: Vec<(Rc<Target>, u64)>,
    uses: u64,
}

impl Targets {
    /// One that fits and that no finished frame holds, which must not be drawn over.
    pub fn find(&mut self, size: [i32; 2], sampling: Sampling, precision: Precision) -> Option<Rc<Target>> {
        let fits = |target: &Rc<Target>| {
            target.size == size
                && target.sampling == sampling
                && target.precision == precision
                && Rc::strong_count(target) == 1
        };
        let index = self.kept.iter().position(|(target, _)| fits(target))?;
        let (target, _) = self.kept.remove(index);
        self.keep(target.clone());
        Some(target)
    }

    /// Makes room for another: of `most` panes that are drawn in turn, each has used its own lately; what has not been
    /// used for as long is of a size that nobody has any more.
    pub fn make_room(&mut self, most: usize) {
        let uses = self.uses;
        self.kept.retain(|(_, last)| last + most as u64 > uses + 1);
    }

    /// Keeps one that was made.
    pub fn keep(&mut self, target: Rc<Target>) {
        self.uses += 1;
        self.kept.insert(0, (target, self.uses));
    }

    /// The target that was used last.
    #[cfg(any(test, feature = "bench"))]
    pub fn last(&self) -> Option<&Rc<Target>> {
        self.kept.first().map(|(target, _)| target)
    }

    /// The number of targets.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.kept.len()
    }
}
