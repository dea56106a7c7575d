//! Expands macros.

use std::sync::Arc;

use super::{Macro, OpenMacro, Preprocessor};
use crate::lex::{Token, TokenKind};
use crate::limits::{MOST_EXPANDED, MOST_MACROS_IN_ARGUMENTS, MOST_MACROS_IN_MACROS, MOST_NAME_BYTES};
use crate::{Limit, Problem, Span};

impl Preprocessor<'_> {
    /// Returns the token itself, or `None` if it was a macro, whose body was pushed to `frames`.
    pub(super) fn expand(&mut self, mut token: Token, frames: &mut Vec<OpenMacro>, from_file: bool) -> Option<Token> {
        if token.kind != TokenKind::Name || token.frozen {
            return Some(token);
        }
        if let Some(number) = self.predefined(&token) {
            token.text = number.into();
            token.kind = TokenKind::Number;
            return Some(token);
        }
        let Some(found) = self.macros.get(&token.text).cloned() else { return Some(token) };
        // A frame that is used up still counts: the current token may be its last one.
        let is_open = |frame: &OpenMacro| frame.name.as_ref() == Some(&token.text);
        if self.disabled.contains(&token.text) || frames.iter().any(is_open) {
            token.frozen = true;
            return Some(token);
        }
        if frames.len() > MOST_MACROS_IN_MACROS {
            self.give_up(token.span, Limit::Macros);
        }
        if self.has_given_up {
            return Some(token);
        }
        let arguments = match &found.parameters {
            None => Vec::new(),
            Some(_) if !self.peek_is_open(frames, from_file) => return Some(token),
            Some(parameters) => {
                let before = self.at;
                let Some((arguments, close)) = self.arguments(&token, parameters.len(), frames, from_file) else {
                    // The tokens tried as arguments are read again unchanged.
                    self.at = before;
                    token.frozen = true;
                    return Some(token);
                };
                // In a macro's body the position already is the use of the outermost macro.
                if close.start > token.span.start && token.region == 0 {
                    token.span = token.span.to(close);
                }
                arguments
            }
        };
        self.regions += 1;
        // Arguments are expanded on their own, but with the macros that are open here disabled.
        let open = self.disabled.len();
        self.disabled.extend(frames.iter().filter_map(|f| f.name.clone()));
        let tokens = self.substitute(&found, &arguments, &token);
        self.disabled.truncate(open);
        self.steps += tokens.len() + 1;
        if self.steps > MOST_EXPANDED {
            self.give_up(token.span, Limit::Macros);
            return None;
        }
        frames.push(OpenMacro { tokens, at: 0, name: Some(token.text.clone()) });
        None
    }

    fn predefined(&self, token: &Token) -> Option<String> {
        match &*token.text {
            "__LINE__" => Some(token.span.line.to_string()),
            "__FILE__" => Some("0".to_string()),
            "__VERSION__" => Some(self.version.unwrap_or(crate::Version::NONE).number.to_string()),
            "GL_ES" if self.version.is_some_and(|v| v.es) => Some("1".to_string()),
            "GL_FRAGMENT_PRECISION_HIGH" if self.version.is_some_and(|v| v.es) => Some("1".to_string()),
            "GL_core_profile" if self.version.is_some_and(|v| v.number >= 150 && !v.es) => Some("1".to_string()),
            _ => None,
        }
    }

    /// Reads the arguments in parentheses after a macro's name.
    fn arguments(
        &mut self,
        name: &Token,
        expected: usize,
        frames: &mut Vec<OpenMacro>,
        from_file: bool,
    ) -> Option<(Vec<Vec<Token>>, Span)> {
        self.pull(frames, from_file);
        let mut arguments = vec![Vec::new()];
        let mut depth = 0;
        let close = loop {
            let Some(token) = self.pull(frames, from_file) else {
                let message = format!("the `(` after the macro `{}` is never closed", name.text);
                self.problems.push(Problem::error(name.span, "macro-arguments", message));
                return None;
            };
            match &*token.text {
                "(" => depth += 1,
                ")" if depth == 0 => break token.span,
                ")" => depth -= 1,
                "," if depth == 0 => {
                    arguments.push(Vec::new());
                    continue;
                }
                _ => {}
            }
            self.steps += 1;
            if self.steps > MOST_EXPANDED {
                self.give_up(name.span, Limit::Macros);
                return None;
            }
            if let Some(argument) = arguments.last_mut() {
                argument.push(token);
            }
        };
        if expected == 0 && arguments.len() == 1 && arguments[0].is_empty() {
            arguments.clear();
        }
        if arguments.len() != expected {
            let message = format!("the macro `{}` takes {expected} arguments, found {}", name.text, arguments.len());
            self.problems.push(Problem::error(name.span, "macro-arguments", message));
            arguments.resize(expected, Vec::new());
        }
        Some((arguments, close))
    }

    /// Substitutes arguments for parameters in a macro's body; all positions are that of the use.
    fn substitute(&mut self, found: &Arc<Macro>, arguments: &[Vec<Token>], used: &Token) -> Vec<Token> {
        let region = self.regions;
        let parameters = found.parameters.as_deref().unwrap_or(&[]);
        let index_of = |token: &Token| parameters.iter().position(|p| *p == token.text);
        let mut expanded: Vec<Option<Vec<Token>>> = vec![None; arguments.len()];
        let mut out: Vec<Token> = Vec::new();
        let mut at = 0;
        while let Some(token) = found.body.get(at) {
            at += 1;
            if self.steps + out.len() > MOST_EXPANDED {
                break;
            }
            if token.is("##") {
                if let (Some(left), Some(right)) = (out.pop(), found.body.get(at)) {
                    at += 1;
                    let right = match index_of(right) {
                        Some(index) => arguments[index].clone(),
                        None => vec![right.clone()],
                    };
                    if left.text.len() > MOST_NAME_BYTES {
                        self.give_up(used.span, Limit::Name);
                        break;
                    }
                    out.extend(paste(left, right));
                }
                continue;
            }
            let Some(index) = index_of(token) else {
                out.push(Token { region, ..token.clone() });
                continue;
            };
            if found.body.get(at).is_some_and(|next| next.is("##")) {
                out.extend(arguments[index].iter().cloned());
                continue;
            }
            if expanded[index].is_none() {
                expanded[index] = Some(self.expand_all(arguments[index].clone()));
            }
            out.extend(expanded[index].iter().flatten().cloned());
        }
        // A macro for one word represents it: a change is made where the macro is used.
        let is_one = found.parameters.is_none() && out.len() == 1;
        for token in &mut out {
            token.span = used.span;
            if is_one {
                (token.start, token.end, token.region) = (used.start, used.end, used.region);
            }
        }
        out
    }

    /// Expands all macros in a list of tokens.
    pub(super) fn expand_all(&mut self, tokens: Vec<Token>) -> Vec<Token> {
        if self.nested >= MOST_MACROS_IN_ARGUMENTS {
            if let Some(token) = tokens.first() {
                self.give_up(token.span, Limit::Macros);
            }
            return tokens;
        }
        self.nested += 1;
        let mut frames = vec![OpenMacro { tokens, at: 0, name: None }];
        let mut out = Vec::new();
        while let Some(token) = self.pull(&mut frames, false) {
            if let Some(token) = self.expand(token, &mut frames, false) {
                self.steps += 1;
                out.push(token);
            }
            if self.has_given_up {
                break;
            }
        }
        self.nested -= 1;
        out
    }
}

/// Joins tokens, `left ## right`.
fn paste(mut left: Token, right: Vec<Token>) -> Vec<Token> {
    let mut right = right.into_iter();
    if let Some(first) = right.next() {
        left.text = format!("{}{}", left.text, first.text).into();
    }
    std::iter::once(left).chain(right).collect()
}
