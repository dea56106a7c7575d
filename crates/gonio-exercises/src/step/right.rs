//! The right values of a pair's expressions, beside its own.

use super::coverage::{Plane, fragment_at, ndc};
use super::pair::{SteppedObject, SteppedScene};
use super::picture::{PixelValues, PointValue};
use super::syntax::{SteppedPlace, one_line};
use super::value::ShownValue;
use crate::exercise::Exercise;
use crate::preview::SubmittedPair;
use gonio_check::cause::SceneSamples;
use gonio_check::cause::quantity_of::{ExpressionQuantity, PlacedCause, RightQuantities};
use gonio_check::feedback::Feedback;
use gonio_check::verdict::CompilerMessage;
use gonio_glsl::Stage;
use gonio_interpreter::{ExprId, Fragment};
use gonio_language::tr;

/// What the expressions of a pair are and should be.
pub struct RightAnswer {
    quantities: RightQuantities,
}

/// A cause of what is wrong, with its right value at a pixel or vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct RightValue {
    /// The stage of the cause.
    pub stage: Stage,
    /// Its file.
    pub file: String,
    /// Its line in the file.
    pub line: u32,
    /// Its column, in characters from 1.
    pub column: u32,
    /// Its source, in one line.
    pub expression: String,
    /// What it should be: "should be the unit normal".
    pub should: String,
    /// The right value here; `None` if the shader does not run here, or the value is a matrix.
    pub value: Option<ShownValue>,
}

impl RightAnswer {
    /// Compares a pair with the right answer of its exercise; a tenth of a second. `None` if the exercise has none, hides
    /// it or shows no lines of mistakes, or the pair's values cannot be judged. This is the only access to right answers from the steps.
    #[must_use]
    pub fn new(exercise: &Exercise, submitted: &SubmittedPair) -> Option<Self> {
        if !exercise.shows_reference || exercise.feedback < Feedback::Line {
            return None;
        }
        let task = exercise.task()?;
        Some(Self { quantities: RightQuantities::new(task, submitted.submission(), submitted.names())? })
    }

    /// The causes of what is wrong, as messages at their places in a pair's files.
    #[must_use]
    pub fn messages(&self, submitted: &SubmittedPair) -> Vec<CompilerMessage> {
        let message = |cause: &PlacedCause| {
            let text = submitted.text(cause.stage);
            let (file, line, column) = text.place(cause.span.line, cause.span.column);
            CompilerMessage {
                file: file.to_owned(),
                line: Some(line),
                column: Some(column),
                text: tr!("check-wrong-value", text = one_line(&cause.text), should = cause.should),
                quoted: text.line(cause.span.line).map(str::to_owned),
                explanation: None,
            }
        };
        self.quantities.causes().iter().map(message).collect()
    }

    /// What an expression is or should be; `None` if no quantity of the light equation has its values.
    #[must_use]
    pub fn quantity(&self, stage: Stage, expr: ExprId) -> Option<&ExpressionQuantity> {
        self.quantities.of(stage, expr)
    }
}

impl SteppedScene {
    /// The right values of an expression at all drawn pixels.
    pub(super) fn right_values(&self, right: &RightAnswer, stage: Stage, expr: ExprId) -> Option<PixelValues> {
        right.quantity(stage, expr)?;
        let mut values = Vec::new();
        for (number, object) in self.objects.iter().enumerate() {
            let (mut pixels, mut places) = (Vec::new(), Vec::new());
            for pixel in self.coverage.covered() {
                let triangle = self.coverage.at(pixel).filter(|triangle| triangle.object == number);
                if let Some((triangle, plane)) = triangle.and_then(|t| Some((t, Plane::new(&t.clip)?))) {
                    pixels.push(pixel);
                    places.push(fragment_at(triangle, &plane.at(ndc(pixel, self.coverage.size))));
                }
            }
            if pixels.is_empty() {
                continue;
            }
            let found = right.quantities.at_places(vec![samples(object, places)?], stage, expr)?;
            let value = |components: Option<Vec<f32>>| {
                let Some(found) = components else { return PointValue::default() };
                let components = std::array::from_fn(|at| found.get(at).copied().unwrap_or(0.0));
                PointValue { components, is_written: true, evaluations: 1 }
            };
            values.extend(pixels.into_iter().zip(found.places.into_iter().map(value)));
        }
        Some(values)
    }

    /// The causes of what is wrong, with their right values at a pixel or vertex.
    #[must_use]
    pub fn right_at(&self, right: &RightAnswer, place: SteppedPlace) -> Vec<RightValue> {
        let of_stage = |cause: &&PlacedCause| cause.stage == place.stage();
        let value = |cause: &PlacedCause| {
            let text = &self.pair.stage(cause.stage).text;
            let (file, line, column) = text.place(cause.span.line, cause.span.column);
            RightValue {
                stage: cause.stage,
                file: file.to_owned(),
                line,
                column,
                expression: one_line(&cause.text),
                should: cause.should.clone(),
                value: self.right_value(right, place, cause.expr),
            }
        };
        right.quantities.causes().iter().filter(of_stage).map(value).collect()
    }

    fn right_value(&self, right: &RightAnswer, place: SteppedPlace, expr: ExprId) -> Option<ShownValue> {
        let (values, point) = match place {
            SteppedPlace::Pixel(pixel) => {
                let triangle = self.coverage.at(pixel)?;
                let at = fragment_at(triangle, &Plane::new(&triangle.clip)?.at(ndc(pixel, self.coverage.size)));
                let object = self.objects.get(triangle.object)?;
                (right.quantities.at_places(vec![samples(object, vec![at])?], Stage::Fragment, expr)?, 0)
            }
            SteppedPlace::Vertex(vertex) => {
                let (object, within) = self.vertex(vertex)?;
                (right.quantities.at_vertices(vec![samples(object, Vec::new())?], expr)?, within as usize)
            }
        };
        let parts: Vec<ShownValue> =
            values.places.into_iter().nth(point)??.into_iter().map(ShownValue::Float).collect();
        match values.size {
            1 => parts.into_iter().next(),
            2..=4 => Some(ShownValue::Vector(parts)),
            _ => None,
        }
    }
}

/// The places on an object of an exercise's scene.
fn samples(object: &SteppedObject, places: Vec<Fragment>) -> Option<SceneSamples> {
    let (scene, mesh) = object.of_exercise.clone()?;
    Some(SceneSamples { scene, mesh, places })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise;

    #[test]
    fn right_values_are_hidden_with_the_reference_and_with_the_lines_of_mistakes() {
        let ex04 = exercise::find("ex04").unwrap();
        let pair = crate::preview::reference(ex04).unwrap();
        let is_shown = |shows_reference: bool, feedback: Feedback| {
            let mut exercise = ex04.clone();
            (exercise.shows_reference, exercise.feedback) = (shows_reference, feedback);
            RightAnswer::new(&exercise, &pair).is_some()
        };
        assert!(is_shown(true, Feedback::Line) && is_shown(true, Feedback::Fix));
        assert!(!is_shown(false, Feedback::Fix) && !is_shown(true, Feedback::Name));
    }
}
