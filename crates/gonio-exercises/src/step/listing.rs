//! The steps of one pixel or vertex, with the values that they wrote.

use super::coverage::lane_in_quad;
use super::pair::{SteppedScene, SteppedStage};
use super::syntax::{Syntax, counted, one_line};
use super::value::ShownValue;
use gonio_glsl::{Span, Stage};
use gonio_interpreter::{
    AnomalyKind, EndedEarly, ExprId, InputRate, PointValues, RunOptions, StageInputs, StageRun, StatementId, TraceStep,
    TraceWrite, run,
};
use std::collections::{HashMap, HashSet};

/// The steps of a shader at one pixel or vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct StepListing {
    /// The stage.
    pub stage: Stage,
    /// The file, as the student named it.
    pub file: String,
    /// The lines of the stage.
    pub lines: Vec<ListedLine>,
    /// Varyings (or attributes) and uniforms, in the order of their declarations.
    pub inputs: Vec<ListedVariable>,
    /// The steps in the order of execution.
    pub steps: Vec<ListedStep>,
    /// The outputs at the end; colours of a pixel that was discarded have no effect.
    pub outputs: Vec<ListedVariable>,
    /// Reads of values that were never written.
    pub unwritten: Vec<ListedPlace>,
    /// The first expression that computed an infinity or NaN from finite numbers, and its value.
    pub non_finite: Option<(ListedPlace, ShownValue)>,
    /// The line of the `discard` that was executed.
    pub discarded: Option<u32>,
    /// A bound on the work was reached: the line of the loop, and the number of statements until then.
    pub endless: Option<(u32, u64)>,
    /// Whether there are more steps than recorded.
    pub is_truncated: bool,
}

/// A line of the student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedLine {
    /// Its number in the file, from 1.
    pub number: u32,
    /// Its text.
    pub text: String,
    /// Whether a statement that begins here was executed; `None` if none begins here, or if it is unknown.
    pub ran: Option<bool>,
}

/// A variable with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct ListedVariable {
    /// OpenGL's name for an input or output, else the name in the source.
    pub name: String,
    /// Its GLSL type.
    pub glsl_type: String,
    /// The value.
    pub value: ShownValue,
    /// The line of its declaration; `None` if it is built in.
    pub line: Option<u32>,
    /// Whether it is a uniform.
    pub is_uniform: bool,
    /// Whether it is declared outside of all functions, or built in.
    pub is_global: bool,
}

/// A statement, or a part of one between calls, that was executed.
#[derive(Clone, Debug, PartialEq)]
pub struct ListedStep {
    /// Its line in the student's file.
    pub line: u32,
    /// The function around it.
    pub function: String,
    /// The lines of the calls that led to it, the one in `main` first.
    pub calls: Vec<u32>,
    /// The iterations of the loops around it in all calls, the outermost one first, from 1.
    pub iterations: Vec<u32>,
    /// The conditions of `if` and `?:` that it evaluated.
    pub conditions: Vec<ListedCondition>,
    /// The variables that it wrote, in order; `return` is the value that a function returns.
    pub writes: Vec<ListedVariable>,
}

/// The condition of an `if` or `?:`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedCondition {
    /// Its source.
    pub expression: String,
    /// Its value.
    pub holds: bool,
}

/// An expression of the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedPlace {
    /// Its line in the student's file.
    pub line: u32,
    /// Its column, in characters from 1.
    pub column: u32,
    /// Its source.
    pub expression: String,
}

impl SteppedScene {
    /// Steps through the fragment shader at a pixel, column and row from the top left; `None` if nothing is drawn there.
    #[must_use]
    pub fn step_pixel(&self, pixel: [u32; 2]) -> Option<StepListing> {
        let surface = self.surface(pixel)?;
        let stage = &self.pair.fragment;
        let quads = stage.compiled.takes_derivatives;
        let inputs = self.fragment_inputs(surface.object, &[pixel], quads);
        let point = if quads { lane_in_quad(pixel, self.coverage.size[1]) } else { 0 };
        Some(self.list(stage, &inputs, point, quads))
    }

    /// Steps through the vertex shader at a vertex, counted over all objects; `None` if there is no such vertex.
    #[must_use]
    pub fn step_vertex(&self, vertex: u32) -> Option<StepListing> {
        let (object, within) = self.vertex(vertex)?;
        let inputs = self.inputs_of_vertices(object, &[within]);
        Some(self.list(&self.pair.vertex, &inputs, 0, false))
    }

    /// The line of the loop that does not end in the fragment shader at a pixel.
    pub(super) fn endless_line_at_pixel(&self, pixel: [u32; 2]) -> Option<u32> {
        let surface = self.surface(pixel)?;
        let stage = &self.pair.fragment;
        let quads = stage.compiled.takes_derivatives;
        self.endless_line(stage, &self.fragment_inputs(surface.object, &[pixel], quads), quads)
    }

    /// The line of the loop that does not end in the vertex shader at a vertex.
    pub(super) fn endless_line_at_vertex(&self, vertex: u32) -> Option<u32> {
        let (object, within) = self.vertex(vertex)?;
        self.endless_line(&self.pair.vertex, &self.inputs_of_vertices(object, &[within]), false)
    }

    fn endless_line(&self, stage: &SteppedStage, inputs: &StageInputs, quads: bool) -> Option<u32> {
        let most_work = self.options.work.point;
        let options = RunOptions { textures: &*self.textures, quads, most_work, ..RunOptions::default() };
        let ended = run(&stage.compiled, inputs, &options).ended?;
        Some(line_of_loop(stage, &Syntax::new(stage), ended))
    }

    fn list(&self, stage: &SteppedStage, inputs: &StageInputs, point: usize, quads: bool) -> StepListing {
        let options = RunOptions {
            textures: &*self.textures,
            quads,
            traced_point: Some(point),
            find_non_finite: true,
            most_work: self.options.work.point,
            ..RunOptions::default()
        };
        let result = run(&stage.compiled, inputs, &options);
        let syntax = Syntax::new(stage);
        let anomalies = result.anomalies.iter().filter(|found| found.kind == AnomalyKind::ReadBeforeWritten);
        let unwritten: Vec<ExprId> = anomalies.map(|found| found.expr).collect();
        let origin = result.non_finite.get(point).copied().flatten();
        let mut watched: Vec<ExprId> = syntax.conditions.iter().chain(&syntax.returns).map(|(expr, _)| *expr).collect();
        watched.extend(unwritten.iter().copied().chain(origin));
        // The values of these expressions are known after the first run alone.
        let watching = RunOptions { watched: &watched, traced_point: None, find_non_finite: false, ..options };
        let seen = Seen { point, run: run(&stage.compiled, inputs, &watching) };
        Lister { stage, syntax, result, seen, inputs, point }.list(&unwritten, origin)
    }
}

/// The line of the innermost loop in which a run ended early.
fn line_of_loop(stage: &SteppedStage, syntax: &Syntax, ended: EndedEarly) -> u32 {
    let last = ended.statement.and_then(|id| stage.compiled.source.statements.get(id.0 as usize));
    let last = last.map(|statement| statement.span).unwrap_or_default();
    let around = |span: &&Span| span.start <= last.start && last.end <= span.end;
    let loops = syntax.loops.iter().map(|(_, span)| span).filter(around);
    let innermost = loops.min_by_key(|span| span.end - span.start);
    let span = innermost.unwrap_or(&last);
    stage.text.place(span.line, span.column).1
}

/// The values of watched expressions at the point.
struct Seen {
    point: usize,
    run: StageRun,
}

impl Seen {
    /// The evaluations of an expression at the point: call, iterations, scalars, and whether each was computed from written
    /// values.
    fn of(&self, expr: ExprId) -> impl Iterator<Item = (u32, &[u32], Vec<u32>, bool)> {
        let evaluations = self.run.evaluations.iter().filter(move |found| found.expr == expr);
        evaluations.filter_map(|found| {
            let lane = self.point.checked_sub(found.first_point).filter(|lane| found.points.contains(*lane))?;
            let values = match &found.values {
                PointValues::Same(values) => values.clone(),
                PointValues::Each { components, .. } => {
                    components.iter().map(|all| all.get(lane).copied().unwrap_or(0)).collect()
                }
            };
            Some((found.frame, &found.iterations[..], values, found.written.contains(lane)))
        })
    }
}

/// Makes a listing from a run.
struct Lister<'a> {
    stage: &'a SteppedStage,
    syntax: Syntax,
    result: StageRun,
    seen: Seen,
    inputs: &'a StageInputs,
    point: usize,
}

impl Lister<'_> {
    fn list(self, unwritten: &[ExprId], origin: Option<ExprId>) -> StepListing {
        let result = &self.result;
        let executed: HashSet<StatementId> = result.trace.iter().filter_map(|step| step.statement).collect();
        let discard = result.trace.iter().rev().filter_map(|step| step.statement);
        let discarded = result.discarded.get(self.point).copied().unwrap_or(false);
        let mut places: Vec<ListedPlace> = Vec::new();
        let is_unwritten = |expr: &&ExprId| self.seen.of(**expr).any(|(.., is_written)| !is_written);
        for expr in unwritten.iter().filter(is_unwritten).filter(|expr| !self.follows_from_another(**expr)) {
            places.extend(self.place(*expr).filter(|place| !places.contains(place)));
        }
        places.sort_by_key(|place| (place.line, place.column));
        StepListing {
            stage: self.stage.compiled.stage,
            file: self.stage.text.file.clone(),
            lines: self.lines(&executed),
            inputs: self.inputs(),
            steps: self.steps(),
            outputs: self.outputs(),
            unwritten: places,
            non_finite: origin.and_then(|expr| Some((self.place(expr)?, self.value_of(expr)))),
            discarded: discard
                .filter(|_| discarded)
                .find(|id| self.syntax.discards.contains(id))
                .map(|id| self.line(self.stage.compiled.source.statements[id.0 as usize].span)),
            endless: result.ended.map(|ended| (line_of_loop(self.stage, &self.syntax, ended), result.statements)),
            is_truncated: result.is_truncated,
        }
    }

    fn line(&self, span: Span) -> u32 {
        self.stage.text.place(span.line, span.column).1
    }

    fn place(&self, expr: ExprId) -> Option<ListedPlace> {
        let span = self.stage.compiled.source.expression(expr)?.span;
        let (_, line, column) = self.stage.text.place(span.line, span.column);
        Some(ListedPlace { line, column, expression: one_line(self.stage.parsed.text(span)) })
    }

    /// Whether the variable that an expression reads was written with a value that is undefined itself.
    fn follows_from_another(&self, expr: ExprId) -> bool {
        let Some(place) = self.place(expr) else { return false };
        let name = place.expression.split(['.', '[']).next().unwrap_or_default().to_owned();
        self.last_write(&name).is_some_and(|write| write.written.iter().all(|is_written| !is_written))
    }

    /// The first infinite or NaN value of an expression.
    fn value_of(&self, expr: ExprId) -> ShownValue {
        let ty = self.stage.compiled.source.expression(expr).and_then(|found| found.ty.clone());
        let value = |bits: &[u32]| match &ty {
            Some(ty) => self.stage.structs.value(ty, bits, |_| true),
            None => ShownValue::Unwritten,
        };
        let mut values = self.seen.of(expr).map(|(_, _, bits, _)| value(&bits));
        values.find(ShownValue::is_non_finite).unwrap_or(ShownValue::Float(f32::NAN))
    }

    fn lines(&self, executed: &HashSet<StatementId>) -> Vec<ListedLine> {
        let source = &self.stage.compiled.source;
        let is_complete = self.result.ended.is_none() && !self.result.is_truncated;
        let mut ran: HashMap<u32, bool> = HashMap::new();
        for id in &self.syntax.recorded {
            let is_executed = executed.contains(id);
            if is_executed || is_complete {
                *ran.entry(source.statements[id.0 as usize].span.line).or_default() |= is_executed;
            }
        }
        let line = |(index, text): (usize, &str)| {
            let line = index as u32 + 1;
            ListedLine {
                number: self.stage.text.place(line, 0).1,
                text: text.replace('\t', "    "),
                ran: ran.get(&line).copied(),
            }
        };
        self.stage.text.text.lines().enumerate().map(line).collect()
    }

    fn inputs(&self) -> Vec<ListedVariable> {
        let stage = &self.stage.compiled;
        let listed = stage.inputs.iter().enumerate().map(|(index, input)| {
            let values = self.inputs.values(index);
            let is_uniform = input.rate == InputRate::Uniform;
            let count = input.ty.components().unwrap_or(1) * input.count;
            let bits: Vec<u32> = (0..count as usize)
                .map(|at| values.and_then(|values| values.component(at, self.point)).unwrap_or(0))
                .collect();
            // Uniforms that nothing sets are 0.
            let is_written = is_uniform || values.is_some_and(|values| values.is_written(self.point));
            ListedVariable {
                name: input.name.clone(),
                glsl_type: input.ty.written(),
                value: self.stage.structs.value(&array_of(&input.ty, input.count), &bits, |_| is_written),
                line: input.span.map(|span| self.line(span)),
                is_uniform,
                is_global: true,
            }
        });
        listed.collect()
    }

    fn outputs(&self) -> Vec<ListedVariable> {
        let outputs = self.stage.compiled.outputs.iter().zip(&self.result.outputs);
        let listed = outputs.map(|(output, values)| {
            let count = output.ty.components().unwrap_or(1) * output.count;
            let bits: Vec<u32> = (0..count as usize).map(|at| values.component(at, self.point).unwrap_or(0)).collect();
            let is_written = values.is_written(self.point) && self.result.ended.is_none();
            // After a write to some components, the trace knows which.
            let last = self.last_write(&output.name);
            let written = |at: usize| match last {
                Some(write) if !is_written => write.written.get(at).copied().unwrap_or(false),
                _ => is_written,
            };
            ListedVariable {
                name: output.name.clone(),
                glsl_type: output.ty.written(),
                value: self.stage.structs.value(&array_of(&output.ty, output.count), &bits, written),
                line: output.span.map(|span| self.line(span)),
                is_uniform: false,
                is_global: true,
            }
        });
        listed.collect()
    }

    fn last_write(&self, name: &str) -> Option<&TraceWrite> {
        let variables = &self.stage.compiled.variables;
        let writes = self.result.trace.iter().rev().flat_map(|step| step.writes.iter().rev());
        let mut writes = writes.filter(|write| variables.get(write.variable as usize).is_some_and(|v| v.name == name));
        writes.next()
    }

    fn steps(&self) -> Vec<ListedStep> {
        let mut steps: Vec<ListedStep> = Vec::new();
        let (mut conditions, mut returns) = (self.conditions(), self.returns());
        for step in &self.result.trace {
            let is_loop = |id: StatementId| self.syntax.loops.iter().any(|(found, _)| *found == id);
            if step.writes.is_empty() && step.statement.is_some_and(is_loop) {
                // Its initialization, its body and what follows each iteration are steps of their own.
                continue;
            }
            if !step.writes.is_empty() && step.writes.iter().all(|write| self.is_set_uniform(write)) {
                // The program has replaced the value of the initialiser.
                continue;
            }
            let statement = step.statement.and_then(|id| self.stage.compiled.source.statements.get(id.0 as usize));
            let line = statement.map_or(1, |statement| self.line(statement.span));
            let key = step.statement.map(|id| (id, step.frame, step.iterations.clone()));
            let evaluated = key.as_ref().and_then(|key| conditions.remove(key)).unwrap_or_default();
            let returned = key.and_then(|key| returns.remove(&key));
            let empty = |line: u32| ListedStep { line, ..self.empty_step(step) };
            let first = step.writes.first().map(|write| self.line_of_write(write, line));
            if first.is_none() || !evaluated.is_empty() {
                steps.push(ListedStep { conditions: evaluated, writes: returned.into_iter().collect(), ..empty(line) });
            } else if let Some(first) = first {
                steps.push(empty(first));
            }
            for write in &step.writes {
                let line = self.line_of_write(write, line);
                if steps.last().is_none_or(|last| last.line != line) {
                    steps.push(empty(line));
                }
                if let (Some(last), Some(listed)) = (steps.last_mut(), self.write(write)) {
                    // Several writes of one variable in one step: the last one counts.
                    last.writes.retain(|known| known.name != listed.name);
                    last.writes.push(listed);
                }
            }
        }
        steps
    }

    fn is_set_uniform(&self, write: &TraceWrite) -> bool {
        let Some(variable) = self.stage.compiled.variables.get(write.variable as usize) else { return false };
        let inputs = self.stage.compiled.inputs.iter().enumerate();
        let mut found = inputs.filter(|(_, input)| input.rate == InputRate::Uniform && input.name == variable.name);
        found.any(|(index, _)| self.inputs.values(index).is_some())
    }

    fn empty_step(&self, step: &TraceStep) -> ListedStep {
        let (function, calls) = self.stage.call(step.frame);
        ListedStep {
            line: 0,
            function,
            calls,
            iterations: counted(&step.iterations),
            conditions: Vec::new(),
            writes: Vec::new(),
        }
    }

    /// The line of the assignment; for an initializer, of the declaration; for a parameter, of the function's header.
    fn line_of_write(&self, write: &TraceWrite, otherwise: u32) -> u32 {
        let declared = self.stage.compiled.variables.get(write.variable as usize).and_then(|variable| variable.span);
        let is_param = |span: &Span| self.syntax.headers.iter().any(|h| h.start <= span.start && span.end <= h.end);
        let written = write.expr.and_then(|expr| self.stage.compiled.source.expression(expr)).map(|e| e.span);
        match (written, declared) {
            (Some(written), Some(declared)) if is_param(&declared) && !self.is_within_function(written, declared) => {
                self.line(declared)
            }
            (Some(written), _) => self.line(written),
            (None, Some(declared)) => self.line(declared),
            (None, None) => otherwise,
        }
    }

    /// Whether a place is in the body of the function that declares a parameter.
    fn is_within_function(&self, place: Span, param: Span) -> bool {
        let header = self.syntax.headers.iter().filter(|header| header.start <= param.start).map(|h| h.start).max();
        let of_place = self.syntax.headers.iter().filter(|header| header.start <= place.start).map(|h| h.start).max();
        header == of_place
    }

    fn write(&self, write: &TraceWrite) -> Option<ListedVariable> {
        let variable = self.stage.compiled.variables.get(write.variable as usize)?;
        let is_written = |at: usize| write.written.get(at).copied().unwrap_or(false);
        Some(ListedVariable {
            name: variable.name.clone(),
            glsl_type: variable.ty.written(),
            value: self.stage.structs.value(&variable.ty, &write.values, is_written),
            line: variable.span.map(|span| self.line(span)),
            is_uniform: false,
            is_global: variable.span.is_none_or(|span| self.syntax.is_global(span)),
        })
    }

    /// The returned values by statement, call and iterations.
    fn returns(&self) -> HashMap<(StatementId, u32, Vec<u32>), ListedVariable> {
        let mut found = HashMap::new();
        for (expr, statement) in &self.syntax.returns {
            let source = self.stage.compiled.source.expression(*expr);
            let Some((ty, span)) = source.and_then(|source| Some((source.ty.clone()?, source.span))) else { continue };
            for (frame, iterations, bits, is_written) in self.seen.of(*expr) {
                let listed = ListedVariable {
                    name: "return".to_owned(),
                    glsl_type: ty.written(),
                    value: self.stage.structs.value(&ty, &bits, |_| is_written),
                    line: Some(self.line(span)),
                    is_uniform: false,
                    is_global: false,
                };
                found.insert((*statement, frame, iterations.to_vec()), listed);
            }
        }
        found
    }

    /// The values of conditions by statement, call and iterations.
    fn conditions(&self) -> HashMap<(StatementId, u32, Vec<u32>), Vec<ListedCondition>> {
        let mut found: HashMap<_, Vec<ListedCondition>> = HashMap::new();
        for (expr, statement) in &self.syntax.conditions {
            let Some(place) = self.place(*expr) else { continue };
            for (frame, iterations, bits, _) in self.seen.of(*expr) {
                let holds = bits.first().is_some_and(|bits| *bits != 0);
                let condition = ListedCondition { expression: place.expression.clone(), holds };
                found.entry((*statement, frame, iterations.to_vec())).or_default().push(condition);
            }
        }
        found
    }
}

fn array_of(ty: &gonio_glsl::Type, count: u32) -> gonio_glsl::Type {
    if count == 1 { ty.clone() } else { gonio_glsl::Type::Array(Box::new(ty.clone()), Some(count)) }
}
