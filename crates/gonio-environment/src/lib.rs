//! Environments: light that comes from everywhere, as cubemaps and as panoramas.
//!
//! An environment is a function from a direction in the world to linear radiance, seen unmirrored. The world is
//! right-handed, Y is up, and straight ahead is -Z. In memory a cubemap's faces always lie as OpenGL samples them
//! ([`Layout::OpenGl`]); the other layout exists in files only. Files are decoded and encoded by `gonio-image`.
//!
//! | module | contents |
//! |---|---|
//! | [`face`] | the six faces, the two layouts, the direction of each point of a face |
//! | [`cubemap`] | six square pictures, looked up without seams |
//! | [`panorama`] | an equirectangular picture |
//! | [`convert`] | conversion between both, filtered and turned |
//! | [`mip`] | mip levels of a cubemap |
//! | [`harmonics`] | diffuse light by nine spherical harmonics |
//! | [`prefilter`] | glossy light: an environment blurred for each roughness |
//! | [`small_lights`] | suns and lamps, apart from the rest |
//! | [`mod@check`] | whether the edges of six faces meet, and which repair makes them meet |
//! | [`mod@check_panorama`] | whether a panorama closes at its sides and poles |
//! | [`repair`] | mirroring, turning and swapping faces back |
//! | [`builtin`] | built-in environments |
//! | [`debug`] | a cubemap with labelled faces |
//! | [`sky`] | a clear sky with its sun |
//! | [`brdf_table`] | scale and bias of the split sum, as a texture |
//! | [`names`] | assignment of files to faces by name |
//! | [`arrange`] | crosses and strips: six faces in one picture |
//! | [`encode`] | environments as files: containers, formats, bytes |
//! | [`simd`] | instruction sets for conversions |

pub mod arrange;
pub mod brdf_table;
pub mod builtin;
pub mod check;
pub mod check_panorama;
pub mod convert;
pub mod cubemap;
pub mod debug;
pub mod encode;
pub mod error;
pub mod face;
mod face_drawing;
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
pub mod small_lights;

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
pub use small_lights::{SeparatedLights, SmallLight};
