//! Which values a place in a student's source can read: names in scope there, and expressions of such names.

use super::observed::Observed;
use super::values::Values;
use gonio_glsl::ast::{Declaration, Expr, ExprKind, Function, Statement, StatementKind};
use gonio_glsl::walk::{Visitor, walk_unit};
use gonio_glsl::{Checked, Parsed, Span, Stage, TokenRange};
use gonio_glsl::{Storage, SymbolKind, Type};
use gonio_interpreter::{ExprId, SourceMap};

/// A variable, and where it can be read.
struct Visible {
    /// The first token after its declaration.
    from: u32,
    /// The last token of its block.
    to: u32,
}

/// The names and assignments of a shader.
pub(crate) struct Scopes<'a> {
    pub parsed: &'a Parsed,
    pub checked: &'a Checked,
    stage: Stage,
    visible: Vec<Visible>,
    /// The symbol, the assigned value and the first token after the assignment.
    assigned: Vec<(usize, TokenRange, u32)>,
    /// Expressions that change a variable.
    changing: Vec<TokenRange>,
    /// How often each symbol is assigned after its declaration.
    writes: Vec<usize>,
}

/// An expression that a place can read instead of its own.
#[derive(Clone, Debug)]
pub(crate) struct Readable<'o> {
    /// Its text.
    pub text: String,
    /// Whether it is a variable.
    pub is_name: bool,
    /// The expression in the source, unless the text is a name of another place.
    pub tokens: TokenRange,
    /// Its values.
    pub values: &'o Values,
}

/// Collects blocks, declarations and assignments.
#[derive(Default)]
struct Collector {
    blocks: Vec<TokenRange>,
    /// The declared name, its value, and the last token.
    declared: Vec<(u32, Option<TokenRange>, u32)>,
    assigned: Vec<(u32, TokenRange, u32)>,
    changing: Vec<TokenRange>,
    targets: Vec<TokenRange>,
}

impl Visitor for Collector {
    fn function(&mut self, function: &Function) -> bool {
        self.blocks.push(function.tokens);
        true
    }

    fn declaration(&mut self, declaration: &Declaration) -> bool {
        for declarator in &declaration.declarators {
            let value = declarator.initialiser.as_ref().map(|value| value.tokens);
            let last = value.map_or(declarator.tokens.last, |value| value.last);
            self.declared.push((declarator.tokens.first, value, last));
        }
        true
    }

    fn statement(&mut self, statement: &Statement) -> bool {
        if matches!(statement.kind, StatementKind::Block(_) | StatementKind::For { .. } | StatementKind::While { .. }) {
            self.blocks.push(statement.tokens);
        }
        true
    }

    fn expression(&mut self, expr: &Expr) -> bool {
        use gonio_glsl::ast::UnaryOp::{PostDecrement, PostIncrement, PreDecrement, PreIncrement};
        match &expr.kind {
            ExprKind::Assign { op, target, value } => {
                self.changing.push(expr.tokens);
                self.targets.push(target.tokens);
                if op.is_none() && matches!(target.kind, ExprKind::Name(_)) {
                    self.assigned.push((target.tokens.first, value.tokens, value.tokens.last));
                }
            }
            ExprKind::Unary { op: PostDecrement | PostIncrement | PreDecrement | PreIncrement, operand } => {
                self.changing.push(expr.tokens);
                self.targets.push(operand.tokens);
            }
            _ => {}
        }
        true
    }
}

fn is_within(inner: TokenRange, outer: TokenRange) -> bool {
    inner.first >= outer.first && inner.last <= outer.last
}

impl<'a> Scopes<'a> {
    /// Reads a shader.
    #[must_use]
    pub fn new(parsed: &'a Parsed, checked: &'a Checked) -> Self {
        let mut collector = Collector::default();
        walk_unit(&parsed.unit, &mut collector);
        let mut assigned = Vec::new();
        let visible = (checked.symbols.iter().enumerate())
            .map(|(id, symbol)| {
                let at = symbol.declared.first;
                let declared = collector.declared.iter().find(|(name, ..)| *name == at);
                let from = declared.map_or(at, |(.., last)| *last) + 1;
                if let Some((_, Some(value), last)) = declared {
                    assigned.push((id, *value, last + 1));
                }
                for (target, value, last) in &collector.assigned {
                    if symbol.uses.iter().any(|used| used.first == *target) {
                        assigned.push((id, *value, last + 1));
                    }
                }
                let around = collector.blocks.iter().filter(|block| block.first <= at && at <= block.last);
                let is_local = matches!(symbol.kind, SymbolKind::Local | SymbolKind::Param);
                let to = around.filter(|_| is_local).map(|block| block.last).min().unwrap_or(u32::MAX);
                Visible { from, to }
            })
            .collect();
        let writes = (checked.symbols.iter())
            .map(|symbol| {
                let is_target = |target: &&TokenRange| symbol.uses.iter().any(|used| used.first == target.first);
                let targets = collector.targets.iter().filter(is_target).count();
                // Arguments of `out` parameters are written too.
                if symbol.is_written { targets.max(1) } else { 0 }
            })
            .collect();
        let changing = collector.changing;
        Scopes { parsed, checked, stage: checked.stage, visible, assigned, changing, writes }
    }

    fn is_visible(&self, symbol: usize, place: TokenRange) -> bool {
        let Visible { from, to } = self.visible[symbol];
        let is_hidden = || {
            // A later declaration of the same name hides it.
            (0..self.visible.len()).any(|other| {
                other != symbol
                    && self.checked.symbols[other].name == self.checked.symbols[symbol].name
                    && self.visible[other].from > from
                    && self.visible[other].from <= place.first
                    && place.first <= self.visible[other].to
            })
        };
        from <= place.first && place.first <= to && !is_hidden()
    }

    /// Whether a variable has the same value wherever it is read after its only assignment, which is before a place.
    fn is_kept(&self, symbol: usize, place: TokenRange) -> bool {
        let once = || {
            let mut assigned = self.assigned.iter().filter(|(of, ..)| *of == symbol);
            let is_before = assigned.next().is_some_and(|(.., from)| *from <= place.first);
            self.writes[symbol] == 1 && !self.checked.symbols[symbol].has_initialiser && is_before
        };
        self.is_visible(symbol, place) && (self.writes[symbol] == 0 || once())
    }

    /// The symbols that an expression reads.
    fn used(&self, tokens: TokenRange) -> impl Iterator<Item = usize> + '_ {
        (self.checked.symbols.iter().enumerate())
            .filter(move |(_, symbol)| symbol.uses.iter().any(|used| is_within(*used, tokens)))
            .map(|(id, _)| id)
    }

    /// Whether a name can be declared at the start of the shader without hiding another one.
    #[must_use]
    pub fn is_free(&self, name: &str) -> bool {
        self.checked.symbols.iter().all(|symbol| symbol.name != name)
    }

    /// Whether a global name can be read at a place.
    #[must_use]
    pub fn is_readable(&self, name: &str, place: TokenRange) -> bool {
        let root = name.split(['.', '[']).next().unwrap_or(name);
        let mut named = self.checked.symbols.iter().enumerate().filter(|(_, symbol)| symbol.name == root);
        named.any(|(id, symbol)| symbol.kind == SymbolKind::Global && self.is_visible(id, place))
    }

    /// The variable that is the index of uniforms, if one can be read at a place.
    #[must_use]
    pub fn index_at(&self, place: TokenRange) -> Option<&'a str> {
        struct Indices(Vec<(TokenRange, Span)>);
        impl Visitor for Indices {
            fn expression(&mut self, expr: &Expr) -> bool {
                if let ExprKind::Index { index, .. } = &expr.kind
                    && matches!(index.kind, ExprKind::Name(_))
                {
                    self.0.push((index.tokens, index.span));
                }
                true
            }
        }
        let mut indices = Indices(Vec::new());
        walk_unit(&self.parsed.unit, &mut indices);
        let mut readable = indices.0.into_iter().filter(|(tokens, _)| {
            self.used(*tokens).all(|id| {
                let is_local = matches!(self.checked.symbols[id].kind, SymbolKind::Local | SymbolKind::Param);
                is_local && self.is_visible(id, place)
            })
        });
        readable.next().map(|(_, span)| self.parsed.text(span))
    }

    /// The values that a vertex shader hands on, by the last assignment to each output.
    #[must_use]
    pub fn outputs<'o>(&self, source: &SourceMap, observed: &'o [Observed]) -> Vec<(&'a str, &'o Values)> {
        let value_of = |tokens: TokenRange| {
            let is_it = |seen: &&Observed| {
                seen.stage == self.stage && source.expressions[seen.expr.0 as usize].tokens == tokens
            };
            observed.iter().find(is_it).map(|seen| &seen.values)
        };
        let outputs = self.checked.symbols.iter().enumerate().filter(|(_, symbol)| symbol.storage == Storage::Out);
        let last = outputs.filter_map(|(id, symbol)| {
            let (_, value, _) = self.assigned.iter().filter(|(of, ..)| *of == id).max_by_key(|(.., from)| *from)?;
            Some((symbol.name.as_str(), value_of(*value)?))
        });
        last.collect()
    }

    /// Inputs that are declared and not read.
    pub fn unread(&self) -> impl Iterator<Item = &'a str> + '_ {
        let unread =
            self.checked.symbols.iter().filter(|symbol| symbol.storage == Storage::In && symbol.uses.is_empty());
        unread.map(|symbol| symbol.name.as_str())
    }

    /// The expressions of this stage that could stand at a place, with their values, the shortest first.
    #[must_use]
    pub fn readable<'o>(
        &self,
        source: &SourceMap,
        observed: &'o [Observed],
        place: TokenRange,
        occurrence: Option<u32>,
    ) -> Vec<Readable<'o>> {
        let here: Vec<(ExprId, TokenRange, &Observed)> = (observed.iter())
            .filter(|seen| seen.stage == self.stage && (seen.occurrence.is_none() || seen.occurrence == occurrence))
            .map(|seen| (seen.expr, source.expressions[seen.expr.0 as usize].tokens, seen))
            .collect();
        let value_of = |tokens: TokenRange| here.iter().find(|(_, at, _)| *at == tokens).map(|(.., seen)| &seen.values);
        let mut all = Vec::new();
        for (id, symbol) in self.checked.symbols.iter().enumerate() {
            let is_variable = matches!(symbol.kind, SymbolKind::Global | SymbolKind::Local | SymbolKind::Param);
            if !is_variable || !self.is_visible(id, place) {
                continue;
            }
            // The last value before the place: assigned, or seen where it is read.
            let assigned = self.assigned.iter().filter(|(of, ..)| *of == id).map(|(_, value, from)| (*from, *value));
            let read = symbol.uses.iter().map(|used| (used.last, *used));
            let last = assigned
                .chain(read)
                .filter(|(from, value)| {
                    (*from <= place.first || is_within(*value, place) || !symbol.is_written)
                        && !is_within(place, *value)
                })
                .filter_map(|(from, value)| Some((from, value_of(value)?)))
                .max_by_key(|(from, _)| *from);
            if let Some((_, values)) = last {
                let text = symbol.name.clone();
                all.push(Readable { text, is_name: true, tokens: symbol.declared, values });
            }
        }
        for (_, tokens, seen) in &here {
            let is_simple = tokens.first == tokens.last;
            let is_changing = self.changing.iter().any(|changing| is_within(*changing, *tokens));
            let reads_known =
                |id: usize| is_within(*tokens, place) && self.is_visible(id, place) || self.is_kept(id, place);
            let is_own_call = self.used(*tokens).any(|id| self.checked.symbols[id].kind == SymbolKind::Function);
            let is_around = is_within(place, *tokens) && *tokens != place;
            if is_simple || is_changing || is_own_call || is_around || !self.used(*tokens).all(reads_known) {
                continue;
            }
            let span = source.expressions[seen.expr.0 as usize].span;
            let text = self.parsed.text(span).to_owned();
            if !text.contains(['\n', '#']) && text.len() <= MOST_TEXT {
                all.push(Readable { text, is_name: false, tokens: *tokens, values: &seen.values });
            }
        }
        all.sort_by_key(|readable| readable.text.len());
        all
    }
}

/// Longer expressions are computed once more only by a formula of their parts.
const MOST_TEXT: usize = 60;

/// How tightly the outermost operator of an expression binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Level {
    /// Comparisons, `?:`, assignments.
    Loose,
    /// Sums.
    Sum,
    /// Products.
    Product,
    /// Signs.
    Sign,
    /// Names, calls, and what is in parentheses.
    Whole,
}

/// Whether an expression is written in parentheses of its own.
fn is_enclosed(expr: &Expr, text: &str) -> bool {
    let first = match &expr.kind {
        ExprKind::Binary { left, .. } => Some(left),
        ExprKind::Ternary { condition, .. } => Some(condition),
        ExprKind::Assign { target, .. } => Some(target),
        _ => None,
    };
    text.starts_with('(') && first.is_none_or(|first| first.span.start > expr.span.start)
}

/// The level of an expression with its text.
#[must_use]
pub(crate) fn level_of(expr: &Expr, text: &str) -> Level {
    use gonio_glsl::ast::BinaryOp::{Add, Divide, Multiply, Remainder, Subtract};
    if is_enclosed(expr, text) {
        return Level::Whole;
    }
    match &expr.kind {
        ExprKind::Binary { op: Add | Subtract, .. } => Level::Sum,
        ExprKind::Binary { op: Multiply | Divide | Remainder, .. } => Level::Product,
        ExprKind::Unary { .. } => Level::Sign,
        ExprKind::Binary { .. } | ExprKind::Ternary { .. } | ExprKind::Assign { .. } | ExprKind::Sequence(_) => {
            Level::Loose
        }
        _ => Level::Whole,
    }
}

/// Finds an expression by its tokens.
#[must_use]
pub(crate) fn expression_at(parsed: &Parsed, tokens: TokenRange) -> Option<Expr> {
    struct Finder(TokenRange, Option<Expr>);
    impl Visitor for Finder {
        fn expression(&mut self, expr: &Expr) -> bool {
            if self.1.is_none() && expr.tokens == self.0 {
                self.1 = Some(expr.clone());
            }
            self.1.is_none() && is_within(self.0, expr.tokens)
        }
    }
    let mut finder = Finder(tokens, None);
    walk_unit(&parsed.unit, &mut finder);
    finder.1
}

/// The number of components of a type, if it is one of floats.
#[must_use]
pub(crate) fn size_of(ty: Option<&Type>) -> Option<usize> {
    ty.and_then(Type::components).map(|count| count as usize)
}
