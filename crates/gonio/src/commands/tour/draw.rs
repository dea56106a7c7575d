//! Draws the exhibits one after the other, and compares who draws.

use super::canvas::{Canvas, reduced};
use super::converted::Converted;
use super::exhibit::{Exhibit, Section, Subject};
use super::layout::{Layout, Place};
use super::sheet::GROUND;
use super::{Folder, TourArgs};
use crate::backend::{Backend, BackendChoice, BackendReport, Counts, Opened};
use crate::report::{CliError, Reporter, Times};
use gonio_image::encode::png::{self, ColorTag};
use gonio_light::color::ColorEncoding;
use gonio_reference::ReferenceScene;
use gonio_scene::environment::LoadedEnvironment;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::picture::EncodedPicture;
use gonio_scene::{DisplayMap, Frame, Scene, SceneFile, load};
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// OpenGL draws each picture so much larger than it stands on the sheet; the CPU takes its time.
const FINE_GL: f64 = 1.75;
/// The same for the CPU.
const FINE_CPU: f64 = 1.0;
/// Width of the pictures that are compared, pixels.
const COMPARED_WIDTH: u32 = 160;

/// A picture that was drawn and written.
pub struct Shown<'a> {
    /// Index of its section.
    pub section: usize,
    /// What it shows.
    pub exhibit: &'a Exhibit,
    /// Of the file, pixels.
    pub width: u32,
    /// Of the file, pixels.
    pub height: u32,
    /// As it stands on the sheet.
    pub small: Canvas,
    /// Vertices and fragments.
    pub counts: Counts,
    /// From the first draw call to the picture in memory, milliseconds; of an environment that was converted, for that.
    pub ms: f64,
    /// GPU against CPU; none where the CPU drew, or nothing was drawn.
    pub difference: Option<Difference>,
    /// Draws it again.
    pub command: String,
}

/// Two pictures in 8 bits: the largest difference of a pixel's channels counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Largest, in steps of 1/255.
    pub max: u8,
    /// Mean over all channels, in steps of 1/255.
    pub mean: f64,
    /// Share of the pixels that differ by at most one step.
    pub within_one: f64,
}

impl Difference {
    /// Of two pictures of the same size; alpha is left out.
    pub fn of(a: &EncodedPicture<u8>, b: &EncodedPicture<u8>) -> Self {
        let (mut max, mut sum, mut within) = (0, 0u64, 0usize);
        let pixels = || a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
        for (a, b) in pixels() {
            let steps = [0, 1, 2].map(|i| a[i].abs_diff(b[i]));
            let worst = steps.into_iter().max().unwrap_or(0);
            sum += steps.iter().map(|&s| u64::from(s)).sum::<u64>();
            max = max.max(worst);
            within += usize::from(worst <= 1);
        }
        let count = pixels().count().max(1) as f64;
        Difference { max, mean: sum as f64 / (3.0 * count), within_one: within as f64 / count }
    }
}

impl Shown<'_> {
    /// The small line below the caption.
    pub fn remark(&self) -> String {
        if !self.exhibit.counts_as_remark {
            return self.exhibit.remark.clone();
        }
        let vertices = self.counts.vertices.map_or_else(|| "?".to_owned(), grouped);
        let fragments = self.counts.fragments.map_or_else(|| "?".to_owned(), |n| grouped((n + 500) / 1000) + " k");
        format!("{vertices} vertices, {fragments} fragments")
    }
}

/// `12 345 678`
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// All pictures, and who drew them.
pub struct Result<'a> {
    /// In the order of the tour.
    pub shown: Vec<Shown<'a>>,
    /// Who drew.
    pub backend: BackendReport,
    /// In one sentence.
    pub sentence: String,
}

/// Draws everything and writes pictures and scenes.
pub fn all<'a>(
    args: &TourArgs,
    folder: &mut Folder,
    sections: &'a [Section],
    layout: &Layout,
    reporter: &Reporter,
    times: &Times,
) -> std::result::Result<Result<'a>, CliError> {
    let mut opened = Opened::new(&args.backend, None, times)?;
    let exhibits = || sections.iter().enumerate().flat_map(|(i, s)| s.rows.iter().flatten().map(move |e| (i, e)));
    let total = exhibits().count();
    let progress = reporter.progress("drawing the tour");
    let (mut shown, mut notes) = (Vec::with_capacity(total), Vec::new());
    let mut backend = None;
    let mut environments = Environments::default();
    for (index, ((section, exhibit), place)) in exhibits().zip(&layout.places).enumerate() {
        let fine = match opened {
            _ if exhibit.exact => 1.0,
            Opened::Gl(_) => FINE_GL,
            Opened::Cpu { .. } => FINE_CPU,
        };
        shown.push(match &exhibit.subject {
            Subject::Converted(converted) => {
                let width = (f64::from(place.width) * fine) as u32;
                lay_out(folder, section, exhibit, *converted, width, place, times)?
            }
            Subject::Scene(scene) => {
                let mut scene = (**scene).clone();
                scene.picture.width = (f64::from(place.width) * fine) as u32;
                scene.picture.height = (f64::from(place.height) * fine) as u32;
                let loaded = times.measure("load", || environments.load(scene))?;
                let (drawn, artist) = one(args, folder, (section, exhibit), &loaded, place, opened, times, &mut notes)?;
                opened = artist.opened;
                if backend.is_none() {
                    if args.backend.backend == BackendChoice::Auto {
                        reporter.note(&artist.sentence);
                    }
                    backend = Some((artist.report, artist.sentence));
                }
                drawn
            }
        });
        progress.set((index + 1) as f64 / total as f64);
    }
    drop(progress);
    notes.iter().for_each(|note| reporter.note(note));
    let (backend, sentence) = backend.ok_or_else(|| CliError::new("the tour has no pictures"))?;
    Ok(Result { shown, backend, sentence })
}

/// The environments so far: what is made of one when it is first asked for (a second's work, where it lights glossy
/// surfaces) is made once for all pictures.
#[derive(Default)]
struct Environments(Vec<Arc<LoadedEnvironment>>);

impl Environments {
    /// Loads a scene, with an environment that is there already in place of its own where they are the same.
    fn load(&mut self, scene: SceneFile) -> std::result::Result<Scene, CliError> {
        let mut loaded = load::load(scene, Path::new(""), &BuiltinOnly)?;
        if let Some(own) = &mut loaded.environment {
            let same = |e: &&Arc<LoadedEnvironment>| {
                e.name == own.name && e.mips.full() == own.mips.full() && e.background == own.background
            };
            match self.0.iter().find(same) {
                Some(known) => *own = known.clone(),
                None => self.0.push(own.clone()),
            }
        }
        Ok(loaded)
    }
}

/// A backend between two scenes, and what it calls itself.
struct Artist {
    opened: Opened,
    report: BackendReport,
    sentence: String,
}

/// Converts an environment to a picture of about this width, and writes it.
fn lay_out<'a>(
    folder: &mut Folder,
    section: usize,
    exhibit: &'a Exhibit,
    converted: Converted,
    width: u32,
    place: &Place,
    times: &Times,
) -> std::result::Result<Shown<'a>, CliError> {
    let start = Instant::now();
    let laid_out = times.measure("convert", || converted.lay_out(width))?;
    let ms = start.elapsed().as_secs_f64() * 1e3;
    times.measure("write", || folder.add(&folder.picture(&exhibit.name), &laid_out.png()?))?;
    let picture = laid_out.encoded();
    Ok(Shown {
        section,
        exhibit,
        width: picture.width,
        height: picture.height,
        small: times.measure("reduce", || reduced(&picture, place.width, place.height, GROUND)),
        counts: Counts::default(),
        ms,
        difference: None,
        command: converted.command(&exhibit.name, width),
    })
}

#[allow(clippy::too_many_arguments)]
fn one<'a>(
    args: &TourArgs,
    folder: &mut Folder,
    (section, exhibit): (usize, &'a Exhibit),
    loaded: &Scene,
    place: &Place,
    opened: Opened,
    times: &Times,
    notes: &mut Vec<String>,
) -> std::result::Result<(Shown<'a>, Artist), CliError> {
    // The tour has one bar of its own.
    let silent = Reporter::new(true, false);
    let frame = loaded.frame(exhibit.time);
    let mut backend = opened.take_scene(loaded, &args.backend, &silent, times)?;
    // As `gonio render` draws its 8-bit pictures: the same bytes.
    backend.for_eight_bits();
    // First the small one: it also has the shaders compiled before the clock runs.
    let difference = match backend {
        Backend::Gl { .. } => Some(compare(&mut backend, exhibit, loaded, &frame, &silent)?),
        Backend::Cpu { .. } => None,
    };

    let start = Instant::now();
    let mut drawn = None;
    backend.draw(&frame, &[exhibit.view], &silent, times, |_, shot| {
        drawn = Some((shot.encoded8()?.into_owned(), shot.counts()));
        for note in shot.notes() {
            if !notes.contains(note) {
                notes.push(note.clone());
            }
        }
        Ok(())
    })?;
    let ms = start.elapsed().as_secs_f64() * 1e3;
    let (picture, counts) = drawn.ok_or_else(|| CliError::new(format!("`{}` was not drawn", exhibit.name)))?;

    let tag = match DisplayMap::for_view(exhibit.view, &frame) {
        DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
        _ => ColorTag::Untagged,
    };
    times.measure("write", || -> std::result::Result<(), CliError> {
        folder.add(&folder.picture(&exhibit.name), &png::encode8(&picture, tag)?)?;
        folder.add(&folder.scene(&exhibit.name), SceneFile::from(&loaded.settings).to_toml_string().as_bytes())
    })?;
    let small = times.measure("reduce", || reduced(&picture, place.width, place.height, GROUND));
    let shown = Shown {
        section,
        exhibit,
        width: picture.width,
        height: picture.height,
        small,
        counts,
        ms,
        difference,
        command: command(args, folder, exhibit),
    };
    let (report, sentence) = (backend.report(), backend.sentence());
    let opened = match backend {
        Backend::Gl { gl, .. } => Opened::Gl(gl),
        Backend::Cpu { reason, .. } => Opened::Cpu { reason },
    };
    Ok((shown, Artist { opened, report, sentence }))
}

/// Both draw the picture small, with one sample; outlines that fall on other sides of a pixel's centre
/// are part of the difference.
fn compare(
    backend: &mut Backend,
    exhibit: &Exhibit,
    loaded: &Scene,
    frame: &Frame,
    silent: &Reporter,
) -> std::result::Result<Difference, CliError> {
    let width = COMPARED_WIDTH.min(frame.width);
    let height = (frame.height * width / frame.width.max(1)).max(1);
    let frame = Frame { width, height, samples: 1, ..frame.clone() };
    let mut by_gpu = None;
    backend.draw(&frame, &[exhibit.view], silent, &Times::default(), |_, shot| {
        by_gpu = Some(shot.encoded8()?.into_owned());
        Ok(())
    })?;
    let by_gpu = by_gpu.ok_or_else(|| CliError::new(format!("`{}` was not drawn", exhibit.name)))?;
    let map = DisplayMap::for_view(exhibit.view, &frame);
    let by_cpu = ReferenceScene::new(loaded).render(&frame, exhibit.view, &|_| ()).picture.encode8(&map);
    Ok(Difference::of(&by_gpu, &by_cpu))
}

/// The command that draws the picture again, with a path as it was given to the tour.
fn command(args: &TourArgs, folder: &mut Folder, exhibit: &Exhibit) -> String {
    let quoted = |text: String| if text.contains(char::is_whitespace) { format!("\"{text}\"") } else { text };
    let scene = quoted(folder.scene(&exhibit.name).display().to_string());
    let mut command = format!("gonio render {scene} -o {}.png", exhibit.name);
    if let Some(view) = exhibit.view {
        command += &format!(" --debug {view}");
    }
    if exhibit.time != 0.0 {
        command += &format!(" --time {}", exhibit.time);
    }
    match args.backend.backend {
        BackendChoice::Auto => {}
        BackendChoice::Gl => command += " --backend gl",
        BackendChoice::Cpu => command += " --backend cpu",
    }
    command
}

#[cfg(test)]
mod tests {
    use super::super::exhibit::Stage;
    use super::*;
    use gonio_scene::scene_file::EnvironmentSpec;

    #[test]
    fn differences_are_counted_in_steps() {
        let picture = |rgba: [u8; 8]| EncodedPicture { width: 2, height: 1, rgba: rgba.to_vec() };
        let a = picture([10, 20, 30, 255, 0, 0, 0, 255]);
        let b = picture([10, 21, 30, 0, 0, 0, 5, 255]);
        let d = Difference::of(&a, &b);
        assert_eq!((d.max, d.mean, d.within_one), (5, 1.0, 0.5));
        assert_eq!(Difference::of(&a, &a), Difference { max: 0, mean: 0.0, within_one: 1.0 });
    }

    #[test]
    fn the_same_environment_is_kept_once() {
        let mut environments = Environments::default();
        let mut load = |image: &str, size| {
            let environment = EnvironmentSpec { image: image.into(), size: Some(size), ..EnvironmentSpec::default() };
            let scene = Stage::RoomSphere.with(|s| s.environment = Some(environment));
            let loaded = scene.and_then(|s| environments.load(s)).unwrap_or_else(|e| panic!("{e:?}"));
            loaded.environment.unwrap_or_else(|| panic!("{image} was lost"))
        };
        let first = load("room", 16);
        assert!(Arc::ptr_eq(&first, &load("room", 16)));
        // The same name at another size, and another name.
        assert!(!Arc::ptr_eq(&first, &load("room", 8)) && !Arc::ptr_eq(&first, &load("sky", 16)));
    }

    #[test]
    fn large_numbers_are_grouped() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1 000", "1 234 567"]);
    }
}
