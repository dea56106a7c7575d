//! Texts that use up the stack, the memory or the time of a reader or a driver.

use crate::case::{Answer, Case, Fill};

/// Nesting that exhausts the stack of a reader or a driver.
pub fn stack() -> Vec<Case> {
    let answer = Answer::wrong("ex07");
    let mut cases = Vec::new();
    let mut add = |name: String, declarations: String, statement: String| {
        let fragment = answer.fragment_with(&declarations, &statement);
        cases.push(Case::new("stack", &name, answer.exercise).pair(answer.vertex.clone(), fragment));
    };
    for depth in [300, 20_000] {
        let nested = |open: &str, middle: &str, close: &str| open.repeat(depth) + middle + &close.repeat(depth);
        let put = |expression: String| format!("FragColor.x += {expression};");
        add(format!("{depth} parentheses"), String::new(), put(nested("(", "1.0", ")")));
        add(format!("{depth} minus signs"), String::new(), put(nested("- ", "1.0", "")));
        add(
            format!("{depth} negations"),
            String::new(),
            format!("if ({}) FragColor.x += 1.0;", nested("!", "true", "")),
        );
        add(format!("{depth} braces"), String::new(), nested("{", "FragColor.x += 1.0;", "}"));
        add(format!("{depth} ifs"), String::new(), nested("if (FragColor.x > 0.0) ", "FragColor.x += 1.0;", ""));
        add(
            format!("{depth} else ifs"),
            String::new(),
            nested("if (FragColor.x > 2.0) ; else ", "FragColor.x += 1.0;", ""),
        );
        add(format!("{depth} ternaries"), String::new(), put(nested("FragColor.y > 2.0 ? 1.0 : ", "1.0", "")));
        add(format!("{depth} calls"), String::new(), put(nested("abs(", "1.0", ")")));
        add(format!("{depth} constructors"), String::new(), put(nested("float(", "1.0", ")")));
        add(format!("{depth} assignments"), "float a;".into(), nested("a = ", "1.0;", ""));
        add(format!("{depth} commas"), String::new(), put(format!("({}1.0)", "1.0, ".repeat(depth))));
        add(format!("{depth} sums"), String::new(), put(nested("1.0 + ", "1.0", "")));
        add(format!("{depth} indices"), "int a[2];".into(), put(format!("float({})", nested("a[", "0", "]"))));
        add(format!("{depth} fors"), String::new(), nested("for (; false; ) ", "FragColor.x += 1.0;", ""));
        add(
            format!("{depth} conditions"),
            format!("{}\n{}", "#if 1\n".repeat(depth), "#endif\n".repeat(depth)),
            String::new(),
        );
        add(
            format!("{depth} parentheses in a condition"),
            format!("#if {}\n#endif", nested("(", "1", ")")),
            String::new(),
        );
    }
    let structs: String = (1..400).map(|i| format!("struct S{i} {{ S{} a; }};\n", i - 1)).collect();
    add(
        "structs within structs".into(),
        format!("struct S0 {{ float a; }};\n{structs}"),
        "S399 s; FragColor.x += 1.0;".into(),
    );
    let functions: String =
        (1..3000).map(|i| format!("float f{i}(float x) {{ return f{}(x) + 1.0; }}\n", i - 1)).collect();
    add(
        "a chain of functions".into(),
        format!("float f0(float x) {{ return x; }}\n{functions}"),
        "FragColor.x += f2999(0.0);".into(),
    );
    cases
}

/// Texts that need more memory than the machine has.
pub fn memory() -> Vec<Case> {
    let answer = Answer::wrong("ex04");
    let mut cases = Vec::new();
    let mut add = |name: &str, declarations: String, statement: String| {
        let fragment = answer.fragment_with(&declarations, &statement);
        cases.push(Case::new("memory", name, answer.exercise).pair(answer.vertex.clone(), fragment));
    };
    // Each macro is two of the one before.
    let doubling = |join: &str| -> String {
        (1..40).map(|i| format!("#define M{i} M{}{join}M{}\n", i - 1, i - 1)).collect::<String>()
    };
    add("macros that double", format!("#define M0 1.0\n{}", doubling(" + ")), "FragColor.x += M39;".into());
    add(
        "macros that double in a condition",
        format!("#define M0 1\n{}#if M39 > 0\n#endif", doubling(" + ")),
        String::new(),
    );
    add("macros that double in a declaration", format!("#define M0 float a;\n{}", doubling(" ")), "M39".into());
    let calls: String = (1..40).map(|i| format!("#define F{i}(x) F{}(F{}(x))\n", i - 1, i - 1)).collect();
    add(
        "macros of functions that double",
        format!("#define F0(x) (x + x)\n{calls}"),
        "FragColor.x += F39(1.0);".into(),
    );
    add(
        "a macro of its own argument",
        "#define F(x) x x\n".into(),
        format!("{}FragColor.x;{}", "F(".repeat(40), ")".repeat(40)),
    );
    add("a macro of itself", "#define A B B\n#define B A A\n".into(), "FragColor.x += A;".into());
    add(
        "a macro with a million words",
        format!("#define W {}\n", "1.0 + ".repeat(1_000_000)),
        "FragColor.x += W 1.0;".into(),
    );
    add(
        "pasted names",
        (0..22).fold("#define P0 a\n".to_owned(), |all, i| all + &format!("#define P{} P{i} ## P{i}\n", i + 1)),
        "FragColor.x += P22;".into(),
    );
    for elements in ["1000000", "268435456", "2147483647", "1 << 30", "-1", "0", "99999999999999999999"] {
        add(
            &format!("an array of {elements}"),
            format!("float a[{elements}];"),
            "a[int(FragColor.x)] = 1.0; FragColor.x += a[0];".into(),
        );
    }
    add("a uniform array", "uniform mat4 a[1000000];".into(), "FragColor += a[int(FragColor.x)][0];".into());
    add(
        "an array of structs of arrays",
        "struct S { vec4 a[4096]; };\nstruct T { S s[4096]; };".into(),
        "T t; FragColor += t.s[int(FragColor.x)].a[0];".into(),
    );
    add("an array of arrays", "float a[9999][9999][9999];".into(), "FragColor.x += a[0][0][int(FragColor.x)];".into());
    add(
        "a constant array",
        format!("const float a[200000] = float[]({}1.0);", "1.0, ".repeat(199_999)),
        "FragColor.x += a[int(FragColor.y)];".into(),
    );
    add(
        "a loop to be unrolled",
        String::new(),
        "for (int i = 0; i < 1000000; ++i) { FragColor.x += sin(FragColor.y); }".into(),
    );
    add("loops to be unrolled", String::new(), "for (int i = 0; i < 64; ++i) for (int j = 0; j < 64; ++j) for (int k = 0; k < 64; ++k) FragColor[i % 3] += sin(float(j * k)); ".into());
    add("a long number", String::new(), format!("FragColor.x += {}.0;", "9".repeat(1_000_000)));
    add("a long integer", String::new(), format!("FragColor.x += float({});", "9".repeat(1_000_000)));
    add("a long name", String::new(), format!("float {0} = 1.0; FragColor.x += {0};", "a".repeat(1_000_000)));
    add(
        "a hundred thousand variables",
        (0..100_000).map(|i| format!("float v{i};\n")).collect(),
        "FragColor.x += v0;".into(),
    );
    add(
        "a thousand uniforms",
        (0..1000).map(|i| format!("uniform mat4 u{i};\n")).collect(),
        (0..1000).map(|i| format!("FragColor += u{i}[0];\n")).collect(),
    );
    add(
        "a thousand samplers",
        (0..1000).map(|i| format!("uniform samplerCube s{i};\n")).collect(),
        (0..1000).map(|i| format!("FragColor += texture(s{i}, vec3(1.0));\n")).collect(),
    );
    add(
        "a thousand inputs",
        (0..1000).map(|i| format!("in vec4 i{i};\n")).collect(),
        (0..1000).map(|i| format!("FragColor += i{i};\n")).collect(),
    );
    add(
        "a hundred outputs",
        (0..100).map(|i| format!("layout(location = {i}) out vec4 o{i};\n")).collect(),
        "o99 = FragColor;".into(),
    );
    add("a location beyond all", "layout(location = 2147483647) out vec4 o;".into(), "o = FragColor;".into());
    add(
        "a hundred thousand statements",
        String::new(),
        "FragColor.x = sin(FragColor.x) * FragColor.y;\n".repeat(100_000),
    );
    let varyings: String = (0..500).map(|i| format!("out mat4 w{i};\n")).collect();
    let written: String = (0..500).map(|i| format!("w{i} = M;\n")).collect();
    cases.push(
        Case::new("memory", "five hundred varyings", answer.exercise)
            .pair(answer.vertex_with(&varyings, &written), answer.fragment.clone()),
    );
    let literals = Fill::Repeat(
        b"int main() {\n".to_vec(),
        b"  const char *a = \"#version 330 core\\nvoid main() {}\\n\";\n".to_vec(),
        300_000,
        b"}\n".to_vec(),
    );
    cases.push(Case::new("memory", "a program of 300,000 string literals", answer.exercise).file("main.cpp", literals));
    cases
}

/// Programs that run for ever, or for very long.
pub fn time() -> Vec<Case> {
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
