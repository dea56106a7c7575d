//! The recorded frame: passes and draw calls, and the selected draw with its inputs.

mod draw;

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::platform::CaptureAccess;
use crate::saving::Product;
use crate::session::{RecordedFrame, Selection, Session};
use crate::theme::{self, colors, icons};
use egui::{Align, Frame, Label, Layout, Margin, RichText, ScrollArea, Stroke, Ui, WidgetInfo};
use gonio_gl::trace::{DrawRecord, PassRecord, Severity};
use gonio_language::tr;
use gonio_scene::Scene;

/// Height of the list of draws, points: about ten rows.
const LIST_HEIGHT: f32 = 190.0;

pub fn show(ui: &mut Ui, _: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    // While something moves, a record would be outdated at once.
    let quiet = !session.clock.playing && !ui.input(|input| input.pointer.any_down());
    let pictures = session.facts.pictures;
    if quiet && pictures > 0 && session.recorded_frame.as_ref().is_none_or(|taken| taken.picture != pictures) {
        actions.push(Action::RecordFrame);
    }
    let Some(taken) = session.recorded_frame.as_mut().filter(|taken| !taken.record.draws.is_empty()) else {
        ui.label(RichText::new(tr!("scene-there-is-no-picture-yet")).weak());
        return;
    };
    let before = taken.draw;
    findings(ui, taken);
    ui.add_space(8.0);
    if session.capture_access != CaptureAccess::Unsupported {
        capture(ui, session.capture_access, actions);
        ui.add_space(8.0);
    }
    list(ui, taken);
    ui.add_space(8.0);
    draw::show(ui, taken);
    let is_other = taken.draw != before;
    if let Some(draw) = taken.record.draws.get(taken.draw).filter(|_| is_other) {
        let selected = session.loaded.as_ref().and_then(|loaded| part_of(draw, loaded));
        session.selection = Selection::of_part(selected);
    }
}

/// The part that a draw begins with: its object's index and its own. `None` if the draw has no part of the scene.
fn part_of(draw: &DrawRecord, loaded: &Scene) -> Option<[usize; 2]> {
    let object = draw.subject.as_ref()?.index;
    Some([object, loaded.objects.get(object)?.part_of(draw.first as usize / 3)?])
}

/// A button for a RenderDoc capture. Without RenderDoc it can be pressed too and then tells what to do, because a disabled one
/// has no place in the order of the Tab key.
fn capture(ui: &mut Ui, access: CaptureAccess, actions: &mut Vec<Action>) {
    let name = tr!("scene-capture-with-renderdoc");
    let icon = RichText::new(icons::FLOPPY_DISK).font(theme::icon_font(15.0));
    let button = ui.add(egui::Button::new((icon, name)));
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, name));
    exported::note(ui, &button, "capture", WidgetRole::Button, name, "");
    let tip = access.obstacle().unwrap_or(tr!("scene-every-draw-texture-and-uniform"));
    if button.on_hover_text(tip).clicked() {
        actions.push(Action::Save(Product::Capture));
    }
}

/// A heading of the panel.
fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(theme::bold(13.5)).color(ui.visuals().strong_text_color()));
}

/// Passes with their draws.
fn list(ui: &mut Ui, taken: &mut RecordedFrame) {
    let record = &taken.record;
    let count = record.draws.len() + record.draws_left_out;
    heading(
        ui,
        &format!("{}, {}", tr!("scene-passes", count = record.passes.len()), tr!("scene-draws", count = count)),
    );
    for note in &record.notes {
        ui.add(Label::new(RichText::new(note).small().weak()).wrap());
    }
    let mut chosen = taken.draw;
    ScrollArea::vertical().id_salt("draws").max_height(LIST_HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        for (number, pass) in record.passes.iter().enumerate() {
            self::pass(ui, number, pass);
            let draws = record.draws.iter().skip(pass.first_draw).take(pass.draw_count);
            for draw in draws {
                if row(ui, draw, chosen == draw.index) {
                    chosen = draw.index;
                }
            }
        }
    });
    taken.draw = chosen;
}

fn pass(ui: &mut Ui, number: usize, pass: &PassRecord) {
    let target = &pass.target;
    let samples = if target.samples > 1 { tr!("scene-samples-2", samples = target.samples) } else { String::new() };
    let format = target.format.as_deref().unwrap_or("");
    let text = tr!(
        "scene-into-x",
        name = target.name,
        width = target.width,
        height = target.height,
        samples = samples,
        format = format
    );
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("{number}  {}", pass.name)).color(colors::ACCENT.of(ui)));
        ui.add(Label::new(RichText::new(&text).small().weak()).truncate()).on_hover_text(text);
    });
}

/// A draw. Returns whether it was pressed.
fn row(ui: &mut Ui, draw: &DrawRecord, chosen: bool) -> bool {
    let title = draw.title();
    let mut pressed = false;
    ui.horizontal(|ui| {
        ui.add_space(10.0);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(RichText::new(primitives(draw)).small().weak());
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let text = format!("{}  {title}", draw.index);
                let button = ui.add(egui::Button::selectable(chosen, text).truncate());
                exported::note(ui, &button, &format!("draw-{}", draw.index), WidgetRole::Choice, &title, chosen);
                pressed = button.clicked();
            });
        });
    });
    pressed
}

/// The primitives of a draw: `968 triangles`.
fn primitives(draw: &DrawRecord) -> String {
    match draw.primitive.as_str() {
        "triangles" => tr!("scene-triangles-drawn", count = draw.count / 3),
        other => tr!("scene-vertices", other = other, count = draw.count),
    }
}

/// Shows the findings; a link selects the draw.
fn findings(ui: &mut Ui, taken: &mut RecordedFrame) {
    if taken.findings.is_empty() {
        let color = colors::NORMAL.of(ui);
        ui.horizontal(|ui| {
            ui.label(RichText::new(icons::CHECK).font(theme::icon_font(15.0)).color(color));
            ui.add(Label::new(RichText::new(tr!("scene-no-problems-found-in-this-frame")).color(color)).wrap());
        })
        .response
        .on_hover_text(tr!("scene-every-sampler-reads-a-bound-texture"));
        return;
    }
    let mut chosen = taken.draw;
    for finding in &taken.findings {
        let (tint, icon) = match finding.severity {
            Severity::Error => (colors::ERROR, icons::WARNING_CIRCLE),
            Severity::Warning => (colors::WARNING, icons::WARNING),
        };
        let color = tint.of(ui);
        let frame = Frame::NONE.inner_margin(Margin::same(8)).stroke(Stroke::new(1.0, color)).corner_radius(5);
        frame.show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal(|ui| {
                ui.label(RichText::new(icon).font(theme::icon_font(15.0)).color(color));
                ui.label(RichText::new(gonio_language::name(finding.rule.name())).font(theme::bold(13.5)).color(color));
                let more =
                    if finding.draws > 1 { tr!("scene-and-more-2", count = finding.draws - 1) } else { String::new() };
                if ui.link(tr!("scene-draw", draw = finding.draw, more = more)).clicked() {
                    chosen = finding.draw;
                }
            });
            ui.add(Label::new(&finding.message).wrap());
            ui.add(Label::new(RichText::new(&finding.advice).weak()).wrap());
        });
        ui.add_space(4.0);
    }
    taken.draw = chosen;
}
