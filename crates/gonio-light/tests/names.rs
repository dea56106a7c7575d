//! Every written name leads back to what it names.
#![allow(clippy::unwrap_used)]

use gonio_light::brdf::BrdfKind;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::fresnel::Medium;
use gonio_light::{Convention, Fresnel, Quantity, Specular, Surfaces};
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
        Quantity, 28;
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
fn an_unknown_name_is_answered_with_the_known_ones() {
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
