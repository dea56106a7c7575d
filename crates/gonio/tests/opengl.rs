//! `--backend` draws by OpenGL, or by the CPU in its place with a note about the reason; `gonio frame` lists OpenGL's calls. Needs the
//! OpenGL that the README names; Mesa's llvmpipe is enough.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset};

#[test]
fn opengl_and_the_cpu_draw_the_same_picture() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    for (backend, name) in [("gl", "gl.png"), ("cpu", "cpu.png"), ("auto", "auto.png")] {
        // Linear filtering is defined exactly; the footprints of mipmaps are not.
        let filter = ["--texture-filter", "linear"];
        let args = ["render", &model, "-o", name, "--size", "160x120", "--samples", "1", "--backend", backend];
        let run = lab.run(&[&args[..], &filter[..]].concat());
        let stderr = run.good().stderr;
        assert_eq!(stderr.contains("note: drawn by OpenGL ("), backend == "auto", "{backend}: {stderr}");
    }
    assert_eq!(lab.read("gl.png"), lab.read("auto.png"));
    // The project's tolerance: 0.5 % of the pixels by more than one step, edges included.
    lab.run(&["diff", "gl.png", "cpu.png", "--tolerance", "1", "--max-differing", "0.5"]).good();
    let json =
        lab.run(&["render", &model, "-o", "gl.png", "--size", "64x48", "--backend", "gl", "--json"]).good().json();
    assert_eq!(json["backend"]["name"], "gl");
    assert!(json["backend"]["renderer"].is_string() && json["drawn"]["draw_calls"].as_u64() > Some(0), "{json}");
}

#[test]
fn a_probe_compares_opengl_with_the_reference() {
    let lab = Lab::new();
    let args = ["probe", &asset("suzanne.obj"), "--at", "500,400", "--backend", "gl", "--json"];
    let json = lab.run(&args).good().json();
    // 1e-3: the project's tolerance for linear values.
    assert!(json["gpu"]["difference"].as_f64().unwrap() < 1e-3, "{}", json["gpu"]);
}

#[test]
fn opengl_and_the_cpu_draw_the_same_views() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for (backend, name) in [("gl", "gl.exr"), ("cpu", "cpu.exr")] {
        let common = ["--size", "64x48", "--samples", "1", "--backend", backend, "--views", "N,cos-theta,diffuse"];
        lab.run(&[&["render", &cube, "-o", name], &common[..]].concat()).good();
    }
    for layer in ["picture", "normal", "cos-theta", "diffuse"] {
        // Edges may round to either side: 1 % of the pixels of a small picture.
        let args = ["diff", "gl.exr", "cpu.exr", "--layer", layer, "--tolerance", "1", "--max-differing", "1"];
        lab.run(&args).good();
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn without_an_opengl_library_the_cpu_draws_with_a_note() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let args = ["render", &cube, "--size", "48x32", "--samples", "1", "--egl-library", "libNoSuchEGL.so.1"];
    let run = lab.run(&[&args[..], &["-o", "auto.png"]].concat()).good();
    let notes: Vec<&str> = run.stderr.lines().filter(|l| l.contains("CPU reference")).collect();
    assert_eq!(notes.len(), 1, "{}", run.stderr);
    for piece in ["note: drawn by the CPU reference: no OpenGL", "libNoSuchEGL.so.1", "libegl1", "libgl1-mesa-dri"] {
        assert!(notes[0].contains(piece), "{piece} is not in {}", notes[0]);
    }
    lab.render(&[&cube, "-o", "cpu.png"]).good();
    assert_eq!(lab.read("auto.png"), lab.read("cpu.png"));
    let json = lab.run(&[&args[..], &["-o", "auto.png", "--json"]].concat()).good().json();
    assert!(json["backend"]["reason"].as_str().unwrap().contains("no OpenGL"));

    let args = ["render", &cube, "-o", "gl.png", "--backend", "gl", "--egl-library", "libNoSuchEGL.so.1"];
    lab.run(&args).refused(&["libNoSuchEGL.so.1", "libegl1"]);
    assert_eq!(lab.names(), ["auto.png", "cpu.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_driver_that_is_too_old_is_named() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let run = |backend: &str| {
        let args = ["render", &cube, "-o", "a.png", "--size", "48x32", "--backend", backend];
        // Mesa then reports this version.
        common::Run::of(lab.command(&args).env("MESA_GL_VERSION_OVERRIDE", "3.1").output().unwrap())
    };
    run("gl").refused(&["3.3", "too old", "--backend cpu"]);
    assert!(lab.names().is_empty());
    let run = run("auto").good();
    assert!(
        run.stderr.contains("note: drawn by the CPU reference: ") && run.stderr.contains("too old"),
        "{}",
        run.stderr
    );
}

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
    // No line is wider than a projected terminal or ends with a space.
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
    // From sampler to unit to texture.
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
fn without_opengl_the_error_names_packages_to_install() {
    let lab = Lab::new();
    let run = lab.run(&["frame", &asset("cube.obj"), "--egl-library", "libnothing.so.1"]);
    let run = run.refused(&["no OpenGL", "libnothing.so.1", "apt-get install"]);
    assert!(!run.stderr.contains("--backend"), "{}", run.stderr);
}
