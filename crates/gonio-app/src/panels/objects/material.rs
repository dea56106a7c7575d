//! Material values that override those of the model's file, and can be reset.

use crate::exported::{self, WidgetRole};
use crate::theme::icons;
use crate::widgets::{NumberField, color, dropdown, named_options, row, spectrum, tool_button};
use egui::{Align, Layout, RichText, Ui};
use gonio_language::tr;
use gonio_light::optics::Medium;
use gonio_light::{Fresnel, Spectrum, Surfaces};
use gonio_mesh::{AmbientRule, Material};
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::MaterialOverride;
use std::ops::RangeInclusive;

/// Width of the reset button, points.
const RESET: f32 = 26.0;

/// Id, label and tooltip of a row.
struct Line<'a> {
    id: String,
    label: &'a str,
    tip: &'a str,
}

/// Shows the values of `with`, which replace those of `below`, and these those of `files`, the materials of the model's file. `index`
/// is the object's number.
pub fn show(ui: &mut Ui, with: &mut MaterialOverride, below: &MaterialOverride, files: &[&Material], index: usize) {
    let first = files.first().copied().cloned().unwrap_or_default();
    match files {
        [] => {}
        [one] => drop(ui.label(RichText::new(tr!("scene-in-the-file", one = named(one))).small().weak())),
        [one, rest @ ..] => {
            let text = tr!("scene-and-more-in-the-file-changes", one = named(one), count = rest.len());
            ui.label(RichText::new(text).small().weak());
        }
    }
    let line =
        |name: &str, label: &'static str, tip: &'static str| Line { id: format!("object-{index}-{name}"), label, tip };
    let color_of = |c: [f32; 3]| Color(c.map(tidy));
    let ambient = match first.ambient {
        AmbientRule::FollowsDiffuse => first.diffuse,
        AmbientRule::Value(value) => value,
    };
    colored(
        ui,
        &line("ambient", "k_a", tr!("scene-ambient-colour-k-a-linear-rgb")),
        &mut with.ambient,
        color_of(ambient),
    );
    colored(
        ui,
        &line("diffuse", "k_d", tr!("scene-diffuse-colour-k-d-linear-rgb")),
        &mut with.diffuse,
        color_of(first.diffuse),
    );
    if let Some(samples) = &with.diffuse_spectrum {
        let tip = tr!("scene-reflectance-by-wavelength-0-to-1");
        let own = Spectrum::new(samples.clone());
        row(ui, tr!("scene-spectrum"), tip, |ui| {
            let plot = spectrum(ui, |lambda| own.reflectance_at(lambda), Some(1.0), tip);
            let id = format!("object-{index}-spectrum");
            exported::note(ui, &plot, &id, WidgetRole::Picture, "spectrum", samples.len());
        });
    }
    colored(
        ui,
        &line("specular", "k_s", tr!("scene-specular-colour-k-s-linear-rgb")),
        &mut with.specular,
        color_of(first.specular),
    );
    colored(
        ui,
        &line("emitted", "E", tr!("scene-emitted-light-linear-rgb")),
        &mut with.emitted,
        color_of(first.emitted),
    );
    let shininess = line("shininess", "g", tr!("scene-shininess-g-the-exponent-of-the"));
    number(ui, &shininess, &mut with.shininess, tidy(first.shininess), 1.0..=1e6);
    let opacity = line("opacity", tr!("scene-opacity"), tr!("scene-1-is-opaque-0-invisible"));
    number(ui, &opacity, &mut with.opacity, tidy(first.opacity), 0.0..=1.0);
    let textures = line("textures", tr!("scene-textures"), tr!("scene-whether-the-model-s-textures-are"));
    let options = [(None, tr!("scene-as-in-the-file-2"), ""), (Some(false), "none", tr!("scene-ignore-the-textures"))];
    words(ui, &textures, &mut with.textures, &options);
    optics(ui, with, below, &first, &line);
}

/// Whether the material reflects or refracts its surroundings.
pub fn mirrors_surroundings(with: &MaterialOverride) -> bool {
    let positive = |value: Option<f64>| value.is_some_and(|value| value > 0.0);
    with.medium.is_some() || positive(with.reflectivity) || positive(with.transmission)
}

fn named(material: &Material) -> &str {
    if material.name.is_empty() { tr!("scene-unnamed") } else { &material.name }
}

/// Reflection and refraction.
fn optics<'a>(
    ui: &mut Ui,
    with: &mut MaterialOverride,
    below: &MaterialOverride,
    first: &Material,
    line: &dyn Fn(&str, &'static str, &'static str) -> Line<'a>,
) {
    let usual = below.medium.map_or(("none", tr!("scene-an-opaque-surface")), |m| (m.name(), m.description()));
    let mut media = vec![(None, usual.0, usual.1)];
    media.extend(Medium::ALL.iter().map(|m| (Some(*m), m.name(), m.description())));
    words(
        ui,
        &line("medium", tr!("scene-medium"), tr!("scene-a-transparent-body-of-this-medium")),
        &mut with.medium,
        &media,
    );
    let medium = with.medium.or(below.medium);
    let clear = medium.is_some();
    let index = medium.map_or(tidy(first.refraction_index), Medium::refraction_index);
    let refraction = line("refraction-index", tr!("scene-index"), tr!("scene-index-of-refraction-air-1"));
    number(ui, &refraction, &mut with.refraction_index, index, 0.01..=100.0);
    let reflectivity = line("reflectivity", tr!("scene-reflectivity"), tr!("scene-0-is-the-lit-surface-1"));
    number(ui, &reflectivity, &mut with.reflectivity, below.reflectivity.unwrap_or(0.0), 0.0..=1.0);
    let transmission = line("transmission", tr!("scene-transmission"), tr!("scene-0-is-opaque-1-transparent"));
    let usual = below.transmission.unwrap_or(if clear { 1.0 } else { 0.0 });
    number(ui, &transmission, &mut with.transmission, usual, 0.0..=1.0);
    let usual = below.fresnel.unwrap_or(if clear { Fresnel::Exact } else { Fresnel::None });
    let usual = match usual {
        Fresnel::Exact => tr!("scene-default-exact"),
        Fresnel::Schlick => tr!("scene-default-schlick"),
        Fresnel::None => tr!("scene-default-none"),
    };
    let mut factors = vec![(None, usual, tr!("scene-exact-for-a-medium-none-for"))];
    factors.extend(named_options!(Fresnel).into_iter().map(|(f, name, tip)| (Some(f), name, tip)));
    words(
        ui,
        &line("fresnel", tr!("scene-fresnel"), tr!("scene-dependence-of-the-reflection-on-the")),
        &mut with.fresnel,
        &factors[..],
    );
    let white = Color::grey(1.0);
    colored(
        ui,
        &line("tint", tr!("scene-tint"), tr!("scene-colour-of-the-transmitted-light-0")),
        &mut with.tint,
        below.tint.unwrap_or(white),
    );
    if let Some(tint) = &mut with.tint {
        // A body transmits at most the incident light.
        tint.0 = tint.0.map(|v| v.min(1.0));
    }
    let absorption = line("absorption", tr!("scene-absorption"), tr!("scene-per-world-unit-and-channel-between"));
    colored(ui, &absorption, &mut with.absorption, below.absorption.unwrap_or(Color::grey(0.0)));
    let dispersion = line("dispersion", tr!("scene-dispersion"), tr!("scene-index-of-refraction-for-blue-light"));
    number(ui, &dispersion, &mut with.dispersion, below.dispersion.unwrap_or(0.0), -1.0..=1.0);
    let usual = if below.surfaces == Some(Surfaces::Two) { tr!("scene-default-two") } else { tr!("scene-default-one") };
    let mut surfaces = vec![(None, usual, tr!("scene-as-in-the-lab"))];
    surfaces.extend(named_options!(Surfaces).into_iter().map(|(s, name, tip)| (Some(s), name, tip)));
    words(
        ui,
        &line("surfaces", tr!("scene-surfaces"), tr!("scene-number-of-surfaces-at-which-light")),
        &mut with.surfaces,
        &surfaces,
    );
}

/// Converts an f32 without adding digits.
fn tidy(v: f32) -> f64 {
    v.to_string().parse().unwrap_or(f64::from(v))
}

/// A row with a button that resets it to the file's value; the button is disabled if nothing was changed.
fn with_reset<T>(ui: &mut Ui, line: &Line<'_>, value: &mut Option<T>, show: impl FnOnce(&mut Ui, &mut Option<T>)) {
    row(ui, line.label, line.tip, |ui| {
        let width = ui.available_width() - RESET;
        ui.scope(|ui| {
            ui.set_max_width(width);
            if value.is_none() {
                ui.multiply_opacity(0.72);
            }
            show(ui, value);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let changed = value.is_some();
            let tip = if changed { tr!("scene-reset-to-the-value-in-the") } else { tr!("scene-as-in-the-file") };
            let id = format!("{}-reset", line.id);
            if tool_button(ui, &id, icons::ARROW_COUNTER_CLOCKWISE, tip, None, changed).clicked() {
                *value = None;
            }
        });
    });
}

fn colored(ui: &mut Ui, line: &Line<'_>, value: &mut Option<Color>, file: Color) {
    with_reset(ui, line, value, |ui, value| {
        let mut shown = value.unwrap_or(file);
        if color(ui, &line.id, line.label, &mut shown, Some(file), line.tip) {
            *value = (shown != file).then_some(shown);
        }
    });
}

fn number(ui: &mut Ui, line: &Line<'_>, value: &mut Option<f64>, file: f64, range: RangeInclusive<f64>) {
    with_reset(ui, line, value, |ui, value| {
        let before = value.unwrap_or(file);
        let mut shown = before;
        NumberField::new(&line.id, line.label).tip(line.tip).range(range).default(file).show(ui, &mut shown);
        if shown != before {
            *value = (shown != file).then_some(shown);
        }
    });
}

fn words<T: Copy + PartialEq>(
    ui: &mut Ui,
    line: &Line<'_>,
    value: &mut Option<T>,
    options: &[(Option<T>, &str, &str)],
) {
    with_reset(ui, line, value, |ui, value| {
        dropdown(ui, &line.id, line.label, value, options);
    });
}
