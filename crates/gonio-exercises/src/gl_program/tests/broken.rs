//! Each mistake in a program of its own, named with its line; and several mistakes together.

use super::{assert_mistakes, changed, context, host_programs, judged};
use gonio_check::verdict::Outcome;

const IMAGE: &str = "tex_image_2d TEXTURE_2D 0 RGB8 pixels\n";
const MIPMAP: &str = "generate_mipmap TEXTURE_2D\n";
const DRAW: &str = "draw_arrays TRIANGLES 0 3\n";
const SET: &str = "uniform_1i ourTexture 0\n";
const BIND: &str = "bind_texture TEXTURE_2D texture\n";
const AT_DRAW: &str = "uniform_1i ourTexture 0\nbind_vertex_array array\n";

#[test]
fn samplers_and_units() {
    let context = context();
    let unit_1 = [("active_texture TEXTURE0", "active_texture TEXTURE1")];
    assert_mistakes(
        &context,
        &changed(&[
            unit_1[0],
            (SET, "uniform_1i ourTexture texture # its name\n"),
            (BIND, "t = gen_texture\nbind_texture TEXTURE_2D t\n"),
            ("texture = gen_texture", "other = gen_texture\ntexture = gen_texture"),
        ]),
        &[("texture-name-as-unit", "# its name")],
    );
    assert_mistakes(&context, &changed(&unit_1), &[("unbound-unit", "uniform_1i")]);
    assert_mistakes(&context, &changed(&[unit_1[0], (SET, "")]), &[("sampler-never-set", "use_program")]);
    assert_mistakes(
        &context,
        &changed(&[unit_1[0], (SET, ""), (IMAGE, "uniform_1i ourTexture 1\ntex_image_2d TEXTURE_2D 0 RGB8 pixels\n")]),
        &[("uniform-before-use-program", "uniform_1i")],
    );
    assert_mistakes(
        &context,
        &changed(&[unit_1[0], (SET, ""), (DRAW, "draw_arrays TRIANGLES 0 3\nuniform_1i ourTexture 1\n")]),
        &[("uniform-after-draw", "uniform_1i")],
    );
    assert_mistakes(
        &context,
        &changed(&[unit_1[0], (SET, "uniform_1i texture1 1\n")]),
        &[("uniform-name-wrong", "uniform_1i")],
    );
    assert_mistakes(
        &context,
        &changed(&[unit_1[0], (SET, "uniform_1f ourTexture 1\n")]),
        &[("uniform-type-wrong", "uniform_1f")],
    );
    assert_mistakes(
        &context,
        &changed(&[
            ("active_texture TEXTURE0\n", ""),
            (BIND, "bind_texture TEXTURE_2D texture\nactive_texture TEXTURE1\n"),
            (SET, "uniform_1i ourTexture 1\n"),
        ]),
        &[("active-texture-after-bind", "active_texture")],
    );
    assert_mistakes(
        &context,
        &changed(&[("active_texture TEXTURE0", "active_texture 1"), (SET, "uniform_1i ourTexture 1\n")]),
        &[("active-texture-number", "active_texture")],
    );
}

#[test]
fn textures_that_lack_something() {
    let context = context();
    assert_mistakes(&context, &changed(&[(MIPMAP, "")]), &[("mipmaps-missing", "tex_image_2d")]);
    let filter = "tex_parameter TEXTURE_2D TEXTURE_MIN_FILTER LINEAR_MIPMAP_LINEAR\n";
    assert_mistakes(&context, &changed(&[(MIPMAP, ""), (filter, "")]), &[("filter-never-set", "tex_image_2d")]);
    assert_mistakes(
        &context,
        &changed(&[
            (MIPMAP, ""),
            (filter, "tex_parameter TEXTURE_2D TEXTURE_MAG_FILTER LINEAR_MIPMAP_LINEAR # here\n"),
            ("tex_parameter TEXTURE_2D TEXTURE_MAG_FILTER LINEAR\n", ""),
            (IMAGE, "tex_image_2d TEXTURE_2D 0 RGB8 pixels # there\n"),
        ]),
        &[("filter-never-set", "# there")],
    );
    let before = [(MIPMAP, ""), (IMAGE, "generate_mipmap TEXTURE_2D\ntex_image_2d TEXTURE_2D 0 RGB8 pixels\n")];
    assert_mistakes(&context, &changed(&before), &[("mipmaps-before-image", "generate_mipmap")]);
    let elsewhere = [(MIPMAP, "active_texture TEXTURE3\ngenerate_mipmap TEXTURE_2D\n")];
    assert_mistakes(&context, &changed(&elsewhere), &[("mipmaps-misplaced", "generate_mipmap")]);
    assert_mistakes(
        &context,
        &changed(&[(MIPMAP, "generate_mipmap TEXTURE_CUBE_MAP\n")]),
        &[("wrong-target", "CUBE_MAP")],
    );
    assert_mistakes(&context, &changed(&[(IMAGE, "")]), &[("image-missing", "bind_texture")]);
    assert_mistakes(
        &context,
        &changed(&[(IMAGE, "tex_image_2d TEXTURE_2D 1 RGB8 pixels\n")]),
        &[("image-level-wrong", "tex_image_2d")],
    );
    for format in ["R8", "SRGB8"] {
        let text = changed(&[("0 RGB8 pixels", &format!("0 {format} pixels"))]);
        assert_mistakes(&context, &text, &[("internal-format-wrong", "tex_image_2d")]);
    }
    assert_mistakes(&context, &changed(&[("checker.png", "planks.png")]), &[("image-wrong", "load_image")]);
    assert_mistakes(
        &context,
        &changed(&[(IMAGE, "tex_image_2d TEXTURE_2D 0 RGB8 pixels\ntex_parameter TEXTURE_2D TEXTURE_BASE_LEVEL 20\n")]),
        &[("level-range-wrong", "BASE_LEVEL")],
    );
}

#[test]
fn filters() {
    let context = context();
    assert_mistakes(
        &context,
        &changed(&[(MIPMAP, ""), ("TEXTURE_MIN_FILTER LINEAR_MIPMAP_LINEAR", "TEXTURE_MIN_FILTER REPEAT")]),
        &[("filter-refused", "TEXTURE_MIN_FILTER REPEAT")],
    );
}

#[test]
fn textures_that_are_not_bound() {
    let context = context();
    assert_mistakes(&context, &changed(&[(BIND, "")]), &[("texture-not-bound", "gen_texture")]);
    assert_mistakes(
        &context,
        &changed(&[(BIND, ""), (MIPMAP, "generate_mipmap TEXTURE_2D\nbind_texture TEXTURE_2D texture\n")]),
        &[("texture-bound-late", "bind_texture")],
    );
    assert_mistakes(
        &context,
        &changed(&[(SET, "uniform_1i ourTexture 0\nbind_texture TEXTURE_2D 0\n")]),
        &[("texture-unbound", "bind_texture TEXTURE_2D 0")],
    );
    assert_mistakes(
        &context,
        &changed(&[(SET, "uniform_1i ourTexture 0\ndelete_texture texture\n")]),
        &[("texture-deleted", "delete_texture")],
    );
    // The second texture was meant for unit 1, which is never made active.
    let second = "generate_mipmap TEXTURE_2D\nplanks = load_image planks.png\nwood = gen_texture\n\
        bind_texture TEXTURE_2D wood\ntex_image_2d TEXTURE_2D 0 RGB8 planks\ngenerate_mipmap TEXTURE_2D\n";
    assert_mistakes(
        &context,
        &changed(&[(MIPMAP, second)]),
        &[("other-texture-bound", "bind_texture TEXTURE_2D wood")],
    );
    assert_mistakes(
        &context,
        &changed(&[(BIND, "bind_texture TEXTURE_CUBE_MAP texture\n")]),
        &[("wrong-target", "TEXTURE_CUBE_MAP")],
    );
}

#[test]
fn attributes() {
    let context = context();
    for (old, new, id) in [
        ("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE 0 0", "stride-wrong"),
        ("tex_coord 2 FLOAT FALSE 32 24", "tex_coord 2 FLOAT FALSE 8 24", "stride-wrong"),
        ("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE 3200 0", "stride-wrong"),
        ("color 3 FLOAT FALSE 32 12", "color 3 FLOAT FALSE 32 3", "offset-wrong"),
        ("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE 32 24", "offset-wrong"),
        ("tex_coord 2 FLOAT FALSE 32 24", "tex_coord 1 FLOAT FALSE 32 24", "attribute-size-wrong"),
        ("position 3 FLOAT FALSE 32 0", "position 1 FLOAT FALSE 32 0", "attribute-size-wrong"),
        ("position 3 FLOAT FALSE 32 0", "position 3 INT FALSE 32 0", "attribute-type-wrong"),
        ("vertex_attrib_pointer tex_coord", "vertex_attrib_pointer texcoord", "attribute-name-wrong"),
        ("enable_vertex_attrib_array color", "enable_vertex_attrib_array colour", "attribute-name-wrong"),
        ("enable_vertex_attrib_array color", "enable_vertex_attrib_array position", "attribute-not-enabled"),
    ] {
        let text = changed(&[(old, new)]);
        let at = if id == "attribute-not-enabled" { "vertex_attrib_pointer color" } else { new };
        assert_mistakes(&context, &text, &[(id, at)]);
    }
    let none = [
        ("enable_vertex_attrib_array position\n", ""),
        ("enable_vertex_attrib_array color\n", ""),
        ("enable_vertex_attrib_array tex_coord\n", ""),
    ];
    assert_mistakes(&context, &changed(&none), &[("attribute-not-enabled", "vertex_attrib_pointer position")]);
    let off = (AT_DRAW, "uniform_1i ourTexture 0\nbind_vertex_array array\ndisable_vertex_attrib_array color\n");
    assert_mistakes(&context, &changed(&[off]), &[("attribute-disabled", "disable_vertex")]);
    assert_mistakes(
        &context,
        &changed(&[("vertex_attrib_pointer color 3 FLOAT FALSE 32 12\n", "")]),
        &[("attribute-not-described", "enable_vertex_attrib_array color")],
    );
}

#[test]
fn vertex_arrays_and_buffers() {
    let context = context();
    let first_bind = ("bind_vertex_array array\nbuffer", "buffer");
    assert_mistakes(&context, &changed(&[first_bind]), &[("vertex-array-bound-late", "bind_vertex_array")]);
    let none = [first_bind, ("\nbind_vertex_array array\n", "\n")];
    assert_mistakes(&context, &changed(&none), &[("vertex-array-not-bound", "gen_vertex_array")]);
    let missing = [none[0], none[1], ("array = gen_vertex_array\n", "")];
    assert_mistakes(&context, &changed(&missing), &[("vertex-array-missing", "vertex_attrib_pointer position")]);
    assert_mistakes(
        &context,
        &changed(&[(AT_DRAW, "uniform_1i ourTexture 0\nbind_vertex_array 0\n")]),
        &[("vertex-array-unbound", "bind_vertex_array 0")],
    );
    assert_mistakes(
        &context,
        &changed(&[(AT_DRAW, "uniform_1i ourTexture 0\nempty = gen_vertex_array\nbind_vertex_array empty\n")]),
        &[("other-vertex-array", "bind_vertex_array empty")],
    );
    assert_mistakes(
        &context,
        &changed(&[("bind_buffer ARRAY_BUFFER buffer\n", "")]),
        &[("buffer-not-bound", "gen_buffer")],
    );
    let data = "bind_buffer ARRAY_BUFFER buffer\nbuffer_data ARRAY_BUFFER corners STATIC_DRAW\n";
    assert_mistakes(
        &context,
        &changed(&[(data, "buffer_data ARRAY_BUFFER corners STATIC_DRAW\nbind_buffer ARRAY_BUFFER buffer\n")]),
        &[("buffer-bound-late", "bind_buffer")],
    );
    let unbound = "buffer_data ARRAY_BUFFER corners STATIC_DRAW\nbind_buffer ARRAY_BUFFER 0\n";
    assert_mistakes(
        &context,
        &changed(&[("buffer_data ARRAY_BUFFER corners STATIC_DRAW\n", unbound)]),
        &[("buffer-unbound", "bind_buffer ARRAY_BUFFER 0")],
    );
    assert_mistakes(
        &context,
        &changed(&[
            ("bind_buffer ARRAY", "bind_buffer ELEMENT_ARRAY"),
            ("buffer_data ARRAY", "buffer_data ELEMENT_ARRAY"),
        ]),
        &[("buffer-target-wrong", "bind_buffer")],
    );
    assert_mistakes(
        &context,
        &changed(&[("buffer_data ARRAY_BUFFER corners STATIC_DRAW\n", "")]),
        &[("buffer-empty", "bind_buffer")],
    );
    assert_mistakes(
        &context,
        &changed(&[(AT_DRAW, "uniform_1i ourTexture 0\nbind_vertex_array array\ndelete_buffer buffer\n")]),
        &[("buffer-deleted", "delete_buffer")],
    );
    assert_mistakes(
        &context,
        &changed(&[("-0.6  -0.6   0.0  ", "-0.6  -0.9   0.0  ")]),
        &[("data-changed", "data corners")],
    );
    let list = format!("data other\n{}\nend\nprogram = create_program", "0.5 ".repeat(24));
    assert_mistakes(
        &context,
        &changed(&[("program = create_program", &list), ("ARRAY_BUFFER corners", "ARRAY_BUFFER other")]),
        &[("other-data", "buffer_data")],
    );
    assert_mistakes(
        &context,
        &changed(&[(DRAW, "delete_vertex_array array\ndraw_arrays TRIANGLES 0 3\n")]),
        &[("vertex-array-deleted", "delete_vertex_array")],
    );
}

/// The reference drawn with indices.
fn indexed(numbers: &str, draw: &str) -> String {
    let list = format!("array = gen_vertex_array\nindices order\n{numbers}\nend\n");
    let bound = "bind_vertex_array array\nelements = gen_buffer\nbind_buffer ELEMENT_ARRAY_BUFFER elements\n\
        buffer_data ELEMENT_ARRAY_BUFFER order STATIC_DRAW\nbuffer = gen_buffer";
    changed(&[
        ("array = gen_vertex_array\n", &list),
        ("bind_vertex_array array\nbuffer = gen_buffer", bound),
        (DRAW, &format!("{draw}\n")),
    ])
}

#[test]
fn indices() {
    let context = context();
    let draw = "draw_elements TRIANGLES 3 UNSIGNED_INT 0";
    assert_mistakes(&context, &indexed("1 2 3", draw), &[("indices-from-one", "indices order")]);
    assert_mistakes(&context, &indexed("0 1 1", draw), &[("indices-changed", "indices order")]);
    for (wrong, id) in [
        ("draw_elements TRIANGLES 3 UNSIGNED_SHORT 0", "index-type-wrong"),
        ("draw_elements TRIANGLES 3 FLOAT 0", "index-type-wrong"),
        ("draw_elements TRIANGLES 3 UNSIGNED_INT 4", "index-offset-wrong"),
        ("draw_elements TRIANGLES 1 UNSIGNED_INT 0", "draw-count-wrong"),
        ("draw_elements POINTS 3 UNSIGNED_INT 0", "draw-mode-wrong"),
    ] {
        assert_mistakes(&context, &indexed("0 1 2", wrong), &[(id, "draw_elements")]);
    }
    let unbound = indexed("0 1 2", &format!("bind_buffer ELEMENT_ARRAY_BUFFER 0\n{draw}"));
    assert_mistakes(&context, &unbound, &[("index-buffer-not-bound", "ELEMENT_ARRAY_BUFFER 0")]);
    assert_mistakes(
        &context,
        &indexed("0 2 1", &format!("enable CULL_FACE\n{draw}")),
        &[("culled", "enable CULL_FACE")],
    );
}

#[test]
fn programs_draws_and_the_background() {
    let context = context();
    assert_mistakes(&context, &changed(&[("use_program program\n", "")]), &[("program-not-used", "create_program")]);
    assert_mistakes(
        &context,
        &changed(&[(SET, "uniform_1i ourTexture 0\nuse_program 0\n")]),
        &[("program-switched-off", "use_program 0")],
    );
    assert_mistakes(
        &context,
        &changed(&[("use_program program", "use_program 1")]),
        &[("program-number-wrong", "use_program")],
    );
    assert_mistakes(
        &context,
        &changed(&[(DRAW, ""), (AT_DRAW, "uniform_1i ourTexture 0\nbind_vertex_array array # last\n")]),
        &[("draw-missing", "# last")],
    );
    for (draw, id) in [
        ("draw_arrays TRIANGLES 0 1", "draw-count-wrong"),
        ("draw_arrays TRIANGLES 0 24", "draw-count-wrong"),
        ("draw_arrays TRIANGLES 1 3", "draw-first-wrong"),
        ("draw_arrays POINTS 0 3", "draw-mode-wrong"),
    ] {
        assert_mistakes(&context, &changed(&[("draw_arrays TRIANGLES 0 3", draw)]), &[(id, draw)]);
    }
    let early = "array = gen_vertex_array\ndraw_arrays TRIANGLES 0 3\n";
    assert_mistakes(
        &context,
        &changed(&[(DRAW, ""), ("array = gen_vertex_array\n", early)]),
        &[("draw-too-early", "draw_arrays")],
    );
    for viewport in ["0 0 0 0", "0 0 128 128", "256 0 256 256"] {
        let text = changed(&[("clear COLOR_BUFFER_BIT\n", &format!("clear COLOR_BUFFER_BIT\nviewport {viewport}\n"))]);
        assert_mistakes(&context, &text, &[("viewport-wrong", "viewport")]);
    }
    assert_mistakes(
        &context,
        &changed(&[("clear COLOR_BUFFER_BIT\n", ""), (DRAW, "draw_arrays TRIANGLES 0 3\nclear COLOR_BUFFER_BIT\n")]),
        &[("clear-after-draw", "clear COLOR_BUFFER_BIT")],
    );
    assert_mistakes(&context, &changed(&[("clear COLOR_BUFFER_BIT\n", "")]), &[("clear-missing", "draw_arrays")]);
    assert_mistakes(
        &context,
        &changed(&[
            ("clear_color 0.2 0.25 0.3 1.0\n", ""),
            ("clear COLOR_BUFFER_BIT\n", "clear COLOR_BUFFER_BIT\nclear_color 0.2 0.25 0.3 1.0\n"),
        ]),
        &[("clear-color-late", "clear_color")],
    );
    assert_mistakes(&context, &changed(&[("0.2 0.25 0.3 1.0", "1 0 0 1")]), &[("clear-color-wrong", "clear_color")]);
}

#[test]
fn several_mistakes_in_one_program() {
    let context = context();
    assert_mistakes(
        &context,
        &changed(&[(MIPMAP, ""), (SET, "uniform_1i ourTexture texture\n")]),
        &[("mipmaps-missing", "tex_image_2d"), ("texture-name-as-unit", "uniform_1i")],
    );
    assert_mistakes(
        &context,
        &changed(&[
            ("tex_coord 2 FLOAT FALSE 32 24", "tex_coord 2 FLOAT FALSE 32 12"),
            (SET, "uniform_1i ourTexture 5\n"),
        ]),
        &[("offset-wrong", "tex_coord 2"), ("unbound-unit", "uniform_1i")],
    );
    assert_mistakes(
        &context,
        &changed(&[("enable_vertex_attrib_array position\n", ""), (SET, "uniform_1i ourTexture 5\n"), (MIPMAP, "")]),
        &[
            ("attribute-not-enabled", "vertex_attrib_pointer position"),
            ("mipmaps-missing", "tex_image_2d"),
            ("unbound-unit", "uniform_1i"),
        ],
    );
}

#[test]
fn unexplained_pictures_get_no_name() {
    // Another shape altogether, drawn twice.
    let context = context();
    let text = changed(&[
        ("0.5  1.0\nend", "0.5  1.0\n -0.9 0.9 0 1 1 1 0 0 0.9 0.9 0 1 1 1 1 0 0.9 0.8 0 1 1 1 1 1\nend"),
        ("0.0   0.6   0.0 ", "0.3   0.1   0.0 "),
        (DRAW, "draw_arrays TRIANGLE_FAN 0 6\ndraw_arrays LINE_LOOP 0 6\n"),
        ("0.2 0.25 0.3 1.0", "1 0 0 1"),
        ("checker.png", "tiles.png"),
    ]);
    let verdict = judged(&context, &text);
    assert_eq!((verdict.verdict, verdict.mistakes.len()), (Outcome::Wrong, 0), "{}", verdict.summary);
    assert!(verdict.summary.contains("no known mistake"), "{}", verdict.summary);
}

/// Each program, and the line of its mistake.
const PROGRAMS: [(&str, u32); 8] = [
    ("attribute-not-enabled", 24),
    ("mipmaps-missing", 36),
    ("offset-wrong", 24),
    ("stride-wrong", 20),
    ("texture-name-as-unit", 43),
    ("unbound-unit", 43),
    ("uniform-before-use-program", 14),
    ("wrong-target", 31),
];

#[test]
fn each_program_of_the_exercise_has_the_mistake_that_its_name_says() {
    let context = context();
    let mut texts = host_programs();
    texts.retain(|(name, _)| name != "reference");
    texts.sort();
    assert_eq!(texts.len(), PROGRAMS.len());
    for ((name, line), (file, text)) in PROGRAMS.into_iter().zip(texts) {
        assert_eq!(name, file);
        let verdict = judged(&context, &text);
        assert_eq!(verdict.verdict, Outcome::Wrong, "{name}");
        let found: Vec<_> = verdict.mistakes.iter().map(|m| (m.id.as_str(), m.line)).collect();
        assert_eq!(found, [(name, line)], "{name}: {}", verdict.summary);
        assert!(!verdict.findings.is_empty(), "{name}: the frame panel shows nothing");
        assert_eq!(text.lines().nth(line as usize - 1), Some(verdict.mistakes[0].quoted.as_str()));
    }
}
