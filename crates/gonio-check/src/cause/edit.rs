//! Edits of a student's text that give wrong expressions their right values.

use super::formula::{Definitions, Formula, Style, Writer};
use super::model::{Model, STAGES};
use super::observed::{Observed, Observer};
use super::program::{Change, Program, Runner};
use super::proven_cause::ProvenCause;
use super::repair::{Make, Relation, Repair};
use super::samples::interpolated;
use super::scope::{Level, Readable, Scopes, expression_at, level_of};
use super::seeing::see;
use super::target::Seen;
use super::values::Values;
use crate::roles::NamesFile;
use gonio_glsl::ast::{BinaryOp, UnaryOp};
use gonio_glsl::walk::{Visitor, parts, walk_unit};
use gonio_glsl::{Checked, Expr, ExprKind, Item, Parsed, Severity, Stage, TokenRange};
use std::cell::RefCell;

/// A change of the text of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    /// The stage.
    pub stage: Stage,
    /// The first byte that is replaced.
    pub start: u32,
    /// One past the last byte that is replaced; equal to `start` for an insertion.
    pub end: u32,
    /// The new text.
    pub text: String,
}

/// Changes that belong together.
pub type TextFix = Vec<TextEdit>;

/// Applies the edits of a stage to its text. Edits that overlap apply in none.
#[must_use]
pub fn edited(text: &str, stage: Stage, edits: &[TextEdit]) -> Option<String> {
    let mut own: Vec<&TextEdit> = edits.iter().filter(|edit| edit.stage == stage).collect();
    own.sort_by_key(|edit| (edit.start, edit.end));
    let mut made = String::with_capacity(text.len() + 64);
    let mut at = 0;
    for edit in own {
        made.push_str(text.get(at..edit.start as usize)?);
        made.push_str(&edit.text);
        at = edit.end as usize;
    }
    made.push_str(text.get(at..)?);
    Some(made)
}

/// Tries fixes with the interpreter.
pub(crate) struct Trial<'a> {
    /// The student's program.
    pub at: Observer<'a>,
    /// The texts of both stages.
    pub texts: [&'a str; 2],
    /// Names given by the student.
    pub names: &'a NamesFile,
}

impl Trial<'_> {
    /// The picture of all scenes with a fix; `None` if the new text does not compile, or a run does not end.
    #[must_use]
    pub fn picture(&self, fix: &TextFix) -> Option<Seen> {
        let new = STAGES.map(|stage| edited(self.texts[stage as usize], stage, fix));
        let [Some(vertex), Some(fragment)] = &new else { return None };
        let stages = [(Stage::Vertex, vertex), (Stage::Fragment, fragment)].map(|(stage, text)| {
            let mut parsed = gonio_glsl::parse(text);
            let checked = gonio_glsl::check(&mut parsed, stage);
            (parsed, checked)
        });
        let has_error = |(parsed, checked): &(Parsed, Checked)| {
            parsed.problems.iter().chain(&checked.problems).any(|problem| problem.severity == Severity::Error)
        };
        if stages.iter().any(has_error) {
            return None;
        }
        let [v, f] = &stages;
        let mut program = Program::new((&v.0, &v.1), (&f.0, &f.1), [vertex, fragment], self.names).ok()?;
        let known = self.at.runner.program;
        program.bindings.adopt(&known.bindings);
        program.declared.adopt(&known.declared);
        let runner = Runner::new(&program, self.at.runner.samples);
        see(&runner, &[], 0..runner.samples.len())
    }
}

/// Most causes of a group for which edits are made.
const MOST_CAUSES: usize = 8;
/// Most edits of one cause.
const MOST_OF_CAUSE: usize = 3;
/// The characters that a fix of the next cause must be smaller by to be tried first.
const RANK_COST: usize = 24;
/// The same for a fix where a variable is computed and not where it is read.
const READ_COST: usize = 16;
/// Most fixes that are tried.
const MOST_FIXES: usize = 12;

/// Makes edits for the causes of one program.
pub(crate) struct Editor<'a> {
    at: Observer<'a>,
    scopes: [Scopes<'a>; 2],
    texts: [&'a str; 2],
    definitions: Definitions,
}

impl<'a> Editor<'a> {
    /// Creates an editor.
    #[must_use]
    pub fn new(at: Observer<'a>, scopes: [Scopes<'a>; 2], texts: [&'a str; 2]) -> Self {
        Editor { at, scopes, texts, definitions: Definitions::new(at.model.method) }
    }

    /// Fixes of all groups of causes, the most promising first.
    #[must_use]
    pub fn fixes(&self, groups: &[Vec<ProvenCause>]) -> Vec<TextFix> {
        let all = 0..self.at.runner.samples.len();
        let plain = self.at.observe(&[], all.clone());
        let mut of_groups: Vec<Vec<TextFix>> = Vec::new();
        for (index, group) in groups.iter().enumerate() {
            // The values with the other causes repaired.
            let others = groups.iter().enumerate().filter(|(other, _)| *other != index);
            let firsts = others.filter_map(|(_, group)| group.first());
            let changes: Vec<Change> = firsts.filter_map(|cause| self.change(cause, &plain)).collect();
            let observed = if changes.is_empty() { plain.clone() } else { self.at.observe(&changes, all.clone()) };
            let varyings = self.varyings(&observed);
            let mut fixes: Vec<(usize, TextFix)> = Vec::new();
            for (rank, cause) in group.iter().take(MOST_CAUSES).enumerate() {
                for fix in self.of_cause(cause, &observed, &varyings).into_iter().take(MOST_OF_CAUSE) {
                    if !fixes.iter().any(|(_, known)| *known == fix) {
                        let of_read = if self.is_read(cause) { READ_COST } else { 0 };
                        fixes.push((self.size(&fix) + RANK_COST * rank + of_read, fix));
                    }
                }
            }
            fixes.sort_by_key(|(cost, _)| *cost);
            of_groups.push(fixes.into_iter().map(|(_, fix)| fix).collect());
        }
        let alone = of_groups.iter().filter(|_| of_groups.len() > 1).flat_map(|fixes| fixes.iter().take(2));
        let alone: Vec<TextFix> = alone.cloned().collect();
        let mut of_groups = of_groups.into_iter();
        let Some(mut together) = of_groups.next() else { return Vec::new() };
        for next in of_groups {
            let mut pairs: Vec<(usize, TextFix)> = Vec::new();
            for (i, first) in together.iter().enumerate() {
                for (j, second) in next.iter().enumerate() {
                    pairs.push((i + j, first.iter().chain(second).cloned().collect()));
                }
            }
            pairs.sort_by_key(|(rank, _)| *rank);
            together = pairs.into_iter().map(|(_, fix)| fix).collect();
        }
        together.truncate(MOST_FIXES);
        together.extend(alone);
        together
    }

    /// The values of the fragment shader's inputs that it does not read.
    fn varyings(&self, observed: &[Observed]) -> Vec<(String, Values)> {
        let [vertex, fragment] = &self.scopes;
        let outputs = vertex.outputs(&self.at.runner.program.vertex.source, observed);
        let of = |name: &str| outputs.iter().find(|(output, _)| *output == name).map(|(_, values)| *values);
        let unread = fragment.unread().filter_map(|name| Some((name.to_owned(), of(name)?)));
        unread.map(|(name, values)| (name, interpolated(values, self.at.runner.samples))).collect()
    }

    /// Whether a cause is a variable that is read.
    fn is_read(&self, cause: &ProvenCause) -> bool {
        let tokens = self.at.runner.program.stage(cause.stage).source.expressions[cause.expr.0 as usize].tokens;
        tokens.first == tokens.last
    }

    /// The number of characters that a fix changes.
    fn size(&self, fix: &TextFix) -> usize {
        let of = |edit: &TextEdit| {
            let old = self.texts[edit.stage as usize].get(edit.start as usize..edit.end as usize).unwrap_or_default();
            let same = |a: &mut dyn Iterator<Item = char>, b: &mut dyn Iterator<Item = char>| {
                a.zip(b).take_while(|(a, b)| a == b).count()
            };
            if edit.text.contains(old) {
                return edit.text.len() - old.len();
            }
            let (long, short) = (old.len().max(edit.text.len()), old.len().min(edit.text.len()));
            let start = same(&mut old.chars(), &mut edit.text.chars());
            let end = same(&mut old.chars().rev(), &mut edit.text.chars().rev());
            long - (start + end).min(short)
        };
        fix.iter().map(of).sum()
    }

    /// The change of values that a cause stands for.
    fn change(&self, cause: &ProvenCause, observed: &[Observed]) -> Option<Change> {
        let find = |expr| {
            observed.iter().position(|seen| {
                seen.stage == cause.stage
                    && seen.expr == expr
                    && (expr != cause.expr || seen.occurrence == cause.occurrence)
            })
        };
        let make = match cause.make {
            Make::Plus(_) => Make::Plus(find(cause.added?)?),
            make => make,
        };
        let (should, cost) = (String::new(), 0.0);
        Repair { of: find(cause.expr)?, relation: Relation::Other, should, make, cost }.change(observed, self.at.model)
    }

    /// The edits of one cause, the shortest first.
    fn of_cause(&self, cause: &ProvenCause, observed: &[Observed], varyings: &[(String, Values)]) -> Vec<TextFix> {
        let scopes = &self.scopes[cause.stage as usize];
        let text = self.texts[cause.stage as usize];
        let source = &self.at.runner.program.stage(cause.stage).source;
        let tokens = source.expressions[cause.expr.0 as usize].tokens;
        let is_in_file = |at: u32| scopes.parsed.tokens.get(at as usize).is_some_and(|token| token.region == 0);
        if !is_in_file(tokens.first) || !is_in_file(tokens.last) {
            return Vec::new();
        }
        let Some(expr) = expression_at(scopes.parsed, tokens) else { return Vec::new() };
        let mut readable = scopes.readable(source, observed, tokens, cause.occurrence);
        readable.extend(varyings.iter().filter(|_| cause.stage == Stage::Fragment).map(|(name, values)| Readable {
            text: name.clone(),
            is_name: true,
            tokens,
            values,
        }));
        let writer = Writer {
            program: self.at.runner.program,
            model: self.at.model,
            definitions: &self.definitions,
            scopes,
            readable,
            place: tokens,
            stage: cause.stage,
            style: Style::of(text),
            known: RefCell::default(),
        };
        let maker = Maker { writer, expr: &expr, observed, source, model: self.at.model };
        let mut made = maker.made(cause);
        made.sort_by_key(|formula| formula.text.len() + 60 * formula.needs.len());
        made.dedup();
        let around = level_around(scopes, tokens);
        let own = scopes.parsed.text(expr.span);
        let fixes = made.into_iter().filter_map(|formula| {
            let new = formula.within(around);
            if new == own {
                return None;
            }
            let edit = |start, end| TextEdit { stage: cause.stage, start, end, text: new.clone() };
            let mut fix = vec![edit(expr.span.start, expr.span.end)];
            // The same variable at other places.
            let others = cause.also.iter().filter(|(stage, _)| *stage == cause.stage);
            let spans = others.map(|(_, other)| source.expressions[other.0 as usize].span);
            for span in spans.filter(|span| scopes.parsed.text(*span) == own) {
                let other = edit(span.start, span.end);
                if !fix.contains(&other) {
                    fix.push(other);
                }
            }
            for need in &formula.needs {
                fix.push(self.declaration(cause.stage, need)?);
            }
            Some(fix)
        });
        fixes.collect()
    }

    /// A new line that declares a uniform, after the last uniform or before the first function.
    fn declaration(&self, stage: Stage, declared: &str) -> Option<TextEdit> {
        let scopes = &self.scopes[stage as usize];
        let items = &scopes.parsed.unit.items;
        let is_uniform =
            |item: &&Item| matches!(item, Item::Declaration(d) if gonio_glsl::ast::has(&d.qualifiers, "uniform"));
        let last =
            items.iter().rfind(is_uniform).or_else(|| items.iter().rfind(|item| matches!(item, Item::Declaration(_))));
        let Some(Item::Declaration(last)) = last else { return None };
        let text = self.texts[stage as usize];
        let end = last.span.end as usize;
        let semicolon = end.max(text.get(..end)?.len());
        let at = if text.get(..end)?.ends_with(';') { end } else { semicolon + text.get(semicolon..)?.find(';')? + 1 };
        Some(TextEdit { stage, start: at as u32, end: at as u32, text: format!("\nuniform {declared};") })
    }
}

/// Whether a quantity is a unit vector.
fn is_unit(values: &Values) -> bool {
    values.size == 3 && values.unit().is_same(values)
}

/// The level that an expression must have where it stands, to need no parentheses.
fn level_around(scopes: &Scopes<'_>, tokens: TokenRange) -> Level {
    struct Finder(TokenRange, Level);
    impl Visitor for Finder {
        fn expression(&mut self, expr: &Expr) -> bool {
            for (index, _) in parts(expr).iter().enumerate().filter(|(_, part)| part.tokens == self.0) {
                self.1 = match &expr.kind {
                    ExprKind::Binary { op: BinaryOp::Add, .. } => Level::Sum,
                    ExprKind::Binary { op: BinaryOp::Subtract, .. } if index == 0 => Level::Sum,
                    ExprKind::Binary { op: BinaryOp::Subtract | BinaryOp::Multiply, .. } => Level::Product,
                    ExprKind::Binary { op: BinaryOp::Divide, .. } if index == 0 => Level::Product,
                    ExprKind::Binary { op: BinaryOp::Divide, .. } | ExprKind::Unary { .. } => Level::Sign,
                    ExprKind::Binary { .. } | ExprKind::Ternary { .. } => Level::Sum,
                    ExprKind::Field { .. } | ExprKind::Length(_) => Level::Whole,
                    ExprKind::Index { .. } if index == 0 => Level::Whole,
                    _ => Level::Loose,
                };
            }
            true
        }
    }
    let mut finder = Finder(tokens, Level::Loose);
    walk_unit(&scopes.parsed.unit, &mut finder);
    finder.1
}

/// Makes new texts for one expression.
struct Maker<'a> {
    writer: Writer<'a>,
    expr: &'a Expr,
    observed: &'a [Observed],
    source: &'a gonio_interpreter::SourceMap,
    model: &'a Model,
}

impl Maker<'_> {
    fn text(&self, expr: &Expr) -> &str {
        self.writer.scopes.parsed.text(expr.span)
    }

    fn own(&self, expr: &Expr) -> Formula {
        let text = self.text(expr);
        Formula::new(text, level_of(expr, text))
    }

    fn values(&self, expr: &Expr) -> Option<&Values> {
        let id = self.source.id(expr)?;
        self.observed.iter().find(|seen| seen.stage == self.writer.stage && seen.expr == id).map(|seen| &seen.values)
    }

    /// New texts for what a cause should be.
    fn made(&self, cause: &ProvenCause) -> Vec<Formula> {
        let (style, own) = (self.writer.style, self.own(self.expr));
        let written = |index: usize| {
            let quantity = self.model.quantities.get(index)?;
            self.writer.best(&quantity.name, quantity.values.size, quantity.space)
        };
        let joined = |left: &Formula, mark: &str, right: Formula, level: Level, of_right: Level| {
            let text = style.binary(&left.within(level), mark, &right.within(of_right));
            Formula { needs: right.needs, ..Formula::new(text, level) }
        };
        match cause.make {
            Make::Quantity(index) => {
                let Some(quantity) = self.model.quantities.get(index) else { return Vec::new() };
                let mut all = self.writer.options(&quantity.name, quantity.values.size, quantity.space);
                if self.values(self.expr).is_some_and(|own| own.is_reciprocal(&quantity.values)) {
                    all.push(Formula::new(
                        style.binary(&style.number("1.0"), "/", &own.within(Level::Sign)),
                        Level::Product,
                    ));
                }
                // Where a value is the right one up to its sign or length, the student's own text stays.
                match cause.relation {
                    Relation::Sign => all.push(self.negative(self.expr)),
                    Relation::Length => all.push(self.unit()),
                    Relation::Clamp => all.push(self.not_negative()),
                    // The direction of the student's own vector may be right by another method.
                    Relation::Known if is_unit(&quantity.values) && !self.values(self.expr).is_some_and(is_unit) => {
                        all.push(self.unit());
                    }
                    _ => {}
                }
                all
            }
            Make::Negative => vec![self.negative(self.expr)],
            Make::Unit => vec![self.unit()],
            Make::NotNegative => vec![self.not_negative()],
            Make::Linear => self.replaced_within(self.expr, &|expr| match &expr.kind {
                ExprKind::Call(call) if call.name == "pow" => call.args.first().map(|arg| self.own(arg)),
                _ => None,
            }),
            Make::Times(index) => written(index)
                .map(|factor| joined(&own, "*", factor, Level::Product, Level::Product))
                .into_iter()
                .collect(),
            Make::Over(index) => {
                let mut all = self.without_factor(index);
                all.extend(written(index).map(|factor| joined(&own, "/", factor, Level::Product, Level::Sign)));
                all
            }
            Make::Plus(_) => {
                self.added(cause).map(|other| joined(&own, "+", other, Level::Sum, Level::Sum)).into_iter().collect()
            }
        }
    }

    fn unit(&self) -> Formula {
        Formula::new(self.writer.style.call("normalize", &[self.text(self.expr).to_owned()]), Level::Whole)
    }

    fn not_negative(&self) -> Formula {
        let style = self.writer.style;
        let args = [self.own(self.expr).within(Level::Sum), style.number("0.0")];
        Formula::new(style.call("max", &args), Level::Whole)
    }

    /// The negative of an expression: without its minus, with the operands of a difference exchanged, or with a minus.
    fn negative(&self, expr: &Expr) -> Formula {
        match &expr.kind {
            ExprKind::Unary { op: UnaryOp::Minus, operand } => self.own(operand),
            ExprKind::Binary { op: BinaryOp::Subtract, left, right } => {
                let (left, right) = (self.own(left).within(Level::Product), self.own(right).within(Level::Sum));
                Formula::new(self.writer.style.binary(&right, "-", &left), Level::Sum)
            }
            ExprKind::Call(call) if call.name == "normalize" && call.args.len() == 1 => {
                let inner = self.negative(&call.args[0]);
                Formula::new(self.writer.style.call("normalize", &[inner.text]), Level::Whole)
            }
            _ => Formula::new(format!("-{}", self.own(expr).within(Level::Product)), Level::Sign),
        }
    }

    /// The text of the whole expression for each part that can be replaced.
    fn replaced_within(&self, expr: &Expr, new: &dyn Fn(&Expr) -> Option<Formula>) -> Vec<Formula> {
        let mut all = Vec::new();
        if let Some(formula) = new(expr) {
            let (whole, level) = (self.text(self.expr), self.own(self.expr).level);
            let (start, end) = (expr.span.start - self.expr.span.start, expr.span.end - self.expr.span.start);
            let is_whole = expr.tokens == self.expr.tokens;
            let around = level_around(self.writer.scopes, expr.tokens);
            let text = if is_whole { formula.text.clone() } else { formula.within(around) };
            if let (Some(before), Some(after)) = (whole.get(..start as usize), whole.get(end as usize..)) {
                let level = if is_whole { formula.level } else { level };
                all.push(Formula { needs: formula.needs, ..Formula::new(format!("{before}{text}{after}"), level) });
            }
        }
        for part in parts(expr) {
            all.extend(self.replaced_within(part, new));
        }
        all
    }

    /// The text without a factor, by its index in the model's quantities.
    fn without_factor(&self, index: usize) -> Vec<Formula> {
        let Some(factor) = self.model.quantities.get(index).map(|quantity| &quantity.values) else { return Vec::new() };
        let is_it = |expr: &Expr| {
            self.values(expr).is_some_and(|values| {
                values.is_same(factor)
                    || factor.size == 1 && values.is_same(&factor.map(values.size, |_, from, to| to.fill(from[0])))
            })
        };
        self.replaced_within(self.expr, &|expr| match &expr.kind {
            ExprKind::Binary { op: BinaryOp::Multiply, left, right } if is_it(right) => Some(self.own(left)),
            ExprKind::Binary { op: BinaryOp::Multiply, left, right } if is_it(left) => Some(self.own(right)),
            _ => None,
        })
    }

    /// The text of a missing summand.
    fn added(&self, cause: &ProvenCause) -> Option<Formula> {
        let expr = cause.added?;
        let other = self.observed.iter().find(|seen| seen.stage == cause.stage && seen.expr == expr)?;
        self.writer.own_values(&other.values)
    }
}
