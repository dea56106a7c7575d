//! Overlays and views that are not quantities of the equation: their pixels, and no others.

use super::paint::{loaded, renderer};
use crate::DisplayTexture;
use crate::display::{DisplayOptions, View};
use crate::glsl::OVERDRAW_SCALE;
use crate::renderer::{OutlinedPart, Renderer};
use glam::{DVec3, DVec4};
use gonio_gl::Gl;
use gonio_scene::{Frame, Scene};
use gonio_scene::{Overlays, SpecialView};

const SIZE: usize = 120;
const HEADER: &str = "[picture]\nwidth = 120\nheight = 120\n[camera]\nposition = [0, 0, 6]\ntarget = [0, 0, 0]\n\
                      [background]\ntop = \"#808080\"\nbottom = \"#808080\"\n";

/// Cubes at heights and distances, each with the length of its edges, in model units.
pub(super) fn cubes(placed: &[([f64; 3], f64)], shading: &str) -> Scene {
    let object = |(at, scale): &([f64; 3], f64)| {
        format!(
            "[[object]]\nmodel = \"builtin:cube\"\nshading = \"{shading}\"\ntranslate = {at:?}\nscale = [{scale}, {scale}, {scale}]\n"
        )
    };
    loaded(&format!("{HEADER}{}", placed.iter().map(object).collect::<String>()))
}

struct Bench {
    gl: Gl,
    renderer: Renderer,
}

impl Bench {
    fn new(es: bool) -> Self {
        let (gl, renderer) = renderer(es);
        Bench { gl, renderer }
    }

    fn paint(&mut self, scene: &Scene, view: View, overlays: Overlays) -> Vec<[u8; 4]> {
        let mut canvas = DisplayTexture::new(&self.gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
        let uploaded = self.renderer.upload(scene).unwrap_or_else(|error| panic!("{error}"));
        let painted =
            self.renderer.paint(&uploaded, &scene.frame(0.0), &DisplayOptions { view, overlays }, &mut canvas);
        painted.unwrap_or_else(|error| panic!("{error}"));
        canvas.read8().chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]).collect()
    }
}

const NO: Overlays = Overlays { wireframe: false, normals: false, boxes: false };

fn differing(a: &[[u8; 4]], b: &[[u8; 4]]) -> Vec<(f64, f64)> {
    let places = a.iter().zip(b).enumerate().filter(|(_, (a, b))| a != b).map(|(i, _)| i);
    places.map(|i| ((i % SIZE) as f64 + 0.5, (i / SIZE) as f64 + 0.5)).collect()
}

/// The place of a point of the world in the picture, in pixels from the top left.
fn on_screen(frame: &Frame, point: DVec3) -> (f64, f64) {
    let clip: DVec4 = frame.camera.clip_from_view(1.0) * frame.camera.view_from_world() * point.extend(1.0);
    let (x, y) = (clip.x / clip.w, clip.y / clip.w);
    (0.5 * (x + 1.0) * SIZE as f64, 0.5 * (1.0 - y) * SIZE as f64)
}

/// Pixels from the segment between two places on the screen.
fn distance((x, y): (f64, f64), (ax, ay): (f64, f64), (bx, by): (f64, f64)) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let t = (((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
    (x - ax - t * dx).hypot(y - ay - t * dy)
}

#[test]
fn a_wireframe_is_on_the_visible_edges() {
    /// Start and end on the screen.
    type Line = ((f64, f64), (f64, f64));
    for es in [false, true] {
        let mut bench = Bench::new(es);
        let wires = Overlays { wireframe: true, ..NO };
        let near = cubes(&[([0.0, 0.0, 0.0], 1.0)], "phong");
        let plain = bench.paint(&near, View::Picture, NO);
        let wired = bench.paint(&near, View::Picture, wires);
        // Only the front face is visible: four edges and a diagonal.
        let frame = near.frame(0.0);
        let (min, max) = near.bounds();
        let front = [(min.x, min.y), (max.x, min.y), (max.x, max.y), (min.x, max.y)]
            .map(|(x, y)| on_screen(&frame, DVec3::new(x, y, max.z)));
        let edges = [(0, 1), (1, 2), (2, 3), (3, 0)].map(|(a, b)| (front[a], front[b]));
        let diagonals = [(front[0], front[2]), (front[1], front[3])];
        let changed = differing(&plain, &wired);
        let to = |p, lines: &[Line]| lines.iter().map(|(a, b)| distance(p, *a, *b)).fold(f64::INFINITY, f64::min);
        let diagonal = diagonals.map(|d| changed.iter().filter(|&&p| to(p, &[d]) < 1.0).count());
        assert!(diagonal[0].max(diagonal[1]) > 30, "a square is two triangles: {diagonal:?}");
        for &place in &changed {
            // Half a width and the smooth edge of a pixel, and half of that pixel.
            assert!(to(place, &edges).min(to(place, &diagonals)) < 2.0, "{place:?} is on no edge");
        }
        for (a, b) in edges {
            let seen = changed.iter().filter(|&&p| distance(p, a, b) < 1.5).count();
            assert!(seen > 30, "only {seen} pixels of an edge");
        }
        // The object behind does not show through.
        let hidden = cubes(&[([0.0, 0.0, 0.0], 1.0), ([0.0, 0.0, -3.0], 0.5)], "phong");
        // Its lights are different, because they are placed around both objects: so it is compared with its own picture
        // without wires.
        let plain = bench.paint(&hidden, View::Picture, NO);
        let wired = bench.paint(&hidden, View::Picture, wires);
        assert_eq!(differing(&plain, &wired), changed, "the far cube is hidden");
    }
}

#[test]
fn an_outline_is_around_the_part_and_nowhere_else() {
    for es in [false, true] {
        let mut bench = Bench::new(es);
        // The second cube is behind the first.
        let scene = cubes(&[([0.0, 0.0, 0.0], 1.0), ([0.7, 0.0, -2.0], 0.6)], "phong");
        let frame = scene.frame(0.0);
        let uploaded = bench.renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        for object in 0..2 {
            let mut layer = DisplayTexture::new(&bench.gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
            let outlined = OutlinedPart { object, part: 0, color: [1.0, 0.5, 0.0, 1.0] };
            bench.renderer.paint_outline(&uploaded, &frame, &outlined, &mut layer).unwrap_or_else(|e| panic!("{e}"));
            let pixels = layer.read8();
            let drawn: Vec<(f64, f64)> = (0..SIZE * SIZE)
                .filter(|i| pixels[4 * i + 3] > 0)
                .map(|i| ((i % SIZE) as f64 + 0.5, (i / SIZE) as f64 + 0.5))
                .collect();
            let mesh = &scene.meshes[scene.objects[object].mesh];
            let matrix = scene.objects[object].world_from_model;
            let triangles: Vec<[(f64, f64); 3]> = (0..mesh.triangle_count())
                .map(|t| mesh.triangle_positions(t).map(|p| on_screen(&frame, matrix.transform_point3(p.as_dvec3()))))
                .collect();
            let edges = || triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
            assert!(drawn.len() > 100, "{} pixels of object {object}", drawn.len());
            for &at in &drawn {
                assert!(!triangles.iter().any(|t| is_inside(at, t)), "{at:?} is on the part");
                let nearest = edges().map(|(a, b)| distance(at, a, b)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 3.5, "{at:?} is {nearest} pixels from the part");
            }
            // The outline is closed: it is at every corner of the silhouette's box.
            let corners = || triangles.iter().flatten().copied();
            let right = corners().map(|(x, _)| x).fold(0.0, f64::max);
            assert!(drawn.iter().any(|(x, _)| *x > right), "nothing at the right");
        }
        let nothing = OutlinedPart { object: 7, part: 0, color: [1.0; 4] };
        let mut layer = DisplayTexture::new(&bench.gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
        bench.renderer.paint_outline(&uploaded, &frame, &nothing, &mut layer).unwrap_or_else(|e| panic!("{e}"));
        assert!(layer.read8().iter().all(|v| *v == 0));
    }
}

/// Whether a place is inside a triangle, and not within half a pixel of its edges.
fn is_inside((x, y): (f64, f64), triangle: &[(f64, f64); 3]) -> bool {
    let side = |a: (f64, f64), b: (f64, f64)| (b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0);
    let [a, b, c] = *triangle;
    let sides = [side(a, b), side(b, c), side(c, a)];
    let is_clear = [(a, b), (b, c), (c, a)].iter().all(|(a, b)| distance((x, y), *a, *b) > 0.71);
    is_clear && (sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0))
}

#[test]
fn wires_can_be_had_alone_and_over_any_view() {
    let mut bench = Bench::new(false);
    let scene = cubes(&[([0.0, 0.0, 0.0], 1.0)], "flat");
    let alone = bench.paint(&scene, View::Special(SpecialView::Nothing), Overlays { wireframe: true, ..NO });
    let nothing = bench.paint(&scene, View::Special(SpecialView::Nothing), NO);
    assert!(nothing.iter().all(|p| *p == nothing[0] && p[3] == 255 && p[0] > 100), "{:?}", nothing[0]);
    let wires = differing(&alone, &nothing).len();
    assert!((300..1500).contains(&wires), "{wires}");
    // The exposure does not change the colour of lines.
    let mut bright = scene.clone();
    bright.settings.picture.exposure = 3.0;
    let darkest = |p: &[[u8; 4]]| p.iter().map(|p| p[0]).min();
    let lit = bench.paint(&bright, View::Picture, Overlays { wireframe: true, ..NO });
    assert!(darkest(&lit) < Some(80), "{:?}", darkest(&lit));
}

#[test]
fn boxes_have_their_corners_where_the_objects_end() {
    for es in [false, true] {
        let mut bench = Bench::new(es);
        // Seen from the side, so that no edge is behind another.
        let mut scene = cubes(&[([0.0, 0.0, 0.0], 0.8)], "phong");
        scene.settings.camera.position = [3.0, 2.0, 5.0];
        let frame = scene.frame(0.0);
        let plain = bench.paint(&scene, View::Picture, NO);
        let boxed = bench.paint(&scene, View::Picture, Overlays { boxes: true, ..NO });
        let changed = differing(&plain, &boxed);
        let (min, max) = scene.bounds();
        let corner = |i: usize| {
            let pick = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
            on_screen(&frame, DVec3::new(pick(1, min.x, max.x), pick(2, min.y, max.y), pick(4, min.z, max.z)))
        };
        let edges: Vec<_> = (0..8).flat_map(|a| [1, 2, 4].map(|bit| (a, a | bit))).filter(|(a, b)| a != b).collect();
        assert_eq!(edges.len(), 12);
        for place in &changed {
            let nearest =
                edges.iter().map(|&(a, b)| distance(*place, corner(a), corner(b))).fold(f64::INFINITY, f64::min);
            assert!(nearest < 2.0, "{place:?} is {nearest} pixels from any edge");
        }
        // All but the corner that is farthest from the eye; orange, which does not occur in clay.
        let orange = |(x, y): (f64, f64)| {
            let at = |dx: i64, dy: i64| boxed[((y as i64 + dy) * SIZE as i64 + x as i64 + dx) as usize];
            (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy))).any(|(dx, dy)| {
                let [r, g, b, _] = at(dx, dy);
                r > 200 && g > 110 && b < 90
            })
        };
        for i in (1..8).map(corner) {
            assert!(orange(i), "{i:?}");
        }
        assert!(!orange(corner(0)), "that one is behind the cube");
    }
}

#[test]
fn normals_stand_out_of_the_surface_by_their_length() {
    for (shading, count) in [("phong", 500), ("flat", 960)] {
        let mut bench = Bench::new(false);
        let scene = loaded(&format!("{HEADER}[[object]]\nmodel = \"builtin:suzanne\"\nshading = \"{shading}\"\n"));
        let plain = bench.paint(&scene, View::Special(SpecialView::Nothing), NO);
        let with = bench.paint(&scene, View::Special(SpecialView::Nothing), Overlays { normals: true, ..NO });
        let changed = differing(&plain, &with);
        assert!(changed.len() > count, "{shading}: {} pixels", changed.len());
        // The silhouette, grown by the length of a normal (a fiftieth of the diagonal, nearer by it at most) and a line.
        let silhouette = differing(&bench.paint(&scene, View::Picture, NO), &plain);
        let (min, max) = scene.bounds();
        let length = 0.02 * (max - min).length();
        let frame = scene.frame(0.0);
        let nearest = frame.camera.position.z - max.z - length;
        let pixels = length / nearest / (0.5 * frame.camera.fov_y_rad).tan() * 0.5 * SIZE as f64;
        let reach = |places: &[(f64, f64)]| {
            places.iter().fold([f64::INFINITY, f64::INFINITY, 0.0, 0.0], |[l, t, r, b], &(x, y)| {
                [f64::min(l, x), f64::min(t, y), f64::max(r, x), f64::max(b, y)]
            })
        };
        let (inner, outer) = (reach(&silhouette), reach(&changed));
        for side in 0..4 {
            let beyond = if side < 2 { inner[side] - outer[side] } else { outer[side] - inner[side] };
            assert!(beyond > -1.0 && beyond < pixels + 2.0, "{shading}: side {side} by {beyond} of {pixels}");
        }
    }
}

#[test]
fn overdraw_counts_shaded_fragments() {
    for es in [false, true] {
        let mut bench = Bench::new(es);
        let (near, far) = (([0.0, 0.0, 1.0], 0.5), ([0.0, 0.0, -2.0], 0.5));
        let mut fragments = |placed: &[_]| {
            let scene = cubes(placed, "phong");
            let uploaded = bench.renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
            let counted = bench.renderer.count_fragments(&uploaded, &scene.frame(0.0));
            let counted = counted.unwrap_or_else(|error| panic!("{error}"));
            let pixels = bench.paint(&scene, View::Special(SpecialView::Overdraw), NO);
            let scale = OVERDRAW_SCALE.map(|c| c.map(|v| (v * 255.0).round() as u8));
            let mut by_colour = [0_u64; 9];
            for [r, g, b, _] in pixels {
                // Rounding of the driver: one step.
                let is = |c: &[u8; 3]| [r, g, b].iter().zip(c).all(|(a, b)| a.abs_diff(*b) <= 1);
                let step = scale.iter().position(is).unwrap_or_else(|| panic!("({r}, {g}, {b}) is not of the scale"));
                by_colour[step] += 1;
            }
            let sum: u64 = by_colour.iter().zip(0..).map(|(pixels, count)| pixels * count).sum();
            assert_eq!(sum, counted, "the picture shows what was counted");
            (counted, by_colour)
        };
        let (one, _) = fragments(&[near]);
        let (other, _) = fragments(&[far]);
        assert!(one > other && other > 300, "{one} {other}");
        let (behind_first, colours) = fragments(&[far, near]);
        assert_eq!(behind_first, one + other, "drawn first, hidden later");
        assert_eq!(colours[2], other);
        assert_eq!(fragments(&[near, far]).0, one, "hidden fragments are not shaded");
    }
}

#[test]
fn the_checker_shows_where_u_and_v_lead() {
    for es in [false, true] {
        let mut bench = Bench::new(es);
        let text = format!("{HEADER}[[object]]\nmodel = \"builtin:cube\"\n");
        let mut scene = loaded(&text);
        // A square that fills the middle of the picture, u to the right and v upwards.
        let corner = |x: f32, y: f32| [x * 1.6, y * 1.6, 0.0];
        let mesh = gonio_mesh::Mesh {
            positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            tex_coords: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Default::default()
        };
        scene.meshes[0] = std::sync::Arc::new(mesh);
        scene.objects[0].parts.truncate(1);
        (scene.objects[0].parts[0].first_triangle, scene.objects[0].parts[0].triangle_count) = (0, 2);
        let frame = scene.frame(0.0);
        let pixels = bench.paint(&scene, View::Special(SpecialView::UvChecker), NO);
        // Away from the middle of a square, beside the mark of the first one.
        let at = |u: f64, v: f64| {
            let (x, y) = on_screen(&frame, DVec3::new(3.2 * u - 1.6, 3.2 * v - 1.6, 0.0));
            pixels[y as usize * SIZE + x as usize].map(i32::from)
        };
        let square = |i: i32, j: i32| at((f64::from(i) + 0.3) / 8.0, (f64::from(j) + 0.8) / 8.0);
        for i in 0..8 {
            for j in 0..8 {
                let here = square(i, j);
                // Two further is a square of the same kind.
                if i < 6 {
                    let [r, g, ..] = square(i + 2, j);
                    assert!(r > here[0] + 10 && (g - here[1]).abs() < 12, "red grows with u: {i} {j}");
                }
                if j < 6 {
                    let [r, g, ..] = square(i, j + 2);
                    assert!(g > here[1] + 10 && (r - here[0]).abs() < 12, "green grows with v: {i} {j}");
                }
                if i < 7 {
                    let (a, b) = (here, square(i + 1, j));
                    let lighter = a[2] > b[2];
                    assert_eq!(lighter, (i + j) % 2 == 1, "squares alternate: {i} {j}: {a:?} {b:?}");
                }
            }
        }
        // The mark of the first square points to the right.
        let white = |u: f64| at(u / 8.0, 0.5 / 8.0)[..3].iter().all(|c| *c > 200);
        assert!(white(0.35) && !white(0.85), "{:?}", at(0.35 / 8.0, 0.5 / 8.0));
    }
}
