//! The models: values on paper, their own checks, and their GLSL functions.
#![allow(clippy::unwrap_used)]

use gonio_bsdf::sampling::{SplitMix, direction};
use gonio_bsdf::{Bsdf, DVec3, GlslBrdf, MODELS, ModelSpec, check};
use std::f64::consts::{FRAC_PI_4, PI};

fn build(spec: &str) -> Box<dyn Bsdf> {
    ModelSpec::parse(spec).unwrap().build()
}

/// The value of the first channel for polar angles in radians, both in the plane of incidence on opposite sides.
fn value(spec: &str, theta_i: f64, theta_o: f64) -> f64 {
    build(spec).evaluate(direction(theta_i, 0.0), direction(theta_o, PI)).x
}

#[track_caller]
fn is(found: f64, expected: f64) {
    // Set by this file's author: both sides are f64 arithmetic of a few dozen operations.
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found}, not {expected}");
}

#[test]
fn values_at_the_mirror_direction() {
    let cos = FRAC_PI_4.cos();
    is(value("lambert:a=0.6", 0.3, 1.0), 0.6 / PI);
    is(value("phong:a=0.3,b=0.4,c=20", FRAC_PI_4, FRAC_PI_4), 0.3 / PI + 0.4);
    is(value("phong-normalised:b=0.4,c=20", FRAC_PI_4, FRAC_PI_4), 0.4 * 22.0 / (2.0 * PI));
    is(value("blinn:b=0.4,c=20", FRAC_PI_4, FRAC_PI_4), 0.4);
    is(value("blinn-normalised:b=1,c=2", FRAC_PI_4, FRAC_PI_4), 4.0 * 6.0 / (8.0 * PI * 2.5));
    is(value("lafortune:b=0.4,k=20", FRAC_PI_4, FRAC_PI_4), 0.4);
    is(value("lafortune-2:a=0,b1=0.4,k1=6,b2=0.1,k2=20", FRAC_PI_4, FRAC_PI_4), (0.4 * 8.0 + 0.1 * 22.0) / (2.0 * PI));
    let three = "lafortune-3:a=0.3,b1=0.4,k1=6,b2=0.1,k2=20,b3=0.2,k3=100";
    is(value(three, FRAC_PI_4, FRAC_PI_4), 0.3 / PI + (0.4 * 8.0 + 0.1 * 22.0 + 0.2 * 102.0) / (2.0 * PI));
    is(value("ward:b=0.4,c=0.2", FRAC_PI_4, FRAC_PI_4), 0.4 / (4.0 * PI * 0.04 * cos));
    // |L + V|^2 / (N.(L + V))^4 = 4 cos^2 / (2 cos)^4.
    is(value("ward-normalised:b=0.4,c=0.2", FRAC_PI_4, FRAC_PI_4), 0.4 / (PI * 0.04) / (4.0 * cos * cos));
    is(value("ward-anisotropic:b=0.4,cx=0.1,cy=0.3", FRAC_PI_4, FRAC_PI_4), 0.4 / (4.0 * PI * 0.03 * cos));
    // D = 1 / m^2, G = 1 (2 N.H N.V / V.H = 2), F = 0.5 + 0.5 (1 - cos)^5.
    let fresnel = 0.5 + 0.5 * (1.0 - cos).powi(5);
    is(value("cook-torrance:f0=0.5,m=0.4", FRAC_PI_4, FRAC_PI_4), fresnel / (0.16 * PI * cos * cos));
    is(
        value("cook-torrance:f0=0.5,m=0.4,normalised=on", FRAC_PI_4, FRAC_PI_4),
        fresnel / (0.16 * PI * cos * cos * 4.0),
    );
    // a = 1 / alpha at 45 degrees, 2.5, is beyond 1.6: no shadowing.
    is(value("beckmann:f0=1,alpha=0.4", FRAC_PI_4, FRAC_PI_4), 1.0 / (0.16 * PI * cos * cos * 4.0));
    // Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2.
    let lambda = 0.5 * (1.16_f64.sqrt() - 1.0);
    let correlated = 1.0 / (1.0 + 2.0 * lambda);
    is(value("ggx:f0=1,alpha=0.4", FRAC_PI_4, FRAC_PI_4), correlated / (0.16 * PI * cos * cos * 4.0));
    let separable = (1.0 + lambda).powi(-2);
    is(value("ggx:f0=1,alpha=0.4,correlated=off", FRAC_PI_4, FRAC_PI_4), separable / (0.16 * PI * cos * cos * 4.0));
}

#[test]
fn values_off_the_mirror_direction() {
    // Half vector 15 degrees from the normal.
    let (i, o) = (60_f64.to_radians(), 30_f64.to_radians());
    let quarter = 15_f64.to_radians();
    is(value("phong:b=1,c=3", i, o), 30_f64.to_radians().cos().powi(3));
    is(value("blinn:b=1,c=3", i, o), quarter.cos().powi(3));
    let gauss = (-quarter.tan().powi(2) / 0.04).exp();
    is(value("ward:b=1,c=0.2", i, o), gauss / (4.0 * PI * 0.04 * (i.cos() * o.cos()).sqrt()));
    // The slope lies along the tangent, so only cx counts in the exponent.
    is(value("ward-anisotropic:b=1,cx=0.2,cy=0.5", i, o), gauss / (4.0 * PI * 0.1 * (i.cos() * o.cos()).sqrt()));
    // -wi^T A wo = -(0.5 x_i x_o) + 0.8 z_i z_o.
    let base = 0.5 * i.sin() * o.sin() + 0.8 * i.cos() * o.cos();
    is(value("lafortune:b=1,k=3,ax=0.5,az=-0.8", i, o), base.powi(3));
    is(value("lafortune-normalised:b=1,k=3,ax=0.5,az=-0.8", i, o), (base / 1.0).powi(3) * 5.0 / (2.0 * PI));
    // Opposite azimuths: only A of Oren and Nayar. Equal ones: sin(60) tan(30) = 1/2.
    let s2 = 30_f64.to_radians().powi(2);
    let (a, b) = (1.0 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09));
    is(value("oren-nayar:a=1,sigma=30", i, o), a / PI);
    let same_side = build("oren-nayar:a=1,sigma=30").evaluate(direction(i, 1.0), direction(o, 1.0)).x;
    is(same_side, (a + 0.5 * b) / PI);
    // Both at the normal: D of the exponent, F = rs, V.H max = 1; the diffuse factor (1 - 1/32)^2.
    let lobe = (11.0_f64 * 21.0).sqrt() / (8.0 * PI) * 0.2;
    let diffuse = 28.0 / (23.0 * PI) * 0.3 * 0.8 * (31.0_f64 / 32.0).powi(2);
    is(value("ashikhmin-shirley:rd=0.3,rs=0.2,nu=10,nv=20", 0.0, 0.0), lobe + diffuse);
}

#[test]
fn the_principled_model_is_burleys() {
    // Both at the normal: all Fresnel weights are 0. Diffuse: 1 and 1.25 (1 (1 / 2 - 0.5) + 0.5) by halves.
    let diffuse = 0.7 * 0.6 / PI * (0.5 + 0.5 * 0.625);
    // D = 1 / (pi roughness^4), G = 1 / (1 + 1)^2, F = 0.3 * 0.6 + 0.7 * 0.08 * 0.5.
    let specular = (0.18 + 0.028) / (4.0 * PI * 0.4_f64.powi(4));
    // alpha = 0.1 + 0.3 (0.001 - 0.1), D = (alpha^2 - 1) / (pi alpha^2 ln alpha^2), F = 0.04, G = 1/4.
    let squared = 0.070_3_f64.powi(2);
    let clearcoat = 0.8 * 0.25 * 0.25 * 0.04 * (squared - 1.0) / (PI * squared * squared.ln());
    let all = "baseColor=0.6,metallic=0.3,subsurface=0.5,roughness=0.4,sheen=1,clearcoat=0.8,clearcoatGloss=0.3";
    is(value(&format!("disney:{all}"), 0.0, 0.0), diffuse + specular + clearcoat);
    // Mirror direction at 60 degrees: all weights are 1/32, V.H = 1/2, the retro-reflection is 0.5 + 2 roughness / 4.
    let theta = 60_f64.to_radians();
    let (weight, a2) = (1.0 / 32.0, 0.5_f64.powi(4));
    let diffuse = 0.6 / PI * (1.0 + (0.75 - 1.0) * weight) * (1.0 + (0.75 - 1.0) * weight);
    let sheen = 0.9 * weight;
    // The widths are a / sqrt(0.55) along the tangent and a sqrt(0.55) across; D holds their product.
    let smith = 1.0 / (0.5 + (0.75 * a2 / 0.55 + 0.25).sqrt());
    let specular = (0.04 + 0.96 * weight) / (PI * a2) * smith * smith;
    let found = value("disney:baseColor=0.6,roughness=0.5,anisotropic=0.5,sheen=0.9,sheenTint=0", theta, theta);
    assert!((found - (diffuse + sheen + specular)).abs() < 1e-12, "{found}, not {}", diffuse + sheen + specular);
}

#[test]
fn printed_forms_are_what_the_print_says() {
    let (i, o) = (60_f64.to_radians(), 30_f64.to_radians());
    is(value("phong-printed:b=1,c=3", i, o), 30_f64.to_radians().cos().cos().powi(3));
    // wi and wo are at right angles.
    is(value("blinn-printed:b=1,c=3", i, o), 1.0);
    assert!((value("ward-printed:b=1,c=0.2", i, o) / value("ward:b=1,c=0.2", FRAC_PI_4, FRAC_PI_4) - 1.0).abs() < 0.1);
    // Light and viewer on the same side, far from the mirror direction: the clamp is missing.
    let same = |spec: &str| build(spec).evaluate(direction(i, 0.0), direction(i, 0.0)).x;
    is(same("lafortune-printed:b=1,k=3"), -(0.5_f64.powi(3)));
    is(same("lafortune:b=1,k=3"), 0.0);
}

#[test]
fn a_rough_boundary_is_walters() {
    // Straight through: h = n, F = 0.04, D = 1 / (pi alpha^2), G = 1; n_o^2 / (n_i - n_o)^2 with the viewer above.
    let bsdf = build("rough-dielectric:alpha=0.4,ior=1.5");
    let d = 1.0 / (PI * 0.16);
    is(bsdf.evaluate(-DVec3::Z, DVec3::Z).x, 0.96 * d / 0.25);
    is(bsdf.evaluate(DVec3::Z, -DVec3::Z).x, 0.96 * d * 2.25 / 0.25);
    is(bsdf.evaluate(DVec3::Z, DVec3::Z).x, 0.04 * d / 4.0);
    is(bsdf.evaluate(-DVec3::Z, -DVec3::Z).x, 0.04 * d / 4.0);
}

#[test]
fn a_smooth_boundary_mirrors_and_refracts() {
    let bsdf = build("dielectric:ior=1.5");
    let mirrored = bsdf.sample(DVec3::Z, [0.5, 0.5, 0.039]).unwrap();
    assert!(mirrored.is_mirror && mirrored.wi == DVec3::Z && mirrored.weight == DVec3::ONE);
    let refracted = bsdf.sample(direction(0.5, 0.0), [0.5, 0.5, 0.5]).unwrap();
    // Snell's law, and the square of the index.
    is(-refracted.wi.x, 0.5_f64.sin() / 1.5);
    is(refracted.weight.x, 1.0 / 2.25);
    // From below the critical angle of 41.8 degrees on, reflection is total.
    let total = bsdf.sample(direction(PI - 0.8, 0.0), [0.5, 0.5, 0.999]).unwrap();
    assert!(total.wi.z < 0.0);
}

/// Every model passes its own checks for these parameters, except where the list says that it must not.
#[test]
fn models_pass_their_checks() {
    let fails: &[(&str, &[&str])] = &[
        ("lafortune-printed:k=3", &["positivity"]),
        // The forms of the papers, white and broad: they reflect more light than arrives.
        ("phong:b=1,c=1", &["energy"]),
        ("blinn:b=1,c=1", &["energy"]),
        ("ward:b=1,c=0.5", &["energy"]),
        ("lafortune:b=1,ax=1.2,ay=1.2,az=-1.2", &["energy"]),
        ("cook-torrance", &["energy"]),
        // The print grows without bound towards the horizon.
        ("ward-printed", &["energy"]),
        ("disney:sheen=1,roughness=1,baseColor=1", &["energy"]),
    ];
    let passes = [
        "phong-normalised:b=1",
        "blinn-normalised:b=1,c=5",
        "ward-normalised:b=1,c=0.3",
        "ggx:f0=1,alpha=0.1",
        "lafortune-normalised:b=1,ax=0.5,ay=-0.8,az=-0.9",
        "ward-anisotropic:b=0.3,cx=0.2,cy=0.4",
        "cook-torrance:normalised=on,f0=1",
        "beckmann:f0=1,alpha=0.2,correlated=off",
        "beckmann:f0=1,alpha=1",
        "oren-nayar:a=1,sigma=40",
        "lafortune-3:a=0.2,b1=0.4,b2=0.3,b3=0.1,k1=4,z1=-0.5,z2=-1.2",
        "ashikhmin-shirley:nu=10,nv=100,rd=1,rs=0.5",
        "ggx:f0=0.04,a=0.5",
        "disney:metallic=1,anisotropic=0.8,roughness=0.4",
        "disney:clearcoat=1,clearcoatGloss=0.2",
        "rough-dielectric:alpha=0.1",
        "rough-dielectric:alpha=0.6,ior=2",
    ];
    let defaults = MODELS.iter().map(|model| model.name).filter(|name| !fails.iter().any(|(spec, _)| spec == name));
    let expected = fails.iter().copied().chain(passes.into_iter().chain(defaults).map(|spec| (spec, &[][..])));
    let mut wrong = Vec::new();
    for (spec, failing) in expected {
        let results = check(build(spec).as_ref());
        let found: Vec<&str> = results.iter().filter(|r| !r.passed).map(|r| r.property).collect();
        if found != failing {
            wrong.push(format!("{spec}: {results:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Random pairs of directions whose components are f32, so that Rust and GLSL have the same input.
fn pairs(transmits: bool, count: usize) -> Vec<(DVec3, DVec3)> {
    let mut random = SplitMix::new(3);
    let mut one = || {
        let (cos, phi) = (0.05 + 0.95 * random.next_number(), 2.0 * PI * random.next_number());
        let w = gonio_bsdf::sampling::direction_of_cosine(cos, phi);
        let side = if transmits && random.next_number() < 0.5 { -1.0 } else { 1.0 };
        DVec3::new(f64::from(w.x as f32), f64::from(w.y as f32), side * f64::from(w.z as f32))
    };
    (0..count).map(|_| (one(), one())).collect()
}

/// At the ends of every range, also where light and viewer graze the surface, all numbers are finite.
#[test]
fn no_parameter_makes_a_value_infinite() {
    let mut tried = 0;
    for model in MODELS {
        let spec = ModelSpec::new(model);
        let ends = model.parameters.iter().flat_map(|parameter| {
            parameter.range().map(|value| {
                let mut spec = spec.clone();
                spec.values.set_value(&parameter.name, DVec3::splat(value));
                spec
            })
        });
        for spec in ends.chain([spec.clone()]) {
            let bsdf = spec.build();
            let mut random = SplitMix::new(11);
            let mut all = pairs(bsdf.transmits(), 200);
            let grazing = [1e-9, 0.3, 1.0].map(|cos| gonio_bsdf::sampling::direction_of_cosine(cos, 2.0));
            all.extend(grazing.iter().flat_map(|wi| grazing.iter().map(|wo| (*wi, *wo))));
            for (wi, wo) in all {
                tried += 1;
                let (f, density) = (bsdf.evaluate(wi, wo), bsdf.density(wi, wo));
                let may_be_negative = model.name == "lafortune-printed";
                let is_right = f.is_finite() && density.is_finite() && density >= 0.0;
                let text = || format!("{}: f({wi}, {wo}) = {f}, density {density}", spec.text());
                assert!(is_right && (may_be_negative || f.min_element() >= 0.0), "{}", text());
                if let Some(sample) = bsdf.sample(wo, random.next_three()) {
                    // The viewer's direction has the components of f32.
                    let is_unit = (sample.wi.length() - 1.0).abs() < 1e-6;
                    assert!(is_unit && sample.weight.is_finite(), "{}: {sample:?} for {wo}", spec.text());
                }
            }
        }
    }
    assert!(tried > 30_000, "{tried}");
}

#[test]
fn glsl_functions_agree_with_rust() {
    let specs = [
        "ward:a=0.1,b=0.5/0.4/0.3,c=0.4",
        "ward-anisotropic:cx=0.3,cy=0.6",
        "ggx:f0=0.9/0.6/0.3,correlated=off",
        "beckmann:correlated=off,alpha=0.6",
        "cook-torrance:normalised=on",
        "oren-nayar:sigma=60",
        "ashikhmin-shirley:nu=20,nv=50",
        "lafortune-printed:k=3,ax=0.5",
        "lafortune:ax=0.5,ay=-0.7",
        "disney:metallic=0.5,anisotropic=0.7,sheen=1,clearcoat=1,subsurface=0.5,specularTint=1,baseColor=0.8/0.4/0.1",
        "rough-dielectric:alpha=0.6,ior=2",
        "ward-printed:b=0.5/0.6/0.7,c=0.5",
    ];
    let all = MODELS.iter().map(|model| model.name).chain(specs);
    let mut compared = 0;
    for spec in all {
        let spec = ModelSpec::parse(spec).unwrap();
        let Some(glsl) = spec.model.glsl else { continue };
        compared += 1;
        let bsdf = spec.build();
        let twin =
            GlslBrdf::new(glsl, 1, spec.values.clone()).unwrap_or_else(|error| panic!("{}: {error}", spec.text()));
        let pairs = pairs(bsdf.transmits(), 4000);
        let found = twin.evaluate_pairs(&pairs).unwrap();
        let (mut worst, mut place, mut lit) = (0.0, None, 0);
        for ((wi, wo), found) in pairs.iter().zip(found) {
            let expected = bsdf.evaluate(*wi, *wo);
            lit += usize::from(expected.max_element() > 1e-4);
            for channel in 0..3 {
                // Below, a lobe's exponent multiplies the rounding of its argument.
                let scale = expected[channel].abs().max(1e-2);
                let error = (found[channel] - expected[channel]).abs() / scale;
                if error > worst {
                    (worst, place) = (error, Some((*wi, *wo, expected, found)));
                }
            }
        }
        assert!(lit > 100, "{}: only {lit} pairs have a value", spec.text());
        // f32 rounds to 6e-8, and exponents up to 32 multiply that: issue 19 set 1e-5. Near the angle of total reflection
        // Fresnel's equations take the root of a small difference, which multiplies it by another 100.
        let tolerance = if bsdf.transmits() { 1e-4 } else { 1e-5 };
        assert!(worst < tolerance, "{}: {worst:e} at {place:?}", spec.text());
    }
    assert!(compared > 30, "{compared}");
}
