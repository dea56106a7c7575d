//! Materials with BRDFs of their own: models, GLSL functions and measured tables.

use crate::bench::{Bench, scene_from};
use crate::{CLAY, lights, object, scene, textured_model};
use gonio_bsdf::{MODELS, MerlTable, ModelSpec};
use gonio_reference::ReferenceScene;
use gonio_scene::{Scene, ViewSpec};

fn brdf(text: &str) -> String {
    format!("brdf = \"{text}\", ambient = [0.3, 0.2, 0.2]")
}

fn picture(scene: &Scene) -> gonio_scene::Picture {
    ReferenceScene::new(scene).render(&scene.frame(0.0), None, &|_| ()).picture
}

/// Narrow lobes, and lobes that grow beyond bounds at the horizon, are 8-bit comparisons: f32 resolves an angle near the
/// middle of a lobe, and a cosine near 0, to fewer digits.
fn check_model(bench: &mut Bench, name: &str, scene: &Scene) {
    let c = bench.compare(scene, None);
    assert!(c.interior >= 200, "{name}: only {} pixels lie on one surface, which tests little", c.interior);
    assert!(c.worst.0 <= 2e-3, "{name}: {} on one surface: {}", c.worst.0, c.worst.1);
    assert!(c.close >= 0.995, "{name}: only {:.3} % of the pixels are within 1/255", 100.0 * c.close);
}

#[test]
fn every_model() {
    let mut bench = Bench::new();
    let mut seen: Vec<gonio_scene::Picture> = Vec::new();
    for model in MODELS {
        // Lafortune's default matrix makes Phong's lobe.
        let settings = if model.parameters.iter().any(|p| p.name == "ax") { "ax=0.8,ay=0.7" } else { "" };
        let material = brdf(&format!("{}:{settings}", model.name));
        let lit = |equation: &str, shading: &str| {
            scene(equation, &lights("all"), &object("sphere-coarse-averaged", shading, &material))
        };
        let phong = lit("", "phong");
        check_model(&mut bench, model.name, &phong);
        let picture = picture(&phong);
        assert!(!seen.contains(&picture), "{} looks like another model", model.name);
        seen.push(picture);
    }
    for (equation, shading) in [
        ("convention = \"physical\"\nshadows = false", "phong"),
        ("brdf = \"ward\"", "gouraud"),
        ("", "flat"),
        ("", "flat-per-face"),
    ] {
        let brdf = brdf("ggx:a=0.2/0.1/0.05,f0=0.9/0.6/0.3,alpha=0.4");
        let scene = scene(equation, &lights("all"), &object("sphere-coarse-averaged", shading, &brdf));
        bench.check(&format!("{equation} {shading}"), &scene, None);
    }
}

/// Two models, another material and shadows in one picture; in OpenGL ES too.
#[test]
fn several_materials_and_shadows() {
    for es in [false, true] {
        let mut bench = Bench::with(es);
        let objects = [
            object("cube", "phong", &brdf("oren-nayar")),
            object("sphere-coarse-averaged", "phong", &brdf("disney:")).replace("translate = [0.2", "translate = [1.3"),
            object("sphere-coarse-averaged", "phong", CLAY).replace("translate = [0.2", "translate = [-1.3"),
        ];
        let scene = scene("", &lights("all"), &objects.concat());
        bench.check(&format!("several, es {es}"), &scene, None);
    }
}

/// Along u where there are texture coordinates, else around the vertical axis; with a normal map.
#[test]
fn directions_of_anisotropic_models() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let [mapped, textured] =
        [textured_model::write_with_normal_map(folder.path()), textured_model::write(folder.path())];
    for model in ["builtin:sphere-coarse-averaged", &mapped.display().to_string(), &textured.display().to_string()] {
        let of = |x: &str, y: &str| {
            let brdf = brdf(&format!("ward-anisotropic:cx={x},cy={y},b=0.6"));
            let object = object("cube", "phong", &brdf).replace("builtin:cube", model);
            scene("", &lights("all"), &object)
        };
        let along = of("0.5", "0.15");
        bench.check(model, &along, None);
        assert!(picture(&along) != picture(&of("0.15", "0.5")), "{model}: the direction shows");
    }
}

/// Sums over directions, small lights, narrow lobes that see the sun itself, lobes about a leaning axis and anisotropic ones; light
/// from vertices, surfaces that also mirror, and OpenGL ES.
#[test]
fn environments_light_functions() {
    for (es, environment, text, shading, extra) in [
        (false, "sky", "ggx:alpha=0.3", "phong", ""),
        (false, "room", "ggx:f0=0.9/0.6/0.3,alpha=0.1", "phong", ""),
        (false, "sky", "oren-nayar", "flat", ""),
        (false, "sky", "ward:a=0.3,b=0.4", "gouraud", ""),
        (true, "sky", "ward-anisotropic:cx=0.1,cy=0.4,b=0.5/0.4/0.3", "phong", ""),
        (false, "room", "lafortune:ax=0.8,ay=0.7", "phong", ""),
        (true, "room", "disney:", "flat-per-face", ""),
        (false, "sky", "ggx:alpha=0.03", "phong", ""),
        (false, "sky", "beckmann:alpha=0.3", "phong", ", reflectivity = 0.3"),
    ] {
        let mut bench = Bench::with(es);
        let lights = format!(
            "[environment]\nimage = \"{environment}\"\nlight = true\nrotate = [30, 10, 0]\n{}",
            lights("point")
        );
        let object = |material: &str| object("sphere-coarse-averaged", shading, &format!("{material}{extra}"));
        let camera = "position = [1.5, 2.0, 5.0]\ntarget = [0.1, 0.2, 0.0]";
        let scene = scene_from(camera, "", &lights, &object(&brdf(text)));
        let c = bench.compare(&scene, None);
        let name = format!("{text} in {environment}, es {es}");
        // The tolerance of environment light in `environment.rs`: f32 in cubemaps.
        assert!(c.interior >= 200 && c.worst.0 <= 4e-3, "{name}: {} {}", c.worst.0, c.worst.1);
        assert!(c.close >= 0.995, "{name}: only {:.3} % of the pixels are within 1/255", 100.0 * c.close);
        let unlit = scene_from(camera, "", &lights.replace("light = true", "light = false"), &object(&brdf(text)));
        assert!(picture(&scene) != picture(&unlit), "{name}: the environment shows");
    }
}

#[test]
fn views_of_the_terms() {
    let mut bench = Bench::new();
    let object = object("sphere-coarse-averaged", "phong", &brdf("ashikhmin-shirley"));
    let scene = scene("", &lights("all"), &object);
    for quantity in [gonio_light::Quantity::Spec, gonio_light::Quantity::Specular, gonio_light::Quantity::Diffuse] {
        bench.check(quantity.name(), &scene, Some(ViewSpec { quantity, light: Some(2) }));
    }
}

/// A function whose names are those of the renderer's own shaders, with integers that become floats.
const FUNCTION: &str = "analytic\n::begin parameters\nfloat roughness 0 1 0.4\ncolor tint 0.9 0.6 0.3\nbool wide 1\n::end parameters\n\
    ::begin shader\nconst float PI = 3.14159265358979;\nfloat reflection(float x) { return 1 / (1 + x); }\n\
    vec3 BRDF( vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y )\n{\n    vec3 H = normalize(L + V);\n    float tilt = 1 - dot(N, H);\n\
    float e = wide ? 2 : 8;\n    return tint * reflection(e * tilt / roughness) / PI;\n}\n::end shader\n";

#[test]
fn functions_of_files_in_both_dialects() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.brdf");
    std::fs::write(&path, FUNCTION).unwrap();
    for es in [false, true] {
        let mut bench = Bench::with(es);
        for settings in ["", ":roughness=0.1,wide=off"] {
            let material = format!("brdf_file = \"{}{settings}\"", path.display());
            let scene = scene("", &lights("point"), &object("sphere-coarse-averaged", "phong", &material));
            bench.check(&format!("{settings} es {es}"), &scene, None);
        }
    }
}

/// The table as a texture, also where cells are missing.
#[test]
fn measured_tables() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("measured.binary");
    let table = MerlTable::tabulate(ModelSpec::parse("ggx:a=0.2/0.1/0.05,f0=0.5,alpha=0.3").unwrap().build().as_ref());
    let bytes = table.unwrap().write();
    let mut holes = bytes.clone();
    // Every seventh value of the green channel.
    for value in (gonio_bsdf::merl::CELLS..2 * gonio_bsdf::merl::CELLS).step_by(7) {
        holes[12 + 8 * value..20 + 8 * value].copy_from_slice(&(-1.0_f64).to_le_bytes());
    }
    for es in [false, true] {
        let mut bench = Bench::with(es);
        for (name, bytes) in [("whole", &bytes), ("with holes", &holes)] {
            std::fs::write(&path, bytes).unwrap();
            let material = format!("brdf_file = \"{}\"", path.display());
            let scene = scene("", &lights("all"), &object("sphere-coarse-averaged", "phong", &material));
            bench.check(&format!("{name} es {es}"), &scene, None);
        }
    }
}
