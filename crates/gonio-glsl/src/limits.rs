//! Limits on the size and depth of a shader. A shader that exceeds one is rejected with a [`Limit`] and must not be
//! given to a driver: drivers recurse, expand and unroll without limits of their own, in the calling process.
//!
//! The figures for each limit are those of Mesa 22.3 (llvmpipe) with one shader that was large in this respect alone,
//! on a thread with a stack of 8 MiB. Limits are at most half of what caused the first crash, and allow about a
//! gigabyte or half a minute where nothing crashes. ANGLE, the compiler of browsers, has a limit of 256 for nested
//! expressions, statements and calls.

/// Most bytes of a source. A generated shader of 10,000 lines is shorter.
pub const MOST_BYTES: usize = 4 << 20;
/// Most tokens of a source, including branches that are not compiled.
pub const MOST_RAW_TOKENS: usize = 1_000_000;
/// Most tokens after preprocessing. 800,000 tokens of assignments: 13 s and 0.9 GB.
pub const MOST_TOKENS: usize = 250_000;
/// Most bytes of a name (GLSL ES 3.00, section 3.9, has 1,024).
pub const MOST_NAME_BYTES: usize = 1024;
/// Most tokens that macros expand to, including those in arguments. 655,000 tokens by doubling: 11 s and 0.7 GB; 40
/// doublings: 10 GB.
pub const MOST_EXPANDED: usize = 500_000;
/// Most nested macros in arguments of macros. 3,000 of them: 1.5 GB.
pub const MOST_MACROS_IN_ARGUMENTS: usize = 64;
/// Most nested macros in bodies of macros. 4,000 of them are harmless.
pub const MOST_MACROS_IN_MACROS: usize = 1024;
/// Most levels of expressions, statements and parentheses; also the terms of a sum, the branches of `else if` and the
/// operands of `?:`. A sum of 4,000 terms: 12 s and 3.7 GB; of 8,000: a crash. 2,048 branches: rejected as memory
/// exhausted.
pub const MOST_NESTED: usize = 256;
/// Most levels of structs in members of structs.
pub const MOST_STRUCTS_NESTED: usize = 64;
/// Most array sizes after a type or a name.
pub const MOST_ARRAY_SIZES: usize = 8;
/// Most components of one variable or value: 64 KiB, four times the uniform block size that GL 3.3 requires. A local
/// array of 16,384 that is indexed by a variable: 8 s and 0.6 GB; of 65,536: no end within 40 s; of 2,147,483,647: a
/// crash.
pub const MOST_COMPONENTS: u64 = 16_384;
/// Most components of an input or output between the stages, of which GL 3.3 has 128. An array of 1,024 inputs: 2.5 s;
/// of 4,096: 18 s; of 2,147,483,647: a crash.
pub const MOST_INTERFACE_COMPONENTS: u64 = 1024;
/// Most components of all variables of a shader.
pub const MOST_ALL_COMPONENTS: u64 = 65_536;
/// Most global variables, and members of a struct or block.
pub const MOST_VARIABLES: usize = 4096;
/// Most functions. 50,000: 17 s.
pub const MOST_FUNCTIONS: usize = 4096;
/// Most overloads of a function.
pub const MOST_OVERLOADS: usize = 128;
/// Most levels of function calls. 1,000: 1 GB; 4,000: a crash.
pub const MOST_CALLS_NESTED: u32 = 256;
/// Most expressions of a shader with all calls inlined, as drivers compile it. 16,384 calls by doubling, of 5
/// expressions each: 15 s; four times that: no end within a minute.
pub const MOST_INLINED: u64 = 200_000;
/// Most levels of loops, including those in called functions. 16: 5 s and 0.2 GB, and twice as much for each further
/// one.
pub const MOST_LOOPS_NESTED: u32 = 12;
/// Most cases of a `switch`. 512: 12 s; 1,000: 35 s and 0.4 GB.
pub const MOST_CASES: usize = 512;

/// A limit that a shader exceeds.
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
    /// The size of an array cannot be evaluated.
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
    /// Too many syntax errors to go on.
    SyntaxErrors,
}

impl Limit {
    /// Returns the stable code of the problem.
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
