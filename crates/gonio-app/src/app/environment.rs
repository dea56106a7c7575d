//! The environment within the application: its study, its repair and its conversions.

use super::App;
use crate::environment::{self, ConvertedFiles, EnvironmentNews, EnvironmentProduct, EnvironmentSource};
use crate::files::{Layered, MemoryFiles};
use crate::session::{MessageSeverity, Tab};
use gonio_environment::encode::Container;
use gonio_language::tr;
use gonio_light::color::{ColorEncoding, OutputTransform};
use std::sync::Arc;

const NO_ENVIRONMENT: &str = "environment-the-scene-has-no-environment-choose";

impl App {
    /// Shows the panel.
    pub(super) fn show_environment(&mut self) {
        self.session.environment.is_open = true;
        self.session.tab = Tab::Environment;
    }

    /// Hides the panel.
    pub(super) fn close_environment(&mut self) {
        self.session.environment.is_open = false;
        self.session.environment.forget();
        self.session.tab = Tab::Picture;
    }

    /// The files of the scene's environment.
    fn environment_source(&self) -> Option<EnvironmentSource> {
        let settings = self.document.scene.environment.as_ref()?;
        Some(EnvironmentSource::new(settings, self.files.clone(), self.opened.limits))
    }

    /// Studies the environment while its panel is visible, and takes results.
    pub(super) fn follow_environment(&mut self, ctx: &egui::Context) {
        if self.session.environment.is_open && self.session.tab == Tab::Environment {
            let loaded = self.session.loaded.as_ref().and_then(|loaded| {
                // The settings of another environment wait until it is loaded.
                let is_same = loaded.settings.environment == self.document.scene.environment;
                loaded.environment.clone().filter(|_| is_same)
            });
            match (loaded, self.environment_source()) {
                (Some(loaded), Some(source)) => {
                    self.session.environment.study(self.platform.as_mut(), ctx, &loaded, || source);
                }
                (None, None) => self.session.environment.forget(),
                _ => {}
            }
        }
        for news in self.session.environment.follow(ctx) {
            match news {
                EnvironmentNews::Failed(error) => self.session.messages.report(MessageSeverity::Error, error),
                EnvironmentNews::Converted(product, place, files) => self.write_environment(product, &place, files),
                EnvironmentNews::Repaired(name, bytes) => self.take_repaired(&name, bytes),
            }
        }
    }

    /// The proposed name of a file of the environment.
    pub(super) fn environment_file_name(&self, product: EnvironmentProduct) -> String {
        let name = self.document.scene.environment.as_ref().map_or("", |environment| environment.image.as_str());
        environment::file_name(name, product)
    }

    /// Starts to convert the environment, for files at `place`.
    pub(super) fn convert_environment(&mut self, ctx: &egui::Context, product: EnvironmentProduct, place: &str) {
        let Some(source) = self.environment_source() else {
            return self.session.messages.report(MessageSeverity::Error, tr!(NO_ENVIRONMENT));
        };
        let picture = &self.document.scene.picture;
        let transform =
            OutputTransform { exposure: picture.exposure, tone_map: picture.tone_map, encoding: ColorEncoding::Srgb };
        let (view, platform) = (&mut self.session.environment, self.platform.as_mut());
        view.convert(platform, ctx, source, (product, transform), place.to_owned());
    }

    /// Starts to repair the environment.
    pub(super) fn repair_environment(&mut self, ctx: &egui::Context) {
        if let Some(source) = self.environment_source() {
            self.session.environment.repair(self.platform.as_mut(), ctx, source);
        }
    }

    fn write_environment(&mut self, product: EnvironmentProduct, place: &str, converted: ConvertedFiles) {
        for warning in converted.warnings {
            self.session.messages.report(MessageSeverity::Warning, warning);
        }
        let are_faces = product.container == Container::Faces && !product.is_zip;
        let mut first = None;
        for (name, bytes) in &converted.files {
            let place = if are_faces { environment::face_file(place, name) } else { place.to_owned() };
            match self.platform.write(&place, bytes) {
                Ok(written) => first = first.or(Some(written)),
                Err(error) => return self.session.messages.report(MessageSeverity::Error, error),
            }
        }
        if let Some(first) = first {
            self.session.announcement = if are_faces {
                tr!("environment-saved-and-five-more-files", first = first)
            } else {
                tr!("environment-saved", first = first)
            };
        }
    }

    /// Makes the repaired environment that of the scene, as a step that can be undone.
    fn take_repaired(&mut self, name: &str, bytes: Vec<u8>) {
        let mut memory = MemoryFiles::default();
        memory.insert(name, bytes);
        self.files = Arc::new(Layered { first: Arc::new(memory), then: self.files.clone() });
        self.document.scene.set_environment(name);
        self.session.announcement = tr!("environment-the-environment-is-repaired").into();
    }
}
