//! The interface of a shader: inputs, outputs and uniforms, under the names that OpenGL uses; and whether the interfaces
//! of two stages fit together.

use super::scope::storage_of;
use super::{Checked, Checker, Storage};
use crate::ast::{Declarator, Item, Qualifier, Unit, has};
use crate::{Problem, Span, Type};
use std::collections::HashMap;
use std::sync::LazyLock;

/// The variables that are visible to other stages and the program.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Interface {
    /// The attributes of a vertex shader, or the inputs of a fragment shader from the vertex shader.
    pub inputs: Vec<Variable>,
    /// The outputs to the fragment shader, or the colours of a fragment shader.
    pub outputs: Vec<Variable>,
    /// The uniforms outside of blocks.
    pub uniforms: Vec<Variable>,
    /// Structs in source order.
    pub structs: Vec<StructInfo>,
    /// Blocks of uniforms, inputs or outputs.
    pub blocks: Vec<Block>,
}

/// A variable of the interface.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type including array sizes; `None` if unknown.
    pub ty: Option<Type>,
    /// The position of its name.
    pub span: Span,
    /// `highp`, `mediump` or `lowp`.
    pub precision: Option<String>,
    /// `flat`, `smooth` or `noperspective`.
    pub interpolation: Option<String>,
    /// `layout(location = ..)`
    pub location: Option<i32>,
    /// `layout(binding = ..)`
    pub binding: Option<i32>,
    /// Whether the shader reads it, or writes it if it is an output.
    pub is_used: bool,
    /// Whether it has an initializer.
    pub initial: bool,
}

/// A struct.
#[derive(Debug, Clone, PartialEq)]
pub struct StructInfo {
    /// Its name.
    pub name: String,
    /// Its members with their types, `None` if unknown.
    pub members: Vec<(String, Option<Type>)>,
    /// The position of its name.
    pub span: Span,
}

/// Returns the structs of old OpenGL, such as the type of `gl_LightSource` (GLSL 1.20, section 7.5).
#[must_use]
pub fn builtin_structs() -> &'static [StructInfo] {
    static STRUCTS: LazyLock<Vec<StructInfo>> = LazyLock::new(|| {
        let info = |line: &str| {
            let (name, members) = line.split_once(": ")?;
            let member = |text: &str| {
                let (ty, name) = text.split_once(' ')?;
                Some((name.to_string(), Type::named(ty)))
            };
            let members = members.split(", ").filter_map(member).collect();
            Some(StructInfo { name: name.into(), members, span: Span::default() })
        };
        STRUCT_TABLE.lines().filter_map(info).collect()
    });
    &STRUCTS
}

const STRUCT_TABLE: &str = "\
gl_DepthRangeParameters: float near, float far, float diff
gl_PointParameters: float size, float sizeMin, float sizeMax, float fadeThresholdSize, float distanceConstantAttenuation, \
float distanceLinearAttenuation, float distanceQuadraticAttenuation
gl_MaterialParameters: vec4 emission, vec4 ambient, vec4 diffuse, vec4 specular, float shininess
gl_LightSourceParameters: vec4 ambient, vec4 diffuse, vec4 specular, vec4 position, vec4 halfVector, vec3 spotDirection, \
float spotExponent, float spotCutoff, float spotCosCutoff, float constantAttenuation, float linearAttenuation, \
float quadraticAttenuation
gl_LightModelParameters: vec4 ambient
gl_LightModelProducts: vec4 sceneColor
gl_LightProducts: vec4 ambient, vec4 diffuse, vec4 specular
gl_FogParameters: vec4 color, float density, float start, float end, float scale
";

/// A block.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The name of the block.
    pub name: String,
    /// The instance name.
    pub instance: Option<String>,
    /// Whether it contains uniforms, inputs or outputs.
    pub storage: Storage,
    /// Its members.
    pub members: Vec<Variable>,
    /// The position of its name.
    pub span: Span,
}

/// A value that OpenGL identifies by a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Leaf {
    /// For example `light.light_pos`, `lights[0].position`, `colours`: an array of basic values has one name.
    pub name: String,
    /// The basic type, without the array.
    pub ty: Type,
    /// The array size: 1 if it is not an array.
    pub count: u32,
    /// Index in [`Interface::uniforms`].
    pub uniform: usize,
}

/// No shader has more uniforms; larger arrays are truncated.
const MOST_LEAVES: usize = 4096;
/// Limits the search in nested structs that contain no leaf.
const MOST_LOOKS: usize = 8 * MOST_LEAVES;
/// Most levels of nested structs.
const MOST_NESTED: usize = 32;

/// Returns the uniforms, split into the names of `glGetUniformLocation` (OpenGL 4.6, section 7.3.1).
#[must_use]
pub fn leaves(interface: &Interface) -> Vec<Leaf> {
    let structs = interface.structs.iter().map(|s| (&*s.name, s)).collect();
    let mut taken = Leaves { structs, found: Vec::new(), looks: 0 };
    for (index, uniform) in interface.uniforms.iter().enumerate() {
        if let Some(ty) = &uniform.ty {
            taken.apart(&uniform.name, ty, index, 0);
        }
    }
    taken.found
}

struct Leaves<'a> {
    structs: HashMap<&'a str, &'a StructInfo>,
    found: Vec<Leaf>,
    looks: usize,
}

impl Leaves<'_> {
    fn is_full(&self) -> bool {
        self.found.len() >= MOST_LEAVES || self.looks >= MOST_LOOKS
    }

    fn apart(&mut self, name: &str, ty: &Type, uniform: usize, nested: usize) {
        self.looks += 1;
        if self.is_full() || nested > MOST_NESTED {
            return;
        }
        match ty {
            Type::Struct(of) => {
                let members = self.structs.get(&**of).map_or(&[][..], |s| &s.members);
                for (member, ty) in members {
                    if let Some(ty) = ty {
                        self.apart(&format!("{name}.{member}"), ty, uniform, nested + 1);
                    }
                }
            }
            Type::Array(of, count) if matches!(**of, Type::Struct(_) | Type::Array(..)) => {
                for index in 0..count.unwrap_or(1) {
                    if self.is_full() {
                        return;
                    }
                    self.apart(&format!("{name}[{index}]"), of, uniform, nested + 1);
                }
            }
            Type::Array(of, count) => {
                let count = count.unwrap_or(1);
                self.found.push(Leaf { name: name.into(), ty: (**of).clone(), count, uniform });
            }
            _ => self.found.push(Leaf { name: name.into(), ty: ty.clone(), count: 1, uniform }),
        }
    }
}

/// Collects the interface from the tree, once all names are resolved.
pub(super) fn collect(checker: &Checker<'_>, unit: &Unit) -> Interface {
    let mut interface = Interface::default();
    let symbols: HashMap<u32, usize> =
        checker.symbols.iter().enumerate().map(|(id, s)| (s.declared.first, id)).collect();
    for name in &checker.struct_order {
        interface.structs.extend(checker.structs.get(name).cloned());
    }
    for item in &unit.items {
        match item {
            Item::Declaration(declaration) => {
                for declarator in &declaration.declarators {
                    let variable = variable(checker, &symbols, &declaration.qualifiers, declarator);
                    match storage_of(&declaration.qualifiers, checker.stage) {
                        _ if variable.name.starts_with("gl_") => {}
                        Storage::In => interface.inputs.push(variable),
                        Storage::Out => interface.outputs.push(variable),
                        Storage::Uniform => interface.uniforms.push(variable),
                        _ => {}
                    }
                }
            }
            Item::Block(block) => {
                let info = checker.structs.get(&format!("{} (block)", block.name));
                let used = block.instance.as_ref().and_then(|i| symbols.get(&i.tokens.first));
                let used = used.is_some_and(|id| !checker.symbols[*id].uses.is_empty());
                let mut members = Vec::new();
                for declaration in &block.members {
                    for declarator in &declaration.declarators {
                        let mut found = variable(checker, &symbols, &declaration.qualifiers, declarator);
                        if let Some((_, ty)) = info.and_then(|i| i.members.iter().find(|m| m.0 == found.name)) {
                            found.ty.clone_from(ty);
                            found.is_used = used;
                        }
                        members.push(found);
                    }
                }
                interface.blocks.push(Block {
                    name: block.name.clone(),
                    instance: block.instance.as_ref().map(|i| i.name.clone()),
                    storage: storage_of(&block.qualifiers, checker.stage),
                    members,
                    span: block.name_span,
                });
            }
            _ => {}
        }
    }
    interface
}

fn variable(
    checker: &Checker<'_>,
    symbols: &HashMap<u32, usize>,
    qualifiers: &[Qualifier],
    declarator: &Declarator,
) -> Variable {
    let word = |words: &[&str]| words.iter().find(|w| has(qualifiers, w)).map(|w| (*w).to_string());
    let symbol = symbols.get(&declarator.tokens.first).map(|id| &checker.symbols[*id]);
    Variable {
        name: declarator.name.clone(),
        ty: symbol.and_then(|s| s.ty.clone()),
        span: declarator.span,
        precision: word(&["highp", "mediump", "lowp"]),
        interpolation: word(&["flat", "smooth", "noperspective"]),
        location: layout(qualifiers, "location"),
        binding: layout(qualifiers, "binding"),
        is_used: symbol.is_some_and(|s| s.is_read || s.is_written),
        initial: declarator.initialiser.is_some(),
    }
}

fn layout(qualifiers: &[Qualifier], name: &str) -> Option<i32> {
    let entry = qualifiers.iter().flat_map(|q| &q.layout).find(|e| e.name == name)?;
    let value = crate::constant::evaluate(entry.value.as_ref()?, &|_| None)?;
    value.first().map(|v| *v as i32)
}

/// Returns problems between the two stages, with positions in the fragment shader unless the message says otherwise.
#[must_use]
pub fn check_pair(vertex: &Checked, fragment: &Checked) -> Vec<Problem> {
    let mut problems = Vec::new();
    let outputs = &vertex.interface.outputs;
    let by_name: HashMap<&str, &Variable> = outputs.iter().map(|o| (&*o.name, o)).collect();
    for input in &fragment.interface.inputs {
        let name = &input.name;
        match by_name.get(&**name) {
            None if input.location.is_some() && outputs.iter().any(|o| o.location == input.location) => {}
            None => {
                let message = format!("the input `{name}` is not an output of the vertex shader");
                let near = crate::nearest::nearest(name, outputs.iter().map(|o| &*o.name));
                let mut problem = Problem::error(input.span, "not-given", message);
                if let Some(near) = near {
                    problem = problem.with_help(format!("the vertex shader has the output `{near}`"));
                }
                // A linker may omit an unused input.
                if !input.is_used {
                    problem.severity = crate::Severity::Strict;
                }
                problems.push(problem);
            }
            Some(output) => compare(&mut problems, output, input),
        }
    }
    blocks(&mut problems, vertex, fragment);
    uniforms(&mut problems, vertex, fragment);
    problems
}

fn written(ty: Option<&Type>) -> String {
    ty.map_or_else(|| "?".into(), Type::written)
}

fn compare(problems: &mut Vec<Problem>, output: &Variable, input: &Variable) {
    let name = &input.name;
    if let (Some(a), Some(b)) = (&output.ty, &input.ty)
        && a != b
    {
        let message =
            format!("`{name}` is of type `{b}` here and of type `{a}` in the vertex shader, line {}", output.span.line);
        problems.push(Problem::error(input.span, "other-type", message));
        return;
    }
    if !output.is_used && input.is_used {
        let message = format!("the vertex shader, line {}, never assigns a value to `{name}`", output.span.line);
        problems.push(Problem::strict(input.span, "never-given", message));
    }
    let way = |v: &Variable| v.interpolation.clone().unwrap_or_else(|| "smooth".into());
    if way(output) != way(input) {
        let message = format!("`{name}` is `{}` here and `{}` in the vertex shader", way(input), way(output));
        problems.push(Problem::strict(input.span, "other-interpolation", message));
    }
    if output.location != input.location {
        let message = format!("`{name}` has another `location` in the vertex shader");
        problems.push(Problem::strict(input.span, "other-location", message));
    }
}

fn blocks(problems: &mut Vec<Problem>, vertex: &Checked, fragment: &Checked) {
    for block in fragment.interface.blocks.iter().filter(|b| b.storage == Storage::In) {
        let other = vertex.interface.blocks.iter().find(|b| b.storage == Storage::Out && b.name == block.name);
        let Some(other) = other else {
            let message = format!("the input block `{}` is not an output of the vertex shader", block.name);
            problems.push(Problem::error(block.span, "not-given", message));
            continue;
        };
        let members = |b: &Block| b.members.iter().map(|m| (m.name.clone(), m.ty.clone())).collect::<Vec<_>>();
        if members(block) != members(other) {
            let message = format!("the block `{}` is declared differently in the vertex shader", block.name);
            problems.push(Problem::error(block.span, "other-type", message));
        }
    }
}

fn uniforms(problems: &mut Vec<Problem>, vertex: &Checked, fragment: &Checked) {
    let by_name: HashMap<&str, &Variable> = vertex.interface.uniforms.iter().map(|u| (&*u.name, u)).collect();
    for uniform in &fragment.interface.uniforms {
        let Some(other) = by_name.get(&*uniform.name) else { continue };
        if let (Some(a), Some(b)) = (&other.ty, &uniform.ty)
            && a != b
        {
            let (a, b) = (written(Some(a)), written(Some(b)));
            let message =
                format!("the uniform `{}` is of type `{b}` here and of type `{a}` in the vertex shader", uniform.name);
            problems.push(Problem::error(uniform.span, "other-type", message));
        }
    }
}
