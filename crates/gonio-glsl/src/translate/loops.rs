//! Bounds the number of loop iterations. In a browser a draw call cannot be aborted, and other drivers end long loops
//! by themselves and keep drawing, so the same iterations are counted in every context.

use std::collections::BTreeSet;

use super::Translator;
use super::turns::most_turns;
use crate::ast::{Statement, StatementKind};
use crate::walk::{Visitor, walk_unit};
use crate::{Stage, TokenRange};

/// The number of iterations after which loops are ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopBound {
    /// Iterations that all loops of a shader may take together, for one vertex or fragment.
    pub turns: u32,
}

impl LoopBound {
    /// The bound for students' shaders: a thousand times the iterations of loops over lights and samples, and below
    /// 65,535: after that many llvmpipe (Mesa 22.3) silently leaves all loops, counting for 4 to 16 pixels together.
    pub const STUDENTS: Self = Self { turns: 50_000 };
}

/// The uniform of a bounded shader (a `bool`). While it is false, vertices and fragments with too many iterations are
/// not drawn; while it is true, such fragments are drawn, and such vertices are scattered over the image.
pub const DRAWN_ALL_THE_SAME: &str = "gonio_drawn_all_the_same";

const COUNT: &str = "gonio_turns";

impl Translator<'_> {
    /// Makes each loop body count an iteration and leave its loop after the bound. Shaders whose loops evidently end
    /// within the bound stay unchanged, so that compilers unroll them as usual.
    pub(super) fn bound_loops(&mut self, bound: LoopBound) {
        let turns = bound.turns;
        if most_turns(&self.parsed.unit, self.checked).is_some_and(|most| most <= u64::from(turns)) {
            return;
        }
        let mut found = Found::default();
        walk_unit(&self.parsed.unit, &mut found);
        // A macro that is used twice is changed once.
        let bodies: BTreeSet<_> = found.bodies.into_iter().filter_map(|tokens| self.stretch(tokens)).collect();
        if bodies.is_empty() {
            return;
        }
        for (start, end) in bodies {
            self.edits.surround(start, end, &format!("{{ if (++{COUNT} > {turns}) break; "), " }");
        }
        // A discarded fragment would not reveal its loop.
        let discards: BTreeSet<_> = found.discards.into_iter().filter_map(|tokens| self.stretch(tokens)).collect();
        for (start, end) in discards {
            self.edits.surround(start, end, &format!("{{ if ({COUNT} <= {turns}) "), " }");
        }
        self.preamble.insert(format!("int {COUNT} = 0;"));
        self.preamble.insert(format!("uniform bool {DRAWN_ALL_THE_SAME};"));
        let vanish = match self.stage() {
            Stage::Vertex => {
                // Scattered over the whole image, so that triangles have an area whatever the numbers of their
                // vertices.
                let place = |step: &str| format!("fract({step} * float(gl_VertexID)) * 3.0 - 1.5");
                let scattered = format!("vec4({}, {}, 0.0, 1.0)", place("0.618034"), place("0.754878"));
                format!("gl_Position = {DRAWN_ALL_THE_SAME} ? {scattered} : vec4(2.0, 2.0, 2.0, 1.0);")
            }
            Stage::Fragment => format!("if (!{DRAWN_ALL_THE_SAME}) discard;"),
        };
        self.after_main.push_str(&format!("if ({COUNT} > {turns}) {{ {vanish} }} "));
    }
}

#[derive(Default)]
struct Found {
    bodies: Vec<TokenRange>,
    discards: Vec<TokenRange>,
}

impl Visitor for Found {
    fn statement(&mut self, statement: &Statement) -> bool {
        match &statement.kind {
            StatementKind::For { body, .. }
            | StatementKind::While { body, .. }
            | StatementKind::DoWhile { body, .. } => self.bodies.push(body.tokens),
            StatementKind::Discard => self.discards.push(statement.tokens),
            _ => {}
        }
        true
    }
}
