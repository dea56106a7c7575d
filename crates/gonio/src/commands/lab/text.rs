//! Verdicts for a terminal.

use anstyle::{AnsiColor, Style};
use gonio_lab::formats::Row;
use gonio_lab::verdict::{FoundMistake, Outcome, PropertyState, TermState, Verdict};
use std::fmt::Write as _;

const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dimmed();
const GREEN: Style = Style::new().bold().fg_color(Some(anstyle::Color::Ansi(AnsiColor::Green)));
const RED: Style = Style::new().bold().fg_color(Some(anstyle::Color::Ansi(AnsiColor::Red)));
const YELLOW: Style = Style::new().bold().fg_color(Some(anstyle::Color::Ansi(AnsiColor::Yellow)));

/// What a student reads.
pub fn verdict(verdict: &Verdict) -> String {
    let (word, style) = match verdict.verdict {
        Outcome::Correct => ("correct", GREEN),
        Outcome::Wrong => ("wrong", RED),
        Outcome::DoesNotCompile => ("does not compile", RED),
        Outcome::Unsure => ("unsure", YELLOW),
    };
    let mut text = format!("{BOLD}{}{BOLD:#}  {style}{word}{style:#}: {}\n", verdict.exercise, verdict.summary);
    for message in &verdict.messages {
        let place = match (message.line, message.column) {
            (Some(line), Some(column)) => format!("{}:{line}:{column}", message.file),
            (Some(line), None) => format!("{}:{line}", message.file),
            _ => message.file.clone(),
        };
        let _ = writeln!(text, "\n  {BOLD}{place}{BOLD:#}  {}", message.text);
        if let Some(quoted) = &message.quoted {
            let _ = writeln!(text, "      {}", quoted.trim());
        }
        if let Some(explanation) = &message.explanation {
            let _ = writeln!(text, "    {explanation}");
        }
    }
    for found in &verdict.mistakes {
        text.push_str(&mistake(found));
    }
    if let Some(next) = &verdict.runner_up {
        let share = 100.0 * next.share_explained;
        let _ = writeln!(
            text,
            "\n  {DIM}Next best: {}, explains {share:.1} % of the difference{DIM:#}",
            next.ids.join(" and ")
        );
    }
    if verdict.terms.iter().any(|term| term.state != TermState::NotSeparable) {
        let words = verdict.terms.iter().map(|term| match term.state {
            TermState::Right => format!("{} {GREEN}right{GREEN:#}", term.term),
            TermState::Wrong => format!("{} {RED}wrong{RED:#}", term.term),
            TermState::NotSeparable => format!("{} {DIM}not to be told apart{DIM:#}", term.term),
        });
        let _ = writeln!(text, "\n  {BOLD}Terms{BOLD:#}   {}", words.collect::<Vec<_>>().join(", "));
    }
    let whole: Vec<_> = verdict.scenes.iter().filter(|scene| !scene.scene.ends_with("alone")).collect();
    if verdict.verdict == Outcome::Wrong && !whole.is_empty() {
        let words = whole.iter().map(|scene| match scene.right {
            true => format!("{} {GREEN}right{GREEN:#}", scene.scene),
            false => format!("{} {RED}wrong{RED:#} ({:.0} %)", scene.scene, 100.0 * scene.pixels_beyond),
        });
        let _ = writeln!(text, "  {BOLD}Scenes{BOLD:#}  {}", words.collect::<Vec<_>>().join(", "));
    }
    let fails: Vec<_> = verdict.properties.iter().filter(|p| p.state == PropertyState::Wrong).collect();
    if !fails.is_empty() {
        let _ = writeln!(text, "\n  {BOLD}Held against itself{BOLD:#}");
        for property in fails {
            let _ = writeln!(text, "    {} ({})", property.sentence, property.scenes.join(", "));
        }
    }
    if !verdict.peculiarities.is_empty() {
        let _ = writeln!(text, "\n  {BOLD}Right, in a way of its own{BOLD:#}");
        for peculiarity in &verdict.peculiarities {
            let _ = writeln!(text, "    {}: {}", peculiarity.id, peculiarity.name);
        }
    }
    if !verdict.warnings.is_empty() {
        let _ = writeln!(text, "\n  {YELLOW}Worth knowing{YELLOW:#}");
        for warning in &verdict.warnings {
            let _ = writeln!(text, "    {warning}");
        }
    }
    let unknown: Vec<&str> =
        verdict.bound.iter().filter(|bound| bound.role.is_none()).map(|bound| bound.name.as_str()).collect();
    if !unknown.is_empty() {
        let _ = writeln!(
            text,
            "\n  {DIM}Not known here, and 0: {} (names.toml can say what they are){DIM:#}",
            unknown.join(", ")
        );
    }
    text
}

fn mistake(found: &FoundMistake) -> String {
    let mut text = format!("\n  {RED}{}{RED:#}  {}\n", found.id, found.name);
    if let (Some(file), Some(line)) = (&found.file, found.line) {
        let _ =
            writeln!(text, "    {BOLD}{file}:{line}{BOLD:#}  {}", found.quoted.as_deref().unwrap_or_default().trim());
    }
    let _ = match found.share_explained > 0.0 {
        true => writeln!(text, "    It explains {:.1} % of the difference.", 100.0 * found.share_explained),
        false => writeln!(text, "    The source shows it; how much of the difference it explains cannot be told."),
    };
    if !found.or.is_empty() {
        let _ = writeln!(text, "    No picture tells it apart from: {}.", found.or.join(", "));
    }
    for (what, said) in
        [("What it looks like", &found.looks_like), ("To mend it", &found.mend), ("In the lecture", &found.seed)]
    {
        if !said.is_empty() {
            let _ = writeln!(text, "    {DIM}{what}:{DIM:#} {said}");
        }
    }
    if found.lab_does_it {
        let _ = writeln!(text, "    The lab's own solution does the same; --as-the-lab lets it pass.");
    }
    text
}

/// Many submissions, a line each, and what is to be said of all together.
pub fn table(rows: &[Row], similar: &[(String, String, f64)]) -> String {
    let width = rows.iter().map(|row| row.submission.chars().count()).max().unwrap_or(0).min(40);
    let mut text = String::new();
    for row in rows {
        let (word, style) = match row.verdict {
            Outcome::Correct => ("correct", GREEN),
            Outcome::Wrong => ("wrong", RED),
            Outcome::DoesNotCompile => ("broken", RED),
            Outcome::Unsure => ("unsure", YELLOW),
        };
        let ids: Vec<&str> = row.mistakes.iter().map(|mistake| mistake.id.as_str()).collect();
        let what = match (row.verdict, ids.is_empty()) {
            (Outcome::Correct, _) => String::new(),
            (_, true) => row.summary.lines().next().unwrap_or_default().to_owned(),
            (_, false) => ids.join(" "),
        };
        let place = row.place.as_deref().map_or(String::new(), |place| format!("  {DIM}{place}{DIM:#}"));
        let _ = writeln!(text, "{:<width$}  {style}{word:<8}{style:#}  {what}{place}", row.submission);
    }
    let count = |outcome| rows.iter().filter(|row| row.verdict == outcome).count();
    let _ = writeln!(
        text,
        "\n{} submissions: {} correct, {} wrong, {} do not compile, {} unsure",
        rows.len(),
        count(Outcome::Correct),
        count(Outcome::Wrong),
        count(Outcome::DoesNotCompile),
        count(Outcome::Unsure)
    );
    for (a, b, share) in similar {
        let _ = writeln!(text, "{YELLOW}alike{YELLOW:#}: {a} and {b}, {:.0} %", 100.0 * share);
    }
    text
}
