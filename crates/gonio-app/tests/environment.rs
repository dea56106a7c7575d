//! The panel of the environment and the gallery as a user works with them: the whole application, without a window.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Vec2, vec2};
use gonio_app::exported;
use gonio_app::platform::Event;
use gonio_app::saving::Product;
use gonio_environment::encode::{Appearance, Container, EnvironmentFormat, picture};
use gonio_environment::{Cubemap, Face, Layout};
use gonio_image::decode::{DecodedContent, decode};
use gonio_light::color::OutputTransform;
use serde_json::Value;
use std::path::{Path, PathBuf};
use support::Window;

const TALL: Vec2 = vec2(1100.0, 1500.0);
const PHONE: Vec2 = vec2(390.0, 844.0);
/// Frames that a result may take.
const FRAMES: usize = 600;

/// A folder that is removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("gonio-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // One that is left over does no harm.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Six faces of a smooth world, of which two are swapped, and a scene with them.
fn swapped_faces(folder: &Path) -> String {
    let map = Cubemap::from_function(32, |d| 0.5 + 0.4 * glam::DVec3::new(d.x, d.y + 0.3 * d.x, (2.0 * d.z).sin()));
    let layout = Layout::Photographic;
    let transform = OutputTransform::default();
    let appearance = Appearance { layout, transform, high_dynamic_range: true, exact: true };
    let mut faces = map.faces(layout);
    faces.swap(Face::PosX as usize, Face::NegX as usize);
    for (face, image) in Face::ALL.into_iter().zip(&faces) {
        let bytes = picture(image, EnvironmentFormat::Exr, None, &appearance).unwrap().bytes;
        std::fs::write(folder.join(format!("{}.exr", face.name())), bytes).unwrap();
    }
    let scene = folder.join("scene.toml");
    let text = "[environment]\nimage = \"posx.exr\"\n[[object]]\nmodel = \"builtin:cube\"\n";
    std::fs::write(&scene, text).unwrap();
    scene.to_string_lossy().into_owned()
}

impl Window {
    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // A pause, so that the next click is not part of a double click.
        self.steps(30);
    }

    fn state(&self) -> Value {
        self.app().state(&self.harness.ctx)
    }

    /// Waits until the state fulfils a condition.
    fn until(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..FRAMES {
            let state = self.state();
            if expected(&state) {
                return state;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
            self.steps(1);
        }
        let state = self.state();
        panic!("{what}: {} {} {}", state["environment"], state["gallery"], state["messages"]);
    }

    fn environment(scene: &str) -> Self {
        let mut window = Window::with(scene, TALL);
        window.until("the scene", |state| state["loaded"] == true);
        window.click("tab-picture");
        window.click("environment-panel");
        window.until("the study", |state| state["environment"]["facts"].is_object());
        window
    }
}

#[test]
fn swapped_faces_are_found_repaired_and_the_step_is_undone() {
    let folder = Folder::new("swapped");
    let mut window = Window::environment(&swapped_faces(&folder.0));
    let found = window.state()["environment"]["facts"].clone();
    assert_eq!([&found["fits"], &found["repairable"]], [false, true]);
    assert_eq!(found["sentences"][0], "`posx` and `negx` are swapped");
    assert_eq!(window.widget("environment-arrangement").value, "Six files (OpenEXR)");
    let before = window.state()["scene"]["environment"]["image"].clone();
    window.click("repair-environment");
    let after = window.until("the repair", |state| state["environment"]["facts"]["fits"] == true);
    assert_eq!(after["scene"]["environment"]["image"], "posx_repaired.ktx2");
    window.press(egui::Modifiers::COMMAND, egui::Key::Z);
    let undone = window.until("the fault", |state| state["environment"]["facts"]["fits"] == false);
    assert_eq!(undone["scene"]["environment"]["image"], before);
}

#[test]
fn every_product_is_converted_to_a_file_that_can_be_read() {
    let folder = Folder::new("converted");
    let mut window = Window::environment(&swapped_faces(&folder.0));
    let widgets = exported::widgets(&window.harness.ctx);
    let saves = widgets.iter().filter(|widget| widget.id.starts_with("save-environment-")).count();
    assert_eq!(saves, 5);
    let product = |container, is_zip| {
        Product::Environment(gonio_app::environment::EnvironmentProduct {
            container,
            format: EnvironmentFormat::Exr,
            size: Some(16),
            layout: Layout::OpenGl,
            is_zip,
        })
    };
    let mut save = |container, name: &str| {
        let place = folder.0.join(name).to_string_lossy().into_owned();
        window.here.coming.borrow_mut().push(Event::SaveTo(product(container, name.ends_with("zip")), place));
        window.steps(2);
        window.until(name, |state| {
            state["environment"]["converting"] == false
                && state["announcement"].as_str().unwrap().contains(name.split('.').next().unwrap())
        });
    };
    save(Container::Cross, "cross.exr");
    save(Container::Equirectangular, "panorama.exr");
    save(Container::Ktx2, "cubemap.ktx2");
    save(Container::Faces, "single.exr");
    save(Container::Faces, "packed.zip");
    let size = |name: &str| {
        let bytes = std::fs::read(folder.0.join(name)).unwrap();
        match decode(name, &bytes, &Default::default()).unwrap().shape {
            DecodedContent::Picture(image) => [image.width, image.height],
            DecodedContent::Faces(faces) => [faces[0].width, 6],
        }
    };
    assert_eq!([size("cross.exr"), size("panorama.exr"), size("cubemap.ktx2")], [[64, 48], [64, 32], [16, 6]]);
    assert_eq!([size("single_posx.exr"), size("single_negz.exr")], [[16, 16], [16, 16]]);
    let unpacked = gonio_app::files::zip::unpack(&std::fs::read(folder.0.join("packed.zip")).unwrap()).unwrap();
    assert_eq!(unpacked.names().len(), 6);
}

#[test]
fn the_gallery_draws_its_pictures_and_opens_a_scene_in_its_view() {
    for size in [TALL, PHONE] {
        let mut window = Window::with("builtin:cube", size);
        window.until("the scene", |state| state["loaded"] == true);
        window.click(if size == PHONE { "menu" } else { "samples" });
        window.click("gallery");
        let gallery = window.until("pictures", |state| state["gallery"]["drawn"].as_u64() > Some(1))["gallery"].clone();
        assert_eq!((&gallery["open"], gallery["sections"].as_array().unwrap().len()), (&true.into(), 12));
        assert!(gallery["exhibits"].as_u64() > Some(80), "{gallery}");
        let widgets = exported::widgets(&window.harness.ctx);
        let cards: Vec<_> = widgets.iter().filter(|widget| widget.id.starts_with("exhibit-")).collect();
        assert!(cards.iter().all(|card| card.rect[0] >= 0.0 && card.rect[0] + card.rect[2] <= size.x), "{cards:?}");
        let first = cards[0].id.clone();
        let title = format!("{}.toml", first.trim_start_matches("exhibit-"));
        window.click(&first);
        let opened = window.until("the scene", |state| state["title"] == title.as_str());
        assert_eq!((&opened["gallery"]["open"], &opened["messages"]), (&false.into(), &Value::Array(Vec::new())));
    }
}
