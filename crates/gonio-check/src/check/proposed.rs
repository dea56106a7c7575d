//! Proposed fixes: edits of the student's files with which the driver draws every test scene right.

use super::{CheckOptions, Purpose, ShaderExercise, check_files};
use crate::cause::edit::{TextEdit, TextFix};
use crate::comparison::ShaderChecker;
use crate::proposed_fix::applied;
use crate::submission::{SourceFile, StageText, Submission, decoded};
use crate::verdict::{Outcome, ProposedEdit};
use gonio_glsl::Stage;
use std::collections::BTreeMap;

/// Most fixes that are drawn for one verdict.
const MOST_DRAWN: usize = 2;

/// The first fix that is right when its files are checked like a submission; empty if none is.
pub(super) fn propose(
    checker: &mut ShaderChecker,
    exercise: &ShaderExercise<'_>,
    files: &[SourceFile],
    options: &CheckOptions,
    submission: &Submission,
    fixes: &[TextFix],
) -> Vec<ProposedEdit> {
    for fix in fixes.iter().take(MOST_DRAWN) {
        let Some(edits) = in_files(files, submission, fix) else { continue };
        let Some(changed) = with_edits(files, &edits) else { continue };
        let checked = check_files(checker, exercise, changed, options, Purpose::Right);
        if checked.is_ok_and(|(verdict, _)| verdict.verdict == Outcome::Correct) {
            return edits;
        }
    }
    Vec::new()
}

/// Applies proposed edits to files; `None` if a file does not have the lines that they replace. Changed files are UTF-8
/// with lines that end in `\n`.
#[must_use]
pub fn with_edits(files: &[SourceFile], edits: &[ProposedEdit]) -> Option<Vec<SourceFile>> {
    let mut files = files.to_vec();
    for file in files.iter_mut().filter(|file| edits.iter().any(|edit| edit.file == file.name)) {
        file.bytes = applied(edits, &file.name, &decoded(file)?)?.into_bytes();
    }
    let is_known = |edit: &ProposedEdit| files.iter().any(|file| file.name == edit.file);
    edits.iter().all(is_known).then_some(files)
}

/// A replaced range of a file's text, in bytes.
struct FileEdit<'a> {
    start: usize,
    end: usize,
    text: &'a str,
}

/// The edits as changes of whole lines of the files.
fn in_files(files: &[SourceFile], submission: &Submission, fix: &[TextEdit]) -> Option<Vec<ProposedEdit>> {
    let mut of_files: BTreeMap<&str, (String, Vec<FileEdit<'_>>)> = BTreeMap::new();
    for edit in fix {
        let stage = if edit.stage == Stage::Vertex { &submission.vertex } else { &submission.fragment };
        let file = files.iter().find(|file| file.name == stage.file)?;
        if !of_files.contains_key(stage.file.as_str()) {
            of_files.insert(&stage.file, (decoded(file)?, Vec::new()));
        }
        let (text, edits) = of_files.get_mut(stage.file.as_str())?;
        let (start, end) = (edit.start as usize, edit.end as usize);
        // The position of the character before an insertion is known, that after it may be in another literal.
        let is_insertion = start == end;
        let first = in_file(stage, text, if is_insertion { start.checked_sub(1)? } else { start })?;
        let first = if is_insertion { first + 1 } else { first };
        let after = if is_insertion { first } else { in_file(stage, text, end - 1)? + 1 };
        // Escapes in a string literal are not what the compiler reads.
        if text.get(first..after)? != stage.text.get(start..end)? {
            return None;
        }
        edits.push(FileEdit { start: first, end: after, text: &edit.text });
    }
    let mut all = Vec::new();
    for (file, (text, mut edits)) in of_files {
        edits.sort_by_key(|edit| (edit.start, edit.end));
        if edits.windows(2).any(|pair| pair[0].end > pair[1].start) {
            return None;
        }
        all.extend(whole_lines(file, &text, &edits)?);
    }
    Some(all)
}

/// The byte of the file's text with a byte of the stage's text, which begins a character.
fn in_file(stage: &StageText, file: &str, byte: usize) -> Option<usize> {
    let before = stage.text.get(..byte)?;
    let line = before.matches('\n').count() as u32 + 1;
    let column = before.rsplit('\n').next()?.chars().count() as u32 + 1;
    let (_, line, column) = stage.place(line, column);
    let start: usize = file.split_inclusive('\n').take(line as usize - 1).map(str::len).sum();
    let (offset, _) = file.get(start..)?.char_indices().nth(column as usize - 1)?;
    Some(start + offset)
}

/// Edits of a file in order, as changes of whole lines; edits of the same lines become one.
fn whole_lines(file: &str, text: &str, edits: &[FileEdit<'_>]) -> Option<Vec<ProposedEdit>> {
    let line_start = |byte: usize| text[..byte].rfind('\n').map_or(0, |at| at + 1);
    let line_end = |byte: usize| text[byte..].find('\n').map_or(text.len(), |at| byte + at);
    let mut all: Vec<(usize, usize, String)> = Vec::new();
    for edit in edits {
        let (start, end) = (line_start(edit.start), line_end(edit.end));
        match all.last_mut() {
            // The last edit has already written the rest of its line.
            Some((_, last, after)) if start <= *last => {
                let rest = text.get(edit.end..*last).unwrap_or_default().len();
                let kept = after.len().checked_sub(text.get(edit.start..*last)?.len())?;
                after.truncate(kept);
                after.push_str(edit.text);
                after.push_str(text.get(edit.end..end.max(edit.end + rest))?);
                *last = end.max(*last);
            }
            _ => {
                let after = format!("{}{}{}", text.get(start..edit.start)?, edit.text, text.get(edit.end..end)?);
                all.push((start, end, after));
            }
        }
    }
    let proposed = all.into_iter().map(|(start, end, after)| {
        let line = text.get(..start)?.matches('\n').count() as u32 + 1;
        Some(ProposedEdit { file: file.to_owned(), line, before: text.get(start..end)?.to_owned(), after })
    });
    proposed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edit(stage: Stage, text: &str, old: &str, new: &str) -> TextEdit {
        let start = text.find(old).unwrap() as u32;
        TextEdit { stage, start, end: start + old.len() as u32, text: new.to_owned() }
    }

    const VERTEX: &str =
        "#version 330 core\nin vec3 p; in vec3 q;\nvoid main() {\n    gl_Position = vec4(p,\n  1.0);\n}\n";
    const FRAGMENT: &str = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";

    fn proposed(files: &[SourceFile], edits: &[(Stage, &str, &str)]) -> Option<Vec<ProposedEdit>> {
        let submission = Submission::gather(files.to_vec()).unwrap();
        let text = |stage| if stage == Stage::Vertex { &submission.vertex.text } else { &submission.fragment.text };
        let fix: Vec<TextEdit> = edits.iter().map(|(stage, old, new)| edit(*stage, text(*stage), old, new)).collect();
        in_files(files, &submission, &fix)
    }

    #[test]
    fn edits_become_whole_lines_that_apply_to_the_files() {
        let files = [SourceFile::new("a.vert", VERTEX), SourceFile::new("a.frag", FRAGMENT)];
        let edits = [
            (Stage::Vertex, "in vec3 p", "in vec4 p"),
            (Stage::Vertex, "in vec3 q", "in vec2 q"),
            (Stage::Vertex, "vec4(p,\n  1.0)", "p"),
            (Stage::Fragment, "1.0", "0.5"),
        ];
        let found = proposed(&files, &edits).unwrap();
        let expected = [
            ("a.frag", 3, "void main() { c = vec4(1.0); }", "void main() { c = vec4(0.5); }"),
            ("a.vert", 2, "in vec3 p; in vec3 q;", "in vec4 p; in vec2 q;"),
            ("a.vert", 4, "    gl_Position = vec4(p,\n  1.0);", "    gl_Position = p;"),
        ];
        let found_tuples: Vec<_> =
            found.iter().map(|e| (e.file.as_str(), e.line, e.before.as_str(), e.after.as_str())).collect();
        assert_eq!(found_tuples, expected);
        let changed = with_edits(&files, &found).unwrap();
        let text = String::from_utf8(changed[0].bytes.clone()).unwrap();
        assert_eq!(text, "#version 330 core\nin vec4 p; in vec2 q;\nvoid main() {\n    gl_Position = p;\n}\n");
        assert!(with_edits(&changed, &found).is_none(), "the old lines are gone");
    }

    #[test]
    fn edits_in_string_literals_are_made_in_the_program() {
        let raw = format!("const char* v = R\"({VERTEX})\";\nconst char* f = R\"({FRAGMENT})\";\n");
        let found = proposed(&[SourceFile::new("main.cpp", raw)], &[(Stage::Fragment, "1.0", "0.5")]).unwrap();
        assert_eq!(found[0].before, "void main() { c = vec4(1.0); }");
        let quoted = |text: &str| text.lines().map(|line| format!("  \"{line}\\n\"\n")).collect::<String>();
        let program = format!("const char* v =\n{};\nconst char* f =\n{};\n", quoted(VERTEX), quoted(FRAGMENT));
        let files = [SourceFile::new("main.cpp", program)];
        let found = proposed(&files, &[(Stage::Fragment, "1.0", "0.5")]).unwrap();
        assert_eq!(found[0].after, "  \"void main() { c = vec4(0.5); }\\n\"");
        // A piece over two literals has quotes between them.
        assert_eq!(proposed(&files, &[(Stage::Vertex, "vec4(p,\n  1.0)", "p")]), None);
    }
}
