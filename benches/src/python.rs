//! Draws the same pictures from Rust and from the Python package, in alternating turns of two warm processes.
//!
//! From Rust: the renderer draws a frame, and its linear pixels are read. From Python: `scene.render().array`. Scenes are loaded,
//! contexts opened and programs compiled before.

use crate::measure::{self, Cost};
use crate::{Places, python_package};
use gonio_gl::HeadlessContext;
use gonio_render::{GpuScene, Renderer};
use gonio_scene::files::Disk;
use gonio_scene::{Frame, Picture, load};
use serde_json::json;
use std::io::{BufRead, BufReader, Lines, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Measured turns of each side.
const TURNS: usize = 15;
/// The allowed time as a multiple of Rust's.
const BAR: f64 = 1.1;

/// A picture, and how many of them are drawn in a turn.
struct Case {
    scene: &'static str,
    size: [u32; 2],
    samples: u32,
    pictures: usize,
}

const CASES: [Case; 2] = [
    Case { scene: "builtin:suzanne", size: [1024, 768], samples: 4, pictures: 4 },
    // So small that whatever a call costs would be seen.
    Case { scene: "builtin:cube", size: [128, 96], samples: 1, pictures: 400 },
];

/// Measures, prints, and returns whether the requirement is met.
pub fn run(places: &Places) -> Result<bool, String> {
    let context = HeadlessContext::new().map_err(|e| e.message)?;
    let mut renderer = Renderer::new(context.gl().clone()).map_err(|e| e.message)?;
    let mut python = Python::start(&python_package::interpreter(places)?)?;
    let (mut results, mut held) = (Vec::new(), true);
    for case in &CASES {
        let (frame, gpu) = case.load(&mut renderer)?;
        let (mut ours, mut theirs): (Vec<Cost>, Vec<Cost>) = (Vec::new(), Vec::new());
        for turn in 0..=TURNS {
            let (picture, cost) = measure::here(|| case.draw(&mut renderer, &gpu, &frame));
            let (other_sum, other_cost) = python.draw(case)?;
            let sum: f64 = picture?.pixels.as_flattened().iter().map(|v| f64::from(*v)).sum();
            // Not the same picture otherwise; the sums add in another order.
            if (sum - other_sum).abs() > 1e-6 * sum.abs() {
                return Err(format!("Python drew another picture: its numbers add up to {other_sum}, not to {sum}"));
            }
            // The first turn compiles shaders and fills caches.
            if turn > 0 {
                ours.push(case.per_picture(cost));
                theirs.push(case.per_picture(other_cost));
            }
        }
        let (rust, from_python) = (measure::median_cost(&ours), measure::median_cost(&theirs));
        let row = |name: &str, cost: Cost| {
            vec![name.to_owned(), format!("{:.3}", 1e3 * cost.wall_s), format!("{:.3}", 1e3 * cost.cpu_s)]
        };
        let [width, height] = case.size;
        let title = format!(
            "python: {} at {width}x{height}, {} samples; medians of {TURNS} turns of {} pictures",
            case.scene, case.samples, case.pictures
        );
        let heading = ["a picture", "wall ms", "CPU ms"].map(String::from).to_vec();
        measure::print_table(&title, &[heading, row("from Rust", rust), row("from Python", from_python)]);
        let (wall, cpu) = (from_python.wall_s / rust.wall_s, from_python.cpu_s / rust.cpu_s);
        held &= measure::bar("wall time against Rust", wall, " x", BAR, true);
        held &= measure::bar("CPU time against Rust", cpu, " x", BAR, true);
        let side = |cost: Cost| json!({"wall_s": cost.wall_s, "cpu_s": cost.cpu_s});
        results.push(json!({
            "scene": case.scene, "width": width, "height": height, "samples": case.samples,
            "rust": side(rust), "python": side(from_python), "wall_ratio": wall, "cpu_ratio": cpu,
        }));
    }
    measure::write_json(&places.out, "python", &json!({ "pictures": results, "bar_held": held }))?;
    Ok(held)
}

impl Case {
    fn load(&self, renderer: &mut Renderer) -> Result<(Frame, GpuScene), String> {
        let mut scene = load::describe(&[self.scene], &Disk).map_err(|e| e.to_string())?;
        [scene.picture.width, scene.picture.height] = self.size;
        scene.picture.samples = self.samples;
        let loaded = load::load(scene, Path::new(""), &Disk).map_err(|e| e.to_string())?;
        let gpu = renderer.upload(&loaded).map_err(|e| e.message)?;
        Ok((loaded.frame(0.0), gpu))
    }

    /// Draws the pictures of a turn, and returns the last one.
    fn draw(&self, renderer: &mut Renderer, gpu: &GpuScene, frame: &Frame) -> Result<Picture, String> {
        let mut last = Picture::new(1, 1, [0.0; 4]);
        for _ in 0..self.pictures {
            last = renderer.render(gpu, frame, None).and_then(|drawn| drawn.linear()).map_err(|e| e.message)?;
        }
        Ok(last)
    }

    fn per_picture(&self, cost: Cost) -> Cost {
        Cost { wall_s: cost.wall_s / self.pictures as f64, cpu_s: cost.cpu_s / self.pictures as f64 }
    }
}

/// A process of Python that draws when it is told so.
struct Python {
    child: Child,
    orders: ChildStdin,
    answers: Lines<BufReader<ChildStdout>>,
}

impl Python {
    fn start(interpreter: &Path) -> Result<Self, String> {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/gonio_frames.py");
        let child = Command::new(interpreter).arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = child.map_err(|e| format!("cannot run {}: {e}", interpreter.display()))?;
        match (child.stdin.take(), child.stdout.take()) {
            (Some(orders), Some(answers)) => Ok(Python { child, orders, answers: BufReader::new(answers).lines() }),
            _ => Err("Python has no standard streams".into()),
        }
    }

    /// Draws the pictures of a turn: the sum of the last one's numbers, and the cost.
    fn draw(&mut self, case: &Case) -> Result<(f64, Cost), String> {
        let [width, height] = case.size;
        let order = format!("{} {width} {height} {} {}\n", case.scene, case.samples, case.pictures);
        self.orders.write_all(order.as_bytes()).map_err(|e| format!("Python has ended: {e}"))?;
        let answer = self.answers.next().ok_or("Python has ended; its stderr has the reason")?;
        let answer = answer.map_err(|e| format!("Python has ended: {e}"))?;
        let numbers: Vec<f64> = answer.split(' ').filter_map(|word| word.parse().ok()).collect();
        match numbers.as_slice() {
            [wall_s, cpu_s, sum] => Ok((*sum, Cost { wall_s: *wall_s, cpu_s: *cpu_s })),
            _ => Err(format!("Python answered `{answer}`")),
        }
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
