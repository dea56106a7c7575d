//! The verdict on a baked model.

use super::answer::{Answer, is_model};
use super::findings::{BakeFinding, BakeFindings, examine};
use super::mistakes;
use super::original::Original;
use crate::exercise::Exercise;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{FoundMistake, Outcome, SceneVerdict, Verdict, join_names};
use gonio_language::tr;

/// Most models that are checked; the best of them counts.
const MOST_MODELS: usize = 4;
/// The highest score of a wrong answer.
const MOST_FOR_WRONG: f64 = 0.9;

/// Checks the files of a student.
pub fn check(exercise: &Exercise, files: &[SourceFile], original: &Original) -> Verdict {
    let unsure = |summary: &str| Verdict::new(&exercise.id, Outcome::Unsure, summary);
    let all: Vec<&SourceFile> = files.iter().filter(|file| is_model(&file.name)).collect();
    let own: Vec<&SourceFile> = all.iter().copied().filter(|file| !original.is_given(&file.bytes)).collect();
    let mut models = if own.is_empty() { all } else { own };
    // An OBJ file is what the exercise asks for; a GLB beside it is another form of the same model.
    let is_obj = |file: &&SourceFile| file.name.to_ascii_lowercase().ends_with(".obj");
    if models.iter().any(&is_obj) {
        models.retain(|file| is_obj(file));
    }
    match models.len() {
        0 => {
            return unsure(tr!("check-baking-no-model-handed-in"));
        }
        count if count > MOST_MODELS => {
            return unsure(&tr!("check-baking-there-are-models-among-the-files", count = count));
        }
        _ => {}
    }
    let verdicts = models.iter().map(|model| match Answer::read(&model.name, files, original) {
        Ok(answer) => in_words(exercise, &answer, examine(&answer, original)),
        Err(reason) => unsure(&reason),
    });
    let rank =
        |verdict: &Verdict| (verdict.verdict == Outcome::Correct, verdict.verdict == Outcome::Wrong, verdict.score);
    let better = |a: Verdict, b: Verdict| if rank(&b) > rank(&a) { b } else { a };
    verdicts.reduce(better).unwrap_or_else(|| unsure(tr!("check-baking-no-model")))
}

fn in_words(exercise: &Exercise, answer: &Answer, findings: BakeFindings) -> Verdict {
    if let Some(reason) = findings.unjudged {
        return Verdict::new(&exercise.id, Outcome::Unsure, reason);
    }
    let found: Vec<FoundMistake> = findings.mistakes.iter().filter_map(|finding| named(exercise, finding)).collect();
    let is_right = found.is_empty() && !findings.is_unexplained;
    let (outcome, summary) = match (is_right, found.is_empty()) {
        (true, _) => (Outcome::Correct, tr!("check-baking-the-picture-of-is-right-everywhere", name = answer.name)),
        (false, false) => (Outcome::Wrong, join_names(found.iter().map(|mistake| mistake.name.as_str()))),
        (false, true) => (Outcome::Wrong, unexplained(&findings)),
    };
    let mut verdict = Verdict::new(&exercise.id, outcome, summary);
    let is_wrong = |(_, part): &&(String, super::colors::PartColors)| !part.is_right();
    let wrong = findings.parts.iter().filter(is_wrong).count();
    let share = if findings.parts.is_empty() { 0.0 } else { 1.0 - wrong as f64 / findings.parts.len() as f64 };
    verdict.score = if is_right { 1.0 } else { share.min(MOST_FOR_WRONG) };
    verdict.scenes = (findings.parts.iter())
        .map(|(name, part)| SceneVerdict {
            scene: name.clone(),
            shows: tr!("check-baking-the-colours-of-one-part").into(),
            right: part.is_right(),
            pixels_beyond: 1.0 - part.share(),
            worst: 0.0,
        })
        .collect();
    verdict.warnings = findings.warnings;
    verdict.warnings.extend(answer.unreadable.iter().map(|reason| tr!("check-baking-not-read", reason = reason)));
    verdict.mistakes = found;
    verdict
}

fn unexplained(findings: &BakeFindings) -> String {
    let (all, right) = findings.parts.iter().fold((0, 0), |(a, r), (_, part)| (a + part.texels, r + part.right));
    let wrong: Vec<&str> =
        findings.parts.iter().filter(|(_, part)| !part.is_right()).map(|(name, _)| name.as_str()).collect();
    tr!(
        "check-baking-of-the-surface-has-the-right",
        percent = format!("{:.0}", 100.0 * right as f64 / all.max(1) as f64),
        parts = wrong.join(", ")
    )
}

fn named(exercise: &Exercise, finding: &BakeFinding) -> Option<FoundMistake> {
    let known = mistakes::find(finding.id)?;
    let texts = known.texts();
    let name = match finding.detail.as_str() {
        "" => texts.name.into_owned(),
        detail => format!("{} ({detail})", texts.name),
    };
    let section = if known.lecture_section.is_empty() { &exercise.lecture_section } else { &known.lecture_section };
    let found = FoundMistake::new(finding.id, name, finding.share).taught(texts.looks_like, texts.fix, section);
    Some(match &finding.place {
        Some((file, line, text)) => found.at(file, Some(*line), text),
        None => found,
    })
}
