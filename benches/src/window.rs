//! The overhead of the window: a light is dragged in a scene of 100,000 triangles, and the renderer alone draws the same
//! pictures.

use crate::screen::Screen;
use crate::window_process::{self, ALL_SAMPLES, AS_SHIPPED, FRAMES, TURNS};
use crate::{Places, measure, models};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Stdio};

/// 2 * 250 * (201 - 1) triangles.
const SECTORS: usize = 250;
const RINGS: usize = 201;
const TRIANGLES: u64 = 100_000;
/// The window's size in pixels.
const SIZE: [u32; 2] = [1280, 800];
/// The allowed frame time as a multiple of the bare renderer's.
const BAR: f64 = 1.15;

/// Measures, prints, and returns whether the requirement is met.
pub fn run(places: &Places) -> Result<bool, String> {
    models::written(&places.out, "sphere_100k.obj", || models::sphere_obj(SECTORS, RINGS))?;
    let scene = places.out.join("window.toml");
    // In front of the sphere and within the picture.
    let text = "[[object]]\nmodel = \"sphere_100k.obj\"\n\n[[light]]\nkind = \"point\"\nposition = [0.9, 0.5, 1.1]\n";
    std::fs::write(&scene, text).map_err(|e| format!("cannot write {}: {e}", scene.display()))?;
    let screen = Screen::new(SIZE, &[])?;
    let mut held = true;
    let mut results = Vec::new();
    for way in [ALL_SAMPLES, AS_SHIPPED] {
        let result = measured(places, &screen, &scene, way)?;
        held &= print_result(way, &result)?;
        results.push(json!({ "way": way, "measured": result }));
    }
    measure::write_json(&places.out, "window", &json!({ "bar_held": held, "ways": results }))?;
    Ok(held)
}

/// Runs the window's process and returns its measurements.
fn measured(places: &Places, screen: &Screen, scene: &Path, way: &str) -> Result<Value, String> {
    let here = std::env::current_exe().map_err(|e| format!("cannot find this program: {e}"))?;
    // A draft of an earlier run would be offered, and its message would take room from the picture.
    let state = places.out.join("state");
    match std::fs::remove_dir_all(&state) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
            return Err(format!("cannot empty {}: {e}", state.display()));
        }
        _ => {}
    }
    let output = Command::new(here)
        .arg(window_process::NAME)
        .arg(scene)
        .args(SIZE.map(|side| side.to_string()))
        .arg(way)
        .env("DISPLAY", &screen.name)
        .env_remove("WAYLAND_DISPLAY")
        // Mesa's software driver, even if there is a graphics card.
        .env("LIBGL_ALWAYS_SOFTWARE", "1")
        // The user's settings are neither used nor changed.
        .env("XDG_STATE_HOME", &state)
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("cannot start the window's process: {e}"))?;
    let words = String::from_utf8_lossy(&output.stdout);
    let last = words.lines().last().unwrap_or_default();
    if !output.status.success() {
        return Err(format!("the window ended with {}: {last}", output.status));
    }
    serde_json::from_str(last).map_err(|e| format!("`{last}` is not a valid result: {e}"))
}

/// Prints, and returns whether the requirement is met.
fn print_result(way: &str, result: &Value) -> Result<bool, String> {
    let number = |value: &Value| value.as_f64().ok_or_else(|| format!("a number is missing in {result}"));
    let cell = |side: &str, key: &str| number(&result[side][key]).map(|ms| format!("{ms:.2}"));
    if result["triangles"] != TRIANGLES {
        return Err(format!("the sphere has {} triangles instead of {TRIANGLES}", result["triangles"]));
    }
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    let mut window = words(&["window"]);
    let mut bare = words(&["bare renderer"]);
    for key in ["wall", "cpu", "ui", "paint", "rest"] {
        window.push(cell("window", key)?);
    }
    for key in ["wall", "cpu", "submit"] {
        bare.push(cell("bare", key)?);
    }
    measure::print_table(
        &format!(
            "window, {way}: a light dragged over {TRIANGLES} triangles, window {}x{}, picture {}x{}, {} samples; {}; medians \
             of {TURNS} turns of {FRAMES} frames",
            SIZE[0],
            SIZE[1],
            result["size"][0],
            result["size"][1],
            result["samples"],
            result["renderer"].as_str().unwrap_or_default(),
        ),
        &[words(&["", "wall ms", "CPU ms", "application", "painting", "swap and rest"]), window, bare],
    );
    println!("  CPU time against the bare renderer: {:.3} x", number(&result["cpu_ratio"])?);
    Ok(measure::bar("frame time against the bare renderer", number(&result["wall_ratio"])?, " x", BAR, true))
}
