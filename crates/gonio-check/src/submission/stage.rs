//! Determines the stage of a text from its name, and from its content if the name is unclear or contradicts it.

use crate::words::words_of;
use gonio_glsl::Stage;
use gonio_language::tr;

/// Returns the stage that a word names.
pub(super) fn stage_of_word(word: &str) -> Option<Stage> {
    match word {
        "vertex" | "vertices" | "vert" | "vs" | "vsh" | "vshader" | "vertexshader" | "vertshader" | "vshad"
        | "sommet" | "sommets" | "vtx" | "vertexsource" | "vssrc" | "vssource" | "vertsrc" => Some(Stage::Vertex),
        "fragment" | "fragments" | "frag" | "fs" | "fsh" | "fshader" | "fragmentshader" | "fragshader" | "pixel"
        | "pixelshader" | "ps" | "fshad" | "frg" | "fragmentsource" | "fssrc" | "fssource" | "fragsrc" => {
            Some(Stage::Fragment)
        }
        _ => None,
    }
}

/// The stage that a name suggests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StageHint {
    Nothing,
    One(Stage),
    /// Words for both stages.
    Both,
}

fn join(hint: impl Iterator<Item = Stage>) -> StageHint {
    hint.fold(StageHint::Nothing, |so_far, stage| match so_far {
        StageHint::Nothing => StageHint::One(stage),
        StageHint::One(other) if other == stage => so_far,
        _ => StageHint::Both,
    })
}

/// Returns the stage that a name suggests: that of a file (with its folders) or a variable.
///
/// The extension takes precedence, then the words of the name, then single letters, then the folder.
pub(super) fn hint_from_name(name: &str) -> StageHint {
    let path = name.replace('\\', "/");
    let (folder, base) = path.rsplit_once('/').unwrap_or(("", &path));
    if let Some((_, ending)) = base.rsplit_once('.')
        && let Some(stage) = stage_of_word(&ending.to_lowercase())
    {
        // `vertex.frag`: let the content decide.
        return match hint_from_words(base) {
            StageHint::Both => StageHint::Both,
            _ => StageHint::One(stage),
        };
    }
    match hint_from_words(base) {
        StageHint::Nothing => hint_from_words(folder.rsplit('/').next().unwrap_or_default()),
        hint => hint,
    }
}

fn hint_from_words(name: &str) -> StageHint {
    match hint_from_whole_words(name) {
        StageHint::Nothing => hint_from_letters(name),
        hint => hint,
    }
}

/// Returns the stage that the letters `v` and `f` suggest. They are weak evidence, because `light v2` is a second
/// version.
fn hint_from_letters(name: &str) -> StageHint {
    join(words_of(name).iter().filter_map(|word| match word.as_str() {
        "v" => Some(Stage::Vertex),
        "f" => Some(Stage::Fragment),
        _ => None,
    }))
}

fn hint_from_whole_words(name: &str) -> StageHint {
    let words = words_of(name);
    let hint = join(words.iter().filter_map(|word| stage_of_word(word)));
    if hint != StageHint::Nothing {
        return hint;
    }
    // Joined words: `vertexlighting`, `myfragshader`.
    join(words.iter().flat_map(|word| {
        let vertex = word.contains("vertex") || word.starts_with("vert") && !word.starts_with("vertical");
        let fragment = word.contains("frag");
        vertex.then_some(Stage::Vertex).into_iter().chain(fragment.then_some(Stage::Fragment))
    }))
}

/// Whether only a single letter of a name suggests its stage.
fn has_only_letter_hint(name: &str) -> bool {
    let path = name.replace('\\', "/");
    let base = path.rsplit('/').next().unwrap_or_default();
    let by_ending = base.rsplit('.').any(|part| stage_of_word(&part.to_lowercase()).is_some());
    !by_ending && hint_from_whole_words(base) == StageHint::Nothing && hint_from_letters(base) != StageHint::Nothing
}

/// The evidence in a text for a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Evidence {
    /// It contains what only a vertex shader can contain.
    pub(super) vertex: bool,
    /// It contains what only a fragment shader can contain.
    pub(super) fragment: bool,
    /// It contains what fragment shaders usually contain.
    pub(super) rather_fragment: bool,
}

/// Collects the evidence in a text without comments.
pub(super) fn evidence(code: &str) -> Evidence {
    let mut found = Evidence::default();
    let mut previous = ["", ""];
    for word in identifiers(code) {
        match word {
            "gl_Position" | "gl_PointSize" | "gl_VertexID" | "gl_InstanceID" | "attribute" | "gl_Vertex"
            | "ftransform" => {
                found.vertex = true;
            }
            "gl_FragColor" | "gl_FragData" | "gl_FragCoord" | "gl_FragDepth" | "gl_FrontFacing" | "gl_PointCoord"
            | "discard" | "dFdx" | "dFdy" | "fwidth" => found.fragment = true,
            "texture" | "texture2D" | "textureCube" => found.rather_fragment = true,
            _ if previous[0] == "out" && matches!(previous[1], "vec4" | "vec3") => found.rather_fragment = true,
            _ => {}
        }
        previous = [previous[1], word];
    }
    found
}

/// Returns the stage of a text: that of its name, unless the content clearly contradicts it, which gives a warning.
pub(super) fn determine(shown: &str, name: &str, code: &str) -> (Option<Stage>, Option<String>) {
    let found = evidence(code);
    let by_content = match (found.vertex, found.fragment) {
        (true, false) => Some(Stage::Vertex),
        (false, true) => Some(Stage::Fragment),
        _ => None,
    };
    if has_only_letter_hint(name) {
        let by_all = by_content.or(found.rather_fragment.then_some(Stage::Fragment));
        if by_all.is_some() {
            return (by_all, None);
        }
    }
    match (hint_from_name(name), by_content) {
        (StageHint::One(named), Some(content))
            if named != content && !(named == Stage::Fragment && found.rather_fragment) =>
        {
            let because = if content == Stage::Vertex {
                "gl_Position"
            } else {
                tr!("check-submission-what-only-a-fragment-shader-has")
            };
            let warning = tr!(
                "check-submission-is-named-like-a-shader-but",
                shown = shown,
                named = named.to_string(),
                because = because,
                content = content.to_string()
            );
            (Some(content), Some(warning))
        }
        (StageHint::One(named), _) => (Some(named), None),
        (_, Some(content)) => (Some(content), None),
        (_, None) => {
            let stage = if found.vertex {
                Some(Stage::Vertex)
            } else if found.rather_fragment {
                Some(Stage::Fragment)
            } else {
                None
            };
            (stage, None)
        }
    }
}

/// Returns the identifiers of a source, in order.
pub(super) fn identifiers(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_'))
}

/// Whether a text without comments looks like GLSL, and whether it has a `main`.
pub(super) fn looks_like_glsl(code: &str) -> (bool, bool) {
    let (mut main, mut glsl) = (false, code.contains("#version"));
    let mut previous = "";
    for word in identifiers(code) {
        main |= word == "main" && previous == "void";
        glsl |= word.starts_with("gl_")
            || matches!(word, "vec2" | "vec3" | "vec4" | "mat3" | "mat4" | "uniform" | "varying" | "sampler2D");
        previous = word;
    }
    (glsl, main)
}

/// Replaces comments by spaces; all other characters keep their line and column.
pub fn without_comments(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match (c, chars.peek()) {
            ('/', Some('/')) => {
                code.push(' ');
                while let Some(c) = chars.next_if(|&c| c != '\n') {
                    code.push(' ');
                    // A backslash continues the comment on the next line.
                    if c == '\\' && chars.next_if_eq(&'\n').is_some() {
                        code.push('\n');
                    }
                }
            }
            ('/', Some('*')) => {
                chars.next();
                code.push_str("  ");
                let mut star = false;
                for c in chars.by_ref() {
                    code.push(if c == '\n' { '\n' } else { ' ' });
                    if star && c == '/' {
                        break;
                    }
                    star = c == '*';
                }
            }
            _ => code.push(c),
        }
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_determine_the_stage() {
        use Stage::{Fragment, Vertex};
        use StageHint::{Both, Nothing, One};
        for (name, hint) in [
            ("shader.vert", One(Vertex)),
            ("shader.frag", One(Fragment)),
            ("phong.vs", One(Vertex)),
            ("phong.fs", One(Fragment)),
            ("a.vsh", One(Vertex)),
            ("a.FSH", One(Fragment)),
            ("vertex.txt", One(Vertex)),
            ("FragmentShader.txt", One(Fragment)),
            ("shader.vert.txt", One(Vertex)),
            ("a.frag.glsl", One(Fragment)),
            ("basic.vertexshader", One(Vertex)),
            ("basic.fragmentshader", One(Fragment)),
            ("shader_vs.glsl", One(Vertex)),
            ("fsPhong.glsl", One(Fragment)),
            ("vShader", One(Vertex)),
            ("fshader", One(Fragment)),
            ("phong-v.glsl", One(Vertex)),
            ("ex04F.glsl", One(Fragment)),
            ("vertexshader", One(Vertex)),
            ("myfragshader.glsl", One(Fragment)),
            ("work/vertex/phong.glsl", One(Vertex)),
            ("work\\frag\\phong.glsl", One(Fragment)),
            ("vertex/phong.frag", One(Fragment)),
            ("pixel.hlsl", One(Fragment)),
            ("vertex.frag", Both),
            ("vert_frag.glsl", Both),
            ("convert.glsl", Nothing),
            ("vertical.glsl", Nothing),
            ("phong.glsl", Nothing),
            ("", Nothing),
            ("objectVertexShaderSource", One(Vertex)),
            ("sourceF", One(Fragment)),
            ("FRAGMENT_SHADER_SRC", One(Fragment)),
        ] {
            assert_eq!(hint_from_name(name), hint, "{name}");
        }
    }

    #[test]
    fn content_decides_where_names_do_not() {
        use Stage::{Fragment, Vertex};
        for (name, text, stage, warned) in [
            ("a.glsl", "void main(){gl_Position=vec4(0);}", Some(Vertex), false),
            ("a.glsl", "out vec4 c; void main(){c=vec4(0);}", Some(Fragment), false),
            ("a.glsl", "out vec4 c; void main(){gl_Position=c;}", Some(Vertex), false),
            ("a.glsl", "void main(){gl_FragColor=vec4(0);}", Some(Fragment), false),
            ("a.glsl", "void main(){if(x)discard;}", Some(Fragment), false),
            ("a.glsl", "void main(){c=texture(t,v);}", Some(Fragment), false),
            ("a.glsl", "// gl_Position\nout vec4 c;void main(){}", Some(Fragment), false),
            ("a.glsl", "/* gl_FragColor \n*/void main(){}", None, false),
            ("vertex.frag", "void main(){gl_Position=vec4(0);}", Some(Vertex), false),
            ("a.frag", "attribute vec3 p;void main(){gl_Position=vec4(0);}", Some(Vertex), true),
            ("a.vert", "void main(){gl_FragColor=vec4(0);}", Some(Fragment), true),
            // A version is not a stage.
            ("final v2.glsl", "out vec4 c;void main(){c=vec4(0);}", Some(Fragment), false),
            ("light_v2.txt", "void main(){gl_FragColor=vec4(0);}", Some(Fragment), false),
            ("final v2.glsl", "void main(){gl_Position=vec4(0);}", Some(Vertex), false),
            ("phong_f.glsl", "void main(){gl_Position=vec4(0);}", Some(Vertex), false),
            ("phong_v.glsl", "in vec3 p;void main(){}", Some(Vertex), false),
            ("phong_v.frag", "void main(){}", Some(Fragment), false),
            // The compiler reports errors inside a stage.
            ("a.vert", "out vec4 c;void main(){}", Some(Vertex), false),
            ("a.frag", "out vec4 c;void main(){gl_Position=c;}", Some(Fragment), false),
        ] {
            let (found, warning) = determine(name, name, &without_comments(text));
            assert_eq!((found, warning.is_some()), (stage, warned), "{name}: {text}");
        }
    }

    #[test]
    fn comments_are_blanked_and_positions_kept() {
        assert_eq!(without_comments("a//b\nc/*d\ne*/f/"), "a   \nc   \n   f/");
        assert_eq!(without_comments("a//b\\\nc\nd"), "a    \n \nd");
        assert_eq!(without_comments("/*"), "  ");
    }
}
