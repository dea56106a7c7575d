//! Translates a student's shader to `#version 330 core` or `#version 300 es`, preserving its lines.

mod casts;
mod declarations;
mod edits;
mod loops;
mod names;
mod show;
mod text;

use std::collections::BTreeSet;

use crate::ast::Item;
use crate::constant::Components;
use crate::{Checked, OutputVersion, Parsed, Problem, Span, Stage, TokenRange, Type};
use edits::Edits;

pub use loops::{DRAWN_ALL_THE_SAME, LoopBound};
pub use show::{Lookup, lookups};

/// A translated shader.
#[derive(Debug, Clone, PartialEq)]
pub struct Translated {
    /// The translated source.
    pub text: String,
    /// The line of the text that is the first line of the source: line k of the source is line `first_line + k - 1`
    /// here.
    pub first_line: u32,
    /// Constructs that could not be translated.
    pub problems: Vec<Problem>,
    /// Names that were changed.
    pub renames: Vec<Rename>,
    /// Values of uniforms that the program must set, because the text no longer does.
    pub uniform_defaults: Vec<UniformDefault>,
}

/// A name that was changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rename {
    /// The name in the source.
    pub from: String,
    /// The name in the text.
    pub to: String,
    /// The position of its declaration.
    pub span: Span,
    /// Whether the program or the other stage knows it by this name: attributes, uniforms and varyings.
    pub is_interface: bool,
}

/// The initial value of a uniform.
#[derive(Debug, Clone, PartialEq)]
pub struct UniformDefault {
    /// The name of the uniform in the text.
    pub name: String,
    /// Its type.
    pub ty: Option<Type>,
    /// Its components; for a sampler with `layout(binding = ..)` the unit. `None` if unknown.
    pub value: Option<Components>,
}

/// The output that replaces `gl_FragColor`.
const COLOUR: &str = "gonio_FragColor";

/// The name of the student's `main` where ours wraps it.
const MAIN: &str = "gonio_main";

struct Translator<'t> {
    parsed: &'t Parsed,
    checked: &'t Checked,
    target: OutputVersion,
    edits: Edits,
    problems: Vec<Problem>,
    renames: Vec<Rename>,
    defaults: Vec<UniformDefault>,
    /// Unique lines before the student's, sorted.
    preamble: BTreeSet<String>,
    /// Statements at the start of `main`.
    first_in_main: String,
    /// Statements after `main` has returned.
    after_main: String,
    /// The number of split interface blocks.
    blocks: usize,
}

/// Translates a shader to another version. The tree must be the one that `checked` was made from.
#[must_use]
pub fn translate(parsed: &Parsed, checked: &Checked, target: OutputVersion) -> Translated {
    translate_bounded(parsed, checked, target, None)
}

/// Like [`translate`], with bounded loops if there is a bound: see [`DRAWN_ALL_THE_SAME`].
#[must_use]
pub fn translate_bounded(
    parsed: &Parsed,
    checked: &Checked,
    target: OutputVersion,
    bound: Option<LoopBound>,
) -> Translated {
    translate_showing(parsed, checked, target, bound, None)
}

/// Like [`translate_bounded`], for a fragment shader that outputs the result of a look-up, if one is selected.
#[must_use]
pub fn translate_showing(
    parsed: &Parsed,
    checked: &Checked,
    target: OutputVersion,
    bound: Option<LoopBound>,
    shown: Option<Lookup>,
) -> Translated {
    let mut translator = Translator {
        parsed,
        checked,
        target,
        edits: Edits::default(),
        problems: Vec::new(),
        renames: Vec::new(),
        defaults: Vec::new(),
        preamble: BTreeSet::new(),
        first_in_main: String::new(),
        after_main: String::new(),
        blocks: 0,
    };
    translator.directives();
    translator.continuations();
    translator.words();
    translator.scalar_components();
    translator.names();
    translator.legacy();
    translator.casts();
    translator.declarations();
    translator.main();
    if let Some(lookup) = shown {
        translator.show(lookup);
    }
    if let Some(bound) = bound {
        translator.bound_loops(bound);
    }
    translator.around_main();
    translator.finish()
}

impl Translator<'_> {
    fn finish(mut self) -> Translated {
        let mut text = match self.target {
            OutputVersion::Core330 => String::from("#version 330 core\n"),
            OutputVersion::Es300 => String::from(
                "#version 300 es\nprecision highp float; precision highp int; precision highp sampler2D; \
                 precision highp samplerCube; precision highp sampler3D; precision highp sampler2DArray; \
                 precision highp sampler2DShadow; precision highp samplerCubeShadow; precision highp sampler2DArrayShadow;\n",
            ),
        };
        for line in &self.preamble {
            text.push_str(line);
            text.push('\n');
        }
        let first_line = text.matches('\n').count() as u32 + 1;
        let source = &self.parsed.source;
        if source.starts_with('\u{feff}') {
            self.edits.replace(0, 3, "");
        }
        text.push_str(&self.edits.apply(source, 0, source.len() as u32));
        if !text.ends_with('\n') {
            text.push('\n');
        }
        if !self.after_main.is_empty() {
            text.push_str(&format!("void main() {{ {MAIN}(); {}}}\n", self.after_main));
        }
        Translated { text, first_line, problems: self.problems, renames: self.renames, uniform_defaults: self.defaults }
    }

    /// Wraps the student's `main` in ours if statements follow it.
    fn around_main(&mut self) {
        if self.after_main.is_empty() {
            return;
        }
        for item in &self.parsed.unit.items {
            if let Item::Function(function) = item
                && function.name == "main"
            {
                self.replace_token(function.name_tokens.first, MAIN);
            }
        }
    }

    fn is_es(&self) -> bool {
        self.target == OutputVersion::Es300
    }

    fn stage(&self) -> Stage {
        self.checked.stage
    }

    /// Returns the position of a range of tokens in the source, if it can be changed there as a whole: in the file, as
    /// a whole use of a macro, or within the text of one macro.
    fn stretch(&self, tokens: TokenRange) -> Option<(u32, u32)> {
        let places = &self.parsed.tokens;
        let first = places.get(tokens.first as usize)?;
        let last = places.get(tokens.last as usize)?;
        let is_direct = |p: &crate::TokenPlace| p.region == 0 && p.span.start == p.start && p.span.end == p.end;
        let begins = tokens.first == 0 || places[tokens.first as usize - 1].span.start != first.span.start;
        let ends = places.get(tokens.last as usize + 1).is_none_or(|next| next.span.start != last.span.start);
        let start = if is_direct(first) { Some(first.start) } else { begins.then_some(first.span.start) };
        let end = if is_direct(last) { Some(last.end) } else { ends.then_some(last.span.end) };
        match (start, end) {
            (Some(start), Some(end)) => Some((start, end)),
            _ if first.region == last.region && first.span == last.span && first.start < last.end => {
                Some((first.start, last.end))
            }
            _ => None,
        }
    }

    /// Replaces the text of one token, in the macro if it came from one.
    fn replace_token(&mut self, index: u32, text: &str) {
        if let Some(place) = self.parsed.tokens.get(index as usize) {
            self.edits.replace(place.start, place.end, text);
        }
    }

    /// Returns the text of one token.
    fn token_text(&self, index: u32) -> &str {
        let place = self.parsed.tokens.get(index as usize);
        place.and_then(|p| self.parsed.source.get(p.start as usize..p.end as usize)).unwrap_or("")
    }

    fn cannot(&mut self, span: Span, message: impl Into<String>) {
        self.problems.push(Problem::strict(span, "no-translation", message));
    }
}
