//! The user's own shaders: their options, their files, and the process that draws with them.

use super::RenderArgs;
use crate::backend::Opened;
use crate::commands::lab::child_process;
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{LimitOptions, SceneOptions};
use crate::report::Reporter;
use crate::user_drawing::UserDrawing;
use clap::{ArgAction, Args};
use gonio_app::files::{MOST_SHADER_BYTES, ShaderFiles};
use gonio_check::submission::SourceFile;
use gonio_check::user_shaders::{UserInputs, UserShaders, message_text, parse_setting};
use gonio_check::verdict::CompilerMessage;
use gonio_exercises::step::{StepWork, SteppedScene, UserPair};
use gonio_render::VertexData;
use gonio_scene::files::STANDARD_INPUT;
use gonio_scene::{Scene, Texture};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Shaders that draw the model instead of gonio's own.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Shader options")]
pub struct ShaderOptions {
    /// Draw the model with this vertex shader, GLSL of any version.
    ///
    /// Attributes and uniforms get their values by their names: matrices, camera, lights, material, time and size. A names.toml
    /// beside the file gives other names a role or a value: lines such as sun = "light-pos" or steps = 4 in its table names.
    /// Without --fragment the colour that it writes is shown, or the shape.
    #[arg(long, value_name = "FILE")]
    pub vertex: Option<String>,
    /// Draw the model with this fragment shader, GLSL of any version.
    ///
    /// Without --vertex its inputs get their values by their names: position, normal, texture coordinates, colour, directions
    /// to the light and to the eye. Its colours are those of the picture: they are not encoded.
    #[arg(long, value_name = "FILE")]
    pub fragment: Option<String>,
    /// Set a uniform of those shaders: numbers, true, false or #rrggbb. Repeat it for several.
    #[arg(long, value_name = "NAME=VALUE,...", action = ArgAction::Append, value_parser = parse_setting)]
    pub uniform: Vec<(String, Vec<f32>)>,
    /// Let a sampler2D of those shaders read a picture. Repeat it for several.
    #[arg(long, value_name = "NAME=FILE", action = ArgAction::Append, value_parser = parse_texture)]
    pub texture: Vec<(String, String)>,
}

fn parse_texture(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, file)) if !name.trim().is_empty() && !file.is_empty() => {
            Ok((name.trim().to_owned(), file.to_owned()))
        }
        _ => Err(format!("invalid texture `{text}`: expected NAME=FILE, for example noise=noise.png")),
    }
}

/// Shaders and textures, read.
pub struct OwnShaderFiles {
    shaders: UserShaders,
    textures: Vec<(String, Arc<Texture>)>,
}

/// The user's shaders in a scene, on the CPU.
pub struct SteppedShaders {
    pub pair: UserPair,
    pub scene: Scene,
    pub stepped: SteppedScene,
}

/// Seconds that a picture may take, and each further frame.
const PATIENCE_S: [u64; 2] = [60, 10];
/// Memory of the process that draws, in kilobytes.
const MOST_MEMORY_KB: u64 = 8 << 20;
/// Stack of the drawing thread: drivers recurse along a shader's expressions. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;

impl ShaderOptions {
    /// Whether shaders draw the model.
    pub fn any(&self) -> bool {
        self.vertex.is_some() || self.fragment.is_some()
    }

    /// The files for the window.
    pub fn files(&self) -> Option<ShaderFiles> {
        self.any().then(|| ShaderFiles {
            vertex: self.vertex.clone(),
            fragment: self.fragment.clone(),
            uniforms: self.uniform.clone(),
            textures: self.texture.clone(),
            ..ShaderFiles::default()
        })
    }

    /// Refuses settings without shaders.
    pub fn check(&self) -> Result<(), CliError> {
        let option = if self.uniform.is_empty() { "--texture" } else { "--uniform" };
        let has_settings = !self.uniform.is_empty() || !self.texture.is_empty();
        if has_settings && !self.any() {
            return Err(CliError::new(format!("{option} sets a value of your shaders; add --vertex or --fragment")));
        }
        Ok(())
    }

    /// Reads shaders and scene, and runs the vertex shader on the CPU.
    pub fn in_scene(
        &self,
        inputs: &[String],
        options: &SceneOptions,
        time: f64,
        work: StepWork,
        reporter: &Reporter,
    ) -> Result<SteppedShaders, CliError> {
        let shaders = self.read(&options.limits, reporter)?;
        let mut scene = loading::load_scene(inputs, options, reporter)?.at(time);
        reporter.diagnostics(&scene.diagnostics);
        let pair = shaders.interpreted(self, &mut scene, reporter)?;
        let frame = scene.frame(time);
        let _busy = reporter.busy("running your shaders");
        let stepped = pair.in_scene(&scene, &frame, work);
        Ok(SteppedShaders { pair, scene, stepped })
    }

    /// Reads the files.
    pub fn read(&self, limits: &LimitOptions, reporter: &Reporter) -> Result<OwnShaderFiles, CliError> {
        let named = self.vertex.iter().chain(&self.fragment).chain(self.texture.iter().map(|(_, file)| file));
        let files = limits.files(named.map(String::as_str), reporter);
        let read = |what: &str, name: &String, most| {
            let bytes = files.read_within(Path::new(name), most);
            bytes.map_err(|error| CliError::io(format!("cannot read the {what} `{name}`"), &error))
        };
        let shader = |what: &str, name: &Option<String>| {
            let source = |name: &String| {
                Ok::<_, CliError>(SourceFile::new(name, read(what, name, MOST_SHADER_BYTES)?.into_vec()))
            };
            name.as_ref().map(source).transpose()
        };
        let (vertex, fragment) = (shader("vertex shader", &self.vertex)?, shader("fragment shader", &self.fragment)?);
        let shaders = {
            let names = self.files().unwrap_or_default().read_names(&*files).map_err(CliError::new)?;
            UserShaders::read(vertex, fragment, &names).map_err(CliError::new)?
        };
        let texture = |(sampler, name): &(String, String)| {
            let bytes = read("texture", name, limits.limits().max_bytes)?;
            let texture = Texture::decode(name, &bytes);
            let texture =
                texture.map_err(|error| CliError::new(format!("cannot read the texture `{name}`: {error}")))?;
            Ok((sampler.clone(), Arc::new(texture)))
        };
        let textures = self.texture.iter().map(texture).collect::<Result<_, CliError>>()?;
        Ok(OwnShaderFiles { shaders, textures })
    }
}

impl OwnShaderFiles {
    /// Compiles them for a backend, and gives the uniforms and samplers their values. The scene gets tangents if they read them.
    pub fn for_backend(
        &self,
        opened: &Opened,
        options: &ShaderOptions,
        scene: &mut Scene,
        reporter: &Reporter,
    ) -> Result<UserDrawing, CliError> {
        let Some(gl) = opened.gl_for_shaders() else {
            return Ok(UserDrawing::Cpu(self.interpreted(options, scene, reporter)?));
        };
        let mut program = self.shaders.compile(gl).map_err(compile_errors)?;
        self.set_values(&mut program.inputs, options, scene, reporter)?;
        Ok(UserDrawing::Gl(program))
    }

    /// The same for gonio's interpreter, without OpenGL.
    pub fn interpreted(
        &self,
        options: &ShaderOptions,
        scene: &mut Scene,
        reporter: &Reporter,
    ) -> Result<UserPair, CliError> {
        let mut pair = UserPair::new(&self.shaders).map_err(compile_errors)?;
        self.set_values(&mut pair.inputs, options, scene, reporter)?;
        Ok(pair)
    }

    fn set_values(
        &self,
        inputs: &mut UserInputs,
        options: &ShaderOptions,
        scene: &mut Scene,
        reporter: &Reporter,
    ) -> Result<(), CliError> {
        for (name, values) in &options.uniform {
            let warning = inputs.set(name, values);
            if let Some(warning) = warning.map_err(|error| CliError::new(format!("--uniform {name}: {error}")))? {
                reporter.warning(warning);
            }
        }
        for (name, texture) in &self.textures {
            let set = inputs.set_texture(name, texture.clone());
            set.map_err(|error| CliError::new(format!("--texture {name}: {error}")))?;
        }
        for warning in &inputs.warnings {
            reporter.warning(warning);
        }
        for uniform in inputs.uniforms() {
            reporter.verbose(format_args!("uniform {} {}: {}", uniform.glsl_type, uniform.name, uniform.origin()));
        }
        for (name, origin) in inputs.sampler_origins() {
            reporter.verbose(format_args!("sampler {name}: {origin}"));
        }
        if inputs.reads(VertexData::Tangent) {
            scene.add_tangents();
        }
        for warning in inputs.missing_inputs(scene) {
            reporter.warning(warning);
        }
        Ok(())
    }
}

fn compile_errors(messages: Vec<CompilerMessage>) -> CliError {
    CliError::lines(messages.iter().map(message_text))
}

/// Refuses options that concern gonio's own shaders.
pub fn refuse(args: &RenderArgs) -> Result<(), CliError> {
    args.shaders.check()?;
    if !args.shaders.any() {
        let shown = args.show.map(|_| "--show shows a value of your shaders; add --vertex or --fragment");
        return shown.map_or(Ok(()), |error| Err(CliError::new(error)));
    }
    let scene = &args.scene;
    let refused = [
        ("--debug", args.debug.is_some()),
        ("--views", !args.views.is_empty()),
        ("--overlay", !args.overlay.is_empty()),
        ("--capture", args.capture.is_some()),
        ("--color", scene.color.is_some()),
        ("--tone-map", scene.tone_map.is_some()),
        ("--exposure", scene.exposure.is_some()),
        ("--specular", scene.specular.is_some()),
        ("--brdf", scene.brdf.is_some()),
        ("--brdf-file", scene.brdf_file.is_some()),
        ("--without", !scene.without.is_empty()),
        ("--shadows", scene.shadows.is_some()),
    ];
    match refused.iter().find(|(_, given)| *given) {
        Some((option, _)) => Err(CliError::new(format!(
            "{option} concerns gonio's own shaders; leave it out, or leave out --vertex and --fragment"
        ))),
        None => Ok(()),
    }
}

/// Draws in a process of its own: a shader may crash the graphics driver, or never end.
pub fn run_in_a_process(args: &RenderArgs) -> Result<CommandOutcome, CliError> {
    let frames = u64::from(args.frames.unwrap_or(1).max(1) - 1);
    let patience = Duration::from_secs(PATIENCE_S[0] + frames * PATIENCE_S[1]);
    child_process::run_again_within("--in-this-process", 1, patience, MOST_MEMORY_KB)
}

/// Whether this process must not draw.
pub fn needs_a_process(args: &RenderArgs) -> bool {
    // The other process has no standard input.
    args.shaders.any() && !args.in_this_process && !args.inputs.iter().any(|input| input == STANDARD_INPUT)
}

/// Runs in a thread with a large stack.
pub fn on_a_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, CliError> {
    std::thread::scope(|scope| {
        let drawing = std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, work);
        let drawing = drawing.map_err(|error| CliError::io("cannot start the drawing", &error))?;
        Ok(drawing.join().unwrap_or_else(|_| std::process::abort()))
    })
}
