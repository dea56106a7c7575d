//! Gizmos of the lights in the picture, to select and to drag.
//!
//! | part | effect of a drag |
//! |---|---|
//! | bulb, lamp | moves the light parallel to the picture; with Shift along the view |
//! | arms along x, y, z of the selected light | moves it along that axis |
//! | sun of a directional light, beside the objects | turns the direction; with Shift on the far side |
//! | end of a spot's axis, at the objects' distance | turns the spot |
//! | rim of a spot's outer circle | changes the angle |
//!
//! A light outside of the picture has a mark at the picture's edge. Dragging the mark moves the light to the objects.

mod drag;
mod draw;

pub(crate) use drag::in_screen_plane;

use super::navigation::Dragging;
use super::{Projection, paint};
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::{Selection, Session};
use crate::theme::colors;
use egui::{Align2, Color32, CursorIcon, Id, Painter, Pos2, Rect, Response, Rgba, Sense, Ui, Vec2, vec2};
use glam::DVec3;
use gonio_language::tr;
use gonio_light::LightKind;
use gonio_scene::settings::LightSettings;
use gonio_scene::{Frame, LightShape, Scene};

/// Radius around its centre, in points, in which a handle is hit by the pointer or by a finger.
const HIT: f32 = 13.0;
const HIT_BY_FINGER: f32 = 22.0;
/// Length of a light's arms, points.
const ARM: f64 = 52.0;
/// Distance of a directional light's gizmo from the objects' centre, as a share of their radius ...
const SUN_DISTANCE: f64 = 1.15;
/// ... and at most of the picture's height, so that it is in the picture.
const SUN_IN_PICTURE: f64 = 0.40;
/// Widest half angle of a spot, degrees: its circle would be infinitely large at 90.
const WIDEST_SPOT: f64 = 85.0;

/// A light as it is shown.
pub struct Mark {
    index: usize,
    kind: LightKind,
    shape: LightShape,
    /// Position of the light, or where a directional light is shown, world space.
    anchor: DVec3,
    /// Position in the window; `None` behind the eye and outside of the picture.
    place: Option<Pos2>,
    color: Color32,
    /// Whether it emits no light.
    off: bool,
}

/// A draggable part of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Part {
    Body,
    Arm(usize),
    AxisEnd,
    Rim,
}

/// The start of a drag.
#[derive(Clone, Copy, Debug)]
struct Grab {
    /// Vector from the pointer to the grabbed part, which is kept during the drag.
    offset: Vec2,
    /// Position of the part at the start, world space.
    start: DVec3,
    /// Position of the light at the start, world space.
    anchor: DVec3,
    /// Distance dragged along the view so far (Shift), points.
    along: f32,
    /// Whether a directional light is on the far side of its sphere.
    far_side: bool,
}

/// Context for the handles of a frame.
struct Handles<'a> {
    ui: &'a Ui,
    painter: Painter,
    pane: usize,
    /// Whether the handles of this pane are exported.
    leads: bool,
    projection: &'a Projection,
    /// Centre of the objects and half of their box's diagonal, world space.
    center: DVec3,
    radius: f64,
    time: f64,
}

/// Shows the lights over the picture of a pane, and handles drags. Lights are shown as in the picture: `loaded` at its time.
pub fn show(
    ui: &Ui,
    pane: usize,
    projection: &Projection,
    loaded: &Scene,
    frame: &Frame,
    document: &mut Document,
    session: &mut Session,
) {
    let (min, max) = loaded.bounds();
    let painter = ui.painter_at(projection.rect());
    let (center, radius) = (0.5 * (min + max), (0.5 * (max - min).length()).max(1e-9));
    let handles = Handles {
        ui,
        painter,
        pane,
        leads: document.panes.is_leading(pane),
        projection,
        center,
        radius,
        time: frame.time,
    };
    if let Selection::Object(object) = session.selection {
        draw::object_box(&handles.painter, projection, loaded, object, colors::ACCENT.of(ui));
    }
    let chosen = match session.selection {
        Selection::Light(index) => Some(index),
        _ => None,
    };
    let mut marks: Vec<Mark> = frame
        .lights
        .iter()
        .zip(&loaded.settings.lights)
        .enumerate()
        .filter_map(|(index, (light, spec))| {
            let shape = frame.light_shapes.get(index).copied().unwrap_or_default();
            handles.mark(index, (light.kind, shape), spec)
        })
        .collect();
    // The selected light is drawn last.
    marks.sort_by_key(|mark| chosen == Some(mark.index));
    for mark in &marks {
        let is_chosen = chosen == Some(mark.index);
        let Some(shown) = loaded.settings.lights.get(mark.index) else { continue };
        let Some(spec) = document.scene.lights.get_mut(mark.index) else { continue };
        if handles.light(mark, shown, spec, is_chosen) {
            session.selection = Selection::Light(mark.index);
        }
    }
}

impl Handles<'_> {
    fn mark(&self, index: usize, (kind, shape): (LightKind, LightShape), spec: &LightSettings) -> Option<Mark> {
        let anchor = match kind {
            LightKind::Ambient => return None,
            LightKind::Directional { direction } => self.center - direction * self.sun_distance(),
            LightKind::Point { position } | LightKind::Spot { position, .. } => position,
        };
        // Lights very close to the eye are not shown, because they would move erratically.
        let nearest = 0.05 * self.projection.camera().near;
        let place = (self.projection.camera().depth_of(anchor) > nearest)
            .then(|| self.projection.to_window(anchor))
            .flatten()
            .filter(|&place| self.projection.rect().contains(place));
        let [red, green, blue] = spec.color.0.map(|c| c as f32);
        let most = red.max(green).max(blue);
        let off = !spec.enabled || most <= 0.0 || spec.intensity == 0.0;
        // The hue alone, because intensities would make most lights white or black.
        let scale = if most > 0.0 { 1.0 / most } else { 0.0 };
        let color = if off {
            Color32::from_gray(150)
        } else {
            Color32::from(Rgba::from_rgb(scale * red, scale * green, scale * blue))
        };
        Some(Mark { index, kind, shape, anchor, place, color, off })
    }

    /// The point of the picture's edge nearest to a light outside of it.
    fn edge(&self, mark: &Mark) -> Pos2 {
        let camera = self.projection.camera();
        let towards = mark.anchor - camera.position;
        let way = vec2(towards.dot(camera.right) as f32, -towards.dot(camera.up) as f32);
        let mut room = self.projection.rect().shrink(20.0);
        // The toolbar covers the upper edge of the picture.
        room.min.y = (room.min.y + super::toolbar::HEIGHT).min(room.center().y);
        let way = if way.length() > 1e-6 { way.normalized() } else { vec2(0.0, -1.0) };
        let across = |half: f32, along: f32| if along.abs() > 1e-6 { half / along.abs() } else { f32::INFINITY };
        let reach = across(0.5 * room.width(), way.x).min(across(0.5 * room.height(), way.y));
        room.center() + way * reach.max(0.0)
    }

    fn sun_distance(&self) -> f64 {
        let in_picture = SUN_IN_PICTURE * f64::from(self.projection.rect().height());
        (SUN_DISTANCE * self.radius).min(in_picture * self.projection.units_per_point(self.center))
    }

    /// Shows one light. Returns whether it was selected. `shown` is the light in the picture, `spec` is edited.
    fn light(&self, mark: &Mark, shown: &LightSettings, spec: &mut LightSettings, is_chosen: bool) -> bool {
        let mut touched = false;
        draw::shape(&self.painter, self.projection, mark);
        if is_chosen {
            draw::path(&self.painter, self.projection, shown, mark.color);
            if let LightKind::Spot { axis, inner_rad, outer_rad, .. } = mark.kind {
                touched |= self.spot(mark, spec, axis, (inner_rad, outer_rad));
            }
        }
        let (place, start) = mark.place.map_or_else(|| (self.edge(mark), self.center), |place| (place, mark.anchor));
        if is_chosen && mark.place.is_some() && !matches!(mark.kind, LightKind::Directional { .. }) {
            touched |= self.arms(mark, spec, place);
        }
        let response = self.handle(mark, Part::Body, place);
        let name = name_of(mark.index, shown);
        exported_handle(self, &response, mark.index, "handle", &name, &coordinates(mark));
        if let Some((grab, pointer)) = self.grabbed(&response, mark, Part::Body, start) {
            self.drag_body(mark, spec, grab, pointer);
            touched = true;
        }
        if mark.place.is_some() {
            draw::light(&self.painter, self.projection, mark, is_chosen || response.hovered());
        } else {
            draw::off_screen(&self.painter, self.projection.rect(), place, mark);
        }
        if is_chosen {
            draw::selected(&self.painter, place, colors::ACCENT.of(self.ui));
        }
        if response.hovered() || response.dragged() {
            let where_to = if mark.place.is_some() { "" } else { tr!("scene-outside-of-the-picture-drag-to") };
            let text = format!("{name}   {}{where_to}", coordinates(mark));
            let below = place + vec2(0.0, draw::RADIUS + 14.0);
            let color = self.ui.visuals().strong_text_color();
            paint::label(self.ui, &self.painter, self.projection.rect(), below, Align2::CENTER_TOP, &text, color);
        }
        touched || response.clicked()
    }

    fn drag_body(&self, mark: &Mark, spec: &mut LightSettings, grab: Grab, pointer: Pos2) {
        let place = pointer + grab.offset;
        if let LightKind::Directional { .. } = mark.kind {
            let far_side = grab.far_side != self.ui.input(|i| i.modifiers.shift);
            let towards = drag::on_sphere(self.projection, self.center, self.sun_distance(), place, far_side);
            // Four decimals of a direction are finer than a point of any window.
            spec.direction = Some(drag::tidy(-towards, 2e-4).to_array());
            return;
        }
        let mut target = drag::in_screen_plane(self.projection, grab.start, place);
        if grab.along != 0.0 {
            target = drag::along_view(self.projection, target, grab.along);
        }
        let unit = self.projection.units_per_point(target);
        drag::place_light(spec, drag::tidy(target, unit), self.time);
    }

    /// The arms along the axes. Returns whether one was dragged.
    fn arms(&self, mark: &Mark, spec: &mut LightSettings, place: Pos2) -> bool {
        let mut touched = false;
        let length = ARM * self.projection.units_per_point(mark.anchor);
        let tints = [colors::AXIS_X, colors::AXIS_Y, colors::AXIS_Z];
        for (number, (axis, tint)) in DVec3::AXES.into_iter().zip(tints).enumerate() {
            let end = mark.anchor + axis * length;
            let Some(tip) = self.projection.to_window(end) else { continue };
            // An arm that points to the viewer cannot be dragged.
            if tip.distance(place) < 12.0 {
                continue;
            }
            let response = self.handle(mark, Part::Arm(number), tip);
            let letter = ["x", "y", "z"][number];
            exported_handle(self, &response, mark.index, letter, letter, "");
            let color = tint.in_theme(true);
            let width = if response.hovered() || response.dragged() { 3.5 } else { 2.0 };
            let from = place + (tip - place).normalized() * (draw::RADIUS + 8.0);
            paint::arrow(&self.painter, from, tip, width, color);
            if let Some((grab, pointer)) = self.grabbed(&response, mark, Part::Arm(number), end) {
                let along = drag::along_axis(self.projection, grab.start, axis, pointer + grab.offset);
                if let Some(end) = along {
                    let target = grab.anchor + axis * axis.dot(end - grab.start);
                    let tidied = drag::tidy(target, self.projection.units_per_point(target));
                    // Only the dragged coordinate is rounded.
                    let target = target + axis * axis.dot(tidied - target);
                    drag::place_light(spec, target, self.time);
                }
                touched = true;
            }
        }
        touched
    }

    /// A spot's cone and the two handles at its end. Returns whether one was dragged.
    fn spot(&self, mark: &Mark, spec: &mut LightSettings, axis: DVec3, (inner, outer): (f64, f64)) -> bool {
        let reach = (self.center - mark.anchor).dot(axis).max(0.35 * self.radius);
        let end = mark.anchor + axis * reach;
        let widest = WIDEST_SPOT.to_radians();
        let is_flat = matches!(mark.shape, LightShape::Rectangle { .. });
        if !is_flat {
            draw::cone(&self.painter, self.projection, mark, end, (inner.min(widest), outer.min(widest)));
        }
        let mut touched = false;
        if let Some(place) = self.projection.to_window(end) {
            let response = self.handle(mark, Part::AxisEnd, place);
            exported_handle(self, &response, mark.index, "axis", tr!("scene-direction-of-the-light"), "");
            let radius = if response.hovered() || response.dragged() { 6.0 } else { 4.5 };
            paint::disc(&self.painter, place, radius, mark.color, false);
            if let Some(from) = mark.place {
                paint::dashes(&self.painter, [from, place], 1.0, mark.color);
            }
            if let Some((grab, pointer)) = self.grabbed(&response, mark, Part::AxisEnd, end) {
                let target = drag::in_screen_plane(self.projection, grab.start, pointer + grab.offset);
                if let Some(direction) = gonio_light::vector::unit(target - mark.anchor) {
                    spec.direction = Some(drag::tidy(direction, 2e-4).to_array());
                }
                touched = true;
            }
        }
        if is_flat {
            return touched;
        }
        // To the right in the picture, where the circle appears widest.
        let right = self.projection.camera().right;
        let side = gonio_light::vector::unit(right - axis * right.dot(axis))
            .unwrap_or_else(|| gonio_light::vector::any_orthonormal_vector(axis));
        let rim = end + side * (reach * outer.min(widest).tan());
        if let Some(place) = self.projection.to_window(rim) {
            let response = self.handle(mark, Part::Rim, place);
            exported_handle(
                self,
                &response,
                mark.index,
                "angle",
                tr!("scene-outer-angle-2"),
                &outer.to_degrees().to_string(),
            );
            let radius = if response.hovered() || response.dragged() { 6.0 } else { 4.5 };
            paint::disc(&self.painter, place, radius, Color32::WHITE, false);
            if let Some((grab, pointer)) = self.grabbed(&response, mark, Part::Rim, rim) {
                // The rim moves along the line from the end of the axis.
                if let Some(at) = drag::along_axis(self.projection, grab.start, side, pointer + grab.offset) {
                    let angle = ((at - end).dot(side) / reach).atan().to_degrees().clamp(0.5, WIDEST_SPOT);
                    let ratio = if outer > 0.0 { inner / outer } else { 1.0 };
                    let angle = (angle * 10.0).round() / 10.0;
                    spec.outer_angle = angle;
                    spec.inner_angle = (angle * ratio * 10.0).round().min(angle * 10.0) / 10.0;
                }
                touched = true;
            }
            if response.hovered() || response.dragged() {
                let text = format!("{:.1} deg", outer.to_degrees());
                let color = self.ui.visuals().strong_text_color();
                let beside = place + vec2(12.0, 0.0);
                paint::label(self.ui, &self.painter, self.projection.rect(), beside, Align2::LEFT_CENTER, &text, color);
            }
        }
        touched
    }

    fn id(&self, mark: &Mark, part: Part) -> Id {
        self.ui.scope_id().with(("light", self.pane, mark.index, part))
    }

    /// The invisible square of a handle.
    fn handle(&self, mark: &Mark, part: Part, place: Pos2) -> Response {
        let by_finger = self.ui.input(|i| i.any_touches());
        let hit = if by_finger { HIT_BY_FINGER } else { HIT };
        let rect = Rect::from_center_size(place, Vec2::splat(2.0 * hit)).intersect(self.projection.rect());
        let response = self.ui.interact(rect, self.id(mark, part), Sense::click_and_drag());
        response.on_hover_and_drag_cursor(CursorIcon::Move)
    }

    /// The start of the drag and the pointer, while the handle is dragged.
    fn grabbed(&self, response: &Response, mark: &Mark, part: Part, start: DVec3) -> Option<(Grab, Pos2)> {
        let id = self.id(mark, part);
        let pointer = response.interact_pointer_pos()?;
        if response.drag_started() {
            // A light outside of the picture moves to the pointer.
            let is_outside = part == Part::Body && mark.place.is_none();
            // The place where the button was pressed, not the pointer's current one.
            let origin = self.ui.input(|i| i.pointer.press_origin()).unwrap_or(pointer);
            let place = if is_outside { origin } else { self.projection.to_window(start)? };
            let camera = self.projection.camera();
            let far_side = (start - self.center).dot(start - camera.position) > 0.0;
            let grab = Grab { offset: place - origin, start, anchor: mark.anchor, along: 0.0, far_side };
            self.ui.data_mut(|data| data.insert_temp(id, grab));
        }
        if !response.is_dragged() {
            return None;
        }
        let mut grab = self.ui.data(|data| data.get_temp::<Grab>(id))?;
        let turns = matches!(mark.kind, LightKind::Directional { .. });
        if part == Part::Body && !turns && self.ui.input(|i| i.modifiers.shift) {
            // Dragging up moves away from the eye. The place in the picture stays, so the offset compensates the movement.
            let way = response.way();
            grab.along -= way.y;
            grab.offset -= way;
            self.ui.data_mut(|data| data.insert_temp(id, grab));
        }
        self.ui.ctx().request_repaint();
        Some((grab, pointer))
    }
}

fn exported_handle(handles: &Handles<'_>, response: &Response, light: usize, part: &str, label: &str, value: &str) {
    let label = label.to_owned();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
    // Ids are unique, so only one pane exports its handles.
    if handles.leads {
        let id = format!("light-{light}-{part}");
        exported::note(handles.ui, response, &id, WidgetRole::Handle, &label, value);
    }
}

fn name_of(index: usize, spec: &LightSettings) -> String {
    if spec.name.is_empty() {
        tr!("scene-light-2", name = gonio_language::name(spec.kind.name()), index = index)
    } else {
        spec.name.clone()
    }
}

/// Position or direction of a light as text.
fn coordinates(mark: &Mark) -> String {
    let v = match mark.kind {
        LightKind::Directional { direction } => direction,
        _ => mark.anchor,
    };
    let v = drag::tidy(v, 2e-3) + DVec3::ZERO;
    format!("({}, {}, {})", v.x, v.y, v.z)
}
