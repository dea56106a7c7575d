//! Sizes of what is touched: on a phone every control is as large as a finger.

use super::set_distances;
use egui::{Context, Id, Style, Ui, vec2};

/// Least width and height of a control on a phone, points.
pub const TARGET: f32 = 40.0;
/// Windows narrower than this, in points, are those of phones held upright.
const PHONE: f32 = 500.0;
/// Windows lower than this, in points, are those of phones held sideways.
const LOW: f32 = 440.0;

/// Adapts the distances of all styles to the window's size.
pub fn fit(ctx: &Context) {
    let is_phone = ctx.content_rect().width() < PHONE || is_low(ctx);
    let known = Id::unique("gonio: style for fingers");
    if ctx.data(|data| data.get_temp(known)).unwrap_or(false) != is_phone {
        ctx.data_mut(|data| data.insert_temp(known, is_phone));
        ctx.all_styles_mut(|style| {
            set_distances(style);
            if is_phone {
                enlarge(style);
            }
        });
    }
}

fn enlarge(style: &mut Style) {
    let spacing = &mut style.spacing;
    spacing.interact_size = vec2(TARGET, TARGET);
    spacing.button_padding = vec2(13.0, 3.0);
    spacing.item_spacing = vec2(6.0, 3.0);
    spacing.icon_width = 20.0;
    spacing.icon_width_inner = 12.0;
}

/// Whether the window has little height, as on a phone held sideways.
pub fn is_low(ctx: &Context) -> bool {
    ctx.content_rect().height() < LOW
}

/// Least width and height of a control: 0 but on a phone.
pub fn least(ui: &Ui) -> f32 {
    if ui.spacing().interact_size.y >= TARGET { TARGET } else { 0.0 }
}
