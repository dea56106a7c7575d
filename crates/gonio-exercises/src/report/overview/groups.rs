//! Submissions with the same mistake, and similar submissions.

use super::submissions::{link, row_anchor};
use crate::report::html::{prose, shown};
use crate::report::navigation::shown_name;
use crate::report::similarity::SimilarGroup;
use crate::report::table::Row;
use crate::report::text::{by_name, escaped_line, percent, percent_of, words};
use gonio_language::tr;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Each mistake with the submissions that make it, the most frequent first.
pub fn mistakes(rows: &[&Row]) -> String {
    // A submission counts once per mistake.
    let mut known: BTreeMap<&str, (&str, BTreeSet<usize>)> = BTreeMap::new();
    for (number, row) in rows.iter().enumerate() {
        for mistake in &row.mistakes {
            known.entry(&mistake.id).or_insert((&mistake.name, BTreeSet::new())).1.insert(number);
        }
    }
    if known.is_empty() {
        return String::new();
    }
    let mut sorted: Vec<(&str, &str, BTreeSet<usize>)> =
        known.into_iter().map(|(id, (name, who))| (id, name, who)).collect();
    sorted.sort_by(|a, b| b.2.len().cmp(&a.2.len()).then_with(|| a.0.cmp(b.0)));
    let mut html = format!("<section>\n<h2>{}</h2>\n<ul class=\"bars\">\n", tr!("report-mistakes"));
    for (id, name, who) in sorted {
        let share = 100.0 * who.len() as f64 / rows.len().max(1) as f64;
        let links: Vec<String> = who
            .iter()
            .map(|number| {
                format!("<li><a href=\"#{}\">{}</a></li>", row_anchor(*number), shown_name(&rows[*number].submission))
            })
            .collect();
        let _ = writeln!(
            html,
            "<li><details><summary><span class=\"name\">{} <small>{}</small></span><span class=\"track\"><span style=\"width: \
             {share:.1}%\"></span></span><span class=\"count\">{} <small>{}</small></span></summary>\n<ul \
             class=\"names\">{}</ul></details></li>",
            prose(name),
            escaped_line(id),
            who.len(),
            percent_of(who.len(), rows.len()),
            links.concat()
        );
    }
    html.push_str("</ul>\n</section>\n");
    html
}

/// Groups of similar submissions.
pub fn similar(groups: &[SimilarGroup], rows: &[&Row]) -> String {
    if groups.is_empty() {
        return String::new();
    }
    let verdict = |label: &str| rows.iter().find(|row| row.submission == label).map_or("", |row| words(row.verdict));
    let mut html = format!(
        "<section class=\"similar\">\n<h2>{}</h2>\n<p class=\"hint\">{}</p>\n",
        tr!("report-similar-submissions"),
        tr!("report-similarity-hint")
    );
    for group in groups {
        let members: String = group
            .members
            .iter()
            .map(|label| format!("<li>{} <small>{}</small></li>\n", link(label), verdict(label)))
            .collect();
        let mut pairs: Vec<&(String, String, f64)> = group.pairs.iter().collect();
        pairs.sort_by(|a, b| b.2.total_cmp(&a.2).then_with(|| by_name(&a.0, &b.0)).then_with(|| by_name(&a.1, &b.1)));
        let pair = |(a, b, share): &&(String, String, f64)| {
            let (first, second, percent) = (shown_name(a), shown_name(b), percent(*share));
            format!("<li>{}</li>\n", tr!("report-pair", first = first, second = second, percent = percent))
        };
        let pairs = shown(&pairs, pair, |more| format!("<li>{}</li>\n", tr!("report-and-more-pairs", count = more)));
        let _ = write!(
            html,
            "<article>\n<h3>{}</h3>\n<ul class=\"names\">\n{members}</ul>\n<details><summary>{}</summary>\n\
             <ul class=\"pairs\">\n{pairs}</ul></details>\n</article>\n",
            tr!(
                "report-similar-group",
                submissions = tr!("report-count-submissions", count = group.members.len()),
                percent = percent(group.highest())
            ),
            tr!("report-count-similar-pairs", count = group.pairs.len()),
        );
    }
    html.push_str("</section>\n");
    html
}
