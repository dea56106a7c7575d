//! A stacked bar for each light, on one scale, with its terms.

use super::{number, triple};
use crate::session::probing::Reading;
use crate::theme::colors::{AMBIENT, DIFFUSE, EMITTED, ENVIRONMENT, SPECULAR, Tint};
use egui::{Rect, RichText, Sense, Ui, vec2};
use glam::DVec3;
use gonio_language::{name, tr};
use gonio_reference::Probe;

/// Luminance weights of sRGB's primaries (IEC 61966-2-1).
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// A stacked bar.
struct Bar {
    name: String,
    parts: Vec<(&'static str, Tint, DVec3)>,
}

impl Bar {
    fn length(&self) -> f64 {
        self.parts.iter().map(|(_, _, light)| LUMINANCE.dot(*light).max(0.0)).sum()
    }
}

/// The contributions to the pixel's light.
fn bars(reading: &Reading, probe: &Probe) -> Vec<Bar> {
    let terms = &probe.terms;
    let mut bars = Vec::new();
    let mut bar = |title: String, parts: Vec<(&'static str, Tint, DVec3)>| bars.push(Bar { name: title, parts });
    bar("A".into(), vec![("ambient", AMBIENT, terms.ambient)]);
    if terms.emitted != DVec3::ZERO {
        bar("E".into(), vec![("emitted", EMITTED, terms.emitted)]);
    }
    if let Some(sums) = &probe.interpolated {
        let (diffuse, specular) = (probe.surface.diffuse * sums.diffuse, probe.surface.specular * sums.specular);
        bar(name("lights").into(), vec![("diffuse", DIFFUSE, diffuse), ("specular", SPECULAR, specular)]);
    } else {
        for light in &terms.lights {
            let parts = vec![("diffuse", DIFFUSE, light.diffuse), ("specular", SPECULAR, light.specular)];
            bar(reading.light_name(light.light), parts);
        }
    }
    let around = &terms.environment;
    if around.diffuse + around.specular != DVec3::ZERO {
        let parts = vec![("diffuse", DIFFUSE, around.diffuse), ("specular", SPECULAR, around.specular)];
        bar(name("environment").into(), parts);
    }
    if !probe.optics.is_plain() {
        // The reflected and transmitted light is what the lit surface does not account for.
        let (mirror, through) = (probe.optics.mirror_share(around.sight.fresnel.y), probe.optics.transmission);
        let own = (1.0 - through) * (1.0 - mirror) * (probe.lit + around.diffuse + around.specular);
        bar(tr!("scene-mirror-and-glass").into(), vec![("seen", ENVIRONMENT, (probe.radiance - own).max(DVec3::ZERO))]);
    }
    bars
}

pub fn show(ui: &mut Ui, reading: &Reading, probe: &Probe) {
    let bars = bars(reading, probe);
    let longest = bars.iter().map(Bar::length).fold(1e-12, f64::max);
    for bar in &bars {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            let name = egui::Label::new(RichText::new(&bar.name).small()).truncate();
            ui.allocate_ui(vec2(84.0, 16.0), |ui| {
                ui.set_min_width(84.0);
                ui.add(name);
            });
            let room = vec2((ui.available_width() - 58.0).max(40.0), 12.0);
            let (rect, response) = ui.allocate_exact_size(room, Sense::hover());
            ui.painter().rect_filled(rect, 3.0, ui.visuals().faint_bg_color);
            let mut left = rect.left();
            for (_, tint, light) in &bar.parts {
                let width = rect.width() * (LUMINANCE.dot(*light).max(0.0) / longest) as f32;
                let part = Rect::from_min_size(egui::pos2(left, rect.top()), vec2(width, rect.height()));
                ui.painter().rect_filled(part, 2.0, tint.of(ui));
                left += width;
            }
            ui.monospace(RichText::new(number(bar.length())).size(11.5));
            let lines: Vec<String> =
                bar.parts.iter().map(|(name, _, light)| format!("{name}: {}", triple(*light))).collect();
            response.on_hover_text(tr!("scene-bar-length-luminance", n = lines.join("\n")));
        });
    }
    legend(ui);
}

fn legend(ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (name, tint) in [("ambient", AMBIENT), ("diffuse", DIFFUSE), ("specular", SPECULAR)] {
            let (rect, _) = ui.allocate_exact_size(vec2(9.0, 9.0), Sense::hover());
            ui.painter().rect_filled(rect, 2.0, tint.of(ui));
            ui.label(RichText::new(gonio_language::name(name)).small().weak());
            ui.add_space(4.0);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_reference::ReferenceScene;
    use gonio_scene::files::Disk;
    use gonio_scene::{Frame, load};
    use std::path::Path;
    use std::sync::Arc;

    /// The bars add up to the pixel's light: nothing is left out or counted twice.
    #[test]
    fn the_bars_add_up_to_the_light() {
        for input in ["builtin:still-life", "builtin:sphere-smooth"] {
            let described = load::describe(&[input], &Disk).unwrap_or_else(|error| panic!("{error}"));
            let loaded = load::load(described, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"));
            let frame = Frame { width: 60, height: 40, samples: 1, ..loaded.frame(0.0) };
            let probe = ReferenceScene::new(&loaded).probe(&frame, 30, 20);
            let probe = probe.unwrap_or_else(|| panic!("{input}: the middle is hit"));
            let reading = Reading {
                x: 30,
                y: 20,
                width: 60,
                height: 40,
                probe: Some(probe.clone()),
                reference: probe.total.to_array(),
                displayed: [0; 3],
                gpu: None,
                frame,
                loaded: Arc::new(loaded),
            };
            let sum: f64 = bars(&reading, &probe).iter().map(Bar::length).sum();
            // Rounding only.
            assert!((sum - LUMINANCE.dot(probe.radiance)).abs() < 1e-9, "{input}: {sum} for {}", probe.radiance);
        }
    }
}
