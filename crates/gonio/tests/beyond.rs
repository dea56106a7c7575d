//! `gonio beyond`: its files, its report, its films, and bad input.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::Lab;
use std::process::{Command, Stdio};
use std::time::Duration;

const SMALL: [&str; 4] = ["--size", "24x18", "--samples", "1"];

#[test]
fn every_station_writes_its_pictures_plot_and_page() {
    let lab = Lab::new();
    let listed = lab.run(&["beyond", "list", "--json"]).good().json();
    let stations = listed["stations"].as_array().unwrap();
    assert_eq!(stations.len(), 10);
    for station in stations {
        let name = station["name"].as_str().unwrap();
        let report = lab.run(&[&["beyond", name, "-o", "out", "--json"][..], &SMALL].concat()).good().json();
        assert_eq!((report["failed"].as_u64(), report["station"].as_str()), (Some(0), Some(name)));
        assert!(report["checks"].as_array().unwrap().len() >= 4, "{name}");
        for file in report["files"].as_array().unwrap() {
            assert!(lab.path("out").join(file.as_str().unwrap()).is_file(), "{file}");
        }
        let page = std::fs::read_to_string(lab.path(&format!("out/{name}.md"))).unwrap();
        for picture in station["pictures"].as_array().unwrap() {
            let file = format!("{name}-{}", picture["name"].as_str().unwrap());
            assert!(page.contains(&format!("]({file}.png)")), "{file}");
            assert!(lab.path(&format!("out/{file}.exr")).is_file(), "{file}");
        }
        assert!(page.contains(&format!("]({name}-plot.svg)")) && page.contains("| holds |"), "{name}");
    }
}

#[test]
fn parameters_and_the_seed_change_the_picture_and_nothing_else_does() {
    let lab = Lab::new();
    let picture = |more: &[&str]| {
        let args = [&["beyond", "phosphorescence", "-o", "out", "--quiet"][..], &SMALL, more].concat();
        lab.run(&args).good();
        std::fs::read(lab.path("out/phosphorescence-stars.png")).unwrap()
    };
    let plain = picture(&[]);
    assert_eq!(picture(&["--threads", "1"]), plain);
    assert_eq!(picture(&["--time", "3", "--set", "charge=6"]), plain);
    let others = [&["--time", "30"][..], &["--set", "charge=0.5"], &["--seed", "1"]].map(picture);
    assert!(others.iter().all(|other| *other != plain));
}

#[test]
fn a_film_has_its_frames() {
    let lab = Lab::new();
    let args = ["beyond", "interference", "-o", "out", "--picture", "wand", "--frames", "3"];
    lab.run(&[&args[..], &SMALL].concat()).good();
    let film = std::fs::read(lab.path("out/interference-film.png")).unwrap();
    let control = film.windows(4).position(|name| name == b"acTL").unwrap();
    assert_eq!(film[control + 4..control + 8], [0, 0, 0, 3]);
    assert!(!lab.path("out/interference-disc.png").exists(), "one picture was asked for");
}

/// A film of hours is interrupted while its frames are computed.
#[test]
fn an_interrupted_film_leaves_nothing_and_what_was_there() {
    let lab = Lab::new();
    lab.write("kept.txt", "mine");
    for signal in ["INT", "TERM", "KILL"] {
        let args = ["beyond", "fog", "-o", "new/out", "--frames", "100", "--size", "600x400"];
        let mut child = lab.command(&args).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(800));
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        let sent = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
        assert!(sent.success() && !child.wait().unwrap().success(), "it survived SIG{signal}");
        assert_eq!(lab.names(), ["kept.txt"], "after SIG{signal}");
    }
}

#[test]
fn a_window_and_files_exclude_each_other() {
    let lab = Lab::new();
    lab.run(&["beyond", "fog", "--window", "-o", "out"]).refused(&["--window", "--output"]);
    lab.run(&["beyond", "fog", "--window", "--set", "g=2"]).refused(&["`2`", "from -0.9 to 0.9"]);
}

#[test]
fn bad_values_are_refused_before_anything_is_written() {
    let lab = Lab::new();
    std::fs::write(lab.path("file"), "").unwrap();
    let cases: [(&[&str], &[&str]); 16] = [
        (&["nothing", "-o", "out"], &["nothing", "polarisation"]),
        (&["polarisation"], &["-o DIR"]),
        (&["polarisation", "-o", "-"], &["several files"]),
        (&["polarisation", "-o", "file"], &["is a file"]),
        (&["polarisation", "-o", "out", "--set", "angle=181"], &["`181`", "from 0 to 180 degrees"]),
        (&["polarisation", "-o", "out", "--set", "angel=1"], &["`angel`", "angle, index"]),
        (&["polarisation", "-o", "out", "--set", "angle"], &["NAME=VALUE"]),
        (&["polarisation", "-o", "out", "--time", "1"], &["`time`", "angle"]),
        (&["polarisation", "-o", "out", "--picture", "lake"], &["`lake`", "pond, degree"]),
        (&["polarisation", "-o", "out", "--frames", "0"], &["`0`"]),
        (&["polarisation", "-o", "out", "--samples", "3"], &["`3`", "1, 2, 4, 8 or 16"]),
        (&["polarisation", "-o", "out", "--size", "0x4"], &["0x4 has no pixels"]),
        (&["polarisation", "-o", "out", "--seed", "-1"], &["`-1`"]),
        (&["polarisation", "-o", "out", "--threads", "0"], &["`0`"]),
        (&["phosphorescence", "-o", "out", "--time", "nan"], &["`nan`", "from -2 to 60 s"]),
        (&["phosphorescence", "-o", "out", "--time", "-3"], &["`-3`", "from -2 to 60"]),
    ];
    for (args, pieces) in cases {
        lab.run(&[&["beyond"][..], args].concat()).refused(pieces);
        assert!(!lab.path("out").exists(), "{args:?}");
    }
}
