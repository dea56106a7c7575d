//! State that is not undone: loaded scene, time, selection, messages.

pub mod comparison;
mod equation;
mod hints;
mod messages;
mod own_shaders;
pub mod probing;
mod settings;

pub use comparison::PaneComparison;
pub use equation::{BeforeAlone, EquationView, Term};
pub use hints::UsageHint;
pub use messages::{MessageAnswer, MessageCause, MessageSeverity, Messages, UserMessage};
pub use own_shaders::OwnShaders;
pub use probing::Probing;
pub use settings::Settings;

use crate::baking::Baking;
use crate::environment::EnvironmentView;
use crate::inspector::Inspector;
use crate::platform::CaptureAccess;
use crate::saving::Product;
use crate::truth::{PixelLight, TracedPane};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use gonio_gl::trace::{Finding, FrameRecord, lint};
use gonio_language::tr;
use gonio_scene::Scene;
use std::collections::HashMap;
use std::sync::Arc;

/// Facts about the last picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameFacts {
    /// Pixels of the current pane.
    pub size: [u32; 2],
    /// Milliseconds of the last finished frame.
    pub draw_ms: f64,
    /// Number of pictures drawn since the start; constant while nothing changes.
    pub pictures: u64,
    /// Number of times that the window was painted; constant while nothing changes.
    pub frames: u64,
    /// The driver.
    pub renderer: String,
    /// Settings that the driver does not support.
    pub notes: Vec<String>,
    /// Samples per pixel of the last picture.
    pub samples: u32,
}

/// A path that is being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathField {
    /// The product to save there; `None` to open a file.
    pub saves: Option<Product>,
    /// The text so far.
    pub text: String,
}

/// State that is not undone.
pub struct Session {
    /// The document's scene with its files; `None` until the first is loaded.
    pub loaded: Option<Arc<Scene>>,
    /// The title of the open scene.
    pub title: String,
    /// The animation's time.
    pub clock: Clock,
    /// The selected light, object or part.
    pub selection: Selection,
    /// The visible tab.
    pub tab: Tab,
    /// State of the equation panel.
    pub equation: EquationView,
    /// Messages to the user.
    pub messages: Messages,
    /// A description of the files that are being loaded, if any.
    pub busy: Option<String>,
    /// Number of files and bytes loaded so far.
    pub progress: Option<(usize, u64)>,
    /// Whether the keyboard shortcuts are shown.
    pub help: bool,
    /// The path field, for systems without file dialogs.
    pub asking: Option<PathField>,
    /// Settings that are kept between sessions.
    pub settings: Settings,
    /// Facts about the last picture.
    pub facts: FrameFacts,
    /// The recorded OpenGL calls of a picture, once requested.
    pub recorded_frame: Option<RecordedFrame>,
    /// Whether frames can be captured for RenderDoc.
    pub capture_access: CaptureAccess,
    /// The probed pixel and its values.
    pub probing: Probing,
    /// The observer's view.
    pub observer: Observer,
    /// The last change, for screen readers.
    pub announcement: String,
    /// Incremented when geometry or materials of `loaded` change and must be uploaded.
    pub generation: u64,
    /// Measurements of the panes.
    pub comparison: PaneComparison,
    /// The traced picture of each pane.
    pub traced: Vec<TracedPane>,
    /// The user's own shaders, if there are any.
    pub shaders: Option<OwnShaders>,
    /// Baking, and the newest baked atlas.
    pub baking: Baking,
    /// The files of the scene.
    pub inspector: Inspector,
    /// The panel of the environment.
    pub environment: EnvironmentView,
    /// Whether slow pictures are drawn with one sample while something moves.
    pub adaptive: bool,
    /// Whether something is being dragged, or time runs.
    pub moving: bool,
    /// The open scene has no camera of its own: all objects are framed once the size of the
    /// picture is known.
    pub unframed: bool,
    /// The open scene is a sample with a camera of its own, which is moved back if the picture would cut off objects once its
    /// size is known.
    pub is_new_sample: bool,
    /// The next pictures are the first ones of a scene: they have one sample per pixel to appear soon, and the
    /// full pictures follow. Only with software drivers.
    pub sketching: bool,
}

impl Default for Session {
    fn default() -> Self {
        Session {
            loaded: None,
            title: String::new(),
            clock: Clock::default(),
            selection: Selection::None,
            tab: Tab::Lights,
            equation: EquationView::default(),
            messages: Messages::default(),
            busy: None,
            progress: None,
            help: false,
            asking: None,
            settings: Settings::default(),
            facts: FrameFacts::default(),
            recorded_frame: None,
            capture_access: CaptureAccess::default(),
            probing: Probing::default(),
            observer: Observer::default(),
            announcement: String::new(),
            generation: 0,
            comparison: PaneComparison::default(),
            traced: Vec::new(),
            shaders: None,
            baking: Baking::default(),
            inspector: Inspector::default(),
            environment: EnvironmentView::default(),
            adaptive: true,
            moving: false,
            unframed: false,
            is_new_sample: false,
            sketching: false,
        }
    }
}

/// The animation's time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Seconds of the scene.
    pub time: f64,
    /// Whether it runs.
    pub playing: bool,
}

impl Clock {
    /// Advances the time by `seconds`, at most a tenth of a second: a hidden window or a slow frame causes long pauses.
    pub fn advance(&mut self, seconds: f64) {
        if self.playing && seconds.is_finite() {
            self.time += seconds.clamp(0.0, 0.1);
        }
    }
}

/// The second camera.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observer {
    /// Whether it is shown.
    pub open: bool,
    /// Whether it rotates automatically.
    pub turning: bool,
    /// Azimuth and elevation, radians. `None` until it is opened.
    pub(crate) angles: Option<(f64, f64)>,
}

impl Observer {
    /// Shows or hides it, and resets its position.
    pub fn toggle(&mut self) {
        *self = Observer { open: !self.open, ..Observer::default() };
    }
}

/// The selected light, object, part or camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// Nothing.
    #[default]
    None,
    /// A light of the scene, by its index.
    Light(usize),
    /// An object of the scene, by its index.
    Object(usize),
    /// A part of an object, by the object's index and its own.
    Part(usize, usize),
    /// The camera.
    Camera,
}

impl Selection {
    /// The selected object, or that of the selected part.
    pub fn object(self) -> Option<usize> {
        match self {
            Selection::Object(object) | Selection::Part(object, _) => Some(object),
            _ => None,
        }
    }

    /// Selects a part, by the object's index and its own, or nothing.
    pub fn of_part(part: Option<[usize; 2]>) -> Self {
        part.map_or(Selection::None, |[object, part]| Selection::Part(object, part))
    }

    /// The selected part: the object's index and its own.
    pub fn part(self) -> Option<[usize; 2]> {
        match self {
            Selection::Part(object, part) => Some([object, part]),
            _ => None,
        }
    }
}

/// The tabs of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// The lights.
    #[default]
    Lights,
    /// Objects and their materials.
    Objects,
    /// The camera and its matrices.
    Camera,
    /// Environment, background and display.
    Picture,
    /// The equation at a pixel.
    Probe,
    /// Panes side by side.
    Compare,
    /// The recorded OpenGL calls of the picture.
    Frame,
    /// The files of the scene, and what they hold.
    File,
    /// The user's own shaders; only if there are any.
    Shaders,
    /// Baking; only once it was opened.
    Bake,
    /// The environment; only once it was opened.
    Environment,
}

impl Tab {
    /// All tabs, in order.
    pub const ALL: [Tab; 11] = [
        Tab::Lights,
        Tab::Objects,
        Tab::Camera,
        Tab::Picture,
        Tab::Probe,
        Tab::Compare,
        Tab::Frame,
        Tab::File,
        Tab::Shaders,
        Tab::Bake,
        Tab::Environment,
    ];

    /// A stable name for programs.
    pub fn id(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// The title.
    pub fn title(self) -> &'static str {
        match self {
            Tab::Lights => tr!("window-lights"),
            Tab::Objects => tr!("window-objects"),
            Tab::Camera => tr!("window-camera"),
            Tab::Picture => tr!("window-picture"),
            Tab::Probe => tr!("window-probe"),
            Tab::Compare => tr!("window-compare"),
            Tab::Frame => tr!("window-frame"),
            Tab::File => tr!("window-file"),
            Tab::Shaders => tr!("window-shaders"),
            Tab::Bake => tr!("window-bake"),
            Tab::Environment => tr!("window-environment"),
        }
    }

    /// A description in one sentence.
    pub fn description(self) -> &'static str {
        match self {
            Tab::Lights => tr!("window-lights-each-adds-one-summand-to"),
            Tab::Objects => tr!("window-models-their-transformations-and-materials"),
            Tab::Camera => tr!("window-camera-parameters-and-matrices"),
            Tab::Picture => tr!("window-environment-background-exposure-and-tone-mapping"),
            Tab::Probe => tr!("window-the-light-equation-at-one-pixel"),
            Tab::Compare => tr!("window-the-scene-with-up-to-four"),
            Tab::Frame => tr!("window-the-opengl-calls-that-drew-this"),
            Tab::File => tr!("window-what-the-model-s-file-holds"),
            Tab::Shaders => tr!("window-your-own-shaders-and-the-values"),
            Tab::Bake => tr!("window-textures-for-new-texture-coordinates-baked"),
            Tab::Environment => tr!("window-faces-of-the-environment"),
        }
    }
}

/// A record of a picture.
pub struct RecordedFrame {
    /// The record.
    pub record: FrameRecord,
    /// The problems found in it.
    pub findings: Vec<Finding>,
    /// The recorded picture: [`FrameFacts::pictures`] at the time.
    pub picture: u64,
    /// The selected draw.
    pub draw: usize,
    /// Whether the fragment shader's source is shown, not the vertex shader's.
    pub fragment_source: bool,
    thumbnails: HashMap<u32, TextureHandle>,
}

impl RecordedFrame {
    /// Checks a record. The draw that was selected in `before` stays selected.
    pub fn new(ctx: &Context, record: FrameRecord, picture: u64, before: Option<&RecordedFrame>) -> Self {
        let show = |id: u32| {
            let thumbnail = record.texture(id)?.thumbnail.as_ref()?;
            let size = [thumbnail.width as usize, thumbnail.height as usize];
            let image = ColorImage::from_rgba_unmultiplied(size, &thumbnail.rgba);
            Some((id, ctx.load_texture(format!("thumbnail {id}"), image, TextureOptions::LINEAR)))
        };
        let thumbnails = record.textures.iter().filter_map(|texture| show(texture.id)).collect();
        let last = record.draws.len().saturating_sub(1);
        RecordedFrame {
            findings: lint(&record),
            picture,
            draw: before.map_or(0, |before| before.draw.min(last)),
            fragment_source: before.is_none_or(|before| before.fragment_source),
            thumbnails,
            record,
        }
    }

    /// A small picture of a texture, by id.
    pub fn thumbnail(&self, id: u32) -> Option<&TextureHandle> {
        self.thumbnails.get(&id)
    }
}

impl Session {
    /// Lets the pinned pixel go, with the part that was selected there.
    pub fn unpin(&mut self) {
        self.probing.pinned = None;
        if self.selection.part().is_some() && self.tab != Tab::Objects {
            self.selection = Selection::None;
        }
    }

    /// The light of the probed pixel by the way it took, if its pane is traced and it is known.
    pub fn pixel_light(&self) -> Option<&PixelLight> {
        let reading = self.probing.reading()?;
        let light = self.traced.get(self.probing.pane)?.light.as_ref();
        light.filter(|light| light.pixel == [reading.x, reading.y])
    }
}
