//! The texts of a station.

use crate::theme;
use crate::widgets::heading;
use egui::text::{LayoutJob, TextFormat};
use egui::{CornerRadius, FontFamily, FontId, Frame, Label, Margin, RichText, TextStyle, Ui};
use gonio_beyond::StationDescription;
use gonio_language::tr;

/// What the equation assumes, and what nature does.
pub fn equation(ui: &mut Ui, station: &StationDescription) {
    section(ui, tr!("bench-the-rendering-equation-assumes"), &station.assumption);
    section(ui, tr!("bench-in-nature"), &station.nature);
}

/// Where to look, and the question.
pub fn look(ui: &mut Ui, station: &StationDescription) {
    ui.add_space(4.0);
    let title = RichText::new(&station.title).font(theme::bold(18.0)).color(ui.visuals().strong_text_color());
    ui.add(Label::new(title).wrap());
    section(ui, tr!("bench-look"), &station.look);
    section(ui, tr!("bench-question"), &station.question);
}

/// The formulas of the law and their source.
pub fn law(ui: &mut Ui, station: &StationDescription) {
    heading(ui, tr!("bench-the-law"));
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(CornerRadius::same(6));
    frame.inner_margin(Margin::symmetric(8, 6)).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        for line in station.formula.lines() {
            // Several blanks separate formulas: each gets a line.
            for formula in line.split("    ").map(str::trim).filter(|formula| !formula.is_empty()) {
                let text = RichText::new(formula).size(11.5).family(FontFamily::Monospace);
                ui.add(Label::new(text).wrap());
            }
        }
    });
    ui.add(Label::new(RichText::new(tr!("bench-source", source = station.source)).small().weak()).wrap());
}

fn section(ui: &mut Ui, title: &str, text: &str) {
    heading(ui, title);
    ui.add(Label::new(with_names(ui, text)).wrap());
}

/// A text in which names between backticks are in the font of code.
fn with_names(ui: &Ui, text: &str) -> LayoutJob {
    let color = ui.visuals().text_color();
    let body = TextStyle::Body.resolve(ui.style());
    let code = FontId::new(body.size - 1.0, FontFamily::Monospace);
    let mut job = LayoutJob::default();
    for (index, part) in text.split('`').enumerate() {
        let font = if index % 2 == 0 { body.clone() } else { code.clone() };
        job.append(part, 0.0, TextFormat::simple(font, color));
    }
    job
}
