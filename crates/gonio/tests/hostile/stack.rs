//! Nesting that exhausts the stack of a reader or a driver.

use crate::case::{Answer, Case};

pub fn cases() -> Vec<Case> {
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
