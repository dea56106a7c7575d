//! The two renderers, OpenGL and the CPU reference, behind one interface.

use crate::capture::CaptureRecorder;
use crate::error::CliError;
use crate::options::{BackendChoice, BackendOptions};
use crate::report::{Reporter, Times};
use crate::user_drawing::{UserDrawing, interpreter_sentence, shaded};
use gonio_check::user_shaders::UserShaderProgram;
use gonio_exercises::step::{ShadedPicture, UserPair};
use gonio_gl::{DriverInfo, Gl, GlError, GpuStatistics, HeadlessContext};
use gonio_reference::{ReferenceScene, Rendered};
use gonio_render::{DisplayOptions, GpuScene, RenderedFrame, RenderedPicture, Renderer, shown_unchanged};
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{DisplayMap, Frame, Picture, Scene, ViewSpec};
use serde::Serialize;
use std::borrow::Cow;
use std::path::Path;

/// A backend without a scene, created while the scene is being read.
pub enum Opened {
    Gl(Box<OpenGl>),
    /// The CPU, and the reason if OpenGL was preferred.
    Cpu {
        reason: Option<String>,
    },
}

/// A context and the renderer in it.
pub struct OpenGl {
    // The order matters: the renderer frees its objects while the context exists.
    renderer: Renderer,
    context: HeadlessContext,
    /// Captures the first picture.
    recorder: Option<CaptureRecorder>,
    /// Only pictures of 8 bits per channel are needed.
    eight_bits: bool,
    /// The user's program that draws instead of gonio's, and the scene that it draws.
    user: Option<(UserShaderProgram, Scene)>,
}

impl OpenGl {
    /// Draws one picture for RenderDoc: encoded, and in one piece, so that each object is drawn once. The picture that is
    /// written is drawn afterwards, as without a capture.
    fn record(
        &mut self,
        mut recorder: CaptureRecorder,
        scene: &GpuScene,
        frame: &Frame,
        view: Option<ViewSpec>,
    ) -> Result<(), CliError> {
        recorder.start();
        self.renderer.render(scene, frame, view)?.encoded8()?;
        recorder.finish(self.context.gl())
    }
}

/// Sets the number of threads, before anything has used them.
pub fn limit_threads(threads: Option<u16>) {
    if let Some(threads) = threads {
        // Fails only if the pool exists already.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
}

impl Opened {
    /// Creates the backend that the options ask for; `auto` falls back on the CPU.
    ///
    /// RenderDoc must know of a `capture` before OpenGL is loaded. [`crate::capture::prepare`] has made it possible.
    pub fn new(options: &BackendOptions, capture: Option<&Path>, times: &Times) -> Result<Opened, CliError> {
        limit_threads(options.threads);
        if options.backend == BackendChoice::Cpu {
            return Ok(Opened::Cpu { reason: None });
        }
        let recorder = capture.map(CaptureRecorder::new).transpose()?;
        match times.measure("context", || open_gl(options)) {
            Ok((renderer, context)) => {
                Ok(Opened::Gl(Box::new(OpenGl { renderer, context, recorder, eight_bits: false, user: None })))
            }
            Err(error) if options.backend == BackendChoice::Auto && capture.is_none() => {
                Ok(Opened::Cpu { reason: Some(error.message) })
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Falls back on the CPU if pictures of this size are larger than the driver can draw.
    pub fn for_size(self, width: u32, height: u32, options: &BackendOptions) -> Result<Opened, CliError> {
        match self {
            Opened::Gl(gl) if width.max(height) > gl.renderer.info().max_size => {
                let reason = format!(
                    "{width}x{height} is too large for this driver, which draws at most {} pixels along a side",
                    gl.renderer.info().max_size
                );
                if options.backend == BackendChoice::Gl {
                    return Err(CliError::new(format!("{reason}; `--backend cpu` draws it")));
                }
                if gl.recorder.is_some() {
                    return Err(CliError::new(format!("{reason}, so it cannot be captured; choose a smaller --size")));
                }
                Ok(Opened::Cpu { reason: Some(reason) })
            }
            other => Ok(other),
        }
    }

    /// Returns the renderer if OpenGL draws.
    pub fn renderer(&mut self) -> Option<&mut Renderer> {
        match self {
            Opened::Gl(gl) => Some(&mut gl.renderer),
            Opened::Cpu { .. } => None,
        }
    }

    /// The context that compiles the user's shaders; `None` if the CPU runs them.
    pub fn gl_for_shaders(&self) -> Option<&Gl> {
        match self {
            Opened::Gl(gl) => Some(gl.context.gl()),
            Opened::Cpu { .. } => None,
        }
    }

    pub fn report(&self) -> BackendReport {
        match self {
            Opened::Gl(gl) => BackendReport::new(Some(gl.renderer.info()), None),
            Opened::Cpu { reason } => BackendReport::new(None, reason.as_deref()),
        }
    }

    pub fn sentence(&self) -> String {
        match self {
            Opened::Gl(gl) => sentence(Some(gl.renderer.info()), None),
            Opened::Cpu { reason } => sentence(None, reason.as_deref()),
        }
    }

    /// Uploads the scene to the GPU, or sorts its triangles for the CPU.
    pub fn take_scene(
        self,
        scene: &Scene,
        options: &BackendOptions,
        reporter: &Reporter,
        times: &Times,
    ) -> Result<Backend, CliError> {
        let picture = &scene.settings.picture;
        let opened = self.for_size(picture.width, picture.height, options)?;
        match opened {
            Opened::Gl(mut gl) => {
                let _busy = reporter.busy("copying the scene to the GPU");
                let gpu = Box::new(times.measure("upload", || gl.renderer.upload(scene))?);
                Ok(Backend::Gl { gl, gpu })
            }
            Opened::Cpu { reason } => {
                let _busy = reporter.busy("sorting the triangles");
                let scene = Box::new(times.measure("upload", || ReferenceScene::new(scene)));
                Ok(Backend::Cpu { scene, reason, user: None })
            }
        }
    }
}

fn open_gl(options: &BackendOptions) -> Result<(Renderer, HeadlessContext), GlError> {
    let context = open_context(options)?;
    Ok((Renderer::new(context.gl().clone())?, context))
}

/// The driver of a new context without a window.
pub fn find_driver(options: &BackendOptions) -> Result<DriverInfo, GlError> {
    let (renderer, context) = open_gl(options)?;
    let driver = renderer.info().clone();
    // The process ends soon; the system frees the context faster.
    std::mem::forget((renderer, context));
    Ok(driver)
}

/// The version and the renderer of a driver.
pub fn driver_line(driver: &DriverInfo) -> String {
    format!("{}, GLSL {}, {}", driver.version, driver.glsl, driver.renderer)
}

/// Reports the driver with `--verbose`, for commands whose own context is elsewhere.
pub fn report_driver(reporter: &Reporter) {
    if reporter.is_verbose() {
        match find_driver(&BackendOptions::default()) {
            Ok(driver) => reporter.verbose(format_args!("driver: {}", driver_line(&driver))),
            Err(error) => reporter.verbose(format_args!("driver: none: {}", first_line(&error))),
        }
    }
}

/// The first line of an error's message; a driver may add more.
pub fn first_line(error: &GlError) -> &str {
    error.message.lines().next().unwrap_or_default()
}

pub fn open_context(options: &BackendOptions) -> Result<HeadlessContext, GlError> {
    HeadlessContext::with_options(&gonio_gl::headless::HeadlessOptions {
        egl_library: options.egl_library.as_ref().map(Into::into),
        ..Default::default()
    })
}

/// A backend with its scene.
pub enum Backend {
    Gl {
        gl: Box<OpenGl>,
        gpu: Box<GpuScene>,
    },
    Cpu {
        scene: Box<ReferenceScene>,
        /// The reason for the CPU if OpenGL was preferred.
        reason: Option<String>,
        /// The user's shaders that draw instead of the light equation, and the scene that they draw.
        user: Option<Box<(UserPair, Scene)>>,
    },
}

/// The backend in a report.
#[derive(Clone, Debug, Serialize)]
pub struct BackendReport {
    /// `gl` or `cpu`
    pub name: &'static str,
    /// `GL_RENDERER`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub renderer: Option<String>,
    /// `GL_VERSION`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// `GL_SHADING_LANGUAGE_VERSION`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub glsl: Option<String>,
    /// The reason for the CPU if OpenGL was preferred.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Backend {
    /// Draws with the user's shaders from now on, which were compiled for this backend.
    pub fn draw_with(&mut self, drawing: UserDrawing, scene: &Scene) {
        match (self, drawing) {
            (Backend::Gl { gl, .. }, UserDrawing::Gl(program)) => gl.user = Some((program, scene.clone())),
            (Backend::Cpu { user, .. }, UserDrawing::Cpu(pair)) => *user = Some(Box::new((pair, scene.clone()))),
            (Backend::Gl { .. }, UserDrawing::Cpu(_)) | (Backend::Cpu { .. }, UserDrawing::Gl(_)) => {}
        }
    }

    /// Takes the scene at another time: objects have moved. The GPU's meshes and textures stay.
    pub fn follow(&mut self, moved: &Scene, times: &Times) -> Result<(), CliError> {
        times.measure("upload", || match self {
            Backend::Gl { gl, gpu } => {
                **gpu = gl.renderer.upload(moved)?;
                if let Some((_, scene)) = &mut gl.user {
                    *scene = moved.clone();
                }
                Ok(())
            }
            Backend::Cpu { scene, user, .. } => {
                **scene = ReferenceScene::new(moved);
                if let Some(user) = user {
                    user.1 = moved.clone();
                }
                Ok(())
            }
        })
    }

    /// Draws the picture (`None`) and debug views of one frame, and calls `each` for each with its index in `views`. The CPU
    /// traces its rays once for all of them; a picture leaves the GPU before the next is drawn.
    pub fn draw(
        &mut self,
        frame: &Frame,
        views: &[Option<ViewSpec>],
        reporter: &Reporter,
        times: &Times,
        mut each: impl FnMut(usize, Shot) -> Result<(), CliError>,
    ) -> Result<(), CliError> {
        match self {
            Backend::Gl { gl, gpu } => {
                if let (Some(recorder), Some(&first)) = (gl.recorder.take(), views.first()) {
                    let _busy = reporter.busy("capturing");
                    times.measure("capture", || gl.record(recorder, gpu, frame, first))?;
                }
                for (index, &view) in views.iter().enumerate() {
                    let shot = {
                        let _busy = reporter.busy("drawing");
                        let OpenGl { renderer, user, eight_bits, .. } = &mut **gl;
                        times.measure("draw", || match (user, eight_bits) {
                            (Some((program, scene)), _) => program
                                .with_pass(scene, frame, |pass| renderer.render_user_pass(gpu, frame, pass))
                                .map(Shot::Gl),
                            (None, true) => renderer.render8(gpu, frame, view).map(Shot::Gl8),
                            (None, false) => renderer.render(gpu, frame, view).map(Shot::Gl),
                        })?
                    };
                    each(index, shot)?;
                }
            }
            Backend::Cpu { scene, user: Some(user), .. } => {
                let shaded = {
                    let progress = reporter.progress("drawing");
                    times.measure("draw", || shaded(user, scene, frame, &|share| progress.set(share)))?
                };
                let ShadedPicture { picture, vertices, fragments } = shaded;
                let map = DisplayMap::for_view(None, &shown_unchanged(frame));
                each(0, Shot::Cpu(Rendered { picture, vertices, fragments }, map))?;
            }
            Backend::Cpu { scene, .. } => {
                let picture = ViewSpec { quantity: gonio_light::Quantity::Total, light: None };
                let quantities: Vec<ViewSpec> = views.iter().map(|v| v.unwrap_or(picture)).collect();
                let rendered = {
                    let progress = reporter.progress("drawing");
                    times.measure("draw", || scene.views(frame, &quantities, &|share| progress.set(share)))
                };
                for (index, rendered) in rendered.into_iter().enumerate() {
                    each(index, Shot::Cpu(rendered, DisplayMap::for_view(views[index], frame)))?;
                }
            }
        }
        Ok(())
    }

    /// Draws pictures with overlays, or special views, which takes OpenGL, in 8 bits per channel.
    pub fn draw_shown(
        &mut self,
        frame: &Frame,
        shows: &[DisplayOptions],
        reporter: &Reporter,
        times: &Times,
        mut each: impl FnMut(usize, Shot) -> Result<(), CliError>,
    ) -> Result<(), CliError> {
        let Backend::Gl { gl, gpu } = self else {
            return Err(CliError::new(
                "--overlay and the views uv-checker, overdraw and nothing need OpenGL, which is not available here; \
                 `gonio render` without them reports the reason",
            ));
        };
        for (index, show) in shows.iter().enumerate() {
            let shot = {
                let _busy = reporter.busy("drawing");
                times.measure("draw", || gl.renderer.render_shown8(gpu, frame, show).map(Shot::Gl8))?
            };
            each(index, shot)?;
        }
        Ok(())
    }

    /// Promises that only pictures of 8 bits per channel will be read, which OpenGL draws faster.
    pub fn for_eight_bits(&mut self) {
        if let Backend::Gl { gl, .. } = self {
            gl.eight_bits = true;
        }
    }

    /// The OpenGL driver, if OpenGL draws.
    pub fn driver(&self) -> Option<&DriverInfo> {
        match self {
            Backend::Gl { gl, .. } => Some(gl.renderer.info()),
            Backend::Cpu { .. } => None,
        }
    }

    pub fn report(&self) -> BackendReport {
        BackendReport::new(self.driver(), self.reason())
    }

    /// A sentence that names the backend, and the reason for it.
    pub fn sentence(&self) -> String {
        match (self, self.reason()) {
            (Backend::Cpu { user: Some(_), .. }, reason) => interpreter_sentence(reason),
            (_, reason) => sentence(self.driver(), reason),
        }
    }

    /// Whether the user's shaders run on the CPU.
    pub fn interprets_shaders(&self) -> bool {
        matches!(self, Backend::Cpu { user: Some(_), .. })
    }

    fn reason(&self) -> Option<&str> {
        match self {
            Backend::Cpu { reason, .. } => reason.as_deref(),
            Backend::Gl { .. } => None,
        }
    }
}

impl BackendReport {
    fn new(driver: Option<&DriverInfo>, reason: Option<&str>) -> Self {
        BackendReport {
            name: if driver.is_some() { "gl" } else { "cpu" },
            renderer: driver.map(|d| d.renderer.clone()),
            version: driver.map(|d| d.version.clone()),
            glsl: driver.map(|d| d.glsl.clone()),
            reason: reason.map(str::to_owned),
        }
    }
}

fn sentence(driver: Option<&DriverInfo>, reason: Option<&str>) -> String {
    match (driver, reason) {
        (Some(driver), _) => format!("drawn by OpenGL ({})", driver.renderer),
        (None, Some(reason)) => format!("drawn by the CPU reference: {reason}"),
        (None, None) => "drawn by the CPU reference".into(),
    }
}

/// A finished frame.
pub enum Shot {
    /// On the GPU.
    Gl(RenderedFrame),
    /// Has 8 bits per channel only.
    Gl8(RenderedPicture),
    /// Has the map from its values to displayed ones.
    Cpu(Rendered, DisplayMap),
}

/// Counters of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Vertices that were lit or transformed.
    pub vertices: Option<u64>,
    /// Fragments that were lit.
    pub fragments: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub draw_calls: Option<u32>,
}

impl Shot {
    /// The linear values, premultiplied by alpha.
    pub fn linear(&self) -> Result<Picture, CliError> {
        match self {
            Shot::Gl(drawn) => Ok(drawn.linear()?),
            Shot::Gl8(_) => Err(only_eight_bits()),
            Shot::Cpu(rendered, _) => Ok(rendered.picture.clone()),
        }
    }

    /// The displayed values in 8 bits.
    pub fn encoded8(&self) -> Result<Cow<'_, EncodedPicture<u8>>, CliError> {
        match self {
            Shot::Gl(drawn) => Ok(Cow::Owned(drawn.encoded8()?)),
            Shot::Gl8(drawn) => Ok(Cow::Borrowed(&drawn.picture)),
            Shot::Cpu(rendered, map) => Ok(Cow::Owned(rendered.picture.encode8(map))),
        }
    }

    /// The displayed values in 16 bits.
    pub fn encoded16(&self) -> Result<EncodedPicture<u16>, CliError> {
        match self {
            Shot::Gl(drawn) => Ok(drawn.encoded16()?),
            Shot::Gl8(_) => Err(only_eight_bits()),
            Shot::Cpu(rendered, map) => Ok(rendered.picture.encode16(map)),
        }
    }

    pub fn counts(&self) -> Counts {
        let gpu_counts = |statistics: &GpuStatistics| Counts {
            vertices: statistics.vertices,
            fragments: statistics.fragments,
            draw_calls: Some(statistics.draw_calls),
        };
        match self {
            Shot::Gl(drawn) => gpu_counts(&drawn.statistics),
            Shot::Gl8(drawn) => gpu_counts(&drawn.statistics),
            Shot::Cpu(rendered, _) => {
                Counts { vertices: Some(rendered.vertices), fragments: Some(rendered.fragments), draw_calls: None }
            }
        }
    }

    /// Notes about requests that could not be met exactly.
    pub fn notes(&self) -> &[String] {
        match self {
            Shot::Gl(drawn) => &drawn.notes,
            Shot::Gl8(drawn) => &drawn.notes,
            Shot::Cpu(..) => &[],
        }
    }
}

/// The error of a frame that was drawn for 8 bits although more were needed.
fn only_eight_bits() -> CliError {
    CliError::new(
        "this frame was drawn with 8 bits per channel and has no finer values; this is a bug, please report it",
    )
}
