//! The picture of a program at its points.

use super::program::{Change, Runner};
use super::target::Seen;
use super::values::Values;
use gonio_glsl::Stage;
use gonio_interpreter::PointValues;
use std::ops::Range;

/// The picture in some scenes with changes; `None` if a run does not end.
pub(super) fn see(runner: &Runner<'_>, changes: &[Change], scenes: Range<usize>) -> Option<Seen> {
    let colour = Values::absent(3, runner.points(Stage::Fragment));
    let clip = Values::absent(4, runner.points(Stage::Vertex));
    let mut seen = Seen { colour, clip, statements: 0 };
    for scene in scenes {
        let result = runner.run(scene, changes, [&[], &[]]);
        seen.statements += result.vertex.statements + result.fragment.statements;
        if result.vertex.ended.is_some() || result.fragment.ended.is_some() {
            return None;
        }
        let first = runner.first_point(Stage::Vertex, scene);
        if let Some(position) = result.vertex.output(&runner.program.vertex, "gl_Position") {
            copy(position, 4, result.vertex.points, first, &mut seen.clip);
        }
        let first = runner.first_point(Stage::Fragment, scene);
        if let Some(output) = runner.program.colour_output() {
            copy(&result.fragment.outputs[output], 3, result.fragment.points, first, &mut seen.colour);
        }
        for (point, _) in result.fragment.discarded.iter().enumerate().filter(|(_, is)| **is) {
            seen.colour.numbers[(first + point) * 3..][..3].fill(f32::NAN);
        }
    }
    Some(seen)
}

fn copy(from: &PointValues, size: usize, points: usize, first: usize, to: &mut Values) {
    to.present[first..first + points].fill(true);
    for component in 0..size {
        let numbers = to.numbers[first * size + component..].iter_mut().step_by(size);
        numbers.zip(from.floats_at(component, 0..points)).for_each(|(to, number)| *to = number);
    }
}
