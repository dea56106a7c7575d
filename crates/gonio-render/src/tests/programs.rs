//! Compilation of all programs, and programs of users.

use super::context;
use crate::glsl::{
    ATTRIBUTES, LightLoops, MapSet, OutputKey, Reflectance, SceneKey, SpecialProgram, SurroundingsKey, sky_sources,
};
use crate::user_program::{Stream, StreamMesh, UserProgram};
use crate::{DisplayTexture, Renderer};
use gonio_gl::program::Program;
use gonio_gl::{Dialect, Gl};
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
    // and one with colours of vertices and one with shadows; those that write displayed colours, without views; and 2 + 4 tone maps x 2 encodings, of one sample, of grids, and of multisampled
    // textures where there are any. With an environment 13 ways to show it, for 2 kinds of materials; and the sky,
    // and ten programs of overlays, special views, shadow maps, the ground and outlines.
    let outputs = if es { 20 } else { 30 };
    assert_eq!(programs.len(), 5 * 8 * 3 * 2 * (2 * (3 + 2) + 1) + 5 * 2 * 2 * 13 + 1 + 10 + outputs);
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
                shadows: lights != LightLoops::Unrolled([0, 0, 0]),
                surroundings,
                display: None,
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

const BODY: [&str; 2] = [
    "in vec2 place;\nvoid main() { gl_Position = vec4(place, 1.0, 1.0); }\n",
    // No alpha, and more light than can be shown.
    "precision highp float;\nout vec4 color;\nvoid main() { color = vec4(2.0, 0.5, 0.0, 0.0); }\n",
];

/// A square from the middle to the upper right corner of the viewport, at the farthest depth.
fn quarter(gl: &Gl, es: bool) -> (UserProgram, StreamMesh) {
    let version = if es { "#version 300 es\n" } else { "#version 330 core\n" };
    let [vertex, fragment] = BODY.map(|body| format!("{version}{body}"));
    let program = UserProgram::new(gl, &vertex, &fragment).unwrap_or_else(|error| panic!("{error}"));
    let numbers = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let streams = [Stream { name: "place", components: 2, numbers: &numbers }];
    let mesh = StreamMesh::new(gl, &streams, &[0, 1, 2, 0, 2, 3], "quarter").unwrap_or_else(|error| panic!("{error}"));
    (program, mesh)
}

#[test]
fn a_foreign_picture_is_the_middle_of_a_square_and_as_its_numbers_say() {
    for es in [false, true] {
        let context = context(es);
        let gl = context.gl();
        let mut renderer = Renderer::new(gl.clone()).unwrap_or_else(|error| panic!("{error}"));
        let (program, mesh) = quarter(gl, es);
        let location = program.attribute_location("place").unwrap_or_else(|| panic!("no attribute"));
        let mut canvas = DisplayTexture::new(gl, [1, 1]).unwrap_or_else(|error| panic!("{error}"));
        for [width, height] in [[40_u32, 20], [20, 40], [16, 16]] {
            let painted = renderer.paint_user_program(&mut canvas, [width, height], [0.0, 0.0, 1.0], || {
                program.bind();
                mesh.draw(&program, &[(location, 0)]);
            });
            painted.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(canvas.size(), [width, height]);
            let pixels = canvas.read8();
            for (index, pixel) in pixels.chunks_exact(4).enumerate() {
                let (x, y) = (index as u32 % width, index as u32 / width);
                let inside = x >= width / 2 && y < height / 2;
                // 0.5 is between two steps of 8 bits.
                let expected = if inside { [255, pixel[1].clamp(127, 128), 0, 255] } else { [0, 0, 255, 255] };
                assert_eq!(pixel, expected, "es {es}, {width} x {height}: {x}, {y}");
            }
        }
    }
}
