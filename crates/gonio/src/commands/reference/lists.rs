//! What commands work on, as lists: exercises, mistakes, BRDF models, environments, stations.

use super::escaped;
use crate::commands::lab;
use gonio_beyond::STATIONS;
use gonio_bsdf::{MODELS, ParameterValues};
use gonio_check::mistakes::Mistake;
use gonio_environment::Builtin;
use gonio_environment::arrange::Arrangement;
use gonio_environment::face::Layout;
use gonio_exercises::exercise;
use gonio_language::Language;

/// The exercises, with links to their chapters.
pub fn exercises() -> String {
    let mut section = String::from("\n## The exercises\n\n");
    for exercise in exercise::all() {
        let builds_on = match exercise.builds_on.as_slice() {
            [] => String::new(),
            ids => format!(" Builds on {}.", ids.join(", ")),
        };
        section += &format!(
            "- [`{0}`](../exercises/{0}.md) {1}: {2}{builds_on}\n",
            exercise.id,
            escaped(exercise.title_in(Language::English)),
            escaped(exercise.summary_in(Language::English))
        );
    }
    section
}

/// The page of the mistakes that the checker names.
pub fn mistakes() -> String {
    let mut page = String::from(
        "# The catalogue of mistakes\n\nThe mistakes that `gonio lab check` knows by name. `gonio lab mistakes ID` explains one of \
         them, and shows the wrong line beside the right one. Some are harmless: a right answer that is written in another way.\n",
    );
    let mut seen = std::collections::BTreeSet::new();
    for (heading, mistakes) in lab::mistakes::by_kind() {
        page += &format!("\n## {heading}\n\n");
        for mistake in mistakes.iter().filter(|mistake| seen.insert(mistake.id.clone())) {
            page += &item(mistake);
        }
    }
    page
}

fn item(mistake: &Mistake) -> String {
    let mark = if mistake.harmless { " (harmless)" } else { "" };
    let mut item = format!("- **`{}`**{mark} {}.", mistake.id, escaped(&mistake.name));
    for (heading, text) in [("What it looks like", &mistake.looks_like), ("How to fix it", &mistake.fix)] {
        if !text.is_empty() {
            item += &format!(" *{heading}*: {}", escaped(text));
        }
    }
    item.push('\n');
    item
}

/// The models of the BRDF bench, with their parameters.
pub fn brdf_models() -> String {
    let mut section = String::from(
        "\n## The models\n\n`gonio brdf show MODEL` prints the same about one of them; its values are set by `MODEL:key=value,...`.\n",
    );
    for model in MODELS {
        section += &format!("\n### {}\n\n{}\n\n", model.name, escaped(model.title));
        section += &format!("```text\n{}\n```\n\n", model.formula);
        section += &format!("Source: {}\n\n{}\n", escaped(model.source), escaped(model.remark));
        let values = ParameterValues::defaults(model.parameters);
        section += &table(&values);
    }
    section
}

/// The parameters of a model or station as a table.
fn table(values: &ParameterValues) -> String {
    let mut rows = String::new();
    for (parameter, value) in values.iter() {
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
        rows += &format!(
            "| `{}` | {}{unit} | {} | {} |\n",
            parameter.name,
            parameter.format(value),
            escaped(&parameter.expected()),
            escaped(&parameter.description)
        );
    }
    if rows.is_empty() {
        rows
    } else {
        format!("\n| parameter | default | range | meaning |\n|---|---|---|---|\n{rows}")
    }
}

/// Environments that need no file, and how those in files are arranged.
pub fn environments() -> String {
    let mut section = String::from("\n## Built-in environments\n\n");
    for builtin in Builtin::ALL {
        section += &format!("- `{}`: {}\n", builtin.name(), escaped(builtin.description().trim()));
    }
    section += "\n## Arrangements of an environment in files\n\n";
    for arrangement in Arrangement::ALL {
        section += &format!("- `{}`: {}\n", arrangement.name(), escaped(arrangement.description().trim()));
    }
    section += "\n## Layouts of faces\n\n";
    for layout in Layout::ALL {
        section += &format!("- `{}`: {}\n", layout.name(), escaped(layout.description().trim()));
    }
    section
}

/// The stations of `gonio beyond`, with their parameters.
pub fn stations() -> String {
    let mut section = String::from("\n## The stations beyond the rendering equation\n");
    for station in STATIONS {
        let pictures: Vec<String> = station.pictures.iter().map(|picture| format!("`{}`", picture.name)).collect();
        section += &format!("\n### {}\n\n{}. {}\n\n", station.name, escaped(station.title), escaped(station.nature));
        section += &format!("```text\n{}\n```\n\n", station.formula);
        section += &format!(
            "Pictures: {}. A film changes `{}`. Source: {}\n",
            pictures.join(", "),
            station.film_parameter,
            escaped(station.source)
        );
        section += &table(&ParameterValues::defaults(station.parameters));
    }
    section
}
