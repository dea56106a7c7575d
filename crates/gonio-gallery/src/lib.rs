//! The gallery of `gonio tour`: every technique on several models.
//!
//! [`sections`] defines the exhibits, [`drawing`] draws one, [`contact_sheet`] and [`page`] put the pictures together. No
//! function here prints or opens a file of its own; models and environments are built in, so that a web page can show
//! the gallery too. A new technique adds a file in `sections`.

pub mod contact_sheet;
pub mod drawing;
pub mod environment_picture;
pub mod exhibit;
pub mod markup;
pub mod page;
pub mod rgb_image;
pub mod sections;
pub mod station_exhibit;
mod typesetter;

pub use contact_sheet::{Placement, SheetLayout};
pub use exhibit::{BaseScene, Exhibit, ExhibitSubject, Section};
pub use rgb_image::RgbImage;

use gonio_environment::EnvironmentError;
use gonio_gl::GlError;
use gonio_image::ImageError;
use gonio_mesh::ReadError;
use std::fmt;

/// The error of a picture that could not be made.
#[derive(Clone, Debug)]
pub enum GalleryError {
    /// A scene could not be read or loaded.
    Scene(ReadError),
    /// An environment could not be converted.
    Environment(EnvironmentError),
    /// A picture could not be encoded or decoded.
    Image(ImageError),
    /// OpenGL failed.
    OpenGl(GlError),
    /// A built-in font cannot be read.
    Font(&'static str),
    /// A step gave another result than it should: one sentence.
    Incomplete(String),
}

impl fmt::Display for GalleryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GalleryError::Scene(error) => error.fmt(f),
            GalleryError::Environment(error) => error.fmt(f),
            GalleryError::Image(error) => error.fmt(f),
            GalleryError::OpenGl(error) => f.write_str(&error.message),
            GalleryError::Font(name) => write!(f, "the built-in font {name} cannot be read"),
            GalleryError::Incomplete(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for GalleryError {}

impl From<ReadError> for GalleryError {
    fn from(error: ReadError) -> Self {
        GalleryError::Scene(error)
    }
}

impl From<EnvironmentError> for GalleryError {
    fn from(error: EnvironmentError) -> Self {
        GalleryError::Environment(error)
    }
}

impl From<ImageError> for GalleryError {
    fn from(error: ImageError) -> Self {
        GalleryError::Image(error)
    }
}

impl From<GlError> for GalleryError {
    fn from(error: GlError) -> Self {
        GalleryError::OpenGl(error)
    }
}
