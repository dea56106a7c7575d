//! Reflection, half vector, refraction, frames: against what they are by definition.
#![allow(clippy::unwrap_used)]

mod support;
use gonio_light::fresnel::{Medium, critical_angle_rad};
use gonio_light::{DVec3, vector};
use support::{Sequence, assert_close, direction};

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
