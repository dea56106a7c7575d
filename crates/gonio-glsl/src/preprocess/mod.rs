//! The preprocessor: directives are obeyed, macros replaced, and what lies in a branch not taken is left out.

mod condition;
mod directives;
mod macros;

use std::collections::HashMap;
use std::rc::Rc;

use crate::lex::{Token, TokenKind};
use crate::{Limit, Problem, Span, Version};

/// A line beginning with `#`, for the translation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Directive {
    /// The word behind the `#`, empty if there is none.
    pub word: String,
    /// From the `#` to the last token of the line.
    pub span: Span,
}

/// What the preprocessor leaves.
pub(crate) struct Preprocessed {
    pub tokens: Vec<Token>,
    pub directives: Vec<Directive>,
    /// Bytes of the source that no compiler looks at: branches not taken.
    pub inactive: Vec<(u32, u32)>,
    /// The words in the bodies of macros and in branches not taken do not come as tokens, but have to be translated.
    pub macro_words: Vec<(String, u32, u32)>,
    pub version: Option<Version>,
    /// Names of all macros that were defined, and that the file thus may use as it likes.
    pub macros: Vec<String>,
}

/// `#define NAME(parameters) body`.
#[derive(Debug)]
struct Macro {
    parameters: Option<Vec<Rc<str>>>,
    body: Vec<Token>,
}

/// An `#if` that is open.
struct Conditional {
    span: Span,
    /// Whether this branch is compiled.
    is_active: bool,
    /// Whether a branch has been taken, so that no other will be.
    is_taken: bool,
    has_else: bool,
}

/// Tokens of a macro that are yet to be looked at.
struct Frame {
    tokens: Vec<Token>,
    at: usize,
    /// The macro, which is not replaced again within its own text.
    name: Option<Rc<str>>,
}

struct Preprocessor<'p> {
    raw: Vec<Token>,
    at: usize,
    macros: HashMap<Rc<str>, Rc<Macro>>,
    all_macros: Vec<String>,
    conditionals: Vec<Conditional>,
    out: Vec<Token>,
    directives: Vec<Directive>,
    inactive: Vec<(u32, u32)>,
    macro_words: Vec<(String, u32, u32)>,
    version: Option<Version>,
    problems: &'p mut Vec<Problem>,
    /// Tokens made so far, against macros without end.
    steps: usize,
    regions: u32,
    nested: usize,
    /// Names whose expansion is under way around an argument.
    disabled: Vec<Rc<str>>,
    has_given_up: bool,
}

/// Runs the preprocessor over all tokens.
pub(crate) fn preprocess(raw: Vec<Token>, problems: &mut Vec<Problem>) -> Preprocessed {
    let mut preprocessor = Preprocessor {
        raw,
        at: 0,
        macros: HashMap::new(),
        all_macros: Vec::new(),
        conditionals: Vec::new(),
        out: Vec::new(),
        directives: Vec::new(),
        inactive: Vec::new(),
        macro_words: Vec::new(),
        version: None,
        problems,
        steps: 0,
        regions: 0,
        nested: 0,
        disabled: Vec::new(),
        has_given_up: false,
    };
    preprocessor.run();
    Preprocessed {
        tokens: preprocessor.out,
        directives: preprocessor.directives,
        inactive: preprocessor.inactive,
        macro_words: preprocessor.macro_words,
        version: preprocessor.version,
        macros: preprocessor.all_macros,
    }
}

impl Preprocessor<'_> {
    fn run(&mut self) {
        let mut frames = Vec::new();
        loop {
            if frames.is_empty() {
                let Some(token) = self.raw.get(self.at) else { break };
                if token.kind == TokenKind::End {
                    break;
                }
                if token.first_on_line && token.is("#") {
                    self.directive();
                    continue;
                }
                if !self.is_active() {
                    self.skip_line();
                    continue;
                }
            }
            let Some(token) = self.pull(&mut frames, true) else { continue };
            if let Some(token) = self.expand(token, &mut frames, true) {
                self.out.push(token);
            }
            if self.has_given_up {
                frames.clear();
            }
        }
        if let Some(open) = self.conditionals.pop() {
            let message = "`#if` without `#endif`";
            self.problems.push(Problem::error(open.span, "unclosed-if", message));
        }
        if let Some(end) = self.raw.last() {
            self.out.push(end.clone());
        }
    }

    fn is_active(&self) -> bool {
        // Within a branch not taken none is active.
        self.conditionals.last().is_none_or(|c| c.is_active)
    }

    /// Past the rest of a line that is not compiled.
    fn skip_line(&mut self) {
        let line = self.take_line();
        self.remember_inactive(&line);
    }

    fn remember_inactive(&mut self, line: &[Token]) {
        if let (Some(first), Some(last)) = (line.first(), line.last()) {
            self.inactive.push((first.start, last.end));
        }
    }

    /// The tokens up to the end of the line.
    fn take_line(&mut self) -> Vec<Token> {
        let mut line: Vec<Token> = Vec::new();
        while let Some(token) = self.raw.get(self.at) {
            if token.kind == TokenKind::End || (token.first_on_line && !line.is_empty()) {
                break;
            }
            line.push(token.clone());
            self.at += 1;
        }
        line
    }

    /// The next token: of the innermost macro, otherwise of the file, where a directive ends the search.
    fn pull(&mut self, frames: &mut Vec<Frame>, from_file: bool) -> Option<Token> {
        while let Some(frame) = frames.last_mut() {
            if let Some(token) = frame.tokens.get(frame.at) {
                frame.at += 1;
                return Some(token.clone());
            }
            frames.pop();
        }
        if !from_file {
            return None;
        }
        let token = self.raw.get(self.at)?;
        if token.kind == TokenKind::End || (token.first_on_line && token.is("#")) {
            return None;
        }
        self.at += 1;
        Some(token.clone())
    }

    fn peek_is_open(&self, frames: &[Frame], from_file: bool) -> bool {
        for frame in frames.iter().rev() {
            if let Some(token) = frame.tokens.get(frame.at) {
                return token.is("(");
            }
        }
        from_file && self.raw.get(self.at).is_some_and(|t| t.is("("))
    }

    fn give_up(&mut self, span: Span, limit: Limit) {
        if !self.has_given_up {
            self.has_given_up = true;
            self.problems.push(Problem::beyond(span, limit));
        }
    }
}
