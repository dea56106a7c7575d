//! The constants of OpenGL that programs may use, by their names without `GL_`.

/// One of OpenGL's constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Constant {
    /// Without `GL_`.
    pub name: &'static str,
    /// OpenGL's number.
    pub value: u32,
}

macro_rules! constants {
    ($($name:ident)+) => {
        /// All of them. Whether OpenGL takes one in a certain place is for OpenGL to say.
        pub const CONSTANTS: &[Constant] = &[$(Constant { name: stringify!($name), value: glow::$name }),+];
    };
}

constants! {
    TEXTURE_2D TEXTURE_CUBE_MAP TEXTURE_2D_ARRAY TEXTURE_3D
    TEXTURE_CUBE_MAP_POSITIVE_X TEXTURE_CUBE_MAP_NEGATIVE_X TEXTURE_CUBE_MAP_POSITIVE_Y
    TEXTURE_CUBE_MAP_NEGATIVE_Y TEXTURE_CUBE_MAP_POSITIVE_Z TEXTURE_CUBE_MAP_NEGATIVE_Z
    TEXTURE0 TEXTURE1 TEXTURE2 TEXTURE3 TEXTURE4 TEXTURE5 TEXTURE6 TEXTURE7
    TEXTURE8 TEXTURE9 TEXTURE10 TEXTURE11 TEXTURE12 TEXTURE13 TEXTURE14 TEXTURE15
    TEXTURE_MIN_FILTER TEXTURE_MAG_FILTER TEXTURE_WRAP_S TEXTURE_WRAP_T TEXTURE_WRAP_R
    TEXTURE_BASE_LEVEL TEXTURE_MAX_LEVEL
    NEAREST LINEAR NEAREST_MIPMAP_NEAREST LINEAR_MIPMAP_NEAREST NEAREST_MIPMAP_LINEAR LINEAR_MIPMAP_LINEAR
    REPEAT MIRRORED_REPEAT CLAMP_TO_EDGE CLAMP_TO_BORDER
    R8 RG8 RGB8 RGBA8 SRGB8 SRGB8_ALPHA8 RED RG RGB RGBA
    ARRAY_BUFFER ELEMENT_ARRAY_BUFFER STATIC_DRAW DYNAMIC_DRAW STREAM_DRAW
    BYTE UNSIGNED_BYTE SHORT UNSIGNED_SHORT INT UNSIGNED_INT HALF_FLOAT FLOAT DOUBLE
    POINTS LINES LINE_LOOP LINE_STRIP TRIANGLES TRIANGLE_STRIP TRIANGLE_FAN
    DEPTH_TEST CULL_FACE BLEND SCISSOR_TEST STENCIL_TEST
    COLOR_BUFFER_BIT DEPTH_BUFFER_BIT STENCIL_BUFFER_BIT
}

/// The constant of a name.
pub fn constant(name: &str) -> Option<Constant> {
    CONSTANTS.iter().copied().find(|constant| constant.name == name)
}

/// `TEXTURE0` and so on, by its number.
pub fn texture_unit(unit: u32) -> Option<Constant> {
    CONSTANTS.iter().copied().find(|constant| constant.value == glow::TEXTURE0 + unit)
}

impl Constant {
    /// The unit, where it is one of `TEXTURE0` to `TEXTURE15`.
    pub fn unit(self) -> Option<u32> {
        (glow::TEXTURE0..=glow::TEXTURE15).contains(&self.value).then(|| self.value - glow::TEXTURE0)
    }
}
