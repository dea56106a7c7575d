//! Texts that need more memory than the machine has.

use crate::case::{Answer, Case, Fill};

pub fn cases() -> Vec<Case> {
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
