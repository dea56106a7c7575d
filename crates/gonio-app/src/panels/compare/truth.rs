//! The traced picture of a pane, and its simplifications: a slider along the lecture's steps, and a switch for each of them.

use crate::document::{Pane, TruthSettings};
use crate::exported::{self, WidgetRole};
use egui::{RichText, Ui};
use gonio_language::tr;
use gonio_light::Simplification;

/// Shows whether the pane is traced, and then its settings.
pub fn show(ui: &mut Ui, pane: &mut Pane) {
    let mut is_traced = pane.truth.is_some();
    let traced = ui.checkbox(&mut is_traced, tr!("scene-traced-the-rendering-equation"));
    exported::note(ui, &traced, "pane-traced", WidgetRole::Toggle, tr!("scene-traced"), is_traced);
    if traced.changed() {
        pane.show_truth(is_traced.then(TruthSettings::default));
    }
    let Some(truth) = &mut pane.truth else { return };
    let about = tr!("scene-error-the-noise-of-a-pixel");
    ui.label(RichText::new(about).small().weak());
    steps(ui, truth);
    if truth.simplified.contains(Simplification::Sum) {
        let slider = egui::Slider::new(&mut truth.points_per_light, 1..=64)
            .logarithmic(true)
            .text(tr!("scene-points-per-lamp-2"));
        let slider = ui.add(slider).on_hover_text(tr!("scene-point-lights-that-replace-each-lamp"));
        exported::note(
            ui,
            &slider,
            "truth-points",
            WidgetRole::Number,
            tr!("scene-points-per-lamp"),
            truth.points_per_light,
        );
    }
    ui.separator();
}

fn steps(ui: &mut Ui, truth: &mut TruthSettings) {
    let steps = Simplification::ALL;
    // The number of steps up to which all are made.
    let mut made = steps.iter().take_while(|&&step| truth.simplified.contains(step)).count();
    ui.label(tr!("scene-simplified-step-by-step-to-the"));
    ui.horizontal(|ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 80.0).clamp(60.0, 240.0);
        let slider = ui.add(egui::Slider::new(&mut made, 0..=steps.len()).show_value(false));
        let slider = slider.on_hover_text(tr!("scene-makes-all-simplifications-up-to-this"));
        exported::note(ui, &slider, "truth-step", WidgetRole::Number, tr!("scene-step-2"), made);
        let last = made.checked_sub(1).and_then(|last| steps.get(last));
        ui.label(last.map_or(tr!("scene-the-truth").to_owned(), |last| tr!("scene-step", heading = last.heading().0)));
        if slider.changed() {
            truth.simplified = steps.iter().take(made).copied().collect();
        }
    });
    for &one in steps {
        let mut is_made = truth.simplified.contains(one);
        let (number, title) = one.heading();
        let about = gonio_language::name(one.description().trim());
        let response = ui.checkbox(&mut is_made, format!("{number}  {title}")).on_hover_text(about);
        exported::note(ui, &response, &format!("truth-{one}"), WidgetRole::Toggle, about, is_made);
        if response.changed() {
            truth.simplified = if is_made { truth.simplified.with(one) } else { truth.simplified.without(one) };
        }
    }
}
