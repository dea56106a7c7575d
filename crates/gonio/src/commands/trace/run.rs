//! The passes of a trace, its checkpoints, and its files.

use super::TraceArgs;
use crate::error::CliError;
use crate::output::{OutputFiles, OutputPath, atomic, color_tag};
use crate::report::Reporter;
use gonio_image::encode::exr::{self, Layer};
use gonio_image::encode::png;
use gonio_reference::ReferenceScene;
use gonio_scene::{DisplayMap, Frame, Picture, Scene, SceneFile};
use gonio_trace::{CheckpointError, Features, Film, TileMask, TraceGoal, TraceScene, TraceSettings};
use std::cell::LazyCell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Paths of each pixel before errors are estimated.
const FIRST_PATHS: u32 = 16;
/// A goal that is not reached with so many paths in a pixel will not be.
const MOST_PATHS: u32 = 1 << 24;
/// A time ends early with so many paths in a pixel: their number has 32 bits.
const MOST_PATHS_IN_TIME: u32 = 4_000_000_000;
/// Paths of one pass, where a pixel gets more than one: pictures are written and errors are estimated between passes.
const PASS: f64 = 2e6;
/// Points of a pixel at which its surfaces are looked at: cheap, and they smooth the edges of textures and objects.
const FEATURE_SAMPLES: u32 = 64;

/// Whether an output is an OpenEXR file.
pub fn is_exr(output: &OutputPath) -> bool {
    format_of(output).is_ok_and(|is_exr| is_exr)
}

/// Whether an output is an OpenEXR file, and not PNG.
pub fn format_of(output: &OutputPath) -> Result<bool, CliError> {
    let Some(path) = output.file() else { return Ok(false) };
    match path.extension().and_then(|e| e.to_str()).map(str::to_lowercase).as_deref() {
        Some("exr") => Ok(true),
        Some("png") => Ok(false),
        _ => Err(CliError::new(format!("`{}`: expected an output that ends in .exr or .png", path.display()))),
    }
}

pub struct TraceRun<'a> {
    pub args: &'a TraceArgs,
    pub reporter: &'a Reporter,
    pub scene: &'a Scene,
    pub frame: &'a Frame,
    pub ready: &'a TraceScene,
    pub settings: TraceSettings,
}

impl TraceRun<'_> {
    /// Traces until the goal is reached.
    pub fn trace(&self, goal: TraceGoal) -> Result<Film, CliError> {
        // Hashing a large scene takes time, and only checkpoints need it.
        let fingerprint = LazyCell::new(|| self.fingerprint());
        let mut film = self.resume(&fingerprint)?.unwrap_or_else(|| Film::new(self.frame.width, self.frame.height));
        let begun = Instant::now();
        let already = film.total_samples();
        let mut saved = Instant::now();
        let mut can_save = true;
        let progress = self.reporter.progress("paths");
        loop {
            let traced = (film.total_samples() - already) as f64;
            let (passes, tiles) = match self.next_pass(goal, &film, begun, traced)? {
                None => return Ok(film),
                Some(next) => next,
            };
            let before = share_done(goal, &film, begun.elapsed());
            let expected = f64::from(passes) * f64::from(film.width) * f64::from(film.height);
            let deadline = match goal {
                TraceGoal::Time(time) if film.least_samples() > 0 => Some(begun + time),
                _ => None,
            };
            let after = match goal {
                TraceGoal::Paths(paths) => before + expected / (f64::from(paths) * film_pixels(&film)),
                _ => before,
            };
            let finished = self.ready.add_samples(&mut film, &self.settings, passes, tiles.as_ref(), &|share| {
                progress.set(match goal {
                    TraceGoal::Time(_) => share_done(goal, &Film::new(0, 0), begun.elapsed()),
                    _ => before + (after - before) * share,
                });
                deadline.is_none_or(|deadline| Instant::now() < deadline)
            });
            if !finished {
                return Ok(film);
            }
            let error = film.error();
            if error.relative.is_finite() {
                progress.message(format!("{} paths, error {:.2} %", film.least_samples(), 100.0 * error.relative));
            }
            if can_save && saved.elapsed().as_secs_f64() >= self.args.checkpoint_every {
                if let Err(error) = self.save(&film, *fingerprint) {
                    // The disk may have room when the picture is finished, and hours of work are worth the try.
                    self.reporter.warning(format_args!("{error}; going on without further checkpoints"));
                    can_save = false;
                }
                saved = Instant::now();
            }
            self.reporter.verbose(format_args!(
                "{} new paths in {:.1} s, error {:.3} %",
                film.total_samples() - already,
                begun.elapsed().as_secs_f64(),
                100.0 * error.relative
            ));
        }
    }

    /// Paths of the next pass, and its tiles if not all; none at the goal. `traced`: paths since the start. With tiles it
    /// depends on nothing but goal and film, so that an interruption changes nothing; without, passes of any size give the
    /// same picture.
    fn next_pass(
        &self,
        goal: TraceGoal,
        film: &Film,
        begun: Instant,
        traced: f64,
    ) -> Result<Option<(u32, Option<TileMask>)>, CliError> {
        let (least, most) = (film.least_samples(), film.most_samples());
        let elapsed = begun.elapsed();
        // Passes grow, so that the first picture is soon there and the last ones cost little beside the paths, until they
        // take as long as the time between checkpoints.
        let per_path = elapsed.as_secs_f64() * film_pixels(film) / traced.max(1.0);
        let in_time = if traced > 0.0 { (0.5 * self.args.checkpoint_every / per_path) as u32 } else { u32::MAX };
        let growing = least.clamp(1, in_time.min((PASS / film_pixels(film)) as u32).max(1));
        Ok(match goal {
            TraceGoal::Paths(paths) if least >= paths => None,
            TraceGoal::Paths(paths) => Some(((paths - least).min(growing), None)),
            TraceGoal::Time(time) if least > 0 && elapsed >= time => None,
            TraceGoal::Time(_) if most >= MOST_PATHS_IN_TIME => None,
            TraceGoal::Time(time) => {
                let left = time.saturating_sub(elapsed).as_secs_f64();
                // The last pass should end in time: a pass that does not is discarded.
                let fitting = if traced > 0.0 { (0.5 * left / per_path) as u32 } else { 1 };
                Some((fitting.clamp(1, growing).min(MOST_PATHS_IN_TIME - most), None))
            }
            TraceGoal::Error(_) if least < FIRST_PATHS => Some((growing.min(FIRST_PATHS - least), None)),
            TraceGoal::Error(error) => {
                let tiles = film.unfinished(error);
                if tiles.is_empty() {
                    None
                } else if most >= MOST_PATHS {
                    return Err(CliError::new(format!(
                        "the error is still {:.3} % after {most} paths in a pixel; choose a larger --error, or a number of \
                         --samples",
                        100.0 * film.error().upper
                    )));
                } else {
                    let at_once = (PASS / f64::from(tiles.pixels())) as u32;
                    Some(((most / 2).min(at_once).max(1), Some(tiles)))
                }
            }
        })
    }

    /// The film of the checkpoint, if there is one of this scene.
    fn resume(&self, fingerprint: &LazyCell<u64, impl FnOnce() -> u64>) -> Result<Option<Film>, CliError> {
        let Some(path) = self.checkpoint().filter(|path| !self.args.restart && path.is_file()) else { return Ok(None) };
        let bytes = std::fs::read(&path).map_err(|e| {
            CliError::new(format!("cannot read the checkpoint `{}`: {e}; --restart ignores it", path.display()))
        })?;
        match Film::from_checkpoint(&bytes, **fingerprint, self.frame.width, self.frame.height) {
            Ok(film) => {
                self.reporter.note(format_args!(
                    "continuing from `{}` at {} paths per pixel",
                    path.display(),
                    film.least_samples()
                ));
                Ok(Some(film))
            }
            Err(CheckpointError::Fingerprint) => {
                self.reporter.warning(format_args!(
                    "`{}` is the checkpoint of another scene or of other options; starting over",
                    path.display()
                ));
                Ok(None)
            }
            Err(CheckpointError::Format | CheckpointError::Length) => Err(CliError::new(format!(
                "`{}` is not a checkpoint of gonio, or is damaged; delete it, or ignore it with --restart",
                path.display()
            ))),
        }
    }

    /// The file beside the first output that is a file.
    fn checkpoint(&self) -> Option<PathBuf> {
        self.args.output.iter().find_map(OutputPath::file).map(|path| path.with_extension("trace"))
    }

    /// Removes the checkpoint of a finished picture.
    pub fn remove_checkpoint(&self) {
        if let Some(path) = self.checkpoint() {
            // There is none after a short trace.
            let _ = std::fs::remove_file(path);
        }
    }

    fn save(&self, film: &Film, fingerprint: u64) -> Result<(), CliError> {
        if let Some(path) = self.checkpoint() {
            atomic::write(&path, &film.to_checkpoint(fingerprint))?;
            let mut files = OutputFiles::new();
            self.add_pictures(film, &mut files, &[], None, |output| !output.is_stdout())?;
            files.commit()?;
        }
        Ok(())
    }

    /// Identifies everything that the film depends on: scene, files and settings.
    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        env!("CARGO_PKG_VERSION").hash(&mut hasher);
        SceneFile::from(&self.scene.settings).to_toml_string().hash(&mut hasher);
        self.args.trace.moment.to_bits().hash(&mut hasher);
        format!("{:?}", self.settings).hash(&mut hasher);
        format!("{:?}", self.scene.materials).hash(&mut hasher);
        for object in &self.scene.objects {
            format!("{:?}", object.world_from_model).hash(&mut hasher);
        }
        for mesh in &self.scene.meshes {
            for p in mesh.positions.iter().chain(&mesh.normals) {
                p.map(f32::to_bits).hash(&mut hasher);
            }
            for uv in &mesh.tex_coords {
                uv.map(f32::to_bits).hash(&mut hasher);
            }
            mesh.indices.hash(&mut hasher);
        }
        for texture in &self.scene.textures {
            texture.rgba.hash(&mut hasher);
        }
        if let Some(environment) = &self.scene.environment {
            for pixel in environment.mips.full().pixels() {
                pixel.map(f32::to_bits).hash(&mut hasher);
            }
        }
        hasher.finish()
    }

    /// Writes every output; returns their names.
    pub fn write(&self, film: &Film) -> Result<Vec<String>, CliError> {
        let views: Vec<(String, Picture)> = if self.args.views.is_empty() {
            Vec::new()
        } else {
            let _busy = self.reporter.busy("drawing the views");
            let mut scene = self.scene.clone();
            if self.args.views.iter().any(|view| view.quantity == gonio_light::Quantity::Tangent) {
                scene.add_tangents();
            }
            let pictures = ReferenceScene::new(&scene).views(self.frame, &self.args.views, &|_| ());
            let names = self.args.views.iter().map(|view| view.to_string().replace(':', "-"));
            names.zip(pictures).map(|(name, rendered)| (name, rendered.picture)).collect()
        };
        let denoised = self.args.denoise.then(|| {
            let _busy = self.reporter.busy("denoising");
            let features = self.ready.features(&self.settings, FEATURE_SAMPLES);
            (film.denoised(&features), features)
        });
        let mut files = OutputFiles::new();
        self.add_pictures(film, &mut files, &views, denoised.as_ref(), |_| true)?;
        files.commit()?;
        Ok(self.args.output.iter().filter(|o| !o.is_stdout()).map(ToString::to_string).collect())
    }

    fn add_pictures(
        &self,
        film: &Film,
        files: &mut OutputFiles,
        views: &[(String, Picture)],
        denoised: Option<&(Picture, Features)>,
        is_wanted: impl Fn(&OutputPath) -> bool,
    ) -> Result<(), CliError> {
        let picture = film.picture();
        for output in self.args.output.iter().filter(|output| is_wanted(output)) {
            let bytes = if is_exr(output) {
                self.exr(film, &picture, views, denoised)?
            } else {
                self.png(denoised.map_or(&picture, |(picture, _)| picture), denoised.is_some())?
            };
            files.add_output(output, bytes)?;
        }
        Ok(())
    }

    fn png(&self, picture: &Picture, is_denoised: bool) -> Result<Vec<u8>, CliError> {
        let map = DisplayMap::for_view(None, self.frame);
        let (picture, tag) = (picture.encode8(&map), color_tag(&map));
        Ok(if is_denoised { png::encode8_with_comment(&picture, tag, DENOISED)? } else { png::encode8(&picture, tag)? })
    }

    fn exr(
        &self,
        film: &Film,
        picture: &Picture,
        views: &[(String, Picture)],
        denoised: Option<&(Picture, Features)>,
    ) -> Result<Vec<u8>, CliError> {
        let variance: Vec<[f32; 4]> = film.variance().iter().map(|&v| [v as f32, v as f32, v as f32, 1.0]).collect();
        let opaque = |guide: &[[f32; 3]]| guide.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect::<Vec<[f32; 4]>>();
        let guides = denoised.map(|(_, features)| (opaque(&features.albedo), opaque(&features.normal)));
        let mut layers =
            vec![Layer { name: "picture", pixels: &picture.pixels }, Layer { name: "variance", pixels: &variance }];
        if let (Some((denoised, _)), Some((albedo, normal))) = (denoised, &guides) {
            // The views of the lab's equation have the names without `guide`.
            layers.push(Layer { name: "denoised", pixels: &denoised.pixels });
            layers.push(Layer { name: "guide-albedo", pixels: albedo });
            layers.push(Layer { name: "guide-normal", pixels: normal });
        }
        layers.extend(views.iter().map(|(name, picture)| Layer { name, pixels: &picture.pixels }));
        Ok(exr::encode_layers([picture.width, picture.height], &layers)?)
    }
}

/// The comment in a filtered .png file.
const DENOISED: &str = "Denoised by gonio: noise of the path tracer was removed by a filter that may be wrong.";

fn film_pixels(film: &Film) -> f64 {
    f64::from(film.width) * f64::from(film.height)
}

/// The share of the work that is done, as far as one can tell.
fn share_done(goal: TraceGoal, film: &Film, elapsed: Duration) -> f64 {
    match goal {
        TraceGoal::Paths(paths) => f64::from(film.least_samples()) / f64::from(paths.max(1)),
        TraceGoal::Time(time) => elapsed.as_secs_f64() / time.as_secs_f64().max(1e-9),
        // The square of the error falls as paths are added.
        TraceGoal::Error(error) => {
            let now = film.error().upper;
            if now.is_finite() && now > 0.0 { (error / now).powi(2).min(1.0) } else { 0.0 }
        }
    }
}
