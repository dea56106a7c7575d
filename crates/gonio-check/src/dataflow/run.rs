//! Executes a pair of shaders symbolically. The result is a graph of the values that each output is computed from.

use super::Shader;
use super::graph::{Graph, Id, Op};
use crate::roles::{self, Declared, NamesFile, Role};
use gonio_glsl::ast::{Condition, Declaration, Declarator, Expr, Function, InterfaceBlock, Item, TypeName, has};
use gonio_glsl::{Span, Stage, Statement, StatementKind, Storage, Type};
use std::collections::{BTreeMap, HashMap};

/// A program and the nodes that it outputs.
pub(crate) struct Program {
    pub graph: Graph,
    /// `gl_Position`, if it is written.
    pub position: Option<Id>,
    /// The colour of the fragment, if it is written.
    pub colour: Option<Id>,
}

/// Most statements and expressions that are executed; this bounds nested loops and calls.
const MOST_STEPS: usize = 60_000;
/// Number of saved names that cost one step.
const NAMES_A_STEP: usize = 16;
/// Most levels of expressions, statements and calls.
const MOST_DEEP: usize = 220;
/// Most levels of calls.
const MOST_CALLS: usize = 12;
/// Most iterations of a loop whose count is known; other loops are executed once.
const MOST_ROUNDS: usize = 8;

/// Sorted by name, so that every run names the same one of several candidates.
type Scope = BTreeMap<String, Id>;

/// The roles of inputs by name.
pub(crate) type Roles = HashMap<String, Role>;

/// The control flow after a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flow {
    Next,
    /// Continues after the loop or `switch`.
    Broke,
    /// Continues after the function or the iteration.
    Left,
}

pub(crate) struct Runner<'a> {
    pub(crate) graph: &'a mut Graph,
    pub(crate) stage: Stage,
    pub(crate) roles: &'a Roles,
    pub(crate) functions: HashMap<&'a str, Vec<&'a Function>>,
    /// The first scope holds the globals, the others belong to the current function.
    pub(crate) scopes: Vec<Scope>,
    structs: HashMap<&'a str, &'a [(String, Option<Type>)]>,
    /// The returned values of the current function, each with its condition.
    returned: Vec<(Option<Id>, Id)>,
    pub(crate) conditions: Vec<Id>,
    /// Early ends of `main`: the condition and the values of the globals.
    exits: Vec<(Id, Scope)>,
    steps: usize,
    deep: usize,
    calls: usize,
}

impl Program {
    pub fn new(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Self {
        let roles = roles(vertex, fragment, names);
        let mut graph = Graph::new();
        let outputs = Runner::new(&mut graph, vertex, Stage::Vertex, &roles, &BTreeMap::new()).run(vertex);
        let position = outputs.get("gl_Position").copied();
        let mut colours = Runner::new(&mut graph, fragment, Stage::Fragment, &roles, &outputs).run(fragment);
        let named = ["gl_FragColor", "gl_FragData"].iter().find_map(|name| colours.remove(*name));
        let declared = fragment.checked.interface.outputs.iter();
        // Not a second output, such as a brightness for bloom.
        let mut known =
            declared.filter_map(|output| colours.get(&output.name).copied()).filter(|id| *id != Graph::UNKNOWN);
        let colour = known.next().or(named.filter(|id| *id != Graph::UNKNOWN));
        Program { graph, position, colour }
    }
}

/// Returns the roles of the attributes and uniforms of both stages.
fn roles(vertex: &Shader, fragment: &Shader, names: &NamesFile) -> Roles {
    let mut declared: Vec<Declared> = Vec::new();
    for input in vertex.checked.interface.inputs.iter().filter(|input| input.is_used) {
        if let Some(ty) = &input.ty {
            declared.push(Declared::attribute(&input.name, ty.innermost().written()));
        }
    }
    for shader in [vertex, fragment] {
        let interface = &shader.checked.interface;
        let leaves = gonio_glsl::leaves(interface);
        let used = leaves.iter().filter(|leaf| interface.uniforms.get(leaf.uniform).is_some_and(|u| u.is_used));
        let mut found: Vec<Declared> = used
            .map(|leaf| Declared { array: leaf.count, ..Declared::uniform(&leaf.name, leaf.ty.written()) })
            .collect();
        for member in interface.blocks.iter().filter(|b| b.storage == Storage::Uniform).flat_map(|b| &b.members) {
            if let Some(ty) = &member.ty {
                found.push(Declared::uniform(&member.name, ty.innermost().written()));
            }
        }
        for uniform in found {
            if !declared.iter().any(|known| known.name == uniform.name) {
                declared.push(uniform);
            }
        }
    }
    let mut roles: Roles = roles::bind(&declared, names).bound.into_iter().map(|b| (b.declared.name, b.role)).collect();
    for (name, role) in [
        ("gl_Vertex", Role::Position),
        ("gl_Normal", Role::Normal),
        ("gl_ModelViewMatrix", Role::ModelView),
        ("gl_ProjectionMatrix", Role::Projection),
        ("gl_ModelViewProjectionMatrix", Role::ModelViewProjection),
        ("gl_NormalMatrix", Role::NormalMatrixOfModelView),
    ] {
        roles.insert(name.to_owned(), role);
    }
    roles
}

impl<'a> Runner<'a> {
    fn new(
        graph: &'a mut Graph,
        shader: &Shader<'a>,
        stage: Stage,
        roles: &'a Roles,
        vertex_outputs: &BTreeMap<String, Id>,
    ) -> Self {
        let interface = &shader.checked.interface;
        let structs = interface.structs.iter().map(|s| (s.name.as_str(), s.members.as_slice())).collect();
        let mut functions: HashMap<&str, Vec<&Function>> = HashMap::new();
        for item in &shader.parsed.unit.items {
            if let Item::Function(function) = item
                && function.body.is_some()
            {
                functions.entry(&function.name).or_default().push(function);
            }
        }
        let mut runner = Runner {
            graph,
            stage,
            roles,
            functions,
            scopes: vec![Scope::new()],
            structs,
            returned: Vec::new(),
            conditions: Vec::new(),
            exits: Vec::new(),
            steps: 0,
            deep: 0,
            calls: 0,
        };
        for item in &shader.parsed.unit.items {
            match item {
                Item::Declaration(declaration) => runner.global(declaration, vertex_outputs),
                Item::Block(block) => runner.block(block, vertex_outputs),
                _ => {}
            }
        }
        runner
    }

    /// Executes `main` and returns the globals afterwards: outputs by name, members of blocks by `Block.member`.
    fn run(mut self, shader: &Shader<'a>) -> BTreeMap<String, Id> {
        let main = self.functions.get("main").and_then(|found| found.first().copied());
        if let Some(body) = main.and_then(|main| main.body.as_ref()) {
            self.scopes.push(Scope::new());
            self.statements(body);
        }
        for (test, early) in std::mem::take(&mut self.exits).into_iter().rev() {
            for (name, a) in early {
                let b = self.scopes[0].get(&name).copied().unwrap_or(Graph::UNKNOWN);
                if a != b && a != Graph::UNKNOWN && b != Graph::UNKNOWN {
                    let span = self.graph.node(b).span;
                    let merged = self.graph.push_like(Op::Select(test, a, b), b, self.stage, span);
                    self.scopes[0].insert(name, merged);
                }
            }
        }
        let globals = self.scopes.into_iter().next().unwrap_or_default();
        let mut outputs: BTreeMap<String, Id> = globals.into_iter().collect();
        for block in shader.checked.interface.blocks.iter().filter(|b| b.storage == Storage::Out) {
            if let Some(instance) = block.instance.as_ref().and_then(|name| outputs.get(name)).copied() {
                outputs.insert(format!("{} (block)", block.name), instance);
            }
        }
        outputs
    }

    pub(crate) fn push(&mut self, op: Op, span: Span, ty: Option<&Type>) -> Id {
        self.graph.push(op, self.stage, span, ty)
    }

    fn input(&mut self, name: &str, span: Span, ty: Option<&Type>) -> Id {
        let role = super::eval::role(self.roles, name);
        self.push(Op::Input { name: name.to_owned(), role }, span, ty)
    }

    /// Interpolates an output of the vertex shader, member by member.
    fn interpolated(&mut self, output: Id, span: Span, depth: usize) -> Id {
        if let Op::Struct(fields) = self.graph.op(self.graph.plain(output)).clone()
            && depth < 8
        {
            let fields = fields.into_iter().map(|(name, id)| (name, self.interpolated(id, span, depth + 1))).collect();
            return self.push(Op::Struct(fields), span, None);
        }
        self.graph.push_like(Op::Interpolated(output), output, self.stage, span)
    }

    fn global(&mut self, declaration: &'a Declaration, vertex_outputs: &BTreeMap<String, Id>) {
        let qualifiers = &declaration.qualifiers;
        for declarator in &declaration.declarators {
            let ty = self.declared_type(&declaration.ty, declarator);
            let comes_in = has(qualifiers, "in") || has(qualifiers, "attribute");
            let varies = self.stage == Stage::Fragment && (comes_in || has(qualifiers, "varying"));
            let id = if has(qualifiers, "uniform") || comes_in && self.stage == Stage::Vertex {
                self.input(&declarator.name, declarator.span, ty.as_ref())
            } else if varies {
                let output = vertex_outputs.get(&declarator.name).copied().unwrap_or(Graph::UNKNOWN);
                self.interpolated(output, declarator.span, 0)
            } else if let Some(initialiser) = &declarator.initialiser {
                let value = self.expression(initialiser);
                let span = declarator.span.to(initialiser.span);
                self.graph.push_like(Op::Copy(value, declarator.name.clone()), value, self.stage, span)
            } else {
                Graph::UNKNOWN
            };
            self.scopes[0].insert(declarator.name.clone(), id);
        }
    }

    fn block(&mut self, block: &'a InterfaceBlock, vertex_outputs: &BTreeMap<String, Id>) {
        let members: Vec<(&Declaration, &Declarator)> =
            block.members.iter().flat_map(|member| member.declarators.iter().map(move |d| (member, d))).collect();
        let is_uniform = has(&block.qualifiers, "uniform") || has(&block.qualifiers, "buffer");
        let from = vertex_outputs.get(&format!("{} (block)", block.name)).copied();
        let mut fields = Vec::new();
        for (declaration, declarator) in members {
            let name = &declarator.name;
            let ty = self.declared_type(&declaration.ty, declarator);
            let id = if is_uniform {
                self.input(name, declarator.span, ty.as_ref())
            } else if has(&block.qualifiers, "in") && self.stage == Stage::Fragment {
                let inner = from.and_then(|from| self.member_of_struct(from, name));
                let inner = inner.or_else(|| vertex_outputs.get(name).copied()).unwrap_or(Graph::UNKNOWN);
                self.interpolated(inner, declarator.span, 0)
            } else {
                Graph::UNKNOWN
            };
            fields.push((name.clone(), id));
        }
        if let Some(instance) = &block.instance {
            let id = self.push(Op::Struct(fields), block.span, None);
            self.scopes[0].insert(instance.name.clone(), id);
        } else {
            self.scopes[0].extend(fields);
        }
    }

    fn declared_type(&self, ty: &TypeName, declarator: &Declarator) -> Option<Type> {
        if !ty.sizes.is_empty() || !declarator.sizes.is_empty() {
            return None;
        }
        Type::named(&ty.name)
    }

    /// Returns the members of a struct in order.
    pub(crate) fn members(&self, name: &str) -> Option<&'a [(String, Option<Type>)]> {
        self.structs.get(name).copied()
    }

    pub(crate) fn member_of_struct(&self, id: Id, name: &str) -> Option<Id> {
        match self.graph.op(self.graph.plain(id)) {
            Op::Struct(fields) => fields.iter().find(|(field, _)| field == name).map(|(_, id)| *id),
            _ => None,
        }
    }

    /// Takes a step and enters a level. Returns whether that is allowed; `leave` must follow in either case.
    pub(crate) fn enter(&mut self) -> bool {
        self.steps += 1;
        self.deep += 1;
        self.steps < MOST_STEPS && self.deep < MOST_DEEP
    }

    /// Charges steps for a copy of the outermost scopes: a branch costs more if there are thousands of names.
    pub(crate) fn pay_for(&mut self, scopes: usize) {
        let names: usize = self.scopes.iter().take(scopes).map(Scope::len).sum();
        self.steps += names / NAMES_A_STEP;
    }

    pub(crate) fn leave(&mut self) {
        self.deep -= 1;
    }

    pub(crate) fn statements(&mut self, list: &'a [Statement]) -> Flow {
        for statement in list {
            let flow = self.statement(statement);
            if flow != Flow::Next {
                return flow;
            }
        }
        Flow::Next
    }

    pub(crate) fn in_scope(&mut self, run: impl FnOnce(&mut Self) -> Flow) -> Flow {
        self.scopes.push(Scope::new());
        let flow = run(self);
        self.scopes.pop();
        flow
    }

    pub(crate) fn statement(&mut self, statement: &'a Statement) -> Flow {
        let flow = if self.enter() { self.statement_within(statement) } else { Flow::Left };
        self.leave();
        flow
    }

    fn statement_within(&mut self, statement: &'a Statement) -> Flow {
        match &statement.kind {
            StatementKind::Declaration(declaration) => self.local(declaration),
            StatementKind::Expression(expr) => {
                self.expression(expr);
            }
            StatementKind::Block(list) => return self.in_scope(|runner| runner.statements(list)),
            StatementKind::If { condition, then, otherwise } => {
                return self.branch(condition, then, otherwise.as_deref());
            }
            StatementKind::For { initial, condition, step, body } => {
                return self.in_scope(|runner| {
                    if let Some(initial) = initial {
                        runner.statement(initial);
                    }
                    runner.rounds(condition.as_deref(), body, step.as_ref(), false)
                });
            }
            StatementKind::While { condition, body } => return self.rounds(Some(condition), body, None, false),
            StatementKind::DoWhile { body, .. } => return self.rounds(None, body, None, true),
            StatementKind::Switch { value, body } => return self.switch(value, body),
            StatementKind::Return(value) => {
                if let Some(value) = value {
                    let value = self.expression(value);
                    self.returned.push((self.conditions.last().copied(), value));
                } else if let (0, Some(test)) = (self.calls, self.conditions.last()) {
                    let test = *test;
                    self.pay_for(1);
                    self.exits.push((test, self.scopes[0].clone()));
                }
                return Flow::Left;
            }
            StatementKind::Break => return Flow::Broke,
            StatementKind::Continue | StatementKind::Discard => return Flow::Left,
            StatementKind::Case(_) | StatementKind::Precision(_) | StatementKind::Empty => {}
        }
        Flow::Next
    }

    fn local(&mut self, declaration: &'a Declaration) {
        for declarator in &declaration.declarators {
            let id = match &declarator.initialiser {
                Some(initialiser) => {
                    let value = self.expression(initialiser);
                    let span = declarator.span.to(initialiser.span);
                    self.graph.push_like(Op::Copy(value, declarator.name.clone()), value, self.stage, span)
                }
                None => Graph::UNKNOWN,
            };
            self.define(&declarator.name, id);
        }
    }

    pub(crate) fn define(&mut self, name: &str, id: Id) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.insert(name.to_owned(), id);
        }
    }

    fn rounds(
        &mut self,
        condition: Option<&'a Condition>,
        body: &'a Statement,
        step: Option<&'a Expr>,
        once: bool,
    ) -> Flow {
        for _ in 0..MOST_ROUNDS {
            let test = match condition {
                Some(Condition::Expr(expr)) => Some(self.expression(expr)),
                Some(Condition::Declaration(declaration)) => {
                    self.local(declaration);
                    None
                }
                None => None,
            };
            let known = test.and_then(|test| self.graph.scalar(test));
            if known == Some(0.0) {
                break;
            }
            let returned = self.returned.len();
            let flow = self.in_scope(|runner| runner.statement(body));
            if self.returned.len() > returned && flow == Flow::Left {
                return Flow::Left;
            }
            if let Some(step) = step {
                self.expression(step);
            }
            if known.is_none() || once || flow != Flow::Next {
                break;
            }
        }
        Flow::Next
    }

    /// Executes a function of the shader. Returns its value and those of its parameters afterwards.
    pub(crate) fn call(&mut self, function: &'a Function, args: &[Id], span: Span) -> (Id, Vec<Id>) {
        let Some(body) = function.body.as_ref().filter(|_| self.calls < MOST_CALLS) else {
            return (Graph::UNKNOWN, args.to_vec());
        };
        self.calls += 1;
        let locals = self.scopes.split_off(1);
        let returned = std::mem::take(&mut self.returned);
        let conditions = std::mem::take(&mut self.conditions);
        let params = function.params.iter().map(|param| param.name.clone()).zip(args.iter().copied());
        self.scopes.push(params.collect());
        self.in_scope(|runner| runner.statements(body));
        let after = self.scopes.get(1);
        let last = |name: &str| after.and_then(|scope| scope.get(name)).copied().unwrap_or(Graph::UNKNOWN);
        let written: Vec<Id> = function.params.iter().map(|param| last(&param.name)).collect();
        self.scopes.truncate(1);
        self.scopes.extend(locals);
        self.conditions = conditions;
        let mut values = std::mem::replace(&mut self.returned, returned).into_iter().rev();
        let mut value = values.next().map_or(Graph::UNKNOWN, |(_, id)| id);
        for (condition, earlier) in values {
            let test = condition.unwrap_or(Graph::UNKNOWN);
            value = self.graph.push_like(Op::Select(test, earlier, value), value, self.stage, span);
        }
        self.calls -= 1;
        (value, written)
    }
}
