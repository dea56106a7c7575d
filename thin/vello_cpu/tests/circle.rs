//! A path as egui draws one: a circle of curves, its area and its middle.
#![allow(missing_docs)]

use vello_cpu::kurbo::{Affine, BezPath};
use vello_cpu::{Pixmap, RenderContext, Resources, color};

/// The distance of the control points of a quarter circle from its ends, in radii.
const QUARTER: f64 = 0.552_284_749_8;

fn circle(x: f64, y: f64, r: f64) -> BezPath {
    let (mut path, k) = (BezPath::new(), QUARTER * r);
    path.move_to((x + r, y));
    path.curve_to((x + r, y + k), (x + k, y + r), (x, y + r));
    path.curve_to((x - k, y + r), (x - r, y + k), (x - r, y));
    path.curve_to((x - r, y - k), (x - k, y - r), (x, y - r));
    path.curve_to((x + k, y - r), (x + r, y - k), (x + r, y));
    path.close_path();
    path
}

#[test]
fn a_circle_has_its_area_in_its_place() {
    let path = circle(10.25, -4.5, 6.0);
    let bounds = path.control_box().expand();
    assert_eq!((bounds.x0, bounds.y0, bounds.width(), bounds.height()), (4.0, -11.0, 13.0, 13.0));
    let mut context = RenderContext::new(13, 13);
    context.set_transform(Affine::translate((-bounds.x0, -bounds.y0)));
    context.set_paint(color::OpaqueColor::<color::Srgb>::WHITE);
    context.fill_path(&path);
    let mut picture = Pixmap::new(13, 13);
    context.render(&mut picture, &mut Resources::new());
    let pixels: Vec<u8> = picture.data_as_u8_slice().chunks_exact(4).map(|pixel| pixel[3]).collect();
    assert!(picture.data_as_u8_slice().chunks_exact(4).all(|p| p.iter().all(|&channel| channel == p[3])));
    let weigh = |weight: fn(usize) -> f64| -> f64 {
        pixels.iter().enumerate().map(|(index, &value)| f64::from(value) / 255.0 * weight(index)).sum()
    };
    let area = weigh(|_| 1.0);
    // Chords lie inside the circle, by at most a twentieth of a pixel along its 38 pixels of length; two thirds of
    // that on average.
    let paper = std::f64::consts::PI * 36.0;
    assert!(area < paper + 0.1 && area > paper - 1.3, "{area} instead of {paper}");
    let middle = (weigh(|i| (i % 13) as f64 + 0.5) / area, weigh(|i| (i / 13) as f64 + 0.5) / area);
    assert!((middle.0 - 6.25).abs() < 0.02 && (middle.1 - 6.5).abs() < 0.02, "{middle:?}");
}

#[test]
fn a_curve_of_degree_two_and_an_open_contour_are_filled() {
    // A parabola from 0 to 4 with its top at 2: its area is 2/3 of 4 times 2. Filling closes the open side.
    let mut path = BezPath::new();
    path.move_to((0.0, 4.0));
    path.quad_to((2.0, 0.0), (4.0, 4.0));
    let mut context = RenderContext::new(4, 4);
    context.fill_path(&path);
    let mut picture = Pixmap::new(4, 4);
    context.render(&mut picture, &mut Resources::new());
    let area: f64 = picture.data_as_u8_slice().iter().step_by(4).map(|&value| f64::from(value) / 255.0).sum();
    // 8 bits of 16 pixels, and chords within the curve.
    assert!((area - 16.0 / 3.0).abs() < 0.15, "{area}");
}
