//! `gonio render`: a model or a scene as a picture, its debug views, or an animation.

mod frames;
mod report;

use crate::backend::{Backend, BackendChoice, Counts, Opened, Shot};
use crate::capture;
use crate::cli::{self, BackendOptions, SceneOptions, WordOptions};
use crate::loading;
use crate::output::animation::Animation;
use crate::output::{FileSet, Format, Plan, PlanRequest, Target};
use crate::report::{CliError, Outcome, Reporter, Times};
use crate::values::{self, DebugView};
use clap::{ArgAction, Args};
use gonio_image::ImageError;
use gonio_image::encode::exr::{self, Layer};
use gonio_image::encode::png::{self, ColorTag};
use gonio_light::color::ColorEncoding;
use gonio_render::{DisplayOptions, View};
use gonio_scene::{DisplayMap, Frame, Overlay, Overlays, Picture, Scene, ViewSpec};
use std::path::PathBuf;
use std::time::Instant;

/// Draw a model or a scene: one picture, debug views, or an animation.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio render model.obj -o model.png
      Framed, lit and shaded pleasantly; no display is needed.
  gonio render model.obj --shading gouraud --specular phong --size 1920x1080 -o gouraud.png
  gonio render model.obj --light \"point position=2,3,4 color=#ffe0c0\" --light \"ambient color=0.1\" -o lit.png
      Lights of your own in place of the scene's.
  gonio render model.obj --debug N -o normals.png
      A vector of the equation as a colour; a light's own by number: --debug diffuse:0.
  gonio render model.obj --overlay wireframe,boxes -o wires.png
      Triangles and boxes over the picture; --debug overdraw counts the fragments of each pixel.
  gonio render scene.toml --views normal,diffuse,specular -o all.exr
      The picture and its terms as layers of one file (with .png: one file each).
  gonio render model.obj --frames 72 --orbit 360 -o turn.gif
      Around the model; turn.png would give turn-0001.png and so on, --animated one animated PNG.
  gonio render model.obj -o - | imv -
      To stdout.
  gonio render model.obj -o model.png --capture model.rdc
      Every draw, texture and uniform of the frame, for RenderDoc (Debian: apt-get install librenderdoc).

Debug views: normal (N), geometric-normal, tangent, position, depth, uv, view (V), light (L), reflection (R),
half (H), refraction (T), distance (d), attenuation (att), spot, cos-theta, spec, albedo, ambient (A),
emitted (E), diffuse, specular, total. With OpenGL also uv-checker (squares along u and v), overdraw (fragments
shaded at each pixel) and nothing (the background, for overlays by themselves).

Exit codes: 0 done, 2 error. Where stdout is closed before the picture is written, 2 without a word.")]
pub struct RenderArgs {
    /// Models (.obj) or scenes (.toml); several become one scene. builtin:NAME is a model that gonio carries;
    /// builtin:sphere-N is a sphere of N triangles: 8, 32, 72, ... 8 f².
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<String>,

    /// Where to: .png, .exr (linear float), .apng, .gif, or - for stdout. Repeat it for several formats.
    #[arg(long, short, required = true, value_name = "FILE", action = ArgAction::Append, help_heading = "Output",
          allow_hyphen_values = true)]
    pub output: Vec<String>,
    /// The format, where no extension tells it (stdout): png by default.
    #[arg(long, help_heading = "Output", value_parser = values::named(Format::ALL, Format::name))]
    pub format: Option<Format>,
    /// Bits a channel of .png.
    #[arg(long, help_heading = "Output", value_name = "8|16", value_parser = values::bits)]
    pub bits: Option<u8>,
    /// A debug view in place of the picture: NAME, NAME:LIGHT, or a symbol such as N; uv-checker, overdraw (OpenGL).
    #[arg(long, help_heading = "Output", value_name = "VIEW", value_parser = values::debug_view)]
    pub debug: Option<DebugView>,
    /// Lines over the picture: wireframe, normals, boxes (OpenGL, 8 bits).
    #[arg(long, help_heading = "Output", value_name = "WHAT,...", value_delimiter = ',',
          value_parser = values::named(Overlay::ALL, |overlay: Overlay| overlay.name()), conflicts_with = "capture")]
    pub overlay: Vec<Overlay>,
    /// Debug views beside the picture: OUT-NAME.png each, or layers of one .exr.
    #[arg(long, help_heading = "Output", value_name = "VIEW,...", value_delimiter = ',',
          value_parser = cli::view_list())]
    pub views: Vec<ViewSpec>,

    /// How many frames: numbered files (OUT-0001.png, or where %04d stands), or one animation.
    #[arg(long, help_heading = "Animation", value_name = "N", value_parser = values::frames)]
    pub frames: Option<u32>,
    /// The camera goes around what it looks at by so many degrees (a full turn ends just before its start).
    #[arg(long, help_heading = "Animation", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true, requires = "frames")]
    pub orbit: Option<f64>,
    /// Frames a second: of the animation, and of the lights that move.
    #[arg(long, help_heading = "Animation", value_name = "RATE", value_parser = frame_rate, default_value = "24")]
    pub fps: f64,
    /// One animated .png instead of numbered files.
    #[arg(long, help_heading = "Animation", requires = "frames")]
    pub animated: bool,

    /// Seconds: where moving lights are, in the first frame.
    #[arg(long, help_heading = "Lights", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub time: f64,
    /// Every option that replaces something of the scene.
    #[command(flatten)]
    pub scene: SceneOptions,
    /// Who draws.
    #[command(flatten)]
    pub backend: BackendOptions,
    /// Also write a RenderDoc capture of the first frame (OpenGL only), for RenderDoc's own window.
    #[arg(long, help_heading = "Drawing", value_name = "FILE.rdc")]
    pub capture: Option<PathBuf>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

fn frame_rate(text: &str) -> Result<f64, String> {
    match values::number(text)? {
        rate if (0.02..=1000.0).contains(&rate) => Ok(rate),
        _ => Err(format!("`{text}` is no frame rate; 0.02 to 1000 is wanted")),
    }
}

impl RenderArgs {
    /// Whether something is asked for that is drawn for the eye only: overlays, special views.
    fn is_shown(&self) -> bool {
        !self.overlay.is_empty() || matches!(self.debug, Some(DebugView::Special(_)))
    }

    /// The picture and its views, with the overlays over each.
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

/// What a run gathers for its report.
#[derive(Default)]
struct Done {
    files: Vec<PathBuf>,
    counts: Counts,
    notes: Vec<String>,
}

/// Draws and writes.
pub fn run(args: &RenderArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    if let Some(target) = &args.capture {
        if args.backend.backend == BackendChoice::Cpu {
            return Err(CliError::new("--capture needs OpenGL; leave --backend cpu out"));
        }
        capture::prepare(target)?;
    }
    if args.is_shown() && args.backend.backend == BackendChoice::Cpu {
        return Err(CliError::new(
            "--overlay and the views uv-checker, overdraw and nothing need OpenGL; leave --backend cpu out",
        ));
    }
    if args.is_shown() && args.capture.is_some() {
        return Err(CliError::new("--capture records pictures and views of the equation; take another --debug for it"));
    }
    let start = Instant::now();
    let times = Times::default();
    let plans = PlanRequest {
        outputs: &args.output,
        format: args.format,
        frames: args.frames,
        animated: args.animated,
        views: &args.views,
        bits: args.bits,
    }
    .plan(reporter)?;
    if args.is_shown() && plans.iter().any(|p| p.format == Format::Exr || p.bits != 8) {
        return Err(CliError::new(
            "--overlay and the views uv-checker, overdraw and nothing are drawn for the eye; write .png of 8 bits, \
             .apng or .gif",
        ));
    }
    let (scene, opened) = loading::load_scene_while(&args.inputs, &args.scene, reporter, &times, || {
        Opened::new(&args.backend, args.capture.as_deref(), &times)
    });
    let mut scene = scene?;
    reporter.diagnostics(&scene.diagnostics);
    let views = || args.views.iter().copied().chain(args.debug.and_then(DebugView::quantity));
    loading::check_views(views(), &scene)?;
    if views().any(|view| view.quantity == gonio_light::Quantity::Tangent) {
        scene.add_tangents();
    }
    let mut backend = opened?.take_scene(&scene, &args.backend, reporter, &times)?;
    if args.backend.backend == BackendChoice::Auto {
        reporter.note(backend.sentence());
    }

    if plans.iter().all(|p| p.format != Format::Exr && p.bits == 8) {
        backend.for_eight_bits();
    }
    let mut work = Work { args, plans: &plans, reporter, times: &times, set: FileSet::new(), done: Done::default() };
    work.frames(&scene, &mut backend)?;
    let Work { set, done, .. } = work;
    times.measure("write", || set.commit())?;
    for note in &done.notes {
        reporter.note(note);
    }
    times.add("total", start.elapsed());
    if reporter.json() {
        reporter.report(&report::Report::new(args, &scene, &backend, &times, &done))?;
    }
    // The process ends next; the system frees buffers and contexts faster than one by one.
    std::mem::forget(backend);
    std::mem::forget(scene);
    Ok(Outcome::Done)
}

struct Work<'a> {
    args: &'a RenderArgs,
    plans: &'a [Plan],
    reporter: &'a Reporter,
    times: &'a Times,
    set: FileSet,
    done: Done,
}

impl Work<'_> {
    fn frames(&mut self, scene: &Scene, backend: &mut Backend) -> Result<(), CliError> {
        let count = self.args.frames.unwrap_or(1);
        let frames = frames::Frames::new(scene, self.args.time, count, self.args.fps, self.args.orbit);
        let mut animations: Vec<Option<Animation>> = self
            .plans
            .iter()
            .map(|p| p.format.is_animation().then(|| Animation::new(p.format, count, self.args.fps)))
            .collect();
        let progress = (count > 1).then(|| self.reporter.progress("frames"));
        for index in 0..count {
            self.frame(index, &frames.at(index), backend, &mut animations)?;
            if let Some(progress) = &progress {
                progress.set(f64::from(index + 1) / f64::from(count));
            }
        }
        for (plan, animation) in self.plans.iter().zip(animations) {
            if let Some(animation) = animation {
                let bytes = self.times.measure("encode", || animation.finish())?;
                self.write(plan, 0, None, &bytes)?;
            }
        }
        Ok(())
    }

    /// Draws one frame and its views, and hands them to every output.
    fn frame(
        &mut self,
        index: u32,
        frame: &Frame,
        backend: &mut Backend,
        animations: &mut [Option<Animation>],
    ) -> Result<(), CliError> {
        let first = self.args.debug.and_then(DebugView::quantity);
        let views: Vec<Option<ViewSpec>> =
            std::iter::once(first).chain(self.args.views.iter().copied().map(Some)).collect();
        let shows = self.args.is_shown().then(|| self.args.shows(&views));
        let mut layers: Vec<(String, Picture)> = Vec::new();
        let wants_layers = self.plans.iter().any(|p| p.format == Format::Exr);
        let (reporter, times) = (self.reporter, self.times);
        let each = |place: usize, shot: Shot| {
            let view = views[place];
            if index == 0 && place == 0 {
                self.done.counts = shot.counts();
                self.done.notes.extend_from_slice(shot.notes());
            }
            if wants_layers {
                let name = view.map_or_else(|| "picture".to_owned(), |v| v.to_string().replace(':', "-"));
                layers.push((name, times.measure("read_back", || shot.linear())?));
            }
            // The first is the picture that was asked for, by the name that was asked for.
            let own_name = view.filter(|_| place > 0);
            self.encode(index, frame, view, own_name, &shot, animations)
        };
        match shows {
            Some(shows) => backend.draw_shown(frame, &shows, reporter, times, each)?,
            None => backend.draw(frame, &views, reporter, times, each)?,
        }
        for plan in self.plans.iter().filter(|p| p.format == Format::Exr) {
            let bytes = self.times.measure("encode", || encode_layers(&layers))?;
            self.write(plan, index, None, &bytes)?;
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
        animations: &mut [Option<Animation>],
    ) -> Result<(), CliError> {
        let times = self.times;
        let tag = match DisplayMap::for_view(view, frame) {
            DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
            _ => ColorTag::Untagged,
        };
        for (plan, animation) in self.plans.iter().zip(animations) {
            let bytes = match (plan.format, animation) {
                (Format::Exr, _) => continue,
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
            self.write(plan, index, own_name, &bytes)?;
        }
        Ok(())
    }

    fn write(&mut self, plan: &Plan, frame: u32, view: Option<ViewSpec>, bytes: &[u8]) -> Result<(), CliError> {
        self.times.measure("write", || match (&plan.target, plan.path(frame, view)) {
            (Target::File(_), Some(path)) => {
                self.set.add(&path, bytes)?;
                self.done.files.push(path);
                Ok(())
            }
            _ => self.reporter.data(bytes),
        })
    }
}

/// All pictures as layers of one file; they have one size.
fn encode_layers(pictures: &[(String, Picture)]) -> Result<Vec<u8>, ImageError> {
    let size = pictures.first().map_or([0, 0], |(_, first)| [first.width, first.height]);
    let layers: Vec<Layer<'_>> =
        pictures.iter().map(|(name, picture)| Layer { name, pixels: &picture.pixels }).collect();
    exr::encode_layers(size, &layers)
}
