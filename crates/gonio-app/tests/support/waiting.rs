//! Waiting for work beside the interface, for files of tests about such work.

use super::support::Window;
use serde_json::Value;

/// Frames that the work may take; each waits a little.
const MOST_FRAMES: usize = 3000;

impl Window {
    pub fn state(&self) -> Value {
        self.app().state(&self.harness.ctx)
    }

    /// Waits until the state fulfils a condition.
    pub fn until(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..MOST_FRAMES {
            let state = self.state();
            if expected(&state) {
                return state;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
            self.steps(1);
        }
        panic!("{what} did not come: {:#}", self.state());
    }

    pub fn click(&mut self, id: &str) {
        // Longer than a double click.
        self.steps(30);
        self.click_at(self.center(id));
    }
}
