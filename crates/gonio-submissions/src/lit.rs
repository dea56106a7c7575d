//! Writes programs that compute light: exercises 03 to 07.

use crate::expression::{Expr, Site};
use crate::light_data::Which;
use crate::plan::{Container, Functions, GeneratedTask, Space};
use crate::scenes::Field;
use crate::writer::{Block, Writer};

/// A point of a surface.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub normal: Expr,
    pub position: Option<Expr>,
    /// The vectors to light and eye, if the vertex shader passes them.
    pub passed: Option<(Expr, Expr)>,
}

/// The factors of the terms.
struct Factors {
    light: Expr,
    cosine: Option<Expr>,
    power: Option<Expr>,
}

/// Writes both stages.
pub(crate) fn write(vertex: &mut Writer<'_>, fragment: &mut Writer<'_>) -> (Block, Block) {
    let answer = vertex.context.answer;
    let (mut first, mut second) = (Block::default(), Block::default());
    let position = vertex.place(&mut first);
    let normal = vertex.vertex_normal(&mut first);
    if answer.task.is_per_vertex() {
        let surface = Surface { normal, position: Some(position), passed: None };
        let result = vertex.lighting(&mut first, &surface);
        let ty = if vertex.context.plan.vec3_terms { "vec3" } else { "float" };
        let value = if ty == "vec3" { Expr::call("vec3", &[&result]) } else { result };
        let out = vertex.varying("v_result", ty);
        vertex.statement(&mut first, format!("{} = {};", out.text, value.text));
        let passed = fragment.varying("v_result", ty);
        let colour = if ty == "vec3" { passed } else { Expr::call("vec3", &[&passed]) };
        fragment.output(&mut second, &colour);
        return (first, second);
    }
    let out = vertex.varying("v_normal", "vec3");
    vertex.statement(&mut first, format!("{} = {};", out.text, normal.text));
    let unit = fragment.fragment_normal(&mut second);
    let surface = if vertex.context.plan.passes_directions {
        let [light, eye] = [vertex.varying("v_to_light", "vec3"), vertex.varying("v_to_eye", "vec3")];
        let place = vertex.light_position(&mut first, &Which::One);
        vertex.statement(&mut first, format!("{} = {};", light.text, place.sub(&position).text));
        let to_eye = vertex.eye().map_or_else(|| position.neg(), |eye| eye.sub(&position));
        vertex.statement(&mut first, format!("{} = {};", eye.text, to_eye.text));
        let passed = (fragment.varying("v_to_light", "vec3"), fragment.varying("v_to_eye", "vec3"));
        Surface { normal: unit, position: None, passed: Some(passed) }
    } else {
        let out = vertex.varying("v_position", "vec3");
        vertex.statement(&mut first, format!("{} = {};", out.text, position.text));
        let passed = fragment.varying("v_position", "vec3");
        Surface { normal: unit, position: Some(passed), passed: None }
    };
    let result = fragment.lighting(&mut second, &surface);
    let colour = if answer.task == GeneratedTask::LightEquation {
        fragment.last_change(&result, &surface)
    } else {
        Expr::call("vec3", &[&result])
    };
    fragment.output(&mut second, &colour);
    (first, second)
}

impl Writer<'_> {
    /// Writes the colour.
    pub fn output(&mut self, block: &mut Block, colour: &Expr) {
        let name = if self.version().has_in_and_out() {
            let name = self.name("output").text;
            let located = self.version().has_locations() && self.coin("output location", 0.1);
            self.declare(if located { "layout (location = 0) out vec4" } else { "out vec4" }, &name);
            name
        } else {
            "gl_FragColor".to_owned()
        };
        let whole = self.vec4(colour, 1.0);
        self.statement(block, format!("{name} = {};", whole.text));
    }

    /// What is done to the colour at the very end.
    fn last_change(&mut self, colour: &Expr, surface: &Surface) -> Expr {
        let slip = self.slip(&["gamma-applied", "output-normal", "output-constant", "channels-swapped"]);
        match slip {
            None => colour.clone(),
            Some("gamma-applied") => Expr::call("pow", &[colour, &Expr::atom("vec3(1.0 / 2.2)")]),
            Some("output-normal") => surface.normal.mul(&self.number(0.5)).add(&self.number(0.5)),
            Some("output-constant") => self.material(),
            Some(_) => colour.field("zyx"),
        }
        .at(Site::Output)
    }

    /// The light's position in the space of the vectors.
    pub fn light_position(&mut self, block: &mut Block, which: &Which) -> Expr {
        let other = Which::Indexed("0".to_owned());
        let which = if self.slips("position-of-other-light") { &other } else { which };
        let place = self.light(Field::Position, which);
        if self.context.plan.space == Space::World || self.context.plan.light_sent_in_eye {
            return place;
        }
        let whole = self.vec4(&place, 1.0);
        let product = self.view().mul(&whole);
        let here = self.xyz(&product, "xyz of the light");
        self.value(block, "light_here", "vec3", here, 2)
    }

    /// The light at a point: a colour in exercise 07, a number before.
    fn lighting(&mut self, block: &mut Block, surface: &Surface) -> Expr {
        let plan = self.context.plan;
        if self.context.answer.lights > 1 {
            return self.several_lights(block, surface);
        }
        if plan.functions != Functions::Whole {
            return self.one_light(block, surface, &Which::One);
        }
        let given =
            matches!(plan.container, Container::Struct | Container::StructArray) && self.coin("struct given", 0.6);
        let (name, mut arguments) = self.shade(surface, given);
        if given {
            arguments.insert(0, self.struct_of(plan.container, &Which::One));
        }
        let result = Expr::call(&name, &arguments.iter().collect::<Vec<_>>());
        let ty = self.result_type();
        self.value(block, "result", ty, result, 1)
    }

    fn result_type(&self) -> &'static str {
        if self.context.answer.task == GeneratedTask::LightEquation { "vec3" } else { "float" }
    }

    /// Writes a function for one light; returns its name and its last arguments.
    fn shade(&mut self, surface: &Surface, given: bool) -> (String, Vec<Expr>) {
        let mut body = Block::default();
        let inside = Surface { normal: self.name("arg_n"), position: Some(self.name("arg_p")), passed: None };
        let which = if given { Which::Argument } else { Which::One };
        let result = self.one_light(&mut body, &inside, &which);
        self.statement(&mut body, format!("return {};", result.text));
        let light = match (given, self.context.plan.container) {
            (false, _) => String::new(),
            (true, Container::Arrays) => format!("int {}, ", self.name("arg_light").text),
            (true, _) => format!("{} {}, ", self.name("light_type").text, self.name("arg_light").text),
        };
        let [name, n, p] = ["shade", "arg_n", "arg_p"].map(|key| self.name(key).text);
        self.function(&format!("{} {name}({light}vec3 {n}, vec3 {p})", self.result_type()), &body);
        let arguments = [Some(surface.normal.clone()), surface.position.clone()];
        (name, arguments.into_iter().flatten().collect())
    }

    /// The call for one of several lights.
    fn shade_indexed(&mut self, surface: &Surface, index: &str) -> Expr {
        let (name, mut arguments) = self.shade(surface, true);
        let one = match self.context.plan.container {
            Container::StructArray => self.struct_of(Container::StructArray, &Which::Indexed(index.to_owned())),
            _ => Expr::atom(index),
        };
        arguments.insert(0, one);
        Expr::call(&name, &arguments.iter().collect::<Vec<_>>())
    }

    fn several_lights(&mut self, block: &mut Block, surface: &Surface) -> Expr {
        let slip = self.slip(&["lights-overwritten", "second-light-missing"]);
        let whole = self.context.plan.functions == Functions::Whole;
        if !self.context.plan.loops {
            let [a, b] = ["0", "1"].map(|index| self.shade_indexed(surface, index));
            if self.coin("one sum of lights", 0.5) && slip != Some("lights-overwritten") {
                let sum = if slip.is_some() { a } else { a.add(&b) };
                return self.value(block, "total", "vec3", sum.at(Site::Lights), 1);
            }
            let total = self.variable(block, "total", "vec3", &a.at(Site::Lights));
            let operator = if slip == Some("lights-overwritten") { "=" } else { "+=" };
            if slip != Some("second-light-missing") {
                self.statement(block, format!("{} {operator} {};", total.text, b.at(Site::Lights).text));
            }
            return total;
        }
        let total = self.variable(block, "total", "vec3", &Expr::call("vec3", &[&self.number(0.0)]));
        let mut inner = Block::default();
        let result = if whole {
            self.shade_indexed(surface, "i")
        } else {
            self.one_light(&mut inner, surface, &Which::Indexed("i".to_owned()))
        };
        let operator = if slip == Some("lights-overwritten") { "=" } else { "+=" };
        let sum = Expr::atom(format!("{} {operator} {}", total.text, result.text)).at(Site::Lights);
        self.statement(&mut inner, format!("{};", sum.text));
        let count = if slip == Some("second-light-missing") { "1" } else { "2" };
        let head = Expr::atom(format!("for (int i = 0; i < {count}; i++)")).at(Site::Lights);
        let body = self.body(&inner, "loop");
        self.statement(block, format!("{} {{\n{body}}}", head.text));
        total
    }

    /// The light of one light.
    fn one_light(&mut self, block: &mut Block, surface: &Surface, which: &Which) -> Expr {
        let task = self.context.answer.task;
        let to_light = self.light_vector(block, surface, which);
        let light = self.light_direction(block, surface, which, &to_light);
        let view = if task.has_specular() { Some(self.view_direction(block, surface, which)) } else { None };
        let cosine =
            if task.has_diffuse() { Some(self.diffuse_cosine(block, surface, &light, view.as_ref())) } else { None };
        let power = view.map(|view| {
            let cosine = cosine.clone();
            self.specular_power(block, surface, &light, &view, &to_light, cosine)
        });
        let factors = Factors { light, cosine, power };
        if task == GeneratedTask::LightEquation {
            let attenuation = self.attenuation(block, surface, which, &to_light, &factors.light);
            let (cosine, power) = (factors.cosine, factors.power);
            return self.sum(block, which, attenuation, cosine, power);
        }
        let ambient = self.context.answer.ambient;
        let term = factors.cosine.or(factors.power).unwrap_or_else(|| self.number(0.0));
        if ambient > 0.0 { self.number(ambient).add(&term) } else { term }
    }

    /// The vector to the light.
    fn light_vector(&mut self, block: &mut Block, surface: &Surface, which: &Which) -> Expr {
        if let Some((to_light, _)) = &surface.passed {
            return to_light.clone();
        }
        let place = self.light_position(block, which);
        let position = surface.position.clone().unwrap_or_else(|| self.number(0.0));
        let mut vector = place.sub(&position);
        if self.slips("position-of-other-light") {
            vector = vector.at(Site::LightDirection);
        }
        let twice = self.context.answer.task == GeneratedTask::LightEquation;
        if twice && self.coin("to_light variable", 0.5) {
            return self.variable(block, "to_light", "vec3", &vector);
        }
        vector
    }

    fn light_direction(&mut self, block: &mut Block, surface: &Surface, which: &Which, to_light: &Expr) -> Expr {
        let slip = self.slip(&[
            "light-direction-reversed",
            "light-direction-not-normalised",
            "light-direction-minus-normal",
            "light-position-as-direction",
            "light-from-eye",
            "light-direction-plus-position",
        ]);
        let position = surface.position.clone().unwrap_or_else(|| to_light.clone());
        let unit = |value: &Expr| Expr::call("normalize", &[value]);
        let value = match slip {
            None if self.context.plan.from_light && surface.passed.is_none() => {
                let place = self.light_position(block, which);
                let from = unit(&position.sub(&place)).at(Site::LightDirection);
                return self.variable(block, "I", "vec3", &from).neg();
            }
            None => unit(to_light),
            Some("light-direction-reversed") if surface.passed.is_some() => unit(&to_light.neg()),
            Some("light-direction-not-normalised") => to_light.clone(),
            Some(slip) => {
                let place = self.light_position(block, which);
                match slip {
                    "light-direction-reversed" => unit(&position.sub(&place)),
                    "light-direction-minus-normal" => unit(&place.sub(&surface.normal)),
                    "light-position-as-direction" => unit(&place),
                    "light-direction-plus-position" => unit(&place.add(&position)),
                    _ => {
                        let eye = self.eye().unwrap_or_else(|| Expr::atom("vec3(0.0)"));
                        unit(&place.sub(&eye))
                    }
                }
            }
        };
        self.variable(block, "L", "vec3", &value.at(Site::LightDirection))
    }

    fn view_direction(&mut self, block: &mut Block, surface: &Surface, which: &Which) -> Expr {
        let slip = self.slip(&[
            "view-direction-reversed",
            "view-direction-not-normalised",
            "view-position-as-direction",
            "view-position-at-origin",
            "view-direction-is-front",
            "view-plus-position",
            "view-from-light",
        ]);
        let unit = |value: &Expr| Expr::call("normalize", &[value]);
        let position = surface.position.clone();
        let eye = self.eye();
        let to_eye = match (&surface.passed, &position, &eye) {
            (Some((_, to_eye)), ..) => to_eye.clone(),
            (_, Some(position), Some(eye)) => eye.sub(position),
            (_, Some(position), None) => position.neg(),
            _ => self.number(0.0),
        };
        let to_eye =
            if self.coin("to_eye variable", 0.15) { self.variable(block, "to_eye", "vec3", &to_eye) } else { to_eye };
        let position = position.unwrap_or_else(|| to_eye.clone());
        let value = match slip {
            None => unit(&to_eye),
            Some("view-direction-reversed") => match eye {
                Some(eye) if surface.passed.is_none() => unit(&position.sub(&eye)),
                None if surface.passed.is_none() => unit(&position),
                _ => unit(&to_eye.neg()),
            },
            Some("view-direction-not-normalised") => to_eye,
            Some("view-position-as-direction") => eye.map_or_else(|| unit(&position), |eye| unit(&eye)),
            Some("view-position-at-origin") => unit(&position.neg()),
            Some("view-direction-is-front") => self.vec3([0.0, 0.0, 1.0]),
            Some("view-plus-position") => eye.map_or_else(|| unit(&position), |eye| unit(&eye.add(&position))),
            Some(_) => {
                let place = self.light_position(block, which);
                eye.map_or_else(|| unit(&place), |eye| unit(&place.sub(&eye)))
            }
        };
        self.variable(block, "eye_dir", "vec3", &value.at(Site::ViewDirection))
    }

    pub fn dot(&self, a: &Expr, b: &Expr, decision: &str) -> Expr {
        if self.coin(decision, 0.35) { Expr::call("dot", &[b, a]) } else { Expr::call("dot", &[a, b]) }
    }

    /// max(x, 0), in several ways.
    pub fn clamped(&self, block: &mut Block, value: &Expr, variable: &str, decision: &str) -> Expr {
        let zero = self.zero();
        match self.choice(decision, 9) {
            0..=4 => Expr::call("max", &[value, &zero]),
            5 => Expr::call("max", &[&zero, value]),
            6 | 7 => Expr::call("clamp", &[value, &self.number(0.0), &self.number(1.0)]),
            _ => {
                let name = self.variable(block, variable, "float", value);
                Expr::choose(&format!("{} > {}", name.text, self.number(0.0).text), &name, &self.number(0.0))
            }
        }
    }

    fn diffuse_cosine(&mut self, block: &mut Block, surface: &Surface, light: &Expr, view: Option<&Expr>) -> Expr {
        if self.context.plan.functions == Functions::Terms && self.coin("diffuse function", 0.6) {
            let view_is_needed = self.slips("diffuse-with-view");
            if !view_is_needed {
                let mut body = Block::default();
                let [n, l] = [self.name("arg_n"), self.name("arg_l")];
                let value = self.cosine_value(&mut body, &n, &l, None);
                self.statement(&mut body, format!("return {};", value.text));
                let name = self.name("f_diffuse").text;
                self.function(&format!("float {name}(vec3 {}, vec3 {})", n.text, l.text), &body);
                let call = Expr::call(&name, &[&surface.normal, light]);
                return self.value(block, "cosine", "float", call, 1);
            }
        }
        let value = self.cosine_value(block, &surface.normal, light, view);
        let uses = if self.slips("ambient-times-diffuse") { 2 } else { 1 };
        self.value(block, "cosine", "float", value, uses)
    }

    fn cosine_value(&mut self, block: &mut Block, normal: &Expr, light: &Expr, view: Option<&Expr>) -> Expr {
        let cosine = self.dot(normal, light, "order of N and L");
        let number = |x: f32| self.number(x);
        let slip = self.slip(&[
            "diffuse-not-clamped",
            "diffuse-absolute",
            "diffuse-floor",
            "diffuse-half-lambert",
            "diffuse-min-for-max",
            "diffuse-without-cosine",
            "diffuse-with-view",
            "diffuse-cosine-squared",
            "diffuse-sine",
        ]);
        match slip {
            None => self.clamped(block, &cosine, "n_dot_l", "diffuse clamp"),
            Some("diffuse-not-clamped") => cosine,
            Some("diffuse-absolute") => Expr::call("abs", &[&cosine]),
            Some("diffuse-floor") => Expr::call("max", &[&cosine, &number([0.1, 0.2, 0.3][self.choice("floor", 3)])]),
            Some("diffuse-half-lambert") => cosine.mul(&number(0.5)).add(&number(0.5)),
            Some("diffuse-min-for-max") => Expr::call("min", &[&cosine, &number(0.0)]),
            Some("diffuse-without-cosine") => number(1.0),
            Some("diffuse-with-view") => {
                let other = view.unwrap_or(light);
                Expr::call("max", &[&self.dot(normal, other, "order of N and L"), &self.zero()])
            }
            Some("diffuse-cosine-squared") => {
                Expr::call("pow", &[&Expr::call("max", &[&cosine, &number(0.0)]), &number(2.0)])
            }
            Some(_) => number(1.0).sub(&Expr::call("max", &[&cosine, &number(0.0)])),
        }
        .at(Site::DiffuseCosine)
    }
}
