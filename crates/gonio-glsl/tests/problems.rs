//! The problems reported for valid and invalid shaders: syntax errors and errors of meaning, with their positions.

use gonio_glsl::{Item, Stage, check, parse};

/// Line, column and code of each reported problem.
type Located = [(u32, u32, &'static str)];
/// Column and code of each problem reported for one line.
type InLine = [(u32, &'static str)];

/// Returns the syntax errors of a shader.
fn syntax(source: &str) -> Vec<(u32, u32, &'static str)> {
    parse(source).problems.iter().map(|p| (p.span.line, p.span.column, p.code)).collect()
}

/// Returns all problems of a shader.
fn problems(source: &str, stage: Stage) -> Vec<(u32, u32, &'static str)> {
    let mut parsed = parse(source);
    let checked = check(&mut parsed, stage);
    parsed.problems.iter().chain(&checked.problems).map(|p| (p.span.line, p.span.column, p.code)).collect()
}

/// Returns the problems of one line in `main` of a fragment shader of this version. It is the fourth line of the shader.
fn line(version: &str, line: &str) -> Vec<(u32, &'static str)> {
    let head = "uniform vec3 u; uniform mat4 M; uniform sampler2D s; uniform samplerCube c; in vec3 v; out vec4 o;";
    let precision = if version.ends_with("es") { "precision highp float; " } else { "" };
    let source = format!("#version {version}\n{precision}{head}\nvoid main() {{\n{line}\no = vec4(1.0); }}\n");
    let found = problems(&source, Stage::Fragment);
    assert!(found.iter().all(|f| f.0 == 4), "{line}: {found:?}");
    found.into_iter().map(|f| (f.1, f.2)).collect()
}

fn functions(source: &str) -> Vec<String> {
    let items = parse(source).unit.items;
    items.into_iter().filter_map(|i| if let Item::Function(f) = i { Some(f.name) } else { None }).collect()
}

#[test]
fn valid_shaders_have_no_syntax_errors() {
    let source = "#version 330 core\r\nlayout(location = 0) in vec3 position;\r\nuniform mat4 P, V, M;\r\nstruct Light { vec3 light_pos; float k[2]; };\r\nuniform Light light;\r\nout vec3 v;\r\nfloat f(in vec3 a, float b) { return a.x + b; }\r\nvoid main() {\r\n  vec3 n[2]; float a[3] = float[3](1.0, 2.0, 3.0); Light l = light;\r\n  for (int i = 0; i < 3; ++i) { if (i == 1) continue; else v += f(position, a[i]); }\r\n  switch (1) { case 0: break; default: v *= 2.; }\r\n  do { v.x = v.x > 0.0 ? -v.y : +v.z, v.y--; } while (false);\r\n  gl_Position = P * V * M * vec4(position, 1);\r\n}";
    assert_eq!(syntax(source), []);
    assert_eq!(functions(source), ["f", "main"]);
}

#[test]
fn each_syntax_error_has_its_position() {
    let cases: [(&str, &Located); 22] = [
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
    for (source, expected) in cases {
        assert_eq!(syntax(source), expected, "{source}");
    }
}

#[test]
fn later_errors_are_reported_and_later_functions_are_known() {
    let source = "float f() {\n  return 1.0\n}\nfloat g() {\n  return (2.0;\n}\nvoid main() {\n  x = ;\n}\n";
    assert_eq!(syntax(source).iter().map(|t| t.0).collect::<Vec<_>>(), [2, 5, 8]);
    assert_eq!(functions(source), ["f", "g", "main"]);
}

#[test]
fn macros_are_expanded_and_errors_point_to_their_use() {
    let source = "#define TWICE(x) ((x) * 2.0)\n#define N 3\n#define CAT(a, b) a##b\nvoid main() {\n  float a = TWICE(TWICE(1.0));\n  float CAT(b, 1)[N];\n  float c = TWICE(;\n}\n";
    assert_eq!(syntax(source), [(7, 13, "macro-arguments"), (7, 19, "missing-value")]);
    let source = "#define A B\n#define B A\n#define f(x) x f\nfloat A;\nint f(y)(3);\n";
    assert_eq!(syntax(source), [(5, 5, "missing-semicolon")]);
}

#[test]
fn inactive_branches_are_not_parsed() {
    let source = "#version 300 es\n#ifdef GL_ES\nprecision highp float;\n#else\n@ @ @\n#endif\n#if __VERSION__ >= 300 && !defined(X) // c\nvoid main() {}\n#elif 1\n( ( (\n#endif\n";
    assert_eq!(syntax(source), []);
    assert_eq!(functions(source), ["main"]);
}

#[test]
fn each_error_has_its_column() {
    let cases: [(&str, &InLine); 40] = [
        ("float a = w;", &[(11, "unknown-name")]),
        ("vec3 a = normalise(v);", &[(10, "unknown-function")]),
        ("vec3 a = v * M;", &[(10, "wrong-operands")]),
        ("vec4 a = M * v;", &[(10, "wrong-operands")]),
        ("vec3 a = v + vec4(v, 1);", &[(10, "wrong-operands")]),
        ("vec3 a = texture(s, v.xy);", &[(10, "wrong-type")]),
        ("float a = v;", &[(11, "wrong-type")]),
        ("float a = v.w;", &[(13, "bad-swizzle")]),
        ("float a = v.xr;", &[(13, "bad-swizzle")]),
        ("vec4 a = vec4(v);", &[(10, "constructor")]),
        ("vec3 a = vec3(v, 1.0);", &[(18, "constructor")]),
        ("vec3 a = vec3(v.xy);", &[(10, "constructor")]),
        ("float a = dot(v, M);", &[(11, "argument-types")]),
        ("float a = dot(v);", &[(11, "argument-count")]),
        ("u = v;", &[(1, "not-writable")]),
        ("v.x = 1.0;", &[(1, "not-writable")]),
        ("const float k = 1.0; k = 2.0;", &[(22, "not-writable")]),
        ("gl_FragCoord.x = 1.0;", &[(1, "not-writable")]),
        ("o.xx = v.xy;", &[(3, "not-writable")]),
        ("1.0 = v.x;", &[(1, "not-writable")]),
        ("if (v.x) o = vec4(0.0);", &[(5, "condition-type")]),
        ("if (v > u) o = vec4(0.0);", &[(5, "wrong-operands")]),
        ("float a; float a;", &[(16, "declared-twice")]),
        ("int i = 1.5;", &[(9, "wrong-type")]),
        ("int i = 5 % 2; float f = 5.0 % 2.0;", &[(26, "wrong-operands")]),
        ("bool b = !v.x;", &[(10, "wrong-type")]),
        ("vec3 a[2]; a[2] = v;", &[(14, "index-range")]),
        ("vec3 a[2]; a[0.0] = v;", &[(14, "index-type")]),
        ("float a = true ? 1.0 : v;", &[(11, "wrong-type")]),
        ("return 1.0;", &[(8, "return-type")]),
        ("break;", &[(1, "outside-loop")]),
        ("vec5 a;", &[(1, "unknown-type")]),
        ("float a = dot;", &[(11, "function-as-value")]),
        ("float a = u.foo;", &[(13, "bad-swizzle")]),
        ("float a = M.x;", &[(13, "no-components")]),
        ("float a = f(1.0);", &[(11, "unknown-function")]),
        ("uniform float k;", &[(1, "qualifier-place")]),
        ("vec4 a = texture(c, v.xy);", &[(10, "argument-types")]),
        ("gl_FragColr = vec4(1.0);", &[(1, "unknown-name")]),
        ("o = v;", &[(5, "wrong-type")]),
    ];
    for (source, expected) in cases {
        assert_eq!(line("330 core", source), expected, "{source}");
    }
}

#[test]
fn valid_lines_have_no_problems() {
    let cases = [
        "float a = 1; a += 2; a = a * 3 + 1u;",
        "vec3 a = vec3(1), b = vec3(vec4(1.0)), d = vec3(v.xy, 1), e = 2 * u / 3;",
        "mat3 n = transpose(inverse(mat3(M))); vec3 a = normalize(n * v);",
        "mat3 n = mat3(v, u, vec3(0)); mat3 k = mat3(1.0); mat2x3 r; r = mat2x3(v, u); vec2 w = v * r;",
        "vec4 a = texture(s, v.xy) + textureLod(s, v.xy, 1) + texture(c, reflect(v, u), 0.5);",
        "float a = max(dot(v, u), 0); float b = pow(max(a, 0.0), 32); float d = clamp(a, 0, 1) + mix(a, b, .5);",
        "float a = atan(v.x) + atan(v.y, v.x) + mod(v.x, 2); ivec2 i = textureSize(s, 0);",
        "int i = 3; i %= 2; i <<= 1; uint w = 3u & 1u; bool b = i == 2 && !(w > 1u) ^^ true;",
        "float a[] = float[](1, 2, 3); float b = a[a.length() - 1]; float d[2] = float[2](1.0, b);",
        "for (int i = 0, j = 2; i < 3; i++, --j) { float x = float(i + j); o.r += x; }",
        "int k = 2; switch (k) { case 1: o = vec4(1); break; default: o.a = 0; }",
        "vec3 a; a.x = 1; a[1] = 2; a.z = a.x; float w; if (a.x > 0) w = 1; else w = 2; o.x = w;",
        "float d; for (int i = 0; i < 2; ++i) { if (i > 0) o.x = d; d = 1.0; }",
        "bvec3 b = lessThan(v, u); if (any(b) || all(not(b))) discard;",
        "float distance = distance(v, u); float length = 1.0; o.x = distance + length;",
        "struct S { vec3 a; float b[2]; }; S s2 = S(v, float[2](1, 2)); S t = s2; o.x = t.b[1] + t.a.x; bool q = s2 == t;",
        "const int N = 2 + 1; const vec3 K = vec3(1, 2, N); float f[N * 2]; f[5] = K.x;",
        "v; ; { int v = 1; v++; } o.rgb = v; o.stp = v; o.x = gl_FragCoord.x + float(gl_FrontFacing) + gl_FragDepth;",
        "while (false) { continue; } do { break; } while (true);",
        "vec4 a = M[0] * M[1][2]; a = -a + +a; a *= M; mat4 n = M * M - 2.0; n = n / 3 + M; n++;",
        "float y = 1.0f; int h = 0xFF + 010; float e = 1e-3 + .5 + 1. + 2.5E+2;",
        "vec3 n = u; n.xy = n.yx; n = cross(n, n.zyx); float r = dFdx(n.x) + fwidth(n).y; uvec2 q = uvec2(1, 2);",
    ];
    for source in cases {
        assert_eq!(line("330 core", source), [], "{source}");
    }
}

#[test]
fn strictness_depends_on_the_version() {
    let cases: [(&str, &str, &InLine); 9] = [
        ("300 es", "float a = 1;", &[(11, "implicit-conversion")]),
        ("300 es", "float a = 2.0 * 3;", &[(17, "implicit-conversion")]),
        ("300 es", "float a = max(v.x, 0);", &[(20, "implicit-conversion")]),
        ("330 core", "uint a = 1;", &[(10, "implicit-conversion")]),
        ("400", "uint a = 1;", &[]),
        ("330 core", "vec4 a = texture2D(s, v.xy);", &[(10, "old-function")]),
        ("330 core", "gl_FragColor = vec4(1.0);", &[(1, "old-output")]),
        ("330 core", "float x; o.x = x;", &[(16, "unset")]),
        ("330 core", "float x = pow(-2.0, 3.0);", &[(15, "pow-of-negative")]),
    ];
    for (version, source, expected) in cases {
        assert_eq!(line(version, source), expected, "{source}");
    }
}

#[test]
fn rules_for_whole_shaders() {
    let fragment = |source: &str| problems(source, Stage::Fragment);
    assert_eq!(fragment("#version 330\nout vec4 o;\nvoid mian() { o = vec4(1.0); }\n"), [(4, 1, "missing-main")]);
    assert_eq!(fragment("#version 330\nint main() { return 1; }\n"), [(2, 5, "wrong-main")]);
    assert_eq!(fragment("int x;\n#version 330\nvoid main() {}\n"), [(2, 1, "version-not-first")]);
    assert_eq!(fragment("#version 330\nvoid main() {};\n"), [(2, 15, "stray-semicolon")]);
    assert_eq!(fragment("#version 460\nvoid main() {};\n"), []);
    assert_eq!(
        fragment("#version 330\nfloat f(int i) {\n  if (i > 0) return 1.0;\n}\nvoid main() {}\n"),
        [(2, 7, "missing-return")]
    );
    assert_eq!(
        fragment("#version 330\nfloat f(int i) {\n  if (i > 0) return 1.0; else return 2.0;\n}\nvoid main() {}\n"),
        []
    );
    let mutual = "#version 330\nvoid g();\nvoid f() { g(); }\nvoid g() { f(); }\nvoid main() { f(); }\n";
    assert_eq!(fragment(mutual), [(2, 6, "recursion"), (3, 6, "recursion")]);
    assert_eq!(fragment("#version 330\nvoid g();\nvoid main() { g(); }\n"), [(2, 6, "missing-body")]);
    assert_eq!(fragment("#version 100\nvarying vec3 v;\nvoid main() {}\n"), [(2, 9, "missing-precision")]);
    assert_eq!(fragment("#version 110\nvoid main() { float x = 1.0f; x; }\n"), [(2, 25, "float-suffix")]);
    assert_eq!(fragment("#version 330\nout vec4 o;\nvoid main() {}\n"), [(2, 10, "output-not-written")]);
    assert_eq!(problems("#version 330\nvoid main() {}\n", Stage::Vertex), [(2, 6, "output-not-written")]);
    assert_eq!(fragment("#version 330\nfloat a__b; float gl_x;\nvoid main() {}\n").len(), 2);
    assert_eq!(fragment("#version 300 es\nvarying highp vec3 v;\nvoid main() {}\n"), [(2, 1, "old-word")]);
    assert_eq!(fragment("#version 420 core\nvoid main() { gl_FragColor = vec4(1); }\n"), [(2, 15, "unknown-name")]);
    // An extension may add any name.
    let extension = "#version 330\n#extension GL_ARB_gpu_shader5 : enable\nvoid main() { gl_Strange = strange(1); }\n";
    assert_eq!(fragment(extension), []);
}
