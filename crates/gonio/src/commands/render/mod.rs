//! `gonio render`: a model or a scene as a picture, its debug views, or an animation.

mod animation;
mod plan;
pub mod shaders;
mod show;

use crate::backend::{self, Backend, BackendReport, Counts, Opened, Shot};
use crate::capture;
use crate::commands::lab::child_process;
use crate::commands::lab::draw::show::{ShownStage, line_and_column};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::values::{self, DebugView};
use crate::options::{BackendChoice, BackendOptions, GeneralOptions, SceneOptions};
use crate::output::{OutputFiles, OutputPath, color_tag};
use crate::report::{Reporter, Times};
use animation::{AnimationFile, Frames};
use clap::{ArgAction, Args};
use gonio_image::ImageError;
use gonio_image::encode::exr::{self, Layer};
use gonio_image::encode::png::{self, ColorTag};
use gonio_mesh::Diagnostic;
use gonio_render::{DisplayOptions, View};
use gonio_scene::scene_file::Shading;
use gonio_scene::{DisplayMap, Frame, Overlay, Overlays, Picture, Scene, ViewSpec};
use plan::{PictureFormat, PicturePlan, PicturePlanRequest};
use serde::Serialize;
use shaders::ShaderOptions;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Draw a model or a scene: one picture, debug views or an animation.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio render model.obj -o model.png
      The default camera, lights and shading. Needs no display.
  gonio render model.obj --shading gouraud --specular phong --size 1920x1080 -o gouraud.png
  gonio render model.obj --light \"point position=2,3,4\" --light ambient -o lit.png
      Lights that replace the scene's.
  gonio render model.obj --debug N -o normals.png
      A vector of the equation as a colour. --debug diffuse:0 shows the diffuse term of light 0.
  gonio render model.obj --overlay wireframe,boxes -o wires.png
      Triangles and boxes over the picture. --debug overdraw counts the fragments of each pixel.
  gonio render scene.toml --views normal,diffuse,specular -o all.exr
      The picture and its terms as layers of one file; with .png, each in a file of its own.
  gonio render model.obj --frames 72 --orbit 360 -o turn.gif
      A full turn around the model. With turn.png the files are turn-0001.png and so on; --animated writes one animated PNG.
  gonio render model.obj --fragment toon.frag --uniform steps=4 -o toon.png
      Your own shaders; values of their variables follow from the names, or from a names.toml beside them. --verbose lists them.
  gonio render model.obj --fragment toon.frag --show 12:15 -o normals.png
      The values of the smallest expression around line 12, column 15 of the shader, as colours.
  gonio render model.obj -o - | imv -
      To stdout.
  gonio render model.obj -o model.png --capture model.rdc
      A RenderDoc capture with every draw, texture and uniform of the frame (Debian: apt-get install librenderdoc).

Debug views: normal (N), geometric-normal, tangent, position, depth, uv, view (V), light (L), reflection (R), half (H), \
refraction (T), distance (d), attenuation (att), spot, visibility (v: 0 in a shadow), cos-theta, spec, albedo, ambient (A), emitted (E), \
diffuse, specular, total. With OpenGL also uv-checker (squares along u and v), overdraw (fragments shaded at each pixel) and nothing (the \
background, for overlays alone).

Exit codes: 0 success, 2 error.")]
pub struct RenderArgs {
    /// Models or scenes (.toml); several become one scene. builtin:NAME is a built-in model.
    ///
    /// builtin:sphere-N is a sphere of N triangles: 8, 32, 72, ... 8 f².
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,

    /// File to write: .png, .exr (linear float), .apng or .gif; - is stdout. Repeat it for several formats.
    #[arg(long, short, required = true, value_name = "FILE", action = ArgAction::Append, help_heading = "Output options",
          allow_hyphen_values = true)]
    pub output: Vec<OutputPath>,
    /// Format, if no extension determines it (stdout): png by default.
    #[arg(long, help_heading = "Output options", value_parser = values::named(PictureFormat::ALL, PictureFormat::name))]
    pub format: Option<PictureFormat>,
    /// Bits per channel of .png.
    #[arg(long, help_heading = "Output options", value_name = "8|16", value_parser = values::bits)]
    pub bits: Option<u8>,
    /// Draw a debug view instead of the picture: NAME, NAME:LIGHT, or a symbol such as N.
    ///
    /// uv-checker, overdraw and nothing need OpenGL.
    #[arg(long, help_heading = "Output options", value_name = "VIEW", value_parser = values::debug_view)]
    pub debug: Option<DebugView>,
    /// Lines over the picture: wireframe, normals, boxes (OpenGL, 8 bits).
    #[arg(long, help_heading = "Output options", value_name = "NAME,...", value_delimiter = ',', hide_possible_values = true,
          value_parser = values::named(Overlay::ALL, |overlay: Overlay| overlay.name()), conflicts_with = "capture")]
    pub overlay: Vec<Overlay>,
    /// Also write debug views: OUT-NAME.png each, or layers of one .exr.
    #[arg(long, help_heading = "Output options", value_name = "VIEW,...", value_delimiter = ',',
          value_parser = values::view_list())]
    pub views: Vec<ViewSpec>,

    /// Number of frames, in numbered files or one animation.
    ///
    /// The files are called OUT-0001.png and so on, or numbered where the name has %04d.
    #[arg(long, help_heading = "Animation options", value_name = "N", value_parser = values::frames)]
    pub frames: Option<u32>,
    /// Move the camera around its target by this angle.
    ///
    /// A full turn ends one frame before its start, so that it can be repeated.
    #[arg(long, help_heading = "Animation options", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true, requires = "frames")]
    pub orbit: Option<f64>,
    /// Frames per second, of the animation and of lights and objects that move.
    #[arg(long, help_heading = "Animation options", value_name = "RATE", value_parser = values::frame_rate,
          default_value = "24")]
    pub fps: f64,
    /// Write one animated .png instead of numbered files.
    #[arg(long, help_heading = "Animation options", requires = "frames")]
    pub animated: bool,

    /// Time of the first frame in seconds, for lights that move.
    #[arg(long, help_heading = "Light options", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub shaders: ShaderOptions,
    /// Instead of their colours, show the values of the expression here, at a line and column of one of those shaders.
    ///
    /// Numbers are grey, vectors red, green and blue; a note names the range. gonio's interpreter computes them on the CPU.
    #[arg(long, value_name = "LINE:COLUMN", value_parser = line_and_column, help_heading = "Shader options")]
    pub show: Option<[u32; 2]>,
    /// The shader that --show points into; by default the fragment shader, if there is one.
    #[arg(long, value_name = "STAGE", value_enum, requires = "show", help_heading = "Shader options")]
    pub file: Option<ShownStage>,
    /// Draw with the shaders in this process, which the caller guards.
    #[arg(long, hide = true)]
    pub in_this_process: bool,
    #[command(flatten)]
    pub backend: BackendOptions,
    /// Also write a RenderDoc capture of the first frame (OpenGL only).
    #[arg(long, help_heading = "Drawing options", value_name = "FILE.rdc")]
    pub capture: Option<PathBuf>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

impl RenderArgs {
    /// Whether overlays or special views are drawn, which exist in 8 bits only.
    fn is_shown(&self) -> bool {
        !self.overlay.is_empty() || matches!(self.debug, Some(DebugView::Special(_)))
    }

    /// The files to write.
    fn plans(&self, reporter: &Reporter) -> Result<Vec<PicturePlan>, CliError> {
        let request = PicturePlanRequest {
            outputs: &self.output,
            format: self.format,
            frames: self.frames,
            animated: self.animated,
            views: &self.views,
            bits: self.bits,
        };
        request.plan(reporter)
    }

    /// The picture and its views, each with the overlays.
    fn shows(&self, views: &[Option<ViewSpec>]) -> Vec<DisplayOptions> {
        let overlays: Overlays = self.overlay.iter().copied().collect();
        let mut shows: Vec<DisplayOptions> =
            views.iter().map(|&view| DisplayOptions { view: view.into(), overlays }).collect();
        if let (Some(DebugView::Special(special)), Some(first)) = (self.debug, shows.first_mut()) {
            first.view = View::Special(special);
        }
        shows
    }
}

/// Results of a run for its report.
#[derive(Default)]
struct Written {
    files: Vec<PathBuf>,
    counts: Counts,
    notes: Vec<String>,
}

pub fn run(args: &RenderArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    shaders::refuse(args)?;
    if let Some(place) = args.show {
        return shaders::on_a_large_stack(|| show::run(args, place, reporter))?;
    }
    if shaders::needs_a_process(args) {
        return shaders::run_in_a_process(args);
    }
    if args.in_this_process {
        child_process::end_with_the_caller();
    }
    match args.shaders.any() {
        true => shaders::on_a_large_stack(|| draw(args, reporter))?,
        false => draw(args, reporter),
    }
}

fn draw(args: &RenderArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    if let Some(target) = &args.capture {
        if args.backend.backend == BackendChoice::Cpu {
            return Err(CliError::new("--capture needs OpenGL; leave out --backend cpu"));
        }
        capture::prepare(target)?;
    }
    if args.is_shown() && args.backend.backend == BackendChoice::Cpu {
        return Err(CliError::new(
            "--overlay and the views uv-checker, overdraw and nothing need OpenGL; leave out --backend cpu",
        ));
    }
    if args.is_shown() && args.capture.is_some() {
        return Err(CliError::new("--capture records the picture and views of the equation; choose another --debug"));
    }
    let start = Instant::now();
    let times = Times::default();
    let plans = args.plans(reporter)?;
    if args.is_shown() && plans.iter().any(|p| p.format == PictureFormat::Exr || p.bits != 8) {
        return Err(CliError::new(
            "--overlay and the views uv-checker, overdraw and nothing have 8 bits per channel; write .png of 8 bits, \
             .apng or .gif",
        ));
    }
    let shaders = args.shaders.any().then(|| args.shaders.read(&args.scene.limits, reporter)).transpose()?;
    let (scene, opened) = loading::load_scene_while(&args.inputs, &args.scene, reporter, &times, || {
        Opened::new(&args.backend, args.capture.as_deref(), &times)
    });
    let mut scene = scene?.at(args.time);
    reporter.diagnostics(&scene.diagnostics);
    let views = || args.views.iter().copied().chain(args.debug.and_then(DebugView::quantity));
    loading::check_views(views(), &scene)?;
    if views().any(|view| view.quantity == gonio_light::Quantity::Tangent) {
        scene.add_tangents();
    }
    let (width, height) = (scene.settings.picture.width, scene.settings.picture.height);
    let opened = opened?.for_size(width, height, &args.backend)?;
    let drawing = match &shaders {
        Some(shaders) => Some(shaders.for_backend(&opened, &args.shaders, &mut scene, reporter)?),
        None => None,
    };
    let mut backend = opened.take_scene(&scene, &args.backend, reporter, &times)?;
    if let Some(drawing) = drawing {
        backend.draw_with(drawing, &scene);
    }
    if args.backend.backend == BackendChoice::Auto || backend.interprets_shaders() {
        reporter.note(backend.sentence());
    }

    if shaders.is_none() && plans.iter().all(|p| p.format != PictureFormat::Exr && p.bits == 8) {
        backend.for_eight_bits();
    }
    if let Some(driver) = backend.driver() {
        reporter.verbose(format_args!("driver: {}", backend::driver_line(driver)));
    }
    let files = OutputFiles::new();
    let mut drawing = Drawing { args, plans: &plans, reporter, times: &times, files, written: Written::default() };
    drawing.draw_frames(&scene, &mut backend)?;
    let Drawing { files, written, .. } = drawing;
    times.measure("write", || files.commit())?;
    for note in &written.notes {
        reporter.note(note);
    }
    times.add("total", start.elapsed());
    reporter.verbose_times(&times);
    if reporter.json() {
        reporter.report(&Report::new(args, &scene, &backend, &times, &written))?;
    }
    // The process ends next, and the system frees buffers and contexts faster.
    std::mem::forget(backend);
    std::mem::forget(scene);
    Ok(CommandOutcome::Done)
}

/// The drawing of all frames and views into all outputs.
struct Drawing<'a> {
    args: &'a RenderArgs,
    plans: &'a [PicturePlan],
    reporter: &'a Reporter,
    times: &'a Times,
    files: OutputFiles,
    written: Written,
}

impl Drawing<'_> {
    fn draw_frames(&mut self, scene: &Scene, backend: &mut Backend) -> Result<(), CliError> {
        let count = self.args.frames.unwrap_or(1);
        let frames = Frames::new(scene, self.args.time, count, self.args.fps, self.args.orbit);
        let mut animations: Vec<Option<AnimationFile>> = self
            .plans
            .iter()
            .map(|p| p.format.is_animation().then(|| AnimationFile::new(p.format, count, self.args.fps)))
            .collect();
        let progress = (count > 1).then(|| self.reporter.progress("frames"));
        for index in 0..count {
            if let Some(moved) = frames.scene_at(index).filter(|_| index > 0) {
                backend.follow(&moved, self.times)?;
            }
            self.draw_frame(index, &frames.at(index), backend, &mut animations)?;
            if let Some(progress) = &progress {
                progress.set(f64::from(index + 1) / f64::from(count));
            }
        }
        for (plan, animation) in self.plans.iter().zip(animations) {
            if let Some(animation) = animation {
                let bytes = self.times.measure("encode", || animation.finish())?;
                self.write(plan, 0, None, bytes)?;
            }
        }
        Ok(())
    }

    /// Draws one frame and its views into every output.
    fn draw_frame(
        &mut self,
        index: u32,
        frame: &Frame,
        backend: &mut Backend,
        animations: &mut [Option<AnimationFile>],
    ) -> Result<(), CliError> {
        let first = self.args.debug.and_then(DebugView::quantity);
        let views: Vec<Option<ViewSpec>> =
            std::iter::once(first).chain(self.args.views.iter().copied().map(Some)).collect();
        let shows = self.args.is_shown().then(|| self.args.shows(&views));
        let mut layers: Vec<(String, Picture)> = Vec::new();
        let wants_layers = self.plans.iter().any(|p| p.format == PictureFormat::Exr);
        let (reporter, times) = (self.reporter, self.times);
        let each = |place: usize, shot: Shot| {
            let view = views[place];
            if index == 0 && place == 0 {
                self.written.counts = shot.counts();
                self.written.notes.extend_from_slice(shot.notes());
            }
            if wants_layers {
                let name = view.map_or_else(|| "picture".to_owned(), |v| v.to_string().replace(':', "-"));
                layers.push((name, times.measure("read_back", || shot.linear())?));
            }
            // The first has the name of the output itself.
            let own_name = view.filter(|_| place > 0);
            self.encode(index, frame, view, own_name, &shot, animations)
        };
        match shows {
            Some(shows) => backend.draw_shown(frame, &shows, reporter, times, each)?,
            None => backend.draw(frame, &views, reporter, times, each)?,
        }
        for plan in self.plans.iter().filter(|p| p.format == PictureFormat::Exr) {
            let bytes = self.times.measure("encode", || encode_layers(&layers))?;
            self.write(plan, index, None, bytes)?;
        }
        Ok(())
    }

    fn encode(
        &mut self,
        index: u32,
        frame: &Frame,
        view: Option<ViewSpec>,
        own_name: Option<ViewSpec>,
        shot: &Shot,
        animations: &mut [Option<AnimationFile>],
    ) -> Result<(), CliError> {
        let times = self.times;
        let tag = match self.args.shaders.any() {
            // The colours of the shaders are shown as they are.
            true => ColorTag::Srgb,
            false => color_tag(&DisplayMap::for_view(view, frame)),
        };
        for (plan, animation) in self.plans.iter().zip(animations) {
            let bytes = match (plan.format, animation) {
                (PictureFormat::Exr, _) => continue,
                (_, Some(animation)) => {
                    let picture = times.measure("read_back", || shot.encoded8())?;
                    times.measure("encode", || animation.add(picture.into_owned(), tag))?;
                    continue;
                }
                _ if plan.bits == 16 => {
                    let picture = times.measure("read_back", || shot.encoded16())?;
                    times.measure("encode", || png::encode16(&picture, tag))?
                }
                _ => {
                    let picture = times.measure("read_back", || shot.encoded8())?;
                    times.measure("encode", || png::encode8(&picture, tag))?
                }
            };
            self.write(plan, index, own_name, bytes)?;
        }
        Ok(())
    }

    fn write(
        &mut self,
        plan: &PicturePlan,
        frame: u32,
        view: Option<ViewSpec>,
        bytes: Vec<u8>,
    ) -> Result<(), CliError> {
        let output = plan.output(frame, view);
        self.times.measure("write", || self.files.add_output(&output, bytes))?;
        self.written.files.extend(output.file().map(Path::to_owned));
        Ok(())
    }
}

/// All pictures as layers of one file; they have one size.
fn encode_layers(pictures: &[(String, Picture)]) -> Result<Vec<u8>, ImageError> {
    let size = pictures.first().map_or([0, 0], |(_, first)| [first.width, first.height]);
    let layers: Vec<Layer<'_>> =
        pictures.iter().map(|(name, picture)| Layer { name, pixels: &picture.pixels }).collect();
    exr::encode_layers(size, &layers)
}

/// The report. Times are in milliseconds, sizes in pixels.
#[derive(Serialize)]
struct Report<'a> {
    command: &'static str,
    inputs: &'a [String],
    outputs: Vec<String>,
    backend: BackendReport,
    width: u32,
    height: u32,
    samples: u32,
    frames: u32,
    shading: Vec<Shading>,
    debug: Option<String>,
    views: Vec<String>,
    scene: SceneCounts,
    drawn: Counts,
    times_ms: serde_json::Value,
    warnings: &'a [Diagnostic],
    notes: &'a [String],
}

/// The size of a scene.
#[derive(Serialize)]
struct SceneCounts {
    objects: usize,
    triangles: usize,
    vertices: usize,
    materials: usize,
    textures: usize,
    lights: usize,
}

impl SceneCounts {
    /// Counts a mesh once for each object that shows it.
    fn count(scene: &Scene) -> Self {
        let meshes = || scene.objects.iter().filter_map(|o| scene.meshes.get(o.mesh));
        SceneCounts {
            objects: scene.objects.len(),
            triangles: meshes().map(|m| m.triangle_count()).sum(),
            vertices: meshes().map(|m| m.positions.len()).sum(),
            materials: scene.materials.len(),
            textures: scene.textures.len(),
            lights: scene.settings.lights.len(),
        }
    }
}

impl<'a> Report<'a> {
    fn new(args: &'a RenderArgs, scene: &'a Scene, backend: &Backend, times: &Times, written: &'a Written) -> Self {
        let picture = &scene.settings.picture;
        let shading: BTreeSet<Shading> = scene.objects.iter().map(|o| o.shading).collect();
        Report {
            command: "render",
            inputs: &args.inputs,
            outputs: written.files.iter().map(|p| p.display().to_string()).collect(),
            backend: backend.report(),
            width: picture.width,
            height: picture.height,
            samples: picture.samples,
            frames: args.frames.unwrap_or(1),
            shading: shading.into_iter().collect(),
            debug: args.debug.map(|v| v.to_string()),
            views: args.views.iter().map(ToString::to_string).collect(),
            scene: SceneCounts::count(scene),
            drawn: written.counts,
            times_ms: times.to_json(),
            warnings: &scene.diagnostics,
            notes: &written.notes,
        }
    }
}
