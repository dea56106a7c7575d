//! Fonts, colours and spacing of the light and the dark theme.
//!
//! The fonts are Inter for text and bold text, JetBrains Mono for code, KaTeX's cuts of Computer Modern for formulas and
//! Phosphor for icons. Each is cut down to the characters that are used, because the page carries them.

pub mod colors;
pub mod icons;
pub mod touch;

use colors::{ACCENT, Tint};
use egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, FontTweak, Margin, Stroke, Style, TextStyle,
    Theme, vec2,
};
use std::sync::Arc;

/// Installs the fonts and both styles in a context.
pub fn install(ctx: &egui::Context) {
    install_fonts(ctx);
    install_styles(ctx);
}

const TEXT_SIZE: f32 = 13.5;

/// Greys, from the background to the text.
struct Greys {
    panel: Color32,
    field: Color32,
    faint: Color32,
    idle: Color32,
    hovered: Color32,
    active: Color32,
    line: Color32,
    weak_text: Color32,
    text: Color32,
    strong_text: Color32,
}

const DARK: Greys = Greys {
    panel: Color32::from_rgb(0x1c, 0x1e, 0x22),
    field: Color32::from_rgb(0x14, 0x15, 0x18),
    faint: Color32::from_rgb(0x23, 0x26, 0x2b),
    idle: Color32::from_rgb(0x2b, 0x2e, 0x34),
    hovered: Color32::from_rgb(0x37, 0x3b, 0x43),
    active: Color32::from_rgb(0x43, 0x48, 0x52),
    line: Color32::from_rgb(0x33, 0x36, 0x3d),
    weak_text: Color32::from_rgb(0xa0, 0xa6, 0xb1),
    text: Color32::from_rgb(0xd9, 0xdc, 0xe2),
    strong_text: Color32::from_rgb(0xf5, 0xf6, 0xf8),
};

const LIGHT: Greys = Greys {
    panel: Color32::from_rgb(0xfa, 0xfa, 0xfb),
    field: Color32::from_rgb(0xff, 0xff, 0xff),
    faint: Color32::from_rgb(0xf1, 0xf2, 0xf4),
    idle: Color32::from_rgb(0xe9, 0xeb, 0xee),
    hovered: Color32::from_rgb(0xdd, 0xe0, 0xe5),
    active: Color32::from_rgb(0xcc, 0xd1, 0xd9),
    line: Color32::from_rgb(0xd9, 0xdc, 0xe1),
    weak_text: Color32::from_rgb(0x5c, 0x62, 0x6d),
    text: Color32::from_rgb(0x25, 0x28, 0x2d),
    strong_text: Color32::from_rgb(0x0c, 0x0d, 0x10),
};

fn install_styles(ctx: &egui::Context) {
    ctx.all_styles_mut(set_distances);
    ctx.style_mut_of(Theme::Dark, |style| set_colors(style, &DARK, ACCENT));
    ctx.style_mut_of(Theme::Light, |style| set_colors(style, &LIGHT, ACCENT));
}

fn set_distances(style: &mut Style) {
    let font = |size: f32, family: FontFamily| FontId::new(size, family);
    style.text_styles = [
        (TextStyle::Small, font(11.5, FontFamily::Proportional)),
        (TextStyle::Body, font(TEXT_SIZE, FontFamily::Proportional)),
        (TextStyle::Button, font(TEXT_SIZE, FontFamily::Proportional)),
        (TextStyle::Heading, bold(14.5)),
        (TextStyle::Monospace, font(12.5, FontFamily::Monospace)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(8.0, 6.0);
    spacing.button_padding = vec2(8.0, 3.0);
    spacing.interact_size = vec2(36.0, 24.0);
    spacing.window_margin = Margin::same(12);
    spacing.menu_margin = Margin::same(6);
    spacing.indent = 14.0;
    spacing.slider_width = 120.0;
    spacing.combo_width = 96.0;
    spacing.icon_width = 16.0;
    spacing.icon_width_inner = 9.0;
    spacing.tooltip_width = 320.0;
    spacing.scroll.bar_width = 8.0;
    // Tooltips appear after a pause, so that numbers stay visible under the pointer.
    style.interaction.tooltip_delay = 0.4;
    style.animation_time = 0.08;
}

fn set_colors(style: &mut Style, greys: &Greys, accent: Tint) {
    let visuals = &mut style.visuals;
    let accent = accent.in_theme(visuals.dark_mode);
    visuals.panel_fill = greys.panel;
    visuals.window_fill = greys.panel;
    visuals.window_stroke = Stroke::new(1.0, greys.line);
    visuals.extreme_bg_color = greys.field;
    visuals.faint_bg_color = greys.faint;
    visuals.code_bg_color = greys.faint;
    visuals.hyperlink_color = accent;
    visuals.weak_text_color = Some(greys.weak_text);
    visuals.selection.bg_fill = accent.gamma_multiply(0.35);
    visuals.selection.stroke = Stroke::new(1.0, greys.strong_text);
    visuals.indent_has_left_vline = false;
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(6);
    let widgets = &mut visuals.widgets;
    for (widget, fill, text) in [
        (&mut widgets.noninteractive, greys.panel, greys.text),
        (&mut widgets.inactive, greys.idle, greys.text),
        (&mut widgets.hovered, greys.hovered, greys.strong_text),
        (&mut widgets.active, greys.active, greys.strong_text),
        (&mut widgets.open, greys.hovered, greys.strong_text),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(5);
        // Widgets do not grow under the pointer, so that their neighbours do not seem to move.
        widget.expansion = 0.0;
    }
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, greys.line);
}

const BOLD: &str = "bold";
const MATH: &str = "math";
const MATH_ITALIC: &str = "math-italic";
const MATH_LARGE: &str = "math-large";
const ICONS: &str = "icons";

macro_rules! font {
    ($file:literal) => {
        FontData::from_static(include_bytes!(concat!("../../../../assets/fonts/", $file))).tweak(tweak())
    };
}

/// Hinting is off in the page, as in the browsers' own text: it would take a fifth of the first frame and enlarge the download.
fn tweak() -> FontTweak {
    FontTweak { hinting: cfg!(target_arch = "wasm32").then_some(false), ..FontTweak::default() }
}

fn install_fonts(ctx: &egui::Context) {
    let mut fonts = FontDefinitions::empty();
    for (name, data) in [
        ("text", FontData::from_static(gonio_plot::text::INTER).tweak(tweak())),
        (BOLD, font!("Inter-SemiBold.ttf")),
        ("code", font!("JetBrainsMono-Regular.ttf")),
        (MATH, font!("KaTeX-Main.ttf")),
        (MATH_ITALIC, font!("KaTeX-Math-Italic.ttf")),
        (MATH_LARGE, font!("KaTeX-Size2.ttf")),
        (ICONS, font!("Phosphor-Icons.ttf")),
    ] {
        fonts.font_data.insert(name.to_owned(), Arc::new(data));
    }
    let family = |name: &str| FontFamily::Name(name.into());
    // Missing glyphs come from the next font: Greek letters from those for formulas.
    for (family, chain) in [
        (FontFamily::Proportional, &["text", MATH, MATH_ITALIC, ICONS][..]),
        (FontFamily::Monospace, &["code", "text", MATH, MATH_ITALIC]),
        (family(BOLD), &[BOLD, MATH, MATH_ITALIC, ICONS]),
        (family(MATH), &[MATH, MATH_ITALIC, "text"]),
        (family(MATH_ITALIC), &[MATH_ITALIC, MATH, "text"]),
        (family(MATH_LARGE), &[MATH_LARGE, MATH]),
        (family(ICONS), &[ICONS, "text"]),
    ] {
        fonts.families.insert(family, chain.iter().map(|name| (*name).to_owned()).collect());
    }
    ctx.set_fonts(fonts);
}

fn named(family: &'static str, size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(family.into()))
}

/// Bold text, for headings.
pub fn bold(size: f32) -> FontId {
    named(BOLD, size)
}

/// Upright letters, digits and signs of formulas.
pub fn math_font(size: f32) -> FontId {
    named(MATH, size)
}

/// Variables of formulas.
pub fn math_italic_font(size: f32) -> FontId {
    named(MATH_ITALIC, size)
}

/// Large signs: sums, brackets.
pub fn math_large_font(size: f32) -> FontId {
    named(MATH_LARGE, size)
}

/// Icons.
pub fn icon_font(size: f32) -> FontId {
    named(ICONS, size)
}
