//! The preprocessor: executes directives, expands macros, and removes branches that are not compiled.

mod directives;
mod macros;

use std::collections::HashMap;
use std::sync::Arc;

use crate::lex::{Token, TokenKind};
use crate::{Limit, Problem, Span, Version};

/// A preprocessor directive, for the translation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Directive {
    /// The word after the `#`, empty if there is none.
    pub word: String,
    /// The range from the `#` to the last token of the line.
    pub span: Span,
}

/// The result of preprocessing.
pub(crate) struct Preprocessed {
    pub tokens: Vec<Token>,
    pub directives: Vec<Directive>,
    /// Ranges of bytes that are not compiled.
    pub inactive: Vec<(u32, u32)>,
    /// Words in bodies of macros and in branches that are not compiled, which must be translated although they are not
    /// tokens.
    pub macro_words: Vec<(String, u32, u32)>,
    pub version: Option<Version>,
    /// Names of all macros that were defined.
    pub macros: Vec<String>,
}

/// `#define NAME(parameters) body`.
#[derive(Debug)]
struct Macro {
    parameters: Option<Vec<Arc<str>>>,
    body: Vec<Token>,
}

/// An open `#if`.
struct Conditional {
    span: Span,
    /// Whether this branch is compiled.
    is_active: bool,
    /// Whether a branch has been compiled, so that no other will be.
    is_taken: bool,
    has_else: bool,
}

/// The remaining tokens of a macro.
struct OpenMacro {
    tokens: Vec<Token>,
    at: usize,
    /// The macro, which is not expanded again in its own body.
    name: Option<Arc<str>>,
}

struct Preprocessor<'p> {
    raw: Vec<Token>,
    at: usize,
    macros: HashMap<Arc<str>, Arc<Macro>>,
    all_macros: Vec<String>,
    conditionals: Vec<Conditional>,
    out: Vec<Token>,
    directives: Vec<Directive>,
    inactive: Vec<(u32, u32)>,
    macro_words: Vec<(String, u32, u32)>,
    version: Option<Version>,
    problems: &'p mut Vec<Problem>,
    /// Tokens produced so far, to stop endless macros.
    steps: usize,
    regions: u32,
    nested: usize,
    /// Macros that are being expanded around an argument.
    disabled: Vec<Arc<str>>,
    has_given_up: bool,
}

/// Preprocesses all tokens.
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
        // In a branch that is not compiled no nested branch is active.
        self.conditionals.last().is_none_or(|c| c.is_active)
    }

    /// Skips the rest of a line that is not compiled.
    fn skip_line(&mut self) {
        let line = self.take_line();
        self.remember_inactive(&line);
    }

    fn remember_inactive(&mut self, line: &[Token]) {
        if let (Some(first), Some(last)) = (line.first(), line.last()) {
            self.inactive.push((first.start, last.end));
        }
    }

    /// Takes the tokens up to the end of the line.
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

    /// Returns the next token: of the innermost macro, or else of the file, up to a directive.
    fn pull(&mut self, frames: &mut Vec<OpenMacro>, from_file: bool) -> Option<Token> {
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

    fn peek_is_open(&self, frames: &[OpenMacro], from_file: bool) -> bool {
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
