//! Links between the pages of a class.

use super::address::{OVERVIEW, page_address};
use super::text::{by_name, escaped_name};
use gonio_language::tr;

/// The start of the navigation, directly after that of a page's content.
const START: &str = "<main>\n";
const OPEN: &str = "<nav class=\"class\" aria-label=\"";
const CLOSE: &str = "</nav>\n";

/// Sorts labels as the overview lists them: without case, numbers by value.
pub fn in_page_order(labels: &mut [&str]) {
    labels.sort_by(|a, b| by_name(a, b));
}

/// The page of a submission with links to the overview and to the pages before and after it. Links from an earlier call are
/// replaced; a text that is not a page of a submission is unchanged.
pub fn with_neighbours(page: &str, before: Option<&str>, after: Option<&str>) -> String {
    let Some((head, content)) = page.split_once(START) else { return page.to_owned() };
    let content = match content.strip_prefix(OPEN).and_then(|rest| rest.split_once(CLOSE)) {
        Some((_, content)) => content,
        None => content,
    };
    let link = |label: Option<&str>, relation: &str, arrows: [&str; 2]| {
        label.map_or_else(
            || "<span></span>".to_owned(),
            |label| {
                let (address, name) = (page_address(label), shown_name(label));
                let [left, right] = arrows;
                format!("<a rel=\"{relation}\" href=\"{address}\">{left}<span>{name}</span>{right}</a>")
            },
        )
    };
    let before = link(before, "prev", ["← ", ""]);
    let after = link(after, "next", ["", " →"]);
    let (class, all) = (tr!("report-class"), tr!("report-all-submissions"));
    format!("{head}{START}{OPEN}{class}\">{before}<a href=\"{OVERVIEW}\">{all}</a>{after}{CLOSE}{content}")
}

/// A submission's name for a link.
pub fn shown_name(label: &str) -> String {
    let name = escaped_name(label);
    if name.is_empty() { tr!("report-no-name").to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_replaced_and_other_texts_left_alone() {
        let page = "<head></head>\n<main>\n<p>text</p></main>";
        let first = with_neighbours(page, None, Some("<b>"));
        assert!(first.contains("href=\"./~3c~b~3e~.html\"><span>&lt;b&gt;</span> →</a>"), "{first}");
        assert!(
            !first.contains("prev") && first.contains("href=\"./index.html\"") && first.ends_with("<p>text</p></main>")
        );
        let second = with_neighbours(&first, Some("ann"), None);
        assert!(second.contains("← <span>ann</span>") && !second.contains("next"), "{second}");
        assert_eq!(second.matches("<nav").count(), 1);
        assert_eq!(with_neighbours("kept", Some("a"), None), "kept");
    }

    #[test]
    fn numbers_are_in_order_of_their_values() {
        let mut labels = ["Group 10", "group 9", "Zoé", "éric", "ann"];
        in_page_order(&mut labels);
        assert_eq!(labels, ["ann", "group 9", "Group 10", "Zoé", "éric"]);
    }
}
