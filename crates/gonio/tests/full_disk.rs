//! If the last file of a command cannot be written, none of its files appears, and no folder created for them remains.
//!
//! A limit on the size of files (`ulimit -f`) replaces a full disk: it needs no privileges, and writing fails in the same way.
#![allow(clippy::unwrap_used, missing_docs)]
#![cfg(unix)]

mod common;

use common::{Lab, Run};
use std::path::Path;
use std::process::{Command, Stdio};

/// All files below a folder with their sizes, and all folders with 0, sorted.
fn files(folder: &Path) -> Vec<(String, u64)> {
    let mut files = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(inner) = open.pop() {
        for entry in std::fs::read_dir(&inner).unwrap().map(Result::unwrap) {
            let is_folder = entry.file_type().unwrap().is_dir();
            if is_folder {
                open.push(entry.path());
            }
            let name = entry.path().strip_prefix(folder).unwrap().to_string_lossy().into_owned();
            files.push((name, if is_folder { 0 } else { entry.metadata().unwrap().len() }));
        }
    }
    files.sort();
    files
}

/// Runs it with a limit on the size of files, in blocks of 1024 bytes.
fn limited(lab: &Lab, blocks: u64, args: &[&str]) -> Run {
    // The signal is ignored, or the system would end the program.
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut command = Command::new("bash");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_gonio")]).args(args);
    Run::of(command.current_dir(lab.path("")).stdin(Stdio::null()).output().unwrap())
}

/// Runs a command that writes below the folder of `lab`, first with a limit that some of its files exceed and others do not,
/// then without; `made` is what the latter leaves.
fn all_or_none(prepare: impl Fn(&Lab), args: &[&str]) {
    let free = Lab::new();
    prepare(&free);
    let before = files(&free.path(""));
    free.run(args).good();
    let after = files(&free.path(""));
    let made: Vec<u64> = after.into_iter().filter(|f| f.1 > 0 && !before.contains(f)).map(|(_, size)| size).collect();
    let (largest, smallest) = (*made.iter().max().unwrap(), *made.iter().min().unwrap());
    let blocks = largest.div_ceil(1024) - 1;
    assert!(smallest <= blocks * 1024 && made.len() > 1, "{args:?}: no file fits in {blocks} blocks: {made:?}");

    let lab = Lab::new();
    prepare(&lab);
    let before = files(&lab.path(""));
    let run = limited(&lab, blocks, args);
    run.refused(&["cannot be written", "larger than this system allows"]);
    assert_eq!(files(&lab.path("")), before, "gonio {args:?} leaves something");
    limited(&lab, largest.div_ceil(1024) + 64, args).good();
}

#[test]
fn exercises_are_started_completely() {
    all_or_none(|_| {}, &["lab", "start", "s1", "new/mine"]);
    all_or_none(|lab| std::fs::create_dir(lab.path("mine")).unwrap(), &["lab", "start", "ex04", "mine"]);
    all_or_none(|_| {}, &["lab", "reference", "ex07", "-o", "new/deep/right"]);
}

#[test]
fn models_are_unwrapped_and_baked_completely() {
    all_or_none(|_| {}, &["unwrap", "builtin:still-life", "-o", "a.obj", "--layout", "a.png", "--size", "64"]);
    all_or_none(|_| {}, &["bake", "builtin:still-life", "-o", "new/baked", "--size", "64"]);
}

#[test]
fn models_are_converted_completely() {
    // A texture in the model becomes a file of its own.
    let prepare = |lab: &Lab| {
        let grain: Vec<u8> = (0..256 * 256 * 3_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        image::save_buffer(lab.path("a.png"), &grain, 256, 256, image::ColorType::Rgb8).unwrap();
        lab.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
        lab.write(
            "a.obj",
            "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
        );
        lab.run(&["convert", "a.obj", "a.glb"]).good();
    };
    all_or_none(prepare, &["convert", "a.glb", "b.obj"]);
    all_or_none(prepare, &["convert", "a.glb", "b.ply"]);
    // Existing files keep their content.
    let old = |lab: &Lab| {
        prepare(lab);
        lab.write("b.obj", "old");
        lab.write("b.mtl", "older");
    };
    all_or_none(old, &["convert", "a.glb", "b.obj"]);
}

#[test]
fn fits_are_written_with_their_residuals() {
    let prepare = |lab: &Lab| drop(lab.run(&["brdf", "export", "lambert", "-o", "a.binary"]).good());
    let args = ["brdf", "fit", "a.binary", "--model", "lambert", "-o", "fit.toml", "--residuals", "residuals.svg"];
    all_or_none(prepare, &args);
}

#[test]
fn environments_are_converted_completely() {
    all_or_none(|_| {}, &["environment", "convert", "debug", "faces", "--size", "128"]);
}

#[test]
fn pictures_of_one_command_are_written_completely() {
    let small = ["--backend", "cpu", "--samples", "1", "--size", "160x120"];
    all_or_none(
        |_| {},
        &[&["render", "builtin:suzanne", "-o", "a.png", "--views", "N,diffuse,depth"][..], &small].concat(),
    );
    all_or_none(|_| {}, &[&["render", "builtin:cube", "-o", "a.png", "-o", "a.exr"][..], &small].concat());
    let traced = ["--samples", "4", "--size", "160x120", "-o", "a.png", "-o", "a.exr", "--denoise"];
    all_or_none(|_| {}, &[&["trace", "builtin:cube"][..], &traced].concat());
    let two = |lab: &Lab| {
        for (name, size) in [("a.png", "160x120"), ("b.png", "160x120")] {
            lab.run(&["render", "builtin:suzanne", "-o", name, "--size", size, "--samples", "1", "--backend", "cpu"])
                .good();
        }
    };
    all_or_none(two, &["diff", "a.png", "b.png", "--side-by-side", "s.png", "-o", "m.png", "--no-legend"]);
}

#[test]
fn the_steps_of_a_simplification_are_written_completely() {
    let small = ["--size", "48x32", "--samples", "2", "--only", "shadows"];
    all_or_none(|_| {}, &[&["simplify", "builtin:cube", "-o", "new/stairs"][..], &small].concat());
}

#[test]
fn a_station_is_written_completely() {
    let small = ["--size", "48x32", "--samples", "1", "--frames", "2"];
    all_or_none(|_| {}, &[&["beyond", "phosphorescence", "-o", "new/out"][..], &small].concat());
}

#[test]
fn the_tour_is_written_completely() {
    all_or_none(|_| {}, &["tour", "-o", "new/tour", "--scale", "0.05", "--backend", "cpu"]);
}

#[test]
fn courses_and_packages_are_written_completely() {
    all_or_none(|_| {}, &["course", "new", "new/course"]);
    for platform in ["moodle", "github-classroom"] {
        all_or_none(|_| {}, &["course", "package", "ex07", "--for", platform, "-o", "package"]);
    }
}
