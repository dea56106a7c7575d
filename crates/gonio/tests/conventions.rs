//! What people expect of any command: help, version, stdout, pipes, verbosity, completions, manual pages, licences.
#![allow(clippy::unwrap_used)]

mod common;
use common::{Lab, Run, asset};
use std::process::Stdio;

/// Runs gonio as if on a terminal of `columns`, or without a terminal.
fn run_at_width(lab: &Lab, args: &[&str], columns: Option<&str>) -> Run {
    let mut command = lab.command(args);
    command.env_remove("COLUMNS");
    if let Some(columns) = columns {
        command.env("COLUMNS", columns);
    }
    Run::of(command.output().unwrap())
}

fn widest_line(text: &str) -> usize {
    text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

#[test]
fn help_is_the_same_before_and_after_a_command() {
    let lab = Lab::new();
    for words in [&["render"][..], &["lab", "check"], &["environment", "convert"], &["completions"]] {
        let before = lab.run(&[&["help"], words].concat()).good();
        let behind = lab.run(&[words, &["--help"]].concat()).good();
        let short = lab.run(&[words, &["-h"]].concat()).good();
        assert_eq!(before.text(), behind.text(), "{words:?}");
        assert!(before.text().contains("Examples:") && !short.text().contains("Examples:"), "{words:?}");
        assert!(short.stdout.len() < before.stdout.len(), "{words:?}");
    }
    assert!(lab.run(&["help"]).good().text().contains("Understanding:"));
    lab.run(&["help", "rendr"]).refused(&["rendr"]);
}

#[test]
fn help_is_as_wide_as_the_terminal() {
    let lab = Lab::new();
    for words in [&["render", "-h"][..], &["render", "--help"], &["lab", "check", "--help"], &["diff", "--help"]] {
        let at = |columns| widest_line(run_at_width(&lab, words, columns).good().text());
        let (narrow, piped, wide) = (at(Some("70")), at(None), at(Some("150")));
        let is_as_wide = narrow <= 70 && (90..=100).contains(&piped) && (101..=150).contains(&wide);
        assert!(is_as_wide, "{words:?}: {narrow}, {piped}, {wide}");
    }
    // Paragraphs are wrapped at the width only, so every line but the last is full.
    let text = run_at_width(&lab, &["diff", "--help"], None).good();
    let mut paragraph = text.text().lines().skip_while(|line| !line.starts_with("An 8-bit step"));
    for line in paragraph.by_ref().take(2) {
        assert!((85..=100).contains(&line.len()), "{line}");
    }
}

#[test]
fn the_version_names_commit_opengl_and_page() {
    let lab = Lab::new();
    let short = lab.run(&["-V"]).good();
    let version = env!("CARGO_PKG_VERSION");
    assert!(short.text().starts_with(&format!("gonio {version}")) && short.text().lines().count() == 1);
    let long = lab.run(&["--version"]).good();
    let lines: Vec<&str> = long.text().lines().collect();
    assert_eq!(lines.len(), 3, "{lines:?}");
    assert_eq!(lines[0], short.text().trim_end());
    assert!(lines[1].starts_with("OpenGL: ") && lines[1].len() > 15, "{lines:?}");
    assert!(["Web page: embedded", "Web page: not embedded"].contains(&lines[2]), "{lines:?}");
    // The tests run in the repository: ten digits of the commit, and its date.
    let commit = lines[0].split_once('(').map_or("", |(_, commit)| commit);
    let digits = commit.chars().take_while(char::is_ascii_hexdigit).count();
    assert!(digits >= 10 && commit.ends_with(')') && commit.matches('-').count() == 2, "{}", lines[0]);
}

#[test]
fn closed_streams_stop_no_command() {
    let lab = Lab::new();
    for args in [vec!["help"], vec!["--help"], vec!["-V"], vec!["man"], vec!["completions", "bash"], vec!["licenses"]] {
        let mut child = lab.command(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let run = Run::of(child.wait_with_output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{args:?}");
    }
    // The note cannot be printed; the picture is written nevertheless.
    let args =
        ["render", &asset("cube.obj"), "-o", "a.png", "--size", "16x16", "--samples", "1", "--backend", "cpu", "-v"];
    let mut child = lab.command(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(0));
    assert_eq!(lab.names(), ["a.png"]);
}

#[test]
fn files_are_written_despite_a_closed_pipe() {
    let lab = Lab::new();
    let args = ["render", &asset("cube.obj"), "-o", "-", "-o", "a.png", "--size", "64x64", "--backend", "cpu", "-q"];
    let mut child = lab.command(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(0));
    assert_eq!(lab.names(), ["a.png"]);
}

#[test]
fn a_hyphen_is_stdout_for_every_output() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    for (name, shade) in [("a.png", 10), ("b.png", 90)] {
        image::GrayImage::from_pixel(128, 8, image::Luma([shade])).save(lab.path(name)).unwrap();
    }
    lab.run(&["lab", "reference", "ex04", "-o", "mine"]).good();
    lab.run(&["brdf", "export", "lambert", "-o", "lambert.binary"]).good();
    let check = ["lab", "check", "ex04", "mine"];
    for (args, file) in [
        (vec!["render", &cube, "--size", "16x16", "--samples", "1", "--backend", "cpu", "-q", "-o"], "o.png"),
        (vec!["scene", "builtin:cube", "-o"], "o.toml"),
        (vec!["convert", &cube, "--format", "glb"], "o.glb"),
        (vec!["convert", &cube, "--ascii", "--format", "ply"], "o.ply"),
        (
            vec!["environment", "convert", "debug", "--size", "32", "--to", "equirectangular", "--format", "hdr"],
            "o.hdr",
        ),
        (vec!["environment", "convert", "debug", "--size", "8", "--to", "ktx2"], "o.ktx2"),
        (vec!["diff", "a.png", "b.png", "-o"], "o.png"),
        (vec!["diff", "a.png", "b.png", "--wipe"], "o.png"),
        (vec!["diff", "a.png", "b.png", "--side-by-side"], "o.png"),
        (vec!["lab", "draw", "ex04", "--size", "32", "-o"], "o.png"),
        (vec!["brdf", "plot", "ward", "--format", "svg", "-o"], "o.svg"),
        (vec!["brdf", "plot", "ward", "--format", "png", "--size", "200x200", "-o"], "o.png"),
        (vec!["brdf", "export", "ward", "--format", "glsl", "-o"], "o.glsl"),
        (vec!["brdf", "fit", "lambert.binary", "--model", "lambert", "-o"], "o.toml"),
        ([&check[..], &["--junit"]].concat(), "o.xml"),
        ([&check[..], &["--gradescope"]].concat(), "o.json"),
        ([&check[..], &["--code-runner"]].concat(), "o.json"),
        ([&check[..], &["--page"]].concat(), "o.html"),
        ([&check[..], &["--sheet"]].concat(), "o.png"),
    ] {
        lab.run(&[&args[..], &[file]].concat()).good();
        let piped = lab.run(&[&args[..], &["-"]].concat()).good();
        assert!(piped.stdout == lab.read(file) && !piped.stdout.is_empty(), "{args:?}");
        std::fs::remove_file(lab.path(file)).unwrap();
    }
    // The numbers go to stderr.
    let run = lab.run(&["diff", "a.png", "b.png", "-o", "-"]).good();
    assert!(run.stderr.contains("SSIM"), "{}", run.stderr);
    assert_eq!(lab.names(), ["a.png", "b.png", "lambert.binary", "mine"]);
}

#[test]
fn stdout_takes_one_file() {
    let lab = Lab::new();
    let cube = asset("cube.obj");
    lab.render(&[&cube, "-o", "-", "-o", "-"]).refused(&["more than once"]);
    lab.run(&["diff", "a.png", "b.png", "-o", "-", "--wipe", "-"]).refused(&["more than once"]);
    lab.run(&["convert", &cube, "-", "--format", "glb", "--json"]).refused(&["--json", "stdout"]);
    lab.run(&["convert", &cube, "-"]).refused(&["--format"]);
    // Its material library would be a second file.
    lab.run(&["convert", &asset("still_life.obj"), "-", "--format", "obj"]).refused(&["2 files", "--format glb"]);
    lab.run(&["environment", "convert", "debug", "-", "--to", "faces"]).refused(&["six faces", "name a folder"]);
    lab.run(&["tour", "-o", "-"]).refused(&["several files", "name a folder"]);
    lab.run(&["lab", "start", "ex04", "-"]).refused(&["several files", "name a folder"]);
    lab.run(&["lab", "check", "ex04", ".", "-o", "-"]).refused(&["several files", "name a folder"]);
    assert!(lab.names().is_empty(), "{:?}", lab.names());
}

#[test]
fn verbose_reports_files_driver_and_times() {
    let lab = Lab::new();
    std::fs::copy(asset("cube.obj"), lab.path("cube.obj")).unwrap();
    std::fs::copy(asset("cube.mtl"), lab.path("cube.mtl")).unwrap();
    let args = ["render", "cube.obj", "-o", "a.png", "--size", "16x16", "--samples", "1", "--backend", "gl"];
    assert_eq!(lab.run(&args).good().stderr, "");
    let run = lab.run(&[&args[..], &["-v"]].concat()).good();
    for words in ["info: read `cube.obj`, ", "cube.mtl`, ", "info: driver: ", "info: times: ", "draw ", "took "] {
        assert!(run.stderr.contains(words), "`{words}` is not in: {}", run.stderr);
    }
    assert!(run.stdout.is_empty());
    let run = lab.run(&["inspect", "cube.obj", "--verbose"]).good();
    assert!(
        run.stderr.contains("info: read `cube.obj`, ") && run.stderr.contains("info: inspect took "),
        "{}",
        run.stderr
    );
    lab.run(&["inspect", "cube.obj", "-v", "-q"]).refused(&["--verbose", "--quiet"]);
}

#[test]
fn completions_exist_for_every_shell() {
    let lab = Lab::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let run = lab.run(&["completions", shell]).good();
        for word in ["gonio", "render", "texture-filter"] {
            assert!(run.text().contains(word), "{shell}: {word}");
        }
    }
    lab.run(&["completions", "tcsh"]).refused(&["tcsh", "bash"]);
}

#[test]
fn every_command_has_a_manual_page() {
    let lab = Lab::new();
    let page = lab.run(&["man"]).good();
    assert!(page.text().contains(".TH gonio 1") && page.text().contains("render"), "{}", page.text());
    assert_eq!(lab.run(&["man", "-"]).good().stdout, page.stdout);
    lab.run(&["man", "pages/man1"]).good();
    assert_eq!(lab.read("pages/man1/gonio.1"), page.stdout);
    for name in ["gonio-render.1", "gonio-lab-check.1", "gonio-environment-convert.1"] {
        let text = String::from_utf8(lab.read(&format!("pages/man1/{name}"))).unwrap();
        assert!(text.contains(".SH SYNOPSIS") && text.contains("Examples:"), "{name}");
    }
    assert!(!lab.path("pages/man1/gonio-lab-trial.1").exists());
}

#[test]
fn licences_are_printed() {
    let lab = Lab::new();
    let run = lab.run(&["licenses"]).good();
    for words in
        ["Third-party notices of gonio", "egui ", "clap ", "OFL-1.1", "TERMS AND CONDITIONS FOR USE", "Suzanne"]
    {
        assert!(run.text().contains(words), "{words}");
    }
    assert!(!run.text().contains("\\u{") && !run.text().contains("\\x"), "an escape");
}
