//! `gonio trace`: goals, files, checkpoints, and bad input.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::Lab;
use std::process::Stdio;
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
