//! Processes directives.

use std::rc::Rc;

use super::{Conditional, Directive, Macro, Preprocessor};
use crate::lex::{Token, TokenKind};
use crate::{Problem, Severity, Span, Version};

const KNOWN_VERSIONS: [u32; 16] = [100, 110, 120, 130, 140, 150, 300, 310, 320, 330, 400, 410, 420, 430, 440, 450];

impl Preprocessor<'_> {
    pub(super) fn directive(&mut self) {
        let line = self.take_line();
        let (Some(first), Some(last)) = (line.first(), line.last()) else { return };
        let span = first.span.to(last.span);
        let word = line.get(1).map_or("", |t| &*t.text).to_string();
        let rest = line.get(2..).unwrap_or(&[]).to_vec();
        let is_conditional = matches!(&*word, "if" | "ifdef" | "ifndef" | "elif" | "else" | "endif");
        if is_conditional {
            self.conditional(&word, &rest, span);
        } else if !self.is_active() {
            self.remember_inactive(&line);
            return;
        }
        self.directives.push(Directive { word: word.clone(), span });
        match &*word {
            "define" => self.define(&rest, span),
            "undef" => {
                if let Some(name) = rest.first() {
                    self.macros.remove(&name.text);
                }
            }
            "version" => self.version(&rest, span),
            "error" => {
                let text = words(&rest);
                self.problems.push(Problem::error(span, "error-directive", format!("#error {text}")));
            }
            "include" => {
                let message = "GLSL has no `#include`";
                let help = "paste the text of that file here";
                self.problems.push(Problem::error(span, "include", message).with_help(help));
            }
            "" | "extension" | "pragma" | "line" => {}
            _ if is_conditional => {}
            _ => {
                let message = format!("unknown directive `#{word}`");
                self.problems.push(Problem::error(span, "unknown-directive", message));
            }
        }
    }

    fn define(&mut self, rest: &[Token], span: Span) {
        let Some(name) = rest.first().filter(|t| t.kind == TokenKind::Name) else {
            let message = "expected a name after `#define`";
            self.problems.push(Problem::error(span, "define", message));
            return;
        };
        if name.text.starts_with("GL_") || &*name.text == "defined" {
            let message = format!("a macro cannot be called `{}`: names with `GL_` are reserved", name.text);
            self.problems.push(Problem::error(name.span, "reserved-name", message));
        } else if name.text.contains("__") {
            let message = format!("names with two underscores, such as `{}`, are reserved", name.text);
            self.problems.push(Problem::strict(name.span, "reserved-name", message));
        }
        let mut body = &rest[1..];
        let mut parameters = None;
        if body.first().is_some_and(|t| t.is("(") && !t.space_before) {
            let Some(close) = body.iter().position(|t| t.is(")")) else {
                let message = format!("the parameter list of the macro `{}` is never closed", name.text);
                self.problems.push(Problem::error(name.span, "define", message));
                return;
            };
            let names =
                body[1..close].iter().filter(|t| t.kind == TokenKind::Name).map(|t| Rc::clone(&t.text)).collect();
            parameters = Some(names);
            body = &body[close + 1..];
        }
        for token in body.iter().filter(|t| t.kind == TokenKind::Name) {
            self.macro_words.push((token.text.to_string(), token.start, token.end));
        }
        self.all_macros.push(name.text.to_string());
        let found = Macro { parameters, body: body.to_vec() };
        self.macros.insert(Rc::clone(&name.text), Rc::new(found));
    }

    fn version(&mut self, rest: &[Token], span: Span) {
        if self.version.is_some() {
            self.problems.push(Problem::error(span, "version", "there is more than one `#version` line"));
            return;
        }
        let number: Option<u32> = rest.first().and_then(|t| t.text.parse().ok());
        let profile = rest.get(1).map_or("", |t| &*t.text);
        let Some(number) = number.filter(|n| KNOWN_VERSIONS.contains(n) || *n == 460) else {
            let message = format!("unknown GLSL version `{}`", words(rest));
            let problem = Problem::error(span, "version", message).with_help("write `#version 330 core`");
            self.problems.push(problem);
            return;
        };
        let es = number == 100 || profile == "es";
        if matches!(number, 300 | 310 | 320) != es && number != 100 {
            let message = format!("unknown version `#version {}`", words(rest));
            let help =
                if es { "the versions of OpenGL ES are 100, 300 es and 310 es" } else { "write `es` after the number" };
            self.problems.push(Problem::error(span, "version", message).with_help(help));
        }
        if !self.out.is_empty() || self.directives.len() > 1 {
            let message = "`#version` must be the first line of the shader";
            self.problems.push(Problem::new(Severity::Strict, span, "version-not-first", message));
        }
        let compatibility = profile == "compatibility";
        self.version = Some(Version { number, es, line: span.line, compatibility });
    }

    fn conditional(&mut self, word: &str, rest: &[Token], span: Span) {
        if word.starts_with("if") {
            let is_active = self.is_active() && self.is_true(word, rest, span);
            // In a branch that is not compiled no nested branch is.
            let is_taken = is_active || !self.is_active();
            self.conditionals.push(Conditional { span, is_active, is_taken, has_else: false });
            return;
        }
        let Some(mut open) = self.conditionals.pop() else {
            self.problems.push(Problem::error(span, "stray-directive", format!("`#{word}` without `#if`")));
            return;
        };
        if word == "endif" {
            return;
        }
        if open.has_else {
            self.problems.push(Problem::error(span, "stray-directive", format!("`#{word}` after `#else`")));
        }
        open.has_else |= word == "else";
        open.is_active = !open.is_taken && (word == "else" || self.is_true("if", rest, span));
        open.is_taken |= open.is_active;
        self.conditionals.push(open);
    }

    fn is_true(&mut self, word: &str, rest: &[Token], span: Span) -> bool {
        match word {
            "ifdef" | "ifndef" => {
                let Some(name) = rest.first() else {
                    let message = format!("expected a name after `#{word}`");
                    self.problems.push(Problem::error(span, "condition", message));
                    return false;
                };
                self.is_defined(name) == (word == "ifdef")
            }
            _ => self.evaluate(rest, span),
        }
    }

    pub(super) fn is_defined(&self, name: &Token) -> bool {
        let version = self.version.unwrap_or(Version::NONE);
        match &*name.text {
            "GL_ES" | "GL_FRAGMENT_PRECISION_HIGH" => version.es,
            "GL_core_profile" => version.number >= 150 && !version.es,
            "__LINE__" | "__FILE__" | "__VERSION__" => true,
            _ => self.macros.contains_key(&name.text),
        }
    }
}

fn words(tokens: &[Token]) -> String {
    tokens.iter().map(|t| &*t.text).collect::<Vec<_>>().join(" ")
}
