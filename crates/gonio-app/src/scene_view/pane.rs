//! One pane: its picture, pointer and keys, and overlays.

use super::drawing::PaneRenderer;
use super::paint::{picture_size, present};
use super::{Projection, axes, gizmos, lobe, navigation, observer, paint, toolbar, vectors};
use crate::baking;
use crate::document::{Document, PaneArrangement, Panes};
use crate::exported::{self, WidgetRole};
use crate::session::{Selection, Session, Tab};
use crate::step;
use egui::{Color32, Pos2, Rect, Response, Sense, Ui, vec2};
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_render::Presentation;
use gonio_scene::{Frame, Scene};

/// Shows a pane's picture, and handles pointer and keys.
pub fn show(
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
        WidgetRole::Picture,
        tr!("scene-picture-of-the-scene"),
        caption(document, session, index),
    );
    navigation::handle(ui, &response, document, session);
    if response.clicked() || response.drag_started() {
        document.panes.current = under(&document.panes, index, response.interact_pointer_pos(), rect);
    }
    if let Some(picture) = drawn(ui, index, rect, document, session, pane_renderer)? {
        present(ui, rect, picture);
        ground(ui, index, rect, session, pane_renderer)?;
        if let Some(layer) = pane_renderer.outline(index, session, ui.visuals().dark_mode)? {
            present(ui, rect, layer);
        }
    }
    Ok(response)
}

/// Shows the ground below the objects over a pane's picture.
pub fn ground(
    ui: &Ui,
    index: usize,
    rect: Rect,
    session: &Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    if let Some(layer) = pane_renderer.ground(index, session, ui.visuals().dark_mode)? {
        present(ui, rect, layer);
    }
    Ok(())
}

/// The picture of a pane, drawn for a rectangle.
pub fn drawn(
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

/// The caption of a pane; of a traced picture with the number of its paths and its error.
pub fn caption(document: &Document, session: &Session, index: usize) -> String {
    let is_traced = document.panes.list.get(index).is_some_and(|pane| pane.truth.is_some());
    let traced = session.traced.get(index).filter(|_| is_traced);
    let facts = traced.map(|traced| format!(": {}", traced.caption()));
    document.panes.caption(index) + &facts.unwrap_or_default()
}

/// Everything over a pane's picture: light gizmos, the probe's arrows, axes, observer's view, toolbar.
pub fn over(
    ui: &mut Ui,
    index: usize,
    response: &Response,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    let rect = response.rect;
    // The state in the picture: the document may be a frame ahead.
    let (Some(loaded), Some(frame)) = (pane_renderer.loaded(index).cloned(), pane_renderer.frame(index).cloned())
    else {
        return Ok(());
    };
    let projection = Projection::new(&frame.camera, rect);
    let pointed = response.hover_pos().or(response.interact_pointer_pos());
    let below = under(&document.panes, index, pointed, rect);
    point(below, response, session, pane_renderer.is_users(below));
    let probed = session.probing.pane;
    let is_wipe = matches!(document.panes.arrangement, PaneArrangement::Wipe(_));
    let is_here = |pane: usize| pane == index || (is_wipe && document.panes.pair.contains(&pane));
    if let Some(shaders) = session.shaders.as_ref().filter(|shaders| is_here(shaders.pane)) {
        step::margin::marker(ui, rect, &shaders.stepper);
    }
    // Below the arrows.
    let is_probe = session.tab != Tab::Bake;
    let pinned = lobe::at_pin(&session.probing, session.selection, &frame).filter(|_| is_probe);
    if let Some(lobe) = &pinned {
        lobe::on_surface(ui, &projection, lobe);
    }
    if let (Some(loaded), Some(frame)) = (pane_renderer.loaded(probed).cloned(), pane_renderer.frame(probed).cloned())
        && is_here(probed)
    {
        session.probing.update(ui.ctx(), &loaded, &frame, |x, y| pane_renderer.pixel(probed, x, y));
        if let Some(found) = session.probing.take_selected(&frame) {
            session.selection = Selection::of_part(found);
        }
        if is_probe {
            vectors::show(ui, &projection, &session.probing, session.selection);
        }
    }
    baking::mark(ui, &projection, &session.baking, &session.probing);
    if response.dragged() {
        aim(ui, &projection, document, &loaded);
    }
    gizmos::show(ui, index, &projection, &loaded, &frame, document, session);
    if let Some(lobe) = &pinned {
        lobe::inset(ui, &projection, lobe, (index, reflectance(&frame)));
    }
    if document.panes.is_leading(index) {
        axes::show(ui, &projection, document, session);
        if let Some(place) = observer::place(rect).filter(|_| session.observer.open) {
            observer::show(ui, index, place, &frame, &mut session.observer, pane_renderer)?;
        }
        toolbar::show(ui, rect, &frame, document, session);
    }
    Ok(())
}

/// The reflectance of a frame in a word.
fn reflectance(frame: &Frame) -> &'static str {
    frame.equation.brdf.as_ref().map_or(frame.equation.specular.name(), |brdf| brdf.kind.name())
}

/// The pane whose picture is at a place of the window: left of a wipe's divider the first of the pair.
fn under(panes: &Panes, index: usize, place: Option<Pos2>, rect: Rect) -> usize {
    match (panes.arrangement, place) {
        (PaneArrangement::Wipe(share), Some(place)) if place.x < rect.left() + share * rect.width() => panes.pair[0],
        _ => index,
    }
}

/// Updates the probed place: it follows the pointer while its tab is shown, and a click pins it. In a picture of the user's
/// shaders, a click pins the pixel whose values they show, unless the probe is shown.
fn point(index: usize, response: &Response, session: &mut Session, is_users: bool) {
    let share = |place: Pos2| {
        let local = (place - response.rect.min) / response.rect.size();
        [f64::from(local.x), f64::from(local.y)]
    };
    let probing = &mut session.probing;
    let shows_texels = session.tab == Tab::Bake && session.baking.result().is_some();
    probing.follows = session.tab == Tab::Probe || shows_texels;
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
        if let Some(shaders) = session.shaders.as_mut().filter(|_| is_users && !probing.follows) {
            shaders.stepper.pin(share(place).map(|share| share as f32));
            shaders.pane = index;
            return;
        }
        probing.pinned = Some(share(place));
        probing.pane = index;
        probing.selects = true;
        session.baking.picked = None;
        // Among the objects, a click opens the material of the part.
        if !shows_texels && session.tab != Tab::Objects {
            session.tab = Tab::Probe;
        }
        session.selection = Selection::None;
    }
}

/// A mark at the target while the camera orbits around it.
fn aim(ui: &Ui, projection: &Projection, document: &Document, loaded: &Scene) {
    let (min, max) = loaded.bounds();
    let pivot = navigation::Rig::new(&document.scene.camera, 0.5 * (min + max)).pivot();
    let Some(place) = projection.to_window(pivot) else { return };
    let painter = ui.painter_at(projection.rect());
    for arm in [vec2(9.0, 0.0), vec2(0.0, 9.0)] {
        for side in [-1.0, 1.0] {
            paint::line(&painter, [place + 0.35 * side * arm, place + side * arm], 1.5, Color32::WHITE);
        }
    }
}
