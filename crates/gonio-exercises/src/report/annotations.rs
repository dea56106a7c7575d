//! A verdict as messages at places of the student's files, as compilers print them: for editors and build servers.

use super::text::line;
use gonio_check::verdict::{CompilerMessage, FoundMistake, Outcome, Verdict};
use gonio_language::tr;
use std::fmt::Write as _;

/// The weight of an [`Annotation`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnnotationKind {
    /// It has to change for the answer to be right.
    Error,
    /// It may be wrong elsewhere, or could not be judged.
    Warning,
    /// Right, and worth knowing.
    Note,
}

impl AnnotationKind {
    /// The word of compilers, and the level of SARIF.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            AnnotationKind::Error => "error",
            AnnotationKind::Warning => "warning",
            AnnotationKind::Note => "note",
        }
    }
}

/// A message of a verdict, with its place if it has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Annotation {
    /// Its weight.
    pub kind: AnnotationKind,
    /// A mistake's id in the catalogue, or one of [`COMPILER`], [`WARNING`] and [`VERDICT`].
    pub id: String,
    /// The student's file, as the verdict names it.
    pub file: Option<String>,
    /// The line in that file, from 1.
    pub line: Option<u32>,
    /// The column, in characters from 1.
    pub column: Option<u32>,
    /// The message, without its place.
    pub message: String,
    /// How to fix it, or what a compiler's message means.
    pub help: Option<String>,
}

/// The id of compilers' messages.
pub const COMPILER: &str = "compiler";
/// The id of warnings.
pub const WARNING: &str = "warning";
/// The id of a verdict that names no mistake.
pub const VERDICT: &str = "verdict";

impl Annotation {
    fn new(kind: AnnotationKind, id: &str, message: &str) -> Self {
        let (id, message) = (id.to_owned(), message.to_owned());
        Annotation { kind, id, file: None, line: None, column: None, message, help: None }
    }

    fn of_compiler(message: &CompilerMessage) -> Self {
        Annotation {
            file: Some(message.file.clone()),
            line: message.line,
            column: message.column,
            help: message.explanation.clone(),
            ..Annotation::new(AnnotationKind::Error, COMPILER, &message.text)
        }
    }

    fn of_mistake(found: &FoundMistake) -> Self {
        let mut message = found.name.clone();
        if !found.or.is_empty() {
            let _ = write!(message, ". {}", tr!("terminal-not-distinguished-from", ids = found.or.join(", ")));
        }
        Annotation {
            file: found.file.clone(),
            line: found.line,
            help: (!found.fix.is_empty()).then(|| found.fix.clone()),
            ..Annotation::new(AnnotationKind::Error, &found.id, &message)
        }
    }

    /// A warning; many begin with their place, `FILE:LINE: `.
    fn of_warning(warning: &str) -> Self {
        let (place, text) = placed(warning).map_or((None, warning), |(file, line, text)| (Some((file, line)), text));
        Annotation {
            file: place.map(|(file, _)| file.to_owned()),
            line: place.map(|(_, line)| line),
            ..Annotation::new(AnnotationKind::Warning, WARNING, text)
        }
    }
}

/// The parts of `FILE:LINE: TEXT`.
fn placed(warning: &str) -> Option<(&str, u32, &str)> {
    let (place, text) = warning.split_once(": ")?;
    let (file, line) = place.rsplit_once(':')?;
    Some((file, line.parse().ok()?, text))
}

/// The messages of a verdict: those of compilers, mistakes, warnings, and other methods that are right. A verdict that is not
/// right has at least one.
#[must_use]
pub fn annotations(verdict: &Verdict) -> Vec<Annotation> {
    let mut all: Vec<Annotation> = verdict.messages.iter().map(Annotation::of_compiler).collect();
    all.extend(verdict.mistakes.iter().map(Annotation::of_mistake));
    if all.is_empty() && verdict.verdict != Outcome::Correct {
        let kind = match verdict.verdict {
            Outcome::Unsure => AnnotationKind::Warning,
            _ => AnnotationKind::Error,
        };
        all.push(Annotation::new(kind, VERDICT, &verdict.summary));
    }
    all.extend(verdict.warnings.iter().map(|warning| Annotation::of_warning(warning)));
    let note = |id: &str, name: &str| Annotation::new(AnnotationKind::Note, id, name);
    all.extend(verdict.peculiarities.iter().map(|peculiarity| note(&peculiarity.id, &peculiarity.name)));
    all
}

/// The annotations as lines of a compiler, `FILE:LINE:COLUMN: error: MESSAGE [ID]`, which editors and build servers recognise;
/// columns are characters. `path_of` turns a verdict's name of a file into a path.
#[must_use]
pub fn gcc(annotations: &[Annotation], path_of: impl Fn(&str) -> String) -> String {
    let mut text = String::new();
    for annotation in annotations {
        let mut place = annotation.file.as_deref().map_or_else(|| "gonio".to_owned(), |file| line(&path_of(file)));
        for number in [annotation.line, annotation.column.filter(|_| annotation.line.is_some())].into_iter().flatten() {
            let _ = write!(place, ":{number}");
        }
        let (word, id) = (annotation.kind.word(), line(&annotation.id));
        let _ = writeln!(text, "{place}: {word}: {} [{id}]", line(&annotation.message));
        if let Some(help) = &annotation.help {
            let _ = writeln!(text, "{place}: note: {}", line(help));
        }
    }
    text
}

/// The annotations as workflow commands of GitHub Actions, which shows them in a change's files.
#[must_use]
pub fn github(annotations: &[Annotation], path_of: impl Fn(&str) -> String) -> String {
    let mut text = String::new();
    for annotation in annotations {
        let command = match annotation.kind {
            AnnotationKind::Error => "error",
            AnnotationKind::Warning => "warning",
            AnnotationKind::Note => "notice",
        };
        let mut properties = Vec::new();
        if let Some(file) = &annotation.file {
            properties.push(format!("file={}", property(&path_of(file))));
            properties.extend(annotation.line.map(|line| format!("line={line}")));
            properties.extend(annotation.column.filter(|_| annotation.line.is_some()).map(|c| format!("col={c}")));
        }
        properties.push(format!("title={}", property(&annotation.id)));
        let help = annotation.help.iter().map(|help| format!("%0A{}", data(help)));
        let _ = writeln!(
            text,
            "::{command} {}::{}{}",
            properties.join(","),
            data(&annotation.message),
            help.collect::<String>()
        );
    }
    text
}

/// The message of a workflow command.
fn data(text: &str) -> String {
    line(text).replace('%', "%25")
}

/// A property of a workflow command, in which a colon and a comma have a meaning too.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::verdict::Peculiarity;

    fn wrong() -> Verdict {
        let mut verdict = Verdict::new("ex04", Outcome::Wrong, "The normal is not transformed");
        let found = FoundMistake::new("normal-raw", "The normal is not transformed", 1.0);
        verdict.mistakes = vec![found.taught("", "100 %: multiply\nit", "").at("a b,c:\u{1b}.vert", Some(3), "")];
        verdict.warnings = vec!["a.frag:7: `1` is an int; others refuse it".into(), "ignored: x: y.txt".into()];
        verdict.peculiarities = vec![Peculiarity { id: "half-vector".into(), name: "Blinn's half vector".into() }];
        verdict
    }

    #[test]
    fn a_verdict_becomes_lines_of_a_compiler() {
        let text = gcc(&annotations(&wrong()), |file| format!("mine/{file}"));
        let expected = "mine/a b,c:\\x1b.vert:3: error: The normal is not transformed [normal-raw]\n\
                        mine/a b,c:\\x1b.vert:3: note: 100 %: multiply it\n\
                        mine/a.frag:7: warning: `1` is an int; others refuse it [warning]\n\
                        gonio: warning: ignored: x: y.txt [warning]\n\
                        gonio: note: Blinn's half vector [half-vector]\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_workflow_command_cannot_be_left_by_a_name_or_a_message() {
        let text = github(&annotations(&wrong()), str::to_owned);
        let lines: Vec<&str> = text.lines().collect();
        let place = "file=a b%2Cc%3A\\x1b.vert,line=3,title=normal-raw";
        assert_eq!(lines[0], format!("::error {place}::The normal is not transformed%0A100 %25: multiply it"));
        assert_eq!(lines[1], "::warning file=a.frag,line=7,title=warning::`1` is an int; others refuse it");
        assert_eq!(lines[3], "::notice title=half-vector::Blinn's half vector");
    }

    #[test]
    fn a_verdict_without_mistakes_is_a_message_unless_it_is_right() {
        let of = |outcome| annotations(&Verdict::new("ex04", outcome, "3 of 8 test scenes are right"));
        assert!(of(Outcome::Correct).is_empty());
        for (outcome, kind) in [(Outcome::Wrong, AnnotationKind::Error), (Outcome::Unsure, AnnotationKind::Warning)] {
            assert_eq!(of(outcome), [Annotation::new(kind, VERDICT, "3 of 8 test scenes are right")]);
        }
    }
}
