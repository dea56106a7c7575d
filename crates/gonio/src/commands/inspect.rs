//! `gonio inspect`: what a model file contains, and how it was interpreted.

use crate::error::{CliError, CommandOutcome, hint};
use crate::options::{GeneralOptions, LimitOptions};
use crate::report::Reporter;
use crate::terminal::{Style, TerminalPage};
use clap::Args;
use gonio_mesh::explain::LineExplanation;
use gonio_mesh::{Diagnostic, ModelLightKind, NormalSource, Severity};
use gonio_scene::inspect::{self, Inspection, MaterialReport};
use serde::Serialize;

/// Show what a model file contains and how each part was interpreted.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio inspect model.obj
      Counts, bounds, the values of each material, the files it names, the source of the normals, warnings.
  gonio inspect model.obj --line 1204
      An explanation of that line, with the vertices that it refers to.
  gonio inspect model.mtl --line 3
      The same for a material library.
  gonio inspect model.glb --json
      Everything as one JSON object.
  curl https://example.com/model.obj | gonio inspect -
      A model from stdin. Files compressed by gzip or zstd are unpacked.")]
pub struct InspectArgs {
    /// Model (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst), - for stdin, or builtin:NAME.
    #[arg(value_name = "FILE")]
    pub input: String,
    /// Explain one line of an OBJ or MTL file, counted from 1.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), help_heading = "Detail options")]
    pub line: Option<u64>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &InspectArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let files = args.limits.files([args.input.as_str()], reporter);
    let limits = args.limits.limits();
    let page = match args.line {
        Some(line) => {
            let explanation = inspect::explain_line(&args.input, line, &files, &limits)?;
            if reporter.json() {
                return json("line", &explanation, reporter);
            }
            line_page(&explanation)
        }
        None => {
            let inspection = {
                let _busy = reporter.busy("reading the model");
                inspect::inspect(&args.input, &files, &limits)?
            };
            if reporter.json() {
                return json("model", &inspection, reporter);
            }
            inspection_page(&inspection)
        }
    };
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

fn json(key: &str, value: &impl Serialize, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    reporter.report(&serde_json::json!({ "command": "inspect", key: value }))?;
    Ok(CommandOutcome::Done)
}

const FAINT: Style = Style::Dim;
const WARNING: Style = Style::Yellow;

/// The width of the column of names.
const NAME: usize = 20;
/// The number of rows after which a list is cut; `--json` has all of them.
const MOST_ROWS: usize = 40;

/// Lists everything about a model.
fn inspection_page(i: &Inspection) -> TerminalPage {
    let mut page = InspectionPage::default();
    let unpacked = i.unpacked_bytes.map_or(String::new(), |b| format!(", {} unpacked", bytes(b)));
    page.heading(&format!("{}: {}, {}{unpacked}", i.file, i.format.name(), bytes(i.bytes)));
    page.contents(i);
    page.geometry(i);
    page.surface(i);
    page.normals(i);
    page.parts(i);
    page.files(i);
    i.materials.iter().for_each(|m| page.material(m));
    page.lights_and_cameras(i);
    page.differences(i);
    page.diagnostics(&i.diagnostics);
    page.0
}

/// Explains one line of a file.
fn line_page(e: &LineExplanation) -> TerminalPage {
    let mut page = InspectionPage::default();
    let lines = if e.first_line == e.last_line {
        format!("line {}", e.line)
    } else {
        format!("line {} (its statement: lines {} to {})", e.line, e.first_line, e.last_line)
    };
    page.heading(&format!("{lines}: {}", e.text));
    page.0.line(format_args!("  {}", e.meaning));
    for detail in &e.details {
        page.0.line(format_args!("    {detail}"));
    }
    if !e.in_force.is_empty() {
        page.heading("In force");
        page.rows(&e.in_force, |page, f| page.line(f.what, &format!("{}   {FAINT}line {}{FAINT:#}", f.name, f.line)));
    }
    page.diagnostics(&e.problems);
    page.0
}

#[derive(Default)]
struct InspectionPage(TerminalPage);

/// The search for a file that a model names.
struct Search<'a> {
    found: Option<&'a str>,
    tried: &'a [String],
    refused: Option<&'a str>,
}

impl InspectionPage {
    fn heading(&mut self, text: &str) {
        self.0.heading(text);
    }

    fn line(&mut self, name: &str, value: &str) {
        let padding = NAME.saturating_sub(name.chars().count()).max(1);
        self.0.line(format_args!("  {name}{:padding$}{value}", ""));
    }

    /// Adds a row for each item, up to a limit.
    fn rows<T>(&mut self, items: &[T], mut row: impl FnMut(&mut Self, &T)) {
        for item in items.iter().take(MOST_ROWS) {
            row(self, item);
        }
        if items.len() > MOST_ROWS {
            self.0.line(format_args!("  {FAINT}and {} more (--json lists all){FAINT:#}", items.len() - MOST_ROWS));
        }
    }

    fn contents(&mut self, i: &Inspection) {
        if let Some(exporter) = &i.exporter {
            self.line("written by", exporter);
        }
        let counts: Vec<String> = i.contents.iter().map(|c| format!("{} {}", grouped(c.count), c.what)).collect();
        if !counts.is_empty() {
            self.wrapped("contains", &counts.join(", "));
        }
    }

    fn geometry(&mut self, i: &Inspection) {
        let g = &i.geometry;
        self.line("triangles", &grouped(g.triangles as u64));
        self.line("vertices", &format!("{} (equal corners merged)", grouped(g.vertices as u64)));
        for (axis, name) in ["x", "y", "z"].iter().enumerate() {
            let (low, high) = (g.min[axis], g.max[axis]);
            let title = if axis == 0 { "bounds" } else { "" };
            self.line(
                title,
                &format!("{name} {:>12} to {:<12} size {}", number(low), number(high), number(high - low)),
            );
        }
        if let Some([low, high]) = g.tex_coords {
            let range = |k: usize| format!("{} to {}", number(low[k]), number(high[k]));
            self.line("texture coordinates", &format!("u {}, v {}", range(0), range(1)));
        }
        if g.colors {
            self.line("vertex colors", "yes");
        }
        if let Some(groups) = g.smoothing_groups {
            self.line("smoothing groups", &if groups == 0 { "off everywhere".to_owned() } else { groups.to_string() });
        }
        let whole: u64 = g.memory.iter().map(|m| m.count).sum();
        let arrays: Vec<String> = g.memory.iter().map(|m| format!("{} {}", m.what, bytes(m.count))).collect();
        self.line("memory", &format!("{} ({})", bytes(whole), arrays.join(", ")));
    }

    fn surface(&mut self, i: &Inspection) {
        let s = &i.surface;
        let state = match (s.closed, s.outward) {
            (true, true) => "closed, front faces outside",
            (true, false) => "closed, but not every piece has its front faces outside",
            (false, _) => "open",
        };
        let pieces = if s.pieces == 1 { "1 piece".to_owned() } else { format!("{} pieces", grouped(s.pieces)) };
        let genus = s.genus.map_or(String::new(), |genus| format!(", genus {genus}"));
        self.line("surface", &format!("{state}; {pieces}{genus}"));
        self.line("area", &number(s.area as f32));
        if let Some(volume) = s.volume {
            self.line("volume", &number(volume as f32));
        }
        if !s.orientable {
            self.line("", "not orientable: no choice of front faces is consistent");
        } else if s.triangles_to_turn > 0 {
            let turn = grouped(s.triangles_to_turn);
            self.line("", &format!("{turn} triangles would have to be flipped to make all front faces consistent"));
        }
        let findings = [
            ("triangles without area", &s.degenerate_triangles),
            ("duplicate triangles", &s.duplicate_triangles),
            ("triangles back to back with another", &s.back_to_back_triangles),
            ("edges of one triangle only", &s.boundary_edges),
            ("edges of more than two triangles", &s.non_manifold_edges),
            ("edges between a front and a back face", &s.inconsistent_edges),
            ("points where surfaces merely touch", &s.non_manifold_positions),
        ];
        for (name, found) in findings.into_iter().filter(|(_, found)| found.count > 0) {
            let first = found.first.first().map_or(String::new(), |first| {
                let at: Vec<String> = first.positions.iter().map(|p| p.map(number).join(",")).collect();
                format!("   {FAINT}the first at {}{FAINT:#}", at.join(" - "))
            });
            self.line("", &format!("{} {name}{first}", grouped(found.count)));
        }
    }

    fn normals(&mut self, i: &Inspection) {
        let source = match i.normals.source {
            NormalSource::None => "none",
            NormalSource::File => "from the file",
            NormalSource::FileAndAveraged => "from the file, averaged where missing",
            NormalSource::Flat => "one per triangle",
            NormalSource::Averaged => "averaged over adjacent faces, weighted by angle",
        };
        self.line("normals", source);
        i.normals.notes.iter().for_each(|note| self.line("", note));
    }

    fn parts(&mut self, i: &Inspection) {
        self.heading("Parts");
        self.rows(&i.geometry.parts, |page, part| {
            let name = if part.name.is_empty() { "(no name)" } else { &part.name };
            let material = if part.material.is_empty() { "the default material" } else { &part.material };
            page.line(name, &format!("{:>10} triangles   {material}", grouped(part.triangles as u64)));
        });
    }

    fn files(&mut self, i: &Inspection) {
        if i.files.is_empty() && i.textures.is_empty() && i.images.is_empty() {
            return;
        }
        self.heading("Files");
        self.rows(&i.files, |page, file| {
            let line = file.line.map_or(String::new(), |line| format!(" (line {line})"));
            let search = Search { found: file.found.as_deref(), tried: &file.tried, refused: file.refused.as_deref() };
            page.found(&format!("{}{line}", file.name), &search, "");
        });
        self.rows(&i.textures, |page, t| {
            let size = t.size.map_or(String::new(), |[w, h]| format!(", {w} x {h}"));
            let search = Search { found: t.found.as_deref(), tried: &t.tried, refused: t.refused.as_deref() };
            page.found(&t.name, &search, &format!("{size}, {} of {}", t.key, t.material));
        });
        self.rows(&i.images, |page, image| {
            page.line(&image.name, &format!("inside the file, {}", bytes(image.bytes as u64)));
        });
    }

    fn found(&mut self, name: &str, search: &Search<'_>, remark: &str) {
        let Search { found, tried, refused } = search;
        match (found, refused) {
            (Some(path), _) => self.line(name, &format!("found: {path}{remark}")),
            (None, Some(refused)) => {
                self.line(name, &format!("{WARNING}not read{WARNING:#}{remark}; {refused}"));
            }
            (None, None) => {
                let tried = if tried.is_empty() { "no folder to search".to_owned() } else { tried.join(", ") };
                self.line(name, &format!("{WARNING}not found{WARNING:#}{remark}; searched {tried}"));
            }
        }
    }

    fn material(&mut self, m: &MaterialReport) {
        let file = m.file.as_ref().map_or(String::new(), |file| format!(", {file}"));
        let name = if m.name.is_empty() { "the default material".to_owned() } else { format!("material {}", m.name) };
        self.heading(&format!("{name}{file}, {} triangles", grouped(m.triangles as u64)));
        for v in &m.values {
            let place = v.line.map_or(String::new(), |line| format!("line {line}"));
            let source =
                [place, v.written.clone()].into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join(": ");
            let from = [source, v.rule.clone()].into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join("; ");
            let from = if from.is_empty() { from } else { format!("   {FAINT}{from}{FAINT:#}") };
            self.line(&v.property.replace('_', " "), &format!("{:<22}{from}", v.value));
        }
        for u in &m.unused {
            let place = u.line.map_or(String::new(), |line| format!("line {line}: "));
            self.line("not used", &format!("{FAINT}{place}{}{FAINT:#}", u.written));
        }
    }

    fn lights_and_cameras(&mut self, i: &Inspection) {
        if i.lights.is_empty() && i.cameras.is_empty() {
            return;
        }
        self.heading("Lights and cameras");
        self.rows(&i.lights, |page, light| {
            let kind = match light.kind {
                ModelLightKind::Ambient => "ambient".to_owned(),
                ModelLightKind::Directional => format!("directional, along {}", vector(light.direction)),
                ModelLightKind::Point => format!("point at {}", vector(light.position)),
                ModelLightKind::Spot { outer_angle_rad, .. } => {
                    let angle = number(outer_angle_rad.to_degrees());
                    format!("spot at {}, along {}, {angle} degrees", vector(light.position), vector(light.direction))
                }
            };
            let color = light.color.map(number).join(" ");
            page.line(&light.name, &format!("{kind}; color {color}, intensity {}", number(light.intensity)));
        });
        self.rows(&i.cameras, |page, camera| {
            let lens = match camera.fov_y_rad {
                Some(fov) => format!("{} degrees high", number(fov.to_degrees() as f32)),
                None => "parallel projection".to_owned(),
            };
            let (position, direction) = (vector(camera.position), vector(camera.direction));
            page.line(&camera.name, &format!("camera at {position}, along {direction}, {lens}"));
        });
    }

    fn differences(&mut self, i: &Inspection) {
        if i.differences.is_empty() {
            return;
        }
        self.heading("Interpreted differently by other programs");
        for d in &i.differences {
            self.0.line(format_args!("  {}: {}; here: {}", d.feature, d.others, d.here));
        }
    }

    fn diagnostics(&mut self, diagnostics: &[Diagnostic]) {
        if diagnostics.is_empty() {
            return;
        }
        self.heading("Warnings and notes");
        self.rows(diagnostics, |page, d| {
            let style = if d.severity == Severity::Warning { WARNING } else { FAINT };
            page.0.line(format_args!("  {style}{d}{hint}{style:#}", hint = hint(d.cause)));
        });
    }

    /// Adds a long value in several lines.
    fn wrapped(&mut self, name: &str, value: &str) {
        const WIDTH: usize = 90;
        let mut line = String::new();
        let mut name = name;
        for word in value.split_inclusive(", ") {
            if !line.is_empty() && line.len() + word.trim_end().len() > WIDTH {
                self.line(name, line.trim_end());
                (line, name) = (String::new(), "");
            }
            line += word;
        }
        self.line(name, &line);
    }
}

fn vector(v: [f64; 3]) -> String {
    v.map(|c| number(c as f32)).join(",")
}

/// Formats a number: exactly if that is short, else with four decimals.
fn number(value: f32) -> String {
    let text = (value + 0.0).to_string();
    if text.len() <= 9 {
        return text;
    }
    let rounded = format!("{value:.4}");
    // No minus sign for values that round to 0.
    if rounded == "-0.0000" { "0.0000".to_owned() } else { rounded }
}

/// Formats a number with its digits in groups of three.
fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Formats a number of bytes in a readable unit.
fn bytes(count: u64) -> String {
    let value = count as f64;
    match count {
        0..10_000 => format!("{} bytes", grouped(count)),
        10_000..1_048_576 => format!("{:.1} KiB", value / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", value / 1_048_576.0),
        _ => format!("{:.2} GiB", value / 1_073_741_824.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!((grouped(0), grouped(999), grouped(1_001_112)), ("0".into(), "999".into(), "1,001,112".into()));
        assert_eq!((bytes(9_999), bytes(10_240)), ("9,999 bytes".into(), "10.0 KiB".into()));
        assert_eq!((bytes(3 << 20), bytes(3 << 30)), ("3.0 MiB".into(), "3.00 GiB".into()));
        assert_eq!((number(0.1), number(-0.0), number(1.0 / 3.0)), ("0.1".into(), "0".into(), "0.3333".into()));
    }
}
