//! Painting for a window: the correct picture on a display texture, the state of the window unchanged, no resource created twice.

use super::context;
use crate::display::{DisplayOptions, View};
use crate::renderer::Renderer;
use crate::{DisplayTexture, Presenter};
use gonio_gl::Gl;
use gonio_gl::target::ColorPrecision;
use gonio_light::Quantity;
use gonio_scene::edit::{Edited, apply};
use gonio_scene::files::Disk;
use gonio_scene::{Overlays, SpecialView};
use gonio_scene::{Scene, ViewSpec};
use std::path::Path;
use std::rc::Rc;

pub(super) fn loaded(text: &str) -> Scene {
    let scene = gonio_scene::toml_file::read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"))
}

pub(super) fn renderer(es: bool) -> (Gl, Renderer) {
    let context = context(es);
    let renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|error| panic!("{error}"));
    (context.gl().clone(), renderer)
}

fn sized(scene: &Scene, width: u32, height: u32) -> gonio_scene::Frame {
    gonio_scene::Frame { width, height, ..scene.frame(0.0) }
}

const MONKEY: &str = "[picture]\nwidth = 90\nheight = 70\n[[object]]\nmodel = \"builtin:suzanne\"\n";
const ALL: Overlays = Overlays { wireframe: true, normals: true, boxes: true };

#[test]
fn a_display_texture_has_the_pixels_of_a_file() {
    let scene = loaded(MONKEY);
    let frame = scene.frame(0.0);
    let normal = ViewSpec { quantity: Quantity::Normal, light: None };
    for es in [false, true] {
        let (gl, mut renderer) = renderer(es);
        let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        let mut canvas = DisplayTexture::new(&gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
        for view in [None, Some(normal)] {
            let painted = renderer.paint(&uploaded, &frame, &view.into(), &mut canvas);
            let painted = painted.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((canvas.size(), painted.notes.len()), ([90, 70], 0), "{:?}", painted.notes);
            assert_eq!((painted.draw_calls, painted.statistics), (1, None));
            let drawn = renderer.render_at(&uploaded, &frame, view, ColorPrecision::Half);
            let expected = drawn.and_then(|d| d.encoded8()).unwrap_or_else(|error| panic!("{error}"));
            assert!(canvas.read8() == expected.rgba, "not one bit differs: es {es}, {view:?}");
        }
    }
}

/// A finished picture of the same light is shown as the scene that it is of; at twice the size each pixel is four.
#[test]
fn a_finished_picture_is_shown_like_a_drawn_one() {
    let scene = loaded(&format!("{MONKEY}[environment]\nimage = \"debug\"\n"));
    for es in [false, true] {
        let (gl, mut renderer) = renderer(es);
        let mut frame = gonio_scene::Frame { samples: 1, ..scene.frame(0.0) };
        frame.output.exposure = -0.7;
        let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        let [mut drawn, mut shown, mut large] =
            [0; 3].map(|_| DisplayTexture::new(&gl, [1, 1]).unwrap_or_else(|error| panic!("{error}")));
        renderer.paint(&uploaded, &frame, &DisplayOptions::default(), &mut drawn).unwrap_or_else(|e| panic!("{e}"));
        let light = renderer.paint_linear(&uploaded, &frame, None).unwrap_or_else(|error| panic!("{error}"));
        renderer.paint_picture(&light, &frame, &mut shown).unwrap_or_else(|error| panic!("{error}"));
        let (drawn, shown) = (drawn.read8(), shown.read8());
        // Full floats against half floats: one step.
        assert!(drawn.iter().zip(&shown).all(|(a, b)| a.abs_diff(*b) <= 1), "es {es}");
        let twice = gonio_scene::Frame { width: 180, height: 140, ..frame };
        renderer.paint_picture(&light, &twice, &mut large).unwrap_or_else(|error| panic!("{error}"));
        let large_pixels = large.read8();
        assert_eq!(large.size(), [180, 140]);
        let pixel = |pixels: &[u8], i: usize| [0, 1, 2].map(|c| pixels[4 * i + c]);
        assert!((0..180 * 140).all(|i| pixel(&large_pixels, i) == pixel(&shown, i / 360 * 90 + i % 180 / 2)));
    }
}

/// The sketches are drawn upside down onto the canvas: the monkey looks to one side, and is mirrored.
const TURNED: &str = "[picture]\nwidth = 90\nheight = 70\n[[object]]\nmodel = \"builtin:suzanne\"\nrotate = [20, 35, 0]\n\
                      scale = [-1, 1, 1]\n[background]\ntop = [0.9, 0.2, 0.1]\nbottom = [0.1, 0.2, 0.9]\n";
const OPEN: &str =
    "[picture]\nwidth = 90\nheight = 70\n[[object]]\nmodel = \"builtin:still-life\"\nshading = \"flat\"\n";

#[test]
fn a_sketch_with_one_sample_is_the_picture() {
    let around = format!("{MONKEY}[environment]\nimage = \"debug\"\n");
    for es in [false, true] {
        for (text, is_exact) in [(TURNED, false), (OPEN, false), (&around, true)] {
            let [sketch, picture] = sketched_and_painted(es, text, 1);
            // A pixel whose centre lies on an edge may be on either side of it.
            let different = (0..90 * 70).filter(|at| !is_near(&sketch, &picture, *at)).count();
            assert!(different <= if is_exact { 0 } else { 20 }, "es {es}: {different} pixels differ\n{text}");
        }
    }
}

/// With four samples the pixels of edges alone differ: their colours are mixed after encoding. Fine triangles, many for few
/// pixels, are drawn as a finer picture.
#[test]
fn a_sketch_differs_from_the_picture_at_edges_alone() {
    let fine = TURNED.replace("width = 90", "width = 30").replace("height = 70", "height = 24");
    for es in [false, true] {
        for (text, [width, height]) in [(TURNED, [90, 70]), (&fine, [30, 24])] {
            let [sketch, picture] = sketched_and_painted(es, text, 4);
            let [hard, _] = sketched_and_painted(es, text, 1);
            let (mut edges, mut others) = (0, 0);
            for at in (0..width * height).filter(|at| !is_near(&sketch, &picture, *at)) {
                let (x, y) = (at % width, at / width);
                let around = (0..9).map(|i| [(x + i % 3).saturating_sub(1), (y + i / 3).saturating_sub(1)]);
                let is_edge = around.map(|[x, y]| y.min(height - 1) * width + x.min(width - 1)).any(|other| {
                    let step = |c: usize| hard[4 * at + c].abs_diff(hard[4 * other + c]);
                    (0..3).any(|c| step(c) > 6)
                });
                // A ridge thinner than a pixel may lie between the centres of all of them.
                others += usize::from(!is_edge);
                let most = (0..3).map(|c| sketch[4 * at + c].abs_diff(picture[4 * at + c])).max();
                assert!(most < Some(70), "es {es}: {x},{y} differs by {most:?}\n{text}");
                edges += usize::from(is_edge);
            }
            assert!(others <= 3, "es {es}: {others} pixels differ that are on no edge\n{text}");
            assert!(edges > 10, "es {es}: the samples of {edges} pixels were mixed after encoding\n{text}");
        }
    }
}

/// A scene as sketched, and as painted: 8 bits a channel, the top row first.
fn sketched_and_painted(es: bool, text: &str, samples: u32) -> [Vec<u8>; 2] {
    let scene = loaded(text);
    let (gl, mut renderer) = renderer(es);
    let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let [mut sketch, mut picture] =
        [0; 2].map(|_| DisplayTexture::new(&gl, [1, 1]).unwrap_or_else(|error| panic!("{error}")));
    let plain = DisplayOptions::default();
    let frame = gonio_scene::Frame { samples, ..scene.frame(0.0) };
    renderer.paint_sketch(&uploaded, &frame, &plain, &mut sketch).unwrap_or_else(|error| panic!("{error}"));
    renderer.paint(&uploaded, &frame, &plain, &mut picture).unwrap_or_else(|error| panic!("{error}"));
    [sketch.read8(), picture.read8()]
}

/// Whether two pictures have the same colour there, but for rounding.
fn is_near(a: &[u8], b: &[u8], at: usize) -> bool {
    (4 * at..4 * at + 4).all(|i| a[i].abs_diff(b[i]) <= 2)
}

#[test]
fn where_nothing_is_a_canvas_is_premultiplied() {
    let scene = loaded(&format!("[background]\ntransparent = true\n{MONKEY}"));
    let frame = scene.frame(0.0);
    let (gl, mut renderer) = renderer(false);
    let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let mut canvas = DisplayTexture::new(&gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
    renderer
        .paint(&uploaded, &frame, &DisplayOptions::default(), &mut canvas)
        .unwrap_or_else(|error| panic!("{error}"));
    let pixels = canvas.read8();
    // Rounding to 8 bits is by half a step, of the colour and of the alpha each.
    assert!(pixels.chunks_exact(4).all(|p| p[..3].iter().all(|c| *c <= p[3].saturating_add(1))));
    assert!(pixels.chunks_exact(4).filter(|p| (1..255).contains(&p[3])).count() > 50, "edges are half transparent");
    assert_eq!(pixels[..4], [0; 4]);
}

#[test]
fn a_picture_is_shown_pixel_for_pixel_and_blended() {
    let below = [0_u8, 255, 0, 255];
    for (es, transparent) in [(false, false), (false, true), (true, false), (true, true)] {
        let scene = loaded(&format!("[background]\ntransparent = {transparent}\n{MONKEY}"));
        let (gl, mut renderer) = renderer(es);
        let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
        let [mut canvas, window] =
            [[1, 1], [90, 70]].map(|size| DisplayTexture::new(&gl, size).unwrap_or_else(|error| panic!("{error}")));
        let painted = renderer.paint(&uploaded, &scene.frame(0.0), &DisplayOptions::default(), &mut canvas);
        painted.unwrap_or_else(|error| panic!("{error}"));
        let presenter = Presenter::new(&gl).unwrap_or_else(|error| panic!("{error}"));
        let picture = presenter.presentation(canvas.texture());
        let picture = if transparent { picture } else { picture.opaque() };
        window.output().bind(&gl);
        gl.clear_color(0.0, 1.0, 0.0, 1.0);
        gl.clear(glow::COLOR_BUFFER_BIT);
        picture.draw(&gl);
        let (picture, shown) = (canvas.read8(), window.read8());
        // The first row of a window in memory is the lowest.
        let rows = picture.chunks_exact(90 * 4).rev().flatten();
        let expected: Vec<u8> = rows.copied().collect();
        if !transparent {
            assert!(shown == expected, "es {es}: not one bit differs");
            continue;
        }
        for (shown, expected) in shown.chunks_exact(4).zip(expected.chunks_exact(4)) {
            for channel in 0..4 {
                let through = u32::from(below[channel]) * u32::from(255 - expected[3]) / 255;
                let sum = u32::from(expected[channel]) + through;
                // Rounding to 8 bits, here down and there to the nearest.
                assert!(sum.abs_diff(shown[channel].into()) <= 1, "es {es}: {shown:?} of {expected:?}");
            }
        }
    }
}

#[test]
fn counters_are_read_where_they_are_asked_for() {
    let scene = loaded(MONKEY);
    let (gl, mut renderer) = renderer(false);
    let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let mut canvas = DisplayTexture::new(&gl, [90, 70]).unwrap_or_else(|error| panic!("{error}"));
    let show = DisplayOptions { view: View::Picture, overlays: ALL };
    let painted = renderer.paint_counted(&uploaded, &scene.frame(0.0), &show, &mut canvas);
    let painted = painted.unwrap_or_else(|error| panic!("{error}"));
    let statistics = painted.statistics.unwrap_or_default();
    assert!(statistics.vertices.is_some_and(|v| v >= 500), "{statistics:?}");
    assert!(statistics.fragments.is_some_and(|f| f > 1000), "{statistics:?}");
    // The scene's one, that of the depth of overlays, and one for each overlay.
    assert_eq!((statistics.draw_calls, painted.draw_calls), (1, 5));
}

/// The state of other code, different from that after a frame.
#[test]
fn the_state_of_a_window_is_left_alone() {
    let scene = loaded(
        "[picture]\nwidth = 40\nheight = 30\n[environment]\nimage = \"debug\"\nsize = 8\n[[object]]\nmodel = \"builtin:cube\"\nmaterial.opacity = 0.5\n",
    );
    let (gl, mut renderer) = renderer(false);
    let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let mut canvas = DisplayTexture::new(&gl, [40, 30]).unwrap_or_else(|error| panic!("{error}"));
    let mine = DisplayTexture::new(&gl, [64, 64]).unwrap_or_else(|error| panic!("{error}"));
    let state = |gl: &Gl| -> Vec<i32> {
        let mut all: Vec<i32> = [
            glow::DRAW_FRAMEBUFFER_BINDING,
            glow::READ_FRAMEBUFFER_BINDING,
            glow::BLEND_SRC_RGB,
            glow::BLEND_DST_RGB,
            glow::BLEND_SRC_ALPHA,
            glow::BLEND_DST_ALPHA,
            glow::DEPTH_FUNC,
            glow::ACTIVE_TEXTURE,
            glow::VERTEX_ARRAY_BINDING,
            glow::CURRENT_PROGRAM,
            glow::FRONT_FACE,
            glow::SAMPLER_BINDING,
        ]
        .map(|parameter| gl.get_parameter_i32(parameter))
        .to_vec();
        for parameter in [glow::VIEWPORT, glow::SCISSOR_BOX] {
            all.extend(gl.get_rectangle(parameter));
        }
        let switches = [
            glow::SCISSOR_TEST,
            glow::BLEND,
            glow::DEPTH_TEST,
            glow::CULL_FACE,
            glow::STENCIL_TEST,
            glow::POLYGON_OFFSET_FILL,
        ];
        all.extend(switches.map(|switch| i32::from(gl.is_enabled(switch))));
        all.push(i32::from(gl.get_depth_mask()));
        all
    };
    for show in [
        DisplayOptions { view: View::Picture, overlays: ALL },
        DisplayOptions { view: View::Special(SpecialView::Overdraw), ..DisplayOptions::default() },
        DisplayOptions { view: View::Special(SpecialView::UvChecker), ..DisplayOptions::default() },
    ] {
        mine.output().bind(&gl);
        gl.viewport(3, 4, 50, 40);
        gl.scissor(1, 2, 30, 20);
        gl.enable(glow::SCISSOR_TEST);
        gl.enable(glow::BLEND);
        gl.enable(glow::STENCIL_TEST);
        gl.blend_func_separate(glow::ONE, glow::ONE_MINUS_SRC_ALPHA, glow::ONE_MINUS_DST_ALPHA, glow::ONE);
        gl.depth_func(glow::GEQUAL);
        gl.depth_mask(false);
        gl.active_texture(glow::TEXTURE3);
        gl.use_program(None);
        gl.bind_vertex_array(None);
        let before = state(&gl);
        let first = renderer.paint(&uploaded, &scene.frame(0.0), &show, &mut canvas);
        first.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(state(&gl), before, "{show:?}");
        let pixels = canvas.read8();
        mine.output().bind(&gl);
        gl.disable(glow::SCISSOR_TEST);
        let second = renderer.paint(&uploaded, &scene.frame(0.0), &show, &mut canvas);
        second.unwrap_or_else(|error| panic!("{error}"));
        assert!(canvas.read8() == pixels, "the scissor and stencil of other code have no effect: {show:?}");
    }
}

#[test]
fn panes_and_edits_share_resources_on_the_gpu() {
    let scene = loaded(
        "[environment]\nimage = \"debug\"\nsize = 8\n[[object]]\nmodel = \"builtin:still-life\"\n[[object]]\nmodel = \"builtin:cube\"\nmaterial.medium = \"glass\"\nmaterial.surfaces = \"two\"\n",
    );
    let (_gl, mut renderer) = renderer(false);
    let count = |r: &Renderer| {
        let s = &r.cache;
        [s.geometries.count(), s.textures.count(), s.environments.count(), s.bodies.count()]
    };
    let first = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let at_first = count(&renderer);
    assert!(at_first.iter().all(|n| *n > 0), "{at_first:?}");
    // Another pane with its own clone.
    let pane = renderer.upload(&scene.clone()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(count(&renderer), at_first);
    assert!(pane.textures.iter().zip(&first.textures).all(|(a, b)| Rc::ptr_eq(a, b)));
    // An edit of a colour and a light.
    let mut edited = scene.settings.clone();
    edited.objects[0].material.shininess = Some(3.0);
    edited.lights.clear();
    let Ok(Edited::Done(applied)) = apply(&scene, edited) else { panic!("it needs no files") };
    let after = renderer.upload(&applied.loaded).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(count(&renderer), at_first);
    // Another shading of one object: one more geometry, while the other panes keep theirs.
    let mut edited = scene.settings.clone();
    edited.objects[0].shading = gonio_scene::scene_file::Shading::Flat;
    let Ok(Edited::Done(applied)) = apply(&scene, edited) else { panic!("it needs no files") };
    let flat = renderer.upload(&applied.loaded).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(count(&renderer), [at_first[0] + 1, at_first[1], at_first[2], at_first[3]]);
    drop((first, pane, after));
    assert_eq!(count(&renderer), at_first, "the shared form of the first object is unused");
    drop(flat);
    assert_eq!(count(&renderer), [0; 4]);
}

#[test]
fn panes_of_several_sizes_keep_their_targets() {
    let scene = loaded(MONKEY);
    let (gl, mut renderer) = renderer(false);
    let uploaded = renderer.upload(&scene).unwrap_or_else(|error| panic!("{error}"));
    let mut canvas = DisplayTexture::new(&gl, [8, 8]).unwrap_or_else(|error| panic!("{error}"));
    let texture = canvas.texture();
    let mut paint = |renderer: &mut Renderer, [w, h]: [u32; 2]| {
        let frame = sized(&scene, w, h);
        renderer
            .paint(&uploaded, &frame, &DisplayOptions::default(), &mut canvas)
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((canvas.size(), canvas.texture()), ([w, h], texture), "its name stays");
        renderer.targets.last().map(|target| Rc::as_ptr(target) as usize)
    };
    let sizes = [[40, 30], [20, 30], [40, 15], [20, 15]];
    let first: Vec<_> = sizes.map(|size| paint(&mut renderer, size)).to_vec();
    let second: Vec<_> = sizes.map(|size| paint(&mut renderer, size)).to_vec();
    assert_eq!(first, second, "each pane has its own");
    // A pane that is being resized does not fill the memory.
    for width in 50..60 {
        paint(&mut renderer, [width, 30]);
        assert!(renderer.targets.count() <= 4);
    }
}
