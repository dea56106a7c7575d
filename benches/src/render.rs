//! Renders a model at 1024x768 to a PNG as a whole process, in alternating runs with other programs that do the same: a small
//! model, for which the start counts, and one of a million triangles, for which reading counts. Then the cost of a light: the drawing time of one model under 1 to 1,000 point lights.

use crate::measure::{self, Cost};
use crate::{Places, models, peers};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

const WIDTH: u32 = 1024;
const HEIGHT: u32 = 768;
/// Runs of each program before the measured ones, which fill the caches of files and shaders.
const WARM_UP: usize = 2;

/// A model and its requirements.
struct Case {
    name: &'static str,
    what: &'static str,
    /// Measured runs of each program.
    rounds: usize,
    /// Returns whether the requirements are met.
    judge: fn(ours: Cost, peers: &[(String, Cost)]) -> bool,
}

/// 5,000 triangles: at most 0.12 s, and a third of the time of the fastest other program.
const SMALL: Case = Case {
    name: "render",
    what: "5,000 triangles",
    rounds: 21,
    judge: |ours, peers| {
        let held = measure::bar("wall time", ours.wall_s, " s", 0.12, true);
        let fastest = peers.iter().map(|(_, cost)| cost.wall_s).min_by(f64::total_cmp).unwrap_or(0.0);
        measure::bar("against the fastest peer", fastest / ours.wall_s, " x", 3.0, false) && held
    },
};

/// A million triangles: 3.5 times less CPU time than each other program.
const LARGE: Case = Case {
    name: "render-large",
    what: "1,001,112 triangles",
    rounds: 9,
    judge: |ours, peers| {
        let less = |(name, cost): &(String, Cost)| {
            measure::bar(&format!("CPU time against {name}"), cost.cpu_s / ours.cpu_s, " x", 3.5, false)
        };
        // All are printed, even after one that is missed.
        peers.iter().map(less).filter(|held| !held).count() == 0
    },
};

pub fn run(places: &Places) -> Result<bool, String> {
    let model = models::written(&places.out, "torus_5000.obj", || models::torus_obj(50, 50))?;
    compare(places, &model, &SMALL)
}

pub fn run_large(places: &Places) -> Result<bool, String> {
    let model = models::written(&places.out, "sphere_1001112.obj", || models::sphere_obj(708, 708))?;
    compare(places, &model, &LARGE)
}

struct Contestant {
    name: String,
    picture: PathBuf,
    command: Box<dyn Fn(&Path) -> Command>,
    costs: Vec<Cost>,
}

/// Measures, prints, and returns whether the requirements are met.
fn compare(places: &Places, model: &Path, case: &Case) -> Result<bool, String> {
    let mut contestants = vec![gonio(places, model, case)];
    let mut absent = Vec::new();
    match peers::install(&places.out) {
        Err(error) => absent.push(format!("no peer: {error}")),
        Ok(peers) => {
            for peer in peers {
                let (name, model) = (peer.name.to_owned(), model.to_owned());
                let picture = places.out.join(format!("{}-{}.png", case.name, contestants.len()));
                let command = Box::new(move |out: &Path| peer.command(&model, out, WIDTH, HEIGHT));
                contestants.push(Contestant { name, picture, command, costs: Vec::new() });
            }
        }
    }
    // Another program that cannot draw here is left out with a message; gonio must draw.
    let mut ready = Vec::new();
    for contestant in contestants {
        let warm = (0..WARM_UP).try_for_each(|_| once(&contestant).map(drop));
        match warm {
            Ok(()) => ready.push(contestant),
            Err(error) if ready.is_empty() => return Err(error),
            Err(error) => absent.push(format!("{} does not run here: {error}", contestant.name)),
        }
    }
    for _ in 0..case.rounds {
        for contestant in &mut ready {
            let cost = once(contestant)?;
            contestant.costs.push(cost);
        }
    }
    report(places, case, &ready, &absent)
}

fn gonio(places: &Places, model: &Path, case: &Case) -> Contestant {
    let (program, model) = (places.gonio.clone(), model.to_owned());
    let command = Box::new(move |out: &Path| {
        let mut command = Command::new(&program);
        command.arg("render").arg(&model).arg("-o").arg(out).args(["--quiet", "--backend", "gl"]);
        command.args(["--size", &format!("{WIDTH}x{HEIGHT}")]);
        command
    });
    Contestant {
        name: "gonio render".into(),
        picture: places.out.join(format!("{}-0.png", case.name)),
        command,
        costs: Vec::new(),
    }
}

/// Runs a program once and checks that it drew.
fn once(contestant: &Contestant) -> Result<Cost, String> {
    let _ = std::fs::remove_file(&contestant.picture);
    let cost = measure::process(&mut (contestant.command)(&contestant.picture))?;
    let bytes = std::fs::read(&contestant.picture).map_err(|e| format!("{}: no picture: {e}", contestant.name))?;
    match png_size(&bytes) {
        Some((WIDTH, HEIGHT)) => Ok(cost),
        size => Err(format!("{}: wrong size of the picture: {size:?}", contestant.name)),
    }
}

/// Returns width and height of a PNG.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    if bytes.starts_with(b"\x89PNG") { Some((number(16)?, number(20)?)) } else { None }
}

fn report(places: &Places, case: &Case, contestants: &[Contestant], absent: &[String]) -> Result<bool, String> {
    let medians: Vec<Cost> = contestants.iter().map(|c| measure::median_cost(&c.costs)).collect();
    let ours = medians[0];
    let mut rows = vec![["", "wall s", "CPU s", "wall x", "CPU x"].map(String::from).to_vec()];
    for (contestant, cost) in contestants.iter().zip(&medians) {
        rows.push(vec![
            contestant.name.clone(),
            format!("{:.3}", cost.wall_s),
            format!("{:.3}", cost.cpu_s),
            format!("{:.2}", cost.wall_s / ours.wall_s),
            format!("{:.2}", cost.cpu_s / ours.cpu_s),
        ]);
    }
    measure::print_table(
        &format!("{}: {}, {WIDTH}x{HEIGHT}, to PNG; medians of {} alternating runs", case.name, case.what, case.rounds),
        &rows,
    );
    for line in absent {
        println!("  {line}");
    }
    let peers: Vec<(String, Cost)> =
        contestants.iter().zip(&medians).skip(1).map(|(c, cost)| (c.name.clone(), *cost)).collect();
    let held = if peers.is_empty() {
        println!("  MISSED no peer to compare with");
        false
    } else {
        (case.judge)(ours, &peers)
    };
    let rows: Vec<_> = contestants
        .iter()
        .zip(&medians)
        .map(|(c, m)| json!({"name": c.name, "wall_s": m.wall_s, "cpu_s": m.cpu_s, "runs": c.costs.len()}))
        .collect();
    measure::write_json(&places.out, case.name, &json!({"contestants": rows, "absent": absent, "bars_held": held}))?;
    Ok(held)
}

/// Numbers of lights.
const COUNTS: &[usize] = &[1, 3, 10, 30, 100, 300, 1000];
/// Runs of each count, alternating.
const LIGHT_ROUNDS: usize = 5;

/// Measures and prints. There is no required time: 1,000 lights must work, and their cost must be known.
pub fn run_lights(places: &Places) -> Result<bool, String> {
    models::written(&places.out, "torus_5000.obj", || models::torus_obj(50, 50))?;
    let scenes: Vec<PathBuf> = COUNTS.iter().map(|&count| write_scene(&places.out, count)).collect::<Result<_, _>>()?;
    let mut times_ms: Vec<Vec<f64>> = vec![Vec::new(); COUNTS.len()];
    for round in 0..=LIGHT_ROUNDS {
        for (scene, times) in scenes.iter().zip(&mut times_ms) {
            let time = draw_time_ms(places, scene)?;
            // The first round fills caches.
            if round > 0 {
                times.push(time);
            }
        }
    }
    let medians: Vec<f64> = times_ms.iter().map(|times| measure::median(times.iter().copied())).collect();
    let mut rows = vec![["lights", "draw ms", "ms per light more"].map(String::from).to_vec()];
    for (index, (count, ms)) in COUNTS.iter().zip(&medians).enumerate() {
        let slope = match index {
            0 => String::new(),
            _ => format!("{:.3}", (ms - medians[index - 1]) / (count - COUNTS[index - 1]) as f64),
        };
        rows.push(vec![count.to_string(), format!("{ms:.2}"), slope]);
    }
    measure::print_table(
        &format!("lights: 5,000 triangles, 1024x768, 4 samples, Phong; medians of {LIGHT_ROUNDS} runs"),
        &rows,
    );
    let points: Vec<Value> = COUNTS.iter().zip(&medians).map(|(n, ms)| json!({"lights": n, "draw_ms": ms})).collect();
    measure::write_json(&places.out, "lights", &json!({"points": points}))?;
    Ok(true)
}

/// Writes a scene of the torus under `count` point lights on a spiral around it. Their sum does not depend on the count.
fn write_scene(folder: &Path, count: usize) -> Result<PathBuf, String> {
    let mut text = String::from("[[object]]\nmodel = \"torus_5000.obj\"\n");
    for i in 0..count {
        let height = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
        let (sin, cos) = (i as f64 * 2.399_963).sin_cos();
        let ring = 3.0 * (1.0 - height * height).sqrt();
        let _ = write!(
            text,
            "\n[[light]]\nkind = \"point\"\nposition = [{:.4}, {:.4}, {:.4}]\nintensity = {:.6}\n",
            ring * cos,
            3.0 * height,
            ring * sin,
            1.5 / count as f64
        );
    }
    let path = folder.join(format!("lights_{count}.toml"));
    std::fs::write(&path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    Ok(path)
}

/// Returns the drawing time that `gonio render --json` reports, in milliseconds.
fn draw_time_ms(places: &Places, scene: &Path) -> Result<f64, String> {
    let out = places.out.join("lights.png");
    let output = Command::new(&places.gonio)
        .arg("render")
        .arg(scene)
        .arg("-o")
        .arg(&out)
        .args(["--json", "--backend", "gl"])
        .output()
        .map_err(|e| format!("cannot run {}: {e}", places.gonio.display()))?;
    if !output.status.success() {
        return Err(format!("gonio render failed: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    let report: Value = serde_json::from_slice(&output.stdout).map_err(|e| format!("gonio render --json: {e}"))?;
    draw_time_in(&report).ok_or_else(|| format!("gonio render --json reports no drawing time: {report}"))
}

fn draw_time_in(report: &Value) -> Option<f64> {
    report["times_ms"]["draw"].as_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_a_png_is_read() {
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
        png.extend([0, 0, 4, 0, 0, 0, 3, 0]);
        assert_eq!(png_size(&png), Some((1024, 768)));
        assert_eq!(png_size(b"P6 1024 768"), None);
        assert_eq!(png_size(b"\x89PNG"), None);
    }
}
