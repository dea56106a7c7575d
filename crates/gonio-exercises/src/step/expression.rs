//! The values of one expression at one pixel or vertex.

use super::listing::counted;
use super::pair::{SteppedScene, SteppedStage, lane_in_quad};
use super::picture::{expressions_at, text_of};
use super::value::ShownValue;
use gonio_glsl::{Stage, Type};
use gonio_interpreter::{ExprId, PointValues, RunOptions, run};

/// A pixel or a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SteppedPlace {
    /// Column and row from the top left: the fragment shader.
    Pixel([u32; 2]),
    /// Counted over all objects: the vertex shader.
    Vertex(u32),
}

impl SteppedPlace {
    /// The shader that runs there.
    #[must_use]
    pub fn stage(self) -> Stage {
        match self {
            Self::Pixel(_) => Stage::Fragment,
            Self::Vertex(_) => Stage::Vertex,
        }
    }
}

/// An expression with its values at one pixel or vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionValue {
    pub(super) id: ExprId,
    /// Its source.
    pub expression: String,
    /// Its GLSL type.
    pub glsl_type: String,
    /// Its line in the student's file.
    pub line: u32,
    /// Its column, in characters from 1.
    pub column: u32,
    /// Its characters in that line.
    pub length: u32,
    /// The values in the order of evaluation; none if it was not evaluated.
    pub evaluations: Vec<EvaluatedValue>,
}

/// One evaluation of an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluatedValue {
    /// The function around it.
    pub function: String,
    /// The lines of the calls that led to it, the one in `main` first.
    pub calls: Vec<u32>,
    /// The iterations of the loops around it in all calls, the outermost one first, from 1.
    pub iterations: Vec<u32>,
    /// The value.
    pub value: ShownValue,
}

impl SteppedScene {
    /// The smallest expression at a line and column of the student's file, both from 1, with its values. `None` if there is no
    /// expression, or nothing is drawn at the pixel.
    #[must_use]
    pub fn expression_value(&self, place: SteppedPlace, [line, column]: [u32; 2]) -> Option<ExpressionValue> {
        let stage = self.pair.stage(place.stage());
        let watched = expressions_at(stage, line, column);
        let first = *watched.first()?;
        let quads = stage.compiled.takes_derivatives;
        let (inputs, point) = match place {
            SteppedPlace::Pixel(pixel) => {
                let inputs = self.fragment_inputs(self.surface(pixel)?.object, &[pixel], quads);
                (inputs, if quads { lane_in_quad(pixel, self.size()) } else { 0 })
            }
            SteppedPlace::Vertex(vertex) => {
                let (object, within) = self.vertex(vertex)?;
                (self.inputs_of_vertices(object, &[within]), 0)
            }
        };
        let options = RunOptions {
            textures: &self.textures,
            quads: quads && place.stage() == Stage::Fragment,
            watched: &watched,
            most_work: self.options.work.point,
            ..RunOptions::default()
        };
        let result = run(&stage.compiled, &inputs, &options);
        let seen = |expr: ExprId| {
            let of_expr = result.evaluations.iter().filter(move |found| found.expr == expr);
            of_expr.filter_map(move |found| {
                let lane = point.checked_sub(found.first_point).filter(|lane| found.points.contains(*lane))?;
                let bits = match &found.values {
                    PointValues::Same(values) => values.clone(),
                    PointValues::Each { components, .. } => {
                        components.iter().map(|all| all.get(lane).copied().unwrap_or(0)).collect()
                    }
                };
                let ty = stage.compiled.source.expression(expr).and_then(|source| source.ty.clone());
                let is_written = found.written.contains(lane);
                let value = stage.structs.value(&ty.unwrap_or(Type::Void), &bits, |_| is_written);
                let (function, calls) = stage.call(found.frame);
                Some(EvaluatedValue { function, calls, iterations: counted(&found.iterations), value })
            })
        };
        let id = watched.iter().copied().find(|expr| seen(*expr).next().is_some()).unwrap_or(first);
        let source = stage.compiled.source.expression(id)?;
        let (_, line, column) = stage.text.place(source.span.line, source.span.column);
        let written = stage.parsed.text(source.span).lines().next().unwrap_or_default();
        Some(ExpressionValue {
            id,
            expression: text_of(stage, id),
            glsl_type: source.ty.as_ref().map_or_else(String::new, Type::written),
            line,
            column,
            length: written.chars().count() as u32,
            evaluations: seen(id).collect(),
        })
    }
}

impl SteppedStage {
    /// The function of a frame, and the lines of the calls that led to it, the one in `main` first.
    pub(super) fn call(&self, frame: u32) -> (String, Vec<u32>) {
        let frames = &self.compiled.frames;
        let first = frames.get(frame as usize);
        let function = first.map_or_else(|| "main".to_owned(), |frame| frame.function.clone());
        let (mut calls, mut at) = (Vec::new(), first);
        while let Some((caller, current)) = at.and_then(|frame| Some((frame.caller?, frame))) {
            let span = current.call.and_then(|expr| self.compiled.source.expression(expr)).map(|call| call.span);
            calls.extend(span.map(|span| self.text.place(span.line, span.column).1));
            at = frames.get(caller as usize);
        }
        calls.reverse();
        (function, calls)
    }
}
