//! Explains the usual messages of GLSL compilers in plain words.

/// A kind of message: the texts that identify it, in lower case, and its explanation.
struct Usual {
    /// Any one of these lists identifies it, if all of its texts occur in the message.
    signs: &'static [&'static [&'static str]],
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

/// The first match is used, so special cases precede general ones. `{name}` is the name in the message.
const USUAL: &[Usual] = &[
    removed(
        &[&["gl_fragcolor"], &["gl_fragdata"]],
        "`gl_FragColor` was removed in version 330 core: declare `out vec4 FragColor;` and write to that.",
    ),
    removed(
        &[&["texture2d"], &["texturecube"]],
        "`texture2D` and `textureCube` are called `texture` since version 330 core.",
    ),
    removed(
        &[&["`attribute'"], &["'attribute'"], &["\"attribute\""], &["'varying'"], &["`varying'"], &["\"varying\""]],
        "`attribute` and `varying` were removed in version 330 core: write `in` and `out`.",
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
        "This computer's OpenGL does not support that `#version`: write `#version 330 core`, which every driver \
         supports.",
    ),
    usual(
        &[
            &["#version", "first"],
            &["#version must"],
            &["#version", "before"],
            &["version", "must occur"],
            &["version directive"],
        ],
        "`#version` must be the first line of the shader; only comments and empty lines may precede it.",
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
        "There is no `void main()`: every shader needs one, spelled exactly like this.",
    ),
    usual(
        &[&["must write to gl_position"], &["gl_position", "not written"], &["does not write to `gl_position"]],
        "The vertex shader never writes to `gl_Position`, the position of the vertex.",
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
        "Square brackets follow something that is not an array, vector or matrix.",
    ),
    usual(
        &[
            &["array", "size", "must"],
            &["unsized array"],
            &["array size"],
            &["implicitly sized"],
            &["array", "unsized"],
        ],
        "An array needs a constant size where it is declared: `vec3 lights[4];`.",
    ),
    usual(
        &[&["index", "out of bounds"], &["index", "out of range"], &["index", "bounds"], &["array index"]],
        "The index is out of range: the first element has index 0, and the last one has the size minus 1.",
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
        "What follows the dot is not a component or member: a vec3 has x, y, z (or r, g, b) but no w; a struct has \
         only the members that it declares.",
    ),
    usual(
        &[
            &["too many arguments"],
            &["too many parameters to"],
            &["too many components"],
            &["constructor", "too many"],
            &["too much data"],
        ],
        "Too many values in the parentheses: vec3 takes three numbers, or vectors with three components in total.",
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
        "Too few values in the parentheses: vec4 takes four numbers, for example `vec4(v, 1.0)` for a vec3 v.",
    ),
    usual(
        &[&["initializer", "type"], &["initializer of type"], &["cannot initialize"]],
        "The value on the right has a different type from the variable on the left: convert it, for example with \
         `vec3(v4)` or `v4.xyz` for a vec4, `vec4(v3, 1.0)` for a vec3.",
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
        "`{name}` cannot be changed: `in`, `uniform` and `const` variables are read-only. Copy it to a variable of \
         your own and change that.",
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
        "No function `{name}` takes arguments of these types: check the type of each. `dot`, `reflect`, `cross` and \
         `max` take two arguments of the same type (vec3 and vec3), `texture` takes a sampler and a vec2 (a vec3 for \
         a cubemap).",
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
        "The fragment shader reads `{name}`, but the vertex shader has no `out` of that name: both must have the same name and \
         type.",
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
        "`{name}` is declared in both stages with different types: the vertex shader's `out` and the fragment \
         shader's `in` must match.",
    ),
    usual(
        &[&["interpolation qualif"], &["flat", "must"], &["qualified as flat"]],
        "`flat` must be written in both stages or in neither; an integer varying requires it.",
    ),
    usual(
        &[
            &["uniform", "differ"],
            &["uniform", "mismatch"],
            &["uniform", "declared as type"],
            &["uniform", "declared as"],
        ],
        "The uniform `{name}` is declared in both stages with different types: the types must match.",
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
        "`{name}` is declared twice in the same place: remove one, or rename it.",
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
        "`{name}` is reserved in GLSL (as are `input`, `output`, `sample`, `filter`, `texture`, names with `gl_` or \
         two underscores): give it another name.",
    ),
    usual(&[&["division by zero"], &["divide by zero"]], "A constant is divided by zero here."),
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
        "The two sides of the operator do not match: vectors must have the same size (vec3 with vec3), a mat4 \
         multiplies a vec4 (write `vec4(v, 1.0)`), and floats are written with a decimal point (`2.0` instead of \
         `2`).",
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
        "Expected a float, found an integer: write it with a decimal point, `2.0` instead of `2`.",
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
        "The value and the variable have different types: take some components of the value (`v4.xyz`, `vec3(v4)`) or \
         add the missing ones (`vec4(v3, 1.0)`).",
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
        "The returned value does not have the function's return type.",
    ),
    usual(
        &[
            &["condition", "bool"],
            &["if-statement"],
            &["boolean expression"],
            &["must be scalar boolean"],
            &["scalar boolean"],
        ],
        "A condition must be a bool: write a comparison, for example `if (x > 0.0)`.",
    ),
    usual(
        &[&["sampler", "uniform"], &["sampler", "must be"], &["opaque"]],
        "A sampler can only be a `uniform` or a function's parameter, not a variable or a varying.",
    ),
    usual(
        &[&["no precision"], &["precision", "declared"], &["default precision"], &["precision", "must"]],
        "GLSL ES requires a precision: write `precision mediump float;` under the `#version`.",
    ),
    usual(
        &[&["in", "out", "qualifier", "not"], &["storage qualifier"], &["qualifier"]],
        "This declaration has a qualifier that is not allowed here: `in`, `out` and `uniform` belong outside of \
         functions, each once, and `layout(location = 0)` on an `in` of a fragment shader needs version 410.",
    ),
    usual(
        &[&["used uninitialized"], &["might be used before"], &["uninitialized"], &["use of uninitialised"]],
        "`{name}` is read before it is assigned a value.",
    ),
    usual(&[&["recursion"], &["recursive"]], "A function calls itself, which GLSL does not allow."),
    usual(&[&["#include"], &["extension", "include"]], "GLSL has no `#include`: paste the text of that file here."),
    usual(
        &[
            &["extension", "not supported"],
            &["extension", "unsupported"],
            &["unknown extension"],
            &["unsupported extension"],
        ],
        "The graphics driver does not have that extension: remove the `#extension` line.",
    ),
    usual(
        &[
            &["non-ascii"],
            &["illegal character"],
            &["invalid character"],
            &["unexpected character"],
            &["illegal non-ascii"],
        ],
        "There is a character that GLSL does not allow, perhaps a quotation mark, a dash or a space copied from a web \
         page or a text document: retype it.",
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
        "The file ends too early: a `}`, a `*/` or an `#endif` is missing.",
    ),
    usual(
        &[&["linking with uncompiled"], &["uncompiled"], &["not successfully compiled"], &["unspecialized shader"]],
        "The program cannot be linked because one of its shaders did not compile: fix that first.",
    ),
];

/// The explanation of an undeclared name.
const UNDECLARED: &str = "`{name}` is not declared here: declare it (`uniform`, `in`, or a variable before this \
                          line), or check its spelling, including capitals.";

/// The explanation of a syntax error.
const SYNTAX: &str = "The compiler cannot parse this. Often a semicolon or a bracket is missing at the end of the \
 previous line.";

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
    Some(match quoted_names(text).into_iter().next() {
        Some(name) => means.replace("{name}", &name),
        None => means.replace(" `{name}`", "").replace("`{name}`", "It"),
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
