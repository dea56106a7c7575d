//! The limits that tokens are checked against before anything is parsed.

use crate::lex::{Token, TokenKind};
use crate::limits::{MOST_COMPONENTS, MOST_NAME_BYTES, MOST_NESTED};
use crate::{Limit, Problem, Span};

/// Checks the tokens against the limits wherever they are: a shader that cannot be parsed goes to the driver too. Where
/// one is exceeded, only the end token is left.
pub(crate) fn check(tokens: &mut Vec<Token>, most: usize, problems: &mut Vec<Problem>) {
    let Some((limit, span)) = exceeded(tokens, most) else { return };
    refuse(tokens, problems, limit, span);
}

/// Reports that a limit is exceeded, and leaves only the end token.
pub(crate) fn refuse(tokens: &mut Vec<Token>, problems: &mut Vec<Problem>, limit: Limit, span: Span) {
    if !problems.iter().any(|problem| problem.limit.is_some()) {
        problems.push(Problem::beyond(span, limit));
    }
    tokens.drain(..tokens.len().saturating_sub(1));
}

fn exceeded(tokens: &[Token], most: usize) -> Option<(Limit, Span)> {
    if let Some(token) = tokens.get(most) {
        return Some((Limit::Tokens, token.span));
    }
    let mut depth = 0_usize;
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Name if token.text.len() > MOST_NAME_BYTES => return Some((Limit::Name, token.span)),
            TokenKind::Mark => match &*token.text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.saturating_sub(1),
                _ => {}
            },
            TokenKind::Number if index > 0 && tokens[index - 1].is("[") => {
                let digits = token.text.trim_end_matches(['u', 'U']);
                let is_sizeable = tokens.get(index + 1).is_some_and(|next| next.is("]"));
                let is_number = digits.bytes().all(|digit| digit.is_ascii_digit());
                let is_large = digits.parse::<u64>().map_or(is_number, |number| number > MOST_COMPONENTS);
                if is_sizeable && is_large {
                    return Some((Limit::Components, token.span));
                }
            }
            _ => {}
        }
        if depth > MOST_NESTED {
            return Some((Limit::Nested, token.span));
        }
    }
    None
}
