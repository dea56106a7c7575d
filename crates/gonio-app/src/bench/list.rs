//! The list of functions: for each its colour, and its parameters as sliders.

use super::functions::BenchFunctions;
use crate::exported::{self, WidgetRole};
use crate::theme::{self, colors, icons, touch};
use crate::widgets::{self, icon_button};
use egui::{Color32, CornerRadius, Frame, Label, Margin, RichText, Sense, Ui, Vec2, WidgetInfo};
use gonio_bsdf::{BsdfSource, DVec3, Parameter, ParameterValues};
use gonio_language::tr;
use gonio_plot::{PlotTheme, palette};

/// Shows the list.
pub fn show(ui: &mut Ui, functions: &mut BenchFunctions) {
    let mut removed = None;
    for index in 0..functions.list.len() {
        let changed = card(ui, functions, index, &mut removed);
        if let Some(values) = changed {
            functions.set_values(index, values);
        }
        ui.add_space(4.0);
    }
    if let Some(index) = removed {
        functions.remove(index);
    }
    if functions.list.is_empty() {
        let sentence = tr!("bench-add-a-model-or-open-a");
        ui.add(Label::new(RichText::new(sentence).weak()).wrap());
    }
}

/// Shows a function. Returns its values if they were changed.
fn card(
    ui: &mut Ui,
    functions: &mut BenchFunctions,
    index: usize,
    removed: &mut Option<usize>,
) -> Option<ParameterValues> {
    let is_chosen = functions.chosen == index;
    let function = functions.list.get_mut(index)?;
    let mut values = function.named.values.clone();
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(CornerRadius::same(7));
    let mut is_picked = false;
    frame.inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let theme = if ui.visuals().dark_mode { PlotTheme::Dark } else { PlotTheme::Light };
            let series = palette(theme).series;
            let [red, green, blue] = series[function.color % series.len()];
            let shade = Color32::from_rgb(red, green, blue);
            shown(ui, index, shade, &mut function.is_shown);
            let caret = if function.is_unfolded { icons::CARET_DOWN } else { icons::CARET_RIGHT };
            if icon_button(ui, &format!("unfold-{index}"), caret, tr!("bench-show-or-hide-the-parameters")).clicked() {
                function.is_unfolded = !function.is_unfolded;
            }
            let width = (ui.available_width() - 28.0).max(20.0);
            let name = title_of(&function.named);
            ui.scope(|ui| {
                ui.set_max_width(width);
                let color = if is_chosen { colors::ACCENT.of(ui) } else { ui.visuals().strong_text_color() };
                let text = RichText::new(&name).font(theme::bold(13.0)).color(color);
                let label = ui.add(Label::new(text).truncate().sense(Sense::click()));
                exported::note(ui, &label, &format!("function-{index}"), WidgetRole::Button, &name, is_chosen);
                let tip = tr!("bench-click-check-this-function", title = function.named.title);
                is_picked = label.on_hover_text(tip).clicked();
            });
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if icon_button(ui, &format!("remove-{index}"), icons::X, tr!("bench-remove-this-function")).clicked() {
                    *removed = Some(index);
                }
            });
        });
        if function.is_unfolded {
            parameters(ui, index, &mut values);
            about(ui, &function.named.source, &function.named.title);
        }
        if let Some(error) = &function.error {
            ui.add(Label::new(RichText::new(error).small().color(colors::ERROR.of(ui))).wrap());
        }
    });
    let changed = values != function.named.values;
    if is_picked || changed {
        functions.chosen = index;
    }
    changed.then_some(values)
}

/// The name in the list: without the values, which are below.
fn title_of(named: &gonio_bsdf::NamedBsdf) -> String {
    match named.source {
        BsdfSource::Model(model) if named.name.split(':').next() == Some(model.name) => model.name.to_owned(),
        _ => named.name.clone(),
    }
}

/// A line in the function's colour that shows and hides it.
fn shown(ui: &mut Ui, index: usize, color: Color32, is_shown: &mut bool) {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(touch::least(ui).max(22.0)), Sense::click());
    if response.clicked() {
        *is_shown = !*is_shown;
    }
    let square = rect.shrink(4.0);
    if *is_shown {
        ui.painter().rect_filled(square, 3.0, color);
    } else {
        ui.painter().rect_stroke(square, 3.0, egui::Stroke::new(1.5, color), egui::StrokeKind::Inside);
    }
    let tip = if *is_shown { tr!("bench-shown-hide-it") } else { tr!("bench-hidden-show-it") };
    response.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, true, *is_shown, tip));
    exported::note(ui, &response, &format!("shown-{index}"), WidgetRole::Toggle, tip, *is_shown);
    response.on_hover_text(tip);
}

fn parameters(ui: &mut Ui, index: usize, values: &mut ParameterValues) {
    let parameters: Vec<(Parameter, DVec3)> = values.iter().map(|(p, value)| (p.clone(), value)).collect();
    for (parameter, value) in parameters {
        let id = format!("parameter-{index}-{}", parameter.name);
        if let Some(changed) = widgets::parameter(ui, &id, &parameter, value) {
            values.set_value(&parameter.name, changed);
        }
    }
    if values.parameters().is_empty() {
        ui.label(RichText::new(tr!("bench-no-parameters")).weak());
    }
}

/// Formula, source and remark of a model.
fn about(ui: &mut Ui, source: &BsdfSource, title: &str) {
    let weak = |ui: &mut Ui, text: &str| {
        if !text.is_empty() {
            ui.add(Label::new(RichText::new(text).small().weak()).wrap());
        }
    };
    weak(ui, title);
    if let BsdfSource::Model(model) = source {
        let formula = RichText::new(model.formula).small().family(egui::FontFamily::Monospace);
        ui.add(Label::new(formula).wrap());
        weak(ui, model.source);
        weak(ui, model.remark);
    }
}
