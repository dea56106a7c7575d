//! Corrects a verdict by the values that a program computes: a right program is never wrong, a mistake is named only
//! where another value repairs every test scene, and an unlisted one gets its line and both quantities in words.

use crate::cause::edit::TextFix;
use crate::cause::naming::ProvenCause;
use crate::cause::search::Found;
use crate::cause::{Diagnosis, diagnose};
use crate::compile::ParsedStage;
use crate::mistakes::TERMS;
use crate::roles::NamesFile;
use crate::rules::SourceConstants;
use crate::search::Task;
use crate::submission::{StageText, Submission};
use crate::verdict::{FoundMistake, Outcome, Verdict};
use gonio_glsl::Stage;

/// The id of a wrong value that no mistake of the catalogue explains.
pub const WRONG_VALUE: &str = "wrong-value";

/// Mistakes that another value of an expression does not show: which stage computes the light, terms that are computed
/// and not added where the exercise does not require them, a power that the driver defines by chance.
const BEYOND_VALUES: [&str; 8] = [
    "phong-instead-of-gouraud",
    "gouraud-instead-of-phong",
    "ambient-missing",
    "diffuse-missing",
    "specular-missing",
    "terms-not-put-out",
    "terms-multiplied",
    "specular-power-of-negative",
];

/// What the values of a program add to its verdict.
pub(super) struct ByValues {
    /// Whether the pictures still belong to the verdict.
    pub has_its_pictures: bool,
    /// Edits with which the interpreter finds every scene right.
    pub fixes: Vec<TextFix>,
}

/// Corrects a wrong verdict.
pub(super) fn correct(
    verdict: &mut Verdict,
    task: &Task,
    submission: &Submission,
    [vertex, fragment]: [&ParsedStage<'_>; 2],
    names: &NamesFile,
    constants: &SourceConstants,
) -> ByValues {
    let unchanged = ByValues { has_its_pictures: true, fixes: Vec::new() };
    let is_judged = task.model.is_lit() || task.model.is_looked_up();
    // A term that the exercise requires is in every right picture.
    let is_required = |id: &str| (0..3).any(|term| task.required[term] && id == format!("{}-missing", TERMS[term]));
    let is_beyond = |id: &str| BEYOND_VALUES.contains(&id) && !is_required(id);
    let is_beyond = verdict.mistakes.iter().any(|found| is_beyond(&found.id));
    if verdict.verdict != Outcome::Wrong || !is_judged {
        return unchanged;
    }
    let texts = [&submission.vertex.text, &submission.fragment.text].map(String::as_str);
    let stages = [vertex, fragment].map(|stage| (&stage.parsed, &stage.checked));
    let Ok(diagnosis) = diagnose(task, stages[0], stages[1], texts, names, constants) else { return unchanged };
    let fixes = diagnosis.fixes.clone();
    match &diagnosis.found {
        Found::Right(_) if !is_beyond => {
            acquit(verdict, &diagnosis);
            return ByValues { has_its_pictures: false, fixes };
        }
        Found::Causes(groups) if groups.iter().all(|group| group.first().is_some_and(ProvenCause::is_sound)) => {
            let found: Vec<FoundMistake> =
                groups.iter().filter_map(|group| named(group.first()?, submission)).flatten().collect();
            // The same names: the rules about the source know their lines too.
            let is_known =
                |new: &FoundMistake| verdict.mistakes.iter().any(|old| old.id == new.id && old.line.is_some());
            if found.len() == verdict.mistakes.len() && found.iter().all(is_known) {
                return ByValues { fixes, ..unchanged };
            }
            verdict.mistakes = found;
            verdict.summary = verdict.mistake_names();
            verdict.runner_up = None;
        }
        Found::Causes(groups) if verdict.mistakes.is_empty() => {
            if let [group] = groups.as_slice()
                && let Some(cause) = group.first().filter(|cause| !cause.has_wrong_input && !cause.is_intermediate)
            {
                let found =
                    FoundMistake::new(WRONG_VALUE, format!("`{}` {}", one_line(&cause.text), cause.should), 1.0)
                        .taught(cause.is_in_words(), "With this value every test scene is right.", "");
                verdict.mistakes = vec![placed(found, cause, submission)];
                verdict.summary = verdict.mistake_names();
                verdict.runner_up = None;
            }
        }
        _ => {}
    }
    ByValues { fixes, ..unchanged }
}

/// Makes the verdict right, and states the roles that this assumes where the names do not tell them.
fn acquit(verdict: &mut Verdict, diagnosis: &Diagnosis) {
    verdict.verdict = Outcome::Correct;
    verdict.score = 1.0;
    verdict.mistakes.clear();
    verdict.runner_up = None;
    verdict.scenes.iter_mut().for_each(|scene| scene.right = true);
    verdict.properties.clear();
    let mut assumed = Vec::new();
    for bound in &diagnosis.bindings.bound {
        let (name, role) = (&bound.declared.name, bound.role.to_string());
        let Some(known) = verdict.bound.iter_mut().find(|known| known.name == *name) else { continue };
        if known.role.as_deref() != Some(&role) {
            assumed.push(format!("`{name}` is `{role}`"));
            known.role = Some(role);
        }
    }
    verdict.summary = match assumed.is_empty() {
        true => "right in every test scene: each value is that of the light equation".to_owned(),
        false => format!("right in every test scene, provided that {}", assumed.join(", ")),
    };
}

/// The mistakes that a cause has by name.
fn named(cause: &ProvenCause, submission: &Submission) -> Option<Vec<FoundMistake>> {
    let first = cause.mistakes.first()?;
    let or = cause.mistakes.iter().skip(1).take(cause.equals).map(|other| other.id.clone()).collect();
    let found = FoundMistake { or, lab_does_it: first.lab_does_it, ..FoundMistake::from_catalogue(first, 1.0) };
    let second = cause.with.map(|with| FoundMistake::from_catalogue(with, 1.0));
    Some(std::iter::once(found).chain(second).map(|found| placed(found, cause, submission)).collect())
}

fn placed(found: FoundMistake, cause: &ProvenCause, submission: &Submission) -> FoundMistake {
    let text: &StageText = if cause.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
    let (file, line, _) = text.place(cause.span.line, cause.span.column);
    found.at(file, Some(line), text.line(cause.span.line).unwrap_or_default())
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
