//! The page of a submission.

use super::html::{Icon, PageKind, document, shown};
use super::listing::Listing;
use super::picture::{PictureKind, Pictures, heat};
use super::text::{escaped_line, escaped_name, name, percent};
use super::verdict_parts::{messages_html, mistakes_html, notes_html, proposed_fix_html, verdict_html};
use crate::exercise::{Exercise, ExerciseKind};
use crate::preview::is_answer;
use gonio_check::comparison::Evidence;
use gonio_check::submission::SourceFile;
use gonio_check::testbench::{TILE, scene};
use gonio_check::verdict::{BoundVariable, Outcome, SceneVerdict, TermState, TermVerdict, Verdict};
use gonio_language::tr;
use std::fmt::Write as _;

/// Side of a picture in CSS pixels: an integer multiple, so that all its pixels are squares of the same size.
const SHOWN: u32 = 4 * TILE;

/// A page for a student and the teacher, as one HTML file that loads and runs nothing: the verdict, each mistake with its place
/// and fix, the proposed change as a diff, the compiler's messages, terms, scenes with pictures if there is evidence, the code with
/// marked lines, peculiarities, warnings, and the roles of variables. `label` is the submission's name; `sources` are its files, of
/// which programs and those with findings are shown. The page follows the light or dark theme of the system, and fits a phone. [`super::with_neighbours`] adds links to
/// other pages of a class.
///
/// Pictures are linear light encoded as sRGB; pixels are enlarged without smoothing; NaN is magenta; a chequered background
/// shows where nothing is drawn. Differences are colours on one scale for the whole page.
pub fn page(label: &str, verdict: &Verdict, evidence: Option<&Evidence>, sources: &[SourceFile]) -> String {
    let exercise = crate::exercise::find(&verdict.exercise);
    let title = exercise.map_or_else(String::new, |exercise| format!(" · {}", escaped_line(exercise.title())));
    let pictures = evidence.map(|evidence| Pictures::new(evidence, verdict)).filter(|pictures| pictures.count() > 0);
    let is_listed = |file: &&SourceFile| is_listed(exercise, verdict, file);
    let listing = Listing::new(verdict, sources.iter().filter(is_listed));
    let mut body = format!(
        "<header>\n<p class=\"over\">{}{title}</p>\n<h1>{}</h1>\n</header>\n",
        escaped_line(&verdict.exercise),
        escaped_name(label)
    );
    body.push_str(&verdict_html(verdict, true));
    body.push_str(&mistakes_html(verdict, Some(&listing)));
    body.push_str(&proposed_fix_html(verdict, Some(&listing)));
    body.push_str(&messages_html(verdict, Some(&listing)));
    body.push_str(&terms(&verdict.terms));
    body.push_str(&scenes(verdict, pictures.as_ref()));
    body.push_str(&listing.html());
    body.push_str(&notes_html(verdict));
    body.push_str(&bound(&verdict.bound));
    let _ = writeln!(body, "<footer><p>{}</p></footer>", tr!("report-checked-by-gonio"));
    let kind = PageKind { style: include_str!("page.css"), script: None };
    document(&format!("{}: {}", name(label), super::text::words(verdict.verdict)), kind, &body)
}

/// Whether the file is shown: a program, or a file with findings.
fn is_listed(exercise: Option<&Exercise>, verdict: &Verdict, file: &SourceFile) -> bool {
    let is_program = exercise.is_some_and(|exercise| match exercise.kind {
        ExerciseKind::Shaders | ExerciseKind::Faces | ExerciseKind::GlProgram => is_answer(exercise, file),
        ExerciseKind::Buffers | ExerciseKind::Baking => false,
    });
    is_program
        || verdict.mistakes.iter().any(|mistake| mistake.file.as_ref() == Some(&file.name))
        || verdict.messages.iter().any(|message| message.file == file.name)
}

fn terms(terms: &[TermVerdict]) -> String {
    if terms.is_empty() {
        return String::new();
    }
    let mut html = format!("<section>\n<h2>{}</h2>\n<ul class=\"terms\">\n", tr!("report-term-by-term"));
    for term in terms {
        let (class, icon, words) = match term.state {
            TermState::Right => ("right", Icon::Right, tr!("report-right")),
            TermState::Wrong => ("wrong", Icon::Wrong, tr!("report-wrong")),
            TermState::NotSeparable => ("apart", Icon::None, tr!("report-not-tested-separately")),
        };
        let _ = writeln!(
            html,
            "<li class=\"{class}\">{}<span><b>{}</b> {words}</span></li>",
            icon.svg(),
            escaped_line(&scene::term_title(&term.term))
        );
    }
    html.push_str("</ul>\n");
    if terms.iter().any(|term| term.state == TermState::NotSeparable) {
        let _ = writeln!(html, "<p class=\"hint\">{}</p>", tr!("report-separate-terms"));
    }
    html.push_str("</section>\n");
    html
}

fn scenes(verdict: &Verdict, pictures: Option<&Pictures<'_>>) -> String {
    if verdict.scenes.is_empty() {
        return String::new();
    }
    let (alone, whole): (Vec<_>, Vec<_>) = verdict.scenes.iter().partition(|scene| scene.scene.ends_with(" alone"));
    let mut html = format!("<section class=\"scenes\">\n<h2>{}</h2>\n", tr!("report-scene-by-scene"));
    if !whole.is_empty() {
        html.push_str(&table(verdict, &whole, pictures, 1));
    }
    if !alone.is_empty() {
        let right = alone.iter().filter(|scene| scene.right).count();
        let _ = write!(
            html,
            "<details>\n<summary>{}</summary>\n{}</details>\n",
            tr!("report-one-term-alone", scenes = tr!("report-scenes-right", right = right, count = alone.len())),
            table(verdict, &alone, pictures, 1 + whole.len())
        );
    }
    if let Some(pictures) = pictures {
        html.push_str(&legend(verdict, pictures));
    }
    html.push_str("</section>\n");
    html
}

/// Returns the heading of a column of pictures.
fn caption(kind: PictureKind, verdict: &Verdict) -> &'static str {
    match (kind, verdict.verdict) {
        (PictureKind::Yours, _) => tr!("report-yours"),
        (PictureKind::Reference, _) => tr!("report-reference"),
        (PictureKind::Difference, _) => tr!("report-difference"),
        (PictureKind::Predicted, Outcome::Correct) => tr!("report-your-method"),
        (PictureKind::Predicted, _) => tr!("report-predicted"),
    }
}

/// A table of scenes, of which `first` is the number of the first one in the page. A box in each row enlarges its pictures.
///
/// Elements have explicit roles: on narrow pages the cells are laid out differently, and browsers no longer expose a table.
fn table(verdict: &Verdict, scenes: &[&SceneVerdict], pictures: Option<&Pictures<'_>>, first: usize) -> String {
    let kinds = pictures.map(Pictures::kinds).unwrap_or_default();
    let mut html = format!(
        "<table role=\"table\">\n<thead role=\"rowgroup\"><tr role=\"row\"><th role=\"columnheader\" \
         scope=\"col\">{}</th>",
        tr!("report-column-scene")
    );
    for kind in &kinds {
        let _ = write!(html, "<th role=\"columnheader\" scope=\"col\">{}</th>", caption(*kind, verdict));
    }
    html.push_str("</tr></thead>\n<tbody role=\"rowgroup\">\n");
    for (number, scene) in (first..).zip(scenes) {
        let zoom = format!("zoom-{number}");
        let has_picture = pictures.is_some_and(|pictures| pictures.find(&scene.scene, PictureKind::Yours).is_some());
        let _ = write!(html, "<tr role=\"row\">{}", scene_head(scene, has_picture.then_some(zoom.as_str())));
        for kind in &kinds {
            let caption = caption(*kind, verdict);
            let picture = pictures.and_then(|pictures| pictures.find(&scene.scene, *kind));
            let picture = picture.map_or_else(String::new, |picture| {
                let name = escaped_line(&scene::title(&scene.scene));
                let uri = picture.data_uri();
                format!(
                    "<label for=\"{zoom}\"><img alt=\"{caption}, {name}\" width=\"{SHOWN}\" height=\"{SHOWN}\" \
                     src=\"{uri}\"></label>"
                )
            });
            let _ = write!(
                html,
                "<td role=\"cell\"><span class=\"caption\" aria-hidden=\"true\">{caption}</span>{picture}</td>"
            );
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table>\n");
    html
}

/// The head of a row; `zoom` is the id of the box that enlarges its pictures, if it has any.
fn scene_head(scene: &SceneVerdict, zoom: Option<&str>) -> String {
    let (class, icon, word) = match scene.right {
        true => ("right", Icon::Right, tr!("report-right")),
        false => ("wrong", Icon::Wrong, tr!("report-wrong")),
    };
    let name = scene::title(&scene.scene);
    let measure = match scene.right {
        true => String::new(),
        false => {
            let (percent, worst) = (percent(scene.pixels_beyond), format!("{:.2}", scene.worst));
            format!("<span class=\"measure\">{}</span>", tr!("report-measure", percent = percent, worst = worst))
        }
    };
    let zoom = zoom.map_or_else(String::new, |id| {
        format!(
            "<label class=\"zoom\"><input type=\"checkbox\" id=\"{id}\" aria-label=\"{}\"><span>{}</span></label>",
            tr!("report-large-pictures-of", scene = escaped_line(&name)),
            tr!("report-large-pictures")
        )
    });
    format!(
        "<th role=\"rowheader\" scope=\"row\"><span class=\"name {class}\">{}<span><b>{}</b> \
         {word}</span></span><span class=\"shows\">{}</span>{measure}{zoom}</th>",
        icon.svg(),
        escaped_line(&name),
        escaped_line(&scene.shows)
    )
}

fn legend(verdict: &Verdict, pictures: &Pictures<'_>) -> String {
    let stops: Vec<String> = (0..=8)
        .map(|step| {
            let [r, g, b] = heat(step as f32 / 8.0);
            format!("rgb({r} {g} {b})")
        })
        .collect();
    let full = pictures.full;
    let more = if full < 1.0 { tr!("report-scale-or-more", full = full.to_string()) } else { "1".to_owned() };
    let mut notes = vec![
        format!("<li><span class=\"swatch nan\"></span>{}</li>", tr!("report-not-a-number")),
        format!("<li><span class=\"swatch checker\"></span>{}</li>", tr!("report-nothing-drawn")),
    ];
    if pictures.kinds().contains(&PictureKind::Predicted) {
        let what = match (verdict.verdict, verdict.mistakes.len()) {
            (Outcome::Correct, _) => tr!("report-legend-your-method"),
            (_, 1) => tr!("report-legend-predicted"),
            _ => tr!("report-legend-predicted-together"),
        };
        notes.push(format!("<li>{what}</li>"));
    }
    notes.insert(
        0,
        format!(
            "<li>{} <span class=\"scale\" style=\"background: linear-gradient(90deg, {})\"></span> \
             {more}</li>",
            tr!("report-legend-difference"),
            stops.join(", ")
        ),
    );
    let own_way = match verdict.peculiarities.is_empty() {
        true => String::new(),
        false => format!(" {}", tr!("report-own-method")),
    };
    format!(
        "<ul class=\"legend\">\n{}\n</ul>\n<p class=\"hint\">{}{own_way}</p>\n",
        notes.join("\n"),
        tr!("report-linear-light")
    )
}

fn bound(bound: &[BoundVariable]) -> String {
    if bound.is_empty() {
        return String::new();
    }
    let unknown = bound.iter().filter(|variable| variable.role.is_none()).count();
    let each = |variable: &BoundVariable| {
        let (class, role) = match &variable.role {
            Some(role) => ("", format!("<code>{}</code>", escaped_line(role))),
            None => (" class=\"unknown\"", format!("{}{}", Icon::Unsure.svg(), tr!("report-unrecognised"))),
        };
        format!(
            "<tr{class}><th scope=\"row\"><code>{}</code></th><td><code>{}</code></td><td>{role}</td></tr>\n",
            escaped_line(&variable.name),
            escaped_line(&variable.glsl_type)
        )
    };
    let rows =
        shown(bound, each, |more| format!("<tr><td colspan=\"3\">{}</td></tr>\n", tr!("report-and-more", more = more)));
    let variables = tr!("report-count-variables", count = bound.len());
    let (open, summary) = match unknown {
        0 => ("", variables),
        some => (" open", tr!("report-some-unrecognised", variables = variables, some = some)),
    };
    let hint = match unknown {
        0 => String::new(),
        _ => format!("<p class=\"hint\">{}</p>\n", tr!("report-names-file")),
    };
    let heading = tr!("report-variables-and-roles");
    let [name, glsl_type, role] = ["report-column-name", "report-column-type", "report-column-role"].map(|id| tr!(id));
    format!(
        "<section class=\"bound\">\n<h2>{heading}</h2>\n<details{open}>\n<summary>{summary}</summary>\n\
         <table>\n<thead><tr><th scope=\"col\">{name}</th><th scope=\"col\">{glsl_type}</th><th scope=\"col\">{role}</th></tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table>\n{hint}</details>\n</section>\n"
    )
}
