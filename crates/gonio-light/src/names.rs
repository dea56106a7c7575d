//! Enums whose variants have one written name each.
//!
//! Scene files, options, debug views and reports all use the name that is declared beside the variant.

/// Declares an enum with a written name for each variant. It gets `ALL`, `name`, `description`, `Display`, `FromStr` (whose
/// error lists the known names), serde and JSON Schema. `what` is the noun in that error.
#[macro_export]
macro_rules! named_enum {
    (
        $(#[$meta:meta])*
        pub enum $Enum:ident {
            $( $(#[doc = $doc:literal])+ $Variant:ident = $name:literal, )+
        }
        default $Default:ident;
        what $what:literal;
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, ::serde::Serialize, ::serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(::schemars::JsonSchema))]
        pub enum $Enum {
            $( $(#[doc = $doc])+ #[serde(rename = $name)] $Variant, )+
        }

        impl $Enum {
            /// Every variant, in the order of declaration.
            pub const ALL: &'static [$Enum] = &[$($Enum::$Variant),+];

            /// The name that scene files, options and reports use.
            pub const fn name(self) -> &'static str {
                match self { $($Enum::$Variant => $name),+ }
            }

            /// One sentence for help texts.
            pub const fn description(self) -> &'static str {
                match self { $($Enum::$Variant => concat!($($doc),+)),+ }
            }
        }

        impl Default for $Enum {
            fn default() -> Self { $Enum::$Default }
        }

        impl ::core::fmt::Display for $Enum {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.pad(self.name())
            }
        }

        impl ::core::str::FromStr for $Enum {
            type Err = $crate::names::UnknownName;
            fn from_str(text: &str) -> Result<Self, Self::Err> {
                $Enum::ALL
                    .iter()
                    .copied()
                    .find(|v| v.name().eq_ignore_ascii_case(text.trim()))
                    .ok_or_else(|| $crate::names::UnknownName {
                        what: $what,
                        given: text.to_owned(),
                        known: $Enum::ALL.iter().map(|v| v.name()).collect(),
                    })
            }
        }
    };
}

/// The error for a name that is not one of an enum's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The noun for the enum, for example `shading`.
    pub what: &'static str,
    /// The unknown name.
    pub given: String,
    /// The known names.
    pub known: Vec<&'static str>,
}

impl core::fmt::Display for UnknownName {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "invalid {} `{}`: expected one of {}", self.what, self.given, self.known.join(", "))
    }
}

impl core::error::Error for UnknownName {}
