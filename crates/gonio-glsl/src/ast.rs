//! The syntax tree. Every node has its [`Span`]; parentheses belong to the expression inside them.

use crate::{Span, TokenRange, Type};

/// A whole shader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Unit {
    /// Functions and declarations in source order.
    pub items: Vec<Item>,
}

/// A top-level construct.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A function definition or prototype.
    Function(Function),
    /// Global variables, or a struct with or without variables.
    Declaration(Declaration),
    /// A block of uniforms, inputs or outputs.
    Block(InterfaceBlock),
    /// `precision mediump float;`
    Precision(Precision),
    /// Qualifiers for an existing variable: `invariant gl_Position;` or `layout(..) in;`.
    Qualify(Qualify),
    /// A stray `;`.
    Empty(Span),
}

/// A function definition or prototype.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The position of the name.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// The return type.
    pub returns: TypeName,
    /// The parameters.
    pub params: Vec<Param>,
    /// The body; `None` for a prototype.
    pub body: Option<Vec<Statement>>,
    /// The span from the return type to the closing parenthesis.
    pub span: Span,
    /// The tokens of the whole function.
    pub tokens: TokenRange,
    /// The opening `{`, or the `;`.
    pub open: TokenRange,
}

/// A function's parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// `in`, `out`, `inout`, `const` and the like.
    pub qualifiers: Vec<Qualifier>,
    /// Its type.
    pub ty: TypeName,
    /// Its name, empty if it has none.
    pub name: String,
    /// The position in the source.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Array sizes after the name.
    pub sizes: Vec<Option<Expr>>,
}

/// Variables of one type.
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// The qualifiers before the type.
    pub qualifiers: Vec<Qualifier>,
    /// The type.
    pub ty: TypeName,
    /// The variables; none in `struct Light { .. };`.
    pub declarators: Vec<Declarator>,
    /// The span up to the `;`.
    pub span: Span,
    /// The tokens of the whole declaration.
    pub tokens: TokenRange,
}

/// One variable of a declaration.
#[derive(Debug, Clone, PartialEq)]
pub struct Declarator {
    /// Its name.
    pub name: String,
    /// The position of the name.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Array sizes after the name.
    pub sizes: Vec<Option<Expr>>,
    /// The token of the `=`, if there is an initializer.
    pub equals: TokenRange,
    /// The initializer.
    pub initialiser: Option<Expr>,
}

/// A type as it is written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeName {
    /// `vec3`, `Light`; empty for a struct without name.
    pub name: String,
    /// The position of the name, without sizes.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Array sizes after the type.
    pub sizes: Vec<Option<Expr>>,
    /// The struct, if it is defined here.
    pub definition: Option<Box<StructDefinition>>,
}

/// `struct Light { .. }`
#[derive(Debug, Clone, PartialEq)]
pub struct StructDefinition {
    /// Its name, empty if it has none.
    pub name: String,
    /// The position of the name.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// The members as declarations.
    pub members: Vec<Declaration>,
}

/// `uniform Matrices { .. } matrices;`
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceBlock {
    /// The qualifiers before the name.
    pub qualifiers: Vec<Qualifier>,
    /// The name of the block.
    pub name: String,
    /// The position of the name.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// The members as declarations.
    pub members: Vec<Declaration>,
    /// The instance name, with array sizes.
    pub instance: Option<Declarator>,
    /// The span up to the `;`.
    pub span: Span,
    /// The tokens of the whole block.
    pub tokens: TokenRange,
    /// The closing `}`.
    pub close: TokenRange,
}

/// `precision mediump float;`
#[derive(Debug, Clone, PartialEq)]
pub struct Precision {
    /// `highp`, `mediump` or `lowp`.
    pub precision: String,
    /// The type.
    pub ty: TypeName,
    /// The span up to the `;`.
    pub span: Span,
    /// The tokens of the whole declaration.
    pub tokens: TokenRange,
}

/// Qualifiers for existing variables.
#[derive(Debug, Clone, PartialEq)]
pub struct Qualify {
    /// The qualifiers.
    pub qualifiers: Vec<Qualifier>,
    /// The names; none in `layout(..) in;`.
    pub names: Vec<(String, Span)>,
    /// The span up to the `;`.
    pub span: Span,
    /// The tokens of the whole declaration.
    pub tokens: TokenRange,
}

/// A qualifier before a type.
#[derive(Debug, Clone, PartialEq)]
pub struct Qualifier {
    /// The word: `uniform`, `highp`, `layout`.
    pub word: String,
    /// The entries of `layout`.
    pub layout: Vec<LayoutEntry>,
    /// The position in the source.
    pub span: Span,
    /// Its tokens.
    pub tokens: TokenRange,
}

/// `location = 1`
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutEntry {
    /// The key.
    pub name: String,
    /// The value.
    pub value: Option<Expr>,
    /// Its tokens.
    pub tokens: TokenRange,
}

/// A statement.
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    /// The kind of statement.
    pub kind: StatementKind,
    /// The span from the first to the last token.
    pub span: Span,
    /// The tokens of the whole statement.
    pub tokens: TokenRange,
}

/// The kind of a statement.
#[derive(Debug, Clone, PartialEq)]
pub enum StatementKind {
    /// Local variables or a local struct.
    Declaration(Declaration),
    /// An expression with its `;`.
    Expression(Expr),
    /// `if`
    If {
        /// The condition.
        condition: Expr,
        /// The statement if the condition holds.
        then: Box<Statement>,
        /// The statement after `else`.
        otherwise: Option<Box<Statement>>,
    },
    /// `for`
    For {
        /// The initialization.
        initial: Option<Box<Statement>>,
        /// The loop condition.
        condition: Option<Box<Condition>>,
        /// The expression after each iteration.
        step: Option<Expr>,
        /// The loop body.
        body: Box<Statement>,
    },
    /// `while`
    While {
        /// The loop condition.
        condition: Box<Condition>,
        /// The loop body.
        body: Box<Statement>,
    },
    /// `do`
    DoWhile {
        /// The loop body.
        body: Box<Statement>,
        /// The loop condition.
        condition: Expr,
    },
    /// `switch`
    Switch {
        /// The value that is compared.
        value: Expr,
        /// The statements, including [`StatementKind::Case`].
        body: Vec<Statement>,
    },
    /// `case 1:`, or `default:` without a value.
    Case(Option<Expr>),
    /// `return`
    Return(Option<Expr>),
    /// `break`
    Break,
    /// `continue`
    Continue,
    /// `discard`
    Discard,
    /// `{ .. }`
    Block(Vec<Statement>),
    /// `precision` inside a function.
    Precision(Precision),
    /// `;`
    Empty,
}

/// The condition of a loop.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// An expression.
    Expr(Expr),
    /// `while (bool more = next())`
    Declaration(Declaration),
}

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Expr {
    /// The kind of expression.
    pub kind: ExprKind,
    /// The position, including enclosing parentheses.
    pub span: Span,
    /// Its type once [`crate::check`] has run; `None` if unknown.
    pub ty: Option<Type>,
    /// Its tokens, including enclosing parentheses.
    pub tokens: TokenRange,
    /// The depth of nested expressions below it.
    pub(crate) height: u16,
}

/// The kind of an expression.
#[derive(Debug, Clone, PartialEq)]
pub enum ExprKind {
    /// A number or a boolean.
    Literal(Literal),
    /// A variable.
    Name(String),
    /// A call of a function or a constructor.
    Call(Call),
    /// `.xyz` or `.member`
    Field {
        /// The value that is accessed.
        base: Box<Expr>,
        /// The member name or components.
        name: String,
        /// The position of the name.
        name_span: Span,
        /// The token of the name.
        name_tokens: TokenRange,
    },
    /// `[..]`
    Index {
        /// The value that is indexed.
        base: Box<Expr>,
        /// The index.
        index: Box<Expr>,
    },
    /// `.length()`
    Length(Box<Expr>),
    /// An operator with one operand.
    Unary {
        /// The operator.
        op: UnaryOp,
        /// The operand.
        operand: Box<Expr>,
    },
    /// An operator with two operands.
    Binary {
        /// The operator.
        op: BinaryOp,
        /// Left operand.
        left: Box<Expr>,
        /// Right operand.
        right: Box<Expr>,
    },
    /// `a ? b : c`
    Ternary {
        /// The condition `a`.
        condition: Box<Expr>,
        /// The value `b`.
        then: Box<Expr>,
        /// The value `c`.
        otherwise: Box<Expr>,
    },
    /// `=`, `+=` and so on.
    Assign {
        /// The operation of `+=`; none for `=`.
        op: Option<BinaryOp>,
        /// The expression that is assigned to.
        target: Box<Expr>,
        /// The assigned value.
        value: Box<Expr>,
    },
    /// `a, b`
    Sequence(Vec<Expr>),
    /// `{1.0, 2.0}`
    List(Vec<Expr>),
}

/// A call of a function or a constructor.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    /// The function's name, or the type's.
    pub name: String,
    /// The position of the name.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// Sizes of an array constructor, `float[3](..)`.
    pub sizes: Vec<Option<Expr>>,
    /// The arguments.
    pub args: Vec<Expr>,
    /// Whether it constructs a value of a type; known once [`crate::check`] has run, and before that for built-in
    /// types.
    pub is_constructor: bool,
}

/// A literal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Literal {
    /// `1`
    Int(i64),
    /// `1u`
    UInt(u32),
    /// `1.0`
    Float(f64),
    /// `1.0lf`
    Double(f64),
    /// `true`
    Bool(bool),
}

/// An operator with one operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOp {
    /// `+a`
    Plus,
    /// `-a`
    Minus,
    /// `!a`
    Not,
    /// `~a`
    Complement,
    /// `++a`
    PreIncrement,
    /// `--a`
    PreDecrement,
    /// `a++`
    PostIncrement,
    /// `a--`
    PostDecrement,
}

/// An operator with two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum BinaryOp {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    ShiftLeft,
    ShiftRight,
    Less,
    Greater,
    LessEqual,
    GreaterEqual,
    Equal,
    NotEqual,
    BitAnd,
    BitXor,
    BitOr,
    And,
    Xor,
    Or,
}

/// The binary operators with their marks and precedences, from 1 (GLSL 4.60, section 5.1).
const BINARY_OPS: [(BinaryOp, &str, u8); 19] = [
    (BinaryOp::Or, "||", 1),
    (BinaryOp::Xor, "^^", 2),
    (BinaryOp::And, "&&", 3),
    (BinaryOp::BitOr, "|", 4),
    (BinaryOp::BitXor, "^", 5),
    (BinaryOp::BitAnd, "&", 6),
    (BinaryOp::Equal, "==", 7),
    (BinaryOp::NotEqual, "!=", 7),
    (BinaryOp::Less, "<", 8),
    (BinaryOp::Greater, ">", 8),
    (BinaryOp::LessEqual, "<=", 8),
    (BinaryOp::GreaterEqual, ">=", 8),
    (BinaryOp::ShiftLeft, "<<", 9),
    (BinaryOp::ShiftRight, ">>", 9),
    (BinaryOp::Add, "+", 10),
    (BinaryOp::Subtract, "-", 10),
    (BinaryOp::Multiply, "*", 11),
    (BinaryOp::Divide, "/", 11),
    (BinaryOp::Remainder, "%", 11),
];

impl BinaryOp {
    /// Returns the operator as it is written.
    #[must_use]
    pub fn mark(self) -> &'static str {
        BINARY_OPS.iter().find(|(op, ..)| *op == self).map_or("", |(_, mark, _)| mark)
    }

    /// Returns the operator with this mark and its precedence.
    pub(crate) fn from_mark(mark: &str) -> Option<(Self, u8)> {
        BINARY_OPS.iter().find(|(_, known, _)| *known == mark).map(|(op, _, precedence)| (*op, *precedence))
    }
}

/// Whether one of the qualifiers is this word.
#[must_use]
pub fn has(qualifiers: &[Qualifier], word: &str) -> bool {
    qualifiers.iter().any(|q| q.word == word)
}
