//! Corrects a verdict by the values that a program computes: a right program is never wrong, a mistake is named only
//! where another value repairs every test scene, and an unlisted one gets its line and both quantities in words.

use crate::cause::edit::TextFix;
use crate::cause::naming::ProvenCause;
use crate::cause::search::Found;
use crate::cause::{Diagnosis, ModelSolutions, diagnose};
use crate::compile::ParsedStage;
use crate::mistakes::{Mistake, TERMS};
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
const BEYOND_VALUES: [&str; 7] = [
    "phong-instead-of-gouraud",
    "gouraud-instead-of-phong",
    "ambient-missing",
    "diffuse-missing",
    "specular-missing",
    "terms-not-put-out",
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
    solutions: &ModelSolutions,
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
    let Ok(diagnosis) = diagnose(task, stages[0], stages[1], texts, names, constants, solutions) else {
        return unchanged;
    };
    let fixes = diagnosis.fixes.clone();
    if matches!(diagnosis.found, Found::Right(_)) {
        if !is_beyond {
            acquit(verdict, &diagnosis);
        }
        return ByValues { has_its_pictures: is_beyond, fixes };
    }
    let groups = match &diagnosis.found {
        Found::Causes(groups) => groups.as_slice(),
        _ => &[],
    };
    let known = verdict.mistakes.clone();
    // Mistakes that are no change of a value, found by the rules about the source.
    let structural = crate::mistakes::structural();
    let is_structural = |found: &FoundMistake| structural.iter().any(|mistake| mistake.id == found.id);
    if !known.is_empty() && known.iter().all(is_structural) {
        return ByValues { fixes, ..unchanged };
    }
    let found = if !diagnosis.explanations.is_empty() {
        explained(task, &diagnosis, groups, submission, &known)
    } else if let Some(proven) = proven(groups, submission, &known) {
        proven
    } else {
        return ByValues { fixes, ..unchanged };
    };
    verdict.mistakes = found.into_iter().map(|new| with_line_of(new, &known)).collect();
    verdict.summary = verdict.mistake_names();
    verdict.runner_up = None;
    ByValues { fixes, ..unchanged }
}

/// The causes that together make every scene right, by name where they have one; `None` if there are none, or if they
/// are not at the mistakes that the source shows.
fn proven(groups: &[Vec<ProvenCause>], submission: &Submission, known: &[FoundMistake]) -> Option<Vec<FoundMistake>> {
    // Of the values that make every scene right, one whose mistake the source shows too.
    let is_known =
        |cause: &&ProvenCause| cause.mistakes.first().is_some_and(|m| known.iter().any(|old| old.id == m.id));
    let causes: Vec<&ProvenCause> =
        groups.iter().filter_map(|group| group.iter().find(is_known).or(group.first())).collect();
    let is_sound = !causes.is_empty() && causes.iter().all(|cause| cause.is_sound());
    // A single wrong value that no mistake computes may follow from those that the source shows.
    if causes.len() == 1 && !is_sound && !known.is_empty() {
        return None;
    }
    let is_there =
        |new: &FoundMistake, old: &FoundMistake| new.line.is_some() && new.line == old.line && new.file == old.file;
    let mut found = Vec::new();
    for cause in causes {
        match named(cause, submission) {
            Some(named) => found.extend(named),
            None => {
                let new = unlisted(cause, submission);
                found.push(known.iter().find(|old| is_there(&new, old)).cloned().unwrap_or(new));
            }
        }
    }
    let is_found = |old: &FoundMistake| found.iter().any(|new| new.id == old.id || is_there(new, old));
    (is_sound || !found.is_empty() && known.iter().all(is_found)).then_some(found)
}

/// The mistakes that explain the picture, at the lines of their causes.
fn explained(
    task: &Task,
    diagnosis: &Diagnosis,
    groups: &[Vec<ProvenCause>],
    submission: &Submission,
    known: &[FoundMistake],
) -> Vec<FoundMistake> {
    let Some(first) = diagnosis.explanations.first() else { return Vec::new() };
    let word = task.other.filter(|(model, _)| *model == first.method.model).and_then(|(_, word)| word);
    let structural = crate::mistakes::structural();
    let structural = word.and_then(|word| structural.into_iter().find(|mistake| mistake.id == word));
    let mut found: Vec<FoundMistake> =
        structural.iter().map(|mistake| FoundMistake::from_catalogue(mistake, 1.0)).collect();
    let mut causes: Vec<&ProvenCause> = groups.iter().filter_map(|group| group.first()).collect();
    for at in 0..first.mistakes.len() {
        // The alternative that the program itself shows, if it shows one.
        let alternatives: Vec<&'static Mistake> =
            diagnosis.explanations.iter().filter_map(|explanation| explanation.mistakes.get(at).copied()).collect();
        let is_one = |mistake: &Mistake| alternatives.iter().any(|other| other.id == mistake.id);
        // Pictures do not tell some mistakes apart, but the source may.
        let is_of = |old: &&FoundMistake| alternatives.iter().any(|m| m.id == old.id || old.or.contains(&m.id));
        let of_source = known.iter().find(is_of);
        let cause = causes.iter().position(|cause| cause.mistakes.iter().take(1 + cause.equals).any(|m| is_one(m)));
        let cause = cause.map(|at| causes.remove(at));
        let shown: Vec<&'static Mistake> = match cause {
            Some(cause) => cause.mistakes.iter().take(1 + cause.equals).copied().filter(|m| is_one(m)).collect(),
            None => alternatives,
        };
        let by_source = of_source.into_iter().flat_map(|old| std::iter::once(&old.id).chain(&old.or));
        let shown: Vec<&'static Mistake> = by_source.filter_map(|id| crate::mistakes::find(id)).chain(shown).collect();
        let Some((mistake, others)) = shown.split_first() else { continue };
        let mut or: Vec<String> = Vec::new();
        for other in others.iter().filter(|other| other.id != mistake.id) {
            if !or.contains(&other.id) {
                or.push(other.id.clone());
            }
        }
        let new = FoundMistake { or, lab_does_it: mistake.lab_does_it, ..FoundMistake::from_catalogue(mistake, 1.0) };
        found.push(match cause {
            Some(cause) => placed(new, cause, submission),
            None => new,
        });
    }
    found
}

/// The same mistake with the line that the rules about the source found, if they found one.
fn with_line_of(new: FoundMistake, known: &[FoundMistake]) -> FoundMistake {
    let is_it = |old: &&FoundMistake| old.id == new.id && old.line.is_some();
    match known.iter().find(is_it) {
        Some(old) => FoundMistake { file: old.file.clone(), line: old.line, quoted: old.quoted.clone(), ..new },
        _ => new,
    }
}

fn unlisted(cause: &ProvenCause, submission: &Submission) -> FoundMistake {
    let found = FoundMistake::new(WRONG_VALUE, format!("`{}` {}", one_line(&cause.text), cause.should), 1.0);
    placed(found.taught(cause.is_in_words(), "With this value every test scene is right.", ""), cause, submission)
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
