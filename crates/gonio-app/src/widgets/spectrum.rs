//! A plot of a spectrum.

use egui::{Align2, Color32, FontId, Mesh, Response, Rgba, Sense, Stroke, Ui, pos2, vec2};
use gonio_light::Spectrum;
use gonio_light::observer::{LAMBDA_MAX, LAMBDA_MIN};
use std::sync::LazyLock;

/// Height of the plot, points.
const HEIGHT: f32 = 58.0;
/// Pieces along the wavelengths.
const PIECES: usize = 100;

/// The colours of single wavelengths, between the pieces.
static COLORS: LazyLock<Vec<Color32>> = LazyLock::new(|| {
    let color = |piece| {
        let lambda = wavelength(piece);
        let color = Spectrum::new(vec![[lambda - 1.0, 0.0], [lambda, 1.0], [lambda + 1.0, 0.0]]).color_of_light();
        let color = color.map_or([0.0; 3], |color| (color / color.max_element().max(1e-9)).as_vec3().to_array());
        Color32::from(Rgba::from_rgb(color[0], color[1], color[2]))
    };
    (0..=PIECES).map(color).collect()
});

fn wavelength(piece: usize) -> f64 {
    LAMBDA_MIN + (LAMBDA_MAX - LAMBDA_MIN) * piece as f64 / PIECES as f64
}

/// Plots `value` of each visible wavelength in nm, at least 0. Its axis ends at `top`, or at the largest value.
pub fn spectrum(ui: &mut Ui, value: impl Fn(f64) -> f64, top: Option<f64>, tip: &str) -> Response {
    let width = (ui.available_width() - 4.0).min(300.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let painter = ui.painter();
    let weak = ui.visuals().weak_text_color();
    painter.rect_filled(rect, 4.0, ui.visuals().extreme_bg_color);
    let mut plot = rect.shrink2(vec2(6.0, 5.0));
    plot.max.y -= 11.0;
    let values: Vec<f64> = (0..=PIECES).map(|piece| value(wavelength(piece))).collect();
    let top = top.unwrap_or_else(|| values.iter().copied().fold(1e-9, f64::max));
    let mut area = Mesh::default();
    let mut line = Vec::new();
    for (piece, (value, color)) in values.iter().zip(COLORS.iter()).enumerate() {
        let x = plot.left() + plot.width() * piece as f32 / PIECES as f32;
        let y = plot.bottom() - plot.height() * (value / top).clamp(0.0, 1.0) as f32;
        area.colored_vertex(pos2(x, plot.bottom()), *color);
        area.colored_vertex(pos2(x, y), *color);
        line.push(pos2(x, y));
        let corner = 2 * piece as u32;
        if let Some(before) = corner.checked_sub(2) {
            area.add_triangle(before, before + 1, corner);
            area.add_triangle(before + 1, corner, corner + 1);
        }
    }
    painter.add(area);
    painter.line(line, Stroke::new(1.0, ui.visuals().text_color()));
    painter.hline(plot.x_range(), plot.bottom(), Stroke::new(1.0, weak));
    let font = FontId::proportional(10.0);
    for lambda in [400.0, 500.0, 600.0, 700.0] {
        let x = plot.left() + plot.width() * ((lambda - LAMBDA_MIN) / (LAMBDA_MAX - LAMBDA_MIN)) as f32;
        let text = if lambda == 700.0 { "700 nm".to_owned() } else { lambda.to_string() };
        painter.text(pos2(x, plot.bottom() + 1.0), Align2::CENTER_TOP, text, font.clone(), weak);
    }
    response.on_hover_text(tip)
}
