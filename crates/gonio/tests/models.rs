//! Models in every format: they look the same, `gonio inspect` explains them, and `gonio convert` writes them.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Lab, Run, asset};
use std::io::Write;
use std::process::Stdio;

/// The same scene, exported by Blender in three formats. Their materials are two parametrisations of one surface, which agree
/// except in the highlight: OBJ cannot express the 4 % that every glTF surface reflects.
#[test]
fn pictures_of_one_scene_agree_in_every_format() {
    let lab = Lab::new();
    for (model, picture) in
        [("still_life.obj", "obj.png"), ("still_life.glb", "glb.png"), ("gltf/still_life.gltf", "gltf.png")]
    {
        lab.render(&[&asset(model), "-o", picture, "--size", "240x180", "--material", "specular=0"]).good();
    }
    let difference = |a: &str, b: &str| lab.run(&["diff", a, b, "--json"]).good().json();
    let same = difference("glb.png", "gltf.png");
    assert_eq!(same["steps"]["max"], 0.0, "the same numbers, in one file or in three: {same}");
    // Blender writes normals with four decimals to OBJ and as floats to glTF, so a few pixels differ by one step.
    let alike = difference("obj.png", "glb.png");
    assert!(alike["steps"]["max"].as_f64().unwrap() < 1.001, "{alike}");
    assert!(alike["differing_percent"].as_f64().unwrap() < 0.5, "{alike}");
    // The comparison can fail: with highlights the picture differs.
    lab.render(&[&asset("still_life.obj"), "-o", "shiny.png", "--size", "240x180"]).good();
    assert!(difference("obj.png", "shiny.png")["steps"]["max"].as_f64().unwrap() > 20.0);
}

/// PLY and STL have z up and no materials: the shape is the same.
#[test]
fn other_formats_have_the_same_shape() {
    let lab = Lab::new();
    let geometry = |model: &str| lab.run(&["inspect", &asset(model), "--json"]).good().json()["model"].clone();
    let obj = geometry("still_life.obj");
    for (model, format) in [("still_life.ply", "ply"), ("still_life.stl", "stl"), ("still_life.glb", "glb")] {
        let other = geometry(model);
        assert_eq!(other["format"], format);
        assert_eq!(other["geometry"]["triangles"], obj["geometry"]["triangles"], "{model}");
        let area = |report: &serde_json::Value| report["surface"]["area"].as_f64().unwrap();
        assert!((area(&other) / area(&obj) - 1.0).abs() < 1e-5, "{model}");
    }
    // With z up they look like the others with y up.
    lab.render(&[&asset("still_life.stl"), "-o", "z.png", "--up", "+Z", "--size", "120x90"]).good();
    lab.render(&[&asset("still_life.stl"), "-o", "y.png", "--size", "120x90"]).good();
    assert_ne!(lab.read("z.png"), lab.read("y.png"));
}

#[test]
fn inspect_lists_the_contents_of_a_file() {
    let lab = Lab::new();
    let run = lab.run(&["inspect", &asset("still_life.obj")]).good();
    let text = run.text();
    for piece in [
        "Wavefront OBJ",
        "written by          Blender 3.4.1",
        "2,320 v",
        "1 f of 7 corners",
        "triangles           4,618",
        "open; 6 pieces",
        "normals             from the file",
        "still_life.mtl (line 3) found: ",
        "512 x 512, map_Kd of Floor",
        "material Ember",
        "line 19: Ke 2.000000 0.700000 0.100000",
        "Interpreted differently by other programs",
    ] {
        assert!(text.contains(piece), "`{piece}` is not in:\n{text}");
    }
    assert_eq!(run.stderr, "");
    let glb = lab.run(&["inspect", &asset("still_life.glb")]).good();
    for piece in ["binary glTF", "pbrMetallicRoughness.roughnessFactor", "KHR_materials_transmission"] {
        assert!(glb.text().contains(piece), "`{piece}` is not in:\n{}", glb.text());
    }
}

#[test]
fn inspect_explains_a_line() {
    let lab = Lab::new();
    lab.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf -3 -2 -1\n");
    lab.write("a.mtl", "newmtl red\nKd 1 0 0\n");
    let face = lab.run(&["inspect", "a.obj", "--line", "6"]).good();
    for piece in ["f -3 -2 -1", "vertex 1 (line 2)", "material", "red", "line 5"] {
        assert!(face.text().contains(piece), "`{piece}` is not in:\n{}", face.text());
    }
    let json = lab.run(&["inspect", "a.obj", "--line", "2", "--json"]).good().json();
    assert_eq!(json["line"]["value"]["kind"], "vertex");
    assert_eq!(json["line"]["value"]["number"], 1);
    assert!(lab.run(&["inspect", "a.mtl", "--line", "2"]).good().text().contains("diffuse"));
    lab.run(&["inspect", "a.obj", "--line", "70"]).refused(&["a.obj", "70"]);
    lab.run(&["inspect", &asset("still_life.stl"), "--line", "1"]).refused(&["STL"]);
    lab.run(&["inspect", "none.obj"]).refused(&["none.obj", "no such file"]);
}

#[test]
fn a_model_may_come_from_standard_input() {
    let lab = Lab::new();
    let piped = |args: &[&str], bytes: &[u8]| {
        let mut child =
            lab.command(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        Run::of(child.wait_with_output().unwrap())
    };
    let render = ["render", "-", "-o", "in.png", "--size", "48x32", "--samples", "1", "--backend", "cpu", "--quiet"];
    piped(&render, &std::fs::read(asset("suzanne.obj")).unwrap()).good();
    lab.render(&[&asset("suzanne.obj"), "-o", "file.png"]).good();
    // Its material library is elsewhere, so it has the default material here.
    assert_eq!(lab.picture("in.png").width(), lab.picture("file.png").width());
    let report = piped(&["inspect", "-", "--json"], b"solid a\nendsolid a\n");
    assert_eq!(report.code, 2, "an STL without a triangle: {}", report.stderr);
    piped(&["inspect", "-"], b"").refused(&["-: ", "empty"]);
}

#[test]
fn limits_can_be_set_by_options() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    lab.render(&[&model, "-o", "a.png", "--max-triangles", "1000"]).refused(&["1000", "limit"]);
    lab.run(&["inspect", &model, "--max-triangles", "1000"]).refused(&["1000", "limit"]);
    lab.run(&["inspect", &model, "--max-memory", "much"]).refused(&["invalid size"]);
    assert_eq!(lab.names(), [""; 0], "nothing is left behind");
}

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n";

fn textured_triangle() -> Lab {
    let lab = Lab::new();
    lab.write("m.obj", OBJ);
    lab.write("m.mtl", "newmtl red\nmap_Kd pictures/dot.png\n");
    std::fs::create_dir(lab.path("pictures")).unwrap();
    std::fs::create_dir(lab.path("there")).unwrap();
    image::RgbImage::from_pixel(2, 2, image::Rgb([255, 0, 0])).save(lab.path("pictures/dot.png")).unwrap();
    lab
}

/// One face in every format, and back.
#[test]
fn a_triangle_survives_every_format() {
    let lab = textured_triangle();
    for (from, to) in [("m.obj", "a.ply"), ("a.ply", "b.glb"), ("b.glb", "c.obj"), ("c.obj", "d.ply")] {
        let run = lab.run(&["convert", from, to, "--json"]).good();
        let json = run.json();
        assert_eq!((json["triangles"].as_u64(), json["vertices"].as_u64()), (Some(1), Some(3)), "{to}");
        assert_eq!(json["outputs"][0], to);
    }
    let json = lab.run(&["convert", "c.obj", "e.obj", "--json"]).good().json();
    assert_eq!(json["format"], "obj");
    let faces = String::from_utf8(lab.read("e.obj")).unwrap();
    assert!(faces.contains("mtllib e.mtl\n") && faces.ends_with("\nf 1/1 2/2 3/3\n"), "{faces}");
    assert!(!lab.names().iter().any(|name| name.starts_with(".gonio")), "{:?}", lab.names());
}

/// Textures beside the old file are named relative to the new one.
#[test]
fn textures_are_named_relative_to_the_new_folder() {
    let lab = textured_triangle();
    lab.run(&["convert", "m.obj", "there/n.obj"]).good();
    let mtl = String::from_utf8(lab.read("there/n.mtl")).unwrap();
    assert!(mtl.contains("\nmap_Kd ../pictures/dot.png\n"), "{mtl}");
    assert!(!lab.path("there/dot.png").exists());
    let run = lab.run(&["convert", "there/n.obj", "n.ply", "--ascii"]).good();
    assert!(!run.stderr.contains("not found"), "{}", run.stderr);
    let ply = String::from_utf8(lab.read("n.ply")).unwrap();
    assert!(ply.starts_with("ply\nformat ascii 1.0\n"), "{ply}");
    // The picture is the same by either name.
    let texture = ply.lines().find_map(|line| line.strip_prefix("comment TextureFile ")).unwrap();
    assert!(lab.path(texture).is_file(), "{texture}");
}

/// A picture inside a model becomes a file beside it, with the same bytes.
#[test]
fn embedded_pictures_are_written_beside_the_model() {
    let lab = textured_triangle();
    lab.run(&["convert", "m.obj", "b.glb"]).good();
    let json = lab.run(&["convert", "b.glb", "there/c.obj", "--json"]).good().json();
    let outputs: Vec<&str> = json["outputs"].as_array().unwrap().iter().map(|o| o.as_str().unwrap()).collect();
    assert_eq!(outputs.len(), 3, "{outputs:?}");
    assert_eq!(&outputs[..2], ["there/c.obj", "there/c.mtl"]);
    assert_eq!(lab.read(outputs[2]), lab.read("pictures/dot.png"));
    let name = outputs[2].strip_prefix("there/").unwrap();
    let mtl = String::from_utf8(lab.read("there/c.mtl")).unwrap();
    assert!(mtl.contains(&format!("map_Kd {name}\n")), "{mtl}");
    // Built-in models contain their textures too.
    lab.run(&["convert", "builtin:still-life", "still.obj"]).good();
    let pictures: Vec<String> = lab.names().into_iter().filter(|name| name.starts_with("still_")).collect();
    assert_eq!(pictures, ["still_checker.png", "still_planks.png"]);
}

#[test]
fn missing_and_lost_data_is_reported() {
    let lab = textured_triangle();
    std::fs::remove_file(lab.path("pictures/dot.png")).unwrap();
    let run = lab.run(&["convert", "m.obj", "a.obj"]).good();
    assert!(run.stderr.contains("m.mtl:2: the texture \"pictures/dot.png\" was not found; tried"), "{}", run.stderr);
    assert!(String::from_utf8(lab.read("a.mtl")).unwrap().contains("map_Kd pictures/dot.png\n"));
    let run = lab.run(&["convert", &asset("suzanne.obj"), "s.ply"]).good();
    assert!(run.stderr.contains("PLY has no more"), "{}", run.stderr);
    assert!(lab.run(&["convert", &asset("suzanne.obj"), "s.ply", "--quiet"]).good().stderr.is_empty());
}

#[test]
fn bad_options_are_rejected() {
    let lab = textured_triangle();
    lab.run(&["convert", "m.obj", "a.stl"]).refused(&["`a.stl` cannot be written", ".obj, .ply or .glb"]);
    lab.run(&["convert", "m.obj", "a"]).refused(&["`a` cannot be written"]);
    lab.run(&["convert", "m.obj", "a.obj", "--ascii"]).refused(&["--ascii applies to .ply only"]);
    lab.run(&["convert", "m.obj", "no/a.obj"]).refused(&["there is no folder `no`"]);
    lab.run(&["convert", "no.obj", "a.obj"]).refused(&["no.obj"]);
    lab.run(&["convert", "m.obj", "a.obj", "--max-triangles", "0"]).refused(&["more than 0 triangles"]);
    assert_eq!(lab.names(), ["m.mtl", "m.obj", "pictures", "there"]);
}
