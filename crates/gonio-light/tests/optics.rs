//! Reflection, refraction and Fresnel factors: the vectors, and what a surface shows of its surroundings.

#![allow(clippy::unwrap_used)]

mod support;

use gonio_light::optics::{
    self, Body, Fresnel, MOST_MEETINGS, Medium, Meeting, Optics, Surfaces, boundary, critical_angle_rad, dielectric,
    f0_from_index, reflectance, schlick,
};
use gonio_light::{DVec3, ShadingPoint, vector};
use support::{Sequence, assert_close, direction};

/// A view at `angle` from the normal +Y, in the plane z = 0, from the side of -X.
fn view_at(angle: f64) -> DVec3 {
    DVec3::new(-angle.sin(), angle.cos(), 0.0)
}

#[test]
fn angles_are_those_of_snell() {
    for index in [1.0, 1.309, 1.33, 1.52, 2.42] {
        for degrees in [0.0, 1.0, 20.0, 45.0, 70.0, 89.0_f64] {
            let angle = degrees.to_radians();
            let into = boundary(DVec3::Y, view_at(angle), index, Fresnel::None).transmitted;
            let into = into.unwrap_or(DVec3::ZERO);
            // n1 sin = n2 sin; in the plane of view and normal, going on to the other side.
            assert!((into.x - angle.sin() / index).abs() < 1e-6, "{index} {degrees}: {into}");
            assert!(into.y < 0.0 && into.z == 0.0 && (into.length() - 1.0).abs() < 1e-12);
            // Out again it is the same way back.
            let out = boundary(DVec3::Y, into, index, Fresnel::None).transmitted.unwrap_or(DVec3::ZERO);
            assert!(out.abs_diff_eq(view_at(angle), 1e-6), "{index} {degrees}: {out}");
        }
    }
}

#[test]
fn reflection_is_total_from_the_critical_angle_on() {
    for index in [1.309, 1.33, 1.52, 2.42_f64] {
        let critical = (1.0 / index).asin();
        for kind in [Fresnel::None, Fresnel::Exact, Fresnel::Schlick] {
            let at = |angle: f64| boundary(DVec3::Y, -view_at(angle), index, kind);
            // From inside: the view is below the surface.
            let (before, after) = (at(critical - 1e-6), at(critical + 1e-6));
            assert!(before.transmitted.is_some() && before.reflectance < 1.0, "{index} {kind}");
            assert!(after.transmitted.is_none() && after.reflectance == 1.0, "{index} {kind}");
            assert!(after.reflected.y < 0.0, "a reflected ray stays inside");
        }
    }
}

#[test]
fn fresnel_factors_begin_and_end_where_they_must() {
    for (cos, eta) in [(1.0, 1.0 / 1.5), (1.0, 1.5)] {
        for kind in [Fresnel::Exact, Fresnel::Schlick] {
            assert!((reflectance(kind, cos, eta) - 0.04).abs() < 1e-12, "{kind} {eta}");
        }
        assert_eq!(reflectance(Fresnel::None, cos, eta), 0.0);
    }
    for kind in [Fresnel::Exact, Fresnel::Schlick] {
        assert!((reflectance(kind, 0.0, 1.0 / 1.5) - 1.0).abs() < 1e-12, "{kind} at grazing");
        // From inside it grows to 1 at the critical angle, not at 90 degrees.
        let critical = (1.0_f64 / 1.5).asin();
        assert!(reflectance(kind, (critical - 1e-9).cos(), 1.5) > 0.99, "{kind} at the critical angle");
    }
}

fn point(angle: f64) -> ShadingPoint {
    ShadingPoint { position: DVec3::ZERO, normal: DVec3::Y, view: view_at(angle), tangent: DVec3::X }
}

#[test]
fn in_an_even_environment_nothing_is_gained_or_lost() {
    let even = |_: DVec3| DVec3::new(0.25, 0.5, 1.0);
    for fresnel in [Fresnel::None, Fresnel::Exact, Fresnel::Schlick] {
        for (surfaces, dispersion) in [(Surfaces::One, 0.0), (Surfaces::One, 0.05), (Surfaces::Two, 0.05)] {
            let optics = Optics { transmission: 1.0, fresnel, surfaces, dispersion, ..Optics::default() };
            for angle in [0.0, 0.5, 1.2, 1.5] {
                let sphere = Ball { centre: DVec3::new(0.0, -1.0, 0.0), radius: 1.0 };
                let seen = optics::sight(&point(angle), 1.52, &optics, &even, Some(&sphere));
                let all = optics.compose(DVec3::splat(7.0), &seen);
                // What a ray that no longer counts would have carried is lost.
                assert!(all.abs_diff_eq(even(DVec3::Y), 1.1e-3), "{fresnel} {surfaces} {angle}: {all}");
            }
        }
    }
}

#[test]
fn shares_are_those_of_the_definition() {
    let environment = |d: DVec3| if d.y > 0.0 { DVec3::X } else { DVec3::Y };
    let lit = DVec3::Z;
    let shown = |optics: Optics| {
        let seen = optics::sight(&point(0.0), 1.5, &optics, &environment, None);
        optics.compose(lit, &seen)
    };
    let near =
        |got: DVec3, expected: [f64; 3]| assert!(got.abs_diff_eq(expected.into(), 1e-12), "{got} not {expected:?}");
    near(shown(Optics::default()), [0.0, 0.0, 1.0]);
    near(shown(Optics { reflectivity: 0.3, ..Optics::default() }), [0.3, 0.0, 0.7]);
    near(shown(Optics { reflectivity: 0.5, fresnel: Fresnel::Exact, ..Optics::default() }), [0.02, 0.0, 0.98]);
    near(shown(Optics { transmission: 1.0, ..Optics::default() }), [0.0, 1.0, 0.0]);
    let tint = DVec3::new(1.0, 0.5, 1.0);
    near(shown(Optics { transmission: 1.0, fresnel: Fresnel::Schlick, tint, ..Optics::default() }), [0.04, 0.48, 0.0]);
    near(shown(Optics { transmission: 0.5, reflectivity: 0.2, ..Optics::default() }), [0.1, 0.5, 0.4]);
}

/// A ball, known on paper.
struct Ball {
    centre: DVec3,
    radius: f64,
}

impl Body for Ball {
    fn next_meeting(&self, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let from = origin - self.centre;
        let b = from.dot(direction);
        let distance = -b + (b * b - from.length_squared() + self.radius * self.radius).max(0.0).sqrt();
        let position = origin + distance * direction;
        Some(Meeting { position, normal: (position - self.centre) / self.radius, distance })
    }
}

#[test]
fn a_ball_turns_the_view_by_twice_what_its_surface_does() {
    let ball = Ball { centre: DVec3::new(0.0, -1.0, 0.0), radius: 1.0 };
    let optics = Optics { transmission: 1.0, surfaces: Surfaces::Two, ..Optics::default() };
    for degrees in [0.0, 10.0, 45.0, 80.0_f64] {
        let angle = degrees.to_radians();
        // The environment's radiance is the direction itself.
        let seen = optics::sight(&point(angle), 1.5, &optics, &|d| d, Some(&ball));
        // Both angles inside of a ball are equal, so both refractions turn the ray alike.
        let inside = (angle.sin() / 1.5).asin();
        let turned = -2.0 * (angle - inside);
        let straight = -view_at(angle);
        let expected = DVec3::new(
            straight.x * turned.cos() - straight.y * turned.sin(),
            straight.x * turned.sin() + straight.y * turned.cos(),
            0.0,
        );
        assert!(seen.transmitted.abs_diff_eq(expected, 1e-9), "{degrees}: {} not {expected}", seen.transmitted);
    }
    // Absorbed along the diameter: exp(-2 ln 2) = 1/4.
    let absorbing = Optics { absorption: DVec3::splat(std::f64::consts::LN_2), ..optics };
    let seen = optics::sight(&point(0.0), 1.5, &absorbing, &|_| DVec3::ONE, Some(&ball));
    assert!(seen.transmitted.abs_diff_eq(DVec3::splat(0.25), 1e-12), "{}", seen.transmitted);
}

/// Reflects for ever: every meeting is grazing.
struct Endless;

impl Body for Endless {
    fn next_meeting(&self, origin: DVec3, direction: DVec3) -> Option<Meeting> {
        let normal = (DVec3::new(-direction.z, 3.0, direction.x)).normalize();
        let sideways = normal - direction * normal.dot(direction);
        let normal = (sideways.normalize() + 0.01 * direction).normalize();
        Some(Meeting { position: origin + direction, normal, distance: 1.0 })
    }
}

#[test]
fn endless_reflection_ends() {
    let optics = Optics { transmission: 1.0, surfaces: Surfaces::Two, absorption: DVec3::ONE, ..Optics::default() };
    let seen = optics::sight(&point(0.3), 1.5, &optics, &|_| DVec3::ONE, Some(&Endless));
    let expected = (-(MOST_MEETINGS as f64)).exp();
    assert!(seen.transmitted.abs_diff_eq(DVec3::splat(expected), 1e-12), "{} not {expected}", seen.transmitted);
}

#[test]
fn normal_incidence_is_the_f0_formula() {
    for n in [1.309, 1.33, 1.52, 2.42] {
        let paper = ((n - 1.0) / (n + 1.0_f64)).powi(2);
        assert_close(dielectric(1.0, 1.0 / n), paper, 1e-14);
        assert_close(dielectric(1.0, n), paper, 1e-14);
        assert_close(f0_from_index(n), paper, 1e-14);
        assert_close(f0_from_index(1.0 / n), paper, 1e-14);
        assert_eq!(schlick(1.0, paper), paper);
    }
    // Glass in air: 0.52^2 / 2.52^2.
    assert_close(dielectric(1.0, 1.0 / 1.52), 0.042_580, 1e-6);
}

#[test]
fn at_brewsters_angle_only_one_polarisation_is_reflected() {
    // tan(theta_B) = n; there r_p = 0 and r_s = cos(2 theta_B) for the angle from the normal.
    let n: f64 = 1.5;
    let theta = n.atan();
    assert_close(dielectric(theta.cos(), 1.0 / n), 0.5 * (2.0 * theta).cos().powi(2), 1e-14);
}

#[test]
fn both_sides_of_a_boundary_reflect_the_same() {
    // Stokes: along one and the same path, there and back.
    let n: f64 = 1.52;
    for step in 1..90 {
        let theta_i = f64::from(step).to_radians();
        let theta_t = (theta_i.sin() / n).asin();
        assert_close(dielectric(theta_i.cos(), 1.0 / n), dielectric(theta_t.cos(), n), 1e-12);
    }
}

#[test]
fn reflection_is_total_beyond_the_critical_angle_and_at_grazing() {
    for medium in [Medium::Water, Medium::Ice, Medium::Glass, Medium::Diamond] {
        let n = medium.refraction_index();
        let critical = critical_angle_rad(n).unwrap_or(f64::NAN);
        assert!(dielectric((critical - 1e-3).cos(), n) < 1.0, "{medium}");
        assert_eq!(dielectric((critical + 1e-6).cos(), n), 1.0, "{medium}");
        assert_eq!(dielectric(0.0, 1.0 / n), 1.0, "{medium}");
    }
}

#[test]
fn reflectance_rises_towards_grazing_and_stays_in_range() {
    for eta in [1.0 / 2.42, 1.0 / 1.33] {
        let f0 = f0_from_index(eta);
        let mut last_schlick = f0;
        for step in 0..=1000 {
            let cos = 1.0 - f64::from(step) / 1000.0;
            let (exact, approximate) = (dielectric(cos, eta), schlick(cos, f0));
            assert!((0.0..=1.0).contains(&exact) && (0.0..=1.0).contains(&approximate));
            assert!(approximate >= last_schlick);
            // Schlick's own claim is an error of a few percent; at most 0.08 here, near grazing.
            assert!((exact - approximate).abs() < 0.08, "cos {cos}: {exact} and {approximate}");
            last_schlick = approximate;
        }
        assert_eq!(schlick(0.0, f0), 1.0);
    }
}

#[test]
fn no_boundary_reflects_nothing_and_nonsense_reflects_all() {
    for cos in [0.0, 0.3, 1.0] {
        assert_eq!(dielectric(cos, 1.0), 0.0);
        for eta in [0.0, -1.5, f64::NAN, f64::INFINITY, 1e300] {
            assert_eq!(dielectric(cos, eta), 1.0, "cos {cos}, eta {eta}");
        }
    }
    assert_eq!(dielectric(1.5, 0.5), dielectric(1.0, 0.5));
    assert_eq!(dielectric(-0.5, 0.5), 1.0);
}

#[test]
fn the_labs_table() {
    let table: Vec<(&str, f64)> = Medium::ALL.iter().map(|m| (m.name(), m.refraction_index())).collect();
    assert_eq!(table, [("air", 1.0), ("water", 1.33), ("ice", 1.309), ("glass", 1.52), ("diamond", 2.42)]);
    assert_eq!("Diamond".parse(), Ok(Medium::Diamond));
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
