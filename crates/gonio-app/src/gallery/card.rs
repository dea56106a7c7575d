//! A scene's card: its picture, its caption and a remark.

use super::plain;
use crate::exported::{self, WidgetRole};
use crate::theme;
use egui::text::LayoutJob;
use egui::{Align2, Color32, CursorIcon, FontId, Rect, Sense, StrokeKind, Ui, WidgetInfo, vec2};
use gonio_gallery::exhibit::Exhibit;

/// Height of a picture, points.
const HEIGHT: f32 = 120.0;
/// Height of the lines below, points.
const TEXT_HEIGHT: f32 = 36.0;
/// Margin around the picture, points.
const MARGIN: f32 = 5.0;
/// The narrowest picture, points: its caption needs room.
const LEAST_WIDTH: f32 = 112.0;

/// A card that was shown.
pub struct ShownCard {
    /// The place of its picture.
    pub picture: Rect,
    /// Whether the card was clicked.
    pub is_clicked: bool,
}

/// Shows the card of an exhibit, with an icon in the place of its picture.
pub fn show(ui: &mut Ui, exhibit: &Exhibit) -> ShownCard {
    let most = ui.max_rect().width() - 2.0 * MARGIN;
    let width = (HEIGHT * exhibit.aspect as f32).max(LEAST_WIDTH).min(most).floor();
    let height = (width / exhibit.aspect as f32).min(HEIGHT).floor();
    let size = vec2(width + 2.0 * MARGIN, height + TEXT_HEIGHT + 2.0 * MARGIN);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let (caption, remark) = (plain(&exhibit.caption), plain(&exhibit.remark));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &caption));
    exported::note(ui, &response, &format!("exhibit-{}", exhibit.name), WidgetRole::Button, &caption, &remark);
    // The picture keeps its proportions in a card that is wider.
    let picture_width = (height * exhibit.aspect as f32).min(width).round();
    let left = rect.left() + ((rect.width() - picture_width) / 2.0).floor();
    let picture = Rect::from_min_size(egui::pos2(left, rect.top() + MARGIN), vec2(picture_width, height));
    if ui.is_rect_visible(rect) {
        let visuals = ui.visuals();
        let is_pointed = response.hovered() || response.has_focus();
        let fill = if is_pointed { visuals.widgets.hovered.bg_fill } else { visuals.faint_bg_color };
        let painter = ui.painter();
        painter.rect_filled(rect, 6.0, fill);
        if response.has_focus() {
            painter.rect_stroke(rect, 6.0, visuals.selection.stroke, StrokeKind::Inside);
        }
        painter.rect_filled(picture, 2.0, visuals.extreme_bg_color);
        painter.text(
            picture.center(),
            Align2::CENTER_CENTER,
            theme::icons::IMAGE,
            theme::icon_font(28.0),
            visuals.weak_text_color(),
        );
        let line = |text: &str, font: FontId, color: Color32, top: f32| {
            let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
            job.wrap = egui::text::TextWrapping::truncate_at_width(width);
            let galley = painter.layout_job(job);
            let left = rect.center().x - 0.5 * galley.size().x;
            painter.galley(egui::pos2(left, top), galley, color);
        };
        let top = picture.bottom() + 2.0;
        line(&caption, FontId::proportional(12.5), visuals.text_color(), top);
        line(&remark, FontId::proportional(10.5), visuals.weak_text_color(), top + 17.0);
    }
    let is_clicked = response.clicked();
    response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(plain(&exhibit.look));
    ShownCard { picture, is_clicked }
}
