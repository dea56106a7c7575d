//! A drag to its end.

use egui::{PointerButton, Response, Vec2};

/// egui counts the frame of the release to no drag. But where frames take long, the pointer's last way comes in that same
/// frame, and what is dragged would be left short of where it was released.
pub trait Dragging {
    /// Dragged, or just released.
    fn is_dragged(&self) -> bool;
    /// The same by one button.
    fn is_dragged_by(&self, button: PointerButton) -> bool;
    /// Movement since the last frame, points.
    fn way(&self) -> Vec2;
}

impl Dragging for Response {
    fn is_dragged(&self) -> bool {
        self.dragged() || self.drag_stopped()
    }

    fn is_dragged_by(&self, button: PointerButton) -> bool {
        self.dragged_by(button) || self.drag_stopped_by(button)
    }

    fn way(&self) -> Vec2 {
        if self.drag_stopped() { self.ctx.input(|i| i.pointer.delta()) } else { self.drag_delta() }
    }
}
