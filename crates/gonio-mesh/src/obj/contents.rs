//! Reports on the file as a whole: its contents and its oddities.

use super::attributes::Attributes;
use super::statistics::{MOST_COUNTED, NAMES, Statistics};
use crate::Diagnostic;
use crate::report::Reports;

/// Lists the non-zero counts under the format's own names.
pub(super) fn list(attributes: &Attributes, statistics: &Statistics) -> Vec<(String, u64)> {
    let mut contents: Vec<(String, u64)> = Vec::new();
    let mut add = |name: String, count: u64| {
        if count > 0 {
            contents.push((name, count));
        }
    };
    for (name, count) in ["v", "vt", "vn"].iter().zip(attributes.counts()) {
        add((*name).to_owned(), count);
    }
    add("v with a color".to_owned(), attributes.colored);
    for (corners, count) in statistics.faces.iter().enumerate() {
        let or_more = if corners > MOST_COUNTED { " or more" } else { "" };
        add(format!("f of {corners}{or_more} corners"), *count);
    }
    add("f left out".to_owned(), statistics.lost);
    for keyword in ["l", "p"] {
        add(keyword.to_owned(), statistics.tallies.count_of(keyword.as_bytes()));
    }
    for (name, count) in NAMES.iter().zip(statistics.names) {
        add((*name).to_owned(), count);
    }
    contents
}

/// Reports oddities of the file as a whole.
pub(super) fn report(attributes: &Attributes, statistics: &Statistics, reports: &mut Reports) {
    statistics.tallies.report(reports);
    if let Some(line) = attributes.weighted {
        reports.note(line, "the weights (w) of vertices are ignored: they only matter to free-form curves");
    }
    let total = attributes.positions.len() as u64;
    let lacking = total - attributes.colored;
    if attributes.colored > 0 && lacking > 0 {
        at_end(reports, format!("{lacking} of {total} vertices have no color: using white"));
    }
    for (line, what) in statistics.without_any.iter().zip(["texture coordinates (vt)", "normals (vn)"]) {
        if let Some(line) = *line {
            reports.warning(line, format!("faces refer to {what}, but the file has none"));
        }
    }
    let (total, consequences) =
        (statistics.corners(), ["texture coordinate: using (0, 0)", "normal: using averaged normals"]);
    for ((lacking, line), consequence) in statistics.without.into_iter().zip(consequences) {
        // If all corners lack it, the file simply has none.
        if lacking > 0 && lacking < total {
            reports.warning(line, format!("{lacking} of {total} corners of faces have no {consequence}"));
        }
    }
    let [not_simple, too_large] = statistics.cuts;
    if not_simple > 0 {
        at_end(reports, format!("{not_simple} polygons cross or touch themselves: their triangles are guessed"));
    }
    if too_large > 0 {
        at_end(reports, format!("{too_large} polygons are too large or complex: triangulated as if convex"));
    }
}

fn at_end(reports: &mut Reports, message: String) {
    reports.push(u64::MAX, Diagnostic::warning(message));
}
