//! OpenGL's errors, explained for students.

use super::call::Call;
use serde::Serialize;

/// A call that OpenGL refused, or that gonio did not make because its result is undefined. All other calls were made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CallError {
    /// The line of the program, from 1.
    pub line: u32,
    /// `bind_texture`, ...
    pub call: &'static str,
    /// `INVALID_OPERATION`, ...; `UNDEFINED` if OpenGL does not check the call and the result is undefined.
    pub code: String,
    /// The reason: a sentence without a full stop.
    pub why: String,
}

impl std::fmt::Display for CallError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {} raised {}: {}", self.line, self.call, self.code, self.why)
    }
}

/// Explains why OpenGL refuses a call with an error code.
pub fn why(call: &Call, code: &str) -> String {
    let sentence = match (call, code) {
        (Call::ActiveTexture(_), _) => "invalid texture unit: expected TEXTURE0, TEXTURE1 and so on, not a number",
        (Call::BindTexture { .. }, "INVALID_OPERATION") => {
            "the texture was first bound to another target, which it keeps"
        }
        (Call::BindTexture { .. }, _) => "invalid target: textures cannot be bound to it",
        (Call::BindBuffer { .. } | Call::BufferData { .. }, "INVALID_ENUM") => {
            "invalid target or usage: expected ARRAY_BUFFER or ELEMENT_ARRAY_BUFFER, and STATIC_DRAW"
        }
        (Call::VertexAttribPointer(_), "INVALID_VALUE") => {
            "invalid size or stride: an attribute has 1 to 4 components and a stride of 0 to 2048 bytes"
        }
        (Call::VertexAttribPointer(_), "INVALID_ENUM") => "invalid component type: expected FLOAT",
        (Call::TexImage2d { .. }, "INVALID_ENUM") => {
            "invalid target: expected TEXTURE_2D or a face of a cubemap, not TEXTURE_CUBE_MAP"
        }
        (Call::TexImage2d { .. }, "INVALID_VALUE") => {
            "invalid level, format or image size: the first level is 0, and the faces of a cubemap are square"
        }
        (Call::TexImage2d { .. }, _) => "invalid format for an image",
        (Call::TexParameter { .. }, "INVALID_ENUM") => {
            "invalid target, parameter or value: TEXTURE_MAG_FILTER, for example, cannot use mipmaps"
        }
        (Call::GenerateMipmap { .. }, "INVALID_OPERATION") => {
            "cannot generate mipmaps of this texture: a cubemap needs all six faces, of the same size"
        }
        (Call::GenerateMipmap { .. }, _) => "invalid target: it has no mipmaps",
        (Call::Uniform { .. }, "INVALID_VALUE") => "no texture unit has this number",
        (Call::Uniform { .. }, _) => {
            "the call does not match the type of the uniform: samplers and ints need uniform_1i, floats uniform_1f"
        }
        (Call::Viewport(_), _) => "width and height cannot be negative",
        (Call::Switch { .. }, _) => "cannot be enabled or disabled; textures are only bound",
        (Call::DrawArrays { .. } | Call::DrawElements { .. }, "INVALID_OPERATION") => {
            "two samplers of different types read the same unit, or the program cannot run"
        }
        (_, "OUT_OF_MEMORY") => "not enough memory",
        _ => "OpenGL refused the call",
    };
    sentence.to_owned()
}
