//! Evaluates a plan.

use super::plan::{Action, EvaluationPlan, Node, Step, Variant};
use super::value::resized;
use super::value::{Spans, Value};
use gonio_glsl::Stage;
use gonio_glsl::ast::BinaryOp;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// The vertices of the meshes, test scene by test scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// The range of each test scene.
    pub spans: Vec<Range<usize>>,
    /// Position and normal, one plane for each component.
    pub attributes: [Rc<Value>; 2],
}

/// The covered pixels, test scene by test scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fragments {
    /// The range of each test scene.
    pub spans: Vec<Range<usize>>,
    /// The three vertices of the triangle that a pixel shows: indices into [`Points`].
    pub corners: Vec<[u32; 3]>,
    /// Weights of the vertices with perspective correction; their sum is 1.
    pub shares: Vec<[f32; 3]>,
}

/// The values of all uniforms of a model solution.
pub type InputSet = Vec<Rc<Value>>;

/// Evaluates a model solution over one set of pixels: the model itself once, and for each hypothesis only what it
/// changes.
pub struct Run {
    plan: Rc<EvaluationPlan>,
    points: Rc<Points>,
    drawn: Fragments,
    input_sets: Rc<Vec<InputSet>>,
    /// For each uniform, whether it differs between the input sets.
    varying: Vec<bool>,
    /// The value of each variable in each input set.
    own: Vec<PerSet>,
}

/// The value of a variable in each input set; one value if it is the same in all.
type PerSet = Vec<Rc<Value>>;

impl Run {
    /// Evaluates the model itself.
    pub fn new(plan: Rc<EvaluationPlan>, points: Rc<Points>, drawn: Fragments, input_sets: Rc<Vec<InputSet>>) -> Self {
        let varying = (0..plan.inputs.len())
            .map(|input| input_sets.windows(2).any(|pair| pair[0].get(input) != pair[1].get(input)))
            .collect();
        let mut run =
            Run { plan: Rc::clone(&plan), points, drawn, input_sets, varying, own: Vec::with_capacity(plan.slots) };
        for step in &plan.steps {
            let value = run.step(step, 0, &|slot| run.own.get(slot).map_or(&[][..], |of| of));
            run.own.push(value);
        }
        run
    }

    /// Returns the output of the model under a hypothesis for each input set: red, green and blue. `choices` are the
    /// variants of lines, from 1.
    pub fn colours(&self, choices: &BTreeMap<usize, usize>) -> Vec<Rc<Value>> {
        let mut changed: Vec<Option<PerSet>> = vec![None; self.plan.slots];
        for step in &self.plan.steps {
            let way = step.line.and_then(|line| choices.get(&line)).copied().unwrap_or(0);
            let touched = |slot: &usize| changed[*slot].is_some();
            let is_new = match &step.action {
                Action::Write(ways) => way > 0 || ways.first().is_some_and(|way| way.slots.iter().any(touched)),
                Action::Interpolate(from) => touched(from),
            };
            if is_new {
                let value = self.step(step, way, &|slot| match &changed[slot] {
                    Some(value) => value,
                    None => self.own.get(slot).map_or(&[][..], |of| of),
                });
                changed[step.slot] = Some(value);
            }
        }
        let colour = changed[self.plan.colour].take().unwrap_or_else(|| self.own[self.plan.colour].clone());
        (0..self.input_sets.len()).filter_map(|set| of_set(&colour, set).cloned()).collect()
    }

    fn step<'v>(&self, step: &Step, way: usize, known: &dyn Fn(usize) -> &'v [Rc<Value>]) -> PerSet {
        match &step.action {
            Action::Interpolate(from) => known(*from).iter().map(|value| self.interpolated(value)).collect(),
            Action::Write(ways) => {
                let Some(way) = ways.get(way).or(ways.first()) else { return Vec::new() };
                let count = if self.varies(way, known) { self.input_sets.len() } else { 1 };
                (0..count).map(|set| self.node(&way.node, step.stage, set, known)).collect()
            }
        }
    }

    fn varies<'v>(&self, way: &Variant, known: &dyn Fn(usize) -> &'v [Rc<Value>]) -> bool {
        way.inputs.iter().any(|&input| self.varying.get(input).copied().unwrap_or(true))
            || way.slots.iter().any(|&slot| known(slot).len() > 1)
    }

    fn spans(&self, stage: Stage) -> &Spans {
        if stage == Stage::Vertex { &self.points.spans } else { &self.drawn.spans }
    }

    fn interpolated(&self, value: &Rc<Value>) -> Rc<Value> {
        let Value::Each(planes) = &**value else { return Rc::clone(value) };
        let interpolate = |plane: &Vec<f32>| {
            let at = |corner: u32| plane.get(corner as usize).copied().unwrap_or(0.0);
            let pixels = self.drawn.corners.iter().zip(&self.drawn.shares);
            pixels.map(|([a, b, c], [x, y, z])| at(*a) * x + at(*b) * y + at(*c) * z).collect()
        };
        Rc::new(Value::Each(planes.iter().map(interpolate).collect()))
    }

    fn node<'v>(&self, node: &Node, stage: Stage, set: usize, known: &dyn Fn(usize) -> &'v [Rc<Value>]) -> Rc<Value> {
        let spans = self.spans(stage);
        let of = |node: &Node| self.node(node, stage, set, known);
        let nothing = || Rc::new(Value::number(0.0, spans.len()));
        let found = match node {
            Node::Number(number) => Some(Value::number(*number, spans.len())),
            Node::Slot(slot) => return of_set(known(*slot), set).cloned().unwrap_or_else(nothing),
            Node::Input(input) => {
                return self.input_sets.get(set).and_then(|set| set.get(*input)).cloned().unwrap_or_else(nothing);
            }
            Node::Attribute(attribute) => return Rc::clone(&self.points.attributes[(*attribute).min(1)]),
            Node::Vector(width, parts) => Some(vector(*width, &parts.iter().map(of).collect::<Vec<_>>(), spans)),
            Node::Matrix(size, of_what) => resized(&of(of_what), *size),
            Node::Swizzle(of_what, components) => Some(of(of_what).swizzle(components)),
            Node::Negate(of_what) => Some(of(of_what).map(|x| -x)),
            Node::Binary(op, left, right) => binary(*op, &of(left), &of(right), spans),
            Node::Select(parts) => {
                let [condition, then, otherwise] = &**parts;
                Some(of(condition).select(&of(then), &of(otherwise), spans))
            }
            Node::Call(function, arguments) => function.call(&arguments.iter().map(of).collect::<Vec<_>>(), spans),
        };
        found.map_or_else(nothing, Rc::new)
    }
}

fn of_set(values: &[Rc<Value>], set: usize) -> Option<&Rc<Value>> {
    values.get(set).or(values.first())
}

fn binary(op: BinaryOp, a: &Value, b: &Value, spans: &Spans) -> Option<Value> {
    let truth = |is: bool| if is { 1.0 } else { 0.0 };
    Some(match op {
        BinaryOp::Multiply if matches!(a, Value::Matrix(..)) => a.transform(b, spans)?,
        BinaryOp::Multiply => a.zip(b, spans, |a, b| a * b),
        BinaryOp::Divide => a.zip(b, spans, |a, b| a / b),
        BinaryOp::Add => a.zip(b, spans, |a, b| a + b),
        BinaryOp::Subtract => a.zip(b, spans, |a, b| a - b),
        BinaryOp::Greater => a.zip(b, spans, |a, b| truth(a > b)),
        BinaryOp::Less => a.zip(b, spans, |a, b| truth(a < b)),
        _ => return None,
    })
}

/// Evaluates `vec3(x)` and `vec4(v, 1.0)`: the components in order; a single number is repeated.
fn vector(width: usize, parts: &[Rc<Value>], spans: &Spans) -> Value {
    if let [only] = parts
        && only.width() == 1
    {
        return only.swizzle(&vec![0; width]);
    }
    let places: Vec<(&Rc<Value>, usize)> =
        parts.iter().flat_map(|part| (0..part.width()).map(move |c| (part, c))).take(width).collect();
    if parts.iter().all(|part| matches!(**part, Value::Same(..))) {
        let number = |test_scene: usize| {
            std::array::from_fn(|i| match places.get(i).map(|(part, c)| (&***part, *c)) {
                Some((Value::Same(_, numbers), c)) => numbers.get(test_scene).map_or(0.0, |n| n[c]),
                _ => 0.0,
            })
        };
        return Value::Same(width, (0..spans.len()).map(number).collect());
    }
    Value::Each(places.iter().map(|(part, c)| part.plane(*c, spans)).collect())
}
