//! The parts of a verdict as HTML, which pages and graders share.
//!
//! With a listing, findings have anchors and their places are links into it. Graders show the parts within pages of their own and
//! pass none.

use super::address::finding_anchor;
use super::html::{Icon, MOST_SHOWN, capital, prose, sentence, shown};
use super::listing::Listing;
use super::text::{escaped, escaped_line, line, percent, points_line, word, words};
use gonio_check::proposed_fix::{self, DiffLine};
use gonio_check::testbench::scene;
use gonio_check::verdict::{CompilerMessage, FoundMistake, PropertyState, PropertyVerdict, ProposedEdit, Verdict};
use gonio_language::tr;
use std::fmt::Write as _;

/// Maximum number of characters of a compiler's message that are shown without unfolding.
const LONGEST_MESSAGE: usize = 200;

/// A place in a submission with the text there.
#[derive(Clone, Copy, Default)]
struct Quote<'a> {
    file: Option<&'a str>,
    line: Option<u32>,
    column: Option<u32>,
    quoted: Option<&'a str>,
}

impl Quote<'_> {
    /// The line of source, below its file and line number in an element `tag`.
    fn html(&self, tag: &str, listing: Option<&Listing>) -> String {
        let Some(file) = self.file else { return String::new() };
        let mut place = format!("<span class=\"file\">{}</span>", escaped_line(file));
        if let Some(number) = self.line {
            let _ = write!(place, "{}", tr!("report-line", line = number));
        }
        if let Some(column) = self.column {
            let _ = write!(place, "{}", tr!("report-column", column = column));
        }
        if let Some(anchor) = listing.zip(self.line).and_then(|(listing, line)| listing.anchor(file, line)) {
            place = format!("<a href=\"#{anchor}\">{place}</a>");
        }
        let quoted = self.quoted.map(str::trim).filter(|quoted| !quoted.is_empty());
        let code = quoted.map_or_else(String::new, |quoted| {
            let number =
                self.line.map_or_else(String::new, |number| format!("<span class=\"number\">{number}</span> "));
            format!("<pre>{number}<code>{}</code></pre>", escaped_line(quoted))
        });
        format!("<div class=\"quote\"><{tag} class=\"place\">{place}</{tag}>{code}</div>\n")
    }
}

/// The start tag of an article about a finding.
fn article(number: usize, listing: Option<&Listing>) -> String {
    match listing {
        Some(_) => format!("<article id=\"{}\">\n", finding_anchor(number)),
        None => "<article>\n".to_owned(),
    }
}

/// The verdict, in colour, with icon and words. The icon needs this page's style.
pub fn verdict_html(verdict: &Verdict, with_icon: bool) -> String {
    let right = verdict.scenes.iter().filter(|scene| scene.right).count();
    let mut facts = Vec::new();
    if !verdict.scenes.is_empty() {
        facts.push(tr!("report-scenes-right", right = right, count = verdict.scenes.len()));
    }
    facts.push(match &verdict.points {
        Some(points) => points_line(points),
        None => tr!("report-score", percent = percent(verdict.score)),
    });
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

/// The section about the mistakes: name, evidence and fix of each.
pub fn mistakes_html(verdict: &Verdict, listing: Option<&Listing>) -> String {
    if verdict.mistakes.is_empty() {
        return String::new();
    }
    let heading = match verdict.mistakes.len() {
        1 => tr!("report-what-is-wrong").to_owned(),
        several => tr!("report-what-is-wrong-several", several = several),
    };
    let together = verdict.mistakes.len() > 1;
    let numbered: Vec<(usize, &FoundMistake)> = verdict.mistakes.iter().enumerate().collect();
    let each = |(number, mistake): &(usize, &FoundMistake)| {
        format!("{}{}", article(*number, listing), mistake_html(mistake, together, listing))
    };
    let mistakes: String = shown(&numbered, each, |more| format!("<p>{}</p>\n", tr!("report-and-more", more = more)));
    format!("<section class=\"mistakes\">\n<h2>{heading}</h2>\n{mistakes}</section>\n")
}

/// A mistake, after the start tag of its article.
fn mistake_html(mistake: &FoundMistake, together: bool, listing: Option<&Listing>) -> String {
    let mut html = format!("<h3>{}</h3>\n", prose(&mistake.name));
    let place =
        Quote { file: mistake.file.as_deref(), line: mistake.line, column: None, quoted: mistake.quoted.as_deref() };
    html.push_str(&place.html("p", listing));
    html.push_str("<dl>\n");
    let parts = [
        (tr!("report-heading-looks-like"), &mistake.looks_like),
        (tr!("report-heading-fix"), &mistake.fix),
        (tr!("report-heading-lecture"), &mistake.lecture_section),
    ];
    for (term, text) in parts.into_iter().filter(|(_, text)| !text.is_empty()) {
        let _ = writeln!(html, "<dt>{term}</dt><dd>{}</dd>", prose(text));
    }
    if !mistake.or.is_empty() {
        let name = |id: &String| match gonio_check::mistakes::find(id) {
            Some(other) => prose(&other.texts().name),
            None => format!("<code>{}</code>", escaped_line(id)),
        };
        let others: Vec<String> = mistake.or.iter().take(MOST_SHOWN).map(name).collect();
        let others = tr!("report-no-picture-distinguishes-these", names = others.join(tr!("report-or")));
        let _ = writeln!(html, "<dt>{}</dt><dd>{others}</dd>", tr!("report-alternatives"));
    }
    if mistake.lab_does_it {
        let _ = writeln!(html, "<dt>{}</dt><dd>{}</dd>", tr!("report-note"), tr!("report-lab-does-it"));
    }
    let percent = percent(mistake.share_explained);
    let facts = match (mistake.share_explained > 0.0, together) {
        (true, true) => tr!("report-together-explains", percent = percent),
        (true, false) => tr!("report-it-explains", percent = percent),
        (false, _) => tr!("report-source-shows-it").to_owned(),
    };
    let _ = write!(
        html,
        "</dl>\n<p class=\"facts\"><code>{}</code> · {facts}</p>\n</article>\n",
        escaped_line(&mistake.id),
    );
    html
}

/// The proposed fix as a diff, in which signs and colours mark the lines.
pub fn proposed_fix_html(verdict: &Verdict, listing: Option<&Listing>) -> String {
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
            shown(&edit.diff(), line, |more| format!("<code>{}</code>", tr!("report-and-more-lines", count = more)));
        let place = Quote { file: Some(&edit.file), line: Some(edit.line), ..Quote::default() }.html("h3", listing);
        format!("<article>\n{place}<pre class=\"diff\">{diff}</pre>\n</article>\n")
    };
    let edits =
        shown(&verdict.proposed_fix, each, |more| format!("<p>{}</p>\n", tr!("report-and-more-changes", count = more)));
    format!(
        "<section class=\"fix\">\n<h2>{}</h2>\n<p class=\"promise\">{}</p>\n{edits}</section>\n",
        tr!("report-how-it-becomes-right"),
        proposed_fix::promise(&verdict.proposed_fix)
    )
}

/// Compiler messages.
pub fn messages_html(verdict: &Verdict, listing: Option<&Listing>) -> String {
    if verdict.messages.is_empty() {
        return String::new();
    }
    let more = |more: usize| format!("<p>{}</p>\n", tr!("report-and-more-messages", more = more));
    let numbered: Vec<(usize, &CompilerMessage)> = verdict.messages.iter().enumerate().collect();
    let each = |(number, message): &(usize, &CompilerMessage)| {
        format!("{}{}", article(verdict.mistakes.len() + number, listing), message_html(message, listing))
    };
    let messages = shown(&numbered, each, more);
    let heading = tr!("report-compiler-messages");
    format!("<section class=\"messages\">\n<h2>{heading}</h2>\n{messages}</section>\n")
}

/// The explanation, if there is one, above the original message of the compiler, which is seldom written for students. The start
/// tag of the article comes before it.
fn message_html(message: &CompilerMessage, listing: Option<&Listing>) -> String {
    let place = Quote {
        file: Some(&message.file),
        line: message.line,
        column: message.column,
        quoted: message.quoted.as_deref(),
    };
    let place = place.html("h3", listing);
    let text = line(&message.text);
    let (original, whole) = (tr!("report-original-message"), tr!("report-whole-message"));
    // Drivers list every overload of a function.
    let is_long = text.chars().count() > LONGEST_MESSAGE;
    match &message.explanation {
        Some(explanation) if is_long => format!(
            "{place}<p>{}</p>\n<div class=\"original\"><details><summary>{original}</summary>\
             <pre>{}</pre></details></div>\n</article>\n",
            prose(explanation),
            escaped(&text)
        ),
        Some(explanation) => format!(
            "{place}<p>{}</p>\n<div class=\"original\"><p>{original}</p><pre>{}</pre></div>\n</article>\n",
            prose(explanation),
            escaped(&text)
        ),
        None if is_long => {
            let start: String = text.chars().take(LONGEST_MESSAGE).collect();
            format!(
                "{place}<p>{}…</p>\n<div class=\"original\"><details><summary>{whole}</summary>\
                 <pre>{}</pre></details></div>\n</article>\n",
                escaped(&start),
                escaped(&text)
            )
        }
        None => format!("{place}<p>{}</p>\n</article>\n", escaped(&text)),
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
                let scenes: Vec<String> = property.scenes.iter().map(|name| scene::title(name)).collect();
                (tr!("report-property-wrong"), format!(" <small>{}</small>", escaped_line(&scenes.join(", "))))
            }
            PropertyState::Wrong => (tr!("report-property-wrong"), String::new()),
            _ => (tr!("report-property-right"), String::new()),
        };
        format!("<li><strong>{word}</strong>: {}{scenes}</li>\n", prose(&property.sentence))
    };
    let list = shown(&tried, each, |more| format!("<li>{}</li>\n", tr!("report-and-more", more = more)));
    let heading = tr!("report-consistency-checks");
    format!("<section>\n<h2>{heading}</h2>\n<ul class=\"notes\">\n{list}</ul>\n</section>\n")
}

/// Consistency checks, peculiarities and warnings.
pub fn notes_html(verdict: &Verdict) -> String {
    let mut html = properties_html(verdict);
    let more = |more: usize| format!("<li>{}</li>\n", tr!("report-and-more", more = more));
    if !verdict.peculiarities.is_empty() {
        let each = |known: &gonio_check::verdict::Peculiarity| {
            format!("<li>{} <code>{}</code></li>\n", sentence(&known.name), escaped_line(&known.id))
        };
        let list = shown(&verdict.peculiarities, each, more);
        let _ = write!(
            html,
            "<section>\n<h2>{}</h2>\n<ul class=\"notes\">\n{list}</ul>\n</section>\n",
            tr!("report-heading-other-method")
        );
    }
    if !verdict.warnings.is_empty() {
        let list = shown(&verdict.warnings, |warning| format!("<li>{}</li>\n", sentence(warning)), more);
        let heading = tr!("report-worth-knowing");
        let _ = write!(html, "<section>\n<h2>{heading}</h2>\n<ul class=\"notes warnings\">\n{list}</ul>\n</section>\n");
    }
    html
}
