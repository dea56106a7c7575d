//! Evaluates a shader of a model solution one assignment at a time, for many hypotheses together.
//!
//! Most hypotheses have most quantities in common: those that change the attenuation have the same normals. Each
//! assignment is a small program of its own, which runs once for each different combination of what it reads.

use super::program::run_in_scene;
use crate::mistakes::Assignment;
use gonio_glsl::Stage;
use gonio_interpreter::{CompiledStage, PointValues, StageInputs};
use std::collections::{BTreeMap, HashMap};

/// A shader without branches and loops, as a list of assignments.
pub(super) struct LineByLine {
    lines: Vec<Line>,
    /// For each output of the shader, the line that sets it.
    outputs: Vec<usize>,
}

/// An assignment as a program, whose only output is the value.
struct Line {
    program: CompiledStage,
    /// What it reads, by the inputs of the program.
    reads: Vec<(usize, Read)>,
    /// The index of its way among those of the shader, and the input that selects it.
    way: Option<(usize, usize)>,
}

/// Where a line reads a value.
#[derive(Clone, Copy)]
enum Read {
    /// The value of an earlier line.
    Line(usize),
    /// An input of the shader.
    Input(usize),
}

/// The inputs of a shader whose values differ between points: the index of each, and its components.
pub(super) type PointInputs = Vec<(usize, Vec<Vec<u32>>)>;

/// What hypotheses give a shader.
pub(super) struct Members<'a> {
    /// The number of points of each hypothesis.
    pub points: usize,
    /// For each hypothesis, the way of each changeable line of the shader.
    pub choices: &'a [Vec<i32>],
    /// The inputs with the same value at all points.
    pub same: &'a [(usize, PointValues)],
    /// The others, as different hypotheses have them.
    pub given: &'a [&'a PointInputs],
    /// For each hypothesis, which of `given` it has.
    pub given_of: &'a [u32],
}

/// The values of a line for all hypotheses.
struct LineValues {
    /// For each hypothesis, which of the values it has.
    of_member: Vec<u32>,
    count: usize,
    /// For each component, the numbers at the points of each different value.
    components: Vec<Vec<u32>>,
}

/// Names that mean something at a place of a shader: the type of each, and where it is read.
type Names = BTreeMap<String, (String, Read)>;

/// A function of a shader: its parameters with their types, and its lines.
struct Function {
    parameters: Vec<(String, String)>,
    body: Vec<String>,
}

/// The parts of a shader's text.
#[derive(Default)]
struct Parts {
    /// Structures and constants, which every line may need.
    always: String,
    /// The declaration of each uniform.
    uniforms: BTreeMap<String, String>,
    /// The types of inputs and outputs.
    inputs: BTreeMap<String, String>,
    outputs: BTreeMap<String, String>,
    functions: BTreeMap<String, Function>,
}

impl Parts {
    /// `None` for a text that is not written one assignment a line.
    fn of(text: &str) -> Option<Self> {
        let mut parts = Parts::default();
        let mut lines = text.lines().map(|line| line.split("//").next().unwrap_or_default().trim());
        while let Some(line) = lines.next() {
            let words: Vec<&str> = line.trim_end_matches(';').split_whitespace().collect();
            match words.as_slice() {
                [] => {}
                ["uniform", _, name] => {
                    parts.uniforms.insert((*name).to_owned(), format!("{line}\n"));
                }
                ["in", ty, name] => {
                    parts.inputs.insert((*name).to_owned(), (*ty).to_owned());
                }
                ["out", ty, name] => {
                    parts.outputs.insert((*name).to_owned(), (*ty).to_owned());
                }
                ["struct", ..] => {
                    let rest = lines.by_ref().take_while(|line| *line != "};");
                    let members: String = std::iter::once(line).chain(rest).map(|line| format!("{line}\n")).collect();
                    parts.always.push_str(&members);
                    parts.always.push_str("};\n");
                }
                ["#version" | "const", ..] => {
                    parts.always.push_str(line);
                    parts.always.push('\n');
                }
                _ => {
                    let (head, parameters) = line.strip_suffix(") {")?.split_once('(')?;
                    let name = head.split_whitespace().last()?.to_owned();
                    let typed = |parameter: &str| {
                        let (ty, name) = parameter.trim().split_once(' ')?;
                        Some((ty.to_owned(), name.to_owned()))
                    };
                    let parameters = parameters.split(',').filter(|text| !text.is_empty());
                    let parameters = parameters.map(typed).collect::<Option<Vec<_>>>()?;
                    let body = lines.by_ref().take_while(|line| *line != "}").filter(|line| !line.is_empty());
                    let body = body.map(str::to_owned).collect();
                    parts.functions.insert(name, Function { parameters, body });
                }
            }
        }
        Some(parts)
    }
}

/// The arguments of a call that is a whole value: `f(a, g(b))` has `a` and `g(b)`.
fn arguments<'a>(value: &'a str, name: &str) -> Option<Vec<&'a str>> {
    let inside = value.strip_prefix(name)?.strip_prefix('(')?.strip_suffix(')')?;
    let mut depth = 0;
    let is_between = |c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    };
    Some(inside.split(is_between).map(str::trim).collect())
}

/// The lines of a shader that are being collected.
struct Collecting<'a> {
    whole: &'a CompiledStage,
    parts: &'a Parts,
    /// The names of the changeable lines' uniforms.
    ways: &'a [String],
    lines: Vec<Line>,
}

impl Collecting<'_> {
    /// Adds the program of a value, and returns its index.
    fn add(&mut self, ty: &str, value: &str, names: &Names) -> Option<usize> {
        let mut text = self.parts.always.clone();
        let is_in = |name: &str| {
            let mut words = value.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            words.any(|word| word == name)
        };
        for (name, (ty, _)) in names.iter().filter(|(name, _)| is_in(name)) {
            let flat = if ty.contains("int") { "flat " } else { "" };
            text.push_str(&format!("{flat}in {ty} {name};\n"));
        }
        let hidden = |name: &str| names.contains_key(name);
        let uniforms = self.parts.uniforms.iter().filter(|(name, _)| is_in(name) && !hidden(name));
        text.extend(uniforms.map(|(_, declared)| declared.as_str()));
        text.push_str(&format!("out {ty} value_of_line;\nvoid main() {{ value_of_line = {value}; }}\n"));
        let mut parsed = gonio_glsl::parse(&text);
        let checked = gonio_glsl::check(&mut parsed, Stage::Fragment);
        let program = gonio_interpreter::compile(&parsed, &checked).ok()?;
        let way = self.ways.iter().position(|way| is_in(way));
        let way = way.and_then(|at| Some((at, program.input(&self.ways[at])?)));
        let mut reads = Vec::new();
        for (at, input) in program.inputs.iter().enumerate() {
            if way.is_some_and(|(_, way)| way == at) {
                continue;
            }
            let read = match names.get(&input.name) {
                Some((_, read)) => *read,
                None => Read::Input(self.whole.input(&input.name)?),
            };
            reads.push((at, read));
        }
        self.lines.push(Line { program, reads, way });
        Some(self.lines.len() - 1)
    }

    /// Adds the lines of a function's body. Returns the line of the value that it returns, if any.
    fn add_body(&mut self, body: &[String], names: &mut Names) -> Option<Option<usize>> {
        for line in body {
            if let Some(value) = line.strip_prefix("return ").and_then(|rest| rest.strip_suffix(';')) {
                return match names.get(value) {
                    Some((_, Read::Line(line))) => Some(Some(*line)),
                    _ => None,
                };
            }
            let Assignment { variable: name, ty, value, .. } = Assignment::of(line)?;
            let ty = match ty {
                Some(ty) => ty.to_owned(),
                None if name == "gl_Position" => "vec4".to_owned(),
                None => self.parts.outputs.get(name)?.clone(),
            };
            let called = self.parts.functions.iter().find_map(|(name, called)| Some((called, arguments(value, name)?)));
            let at = match called {
                Some((called, given)) => {
                    let mut inner = Names::new();
                    for ((ty, name), value) in called.parameters.iter().zip(given) {
                        let read = match names.get(value) {
                            Some((_, read)) => *read,
                            None => Read::Line(self.add(ty, value, names)?),
                        };
                        inner.insert(name.clone(), (ty.clone(), read));
                    }
                    self.add_body(&called.body, &mut inner)??
                }
                None => self.add(&ty, value, names)?,
            };
            names.insert(name.to_owned(), (ty, Read::Line(at)));
        }
        Some(None)
    }
}

impl LineByLine {
    /// Takes a shader apart, `whole` as its text says. `ways` are the uniforms that select the ways of its changeable lines.
    /// `None` if it is not written one assignment a line.
    pub fn new(whole: &CompiledStage, text: &str, ways: &[String]) -> Option<Self> {
        let parts = Parts::of(text)?;
        let mut names = Names::new();
        for (name, ty) in &parts.inputs {
            if let Some(input) = whole.input(name) {
                names.insert(name.clone(), (ty.clone(), Read::Input(input)));
            }
        }
        let mut collecting = Collecting { whole, parts: &parts, ways, lines: Vec::new() };
        collecting.add_body(&parts.functions.get("main")?.body, &mut names)?;
        let line_of = |name: &str| match names.get(name) {
            Some((_, Read::Line(line))) => Some(*line),
            _ => None,
        };
        let outputs = whole.outputs.iter().map(|output| line_of(&output.name)).collect::<Option<Vec<_>>>()?;
        Some(LineByLine { lines: collecting.lines, outputs })
    }

    /// The outputs of the shader at the points of each hypothesis, one hypothesis after the other.
    pub fn run(&self, members: &Members<'_>) -> Vec<PointValues> {
        let mut values: Vec<LineValues> = Vec::with_capacity(self.lines.len());
        for line in &self.lines {
            values.push(line.run(members, &values));
        }
        let points = members.points;
        let output = |line: &usize| {
            let LineValues { of_member, components, .. } = &values[*line];
            let all = |component: &Vec<u32>| {
                joined(of_member.iter().map(|at| &component[*at as usize * points..][..points]), points)
            };
            PointValues::Each { components: components.iter().map(all).collect(), written: None }
        };
        self.outputs.iter().map(output).collect()
    }
}

/// Most numbers of a table.
const MOST_IN_TABLE: usize = 1 << 20;

/// Different combinations, numbered from 0.
struct Numbered {
    /// The number of each hypothesis.
    of_member: Vec<u32>,
    count: usize,
}

impl Numbered {
    /// Tells apart what `other`, numbers below `count`, tells apart.
    fn tell_apart(&mut self, other: impl Iterator<Item = u32>, count: usize) {
        let mut next = 0;
        let mut number = |known: &mut u32| {
            if *known == u32::MAX {
                *known = next;
                next += 1;
            }
            *known
        };
        if self.count * count <= MOST_IN_TABLE {
            let mut table = vec![u32::MAX; self.count * count];
            for (of, second) in self.of_member.iter_mut().zip(other) {
                *of = number(&mut table[*of as usize * count + second as usize]);
            }
        } else {
            let mut table: HashMap<(u32, u32), u32> = HashMap::new();
            for (of, second) in self.of_member.iter_mut().zip(other) {
                *of = number(table.entry((*of, second)).or_insert(u32::MAX));
            }
        }
        self.count = next as usize;
    }
}

/// The numbers of several slices, one after the other.
fn joined<'a>(slices: impl ExactSizeIterator<Item = &'a [u32]>, points: usize) -> Vec<u32> {
    let mut all = Vec::with_capacity(slices.len() * points);
    slices.for_each(|slice| all.extend_from_slice(slice));
    all
}

/// The ways of a line for several hypotheses with `points` points each.
pub(super) fn ways_of(mut ways: impl Iterator<Item = i32> + Clone, points: usize) -> PointValues {
    let each = ways.clone().flat_map(|way| std::iter::repeat_n(way as u32, points));
    let first = ways.next().unwrap_or(0);
    match ways.all(|way| way == first) {
        true => PointValues::ints(&[first]),
        false => PointValues::Each { components: vec![each.collect()], written: None },
    }
}

impl Line {
    fn run(&self, members: &Members<'_>, before: &[LineValues]) -> LineValues {
        let all = members.choices.len();
        let choice = |member: usize| self.way.map_or(0, |(at, _)| members.choices[member][at]);
        let is_same = |input: usize| members.same.iter().find(|(known, _)| *known == input).map(|(_, values)| values);
        let mut numbered = Numbered { of_member: vec![0; all], count: 1 };
        if self.way.is_some() {
            let most = (0..all).map(choice).max().unwrap_or(0);
            numbered.tell_apart((0..all).map(|member| choice(member) as u32), most as usize + 1);
        }
        for (_, read) in &self.reads {
            match read {
                Read::Line(line) if before[*line].count > 1 => {
                    numbered.tell_apart(before[*line].of_member.iter().copied(), before[*line].count);
                }
                Read::Input(input) if members.given.len() > 1 && is_same(*input).is_none() => {
                    numbered.tell_apart(members.given_of.iter().copied(), members.given.len());
                }
                _ => {}
            }
        }
        let Numbered { mut of_member, count } = numbered;
        // One hypothesis of each value; those of the same way beside each other, as the interpreter runs one way after the other.
        let mut first = vec![usize::MAX; count];
        for (member, at) in of_member.iter().enumerate().rev() {
            first[*at as usize] = member;
        }
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by_key(|at| choice(first[*at as usize]));
        let mut new = vec![0_u32; count];
        order.iter().enumerate().for_each(|(at, old)| new[*old as usize] = at as u32);
        of_member.iter_mut().for_each(|at| *at = new[*at as usize]);
        let first: Vec<usize> = order.iter().map(|old| first[*old as usize]).collect();

        let points = members.points;
        let mut inputs = StageInputs::new(&self.program, count * points);
        let each = |components| PointValues::Each { components, written: None };
        for (to, read) in &self.reads {
            let values = match read {
                Read::Line(line) => {
                    let of = &before[*line];
                    let at = |member: &usize| of.of_member[*member] as usize * points;
                    let all = |component: &Vec<u32>| {
                        joined(first.iter().map(|member| &component[at(member)..][..points]), points)
                    };
                    each(of.components.iter().map(all).collect())
                }
                Read::Input(input) => match is_same(*input) {
                    Some(values) => values.clone(),
                    None => {
                        let given = |member: &usize| {
                            let given = members.given[members.given_of[*member] as usize];
                            given.iter().find(|(known, _)| known == input).map(|(_, components)| components)
                        };
                        let size = first.first().and_then(given).map_or(0, Vec::len);
                        let numbers = |member, c: usize| given(member).map_or(&[][..], |all| all[c].as_slice());
                        let component = |c| joined(first.iter().map(|member| numbers(member, c)), points);
                        if size == 0 {
                            continue;
                        }
                        each((0..size).map(component).collect())
                    }
                },
            };
            inputs.set(*to, values);
        }
        if let Some((_, input)) = self.way {
            inputs.set(input, ways_of(first.iter().map(|member| choice(*member)), points));
        }
        let result = run_in_scene(&self.program, &inputs);
        let components = match result.outputs.into_iter().next() {
            Some(PointValues::Each { components, .. }) => components,
            _ => Vec::new(),
        };
        LineValues { of_member, count, components }
    }
}
