//! A frame as text: tables in the order of the calls.

use crate::terminal::{Style, TerminalPage};
use gonio_gl::trace::{
    DrawRecord, Finding, FrameRecord, PassRecord, ProgramRecord, SamplerRecord, Severity, TextureRecord,
};
use std::fmt::Write;

/// The width at which a cell is cut.
const WIDEST: usize = 44;

/// Lists everything, briefly.
pub fn frame(about: &str, record: &FrameRecord, findings: &[Finding]) -> TerminalPage {
    let mut text = TerminalPage::new();
    text.heading(about);
    for note in &record.notes {
        text.line(format_args!("  note: {note}"));
    }
    self::findings(&mut text, findings);
    passes(&mut text, &record.passes);
    draws(&mut text, record);
    samplers(&mut text, record);
    textures(&mut text, record);
    programs(&mut text, &record.programs);
    text
}

/// Lists what is wrong.
pub(super) fn findings(text: &mut TerminalPage, findings: &[Finding]) {
    text.heading("findings");
    if findings.is_empty() {
        text.line("  none: every sampler reads a bound texture, and every uniform was sent");
    }
    for finding in findings {
        let style = match finding.severity {
            Severity::Error => Style::Red,
            Severity::Warning => Style::Yellow,
        };
        let more = match finding.draws {
            1 => String::new(),
            n => format!(" (and in {} more)", n - 1),
        };
        text.line(format_args!(
            "  {style}{}{style:#} {}: draw {}, {}{more}",
            finding.severity.name(),
            finding.rule.name(),
            finding.draw,
            finding.draw_title
        ));
        text.line(format_args!("    {}", finding.message));
        text.line(format_args!("    {}", finding.advice));
    }
}

fn passes(text: &mut TerminalPage, passes: &[PassRecord]) {
    let rows = passes.iter().enumerate().map(|(number, pass)| {
        let target = &pass.target;
        let samples = if target.samples == 1 { "1 sample".to_owned() } else { format!("{} samples", target.samples) };
        let mut done = Vec::new();
        if let Some(clear) = &pass.cleared {
            done.extend(clear.color.map(|color| format!("colour cleared to {}", numbers(&color))));
            done.extend(clear.depth.map(|depth| format!("depth to {depth}")));
        }
        done.extend(pass.resolved_into.iter().map(|name| format!("averaged into `{name}`")));
        vec![
            number.to_string(),
            pass.name.clone(),
            format!("into `{}`", target.name),
            format!("{} x {}", target.width, target.height),
            target.format.clone().unwrap_or_default(),
            samples,
            counted(pass.draw_count, "draw"),
            done.join(", "),
        ]
    });
    text.heading("passes");
    table(text, "rllrlrrl", &[], rows);
}

fn draws(text: &mut TerminalPage, record: &FrameRecord) {
    text.heading("draw calls");
    let header = ["", "pass", "what", "program", "primitives", "vertices", "fragments", "state"];
    let row = |draw: &DrawRecord| {
        let count = |count: Option<u64>| count.map_or("-".to_owned(), |count| count.to_string());
        vec![
            draw.index.to_string(),
            draw.pass.to_string(),
            draw.title(),
            draw.program.map_or("-".to_owned(), |program| program.to_string()),
            primitives(draw),
            count(draw.vertices_shaded),
            count(draw.fragments_shaded),
            state(draw).join(", "),
        ]
    };
    table(text, "rrlrrrrl", &header, record.draws.iter().map(row));
}

/// `968 triangles`
pub(super) fn primitives(draw: &DrawRecord) -> String {
    let each = match draw.primitive.as_str() {
        "triangles" => 3,
        "lines" => 2,
        "points" => 1,
        _ => return format!("{} of {} vertices", draw.primitive, draw.count),
    };
    let number = draw.count / each;
    let times = if draw.instances == 1 { String::new() } else { format!(" x {}", draw.instances) };
    let name = if number == 1 { draw.primitive.trim_end_matches('s') } else { &draw.primitive };
    format!("{number} {name}{times}")
}

/// The state of the fixed functions.
pub(super) fn state(draw: &DrawRecord) -> Vec<String> {
    let state = &draw.state;
    let mut words = Vec::new();
    match (&state.depth_test, state.depth_mask) {
        (Some(test), true) => words.push(format!("depth {test}")),
        (Some(test), false) => words.push(format!("depth {test}, not written")),
        (None, _) => words.push("no depth".to_owned()),
    }
    if let Some(cull) = &state.cull {
        let clockwise = if state.front_face == "clockwise" { " (front is clockwise)" } else { "" };
        words.push(format!("cull {cull}{clockwise}"));
    }
    if let Some(blend) = &state.blend {
        words.push(format!("blend {}, {}", blend.color[0], blend.color[1]));
    }
    words
}

/// Lists samplers, units and textures, once for all draws with the same.
fn samplers(text: &mut TerminalPage, record: &FrameRecord) {
    let mut seen: Vec<(&SamplerRecord, Vec<usize>)> = Vec::new();
    for draw in &record.draws {
        for sampler in &draw.samplers {
            let same = |(known, _): &&mut (&SamplerRecord, Vec<usize>)| {
                known.name == sampler.name
                    && known.unit == sampler.unit
                    && known.texture == sampler.texture
                    && known.sampling == sampler.sampling
            };
            match seen.iter_mut().find(same) {
                Some((_, draws)) => draws.push(draw.index),
                None => seen.push((sampler, vec![draw.index])),
            }
        }
    }
    text.heading("samplers");
    if seen.is_empty() {
        text.line("  none");
    }
    let header = ["sampler", "type", "reads unit", "where texture", "is bound", "sampled", "draws"];
    let rows = seen.iter().map(|(sampler, draws)| {
        let texture = sampler.texture.and_then(|id| record.texture(id));
        vec![
            sampler.name.clone(),
            sampler.glsl_type.clone(),
            sampler.unit.to_string(),
            sampler.texture.map_or("-".to_owned(), |id| id.to_string()),
            texture.map_or("nothing".to_owned(), |texture| texture.name.clone()),
            sampled(sampler),
            ranges(draws),
        ]
    });
    table(text, "llrrlll", if seen.is_empty() { &[] } else { &header }, rows);
}

/// `linear mipmap linear, repeat`
pub(super) fn sampled(sampler: &SamplerRecord) -> String {
    let Some(sampling) = &sampler.sampling else { return "fetched".to_owned() };
    let [s, t] = &sampling.wrap;
    let wrap = if s == t { s.clone() } else { format!("{s} and {t}") };
    format!("{}, {wrap}", sampling.min_filter)
}

fn textures(text: &mut TerminalPage, record: &FrameRecord) {
    text.heading("textures");
    let header = ["", "name", "kind", "size", "format", "levels", ""];
    let read = |id: u32| record.draws.iter().flat_map(|draw| &draw.samplers).any(|s| s.texture == Some(id));
    let drawn = |id: u32| {
        record.passes.iter().flat_map(|pass| &pass.target.attachments).any(|attached| attached.texture == Some(id))
    };
    let row = |texture: &TextureRecord| {
        vec![
            texture.id.to_string(),
            texture.name.clone(),
            texture.kind.clone(),
            size(texture),
            texture.format.clone(),
            texture.levels.len().to_string(),
            match (read(texture.id), drawn(texture.id)) {
                (true, true) => "drawn into and read later",
                (false, true) => "drawn into",
                (true, false) => "read",
                (false, false) => "",
            }
            .to_owned(),
        ]
    };
    // Textures without texels are left out.
    table(text, "rllrlrl", &header, record.textures.iter().filter(|t| !t.levels.is_empty()).map(row));
}

/// `512 x 512`
pub(super) fn size(texture: &TextureRecord) -> String {
    let mut size = format!("{} x {}", texture.width, texture.height);
    if texture.depth > 1 {
        let _ = write!(size, " x {}", texture.depth);
    }
    if texture.samples > 1 {
        let _ = write!(size, ", {} samples", texture.samples);
    }
    size
}

fn programs(text: &mut TerminalPage, programs: &[ProgramRecord]) {
    text.heading("programs");
    let rows = programs.iter().enumerate().map(|(number, program)| {
        let samplers = program.uniforms.iter().filter(|uniform| uniform.glsl_type.contains("sampler")).count();
        vec![
            number.to_string(),
            program.name.clone(),
            counted(program.attributes.len(), "attribute"),
            counted(program.uniforms.len() - samplers, "uniform"),
            counted(samplers, "sampler"),
            format!("GLSL {} + {} lines", lines(&program.vertex_source), lines(&program.fragment_source)),
        ]
    });
    table(text, "rlrrrl", &[], rows);
}

fn lines(source: &str) -> usize {
    source.lines().count()
}

pub(super) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// `0 0 0 1`
pub(super) fn numbers(values: &[f32]) -> String {
    values.iter().map(f32::to_string).collect::<Vec<_>>().join(" ")
}

/// `0-3, 7`
fn ranges(draws: &[usize]) -> String {
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for &draw in draws {
        match ranges.last_mut() {
            Some([_, last]) if *last + 1 == draw => *last = draw,
            _ => ranges.push([draw, draw]),
        }
    }
    let words = ranges.iter().map(|[a, b]| if a == b { a.to_string() } else { format!("{a}-{b}") });
    words.collect::<Vec<_>>().join(", ")
}

/// Rows as lines of aligned columns, `l` to the left and `r` to the right. Columns that are empty everywhere are left out.
pub(super) fn aligned(columns: &str, header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Vec<String> {
    let mut rows: Vec<Vec<String>> = rows.collect();
    for cell in rows.iter_mut().flatten() {
        if cell.chars().count() > WIDEST {
            // The end of a path is the more useful part.
            let letters: Vec<char> = cell.chars().collect();
            *cell = if cell.contains('/') {
                "...".chars().chain(letters[letters.len() + 3 - WIDEST..].iter().copied()).collect()
            } else {
                letters.iter().copied().take(WIDEST - 3).chain("...".chars()).collect()
            };
        }
    }
    if !header.is_empty() {
        rows.insert(0, header.iter().map(|word| (*word).to_owned()).collect());
    }
    let body = usize::from(!header.is_empty());
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|c| c.chars().count()).max();
    let widths: Vec<usize> = (0..columns.len())
        .map(|column| {
            let is_empty = rows.iter().skip(body).all(|row| row.get(column).is_none_or(String::is_empty));
            if is_empty { 0 } else { width(column).unwrap_or(0) }
        })
        .collect();
    let line = |row: &Vec<String>| {
        let mut line = String::new();
        for ((cell, side), &width) in row.iter().zip(columns.chars()).zip(&widths) {
            if width == 0 {
                continue;
            }
            let _ = match side {
                'r' => write!(line, "  {cell:>width$}"),
                _ => write!(line, "  {cell:width$}"),
            };
        }
        line.trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

/// Adds a table of aligned columns.
pub(super) fn table(text: &mut TerminalPage, columns: &str, header: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    aligned(columns, header, rows).iter().for_each(|line| text.line(line));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_draws_are_written_as_ranges() {
        assert_eq!(ranges(&[0, 1, 2, 5, 7, 8]), "0-2, 5, 7-8");
    }

    #[test]
    fn columns_are_aligned_and_empty_ones_left_out() {
        let mut text = TerminalPage::new();
        let rows = [["1", "", "a"], ["10", "", "bcd"]].map(|row| row.map(str::to_owned).to_vec());
        table(&mut text, "rll", &["n", "nothing", "word"], rows.into_iter());
        assert_eq!(text.for_terminal(), "   n  word\n   1  a\n  10  bcd\n");
    }
}
