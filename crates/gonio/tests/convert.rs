//! `gonio convert`: the files it writes, the names in them, and the errors.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, asset};

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n";

fn lab() -> Lab {
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
fn a_triangle_goes_round() {
    let lab = lab();
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
fn textures_are_named_from_the_new_folder() {
    let lab = lab();
    lab.run(&["convert", "m.obj", "there/n.obj"]).good();
    let mtl = String::from_utf8(lab.read("there/n.mtl")).unwrap();
    assert!(mtl.contains("\nmap_Kd ../pictures/dot.png\n"), "{mtl}");
    assert!(!lab.path("there/dot.png").exists());
    let run = lab.run(&["convert", "there/n.obj", "n.ply", "--ascii"]).good();
    assert!(!run.stderr.contains("not found"), "{}", run.stderr);
    let ply = String::from_utf8(lab.read("n.ply")).unwrap();
    assert!(ply.starts_with("ply\nformat ascii 1.0\n"), "{ply}");
    // The same picture, whichever way it is named.
    let texture = ply.lines().find_map(|line| line.strip_prefix("comment TextureFile ")).unwrap();
    assert!(lab.path(texture).is_file(), "{texture}");
}

/// A picture inside a model becomes a file beside it, with the same bytes.
#[test]
fn pictures_inside_are_written_beside() {
    let lab = lab();
    lab.run(&["convert", "m.obj", "b.glb"]).good();
    let json = lab.run(&["convert", "b.glb", "there/c.obj", "--json"]).good().json();
    let outputs: Vec<&str> = json["outputs"].as_array().unwrap().iter().map(|o| o.as_str().unwrap()).collect();
    assert_eq!(outputs.len(), 3, "{outputs:?}");
    assert_eq!(&outputs[..2], ["there/c.obj", "there/c.mtl"]);
    assert_eq!(lab.read(outputs[2]), lab.read("pictures/dot.png"));
    let name = outputs[2].strip_prefix("there/").unwrap();
    let mtl = String::from_utf8(lab.read("there/c.mtl")).unwrap();
    assert!(mtl.contains(&format!("map_Kd {name}\n")), "{mtl}");
    // Built-in models carry theirs with them too.
    lab.run(&["convert", "builtin:still-life", "still.obj"]).good();
    let pictures: Vec<String> = lab.names().into_iter().filter(|name| name.starts_with("still_")).collect();
    assert_eq!(pictures, ["still_checker.png", "still_planks.png"]);
}

#[test]
fn what_is_missing_or_lost_is_said() {
    let lab = lab();
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
    let lab = lab();
    lab.run(&["convert", "m.obj", "a.stl"]).refused(&["`a.stl` cannot be written", ".obj, .ply or .glb"]);
    lab.run(&["convert", "m.obj", "a"]).refused(&["`a` cannot be written"]);
    lab.run(&["convert", "m.obj", "a.obj", "--ascii"]).refused(&["--ascii applies to .ply only"]);
    lab.run(&["convert", "m.obj", "no/a.obj"]).refused(&["there is no folder `no`"]);
    lab.run(&["convert", "no.obj", "a.obj"]).refused(&["no.obj"]);
    lab.run(&["convert", "m.obj", "a.obj", "--max-triangles", "0"]).refused(&["more than 0 triangles"]);
    assert_eq!(lab.names(), ["m.mtl", "m.obj", "pictures", "there"]);
}
