//! Sections of rows of exhibits, and the scenes that exhibits start from. Nothing here depends on how they are drawn.

use crate::GalleryError;
use crate::environment_picture::EnvironmentPicture;
use crate::station_exhibit::StationExhibit;
use gonio_scene::{SceneFile, ViewSpec, toml_file};

/// A chapter of the gallery. Its texts may use the markup of [`crate::markup`].
pub struct Section {
    /// Lower case letters for links, reports and file names.
    pub id: &'static str,
    /// The heading; empty for the pictures at the very top.
    pub title: &'static str,
    /// The part of the equation that the section is about.
    pub equation: &'static str,
    /// One or two sentences.
    pub introduction: &'static str,
    /// The pictures; those of one row have the same height.
    pub rows: Vec<Vec<Exhibit>>,
}

/// The source of a picture.
pub enum ExhibitSubject {
    /// A scene, complete but for the size of its picture, which the row decides.
    Scene(Box<SceneFile>),
    /// An environment laid out on the plane: a conversion on the CPU, without a scene.
    Environment(EnvironmentPicture),
    /// A picture of a station beyond the rendering equation: light that no scene of the light equation has.
    Station(StationExhibit),
}

/// One picture.
pub struct Exhibit {
    /// Unique name of its files, without an extension.
    pub name: String,
    /// A few words below the picture.
    pub caption: String,
    /// A few words below the caption.
    pub remark: String,
    /// The equation with the terms at work: `!{..}` is emphasised, `~{..}` is switched off.
    pub equation: String,
    /// One or two sentences that explain the picture.
    pub look: String,
    /// The source of the picture.
    pub subject: ExhibitSubject,
    /// A debug view in place of a scene's picture.
    pub view: Option<ViewSpec>,
    /// Time in seconds, for lights that move.
    pub time: f64,
    /// Width over height.
    pub aspect: f64,
    /// A sign before the picture on the sheet: `+`, `=` or an arrow.
    pub joiner: Option<&'static str>,
    /// Replaces the remark by the number of vertices and fragments lit.
    pub counts_as_remark: bool,
    /// Draws the picture at its size on the sheet, because single pixels matter or take long to draw.
    pub at_sheet_size: bool,
}

impl Exhibit {
    /// Creates a square picture of `scene`.
    pub fn new(name: impl Into<String>, caption: impl Into<String>, scene: SceneFile) -> Self {
        Self::with_subject(name.into(), caption.into(), ExhibitSubject::Scene(Box::new(scene)))
    }

    /// Creates a picture of an environment with the aspect of its form.
    pub fn environment(name: impl Into<String>, caption: impl Into<String>, picture: EnvironmentPicture) -> Self {
        Self::with_subject(name.into(), caption.into(), ExhibitSubject::Environment(picture)).aspect(picture.aspect())
    }

    /// Creates a picture of a station with its defaults.
    pub fn station(caption: impl Into<String>, station: StationExhibit) -> Self {
        let exhibit = Self::with_subject(station.file_stem(), caption.into(), ExhibitSubject::Station(station));
        exhibit.aspect(StationExhibit::ASPECT)
    }

    /// Returns its scene, if it is one.
    pub fn scene(&self) -> Option<&SceneFile> {
        if let ExhibitSubject::Scene(scene) = &self.subject { Some(scene) } else { None }
    }

    fn with_subject(name: String, caption: String, subject: ExhibitSubject) -> Self {
        Exhibit {
            name,
            caption,
            remark: String::new(),
            equation: String::new(),
            look: String::new(),
            subject,
            view: None,
            time: 0.0,
            aspect: 1.0,
            joiner: None,
            counts_as_remark: false,
            at_sheet_size: false,
        }
    }

    /// Sets the small line below the caption.
    pub fn remark(mut self, remark: impl Into<String>) -> Self {
        self.remark = remark.into();
        self
    }

    /// Sets the equation and the sentences that explain the picture.
    pub fn about(mut self, equation: impl Into<String>, look: impl Into<String>) -> Self {
        self.equation = equation.into();
        self.look = look.into();
        self
    }

    /// Sets width over height.
    pub fn aspect(mut self, aspect: f64) -> Self {
        self.aspect = aspect;
        self
    }

    /// Shows a debug view in place of the picture.
    pub fn view(mut self, view: ViewSpec) -> Self {
        self.view = Some(view);
        self
    }

    /// Sets the time in seconds.
    pub fn at(mut self, time: f64) -> Self {
        self.time = time;
        self
    }

    /// Sets the sign before the picture: `+`, `=` or an arrow.
    pub fn joined(mut self, joiner: Option<&'static str>) -> Self {
        self.joiner = joiner;
        self
    }

    /// Draws the picture at its size on the sheet.
    pub fn at_sheet_size(mut self) -> Self {
        self.at_sheet_size = true;
        self
    }

    /// Replaces the remark by the number of vertices and fragments lit.
    pub fn with_counts(mut self) -> Self {
        self.counts_as_remark = true;
        self
    }
}

/// A scene that exhibits start from. It names built-in models and environments only.
#[derive(Clone, Copy, Debug)]
pub enum BaseScene {
    /// The still life by night.
    StillLife,
    /// A portrait.
    Suzanne,
    /// One sphere.
    Sphere,
    /// A smooth sphere in the room.
    RoomSphere,
    /// Suzanne in the room.
    RoomSuzanne,
}

impl BaseScene {
    /// All base scenes.
    pub const ALL: [BaseScene; 5] =
        [BaseScene::StillLife, BaseScene::Suzanne, BaseScene::Sphere, BaseScene::RoomSphere, BaseScene::RoomSuzanne];

    /// Reads the scene.
    ///
    /// # Errors
    ///
    /// A fault in the built-in text.
    pub fn scene(self) -> Result<SceneFile, GalleryError> {
        let text = match self {
            BaseScene::StillLife => include_str!("base_scenes/still_life.toml"),
            BaseScene::Suzanne => include_str!("base_scenes/suzanne.toml"),
            BaseScene::Sphere => include_str!("base_scenes/sphere.toml"),
            BaseScene::RoomSphere => include_str!("base_scenes/room_sphere.toml"),
            BaseScene::RoomSuzanne => include_str!("base_scenes/room_suzanne.toml"),
        };
        Ok(toml_file::read(text)?)
    }

    /// Reads the scene and changes it.
    ///
    /// # Errors
    ///
    /// A fault in the built-in text.
    pub fn with(self, change: impl FnOnce(&mut SceneFile)) -> Result<SceneFile, GalleryError> {
        let mut scene = self.scene()?;
        change(&mut scene);
        Ok(scene)
    }
}
