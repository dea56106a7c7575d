//! The user's own shaders, compiled for one of the backends.

use crate::error::CliError;
use gonio_check::user_shaders::UserShaderProgram;
use gonio_exercises::step::{ShadedPicture, UserPair};
use gonio_reference::ReferenceScene;
use gonio_scene::{DisplayMap, Frame, Scene};

/// The user's shaders, compiled for a backend.
pub enum UserDrawing {
    /// By the driver.
    Gl(UserShaderProgram),
    /// For gonio's interpreter.
    Cpu(UserPair),
}

/// The picture of the user's shaders on the CPU, over the background and the environment as they are shown.
pub fn shaded(
    user: &(UserPair, Scene),
    reference: &ReferenceScene,
    frame: &Frame,
    progress: &dyn Fn(f64),
) -> Result<ShadedPicture, CliError> {
    let (pair, scene) = user;
    let map = DisplayMap::for_view(None, frame);
    let behind = |x: u32, y: u32| {
        let [r, g, b, a] = map.apply(reference.behind(frame, x, y).map(|value| value as f32));
        [r * a, g * a, b * a, a].map(|value| value as f32)
    };
    pair.shaded(scene, frame, behind, progress).map_err(CliError::new)
}

/// The sentence about a picture that the interpreter drew, and the reason if OpenGL was preferred.
pub fn interpreter_sentence(reason: Option<&str>) -> String {
    let reason = reason.and_then(|reason| reason.lines().next()).map(|reason| format!(": {reason}"));
    format!("your shaders were run by gonio's interpreter on the CPU{}", reason.unwrap_or_default())
}
