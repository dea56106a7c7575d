//! BRDFs written as a GLSL function, run on the CPU by `gonio-interpreter`.
//!
//! The function has the signature of BRDF Explorer: `vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)`, with `L` to the
//! light, `V` to the viewer, the normal `N` and the tangents `X` and `Y`. Parameters are uniforms.

use crate::bsdf::{Bsdf, both_above};
use crate::parameter::{Parameter, ParameterKind, ParameterValues};
use crate::sampling::direction;
use gonio_glsl::{Severity, Span, Stage};
use gonio_interpreter::{CompiledStage, PointValues, RunOptions, StageInputs, compile, run};
use gonio_light::DVec3;
use std::fmt;
use std::sync::Arc;

/// The signature that a function must have.
pub const SIGNATURE: &str = "vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)";

/// Work of the interpreter for each pair of directions, in steps of about 0.1 microseconds, before a loop counts as endless.
/// The functions of BRDF Explorer take a third at most; a check evaluates two million pairs, so more would take minutes.
const WORK_PER_PAIR: u64 = 300;
/// The least work of a run. A block of points is run together, so a few pairs cost as much as many.
const LEAST_WORK: u64 = 300_000;

/// A function that cannot be run, with its position in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GlslBrdfError {
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
    /// One sentence.
    pub message: String,
}

impl fmt::Display for GlslBrdfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for GlslBrdfError {}

/// A BRDF by a GLSL function, with values of its parameters. The function is compiled once and shared between copies.
#[derive(Clone, Debug)]
pub struct GlslBrdf {
    stage: Arc<CompiledStage>,
    body_line: u32,
    values: ParameterValues,
}

/// Lines before the function's text in the source that is compiled.
const LINES_BEFORE: u32 = 2;

impl GlslBrdf {
    /// Compiles a function and runs it once over a grid of directions. `first_line` is the line of its file on which `text`
    /// begins.
    ///
    /// # Errors
    ///
    /// A syntax or type error, a construct that the interpreter cannot run, a missing function, or a loop that does not end
    /// for the values of the parameters; each with its position.
    pub fn new(text: &str, first_line: u32, values: ParameterValues) -> Result<Self, GlslBrdfError> {
        let source = format!("#version 410\n{}\n{text}\n{MAIN}", declarations(values.parameters()));
        let body_lines = text.lines().count() as u32;
        let at = |span: Span, message: String| {
            let line = span.line.saturating_sub(LINES_BEFORE);
            if line > body_lines {
                // The call of `BRDF`, unless the text has a `main` of its own.
                let is_call = message.contains("BRDF");
                let message = if is_call { format!("the function `{SIGNATURE}` is missing") } else { message };
                return GlslBrdfError { line: first_line, column: 1, message };
            }
            GlslBrdfError { line: line.max(1) + first_line - 1, column: span.column, message }
        };
        let mut parsed = gonio_glsl::parse(&source);
        let checked = gonio_glsl::check(&mut parsed, Stage::Vertex);
        let is_error = |problem: &&gonio_glsl::Problem| problem.severity == Severity::Error;
        let mut errors: Vec<_> = parsed.problems.iter().chain(&checked.problems).filter(is_error).collect();
        errors.sort_by_key(|problem| problem.span.start);
        if let Some(problem) = errors.first() {
            return Err(at(problem.span, problem.message.clone()));
        }
        let stage = compile(&parsed, &checked)
            .map_err(|error| at(error.span, format!("gonio cannot run {}", error.construct)))?;
        let brdf = Self { stage: Arc::new(stage), body_line: first_line, values };
        brdf.evaluate_pairs(&trial_pairs())?;
        Ok(brdf)
    }

    /// The same function with other values of its parameters.
    ///
    /// # Errors
    ///
    /// A loop that does not end for these values.
    pub fn with_values(&self, values: ParameterValues) -> Result<Self, GlslBrdfError> {
        let brdf = Self { stage: Arc::clone(&self.stage), body_line: self.body_line, values };
        brdf.evaluate_pairs(&trial_pairs())?;
        Ok(brdf)
    }

    /// The values of the parameters.
    pub fn values(&self) -> &ParameterValues {
        &self.values
    }

    /// Evaluates `f(wi, wo)` for many pairs.
    ///
    /// # Errors
    ///
    /// A loop that does not end.
    pub fn evaluate_pairs(&self, pairs: &[(DVec3, DVec3)]) -> Result<Vec<DVec3>, GlslBrdfError> {
        let mut inputs = StageInputs::new(&self.stage, pairs.len());
        for (name, second) in [("gonio_wi", false), ("gonio_wo", true)] {
            let component = |channel: usize| -> Vec<f32> {
                pairs.iter().map(|(wi, wo)| if second { wo[channel] } else { wi[channel] } as f32).collect()
            };
            let [x, y, z] = [0, 1, 2].map(component);
            inputs.set_named(&self.stage, name, PointValues::each(&[&x, &y, &z]));
        }
        for (parameter, value) in self.values.iter() {
            let value = match parameter.kind {
                ParameterKind::Number { .. } => PointValues::floats(&[value.x as f32]),
                ParameterKind::Color { .. } => PointValues::floats(&value.to_array().map(|channel| channel as f32)),
                ParameterKind::Switch { .. } => PointValues::ints(&[i32::from(value.x != 0.0)]),
            };
            inputs.set_named(&self.stage, &parameter.name, value);
        }
        let most_work = LEAST_WORK + WORK_PER_PAIR * pairs.len() as u64;
        let result = run(&self.stage, &inputs, &RunOptions { most_work, ..RunOptions::default() });
        if let Some(ended) = result.ended {
            let span = ended.statement.and_then(|id| self.stage.source.statements.get(id.0 as usize)).map(|s| s.span);
            let (line, column) = span.map_or((LINES_BEFORE + 1, 1), |span| (span.line, span.column));
            return Err(GlslBrdfError {
                line: line.saturating_sub(LINES_BEFORE).max(1) + self.body_line - 1,
                column,
                message: "the function does not end: it was stopped here".to_owned(),
            });
        }
        let Some(output) = result.output(&self.stage, "gonio_f") else { return Ok(vec![DVec3::ZERO; pairs.len()]) };
        let value = |point| {
            DVec3::new(output.float(0, point).into(), output.float(1, point).into(), output.float(2, point).into())
        };
        Ok((0..pairs.len()).map(value).collect())
    }
}

impl Bsdf for GlslBrdf {
    /// 0 where either direction is at or below the horizon; NaN where a loop does not end.
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        self.evaluate_all(&[(wi, wo)]).first().copied().unwrap_or(DVec3::ZERO)
    }

    fn evaluate_all(&self, pairs: &[(DVec3, DVec3)]) -> Vec<DVec3> {
        let mut values = self.evaluate_pairs(pairs).unwrap_or_else(|_| vec![DVec3::NAN; pairs.len()]);
        for (value, (wi, wo)) in values.iter_mut().zip(pairs) {
            if !both_above(*wi, *wo) {
                *value = DVec3::ZERO;
            }
        }
        values
    }

    fn samples_follow_function(&self) -> bool {
        false
    }

    /// Unknown for a text, so the general case.
    fn is_isotropic(&self) -> bool {
        false
    }
}

const MAIN: &str = "\
void main()
{
    gl_Position = vec4(0.0);
    gonio_f = BRDF(gonio_wi, gonio_wo, vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
}
";

/// The uniforms, inputs and outputs, on one line.
fn declarations(parameters: &[Parameter]) -> String {
    let mut text = "in vec3 gonio_wi; in vec3 gonio_wo; out vec3 gonio_f;".to_owned();
    for parameter in parameters {
        text += &format!(" uniform {} {};", glsl_type(parameter), parameter.name);
    }
    text
}

/// The type of a parameter in GLSL.
pub fn glsl_type(parameter: &Parameter) -> &'static str {
    match parameter.kind {
        ParameterKind::Number { .. } => "float",
        ParameterKind::Color { .. } => "vec3",
        ParameterKind::Switch { .. } => "bool",
    }
}

/// Directions that a function is tried with.
fn trial_pairs() -> Vec<(DVec3, DVec3)> {
    let angles = [0.0, 0.4, 0.8, 1.2, 1.5];
    let one = |theta: f64| [0.0, 1.0, 2.5, 4.0].map(|phi| direction(theta, phi));
    let all: Vec<DVec3> = angles.into_iter().flat_map(one).collect();
    all.iter().flat_map(|wi| all.iter().map(|wo| (*wi, *wo))).collect()
}
