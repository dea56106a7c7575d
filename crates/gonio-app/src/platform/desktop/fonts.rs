//! Fonts of the system, for characters that gonio's fonts lack.

use crate::platform::FontSearch;
use egui::{FallbackRequest, FontFamily, FontProvider};
use egui_system_font_provider::SystemFontProvider;
use gonio_language::tr;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The system's fonts. They are listed in a thread when the first character is missing, because that may take a second.
#[derive(Default)]
pub enum SystemFonts {
    /// Every character so far was in gonio's fonts.
    #[default]
    Unused,
    /// A thread lists the fonts; `None` if there are none.
    Loading(Receiver<Option<SystemFontProvider>>),
    /// egui asks them.
    Installed,
    /// The system has no font, or no library that finds one.
    None,
}

impl SystemFonts {
    /// Looks for fonts that have these characters, as [`crate::platform::Platform::find_fonts`] does.
    pub fn find(&mut self, characters: &BTreeSet<char>, ctx: &egui::Context) -> FontSearch {
        match self {
            SystemFonts::Unused => {
                let (sender, receiver) = channel();
                let ctx = ctx.clone();
                // Without a thread the channel is closed, which counts as no fonts.
                let _ = std::thread::Builder::new().name("fonts".into()).spawn(move || {
                    let _ = sender.send(load());
                    ctx.request_repaint();
                });
                *self = SystemFonts::Loading(receiver);
                FontSearch::Running
            }
            SystemFonts::Loading(receiver) => match receiver.try_recv() {
                Ok(Some(provider)) => {
                    ctx.add_font_provider(Arc::new(provider));
                    *self = SystemFonts::Installed;
                    FontSearch::Installed
                }
                Err(TryRecvError::Empty) => FontSearch::Running,
                Ok(None) | Err(TryRecvError::Disconnected) => {
                    *self = SystemFonts::None;
                    self.find(characters, ctx)
                }
            },
            SystemFonts::Installed => FontSearch::NotFound { advice: advice(characters, true) },
            SystemFonts::None => FontSearch::NotFound { advice: advice(characters, false) },
        }
    }
}

/// Lists the fonts; `None` if none is found.
fn load() -> Option<SystemFontProvider> {
    // fontique panics where fontconfig knows no font at all.
    let load = || {
        let provider = SystemFontProvider::new();
        // It answers when the list is complete. Any font has this letter.
        provider.font_for(&FallbackRequest { cluster: "a", family: &FontFamily::Proportional }).map(|_| provider)
    };
    catch_unwind(AssertUnwindSafe(load)).ok().flatten()
}

/// How to get a font with these characters.
fn advice(characters: &BTreeSet<char>, has_fonts: bool) -> String {
    if !cfg!(target_os = "linux") {
        return tr!("window-install-a-font-of-this-script-2").into();
    }
    let mut packages = Vec::new();
    if !has_fonts {
        packages.push("libfontconfig1");
    }
    let is_cjk = |&c: &char| matches!(c, '\u{1100}'..='\u{11ff}' | '\u{2e80}'..='\u{a4cf}' | '\u{ac00}'..='\u{d7ff}' | '\u{f900}'..='\u{faff}' | '\u{ff00}'..='\u{ffef}' | '\u{20000}'..='\u{3ffff}');
    let is_emoji = |&c: &char| matches!(c, '\u{1f000}'..='\u{1faff}');
    if characters.iter().any(is_cjk) {
        packages.push("fonts-noto-cjk");
    }
    if characters.iter().any(is_emoji) {
        packages.push("fonts-noto-color-emoji");
    }
    if characters.iter().any(|c| !is_cjk(c) && !is_emoji(c)) {
        packages.push("fonts-noto-core");
    }
    tr!("window-install-a-font-of-this-script", packages = packages.join(" "))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::theme;
    use egui::FontId;
    use std::time::Duration;

    fn has(ctx: &egui::Context, character: char) -> bool {
        ctx.fonts_mut(|fonts| fonts.has_glyph(&FontId::monospace(12.5), character))
    }

    fn frame(ctx: &egui::Context) {
        ctx.run_ui(egui::RawInput::default(), |_| ()).textures_delta.clear();
    }

    /// DejaVu, a package that the tests need, has these letters.
    #[test]
    fn the_systems_fonts_are_found_in_a_thread() {
        let ctx = egui::Context::default();
        theme::install(&ctx);
        frame(&ctx);
        assert!(has(&ctx, 'a') && !has(&ctx, 'Ж') && !has(&ctx, 'Ֆ'));
        let (mut fonts, missing) = (SystemFonts::default(), BTreeSet::from(['Ж']));
        assert_eq!(fonts.find(&missing, &ctx), FontSearch::Running);
        let found = loop {
            match fonts.find(&missing, &ctx) {
                FontSearch::Running => std::thread::sleep(Duration::from_millis(5)),
                other => break other,
            }
        };
        assert_eq!(found, FontSearch::Installed, "install the package fonts-dejavu-core");
        frame(&ctx);
        assert!(has(&ctx, 'Ж') && has(&ctx, 'Ֆ'));
        // An unassigned code point.
        assert!(!has(&ctx, '\u{378}'));
        assert!(matches!(fonts.find(&missing, &ctx), FontSearch::NotFound { .. }));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn advice_names_the_packages() {
        let advise = |text: &str, has_fonts| advice(&text.chars().collect(), has_fonts);
        assert!(advise("中かな한", true).contains("`apt-get install fonts-noto-cjk`"));
        assert!(advise("ህ😀", true).contains("`apt-get install fonts-noto-color-emoji fonts-noto-core`"));
        assert!(advise("Ж", false).contains("`apt-get install libfontconfig1 fonts-noto-core`"));
    }
}
