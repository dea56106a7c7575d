//! Draws the exhibits one after the other, and writes their pictures, their scenes and the commands that draw them again.

use super::{Folder, TourArgs};
use crate::backend::{BackendReport, Opened};
use crate::error::CliError;
use crate::options::BackendChoice;
use crate::report::{Reporter, Times};
use gonio_gallery::contact_sheet::BACKGROUND;
use gonio_gallery::drawing::{
    CPU_SCALE, DrawCounts, DrawnExhibit, EnvironmentCache, OPEN_GL_SCALE, PreparedScene, color_tag,
};
use gonio_gallery::environment_picture::{EnvironmentPicture, PictureForm};
use gonio_gallery::rgb_image::reduced;
use gonio_gallery::station_exhibit::StationExhibit;
use gonio_gallery::{Exhibit, ExhibitSubject, Placement, Section, SheetLayout};
use gonio_image::encode::png;
use gonio_light::color::ToneMap;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::{Scene, SceneFile};
use std::time::Instant;

/// All pictures of the tour.
pub struct DrawnTour<'a> {
    /// In the order of the tour.
    pub exhibits: Vec<DrawnExhibit<'a>>,
    /// The backend that drew them.
    pub backend: BackendReport,
    /// The backend in one clause.
    pub drawn_by: String,
}

/// Draws everything and writes pictures and scenes.
pub fn all<'a>(
    args: &TourArgs,
    folder: &mut Folder,
    sections: &'a [Section],
    layout: &SheetLayout,
    reporter: &Reporter,
    times: &Times,
) -> Result<DrawnTour<'a>, CliError> {
    let mut opened = Opened::new(&args.backend, None, times)?;
    let exhibits = || sections.iter().enumerate().flat_map(|(i, s)| s.rows.iter().flatten().map(move |e| (i, e)));
    let total = exhibits().count();
    let progress = reporter.progress("drawing the tour");
    let (mut drawn, mut notes) = (Vec::with_capacity(total), Vec::new());
    let mut backend = None;
    let mut environments = EnvironmentCache::default();
    for (index, ((section, exhibit), placement)) in exhibits().zip(&layout.placements).enumerate() {
        let scale = match opened {
            _ if exhibit.at_sheet_size => 1.0,
            Opened::Gl(_) => OPEN_GL_SCALE,
            Opened::Cpu { .. } => CPU_SCALE,
        };
        let width = (f64::from(placement.width) * scale) as u32;
        drawn.push(match &exhibit.subject {
            ExhibitSubject::Environment(picture) => {
                convert(folder, (section, exhibit), *picture, width, placement, times)?
            }
            ExhibitSubject::Station(station) => compute(folder, (section, exhibit), *station, placement, times)?,
            ExhibitSubject::Scene(scene) => {
                let mut scene = (**scene).clone();
                scene.picture.width = width;
                scene.picture.height = (f64::from(placement.height) * scale) as u32;
                opened = opened.for_size(scene.picture.width, scene.picture.height, &args.backend)?;
                let loaded = times.measure("load", || environments.load(scene, &BuiltinOnly))?;
                let drawn = draw(args, folder, (section, exhibit), &loaded, placement, &mut opened, times, &mut notes)?;
                if backend.is_none() {
                    let (report, sentence) = (opened.report(), opened.sentence());
                    if args.backend.backend == BackendChoice::Auto {
                        reporter.note(&sentence);
                    }
                    backend = Some((report, sentence));
                }
                drawn
            }
        });
        progress.set((index + 1) as f64 / total as f64);
    }
    drop(progress);
    notes.iter().for_each(|note| reporter.note(note));
    let (backend, drawn_by) = backend.ok_or_else(|| CliError::new("the tour has no pictures"))?;
    Ok(DrawnTour { exhibits: drawn, backend, drawn_by })
}

/// Converts an environment to a picture of about this width, and writes it.
fn convert<'a>(
    folder: &mut Folder,
    (section, exhibit): (usize, &'a Exhibit),
    picture: EnvironmentPicture,
    width: u32,
    placement: &Placement,
    times: &Times,
) -> Result<DrawnExhibit<'a>, CliError> {
    let start = Instant::now();
    let converted = times.measure("convert", || picture.convert(width))?;
    let ms = start.elapsed().as_secs_f64() * 1e3;
    times.measure("write", || folder.add(&folder.picture(&exhibit.name), &converted.png()?))?;
    let encoded = converted.encoded();
    Ok(DrawnExhibit {
        section,
        exhibit,
        width: encoded.width,
        height: encoded.height,
        small: times.measure("reduce", || reduced(&encoded, placement.width, placement.height, BACKGROUND)),
        counts: DrawCounts::default(),
        ms,
        difference: None,
        command: convert_command(picture, &exhibit.name, width),
    })
}

/// Computes a picture of a station, and writes it.
fn compute<'a>(
    folder: &mut Folder,
    (section, exhibit): (usize, &'a Exhibit),
    station: StationExhibit,
    placement: &Placement,
    times: &Times,
) -> Result<DrawnExhibit<'a>, CliError> {
    let [width, height] =
        [placement.width, placement.height].map(|side| (f64::from(side) * StationExhibit::SCALE) as u32);
    let start = Instant::now();
    let computed = times.measure("compute", || station.compute(width.max(1), height.max(1)));
    let ms = start.elapsed().as_secs_f64() * 1e3;
    times.measure("write", || folder.add(&folder.picture(&exhibit.name), &computed.png()?))?;
    let encoded = computed.encoded();
    let (station, picture, samples) = (station.station.name, station.picture.name, station.samples);
    Ok(DrawnExhibit {
        section,
        exhibit,
        width: encoded.width,
        height: encoded.height,
        small: times.measure("reduce", || {
            let larger = computed.resized(placement.width, placement.height);
            reduced(&larger, placement.width, placement.height, BACKGROUND)
        }),
        counts: DrawCounts::default(),
        ms,
        difference: None,
        command: format!(
            "gonio beyond {station} -o . --picture {picture} --size {}x{} --samples {}",
            encoded.width, encoded.height, samples
        ),
    })
}

/// Draws a scene, and writes its picture and the scene itself.
#[allow(clippy::too_many_arguments)]
fn draw<'a>(
    args: &TourArgs,
    folder: &mut Folder,
    (section, exhibit): (usize, &'a Exhibit),
    loaded: &Scene,
    placement: &Placement,
    opened: &mut Opened,
    times: &Times,
    notes: &mut Vec<String>,
) -> Result<DrawnExhibit<'a>, CliError> {
    let frame = loaded.frame(exhibit.time);
    let mut prepared = times.measure("upload", || match opened.renderer() {
        Some(renderer) => PreparedScene::on_gpu(renderer, loaded),
        None => Ok(PreparedScene::on_cpu(loaded)),
    })?;
    // The small picture comes first: it also has the shaders compiled before the clock runs.
    let difference = prepared.compare(loaded, &frame, exhibit.view)?;

    let start = Instant::now();
    let drawn = times.measure("draw", || prepared.draw(&frame, exhibit.view))?;
    let ms = start.elapsed().as_secs_f64() * 1e3;
    for note in drawn.notes {
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    let picture = drawn.picture;
    times.measure("write", || -> Result<(), CliError> {
        folder.add(&folder.picture(&exhibit.name), &png::encode8(&picture, color_tag(exhibit.view, &frame))?)?;
        folder.add(&folder.scene(&exhibit.name), SceneFile::from(&loaded.settings).to_toml_string().as_bytes())
    })?;
    Ok(DrawnExhibit {
        section,
        exhibit,
        width: picture.width,
        height: picture.height,
        small: times.measure("reduce", || reduced(&picture, placement.width, placement.height, BACKGROUND)),
        counts: drawn.counts,
        ms,
        difference,
        command: render_command(args, folder, exhibit),
    })
}

/// Returns the command that draws a scene again, with the tour's path as on the command line.
fn render_command(args: &TourArgs, folder: &Folder, exhibit: &Exhibit) -> String {
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

/// Returns the commands that convert an environment again to a picture that is at least `width` pixels wide.
fn convert_command(picture: EnvironmentPicture, name: &str, width: u32) -> String {
    let (from, size) = (picture.from.name(), picture.size(width));
    let tone_map = match picture.tone_map() {
        ToneMap::None => String::new(),
        other => format!(" --tone-map {other}"),
    };
    match picture.form {
        PictureForm::Panorama => format!("gonio environment convert {from} {name}.png --size {size}{tone_map}"),
        PictureForm::PanoramaOfCubemap(face) => format!(
            "gonio environment convert {from} {from}.ktx2 --size {face} && \
             gonio environment convert {from}.ktx2 {name}.png --size {size}{tone_map}"
        ),
        PictureForm::Faces(arrangement, layout) => format!(
            "gonio environment convert {from} {name}.png --to {arrangement} --layout {layout} --size {size}{tone_map}"
        ),
    }
}
