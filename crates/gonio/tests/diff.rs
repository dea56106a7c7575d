//! `gonio diff` on constructed pictures with known differences.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, Run};
use image::{Rgb, RgbImage};

impl Lab {
    fn png(&self, name: &str, pixel: impl Fn(u32, u32) -> [u8; 3]) {
        RgbImage::from_fn(16, 8, |x, y| Rgb(pixel(x, y))).save(self.path(name)).unwrap();
    }

    fn diff(&self, args: &[&str]) -> Run {
        self.run(&[&["diff"], args].concat())
    }
}

#[test]
fn equal_pictures_do_not_differ() {
    let lab = Lab::new();
    lab.png("a.png", |x, y| [x as u8 * 9, y as u8, 77]);
    let json = lab.diff(&["a.png", "a.png", "--json", "--max-difference", "0", "--min-ssim", "1"]).good().json();
    assert_eq!(json["steps"], serde_json::json!({ "mean": 0.0, "rms": 0.0, "max": 0.0 }));
    assert_eq!((json["differing_pixels"].as_u64(), json["ssim"].as_f64()), (Some(0), Some(1.0)));
    assert_eq!(json["flip"].as_f64(), Some(0.0));
    assert!(json["worst"].is_null());
}

#[test]
fn the_numbers_of_one_different_pixel() {
    let lab = Lab::new();
    lab.png("a.png", |_, _| [100, 100, 100]);
    lab.png("b.png", |x, y| if (x, y) == (3, 5) { [112, 100, 100] } else { [100, 100, 100] });
    let json = lab.diff(&["a.png", "b.png", "--json"]).good().json();
    let values = f64::from(16 * 8 * 3);
    // 1e-9: rounding of f64.
    let near = |v: &serde_json::Value, expected: f64| {
        assert!((v.as_f64().unwrap() - expected).abs() < 1e-9, "{v} and {expected}")
    };
    near(&json["steps"]["max"], 12.0);
    near(&json["steps"]["mean"], 12.0 / values);
    near(&json["steps"]["rms"], (144.0 / values).sqrt());
    near(&json["differing_percent"], 100.0 / 128.0);
    let decode = |v: f64| ((v / 255.0 + 0.055) / 1.055).powf(2.4);
    near(&json["linear"]["max"], decode(112.0) - decode(100.0));
    assert_eq!(json["worst"], serde_json::json!({ "x": 3, "y": 5, "a": "#646464", "b": "#706464" }));
    assert!(json["ssim"].as_f64().unwrap() < 1.0);
    assert!(json["flip"].as_f64().is_some_and(|flip| flip > 1e-4 && flip < 0.1), "{}", json["flip"]);
}

#[test]
fn failed_checks_end_with_exit_code_1() {
    let lab = Lab::new();
    lab.png("a.png", |_, _| [100; 3]);
    lab.png("b.png", |x, _| [if x < 4 { 102 } else { 100 }; 3]);
    lab.diff(&["a.png", "b.png", "--max-difference", "2", "--max-differing", "25", "--max-rms", "1"]).good();
    lab.diff(&["a.png", "b.png", "--tolerance", "2", "--max-differing", "0"]).good();
    for check in [
        ["--max-difference", "1.9"],
        ["--max-differing", "24.9"],
        ["--max-rms", "0.9"],
        ["--max-linear", "0.001"],
        ["--min-ssim", "1"],
    ] {
        let run = lab.diff(&[&["a.png", "b.png"], &check[..]].concat());
        assert_eq!(run.code, 1, "{check:?}: {}", run.stderr);
        assert!(run.stderr.starts_with("check failed: ") && run.stderr.contains(check[0]), "{}", run.stderr);
    }
    let json = lab.diff(&["a.png", "b.png", "--max-difference", "1", "--json"]).json();
    assert_eq!((json["held"].as_bool(), json["checks"][0]["held"].as_bool()), (Some(false), Some(false)));
}

#[test]
fn the_map_and_the_sheets() {
    let lab = Lab::new();
    lab.png("a.png", |_, _| [10, 20, 30]);
    lab.png("b.png", |x, y| if (x, y) == (15, 7) { [255, 20, 30] } else { [10, 20, 30] });
    lab.diff(&["a.png", "b.png", "-o", "map.png", "--no-legend", "--side-by-side", "side.png", "--wipe", "wipe.png"])
        .good();
    let map = lab.picture("map.png").to_rgb8();
    assert_eq!(map.dimensions(), (16, 8));
    assert_eq!(map.get_pixel(15, 7).0, [255, 255, 235]);
    assert!(map.pixels().filter(|p| p.0 == [0, 0, 0]).count() == 127);
    let side = lab.picture("side.png").to_rgb8();
    assert_eq!(side.dimensions(), (3 * 16 + 2 * 6, 8));
    assert_eq!(side.get_pixel(15, 7).0, [10, 20, 30]);
    assert_eq!(side.get_pixel(16 + 6 + 15, 7).0, [255, 20, 30]);
    assert_eq!(side.get_pixel(2 * 22 + 15, 7).0, [255, 255, 235]);
    let wipe = lab.picture("wipe.png").to_rgb8();
    assert_eq!(wipe.get_pixel(15, 7).0, [255, 20, 30]);
    assert_eq!(wipe.get_pixel(8, 3).0, [255, 255, 255]);
    assert_eq!(lab.names(), ["a.png", "b.png", "map.png", "side.png", "wipe.png"]);
}

#[test]
fn sixteen_bits_are_compared_exactly() {
    let lab = Lab::new();
    let save = |name: &str, v: u16| {
        image::ImageBuffer::from_fn(8, 8, |_, _| Rgb([v, v, v])).save(lab.path(name)).unwrap();
    };
    save("a.png", 1000);
    save("b.png", 1001);
    let json = lab.diff(&["a.png", "b.png", "--json"]).good().json();
    let step = json["steps"]["max"].as_f64().unwrap();
    assert!((step - 255.0 / 65535.0).abs() < 1e-9, "{step}");
}

#[test]
fn an_exr_is_compared_in_linear_light_and_by_layer() {
    let lab = Lab::new();
    let cube = common::asset("cube.obj");
    lab.render(&[&cube, "-o", "a.exr", "--views", "N"]).good();
    lab.render(&[&cube, "-o", "b.exr", "--exposure", "3"]).good();
    // Exposure is part of the encoding and does not change linear light.
    lab.diff(&["a.exr", "b.exr", "--max-linear", "0"]).good();
    lab.render(&[&cube, "-o", "n.exr", "--debug", "N"]).good();
    lab.diff(&["a.exr", "n.exr", "--layer", "normal", "--max-linear", "0"]).good();
    assert_eq!(lab.diff(&["a.exr", "n.exr", "--max-linear", "0"]).code, 1);
    lab.diff(&["a.exr", "b.exr", "--layer", "normal"]).refused(&["b.exr", "no layer `normal`", "picture"]);
    // An EXR against its PNG: rounding to 8 bits is half a step.
    lab.render(&[&cube, "-o", "a.png"]).good();
    let json = lab.diff(&["a.exr", "a.png", "--json"]).good().json();
    assert!(json["steps"]["max"].as_f64().unwrap() <= 0.501, "{json}");
}

#[test]
fn pictures_that_cannot_be_compared_are_refused() {
    let lab = Lab::new();
    lab.png("a.png", |_, _| [1, 2, 3]);
    RgbImage::new(4, 4).save(lab.path("small.png")).unwrap();
    lab.write("text.png", "this is no picture");
    lab.write("empty.png", "");
    lab.write("cut.png", &lab.read("a.png")[..60]);
    lab.diff(&["a.png", "small.png"]).refused(&["16x8", "4x4"]);
    lab.diff(&["a.png", "missing.png"]).refused(&["`missing.png` cannot be read", "no such file"]);
    lab.diff(&["a.png", "."]).refused(&["`.` cannot be read", "folder"]);
    lab.diff(&["a.png", "text.png"]).refused(&["unsupported format of `text.png`"]);
    lab.diff(&["a.png", "empty.png"]).refused(&["`empty.png` is empty"]);
    lab.diff(&["a.png", "cut.png"]).refused(&["`cut.png` is damaged"]);
    lab.diff(&["a.png", "a.png", "-o", "map.jpg"]).refused(&["`map.jpg`", ".png"]);
    lab.diff(&["a.png", "a.png", "-o", "no/map.png"]).refused(&["there is no folder"]);
}
