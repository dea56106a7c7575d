//! The `.brdf` files of Disney's BRDF Explorer: parameters with ranges, and a GLSL function.
//!
//! ```text
//! analytic
//! # a comment
//! ::begin parameters
//! float NAME MIN MAX DEFAULT
//! bool NAME 0|1
//! color NAME RED GREEN BLUE
//! ::end parameters
//! ::begin shader
//! vec3 BRDF( vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y ) { ... }
//! ::end shader
//! ```
//!
//! As in BRDF Explorer, a line that begins with `#` is a comment everywhere, also within the shader, and sections of other
//! names are skipped.

use crate::glsl::{GlslBrdf, GlslBrdfError, glsl_type};
use crate::parameter::{Parameter, ParameterKind, ParameterValues};
use std::borrow::Cow;
use std::fmt::Write as _;

/// The longest file.
pub const MOST_BYTES: usize = 1 << 20;
/// The largest number of parameters.
pub const MOST_PARAMETERS: usize = 256;
/// The longest name.
const MOST_NAME_BYTES: usize = 64;

/// A `.brdf` file.
#[derive(Clone, Debug, PartialEq)]
pub struct BrdfFile {
    /// The parameters in the file's order.
    pub parameters: Vec<Parameter>,
    /// The text of the shader; comments are empty lines.
    pub shader: String,
    /// The line on which the shader begins, from 1.
    pub shader_line: u32,
}

/// The section of a line.
#[derive(Clone, PartialEq)]
enum Section {
    Outside,
    Parameters,
    Shader,
    Other(String),
}

impl Section {
    fn of_name(name: &str) -> Self {
        match name {
            "parameters" => Self::Parameters,
            "shader" => Self::Shader,
            other => Self::Other(other.to_owned()),
        }
    }

    fn name(&self) -> &str {
        match self {
            Self::Outside => "",
            Self::Parameters => "parameters",
            Self::Shader => "shader",
            Self::Other(name) => name,
        }
    }
}

impl BrdfFile {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// A file that is too long or not of the type `analytic`, sections that do not match, an invalid parameter, or no
    /// shader; with line and column.
    pub fn parse(text: &str) -> Result<Self, GlslBrdfError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let at = |line: usize, column: usize, message: String| GlslBrdfError {
            line: line as u32 + 1,
            column: column as u32 + 1,
            message,
        };
        if text.len() > MOST_BYTES {
            return Err(at(0, 0, format!("the file has {} bytes: expected at most {MOST_BYTES}", text.len())));
        }
        let kind = text.lines().next().and_then(|line| line.split_whitespace().next()).unwrap_or_default();
        if kind != "analytic" {
            return Err(at(0, 0, format!("unknown type `{kind}`: expected a file that begins with `analytic`")));
        }
        let mut file = Self { parameters: Vec::new(), shader: String::new(), shader_line: 0 };
        let mut section = (Section::Outside, 0);
        for (number, line) in text.lines().enumerate().skip(1) {
            let words: Vec<&str> = line.split_whitespace().collect();
            let indentation = line.chars().take_while(|c| c.is_whitespace()).count();
            let is_comment = words.first().is_some_and(|word| word.starts_with('#'));
            match words.as_slice() {
                _ if is_comment => {}
                ["::begin", name, ..] if section.0 == Section::Outside => {
                    section = (Section::of_name(name), number);
                    if section.0 == Section::Shader {
                        (file.shader, file.shader_line) = (String::new(), number as u32 + 2);
                    }
                    continue;
                }
                ["::begin", ..] => {
                    let message = format!("`::begin` within the section `{}`: end that one first", section.0.name());
                    return Err(at(number, indentation, message));
                }
                ["::end", name, ..] if *name == section.0.name() => {
                    section = (Section::Outside, number);
                    continue;
                }
                ["::end", ..] => {
                    let message = match &section.0 {
                        Section::Outside => "`::end` without a section".to_owned(),
                        section => format!("expected `::end {}`", section.name()),
                    };
                    return Err(at(number, indentation, message));
                }
                [] => {}
                words => {
                    if section.0 == Section::Parameters {
                        let parameter = parameter(words)
                            .map_err(|(word, message)| at(number, column_of_word(line, word), message))?;
                        if file.parameters.iter().any(|known| known.name == parameter.name) {
                            let message = format!("the parameter `{}` is declared twice", parameter.name);
                            return Err(at(number, indentation, message));
                        }
                        if file.parameters.len() >= MOST_PARAMETERS {
                            return Err(at(number, indentation, format!("more than {MOST_PARAMETERS} parameters")));
                        }
                        file.parameters.push(parameter);
                    }
                }
            }
            if section.0 == Section::Shader {
                file.shader += if is_comment { "" } else { line };
                file.shader.push('\n');
            }
        }
        if section.0 != Section::Outside {
            return Err(at(section.1, 0, format!("the section `{}` does not end", section.0.name())));
        }
        if file.shader_line == 0 {
            return Err(at(0, 0, "the file has no section `shader`".to_owned()));
        }
        Ok(file)
    }

    /// The parameters with their defaults.
    pub fn defaults(&self) -> ParameterValues {
        ParameterValues::defaults(Cow::Owned(self.parameters.clone()))
    }

    /// Compiles the function.
    ///
    /// # Errors
    ///
    /// As [`GlslBrdf::new`], with the lines of the file.
    pub fn compile(&self, values: ParameterValues) -> Result<GlslBrdf, GlslBrdfError> {
        GlslBrdf::new(&self.shader, self.shader_line, values)
    }
}

/// The column of a word of a line, from 0.
fn column_of_word(line: &str, word: usize) -> usize {
    let mut starts = Vec::new();
    let mut before = ' ';
    for (column, c) in line.chars().enumerate() {
        if before.is_whitespace() && !c.is_whitespace() {
            starts.push(column);
        }
        before = c;
    }
    starts.get(word).copied().unwrap_or(line.chars().count())
}

/// Reads the words of a parameter; an error has the number of the word.
fn parameter(words: &[&str]) -> Result<Parameter, (usize, String)> {
    let kind = words[0];
    if !matches!(kind, "float" | "bool" | "color") {
        return Err((0, format!("unknown type `{kind}` of a parameter: expected float, bool or color")));
    }
    let name = *words.get(1).ok_or((1, "the parameter has no name".to_owned()))?;
    let is_name = name.len() <= MOST_NAME_BYTES
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && !name.starts_with(|c: char| c.is_ascii_digit())
        && !name.starts_with("gl_")
        && !name.starts_with("gonio_");
    if !is_name {
        return Err((1, format!("invalid name `{name}`: expected letters, digits and `_`, as for a variable of GLSL")));
    }
    let number = |word: usize, what: &str| match words.get(word) {
        None => Err((word, format!("the parameter `{name}` has no {what}"))),
        Some(text) => match text.parse::<f64>() {
            Ok(value) if value.is_finite() && value.abs() < 1e30 => Ok(value),
            _ => Err((word, format!("invalid {what} `{text}`: expected a number"))),
        },
    };
    let kind = match kind {
        "float" => {
            let (min, max, default) = (number(2, "minimum")?, number(3, "maximum")?, number(4, "default")?);
            if min > max {
                return Err((2, format!("the minimum {min} is larger than the maximum {max}")));
            }
            // Sliders of BRDF Explorer hold the value in the range too.
            ParameterKind::Number { min, max, default: default.clamp(min, max) }
        }
        "bool" => ParameterKind::Switch { default: words.len() > 2 && number(2, "default")? != 0.0 },
        _ => {
            let channel = |word: usize, what: &str| number(word, what).map(|value| value.clamp(0.0, 1.0));
            ParameterKind::Color { default: [channel(2, "red")?, channel(3, "green")?, channel(4, "blue")?] }
        }
    };
    Ok(Parameter { name: Cow::Owned(name.to_owned()), unit: Cow::Borrowed(""), description: Cow::Borrowed(""), kind })
}

/// Writes a `.brdf` file. Values become the defaults.
pub fn write(title: &str, shader: &str, values: &ParameterValues) -> String {
    let mut text = format!("analytic\n\n# {title}\n\n::begin parameters\n");
    for (parameter, value) in values.iter() {
        // Writing to a String does not fail.
        let _ = match parameter.kind {
            ParameterKind::Number { min, max, .. } => {
                writeln!(text, "float {} {min} {max} {}", parameter.name, value.x)
            }
            ParameterKind::Color { .. } => {
                writeln!(text, "color {} {} {} {}", parameter.name, value.x, value.y, value.z)
            }
            ParameterKind::Switch { .. } => {
                writeln!(text, "bool {} {}", parameter.name, u8::from(value.x != 0.0))
            }
        };
    }
    text + "::end parameters\n\n::begin shader\n\n" + shader.trim_matches('\n') + "\n\n::end shader\n"
}

/// Writes a GLSL function for a shader of one's own: the parameters become constants.
pub fn write_glsl(title: &str, shader: &str, values: &ParameterValues) -> String {
    let mut text = format!(
        "// {title}\n// f(L, V) in 1/sr; L points to the light, V to the viewer, N is the normal, X and Y are the tangents.\n\n"
    );
    for (parameter, value) in values.iter() {
        let float = |x: f64| format!("{x:?}");
        let constant = match parameter.kind {
            ParameterKind::Number { .. } => float(value.x),
            ParameterKind::Color { .. } => format!("vec3({}, {}, {})", float(value.x), float(value.y), float(value.z)),
            ParameterKind::Switch { .. } => (value.x != 0.0).to_string(),
        };
        text += &format!("const {} {} = {constant};\n", glsl_type(parameter), parameter.name);
    }
    text + "\n" + shader.trim_matches('\n') + "\n"
}
