//! No file knows where somebody's machine keeps things.

use super::tree::TextFile;

/// Beginnings of paths that exist on the machines where this is made. (A model in a test's corpus may
/// well name somebody's home.) Put together here, or this file would be the
/// first to be found.
const MACHINE_PATHS: &[&str] = &[concat!("/", "work/"), concat!("/", "root/"), concat!("/", "tmp/bash")];

/// Complaints about paths of a machine in tracked files.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files {
        for (index, line) in file.text.lines().enumerate() {
            if let Some(path) = MACHINE_PATHS.iter().find(|path| has_absolute(line, path)) {
                complaints.push(format!("{}:{}: `{path}` is a path of one machine", file.path, index + 1));
            }
        }
    }
    complaints
}

/// Whether `path` begins in `line` as an absolute path: `target/work/` and `https://x/work/` are none.
fn has_absolute(line: &str, path: &str) -> bool {
    line.match_indices(path).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/' | '}'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absolute_paths_are_found_and_relative_ones_are_not() {
        let check_line = |line: String| check(&[TextFile { path: "a.md".into(), text: format!("\n{line}\n") }]);
        let found = check_line(format!("see {}thing", concat!("/", "work/")));
        assert_eq!(found, [format!("a.md:2: `{}` is a path of one machine", concat!("/", "work/"))]);
        assert_eq!(check_line(format!("\"{}x\"", concat!("/", "root/"))).len(), 1);
        assert!(
            check_line(format!("target{}x https://a.org{}y", concat!("/", "work/"), concat!("/", "root/"))).is_empty()
        );
    }
}
