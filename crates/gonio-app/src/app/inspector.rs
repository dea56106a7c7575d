//! The panel of files within the application: what is read for it, and models that are saved in other formats.

use super::App;
use crate::files::{base_name, pack};
use crate::inspector::{FileAccess, ModelConversion};
use crate::saving::Product;
use crate::session::{MessageCause, MessageSeverity, Tab};
use gonio_language::tr;
use gonio_mesh::Severity;
use gonio_scene::convert::{ConvertedModel, ModelFormat};
use std::path::{Path, PathBuf};

const NO_MODEL: &str = "file-no-model-is-chosen-choose-one";

impl App {
    /// Shows a line of a file in the panel of files.
    pub(super) fn show_line(&mut self, file: String, line: u64) {
        self.session.tab = Tab::File;
        self.session.inspector.show_line(file, line);
    }

    /// Reads what the panel of files shows next, and takes results.
    pub(super) fn follow_inspector(&mut self, ctx: &egui::Context) {
        if let Some((conversion, result)) = self.session.inspector.take_converted() {
            match result.and_then(|converted| self.write_converted(&conversion, converted)) {
                Ok(place) => self.session.announcement = tr!("file-saved", place = place),
                Err(error) => self.session.messages.report(MessageSeverity::Error, error),
            }
            ctx.request_repaint();
        }
        let Some(loaded) = self.session.loaded.as_ref().filter(|_| self.session.tab == Tab::File) else { return };
        let (files, limits) = (&self.files, self.opened.limits);
        let inspector = &mut self.session.inspector;
        let models = loaded.settings.objects.iter().map(|object| object.model.as_str());
        // Inputs are models and scene files; a model stays one when its object is removed.
        let objects = || loaded.settings.objects.iter().chain(&self.saved.objects);
        let is_scene = |input: &&String| objects().all(|object| object.model != **input);
        let scenes = self.opened.inputs.iter().filter(is_scene).cloned().collect();
        inspector.follow_scene(scenes, models);
        let access = || FileAccess { files: files.clone(), limits };
        inspector.follow(self.platform.as_mut(), ctx, access);
    }

    /// The file name that is proposed for a model in another format. It differs from the model's own.
    pub(super) fn converted_name(&self, product: Product) -> String {
        let model = base_name(self.session.inspector.chosen());
        let model = model.strip_prefix(gonio_scene::files::BUILTIN).unwrap_or(model);
        let name = product.file_name(model);
        if name == model { format!("{}_converted.{}", Product::stem(model), product.extension()) } else { name }
    }

    /// Starts to convert the chosen model.
    pub(super) fn convert_model(&mut self, ctx: &egui::Context, product: Product, format: ModelFormat, place: &str) {
        let Some(model) = self.session.inspector.chosen_model() else {
            return self.session.messages.report(MessageSeverity::Error, tr!(NO_MODEL));
        };
        let conversion = ModelConversion { product, place: place.to_owned(), model: model.name.clone() };
        let access = FileAccess { files: self.files.clone(), limits: self.opened.limits };
        self.session.inspector.convert(self.platform.as_mut(), ctx, conversion, format, access);
    }

    /// Saves a converted model with the files beside it; a page saves several as one ZIP file. Returns its place.
    fn write_converted(&mut self, conversion: &ModelConversion, converted: ConvertedModel) -> Result<String, String> {
        let ConvertedModel { main, beside, diagnostics } = converted;
        let place = Path::new(&conversion.place);
        let saved = if self.platform.has_folders() {
            let beside: Vec<(PathBuf, Vec<u8>)> =
                beside.into_iter().map(|(name, bytes)| (place.with_file_name(name), bytes)).collect();
            let paths = beside.iter().map(|(path, _)| path.as_path()).chain([place]);
            if let Some(own) = paths.into_iter().find(|path| self.has_read(path)) {
                let own = own.display();
                return Err(tr!("file-belongs-to-the-open-scene-and", own = own));
            }
            for (path, bytes) in beside {
                self.platform.write(&path.to_string_lossy(), &bytes)?;
            }
            self.platform.write(&conversion.place, &main)?
        } else if beside.is_empty() {
            self.platform.write(&conversion.place, &main)?
        } else {
            let name = base_name(&conversion.place);
            let beside = beside.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
            let files: Vec<(&str, &[u8])> = std::iter::once((name, main.as_slice())).chain(beside).collect();
            self.platform.write(&place.with_extension("zip").to_string_lossy(), &pack(&files))?
        };
        for lost in diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning) {
            let file = Some(base_name(&saved).to_owned());
            let messages = &mut self.session.messages;
            messages.report_about(MessageCause::Event, MessageSeverity::Warning, file, lost.to_string());
        }
        Ok(saved)
    }

    /// Whether the open scene was read from this file.
    fn has_read(&self, path: &Path) -> bool {
        let Ok(path) = std::path::absolute(path) else { return false };
        self.read.iter().any(|read| std::path::absolute(read).is_ok_and(|read| read == path))
    }
}
