//! Environments: light that comes from everywhere, as cubemaps and as panoramas.
//!
//! An environment is a function from a direction in the world to linear radiance, seen unmirrored. The world is
//! right-handed, Y is up, and straight ahead is -Z. In memory a cubemap's faces always lie as OpenGL samples them
//! ([`Layout::OpenGl`]); the other layout exists in files only. Bytes in, environments out: nothing here opens a file.
//!
//! | room | what |
//! |---|---|
//! | [`face`] | the six faces, the two layouts, which direction each point of a face is |
//! | [`image`] | a picture of linear light |
//! | [`cubemap`] | six square pictures, looked up without seams |
//! | [`panorama`] | an equirectangular picture |
//! | [`convert`] | from one to the other, filtered, turned |
//! | [`mip`] | smaller and smaller copies of a cubemap |
//! | [`decode`] | files to pictures of linear light |
//! | [`encode`] | pictures and cubemaps to files |
//! | [`names`] | which of six files is which face |
//! | [`arrange`] | crosses and strips: six faces in one picture |
//! | [`limits`] | how much memory a file may ask for |
//! | [`srgb`] | the sRGB curve by table |

pub mod arrange;
pub mod brdf_table;
pub mod builtin;
mod canvas;
pub mod convert;
pub mod cubemap;
pub mod debug;
pub mod decode;
pub mod encode;
pub mod error;
pub mod face;
pub mod harmonics;
pub mod image;
pub mod limits;
pub mod mip;
pub mod names;
mod padded;
pub mod panorama;
pub mod prefilter;
pub mod sky;
mod solid_angle;
pub mod srgb;
mod stroke_font;

pub use arrange::Arrangement;
pub use brdf_table::BrdfTable;
pub use builtin::Builtin;
pub use convert::{Conversion, Filter};
pub use cubemap::Cubemap;
pub use error::EnvironmentError;
pub use face::{Face, Layout};
pub use harmonics::Harmonics;
pub use image::{Image, Pixel};
pub use limits::Limits;
pub use mip::CubeMips;
pub use panorama::Panorama;
pub use prefilter::GlossyMips;
