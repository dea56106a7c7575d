//! The text of a GLSL function as part of a larger shader, in the words of GLSL ES 3.00, which GLSL 3.30 shares.

use crate::explorer::write_glsl;
use crate::glsl::GlslBrdfError;
use crate::parameter::ParameterValues;
use gonio_glsl::ast::Declaration;
use gonio_glsl::{Item, OutputVersion, Severity, Stage, check, parse, translate};
use std::collections::BTreeSet;

/// The beginning of every global name of an embedded function. Its BRDF is called `gonioBrdfBRDF`.
pub const PREFIX: &str = "gonioBrdf";

/// What the function is checked with; it is cut off again.
const MAIN: &str =
    "void main() { gl_Position = vec4(BRDF(vec3(1.0), vec3(1.0), vec3(1.0), vec3(1.0), vec3(1.0)), 1.0); }";

/// A function `vec3 gonioBrdfBRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)` that another shader can contain: parameters
/// are constants, conversions are written out, and global names cannot meet those of the shader.
///
/// # Errors
///
/// A text with errors, or with a construct that GLSL ES 3.00 lacks.
pub fn embedded_glsl(text: &str, values: &ParameterValues) -> Result<String, GlslBrdfError> {
    let constants = write_glsl("", text, values);
    let source = format!("#version 410\n{constants}\n{MAIN}\n");
    let own_lines = constants.lines().count() + 1;
    let mut parsed = parse(&source);
    let checked = check(&mut parsed, Stage::Vertex);
    let problems = parsed.problems.iter().chain(&checked.problems);
    let error = |problem: &gonio_glsl::Problem| GlslBrdfError {
        // The parameters come first, a line each, after the version, a title of two lines, and an empty line; an empty line
        // follows them. Empty lines at the beginning of the text were removed.
        line: (problem.span.line as usize).saturating_sub(5 + values.iter().count()).max(1) as u32,
        column: problem.span.column,
        message: problem.message.clone(),
    };
    if let Some(problem) = problems.clone().find(|problem| problem.severity == Severity::Error) {
        return Err(error(problem));
    }
    let translated = translate(&parsed, &checked, OutputVersion::Es300);
    if let Some(problem) = translated.problems.first() {
        return Err(error(problem));
    }
    let is_own =
        |line: &&str| !line.trim_start().starts_with("#version") && !line.trim_start().starts_with("precision");
    let before = translated.first_line.saturating_sub(1) as usize;
    let lines = translated.text.lines().take(before + own_lines).filter(is_own);
    let kept = lines.collect::<Vec<_>>().join("\n");
    let mut names = global_names(&parsed.unit.items);
    names.called.extend(kept.lines().filter_map(defined_name).map(str::to_owned));
    Ok(renamed(&kept, &names))
}

/// The names of a text.
#[derive(Default)]
struct GlobalNames {
    /// Functions, structs and macros.
    called: BTreeSet<String>,
    /// A variable may have the name of a built-in function.
    variables: BTreeSet<String>,
}

fn global_names(items: &[Item]) -> GlobalNames {
    let mut names = GlobalNames::default();
    for item in items {
        match item {
            Item::Function(function) if function.name != "main" => {
                names.called.insert(function.name.clone());
            }
            Item::Declaration(Declaration { ty, declarators, .. }) => {
                names.called.extend(ty.definition.iter().map(|definition| definition.name.clone()));
                names.variables.extend(declarators.iter().map(|declarator| declarator.name.clone()));
            }
            _ => {}
        }
    }
    names.called.remove("");
    names.variables.remove("");
    names
}

/// The name that a line `#define NAME ...` defines.
fn defined_name(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("define")?.trim_start();
    let end = rest.find(|c: char| !is_of_word(c)).unwrap_or(rest.len());
    rest.get(..end).filter(|name| !name.is_empty())
}

fn is_of_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// The text with a prefix before each of these names, and before names in capitals, which shaders use for constants. What
/// follows a dot is a component.
fn renamed(text: &str, names: &GlobalNames) -> String {
    let mut result = String::with_capacity(text.len() + text.len() / 4);
    let mut rest = text;
    let mut before = ' ';
    while let Some(c) = rest.chars().next() {
        let is_word = is_of_word(c);
        let end = rest.find(|other: char| is_of_word(other) != is_word).unwrap_or(rest.len());
        let (part, after) = rest.split_at(end);
        let is_constant = part.len() > 1 && !part.chars().any(|c| c.is_ascii_lowercase()) && !c.is_ascii_digit();
        let is_call = after.trim_start().starts_with('(');
        let is_name = names.called.contains(part) || (names.variables.contains(part) && !is_call);
        if is_word && before != '.' && (is_name || is_constant) {
            result.push_str(PREFIX);
        }
        result.push_str(part);
        before = part.trim_end().chars().last().unwrap_or(before);
        rest = after;
    }
    result
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::models::MODELS;

    fn embed(text: &str) -> Result<String, GlslBrdfError> {
        embedded_glsl(text, &ParameterValues::defaults(Vec::new()))
    }

    #[test]
    fn every_model_can_be_embedded() {
        let mut count = 0;
        for model in MODELS {
            let Some(text) = model.glsl else { continue };
            let embedded = embedded_glsl(text, &ParameterValues::defaults(model.parameters)).unwrap();
            assert!(embedded.contains("vec3 gonioBrdfBRDF(vec3 L"), "{}: {embedded}", model.name);
            assert!(!embedded.contains("main"), "{}: {embedded}", model.name);
            count += 1;
        }
        assert_eq!(count, MODELS.len() - 1, "all but the smooth dielectric");
    }

    #[test]
    fn global_names_are_changed_and_components_are_not() {
        let text = "#define SQR(x) ((x) * (x))\nconst float PI = 3.0;\nstruct Lobe { float r; };\nfloat r(vec3 v) { return v.r; }\n\
                    vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { Lobe lobe; lobe.r = r(L); float rest = 1.5; \
                    return vec3(SQR(lobe.r) * 2 * rest / PI); }\n";
        let embedded = embed(text).unwrap();
        for expected in [
            "#define gonioBrdfSQR(x)",
            "float gonioBrdfPI = 3.0",
            "struct gonioBrdfLobe",
            "return v.r",
            "lobe.r = gonioBrdfr(L)",
        ] {
            assert!(embedded.contains(expected), "{expected} in {embedded}");
        }
        assert!(embedded.contains("float(2)") || embedded.contains("2.0"), "{embedded}");
    }

    #[test]
    fn a_variable_may_have_the_name_of_a_built_in_function() {
        let text = "const float sin = 0.5;\n\
                    vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return vec3(sin * sin (L.x)); }\n";
        let embedded = embed(text).unwrap();
        // The translation to GLSL ES gives it another name.
        assert!(embedded.contains("sin_ * sin (L.x)"), "{embedded}");
    }

    #[test]
    fn errors_have_the_line_of_the_text() {
        let error =
            embed("vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)\n{\n    return vec3(missing);\n}\n").unwrap_err();
        assert_eq!((error.line, error.column), (3, 17), "{error}");
    }
}
