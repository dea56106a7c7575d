//! The pages beside the editor: the verdict, and the meaning and value of each variable.

use super::command::ExerciseCommand;
use super::fix;
use super::work::{Hints, Judged, Work};
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors, icons};
use crate::widgets;
use egui::{Color32, CornerRadius, Frame, Label, Margin, RichText, Sense, Ui};
use gonio_check::feedback::Feedback;
use gonio_check::mistakes;
use gonio_check::testbench::scene;
use gonio_check::verdict::{CompilerMessage, FoundMistake, Outcome, TermState, Verdict};
use gonio_exercises::exercise::ExerciseKind;
use gonio_exercises::preview::VariableValue;
use gonio_language::tr;

/// Characters of a line that are quoted.
const MOST_QUOTED: usize = 400;

/// Shows the verdict. A click on a named line goes to it.
pub fn verdict(ui: &mut Ui, work: &mut Work, commands: &mut Vec<ExerciseCommand>) {
    ui.spacing_mut().item_spacing.y = 6.0;
    ui.horizontal_wrapped(|ui| {
        if work.exercise.kind != ExerciseKind::Baking {
            let tip = tr!("exercise-also-accept-the-ways-of-the");
            widgets::toggle(ui, "as-the-lab", tr!("exercise-accept-the-lab-s-shortcuts"), &mut work.as_the_lab, tip);
        }
        if !work.checking && ui.button(tr!("exercise-check")).clicked() {
            commands.push(ExerciseCommand::Check);
        }
    });
    if work.checking {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(tr!("exercise-checking"));
        });
    }
    let stale = work.is_judged_before();
    let Some(judged) = work.judged.clone() else {
        if !work.checking {
            let hint = match work.exercise.feedback {
                Feedback::Verdict => tr!("exercise-tells-which-are-right"),
                Feedback::Name => tr!("exercise-names-each-mistake"),
                Feedback::Line => tr!("exercise-reports-each-mistake-by-name-and-2"),
                Feedback::Fix => tr!("exercise-reports-each-mistake-by-name-and"),
            };
            let way = match work.exercise.kind {
                ExerciseKind::Baking => tr!("exercise-compares-your-picture-with-the-right"),
                _ => tr!("exercise-draws-your-program-in-test-scenes"),
            };
            let hint = tr!("exercise-not-checked-yet-the-check-and", way = way, hint = hint);
            ui.add(Label::new(RichText::new(hint).weak()).wrap());
        }
        return;
    };
    if stale && !work.checking {
        ui.add(
            Label::new(RichText::new(tr!("exercise-the-files-have-changed-since-this")).color(colors::WARNING.of(ui)))
                .wrap(),
        );
    }
    let Judged { verdict, .. } = judged;
    match verdict {
        Ok(verdict) => shown(ui, work, &verdict, commands),
        Err(error) => {
            ui.add(Label::new(RichText::new(error).color(colors::ERROR.of(ui))).wrap());
        }
    }
    ui.add_space(16.0);
}

fn shown(ui: &mut Ui, work: &mut Work, verdict: &Verdict, commands: &mut Vec<ExerciseCommand>) {
    head(ui, work, verdict);
    for message in &verdict.messages {
        compiler_message(ui, work, message);
    }
    hints(ui, work, verdict);
    for (index, mistake) in verdict.mistakes.iter().enumerate() {
        self::mistake(ui, work, verdict, index, mistake);
    }
    if work.hints == Hints::Fix {
        fix::show(ui, work, &verdict.proposed_fix, commands);
    }
    if work.hints >= Hints::Name {
        terms(ui, verdict);
    }
    scenes(ui, work, verdict);
    if !verdict.peculiarities.is_empty() {
        heading(ui, tr!("exercise-correct-but-worth-knowing"));
        for peculiarity in &verdict.peculiarities {
            dotted(ui, &peculiarity.name, None);
        }
    }
    if !verdict.warnings.is_empty() && work.hints >= Hints::Line {
        heading(ui, tr!("exercise-warnings"));
        for warning in &verdict.warnings {
            dotted(ui, warning, Some(colors::WARNING.of(ui)));
        }
    }
}

/// The verdict, or why there is none, in words for screen readers.
pub(super) fn spoken(work: &Work) -> Option<String> {
    match &work.judged.as_ref()?.verdict {
        Ok(verdict) => Some(format!("{}: {}", sign(verdict.verdict).0, told(work, verdict))),
        Err(error) => Some(error.clone()),
    }
}

/// The word, icon and colour of an outcome.
fn sign(outcome: Outcome) -> (&'static str, &'static str, colors::Tint) {
    match outcome {
        Outcome::Correct => (tr!("exercise-correct"), icons::CHECK, colors::CORRECT),
        Outcome::Wrong => (tr!("exercise-wrong"), icons::X, colors::WRONG),
        Outcome::DoesNotCompile => (tr!("exercise-does-not-compile-2"), icons::WARNING_CIRCLE, colors::ERROR),
        Outcome::Unsure => (tr!("exercise-not-judged-2"), icons::QUESTION, colors::ACCENT),
    }
}

/// The summary, as far as the hints tell it: that of a wrong answer names its mistakes.
fn told(work: &Work, verdict: &Verdict) -> String {
    let is_told = verdict.verdict != Outcome::Wrong || work.hints >= Hints::Name;
    if is_told { verdict.summary.clone() } else { wrong_scenes(verdict) }
}

fn head(ui: &mut Ui, work: &Work, verdict: &Verdict) {
    let (word, icon, tint) = sign(verdict.verdict);
    let summary = told(work, verdict);
    let color = tint.of(ui);
    let frame = Frame::NONE.fill(color.gamma_multiply(0.14)).corner_radius(CornerRadius::same(6));
    let response = frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(icon).font(theme::icon_font(18.0)).color(color));
            ui.label(RichText::new(word).font(theme::bold(16.0)).color(color));
        });
        ui.add(Label::new(summary.as_str()).wrap());
    });
    exported::note(ui, &response.response, "verdict", WidgetRole::Text, word, &summary);
}

/// How many of the test scenes are wrong.
fn wrong_scenes(verdict: &Verdict) -> String {
    let whole = || verdict.scenes.iter().filter(|scene| !scene.scene.ends_with(" alone"));
    match (whole().filter(|scene| !scene.right).count(), whole().count()) {
        (_, 0) => tr!("exercise-the-result-differs-from-the-correct").to_owned(),
        (wrong, all) => tr!("exercise-of-test-scenes-differ-from-the", wrong = wrong, all = all),
    }
}

/// The steps of hints: how much is shown, and the next one.
fn hints(ui: &mut Ui, work: &mut Work, verdict: &Verdict) {
    if verdict.mistakes.is_empty() {
        return;
    }
    // The teacher may have left out the last steps.
    let has_line = verdict.mistakes.iter().any(|mistake| mistake.line.is_some());
    let has_fix = !verdict.proposed_fix.is_empty() || verdict.mistakes.iter().any(|mistake| !mistake.fix.is_empty());
    let step = |hints: &Hints| match hints {
        Hints::Symptom => (*hints, "symptom", tr!("exercise-what-can-be-seen-in-the")),
        Hints::Name => (*hints, "name", tr!("exercise-the-mistakes-by-name")),
        Hints::Line => (*hints, "line", tr!("exercise-the-line-of-each-mistake-also")),
        Hints::Fix => (*hints, "fix", tr!("exercise-how-to-fix-each-mistake")),
    };
    let is_offered = |hints: &&Hints| match hints {
        Hints::Symptom | Hints::Name => true,
        Hints::Line => has_line,
        Hints::Fix => has_fix,
    };
    let steps: Vec<_> = Hints::ALL.iter().filter(is_offered).map(step).collect();
    let before = work.hints;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(tr!("exercise-show-up-to-the")).weak());
        widgets::choice(ui, "hints", tr!("exercise-show-up-to-the"), &mut work.hints, &steps, Hints::default());
    });
    if work.hints > before && before < Hints::Line {
        work.go_to_first_line();
    }
}

fn mistake(ui: &mut Ui, work: &mut Work, verdict: &Verdict, index: usize, mistake: &FoundMistake) {
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 5.0;
        if work.hints == Hints::Symptom {
            let symptom = match mistake.looks_like.as_str() {
                "" => tr!("exercise-the-picture-differs-from-the-correct"),
                symptom => symptom,
            };
            labelled(ui, tr!("exercise-symptom"), symptom);
            return;
        }
        let name = RichText::new(&mistake.name).font(theme::bold(14.0)).color(ui.visuals().strong_text_color());
        ui.add(Label::new(name).wrap());
        let share = match mistake.share_explained {
            share if share > 0.0 => {
                tr!("exercise-it-explains-of-the-difference", share = format!("{:.1}", 100.0 * share))
            }
            _ if verdict.scenes.iter().all(|scene| scene.right) => {
                tr!("exercise-it-does-not-change-the-pictures").to_owned()
            }
            _ => tr!("exercise-found-in-the-source").to_owned(),
        };
        ui.label(RichText::new(format!("{}   {share}", mistake.id)).small().weak());
        if let (Some(file), Some(line)) = (&mistake.file, mistake.line.filter(|_| work.hints >= Hints::Line)) {
            place(ui, work, &format!("mistake-{index}"), file, line, mistake.quoted.as_deref());
        }
        labelled(ui, tr!("exercise-symptom"), &mistake.looks_like);
        if work.hints == Hints::Fix {
            labelled(ui, tr!("exercise-how-to-fix-it"), &mistake.fix);
        }
        if !mistake.or.is_empty() {
            let names: Vec<String> = mistake.or.iter().map(|id| name_of(id)).collect();
            labelled(ui, tr!("exercise-same-picture-as"), &names.join("; "));
        }
        if mistake.lab_does_it {
            weak(ui, tr!("exercise-the-lab-s-own-solution-does"));
        }
        if !mistake.lecture_section.is_empty() {
            weak(ui, &tr!("exercise-taught-in", lecture_section = mistake.lecture_section));
        }
    });
}

fn compiler_message(ui: &mut Ui, work: &mut Work, message: &CompilerMessage) {
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.add(Label::new(RichText::new(&message.text).color(colors::ERROR.of(ui))).wrap());
        if let Some(line) = message.line {
            place(ui, work, &format!("message-{line}"), &message.file, line, message.quoted.as_deref());
        }
        if let Some(explanation) = &message.explanation {
            ui.add(Label::new(explanation.as_str()).wrap());
        }
    });
}

/// A link to a line of a file, with the quoted line.
fn place(ui: &mut Ui, work: &mut Work, id: &str, file: &str, line: u32, quoted: Option<&str>) {
    let label = format!("{file}:{line}");
    let link = ui.link(RichText::new(&label).monospace());
    exported::note(ui, &link, id, WidgetRole::Button, &label, "");
    if link.clicked() {
        work.go_to(file, line);
    }
    if let Some(quoted) = quoted {
        let code = Frame::NONE.fill(ui.visuals().code_bg_color).corner_radius(4).inner_margin(Margin::symmetric(8, 4));
        code.show(ui, |ui| ui.add(Label::new(RichText::new(beginning(quoted.trim())).monospace()).wrap()));
    }
}

/// The beginning of a line, as far as it is quoted.
fn beginning(line: &str) -> String {
    match line.char_indices().nth(MOST_QUOTED) {
        Some((end, _)) => format!("{}…", line.get(..end).unwrap_or_default()),
        None => line.to_owned(),
    }
}

fn terms(ui: &mut Ui, verdict: &Verdict) {
    if verdict.terms.is_empty() {
        return;
    }
    heading(ui, tr!("exercise-terms"));
    ui.horizontal_wrapped(|ui| {
        for term in &verdict.terms {
            let (word, color) = match term.state {
                TermState::Right => (tr!("exercise-correct-state"), colors::CORRECT.of(ui)),
                TermState::Wrong => (tr!("exercise-wrong-state"), colors::WRONG.of(ui)),
                TermState::NotSeparable => (tr!("exercise-not-tested-separately"), ui.visuals().weak_text_color()),
            };
            ui.label(scene::term_title(&term.term));
            ui.label(RichText::new(word).color(color));
            ui.add_space(8.0);
        }
    });
}

/// The test scenes, without those of single terms. A click on one shows its pictures.
fn scenes(ui: &mut Ui, work: &mut Work, verdict: &Verdict) {
    if verdict.scenes.is_empty() {
        return;
    }
    heading(ui, tr!("exercise-test-scenes"));
    let shown = work.scene().filter(|scene| scene.is_test).map(|scene| scene.name.to_string());
    for scene in verdict.scenes.iter().filter(|scene| !scene.scene.ends_with(" alone")) {
        let can_be_shown = work.scenes.iter().any(|known| known.is_test && known.name == scene.scene);
        let (icon, color) =
            if scene.right { (icons::CHECK, colors::CORRECT.of(ui)) } else { (icons::X, colors::WRONG.of(ui)) };
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(icon).font(theme::icon_font(13.0)).color(color));
            if can_be_shown {
                let chosen = shown.as_ref() == Some(&scene.scene);
                let title = scene::title(&scene.scene);
                let link = ui.add(egui::Button::selectable(chosen, title.as_str()));
                let id = format!("test-scene-{}", widgets::slug(&scene.scene));
                exported::note(ui, &link, &id, WidgetRole::Button, &title, chosen);
                if link.on_hover_text(tr!("exercise-show-the-pictures-of-this-scene")).clicked() {
                    work.look_at_test(&scene.scene);
                }
            } else {
                ui.label(RichText::new(scene::title(&scene.scene)).color(ui.visuals().strong_text_color()));
            }
            if !scene.right {
                let share = tr!("exercise-of-pixels-differ", pixels_beyond = percent(scene.pixels_beyond));
                ui.label(RichText::new(share).color(color));
            }
            ui.add(Label::new(RichText::new(scene.shows.as_ref()).weak()).wrap());
        });
    }
}

/// A share as a percentage: never 0 % for a few pixels.
fn percent(share: f64) -> String {
    match 100.0 * share {
        percent if percent > 0.0 && percent < 1.0 => tr!("exercise-less-than-1").to_owned(),
        percent => format!("{percent:.0} %"),
    }
}

/// A mistake's name, where the catalogue has it.
fn name_of(id: &str) -> String {
    mistakes::find(id).map_or_else(|| format!("`{id}`"), |known| format!("“{}”", known.texts().name))
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(text).font(theme::bold(13.5)).color(ui.visuals().strong_text_color()));
}

fn weak(ui: &mut Ui, text: &str) {
    ui.add(Label::new(RichText::new(text).weak()).wrap());
}

fn labelled(ui: &mut Ui, label: &str, text: &str) {
    if !text.is_empty() {
        ui.label(RichText::new(label).small().weak());
        ui.add(Label::new(text).wrap().sense(Sense::hover()));
    }
}

fn dotted(ui: &mut Ui, text: &str, color: Option<Color32>) {
    ui.horizontal_top(|ui| {
        ui.label("•");
        let color = color.unwrap_or_else(|| ui.visuals().text_color());
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
    });
}

/// Shows the variables, unrecognised ones first.
pub fn variables(ui: &mut Ui, work: &Work) {
    ui.spacing_mut().item_spacing.y = 5.0;
    let variables = &work.program.variables;
    if variables.is_empty() {
        let words = tr!("exercise-once-your-program-compiles-this-page");
        ui.add(Label::new(RichText::new(words).weak()).wrap());
        return;
    }
    let unknown: Vec<&VariableValue> = variables.iter().filter(|variable| variable.role.is_none()).collect();
    if let Some(first) = unknown.first() {
        hint(ui, &first.name, unknown.len());
    }
    for variable in unknown.into_iter().chain(variables.iter().filter(|variable| variable.role.is_some())) {
        row(ui, variable);
    }
    for warning in &work.program.warnings {
        ui.add(Label::new(RichText::new(warning).color(colors::WARNING.of(ui))).wrap());
    }
    ui.add_space(16.0);
}

fn hint(ui: &mut Ui, name: &str, count: usize) {
    let frame = Frame::NONE.fill(colors::WARNING.of(ui).gamma_multiply(0.14)).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        let words = tr!("exercise-not-recognised-and-set-to-0", count = count);
        ui.add(Label::new(words).wrap());
        let example = format!("[names]\n\"{name}\" = \"light-pos\"   # or a value: [1.0, 0.5, 0.2]");
        ui.add(Label::new(RichText::new(example).monospace()).wrap());
    });
}

fn row(ui: &mut Ui, variable: &VariableValue) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(&variable.glsl_type).monospace().weak());
        ui.label(RichText::new(&variable.name).monospace().color(ui.visuals().strong_text_color()));
        match &variable.role {
            Some((role, how)) => {
                ui.label(RichText::new(role).font(theme::bold(13.0)).color(colors::ACCENT.of(ui))).on_hover_text(how);
            }
            None => {
                ui.label(RichText::new(tr!("exercise-not-recognised")).color(colors::WARNING.of(ui)));
            }
        }
        if !variable.value.contains('\n') {
            ui.label(RichText::new(&variable.value).monospace());
        }
    });
    if variable.value.contains('\n') {
        ui.indent(&variable.name, |ui| ui.label(RichText::new(columns(&variable.value)).monospace().size(11.0)));
    }
}

/// A matrix with its columns below each other.
fn columns(matrix: &str) -> String {
    let rows: Vec<Vec<&str>> = matrix.lines().map(|row| row.split_whitespace().collect()).collect();
    let width = rows.iter().flatten().map(|number| number.len()).max().unwrap_or(0);
    let line = |row: &Vec<&str>| row.iter().map(|number| format!("{number:>width$}")).collect::<Vec<_>>().join("  ");
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
