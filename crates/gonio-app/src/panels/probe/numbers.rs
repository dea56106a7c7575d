//! Numbers of a probe: of one width, so that nothing jumps while the pointer moves.

use egui::{Align, Color32, Layout, RichText, Ui, vec2};
use glam::DVec3;
use gonio_light::is_noise;

/// Width of a number's column, points.
const WIDTH: f32 = 49.0;

/// Formats a number with four decimals, or an exponent where that would hide it. Numerical noise is 0.
pub fn number(v: f64) -> String {
    if is_noise(v) {
        return "0".to_owned();
    }
    let size = v.abs();
    match size {
        _ if !v.is_finite() => "-".to_owned(),
        _ if (1e-3..10.0).contains(&size) => format!("{v:.4}"),
        _ if (10.0..1000.0).contains(&size) => format!("{v:.2}"),
        _ if (1000.0..1e5).contains(&size) => format!("{v:.0}"),
        _ => format!("{v:.0e}"),
    }
}

/// [`number`] without zeros at its end.
pub fn short(v: f64) -> String {
    let text = number(v);
    let plain = text.contains('.') && !text.contains('e');
    if plain { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Three numbers in a row.
pub fn triple(v: DVec3) -> String {
    format!("{} {} {}", number(v.x), number(v.y), number(v.z))
}

/// `#rrggbb`
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number in a cell of its own, flush right.
pub fn cell(ui: &mut Ui, v: f64, color: Option<Color32>) {
    let text = RichText::new(number(v)).monospace().size(11.5);
    let text = if let Some(color) = color { text.color(color) } else { text };
    ui.allocate_ui_with_layout(vec2(WIDTH, 16.0), Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_width(WIDTH);
        ui.label(text);
    });
}

/// A row of a grid: a name and three numbers.
pub fn vector_row(ui: &mut Ui, name: &str, tip: &str, v: DVec3, color: Option<Color32>) {
    let text = RichText::new(name);
    let response = ui.label(if let Some(color) = color { text.color(color) } else { text });
    if !tip.is_empty() {
        response.on_hover_text(tip);
    }
    for c in v.to_array() {
        cell(ui, c, None);
    }
    ui.end_row();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_width() {
        for (v, text) in [
            (0.0, "0"),
            (0.51234, "0.5123"),
            (-1.0, "-1.0000"),
            (54.321, "54.32"),
            (12345.6, "12346"),
            (1.2e-7, "1e-7"),
            (0.5e-46, "0"),
            (f64::INFINITY, "-"),
        ] {
            assert_eq!(number(v), text);
            assert!(number(v).len() <= 7);
        }
        assert_eq!(short(0.5), "0.5");
        assert_eq!(short(-2.0), "-2");
    }
}
