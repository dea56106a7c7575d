//! The light equation: analytic scenes, conventions, switches, and inputs that no scene should have.

mod support;
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::quantity::Geometry;
use gonio_light::{
    Attenuation, Convention, DVec3, Equation, Light, LightKind, Quantity, ShadingPoint, Specular, Surface, TermSwitches,
};
use std::f64::consts::PI;
use support::{Sequence, assert_close, direction, surface, upright};

fn point_light(position: DVec3, color: DVec3, attenuation: Attenuation) -> Light {
    Light { kind: LightKind::Point { position }, color, attenuation }
}

fn sun(towards: DVec3) -> Light {
    Light { kind: LightKind::Directional { direction: -towards }, color: DVec3::ONE, attenuation: Attenuation::NONE }
}

#[test]
fn a_unit_sphere_under_one_light_is_albedo_times_cosine() {
    let equation = Equation { specular: Specular::None, ..Equation::default() };
    let surface = Surface { diffuse: DVec3::new(0.8, 0.4, 0.2), ..surface(32.0) };
    for theta in [0.0f64, 0.3, 1.0, 1.5, 2.0, 3.1] {
        let n = direction(theta, 0.4);
        let point = ShadingPoint::new(n, n, n, DVec3::new(0.0, 0.0, 5.0));
        let radiance = equation.radiance(&point, &surface, &[sun(DVec3::Z)]);
        assert!(radiance.distance(surface.diffuse * theta.cos().max(0.0)) < 1e-14, "{theta}: {radiance}");
    }
}

#[test]
fn inverse_square_law_through_the_whole_equation() {
    let equation = Equation { convention: Convention::Physical, specular: Specular::None, ..Equation::default() };
    let point = upright(DVec3::Z);
    for d in [1.0, 2.0, 5.0] {
        let light = point_light(DVec3::Z * d, DVec3::splat(10.0), Attenuation::INVERSE_SQUARE);
        let radiance = equation.radiance(&point, &surface(32.0), &[light]);
        assert_close(radiance.x, 0.5 / PI * 10.0 / (d * d), 1e-14);
    }
}

#[test]
fn a_light_in_the_middle_of_a_unit_sphere() {
    // Intensity pi W/sr, albedo 0.5: radiance 0.5 everywhere.
    let equation = Equation { convention: Convention::Physical, specular: Specular::None, ..Equation::default() };
    let light = point_light(DVec3::ZERO, DVec3::splat(PI), Attenuation::INVERSE_SQUARE);
    let mut sequence = Sequence::new(6);
    for _ in 0..100 {
        let position = sequence.direction();
        let point = ShadingPoint::new(position, -position, -position, DVec3::ZERO);
        assert_close(equation.radiance(&point, &surface(32.0), &[light]).y, 0.5, 1e-13);
    }
}

#[test]
fn the_physical_convention_is_the_labs_over_pi() {
    let (point, lights) = (upright(direction(0.4, 1.0)), [sun(direction(0.7, 2.0))]);
    let terms = |convention| Equation { convention, ..Equation::default() }.evaluate(&point, &surface(8.0), &lights);
    let (lab, physical) = (terms(Convention::Lab), terms(Convention::Physical));
    assert_close(lab.diffuse.x / physical.diffuse.x, PI, 1e-14);
    assert_eq!(lab.specular, physical.specular);
    assert_eq!((lab.lights[0].diff, physical.lights[0].diff), (1.0, 1.0 / PI));
}

#[test]
fn specular_terms_at_known_angles() {
    // View along the normal, light at 60 degrees: R.V = 1/2, N.H = cos 30.
    let (point, lights) = (upright(DVec3::Z), [sun(direction(PI / 3.0, 0.0))]);
    let spec = |specular, cosine_weighted| {
        let equation = Equation { specular, cosine_weighted, ..Equation::default() };
        equation.evaluate(&point, &surface(4.0), &lights).lights[0].spec
    };
    assert_eq!(spec(Specular::None, false), 0.0);
    assert_close(spec(Specular::Phong, false), 1.0 / 16.0, 1e-14);
    assert_close(spec(Specular::BlinnPhong, false), 9.0 / 16.0, 1e-14);
    assert_close(spec(Specular::Phong, true), 1.0 / 32.0, 1e-14);
    assert_close(spec(Specular::BlinnPhong, true), 9.0 / 32.0, 1e-14);
}

#[test]
fn gating_cuts_the_highlight_behind_the_horizon_only() {
    let point = upright(direction(1.4, 0.0));
    for (theta, behind) in [(1.4, false), (1.7, true)] {
        let lights = [sun(direction(theta, PI))];
        for specular in [Specular::Phong, Specular::BlinnPhong] {
            let spec = |gated| {
                let equation = Equation { specular, gated, ..Equation::default() };
                equation.evaluate(&point, &surface(2.0), &lights).lights[0].spec
            };
            assert!(spec(false) > 0.3, "{specular}");
            assert_eq!(spec(true), if behind { 0.0 } else { spec(false) }, "{specular}");
        }
    }
}

#[test]
fn every_switch_removes_its_term_and_nothing_else() {
    let spot = LightKind::Spot { position: DVec3::Z * 2.0, axis: -direction(0.2, 0.0), inner_rad: 0.1, outer_rad: 0.4 };
    let lights = [
        Light { kind: LightKind::Ambient, color: DVec3::splat(0.1), attenuation: Attenuation::NONE },
        Light { kind: spot, color: DVec3::ONE, attenuation: Attenuation::INVERSE_SQUARE },
    ];
    let surface = Surface { emitted: DVec3::splat(0.05), ..surface(8.0) };
    let point = upright(direction(0.3, 0.0));
    let with = |terms| Equation { terms, ..Equation::default() }.evaluate(&point, &surface, &lights);
    let all = TermSwitches::default();
    let full = with(all);
    assert!(full.lights[0].spot > 0.0 && full.lights[0].spot < 1.0);
    assert_eq!(full.lights[0].attenuation, 0.25);
    for part in [full.ambient, full.emitted, full.diffuse, full.specular] {
        assert!(part.min_element() > 0.0);
    }

    let off = with(TermSwitches { ambient: false, ..all });
    assert_eq!(
        (off.ambient, off.emitted, off.diffuse, off.specular),
        (DVec3::ZERO, full.emitted, full.diffuse, full.specular)
    );
    let off = with(TermSwitches { emitted: false, ..all });
    assert_eq!(
        (off.ambient, off.emitted, off.diffuse, off.specular),
        (full.ambient, DVec3::ZERO, full.diffuse, full.specular)
    );
    let off = with(TermSwitches { diffuse: false, ..all });
    assert_eq!(
        (off.ambient, off.emitted, off.diffuse, off.specular),
        (full.ambient, full.emitted, DVec3::ZERO, full.specular)
    );
    let off = with(TermSwitches { specular: false, ..all });
    assert_eq!(
        (off.ambient, off.emitted, off.diffuse, off.specular),
        (full.ambient, full.emitted, full.diffuse, DVec3::ZERO)
    );
    let off = with(TermSwitches { attenuation: false, ..all });
    assert_close(off.diffuse.x, full.diffuse.x * 4.0, 1e-14);
    let off = with(TermSwitches { spot: false, ..all });
    assert_close(off.diffuse.x * full.lights[0].spot, full.diffuse.x, 1e-14);
}

#[test]
fn a_brdf_replaces_ambient_convention_and_specular() {
    let ambient = Light { kind: LightKind::Ambient, color: DVec3::ONE, attenuation: Attenuation::NONE };
    let l = direction(0.6, 1.0);
    let (point, surface) = (upright(direction(0.5, 4.0)), surface(16.0));
    for kind in BrdfKind::ALL.iter().copied() {
        let settings = BrdfSettings { normalised: true, ..BrdfSettings::new(kind) };
        for convention in [Convention::Lab, Convention::Physical] {
            let equation = Equation { brdf: Some(settings), convention, ..Equation::default() };
            let radiance = equation.radiance(&point, &surface, &[ambient, sun(l)]);
            let expected = settings.evaluate(&point, &surface, l) * l.z;
            assert!(radiance.distance(expected) < 1e-14, "{kind}: {radiance} and {expected}");
        }
    }
}

#[test]
fn the_sum_is_the_sum_of_its_named_parts() {
    let mut sequence = Sequence::new(7);
    let geometry = Geometry::default();
    for _ in 0..200 {
        let lights: Vec<Light> = (0..4).map(|_| any_light(&mut sequence, 3.0)).collect();
        let surface = Surface { emitted: DVec3::splat(0.05), ..surface(sequence.within(1.0, 50.0)) };
        let n = sequence.direction();
        let point = ShadingPoint::new(DVec3::ZERO, n, n, sequence.direction() * 4.0);
        let equation = any_equation(&mut sequence);
        let terms = equation.evaluate(&point, &surface, &lights);
        let named = |quantity, light| terms.quantity(quantity, light, &geometry);

        let parts = [Quantity::Ambient, Quantity::Emitted, Quantity::Diffuse, Quantity::Specular];
        let sum: DVec3 = parts.iter().map(|&q| named(q, None)).sum();
        let scale = sum.max_element().max(1.0);
        assert!(sum.distance(named(Quantity::Total, None)) <= 1e-13 * scale);
        assert!(sum.distance(equation.radiance(&point, &surface, &lights)) <= 1e-13 * scale);
        for quantity in [Quantity::Diffuse, Quantity::Specular] {
            let by_light: DVec3 = (0..lights.len()).map(|i| named(quantity, Some(i))).sum();
            assert!(by_light.distance(named(quantity, None)) <= 1e-13 * scale);
        }
    }
}

#[test]
fn degenerate_normals_fall_back_to_the_geometric_one_and_then_to_the_view() {
    let eye = DVec3::new(0.0, 0.0, 3.0);
    let normal_of = |normal, geometric| ShadingPoint::new(DVec3::ZERO, normal, geometric, eye).normal;
    assert_eq!(normal_of(DVec3::X * 5.0, DVec3::Y), DVec3::X);
    assert_eq!(normal_of(DVec3::X * 1e-13, DVec3::Y * 2.0), DVec3::Y);
    assert_eq!(normal_of(DVec3::NAN, DVec3::Y), DVec3::Y);
    assert_eq!(normal_of(DVec3::ZERO, DVec3::ZERO), DVec3::Z);
    let at_the_eye = ShadingPoint::new(eye, DVec3::ZERO, DVec3::ZERO, eye);
    assert_close(at_the_eye.normal.length(), 1.0, 1e-14);
    assert_close(at_the_eye.tangent.dot(at_the_eye.normal), 0.0, 1e-14);
}

/// A number from the ends of `f64`'s range, or an ordinary one.
fn extreme(sequence: &mut Sequence) -> f64 {
    let ordinary = sequence.within(-2.0, 2.0);
    let extremes = [0.0, -0.0, 1e-320, 1e-12, -1e-12, 1e12, 1e160, -1e160, 1e300, f64::MAX, f64::MIN, 1.0, -1.0];
    if sequence.unit() < 0.5 { ordinary } else { sequence.pick(&extremes) }
}

fn extreme_vector(sequence: &mut Sequence) -> DVec3 {
    DVec3::new(extreme(sequence), extreme(sequence), extreme(sequence))
}

fn any_light(sequence: &mut Sequence, distance: f64) -> Light {
    let position = sequence.direction() * distance;
    let kind = sequence.pick(&[
        LightKind::Ambient,
        LightKind::Directional { direction: position / distance },
        LightKind::Point { position },
        LightKind::Spot { position, axis: -position / distance, inner_rad: 0.1, outer_rad: 0.5 },
    ]);
    Light { kind, color: DVec3::splat(sequence.unit()), attenuation: Attenuation::INVERSE_SQUARE }
}

fn any_equation(sequence: &mut Sequence) -> Equation {
    let mut brdfs = vec![None; 3];
    for kind in BrdfKind::ALL.iter().copied() {
        brdfs.push(Some(BrdfSettings { normalised: sequence.unit() < 0.5, ..BrdfSettings::new(kind) }));
    }
    Equation {
        convention: sequence.pick(Convention::ALL),
        specular: sequence.pick(Specular::ALL),
        brdf: sequence.pick(&brdfs),
        gated: sequence.unit() < 0.5,
        cosine_weighted: sequence.unit() < 0.5,
        terms: TermSwitches::default(),
    }
}

#[test]
fn every_finite_input_gives_finite_terms_that_are_not_negative() {
    let mut sequence = Sequence::new(8);
    for round in 0..100_000 {
        let s = &mut sequence;
        let kind = match round % 4 {
            0 => LightKind::Ambient,
            1 => LightKind::Directional { direction: extreme_vector(s) },
            2 => LightKind::Point { position: extreme_vector(s) },
            _ => LightKind::Spot {
                position: extreme_vector(s),
                axis: extreme_vector(s),
                inner_rad: extreme(s),
                outer_rad: extreme(s),
            },
        };
        let attenuation = Attenuation { constant: extreme(s), linear: extreme(s), quadratic: extreme(s) };
        let light = Light { kind, color: extreme_vector(s), attenuation };
        let surface = Surface {
            ambient: extreme_vector(s),
            diffuse: extreme_vector(s),
            specular: extreme_vector(s),
            emitted: extreme_vector(s),
            shininess: extreme(s),
            refraction_index: extreme(s),
        };
        let point = ShadingPoint::new(extreme_vector(s), extreme_vector(s), extreme_vector(s), extreme_vector(s));
        let mut equation = any_equation(s);
        if let Some(brdf) = &mut equation.brdf {
            brdf.lafortune = extreme_vector(s);
        }
        let terms = equation.evaluate(&point, &surface, &[light]);
        let through_sums = equation.radiance(&point, &surface, &[light]);
        for &quantity in Quantity::ALL {
            let value = terms.quantity(quantity, None, &Geometry::default());
            assert!(value.is_finite(), "round {round}: {quantity} is {value}\n{terms:?}");
        }
        for value in [terms.ambient, terms.emitted, terms.diffuse, terms.specular, terms.total, through_sums] {
            assert!(value.is_finite() && value.min_element() >= 0.0, "round {round}: {value}\n{terms:?}");
        }
        for t in &terms.lights {
            let factors = [t.attenuation, t.spot, t.diff, t.spec];
            assert!(factors.iter().all(|x| x.is_finite() && *x >= 0.0), "round {round}: {t:?}");
            assert!(t.l.is_finite() && t.r.is_finite() && t.h.is_finite() && t.cos_theta.is_finite());
            for light in [t.incident, t.diffuse_light, t.specular_light, t.diffuse, t.specular] {
                assert!(light.is_finite() && light.min_element() >= 0.0, "round {round}: {t:?}");
            }
        }
    }
}
