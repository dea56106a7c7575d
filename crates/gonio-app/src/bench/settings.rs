//! The settings of the plot: kind, scale, angles.

use super::functions::BenchFunctions;
use crate::widgets::{NumberField, choice, dropdown, named_options, row, toggle};
use egui::Ui;
use gonio_language::tr;
use gonio_plot::{LARGEST_THETA_DEG, PlotKind, PlotScale, PlotSettings, PlottedAngle};

/// Shows the kinds of plot.
pub fn kinds(ui: &mut Ui, settings: &mut PlotSettings) {
    let options = named_options!(PlotKind);
    choice(ui, "plot-kind", tr!("bench-plot"), &mut settings.kind, &options, PlotKind::default());
}

/// Shows the settings that change this kind of plot.
pub fn show(ui: &mut Ui, settings: &mut PlotSettings, functions: &BenchFunctions) {
    let kind = settings.kind;
    let has_values = matches!(kind, PlotKind::Polar | PlotKind::Cartesian | PlotKind::Lobe | PlotKind::Slice);
    if has_values {
        row(ui, tr!("bench-scale"), tr!("bench-scale-of-the-values"), |ui| {
            choice(
                ui,
                "plot-scale",
                tr!("bench-scale"),
                &mut settings.scale,
                &named_options!(PlotScale),
                PlotScale::default(),
            );
        });
    }
    if kind == PlotKind::Cartesian {
        row(ui, tr!("bench-over"), tr!("bench-angle-along-the-horizontal-axis"), |ui| {
            dropdown(ui, "plot-over", tr!("bench-over"), &mut settings.over, &named_options!(PlottedAngle));
        });
    }
    if has_angle(settings) {
        let of = match kind {
            PlotKind::Samples => tr!("bench-angle-of-the-viewer-from-the"),
            PlotKind::Sphere => tr!("bench-angle-between-light-and-viewer"),
            _ => tr!("bench-angle-of-incidence-between-light-and"),
        };
        angle(ui, "theta", tr!("bench-incidence"), of, 0.0..=LARGEST_THETA_DEG, 45.0, &mut settings.theta_i_deg);
        let is_anisotropic = functions.list.iter().any(|f| f.is_shown && !f.named.bsdf.is_isotropic());
        if is_anisotropic && kind != PlotKind::Sphere {
            let tip = tr!("bench-azimuth-of-the-light-from-the");
            angle(ui, "phi", tr!("bench-azimuth"), tip, 0.0..=360.0, 0.0, &mut settings.phi_i_deg);
        }
    }
    if has_values {
        let tip = tr!("bench-plot-f-cos-angle-of-incidence");
        toggle(ui, "with-cosine", tr!("bench-times-cosine"), &mut settings.with_cosine, tip);
    }
}

/// Whether the plot changes with the angle of incidence.
fn has_angle(settings: &PlotSettings) -> bool {
    match settings.kind {
        PlotKind::Polar | PlotKind::Lobe | PlotKind::Sphere | PlotKind::Samples => true,
        PlotKind::Cartesian => !matches!(settings.over, PlottedAngle::ThetaI | PlottedAngle::ThetaD),
        PlotKind::Slice | PlotKind::Albedo | PlotKind::Reciprocity | PlotKind::Fresnel => false,
    }
}

fn angle(
    ui: &mut Ui,
    id: &str,
    label: &str,
    tip: &str,
    range: std::ops::RangeInclusive<f64>,
    default: f64,
    value: &mut f64,
) {
    row(ui, label, tip, |ui| {
        let field = NumberField::new(id, label).tip(tip).unit("°").range(range).default(default).width(64.0);
        field.show_with_slider(ui, value, false);
    });
}
