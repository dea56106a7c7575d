#![allow(clippy::unwrap_used)]

use super::*;
use crate::dataflow::Shader;
use crate::mistakes::ModelSolution;
use crate::roles::{NamesFile, Role};
use glam::Vec3;
use gonio_glsl::{Checked, Parsed, Stage, check, parse};

fn parsed(text: &str, stage: Stage) -> (Parsed, Checked) {
    let mut parsed = parse(text);
    let checked = check(&mut parsed, stage);
    (parsed, checked)
}

fn shader((parsed, checked): &(Parsed, Checked)) -> Shader<'_> {
    Shader { parsed, checked }
}

/// Analyses a pair of shaders.
fn read(vertex: &str, fragment: &str) -> Analysis {
    let (vertex, fragment) = (parsed(vertex, Stage::Vertex), parsed(fragment, Stage::Fragment));
    Analysis::new(&shader(&vertex), &shader(&fragment), &NamesFile::default())
}

/// Analyses a fragment shader with the vertex shader of the model solution.
fn fragment(head: &str, body: &str) -> Analysis {
    let declarations = "in vec3 world_position; in vec3 v_normal; out vec4 FragColor; uniform vec3 u_view_pos;";
    let text = format!("#version 330 core\n{declarations}\n{head}\nvoid main() {{\n{body}\n}}\n");
    let source = read(ModelSolution::Phong.sources()[0], &text);
    assert!(source.reading.colour.is_some(), "{text}");
    source
}

#[test]
fn constant_exponents_are_found() {
    let lit = "vec3 N = normalize(v_normal); vec3 L = normalize(vec3(1.0, 2.0, 3.0) - world_position); \
               vec3 V = normalize(u_view_pos - world_position); float c = max(dot(reflect(-L, N), V), 0.0);";
    for (head, value, expected) in [
        ("", "pow(c, 32.0)", Some(32.0)),
        ("", "pow(c, 8)", Some(8.0)),
        ("const float shininess = 4.0 * 8.0;", "pow(c, shininess)", Some(32.0)),
        ("#define EXPONENT 16.0", "pow(c, EXPONENT)", Some(16.0)),
        ("float raised(float x, float by) { return pow(x, by); }", "raised(c, 12.0)", Some(12.0)),
        ("", "exp2(log2(c) * 32.0)", Some(32.0)),
        ("", "exp(20.0 * log(c))", Some(20.0)),
        ("float square(float x) { return x * x; }", "square(square(square(square(square(c)))))", Some(32.0)),
        ("float raised(float x) { for (int i = 0; i < 5; i++) x *= x; return x; }", "raised(c)", Some(32.0)),
        ("uniform float shininess;", "pow(c, shininess)", None),
        // Never output.
        ("uniform float shininess;", "0.0 * pow(c, 32.0) + pow(c, shininess)", None),
        // Not a power of a cosine.
        ("", "pow(1.0 + world_position.x, 2.2) * c", None),
        ("", "c", None),
    ] {
        let source = fragment(head, &format!("{lit}\nfloat s = {value};\nFragColor = vec4(vec3(s), 1.0);"));
        let found = source.constants().shininess;
        assert_eq!(found.map(|n| (n * 1000.0).round() / 1000.0), expected, "{head} {value}");
    }
}

#[test]
fn constant_light_positions_are_found() {
    let expected = Some(Vec3::new(1.0, 2.0, 1.5));
    for (head, value, expected) in [
        ("", "normalize(vec3(1.0, 2.0, 1.5) - world_position)", expected),
        ("const vec3 light = vec3(1.0, 2.0, 1.5);", "normalize(light - world_position)", expected),
        ("const vec3 lightPos = vec3(1.0, 2.0, 1.5);", "normalize(lightPos)", expected),
        ("#define LIGHT vec3(1.0, 2.0, 3.0 / 2.0)", "normalize(LIGHT - world_position)", expected),
        ("", "-normalize(world_position - vec3(1.0, 2.0, 1.5))", expected),
        ("vec3 to(vec3 p) { return normalize(p - world_position); }", "to(vec3(1, 2, 1.5))", expected),
        (
            "struct Light { vec3 position; };",
            "normalize(Light(vec3(1.0, 2.0, 1.5)).position - world_position)",
            expected,
        ),
        ("uniform vec3 lightPos;", "normalize(lightPos - world_position)", None),
        ("const vec3 unused = vec3(1.0); uniform vec3 lightPos;", "normalize(lightPos - world_position)", None),
    ] {
        let body = format!("vec3 L = {value};\nFragColor = vec4(vec3(max(dot(normalize(v_normal), L), 0.0)), 1.0);");
        assert_eq!(fragment(head, &body).constants().light_position, expected, "{head} {value}");
    }
}

#[test]
fn constant_attenuations_are_found() {
    let full = [Some(1.0), Some(0.14), Some(0.07)];
    for (head, value, expected) in [
        ("", "1.0 / (1.0 + 0.14 * d + 0.07 * d * d)", full),
        ("", "1.0 / (1.0 + 0.14 * d + 0.07 * pow(d, 2.0))", full),
        ("", "1.0 / (1.0 + (0.14 + 0.07 * d) * d)", full),
        ("", "1.0 / dot(vec3(1.0, 0.14, 0.07), vec3(1.0, d, d * d))", full),
        ("const float kc = 1.0, kl = 0.14, kq = 0.07;", "1.0 / (kc + kl * d + kq * (d * d))", full),
        ("uniform float linear;", "1.0 / (1.0 + linear * d + 0.07 * d * d)", [Some(1.0), None, Some(0.07)]),
        ("", "1.0 / (1.0 + 0.07 * d * d)", [Some(1.0), None, Some(0.07)]),
        ("", "1.0 / (d * d)", [None; 3]),
        ("", "1.0", [None; 3]),
    ] {
        let body = format!(
            "vec3 to = vec3(1.0, 2.0, 3.0) - world_position; float d = length(to);\nfloat a = {value};\n\
             FragColor = vec4(vec3(a * max(dot(normalize(v_normal), normalize(to)), 0.0)), 1.0);"
        );
        assert_eq!(fragment(head, &body).constants().attenuation, expected, "{head} {value}");
    }
}

#[test]
fn constant_refraction_indices_are_found() {
    for (head, value, expected) in [
        ("", "1.0 / 1.52", Some(1.52)),
        ("", "0.658", Some(1.52)),
        ("const float n1 = 1.0, n2 = 1.33;", "n1 / n2", Some(1.33)),
        ("", "1.52", Some(1.52)),
        ("uniform float refractionIndice;", "1.0 / refractionIndice", None),
        ("", "1.0", None),
    ] {
        let head = format!("uniform samplerCube skybox;\n{head}");
        let body = format!(
            "vec3 I = normalize(world_position - u_view_pos);\nfloat ratio = {value};\n\
             FragColor = texture(skybox, refract(I, normalize(v_normal), ratio));"
        );
        let found = fragment(&head, &body).constants().refraction_index;
        assert_eq!(found.map(|n| (n * 100.0).round() / 100.0), expected, "{head} {value}");
    }
}

#[test]
fn a_clamp_around_the_power_is_reported() {
    for (value, is_reported) in [
        ("max(pow(dot(R, V), 32.0), 0.0)", true),
        ("clamp(pow(dot(R, V), 32.0), 0.0, 1.0)", true),
        ("pow(max(dot(R, V), 0.0), 32.0)", false),
        ("max(pow(max(dot(R, V), 0.0), 32.0), 0.0)", false),
        // A picture shows this one.
        ("pow(dot(R, V), 32.0)", false),
    ] {
        let source = fragment(
            "uniform vec3 lightPos;",
            &format!(
                "vec3 N = normalize(v_normal); vec3 L = normalize(lightPos - world_position);\n\
                 vec3 V = normalize(u_view_pos - world_position); vec3 R = reflect(-L, N);\n\
                 float s = {value};\nFragColor = vec4(vec3(s), 1.0);"
            ),
        );
        let reported = source.in_source_only();
        assert_eq!(reported.len(), usize::from(is_reported), "{value}");
        for (id, place, sentence) in reported {
            assert_eq!((id, place.stage, place.span.line), ("specular-power-of-negative", Stage::Fragment, 7));
            assert!(sentence.contains("max"));
        }
    }
}

/// Returns the line of the mistake in a function of `face` and `st` whose lines begin with the second; 0 if none is
/// found.
fn line_of_face(head: &str, lines: &[&str], id: &str) -> u32 {
    let text = format!(
        "#version 330 core\nin vec2 st; uniform int face; uniform sampler2D panorama; out vec4 FragColor; {head} vec3 ray() {{\n{}\n}}\n\
         void main() {{ vec3 d = normalize(ray());\n\
         FragColor = texture(panorama, vec2(atan(d.x, -d.z) / 6.2831853 + 0.5, acos(d.y) / 3.14159265)); }}",
        lines.join("\n")
    );
    let vertex = "#version 330 core\nin vec3 position; out vec2 st;\n\
                  void main() { st = position.xy; gl_Position = vec4(position, 1.0); }";
    read(vertex, &text).line(id).map_or(0, |place| place.span.line)
}

#[test]
fn the_case_of_a_face_is_found_in_every_form() {
    const ID: [&str; 3] = ["face-posx-mirrored", "face-posy-flipped", "face-negz-transposed"];
    let found = |head: &str, lines: &[&str]| ID.map(|id| line_of_face(head, lines, id));
    let (x, y, z) = ("vec3(1.0, -st.y, -st.x)", "vec3(st.x, 1.0, st.y)", "vec3(-st.x, -st.y, -1.0)");
    let other = "vec3(st.x, -1.0, -st.y)";
    let chain = [
        &format!("if (face == 0) return {x};"),
        &format!("else if (2 == face) return {y};"),
        &format!("else if (face == 1 || face == 3 || face == 4) return {other};"),
        &format!("return {z};"),
    ];
    assert_eq!(found("", &chain.map(String::as_str)), [3, 4, 6], "if, with what is left over");
    let returned = [
        "switch (face) {",
        &format!("case 0: return {x};"),
        &format!("case 2: return {y};"),
        &format!("case 1: case 3: case 4: return {other};"),
        &format!("default: return {z}; }}"),
    ];
    assert_eq!(found("", &returned), [4, 5, 7], "returned");
    let written = [
        "vec3 d; switch (int(face)) {",
        &format!("default: d = {z}; break;"),
        &format!("case UP: {{ float t = st.y; d = {y}; break; }}"),
        &format!("case A: case B: case C: d = {other}; break;"),
        &format!("case RIGHT: d = {x}; }}"),
        "return d;",
    ];
    let head = "const int RIGHT = 0; const int A = 1, UP = A + 1, B = 3, C = 4;";
    assert_eq!(found(head, &written), [7, 5, 4], "written, by constants, `default` first");
    let fallen = [
        "vec3 d; float side = 1.0; switch (face) {",
        "case 5: side = -1.0;",
        "case 4: d = vec3(side * st.x, -st.y, side); break;",
        "case 3: side = -1.0;",
        "case 2: d = vec3(st.x, side, side * st.y); break;",
        "case 1: side = -1.0;",
        "case 0: d = vec3(side, -st.y, -side * st.x); }",
        "return d;",
    ];
    assert_eq!(found("", &fallen), [9, 7, 5], "fallen through");
    let apart = [
        "float x = 0.0, y = -st.y, z = 0.0; switch (face) { case 0:",
        "x = 1.0;",
        "z = -st.x; break; case 2:",
        "x = st.x;",
        "y = 1.0; z = st.y; break; case 5:",
        "x = -st.x;",
        "z = -1.0; }",
        "return vec3(x, y, z);",
    ];
    assert_eq!(found("", &apart), [4, 6, 8], "number by number");
    // A `switch` over another value has no faces.
    assert_eq!(found("uniform int mode;", &["switch (mode) { case 0: return st.xyx; } return st.yxy;"]), [0, 0, 0]);
}

/// Each branch saves the values of all names; a few thousand of both would take gigabytes and minutes.
#[test]
fn many_branches_with_many_names_are_abandoned() {
    let is_read = |names: usize, branch: &str| {
        let names: String = (0..names).map(|i| format!("float a{i};")).collect();
        let body = format!("void main() {{ {} c = v; }}", branch.repeat(3000));
        let head = "#version 330\nin vec4 v; out vec4 c;";
        read("", &format!("{head} {names} {body}")).reading.colour.map(|_| ())
    };
    for branch in ["if (v.x > 0.0) ;", "if (v.x > 0.0) { return; }"] {
        assert_eq!((is_read(20, branch), is_read(3000, branch)), (Some(()), None), "{branch}");
    }
}

#[test]
fn the_analysis_of_any_source_returns() {
    let deep = |open: &str, close: &str, count: usize| format!("{}x{}", open.repeat(count), close.repeat(count));
    let bodies = [
        String::new(),
        "float x = x; x = x + x;".into(),
        "float x = 1.0; for (;;) { x *= x; }".into(),
        "float x = 1.0; while (x > 0.0) x = f(x);".into(),
        "for (int i = 0; i < 8; i++) for (int j = 0; j < 8; j++) for (int k = 0; k < 8; k++) for (int l = 0; l < 8; l++) \
         for (int m = 0; m < 8; m++) c += c * f(float(i));"
            .into(),
        "v.q = 1.0; v.xyzwxyzw = v; v[7] = 1.0; v[-1] = 2.0; v.x.y.z = 1.0;".into(),
        "float a[3]; a[1000000] = 1.0; a[-5] = 2.0; c = vec4(a[2000000000]);".into(),
        "return; c = vec4(1.0);".into(),
        "c = vec4(); c = vec3(1.0); c = pow(); c = dot(1.0); c = reflect(v); c = max(1.0); c = clamp(1.0, 2.0);".into(),
        "int i = 0; i = i / i; i = 1 % 0; c = vec4(i / 0, 1.0 / 0.0, 0.0 / 0.0, pow(-1.0, 0.5));".into(),
        "switch (1) { case 0: c = v; break; default: c = -v; }".into(),
        "switch (int(v.x)) { } switch (int(v.x)) { c = v; } switch (int(v.x)) { case 0: } switch (int(v.x)) { case: default: }".into(),
        format!("switch (int(v.x)) {{ {} }}", (0..3000).map(|i| format!("case {i}: c.x = v.x * {i}.0;")).collect::<String>()),
        format!("switch (int(v.x)) {{ {} c = v; }}", (0..5000).map(|i| format!("case {i}:")).collect::<String>()),
        format!("{} c = v; {}", "switch (int(v.x)) { case 1: case 2: c = -v; default: ".repeat(60), "}".repeat(60)),
        format!(
            "{} c = v; {}",
            format!("switch (int(v.x)) {{ {} case 40: ", "case 1: c += v; break;".repeat(31)).repeat(60),
            "}".repeat(60)
        ),
        "do { c = v; continue; } while (true);".into(),
        format!("float x = 1.0; c = vec4({});", deep("(", ")", 150)),
        format!("float x = 1.0; c = vec4({});", deep("-", "", 190)),
        format!("float x = 1.0; c = vec4({});", vec!["x"; 5000].join(" + ")),
        format!("float x = 1.0; {} c = vec4(x);", "x = x * x + x;".repeat(3000)),
        format!("vec4 x; {} c = vec4(x.x);", "x.y = x.x; x.z = 1.0;".repeat(3000)),
        format!("{} c = v; {}", "if (v.x > 0.0) {".repeat(150), "}".repeat(150)),
        "c = ".into(),
        "}}}} {{{{".into(),
    ];
    let head = "#version 330\nin vec4 v; out vec4 c; struct S { S s; float x; }; uniform S s; const float k = k;\n\
                float f(float x) { return f(x) + f(x * 2.0); } float g(float x) { return f(g(x)); }\n";
    for body in &bodies {
        let text = format!("{head}void main() {{ {body} }}");
        for (vertex, fragment) in [(text.as_str(), text.as_str()), ("", text.as_str()), (text.as_str(), "\u{feff}")] {
            let source = read(vertex, fragment);
            assert!(source.constants().shininess.is_none_or(f32::is_finite));
            assert!(source.in_source_only().len() <= 1);
            for mistake in crate::mistakes::all() {
                let support = source.support(&mistake.id);
                assert!((0.0..=1.0).contains(&support), "{}", mistake.id);
                let place = source.line(&mistake.id);
                assert!(place.is_none_or(|place| place.span.line > 0), "{}", mistake.id);
            }
        }
    }
    assert_eq!(read("", "").support("no-such-mistake"), 0.5);
}

fn by_use(uniforms: &str, position: &str) -> Vec<(String, Role)> {
    let vertex = format!(
        "#version 330 core\nin vec3 position; {uniforms}\nvoid main() {{ vec4 p = vec4(position, 1.0); gl_Position = {position}; }}"
    );
    let fragment = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }";
    let (vertex, fragment) = (parsed(&vertex, Stage::Vertex), parsed(fragment, Stage::Fragment));
    let mut names = NamesFile::default();
    let _ = Analysis::with_roles_by_use(&shader(&vertex), &shader(&fragment), &mut names);
    names.by_use.into_iter().collect()
}

#[test]
fn unnamed_matrices_are_identified_by_their_product() {
    let found = by_use("uniform mat4 camera, transform;", "camera * transform * p");
    assert_eq!(found, [("camera".to_owned(), Role::ViewProjection), ("transform".to_owned(), Role::Model)]);
    let found = by_use("uniform mat4 one, two, three;", "one * (two * (three * p))");
    // By their names: one, three, two.
    let roles: Vec<Role> = found.into_iter().map(|(_, role)| role).collect();
    assert_eq!(roles, [Role::Projection, Role::Model, Role::View]);
    assert_eq!(by_use("uniform mat4 all;", "all * p"), [("all".to_owned(), Role::ModelViewProjection)]);
    // Roles from names remain, in any order: the order may be the mistake.
    assert_eq!(by_use("uniform mat4 P, V, M;", "M * V * P * p"), []);
    assert_eq!(by_use("uniform mat4 M, thing;", "M * thing * p"), []);
    // A view matrix has the projection only if nothing else has it, and never under the exercises' own name.
    let of_view = |role| [("view".to_owned(), role)];
    assert_eq!(by_use("uniform mat4 view;", "view * p"), of_view(Role::ViewProjection));
    assert_eq!(by_use("uniform mat4 view, model;", "view * model * p"), of_view(Role::ViewProjection));
    assert_eq!(by_use("uniform mat4 view, model, projection;", "view * model * p"), []);
    assert_eq!(by_use("uniform mat4 V, M;", "V * M * p"), []);
    assert_eq!(by_use("uniform mat4 one, two;", "one * two * two * one * p"), []);
    assert_eq!(by_use("", "p"), []);
}

#[test]
fn a_constant_direction_is_a_sun_unless_named_a_position() {
    let sun = |head: &str, body: &str| {
        let body = format!("{body}\nFragColor = vec4(max(dot(normalize(v_normal), L), 0.0));");
        fragment(head, &body).constants()
    };
    let found = sun("", "vec3 L = normalize(vec3(0.0, 3.0, 4.0));").sun.unwrap();
    assert!((found.to_light - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-6 && !found.in_view);
    assert!(sun("const vec3 sunDir = vec3(1.0, 0.0, 0.0);", "vec3 L = -sunDir;").sun.unwrap().to_light.x < -0.9);
    assert_eq!(sun("", "vec3 lightPos = vec3(0.0, 3.0, 4.0); vec3 L = normalize(lightPos);").sun, None);
    assert_eq!(sun("", "vec3 L = normalize(vec3(0.0, 3.0, 4.0) - world_position);").sun, None);
    assert_eq!(sun("uniform vec3 lightDir;", "vec3 L = normalize(-lightDir);").points_to_light, Some(false));
    assert_eq!(sun("uniform vec3 lightDir;", "vec3 L = normalize(lightDir);").points_to_light, Some(true));
}

/// Returns the ids of mistakes in the string literals of a file: kebab-case words of letters that are not ids of texts.
fn ids(text: &str) -> impl Iterator<Item = &str> {
    let is_word = |word: &str| !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase());
    let is_id = move |word: &&str| word.contains('-') && !word.starts_with("check-") && word.split('-').all(is_word);
    text.split('"').skip(1).step_by(2).filter(is_id)
}

#[test]
fn every_id_in_the_sources_is_in_the_catalogue() {
    let source = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let is_known = |id: &str| crate::mistakes::find(id).is_some();
    // The ids of peculiarities, and of a value that no mistake explains.
    let others = ["lookup-mixed", "diffuse-in-steps", "light-limited-at-vertices", crate::WRONG_VALUE];
    let (mut found, mut unknown) = (0, Vec::new());
    for folder in ["source", "cause", "check", "panorama"] {
        for entry in std::fs::read_dir(source.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.ends_with("tests.rs") || path.is_dir() {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            for id in ids(&text) {
                found += 1;
                if !is_known(id) && !others.contains(&id) {
                    unknown.push(format!("{}: {id}", path.display()));
                }
            }
        }
    }
    assert!(found > 60, "{found}");
    assert!(unknown.is_empty(), "{unknown:#?}");
}
