//! The overview page of a batch, for the teacher.

use super::html::{Icon, document, page_address};
use super::table::Row;
use super::text::{count, escaped_line, line, percent, percent_of, word, words};
use gonio_check::verdict::Outcome;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// The overview of a batch as one HTML file that loads and runs nothing: the number of each verdict and mistake, similar
/// submissions, and all submissions by name, with links to their pages ([`super::page_name`]) in the same folder. `similar` are
/// pairs of labels with their similarity, as from [`super::similar_pairs`]; `skipped` has a line for each entry that belongs to
/// no submission.
pub fn overview(title: &str, rows: &[Row], similar: &[(String, String, f64)], skipped: &[String]) -> String {
    let mut rows: Vec<&Row> = rows.iter().collect();
    rows.sort_by(|a, b| by_name(&a.submission, &b.submission).then_with(|| a.exercise.cmp(&b.exercise)));
    let exercises: BTreeSet<&str> = rows.iter().map(|row| row.exercise.as_str()).collect();
    let mut over = exercises.iter().map(|word| escaped_line(word)).collect::<Vec<_>>().join(", ");
    let _ =
        write!(over, "{}{}", if over.is_empty() { "" } else { " · " }, count(rows.len(), "submission", "submissions"));
    let mut body = format!("<header>\n<p class=\"over\">{over}</p>\n<h1>{}</h1>\n</header>\n", escaped_line(title));
    body.push_str(&verdicts(&rows));
    body.push_str(&mistakes(&rows));
    body.push_str(&pairs(similar, &rows));
    body.push_str(&all(&rows, exercises.len() > 1));
    body.push_str(&not_checked(skipped));
    body.push_str("<footer><p>Checked by gonio.</p></footer>\n");
    document(title, &body)
}

/// Compares names without case, and with numbers by value: `group 9` comes before `group 10`.
fn by_name(a: &str, b: &str) -> std::cmp::Ordering {
    let key = |name: &str| {
        let mut key: Vec<(String, u64)> = Vec::new();
        let (mut word, mut number) = (String::new(), None::<u64>);
        for c in name.to_lowercase().chars() {
            match (c.to_digit(10), number) {
                (Some(digit), known) => {
                    number = Some(known.unwrap_or(0).saturating_mul(10).saturating_add(u64::from(digit)));
                }
                (None, Some(known)) => {
                    key.push((std::mem::take(&mut word), known));
                    number = None;
                    word.push(c);
                }
                (None, None) => word.push(c),
            }
        }
        key.push((word, number.unwrap_or(0)));
        key
    };
    key(a).cmp(&key(b)).then_with(|| a.cmp(b))
}

fn bar(share: f64) -> String {
    format!("<span class=\"track\"><span style=\"width: {:.1}%\"></span></span>", share.clamp(0.0, 1.0) * 100.0)
}

fn verdicts(rows: &[&Row]) -> String {
    let mut html = String::from("<section>\n<h2>Verdicts</h2>\n<ul class=\"counts\">\n");
    for outcome in [Outcome::Correct, Outcome::Wrong, Outcome::DoesNotCompile, Outcome::Unsure] {
        let number = rows.iter().filter(|row| row.verdict == outcome).count();
        let share = number as f64 / rows.len().max(1) as f64;
        // The style gives every bar a minimum width.
        let bar = if number > 0 { bar(share) } else { "<span class=\"track\"></span>".to_owned() };
        let _ = writeln!(
            html,
            "<li class=\"{}\"><span class=\"name\">{}<span>{}</span></span>{bar}<span class=\"count\">{number} \
             <small>{}</small></span></li>",
            word(outcome),
            Icon::for_outcome(outcome).svg(),
            words(outcome),
            percent_of(number, rows.len())
        );
    }
    html.push_str("</ul>\n</section>\n");
    html
}

fn mistakes(rows: &[&Row]) -> String {
    // A submission counts once per mistake.
    let mut known: BTreeMap<&str, (&str, BTreeSet<&str>)> = BTreeMap::new();
    for row in rows {
        for mistake in &row.mistakes {
            known.entry(&mistake.id).or_insert((&mistake.name, BTreeSet::new())).1.insert(&row.submission);
        }
    }
    if known.is_empty() {
        return String::new();
    }
    let mut sorted: Vec<(&str, &str, usize)> = known.iter().map(|(id, (name, who))| (*id, *name, who.len())).collect();
    sorted.sort_by(|a, b| b.2.cmp(&a.2).then_with(|| a.0.cmp(b.0)));
    let most = sorted.first().map_or(1, |(.., number)| *number).max(1);
    let mut html = String::from("<section>\n<h2>Mistakes</h2>\n<ul class=\"bars\">\n");
    for (id, name, number) in sorted {
        let _ = writeln!(
            html,
            "<li><span class=\"name\">{} <code>{}</code></span>{}<span class=\"count\">{number} \
             <small>{}</small></span></li>",
            super::html::prose(name),
            escaped_line(id),
            bar(number as f64 / most as f64),
            percent_of(number, rows.len())
        );
    }
    html.push_str("</ul>\n</section>\n");
    html
}

fn link(label: &str) -> String {
    let shown = match line(label).is_empty() {
        true => "(no name)".to_owned(),
        false => escaped_line(label),
    };
    format!("<a href=\"{}\">{shown}</a>", escaped_line(&page_address(label)))
}

fn pairs(similar: &[(String, String, f64)], rows: &[&Row]) -> String {
    if similar.is_empty() {
        return String::new();
    }
    let mut similar: Vec<&(String, String, f64)> = similar.iter().collect();
    similar.sort_by(|a, b| b.2.total_cmp(&a.2).then_with(|| by_name(&a.0, &b.0)).then_with(|| by_name(&a.1, &b.1)));
    let verdict = |label: &str| rows.iter().find(|row| row.submission == label).map_or("", |row| words(row.verdict));
    let mut html = String::from(
        "<section class=\"pairs\">\n<h2>Similar submissions</h2>\n<table>\n<thead><tr><th scope=\"col\">One</th><th scope=\"col\">Other</th>\
         <th scope=\"col\" class=\"share\">The same</th></tr></thead>\n<tbody>\n",
    );
    for (a, b, share) in similar {
        let cell = |label: &str| format!("<td>{} <span class=\"place\">{}</span></td>", link(label), verdict(label));
        let _ = writeln!(html, "<tr>{}{}<td class=\"share\">{}</td></tr>", cell(a), cell(b), percent(*share));
    }
    html.push_str(
        "</tbody>\n</table>\n<p class=\"hint\">The share of both that is the same, ignoring layout, comments, \
         names and the start files. It is a reason to look, not a proof: short right answers are \
         similar.</p>\n</section>\n",
    );
    html
}

fn all(rows: &[&Row], with_exercise: bool) -> String {
    let exercise = if with_exercise { "<th scope=\"col\">Exercise</th>" } else { "" };
    let mut html = format!(
        "<section class=\"all\">\n<h2>Submissions</h2>\n<table>\n<thead><tr><th scope=\"col\">Name</th>{exercise}<th scope=\"col\">Verdict</th>\
         <th scope=\"col\" class=\"share\">Score</th><th scope=\"col\">What</th><th scope=\"col\" \
                     class=\"seconds\">Time</th></tr></thead>\n<tbody>\n"
    );
    for row in rows {
        let _ = write!(html, "<tr><th scope=\"row\">{}</th>", link(&row.submission));
        if with_exercise {
            let _ = write!(html, "<td>{}</td>", escaped_line(&row.exercise));
        }
        let seconds = if row.seconds.is_finite() { row.seconds.max(0.0) } else { 0.0 };
        let _ = writeln!(
            html,
            "<td><span class=\"outcome {}\">{}<span>{}</span></span></td><td class=\"share\">{}</td><td \
             class=\"what\">{}</td><td class=\"seconds\">{seconds:.1} s</td></tr>",
            word(row.verdict),
            Icon::for_outcome(row.verdict).svg(),
            words(row.verdict),
            percent(row.score),
            what(row)
        );
    }
    html.push_str("</tbody>\n</table>\n</section>\n");
    html
}

fn not_checked(skipped: &[String]) -> String {
    if skipped.is_empty() {
        return String::new();
    }
    let items: String = skipped.iter().map(|entry| format!("<li>{}</li>\n", escaped_line(entry))).collect();
    format!("<section>\n<h2>Not checked</h2>\n<ul class=\"notes\">\n{items}</ul>\n</section>\n")
}

/// The mistakes, summary and warnings of a submission, for a cell.
fn what(row: &Row) -> String {
    let place = |place: &Option<String>| {
        place
            .as_deref()
            .map_or_else(String::new, |place| format!(" <span class=\"place\">{}</span>", escaped_line(place)))
    };
    let mut items: Vec<String> = row
        .mistakes
        .iter()
        .map(|mistake| format!("<li>{}{}</li>", super::html::prose(&mistake.name), place(&mistake.place)))
        .collect();
    if items.is_empty() && row.verdict != Outcome::Correct {
        items.push(format!("<li>{}{}</li>", super::html::prose(&row.summary), place(&row.place)));
    }
    if !row.warnings.is_empty() {
        items.push(format!("<li class=\"place\">{}</li>", count(row.warnings.len(), "warning", "warnings")));
    }
    if items.is_empty() { String::new() } else { format!("<ul>{}</ul>", items.concat()) }
}
