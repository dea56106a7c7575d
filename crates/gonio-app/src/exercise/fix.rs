//! The proposed fix of a verdict: its diff, and the button that applies it to the files in the editor.

use super::command::ExerciseCommand;
use super::work::{Judged, Work};
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors};
use egui::{CornerRadius, Frame, Label, Margin, RichText, Ui};
use gonio_check::proposed_fix::{self, DiffLine};
use gonio_check::verdict::ProposedEdit;
use gonio_language::tr;

/// Shows the diff of each edit below one sentence. A click on a place goes to it.
pub fn show(ui: &mut Ui, work: &mut Work, edits: &[ProposedEdit], commands: &mut Vec<ExerciseCommand>) {
    if edits.is_empty() {
        return;
    }
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 5.0;
        ui.horizontal_wrapped(|ui| {
            let promise = RichText::new(proposed_fix::promise(edits)).font(theme::bold(14.0));
            ui.add(Label::new(promise.color(colors::NORMAL.of(ui))).wrap());
            if work.fixed_texts().is_some() {
                let button = ui.button(tr!("exercise-apply"));
                exported::note(ui, &button, "apply-fix", WidgetRole::Button, tr!("exercise-apply"), "");
                if button.on_hover_text(tr!("exercise-change-the-text-in-the-editor")).clicked() {
                    commands.push(ExerciseCommand::ApplyFix);
                }
            }
        });
        for (index, edit) in edits.iter().enumerate() {
            let label = format!("{}:{}", edit.file, edit.line);
            let link = ui.link(RichText::new(&label).monospace());
            exported::note(ui, &link, &format!("fix-{index}"), WidgetRole::Button, &label, "");
            if link.clicked() {
                work.go_to(&edit.file, edit.line);
            }
            diff(ui, edit);
        }
    });
}

fn diff(ui: &mut Ui, edit: &ProposedEdit) {
    let code = Frame::NONE.fill(ui.visuals().code_bg_color).corner_radius(4).inner_margin(Margin::symmetric(8, 4));
    code.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 1.0;
        for line in edit.diff() {
            let color = match line {
                DiffLine::Kept(_) => ui.visuals().text_color(),
                DiffLine::Removed(_) => colors::ERROR.of(ui),
                DiffLine::Added(_) => colors::NORMAL.of(ui),
            };
            let text = format!("{} {}", line.sign(), line.text().trim_end());
            ui.add(Label::new(RichText::new(text).monospace().color(color)).wrap());
        }
    });
}

impl Work {
    /// The files that the last verdict's proposed fix changes, by index, with their new texts. `None` if there is none, or if a
    /// text has changed since the check where the fix replaces lines.
    pub(super) fn fixed_texts(&self) -> Option<Vec<(usize, String)>> {
        let Judged { verdict: Ok(verdict), .. } = self.judged.as_ref()? else { return None };
        let edits = &verdict.proposed_fix;
        if !edits.iter().all(|edit| self.file_named(&edit.file).is_some()) {
            return None;
        }
        let is_changed = |name: &str| edits.iter().any(|edit| edit.file == name);
        let changed = self.files.iter().enumerate().filter(|(_, file)| is_changed(&file.name) && !file.locked);
        let texts: Option<Vec<(usize, String)>> =
            changed.map(|(index, file)| Some((index, proposed_fix::applied(edits, &file.name, &file.text)?))).collect();
        texts.filter(|texts| !texts.is_empty())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use gonio_check::verdict::{Outcome, Verdict};
    use gonio_exercises::exercise;

    fn edit(file: &str, before: &str, after: &str) -> ProposedEdit {
        ProposedEdit { file: file.to_owned(), line: 1, before: before.to_owned(), after: after.to_owned() }
    }

    #[test]
    fn a_fix_is_applied_to_the_text_that_was_checked_and_to_no_other() {
        let mut work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        assert_eq!(work.fixed_texts(), None, "nothing was checked");
        let index = work.file_named("start.frag").unwrap();
        let first = work.files[index].text.lines().next().unwrap().to_owned();
        let judged = |edits: Vec<ProposedEdit>, work: &Work| {
            let verdict = Verdict { proposed_fix: edits, ..Verdict::new("ex04", Outcome::Wrong, "wrong") };
            Some(Judged { verdict: Ok(verdict), of: work.content() })
        };
        work.judged = judged(Vec::new(), &work);
        assert_eq!(work.fixed_texts(), None, "there is no fix");
        work.judged = judged(vec![edit("start.frag", &first, "// new")], &work);
        let fixed = work.fixed_texts().unwrap();
        assert_eq!(fixed[0].0, index);
        assert_eq!(fixed[0].1, work.files[index].text.replacen(&first, "// new", 1));
        work.files[index].text.push_str("// another line below\n");
        assert!(work.fixed_texts().unwrap()[0].1.ends_with("// another line below\n"));
        work.files[index].text.insert(0, ' ');
        assert_eq!(work.fixed_texts(), None, "the line has changed");
        work.judged = judged(vec![edit("other.frag", "", "// new")], &work);
        assert_eq!(work.fixed_texts(), None, "the file is not open");
    }
    /// The widgets of a frame with the diff.
    fn shown(work: &mut Work, edits: &[ProposedEdit]) -> Vec<String> {
        let ctx = egui::Context::default();
        theme::install(&ctx);
        let mut commands = Vec::new();
        // Nothing is drawn.
        ctx.run_ui(egui::RawInput::default(), |ui| show(ui, work, edits, &mut commands)).textures_delta.clear();
        assert_eq!(commands, []);
        exported::widgets(&ctx).into_iter().map(|widget| widget.id).collect()
    }

    #[test]
    fn a_diff_has_a_button_while_it_can_be_applied() {
        let mut work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        let edits = [edit("start.frag", "", "// new"), edit("start.vert", "", "// new")];
        assert_eq!(shown(&mut work, &edits), ["fix-0", "fix-1"], "it is not of the last check");
        let verdict = Verdict { proposed_fix: edits.to_vec(), ..Verdict::new("ex04", Outcome::Wrong, "wrong") };
        work.judged = Some(Judged { verdict: Ok(verdict), of: work.content() });
        assert_eq!(shown(&mut work, &edits), ["apply-fix", "fix-0", "fix-1"]);
        assert_eq!(shown(&mut work, &[]), [""; 0]);
    }
}
