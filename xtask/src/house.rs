//! Figures about the code base, each with its limit: `cargo xtask house` prints them.

use crate::checks::source::{Source, TextFile};
use crate::checks::{cycles, text, words};
use crate::process;
use crate::report::Findings;
use std::path::Path;
use std::process::Command;

/// Limit on the number of `unsafe` blocks in the workspace, tests included.
pub const MOST_UNSAFE_BLOCKS: usize = 60;
/// Limit on the number of files that contain them.
pub const MOST_UNSAFE_FILES: usize = 7;
/// Limit on the number of import cycles of more than [`cycles::MOST_FILES`] files.
pub const MOST_CYCLES: usize = 0;
/// Limit on the number of files that git tracks. Path tracing and its pictures are two crates of 50 files;
/// generated submissions, causes by values, stepping through shaders and users' own shaders are about as many; models of
/// reflection, one file each, and their plots are 55, the bench for them in the window 20, materials of scenes 10, and
/// exercise 12 and its submissions 12, exercise 13 is 20; texture atlases and baking are two crates of about 20, and baking in the
/// window 15; phenomena beyond the rendering equation are 40, a folder each; the book is 55, pages, pictures and their tests; the
/// pages about a class are 11, and hints, messages, search, thumbnails and fonts of the window about as many; the
/// exercises and texts in French are 40; files, environment, gallery and accessibility in the window are 45; the language server,
/// formats of verdicts, their tests and the editors' extensions are 30; releases, packages, workflows and Windows under Wine are 30;
/// the Python package, its tests and benchmarks are 36.
pub const MOST_TRACKED_FILES: usize = 1916;

/// Blocks of `unsafe` code and the number of files that contain them.
pub fn unsafe_blocks(files: &[TextFile]) -> (usize, usize) {
    let blocks = |file: &TextFile| {
        let source = Source::parse(&file.text);
        let starts = |code: &String| code.match_indices("unsafe {").count() + code.match_indices("unsafe impl").count();
        source.code.iter().map(starts).sum::<usize>()
    };
    let counts: Vec<usize> = files.iter().filter(|f| f.is_rust()).map(blocks).filter(|count| *count > 0).collect();
    (counts.iter().sum(), counts.len())
}

/// Number of `unsafe` blocks, against the limits.
pub fn check_unsafe(files: &[TextFile]) -> Findings {
    let (blocks, places) = unsafe_blocks(files);
    let remark = format!("{blocks} in {places} files");
    if blocks > MOST_UNSAFE_BLOCKS || places > MOST_UNSAFE_FILES {
        Findings::fail(format!(
            "{remark}: at most {MOST_UNSAFE_BLOCKS} in {MOST_UNSAFE_FILES} files; wrap OpenGL calls in `gonio-gl`"
        ))
    } else {
        Findings::pass().remarking(remark)
    }
}

/// Number of files that git tracks, against the limit.
pub fn check_tracked(root: &Path) -> Findings {
    let listed = process::stdout_of(Command::new("git").current_dir(root).args(["ls-files", "-z"]));
    match listed.map(|list| list.split('\0').filter(|path| !path.is_empty()).count()) {
        Ok(count) if count > MOST_TRACKED_FILES => Findings::fail(format!(
            "{count} files are tracked, at most {MOST_TRACKED_FILES}: put small fixtures into one text per table of cases"
        )),
        Ok(count) => Findings::pass().remarking(format!("{count}")),
        Err(error) => Findings::fail(error),
    }
}

/// Import cycles of too many files, against the limit.
pub fn check_cycles(files: &[TextFile]) -> Findings {
    let complaints = cycles::check(files);
    if complaints.len() > MOST_CYCLES {
        return Findings::of_complaints(&complaints);
    }
    let largest = cycles::cycles(files).first().map_or(cycles::MOST_FILES, Vec::len);
    Findings::pass().remarking(format!(
        "{} of more than {} files, largest {largest}",
        complaints.len(),
        cycles::MOST_FILES
    ))
}

/// Terms of the glossary that name several types, and names that crates share, against the limit.
pub fn check_words(files: &[TextFile]) -> Findings {
    let (public, all) = words::declarations(files);
    let mut complaints = words::ambiguous_terms(&all, words::TERMS);
    let shared = words::shared_names(&public);
    let remark = format!("{} terms, {} names shared by crates", words::TERMS.len(), shared.len());
    if shared.len() > words::MOST_SHARED {
        complaints.push(format!(
            "{} names of public types are declared by several crates, at most {}: {}",
            shared.len(),
            words::MOST_SHARED,
            shared.join(", ")
        ));
    }
    if complaints.is_empty() { Findings::pass().remarking(remark) } else { Findings::of_complaints(&complaints) }
}

/// The longest source file; long ones are listed, and files that are too long fail.
pub fn check_length(files: &[TextFile]) -> Findings {
    let (long, too_long) = text::check_length(files);
    let mut findings = Findings::of_complaints(&too_long);
    if let Some((path, lines)) = text::longest(files) {
        findings.remark = format!("longest: {path}, {lines} lines");
    }
    findings.details = [findings.details, long.join("\n")].join("\n").trim().to_owned();
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsafe_blocks_are_counted_in_code_only() {
        let file = |path: &str, text: &str| TextFile { path: path.into(), text: text.into() };
        let files = [
            file("a.rs", "// unsafe { }\nlet s = \"unsafe { }\";\nunsafe { f() }; unsafe { g() }\n"),
            file("b.rs", "unsafe impl Send for X {}\n#![forbid(unsafe_code)]\nunsafe fn f() {}\n"),
            file("c.rs", "fn main() {}\n"),
        ];
        assert_eq!(unsafe_blocks(&files), (3, 2));
    }
}
