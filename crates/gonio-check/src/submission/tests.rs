//! Tests of submissions as students hand them in, and of shaders in programs.

#![allow(clippy::unwrap_used)]

use super::literal::{Language, language, shaders};
use super::*;

const V: &str = "#version 330 core\nin vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }\n";
const F: &str = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";

fn files(list: &[(&str, &str)]) -> Vec<SourceFile> {
    list.iter().map(|(name, text)| SourceFile::new(*name, *text)).collect()
}

/// Returns a shader with a number, to tell shaders apart.
fn v(mark: u32) -> String {
    format!("// {mark}\n{V}")
}

fn f(mark: u32) -> String {
    format!("// {mark}\n{F}")
}

fn gathered(list: &[(&str, &str)]) -> Submission {
    Submission::gather(files(list)).unwrap_or_else(|error| panic!("{error}: {list:?}"))
}

/// Returns the files that were used.
fn taken(submission: &Submission) -> (&str, &str) {
    (&submission.vertex.file, &submission.fragment.file)
}

#[test]
fn two_files_of_any_names_in_any_order() {
    for (vertex, fragment) in [
        ("shader.vert", "shader.frag"),
        ("phong.vs", "phong.fs"),
        ("a.vsh", "b.fsh"),
        ("vertex.glsl", "fragment.glsl"),
        ("vertex.txt", "fragment.txt"),
        ("basic.vert.glsl", "basic.frag.glsl"),
        ("basic.vertexshader", "basic.fragmentshader"),
        ("vertex", "fragment"),
        ("one.glsl", "two.glsl"),
        ("one", "two"),
        ("Dupont/ex 04/v.txt", "Dupont/ex 04/f.txt"),
        ("C:\\work\\Vert.txt", "C:\\work\\Frag.txt"),
        ("sommet.txt", "pixel.txt"),
    ] {
        for list in [[(vertex, V), (fragment, F)], [(fragment, F), (vertex, V)]] {
            let submission = gathered(&list);
            assert_eq!(taken(&submission), (vertex, fragment));
            assert_eq!((submission.vertex.text.as_str(), submission.fragment.text.as_str()), (V, F));
            assert_eq!(submission.warnings, [""; 0], "{vertex}");
        }
    }
}

#[test]
fn a_version_in_a_name_is_not_a_stage() {
    for (vertex, fragment) in [("final.glsl", "final v2.glsl"), ("a v1.glsl", "b v2.glsl"), ("v3/a.glsl", "v3/b.glsl")]
    {
        let submission = gathered(&[(vertex, V), (fragment, F)]);
        assert_eq!(taken(&submission), (vertex, fragment));
    }
}

#[test]
fn a_vertex_shader_by_name_that_outputs_a_colour_is_the_fragment_shader() {
    let submission = gathered(&[("vertex lighting.glsl", F), ("vertex.glsl", V)]);
    assert_eq!(taken(&submission), ("vertex.glsl", "vertex lighting.glsl"));
    assert!(submission.warnings.iter().any(|warning| warning.contains("taken as the fragment shader")));
}

#[test]
fn content_corrects_misleading_names() {
    let turned = gathered(&[("a.vert", "void main() { gl_FragColor = vec4(1.0); }"), ("a.frag", V)]);
    assert_eq!(taken(&turned), ("a.frag", "a.vert"));
    assert_eq!(turned.warnings.len(), 2, "{:?}", turned.warnings);
    assert!(turned.warnings[0].contains("taken as the vertex shader"), "{:?}", turned.warnings);
    let partner = gathered(&[("a.glsl", "uniform vec3 x;\nvoid main() { }"), ("b.glsl", V)]);
    assert_eq!(taken(&partner), ("b.glsl", "a.glsl"));
    assert!(partner.warnings[0].contains("taken as the fragment shader"), "{:?}", partner.warnings);
    // Without `main`, the name determines the stage; the compiler reports the rest.
    assert_eq!(taken(&gathered(&[("a.vert", "in vec3 p;"), ("a.frag", F)])), ("a.vert", "a.frag"));
}

#[test]
fn one_file_may_hold_both() {
    let text = format!("#shader vertex\n{V}#shader fragment\n{F}");
    let submission = gathered(&[("phong.shader", &text)]);
    assert_eq!((submission.vertex.text.as_str(), submission.fragment.text.as_str()), (V, F));
    assert_eq!(submission.fragment.place(3, 15), ("phong.shader", 8, 15));
    assert_eq!(submission.warnings, [""; 0]);
    // A stage written as a C++ string to be included.
    let submission = gathered(&[("a.vert", &format!("R\"({V})\"")), ("a.frag", F)]);
    assert_eq!(submission.vertex.text, V);
    assert_eq!(submission.vertex.place(2, 1), ("a.vert", 2, 1));
}

#[test]
fn a_program_with_several_pairs() {
    let quoted = |text: &str| text.lines().map(|line| format!("    \"{line}\\n\"\n")).collect::<String>();
    let object = format!("std::string sourceV = {};\nstd::string sourceF = {};\n", quoted(&v(1)), quoted(&f(1)));
    let sky =
        format!("std::string sourceVCubeMap = {};\nstd::string sourceFCubeMap = {};\n", quoted(&v(2)), quoted(&f(2)));
    for source in [format!("{object}{sky}"), format!("{sky}{object}")] {
        let submission = gathered(&[("main.cpp", &source)]);
        assert_eq!((submission.vertex.text, submission.fragment.text), (v(1), f(1)));
        let warning = &submission.warnings[0];
        for part in ["sourceV`", "sourceF`", "sourceVCubeMap", "sourceFCubeMap", "(vertex)", "were checked"] {
            assert!(warning.contains(part), "{part}: {warning}");
        }
        let requested = Submission::gather_choosing(files(&[("main.cpp", &source)]), "cubemap").unwrap();
        assert_eq!((requested.vertex.text, requested.fragment.text), (v(2), f(2)));
        let hinted = Submission::gather_with(files(&[("main.cpp", &source)]), None, &["nothing", "cube_map"]).unwrap();
        assert_eq!((hinted.vertex.text, hinted.fragment.text), (v(2), f(2)));
    }
    let many = format!(
        "auto aVertex = {}; auto aFragment = {}; auto bVertex = {}; auto bFragment = {}; auto cVertex = {};",
        quoted(&v(1)),
        quoted(&f(1)),
        quoted(&v(2)),
        quoted(&f(2)),
        quoted(&v(3))
    );
    let last = gathered(&[("main.cpp", &many)]);
    assert_eq!((last.vertex.text, last.fragment.text), (v(2), f(2)));
    for order in [[v(1), f(1), v(2), f(2), v(3)], [f(1), v(1), f(2), v(2), f(3)]] {
        let nameless: String = order.iter().map(|text| format!("make(R\"({text})\");\n")).collect();
        let last = gathered(&[("main.cpp", &nameless)]);
        assert_eq!((last.vertex.text, last.fragment.text), (v(2), f(2)));
    }
    let named = gathered(&[("m.cpp", &many.replace("aVertex", "objectVertex").replace("aFragment", "objectFragment"))]);
    assert_eq!((named.vertex.text, named.fragment.text), (v(1), f(1)));

    let error = Submission::gather_choosing(files(&[("main.cpp", &many)]), "sky").unwrap_err().to_string();
    assert!(error.starts_with("no pair of shaders is called `sky`: choose one of main.cpp `aVertex`"), "{error}");
}

#[test]
fn a_folder_with_many_files() {
    let list = [
        ("p/skybox.vert", V),
        ("p/skybox.frag", F),
        ("p/phong.vert", V),
        ("p/phong.frag", F),
        ("p/lamp.vs", V),
        ("p/lamp.fs", F),
        ("p/README.md", "void main"),
        ("p/sky.png", "\0\0"),
        ("p/.DS_Store", "\0"),
        ("__MACOSX/p/._phong.vert", "\0"),
        (".git/config", "x"),
        ("build/phong.vert", V),
        ("CMakeLists.txt", "project(p)"),
        ("main.cpp", "int main() {}"),
        ("model.bin", "\0"),
        ("notes.txt", "the vertex shader is nice"),
    ];
    let submission = gathered(&list);
    assert_eq!(taken(&submission), ("p/phong.vert", "p/phong.frag"));
    let aside = submission.warnings.last().unwrap();
    for part in ["p/README.md", "p/sky.png", "build/phong.vert", "CMakeLists.txt", "main.cpp", "model.bin", "notes.txt"]
    {
        assert!(aside.contains(part), "{part}: {aside}");
    }
    assert!(!aside.contains("DS_Store") && !aside.contains(".git"), "{aside}");
    for (hints, stem) in [(vec!["skybox"], "skybox"), (vec!["ex09", "lamp"], "lamp"), (vec!["lamp", "skybox"], "lamp")]
    {
        let submission = Submission::gather_with(files(&list), None, &hints).unwrap();
        assert!(submission.vertex.file.contains(stem) && submission.fragment.file.contains(stem), "{hints:?}");
    }
}

#[test]
fn pairs_belong_together() {
    // The vertex shader is shared; the fragment shader is that of the hint.
    let shared = files(&[("basic.vert", V), ("phong.frag", F), ("gouraud.frag", F)]);
    let submission = Submission::gather_with(shared, None, &["phong"]).unwrap();
    assert_eq!(taken(&submission), ("basic.vert", "phong.frag"));
    // Equal names in several folders stay together.
    let list = [
        ("ex03/s.vert", V),
        ("ex04/s.vert", V),
        ("ex05/s.vert", V),
        ("ex05/s.frag", F),
        ("ex04/s.frag", F),
        ("ex03/s.frag", F),
    ];
    for exercise in ["ex03", "ex04", "ex05"] {
        let submission = Submission::gather_with(files(&list), None, &[exercise]).unwrap();
        assert!(submission.vertex.file.starts_with(exercise) && submission.fragment.file.starts_with(exercise));
    }
    // Files take precedence over the strings of a program.
    let program = format!("auto vs = R\"({})\"; auto fs = R\"({})\";", v(1), f(1));
    assert_eq!(taken(&gathered(&[("s.vert", V), ("main.cpp", &program), ("s.frag", F)])), ("s.vert", "s.frag"));
}

#[test]
fn included_files_are_inserted() {
    let vertex = "#version 330 core\n#include \"lib/space.glsl\"\nvoid main() { gl_Position = at; }\n";
    let submission = gathered(&[("a.vert", vertex), ("a.frag", F), ("space.glsl", "uniform vec4 b;\nin vec4 at;\n")]);
    assert!(submission.vertex.text.contains("core\nuniform vec4 b;\nin vec4 at;\nvoid main"));
    assert_eq!(submission.vertex.place(3, 4), ("space.glsl", 2, 4));
    assert_eq!(submission.vertex.place(4, 1), ("a.vert", 3, 1));
    assert_eq!(submission.warnings, [""; 0]);
    let alone = Submission::gather(files(&[("a.vert", vertex), ("a.frag", F)]));
    let Err(IntakeError::MissingInclude { line: 2, included, .. }) = alone else { panic!("{alone:?}") };
    assert_eq!(included, "lib/space.glsl");
    let circular =
        gathered(&[("a.vert", vertex), ("a.frag", F), ("space.glsl", "#include <space.glsl>\nin vec4 at;\n")]);
    assert_eq!(circular.vertex.text.matches("in vec4 at").count(), 1);
}

#[test]
fn names_toml_is_kept_and_corrections_are_reported() {
    let submission = gathered(&[("a.vert", V), ("a.frag", &format!("\u{FEFF}{F}")), ("names.toml", "[names]\n")]);
    assert_eq!(submission.names.as_deref(), Some("[names]\n"));
    assert_eq!(submission.fragment.text, F);
    assert_eq!(submission.warnings.len(), 1);
    assert!(submission.warnings[0].contains("byte order mark"), "{:?}", submission.warnings);
}

#[test]
fn each_error_has_its_message() {
    let big = " ".repeat(text::LARGEST + 1);
    for (list, message) in [
        (vec![], "there are no files: hand in a vertex and a fragment shader"),
        (vec![("a.vert", V)], "the fragment shader is missing; found only a.vert (vertex): hand in both stages"),
        (
            vec![("a.frag", F), ("b.md", "")],
            "the vertex shader is missing; found only a.frag (fragment): hand in both stages",
        ),
        (
            vec![("a.vert", V), ("b.vert", V)],
            "a.vert, b.vert are all vertex shaders, and there is no fragment shader: hand in one of each",
        ),
        (vec![("a.vert", V), ("a.frag", "")], "a.frag is empty: save the shader in your editor and hand it in again"),
        (
            vec![("a.vert", V), ("a.frag", "\0")],
            "a.frag is not a text file (a zero byte at offset 0): hand in the shader's source as plain text",
        ),
        (
            vec![("a.vert", V), ("a.frag", &big)],
            "a.frag has 10485761 bytes, more than the limit of 10485760: hand in only the shader's source",
        ),
        (
            vec![("a.md", ""), ("main.cpp", "int main() {}")],
            "there is no shader in a.md, main.cpp: hand in a vertex and a fragment shader, or the program that holds \
             both as strings",
        ),
    ] {
        assert_eq!(Submission::gather(files(&list)).unwrap_err().to_string(), message);
    }
}

#[test]
fn an_unreadable_file_does_not_spoil_a_pair() {
    let submission = gathered(&[("a.vert", V), ("a.frag", F), ("b.frag", ""), ("x", "\0")]);
    assert_eq!(taken(&submission), ("a.vert", "a.frag"));
    assert!(submission.warnings.iter().any(|w| w.starts_with("ignored: b.frag is empty")), "{:?}", submission.warnings);
}

#[test]
fn no_mixture_of_pieces_panics() {
    const PIECES: [&str; 34] = [
        "\"",
        "'",
        "`",
        "R\"(",
        ")\"",
        "\"\"\"",
        "${",
        "}",
        "{",
        "\\",
        "\n",
        "void main(){",
        "gl_Position=",
        "#version 330\n",
        "//VERTEX\n",
        "#ifdef FRAG\n",
        "#else\n",
        "/*",
        "*/",
        "é",
        "=",
        ",",
        ";",
        "vs",
        "out vec4 c;",
        "<script type=\"vertex\">",
        "</script>",
        "(",
        "+",
        "\u{FEFF}",
        " ",
        "discard;",
        "#shader fragment\n",
        "uniform",
    ];
    // A linear congruential generator (Knuth, MMIX), so that each run sees the same texts.
    let mut state = 1u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).unwrap() % below
    };
    let mut pairs = 0;
    for _ in 0..4000 {
        let text: String = (0..next(60)).map(|_| PIECES[next(PIECES.len())]).collect();
        for name in ["a.cpp", "a.js", "a.py", "a.html", "a.glsl"] {
            let partner = if next(2) == 0 { ("b.frag", F) } else { ("b.vert", V) };
            if let Ok(submission) = Submission::gather(files(&[(name, &text), partner])) {
                pairs += 1;
                for stage in [&submission.vertex, &submission.fragment] {
                    let lines = stage.text.lines().count();
                    let (_, line, _) = stage.place(u32::try_from(lines).unwrap(), 1);
                    let source = if stage.file == name { text.as_str() } else { V };
                    assert!(usize::try_from(line).unwrap() <= source.split('\n').count(), "{text}");
                }
            }
        }
    }
    assert!(pairs > 500, "{pairs}");
}

fn found_in(source: &str, language: Language) -> Vec<(String, String)> {
    shaders(source, language).into_iter().map(|l| (l.variable, l.text.text)).collect()
}

#[test]
fn every_way_to_write_a_literal() {
    let escaped = V.replace('\n', "\\n");
    let lines: Vec<String> = V.lines().map(|line| format!("\"{line}\\n\"")).collect();
    let bare: Vec<String> = V.lines().map(|line| format!("'{line}'")).collect();
    let mut sources = vec![
        (Language::C, format!("const char* vs = \"{escaped}\";")),
        (Language::C, format!("const char* vs =\n  {};", lines.join("\n  "))),
        (Language::C, format!("const char *vs[] = {{ {} }};", lines.join(", "))),
        (Language::C, format!("const std::string vs = \"{}\";", V.replace('\n', "\\n\\\n"))),
        (Language::C, format!("auto vs = R\"({V})\";")),
        (Language::C, format!("auto vs = R\"glsl({V})glsl\" ;")),
        (Language::C, format!("std::string vs(u8R\"x({V})x\");")),
        (Language::C, format!("std::string vs{{R\"({V})\"}};")),
        (Language::C, format!("std::string vs; /* \" */ // \"\n vs = {};", lines.join(" // joined\n"))),
        (Language::C, format!("std::string vs = {};\nvs += {};\nvs += {};", lines[0], lines[1], lines[2])),
        (Language::C, format!("char q = '\"'; int n = 1'000; char e = '\\''; auto vs = R\"({V})\";")),
        (Language::C, format!("vs << {};", lines.join(" << "))),
        (Language::C, format!("var vs = `{V}`")),
        (Language::JavaScript, format!("const vs = `{V}`;")),
        (Language::JavaScript, format!("const vs: string = `\n{V}`;")),
        (Language::JavaScript, format!("x = {{ vs: /* glsl */ `{V}`, other: 1 }}")),
        (Language::JavaScript, format!("var vs = {};", lines.join(" +\n"))),
        (Language::JavaScript, format!("var vs = [ {}, '' ].join('\\n');", bare.join(",\n"))),
        (Language::Python, format!("# don't\nvs = \"\"\"{V}\"\"\"")),
        (Language::Python, format!("vs = '''\n\n{V}'''")),
        (Language::Python, format!("vs = r\"\"\"{V}\"\"\"")),
        (Language::Python, format!("vs = ({})", lines.join("\n"))),
    ];
    sources.push((Language::Html, format!("<p>it's</p>\n<script id=\"vs\" type=\"x-shader/x-vertex\">\n{V}</script>")));
    for (language, source) in sources {
        let got = found_in(&source, language);
        assert_eq!(got.len(), 1, "{source}\n{got:?}");
        assert_eq!(got[0].1.trim_end(), V.trim_end(), "{source}");
        assert!(got[0].0.contains("vs"), "{source}: {}", got[0].0);
    }
}

#[test]
fn strings_that_are_not_shaders_are_ignored() {
    for source in [
        format!("// const char* vs = \"{}\";", V.replace('\n', "\\n")),
        format!("/* R\"({V})\" */"),
        "const char* t = \"int main() { return 0; }\";".to_owned(),
        "const char* t = \"vec3\";".to_owned(),
        "const char* t = \"void main() { gl_Position".to_owned(),
        String::new(),
    ] {
        assert_eq!(found_in(&source, Language::C), [], "{source}");
    }
}

#[test]
fn adjacent_literals_in_a_call_or_list_are_not_joined() {
    let escaped = V.replace('\n', "\\n");
    assert_eq!(found_in(&format!("add(\"phong\", \"{escaped}\");"), Language::C), [("add".to_owned(), V.to_owned())]);
    for source in [
        format!("link(\"{escaped}\", \"{escaped}\");"),
        format!("const char* all[] = {{\"{escaped}\", \"{escaped}\"}};"),
        format!("a = \"{escaped}\"; b = \"{escaped}\";"),
        format!("a = R\"({V})\"; b = R\"({V})\";"),
    ] {
        assert_eq!(found_in(&source, Language::C).len(), 2, "{source}");
    }
    let calls = format!("make(gl.VERTEX_SHADER, `{V}`); make(gl.FRAGMENT_SHADER, `{V}`)");
    let names: Vec<String> = found_in(&calls, Language::JavaScript).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["VERTEX_SHADER", "FRAGMENT_SHADER"]);
}

#[test]
fn inserted_values_are_reported() {
    let source = "const fs = `#version 300 es\n#define N ${n + {a: 1}.a}\nvoid main() {}`;";
    let literal = &shaders(source, Language::JavaScript)[0];
    assert!(literal.has_holes);
    assert_eq!(literal.text.text, "#version 300 es\n#define N \nvoid main() {}");
}

#[test]
fn positions_are_those_of_the_program() {
    let source =
        "int x;\nconst char* vs = \"#version 330\\n\\\n  in vec3 p;\\n\"\n    \"void\\tmain(){gl_Position=x;}\\n\";";
    let text = shaders(source, Language::C).remove(0).text.finish("main.cpp");
    assert_eq!(text.text, "#version 330\n  in vec3 p;\nvoid\tmain(){gl_Position=x;}\n");
    // The line `const char* vs = "#version`: the quote is column 18.
    assert_eq!(text.place(1, 1), ("main.cpp", 2, 19));
    assert_eq!(text.place(2, 3), ("main.cpp", 3, 3));
    assert_eq!(text.place(3, 1), ("main.cpp", 4, 6));
    assert_eq!(text.place(3, 6), ("main.cpp", 4, 12));

    let source = "vs = '''\n\n  #version 330\nvoid main() { gl_Position; }'''";
    let text = shaders(source, Language::Python).remove(0).text.finish("a.py");
    assert_eq!(text.place(1, 1), ("a.py", 3, 3));
    assert_eq!(text.place(2, 6), ("a.py", 4, 6));
}

#[test]
fn extensions_determine_the_language() {
    assert_eq!(language("src/main.CPP"), Some(Language::C));
    assert_eq!(language("a.py"), Some(Language::Python));
    assert_eq!(language("a.ts"), Some(Language::JavaScript));
    assert_eq!(language("index.html"), Some(Language::Html));
    assert_eq!((language("a.vert"), language("shader")), (None, None));
}

#[test]
fn hostile_programs_are_read_quickly() {
    for piece in ["\"a\",", "R\"", "'", "`${", "R\"(", "/*", "<script", "{\"main\",", "\"\\"] {
        let source = piece.repeat(100_000);
        for language in [Language::C, Language::JavaScript, Language::Python, Language::Html] {
            assert!(shaders(&source, language).is_empty(), "{piece}");
        }
    }
}
