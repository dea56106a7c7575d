//! Opening files, reading them again, saving them, and refusing them.

use crate::driven::{Window, asset};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// A folder with a blue cube and its materials.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let cube = std::fs::read_to_string(asset("cube.obj")).unwrap();
    assert!(cube.contains("mtllib cube.mtl"));
    std::fs::write(folder.path().join("cube.obj"), cube.replacen("\nf ", "\nusemtl body\nf ", 1)).unwrap();
    std::fs::write(folder.path().join("cube.mtl"), "newmtl body\nKd 0.1 0.2 0.9\n").unwrap();
    folder
}

/// Types a path into the path field.
pub fn answer(window: &mut Window, text: &str) {
    window.find("path");
    window.key("ctrl+a");
    window.type_text(text);
    window.key("Return");
}

fn save(window: &mut Window, key: &str, name: &str) {
    window.rest();
    window.key(key);
    answer(window, name);
    let expected = format!("saved {name}");
    window.wait(&expected, |s| s["announcement"] == expected.as_str());
}

/// Share of pixels of two pictures in which no channel differs by more than 2.
fn agreement(a: &Path, b: &Path) -> f64 {
    let [a, b] = [a, b].map(|path| image::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display())).to_rgba8());
    assert_eq!(a.dimensions(), b.dimensions());
    let near = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).all(|(a, b)| a.abs_diff(b) <= 2);
    a.pixels().zip(b.pixels()).filter(|pair| near(*pair)).count() as f64 / a.pixels().len() as f64
}

#[test]
fn a_model_is_opened_by_its_path_and_remembered() {
    let mut window = Window::open_in(folder(), 1024, 640, &["builtin:suzanne"]);
    window.key("ctrl+o");
    answer(&mut window, "cube.obj");
    let state = window.wait("the cube", |s| s["title"] == "cube.obj");
    assert_eq!(state["triangles"], 12);
    assert_eq!(state["error"], serde_json::Value::Null);
    let recent = state["recent"].as_array().unwrap();
    assert!(recent.len() == 1 && recent[0].as_str().unwrap().ends_with("/cube.obj"), "{recent:?}");
}

#[test]
fn changed_files_are_read_again_and_the_camera_stays() {
    let mut window = Window::open_in(folder(), 800, 600, &["cube.obj"]);
    window.rest();
    // An edit that must survive.
    window.key("Left");
    window.wait("a step to undo", |s| s["undo"] == true);
    let before = window.rest();
    save(&mut window, "ctrl+s", "before.png");
    window.write("cube.mtl", "newmtl body\nKd 0.9 0.05 0.05\n");
    let generation = before["generation"].as_u64();
    let after =
        window.wait("the file to be read again", |s| s["generation"].as_u64() > generation && s["busy"].is_null());
    assert_eq!(after["scene"]["camera"], before["scene"]["camera"]);
    save(&mut window, "ctrl+s", "after.png");
    let [was, is] = ["before.png", "after.png"].map(|name| image::open(window.path(name)).unwrap().to_rgb8());
    let middle = |picture: &image::RgbImage| picture.get_pixel(picture.width() / 2, picture.height() / 2).0;
    let ([r, g, b], old) = (middle(&is), middle(&was));
    assert!(old[2] > old[0], "{old:?} is not blue");
    assert!(r > g && r > b, "{:?} is not red; it was {old:?}", [r, g, b]);
    // A file that cannot be read leaves the scene unchanged.
    window.write("cube.obj", "this is no model\n");
    let broken = window.wait("an error", |s| s["error"].is_string());
    assert_eq!(broken["triangles"], 12);
}

#[test]
fn a_saved_picture_matches_that_of_render() {
    let mut window = Window::open(1000, 700, &["builtin:suzanne"]);
    save(&mut window, "ctrl+s", "window.png");
    save(&mut window, "ctrl+shift+s", "scene.toml");
    let size = image::image_dimensions(window.path("window.png")).unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(["render", "scene.toml", "-o", "render.png", "--quiet", "--size", &format!("{}x{}", size.0, size.1)])
        .current_dir(window.folder.path())
        .status()
        .unwrap();
    assert!(status.success());
    let share = agreement(&window.path("window.png"), &window.path("render.png"));
    // Set by the project's fifth issue, for the window, the page and the reference.
    assert!(share >= 0.995, "{share}");
}

#[test]
fn options_of_render_change_the_scene() {
    let args = ["builtin:cube", "--shading", "flat", "--environment", "debug", "--exposure", "1.5"];
    let window = Window::open(800, 600, &args);
    let scene = &window.state()["scene"];
    assert_eq!(scene["object"][0]["shading"], "flat");
    assert_eq!(scene["environment"]["image"], "debug");
    assert_eq!(scene["picture"]["exposure"], 1.5);
}

#[test]
fn a_file_that_cannot_be_opened_changes_nothing() {
    let mut window = Window::open(1024, 640, &["builtin:cube"]);
    let before = window.state();
    window.write("bad.obj", "this is no model\n");
    for (path, words) in [("none.obj", "there is no such file"), ("bad.obj", "bad.obj")] {
        window.key("ctrl+o");
        window.find("path");
        window.type_text(path);
        window.key("Return");
        let state = window.wait(path, |s| s["error"].as_str().is_some_and(|e| e.contains(words)));
        assert_eq!(state["title"], before["title"]);
        assert_eq!(state["scene"], before["scene"]);
    }
    // Messages stay until they are dismissed.
    let state = window.rest();
    assert_eq!(state["messages"].as_array().unwrap().len(), 2);
    let id = state["messages"][0]["id"].as_u64().unwrap();
    window.click(&format!("dismiss-{id}"));
    window.wait("one message less", |s| s["messages"].as_array().unwrap().len() == 1);
}

#[test]
fn a_shader_that_does_not_compile_leaves_the_last_good_program() {
    let folder = tempfile::tempdir().unwrap();
    let shader = |color: &str| {
        format!(
            "#version 330 core\nuniform float gain = 1.0;\nout vec4 c;\nvoid main() {{ c = vec4({color}, 1.0); }}\n"
        )
    };
    std::fs::write(folder.path().join("own.frag"), shader("gain, 0.0, 0.0")).unwrap();
    let mut window = Window::open_in(folder, 900, 600, &["builtin:cube", "--fragment", "own.frag"]);
    window.wait("the program", |s| s["shaders"]["compiled"] == true);
    let color = |window: &mut Window, name: &str| {
        save(window, "ctrl+s", name);
        let picture = image::open(window.path(name)).unwrap().to_rgb8();
        picture.get_pixel(picture.width() / 2, picture.height() / 2).0
    };
    assert_eq!(color(&mut window, "first.png"), [255, 0, 0]);
    window.write("own.frag", &shader("gian, 0.0, 0.0"));
    let state = window.wait("an error", |s| s["shaders"]["failed"] == true);
    let error = state["error"].as_str().unwrap();
    assert!(error.starts_with("own.frag:4:24: ") && error.contains("gian"), "{error}");
    assert_eq!(color(&mut window, "kept.png"), [255, 0, 0]);
    // The repaired text replaces the program, and the error disappears.
    window.write("own.frag", &shader("0.0, gain, 0.0"));
    let state = window.wait("another program", |s| s["shaders"]["failed"] == false);
    assert_eq!(state["error"], serde_json::Value::Null);
    assert_eq!(color(&mut window, "repaired.png"), [0, 255, 0]);
    let gain = &state["shaders"]["uniforms"][0];
    assert_eq!((&gain["name"], &gain["origin"]), (&"gain".into(), &"its initialiser".into()));
    // A value that is typed stays when the text changes.
    window.click("uniform-gain");
    window.key("ctrl+a");
    window.type_text("0.2");
    window.key("Return");
    window.wait("the value", |s| s["shaders"]["uniforms"][0]["origin"] == "your value");
    assert_eq!(color(&mut window, "typed.png"), [0, 51, 0]);
    window.write("own.frag", &shader("0.0, 0.0, gain"));
    let serial = window.state()["shaders"]["serial"].as_u64();
    window.wait("the last program", |s| s["shaders"]["serial"].as_u64() > serial);
    assert_eq!(color(&mut window, "last.png"), [0, 0, 51]);
}

#[test]
fn names_toml_beside_the_shaders_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let shader =
        "#version 330 core\nuniform float level;\nout vec4 c;\nvoid main() { c = vec4(level, 0.0, 0.0, 1.0); }\n";
    std::fs::write(folder.path().join("own.frag"), shader).unwrap();
    let mut window = Window::open_in(folder, 900, 600, &["builtin:cube", "--fragment", "own.frag"]);
    let state = window.wait("the program", |s| s["shaders"]["compiled"] == true);
    assert_eq!(state["shaders"]["uniforms"][0]["origin"], "not recognised: a guess");
    // The file is new.
    window.write("names.toml", "[names]\nlevel = 1\n");
    let state = window.wait("the value", |s| s["shaders"]["uniforms"][0]["origin"] == "names.toml");
    assert_eq!(state["shaders"]["uniforms"][0]["values"][0], 1.0);
    window.write("names.toml", "[names]\nlevel = \"tiem\"\n");
    let state = window.wait("an error", |s| s["shaders"]["failed"] == true);
    let error = state["error"].as_str().unwrap();
    assert!(error.contains("names.toml:2: unknown role `tiem`: did you mean `time`?"), "{error}");
    window.write("names.toml", "[names]\nlevel = \"time\"\n");
    let state = window.wait("another program", |s| s["shaders"]["failed"] == false);
    assert_eq!(
        (&state["shaders"]["uniforms"][0]["origin"], &state["error"]),
        (&"the time in seconds".into(), &serde_json::Value::Null)
    );
}

#[test]
fn own_shaders_are_stepped_through_at_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let shader = "#version 330 core\nin vec3 normal;\nuniform float gain = 0.5;\nout vec4 c;\n\nvoid main() {\n    \
                  vec3 n = normalize(normal);\n    float up = gain * n.y;\n    c = vec4(n, up);\n}\n";
    std::fs::write(folder.path().join("own.frag"), shader).unwrap();
    let mut window = Window::open_in(folder, 1280, 800, &["builtin:cube", "--fragment", "own.frag"]);
    window.wait("the program", |s| s["shaders"]["compiled"] == true);
    window.rest();
    assert!(window.state()["shaders"]["text"].is_null());
    window.click("pane-0");
    let listed = |s: &Value| s["shaders"]["step"]["busy"] == false && s["shaders"]["step"]["values"].is_array();
    let state = window.wait("the values", listed);
    let step = &state["shaders"]["step"];
    assert_eq!((&step["stage"], &step["message"]), (&"fragment".into(), &Value::Null));
    assert_eq!((&state["shaders"]["text"], &state["tab"]), (&"own.frag".into(), &"Shaders".into()));
    // A face of the cube has one normal, of length 1.
    let beside = |state: &Value, line: u64| {
        let values = state["shaders"]["step"]["values"].as_array().unwrap();
        let found = values.iter().find(|value| value["line"] == line).unwrap_or_else(|| panic!("{values:?}"));
        found["text"].as_str().unwrap().to_owned()
    };
    let n: Vec<f64> =
        beside(&state, 7).trim_matches(['(', ')']).split(", ").map(|number| number.parse().unwrap()).collect();
    assert!((n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-3, "{n:?}");
    assert!((beside(&state, 8).parse::<f64>().unwrap() - 0.5 * n[1]).abs() < 1e-3);
    // A step back, and the last line has no value yet.
    window.key("shift+F10");
    let state = window.wait("a step back", |s| s["shaders"]["step"]["line"] == 8);
    assert!(state["shaders"]["step"]["values"].as_array().unwrap().iter().all(|value| value["line"] != 9));
    window.key("F10");
    window.wait("the last step", |s| s["shaders"]["step"]["line"] == 9);
}

#[test]
fn a_baked_model_is_saved_with_its_files_and_can_be_drawn() {
    let mut window = Window::open(1000, 760, &["builtin:still-life"]);
    window.rest();
    window.key("ctrl+b");
    window.click("bake-size-512");
    window.click("bake-start");
    let state = window.wait("the atlas", |s| !s["bake"]["result"].is_null());
    assert_eq!(state["bake"]["failed"], Value::Null);
    window.rest();
    window.click("save-baked-obj");
    answer(&mut window, "mine.obj");
    window.wait("the files", |s| s["announcement"] == "saved mine.obj");
    for name in ["mine.obj", "still-life_baked.mtl", "still-life_baked_diffuse.png", "still-life_baked_layout.png"] {
        assert!(window.path(name).is_file(), "{name}");
    }
    let mut gonio = Command::new(env!("CARGO_BIN_EXE_gonio"));
    let drawn = gonio.args(["inspect", "mine.obj", "--json"]).current_dir(window.folder.path()).output().unwrap();
    let report = String::from_utf8_lossy(&drawn.stdout);
    assert!(drawn.status.success() && report.contains("still-life_baked_diffuse.png"), "{report}");
}
