//! Shaders found in programs as students write them.

#![allow(clippy::unwrap_used)]

use super::*;

const V: &str = "#version 330 core\nin vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }\n";

fn found(source: &str, language: Language) -> Vec<(String, String)> {
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
        let got = found(&source, language);
        assert_eq!(got.len(), 1, "{source}\n{got:?}");
        assert_eq!(got[0].1.trim_end(), V.trim_end(), "{source}");
        assert!(got[0].0.contains("vs"), "{source}: {}", got[0].0);
    }
}

#[test]
fn what_is_no_shader_is_left() {
    for source in [
        format!("// const char* vs = \"{}\";", V.replace('\n', "\\n")),
        format!("/* R\"({V})\" */"),
        "const char* t = \"int main() { return 0; }\";".to_owned(),
        "const char* t = \"vec3\";".to_owned(),
        "const char* t = \"void main() { gl_Position".to_owned(),
        String::new(),
    ] {
        assert_eq!(found(&source, Language::C), [], "{source}");
    }
}

#[test]
fn neighbours_in_a_call_or_a_list_stay_apart() {
    let escaped = V.replace('\n', "\\n");
    assert_eq!(found(&format!("add(\"phong\", \"{escaped}\");"), Language::C), [("add".to_owned(), V.to_owned())]);
    for source in [
        format!("link(\"{escaped}\", \"{escaped}\");"),
        format!("const char* all[] = {{\"{escaped}\", \"{escaped}\"}};"),
        format!("a = \"{escaped}\"; b = \"{escaped}\";"),
        format!("a = R\"({V})\"; b = R\"({V})\";"),
    ] {
        assert_eq!(found(&source, Language::C).len(), 2, "{source}");
    }
    let calls = format!("make(gl.VERTEX_SHADER, `{V}`); make(gl.FRAGMENT_SHADER, `{V}`)");
    let names: Vec<String> = found(&calls, Language::JavaScript).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["VERTEX_SHADER", "FRAGMENT_SHADER"]);
}

#[test]
fn values_put_in_are_reported() {
    let source = "const fs = `#version 300 es\n#define N ${n + {a: 1}.a}\nvoid main() {}`;";
    let literal = &shaders(source, Language::JavaScript)[0];
    assert!(literal.has_holes);
    assert_eq!(literal.text.text, "#version 300 es\n#define N \nvoid main() {}");
}

#[test]
fn places_are_the_programs_own() {
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
fn endings_tell_the_language() {
    assert_eq!(language("src/main.CPP"), Some(Language::C));
    assert_eq!(language("a.py"), Some(Language::Python));
    assert_eq!(language("a.ts"), Some(Language::JavaScript));
    assert_eq!(language("index.html"), Some(Language::Html));
    assert_eq!((language("a.vert"), language("shader")), (None, None));
}

#[test]
fn hostile_programs_end_soon() {
    for piece in ["\"a\",", "R\"", "'", "`${", "R\"(", "/*", "<script", "{\"main\",", "\"\\"] {
        let source = piece.repeat(100_000);
        for language in [Language::C, Language::JavaScript, Language::Python, Language::Html] {
            assert!(shaders(&source, language).is_empty(), "{piece}");
        }
    }
}
