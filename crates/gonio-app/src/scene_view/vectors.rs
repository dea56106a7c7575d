//! The probe in the picture: N, L, V, R and H as arrows from the point on the model.

use super::{Projection, paint};
use crate::session::Selection;
use crate::session::probing::{Probing, Reading};
use crate::theme::{self, colors};
use egui::{Align2, Color32, Painter, Pos2, Rect, Stroke, Ui, Vec2};
use glam::DVec3;
use gonio_light::{LightKind, LightTerms};
use gonio_reference::Probe;

/// Length of an arrow parallel to the picture, as a share of the picture's height.
const LENGTH: f64 = 1.0 / 8.0;

/// Shows the vectors of the probed pixel, and a ring around a pinned one.
pub fn show(ui: &Ui, projection: &Projection, probing: &Probing, selection: Selection) {
    let rect = projection.rect();
    let painter = ui.painter_at(rect);
    if let Some(reading) = probing.reading()
        && let Some(probe) = &reading.probe
    {
        arrows(ui, &painter, projection, reading, probe, selection);
    }
    if let Some([x, y]) = probing.pinned {
        pin(&painter, rect.min + rect.size() * Vec2::new(x as f32, y as f32));
    }
}

/// The light whose R and H are shown: the selected one, or else the one that contributes most.
pub(super) fn leading(probe: &Probe, selection: Selection) -> Option<&LightTerms> {
    let lights = &probe.terms.lights;
    if let Selection::Light(index) = selection
        && let Some(chosen) = lights.iter().find(|light| light.light == index)
    {
        return Some(chosen);
    }
    let added = |light: &LightTerms| (light.diffuse + light.specular).element_sum();
    lights.iter().max_by(|a, b| added(a).total_cmp(&added(b)))
}

fn arrows(ui: &Ui, painter: &Painter, projection: &Projection, reading: &Reading, probe: &Probe, chosen: Selection) {
    let point = probe.position;
    let Some(origin) = projection.to_window(point) else { return };
    let length = LENGTH * f64::from(projection.rect().height()) * projection.units_per_point(point);
    let leading = leading(probe, chosen);
    // The colours of the dark theme, because most pictures are dark and each arrow has a dark rim.
    let mut labels: Vec<(Pos2, &'static str, Option<usize>, Color32)> = Vec::new();
    let mut arrow = |direction: DVec3, symbol: &'static str, light: Option<usize>, tint: colors::Tint, width: f32| {
        let color = tint.in_theme(true);
        let Some(tip) = projection.to_window(point + length * direction) else { return };
        paint::arrow(painter, origin, tip, width, color);
        labels.push((tip, symbol, light, color));
    };
    let several = probe.terms.lights.len() > 1;
    for light in &probe.terms.lights {
        let leads = leading.is_some_and(|l| l.light == light.light);
        let place = match reading.frame.lights.get(light.light).map(|l| l.kind) {
            Some(LightKind::Point { position } | LightKind::Spot { position, .. }) => projection.to_window(position),
            _ => None,
        };
        if let (Some(place), Some(tip)) = (place, projection.to_window(point + length * light.l)) {
            paint::dashes(painter, [tip, place], 1.0, colors::LIGHT.in_theme(true).gamma_multiply(0.8));
        }
        arrow(light.l, "L", several.then_some(light.light), colors::LIGHT, if leads { 2.5 } else { 1.6 });
    }
    if let Some(light) = leading {
        arrow(light.r, "R", None, colors::REFLECTION, 2.0);
        arrow(light.h, "H", None, colors::HALF, 2.0);
    }
    arrow(probe.terms.point.view, "V", None, colors::VIEW, 2.0);
    arrow(probe.terms.point.normal, "N", None, colors::NORMAL, 3.0);
    painter.circle(origin, 3.0, Color32::WHITE, Stroke::new(1.5, Color32::BLACK));
    let mut taken: Vec<Rect> = Vec::new();
    for (tip, symbol, light, color) in labels.into_iter().rev() {
        let text = light.map_or_else(|| symbol.to_owned(), |index| format!("{symbol}{index}"));
        name(ui, painter, projection.rect(), &mut taken, (origin, tip), &text, color);
    }
}

/// A letter beyond an arrow's tip, moved outwards if it would overlap another one.
fn name(
    ui: &Ui,
    painter: &Painter,
    within: Rect,
    taken: &mut Vec<Rect>,
    along: (Pos2, Pos2),
    text: &str,
    ink: Color32,
) {
    let (origin, tip) = along;
    let ahead = if (tip - origin).length() > 1.0 { (tip - origin).normalized() } else { Vec2::new(0.0, -1.0) };
    // The light theme's plate is too bright for these colours.
    let plate = if ui.visuals().dark_mode { ui.visuals().window_fill } else { Color32::from_gray(40) };
    let galley = painter.layout_no_wrap(text.to_owned(), theme::math_italic_font(17.0), ink);
    let size = galley.size() + Vec2::new(8.0, 2.0);
    let mut rect = Align2::CENTER_CENTER.anchor_size(tip + ahead * 13.0, size);
    for _ in 0..8 {
        if !taken.iter().any(|other| other.intersects(rect)) {
            break;
        }
        rect = rect.translate(ahead * 10.0);
    }
    if !within.contains_rect(rect) {
        let push = |low: f32, high: f32, min: f32, max: f32| (min - low).max(0.0) - (high - max).max(0.0);
        let x = push(rect.left(), rect.right(), within.left(), within.right());
        let y = push(rect.top(), rect.bottom(), within.top(), within.bottom());
        rect = rect.translate(Vec2::new(x, y));
    }
    painter.rect_filled(rect, 4.0, plate.gamma_multiply(0.78));
    painter.galley(rect.min + Vec2::new(4.0, 1.0), galley, ink);
    taken.push(rect);
}

/// A ring around the pinned pixel.
fn pin(painter: &Painter, place: Pos2) {
    painter.circle_stroke(place, 8.0, Stroke::new(3.5, Color32::from_black_alpha(150)));
    painter.circle_stroke(place, 8.0, Stroke::new(1.6, Color32::WHITE));
}
