//! The cost of a light: the time of drawing one model under 1 to 1,000 point lights.

use crate::{Places, measure, models, table};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Numbers of lights.
const COUNTS: &[usize] = &[1, 3, 10, 30, 100, 300, 1000];
/// Runs of each count, alternating.
const ROUNDS: usize = 5;

/// Measures and prints. There is no required time: 1,000 lights must work, and their cost must be known.
pub fn run(places: &Places) -> Result<bool, String> {
    models::written(&places.out, "torus_5000.obj", || models::torus_obj(50, 50))?;
    let scenes: Vec<PathBuf> = COUNTS.iter().map(|&count| write_scene(&places.out, count)).collect::<Result<_, _>>()?;
    let mut times_ms: Vec<Vec<f64>> = vec![Vec::new(); COUNTS.len()];
    for round in 0..=ROUNDS {
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
    table::print(&format!("lights: 5,000 triangles, 1024x768, 4 samples, Phong; medians of {ROUNDS} runs"), &rows);
    let points: Vec<Value> = COUNTS.iter().zip(&medians).map(|(n, ms)| json!({"lights": n, "draw_ms": ms})).collect();
    table::write_json(&places.out, "lights", &json!({"points": points}))?;
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
