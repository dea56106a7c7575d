//! Programs that are right in another way: none may fail.

use super::{REFERENCE, changed, context, judged};
use gonio_check::verdict::Outcome;
use gonio_gl::HeadlessContext;

const IMAGE: &str = "tex_image_2d TEXTURE_2D 0 RGB8 pixels\n";
const MIPMAP: &str = "generate_mipmap TEXTURE_2D\n";
const DRAW: &str = "draw_arrays TRIANGLES 0 3\n";
const SET: &str = "uniform_1i ourTexture 0\n";
const MIN: &str = "TEXTURE_MIN_FILTER LINEAR_MIPMAP_LINEAR";

/// Asserts that a text is right, with this number of warnings.
fn right(context: &HeadlessContext, text: &str, warnings: usize) {
    let verdict = judged(context, text);
    assert_eq!(verdict.verdict, Outcome::Correct, "{text}\n{}: {:#?}", verdict.summary, verdict.mistakes);
    assert_eq!(verdict.warnings.len(), warnings, "{text}\n{:#?}", verdict.warnings);
    assert!(verdict.mistakes.is_empty());
}

#[test]
fn the_reference_is_right_without_findings() {
    let verdict = judged(&context(), REFERENCE);
    assert_eq!(verdict.verdict, Outcome::Correct);
    assert_eq!((verdict.share_right, verdict.warnings.len(), verdict.findings.len()), (1.0, 0, 0));
    assert!(verdict.refused.is_empty() && verdict.mistakes.is_empty() && verdict.errors.is_empty());
    let run = verdict.run.unwrap_or_else(|| panic!("expected a picture"));
    let texture = run.record.texture(1).unwrap_or_else(|| panic!("{:?}", run.record.textures));
    assert_eq!((texture.name.as_str(), texture.width, texture.levels.len()), ("texture", 512, 10));
    assert!(texture.thumbnail.is_some(), "for the frame panel");
    assert_eq!(run.record.passes[0].target.name, "window");
}

#[test]
fn other_units() {
    let context = context();
    let unit = |unit: u32| {
        changed(&[
            ("active_texture TEXTURE0", &format!("active_texture TEXTURE{unit}")),
            (SET, &format!("uniform_1i ourTexture {unit}\n")),
        ])
    };
    for number in [1, 3, 15] {
        right(&context, &unit(number), 0);
    }
    // Unit 0 is active from the start.
    right(&context, &changed(&[("active_texture TEXTURE0\n", "")]), 0);
    // Another unit is active at the draw.
    right(&context, &changed(&[(SET, "uniform_1i ourTexture 0\nactive_texture TEXTURE7\n")]), 0);
    // Set twice: the last value counts.
    right(&context, &changed(&[(SET, "uniform_1i ourTexture 5\nuniform_1i ourTexture 0\n")]), 0);
    // Bound to several units.
    let twice = "generate_mipmap TEXTURE_2D\nactive_texture TEXTURE4\nbind_texture TEXTURE_2D texture\n";
    right(&context, &changed(&[(MIPMAP, twice), (SET, "uniform_1i ourTexture 4\n")]), 0);
}

#[test]
fn a_sampler_that_is_never_set_is_right_by_luck() {
    let context = context();
    right(&context, &changed(&[(SET, "")]), 1);
    let verdict = judged(&context, &changed(&[(SET, "")]));
    assert!(verdict.warnings[0].text.contains("was never set and reads unit 0 by default"), "{:?}", verdict.warnings);
}

#[test]
fn another_order() {
    let context = context();
    // The uniform long before the draw, with the program in use from the start.
    let early = "program = create_program start.vert start.frag\nuse_program program\nuniform_1i ourTexture 0\n";
    right(
        &context,
        &changed(&[
            ("use_program program\n", ""),
            (SET, ""),
            ("program = create_program start.vert start.frag\n", early),
        ]),
        0,
    );
    // Filters after the image, and the image after the mipmaps of an earlier one.
    let filter = "tex_parameter TEXTURE_2D TEXTURE_MIN_FILTER LINEAR_MIPMAP_LINEAR\n";
    right(&context, &changed(&[(filter, ""), (MIPMAP, &format!("generate_mipmap TEXTURE_2D\n{filter}"))]), 0);
    // Enabled before described.
    let pointer = "vertex_attrib_pointer position 3 FLOAT FALSE 32 0\nenable_vertex_attrib_array position\n";
    let turned = "enable_vertex_attrib_array position\nvertex_attrib_pointer position 3 FLOAT FALSE 32 0\n";
    right(&context, &changed(&[(pointer, turned)]), 0);
    // The buffer filled after the attributes were described.
    let data = "buffer_data ARRAY_BUFFER corners STATIC_DRAW\n";
    right(&context, &changed(&[(data, ""), ("# The texture\n", data)]), 0);
    // Cleared right before the draw.
    right(
        &context,
        &changed(&[("clear COLOR_BUFFER_BIT\n", ""), (DRAW, "clear COLOR_BUFFER_BIT\ndraw_arrays TRIANGLES 0 3\n")]),
        0,
    );
    // Tidied up in the end.
    let tidy = "draw_arrays TRIANGLES 0 3\nbind_vertex_array 0\nbind_buffer ARRAY_BUFFER 0\nbind_texture TEXTURE_2D 0\n\
        use_program 0\ndelete_texture texture\ndelete_buffer buffer\ndelete_vertex_array array\n";
    right(&context, &changed(&[(DRAW, tidy)]), 0);
}

#[test]
fn other_filters_wraps_and_formats() {
    let context = context();
    right(&context, &changed(&[(MIPMAP, ""), (MIN, "TEXTURE_MIN_FILTER LINEAR")]), 0);
    right(&context, &changed(&[(MIPMAP, ""), (MIN, "TEXTURE_MIN_FILTER NEAREST")]), 0);
    right(&context, &changed(&[(MIN, "TEXTURE_MIN_FILTER NEAREST_MIPMAP_NEAREST")]), 0);
    right(&context, &changed(&[("TEXTURE_MAG_FILTER LINEAR", "TEXTURE_MAG_FILTER NEAREST")]), 0);
    for wrap in ["CLAMP_TO_EDGE", "MIRRORED_REPEAT"] {
        let both = [
            ("TEXTURE_WRAP_S REPEAT", format!("TEXTURE_WRAP_S {wrap}")),
            ("TEXTURE_WRAP_T REPEAT", format!("TEXTURE_WRAP_T {wrap}")),
        ];
        right(&context, &changed(&[(both[0].0, &both[0].1), (both[1].0, &both[1].1)]), 0);
    }
    for format in ["RGBA8", "RGB", "RGBA"] {
        right(&context, &changed(&[("0 RGB8 pixels", &format!("0 {format} pixels"))]), 0);
    }
    // Hardly visible here, but dark elsewhere.
    right(&context, &changed(&[("TEXTURE_WRAP_S REPEAT", "TEXTURE_WRAP_S CLAMP_TO_BORDER")]), 1);
    // One level is enough if no other may be read.
    let one = "tex_image_2d TEXTURE_2D 0 RGB8 pixels\ntex_parameter TEXTURE_2D TEXTURE_MAX_LEVEL 0\n";
    right(&context, &changed(&[(IMAGE, one), (MIPMAP, ""), (MIN, "TEXTURE_MIN_FILTER LINEAR")]), 0);
}

#[test]
fn other_vertices() {
    let context = context();
    // A buffer for each attribute.
    let lists = "data places\n-0.6 -0.6 0\n0.6 -0.6 0\n0 0.6 0\nend\ndata colours\n1 0.6 0.5\n0.6 1 0.6\n0.5 0.7 1\nend\n\
        data coordinates\n0 0\n1 0\n0.5 1\nend\nprogram = create_program";
    let apart = |size: u32, name: &str, list: &str| {
        format!(
            "{name}_buffer = gen_buffer\nbind_buffer ARRAY_BUFFER {name}_buffer\n\
             buffer_data ARRAY_BUFFER {list} STATIC_DRAW\nvertex_attrib_pointer {name} {size} FLOAT FALSE 0 0\n"
        )
    };
    right(
        &context,
        &changed(&[
            ("program = create_program", lists),
            ("vertex_attrib_pointer position 3 FLOAT FALSE 32 0\n", &apart(3, "position", "places")),
            ("vertex_attrib_pointer color 3 FLOAT FALSE 32 12\n", &apart(3, "color", "colours")),
            ("vertex_attrib_pointer tex_coord 2 FLOAT FALSE 32 24\n", &apart(2, "tex_coord", "coordinates")),
        ]),
        0,
    );
    // With indices.
    let elements = "draw_elements TRIANGLES 3 UNSIGNED_INT 0\n";
    let order = "indices order\n0 1 2\nend\nprogram = create_program";
    let bound = "bind_vertex_array array\nelements = gen_buffer\nbind_buffer ELEMENT_ARRAY_BUFFER elements\n\
        buffer_data ELEMENT_ARRAY_BUFFER order STATIC_DRAW\nbuffer = gen_buffer";
    let indexed = [
        (DRAW, elements),
        ("program = create_program", order),
        ("bind_vertex_array array\nbuffer = gen_buffer", bound),
    ];
    right(&context, &changed(&indexed), 0);
    // The same triangle as a strip, and without z, which is then 0.
    right(&context, &changed(&[("draw_arrays TRIANGLES", "draw_arrays TRIANGLE_STRIP")]), 0);
    right(&context, &changed(&[("position 3 FLOAT FALSE 32 0", "position 2 FLOAT FALSE 32 0")]), 0);
    // Bound once is enough.
    right(&context, &changed(&[("ourTexture 0\nbind_vertex_array array\n", "ourTexture 0\n")]), 0);
}

#[test]
fn more_than_the_exercise_asks_for() {
    let context = context();
    let second = "generate_mipmap TEXTURE_2D\nplanks = load_image planks.png\nwood = gen_texture\nactive_texture TEXTURE5\n\
        bind_texture TEXTURE_2D wood\ntex_image_2d TEXTURE_2D 0 RGB8 planks\ngenerate_mipmap TEXTURE_2D\n";
    right(&context, &changed(&[(MIPMAP, second)]), 0);
    let tested = [("clear COLOR_BUFFER_BIT", "enable DEPTH_TEST\nclear COLOR_BUFFER_BIT | DEPTH_BUFFER_BIT")];
    right(&context, &changed(&tested), 0);
    right(&context, &changed(&[("clear COLOR_BUFFER_BIT", "enable DEPTH_TEST\nclear COLOR_BUFFER_BIT")]), 1);
    right(&context, &changed(&[(DRAW, "enable CULL_FACE\ndraw_arrays TRIANGLES 0 3\n")]), 0);
    right(&context, &changed(&[(DRAW, "viewport 0 0 256 256\ndraw_arrays TRIANGLES 0 3\n")]), 0);
    right(&context, &changed(&[(DRAW, "draw_arrays TRIANGLES 0 3\ndraw_arrays TRIANGLES 0 3\n")]), 0);
    // Another program besides.
    let two = "other = create_program start.vert start.frag\nprogram = create_program start.vert start.frag\n";
    right(&context, &changed(&[("program = create_program start.vert start.frag\n", two)]), 0);
    // Rejected calls without consequences are reported, but do not count.
    right(&context, &changed(&[(DRAW, "enable TEXTURE_2D\ndraw_arrays TRIANGLES 0 3\n")]), 1);
    right(&context, &changed(&[(DRAW, "uniform_1f now 0.5\ndraw_arrays TRIANGLES 0 3\n")]), 1);
    // Written in another layout.
    let loose = changed(&[(SET, "   uniform_1i\tourTexture   0 # the unit\n")]).replace('\n', "\r\n");
    right(&context, &loose, 0);
}
