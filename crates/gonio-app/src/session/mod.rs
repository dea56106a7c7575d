//! State that is not undone: loaded scene, time, selection, messages.

mod clock;
pub mod comparison;
mod equation;
mod messages;
mod observer;
pub mod probing;
mod recorded_frame;
mod selection;
mod settings;

pub use clock::Clock;
pub use comparison::Comparison;
pub use equation::{BeforeAlone, EquationView, Term};
pub use messages::{Message, Messages, Severity};
pub use observer::Observer;
pub use probing::Probing;
pub use recorded_frame::RecordedFrame;
pub use selection::{Selection, Tab};
pub use settings::Settings;

use crate::saving::Product;
use gonio_scene::Scene;
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
    /// What to save there; `None` to open a file.
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
    /// The selected light or object.
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
    /// The probed pixel and its values.
    pub probing: Probing,
    /// The observer's view.
    pub observer: Observer,
    /// The last change, for screen readers.
    pub announcement: String,
    /// Incremented when geometry or materials of `loaded` change and have to be uploaded.
    pub generation: u64,
    /// Measurements of the panes.
    pub comparison: Comparison,
    /// Slow pictures are drawn with one sample while something moves.
    pub adaptive: bool,
    /// Something is being dragged, or time runs.
    pub moving: bool,
    /// The open scene has no camera of its own: all objects are framed once the size of the
    /// picture is known.
    pub unframed: bool,
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
            probing: Probing::default(),
            observer: Observer::default(),
            announcement: String::new(),
            generation: 0,
            comparison: Comparison::default(),
            adaptive: true,
            moving: false,
            unframed: false,
            sketching: false,
        }
    }
}
