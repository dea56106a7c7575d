//! The fonts: text and bold text (Inter), code (JetBrains Mono), formulas (KaTeX's cuts of Computer Modern), icons
//! (Phosphor). Each is cut down to the characters that are used, as the page carries them along.

use egui::{FontData, FontDefinitions, FontFamily, FontId, FontTweak};
use std::sync::Arc;

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

/// In a page, outlines are drawn as they are, as browsers draw their own text: to fit them to the pixels takes a fifth of
/// the first frame there, and code that every visitor would have to wait for.
fn tweak() -> FontTweak {
    FontTweak { hinting: cfg!(target_arch = "wasm32").then_some(false), ..FontTweak::default() }
}

pub(super) fn install(ctx: &egui::Context) {
    let mut fonts = FontDefinitions::empty();
    for (name, data) in [
        ("text", font!("Inter-Regular.ttf")),
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
