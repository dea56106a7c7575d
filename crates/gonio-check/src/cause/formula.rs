//! Right quantities as text: the student's own variables where they have the values, and otherwise the formulas of the
//! model solution with the student's variables in them, in the student's style.

use super::model::{AnswerMethod, INPUTS, Model, Quantity, STAGES, Space, assignments};
use super::observed::has_space;
use super::program::Program;
use super::scope::{Level, Readable, Scopes, expression_at, level_of, size_of};
use super::values::Values;
use crate::roles::{Bound, Declared, Role, VariableKind};
use crate::submission::without_comments;
use gonio_glsl::ast::{Call, Literal, UnaryOp};
use gonio_glsl::{Expr, ExprKind, Item, Parsed, Stage, StatementKind, TokenRange};
use gonio_interpreter::SourceMap;
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

/// A text that computes a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Formula {
    pub text: String,
    pub level: Level,
    /// Uniforms that must be declared: `mat4 V`.
    pub needs: Vec<String>,
}

impl Formula {
    /// Creates a formula that needs no declaration.
    #[must_use]
    pub fn new(text: impl Into<String>, level: Level) -> Self {
        Formula { text: text.into(), level, needs: Vec::new() }
    }

    /// The text where an operator of this level is around it.
    #[must_use]
    pub fn within(&self, level: Level) -> String {
        if self.level < level { format!("({})", self.text) } else { self.text.clone() }
    }

    fn cost(&self) -> usize {
        self.text.len() + 60 * self.needs.len()
    }
}

/// The definition of a quantity by others.
struct Definition {
    name: String,
    stage: Option<Stage>,
    space: Space,
    /// The space of its parts.
    of: Space,
    source: Arc<Parsed>,
    value: TokenRange,
}

/// The definitions of the quantities of a method.
pub(crate) struct Definitions {
    all: Vec<Definition>,
}

/// Definitions that the model solutions do not write, where `V` is a direction.
const OF_DIRECTIONS: [(&str, &str); 15] = [
    ("V", "normalize(to_eye)"),
    ("to_eye", "u_view_pos - world_position"),
    ("minus_L", "-L"),
    ("x", "dot(N, L)"),
    ("x", "2.0 * dot(N, L)"),
    ("x", "dot(N, L) * N"),
    ("x", "2.0 * dot(N, L) * N"),
    ("x", "dot(N, V)"),
    ("x", "dot(N, H)"),
    ("x", "dot(R, V)"),
    ("x", "L + V"),
    ("H", "normalize(L + V)"),
    ("d", "distance(light_pos, world_position)"),
    ("ward", "gauss / divisor"),
    ("attenuated", "attenuation * (diffuse + specular)"),
];

/// The same where `V` is the view matrix.
const OF_MATRICES: [(&str, &str); 11] = [
    ("x", "P * V * M"),
    ("x", "P * V"),
    ("x", "V * M"),
    ("x", "mat3(itM)"),
    ("x", "mat3(M)"),
    ("mat3(itM)", "transpose(inverse(mat3(M)))"),
    ("itM", "transpose(inverse(M))"),
    ("world_position", "(M * vec4(position, 1.0)).xyz"),
    ("world_position", "world_place.xyz"),
    ("world_place", "M * vec4(position, 1.0)"),
    ("gl_Position", "P * V * M * vec4(position, 1.0)"),
];

/// Definitions in view space, with the space of their parts.
const IN_VIEW: [(&str, &str, Space); 8] = [
    ("world_position", "(V * world_place).xyz", Space::View),
    ("world_position", "(V * M * vec4(position, 1.0)).xyz", Space::View),
    ("world_normal", "mat3(transpose(inverse(V * M))) * normal", Space::View),
    ("mat3(transpose(inverse(V * M)))", "mat3(transpose(inverse(V * M)))", Space::View),
    ("mat3(transpose(inverse(V * M)))", "transpose(inverse(mat3(V * M)))", Space::View),
    ("light_pos", "(V * vec4(light_pos, 1.0)).xyz", Space::World),
    ("to_eye", "-world_position", Space::View),
    ("from_eye", "world_position", Space::View),
];

const HEADER: &str = "#version 330 core
vec3 N, L, R, H, I, world_position, world_normal, v_normal, position, normal, light_pos, u_view_pos, to_eye, to_light;
float gauss, divisor;
vec4 world_place; uniform mat4 M, P, itM;
";

/// Parses one definition: a global variable of this name.
fn parse_definition(text: &str, is_matrix: bool) -> Option<(Arc<Parsed>, TokenRange)> {
    let view = if is_matrix { "uniform mat4 V;" } else { "vec3 V;" };
    let mut parsed = gonio_glsl::parse(&format!("{HEADER}{view}\nvoid main() {{ {text}; }}"));
    gonio_glsl::check(&mut parsed, Stage::Vertex);
    let function = parsed.unit.items.iter().find_map(|item| match item {
        Item::Function(function) => function.body.as_ref()?.first(),
        _ => None,
    })?;
    let StatementKind::Expression(value) = &function.kind else { return None };
    let tokens = value.tokens;
    Some((Arc::new(parsed), tokens))
}

impl Definitions {
    /// Reads the definitions of a method from its model solution.
    #[must_use]
    pub fn new(method: AnswerMethod) -> Self {
        let mut all = Vec::new();
        let hypotheses = crate::mistakes::Hypotheses::for_model(method.model);
        let sources = method.sources(&hypotheses, super::model::Mistakes::These(&[])).0;
        for stage in STAGES {
            let mut parsed = gonio_glsl::parse(&sources[stage as usize]);
            gonio_glsl::check(&mut parsed, stage);
            let parsed = Arc::new(parsed);
            let map = SourceMap::new(&parsed);
            for (name, value) in assignments(&sources[stage as usize], &map) {
                all.push((name, Some(stage), Arc::clone(&parsed), value));
            }
        }
        for (list, is_matrix) in [(&OF_DIRECTIONS[..], false), (&OF_MATRICES[..], true)] {
            for (name, text) in list {
                let name = match *name {
                    "x" => text,
                    "minus_L" => "-L",
                    name => name,
                };
                if let Some((parsed, value)) = parse_definition(text, is_matrix) {
                    all.push((name.to_owned(), None, parsed, value));
                }
            }
        }
        let mut all: Vec<Definition> = (all.into_iter())
            .flat_map(|(name, stage, source, value)| {
                let in_view = has_space(&name) && !IN_VIEW.iter().any(|(known, ..)| *known == name);
                [(Space::World, true), (Space::View, in_view)].into_iter().filter(|(_, is)| *is).map(
                    move |(space, _)| Definition {
                        name: name.clone(),
                        stage,
                        space,
                        of: space,
                        source: Arc::clone(&source),
                        value,
                    },
                )
            })
            .collect();
        for (name, text, of) in IN_VIEW {
            if let Some((source, value)) = parse_definition(text, true) {
                all.push(Definition { name: name.to_owned(), stage: None, space: Space::View, of, source, value });
            }
        }
        Definitions { all }
    }
}

/// How a student writes numbers and operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Style {
    float_suffix: bool,
    tight_operators: bool,
    tight_commas: bool,
}

impl Style {
    /// Reads the style of a shader.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let code = without_comments(text);
        let count = |what: &str| code.matches(what).count();
        let suffixed = ["0f", "5f", "1.f", "0.f", "2.f"].map(count).iter().sum::<usize>();
        Style {
            float_suffix: suffixed > 0,
            tight_operators: count("*") + count("+") > 2 * (count(" * ") + count(" + ")),
            tight_commas: count(",") > 2 * (count(", ") + count(",\n")),
        }
    }

    /// A number of a formula.
    #[must_use]
    pub fn number(self, text: &str) -> String {
        if self.float_suffix { format!("{text}f") } else { text.to_owned() }
    }

    /// Joins operands.
    #[must_use]
    pub fn binary(self, left: &str, mark: &str, right: &str) -> String {
        if self.tight_operators { format!("{left}{mark}{right}") } else { format!("{left} {mark} {right}") }
    }

    /// A call.
    #[must_use]
    pub fn call(self, name: &str, args: &[String]) -> String {
        format!("{name}({})", args.join(if self.tight_commas { "," } else { ", " }))
    }
}

/// Writes quantities at one place of a student's shader.
pub(crate) struct Writer<'a> {
    pub program: &'a Program,
    pub model: &'a Model,
    pub definitions: &'a Definitions,
    pub scopes: &'a Scopes<'a>,
    pub readable: Vec<Readable<'a>>,
    pub place: TokenRange,
    pub stage: Stage,
    pub style: Style,
    /// What was found for each quantity outside of its own definition.
    pub known: RefCell<HashMap<(String, usize, Space), Option<Formula>>>,
}

/// Formulas nested deeper than this are longer than any student writes.
const MOST_NESTED: usize = 9;

/// The spaces in which the parts of a quantity may be computed: a number is the same in each.
fn spaces(name: &str, space: Space) -> &'static [Space] {
    match space {
        _ if !has_space(name) => &[Space::World, Space::View],
        Space::World => &[Space::World],
        Space::View => &[Space::View],
    }
}

/// The names that stand for goals in the model solutions.
fn goal_name(text: &str) -> &str {
    if text == "light.light_pos" { "light_pos" } else { text }
}

impl Writer<'_> {
    /// Texts for a quantity, the shortest first.
    #[must_use]
    pub fn options(&self, name: &str, size: usize, space: Space) -> Vec<Formula> {
        let mut all: Vec<Formula> = self.own(name, size, space).into_iter().collect();
        for space in spaces(name, space) {
            let mut stack = vec![(name.to_owned(), *space)];
            all.extend(self.defined(name, size, *space, &mut stack));
            all.extend(self.input(name, size, *space, true));
        }
        all.sort_by_key(Formula::cost);
        all.dedup();
        all
    }

    /// The shortest text for a quantity.
    #[must_use]
    pub fn best(&self, name: &str, size: usize, space: Space) -> Option<Formula> {
        let found = spaces(name, space).iter().filter_map(|space| self.resolve(name, size, *space, &mut Vec::new()));
        found.min_by_key(Formula::cost)
    }

    fn resolve(&self, name: &str, size: usize, space: Space, stack: &mut Vec<(String, Space)>) -> Option<Formula> {
        let of = (name.to_owned(), size, space);
        if let Some(known) = self.known.borrow().get(&of) {
            return known.clone();
        }
        if let Some(found) = self.input(name, size, space, false).or_else(|| self.own(name, size, space)) {
            self.known.borrow_mut().insert(of, Some(found.clone()));
            return Some(found);
        }
        let key = (name.to_owned(), space);
        if stack.len() >= MOST_NESTED || stack.contains(&key) {
            return None;
        }
        stack.push(key);
        let found = self.defined(name, size, space, stack).into_iter().min_by_key(Formula::cost);
        stack.pop();
        let found = found.or_else(|| self.input(name, size, space, true));
        self.known.borrow_mut().insert(of, found.clone());
        found
    }

    /// The right values of a quantity here.
    fn values(&self, name: &str, size: usize, space: Space) -> impl Iterator<Item = &Values> {
        let is_it = move |q: &&Quantity| {
            q.stage == self.stage
                && q.mistake.is_none()
                && q.name == name
                && q.values.size == size
                && (q.space == space || !has_space(&q.name))
        };
        self.model.quantities.iter().filter(is_it).map(|quantity| &quantity.values)
    }

    fn own(&self, name: &str, size: usize, space: Space) -> Option<Formula> {
        self.values(name, size, space).filter_map(|right| self.own_values(right)).min_by_key(Formula::cost)
    }

    /// One of the student's own variables or expressions with these values.
    #[must_use]
    pub fn own_values(&self, right: &Values) -> Option<Formula> {
        let size = right.size;
        let mut found: Vec<Formula> = Vec::new();
        for readable in &self.readable {
            let values = readable.values;
            if values.is_constant() && !readable.is_name {
                continue;
            }
            if values.is_same(right) {
                let level = if readable.is_name { Level::Whole } else { self.level(readable) };
                found.push(Formula::new(readable.text.clone(), level));
            } else if readable.is_name && size == 3 && values.size == 3 {
                if values.is_scaled(right, -1.0) {
                    found.push(Formula::new(format!("-{}", readable.text), Level::Sign));
                } else if values.is_parallel(right, 1.0) && values.unit().is_same(right) {
                    found.push(Formula::new(format!("normalize({})", readable.text), Level::Whole));
                }
            } else if readable.is_name && size == 3 && values.size == 4 {
                let xyz = values.map(3, |_, from, to| to.copy_from_slice(&from[..3]));
                if xyz.is_same(right) {
                    found.push(Formula::new(format!("{}.xyz", readable.text), Level::Whole));
                }
            } else if readable.is_name && size == 4 && values.size == 3 {
                let point = values.map(4, |_, from, to| {
                    to[..3].copy_from_slice(from);
                    to[3] = 1.0;
                });
                if point.is_same(right) {
                    let args = [readable.text.clone(), self.style.number("1.0")];
                    found.push(Formula::new(self.style.call("vec4", &args), Level::Whole));
                }
            }
        }
        found.into_iter().min_by_key(Formula::cost)
    }

    fn level(&self, readable: &Readable<'_>) -> Level {
        expression_at(self.scopes.parsed, readable.tokens).map_or(Level::Loose, |expr| level_of(&expr, &readable.text))
    }

    /// The input that is a quantity by its role. `declares` allows one that this stage does not declare.
    fn input(&self, name: &str, size: usize, space: Space, declares: bool) -> Option<Formula> {
        let role = match name {
            "position" => Role::Position,
            "normal" => Role::Normal,
            "light_pos" if space == Space::View => Role::LightPosInView(0),
            "mat3(transpose(inverse(V * M)))" => Role::NormalMatrixOfModelView,
            _ => {
                let inner = name.strip_prefix("mat3(").and_then(|rest| rest.strip_suffix(')')).unwrap_or(name);
                INPUTS.iter().find(|(known, ..)| *known == inner).map(|(_, role, _)| *role)?
            }
        };
        // `V` is a matrix or a direction.
        if matches!(name, "V" | "M" | "P" | "itM") && size != 16 {
            return None;
        }
        let of = |bound: &Bound| -> Option<Formula> {
            let text = self.element(&bound.declared);
            let text = text.as_str();
            let is_attribute = bound.declared.kind == VariableKind::Attribute;
            let is_here = self.scopes.is_readable(text, self.place);
            let text = match (bound.declared.glsl_type.as_str(), size) {
                ("float", 1) | ("vec3", 3) | ("mat4", 16) | ("mat3", 9) => text.to_owned(),
                ("vec4", 3) => format!("{text}.xyz"),
                ("mat4", 9) => format!("mat3({text})"),
                _ => return None,
            };
            let mut formula = Formula::new(text, Level::Whole);
            if !is_here {
                let Bound { declared, .. } = bound;
                let is_simple = !declared.name.contains(['.', '[']) && declared.array <= 1;
                if !declares || is_attribute || !is_simple || !self.scopes.is_free(&declared.name) {
                    return None;
                }
                formula.needs.push(format!("{} {}", declared.glsl_type, declared.name));
            }
            Some(formula)
        };
        let bound = self.program.bindings.bound.iter().chain(&self.program.declared.bound);
        let mut mine = bound.filter(|bound| bound.role == role);
        let found = mine.clone().filter_map(of).min_by_key(Formula::cost);
        if found.is_some()
            || mine.next().is_some()
            || !declares
            || size == 1 && !matches!(role, Role::Shininess | Role::RefractionIndex | Role::Roughness)
        {
            return found;
        }
        // The program that draws sets the usual name.
        let usual = INPUTS.iter().find(|(known, ..)| *known == name)?;
        let is_word = usual.0.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        (is_word && self.scopes.is_free(usual.0))
            .then(|| Formula { needs: vec![format!("{} {}", usual.2, usual.0)], ..Formula::new(usual.0, Level::Whole) })
    }

    /// The text of an input: of an array, the element with the index that is used at this place, or the first.
    fn element(&self, declared: &Declared) -> String {
        let index = || self.scopes.index_at(self.place).unwrap_or("0");
        let name = self.program.in_text(&declared.name);
        if declared.array > 1 {
            return format!("{name}[{}]", index());
        }
        match name.split_once("[0]") {
            Some((array, member)) => format!("{array}[{}]{member}", index()),
            None => name.into_owned(),
        }
    }

    /// Texts by the definitions of a quantity.
    fn defined(&self, name: &str, size: usize, space: Space, stack: &mut Vec<(String, Space)>) -> Vec<Formula> {
        let is_it = |d: &&Definition| {
            d.name == name && d.stage.is_none_or(|stage| stage == self.stage) && (d.space == space || !has_space(name))
        };
        let definitions = self.definitions.all.iter().filter(is_it);
        let mut found = Vec::new();
        for definition in definitions {
            let Some(value) = expression_at(&definition.source, definition.value) else { continue };
            if size_of(value.ty.as_ref()).is_some_and(|of| of != size) {
                continue;
            }
            let space = if has_space(name) { definition.of } else { space };
            found.extend(self.written(definition, &value, space, true, stack));
        }
        found
    }

    /// A definition with the student's variables.
    fn written(
        &self,
        definition: &Definition,
        expr: &Expr,
        space: Space,
        is_whole: bool,
        stack: &mut Vec<(String, Space)>,
    ) -> Option<Formula> {
        let text = definition.source.text(expr.span);
        let goal = goal_name(text.trim_start_matches('(').trim_end_matches(|c| c == ')' && text.starts_with('(')));
        let size = size_of(expr.ty.as_ref());
        if let Some(size) = size.filter(|_| !is_whole || matches!(expr.kind, ExprKind::Name(_))) {
            let is_word = matches!(expr.kind, ExprKind::Name(_) | ExprKind::Field { .. });
            let is_goal = self.values(goal, size, space).next().is_some()
                || matches!(goal, "position" | "normal")
                || self.definitions.all.iter().any(|d| d.name == goal && !d.name.is_empty());
            let is_swizzle = matches!(&expr.kind, ExprKind::Field { name, .. } if name == "xyz" || name == "rgb");
            if is_goal {
                let found = self.resolve(goal, size, space, stack);
                if found.is_some() || is_word && !is_swizzle {
                    return found;
                }
            }
        }
        let mut needs = Vec::new();
        let mut part = |expr: &Expr, level: Level, stack: &mut Vec<(String, Space)>| {
            let formula = self.written(definition, expr, space, false, stack)?;
            needs.extend(formula.needs.iter().cloned());
            Some(formula.within(level))
        };
        let style = self.style;
        let made = match &expr.kind {
            ExprKind::Literal(Literal::Float(_)) => Formula::new(style.number(text), Level::Whole),
            ExprKind::Name(name) if name == "cubemapSampler" => Formula::new(self.sampler()?, Level::Whole),
            ExprKind::Call(Call { name, args, .. }) => {
                let args = args.iter().map(|arg| part(arg, Level::Loose, stack)).collect::<Option<Vec<_>>>()?;
                Formula::new(style.call(self.function(name)?, &args), Level::Whole)
            }
            ExprKind::Field { base, name, .. } => {
                Formula::new(format!("{}.{name}", part(base, Level::Whole, stack)?), Level::Whole)
            }
            ExprKind::Unary { op: UnaryOp::Minus, operand } => {
                let inner = part(operand, Level::Sign, stack)?;
                match inner.strip_prefix('-') {
                    Some(positive) => Formula::new(positive.to_owned(), Level::Whole),
                    None => Formula::new(format!("-{inner}"), Level::Sign),
                }
            }
            ExprKind::Binary { op, left, right } => {
                let mark = op.mark();
                let level = if matches!(mark, "*" | "/") { Level::Product } else { Level::Sum };
                // `a - (b + c)` and `a / (b * c)`
                let of_right = match mark {
                    "-" => Level::Product,
                    "/" => Level::Sign,
                    _ => level,
                };
                let (left, right) = (part(left, level, stack)?, part(right, of_right, stack)?);
                Formula::new(style.binary(&left, mark, &right), level)
            }
            _ => return None,
        };
        needs.sort();
        needs.dedup();
        Some(Formula { needs, ..made })
    }

    /// The student's cubemap.
    fn sampler(&self) -> Option<String> {
        let inputs = self.program.stage(self.stage).inputs.iter();
        inputs.filter(|input| input.ty.written() == "samplerCube").map(|input| input.name.clone()).next()
    }

    /// The name of a built-in function in the student's version.
    fn function<'n>(&self, name: &'n str) -> Option<&'n str> {
        let version = self.scopes.parsed.dialect();
        match name {
            "texture" if version.number < 130 => Some("textureCube"),
            "inverse" if version.number < 140 => None,
            "transpose" if version.number < 120 => None,
            _ => Some(name),
        }
    }
}
