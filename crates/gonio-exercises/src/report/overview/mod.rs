//! The overview page of a batch, for the teacher.

mod groups;
mod submissions;

use super::html::{Icon, PageKind, document};
use super::similarity::SimilarGroup;
use super::table::Row;
use super::text::{by_name, escaped_line, line, word, words};
use gonio_check::verdict::Outcome;
use gonio_language::tr;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// All outcomes in the order of reports.
const OUTCOMES: [Outcome; 4] = [Outcome::Correct, Outcome::Wrong, Outcome::DoesNotCompile, Outcome::Unsure];

/// The script that sorts and filters the table of submissions.
pub const SCRIPT: &str = include_str!("../overview.js");

/// A batch for its overview.
pub struct Overview<'a> {
    /// The title, plain text.
    pub title: &'a str,
    /// The submissions, in any order.
    pub rows: &'a [Row],
    /// Similar submissions, as from [`super::similar_groups`].
    pub similar: &'a [SimilarGroup],
    /// A line for each entry that belongs to no submission.
    pub skipped: &'a [String],
    /// Points for a correct answer.
    pub most_points: f64,
    /// Whether a teacher states what mistakes cost.
    pub has_scheme: bool,
}

/// The overview of a batch as one HTML file: the number of each verdict, all submissions by name with a picture, the verdict and
/// points, and links to their pages ([`super::page_name`]) in the same folder; then each mistake with the submissions that make it,
/// the entries that belong to no submission, and groups of similar submissions. The file loads nothing; a script of its own sorts
/// and filters the table, which is complete without it.
pub fn overview(batch: &Overview<'_>) -> String {
    let mut rows: Vec<&Row> = batch.rows.iter().collect();
    rows.sort_by(|a, b| by_name(&a.submission, &b.submission).then_with(|| a.exercise.cmp(&b.exercise)));
    let exercises: BTreeSet<&str> = rows.iter().map(|row| row.exercise.as_str()).collect();
    let over = exercises.into_iter().map(line).collect::<Vec<_>>().join(", ");
    let mut body = format!(
        "<header>\n<p class=\"over\">{}</p>\n<h1>{}</h1>\n</header>\n",
        escaped_line(&over),
        escaped_line(batch.title)
    );
    body.push_str(&headline(&rows));
    body.push_str(&submissions::table(&rows, batch.most_points, batch.has_scheme));
    body.push_str(&groups::mistakes(&rows));
    body.push_str(&not_checked(batch.skipped));
    body.push_str(&groups::similar(batch.similar, &rows));
    let _ = writeln!(body, "<footer><p>{}</p></footer>", tr!("report-checked-by-gonio"));
    document(
        &format!("{over}: {}", line(batch.title)),
        PageKind { style: include_str!("../overview.css"), script: Some(SCRIPT) },
        &body,
    )
}

/// The number of submissions and of each verdict.
fn headline(rows: &[&Row]) -> String {
    let mut html =
        format!("<ul class=\"counts\">\n<li><b>{}</b></li>\n", tr!("report-count-submissions", count = rows.len()));
    for outcome in OUTCOMES {
        let number = rows.iter().filter(|row| row.verdict == outcome).count();
        if number > 0 || outcome == Outcome::Correct {
            let words = match (outcome, number) {
                (Outcome::DoesNotCompile, 2..) => tr!("report-do-not-compile"),
                (outcome, _) => words(outcome),
            };
            let icon = Icon::for_outcome(outcome).svg();
            let _ = writeln!(html, "<li class=\"outcome {}\">{icon}<span>{number} {words}</span></li>", word(outcome));
        }
    }
    html.push_str("</ul>\n");
    html
}

fn not_checked(skipped: &[String]) -> String {
    if skipped.is_empty() {
        return String::new();
    }
    let items: String = skipped.iter().map(|entry| format!("<li>{}</li>\n", escaped_line(entry))).collect();
    let heading = tr!("report-not-checked");
    format!("<section>\n<h2>{heading}</h2>\n<ul class=\"notes\">\n{items}</ul>\n</section>\n")
}
