//! Readers of OBJ files, each in a separate process: this program or another one.

use crate::measure;
use gonio_mesh::{Limits, NoSidecars, obj};
use gonio_scene::files::{Disk, FileSource};
use serde_json::{Value, json};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use wait4::Wait4;

/// The argument with which this program writes one of the files: `gonio-bench --make FILE`. A separate process does it, so
/// that its memory is not counted as the readers'.
pub const MAKE: &str = "--make";

/// The argument with which this program reads one file and prints the cost: `gonio-bench --read READER FILE`.
pub const READ: &str = "--read";

/// A way to read a file.
#[derive(Clone)]
pub struct Reader {
    /// The name in tables.
    pub name: String,
    /// Whether it is so slow that it is run only a few times.
    pub is_slow: bool,
    run: Run,
}

#[derive(Clone)]
enum Run {
    /// This program with this number of threads.
    Itself {
        reader: &'static str,
        threads: usize,
    },
    Assimp,
    /// Node, with the folder in which `three` is installed.
    Three(PathBuf),
}

/// The cost of reading a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reading {
    /// From start to end, seconds.
    pub wall_s: f64,
    /// On all cores, seconds.
    pub cpu_s: f64,
    /// Peak memory, without pages of mapped files where the system reports those.
    pub peak_bytes: u64,
    /// Number of vertices, if the reader reports it.
    pub vertices: u64,
    /// Number of triangles, if the reader reports it.
    pub triangles: u64,
}

/// Gonio's own reader.
pub fn gonio(threads: usize) -> Reader {
    itself(&format!("gonio, {threads} thread{}", if threads == 1 { "" } else { "s" }), "gonio", threads, false)
}

/// Finding each line end in turn, as any reader of lines must: the lower bound.
pub fn newlines() -> Reader {
    itself("newlines, one by one (memchr)", "newlines", 1, false)
}

/// Counting line ends, many at a time: the limit of memory bandwidth.
pub fn newlines_at_once() -> Reader {
    itself("newlines, at once (memchr)", "newlines-at-once", 1, false)
}

/// The crate that the requirements refer to.
pub fn tobj() -> Reader {
    itself("tobj", "tobj", 1, false)
}

fn itself(name: &str, reader: &'static str, threads: usize, is_slow: bool) -> Reader {
    Reader { name: name.to_owned(), is_slow, run: Run::Itself { reader, threads } }
}

/// Other programs, and messages about missing ones.
pub fn others(folder: &Path) -> (Vec<Reader>, Vec<String>) {
    let mut readers = vec![itself("obj-rs", "obj-rs", 1, true)];
    let mut absent = Vec::new();
    match Command::new("assimp").arg("version").stdout(Stdio::null()).stderr(Stdio::null()).status() {
        Ok(status) if status.success() => {
            readers.push(Reader { name: "assimp (whole process)".into(), is_slow: true, run: Run::Assimp });
        }
        _ => {
            absent.push("assimp is not installed: apt install assimp-utils, or https://github.com/assimp/assimp".into())
        }
    }
    match three(folder) {
        Ok(place) => readers.push(Reader { name: "three.js (Node)".into(), is_slow: true, run: Run::Three(place) }),
        Err(error) => absent.push(error),
    }
    (readers, absent)
}

/// Pinned, so that ratios stay comparable over time.
const THREE: &str = "three@0.180.0";

/// Installs three.js on first use.
fn three(folder: &Path) -> Result<PathBuf, String> {
    let place = folder.join("node_modules/three/examples/jsm/loaders/OBJLoader.js");
    if !place.exists() {
        println!("installing {THREE} into {}", folder.display());
        let mut npm = Command::new("npm");
        npm.args(["install", "--silent", "--no-save", "--prefix"]).arg(folder).arg(THREE);
        let output = npm.output().map_err(|_| "three.js needs Node: install nodejs and npm".to_owned())?;
        if !place.exists() {
            let errors = String::from_utf8_lossy(&output.stderr).trim().to_owned();
            return Err(format!("cannot install three.js (npm install {THREE}): {errors}"));
        }
    }
    Ok(place)
}

impl Reader {
    /// Reads a file once and returns the cost.
    pub fn read(&self, file: &Path) -> Result<Reading, String> {
        let failed = |why: String| format!("{}: {why}", self.name);
        let mut command = match &self.run {
            Run::Itself { reader, threads } => {
                let program = std::env::current_exe().map_err(|e| failed(e.to_string()))?;
                let mut command = Command::new(program);
                command.args([READ, reader]).arg(file).env("RAYON_NUM_THREADS", threads.to_string());
                command
            }
            Run::Assimp => {
                let mut command = Command::new("assimp");
                command.arg("info").arg(file).arg("--raw").arg("--silent");
                command
            }
            Run::Three(loader) => {
                let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/three_read.mjs");
                let mut command = Command::new("node");
                command.arg("--max-old-space-size=16384").arg(script).arg(loader).arg(file);
                command
            }
        };
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        let start = std::time::Instant::now();
        let mut child = command.spawn().map_err(|e| failed(e.to_string()))?;
        let output = child.stdout.take().map(std::io::read_to_string);
        let used = child.wait4().map_err(|e| failed(e.to_string()))?;
        let wall_s = start.elapsed().as_secs_f64();
        let output = output.and_then(Result::ok).unwrap_or_default();
        if !used.status.success() {
            return Err(failed(format!(
                "cannot read {}: {}",
                file.display(),
                output.lines().last().unwrap_or("no output")
            )));
        }
        let cpu_s = (used.rusage.utime + used.rusage.stime).as_secs_f64();
        let whole = Reading { wall_s, cpu_s, peak_bytes: used.rusage.maxrss, ..Reading::default() };
        Ok(match self.run {
            Run::Assimp => Reading {
                vertices: number_after(&output, "Vertices:"),
                triangles: number_after(&output, "Faces:"),
                ..whole
            },
            _ => from_json(&output, whole.peak_bytes).ok_or_else(|| failed(format!("unexpected output {output:?}")))?,
        })
    }
}

/// Returns the number after a word, or 0.
fn number_after(text: &str, word: &str) -> u64 {
    text.split_once(word).and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}

fn from_json(output: &str, peak_of_process: u64) -> Option<Reading> {
    let output: Value = serde_json::from_str(output.trim()).ok()?;
    Some(Reading {
        wall_s: output["wall_s"].as_f64()?,
        cpu_s: output["cpu_s"].as_f64()?,
        peak_bytes: output["peak_bytes"].as_u64().unwrap_or(peak_of_process),
        vertices: output["vertices"].as_u64()?,
        triangles: output["triangles"].as_u64()?,
    })
}

/// Reads a file and prints the cost as JSON: `--read READER FILE`.
pub fn child(arguments: &[String]) -> Result<(), String> {
    let [reader, file] = arguments else { return Err(format!("{READ} READER FILE")) };
    let file = Path::new(file);
    let (sizes, cost) = measure::here(|| match reader.as_str() {
        "gonio" => read_gonio(file),
        "newlines" => {
            let bytes = Disk.read(file).map_err(|e| e.to_string())?;
            let mut count = 0;
            memchr::memchr_iter(b'\n', &bytes).for_each(|place| count += u64::from(std::hint::black_box(place) > 0));
            std::mem::forget(bytes);
            Ok((count, 0))
        }
        "newlines-at-once" => {
            let bytes = Disk.read(file).map_err(|e| e.to_string())?;
            let count = memchr::memchr_iter(b'\n', &bytes).count();
            std::mem::forget(bytes);
            Ok((count as u64, 0))
        }
        "tobj" => read_tobj(file),
        "obj-rs" => read_obj_rs(file),
        unknown => Err(format!("unknown reader `{unknown}`")),
    });
    let (vertices, triangles) = sizes?;
    println!(
        "{}",
        json!({"wall_s": cost.wall_s, "cpu_s": cost.cpu_s, "vertices": vertices, "triangles": triangles,
               "peak_bytes": peak_memory()})
    );
    Ok(())
}

/// Returns the peak memory of this process without pages that the system can read from files again: the mapped model and
/// the program itself. 0 if the system does not report it.
///
/// The figure that the system reports for ended processes is not usable: a child starts with its parent's.
fn peak_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kilobytes = |name: &str| number_after(&status, name);
    1024 * kilobytes("VmHWM:").saturating_sub(kilobytes("RssFile:"))
}

// The result of each reader is leaked: freeing it is not part of reading.

fn read_gonio(file: &Path) -> Result<(u64, u64), String> {
    let bytes = Disk.read(file).map_err(|e| e.to_string())?;
    let model = obj::read(&bytes, &mut NoSidecars, &Limits::default()).map_err(|e| e.to_string())?;
    let sizes = (model.mesh.positions.len() as u64, model.mesh.triangle_count() as u64);
    std::mem::forget((model, bytes));
    Ok(sizes)
}

fn read_tobj(file: &Path) -> Result<(u64, u64), String> {
    let (models, _) = tobj::load_obj(file, &tobj::GPU_LOAD_OPTIONS).map_err(|e| e.to_string())?;
    let sum = |length: fn(&tobj::Mesh) -> usize| models.iter().map(|model| length(&model.mesh) as u64 / 3).sum();
    let sizes = (sum(|mesh| mesh.positions.len()), sum(|mesh| mesh.indices.len()));
    std::mem::forget(models);
    Ok(sizes)
}

fn read_obj_rs(file: &Path) -> Result<(u64, u64), String> {
    let input = BufReader::new(File::open(file).map_err(|e| e.to_string())?);
    let model: ::obj::Obj<::obj::TexturedVertex, u32> = ::obj::load_obj(input).map_err(|e| e.to_string())?;
    let sizes = (model.vertices.len() as u64, model.indices.len() as u64 / 3);
    std::mem::forget(model);
    Ok(sizes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_behind_words() {
        assert_eq!(number_after("Meshes:  1\nFaces:      1001112\n", "Faces:"), 1_001_112);
        assert_eq!(number_after("nothing", "Faces:"), 0);
    }
}
