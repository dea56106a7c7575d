//! The rendering equation on the CPU: a spectral path tracer, the truth that the light equation simplifies.
//!
//! A path of light is followed from the eye through a pixel, from surface to surface, until it ends by chance; a
//! pixel is the mean of its paths. Nothing is left out for speed, so pictures have noise instead of errors, and the noise is
//! measured. The same seed gives the same bytes on any number of threads.
//!
//! | module | content |
//! |---|---|
//! | `sampler`, `sampling` | random numbers, and directions and points from them |
//! | `upsampling`, `spectra`, `color` | spectra of RGB colours and others, the lanes of a path |
//! | `tree`, `geometry` | rays against triangles |
//! | `bsdf`, `material` | how a place scatters light |
//! | `rules`, `posed` | what the simplifications change; a scene at one moment |
//! | `lights`, `lamps`, `environment` | where light comes from |
//! | `overlap` | light sources in the same place as other surfaces |
//! | `path`, `film`, `render` | one path; the sums of pixels; all pixels |
//! | `contributions` | where the light of one pixel comes from |
//! | `surface_light` | the light at one point of a surface |
//! | `refinement` | a picture that begins coarse, for windows |
//! | `oddities` | what a scene has that a trace survives |
//! | `features`, `denoise` | what a picture shows without its light; a picture without its noise |

mod bsdf;
mod choice;
mod color;
mod contributions;
mod denoise;
mod diffuse;
mod environment;
mod eye;
mod features;
mod film;
mod geometry;
mod lamps;
mod lights;
mod material;
mod oddities;
mod overlap;
mod own_brdf;
mod path;
mod posed;
mod refinement;
mod render;
mod rules;
mod sampler;
mod sampling;
mod spectra;
mod surface_light;
mod tree;
mod upsampling;
mod wavelengths;

pub use gonio_light::{Simplification, Simplifications};

pub use contributions::{PixelContributions, PixelPaths};
pub use features::Features;
pub use film::{CheckpointError, ErrorEstimate, Film, TILE, TileMask};
pub use lights::LightOrigin;
pub use oddities::TraceOddity;
pub use path::Technique;
pub use refinement::{Refinement, RefinementStatus};
pub use render::{TraceGoal, TraceScene, TraceSettings};
pub use sampler::Sampler;
pub use surface_light::{SurfaceLight, SurfacePoint};
