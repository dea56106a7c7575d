//! The document: everything that is edited, saved and undone, as plain data; and its history.

mod changes;
mod pane;

pub use pane::{
    BakedLook, DifferenceSettings, Pane, PaneArrangement, PaneOverlay, PaneReflectance, Panes, TruthSettings, VIEW_KEYS,
};

use gonio_scene::SceneSettings;

/// Everything that the user edits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The effective scene: every default filled in.
    pub scene: SceneSettings,
    /// The panes that show it.
    pub panes: Panes,
}

impl Document {
    /// Wraps a scene that was just opened, in one pane.
    pub fn from_scene(scene: SceneSettings) -> Self {
        Document { scene, panes: Panes::default() }
    }
}

/// Most steps that are kept; a snapshot is a few kilobytes.
const MOST_STEPS: usize = 500;

/// Earlier versions of the document, and later ones that were undone.
#[derive(Clone, Debug)]
pub struct History {
    /// The document as of the last finished gesture.
    settled: Document,
    undo: Vec<Document>,
    redo: Vec<Document>,
}

impl History {
    /// An empty history.
    pub fn new(document: &Document) -> Self {
        History { settled: document.clone(), undo: Vec::new(), redo: Vec::new() }
    }

    /// Records changes; called once per frame. All changes while `gesture` is true (a button or key is held, or the wheel
    /// moves) become one step.
    pub fn observe(&mut self, document: &Document, gesture: bool) {
        if gesture || *document == self.settled {
            return;
        }
        if self.undo.len() == MOST_STEPS {
            self.undo.remove(0);
        }
        self.undo.push(std::mem::replace(&mut self.settled, document.clone()));
        self.redo.clear();
    }

    /// Whether there is something to undo in `document`.
    pub fn can_undo(&self, document: &Document) -> bool {
        !self.undo.is_empty() || *document != self.settled
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }

    /// Goes back one step and describes it ("moved key light"); `None` if there is none. A gesture that has not ended is a step.
    pub fn undo(&mut self, document: &mut Document) -> Option<String> {
        self.observe(document, false);
        let earlier = self.undo.pop()?;
        let step = changes::description(&earlier, &self.settled);
        self.redo.push(std::mem::replace(&mut self.settled, earlier.clone()));
        *document = earlier;
        Some(step)
    }

    /// Goes forward one step and describes it; `None` if there is none.
    pub fn redo(&mut self, document: &mut Document) -> Option<String> {
        self.observe(document, false);
        let later = self.redo.pop()?;
        let step = changes::description(&self.settled, &later);
        self.undo.push(std::mem::replace(&mut self.settled, later.clone()));
        *document = later;
        Some(step)
    }

    /// Reverts to the last settled document, because a change since then cannot be applied.
    pub fn revert(&self, document: &mut Document) {
        document.clone_from(&self.settled);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_exposure(exposure: f64) -> Document {
        let mut document = Document::default();
        document.scene.picture.exposure = exposure;
        document
    }

    #[test]
    fn a_gesture_is_one_step_and_comes_back() {
        let mut document = with_exposure(0.0);
        let mut history = History::new(&document);
        for step in 1..=5 {
            document.scene.picture.exposure = f64::from(step);
            history.observe(&document, true);
        }
        history.observe(&document, false);
        assert_eq!(history.undo(&mut document).as_deref(), Some("changed the picture\'s settings"));
        assert_eq!(document, with_exposure(0.0));
        assert_eq!(history.undo(&mut document), None);
        assert_eq!(history.redo(&mut document).as_deref(), Some("changed the picture\'s settings"));
        assert_eq!(document, with_exposure(5.0));
        assert!(!history.can_redo());
    }

    #[test]
    fn a_change_after_an_undo_clears_redo() {
        let mut document = with_exposure(0.0);
        let mut history = History::new(&document);
        document = with_exposure(1.0);
        history.observe(&document, false);
        assert_eq!(history.undo(&mut document).as_deref(), Some("changed the picture\'s settings"));
        document = with_exposure(2.0);
        history.observe(&document, false);
        assert_eq!(history.redo(&mut document), None);
        assert_eq!(history.undo(&mut document).as_deref(), Some("changed the picture\'s settings"));
        assert_eq!(document, with_exposure(0.0));
    }

    #[test]
    fn a_gesture_that_has_not_ended_can_be_undone() {
        let mut document = with_exposure(0.0);
        let mut history = History::new(&document);
        document = with_exposure(1.0);
        history.observe(&document, true);
        assert!(history.can_undo(&document));
        assert_eq!(history.undo(&mut document).as_deref(), Some("changed the picture\'s settings"));
        assert_eq!(document, with_exposure(0.0));
    }

    #[test]
    fn a_change_that_cannot_be_applied_is_reverted() {
        let mut document = with_exposure(0.0);
        let history = History::new(&document);
        document = with_exposure(f64::NAN);
        history.revert(&mut document);
        assert_eq!(document, with_exposure(0.0));
    }
}
