//! The options that help with an error or a warning: libraries do not know them.

use gonio_gl::Remedy;
use gonio_mesh::Cause;

/// What follows the message: empty where no option helps.
pub fn hint(cause: Option<Cause>) -> &'static str {
    match cause {
        None => "",
        Some(Cause::MemoryLimit) => "; --max-memory raises the limit",
        Some(Cause::Sandbox) => "; without --sandbox it is read",
        Some(Cause::EnvironmentAsModel) => " with --environment",
        Some(Cause::NoEnvironment) => "; --environment gives it one",
        Some(Cause::GuessedLayout) => " with --environment-layout",
        Some(Cause::CoarseEnvironment) => " with --environment-size",
    }
}

/// What follows the message of an error of OpenGL: empty where no option helps.
pub fn opengl_hint(remedy: Option<Remedy>) -> &'static str {
    match remedy {
        None => "",
        Some(Remedy::CpuRenderer) => "; `--backend cpu` needs no OpenGL",
        Some(Remedy::SmallerPicture) => " (--size, --samples)",
    }
}
