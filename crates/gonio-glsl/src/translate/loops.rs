//! Loops that end after so many turns, for contexts in which nobody could end them from outside.

use super::Translator;
use crate::ast::{Statement, StatementKind};
use crate::walk::{Visitor, walk_unit};
use crate::{Stage, TokenRange};

/// How loops are made to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopBound {
    /// Turns that all loops of a shader may take together, for one vertex or fragment.
    pub turns: u32,
}

/// The uniform of a bounded shader (a `bool`): while it is false, what took too many turns is not drawn.
pub const DRAWN_ALL_THE_SAME: &str = "gonio_drawn_all_the_same";

const COUNT: &str = "gonio_turns";

impl Translator<'_> {
    /// Each body counts a turn, and leaves its loop from one turn on. Shaders without loops stay as they are.
    pub(super) fn bound_loops(&mut self, bound: LoopBound) {
        struct Bodies(Vec<TokenRange>);
        impl Visitor for Bodies {
            fn statement(&mut self, statement: &Statement) -> bool {
                if let StatementKind::For { body, .. }
                | StatementKind::While { body, .. }
                | StatementKind::DoWhile { body, .. } = &statement.kind
                {
                    self.0.push(body.tokens);
                }
                true
            }
        }
        let mut bodies = Bodies(Vec::new());
        walk_unit(&self.parsed.unit, &mut bodies);
        // What hides in a macro stays as it is.
        let stretches: Vec<(u32, u32)> = bodies.0.into_iter().filter_map(|tokens| self.stretch(tokens)).collect();
        if stretches.is_empty() {
            return;
        }
        let turns = bound.turns;
        for (start, end) in stretches {
            self.edits.surround(start, end, &format!("{{ if (++{COUNT} > {turns}) break; "), " }");
        }
        self.preamble.insert(format!("int {COUNT} = 0;"));
        self.preamble.insert(format!("uniform bool {DRAWN_ALL_THE_SAME};"));
        // A vertex outside of the picture, or no fragment.
        let vanish = if self.stage() == Stage::Vertex { "gl_Position = vec4(2.0, 2.0, 2.0, 1.0)" } else { "discard" };
        self.after_main.push_str(&format!("if ({COUNT} > {turns} && !{DRAWN_ALL_THE_SAME}) {{ {vanish}; }} "));
    }
}
