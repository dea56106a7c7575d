//! Steps through a pair of shaders: runs it on the CPU, lists the value of every variable at one pixel or vertex, and draws
//! the values of one expression at all pixels.
//!
//! In an exercise, the values of uniforms and attributes and the camera are those of the [preview](crate::preview). A user's
//! own shaders run on any scene ([`UserPair`]), with the values of [`gonio_check::user_shaders`].

mod coverage;
mod endless;
mod listing;
mod pair;
mod picture;
mod right;
mod syntax;
mod textures;
mod user_picture;
mod user_scene;
mod user_textures;
mod value;

#[cfg(test)]
mod tests;

pub use endless::{EndlessLoop, endless_loop};
pub use listing::{ListedCondition, ListedLine, ListedPlace, ListedStep, ListedVariable, StepListing};
pub use pair::{PixelSurface, StepOptions, StepWork, SteppedPair, SteppedScene, SteppedStage};
pub use picture::{ExpressionMapping, ExpressionPicture, NEVER_WRITTEN_COLOUR, PictureBeside};
pub use right::{RightAnswer, RightValue};
pub use syntax::{EvaluatedValue, ExpressionValue, SteppedPlace};
pub use user_picture::ShadedPicture;
pub use user_scene::UserPair;
pub use value::ShownValue;
