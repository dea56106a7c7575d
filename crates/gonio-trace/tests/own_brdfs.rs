//! Materials with BRDFs of their own: even light and their albedo, one light and the light equation.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, point, sphere, square};
use glam::{DMat4, DVec3};
use gonio_bsdf::integrate::directional_albedo;

use gonio_bsdf::{MODELS, MerlTable, ModelSpec, NamedBsdf};
use gonio_environment::{Builtin, Layout};
use gonio_light::Convention;
use gonio_reference::ReferenceScene;
use gonio_scene::{LoadedEnvironment, MaterialBrdf, Surroundings};
use gonio_trace::{Simplifications, TraceSettings};
use std::sync::Arc;

fn brdf(text: &str) -> Arc<MaterialBrdf> {
    Arc::new(MaterialBrdf::new(NamedBsdf::of_model(&ModelSpec::parse(text).unwrap())))
}

fn with(mut scene: TestScene, mesh: gonio_mesh::Mesh, brdf: Arc<MaterialBrdf>) -> TestScene {
    scene.scene.add_object(mesh, brdf.into(), DMat4::IDENTITY);
    scene
}

/// A flat piece in light that is 1 everywhere, seen at an angle: it is as bright as its albedo.
#[test]
fn a_white_furnace_shows_the_albedo() {
    let mut count = 0;
    for model in MODELS.iter().filter(|model| !model.name.ends_with("-printed") && model.glsl.is_some()) {
        for degrees in [10.0_f64, 60.0] {
            let brdf = brdf(model.name);
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut scene = with(TestScene::new(), square(1.0, 0.0), brdf.clone())
                .environment(|_| DVec3::ONE)
                .eye([5.0 * sin, 0.0, 5.0 * cos], [0.0; 3]);
            scene.frame.camera.fov_y_rad = 0.2f64.to_radians();
            // Radiance changes with the squares of the indices; the environment below has the index 1 to the tracer, and
            // `directional_albedo` counts energy. Without transmission both are the same.
            if brdf.bsdf.transmits() {
                continue;
            }
            let (mean, error) = scene.mean(&RGB, 512);
            let expected = directional_albedo(brdf.bsdf.as_ref(), DVec3::new(sin, 0.0, cos)).x;
            let difference = (mean.x - expected).abs();
            // `directional_albedo` has a relative error of 0.2 %.
            let name = model.name;
            assert!(difference <= 4.0 * error + 4e-3 * expected, "{name} {degrees}: {} instead of {expected}", mean.x);
            assert!(error < 0.02 * expected, "{name} {degrees}: standard error {error:.1e} of {expected}");
            count += 1;
        }
    }
    assert_eq!(count, 2 * 18);
}

/// A slab of rough glass neither absorbs nor emits: in light that is 1 everywhere it is 1 but for what is lost between
/// facets, and its smooth limit is 1.
#[test]
fn glass_loses_only_what_facets_lose() {
    for (text, least) in
        [("dielectric", 0.9999), ("rough-dielectric:alpha=0.05", 0.99), ("rough-dielectric:alpha=0.3", 0.85)]
    {
        let mut scene = with(TestScene::new(), cuboid([2.0, 2.0, 0.25]), brdf(text)).environment(|_| DVec3::ONE);
        scene.frame.camera.fov_y_rad = 0.5f64.to_radians();
        let (mean, error) = scene.mean(&RGB, 1024);
        assert!(
            mean.x >= least - 4.0 * error && mean.x <= 1.0 + 4.0 * error + 1e-4,
            "{text}: {mean}, error {error:.1e}"
        );
    }
}

/// One small light, no environment and one bounce: the light equation, in both conventions, in RGB and with wavelengths.
#[test]
fn direct_light_is_that_of_the_reference() {
    for convention in [Convention::Lab, Convention::Physical] {
        for text in [
            "lambert:a=0.8/0.4/0.2",
            "ggx:a=0.1,f0=0.9/0.6/0.3,alpha=0.4",
            "ward-anisotropic:cx=0.5,cy=0.2,b=0.5/0.4/0.3",
            "disney:",
        ] {
            let mut scene = with(TestScene::new(), sphere(24), brdf(text)).light(point([3.0, 4.0, 5.0], 30.0));
            scene.frame.equation.convention = convention;
            scene.frame.shadows = true;
            scene.frame.camera.fov_y_rad = 16f64.to_radians();
            (scene.frame.samples, scene.frame.width, scene.frame.height) = (16, 12, 12);
            let reference = ReferenceScene::new(&scene.scene).render(&scene.frame, None, &|_| ()).picture;
            let sum: DVec3 = reference.pixels.iter().map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into())).sum();
            let expected = sum / reference.pixels.len() as f64;
            for settings in [RGB, TraceSettings { simplified: Simplifications::NONE, ..RGB }] {
                let settings = TraceSettings { most_depth: 2, ..settings };
                let (mean, error) = scene.mean(&settings, 256);
                let difference = (mean - expected).abs().max_element();
                // Outlines are sampled at other places; spectra of colours are good to 1/100.
                let tolerance = 4.0 * error + 0.01 * expected.max_element();
                assert!(
                    difference <= tolerance,
                    "{convention} {text}: {mean} instead of {expected}, error {error:.1e}"
                );
                assert!(expected.max_element() > 0.02, "{text}: {expected} is too dark to tell");
            }
        }
    }
}

/// The largest difference between the light equation and the tracer on a flat piece in the light of an environment, from several
/// sides, in parts of the brightest channel, and where it is.
fn worst_in_environments(brdf: &Arc<MaterialBrdf>) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for environment in [Builtin::Sky, Builtin::Room] {
        let map = environment.cubemap(128, Layout::OpenGl).unwrap();
        let loaded = Arc::new(LoadedEnvironment::new(environment.name(), map));
        for (degrees, turn) in [(10.0_f64, 0.0_f64), (45.0, 0.6), (45.0, 2.5), (45.0, 4.4), (75.0, 1.2), (75.0, 3.6)] {
            let ((sin, cos), (sin_turn, cos_turn)) = (degrees.to_radians().sin_cos(), turn.sin_cos());
            let mut scene = with(TestScene::new(), square(1.0, 0.0), brdf.clone());
            scene.scene.environment = Some(loaded.clone());
            scene.frame.surroundings = Some(Surroundings { lights: true, ..Surroundings::default() });
            let mut scene = scene.eye([5.0 * sin * cos_turn, 5.0 * sin * sin_turn, 5.0 * cos], [0.0; 3]);
            scene.frame.camera.fov_y_rad = 0.2f64.to_radians();
            let reference = ReferenceScene::new(&scene.scene).render(&scene.frame, None, &|_| ()).picture;
            let [r, g, b, _] = reference.at(4, 4);
            let found = DVec3::new(r.into(), g.into(), b.into());
            let (mean, error) = scene.mean(&RGB, 1024);
            let difference = (found - mean).abs().max_element() / mean.max_element();
            if difference > worst.0 {
                let place = format!("{environment} {degrees} {turn}");
                worst = (difference, format!("{place}: {found} instead of {mean}, noise {error:.1e}"));
            }
        }
    }
    worst
}

/// The few directions of the light equation see what the tracer sees. The bounds are the errors of the worst of these places,
/// measured, and a fifth more.
#[test]
fn environments_light_as_they_do_when_traced() {
    let mut failures = Vec::new();
    for (text, bound) in [
        ("lambert:a=0.8/0.4/0.2", 0.02),
        ("oren-nayar", 0.03),
        ("ggx:a=0,f0=0.9/0.6/0.3,alpha=0.1", 0.07),
        ("ggx:a=0.2/0.1/0.05,f0=0.5,alpha=0.4", 0.035),
        ("beckmann:alpha=0.3", 0.06),
        ("ward:a=0.3,b=0.4,c=0.15", 0.04),
        ("ward-anisotropic:cx=0.1,cy=0.4,b=0.5/0.4/0.3", 0.04),
        ("ashikhmin-shirley", 0.075),
        ("lafortune", 0.08),
        ("disney:", 0.03),
    ] {
        let worst = worst_in_environments(&brdf(text));
        if worst.0 > bound {
            failures.push(format!("{text}: {worst:?}"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// A function of BRDF Explorer: a highlight around the half vector on a matte base.
const EXPLORER: &str = "analytic
::begin parameters
float exponent 1 400 60
color base 0.3 0.2 0.1
::end parameters
::begin shader
vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {
    vec3 H = normalize(L + V);
    float highlight = (exponent + 2.0) / 8.0 * pow(max(dot(N, H), 0.0), exponent);
    return (base + vec3(0.4 * highlight)) / 3.14159265;
}
::end shader
";

/// The same of measured tables and of functions in files. A table is a little blurred.
#[test]
fn environments_light_materials_of_files_as_they_do_when_traced() {
    let table = |text: &str| {
        let made = MerlTable::tabulate(ModelSpec::parse(text).unwrap().build().as_ref()).unwrap();
        NamedBsdf::of_file("table.binary", &made.write(), "").unwrap()
    };
    let mut failures = Vec::new();
    for (name, bsdf, bound) in [
        ("a matte table", table("lambert:a=0.8/0.4/0.2"), 0.015),
        ("a glossy table", table("ward:a=0.3,b=0.4,c=0.15"), 0.025),
        ("a function", NamedBsdf::of_file("function.brdf", EXPLORER.as_bytes(), "").unwrap(), 0.025),
    ] {
        let worst = worst_in_environments(&Arc::new(MaterialBrdf::new(bsdf)));
        if worst.0 > bound {
            failures.push(format!("{name}: {worst:?}"));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
