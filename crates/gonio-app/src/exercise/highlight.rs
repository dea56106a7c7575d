//! GLSL in colours, by the words that `gonio-glsl` finds.

use crate::theme::colors::Tint;
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Id, Ui};
use gonio_glsl::Class;
use std::sync::Arc;

const KEYWORD: Tint = Tint::new([0x8a, 0x2d, 0xa8], [0xd8, 0x9b, 0xf0]);
const TYPE: Tint = Tint::new([0x0b, 0x74, 0x7a], [0x6f, 0xd3, 0xd0]);
const FUNCTION: Tint = Tint::new([0x1a, 0x5f, 0xb4], [0x82, 0xbc, 0xff]);
const VARIABLE: Tint = Tint::new([0xb0, 0x4a, 0x10], [0xff, 0xa8, 0x6e]);
const NUMBER: Tint = Tint::new([0x9a, 0x5b, 0x00], [0xf2, 0xc3, 0x6b]);
const COMMENT: Tint = Tint::new([0x5d, 0x77, 0x5e], [0x86, 0xa1, 0x88]);
const DIRECTIVE: Tint = Tint::new([0x6e, 0x6e, 0x78], [0xa5, 0xa9, 0xb4]);
const STRAY: Tint = crate::theme::colors::ERROR;

/// Longer texts have one colour: every word in colours costs time in each frame.
const MOST_COLORED_BYTES: usize = 100_000;

fn color(class: Class, dark: bool, text: Color32) -> Color32 {
    let tint = match class {
        Class::Keyword => KEYWORD,
        Class::Type => TYPE,
        Class::Function => FUNCTION,
        Class::Variable => VARIABLE,
        Class::Number => NUMBER,
        Class::Comment => COMMENT,
        Class::Directive => DIRECTIVE,
        Class::Stray => STRAY,
        Class::Name | Class::Mark => return text,
    };
    tint.in_theme(dark)
}

/// A text as it was laid out last, for which size and theme.
#[derive(Clone)]
struct Kept {
    text: String,
    dark: bool,
    size: f32,
    job: LayoutJob,
}

/// The text in colours, from what is kept where nothing changed; lines are as long as they are.
pub fn job(ui: &Ui, id: Id, text: &str, is_glsl: bool, font: &FontId) -> LayoutJob {
    let (dark, size) = (ui.visuals().dark_mode, font.size);
    let key = id.with("highlighted");
    let kept = ui.data(|data| data.get_temp::<Arc<Kept>>(key));
    if let Some(kept) = kept.filter(|kept| kept.text == text && kept.dark == dark && kept.size == size) {
        return kept.job.clone();
    }
    let job = colored(text, is_glsl, dark, ui.visuals().text_color(), font);
    let kept = Kept { text: text.to_owned(), dark, size, job: job.clone() };
    ui.data_mut(|data| data.insert_temp(key, Arc::new(kept)));
    job
}

fn colored(text: &str, is_glsl: bool, dark: bool, plain: Color32, font: &FontId) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    let mut append = |part: &str, color: Color32| {
        if !part.is_empty() {
            job.append(part, 0.0, TextFormat::simple(font.clone(), color));
        }
    };
    let mut at = 0;
    let parts = if is_glsl && text.len() <= MOST_COLORED_BYTES { gonio_glsl::classify(text) } else { Vec::new() };
    for part in parts {
        let (start, end) = (part.start as usize, part.end as usize);
        append(text.get(at..start).unwrap_or_default(), plain);
        append(text.get(start..end).unwrap_or_default(), color(part.class, dark, plain));
        at = end;
    }
    append(text.get(at..).unwrap_or_default(), plain);
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_in_colours_is_the_same_text() {
        let font = FontId::monospace(12.0);
        for text in ["", "#version 330\nin vec3 é; // ü\n", "void main() {", "\"€\" \\\n /* open"] {
            let job = colored(text, true, true, Color32::WHITE, &font);
            assert_eq!(job.text, text);
        }
        let job = colored("in vec3 a;", true, true, Color32::WHITE, &font);
        assert!(job.sections.iter().any(|section| section.format.color == KEYWORD.in_theme(true)));
        let long = "+0.0".repeat(MOST_COLORED_BYTES / 4 + 1);
        let job = colored(&long, true, true, Color32::WHITE, &font);
        assert_eq!((job.text.len(), job.sections.len()), (long.len(), 1));
    }
}
