//! The HTML frame of pages, and the parts of a verdict that pages and graders share.

use super::text::{count, escaped, escaped_line, line, percent, word, words};
use crate::content_hash;
use gonio_check::proposed_fix::{self, DiffLine};
use gonio_check::verdict::{
    CompilerMessage, FoundMistake, Outcome, PropertyState, PropertyVerdict, ProposedEdit, Verdict,
};
use std::fmt::Write as _;

/// Maximum number of shown items of a list whose length depends on a student's file.
const MOST_SHOWN: usize = 40;

/// Maximum number of characters of a compiler's message that are shown without unfolding.
const LONGEST_MESSAGE: usize = 200;

/// A whole page. `title` is plain text, `body` HTML. The page loads and runs nothing; its content security policy forbids it.
pub fn document(title: &str, body: &str) -> String {
    let style = include_str!("style.css");
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">\n\
         <title>{}</title>\n<style>\n{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escaped_line(title)
    )
}

/// Maximum size of a page's name in bytes, without its ending. File systems allow 255, and other names are derived from it.
const MAX_NAME_BYTES: usize = 120;

/// The file name of a submission's page, `NAME.html`: the label, with characters that are special in file systems or addresses
/// written as `~`, their number in hexadecimal, and `~`. Long names are truncated and end with a hash of the label, so that
/// different labels have different names. `index` is reserved for the overview.
pub fn page_name(label: &str) -> String {
    let mut name = String::new();
    for (at, c) in label.chars().enumerate() {
        let is_safe = c.is_alphanumeric() || matches!(c, '_' | '-' | ' ' | '+' | ',') || (c == '.' && at > 0);
        if is_safe {
            name.push(c);
        } else {
            // Writing into a String cannot fail.
            let _ = write!(name, "~{:x}~", u32::from(c));
        }
        if name.len() > MAX_NAME_BYTES {
            break;
        }
    }
    if name.len() > MAX_NAME_BYTES {
        let hash = format!("~{:016x}", content_hash(std::iter::once(label.as_bytes())));
        name.truncate(name.floor_char_boundary(MAX_NAME_BYTES - hash.len()));
        name.push_str(&hash);
    }
    if is_reserved(&name) {
        name.insert(0, '~');
    }
    name.push_str(".html");
    name
}

/// Whether a name is reserved: that of the overview, or of a device on Windows.
fn is_reserved(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let is_port = |port: &str| stem.strip_prefix(port).is_some_and(|rest| rest.len() == 1 && rest != "0");
    name.is_empty()
        || matches!(stem.as_str(), "index" | "con" | "prn" | "aux" | "nul")
        || is_port("com")
        || is_port("lpt")
}

/// The relative address of a submission's page.
pub fn page_address(label: &str) -> String {
    let mut address = String::from("./");
    for byte in page_name(label).bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'.' | b'_' | b'-' | b'~' => address.push(char::from(byte)),
            byte => {
                let _ = write!(address, "%{byte:02X}");
            }
        }
    }
    address
}

/// An icon beside a word with the same meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// A tick.
    Right,
    /// A cross.
    Wrong,
    /// An exclamation mark in a triangle.
    Broken,
    /// A question mark.
    Unsure,
    /// A dash.
    None,
}

impl Icon {
    /// The icon of an outcome.
    pub fn for_outcome(outcome: Outcome) -> Icon {
        match outcome {
            Outcome::Correct => Icon::Right,
            Outcome::Wrong => Icon::Wrong,
            Outcome::DoesNotCompile => Icon::Broken,
            Outcome::Unsure => Icon::Unsure,
        }
    }

    /// The icon as SVG, in the colour of the surrounding text.
    pub fn svg(self) -> String {
        let path = match self {
            Icon::Right => "<circle cx='10' cy='10' r='9'/><path class='k' d='M5.8 10.4l2.9 2.9 5.6-6.4'/>",
            Icon::Wrong => "<circle cx='10' cy='10' r='9'/><path class='k' d='M6.7 6.7l6.6 6.6M13.3 6.7l-6.6 6.6'/>",
            Icon::Broken => "<path d='M10 1.6L19 18H1z'/><path class='k' d='M10 7.4v4.8M10 15v.1'/>",
            Icon::Unsure => {
                "<circle cx='10' cy='10' r='9'/>\
                 <path class='k' d='M7.3 7.6a2.7 2.7 0 1 1 4 2.4c-.9.5-1.3 1-1.3 2M10 14.9v.1'/>"
            }
            Icon::None => "<circle class='o' cx='10' cy='10' r='8'/><path class='d' d='M6.5 10h7'/>",
        };
        format!("<svg class='icon' viewBox='0 0 20 20' aria-hidden='true' focusable='false'>{path}</svg>")
    }
}

/// A text of gonio as HTML, with `code` marked up.
pub fn prose(text: &str) -> String {
    let mut prose = String::new();
    for (index, part) in line(text).split('`').enumerate() {
        let part = escaped(part);
        match index % 2 {
            0 => prose.push_str(&part),
            _ => {
                let _ = write!(prose, "<code>{part}</code>");
            }
        }
    }
    prose
}

/// The first items of a list, and the number of the others.
pub fn shown<T>(all: &[T], each: impl Fn(&T) -> String, more: impl Fn(usize) -> String) -> String {
    let mut shown: String = all.iter().take(MOST_SHOWN).map(each).collect();
    if all.len() > MOST_SHOWN {
        shown.push_str(&more(all.len() - MOST_SHOWN));
    }
    shown
}

/// A line of source, below its file and line number in an element `tag`.
pub fn quote(tag: &str, file: Option<&str>, number: Option<u32>, column: Option<u32>, quoted: Option<&str>) -> String {
    let Some(file) = file else { return String::new() };
    let mut place = format!("<span class=\"file\">{}</span>", escaped_line(file));
    if let Some(number) = number {
        let _ = write!(place, ", line {number}");
    }
    if let Some(column) = column {
        let _ = write!(place, ", column {column}");
    }
    let code =
        quoted.map(|quoted| quoted.trim()).filter(|quoted| !quoted.is_empty()).map_or_else(String::new, |quoted| {
            let number = number.map_or_else(String::new, |number| format!("<span class=\"number\">{number}</span> "));
            format!("<pre>{number}<code>{}</code></pre>", escaped_line(quoted))
        });
    format!("<div class=\"quote\"><{tag} class=\"place\">{place}</{tag}>{code}</div>\n")
}

/// The verdict, in colour, with icon and words. The icon needs this page's style.
pub fn verdict_html(verdict: &Verdict, with_icon: bool) -> String {
    let right = verdict.scenes.iter().filter(|scene| scene.right).count();
    let mut facts = Vec::new();
    if !verdict.scenes.is_empty() {
        facts.push(format!("{right} of {} right", count(verdict.scenes.len(), "scene", "scenes")));
    }
    facts.push(format!("Score {}", percent(verdict.score)));
    format!(
        "<section class=\"verdict {}\">\n<h2>{}<span>{}</span></h2>\n<p class=\"summary\">{}</p>\n<p \
         class=\"facts\">{}</p>\n</section>\n",
        word(verdict.verdict),
        if with_icon { Icon::for_outcome(verdict.verdict).svg() } else { String::new() },
        capital(words(verdict.verdict)),
        sentence(&verdict.summary),
        facts.join(" · "),
    )
}

fn capital(text: &str) -> String {
    let mut characters = text.chars();
    characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
}

/// A phrase as a sentence, with a capital letter and a full stop.
fn sentence(text: &str) -> String {
    let text = capital(&line(text));
    let end = if text.is_empty() || text.ends_with(['.', '!', '?', '…', ':', ')']) { "" } else { "." };
    format!("{}{end}", prose(&text))
}

/// The section about the mistakes: name, evidence and fix of each.
pub fn mistakes_html(verdict: &Verdict) -> String {
    if verdict.mistakes.is_empty() {
        return String::new();
    }
    let heading = match verdict.mistakes.len() {
        1 => "What is wrong".to_owned(),
        several => format!("What is wrong: {several} mistakes"),
    };
    let together = verdict.mistakes.len() > 1;
    let each = |mistake: &FoundMistake| mistake_html(mistake, together);
    let mistakes: String = shown(&verdict.mistakes, each, |more| format!("<p>And {more} more.</p>\n"));
    format!("<section class=\"mistakes\">\n<h2>{heading}</h2>\n{mistakes}</section>\n")
}

fn mistake_html(mistake: &FoundMistake, together: bool) -> String {
    let mut html = format!("<article>\n<h3>{}</h3>\n", prose(&mistake.name));
    html.push_str(&quote("p", mistake.file.as_deref(), mistake.line, None, mistake.quoted.as_deref()));
    html.push_str("<dl>\n");
    let parts = [
        ("What it looks like", &mistake.looks_like),
        ("How to fix it", &mistake.fix),
        ("In the lecture", &mistake.lecture_section),
    ];
    for (term, text) in parts.into_iter().filter(|(_, text)| !text.is_empty()) {
        let _ = writeln!(html, "<dt>{term}</dt><dd>{}</dd>", prose(text));
    }
    if !mistake.or.is_empty() {
        let name = |id: &String| match gonio_check::mistakes::find(id) {
            Some(other) => prose(&other.name),
            None => format!("<code>{}</code>", escaped_line(id)),
        };
        let others: Vec<String> = mistake.or.iter().take(MOST_SHOWN).map(name).collect();
        let _ =
            writeln!(html, "<dt>Alternatives</dt><dd>{} (no picture distinguishes these)</dd>", others.join("; or: "));
    }
    if mistake.lab_does_it {
        html.push_str("<dt>Note</dt><dd>The lab’s own solutions do the same; the textbook does not.</dd>\n");
    }
    let others = if together { "together with the others, it" } else { "it" };
    let facts = match mistake.share_explained > 0.0 {
        true => format!("{others} explains {} of the difference", percent(mistake.share_explained)),
        false => "the source shows it".to_owned(),
    };
    let _ = write!(
        html,
        "</dl>\n<p class=\"facts\"><code>{}</code> · {facts}</p>\n</article>\n",
        escaped_line(&mistake.id),
    );
    html
}

/// The proposed fix as a diff, in which signs and colours mark the lines.
pub fn proposed_fix_html(verdict: &Verdict) -> String {
    if verdict.proposed_fix.is_empty() {
        return String::new();
    }
    let each = |edit: &ProposedEdit| {
        let line = |line: &DiffLine<'_>| {
            let class = match line {
                DiffLine::Kept(_) => "kept",
                DiffLine::Removed(_) => "removed",
                DiffLine::Added(_) => "added",
            };
            format!("<code class=\"{class}\">{} {}\n</code>", line.sign(), escaped(line.text().trim_end()))
        };
        let diff =
            shown(&edit.diff(), line, |more| format!("<code>And {}.</code>", count(more, "more line", "more lines")));
        let place = quote("h3", Some(&edit.file), Some(edit.line), None, None);
        format!("<article>\n{place}<pre class=\"diff\">{diff}</pre>\n</article>\n")
    };
    let edits = shown(&verdict.proposed_fix, each, |more| {
        format!("<p>And {}.</p>\n", count(more, "more change", "more changes"))
    });
    format!(
        "<section class=\"fix\">\n<h2>How it becomes right</h2>\n<p class=\"promise\">{}</p>\n{edits}</section>\n",
        proposed_fix::promise(&verdict.proposed_fix)
    )
}

/// Compiler messages.
pub fn messages_html(verdict: &Verdict) -> String {
    if verdict.messages.is_empty() {
        return String::new();
    }
    let more = |more: usize| format!("<p>And {}. Fix the first ones first.</p>\n", count(more, "more", "more"));
    let messages = shown(&verdict.messages, message_html, more);
    format!("<section class=\"messages\">\n<h2>Compiler messages</h2>\n{messages}</section>\n")
}

/// The explanation, if there is one, above the original message of the compiler, which is seldom written for students.
fn message_html(message: &CompilerMessage) -> String {
    let place = quote("h3", Some(&message.file), message.line, message.column, message.quoted.as_deref());
    let text = line(&message.text);
    // Drivers list every overload of a function.
    let is_long = text.chars().count() > LONGEST_MESSAGE;
    match &message.explanation {
        Some(explanation) if is_long => format!(
            "<article>\n{place}<p>{}</p>\n<div class=\"original\"><details><summary>Original message</summary>\
             <pre>{}</pre></details></div>\n</article>\n",
            prose(explanation),
            escaped(&text)
        ),
        Some(explanation) => format!(
            "<article>\n{place}<p>{}</p>\n<div class=\"original\"><p>Original message</p><pre>{}</pre></div>\n</article>\n",
            prose(explanation),
            escaped(&text)
        ),
        None if is_long => {
            let start: String = text.chars().take(LONGEST_MESSAGE).collect();
            format!(
                "<article>\n{place}<p>{}…</p>\n<div class=\"original\"><details><summary>Whole message</summary>\
                 <pre>{}</pre></details></div>\n</article>\n",
                escaped(&start),
                escaped(&text)
            )
        }
        None => format!("<article>\n{place}<p>{}</p>\n</article>\n", escaped(&text)),
    }
}

/// The results of the tests of self-consistency; those that do not apply are left out.
fn properties_html(verdict: &Verdict) -> String {
    let tried: Vec<&PropertyVerdict> =
        verdict.properties.iter().filter(|property| property.state != PropertyState::NotApplicable).collect();
    if tried.is_empty() {
        return String::new();
    }
    let each = |property: &&PropertyVerdict| {
        let (word, scenes) = match property.state {
            PropertyState::Wrong if !property.scenes.is_empty() => {
                ("Wrong", format!(" <small>{}</small>", escaped_line(&property.scenes.join(", "))))
            }
            PropertyState::Wrong => ("Wrong", String::new()),
            _ => ("Right", String::new()),
        };
        format!("<li><strong>{word}</strong>: {}{scenes}</li>\n", prose(&property.sentence))
    };
    let list = shown(&tried, each, |more| format!("<li>And {more} more.</li>\n"));
    format!("<section>\n<h2>Self-consistency</h2>\n<ul class=\"notes\">\n{list}</ul>\n</section>\n")
}

/// Self-consistency, peculiarities and warnings.
pub fn notes_html(verdict: &Verdict) -> String {
    let mut html = properties_html(verdict);
    let more = |more: usize| format!("<li>And {more} more.</li>\n");
    if !verdict.peculiarities.is_empty() {
        let each = |known: &gonio_check::verdict::Peculiarity| {
            format!("<li>{} <code>{}</code></li>\n", sentence(&known.name), escaped_line(&known.id))
        };
        let list = shown(&verdict.peculiarities, each, more);
        let _ = write!(
            html,
            "<section>\n<h2>Right, by another method</h2>\n<ul class=\"notes\">\n{list}</ul>\n</section>\n"
        );
    }
    if !verdict.warnings.is_empty() {
        let list = shown(&verdict.warnings, |warning| format!("<li>{}</li>\n", sentence(warning)), more);
        let _ =
            write!(html, "<section>\n<h2>Worth knowing</h2>\n<ul class=\"notes warnings\">\n{list}</ul>\n</section>\n");
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn different_labels_have_different_pages() {
        let labels = [
            "ada",
            "Ada L.",
            "a/b",
            "a~2f~b",
            "a\\b",
            "..",
            ".",
            "",
            "index",
            "INDEX",
            "a\0b",
            "a\u{202e}b",
            "é",
            "a?b#c",
            "CON",
            "lpt1.x",
            &"\u{1f600}".repeat(60),
            &"\u{1f600}".repeat(61),
            &"é".repeat(200),
        ];
        let names: std::collections::BTreeSet<String> = labels.iter().map(|label| page_name(label)).collect();
        assert_eq!(names.len(), labels.len(), "{names:?}");
        assert!(names.iter().all(|name| name.len() <= 125 && name.ends_with(".html")), "{names:?}");
        assert!(!names.contains("CON.html") && !names.contains("lpt1.x.html"));
        for name in &names {
            assert!(!name.contains(['/', '\\', '\0', '?', '#', '\u{202e}']) && !name.starts_with('.'), "{name}");
        }
        assert_eq!(page_name("ada"), "ada.html");
        assert!(!names.contains("index.html") && !names.contains("INDEX.html"));
        assert_eq!(page_address("Zoé K"), "./Zo%C3%A9%20K.html");
        assert_eq!(page_address("javascript:alert(1)"), "./javascript~3a~alert~28~1~29~.html");
    }

    #[test]
    fn code_within_prose_is_marked() {
        assert_eq!(prose("use `mat3(itM) * n`, not <M>"), "use <code>mat3(itM) * n</code>, not &lt;M&gt;");
        assert_eq!(sentence("the normal is wrong"), "The normal is wrong.");
        assert_eq!(sentence("why?"), "Why?");
        assert_eq!(sentence(""), "");
    }
}
