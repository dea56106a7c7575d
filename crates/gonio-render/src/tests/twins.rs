//! A GLSL function and its Rust twin have the same name; here both are evaluated for many parameters and compared.
//!
//! Mirrors and glass: optics.glsl against gonio-light's optics.rs; and environment_light.glsl.

use crate::glsl::{fresnel_number, light_functions};
use glam::{DVec3, Vec2};
use gonio_environment::harmonics::irradiance;
use gonio_environment::prefilter::dominant_direction;
use gonio_gl::objects::{DebugGroup, TextureObject, VertexArray};
use gonio_gl::program::Program;
use gonio_gl::target::OutputTarget;
use gonio_gl::{Dialect, Texels};
use gonio_light::brdf::{BrdfKind, BrdfSettings};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap, srgb_decode, srgb_encode};
use gonio_light::function_light::FunctionLobe;
use gonio_light::microfacet::roughness_of_shininess;
use gonio_light::optics::{Fresnel, Optics, Sight, boundary, reflectance};
use gonio_light::{Attenuation, ShadingPoint, Surface, function_light, light, microfacet, optics, vector};

/// Parameters of one call: four texels.
pub(super) type Case = [[f32; 4]; 4];

/// Number of cases for each function.
const CASES: usize = 4096;

/// A generator of the same random numbers on every machine (Steele, Lea, Flood 2014: SplitMix64).
pub(super) struct Numbers(u64);

impl Numbers {
    pub(super) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    pub(super) fn direction(&mut self) -> DVec3 {
        let z = 2.0 * self.unit() - 1.0;
        let phi = std::f32::consts::TAU * self.unit();
        let r = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(f64::from(r * phi.cos()), f64::from(r * phi.sin()), f64::from(z)).normalize()
    }

    /// Between `low` and `high`, evenly in the logarithm.
    pub(super) fn scale(&mut self, low: f32, high: f32) -> f32 {
        low * (high / low).powf(self.unit())
    }
}

pub(super) fn texel(v: DVec3, w: f32) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w]
}

/// The vector as the shader gets it, back in f64.
pub(super) fn vec(texel: [f32; 4]) -> DVec3 {
    DVec3::new(texel[0].into(), texel[1].into(), texel[2].into())
}

/// Runs `vec4 run(vec4 a, vec4 b, vec4 c, vec4 d)` once per case.
fn run_glsl(es: bool, body: &str, cases: &[Case]) -> Vec<[f32; 4]> {
    let context = super::context(es);
    let gl = context.gl();
    let _group = DebugGroup::new(gl, "twins");
    let dialect = if es { Dialect::Es300 } else { Dialect::Core330 };
    let functions = light_functions(dialect);
    let fragment = format!(
        "{functions}\nuniform highp sampler2D cases;\nout vec4 result;\n{body}\nvoid main() {{\n\
         int x = int(gl_FragCoord.x) * 4; int y = int(gl_FragCoord.y);\n\
         result = run(texelFetch(cases, ivec2(x, y), 0), texelFetch(cases, ivec2(x + 1, y), 0),\n\
         texelFetch(cases, ivec2(x + 2, y), 0), texelFetch(cases, ivec2(x + 3, y), 0));\n}}\n"
    );
    let vertex = format!("{}{}", dialect.header(), include_str!("../../shaders/output.vert"));
    let program = Program::new(gl, "twins", &vertex, &fragment, &[]).unwrap_or_else(|error| panic!("{error}"));
    let (width, height) = (64, cases.len() / 64);
    assert_eq!(width * height, cases.len(), "whole rows");
    let texture = TextureObject::bound(gl, "cases").expect("a texture");
    let target = OutputTarget::new(gl, [width as i32, height as i32], true).expect("a float target");
    let array = VertexArray::bound(gl, "none").expect("a vertex array");
    gl.bind_texture(glow::TEXTURE_2D, Some(texture.handle()));
    gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MIN_FILTER, glow::NEAREST as i32);
    gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAG_FILTER, glow::NEAREST as i32);
    gl.tex_image_2d(
        glow::TEXTURE_2D,
        0,
        glow::RGBA32F,
        [4 * width as i32, height as i32],
        Texels::f32(glow::RGBA, bytemuck::cast_slice(cases)),
    );
    target.bind(gl);
    program.bind();
    program.set_i32("cases", 0);
    program.set_vec2("unused", Vec2::ZERO);
    gl.bind_vertex_array(Some(array.handle()));
    gl.draw_arrays(glow::TRIANGLES, 0, 3);
    let values = target.read_f32(gl);
    bytemuck::cast_slice(&values).to_vec()
}

/// Compares GLSL with `rust` in both dialects. `tolerance` is absolute below 1 and relative above.
pub(super) fn compare(name: &str, body: &str, cases: &[Case], tolerance: f64, rust: impl Fn(&Case) -> [f64; 4]) {
    for es in [false, true] {
        let mut worst = (0.0, String::new());
        for (case, got) in cases.iter().zip(run_glsl(es, body, cases)) {
            let want = rust(case);
            for (got, want) in got.into_iter().zip(want) {
                let difference = (f64::from(got) - want).abs() / want.abs().max(1.0);
                if difference.is_nan() || difference > worst.0 {
                    worst = (difference, format!("{case:?}: GLSL {got}, Rust {want}"));
                    assert!(!difference.is_nan(), "{name} (es: {es}) {}", worst.1);
                }
            }
        }
        assert!(worst.0 <= tolerance, "{name} (es: {es}) differs by {}: {}", worst.0, worst.1);
    }
}

pub(super) fn cases(mut make: impl FnMut(&mut Numbers) -> Case) -> Vec<Case> {
    let mut numbers = Numbers(7);
    (0..CASES).map(|_| make(&mut numbers)).collect()
}

/// N, V, L and (shininess, Lafortune's diagonal).
fn directions() -> Vec<Case> {
    cases(|r| {
        let n = r.direction();
        // Mostly above the horizon, where values are not 0.
        let mut above = |n: DVec3| {
            let d = r.direction();
            if d.dot(n) < 0.0 && r.unit() < 0.8 { -d } else { d }
        };
        let (v, l) = (above(n), above(n));
        let shininess = r.scale(1.0, 200.0);
        [texel(n, 0.0), texel(v, 0.0), texel(l, 0.0), [shininess, 0.6 + 0.4 * r.unit(), 0.6 + 0.4 * r.unit(), -1.0]]
    })
}

// Tolerances: f32 has 6e-8; llvmpipe computes pow as exp2(log2 x * y) with about 2e-6 relative error
// times the exponent's share. Each was set at about three times what llvmpipe shows.

#[test]
fn vectors() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(reflection(a.xyz, c.xyz), 0.0); }";
    let point = |v: DVec3| [v.x, v.y, v.z, 0.0];
    compare("reflection", body, &directions(), 1e-6, |c| point(vector::reflection(vec(c[0]), vec(c[2]))));
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(half_vector(c.xyz, b.xyz, a.xyz), 0.0); }";
    // L and V nearly opposite cancel: kept apart here; the exactly opposite case is analytic elsewhere.
    let apart: Vec<Case> = directions()
        .into_iter()
        .map(|mut c| {
            if (vec(c[1]) + vec(c[2])).length() < 0.1 {
                c[2] = c[1];
            }
            c
        })
        .collect();
    compare("half_vector", body, &apart, 2e-6, |c| point(vector::half_vector(vec(c[2]), vec(c[1]), vec(c[0]))));
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(any_orthonormal_vector(a.xyz), 0.0); }";
    compare("any_orthonormal_vector", body, &directions(), 2e-5, |c| point(vector::any_orthonormal_vector(vec(c[0]))));
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(unit_or(a.xyz * d.x, b.xyz), 0.0); }";
    compare("unit_or", body, &directions(), 1e-6, |c| {
        point(vector::unit_or(vec(c[0]) * f64::from(c[3][0]), vec(c[1])))
    });
}

#[test]
fn refraction() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { vec3 t; bool ok = refraction(a.xyz, c.xyz, d.x, t);\n\
                return ok ? vec4(t, 1.0) : vec4(0.0); }";
    let some: Vec<Case> = cases(|r| {
        let (n, l) = (r.direction(), r.direction());
        let l = if l.dot(n) < 0.0 { -l } else { l };
        let eta = 0.4 + 2.1 * r.unit();
        // Rounding decides the sign of the radicand near the critical angle.
        let cos = n.dot(l);
        let near_critical = (1.0 - f64::from(eta * eta) * (1.0 - cos * cos)).abs() < 1e-3;
        [texel(n, 0.0), [0.0; 4], texel(l, 0.0), [if near_critical { 0.5 } else { eta }, 0.0, 0.0, 0.0]]
    });
    compare("refraction", body, &some, 2e-5, |c| match vector::refraction(vec(c[0]), vec(c[2]), c[3][0].into()) {
        Some(t) => [t.x, t.y, t.z, 1.0],
        None => [0.0; 4],
    });
}

#[test]
fn lights() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {\n\
                return vec4(attenuation_at(a.xyz, a.w), smoothstep_or_step(b.x, b.y, b.z), 0.0, 0.0); }";
    let some = cases(|r| {
        let zero_or = |r: &mut Numbers| if r.unit() < 0.3 { 0.0 } else { r.unit() };
        let k = [zero_or(r), zero_or(r), zero_or(r), r.scale(1e-2, 1e2)];
        let (e0, x) = (r.unit(), r.unit());
        let e1 = if r.unit() < 0.1 { e0 } else { e0 + 0.05 + r.unit() };
        [k, [e0, e1, x, 0.0], [0.0; 4], [0.0; 4]]
    });
    compare("attenuation_at, smoothstep_or_step", body, &some, 1e-5, |c| {
        let k = c[0].map(f64::from);
        let attenuation = Attenuation { constant: k[0], linear: k[1], quadratic: k[2] };
        let e = c[1].map(f64::from);
        [attenuation.at(k[3]), light::smoothstep_or_step(e[0], e[1], e[2]), 0.0, 0.0]
    });
}

#[test]
fn exponents_of_roughnesses() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(shininess_of_roughness(a.x), 0.0, 0.0, 0.0); }";
    let some = cases(|r| [[1.2 * r.unit(), 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]);
    // Up to 10,000; a fourth power and a quotient in f32, relative to values above 1.
    compare("shininess_of_roughness", body, &some, 1e-5, |c| {
        [microfacet::shininess_of_roughness(c[0][0].into()), 0.0, 0.0, 0.0]
    });
}

#[test]
fn brdf_lobes() {
    for &kind in BrdfKind::ALL {
        for normalised in [false, true] {
            let body = format!(
                "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {{\n\
                 return vec4({kind}_lobe(a.xyz, b.xyz, c.xyz, any_orthonormal_vector(a.xyz), d.x, d.yzw, {normalised}),\n\
                 0.0, 0.0, 0.0); }}"
            );
            // Lobes end at the horizon, where rounding decides on which side a direction is.
            let clear: Vec<Case> = directions()
                .into_iter()
                .map(|mut c| {
                    for i in [1, 2] {
                        if vec(c[0]).dot(vec(c[i])).abs() < 0.02 {
                            c[i] = c[0];
                        }
                    }
                    c
                })
                .collect();
            compare(&format!("{kind}_lobe, normalised {normalised}"), &body, &clear, 5e-4, |c| {
                let (n, v, l) = (vec(c[0]), vec(c[1]), vec(c[2]));
                let point = ShadingPoint {
                    position: DVec3::ZERO,
                    normal: n,
                    view: v,
                    tangent: vector::any_orthonormal_vector(n),
                };
                let surface = Surface { shininess: c[3][0].into(), ..Surface::default() };
                let lafortune = DVec3::new(c[3][1].into(), c[3][2].into(), c[3][3].into());
                [BrdfSettings { kind, normalised, lafortune }.lobe(&point, &surface, l), 0.0, 0.0, 0.0]
            });
        }
    }
}

#[test]
fn fresnel_terms() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) { return vec4(fresnel_dielectric(a.x, a.y),\n\
                fresnel_schlick(a.x, a.z), fresnel_f0_from_index(a.y), 0.0); }";
    let some = cases(|r| {
        let (cos, eta) = (r.unit(), 0.4 + 2.1 * r.unit());
        let near_critical = (1.0 - eta * eta * (1.0 - cos * cos)).abs() < 1e-2;
        [[cos, if near_critical { 0.5 } else { eta }, r.unit(), 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]
    });
    compare("fresnel", body, &some, 2e-5, |c| {
        let [cos, eta, f0, _] = c[0].map(f64::from);
        [optics::dielectric(cos, eta), optics::schlick(cos, f0), optics::f0_from_index(eta), 0.0]
    });
}

#[test]
fn colours() {
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {\n\
                return vec4(srgb_encode(a.x), srgb_decode(a.x), 0.0, 0.0); }";
    let some = cases(|r| [[r.unit() * 1.2 - 0.1, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4], [0.0; 4]]);
    compare("srgb", body, &some, 2e-5, |c| {
        let x = f64::from(c[0][0]);
        [srgb_encode(x), srgb_decode(x), 0.0, 0.0]
    });
    for &tone_map in ToneMap::ALL {
        let call = if tone_map == ToneMap::None { "c".to_owned() } else { format!("{tone_map}(c)") };
        let body = format!(
            "vec4 run(vec4 a, vec4 b, vec4 c4, vec4 d) {{ vec3 c = exposed(a.xyz, a.w);\n\
             return vec4(srgb_encode({call}), 0.0); }}"
        );
        let some = cases(|r| {
            let mut channel = || r.scale(1e-4, 50.0);
            let c = [channel(), channel(), channel()];
            [[c[0], c[1], c[2], 4.0 * r.unit() - 2.0], [0.0; 4], [0.0; 4], [0.0; 4]]
        });
        compare(&format!("tone map {tone_map}"), &body, &some, 2e-4, |c| {
            let transform = OutputTransform { exposure: c[0][3].into(), tone_map, encoding: ColorEncoding::Srgb };
            let v = transform.encode(vec(c[0]));
            [v.x, v.y, v.z, 0.0]
        });
    }
}

/// The least radicand: near the critical angle the slope of the square root is unbounded.
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

/// The directions of an environment's light on functions, their density, and the level of a lookup.
#[test]
fn directions_for_functions() {
    let cases = cases(|numbers| {
        let leans = if numbers.unit() < 0.5 { 1.0 } else { 0.0 };
        let ax = numbers.scale(0.01, 1.0);
        let ay = if leans > 0.0 { ax } else { numbers.scale(0.01, 1.0) };
        let lobe = [ax, ay, 2.0 * numbers.unit() - 1.0, leans];
        let u = [numbers.unit(), numbers.unit()];
        let view = numbers.direction();
        let light = numbers.direction();
        [lobe, texel(view, u[0]), texel(light.with_z(light.z.abs()), u[1]), [numbers.scale(1e-4, 6.0), 128.0, 0.0, 0.0]]
    });
    let lobe_of = |case: &Case| FunctionLobe {
        alpha: [case[0][0].into(), case[0][1].into()],
        lean: (case[0][3] > 0.5).then_some(case[0][2].into()),
        lobe_count: 1,
        cosine_count: 0,
    };
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {\n\
                vec3 v = raised_view(b.xyz);\n\
                return vec4(lobe_direction(a, v, vec2(b.w, c.w)), lookup_level(d.y, c.xyz, d.x));\n}";
    // Directions near the smallest z of a cap lose digits in f32.
    compare("lobe_direction", body, &cases, 2e-3, |case| {
        let view = function_light::raised_view(vec(case[1]));
        let direction = lobe_of(case).direction(view, [case[1][3].into(), case[2][3].into()]);
        direction.extend(function_light::lookup_level(128.0, vec(case[2]), case[3][0].into())).to_array()
    });
    let body = "vec4 run(vec4 a, vec4 b, vec4 c, vec4 d) {\n\
                return vec4(lobe_density(a, raised_view(b.xyz), c.xyz), cosine_direction(vec2(b.w, c.w)));\n}";
    compare("lobe_density", body, &cases, 2e-3, |case| {
        let density = lobe_of(case).density(function_light::raised_view(vec(case[1])), vec(case[2]));
        let cosine = function_light::cosine_direction([case[1][3].into(), case[2][3].into()]);
        [density, cosine.x, cosine.y, cosine.z]
    });
}
