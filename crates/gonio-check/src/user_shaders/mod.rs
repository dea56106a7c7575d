//! Shaders of the user that draw any scene: read, compiled, and fed by the roles of their variables.
//!
//! Either stage may be missing: `stand_in` writes it. Nothing here judges a shader.

mod inputs;
mod stand_in;
mod uniforms;

pub use uniforms::{UniformSource, UserUniform, parse_setting};

use crate::compile::{self, ParsedStage};
use crate::roles::{self, Bindings, Bound, Declared, Role, VariableKind};
use crate::search::declared;
use crate::submission::{SourceFile, StageText, read_shader};
use crate::verdict::CompilerMessage;
use crate::words::nearest;
use gonio_gl::Gl;
use gonio_glsl::{Class, OutputVersion, Stage, Storage};
use gonio_render::user_program::{UserProgram, is_embedded};
use gonio_render::{SampledTexture, UserPass, VertexData};
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::{Frame, Scene, Texture};
use std::sync::Arc;

/// One or two shaders of the user, read but not compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserShaders {
    vertex: Option<StageText>,
    fragment: Option<StageText>,
    /// Corrections of the files' encodings.
    warnings: Vec<String>,
}

/// A program that draws, with the values of its uniforms.
pub struct UserShaderProgram {
    program: UserProgram,
    attributes: Vec<(u32, VertexData)>,
    samplers: Vec<(usize, SampledTexture)>,
    files: Vec<Arc<Texture>>,
    uniforms: Vec<UserUniform>,
    /// The uniforms of a stand-in.
    of_stand_in: Vec<UserUniform>,
    /// Uniforms that are declared, but that the driver found without effect.
    unused: Vec<String>,
    /// Variables without a value, guesses, and constructs that other compilers may reject, one sentence each.
    pub warnings: Vec<String>,
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

/// Most warnings about one program.
const MOST_WARNINGS: usize = 12;

impl UserShaders {
    /// Reads one shader or both.
    ///
    /// # Errors
    /// The reason why a file is not a shader, in one sentence.
    pub fn read(vertex: Option<SourceFile>, fragment: Option<SourceFile>) -> Result<Self, String> {
        let mut warnings = Vec::new();
        let mut read = |file: Option<SourceFile>| {
            let Some(file) = file else { return Ok(None) };
            let (text, warning) = read_shader(&file).map_err(|error| error.to_string())?;
            warnings.extend(warning);
            Ok::<_, String>(Some(text))
        };
        let (vertex, fragment) = (read(vertex)?, read(fragment)?);
        if vertex.is_none() && fragment.is_none() {
            return Err("there is neither a vertex nor a fragment shader".to_owned());
        }
        Ok(UserShaders { vertex, fragment, warnings })
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
        let parsed = |text: &StageText, stage| {
            let mut parsed = gonio_glsl::parse(&text.text);
            gonio_glsl::check(&mut parsed, stage).interface
        };
        let mut warnings = self.warnings.clone();
        let vertex_text = self.vertex.clone().unwrap_or_else(|| {
            let fragment = self.fragment.as_ref().map(|text| (text, parsed(text, Stage::Fragment)));
            stand_in::vertex(fragment.as_ref().map(|(text, interface)| (*text, interface)), &mut warnings)
        });
        let fragment_text = self.fragment.clone().unwrap_or_else(|| {
            let vertex = self.vertex.as_ref().map(|text| parsed(text, Stage::Vertex));
            stand_in::fragment(vertex.as_ref())
        });
        let vertex = ParsedStage::new(&vertex_text, Stage::Vertex, target);
        let fragment = ParsedStage::new(&fragment_text, Stage::Fragment, target);
        let program = compile::compile(gl, &vertex, &fragment).map_err(|broken| {
            let mut messages = compile::compiler_messages(&broken, &vertex, &fragment);
            if messages.is_empty() {
                let file = if self.fragment.is_some() { &fragment_text.file } else { &vertex_text.file };
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
        warnings.extend(compile::strictness(&vertex, &fragment));
        for stage in [&vertex, &fragment] {
            let blocks = stage.checked.interface.blocks.iter().filter(|block| block.storage == Storage::Uniform);
            warnings.extend(blocks.map(|block| {
                let (file, line, _) = stage.text.place(block.span.line, block.span.column);
                format!(
                    "{file}:{line}: the uniform block `{}` is 0; gonio sets uniforms outside of blocks only",
                    block.name
                )
            }));
        }
        let initial = [&vertex, &fragment].into_iter().flat_map(uniforms::initial_values).collect();
        let unused = [&vertex, &fragment]
            .into_iter()
            .flat_map(|stage| gonio_glsl::leaves(&stage.checked.interface))
            .map(|leaf| leaf.name)
            .collect();
        Ok(UserShaderProgram::new(program, initial, unused, warnings))
    }
}

impl UserShaderProgram {
    fn new(
        program: UserProgram,
        initial: Vec<(String, Vec<f32>)>,
        declared_names: Vec<String>,
        mut warnings: Vec<String>,
    ) -> Self {
        let bindings = roles::bind(&declared(&program), &stand_in::names());
        let attributes = attributes(&program, &bindings, &mut warnings);
        let mut samplers = Vec::new();
        let mut uniforms = Vec::new();
        let known = bindings.bound.iter().map(|Bound { declared, role, .. }| (declared, Some(*role)));
        let all = known.chain(bindings.unknown.iter().map(|declared| (declared, None)));
        for (declared, role) in all.filter(|(declared, _)| declared.kind == VariableKind::Uniform) {
            let Some(index) = program.uniform_index(&declared.name) else { continue };
            if declared.glsl_type.contains("sampler") {
                samplers.push((index, texture_of(declared, role, &mut warnings)));
                continue;
            }
            let initial = initial.iter().find(|(name, _)| *name == declared.name).map(|(_, values)| values.clone());
            uniforms.push(UserUniform::new(declared, index, role, initial));
        }
        uniforms.sort_by(|a, b| a.name.cmp(&b.name));
        let (of_stand_in, uniforms) = uniforms.into_iter().partition(|uniform| stand_in::is_input(&uniform.name));
        let is_active = |name: &String| program.uniform_index(name).is_some();
        let unused = declared_names.into_iter().filter(|name| !is_active(name)).collect();
        warnings.truncate(MOST_WARNINGS);
        UserShaderProgram { program, attributes, samplers, files: Vec::new(), uniforms, of_stand_in, unused, warnings }
    }

    /// The uniforms without the samplers, in order of name.
    pub fn uniforms(&self) -> &[UserUniform] {
        &self.uniforms
    }

    /// The uniforms, to change their values.
    pub fn uniforms_mut(&mut self) -> &mut [UserUniform] {
        &mut self.uniforms
    }

    /// Gives a uniform a value, which then replaces that of its role. `Ok` has a warning if the value has no effect.
    ///
    /// # Errors
    /// There is no such uniform, or it takes another number of values; one sentence.
    pub fn set(&mut self, name: &str, values: &[f32]) -> Result<Option<String>, String> {
        let name = name.strip_suffix("[0]").unwrap_or(name);
        if let Some(uniform) = self.uniforms.iter_mut().find(|uniform| uniform.name == name) {
            return uniform.choose(values).map(|()| None);
        }
        if self.unused.iter().any(|unused| unused == name) {
            return Ok(Some(format!("the uniform `{name}` has no effect on the picture, so its value is ignored")));
        }
        if self.sampler(name).is_some() {
            return Err(format!("`{name}` is a sampler; --texture gives it a picture"));
        }
        let known: Vec<&str> = self.uniforms.iter().map(|uniform| uniform.name.as_str()).collect();
        Err(match (nearest(name, known.iter().copied()), known.is_empty()) {
            (Some(near), _) => format!("the shaders have no uniform `{name}`; did you mean `{near}`?"),
            (None, true) => format!("the shaders have no uniform `{name}`, nor any other"),
            (None, false) => format!("the shaders have no uniform `{name}`; they have {}", known.join(", ")),
        })
    }

    fn sampler(&self, name: &str) -> Option<usize> {
        let index = self.program.uniform_index(name)?;
        self.samplers.iter().position(|(known, _)| *known == index)
    }

    /// Lets a `sampler2D` read a texture of the user.
    ///
    /// # Errors
    /// There is no such sampler; one sentence.
    pub fn set_texture(&mut self, name: &str, texture: Arc<Texture>) -> Result<(), String> {
        let Some(place) = self.sampler(name) else {
            let all: Vec<String> = self.sampler_names();
            return Err(match nearest(name, all.iter().map(String::as_str)) {
                Some(near) => format!("the shaders have no sampler `{name}`; did you mean `{near}`?"),
                None if all.is_empty() => format!("the shaders have no sampler `{name}`, nor any other"),
                None => format!("the shaders have no sampler `{name}`; they have {}", all.join(", ")),
            });
        };
        self.samplers[place].1 = SampledTexture::File(self.files.len());
        self.files.push(texture);
        Ok(())
    }

    fn sampler_names(&self) -> Vec<String> {
        self.sampler_origins().into_iter().map(|(name, _)| name).collect()
    }

    /// The samplers in order of name, each with what it reads, as a part of a sentence.
    pub fn sampler_origins(&self) -> Vec<(String, &'static str)> {
        let origin = |name: &str| {
            Some(match self.samplers[self.sampler(name)?].1 {
                SampledTexture::DiffuseMap => "the material's colour texture",
                SampledTexture::SpecularMap => "the material's specular texture",
                SampledTexture::NormalMap => "the material's normal map",
                SampledTexture::Environment => "the environment",
                SampledTexture::File(_) => "your picture",
                SampledTexture::White => "not recognised: white",
            })
        };
        let names = self.program.uniforms().map(|uniform| &uniform.name);
        names.filter_map(|name| Some((name.clone(), origin(name)?))).collect()
    }

    /// Whether the picture may change with the time.
    pub fn reads_time(&self) -> bool {
        self.uniforms.iter().any(|uniform| uniform.source == UniformSource::Scene(Role::Time))
    }

    /// Whether an attribute reads this.
    pub fn reads(&self, data: VertexData) -> bool {
        self.attributes.iter().any(|(_, read)| *read == data)
    }

    /// Warnings about inputs that this scene does not have, one sentence each.
    pub fn missing_inputs(&self, scene: &Scene) -> Vec<String> {
        let mut missing = Vec::new();
        if self.reads(VertexData::TexCoord) && scene.meshes.iter().all(|mesh| mesh.tex_coords.is_empty()) {
            missing.push("the model has no texture coordinates; the shaders read 0 instead".to_owned());
        }
        let reads = |texture| self.samplers.iter().any(|(_, read)| *read == texture);
        if reads(SampledTexture::Environment) && scene.environment.is_none() {
            missing.push(
                "the scene has no environment; the shaders read a black cubemap, and --environment gives them one"
                    .to_owned(),
            );
        }
        let is_lit = |light: &gonio_scene::settings::LightSettings| light.kind != LightSourceKind::Ambient;
        let reads_light = |uniform: &UserUniform| match uniform.source {
            UniformSource::Scene(role) => role.light().is_some(),
            _ => false,
        };
        if self.uniforms.iter().any(reads_light) && !scene.settings.lights.iter().any(is_lit) {
            missing.push("the scene has no light; the shaders read a white one at the camera".to_owned());
        }
        let has_map = |has: fn(&gonio_scene::Maps) -> bool| scene.materials.iter().any(|m| has(&m.maps));
        if reads(SampledTexture::DiffuseMap) && !has_map(|maps| maps.diffuse.is_some()) {
            missing.push("the model has no colour texture; the shaders read white instead".to_owned());
        }
        missing
    }

    /// Calls `draw` with the pass of a frame of this scene.
    pub fn with_pass<T>(&self, scene: &Scene, frame: &Frame, draw: impl FnOnce(&UserPass<'_>) -> T) -> T {
        let values = |world_from_model, material: &_| {
            let input = inputs::DrawInputs { frame, world_from_model, material };
            let all = self.uniforms.iter().chain(&self.of_stand_in);
            all.map(|uniform| (uniform.index, uniform.values_for(&input))).collect()
        };
        draw(&UserPass {
            program: &self.program,
            attributes: &self.attributes,
            samplers: &self.samplers,
            files: &self.files,
            scene,
            values: &values,
        })
    }
}

fn attributes(program: &UserProgram, bindings: &Bindings, warnings: &mut Vec<String>) -> Vec<(u32, VertexData)> {
    let unknown = bindings.unknown.iter().filter(|declared| declared.kind == VariableKind::Attribute);
    let mut all = Vec::new();
    let mut not_recognised: Vec<&str> = unknown.map(|declared| declared.name.as_str()).collect();
    for bound in bindings.bound.iter().filter(|bound| bound.declared.kind == VariableKind::Attribute) {
        let data = match bound.role {
            Role::Position => VertexData::Position,
            Role::Normal => VertexData::Normal,
            Role::TexCoord => VertexData::TexCoord,
            Role::Color => VertexData::Color,
            Role::Tangent => VertexData::Tangent,
            _ => {
                not_recognised.push(&bound.declared.name);
                continue;
            }
        };
        all.extend(program.attribute_location(&bound.declared.name).map(|location| (location, data)));
    }
    warnings.extend(not_recognised.iter().map(|name| {
        format!("the attribute `{name}` is not recognised and reads 0, 0, 0, 1; names such as `position` are")
    }));
    all
}

fn texture_of(declared: &Declared, role: Option<Role>, warnings: &mut Vec<String>) -> SampledTexture {
    match (declared.glsl_type.as_str(), role) {
        ("samplerCube", _) => SampledTexture::Environment,
        ("sampler2D", Some(Role::DiffuseTexture)) => SampledTexture::DiffuseMap,
        ("sampler2D", Some(Role::SpecularTexture)) => SampledTexture::SpecularMap,
        ("sampler2D", Some(Role::NormalTexture)) => SampledTexture::NormalMap,
        ("sampler2D", _) => {
            warnings.push(format!("the sampler `{}` reads white; --texture gives it a picture", declared.name));
            SampledTexture::White
        }
        (other, _) => {
            warnings.push(format!("the sampler `{}` reads 0: gonio has no texture for {other}", declared.name));
            SampledTexture::White
        }
    }
}
