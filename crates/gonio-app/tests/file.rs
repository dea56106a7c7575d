//! The panel of files: what a model holds, the lines that values come from, missing files, and other formats.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;
#[path = "support/waiting.rs"]
mod waiting;

use egui::{Key, Modifiers, vec2};
use gonio_app::files::MemoryFiles;
use gonio_app::platform::{Event, SceneInput};
use gonio_scene::files::Disk;
use gonio_scene::inspect;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use support::Window;

const OBJ: &str = "mtllib square.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl painted
f 1/1 2/2 3/3 4/4
l 1 2
";
const MTL: &str = "newmtl painted
Kd 0.25 0.5 1
map_Kd paint.png
";
const SCENE: &str = "[[object]]
model = \"square.obj\"

[[object]]
model = \"builtin:cube\"
translate = [3, 0, 0]
";

/// A folder that is removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("gonio-file-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        for (name, text) in [("square.obj", OBJ), ("square.mtl", MTL), ("scene.toml", SCENE)] {
            std::fs::write(path.join(name), text).unwrap();
        }
        Folder(path)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_string_lossy().into_owned()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

impl Window {
    /// Opens a file in a high window with the panel, and waits until all models were inspected.
    fn to_file(input: &str, width: f32) -> Window {
        let mut window = Window::with(input, vec2(width, 2400.0));
        window.until("the scene", |s| s["loaded"] == true && s["busy"].is_null());
        window.click("tab-file");
        window.until("the content", is_inspected);
        window
    }

    /// The marked line and its text, once it is that of this file.
    fn line(&mut self, file: &str) -> (u64, String) {
        let is_there = |s: &Value| s["file"]["reading"] == false && s["file"]["lines"]["file"] == file;
        let lines = self.until(file, is_there)["file"]["lines"].clone();
        (lines["line"].as_u64().unwrap(), lines["text"].as_str().unwrap_or_default().to_owned())
    }
}

fn is_inspected(state: &Value) -> bool {
    let models = state["file"]["models"].as_array().unwrap();
    state["file"]["reading"] == false && !models.is_empty() && models.iter().all(|model| model["reading"].is_null())
}

/// A white pixel.
fn picture() -> Vec<u8> {
    let pixel = gonio_image::EncodedPicture { width: 1, height: 1, rgba: vec![255; 4] };
    gonio_image::encode::png::encode8(&pixel, gonio_image::encode::png::ColorTag::Srgb).unwrap()
}

#[test]
fn values_and_warnings_lead_to_their_lines() {
    let folder = Folder::new("lines");
    let mut window = Window::to_file(&folder.path("square.obj"), 1280.0);
    let model = window.state()["file"]["models"][0].clone();
    assert_eq!((&model["triangles"], &model["format"]), (&json!(2), &json!("obj")));
    assert_eq!(window.widget("file-triangles").value, "2");
    // A value of a material.
    assert_eq!(window.widget("file-material-0-diffuse").value, "0.25 0.5 1");
    window.click("file-material-0-diffuse-line");
    assert_eq!(window.line(&folder.path("square.mtl")), (2, "Kd 0.25 0.5 1".into()));
    let meaning = window.widget("file-line-meaning");
    assert!(meaning.label.contains("diffuse"), "{}", meaning.label);
    // Its neighbours, by buttons and by keys; there is none after the last.
    window.click("file-lines-next");
    assert_eq!(window.line(&folder.path("square.mtl")), (3, "map_Kd paint.png".into()));
    window.click("file-lines-next");
    assert_eq!(window.line(&folder.path("square.mtl")).0, 3);
    window.click_at(window.center("file-lines") - vec2(0.0, 0.5 * window.widget("file-lines").rect[3] - 4.0));
    assert_eq!(window.line(&folder.path("square.mtl")), (1, "newmtl painted".into()), "a click on the first line");
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(window.line(&folder.path("square.mtl")).0, 2);
    // A note about a line of the model.
    let notes: Vec<String> = (0..)
        .map_while(|index| {
            let widgets = gonio_app::exported::widgets(&window.harness.ctx);
            widgets
                .into_iter()
                .find(|widget| widget.id == format!("file-note-{index}"))
                .map(|widget| widget.value + &widget.label)
        })
        .collect();
    let of_line = notes.iter().position(|note| note.contains("line")).unwrap_or_else(|| panic!("{notes:?}"));
    window.click(&format!("file-note-{of_line}-line"));
    assert_eq!(window.line(&folder.path("square.obj")), (12, "l 1 2".into()));
    window.click("file-lines-close");
    assert!(window.state()["file"]["lines"].is_null());
    // A warning in the tray leads here from any tab.
    window.click("tab-lights");
    let messages = window.state()["messages"].as_array().unwrap().clone();
    let is_texture = |message: &&Value| message["text"].as_str().unwrap_or_default().contains("paint.png");
    let warning = messages.iter().find(is_texture).unwrap_or_else(|| panic!("{messages:?}"));
    window.click(&format!("line-of-{}", warning["id"]));
    assert_eq!(window.line(&folder.path("square.mtl")), (3, "map_Kd paint.png".into()));
    assert_eq!(window.state()["tab"], "File");
}

#[test]
fn a_missing_file_is_on_the_list_until_it_is_dropped() {
    let folder = Folder::new("missing");
    let mut window = Window::to_file(&folder.path("scene.toml"), 1280.0);
    let file = window.state()["file"].clone();
    assert_eq!(file["scenes"], json!([folder.path("scene.toml")]));
    let models: Vec<&Value> = file["models"].as_array().unwrap().iter().map(|model| &model["missing"]).collect();
    assert_eq!(models, [&json!(["paint.png"]), &json!([])]);
    let states = |window: &Window| [0, 1].map(|index| window.widget(&format!("named-file-{index}")).value);
    assert_eq!(states(&window), ["found", "missing"]);
    assert_eq!(window.widget("files-summary").label, "One of 2 files that the model names is missing.");
    assert!(window.widget("files-hint").label.starts_with("Drop the missing files"));
    // It may come from any folder.
    let mut dropped = MemoryFiles::default();
    dropped.insert("elsewhere/Paint.png", picture());
    let input = SceneInput::gathered(dropped.names(), Arc::new(dropped));
    window.here.coming.borrow_mut().push(Event::Open(Box::new(input)));
    window.until("the texture", |s| is_inspected(s) && s["file"]["models"][0]["missing"] == json!([]));
    window.steps(2);
    assert_eq!(states(&window), ["found", "found"]);
    // The scene file itself.
    window.click("file-chosen");
    window.click("file-chosen-scene-toml");
    window.click("file-text");
    assert_eq!(window.line(&folder.path("scene.toml")), (1, "[[object]]".into()));
    window.click("scene-model-1");
    assert_eq!(window.state()["file"]["chosen"], "builtin:cube");
}

#[test]
fn a_model_is_saved_in_other_formats_with_its_textures() {
    let folder = Folder::new("saved");
    std::fs::write(folder.path("paint.png"), picture()).unwrap();
    let other = Folder::new("copies");
    for name in ["square.obj", "square.mtl"] {
        std::fs::remove_file(other.path(name)).unwrap();
    }
    let mut window = Window::to_file(&folder.path("square.obj"), 1280.0);
    let mut save = |format: &str, proposed: &str, place: &str| {
        window.click(&format!("save-model-{format}"));
        assert_eq!(window.until("the field", |s| !s["asking"].is_null())["asking"], proposed);
        window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.harness.event(egui::Event::Text(place.to_owned()));
        window.steps(1);
        window.press(Modifiers::NONE, Key::Enter);
        window.until("the copy", |s| s["asking"].is_null() && s["file"]["converting"].is_null())
    };
    for (format, proposed) in [("glb", "square.glb"), ("obj", "square_converted.obj"), ("ply", "square.ply")] {
        let place = other.path(&format!("copy.{format}"));
        let state = save(format, proposed, &place);
        assert_eq!(state["error"], Value::Null);
        assert_eq!(state["announcement"], format!("saved {place}"));
        let copy = inspect::inspect(&place, &Disk, &Default::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(copy.geometry.triangles, 2, "{format}");
        if format == "obj" {
            let found: Vec<_> = copy.textures.iter().map(|texture| texture.found.clone()).collect();
            assert_eq!(found, [Some(other.path("copy_paint.png"))], "the texture was copied");
        }
    }
    // The model's own files are not replaced.
    let state = save("obj", "square_converted.obj", &folder.path("square.obj"));
    let error = state["error"].as_str().unwrap_or_default().to_owned();
    assert!(error.contains("belongs to the open scene"), "{error}");
    assert_eq!(std::fs::read_to_string(folder.path("square.obj")).unwrap(), OBJ);
    assert_eq!(std::fs::read_to_string(folder.path("square.mtl")).unwrap(), MTL);
    assert!(Path::new(&folder.path("square.obj")).is_file());
}

#[test]
fn lines_take_the_place_of_the_list_on_a_phone() {
    let folder = Folder::new("phone");
    let mut window = Window::to_file(&folder.path("square.obj"), 390.0);
    window.click("named-file-0-line");
    assert_eq!(window.line(&folder.path("square.obj")), (1, "mtllib square.mtl".into()));
    window.steps(2);
    let widgets = gonio_app::exported::widgets(&window.harness.ctx);
    assert!(widgets.iter().any(|widget| widget.id == "file-lines"));
    assert!(!widgets.iter().any(|widget| widget.id == "files-summary"));
    window.click("file-lines-close");
    assert_eq!(window.widget("files-summary").value, "1");
}
