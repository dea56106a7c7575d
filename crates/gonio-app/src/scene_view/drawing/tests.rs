//! The panes, drawn without a window.

use super::PaneRenderer;
use crate::document::{Document, Pane, PaneArrangement};
use crate::scene_view;
use crate::session::{FrameFacts, Session};
use gonio_gl::{Gl, HeadlessContext};
use gonio_light::{Quantity, Specular};
use gonio_render::Renderer;
use gonio_scene::SceneFile;
use gonio_scene::detail::LevelOfDetail;
use gonio_scene::difference::of_bytes;
use gonio_scene::edit::{Edited, apply};
use gonio_scene::files::BuiltinOnly;
use gonio_scene::scene_file::Shading;
use gonio_scene::{Frame, ViewSpec, load};
use std::path::Path;
use std::sync::Arc;

const SIZE: [u32; 2] = [160, 120];

fn context() -> HeadlessContext {
    HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"))
}

fn opened(input: &str) -> (Document, Session) {
    let scene = load::describe(&[input], &BuiltinOnly).unwrap_or_else(|e| panic!("{e}"));
    let loaded = load::load(scene, Path::new(""), &BuiltinOnly).unwrap_or_else(|e| panic!("{e}"));
    let document = Document::from_scene(loaded.settings.clone());
    (document, Session { loaded: Some(Arc::new(loaded)), ..Session::default() })
}

fn pane_renderer(gl: &Gl) -> PaneRenderer {
    PaneRenderer::new(gl.clone()).unwrap_or_else(|error| panic!("{error}"))
}

/// Draws all panes as the window does. Returns the number of pictures.
fn draw(pane_renderer: &mut PaneRenderer, document: &Document, session: &mut Session) -> u64 {
    let mut facts = FrameFacts::default();
    pane_renderer.begin(&egui::Context::default(), document.panes.list.len());
    for index in 0..document.panes.list.len() {
        let picture =
            pane_renderer.picture(index, document, session, SIZE, &mut facts).unwrap_or_else(|e| panic!("{e}"));
        assert!(picture.is_some());
    }
    facts.pictures
}

fn two_panes(document: &mut Document) {
    let gouraud = Pane { shading: Some(Shading::Gouraud), specular: Some(Specular::Phong), ..Pane::default() };
    document.panes.set(vec![gouraud, Pane { shading: Some(Shading::Flat), ..Pane::default() }]);
}

/// Each pane equals the renderer's picture of the scene with the pane's settings.
#[test]
fn panes_are_the_renderers_pictures() {
    let context = context();
    let (mut document, mut session) = opened("builtin:sphere-128");
    two_panes(&mut document);
    let mut pane_renderer = pane_renderer(context.gl());
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 2);
    let mut renderer = Renderer::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"));
    for (index, pane) in document.panes.list.iter().enumerate() {
        let scene = pane.applied_to(&document.scene);
        let loaded = load::load(SceneFile::from(&scene), Path::new(""), &BuiltinOnly).unwrap_or_else(|e| panic!("{e}"));
        let frame = Frame { width: SIZE[0], height: SIZE[1], ..loaded.frame(0.0) };
        let uploaded = renderer.upload(&loaded).unwrap_or_else(|e| panic!("{e}"));
        let drawn = renderer.render(&uploaded, &frame, None).unwrap_or_else(|e| panic!("{e}"));
        let expected = drawn.encoded8().unwrap_or_else(|e| panic!("{e}"));
        let (pixels, size) = pane_renderer.pixels(index).unwrap_or_else(|| panic!("no picture"));
        assert_eq!(size, SIZE);
        let tally = of_bytes(&pixels, &expected.rgba, 1.0);
        // Half floats in the window, full ones in files: one step where rounding decides.
        assert_eq!(tally.differing(), 0, "pane {index}: {:?}", tally.spread());
    }
}

/// The background below the picture is filled only if it is visible: before there is a picture, between panes, behind holes.
#[test]
fn the_background_is_filled_only_where_it_is_visible() {
    let context = context();
    let (mut document, mut session) = opened("builtin:cube");
    let mut pane_renderer = pane_renderer(context.gl());
    let ctx = egui::Context::default();
    let is_filled = |document: &mut Document, session: &mut Session, mut pane_renderer: Option<&mut PaneRenderer>| {
        let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 300.0));
        let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
        let mut output = ctx.run_ui(input, |ui| {
            // A colour that nothing else has.
            ui.visuals_mut().extreme_bg_color = egui::Color32::from_rgb(1, 2, 3);
            scene_view::show(ui, document, session, pane_renderer.as_deref_mut())
                .unwrap_or_else(|error| panic!("{error}"));
        });
        // Nothing is displayed.
        output.textures_delta.clear();
        let is_ground = |shape: &egui::Shape| match shape {
            egui::Shape::Rect(rect) => rect.fill == egui::Color32::from_rgb(1, 2, 3),
            _ => false,
        };
        output.shapes.iter().any(|clipped| is_ground(&clipped.shape))
    };
    assert!(is_filled(&mut document, &mut session, None), "without OpenGL");
    let loaded = session.loaded.take();
    assert!(is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "nothing is open");
    session.loaded = loaded;
    assert!(!is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "the picture covers it");
    let normal = ViewSpec { quantity: Quantity::Normal, light: None };
    document.panes.set(vec![Pane { view: Some(normal), ..Pane::default() }]);
    assert!(is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "a debug view may have holes");
    two_panes(&mut document);
    assert!(is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "between panes");
    document.panes.arrangement = PaneArrangement::Wipe(0.5);
    assert!(!is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "one of two panes covers it");
    document.scene.background.transparent = true;
    let before = session.loaded.take().unwrap_or_else(|| panic!("it was there"));
    let Ok(Edited::Done(applied)) = apply(&before, document.scene.clone()) else { panic!("it needs no files") };
    session.loaded = Some(Arc::new(applied.loaded));
    assert!(is_filled(&mut document, &mut session, Some(&mut pane_renderer)), "there is no background");
}

#[test]
fn only_what_changed_is_drawn_again() {
    let context = context();
    let (mut document, mut session) = opened("builtin:sphere-128");
    two_panes(&mut document);
    let mut pane_renderer = pane_renderer(context.gl());
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 2);
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 0, "nothing changed");
    document.panes.list[1].specular = Some(Specular::None);
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 1, "one pane changed");
    let facts = pane_renderer.panes[1].facts.clone();
    assert_eq!(facts.triangles, 128);
    // llvmpipe counts; flat shading hands over three vertices a triangle.
    assert_eq!(facts.vertices, Some(3 * 128));
    assert!(facts.fragments.is_some_and(|count| count > 1000));
}

/// The map's statistics equal those of the two pictures on the CPU.
#[test]
fn the_difference_is_that_of_the_two_pictures() {
    let context = context();
    let (mut document, mut session) = opened("builtin:sphere-128");
    two_panes(&mut document);
    let mut pane_renderer = pane_renderer(context.gl());
    draw(&mut pane_renderer, &document, &mut session);
    let map = pane_renderer.difference(&document, &mut session).unwrap_or_else(|e| panic!("{e}"));
    assert!(map.is_some());
    let facts = session.comparison.difference.clone().unwrap_or_else(|| panic!("no numbers"));
    let [a, b] = [0, 1].map(|pane| pane_renderer.pixels(pane).unwrap_or_else(|| panic!("no picture")).0);
    let most = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max().map(f64::from);
    // Rounding of 1/255.
    assert!(most.is_some_and(|most| (facts.spread.max - most).abs() < 1e-9 && most > 10.0));
    let [x, y] = facts.worst.unwrap_or_else(|| panic!("nothing differs"));
    let at = 4 * (y * SIZE[0] + x) as usize;
    let there = (0..3).map(|c| a[at + c].abs_diff(b[at + c])).max().map(f64::from);
    assert_eq!(there, most);
}

#[test]
fn slow_pictures_have_one_sample_while_something_moves() {
    let context = context();
    let (mut document, mut session) = opened("builtin:sphere-128");
    let mut pane_renderer = pane_renderer(context.gl());
    draw(&mut pane_renderer, &document, &mut session);
    let samples = |pane_renderer: &PaneRenderer| pane_renderer.frame(0).map(|frame| frame.samples);
    let all = session.loaded.as_ref().map(|loaded| loaded.settings.picture.samples);
    assert_eq!(samples(&pane_renderer), all);
    session.moving = true;
    pane_renderer.panes[0].facts.ms = 1000.0;
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 0, "nothing but the pointer moves");
    session.clock.time = 0.5;
    document.panes.list[0].shading = Some(Shading::Gouraud);
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 1);
    assert_eq!(samples(&pane_renderer), Some(1));
    session.moving = false;
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 1);
    assert_eq!(samples(&pane_renderer), all);
}

#[test]
fn a_sketch_precedes_the_full_picture() {
    let context = context();
    let (document, mut session) = opened("builtin:sphere-128");
    let mut pane_renderer = pane_renderer(context.gl());
    assert!(pane_renderer.sketches(), "{}", pane_renderer.driver());
    session.sketching = true;
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 1);
    assert_eq!(pane_renderer.frame(0).map(|frame| frame.samples), Some(1));
    session.sketching = false;
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 1);
    let all = session.loaded.as_ref().map(|loaded| loaded.settings.picture.samples);
    assert_eq!(pane_renderer.frame(0).map(|frame| frame.samples), all);
    assert_eq!(draw(&mut pane_renderer, &document, &mut session), 0);
}

/// Coarser spheres differ more from the finest, and flat shading more than Phong shading.
#[test]
fn the_curve_falls_towards_the_finest() {
    let context = context();
    let (document, mut session) = opened("builtin:sphere-128");
    let mut pane_renderer = pane_renderer(context.gl());
    draw(&mut pane_renderer, &document, &mut session);
    session.comparison.curve.running = true;
    let mut steps = 0;
    while pane_renderer.measure(&document, &mut session).unwrap_or_else(|e| panic!("{e}")) {
        steps += 1;
        assert!(steps < 100, "it never ends");
    }
    let curve = &session.comparison.curve;
    assert!(!curve.running && curve.against == "32768 triangles, Phong");
    let rms = |shading, triangles| {
        let point = curve.points.iter().find(|p| p.shading == shading && p.triangles == triangles);
        point.map(|p| p.rms).unwrap_or_else(|| panic!("no point of {triangles} triangles"))
    };
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        assert!(rms(shading, 32) > 2.0 * rms(shading, 512) && rms(shading, 512) > 2.0 * rms(shading, 8192));
    }
    assert!(rms(Shading::Flat, 512) > rms(Shading::Gouraud, 512));
    assert!(rms(Shading::Gouraud, 512) > rms(Shading::Phong, 512));
}

/// A model is simplified in a thread; the old mesh is shown until it is finished.
#[test]
fn a_pane_is_simplified_beside_the_window() {
    let context = context();
    let (mut document, mut session) = opened("builtin:suzanne");
    let mut pane_renderer = pane_renderer(context.gl());
    draw(&mut pane_renderer, &document, &mut session);
    let before = pane_renderer.panes[0].facts.triangles;
    document.panes.list[0].detail = Some(LevelOfDetail::Share(0.25));
    draw(&mut pane_renderer, &document, &mut session);
    let ctx = egui::Context::default();
    // Without a limit of its own; the test runner has one.
    while pane_renderer.panes[0].facts.preparing {
        std::thread::yield_now();
        pane_renderer.begin(&ctx, 1);
        draw(&mut pane_renderer, &document, &mut session);
    }
    let after = pane_renderer.panes[0].facts.triangles;
    assert!(after <= before / 4 + 1 && after > before / 8, "{after} of {before}");
}

/// Pixels of the ground's layer; `None` if it is not shown.
fn ground(pane_renderer: &mut PaneRenderer, session: &Session) -> Option<Vec<[u8; 4]>> {
    let shown = pane_renderer.ground(0, session, true).unwrap_or_else(|error| panic!("{error}"));
    shown?;
    let layer = pane_renderer.panes[0].ground.layer.as_ref()?;
    assert_eq!(layer.size(), SIZE);
    Some(layer.read8().as_chunks::<4>().0.to_vec())
}

/// Pixels with lines, and pixels in the shadow: lines are as bright as they are opaque, the shadow is black.
fn lines_and_shadow(layer: &[[u8; 4]]) -> [usize; 2] {
    let brightest = |[r, g, b, _]: &[u8; 4]| *r.max(g).max(b);
    let is_line = |pixel: &&[u8; 4]| brightest(pixel) > 8;
    let is_shadow = |pixel: &&[u8; 4]| pixel[3] > brightest(pixel) + 15;
    [layer.iter().filter(is_line).count(), layer.iter().filter(is_shadow).count()]
}

#[test]
fn the_ground_is_over_the_picture_and_no_part_of_it() {
    let context = context();
    let (document, mut session) = opened("builtin:cube");
    let mut pane_renderer = pane_renderer(context.gl());
    session.settings.hides_ground = true;
    draw(&mut pane_renderer, &document, &mut session);
    assert_eq!(ground(&mut pane_renderer, &session), None, "it is switched off");
    let read = |pane_renderer: &mut PaneRenderer| {
        let shown = pane_renderer.shown(0, Some([90, 70]), None).unwrap_or_else(|e| panic!("{e}"));
        let light = pane_renderer.light(0, None).unwrap_or_else(|e| panic!("{e}"));
        let (displayed, probed) = (pane_renderer.pixels(0), pane_renderer.pixel(0, 80, 110));
        (displayed, shown.map(|shown| shown.rgba), light.map(|light| light.pixels), probed)
    };
    let without = read(&mut pane_renderer);
    session.settings.hides_ground = false;
    draw(&mut pane_renderer, &document, &mut session);
    let layer = ground(&mut pane_renderer, &session).unwrap_or_else(|| panic!("it is on by default"));
    let [lines, shadow] = lines_and_shadow(&layer);
    assert!(lines > 300 && shadow > 100, "{lines} pixels with lines, {shadow} in the shadow");
    // The middle of the picture is the cube.
    assert_eq!(layer[(60 * SIZE[0] + 80) as usize], [0; 4]);
    assert!(without == read(&mut pane_renderer), "pixels, files, light and probe are without it");
}

#[test]
fn the_ground_is_drawn_only_where_it_helps() {
    let context = context();
    let mut pane_renderer = pane_renderer(context.gl());
    let mut shown = |input: &str, edit: &dyn Fn(&mut Document)| {
        let (mut document, mut session) = opened(input);
        edit(&mut document);
        let loaded = session.loaded.take().unwrap_or_else(|| panic!("it was there"));
        let Ok(Edited::Done(applied)) = apply(&loaded, document.scene.clone()) else { panic!("it needs no files") };
        (session.loaded, session.generation) = (Some(Arc::new(applied.loaded)), 1);
        pane_renderer.panes.clear();
        draw(&mut pane_renderer, &document, &mut session);
        ground(&mut pane_renderer, &session).map(|layer| lines_and_shadow(&layer))
    };
    assert!(shown("builtin:cube", &|_| {}).is_some_and(|[_, shadow]| shadow > 100));
    assert_eq!(shown("builtin:still-life", &|_| {}), None, "an object is a floor");
    assert_eq!(shown("builtin:cube", &|d| d.scene.camera.position = [0.0, -4.0, 4.0]), None, "seen from below");
    let normal = Some(ViewSpec { quantity: Quantity::Normal, light: None });
    assert_eq!(shown("builtin:cube", &|d| d.panes.list[0].show_view(normal)), None, "a view of numbers");
    let shadows = shown("builtin:cube", &|d| d.scene.equation.shadows = true);
    assert!(shadows.is_some_and(|[lines, shadow]| lines > 300 && shadow == 0), "shadows of the equation: {shadows:?}");
}

#[test]
fn the_ground_is_drawn_again_only_for_another_eye() {
    let context = context();
    let (mut document, mut session) = opened("builtin:cube");
    let mut pane_renderer = pane_renderer(context.gl());
    let mut drawn_after = |edit: &dyn Fn(&mut Document)| {
        edit(&mut document);
        let before = session.loaded.take().unwrap_or_else(|| panic!("it was there"));
        let Ok(Edited::Done(applied)) = apply(&before, document.scene.clone()) else { panic!("it needs no files") };
        session.loaded = Some(Arc::new(applied.loaded));
        draw(&mut pane_renderer, &document, &mut session);
        assert!(ground(&mut pane_renderer, &session).is_some());
        pane_renderer.panes[0].ground.serial
    };
    assert_eq!(drawn_after(&|_| {}), 1);
    assert_eq!(drawn_after(&|d| d.scene.lights[0].intensity = 2.0), 1, "a light changed");
    assert_eq!(drawn_after(&|d| d.scene.camera.position[0] += 0.5), 2, "the eye moved");
}
