//! Syntax errors: what is told, and where.

use gonio_glsl::{Item, parse};

/// Line, column and code of what is told.
type Told = [(u32, u32, &'static str)];

fn told(source: &str) -> Vec<(u32, u32, &'static str)> {
    parse(source).problems.iter().map(|p| (p.span.line, p.span.column, p.code)).collect()
}

fn functions(source: &str) -> Vec<String> {
    let items = parse(source).unit.items;
    items.into_iter().filter_map(|i| if let Item::Function(f) = i { Some(f.name) } else { None }).collect()
}

#[test]
fn a_right_shader_has_no_syntax_errors() {
    let source = "#version 330 core\r\nlayout(location = 0) in vec3 position;\r\nuniform mat4 P, V, M;\r\nstruct Light { vec3 light_pos; float k[2]; };\r\nuniform Light light;\r\nout vec3 v;\r\nfloat f(in vec3 a, float b) { return a.x + b; }\r\nvoid main() {\r\n  vec3 n[2]; float a[3] = float[3](1.0, 2.0, 3.0); Light l = light;\r\n  for (int i = 0; i < 3; ++i) { if (i == 1) continue; else v += f(position, a[i]); }\r\n  switch (1) { case 0: break; default: v *= 2.; }\r\n  do { v.x = v.x > 0.0 ? -v.y : +v.z, v.y--; } while (false);\r\n  gl_Position = P * V * M * vec4(position, 1);\r\n}";
    assert_eq!(told(source), []);
    assert_eq!(functions(source), ["f", "main"]);
}

#[test]
fn each_syntax_error_has_its_place() {
    let cases: [(&str, &Told); 22] = [
        ("void main() {\n  float a = 1.0\n  float b = a;\n}\n", &[(2, 16, "missing-semicolon")]),
        ("void main() {\n  gl_FragColor = vec4(1.0)\n}\n", &[(2, 27, "missing-semicolon")]),
        ("void main() {\n  x = (1.0 + 2.0;\n  y = 2.0;\n}\n", &[(2, 17, "missing-bracket")]),
        ("void main() {\n  x = 1.0);\n}\nvoid g() {}\n", &[(2, 10, "stray-bracket")]),
        ("void main() {\n  x = 1.0;\n", &[(3, 1, "missing-bracket")]),
        ("void main() {\n  x = 1.0;\n\nvoid g() {\n}\n", &[(4, 1, "missing-bracket")]),
        ("void main() {\n  x = 1.0;\n}\n}\n", &[(4, 1, "stray-bracket")]),
        ("void main() {\n  x = 2pi;\n}\n", &[(2, 7, "bad-number")]),
        ("void main() {\n  x = 1,5;\n  y = 3.0 4.0;\n}\n", &[(3, 11, "missing-semicolon")]),
        ("void main() {\n  x = ;\n}\n", &[(2, 7, "missing-value")]),
        ("void main() {\n  else { x = 1; }\n}\n", &[(2, 3, "stray-else")]),
        ("void main() {\n  if x > 1.0 { y = 1; }\n}\n", &[(2, 5, "missing-bracket")]),
        ("uniform vec3 a\nuniform vec3 b;\nvoid main() {}\n", &[(1, 15, "missing-semicolon")]),
        ("x = 1.0;\nvoid main() {}\n", &[(1, 1, "outside-function")]),
        ("uniform vec3;\nuniform vec3 = 2;\nvoid main() {}\n", &[(2, 14, "missing-name")]),
        ("void main() {\n  float input = 1.0;\n}\n", &[(2, 9, "reserved-word")]),
        ("void main() {\n  x = é;\n}\n", &[(2, 7, "stray-character")]),
        ("/* é */ @\nvoid main() {}\n", &[(1, 9, "stray-character")]),
        ("void main() {\n /* open", &[(2, 2, "unclosed-comment"), (2, 9, "missing-bracket")]),
        ("#version 331\n#if 1\nvoid main() {}\n", &[(1, 1, "version"), (2, 1, "unclosed-if")]),
        ("#include <x>\n#define F(a) a\nfloat x = F(1,2);\n", &[(1, 1, "include"), (3, 11, "macro-arguments")]),
        ("void main() {\n  for (int i = 0, i < 3; i++) {}\n}\n", &[(2, 21, "missing-semicolon")]),
    ];
    for (source, wanted) in cases {
        assert_eq!(told(source), wanted, "{source}");
    }
}

#[test]
fn several_errors_are_reported_and_later_functions_known() {
    let source = "float f() {\n  return 1.0\n}\nfloat g() {\n  return (2.0;\n}\nvoid main() {\n  x = ;\n}\n";
    assert_eq!(told(source).iter().map(|t| t.0).collect::<Vec<_>>(), [2, 5, 8]);
    assert_eq!(functions(source), ["f", "g", "main"]);
}

#[test]
fn macros_are_replaced_and_point_to_their_use() {
    let source = "#define TWICE(x) ((x) * 2.0)\n#define N 3\n#define CAT(a, b) a##b\nvoid main() {\n  float a = TWICE(TWICE(1.0));\n  float CAT(b, 1)[N];\n  float c = TWICE(;\n}\n";
    assert_eq!(told(source), [(7, 13, "macro-arguments"), (7, 19, "missing-value")]);
    let source = "#define A B\n#define B A\n#define f(x) x f\nfloat A;\nint f(y)(3);\n";
    assert_eq!(told(source), [(5, 5, "missing-semicolon")]);
}

#[test]
fn branches_not_taken_are_not_read() {
    let source = "#version 300 es\n#ifdef GL_ES\nprecision highp float;\n#else\n@ @ @\n#endif\n#if __VERSION__ >= 300 && !defined(X) // c\nvoid main() {}\n#elif 1\n( ( (\n#endif\n";
    assert_eq!(told(source), []);
    assert_eq!(functions(source), ["main"]);
}
