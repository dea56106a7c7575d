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

/// The calls that may limit a colour in the vertex shader, each with the colour.
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
    /// The picture without the limits of 1 that the vertex shader sets to colours; `None` if it sets none.
    pub(super) fn without_limits(&self) -> Option<Seen> {
        let limited = limited_colours(self.program);
        if limited.is_empty() {
            return None;
        }
        let samples: Vec<SceneSamples> = self.samples();
        let runner = Runner::new(self.program, &samples);
        let observed = observe(&runner, &[], 0..samples.len(), [&limited.concat(), &[]]);
        let values_of = |expr: ExprId| observed.iter().find(|seen| seen.expr == expr).map(|seen| &seen.values);
        let change = |[call, argument]: &[ExprId; 2]| {
            let (after, before) = (values_of(*call)?, values_of(*argument)?);
            // Light is never negative; another limit is a mistake.
            let limited = before.map(before.size, |_, from, to| {
                to.iter_mut().zip(from).for_each(|(to, from)| *to = from.min(1.0));
            });
            let change =
                || Change { stage: Stage::Vertex, exprs: vec![*call], occurrence: None, values: before.clone() };
            after.is_same(&limited).then(change)
        };
        let changes: Vec<Change> = limited.iter().filter_map(change).collect();
        if changes.is_empty() { None } else { see(&runner, &changes, 0..samples.len()) }
    }
}
