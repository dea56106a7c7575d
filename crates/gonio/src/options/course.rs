//! The course whose exercises a command knows.

use clap::Args;
use std::path::PathBuf;

/// The course.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Input options")]
pub struct CourseOptions {
    /// Folder of a course with exercises of its own (`gonio help course`).
    ///
    /// By default the folder with a course.toml that is the current one or contains it, if there is one.
    #[arg(long, value_name = "FOLDER")]
    pub course: Option<PathBuf>,
}
