//! A station's page as Markdown.

use crate::station::{LawCheck, Station};
use gonio_bsdf::ParameterValues;

/// The names of the files that a page shows.
#[derive(Clone, Debug, Default)]
pub struct StationFiles {
    /// The captions and files of the pictures, the main one first.
    pub pictures: Vec<(&'static str, String)>,
    /// The plot.
    pub plot: String,
    /// The film, if there is one.
    pub film: Option<String>,
}

/// The page: texts, pictures, parameters, and the checks of the law.
pub fn page(station: &Station, values: &ParameterValues, files: &StationFiles, checks: &[LawCheck]) -> String {
    let mut page = format!("# {}\n", station.title);
    let mut add = |text: std::fmt::Arguments<'_>| page.push_str(&text.to_string());
    if let Some((caption, file)) = files.pictures.first() {
        add(format_args!("\n{caption}\n\n![{caption}]({file})\n"));
    }
    if let Some(film) = &files.film {
        add(format_args!("\n![The film over `{}`]({film})\n", station.film_parameter));
    }
    add(format_args!("\n**The rendering equation assumes:** {}\n", station.assumption));
    add(format_args!("\n**In nature:** {}\n", station.nature));
    add(format_args!("\n## The law\n\n```text\n{}\n```\n\nSource: {}\n", station.formula, station.source));
    add(format_args!("\n![The law as curves]({})\n", files.plot));
    add(format_args!("\n## Look\n\n{}\n", station.look));
    for (caption, file) in files.pictures.iter().skip(1) {
        add(format_args!("\n{caption}\n\n![{caption}]({file})\n"));
    }
    add(format_args!("\n**Question:** {}\n", station.question));
    add(format_args!("\n## Parameters\n\n| parameter | value | range | meaning |\n|---|---|---|---|\n"));
    for (parameter, value) in values.iter() {
        let (value, range) = (parameter.format(value), parameter.expected());
        let row =
            format!("| `{}` | {value} {} | {range} | {} |", parameter.name, parameter.unit, parameter.description);
        add(format_args!("{}\n", row.replace("  ", " ")));
    }
    add(format_args!("\n## Checks of the law\n\n| quantity | law | found | bound | |\n|---|---|---|---|---|\n"));
    for check in checks {
        let LawCheck { quantity, unit, expected, measured, bound } = check;
        let verdict = if check.holds() { "holds" } else { "**fails**" };
        let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
        add(format_args!("| {quantity}{unit} | {expected:.6} | {measured:.6} | {bound:.0e} | {verdict} |\n"));
    }
    page
}
