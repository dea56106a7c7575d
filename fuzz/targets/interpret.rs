//! Shaders in the interpreter, as both stages or as a pair. Every run ends, and every value that it returns has its place.

#![no_main]

use gonio_glsl::Stage;
use gonio_interpreter::{
    CompiledStage, ExprId, Fragment, PointValues, RunOptions, StageInputs, StageRun, Substitute, compile, interpolate,
    run,
};
use libfuzzer_sys::fuzz_target;

/// Between the texts of a pair.
const BETWEEN: &str = "\n---\n";
/// A block and a part of one.
const POINTS: usize = 260;

fn compiled(stage: Stage, text: &str) -> Option<CompiledStage> {
    let mut parsed = gonio_glsl::parse(text);
    let checked = gonio_glsl::check(&mut parsed, stage);
    compile(&parsed, &checked).ok()
}

/// Runs it without observation, and with everything that can be observed and replaced.
fn run_both_ways(stage: &CompiledStage, inputs: &StageInputs) -> StageRun {
    let plain = RunOptions { most_work: 100_000, ..RunOptions::default() };
    let result = run(stage, inputs, &plain);
    let watched: Vec<ExprId> = (0..stage.source.expressions.len() as u32).map(ExprId).collect();
    let replaced = watched.iter().step_by(7).map(|expr| Substitute {
        expr: *expr,
        occurrence: None,
        values: PointValues::floats(&[f32::NAN, -1.0, 2.0]),
    });
    let substitutes: Vec<Substitute> = replaced.collect();
    let all = RunOptions {
        quads: true,
        watched: &watched,
        substitutes: &substitutes,
        traced_point: Some(POINTS - 1),
        find_non_finite: true,
        most_observed: 1 << 18,
        ..plain
    };
    for result in [&result, &run(stage, inputs, &all)] {
        assert_eq!(result.points, inputs.points());
        assert_eq!(result.outputs.len(), stage.outputs.len());
        for output in &result.outputs {
            let PointValues::Each { components, .. } = output else { panic!("an output has a value for each point") };
            assert!(components.iter().all(|all| all.len() == result.points));
        }
        assert!(result.discarded.is_empty() || result.discarded.len() == result.points);
        assert!(result.anomalies.iter().all(|found| found.point < result.points));
        assert!(result.evaluations.iter().all(|found| found.first_point < result.points));
    }
    result
}

fn inputs(stage: &CompiledStage) -> StageInputs {
    let mut inputs = StageInputs::new(stage, POINTS);
    // Every third input is not set.
    for (index, input) in stage.inputs.iter().enumerate().filter(|(index, _)| index % 3 != 2) {
        let n = (input.ty.components().unwrap_or(1) * input.count).min(64);
        let numbers: Vec<Vec<f32>> =
            (0..n).map(|at| (0..POINTS).map(|point| (point as f32 - 20.0) * (at as f32 + 0.5)).collect()).collect();
        let slices: Vec<&[f32]> = numbers.iter().map(Vec::as_slice).collect();
        inputs.set(index, PointValues::each(&slices));
    }
    inputs
}

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let (vertex, fragment) = text.split_once(BETWEEN).unwrap_or((text, text));
    let vertex = compiled(Stage::Vertex, vertex).map(|stage| (run_both_ways(&stage, &inputs(&stage)), stage));
    let Some(fragment) = compiled(Stage::Fragment, fragment) else { return };
    run_both_ways(&fragment, &inputs(&fragment));
    if let Some((result, vertex)) = vertex {
        let corners = |at: u32| [at, at + 1, at + 2];
        let places: Vec<Fragment> =
            (0..8).map(|at| Fragment::on_screen(corners(at), [0.5, 0.25, 0.25], [1.0, 2.0, at as f32])).collect();
        run_both_ways(&fragment, &interpolate(&vertex, &result, &fragment, &places));
    }
});
