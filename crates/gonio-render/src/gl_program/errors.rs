//! OpenGL's errors, in words a student can do something with.

use super::call::Call;
use serde::Serialize;

/// A call that OpenGL refused, or that gonio did not dare to make. Everything before and after it was carried out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CallError {
    /// Of the host program.
    pub line: u32,
    /// `bind_texture`, ...
    pub call: &'static str,
    /// `INVALID_OPERATION`, ...; `UNDEFINED` where OpenGL does not check, and whatever may happen.
    pub code: String,
    /// Why: a sentence without its end.
    pub why: String,
}

impl std::fmt::Display for CallError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {} gives {}: {}", self.line, self.call, self.code, self.why)
    }
}

/// Why OpenGL refuses a call with a code, where the driver alone has said so.
pub fn why(call: &Call, code: &str) -> String {
    let sentence = match (call, code) {
        (Call::ActiveTexture(_), _) => "this is no unit: write TEXTURE0, TEXTURE1 and so on, not a number",
        (Call::BindTexture { .. }, "INVALID_OPERATION") => {
            "a texture keeps the target that it was bound to first, and this is another one"
        }
        (Call::BindTexture { .. }, _) => "textures are not bound to this target",
        (Call::BindBuffer { .. } | Call::BufferData { .. }, "INVALID_ENUM") => {
            "buffers are bound to ARRAY_BUFFER or ELEMENT_ARRAY_BUFFER, and used for STATIC_DRAW"
        }
        (Call::VertexAttribPointer(_), "INVALID_VALUE") => {
            "an attribute has 1 to 4 numbers, and its stride is 0 to 2048 bytes"
        }
        (Call::VertexAttribPointer(_), "INVALID_ENUM") => "numbers are not of this type: write FLOAT",
        (Call::TexImage2d { .. }, "INVALID_ENUM") => {
            "this is no target for an image: TEXTURE_2D is one, and each face of a cubemap, but not TEXTURE_CUBE_MAP"
        }
        (Call::TexImage2d { .. }, "INVALID_VALUE") => {
            "the level, the format or the image's size cannot be: level 0 comes first, and faces of a cubemap are square"
        }
        (Call::TexImage2d { .. }, _) => "an image cannot be kept in this format",
        (Call::TexParameter { .. }, "INVALID_ENUM") => {
            "the target, the parameter or its value cannot be: TEXTURE_MAG_FILTER, for one, knows no mipmaps"
        }
        (Call::GenerateMipmap { .. }, "INVALID_OPERATION") => {
            "of this texture no mipmaps can be made: a cubemap wants all six faces, of one size"
        }
        (Call::GenerateMipmap { .. }, _) => "this target has no mipmaps",
        (Call::Uniform { .. }, "INVALID_VALUE") => "there is no unit of that number",
        (Call::Uniform { .. }, _) => {
            "the uniform is of another type than the call: a sampler and an int want uniform_1i, a float uniform_1f"
        }
        (Call::Viewport(_), _) => "width and height cannot be negative",
        (Call::Switch { .. }, _) => "this cannot be switched on or off; textures need not be, they are bound",
        (Call::DrawArrays { .. } | Call::DrawElements { .. }, "INVALID_OPERATION") => {
            "two samplers of different types read one unit, or the program cannot run"
        }
        (_, "OUT_OF_MEMORY") => "there is not enough memory for this",
        _ => "OpenGL refuses it",
    };
    sentence.to_owned()
}
