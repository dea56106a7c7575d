//! The syntax tree. Everything has its [`Span`]; brackets count to the expression within them.

use crate::{Span, TokenRange, Type};

/// A whole shader.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Unit {
    /// What stands outside of functions, in its order, functions included.
    pub items: Vec<Item>,
}

/// One thing at the outermost level.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A function, with its body or only announced.
    Function(Function),
    /// Global variables, or a struct with or without variables.
    Declaration(Declaration),
    /// A block of uniforms, inputs or outputs.
    Block(InterfaceBlock),
    /// `precision mediump float;`
    Precision(Precision),
    /// `invariant gl_Position;` or `layout(..) in;`: qualifiers for what there is already.
    Qualify(Qualify),
    /// A stray `;`.
    Empty(Span),
}

/// A function.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// What it returns.
    pub returns: TypeName,
    /// What it takes.
    pub params: Vec<Param>,
    /// What it does; none if it is only announced.
    pub body: Option<Vec<Statement>>,
    /// From the return type to the closing bracket.
    pub span: Span,
    /// Tokens of the whole.
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
    /// Where it stands.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Sizes in brackets behind the name.
    pub sizes: Vec<Option<Expr>>,
}

/// Variables of one type.
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// Everything before the type.
    pub qualifiers: Vec<Qualifier>,
    /// The type.
    pub ty: TypeName,
    /// The variables; none in `struct Light { .. };`.
    pub declarators: Vec<Declarator>,
    /// Up to the `;`.
    pub span: Span,
    /// Tokens of the whole.
    pub tokens: TokenRange,
}

/// One variable of a declaration.
#[derive(Debug, Clone, PartialEq)]
pub struct Declarator {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Sizes in brackets behind the name.
    pub sizes: Vec<Option<Expr>>,
    /// Token of the `=`, if there is an initialiser.
    pub equals: TokenRange,
    /// The initialiser.
    pub initialiser: Option<Expr>,
}

/// A type as it is written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeName {
    /// `vec3`, `Light`; empty for a struct without name.
    pub name: String,
    /// Where it stands, without sizes.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Sizes in brackets behind the type.
    pub sizes: Vec<Option<Expr>>,
    /// The struct, where it is defined here.
    pub definition: Option<Box<StructDefinition>>,
}

/// `struct Light { .. }`
#[derive(Debug, Clone, PartialEq)]
pub struct StructDefinition {
    /// Its name, empty if it has none.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// The token of the name.
    pub tokens: TokenRange,
    /// Members, as declarations.
    pub members: Vec<Declaration>,
}

/// `uniform Matrices { .. } matrices;`
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceBlock {
    /// Everything before the name.
    pub qualifiers: Vec<Qualifier>,
    /// Name of the block.
    pub name: String,
    /// Where the name stands.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// Members, as declarations.
    pub members: Vec<Declaration>,
    /// Name of the instance, with sizes.
    pub instance: Option<Declarator>,
    /// Up to the `;`.
    pub span: Span,
    /// Tokens of the whole.
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
    /// Up to the `;`.
    pub span: Span,
    /// Tokens of the whole.
    pub tokens: TokenRange,
}

/// Qualifiers for what there is already.
#[derive(Debug, Clone, PartialEq)]
pub struct Qualify {
    /// The qualifiers.
    pub qualifiers: Vec<Qualifier>,
    /// The names; none in `layout(..) in;`.
    pub names: Vec<(String, Span)>,
    /// Up to the `;`.
    pub span: Span,
    /// Tokens of the whole.
    pub tokens: TokenRange,
}

/// One word before a type.
#[derive(Debug, Clone, PartialEq)]
pub struct Qualifier {
    /// The word: `uniform`, `highp`, `layout`.
    pub word: String,
    /// What stands in the brackets of `layout`.
    pub layout: Vec<LayoutEntry>,
    /// Where it stands.
    pub span: Span,
    /// Its tokens.
    pub tokens: TokenRange,
}

/// `location = 1`
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutEntry {
    /// The word.
    pub name: String,
    /// Its number.
    pub value: Option<Expr>,
    /// Its tokens.
    pub tokens: TokenRange,
}

/// A statement.
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    /// Which.
    pub kind: StatementKind,
    /// From its first to its last token.
    pub span: Span,
    /// Tokens of the whole.
    pub tokens: TokenRange,
}

/// What a statement does.
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
        /// If so.
        then: Box<Statement>,
        /// If not.
        otherwise: Option<Box<Statement>>,
    },
    /// `for`
    For {
        /// Before the first round.
        initial: Option<Box<Statement>>,
        /// Before each round.
        condition: Option<Box<Condition>>,
        /// After each round.
        step: Option<Expr>,
        /// Each round.
        body: Box<Statement>,
    },
    /// `while`
    While {
        /// Before each round.
        condition: Box<Condition>,
        /// Each round.
        body: Box<Statement>,
    },
    /// `do`
    DoWhile {
        /// Each round.
        body: Box<Statement>,
        /// After each round.
        condition: Expr,
    },
    /// `switch`
    Switch {
        /// What is looked at.
        value: Expr,
        /// Statements, [`StatementKind::Case`] among them.
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
    /// `precision` within a function
    Precision(Precision),
    /// `;`
    Empty,
}

/// What a loop looks at.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// The usual.
    Expr(Expr),
    /// `while (bool more = next())`
    Declaration(Declaration),
}

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Expr {
    /// Which.
    pub kind: ExprKind,
    /// Where it stands, with the brackets around it.
    pub span: Span,
    /// Its type, once [`crate::check`] has run; none if that is not known.
    pub ty: Option<Type>,
    /// Its tokens, with the brackets around it.
    pub tokens: TokenRange,
    /// How many expressions lie below, one within the other.
    pub(crate) height: u16,
}

/// What an expression is.
#[derive(Debug, Clone, PartialEq)]
pub enum ExprKind {
    /// A number or truth value.
    Literal(Literal),
    /// A variable.
    Name(String),
    /// A function or a constructor.
    Call(Call),
    /// `.xyz` or `.member`
    Field {
        /// Of what.
        base: Box<Expr>,
        /// The letters.
        name: String,
        /// Where the letters stand.
        name_span: Span,
        /// The token of the letters.
        name_tokens: TokenRange,
    },
    /// `[..]`
    Index {
        /// Of what.
        base: Box<Expr>,
        /// Which.
        index: Box<Expr>,
    },
    /// `.length()`
    Length(Box<Expr>),
    /// One operand.
    Unary {
        /// Which.
        op: UnaryOp,
        /// The operand.
        operand: Box<Expr>,
    },
    /// Two operands.
    Binary {
        /// Which.
        op: BinaryOp,
        /// Left operand.
        left: Box<Expr>,
        /// Right operand.
        right: Box<Expr>,
    },
    /// `a ? b : c`
    Ternary {
        /// a
        condition: Box<Expr>,
        /// b
        then: Box<Expr>,
        /// c
        otherwise: Box<Expr>,
    },
    /// `=`, `+=` and so on.
    Assign {
        /// The operation of `+=`; none for `=`.
        op: Option<BinaryOp>,
        /// What is written.
        target: Box<Expr>,
        /// What with.
        value: Box<Expr>,
    },
    /// `a, b`
    Sequence(Vec<Expr>),
    /// `{1.0, 2.0}`
    List(Vec<Expr>),
}

/// A function's or constructor's use.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    /// The function's name, or the type's.
    pub name: String,
    /// Where the name stands.
    pub name_span: Span,
    /// The token of the name.
    pub name_tokens: TokenRange,
    /// Sizes of an array constructor, `float[3](..)`.
    pub sizes: Vec<Option<Expr>>,
    /// The arguments.
    pub args: Vec<Expr>,
    /// Whether it makes a value of a type; known once [`crate::check`] has run, and before that for GLSL's own types.
    pub is_constructor: bool,
}

/// A value written down.
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

/// An operator of one operand.
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

/// An operator of two operands.
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

impl BinaryOp {
    /// As it is written.
    #[must_use]
    pub fn mark(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Remainder => "%",
            Self::ShiftLeft => "<<",
            Self::ShiftRight => ">>",
            Self::Less => "<",
            Self::Greater => ">",
            Self::LessEqual => "<=",
            Self::GreaterEqual => ">=",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::BitAnd => "&",
            Self::BitXor => "^",
            Self::BitOr => "|",
            Self::And => "&&",
            Self::Xor => "^^",
            Self::Or => "||",
        }
    }

    /// The operator of this mark and how tightly it binds, from 1.
    pub(crate) fn from_mark(mark: &str) -> Option<(Self, u8)> {
        Some(match mark {
            "||" => (Self::Or, 1),
            "^^" => (Self::Xor, 2),
            "&&" => (Self::And, 3),
            "|" => (Self::BitOr, 4),
            "^" => (Self::BitXor, 5),
            "&" => (Self::BitAnd, 6),
            "==" => (Self::Equal, 7),
            "!=" => (Self::NotEqual, 7),
            "<" => (Self::Less, 8),
            ">" => (Self::Greater, 8),
            "<=" => (Self::LessEqual, 8),
            ">=" => (Self::GreaterEqual, 8),
            "<<" => (Self::ShiftLeft, 9),
            ">>" => (Self::ShiftRight, 9),
            "+" => (Self::Add, 10),
            "-" => (Self::Subtract, 10),
            "*" => (Self::Multiply, 11),
            "/" => (Self::Divide, 11),
            "%" => (Self::Remainder, 11),
            _ => return None,
        })
    }
}

/// Whether one of the qualifiers is this word.
#[must_use]
pub fn has(qualifiers: &[Qualifier], word: &str) -> bool {
    qualifiers.iter().any(|q| q.word == word)
}
