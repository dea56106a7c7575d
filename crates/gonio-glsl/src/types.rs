//! The types of GLSL.

/// The type of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scalar {
    /// `bool`
    Bool,
    /// `int`
    Int,
    /// `uint`
    UInt,
    /// `float`
    Float,
    /// `double`
    Double,
}

/// A type.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Type {
    /// The return type of a function without a value.
    Void,
    /// A scalar.
    Scalar(Scalar),
    /// A vector with 2 to 4 components.
    Vector(Scalar, u8),
    /// A matrix of `float` or `double`.
    Matrix {
        /// The component type: `float` or `double`.
        scalar: Scalar,
        /// The number of columns, 2 to 4.
        columns: u8,
        /// The number of rows, 2 to 4.
        rows: u8,
    },
    /// A sampler or image, by name.
    Opaque(String),
    /// A struct, by name.
    Struct(String),
    /// An array; without a number if the size is open.
    Array(Box<Type>, Option<u32>),
}

impl Type {
    /// `float`
    pub const FLOAT: Self = Self::Scalar(Scalar::Float);
    /// `int`
    pub const INT: Self = Self::Scalar(Scalar::Int);
    /// `uint`
    pub const UINT: Self = Self::Scalar(Scalar::UInt);
    /// `bool`
    pub const BOOL: Self = Self::Scalar(Scalar::Bool);

    /// Returns a vector of floats, or `float` for 1.
    #[must_use]
    pub fn floats(count: u8) -> Self {
        Self::scalar_or_vector(Scalar::Float, count)
    }

    /// Returns a vector, or the scalar for 1.
    #[must_use]
    pub fn scalar_or_vector(scalar: Scalar, count: u8) -> Self {
        if count == 1 { Self::Scalar(scalar) } else { Self::Vector(scalar, count) }
    }

    /// Returns the built-in type with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "void" => Self::Void,
            "bool" => Self::BOOL,
            "int" => Self::INT,
            "uint" => Self::UINT,
            "float" => Self::FLOAT,
            "double" => Self::Scalar(Scalar::Double),
            _ => return Self::vector(name).or_else(|| Self::matrix(name)).or_else(|| Self::opaque(name)),
        })
    }

    fn vector(name: &str) -> Option<Self> {
        let at = name.find("vec")?;
        let scalar = match &name[..at] {
            "" => Scalar::Float,
            "b" => Scalar::Bool,
            "i" => Scalar::Int,
            "u" => Scalar::UInt,
            "d" => Scalar::Double,
            _ => return None,
        };
        let size = digit(&name[at + 3..])?;
        Some(Self::Vector(scalar, size))
    }

    fn matrix(name: &str) -> Option<Self> {
        let (scalar, rest) = match name.strip_prefix('d') {
            Some(rest) => (Scalar::Double, rest),
            None => (Scalar::Float, name),
        };
        let size = rest.strip_prefix("mat")?;
        let (columns, rows) = match size.split_once('x') {
            Some((columns, rows)) => (digit(columns)?, digit(rows)?),
            None => (digit(size)?, digit(size)?),
        };
        Some(Self::Matrix { scalar, columns, rows })
    }

    fn opaque(name: &str) -> Option<Self> {
        let rest = name.strip_prefix(['i', 'u']).filter(|r| r.starts_with("sampler") || r.starts_with("image"));
        let rest = rest.unwrap_or(name);
        let shape = rest.strip_prefix("sampler").or_else(|| rest.strip_prefix("image"));
        const SHAPES: [&str; 17] = [
            "1D",
            "2D",
            "3D",
            "Cube",
            "2DRect",
            "1DShadow",
            "2DShadow",
            "CubeShadow",
            "2DRectShadow",
            "1DArray",
            "2DArray",
            "1DArrayShadow",
            "2DArrayShadow",
            "CubeArray",
            "CubeArrayShadow",
            "Buffer",
            "2DMS",
        ];
        let is_known = shape.is_some_and(|s| SHAPES.contains(&s) || s == "2DMSArray" || s == "ExternalOES");
        (is_known || name == "atomic_uint").then(|| Self::Opaque(name.to_string()))
    }

    /// Returns the name as it is written in a shader.
    #[must_use]
    pub fn written(&self) -> String {
        match self {
            Self::Void => "void".into(),
            Self::Scalar(scalar) => scalar.word().into(),
            Self::Vector(scalar, size) => format!("{}vec{size}", scalar.letter()),
            Self::Matrix { scalar, columns, rows } if columns == rows => format!("{}mat{columns}", scalar.letter()),
            Self::Matrix { scalar, columns, rows } => format!("{}mat{columns}x{rows}", scalar.letter()),
            Self::Opaque(name) | Self::Struct(name) => name.clone(),
            // The outer size is written first.
            Self::Array(..) => {
                let mut sizes = String::new();
                let mut inner = self;
                while let Self::Array(of, size) = inner {
                    sizes += &size.map_or("[]".to_string(), |n| format!("[{n}]"));
                    inner = of;
                }
                inner.written() + &sizes
            }
        }
    }

    /// Returns the component type, if there is one.
    #[must_use]
    pub fn scalar(&self) -> Option<Scalar> {
        match self {
            Self::Scalar(s) | Self::Vector(s, _) | Self::Matrix { scalar: s, .. } => Some(*s),
            _ => None,
        }
    }

    /// Returns the number of components of a scalar, vector or matrix.
    #[must_use]
    pub fn components(&self) -> Option<u32> {
        match self {
            Self::Scalar(_) => Some(1),
            Self::Vector(_, n) => Some(u32::from(*n)),
            Self::Matrix { columns, rows, .. } => Some(u32::from(columns * rows)),
            _ => None,
        }
    }

    /// Returns the same shape with another component type.
    #[must_use]
    pub fn with_scalar(&self, to: Scalar) -> Self {
        match self {
            Self::Scalar(_) => Self::Scalar(to),
            Self::Vector(_, n) => Self::Vector(to, *n),
            Self::Matrix { columns, rows, .. } => Self::Matrix { scalar: to, columns: *columns, rows: *rows },
            other => other.clone(),
        }
    }

    /// Returns the innermost element type of an array, or the type itself.
    #[must_use]
    pub fn innermost(&self) -> &Self {
        match self {
            Self::Array(of, _) => of.innermost(),
            other => other,
        }
    }

    /// Whether some version of the language converts this to `to` implicitly: `int` to `uint` to `float` to `double`,
    /// component by component (GLSL 4.60, section 4.1.10).
    #[must_use]
    pub fn becomes(&self, to: &Self) -> bool {
        if self == to {
            return true;
        }
        match (self.scalar(), to.scalar()) {
            (Some(from), Some(into)) => {
                from != Scalar::Bool && into != Scalar::Bool && from <= into && self.with_scalar(into) == *to
            }
            _ => match (self, to) {
                (Self::Array(a, m), Self::Array(b, n)) => a == b && (m == n || m.is_none() || n.is_none()),
                _ => false,
            },
        }
    }
}

impl std::fmt::Display for Type {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.written())
    }
}

impl Scalar {
    /// Returns the GLSL keyword.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::Int => "int",
            Self::UInt => "uint",
            Self::Float => "float",
            Self::Double => "double",
        }
    }

    fn letter(self) -> &'static str {
        match self {
            Self::Bool => "b",
            Self::Int => "i",
            Self::UInt => "u",
            Self::Float => "",
            Self::Double => "d",
        }
    }
}

fn digit(text: &str) -> Option<u8> {
    text.parse().ok().filter(|n| (2..=4).contains(n) && text.len() == 1)
}
