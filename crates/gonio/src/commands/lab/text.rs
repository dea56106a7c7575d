//! Verdicts as text for a terminal.

use crate::terminal::{Style, TerminalPage};
use gonio_check::proposed_fix::{self, DiffLine};
use gonio_check::testbench::scene::{term_title, title};
use gonio_check::verdict::{FoundMistake, Outcome, PropertyState, ProposedEdit, TermState, Verdict};
use gonio_exercises::report::{Row, SimilarGroup, points_line};
use gonio_language::tr;

const BOLD: Style = Style::Bold;
const DIM: Style = Style::Dim;
const GREEN: Style = Style::Green;
const RED: Style = Style::Red;
const YELLOW: Style = Style::Yellow;

/// A verdict as a student reads it.
pub fn verdict(verdict: &Verdict) -> TerminalPage {
    let (word, style) = match verdict.verdict {
        Outcome::Correct => (tr!("terminal-correct"), GREEN),
        Outcome::Wrong => (tr!("terminal-wrong"), RED),
        Outcome::DoesNotCompile => (tr!("terminal-does-not-compile"), RED),
        Outcome::Unsure => (tr!("terminal-unsure"), YELLOW),
    };
    let mut page = TerminalPage::new();
    page.line(format_args!("{BOLD}{}{BOLD:#}  {style}{word}{style:#}: {}", verdict.exercise, verdict.summary));
    if let Some(points) = &verdict.points {
        page.line(format_args!("  {}", points_line(points)));
    }
    for message in &verdict.messages {
        let place = match (message.line, message.column) {
            (Some(line), Some(column)) => format!("{}:{line}:{column}", message.file),
            (Some(line), None) => format!("{}:{line}", message.file),
            _ => message.file.clone(),
        };
        page.blank();
        page.line(format_args!("  {BOLD}{place}{BOLD:#}  {}", message.text));
        if let Some(quoted) = &message.quoted {
            page.line(format_args!("      {}", source_line(quoted)));
        }
        if let Some(explanation) = &message.explanation {
            page.line(format_args!("    {explanation}"));
        }
    }
    for found in &verdict.mistakes {
        mistake(&mut page, found);
    }
    proposed_fix(&mut page, &verdict.proposed_fix);
    if verdict.terms.iter().any(|term| term.state != TermState::NotSeparable) {
        let words = verdict.terms.iter().map(|term| match term.state {
            TermState::Right => format!("{} {GREEN}{}{GREEN:#}", term_title(&term.term), tr!("terminal-right")),
            TermState::Wrong => format!("{} {RED}{}{RED:#}", term_title(&term.term), tr!("terminal-wrong")),
            TermState::NotSeparable => {
                format!("{} {DIM}{}{DIM:#}", term_title(&term.term), tr!("terminal-not-tested-separately"))
            }
        });
        page.blank();
        let terms = tr!("terminal-terms");
        page.line(format_args!("  {BOLD}{terms}{BOLD:#}   {}", words.collect::<Vec<_>>().join(", ")));
    }
    let whole: Vec<_> = verdict.scenes.iter().filter(|scene| !scene.scene.ends_with("alone")).collect();
    if verdict.verdict == Outcome::Wrong && !whole.is_empty() {
        let words = whole.iter().map(|scene| match scene.right {
            true => format!("{} {GREEN}{}{GREEN:#}", title(&scene.scene), tr!("terminal-right")),
            false => {
                let percent = format!("{:.0}", 100.0 * scene.pixels_beyond);
                let differ = tr!("terminal-pixels-differ", percent = percent);
                format!("{} {RED}{}{RED:#} ({differ})", title(&scene.scene), tr!("terminal-wrong"))
            }
        });
        let scenes = tr!("terminal-scenes");
        page.line(format_args!("  {BOLD}{scenes}{BOLD:#}  {}", words.collect::<Vec<_>>().join(", ")));
    }
    let fails: Vec<_> = verdict.properties.iter().filter(|p| p.state == PropertyState::Wrong).collect();
    if !fails.is_empty() {
        page.blank();
        page.line(format_args!("  {BOLD}{}{BOLD:#}", tr!("terminal-consistency-checks")));
        for property in fails {
            let scenes: Vec<String> = property.scenes.iter().map(|scene| title(scene)).collect();
            page.line(format_args!("    {} ({})", property.sentence, scenes.join(", ")));
        }
    }
    if !verdict.peculiarities.is_empty() {
        page.blank();
        page.line(format_args!("  {BOLD}{}{BOLD:#}", tr!("terminal-another-method")));
        for peculiarity in &verdict.peculiarities {
            page.line(format_args!("    {}: {}", peculiarity.id, peculiarity.name));
        }
    }
    if !verdict.warnings.is_empty() {
        page.blank();
        page.line(format_args!("  {YELLOW}{}{YELLOW:#}", tr!("terminal-worth-knowing")));
        for warning in &verdict.warnings {
            page.line(format_args!("    {warning}"));
        }
    }
    let unknown: Vec<&str> =
        verdict.bound.iter().filter(|bound| bound.role.is_none()).map(|bound| bound.name.as_str()).collect();
    if !unknown.is_empty() {
        page.blank();
        let sentence = tr!("terminal-unrecognised-uniforms", names = unknown.join(", "));
        page.line(format_args!("  {DIM}{sentence}{DIM:#}"));
    }
    page
}

/// The number of characters of a source line that are quoted.
const MAX_QUOTED: usize = 160;

/// A line of source without its indentation, with spaces for tabs, cut if it is long.
fn source_line(line: &str) -> String {
    let line = line.trim().replace('\t', "    ");
    match line.char_indices().nth(MAX_QUOTED) {
        Some((end, _)) => format!("{} ...", line[..end].trim_end()),
        None => line,
    }
}

fn mistake(page: &mut TerminalPage, found: &FoundMistake) {
    page.blank();
    page.line(format_args!("  {RED}{}{RED:#}  {}", found.id, found.name));
    if let (Some(file), Some(line)) = (&found.file, found.line) {
        let quoted = source_line(found.quoted.as_deref().unwrap_or_default());
        page.line(format_args!("    {BOLD}{file}:{line}{BOLD:#}  {quoted}"));
    }
    match found.share_explained > 0.0 {
        true => {
            let percent = format!("{:.1}", 100.0 * found.share_explained);
            page.line(format_args!("    {}", tr!("terminal-it-explains", percent = percent)));
        }
        false => page.line(format_args!("    {}", tr!("terminal-the-source-shows-it"))),
    }
    if !found.or.is_empty() {
        page.line(format_args!("    {}", tr!("terminal-not-distinguished-from", ids = found.or.join(", "))));
    }
    for (heading, text) in [
        ("terminal-what-it-looks-like", &found.looks_like),
        ("terminal-how-to-fix-it", &found.fix),
        ("terminal-in-the-lecture", &found.lecture_section),
    ] {
        if !text.is_empty() {
            page.line(format_args!("    {DIM}{}{DIM:#} {text}", tr!(heading)));
        }
    }
    if found.lab_does_it {
        page.line(format_args!("    {}", tr!("terminal-the-lab-does-it-too")));
    }
}

/// The proposed fix as a unified diff.
fn proposed_fix(page: &mut TerminalPage, edits: &[ProposedEdit]) {
    if edits.is_empty() {
        return;
    }
    page.blank();
    page.line(format_args!("  {GREEN}{}{GREEN:#}", proposed_fix::promise(edits)));
    for edit in edits {
        page.line(format_args!("    {BOLD}{}:{}{BOLD:#}", edit.file, edit.line));
        for line in edit.diff() {
            let (sign, text) = (line.sign(), line.text().trim_end().replace('\t', "    "));
            match line {
                DiffLine::Kept(_) => page.line(format_args!("      {sign} {text}")),
                DiffLine::Removed(_) => page.line(format_args!("      {RED}{sign} {text}{RED:#}")),
                DiffLine::Added(_) => page.line(format_args!("      {GREEN}{sign} {text}{GREEN:#}")),
            }
        }
    }
}

/// Most members of a group of similar submissions in a line.
const MOST_MEMBERS: usize = 6;

/// Many submissions, one line each, with a summary.
pub fn table(rows: &[Row], similar: &[SimilarGroup]) -> TerminalPage {
    let width = rows.iter().map(|row| row.submission.chars().count()).max().unwrap_or(0).min(40);
    let mut page = TerminalPage::new();
    for row in rows {
        let (word, style) = match row.verdict {
            Outcome::Correct => (tr!("terminal-correct"), GREEN),
            Outcome::Wrong => (tr!("terminal-wrong"), RED),
            Outcome::DoesNotCompile => ("broken", RED),
            Outcome::Unsure => (tr!("terminal-unsure"), YELLOW),
        };
        let ids: Vec<&str> = row.mistakes.iter().map(|mistake| mistake.id.as_str()).collect();
        let summary = match (row.verdict, ids.is_empty()) {
            (Outcome::Correct, _) => String::new(),
            (_, true) => row.summary.lines().next().unwrap_or_default().to_owned(),
            (_, false) => ids.join(" "),
        };
        let place = row.place.as_deref().map_or(String::new(), |place| format!("  {DIM}{place}{DIM:#}"));
        page.line(format_args!("{:<width$}  {style}{word:<8}{style:#}  {summary}{place}", row.submission));
    }
    let count = |outcome| rows.iter().filter(|row| row.verdict == outcome).count();
    page.blank();
    let [submissions, compile] = [
        if rows.len() == 1 { "submission" } else { "submissions" },
        if count(Outcome::DoesNotCompile) == 1 { "does not compile" } else { "do not compile" },
    ];
    page.line(format_args!(
        "{} {submissions}: {} correct, {} wrong, {} {compile}, {} unsure",
        rows.len(),
        count(Outcome::Correct),
        count(Outcome::Wrong),
        count(Outcome::DoesNotCompile),
        count(Outcome::Unsure)
    ));
    for group in similar {
        let others = group.members.len().saturating_sub(MOST_MEMBERS);
        let mut members = group.members.iter().take(MOST_MEMBERS).cloned().collect::<Vec<_>>().join(", ");
        if others > 0 {
            members.push_str(&format!(" and {others} more"));
        }
        page.line(format_args!("{YELLOW}similar{YELLOW:#}: {members}, up to {:.0} %", 100.0 * group.highest()));
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_check::feedback::Feedback;

    #[test]
    fn a_verdict_shows_as_much_as_its_level() {
        let mut whole = Verdict::new("ex04", Outcome::Wrong, "skylark");
        let found = FoundMistake::new("skylark", "skylark", 1.0).taught("murky", "remedy", "chapter");
        whole.mistakes = vec![found.at("student.frag", Some(14), "quotation")];
        let (before, after) = ("same\n\toldtext".to_owned(), "same\n\tnewtext".to_owned());
        whole.proposed_fix = vec![ProposedEdit { file: "student.frag".to_owned(), line: 14, before, after }];
        let shown = |level: Feedback| verdict(&level.reduce(whole.clone())).for_terminal().to_owned();
        for (word, first) in [
            ("wrong", Feedback::Verdict),
            ("skylark", Feedback::Name),
            ("murky", Feedback::Name),
            ("chapter", Feedback::Name),
            ("student.frag:14", Feedback::Line),
            ("quotation", Feedback::Line),
            ("remedy", Feedback::Line),
            ("With this change every test scene is right.", Feedback::Fix),
            ("        same", Feedback::Fix),
            ("-     oldtext", Feedback::Fix),
            ("+     newtext", Feedback::Fix),
        ] {
            for level in Feedback::ALL {
                assert_eq!(shown(level).contains(word), level >= first, "`{word}` at {level:?}: {}", shown(level));
            }
        }
    }

    #[test]
    fn a_quoted_line_fits_a_terminal() {
        assert_eq!(source_line("\tint\ta; "), "int    a;");
        assert_eq!(source_line(&"é".repeat(MAX_QUOTED)), "é".repeat(MAX_QUOTED));
        assert_eq!(source_line(&"é".repeat(MAX_QUOTED + 1)), format!("{} ...", "é".repeat(MAX_QUOTED)));
    }
}
