//! Fonts, colours and spacing of the light and the dark theme.

pub mod colors;
mod fonts;
pub mod icons;
mod style;

pub use fonts::{bold, icon_font, math_font, math_italic_font, math_large_font};

/// Gives a context its fonts and both of its styles.
pub fn install(ctx: &egui::Context) {
    fonts::install(ctx);
    style::install(ctx);
}
