//! The user's own shaders: their files, the last program that compiled, and why the present texts do not.

use crate::platform::{Pending, Platform, TrialOutcome};
use crate::session::{MessageSeverity, Messages};
use gonio_check::submission::SourceFile;
use gonio_check::user_shaders::{UniformSource, UserShaderProgram, UserShaders, message_text, names_beside};
use gonio_gl::Gl;
use gonio_scene::Texture;
use gonio_scene::files::FileSource;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The files of the user's shaders, and the first values of their uniforms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShaderFiles {
    /// The path of the vertex shader.
    pub vertex: Option<String>,
    /// The path of the fragment shader.
    pub fragment: Option<String>,
    /// Values of uniforms.
    pub uniforms: Vec<(String, Vec<f32>)>,
    /// Samplers, and the paths of the pictures that they read.
    pub textures: Vec<(String, String)>,
}

impl ShaderFiles {
    /// The paths of all files that the user named.
    pub fn named(&self) -> impl Iterator<Item = &String> {
        self.vertex.iter().chain(&self.fragment).chain(self.textures.iter().map(|(_, path)| path))
    }

    /// The paths of all files, those of `names.toml` included, which need not exist.
    pub fn paths(&self) -> impl Iterator<Item = PathBuf> {
        self.named().map(PathBuf::from).chain(self.names())
    }

    fn names(&self) -> Vec<PathBuf> {
        names_beside(self.vertex.iter().chain(&self.fragment).map(String::as_str))
    }

    /// Reads the `names.toml` beside each shader, where there is one.
    ///
    /// # Errors
    /// A file cannot be read; one sentence.
    pub fn read_names(&self, files: &dyn FileSource) -> Result<Vec<SourceFile>, String> {
        let read = |path: PathBuf| match files.read_within(&path, MOST_BYTES) {
            Ok(bytes) => Ok(Some(SourceFile::new(path.display().to_string(), bytes.into_vec()))),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot read {}: {error}", path.display())),
        };
        self.names().into_iter().filter_map(|path| read(path).transpose()).collect()
    }
}

/// The largest shader that is read, in bytes.
const MOST_BYTES: u64 = 10 << 20;

/// The user's own shaders in the window.
pub struct OwnShaders {
    files: ShaderFiles,
    /// The last program that compiled.
    program: Option<UserShaderProgram>,
    /// Whether the files must be read again.
    is_stale: bool,
    /// Shaders that are being tried in another process.
    tried: Option<(UserShaders, Box<dyn Pending<TrialOutcome>>)>,
    /// The reported errors and warnings of the present texts.
    remarks: Vec<String>,
    /// Whether the present texts do not compile.
    failed: bool,
    serial: u64,
}

impl OwnShaders {
    /// Shaders that are read and compiled by [`Self::follow`].
    pub fn new(files: ShaderFiles) -> Self {
        OwnShaders { files, program: None, is_stale: true, tried: None, remarks: Vec::new(), failed: false, serial: 0 }
    }

    /// The files.
    pub fn files(&self) -> &ShaderFiles {
        &self.files
    }

    /// The last program that compiled; pictures are drawn by it.
    pub fn program(&self) -> Option<&UserShaderProgram> {
        self.program.as_ref()
    }

    /// The program, to change its uniforms; [`Self::touch`] then has it drawn again.
    pub fn program_mut(&mut self) -> Option<&mut UserShaderProgram> {
        self.program.as_mut()
    }

    /// Has pictures drawn again.
    pub fn touch(&mut self) {
        self.serial += 1;
    }

    /// Changes when pictures must be drawn again.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// Whether the present texts do not compile, so that an older program is drawn, or none.
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    /// The errors and warnings of the present texts.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Has the files read again if one of them has changed.
    pub fn changed(&mut self, paths: &[PathBuf]) {
        self.is_stale |= self.files.paths().any(|own| paths.contains(&own));
    }

    /// Forgets what is on the GPU: its context was lost.
    pub fn release(&mut self) {
        (self.program, self.is_stale) = (None, true);
    }

    /// Reads and compiles changed files. The last good program is drawn until a new one compiles; errors are messages.
    pub fn follow(
        &mut self,
        gl: &Gl,
        files: &dyn FileSource,
        platform: &mut dyn Platform,
        messages: &mut Messages,
        ctx: &egui::Context,
    ) {
        if std::mem::take(&mut self.is_stale) {
            self.tried = None;
            match self.read(files) {
                Ok(shaders) => self.tried = Some((shaders, platform.shader_trial(&self.files, ctx))),
                Err(error) => self.fail(vec![error], messages),
            }
        }
        let outcome = self.tried.as_mut().and_then(|(_, trial)| trial.poll());
        let (Some(outcome), Some((shaders, _))) = (&outcome, &self.tried) else { return };
        match (outcome, shaders.clone()) {
            (TrialOutcome::Refused(reason), _) => self.fail(vec![reason.clone()], messages),
            (TrialOutcome::Harmless | TrialOutcome::Unavailable(_), shaders) => {
                match self.compiled(&shaders, gl, files) {
                    Ok(program) => self.take(program, messages),
                    Err(errors) => self.fail(errors, messages),
                }
            }
        }
        self.tried = None;
    }

    fn read(&self, files: &dyn FileSource) -> Result<UserShaders, String> {
        let read = |name: &Option<String>| {
            let Some(name) = name else { return Ok(None) };
            let bytes = files.read_within(Path::new(name), MOST_BYTES);
            let bytes = bytes.map_err(|error| format!("cannot read the shader {name}: {error}"))?;
            Ok::<_, String>(Some(SourceFile::new(name, bytes.into_vec())))
        };
        UserShaders::read(read(&self.files.vertex)?, read(&self.files.fragment)?, &self.files.read_names(files)?)
    }

    fn compiled(
        &self,
        shaders: &UserShaders,
        gl: &Gl,
        files: &dyn FileSource,
    ) -> Result<UserShaderProgram, Vec<String>> {
        let compiled = shaders.compile(gl);
        let mut program = compiled.map_err(|messages| messages.iter().map(message_text).collect::<Vec<_>>())?;
        let mut warnings = Vec::new();
        for (name, path) in &self.files.textures {
            let bytes = files.read_within(Path::new(path), u64::MAX).map_err(|error| error.to_string());
            let texture = bytes.and_then(|bytes| Texture::decode(path, &bytes));
            let texture = texture.map_err(|error| vec![format!("cannot read the texture {path}: {error}")])?;
            warnings.extend(program.inputs.set_texture(name, Arc::new(texture)).err());
        }
        match &self.program {
            // Values that were chosen stay, where the uniforms still exist.
            Some(before) => {
                let chosen = before.inputs.uniforms().iter().filter(|uniform| uniform.source == UniformSource::Chosen);
                for uniform in chosen {
                    let _ = program.inputs.set(&uniform.name, &uniform.values);
                }
            }
            None => {
                for (name, values) in &self.files.uniforms {
                    warnings.extend(program.inputs.set(name, values).unwrap_or_else(Some));
                }
            }
        }
        program.inputs.warnings.extend(warnings);
        Ok(program)
    }

    fn take(&mut self, program: UserShaderProgram, messages: &mut Messages) {
        self.replace_remarks(program.inputs.warnings.clone(), MessageSeverity::Warning, messages);
        self.program = Some(program);
        self.failed = false;
        self.serial += 1;
    }

    fn fail(&mut self, errors: Vec<String>, messages: &mut Messages) {
        self.replace_remarks(errors, MessageSeverity::Error, messages);
        self.failed = true;
    }

    fn replace_remarks(&mut self, remarks: Vec<String>, severity: MessageSeverity, messages: &mut Messages) {
        for old in std::mem::replace(&mut self.remarks, remarks) {
            messages.withdraw(&old);
        }
        for remark in &self.remarks {
            messages.report(severity, remark);
        }
    }
}
