//! Three numbers along the axes, each in its axis's colour.

use super::number::Number;
use crate::theme::colors::{AXIS_X, AXIS_Y, AXIS_Z, Tint};
use egui::{Rect, Response, Ui, pos2, vec2};
use std::ops::RangeInclusive;

/// Names and colours of the axes.
pub fn axes() -> [(&'static str, Tint); 3] {
    [("x", AXIS_X), ("y", AXIS_Y), ("z", AXIS_Z)]
}

/// Three numbers and what is known of them.
#[derive(Clone, Debug)]
pub struct Vector<'a> {
    id: &'a str,
    label: &'a str,
    tip: &'a str,
    unit: &'static str,
    default: Option<[f64; 3]>,
    range: RangeInclusive<f64>,
    step: Option<f64>,
}

impl<'a> Vector<'a> {
    /// Any three numbers. `id` is stable and kebab-case; its parts get `-x`, `-y` and `-z`.
    pub fn new(id: &'a str, label: &'a str) -> Self {
        Vector { id, label, tip: "", unit: "", default: None, range: -1e15..=1e15, step: None }
    }

    /// What it is, with its symbol, space and unit.
    pub fn tip(self, tip: &'a str) -> Self {
        Vector { tip, ..self }
    }

    /// Shown after each number.
    pub fn unit(self, unit: &'static str) -> Self {
        Vector { unit, ..self }
    }

    /// What a double click on a part makes of it.
    pub fn default(self, default: [f64; 3]) -> Self {
        Vector { default: Some(default), ..self }
    }

    /// What each may be.
    pub fn range(self, range: RangeInclusive<f64>) -> Self {
        Vector { range, ..self }
    }

    /// Change for each point that is dragged.
    pub fn step(self, step: f64) -> Self {
        Vector { step: Some(step), ..self }
    }

    /// Shows the three in the room that is left of the line; whether any was changed.
    pub fn show(self, ui: &mut Ui, value: &mut [f64; 3]) -> bool {
        const GAP: f32 = 4.0;
        ui.spacing_mut().item_spacing.x = GAP;
        let width = ((ui.available_width() - 2.0 * GAP) / 3.0).floor().clamp(48.0, 96.0);
        let before = *value;
        for ((part, (axis, tint)), i) in value.iter_mut().zip(axes()).zip(0..) {
            let (id, label) = (format!("{}-{axis}", self.id), format!("{} {axis}", self.label));
            let tip = if self.tip.is_empty() { label.clone() } else { format!("{}: {axis}", self.tip) };
            let mut number = Number::new(&id, &label).tip(&tip).unit(self.unit).width(width).range(self.range.clone());
            if let Some(default) = self.default {
                number = number.default(default[i]);
            }
            if let Some(step) = self.step {
                number = number.step(step);
            }
            let response = number.show(ui, part);
            underline(ui, &response, tint);
        }
        *value != before
    }
}

/// A line in the axis's colour below a number.
fn underline(ui: &Ui, response: &Response, tint: Tint) {
    let rect = response.rect;
    let line = Rect::from_min_size(pos2(rect.left() + 4.0, rect.bottom() - 2.0), vec2(rect.width() - 8.0, 1.5));
    ui.painter().rect_filled(line, 0.75, tint.of(ui).gamma_multiply(0.8));
}
