//! The factors of each light, and their products.

use super::{cell, number, vector_row};
use crate::session::Selection;
use crate::session::probing::Reading;
use crate::theme::{self, colors};
use egui::{Grid, RichText, Ui};
use gonio_language::tr;
use gonio_light::{LightTerms, Terms};
use gonio_reference::Probe;

/// Shows all lights: at the pixel, or where the shading evaluates the equation.
pub fn show(ui: &mut Ui, reading: &Reading, probe: &Probe, selection: Selection) {
    if let Some(sums) = &probe.interpolated {
        let at_corners = probe.at_vertices.len() == 3;
        for (number, terms) in probe.at_vertices.iter().enumerate() {
            let title = match (at_corners, probe.vertices.get(number)) {
                (true, Some(vertex)) => {
                    tr!(
                        "scene-corner-vertex-weight",
                        number = number,
                        vertex = vertex,
                        weight = format!("{:.4}", probe.barycentrics.to_array()[number % 3])
                    )
                }
                _ => tr!("scene-at-the-centroid-of-the-triangle").to_owned(),
            };
            super::heading(ui, &title);
            corner(ui, reading, terms, number);
        }
        super::heading(ui, if at_corners { tr!("scene-interpolated") } else { tr!("scene-light") });
        Grid::new("interpolated").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
            let (diffuse, specular) = (Some(colors::DIFFUSE.of(ui)), Some(colors::SPECULAR.of(ui)));
            vector_row(ui, tr!("scene-diffuse-light"), tr!("scene-sum-of-diff-n-l-i"), sums.diffuse, diffuse);
            vector_row(ui, tr!("scene-specular-light"), tr!("scene-sum-of-spec-i-l-i"), sums.specular, specular);
        });
        return;
    }
    for light in &probe.terms.lights {
        let title = reading.light_name(light.light);
        ui.add_space(10.0);
        let chosen = selection == Selection::Light(light.light);
        let color = if chosen { colors::ACCENT.of(ui) } else { ui.visuals().text_color() };
        ui.label(RichText::new(title).font(theme::bold(13.5)).color(color));
        factors(ui, light);
        products(ui, light);
    }
}

/// The factors of the equation, each below its symbol.
fn factors(ui: &mut Ui, light: &LightTerms) {
    Grid::new(("factors", light.light)).num_columns(5).spacing([6.0, 0.0]).show(ui, |ui| {
        let factors = [
            ("<N.L>", tr!("scene-cosine-of-the-angle-between-normal"), light.cos_theta.max(0.0)),
            ("att", tr!("scene-attenuation-with-distance"), light.attenuation),
            ("spot", tr!("scene-spot-cone-factor"), light.spot),
            ("diff", tr!("scene-1-or-1-pi-in-the"), light.diff),
            ("spec", tr!("scene-specular-factor-without-k-s"), light.spec),
        ];
        for (symbol, tip, _) in factors {
            super::flush_right(ui, RichText::new(symbol).small().weak()).on_hover_text(tip);
        }
        ui.end_row();
        for (_, _, value) in factors {
            cell(ui, value, None);
        }
        ui.end_row();
    });
    let mut facts = vec![format!("R.V {}", number(light.r_dot_v)), format!("N.H {}", number(light.n_dot_h))];
    if light.distance.is_finite() {
        facts.push(format!("d {}", number(light.distance)));
    }
    if light.cos_theta <= 0.0 {
        facts.push(tr!("scene-n-l-behind-the-surface", cos_theta = number(light.cos_theta)));
    }
    ui.label(RichText::new(facts.join("   ")).small().weak());
}

fn products(ui: &mut Ui, light: &LightTerms) {
    Grid::new(("products", light.light)).num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        let tint = |tint: colors::Tint| Some(tint.of(ui));
        let (of_light, diffuse, specular) = (tint(colors::LIGHT), tint(colors::DIFFUSE), tint(colors::SPECULAR));
        let (r, h) = (tint(colors::REFLECTION), tint(colors::HALF));
        vector_row(ui, "L", tr!("scene-to-the-light-world-space"), light.l, of_light);
        vector_row(ui, "R", tr!("scene-l-mirrored-about-n"), light.r, r);
        vector_row(ui, "H", tr!("scene-halfway-between-l-and-v"), light.h, h);
        vector_row(ui, "L_i att_i spot_i", tr!("scene-incident-light-linear-rgb"), light.incident, None);
        vector_row(ui, "diffuse", "diff k_d <N.L_i> L_i att_i spot_i", light.diffuse, diffuse);
        vector_row(ui, "specular", "k_s spec_i L_i att_i spot_i", light.specular, specular);
    });
}

/// The equation at one vertex, or at the centroid.
fn corner(ui: &mut Ui, reading: &Reading, terms: &Terms, number: usize) {
    Grid::new(("corner", number)).num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        vector_row(ui, "position", tr!("scene-world-space"), terms.point.position, None);
        vector_row(ui, "N", tr!("scene-the-normal-at-this-point"), terms.point.normal, Some(colors::NORMAL.of(ui)));
        for light in &terms.lights {
            let of = reading.light_name(light.light);
            let (diffuse, specular) = (colors::DIFFUSE.of(ui), colors::SPECULAR.of(ui));
            let factors = tr!(
                "scene-n-l-att-spot-spec",
                of = of,
                cos_theta = format!("{:.4}", light.cos_theta),
                attenuation = format!("{:.4}", light.attenuation),
                spot = format!("{:.4}", light.spot),
                spec = format!("{:.4}", light.spec)
            );
            vector_row(ui, &tr!("scene-diffuse", of = of), &factors, light.diffuse_light, Some(diffuse));
            vector_row(ui, &tr!("scene-specular", of = of), &factors, light.specular_light, Some(specular));
        }
    });
}
