//! Fresnel: against values known on paper.

mod support;
use gonio_light::fresnel::{Medium, critical_angle_rad, dielectric, f0_from_index, schlick};
use support::assert_close;

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
