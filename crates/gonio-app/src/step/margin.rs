//! The values beside the lines of the editor, the expression under the pointer, and the pinned pixel in the picture; and the work
//! that computes them, beside the interface.

use super::Stepper;
use super::source::{RunnablePair, SteppedPicture};
use super::values::{LineValues, ShaderSteps, ValueKind, short};
use crate::exported::{self, WidgetRole};
use crate::scene_view::line;
use crate::theme::colors;
use egui::text_edit::TextEditOutput;
use egui::{
    Color32, ColorImage, FontId, Id, Image, Label, Rect, RichText, Sense, TextureOptions, Tooltip, Ui, pos2, vec2,
};
use gonio_exercises::step::{
    ExpressionPicture, ExpressionValue, PictureBeside, PixelSurface, RightAnswer, StepListing, SteppedPlace,
    SteppedScene,
};
use gonio_glsl::Stage;
use gonio_language::tr;
use std::sync::Arc;

/// Steps that are shown; an endless loop has more.
const MOST_STEPS: usize = 10_000;
/// The background of pictures.
const BACKGROUND: [u8; 3] = [33, 36, 41];

/// The pinned pixel, as shares of the picture's width and height from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The shares.
    pub share: [f32; 2],
    /// Whether the nearest pixel where something is drawn is meant.
    pub is_nearest: bool,
}

/// A picture and the pixel to list.
#[derive(Clone, PartialEq)]
pub struct Request {
    /// The picture.
    pub picture: SteppedPicture,
    /// The pixel.
    pub pin: Pin,
}

/// The listings at a pixel.
#[derive(Clone)]
pub struct Listed {
    /// The pair.
    pub pair: RunnablePair,
    /// The pair in the scene.
    pub scene: Arc<SteppedScene>,
    /// Column and row from the top left of the picture.
    pub pixel: [u32; 2],
    /// The surface there.
    pub surface: PixelSurface,
    /// The fragment shader.
    pub fragment: Arc<ShaderSteps>,
    /// The vertex shader at each corner of the triangle.
    pub corners: Vec<Arc<ShaderSteps>>,
}

/// A pair, and the same in its scene.
pub type Stepped = (RunnablePair, Arc<SteppedScene>);

/// Lists the shaders at the pixel. `before`: what can be used again.
pub fn list(request: &Request, before: Option<(Stepped, Request)>) -> Result<Listed, String> {
    let Request { picture, pin } = request;
    let known = before.filter(|(_, before)| before.picture.has_same_program(picture));
    let pair = match &known {
        Some(((pair, _), _)) => pair.clone(),
        None => picture.compile()?,
    };
    let scene = match known.filter(|(_, before)| before.picture == *picture) {
        Some(((_, scene), _)) => scene,
        None => Arc::new(picture.scene(&pair).ok_or(tr!("exercise-there-is-no-picture"))?),
    };
    let asked = picture.in_scene(picture.pixel(pin.share));
    let seen = if pin.is_nearest { scene.nearest_drawn(asked) } else { Some(asked) };
    let found =
        seen.and_then(|pixel| Some((picture.in_picture(pixel)?, scene.surface(pixel)?, scene.step_pixel(pixel)?)));
    let Some((pixel, surface, fragment)) = found else {
        return Err(match scene.endless_vertex() {
            Some(vertex) => tr!("exercise-the-vertex-shader-does-not-end", vertex = vertex),
            None => tr!("exercise-nothing-is-drawn-at-this-pixel").to_owned(),
        });
    };
    let corners = surface.vertices.iter().filter_map(|vertex| scene.step_vertex(*vertex)).map(steps);
    Ok(Listed { fragment: steps(fragment), corners: corners.collect(), pair, pixel, surface, scene })
}

fn steps(mut listing: StepListing) -> Arc<ShaderSteps> {
    listing.is_truncated |= listing.steps.len() > MOST_STEPS;
    listing.steps.truncate(MOST_STEPS);
    Arc::new(ShaderSteps::new(listing))
}

/// A line and column of the current shader's file, both from 1.
pub type Target = [u32; 2];

/// An expression with its value and its picture.
#[derive(Clone, Debug)]
pub struct Hovered {
    /// The expression and its values.
    pub value: ExpressionValue,
    /// Its picture and that of its right values, or one sentence on why there is none.
    pub pictures: Result<PictureBeside, String>,
    /// Width and height of the pictures in pixels.
    pub size: [u32; 2],
}

/// The expression at a line and column, with its value at the place, its picture, and that of its right values.
pub fn evaluate(
    pair: &RunnablePair,
    scene: &SteppedScene,
    picture: &SteppedPicture,
    place: SteppedPlace,
    target: Target,
    right: Option<&RightAnswer>,
) -> Option<Hovered> {
    let value = scene.expression_value(place, target)?;
    let (small, size) = picture.small_scene(pair)?;
    let mut pictures = small.picture_of(place.stage(), &value, BACKGROUND, right);
    if let Ok(PictureBeside { own, right, .. }) = &mut pictures {
        for drawn in std::iter::once(own).chain(right) {
            drawn.rgba = cropped(&drawn.rgba, small.size(), size);
        }
    }
    Some(Hovered { value, pictures, size })
}

/// The visible part of a picture, in its middle.
fn cropped(rgba: &[u8], whole: [u32; 2], [width, height]: [u32; 2]) -> Vec<u8> {
    let [left, top] = [whole[0].saturating_sub(width) / 2, whole[1].saturating_sub(height) / 2];
    let row = |y: u32| {
        let start = ((top + y) * whole[0] + left) as usize * 4;
        rgba.get(start..start + width as usize * 4).unwrap_or_default()
    };
    (0..height).flat_map(row).copied().collect()
}

/// Values of short lines begin at this character.
const COLUMN: f32 = 44.0;
/// Width of the values as a share of the editor's, at most.
const MOST_WIDTH: f32 = 0.5;
/// Size of the values' font, points.
const SIZE: f32 = 11.5;

/// Shows the values beside the rows of the editor's text and the expression under the pointer. `left`: the left edge of the
/// text.
pub fn beside(ui: &Ui, output: &TextEditOutput, rows: &[Rect], left: f32, stepper: &mut Stepper, steps: &ShaderSteps) {
    let (clip, id) = (ui.clip_rect(), output.response.id);
    let current = steps.step().map(|step| step.line);
    let visible = |row: &Rect| row.bottom() >= clip.top() && row.top() <= clip.bottom();
    let mut over_value = false;
    for (index, row) in rows.iter().enumerate().filter(|(_, row)| visible(row)) {
        let number = index as u32 + 1;
        let whole = Rect::from_min_max(pos2(left, row.top()), pos2(clip.right(), row.bottom()));
        let listed = steps.listing.lines.iter().find(|line| line.number == number);
        if listed.is_some_and(|line| line.ran == Some(false)) {
            ui.painter().rect_filled(whole, 0.0, ui.visuals().extreme_bg_color.gamma_multiply(0.6));
        }
        if current == Some(number) {
            ui.painter().rect_filled(whole, 0.0, colors::ACCENT.of(ui).gamma_multiply(0.18));
            let edge = Rect::from_min_size(whole.min, vec2(2.0, whole.height()));
            ui.painter().rect_filled(edge, 0.0, colors::ACCENT.of(ui));
        }
        if let Some(values) = steps.lines().get(&number) {
            let place = value(ui, *row, left, values);
            let response = ui.interact(place, id.with(("value", number)), Sense::hover());
            over_value |= response.hovered();
            response.on_hover_text(egui::RichText::new(&values.details).monospace());
        }
    }
    if stepper.current().is_some_and(|current| current.listing.file == steps.listing.file) {
        if let Some(line) = stepper.scroll.take()
            && let Some(row) = rows.get(line.saturating_sub(1) as usize)
        {
            let place = Rect::from_x_y_ranges(clip.x_range(), row.y_range()).expand2(vec2(0.0, 2.0 * row.height()));
            ui.scroll_to_rect(place, None);
        }
        stepper.hover.point(if over_value && !stepper.hover.at_cursor {
            None
        } else {
            pointed(ui, output, rows, stepper.hover.at_cursor)
        });
        tooltip(ui, stepper, rows, id);
    }
}

/// Writes the values of a line behind its text, or over its end if the editor is too narrow. Returns their place.
fn value(ui: &Ui, row: Rect, left: f32, values: &LineValues) -> Rect {
    let clip = ui.clip_rect();
    let font = FontId::monospace(SIZE);
    let color = match values.kind {
        ValueKind::Normal => ui.visuals().weak_text_color(),
        ValueKind::Unwritten => colors::WARNING.of(ui),
        ValueKind::NonFinite => colors::ERROR.of(ui),
    };
    let digit = ui.painter().layout_no_wrap("0".into(), font.clone(), color).size().x;
    let most = ((MOST_WIDTH * (clip.right() - left) / digit) as usize).max(8);
    let text: String = match values.text.char_indices().nth(most) {
        Some((end, _)) => values.text.get(..end).unwrap_or_default().chars().chain("...".chars()).collect(),
        None => values.text.clone(),
    };
    let galley = ui.painter().layout_no_wrap(text, font, color);
    let wanted = (row.right() + 2.0 * digit).max(left + COLUMN * digit);
    let x = wanted.min(clip.right() - galley.size().x - 8.0).max(left + digit);
    let place = Rect::from_min_size(pos2(x, row.center().y - 0.5 * galley.size().y), galley.size());
    if x < row.right() + digit {
        let ground = Rect::from_min_max(pos2(x - digit, row.top()), pos2(clip.right(), row.bottom()));
        ui.painter().rect_filled(ground, 0.0, ui.visuals().extreme_bg_color);
    }
    ui.painter().galley(place.min, galley, color);
    place
}

/// The line and column of the character under the pointer, or at the cursor, and its place.
fn pointed(ui: &Ui, output: &TextEditOutput, rows: &[Rect], at_cursor: bool) -> Option<(Target, Rect)> {
    let digit = digit_width(ui);
    let at = |line: usize, column: usize| {
        let row = rows.get(line)?;
        let place = Rect::from_min_size(pos2(row.left() + column as f32 * digit, row.top()), vec2(digit, row.height()));
        Some(([line as u32 + 1, column as u32 + 1], place))
    };
    if at_cursor {
        let cursor = output.cursor_range?.primary;
        let place = output.galley.layout_from_cursor(cursor);
        return at(place.row, place.column.into());
    }
    if !output.response.hovered() || ui.input(|i| i.pointer.any_down()) {
        return None;
    }
    let pointer = ui.input(|i| i.pointer.hover_pos())?;
    let line = rows.iter().position(|row| row.contains(pointer))?;
    at(line, ((pointer.x - rows.get(line)?.left()) / digit) as usize)
}

/// Width of each character of the editor's text.
fn digit_width(ui: &Ui) -> f32 {
    let font = egui::TextStyle::Monospace.resolve(ui.style());
    ui.painter().layout_no_wrap("0".into(), font, Color32::WHITE).size().x.max(1.0)
}

/// Draws the pinned pixel in a picture.
pub fn marker(ui: &Ui, picture: Rect, stepper: &Stepper) {
    let Some([x, y]) = stepper.pinned() else { return };
    let painter = ui.painter().with_clip_rect(picture);
    let middle = picture.min + vec2(x * picture.width(), y * picture.height());
    let color = if stepper.stage() == Stage::Vertex { Color32::from_rgb(255, 208, 94) } else { Color32::WHITE };
    for (from, to) in [(4.0, 12.0), (-4.0, -12.0)] {
        line(&painter, [middle + vec2(from, 0.0), middle + vec2(to, 0.0)], 1.5, color);
        line(&painter, [middle + vec2(0.0, from), middle + vec2(0.0, to)], 1.5, color);
    }
}

/// Shows the value and the picture beside the expression.
fn tooltip(ui: &Ui, stepper: &mut Stepper, rows: &[Rect], id: Id) {
    let step = stepper.current().and_then(|steps| steps.step()).cloned();
    let hover = &mut stepper.hover;
    let Some((_, place, _)) = hover.target else { return };
    let Some(hovered) = hover.shown().cloned() else { return };
    // The whole expression is underlined.
    if let Some(row) = rows.get(hovered.value.line.saturating_sub(1) as usize) {
        let digit = digit_width(ui);
        let left = row.left() + (hovered.value.column.saturating_sub(1)) as f32 * digit;
        let right = left + hovered.value.length as f32 * digit;
        let color = colors::ACCENT.of(ui);
        ui.painter().hline(left..=right, row.bottom() - 1.0, egui::Stroke::new(1.5, color));
    }
    if hover.textures.is_empty() {
        let pictures = hovered.pictures.iter().flat_map(|both| std::iter::once(&both.own).chain(&both.right));
        let load = |picture: &ExpressionPicture| {
            let size = hovered.size.map(|side| side as usize);
            let is_whole = picture.rgba.len() == size[0] * size[1] * 4;
            is_whole.then(|| {
                let image = ColorImage::from_rgba_unmultiplied(size, &picture.rgba);
                ui.ctx().load_texture("expression", image, TextureOptions::NEAREST)
            })
        };
        hover.textures = pictures.filter_map(load).collect();
    }
    let textures = hover.textures.clone();
    let layer = ui.layer_id();
    // Room for the pictures side by side.
    let pictures = textures.len().max(1) as f32 * (hovered.size[0] as f32 + 8.0);
    let width = pictures.max(320.0).min(ui.ctx().content_rect().width() - 24.0);
    let shown = Tooltip::always_open(ui.ctx().clone(), layer, id.with("expression"), place).width(width).show(|ui| {
        let value = &hovered.value;
        let name = RichText::new(&value.expression).monospace().color(ui.visuals().strong_text_color());
        ui.add(Label::new(name).wrap());
        ui.label(RichText::new(&value.glsl_type).small().weak());
        let of_step = step.as_ref().and_then(|step| {
            let mut all = value.evaluations.iter().rev();
            all.find(|e| e.function == step.function && e.calls == step.calls && e.iterations == step.iterations)
        });
        match of_step.or(value.evaluations.last()) {
            Some(evaluation) => {
                let color = match ValueKind::of(&evaluation.value) {
                    ValueKind::Normal => ui.visuals().text_color(),
                    ValueKind::Unwritten => colors::WARNING.of(ui),
                    ValueKind::NonFinite => colors::ERROR.of(ui),
                };
                let text = RichText::new(short(&evaluation.value)).monospace().color(color);
                ui.add(Label::new(text).wrap());
                let count = value.evaluations.len();
                if count > 1 {
                    let which =
                        if of_step.is_some() { tr!("exercise-that-of-this-step") } else { tr!("exercise-the-last") };
                    ui.label(RichText::new(tr!("exercise-of-values", which = which, count = count)).small().weak());
                }
            }
            None => {
                ui.add(
                    Label::new(RichText::new(tr!("exercise-not-evaluated-here")).color(colors::WARNING.of(ui))).wrap(),
                );
            }
        }
        ui.horizontal_wrapped(|ui| {
            for (texture, whose) in textures.iter().zip(["yours", "right"]) {
                ui.vertical(|ui| {
                    ui.set_max_width(hovered.size[0] as f32);
                    ui.add(Image::new(texture));
                    if textures.len() > 1 {
                        ui.label(RichText::new(whose).small());
                    }
                });
            }
        });
        if let Some(sentence) = hovered.pictures.as_ref().ok().and_then(|both| both.quantity.as_ref()) {
            ui.add(Label::new(sentence).wrap());
        }
        let about = match &hovered.pictures {
            Ok(both) => about(&both.own),
            // The place of the expression is known here.
            Err(reason) => reason.split_once(": ").map_or(reason.as_str(), |(_, why)| why).to_owned(),
        };
        ui.add(Label::new(RichText::new(about).small().weak()).wrap());
    });
    if let Some(shown) = shown {
        let value = hovered.value.evaluations.last().map_or(String::new(), |last| last.value.to_string());
        exported::note(ui, &shown.response, "expression", WidgetRole::Text, &hovered.value.expression, value);
    }
}

/// The meaning of the colours.
fn about(picture: &ExpressionPicture) -> String {
    let mut text = picture.mapping.to_string();
    if picture.stage == Stage::Vertex {
        text.push_str(tr!("exercise-interpolated-between-the-vertices"));
    }
    if picture.evaluations > 1 {
        text.push_str(&tr!("exercise-the-last-of-up-to-values", evaluations = picture.evaluations));
    }
    for (count, what) in [
        (picture.non_finite, tr!("exercise-magenta-not-a-finite-number")),
        (picture.unwritten, tr!("exercise-cyan-never-written")),
        (picture.unevaluated, tr!("exercise-chequered-not-evaluated")),
    ] {
        if count > 0 {
            text.push_str(&format!("; {what}"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_visible_part_is_the_middle_of_the_picture() {
        let rows: Vec<u8> = (0..100).flat_map(|y| vec![y; 100 * 4]).collect();
        let cropped = cropped(&rows, [100; 2], [100, 50]);
        assert_eq!((cropped.len(), cropped[0]), (100 * 50 * 4, 25));
    }
}
