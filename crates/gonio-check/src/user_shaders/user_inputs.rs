//! The attributes, uniforms and samplers of a user's pair of shaders, and where each gets its value.

use super::inputs;
use super::names::OwnNames;
use super::stand_in;
use super::uniforms::{UniformSource, UserUniform, components};
use crate::roles::{self, Bindings, Bound, Declared, Fixed, How, Role, VariableKind};
use crate::verdict::CompilerMessage;
use crate::words::nearest;
use gonio_language::tr;
use gonio_render::{SampledTexture, VertexData};
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::{Frame, Scene, Texture};
use std::sync::Arc;

/// The inputs of a pair of shaders, and where each gets its value.
#[derive(Clone, Debug)]
pub struct UserInputs {
    attributes: Vec<(String, VertexData)>,
    samplers: Vec<(String, SampledTexture)>,
    files: Vec<Arc<Texture>>,
    uniforms: Vec<UserUniform>,
    /// The uniforms of a stand-in.
    of_stand_in: Vec<UserUniform>,
    /// Uniforms that are declared, but have no effect.
    unused: Vec<String>,
    /// Variables without a value, guesses, and constructs that other compilers may reject, one sentence each.
    pub warnings: Vec<String>,
}

/// The variables of a pair of shaders.
pub(super) struct PairInterface<'a> {
    /// Those that have an effect.
    pub(super) declared: Vec<Declared>,
    /// The names of all uniforms.
    pub(super) all_names: Vec<String>,
    /// The values of initialisers.
    pub(super) initial: Vec<(String, Vec<f32>)>,
    /// What `names.toml` states.
    pub(super) names: &'a OwnNames,
    /// The names that a stand-in has used already.
    pub(super) names_used: Vec<String>,
    /// Warnings about the texts.
    pub(super) warnings: Vec<String>,
}

/// Most warnings about one program.
const MOST_WARNINGS: usize = 12;

impl UserInputs {
    /// Errors are those of `names.toml`.
    pub(super) fn new(of: PairInterface<'_>) -> Result<Self, Vec<CompilerMessage>> {
        let PairInterface { declared, all_names, initial, names, names_used, mut warnings } = of;
        let bindings = roles::bind(&declared, &names.with(stand_in::names()));
        let errors = wrong_entries(&bindings, names);
        if !errors.is_empty() {
            return Err(errors);
        }
        let attributes = attributes(&bindings, &mut warnings);
        let (mut samplers, mut uniforms) = (Vec::new(), Vec::new());
        // Materials have a shininess; their roughness is the user's to set.
        let is_known = |role: &Role, how: &How| *role != Role::Roughness || *how == How::NamesFile;
        let known = bindings
            .bound
            .iter()
            .map(|Bound { declared, role, how }| (declared, is_known(role, how).then_some((*role, *how))));
        let all = known.chain(bindings.unknown.iter().map(|declared| (declared, None)));
        for (declared, role) in all.filter(|(declared, _)| declared.kind == VariableKind::Uniform) {
            if declared.glsl_type.contains("sampler") {
                let texture = texture_of(declared, role.map(|(role, _)| role), &mut warnings);
                samplers.push((declared.name.clone(), texture));
                continue;
            }
            let initial = initial.iter().find(|(name, _)| *name == declared.name).map(|(_, values)| values.clone());
            let source = match (&initial, role) {
                (_, Some((role, How::NamesFile))) => UniformSource::Scene(role),
                (Some(_), _) => UniformSource::Initialiser,
                (None, Some((role, _))) => UniformSource::Scene(role),
                (None, None) => UniformSource::Guess,
            };
            uniforms.push(UserUniform::new(declared, source, initial));
        }
        for Fixed { declared, values } in &bindings.fixed {
            uniforms.push(UserUniform::new(declared, UniformSource::NamesFile, Some(values.clone())));
        }
        uniforms.sort_by(|a, b| a.name.cmp(&b.name));
        samplers.sort_by(|(a, _), (b, _)| a.cmp(b));
        let (of_stand_in, uniforms) = uniforms.into_iter().partition(|uniform| stand_in::is_input(&uniform.name));
        let is_active = |name: &String| declared.iter().any(|known| known.name == *name);
        let unused: Vec<String> = all_names.into_iter().filter(|name| !is_active(name)).collect();
        for name in bindings.unused.iter().filter(|name| !names_used.contains(name)) {
            let Some((file, line)) = names.place(name) else { continue };
            let why = if unused.contains(name) {
                tr!("check-inputs-has-no-effect-on-the-picture")
            } else {
                tr!("check-inputs-is-not-in-the-shaders")
            };
            warnings.push(format!("{file}:{line}: `{name}` {why}"));
        }
        warnings.truncate(MOST_WARNINGS);
        Ok(UserInputs { attributes, samplers, files: Vec::new(), uniforms, of_stand_in, unused, warnings })
    }

    /// The attributes, each with what it reads; others read (0, 0, 0, 1).
    pub fn attributes(&self) -> &[(String, VertexData)] {
        &self.attributes
    }

    /// The samplers in order of name, each with what it reads.
    pub fn samplers(&self) -> &[(String, SampledTexture)] {
        &self.samplers
    }

    /// The textures of the user, by the numbers in [`SampledTexture::File`].
    pub fn files(&self) -> &[Arc<Texture>] {
        &self.files
    }

    /// The uniforms without the samplers, in order of name.
    pub fn uniforms(&self) -> &[UserUniform] {
        &self.uniforms
    }

    /// The uniforms, to change their values.
    pub fn uniforms_mut(&mut self) -> &mut [UserUniform] {
        &mut self.uniforms
    }

    /// The uniforms with those of a stand-in.
    pub fn all_uniforms(&self) -> impl Iterator<Item = &UserUniform> {
        self.uniforms.iter().chain(&self.of_stand_in)
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
            return Ok(Some(tr!("check-inputs-the-uniform-has-no-effect-on", name = name)));
        }
        if self.sampler(name).is_some() {
            return Err(tr!("check-inputs-is-a-sampler-texture-gives-it", name = name));
        }
        let known: Vec<&str> = self.uniforms.iter().map(|uniform| uniform.name.as_str()).collect();
        Err(match (nearest(name, known.iter().copied()), known.is_empty()) {
            (Some(near), _) => tr!("check-inputs-the-shaders-have-no-uniform-did", name = name, near = near),
            (None, true) => tr!("check-inputs-the-shaders-have-no-uniform-nor", name = name),
            (None, false) => {
                tr!("check-inputs-the-shaders-have-no-uniform-they", name = name, names = known.join(", "))
            }
        })
    }

    /// Takes the values that the user chose and the user's textures from the inputs of another program, where this one has the
    /// same variables.
    pub fn take_choices(&mut self, other: &UserInputs) {
        for uniform in other.uniforms.iter().filter(|uniform| uniform.source == UniformSource::Chosen) {
            // A variable that is gone or has another type now keeps its own value.
            let _ = self.set(&uniform.name, &uniform.values);
        }
        for (name, texture) in &other.samplers {
            if let SampledTexture::File(index) = texture
                && let Some(texture) = other.files.get(*index)
            {
                let _ = self.set_texture(name, texture.clone());
            }
        }
    }

    fn sampler(&self, name: &str) -> Option<usize> {
        self.samplers.iter().position(|(known, _)| known == name)
    }

    /// Lets a `sampler2D` read a texture of the user.
    ///
    /// # Errors
    /// There is no such sampler; one sentence.
    pub fn set_texture(&mut self, name: &str, texture: Arc<Texture>) -> Result<(), String> {
        let Some(place) = self.sampler(name) else {
            let all: Vec<&str> = self.samplers.iter().map(|(name, _)| name.as_str()).collect();
            return Err(match nearest(name, all.iter().copied()) {
                Some(near) => tr!("check-inputs-the-shaders-have-no-sampler-did", name = name, near = near),
                None if all.is_empty() => tr!("check-inputs-the-shaders-have-no-sampler-nor", name = name),
                None => tr!("check-inputs-the-shaders-have-no-sampler-they", name = name, names = all.join(", ")),
            });
        };
        self.samplers[place].1 = SampledTexture::File(self.files.len());
        self.files.push(texture);
        Ok(())
    }

    /// The samplers in order of name, each with what it reads, as a part of a sentence.
    pub fn sampler_origins(&self) -> impl Iterator<Item = (&str, &'static str)> {
        let origin = |texture| match texture {
            SampledTexture::DiffuseMap => tr!("check-inputs-the-material-s-colour-texture"),
            SampledTexture::SpecularMap => tr!("check-inputs-the-material-s-specular-texture"),
            SampledTexture::NormalMap => tr!("check-inputs-the-material-s-normal-map"),
            SampledTexture::Environment => tr!("check-inputs-the-environment"),
            SampledTexture::File(_) => tr!("check-inputs-your-picture"),
            SampledTexture::White => tr!("check-inputs-not-recognised-white"),
        };
        self.samplers.iter().map(move |(name, texture)| (name.as_str(), origin(*texture)))
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
            missing.push(tr!("check-inputs-the-model-has-no-texture-coordinates").to_owned());
        }
        let reads = |texture| self.samplers.iter().any(|(_, read)| *read == texture);
        if reads(SampledTexture::Environment) && scene.environment.is_none() {
            missing.push(tr!("check-inputs-the-scene-has-no-environment-the").to_owned());
        }
        let is_lit = |light: &gonio_scene::settings::LightSettings| light.kind != LightSourceKind::Ambient;
        let reads_light = |uniform: &UserUniform| match uniform.source {
            UniformSource::Scene(role) => role.light().is_some(),
            _ => false,
        };
        if self.uniforms.iter().any(reads_light) && !scene.settings.lights.iter().any(is_lit) {
            missing.push(tr!("check-inputs-the-scene-has-no-light-the").to_owned());
        }
        let has_map = |has: fn(&gonio_scene::Maps) -> bool| scene.materials.iter().any(|m| has(&m.maps));
        if reads(SampledTexture::DiffuseMap) && !has_map(|maps| maps.diffuse.is_some()) {
            missing.push(tr!("check-inputs-the-model-has-no-colour-texture").to_owned());
        }
        missing
    }

    /// The numbers of each uniform for one draw.
    pub fn values<'a>(
        &'a self,
        frame: &'a Frame,
        world_from_model: glam::DMat4,
        material: &'a gonio_scene::SceneMaterial,
    ) -> impl Iterator<Item = (&'a UserUniform, Vec<f32>)> {
        let input = inputs::DrawInputs { frame, world_from_model, material };
        self.all_uniforms().map(move |uniform| (uniform, uniform.values_for(&input)))
    }
}

/// The entries of `names.toml` that do not fit the variables of their names.
fn wrong_entries(bindings: &Bindings, names: &OwnNames) -> Vec<CompilerMessage> {
    let mut errors = Vec::new();
    for Fixed { declared, values } in &bindings.fixed {
        let (name, ty) = (&declared.name, &declared.glsl_type);
        let (one, all) = (components(ty), components(ty) * declared.array.max(1) as usize);
        let text = if declared.kind == VariableKind::Attribute {
            tr!("check-inputs-is-an-attribute-which-takes-a", name = name)
        } else if ty.contains("sampler") {
            tr!("check-inputs-is-a-sampler-which-takes-a", name = name)
        } else if ![one, all].contains(&values.len()) {
            let numbers = if all == 1 {
                tr!("check-inputs-1-number").to_owned()
            } else {
                tr!("check-inputs-all-numbers", all = all)
            };
            tr!("check-inputs-names-takes-numbers", name = name, ty = ty, numbers = numbers, count = values.len())
        } else {
            continue;
        };
        errors.push(names.error(name, text));
    }
    for Bound { declared, role, .. } in bindings.bound.iter().filter(|bound| bound.how == How::NamesFile) {
        let name = &declared.name;
        let is_texture = |role: &Role| {
            matches!(role, Role::Cubemap | Role::DiffuseTexture | Role::SpecularTexture | Role::NormalTexture)
        };
        let is_sampler = declared.glsl_type.contains("sampler");
        let (fits, what) = match (declared.kind, is_sampler) {
            (VariableKind::Attribute, _) => (role.is_attribute(), tr!("check-inputs-an-attribute")),
            (VariableKind::Uniform, true) => (is_texture(role), tr!("check-inputs-a-sampler")),
            (VariableKind::Uniform, false) => (inputs::has_value(*role), tr!("check-inputs-a-uniform")),
        };
        if !fits {
            errors.push(names.error(
                name,
                tr!("check-inputs-is-which-cannot-have-the-role", name = name, what = what, role = role.to_string()),
            ));
        }
    }
    errors
}

fn attributes(bindings: &Bindings, warnings: &mut Vec<String>) -> Vec<(String, VertexData)> {
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
        all.push((bound.declared.name.clone(), data));
    }
    warnings
        .extend(not_recognised.iter().map(|name| tr!("check-inputs-the-attribute-is-not-recognised-and", name = name)));
    all
}

fn texture_of(declared: &Declared, role: Option<Role>, warnings: &mut Vec<String>) -> SampledTexture {
    match (declared.glsl_type.as_str(), role) {
        ("samplerCube", _) => SampledTexture::Environment,
        ("sampler2D", Some(Role::DiffuseTexture)) => SampledTexture::DiffuseMap,
        ("sampler2D", Some(Role::SpecularTexture)) => SampledTexture::SpecularMap,
        ("sampler2D", Some(Role::NormalTexture)) => SampledTexture::NormalMap,
        ("sampler2D", _) => {
            warnings.push(tr!("check-inputs-the-sampler-reads-white-texture-gives", name = declared.name));
            SampledTexture::White
        }
        (other, _) => {
            warnings.push(tr!("check-inputs-the-sampler-reads-0-gonio-has", name = declared.name, other = other));
            SampledTexture::White
        }
    }
}
