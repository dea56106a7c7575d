//! A small markup for formulas in captions and equations: MathML and HTML for the page, text runs for the sheet.
//!
//! `_x`, `_{..}` is a subscript; `^x`, `^{..}` a superscript; `\f{a}{b}` a fraction; `!{..}` stressed; `~{..}` faded;
//! `-{..}` struck out; `{..}` a group. All other text is literal, and no text is an error.

/// The emphasis of a part of a formula.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Emphasis {
    /// Plain text.
    #[default]
    Plain,
    /// An active term.
    Stressed,
    /// A term that is switched off.
    Faded,
    /// A term that is removed.
    Struck,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Text(String),
    Group(Emphasis, Vec<Node>),
    Below(Vec<Node>),
    Above(Vec<Node>),
    Fraction(Vec<Node>, Vec<Node>),
}

/// A piece of text on one line.
#[derive(Clone, Debug, PartialEq)]
pub struct TextRun {
    /// The text.
    pub text: String,
    /// Relative to the line's size.
    pub size: f32,
    /// Upwards, relative to the line's size.
    pub rise: f32,
    /// The emphasis.
    pub emphasis: Emphasis,
}

/// Converts markup to runs of text, for the sheet.
pub fn runs(markup: &str) -> Vec<TextRun> {
    fn walk(nodes: &[Node], size: f32, rise: f32, emphasis: Emphasis, to: &mut Vec<TextRun>) {
        for node in nodes {
            match node {
                Node::Text(text) => to.push(TextRun { text: text.clone(), size, rise, emphasis }),
                Node::Group(own, inner) => {
                    walk(inner, size, rise, if *own == Emphasis::Plain { emphasis } else { *own }, to)
                }
                Node::Below(inner) => walk(inner, 0.7 * size, rise - 0.16 * size, emphasis, to),
                Node::Above(inner) => walk(inner, 0.7 * size, rise + 0.32 * size, emphasis, to),
                Node::Fraction(over, under) => {
                    walk(over, size, rise, emphasis, to);
                    to.push(TextRun { text: " / ".into(), size, rise, emphasis });
                    walk(under, size, rise, emphasis, to);
                }
            }
        }
    }
    let mut to = Vec::new();
    walk(&parse(markup), 1.0, 0.0, Emphasis::Plain, &mut to);
    to
}

/// Converts markup to HTML, for a sentence of the page.
pub fn html(markup: &str) -> String {
    fn walk(nodes: &[Node], to: &mut String) {
        for node in nodes {
            let (open, inner, close) = match node {
                Node::Text(text) => {
                    to.push_str(&escape(text));
                    continue;
                }
                Node::Fraction(over, under) => {
                    walk(over, to);
                    to.push('/');
                    walk(under, to);
                    continue;
                }
                Node::Group(Emphasis::Plain, inner) => ("", inner, ""),
                Node::Group(Emphasis::Stressed, inner) => ("<b>", inner, "</b>"),
                Node::Group(Emphasis::Faded, inner) => ("<span class=\"off\">", inner, "</span>"),
                Node::Group(Emphasis::Struck, inner) => ("<s>", inner, "</s>"),
                Node::Below(inner) => ("<sub>", inner, "</sub>"),
                Node::Above(inner) => ("<sup>", inner, "</sup>"),
            };
            to.push_str(open);
            walk(inner, to);
            to.push_str(close);
        }
    }
    let mut to = String::new();
    walk(&parse(markup), &mut to);
    to
}

/// Converts markup to MathML, for a formula of the page.
pub fn mathml(markup: &str) -> String {
    format!("<math>{}</math>", row(&parse(markup)))
}

/// Escapes text for HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A base with an optional subscript and superscript.
#[derive(Default)]
struct Atom {
    base: String,
    below: Option<String>,
    above: Option<String>,
}

fn row(nodes: &[Node]) -> String {
    let mut atoms: Vec<Atom> = Vec::new();
    for node in nodes {
        match node {
            Node::Text(text) => tokens(text, &mut atoms),
            Node::Group(emphasis, inner) => {
                let class = match emphasis {
                    Emphasis::Plain => "",
                    Emphasis::Stressed => " class=\"on\"",
                    Emphasis::Faded => " class=\"off\"",
                    Emphasis::Struck => " class=\"struck\"",
                };
                atoms.push(Atom { base: format!("<mrow{class}>{}</mrow>", row(inner)), ..Atom::default() });
            }
            Node::Fraction(over, under) => {
                let base = format!("<mfrac><mrow>{}</mrow><mrow>{}</mrow></mfrac>", row(over), row(under));
                atoms.push(Atom { base, ..Atom::default() });
            }
            Node::Below(inner) | Node::Above(inner) => {
                if atoms.is_empty() {
                    atoms.push(Atom { base: "<mrow></mrow>".into(), ..Atom::default() });
                }
                if let Some(last) = atoms.last_mut() {
                    let script = Some(format!("<mrow>{}</mrow>", row(inner)));
                    match node {
                        Node::Below(_) => last.below = script,
                        _ => last.above = script,
                    }
                }
            }
        }
    }
    atoms
        .into_iter()
        .map(|Atom { base, below, above }| match (below, above) {
            (None, None) => base,
            (Some(below), None) => format!("<msub>{base}{below}</msub>"),
            (None, Some(above)) => format!("<msup>{base}{above}</msup>"),
            (Some(below), Some(above)) => format!("<msubsup>{base}{below}{above}</msubsup>"),
        })
        .collect()
}

/// Identifiers, numbers and operators; blanks between words and wide blanks are kept.
fn tokens(text: &str, atoms: &mut Vec<Atom>) {
    let mut rest = text;
    let mut blanks = 0;
    while let Some(first) = rest.chars().next() {
        let run = |belongs: fn(char) -> bool| rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        let is_digit = |c: char| c.is_ascii_digit() || c == '.';
        let (length, tag) = if first.is_whitespace() {
            blanks += 1;
            rest = &rest[first.len_utf8()..];
            continue;
        } else if first.is_alphabetic() && !"Σ∂".contains(first) {
            (run(|c| c.is_alphabetic() && !"Σ∂".contains(c)), "mi")
        } else if is_digit(first) {
            (run(|c| c.is_ascii_digit() || c == '.'), "mn")
        } else {
            (first.len_utf8(), "mo")
        };
        let after_word = atoms.last().is_some_and(|a| a.base.starts_with("<mi>"));
        if blanks > 1 || (blanks == 1 && tag == "mi" && after_word) {
            let width = if blanks > 1 { "1em" } else { "0.3em" };
            atoms.push(Atom { base: format!("<mspace width=\"{width}\"/>"), ..Atom::default() });
        }
        blanks = 0;
        let fixed = if tag == "mo" && "⟨⟩|()[]".contains(first) { " stretchy=\"false\"" } else { "" };
        let base = format!("<{tag}{fixed}>{}</{tag}>", escape(&rest[..length]));
        atoms.push(Atom { base, ..Atom::default() });
        rest = &rest[length..];
    }
}

fn parse(markup: &str) -> Vec<Node> {
    let mut rest = markup;
    nodes(&mut rest, 0)
}

/// Deeper than any formula; braces beyond are plain text.
const DEEPEST: usize = 16;

fn nodes(rest: &mut &str, depth: usize) -> Vec<Node> {
    let mut nodes_here: Vec<Node> = Vec::new();
    let text = |here: &mut Vec<Node>, c: char| match here.last_mut() {
        Some(Node::Text(text)) => text.push(c),
        _ => here.push(Node::Text(c.into())),
    };
    while let Some(c) = rest.chars().next() {
        if c == '}' && depth > 0 {
            break;
        }
        let node = if depth >= DEEPEST {
            None
        } else if rest.starts_with("!{") {
            *rest = &rest[1..];
            Some(Node::Group(Emphasis::Stressed, argument(rest, depth)))
        } else if rest.starts_with("~{") {
            *rest = &rest[1..];
            Some(Node::Group(Emphasis::Faded, argument(rest, depth)))
        } else if rest.starts_with("-{") {
            *rest = &rest[1..];
            Some(Node::Group(Emphasis::Struck, argument(rest, depth)))
        } else if rest.starts_with("\\f{") {
            *rest = &rest[2..];
            let over = argument(rest, depth);
            Some(Node::Fraction(over, argument(rest, depth)))
        } else if c == '{' {
            Some(Node::Group(Emphasis::Plain, argument(rest, depth)))
        } else if (c == '_' || c == '^') && rest.len() > 1 {
            *rest = &rest[1..];
            let inner = argument(rest, depth);
            Some(if c == '_' { Node::Below(inner) } else { Node::Above(inner) })
        } else {
            None
        };
        match node {
            Some(node) => nodes_here.push(node),
            None => {
                text(&mut nodes_here, c);
                *rest = &rest[c.len_utf8()..];
            }
        }
    }
    nodes_here
}

/// `{..}` or one character.
fn argument(rest: &mut &str, depth: usize) -> Vec<Node> {
    if let Some(inside) = rest.strip_prefix('{') {
        *rest = inside;
        let inner = nodes(rest, depth + 1);
        *rest = rest.strip_prefix('}').unwrap_or(rest);
        return inner;
    }
    match rest.chars().next() {
        Some(c) => {
            *rest = &rest[c.len_utf8()..];
            vec![Node::Text(c.into())]
        }
        None => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_becomes_mathml() {
        assert_eq!(
            mathml("k_d^2 + \\f{1}{π}"),
            "<math><msubsup><mi>k</mi><mrow><mi>d</mi></mrow><mrow><mn>2</mn></mrow></msubsup><mo>+</mo>\
             <mfrac><mrow><mn>1</mn></mrow><mrow><mi>π</mi></mrow></mfrac></math>"
        );
        assert!(mathml("!{N·L}").contains("<mrow class=\"on\"><mi>N</mi><mo>·</mo><mi>L</mi></mrow>"));
        assert!(
            mathml("f(x-{, t})")
                .contains("<mrow class=\"struck\"><mo>,</mo><mi>t</mi></mrow><mo stretchy=\"false\">)</mo>")
        );
        assert!(mathml("a < b").contains("<mo>&lt;</mo>"));
        assert!(mathml("cos θ").contains("<mspace"));
    }

    #[test]
    fn a_caption_becomes_html_and_runs() {
        assert_eq!(html("att = 1 / (1 + d^2)"), "att = 1 / (1 + d<sup>2</sup>)");
        let runs = runs("k_d ~{x}");
        let texts: Vec<&str> = runs.iter().map(|r| r.text.as_str()).collect();
        assert_eq!(texts, ["k", "d", " ", "x"]);
        assert!(runs[1].rise < 0.0 && runs[1].size < 1.0 && runs[3].emphasis == Emphasis::Faded);
    }

    #[test]
    fn unfinished_markup_is_not_an_error() {
        for text in ["{", "}", "_", "a_", "^", "\\f{", "\\f{a", "!{", "a}b", &"{".repeat(1000), &"^".repeat(1000)] {
            let _ = (mathml(text), html(text), runs(text));
        }
        assert_eq!(html("a}b"), "a}b");
    }
}
