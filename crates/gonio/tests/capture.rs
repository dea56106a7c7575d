//! `gonio render --capture`: RenderDoc itself opens the capture, and the tests compare its content with the scene. They need
//! RenderDoc with its Python module, and an X server for its replay; without them they fail with a message.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, missing_docs)]

mod common;
#[path = "common/renderdoc.rs"]
mod renderdoc;

use common::{Lab, Run, asset};
use glam::{DMat4, DVec3};
use gonio_render::glsl;
use gonio_scene::files::Disk;
use gonio_scene::{Frame, Scene, load};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// The content of a capture according to RenderDoc.
struct Capture {
    facts: Value,
}

impl Capture {
    #[track_caller]
    fn open(lab: &Lab, name: &str) -> Capture {
        Capture { facts: renderdoc::read(&lab.path(name)) }
    }

    fn draws(&self) -> Vec<Draw<'_>> {
        self.facts["draws"].as_array().unwrap().iter().map(Draw).collect()
    }

    /// The one texture of this label.
    #[track_caller]
    fn texture(&self, label: &str) -> &Value {
        let textures = self.facts["textures"].as_array().unwrap();
        let found: Vec<&Value> = textures.iter().filter(|t| t["label"] == label).collect();
        assert_eq!(found.len(), 1, "`{label}` in {textures:?}");
        found[0]
    }
}

#[derive(Clone, Copy)]
struct Draw<'a>(&'a Value);

impl Draw<'_> {
    fn groups(&self) -> Vec<&str> {
        self.0["groups"].as_array().unwrap().iter().map(|g| g.as_str().unwrap()).collect()
    }

    /// `[Wood]` at the end of the innermost group.
    fn material(&self) -> &str {
        let groups = self.groups();
        let end = groups.last().unwrap().rsplit_once('[').unwrap().1;
        end.strip_suffix(']').unwrap()
    }

    #[track_caller]
    fn uniform(&self, name: &str) -> Vec<f64> {
        let values = self.0["uniforms"][name].as_array();
        let values = values.unwrap_or_else(|| panic!("no uniform `{name}` in {}", self.0["uniforms"]));
        values.iter().map(|v| v.as_f64().unwrap()).collect()
    }

    /// 1e-5 of the largest: values are f32 on the GPU, and RenderDoc returns them unchanged.
    #[track_caller]
    fn check_uniform(&self, name: &str, expected: &[f64]) {
        let actual = self.uniform(name);
        assert_eq!(actual.len(), expected.len(), "{name}: {actual:?}");
        let largest = expected.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        for (a, e) in actual.iter().zip(expected) {
            assert!((a - e).abs() <= 1e-5 * largest, "{name}: {actual:?}, not {expected:?}");
        }
    }

    /// The sampler reads this texture from this unit.
    #[track_caller]
    fn check_sampler(&self, name: &str, unit: u32, texture: &str) {
        let sampler = &self.0["samplers"][name];
        assert_eq!((&sampler["unit"], &sampler["texture"]), (&unit.into(), &texture.into()), "{name}: {sampler}");
    }
}

fn scene(input: &str) -> Scene {
    load::load(load::describe(&[input], &Disk).unwrap(), Path::new(""), &Disk).unwrap()
}

fn row_by_row(m: DMat4) -> Vec<f64> {
    m.transpose().to_cols_array().to_vec()
}

fn lights_of_the_sum(frame: &Frame) -> impl Iterator<Item = DVec3> {
    let in_sum = |l: &&gonio_light::Light| l.kind != gonio_light::LightKind::Ambient;
    frame.lights.iter().filter(in_sum).map(|l| l.color)
}

#[test]
fn renderdoc_finds_the_draws_the_textures_and_the_uniforms() {
    let lab = Lab::new();
    let input = "builtin:still-life";
    let args = ["render", input, "--backend", "gl"];
    lab.run(&[&args[..], &["-o", "plain.png"]].concat()).good();
    let with_capture = ["-o", "picture.png", "--capture", "the frame.rdc", "--json"];
    let run = lab.run(&[&args[..], &with_capture].concat()).good();
    assert_eq!(run.stderr, "");
    // The picture is the same, the capture has its name, and no other files are left.
    assert_eq!(lab.names(), ["picture.png", "plain.png", "the frame.rdc"]);
    assert!(lab.read("picture.png") == lab.read("plain.png"), "the capture changes the picture");
    let report = run.json();
    let size = [&report["width"], &report["height"]].map(|v| v.as_u64().unwrap());

    let capture = Capture::open(&lab, "the frame.rdc");
    assert_eq!(capture.facts["driver"], "OpenGL");
    let loaded = scene(input);
    let frame = loaded.frame(0.0);

    // The draws that gonio counted, each in a group with the names of its object, part and material, and then the
    // one that encodes the picture.
    let draws = capture.draws();
    let (output, drawn) = draws.split_last().unwrap();
    assert_eq!(drawn.len() as u64, report["drawn"]["draw_calls"].as_u64().unwrap());
    let indices: u64 = drawn.iter().map(|d| d.0["indices"].as_u64().unwrap()).sum();
    assert_eq!(indices, 3 * report["scene"]["triangles"].as_u64().unwrap());
    let model = std::fs::read_to_string(asset("still_life.obj")).unwrap();
    let parts = |keyword: &str| -> BTreeSet<String> {
        model.lines().filter_map(|l| l.strip_prefix(keyword)).map(|n| n.trim().to_owned()).collect()
    };
    let expected: BTreeSet<(String, String)> = parts("g ")
        .into_iter()
        .map(|part| {
            let material = part.rsplit_once('_').unwrap().1.to_owned();
            (format!("still_life {part} [{material}]"), material)
        })
        .collect();
    let found: BTreeSet<(String, String)> =
        drawn.iter().map(|d| (d.groups()[1].to_owned(), d.material().to_owned())).collect();
    assert_eq!(found, expected);
    assert_eq!(parts("usemtl "), drawn.iter().map(|d| d.material().to_owned()).collect());
    assert!(drawn.iter().all(|d| d.groups()[0] == "scene" && d.0["vertex_array"] == "still_life"));
    assert!(drawn.iter().all(|d| d.0["program"].as_str().unwrap().starts_with("scene phong blinn_phong")));
    // The picture is captured, not a debug view.
    assert!(drawn.iter().all(|d| d.0["uniforms"]["view_quantity"].is_null()));
    assert_eq!(output.groups(), ["output"]);
    assert_eq!(output.0["indices"], 3);

    // The uniforms of every draw.
    let aspect = size[0] as f64 / size[1] as f64;
    let clip_from_world = frame.camera.clip_from_view(aspect) * frame.camera.view_from_world();
    for draw in drawn {
        draw.check_uniform("eye_in_world", &frame.camera.position.to_array());
        draw.check_uniform("clip_from_model", &row_by_row(clip_from_world * loaded.objects[0].world_from_model));
        let material = loaded.materials.iter().find(|m| m.material.name == draw.material()).unwrap();
        let three = |v: [f32; 3]| v.map(f64::from);
        draw.check_uniform("k_diffuse", &three(material.material.diffuse));
        draw.check_uniform("k_specular", &three(material.material.specular));
        draw.check_uniform("shininess", &[material.material.shininess.into()]);
        draw.check_uniform("ambient_light", &gonio_light::light::ambient_color(&frame.lights).to_array());
        let texels: Vec<f64> = draw.uniform("light_values");
        for color in lights_of_the_sum(&frame) {
            // 1e-6: colours of lights are of the order of 1, as f32.
            let is_color = |t: &[f64]| (DVec3::new(t[0], t[1], t[2]) - color).length() < 1e-6;
            assert!(texels.chunks(4).any(is_color), "{color} is not in {texels:?}");
        }
    }
    // The camera is the one that `gonio scene` prints.
    let printed = lab.run(&["scene", input, "--json"]).good().json();
    let position: Vec<f64> = serde_json::from_value(printed["scene"]["camera"]["position"].clone()).unwrap();
    drawn[0].check_uniform("eye_in_world", &position);

    // The textures by label, at their size, with their mipmaps.
    for name in ["checker", "planks"] {
        let file = image::open(asset(&format!("textures/{name}.png"))).unwrap();
        let texture = capture.texture(&format!("builtin:models/textures/{name}.png"));
        assert_eq!([&texture["width"], &texture["height"]], [file.width(), file.height()]);
        assert_eq!(texture["mips"], u32::BITS - file.width().max(file.height()).leading_zeros());
    }
    for label in ["samples", "depth", "encoded picture"] {
        let texture = capture.texture(label);
        assert_eq!([&texture["width"], &texture["height"]], size);
        assert_eq!(texture["samples"], if label == "encoded picture" { 1 } else { frame.samples }, "{label}");
    }
    let buffers: Vec<&str> = capture.facts["buffers"].as_array().unwrap().iter().map(|b| b.as_str().unwrap()).collect();
    assert!(buffers.contains(&"still_life: position") && buffers.contains(&"still_life: indices"), "{buffers:?}");

    // The samplers.
    for draw in drawn {
        match draw.material() {
            "Floor" => draw.check_sampler("diffuse_map", 0, "builtin:models/textures/checker.png"),
            "Wood" => draw.check_sampler("diffuse_map", 0, "builtin:models/textures/planks.png"),
            _ => assert_eq!(draw.0["samplers"], serde_json::json!({}), "{:?}", draw.groups()),
        }
        assert_eq!(draw.0["target"], "samples");
    }
    output.check_sampler("linear_picture", 0, "samples");
    assert_eq!(output.0["target"], "encoded picture");
}

#[test]
fn every_map_and_the_table_of_lights_have_their_own_units() {
    let lab = Lab::new();
    let maps = [("Kd", "checker"), ("Ks", "planks"), ("norm", "tiles")];
    let mut library = "newmtl mapped\nKd 1 1 1\nKs 1 1 1\nNs 20\n".to_owned();
    for (keyword, name) in maps {
        let keyword = if keyword == "norm" { keyword.to_owned() } else { format!("map_{keyword}") };
        library.push_str(&format!("{keyword} {name}.png\n"));
        lab.write(&format!("{name}.png"), std::fs::read(asset(&format!("textures/{name}.png"))).unwrap());
    }
    lab.write("quad.mtl", library);
    lab.write(
        "quad.obj",
        "mtllib quad.mtl\no quad\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
         usemtl mapped\nf 1/1 2/2 3/3 4/4\n",
    );
    let lights: Vec<String> =
        (0..=glsl::LIGHTS_IN_UNIFORMS).map(|i| format!("point position={i},1,2 color=0.05")).collect();
    let mut args =
        vec!["render", "quad.obj", "--backend", "gl", "--size", "64x48", "-o", "a.png", "--capture", "a.rdc"];
    args.extend(lights.iter().flat_map(|l| ["--light", l.as_str()]));
    lab.run(&args).good();

    let capture = Capture::open(&lab, "a.rdc");
    let draws = capture.draws();
    assert_eq!(draws.len(), 2);
    assert_eq!(draws[0].material(), "mapped");
    let samplers = [
        ("diffuse_map", "checker.png"),
        ("specular_map", "planks.png"),
        ("normal_map", "tiles.png"),
        ("light_table", "lights"),
    ];
    for (sampler, texture) in samplers {
        draws[0].check_sampler(sampler, glsl::texture_unit(sampler), texture);
    }
    let table = capture.texture("lights");
    assert_eq!(table["width"].as_u64().unwrap(), (lights.len() * glsl::LIGHT_TEXELS) as u64);
    // Each sampler has its own unit.
    let units: BTreeSet<u64> =
        draws[0].0["samplers"].as_object().unwrap().values().map(|s| s["unit"].as_u64().unwrap()).collect();
    assert_eq!(units.len(), draws[0].0["samplers"].as_object().unwrap().len());
}

#[test]
fn a_capture_that_cannot_be_made_is_one_sentence_and_leaves_nothing() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let args = ["render", &cube, "-o", "a.png", "--size", "48x32", "--capture"];
    let with = |more: &[&str]| lab.run(&[&args[..], more].concat());
    with(&["nowhere/a.rdc"]).refused(&["nowhere/a.rdc", "there is no folder `nowhere`"]);
    with(&["a.txt"]).refused(&["a.txt", ".rdc"]);
    with(&["a.rdc", "--backend", "cpu"]).refused(&["--capture", "--backend cpu"]);
    with(&["a.rdc", "--egl-library", "libNoSuchEGL.so.1"]).refused(&["libNoSuchEGL.so.1", "libegl1"]);
    assert!(lab.names().is_empty(), "{:?}", lab.names());

    // A system without RenderDoc: the dynamic linker searches here first, and finds a file that is not a library.
    lab.write("librenderdoc.so", "not there");
    let path = lab.path("");
    let run = Run::of(lab.command(&args).arg("a.rdc").env("LD_LIBRARY_PATH", path).output().unwrap());
    let run = run.refused(&["RenderDoc", "librenderdoc.so", "apt-get install librenderdoc"]);
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert_eq!(lab.names(), ["librenderdoc.so"]);
}

#[test]
fn a_capture_keeps_exit_code_and_stdout() {
    let lab = Lab::new();
    let args = ["render", "builtin:cube", "-q", "--backend", "gl", "--size", "48x32", "-o", "-"];
    let plain = lab.run(&args).good();
    let run = lab.run(&[&args[..], &["--capture", "a.rdc"]].concat()).good();
    assert!(run.stdout == plain.stdout && run.stderr.is_empty(), "{}", run.stderr);
    assert!(lab.read("a.rdc").starts_with(b"RDOC"));
    lab.run(&["render", "nothing.obj", "-o", "-", "--capture", "b.rdc"]).refused(&["nothing.obj", "no such file"]);
    assert_eq!(lab.names(), ["a.rdc"]);
    // A second run replaces the first capture.
    lab.write("a.rdc", "old");
    lab.run(&[&args[..], &["--capture", "a.rdc"]].concat()).good();
    assert!(lab.read("a.rdc").starts_with(b"RDOC"));
    assert_eq!(lab.names(), ["a.rdc"]);
}

#[test]
fn the_black_triangle_is_found_in_a_capture() {
    let lab = Lab::new();
    let folder = lab.path("mine").to_string_lossy().into_owned();
    lab.run(&["lab", "start", "ex11", &folder]).good();
    let unit = |program: &str, name: &str| {
        lab.run(&["lab", "draw", "ex11", &format!("{folder}/host/{program}.txt"), "--capture", name]).good();
        let capture = Capture::open(&lab, name);
        let draws = capture.draws();
        let draw = *draws.iter().find(|draw| !draw.0["samplers"]["ourTexture"].is_null()).unwrap();
        let sampler = &draw.0["samplers"]["ourTexture"];
        (sampler["unit"].as_u64().unwrap(), sampler["texture"].clone())
    };
    // The lab's mistake: the texture's name instead of its unit, at which no texture is bound.
    assert_eq!(unit("texture-name-as-unit", "name.rdc").0, 1);
    // Correct in this respect, but wrong in another.
    let (right, texture) = unit("stride-wrong", "stride.rdc");
    assert_eq!((right, texture.is_null()), (0, false));
}
