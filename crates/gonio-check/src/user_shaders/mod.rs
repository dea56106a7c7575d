//! Shaders of the user that draw any scene: read, compiled, and fed by the roles of their variables.
//!
//! Either stage may be missing: `stand_in` writes it. Nothing here judges a shader.

mod inputs;
mod names;
mod pair;
mod stand_in;
mod uniforms;
mod user_inputs;

pub use names::names_beside;
pub use pair::PairTexts;
pub use uniforms::{UniformSource, UserUniform, parse_setting};
pub use user_inputs::UserInputs;

use crate::comparison::declared;
use crate::compile::{self, ParsedStage};
use crate::submission::{SourceFile, StageText, read_shader};
use crate::verdict::CompilerMessage;
use gonio_gl::Gl;
use gonio_glsl::{Class, OutputVersion, Severity, Stage};
use gonio_language::tr;
use gonio_render::UserPass;
use gonio_render::user_program::{UserProgram, is_embedded};
use gonio_scene::{Frame, Scene};
use names::OwnNames;
use pair::BlockMembers;
use std::collections::HashMap;

/// One or two shaders of the user, read but not compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct UserShaders {
    vertex: Option<StageText>,
    fragment: Option<StageText>,
    names: OwnNames,
    /// Corrections of the files' encodings.
    warnings: Vec<String>,
}

/// A program that draws, with the values of its uniforms.
pub struct UserShaderProgram {
    program: UserProgram,
    /// The attributes, uniforms and samplers, and where each gets its value.
    pub inputs: UserInputs,
    /// The locations of attributes and the numbers of uniforms, by their names in `inputs`.
    places: HashMap<String, usize>,
}

/// A compiler's message with its place.
pub fn message_text(message: &CompilerMessage) -> String {
    let place = match (message.line, message.column) {
        (Some(line), Some(column)) => format!("{}:{line}:{column}", message.file),
        (Some(line), None) => format!("{}:{line}", message.file),
        _ => message.file.clone(),
    };
    let explained = message.explanation.as_ref().map_or(String::new(), |why| format!("; {why}"));
    format!("{place}: {}{explained}", message.text)
}

impl UserShaders {
    /// Reads one shader or both, and the `names.toml` files [beside them](names_beside).
    ///
    /// # Errors
    /// The reason why a file is not a shader, or what is wrong in a `names.toml`, in one sentence.
    pub fn read(
        vertex: Option<SourceFile>,
        fragment: Option<SourceFile>,
        names: &[SourceFile],
    ) -> Result<Self, String> {
        let mut warnings = Vec::new();
        let mut read = |file: Option<SourceFile>| {
            let Some(file) = file else { return Ok(None) };
            let (text, warning) = read_shader(&file).map_err(|error| error.to_string())?;
            warnings.extend(warning);
            Ok::<_, String>(Some(text))
        };
        let (vertex, fragment) = (read(vertex)?, read(fragment)?);
        if vertex.is_none() && fragment.is_none() {
            return Err(tr!("check-inputs-there-is-neither-a-vertex-nor").to_owned());
        }
        Ok(UserShaders { vertex, fragment, names: OwnNames::read(names)?, warnings })
    }

    /// gonio's own shader for a stage that is missing, if one is.
    pub fn stand_in(&self) -> Option<SourceFile> {
        let PairTexts { vertex, fragment, .. } = self.texts();
        let text = if self.vertex.is_none() { vertex } else { fragment };
        (self.vertex.is_none() || self.fragment.is_none()).then(|| SourceFile::new(text.file, text.text))
    }

    /// Whether a driver that compiles or draws them may take long: there are loops.
    pub fn has_loops(&self) -> bool {
        [&self.vertex, &self.fragment].into_iter().flatten().any(|stage| {
            gonio_glsl::classify(&stage.text).iter().any(|part| {
                let word = stage.text.get(part.start as usize..part.end as usize).unwrap_or_default();
                matches!(part.class, Class::Keyword | Class::Directive) && matches!(word, "for" | "while" | "do")
            })
        })
    }

    /// Compiles them, with a stand-in for a missing stage.
    ///
    /// # Errors
    /// Errors by file and line; never an empty list.
    pub fn compile(&self, gl: &Gl) -> Result<UserShaderProgram, Vec<CompilerMessage>> {
        let target = if is_embedded(gl) { OutputVersion::Es300 } else { OutputVersion::Core330 };
        let texts = self.texts();
        let vertex = ParsedStage::new(&texts.vertex, Stage::Vertex, target);
        let fragment = ParsedStage::new(&texts.fragment, Stage::Fragment, target);
        let program = compile::compile(gl, &vertex, &fragment).map_err(|broken| {
            let mut messages = compile::compiler_messages(&broken, &vertex, &fragment);
            if messages.is_empty() {
                let file = if self.fragment.is_some() { &texts.fragment.file } else { &texts.vertex.file };
                messages.push(CompilerMessage {
                    file: file.clone(),
                    line: None,
                    column: None,
                    text: broken.to_string(),
                    quoted: None,
                    explanation: None,
                });
            }
            messages
        })?;
        let not_given = compile::not_given(&vertex, &fragment);
        if !not_given.is_empty() {
            return Err(not_given);
        }
        let members = BlockMembers::new([&vertex, &fragment]);
        let mut active = declared(&program);
        let mut places = HashMap::new();
        for declared in &mut active {
            let name = members.name_of(&declared.name);
            let location = program.attribute_location(&declared.name).map(|location| location as usize);
            places.extend(location.or(program.uniform_index(&declared.name)).map(|place| (name.clone(), place)));
            declared.name = name;
        }
        let inputs = self.inputs(&texts, [&vertex, &fragment], active)?;
        Ok(UserShaderProgram { program, inputs, places })
    }

    /// The inputs of the pair without a driver, and the texts that an interpreter runs.
    ///
    /// # Errors
    /// Errors by file and line, those that every compiler reports; never an empty list.
    pub fn interpreted(&self) -> Result<(PairTexts, UserInputs), Vec<CompilerMessage>> {
        let texts = self.texts();
        let vertex = ParsedStage::new(&texts.vertex, Stage::Vertex, OutputVersion::Core330);
        let fragment = ParsedStage::new(&texts.fragment, Stage::Fragment, OutputVersion::Core330);
        let mut errors: Vec<CompilerMessage> = Vec::new();
        for stage in [&vertex, &fragment] {
            let of_stage = stage.problems().filter(|problem| problem.severity == Severity::Error);
            errors.extend(of_stage.take(MOST_ERRORS).map(|problem| stage.message(problem)));
        }
        if errors.is_empty() {
            let pair = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
            let of_pair = pair.iter().filter(|problem| problem.severity == Severity::Error);
            errors.extend(of_pair.take(MOST_ERRORS).map(|problem| fragment.message(problem)));
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        let active = pair::active([&vertex, &fragment]);
        let inputs = self.inputs(&texts, [&vertex, &fragment], active)?;
        Ok((texts, inputs))
    }
}

/// Most errors of one kind. Errors that follow from the first one do not help.
const MOST_ERRORS: usize = 12;

impl UserShaderProgram {
    /// Calls `draw` with the pass of a frame of this scene.
    pub fn with_pass<T>(&self, scene: &Scene, frame: &Frame, draw: impl FnOnce(&UserPass<'_>) -> T) -> T {
        let place = |name: &str| self.places.get(name).copied();
        let values = |world_from_model, material: &_| {
            let all = self.inputs.values(frame, world_from_model, material);
            all.filter_map(|(uniform, values)| Some((place(&uniform.name)?, values))).collect()
        };
        let attributes: Vec<_> =
            self.inputs.attributes().iter().filter_map(|(name, data)| Some((place(name)? as u32, *data))).collect();
        let samplers: Vec<_> =
            self.inputs.samplers().iter().filter_map(|(name, texture)| Some((place(name)?, *texture))).collect();
        draw(&UserPass {
            program: &self.program,
            attributes: &attributes,
            samplers: &samplers,
            files: self.inputs.files(),
            scene,
            values: &values,
        })
    }
}
