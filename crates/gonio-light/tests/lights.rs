//! Light sources: inverse square, cones, and lights where no light should be.
#![allow(clippy::unwrap_used)]

mod support;
use gonio_light::light::smoothstep_or_step;
use gonio_light::{Attenuation, DVec3, Light, LightKind};
use support::assert_close;

fn light(kind: LightKind, attenuation: Attenuation) -> Light {
    Light { kind, color: DVec3::ONE, attenuation }
}

#[test]
fn attenuation_of_the_labs_light() {
    let lab = Attenuation { constant: 1.0, linear: 0.14, quadratic: 0.07 };
    assert_close(lab.at(0.0), 1.0, 1e-15);
    assert_close(lab.at(2.0), 1.0 / 1.56, 1e-15);
    assert_close(lab.at(10.0), 1.0 / 9.4, 1e-15);
    assert_eq!(Attenuation::NONE.at(1e200), 1.0);
}

#[test]
fn inverse_square_at_three_distances() {
    for d in [1.0, 2.0, 4.0] {
        let incident = light(LightKind::Point { position: DVec3::Y * d }, Attenuation::INVERSE_SQUARE)
            .incident(DVec3::ZERO, DVec3::Y)
            .unwrap();
        assert_close(incident.attenuation, 1.0 / (d * d), 1e-15);
        assert_eq!((incident.distance, incident.direction), (d, DVec3::Y));
    }
}

#[test]
fn attenuation_is_capped_and_never_nan() {
    let extremes = [0.0, 1e-320, 1e-12, 1.0, 1e12, 1e160, 1e300, f64::MAX, f64::INFINITY];
    for d in extremes {
        for constant in extremes {
            for linear in [0.0, 1.0, 1e300] {
                for quadratic in [0.0, 1.0, 1e300] {
                    let factor = Attenuation { constant, linear, quadratic }.at(d);
                    assert!(
                        (0.0..=Attenuation::CAP).contains(&factor),
                        "{constant} {linear} {quadratic} {d}: {factor}"
                    );
                }
            }
        }
    }
    assert_eq!(Attenuation::INVERSE_SQUARE.at(0.0), Attenuation::CAP);
    assert_eq!(Attenuation::INVERSE_SQUARE.at(1e-3), Attenuation::CAP);
    assert_eq!(Attenuation::INVERSE_SQUARE.at(f64::INFINITY), 0.0);
    assert_eq!(Attenuation { constant: 0.0, linear: 0.0, quadratic: 0.0 }.at(1.0), Attenuation::CAP);
    assert_eq!(Attenuation { constant: -1.0, linear: 0.0, quadratic: 0.0 }.at(1.0), Attenuation::CAP);
}

#[test]
fn a_light_at_the_point_shines_along_the_normal() {
    let point = light(LightKind::Point { position: DVec3::ONE }, Attenuation::INVERSE_SQUARE);
    let incident = point.incident(DVec3::ONE, DVec3::X).unwrap();
    assert_eq!((incident.direction, incident.distance, incident.attenuation), (DVec3::X, 0.0, Attenuation::CAP));
}

#[test]
fn a_light_beyond_the_range_of_f64_is_far_away_and_not_directional() {
    let point = light(LightKind::Point { position: DVec3::X * f64::MAX }, Attenuation::INVERSE_SQUARE);
    let incident = point.incident(DVec3::NEG_X * f64::MAX, DVec3::Y).unwrap();
    assert_eq!((incident.distance, incident.attenuation), (f64::MAX, 0.0));
}

#[test]
fn directional_light_comes_against_its_direction_unattenuated() {
    let sun = light(LightKind::Directional { direction: DVec3::new(0.0, -2.0, 0.0) }, Attenuation::INVERSE_SQUARE);
    let incident = sun.incident(DVec3::splat(1e9), DVec3::X).unwrap();
    assert_eq!((incident.direction, incident.attenuation, incident.spot), (DVec3::Y, 1.0, 1.0));
    assert!(incident.distance.is_infinite());
    let none = light(LightKind::Directional { direction: DVec3::ZERO }, Attenuation::NONE);
    assert_eq!(none.incident(DVec3::ZERO, DVec3::X).unwrap().direction, DVec3::X);
}

#[test]
fn ambient_light_comes_from_nowhere() {
    assert_eq!(light(LightKind::Ambient, Attenuation::NONE).incident(DVec3::ZERO, DVec3::Y), None);
}

#[test]
fn a_spot_is_full_inside_and_ends_at_its_outer_angle() {
    let (inner_rad, outer_rad) = (20f64.to_radians(), 30f64.to_radians());
    let spot_at = |degrees: f64| {
        let angle = degrees.to_radians();
        let kind = LightKind::Spot { position: DVec3::Y, axis: DVec3::NEG_Y, inner_rad, outer_rad };
        // On the plane y = 0, at `degrees` off the axis.
        light(kind, Attenuation::NONE).incident(DVec3::X * angle.tan(), DVec3::Y).unwrap().spot
    };
    assert_eq!((spot_at(0.0), spot_at(19.9), spot_at(30.1), spot_at(80.0)), (1.0, 1.0, 0.0, 0.0));
    // Halfway between the *cosines* it is 1/2 by smoothstep's symmetry.
    let halfway = (0.5 * (inner_rad.cos() + outer_rad.cos())).acos().to_degrees();
    assert_close(spot_at(halfway), 0.5, 1e-12);
    let mut last = 1.0;
    for step in 0..=200 {
        let value = spot_at(15.0 + 0.1 * f64::from(step));
        assert!(value <= last && (0.0..=1.0).contains(&value));
        last = value;
    }
}

#[test]
fn a_spot_with_a_hard_edge_is_a_step() {
    let angle = 30f64.to_radians();
    let at = |degrees: f64, axis| {
        let kind = LightKind::Spot { position: DVec3::Y, axis, inner_rad: angle, outer_rad: angle };
        light(kind, Attenuation::NONE).incident(DVec3::X * degrees.to_radians().tan(), DVec3::Y).unwrap().spot
    };
    assert_eq!((at(29.99, DVec3::NEG_Y), at(30.01, DVec3::NEG_Y)), (1.0, 0.0));
    // An axis of another length is the same axis.
    assert_eq!((at(29.99, DVec3::NEG_Y * 5.0), at(30.01, DVec3::NEG_Y * 5.0)), (1.0, 0.0));
    assert_eq!(at(0.0, DVec3::ZERO), 0.0);
}

#[test]
fn smoothstep_known_values() {
    assert_eq!(smoothstep_or_step(0.0, 1.0, 0.5), 0.5);
    assert_eq!(smoothstep_or_step(0.0, 1.0, 0.25), 0.15625);
    assert_eq!(smoothstep_or_step(2.0, 4.0, 1.0), 0.0);
    assert_eq!(smoothstep_or_step(2.0, 4.0, 5.0), 1.0);
    assert_eq!((smoothstep_or_step(1.0, 1.0, 0.999), smoothstep_or_step(1.0, 1.0, 1.0)), (0.0, 1.0));
    assert_eq!((smoothstep_or_step(2.0, 1.0, 1.5), smoothstep_or_step(2.0, 1.0, 2.0)), (0.0, 1.0));
}
