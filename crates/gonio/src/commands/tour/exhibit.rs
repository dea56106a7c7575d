//! What the tour is made of: sections of rows of exhibits. Nothing here knows how they are drawn.

use super::converted::Converted;
use crate::report::CliError;
use gonio_scene::{SceneFile, ViewSpec, toml_reader};

/// A chapter of the tour. Its texts may use the markup of [`super::maths`].
pub struct Section {
    /// For links, reports and file names: lower case letters.
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

/// What a picture is made from.
pub enum Subject {
    /// A scene, drawn by whoever draws the tour. Everything is in it but the size of the picture, which its row decides.
    Scene(Box<SceneFile>),
    /// An environment, laid out on the plane. No scene draws it, and the CPU makes it.
    Converted(Converted),
}

/// One picture.
pub struct Exhibit {
    /// The file's name without its ending, unique in the tour.
    pub name: String,
    /// Below the picture, a few words.
    pub caption: String,
    /// Below the caption, a few words.
    pub remark: String,
    /// The equation with the terms in play; `!{..}` is stressed, `~{..}` is not in play.
    pub equation: String,
    /// What to look at: one or two sentences.
    pub look: String,
    /// What it is made from.
    pub subject: Subject,
    /// A debug view in place of a scene's picture.
    pub view: Option<ViewSpec>,
    /// Seconds: where moving lights are.
    pub time: f64,
    /// Width over height.
    pub aspect: f64,
    /// Stands before the picture on the sheet: `+`, `=`, an arrow.
    pub joiner: Option<&'static str>,
    /// The remark is the number of vertices and fragments lit.
    pub counts_as_remark: bool,
    /// Drawn as large as it stands on the sheet: its pixels are what is to be seen, or dear.
    pub exact: bool,
}

impl Exhibit {
    /// A square picture of `scene`.
    pub fn new(name: impl Into<String>, caption: impl Into<String>, scene: SceneFile) -> Self {
        Self::of(name.into(), caption.into(), Subject::Scene(Box::new(scene)))
    }

    /// An environment, as wide as its arrangement is.
    pub fn converted(name: impl Into<String>, caption: impl Into<String>, converted: Converted) -> Self {
        Self::of(name.into(), caption.into(), Subject::Converted(converted)).aspect(converted.aspect())
    }

    fn of(name: String, caption: String, subject: Subject) -> Self {
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
            exact: false,
        }
    }

    /// The small line below the caption.
    pub fn remark(mut self, remark: impl Into<String>) -> Self {
        self.remark = remark.into();
        self
    }

    /// The equation, and what to look at.
    pub fn tells(mut self, equation: impl Into<String>, look: impl Into<String>) -> Self {
        self.equation = equation.into();
        self.look = look.into();
        self
    }

    /// Width over height.
    pub fn aspect(mut self, aspect: f64) -> Self {
        self.aspect = aspect;
        self
    }

    /// Shows a debug view.
    pub fn view(mut self, view: ViewSpec) -> Self {
        self.view = Some(view);
        self
    }

    /// Seconds.
    pub fn at(mut self, time: f64) -> Self {
        self.time = time;
        self
    }

    /// `+`, `=` or an arrow before the picture.
    pub fn joined(mut self, joiner: Option<&'static str>) -> Self {
        self.joiner = joiner;
        self
    }

    /// Drawn as large as it stands on the sheet.
    pub fn exact(mut self) -> Self {
        self.exact = true;
        self
    }

    /// Vertices and fragments in place of the remark.
    pub fn counted(mut self) -> Self {
        self.counts_as_remark = true;
        self
    }
}

/// The stages: scenes that exhibits start from.
#[derive(Clone, Copy, Debug)]
pub enum Stage {
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

impl Stage {
    /// All of them.
    #[cfg(test)]
    pub const ALL: [Stage; 5] =
        [Stage::StillLife, Stage::Suzanne, Stage::Sphere, Stage::RoomSphere, Stage::RoomSuzanne];

    /// The scene; only built-in models and environments are in it.
    pub fn scene(self) -> Result<SceneFile, CliError> {
        let text = match self {
            Stage::StillLife => include_str!("stages/still_life.toml"),
            Stage::Suzanne => include_str!("stages/suzanne.toml"),
            Stage::Sphere => include_str!("stages/sphere.toml"),
            Stage::RoomSphere => include_str!("stages/room_sphere.toml"),
            Stage::RoomSuzanne => include_str!("stages/room_suzanne.toml"),
        };
        Ok(toml_reader::read(text)?)
    }

    /// The scene, changed.
    pub fn with(self, change: impl FnOnce(&mut SceneFile)) -> Result<SceneFile, CliError> {
        let mut scene = self.scene()?;
        change(&mut scene);
        Ok(scene)
    }
}
