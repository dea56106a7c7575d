//! Keywords and reserved words.

use crate::Version;

/// Keywords of statements in every version.
const STATEMENTS: &str =
    " if else for while do return break continue discard struct const in out inout uniform true false ";

/// Qualifiers, with the first versions (desktop, ES) that have them; 0 is never.
const QUALIFIERS: [(&str, u32, u32); 30] = [
    ("const", 110, 100),
    ("in", 110, 100),
    ("out", 110, 100),
    ("inout", 110, 100),
    ("uniform", 110, 100),
    ("attribute", 110, 100),
    ("varying", 110, 100),
    ("invariant", 120, 100),
    ("centroid", 120, 300),
    ("flat", 130, 300),
    ("smooth", 130, 300),
    ("noperspective", 130, 0),
    ("highp", 110, 100),
    ("mediump", 110, 100),
    ("lowp", 110, 100),
    ("layout", 110, 100),
    ("patch", 400, 320),
    ("sample", 400, 320),
    ("precise", 400, 320),
    ("buffer", 430, 310),
    ("shared", 430, 310),
    ("coherent", 420, 310),
    ("volatile", 420, 310),
    ("restrict", 420, 310),
    ("readonly", 420, 310),
    ("writeonly", 420, 310),
    ("subroutine", 400, 0),
    ("superp", 0, 0),
    ("packed", 0, 0),
    ("row_major", 0, 0),
];

/// Words that are reserved in every version without having a meaning (GLSL 4.60 and GLSL ES 3.00, sections 3.6 and
/// 3.7).
const RESERVED: &str = " asm class union enum typedef template this goto inline noinline volatile public static extern \
external interface long short half fixed unsigned superp input output hvec2 hvec3 hvec4 fvec2 fvec3 fvec4 \
sampler3DRect sizeof cast namespace using ";

/// Further reserved words, with the first versions (desktop, ES).
const RESERVED_FROM: [(&str, u32, u32); 22] = [
    ("common", 130, 300),
    ("partition", 130, 300),
    ("active", 130, 300),
    ("filter", 130, 300),
    ("resource", 420, 300),
    ("double", 110, 100),
    ("switch", 110, 100),
    ("case", 130, 300),
    ("default", 110, 100),
    ("uint", 130, 300),
    ("attribute", 110, 100),
    ("varying", 110, 100),
    ("coherent", 420, 300),
    ("restrict", 420, 300),
    ("readonly", 420, 300),
    ("writeonly", 420, 300),
    ("noperspective", 130, 300),
    ("patch", 400, 300),
    ("sample", 400, 300),
    ("subroutine", 400, 300),
    ("atomic_uint", 420, 300),
    ("precision", 130, 100),
];

fn listed(list: &str, word: &str) -> bool {
    !word.is_empty() && list.split_ascii_whitespace().any(|w| w == word)
}

/// Whether the word is a qualifier in this version.
pub(crate) fn is_qualifier(word: &str, version: Version) -> bool {
    QUALIFIERS.iter().any(|(w, desktop, es)| *w == word && version.is_at_least(*desktop, *es))
}

/// Whether the word is a keyword of statements, which can never be a name.
pub(crate) fn is_statement(word: &str, version: Version) -> bool {
    listed(STATEMENTS, word) || (matches!(word, "switch" | "case" | "default") && version.is_at_least(130, 300))
}

/// Whether the word is a built-in type in this version.
pub(crate) fn is_type(word: &str, version: Version) -> bool {
    match word {
        "uint" | "uvec2" | "uvec3" | "uvec4" => version.is_at_least(130, 300),
        "double" => version.is_at_least(400, 0),
        _ if word.starts_with("dvec") || word.starts_with("dmat") => version.is_at_least(400, 0),
        _ => crate::Type::named(word).is_some(),
    }
}

/// Whether the word cannot be the name of a variable, function or struct in this version.
pub(crate) fn is_reserved(word: &str, version: Version) -> bool {
    is_statement(word, version)
        || is_qualifier(word, version)
        || is_type(word, version)
        || listed(RESERVED, word)
        || RESERVED_FROM.iter().any(|(w, desktop, es)| *w == word && version.is_at_least(*desktop, *es))
}
