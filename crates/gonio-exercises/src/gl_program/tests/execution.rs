//! The effects of the calls in OpenGL: pictures, errors, records, and the state afterwards.

use super::{REFERENCE, changed, context, host_programs, judged};
use crate::gl_program::{GlProgram, GlProgramOptions, GlProgramRun, exercise_files, for_context, run};
use gonio_check::verdict::Outcome;
use gonio_gl::headless::HeadlessOptions;
use gonio_gl::trace::{Recording, Rule};
use gonio_gl::{Gl, HeadlessContext};
use gonio_render::user_program::FloatTexture;

const OPTIONS: GlProgramOptions = GlProgramOptions { size: [64, 48], float: false, thumbnails: false };

fn drawn(gl: &Gl, text: &str, options: GlProgramOptions) -> GlProgramRun {
    let program = GlProgram::parse(text, "x").unwrap_or_else(|e| panic!("{e:#?}"));
    let files = exercise_files();
    run(gl, &program.steps, &for_context(gl, &files), options).unwrap_or_else(|e| panic!("{e}"))
}

fn middle(run: &GlProgramRun) -> [f32; 4] {
    run.pixels[(run.size[1] / 2 * run.size[0] + run.size[0] / 2) as usize]
}

#[test]
fn the_picture_has_the_background_outside_and_the_texture_inside() {
    let context = context();
    for float in [false, true] {
        let run = drawn(context.gl(), REFERENCE, GlProgramOptions { float, ..OPTIONS });
        assert_eq!((run.size, run.pixels.len()), ([64, 48], 64 * 48));
        let near = |pixel: [f32; 4], right: [f32; 3]| (0..3).all(|i| (pixel[i] - right[i]).abs() < 0.5 / 255.0 + 1e-4);
        assert!(near(run.pixels[0], [0.2, 0.25, 0.3]), "{:?}", run.pixels[0]);
        assert!(!near(middle(&run), [0.2, 0.25, 0.3]) && middle(&run)[0] > 0.05, "{:?}", middle(&run));
        assert_eq!((run.errors.len(), run.findings.len(), run.draw_lines.as_slice()), (0, 0, &[45][..]));
    }
}

#[test]
fn a_texture_name_as_unit_reads_the_unit_of_that_number() {
    let context = context();
    // The second texture has the name 2, and the first one is bound to unit 2.
    let planks = "texture = gen_texture\nother = load_image planks.png\nwood = gen_texture\nactive_texture TEXTURE2\n\
        bind_texture TEXTURE_2D texture\nactive_texture TEXTURE0\n";
    let text =
        changed(&[("texture = gen_texture\nactive_texture TEXTURE0\n", planks), ("ourTexture 0", "ourTexture wood")]);
    let named = drawn(context.gl(), &text, OPTIONS);
    assert_eq!(middle(&named), middle(&drawn(context.gl(), REFERENCE, OPTIONS)));
    assert_eq!(named.record.draws[0].samplers[0].sent, Some(2));
    // A unit without a texture reads as black.
    let black = drawn(context.gl(), &changed(&[("ourTexture 0", "ourTexture texture")]), OPTIONS);
    assert_eq!(middle(&black), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(black.findings.iter().map(|f| f.rule).collect::<Vec<_>>(), [Rule::TextureNameAsUnit]);
}

#[test]
fn rejected_calls_have_their_line_and_are_not_in_the_record() {
    let context = context();
    let bind = "bind_texture TEXTURE_2D texture\nbind_texture TEXTURE_CUBE_MAP texture\ntex_parameter TEXTURE_CUBE_MAP \
        TEXTURE_WRAP_S REPEAT\nenable TEXTURE_2D\n";
    let run = drawn(context.gl(), &changed(&[("bind_texture TEXTURE_2D texture\n", bind)]), OPTIONS);
    let errors: Vec<_> = run.errors.iter().map(|e| (e.line, e.call, e.code.as_str())).collect();
    assert_eq!(
        errors,
        [
            (32, "bind_texture", "INVALID_OPERATION"),
            (33, "tex_parameter", "INVALID_OPERATION"),
            (34, "enable", "INVALID_ENUM")
        ]
    );
    assert!(run.errors[0].why.contains("was first bound to another target"), "{}", run.errors[0]);
    let units: Vec<_> = run.record.draws[0].units.iter().map(|u| (u.unit, u.kind.as_str(), u.texture)).collect();
    assert_eq!(units, [(0, "2D", Some(1))]);
    assert_eq!(run.record.draws[0].errors, ["INVALID_OPERATION", "INVALID_OPERATION", "INVALID_ENUM"]);
    // The errors of the calls before a draw explain it if nothing else does.
    assert_eq!(run.findings.iter().map(|f| f.rule).collect::<Vec<_>>(), [Rule::OpenGlError]);
}

#[test]
fn a_rejected_draw_is_in_the_record_with_all_that_it_would_have_read() {
    let context = context();
    let run = drawn(context.gl(), &changed(&[("TRIANGLES 0 3", "TRIANGLES 0 4")]), OPTIONS);
    assert_eq!(run.errors.iter().map(|e| (e.line, e.code.as_str())).collect::<Vec<_>>(), [(45, "UNDEFINED")]);
    assert_eq!(run.findings.iter().map(|f| f.rule).collect::<Vec<_>>(), [Rule::BeyondBuffer; 3]);
    assert_eq!(run.record.draws[0].count, 4);
    assert_eq!(middle(&run), run.pixels[0], "only the background");
}

#[test]
fn an_unused_attribute_may_reach_beyond_its_buffer() {
    let context = context();
    let mut files = exercise_files();
    let plain = "#version 330 core\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";
    let white = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";
    files.shaders.insert("plain.vert".into(), plain.into());
    files.shaders.insert("white.frag".into(), white.into());
    // Described and enabled for the first program; the second one draws without it.
    let text = changed(&[
        ("color 3 FLOAT FALSE 32 12", "color 3 FLOAT FALSE 1600 12"),
        ("use_program program\n", "white = create_program plain.vert white.frag\nuse_program white\n"),
    ]);
    let program = GlProgram::parse(&text, "x").unwrap_or_else(|e| panic!("{e:#?}"));
    let run = run(context.gl(), &program.steps, &files, OPTIONS).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((middle(&run), run.errors.len()), ([1.0; 4], 0), "{:?}", run.errors);
}

#[test]
fn other_objects_in_the_context_change_nothing_and_none_are_left() {
    let context = context();
    let gl = context.gl();
    let alone = drawn(gl, REFERENCE, OPTIONS);
    let others: Vec<_> = (0..5)
        .map(|_| FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "other").unwrap_or_else(|e| panic!("{e}")))
        .collect();
    let name = changed(&[("ourTexture 0", "ourTexture texture")]);
    let crowded = drawn(gl, &name, OPTIONS);
    assert_eq!(crowded.record.draws[0].samplers[0].sent, Some(1), "its own first texture is 1");
    assert_eq!(crowded.record.textures.len(), 1, "only its own");
    assert_eq!(drawn(gl, REFERENCE, OPTIONS).pixels, alone.pixels);
    let recording = Recording::begin(gl).unwrap_or_else(|e| panic!("{e}"));
    let record = recording.finish();
    assert_eq!(record.textures.len(), others.len(), "{:?}", record.textures);
    assert_eq!(record.notes, Vec::<String>::new());
}

#[test]
fn the_same_verdicts_in_opengl_es() {
    let es = HeadlessContext::with_options(&HeadlessOptions { es: true, ..Default::default() });
    let es = es.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(judged(&es, REFERENCE).verdict, Outcome::Correct);
    let srgb = changed(&[("0 RGB8 pixels", "0 SRGB8 pixels")]);
    assert_eq!(judged(&es, &srgb).mistakes[0].id, "internal-format-wrong");
    let desktop = context();
    let programs = host_programs();
    assert_eq!(programs.len(), 9);
    for (_, text) in programs {
        let [a, b] = [judged(&es, &text), judged(&desktop, &text)];
        assert_eq!((a.verdict, &a.mistakes, &a.refused), (b.verdict, &b.mistakes, &b.refused), "{text}");
    }
}
