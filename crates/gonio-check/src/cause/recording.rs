//! The values of expressions while a program runs.

use super::program::{Change, Runner};
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::{ExprId, PointValues};
use gonio_threads::prelude::*;
use std::collections::BTreeMap;

/// Both stages, in the order of their work.
pub(super) const STAGES: [Stage; 2] = [Stage::Vertex, Stage::Fragment];
/// The first test scenes distinguish most mistakes.
pub(super) const TELLING: usize = 3;

/// The values of one expression in one of its evaluations.
pub(super) struct Recorded {
    pub stage: Stage,
    pub expr: ExprId,
    pub occurrence: u32,
    /// Its number in the order of evaluation in its stage.
    pub order: usize,
    pub values: Values,
}

/// The values of expressions of both stages in some scenes.
pub(super) fn observe(
    runner: &Runner<'_>,
    changes: &[Change],
    scenes: std::ops::Range<usize>,
    watched: [&[ExprId]; 2],
) -> Vec<Recorded> {
    let mut found = BTreeMap::<(usize, ExprId, u32), (usize, Values)>::new();
    let scenes: Vec<usize> = scenes.collect();
    let results: Vec<_> = scenes.par_iter().map(|scene| (*scene, runner.run(*scene, changes, watched))).collect();
    for (scene, result) in results {
        for (stage, run) in STAGES.into_iter().zip([&*result.vertex, &result.fragment]) {
            let (all, first) = (runner.points(stage), runner.first_point(stage, scene));
            for (order, evaluation) in run.evaluations.iter().enumerate() {
                let size = match &evaluation.values {
                    PointValues::Same(components) => components.len(),
                    PointValues::Each { components, .. } => components.len(),
                };
                let key = (stage as usize, evaluation.expr, evaluation.occurrence);
                let (_, values) = found.entry(key).or_insert_with(|| (order, Values::absent(size, all)));
                if values.size != size {
                    continue;
                }
                let start = first + evaluation.first_point;
                match &evaluation.values {
                    PointValues::Same(components) => {
                        for lane in evaluation.points.iter() {
                            values.present[start + lane] = true;
                            let to = &mut values.numbers[(start + lane) * size..][..size];
                            to.iter_mut().zip(components).for_each(|(to, bits)| *to = f32::from_bits(*bits));
                        }
                    }
                    PointValues::Each { components, .. } => {
                        evaluation.points.iter().for_each(|lane| values.present[start + lane] = true);
                        for (component, from) in components.iter().enumerate() {
                            for lane in evaluation.points.iter() {
                                values.numbers[(start + lane) * size + component] = f32::from_bits(from[lane]);
                            }
                        }
                    }
                }
            }
        }
    }
    let recorded = |((stage, expr, occurrence), (order, values))| Recorded {
        stage: STAGES[stage],
        expr,
        occurrence,
        order,
        values,
    };
    found.into_iter().map(recorded).collect()
}
