//! Determines the role of each variable that a shader declares.
//!
//! A name is split into words (`words`), the words and the type give a role (`rules`), and the other variables decide
//! what they leave open (`context`). `names.toml` takes precedence.

mod context;
mod file;
mod fixed_function;
mod lights;
mod parts;
mod role;
mod rules;
mod words;

#[cfg(test)]
mod tests;

pub(crate) use parts::{VectorReads, last_of};

pub use file::{Meaning, NamesError, NamesFile};
pub use role::{Role, UnknownRole};

use gonio_language::tr;
use std::fmt;

/// Whether a variable is an attribute or a uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableKind {
    /// An attribute of vertices.
    Attribute,
    /// A uniform that the program sets.
    Uniform,
}

/// A variable as OpenGL lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declared {
    /// Its name in OpenGL: `light.light_pos`, `lights[1].position`, `u_light_pos`, `colors[0]`.
    pub name: String,
    /// Its type: `vec3`, `mat4`, `samplerCube`.
    pub glsl_type: String,
    /// Number of elements, 1 if it is not an array. The elements of an array with the role of a light belong to
    /// consecutive lights.
    pub array: u32,
    /// Attribute or uniform.
    pub kind: VariableKind,
}

impl Declared {
    /// Whether it is the same variable in another version of the program: members of blocks are uniforms of their own where
    /// there are no blocks, `Light_position` for `Light.position`.
    fn is_same(&self, other: &Declared) -> bool {
        let letters = |name: &str| name.replace('.', "_");
        self.kind == other.kind
            && self.glsl_type == other.glsl_type
            && self.array == other.array
            && (self.name == other.name || letters(&self.name) == letters(&other.name))
    }

    /// Creates a uniform that is not an array.
    #[must_use]
    pub fn uniform(name: impl Into<String>, glsl_type: impl Into<String>) -> Self {
        Self { name: name.into(), glsl_type: glsl_type.into(), array: 1, kind: VariableKind::Uniform }
    }

    /// Creates an attribute.
    #[must_use]
    pub fn attribute(name: impl Into<String>, glsl_type: impl Into<String>) -> Self {
        Self { kind: VariableKind::Attribute, ..Self::uniform(name, glsl_type) }
    }
}

/// The evidence for a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum How {
    /// Its name.
    Name,
    /// Its type: no other variable of that type is left.
    Type,
    /// Its name and the variables beside it.
    Use,
    /// `names.toml`.
    NamesFile,
}

impl fmt::Display for How {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Name => tr!("check-inputs-by-its-name"),
            Self::Type => tr!("check-inputs-by-its-type"),
            Self::Use => tr!("check-inputs-by-its-name-and-its-neighbours"),
            Self::NamesFile => tr!("check-inputs-by-names-toml"),
        })
    }
}

/// A variable and its role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// The variable.
    pub declared: Declared,
    /// The role.
    pub role: Role,
    /// The evidence for the role.
    pub how: How,
}

/// A variable that `names.toml` gives a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixed {
    /// The variable.
    pub declared: Declared,
    /// Its numbers, columns first for a matrix.
    pub values: Vec<f32>,
}

/// The roles of a pair of shaders' variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bindings {
    /// Variables with a role, in the given order.
    pub bound: Vec<Bound>,
    /// Variables with a value from `names.toml`.
    pub fixed: Vec<Fixed>,
    /// Variables without a role.
    pub unknown: Vec<Declared>,
    /// Names in `names.toml` that are not names of variables.
    pub unused: Vec<String>,
}

impl Bindings {
    /// Returns the variable with a role.
    #[must_use]
    pub fn variable(&self, role: Role) -> Option<&Declared> {
        self.bound.iter().find(|bound| bound.role == role).map(|bound| &bound.declared)
    }

    /// Takes over the roles that the same variables have in another version of the program.
    pub fn adopt(&mut self, known: &Bindings) {
        for bound in &known.bound {
            if let Some(own) = self.bound.iter_mut().find(|own| own.declared.is_same(&bound.declared)) {
                own.role = bound.role;
            } else if let Some(at) = self.unknown.iter().position(|unknown| unknown.is_same(&bound.declared)) {
                let declared = self.unknown.remove(at);
                self.bound.push(Bound { declared, ..*bound });
            }
        }
        let vectors = known.bound.iter().map(|bound| &bound.declared).chain(&known.unknown);
        for (vector, last) in vectors.filter_map(|vector| Some((vector, known.last_of(vector)?))) {
            let all = self.bound.iter().map(|bound| &bound.declared).chain(&self.unknown);
            let own = all.into_iter().find(|own| own.is_same(vector)).cloned();
            if let Some(own) = own.filter(|own| self.last_of(own).is_none()) {
                self.bound.push(Bound { declared: last_of(&own), ..*last });
            }
        }
    }
}

/// Whether a name has a word with this meaning: `vers_lumiere` is about `light`.
pub(crate) fn is_about(name: &str, meaning: &str) -> bool {
    words::Words::split(name).has(meaning)
}

/// Whether a name is that of a reflected or refracted direction.
pub(crate) fn is_of_reflection(name: &str) -> bool {
    let words = words::Words::split(name);
    ["reflect", "refraction"].iter().any(|word| words.has(word)) || matches!(words.letters.as_slice(), ['r' | 'R'])
}

/// Determines the role of each variable. Of OpenGL's own variables (`gl_...`), those of the old pipeline have the roles
/// that the specification gives them; the others are ignored.
#[must_use]
pub fn bind(declared: &[Declared], file: &NamesFile) -> Bindings {
    let mut bindings = Bindings { unused: file.names.keys().cloned().collect(), ..Bindings::default() };
    let is_own =
        |declared: &&Declared| !declared.name.starts_with("gl_") || fixed_function::meaning(&declared.name).is_some();
    let own: Vec<&Declared> = declared.iter().filter(is_own).collect();
    let by_use = |name: &str| file.by_use.get(name).map(|role| Meaning::Role(*role));
    let known = |name: &str| file.get(name).cloned().or_else(|| fixed_function::meaning(name));
    let meanings: Vec<Option<Meaning>> =
        own.iter().map(|declared| known(&declared.name).or_else(|| by_use(&declared.name))).collect();
    let roles: Vec<Option<Role>> = meanings
        .iter()
        .map(|meaning| match meaning {
            Some(Meaning::Role(role)) => Some(*role),
            _ => None,
        })
        .collect();
    // A variable with a fixed value does not influence the others.
    let is_open: Vec<bool> = meanings.iter().map(Option::is_none).collect();
    let found = context::roles(&own, &roles, &is_open);
    for ((declared, meaning), found) in own.into_iter().zip(meanings).zip(found) {
        let declared = declared.clone();
        if meaning.is_some() {
            bindings.unused.retain(|name| *name != declared.name && declared.name.strip_suffix("[0]") != Some(name));
        }
        match (meaning, found) {
            (Some(Meaning::Value(values)), _) => bindings.fixed.push(Fixed { declared, values }),
            (Some(Meaning::Role(role)), _) => {
                let how = match (file.get(&declared.name), fixed_function::meaning(&declared.name)) {
                    (Some(_), _) => How::NamesFile,
                    (None, Some(_)) => How::Name,
                    (None, None) => How::Use,
                };
                bindings.bound.push(Bound { declared, role, how });
            }
            (None, Some((role, how))) => bindings.bound.push(Bound { declared, role, how }),
            (None, None) => bindings.unknown.push(declared),
        }
    }
    bindings
}
