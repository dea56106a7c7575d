//! Names of OpenGL's constants, and sizes of its types.

/// A function that returns the name of a constant, or its number if it is unknown.
macro_rules! names {
    ($(#[$doc:meta])* $name:ident { $($constant:ident => $word:literal,)+ }) => {
        $(#[$doc])*
        pub fn $name(code: u32) -> String {
            match code {
                $(glow::$constant => $word.to_owned(),)+
                other => format!("{other:#06x}"),
            }
        }
    };
}

names! {
    /// Primitives.
    primitive {
        POINTS => "points", LINES => "lines", LINE_STRIP => "line strip", LINE_LOOP => "line loop",
        TRIANGLES => "triangles", TRIANGLE_STRIP => "triangle strip", TRIANGLE_FAN => "triangle fan",
    }
}

names! {
    /// Comparisons of depths.
    comparison {
        NEVER => "never", LESS => "less", EQUAL => "equal", LEQUAL => "less or equal", GREATER => "greater",
        NOTEQUAL => "not equal", GEQUAL => "greater or equal", ALWAYS => "always",
    }
}

names! {
    /// Culled faces.
    faces {
        FRONT => "front", BACK => "back", FRONT_AND_BACK => "front and back",
    }
}

names! {
    /// Factors of blending.
    factor {
        ZERO => "zero", ONE => "one", SRC_COLOR => "source colour", ONE_MINUS_SRC_COLOR => "one minus source colour",
        DST_COLOR => "destination colour", ONE_MINUS_DST_COLOR => "one minus destination colour",
        SRC_ALPHA => "source alpha", ONE_MINUS_SRC_ALPHA => "one minus source alpha",
        DST_ALPHA => "destination alpha", ONE_MINUS_DST_ALPHA => "one minus destination alpha",
        CONSTANT_COLOR => "constant colour", ONE_MINUS_CONSTANT_COLOR => "one minus constant colour",
        CONSTANT_ALPHA => "constant alpha", ONE_MINUS_CONSTANT_ALPHA => "one minus constant alpha",
        SRC_ALPHA_SATURATE => "source alpha, saturated",
    }
}

names! {
    /// Filters and wrap modes.
    sampling {
        NEAREST => "nearest", LINEAR => "linear", NEAREST_MIPMAP_NEAREST => "nearest mipmap nearest",
        LINEAR_MIPMAP_NEAREST => "linear mipmap nearest", NEAREST_MIPMAP_LINEAR => "nearest mipmap linear",
        LINEAR_MIPMAP_LINEAR => "linear mipmap linear", REPEAT => "repeat", MIRRORED_REPEAT => "mirrored repeat",
        CLAMP_TO_EDGE => "clamp to edge", CLAMP_TO_BORDER => "clamp to border",
    }
}

names! {
    /// Formats of textures and renderbuffers.
    format {
        R8 => "R8", RG8 => "RG8", RGB8 => "RGB8", RGBA8 => "RGBA8", SRGB8 => "SRGB8", SRGB8_ALPHA8 => "SRGB8_ALPHA8",
        R16F => "R16F", RG16F => "RG16F", RGB16F => "RGB16F", RGBA16F => "RGBA16F", R32F => "R32F", RG32F => "RG32F",
        RGB32F => "RGB32F", RGBA32F => "RGBA32F", R11F_G11F_B10F => "R11F_G11F_B10F", R32I => "R32I", R32UI => "R32UI",
        RED => "RED", RG => "RG", RGB => "RGB", RGBA => "RGBA", DEPTH_COMPONENT => "DEPTH_COMPONENT",
        DEPTH_COMPONENT16 => "DEPTH_COMPONENT16", DEPTH_COMPONENT24 => "DEPTH_COMPONENT24",
        DEPTH_COMPONENT32F => "DEPTH_COMPONENT32F", DEPTH24_STENCIL8 => "DEPTH24_STENCIL8",
        DEPTH32F_STENCIL8 => "DEPTH32F_STENCIL8",
    }
}

names! {
    /// Attachment points.
    attachment {
        DEPTH_ATTACHMENT => "depth", STENCIL_ATTACHMENT => "stencil", DEPTH_STENCIL_ATTACHMENT => "depth and stencil",
        COLOR_ATTACHMENT0 => "color 0", COLOR_ATTACHMENT1 => "color 1", COLOR_ATTACHMENT2 => "color 2",
        COLOR_ATTACHMENT3 => "color 3",
    }
}

names! {
    /// Errors.
    error {
        INVALID_ENUM => "INVALID_ENUM", INVALID_VALUE => "INVALID_VALUE", INVALID_OPERATION => "INVALID_OPERATION",
        INVALID_FRAMEBUFFER_OPERATION => "INVALID_FRAMEBUFFER_OPERATION", OUT_OF_MEMORY => "OUT_OF_MEMORY",
        CONTEXT_LOST => "CONTEXT_LOST",
    }
}

names! {
    /// Types of an attribute's numbers.
    component {
        BYTE => "byte", UNSIGNED_BYTE => "unsigned byte", SHORT => "short", UNSIGNED_SHORT => "unsigned short",
        INT => "int", UNSIGNED_INT => "unsigned int", HALF_FLOAT => "half float", FLOAT => "float",
    }
}

names! {
    /// Types of GLSL.
    glsl_type {
        FLOAT => "float", FLOAT_VEC2 => "vec2", FLOAT_VEC3 => "vec3", FLOAT_VEC4 => "vec4", INT => "int",
        INT_VEC2 => "ivec2", INT_VEC3 => "ivec3", INT_VEC4 => "ivec4", UNSIGNED_INT => "uint",
        UNSIGNED_INT_VEC2 => "uvec2", UNSIGNED_INT_VEC3 => "uvec3", UNSIGNED_INT_VEC4 => "uvec4", BOOL => "bool",
        BOOL_VEC2 => "bvec2", BOOL_VEC3 => "bvec3", BOOL_VEC4 => "bvec4", FLOAT_MAT2 => "mat2", FLOAT_MAT3 => "mat3",
        FLOAT_MAT4 => "mat4", FLOAT_MAT2x3 => "mat2x3", FLOAT_MAT2x4 => "mat2x4", FLOAT_MAT3x2 => "mat3x2",
        FLOAT_MAT3x4 => "mat3x4", FLOAT_MAT4x2 => "mat4x2", FLOAT_MAT4x3 => "mat4x3", SAMPLER_2D => "sampler2D",
        SAMPLER_CUBE => "samplerCube", SAMPLER_2D_ARRAY => "sampler2DArray", SAMPLER_3D => "sampler3D",
        SAMPLER_2D_MULTISAMPLE => "sampler2DMS", SAMPLER_2D_SHADOW => "sampler2DShadow",
        SAMPLER_CUBE_SHADOW => "samplerCubeShadow", INT_SAMPLER_2D => "isampler2D", UNSIGNED_INT_SAMPLER_2D => "usampler2D",
    }
}

/// The scalar type of a uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GlslScalar {
    /// `float`
    Float,
    /// `int`
    Int,
    /// `uint`
    Uint,
    /// `bool`
    Bool,
}

/// Returns the scalar type and the number of scalars of a GLSL type; `None` for samplers and unknown types.
pub fn layout(code: u32) -> Option<(GlslScalar, usize)> {
    Some(match code {
        glow::FLOAT => (GlslScalar::Float, 1),
        glow::FLOAT_VEC2 => (GlslScalar::Float, 2),
        glow::FLOAT_VEC3 => (GlslScalar::Float, 3),
        glow::FLOAT_VEC4 | glow::FLOAT_MAT2 => (GlslScalar::Float, 4),
        glow::FLOAT_MAT2x3 | glow::FLOAT_MAT3x2 => (GlslScalar::Float, 6),
        glow::FLOAT_MAT2x4 | glow::FLOAT_MAT4x2 => (GlslScalar::Float, 8),
        glow::FLOAT_MAT3 => (GlslScalar::Float, 9),
        glow::FLOAT_MAT3x4 | glow::FLOAT_MAT4x3 => (GlslScalar::Float, 12),
        glow::FLOAT_MAT4 => (GlslScalar::Float, 16),
        glow::INT => (GlslScalar::Int, 1),
        glow::INT_VEC2 => (GlslScalar::Int, 2),
        glow::INT_VEC3 => (GlslScalar::Int, 3),
        glow::INT_VEC4 => (GlslScalar::Int, 4),
        glow::UNSIGNED_INT => (GlslScalar::Uint, 1),
        glow::UNSIGNED_INT_VEC2 => (GlslScalar::Uint, 2),
        glow::UNSIGNED_INT_VEC3 => (GlslScalar::Uint, 3),
        glow::UNSIGNED_INT_VEC4 => (GlslScalar::Uint, 4),
        glow::BOOL => (GlslScalar::Bool, 1),
        glow::BOOL_VEC2 => (GlslScalar::Bool, 2),
        glow::BOOL_VEC3 => (GlslScalar::Bool, 3),
        glow::BOOL_VEC4 => (GlslScalar::Bool, 4),
        _ => return None,
    })
}

/// Bytes of one number of an attribute.
pub fn component_bytes(code: u32) -> u32 {
    match code {
        glow::BYTE | glow::UNSIGNED_BYTE => 1,
        glow::SHORT | glow::UNSIGNED_SHORT | glow::HALF_FLOAT => 2,
        glow::DOUBLE => 8,
        _ => 4,
    }
}

/// The kind of a texture or of a sampler. Each unit has a binding for each kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureKind {
    /// `GL_TEXTURE_2D`
    Flat,
    /// `GL_TEXTURE_CUBE_MAP`
    Cube,
    /// `GL_TEXTURE_2D_ARRAY`
    Array,
    /// `GL_TEXTURE_3D`
    Solid,
    /// `GL_TEXTURE_2D_MULTISAMPLE`
    Multisample,
}

impl TextureKind {
    /// Every kind.
    pub const ALL: [TextureKind; 5] =
        [TextureKind::Flat, TextureKind::Cube, TextureKind::Array, TextureKind::Solid, TextureKind::Multisample];

    /// The kind of a target of `glBindTexture`, or of a face of a cubemap.
    pub fn from_target(target: u32) -> Option<TextureKind> {
        Some(match target {
            glow::TEXTURE_2D => TextureKind::Flat,
            glow::TEXTURE_CUBE_MAP => TextureKind::Cube,
            glow::TEXTURE_CUBE_MAP_POSITIVE_X..=glow::TEXTURE_CUBE_MAP_NEGATIVE_Z => TextureKind::Cube,
            glow::TEXTURE_2D_ARRAY => TextureKind::Array,
            glow::TEXTURE_3D => TextureKind::Solid,
            glow::TEXTURE_2D_MULTISAMPLE => TextureKind::Multisample,
            _ => return None,
        })
    }

    /// The kind that a sampler of this type reads; `None` if the type is not a sampler.
    pub fn from_sampler_type(glsl_type: u32) -> Option<TextureKind> {
        Some(match glsl_type {
            glow::SAMPLER_2D | glow::SAMPLER_2D_SHADOW | glow::INT_SAMPLER_2D | glow::UNSIGNED_INT_SAMPLER_2D => {
                TextureKind::Flat
            }
            glow::SAMPLER_CUBE
            | glow::SAMPLER_CUBE_SHADOW
            | glow::INT_SAMPLER_CUBE
            | glow::UNSIGNED_INT_SAMPLER_CUBE => TextureKind::Cube,
            glow::SAMPLER_2D_ARRAY
            | glow::SAMPLER_2D_ARRAY_SHADOW
            | glow::INT_SAMPLER_2D_ARRAY
            | glow::UNSIGNED_INT_SAMPLER_2D_ARRAY => TextureKind::Array,
            glow::SAMPLER_3D | glow::INT_SAMPLER_3D | glow::UNSIGNED_INT_SAMPLER_3D => TextureKind::Solid,
            glow::SAMPLER_2D_MULTISAMPLE => TextureKind::Multisample,
            _ => return None,
        })
    }

    /// The target of `glBindTexture`.
    pub fn target(self) -> u32 {
        match self {
            TextureKind::Flat => glow::TEXTURE_2D,
            TextureKind::Cube => glow::TEXTURE_CUBE_MAP,
            TextureKind::Array => glow::TEXTURE_2D_ARRAY,
            TextureKind::Solid => glow::TEXTURE_3D,
            TextureKind::Multisample => glow::TEXTURE_2D_MULTISAMPLE,
        }
    }

    /// The name in records.
    pub fn name(self) -> &'static str {
        match self {
            TextureKind::Flat => "2D",
            TextureKind::Cube => "cube",
            TextureKind::Array => "2D array",
            TextureKind::Solid => "3D",
            TextureKind::Multisample => "2D multisample",
        }
    }

    /// Its place in [`TextureKind::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}
