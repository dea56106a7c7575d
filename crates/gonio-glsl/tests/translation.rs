//! Translates students' pairs of shaders to both output versions.

use gonio_fixtures::{FixtureTable, selected};
use gonio_glsl::{
    Checked, LoopBound, OutputVersion, Parsed, Severity, Stage, Translated, check, check_pair, leaves, lookups, parse,
    translate, translate_bounded, translate_showing,
};

/// Returns the selected pairs of the table `pairs.txt`: name, vertex and fragment shader.
fn pairs() -> Vec<(String, String, String)> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pairs.txt"));
    let cases = table.and_then(|table| table.cases()).unwrap_or_else(|error| panic!("{error}"));
    assert!(cases.len() >= 25, "only {} pairs", cases.len());
    selected(cases, |case| &case.name)
        .into_iter()
        .map(|case| {
            let texts =
                ["shader.vert", "shader.frag"].map(|path| case.text(path).unwrap_or_else(|error| panic!("{error}")));
            let [vertex, fragment] = texts;
            (case.name.clone(), vertex.to_owned(), fragment.to_owned())
        })
        .collect()
}

fn read(source: &str, stage: Stage) -> (Parsed, Checked) {
    let mut parsed = parse(source);
    let checked = check(&mut parsed, stage);
    (parsed, checked)
}

fn into(source: &str, stage: Stage, target: OutputVersion) -> Translated {
    let (parsed, checked) = read(source, stage);
    translate(&parsed, &checked, target)
}

/// Returns the lines of the translation that belong to the source.
fn body(source: &str, stage: Stage, target: OutputVersion) -> String {
    let found = into(source, stage, target);
    found.text.lines().skip(found.first_line as usize - 1).collect::<Vec<_>>().join("\n")
}

#[test]
fn valid_pairs_have_no_errors() {
    for (name, vertex, fragment) in pairs() {
        let (a, b) = (read(&vertex, Stage::Vertex), read(&fragment, Stage::Fragment));
        let both = check_pair(&a.1, &b.1);
        let all = [&a.0.problems, &a.1.problems, &b.0.problems, &b.1.problems, &both];
        for problem in all.into_iter().flatten() {
            assert!(problem.severity < Severity::Error, "{name}: {problem}");
        }
    }
}

#[test]
fn translations_have_no_problems_of_their_own() {
    for (name, vertex, fragment) in pairs() {
        for target in [OutputVersion::Core330, OutputVersion::Es300] {
            let mut checked = Vec::new();
            for (source, stage) in [(&vertex, Stage::Vertex), (&fragment, Stage::Fragment)] {
                let found = into(source, stage, target);
                assert_eq!(found.problems, [], "{name}");
                let (parsed, again) = read(&found.text, stage);
                assert_eq!(parsed.dialect().number, target.version().number);
                let problems: Vec<String> =
                    parsed.problems.iter().chain(&again.problems).map(ToString::to_string).collect();
                assert_eq!(problems, [""; 0], "{name}, {target:?}:\n{}", found.text);
                let lines = source.lines().count() + found.first_line as usize - 1;
                assert_eq!(found.text.lines().count(), lines, "{name}, {target:?}:\n{}", found.text);
                checked.push(again);
            }
            let both = check_pair(&checked[0], &checked[1]);
            assert!(both.iter().all(|p| p.severity < Severity::Error), "{name}, {target:?}: {both:?}");
        }
    }
}

#[test]
fn uniforms_keep_their_names() {
    for (name, vertex, fragment) in pairs() {
        for (source, stage) in [(&vertex, Stage::Vertex), (&fragment, Stage::Fragment)] {
            let before = read(source, stage).1.interface;
            for target in [OutputVersion::Core330, OutputVersion::Es300] {
                let found = into(source, stage, target);
                let after = read(&found.text, stage).1.interface;
                for uniform in &before.uniforms {
                    let rename = found.renames.iter().find(|r| r.is_interface && r.from == uniform.name);
                    let now = rename.map_or(&uniform.name, |r| &r.to);
                    assert!(after.uniforms.iter().any(|u| u.name == *now), "{name}: {now}");
                }
            }
        }
    }
}

/// Each case is one statement of a fragment shader, translated to 300 es.
#[test]
fn implicit_conversions_are_written_out_for_es() {
    let cases = [
        ("float a = 1;", "float a = 1.0;"),
        ("float a = 1 + i;", "float a = float(1 + i);"),
        ("float a = i * 0.5;", "float a = float(i) * 0.5;"),
        ("float a = (i) / f;", "float a = float((i)) / f;"),
        ("float a = -1;", "float a = float(-1);"),
        ("a = f > 0 ? 1 : 0.5;", "a = f > 0.0 ? 1.0 : 0.5;"),
        ("a = max(f, 0) + pow(f, 32);", "a = max(f, 0.0) + pow(f, 32.0);"),
        ("a = clamp(i, 0, 1);", "a = float(clamp(i, 0, 1));"),
        ("vec3 w = v * 2 / i;", "vec3 w = v * 2.0 / float(i);"),
        ("vec3 w = vec3(1, 0, i);", "vec3 w = vec3(1, 0, i);"),
        ("a += 1; a = g(1, i);", "a += 1.0; a = g(1.0, i);"),
        ("float k[2] = float[](1, 2);", "float k[2] = float[](1.0, 2.0);"),
        ("if (f == 1) a = f; i++;", "if (f == 1.0) a = f; i++;"),
        ("for (int n = 0; n < 3; n++) a *= n;", "for (int n = 0; n < 3; n++) a *= float(n);"),
        (
            "a = mod(i, 2) + TWO + HALF(i) + HALF(3);",
            "a = mod(float(i), 2.0) + float(TWO) + HALF(float(i)) + HALF(3.0);",
        ),
        ("uint u = 3; u = i;", "uint u = uint(3); u = uint(i);"),
        ("vec3 w = ivec3(1) * v;", "vec3 w = vec3(ivec3(1)) * v;"),
    ];
    for (from, to) in cases {
        let head = "#version 460\n#define TWO 2\n#define HALF(x) (0.5 * x)\nuniform float f; uniform int i; in vec3 v; out vec4 o;\nfloat g(float x, int n) { return x; }\n";
        let source = format!("{head}void main() {{ float a; a = 0.;\n{{ {from} }}\no = vec4(a); }}\n");
        let found = body(&source, Stage::Fragment, OutputVersion::Es300);
        assert_eq!(found.lines().nth(6), Some(&*format!("{{ {to} }}")), "{found}");
        let found = body(&source, Stage::Fragment, OutputVersion::Core330);
        let kept = if from.starts_with("uint") { to } else { from };
        assert_eq!(found.lines().nth(6), Some(&*format!("{{ {kept} }}")), "{found}");
    }
}

#[test]
fn qualifiers_are_translated() {
    let cases = [
        (Stage::Vertex, OutputVersion::Core330, "attribute vec3 p;", "in vec3 p;"),
        (Stage::Vertex, OutputVersion::Core330, "varying mediump vec3 p;", "out highp vec3 p;"),
        (Stage::Fragment, OutputVersion::Core330, "varying vec3 p;", "in vec3 p;"),
        (Stage::Fragment, OutputVersion::Es300, "precision lowp float;", "precision highp float;"),
        (Stage::Vertex, OutputVersion::Es300, "layout(location = 2) in vec3 p;", "layout(location = 2) in vec3 p;"),
        (Stage::Vertex, OutputVersion::Es300, "layout(location = 2) out vec3 p;", " out vec3 p;"),
        (Stage::Vertex, OutputVersion::Es300, "noperspective out vec3 p;", "out vec3 p;"),
        (Stage::Vertex, OutputVersion::Es300, "out flat int p;", "flat out int p;"),
        (Stage::Vertex, OutputVersion::Core330, "uniform double k = 2.0lf;", "uniform float k = 2.0;"),
        (Stage::Vertex, OutputVersion::Es300, "uniform float k = 2.0, l;", "uniform float k , l;"),
        (
            Stage::Vertex,
            OutputVersion::Es300,
            "layout(location = 1, binding = 2) uniform sampler2D s;",
            " uniform sampler2D s;",
        ),
        (
            Stage::Vertex,
            OutputVersion::Core330,
            "layout(std140, binding = 2) uniform B { vec3 x; };",
            "uniform vec3 x;",
        ),
        (
            Stage::Vertex,
            OutputVersion::Es300,
            "uniform B { layout(offset = 16) vec3 x; mat4 m[2]; } b; float f() { return b.x.y + (b.m)[1][0].x; }",
            "uniform vec3 B_x; uniform mat4 B_m[2]; float f() { return B_x.y + B_m[1][0].x; }",
        ),
        (Stage::Vertex, OutputVersion::Es300, "float k[2] = {1, 2};", "float k[2] = float[2](1.0, 2.0);"),
        (Stage::Vertex, OutputVersion::Es300, "#extension GL_ARB_x : enable", ""),
        (Stage::Vertex, OutputVersion::Core330, "float k = 1.0;;", "float k = 1.0;"),
    ];
    for (stage, target, from, to) in cases {
        let head = if from.contains("attribute") || from.contains("varying") { "#version 120" } else { "#version 460" };
        let found = body(&format!("{head}\n{from}\nvoid main() {{}}\n"), stage, target);
        let line: Vec<&str> = found.lines().nth(1).unwrap_or("none").split_whitespace().collect();
        assert_eq!(line.join(" "), to.trim(), "{target:?}: {from}");
    }
}

#[test]
fn uniforms_are_listed_by_the_names_of_opengl() {
    let source = "#version 330 core\nstruct L { vec3 p; float k[2]; };\nuniform L light, lights[2]; uniform vec3 colours[4]; uniform mat4 M;\nvoid main() {}\n";
    let checked = read(source, Stage::Vertex).1;
    let found: Vec<_> =
        leaves(&checked.interface).into_iter().map(|l| format!("{} {} {}", l.name, l.ty, l.count)).collect();
    let expected = [
        "light.p vec3 1",
        "light.k float 2",
        "lights[0].p vec3 1",
        "lights[0].k float 2",
        "lights[1].p vec3 1",
        "lights[1].k float 2",
        "colours vec3 4",
        "M mat4 1",
    ];
    assert_eq!(found, expected);
}

#[test]
fn the_interface_is_listed() {
    let source = "#version 330 core\nlayout(location = 1) in vec3 a;\nin vec2 b;\nflat out highp int c;\nuniform float k = 1.5;\nvoid main() { c = int(a.x * k); }\n";
    let found = read(source, Stage::Vertex).1.interface;
    let (a, b) = (&found.inputs[0], &found.inputs[1]);
    assert_eq!((&*a.name, a.location, a.is_used, a.span.line), ("a", Some(1), true, 2));
    assert_eq!((&*b.name, b.location, b.is_used, b.span.column), ("b", None, false, 9));
    let c = &found.outputs[0];
    assert_eq!((c.interpolation.as_deref(), c.precision.as_deref()), (Some("flat"), Some("highp")));
    assert!(found.uniforms[0].initial && found.uniforms[0].is_used);
    let defaults = into(source, Stage::Vertex, OutputVersion::Es300).uniform_defaults;
    assert_eq!(defaults[0].value, Some(vec![1.5]));
}

#[test]
fn interfaces_of_both_stages_must_match() {
    let vertex = "#version 330 core\nin vec3 p;\nout vec3 v_normal;\nout vec2 uv;\nflat out int id;\nuniform vec3 k;\nvoid main() { v_normal = p * k; id = 1; gl_Position = vec4(p, 1.0); }\n";
    let fragment = "#version 330 core\nin vec3 v_Normal;\nin vec3 uv;\nin int id;\nuniform vec4 k;\nout vec4 o;\nvoid main() { o = vec4(v_Normal + uv, id) * k; }\n";
    let found = check_pair(&read(vertex, Stage::Vertex).1, &read(fragment, Stage::Fragment).1);
    let problems: Vec<_> = found.iter().map(|p| (p.span.line, p.code)).collect();
    assert_eq!(problems, [(2, "not-given"), (3, "other-type"), (4, "other-interpolation"), (5, "other-type")]);
    assert_eq!(found[0].help.as_deref(), Some("the vertex shader has the output `v_normal`"));
}

/// Returns the lines of a bounded shader that belong to the source; none has moved.
fn bounded(source: &str, stage: Stage) -> String {
    let (parsed, checked) = read(source, stage);
    let found = translate_bounded(&parsed, &checked, OutputVersion::Es300, Some(LoopBound { turns: 50 }));
    let (parsed, again) = read(&found.text, stage);
    let problems: Vec<String> = parsed.problems.iter().chain(&again.problems).map(ToString::to_string).collect();
    assert_eq!(problems, [""; 0], "{}", found.text);
    found.text.lines().skip(found.first_line as usize - 1).collect::<Vec<_>>().join("\n")
}

#[test]
fn loops_are_bounded() {
    let source = "#version 330 core\nout vec4 c;\nvoid main() {\n  float x = 0.0;\n  \
                  for (int i = 0; i < 3; i++) for (;;) x += 1;\n  while (x > 0.0) {\n    x -= 0.5;\n  }\n  \
                  do x *= 2; while (x < 9.0);\n  if (x > 1.0) return;\n  c = vec4(x);\n} // end";
    let found = bounded(source, Stage::Fragment);
    let turn = "{ if (++gonio_turns > 50) break; ";
    let lines: Vec<&str> = found.lines().collect();
    assert_eq!(lines[4], format!("  for (int i = 0; i < 3; i++) {turn}for (;;) {turn}x += 1.0; }} }}"));
    assert_eq!(lines[5], format!("  while (x > 0.0) {turn}{{"));
    assert_eq!(lines[7], "  } }");
    assert_eq!(lines[8], format!("  do {turn}x *= 2.0; }} while (x < 9.0);"));
    assert_eq!(lines[2], "void gonio_main() {");
    assert!(lines[12].contains("gonio_main();") && lines[12].contains("discard"), "{found}");
    let vertex = bounded("void main() { for (;;) { } gl_Position = vec4(1.0); }", Stage::Vertex);
    assert!(vertex.contains(": vec4(2.0, 2.0, 2.0, 1.0)"), "{vertex}");
    // A shader without loops is unchanged.
    let plain = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }";
    assert_eq!(bounded(plain, Stage::Fragment), body(plain, Stage::Fragment, OutputVersion::Es300));
}

#[test]
fn loops_over_constants_are_not_counted() {
    // With a bound of 50 turns.
    let is_counted = |globals: &str, body: &str| {
        let source = format!(
            "#version 330 core\nout vec4 c;\nuniform int n;\n{globals}\nvoid main() {{ int j = 0; {body} c = vec4(j); }}"
        );
        bounded(&source, Stage::Fragment).contains("++gonio_turns > 50")
    };
    let function = "const int N = 4; void f() { for (int i = 0; i < N; i++) { } }";
    for (globals, body) in [
        ("", "for (int i = 0; i < 48; i++) j += i;"),
        ("", "for (int i = 48; i > 0; --i) if (i == j) break;"),
        ("", "for (float x = 0.0; x <= 1.0; x += 0.1) { }"),
        ("", "for (int i = 0; i < 3; i++) for (int k = 0; k < 3; k += 1) { }"),
        (function, "f(); for (int i = 0; i < 2; i++) f();"),
        ("", "for (int i = 9; i < 3; i++) { }"),
    ] {
        assert!(!is_counted(globals, body), "{globals} {body}");
    }
    for (globals, body) in [
        ("", "for (int i = 0; i < 60; i++) j += i;"),
        ("", "for (int i = 0; i < n; i++) { }"),
        ("", "for (int i = 0; i < 8; i++) i--;"),
        ("", "for (int i = 0; i < 8; i++) { i = 0; }"),
        ("", "for (int i = 0; i < 8; i--) { }"),
        ("", "for (int i = 0; i < 8; j++) { }"),
        ("", "for (int i = 0; j < 8; i++) { }"),
        ("", "for (int i = 0; i != 9; i += 2) { }"),
        ("", "for (uint i = 8u; i >= 0u; i--) { }"),
        ("", "for (float x = 0.0; x < 1e8; x += 1.0) { }"),
        ("", "for (int i = 0; i < 2147483647; i++) { }"),
        ("", "for (int i = 0; ; i++) if (i > 9) break;"),
        ("", "for (;;) { }"),
        ("", "while (j < 9) j++;"),
        ("", "do { j++; } while (j < 9);"),
        ("", "for (int i = 0; i < 8; i++) for (int k = 0; k < 8; k++) { }"),
        (function, "for (int i = 0; i < 40; i++) f();"),
        ("void back(inout int i) { i--; }", "for (int i = 0; i < 8; i++) back(i);"),
        (
            "void later(); ",
            "for (int i = 0; i < 8; i++) later(); } void later() { while (n > 0) { } } void other() { int j = 0;",
        ),
        ("const int N = 8;", "const int N = 90; for (int i = 0; i < N; i++) { }"),
    ] {
        assert!(is_counted(globals, body), "{globals} {body}");
    }
}

#[test]
fn loops_in_macros_are_counted() {
    let count = |source: &str| bounded(source, Stage::Fragment).matches("++gonio_turns > 50").count();
    let main = |define: &str, body: &str| {
        format!("#version 330 core\n#define {define}\nout vec4 c;\nvoid main() {{ {body} c = vec4(1.0); }}")
    };
    assert_eq!(count(&main("LOOP for (;;)", "LOOP { }")), 1);
    assert_eq!(count(&main("SPIN while (true) { }", "SPIN SPIN")), 1);
    assert_eq!(count(&main("REPEAT(body) for (;;) body", "REPEAT({ c.x = 1.0; })")), 1);
    assert_eq!(count(&main("REPEAT(body) for (;;) { body }", "REPEAT(c.x = 1.0;)")), 1);
    assert_eq!(count(&main("BEGIN {", "while (true) BEGIN }")), 1);
    assert_eq!(count(&main("STEP c.x += 1.0", "for (;;) STEP; if (c.x > 1.0) STEP;")), 1);
}

#[test]
fn a_fragment_with_too_many_turns_ignores_discard() {
    let source = "#version 330 core\nout vec4 c;\nin float x;\nvoid main() { while (x < 1.0) { if (x > 0.0) discard; } c = vec4(x); discard; }";
    let found = bounded(source, Stage::Fragment);
    assert_eq!(found.matches("{ if (gonio_turns <= 50) discard; }").count(), 2, "{found}");
}

#[test]
fn the_result_of_a_lookup_replaces_the_colour() {
    let sources = [
        "#version 330 core\nin vec3 d; out vec3 colour; uniform samplerCube s; uniform sampler2D t;\nvoid main() {\n if (d.x > 2.0) return;\n colour = 0.5 * texture(s, d).rgb + texture(t, d.xy).rgb + textureLod(s, -d, 0.0).rgb;\n}\n",
        "varying vec3 d; uniform samplerCube s;\nvoid main() { gl_FragColor = mix(textureCube(s, d), textureCube(s, -d), 0.5); }\n",
        "#version 330 core\n#define LOOK(x) texture(s, x)\nin vec3 d; out vec4 o; uniform samplerCube s;\nvoid main() { for (int i = 0; i < 2; ++i) o += LOOK(d) * texture(s, d.zyx); }\n",
    ];
    for source in sources {
        let (parsed, checked) = read(source, Stage::Fragment);
        let found = lookups(&parsed);
        assert_eq!(found.len(), 2, "{source}");
        for target in [OutputVersion::Core330, OutputVersion::Es300] {
            for lookup in &found {
                let bound = Some(LoopBound { turns: 9 });
                let text = translate_showing(&parsed, &checked, target, bound, Some(*lookup)).text;
                let (again, rechecked) = read(&text, Stage::Fragment);
                let problems: Vec<_> =
                    again.problems.iter().chain(&rechecked.problems).map(ToString::to_string).collect();
                assert_eq!(problems, [""; 0], "{target:?}\n{text}");
                assert_eq!(text.matches("gonio_shows(").count(), 2, "{text}");
                let ours = text.lines().last().unwrap_or_default();
                assert!(ours.starts_with("void main()") && ours.contains("= gonio_shown"), "{text}");
            }
        }
    }
}
