//! From what a shader declares to what it means.
//!
//! A name is cut into words (`words`), the words and the type give a role (`rules`), and the neighbours decide what
//! they leave open (`context`). What a `names.toml` says goes before everything.

mod context;
mod file;
mod role;
mod rules;
mod words;

#[cfg(test)]
mod tests;

pub use file::{Meaning, NamesError, NamesFile};
pub use role::{Role, UnknownRole};

use std::fmt;

/// Whether a variable is an attribute or a uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableKind {
    /// Per vertex.
    Attribute,
    /// From the program.
    Uniform,
}

/// A variable as OpenGL lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declared {
    /// OpenGL's name: `light.light_pos`, `lights[1].position`, `u_light_pos`, `colors[0]`.
    pub name: String,
    /// `vec3`, `mat4`, `samplerCube`.
    pub glsl_type: String,
    /// Elements of an array, 1 where it is none. A role with a light's index then means the lights from there on.
    pub array: u32,
    /// Attribute or uniform.
    pub kind: VariableKind,
}

impl Declared {
    /// A uniform that is no array.
    #[must_use]
    pub fn uniform(name: impl Into<String>, glsl_type: impl Into<String>) -> Self {
        Self { name: name.into(), glsl_type: glsl_type.into(), array: 1, kind: VariableKind::Uniform }
    }

    /// An attribute.
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
    /// Its type: nothing else of that type is left.
    Type,
    /// Its name and those that it stands beside.
    Use,
    /// `names.toml`.
    NamesFile,
}

impl fmt::Display for How {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Name => "by its name",
            Self::Type => "by its type",
            Self::Use => "by its name and its neighbours",
            Self::NamesFile => "by names.toml",
        })
    }
}

/// A variable and its role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// The variable.
    pub declared: Declared,
    /// The explanation.
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
    /// Those with a role, in the given order.
    pub bound: Vec<Bound>,
    /// Those with a value of the student's own.
    pub fixed: Vec<Fixed>,
    /// Those that nothing is known of.
    pub unknown: Vec<Declared>,
    /// Names in `names.toml` that no variable has.
    pub unused: Vec<String>,
}

impl Bindings {
    /// The variable of a role.
    #[must_use]
    pub fn variable(&self, role: Role) -> Option<&Declared> {
        self.bound.iter().find(|bound| bound.role == role).map(|bound| &bound.declared)
    }
}

/// Gives each variable its role. OpenGL's own variables (`gl_...`) are left out.
#[must_use]
pub fn bind(declared: &[Declared], file: &NamesFile) -> Bindings {
    let mut bindings = Bindings { unused: file.names.keys().cloned().collect(), ..Bindings::default() };
    let own: Vec<&Declared> = declared.iter().filter(|declared| !declared.name.starts_with("gl_")).collect();
    let told: Vec<Option<&Meaning>> = own.iter().map(|declared| file.get(&declared.name)).collect();
    let given: Vec<Option<Role>> = told
        .iter()
        .map(|meaning| match meaning {
            Some(Meaning::Role(role)) => Some(*role),
            _ => None,
        })
        .collect();
    // A variable with a value of its own is no neighbour.
    let is_open: Vec<bool> = told.iter().map(Option::is_none).collect();
    let found = context::roles(&own, &given, &is_open);
    for ((declared, told), found) in own.into_iter().zip(told).zip(found) {
        let declared = declared.clone();
        if told.is_some() {
            bindings.unused.retain(|name| *name != declared.name && declared.name.strip_suffix("[0]") != Some(name));
        }
        match (told, found) {
            (Some(Meaning::Value(values)), _) => bindings.fixed.push(Fixed { declared, values: values.clone() }),
            (Some(Meaning::Role(role)), _) => bindings.bound.push(Bound { declared, role: *role, how: How::NamesFile }),
            (None, Some((role, how))) => bindings.bound.push(Bound { declared, role, how }),
            (None, None) => bindings.unknown.push(declared),
        }
    }
    bindings
}
