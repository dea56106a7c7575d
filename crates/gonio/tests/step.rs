//! `gonio lab step`, and `gonio lab draw --show`.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::Lab;
use serde_json::Value;

/// Writes the reference solution of exercise 07 to a folder, changed.
fn hand_in(lab: &Lab, folder: &str, from: &str, to: &str) {
    lab.run(&["lab", "reference", "ex07", "-o", folder]).good();
    for name in ["reference.vert", "reference.frag"] {
        let path = format!("{folder}/{name}");
        let text = String::from_utf8(lab.read(&path)).unwrap();
        lab.write(&path, text.replace(from, to));
    }
}

/// `ARGS --size 64`, or more pixels.
fn small(lab: &Lab, side: &str, args: &[&str]) -> common::Run {
    lab.run(&[args, &["--size", side][..]].concat())
}

/// The values of a variable in the order of execution.
fn values(stage: &Value, name: &str) -> Vec<Value> {
    let steps = stage["steps"].as_array().unwrap().iter();
    let writes = steps.flat_map(|step| step["writes"].as_array().unwrap());
    writes.filter(|write| write["name"] == name).map(|write| write["value"].clone()).collect()
}

#[test]
fn a_pixel_is_stepped_through_with_its_corners() {
    let lab = Lab::new();
    let report = small(&lab, "64", &["lab", "step", "ex07", "--at", "30,20", "--corners", "--json"]).good().json();
    assert_eq!((&report["command"], &report["pixel"]), (&"lab step".into(), &serde_json::json!([30, 20])));
    let stages = report["stages"].as_array().unwrap();
    let names: Vec<_> = stages.iter().map(|stage| stage["stage"].as_str().unwrap()).collect();
    assert_eq!(names, ["fragment", "vertex", "vertex", "vertex"]);
    assert_eq!(stages[1]["vertex"], report["triangle_vertices"][0]);
    let number = |value: &Value| value.as_f64().unwrap();
    let d = number(&values(&stages[0], "d")[0]);
    let expected = 1.0 / (1.0 + 0.14 * d + 0.07 * d * d);
    assert!((number(&values(&stages[0], "attenuation")[0]) - expected).abs() < 1e-6, "{d}");
    let text = small(&lab, "64", &["lab", "step", "ex07", "--at", "30,20"]).good();
    for piece in ["varyings", "v_normal", "attenuation = ", "light.light_pos = (1, 2, 1.5)", "outputs"] {
        assert!(text.text().contains(piece), "{piece}: {}", text.text());
    }
    let vertex = lab.run(&["lab", "step", "ex07", "--vertex", "0", "--json"]).good().json();
    assert_eq!(vertex["stages"][0]["steps"][0]["writes"][0]["name"], "frag_coord");
}

#[test]
fn places_without_a_value_are_refused_with_one_that_has_one() {
    let lab = Lab::new();
    let step = |args: &[&str]| lab.run(&[&["lab", "step", "ex07", "--size", "64"][..], args].concat());
    step(&["--at", "0,0"]).refused(&["nothing is drawn at pixel 0,0", "the nearest pixel"]);
    step(&["--at", "64,3"]).refused(&["pixel 64,3 is outside of the picture of 64x64 pixels"]);
    step(&["--vertex", "99999"]).refused(&["there is no vertex 99999"]);
    step(&["--scene", "moon"]).refused(&["`moon`", "stretched"]);
    step(&["none.frag"]).refused(&["none.frag"]);
    lab.run(&["lab", "step", "ex02"]).refused(&["ex02"]);
    let show = |place: &str| lab.run(&["lab", "draw", "ex07", "--show", place, "-o", "x.png", "--size", "64"]);
    show("1:1").refused(&["reference.frag:1:1", "no expression"]);
    assert!(!lab.path("x.png").exists());
}

#[test]
fn shaders_that_do_not_compile_or_end_are_reported_with_their_line() {
    let lab = Lab::new();
    hand_in(&lab, "broken", "float d = length(", "float d = lenght(");
    lab.run(&["lab", "step", "ex07", "broken"]).refused(&["reference.frag:35:", "lenght"]);
    hand_in(&lab, "endless", "    float d =", "    while (true) { N += 1.0; }\n    float d =");
    let report = small(&lab, "64", &["lab", "step", "ex07", "endless", "--json"]).good().json();
    assert_eq!(report["stages"][0]["endless_loop"]["line"], 35);
    let text = small(&lab, "64", &["lab", "step", "ex07", "endless"]).good();
    assert!(text.text().contains("this loop did not end after"), "{}", text.text());
    hand_in(&lab, "nothing", "v_frag_coord =", "for (;;) {}\n    v_frag_coord =");
    small(&lab, "64", &["lab", "step", "ex07", "nothing"]).refused(&["does not end at vertex 0", "--vertex 0"]);
}

#[test]
fn the_interpreter_draws_what_opengl_draws() {
    let lab = Lab::new();
    for scene in ["the lab's", "stretched"] {
        let draw = |args: &[&str]| {
            small(&lab, "96", &[&["lab", "draw", "ex07", "--scene", scene][..], args].concat()).good();
        };
        draw(&["-o", "opengl.png"]);
        // `vec4(materialColour * sum, 1.0)`
        draw(&["--show", "40:17", "-o", "cpu.png"]);
        let [opengl, cpu] = ["opengl.png", "cpu.png"].map(|name| lab.picture(name).to_rgba8());
        let background = *cpu.get_pixel(0, 0);
        let (mut compared, mut different) = (0, 0);
        for (x, y, pixel) in opengl.enumerate_pixels().filter(|(x, y, _)| *x > 0 && *y > 0 && *x < 95 && *y < 95) {
            // OpenGL blends pixels at an outline with what is behind it.
            let around = (0..9).map(|i| (x + i % 3 - 1, y + i / 3 - 1));
            let is_inside = around.clone().all(|(x, y)| *cpu.get_pixel(x, y) != background);
            let mut colours = around.map(|(x, y)| opengl.get_pixel(x, y));
            let is_smooth = colours.all(|other| (0..3).all(|c| pixel[c].abs_diff(other[c]) < 16));
            if !is_inside || !is_smooth {
                continue;
            }
            compared += 1;
            let other = cpu.get_pixel(x, y);
            different += i32::from((0..3).any(|c| pixel[c].abs_diff(other[c]) > 1));
        }
        // The ring's outlines in front of itself are of similar colours.
        let most = if scene == "stretched" { compared / 100 } else { 0 };
        assert!(compared > 500 && different <= most, "{scene}: {different} of {compared} pixels");
    }
    let run = lab.run(&["lab", "draw", "ex07", "--show", "26:10", "-o", "n.png", "--size", "96", "--json"]).good();
    let shown = &run.json()["shown"];
    assert_eq!((&shown["expression"], &shown["pixels_not_evaluated"]), (&"normalize(v_normal)".into(), &0.into()));
}

#[test]
fn a_wrong_value_is_listed_and_drawn_beside_the_right_one() {
    let lab = Lab::new();
    hand_in(&lab, "mine", "length(light.light_pos - v_frag_coord)", "length(light.light_pos)");
    let text = small(&lab, "64", &["lab", "step", "ex07", "mine", "--at", "30,20"]).good();
    let right = "`length(light.light_pos)` should be the distance from the surface to the light = 3.";
    assert!(text.text().contains(right), "{}", text.text());
    let report = small(&lab, "64", &["lab", "step", "ex07", "mine", "--at", "30,20", "--json"]).good().json();
    let right = &report["stages"][0]["should_be"][0];
    assert_eq!((&right["line"], &right["column"]), (&35.into(), &15.into()), "{right}");
    assert!(right["value"].as_f64().is_some_and(|d| (3.0..4.0).contains(&d)), "{right}");
    let show = |files: &[&str]| {
        let args = [&["lab", "draw", "ex07", "--show", "35:11", "-o", "d.png", "--json"], files].concat();
        let report = small(&lab, "64", &args).good().json();
        (lab.picture("d.png").to_rgba8(), report)
    };
    let (both, report) = show(&["mine"]);
    assert_eq!((both.dimensions(), &report["right_beside"]), ((130, 64), &true.into()));
    // The wrong distance is the same everywhere, the right one is not.
    let [own, right] = [&both.get_pixel(32, 32), &both.get_pixel(66 + 32, 32)];
    assert!(own[0] == 0 && right[0] > 60 && right[0] == right[1], "{own:?} {right:?}");
    assert!(report["quantity"].as_str().unwrap().contains("should be the distance"), "{report}");
    let (alone, _) = show(&[]);
    assert_eq!(alone.dimensions(), (64, 64));
}
