//! Mirrors and glass: optics.glsl against gonio-light's optics.rs; and environment_light.glsl.

use super::twins::{Case, Numbers, cases, compare, texel, vec};
use crate::glsl::fresnel_number;
use glam::DVec3;
use gonio_environment::harmonics::irradiance;
use gonio_environment::prefilter::dominant_direction;
use gonio_light::optics::{Fresnel, Optics, Sight, boundary, reflectance};
use gonio_light::roughness::roughness_of_shininess;

/// Away from the critical angle by so much of the radicand: there the square root's slope has no bound.
const CLEAR_OF_CRITICAL: f64 = 2e-3;

fn index(r: &mut Numbers, cos: f64) -> f32 {
    let index = 0.4 + 2.1 * r.unit();
    let near = |eta: f64| (1.0 - eta * eta * (1.0 - cos * cos)).abs() < CLEAR_OF_CRITICAL;
    if near(index.into()) || near(1.0 / f64::from(index)) || cos.abs() < 1e-3 { 1.0 } else { index }
}

#[test]
fn reflectances() {
    for kind in Fresnel::ALL.iter().copied() {
        let body = format!(
            "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {{ return vec4(reflectance({}, a.x, a.y), 0.0, 0.0, 0.0); }}",
            fresnel_number(kind)
        );
        let some = cases(|r| {
            let cos = r.unit();
            [[cos, index(r, cos.into()), 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]
        });
        compare(&format!("reflectance {kind}"), &body, &some, 2e-5, |c| {
            [reflectance(kind, c[0][0].into(), c[0][1].into()), 0.0, 0.0, 0.0]
        });
    }
}

/// N, V, and the index: from outside and from inside.
fn boundaries() -> Vec<Case> {
    cases(|r| {
        let (n, v) = (r.direction(), r.direction());
        [texel(n, 0.0), texel(v, 0.0), [index(r, n.dot(v)), 0.0, 0.0, 0.0], [0.0; 4]]
    })
}

#[test]
fn boundaries_of_media() {
    for kind in Fresnel::ALL.iter().copied() {
        let call = format!("Boundary at = boundary(a.xyz, b.xyz, c.x, {});", fresnel_number(kind));
        let body = |result: &str| format!("vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {{ {call} return {result}; }}");
        let at = |c: &Case| boundary(vec(c[0]), vec(c[1]), c[2][0].into(), kind);
        compare("boundary, R and F", &body("vec4(at.reflected, at.reflectance)"), &boundaries(), 2e-5, |c| {
            let b = at(c);
            [b.reflected.x, b.reflected.y, b.reflected.z, b.reflectance]
        });
        let result = "vec4(at.transmitted, at.transmits ? 1.0 : 0.0)";
        compare("boundary, T", &body(result), &boundaries(), 3e-5, |c| match at(c).transmitted {
            Some(t) => [t.x, t.y, t.z, 1.0],
            None => [0.0; 4],
        });
    }
    // Both happen often enough to count.
    let total = boundaries()
        .into_iter()
        .filter(|c| boundary(vec(c[0]), vec(c[1]), c[2][0].into(), Fresnel::None).transmitted.is_none());
    assert!((400..3600).contains(&total.count()));
}

#[test]
fn compositions() {
    for kind in Fresnel::ALL.iter().copied() {
        let body = format!(
            "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {{ Sight seen;\nseen.reflection = vec3(0.0); seen.reflected = b.xyz;\n\
             seen.transmitted = c.xyz; seen.fresnel = d.xyz;\n\
             return vec4(compose(a.xyz, seen, {number}, a.w, b.w), mirror_share({number}, a.w, d.y)); }}",
            number = fresnel_number(kind)
        );
        let some = cases(|r| {
            let mut four = |scale: f32| [scale * r.unit(), scale * r.unit(), scale * r.unit(), r.unit()];
            [four(3.0), four(50.0), four(50.0), four(1.0)]
        });
        compare(&format!("compose {kind}"), &body, &some, 2e-6, |c| {
            let (reflectivity, transmission) = (c[0][3].into(), c[1][3].into());
            let optics = Optics { reflectivity, transmission, fresnel: kind, ..Optics::default() };
            let seen =
                Sight { reflection: DVec3::ZERO, reflected: vec(c[1]), transmitted: vec(c[2]), fresnel: vec(c[3]) };
            let all = optics.compose(vec(c[0]), &seen);
            [all.x, all.y, all.z, optics.mirror_share(seen.fresnel.y)]
        });
    }
}

#[test]
fn light_from_everywhere() {
    let polynomial: [DVec3; 9] = std::array::from_fn(|i| {
        let i = i as f64;
        DVec3::new(2.0 - 0.3 * i, 1.5 - 0.1 * i * i, (0.7 * i).cos())
    });
    let constants: Vec<String> =
        polynomial.iter().map(|c| format!("vec3({:?}, {:?}, {:?})", c.x as f32, c.y as f32, c.z as f32)).collect();
    let body = format!(
        "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {{ vec3 p[9] = vec3[9]({});\n\
         return vec4(irradiance(p, a.xyz), roughness_of_shininess(b.x)); }}",
        constants.join(", ")
    );
    let some = cases(|r| [texel(r.direction(), 0.0), [r.scale(0.01, 1e4), 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4]]);
    // The constants are rounded to f32, sums of nine of them are up to 10.
    compare("irradiance, roughness_of_shininess", &body, &some, 5e-6, |c| {
        let light = irradiance(&polynomial, vec(c[0]));
        [light.x, light.y, light.z, roughness_of_shininess(c[1][0].into())]
    });
}

#[test]
fn middles_of_lobes() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(dominant_direction(a.xyz, b.xyz, b.w), 0.0); }";
    let some = cases(|r| [texel(r.direction(), 0.0), texel(r.direction(), r.unit()), [0.0; 4], [0.0; 4]]);
    // A mirrored direction is a difference of numbers up to 2.
    compare("dominant_direction", body, &some, 1e-6, |c| {
        let middle = dominant_direction(vec(c[0]), vec(c[1]), c[1][3].into());
        [middle.x, middle.y, middle.z, 0.0]
    });
}
