//! The law of the chosen station: its plot and its checks.

use super::work::RoomWork;
use crate::bench::paint;
use crate::exported::{self, WidgetRole};
use crate::theme::{colors, icons};
use crate::widgets::{compact, heading};
use egui::{Label, RichText, Sense, Ui, WidgetInfo, vec2};
use gonio_beyond::{LawCheck, StationDescription};
use gonio_language::tr;

/// Shows the plot.
pub fn plot(ui: &mut Ui, description: &StationDescription, work: &mut RoomWork) {
    let width = ui.available_width().max(120.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, (1.05 * width).min(440.0)), Sense::hover());
    work.plot_size = [rect.width() as u32, rect.height() as u32];
    let name = tr!("bench-the-law-of", title = description.title);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &name));
    exported::note(ui, &response, "station-plot", WidgetRole::Picture, &name, work.plot_serial);
    match &work.plot {
        Some(Ok(figure)) => paint::figure(&ui.painter_at(rect), rect.min, figure, &[]),
        Some(Err(error)) => {
            ui.put(rect.shrink(20.0), Label::new(RichText::new(error).color(colors::ERROR.of(ui))).wrap());
        }
        None => {
            ui.painter().rect_filled(rect, 6.0, ui.visuals().faint_bg_color);
        }
    }
}

/// Shows the checks.
pub fn checks(ui: &mut Ui, work: &RoomWork) {
    heading(ui, tr!("bench-checks-of-the-law"));
    // Rows as low as their text.
    (ui.spacing_mut().item_spacing.y, ui.spacing_mut().interact_size.y) = (1.0, 14.0);
    if work.checks.is_empty() {
        ui.label(RichText::new(tr!("bench-computed-after-the-picture-s-beginning")).weak().small());
    }
    for (index, check) in work.checks.iter().enumerate() {
        show_check(ui, index, check, work.has_checks);
    }
}

/// A check: verdict and quantity, and the numbers below. Those of other values of the parameters are grey.
fn show_check(ui: &mut Ui, index: usize, check: &LawCheck, is_present: bool) {
    let (icon, word, tint) = match check.holds() {
        true => (icons::CHECK, tr!("bench-holds"), colors::NORMAL),
        false => (icons::WARNING, tr!("bench-fails"), colors::ERROR),
    };
    let weak = ui.visuals().weak_text_color();
    let text = |text: String, color: egui::Color32| RichText::new(text).color(if is_present { color } else { weak });
    let color = tint.of(ui);
    let quantity = ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        ui.label(text(icon.to_owned(), color));
        ui.add(Label::new(text(check.quantity.clone(), ui.visuals().text_color())).wrap())
    });
    exported::note(ui, &quantity.inner, &format!("check-{index}"), WidgetRole::Text, word, check.measured);
    let [expected, measured, bound] = [check.expected, check.measured, check.bound].map(compact);
    let numbers = tr!("bench-law-found", expected = expected, measured = measured, bound = bound, unit = check.unit);
    ui.horizontal(|ui| {
        ui.add_space(19.0);
        ui.add(Label::new(text(numbers, ui.visuals().weak_text_color()).monospace().size(11.0)).wrap());
    });
    ui.add_space(3.0);
}
