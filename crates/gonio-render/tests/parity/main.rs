//! Pictures of the GPU compared with those of the reference: the same scenes, the same pixels.
//!
//! The project has set two tolerances. Linear values differ by at most 1e-3 (absolute or
//! relative) where a pixel and its eight neighbours show one surface: elsewhere the two may
//! disagree about the surface at a pixel centre, because a GPU snaps corners to 1/256 of a pixel.
//! As 8-bit colours, 99.5 % of all pixels, edges included, are within 1/255.
#![allow(clippy::unwrap_used)]

mod bench;
mod environment;
mod own_brdfs;
mod shadows;
mod textured_model;

use bench::{Bench, scene_from};
use gonio_mesh::Wrap;
use gonio_reference::ReferenceScene;
use gonio_scene::{Scene, ViewSpec};

fn scene(equation: &str, lights: &str, objects: &str) -> Scene {
    scene_from("position = [1.5, 2.0, 5.0]\ntarget = [0.1, 0.2, 0.0]", equation, lights, objects)
}

fn object(model: &str, shading: &str, material: &str) -> String {
    // Rotated, scaled unevenly, translated, so that mistakes in the transform of normals are visible.
    format!(
        "[[object]]\nmodel = \"builtin:{model}\"\nshading = \"{shading}\"\nrotate = [20, 35, -10]\n\
         scale = [1.0, 1.4, 0.7]\ntranslate = [0.2, 0.1, -0.3]\nmaterial = {{ {material} }}\n"
    )
}

const CLAY: &str = "ambient = [0.3, 0.2, 0.2], diffuse = [0.8, 0.45, 0.2], specular = [0.5, 0.5, 0.5], shininess = 32";
const AMBIENT: &str = "[[light]]\nkind = \"ambient\"\ncolor = [0.2, 0.25, 0.3]\n";
const DIRECTIONAL: &str = "[[light]]\nkind = \"directional\"\ndirection = [-1, -2, -1.5]\ncolor = [0.9, 0.8, 0.7]\n";
const POINT: &str =
    "[[light]]\nkind = \"point\"\nposition = [2, 3, 2.5]\nconstant = 1\nlinear = 0.14\nquadratic = 0.07\n";
const SPOT: &str = "[[light]]\nkind = \"spot\"\nposition = [1, 3, 3]\ndirection = [-0.3, -1, -1]\n\
                    inner_angle = 6\nouter_angle = 34\n";

/// The lights of a kind, or of all kinds for `all`.
fn lights(kind: &str) -> String {
    match kind {
        "directional" => format!("{AMBIENT}{DIRECTIONAL}"),
        "point" => format!("{AMBIENT}{POINT}"),
        "spot" => format!("{AMBIENT}{SPOT}"),
        _ => format!("{DIRECTIONAL}{AMBIENT}{POINT}{SPOT}"),
    }
}

#[test]
fn every_shading_light_and_convention_with_and_without_textures() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write(folder.path());
    let mut scenes = 0;
    for shading in ["flat", "gouraud", "phong"] {
        for kind in ["directional", "point", "spot", "all"] {
            for (convention, specular) in [("lab", "blinn-phong"), ("physical", "phong")] {
                let equation = format!("convention = \"{convention}\"\nspecular = \"{specular}\"\nshadows = false\n");
                let plain = scene(&equation, &lights(kind), &object("sphere-coarse-averaged", shading, CLAY));
                bench.check(&format!("{shading} {kind} {convention} plain"), &plain, None);
                let object = object("sphere-coarse-averaged", shading, "");
                let object = object.replace("builtin:sphere-coarse-averaged", &model.display().to_string());
                let textured = scene(&equation, &lights(kind), &object);
                assert_eq!(textured.textures.len(), 5, "a texture for each map");
                bench.check(&format!("{shading} {kind} {convention} textured"), &textured, None);
                scenes += 2;
            }
        }
    }
    assert_eq!(scenes, 48);
}

/// Textures scaled, turned, moved, mirrored and clamped, as in glTF; and a texture of roughness.
#[test]
fn textures_laid_on_in_every_way() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write(folder.path());
    let object = object("cube", "phong", "").replace("builtin:cube", &model.display().to_string());
    let plain = scene("", &lights("all"), &object);
    let frame = plain.frame(0.0);
    let mut seen = vec![ReferenceScene::new(&plain).render(&frame, None, &|_| ()).picture];
    for wrap in [[Wrap::Repeat; 2], [Wrap::Mirror; 2], [Wrap::Clamp, Wrap::Mirror], [Wrap::Mirror, Wrap::Repeat]] {
        let mut scene = plain.clone();
        for maps in scene.materials.iter_mut().map(|m| &mut m.maps) {
            for map in [&mut maps.diffuse, &mut maps.specular, &mut maps.emitted, &mut maps.shininess] {
                let map = map.as_mut().unwrap();
                (map.scale, map.rotation, map.offset, map.wrap) = ([1.7, 0.6], 0.7, [0.3, -0.4], wrap);
            }
        }
        bench.check(&format!("{wrap:?}"), &scene, None);
        let picture = ReferenceScene::new(&scene).render(&frame, None, &|_| ()).picture;
        assert!(seen.iter().all(|other| *other != picture), "{wrap:?} shows");
        seen.push(picture);
    }
}

#[test]
fn a_texture_of_roughness() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write(folder.path());
    let object = object("cube", "phong", "").replace("builtin:cube", &model.display().to_string());
    let exponents = scene("", &lights("all"), &object);
    let mut scene = exponents.clone();
    scene.materials.iter_mut().for_each(|material| material.maps.roughness = Some(0.9));
    let c = bench.compare(&scene, None);
    // The exponent is the roughness to the power of -4: the error of 8-bit filter weights counts four times.
    assert!(c.interior > 500 && c.worst.0 <= 4e-3, "{} pixels, {} {}", c.interior, c.worst.0, c.worst.1);
    assert!(c.close >= 0.995, "{:.3} % within 1/255", 100.0 * c.close);
    let frame = scene.frame(0.0);
    let picture = |scene| ReferenceScene::new(scene).render(&frame, None, &|_| ()).picture;
    assert!(picture(&scene) != picture(&exponents), "it shows");
}

#[test]
fn colors_of_vertices() {
    let mut bench = Bench::new();
    for shading in ["flat-per-face", "flat", "gouraud", "phong"] {
        let plain = scene("", &lights("all"), &object("cube", shading, CLAY));
        let mut scene = plain.clone();
        for mesh in &mut scene.meshes {
            // A different colour at each corner, none of them black.
            let color = |p: &[f32; 3]| [0.5 + 0.3 * p[0], 0.5 + 0.3 * p[1], 0.5 + 0.3 * p[2], 1.0];
            let mesh = std::sync::Arc::make_mut(mesh);
            mesh.colors = mesh.positions.iter().map(color).collect();
        }
        bench.check(shading, &scene, None);
        let frame = scene.frame(0.0);
        let picture = |scene| ReferenceScene::new(scene).render(&frame, None, &|_| ()).picture;
        assert!(picture(&scene) != picture(&plain), "it shows");
    }
}

#[test]
fn textures_with_hard_edges() {
    // GPUs weigh the four texels of a linear filter with 8 bits: where black meets white that alone is
    // an error of up to 1/512. The tolerance is twice that.
    let mut bench = Bench::new();
    for shading in ["flat", "gouraud", "phong"] {
        let scene = scene("", &lights("all"), &object("still-life", shading, "shininess = 40"));
        assert!(!scene.textures.is_empty(), "the still life has textures");
        let c = bench.compare(&scene, None);
        assert!(c.interior > 500 && c.worst.0 <= 4e-3, "{shading}: {} pixels, {} {}", c.interior, c.worst.0, c.worst.1);
        assert!(c.close >= 0.995, "{shading}: {:.3} % within 1/255", 100.0 * c.close);
    }
}

#[test]
fn normals_from_a_texture() {
    let mut bench = Bench::new();
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write_with_normal_map(folder.path());
    let object = object("cube", "phong", "").replace("builtin:cube", &model.display().to_string());
    let with_map = scene("", &lights("all"), &object);
    assert!(with_map.materials[0].maps.normal.is_some());
    bench.check("normal map", &with_map, None);
    // Without it the picture differs.
    let without = scene("", &lights("all"), &object.replace("material = {", "material = { textures = false"));
    let difference = bench.compare(&without, None);
    assert!(difference.interior > 500);
}

#[test]
fn every_brdf_and_its_normalised_form() {
    let mut bench = Bench::new();
    for brdf in ["lambert", "lafortune", "blinn", "phong", "ward"] {
        for normalised in [false, true] {
            for shading in ["gouraud", "phong"] {
                let equation = format!("brdf = \"{brdf}\"\nbrdf_normalised = {normalised}\n");
                let scene = scene(&equation, &lights("all"), &object("suzanne", shading, CLAY));
                bench.check(&format!("{brdf} normalised {normalised} {shading}"), &scene, None);
            }
        }
    }
}

#[test]
fn switches_of_the_equation() {
    let mut bench = Bench::new();
    for equation in [
        "gated = false\nspecular = \"phong\"",
        "cosine_weighted = true",
        "two_sided = false",
        "specular = \"none\"",
        "ambient = false",
        "diffuse = false",
        "specular_term = false",
        "attenuation = false",
        "spot = false",
    ] {
        for shading in ["flat-per-face", "gouraud", "phong"] {
            let scene = scene(equation, &lights("all"), &object("sphere-coarse-averaged", shading, CLAY));
            bench.check(&format!("{equation} {shading}"), &scene, None);
        }
    }
}

#[test]
fn mirrored_objects_and_lit_back_faces() {
    let mut bench = Bench::new();
    for shading in ["flat", "gouraud", "phong"] {
        let mirrored = object("sphere-coarse-averaged", shading, CLAY).replace("scale = [1.0", "scale = [-1.0");
        bench.check(&format!("mirrored {shading}"), &scene("", &lights("all"), &mirrored), None);
        // From below: the floor of the still life has no thickness, so its back is visible.
        let from_below = "position = [1.5, -3.0, 5.0]\ntarget = [0.1, 0.2, 0.0]";
        let still_life = object("still-life", shading, "shininess = 40, textures = false");
        let below = scene_from(from_below, "", &lights("all"), &still_life);
        bench.check(&format!("from below {shading}"), &below, None);
    }
}

#[test]
fn emitted_light_and_surfaces_that_let_light_through() {
    let mut bench = Bench::new();
    let behind = object("cube", "phong", "diffuse = [0.2, 0.3, 0.9], emitted = [0.1, 0.0, 0.0]");
    for opacity in ["0.6", "0.2"] {
        let front = object("sphere-coarse-averaged", "phong", &format!("{CLAY}, opacity = {opacity}"))
            .replace("translate = [0.2, 0.1, -0.3]", "translate = [0.6, 0.7, 2.0]");
        let scene = scene("", &lights("all"), &format!("{behind}{front}"));
        bench.check(&format!("opacity {opacity}"), &scene, None);
    }
}

#[test]
fn every_debug_view() {
    let mut bench = Bench::new();
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        let scene = scene("", &lights("all"), &object("sphere-coarse-averaged", shading, CLAY));
        for &quantity in gonio_light::Quantity::ALL {
            // Light 2 is the point light, for which every quantity has a value.
            let light = (quantity.per_light() || quantity.summed_over_lights()).then_some(2);
            // Triangles' normals come from derivatives in f32 unless shading is flat, too coarse for 1e-3.
            let by_derivatives = quantity == gonio_light::Quantity::GeometricNormal && !shading.starts_with("flat");
            let view = Some(ViewSpec { quantity, light });
            let c = bench.compare(&scene, view);
            let tolerance = if by_derivatives { 5e-3 } else { 1e-3 };
            assert!(c.interior >= 200, "{quantity} {shading}: {} pixels", c.interior);
            assert!(c.worst.0 <= tolerance, "{quantity} {shading}: {} {}", c.worst.0, c.worst.1);
            assert!(c.close >= 0.995, "{quantity} {shading}: {:.3} % within 1/255", 100.0 * c.close);
        }
    }
}

#[test]
fn a_thousand_lights_in_one_pass() {
    let mut bench = Bench::new();
    let many: String = (0..1000)
        .map(|i| {
            let a = f64::from(i) * 2.399_963;
            let r = 0.06 * f64::from(i).sqrt() + 1.0;
            format!(
                "[[light]]\nkind = \"point\"\nposition = [{}, {}, {}]\nintensity = 0.004\nquadratic = 0.1\n",
                r * a.cos(),
                2.0 * (f64::from(i) / 500.0 - 1.0),
                r * a.sin() + 1.0
            )
        })
        .collect();
    let scene = scene("", &many, &object("sphere-coarse-averaged", "phong", CLAY));
    assert_eq!(scene.frame(0.0).lights.len(), 1000);
    bench.check("1000 lights", &scene, None);
}
