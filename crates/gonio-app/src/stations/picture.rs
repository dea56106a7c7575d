//! The picture of the chosen station, with its caption.

use super::RoomStation;
use super::work::RoomWork;
use crate::exported::{self, WidgetRole};
use crate::theme::{colors, icons};
use crate::widgets::{choice, tool_button};
use egui::{Align, Color32, CornerRadius, Label, Layout, Rect, RichText, Sense, Ui, WidgetInfo, pos2, vec2};
use gonio_beyond::MOST_SAMPLES;
use gonio_language::tr;

/// The pictures are composed for this ratio of width and height.
const ASPECT: f32 = 4.0 / 3.0;
/// Most pixels: enough to look sharp. A worker of a page has one thread.
const MOST_PIXELS: f32 = if cfg!(target_arch = "wasm32") { 320.0 * 1000.0 } else { 500.0 * 1000.0 };

/// Shows the picture, at most so many points high.
pub fn show(ui: &mut Ui, station: &mut RoomStation, work: &mut RoomWork, most_height: f32) {
    let pictures = &station.description.pictures;
    if pictures.len() > 1 {
        let options: Vec<(usize, &str, &str)> = pictures
            .iter()
            .enumerate()
            .map(|(index, (name, caption))| (index, name.as_str(), caption.as_str()))
            .collect();
        choice(ui, "picture", tr!("bench-picture"), &mut station.picture, &options, 0);
    }
    let caption = pictures.get(station.picture).map_or("", |(_, caption)| caption);
    let room = ui.available_width();
    let height = (room / ASPECT).min(most_height);
    let (line, response) = ui.allocate_exact_size(vec2(room, height), Sense::hover());
    let rect = Rect::from_center_size(line.center(), vec2(height * ASPECT, height));
    work.size = pixels(rect.size() * ui.ctx().pixels_per_point());
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, caption));
    let shown = egui::Response { rect, ..response };
    exported::note(ui, &shown, "station-picture", WidgetRole::Picture, caption, work.picture.serial);
    let corners = CornerRadius::same(6);
    match &work.picture.texture {
        Some(texture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            let image = egui::Image::new((texture.id(), rect.size())).uv(whole).corner_radius(corners);
            image.paint_at(ui, rect);
        }
        None => {
            ui.painter().rect_filled(rect, corners, ui.visuals().faint_bg_color);
        }
    }
    if work.is_running() || work.is_paused {
        // How far the picture is.
        let bar = Rect::from_min_max(
            pos2(rect.left() + 6.0, rect.bottom() - 6.0),
            pos2(rect.right() - 6.0, rect.bottom() - 3.0),
        );
        ui.painter().rect_filled(bar, 1.5, Color32::from_black_alpha(90));
        let done = Rect::from_min_size(bar.min, vec2(bar.width() * work.share(), bar.height()));
        ui.painter().rect_filled(done, 1.5, colors::ACCENT.in_theme(true));
    }
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            progress(ui, work);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.add(Label::new(RichText::new(caption).weak()).wrap());
            });
        });
    });
}

/// The button that pauses the work, and how far it is.
fn progress(ui: &mut Ui, work: &mut RoomWork) {
    let is_done = work.picture.is_newest && work.picture.samples >= MOST_SAMPLES;
    let (icon, tip) = match work.is_paused {
        true => (icons::PLAY, tr!("bench-continue-to-refine-the-picture")),
        false => (icons::PAUSE, tr!("bench-stop-refining-the-picture")),
    };
    if tool_button(ui, "pause", icon, tip, None, work.is_paused || work.is_running()).clicked() {
        work.toggle_pause();
    }
    let text = match work.picture.samples {
        _ if work.picture.texture.is_none() => String::new(),
        0 => "coarse".to_owned(),
        1 => tr!("bench-1-sample").to_owned(),
        samples if is_done => tr!("bench-samples-done", samples = samples),
        samples => tr!("bench-samples-2", samples = samples),
    };
    let text = ui.label(RichText::new(&text).small().weak());
    exported::note(ui, &text, "samples", WidgetRole::Text, tr!("bench-samples-of-each-pixel"), work.picture.samples);
}

/// The size to compute for a size on the screen in physical pixels.
fn pixels(size: egui::Vec2) -> [u32; 2] {
    let scale = (MOST_PIXELS / (size.x * size.y).max(1.0)).sqrt().min(1.0);
    [size.x, size.y].map(|side| (side * scale).round().max(1.0) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_pictures_are_computed_with_fewer_pixels() {
        assert_eq!(pixels(vec2(400.0, 300.0)), [400, 300]);
        let [width, height] = pixels(vec2(2400.0, 1800.0));
        assert!((width * height) as f32 <= 1.01 * MOST_PIXELS && width * 3 / 4 == height, "{width} x {height}");
    }
}
