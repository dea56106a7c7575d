//! A model's text as a list of steps, each of which gives one variable its value.

use super::functions::Function;
use crate::mistakes::Hypotheses;
use gonio_glsl::Stage;
use gonio_glsl::ast::BinaryOp;

/// A uniform that a model reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// OpenGL's name: `light.light_pos`.
    pub name: String,
    /// Its type.
    pub glsl_type: String,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    Number(f32),
    /// A variable, by its number.
    Slot(usize),
    /// A uniform, by its number.
    Input(usize),
    /// An attribute: 0 is the position, 1 the normal.
    Attribute(usize),
    /// `vec3(..)`, `vec4(..)`
    Vector(usize, Vec<Node>),
    /// `mat3(..)`, `mat4(..)`
    Matrix(usize, Box<Node>),
    Swizzle(Box<Node>, Vec<usize>),
    Negate(Box<Node>),
    Binary(BinaryOp, Box<Node>, Box<Node>),
    Select(Box<[Node; 3]>),
    Call(Function, Vec<Node>),
}

impl Node {
    /// Calls `f` for this and all within it.
    pub fn each(&self, f: &mut impl FnMut(&Node)) {
        f(self);
        match self {
            Node::Vector(_, parts) | Node::Call(_, parts) => parts.iter().for_each(|part| part.each(f)),
            Node::Matrix(_, a) | Node::Swizzle(a, _) | Node::Negate(a) => a.each(f),
            Node::Binary(_, a, b) => {
                a.each(f);
                b.each(f);
            }
            Node::Select(parts) => parts.iter().for_each(|part| part.each(f)),
            Node::Number(_) | Node::Slot(_) | Node::Input(_) | Node::Attribute(_) => {}
        }
    }
}

/// What a step may write, with what it reads.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Way {
    pub node: Node,
    pub slots: Vec<usize>,
    pub inputs: Vec<usize>,
}

impl Way {
    pub fn new(node: Node) -> Self {
        let (mut slots, mut inputs) = (Vec::new(), Vec::new());
        node.each(&mut |node| match node {
            Node::Slot(slot) => slots.push(*slot),
            Node::Input(input) => inputs.push(*input),
            _ => {}
        });
        Way { node, slots, inputs }
    }
}

/// The action of a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Act {
    /// Works out one of its ways: the first is the model's own.
    Write(Vec<Way>),
    /// Takes a variable from the vertices to the pixels.
    Interpolate(usize),
}

/// Gives one variable its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    pub slot: usize,
    pub stage: Stage,
    /// The index of the changeable line, if it is one.
    pub line: Option<usize>,
    pub act: Act,
}

/// A model, ready to be worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What is given from outside.
    pub inputs: Vec<Input>,
    pub(super) steps: Vec<Step>,
    /// How many variables there are.
    pub(super) slots: usize,
    /// The variable that is put out.
    pub(super) colour: usize,
}

impl Plan {
    /// Of a model with all its hypotheses; `None` where its text uses what is not known here, as mirrors do with their textures.
    pub fn new(hypotheses: &Hypotheses) -> Option<Plan> {
        super::read::Reader::read(hypotheses)
    }
}
