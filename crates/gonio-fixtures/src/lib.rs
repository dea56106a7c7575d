//! Tables of test cases: many small files in one text, in the manner of Go's txtar.
//!
//! Only tests and `xtask` depend on this crate. A table replaces a folder of its name: `corpus/ex04/wrong.txt` contains the
//! files of a folder `corpus/ex04/wrong`.
//!
//! # Format
//!
//! ```text
//! Text before the first header is a comment.
//! -- triangle.obj --
//! v 0 0 0
//! v 1 0 0
//! v 0 1 0
//! f 1 2 3
//! -- triangle.obj.expected --
//! 3 vertices, 1 triangles
//! -- fail_cut_off.obj [no-newline] --
//! v 0 0
//! ```
//!
//! A header `-- PATH --` begins a file, and every line up to the next header belongs to it, empty ones included. A path is
//! relative and has `/` between its parts; it may contain spaces. Flags in the header describe what plain lines of text cannot:
//!
//! | flag | the file |
//! |---|---|
//! | `crlf` | ends each line with carriage return and line feed |
//! | `no-newline` | lacks the end of its last line |
//! | `escaped` | has bytes written as escapes: `\\`, `\t`, `\r`, `\n`, `\xNN` (a byte), `\u{N}` (a character, as UTF-8) |
//! | `utf-16le`, `utf-16be` | is encoded as UTF-16; a byte order mark is written as `\u{feff}` |
//! | `hex` | is binary: two hexadecimal digits for each byte; spaces and line ends are ignored |
//!
//! Several flags are separated by commas: `-- a.obj [escaped, no-newline] --`. A line of a file that begins with `-- ` is written
//! as `\x2d- ` in a file that is `escaped`, so that a misspelt header is always an error.
//!
//! The table itself is UTF-8 with line feeds, and ends with one.
//!
//! # Selecting a case
//!
//! Tests that run each case of a table pass the cases through [`selected`]: the environment variable `GONIO_CASE` restricts
//! them to those whose names contain its value.
//!
//! ```sh
//! GONIO_CASE=ex04/wrong/normal-mv cargo test -p gonio-check --test corpus mistakes_are_named
//! ```

mod parse;

pub use parse::{FixtureError, FixtureProblem};

use std::io;
use std::path::{Path, PathBuf};

/// The environment variable that selects cases by a part of their names.
pub const SELECTION_VARIABLE: &str = "GONIO_CASE";

/// A file of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixtureFile {
    /// The path below the table, or below its case: `phong.frag`.
    pub path: String,
    /// The content, exactly.
    pub bytes: Vec<u8>,
    /// The line of its header in the table, from 1.
    pub line: usize,
}

/// Several files that form one case: those below one folder of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixtureCase {
    /// The folder.
    pub name: String,
    /// Its files, in the table's order, with paths below the folder.
    pub files: Vec<FixtureFile>,
}

impl FixtureCase {
    /// The file at `path` below the case, as text.
    pub fn text(&self, path: &str) -> Result<&str, FixtureError> {
        let error = |line, problem| FixtureError { table: self.name.clone(), line, problem };
        let file = self.files.iter().find(|file| file.path == path);
        let file = file.ok_or_else(|| error(None, FixtureProblem::Missing(path.to_owned())))?;
        str::from_utf8(&file.bytes).map_err(|_| error(Some(file.line), FixtureProblem::NotUtf8))
    }
}

/// A file and the text that a test must make of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpectedCase {
    /// The path of the file: `triangle.obj`.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// The content of `NAME.expected`, without empty lines: those only separate blocks for a person who reads it.
    pub expected: String,
}

/// The files of one table, in its order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixtureTable {
    /// The table's path, for messages.
    pub name: String,
    files: Vec<FixtureFile>,
}

impl FixtureTable {
    /// Reads the table at `path`, which must contain at least one file.
    pub fn read(path: impl AsRef<Path>) -> Result<FixtureTable, FixtureError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        match std::fs::read(path) {
            Ok(bytes) => FixtureTable::parse(&name, &bytes),
            Err(error) => {
                Err(FixtureError { table: name, line: None, problem: FixtureProblem::Unreadable(error.to_string()) })
            }
        }
    }

    /// Reads a table from its bytes; `name` identifies it in errors.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<FixtureTable, FixtureError> {
        let files = parse::files(bytes).map_err(|(line, problem)| FixtureError {
            table: name.to_owned(),
            line: (line > 0).then_some(line),
            problem,
        })?;
        Ok(FixtureTable { name: name.to_owned(), files })
    }

    /// All files.
    pub fn files(&self) -> &[FixtureFile] {
        &self.files
    }

    /// The content of the file at `path`.
    pub fn get(&self, path: &str) -> Option<&[u8]> {
        self.files.iter().find(|file| file.path == path).map(|file| file.bytes.as_slice())
    }

    /// The files as cases, one for each folder at the top of the table. Every file must lie in a folder.
    pub fn cases(&self) -> Result<Vec<FixtureCase>, FixtureError> {
        let mut cases: Vec<FixtureCase> = Vec::new();
        for file in &self.files {
            let (name, path) =
                file.path.split_once('/').ok_or_else(|| self.error(file.line, FixtureProblem::OutsideOfCases))?;
            let within = FixtureFile { path: path.to_owned(), ..file.clone() };
            match cases.iter_mut().find(|case| case.name == name) {
                Some(case) => case.files.push(within),
                None => cases.push(FixtureCase { name: name.to_owned(), files: vec![within] }),
            }
        }
        Ok(cases)
    }

    /// The files that end in `.extension`, each with its `NAME.expected`, sorted by name. It is an error if one of the two is
    /// missing. Files of other kinds are left out: they are there to be referred to.
    pub fn expected_cases(&self, extension: &str) -> Result<Vec<ExpectedCase>, FixtureError> {
        let mut cases = Vec::new();
        for file in &self.files {
            if let Some(of) = file.path.strip_suffix(".expected") {
                self.get(of).ok_or_else(|| self.error(file.line, FixtureProblem::NothingExpectedOf(of.to_owned())))?;
            } else if file.path.rsplit_once('.').is_some_and(|(_, ending)| ending == extension) {
                let path = format!("{}.expected", file.path);
                let expected = self.get(&path).ok_or_else(|| self.error(file.line, FixtureProblem::Missing(path)))?;
                let expected = str::from_utf8(expected).map_err(|_| self.error(file.line, FixtureProblem::NotUtf8))?;
                let expected =
                    expected.lines().filter(|line| !line.is_empty()).map(|line| format!("{line}\n")).collect();
                cases.push(ExpectedCase { name: file.path.clone(), bytes: file.bytes.clone(), expected });
            }
        }
        cases.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(cases)
    }

    /// Writes each file below `folder`, which is created.
    pub fn unpack(&self, folder: &Path) -> io::Result<()> {
        for file in &self.files {
            let path = folder.join(&file.path);
            if let Some(parent) = path.parent() {
                std::fs::create_dir_all(parent)?;
            }
            std::fs::write(path, &file.bytes)?;
        }
        Ok(())
    }

    fn error(&self, line: usize, problem: FixtureProblem) -> FixtureError {
        FixtureError { table: self.name.clone(), line: Some(line), problem }
    }
}

/// The tables (`.txt`) below `folder`, at any depth, sorted: each with the path of the folder that it replaces, relative to
/// `folder`.
pub fn tables_below(folder: &Path) -> Result<Vec<(PathBuf, FixtureTable)>, FixtureError> {
    let unreadable = |path: &Path, error: &io::Error| FixtureError {
        table: path.display().to_string(),
        line: None,
        problem: FixtureProblem::Unreadable(error.to_string()),
    };
    let mut tables = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(&next).map_err(|error| unreadable(&next, &error))? {
            let path = entry.map_err(|error| unreadable(&next, &error))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "txt") {
                let relative = path.strip_prefix(folder).unwrap_or(&path).with_extension("");
                tables.push((relative, FixtureTable::read(&path)?));
            }
        }
    }
    tables.sort_by(|(a, _), (b, _)| a.cmp(b));
    Ok(tables)
}

/// The cases that `GONIO_CASE` selects: those whose names contain its value; all of them if it is not set.
///
/// # Panics
///
/// If it selects none, so that a misspelt name is not taken for a passed test; and if there are no cases at all.
pub fn selected<T>(cases: Vec<T>, name: impl Fn(&T) -> &str) -> Vec<T> {
    let selection = std::env::var(SELECTION_VARIABLE).unwrap_or_default();
    select(cases, name, &selection)
}

/// Compares what `actual` makes of each selected case with its expectation.
///
/// # Panics
///
/// If some differ, with the names and both texts of all of them.
pub fn assert_as_expected(cases: Vec<ExpectedCase>, actual: impl Fn(&ExpectedCase) -> String) {
    let mut differing = Vec::new();
    for case in selected(cases, |case| &case.name) {
        let actual = actual(&case);
        if actual != case.expected {
            differing.push(format!("--- {}, expected:\n{}--- actual:\n{actual}", case.name, case.expected));
        }
    }
    assert!(differing.is_empty(), "{} cases differ:\n{}", differing.len(), differing.join("\n"));
}

fn select<T>(cases: Vec<T>, name: impl Fn(&T) -> &str, selection: &str) -> Vec<T> {
    let count = cases.len();
    let selected: Vec<T> = cases.into_iter().filter(|case| name(case).contains(selection)).collect();
    assert!(
        !selected.is_empty(),
        "none of {count} cases has a name that contains `{selection}` ({SELECTION_VARIABLE})"
    );
    selected
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const TABLE: &[u8] = b"Shared by the tests below.
-- b/one.frag --
void main() { }
-- a/one.vert --
-- b/sub/two.frag --

";

    fn table() -> FixtureTable {
        FixtureTable::parse("table.txt", TABLE).unwrap()
    }

    #[test]
    fn files_of_one_folder_form_a_case() {
        let cases = table().cases().unwrap();
        let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        assert_eq!(names, ["b", "a"]);
        let paths: Vec<&str> = cases[0].files.iter().map(|file| file.path.as_str()).collect();
        assert_eq!(paths, ["one.frag", "sub/two.frag"]);
        let outside = FixtureTable::parse("table.txt", b"-- a/b --\n-- c --\n").unwrap().cases();
        assert_eq!(outside.unwrap_err().to_string(), "table.txt:2: a file outside the folders of the cases");
    }

    #[test]
    fn expectations_belong_to_files() {
        let read = |text: &str| FixtureTable::parse("table.txt", text.as_bytes()).unwrap().expected_cases("obj");
        let cases =
            read("-- b.obj --\nb\n-- b.obj.expected --\n1\n\n2\n-- x.mtl --\n-- a.obj --\n-- a.obj.expected --\n");
        let names: Vec<(String, String)> = cases.unwrap().into_iter().map(|case| (case.name, case.expected)).collect();
        assert_eq!(names, [("a.obj".to_owned(), String::new()), ("b.obj".to_owned(), "1\n2\n".to_owned())]);
        assert_eq!(read("\n-- a.obj --\n").unwrap_err().to_string(), "table.txt:2: `a.obj.expected` is missing");
        let orphan = read("-- a.obj.expected --\n").unwrap_err().to_string();
        assert_eq!(orphan, "table.txt:1: the expectation of a missing file, `a.obj`");
    }

    #[test]
    fn unpacked_files_have_the_bytes_of_the_table() {
        let folder = std::env::temp_dir().join(format!("gonio-fixtures-{}", std::process::id()));
        table().unpack(&folder).unwrap();
        let read = |path: &str| std::fs::read(folder.join(path)).unwrap();
        assert_eq!(read("b/one.frag"), b"void main() { }\n");
        assert_eq!(read("a/one.vert"), b"");
        assert_eq!(read("b/sub/two.frag"), b"\n");
        std::fs::write(folder.join("b/table.txt"), TABLE).unwrap();
        let tables = tables_below(&folder).unwrap();
        assert_eq!(tables.len(), 1);
        assert_eq!((tables[0].0.as_path(), tables[0].1.files()), (Path::new("b/table"), table().files()));
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    #[should_panic(expected = "1 cases differ:\n--- b.obj, expected:\n2\n--- actual:\n1\n")]
    fn a_differing_case_is_named() {
        let case = |name: &str, expected: &str| ExpectedCase {
            name: name.to_owned(),
            bytes: b"1\n".to_vec(),
            expected: expected.to_owned(),
        };
        let content = |case: &ExpectedCase| String::from_utf8(case.bytes.clone()).unwrap();
        assert_as_expected(vec![case("a.obj", "1\n"), case("b.obj", "2\n")], content);
    }

    #[test]
    fn a_part_of_a_name_selects_cases() {
        let names = || vec!["ex04/wrong/normal-mv", "ex04/wrong/normal-m", "ex05/wrong/normal-m"];
        assert_eq!(select(names(), |name| name, ""), names());
        assert_eq!(select(names(), |name| name, "ex04/wrong/normal-m"), names()[..2]);
        assert_eq!(select(names(), |name| name, "ex05"), names()[2..]);
    }

    #[test]
    #[should_panic(expected = "none of 1 cases has a name that contains `ex99`")]
    fn a_name_of_no_case_is_an_error() {
        select(vec!["ex04/wrong/normal-mv"], |name| name, "ex99");
    }
}
