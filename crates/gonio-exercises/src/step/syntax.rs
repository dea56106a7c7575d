//! The statements and expressions of a shader that a listing watches, and the values of one expression at one pixel or vertex.

use super::coverage::lane_in_quad;
use super::pair::{SteppedScene, SteppedStage};
use super::value::ShownValue;
use gonio_glsl::ast::{Declarator, Function};
use gonio_glsl::walk::{Visitor, walk_unit};
use gonio_glsl::{Expr, ExprKind, Span, Stage, Statement, StatementKind, Type};
use gonio_interpreter::{ExprId, PointValues, RunOptions, StatementId, run};
use std::collections::HashSet;
use std::ops::Range;

/// Expressions around a place that are tried: the target of an assignment has no value, but the assignment has.
const MOST_TRIED: usize = 6;

/// The parts of the syntax tree that a listing needs.
pub(super) struct Syntax {
    /// The conditions of `if` and `?:`, and the statement around each.
    pub conditions: Vec<(ExprId, StatementId)>,
    /// The values of `return`, and their statements.
    pub returns: Vec<(ExprId, StatementId)>,
    /// Loops and their spans.
    pub loops: Vec<(StatementId, Span)>,
    /// Statements that are recorded when they are executed.
    pub recorded: HashSet<StatementId>,
    pub discards: HashSet<StatementId>,
    /// The headers of functions.
    pub headers: Vec<Span>,
    /// The bytes of their bodies.
    bodies: Vec<Range<u32>>,
}

impl Syntax {
    pub fn new(stage: &SteppedStage) -> Self {
        let syntax = Self {
            conditions: Vec::new(),
            returns: Vec::new(),
            loops: Vec::new(),
            recorded: HashSet::new(),
            discards: HashSet::new(),
            headers: Vec::new(),
            bodies: Vec::new(),
        };
        let mut collector = Collector { stage, syntax, statement: None };
        walk_unit(&stage.parsed.unit, &mut collector);
        collector.syntax
    }

    /// Whether a declaration is outside of all functions.
    pub fn is_global(&self, declaration: Span) -> bool {
        let headers = self.headers.iter().map(|header| header.start..header.end);
        !headers.chain(self.bodies.iter().cloned()).any(|function| function.contains(&declaration.start))
    }
}

struct Collector<'a> {
    stage: &'a SteppedStage,
    syntax: Syntax,
    statement: Option<StatementId>,
}

impl Collector<'_> {
    fn condition(&mut self, expr: &Expr) {
        if let (Some(expr), Some(statement)) = (self.stage.compiled.source.id(expr), self.statement) {
            self.syntax.conditions.push((expr, statement));
        }
    }
}

impl Visitor for Collector<'_> {
    fn function(&mut self, function: &Function) -> bool {
        self.statement = None;
        self.syntax.headers.push(function.span);
        let body = function.body.as_deref().unwrap_or_default();
        if let (Some(first), Some(last)) = (body.first(), body.last()) {
            self.syntax.bodies.push(first.span.start..last.span.end);
        }
        true
    }

    fn statement(&mut self, statement: &Statement) -> bool {
        let Some(id) = self.stage.compiled.source.statement_id(statement) else { return true };
        match &statement.kind {
            StatementKind::Block(_) | StatementKind::Empty | StatementKind::Case(_) => return true,
            StatementKind::For { .. } | StatementKind::While { .. } | StatementKind::DoWhile { .. } => {
                self.syntax.loops.push((id, statement.span));
            }
            StatementKind::Return(Some(value)) => {
                self.syntax.returns.extend(self.stage.compiled.source.id(value).map(|value| (value, id)));
            }
            StatementKind::Discard => {
                self.syntax.discards.insert(id);
            }
            _ => {}
        }
        self.syntax.recorded.insert(id);
        self.statement = Some(id);
        if let StatementKind::If { condition, .. } = &statement.kind {
            self.condition(condition);
        }
        true
    }

    fn expression(&mut self, expr: &Expr) -> bool {
        if let ExprKind::Ternary { condition, .. } = &expr.kind {
            self.condition(condition);
        }
        true
    }
}

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
                (inputs, if quads { lane_in_quad(pixel, self.size()[1]) } else { 0 })
            }
            SteppedPlace::Vertex(vertex) => {
                let (object, within) = self.vertex(vertex)?;
                (self.inputs_of_vertices(object, &[within]), 0)
            }
        };
        let options = RunOptions {
            textures: &*self.textures,
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

/// The source of an expression, in one line.
pub(super) fn text_of(stage: &SteppedStage, expr: ExprId) -> String {
    let span = stage.compiled.source.expression(expr).map(|source| source.span).unwrap_or_default();
    one_line(stage.parsed.text(span))
}

/// The expressions around a place of the student's file, the smallest first.
pub(super) fn expressions_at(stage: &SteppedStage, line: u32, column: u32) -> Vec<ExprId> {
    let Some(byte) = byte_at(stage, line, column) else { return Vec::new() };
    let source = &stage.compiled.source;
    let around = |span: &Span| (span.start..span.end).contains(&byte);
    let mut found: Vec<(u32, ExprId)> = source
        .expressions
        .iter()
        .enumerate()
        .filter(|(_, expression)| around(&expression.span))
        .map(|(index, expression)| (expression.span.end - expression.span.start, ExprId(index as u32)))
        .collect();
    found.sort();
    if found.is_empty() {
        // The name of a variable that is declared with a value.
        let mut names = DeclaredNames { stage, byte, value: None };
        walk_unit(&stage.parsed.unit, &mut names);
        return names.value.into_iter().collect();
    }
    found.into_iter().map(|(_, expr)| expr).take(MOST_TRIED).collect()
}

struct DeclaredNames<'a> {
    stage: &'a SteppedStage,
    byte: u32,
    value: Option<ExprId>,
}

impl Visitor for DeclaredNames<'_> {
    fn declaration(&mut self, declaration: &gonio_glsl::ast::Declaration) -> bool {
        let is_here = |declarator: &&Declarator| {
            let start = declarator.span.start;
            (start..start + declarator.name.len() as u32).contains(&self.byte)
        };
        let here = declaration.declarators.iter().find(is_here);
        if let Some(value) = here.and_then(|declarator| declarator.initialiser.as_ref()) {
            self.value = self.stage.compiled.source.id(value);
        }
        true
    }
}

/// The byte of the stage's text at a line and column of the file.
fn byte_at(stage: &SteppedStage, line: u32, column: u32) -> Option<u32> {
    let mut start = 0;
    for (index, text) in stage.text.text.split_inclusive('\n').enumerate() {
        for (at, (offset, _)) in text.trim_end_matches('\n').char_indices().enumerate() {
            let (_, file_line, file_column) = stage.text.place(index as u32 + 1, at as u32 + 1);
            if (file_line, file_column) == (line, column) {
                return u32::try_from(start + offset).ok();
            }
        }
        start += text.len();
    }
    None
}

/// Iterations from 1.
pub(super) fn counted(iterations: &[u32]) -> Vec<u32> {
    iterations.iter().map(|iteration| iteration.saturating_add(1)).collect()
}

/// Source with single spaces for line ends and indentation.
pub(super) fn one_line(source: &str) -> String {
    source.split_whitespace().collect::<Vec<_>>().join(" ")
}
