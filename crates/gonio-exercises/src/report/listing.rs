//! The source of a submission with line numbers, and its findings marked.

use super::address::finding_anchor;
use super::html::{MOST_SHOWN, prose};
use super::text::{escaped, escaped_line};
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use gonio_language::tr;
use gonio_mesh::encoding::to_utf8;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Files with more lines are shown around their findings only.
const MOST_LINES: usize = 400;
/// Number of lines that are shown on each side of a finding in a long file, and at its beginning.
const AROUND: usize = 20;
/// Maximum number of files.
const MOST_FILES: usize = 8;
/// Maximum number of characters of all files together.
const MOST_CHARACTERS: usize = 100_000;

/// What was found in a line.
struct Mark {
    /// Its number among the findings, from 0.
    number: usize,
    /// Whether a compiler rejects the line.
    is_error: bool,
    /// The finding in half a sentence.
    name: String,
}

/// A file with its marks by line, from 1.
struct ListedFile {
    name: String,
    /// The lines that are shown, with their numbers from 1.
    lines: Vec<(usize, String)>,
    /// Number of lines of the file.
    count: usize,
    marks: BTreeMap<usize, Vec<Mark>>,
}

/// The files of a submission that are text and part of the answer.
#[derive(Default)]
pub struct Listing {
    files: Vec<ListedFile>,
    /// Number of files that are not shown.
    others: usize,
}

impl Listing {
    /// Lists these files: those with findings first, in the order of the findings. Files that are not text are left out.
    pub fn new<'a>(verdict: &Verdict, sources: impl IntoIterator<Item = &'a SourceFile>) -> Self {
        let marks = marks(verdict);
        let place = |file: &SourceFile| marks.iter().position(|(name, _)| *name == file.name).unwrap_or(usize::MAX);
        let mut sources: Vec<&SourceFile> = sources.into_iter().collect();
        sources.sort_by_key(|file| place(file));
        let mut listing = Listing::default();
        let mut left = MOST_CHARACTERS;
        let mut marks: BTreeMap<&str, BTreeMap<usize, Vec<Mark>>> = marks.into_iter().collect();
        for source in sources {
            let Some(text) = text_of(source) else { continue };
            let file = ListedFile::new(&source.name, &text, marks.remove(source.name.as_str()).unwrap_or_default());
            let size: usize = file.lines.iter().map(|(_, line)| line.chars().count().min(2000)).sum();
            if listing.files.len() == MOST_FILES || size > left {
                listing.others += 1;
                continue;
            }
            left -= size;
            listing.files.push(file);
        }
        listing
    }

    /// The name of a line's place in the page: `line-20` in the first file, `file-2-line-20` in the second. `None` if the line is
    /// not shown.
    pub fn anchor(&self, file: &str, line: u32) -> Option<String> {
        let line = usize::try_from(line).ok()?;
        let index = self.files.iter().position(|known| known.name == file)?;
        let is_shown = self.files[index].lines.iter().any(|(number, _)| *number == line);
        is_shown.then(|| anchor(index, line))
    }

    /// The section with the files; empty if there are none.
    pub fn html(&self) -> String {
        if self.files.is_empty() {
            return String::new();
        }
        let mut html = format!("<section class=\"source\">\n<h2>{}</h2>\n", tr!("report-code"));
        for (index, file) in self.files.iter().enumerate() {
            html.push_str(&file.html(index));
        }
        if self.others > 0 {
            let _ = writeln!(html, "<p class=\"hint\">{}</p>", tr!("report-and-more-files", count = self.others));
        }
        html.push_str("</section>\n");
        html
    }
}

fn anchor(file: usize, line: usize) -> String {
    match file {
        0 => format!("line-{line}"),
        file => format!("file-{}-line-{line}", file + 1),
    }
}

/// The findings with a line, by file in the order of the first ones.
fn marks(verdict: &Verdict) -> Vec<(&str, BTreeMap<usize, Vec<Mark>>)> {
    let mistakes = verdict.mistakes.iter().enumerate().filter_map(|(number, mistake)| {
        let mark = Mark { number, is_error: false, name: mistake.name.clone() };
        Some((mistake.file.as_deref()?, mistake.line?, mark))
    });
    let messages = verdict.messages.iter().enumerate().filter_map(|(number, message)| {
        let name = message.explanation.as_ref().unwrap_or(&message.text).clone();
        let mark = Mark { number: verdict.mistakes.len() + number, is_error: true, name };
        Some((message.file.as_str(), message.line?, mark))
    });
    let mut marks: Vec<(&str, BTreeMap<usize, Vec<Mark>>)> = Vec::new();
    // Findings beyond these have no anchor that a mark could lead to.
    for (file, line, mark) in mistakes.take(MOST_SHOWN).chain(messages.take(MOST_SHOWN)) {
        let index = marks.iter().position(|(name, _)| *name == file).unwrap_or_else(|| {
            marks.push((file, BTreeMap::new()));
            marks.len() - 1
        });
        let line = usize::try_from(line).unwrap_or(usize::MAX);
        marks[index].1.entry(line).or_default().push(mark);
    }
    marks
}

/// The text of a file with `\n` at the ends of lines; `None` if it is not text.
fn text_of(file: &SourceFile) -> Option<String> {
    let utf8 = to_utf8(&file.bytes).bytes;
    let text = String::from_utf8_lossy(&utf8);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    (!text.contains('\0')).then(|| text.replace("\r\n", "\n").replace('\r', "\n"))
}

impl ListedFile {
    fn new(name: &str, text: &str, marks: BTreeMap<usize, Vec<Mark>>) -> Self {
        let lines: Vec<&str> = text.lines().collect();
        let near = |line: &usize| line.saturating_sub(AROUND)..line.saturating_add(AROUND + 1);
        let shown: BTreeSet<usize> = match lines.len() > MOST_LINES {
            true => marks.keys().filter(|line| **line <= lines.len()).flat_map(near).chain(0..2 * AROUND + 1).collect(),
            false => (1..=lines.len()).collect(),
        };
        let shown = shown.into_iter().filter_map(|line| Some((line, (*lines.get(line.checked_sub(1)?)?).to_owned())));
        ListedFile { name: name.to_owned(), lines: shown.collect(), count: lines.len(), marks }
    }

    fn html(&self, index: usize) -> String {
        let mut html = format!(
            "<article>\n<h3 class=\"place\"><span class=\"file\">{}</span></h3>\n<pre class=\"listing\" tabindex=\"0\" \
             role=\"region\" aria-label=\"{}\">",
            escaped_line(&self.name),
            escaped_line(&self.name)
        );
        let mut last = 0;
        for (line, text) in &self.lines {
            html.push_str(&gap(line - last - 1));
            last = *line;
            let marks = self.marks.get(line).map(Vec::as_slice).unwrap_or_default();
            let class = match marks {
                [] => "",
                marks if marks.iter().any(|mark| mark.is_error) => " class=\"marked error\"",
                _ => " class=\"marked\"",
            };
            let _ = write!(
                html,
                "<span{class} id=\"{}\"><i>{line}</i><code>{}\n</code></span>",
                anchor(index, *line),
                escaped(text.trim_end())
            );
            for mark in marks {
                let name = prose(&mark.name);
                let class = if mark.is_error { "note error" } else { "note" };
                let _ = write!(
                    html,
                    "<span class=\"{class}\"><a href=\"#{}\">{name}</a>\n</span>",
                    finding_anchor(mark.number)
                );
            }
        }
        html.push_str(&gap(self.count - last));
        html.push_str("</pre>\n</article>\n");
        html
    }
}

/// A line instead of lines that are not shown.
fn gap(lines: usize) -> String {
    match lines {
        0 => String::new(),
        lines => format!("<span class=\"gap\">{}\n</span>", tr!("report-count-lines-not-shown", count = lines)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::verdict::{FoundMistake, Outcome};

    fn wrong_at(file: &str, line: u32) -> Verdict {
        let mut verdict = Verdict::new("ex04", Outcome::Wrong, "wrong");
        verdict.mistakes = vec![FoundMistake::new("id", "the name", 1.0).at(file, Some(line), "")];
        verdict
    }

    #[test]
    fn the_line_of_a_finding_is_marked_and_leads_back_to_it() {
        let sources = [SourceFile::new("a.vert", "one\ntwo"), SourceFile::new("b.frag", "\u{feff}x\r\n<y>\r\rz")];
        let listing = Listing::new(&wrong_at("b.frag", 2), &sources);
        let html = listing.html();
        let marked = "<span class=\"marked\" id=\"line-2\"><i>2</i><code>&lt;y&gt;\n</code></span><span class=\"note\"><a \
                      href=\"#finding-1\">the name</a>\n</span>";
        assert!(html.contains(marked), "{html}");
        assert_eq!(html.matches("marked").count(), 1);
        assert!(html.contains("id=\"line-4\"><i>4</i><code>z") && html.contains("id=\"file-2-line-1\""), "{html}");
        assert_eq!(listing.anchor("b.frag", 2).as_deref(), Some("line-2"));
        assert_eq!(listing.anchor("a.vert", 1).as_deref(), Some("file-2-line-1"));
        assert_eq!(
            (listing.anchor("a.vert", 3), listing.anchor("c", 1), listing.anchor("a.vert", 0)),
            (None, None, None)
        );
    }

    #[test]
    fn a_long_file_is_shown_around_its_findings() {
        let text: String = (1..=5000).map(|line| format!("number {line}\n")).collect();
        let listing = Listing::new(&wrong_at("a", 3000), &[SourceFile::new("a", text.as_bytes())]);
        assert_eq!(listing.files[0].lines.len(), 40 + 41);
        assert_eq!(listing.anchor("a", 3020).as_deref(), Some("line-3020"));
        assert_eq!(listing.anchor("a", 3021), None);
        let html = listing.html();
        assert!(html.contains("2939 lines not shown") && html.contains("1980 lines not shown"), "{html}");
        // A place beyond the end of the file marks nothing.
        let beyond = Listing::new(&wrong_at("a", u32::MAX), &[SourceFile::new("a", text.as_bytes())]);
        assert_eq!(beyond.files[0].lines.len(), 40);
        assert_eq!(beyond.anchor("a", u32::MAX), None);
    }

    #[test]
    fn pictures_and_endless_files_are_left_out() {
        let long = "x ".repeat(1000) + "\n";
        let sources = [
            SourceFile::new("a.png", b"\x89PNG\0\0"),
            SourceFile::new("b", long.repeat(300)),
            SourceFile::new("c", "short"),
        ];
        let listing = Listing::new(&wrong_at("c", 1), &sources);
        assert_eq!(listing.files.len(), 1);
        assert!(listing.html().contains("And 1 more file."));
        assert!(Listing::new(&wrong_at("c", 1), &[]).html().is_empty());
    }
}
