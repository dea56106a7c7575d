//! Every program that the renderer can ask for compiles and links, in both dialects.

use crate::glsl::{
    ATTRIBUTES, LightLoops, MapSet, OutputKey, Reflectance, SceneKey, SpecialProgram, SurroundingsKey, sky_sources,
};
use gonio_gl::Dialect;
use gonio_gl::program::Program;
use gonio_light::Specular;
use gonio_scene::scene_file::Shading;

fn link_all(dialect: Dialect, es: bool) {
    let context = super::context(es);
    let scenes = SceneKey::all().into_iter().map(|k| (k.name(), k.sources(dialect)));
    let outputs = OutputKey::all(dialect).into_iter().map(|k| (format!("{k:?}"), k.sources(dialect)));
    let sky = ("sky".to_owned(), sky_sources(dialect));
    let special = SpecialProgram::ALL.map(|p| (p.name().to_owned(), p.sources(dialect)));
    let programs: Vec<_> = scenes.chain(outputs).chain([sky]).chain(special).collect();
    // 4 shadings (and Phong with a normal map) x 8 reflectances x 3 sets of maps x sides x views x 3 kinds of loops
    // and one with colours of vertices; and 2 + 4 tone maps x 2 encodings, of one sample, of grids, and of multisampled
    // textures where there are any. With an environment 13 ways to show it, for 2 kinds of materials; and the sky,
    // and five programs of overlays and special views.
    let outputs = if es { 20 } else { 30 };
    assert_eq!(programs.len(), 5 * 8 * 3 * 2 * 2 * (3 + 1) + 5 * 2 * 2 * 13 + 1 + 5 + outputs);
    for (name, [vertex, fragment]) in programs {
        if let Err(why) = Program::new(context.gl(), &name, &vertex, &fragment, &ATTRIBUTES) {
            panic!("{dialect:?}: {why}");
        }
    }
}

#[test]
fn every_program_links_as_330_core() {
    link_all(Dialect::Core330, false);
}

#[test]
fn every_program_links_as_300_es_in_a_context_of_opengl_es() {
    link_all(Dialect::Es300, true);
}

#[test]
fn every_number_of_very_few_lights_links() {
    let context = super::context(false);
    let loops = LightLoops::all_unrolled();
    // Triples 0 <= d <= p <= s <= 4.
    assert_eq!(loops.len(), 35);
    for lights in loops {
        for shading in [Shading::Gouraud, Shading::Phong] {
            let reflectance = Reflectance::Lab(Specular::Phong);
            let (maps, normal_map, vertex_colors) = (MapSet::None, false, false);
            let (two_sided, view) = (true, true);
            let surroundings = SurroundingsKey::NONE;
            let key = SceneKey {
                shading,
                reflectance,
                maps,
                normal_map,
                vertex_colors,
                two_sided,
                view,
                lights,
                surroundings,
            };
            let [vertex, fragment] = key.sources(Dialect::Core330);
            if let Err(why) = Program::new(context.gl(), &key.name(), &vertex, &fragment, &ATTRIBUTES) {
                panic!("{why}");
            }
        }
    }
}

#[test]
fn a_shader_with_a_mistake_is_an_error_with_the_drivers_log_and_the_source() {
    let context = super::context(false);
    let [vertex, _] = OutputKey::all(Dialect::Core330)[0].sources(Dialect::Core330);
    let fragment = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(missing); }\n";
    let why = Program::new(context.gl(), "broken", &vertex, fragment, &[]).err().expect("it must not compile").message;
    assert!(why.contains("fragment shader of `broken`") && why.contains("missing"), "{why}");
    assert!(why.contains("   3  void main()"), "{why}");
}
