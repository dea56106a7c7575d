//! The dialects of GLSL.

/// The GLSL that a driver compiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// `#version 330 core`
    Core330,
    /// `#version 300 es`: WebGL2 and OpenGL ES 3.
    Es300,
}

impl Dialect {
    /// Both dialects.
    pub const ALL: [Dialect; 2] = [Dialect::Core330, Dialect::Es300];

    /// The first lines of every shader: version and precision.
    pub fn header(self) -> &'static str {
        match self {
            Dialect::Core330 => "#version 330 core\n",
            // Some drivers take mediump at its word (16 bits), with visible errors.
            Dialect::Es300 => {
                "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
            }
        }
    }
}
