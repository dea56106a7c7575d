//! Compiles a pair of shaders, and reports errors and portability problems at the student's own lines.

use crate::driver_log::{self, DriverMessage};
use crate::submission::StageText;
use crate::verdict::{CompilerMessage, Outcome, Verdict};
use gonio_gl::Gl;
use gonio_glsl::{
    Checked, Limit, Lookup, LoopBound, OutputVersion, Parsed, Problem, Severity, Stage, Translated, Variable,
};
use gonio_language::tr;
use gonio_render::user_program::{BrokenProgram, UserProgram};

/// A shader of a submission, parsed, checked and translated for the context.
pub struct ParsedStage<'a> {
    /// The student's text.
    pub text: &'a StageText,
    /// The syntax tree.
    pub parsed: Parsed,
    /// Names and types.
    pub checked: Checked,
    /// The text that the driver compiles.
    pub translated: Translated,
    pub(crate) target: OutputVersion,
}

impl<'a> ParsedStage<'a> {
    /// Parses, checks and translates a shader. Loops are bounded by [`LoopBound::STUDENTS`].
    pub fn new(text: &'a StageText, stage: Stage, target: OutputVersion) -> Self {
        let mut parsed = gonio_glsl::parse(&text.text);
        let checked = gonio_glsl::check(&mut parsed, stage);
        let translated = gonio_glsl::translate_bounded(&parsed, &checked, target, Some(LoopBound::STUDENTS));
        ParsedStage { text, parsed, checked, translated, target }
    }

    /// Returns the stage changed to output the result of this lookup.
    pub fn showing(&self, lookup: Lookup) -> String {
        let bound = Some(LoopBound::STUDENTS);
        gonio_glsl::translate_showing(&self.parsed, &self.checked, self.target, bound, Some(lookup)).text
    }

    /// Returns the cubemap lookups.
    pub fn lookups(&self) -> Vec<Lookup> {
        gonio_glsl::lookups(&self.parsed)
    }

    /// Every problem that the parser and the type checker found.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        self.parsed.problems.iter().chain(&self.checked.problems)
    }

    /// Returns the limit of size or depth that the shader exceeds, if any. It must not be given to a driver then.
    pub fn refusal(&self) -> Option<&Problem> {
        self.parsed.refusal().or(self.checked.refusal())
    }

    /// Whether the shader is within the limits of size and depth, and has no error that the parser and the type checker find.
    pub fn is_accepted(&self) -> bool {
        self.refusal().is_none() && !self.problems().any(|problem| problem.severity == Severity::Error)
    }

    /// Converts a problem to a message with its position in the student's file.
    pub fn message(&self, problem: &Problem) -> CompilerMessage {
        let (file, line, column) = self.text.place(problem.span.line, problem.span.column);
        CompilerMessage {
            file: file.to_owned(),
            line: Some(line),
            column: Some(column),
            text: problem.message.clone(),
            quoted: self.text.line(problem.span.line).map(str::to_owned),
            explanation: problem.help.clone(),
        }
    }
}

/// Most messages of one kind. Errors that follow from the first one do not help.
const MOST_MESSAGES: usize = 12;

/// Compiles and links, unless a shader exceeds a limit of size or depth: drivers have no such limits and would crash
/// this process.
pub fn compile(gl: &Gl, vertex: &ParsedStage<'_>, fragment: &ParsedStage<'_>) -> Result<UserProgram, BrokenProgram> {
    if vertex.refusal().is_some() || fragment.refusal().is_some() {
        let log = |stage: &ParsedStage<'_>| stage.refusal().map(|problem| problem.message.clone());
        return Err(BrokenProgram { vertex_log: log(vertex), fragment_log: log(fragment), ..BrokenProgram::default() });
    }
    let program = UserProgram::new(gl, &vertex.translated.text, &with_names_of(vertex, fragment))?;
    // The translation may have corrected an error that every compiler reports in the student's own text.
    if !vertex.is_accepted() || !fragment.is_accepted() {
        UserProgram::new(gl, &vertex.text.text, &fragment.text.text)?;
    }
    // This driver may be lenient: a construct that the version does not have is wrong in any case.
    let missing = |stage: &ParsedStage<'_>| {
        let is_missing = |p: &Problem| p.severity == Severity::Error && NOT_IN_VERSION.contains(&p.code);
        stage.problems().any(is_missing).then(String::new)
    };
    match (missing(vertex), missing(fragment)) {
        (None, None) => Ok(program),
        (vertex_log, fragment_log) => Err(BrokenProgram { vertex_log, fragment_log, ..BrokenProgram::default() }),
    }
}

/// The fragment shader with the names of the vertex shader's outputs for inputs that have only a location in common with
/// them: the translation's version has no locations between the stages.
fn with_names_of(vertex: &ParsedStage<'_>, fragment: &ParsedStage<'_>) -> String {
    let text = &fragment.translated.text;
    let outputs = &vertex.checked.interface.outputs;
    let same = |input: &Variable| {
        let output = outputs.iter().find(|output| output.location.is_some() && output.location == input.location)?;
        (output.name != input.name).then(|| (input.name.clone(), output.name.clone()))
    };
    let same: Vec<(String, String)> = fragment.checked.interface.inputs.iter().filter_map(same).collect();
    // Another variable may have the name, unless it gets a new one too.
    let is_free =
        |(_, new): &&(String, String)| same.iter().any(|(old, _)| old == new) || !words(text).any(|word| word == new);
    let renamed: Vec<&(String, String)> = same.iter().filter(is_free).collect();
    if renamed.is_empty() {
        return text.clone();
    }
    let (mut changed, mut after_point) = (String::with_capacity(text.len()), false);
    for word in words(text) {
        let new = renamed.iter().find(|(old, _)| *old == word && !after_point);
        changed.push_str(new.map_or(word, |(_, new)| new));
        after_point = word.trim_end().ends_with('.');
    }
    changed
}

/// The names in a text, and what is between them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = text;
    std::iter::from_fn(move || {
        let is_name = is_of_name(rest.chars().next()?);
        let end = rest.find(|c: char| is_of_name(c) != is_name).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        rest = after;
        Some(word)
    })
}

/// Problems that Mesa does not report: `texture2D` in `#version 300 es` (GLSL ES 3.00, section 8.8, has no such
/// function; the reference compiler and browsers reject it).
const NOT_IN_VERSION: [&str; 1] = ["old-function"];
/// Reports a varying that the vertex shader does not write. The specification requires an error, but not every driver
/// reports one.
pub(crate) fn does_not_link(exercise: &str, vertex: &ParsedStage<'_>, fragment: &ParsedStage<'_>) -> Option<Verdict> {
    let messages = not_given(vertex, fragment);
    let first = messages.first()?;
    let mut verdict = Verdict::new(exercise, Outcome::DoesNotCompile, "");
    verdict.summary = match first.line {
        Some(line) => format!("{}:{line}: {}", first.file, first.text),
        None => format!("{}: {}", first.file, first.text),
    };
    verdict.messages = messages;
    Some(verdict)
}

/// Returns the errors of inputs that the fragment shader reads and the vertex shader does not write.
pub(crate) fn not_given(vertex: &ParsedStage<'_>, fragment: &ParsedStage<'_>) -> Vec<CompilerMessage> {
    let problems = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
    let refused = |p: &&Problem| p.severity == Severity::Error && p.code == "not-given";
    problems.iter().filter(refused).take(MOST_MESSAGES).map(|p| fragment.message(p)).collect()
}

/// Returns the driver's messages at the student's lines. A message of gonio's own parser precedes it on the same
/// line, or if the driver names no line, because it is easier to understand.
pub fn compiler_messages(
    broken: &BrokenProgram,
    vertex: &ParsedStage<'_>,
    fragment: &ParsedStage<'_>,
) -> Vec<CompilerMessage> {
    let mut shown = Vec::new();
    for (stage, log) in [(vertex, &broken.vertex_log), (fragment, &broken.fragment_log)] {
        let Some(log) = log else { continue };
        if let Some(refusal) = stage.refusal().filter(|refusal| refusal.limit != Some(Limit::SyntaxErrors)) {
            // Further messages may follow from this one.
            shown.push(stage.message(refusal));
            continue;
        }
        let own: Vec<CompilerMessage> =
            stage.problems().filter(|p| p.severity == Severity::Error).map(|p| stage.message(p)).collect();
        if own.is_empty() {
            let messages = driver_log::to_messages(log, stage.text, stage.translated.first_line);
            shown.extend(messages.into_iter().take(MOST_MESSAGES).map(from_driver));
        } else {
            shown.extend(own.into_iter().take(MOST_MESSAGES));
        }
    }
    if let Some(log) = &broken.link_log {
        let own: Vec<CompilerMessage> = gonio_glsl::check_pair(&vertex.checked, &fragment.checked)
            .iter()
            .filter(|p| p.severity == Severity::Error)
            .map(|p| fragment.message(p))
            .collect();
        if own.is_empty() {
            let messages = driver_log::link_messages(log, vertex.text, fragment.text);
            shown.extend(messages.into_iter().take(MOST_MESSAGES).map(from_driver));
        } else {
            shown.extend(own.into_iter().take(MOST_MESSAGES));
        }
    }
    shown
}

fn from_driver(message: DriverMessage) -> CompilerMessage {
    CompilerMessage {
        file: message.file,
        line: message.line,
        column: message.column,
        text: message.text,
        quoted: message.quoted,
        explanation: message.explanation,
    }
}

pub(crate) fn first_message(messages: &[CompilerMessage], broken: &BrokenProgram) -> String {
    match messages.first() {
        Some(CompilerMessage { file, line: Some(line), text, .. }) => format!("{file}:{line}: {text}"),
        Some(message) => format!("{}: {}", message.file, message.text),
        None => broken.to_string(),
    }
}

/// Returns the constructs that this driver accepts and others may reject.
pub(crate) fn strictness(vertex: &ParsedStage<'_>, fragment: &ParsedStage<'_>) -> Vec<String> {
    let warning = |stage: &ParsedStage<'_>, problem: &Problem| {
        let (file, line, _) = stage.text.place(problem.span.line, problem.span.column);
        tr!("check-compiler-other-compilers-may-reject-it", file = file, line = line, message = problem.message)
    };
    let mut warnings: Vec<String> = Vec::new();
    for stage in [vertex, fragment] {
        warnings.extend(stage.problems().filter(|p| p.severity != Severity::Hint).map(|p| warning(stage, p)));
    }
    let pair = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
    warnings.extend(pair.iter().filter(|p| p.severity != Severity::Hint).map(|p| warning(fragment, p)));
    warnings.truncate(MOST_MESSAGES);
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_get_the_names_of_the_outputs_at_their_locations() {
        let vertex = "#version 410 core\nlayout(location = 0) out vec3 a;\nlayout(location = 1) out vec3 b;\nlayout(location = 2) out vec2 uv;\n\
                      void main() { a = b = vec3(1.0); uv = vec2(0.0); gl_Position = vec4(0.0); }\n";
        let fragment = "#version 410 core\nlayout(location = 1) in vec3 a;\nlayout(location = 0) in vec3 other;\nlayout(location = 2) in vec2 st;\n\
                        out vec4 c;\nstruct S { vec3 a; };\nvoid main() { S s = S(a); float uv = st.x; c = vec4(s.a * other, uv); }\n";
        let texts = [StageText::whole("a.vert", vertex), StageText::whole("a.frag", fragment)];
        let vertex = ParsedStage::new(&texts[0], Stage::Vertex, OutputVersion::Core330);
        let fragment = ParsedStage::new(&texts[1], Stage::Fragment, OutputVersion::Core330);
        let text = with_names_of(&vertex, &fragment);
        // The two change places; a member and a local variable keep their names.
        for part in ["vec3 b;", "vec3 a;", "S(b)", "s.a * a", "float uv = st.x"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
}
