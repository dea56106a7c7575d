//! The chosen draw's program, with its GLSL.

use crate::exported::{self, Role};
use crate::session::RecordedFrame;
use egui::{CollapsingHeader, Label, RichText, ScrollArea, TextStyle, Ui};

/// Height of the source, points.
const HEIGHT: f32 = 320.0;

pub fn show(ui: &mut Ui, taken: &mut RecordedFrame) {
    let draw = taken.record.draws.get(taken.draw);
    let Some(program) = draw.and_then(|draw| taken.record.program_of(draw)) else { return };
    let mut fragment = taken.fragment_source;
    CollapsingHeader::new("Program").id_salt("program").show(ui, |ui| {
        ui.add(Label::new(RichText::new(&program.name).weak()).wrap());
        ui.horizontal(|ui| {
            for (is_fragment, id, title) in
                [(false, "source-vertex", "Vertex shader"), (true, "source-fragment", "Fragment shader")]
            {
                let button = ui.selectable_label(fragment == is_fragment, title);
                exported::note(ui, &button, id, Role::Choice, title, fragment == is_fragment);
                if button.clicked() {
                    fragment = is_fragment;
                }
            }
        });
        let source = if fragment { &program.fragment_source } else { &program.vertex_source };
        let lines: Vec<&str> = source.lines().collect();
        let height = ui.text_style_height(&TextStyle::Monospace);
        ui.spacing_mut().item_spacing.y = 0.0;
        // Only the lines that are seen are laid out: there are hundreds.
        ScrollArea::both().id_salt(("source", fragment)).max_height(HEIGHT).auto_shrink([false, true]).show_rows(
            ui,
            height,
            lines.len(),
            |ui, range| {
                for number in range {
                    let line = lines.get(number).copied().unwrap_or_default();
                    ui.add(Label::new(RichText::new(format!("{:>4}  {line}", number + 1)).monospace()).extend());
                }
            },
        );
    });
    taken.fragment_source = fragment;
}
