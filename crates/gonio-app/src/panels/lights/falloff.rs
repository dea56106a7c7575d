//! att over the distance, drawn.

use crate::theme::colors;
use crate::widgets::compact;
use egui::{Align2, FontId, Sense, Stroke, Ui, pos2, vec2};

const HEIGHT: f32 = 58.0;

/// `1 / (kc + kl d + kq d^2)` from 0 to `reach` world units; `here` is the distance to the scene's middle.
pub fn show(ui: &mut Ui, [constant, linear, quadratic]: [f64; 3], reach: f64, here: f64) {
    let width = ui.available_width().min(360.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let painter = ui.painter();
    let weak = ui.visuals().weak_text_color();
    painter.rect_filled(rect, 4.0, ui.visuals().faint_bg_color);
    let plot = rect.shrink2(vec2(6.0, 8.0));
    let at = |d: f64| {
        let below = constant + linear * d + quadratic * d * d;
        if below > 0.0 { (1.0 / below).min(1e6) } else { 1e6 }
    };
    // If attenuation exceeds 1 near the light, the axis ends at its value for the nearest part of the scene.
    let most = at(0.15 * reach).max(at(here)).max(1e-9);
    let top = if at(0.0) <= 1.5 * most { at(0.0) } else { 1.5 * most };
    let place = |d: f64| {
        let x = plot.left() + (d / reach) as f32 * plot.width();
        let y = plot.bottom() - (at(d) / top).min(1.08) as f32 * plot.height();
        pos2(x, y)
    };
    let color = colors::LIGHT.of(ui);
    let points = (0..=96).map(|i| place(reach * f64::from(i) / 96.0)).collect();
    painter.with_clip_rect(rect).line(points, Stroke::new(1.5, color));
    painter.hline(plot.x_range(), plot.bottom(), Stroke::new(1.0, weak.gamma_multiply(0.5)));
    if here <= reach {
        let dot = place(here);
        painter.vline(dot.x, dot.y..=plot.bottom(), Stroke::new(1.0, weak));
        painter.circle_filled(dot, 3.0, color);
    }
    let font = FontId::proportional(10.5);
    let text = format!("att = {} at d = {}", compact(at(here)), compact(here));
    painter.text(plot.right_top(), Align2::RIGHT_TOP, text, font, weak);
    response.on_hover_text("att as a function of the distance d; the dot marks the centre of the scene");
}
