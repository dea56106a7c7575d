//! The pages of the book as mdBook reads them.

use std::path::{Path, PathBuf};

/// A page of the book.
pub struct Page {
    /// The path below `docs`, with `/`.
    pub name: String,
    /// The text, with the included files.
    pub text: String,
}

/// A fenced block.
#[derive(Debug)]
pub struct CodeBlock {
    /// The language and attributes after the fence, such as `sh,exit=1`.
    pub info: String,
    pub lines: Vec<String>,
}

pub fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").canonicalize().unwrap()
}

/// All pages but the summary, in the order of their names.
pub fn pages() -> Vec<Page> {
    let mut pages = Vec::new();
    collect(&docs(), "", &mut pages);
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}

fn collect(folder: &Path, above: &str, pages: &mut Vec<Page>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = format!("{above}{}", entry.file_name().into_string().unwrap());
        if entry.file_type().unwrap().is_dir() {
            collect(&entry.path(), &format!("{name}/"), pages);
        } else if name.ends_with(".md") && name != "SUMMARY.md" {
            pages.push(Page { text: expanded(&entry.path()), name });
        }
    }
}

/// The text with every `{{#include FILE:FIRST:LAST}}` replaced, as mdBook does.
fn expanded(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap().replace("\r\n", "\n");
    let mut expanded = String::new();
    for line in text.lines() {
        let Some(arguments) = line.strip_prefix("{{#include ").and_then(|rest| rest.strip_suffix("}}")) else {
            assert!(!line.contains("{{#"), "{}: an include has a line of its own: {line}", path.display());
            expanded += line;
            expanded.push('\n');
            continue;
        };
        let mut parts = arguments.split(':');
        let file = path.parent().unwrap().join(parts.next().unwrap());
        let included = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{line} in {}: {e}", path.display()));
        let number = |part: Option<&str>| part.and_then(|digits| digits.parse::<usize>().ok());
        let (first, last) = (number(parts.next()).unwrap_or(1), number(parts.next()).unwrap_or(usize::MAX));
        for line in included.replace("\r\n", "\n").lines().take(last).skip(first - 1) {
            expanded += line;
            expanded.push('\n');
        }
    }
    expanded
}

impl Page {
    /// The fenced blocks, in order.
    pub fn blocks(&self) -> Vec<CodeBlock> {
        let mut blocks = Vec::new();
        let mut open: Option<CodeBlock> = None;
        for line in self.text.lines() {
            match (&mut open, line.strip_prefix("```")) {
                (None, Some(info)) => open = Some(CodeBlock { info: info.to_owned(), lines: Vec::new() }),
                (Some(_), Some("")) => blocks.extend(open.take()),
                (Some(block), _) => block.lines.push(line.to_owned()),
                (None, None) => {}
            }
        }
        assert!(open.is_none(), "{}: a code block does not end", self.name);
        blocks
    }

    /// The lines outside of code blocks, without code within lines.
    pub fn prose(&self) -> Vec<String> {
        let mut prose = Vec::new();
        let mut is_code = false;
        for line in self.text.lines() {
            if line.starts_with("```") {
                is_code = !is_code;
            } else if !is_code {
                prose.push(line.split('`').step_by(2).collect::<Vec<_>>().join("`"));
            }
        }
        prose
    }

    /// The anchors of the headings, as mdBook makes them.
    pub fn anchors(&self) -> Vec<String> {
        let mut is_code = false;
        let mut anchors = Vec::new();
        for line in self.text.lines() {
            if line.starts_with("```") {
                is_code = !is_code;
            } else if let Some(heading) = line.strip_prefix('#').filter(|_| !is_code) {
                let known = |c: char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
                let text: String = heading.trim_start_matches('#').trim().chars().filter(|&c| known(c)).collect();
                anchors.push(text.to_lowercase().replace(' ', "-"));
            }
        }
        anchors
    }
}
