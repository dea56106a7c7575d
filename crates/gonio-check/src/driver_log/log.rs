//! Reads the logs of compilers and linkers, in the formats of all drivers, as messages with positions.

/// The severity of a message of a driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LogSeverity {
    /// The shader does not compile.
    Error,
    /// The shader compiles.
    Warning,
    /// A remark.
    Note,
}

/// One message of a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogLine {
    /// The line of the compiled text, if the driver names one.
    pub line: Option<u32>,
    /// The column, if the driver names one.
    pub column: Option<u32>,
    /// The severity of a message of a driver.
    pub severity: LogSeverity,
    /// The message without location and severity.
    pub text: String,
}

/// A person reads fewer messages; the log of a hostile shader may have a million.
const MOST: usize = 200;

/// Reads a log. Lines without information (`2 errors generated.`) are skipped; continuation lines are joined to the
/// line before.
#[must_use]
pub fn read_log(log: &str) -> Vec<LogLine> {
    let mut lines: Vec<LogLine> = Vec::new();
    for raw in log.lines() {
        if lines.len() >= MOST {
            break;
        }
        // The driver ends the log with a zero byte.
        let line = raw.trim_end_matches(['\0', '\r', ' ', '\t']);
        if line.trim().is_empty() || is_frame(line.trim()) {
            continue;
        }
        let read = read_line(line.trim_start());
        // glslang appends this to each error.
        if read.as_ref().is_some_and(|(read, _)| read.text.ends_with(": compilation terminated")) {
            continue;
        }
        let Some((read, goes_on)) = read else {
            match lines.last_mut() {
                Some(before) if belongs(before, line) => join(before, line.trim()),
                _ => lines.push(unplaced(line.trim())),
            }
            continue;
        };
        let is_new = !lines.contains(&read);
        match lines.last_mut() {
            // Mesa writes each candidate on a line with its own position.
            Some(before) if goes_on && before.line == read.line => join(before, &read.text),
            _ if is_new => lines.push(read),
            _ => {}
        }
    }
    lines
}

fn join(before: &mut LogLine, text: &str) {
    if before.text.len() < 2000 {
        before.text.push_str(if before.text.ends_with(':') { " " } else { "; " });
        before.text.push_str(text);
    }
}

/// Whether a line is a heading, a ruler, a count or a caret.
fn is_frame(line: &str) -> bool {
    let lower = line.to_ascii_lowercase();
    let rules = line.chars().all(|c| matches!(c, '-' | '=' | '^' | '~' | ' ' | '*'));
    let counts = (lower.contains("compilation error") && lower.contains("no code generated"))
        || lower.ends_with("errors generated.")
        || lower.ends_with("error generated.")
        || lower.starts_with("compilation terminated")
        || lower.ends_with("compilation errors.");
    let headings = matches!(
        lower.trim_end_matches(['.', ':']),
        "vertex info"
            | "fragment info"
            | "link info"
            | "vertex shader"
            | "fragment shader"
            | "compile log"
            | "link log"
    ) || lower.starts_with("vertex shader failed to compile")
        || lower.starts_with("fragment shader failed to compile")
        || lower.starts_with("shader compilation failed");
    rules || counts || headings
}

/// Whether a line without a position continues the message before it.
fn belongs(before: &LogLine, line: &str) -> bool {
    line.starts_with([' ', '\t']) || before.text.ends_with(':') || before.text.ends_with(',')
}

/// Creates a message without a position, mostly a linker's.
fn unplaced(line: &str) -> LogLine {
    let (severity, text) = severity(line).unwrap_or((LogSeverity::Error, line));
    LogLine { line: None, column: None, severity, text: text.to_owned() }
}

/// Reads a line with a position. Also returns whether it only continues the message before it.
fn read_line(line: &str) -> Option<(LogLine, bool)> {
    let placed = |number: u32, column: Option<u32>, severity: LogSeverity, text: &str| LogLine {
        // Drivers write 0 if they know no line.
        line: Some(number).filter(|&number| number > 0),
        column: column.filter(|&column| column > 0),
        severity,
        text: text.trim().to_owned(),
    };
    // The severity first: AMD, Intel on Windows, Apple, ANGLE, PowerVR, glslang.
    if let Some((level, rest)) = severity(line) {
        let Some((number, column, rest)) = place(rest) else {
            return Some((unplaced(line), false));
        };
        // AMD: `error(#143) Undeclared identifier: x`.
        let (level, rest) = self::severity(rest).unwrap_or((level, rest));
        return Some((placed(number, column, level, rest), false));
    }
    // The position first: Mesa, NVIDIA, Mali.
    let (number, column, rest) = place(line)?;
    let (level, text) = severity(rest).unwrap_or((LogSeverity::Error, rest));
    let goes_on = text.starts_with("   ");
    Some((placed(number, column, level, text), goes_on))
}

/// Splits `error:`, `WARNING:`, `: error C1008:`, `preprocessor error:` or `error(#143)` from a text. Spaces after it
/// are kept, because they mark Mesa's candidates.
fn severity(text: &str) -> Option<(LogSeverity, &str)> {
    let trimmed = text.trim_start_matches([' ', ':']);
    let lower: String = trimmed.chars().take(20).flat_map(char::to_lowercase).collect();
    for (word, severity) in [
        ("preprocessor error", LogSeverity::Error),
        ("preprocessor warning", LogSeverity::Warning),
        ("internal error", LogSeverity::Error),
        ("fatal error", LogSeverity::Error),
        ("link error", LogSeverity::Error),
        ("error", LogSeverity::Error),
        ("warning", LogSeverity::Warning),
        ("note", LogSeverity::Note),
        ("info", LogSeverity::Note),
    ] {
        if !lower.starts_with(word) {
            continue;
        }
        let rest = trimmed.get(word.len()..)?;
        // The driver's number of the message: ` C1008`, `(#143)`.
        let rest = match rest.strip_prefix("(#").and_then(|rest| rest.split_once(')')) {
            Some((_, rest)) => return Some((severity, rest)),
            None => rest,
        };
        let code = rest.strip_prefix(" C").unwrap_or(rest);
        let rest = if code.len() < rest.len() { code.trim_start_matches(|c: char| c.is_ascii_digit()) } else { rest };
        return rest.strip_prefix(':').map(|rest| (severity, rest.strip_prefix(' ').unwrap_or(rest)));
    }
    None
}

/// Splits `0:12(5):`, `0(12) :`, `0:12:`, `0:12:5:` or `name.frag:12:` into line, column and the rest.
fn place(text: &str) -> Option<(u32, Option<u32>, &str)> {
    let text = text.trim_start();
    // The number of the string or the name of the file.
    let name = text.find([':', '('])?;
    let source = text.get(..name)?;
    // NVIDIA's linker omits it: `(0) : error`.
    let is_source = is_number(source) || source.contains('.') || source.is_empty() && text.starts_with('(');
    if source.contains(char::is_whitespace) || !is_source {
        return None;
    }
    let rest = text.get(name..)?;
    // NVIDIA: `0(12) : `, Microsoft: `0(12,5): `.
    if let Some(inner) = rest.strip_prefix('(') {
        let (inner, behind) = inner.split_once(')')?;
        let (line, column) = inner.split_once([',', ':']).map_or((inner, None), |(line, column)| (line, Some(column)));
        return Some((number(line)?, column.and_then(number), behind.trim_start().strip_prefix(':')?.trim_start()));
    }
    let (line, rest) = digits(rest.strip_prefix(':')?)?;
    // Mesa: `0:12(5): `.
    if let Some(inner) = rest.strip_prefix('(') {
        let (column, behind) = inner.split_once(')')?;
        let column = column.split('-').next().and_then(number);
        let behind = behind.strip_prefix(':')?;
        return Some((line, column, behind.strip_prefix(' ').unwrap_or(behind)));
    }
    let rest = rest.trim_start().strip_prefix(':')?;
    if let Some((column, behind)) = digits(rest)
        && let Some(behind) = behind.strip_prefix(':')
    {
        return Some((line, Some(column), behind.trim_start()));
    }
    // Mali: `0:12: S0022: ...`.
    let rest = rest.trim_start();
    let code = rest.split_once(": ").filter(|(code, _)| {
        code.len() == 5 && code.starts_with(['S', 'L', 'P']) && code.get(1..).is_some_and(is_number)
    });
    Some((line, None, code.map_or(rest, |(_, rest)| rest)))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

fn number(text: &str) -> Option<u32> {
    text.trim().parse().ok()
}

fn digits(text: &str) -> Option<(u32, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    Some((text.get(..end)?.parse().ok()?, text.get(end..)?))
}

#[cfg(test)]
mod tests {
    use super::LogSeverity::{Error, Note, Warning};
    use super::*;

    #[test]
    fn logs_of_every_driver_are_read() {
        for (driver, log, line, column, severity, text) in [
            ("Mesa", "0:12(5): error: `x' undeclared", Some(12), Some(5), Error, "`x' undeclared"),
            ("Mesa", "0:1(10): preprocessor error: bad", Some(1), Some(10), Error, "bad"),
            ("Mesa", "0:3(2): warning: `c' used uninitialized", Some(3), Some(2), Warning, "`c' used uninitialized"),
            ("Mesa", "0:7(12-15): error: range", Some(7), Some(12), Error, "range"),
            ("Mesa", "error: linking with uncompiled shader", None, None, Error, "linking with uncompiled shader"),
            (
                "NVIDIA",
                "0(12) : error C1008: undefined variable \"x\"",
                Some(12),
                None,
                Error,
                "undefined variable \"x\"",
            ),
            ("NVIDIA", "0(3) : warning C7050: \"c\" might", Some(3), None, Warning, "\"c\" might"),
            ("NVIDIA", "(0) : error C5145: must write to gl_Position", None, None, Error, "must write to gl_Position"),
            (
                "AMD",
                "ERROR: 0:12: error(#143) Undeclared identifier: x",
                Some(12),
                None,
                Error,
                "Undeclared identifier: x",
            ),
            ("AMD", "WARNING: 0:2: warning(#402) Implicit truncation", Some(2), None, Warning, "Implicit truncation"),
            ("Intel", "ERROR: 0:12: 'x' : undeclared identifier", Some(12), None, Error, "'x' : undeclared identifier"),
            (
                "Apple",
                "ERROR: 0:12: Use of undeclared identifier 'x'",
                Some(12),
                None,
                Error,
                "Use of undeclared identifier 'x'",
            ),
            ("ANGLE", "WARNING: 0:3: 'y' : unused", Some(3), None, Warning, "'y' : unused"),
            ("ANGLE", "ERROR: 0:12:5: 'x' : bad", Some(12), Some(5), Error, "'x' : bad"),
            (
                "Adreno",
                "ERROR: 0:4: 'foo' : no matching overloaded function found",
                Some(4),
                None,
                Error,
                "'foo' : no matching overloaded function found",
            ),
            (
                "Mali",
                "0:12: S0022: No matching function for call 'f'",
                Some(12),
                None,
                Error,
                "No matching function for call 'f'",
            ),
            ("Mali", "0:12: L0001: Expected token ';'", Some(12), None, Error, "Expected token ';'"),
            ("glslang", "ERROR: phong.frag:9: '' :  syntax error", Some(9), None, Error, "'' :  syntax error"),
            ("glslang", "NOTE: 0:9: remark", Some(9), None, Note, "remark"),
            ("Microsoft", "0(12,5): error X3004: no", Some(12), Some(5), Error, "error X3004: no"),
            ("unknown", "something is wrong", None, None, Error, "something is wrong"),
        ] {
            let expected = LogLine { line, column, severity, text: text.to_owned() };
            assert_eq!(read_log(log), [expected], "{driver}: {log}");
        }
    }

    #[test]
    fn lines_without_information_are_skipped() {
        let log = "ERROR: 0:3: '' : compilation terminated \nFragment info\n-------------\n0(12) : error C0000: syntax error\n\nERROR: 1 compilation errors.  No code \
                   generated.\n2 errors generated.\n\0";
        let lines = read_log(log);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert_eq!((lines[0].line, lines[0].text.as_str()), (Some(12), "syntax error"));
        assert_eq!(read_log(""), []);
        assert_eq!(read_log("ERROR: 0:1: a\nERROR: 0:1: a\n").len(), 1);
    }

    #[test]
    fn candidates_are_joined_to_their_error() {
        let log = "0:5(9): error: no matching function for call to `dot(vec3, vec4)'; candidates are:\n\
                   0:5(9): error:    float dot(vec3, vec3)\n0:5(9): error:    float dot(vec4, vec4)\n0:6(1): error: next\n";
        let lines = read_log(log);
        assert_eq!(lines.len(), 2, "{lines:?}");
        assert!(
            lines[0].text.ends_with("candidates are: float dot(vec3, vec3); float dot(vec4, vec4)"),
            "{}",
            lines[0].text
        );
    }

    #[test]
    fn hostile_logs_are_read_quickly() {
        for piece in ["ERROR: 0:1: x\n", "0(", ":", "(", "0:1(", "ERROR", " a:\n", "é(\n"] {
            let lines = read_log(&piece.repeat(100_000));
            assert!(lines.len() <= MOST && lines.iter().all(|line| line.text.len() < 3_000_000), "{piece}");
        }
    }
}
