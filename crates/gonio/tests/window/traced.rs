//! The traced pane: it appears, follows the camera, and becomes the picture of `gonio trace`.

use crate::driven::Window;
use crate::files::answer;
use serde_json::Value;
use std::process::Command;

/// A sphere in the light of a lamp, and its shadow with a soft edge.
const SCENE: &str = r#"
[camera]
position = [0.0, 2.0, 6.0]
target = [0.0, 0.0, 0.0]
[[object]]
model = "builtin:sphere-smooth"
[[object]]
model = "builtin:cube"
translate = [0.0, -1.2, 0.0]
scale = [4.0, 0.1, 4.0]
[[light]]
kind = "point"
position = [-2.0, 4.0, 1.5]
radius = 0.5
quadratic = 0.05
"#;

/// Side of the blocks whose means are compared, pixels.
const BLOCK: u32 = 16;

/// The means of the blocks of a picture, 8-bit steps.
fn blocks(window: &Window, name: &str) -> Vec<[f64; 3]> {
    let picture = image::open(window.path(name)).unwrap().to_rgb8();
    let (columns, rows) = (picture.width() / BLOCK, picture.height() / BLOCK);
    let mean = |index: u32| {
        let (x, y) = (index % columns * BLOCK, index / columns * BLOCK);
        let mut sum = [0.0; 3];
        for pixel in (0..BLOCK * BLOCK).map(|i| picture.get_pixel(x + i % BLOCK, y + i / BLOCK)) {
            for (sum, value) in sum.iter_mut().zip(pixel.0) {
                *sum += f64::from(value) / f64::from(BLOCK * BLOCK);
            }
        }
        sum
    };
    (0..columns * rows).map(mean).collect()
}

/// The mean and the largest difference.
fn differences(a: &[[f64; 3]], b: &[[f64; 3]]) -> (f64, f64) {
    assert!(a.len() == b.len() && a.len() > 300, "{} and {} blocks", a.len(), b.len());
    let each: Vec<f64> = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).collect();
    (each.iter().sum::<f64>() / each.len() as f64, each.iter().copied().fold(0.0, f64::max))
}

fn save(window: &mut Window, key: &str, name: &str) {
    window.key(key);
    answer(window, name);
    let expected = format!("saved {name}");
    window.wait(&expected, |s| s["announcement"] == expected.as_str());
}

#[test]
fn a_traced_pane_becomes_the_picture_of_trace_and_blocks_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mut window = Window::open_in(folder, 900, 560, &["scene.toml"]);
    window.rest();
    let traced = |state: &Value, key: &str| state["traced"][0][key].clone();
    window.key("shift+t");
    let state = window.wait("a coarse picture", |s| traced(s, "pictures").as_u64() > Some(0));
    assert!(traced(&state, "paths").as_f64() > Some(0.0) && traced(&state, "failed").is_null(), "{}", state["traced"]);
    let state = window.wait("its times", |s| traced(s, "first_ms").is_number());
    assert!(traced(&state, "longest_ms").as_f64() > Some(0.0), "{}", state["traced"]);

    // Meanwhile everything can be used: a tab is opened, and the camera moved.
    window.click("tab-compare");
    let state = window.wait("the tab", |s| s["tab"] == "Compare");
    assert_eq!((traced(&state, "running"), traced(&state, "requests")), (true.into(), 1.into()));
    let (x, y) = window.find("pane-0");
    window.do_it(&["mousemove", &x.to_string(), &y.to_string()]);
    let pictures = traced(&window.state(), "pictures").as_u64();
    window.key("Left");
    let is_again = |s: &Value| traced(s, "requests").as_u64() > Some(1) && traced(s, "pictures").as_u64() > pictures;
    window.wait("another picture", is_again);

    let is_fine = |s: &Value| traced(s, "error").as_f64().is_some_and(|error| error < 0.05);
    window.wait("a fine picture", is_fine);
    save(&mut window, "ctrl+s", "window.png");
    save(&mut window, "ctrl+shift+s", "saved.toml");
    let size = image::image_dimensions(window.path("window.png")).unwrap();
    let size = format!("{}x{}", size.0, size.1);
    for args in [
        ["trace", "saved.toml", "-o", "trace.png", "--samples", "64"],
        ["render", "saved.toml", "-o", "render.png", "--samples", "4"],
    ] {
        let mut gonio = Command::new(env!("CARGO_BIN_EXE_gonio"));
        let status = gonio.args(args).args(["--quiet", "--size", &size]).current_dir(window.folder.path()).status();
        assert!(status.unwrap().success(), "{args:?}");
    }
    let [shown, trace, render] = ["window.png", "trace.png", "render.png"].map(|name| blocks(&window, name));
    // A pixel's error is 5 % at most, that of a block's 256 pixels 0.3 %: 0.4 steps of 8 bits. Four times that for the largest of
    // a thousand, and for clipped highlights.
    let (mean, most) = differences(&shown, &trace);
    assert!(mean < 0.4 && most < 2.0, "mean {mean}, largest {most}");
    // OpenGL's picture has no shadow.
    let (_, most) = differences(&shown, &render);
    assert!(most > 20.0, "as OpenGL's: {most}");
}
