//! Changes a fragment shader to output the result of one of its cubemap look-ups.

use super::{COLOUR, Translator};
use crate::ast::{Call, Expr, ExprKind};
use crate::walk::{Visitor, walk_unit};
use crate::{Parsed, Span, TokenRange, Type};

/// An expression that samples a cubemap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lookup {
    /// The position of the function's name.
    pub span: Span,
    tokens: TokenRange,
}

/// The variable for the result of the look-up.
const SHOWN: &str = "gonio_shown";
/// A function that stores a colour and returns it.
const SHOW: &str = "gonio_shows";

/// Returns all cubemap look-ups of a shader in source order. The tree must be checked, so that types are known.
#[must_use]
pub fn lookups(parsed: &Parsed) -> Vec<Lookup> {
    struct Found(Vec<Lookup>);
    impl Visitor for Found {
        fn expression(&mut self, expr: &Expr) -> bool {
            if let ExprKind::Call(call) = &expr.kind
                && is_lookup(call)
                && expr.ty.as_ref().is_some_and(|ty| ty.written() == "vec4")
            {
                self.0.push(Lookup { span: call.name_span, tokens: expr.tokens });
            }
            true
        }
    }
    let mut found = Found(Vec::new());
    walk_unit(&parsed.unit, &mut found);
    found.0
}

fn is_lookup(call: &Call) -> bool {
    let of_cube = |arg: &Expr| arg.ty.as_ref().map(Type::written).is_some_and(|ty| ty == "samplerCube");
    call.name.starts_with("texture") && call.args.first().is_some_and(of_cube)
}

impl Translator<'_> {
    /// Outputs the result of `lookup`. A look-up in a macro, or a shader without a colour output, is left unchanged.
    pub(super) fn show(&mut self, lookup: Lookup) {
        let Some((start, end)) = self.stretch(lookup.tokens) else { return };
        let (output, ty) = self.output();
        let letters = match ty.as_str() {
            "vec3" => ".rgb",
            "vec4" => "",
            _ => return,
        };
        self.edits.wrap(start, end, &format!("{SHOW}("));
        self.preamble.insert(format!("vec4 {SHOWN} = vec4(0.0);"));
        self.preamble.insert(format!("vec4 {SHOW}(vec4 colour) {{ {SHOWN} = colour; return colour; }}"));
        self.after_main.push_str(&format!("{output} = {SHOWN}{letters}; "));
    }

    /// Returns the first colour output: its name in the text, and its type.
    fn output(&self) -> (String, String) {
        let outputs = &self.checked.interface.outputs;
        let first = outputs.iter().find(|o| o.location == Some(0)).or_else(|| outputs.iter().find(|o| o.is_used));
        let Some(output) = first else { return (COLOUR.to_owned(), "vec4".to_owned()) };
        let renamed = self.renames.iter().find(|rename| rename.from == output.name);
        let ty = output.ty.as_ref().map_or_else(|| "vec4".to_owned(), Type::written);
        (renamed.map_or(&output.name, |rename| &rename.to).clone(), ty)
    }
}
