//! `gonio frame`: passes, draws, programs and textures of a frame, for people and for machines.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};

const SIZE: [&str; 4] = ["--size", "64x48", "--samples", "4"];

#[test]
fn a_frame_in_tables() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    let run = lab.run(&[&["frame", &model], &SIZE[..]].concat()).good();
    for words in [
        "findings\n  none",
        "0  scene   into `",
        "1  output  into `encoded picture`   64 x 48  RGBA8",
        "colour cleared to 0 0 0 0, depth to 1",
        "Floor]                0     2 triangles         4",
        "diffuse_map",
        "planks.png",
        "SRGB8_ALPHA8",
        "linear mipmap linear, repeat",
        "scene phong blinn_phong",
    ] {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    // Nothing wider than a terminal of a lecture hall, and no space at a line's end.
    for line in run.text().lines() {
        assert!(line.chars().count() <= 190 && line.trim_end() == line, "{line}");
    }
}

#[test]
fn a_draw_and_a_program_by_number() {
    let lab = Lab::new();
    let model = asset("cube.obj");
    let run = lab.run(&[&["frame", &model, "--draw", "0", "--shading", "gouraud"], &SIZE[..]].concat()).good();
    for words in
        ["draw 0: ", "12 triangles: 36 indices from 0", "mat4 clip_from_model", "3 x float from `", "k_diffuse"]
    {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    let run = lab.run(&[&["frame", &model, "--program", "0", "--shading", "gouraud"], &SIZE[..]].concat()).good();
    for words in ["program 0: scene gouraud", "world_from_model", "#version 330 core", "void main()"] {
        assert!(run.text().contains(words), "`{words}` is not in\n{}", run.text());
    }
    lab.run(&["frame", &model, "--draw", "9"]).refused(&["there is no draw 9; the frame has 2, numbers 0 to 1"]);
    lab.run(&["frame", &model, "--program", "7"]).refused(&["there is no program 7"]);
}

#[test]
fn everything_as_json() {
    let lab = Lab::new();
    let run = lab.run(&[&["frame", &asset("still_life.obj"), "--json"], &SIZE[..]].concat()).good();
    let json = run.json();
    assert_eq!((&json["command"], &json["findings"]), (&"frame".into(), &serde_json::json!([])));
    let frame = &json["frame"];
    let draws = frame["draws"].as_array().unwrap();
    assert!(draws.len() > 2);
    assert_eq!(frame["passes"][0]["target"]["format"], "RGBA16F");
    // Sampler, unit, texture, all the way.
    let samplers = draws.iter().flat_map(|draw| draw["samplers"].as_array().unwrap());
    let read = samplers.filter(|s| s["name"] == "diffuse_map").map(|s| (&s["unit"], &s["texture"])).collect::<Vec<_>>();
    assert!(!read.is_empty());
    let textures = frame["textures"].as_array().unwrap();
    for (unit, id) in read {
        assert_eq!(unit, 0);
        let texture = textures.iter().find(|texture| texture["id"] == *id).unwrap();
        assert_eq!(texture["kind"], "2D");
    }
    assert!(draws.iter().all(|draw| draw["fragments_shaded"].as_u64().is_some()));
    let matrix = draws[0]["uniforms"].as_array().unwrap().iter().find(|u| u["name"] == "clip_from_model").unwrap();
    assert_eq!(matrix["value"].as_array().unwrap().len(), 16);
    let program = &frame["programs"][draws[0]["program"].as_u64().unwrap() as usize];
    assert!(program["vertex_source"].as_str().unwrap().starts_with("#version"));
}

#[test]
fn a_debug_view_has_another_program() {
    let lab = Lab::new();
    let run = lab.run(&[&["frame", &asset("cube.obj"), "--debug", "normal"], &SIZE[..]].concat()).good();
    assert!(run.text().contains(" view"), "{}", run.text());
    lab.run(&["frame", &asset("cube.obj"), "--debug", "light:9"]).refused(&["there is no light 9"]);
}

#[test]
fn without_opengl_it_says_what_to_install() {
    let lab = Lab::new();
    let run = lab.run(&["frame", &asset("cube.obj"), "--egl-library", "libnothing.so.1"]);
    let run = run.refused(&["no OpenGL", "libnothing.so.1", "apt-get install"]);
    assert!(!run.stderr.contains("--backend"), "{}", run.stderr);
}
