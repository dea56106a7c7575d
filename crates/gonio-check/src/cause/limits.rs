//! Colours that the vertex shader limits to 1, as OpenGL's old pipeline does: right light, interpolated after the limit.

use super::diagnosing::Diagnosing;
use super::program::{Change, Program, Runner};
use super::recording::observe;
use super::samples::SceneSamples;
use super::seeing::see;
use super::target::Seen;
use gonio_glsl::Stage;
use gonio_interpreter::ExprId;

/// The functions that limit their first argument.
const LIMITS: [&str; 2] = ["clamp", "min"];

/// The calls that limit a colour in the vertex shader, each with the colour.
fn limited_colours(program: &Program) -> Vec<[ExprId; 2]> {
    let source = &program.stage(Stage::Vertex).source;
    let colours: Vec<ExprId> = (program.numbers(Stage::Vertex).into_iter())
        .filter(|expr| {
            let ty = source.expression(*expr).and_then(|expression| expression.ty.as_ref());
            ty.and_then(|ty| ty.components()).is_some_and(|count| count == 3 || count == 4)
        })
        .collect();
    let tokens = |expr: ExprId| source.expression(expr).map(|expression| expression.tokens);
    let of_call = |call: ExprId| {
        let text = program.text(Stage::Vertex, call);
        let is_limit =
            LIMITS.iter().any(|name| text.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('(')));
        let call_tokens = tokens(call).filter(|_| is_limit)?;
        // Behind the name and the parenthesis.
        let is_first = |expr: &ExprId| {
            tokens(*expr).is_some_and(|tokens| tokens.first == call_tokens.first + 2 && tokens.last < call_tokens.last)
        };
        let first = colours.iter().copied().filter(is_first).max_by_key(|expr| tokens(*expr).map(|tokens| tokens.last));
        first.map(|argument| [call, argument])
    };
    colours.iter().filter_map(|call| of_call(*call)).collect()
}

impl Diagnosing<'_> {
    /// The picture without the limits that the vertex shader sets to colours; `None` if it sets none.
    pub(super) fn without_limits(&self) -> Option<Seen> {
        let limited = limited_colours(self.program);
        if limited.is_empty() {
            return None;
        }
        let samples: Vec<SceneSamples> = self.samples();
        let runner = Runner::new(self.program, &samples);
        let arguments: Vec<ExprId> = limited.iter().map(|[_, argument]| *argument).collect();
        let observed = observe(&runner, &[], 0..samples.len(), [&arguments, &[]]);
        let change = |[call, argument]: &[ExprId; 2]| {
            let seen = observed.iter().find(|seen| seen.expr == *argument && seen.stage == Stage::Vertex)?;
            let values = seen.values.clone();
            Some(Change { stage: Stage::Vertex, exprs: vec![*call], occurrence: None, values })
        };
        let changes: Vec<Change> = limited.iter().filter_map(change).collect();
        see(&runner, &changes, 0..samples.len())
    }
}
