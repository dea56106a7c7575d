//! Explains the usual messages of GLSL compilers in plain words.

use gonio_language::{Language, tr};

/// A kind of message: the texts that identify it, in lower case, and its explanation.
struct Usual {
    /// Any one of these lists identifies it, if all of its texts occur in the message.
    signs: &'static [&'static [&'static str]],
    /// The id of the explanation. If it names the name in the message, its attribute `unnamed` does not.
    means: &'static str,
    /// It names something that OpenGL's core profile removed: a better explanation than "undeclared".
    is_removed: bool,
}

const fn usual(signs: &'static [&'static [&'static str]], means: &'static str) -> Usual {
    Usual { signs, means, is_removed: false }
}

const fn removed(signs: &'static [&'static [&'static str]], means: &'static str) -> Usual {
    Usual { signs, means, is_removed: true }
}

/// The first match is used, so special cases precede general ones.
const USUAL: &[Usual] = &[
    removed(&[&["gl_fragcolor"], &["gl_fragdata"]], "check-compiler-frag-color-removed"),
    removed(&[&["texture2d"], &["texturecube"]], "check-compiler-texture-functions-renamed"),
    removed(
        &[&["`attribute'"], &["'attribute'"], &["\"attribute\""], &["'varying'"], &["`varying'"], &["\"varying\""]],
        "check-compiler-attribute-and-varying-removed",
    ),
    usual(
        &[
            &["glsl", "is not supported"],
            &["version", "not supported"],
            &["unsupported version"],
            &["unknown version"],
            &["invalid version"],
            &["unrecognized", "#version"],
            &["bad #version"],
            &["version", "unsupported"],
        ],
        "check-compiler-version-not-supported",
    ),
    usual(
        &[
            &["#version", "first"],
            &["#version must"],
            &["#version", "before"],
            &["version", "must occur"],
            &["version directive"],
        ],
        "check-compiler-version-not-first",
    ),
    usual(
        &[
            &["missing main"],
            &["no main"],
            &["main() not"],
            &["main", "not defined"],
            &["lacks main"],
            &["lacks `main'"],
            &["missing entry point"],
            &["entry point not found"],
            &["no function with a body for main"],
            &["main function"],
            &["does not contain `main'"],
            &["no `main'"],
            &["doesn't contain a main"],
        ],
        "check-compiler-no-main",
    ),
    usual(
        &[&["must write to gl_position"], &["gl_position", "not written"], &["does not write to `gl_position"]],
        "check-compiler-position-not-written",
    ),
    usual(
        &[
            &["not an array", "index"],
            &["subscripted value"],
            &["left of '['", "not"],
            &["cannot dereference non-array"],
            &["non-array", "dereference"],
            &["not of array"],
        ],
        "check-compiler-not-an-array",
    ),
    usual(
        &[
            &["array", "size", "must"],
            &["unsized array"],
            &["array size"],
            &["implicitly sized"],
            &["array", "unsized"],
        ],
        "check-compiler-array-without-size",
    ),
    usual(
        &[&["index", "out of bounds"], &["index", "out of range"], &["index", "bounds"], &["array index"]],
        "check-compiler-index-out-of-range",
    ),
    usual(
        &[
            &["illegal vector field"],
            &["vector swizzle"],
            &["invalid swizzle"],
            &["swizzle"],
            &["no such field"],
            &["field selection"],
            &["illegal", "selection"],
            &["cannot access field"],
            &["invalid field"],
            &["unknown field"],
            &["not a field"],
            &["no field"],
            &["not a member"],
        ],
        "check-compiler-no-such-member",
    ),
    usual(
        &[
            &["too many arguments"],
            &["too many parameters to"],
            &["too many components"],
            &["constructor", "too many"],
            &["too much data"],
        ],
        "check-compiler-too-many-values",
    ),
    usual(
        &[
            &["too few", "construct"],
            &["not enough data"],
            &["too little data"],
            &["not enough", "construct"],
            &["insufficient"],
            &["too few components"],
            &["constructor", "not enough"],
        ],
        "check-compiler-too-few-values",
    ),
    usual(
        &[&["initializer", "type"], &["initializer of type"], &["cannot initialize"]],
        "check-compiler-initialiser-of-another-type",
    ),
    usual(
        &[
            &["l-value"],
            &["lvalue"],
            &["read-only"],
            &["read only"],
            &["cannot modify"],
            &["can't modify"],
            &["is not assignable"],
            &["assignment to", "`in'"],
            &["assign", "shader input"],
            &["assignment to varying"],
            &["const", "assign"],
        ],
        "check-compiler-read-only",
    ),
    usual(
        &[
            &["no matching function"],
            &["no matching overloaded"],
            &["no overload"],
            &["unable to find compatible overloaded"],
            &["no function with", "name"],
            &["invalid call"],
            &["can't find", "function"],
            &["no matching constructor"],
            &["parameter types do not match"],
        ],
        "check-compiler-no-function-for-these-types",
    ),
    usual(
        &[
            &["fragment", "input", "not", "vertex"],
            &["not declared", "previous stage"],
            &["not written by"],
            &["not an output"],
            &["no matching output"],
            &["has no corresponding output"],
            &["does not match any output"],
            &["not declared in input from previous"],
            &["input", "no", "output"],
            &["varying", "not declared"],
            &["undeclared in vertex"],
            &["varying", "not written"],
        ],
        "check-compiler-not-written-by-vertex-shader",
    ),
    usual(
        &[
            &["type mismatch", "varying"],
            &["varying", "mismatch"],
            &["varyings", "differ"],
            &["types of", "differ"],
            &["output", "but", "input", "type"],
            &["declared as type", "but", "input"],
            &["declared with type", "but", "input"],
            &["interface", "mismatch"],
        ],
        "check-compiler-varying-of-two-types",
    ),
    usual(&[&["interpolation qualif"], &["flat", "must"], &["qualified as flat"]], "check-compiler-flat-in-one-stage"),
    usual(
        &[
            &["uniform", "differ"],
            &["uniform", "mismatch"],
            &["uniform", "declared as type"],
            &["uniform", "declared as"],
        ],
        "check-compiler-uniform-of-two-types",
    ),
    usual(
        &[
            &["redeclar"],
            &["redefin"],
            &["already declared"],
            &["already defined"],
            &["previously declared"],
            &["duplicate"],
            &["previous declaration"],
        ],
        "check-compiler-declared-twice",
    ),
    usual(
        &[
            &["reserved word"],
            &["reserved keyword"],
            &["is reserved"],
            &["reserved built-in"],
            &["illegal use of reserved"],
            &["identifier", "reserved"],
            &["keyword", "identifier"],
        ],
        "check-compiler-reserved-name",
    ),
    usual(&[&["division by zero"], &["divide by zero"]], "check-compiler-division-by-zero"),
    usual(
        &[
            &["wrong operand types"],
            &["operands", "of type"],
            &["arithmetic operators"],
            &["vector", "size", "mismatch"],
            &["size mismatch"],
            &["no operation"],
            &["operator", "operand"],
            &["not supported on operand"],
            &["invalid operands"],
            &["does not operate on"],
            &["operands to"],
            &["matrix multiplication"],
            &["multiply"],
        ],
        "check-compiler-operands-do-not-match",
    ),
    usual(
        &[
            &["implicit", "int", "float"],
            &["implicit conversion"],
            &["implicit cast"],
            &["implicitly convert"],
            &["cannot convert", "'const int' to"],
            &["cannot convert", "int", "float"],
            &["global implicit"],
        ],
        "check-compiler-integer-instead-of-float",
    ),
    usual(
        &[
            &["value of type", "cannot be assigned"],
            &["cannot convert"],
            &["cannot be assigned"],
            &["type mismatch"],
            &["incompatible types in"],
            &["can't convert"],
            &["cannot assign"],
            &["assigning", "incompatible"],
            &["no conversion"],
            &["unable to convert"],
            &["conversion"],
            &["does not match variable"],
        ],
        "check-compiler-different-types",
    ),
    usual(
        &[
            &["return", "type"],
            &["non-void", "return"],
            &["must return"],
            &["return with"],
            &["`return'"],
            &["'return'"],
        ],
        "check-compiler-returned-type",
    ),
    usual(
        &[
            &["condition", "bool"],
            &["if-statement"],
            &["boolean expression"],
            &["must be scalar boolean"],
            &["scalar boolean"],
        ],
        "check-compiler-condition-not-bool",
    ),
    usual(&[&["sampler", "uniform"], &["sampler", "must be"], &["opaque"]], "check-compiler-sampler-not-uniform"),
    usual(
        &[&["no precision"], &["precision", "declared"], &["default precision"], &["precision", "must"]],
        "check-compiler-no-precision",
    ),
    usual(
        &[&["in", "out", "qualifier", "not"], &["storage qualifier"], &["qualifier"]],
        "check-compiler-qualifier-not-allowed",
    ),
    usual(
        &[&["used uninitialized"], &["might be used before"], &["uninitialized"], &["use of uninitialised"]],
        "check-compiler-read-before-assigned",
    ),
    usual(&[&["recursion"], &["recursive"]], "check-compiler-recursion"),
    usual(&[&["#include"], &["extension", "include"]], "check-compiler-include"),
    usual(
        &[
            &["extension", "not supported"],
            &["extension", "unsupported"],
            &["unknown extension"],
            &["unsupported extension"],
        ],
        "check-compiler-extension-missing",
    ),
    usual(
        &[
            &["non-ascii"],
            &["illegal character"],
            &["invalid character"],
            &["unexpected character"],
            &["illegal non-ascii"],
        ],
        "check-compiler-character-not-allowed",
    ),
    usual(
        &[
            &["unterminated"],
            &["#endif"],
            &["without #if"],
            &["unexpected eof"],
            &["end of file"],
            &["unexpected end"],
            &["unexpected $end"],
            &["$undefined"],
            &["premature end"],
        ],
        "check-compiler-file-ends-too-early",
    ),
    usual(
        &[&["linking with uncompiled"], &["uncompiled"], &["not successfully compiled"], &["unspecialized shader"]],
        "check-compiler-not-linked",
    ),
];

/// The id of the explanation of an undeclared name.
const UNDECLARED: &str = "check-compiler-undeclared";

/// The id of the explanation of a syntax error.
const SYNTAX: &str = "check-compiler-syntax";

/// Returns a plain explanation of a usual message; `None` for others.
#[must_use]
pub fn explain(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let fits = |usual: &&Usual| usual.signs.iter().any(|signs| signs.iter().all(|sign| lower.contains(sign)));
    let usual = USUAL.iter().find(fits);
    // A name may contain any of the texts, so these two kinds are identified by the whole message.
    let means = if is_undeclared(text) && !usual.is_some_and(|usual| usual.is_removed) {
        UNDECLARED
    } else if let Some(usual) = usual {
        usual.means
    } else if is_syntax(text) {
        SYNTAX
    } else {
        return None;
    };
    let unnamed = gonio_language::text_in(Language::current(), &format!("{means}.unnamed"));
    Some(match (quoted_names(text).into_iter().next(), unnamed) {
        (Some(name), Some(_)) => tr!(means, name = name),
        (None, Some(unnamed)) => unnamed.to_owned(),
        (_, None) => tr!(means).to_owned(),
    })
}

/// Whether a message reports an undeclared name.
pub(super) fn is_undeclared(text: &str) -> bool {
    let lower = text.to_lowercase();
    [
        "undeclared identifier",
        "undefined variable",
        "' undeclared",
        "no such variable",
        "undeclared variable",
        "is not declared",
    ]
    .iter()
    .any(|sign| lower.contains(sign))
        || lower.ends_with("undeclared")
}

/// Whether a message reports a syntax error.
pub(super) fn is_syntax(text: &str) -> bool {
    let lower = text.to_lowercase();
    ["syntax error", "unexpected", "expected token", "expecting", "expected ", "parse error"]
        .iter()
        .any(|sign| lower.contains(sign))
}

/// Returns the names that a message has in quotation marks or after its last colon.
pub(super) fn quoted_names(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = text;
    while let Some(open) = rest.find(['`', '\'', '"']) {
        let inside = &rest[open + 1..];
        let Some(close) = inside.find(['\'', '"', '`']) else { break };
        // `dot(vec3, vec4)` is `dot`.
        let name = inside[..close].split(['(', '[']).next().unwrap_or_default().trim();
        // glslang quotes these for operations.
        if is_name(name) && !matches!(name, "assign" | "constructor" | "return" | "initializer") {
            names.push(name.to_owned());
        }
        rest = &inside[close + 1..];
        if names.len() >= 8 {
            break;
        }
    }
    if names.is_empty()
        && let Some((_, last)) = text.rsplit_once(": ")
        && is_name(last.trim())
    {
        names.push(last.trim().to_owned());
    }
    names
}

fn is_name(text: &str) -> bool {
    text.len() < 200
        && text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.')
}
