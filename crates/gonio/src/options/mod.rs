//! Options that several commands share.
//!
//! A command flattens these groups into its own options; [`values`] parses single values.

mod course;
mod environment;
pub mod limits;
mod scene;
mod trace;
pub mod values;

pub use course::CourseOptions;
pub use environment::EnvironmentOptions;
pub use limits::LimitOptions;
pub use scene::SceneOptions;
pub use trace::TraceOptions;

use clap::Args;
use gonio_language::Language;

/// The heading of the options that every command has.
pub const GENERAL: &str = "General options";

/// The options that every command has.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = GENERAL)]
pub struct GeneralOptions {
    /// Print one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long, short)]
    pub quiet: bool,
    /// Report the driver, the files read and timings on stderr.
    #[arg(long, short, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Language of the window, the exercises and the verdicts.
    ///
    /// By default that of the system, or the one that was selected in the window.
    #[arg(long, value_parser = values::named(&Language::ALL, Language::code))]
    pub language: Option<Language>,
}

/// The renderer that `--backend` asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BackendChoice {
    /// OpenGL where available, else the CPU reference.
    #[default]
    Auto,
    /// OpenGL, or an error.
    Gl,
    /// The CPU reference, in f64 on all cores.
    Cpu,
}

impl BackendChoice {
    pub const ALL: &'static [Self] = &[Self::Auto, Self::Gl, Self::Cpu];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Gl => "gl",
            Self::Cpu => "cpu",
        }
    }
}

/// The renderer and its settings.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Drawing options")]
pub struct BackendOptions {
    /// Renderer: OpenGL, the CPU reference, or OpenGL where available.
    #[arg(long, value_parser = values::named(BackendChoice::ALL, BackendChoice::name), default_value = "auto")]
    pub backend: BackendChoice,
    /// Threads of the CPU reference; all cores by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Load OpenGL's EGL from this library instead of the system's (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub egl_library: Option<String>,
}
