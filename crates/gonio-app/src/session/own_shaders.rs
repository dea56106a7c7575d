//! The user's own shaders: their files, the last program that compiled, why the present texts do not, and the pinned pixel.

use crate::files::{Layered, MOST_SHADER_BYTES, ShaderFiles};
use crate::platform::{Pending, Platform, Ready, TrialOutcome};
use crate::session::{MessageSeverity, Messages};
use crate::step::Stepper;
use crate::step::source::{OwnProgram, SteppedPicture};
use gonio_check::submission::SourceFile;
use gonio_check::user_shaders::{UserInputs, UserShaderProgram, UserShaders, message_text};
use gonio_check::verdict::CompilerMessage;
use gonio_exercises::step::UserPair;
use gonio_gl::Gl;
use gonio_language::tr;
use gonio_scene::files::FileSource;
use gonio_scene::{Frame, Scene, Texture};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use web_time::Instant;

/// After less time than this, a lost context is the fault of the shaders that it was compiled for.
const SUSPICIOUS: Duration = Duration::from_secs(20);

/// An error or a warning about the present texts.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderRemark {
    /// One sentence, with its place.
    pub text: String,
    /// The compiler's message.
    pub message: Option<CompilerMessage>,
}

impl From<String> for ShaderRemark {
    fn from(text: String) -> Self {
        ShaderRemark { text, message: None }
    }
}

/// Shaders that are being tried in another process.
struct Trial {
    shaders: UserShaders,
    outcome: Box<dyn Pending<TrialOutcome>>,
}

/// A program that compiled.
struct Compiled {
    program: UserShaderProgram,
    /// Its source, to be stepped through.
    source: Arc<OwnProgram>,
    since: Instant,
}

/// The user's own shaders in the window.
pub struct OwnShaders {
    files: ShaderFiles,
    /// The source of dropped files; those of the command line are read from the platform's.
    opened: Option<Arc<dyn FileSource>>,
    /// The present texts.
    texts: Arc<[SourceFile]>,
    /// The last program that compiled.
    compiled: Option<Compiled>,
    /// Whether the files must be read again.
    is_stale: bool,
    tried: Option<Trial>,
    remarks: Vec<ShaderRemark>,
    /// Whether the present texts do not compile.
    failed: bool,
    /// Whether the context was lost because of these shaders.
    lost: bool,
    serial: u64,
    /// The values of the uniforms at a serial.
    inputs: Option<(u64, Arc<UserInputs>)>,
    /// The pinned pixel and its values.
    pub stepper: Stepper,
    /// The pane of the pinned pixel.
    pub pane: usize,
    /// Whether the texts are shown while no pixel is pinned.
    pub shows_texts: bool,
    /// The file that is shown.
    pub shown: String,
    /// A line of that file to scroll to.
    pub jump: Option<u32>,
}

impl OwnShaders {
    /// Shaders that are read and compiled by [`Self::follow`]. `opened`: the source of files that were dropped or chosen.
    pub fn new(files: ShaderFiles, opened: Option<Arc<dyn FileSource>>) -> Self {
        OwnShaders {
            files,
            opened,
            texts: Arc::default(),
            compiled: None,
            is_stale: true,
            tried: None,
            remarks: Vec::new(),
            failed: false,
            lost: false,
            serial: 0,
            inputs: None,
            stepper: Stepper::default(),
            pane: 0,
            shows_texts: false,
            shown: String::new(),
            jump: None,
        }
    }

    /// Opens files in place of those for the same purpose. Uniforms keep the values that were chosen.
    pub fn open(&mut self, newer: ShaderFiles, opened: Arc<dyn FileSource>, platform: &dyn Platform) {
        let then = self.opened.take().unwrap_or_else(|| platform.files());
        self.opened = Some(Arc::new(Layered { first: opened, then }));
        if let Some(name) = newer.fragment.as_ref().or(newer.vertex.as_ref()) {
            self.shown.clone_from(name);
        }
        self.files = std::mem::take(&mut self.files).replaced_by(newer);
        self.is_stale = true;
    }

    /// The files.
    pub fn files(&self) -> &ShaderFiles {
        &self.files
    }

    /// The present texts, and gonio's own shader in the place of a missing one.
    pub fn texts(&self) -> Arc<[SourceFile]> {
        self.texts.clone()
    }

    /// The last program that compiled; pictures are drawn by it.
    pub fn program(&self) -> Option<&UserShaderProgram> {
        self.compiled.as_ref().map(|compiled| &compiled.program)
    }

    /// The program, to change its uniforms; [`Self::touch`] then has it drawn again.
    pub fn program_mut(&mut self) -> Option<&mut UserShaderProgram> {
        self.compiled.as_mut().map(|compiled| &mut compiled.program)
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
    pub fn remarks(&self) -> &[ShaderRemark] {
        &self.remarks
    }

    /// Has the files read again if one of them has changed.
    pub fn changed(&mut self, paths: &[PathBuf]) {
        self.is_stale |= self.files.paths().any(|own| paths.contains(&own));
    }

    /// Forgets what is on the GPU: its context was lost. A browser takes it away from shaders that do not end, which are
    /// therefore not compiled again.
    pub fn release(&mut self) {
        let compiled = self.compiled.take();
        self.lost = compiled.is_some_and(|compiled| compiled.since.elapsed() < SUSPICIOUS);
        self.is_stale = !self.lost;
    }

    /// Whether the texts are shown: to be read, or with the values of the pinned pixel.
    pub fn is_reading(&self) -> bool {
        self.shows_texts || self.stepper.is_pinned()
    }

    /// Withdraws the messages about the shaders, which are closed.
    pub fn close(mut self, messages: &mut Messages) {
        self.replace_remarks(Vec::new(), MessageSeverity::Note, messages);
    }

    /// Notes the picture of a pane in this frame, and computes the values of the pinned pixel.
    pub fn step(
        &mut self,
        ctx: &egui::Context,
        platform: &mut dyn Platform,
        drawn: impl FnOnce(usize) -> Option<(Arc<Scene>, Frame)>,
    ) {
        let (Some(compiled), pane, serial) = (&self.compiled, self.pane, self.serial) else {
            self.stepper.note_picture(|| None);
            return self.stepper.follow(ctx, platform);
        };
        let inputs = &mut self.inputs;
        self.stepper.note_picture(|| {
            let (scene, frame) = drawn(pane)?;
            let known = inputs.take().filter(|(of, _)| *of == serial);
            let (_, inputs) =
                inputs.insert(known.unwrap_or_else(|| (serial, Arc::new(compiled.program.inputs.clone()))));
            // The number of samples changes while something moves.
            let frame = Box::new(Frame { samples: 1, ..frame });
            Some(SteppedPicture::Own { program: compiled.source.clone(), inputs: inputs.clone(), scene, frame })
        });
        self.stepper.note_compiled();
        self.stepper.follow(ctx, platform);
    }

    /// Reads and compiles changed files. The last good program is drawn until a new one compiles; errors are messages.
    pub fn follow(
        &mut self,
        gl: &Gl,
        scene: Option<&Scene>,
        platform: &mut dyn Platform,
        messages: &mut Messages,
        ctx: &egui::Context,
    ) {
        if std::mem::take(&mut self.lost) {
            let why = tr!("window-the-graphics-were-reset-while-your");
            self.fail(vec![why.to_owned().into()], messages);
        }
        let files = self.opened.clone().unwrap_or_else(|| platform.files());
        // Where there are no processes, shaders are tried on the scene.
        if self.is_stale && (scene.is_some() || platform.has_folders()) {
            (self.is_stale, self.tried) = (false, None);
            match self.read(&*files) {
                Ok(shaders) => {
                    let outcome = platform.shader_trial(&self.files, ctx);
                    self.tried = Some(Trial { shaders, outcome });
                }
                Err(error) => self.fail(vec![error.into()], messages),
            }
        }
        let Some(Trial { shaders, outcome }) = &mut self.tried else { return };
        let Some(outcome) = outcome.poll() else { return };
        if scene.is_none() && shaders.has_loops() && matches!(outcome, TrialOutcome::Unavailable(_)) {
            // They are tried on the CPU as soon as there is a scene.
            self.tried = Some(Trial { shaders: shaders.clone(), outcome: Box::new(Ready::new(outcome)) });
            return;
        }
        let shaders = shaders.clone();
        self.tried = None;
        let refused = match outcome {
            TrialOutcome::Refused(reason) => Some(reason),
            TrialOutcome::Unavailable(_) => scene.and_then(|scene| endless(&shaders, scene)),
            TrialOutcome::Harmless => None,
        };
        match refused.map_or_else(|| self.compile(shaders, gl, &*files), |reason| Err(vec![reason.into()])) {
            Ok(compiled) => self.take(compiled, messages),
            Err(errors) => self.fail(errors, messages),
        }
    }

    fn read(&mut self, files: &dyn FileSource) -> Result<UserShaders, String> {
        let read = |name: &Option<String>| {
            let Some(name) = name else { return Ok(None) };
            let bytes = files.read_within(Path::new(name), MOST_SHADER_BYTES);
            let bytes = bytes.map_err(|error| tr!("window-cannot-read-the-shader", name = name, error = error))?;
            Ok::<_, String>(Some(SourceFile::new(name, bytes.into_vec())))
        };
        let (vertex, fragment) = (read(&self.files.vertex)?, read(&self.files.fragment)?);
        let own = vertex.iter().chain(&fragment).cloned();
        self.texts = own.clone().collect();
        let shaders = UserShaders::read(vertex.clone(), fragment.clone(), &self.files.read_names(files)?)?;
        self.texts = own.chain(shaders.stand_in()).collect();
        Ok(shaders)
    }

    fn compile(&self, source: UserShaders, gl: &Gl, files: &dyn FileSource) -> Result<Compiled, Vec<ShaderRemark>> {
        let remark = |message: CompilerMessage| ShaderRemark { text: message_text(&message), message: Some(message) };
        let compiled = source.compile(gl);
        let mut program = compiled.map_err(|messages| messages.into_iter().map(remark).collect::<Vec<_>>())?;
        let mut warnings = Vec::new();
        match self.program() {
            Some(before) => program.inputs.take_choices(&before.inputs),
            None => {
                for (name, values) in &self.files.uniforms {
                    warnings.extend(program.inputs.set(name, values).unwrap_or_else(Some));
                }
            }
        }
        for (name, path) in &self.files.textures {
            let bytes = files.read_within(Path::new(path), u64::MAX).map_err(|error| error.to_string());
            let texture = bytes.and_then(|bytes| Texture::decode(path, &bytes));
            let texture = texture
                .map_err(|error| vec![tr!("window-cannot-read-the-texture", path = path, error = error).into()])?;
            warnings.extend(program.inputs.set_texture(name, Arc::new(texture)).err());
        }
        program.inputs.warnings.extend(warnings);
        let source = Arc::new(OwnProgram { content: self.texts.clone(), source });
        Ok(Compiled { program, source, since: Instant::now() })
    }

    fn take(&mut self, compiled: Compiled, messages: &mut Messages) {
        let warnings = compiled.program.inputs.warnings.iter().cloned().map(ShaderRemark::from).collect();
        self.replace_remarks(warnings, MessageSeverity::Warning, messages);
        self.compiled = Some(compiled);
        self.failed = false;
        self.serial += 1;
    }

    fn fail(&mut self, errors: Vec<ShaderRemark>, messages: &mut Messages) {
        self.replace_remarks(errors, MessageSeverity::Error, messages);
        self.failed = true;
    }

    fn replace_remarks(&mut self, remarks: Vec<ShaderRemark>, severity: MessageSeverity, messages: &mut Messages) {
        for old in std::mem::replace(&mut self.remarks, remarks) {
            messages.withdraw(&old.text);
        }
        for remark in &self.remarks {
            messages.report(severity, &remark.text);
        }
    }
}

/// Why shaders with a loop are not drawn, in one sentence: on the CPU, at some pixels, it does not end, or it cannot be run there.
fn endless(shaders: &UserShaders, scene: &Scene) -> Option<String> {
    if !shaders.has_loops() {
        return None;
    }
    // The driver reports errors of the texts.
    UserPair::new(shaders).ok()?.try_at_some_pixels(scene).err()
}
