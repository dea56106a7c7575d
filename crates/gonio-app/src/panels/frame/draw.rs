//! The selected draw: counts and state, samplers with units and textures, uniforms, attributes, program.

use super::{heading, primitives};
use crate::exported::{self, WidgetRole};
use crate::session::RecordedFrame;
use crate::theme::colors;
use egui::load::SizedTexture;
use egui::{CollapsingHeader, Grid, Image, Label, RichText, ScrollArea, TextStyle, Ui, vec2};
use gonio_gl::trace::{AttributeSource, DrawRecord, SamplerRecord, TextureRecord, UniformNumbers, UniformValue};
use gonio_language::tr;

/// Side of a thumbnail, points.
const THUMBNAIL: f32 = 44.0;
/// Most rows of an array that are shown.
const MOST_ROWS: usize = 16;

pub fn show(ui: &mut Ui, taken: &mut RecordedFrame) {
    let Some(draw) = taken.record.draws.get(taken.draw) else { return };
    heading(ui, &draw.title());
    facts(ui, draw);
    let samplers = CollapsingHeader::new(tr!("scene-samplers-units-textures", count = draw.samplers.len()));
    samplers.id_salt("samplers").default_open(true).show(ui, |ui| {
        if draw.samplers.is_empty() {
            ui.label(RichText::new(tr!("scene-this-draw-samples-no-texture")).weak());
        }
        draw.samplers.iter().for_each(|sampler| self::sampler(ui, taken, sampler));
    });
    let uniforms = CollapsingHeader::new(tr!("scene-uniforms", count = draw.uniforms.len()));
    uniforms.id_salt("uniforms").show(ui, |ui| draw.uniforms.iter().for_each(|value| uniform(ui, value)));
    let attributes = CollapsingHeader::new(tr!("scene-attributes", count = draw.attributes.len()));
    attributes.id_salt("attributes").show(ui, |ui| self::attributes(ui, draw));
    program(ui, taken);
}

fn facts(ui: &mut Ui, draw: &DrawRecord) {
    let state = &draw.state;
    let count = |count: Option<u64>| {
        count.map_or(tr!("scene-not-counted-by-this-driver").to_owned(), |count| count.to_string())
    };
    let depth = match (&state.depth_test, state.depth_mask) {
        (None, _) => tr!("scene-not-tested").to_owned(),
        (Some(test), true) => tr!("scene-written", test = test),
        (Some(test), false) => tr!("scene-not-written", test = test),
    };
    let cull = state.cull.as_ref().map_or(tr!("scene-nothing").to_owned(), |cull| {
        tr!("scene-front-is", cull = cull, front_face = state.front_face)
    });
    let blend = state.blend.as_ref();
    let blend = blend
        .map_or(tr!("scene-off").to_owned(), |blend| tr!("scene-and", first = blend.color[0], second = blend.color[1]));
    let [x, y, width, height] = state.viewport;
    Grid::new("draw facts").num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
        for (name, value) in [
            ("drawn", primitives(draw)),
            (tr!("scene-vertex-shader-runs"), count(draw.vertices_shaded)),
            (tr!("scene-fragment-shader-runs"), count(draw.fragments_shaded)),
            ("depth", depth),
            ("culled", cull),
            ("blending", blend),
            ("viewport", tr!("scene-x-from", width = width, height = height, x = x, y = y)),
        ] {
            ui.label(RichText::new(gonio_language::name(name)).weak());
            ui.add(Label::new(value).truncate());
            ui.end_row();
        }
    });
}

/// A sampler with its unit and texture, in the order of a lookup.
fn sampler(ui: &mut Ui, taken: &RecordedFrame, sampler: &SamplerRecord) {
    let texture = sampler.texture.and_then(|id| taken.record.texture(id));
    ui.horizontal(|ui| {
        let (place, _) = ui.allocate_exact_size(vec2(THUMBNAIL, THUMBNAIL), egui::Sense::hover());
        match texture.and_then(|texture| taken.thumbnail(texture.id)) {
            Some(thumbnail) => {
                let size = thumbnail.size_vec2();
                let scale = THUMBNAIL / size.max_elem().max(1.0);
                let rect = egui::Rect::from_center_size(place.center(), size * scale);
                Image::from_texture(SizedTexture::new(thumbnail.id(), size)).paint_at(ui, rect);
            }
            None => {
                ui.painter().rect_filled(place, 3.0, ui.visuals().faint_bg_color);
            }
        }
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 5.0;
                ui.label(RichText::new(&sampler.name).monospace().color(colors::ACCENT.of(ui)));
                ui.label(RichText::new(&sampler.glsl_type).small().weak());
            });
            let name = texture.map_or(tr!("scene-nothing").to_owned(), |texture| texture.name.clone());
            let id = sampler.texture.map_or(String::new(), |id| tr!("scene-texture", id = id));
            ui.add(Label::new(tr!("scene-reads-unit", unit = sampler.unit, id = id, name = name)).truncate());
            ui.add(Label::new(RichText::new(about(texture, sampler)).small().weak()).truncate());
        });
    })
    .response
    .on_hover_text(tr!("scene-the-sampler-holds-the-texture-unit", name = sampler.name, unit = sampler.unit));
}

fn about(texture: Option<&TextureRecord>, sampler: &SamplerRecord) -> String {
    let Some(texture) = texture else { return tr!("scene-no-texture-is-bound-to-this").to_owned() };
    let levels = if texture.levels.len() == 1 {
        tr!("scene-1-level").to_owned()
    } else {
        tr!("scene-levels", count = texture.levels.len())
    };
    let sampled = match &sampler.sampling {
        Some(sampling) => format!("{}, {}", sampling.min_filter, sampling.wrap[0]),
        None => tr!("scene-samples", samples = texture.samples),
    };
    format!("{} {} x {} {}, {levels}, {sampled}", texture.kind, texture.width, texture.height, texture.format)
}

fn uniform(ui: &mut Ui, uniform: &UniformValue) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        ui.label(RichText::new(&uniform.name).monospace());
        ui.label(RichText::new(&uniform.glsl_type).small().weak());
        if !uniform.sent {
            ui.label(RichText::new(tr!("scene-never-set")).small().color(colors::WARNING.of(ui)));
        }
    });
    let rows = rows(uniform);
    let rest = rows.len().saturating_sub(MOST_ROWS);
    ui.indent(&uniform.name, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for row in rows.iter().take(MOST_ROWS) {
            ui.add(Label::new(RichText::new(row).monospace().small()).extend());
        }
        if rest > 0 {
            ui.label(RichText::new(tr!("scene-and-more", rest = rest)).small().weak());
        }
    });
}

/// Matrices row by row, arrays element by element.
fn rows(uniform: &UniformValue) -> Vec<String> {
    let kind = uniform.glsl_type.as_str();
    let number = |v: f32| match v.abs() {
        0.0 => format!("{:>10}", "0"),
        size if (1e-3..1e5).contains(&size) => format!("{v:>10.4}"),
        _ => format!("{v:>10.2e}"),
    };
    match &uniform.value {
        UniformNumbers::Float(values) => {
            let sides: Vec<usize> = kind
                .strip_prefix("mat")
                .into_iter()
                .flat_map(|s| s.split('x'))
                .filter_map(|s| s.parse().ok())
                .collect();
            if let (Some(&columns), Some(&height)) = (sides.first(), sides.last()) {
                // OpenGL stores columns.
                let entry = |row: usize, column: usize| values.get(column * height + row).copied().unwrap_or(f32::NAN);
                return (0..height).map(|row| (0..columns).map(|c| number(entry(row, c))).collect()).collect();
            }
            let each = kind.strip_prefix("vec").and_then(|n| n.parse().ok()).unwrap_or(1);
            values.chunks(each).map(|element| element.iter().copied().map(number).collect()).collect()
        }
        UniformNumbers::Int(values) => vec![values.iter().map(|v| format!("{v:>10}")).collect()],
        UniformNumbers::Uint(values) => vec![values.iter().map(|v| format!("{v:>10}")).collect()],
        UniformNumbers::Bool(values) => vec![values.iter().map(|v| format!("{v:>10}")).collect()],
    }
}

fn attributes(ui: &mut Ui, draw: &DrawRecord) {
    if draw.attributes.is_empty() {
        ui.label(RichText::new(tr!("scene-none-the-vertex-shader-computes-the")).weak());
    }
    for attribute in &draw.attributes {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 5.0;
            ui.label(RichText::new(format!("{} {}", attribute.location, attribute.name)).monospace());
            ui.label(RichText::new(&attribute.glsl_type).small().weak());
        });
        let fed = match &attribute.source {
            AttributeSource::Array(array) => array.to_string(),
            AttributeSource::Constant { value: [x, y, z, w], .. } => {
                tr!("scene-for-all-vertices", x = x, y = y, z = z, w = w)
            }
        };
        ui.indent(&attribute.name, |ui| ui.add(Label::new(RichText::new(fed).small().weak()).truncate()));
    }
}

/// Height of the source, points.
const SOURCE_HEIGHT: f32 = 320.0;

/// The draw's program, with its GLSL.
fn program(ui: &mut Ui, taken: &mut RecordedFrame) {
    let draw = taken.record.draws.get(taken.draw);
    let Some(program) = draw.and_then(|draw| taken.record.program_of(draw)) else { return };
    let mut fragment = taken.fragment_source;
    CollapsingHeader::new(tr!("scene-program")).id_salt("program").show(ui, |ui| {
        ui.add(Label::new(RichText::new(&program.name).weak()).wrap());
        ui.horizontal(|ui| {
            for (is_fragment, id, title) in [
                (false, "source-vertex", tr!("scene-vertex-shader")),
                (true, "source-fragment", tr!("scene-fragment-shader")),
            ] {
                let button = ui.selectable_label(fragment == is_fragment, title);
                exported::note(ui, &button, id, WidgetRole::Choice, title, fragment == is_fragment);
                if button.clicked() {
                    fragment = is_fragment;
                }
            }
        });
        let source = if fragment { &program.fragment_source } else { &program.vertex_source };
        let lines: Vec<&str> = source.lines().collect();
        let height = ui.text_style_height(&TextStyle::Monospace);
        ui.spacing_mut().item_spacing.y = 0.0;
        // Only visible lines are laid out, because there are hundreds.
        ScrollArea::both()
            .id_salt(("source", fragment))
            .max_height(SOURCE_HEIGHT)
            .auto_shrink([false, true])
            .show_rows(ui, height, lines.len(), |ui, range| {
                for number in range {
                    let line = lines.get(number).copied().unwrap_or_default();
                    ui.add(Label::new(RichText::new(format!("{:>4}  {line}", number + 1)).monospace()).extend());
                }
            });
    });
    taken.fragment_source = fragment;
}
