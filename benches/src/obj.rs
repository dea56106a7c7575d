//! Reads OBJ files and compares CPU time, wall time and memory with other readers, and with merely finding line ends.

use crate::models::{NGON_TRIANGLES, ngon_sphere, uv_sphere};
use crate::obj_readers::{self as readers, Reader, Reading};
use crate::{Places, measure, models};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// One thread: the required ratio of tobj's CPU time to gonio's.
const TOBJ_CPU_BAR: f64 = 4.5;
/// One thread: the allowed ratio of gonio's CPU time to that of finding line ends.
const NEWLINES_BAR: f64 = 6.0;
/// Two threads: the required ratio of tobj's wall time to gonio's.
const TOBJ_WALL_BAR: f64 = 6.5;
/// The allowed ratio of peak memory, without the mapped file, to the final buffers.
const MEMORY_BAR: f64 = 1.25;
/// Runs of slow readers.
const SLOW_ROUNDS: usize = 2;

/// A file to read.
struct Case {
    name: &'static str,
    file: &'static str,
    make: fn() -> String,
    triangles: u64,
    rounds: usize,
}

const CASES: [Case; 3] = [
    Case { name: "sphere", file: "uv_sphere_1001112.obj", make: || uv_sphere(708), triangles: 1_001_112, rounds: 11 },
    Case {
        name: "sphere of 5 million",
        file: "uv_sphere_5002284.obj",
        make: || uv_sphere(1582),
        triangles: 5_002_284,
        rounds: 3,
    },
    Case { name: "polygons", file: "ngon_sphere.obj", make: ngon_sphere, triangles: NGON_TRIANGLES, rounds: 11 },
];

/// Measures, prints, and returns whether the requirements are met.
pub fn run(places: &Places) -> Result<bool, String> {
    let (others, absent) = readers::others(&places.out);
    let mut held = true;
    let mut results = Vec::new();
    for case in &CASES {
        let path = places.out.join(case.file);
        if !path.exists() {
            println!("writing {}", path.display());
            let program = std::env::current_exe().map_err(|e| e.to_string())?;
            measure::process(Command::new(program).args([readers::MAKE, case.file]))?;
        }
        let (bars_held, result) = measure_case(case, &path, &others)?;
        held &= bars_held;
        results.push(result);
    }
    absent.iter().for_each(|line| println!("  {line}"));
    measure::write_json(&places.out, "obj", &json!({"cases": results, "absent": absent, "bars_held": held}))?;
    Ok(held)
}

/// Writes one of the files to read: `--make FILE`.
pub fn make(places: &Places, file: &str) -> Result<(), String> {
    let case = CASES.iter().find(|case| case.file == file).ok_or_else(|| format!("unknown file `{file}`"))?;
    models::written(&places.out, case.file, case.make).map(drop)
}

fn measure_case(case: &Case, path: &Path, others: &[Reader]) -> Result<(bool, Value), String> {
    let ours =
        [readers::gonio(1), readers::gonio(2), readers::newlines(), readers::tobj(), readers::newlines_at_once()];
    let mut contestants: Vec<(Reader, Vec<Reading>)> = Vec::new();
    let mut refusals = Vec::new();
    for reader in ours.iter().chain(others) {
        // The first run brings the file into memory and is not counted.
        match reader.read(path) {
            Ok(_) => contestants.push((reader.clone(), Vec::new())),
            Err(error) if contestants.len() < ours.len() => return Err(error),
            Err(error) => refusals.push(error),
        }
    }
    for round in 0..case.rounds {
        for (reader, readings) in contestants.iter_mut().filter(|(r, _)| !r.is_slow || round < SLOW_ROUNDS) {
            readings.push(reader.read(path)?);
        }
    }
    let file_size = std::fs::metadata(path).map_err(|e| e.to_string())?.len();
    let medians: Vec<(&str, Reading)> =
        contestants.iter().map(|(reader, readings)| (reader.name.as_str(), median(readings))).collect();
    let title = format!(
        "obj: {}, {} triangles, {:.0} MB; medians of {} alternating runs",
        case.name,
        case.triangles,
        file_size as f64 / 1e6,
        case.rounds
    );
    print(&title, &medians, file_size);
    println!("  peak MB is without the mapped file, but for whole processes and Node");
    refusals.iter().for_each(|line| println!("  {line}"));
    let held = judge(case, &medians);
    let rows: Vec<Value> = medians
        .iter()
        .map(|(name, r)| {
            json!({"name": name, "wall_s": r.wall_s, "cpu_s": r.cpu_s, "peak_bytes": r.peak_bytes,
                   "vertices": r.vertices, "triangles": r.triangles})
        })
        .collect();
    Ok((held, json!({"file": case.file, "size": file_size, "readers": rows, "refused": refusals, "bars_held": held})))
}

/// Returns the median of each number separately.
fn median(readings: &[Reading]) -> Reading {
    let of = |value: fn(&Reading) -> f64| measure::median(readings.iter().map(value));
    Reading {
        wall_s: of(|r| r.wall_s),
        cpu_s: of(|r| r.cpu_s),
        peak_bytes: of(|r| r.peak_bytes as f64) as u64,
        ..readings.first().copied().unwrap_or_default()
    }
}

fn print(title: &str, medians: &[(&str, Reading)], file_size: u64) {
    let heading = ["", "CPU s", "wall s", "CPU x", "wall x", "GB/s", "peak MB", "triangles"];
    let mut rows = vec![heading.map(String::from).to_vec()];
    let ours = medians[0].1;
    for (name, reading) in medians {
        rows.push(vec![
            (*name).to_owned(),
            format!("{:.3}", reading.cpu_s),
            format!("{:.3}", reading.wall_s),
            format!("{:.2}", reading.cpu_s / ours.cpu_s),
            format!("{:.2}", reading.wall_s / ours.wall_s),
            format!("{:.2}", file_size as f64 / 1e9 / reading.wall_s),
            format!("{:.1}", reading.peak_bytes as f64 / 1e6),
            if reading.triangles == 0 { String::new() } else { reading.triangles.to_string() },
        ]);
    }
    measure::print_table(title, &rows);
}

/// The first four are gonio on one thread and on two, counting line ends, tobj.
fn judge(case: &Case, medians: &[(&str, Reading)]) -> bool {
    let [one, two, newlines, tobj] = [0, 1, 2, 3].map(|i| medians[i].1);
    let mut held = measure::bar("one thread, CPU against tobj", tobj.cpu_s / one.cpu_s, " x", TOBJ_CPU_BAR, false);
    held &=
        measure::bar("one thread, CPU against finding line ends", one.cpu_s / newlines.cpu_s, " x", NEWLINES_BAR, true);
    held &= measure::bar("two threads, wall against tobj", tobj.wall_s / two.wall_s, " x", TOBJ_WALL_BAR, false);
    for (reading, threads) in [(one, "one thread"), (two, "two threads")] {
        let buffers = reading.vertices * 8 * 4 + reading.triangles * 3 * 4;
        let beyond = reading.peak_bytes as f64 / buffers as f64;
        held &= measure::bar(&format!("{threads}, memory over final buffers"), beyond, " x", MEMORY_BAR, true);
        if reading.triangles != case.triangles {
            println!("  MISSED {threads}: {} of {} triangles are there", reading.triangles, case.triangles);
            held = false;
        }
    }
    held
}
