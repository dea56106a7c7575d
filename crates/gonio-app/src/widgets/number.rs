//! Numbers: dragged, typed, or reset by a double click; one or three along the axes. Large counts in groups of digits.

use crate::exported::{self, WidgetRole};
use crate::theme::colors::{AXIS_X, AXIS_Y, AXIS_Z, Tint};
use egui::{DragValue, Rect, Response, Sense, Slider, TextStyle, Ui, UiBuilder, pos2, vec2};
use gonio_language::tr;
use gonio_light::is_noise;
use std::ops::RangeInclusive;

/// A field for a number.
#[derive(Clone, Debug)]
pub struct NumberField<'a> {
    id: &'a str,
    label: &'a str,
    tip: &'a str,
    unit: &'static str,
    range: RangeInclusive<f64>,
    default: Option<f64>,
    step: Option<f64>,
    width: f32,
    whole: bool,
}

impl<'a> NumberField<'a> {
    /// Creates a field for any finite number. `id` is stable and kebab-case, `label` is its name.
    pub fn new(id: &'a str, label: &'a str) -> Self {
        NumberField {
            id,
            label,
            tip: "",
            unit: "",
            range: -1e15..=1e15,
            default: None,
            step: None,
            width: 78.0,
            whole: false,
        }
    }

    /// Sets the description, with the symbol.
    pub fn tip(self, tip: &'a str) -> Self {
        NumberField { tip, ..self }
    }

    /// Sets the unit, which is shown after the number.
    pub fn unit(self, unit: &'static str) -> Self {
        NumberField { unit, ..self }
    }

    /// Sets the range, including both ends.
    pub fn range(self, range: RangeInclusive<f64>) -> Self {
        NumberField { range, ..self }
    }

    /// Sets the default, which a double click restores.
    pub fn default(self, default: f64) -> Self {
        NumberField { default: Some(default), ..self }
    }

    /// Sets the change per point of a drag; by default it depends on the number's size.
    pub fn step(self, step: f64) -> Self {
        NumberField { step: Some(step), ..self }
    }

    /// Sets the width, points.
    pub fn width(self, width: f32) -> Self {
        NumberField { width, ..self }
    }

    /// Restricts the field to whole numbers.
    pub fn whole(self) -> Self {
        NumberField { whole: true, ..self }
    }

    /// Shows the field. The value is edited in place.
    pub fn show(self, ui: &mut Ui, value: &mut f64) -> Response {
        let before = *value;
        let step = self.step.unwrap_or_else(|| step_of(before, &self.range));
        let whole = self.whole;
        let mut edited = before;
        // A fixed size, so that neighbours stay on the line and nothing moves while the number changes.
        let size = vec2(self.width, ui.spacing().interact_size.y);
        let (room, _) = ui.allocate_exact_size(size, Sense::hover());
        let response = ui
            .scope_builder(UiBuilder::new().max_rect(room).id_salt(self.id), |ui| {
                let style = ui.style_mut();
                style.drag_value_text_style = TextStyle::Monospace;
                style.spacing.button_padding = vec2(4.0, 2.0);
                let drag = DragValue::new(&mut edited)
                    .range(self.range.clone())
                    .clamp_existing_to_range(false)
                    .speed(step)
                    .min_size(size)
                    .clip_text(true)
                    .update_while_editing(false)
                    .custom_formatter(move |v, _| if whole { format!("{v:.0}") } else { compact(v) })
                    .custom_parser(parsed)
                    .suffix(self.unit);
                ui.put(room, drag)
            })
            .inner;
        if edited.is_finite() && edited != before {
            *value = if whole { edited.round() } else { edited };
        }
        if let Some(default) = self.default
            && response.double_clicked()
        {
            *value = default;
            // The first click started to edit the text.
            response.surrender_focus();
        }
        // Dragging past zero may leave -0.
        *value += 0.0;
        let response = response.accessible_name(self.label);
        exported::note(ui, &response, self.id, WidgetRole::Number, self.label, *value);
        let tip = self.explanation();
        response.on_hover_ui(|ui| {
            ui.label(tip);
        })
    }

    /// Shows the field with a slider before it, over the rest of the line. Returns whether the value was changed.
    pub fn show_with_slider(self, ui: &mut Ui, value: &mut f64, logarithmic: bool) -> bool {
        let before = *value;
        let mut slid = before;
        let gap = ui.spacing().item_spacing.x;
        ui.spacing_mut().slider_width = (ui.available_width() - self.width - 2.0 * gap).clamp(40.0, 320.0);
        let slider = Slider::new(&mut slid, self.range.clone()).logarithmic(logarithmic).show_value(false);
        let response = ui.add(slider);
        exported::note(ui, &response, &format!("{}-slider", self.id), WidgetRole::Number, self.label, slid);
        if response.changed() {
            // Three digits are as fine as a slider; written and read, they are short in every text.
            let size = if logarithmic { slid.abs() } else { self.range.end() - self.range.start() };
            let decimals = (2.0 - size.max(1e-12).log10().floor()).clamp(0.0, 14.0) as usize;
            let rounded = format!("{slid:.decimals$}").parse().unwrap_or(slid);
            *value = rounded.clamp(*self.range.start(), *self.range.end());
        }
        self.show(ui, value);
        *value != before
    }

    /// Shows the field for an f32.
    pub fn show_f32(self, ui: &mut Ui, value: &mut f32) -> Response {
        let mut wide = f64::from(*value);
        let response = self.show(ui, &mut wide);
        if wide != f64::from(*value) {
            *value = wide as f32;
        }
        response
    }

    fn explanation(&self) -> String {
        let mut text = if self.tip.is_empty() { self.label.to_owned() } else { self.tip.to_owned() };
        let (low, high) = (*self.range.start(), *self.range.end());
        let unit = self.unit;
        if high < 1e14 {
            text += "\n";
            text += &tr!("window-from-to", low = compact(low), unit = unit, high = compact(high));
        } else if low >= 0.0 {
            text += "\n";
            text += &tr!("window-at-least", low = compact(low), unit = unit);
        }
        if let Some(default) = self.default {
            text += "\n";
            text += &tr!("window-double-click-2", default = compact(default), unit = unit);
        }
        text
    }
}

/// The change per point of a drag: about a hundredth of the number, or a fraction of a small range.
fn step_of(value: f64, range: &RangeInclusive<f64>) -> f64 {
    let extent = range.end() - range.start();
    if extent <= 200.0 {
        return extent / 300.0;
    }
    (0.01 * value.abs()).clamp(0.01, 1e12)
}

/// Formats a number with up to four decimals, in about seven characters at most. Numerical noise is 0.
pub fn compact(v: f64) -> String {
    if is_noise(v) {
        return "0".to_owned();
    }
    let size = v.abs();
    if !(1e-4..1e6).contains(&size) {
        return format!("{v:.2e}");
    }
    let decimals = match size {
        s if s >= 10_000.0 => 0,
        s if s >= 1000.0 => 1,
        s if s >= 100.0 => 2,
        s if s >= 1.0 => 3,
        _ => 4,
    };
    let text = format!("{v:.decimals$}");
    let text = if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Parses a typed number, with a decimal point or comma, and with or without unit. Only finite numbers are accepted.
fn parsed(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".").replace('\u{2212}', "-");
    let text = text.trim_end_matches(|c: char| c.is_whitespace() || c == '\u{b0}' || (c.is_alphabetic()));
    text.trim().parse::<f64>().ok().filter(|v| v.is_finite())
}

/// Names and colours of the axes.
pub fn axes() -> [(&'static str, Tint); 3] {
    [("x", AXIS_X), ("y", AXIS_Y), ("z", AXIS_Z)]
}

/// A field for three numbers along the axes.
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
    /// Creates a field for three numbers. `id` is stable and kebab-case; its parts have the suffixes `-x`, `-y` and `-z`.
    pub fn new(id: &'a str, label: &'a str) -> Self {
        Vector { id, label, tip: "", unit: "", default: None, range: -1e15..=1e15, step: None }
    }

    /// Sets the description, with symbol, space and unit.
    pub fn tip(self, tip: &'a str) -> Self {
        Vector { tip, ..self }
    }

    /// Sets the unit, which is shown after each number.
    pub fn unit(self, unit: &'static str) -> Self {
        Vector { unit, ..self }
    }

    /// Sets the default; a double click restores one number.
    pub fn default(self, default: [f64; 3]) -> Self {
        Vector { default: Some(default), ..self }
    }

    /// Sets the range of each number.
    pub fn range(self, range: RangeInclusive<f64>) -> Self {
        Vector { range, ..self }
    }

    /// Sets the change per point of a drag.
    pub fn step(self, step: f64) -> Self {
        Vector { step: Some(step), ..self }
    }

    /// Shows the three numbers in the rest of the line. Returns whether any was changed.
    pub fn show(self, ui: &mut Ui, value: &mut [f64; 3]) -> bool {
        const GAP: f32 = 4.0;
        ui.spacing_mut().item_spacing.x = GAP;
        let width = ((ui.available_width() - 2.0 * GAP) / 3.0).floor().clamp(48.0, 96.0);
        let before = *value;
        for ((part, (axis, tint)), i) in value.iter_mut().zip(axes()).zip(0..) {
            let (id, label) = (format!("{}-{axis}", self.id), format!("{} {axis}", self.label));
            let tip = if self.tip.is_empty() { label.clone() } else { format!("{}: {axis}", self.tip) };
            let mut number =
                NumberField::new(&id, &label).tip(&tip).unit(self.unit).width(width).range(self.range.clone());
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

/// A space at which lines may be broken.
pub const SPACE: char = ' ';
/// A space at which lines are not broken.
pub const NO_BREAK: char = '\u{a0}';

/// Formats a count with `gap` between groups of three digits.
pub fn grouped(number: u64, gap: char) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 * gap.len_utf8());
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(gap);
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_true() {
        for (value, shown) in [
            (0.0, "0"),
            (-0.0, "0"),
            (0.5e-46, "0"),
            (1.5, "1.5"),
            (0.125, "0.125"),
            (-2.0, "-2"),
            (123.456, "123.46"),
            (1e-7, "1.00e-7"),
            (12_345_678.0, "1.23e7"),
            (100.0, "100"),
            (40_000.0, "40000"),
        ] {
            assert_eq!(compact(value), shown);
        }
    }

    #[test]
    fn typed_numbers_may_have_comma_and_unit() {
        assert_eq!(parsed(" 1,5 "), Some(1.5));
        assert_eq!(parsed("45\u{b0}"), Some(45.0));
        assert_eq!(parsed("2 s"), Some(2.0));
        assert_eq!(parsed("1e3"), Some(1000.0));
        assert_eq!(parsed("\u{2212}3"), Some(-3.0));
        for nothing in ["", "inf", "NaN", "abc", "1 2"] {
            assert_eq!(parsed(nothing), None, "{nothing}");
        }
    }

    #[test]
    fn digits_are_grouped_by_three() {
        let numbers = [(0, "0"), (999, "999"), (1000, "1 000"), (12345, "12 345"), (1_234_567, "1 234 567")];
        for (number, text) in numbers {
            assert_eq!(grouped(number, SPACE), text);
        }
        for (number, text) in [(0, "0"), (999, "999"), (1000, "1\u{a0}000"), (1_234_567, "1\u{a0}234\u{a0}567")] {
            assert_eq!(grouped(number, NO_BREAK), text);
        }
    }
}
