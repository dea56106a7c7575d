//! `gonio unwrap` and `gonio bake`: their files, and bad input.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};
use gonio_image::decode::DecodedContent;

#[test]
fn unwrapped_models_are_read_again_with_the_same_figures() {
    let lab = Lab::new();
    let model = asset("suzanne.obj");
    let before = std::fs::read(&model).unwrap();
    let args = ["unwrap", &model, "-o", "a.obj", "--layout", "layout.png", "--size", "512", "--json"];
    let made = lab.run(&args).good().json();
    lab.run(&["unwrap", &model, "--checker", "checker.png"]).good();
    assert_eq!((lab.picture("checker.png").width(), lab.picture("checker.png").height()), (1024, 768));
    assert_eq!((lab.picture("layout.png").width(), lab.picture("layout.png").height()), (512, 512));
    assert_eq!(made["uv"]["overlapping_texels"], 0);
    lab.run(&["unwrap", "a.obj", "-o", "b.glb", "--keep-uvs"]).good();
    for file in ["a.obj", "b.glb"] {
        let kept = lab.run(&["unwrap", file, "--keep-uvs", "--size", "512", "--json"]).good().json();
        for key in ["charts", "triangles", "overlapping_texels"] {
            assert_eq!(kept["uv"][key], made["uv"][key], "{file}: {key}");
        }
        let difference = kept["uv"]["coverage"].as_f64().unwrap() - made["uv"]["coverage"].as_f64().unwrap();
        assert!(difference.abs() < 1e-6, "{file}: {difference}");
    }
    assert_eq!(std::fs::read(&model).unwrap(), before);
}

#[test]
fn a_baked_folder_is_complete_and_refers_to_itself() {
    let lab = Lab::new();
    let what = "diffuse,specular,normal,ambient-occlusion,light,position,emitted,id";
    let model = asset("still_life.obj");
    lab.run(&["bake", &model, "-o", "out", "--what", what, "--size", "64", "--occlusion-rays", "4"]).good();
    let mut names: Vec<String> = std::fs::read_dir(lab.path("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let expected = [
        "still_life.glb",
        "still_life.mtl",
        "still_life.obj",
        "still_life_ambient-occlusion.png",
        "still_life_diffuse.png",
        "still_life_emitted.png",
        "still_life_id.png",
        "still_life_layout.png",
        "still_life_light.exr",
        "still_life_normal.png",
        "still_life_position.exr",
        "still_life_specular.png",
    ];
    assert_eq!(names, expected);
    let library = String::from_utf8(lab.read("out/still_life.mtl")).unwrap();
    for line in library.lines().filter(|line| line.starts_with("map_") || line.starts_with("norm ")) {
        assert!(names.contains(&line.rsplit(' ').next().unwrap().to_owned()), "{line}");
    }
    // The ember emits 2, 0.7, 0.1: more than a PNG can hold, so the material has the factor.
    assert!(library.contains("\nKe 2 2 2\n"), "{library}");
    for map in ["light", "position"] {
        let bytes = lab.read(&format!("out/still_life_{map}.exr"));
        let decoded = gonio_image::decode::decode(map, &bytes, &gonio_image::DecodeLimits::default()).unwrap();
        assert!(
            matches!(&decoded.shape, DecodedContent::Picture(image) if (image.width, image.height) == (64, 64)),
            "{map}"
        );
    }
    for file in ["out/still_life.obj", "out/still_life.glb"] {
        lab.render(&[file, "-o", "picture.png"]).good();
    }
}

#[test]
fn bad_input_is_one_sentence_and_no_file() {
    let lab = Lab::new();
    lab.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    lab.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    lab.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let before = lab.names();
    let refused = |args: &[&str], pieces: &[&str]| {
        lab.run(args).refused(pieces);
        assert_eq!(lab.names(), before, "{args:?}");
    };
    refused(&["unwrap", "line.obj", "-o", "x.obj"], &["line.obj", "no triangle with an area"]);
    refused(&["bake", "line.obj", "-o", "x"], &["line.obj", "no triangle with an area"]);
    refused(&["unwrap", "bare.obj", "--keep-uvs"], &["bare.obj", "no texture coordinates"]);
    refused(&["bake", "bare.obj", "-o", "x", "--repack"], &["no texture coordinates"]);
    refused(&["unwrap", "bare.obj", "-o", "x.stl"], &["x.stl", ".obj, .ply or .glb"]);
    for size in ["0", "100000", "-1", "1024x768", "99999999999999999999"] {
        let option = format!("--size={size}");
        refused(&["bake", "bare.obj", "-o", "x", &option], &[size, "1 to 16384"]);
        refused(&["unwrap", "bare.obj", &option], &[size, "1 to 16384"]);
    }
    refused(&["bake", "bare.obj", "-o", "x", "--samples", "3"], &["3", "square number"]);
    refused(&["unwrap", "bare.obj", "--size", "8", "--margin-texels", "3"], &["3 texels", "at most 2"]);
    refused(&["unwrap", "bare.obj", "--margin", "0.5"], &["0.5", "0 to 0.25"]);
    refused(&["bake", "bare.obj", "-o", "bare.obj"], &["bare.obj", "is a file"]);
    refused(&["bake", "bare.obj", "-o", "."], &["would replace the model"]);
    refused(&["bake", "bare.obj", "-o", "x", "--from", "missing.obj"], &["missing.obj"]);
    // One pixel, and a number that is not one, are possible.
    lab.run(&["bake", "nan.obj", "-o", "one", "--size", "1"]).refused(&["nan.obj"]);
    lab.run(&["bake", "bare.obj", "-o", "one", "--size", "1"]).good();
}
