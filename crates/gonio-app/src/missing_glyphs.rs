//! Characters that no font can draw.
//!
//! For a character that gonio's fonts lack, egui asks its font providers for a font, then its rasterizers for a picture. On the
//! desktop the fonts of the system are a provider; on the page eframe's rasterizer has the browser draw the character. The
//! rasterizer of this module is the last one: a character that it is asked for is displayed as a box.

use crate::platform::{FontSearch, Platform};
use crate::session::{MessageSeverity, Messages};
use egui::{GlyphRasterizer, GlyphRasterizerRequest};
use gonio_language::tr;
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

/// Most characters that a message lists.
const MOST_LISTED: usize = 8;

/// Observes which characters are displayed as a box.
#[derive(Default)]
pub struct MissingGlyphs {
    /// Since the last frame. egui asks once for each family and size.
    boxes: Arc<Mutex<BTreeSet<char>>>,
    /// Those that the message lists.
    reported: BTreeSet<char>,
    message: String,
}

impl MissingGlyphs {
    /// Observes a context, from its next frame on.
    pub fn observe(&self, ctx: &egui::Context) {
        let boxes = self.boxes.clone();
        ctx.add_glyph_rasterizer(GlyphRasterizer::new(
            "gonio::missing_glyphs",
            move |request: &GlyphRasterizerRequest<'_>| {
                let seen = request.cluster.chars().next().filter(|character| is_visible(*character));
                boxes.lock().unwrap_or_else(PoisonError::into_inner).extend(seen);
                None
            },
        ));
    }

    /// After a frame: has the platform look for fonts with the characters that were displayed as a box, and reports those that
    /// it does not find. Frames without such characters do nothing.
    pub fn follow(&mut self, ctx: &egui::Context, platform: &mut dyn Platform, messages: &mut Messages) {
        let mut boxes = self.boxes.lock().unwrap_or_else(PoisonError::into_inner);
        if boxes.is_subset(&self.reported) {
            return;
        }
        match platform.find_fonts(&boxes, ctx) {
            FontSearch::Running => {}
            FontSearch::Installed => boxes.clear(),
            FontSearch::NotFound { advice } => {
                self.reported.append(&mut boxes);
                messages.withdraw(&self.message);
                self.message = sentence(&self.reported, &advice);
                messages.report(MessageSeverity::Note, self.message.clone());
                ctx.request_repaint();
            }
        }
    }
}

/// Whether a box in place of this character is a loss. Icons of other programs' fonts are in the private areas.
fn is_visible(character: char) -> bool {
    let is_invisible = matches!(character,
        '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{180b}'..='\u{180f}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{e0000}'..='\u{e0fff}');
    let is_private = matches!(character, '\u{e000}'..='\u{f8ff}' | '\u{f0000}'..);
    !(is_invisible || is_private || character.is_control() || character.is_whitespace())
}

fn sentence(missing: &BTreeSet<char>, advice: &str) -> String {
    let mut list: Vec<String> =
        missing.iter().take(MOST_LISTED).map(|&c| format!("{c} (U+{:04X})", u32::from(c))).collect();
    if missing.len() > MOST_LISTED {
        list.push(tr!("window-more", count = missing.len() - MOST_LISTED));
    }
    let last = list.pop().unwrap_or_default();
    let list = if list.is_empty() { last } else { tr!("window-and", names = list.join(", "), last = last) };
    match missing.len() {
        1 => tr!("window-no-font-has-the-character-displayed", list = list, advice = advice),
        _ => tr!("window-no-font-has-the-characters-displayed", list = list, advice = advice),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_lists_a_few_characters_and_counts_the_others() {
        let say = |text: &str| sentence(&text.chars().collect(), "install one");
        assert_eq!(say("中"), "No font has the character 中 (U+4E2D), displayed as a box: install one");
        assert_eq!(
            say("中文"),
            "No font has the characters 中 (U+4E2D) and 文 (U+6587), displayed as boxes: install one"
        );
        assert!(say("абвгдежзик").contains("з (U+0437) and 2 more, displayed"), "{}", say("абвгдежзик"));
    }

    #[test]
    fn invisible_and_private_characters_are_no_loss() {
        assert!("aж中😀\u{378}".chars().all(is_visible));
        assert!(!"\t\n \u{200d}\u{fe0f}\u{feff}\u{e001}\u{10fffd}".chars().any(is_visible));
    }
}
