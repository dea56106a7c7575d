//! The atlas: its maps under the outlines of its charts, to zoom, to move and to point at.

use super::places::AtlasPlace;
use super::{AtlasBackground, BakedResult, Baking};
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::{colors, icons};
use crate::widgets::{SPACE, dropdown, grouped, tool_button};
use egui::{
    Align, Color32, ColorImage, CursorIcon, Label, Layout, Painter, Pos2, Rect, Response, RichText, Sense, Shape,
    Stroke, TextureFilter, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use glam::DVec2;
use gonio_language::tr;

/// The atlas as it is looked at.
pub struct AtlasView {
    /// The picture below the outlines.
    pub background: AtlasBackground,
    /// Whether the charts are outlined.
    pub outlines: bool,
    /// 1 fits the whole atlas.
    pub zoom: f32,
    /// The texture coordinates in the middle.
    center: Vec2,
    /// The background on the GPU, with the result that it belongs to.
    texture: Option<(u64, AtlasBackground, TextureHandle)>,
    /// The square of the atlas in the last frame, points of the window.
    pub square: Option<Rect>,
}

impl Default for AtlasView {
    fn default() -> Self {
        AtlasView {
            background: AtlasBackground::default(),
            outlines: true,
            zoom: 1.0,
            center: Vec2::splat(0.5),
            texture: None,
            square: None,
        }
    }
}

/// The range of the zoom.
const ZOOMS: [f32; 2] = [0.5, 400.0];
/// From this many points per texel on, texels are squares.
const MAGNIFIED: f32 = 2.0;
/// Most edges that are outlined: more would take longer to paint than a frame has.
const MOST_EDGES: usize = 40_000;
/// Share of the canvas that the atlas fills at zoom 1.
const FILLED: f32 = 0.96;

impl AtlasView {
    /// Looks at the whole of another result.
    pub fn forget(&mut self, background: AtlasBackground) {
        *self = AtlasView { background, outlines: self.outlines, ..AtlasView::default() };
    }

    /// Frees the texture.
    pub fn release(&mut self) {
        self.texture = None;
    }

    fn fit(&mut self) {
        (self.zoom, self.center) = (1.0, Vec2::splat(0.5));
    }

    fn texture(&mut self, ui: &Ui, result: &BakedResult) -> TextureHandle {
        let key = (result.facts.serial, self.background);
        if let Some((serial, background, texture)) = &self.texture
            && (*serial, *background) == key
        {
            return texture.clone();
        }
        let picture = result.picture(self.background);
        let size = [picture.width as usize, picture.height as usize];
        // Baked maps are opaque.
        let image = ColorImage::from_rgba_premultiplied(size, &picture.rgba);
        let options = TextureOptions {
            magnification: TextureFilter::Nearest,
            minification: TextureFilter::Linear,
            mipmap_mode: Some(TextureFilter::Linear),
            ..TextureOptions::LINEAR
        };
        let texture = ui.ctx().load_texture("atlas", image, options);
        self.texture = Some((key.0, key.1, texture.clone()));
        texture
    }

    /// The square of the atlas in the window.
    fn square_in(&self, canvas: Rect) -> Rect {
        let side = FILLED * self.zoom * canvas.width().min(canvas.height());
        let offset = vec2(self.center.x - 0.5, 0.5 - self.center.y) * side;
        Rect::from_center_size(canvas.center() - offset, Vec2::splat(side))
    }

    /// Zooms by a factor and keeps the place under `at`.
    fn zoom_at(&mut self, canvas: Rect, at: Pos2, factor: f32) {
        let before = uv_at(self.square_in(canvas), at);
        self.zoom = (self.zoom * factor).clamp(ZOOMS[0], ZOOMS[1]);
        let after = uv_at(self.square_in(canvas), at);
        self.center += vec2((before.x - after.x) as f32, (before.y - after.y) as f32);
        self.hold();
    }

    fn hold(&mut self) {
        self.center = self.center.clamp(Vec2::ZERO, Vec2::splat(1.0));
    }
}

fn uv_at(square: Rect, place: Pos2) -> DVec2 {
    let local = (place - square.min) / square.size();
    DVec2::new(f64::from(local.x), 1.0 - f64::from(local.y))
}

fn to_window(square: Rect, uv: [f32; 2]) -> Pos2 {
    pos2(square.left() + uv[0] * square.width(), square.bottom() - uv[1] * square.height())
}

/// Shows the atlas in the available room: its toolbar, the canvas, and what the marked texel is.
pub fn show(ui: &mut Ui, session: &mut Session) {
    let Some(result) = session.baking.result().cloned() else { return };
    toolbar(ui, &mut session.baking, &result);
    let below = 2.0 * ui.text_style_height(&egui::TextStyle::Small) + 10.0;
    let room = vec2(ui.available_width(), (ui.available_height() - below).max(60.0));
    let (canvas, response) = ui.allocate_exact_size(room, Sense::click_and_drag());
    let name = tr!("bench-texture-atlas", background = background_name(&result, session.baking.view.background));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &name));
    exported::note(ui, &response, "atlas", WidgetRole::Picture, &name, result.facts.serial);
    navigate(ui, &response, canvas, &mut session.baking.view);
    let view = &mut session.baking.view;
    let square = view.square_in(canvas);
    view.square = Some(square);
    point(&response, square, &result, session);
    let place = session.baking.place(&session.probing);
    paint(ui, canvas, square, &result, &mut session.baking.view, place);
    readout(ui, &result, &session.baking, place);
}

fn toolbar(ui: &mut Ui, baking: &mut Baking, result: &BakedResult) {
    ui.horizontal(|ui| {
        let mut options = vec![
            (AtlasBackground::Charts, tr!("bake-charts").to_owned(), tr!("bench-each-chart-in-a-colour-of")),
            (AtlasBackground::Checker, tr!("bench-checker").to_owned(), tr!("bench-squares-with-picture-on-the-model")),
        ];
        let maps = result.atlas.pictures.iter().enumerate();
        options.extend(maps.map(|(index, map)| (AtlasBackground::Map(index), super::panel::title(map.kind), "")));
        let options: Vec<_> = options.iter().map(|(value, name, tip)| (*value, name.as_str(), *tip)).collect();
        ui.scope(|ui| {
            ui.set_max_width(170.0);
            dropdown(ui, "atlas-map", tr!("bench-picture-of-the-atlas"), &mut baking.view.background, &options);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let view = &mut baking.view;
            let canvas = Rect::from_center_size(Pos2::ZERO, Vec2::splat(1.0));
            if tool_button(ui, "atlas-fit", icons::FRAME_CORNERS, tr!("bench-show-the-whole-atlas"), None, true)
                .clicked()
            {
                view.fit();
            }
            if tool_button(ui, "atlas-out", icons::MINUS, tr!("bench-zoom-out"), None, true).clicked() {
                view.zoom_at(canvas, canvas.center(), 1.0 / 1.5);
            }
            if tool_button(ui, "atlas-in", icons::PLUS, tr!("bench-zoom-in"), None, true).clicked() {
                view.zoom_at(canvas, canvas.center(), 1.5);
            }
            let color = view.outlines.then(|| colors::ACCENT.of(ui));
            let outlines =
                tool_button(ui, "atlas-outlines", icons::POLYGON, tr!("bench-outline-the-charts"), color, true);
            if outlines.clicked() {
                view.outlines = !view.outlines;
            }
        });
    });
}

/// The background's name.
pub fn background_name(result: &BakedResult, background: AtlasBackground) -> String {
    match background {
        AtlasBackground::Charts => tr!("bench-charts-word").to_owned(),
        AtlasBackground::Checker => tr!("bench-checker-word").to_owned(),
        AtlasBackground::Map(index) => result
            .atlas
            .pictures
            .get(index)
            .map_or_else(String::new, |map| super::panel::title(map.kind).to_lowercase()),
    }
}

/// Moves and zooms by the pointer.
fn navigate(ui: &Ui, response: &Response, canvas: Rect, view: &mut AtlasView) {
    if response.dragged() {
        let side = view.square_in(canvas).width();
        let way = response.drag_delta() / side;
        view.center += vec2(-way.x, way.y);
        view.hold();
    }
    let touch = ui.input(|i| i.multi_touch()).map(|touch| touch.center_pos).filter(|&place| canvas.contains(place));
    if let Some(place) = response.hover_pos().or(touch) {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = pinch * (wheel / 200.0).exp();
        if factor != 1.0 {
            view.zoom_at(canvas, place, factor);
        }
    }
    if response.double_clicked() {
        view.fit();
    }
}

/// Takes the place under the pointer; a click picks it.
fn point(response: &Response, square: Rect, result: &BakedResult, session: &mut Session) {
    let place_at = |place: Pos2| result.place_at(uv_at(square, place));
    session.baking.hovered = response.hover_pos().filter(|_| !response.dragged()).and_then(place_at);
    if response.clicked()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        session.baking.picked = place_at(pointer);
        session.probing.pinned = None;
    }
    if session.baking.hovered.is_some() {
        response.clone().on_hover_cursor(CursorIcon::Crosshair);
    }
}

fn paint(ui: &Ui, canvas: Rect, square: Rect, result: &BakedResult, view: &mut AtlasView, place: Option<AtlasPlace>) {
    let painter = ui.painter_at(canvas);
    let visuals = ui.visuals();
    // In the light theme the extreme is white, as bright maps are.
    painter.rect_filled(canvas, 6.0, if visuals.dark_mode { visuals.extreme_bg_color } else { visuals.code_bg_color });
    let texture = view.texture(ui, result);
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    painter.image(texture.id(), square, whole, Color32::WHITE);
    painter.rect_stroke(
        square,
        0.0,
        Stroke::new(1.0, ui.visuals().widgets.noninteractive.bg_stroke.color),
        egui::StrokeKind::Outside,
    );
    if view.outlines && view.background != AtlasBackground::Charts {
        let stroke = Stroke::new(1.0, Color32::from_white_alpha(110));
        let all = result.outlines.iter().flatten().take(MOST_EDGES);
        edges(&painter, canvas, square, result, all, &[Stroke::new(2.5, Color32::from_black_alpha(70)), stroke]);
    }
    let Some(place) = place else { return };
    if let Some(outline) = result.outlines.get(place.chart as usize) {
        let accent = colors::ACCENT.in_theme(true);
        let strokes = [Stroke::new(4.0, Color32::from_black_alpha(150)), Stroke::new(2.0, accent)];
        edges(&painter, canvas, square, result, outline.iter().take(MOST_EDGES), &strokes);
    }
    let size = f64::from(result.job.size);
    let texel = (place.uv * size).floor();
    let corner = |t: DVec2| to_window(square, (t / size).as_vec2().to_array());
    let side = square.width() / size as f32;
    if side >= MAGNIFIED {
        let texel = Rect::from_two_pos(corner(texel), corner(texel + 1.0));
        painter.rect_stroke(texel, 0.0, Stroke::new(3.0, Color32::BLACK), egui::StrokeKind::Outside);
        painter.rect_stroke(texel, 0.0, Stroke::new(1.5, Color32::WHITE), egui::StrokeKind::Outside);
    }
    super::mark::ring(&painter, to_window(square, place.uv.as_vec2().to_array()), true);
}

fn edges<'e>(
    painter: &Painter,
    canvas: Rect,
    square: Rect,
    result: &BakedResult,
    edges: impl Iterator<Item = &'e (usize, usize)> + Clone,
    strokes: &[Stroke],
) {
    let tex_coords = &result.atlas.uv.tex_coords;
    let end = |triangle: usize, corner: usize| to_window(square, tex_coords[3 * triangle + corner]);
    for stroke in strokes {
        let lines = edges.clone().filter_map(|&(triangle, k)| {
            let line = [end(triangle, k), end(triangle, (k + 1) % 3)];
            let is_seen = canvas.intersects(Rect::from_two_pos(line[0], line[1]).expand(2.0));
            is_seen.then(|| Shape::line_segment(line, *stroke))
        });
        painter.extend(lines);
    }
}

/// The marked texel in words.
fn readout(ui: &mut Ui, result: &BakedResult, baking: &Baking, place: Option<AtlasPlace>) {
    let text = match place {
        None => tr!("bench-point-at-a-chart-its-place").to_owned(),
        Some(place) => sentence(result, baking.view.background, place),
    };
    let label = ui.add(Label::new(RichText::new(&text).small().weak()).wrap());
    exported::note(ui, &label, "atlas-texel", WidgetRole::Text, tr!("bench-marked-texel"), &text);
}

fn sentence(result: &BakedResult, background: AtlasBackground, place: AtlasPlace) -> String {
    let size = result.job.size;
    let [column, row] = (place.uv * f64::from(size)).to_array().map(|t| (t as u32).min(size.saturating_sub(1)));
    let object = result.name_of(place.triangle).map_or(String::new(), |name| tr!("bench-of", name = name));
    let mut text = tr!(
        "bench-texel-chart",
        column = column,
        row = row,
        chart = grouped(u64::from(place.chart) + 1, SPACE),
        object = object
    );
    if let AtlasBackground::Map(index) = background
        && let Some(map) = result.atlas.pictures.get(index)
    {
        let pixel = 4 * ((size - 1 - row) as usize * size as usize + column as usize);
        if let Some([r, g, b]) = map.picture.rgba.get(pixel..pixel + 3) {
            text += &format!(": {r} {g} {b}");
        }
    }
    text
}
