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
pub const ACCENT: Tint = Tint::new([0x1f, 0x6f, 0xd6], [0x6c, 0xb0, 0xff]);
/// The ambient term, A.
pub const AMBIENT: Tint = Tint::new([0x5b, 0x7a, 0x2e], [0xa9, 0xcf, 0x73]);
/// The emitted term, E.
pub const EMITTED: Tint = Tint::new([0xb4, 0x4d, 0x12], [0xff, 0xa2, 0x66]);
/// The diffuse term.
pub const DIFFUSE: Tint = Tint::new([0x1a, 0x6c, 0xb8], [0x76, 0xb8, 0xff]);
/// The specular term.
pub const SPECULAR: Tint = Tint::new([0x9a, 0x32, 0x9c], [0xe6, 0x92, 0xe8]);
/// A light: L, its position and its colour.
pub const LIGHT: Tint = Tint::new([0x9c, 0x6a, 0x00], [0xff, 0xd0, 0x5e]);
/// The environment's light.
pub const ENVIRONMENT: Tint = Tint::new([0x0c, 0x7c, 0x78], [0x5f, 0xd6, 0xcf]);
/// The normal, N.
pub const NORMAL: Tint = Tint::new([0x13, 0x7d, 0x3b], [0x63, 0xdb, 0x8c]);
/// The direction to the viewer, V.
pub const VIEW: Tint = Tint::new([0x1f, 0x6f, 0xd6], [0x6c, 0xb0, 0xff]);
/// The mirrored direction, R.
pub const REFLECTION: Tint = Tint::new([0xc0, 0x2b, 0x3a], [0xff, 0x7f, 0x8a]);
/// The half vector, H.
pub const HALF: Tint = Tint::new([0x7a, 0x3f, 0xc4], [0xbc, 0x98, 0xff]);
/// A warning.
pub const WARNING: Tint = Tint::new([0x9a, 0x62, 0x00], [0xff, 0xc0, 0x4d]);
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
