//! Reading GL programs: accepted texts, and the errors of others.

use super::{REFERENCE, changed};
use crate::gl_program::{GlProgram, GlProgramError};
use gonio_render::gl_program::{GlCall, IntArgument, ObjectKind, Selector, UniformArgument};

fn errors(text: &str) -> Vec<GlProgramError> {
    GlProgram::parse(text, "mine.txt").err().unwrap_or_else(|| panic!("this was read:\n{text}"))
}

/// The one error of a text: line, column, message, help.
fn error(text: &str) -> (u32, u32, String, String) {
    let mut all = errors(text);
    assert_eq!(all.len(), 1, "{all:#?}");
    let GlProgramError { line, column, message, help, .. } = all.remove(0);
    (line, column, message, help)
}

#[test]
fn the_reference_is_read_call_by_call() {
    let program = GlProgram::parse(REFERENCE, "mine.txt").unwrap_or_else(|e| panic!("{e:?}"));
    assert_eq!(program.steps.len(), 29);
    assert_eq!(program.steps[0].line, 5);
    let GlCall::Data { name, numbers } = &program.steps[0].call else { panic!("{:?}", program.steps[0]) };
    assert_eq!((name.as_str(), numbers.len(), numbers[3], numbers[23]), ("corners", 24, 1.0, 1.0));
    assert_eq!(program.steps[2].call, GlCall::Generate { name: "array".into(), kind: ObjectKind::VertexArray });
    assert_eq!(program.steps[3].call, GlCall::BindVertexArray(IntArgument::Variable("array".into())));
    let draw = program.steps.last().unwrap_or_else(|| panic!("a call"));
    assert_eq!((draw.line, draw.call.word()), (45, "draw_arrays"));
    assert_eq!(program.quoted(45), Some("draw_arrays TRIANGLES 0 3"));
    assert_eq!((program.quoted(0), program.quoted(46)), (None, None));
}

#[test]
fn every_call_of_the_table_is_read() {
    let text = "data d\n 1.0f, -2e1 0.5,\nend\nindices i\n0 1,\nend\nb = gen_buffer\nt = gen_texture\n\
        uniform_1i s 3\nuniform_1f x 0.5\nuniform_2f x 1 2\nuniform_3f x 1 2 3\nuniform_4f lights[1].colour 1 2 3 4\n\
        viewport 0 0 -5 256\nenable BLEND\ndisable BLEND\nactive_texture t\nactive_texture 0\nactive_texture TEXTURE15\n\
        tex_parameter TEXTURE_2D TEXTURE_MAX_LEVEL 3\nclear COLOR_BUFFER_BIT|DEPTH_BUFFER_BIT\n\
        buffer_data ELEMENT_ARRAY_BUFFER i STATIC_DRAW\ndraw_elements TRIANGLES 3 UNSIGNED_INT 0\n\
        delete_texture t\ndelete_buffer b\ndelete_vertex_array 0\nbind_texture TEXTURE_2D 7\n";
    let program = GlProgram::parse(text, "mine.txt").unwrap_or_else(|e| panic!("{e:#?}"));
    let words: Vec<_> = program.steps.iter().map(|step| step.call.word()).collect();
    assert_eq!(
        words,
        [
            "data",
            "indices",
            "gen_buffer",
            "gen_texture",
            "uniform_1i",
            "uniform_1f",
            "uniform_2f",
            "uniform_3f",
            "uniform_4f",
            "viewport",
            "enable",
            "disable",
            "active_texture",
            "active_texture",
            "active_texture",
            "tex_parameter",
            "clear",
            "buffer_data",
            "draw_elements",
            "delete_texture",
            "delete_buffer",
            "delete_vertex_array",
            "bind_texture",
        ]
    );
    let calls: Vec<_> = program.steps.iter().map(|step| &step.call).collect();
    assert_eq!(calls[0], &GlCall::Data { name: "d".into(), numbers: vec![1.0, -20.0, 0.5] });
    assert_eq!(calls[1], &GlCall::Indices { name: "i".into(), numbers: vec![0, 1] });
    assert_eq!(
        calls[4],
        &GlCall::Uniform { uniform: "s".into(), given: UniformArgument::Whole(IntArgument::Literal(3)) }
    );
    assert_eq!(calls[9], &GlCall::Viewport([0, 0, -5, 256]), "OpenGL must reject it, not the reader");
    assert_eq!(calls[12], &GlCall::ActiveTexture(Selector::Number(IntArgument::Variable("t".into()))));
    let GlCall::Clear(bits) = calls[16] else { panic!("{:?}", calls[16]) };
    assert_eq!(bits.len(), 2);
}

#[test]
fn errors_have_a_place_and_a_remedy() {
    let cases = [
        ("x = gen_texure", 5, "unknown call `gen_texure`", "did you mean `gen_texture`?"),
        ("x = gen_texture\nbind_texture TEXTURE_2D y", 25, "`y` is not defined yet", "did you mean `x`?"),
        (
            "x = gen_texture\nbind_texture TEXTURE_2D",
            1,
            "`bind_texture` expects 2 arguments, but got 1",
            "TARGET TEXTURE",
        ),
        ("x = gen_texture 3", 17, "`gen_texture` expects 0 arguments, but got 1", "write `gen_texture`"),
        ("bind_texture TEXTURE2D 0", 14, "unknown constant `TEXTURE2D`", "did you mean `TEXTURE_2D`?"),
        ("bind_texture GL_TEXTURE_2D 0", 14, "unknown constant", "write `TEXTURE_2D`, without GL_"),
        ("glBindTexture(GL_TEXTURE_2D, 0);", 1, "unknown call", "write `bind_texture`"),
        ("gen_texture", 1, "the result of `gen_texture` is not stored", "write `name = gen_texture`"),
        (
            "x = clear COLOR_BUFFER_BIT",
            1,
            "`clear` returns nothing that can be stored in `x`",
            "write `clear` without a name",
        ),
        ("x=gen_texture", 1, "expected spaces around `=`", "name = call"),
        ("viewport 0 0 1.5 2", 14, "`1.5` is not an integer", "write an integer"),
        ("viewport 0 0 99999999999 2", 14, "`99999999999` is too large", ""),
        ("clear_color nan 0 0 0", 13, "`nan` is not a number", ""),
        ("clear_color 1e99 0 0 0", 13, "`1e99` is not a number", ""),
        ("data d\n1 2 inf\nend\nclear COLOR_BUFFER_BIT", 5, "`inf` is not a number", ""),
        ("indices d\n1 -2\nend\nclear COLOR_BUFFER_BIT", 3, "`-2` is not an index", "from 0"),
        ("data d\n1 2\nclear COLOR_BUFFER_BIT", 1, "the list `d`, which starts in line 1, has no end", "`end`"),
        ("data d\n1 2", 1, "the list `d`, which starts in line 1, has no end", "`end`"),
        ("data clear\n1\nend", 6, "`clear` cannot be a name", ""),
        ("data d\n1\nend\ndata d\n2\nend", 6, "`d` already exists", "another name"),
        ("data d\n1\nend\nuse_program d", 13, "`d` is a list of numbers, not a number", ""),
        ("buffer_data ARRAY_BUFFER c STATIC_DRAW", 26, "`c` is not defined yet", "data NAME ... end"),
        ("vertex_attrib_pointer p 3 FLOAT false 0 0", 33, "`false` is neither TRUE nor FALSE", "write FALSE"),
        (
            "enable_vertex_attrib_array 0",
            28,
            "`0` cannot be the name of a shader variable",
            "the name that it has in the shader",
        ),
        ("", 1, "the program has no calls", ""),
        ("# nothing\n\n", 1, "the program has no calls", ""),
    ];
    for (text, column, message, help) in cases {
        let first = errors(text).remove(0);
        assert!(first.message.contains(message), "{text}: {}", first.message);
        assert!(first.help.contains(help), "{text}: {}", first.help);
        assert_eq!(first.column, column, "{text}: {first}");
        assert_eq!(first.file, "mine.txt");
    }
}

#[test]
fn one_error_does_not_cause_others() {
    // The result of the broken line is used in seven more lines.
    let (line, column, message, _) = error(&changed(&[("texture = gen_texture", "texture = gen_textures now")]));
    assert_eq!((line, column), (29, 11), "{message}");
    // Two errors in two lines are two.
    let two = changed(&[("clear_color", "clear_colour"), ("TRIANGLES", "TRIANGLE")]);
    let all = errors(&two);
    assert_eq!(all.iter().map(|e| e.line).collect::<Vec<_>>(), [40, 45], "{all:#?}");
    assert_eq!(all[1].to_string(), "mine.txt:45:13: unknown constant `TRIANGLE`; did you mean `TRIANGLES`?");
}
