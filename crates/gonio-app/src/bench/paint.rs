//! Paints a plot with egui: the same shapes as in its SVG.

use egui::epaint::{Mesh, TextShape, Vertex, WHITE_UV};
use egui::{
    Align2, Color32, ColorImage, Context, FontId, Painter, Pos2, Rect, Shape, Stroke, TextureHandle, TextureOptions,
    pos2, vec2,
};
use gonio_language::tr;
use gonio_plot::palette::Rgb8;
use gonio_plot::{PlotFigure, PlotShape, TextAlign};
use std::f32::consts::FRAC_PI_2;

fn ink([red, green, blue]: Rgb8) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

/// Uploads the pictures of a plot.
pub fn textures(ctx: &Context, figure: &PlotFigure) -> Vec<TextureHandle> {
    let upload = |placed: &gonio_plot::PlacedPicture| {
        let picture = &placed.picture;
        let size = [picture.width as usize, picture.height as usize];
        let image = ColorImage::from_rgba_unmultiplied(size, &picture.rgba);
        ctx.load_texture(tr!("bench-bench-picture"), image, TextureOptions::LINEAR)
    };
    figure.pictures().iter().map(upload).collect()
}

/// Paints a plot with its top left corner at `corner`. `textures` are those of its pictures.
pub fn figure(painter: &Painter, corner: Pos2, figure: &PlotFigure, textures: &[TextureHandle]) {
    let place = |[x, y]: [f64; 2]| corner + vec2(x as f32, y as f32);
    let [width, height] = figure.size();
    let paper = Rect::from_min_size(corner, vec2(width as f32, height as f32));
    painter.rect_filled(paper, 6.0, ink(figure.palette.background));
    for (placed, texture) in figure.pictures().iter().zip(textures) {
        let [left, top, width, height] = placed.place;
        let rect = Rect::from_min_size(place([left, top]), vec2(width as f32, height as f32));
        painter.image(texture.id(), rect, Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0)), Color32::WHITE);
    }
    // Neighbouring areas are one mesh: a lobe has thousands, without gaps between them.
    let mut areas = Mesh::default();
    for shape in figure.shapes() {
        if !matches!(shape, PlotShape::Area { .. }) && !areas.is_empty() {
            painter.add(Shape::mesh(std::mem::take(&mut areas)));
        }
        match shape {
            PlotShape::Line { points, color, width } => {
                let points = points.iter().copied().map(place).collect();
                painter.line(points, Stroke::new(*width as f32, ink(*color)));
            }
            PlotShape::Area { points, color } => add_area(&mut areas, points.iter().copied().map(place), ink(*color)),
            PlotShape::Dot { center, radius, color, opacity } => {
                painter.circle_filled(place(*center), *radius as f32, ink(*color).gamma_multiply(*opacity as f32));
            }
            PlotShape::Text { at, text, size, color, align, is_upright } => {
                let font = FontId::proportional(*size as f32);
                let galley = painter.layout_no_wrap(text.clone(), font, ink(*color));
                let (at, [width, height]) = (place(*at), [galley.size().x, galley.size().y]);
                if *is_upright {
                    let start = at + vec2(-0.5 * height, 0.5 * width);
                    painter.add(TextShape::new(start, galley, ink(*color)).with_angle(-FRAC_PI_2));
                    continue;
                }
                let anchor = match align {
                    TextAlign::Start => Align2::LEFT_CENTER,
                    TextAlign::Middle => Align2::CENTER_CENTER,
                    TextAlign::End => Align2::RIGHT_CENTER,
                };
                let rect = anchor.anchor_size(at, galley.size());
                painter.galley(rect.min, galley, ink(*color));
            }
        }
    }
    if !areas.is_empty() {
        painter.add(Shape::mesh(areas));
    }
}

/// Adds a convex polygon to a mesh.
fn add_area(mesh: &mut Mesh, corners: impl Iterator<Item = Pos2>, color: Color32) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners.map(|pos| Vertex { pos, uv: WHITE_UV, color }));
    let count = mesh.vertices.len() as u32 - first;
    for corner in 2..count {
        mesh.add_triangle(first, first + corner - 1, first + corner);
    }
}
