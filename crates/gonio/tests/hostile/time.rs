//! Programs that run for ever, or for very long.

use crate::case::{Answer, Case};

pub fn cases() -> Vec<Case> {
    let answer = Answer::wrong("ex04");
    let mut cases = Vec::new();
    let loops = [
        ("while", "while (true) { X += 1.0; }"),
        ("for", "for (;;) { X += 1.0; }"),
        ("do", "do { X += 1.0; } while (X > -1.0);"),
        ("a step of 0", "for (int i = 0; i < 10; i += 0) { X += 1.0; }"),
        ("a billion", "for (int i = 0; i < 1000000000; ++i) { X += sin(X + float(i)); }"),
        ("loops in loops", "for (float a = 0.0; a < 1e5; ++a) for (float b = 0.0; b < 1e5; ++b) { X += sin(a * b); }"),
    ];
    for (name, body) in loops {
        let vertex = answer.vertex_with("", &body.replace('X', "gl_Position.x"));
        cases.push(
            Case::new("time", format!("{name} in the vertex shader"), "ex04").pair(vertex, answer.fragment.clone()),
        );
        let fragment = answer.fragment_with("", &body.replace('X', "FragColor.x"));
        cases.push(
            Case::new("time", format!("{name} in the fragment shader"), "ex04").pair(answer.vertex.clone(), fragment),
        );
    }
    let mut add = |name: &str, declarations: &str, statement: &str| {
        let fragment = answer.fragment_with(declarations, statement);
        cases.push(Case::new("time", name, "ex04").pair(answer.vertex.clone(), fragment));
    };
    add("recursion", "float f(float x) { return f(x + 1.0); }", "FragColor.x += f(0.0);");
    add(
        "recursion of two",
        "float g(float x);\nfloat f(float x) { return g(x); }\nfloat g(float x) { return f(x); }",
        "FragColor.x += f(0.0);",
    );
    let doubling: String =
        (1..40).map(|i| format!("float f{i}(float x) {{ return f{0}(x) + f{0}(x + 1.0); }}\n", i - 1)).collect();
    add("functions that double", &format!("float f0(float x) {{ return x; }}\n{doubling}"), "FragColor.x += f39(0.0);");
    let overloads: String = ["float", "vec2", "vec3", "vec4", "int", "uint", "mat2", "mat3", "mat4", "bool"]
        .iter()
        .flat_map(|a| {
            ["float", "vec2", "vec3", "vec4", "int", "uint", "mat2", "mat3"]
                .map(|b| format!("float f({a} x, {b} y) {{ return 1.0; }}\n"))
        })
        .collect();
    let nested = (0..14).fold("1".to_owned(), |inner, _| format!("f({inner}, {inner})"));
    add("overloads within overloads", &overloads, &format!("FragColor.x += {nested};"));
    add("many overloads", &overloads, &format!("FragColor.x += {}1.0{};", "f(1, ".repeat(200), ")".repeat(200)));
    let products = "M * ".repeat(20_000);
    add("twenty thousand products", "uniform mat4 M;", &format!("FragColor = {products} FragColor;"));
    cases
}
