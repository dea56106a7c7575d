//! Materials with BRDFs of their own: models, files, and what is wrong with them.

use crate::{Memory, TRIANGLE};
use gonio_bsdf::{MerlTable, ModelSpec};
use gonio_light::{DVec3, ShadingPoint};
use gonio_scene::edit::{Edited, apply};
use gonio_scene::load::{describe, load};
use gonio_scene::{Scene, toml_file};
use std::path::Path;

const FITS: &str = "[[fit]]\nmodel = \"ggx\"\nrms = 0.1\n[fit.parameters]\na = [0.2, 0.1, 0.05]\nalpha = 0.35\n\
                    [[fit]]\nmodel = \"ward\"\n[fit.parameters]\nc = 0.5\n";
const FUNCTION: &str = "analytic\n::begin parameters\nfloat gain 0 1 0.25\n::end parameters\n::begin shader\n\
                        vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return vec3(gain); }\n::end shader\n";

fn files() -> Memory {
    let table = MerlTable::tabulate(ModelSpec::parse("lambert:a=0.5").unwrap().build().as_ref()).unwrap();
    Memory::default()
        .with("folder/t.obj", TRIANGLE)
        .with("folder/fit.toml", FITS)
        .with("folder/own.brdf", FUNCTION)
        .with("folder/table.binary", table.write())
}

/// The scene file `folder/scene.toml` with this material.
fn scene_of(material: &str, files: Memory) -> Result<Scene, String> {
    let text = format!("[[object]]\nmodel = \"t.obj\"\nmaterial = {{ {material} }}\n");
    let files = files.with("folder/scene.toml", text);
    let scene = describe(&["folder/scene.toml"], &files).map_err(|e| e.to_string())?;
    load(scene, Path::new(""), &files).map_err(|e| e.to_string())
}

fn value(scene: &Scene) -> DVec3 {
    let point = ShadingPoint { position: DVec3::ZERO, normal: DVec3::Z, view: DVec3::Z, tangent: DVec3::X };
    scene.materials[0].brdf.as_ref().unwrap().evaluate(&point, DVec3::new(0.6, 0.0, 0.8))
}

#[test]
fn models_and_files_are_the_functions_that_they_name() {
    let expected = |text: &str| {
        let bsdf = ModelSpec::parse(text).unwrap().build();
        bsdf.evaluate(DVec3::new(0.6, 0.0, 0.8), DVec3::Z)
    };
    for (material, expected, tolerance) in [
        ("brdf = \"ggx:alpha=0.2,f0=1/0.8/0.3\"", expected("ggx:alpha=0.2,f0=1/0.8/0.3"), 1e-12),
        // The best fit of the file, relative to the scene file.
        ("brdf_file = \"fit.toml\"", expected("ggx:a=0.2/0.1/0.05,alpha=0.35"), 1e-12),
        ("brdf_file = \"fit.toml:alpha=0.5\"", expected("ggx:a=0.2/0.1/0.05,alpha=0.5"), 1e-12),
        ("brdf_file = \"own.brdf\"", DVec3::splat(0.25), 1e-6),
        ("brdf_file = \"own.brdf:gain=0.75\"", DVec3::splat(0.75), 1e-6),
        ("brdf_file = \"table.binary\"", DVec3::splat(0.5 / std::f64::consts::PI), 1e-6),
    ] {
        let scene = scene_of(material, files()).unwrap();
        assert!((value(&scene) - expected).abs().max_element() <= tolerance, "{material}: {}", value(&scene));
        // Its colours are in the BRDF; what follows from k_d follows what stands in.
        let surface = scene.materials[0].base_surface();
        assert_eq!(surface.specular, DVec3::ONE, "{material}");
        assert_eq!(surface.ambient, surface.diffuse, "{material}");
    }
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let broken = || {
        files()
            .with("folder/broken.toml", "[[fit]]\nmodel = \"ggx\"\n[fit.parameters]\nalpha = = 1\n")
            .with("folder/unknown.toml", "[[fit]]\nmodel = \"gxx\"\n[fit.parameters]\n")
            .with("folder/broken.brdf", FUNCTION.replace("gain)", "gan)"))
            .with("folder/short.binary", [90_i32, 90, 180].map(i32::to_le_bytes).concat())
            .with("folder/picture.png", "not a BRDF")
    };
    for (material, begin, end) in [
        ("brdf = \"gxx\"", "folder/scene.toml:3:21: ", "unknown model `gxx`: expected one of lambert, phong"),
        (
            "brdf = \"ggx:alpha=2\"",
            "folder/scene.toml:3:21: ",
            "invalid value `2` of parameter `alpha`: expected a number from 0.01 to 1",
        ),
        (
            "brdf = \"ggx\", brdf_file = \"fit.toml\"",
            "folder/scene.toml:3:",
            "the material has both `brdf` and `brdf_file`; leave one of them out",
        ),
        ("brdf_file = \"missing.toml\"", "folder/missing.toml: ", "there is no such file"),
        ("brdf_file = \"broken.toml\"", "folder/broken.toml:4:9: ", ""),
        ("brdf_file = \"unknown.toml\"", "folder/unknown.toml: ", "unknown model `gxx`"),
        ("brdf_file = \"fit.toml:beta=1\"", "folder/fit.toml: ", "unknown parameter `beta`: expected one of a, f0"),
        ("brdf_file = \"broken.brdf\"", "folder/broken.brdf:6:", "`gan`"),
        ("brdf_file = \"short.binary\"", "folder/short.binary: ", "the file is truncated: it has 12 of"),
        ("brdf_file = \"picture.png\"", "folder/picture.png: ", "unknown format: expected a MERL .binary"),
    ] {
        let error = scene_of(material, broken()).unwrap_err();
        assert!(error.starts_with(begin) && error.contains(end), "{material}: {error}");
    }
}

/// A window that edits a material reads no file again, except one that is new.
#[test]
fn edits_keep_what_was_read() {
    let scene = scene_of("brdf_file = \"fit.toml\"", files()).unwrap();
    let edit = |change: &dyn Fn(&mut gonio_scene::scene_file::MaterialOverride)| {
        let mut settings = scene.settings.clone();
        change(&mut settings.objects[0].material);
        apply(&scene, settings).unwrap()
    };
    let Edited::Done(same) = edit(&|m| m.opacity = Some(0.5)) else { panic!("the file was read") };
    assert_eq!(same.loaded.materials[0].brdf, scene.materials[0].brdf);
    let Edited::Done(model) = edit(&|m| (m.brdf, m.brdf_file) = (Some("ward:a=0.5,b=0".into()), None)) else {
        panic!("a model needs no file")
    };
    assert!((value(&model.loaded) - 0.5 / std::f64::consts::PI).abs().max_element() < 1e-12);
    let Edited::Done(plain) = edit(&|m| m.brdf_file = None) else { panic!("nothing to read") };
    assert_eq!(plain.loaded.materials[0].brdf, None);
    assert!(matches!(edit(&|m| m.brdf_file = Some("folder/own.brdf".into())), Edited::NeedsFiles(_)));
}

#[test]
fn light_that_passes_is_noted_and_meshes_get_their_direction() {
    let of = |text: &str| scene_of(&format!("brdf = \"{text}\""), files()).unwrap();
    let notes = |scene: &Scene| scene.diagnostics.iter().filter(|d| d.message.contains("path tracer")).count();
    assert_eq!((notes(&of("rough-dielectric")), notes(&of("dielectric")), notes(&of("ggx"))), (1, 1, 0));
    assert!(of("ggx").meshes[0].tangents.is_empty());
    assert!(!of("ward-anisotropic").meshes[0].tangents.is_empty());
    let text = toml_file::read("[[object]]\nmodel = \"builtin:cube\"\nmaterial = { brdf = \"ggx\" }\n").unwrap();
    assert_eq!(toml_file::read(&text.to_toml_string()).unwrap(), text);
}
