//! Diagnostics: problems of gonio's own front end, and the messages of a verdict, at the places of open and closed files.

use super::check::CheckResult;
use super::document::OpenDocument;
use super::positions::Lines;
use super::sources::Sources;
use super::uri::uri_of_path;
use gonio_check::source_problems::SourceProblem;
use gonio_check::verdict::{CompilerMessage, Outcome, Verdict};
use gonio_exercises::report::{Annotation, AnnotationKind, COMPILER, WARNING, annotations};
use gonio_glsl::{Severity, Stage};
use gonio_language::tr;
use lsp_types::{Diagnostic, DiagnosticSeverity, NumberOrString, Range};
use std::collections::BTreeMap;

/// The diagnostics of each file, by its URI.
pub type FileDiagnostics = BTreeMap<String, Vec<Diagnostic>>;

/// A file of a pair: its URI, and the text that the places count in.
struct SourceOfFile {
    uri: String,
    text: String,
}

/// Collects the diagnostics of a pair.
struct Collector<'a> {
    sources: &'a Sources,
    open: &'a BTreeMap<String, OpenDocument>,
    found: FileDiagnostics,
}

/// The diagnostics of all files of a pair or single shader. Every file with a shader of it is in the result.
pub fn of_sources(
    sources: &Sources,
    checked: Option<&CheckResult>,
    open: &BTreeMap<String, OpenDocument>,
) -> FileDiagnostics {
    let mut collector = Collector { sources, open, found: FileDiagnostics::new() };
    for (_, text) in &sources.texts {
        if let Some(file) = collector.file(&text.file) {
            collector.found.entry(file.uri).or_default();
        }
    }
    // A driver that accepts a construct has the last word on this machine.
    let compiles = matches!(checked, Some(CheckResult::Verdict(v)) if v.verdict != Outcome::DoesNotCompile);
    for problem in &sources.problems {
        collector.problem(problem, compiles);
    }
    if let Some(sentence) = &sources.complaint {
        collector.at_home(DiagnosticSeverity::INFORMATION, "incomplete", sentence);
    }
    match checked {
        Some(CheckResult::Verdict(verdict)) => collector.verdict(verdict),
        Some(CheckResult::Unavailable { causes, .. }) => causes.iter().for_each(|cause| collector.cause(cause)),
        None => {}
    }
    collector.found
}

impl Collector<'_> {
    /// A file by its name in the submission.
    fn file(&self, name: &str) -> Option<SourceOfFile> {
        let is_it = |document: &&OpenDocument| self.sources.name_of(document) == name && self.is_of_sources(document);
        if let Some(document) = self.open.values().find(is_it) {
            return Some(SourceOfFile { uri: document.uri.as_str().to_owned(), text: document.text.clone() });
        }
        let path = self.sources.folder.as_ref()?.join(name);
        let file = self.sources.files.iter().find(|file| file.name == name).filter(|_| path.is_file())?;
        Some(SourceOfFile {
            uri: uri_of_path(&path)?.as_str().to_owned(),
            text: String::from_utf8_lossy(&file.bytes).into_owned(),
        })
    }

    fn is_of_sources(&self, document: &OpenDocument) -> bool {
        match (&self.sources.submitted, &self.sources.folder) {
            (Some(_), Some(folder)) => document.path.as_ref().is_some_and(|path| path.starts_with(folder)),
            _ => self.sources.key == document.uri.as_str(),
        }
    }

    fn add(&mut self, uri: String, range: Range, severity: DiagnosticSeverity, code: &str, message: String) {
        self.found.entry(uri).or_default().push(Diagnostic {
            range,
            severity: Some(severity),
            code: Some(NumberOrString::String(code.to_owned())),
            source: Some("gonio".to_owned()),
            message,
            ..Diagnostic::default()
        });
    }

    fn problem(&mut self, problem: &SourceProblem, compiles: bool) {
        let Some(file) = self.file(&problem.file) else { return };
        let severity = match problem.severity {
            Severity::Error if !compiles => DiagnosticSeverity::ERROR,
            Severity::Error | Severity::Strict => DiagnosticSeverity::WARNING,
            Severity::Hint => DiagnosticSeverity::HINT,
        };
        let range = Lines::new(&file.text).range(problem.start, problem.end);
        self.add(file.uri, range, severity, problem.code, with_help(&problem.message, problem.help.as_deref()));
    }

    fn verdict(&mut self, verdict: &Verdict) {
        for annotation in annotations(verdict) {
            let is_known = |problem: &SourceProblem| {
                Some(&problem.file) == annotation.file.as_ref() && Some(problem.start[0]) == annotation.line
            };
            // gonio's own front end explains the same line.
            let repeats = [COMPILER, WARNING].contains(&annotation.id.as_str());
            if repeats && self.sources.problems.iter().any(is_known) {
                continue;
            }
            self.annotation(&annotation);
        }
    }

    fn annotation(&mut self, annotation: &Annotation) {
        let severity = match annotation.kind {
            AnnotationKind::Error => DiagnosticSeverity::ERROR,
            AnnotationKind::Warning => DiagnosticSeverity::WARNING,
            AnnotationKind::Note => return,
        };
        let message = with_help(&annotation.message, annotation.help.as_deref());
        let file = annotation.file.as_deref().and_then(|file| self.file(file));
        match (file, annotation.line) {
            (Some(file), Some(line)) => {
                let lines = Lines::new(&file.text);
                let range = annotation.column.map(|column| lines.word_at([line, column]));
                let range = range.unwrap_or_else(|| lines.text_of_line(line));
                self.add(file.uri, range, severity, &annotation.id, message);
            }
            // Warnings without a place are about files that were ignored.
            _ if annotation.id == WARNING => {}
            _ => self.at_home(severity, &annotation.id, &message),
        }
    }

    fn cause(&mut self, cause: &CompilerMessage) {
        let (Some(file), Some(line), Some(column)) = (self.file(&cause.file), cause.line, cause.column) else { return };
        let range = Lines::new(&file.text).word_at([line, column]);
        self.add(file.uri, range, DiagnosticSeverity::ERROR, "wrong-value", cause.text.clone());
    }

    /// A message about the pair as a whole, at the first line of its fragment shader.
    fn at_home(&mut self, severity: DiagnosticSeverity, code: &str, message: &str) {
        let of_stage = |wanted: Stage| self.sources.texts.iter().find(|(stage, _)| *stage == wanted);
        let text = of_stage(Stage::Fragment).or_else(|| of_stage(Stage::Vertex));
        let Some(file) = text.and_then(|(_, text)| self.file(&text.file)) else { return };
        let range = Lines::new(&file.text).text_of_line(1);
        self.add(file.uri, range, severity, code, message.to_owned());
    }
}

fn with_help(message: &str, help: Option<&str>) -> String {
    match help {
        Some(help) => format!("{message}\n{} {help}", tr!("editor-advice")),
        None => message.to_owned(),
    }
}
