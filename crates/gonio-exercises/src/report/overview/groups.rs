//! Submissions with the same mistake, and similar submissions.

use super::submissions::{link, row_anchor};
use crate::report::html::{prose, shown};
use crate::report::navigation::shown_name;
use crate::report::similarity::SimilarGroup;
use crate::report::table::Row;
use crate::report::text::{by_name, count, escaped_line, percent, percent_of, words};
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
    let mut html = String::from("<section>\n<h2>Mistakes</h2>\n<ul class=\"bars\">\n");
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
    let mut html = String::from(
        "<section class=\"similar\">\n<h2>Similar submissions</h2>\n<p class=\"hint\">Layout, comments, names and the start files are \
         ignored. Similarity is a reason to look, not a proof: short right answers are similar.</p>\n",
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
            format!("<li>{} and {}: {}</li>\n", shown_name(a), shown_name(b), percent(*share))
        };
        let pairs = shown(&pairs, pair, |more| format!("<li>And {}.</li>\n", count(more, "more pair", "more pairs")));
        let _ = write!(
            html,
            "<article>\n<h3>{}, up to {} the same</h3>\n<ul class=\"names\">\n{members}</ul>\n<details><summary>{}</summary>\n\
             <ul class=\"pairs\">\n{pairs}</ul></details>\n</article>\n",
            count(group.members.len(), "submission", "submissions"),
            percent(group.highest()),
            count(group.pairs.len(), "similar pair", "similar pairs"),
        );
    }
    html.push_str("</section>\n");
    html
}
