//! One draw call with everything it read, or one program.

use super::text::{self, aligned, counted, numbers, table};
use crate::terminal::TerminalPage;
use gonio_gl::trace::{
    AttributeRecord, AttributeSource, DrawRecord, Finding, FrameRecord, ProgramRecord, SamplerRecord, UniformNumbers,
    UniformValue,
};
use gonio_light::is_noise;

/// The width of the column of names.
const NAME: usize = 18;
/// The number of vectors of an array that are printed.
const MOST_ELEMENTS: usize = 16;

/// Lists a draw call.
pub fn draw(record: &FrameRecord, draw: &DrawRecord, findings: &[Finding]) -> TerminalPage {
    let mut page = TerminalPage::new();
    page.heading(format_args!("draw {}: {}", draw.index, draw.title()));
    let mut line = |name: &str, value: String| {
        page.line(format_args!("  {name:NAME$}{value}"));
    };
    if let Some(pass) = record.passes.get(draw.pass) {
        line("pass", format!("{} {}, into `{}`", draw.pass, pass.name, pass.target.name));
    }
    if let (Some(number), Some(program)) = (draw.program, record.program_of(draw)) {
        line("program", format!("{number} {}", program.name));
    }
    let how = if draw.indexed { "indices" } else { "vertices" };
    line("drawn", format!("{}: {} {how} from {}", text::primitives(draw), draw.count, draw.first));
    if let (Some(vertices), Some(fragments)) = (draw.vertices_shaded, draw.fragments_shaded) {
        line("counted by GPU", format!("{vertices} vertices, {fragments} fragments"));
    }
    line("state", text::state(draw).join(", "));
    let [x, y, width, height] = draw.state.viewport;
    line("viewport", format!("{width} x {height} pixels from {x}, {y}"));
    let mine: Vec<Finding> = findings.iter().filter(|finding| finding.draw == draw.index).cloned().collect();
    text::findings(&mut page, &mine);
    attributes(&mut page, &draw.attributes);
    samplers(&mut page, record, &draw.samplers);
    page.heading("uniforms");
    for uniform in &draw.uniforms {
        self::uniform(&mut page, uniform);
    }
    page
}

fn attributes(page: &mut TerminalPage, attributes: &[AttributeRecord]) {
    page.heading("attributes");
    if attributes.is_empty() {
        page.line("  none: the shader computes vertices from their indices");
    }
    let rows = attributes.iter().map(|attribute| {
        let source = match &attribute.source {
            AttributeSource::Array(array) => array.to_string(),
            AttributeSource::Constant { value, .. } => format!("{} for all vertices", numbers(value)),
        };
        (vec![attribute.location.to_string(), attribute.name.clone(), attribute.glsl_type.clone()], source)
    });
    // The last column may be long, and is not cut.
    let (rows, sources): (Vec<_>, Vec<_>) = rows.unzip();
    for (line, source) in aligned("rll", &[], rows.into_iter()).iter().zip(sources) {
        page.line(format_args!("{line:36}  {source}"));
    }
}

fn samplers(page: &mut TerminalPage, record: &FrameRecord, samplers: &[SamplerRecord]) {
    page.heading("samplers");
    if samplers.is_empty() {
        page.line("  none");
    }
    let rows = samplers.iter().map(|sampler| {
        let texture = sampler.texture.and_then(|id| record.texture(id));
        vec![
            sampler.name.clone(),
            sampler.glsl_type.clone(),
            format!("unit {}", sampler.unit),
            texture.map_or("nothing".to_owned(), |texture| format!("texture {} `{}`", texture.id, texture.name)),
            texture.map_or(String::new(), |t| format!("{} {} {}", t.kind, text::size(t), t.format)),
            texture.map_or(String::new(), |t| counted(t.levels.len(), "level")),
            text::sampled(sampler),
        ]
    });
    table(page, "lllllrl", &[], rows);
}

/// Lists a uniform: a matrix by rows, an array by elements.
fn uniform(page: &mut TerminalPage, uniform: &UniformValue) {
    let mark = if uniform.sent { "" } else { "   (never sent)" };
    let name = format!("{} {}", uniform.glsl_type, uniform.name);
    let rows = rows(uniform);
    let rest = rows.len().saturating_sub(MOST_ELEMENTS);
    let mut name = name.as_str();
    for row in rows.iter().take(MOST_ELEMENTS) {
        page.line(format!("  {name:32}{row}{mark}").trim_end());
        name = "";
    }
    if rest > 0 {
        page.line(format_args!("  {:32}and {rest} more, not shown", ""));
    }
}

fn rows(uniform: &UniformValue) -> Vec<String> {
    let number = |v: &f32| match v.abs() {
        _ if is_noise(f64::from(*v)) => format!("{:>12}", "0"),
        size if (1e-4..1e6).contains(&size) => format!("{v:>12.5}"),
        _ => format!("{v:>12.3e}"),
    };
    let joined = |values: &[f32]| values.iter().map(number).collect::<String>();
    let kind = uniform.glsl_type.as_str();
    match &uniform.value {
        value if value.is_empty() => vec!["unknown".to_owned()],
        UniformNumbers::Float(values) => {
            if let Some([columns, rows]) = matrix(kind) {
                // OpenGL stores columns; people read rows.
                return (0..rows)
                    .map(|row| joined(&(0..columns).map(|column| values[column * rows + row]).collect::<Vec<_>>()))
                    .collect();
            }
            let each = kind.strip_prefix("vec").and_then(|n| n.parse().ok()).unwrap_or(1);
            values.chunks(each).map(joined).collect()
        }
        UniformNumbers::Int(values) => vec![values.iter().map(|v| format!("{v:>12}")).collect()],
        UniformNumbers::Uint(values) => vec![values.iter().map(|v| format!("{v:>12}")).collect()],
        UniformNumbers::Bool(values) => vec![values.iter().map(|v| format!("{v:>12}")).collect()],
    }
}

/// Columns and rows of `mat3`, `mat3x2` and so on.
fn matrix(kind: &str) -> Option<[usize; 2]> {
    let sides: Vec<usize> = kind.strip_prefix("mat")?.split('x').filter_map(|side| side.parse().ok()).collect();
    match sides.as_slice() {
        [side] => Some([*side, *side]),
        [columns, rows] => Some([*columns, *rows]),
        _ => None,
    }
}

/// Lists a program.
pub fn program(number: usize, program: &ProgramRecord) -> TerminalPage {
    let mut page = TerminalPage::new();
    page.heading(format_args!("program {number}: {}", program.name));
    page.heading("attributes");
    let rows = program.attributes.iter().map(|a| vec![a.location.to_string(), a.name.clone(), a.glsl_type.clone()]);
    table(&mut page, "rll", &[], rows);
    page.heading("uniforms");
    let rows = program.uniforms.iter().map(|uniform| {
        let size = if uniform.array_size == 1 { String::new() } else { format!("[{}]", uniform.array_size) };
        let location = uniform.location.map_or(String::new(), |location| location.to_string());
        vec![location, format!("{}{size}", uniform.name), uniform.glsl_type.clone()]
    });
    table(&mut page, "rll", &[], rows);
    for (stage, source) in [("vertex shader", &program.vertex_source), ("fragment shader", &program.fragment_source)] {
        page.heading(stage);
        page.text(source.trim_end());
    }
    page
}
