//! `cargo xtask fuzz`: runs cargo-fuzz on every reader.

use crate::{fixtures, process, root};
use std::path::Path;
use std::process::{Command, ExitCode};

/// The targets in `fuzz/`, and the seeds of each: folders of files, and tables of test cases ([`TABLES`], or a `.txt`).
const TARGETS: &[(&str, &[&str])] = &[
    ("obj", &["crates/gonio-mesh/tests/obj.txt", "assets/models"]),
    ("mtl", &["crates/gonio-mesh/tests/mtl.txt", "crates/gonio-mesh/tests/obj.txt", "assets/models"]),
    ("gltf", &["crates/gonio-mesh/tests/gltf"]),
    ("collada", &["crates/gonio-mesh/tests/collada.txt"]),
    ("ply", &["assets/models"]),
    ("stl", &["assets/models"]),
    ("medit", &["crates/gonio-mesh/tests/medit.txt"]),
    (
        "any",
        &[
            "crates/gonio-mesh/tests/obj.txt",
            "crates/gonio-mesh/tests/mtl.txt",
            "crates/gonio-mesh/tests/collada.txt",
            "crates/gonio-mesh/tests/medit.txt",
            "crates/gonio-mesh/tests/gltf",
            "crates/gonio-mesh/tests/compression",
        ],
    ),
    ("explain", &["crates/gonio-mesh/tests/obj.txt", "crates/gonio-mesh/tests/mtl.txt"]),
    ("environment", &["crates/gonio-image/tests/seeds.txt"]),
    ("face_names", &["crates/gonio-environment/tests/names.txt"]),
    ("glsl", &["crates/gonio-glsl/tests/pairs.txt", "exercises/models"]),
    ("interpret", &["crates/gonio-glsl/tests/pairs.txt", "exercises"]),
    ("brdf", &["crates/gonio-bsdf/tests/functions.txt"]),
    ("submission", &["crates/gonio-glsl/tests/pairs.txt", "exercises", TABLES]),
    ("buffer", &["crates/gonio-exercises/tests/buffers.txt"]),
    ("host", &["exercises/ex11-texture-unit/host"]),
    (BATCH, &["crates/gonio-exercises/tests/batches.txt"]),
];

/// The folder of tables of submissions.
const TABLES: &str = "crates/gonio-check/corpus";

/// The target that runs the whole program.
const BATCH: &str = "batch";

const DEFAULT_MINUTES: u64 = 20;

/// Runs the named targets or all, one after the other, `--minutes N` each.
pub fn run(words: &[&str]) -> ExitCode {
    let (targets, minutes) = match arguments(words) {
        Ok(arguments) => arguments,
        Err(error) => {
            eprintln!("xtask: {error}");
            return ExitCode::from(2);
        }
    };
    let root = root();
    let fuzz = process::run(Command::new("cargo").args(["+nightly", "fuzz", "--version"]).current_dir(&root));
    if !fuzz.success {
        eprintln!(
            "xtask: cargo-fuzz or a nightly compiler is missing; run: rustup toolchain install nightly && cargo install cargo-fuzz"
        );
        return ExitCode::from(2);
    }
    let mut code = 0;
    for (name, seeds) in targets {
        println!("fuzz {name}: {minutes} minutes");
        match fuzz_one(&root, name, seeds, minutes) {
            Ok(true) => println!("fuzz {name}: nothing found"),
            Ok(false) => {
                println!(
                    "fuzz {name}: FOUND something; the file is in fuzz/artifacts/{name}: fix the error and keep the file in \
                     {}/{name}",
                    found_in(name)
                );
                code = 1;
            }
            Err(error) => {
                eprintln!("xtask: {error}");
                return ExitCode::from(2);
            }
        }
    }
    ExitCode::from(code)
}

type Target = (&'static str, &'static [&'static str]);

fn arguments(words: &[&str]) -> Result<(Vec<Target>, u64), String> {
    let mut targets = Vec::new();
    let mut minutes = DEFAULT_MINUTES;
    let mut words = words.iter();
    while let Some(&word) = words.next() {
        if word == "--minutes" {
            let number = words.next().and_then(|n| n.parse().ok()).filter(|n| *n > 0);
            minutes = number.ok_or("--minutes needs a positive number")?;
        } else {
            let known: Vec<&str> = TARGETS.iter().map(|(name, _)| *name).collect();
            let target = TARGETS.iter().find(|(name, _)| *name == word);
            targets
                .push(*target.ok_or_else(|| format!("unknown fuzz target `{word}`; targets: {}", known.join(", ")))?);
        }
    }
    if targets.is_empty() {
        targets = TARGETS.to_vec();
    }
    Ok((targets, minutes))
}

/// The folder of files that once made a target fail.
fn found_in(name: &str) -> &'static str {
    match name {
        "environment" | "face_names" => "crates/gonio-environment/tests/found",
        "glsl" => "crates/gonio-glsl/tests/found",
        "interpret" => "crates/gonio-interpreter/tests/found",
        "submission" => "crates/gonio-check/tests/found",
        "brdf" => "crates/gonio-bsdf/tests/found",
        "buffer" | "host" | BATCH => "crates/gonio-exercises/tests/found",
        _ => "crates/gonio-mesh/tests/found",
    }
}

/// Runs one target. Returns whether it found nothing.
fn fuzz_one(root: &Path, name: &str, seeds: &[&str], minutes: u64) -> Result<bool, String> {
    // Interesting inputs are kept between runs; libFuzzer writes to the first folder only.
    let corpus = root.join("fuzz/corpus").join(name);
    std::fs::create_dir_all(&corpus).map_err(|e| format!("cannot make {}: {e}", corpus.display()))?;
    let found = root.join(found_in(name)).join(name);
    let mut folders = Vec::new();
    for seed in seeds {
        let is_table = *seed == TABLES || seed.ends_with(".txt");
        folders.push(if is_table { fixtures::unpack(root, seed, name)? } else { root.join(seed) });
    }
    folders.extend(found.exists().then_some(found));
    let mut command = Command::new("cargo");
    command.args(["+nightly", "fuzz", "run", name]).arg(&corpus).args(folders).current_dir(root);
    // Seconds per input. A batch starts one process per submission.
    let mut most_seconds = 10;
    if name == BATCH {
        let built = process::run(process::cargo(root).args(["build", "--locked", "--package", "gonio"]));
        if !built.success {
            return Err(format!("cannot build gonio, which the target {BATCH} runs:\n{}", built.text));
        }
        command.env("GONIO_PROGRAM", root.join("target/debug/gonio"));
        most_seconds = 200;
    }
    // 64 KiB suffice for every structure; no such file may take anywhere near 2 GiB or 10 seconds.
    command.args(["--", "-max_len=65536", "-rss_limit_mb=2048", "-print_final_stats=1"]);
    command.arg(format!("-timeout={most_seconds}"));
    command.arg(format!("-max_total_time={}", 60 * minutes));
    command.status().map(|status| status.success()).map_err(|e| format!("cannot run cargo fuzz: {e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_target_has_a_file_and_seeds() {
        let root = root();
        for (name, seeds) in TARGETS {
            for seed in *seeds {
                let path = root.join(seed);
                assert_eq!(path.is_file(), seed.ends_with(".txt"), "{name}: {seed}");
                assert!(path.exists(), "{name}: {seed}");
            }
        }
        let manifest = std::fs::read_to_string(root.join("fuzz/Cargo.toml")).unwrap_or_default();
        let bins: Vec<&str> = manifest.split("[[bin]]").skip(1).collect();
        assert_eq!(bins.len(), TARGETS.len());
        for bin in bins {
            let value = |key: &str| {
                bin.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = ")).unwrap_or_default()
            };
            let (name, path) = (value("name").trim_matches('"'), value("path").trim_matches('"'));
            assert!(TARGETS.iter().any(|(target, _)| *target == name), "{name}");
            assert!(root.join("fuzz").join(path).is_file(), "{name}: {path}");
        }
    }

    #[test]
    fn words() {
        assert_eq!(arguments(&[]).map(|(targets, minutes)| (targets.len(), minutes)), Ok((TARGETS.len(), 20)));
        let one =
            arguments(&["ply", "--minutes", "3"]).map(|(targets, minutes)| (targets[0].0, targets.len(), minutes));
        assert_eq!(one, Ok(("ply", 1, 3)));
        assert!(arguments(&["plu"]).is_err() && arguments(&["--minutes", "0"]).is_err());
    }
}
