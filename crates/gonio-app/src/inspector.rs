//! The model files of the open scene: their content, lines of their texts, and the same models in other formats. Files are read
//! beside the interface, once after each loading, and only for those who look.

use crate::bench::Job;
use crate::files::ReadRecorder;
use crate::platform::Platform;
use crate::saving::Product;
use egui::Context;
use gonio_language::tr;
use gonio_mesh::write::ply::PlyEncoding;
use gonio_mesh::{Limits, Severity};
use gonio_scene::convert::{ConvertedModel, ModelFormat, ModelTextures, TexturePlacement};
use gonio_scene::files::FileSource;
use gonio_scene::inspect::{self, FileLines, Inspection};
use gonio_scene::model_file::ModelFile;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Lines that are read before and after the requested one.
const AROUND: u64 = 100;
/// Time until a built-in file that has not arrived on a page is looked for again.
const PATIENCE: Duration = Duration::from_millis(150);

/// The files of the open scene, and what was found in them.
#[derive(Default)]
pub struct Inspector {
    /// The models, each once, in the order of the objects.
    models: Vec<InspectedModel>,
    /// The scene files that were opened.
    scenes: Vec<String>,
    /// The file whose content is shown: a model, or a scene file.
    chosen: String,
    /// The lines that are shown.
    lines: Option<ShownLines>,
    /// Lines to show next: file and line.
    requested: Option<(String, u64)>,
    /// Incremented when files were read again; earlier results are outdated.
    revision: u64,
    /// The model that is inspected next, once a frame has said so.
    announced: Option<String>,
    inspecting: Option<(String, u64, Job<FileReply<Inspection>>)>,
    reading: Option<(String, u64, Job<FileReply<FileLines>>)>,
    converting: Option<(ModelConversion, Job<Result<ConvertedModel, String>>)>,
}

/// A model file.
pub struct InspectedModel {
    /// Its name in the scene.
    pub name: String,
    /// Its content, or why it cannot be read, in one sentence; `None` until it was inspected.
    pub result: Option<Result<Arc<Inspection>, String>>,
    revision: u64,
}

/// Lines of a file.
pub struct ShownLines {
    /// The file's name.
    pub file: String,
    /// The marked line, from 1.
    pub line: u64,
    /// The lines around it, or why there are none, in one sentence.
    pub result: Result<Arc<FileLines>, String>,
    /// Whether the marked line has not been scrolled to.
    pub is_new: bool,
}

/// A model that is converted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelConversion {
    /// The product.
    pub product: Product,
    /// The path to save to.
    pub place: String,
    /// The model's name in the scene.
    pub model: String,
}

/// Where files are read.
pub struct FileAccess {
    /// Their source.
    pub files: Arc<dyn FileSource>,
    /// Limits on memory that they may claim.
    pub limits: Limits,
}

/// A result; a page may lack files that have not arrived yet.
struct FileReply<T> {
    result: Result<T, String>,
    is_waiting: bool,
}

impl<T> FileReply<T> {
    fn from(access: FileAccess, read: impl FnOnce(&dyn FileSource, &Limits) -> Result<T, String>) -> Self {
        let recorder = ReadRecorder::new(access.files);
        let result = read(&recorder, &access.limits);
        FileReply { result, is_waiting: recorder.is_waiting() }
    }
}

const ENDED: &str = "file-the-work-ended-unexpectedly-this-is";

impl Inspector {
    /// The models of the scene.
    pub fn models(&self) -> &[InspectedModel] {
        &self.models
    }

    /// The opened scene files.
    pub fn scenes(&self) -> &[String] {
        &self.scenes
    }

    /// The model whose content is shown; `None` for a scene file.
    pub fn chosen_model(&self) -> Option<&InspectedModel> {
        self.models.iter().find(|model| model.name == self.chosen)
    }

    /// The file whose content is shown.
    pub fn chosen(&self) -> &str {
        &self.chosen
    }

    /// Chooses the file whose content is shown.
    pub fn choose(&mut self, file: String) {
        self.chosen = file;
    }

    /// The lines that are shown.
    pub fn lines(&mut self) -> Option<&mut ShownLines> {
        self.lines.as_mut()
    }

    /// Whether lines are shown.
    pub fn has_lines(&self) -> bool {
        self.lines.is_some()
    }

    /// Shows a line (from 1) of a file.
    pub fn show_line(&mut self, file: String, line: u64) {
        self.requested = Some((file, line));
    }

    /// Shows no lines any more.
    pub fn close_lines(&mut self) {
        (self.lines, self.requested, self.reading) = (None, None, None);
    }

    /// The conversion at work.
    pub fn converting(&self) -> Option<&ModelConversion> {
        self.converting.as_ref().map(|(conversion, _)| conversion)
    }

    /// Another scene is open.
    pub fn forget(&mut self) {
        self.close_lines();
        self.models.clear();
        self.scenes.clear();
        self.chosen.clear();
        self.revision += 1;
    }

    /// The files of the scene were read again.
    pub fn files_changed(&mut self) {
        self.revision += 1;
        if let Some(lines) = self.lines.as_ref().filter(|_| self.requested.is_none()) {
            self.requested = Some((lines.file.clone(), lines.line));
        }
    }

    /// Updates the list of files to those of the scene: its scene files, and the models of its objects.
    pub fn follow_scene<'a>(&mut self, scenes: Vec<String>, models: impl Iterator<Item = &'a str>) {
        self.scenes = scenes;
        let mut known = std::mem::take(&mut self.models);
        for name in models {
            if self.models.iter().any(|model| model.name == name) {
                continue;
            }
            let before = known.iter().position(|model| model.name == name).map(|index| known.swap_remove(index));
            let new = || InspectedModel { name: name.to_owned(), result: None, revision: 0 };
            self.models.push(before.unwrap_or_else(new));
        }
        if self.chosen_model().is_none() && !self.scenes.contains(&self.chosen) {
            self.chosen = self.models.first().map(|model| model.name.clone()).unwrap_or_default();
        }
    }

    /// Takes results, and starts what is to be read next.
    pub fn follow(&mut self, platform: &mut dyn Platform, ctx: &Context, access: impl Fn() -> FileAccess) {
        self.follow_lines(platform, ctx, &access);
        self.take_inspection(ctx);
        if self.inspecting.is_some() {
            return;
        }
        let revision = self.revision;
        let is_due = |model: &&InspectedModel| model.result.is_none() || model.revision != revision;
        let due = self.chosen_model().filter(is_due).or_else(|| self.models.iter().find(is_due));
        let Some(name) = due.map(|model| model.name.clone()) else { return };
        // On a page the work stops the interface, which announces it first.
        if self.announced.as_ref() != Some(&name) {
            self.announced = Some(name);
            return ctx.request_repaint();
        }
        self.announced = None;
        let (access, input) = (access(), name.clone());
        let read = move |files: &dyn FileSource, limits: &Limits| {
            inspect::inspect(&input, files, limits).map_err(|error| error.to_string())
        };
        self.inspecting = Some((name, revision, Job::start(platform, ctx, move || FileReply::from(access, read))));
    }

    fn take_inspection(&mut self, ctx: &Context) {
        let Some(answer) = self.inspecting.as_ref().and_then(|(.., job)| job.poll()) else { return };
        let Some((name, revision, _)) = self.inspecting.take() else { return };
        let result = match answer {
            Some(answer) if answer.is_waiting => return ctx.request_repaint_after(PATIENCE),
            Some(answer) => answer.result.map(Arc::new),
            None => Err(tr!(ENDED).to_owned()),
        };
        if let Some(model) = self.models.iter_mut().find(|model| model.name == name) {
            (model.result, model.revision) = (Some(result), revision);
        }
        // The panel was shown before this.
        ctx.request_repaint();
    }

    fn follow_lines(&mut self, platform: &mut dyn Platform, ctx: &Context, access: &dyn Fn() -> FileAccess) {
        if let Some(answer) = self.reading.as_ref().and_then(|(.., job)| job.poll())
            && let Some((file, line, _)) = self.reading.take()
        {
            ctx.request_repaint();
            match answer {
                Some(answer) if answer.is_waiting => {
                    self.requested.get_or_insert((file, line));
                    return ctx.request_repaint_after(PATIENCE);
                }
                Some(answer) => {
                    let result = answer.result.map(Arc::new);
                    self.lines = Some(ShownLines { file, line, result, is_new: true });
                }
                None => self.lines = Some(ShownLines { file, line, result: Err(tr!(ENDED).to_owned()), is_new: true }),
            }
        }
        if self.reading.is_some() {
            return;
        }
        let Some((file, line)) = self.requested.take() else { return };
        let (access, input) = (access(), file.clone());
        let read = move |files: &dyn FileSource, limits: &Limits| {
            inspect::lines_around(&input, line, AROUND, files, limits).map_err(|error| error.to_string())
        };
        self.reading = Some((file, line, Job::start(platform, ctx, move || FileReply::from(access, read))));
    }

    /// Starts to convert a model; the files that it is saved as have the name of the place.
    pub fn convert(
        &mut self,
        platform: &mut dyn Platform,
        ctx: &Context,
        conversion: ModelConversion,
        format: ModelFormat,
        access: FileAccess,
    ) {
        let of = conversion.clone();
        let job = Job::start(platform, ctx, move || converted(&of, format, &access));
        self.converting = Some((conversion, job));
    }

    /// The converted model, once; or why there is none, in one sentence.
    pub fn take_converted(&mut self) -> Option<(ModelConversion, Result<ConvertedModel, String>)> {
        let answer = self.converting.as_ref().and_then(|(_, job)| job.poll())?;
        let (conversion, _) = self.converting.take()?;
        Some((conversion, answer.unwrap_or_else(|| Err(tr!(ENDED).to_owned()))))
    }

    /// The state as JSON: `models` with their `name`, `format`, `triangles`, `missing` files and `warnings`, or their `error`; the
    /// `chosen` file, whether one is being read (`reading`), and the marked line: `lines`.
    pub fn state(&self) -> Value {
        let model = |model: &InspectedModel| match &model.result {
            None => json!({ "name": model.name, "reading": true }),
            Some(Err(error)) => json!({ "name": model.name, "error": error }),
            Some(Ok(inspection)) => json!({
                "name": model.name,
                "format": inspection.format,
                "triangles": inspection.geometry.triangles,
                "missing": missing(inspection),
                "warnings": inspection.diagnostics.iter().filter(|d| d.severity == Severity::Warning).count(),
            }),
        };
        let lines = self.lines.as_ref().map(|lines| {
            let read = lines.result.as_ref().ok();
            let text = read.and_then(|read| {
                let index = lines.line.checked_sub(read.excerpt.first_line)?;
                read.excerpt.lines.get(usize::try_from(index).ok()?)
            });
            json!({
                "file": lines.file,
                "line": lines.line,
                "text": text,
                "meaning": read.and_then(|read| read.explanation.as_ref()).map(|explanation| &explanation.meaning),
                "error": lines.result.as_ref().err(),
            })
        });
        json!({
            "models": self.models.iter().map(model).collect::<Vec<_>>(),
            "scenes": self.scenes,
            "chosen": self.chosen,
            "reading": self.inspecting.is_some() || self.reading.is_some(),
            "converting": self.converting().map(|conversion| &conversion.place),
            "lines": lines,
        })
    }
}

/// The names of the files that a model names and that were not found or not read, each once.
pub fn missing(inspection: &Inspection) -> Vec<&str> {
    let sidecars = inspection.files.iter().map(|file| (&file.name, &file.found));
    let textures = inspection.textures.iter().map(|texture| (&texture.name, &texture.found));
    let mut names = Vec::new();
    for (name, _) in sidecars.chain(textures).filter(|(_, found)| found.is_none()) {
        if !names.contains(&name.as_str()) {
            names.push(name.as_str());
        }
    }
    names
}

fn converted(of: &ModelConversion, format: ModelFormat, access: &FileAccess) -> Result<ConvertedModel, String> {
    let FileAccess { files, limits } = access;
    let mut file = ModelFile::open(&of.model, files, limits).map_err(|error| error.to_string())?;
    let mut diagnostics = Vec::new();
    let textures = ModelTextures::find(&file, files, &mut diagnostics);
    let stem = Path::new(&of.place).file_stem().unwrap_or_default().to_string_lossy();
    let model = &mut file.model;
    let (placement, encoding) = (TexturePlacement::Copied, PlyEncoding::Binary);
    let mut converted = ConvertedModel::new(model, &textures, placement, &stem, format, encoding)
        .map_err(|error| tr!("file-cannot-be-written", place = of.place, error = error))?;
    converted.diagnostics.splice(..0, diagnostics);
    Ok(converted)
}
