//! Verdicts of exercises whose answer is no pair of shaders, in the words of all.

use crate::buffers::{self, Expected};
use crate::exercise::Exercise;
use crate::host::{self, GlProgramFiles, HostOutcome};
use crate::submission::SourceFile;
use crate::verdict::{CompilerMessage, FoundMistake, Outcome, Verdict};
use gonio_gl::{Gl, GlError};

/// What ends a list of files that could be the answer.
fn answers<'a>(files: &'a [SourceFile], endings: &[&str]) -> Vec<&'a SourceFile> {
    let fits = |name: &str| {
        let name = name.to_ascii_lowercase();
        endings.iter().any(|ending| name.ends_with(ending))
    };
    let fitting: Vec<&SourceFile> = files.iter().filter(|file| fits(&file.name)).collect();
    if fitting.is_empty() && files.len() == 1 { files.iter().collect() } else { fitting }
}

/// A vertex buffer against what the exercise's model holds.
pub fn buffers(exercise: &Exercise, files: Vec<SourceFile>) -> Verdict {
    let answers = answers(&files, &buffers::ENDINGS);
    let [answer] = answers.as_slice() else {
        let summary = match answers.len() {
            0 => "there is no buffer among the files: hand in a .csv, .json or .bin as text.md says".to_owned(),
            count => format!("there are {count} buffers among the files; check one at a time"),
        };
        return Verdict::new(&exercise.id, Outcome::Unsure, summary);
    };
    let buffer = match buffers::read_buffer(&answer.name, &answer.bytes) {
        Ok(buffer) => buffer,
        Err(error) => return Verdict::new(&exercise.id, Outcome::Unsure, error.to_string()),
    };
    let models: Vec<(String, Expected)> = exercise
        .start_files()
        .filter(|(name, _)| name.ends_with(".obj"))
        .filter_map(|(name, text)| Some((name.to_owned(), Expected::of_obj(text.as_bytes()).ok()?)))
        .collect();
    let Some((model, expected)) = buffers::choose(&models, &answer.name, &buffer) else {
        let summary = "it is like none of the exercise's models; call the file as its model, such as cube.csv";
        return Verdict::new(&exercise.id, Outcome::Unsure, summary);
    };
    let found = buffers::compare(expected, &buffer);
    let outcome = match found.verdict {
        buffers::Verdict::Correct => Outcome::Correct,
        buffers::Verdict::Wrong => Outcome::Wrong,
        buffers::Verdict::Unsure => Outcome::Unsure,
    };
    let names: Vec<&str> = found.mistakes.iter().map(|mistake| mistake.name).collect();
    let summary = match (outcome, names.is_empty()) {
        (Outcome::Correct, _) => format!("all {} triangles of {model} are there", found.shares.triangles_expected),
        (_, false) => format!("{} (of {model})", names.join("; and: ")),
        (_, true) => format!(
            "{:.0} % of the triangles of {model} are right; no mistake that gonio knows explains the others",
            100.0 * found.shares.all
        ),
    };
    let mut verdict = Verdict::new(&exercise.id, outcome, summary);
    verdict.score = if outcome == Outcome::Correct { 1.0 } else { found.shares.all.min(0.95) };
    let or: Vec<String> = found.alternatives.iter().map(|ids| ids.join(" and ")).collect();
    verdict.mistakes = found
        .mistakes
        .iter()
        .map(|mistake| {
            let known = FoundMistake::new(mistake.id, mistake.name, mistake.share_explained);
            let known = known.taught(mistake.explanation, mistake.how_to_mend, &exercise.seed);
            let line = |example: &buffers::Example| u32::try_from(example.line?).ok();
            let placed = match &mistake.example {
                Some(example) => known.at(model, line(example), &example.line_text),
                None => known,
            };
            FoundMistake { or: or.clone(), ..placed }
        })
        .collect();
    verdict.warnings = found.warnings.iter().chain(&buffer.warnings).cloned().collect();
    verdict
}

/// A host program, carried out; `given` are the files that it may name.
pub fn host_program(
    gl: &Gl,
    exercise: &Exercise,
    files: Vec<SourceFile>,
    given: &GlProgramFiles,
) -> Result<Verdict, GlError> {
    let answers = answers(&files, &[".txt"]);
    let [answer] = answers.as_slice() else {
        let summary = match answers.len() {
            0 => "there is no host program among the files: hand in a .txt as text.md says".to_owned(),
            count => format!("there are {count} host programs among the files; check one at a time"),
        };
        return Ok(Verdict::new(&exercise.id, Outcome::Unsure, summary));
    };
    let found = host::check_bytes(gl, &answer.bytes, &answer.name, given)?;
    let outcome = match found.verdict {
        HostOutcome::Correct => Outcome::Correct,
        HostOutcome::Wrong => Outcome::Wrong,
        HostOutcome::DoesNotCompile => Outcome::DoesNotCompile,
    };
    let mut verdict = Verdict::new(&exercise.id, outcome, found.summary.clone());
    verdict.score = if outcome == Outcome::Correct { 1.0 } else { found.share_right.min(0.95) };
    verdict.mistakes = found
        .mistakes
        .into_iter()
        .map(|mistake| {
            FoundMistake::new(mistake.id, mistake.name, 1.0)
                .taught(mistake.looks_like, mistake.mend, &exercise.seed)
                .at(&answer.name, Some(mistake.line), mistake.quoted)
        })
        .collect();
    verdict.messages = found
        .errors
        .into_iter()
        .map(|error| CompilerMessage {
            file: answer.name.clone(),
            line: Some(error.line),
            column: Some(error.column),
            text: error.message,
            quoted: None,
            explanation: (!error.help.is_empty()).then_some(error.help),
        })
        .collect();
    let at = |line: Option<u32>| line.map_or(String::new(), |line| format!("{}:{line}: ", answer.name));
    verdict.warnings = found.warnings.into_iter().map(|w| format!("{}{}", at(w.line), w.text)).collect();
    Ok(verdict)
}
