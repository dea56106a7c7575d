//! Checks names, types and rules of a whole shader.

mod calls;
mod expressions;
mod interface;
mod items;
mod operators;
mod scope;
mod size;
mod statements;
mod strict;

use crate::constant::Components;
use crate::{Parsed, Problem, Severity, Span, Stage, TokenRange, Type, Version};
pub(crate) use calls::modern;
pub use interface::{Block, Interface, Leaf, StructInfo, Variable, builtin_structs, check_pair, leaves};
pub use scope::{Storage, Symbol, SymbolKind};
use std::collections::{BTreeSet, HashMap};

/// A shader with resolved names and types.
#[derive(Debug, Clone)]
pub struct Checked {
    /// Its inputs, outputs and uniforms.
    pub interface: Interface,
    /// Problems in source order, without syntax errors, which are in [`Parsed::problems`].
    pub problems: Vec<Problem>,
    /// The stage it was checked for.
    pub stage: Stage,
    /// All variables and functions it declares, with their uses.
    pub symbols: Vec<Symbol>,
    /// Implicit conversions.
    pub conversions: Vec<ImplicitConversion>,
    /// Names of built-in functions that are called.
    pub functions_used: BTreeSet<String>,
    /// Names of built-in variables that are used.
    pub variables_used: BTreeSet<String>,
    /// The tokens of those variables.
    pub(crate) variable_uses: Vec<(String, TokenRange)>,
    /// The calls of built-in functions, with the type of the first argument.
    pub(crate) function_uses: Vec<(String, TokenRange, Option<Type>)>,
    /// Symbols that hide a function where it is called.
    pub(crate) hiding: BTreeSet<usize>,
    /// Initializer lists `{..}` with their types.
    pub(crate) lists: Vec<(TokenRange, Type)>,
    /// Values of constants and of uniforms' initializers, by symbol.
    pub(crate) values: HashMap<usize, Components>,
    /// Global variables with an initializer that is not constant, by symbol.
    pub(crate) computed: BTreeSet<usize>,
}

impl Checked {
    /// Returns the limit that the shader exceeds, if any: it must not be given to a driver then.
    #[must_use]
    pub fn refusal(&self) -> Option<&Problem> {
        self.problems.iter().find(|problem| problem.limit.is_some())
    }
}

/// An implicit conversion, such as that of the 1 in `float x = 1;`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImplicitConversion {
    /// The tokens of the value.
    pub tokens: TokenRange,
    /// The position of the value.
    pub span: Span,
    /// The type of the value.
    pub from: Type,
    /// The type it is converted to.
    pub to: Type,
    /// Whether it is a literal.
    pub is_literal: bool,
}

/// Fills in the types of all expressions, resolves names, and reports problems.
pub fn check(parsed: &mut Parsed, stage: Stage) -> Checked {
    let mut unit = std::mem::take(&mut parsed.unit);
    let mut checker = Checker::new(parsed, stage);
    checker.unit(&mut unit);
    checker.check_functions();
    strict::whole(&mut checker, &unit);
    let interface = interface::collect(&checker, &unit);
    let mut problems = checker.problems;
    problems.sort_by_key(|p| (p.span.start, std::cmp::Reverse(p.severity)));
    problems.dedup();
    let checked = Checked {
        interface,
        problems,
        stage,
        symbols: checker.symbols,
        conversions: checker.conversions,
        functions_used: checker.function_uses.iter().map(|u| u.0.clone()).collect(),
        variables_used: checker.variable_uses.iter().map(|u| u.0.clone()).collect(),
        variable_uses: checker.variable_uses,
        function_uses: checker.function_uses,
        hiding: checker.hiding,
        lists: checker.lists,
        values: checker.values,
        computed: checker.computed,
    };
    parsed.unit = unit;
    checked
}

/// Most problems that are reported.
const MOST_PROBLEMS: usize = 200;

/// A function of the shader.
#[derive(Debug, Clone)]
struct FunctionInfo {
    symbol: usize,
    params: Vec<Option<Type>>,
    /// Whether each parameter is written to: `out` and `inout`.
    outs: Vec<bool>,
    returns: Option<Type>,
    has_body: bool,
    span: Span,
    /// Functions it calls, by name and overload index.
    calls: Vec<(String, usize)>,
    cost: size::Cost,
}

/// A read or write of a variable, in source order.
struct Access {
    symbol: usize,
    is_write: bool,
    span: Span,
    loops: Vec<u32>,
}

struct Checker<'p> {
    parsed: &'p Parsed,
    version: Version,
    stage: Stage,
    problems: Vec<Problem>,
    symbols: Vec<Symbol>,
    scopes: Vec<HashMap<String, usize>>,
    functions: HashMap<String, Vec<FunctionInfo>>,
    structs: HashMap<String, StructInfo>,
    struct_order: Vec<String>,
    conversions: Vec<ImplicitConversion>,
    variable_uses: Vec<(String, TokenRange)>,
    function_uses: Vec<(String, TokenRange, Option<Type>)>,
    hiding: BTreeSet<usize>,
    lists: Vec<(TokenRange, Type)>,
    values: HashMap<usize, Components>,
    computed: BTreeSet<usize>,
    accesses: Vec<Access>,
    loops: Vec<u32>,
    loop_count: u32,
    /// The current function, by name and overload index.
    current: Option<(String, usize)>,
    has_syntax_errors: bool,
    has_extensions: bool,
    /// Whether a limit is exceeded.
    is_beyond: bool,
    struct_sizes: HashMap<String, size::StructSize>,
    all_components: u64,
    globals: usize,
    loop_depth: u32,
    /// The cost of the current function.
    cost: size::Cost,
}

impl<'p> Checker<'p> {
    fn new(parsed: &'p Parsed, stage: Stage) -> Self {
        let harmless = |d: &crate::Directive| {
            let text = parsed.text(d.span);
            text.contains("disable")
                || text.contains("standard_derivatives")
                || text.contains("explicit_attrib_location")
        };
        Self {
            parsed,
            version: parsed.dialect(),
            stage,
            problems: Vec::new(),
            symbols: Vec::new(),
            scopes: vec![HashMap::new()],
            functions: HashMap::new(),
            structs: HashMap::new(),
            struct_order: Vec::new(),
            conversions: Vec::new(),
            variable_uses: Vec::new(),
            function_uses: Vec::new(),
            hiding: BTreeSet::new(),
            lists: Vec::new(),
            values: HashMap::new(),
            computed: BTreeSet::new(),
            accesses: Vec::new(),
            loops: Vec::new(),
            loop_count: 0,
            current: None,
            has_syntax_errors: parsed.problems.iter().any(|p| p.severity == Severity::Error),
            has_extensions: parsed.directives.iter().any(|d| d.word == "extension" && !harmless(d)),
            is_beyond: parsed.refusal().is_some(),
            struct_sizes: HashMap::new(),
            all_components: 0,
            globals: 0,
            loop_depth: 0,
            cost: size::Cost::default(),
        }
    }

    #[cold]
    #[inline(never)]
    fn error(&mut self, span: Span, code: &'static str, message: impl Into<String>) {
        self.problems.push(Problem::error(span, code, message));
    }

    #[cold]
    #[inline(never)]
    fn strict(&mut self, span: Span, code: &'static str, message: impl Into<String>) {
        self.problems.push(Problem::strict(span, code, message));
    }

    /// Whether enough problems have been reported: each unknown name is compared with all known ones, which takes time.
    fn is_full(&self) -> bool {
        self.problems.len() >= MOST_PROBLEMS
    }

    /// Reports an unknown name, unless a syntax error may have hidden its declaration or an extension may declare it.
    fn unknown(&mut self, problem: Problem) {
        if !self.has_syntax_errors && !self.has_extensions && !self.is_full() {
            self.problems.push(problem);
        }
    }
}
