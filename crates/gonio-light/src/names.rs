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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use crate::brdf::BrdfKind;
    use crate::color::{ColorEncoding, ToneMap};
    use crate::optics::Medium;
    use crate::{Convention, Fresnel, Quantity, Specular, Surfaces};
    use std::collections::BTreeSet;

    macro_rules! round_trip {
        ($($Enum:ident, $count:literal;)+) => { $(
            assert_eq!($Enum::ALL.len(), $count, stringify!($Enum));
            for &value in $Enum::ALL {
                assert_eq!(value.name().parse(), Ok(value));
                assert_eq!(value.name().to_uppercase().parse(), Ok(value));
                assert_eq!(format!(" {value} ").parse(), Ok(value));
                assert!(!value.description().trim().is_empty(), "{value}");
            }
            let names: BTreeSet<&str> = $Enum::ALL.iter().map(|v| v.name()).collect();
            assert_eq!(names.len(), $Enum::ALL.len(), "two names of {} are equal", stringify!($Enum));
            assert!($Enum::ALL.contains(&$Enum::default()));
        )+ };
    }

    #[test]
    fn names_round_trip() {
        round_trip! {
            Quantity, 29;
            BrdfKind, 5;
            Convention, 2;
            Specular, 3;
            ToneMap, 4;
            ColorEncoding, 2;
            Medium, 5;
            Fresnel, 3;
            Surfaces, 2;
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = "blin".parse::<BrdfKind>().unwrap_err();
        assert_eq!(error.to_string(), "invalid BRDF `blin`: expected one of lambert, lafortune, blinn, phong, ward");
    }

    #[test]
    fn a_quantity_of_one_light_is_not_also_a_sum() {
        for &quantity in Quantity::ALL {
            assert!(!(quantity.per_light() && quantity.summed_over_lights()), "{quantity}");
        }
        assert!(Quantity::Spec.per_light() && Quantity::Specular.summed_over_lights());
    }
}
