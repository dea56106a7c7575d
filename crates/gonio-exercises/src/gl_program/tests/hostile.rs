//! Hostile texts: each soon gives an error or a verdict, and the context still works.

use super::{REFERENCE, changed, context, judged};
use crate::gl_program::{GlProgram, MOST_CALLS, MOST_ERRORS, check_bytes, exercise_files};
use gonio_check::verdict::Outcome;
use std::fmt::Write;

const DRAW: &str = "draw_arrays TRIANGLES 0 3\n";

#[test]
fn files_that_are_not_text() {
    let context = context();
    let files = exercise_files();
    let noise: Vec<u8> = (0..100_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let zeros = vec![0; 1000];
    let utf16: Vec<u8> = REFERENCE.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [&noise, &zeros, &utf16, &Vec::new()] {
        let verdict = check_bytes(context.gl(), bytes, "mine.bin", &files).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(verdict.verdict, Outcome::DoesNotCompile);
        assert!(!verdict.errors.is_empty() && verdict.errors.len() <= MOST_ERRORS);
    }
    let marked = [b"\xEF\xBB\xBF", REFERENCE.as_bytes()].concat();
    let verdict = check_bytes(context.gl(), &marked, "mine.txt", &files).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(verdict.verdict, Outcome::Correct, "a byte order mark is harmless");
}

#[test]
fn texts_that_are_too_large() {
    let message = |text: &str| {
        let errors = GlProgram::parse(text, "x").err().unwrap_or_else(|| panic!("expected an error"));
        assert!(errors.len() <= MOST_ERRORS);
        errors[0].message.clone()
    };
    assert!(message(&"clear COLOR_BUFFER_BIT\n".repeat(500_000)).contains("bytes"), "11 MB");
    assert!(message(&"clear COLOR_BUFFER_BIT\n".repeat(MOST_CALLS + 1)).contains("more than 1000 calls"));
    assert!(GlProgram::parse(&"clear COLOR_BUFFER_BIT\n".repeat(MOST_CALLS), "x").is_ok());
    let endless = format!("data d\n{}", "1 ".repeat(300_000));
    assert!(message(&endless).contains("more than 262144 numbers"), "{}", message(&endless));
    let full = format!("data d\n{}\nend\nclear COLOR_BUFFER_BIT", "1 ".repeat(262_144));
    assert!(GlProgram::parse(&full, "x").is_ok(), "1 MB is allowed");
    // Messages do not repeat a word of a megabyte.
    let long = message(&"a".repeat(1 << 20));
    assert!(long.len() < 200, "{} bytes", long.len());
    let long = message(&format!("clear {}", "É".repeat(1 << 20)));
    assert!(long.len() < 200, "{} bytes", long.len());
    assert_eq!(GlProgram::parse(&"nonsense\n".repeat(100_000), "x").err().map(|e| e.len()), Some(MOST_ERRORS));
}

/// Runs a text, then the reference, which must still draw correctly.
fn survives(text: &str, refused: &str) {
    let context = context();
    let verdict = judged(&context, text);
    let errors: Vec<String> = verdict.refused.iter().map(ToString::to_string).collect();
    assert!(errors.iter().any(|error| error.contains(refused)), "{refused}: {errors:#?}\n{}", verdict.summary);
    let after = judged(&context, REFERENCE);
    assert_eq!((after.verdict, after.share_right), (Outcome::Correct, 1.0), "after\n{text}");
    assert!(after.warnings.is_empty() && after.refused.is_empty(), "{:?}", after.refused);
}

#[test]
fn draws_beyond_the_buffer() {
    for draw in [
        "draw_arrays TRIANGLES 0 4",
        "draw_arrays TRIANGLES 2147483647 2147483647",
        "draw_arrays TRIANGLES 0 2147483647",
    ] {
        survives(&changed(&[(DRAW, &format!("{draw}\n"))]), "UNDEFINED: the attribute `position` would be read up to");
    }
    survives(&changed(&[(DRAW, "draw_arrays TRIANGLES -1 3\n")]), "INVALID_VALUE");
    survives(&changed(&[(DRAW, "draw_arrays TRIANGLES 0 -3\n")]), "INVALID_VALUE");
    survives(&changed(&[(DRAW, "draw_arrays FLOAT 0 3\n")]), "INVALID_ENUM");
    survives(&changed(&[("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE 32 2147483647")]), "UNDEFINED");
    survives(&changed(&[("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE 32 -4")]), "INVALID_VALUE");
    survives(&changed(&[("position 3 FLOAT FALSE 32 0", "position 3 FLOAT FALSE -32 0")]), "INVALID_VALUE");
    survives(&changed(&[("position 3 FLOAT FALSE 32 0", "position 99 FLOAT FALSE 32 0")]), "INVALID_VALUE");
    // No attribute is read: only gonio's own limit stops it.
    let none = [
        ("enable_vertex_attrib_array position\n", ""),
        ("enable_vertex_attrib_array color\n", ""),
        ("enable_vertex_attrib_array tex_coord\n", ""),
        (DRAW, "draw_arrays TRIANGLES 0 2147483647\n"),
    ];
    survives(&changed(&none), "at most 10000 vertices");
}

#[test]
fn indices_beyond_the_buffer() {
    let indexed = |numbers: &str, draw: &str| {
        let list = format!("program = create_program start.vert start.frag\nindices order\n{numbers}\nend\n");
        let bound = "elements = gen_buffer\nbind_buffer ELEMENT_ARRAY_BUFFER elements\n\
            buffer_data ELEMENT_ARRAY_BUFFER order STATIC_DRAW\n";
        changed(&[("program = create_program start.vert start.frag\n", &list), (DRAW, &format!("{bound}{draw}\n"))])
    };
    let draw = "draw_elements TRIANGLES 3 UNSIGNED_INT 0";
    survives(&indexed("0 1 3", draw), "UNDEFINED: the attribute `position` would be read up to byte 108 (vertex 3");
    survives(&indexed("0 1 4294967295", draw), "UNDEFINED");
    survives(&indexed("0 1", draw), "3 indices of 4 bytes from byte 0 on would be read, but their buffer has 8 bytes");
    survives(&indexed("0 1 2", "draw_elements TRIANGLES 3 UNSIGNED_INT 2147483644"), "UNDEFINED");
    survives(&indexed("0 1 2", "draw_elements TRIANGLES 3 UNSIGNED_INT 1"), "within an index");
    survives(&indexed("0 1 2", "draw_elements TRIANGLES 3 UNSIGNED_INT -4"), "INVALID_VALUE");
}

#[test]
fn numbers_without_an_object() {
    survives(
        &changed(&[("bind_texture TEXTURE_2D texture", "bind_texture TEXTURE_2D 2")]),
        "no texture has the number 2",
    );
    survives(
        &changed(&[("bind_texture TEXTURE_2D texture", "bind_texture TEXTURE_2D -1")]),
        "no texture has the number -1",
    );
    survives(&changed(&[("use_program program", "use_program 77")]), "no program has the number 77");
    survives(
        &changed(&[("bind_buffer ARRAY_BUFFER buffer", "bind_buffer ARRAY_BUFFER 4")]),
        "no buffer has the number 4",
    );
    survives(&changed(&[("uniform_1i ourTexture 0", "uniform_1i ourTexture -1")]), "no texture unit has this number");
    survives(
        &changed(&[("uniform_1i ourTexture 0", "uniform_1i ourTexture 2147483647")]),
        "no texture unit has this number",
    );
    survives(&changed(&[("active_texture TEXTURE0", "active_texture -5")]), "invalid texture unit");
    survives(&changed(&[(DRAW, "viewport 0 0 -1 -1\ndraw_arrays TRIANGLES 0 3\n")]), "cannot be negative");
    survives(&changed(&[(DRAW, "enable TEXTURE_2D\ndraw_arrays TRIANGLES 0 3\n")]), "cannot be enabled or disabled");
    survives(&changed(&[("0 RGB8 pixels", "2147483647 RGB8 pixels")]), "INVALID_VALUE");
    survives(&changed(&[("0 RGB8 pixels", "-1 RGB8 pixels")]), "INVALID_VALUE");
    survives(&changed(&[("0 RGB8 pixels", "0 TEXTURE_2D pixels")]), "tex_image_2d");
    let viewport = "viewport -2147483648 -2147483648 2147483647 2147483647\nuse_program 9\n";
    survives(&changed(&[(DRAW, &format!("{viewport}{DRAW}"))]), "no program has the number 9");
}

#[test]
fn a_program_that_fills_the_memory() {
    let mut text = String::from("pixels = load_image checker.png\n");
    for i in 0..400 {
        let _ = writeln!(text, "t{i} = gen_texture\nbind_texture TEXTURE_2D t{i}");
    }
    for _ in 0..190 {
        text.push_str("tex_image_2d TEXTURE_2D 0 RGBA8 pixels\n");
    }
    let program = GlProgram::parse(&text, "x").unwrap_or_else(|e| panic!("{e:?}"));
    let context = context();
    let images = crate::gl_program::GlProgramImage::new([2048, 2048], vec![7; 2048 * 2048 * 4])
        .unwrap_or_else(|e| panic!("{e}"));
    let mut files = exercise_files();
    files.images.insert("checker.png".into(), std::sync::Arc::new(images));
    let options = crate::gl_program::GlProgramOptions { size: [16; 2], float: true, thumbnails: false };
    let run = crate::gl_program::run(context.gl(), &program.steps, &files, options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(run.errors.len(), 190 - 16, "16 images of 16 MB are 256 MB");
    assert!(run.errors[0].why.contains("256 MB of texels"), "{}", run.errors[0]);
}

#[test]
fn missing_files_and_broken_shaders() {
    let context = context();
    for (old, new, help) in [
        ("start.frag", "strat.frag", "did you mean `start.frag`?"),
        ("checker.png", "../../../etc/passwd", "the files are"),
        ("start.vert start.frag", "checker.png start.frag", "did you mean"),
    ] {
        let verdict = judged(&context, &changed(&[(old, new)]));
        assert_eq!(verdict.verdict, Outcome::DoesNotCompile, "{new}");
        assert!(verdict.errors[0].message.contains("unknown file"), "{:?}", verdict.errors);
        assert!(verdict.errors[0].help.contains(help), "{:?}", verdict.errors);
    }
    let mut files = exercise_files();
    files
        .shaders
        .insert("mine.frag".into(), "#version 330 core\nout vec4 c;\nvoid main() {\n  c = vec3(1.0);\n}\n".into());
    let text = changed(&[("start.frag", "mine.frag")]);
    let verdict = crate::gl_program::check(context.gl(), &text, "mine.txt", &files).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(verdict.verdict, Outcome::DoesNotCompile);
    assert_eq!((verdict.errors[0].file.as_str(), verdict.errors[0].line), ("mine.frag", 4), "{:?}", verdict.errors);
}
