//! A student's shader as `#version 330 core` or `#version 300 es`, its lines where they were.

mod casts;
mod declarations;
mod edits;
mod legacy;
mod loops;
mod names;
mod show;
mod text;
mod turns;

use std::collections::BTreeSet;

use crate::ast::Item;
use crate::constant::Components;
use crate::{Checked, OutputVersion, Parsed, Problem, Span, Stage, TokenRange, Type};
use edits::Edits;

pub use loops::{DRAWN_ALL_THE_SAME, LoopBound};
pub use show::{Lookup, lookups};

/// A shader in another version of the language.
#[derive(Debug, Clone, PartialEq)]
pub struct Translated {
    /// The text.
    pub text: String,
    /// The line of the text that is the first line of the source: line k there is line `first_line + k - 1` here.
    pub first_line: u32,
    /// What could not be translated.
    pub problems: Vec<Problem>,
    /// Names that are others now.
    pub renames: Vec<Rename>,
    /// Values of uniforms that the program has to set, since the text no longer does.
    pub uniform_defaults: Vec<UniformDefault>,
}

/// A name that is another now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rename {
    /// As the student wrote it.
    pub from: String,
    /// As it stands in the text.
    pub to: String,
    /// Where it is declared.
    pub span: Span,
    /// Whether the program or the other stage knows it by this name: attributes, uniforms and varyings.
    pub is_interface: bool,
}

/// What a uniform is before the program sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct UniformDefault {
    /// The uniform, by its name in the text.
    pub name: String,
    /// Its type.
    pub ty: Option<Type>,
    /// Its components; for a sampler with `layout(binding = ..)` the unit. None if they are not known.
    pub value: Option<Components>,
}

/// The output that stands for `gl_FragColor`.
const COLOUR: &str = "gonio_FragColor";

/// The student's `main`, where ours goes around it.
const MAIN: &str = "gonio_main";

struct Translator<'t> {
    parsed: &'t Parsed,
    checked: &'t Checked,
    target: OutputVersion,
    edits: Edits,
    problems: Vec<Problem>,
    renames: Vec<Rename>,
    defaults: Vec<UniformDefault>,
    /// Lines in front of the student's, by name, each once.
    preamble: BTreeSet<String>,
    /// Statements that come first in `main`.
    first_in_main: String,
    /// Statements that come when `main` has ended, wherever it did.
    after_main: String,
    /// Blocks between the stages that were taken apart so far.
    blocks: usize,
}

/// Writes a shader for another version. The tree has to be the one that `checked` was made of.
#[must_use]
pub fn translate(parsed: &Parsed, checked: &Checked, target: OutputVersion) -> Translated {
    translate_bounded(parsed, checked, target, None)
}

/// The same with loops that end, where a bound is given: see [`DRAWN_ALL_THE_SAME`].
#[must_use]
pub fn translate_bounded(
    parsed: &Parsed,
    checked: &Checked,
    target: OutputVersion,
    bound: Option<LoopBound>,
) -> Translated {
    translate_showing(parsed, checked, target, bound, None)
}

/// The same for a fragment shader that puts out what a look-up gives, where one is named.
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

    /// Makes room for a `main` of ours around the student's, where statements come after it.
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

    /// Where a run of tokens lies in the source, if it can be changed there as a whole: in the file, as the whole of a macro's
    /// use, or within one macro's text.
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

    /// Another text for one token, in the macro if it came out of one.
    fn replace_token(&mut self, index: u32, text: &str) {
        if let Some(place) = self.parsed.tokens.get(index as usize) {
            self.edits.replace(place.start, place.end, text);
        }
    }

    /// The text of one token.
    fn token_text(&self, index: u32) -> &str {
        let place = self.parsed.tokens.get(index as usize);
        place.and_then(|p| self.parsed.source.get(p.start as usize..p.end as usize)).unwrap_or("")
    }

    fn cannot(&mut self, span: Span, message: impl Into<String>) {
        self.problems.push(Problem::strict(span, "no-translation", message));
    }
}
