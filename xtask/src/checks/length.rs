//! The length of source files: above 500 lines they are listed, above 900 the check fails.

use super::tree::TextFile;

/// Longer files are listed.
const LONG: usize = 500;
/// Longer files fail the check.
const TOO_LONG: usize = 900;

/// File name endings of source code.
const CODE: &[&str] = &[".rs", ".glsl", ".vert", ".frag", ".py", ".js", ".ts", ".sh"];

/// The longest source file, and its number of lines.
pub fn longest(files: &[TextFile]) -> Option<(&str, usize)> {
    let code = files.iter().filter(|f| CODE.iter().any(|end| f.path.ends_with(end)));
    code.map(|f| (f.path.as_str(), f.text.lines().count())).max_by_key(|(_, lines)| *lines)
}

/// Returns the files that are listed and the files that are too long, each with the longest first.
pub fn check(files: &[TextFile]) -> (Vec<String>, Vec<String>) {
    let mut long: Vec<(usize, &str)> = files
        .iter()
        .filter(|f| CODE.iter().any(|end| f.path.ends_with(end)))
        .map(|f| (f.text.lines().count(), f.path.as_str()))
        .filter(|(lines, _)| *lines > LONG)
        .collect();
    long.sort_by(|a, b| b.cmp(a));
    let describe = |(lines, path): &(usize, &str)| {
        if *lines > TOO_LONG {
            format!("{path}: {lines} lines; split it (at most {TOO_LONG})")
        } else {
            format!("{path}: {lines} lines (more than {LONG})")
        }
    };
    let (too_long, only_long): (Vec<_>, Vec<_>) = long.iter().partition(|(lines, _)| *lines > TOO_LONG);
    (only_long.iter().map(describe).collect(), too_long.iter().map(describe).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_limits_hold() {
        let file = |path: &str, lines: usize| TextFile { path: path.into(), text: "x\n".repeat(lines) };
        let files =
            [file("a.rs", 500), file("b.rs", 501), file("c.vert", 900), file("d.rs", 901), file("model.obj", 10_000)];
        let (warnings, complaints) = check(&files);
        assert_eq!(warnings, ["c.vert: 900 lines (more than 500)", "b.rs: 501 lines (more than 500)"]);
        assert_eq!(longest(&files), Some(("d.rs", 901)));
        assert_eq!(complaints, ["d.rs: 901 lines; split it (at most 900)"]);
    }
}
