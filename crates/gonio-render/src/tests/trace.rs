//! Records of the renderer's frames: they have no findings, and list everything that was drawn.

use crate::Renderer;
use glam::DVec3;
use gonio_environment::Cubemap;
use gonio_gl::headless::HeadlessContext;
use gonio_gl::trace::{AttributeSource, FrameRecord, Recording, Severity, TexelEncoding, Thumbnail, lint};
use gonio_light::Quantity;
use gonio_scene::files::Disk;
use gonio_scene::settings::EnvironmentSettings;
use gonio_scene::{LoadedEnvironment, Scene, ViewSpec};
use std::path::Path;
use std::sync::Arc;

/// Textures, transparency, all kinds of light, 20 lights (which are passed in a texture), every shading, mirrored
/// and uneven transforms.
fn everything() -> Vec<(String, Scene)> {
    let mut texts: Vec<(String, String)> = Vec::new();
    for shading in ["flat", "flat-per-face", "gouraud", "phong"] {
        let object = format!(
            "[[object]]\nmodel = \"builtin:still-life\"\nshading = \"{shading}\"\nscale = [1.0, 1.4, -0.7]\n\
             [[object]]\nmodel = \"builtin:cube\"\nname = \"pane\"\nmaterial = {{ opacity = 0.4 }}\n"
        );
        texts.push((shading.to_owned(), object));
    }
    let lights: String =
        (0..20).map(|i| format!("[[light]]\nkind = \"point\"\nposition = [{i}, 3, 2]\nintensity = 0.1\n")).collect();
    texts.push(("many lights".to_owned(), format!("[[object]]\nmodel = \"builtin:suzanne\"\n{lights}")));
    texts.push(("brdf".to_owned(), "[equation]\nbrdf = \"ward\"\n[[object]]\nmodel = \"builtin:cube\"\n".to_owned()));
    let mut scenes: Vec<(String, Scene)> = texts
        .into_iter()
        .map(|(name, text)| {
            let scene = gonio_scene::toml_file::read(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
            (name, scene)
        })
        .chain(gonio_scene::files::builtin_names().into_iter().map(|name| {
            let scene = gonio_scene::load::describe(&[&format!("builtin:{name}")], &Disk);
            (name.clone(), scene.unwrap_or_else(|e| panic!("{name}: {e}")))
        }))
        .map(|(name, mut scene)| {
            (scene.picture.width, scene.picture.height) = (48, 32);
            let scene = gonio_scene::load::load(scene, Path::new(""), &Disk);
            (name.clone(), scene.unwrap_or_else(|e| panic!("{name}: {e}")))
        })
        .collect();
    let mut lit = scenes[3].clone();
    lit.0 = "lit by an environment".to_owned();
    lit.1.environment = Some(Arc::new(LoadedEnvironment::new("waves", Cubemap::from_function(16, |d| d * d))));
    lit.1.settings.environment = Some(EnvironmentSettings { light: true, ..EnvironmentSettings::default() });
    scenes.push(lit);
    scenes
}

fn renderer(context: &HeadlessContext) -> Renderer {
    Renderer::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"))
}

fn record(renderer: &mut Renderer, scene: &Scene, view: Option<ViewSpec>) -> FrameRecord {
    let uploaded = renderer.upload(scene).unwrap_or_else(|e| panic!("{e}"));
    renderer.record(&uploaded, &scene.frame(0.0), view).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn our_own_frames_have_no_findings() {
    let scenes = everything();
    assert!(scenes.len() > 15, "{} scenes", scenes.len());
    let normals = ViewSpec { quantity: Quantity::Normal, light: None };
    for es in [false, true] {
        let context = super::context(es);
        // One renderer for all, so that state left by an earlier scene would be found.
        let mut renderer = renderer(&context);
        for (name, scene) in &scenes {
            for view in [None, Some(normals)] {
                let record = record(&mut renderer, scene, view);
                assert_eq!(lint(&record), [], "{name}, es {es}");
                assert!(record.draws.len() >= 2, "{name}: {} draws", record.draws.len());
                assert!(record.draws.iter().all(|draw| draw.errors.is_empty()), "{name}");
                // Each ends with the output pass.
                let pass = record.passes.last().unwrap_or_else(|| panic!("{name}: no pass"));
                assert_eq!((pass.name.as_str(), pass.draw_count), ("output", 1), "{name}");
                for program in &record.programs {
                    assert!(program.vertex_source.contains("void main"), "{name}: {}", program.name);
                    // Shadow maps have no colours.
                    let output = if program.name.starts_with("shadow map") { "void main" } else { "frag_color" };
                    assert!(program.fragment_source.contains(output), "{name}: {}", program.name);
                }
                for uniform in record.draws.iter().flat_map(|draw| &draw.uniforms) {
                    assert!(uniform.sent && !uniform.value.is_empty(), "{name}: {uniform:?}");
                }
            }
        }
    }
}

#[test]
fn a_record_lists_draws_with_their_textures_and_values() {
    let context = super::context(false);
    let mut renderer = renderer(&context);
    let (_, mut scene) = everything().swap_remove(3);
    // Otherwise its fine triangles would be drawn as a larger picture, averaged.
    scene.settings.picture.samples = 1;
    let record = record(&mut renderer, &scene, None);
    let [first, rest @ ..] = record.passes.as_slice() else { panic!("no pass") };
    assert_eq!((first.name.as_str(), first.target.width, first.target.height), ("scene", 48, 32));
    assert_eq!(first.target.format.as_deref(), Some("RGBA16F"));
    let cleared = first.cleared.clone().unwrap_or_default();
    assert_eq!((cleared.color, cleared.depth), (Some([0.0; 4]), Some(1.0)));
    assert_eq!(rest.len(), 1);
    let subject = |draw: &gonio_gl::trace::DrawRecord| draw.subject.clone().unwrap_or_default();
    let materials: Vec<_> = scene.materials.iter().map(|m| m.material.name.clone()).collect();
    for draw in &record.draws[..record.draws.len() - 1] {
        assert!(materials.contains(&subject(draw).material), "{}", draw.title());
        assert!(draw.indexed && draw.count % 3 == 0 && draw.primitive == "triangles");
    }
    // The sampler, unit and texture of the textured material.
    let textured = scene.materials.iter().find_map(|m| Some((m.material.name.clone(), m.maps.diffuse?.texture)));
    let (material, texture) = textured.unwrap_or_else(|| panic!("a texture"));
    let draw = record.draws.iter().find(|draw| subject(draw).material == material).unwrap_or_else(|| panic!("a draw"));
    let sampler = draw.samplers.iter().find(|s| s.name == "diffuse_map").unwrap_or_else(|| panic!("a sampler"));
    let read = sampler.texture.and_then(|id| record.texture(id)).unwrap_or_else(|| panic!("a texture"));
    let expected = &scene.textures[texture];
    assert_eq!(
        (sampler.unit, &read.name, read.width, read.height),
        (0, &expected.name, expected.width, expected.height)
    );
    assert_eq!((read.format.as_str(), read.levels.len()), ("SRGB8_ALPHA8", 1 + expected.mip_levels().len()));
    // The last draw but one is the glass pane, blended over the picture.
    let pane = &record.draws[record.draws.len() - 2];
    assert_eq!(subject(pane).object, "pane");
    let blend = pane.state.blend.clone().unwrap_or_else(|| panic!("blending"));
    assert_eq!(blend.color, ["one", "one minus source alpha"]);
    assert!(!pane.state.depth_mask && pane.state.depth_test.as_deref() == Some("less"));
    let fed = pane.attributes.iter().find(|a| a.name == "position").unwrap_or_else(|| panic!("positions"));
    assert!(matches!(&fed.source, AttributeSource::Array(array) if array.buffer_name == "pane: position"), "{fed:?}");
}

/// The counters of the GPU for each draw add up to those for all of them; and a picture drawn after a
/// recording is the same as one drawn before.
#[test]
fn recording_counts_right_and_changes_nothing() {
    let context = super::context(false);
    let mut renderer = renderer(&context);
    let (_, scene) = &everything()[3];
    let uploaded = renderer.upload(scene).unwrap_or_else(|e| panic!("{e}"));
    let frame = scene.frame(0.0);
    let picture = |renderer: &mut Renderer| {
        let drawn = renderer.render(&uploaded, &frame, None).unwrap_or_else(|e| panic!("{e}"));
        (drawn.encoded8().unwrap_or_else(|e| panic!("{e}")).rgba, drawn.statistics)
    };
    let (before, statistics) = picture(&mut renderer);
    let record = renderer.record(&uploaded, &frame, None).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(picture(&mut renderer), (before, statistics));
    // All but the output pass.
    let draws = &record.draws[..record.draws.len() - 1];
    assert_eq!(draws.len(), statistics.draw_calls as usize);
    assert_eq!(draws.iter().map(|draw| draw.vertices_shaded).sum::<Option<u64>>(), statistics.vertices);
    assert_eq!(draws.iter().map(|draw| draw.fragments_shaded).sum::<Option<u64>>(), statistics.fragments);
    assert!(statistics.fragments > Some(100), "{statistics:?}");
}

#[test]
fn only_one_records_at_a_time_and_dropping_ends_it() {
    let context = super::context(false);
    let recording = Recording::begin(context.gl()).unwrap_or_else(|e| panic!("{e}"));
    let why = Recording::begin(context.gl()).err().map(|e| e.message).unwrap_or_default();
    assert!(why.contains("another recording is running"), "{why}");
    drop(recording);
    let record = Recording::begin(context.gl()).unwrap_or_else(|e| panic!("{e}")).finish();
    assert!(record.draws.is_empty() && record.texture_units >= 16, "{record:?}");
}

fn pixel(thumbnail: &Thumbnail, x: u32, y: u32) -> [i32; 4] {
    let at = 4 * (y * thumbnail.width + x) as usize;
    [0, 1, 2, 3].map(|c| i32::from(thumbnail.rgba[at + c]))
}

#[test]
fn thumbnails_show_the_textures() {
    for es in [false, true] {
        let context = super::context(es);
        let mut renderer = renderer(&context);
        let (_, mut scene) = everything().swap_remove(3);
        // A colour for each side: the direction's signs.
        let sides = |d: DVec3| DVec3::new(f64::from(d.x > 0.5), f64::from(d.y > 0.5), f64::from(d.z > 0.5));
        scene.environment = Some(Arc::new(LoadedEnvironment::new("sides", Cubemap::from_function(32, sides))));
        scene.settings.environment = Some(EnvironmentSettings { light: false, ..EnvironmentSettings::default() });
        let uploaded = renderer.upload(&scene).unwrap_or_else(|e| panic!("{e}"));
        let record = renderer.record_with_thumbnails(&uploaded, &scene.frame(0.0), None);
        let record = record.unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(lint(&record).iter().filter(|f| f.severity == Severity::Error).count(), 0);
        let find = |name: &str| {
            let texture = record.textures.iter().find(|t| t.name == name).unwrap_or_else(|| panic!("no {name}"));
            (texture, texture.thumbnail.as_ref().unwrap_or_else(|| panic!("no thumbnail of {name}")))
        };
        let (cube, cross) = find("environment sides");
        assert_eq!((cube.kind.as_str(), cross.width, cross.height), ("cube", 64, 48));
        // The middles of the faces: +y above; -x, +z, +x, -z; -y below; nothing in the corners.
        let (red, green, blue, black) = ([255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [0, 0, 0, 255]);
        for (x, y, expected) in [
            (24, 8, green),
            (8, 24, black),
            (24, 24, blue),
            (40, 24, red),
            (56, 24, black),
            (24, 40, black),
            (4, 4, [0; 4]),
        ] {
            assert_eq!(pixel(cross, x, y), expected, "{x}, {y}, es {es}");
        }
        for texture in &scene.textures {
            let (found, thumbnail) = find(&texture.name);
            assert!(thumbnail.width.max(thumbnail.height) <= Thumbnail::MOST);
            let is_data = found.content == TexelEncoding::SignedHalves;
            assert_eq!(is_data, texture.color_space == gonio_scene::ColorSpace::Data, "{}", texture.name);
            // Upper left quarter, right way up: the mean of its texels.
            let mean = |rgba: &[u8], width: u32, height: u32| {
                let mut sum = [0.0; 3];
                for y in 0..height / 2 {
                    for x in 0..width / 2 {
                        let at = 4 * (y * width + x) as usize;
                        (0..3).for_each(|c| sum[c] += f64::from(rgba[at + c]));
                    }
                }
                sum.map(|s| s / f64::from((width / 2) * (height / 2)))
            };
            let expected = mean(&texture.rgba, texture.width, texture.height);
            let got = mean(&thumbnail.rgba, thumbnail.width, thumbnail.height);
            for c in 0..3 {
                // Means of encoded numbers, and thumbnails average linear light: fine patterns come out brighter.
                assert!((expected[c] - got[c]).abs() < 24.0, "{}: {expected:?} and {got:?}, es {es}", texture.name);
            }
        }
    }
}
