//! Panes side by side, one wiped over the other, or their difference with its scale.

use super::axes;
use super::drawing::PaneRenderer;
use super::navigation::Dragging;
use super::paint::present;
use super::pane::{self, caption, drawn, over};
use crate::document::{Document, PaneArrangement};
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::colors;
use crate::truth::REPAINT_DELAY;
use egui::{
    Align2, Color32, CornerRadius, CursorIcon, Mesh, Rect, Sense, Stroke, StrokeKind, TextStyle, Ui, pos2, vec2,
};
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_scene::difference::{heat, signed};

/// Gap between panes, points.
const GAP: f32 = 2.0;
/// Half the width of the divider's handle, points: wide enough for a finger.
const HOLD: f32 = 22.0;
/// Background of captions.
const GROUND: Color32 = Color32::from_black_alpha(150);
const INK: Color32 = Color32::from_gray(0xf2);

/// Rectangles for `count` panes: side by side, four in two rows; stacked in an upright room.
pub fn arranged(room: Rect, count: usize) -> Vec<Rect> {
    let count = count.max(1);
    let columns = match count {
        4 => 2,
        _ if room.height() > room.width() => 1,
        _ => count,
    };
    let rows = count.div_ceil(columns);
    let width = (room.width() - GAP * (columns as f32 - 1.0)) / columns as f32;
    let height = (room.height() - GAP * (rows as f32 - 1.0)) / rows as f32;
    (0..count)
        .map(|i| {
            let (column, row) = ((i % columns) as f32, (i / columns) as f32);
            let min = room.min + vec2(column * (width + GAP), row * (height + GAP));
            Rect::from_min_size(min, vec2(width, height))
        })
        .collect()
}

/// A pane's caption, and a frame around the current one; nothing for a single pane without settings of its own.
pub fn label(ui: &Ui, index: usize, rect: Rect, document: &Document, session: &Session) {
    let panes = &document.panes;
    if panes.list.len() > 1 {
        let stroke = if index == panes.current {
            Stroke::new(2.0, colors::ACCENT.in_theme(true))
        } else {
            Stroke::new(1.0, Color32::from_black_alpha(90))
        };
        ui.painter().rect_stroke(rect, CornerRadius::ZERO, stroke, StrokeKind::Inside);
    } else if panes.list.first().is_none_or(|pane| pane.words().is_empty()) {
        return;
    }
    let mut text = caption(document, session, index);
    if session.comparison.panes.get(index).is_some_and(|facts| facts.preparing) {
        text.push_str(tr!("scene-simplifying"));
    }
    written(ui, rect, if panes.is_leading(index) { axes::extent(rect) } else { 0.0 }, text);
}

/// A caption at the lower edge of a rectangle, in up to three lines, and truncated if it is longer. It does not cover the axes,
/// which take this much of the lower left corner.
fn written(ui: &Ui, rect: Rect, axes: f32, text: String) {
    let laid = |room: Rect| {
        let style = TextStyle::Body.resolve(ui.style());
        let mut job = egui::text::LayoutJob::simple(text.clone(), style, INK, (room.width() - 16.0).max(20.0));
        job.wrap.max_rows = 3;
        let galley = ui.painter().layout_job(job);
        (Align2::CENTER_BOTTOM.align_size_within_rect(galley.size() + vec2(16.0, 8.0), room), galley)
    };
    let mut room = rect.shrink(10.0);
    let (mut place, mut galley) = laid(room);
    if place.left() < rect.left() + axes {
        if room.right() - axes - rect.left() > 150.0 {
            room.min.x = rect.left() + axes;
        } else {
            room.max.y = rect.bottom() - axes;
        }
        (place, galley) = laid(room);
    }
    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_filled(place, CornerRadius::same(6), GROUND);
    painter.galley(place.min + vec2(8.0, 4.0), galley, INK);
}

/// The pair of panes on top of each other, with a divider to drag.
pub fn wipe(
    ui: &mut Ui,
    room: Rect,
    share: f32,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    let [first, second] = document.panes.pair;
    // The second fills the room and handles the pointer.
    let whole = pane::show(ui, second, room, document, session, pane_renderer)?;
    let picture = drawn(ui, first, room, document, session, pane_renderer)?;
    let mut x = room.left() + share.clamp(0.0, 1.0) * room.width();
    let hold = Rect::from_center_size(pos2(x, room.center().y), vec2(2.0 * HOLD, room.height()));
    let response = ui.interact(hold.intersect(room), ui.scope_id().with("wipe"), Sense::click_and_drag());
    exported::note(
        ui,
        &response,
        "wipe",
        WidgetRole::Handle,
        tr!("scene-divider-between-two-panes"),
        format!("{share:.3}"),
    );
    if response.double_clicked() {
        document.panes.arrangement = PaneArrangement::Wipe(0.5);
    } else if response.is_dragged()
        && let Some(place) = response.interact_pointer_pos()
    {
        x = place.x.clamp(room.left(), room.right());
        document.panes.arrangement = PaneArrangement::Wipe((x - room.left()) / room.width().max(1.0));
    }
    let active = response.hovered() || response.dragged();
    if active {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    let left = Rect::from_min_max(room.min, pos2(x, room.bottom()));
    let right = Rect::from_min_max(pos2(x, room.top()), room.max);
    if let Some(picture) = picture {
        // The picture is clipped to the part left of the divider.
        ui.scope(|ui| {
            ui.set_clip_rect(left.intersect(ui.clip_rect()));
            present(ui, room, picture);
            pane::ground(ui, first, room, session, pane_renderer)
        })
        .inner?;
    }
    over(ui, second, &whole, document, session, pane_renderer)?;
    divider(ui, room, x, active);
    for (index, part) in [(first, left), (second, right)] {
        // A narrow part has no room for a caption.
        if part.width() > 90.0 {
            let axes = if index == first { axes::extent(room) } else { 0.0 };
            written(ui, part, axes, caption(document, session, index));
        }
    }
    Ok(())
}

/// A vertical line, and a knob with two arrows in its middle.
fn divider(ui: &Ui, room: Rect, x: f32, active: bool) {
    let painter = ui.painter().with_clip_rect(room.intersect(ui.clip_rect()));
    let color = if active { colors::ACCENT.in_theme(true) } else { Color32::WHITE };
    painter.vline(x, room.y_range(), Stroke::new(3.0, Color32::from_black_alpha(110)));
    painter.vline(x, room.y_range(), Stroke::new(1.5, color));
    let center = pos2(x, room.center().y);
    painter.circle(center, 16.0, Color32::from_black_alpha(170), Stroke::new(1.5, color));
    for side in [-1.0, 1.0] {
        let [tip, back] = [9.0, 4.5].map(|distance| center.x + side * distance);
        let points = [pos2(back, center.y - 4.5), pos2(tip, center.y), pos2(back, center.y + 4.5)];
        painter.line(points.to_vec(), Stroke::new(1.8, color));
    }
}

/// The difference map of the pair, with its scale.
pub fn difference(
    ui: &mut Ui,
    room: Rect,
    document: &mut Document,
    session: &mut Session,
    pane_renderer: &mut PaneRenderer,
) -> Result<(), GlError> {
    let [first, second] = document.panes.pair;
    // The first is below the map and handles the pointer.
    let whole = pane::show(ui, first, room, document, session, pane_renderer)?;
    drawn(ui, second, room, document, session, pane_renderer)?;
    let before = session.comparison.difference.clone();
    let Some(map) = pane_renderer.difference(document, session)? else {
        over(ui, first, &whole, document, session, pane_renderer)?;
        written(ui, room, axes::extent(room), tr!("scene-the-difference-needs-both-pictures").to_owned());
        return Ok(());
    };
    if session.comparison.difference != before {
        // The panel has already been laid out in this frame.
        ui.ctx().request_repaint_after(REPAINT_DELAY);
    }
    present(ui, room, map);
    over(ui, first, &whole, document, session, pane_renderer)?;
    let settings = document.panes.difference;
    let scale = Scale { full_scale: settings.full_scale, signed: settings.signed };
    draw_scale(ui, room, &scale);
    if let Some(facts) = &session.comparison.difference
        && let Some([column, row]) = facts.worst
    {
        let [width, height] = facts.size.map(|side| side.max(1) as f32);
        let place = room.min + room.size() * vec2((column as f32 + 0.5) / width, (row as f32 + 0.5) / height);
        ui.painter().circle_stroke(place, 9.0, Stroke::new(3.0, Color32::from_black_alpha(140)));
        ui.painter().circle_stroke(place, 9.0, Stroke::new(1.5, Color32::WHITE));
    }
    let bracketed = |index| match caption(document, session, index).split_once(": ") {
        Some((name, facts)) => format!("{name} ({facts})"),
        None => caption(document, session, index),
    };
    let text = if settings.signed {
        tr!("scene-minus", second = bracketed(second), first = bracketed(first))
    } else {
        tr!("scene-difference-of-and", first = bracketed(first), second = bracketed(second))
    };
    written(ui, room, axes::extent(room), text);
    Ok(())
}

/// The scale of a map of differences.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    /// 8-bit steps of the last colour.
    full_scale: f64,
    /// Whether it ranges from minus to plus.
    signed: bool,
}

impl Scale {
    /// The colour of a share of the scale's length, 0 at its lower end.
    fn color(&self, share: f64) -> Color32 {
        let [r, g, b] = if self.signed { signed(2.0 * share - 1.0) } else { heat(share) };
        Color32::from_rgb(r, g, b)
    }

    /// Labels by their share of the scale's length.
    fn marks(&self) -> Vec<(f64, String)> {
        let number = |steps: f64| {
            let text = if steps.abs() < 10.0 { format!("{steps:.1}") } else { format!("{steps:.0}") };
            text.strip_suffix(".0").map_or(text.clone(), str::to_owned).replace('-', "−")
        };
        let full = self.full_scale;
        if self.signed {
            [(0.0, -full), (0.25, -0.5 * full), (0.5, 0.0), (0.75, 0.5 * full), (1.0, full)]
                .map(|(share, steps)| (share, if steps > 0.0 { format!("+{}", number(steps)) } else { number(steps) }))
                .into()
        } else {
            [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| (share, number(share * full))).into()
        }
    }
}

/// Draws the scale at the right edge of a map: a vertical bar with labels in 8-bit steps.
fn draw_scale(ui: &Ui, room: Rect, scale: &Scale) {
    let height = (0.5 * room.height()).clamp(80.0, 260.0);
    let ground = Rect::from_min_size(room.right_top() + vec2(-86.0, 12.0), vec2(74.0, height + 44.0));
    let painter = ui.painter().with_clip_rect(room.intersect(ui.clip_rect()));
    painter.rect_filled(ground, CornerRadius::same(6), Color32::from_black_alpha(170));
    painter.rect_stroke(
        ground,
        CornerRadius::same(6),
        Stroke::new(1.0, Color32::from_white_alpha(40)),
        StrokeKind::Inside,
    );
    let ink = Color32::from_gray(0xf2);
    let font = TextStyle::Small.resolve(ui.style());
    painter.text(ground.center_top() + vec2(0.0, 6.0), Align2::CENTER_TOP, tr!("scene-of-255"), font.clone(), ink);
    let bar = Rect::from_min_size(ground.left_top() + vec2(10.0, 30.0), vec2(16.0, height));
    let mut mesh = Mesh::default();
    const PIECES: u32 = 48;
    for piece in 0..=PIECES {
        let share = f64::from(piece) / f64::from(PIECES);
        let y = bar.bottom() - share as f32 * bar.height();
        let color = scale.color(share);
        mesh.colored_vertex(pos2(bar.left(), y), color);
        mesh.colored_vertex(pos2(bar.right(), y), color);
        if piece > 0 {
            let i = 2 * piece;
            mesh.add_triangle(i - 2, i - 1, i);
            mesh.add_triangle(i - 1, i, i + 1);
        }
    }
    painter.add(mesh);
    painter.rect_stroke(bar, CornerRadius::ZERO, Stroke::new(1.0, Color32::from_white_alpha(90)), StrokeKind::Outside);
    for (share, text) in scale.marks() {
        let y = bar.bottom() - share as f32 * bar.height();
        painter.hline(bar.right()..=bar.right() + 4.0, y, Stroke::new(1.0, ink));
        painter.text(pos2(bar.right() + 8.0, y), Align2::LEFT_CENTER, text, font.clone(), ink);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_fill_the_room_without_touching() {
        for size in [vec2(1000.0, 600.0), vec2(360.0, 500.0)] {
            let room = Rect::from_min_size(pos2(10.0, 20.0), size);
            for count in 1..=4 {
                let panes = arranged(room, count);
                assert_eq!(panes.len(), count);
                let area: f32 = panes.iter().map(Rect::area).sum();
                // The gaps: at most three, each as long as the longer side.
                assert!(area <= room.area() && area > room.area() - 3.0 * GAP * size.max_elem());
                for (i, a) in panes.iter().enumerate() {
                    assert!(room.expand(1e-3).contains_rect(*a));
                    assert!(panes[i + 1..].iter().all(|b| !a.intersects(*b)), "{count} in {size}");
                }
            }
        }
    }

    #[test]
    fn labels_are_beside_their_colours() {
        let scale = Scale { full_scale: 16.0, signed: false };
        let marks: Vec<String> = scale.marks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(marks, ["0", "4", "8", "12", "16"]);
        let scale = Scale { full_scale: 5.0, signed: true };
        let marks: Vec<String> = scale.marks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(marks, ["−5", "−2.5", "0", "+2.5", "+5"]);
        let [r, g, b] = signed(0.0);
        assert_eq!(scale.color(0.5), Color32::from_rgb(r, g, b));
    }
}
