//! `gonio simplify`: the staircase from the rendering equation to the light equation, its page, and bad input.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, exr_layers};
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

const ORDER: [&str; 10] = [
    "time",
    "wavelengths",
    "emission",
    "brdf",
    "interreflection",
    "shadows",
    "cosine",
    "attenuation",
    "sum",
    "ambient",
];

/// Two cubes, one on the other, under a point light with ambient light.
const SCENE: &str = r#"
[picture]
width = 64
height = 48
[camera]
position = [2.5, 2.5, 4]
target = [0, 0, 0]
[[object]]
model = "builtin:cube"
name = "floor"
translate = [0, -1, 0]
scale = [4, 0.1, 4]
material = { diffuse = [0.7, 0.6, 0.5], specular = [0, 0, 0] }
[[object]]
model = "builtin:sphere-smooth"
name = "ball"
scale = [0.8, 0.8, 0.8]
material = { diffuse = [0.6, 0.1, 0.1], specular = [0.3, 0.3, 0.3], shininess = 20 }
[[light]]
kind = "point"
position = [2, 3, 1]
quadratic = 0.1
[[light]]
kind = "ambient"
intensity = 0.1
"#;

#[test]
fn the_staircase_ends_at_the_light_equation() {
    let lab = Lab::new();
    lab.write("scene.toml", SCENE);
    let report = lab.run(&["simplify", "scene.toml", "-o", "out", "--samples", "64", "--json"]).good().json();
    let steps = report["steps"].as_array().unwrap();
    let names: Vec<&str> = steps.iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ORDER);
    assert_eq!(report["alone"].as_array().unwrap().len(), ORDER.len());

    // The last picture is the light equation's own: what remains is the noise of outlines, which samples of 64 paths and of the
    // renderer's pattern see differently.
    let equation = &report["light_equation"];
    assert!(equation["rms"].as_f64().unwrap() < 0.05 && equation["flip"].as_f64().unwrap() < 0.02, "{equation}");
    let drawn = lab.run(&["render", "scene.toml", "-o", "again.png", "--backend", "cpu", "--size", "64x48"]).good();
    drop(drawn);
    assert_eq!(lab.read("again.png"), lab.read("out/light-equation.png"));

    // What cannot change this scene is said to change nothing, and why.
    let step = |name: &str| &steps[ORDER.iter().position(|n| *n == name).unwrap()];
    for (name, reason) in [("time", "nothing moves here"), ("emission", "no part emits light with a texture")] {
        assert!(step(name)["look"].as_str().unwrap().contains(reason), "{}", step(name)["look"]);
    }
    // Shadows and light between surfaces are there, and where they are is named.
    for (name, brighter) in [("interreflection", false), ("shadows", true)] {
        let change = &step(name)["to_before"];
        assert_eq!(change["below_noise"], false, "{name}: {change}");
        assert_eq!(change["brighter"].as_f64().unwrap() > 0.0, brighter, "{name}: {change}");
        let look = step(name)["look"].as_str().unwrap();
        assert!(look.contains("`floor`") || look.contains("`ball`"), "{look}");
    }
    // The fitted ambient light loses less than the scene's own, and than none.
    let fit = &report["ambient"];
    let rms = |key: &str| fit[key].as_f64().unwrap();
    assert!(rms("rms_fitted") <= rms("rms_own") && rms("rms_fitted") <= rms("rms_without"), "{fit}");

    page_is_complete(&lab, &report);
}

/// The page shows every step, holds its pictures, and every file has its place.
fn page_is_complete(lab: &Lab, report: &serde_json::Value) {
    let page = String::from_utf8(lab.read("out/index.html")).unwrap();
    assert!(
        !page.contains("http://") && !page.contains("https://") && !page.contains("src=\"0"),
        "it needs other files"
    );
    let places: Vec<usize> = ORDER.iter().map(|name| page.find(&format!("id=\"{name}\"")).unwrap()).collect();
    assert!(places.is_sorted());
    assert!(page.matches("src=\"data:image/png;base64,").count() >= 3 * ORDER.len());
    assert!(page.contains("class=\"struck\""));
    for (tag, close) in [
        ("<figure", "</figure>"),
        ("<section", "</section>"),
        ("<mrow", "</mrow>"),
        ("<div", "</div>"),
        ("<dl", "</dl>"),
    ] {
        assert_eq!(page.matches(tag).count(), page.matches(close).count(), "{tag}");
    }
    let json: serde_json::Value = serde_json::from_slice(&lab.read("out/steps.json")).unwrap();
    assert_eq!(json["steps"][3]["formula"], report["steps"][3]["formula"]);
    for name in ["0-truth", "5b-shadows", "9-ambient", "fitted-ambient", "light-equation"] {
        assert_eq!(lab.picture(&format!("out/{name}.png")).width(), 64, "{name}");
        assert!(lab.path(&format!("out/{name}.exr")).is_file(), "{name}");
    }
    for name in ["5b-shadows-from-before", "5b-shadows-from-truth"] {
        assert_eq!(lab.picture(&format!("out/{name}.png")).width(), 64, "{name}");
    }
}

#[test]
fn the_same_seed_gives_the_same_pictures() {
    let lab = Lab::new();
    for (out, threads) in [("a", "1"), ("b", "3")] {
        let args = ["simplify", "builtin:cube", "--size", "40x30", "--samples", "4", "--only", "shadows"];
        lab.run(&[&args[..], &["-o", out, "--threads", threads]].concat()).good();
    }
    for name in ["0-truth.exr", "5b-shadows.exr", "5b-shadows-from-before.png"] {
        assert!(lab.read(&format!("a/{name}")) == lab.read(&format!("b/{name}")), "{name}");
    }
    assert!(!lab.path("a/1-time.png").exists());
}

#[test]
fn chosen_steps_are_made_in_the_order_of_the_lecture() {
    let lab = Lab::new();
    let args = ["simplify", "builtin:cube", "--size", "24x16", "-o", "out", "--time", "0.3", "--json"];
    let report = lab.run(&[&args[..], &["--steps", "shadows,wavelengths"]].concat()).good().json();
    let names: Vec<_> = report["steps"].as_array().unwrap().iter().map(|s| s["name"].clone()).collect();
    assert_eq!(names, ["wavelengths", "shadows"]);
    assert!(report["light_equation"].is_null() && report["ambient"].is_null());
    // Both by themselves, too.
    assert_eq!(report["alone"].as_array().unwrap().len(), 2);
}

#[test]
fn mirrors_are_compared_with_a_cubemap() {
    let lab = Lab::new();
    let args =
        ["simplify", "builtin:glass-and-mirror", "--size", "48x30", "--samples", "2", "--only", "time", "--json"];
    let report = lab.run(&[&args[..], &["-o", "out"]].concat()).good().json();
    let objects = report["cubemap"]["objects"].as_array().unwrap();
    let reason =
        |name: &str| objects.iter().find(|o| o["name"] == name).unwrap()["reason"].as_str().unwrap().to_owned();
    assert!(reason("mirror").contains("never another object") && !reason("mirror").contains("bent"));
    assert!(reason("glass").contains("where it enters and where it leaves"));
    assert!(!objects.iter().any(|o| o["name"] == "clay"));
    let page = String::from_utf8(lab.read("out/index.html")).unwrap();
    assert!(page.contains("Yes: with a cubemap"));
}

/// Lights have the names of the scene's file, and what is odd about a scene is said.
#[test]
fn lights_have_names_and_oddities_are_warnings() {
    let lab = Lab::new();
    lab.write("scene.toml", SCENE.replace("kind = \"point\"", "kind = \"point\"\nname = \"desk lamp\""));
    let args = ["simplify", "scene.toml", "-o", "out", "--samples", "32", "--only", "shadows", "--json"];
    let run = lab.run(&args).good();
    let look = run.json()["steps"][0]["look"].as_str().unwrap().to_owned();
    assert!(look.contains("light from `desk lamp`") && !look.contains("light 0"), "{look}");
    assert!(!run.stderr.contains("warning"), "{}", run.stderr);
    let dark = ["simplify", "builtin:cube", "--light", "ambient", "--size", "8x8", "--samples", "2", "--only", "time"];
    let run = lab.run(&[&dark[..], &["-o", "dark"]].concat()).good();
    assert!(run.stderr.contains("warning: nothing lights the scene"), "{}", run.stderr);
}

/// A picture that ends with a larger error than requested says so, on the page too.
#[test]
fn an_error_that_cannot_be_reached_is_a_warning() {
    let lab = Lab::new();
    let args = ["simplify", "builtin:cube", "--size", "3x2", "--only", "time", "--error"];
    let run = lab.run(&[&args[..], &["1e-6", "-o", "out", "--json"]].concat()).good();
    for piece in ["2 of 2 pictures have a larger error than requested", "65536 paths per pixel", "larger --error"] {
        assert!(run.stderr.contains(piece), "`{piece}` is not in: {}", run.stderr);
    }
    let truth = &run.json()["truth"];
    assert_eq!((&truth["missed"], &truth["paths"]), (&true.into(), &65536.into()), "{truth}");
    assert!(truth["error_bound"].as_f64().unwrap() > 1e-8, "{truth}");
    let page = |folder: &str| String::from_utf8(lab.read(&format!("{folder}/index.html"))).unwrap();
    assert!(page("out").contains("more than requested"));
    let run = lab.run(&[&args[..], &["20", "-o", "near", "--json"]].concat()).good();
    assert!(!run.stderr.contains("requested") && !page("near").contains("more than requested"), "{}", run.stderr);
    assert!(run.json()["truth"]["error_bound"].as_f64().unwrap() <= 0.2);
}

/// A visible lamp is left out of the numbers, and the page says so; pictures without noise are called so.
#[test]
fn lamps_are_left_out_and_filtered_pictures_say_so() {
    let lab = Lab::new();
    let lamp = "position = [0, 1.5, 0]\nradius = 0.15\nintensity = 1\n";
    lab.write("scene.toml", SCENE.replace("position = [2, 3, 1]\n", lamp));
    let args = ["simplify", "scene.toml", "-o", "out", "--only", "sum", "--json", "--samples"];
    let report = lab.run(&[&args[..], &["16"]].concat()).good().json();
    let left_out = report["left_out"].as_f64().unwrap();
    assert!(left_out > 0.0 && left_out < 0.1, "{left_out}");
    // The lamp's radiance is above 10: with it, the mean of the picture would exceed that of its surfaces, which reflect less than 1.
    assert!(report["truth"]["mean"].as_f64().unwrap() < 0.5, "{}", report["truth"]);
    assert!(report["steps"][0]["to_truth"]["rms"].as_f64().unwrap() < 1.0, "{}", report["steps"][0]);
    let page = String::from_utf8(lab.read("out/index.html")).unwrap();
    assert!(
        page.contains("in which a lamp brighter than white is seen") && page.contains("16 paths per pixel, denoised")
    );
    let layers = exr_layers(&lab.read("out/0-truth.exr"));
    let names: Vec<&str> = layers.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["picture", "denoised"]);
    assert!(layers[0].1 != layers[1].1);
    assert!(lab.read("out/0-truth.png").windows(8).any(|w| w == b"Denoised"));
    // Four paths do not tell noise from light.
    lab.run(&[&args[..], &["4"]].concat()).good();
    assert_eq!(exr_layers(&lab.read("out/0-truth.exr")).len(), 1);
    let page = String::from_utf8(lab.read("out/index.html")).unwrap();
    assert!(page.contains("4 paths per pixel.") && !page.contains("denoised"));
}

/// Nothing is left of a staircase that was interrupted, and the folder of another one stays what it was.
#[test]
fn an_interruption_leaves_no_files() {
    let lab = Lab::new();
    lab.run(&["simplify", "builtin:cube", "--size", "8x8", "--samples", "2", "--only", "time", "-o", "old"]).good();
    let before = lab.read("old/index.html");
    for folder in ["new/deep", "old"] {
        let args = ["simplify", "builtin:cube", "--size", "64x64", "--samples", "100000000", "--verbose", "-o", folder];
        let mut child = lab.command(&args).stderr(Stdio::piped()).spawn().unwrap();
        // The scene has been read: the first pictures are traced, for hours.
        let mut said = BufReader::new(child.stderr.take().unwrap()).lines();
        assert!(said.any(|line| line.unwrap().contains("tracing")), "{:?}", child.wait());
        let sent = Command::new("kill").args(["-s", "INT", &child.id().to_string()]).status().unwrap();
        assert!(sent.success() && !child.wait().unwrap().success());
        assert_eq!(lab.names(), ["old"], "{folder}");
    }
    assert!(lab.read("old/index.html") == before);
    let names = |folder: &str| std::fs::read_dir(lab.path(folder)).unwrap().count();
    // The page, the numbers, two pictures as .png and .exr, two maps.
    assert_eq!(names("old"), 8);
}

#[test]
fn bad_options_are_refused() {
    let lab = Lab::new();
    lab.write("file", "a file");
    for (more, pieces) in [
        (&["-o", "file"][..], &["`file` is a file", "-o"][..]),
        (&["-o", "-"], &["several files"]),
        (&["-o", "out", "--steps", "shadow"], &["shadow", "shadows"]),
        (&["-o", "out", "--only", "time", "--steps", "sum"], &["cannot be used with"]),
        (&["-o", "out", "--samples", "0"], &["invalid number of paths `0`"]),
        (&["-o", "out", "--error", "1", "--time", "1"], &["cannot be used with"]),
        (&["-o", "out", "--points", "0"], &["--points"]),
        (&["-o", "out", "--shutter", "-1"], &["invalid number `-1`"]),
    ] {
        lab.run(&[&["simplify", "builtin:cube", "--size", "16x16"][..], more].concat()).refused(pieces);
        assert_eq!(lab.names(), ["file"], "{more:?}");
    }
    assert_eq!(lab.read("file"), b"a file");
}
