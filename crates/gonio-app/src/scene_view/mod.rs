//! The view of the scene: its panes, pointer and keys.
//!
//! [`show`] is the only entry of a frame. `arrangement` divides the room, `pane` handles one pane, `drawing` renders its picture,
//! and `paint` puts that into the window.

mod arrangement;
mod axes;
pub mod drawing;
mod gizmos;
mod lobe;
pub mod navigation;
mod observer;
mod paint;
mod pane;
mod projection;
mod toolbar;
mod vectors;

pub(crate) use gizmos::in_screen_plane;
pub(crate) use paint::{disc, line, picture_size, present};
pub use projection::Projection;

use crate::document::{Document, PaneArrangement};
use crate::session::Session;
use drawing::PaneRenderer;
use egui::{Rect, Ui};
use gonio_gl::GlError;

/// Shows the panes in the remaining room.
pub fn show(
    ui: &mut Ui,
    document: &mut Document,
    session: &mut Session,
    mut pane_renderer: Option<&mut PaneRenderer>,
) -> Result<(), GlError> {
    let room = ui.available_rect_before_wrap();
    // The background is filled only if it is visible, because filling it takes software drivers milliseconds.
    let ground = ui.painter().add(egui::Shape::Noop);
    let shown =
        pane_renderer.as_deref_mut().map_or(Ok(()), |pane_renderer| panes(ui, room, document, session, pane_renderer));
    if shown.is_err() || !pane_renderer.is_some_and(|pane_renderer| is_covered(document, pane_renderer)) {
        ui.painter().set(ground, egui::Shape::rect_filled(room, 0.0, ui.visuals().extreme_bg_color));
    }
    shown
}

/// Whether one opaque picture fills the room.
fn is_covered(document: &Document, pane_renderer: &PaneRenderer) -> bool {
    let panes = &document.panes;
    match panes.arrangement {
        PaneArrangement::SideBySide => panes.list.len() == 1 && pane_renderer.is_opaque(0),
        PaneArrangement::Wipe(_) => pane_renderer.is_opaque(panes.pair[1]),
        PaneArrangement::Difference => pane_renderer.is_opaque(panes.pair[0]),
    }
}

fn panes(
    ui: &mut Ui,
    room: Rect,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    session.moving = session.clock.playing || ui.input(|i| i.pointer.any_down() || i.smooth_scroll_delta().y != 0.0);
    pane_renderer.begin(ui.ctx(), document.panes.list.len());
    match document.panes.arrangement {
        PaneArrangement::SideBySide => {
            let count = document.panes.list.len();
            for (index, rect) in arrangement::arranged(room, count).into_iter().enumerate() {
                let response = pane::show(ui, index, rect, document, session, pane_renderer)?;
                pane::over(ui, index, &response, document, session, pane_renderer)?;
                arrangement::label(ui, index, rect, document, session);
            }
        }
        PaneArrangement::Wipe(share) => arrangement::wipe(ui, room, share, document, session, pane_renderer)?,
        PaneArrangement::Difference => arrangement::difference(ui, room, document, session, pane_renderer)?,
    }
    if pane_renderer.measure(document, session)? {
        ui.ctx().request_repaint();
    }
    Ok(())
}
