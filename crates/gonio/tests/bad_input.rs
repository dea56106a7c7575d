//! Everything that can be wrong with input: each mistake ends in exit code 2 and one sentence, and leaves no files.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, asset};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_missing_file() {
    let lab = Lab::new();
    lab.render(&["nothing.obj", "-o", "out.png"]).refused(&["nothing.obj", "no such file"]);
    assert!(lab.names().is_empty(), "{:?}", lab.names());
}

#[test]
fn a_folder() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("models")).unwrap();
    lab.render(&["models", "-o", "out.png"]).refused(&["models", "folder"]);
    assert_eq!(lab.names(), ["models"]);
}

#[test]
fn an_empty_file() {
    let lab = Lab::new();
    lab.write("empty.obj", "");
    lab.render(&["empty.obj", "-o", "out.png"]).refused(&["empty.obj", "empty"]);
    assert_eq!(lab.names(), ["empty.obj"]);
}

#[test]
fn binary_garbage() {
    let lab = Lab::new();
    let rubbish: Vec<u8> = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    lab.write("rubbish.obj", &rubbish);
    lab.render(&["rubbish.obj", "-o", "out.png"]).refused(&["rubbish.obj"]);
    lab.write("rubbish.toml", &rubbish);
    lab.render(&["rubbish.toml", "-o", "out.png"]).refused(&["rubbish.toml"]);
    assert_eq!(lab.names(), ["rubbish.obj", "rubbish.toml"]);
}

#[test]
fn no_triangles() {
    let lab = Lab::new();
    lab.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    lab.render(&["points.obj", "-o", "out.png"]).refused(&["points.obj", "triangle"]);
    assert_eq!(lab.names(), ["points.obj"]);
}

#[test]
fn coordinates_that_are_not_numbers() {
    for (name, word) in [("nan.obj", "nan"), ("inf.obj", "inf"), ("large.obj", "1e999")] {
        let lab = Lab::new();
        // The only face has the bad vertex: whether that is an error or a warning, no empty picture is written.
        lab.write(name, format!("v 0 0 0\nv {word} 0 0\nv 0 1 0\nf 1 2 3\n"));
        lab.render(&[name, "-o", "out.png"]).refused(&[name]);
        assert_eq!(lab.names(), [name]);
    }
}

#[test]
fn indices_out_of_range() {
    let lab = Lab::new();
    lab.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    lab.render(&["range.obj", "-o", "out.png"]).refused(&["range.obj", "9"]);
    assert_eq!(lab.names(), ["range.obj"]);
}

#[test]
fn absurd_sizes() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for size in ["100000x100000", "16385x1", "16384x16384", "99999999999999999999999x1"] {
        lab.render(&[&cube, "-o", "out.png", "--size", size]).refused(&["too large", "16384 pixels along a side"]);
    }
    for size in ["0x10", "10", "axb", "-5x5", "x"] {
        lab.render(&[&cube, "-o", "out.png", "--size", size]).refused(&["--size"]);
    }
    lab.write("large.toml", format!("[picture]\nwidth = 100000\n[[object]]\nmodel = '{cube}'\n"));
    let run = lab.run(&["render", "large.toml", "-o", "out.png", "--backend", "cpu"]);
    run.refused(&["large.toml:2:", "16384"]);
    assert_eq!(lab.names(), ["large.toml"]);
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_anything_is_read() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("folder.png")).unwrap();
    lab.write("file", "x");
    // The model does not exist, but the error about the output comes first.
    lab.render(&["no.obj", "-o", "missing/out.png"]).refused(&["`missing/out.png`", "there is no folder `missing`"]);
    lab.render(&["no.obj", "-o", "folder.png"]).refused(&["`folder.png`", "it is a folder"]);
    lab.render(&["no.obj", "-o", "file/out.png"]).refused(&["`file/out.png` cannot be written"]);
    lab.render(&["no.obj", "-o", "out.bmp"]).refused(&["unsupported format `.bmp`", ".png", ".exr", ".gif"]);
    lab.render(&["no.obj", "-o", "out"]).refused(&["no extension"]);
    lab.render(&["no.obj", "-o", "out.pnh"]).refused(&["did you mean .png?"]);
    lab.render(&["no.obj", "-o", "missing/out.png", "--frames", "3"]).refused(&["there is no folder"]);
    assert_eq!(lab.names(), ["file", "folder.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    lab.render(&[&cube, "-o", "/dev/full", "--format", "png"]).refused(&["`/dev/full`", "the disk is full"]);
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut command = lab.command(&["render", &cube, "-o", "-", "--size", "48x32", "--backend", "cpu"]);
    common::Run::of(command.stdout(full).output().unwrap()).refused(&["stdout", "the disk is full"]);

    // A file may have at most one block: writing fails in the middle, as on a full disk.
    lab.write("out.exr", "the picture of yesterday");
    let program = env!("CARGO_BIN_EXE_gonio");
    let script = r#"ulimit -f 1; trap "" XFSZ; exec "$0" "$@""#;
    let output = std::process::Command::new("sh")
        .args(["-c", script, program, "render", &cube, "-o", "out.exr", "--size", "48x32", "--backend", "cpu"])
        .current_dir(lab.path(""))
        .output()
        .unwrap();
    common::Run::of(output).refused(&["`out.exr` cannot be written"]);
    assert_eq!(lab.names(), ["out.exr"]);
    assert_eq!(lab.read("out.exr"), b"the picture of yesterday");
}

#[test]
fn unknown_option_values_suggest_the_nearest() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for (option, value, known) in [
        ("--shading", "phongg", "phong"),
        ("--specular", "blin-phong", "blinn-phong"),
        ("--brdf", "lamber", "lambert"),
        ("--convention", "fysical", "physical"),
        ("--tone-map", "reinhart", "reinhard"),
        ("--texture-filter", "linea", "linear"),
        ("--normals", "avraged", "averaged"),
        ("--debug", "normals", "normal"),
        ("--light", "piont position=0,0,0", "point"),
        ("--material", "shinines=3", "shininess"),
        ("--without", "diffus", "diffuse"),
        ("--backend", "gll", "gl"),
    ] {
        lab.run(&["render", &cube, "-o", "out.png", option, value]).refused(&[option, known]);
    }
    for (option, value) in [
        ("--samples", "3"),
        ("--fov-y", "180"),
        ("--exposure", "nan"),
        ("--camera-position", "1,2"),
        ("--background", "mauve"),
        ("--frames", "0"),
        ("--bits", "12"),
        ("--debug", "normal:1"),
        ("--light", "point position=1,2"),
    ] {
        lab.run(&["render", &cube, "-o", "out.png", option, value]).refused(&[option, value]);
    }
    lab.run(&["render", &cube, "-o", "out.png", "--shadding", "flat"]).refused(&["--shadding", "--shading"]);
    lab.run(&["rendr", &cube]).refused(&["rendr", "render"]);
    assert!(lab.names().is_empty());
}

#[test]
fn options_that_contradict_each_other() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    lab.render(&[&cube, "-o", "-", "--json"]).refused(&["stdout"]);
    lab.render(&[&cube, "-o", "-", "--frames", "2"]).refused(&["--format gif"]);
    lab.render(&[&cube, "-o", "a.gif", "--frames", "2", "--views", "N"]).refused(&["one view"]);
    lab.render(&[&cube, "-o", "a.exr", "--bits", "16"]).refused(&["--bits"]);
    lab.render(&[&cube, "-o", "a.png", "--yaw", "3", "--camera-target", "0,0,0"]).refused(&["--yaw"]);
    lab.render(&[&cube, "-o", "a.png", "--debug", "diffuse:9"]).refused(&["diffuse:9", "numbers 0 to"]);
    lab.render(&[&cube, "-o", "a.png", "--light", "point"]).refused(&["position"]);
    lab.render(&[&cube, "-o", "a.png", "--capture", "a.rdc"]).refused(&["--capture needs OpenGL"]);
    assert!(lab.names().is_empty(), "{:?}", lab.names());
}

#[test]
fn a_missing_material_library_is_a_warning_with_all_searched_places() {
    let lab = Lab::new();
    lab.write("lost.obj", format!("mtllib lost.mtl\nusemtl clay\n{TRIANGLE}"));
    let run = lab.render(&["lost.obj", "-o", "out.png"]).good();
    assert!(run.stderr.contains("warning: lost.obj:1") && run.stderr.contains("lost.mtl"), "{}", run.stderr);
    assert_eq!(lab.names(), ["lost.obj", "out.png"]);
    let json = lab.render(&["lost.obj", "-o", "out.png", "--json"]).good().json();
    let warnings = json["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|w| w["message"].as_str().unwrap().contains("lost.mtl")), "{json}");
    let quiet = lab.render(&["lost.obj", "-o", "out.png", "--quiet"]).good();
    assert_eq!(quiet.stderr, "");
}

#[test]
fn a_missing_texture_is_a_warning_with_all_searched_places() {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("models")).unwrap();
    lab.write(
        "models/wall.obj",
        format!("mtllib wall.mtl\nusemtl brick\nvt 0 0\n{}", TRIANGLE.replace("f 1 2 3", "f 1/1 2/1 3/1")),
    );
    lab.write("models/wall.mtl", "newmtl brick\nKd 1 1 1\nmap_Kd textures\\brick.png\n");
    let run = lab.render(&["models/wall.obj", "-o", "out.png"]).good();
    let warning = run.stderr.lines().find(|l| l.starts_with("warning: ")).unwrap_or_default();
    assert!(warning.contains("brick.png") && warning.contains("models"), "{}", run.stderr);
    assert_eq!(lab.names(), ["models", "out.png"]);
}

#[test]
fn a_closed_stdout_is_a_silent_success() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for args in [
        vec!["render", &cube, "-o", "-", "--size", "48x32", "--backend", "cpu"],
        vec!["render", &cube, "-o", "a.png", "--size", "48x32", "--backend", "cpu", "--json"],
        vec!["scene", &cube],
        vec!["probe", &cube, "--at", "5,5", "--backend", "cpu"],
        vec!["inspect", &cube],
        vec!["convert", &cube, "-", "--format", "glb"],
        vec!["environment", "convert", "debug", "-", "--size", "16"],
        vec!["lab", "list"],
        vec!["lab", "show", "ex04"],
        vec!["lab", "reference", "ex04"],
        vec!["lab", "mistakes"],
    ] {
        let mut command = lab.command(&args);
        command.arg("--quiet").stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let mut child = command.spawn().unwrap();
        drop(child.stdout.take());
        let run = common::Run::of(child.wait_with_output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{args:?}");
    }
}

#[test]
fn a_scene_file_with_a_mistake_names_line_and_column() {
    let lab = Lab::new();
    lab.write("scene.toml", "[picture]\nwidht = 3\n");
    lab.render(&["scene.toml", "-o", "out.png"]).refused(&["scene.toml:2:1:", "widht", "width"]);
}

#[test]
fn an_error_is_in_the_json_report_too() {
    let lab = Lab::new();
    let run = lab.render(&["nothing.obj", "-o", "out.png", "--json"]).refused(&["nothing.obj"]);
    assert!(run.json()["error"].as_str().unwrap().contains("nothing.obj"));
}
