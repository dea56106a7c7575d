//! The picture as a person uses it: the whole application, with OpenGL but without a window.
#![allow(clippy::unwrap_used)]

mod support;

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, pos2, vec2};
use glam::DVec3;
use gonio_app::exported;
use gonio_app::platform::{Event as PlatformEvent, SceneInput};
use gonio_app::session::{Selection, Tab};
use gonio_app::truth::{PixelLight, TraceFacts, TracedPane};
use gonio_reference::ReferenceScene;
use gonio_scene::Frame;
use gonio_scene::settings::CameraSettings;
use gonio_trace::{TraceScene, TraceSettings};
use std::time::Duration;
use support::Window;

/// A sphere, a lamp beside it, a sun, a spot from above.
const SCENE: &str = r#"
[camera]
position = [0.0, 0.0, 6.0]
target = [0.0, 0.0, 0.0]
[[object]]
model = "builtin:sphere-smooth"
[[light]]
kind = "point"
name = "lamp"
position = [1.3, 1.2, 1.0]
[[light]]
kind = "directional"
name = "sun"
direction = [1.0, -0.2, -0.4]
intensity = 0.4
[[light]]
kind = "spot"
name = "spot"
position = [-1.2, 1.4, 1.0]
direction = [1.0, -1.0, -1.0]
"#;

impl Window {
    fn open(name: &str) -> Self {
        Window::showing(name, SCENE, vec2(1100.0, 720.0))
    }

    /// A scene in a window of this size.
    fn showing(name: &str, scene: &str, size: Vec2) -> Self {
        let folder = std::env::temp_dir().join(format!("gonio-viewport-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{error}"));
        let file = folder.join("scene.toml");
        std::fs::write(&file, scene).unwrap_or_else(|error| panic!("{error}"));
        let mut window = Window::with(&file.to_string_lossy(), size);
        // It is read in a thread; at most a minute on a busy machine.
        for _ in 0..600 {
            window.steps(1);
            if window.pictures() > 0 {
                break;
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        let _ = std::fs::remove_dir_all(&folder);
        window.steps(3);
        assert_eq!(window.app().session().messages.list(), &[], "no messages");
        window
    }

    /// A drag whose last movement, `more`, is in the same frame as the release, as in slow frames.
    fn drag_and_release_at_once(&mut self, from: Pos2, way: Vec2, more: Vec2) {
        self.move_to(from);
        self.button(from, true);
        for part in 1..=4 {
            self.move_to(from + way * (part as f32 / 4.0));
        }
        let (at, button, modifiers) = (from + way + more, PointerButton::Primary, Modifiers::NONE);
        // In one frame; the harness would use a frame for each.
        let released = Event::PointerButton { pos: at, button, pressed: false, modifiers };
        self.harness.input_mut().events.extend([Event::PointerMoved(at), released]);
        self.steps(3);
    }

    fn pictures(&self) -> u64 {
        self.app().session().facts.pictures
    }
}

/// Tolerance in points of the window: one for rounded numbers, and half a point for pixels.
const POINT: f32 = 1.5;

#[test]
fn a_lamp_follows_the_pointer_and_comes_back() {
    let mut window = Window::open("lamp");
    let before = window.app().document().clone();
    let (start, way, drawn) = (window.center("light-0-handle"), vec2(70.0, -40.0), window.pictures());
    window.drag(start, way);
    let after = window.app().document().clone();
    assert_eq!(after.scene.camera, before.scene.camera, "the camera stays while a light is dragged");
    let [x, y, z] = after.scene.lights[0].position.unwrap_or_default();
    assert!(x > 1.4 && y > 1.3 && (z - 1.0).abs() < 1e-6, "in the plane of the picture: {x}, {y}, {z}");
    let end = window.center("light-0-handle");
    assert!(end.distance(start + way) < POINT, "the handle is at {end}, the pointer at {}", start + way);
    assert!(window.pictures() > drawn, "the picture was not drawn again");
    assert_eq!(window.app().session().selection, Selection::Light(0));
    // One gesture is one step.
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.app().document(), &before);
}

/// A drag includes its last movement, and is one step of undo.
#[test]
fn a_drag_ends_where_the_button_is_released() {
    let mut window = Window::open("release");
    let before = window.app().document().clone();
    let (start, way, more) = (window.center("light-0-handle"), vec2(40.0, -20.0), vec2(30.0, 40.0));
    window.drag_and_release_at_once(start, way, more);
    let end = window.center("light-0-handle");
    assert!(end.distance(start + way + more) < POINT, "the handle is at {end}, the pointer at {}", start + way + more);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(*window.app().document(), before);

    let eye = |window: &Window| DVec3::from(window.app().document().scene.camera.position);
    let (ground, first) = (window.center("pane-0") + vec2(-200.0, 150.0), eye(&window));
    window.drag_and_release_at_once(ground, vec2(60.0, 0.0), vec2(60.0, 0.0));
    let at_once = eye(&window);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(*window.app().document(), before);
    window.drag(ground, vec2(120.0, 0.0));
    assert!(eye(&window).distance(at_once) < 1e-6 && at_once.distance(first) > 0.5, "{at_once} from {first}");
}

#[test]
fn a_chosen_light_has_arms_along_the_axes() {
    let mut window = Window::open("arms");
    let lamp = window.center("light-0-handle");
    window.click_at(lamp);
    assert_eq!(window.app().session().selection, Selection::Light(0));
    let (before, arm) = (window.app().document().scene.lights[0].position, window.center("light-0-x"));
    window.drag(arm, vec2(50.0, 25.0));
    let ([x0, y0, z0], [x, y, z]) =
        (before.unwrap_or_default(), window.app().document().scene.lights[0].position.unwrap_or_default());
    assert!(x > x0 + 0.1 && (y, z) == (y0, z0), "along x alone: {x}, {y}, {z}");
}

#[test]
fn a_sun_turns_and_a_spot_opens() {
    let mut window = Window::open("sun");
    let start = window.center("light-1-handle");
    window.drag(start, vec2(30.0, 60.0));
    let end = window.center("light-1-handle");
    assert!(end.distance(start + vec2(30.0, 60.0)) < POINT, "{end} for {start}");
    let [_, y, _] = window.app().document().scene.lights[1].direction.unwrap_or_default();
    assert!(y > -0.2, "it shines from farther below: {y}");

    let spot = window.center("light-2-handle");
    window.click_at(spot);
    let before = window.app().document().scene.lights[2].clone();
    let (end, rim) = (window.center("light-2-axis"), window.center("light-2-angle"));
    window.drag(rim, 0.3 * (rim - end));
    let after = window.app().document().scene.lights[2].clone();
    assert!(after.outer_angle > before.outer_angle && after.inner_angle > before.inner_angle, "{after:?}");
    assert_eq!(after.direction, before.direction);
    window.drag(end, vec2(-40.0, 10.0));
    let turned = window.app().document().scene.lights[2].clone();
    assert!(turned.direction != after.direction && turned.position == before.position, "{turned:?}");
}

#[test]
fn a_click_pins_the_probe_and_both_renderers_agree_there() {
    let mut window = Window::open("probe");
    // The side panel reaches its final width with the numbers of the pixel under the pointer.
    let picture = window.center("pane-0");
    window.move_to(picture);
    window.press(Modifiers::NONE, Key::P);
    while window.app().session().probing.reading().is_none() {
        window.steps(1);
        std::thread::yield_now();
    }
    window.steps(3);
    let at = window.center("pane-0") + vec2(31.0, -42.0);
    window.click_at(at);
    assert_eq!(window.app().session().tab, Tab::Probe);
    let reading = loop {
        window.steps(1);
        if let Some(reading) = window.app().session().probing.reading() {
            break reading.clone();
        }
        std::thread::yield_now();
    };
    let [left, top, width, height] = window.widget("pane-0").rect;
    // One pixel per point.
    assert_eq!((reading.width, reading.height), (width as u32, height as u32));
    assert_eq!((reading.x, reading.y), ((at.x - left) as u32, (at.y - top) as u32));
    // The numbers of `gonio probe`: the reference for the same scene and frame.
    let loaded = reading.loaded.clone();
    let frame = Frame { width: reading.width, height: reading.height, samples: 1, ..loaded.frame(0.0) };
    let expected = ReferenceScene::new(&loaded).probe(&frame, reading.x, reading.y);
    assert!(expected.is_some() && expected == reading.probe, "{expected:?}");
    // The project's tolerance for the GPU against the reference.
    let gpu = reading.gpu.unwrap_or_else(|| panic!("OpenGL's pixel could not be read"));
    assert!(gpu.difference < 1e-3 && gpu.value[3] == 1.0, "{gpu:?}");
    // It follows the light, at the same pixel.
    let lamp = window.center("light-0-handle");
    window.drag(lamp, vec2(-60.0, 0.0));
    window.steps(2);
    let now = window.app().session().probing.reading().cloned().unwrap_or_else(|| panic!("it is still pinned"));
    assert!((now.x, now.y) == (reading.x, reading.y) && now.reference != reading.reference);
    let difference = now.gpu.map_or(1.0, |gpu| gpu.difference);
    assert!(difference < 1e-3, "{:?} {:?}", now.gpu, now.reference);
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.app().session().probing.pinned, None);
}

/// A model of several parts.
const PARTS: &str = "[camera]\nposition = [3, 4, 6]\ntarget = [0, 0, 0]\n[[object]]\nmodel = \"builtin:still_life\"\n";

#[test]
fn a_click_selects_a_part_and_so_does_its_draw_call() {
    let mut window = Window::showing("parts", PARTS, vec2(1100.0, 720.0));
    window.click_at(window.center("pane-0"));
    for _ in 0..600 {
        window.steps(1);
        if window.app().session().selection.part().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let clicked = window.app().session().selection.part().unwrap();
    let reading = window.app().session().probing.reading().cloned().unwrap();
    assert_eq!(reading.part(), Some(clicked));
    // From the probe to the material of this part.
    window.click_at(window.center("probe-edit-material"));
    window.steps(30);
    assert_eq!(window.app().session().tab, Tab::Objects);
    assert_eq!(window.widget(&format!("object-0-part-{}", clicked[1])).value, "true");
    // Among the objects, a click selects without leaving.
    let other = window.center("pane-0") + vec2(-60.0, -70.0);
    window.click_at(other);
    window.steps(30);
    assert_eq!(window.app().session().tab, Tab::Objects);
    let now = window.app().session().probing.reading().and_then(|reading| reading.part());
    assert!(now.is_some() && now != Some(clicked), "{now:?}");
    assert_eq!(window.app().session().selection.part(), now);
    window.click_at(window.center("tab-frame"));
    for _ in 0..200 {
        window.steps(1);
        if window.app().session().recorded_frame.is_some() {
            break;
        }
    }
    let draws = window.app().session().recorded_frame.as_ref().unwrap().record.draws.clone();
    let loaded = window.app().session().loaded.clone().unwrap();
    let draw =
        draws.iter().find(|draw| draw.subject.as_ref().is_some_and(|subject| subject.material == "Wood")).unwrap();
    window.click_at(window.center(&format!("draw-{}", draw.index)));
    let [object, part] = window.app().session().selection.part().unwrap();
    assert_eq!(loaded.materials[loaded.objects[object].parts[part].material].material.name, "Wood");
    // Nothing is selected where there is only background.
    let [left, top, ..] = window.widget("pane-0").rect;
    window.click_at(pos2(left + 20.0, top + 90.0));
    window.steps(30);
    assert_eq!(window.app().session().selection, Selection::None);
}

#[test]
fn the_axes_the_views_and_the_second_camera() {
    let mut window = Window::open("views");
    let end = window.center("look-along-x");
    window.click_at(end);
    let [x, y, z] = window.app().document().scene.camera.position;
    assert!((x - 6.0).abs() < 1e-6 && y.abs() < 1e-6 && z.abs() < 1e-6, "from the end of x: {x}, {y}, {z}");
    // Keys go to the picture while the pointer is over it and no text field has the focus.
    let middle = window.center("pane-0");
    window.move_to(middle);
    let drawn = window.pictures();
    window.press(Modifiers::SHIFT, Key::W);
    window.press(Modifiers::NONE, Key::Num1);
    let pane = window.app().document().panes.list[0].clone();
    assert!(pane.overlays.wireframe && pane.view.is_some() && window.pictures() > drawn, "{pane:?}");
    assert_eq!(window.widget("view-chooser").value, "normal");
    window.press(Modifiers::SHIFT, Key::V);
    assert_eq!(window.widget("view-chooser").value, "overdraw");
    window.press(Modifiers::NONE, Key::O);
    let inset = window.center("observer-view");
    let camera = window.app().document().scene.camera.clone();
    window.drag(inset, vec2(40.0, 10.0));
    assert_eq!(window.app().document().scene.camera, camera, "turning the second eye moves the first");
    let close = window.center("observer-close");
    window.click_at(close);
    assert!(exported::widgets(&window.harness.ctx).iter().all(|widget| widget.id != "observer-view"));
}

/// A scene without a camera is framed completely for every width, which is not a step of undo.
#[test]
fn an_opened_scene_fits_the_picture() {
    let scene = "[[object]]\nmodel = \"builtin:cube\"\nscale = [3.0, 1.0, 1.0]\n";
    let mut distances = Vec::new();
    for size in [vec2(1100.0, 720.0), vec2(380.0, 800.0)] {
        let window = Window::showing("framed", scene, size);
        let loaded = window.app().session().loaded.clone().unwrap_or_else(|| panic!("it is open"));
        let camera = window.app().document().scene.camera.clone();
        let [_, _, width, height] = window.widget("pane-0").rect;
        let frame = Frame { width: width as u32, height: height as u32, ..loaded.frame(0.0) };
        // The same as by the key F, except for rounding.
        let again = loaded.framed(&camera, f64::from(width) / f64::from(height));
        let places = |camera: &CameraSettings| [camera.position, camera.target().unwrap_or_default()].map(DVec3::from);
        for (now, again) in places(&camera).into_iter().zip(places(&again)) {
            assert!(now.distance(again) < 1e-9, "{now} and {again}");
        }
        let projection =
            frame.camera.clip_from_view(f64::from(width) / f64::from(height)) * frame.camera.view_from_world();
        let (min, max) = loaded.bounds();
        for corner in 0..8 {
            let side = |axis: usize| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] };
            let place = projection.project_point3(DVec3::new(side(0), side(1), side(2)));
            // The corners of the box reach slightly beyond the objects in it.
            assert!(place.x.abs() < 1.15 && place.y.abs() < 1.15, "{size}: corner {corner} is at {place}");
        }
        assert_eq!(window.app().state(&window.harness.ctx)["undo"], false);
        let [x, y, z] = camera.position;
        distances.push((x * x + y * y + z * z).sqrt());
    }
    // The narrow picture needs a larger distance.
    assert!(distances[1] > 1.2 * distances[0], "{distances:?}");
}

/// On a slow machine a key may be released before the next frame.
#[test]
fn a_tap_moves_the_camera_however_short_it_is() {
    let mut window = Window::open("tap");
    let middle = window.center("pane-0");
    window.move_to(middle);
    let before = window.app().document().scene.camera.clone();
    for pressed in [true, false] {
        let (key, modifiers) = (Key::ArrowLeft, Modifiers::NONE);
        let event = Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        window.harness.input_mut().events.push(event);
    }
    window.steps(2);
    assert_ne!(window.app().document().scene.camera, before);
    assert_eq!(window.app().state(&window.harness.ctx)["undo"], true);
}

impl Window {
    /// The traced picture of a pane, once `holds` is true of it; the tracer has as many frames as it needs.
    fn traced(&mut self, pane: usize, holds: impl Fn(&TracedPane) -> bool) -> (u64, TraceFacts) {
        loop {
            self.steps(1);
            if let Some(traced) = self.app().session().traced.get(pane).filter(|traced| holds(traced)) {
                return (traced.serial, traced.facts);
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// Waits until this number of paths is followed through the pinned pixel.
    fn followed(&mut self, paths: f64) {
        while self.app().session().pixel_light().is_none_or(|light| light.paths < paths) {
            self.steps(1);
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// The traced picture becomes finer while nothing changes, and starts again with every change of the light.
#[test]
fn the_truth_is_refined_and_starts_again() {
    let mut window = Window::showing("truth", SCENE, vec2(600.0, 420.0));
    let middle = window.center("pane-0");
    window.move_to(middle);
    window.press(Modifiers::SHIFT, Key::T);
    assert_eq!(window.widget("view-chooser").value, "Traced (truth)");
    let (first, coarse) = window.traced(0, |traced| traced.serial > 0);
    assert!(coarse.paths > 0.0);
    let (later, fine) = window.traced(0, |traced| traced.facts.error.is_some());
    assert!(later > first && fine.paths >= 2.0, "{coarse:?} {fine:?}");
    assert!(window.widget("pane-0").value.starts_with("traced: "), "{}", window.widget("pane-0").value);
    // Nobody would see an overlay: the key says so, and changes nothing.
    let before = window.app().document().clone();
    window.press(Modifiers::SHIFT, Key::N);
    let announcement = &window.app().session().announcement;
    assert!(announcement.starts_with("overlays are not drawn over a traced picture"), "{announcement}");
    assert_eq!(window.app().document(), &before);
    let drawn = window.pictures();
    assert!(drawn >= later, "{drawn} pictures were shown of {later}");
    // While nothing changes it is the same request; the camera and a light start another one, and each begins coarse.
    let requests = |window: &Window| window.app().session().traced[0].requests;
    let before = requests(&window);
    window.steps(3);
    assert_eq!(requests(&window), before);
    let [_, _, width, height] = window.widget("pane-0").rect;
    window.drag(middle + 0.2 * vec2(-width, height), vec2(40.0, 10.0));
    let turned = requests(&window);
    assert!(turned > before, "the camera was moved");
    let lamp = window.center("light-0-handle");
    window.drag(lamp, vec2(20.0, -10.0));
    assert!(requests(&window) > turned, "a lamp was moved");
    window.traced(0, |traced| traced.facts.error.is_some());
    // Back to OpenGL's picture: nothing is traced.
    let before = window.app().document().clone();
    window.press(Modifiers::NONE, Key::Num0);
    assert_eq!(window.app().document().panes.list[0].truth, None);
    let traced = &window.app().session().traced[0];
    assert!(traced.picture.is_none() && !traced.is_running());
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.app().document(), &before, "the kind of pane is a step of undo");
    window.traced(0, |traced| traced.serial > 0);
}

/// It is wiped and compared with OpenGL's picture like any other, through the same exposure and tone mapping.
#[test]
fn the_truth_is_compared_with_opengl() {
    let mut window = Window::showing("compared", SCENE, vec2(900.0, 900.0));
    let tab = window.center("tab-compare");
    window.click_at(tab);
    let preset = window.center("preset-truth");
    window.click_at(preset);
    assert_eq!(window.app().document().panes.list.len(), 2);
    window.traced(0, |traced| traced.facts.error.is_some());
    let mode = window.center("difference-mode");
    window.click_at(mode);
    window.traced(0, |traced| traced.facts.error.is_some_and(|error| error < 0.2));
    window.steps(2);
    let facts = window.app().session().comparison.difference.clone().unwrap_or_else(|| panic!("it is compared"));
    // The sphere is the same but for the highlight and the ambient light; the background is the same.
    let share = facts.percent();
    assert!((1.0..80.0).contains(&share), "{share} % differ");
    let mode = window.center("wipe-mode");
    window.click_at(mode);
    window.traced(0, |traced| traced.serial > 0);
    assert!(window.widget("pane-1").value == "OpenGL" && !window.app().session().traced[1].is_running());
    // The probe reads the picture under the pointer: the traced one is left of the divider.
    let [left, top, width, height] = window.widget("pane-1").rect;
    let at = |share: f32| pos2(left + share * width, top + 0.5 * height);
    for (share, pane) in [(0.4, 0), (0.6, 1)] {
        window.click_at(at(share));
        let (document, session) = (window.app().document(), window.app().session());
        assert_eq!((document.panes.current, session.probing.pane), (pane, pane));
    }
}

/// A click in a traced pane lists the light of that pixel: the same paths as those of the scene, while the picture goes on.
#[test]
fn a_click_lists_the_light_of_a_traced_pixel() {
    let mut window = Window::showing("ways", SCENE, vec2(600.0, 420.0));
    let middle = window.center("pane-0");
    window.move_to(middle);
    window.press(Modifiers::SHIFT, Key::T);
    window.traced(0, |traced| traced.serial > 0);
    window.click_at(middle);
    window.followed(4096.0);
    let session = window.app().session();
    let reading = session.probing.reading().unwrap_or_else(|| panic!("it is pinned"));
    let light = session.pixel_light().unwrap_or_else(|| panic!("it is followed"));
    let first = light.pixel;
    let ready = TraceScene::new(&reading.loaded, &reading.frame);
    let expected = ready.contributions(&TraceSettings::default(), reading.x, reading.y, 4096, &|_| true);
    assert_eq!(PixelLight::from_numbers([reading.x, reading.y], &expected.to_numbers()).as_ref(), Some(light));
    // The lamp before the sphere lights its middle.
    let ways = reading.ways(light);
    assert!(ways.iter().any(|(name, _, rgb)| name == "lamp" && rgb.x > 0.0), "{ways:?}");
    // Another pixel in the same picture, also after it is finished.
    let requests = session.traced[0].requests;
    window.click_at(middle + vec2(8.0, 0.0));
    window.followed(256.0);
    assert_eq!(window.app().session().traced[0].requests, requests);
    assert_ne!(window.app().session().pixel_light().map(|light| light.pixel), Some(first));
}

#[test]
fn an_edited_scene_that_was_replaced_is_restored_with_its_history() {
    let mut window = Window::open("replaced");
    let open = |window: &mut Window, name: &str| {
        let ctx = window.harness.ctx.clone();
        let files = std::sync::Arc::new(gonio_scene::files::BuiltinOnly);
        window.harness.state_mut().as_mut().unwrap().open(&ctx, vec![name.to_owned()], files);
        window.wait_for_title(name.trim_start_matches("builtin:"));
    };
    let messages = |window: &Window| -> Vec<String> {
        window.app().session().messages.list().iter().map(|message| message.text.clone()).collect()
    };
    // Nothing is kept of a scene that was only looked at.
    open(&mut window, "builtin:three-spheres");
    assert_eq!(messages(&window), [""; 0]);
    let original = window.app().document().scene.clone();
    window.drag(window.center("light-0-handle"), vec2(-30.0, 20.0));
    let edited = window.app().document().scene.clone();
    assert_ne!(edited.lights, original.lights);
    open(&mut window, "builtin:cube");
    assert_eq!(messages(&window), ["Replaced three-spheres (unsaved)"]);
    window.steps(3);
    window.click_at(window.center("restore-scene"));
    window.wait_for_title("three-spheres");
    assert_eq!(window.app().document().scene, edited);
    assert_eq!(messages(&window), [""; 0], "the cube was not edited");
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.app().document().scene.lights, original.lights, "its steps can still be undone");
    let told = window.app().session().announcement.clone();
    assert!(told == "Undone: turned the lab's", "{told}");
}

#[test]
fn sidecars_that_are_dropped_later_are_adopted() {
    let mut window = Window::open("sidecars");
    let drop = |window: &mut Window, files: &[(&str, &str)]| {
        let mut memory = gonio_app::files::MemoryFiles::default();
        files.iter().for_each(|(name, text)| memory.insert(name, text.as_bytes().to_vec()));
        let input = SceneInput::gathered(memory.names(), std::sync::Arc::new(memory));
        window.here.coming.borrow_mut().push(PlatformEvent::Open(Box::new(input)));
        window.steps(2);
    };
    let warnings = |window: &Window| -> Vec<String> {
        window.app().session().messages.list().iter().map(|message| message.text.clone()).collect()
    };
    drop(&mut window, &[("m/t.obj", "mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")]);
    window.wait_for_title("t.obj");
    assert!(warnings(&window).iter().any(|text| text.contains("red.mtl")), "{:?}", warnings(&window));
    let shown = |window: &Window| {
        let loaded = window.app().session().loaded.clone().unwrap();
        loaded.materials_in_file(0).first().map(|material| material.diffuse)
    };
    let before = shown(&window);
    // Another file is not adopted, and says so.
    drop(&mut window, &[("other.mtl", "newmtl other\n")]);
    assert!(warnings(&window).iter().any(|text| text.contains("`other.mtl` belongs to a model")));
    drop(&mut window, &[("Red.mtl", "newmtl red\nKd 1 0 0\n")]);
    for _ in 0..200 {
        window.steps(2);
        if warnings(&window).is_empty() {
            break;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!((warnings(&window), window.app().session().title.as_str()), (Vec::new(), "t.obj"));
    assert_ne!(shown(&window), before);
}

impl Window {
    fn wait_for_title(&mut self, title: &str) {
        for _ in 0..600 {
            self.steps(2);
            if self.app().session().title == title && self.app().session().busy.is_none() {
                return;
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        panic!("timed out waiting for {title}: {}", self.app().session().title);
    }
}
