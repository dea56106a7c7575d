//! Runs the reference solution of exercise 07 in the interpreter, both stages, and compares the CPU time with its bar.

use crate::{Places, measure};
use gonio_glsl::Stage;
use gonio_interpreter::{CompiledStage, PointValues, RunOptions, StageInputs, compile, run as run_stage};
use serde_json::json;

/// Points of each stage.
const POINTS: usize = 100_000;
/// Most CPU time of both stages together, in milliseconds. The project set it.
const BAR_MS: f64 = 60.0;
const ROUNDS: usize = 21;

const VERTEX: &str = include_str!("../../exercises/ex07-light-equation/reference.vert");
const FRAGMENT: &str = include_str!("../../exercises/ex07-light-equation/reference.frag");

fn compiled(source: &str, stage: Stage) -> Result<CompiledStage, String> {
    let mut parsed = gonio_glsl::parse(source);
    let checked = gonio_glsl::check(&mut parsed, stage);
    compile(&parsed, &checked).map_err(|error| error.to_string())
}

/// Different numbers for each point to inputs of points, the same ones to uniforms.
fn inputs(stage: &CompiledStage) -> StageInputs {
    let mut inputs = StageInputs::new(stage, POINTS);
    for (index, input) in stage.inputs.iter().enumerate() {
        let n = input.ty.components().unwrap_or(1) * input.count;
        let series = |component: u32| -> Vec<f32> {
            let frequency = 0.37 + 0.11 * (index as f32 + 3.0 * component as f32);
            (0..POINTS).map(|point| (point as f32 * frequency).sin()).collect()
        };
        let values = match input.rate {
            gonio_interpreter::InputRate::Uniform => {
                PointValues::floats(&(0..n).map(|at| 1.1 + at as f32 * 0.3).collect::<Vec<_>>())
            }
            gonio_interpreter::InputRate::PerPoint => {
                let all: Vec<Vec<f32>> = (0..n).map(series).collect();
                PointValues::each(&all.iter().map(Vec::as_slice).collect::<Vec<_>>())
            }
        };
        inputs.set(index, values);
    }
    inputs
}

/// Measures, prints, and returns whether the bar is met.
pub fn run(places: &Places) -> Result<bool, String> {
    let stages = [compiled(VERTEX, Stage::Vertex)?, compiled(FRAGMENT, Stage::Fragment)?];
    let inputs = [inputs(&stages[0]), inputs(&stages[1])];
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        for ((stage, inputs), times) in stages.iter().zip(&inputs).zip(&mut times) {
            let start = measure::cpu_time();
            let result = run_stage(stage, inputs, &RunOptions::default());
            times.push((measure::cpu_time() - start).as_secs_f64() * 1000.0);
            if result.ended.is_some() {
                return Err("the interpreter ended early".into());
            }
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let [vertex, fragment] = times.map(median);
    let held = vertex + fragment <= BAR_MS;
    println!("interpret: exercise 07 at {POINTS} points, CPU time");
    println!("  vertex {vertex:.2} ms, fragment {fragment:.2} ms; together at most {BAR_MS} ms: {held}");
    let result = json!({"points": POINTS, "vertex_ms": vertex, "fragment_ms": fragment, "bars_held": held});
    measure::write_json(&places.out, "interpret", &result)?;
    Ok(held)
}
