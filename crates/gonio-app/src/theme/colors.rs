//! Colours with a meaning: a term or a vector has the same colour everywhere.

use egui::{Color32, Ui};

/// A colour for the light theme and one for the dark theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tint {
    light: Color32,
    dark: Color32,
}

impl Tint {
    /// The colours for the light and the dark theme, sRGB.
    pub const fn new(light: [u8; 3], dark: [u8; 3]) -> Self {
        Tint {
            light: Color32::from_rgb(light[0], light[1], light[2]),
            dark: Color32::from_rgb(dark[0], dark[1], dark[2]),
        }
    }

    /// The colour in the dark or the light theme.
    pub fn in_theme(self, dark: bool) -> Color32 {
        if dark { self.dark } else { self.light }
    }

    /// The colour in the theme of `ui`.
    pub fn of(self, ui: &Ui) -> Color32 {
        self.in_theme(ui.visuals().dark_mode)
    }
}

/// Selected items and primary buttons.
pub const ACCENT: Tint = Tint::new([0x1c, 0x64, 0xc2], [0x6c, 0xb0, 0xff]);
/// The ambient term, A.
pub const AMBIENT: Tint = Tint::new([0x54, 0x71, 0x2a], [0xa9, 0xcf, 0x73]);
/// The emitted term, E.
pub const EMITTED: Tint = Tint::new([0xac, 0x49, 0x10], [0xff, 0xa2, 0x66]);
/// The diffuse term.
pub const DIFFUSE: Tint = Tint::new([0x1a, 0x6c, 0xb8], [0x76, 0xb8, 0xff]);
/// The specular term.
pub const SPECULAR: Tint = Tint::new([0x9a, 0x32, 0x9c], [0xe6, 0x92, 0xe8]);
/// A light: L, its position and its colour.
pub const LIGHT: Tint = Tint::new([0x95, 0x65, 0x00], [0xff, 0xd0, 0x5e]);
/// The environment's light.
pub const ENVIRONMENT: Tint = Tint::new([0x0c, 0x7b, 0x77], [0x5f, 0xd6, 0xcf]);
/// The normal, N.
pub const NORMAL: Tint = Tint::new([0x12, 0x75, 0x37], [0x63, 0xdb, 0x8c]);
/// The direction to the viewer, V.
pub const VIEW: Tint = Tint::new([0x1c, 0x64, 0xc2], [0x6c, 0xb0, 0xff]);
/// The mirrored direction, R.
pub const REFLECTION: Tint = Tint::new([0xc0, 0x2b, 0x3a], [0xff, 0x7f, 0x8a]);
/// The half vector, H.
pub const HALF: Tint = Tint::new([0x7a, 0x3f, 0xc4], [0xbc, 0x98, 0xff]);
/// A warning.
pub const WARNING: Tint = Tint::new([0x8d, 0x59, 0x00], [0xff, 0xc0, 0x4d]);
/// Something that is right.
pub const CORRECT: Tint = NORMAL;
/// Something that is wrong: the same as an error.
pub const WRONG: Tint = ERROR;
/// An error.
pub const ERROR: Tint = Tint::new([0xb8, 0x1f, 0x2f], [0xff, 0x8a, 0x8f]);
/// The x axis.
pub const AXIS_X: Tint = REFLECTION;
/// The y axis.
pub const AXIS_Y: Tint = NORMAL;
/// The z axis.
pub const AXIS_Z: Tint = VIEW;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theme;

    /// Contrast of two opaque colours: WCAG 2.2.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let linear = |byte: u8| {
            let c = f64::from(byte) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let luminance = |c: Color32| 0.2126 * linear(c.r()) + 0.7152 * linear(c.g()) + 0.0722 * linear(c.b());
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    // WCAG 2.2, level AA: 4.5 for text, 3 for icons and for the ring around the focus. The pressed state lasts for a moment, and its
    // coloured text is that of icons. `tests/contrast.rs` looks at windows.
    #[test]
    fn text_and_icons_stand_out_from_every_background() {
        let tints = [
            AMBIENT,
            EMITTED,
            DIFFUSE,
            SPECULAR,
            LIGHT,
            ENVIRONMENT,
            NORMAL,
            VIEW,
            REFLECTION,
            HALF,
            WARNING,
            ERROR,
            ACCENT,
        ];
        for (is_dark, greys) in [(false, &theme::LIGHT), (true, &theme::DARK)] {
            let still = [greys.panel, greys.field, greys.faint];
            let buttons = [greys.idle, greys.hovered];
            let fill =
                |tint: Tint, share: f32, below: Color32| below.blend(tint.in_theme(is_dark).gamma_multiply(share));
            let check = |name: &str, color: Color32, grounds: &[Color32], least: f64| {
                for ground in grounds {
                    let ratio = contrast(color, *ground);
                    assert!(
                        ratio >= least,
                        "{name} {color:?} on {ground:?}, dark {is_dark}: {ratio:.2}, at least {least}"
                    );
                }
            };
            let selected = still.map(|ground| fill(ACCENT, 0.35, ground));
            for (name, color) in [("text", greys.text), ("strong", greys.strong_text)] {
                check(name, color, &[&still[..], &buttons, &selected, &[greys.active]].concat(), 4.5);
            }
            let pinned = fill(ACCENT, 0.18, greys.field);
            check("weak", greys.weak_text, &[&still[..], &buttons, &[pinned]].concat(), 4.5);
            for tint in tints {
                let color = tint.in_theme(is_dark);
                check("tint", color, &still, 4.5);
                check("icon", color, &[buttons[0], buttons[1], greys.active], 3.0);
            }
            for tint in [CORRECT, WRONG, ACCENT] {
                check("verdict", tint.in_theme(is_dark), &[fill(tint, 0.14, greys.panel)], 4.5);
            }
        }
    }

    #[test]
    fn reports_have_the_same_colors() {
        let style = include_str!("../../../gonio-exercises/src/report/style.css");
        let themes = style.split_once("@media");
        for (name, tint) in [("right", CORRECT), ("warning", WARNING), ("error", WRONG), ("accent", ACCENT)] {
            for is_dark in [false, true] {
                let [r, g, b, _] = tint.in_theme(is_dark).to_array();
                let line = format!("--{name}: #{r:02x}{g:02x}{b:02x};");
                let theme = themes.map_or("", |(light, dark)| if is_dark { dark } else { light });
                assert!(theme.contains(&line), "{line} in {theme}");
            }
        }
    }
}
