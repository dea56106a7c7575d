//! Splits a file that contains both stages.

use super::stage;
use super::text::{Builder, number};
use crate::words::words_of;
use gonio_glsl::Stage;

/// Returns the vertex and the fragment stage of a text that contains both; `None` if it does not.
pub(super) fn split(text: &str, code: &str) -> Option<(Builder, Builder)> {
    let lines: Vec<&str> = text.lines().collect();
    let code_lines: Vec<&str> = code.lines().collect();
    by_markers(&lines, &code_lines)
        .or_else(|| by_conditions(&lines, &code_lines))
        .or_else(|| by_repetition(&lines, &code_lines))
}

/// Returns the stage that a heading announces: `#shader vertex`, `-- fragment`, `// VERTEX SHADER`, `#pragma vertex`,
/// `[vertex]`, `@vs`.
fn marker(line: &str) -> Option<Stage> {
    let line = line.trim();
    // A heading is short; longer lines are prose or code.
    if line.len() > 80 || !line.starts_with(['#', '/', '-', '@', '[', '=', '*', '%', '!', '<']) {
        return None;
    }
    let mut named = None;
    for word in words_of(line) {
        match stage::stage_of_word(&word) {
            Some(stage) if named.is_none_or(|named| named == stage) => named = Some(stage),
            Some(_) => return None,
            None if matches!(
                word.as_str(),
                "shader"
                    | "type"
                    | "pragma"
                    | "begin"
                    | "stage"
                    | "source"
                    | "code"
                    | "program"
                    | "glsl"
                    | "the"
                    | "file"
            ) => {}
            None => return None,
        }
    }
    named
}

/// Splits sections with headings. The text before the first one belongs to both.
fn by_markers(lines: &[&str], code_lines: &[&str]) -> Option<(Builder, Builder)> {
    let marks: Vec<(usize, Stage)> =
        lines.iter().enumerate().filter_map(|(i, line)| marker(line).map(|stage| (i, stage))).collect();
    let mut stages = (Builder::new(), Builder::new());
    let first = marks.first()?.0;
    for (mark, &(start, stage)) in marks.iter().enumerate() {
        let end = marks.get(mark + 1).map_or(lines.len(), |&(line, _)| line);
        let builder = match stage {
            Stage::Vertex => &mut stages.0,
            Stage::Fragment => &mut stages.1,
        };
        if builder.text.is_empty() && code_lines.iter().take(first).any(|line| !line.trim().is_empty()) {
            builder.push_lines(lines, 0, first);
        }
        builder.push_lines(lines, start + 1, end);
    }
    both_have_main(stages)
}

fn both_have_main(stages: (Builder, Builder)) -> Option<(Builder, Builder)> {
    let has_main = |builder: &Builder| stage::looks_like_glsl(&stage::without_comments(&builder.text)).1;
    (has_main(&stages.0) && has_main(&stages.1)).then_some(stages)
}

/// Splits `#ifdef VERTEX ... #endif #ifdef FRAGMENT ... #endif`, also with `#else`: both stages get the whole text,
/// with their word defined.
fn by_conditions(lines: &[&str], code_lines: &[&str]) -> Option<(Builder, Builder)> {
    let mut defines: [Option<&str>; 2] = [None, None];
    let mut alternative = false;
    for line in code_lines {
        let Some(directive) = line.trim_start().strip_prefix('#') else { continue };
        let directive = directive.trim_start();
        alternative |= directive.starts_with("else");
        if !(directive.starts_with("if") || directive.starts_with("elif")) {
            continue;
        }
        for word in stage::identifiers(directive) {
            let mut stages: Vec<Stage> = words_of(word).iter().filter_map(|w| stage::stage_of_word(w)).collect();
            stages.dedup();
            match stages[..] {
                [Stage::Vertex] => defines[0] = Some(word),
                [Stage::Fragment] => defines[1] = Some(word),
                _ => {}
            }
        }
    }
    let enough = match defines {
        [Some(_), Some(_)] => true,
        [None, None] => false,
        _ => alternative,
    };
    // With only one such word, the other stage is the one without it.
    let mains = code_lines.iter().map(|line| mains_in(line)).sum::<usize>();
    if !enough || mains < 2 {
        return None;
    }
    let version = code_lines.iter().position(|line| is_version(line));
    let with = |define: Option<&str>| {
        let mut builder = Builder::new();
        let head = version.map_or(0, |line| line + 1);
        builder.push_lines(lines, 0, head);
        if let Some(define) = define {
            // The added line gets the position of the `#version` before it.
            builder.push_line(&format!("#define {define} 1"), number(head.max(1)));
        }
        builder.push_lines(lines, head, lines.len());
        builder
    };
    Some((with(defines[0]), with(defines[1])))
}

fn mains_in(code: &str) -> usize {
    let words: Vec<&str> = stage::identifiers(code).collect();
    words.windows(2).filter(|pair| pair[0] == "void" && pair[1] == "main").count()
}

fn is_version(code_line: &str) -> bool {
    code_line.trim_start().strip_prefix('#').is_some_and(|rest| rest.trim_start().starts_with("version"))
}

/// Splits two consecutive shaders at the second `#version`, or after the first `main`.
fn by_repetition(lines: &[&str], code_lines: &[&str]) -> Option<(Builder, Builder)> {
    let versions: Vec<usize> =
        code_lines.iter().enumerate().filter(|(_, line)| is_version(line)).map(|(i, _)| i).collect();
    let cut = match versions[..] {
        [_, second] => second,
        [_] | [] => behind_first_main(code_lines)?,
        _ => return None,
    };
    let (mut first, mut second) = (Builder::new(), Builder::new());
    first.push_lines(lines, 0, cut);
    second.push_lines(lines, cut, lines.len());
    let (first, second) = both_have_main((first, second))?;
    let stage = |builder: &Builder| stage::determine("", "", &stage::without_comments(&builder.text)).0;
    match (stage(&first), stage(&second)) {
        (Some(Stage::Vertex), Some(Stage::Fragment)) => Some((first, second)),
        (Some(Stage::Fragment), Some(Stage::Vertex)) => Some((second, first)),
        _ => None,
    }
}

/// Returns the line after the end of the first `main`.
fn behind_first_main(code_lines: &[&str]) -> Option<usize> {
    let start = code_lines.iter().position(|line| mains_in(line) > 0)?;
    let mut depth = 0i64;
    let mut opened = false;
    for (i, line) in code_lines.iter().enumerate().skip(start) {
        for c in line.chars() {
            match c {
                '{' => (depth, opened) = (depth + 1, true),
                '}' => depth -= 1,
                _ => {}
            }
        }
        if opened && depth <= 0 {
            return Some(i + 1);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn cut(text: &str) -> Option<(String, String)> {
        split(text, &stage::without_comments(text)).map(|(v, f)| (v.text, f.text))
    }

    const V: &str = "in vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }\n";
    const F: &str = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";

    #[test]
    fn marked_sections() {
        for (vertex, fragment) in [
            ("#shader vertex", "#shader fragment"),
            ("//VERTEX", "//FRAGMENT"),
            ("// Vertex shader:", "// Fragment Shader:"),
            ("-- vertex", "-- fragment"),
            ("#pragma vertex", "#pragma fragment"),
            ("#type vertex", "#type pixel"),
            ("[vertex]", "[fragment]"),
            ("@vs", "@fs"),
            ("/**** VERTEX SHADER ****/", "/**** FRAGMENT SHADER ****/"),
            ("//======== vert ========", "//======== frag ========"),
        ] {
            let text = format!("{vertex}\n{V}{fragment}\n{F}");
            assert_eq!(cut(&text), Some((V.to_owned(), F.to_owned())), "{vertex}");
            let turned = format!("{fragment}\n{F}{vertex}\n{V}");
            assert_eq!(cut(&turned), Some((V.to_owned(), F.to_owned())), "{vertex} second");
        }
    }

    #[test]
    fn text_before_the_first_marker_belongs_to_both_stages() {
        let text = format!("#version 330\n//VERTEX\n{V}//FRAGMENT\n{F}");
        assert_eq!(cut(&text), Some((format!("#version 330\n{V}"), format!("#version 330\n{F}"))));
        let comment = format!("// my work\n//VERTEX\n{V}//FRAGMENT\n{F}");
        assert_eq!(cut(&comment), Some((V.to_owned(), F.to_owned())));
    }

    #[test]
    fn conditions_and_repetition() {
        let text = format!("#version 330\n#ifdef VERTEX\n{V}#endif\n#ifdef FRAGMENT\n{F}#endif\n");
        let (vertex, fragment) = cut(&text).unwrap();
        assert!(vertex.starts_with("#version 330\n#define VERTEX 1\n#ifdef VERTEX\nin vec3 p;"), "{vertex}");
        assert!(fragment.starts_with("#version 330\n#define FRAGMENT 1\n#ifdef VERTEX\n"), "{fragment}");
        let text = format!("#if defined(VERTEX_SHADER)\n{V}#else\n{F}#endif\n");
        let (vertex, fragment) = cut(&text).unwrap();
        assert!(vertex.starts_with("#define VERTEX_SHADER 1\n#if"), "{vertex}");
        assert_eq!(fragment, text);

        let text = format!("#version 330\n{V}\n#version 330\n{F}");
        assert_eq!(cut(&text), Some((format!("#version 330\n{V}\n"), format!("#version 330\n{F}"))));
        assert_eq!(cut(&format!("{F}{V}")), Some((V.to_owned(), F.to_owned())));
    }

    #[test]
    fn one_stage_stays_whole() {
        for text in [V, F, "", "// vertex shader\nvoid main(){}\n", "#version 330\n#version 330\nvoid main(){}\n"] {
            assert_eq!(cut(text), None, "{text}");
        }
        // A heading and a comment about the other stage are not sections.
        assert_eq!(cut(&format!("// Vertex shader\n{V}// fragment shader\n// has its own file\n")), None);
    }

    #[test]
    fn lines_keep_their_positions() {
        let text = format!("#shader vertex\n{V}#shader fragment\n{F}");
        let (vertex, fragment) = split(&text, &stage::without_comments(&text)).unwrap();
        assert_eq!(vertex.finish("f").place(2, 15), ("f", 3, 15));
        assert_eq!(fragment.finish("f").place(1, 1), ("f", 5, 1));
    }
}
