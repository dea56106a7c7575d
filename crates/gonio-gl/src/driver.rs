//! The driver: its name, its limits, its extensions, and the dialect of GLSL that it compiles.

use crate::Gl;

/// WEBGL_debug_renderer_info
const UNMASKED_RENDERER_WEBGL: u32 = 0x9246;

/// The driver, as it describes itself, and its limits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DriverInfo {
    /// `GL_RENDERER`
    pub renderer: String,
    /// `GL_VERSION`
    pub version: String,
    /// `GL_SHADING_LANGUAGE_VERSION`
    pub glsl: String,
    /// Most samples per pixel of a float target.
    pub max_samples: u32,
    /// Largest picture or texture, pixels along one side.
    pub max_size: u32,
    /// Largest face of a cubemap, texels along one side.
    pub max_cube_size: u32,
    /// The dialect of GLSL that it compiles.
    pub dialect: Dialect,
    /// EXT_texture_filter_anisotropic, or OpenGL 4.6.
    pub anisotropy: bool,
    /// ARB_pipeline_statistics_query, or OpenGL 4.6.
    pub pipeline_statistics: bool,
}

impl DriverInfo {
    /// Returns whether it draws on the CPU.
    pub fn is_software(&self) -> bool {
        ["llvmpipe", "softpipe", "SwiftShader"].iter().any(|name| self.renderer.contains(name))
    }

    /// Queries the driver of a context.
    pub fn new(gl: &Gl) -> Self {
        let at_least_4_6 = !gl.is_embedded() && gl.version() >= (4, 6);
        #[cfg(not(target_arch = "wasm32"))]
        let samples = [glow::RGBA32F, glow::DEPTH_COMPONENT24].map(|format| gl.functions().get_most_samples(format));
        // WebGL returns all numbers of samples, and glow requires that they fit into the slice. This is the limit of
        // 8-bit formats; a float target that has fewer is made with one sample.
        #[cfg(target_arch = "wasm32")]
        let samples = [gl.get_parameter_i32(glow::MAX_SAMPLES)];
        // Browsers return the actual name only for the unmasked parameter.
        let name = if gl.supports("WEBGL_debug_renderer_info") { UNMASKED_RENDERER_WEBGL } else { glow::RENDERER };
        // Multisampled textures have a limit of their own; OpenGL ES 3.0 has none of them.
        let textures = if gl.is_embedded() { i32::MAX } else { gl.get_parameter_i32(glow::MAX_COLOR_TEXTURE_SAMPLES) };
        let sizes = [glow::MAX_TEXTURE_SIZE, glow::MAX_RENDERBUFFER_SIZE].map(|p| gl.get_parameter_i32(p));
        DriverInfo {
            renderer: gl.get_parameter_string(name),
            version: gl.get_parameter_string(glow::VERSION),
            glsl: gl.get_parameter_string(glow::SHADING_LANGUAGE_VERSION),
            max_samples: samples.into_iter().chain([textures]).min().unwrap_or(1).max(1) as u32,
            max_size: sizes.into_iter().min().unwrap_or(2048).max(1) as u32,
            max_cube_size: gl.get_parameter_i32(glow::MAX_CUBE_MAP_TEXTURE_SIZE).max(1) as u32,
            dialect: gl.dialect(),
            anisotropy: at_least_4_6
                || gl.supports("GL_EXT_texture_filter_anisotropic")
                || gl.supports("EXT_texture_filter_anisotropic"),
            pipeline_statistics: at_least_4_6 || gl.supports("GL_ARB_pipeline_statistics_query"),
        }
    }
}

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
            // Some drivers use 16 bits for mediump, with visible errors.
            Dialect::Es300 => {
                "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
            }
        }
    }
}
