//! Environments: light that comes from everywhere, as cubemaps and as panoramas.
//!
//! An environment is a function from a direction in the world to linear radiance, seen unmirrored. The world is
//! right-handed, Y is up, and straight ahead is -Z. In memory a cubemap's faces always lie as OpenGL samples them
//! ([`Layout::OpenGl`]); the other layout exists in files only. Files are decoded and encoded by `gonio-image`.
//!
//! | room | what |
//! |---|---|
//! | [`face`] | the six faces, the two layouts, which direction each point of a face is |
//! | [`cubemap`] | six square pictures, looked up without seams |
//! | [`panorama`] | an equirectangular picture |
//! | [`convert`] | from one to the other, filtered, turned |
//! | [`mip`] | smaller and smaller copies of a cubemap |
//! | [`harmonics`] | diffuse light by nine spherical harmonics |
//! | [`prefilter`] | glossy light: an environment blurred for each roughness |
//! | [`mod@check`] | whether the edges of six faces meet, and what is wrong if they do not |
//! | [`mod@check_panorama`] | whether a panorama closes at its sides and poles |
//! | [`repair`] | mirroring, turning and swapping faces back |
//! | [`builtin`] | environments by name, which need no file |
//! | [`debug`] | a cubemap of which every face says which one it is |
//! | [`sky`] | a clear sky with its sun |
//! | [`brdf_table`] | what a rough mirror makes of uniform light, as a texture |
//! | [`names`] | which of six files is which face |
//! | [`arrange`] | crosses and strips: six faces in one picture |
//! | [`simd`] | instruction sets that a conversion can run on |

pub mod arrange;
pub mod brdf_table;
pub mod builtin;
mod canvas;
pub mod check;
pub mod check_panorama;
pub mod convert;
pub mod cubemap;
pub mod debug;
pub mod error;
pub mod face;
pub mod harmonics;
pub mod mip;
pub mod names;
mod padded;
pub mod panorama;
mod placement;
pub mod prefilter;
pub mod repair;
mod seams;
pub mod simd;
pub mod sky;
mod solid_angle;
mod stroke_font;

pub use arrange::Arrangement;
pub use brdf_table::BrdfTable;
pub use builtin::Builtin;
pub use check::{Certificate, check};
pub use check_panorama::{PanoramaCertificate, check_panorama};
pub use convert::{Conversion, Filter};
pub use cubemap::Cubemap;
pub use error::EnvironmentError;
pub use face::{Face, Layout};
pub use harmonics::Harmonics;
pub use mip::CubeMips;
pub use panorama::Panorama;
pub use prefilter::GlossyMips;
pub use repair::Repair;
pub use simd::SimdLevel;
