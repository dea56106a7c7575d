//! `gonio render`, `scene` and `probe` on good input, drawn by the CPU.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, asset, exr_layers};
use serde_json::Value;

#[test]
fn a_png_has_the_requested_size_and_depth() {
    let lab = Lab::new();
    lab.render(&[&asset("cube.obj"), "-o", "a.png", "--size", "60x20"]).good();
    let picture = lab.picture("a.png");
    assert_eq!((picture.width(), picture.height()), (60, 20));
    assert!(matches!(picture, image::DynamicImage::ImageRgb8(_)));
    let colors: std::collections::BTreeSet<[u8; 3]> = picture.to_rgb8().pixels().map(|p| p.0).collect();
    assert!(colors.len() > 5, "only {} colours", colors.len());

    lab.render(&[&asset("cube.obj"), "-o", "b.png", "--bits", "16", "--background", "transparent"]).good();
    assert!(matches!(lab.picture("b.png"), image::DynamicImage::ImageRgba16(_)));
    assert_eq!(lab.picture("b.png").to_rgba16().get_pixel(0, 0).0[3], 0);
    assert_eq!(lab.names(), ["a.png", "b.png"]);
}

#[test]
fn stdout_gets_the_same_bytes_as_a_file() {
    let lab = Lab::new();
    let run = lab.render(&[&asset("cube.obj"), "-o", "-"]).good();
    lab.render(&[&asset("cube.obj"), "-o", "a.png"]).good();
    assert_eq!(run.stdout, lab.read("a.png"));
    let run = lab.render(&[&asset("cube.obj"), "-o", "-", "--format", "exr"]).good();
    assert_eq!(run.stdout[..4], [0x76, 0x2f, 0x31, 0x01]);
}

#[test]
fn an_exr_has_the_numbers_of_the_probe() {
    let lab = Lab::new();
    let model = asset("still_life.obj");
    lab.render(&[&model, "-o", "a.exr", "--views", "N,diffuse:0"]).good();
    let at = "24,16";
    let json = lab.run(&["probe", &model, "--at", at, "--size", "48x32", "--backend", "cpu", "--json"]).good().json();
    assert_eq!(json["hit"], true);
    let numbers =
        |v: &serde_json::Value| -> Vec<f64> { v.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect() };
    let layers = exr_layers(&lab.read("a.exr"));
    let names: Vec<&str> = layers.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["picture", "normal", "diffuse-0"]);
    for ((name, pixels), expected) in layers.iter().zip([
        numbers(&json["reference"]),
        numbers(&json["probe"]["terms"]["point"]["normal"]),
        numbers(&json["probe"]["terms"]["lights"][0]["diffuse"]),
    ]) {
        let value = pixels[16 * 48 + 24];
        for c in 0..expected.len().min(3) {
            // 1e-6: the file has f32, the probe f64.
            assert!((f64::from(value[c]) - expected[c]).abs() < 1e-6, "{name}: {value:?} and {expected:?}");
        }
    }
}

#[test]
fn tangents_are_computed_for_their_view() {
    let lab = Lab::new();
    // The floor alone: u runs along x, v along -z, so its tangent is (1, 0, 0), shown as (1, 0.5, 0.5).
    let floor = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 1 0\n\
                 f 1/1/1 2/2/1 3/3/1 4/4/1\n";
    lab.write("floor.obj", floor);
    let options = ["--debug", "tangent", "--camera-position", "0,2,0.1", "--camera-target", "0,0,0"];
    lab.render(&[&["floor.obj", "-o", "a.png"], &options[..]].concat()).good();
    let picture = lab.picture("a.png").to_rgb8();
    let center = picture.get_pixel(picture.width() / 2, picture.height() / 2).0;
    assert_eq!(center, [255, 128, 128]);
}

#[test]
fn views_are_written_beside_a_png() {
    let lab = Lab::new();
    let run = lab.render(&[&asset("cube.obj"), "-o", "a.png", "--views", "N,diffuse:0,depth", "--json"]).good();
    assert_eq!(lab.names(), ["a-depth.png", "a-diffuse-0.png", "a-normal.png", "a.png"]);
    assert_eq!(run.json()["outputs"].as_array().unwrap().len(), 4);
    lab.render(&[&asset("cube.obj"), "-o", "n.png", "--debug", "normal"]).good();
    assert_eq!(lab.read("n.png"), lab.read("a-normal.png"));
    assert_ne!(lab.read("n.png"), lab.read("a.png"));
}

#[test]
fn several_formats_in_one_run() {
    let lab = Lab::new();
    lab.render(&[&asset("cube.obj"), "-o", "a.png", "-o", "a.exr"]).good();
    assert_eq!(lab.names(), ["a.exr", "a.png"]);
}

#[test]
fn frames_are_numbered_and_the_orbit_turns() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    // With an explicit camera: a default one would move back, see below.
    let eye = ["--camera-position", "2,2,4", "--camera-target", "0,0,0"];
    let from_eye = |args: &[&str]| lab.render(&[&[cube.as_str()], args, &eye[..]].concat()).good();
    from_eye(&["-o", "turn.png", "--frames", "3", "--orbit", "360"]);
    assert_eq!(lab.names(), ["turn-0001.png", "turn-0002.png", "turn-0003.png"]);
    assert_ne!(lab.read("turn-0001.png"), lab.read("turn-0002.png"));
    from_eye(&["-o", "still.png"]);
    assert_eq!(lab.read("still.png"), lab.read("turn-0001.png"));

    from_eye(&["-o", "f%02d.png", "--frames", "2"]);
    assert_eq!(lab.read("f01.png"), lab.read("still.png"));
    assert_eq!(lab.read("f02.png"), lab.read("still.png"));

    // The default camera, which frames the model from one side, moves back for the turn.
    lab.render(&[&cube, "-o", "framed.png"]).good();
    lab.render(&[&cube, "-o", "framed-turn.png", "--frames", "3", "--orbit", "360"]).good();
    assert_ne!(lab.read("framed.png"), lab.read("framed-turn-0001.png"));
}

#[test]
fn animations_contain_all_frames() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for name in ["a.gif", "a.apng"] {
        lab.render(&[&cube, "-o", name, "--frames", "4", "--orbit", "90", "--fps", "10"]).good();
    }
    lab.render(&[&cube, "-o", "b.png", "--frames", "4", "--animated", "--orbit", "90", "--fps", "10"]).good();
    assert_eq!(lab.read("a.apng"), lab.read("b.png"));

    let bytes = lab.read("a.apng");
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 4);
    let mut frames = Vec::new();
    for _ in 0..4 {
        let mut frame = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut frame).unwrap();
        let control = reader.info().frame_control().unwrap();
        assert_eq!((control.delay_num, control.delay_den), (1, 10));
        frames.push(frame);
    }
    assert!(frames.windows(2).all(|w| w[0] != w[1]));

    let bytes = lab.read("a.gif");
    let mut reader = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut count = 0;
    while let Some(frame) = reader.read_next_frame().unwrap() {
        assert_eq!((frame.width, frame.height, frame.delay), (48, 32, 10));
        count += 1;
    }
    assert_eq!(count, 4);
}

#[test]
fn lights_move_with_the_frames() {
    let lab = Lab::new();
    let light = "point position=3,3,3 motion=circle center=0,0,0 period=2";
    let args = [&asset("cube.obj"), "--light", light];
    lab.render(&[&args[..], &["-o", "a.png", "--frames", "2", "--fps", "2"]].concat()).good();
    lab.render(&[&args[..], &["-o", "b.png", "--time", "0.5"]].concat()).good();
    assert_ne!(lab.read("a-0001.png"), lab.read("a-0002.png"));
    assert_eq!(lab.read("a-0002.png"), lab.read("b.png"));
}

#[test]
fn a_printed_scene_gives_the_same_picture() {
    let lab = Lab::new();
    let options = [
        "--shading",
        "flat",
        "--exposure",
        "0.5",
        "--light",
        "spot position=2,4,3 direction=-2,-4,-3",
        "--background",
        "#204060:0.1",
    ];
    let model = asset("still_life.obj");
    lab.render(&[&[model.as_str(), "-o", "a.png"], &options[..]].concat()).good();
    let scene = lab.run(&[&["scene", &model, "--size", "48x32", "--samples", "1"], &options[..]].concat()).good();
    lab.write("scene.toml", &scene.stdout);
    lab.run(&["render", "scene.toml", "-o", "b.png", "--backend", "cpu"]).good();
    assert_eq!(lab.read("a.png"), lab.read("b.png"));
    // Printing it again changes nothing.
    assert_eq!(lab.run(&["scene", "scene.toml"]).good().text(), scene.text());
}

#[test]
fn a_scene_in_another_folder_still_finds_its_models() {
    let lab = Lab::new();
    std::fs::create_dir_all(lab.path("models")).unwrap();
    std::fs::create_dir_all(lab.path("scenes/new")).unwrap();
    lab.write("models/t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    // The framing depends on the size.
    lab.run(&["scene", "models/t.obj", "--size", "48x32", "-o", "scenes/new/s.toml"]).good();
    let text = String::from_utf8(lab.read("scenes/new/s.toml")).unwrap();
    assert!(text.contains("model = \"../../models/t.obj\""), "{text}");
    lab.render(&["scenes/new/s.toml", "-o", "a.png"]).good();
    lab.render(&["models/t.obj", "-o", "b.png"]).good();
    assert_eq!(lab.read("a.png"), lab.read("b.png"));
}

#[test]
fn the_schema_matches_the_shipped_file() {
    let lab = Lab::new();
    let run = lab.run(&["scene", "--schema"]).good();
    let shipped = include_str!("../../../assets/scene.schema.json");
    assert!(run.text() == shipped, "type: cargo run -p gonio -- scene --schema -o assets/scene.schema.json");
    lab.run(&["scene", "--schema", "-o", "schema.json"]).good();
    assert_eq!(lab.read("schema.json"), shipped.as_bytes());
    let json = run.json();
    assert!(json["$schema"].as_str().unwrap().contains("draft-07"), "{}", json["$schema"]);
    for key in ["picture", "camera", "background", "equation", "object", "light"] {
        assert!(json["properties"][key].is_object(), "{key}");
    }
}

#[test]
fn a_model_without_materials_causes_no_message() {
    // Blender wrote an empty library for it.
    let lab = Lab::new();
    assert_eq!(lab.render(&["builtin:cube", "-o", "a.png"]).good().stderr, "");
    lab.write("cube.mtl", "# nothing\n");
    lab.write("cube.obj", "mtllib cube.mtl\nusemtl gold\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = lab.render(&["cube.obj", "-o", "a.png"]).good();
    assert!(
        run.stderr.contains("cube.obj:2: the material \"gold\" is in none of the material libraries"),
        "{}",
        run.stderr
    );
}

#[test]
fn several_inputs_become_one_scene() {
    let lab = Lab::new();
    let json = lab.render(&[&asset("cube.obj"), &asset("suzanne.obj"), "-o", "a.png", "--json"]).good().json();
    assert_eq!(json["scene"]["objects"], 2);
    let one = lab.render(&[&asset("cube.obj"), "-o", "a.png", "--json"]).good().json();
    assert!(json["scene"]["triangles"].as_u64() > one["scene"]["triangles"].as_u64());
}

#[test]
fn the_report_describes_the_run() {
    let lab = Lab::new();
    let json = lab.render(&[&asset("cube.obj"), "-o", "a.png", "--shading", "gouraud", "--json"]).good().json();
    assert_eq!(json["command"], "render");
    assert_eq!(json["outputs"][0], "a.png");
    assert_eq!(json["backend"]["name"], "cpu");
    assert_eq!(
        (json["width"].as_u64(), json["height"].as_u64(), json["samples"].as_u64()),
        (Some(48), Some(32), Some(1))
    );
    assert_eq!(json["shading"][0], "gouraud");
    assert_eq!(json["scene"]["triangles"], 12);
    assert!(json["drawn"]["fragments"].as_u64().unwrap() > 100);
    for step in ["load", "upload", "draw", "read_back", "encode", "write", "total"] {
        assert!(json["times_ms"][step].is_number(), "{step}");
    }
}

#[test]
fn a_probe_lists_everything_about_a_pixel() {
    let lab = Lab::new();
    let suzanne = asset("suzanne.obj");
    let run = lab.run(&["probe", &suzanne, "--at", "500,400", "--backend", "cpu"]).good();
    for word in [
        "triangle",
        "material",
        "k_d",
        "N.L",
        "R.V",
        "N.H",
        "att",
        "L_o = A + E + sum_i [ diff * k_d * <N.L_i>",
        "CPU reference",
    ] {
        assert!(run.text().contains(word), "{word} is not in {}", run.text());
    }
    let json = lab.run(&["probe", &suzanne, "--at", "500,400", "--backend", "cpu", "--json"]).good().json();
    let sum = |key: &str, c: usize| -> f64 {
        json["probe"]["terms"]["lights"].as_array().unwrap().iter().map(|l| l[key][c].as_f64().unwrap()).sum()
    };
    for c in 0..3 {
        let terms = &json["probe"]["terms"];
        let whole = terms["ambient"][c].as_f64().unwrap()
            + terms["emitted"][c].as_f64().unwrap()
            + sum("diffuse", c)
            + sum("specular", c);
        // 1e-12: the same sum in another order.
        assert!((whole - json["reference"][c].as_f64().unwrap()).abs() < 1e-12);
    }
}

#[test]
fn a_probe_outside_all_objects_shows_the_background() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let args = ["probe", &cube, "--at", "0,0", "--backend", "cpu", "--background", "0.25,0.5,0.75"];
    let run = lab.run(&args).good();
    assert!(run.text().contains("background"), "{}", run.text());
    let json = lab.run(&[&args[..], &["--json"]].concat()).good().json();
    assert_eq!(json["hit"], false);
    assert_eq!(json["reference"], serde_json::json!([0.25, 0.5, 0.75, 1.0]));
}

#[test]
fn a_probe_outside_the_picture_is_an_error() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    lab.run(&["probe", &cube, "--at", "48,0", "--size", "48x32", "--backend", "cpu"])
        .refused(&["48,0", "columns 0 to 47"]);
    lab.run(&["probe", &cube, "--at", "-1,0", "--backend", "cpu"]).refused(&["--at"]);
}

fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn every_term_of_glass_is_listed() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    let size = ["--size", "48x32", "--backend", "cpu", "--environment", "debug"];
    let options = ["--material", "glass,surfaces=two,transmission=0.6,reflectivity=0.5,dispersion=0.02"];
    let args = [&["probe", &cube, "--at", "24,16"], &size[..], &options[..]].concat();
    let run = lab.run(&args).good();
    let terms =
        ["environment `debug`", "surfaces              two", "E(R)", "(1-F) * tint * E(T)", "L = (1-t)", "indices"];
    for word in terms {
        assert!(run.text().contains(word), "{word} is not in {}", run.text());
    }
    let json = lab.run(&[&args[..], &["--json"]].concat()).good().json();
    let probe = &json["probe"];
    let (optics, seen) = (&probe["optics"], &probe["terms"]["environment"]);
    assert_eq!((&optics["fresnel"], &optics["surfaces"]), (&"exact".into(), &"two".into()));
    let (t, sight) = (optics["transmission"].as_f64().unwrap(), &seen["sight"]);
    let [lit, diffuse, specular] = [&probe["lit"], &seen["diffuse"], &seen["specular"]].map(numbers);
    let [f, reflected, through] = [&sight["fresnel"], &sight["reflected"], &sight["transmitted"]].map(numbers);
    let w = optics["reflectivity"].as_f64().unwrap() * f[1];
    let reference = numbers(&json["reference"]);
    for c in 0..3 {
        let lit = lit[c] + diffuse[c] + specular[c];
        let sum = (1.0 - t) * ((1.0 - w) * lit + w * reflected[c]) + t * (f[c] * reflected[c] + through[c]);
        // The same sum in another order.
        assert!((sum - reference[c]).abs() < 1e-12, "{c}: {sum} is not {}", reference[c]);
    }
    assert!(f[0] > 0.0 && f[0] < f[1] && f[1] < f[2] && reflected != [0.0; 3]);
}

#[test]
fn a_probe_of_the_sky_shows_the_environment() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    // The upper left of the debug cubemap ahead; it hides the background.
    let args = ["probe", &cube, "--at", "0,0", "--backend", "cpu", "--environment", "debug", "--background", "0,0,0"];
    let run = lab.run(&args).good();
    assert!(run.text().contains("none, only the environment is visible"), "{}", run.text());
    let json = lab.run(&[&args[..], &["--json"]].concat()).good().json();
    let sky = numbers(&json["reference"]);
    assert!(json["hit"] == false && sky[..3] != [0.0; 3] && sky[3] == 1.0, "{sky:?}");
    // If it is hidden, the background is visible.
    let args = [&args[..], &["--environment-visible=false", "--json"]].concat();
    assert_eq!(lab.run(&args).good().json()["reference"], serde_json::json!([0.0, 0.0, 0.0, 1.0]));
}
