//! `gonio trace`: goals, files, checkpoints, and bad input.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Lab, exr_layers};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Arguments after `trace builtin:cube`, at a small size.
fn args<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["trace", "builtin:cube", "--size", "48x32"], more].concat()
}

#[test]
fn writes_pictures_and_layers() {
    let lab = Lab::new();
    let run =
        lab.run(&args(&["--samples", "4", "-o", "a.exr", "-o", "a.png", "--views", "normal,albedo", "--json"])).good();
    let report = run.json();
    assert_eq!((&report["paths_least"], &report["paths_most"]), (&4.into(), &4.into()), "{report}");
    assert!(report["error"].as_f64().is_some_and(|e| e > 0.0 && e < 1.0), "{report}");
    assert_eq!(report["mode"], "spectral");
    assert_eq!(lab.names(), ["a.exr", "a.png"]);
    let exr = lab.read("a.exr");
    for layer in ["variance", "normal", "albedo"] {
        assert!(exr.windows(layer.len()).any(|w| w == layer.as_bytes()), "{layer}");
    }
    let picture = lab.picture("a.png").to_rgb8();
    assert_eq!(picture.dimensions(), (48, 32));
    // The cube is in the middle, lit; the corner is background.
    assert_ne!(picture.get_pixel(24, 16), picture.get_pixel(0, 0));
}

#[test]
fn views_are_those_of_render() {
    let lab = Lab::new();
    let views = ["--views", "normal,albedo,tangent,depth,diffuse:0"];
    lab.run(&[&args(&["--samples", "1", "-o", "a.exr"])[..], &views].concat()).good();
    let drawn = ["render", "builtin:cube", "--size", "48x32", "--backend", "cpu", "-o", "b.exr"];
    lab.run(&[&drawn[..], &views].concat()).good();
    let without = |file: &str, names: &[&str]| {
        exr_layers(&lab.read(file)).into_iter().filter(|(name, _)| !names.contains(&name.as_str())).collect::<Vec<_>>()
    };
    let (traced, drawn) = (without("a.exr", &["picture", "variance"]), without("b.exr", &["picture"]));
    assert_eq!(traced.len(), 5);
    assert!(traced == drawn, "{:?}", traced.iter().map(|(name, _)| name).collect::<Vec<_>>());
}

#[test]
fn filtering_is_never_silent() {
    let lab = Lab::new();
    let outputs = ["-o", "a.exr", "-o", "a.png"];
    lab.run(&[&args(&["--samples", "16"])[..], &outputs].concat()).good();
    let (exact, plain) = (exr_layers(&lab.read("a.exr")), lab.read("a.png"));
    let run = lab.run(&[&args(&["--samples", "16", "--denoise"])[..], &outputs].concat()).good();
    assert!(run.stderr.contains("note: denoised"), "{}", run.stderr);
    let (filtered, png) = (exr_layers(&lab.read("a.exr")), lab.read("a.png"));
    let names: Vec<&str> = filtered.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["picture", "variance", "denoised", "guide-albedo", "guide-normal"]);
    assert!(filtered[..2] == exact[..], "the traced picture changed");
    assert!(filtered[2].1 != filtered[0].1);
    // In the middle is the cube, in the corner nothing.
    let length = |p: [f32; 4]| (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    assert!(length(filtered[4].1[16 * 48 + 24]) > 0.5 && length(filtered[4].1[0]) == 0.0);
    let says_so = |bytes: &[u8]| bytes.windows(8).any(|w| w == b"Denoised");
    assert!(says_so(&png) && !says_so(&plain) && png != plain);
    let few = lab.run(&args(&["--samples", "2", "--denoise", "-o", "b.png"]));
    few.refused(&["--denoise needs at least 4 --samples", "it has 2"]);
}

/// Ends a program by a signal.
fn interrupt(child: &mut Child, signal: &str) {
    let sent = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    assert!(!child.wait().unwrap().success(), "it survived SIG{signal}");
}

/// Signals at any moment leave the last checkpoint, and the same command goes on from there.
#[test]
fn a_trace_survives_being_killed_again_and_again() {
    let lab = Lab::new();
    let command = args(&["--samples", "3000", "-o", "a.exr", "--checkpoint-every", "0.02", "--rgb"]);
    for signal in ["KILL", "INT", "TERM"] {
        let before = lab.path("a.trace").exists().then(|| lab.read("a.trace"));
        let mut child = lab.command(&command).stderr(Stdio::null()).spawn().unwrap();
        while lab.path("a.trace").exists().then(|| lab.read("a.trace")) == before {
            assert!(child.try_wait().unwrap().is_none(), "it ended too early: {:?}", lab.names());
            std::thread::sleep(Duration::from_millis(1));
        }
        interrupt(&mut child, signal);
        // The picture so far is complete, if there is one.
        if lab.path("a.exr").exists() {
            assert_eq!(exr_layers(&lab.read("a.exr")).len(), 2);
        }
    }
    let run = lab.run(&command).good();
    assert!(run.stderr.contains("continuing from `a.trace` at "), "{}", run.stderr);
    lab.run(&args(&["--samples", "3000", "-o", "b.exr", "--rgb"])).good();
    assert!(lab.read("a.exr") == lab.read("b.exr"), "the pictures differ");
}

/// Passes end often enough that a picture and its checkpoint appear long before 10^9 paths.
#[test]
fn a_huge_number_of_paths_is_traced_in_short_passes() {
    for size in ["1x1", "96x64"] {
        let lab = Lab::new();
        let command = ["trace", "builtin:cube", "--size", size, "--samples", "1000000000", "-o", "a.png"];
        let mut child = lab
            .command(&[&command[..], &["--checkpoint-every", "0.2"]].concat())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while !(lab.path("a.trace").exists() && lab.path("a.png").exists()) {
            assert!(child.try_wait().unwrap().is_none(), "it ended: {:?}", lab.names());
            std::thread::sleep(Duration::from_millis(5));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
}

#[test]
fn odd_scenes_are_traced_and_explained() {
    let lab = Lab::new();
    lab.write("flat.mtl", "newmtl lamp\nKd 0 0 0\nKe 5 5 5\n");
    lab.write(
        "flat.obj",
        "mtllib flat.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nusemtl lamp\nf 1 2 4\nf 1 1 1\n",
    );
    let small = ["--samples", "2", "-o", "a.exr", "--size"];
    for (scene, size, warning) in [
        (&["builtin:cube", "--light", "ambient"][..], "9x7", "nothing lights the scene"),
        (&["flat.obj"], "9x7", "triangles that emit light have no area"),
        // The eye in the middle of the cube.
        (&["builtin:cube", "--camera-position", "0,0,0", "--camera-target", "1,0,0"], "9x7", ""),
        (&["builtin:cube"], "1x1", ""),
    ] {
        let run = lab.run(&[&["trace"][..], scene, &small, &[size]].concat()).good();
        assert!(run.stderr.contains(warning), "{scene:?}: {}", run.stderr);
        let pixels = &exr_layers(&lab.read("a.exr"))[0].1;
        assert!(pixels.iter().flatten().all(|v| v.is_finite() && *v >= -0.01), "{scene:?}");
    }
    // An error that cannot be reached is refused, not traced for ever; one path is the least that there is.
    lab.run(&args(&["--error", "1e-400", "-o", "b.png"])).refused(&["invalid number `1e-400`"]);
    lab.run(&args(&["--time", "1e-9", "-o", "b.png"])).good();
    lab.run(&args(&["--time", "1e300", "-o", "b.png"])).refused(&["invalid number `1e300`"]);
}

#[test]
fn threads_and_formats_do_not_change_a_picture() {
    let lab = Lab::new();
    lab.run(&args(&["--samples", "3", "-o", "a.exr", "--threads", "1"])).good();
    lab.run(&args(&["--samples", "3", "-o", "b.exr", "--threads", "3"])).good();
    assert!(lab.read("a.exr") == lab.read("b.exr"));
    lab.run(&args(&["--samples", "3", "-o", "c.exr", "--seed", "1"])).good();
    assert!(lab.read("a.exr") != lab.read("c.exr"));
    let run = lab.run(&args(&["--samples", "3", "-o", "-"])).good();
    assert_eq!(&run.stdout[..4], b"\x89PNG");
}

#[test]
fn an_error_is_reached_with_more_paths_where_there_is_noise() {
    let lab = Lab::new();
    let report = lab.run(&args(&["--error", "1.5", "-o", "a.exr", "--json"])).good().json();
    assert!(report["error_bound"].as_f64().unwrap() <= 0.015, "{report}");
    assert!(report["paths_most"].as_u64() > report["paths_least"].as_u64(), "{report}");
}

#[test]
fn a_time_is_enough_for_a_picture() {
    let lab = Lab::new();
    let report = lab.run(&args(&["--time", "0.3", "-o", "a.png", "--json"])).good().json();
    assert!(report["paths_least"].as_u64().unwrap() >= 1, "{report}");
}

/// Killed after its first checkpoint, and run again.
#[test]
fn an_interrupted_trace_goes_on_and_ends_alike() {
    let lab = Lab::new();
    let command = args(&["--samples", "400", "-o", "a.exr", "--checkpoint-every", "0.01"]);
    let mut child = lab.command(&command).stderr(Stdio::null()).spawn().unwrap();
    while !lab.path("a.trace").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before its first checkpoint: {:?}", lab.names());
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let run = lab.run(&command).good();
    assert!(run.stderr.contains("continuing from `a.trace` at "), "{}", run.stderr);
    assert!(!lab.path("a.trace").exists());
    lab.run(&args(&["--samples", "400", "-o", "b.exr"])).good();
    assert!(lab.read("a.exr") == lab.read("b.exr"), "the pictures differ");
}

#[test]
fn checkpoints_of_others_are_recognised() {
    let lab = Lab::new();
    lab.write("a.trace", b"something else");
    lab.run(&args(&["--samples", "1", "-o", "a.exr"])).refused(&["a.trace", "not a checkpoint", "--restart"]);
    assert_eq!(lab.names(), ["a.trace"]);
    lab.run(&args(&["--samples", "1", "-o", "a.exr", "--restart"])).good();
    assert_eq!(lab.names(), ["a.exr"]);
}

#[test]
fn bad_options_are_refused() {
    let lab = Lab::new();
    for (more, pieces) in [
        (&["-o", "a.jpg"][..], &["a.jpg", ".exr or .png"][..]),
        (&["-o", "a.png", "--views", "normal"], &["--views", ".exr"]),
        (&["-o", "a.png", "--samples", "0"], &["invalid number of paths `0`"]),
        (&["-o", "a.png", "--samples", "2000000000"], &["invalid number of paths `2000000000`", "1000000000"]),
        (&["-o", "a.png", "--error", "0"], &["invalid number `0`", "percentage"]),
        (&["-o", "a.png", "--time", "nan"], &["invalid number `nan`"]),
        (&["-o", "a.png", "--time", "1", "--error", "1"], &["cannot be used with"]),
        (&["-o", "a.png", "--samples", "1", "--error", "1"], &["cannot be used with"]),
        (&["-o", "a.png", "--aperture", "-1"], &["--aperture"]),
        (&["-o", "a.png", "--focus", "0"], &["invalid number `0`", "above 0"]),
    ] {
        lab.run(&args(more)).refused(pieces);
        assert_eq!(lab.names(), Vec::<String>::new(), "{more:?}");
    }
}

/// Options with numbers, and values that each refuses besides those that all refuse.
const NUMBERS: [(&str, &[&str], &[&str]); 17] = [
    ("trace", &["--samples"], &["0", "-1", "1.5", "1000000001"]),
    ("trace", &["--time"], &["0", "-1", "1e10"]),
    ("trace", &["--error"], &["0", "-1", "101"]),
    ("trace", &["--max-depth"], &["0", "-1", "2.5", "100001"]),
    ("trace", &["--seed"], &["-1", "0.5", "18446744073709551616"]),
    ("trace", &["--threads"], &["0", "-1", "1025"]),
    ("trace", &["--aperture"], &["-1"]),
    ("trace", &["--focus"], &["0", "-1"]),
    ("trace", &["--shutter"], &["-1"]),
    ("trace", &["--moment"], &[]),
    ("trace", &["--checkpoint-every"], &["0", "-1"]),
    ("simplify", &["--points"], &["0", "-1", "4097"]),
    ("simplify", &["--samples", "--time", "--error", "--max-depth", "--threads"], &["0", "-1"]),
    ("simplify", &["--shutter", "--seed"], &["-1"]),
    ("simplify", &["--moment"], &[]),
    ("probe", &["--samples"], &["0", "-1", "1000000001"]),
    ("probe", &["--time"], &[]),
];

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let lab = Lab::new();
    for (command, options, values) in NUMBERS {
        let fixed: &[&str] = if command == "probe" { &["--at", "1,1", "--traced"] } else { &["-o", "a.exr"] };
        for option in options {
            for value in ["nan", "inf", "-inf", "-NaN", "infinity", "1e999", "", "x"].iter().chain(values) {
                let run = lab
                    .run(&[&[command, "builtin:cube", "--size", "8x8", &format!("{option}={value}")], fixed].concat());
                let run = run.refused(&["invalid", &format!("`{value}`")]);
                assert!(run.stderr.contains(option), "{}", run.stderr);
                assert_eq!(lab.names(), Vec::<String>::new(), "{command} {option} {value}");
            }
            // A negative number is a value, and no other option.
            if values.contains(&"-1") {
                let args = [&[command, "builtin:cube", "--size", "8x8", option, "-1"], fixed].concat();
                lab.run(&args).refused(&["invalid", "`-1`"]);
            }
        }
    }
}

/// The light of one pixel by the way it took, as text and for machines; the sum is the pixel of the same paths.
#[test]
fn a_probe_lists_the_ways_of_light() {
    let lab = Lab::new();
    let scene =
        "[[object]]\nmodel = \"builtin:cube\"\n[[light]]\nkind = \"point\"\nname = \"key\"\nposition = [1, 2, 3]\n";
    lab.write("lit.toml", scene);
    let probe = ["probe", "lit.toml", "--at", "24,16", "--size", "48x32", "--backend", "cpu"];
    let run = |more: &[&str]| lab.run(&[&probe[..], more].concat());
    let report = run(&["--traced", "--samples", "64", "--json"]).good().json();
    let traced = &report["traced"];
    assert_eq!(traced["paths"], 64, "{report}");
    assert_eq!((&traced["direct"][0]["source"], &traced["direct"][0]["name"]), (&"light".into(), &"key".into()));
    let rgb = |value: &serde_json::Value| [0, 1, 2].map(|c| value[c].as_f64().unwrap());
    let (direct, total) = (rgb(&traced["direct"][0]["value"]), rgb(&traced["total"]));
    let others = ["emitted", "first_bounce", "rest"].map(|part| rgb(&traced[part]));
    for c in 0..3 {
        let sum = direct[c] + others.iter().map(|part| part[c]).sum::<f64>();
        // The lanes of a path are added in another order, in f32.
        assert!(direct[c] > 0.0 && (sum - total[c]).abs() < 1e-5 * total[c], "{traced}");
    }
    lab.run(&["trace", "lit.toml", "--size", "48x32", "--samples", "64", "-o", "a.exr"]).good();
    let picture = &exr_layers(&lab.read("a.exr"))[0].1;
    let pixel = picture[16 * 48 + 24];
    assert!((0..3).all(|c| (f64::from(pixel[c]) - total[c]).abs() < 1e-5), "{pixel:?} {traced}");
    let text = run(&["--traced"]).good();
    for line in
        ["by the way it took: 4096 paths through the pixel", "`key`; one surface scattered it", "standard error"]
    {
        assert!(text.text().contains(line), "{}", text.text());
    }
    // Without it there is nothing to count the paths of.
    assert!(run(&["--json"]).good().json()["traced"].is_null());
    assert_eq!(run(&["--samples", "4"]).code, 2);
}
