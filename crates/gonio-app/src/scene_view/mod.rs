//! Where the scene is seen: its picture, and what the pointer and the keys do there.

mod arrangement;
mod axes;
mod dragging;
pub mod drawing;
mod gizmos;
mod ink;
pub mod navigation;
mod observer;
mod projection;
mod scale;
mod toolbar;
mod vectors;

pub use projection::Projection;

use crate::document::{Arrangement, Document};
use crate::exported::{self, Role};
use crate::scene_view::drawing::PaneRenderer;
use crate::session::{Selection, Session, Tab};
use eframe::egui_glow;
use egui::{Color32, Pos2, Rect, Response, Sense, Ui, vec2};
use gonio_gl::{Gl, GlError};
use gonio_render::Presentation;
use gonio_scene::Scene;
use std::sync::Arc;

/// Shows the panes in all the room that is left.
pub fn show(
    ui: &mut Ui,
    document: &mut Document,
    session: &mut Session,
    mut pane_renderer: Option<&mut PaneRenderer>,
) -> Result<(), GlError> {
    let room = ui.available_rect_before_wrap();
    // Below the pictures, but only where it will be seen: to fill as much again costs software drivers milliseconds.
    let ground = ui.painter().add(egui::Shape::Noop);
    let shown =
        pane_renderer.as_deref_mut().map_or(Ok(()), |pane_renderer| panes(ui, room, document, session, pane_renderer));
    if shown.is_err() || !pane_renderer.is_some_and(|pane_renderer| is_covered(document, pane_renderer)) {
        ui.painter().set(ground, egui::Shape::rect_filled(room, 0.0, ui.visuals().extreme_bg_color));
    }
    shown
}

/// Whether one picture fills all the room and lets nothing through.
fn is_covered(document: &Document, pane_renderer: &PaneRenderer) -> bool {
    let panes = &document.panes;
    match panes.arrangement {
        Arrangement::SideBySide => panes.list.len() == 1 && pane_renderer.is_opaque(0),
        Arrangement::Wipe(_) => pane_renderer.is_opaque(panes.pair[1]),
        Arrangement::Difference => pane_renderer.is_opaque(panes.pair[0]),
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
        Arrangement::SideBySide => {
            let count = document.panes.list.len();
            for (index, rect) in arrangement::arranged(room, count).into_iter().enumerate() {
                let response = pane(ui, index, rect, document, session, pane_renderer)?;
                over(ui, index, &response, document, session, pane_renderer)?;
                arrangement::label(ui, index, rect, document, session);
            }
        }
        Arrangement::Wipe(share) => arrangement::wipe(ui, room, share, document, session, pane_renderer)?,
        Arrangement::Difference => arrangement::difference(ui, room, document, session, pane_renderer)?,
    }
    if pane_renderer.measure(document, session)? {
        ui.ctx().request_repaint();
    }
    Ok(())
}

/// A pane: what pointer and keys do there, and its picture.
fn pane(
    ui: &mut Ui,
    index: usize,
    rect: Rect,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<Response, GlError> {
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    exported::note(
        ui,
        &response,
        &format!("pane-{index}"),
        Role::Picture,
        "picture of the scene",
        caption(document, index),
    );
    navigation::handle(ui, &response, document, session);
    if response.clicked() || response.drag_started() {
        document.panes.current = index;
    }
    if let Some(picture) = drawn(ui, index, rect, document, session, pane_renderer)? {
        present(ui, rect, picture);
    }
    Ok(response)
}

/// The picture of a pane that fills a rectangle.
fn drawn(
    ui: &Ui,
    index: usize,
    rect: Rect,
    document: &Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<Option<Presentation>, GlError> {
    let size = picture_size(rect, ui.ctx().pixels_per_point());
    let mut facts = std::mem::take(&mut session.facts);
    let picture = pane_renderer.picture(index, document, session, size, &mut facts);
    facts.size = size;
    session.facts = facts;
    picture
}

/// Columns and rows of the window that a rectangle takes: as egui rounds them for a paint callback, so that a picture is
/// shown pixel for pixel.
pub(crate) fn picture_size(rect: Rect, pixels_per_point: f32) -> [u32; 2] {
    let side = |from: f32, to: f32| (to * pixels_per_point).round() - (from * pixels_per_point).round();
    [side(rect.left(), rect.right()), side(rect.top(), rect.bottom())].map(|side| side.max(0.0) as u32)
}

/// How a pane differs, in words.
fn caption(document: &Document, index: usize) -> String {
    document.panes.list.get(index).map(|pane| pane.caption()).unwrap_or_default()
}

/// What lies over a pane's picture: lights to drag, the probe's arrows, the axes, the camera from outside, the views.
fn over(
    ui: &mut Ui,
    index: usize,
    response: &Response,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    let rect = response.rect;
    // As it is in the picture: the document may be a frame ahead.
    let (Some(loaded), Some(frame)) = (pane_renderer.loaded(index).cloned(), pane_renderer.frame(index).cloned())
    else {
        return Ok(());
    };
    let projection = Projection::new(&frame.camera, rect);
    point(index, response, session);
    if session.probing.pane == index {
        session.probing.update(ui.ctx(), &loaded, &frame, |x, y| pane_renderer.pixel(index, x, y));
        vectors::show(ui, &projection, &session.probing, session.selection);
    }
    if response.dragged() {
        aim(ui, &projection, document, &loaded);
    }
    gizmos::show(ui, index, &projection, &loaded, &frame, document, session);
    if leads(document, index) {
        axes::show(ui, &projection, document, session);
        if let Some(place) = observer::place(rect).filter(|_| session.observer.open) {
            observer::show(ui, index, place, &frame, &mut session.observer, pane_renderer)?;
        }
        toolbar::show(ui, rect, &frame, document, session);
    }
    Ok(())
}

/// Whether a pane is the one that has what is shown once: of several side by side the first, else the one there is.
fn leads(document: &Document, pane: usize) -> bool {
    pane == 0 || document.panes.arrangement != Arrangement::SideBySide
}

/// What the pointer asks the probe for: while its tab is shown it follows, and a click anywhere pins.
fn point(index: usize, response: &Response, session: &mut Session) {
    let share = |place: Pos2| {
        let local = (place - response.rect.min) / response.rect.size();
        [f64::from(local.x), f64::from(local.y)]
    };
    let probing = &mut session.probing;
    probing.follows = session.tab == Tab::Probe;
    match response.hover_pos() {
        Some(place) => {
            probing.hovered = Some(share(place));
            if probing.pinned.is_none() {
                probing.pane = index;
            }
        }
        None if probing.pane == index => probing.hovered = None,
        None => {}
    }
    if response.clicked()
        && let Some(place) = response.interact_pointer_pos()
    {
        probing.pinned = Some(share(place));
        probing.pane = index;
        session.tab = Tab::Probe;
        session.selection = Selection::None;
    }
}

/// The point looked at, while the eye turns around it.
fn aim(ui: &Ui, projection: &Projection, document: &Document, loaded: &Scene) {
    let (min, max) = loaded.bounds();
    let pivot = navigation::Rig::new(&document.scene.camera, 0.5 * (min + max)).pivot();
    let Some(place) = projection.to_window(pivot) else { return };
    let painter = ui.painter_at(projection.rect());
    for arm in [vec2(9.0, 0.0), vec2(0.0, 9.0)] {
        for side in [-1.0, 1.0] {
            ink::line(&painter, [place + 0.35 * side * arm, place + side * arm], 1.5, Color32::WHITE);
        }
    }
}

/// Shows a picture in a rectangle.
/// Shows a finished picture in a rectangle of its size.
pub(crate) fn present(ui: &Ui, rect: Rect, picture: Presentation) {
    let callback = egui_glow::CallbackFn::new(move |_, painter| picture.draw(&Gl::of_window(painter.gl().clone())));
    ui.painter().add(egui::PaintCallback { rect, callback: Arc::new(callback) });
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::ViewportInPixels;

    /// Anything else would be shown with a row or a column doubled or left out.
    #[test]
    fn a_picture_is_as_large_as_egui_makes_room_for() {
        let mut fractional = 0;
        for step in 0..400 {
            let pixels_per_point = [1.0, 1.25, 1.5, 2.0, 1.1][step % 5];
            let [left, top] = [0.37, 0.61].map(|share| share * step as f32);
            let rect = Rect::from_min_size(Pos2::new(left, top), vec2(300.3 + left, 200.7));
            let room = ViewportInPixels::from_points(&rect, pixels_per_point, [4000, 4000]);
            let size = picture_size(rect, pixels_per_point);
            assert_eq!(size, [room.width_px as u32, room.height_px as u32], "{rect:?} at {pixels_per_point}");
            fractional += usize::from(size[1] != (rect.height() * pixels_per_point).round() as u32);
        }
        assert!(fractional > 20, "only {fractional} sizes are not simply rounded");
        assert_eq!(picture_size(Rect::NOTHING, 1.0), [0, 0]);
    }
}
