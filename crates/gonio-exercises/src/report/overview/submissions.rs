//! The table of submissions.

use super::OUTCOMES;
use crate::report::address::{finding_anchor, page_address};
use crate::report::html::{Icon, MOST_SHOWN, capital, prose};
use crate::report::navigation::shown_name;
use crate::report::table::Row;
use crate::report::text::{by_name, escaped_line, line, percent, points, word, words};
use crate::report::thumbnail::SubmissionThumbnail;
use gonio_check::verdict::Outcome;
use gonio_language::tr;
use std::fmt::Write as _;

/// Side of a picture in CSS pixels: twice that of a test scene.
const SIDE: u32 = 2 * gonio_check::testbench::TILE;

/// The id of a row, by its number in the order of names.
pub fn row_anchor(number: usize) -> String {
    format!("submission-{}", number + 1)
}

/// A link to a submission's page.
pub fn link(label: &str) -> String {
    format!("<a href=\"{}\">{}</a>", page_address(label), shown_name(label))
}

/// The table of submissions, which are sorted by name. Each cell has a number by which the script sorts its column. Elements have
/// explicit roles: on narrow pages the cells are laid out differently, and browsers no longer expose a table.
pub fn table(rows: &[&Row], most_points: f64, has_scheme: bool) -> String {
    let with_exercise = rows.iter().any(|row| row.exercise != rows[0].exercise);
    let most = points(1.0, most_points);
    let heading = |class: &str, sort: &str, words: &str| {
        format!("<th role=\"columnheader\" scope=\"col\" class=\"{class}\" aria-sort=\"{sort}\">{words}</th>")
    };
    let mut html = format!("<section class=\"all\">\n<h2>{}</h2>\n", tr!("report-submissions"));
    let _ = writeln!(
        html,
        "<p class=\"filter\" hidden><label for=\"filter\">{}</label><input id=\"filter\" type=\"search\" \
         autocomplete=\"off\" spellcheck=\"false\"><span role=\"status\" data-shown=\"{}\"></span></p>",
        tr!("report-filter"),
        tr!("report-filtered")
    );
    html.push_str("<table role=\"table\">\n<thead role=\"rowgroup\"><tr role=\"row\">");
    html.push_str(&heading("pictures", "none", tr!("report-column-picture")));
    html.push_str(&heading("name", "ascending", tr!("report-column-name")));
    if with_exercise {
        html.push_str(&heading("exercise", "none", tr!("report-column-exercise")));
    }
    html.push_str(&heading("verdict-of", "none", tr!("report-column-verdict")));
    let of_most = tr!("report-of-points", most = most.to_string());
    let points_heading = format!("{} <small>{of_most}</small>", tr!("report-column-points"));
    html.push_str(&heading("points", "none", &points_heading));
    html.push_str(&heading("place", "none", tr!("report-column-first-finding")));
    html.push_str("</tr></thead>\n<tbody role=\"rowgroup\">\n");
    let verdicts = ranks(rows, |row| {
        let title = row.mistakes.first().map_or_else(|| line(&row.summary), |mistake| line(&mistake.name));
        (OUTCOMES.iter().position(|outcome| *outcome == row.verdict), title)
    });
    let places = place_ranks(rows);
    for (number, row) in rows.iter().enumerate() {
        let _ = write!(html, "<tr role=\"row\" id=\"{}\">{}", row_anchor(number), pictures(row));
        let _ = write!(
            html,
            "<th role=\"rowheader\" scope=\"row\" class=\"name\" data-key=\"{number}\">{}</th>",
            link(&row.submission)
        );
        if with_exercise {
            let _ = write!(
                html,
                "<td role=\"cell\" class=\"exercise\" data-key=\"{number}\">{}</td>",
                escaped_line(&row.exercise)
            );
        }
        let own = points(row.score, most_points);
        let _ = writeln!(
            html,
            "<td role=\"cell\" class=\"verdict-of\" data-key=\"{}\">{}</td><td role=\"cell\" class=\"points\" \
             data-key=\"{own}\">{own}<small> {of_most}</small></td><td role=\"cell\" class=\"place\" \
             data-key=\"{}\">{}</td></tr>",
            verdicts[number],
            verdict(row),
            places[number],
            place(row)
        );
    }
    let _ = write!(
        html,
        "</tbody>\n</table>\n<p class=\"hint\">{}</p>\n</section>\n",
        match has_scheme {
            true => tr!("report-points-hint-of-course", most = most.to_string()),
            false => tr!("report-points-hint", most = most.to_string()),
        }
    );
    html
}

/// The rank of each row by a key; equal keys have equal ranks.
fn ranks<K: Ord>(rows: &[&Row], key: impl Fn(&Row) -> K) -> Vec<usize> {
    let keys: Vec<K> = rows.iter().map(|row| key(row)).collect();
    let mut sorted: Vec<&K> = keys.iter().collect();
    sorted.sort();
    sorted.dedup();
    keys.iter().map(|key| sorted.partition_point(|other| *other < key)).collect()
}

/// The rank of each row by its place, with lines in the order of their numbers; rows without a place come last.
fn place_ranks(rows: &[&Row]) -> Vec<usize> {
    let mut sorted: Vec<&str> = rows.iter().filter_map(|row| row.place.as_deref()).collect();
    sorted.sort_by(|a, b| by_name(a, b));
    let rank = |place: &str| sorted.iter().position(|other| *other == place);
    rows.iter().map(|row| row.place.as_deref().and_then(rank).unwrap_or(sorted.len())).collect()
}

fn pictures(row: &Row) -> String {
    let Some(SubmissionThumbnail { scene, yours, reference, pixels_beyond }) = &row.thumbnail else {
        return "<td role=\"cell\" class=\"pictures\" data-key=\"-1\"></td>".to_owned();
    };
    let scene = escaped_line(&gonio_check::testbench::scene::title(scene));
    let image = |what: &str, uri: &str| {
        format!(
            "<img alt=\"{what}, {scene}\" title=\"{what}, {scene}\" width=\"{SIDE}\" height=\"{SIDE}\" src=\"{}\">",
            escaped_line(uri)
        )
    };
    let mut images = image(tr!("report-submitted"), yours);
    let mut remark = String::new();
    if let Some(reference) = reference {
        images.push_str(&image(tr!("report-correct-picture"), reference));
        remark = format!("<small>{}</small>", tr!("report-of-pixels-differ", percent = percent(*pixels_beyond)));
    }
    format!("<td role=\"cell\" class=\"pictures\" data-key=\"{pixels_beyond}\"><div>{images}</div>{remark}</td>")
}

/// The verdict in words, with the titles of the mistakes.
fn verdict(row: &Row) -> String {
    let mut html = format!(
        "<span class=\"outcome {}\">{}<span>{}</span></span>",
        word(row.verdict),
        Icon::for_outcome(row.verdict).svg(),
        match (row.verdict, row.peculiarities.is_empty()) {
            (Outcome::Correct, false) => tr!("report-heading-other-method").to_owned(),
            (outcome, _) => capital(words(outcome)),
        }
    );
    let mut items: Vec<String> = row
        .mistakes
        .iter()
        .take(MOST_SHOWN)
        .map(|mistake| format!("<li>{} <small>{}</small></li>", prose(&mistake.name), escaped_line(&mistake.id)))
        .collect();
    if items.is_empty() && row.verdict != Outcome::Correct {
        items.push(format!("<li>{}</li>", prose(&row.summary)));
    }
    if row.verdict == Outcome::Correct {
        items.extend(
            row.peculiarities.iter().take(MOST_SHOWN).map(|name| format!("<li class=\"soft\">{}</li>", prose(name))),
        );
    }
    if !row.warnings.is_empty() {
        items.push(format!("<li class=\"soft\">{}</li>", tr!("report-count-warnings", count = row.warnings.len())));
    }
    if !items.is_empty() {
        let _ = write!(html, "<ul>{}</ul>", items.concat());
    }
    html
}

/// The place of the first finding, as a link to it.
fn place(row: &Row) -> String {
    let (Some(place), Some(finding)) = (&row.place, row.finding()) else { return String::new() };
    let place = escaped_line(place);
    match finding < MOST_SHOWN {
        true => format!("<a href=\"{}#{}\">{place}</a>", page_address(&row.submission), finding_anchor(finding)),
        false => place,
    }
}
