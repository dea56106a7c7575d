//! Scopes and symbols.

use super::{Access, Checker};
use crate::ast::{Qualifier, has};
use crate::{Problem, Span, Stage, TokenRange, Type, lex};

/// The kind of a symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SymbolKind {
    /// A global variable.
    Global,
    /// A local variable.
    Local,
    /// A function's parameter.
    Param,
    /// A function.
    Function,
    /// A member of a block without instance name.
    BlockMember,
    /// The instance of a block.
    BlockInstance,
}

/// The storage of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// No qualifier: a variable of the shader itself.
    None,
    /// A constant.
    Const,
    /// An input from the previous stage: `in`, `attribute`, a fragment shader's `varying`.
    In,
    /// An output to the next stage: `out`, a vertex shader's `varying`.
    Out,
    /// A uniform set by the program.
    Uniform,
    /// A storage buffer.
    Buffer,
}

/// A declared name.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: SymbolKind,
    /// Its type, or a function's return type; `None` if unknown.
    pub ty: Option<Type>,
    /// Its storage.
    pub storage: Storage,
    /// The position of its declaration.
    pub span: Span,
    /// The token of its name in the declaration.
    pub declared: TokenRange,
    /// All other tokens that refer to it.
    pub uses: Vec<TokenRange>,
    /// Whether its value is used.
    pub is_read: bool,
    /// Whether it is assigned after its declaration.
    pub is_written: bool,
    /// Whether it has an initializer.
    pub has_initialiser: bool,
    /// The loops around its declaration.
    pub(crate) loops: usize,
}

/// Returns the storage given by the qualifiers of a global variable.
pub(super) fn storage_of(qualifiers: &[Qualifier], stage: Stage) -> Storage {
    if has(qualifiers, "uniform") {
        Storage::Uniform
    } else if has(qualifiers, "buffer") {
        Storage::Buffer
    } else if has(qualifiers, "const") {
        Storage::Const
    } else if has(qualifiers, "in") || has(qualifiers, "attribute") {
        Storage::In
    } else if has(qualifiers, "out") {
        Storage::Out
    } else if has(qualifiers, "varying") {
        if stage == Stage::Vertex { Storage::Out } else { Storage::In }
    } else {
        Storage::None
    }
}

impl Checker<'_> {
    pub(super) fn push_scope(&mut self) {
        self.scopes.push(Default::default());
    }

    pub(super) fn pop_scope(&mut self) {
        self.scopes.pop();
    }

    /// Declares a name; a duplicate in the same scope is an error.
    pub(super) fn declare(&mut self, symbol: Symbol) -> usize {
        self.check_variable(&symbol);
        let id = self.symbols.len();
        let is_gl = symbol.name.starts_with("gl_");
        // Built-in variables such as `in vec4 gl_FragCoord` may be redeclared.
        if is_gl && crate::builtins::variable(&symbol.name, self.stage, self.version).is_none() {
            self.strict(
                symbol.span,
                "reserved-name",
                format!("names with `gl_`, such as `{}`, are reserved", symbol.name),
            );
        } else if symbol.name.contains("__") {
            let message = format!("names with two underscores, such as `{}`, are reserved", symbol.name);
            self.strict(symbol.span, "reserved-name", message);
        }
        if lex::is_reserved(&symbol.name, self.version) && !self.has_syntax_errors {
            let message = format!("`{}` is a reserved word and cannot be a name", symbol.name);
            self.error(symbol.span, "reserved-word", message);
        }
        if let Some(scope) = self.scopes.last_mut() {
            let before = if symbol.name.is_empty() { None } else { scope.insert(symbol.name.clone(), id) };
            if let Some(before) = before.filter(|_| !is_gl) {
                let earlier = &self.symbols[before];
                let is_array = matches!(earlier.ty, Some(Type::Array(_, None)));
                if !is_array {
                    let message = format!("`{}` is already declared in line {}", symbol.name, earlier.span.line);
                    self.error(symbol.span, "declared-twice", message);
                }
            }
        }
        self.symbols.push(symbol);
        id
    }

    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.scopes.iter().rev().find_map(|scope| scope.get(name).copied())
    }

    /// Records that a variable is read or written here.
    pub(super) fn access(&mut self, symbol: usize, is_write: bool, span: Span) {
        let found = &mut self.symbols[symbol];
        if is_write {
            found.is_written = true;
        } else {
            found.is_read = true;
        }
        if found.kind == SymbolKind::Local {
            self.accesses.push(Access { symbol, is_write, span, loops: self.loops.clone() });
        }
    }

    /// Returns the type of a name used as a variable.
    #[inline(never)]
    pub(super) fn variable(&mut self, name: &str, span: Span, tokens: TokenRange, access: Use) -> Option<Type> {
        if let Some(id) = self.find(name) {
            self.symbols[id].uses.push(tokens);
            if access != Use::Write {
                self.access(id, false, span);
            }
            return self.symbols[id].ty.clone();
        }
        if let Some(found) = crate::builtins::variable(name, self.stage, self.version) {
            self.variable_uses.push((name.to_string(), tokens));
            let Ok(found) = found else {
                let version = self.version.written();
                let message =
                    format!("`{name}` is not available in a {} shader of version {version}", self.stage_word());
                let mut problem = Problem::error(span, "unknown-name", message);
                if matches!(name, "gl_FragColor" | "gl_FragData") && self.stage == Stage::Fragment {
                    problem = problem.with_help("declare `out vec4 FragColor;` and write to it");
                }
                self.unknown(problem);
                return None;
            };
            if matches!(name, "gl_FragColor" | "gl_FragData")
                && self.version.is_at_least(140, 0)
                && !self.version.compatibility
            {
                let problem = Problem::strict(span, "old-output", format!("`{name}` was removed from core OpenGL"));
                self.problems.push(problem.with_help("declare `out vec4 FragColor;` and write to it"));
            }
            return found.ty;
        }
        if self.functions.contains_key(name) || crate::builtins::is_name(name) {
            self.unknown(Problem::error(
                span,
                "function-as-value",
                format!("`{name}` is a function: expected arguments in parentheses"),
            ));
            return None;
        }
        if self.is_full() {
            return None;
        }
        let names = self.scopes.iter().flat_map(|s| s.keys().map(String::as_str));
        let mut names: Vec<&str> = names.collect();
        for builtin in crate::builtins::variable_names(self.stage) {
            names.push(builtin);
        }
        names.sort_unstable();
        let mut problem = Problem::error(span, "unknown-name", format!("`{name}` is not declared"));
        if let Some(near) = crate::nearest::nearest(name, names.into_iter()) {
            problem = problem.did_you_mean(name, near);
        }
        self.unknown(problem);
        None
    }

    pub(super) fn stage_word(&self) -> &'static str {
        match self.stage {
            Stage::Vertex => "vertex",
            Stage::Fragment => "fragment",
        }
    }
}

/// How a variable is accessed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    Read,
    /// Its old value does not matter.
    Write,
}
