//! The gallery of `gonio tour`: every technique on several models.
//!
//! [`sections`] holds the exhibits, [`drawing`] draws one, [`contact_sheet`] and [`page`] put the pictures together. No
//! function here prints or opens a file of its own; models and environments are built in, so that a web page can show
//! the gallery too. A new technique adds a file in `sections`.

mod base_scene;
pub mod contact_sheet;
pub mod drawing;
pub mod environment_picture;
mod error;
pub mod exhibit;
pub mod markup;
pub mod page;
pub mod rgb_image;
pub mod sections;
pub mod sheet_layout;
mod typesetter;

pub use base_scene::BaseScene;
pub use error::GalleryError;
pub use exhibit::{Exhibit, Section, Subject};
pub use rgb_image::RgbImage;
pub use sheet_layout::{Placement, SheetLayout};
