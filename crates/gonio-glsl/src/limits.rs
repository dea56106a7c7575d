//! The sizes and depths that a shader may have. What exceeds one is refused with [`Limit`], and must not be given to a
//! driver: drivers recurse, expand and unroll without limits of their own, in the process of whoever calls them.
//!
//! The figures beside each limit are what Mesa 22.3 (llvmpipe) did with one shader that was large in this respect alone, on
//! a thread with a stack of 8 MiB. Limits leave at least a factor of 2 before the first crash, and about a gigabyte or half
//! a minute where nothing crashes. ANGLE, the compiler of browsers, has 256 for nested expressions, statements and calls.

/// Bytes of a source. A generated shader of 10,000 lines is shorter.
pub const MOST_BYTES: usize = 4 << 20;
/// Tokens in a source, branches that are not compiled included.
pub const MOST_RAW_TOKENS: usize = 1_000_000;
/// Tokens that the preprocessor leaves. 800,000 tokens of assignments: 13 s and 0.9 GB.
pub const MOST_TOKENS: usize = 250_000;
/// Bytes of a name (GLSL ES 3.00, section 3.9, has 1,024).
pub const MOST_NAME_BYTES: usize = 1024;
/// Tokens that macros expand to, those within arguments included. 655,000 tokens by doubling: 11 s and 0.7 GB; 40 doublings:
/// 10 GB.
pub const MOST_EXPANDED: usize = 500_000;
/// Macros in the arguments of macros. 3,000 of them: 1.5 GB.
pub const MOST_MACROS_IN_ARGUMENTS: usize = 64;
/// Macros in the text of macros. 4,000 of them are harmless.
pub const MOST_MACROS_IN_MACROS: usize = 1024;
/// Expressions, statements and brackets within one another; also the terms of a sum, the branches of `else if` and the
/// operands of `?:`. A sum of 4,000 terms: 12 s and 3.7 GB; of 8,000: a crash. 2,048 branches: refused as memory exhausted.
pub const MOST_NESTED: usize = 256;
/// Structs in members of structs.
pub const MOST_STRUCTS_NESTED: usize = 64;
/// Sizes in brackets behind a type or a name.
pub const MOST_ARRAY_SIZES: usize = 8;
/// Components of one variable or value: 64 KiB, what GL 3.3 asks for a block of uniforms four times. A local array of 16,384
/// that is indexed by a variable: 8 s and 0.6 GB; of 65,536: no end within 40 s; of 2,147,483,647: a crash.
pub const MOST_COMPONENTS: u64 = 16_384;
/// Components of an input or output between the stages, of which GL 3.3 has 128. An array of 1,024 inputs: 2.5 s; of 4,096:
/// 18 s; of 2,147,483,647: a crash.
pub const MOST_INTERFACE_COMPONENTS: u64 = 1024;
/// Components of all variables of a shader.
pub const MOST_ALL_COMPONENTS: u64 = 65_536;
/// Global variables, and members of a struct or block.
pub const MOST_VARIABLES: usize = 4096;
/// Functions. 50,000: 17 s.
pub const MOST_FUNCTIONS: usize = 4096;
/// Functions of one name.
pub const MOST_OVERLOADS: usize = 128;
/// Calls of functions within called functions. 1,000: 1 GB; 4,000: a crash.
pub const MOST_CALLS_NESTED: u32 = 256;
/// Expressions of a shader in which each call stands for the function's body, as drivers compile it. 16,384 calls by
/// doubling, of 5 expressions each: 15 s; four times that: no end within a minute.
pub const MOST_INLINED: u64 = 200_000;
/// Loops within loops, by way of calls too. 16: 5 s and 0.2 GB, and twice as much for each further one.
pub const MOST_LOOPS_NESTED: u32 = 12;
/// Cases of a `switch`. 512: 12 s; 1,000: 35 s and 0.4 GB.
pub const MOST_CASES: usize = 512;

/// Which limit a shader exceeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Limit {
    /// [`MOST_BYTES`]
    Bytes,
    /// [`MOST_RAW_TOKENS`] and [`MOST_TOKENS`]
    Tokens,
    /// [`MOST_NAME_BYTES`]
    Name,
    /// [`MOST_EXPANDED`], [`MOST_MACROS_IN_ARGUMENTS`] and [`MOST_MACROS_IN_MACROS`]
    Macros,
    /// [`MOST_NESTED`]
    Nested,
    /// [`MOST_STRUCTS_NESTED`]
    StructsNested,
    /// [`MOST_ARRAY_SIZES`]
    ArraySizes,
    /// [`MOST_COMPONENTS`]
    Components,
    /// The size of an array is a constant that this reader cannot work out.
    UnknownSize,
    /// [`MOST_INTERFACE_COMPONENTS`]
    InterfaceComponents,
    /// [`MOST_ALL_COMPONENTS`]
    AllComponents,
    /// [`MOST_VARIABLES`]
    Variables,
    /// [`MOST_FUNCTIONS`] and [`MOST_OVERLOADS`]
    Functions,
    /// [`MOST_CALLS_NESTED`]
    CallsNested,
    /// [`MOST_INLINED`]
    Inlined,
    /// [`MOST_LOOPS_NESTED`]
    LoopsNested,
    /// [`MOST_CASES`]
    Cases,
    /// So many syntax errors that the rest was not read.
    SyntaxErrors,
}

impl Limit {
    /// The stable word of the problem.
    pub(crate) fn code(self) -> &'static str {
        match self {
            Self::Macros => "macro-endless",
            Self::Nested | Self::StructsNested | Self::CallsNested | Self::LoopsNested => "too-deep",
            _ => "too-large",
        }
    }
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let large = "this shader is too large";
        let deep = "this shader is nested too deeply";
        match self {
            Self::Bytes => write!(f, "{large}: it has more than {} MiB", MOST_BYTES >> 20),
            Self::Tokens => write!(f, "{large}: it has more than {MOST_TOKENS} tokens"),
            Self::Name => write!(f, "{large}: this name has more than {MOST_NAME_BYTES} bytes"),
            Self::Macros => write!(f, "{large}: this macro expands to more and more text"),
            Self::Nested => write!(f, "{deep}: more than {MOST_NESTED} levels of expressions or statements"),
            Self::StructsNested => write!(f, "{deep}: more than {MOST_STRUCTS_NESTED} levels of structs"),
            Self::ArraySizes => write!(f, "{large}: this array has more than {MOST_ARRAY_SIZES} dimensions"),
            Self::Components => write!(f, "{large}: this takes more than {MOST_COMPONENTS} components"),
            Self::UnknownSize => write!(f, "the size of this array cannot be evaluated here: write it as a number"),
            Self::InterfaceComponents => {
                write!(f, "{large}: this input or output takes more than {MOST_INTERFACE_COMPONENTS} components")
            }
            Self::AllComponents => write!(f, "{large}: its variables take more than {MOST_ALL_COMPONENTS} components"),
            Self::Variables => write!(f, "{large}: more than {MOST_VARIABLES} variables are declared here"),
            Self::Functions => {
                write!(f, "{large}: more than {MOST_FUNCTIONS} functions, or {MOST_OVERLOADS} of one name")
            }
            Self::CallsNested => {
                write!(f, "{deep}: function calls are nested more than {MOST_CALLS_NESTED} deep")
            }
            Self::Inlined => {
                write!(f, "{large}: with the functions it calls, this one has more than {MOST_INLINED} expressions")
            }
            Self::LoopsNested => write!(f, "{deep}: more than {MOST_LOOPS_NESTED} nested loops"),
            Self::Cases => write!(f, "{large}: this `switch` has more than {MOST_CASES} cases"),
            Self::SyntaxErrors => write!(f, "too many errors: parsing stops here"),
        }
    }
}
