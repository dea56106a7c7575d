//! A model solution as a list of steps, each of which computes one variable.

use super::value::BuiltinFunction;
use crate::mistakes::Hypotheses;
use gonio_glsl::ast::{BinaryOp, Call, Function, Item, Literal, UnaryOp};
use gonio_glsl::{Expr, ExprKind, Stage, Statement, StatementKind};
use std::collections::HashMap;

/// A uniform that a model reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelUniform {
    /// Its name in OpenGL: `light.light_pos`.
    pub name: String,
    /// Its type.
    pub glsl_type: String,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    Number(f32),
    /// A variable, by its index.
    Slot(usize),
    /// A uniform, by its index.
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
    Call(BuiltinFunction, Vec<Node>),
}

impl Node {
    /// Calls `f` for this node and all nodes within it.
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

/// An expression that a step may compute, with the variables and uniforms that it reads.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Variant {
    pub node: Node,
    pub slots: Vec<usize>,
    pub inputs: Vec<usize>,
}

impl Variant {
    pub fn new(node: Node) -> Self {
        let (mut slots, mut inputs) = (Vec::new(), Vec::new());
        node.each(&mut |node| match node {
            Node::Slot(slot) => slots.push(*slot),
            Node::Input(input) => inputs.push(*input),
            _ => {}
        });
        Variant { node, slots, inputs }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Action {
    /// Evaluates one of its variants; the first is that of the model itself.
    Write(Vec<Variant>),
    /// Interpolates a variable from the vertices to the pixels.
    Interpolate(usize),
}

/// Computes one variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    pub slot: usize,
    pub stage: Stage,
    /// The index of the changeable line, if it is one.
    pub line: Option<usize>,
    pub action: Action,
}

/// A model solution prepared for evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationPlan {
    /// The uniforms that it reads.
    pub inputs: Vec<ModelUniform>,
    pub(super) steps: Vec<Step>,
    /// Number of variables.
    pub(super) slots: usize,
    /// The variable that is the output colour.
    pub(super) colour: usize,
}

impl EvaluationPlan {
    /// Prepares a model solution with all its hypotheses. Returns `None` if its text uses a feature that the
    /// interpreter lacks, such as the textures of mirrors.
    pub fn new(hypotheses: &Hypotheses) -> Option<EvaluationPlan> {
        Reader::read(hypotheses)
    }
}

/// Indices of variables by name.
type Frame = HashMap<String, usize>;

pub(super) struct Reader<'a> {
    /// The variables that the catalogue changes, in its order.
    lines: &'a [String],
    inputs: Vec<ModelUniform>,
    steps: Vec<Step>,
    slots: usize,
    stage: Stage,
    /// The first frame holds the globals, the last the variables of the current function.
    frames: Vec<Frame>,
    functions: HashMap<String, Function>,
    outputs: Vec<String>,
}

/// The attributes, in the order of [`Node::Attribute`].
const ATTRIBUTES: [&str; 2] = ["position", "normal"];

impl<'a> Reader<'a> {
    pub fn read(hypotheses: &'a Hypotheses) -> Option<EvaluationPlan> {
        let mut reader = Reader {
            lines: &hypotheses.variables,
            inputs: Vec::new(),
            steps: Vec::new(),
            slots: 0,
            stage: Stage::Vertex,
            frames: Vec::new(),
            functions: HashMap::new(),
            outputs: Vec::new(),
        };
        let [vertex, fragment] = hypotheses.sources();
        let written = reader.stage(&vertex, Stage::Vertex, &Frame::new())?;
        let written = reader.stage(&fragment, Stage::Fragment, &written)?;
        let colour = *written.get("FragColor")?;
        Some(EvaluationPlan { inputs: reader.inputs, steps: reader.steps, slots: reader.slots, colour })
    }

    fn stage(&mut self, source: &str, stage: Stage, handed_over: &Frame) -> Option<Frame> {
        let mut parsed = gonio_glsl::parse(source);
        let checked = gonio_glsl::check(&mut parsed, stage);
        self.stage = stage;
        self.functions.clear();
        self.frames = vec![Frame::new()];
        for leaf in gonio_glsl::leaves(&checked.interface) {
            if !leaf.name.starts_with("way_") && self.inputs.iter().all(|known| known.name != leaf.name) {
                self.inputs.push(ModelUniform { name: leaf.name, glsl_type: leaf.ty.written() });
            }
        }
        if stage == Stage::Fragment {
            for input in &checked.interface.inputs {
                let from = *handed_over.get(&input.name)?;
                let slot = self.step(None, Action::Interpolate(from));
                self.frames[0].insert(input.name.clone(), slot);
            }
        }
        self.outputs = checked.interface.outputs.iter().map(|output| output.name.clone()).collect();
        for item in parsed.unit.items {
            if let Item::Function(function) = item {
                self.functions.insert(function.name.clone(), function);
            }
        }
        let main = self.functions.get("main")?.body.clone()?;
        self.frames.push(Frame::new());
        self.body(&main)?;
        self.frames.pop();
        self.frames.pop()
    }

    fn step(&mut self, line: Option<usize>, action: Action) -> usize {
        let slot = self.slots;
        self.slots += 1;
        self.steps.push(Step { slot, stage: self.stage, line, action });
        slot
    }

    /// Reads statements in order. Returns the returned expression, if any.
    fn body(&mut self, statements: &[Statement]) -> Option<Option<Node>> {
        for statement in statements {
            match &statement.kind {
                StatementKind::Declaration(declaration) => {
                    for declarator in &declaration.declarators {
                        self.write(&declarator.name, declarator.initialiser.as_ref()?)?;
                    }
                }
                StatementKind::Expression(Expr { kind: ExprKind::Assign { op: None, target, value }, .. }) => {
                    let ExprKind::Name(name) = &target.kind else { return None };
                    // The driver determines the pixels.
                    if name != "gl_Position" {
                        self.write(name, value)?;
                    }
                }
                StatementKind::Return(Some(value)) => return Some(Some(self.node(value)?)),
                StatementKind::Empty => {}
                _ => return None,
            }
        }
        Some(None)
    }

    fn write(&mut self, name: &str, value: &Expr) -> Option<()> {
        let (line, ways) = self.ways(value)?;
        let slot = self.step(line, Action::Write(ways));
        let frame = if self.outputs.iter().any(|output| output == name) {
            self.frames.first_mut()
        } else {
            self.frames.last_mut()
        };
        frame?.insert(name.to_owned(), slot);
        Some(())
    }

    /// Reads `way_x == 1 ? (a) : way_x == 2 ? (b) : (own)`. The variant of the model itself comes first.
    fn ways(&mut self, value: &Expr) -> Option<(Option<usize>, Vec<Variant>)> {
        let (mut line, mut ways, mut rest) = (None, Vec::new(), value);
        while let ExprKind::Ternary { condition, then, otherwise } = &rest.kind
            && let ExprKind::Binary { op: BinaryOp::Equal, left, .. } = &condition.kind
            && let ExprKind::Name(name) = &left.kind
            && let Some(variable) = name.strip_prefix("way_")
        {
            line = self.lines.iter().position(|known| known == variable);
            ways.push(Variant::new(self.node(then)?));
            rest = otherwise;
        }
        ways.insert(0, Variant::new(self.node(rest)?));
        Some((line, ways))
    }

    fn name(&self, name: &str) -> Option<Node> {
        let of = |frame: Option<&Frame>| frame.and_then(|frame| frame.get(name)).copied();
        if let Some(slot) = of(self.frames.last()).or_else(|| of(self.frames.first())) {
            return Some(Node::Slot(slot));
        }
        if let Some(input) = self.inputs.iter().position(|input| input.name == name) {
            return Some(Node::Input(input));
        }
        ATTRIBUTES.iter().position(|attribute| *attribute == name).map(Node::Attribute)
    }

    fn node(&mut self, expr: &Expr) -> Option<Node> {
        Some(match &expr.kind {
            ExprKind::Literal(Literal::Float(number) | Literal::Double(number)) => Node::Number(*number as f32),
            ExprKind::Literal(Literal::Int(number)) => Node::Number(*number as f32),
            ExprKind::Name(name) => self.name(name)?,
            ExprKind::Field { base, name, .. } => {
                if let ExprKind::Name(of) = &base.kind
                    && let Some(input) = self.name(&format!("{of}.{name}"))
                {
                    return Some(input);
                }
                let letters = name.chars().map(|letter| "xyzw".find(letter).or_else(|| "rgba".find(letter)));
                Node::Swizzle(Box::new(self.node(base)?), letters.collect::<Option<_>>()?)
            }
            ExprKind::Unary { op: UnaryOp::Minus, operand } => Node::Negate(Box::new(self.node(operand)?)),
            ExprKind::Binary { op, left, right } => {
                use BinaryOp::{Add, Divide, Greater, Less, Multiply, Subtract};
                if !matches!(op, Add | Subtract | Multiply | Divide | Greater | Less) {
                    return None;
                }
                Node::Binary(*op, Box::new(self.node(left)?), Box::new(self.node(right)?))
            }
            ExprKind::Ternary { condition, then, otherwise } => {
                Node::Select(Box::new([self.node(condition)?, self.node(then)?, self.node(otherwise)?]))
            }
            ExprKind::Call(call) => self.call(call)?,
            _ => return None,
        })
    }

    fn call(&mut self, call: &Call) -> Option<Node> {
        let arguments: Vec<Node> = call.args.iter().map(|argument| self.node(argument)).collect::<Option<_>>()?;
        let one = |arguments: Vec<Node>| <[Node; 1]>::try_from(arguments).ok().map(|[only]| Box::new(only));
        match call.name.as_str() {
            "float" => return one(arguments).map(|only| *only),
            "vec2" => return Some(Node::Vector(2, arguments)),
            "vec3" => return Some(Node::Vector(3, arguments)),
            "vec4" => return Some(Node::Vector(4, arguments)),
            "mat3" => return Some(Node::Matrix(3, one(arguments)?)),
            "mat4" => return Some(Node::Matrix(4, one(arguments)?)),
            _ => {}
        }
        if let Some(function) = BuiltinFunction::by_name(&call.name) {
            return (arguments.len() == function.arguments()).then_some(Node::Call(function, arguments));
        }
        let function = self.functions.get(&call.name)?.clone();
        let mut frame = Frame::new();
        for (param, argument) in function.params.iter().zip(arguments) {
            let slot = self.step(None, Action::Write(vec![Variant::new(argument)]));
            frame.insert(param.name.clone(), slot);
        }
        // The functions of model solutions are not recursive.
        if self.frames.len() > 8 {
            return None;
        }
        self.frames.push(frame);
        let returned = self.body(function.body.as_ref()?)?;
        self.frames.pop();
        returned
    }
}
