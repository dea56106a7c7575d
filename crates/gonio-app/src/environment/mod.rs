//! The environment of the scene: its faces and its panorama, the check of its orientation, its repair, and conversions.
//!
//! | file | contents |
//! |---|---|
//! | `study` | reading it again from its files, checking it, and making small pictures |
//! | `product` | what it can be saved as |
//! | `conversion` | converting it to files |
//! | `panel` | the panel |
//! | `pictures` | the unfolded cube and the panorama |
//! | `state_json` | its part of the exported state |
//!
//! All work is done in steps beside the interface (`crate::beside`). The environment is read again for each purpose: one of
//! gigabytes is then in memory only while it is needed.

mod conversion;
mod panel;
mod pictures;
mod product;
mod state_json;
mod study;

pub use conversion::{ConversionGoal, ConvertedFiles};
pub use panel::show as panel;
pub use product::EnvironmentProduct;
pub use state_json::build as state;
pub use study::{EnvironmentFacts, EnvironmentStudy};

use crate::beside::Beside;
use crate::files::base_name;
use crate::platform::Platform;
use crate::saving::Product;
use conversion::ConversionWork;
use egui::Context;
use gonio_environment::Layout;
use gonio_environment::encode::EnvironmentFormat;
use gonio_language::tr;
use gonio_light::color::OutputTransform;
use gonio_mesh::Limits;
use gonio_scene::LoadedEnvironment;
use gonio_scene::environment_file::{self, EnvironmentReadOptions, OpenedEnvironment};
use gonio_scene::files::BUILTIN;
use gonio_scene::files::FileSource;
use gonio_scene::settings::EnvironmentSettings;
use pictures::StudyPictures;
use std::path::Path;
use std::sync::Arc;
use study::StudyWork;

/// The files of an environment, to be read again.
#[derive(Clone)]
pub struct EnvironmentSource {
    /// The name in the scene.
    pub name: String,
    /// The layout of its faces and the size of a built-in one, as the scene has them.
    pub reading: EnvironmentReadOptions,
    /// The source of its files.
    pub files: Arc<dyn FileSource>,
    /// Limits on memory that files may claim.
    pub limits: Limits,
}

impl EnvironmentSource {
    /// The environment of a scene.
    pub fn new(settings: &EnvironmentSettings, files: Arc<dyn FileSource>, limits: Limits) -> Self {
        let reading = EnvironmentReadOptions { layout: settings.layout, arrangement: None, size: settings.size };
        EnvironmentSource { name: settings.image.clone(), reading, files, limits }
    }

    fn open(&self) -> Result<OpenedEnvironment, String> {
        environment_file::open(&self.name, self.reading, Path::new(""), &*self.files, &self.limits)
            .map_err(|error| error.to_string())
    }
}

/// News for the application.
pub enum EnvironmentNews {
    /// Why something failed, in one sentence.
    Failed(String),
    /// Converted files, to be written to this place.
    Converted(EnvironmentProduct, String, ConvertedFiles),
    /// The repaired environment, with the name for it.
    Repaired(String, Vec<u8>),
}

/// A conversion at work.
struct RunningConversion {
    work: Beside<ConversionWork>,
    purpose: ConversionPurpose,
}

enum ConversionPurpose {
    Save(EnvironmentProduct, String),
    /// The beginning of the name of the repaired environment.
    Repair(String),
}

/// A finished study, or why there is none in one sentence.
type Studied = Result<(EnvironmentStudy, StudyPictures), String>;

/// The state of the panel.
#[derive(Default)]
pub struct EnvironmentView {
    /// Whether it was opened.
    pub is_open: bool,
    /// The environment that was studied, or is being studied.
    of: Option<Arc<LoadedEnvironment>>,
    work: Option<Beside<StudyWork>>,
    studied: Option<Studied>,
    /// Counts the studies.
    serial: u64,
    conversion: Option<RunningConversion>,
    /// The format of pictures; `None` for the one that preserves the environment.
    format: Option<EnvironmentFormat>,
    /// Texels along an edge of a face; `None`: as fine as the environment.
    size: Option<u32>,
    layout: Layout,
    /// Whether the environment in the scene is a repaired one that only exists in memory, by its name.
    repaired: Option<String>,
}

impl EnvironmentView {
    /// Studies the environment of the scene, unless that was done.
    pub fn study(
        &mut self,
        platform: &mut dyn Platform,
        ctx: &Context,
        environment: &Arc<LoadedEnvironment>,
        source: impl FnOnce() -> EnvironmentSource,
    ) {
        if self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, environment)) {
            return;
        }
        self.of = Some(environment.clone());
        (self.studied, self.format, self.size) = (None, None, None);
        self.work = Some(Beside::start(platform, ctx, StudyWork::Read(source())));
    }

    /// Forgets the study: the scene has no environment.
    pub fn forget(&mut self) {
        (self.of, self.work, self.studied) = (None, None, None);
    }

    /// Frees what is on the GPU, because its context is lost.
    pub fn release(&mut self) {
        if let Some(Ok((_, pictures))) = &mut self.studied {
            pictures.release();
        }
    }

    /// The facts about the environment, once they are known.
    pub fn facts(&self) -> Option<&EnvironmentFacts> {
        self.studied.as_ref()?.as_ref().ok().map(|(study, _)| &study.facts)
    }

    /// Whether a conversion or a repair is at work.
    pub fn is_converting(&self) -> bool {
        self.conversion.is_some()
    }

    /// Converts the environment, for a file at `place`.
    pub fn convert(
        &mut self,
        platform: &mut dyn Platform,
        ctx: &Context,
        source: EnvironmentSource,
        (product, transform): (EnvironmentProduct, OutputTransform),
        place: String,
    ) {
        let work = ConversionWork::new(source, ConversionGoal::Product(product, transform));
        let purpose = ConversionPurpose::Save(product, place);
        self.conversion = Some(RunningConversion { work: Beside::start(platform, ctx, work), purpose });
    }

    /// Repairs the environment.
    pub fn repair(&mut self, platform: &mut dyn Platform, ctx: &Context, source: EnvironmentSource) {
        let purpose = ConversionPurpose::Repair(stem(&source.name));
        let work = ConversionWork::new(source, ConversionGoal::Repaired);
        self.conversion = Some(RunningConversion { work: Beside::start(platform, ctx, work), purpose });
    }

    /// Takes results; called in every frame.
    pub fn follow(&mut self, ctx: &Context) -> Vec<EnvironmentNews> {
        if let Some(studied) = self.work.as_mut().and_then(|work| work.poll(ctx)) {
            self.work = None;
            self.serial += 1;
            let studied =
                studied.unwrap_or_else(|| Err(tr!("environment-the-study-of-the-environment-ended").to_owned()));
            self.studied = Some(studied.map(|study| (study, StudyPictures::default())));
        }
        let Some(mut conversion) = self.conversion.take() else { return Vec::new() };
        let Some(converted) = conversion.work.poll(ctx) else {
            self.conversion = Some(conversion);
            return Vec::new();
        };
        let converted =
            converted.unwrap_or_else(|| Err(tr!("environment-the-conversion-of-the-environment-ended").to_owned()));
        vec![match (converted, conversion.purpose) {
            (Err(error), _) => EnvironmentNews::Failed(error),
            (Ok(files), ConversionPurpose::Save(product, place)) => EnvironmentNews::Converted(product, place, files),
            (Ok(files), ConversionPurpose::Repair(stem)) => match files.files.into_iter().next() {
                Some((name, bytes)) => {
                    let name = format!("{stem}_{name}");
                    self.repaired = Some(name.clone());
                    EnvironmentNews::Repaired(name, bytes)
                }
                None => EnvironmentNews::Failed(tr!("environment-the-environment-could-not-be-repaired").to_owned()),
            },
        }]
    }
}

/// The name of an environment as the beginning of a file name.
fn stem(name: &str) -> String {
    let stem = Product::stem(base_name(name.strip_prefix(BUILTIN).unwrap_or(name)));
    let stem = stem.trim_matches('_');
    if stem.is_empty() { "environment".to_owned() } else { stem.to_owned() }
}

/// The proposed name of a file.
pub fn file_name(environment: &str, product: EnvironmentProduct) -> String {
    format!("{}{}.{}", stem(environment), product.suffix(), product.extension())
}

/// The name of a face's file beside the chosen place: `sky.exr` gives `sky_posx.exr`.
pub fn face_file(place: &str, face: &str) -> String {
    let path = Path::new(place);
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!("{stem}_{face}")).to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_environment::encode::Container;

    #[test]
    fn files_are_called_after_the_environment() {
        let product = |container, is_zip| EnvironmentProduct {
            container,
            format: EnvironmentFormat::Exr,
            size: None,
            layout: Layout::OpenGl,
            is_zip,
        };
        assert_eq!(file_name("builtin:sky", product(Container::Cross, false)), "sky_cross.exr");
        assert_eq!(file_name("photos/park.hdr", product(Container::Faces, true)), "park_faces.zip");
        assert_eq!(file_name("faces/sky_*.png", product(Container::Ktx2, false)), "sky.ktx2");
        assert_eq!(file_name("*.png", product(Container::Faces, false)), "environment.exr");
        assert_eq!(face_file("out/sky.exr", "posx.exr"), Path::new("out").join("sky_posx.exr").to_string_lossy());
    }
}
