//! `--backend`: OpenGL, and the CPU in its place with a note about the reason. Needs the OpenGL that the README names; Mesa's
//! llvmpipe is enough.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, asset};

#[test]
fn opengl_and_the_cpu_draw_the_same_picture() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    for (backend, name) in [("gl", "gl.png"), ("cpu", "cpu.png"), ("auto", "auto.png")] {
        // Linear filtering is defined to the bit and the same everywhere; the footprints of mipmaps are not.
        let filter = ["--texture-filter", "linear"];
        let args = ["render", &model, "-o", name, "--size", "160x120", "--samples", "1", "--backend", backend];
        let run = lab.run(&[&args[..], &filter[..]].concat());
        let stderr = run.good().stderr;
        assert_eq!(stderr.contains("note: drawn by OpenGL ("), backend == "auto", "{backend}: {stderr}");
    }
    assert_eq!(lab.read("gl.png"), lab.read("auto.png"));
    // 0.5 % of the pixels by more than one step: what the project promises, edges included.
    lab.run(&["diff", "gl.png", "cpu.png", "--tolerance", "1", "--max-differing", "0.5"]).good();
    let json =
        lab.run(&["render", &model, "-o", "gl.png", "--size", "64x48", "--backend", "gl", "--json"]).good().json();
    assert_eq!(json["backend"]["name"], "gl");
    assert!(json["backend"]["renderer"].is_string() && json["drawn"]["draw_calls"].as_u64() > Some(0), "{json}");
}

#[test]
fn a_probe_sets_opengl_beside_the_reference() {
    let lab = Lab::new();
    let args = ["probe", &asset("suzanne.obj"), "--at", "500,400", "--backend", "gl", "--json"];
    let json = lab.run(&args).good().json();
    // 1e-3: what the project promises for linear values.
    assert!(json["gpu"]["difference"].as_f64().unwrap() < 1e-3, "{}", json["gpu"]);
}

#[test]
fn views_drawn_by_opengl_are_those_of_the_cpu() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for (backend, name) in [("gl", "gl.exr"), ("cpu", "cpu.exr")] {
        let common = ["--size", "64x48", "--samples", "1", "--backend", backend, "--views", "N,cos-theta,diffuse"];
        lab.run(&[&["render", &cube, "-o", name], &common[..]].concat()).good();
    }
    for layer in ["picture", "normal", "cos-theta", "diffuse"] {
        // Edges may fall on either side: 1 % of the pixels of a small picture.
        let args = ["diff", "gl.exr", "cpu.exr", "--layer", layer, "--tolerance", "1", "--max-differing", "1"];
        lab.run(&args).good();
    }
}

#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn without_an_opengl_library_the_cpu_draws_and_says_why() {
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
        // Mesa's own way of pretending.
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
