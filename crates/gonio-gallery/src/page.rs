//! The web page of the gallery: one HTML file with its style in it, no scripts, no network.

use crate::drawing::{DrawnExhibit, grouped};
use crate::exhibit::{ExhibitSubject, Section};
use crate::markup::{self, escape, html, mathml};

/// The style of gonio's pages: colours of light and dark, type, figures, formulas.
pub const STYLE: &str = include_str!("page.css");

/// Writes the page. Pictures and scenes are named relative to it: `pictures/NAME.png`, `scenes/NAME.toml`, `sheet.png`.
/// `drawn_by` is a clause such as "drawn by the CPU reference".
pub fn write(sections: &[Section], drawn: &[DrawnExhibit<'_>], drawn_by: &str) -> String {
    let mut page = String::with_capacity(64 * 1024);
    let whole = sections.first().map_or("", |s| s.equation);
    page += &format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>gonio: a tour of the light equation</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n\
         <h1>gonio</h1>\n<p>The light lab: every technique on several models.</p>\n\
         <div class=\"formula\">{}</div>\n\
         <p>{} pictures, {}. Under each: the equation with its active terms, an explanation, and the command that \
         draws it again. All are on <a href=\"sheet.png\">one sheet</a>.</p>\n<nav>\n",
        mathml(whole),
        drawn.len(),
        escape(drawn_by),
    );
    for section in sections.iter().filter(|s| !s.title.is_empty()) {
        page += &format!("<a href=\"#{}\">{}</a>\n", section.id, html(section.title));
    }
    page += "</nav>\n</header>\n<main>\n";
    let mut drawn = drawn.iter();
    for (index, section) in sections.iter().enumerate() {
        let class = if index == 0 { " class=\"first\"" } else { "" };
        page += &format!("<section id=\"{}\"{class}>\n", section.id);
        if !section.title.is_empty() {
            page += &format!(
                "<h2>{}</h2>\n<div class=\"formula\">{}</div>\n<p>{}</p>\n",
                html(section.title),
                mathml(section.equation),
                html(section.introduction)
            );
        }
        for row in &section.rows {
            let class = if row.len() <= 2 { "row large" } else { "row" };
            page += &format!("<div class=\"{class}\">\n");
            for drawn in drawn.by_ref().take(row.len()) {
                page += &figure(drawn);
            }
            page += "</div>\n";
        }
        page += "</section>\n";
    }
    page += &format!(
        "</main>\n<footer>Made by <code>gonio tour</code> {}. Differences are measured in a small picture with one \
         sample per pixel, in steps of 1/255. Drivers filter textures differently, so mipmapped and anisotropic \
         pictures differ most. Milliseconds are from the first draw call to the picture in memory.</footer>\n\
         </body>\n</html>\n",
        env!("CARGO_PKG_VERSION")
    );
    page
}

fn figure(drawn: &DrawnExhibit<'_>) -> String {
    let exhibit = drawn.exhibit;
    let name = escape(&exhibit.name);
    let alt: String = markup::runs(&exhibit.caption).into_iter().map(|r| r.text).collect();
    format!(
        "<figure id=\"{name}\">\n<a href=\"pictures/{name}.png\"><img src=\"pictures/{name}.png\" width=\"{}\" \
         height=\"{}\" alt=\"{}\" loading=\"lazy\"></a>\n<figcaption>\n<h3>{}</h3>\n<p>{}</p>\n\
         <div class=\"formula\">{}</div>\n<p>{}</p>\n<dl>\n{}</dl>\n<code>{}</code>\n</figcaption>\n</figure>\n",
        drawn.width,
        drawn.height,
        escape(&alt),
        html(&exhibit.caption),
        html(&drawn.remark()),
        mathml(&exhibit.equation),
        html(&exhibit.look),
        facts(drawn, &name),
        escape(&drawn.command),
    )
}

/// The numbers of a picture: differences, times, counts.
fn facts(drawn: &DrawnExhibit<'_>, name: &str) -> String {
    let size = format!("{:.1} ms at {} × {}", drawn.ms, drawn.width, drawn.height);
    match drawn.exhibit.subject {
        ExhibitSubject::Environment(_) => return format!("<dt>converted in</dt><dd>{size}</dd>\n"),
        ExhibitSubject::Station(_) => return format!("<dt>computed in</dt><dd>{size}</dd>\n"),
        ExhibitSubject::Scene(_) => {}
    }
    let difference = match &drawn.difference {
        Some(d) => format!(
            "max {}, mean {:.3}; {:.2} % of pixels within 1",
            d.max,
            d.mean,
            // Rounded down: 100 appears only if all pixels are within one step.
            (d.within_one * 1e4).floor() / 100.0
        ),
        None => "n/a: drawn by the CPU".to_owned(),
    };
    let count = |n: Option<u64>| n.map_or_else(|| "not counted by this driver".to_owned(), grouped);
    format!(
        "<dt>GPU against CPU</dt><dd>{difference}</dd>\n<dt>drawn in</dt><dd>{size}</dd>\n\
         <dt>vertices lit</dt><dd>{}</dd>\n<dt>fragments lit</dt><dd>{}</dd>\n\
         <dt>scene</dt><dd><a href=\"scenes/{name}.toml\">{name}.toml</a></dd>\n",
        count(drawn.counts.vertices),
        count(drawn.counts.fragments),
    )
}
