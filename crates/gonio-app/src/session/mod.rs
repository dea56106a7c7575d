//! What is not undone: what was loaded, where time stands, what is selected, what was said.

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

/// Facts about the last drawn picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameFacts {
    /// Pixels of the current pane.
    pub size: [u32; 2],
    /// Milliseconds that drawing took, as far as the CPU knows.
    pub draw_ms: f64,
    /// How many pictures were drawn since the start: stands still where nothing changes.
    pub pictures: u64,
    /// How many times the window was painted: stands still too, where nothing changes.
    pub frames: u64,
    /// The driver.
    pub renderer: String,
    /// What the driver could not do as asked.
    pub notes: Vec<String>,
    /// Samples per pixel of the last picture.
    pub samples: u32,
}

/// A path that a person is writing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathField {
    /// What is to be saved there; nothing where a file is to be opened.
    pub saves: Option<Product>,
    /// As far as it is written.
    pub text: String,
}

/// What is not undone.
pub struct Session {
    /// The document's scene with its files read; none until the first was.
    pub loaded: Option<Arc<Scene>>,
    /// What was opened, as a person calls it.
    pub title: String,
    /// Seconds, and whether they run.
    pub clock: Clock,
    /// What the side panel is about.
    pub selection: Selection,
    /// Which of its tabs is shown.
    pub tab: Tab,
    /// What of the equation is looked at.
    pub equation: EquationView,
    /// What was said and not yet read.
    pub messages: Messages,
    /// Files are being read: what is said meanwhile.
    pub busy: Option<String>,
    /// How many files, and how many bytes, were read until now.
    pub progress: Option<(usize, u64)>,
    /// Whether the list of keys is shown.
    pub help: bool,
    /// A path is asked for: by the window itself, where the system has no dialogs.
    pub asking: Option<PathField>,
    /// What is kept from one time to the next.
    pub settings: Settings,
    /// About the last picture.
    pub facts: FrameFacts,
    /// What OpenGL was told for a picture; none until somebody wanted to see it.
    pub recorded_frame: Option<RecordedFrame>,
    /// The pixel that is asked for, and its numbers.
    pub probing: Probing,
    /// The camera from outside.
    pub observer: Observer,
    /// What changed last, for those who hear the screen.
    pub announcement: String,
    /// Counts whenever geometry or materials of `loaded` change: what is on the GPU is then uploaded anew.
    pub generation: u64,
    /// What was measured of the panes.
    pub comparison: Comparison,
    /// Pictures that take long are drawn with one sample while something moves.
    pub adaptive: bool,
    /// Something is being dragged, or time runs.
    pub moving: bool,
    /// Nobody said where the camera of the open scene stands: it is put where all objects are in the picture, once it is
    /// known how wide that is.
    pub unframed: bool,
    /// The next pictures are the first ones of what was opened, and they are wanted soon: one sample a pixel must do, and
    /// the whole pictures follow right after. Only where the driver is a program and the pictures may take long.
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
