//! Messages of compilers and linkers, placed in the student's file and explained.

mod explain;
mod log;

pub use explain::explain;
pub use log::{LogLine, LogSeverity, read_log};

use crate::submission::{StageText, without_comments};
use crate::words::distance;
use gonio_language::tr;
use std::collections::BTreeSet;

/// A message of a driver with its position in the student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DriverMessage {
    /// The severity.
    pub severity: LogSeverity,
    /// The student's file.
    pub file: String,
    /// The line, if the driver named one.
    pub line: Option<u32>,
    /// The column, if the driver named one.
    pub column: Option<u32>,
    /// The driver's message.
    pub text: String,
    /// The text of the student's line.
    pub quoted: Option<String>,
    /// An explanation and a fix, for common messages.
    pub explanation: Option<String>,
}

/// Returns the messages of one stage's log. `first_line` is the line of the compiled text on which the stage's text
/// begins, from 1 (gonio may insert lines before it).
#[must_use]
pub fn to_messages(log: &str, stage: &StageText, first_line: u32) -> Vec<DriverMessage> {
    let mut messages: Vec<DriverMessage> = Vec::new();
    let lines: Vec<&str> = stage.text.lines().collect();
    for LogLine { line, column, severity, text } in read_log(log) {
        let text_line = line.map(|line| line.saturating_sub(first_line.max(1) - 1).max(1));
        let quoted =
            text_line.and_then(|line| lines.get(usize::try_from(line).ok()? - 1)).map(|line| (*line).to_owned());
        let place = text_line.map(|line| stage.place(line, column.unwrap_or(0)));
        let explanation = [explain(&text), similar_name(&text, stage), before(&text, text_line, &lines, stage)];
        let explanation: Vec<String> = explanation.into_iter().flatten().collect();
        messages.push(DriverMessage {
            severity,
            file: stage.file.clone(),
            line: place.map(|(_, line, _)| line),
            column: place.and_then(|(_, _, found)| column.map(|_| found)),
            text,
            quoted,
            explanation: (!explanation.is_empty()).then(|| explanation.join(" ")),
        });
    }
    messages
}

/// Returns the messages of a linker's log. A message that names a variable is placed at its declaration.
#[must_use]
pub fn link_messages(log: &str, vertex: &StageText, fragment: &StageText) -> Vec<DriverMessage> {
    read_log(log)
        .into_iter()
        .map(|LogLine { severity, text, .. }| {
            let named = explain::quoted_names(&text);
            let rather_fragment = text.to_lowercase().find("fragment").is_some_and(|at| at < 10);
            let stages = if rather_fragment { [fragment, vertex] } else { [vertex, fragment] };
            let found = stages.iter().find_map(|stage| {
                let (line, column) = named.iter().find_map(|name| declaration(stage, name))?;
                Some((*stage, line, column))
            });
            let place = found.map(|(stage, line, column)| stage.place(line, column));
            DriverMessage {
                severity,
                file: found.map_or(stages[0], |(stage, ..)| stage).file.clone(),
                line: place.map(|(_, line, _)| line),
                column: place.map(|(_, _, column)| column),
                quoted: found.and_then(|(stage, line, _)| stage.line(line)).map(str::to_owned),
                explanation: explain(&text),
                text,
            }
        })
        .collect()
}

/// Returns the line and column of the declaration of a global variable.
fn declaration(stage: &StageText, name: &str) -> Option<(u32, u32)> {
    let qualifiers = ["in", "out", "uniform", "varying", "attribute"];
    let code = without_comments(&stage.text);
    for (line, text) in (1u32..).zip(code.lines()) {
        let words = || identifiers(text);
        if words().any(|(_, word)| qualifiers.contains(&word))
            && let Some((at, _)) = words().find(|(_, word)| *word == name)
        {
            let column = text.get(..at).map_or(0, |before| before.chars().count()) + 1;
            return Some((line, u32::try_from(column).unwrap_or(u32::MAX)));
        }
    }
    None
}

/// Returns the identifiers of a line and their columns.
fn identifiers(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_outside = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    let mut next = 0;
    text.split_inclusive(is_outside).filter_map(move |piece| {
        let at = next;
        next += piece.len();
        let word = piece.trim_end_matches(is_outside);
        (!word.is_empty()).then_some((at, word))
    })
}

/// Suggests a similar name of the shader for an undeclared one.
fn similar_name(text: &str, stage: &StageText) -> Option<String> {
    if !explain::is_undeclared(text) {
        return None;
    }
    let name = explain::quoted_names(text).into_iter().next()?;
    let known: BTreeSet<&str> = identifiers(&stage.text).map(|(_, word)| word).take(20_000).collect();
    let may_be = |word: &&str| *word != name && word.len() > 2 && !word.starts_with(|c: char| c.is_ascii_digit());
    let (slips, word) = known.iter().copied().filter(may_be).map(|word| (distance(word, &name), word)).min()?;
    let near = slips <= 2 && slips * 3 <= name.len() || word.eq_ignore_ascii_case(&name);
    near.then(|| tr!("check-compiler-did-you-mean", word = word))
}

/// Points to the line before a syntax error, if its semicolon is missing.
fn before(text: &str, line: Option<u32>, lines: &[&str], stage: &StageText) -> Option<String> {
    if !explain::is_syntax(text) {
        return None;
    }
    let at = usize::try_from(line?).ok()?;
    let (index, code) = (0..at.saturating_sub(1)).rev().take(20).find_map(|index| {
        let code = lines.get(index)?.split("//").next().unwrap_or_default().trim();
        (!code.is_empty()).then_some((index, code))
    })?;
    let ended =
        code.starts_with('#') || code.ends_with([';', '{', '}', ',', '(', '*', '/', '+', '-', '=', '&', '|', '?', ':']);
    let head = code.ends_with(')') && ["if", "for", "while", "void"].iter().any(|word| code.starts_with(word));
    if ended || head || code == "else" {
        return None;
    }
    let (_, line, _) = stage.place(u32::try_from(index + 1).ok()?, 0);
    Some(tr!("check-compiler-line-ends-without-a-semicolon", line = line, code = code))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::submission::{SourceFile, Submission};

    #[test]
    fn usual_messages_are_explained() {
        let mut wrong = Vec::new();
        for (message, says) in [
            // Mesa
            ("`lightPos' undeclared", "`lightPos` is not declared"),
            (
                "initializer of type vec4 cannot be assigned to variable of type vec3",
                "a different type from the variable on the left",
            ),
            ("value of type vec4 cannot be assigned to variable of type vec3", "different types"),
            ("syntax error, unexpected NEW_IDENTIFIER, expecting ',' or ';'", "semicolon or a bracket"),
            ("assignment to read-only variable 'n'", "`n` cannot be changed"),
            ("no function with name 'texture2D'", "are called `texture`"),
            ("`gl_FragColor' undeclared", "out vec4 FragColor"),
            ("too few components to construct `vec4'", "Too few values"),
            ("too many parameters to `vec3' constructor", "Too many values"),
            ("vector size mismatch for arithmetic operator", "two sides of the operator"),
            ("size mismatch for matrix multiplication", "two sides of the operator"),
            ("operands to arithmetic operators must be numeric", "two sides of the operator"),
            (
                "no matching function for call to `dot(vec3, vec4)'; candidates are: float dot(vec3, vec3)",
                "No function `dot`",
            ),
            ("`c' redeclared", "`c` is declared twice"),
            ("illegal use of reserved word `input'", "`input` is reserved in GLSL"),
            ("if-statement condition must be scalar boolean", "A condition must be a bool"),
            ("GLSL 7.77 is not supported. Supported versions are: 1.10", "does not support that `#version`"),
            ("#version must appear on the first line", "must be the first line"),
            ("vertex shader lacks `main'", "There is no `void main()`"),
            (
                "fragment shader input `v_n' has no matching output in the previous stage",
                "the vertex shader has no `out`",
            ),
            (
                "vertex shader output `v' declared as type `vec3', but fragment shader input declared as type `vec4'",
                "`v` is declared in both stages with different types",
            ),
            (
                "uniform `u' declared as type `vec3' and type `vec4'",
                "uniform `u` is declared in both stages with different types",
            ),
            ("invalid swizzle / mask `w'", "follows the dot"),
            ("cannot dereference non-array / non-matrix / non-vector", "Square brackets"),
            ("`c' used uninitialized", "`c` is read before"),
            ("no precision specified in this scope for type `float'", "precision mediump float"),
            // NVIDIA
            ("undefined variable \"x\"", "`x` is not declared"),
            ("unable to find compatible overloaded function \"dot(vec3, vec4)\"", "No function `dot`"),
            ("too little data in type constructor", "Too few values"),
            ("too much data in type constructor", "Too many values"),
            ("implicit cast from \"int\" to \"float\"", "with a decimal point"),
            ("cannot convert from \"vec4\" to \"vec3\"", "different types"),
            ("incompatible types in initialization", "different types"),
            ("assignment to varying n", "read-only"),
            ("global variable gl_FragColor is removed after version 420 core", "out vec4 FragColor"),
            ("declaration of \"c\" conflicts with previous declaration at 0(2)", "`c` is declared twice"),
            ("\"v\" not declared as an output from the previous stage", "the vertex shader has no `out`"),
            ("array index out of bounds", "index is out of range"),
            // AMD and Intel
            ("Undeclared identifier: x", "`x` is not declared"),
            ("Not supported when use core profile: gl_FragColor", "out vec4 FragColor"),
            ("Implicit conversion from int to float", "with a decimal point"),
            // glslang, ANGLE, Apple
            ("'x' : undeclared identifier", "`x` is not declared"),
            ("Use of undeclared identifier 'x'", "`x` is not declared"),
            (
                "'=' :  cannot convert from ' const 4-component vector of float' to ' temp 3-component vector of float'",
                "different types",
            ),
            ("'' :  syntax error, unexpected IDENTIFIER, expecting COMMA or SEMICOLON", "semicolon or a bracket"),
            ("'assign' :  l-value required \"n\" (can't modify shader input)", "`n` cannot be changed"),
            ("'xyzq' : vector swizzle selectors not from the same set", "follows the dot"),
            ("'constructor' : not enough data provided for construction", "Too few values"),
            (
                "'*' :  wrong operand types: no operation '*' exists that takes a left-hand operand",
                "two sides of the operator",
            ),
            ("'dot' : no matching overloaded function found", "No function `dot`"),
            ("'c' : redefinition", "`c` is declared twice"),
            ("'input' : Reserved word.", "`input` is reserved in GLSL"),
            ("'' : boolean expression expected", "A condition must be a bool"),
            ("version not supported", "does not support that `#version`"),
            ("'[' :  array index out of range '5'", "index is out of range"),
            ("'' :  syntax error, unexpected end of file, expecting RIGHT_BRACE", "ends too early"),
            ("'attribute' : not supported in this stage: fragment", "were removed in version 330 core"),
            ("'sampler2D' : sampler/image types can only be used in uniform variables", "A sampler can only be"),
            ("'float' : type requires declaration of default precision qualifier", "precision mediump float"),
            ("missing main()", "There is no `void main()`"),
        ] {
            let explanation = explain(message).unwrap_or_default();
            if !explanation.contains(says) || explanation.contains("{name}") {
                wrong.push(format!("{message} -> {explanation}"));
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
        assert_eq!(explain("the driver is tired"), None);
    }

    #[test]
    fn messages_are_placed_in_the_source() {
        let stage =
            StageText::whole("a.frag", "#version 330\nuniform vec3 lightPos;\nvoid main() {\n  x = lightPso;\n}\n");
        // gonio inserted two lines before the text.
        let messages =
            to_messages("0:6(7): error: `lightPso' undeclared\n0:90(1): error: late\nerror: nowhere\n", &stage, 3);
        let first = &messages[0];
        assert_eq!((first.file.as_str(), first.line, first.column), ("a.frag", Some(4), Some(7)));
        assert_eq!(first.quoted.as_deref(), Some("  x = lightPso;"));
        assert!(first.explanation.as_ref().unwrap().ends_with("Did you mean `lightPos`?"), "{first:?}");
        assert_eq!((messages[1].line, messages[1].quoted.as_deref()), (Some(88), None));
        assert_eq!((messages[2].line, messages[2].column), (None, None));
        // A line before the text, and a message without a column.
        let messages = to_messages("0(1) : error C0000: syntax error", &stage, 3);
        assert_eq!((messages[0].line, messages[0].column), (Some(1), None));
    }

    #[test]
    fn a_missing_semicolon_is_found_in_the_previous_line() {
        let stage = StageText::whole("a.frag", "void main()\n{\n  float a = 1.0 // one\n\n  b = a;\n}\n");
        let explanation =
            |line| to_messages(&format!("0:{line}(3): error: syntax error, unexpected NEW_IDENTIFIER"), &stage, 1);
        assert!(
            explanation(5)[0]
                .explanation
                .as_ref()
                .unwrap()
                .ends_with("Line 3 ends without a semicolon: `float a = 1.0`."),
            "{:?}",
            explanation(5)
        );
        for line in [1, 2, 3, 6] {
            let found = explanation(line).remove(0).explanation.unwrap();
            assert!(!found.contains("ends without"), "{line}: {found}");
        }
    }

    #[test]
    fn messages_name_lines_of_the_program() {
        let source = "int x;\nauto vs = \"#version 330\\n\"\n  \"in vec3 p;\\n\"\n  \"void main() { gl_Position = q; }\\n\";\n\
                  auto fs = R\"(out vec4 c; void main() { c = vec4(1); })\";\n";
        let submission = Submission::gather(vec![SourceFile::new("main.cpp", source)]).unwrap();
        let message = to_messages("0:3(29): error: `q' undeclared", &submission.vertex, 1).remove(0);
        assert_eq!((message.file.as_str(), message.line, message.column), ("main.cpp", Some(4), Some(32)));
        assert_eq!(message.quoted.as_deref(), Some("void main() { gl_Position = q; }"));
    }

    #[test]
    fn linker_messages_are_placed_at_the_declaration() {
        let vertex = StageText::whole("a.vert", "out vec3 n;\nout vec2 t;\nvoid main() {}\n");
        let fragment = StageText::whole("a.frag", "// in vec3 v\nin vec3 u;\nin vec3 v;\nvoid main() {}\n");
        for (log, file, line) in [
            ("error: fragment shader input `v' has no matching output in the previous stage", "a.frag", Some(3)),
            (
                "error: vertex shader output `t' declared as type `vec2', but fragment shader input declared as type `vec3'",
                "a.vert",
                Some(2),
            ),
            ("error: vertex shader lacks `main'", "a.vert", None),
            ("error: fragment shader lacks `main'", "a.frag", None),
        ] {
            let message = link_messages(log, &vertex, &fragment).remove(0);
            assert_eq!((message.file.as_str(), message.line), (file, line), "{log}");
            assert_eq!(message.quoted.is_some(), line.is_some());
            assert!(message.explanation.is_some());
        }
        let message =
            link_messages("error: fragment shader input `v' has no matching output", &vertex, &fragment).remove(0);
        assert_eq!((message.column, message.quoted.as_deref()), (Some(9), Some("in vec3 v;")));
    }

    #[test]
    fn hostile_logs_and_texts_are_read_quickly() {
        let stage = StageText::whole("a.frag", "aaaa bbbb;\n".repeat(100_000));
        let log = "ERROR: 0:4294967295: 'aaab' : undeclared identifier\nERROR: 0:99999999999: x\n0:0(0): error: y\n"
            .repeat(10_000);
        assert!(to_messages(&log, &stage, u32::MAX).len() <= 200);
        assert!(link_messages(&log, &stage, &stage).len() <= 200);
        for text in ["`", "`'", "''''", "é'é`é", ": ", ""] {
            let _ = explain(text);
            assert!(explain::quoted_names(text).is_empty());
        }
    }
}
