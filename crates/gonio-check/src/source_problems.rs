//! Problems that gonio's own front end finds in shaders, without a driver, at the student's own lines; and the variables that it
//! knows there.

use crate::submission::StageText;
use gonio_glsl::{Checked, Parsed, Problem, Severity, Stage, Storage, SymbolKind, TokenRange, Type};

/// A position in a student's file: line and column from 1, the column in characters.
pub type LineAndColumn = [u32; 2];

/// A problem at a range of a student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceProblem {
    /// Its severity.
    pub severity: Severity,
    /// Its code in kebab-case.
    pub code: &'static str,
    /// The file.
    pub file: String,
    /// Its first character.
    pub start: LineAndColumn,
    /// The character after its last one.
    pub end: LineAndColumn,
    /// One sentence.
    pub message: String,
    /// Advice.
    pub help: Option<String>,
    /// The place of a misspelt name, and the name that was probably meant.
    pub renaming: Option<SourceRenaming>,
}

/// A change of one word of a student's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceRenaming {
    /// Its first character.
    pub start: LineAndColumn,
    /// The character after its last one.
    pub end: LineAndColumn,
    /// The word in its place.
    pub name: String,
}

/// A variable or function of a shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceSymbol {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: SymbolKind,
    /// Its storage.
    pub storage: Storage,
    /// Its type, or that which a function returns; `None` if unknown.
    pub glsl_type: Option<String>,
    /// The place at which it was asked for: its first character.
    pub start: LineAndColumn,
    /// The character after its last one.
    pub end: LineAndColumn,
}

/// A shader, parsed and checked.
pub struct SourceStage<'a> {
    text: &'a StageText,
    parsed: Parsed,
    checked: Checked,
}

impl<'a> SourceStage<'a> {
    /// Parses and checks a shader.
    #[must_use]
    pub fn new(text: &'a StageText, stage: Stage) -> Self {
        let mut parsed = gonio_glsl::parse(&text.text);
        let checked = gonio_glsl::check(&mut parsed, stage);
        SourceStage { text, parsed, checked }
    }

    /// Its problems, in the order of the text.
    pub fn problems(&self) -> impl Iterator<Item = SourceProblem> {
        self.parsed.problems.iter().chain(&self.checked.problems).map(|problem| self.placed(problem))
    }

    fn placed(&self, problem: &Problem) -> SourceProblem {
        let (file, line, column) = self.text.place(problem.span.line, problem.span.column);
        let start = [line, column];
        let written = self.parsed.text(problem.span);
        let lines = u32::try_from(written.matches('\n').count()).unwrap_or(0);
        // A problem of several lines is shown at its first one.
        let shown = written.lines().next().unwrap_or_default().trim_end();
        let length = u32::try_from(shown.chars().count()).unwrap_or(u32::MAX).max(1);
        let end = if lines == 0 || !shown.is_empty() { [line, column.saturating_add(length)] } else { start };
        let renaming = problem.renaming.as_ref().and_then(|(misspelt, name)| {
            let at = word_in(shown, misspelt)?;
            let start = [line, column.saturating_add(u32::try_from(shown.get(..at)?.chars().count()).ok()?)];
            let end = [line, start[1].saturating_add(u32::try_from(misspelt.chars().count()).ok()?)];
            Some(SourceRenaming { start, end, name: name.clone() })
        });
        SourceProblem {
            severity: problem.severity,
            code: problem.code,
            file: file.to_owned(),
            start,
            end,
            message: problem.message.clone(),
            help: problem.help.clone(),
            renaming,
        }
    }

    /// The variable or function whose name is at a place of a file; `None` if there is none that the shader declares.
    #[must_use]
    pub fn symbol_at(&self, file: &str, at: LineAndColumn) -> Option<SourceSymbol> {
        let place = |tokens: &TokenRange| {
            let token = self.parsed.tokens.get(tokens.first as usize)?;
            let (found, line, column) = self.text.place(token.span.line, token.span.column);
            let length = self.parsed.text(token.span).chars().count();
            let end = column.saturating_add(u32::try_from(length).ok()?);
            let is_here = found == file && line == at[0] && (column..end).contains(&at[1]);
            is_here.then_some(([line, column], [line, end]))
        };
        self.checked.symbols.iter().find_map(|symbol| {
            let (start, end) = std::iter::once(&symbol.declared).chain(&symbol.uses).find_map(place)?;
            Some(SourceSymbol {
                name: symbol.name.clone(),
                kind: symbol.kind,
                storage: symbol.storage,
                glsl_type: symbol.ty.as_ref().map(Type::written),
                start,
                end,
            })
        })
    }
}

/// The byte at which a text has a word as a whole.
fn word_in(text: &str, word: &str) -> Option<usize> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let is_whole = |at: &usize| {
        let (before, after) = (text.get(..*at), text.get(at + word.len()..));
        !before.is_some_and(|text| text.ends_with(is_part)) && !after.is_some_and(|text| text.starts_with(is_part))
    };
    text.match_indices(word).map(|(at, _)| at).find(is_whole)
}

/// The problems of a pair: those of each shader, and those of its interface.
#[must_use]
pub fn pair_problems(vertex: &SourceStage<'_>, fragment: &SourceStage<'_>) -> Vec<SourceProblem> {
    let between = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
    let mut all: Vec<SourceProblem> = vertex.problems().chain(fragment.problems()).collect();
    all.extend(between.iter().map(|problem| fragment.placed(problem)));
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTEX: &str =
        "#version 330 core\nin vec3 position;\nout vec3 é;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";

    #[test]
    fn problems_of_a_pair_have_ranges_in_its_files() {
        let vertex =
            StageText::whole("a.vert", "#version 330 core\nout vec3 v;\nvoid main() { vec3 x = vec2(1.0); v = x }\n");
        let fragment = StageText::whole(
            "a.frag",
            "#version 330 core\nin vec3 w;\nout vec4 c;\nvoid main() { c = vec4(w, 1.0); }\n",
        );
        let [vertex, fragment] =
            [(&vertex, Stage::Vertex), (&fragment, Stage::Fragment)].map(|(t, s)| SourceStage::new(t, s));
        let problems = pair_problems(&vertex, &fragment);
        let errors: Vec<_> = problems.iter().filter(|p| p.severity == Severity::Error).collect();
        assert!(errors.iter().any(|p| p.file == "a.vert" && p.start[0] == 3 && p.end[1] > p.start[1]), "{problems:?}");
        assert!(errors.iter().all(|p| p.end[0] == p.start[0] && p.end > p.start), "{problems:?}");
    }

    #[test]
    fn a_misspelt_name_has_the_place_of_the_word_alone() {
        let code = "#version 330 core\nin vec3 v_n;\nstruct L { vec3 pos; };\nuniform L poss_l;\nout vec4 c;\nvoid main() {\n\
                    vec3 n = normalise(v_n) + poss_l.poss; c = vec4(nn, 1.0) * saturate(n.x); }\n";
        let text = StageText::whole("a.frag", code);
        let stage = SourceStage::new(&text, Stage::Fragment);
        let renamings: Vec<_> = stage.problems().filter_map(|p| p.renaming).collect();
        let at = |column: u32, length: u32, name: &str| SourceRenaming {
            start: [7, column],
            end: [7, column + length],
            name: name.to_owned(),
        };
        assert_eq!(renamings, [at(10, 9, "normalize"), at(34, 4, "pos")]);
    }

    #[test]
    fn a_symbol_is_found_at_its_declaration_and_its_uses() {
        let text = StageText::whole("a.vert", VERTEX.replace('é', "v"));
        let stage = SourceStage::new(&text, Stage::Vertex);
        for at in [[2, 9], [2, 16], [4, 34], [4, 41]] {
            let found = stage.symbol_at("a.vert", at).unwrap_or_else(|| panic!("{at:?}"));
            assert_eq!((found.name.as_str(), found.glsl_type.as_deref()), ("position", Some("vec3")));
            assert_eq!((found.storage, found.end[1] - found.start[1]), (Storage::In, 8));
        }
        for at in [[2, 8], [2, 17], [4, 2], [99, 1]] {
            assert_eq!(stage.symbol_at("a.vert", at), None, "{at:?}");
        }
        assert_eq!(stage.symbol_at("b.vert", [2, 9]), None);
    }
}
