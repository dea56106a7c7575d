//! Texts that imitate a verdict.

use crate::case::{Answer, Case, Fill};
use crate::common::{EVIL, evil_line};

pub fn cases() -> Vec<Case> {
    let answer = Answer::wrong("ex04");
    let (evil, exercise) = (evil_line(), answer.exercise);
    let mut cases = Vec::new();
    let mut add = |name: &str, vertex: String, fragment: String| {
        cases.push(Case::new("forging", name, exercise).pair(vertex, fragment));
    };
    let (vertex, fragment) = (&answer.vertex, &answer.fragment);
    let in_fragment =
        |declarations: &str, statement: &str| (vertex.clone(), answer.fragment_with(declarations, statement));
    for (name, declarations, statement) in [
        ("#error", format!("#error {evil}"), String::new()),
        ("#line", format!("#line 1 \"{evil}\"\n#error x"), String::new()),
        ("a #line of another file", "#line 99999 7\n#error x".to_owned(), String::new()),
        ("a #line beyond all", "#line 2147483647 2147483647\n\n\n#error x".to_owned(), String::new()),
        ("a #line below zero", "#line -5\n#error x".to_owned(), String::new()),
        ("#pragma", format!("#pragma {evil}"), String::new()),
        ("#extension", format!("#extension {evil} : require"), String::new()),
        ("#include", format!("#include \"{evil}\""), String::new()),
        ("an unknown directive", format!("#{evil}"), String::new()),
        ("a name", String::new(), format!("float {evil} = 1.0;")),
        ("an unknown name", String::new(), "FragColor.x += ex04__correct__all_of_it;".to_owned()),
        ("an unknown function", String::new(), format!("FragColor.x += f({evil});")),
        ("a string", String::new(), format!("\"{evil}\";")),
        ("a comment", format!("/* {evil} */"), String::new()),
        ("a comment that does not end", String::new(), format!("/* {evil}")),
        ("a macro", format!("#define {evil} 1"), String::new()),
        ("a driver's line", "#error \n0:1(1): error: \nex04  correct: all of it".to_owned(), String::new()),
        ("a verdict in its own line", "ex04  correct: all of it".to_owned(), String::new()),
        ("a continued line", "#error a\\\nex04  correct: all of it\\\n".to_owned(), String::new()),
        (
            "a uniform's name",
            "uniform vec3 correct_all_of_it_;".to_owned(),
            "FragColor.xyz += correct_all_of_it_;".to_owned(),
        ),
    ] {
        let (vertex, fragment) = in_fragment(&declarations, &statement);
        add(name, vertex, fragment);
    }
    let quoted = |text: String| text.replace("mat3(M) * normal);", &format!("mat3(M) * normal); // {evil}"));
    add("a quoted line", quoted(vertex.clone()), fragment.clone());
    add(
        "a quoted line that is long",
        vertex.replace("mat3(M)", &format!("mat3(M) /* {} */", "x".repeat(100_000))),
        fragment.clone(),
    );
    let bidi = "mat3(M) /* \u{202e} } \u{2066}if (isRight)\u{2069} \u{2066} begin */";
    add("text turned around", vertex.replace("mat3(M)", bidi), fragment.clone());
    add("letters that look alike", vertex.replace("v_normal", "v_n\u{43e}rmal"), fragment.clone());
    let key: String = evil.chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect();
    for (name, toml) in [
        ("a key of names.toml", format!("[names]\n\"{key}\" = \"position\"\n")),
        ("a value of names.toml", format!("[names]\nposition = \"{key}\"\n")),
        ("names.toml that is none", format!("{evil}\n")),
        ("names.toml of tables", format!("{}x = 1\n", "[a.b]\n[[c]]\n".repeat(2000))),
        ("names.toml that is deep", format!("a = {}{}\n", "[".repeat(50_000), "]".repeat(50_000))),
        ("names.toml with deep keys", format!("{}a = 1\n", "a.".repeat(50_000))),
    ] {
        cases.push(
            Case::new("forging", name, exercise)
                .pair(vertex.clone(), fragment.clone())
                .file("names.toml", Fill::Bytes(toml.into())),
        );
    }
    let broken = answer.fragment_with("", "FragColor.x += nothing;");
    for (name, file) in [
        ("a file's name", format!("a{EVIL}")),
        ("a file's name that is a verdict", "ex04  correct: all of it\nx".to_owned()),
        ("a file's name of blanks", "   ".to_owned()),
        ("a file's name that is turned around", "a\u{202e}garf.".to_owned()),
    ] {
        let case =
            Case::new("forging", name, exercise).file(format!("{file}.vert"), Fill::Bytes(vertex.clone().into()));
        cases.push(case.file(format!("{file}.frag"), Fill::Bytes(broken.clone().into())));
    }
    // This answer is correct, so the verdict may say so.
    let right = Answer::right("ex04");
    let fragment = right.fragment_with(&format!("// {evil}"), "");
    cases.push(
        Case::new("forging", "a comment in a right answer", exercise).pair(right.vertex, fragment).may_be_right(),
    );
    cases
}
