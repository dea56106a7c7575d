//! Lights and the vectors of the light equation.

#![allow(clippy::unwrap_used)]

mod support;

use gonio_light::fresnel::{Medium, critical_angle_rad};
use gonio_light::light::smoothstep_or_step;
use gonio_light::{Attenuation, DVec3, Light, LightKind, vector};
use support::{Sequence, assert_close, direction};

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

/// Rounding of a few f64 operations on unit vectors.
const ROUNDING: f64 = 1e-14;

#[test]
fn reflection_of_45_degrees_is_45_degrees_on_the_other_side() {
    let l = DVec3::new(1.0, 1.0, 0.0).normalize();
    let r = vector::reflection(DVec3::Y, l);
    assert!(r.distance(DVec3::new(-1.0, 1.0, 0.0).normalize()) < ROUNDING);
}

#[test]
fn reflection_keeps_length_angle_and_plane_and_undoes_itself() {
    let mut sequence = Sequence::new(1);
    for _ in 0..1000 {
        let (n, l) = (sequence.direction(), sequence.direction());
        let r = vector::reflection(n, l);
        assert_close(r.length(), 1.0, ROUNDING);
        assert_close(n.dot(r), n.dot(l), ROUNDING);
        assert_close(n.cross(l).dot(r), 0.0, ROUNDING);
        assert!(vector::reflection(n, r).distance(l) < 1e-13);
    }
}

#[test]
fn half_vector_halves_the_angle() {
    let h = vector::half_vector(direction(0.8, 0.0), direction(0.2, 0.0), DVec3::Z);
    assert!(h.distance(direction(0.5, 0.0)) < ROUNDING);
}

#[test]
fn half_vector_of_opposite_vectors_is_the_normal() {
    assert_eq!(vector::half_vector(DVec3::X, DVec3::NEG_X, DVec3::Z), DVec3::Z);
}

#[test]
fn refraction_obeys_snells_law() {
    // 1e-6 is the tolerance; f64 does far better away from the critical angle.
    for eta in [1.0 / 1.33, 1.0 / 1.52, 1.0 / 2.42, 1.0, 1.33, 1.52, 2.42] {
        for step in 0..=90 {
            let theta: f64 = f64::from(step).to_radians();
            let sin_t = eta * theta.sin();
            let l = direction(theta, 0.7);
            match vector::refraction(DVec3::Z, l, eta) {
                Some(t) => {
                    assert_close(t.length(), 1.0, 1e-6);
                    assert!(t.z <= 0.0, "T points into the other medium");
                    assert_close(t.cross(DVec3::Z).length(), sin_t, 1e-6);
                    assert_close(l.cross(DVec3::Z).dot(t), 0.0, 1e-6);
                    assert!(t.dot(DVec3::new(l.x, l.y, 0.0)) <= 1e-12, "T goes on to the other side");
                }
                None => assert!(sin_t > 1.0 - 1e-12, "eta {eta}, {step} degrees: reflection is not total"),
            }
            if sin_t > 1.0 + 1e-12 {
                assert_eq!(vector::refraction(DVec3::Z, l, eta), None, "eta {eta}, {step} degrees");
            }
        }
    }
}

#[test]
fn equal_media_do_not_bend_light() {
    let l = direction(0.9, 2.0);
    assert!(vector::refraction(DVec3::Z, l, 1.0).unwrap().distance(-l) < ROUNDING);
}

#[test]
fn total_reflection_starts_at_the_critical_angle() {
    for medium in [Medium::Water, Medium::Ice, Medium::Glass, Medium::Diamond] {
        let n = medium.refraction_index();
        let critical = (1.0 / n).asin();
        assert_close(critical_angle_rad(n).unwrap(), critical, ROUNDING);
        assert!(vector::refraction(DVec3::Z, direction(critical - 1e-6, 0.0), n).is_some(), "{medium}");
        assert!(vector::refraction(DVec3::Z, direction(critical + 1e-6, 0.0), n).is_none(), "{medium}");
    }
    assert_eq!(critical_angle_rad(1.0 / 1.5), None);
}

#[test]
fn unit_vectors_of_extreme_lengths() {
    for scale in [1e-11, 1e-3, 1.0, 1e155, 1e300] {
        let u = vector::unit(DVec3::new(3.0, 0.0, 4.0) * scale).unwrap();
        assert!(u.distance(DVec3::new(0.6, 0.0, 0.8)) < ROUNDING, "{scale}");
        assert_close(vector::safe_length(DVec3::new(3.0, 0.0, 4.0) * scale) / scale, 5.0, ROUNDING);
    }
    for none in [DVec3::ZERO, DVec3::X * 0.99e-12, DVec3::X * 1e-200, DVec3::NAN, DVec3::X * f64::INFINITY] {
        assert_eq!(vector::unit(none), None, "{none}");
    }
    assert!(vector::unit(DVec3::X * 1.01e-12).is_some());
}

#[test]
fn tangent_frames_are_orthonormal_and_right_handed() {
    let mut sequence = Sequence::new(2);
    for _ in 0..1000 {
        let n = sequence.direction();
        for tangent in [sequence.direction() * 3.0, n, DVec3::ZERO] {
            let (t, b) = vector::tangent_frame(n, tangent);
            for (a, c, dot) in [(t, t, 1.0), (b, b, 1.0), (t, b, 0.0), (t, n, 0.0), (b, n, 0.0)] {
                assert_close(a.dot(c), dot, 1e-9);
            }
            assert_close(t.cross(b).dot(n), 1.0, 1e-9);
        }
    }
    assert_eq!(vector::tangent_frame(DVec3::Z, DVec3::new(2.0, 0.0, 5.0)).0, DVec3::X);
    let (t, _) = vector::tangent_frame(DVec3::NEG_Z, DVec3::ZERO);
    assert!(t.is_finite());
}
