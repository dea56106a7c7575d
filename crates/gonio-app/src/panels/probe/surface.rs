//! The surface at the pixel: object, triangle, material, texels, normals, and light of the environment.

use super::{fact, heading, swatch};
use super::{number, vector_row};
use crate::session::probing::Reading;
use crate::theme::colors;
use egui::{Grid, RichText, Ui};
use glam::DVec3;
use gonio_language::tr;
use gonio_light::Fresnel;
use gonio_light::color::srgb_encode;
use gonio_reference::Probe;

pub fn show(ui: &mut Ui, reading: &Reading, probe: &Probe) {
    heading(ui, tr!("scene-surface"));
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        facts(ui, probe);
    });
    ui.add_space(4.0);
    Grid::new("surface vectors").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        let terms = &probe.terms;
        vector_row(ui, "position", tr!("scene-world-space"), probe.position, None);
        vector_row(ui, "N", tr!("scene-the-shading-normal"), terms.point.normal, Some(colors::NORMAL.of(ui)));
        vector_row(
            ui,
            tr!("scene-n-geometric"),
            tr!("scene-normal-of-the-triangle"),
            probe.geometry.geometric_normal,
            None,
        );
        vector_row(ui, "V", tr!("scene-to-the-eye"), terms.point.view, Some(colors::VIEW.of(ui)));
    });
    heading(ui, &tr!("scene-material-2", material_name = probe.material_name));
    Grid::new("material").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        let surface = &probe.surface;
        vector_row(ui, "k_a", tr!("scene-ambient"), surface.ambient, Some(colors::AMBIENT.of(ui)));
        vector_row(ui, "k_d", tr!("scene-diffuse-textures-included"), surface.diffuse, Some(colors::DIFFUSE.of(ui)));
        vector_row(ui, "k_s", tr!("scene-specular-textures-included"), surface.specular, Some(colors::SPECULAR.of(ui)));
        vector_row(ui, "E", tr!("scene-emitted"), surface.emitted, Some(colors::EMITTED.of(ui)));
    });
    let shininess = number(probe.surface.shininess);
    let text = tr!(
        "scene-shininess-index-of-refraction",
        shininess = shininess,
        refraction_index = number(probe.surface.refraction_index)
    );
    ui.label(RichText::new(text).small().weak());
    texels(ui, probe);
    environment(ui, reading, probe);
}

fn facts(ui: &mut Ui, probe: &Probe) {
    let part = if probe.part_name.is_empty() { String::new() } else { tr!("scene-part", part_name = probe.part_name) };
    fact(ui, "object", format!("{}{part}", probe.object_name));
    let [a, b, c] = probe.vertices;
    fact(ui, "triangle", tr!("scene-of-vertices", triangle = probe.triangle, a = a, b = b, c = c));
    let w = probe.barycentrics;
    fact(ui, "weights", format!("{:.4}, {:.4}, {:.4}", w.x, w.y, w.z));
    let side = match (probe.front_facing, probe.normal_turned) {
        (true, _) => tr!("scene-front"),
        (false, true) => tr!("scene-back-n-flipped-towards-the-viewer"),
        (false, false) => tr!("scene-back"),
    };
    fact(ui, "side", side);
    fact(ui, "shading", gonio_language::name(probe.shading.name()));
    fact(ui, "depth", number(probe.depth));
    fact(ui, "uv", format!("{}, {}", number(probe.geometry.uv.x), number(probe.geometry.uv.y)));
    if probe.opacity < 1.0 || probe.surfaces_behind > 0 {
        let behind = probe.surfaces_behind;
        fact(ui, "opacity", tr!("scene-surfaces-visible-through-it", opacity = number(probe.opacity), behind = behind));
    }
}

/// The textures that were read.
fn texels(ui: &mut Ui, probe: &Probe) {
    for texel in &probe.texels {
        ui.horizontal(|ui| {
            let v = DVec3::new(texel.value.x, texel.value.y, texel.value.z);
            let shown = match texel.map {
                // Data textures are not encoded.
                "normal" | "shininess" | "opacity" => v,
                _ => v.map(srgb_encode),
            };
            swatch(ui, shown.to_array().map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
            ui.label(texel.map);
            ui.add(egui::Label::new(RichText::new(&texel.texture).weak()).truncate()).on_hover_text(&texel.texture);
        });
        let value = texel.value.to_array().map(number).join(" ");
        let place = tr!("scene-at", value = value, x = number(texel.uv.x), y = number(texel.uv.y));
        ui.label(RichText::new(place).monospace().size(11.0).weak());
    }
}

/// Light of the environment, if any.
fn environment(ui: &mut Ui, reading: &Reading, probe: &Probe) {
    let (Some(environment), Some(how)) = (&reading.loaded.environment, reading.frame.surroundings) else { return };
    if probe.optics.is_plain() && !how.lights {
        return;
    }
    heading(ui, &tr!("scene-environment-2", name = environment.name));
    let seen = &probe.terms.environment;
    Grid::new("environment").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        let tint = Some(colors::ENVIRONMENT.of(ui));
        if how.lights {
            vector_row(ui, "diffuse", tr!("scene-k-d-times-the-irradiance-about"), seen.diffuse, tint);
            vector_row(ui, "specular", tr!("scene-its-glossy-reflection"), seen.specular, tint);
        }
        if !probe.optics.is_plain() {
            vector_row(ui, "R", tr!("scene-v-mirrored-about-n"), seen.sight.reflection, None);
            vector_row(ui, "E(R)", tr!("scene-reflected-environment"), seen.sight.reflected, tint);
            vector_row(ui, "(1-F) tint E(T)", tr!("scene-refracted-environment"), seen.sight.transmitted, tint);
            vector_row(ui, "F", tr!("scene-fresnel-reflectance-per-channel"), seen.sight.fresnel, None);
        }
    });
    if !probe.optics.is_plain() {
        let fresnel = match probe.optics.fresnel {
            Fresnel::None => tr!("scene-no-fresnel"),
            Fresnel::Exact => tr!("scene-exact-fresnel"),
            Fresnel::Schlick => tr!("scene-schlick-s-fresnel"),
        };
        let share = number(probe.optics.mirror_share(seen.sight.fresnel.y));
        let text = tr!(
            "scene-mirror-transmission",
            share = share,
            transmission = number(probe.optics.transmission),
            fresnel = fresnel
        );
        ui.label(RichText::new(text).small().weak());
    }
}
