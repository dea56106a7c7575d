//! A batch as a table.

use super::text::{is_hidden, line, name, place, plain, points, unit, word};
use super::thumbnail::SubmissionThumbnail;
use gonio_check::verdict::{Outcome, Verdict};
use serde::{Deserialize, Serialize};

/// A submission in a batch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its label, which is the folder's name.
    pub submission: String,
    /// The exercise's id.
    pub exercise: String,
    /// The outcome of a check.
    pub verdict: Outcome,
    /// The result in one sentence.
    pub summary: String,
    /// The score, from 0 to 1.
    pub score: f64,
    /// The mistakes.
    pub mistakes: Vec<RowMistake>,
    /// The place to look first, `file:line`: of the first mistake that has a place, or of the compiler's first message.
    pub place: Option<String>,
    /// Problems that may occur on other drivers.
    pub warnings: Vec<String>,
    /// Names of peculiarities that are right but worth knowing.
    #[serde(default)]
    pub peculiarities: Vec<String>,
    /// The duration of the check, in seconds.
    pub seconds: f64,
    /// The picture for the overview.
    #[serde(skip)]
    pub thumbnail: Option<SubmissionThumbnail>,
}

/// A mistake of a submission in a batch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowMistake {
    /// The mistake's id in the catalogue.
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The share of the difference that it explains, 0 to 1.
    pub share_explained: f64,
    /// Its place, `file:line` or `file`, if it was found.
    pub place: Option<String>,
}

impl Row {
    /// The row of a submission.
    pub fn new(label: &str, verdict: &Verdict, seconds: f64) -> Self {
        let mistake = |mistake: &gonio_check::verdict::FoundMistake| RowMistake {
            id: mistake.id.clone(),
            name: mistake.name.clone(),
            share_explained: mistake.share_explained,
            place: place(mistake.file.as_deref(), mistake.line),
        };
        let mistakes: Vec<RowMistake> = verdict.mistakes.iter().map(mistake).collect();
        Row {
            submission: label.to_owned(),
            exercise: verdict.exercise.clone(),
            verdict: verdict.verdict,
            summary: verdict.summary.clone(),
            score: verdict.score,
            place: mistakes.iter().find_map(|mistake| mistake.place.clone()).or_else(|| {
                let message = verdict.messages.first()?;
                place(Some(&message.file), message.line)
            }),
            mistakes,
            warnings: verdict.warnings.clone(),
            peculiarities: verdict.peculiarities.iter().map(|known| known.name.clone()).collect(),
            seconds,
            thumbnail: None,
        }
    }

    /// Adds the picture for the overview.
    #[must_use]
    pub fn with_thumbnail(self, thumbnail: Option<SubmissionThumbnail>) -> Self {
        Row { thumbnail, ..self }
    }

    /// The number of the finding that [`Row::place`] belongs to, from 0: mistakes first, then messages of the compiler.
    pub(super) fn finding(&self) -> Option<usize> {
        self.place.as_ref()?;
        let of_mistake = self.mistakes.iter().position(|mistake| mistake.place.is_some());
        Some(of_mistake.unwrap_or(self.mistakes.len()))
    }

    /// Why the submission is not correct: the place and name of each mistake, or the summary; empty for a correct one.
    fn reason(&self) -> String {
        if self.verdict == Outcome::Correct {
            return String::new();
        }
        let at = |place: Option<&String>, sentence: &str| match place {
            Some(place) => format!("{}: {}", line(place), line(sentence)),
            None => line(sentence),
        };
        match self.mistakes.as_slice() {
            [] => at(self.place.as_ref(), &self.summary),
            mistakes => {
                let each = mistakes.iter().map(|mistake| at(mistake.place.as_ref(), &mistake.name));
                each.collect::<Vec<_>>().join("; ")
            }
        }
    }
}

/// The columns of [`csv`].
const COLUMNS: [&str; 13] = [
    "name",
    "verdict",
    "points",
    "of_points",
    "mistakes",
    "reason",
    "exercise",
    "score",
    "ids",
    "shares",
    "places",
    "warnings",
    "seconds",
];

/// A table for spreadsheets: RFC 4180 (cells with commas, quotes or line breaks in quotes, quotes doubled, lines end with CR
/// LF), UTF-8 with a header and a byte order mark, without which Excel reads names such as `José` in the encoding of the
/// system.
///
/// `name` is the submission's name as it is; control characters and marks that reorder text are written as escapes (`\x1b`).
/// `points` are the verdict's share of `most_points`, which `of_points` repeats. `mistakes` are titles, separated by `; `; `reason`
/// is the place and the sentence of each. The columns after them are for programs: `score` is from 0 to 1; `ids`, `shares` and
/// `places` have one word per mistake, in the same order; an unknown place is `?`, and spaces in a place are `_`. Without mistakes,
/// `places` is that of the compiler's first message, if there is one. Warnings are separated by `; `.
///
/// Spreadsheets run a text that begins with `=`, `+`, `-`, `@`, a tab or a line break as a formula: an apostrophe is put in front
/// of it, so that a submission named `=cmd` is written as `'=cmd`.
pub fn csv(rows: &[Row], most_points: f64) -> String {
    let mut table = format!("\u{feff}{}\r\n", COLUMNS.join(","));
    for row in rows {
        let words = |word: &dyn Fn(&RowMistake) -> String| {
            row.mistakes.iter().map(|mistake| word(mistake).replace(' ', "_")).collect::<Vec<_>>().join(" ")
        };
        let places = words(&|mistake| mistake.place.as_deref().map_or_else(|| "?".to_owned(), line));
        let titles: Vec<String> = row.mistakes.iter().map(|mistake| line(&mistake.name)).collect();
        let seconds = if row.seconds.is_finite() { row.seconds.max(0.0) } else { 0.0 };
        let cells = [
            name_cell(&row.submission),
            cell(word(row.verdict)),
            points(row.score, most_points).to_string(),
            points(1.0, most_points).to_string(),
            cell(&titles.join("; ")),
            cell(&row.reason()),
            cell(&row.exercise),
            format!("{:.4}", unit(row.score)),
            cell(&words(&|mistake| line(&mistake.id))),
            cell(&words(&|mistake| format!("{:.4}", unit(mistake.share_explained)))),
            cell(&if row.mistakes.is_empty() { row.place.clone().unwrap_or_default() } else { places }),
            cell(&row.warnings.iter().map(|warning| line(warning)).collect::<Vec<_>>().join("; ")),
            format!("{seconds:.3}"),
        ];
        table.push_str(&cells.join(","));
        table.push_str("\r\n");
    }
    table
}

/// A text as a cell.
fn cell(text: &str) -> String {
    quoted(text, plain(text))
}

/// A submission's name as a cell.
fn name_cell(text: &str) -> String {
    quoted(text, name(text))
}

/// The cell that shows `shown` for `text`.
fn quoted(text: &str, shown: String) -> String {
    // A spreadsheet skips spaces and characters without width.
    let begins = text.trim_start_matches(|c: char| c == ' ' || (is_hidden(c) && !matches!(c, '\t' | '\r' | '\n')));
    let is_formula = begins.starts_with(['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠']);
    let text = if is_formula { format!("'{shown}") } else { shown };
    match text.contains([',', ';', '"', '\n', '\t']) || text.starts_with(' ') || text.ends_with(' ') {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}
