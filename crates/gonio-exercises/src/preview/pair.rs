//! Reads and compiles a pair of shaders while it is being written.

use crate::exercise::Exercise;
use gonio_check::comparison::declared;
use gonio_check::compile::{self, ParsedStage};
use gonio_check::roles::{self, Bindings, NamesError, NamesFile};
use gonio_check::source_problems::{SourceProblem, SourceStage, pair_problems};
use gonio_check::submission::{SourceFile, StageText, Submission};
use gonio_check::verdict::CompilerMessage;
use gonio_gl::Gl;
use gonio_glsl::{Class, OutputVersion, Severity, Stage};
use gonio_language::tr;
use gonio_render::user_program::{UserProgram, is_embedded};

/// The severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoteKind {
    /// Other compilers may reject it.
    Warning,
    /// It does not compile.
    Error,
}

/// A message about a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The severity.
    pub kind: NoteKind,
    /// The message and its location.
    pub message: CompilerMessage,
}

/// A pair of shaders among a student's files, read but not compiled.
#[derive(Clone, Debug)]
pub struct SubmittedPair {
    submission: Submission,
    names: NamesFile,
}

/// A pair of shaders that runs.
pub struct CompiledPair {
    /// The program.
    pub program: UserProgram,
    /// The roles of its variables.
    pub bindings: Bindings,
    /// Constructs that other compilers may reject, by file and line.
    pub notes: Vec<Note>,
    /// Guesses, corrections, ignored files, and unused names of `names.toml`, one sentence each.
    pub warnings: Vec<String>,
}

/// Longer texts, in bytes, were not written by hand.
const LONG: usize = 200_000;
/// Larger numbers are array sizes that nobody writes by hand.
const LARGE: u64 = 4096;
/// A larger number of macros may expand exponentially.
const MANY_MACROS: usize = 16;

impl SubmittedPair {
    /// Finds the pair.
    ///
    /// # Errors
    /// The reason why there is none, in one sentence.
    pub fn gather(exercise: &Exercise, files: Vec<SourceFile>) -> Result<Self, String> {
        Self::gather_choosing(exercise, files, None)
    }

    /// Finds the pair whose file or variable has a name; `None`: any.
    ///
    /// # Errors
    /// The reason why there is none, in one sentence.
    pub fn gather_choosing(exercise: &Exercise, files: Vec<SourceFile>, name: Option<&str>) -> Result<Self, String> {
        let is_text = |name: &str| [".md", ".svg", ".obj"].iter().any(|end| name.ends_with(end));
        let files = files.into_iter().filter(|file| !is_text(&file.name)).collect();
        let submission =
            Submission::gather_with(files, name, &[exercise.id.as_str()]).map_err(|error| error.to_string())?;
        let names = submission.names.as_deref().map(NamesFile::parse).transpose();
        let names = names.map_err(|error: NamesError| error.to_string())?.unwrap_or_default();
        Ok(SubmittedPair { submission, names })
    }

    /// What `names.toml` states.
    pub(crate) fn names(&self) -> &NamesFile {
        &self.names
    }

    /// The problems that gonio's own front end finds, without a driver.
    #[must_use]
    pub fn source_problems(&self) -> Vec<SourceProblem> {
        pair_problems(
            &SourceStage::new(&self.submission.vertex, Stage::Vertex),
            &SourceStage::new(&self.submission.fragment, Stage::Fragment),
        )
    }

    /// The text of a stage.
    #[must_use]
    pub fn text(&self, stage: Stage) -> &StageText {
        if stage == Stage::Vertex { &self.submission.vertex } else { &self.submission.fragment }
    }

    /// The texts of both stages.
    pub(crate) fn submission(&self) -> &Submission {
        &self.submission
    }

    /// Whether a driver that compiles or draws the pair may hang: there are loops, or something is large. Such a pair is first
    /// tried in another process.
    pub fn is_risky(&self) -> bool {
        [&self.submission.vertex.text, &self.submission.fragment.text].into_iter().any(|text| is_risky(text))
    }

    /// Compiles the pair.
    ///
    /// # Errors
    /// Errors by file and line; never an empty list.
    pub fn compile(&self, gl: &Gl) -> Result<CompiledPair, Vec<Note>> {
        let target = if is_embedded(gl) { OutputVersion::Es300 } else { OutputVersion::Core330 };
        let vertex = ParsedStage::new(&self.submission.vertex, Stage::Vertex, target);
        let fragment = ParsedStage::new(&self.submission.fragment, Stage::Fragment, target);
        let program = compile::compile(gl, &vertex, &fragment).map_err(|broken| {
            let mut messages = compile::compiler_messages(&broken, &vertex, &fragment);
            if messages.is_empty() {
                messages.push(CompilerMessage {
                    file: self.submission.fragment.file.clone(),
                    line: None,
                    column: None,
                    text: broken.to_string(),
                    quoted: None,
                    explanation: None,
                });
            }
            messages.into_iter().map(|message| Note { kind: NoteKind::Error, message }).collect::<Vec<_>>()
        })?;
        let bindings = roles::bind(&declared(&program), &self.names);
        let notes = [&vertex, &fragment]
            .into_iter()
            .flat_map(|stage| {
                let strict = stage.problems().filter(|problem| problem.severity != Severity::Hint);
                strict.map(|problem| Note { kind: NoteKind::Warning, message: stage.message(problem) })
            })
            .collect();
        let unused =
            bindings.unused.iter().map(|name| tr!("check-preview-names-toml-mentions-which-the-shaders", name = name));
        let warnings = self.submission.warnings.iter().cloned().chain(unused).collect();
        Ok(CompiledPair { program, bindings, notes, warnings })
    }
}

fn is_risky(text: &str) -> bool {
    if text.len() > LONG {
        return true;
    }
    let mut macros = 0;
    gonio_glsl::classify(text).iter().any(|part| {
        let word = text.get(part.start as usize..part.end as usize).unwrap_or_default();
        match part.class {
            Class::Keyword => matches!(word, "for" | "while" | "do"),
            // Loops in macros, and nested macros.
            Class::Directive => {
                macros += usize::from(word == "define");
                matches!(word, "for" | "while" | "do") || macros > MANY_MACROS
            }
            Class::Number => word.parse::<u64>().is_ok_and(|number| number > LARGE),
            _ => false,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::{self, ExerciseKind};

    #[test]
    fn shaders_that_may_never_end_are_risky() {
        for (text, risky) in [
            ("void main() { }", false),
            ("#define N 4\nvoid main() { int a = 4096; float forward = 1e9; } // for ever", false),
            ("void main() { for (;;) {} }", true),
            ("void main() { while(true) {} }", true),
            ("#define LOOP for(;;)\nvoid main() { LOOP {} }", true),
            ("float a[100000];", true),
        ] {
            assert_eq!(is_risky(text), risky, "{text}");
        }
        assert!(is_risky(&"#define A A\n".repeat(20)));
        assert!(is_risky(&" ".repeat(LONG + 1)));
    }

    #[test]
    fn every_reference_is_a_pair_and_none_is_risky() {
        for exercise in exercise::all().iter().filter(|exercise| exercise.kind == ExerciseKind::Shaders) {
            let source = crate::preview::reference(exercise).unwrap_or_else(|error| panic!("{}: {error}", exercise.id));
            assert!(!source.is_risky(), "{}", exercise.id);
        }
    }
}
