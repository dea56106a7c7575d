//! The texts of a pair, and the variables that they declare.

use super::stand_in;
use super::user_inputs::{PairInterface, UserInputs};
use super::{UserShaders, uniforms};
use crate::compile::{self, ParsedStage};
use crate::roles::{Declared, VariableKind};
use crate::submission::StageText;
use crate::verdict::CompilerMessage;
use gonio_glsl::{Interface, Stage, Storage, Type};

/// The texts of both stages: gonio's own for one that the user left out.
#[derive(Clone, Debug)]
pub struct PairTexts {
    /// The vertex shader.
    pub vertex: StageText,
    /// The fragment shader.
    pub fragment: StageText,
    warnings: Vec<String>,
    /// Names of `names.toml` that the stand-in used.
    names_used: Vec<String>,
}

impl UserShaders {
    pub(super) fn texts(&self) -> PairTexts {
        let interface = |text: &StageText, stage| {
            let mut parsed = gonio_glsl::parse(&text.text);
            gonio_glsl::check(&mut parsed, stage).interface
        };
        let mut warnings = self.warnings.clone();
        let mut names_used = Vec::new();
        let vertex = self.vertex.clone().unwrap_or_else(|| {
            let fragment = self.fragment.as_ref().map(|text| (text, interface(text, Stage::Fragment)));
            let fragment = fragment.as_ref().map(|(text, interface)| (*text, interface));
            let inputs = fragment.iter().flat_map(|(_, interface)| varyings(interface));
            names_used.extend(inputs.filter(|name| self.names.file.get(name).is_some()));
            stand_in::vertex(fragment, &self.names.file, &mut warnings)
        });
        let fragment = self.fragment.clone().unwrap_or_else(|| {
            let vertex = self.vertex.as_ref().map(|text| interface(text, Stage::Vertex));
            stand_in::fragment(vertex.as_ref())
        });
        PairTexts { vertex, fragment, warnings, names_used }
    }

    /// The inputs of a pair with these active variables.
    pub(super) fn inputs(
        &self,
        texts: &PairTexts,
        stages: [&ParsedStage<'_>; 2],
        declared: Vec<Declared>,
    ) -> Result<UserInputs, Vec<CompilerMessage>> {
        let mut warnings = texts.warnings.clone();
        warnings.extend(compile::strictness(stages[0], stages[1]));
        UserInputs::new(PairInterface {
            declared,
            all_names: every_declared(stages).into_iter().map(|(declared, _)| declared.name).collect(),
            initial: stages.into_iter().flat_map(uniforms::initial_values).collect(),
            names: &self.names,
            names_used: texts.names_used.clone(),
            warnings,
        })
    }
}

/// The names of the inputs of a fragment shader.
fn varyings(interface: &Interface) -> Vec<String> {
    let members = interface.blocks.iter().filter(|block| block.storage == Storage::In).flat_map(|b| &b.members);
    interface.inputs.iter().chain(members).map(|input| input.name.clone()).collect()
}

/// The variables that a pair uses, without a driver: attributes in the order of their declarations, then uniforms by name.
pub(super) fn active(stages: [&ParsedStage<'_>; 2]) -> Vec<Declared> {
    let used = every_declared(stages).into_iter().filter(|(_, is_used)| *is_used);
    let mut all: Vec<Declared> = used.map(|(declared, _)| declared).collect();
    all.sort_by(|a, b| match (a.kind, b.kind) {
        (VariableKind::Uniform, VariableKind::Uniform) => a.name.cmp(&b.name),
        (a, b) => (a == VariableKind::Uniform).cmp(&(b == VariableKind::Uniform)),
    });
    all
}

/// Every variable that a pair declares, each with whether it is used. They are those of the translated texts, which have no
/// uniform blocks and no variables of old OpenGL.
fn every_declared(stages: [&ParsedStage<'_>; 2]) -> Vec<(Declared, bool)> {
    let members = BlockMembers::new(stages);
    let mut all: Vec<(Declared, bool)> = Vec::new();
    for (stage, of) in stages.into_iter().zip([Stage::Vertex, Stage::Fragment]) {
        let mut parsed = gonio_glsl::parse(&stage.translated.text);
        let interface = gonio_glsl::check(&mut parsed, of).interface;
        let attributes = interface.inputs.iter().filter(|_| of == Stage::Vertex).filter_map(|input| {
            let (ty, array) = match input.ty.as_ref()? {
                Type::Array(of, count) => (&**of, count.unwrap_or(1)),
                ty => (ty, 1),
            };
            Some((Declared { array, ..Declared::attribute(&input.name, ty.written()) }, input.is_used))
        });
        let uniforms = gonio_glsl::leaves(&interface).into_iter().filter_map(|leaf| {
            let is_used = interface.uniforms.get(leaf.uniform)?.is_used;
            let declared = Declared::uniform(members.name_of(&leaf.name), leaf.ty.written());
            Some((Declared { array: leaf.count, ..declared }, is_used))
        });
        let found: Vec<_> = attributes.chain(uniforms).collect();
        for (declared, is_used) in found.into_iter().filter(|(d, _)| d.name != gonio_glsl::DRAWN_ALL_THE_SAME) {
            match all.iter_mut().find(|(known, _)| known.name == declared.name && known.kind == declared.kind) {
                Some((_, known)) => *known |= is_used,
                None => all.push((declared, is_used)),
            }
        }
    }
    all
}

/// The members of uniform blocks with an instance name, which are plain uniforms in the text for the driver.
pub(super) struct BlockMembers(Vec<(String, String)>);

impl BlockMembers {
    pub(super) fn new(stages: [&ParsedStage<'_>; 2]) -> Self {
        let mut all = Vec::new();
        for block in stages.into_iter().flat_map(|stage| &stage.checked.interface.blocks) {
            if block.storage == Storage::Uniform && block.instance.is_some() {
                let names = |member: &str| (format!("{}_{member}", block.name), format!("{}.{member}", block.name));
                all.extend(block.members.iter().map(|member| names(&member.name)));
            }
        }
        BlockMembers(all)
    }

    /// OpenGL's name of a uniform: `Camera.view` for `Camera_view`.
    pub(super) fn name_of(&self, name: &str) -> String {
        let base = name.find(['.', '[']).unwrap_or(name.len());
        let (base, rest) = name.split_at(base);
        let known = self.0.iter().find(|(translated, _)| translated == base);
        known.map_or_else(|| name.to_owned(), |(_, own)| format!("{own}{rest}"))
    }
}
