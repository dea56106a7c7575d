//! Executes `if` and `switch` symbolically: where two branches leave different values, the value is a choice between
//! them.

use super::graph::{Graph, Id, Op};
use super::run::{Flow, Runner};
use gonio_glsl::ast::{BinaryOp, Expr};
use gonio_glsl::{Span, Statement, StatementKind, Type};

/// Most entries of a `switch` that are followed.
const MOST_ENTRIES: usize = 32;

/// An entry of a `switch`.
struct SwitchEntry<'a> {
    /// The values of its labels.
    labels: Vec<&'a Expr>,
    is_default: bool,
    /// All statements from there on: without a `break`, execution continues with those of the next label.
    body: &'a [Statement],
}

/// Returns the entries of a `switch` in order. Adjacent labels are one entry.
fn entries(body: &[Statement]) -> Vec<SwitchEntry<'_>> {
    let mut entries: Vec<SwitchEntry> = Vec::new();
    let mut follows_label = false;
    for (index, statement) in body.iter().enumerate() {
        let StatementKind::Case(label) = &statement.kind else {
            follows_label = false;
            continue;
        };
        let body = &body[index + 1..];
        match entries.last_mut().filter(|_| follows_label) {
            Some(entry) => entry.body = body,
            None => entries.push(SwitchEntry { labels: Vec::new(), is_default: false, body }),
        }
        if let Some(entry) = entries.last_mut() {
            entry.labels.extend(label);
            entry.is_default |= label.is_none();
        }
        follows_label = true;
    }
    entries
}

impl<'a> Runner<'a> {
    pub(crate) fn branch(
        &mut self,
        condition: &'a Expr,
        then: &'a Statement,
        otherwise: Option<&'a Statement>,
    ) -> Flow {
        let test = self.expression(condition);
        self.either(
            test,
            condition.span,
            |runner| runner.in_scope(|runner| runner.statement(then)),
            |runner| match otherwise {
                Some(otherwise) => runner.in_scope(|runner| runner.statement(otherwise)),
                None => Flow::Next,
            },
        )
    }

    /// Executes a `switch` as a chain of `if`s, one for each entry; `default` is the last `else`, wherever it is
    /// written.
    pub(crate) fn switch(&mut self, value: &'a Expr, body: &'a [Statement]) -> Flow {
        let span = value.span;
        let value = self.expression(value);
        let mut entries = entries(body);
        let default = entries.iter().position(|entry| entry.is_default).map(|at| entries.remove(at));
        entries.truncate(MOST_ENTRIES);
        self.first_of((value, span), &entries, default.as_ref())
    }

    fn first_of(&mut self, value: (Id, Span), entries: &[SwitchEntry<'a>], default: Option<&SwitchEntry<'a>>) -> Flow {
        let Some((entry, others)) = entries.split_first() else {
            return default.map_or(Flow::Next, |entry| self.entry(entry));
        };
        // Each branch is nested in the previous one, like an `else if`.
        let flow = if self.enter() {
            let test = self.leads_to(value, entry);
            self.either(test, value.1, |runner| runner.entry(entry), |runner| runner.first_of(value, others, default))
        } else {
            Flow::Left
        };
        self.leave();
        flow
    }

    fn entry(&mut self, entry: &SwitchEntry<'a>) -> Flow {
        match self.in_scope(|runner| runner.statements(entry.body)) {
            Flow::Broke => Flow::Next,
            flow => flow,
        }
    }

    /// Returns the node that compares the value with the labels of an entry.
    fn leads_to(&mut self, (value, span): (Id, Span), entry: &SwitchEntry<'a>) -> Id {
        let mut any = None;
        for label in &entry.labels {
            let number = self.expression(label);
            let is_it = self.push(Op::Binary(BinaryOp::Equal, value, number), span, Some(&Type::BOOL));
            any = Some(match any {
                Some(others) => self.push(Op::Binary(BinaryOp::Or, others, is_it), span, Some(&Type::BOOL)),
                None => is_it,
            });
        }
        any.unwrap_or(Graph::UNKNOWN)
    }

    /// Executes both branches from the same state; values that differ afterwards become a choice. If the test is
    /// known, only one branch is executed.
    fn either(
        &mut self,
        test: Id,
        span: Span,
        then: impl FnOnce(&mut Self) -> Flow,
        otherwise: impl FnOnce(&mut Self) -> Flow,
    ) -> Flow {
        if let Some(known) = self.graph.scalar(test) {
            return if known != 0.0 { then(self) } else { otherwise(self) };
        }
        self.pay_for(self.scopes.len());
        let before = self.scopes.clone();
        self.conditions.push(test);
        let first = then(self);
        let after = std::mem::replace(&mut self.scopes, before);
        let second = otherwise(self);
        self.conditions.pop();
        for (index, scope) in after.into_iter().enumerate() {
            for (name, a) in scope {
                let Some(b) = self.scopes.get(index).and_then(|scope| scope.get(&name)).copied() else { continue };
                // A branch that left does not continue with its locals, but its outputs count.
                let merged = match (first == Flow::Next, second == Flow::Next) {
                    (false, true) if index > 0 => b,
                    (true, false) if index > 0 => a,
                    _ if a == b || a == Graph::UNKNOWN => b,
                    _ if b == Graph::UNKNOWN => a,
                    _ => self.graph.push_like(Op::Select(test, a, b), a, self.stage, span),
                };
                self.scopes[index].insert(name, merged);
            }
        }
        match (first, second) {
            (Flow::Next, _) | (_, Flow::Next) => Flow::Next,
            (Flow::Left, Flow::Left) => Flow::Left,
            _ => Flow::Broke,
        }
    }
}
