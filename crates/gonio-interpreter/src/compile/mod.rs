//! Compiles a checked shader: types and names resolved, functions inlined, variables in registers.
//!
//! Registers are allocated like a stack: variables of a block and intermediate results end with it.

mod builtins;
mod expressions;
mod interface;
mod places;
mod statements;

use crate::code::{CallFrame, CompiledStage, Detail, Instr, Reg, StageInput, StageOutput, TextureCall, TracedVariable};
use crate::layout::{Layouts, in_single_precision};
use crate::source::{ExprId, SourceMap};
use gonio_glsl::ast::Function;
use gonio_glsl::{Checked, Expr, Item, Parsed, Severity, Span, Type};
use std::collections::HashMap;

/// Most instructions of a compiled shader. `gonio_glsl` accepts 200,000 expressions with all calls inlined.
const MOST_INSTRUCTIONS: usize = 2_000_000;
/// Most registers: 128 MiB if every one differs from point to point.
const MOST_REGISTERS: u32 = 131_072;
/// Most expressions and statements within each other, with those of callers: the compiler recurses. Measured: 600
/// levels take less than the 1 MiB that threads of a page have.
const MOST_NESTED: u32 = 600;

/// A construct that cannot be run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unsupported {
    /// The construct.
    pub construct: String,
    /// Its position.
    pub span: Span,
}

impl std::fmt::Display for Unsupported {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Span { line, column, .. } = self.span;
        write!(f, "line {line}, column {column}: gonio cannot run {}; rewrite this part without it", self.construct)
    }
}

impl std::error::Error for Unsupported {}

pub(crate) type Result<T> = std::result::Result<T, Unsupported>;

/// Compiles a shader that [`gonio_glsl::check`] accepts. A `double` becomes a `float`, with 24 bits of precision in place of 53.
///
/// # Errors
///
/// A construct that the interpreter does not support, such as an image or recursion, with its position; or the
/// first error that the checker found.
pub fn compile(parsed: &Parsed, checked: &Checked) -> Result<CompiledStage> {
    let mut problems = parsed.problems.iter().chain(&checked.problems);
    if let Some(problem) = problems.find(|problem| problem.severity == Severity::Error) {
        return Err(unsupported(format!("a shader with an error ({})", problem.message), problem.span));
    }
    let mut compiler = Compiler::new(parsed, checked);
    compiler.unit()?;
    let reach = compiler.code.iter().map(reach).chain(compiler.textures.iter().map(texture_reach)).max();
    Ok(CompiledStage {
        stage: checked.stage,
        source: compiler.source,
        inputs: compiler.inputs,
        outputs: compiler.outputs,
        variables: compiler.traced,
        frames: compiler.frames,
        takes_derivatives: compiler.takes_derivatives,
        code: compiler.code,
        places: compiler.places,
        textures: compiler.textures,
        registers: compiler.most_registers.max(reach.unwrap_or(0)),
    })
}

/// One past the last register of an instruction. A mistake of this compiler must not become a panic of the machine.
fn reach(instr: &Instr) -> Reg {
    let all = |list: &[(Reg, u32)]| list.iter().map(|(reg, n)| reg.saturating_add(*n)).max().unwrap_or(0);
    match *instr {
        Instr::Constant { dst, .. } => dst + 1,
        Instr::Copy { dst, src, n } | Instr::Load { dst, src, n } | Instr::Store { dst, src, n } => {
            all(&[(dst, n), (src, n)])
        }
        Instr::Forget { dst, n } => dst + n,
        Instr::Offset { dst, before, index, .. } => all(&[(dst, 1), (before.unwrap_or(0), 1), (index, 1)]),
        Instr::Gather { dst, base, offset, total, n } => all(&[(dst, n), (base, total), (offset, 1)]),
        Instr::Scatter { base, offset, src, total, n } => all(&[(src, n), (base, total), (offset, 1)]),
        Instr::One { dst, a, n, .. } | Instr::Derivative { dst, a, n, .. } => all(&[(dst, n), (a, n)]),
        Instr::Two { dst, a, b, n, .. } => all(&[(dst, n), (a, n), (b, n)]),
        Instr::Three { dst, a, b, c, n, .. } => all(&[(dst, n), (a, n), (b, n), (c, n)]),
        Instr::Dot { dst, a, b, n, steps } => {
            let [step_a, step_b] = steps.map(|step| u32::from(n) * u32::from(step) + 1);
            all(&[(dst, 1), (a, step_a), (b, step_b)])
        }
        Instr::Reduce { dst, a, n, .. } => all(&[(dst, 1), (a, n)]),
        Instr::Whole { dst, to, a, n, .. } => all(&[(dst, u32::from(to)), (a, u32::from(n))]),
        Instr::Mark { reg, n, .. } => reg + n,
        Instr::If { condition, .. } | Instr::Test { condition, .. } | Instr::Case { condition } => condition + 1,
        _ => 0,
    }
}

fn texture_reach(call: &TextureCall) -> Reg {
    let optional = [call.divisor, call.compare, call.component, call.offset.map(|o| o.0 + u32::from(o.1))];
    let detail = match call.detail {
        Detail::Implicit(reg) => reg.unwrap_or(0),
        Detail::Explicit(reg) => reg,
        Detail::Gradient { dx, dy, n } => dx.max(dy) + u32::from(n),
    };
    let given = optional.into_iter().flatten().chain([detail, call.sampler, call.dst + u32::from(call.n)]);
    given.chain([call.coordinates + u32::from(call.dims)]).max().unwrap_or(0) + 1
}

/// A variable in registers.
#[derive(Debug, Clone)]
struct Variable {
    reg: Reg,
    ty: Type,
    /// Its number in [`CompiledStage::variables`].
    traced: u32,
}

/// The function that is being compiled.
struct Current {
    symbol: Option<usize>,
    returns: Option<(Reg, Type)>,
}

struct Compiler<'a> {
    parsed: &'a Parsed,
    checked: &'a Checked,
    source: SourceMap,
    layouts: Layouts,
    /// The symbol of each token that is a name.
    symbols: HashMap<u32, usize>,
    /// The type that each implicitly converted expression becomes.
    conversions: HashMap<(u32, u32), Type>,
    functions: HashMap<usize, &'a Function>,
    variables: HashMap<usize, Variable>,
    builtins: HashMap<String, Variable>,
    inputs: Vec<StageInput>,
    outputs: Vec<StageOutput>,
    traced: Vec<TracedVariable>,
    frames: Vec<CallFrame>,
    frame: u32,
    calls: Vec<Current>,
    code: Vec<Instr>,
    places: Vec<Option<ExprId>>,
    textures: Vec<TextureCall>,
    place: Option<ExprId>,
    next: Reg,
    most_registers: Reg,
    nested: u32,
    takes_derivatives: bool,
    /// Whether `discard` ends a point at once: it goes on as a helper if derivatives need its values.
    discard_ends: bool,
}

impl<'a> Compiler<'a> {
    fn new(parsed: &'a Parsed, checked: &'a Checked) -> Self {
        let mut symbols = HashMap::new();
        for (id, symbol) in checked.symbols.iter().enumerate() {
            symbols.insert(symbol.declared.first, id);
            symbols.extend(symbol.uses.iter().map(|tokens| (tokens.first, id)));
        }
        let conversions =
            checked.conversions.iter().map(|c| ((c.tokens.first, c.tokens.last), in_single_precision(&c.to))).collect();
        let mut functions = HashMap::new();
        for item in &parsed.unit.items {
            if let Item::Function(function) = item
                && function.body.is_some()
                && let Some(symbol) = symbols.get(&function.name_tokens.first)
            {
                functions.entry(*symbol).or_insert(function);
            }
        }
        let takes_derivatives =
            checked.functions_used.iter().any(|name| name.starts_with("dF") || name.starts_with("fwidth"));
        let looks_up = checked.functions_used.iter().any(|name| name.starts_with("tex") || name.starts_with("shadow"));
        Self {
            parsed,
            checked,
            source: SourceMap::new(parsed),
            layouts: Layouts::new(checked),
            symbols,
            conversions,
            functions,
            variables: HashMap::new(),
            builtins: HashMap::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            traced: Vec::new(),
            frames: Vec::new(),
            frame: 0,
            calls: Vec::new(),
            code: Vec::new(),
            places: Vec::new(),
            textures: Vec::new(),
            place: None,
            next: 0,
            most_registers: 0,
            nested: 0,
            takes_derivatives,
            discard_ends: !takes_derivatives && !looks_up,
        }
    }

    /// Compiles the declarations of global variables in order, then `main`.
    fn unit(&mut self) -> Result<()> {
        self.builtin_variables()?;
        let parsed = self.parsed;
        for item in &parsed.unit.items {
            match item {
                Item::Declaration(declaration) => self.global(declaration)?,
                Item::Block(block) => self.block(block)?,
                _ => {}
            }
        }
        let main = self.functions.iter().find(|(_, f)| f.name == "main" && f.params.is_empty());
        let Some((symbol, main)) = main.map(|(symbol, main)| (*symbol, *main)) else {
            return Err(unsupported("a shader without `void main()`", Span { line: 1, column: 1, ..Span::default() }));
        };
        self.frames.push(CallFrame { function: "main".into(), caller: None, call: None, depth: 0 });
        self.emit(Instr::Enter { frame: 0 })?;
        self.calls.push(Current { symbol: Some(symbol), returns: None });
        for statement in main.body.iter().flatten() {
            if self.statement(statement)? == statements::Reaches::Nothing {
                break;
            }
        }
        self.emit(Instr::Leave)
    }

    fn emit(&mut self, instr: Instr) -> Result<()> {
        if self.code.len() >= MOST_INSTRUCTIONS {
            return Err(unsupported("a shader of this size", self.span()));
        }
        self.code.push(instr);
        self.places.push(self.place);
        Ok(())
    }

    /// The position of the current expression.
    fn span(&self) -> Span {
        self.place.and_then(|id| self.source.expression(id)).map(|e| e.span).unwrap_or_default()
    }

    /// The index of the next instruction.
    fn here(&self) -> u32 {
        self.code.len() as u32
    }

    fn allocate(&mut self, size: u32) -> Result<Reg> {
        let reg = self.next;
        self.next = reg.saturating_add(size);
        self.most_registers = self.most_registers.max(self.next);
        if self.next > MOST_REGISTERS {
            return Err(unsupported("this many variables and array elements at once", self.span()));
        }
        Ok(reg)
    }

    fn size(&self, ty: &Type, span: Span) -> Result<u32> {
        self.layouts.size(ty).ok_or_else(|| unsupported(format!("the type `{ty}`"), span))
    }

    /// Returns the symbol that a token refers to.
    fn symbol_at(&self, token: u32) -> Option<usize> {
        self.symbols.get(&token).copied()
    }

    /// The type of an expression before implicit conversion.
    fn raw_type(&self, expr: &Expr) -> Result<Type> {
        expr.ty
            .as_ref()
            .map(in_single_precision)
            .ok_or_else(|| unsupported("this expression, whose type is unknown", expr.span))
    }

    /// The type of an expression after implicit conversion.
    fn type_of(&self, expr: &Expr) -> Result<Type> {
        let raw = self.raw_type(expr)?;
        Ok(self.conversions.get(&(expr.tokens.first, expr.tokens.last)).cloned().unwrap_or(raw))
    }

    fn enter(&mut self, span: Span) -> Result<()> {
        self.nested += 1;
        if self.nested > MOST_NESTED {
            return Err(unsupported("expressions and calls that are nested this deeply", span));
        }
        Ok(())
    }

    /// Declares a variable in fresh registers.
    fn variable(&mut self, symbol: Option<usize>, name: &str, ty: Type, span: Option<Span>) -> Result<Variable> {
        let ty = in_single_precision(&ty);
        let size = self.size(&ty, span.unwrap_or_default())?;
        let reg = self.allocate(size)?;
        let traced = TracedVariable { name: name.to_string(), ty: ty.clone(), span, reg, size };
        // Each inlined copy of a function has its own registers.
        let index = self.traced.len() as u32;
        self.traced.push(traced);
        let variable = Variable { reg, ty, traced: index };
        if let Some(symbol) = symbol {
            self.variables.insert(symbol, variable.clone());
        }
        Ok(variable)
    }
}

pub(crate) fn unsupported(construct: impl Into<String>, span: Span) -> Unsupported {
    Unsupported { construct: construct.into(), span }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_glsl::Stage;

    #[test]
    fn what_cannot_be_run_is_named_with_its_place() {
        let refused = |source: &str| {
            let mut parsed = gonio_glsl::parse(source);
            let checked = gonio_glsl::check(&mut parsed, Stage::Fragment);
            compile(&parsed, &checked).unwrap_err().to_string()
        };
        let image = "#version 420\nlayout(rgba8) uniform image2D i;\nout vec4 r;\nvoid main() {\n  r = imageLoad(i, ivec2(0)); }";
        let error = refused(image);
        assert!(error.starts_with("line 5, column 7: gonio cannot run"), "{error}");
        let error = refused(
            "#version 330 core\nout vec4 r;\nfloat f(float a) { return f(a); }\nvoid main() { r = vec4(f(1.0)); }",
        );
        assert!(error.starts_with("line 3, column 27: gonio cannot run the recursive call of `f`"), "{error}");
    }
}
