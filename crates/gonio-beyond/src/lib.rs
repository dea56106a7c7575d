//! Beyond the rendering equation: phenomena of light that the equation leaves out, each as a small station with its law,
//! pictures, a plot and checks.
//!
//! | module | content |
//! |---|---|
//! | `station` | the description of a station: texts, parameters, pictures, plot, checks |
//! | `stations` | the stations, each a folder or a file |
//! | `refinement` | a picture that begins coarse and becomes finer |
//! | `description`, `work` | a station for a window: its texts as data, and its computation beside the window |
//! | `page` | a station's page as Markdown |
//! | `bands`, `complex` | spectra in bands with their colours; complex amplitudes of waves |
//! | `camera`, `noise`, `random` | rays, shapes and textures of the pictures; steps of random walks |
//!
//! It opens no file. Pictures are functions of a point of the image plane, so that every shell can refine them.

#![forbid(unsafe_code)]

mod bands;
mod camera;
mod complex;
mod description;
mod noise;
mod page;
mod random;
mod refinement;
mod station;
mod stations;
mod work;

pub use description::StationDescription;
pub use page::{StationFiles, page};
pub use refinement::PictureRefinement;
pub use station::{ImagePlane, LawCheck, Station, StationPicture};
pub use stations::{STATIONS, station};
pub use work::{MOST_SAMPLES, RefinedPicture, StationRequest, StationResult, StationWork};
