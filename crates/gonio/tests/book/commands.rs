//! Runs the commands of the book, page by page, each page in a new folder.
//!
//! | block | meaning |
//! |---|---|
//! | `sh` | run line by line, in the order of the page; each command succeeds |
//! | `sh,exit=1` | the same with another exit code |
//! | `sh,parse` | commands that need a display, a file of the reader or a long time: their options must exist |
//! | `sh,shell` | no commands of gonio |
//! | `text,output` | an extract of what the block of commands before it prints: these lines in this order; `...` leaves some out |
//! | `LANGUAGE,file=PATH` | a file that the reader writes |
//! | `python` | run by the tests of the Python package, `python/tests/test_documentation.py` |
//!
//! In blocks without a language (the exercises' texts have such) lines that begin with `gonio` are parsed.

use crate::common::Lab;
use crate::pages::{CodeBlock, Page, pages};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The reader's folder, what the last block of commands printed, and what went wrong.
struct Walk<'a> {
    lab: &'a Lab,
    folder: PathBuf,
    printed: String,
    commands: usize,
    failures: Vec<String>,
}

#[test]
fn the_commands_of_every_page_work() {
    let walks: Vec<(usize, Vec<String>)> = pages().par_iter().map(walk).collect();
    let failures: Vec<String> = walks.iter().flat_map(|(_, failures)| failures.clone()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    let commands: usize = walks.iter().map(|(commands, _)| commands).sum();
    assert!(commands > 100, "only {commands} commands were run");
}

/// Follows a page in a folder of its own; returns how many commands were run, and what went wrong.
fn walk(page: &Page) -> (usize, Vec<String>) {
    let lab = Lab::new();
    let mut walk = Walk { lab: &lab, folder: lab.path(""), printed: String::new(), commands: 0, failures: Vec::new() };
    for block in page.blocks() {
        walk.follow(&block);
    }
    (walk.commands, walk.failures.iter().map(|failure| format!("docs/{}: {failure}", page.name)).collect())
}

impl Walk<'_> {
    fn follow(&mut self, block: &CodeBlock) {
        let (language, attribute) = block.info.split_once(',').unwrap_or((&block.info, ""));
        let of_gonio = |line: &&String| line.starts_with("gonio ");
        match (language, attribute.split_once('=').unwrap_or((attribute, ""))) {
            (_, ("file", path)) => {
                let path = self.folder.join(path);
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                std::fs::write(path, block.lines.join("\n") + "\n").unwrap();
            }
            ("sh", ("", "")) => self.run(block, 0),
            ("sh", ("exit", code)) => self.run(block, code.parse().unwrap()),
            ("sh", ("parse", "")) => block.lines.iter().for_each(|line| self.parse(line)),
            ("sh", ("shell", "")) => {
                let run = block.lines.iter().filter(of_gonio);
                self.failures.extend(run.map(|line| format!("`{line}` is in a block that is not run")));
            }
            ("text", ("output", "")) => self.compare(&block.lines),
            ("", _) => block.lines.iter().filter(of_gonio).for_each(|line| self.parse(line)),
            ("text" | "glsl" | "toml" | "yaml" | "python", ("", "")) => {}
            _ => self.failures.push(format!("unknown kind of block: {}", block.info)),
        }
    }

    fn run(&mut self, block: &CodeBlock, expected: i32) {
        self.printed.clear();
        for line in &block.lines {
            let mut words = words(line);
            let target = words.iter().position(|word| word == ">").map(|at| words.split_off(at).pop().unwrap());
            match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
                [] => {}
                ["zip", "-r", zip, folder] => self.zip(zip, folder),
                ["gonio", arguments @ ..] => {
                    let output = self.command(arguments).output().unwrap();
                    let [stdout, stderr] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
                    if output.status.code() != Some(expected) {
                        self.failures.push(format!("`{line}`: {}\n{stdout}{stderr}", output.status));
                    }
                    match target {
                        Some(file) => std::fs::write(self.folder.join(file), stdout).unwrap(),
                        None => self.printed += &stdout,
                    }
                    self.printed += &stderr;
                    self.commands += 1;
                }
                _ => self.failures.push(format!("this test cannot run `{line}`")),
            }
        }
    }

    /// Asks the command of a line for its help, after all its options: each must exist and accept its value.
    fn parse(&mut self, line: &str) {
        let words = words(line);
        for part in words.split(|word| word == "|") {
            let Some(start) = part.iter().position(|word| word == "gonio") else { continue };
            let end = part.iter().position(|word| word == ">" || word == ">>").unwrap_or(part.len());
            let mut arguments: Vec<&str> = part[start + 1..end].iter().map(String::as_str).collect();
            arguments.push("--help");
            let output = self.command(&arguments).output().unwrap();
            if output.status.code() != Some(0) {
                self.failures.push(format!("`{line}`: {}", String::from_utf8_lossy(&output.stderr)));
            }
        }
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = self.lab.command(arguments);
        // Nobody's terminal decides how wide the output is.
        command.current_dir(&self.folder).env_remove("COLUMNS").env("NO_COLOR", "1").stdin(Stdio::null());
        command
    }

    /// The lines of `extract` must be printed in this order. `...` is any text: lines, or a part of one.
    fn compare(&mut self, extract: &[String]) {
        let mut rest = self.printed.lines().map(str::trim_end);
        for line in extract.iter().map(|line| line.trim_end()).filter(|line| !matches!(*line, "..." | "")) {
            if !rest.any(|printed| is_extract(line, printed)) {
                self.failures.push(format!("`{line}` is not in this order in:\n{}", self.printed));
                return;
            }
        }
    }

    fn zip(&self, zip: &str, folder: &str) {
        let mut files = Vec::new();
        collect(&self.folder.join(folder), folder, &mut files);
        let borrowed: Vec<(&str, &[u8])> =
            files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
        std::fs::write(self.folder.join(zip), gonio_app::files::pack(&borrowed)).unwrap();
    }
}

/// Whether a line, with `...` for any text, is what was printed.
fn is_extract(line: &str, printed: &str) -> bool {
    let mut parts = line.split("...").peekable();
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = printed.strip_prefix(first) else { return false };
    if parts.peek().is_none() {
        return rest.is_empty();
    }
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        let Some((_, after)) = rest.split_once(part) else { return false };
        rest = after;
    }
    true
}

#[test]
fn an_extract_leaves_out_text_only_where_it_says_so() {
    assert!(is_extract("a b", "a b") && is_extract("a...", "a b") && is_extract("... b ... d", "a b c d"));
    assert!(!is_extract("a", "a b") && !is_extract("a...c", "a b") && !is_extract("b...", "a b"));
}

/// All files of a folder with their names in an archive.
fn collect(folder: &Path, name: &str, files: &mut Vec<(String, Vec<u8>)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = format!("{name}/{}", entry.file_name().into_string().unwrap());
        if entry.file_type().unwrap().is_dir() {
            collect(&entry.path(), &name, files);
        } else {
            files.push((name, std::fs::read(entry.path()).unwrap()));
        }
    }
}

/// The words of a line of a shell: quotes join words, `#` and a space begin a comment.
pub fn words(line: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut word: Option<String> = None;
    let mut quote: Option<char> = None;
    let comment = |at: usize| line[at..].starts_with("# ") || line[at..].trim_end() == "#";
    for (at, c) in line.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), c) => word.get_or_insert_default().push(c),
            (None, '"' | '\'') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, '#') if word.is_none() && comment(at) => break,
            (None, c) if c.is_whitespace() => words.extend(word.take()),
            (None, c) => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    words
}

#[test]
fn words_are_those_of_a_shell() {
    let line = "gonio render a.obj --light \"point position=2,3,4\" -o '' > b#c # why";
    assert_eq!(words(line), ["gonio", "render", "a.obj", "--light", "point position=2,3,4", "-o", "", ">", "b#c"]);
    assert!(words("# nothing").is_empty());
}
