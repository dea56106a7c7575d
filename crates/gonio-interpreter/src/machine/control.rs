//! Which lanes are active: a stack of branches, loops, switches and calls.

use crate::lanes::LaneSet;

/// A construct that is being executed.
enum Scope {
    Branch { saved: LaneSet, then: LaneSet },
    Loop { saved: LaneSet, broken: LaneSet, continued: LaneSet, iteration: u32 },
    Switch { saved: LaneSet, broken: LaneSet },
    Call { saved: LaneSet, returned: LaneSet, frame: u32 },
}

/// The active lanes.
pub(crate) struct Control {
    active: LaneSet,
    /// Lanes that have left a construct and have not reached its end.
    gone: LaneSet,
    pub discarded: LaneSet,
    scopes: Vec<Scope>,
}

impl Control {
    pub fn new(valid: LaneSet) -> Self {
        Self { active: valid, gone: LaneSet::EMPTY, discarded: LaneSet::EMPTY, scopes: Vec::new() }
    }

    pub fn active(&self) -> LaneSet {
        self.active
    }

    /// The active lanes without those that go on only as helpers for derivatives.
    pub fn visible(&self) -> LaneSet {
        self.active.without(self.discarded)
    }

    /// The current call.
    pub fn frame(&self) -> u32 {
        let frame = |scope: &Scope| match scope {
            Scope::Call { frame, .. } => Some(*frame),
            _ => None,
        };
        self.scopes.iter().rev().find_map(frame).unwrap_or(0)
    }

    /// The iterations of the loops around this place, in all calls, the outermost one first.
    pub fn iterations(&self) -> Vec<u32> {
        let iteration = |scope: &Scope| match scope {
            Scope::Loop { iteration, .. } => Some(*iteration),
            _ => None,
        };
        self.scopes.iter().filter_map(iteration).collect()
    }

    /// Starts a branch; returns whether a lane takes it.
    pub fn branch(&mut self, condition: LaneSet) -> bool {
        let then = self.active.and(condition);
        self.scopes.push(Scope::Branch { saved: self.active, then });
        self.active = then;
        !then.is_empty()
    }

    /// Starts the other branch; returns whether a lane takes it.
    pub fn otherwise(&mut self) -> bool {
        if let Some(Scope::Branch { saved, then }) = self.scopes.last() {
            self.active = saved.without(*then).without(self.gone);
        }
        !self.active.is_empty()
    }

    pub fn start_loop(&mut self) {
        let saved = self.active;
        self.scopes.push(Scope::Loop { saved, broken: LaneSet::EMPTY, continued: LaneSet::EMPTY, iteration: 0 });
    }

    /// Ends the loop for lanes where the condition does not hold; returns whether one goes on.
    pub fn test(&mut self, condition: LaneSet) -> bool {
        let leaving = self.active.without(condition);
        self.leave_loop(leaving, false);
        !self.active.is_empty()
    }

    /// The end of a loop's body.
    pub fn next_iteration(&mut self) {
        if let Some(Scope::Loop { saved, continued, iteration, .. }) = self.scopes.last_mut() {
            self.gone = self.gone.without(*continued);
            self.active = saved.without(self.gone);
            *continued = LaneSet::EMPTY;
            *iteration = iteration.saturating_add(1);
        }
    }

    pub fn start_switch(&mut self) {
        self.scopes.push(Scope::Switch { saved: self.active, broken: LaneSet::EMPTY });
        self.active = LaneSet::EMPTY;
    }

    pub fn case(&mut self, condition: LaneSet) {
        if let Some(Scope::Switch { saved, .. }) = self.scopes.last() {
            self.active = self.active.or(saved.and(condition)).without(self.gone);
        }
    }

    pub fn enter(&mut self, frame: u32) {
        self.scopes.push(Scope::Call { saved: self.active, returned: LaneSet::EMPTY, frame });
    }

    /// Ends a branch, loop, switch or call.
    pub fn end(&mut self) {
        let Some(scope) = self.scopes.pop() else { return };
        let (saved, back) = match scope {
            Scope::Branch { saved, .. } => (saved, LaneSet::EMPTY),
            Scope::Loop { saved, broken, continued, .. } => (saved, broken.or(continued)),
            Scope::Switch { saved, broken } => (saved, broken),
            Scope::Call { saved, returned, .. } => (saved, returned),
        };
        self.gone = self.gone.without(back);
        self.active = saved.without(self.gone);
    }

    fn leave(&mut self, lanes: LaneSet, of: impl Fn(&mut Scope) -> Option<&mut LaneSet>) {
        if let Some(left) = self.scopes.iter_mut().rev().find_map(of) {
            *left = left.or(lanes);
            self.gone = self.gone.or(lanes);
            self.active = self.active.without(lanes);
        }
    }

    fn leave_loop(&mut self, lanes: LaneSet, with_switch: bool) {
        self.leave(lanes, |scope| match scope {
            Scope::Loop { broken, .. } => Some(broken),
            Scope::Switch { broken, .. } if with_switch => Some(broken),
            _ => None,
        });
    }

    /// `break`
    pub fn end_loop(&mut self) {
        self.leave_loop(self.active, true);
    }

    /// `continue`
    pub fn continue_loop(&mut self) {
        self.leave(self.active, |scope| match scope {
            Scope::Loop { continued, .. } => Some(continued),
            _ => None,
        });
    }

    /// `return`
    pub fn return_from_call(&mut self) {
        self.leave(self.active, |scope| match scope {
            Scope::Call { returned, .. } => Some(returned),
            _ => None,
        });
    }

    /// `discard`; the lanes go on as helpers unless this `ends` them.
    pub fn discard(&mut self, ends: bool) {
        self.discarded = self.discarded.or(self.active);
        if ends {
            self.gone = self.gone.or(self.active);
            self.active = LaneSet::EMPTY;
        }
    }
}
