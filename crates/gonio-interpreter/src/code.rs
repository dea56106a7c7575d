//! A compiled shader: instructions on registers, each of which holds one scalar of every point of a block.
//!
//! An instruction works on `n` registers in a row, one for each component; a step of 0 repeats an operand.

use crate::source::{ExprId, SourceMap, StatementId};
use gonio_glsl::{Span, Stage, Type};

/// The number of a register.
pub(crate) type Reg = u32;

/// An operation on one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum One {
    FNeg,
    INeg,
    Not,
    Complement,
    FAbs,
    IAbs,
    FSign,
    ISign,
    Floor,
    Ceil,
    Trunc,
    Round,
    Fract,
    Sqrt,
    InverseSqrt,
    Exp,
    Exp2,
    Log,
    Log2,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Radians,
    Degrees,
    IsNan,
    IsInf,
    FToI,
    FToU,
    IToF,
    UToF,
    FToB,
    IToB,
    BToF,
    BitCount,
    BitReverse,
    LowestBit,
    HighestBitI,
    HighestBitU,
    Zero,
    Same,
}

/// An operation on two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Two {
    FAdd,
    FSub,
    FMul,
    FDiv,
    FMod,
    FMin,
    FMax,
    Pow,
    Atan2,
    Step,
    Ldexp,
    IAdd,
    ISub,
    IMul,
    IDiv,
    IRem,
    UDiv,
    URem,
    And,
    Or,
    Xor,
    Shl,
    ShrI,
    ShrU,
    IMin,
    IMax,
    UMin,
    UMax,
    FLess,
    FLessEqual,
    FGreater,
    FGreaterEqual,
    FEqual,
    FNotEqual,
    ILess,
    ILessEqual,
    IGreater,
    IGreaterEqual,
    ULess,
    ULessEqual,
    UGreater,
    UGreaterEqual,
    IEqual,
    INotEqual,
    CarryOut,
    BorrowOut,
}

/// An operation on three numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Three {
    FClamp,
    IClamp,
    UClamp,
    Mix,
    Smoothstep,
    Fma,
    Select,
    ExtractI,
    ExtractU,
}

/// An operation on all components of one point, for functions that are seldom called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Whole {
    Determinant(u8),
    Inverse(u8),
    Refract(u8),
    Modf,
    Frexp,
    PackUnorm2x16,
    PackSnorm2x16,
    PackHalf2x16,
    PackUnorm4x8,
    PackSnorm4x8,
    UnpackUnorm2x16,
    UnpackSnorm2x16,
    UnpackHalf2x16,
    UnpackUnorm4x8,
    UnpackSnorm4x8,
}

/// The direction of a derivative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Along {
    X,
    Y,
    /// The sum of both magnitudes.
    Both,
}

/// How a texture function chooses its level of detail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Detail {
    /// From the derivatives of the coordinates, with an optional bias.
    Implicit(Option<Reg>),
    Explicit(Reg),
    Gradient {
        dx: Reg,
        dy: Reg,
        n: u8,
    },
}

/// A call of a texture function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TextureCall {
    pub operation: TextureOperation,
    pub dst: Reg,
    /// Components of the result.
    pub n: u8,
    /// Converts the result: samplers of integers.
    pub to: gonio_glsl::Scalar,
    pub sampler: Reg,
    pub coordinates: Reg,
    /// Components of the coordinates, without the divisor and the compared depth.
    pub dims: u8,
    /// Divides the coordinates by this register.
    pub divisor: Option<Reg>,
    /// A shadow lookup: compares with this depth.
    pub compare: Option<Reg>,
    pub detail: Detail,
    /// Added to the coordinates in texels.
    pub offset: Option<(Reg, u8)>,
    /// The component that `textureGather` returns.
    pub component: Option<Reg>,
}

/// What a texture function does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TextureOperation {
    Sample,
    Fetch,
    Gather,
    Size,
    Levels,
    QueryLod,
}

/// An instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Instr {
    /// Sets all points to one number.
    Constant {
        dst: Reg,
        bits: u32,
    },
    /// Copies a value that is not a variable's.
    Copy {
        dst: Reg,
        src: Reg,
        n: u32,
    },
    /// Reads a variable.
    Load {
        dst: Reg,
        src: Reg,
        n: u32,
    },
    /// Writes the active points of a variable.
    Store {
        dst: Reg,
        src: Reg,
        n: u32,
    },
    /// Makes values unwritten.
    Forget {
        dst: Reg,
        n: u32,
    },
    /// Adds `index * stride` to an offset; -1 if the index is not less than `count`.
    Offset {
        dst: Reg,
        before: Option<Reg>,
        index: Reg,
        is_signed: bool,
        stride: u32,
        count: u32,
    },
    /// Reads `n` registers from `base + offset`.
    Gather {
        dst: Reg,
        base: Reg,
        offset: Reg,
        total: u32,
        n: u32,
    },
    /// Writes the active points of `n` registers from `base + offset`.
    Scatter {
        base: Reg,
        offset: Reg,
        src: Reg,
        total: u32,
        n: u32,
    },
    One {
        op: One,
        dst: Reg,
        a: Reg,
        n: u32,
    },
    Two {
        op: Two,
        dst: Reg,
        a: Reg,
        b: Reg,
        n: u32,
        steps: [u8; 2],
    },
    Three {
        op: Three,
        dst: Reg,
        a: Reg,
        b: Reg,
        c: Reg,
        n: u32,
        steps: [u8; 3],
    },
    /// The sum of `n` products of floats.
    Dot {
        dst: Reg,
        a: Reg,
        b: Reg,
        n: u8,
        steps: [u8; 2],
    },
    /// Whether all (or any) of `n` booleans are true.
    Reduce {
        dst: Reg,
        a: Reg,
        n: u32,
        all: bool,
    },
    Whole {
        op: Whole,
        dst: Reg,
        to: u8,
        a: Reg,
        n: u8,
    },
    Derivative {
        dst: Reg,
        a: Reg,
        n: u32,
        along: Along,
    },
    Texture {
        index: u32,
    },
    /// Takes the values of an input from the caller, if there are some.
    Input {
        index: u32,
    },
    /// Branches, with the points where the condition holds.
    If {
        condition: Reg,
        otherwise: u32,
    },
    Else {
        end: u32,
    },
    EndIf,
    Loop,
    /// Ends the loop for points where the condition does not hold.
    Test {
        condition: Reg,
        end: u32,
    },
    /// The place that `continue` jumps to.
    Next,
    Repeat {
        start: u32,
    },
    EndLoop,
    Switch,
    /// Starts with points where the condition holds.
    Case {
        condition: Reg,
    },
    EndSwitch,
    Break,
    Continue,
    Enter {
        frame: u32,
    },
    Return,
    Leave,
    Discard {
        ends: bool,
    },
    Statement {
        id: StatementId,
    },
    /// An expression has this value.
    Mark {
        expr: ExprId,
        reg: Reg,
        n: u32,
    },
    /// A variable was written.
    Wrote {
        variable: u32,
    },
}

/// A call of a function: each call in the source, per way that leads to it, is compiled separately.
#[derive(Debug, Clone, PartialEq)]
pub struct CallFrame {
    /// The function.
    pub function: String,
    /// The frame of the caller; `None` for `main`.
    pub caller: Option<u32>,
    /// The expression that calls.
    pub call: Option<ExprId>,
    /// The number of calls around it.
    pub depth: u32,
}

/// How often an input changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InputRate {
    /// One value for all points: a uniform, the member of a uniform block, or state of the fixed-function pipeline.
    Uniform,
    /// A value for each point: an attribute, a varying, or a variable such as `gl_FragCoord`.
    PerPoint,
}

/// An input of a shader, under OpenGL's name: `light.light_pos`, `lights[1].colour`, `gl_LightSource[0].position`. The
/// members of a block with an instance name have the block's name: `Matrices.view`.
#[derive(Debug, Clone, PartialEq)]
pub struct StageInput {
    /// Its name.
    pub name: String,
    /// Its basic type, without the array.
    pub ty: Type,
    /// Elements of an array of basic values; 1 if it is not an array.
    pub count: u32,
    /// Whether all points have the same value.
    pub rate: InputRate,
    /// `flat` or `noperspective`.
    pub interpolation: Option<String>,
    /// `layout(location = ..)`
    pub location: Option<i32>,
    /// The position of its declaration; `None` if it is built in.
    pub span: Option<Span>,
    pub(crate) reg: Reg,
    pub(crate) size: u32,
    /// Whether the shader has a value for it if the caller has none.
    pub(crate) has_default: bool,
}

/// An output of a shader, named as inputs are.
#[derive(Debug, Clone, PartialEq)]
pub struct StageOutput {
    /// Its name.
    pub name: String,
    /// Its basic type, without the array.
    pub ty: Type,
    /// Elements of an array of basic values; 1 if it is not an array.
    pub count: u32,
    /// `flat` or `noperspective`.
    pub interpolation: Option<String>,
    /// `layout(location = ..)`
    pub location: Option<i32>,
    /// The position of its declaration; `None` if it is built in.
    pub span: Option<Span>,
    pub(crate) reg: Reg,
    pub(crate) size: u32,
}

/// A variable of the source, for traces.
#[derive(Debug, Clone, PartialEq)]
pub struct TracedVariable {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// The position of its declaration; `None` if it is built in.
    pub span: Option<Span>,
    pub(crate) reg: Reg,
    pub(crate) size: u32,
}

/// A shader that is ready to run. It can be run by several threads.
#[derive(Debug, Clone)]
pub struct CompiledStage {
    /// The stage.
    pub stage: Stage,
    /// Its expressions and statements.
    pub source: SourceMap,
    /// Its inputs in the order of their declarations; built-in ones first.
    pub inputs: Vec<StageInput>,
    /// Its outputs in the order of their declarations; built-in ones first.
    pub outputs: Vec<StageOutput>,
    /// Its variables, by [`crate::TraceWrite::variable`].
    pub variables: Vec<TracedVariable>,
    /// The calls of functions; the first one is `main`.
    pub frames: Vec<CallFrame>,
    /// Whether it takes derivatives, which need points in quads.
    pub takes_derivatives: bool,
    pub(crate) code: Vec<Instr>,
    /// The innermost expression of each instruction.
    pub(crate) places: Vec<Option<ExprId>>,
    pub(crate) textures: Vec<TextureCall>,
    pub(crate) registers: u32,
}

impl CompiledStage {
    /// Returns the index of an input.
    #[must_use]
    pub fn input(&self, name: &str) -> Option<usize> {
        self.inputs.iter().position(|input| input.name == name)
    }

    /// Returns the index of an output.
    #[must_use]
    pub fn output(&self, name: &str) -> Option<usize> {
        self.outputs.iter().position(|output| output.name == name)
    }
}
