//! Versions of GLSL, shader stages, and the versions that shaders are translated to.

/// A `#version`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Version {
    /// The number: 110 to 460; 100, 300, 310, 320 for OpenGL ES.
    pub number: u32,
    /// Whether it is a version of OpenGL ES.
    pub es: bool,
    /// Line of the directive, 0 if there is none.
    pub line: u32,
    /// Whether it has the `compatibility` profile.
    pub compatibility: bool,
}

impl Version {
    /// The version of a file without `#version`.
    pub const NONE: Self = Self { number: 110, es: false, line: 0, compatibility: false };

    /// Whether it is at least `desktop`, or at least `es` in OpenGL ES; 0 is never.
    #[must_use]
    pub fn is_at_least(self, desktop: u32, es: u32) -> bool {
        let least = if self.es { es } else { desktop };
        least != 0 && self.number >= least
    }

    /// Whether `int` converts to `float` implicitly: in desktop GLSL from 1.20 on (GLSL 1.20, section 4.1.10).
    #[must_use]
    pub fn converts_int_to_float(self) -> bool {
        self.is_at_least(120, 0)
    }

    /// Whether `int` converts to `uint` implicitly: in desktop GLSL from 4.00 on (GLSL 4.00, section 4.1.10).
    #[must_use]
    pub fn converts_int_to_uint(self) -> bool {
        self.is_at_least(400, 0)
    }

    /// Whether `attribute`, `varying`, `texture2D` and `gl_FragColor` are the regular names.
    #[must_use]
    pub fn is_old(self) -> bool {
        !self.is_at_least(130, 300)
    }

    /// Whether names that were removed from the core profile still exist.
    #[must_use]
    pub fn has_legacy_names(self) -> bool {
        !self.es && (self.number < 140 || self.compatibility)
    }

    /// Returns the version as it is written: `330`, `300 es`.
    #[must_use]
    pub fn written(self) -> String {
        if self.es && self.number >= 300 { format!("{} es", self.number) } else { self.number.to_string() }
    }
}

/// The stage of a shader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// The vertex shader.
    Vertex,
    /// The fragment shader.
    Fragment,
}

impl Stage {
    /// The other stage.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Vertex => Self::Fragment,
            Self::Fragment => Self::Vertex,
        }
    }
}

impl std::fmt::Display for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vertex => "vertex",
            Self::Fragment => "fragment",
        })
    }
}

/// A version that shaders are translated to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OutputVersion {
    /// `#version 330 core`.
    Core330,
    /// `#version 300 es`, which is WebGL 2.
    Es300,
}

impl OutputVersion {
    /// Returns the version.
    #[must_use]
    pub fn version(self) -> Version {
        match self {
            Self::Core330 => Version { number: 330, es: false, line: 1, compatibility: false },
            Self::Es300 => Version { number: 300, es: true, line: 1, compatibility: false },
        }
    }
}
