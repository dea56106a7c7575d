//! Where a program finds the values of its lights and its material: uniforms, structs, blocks, arrays, constants.

use crate::expression::Expr;
use crate::plan::{Container, Space};
use crate::scenes::{Field, LAB, LAB_MATERIAL, LAB_SHININESS, Meaning};
use crate::writer::Writer;

/// Which light a piece of the program is about.
#[derive(Clone, Debug)]
pub(crate) enum Which {
    /// The only one.
    One,
    /// One of several, by an index.
    Indexed(String),
    /// The argument of a function: a struct, or an index for arrays.
    Argument,
}

const FIELDS: [(Field, &str, &str); 7] = [
    (Field::Position, "m_position", "u_light_pos"),
    (Field::Ambient, "m_ambient", "u_ambient"),
    (Field::Diffuse, "m_diffuse", "u_diffuse"),
    (Field::Specular, "m_specular", "u_specular"),
    (Field::Constant, "m_constant", "u_constant"),
    (Field::Linear, "m_linear", "u_linear"),
    (Field::Quadratic, "m_quadratic", "u_quadratic"),
];

fn keys(field: Field) -> (&'static str, &'static str) {
    let field = if field == Field::PositionInEye { Field::Position } else { field };
    FIELDS.iter().find(|(of, ..)| *of == field).map_or(("m_position", "u_light_pos"), |(_, member, key)| (member, key))
}

fn type_of(field: Field) -> &'static str {
    if matches!(field, Field::Position | Field::PositionInEye) { "vec3" } else { "float" }
}

impl Writer<'_> {
    /// Whether a value is written as a constant.
    fn is_written(&self, field: Field) -> bool {
        let writes = self.context.answer.writes;
        match field {
            Field::Position | Field::PositionInEye => writes.position,
            Field::Ambient | Field::Diffuse | Field::Specular => writes.strengths,
            Field::Constant | Field::Linear | Field::Quadratic => writes.attenuation,
        }
    }

    /// The value that the host program sends for a field of a light.
    fn sent(&self, field: Field) -> Field {
        if field == Field::Position && self.context.plan.light_sent_in_eye { Field::PositionInEye } else { field }
    }

    /// A constant: a number in place, `const`, or `#define`.
    fn constant(&mut self, key: &str, ty: &str, value: Expr) -> Expr {
        match self.choice("constants", 4) {
            0 => {
                let name = self.name(key);
                self.declare(&format!("const {ty} {} = {}", name.text, value.text), "");
                name
            }
            1 => {
                let name = self.context.names.get(key).to_uppercase();
                self.declare(&format!("#define K_{name} {}", value.text), "");
                Expr::atom(format!("K_{name}"))
            }
            _ => value,
        }
    }

    pub fn vec3(&self, [x, y, z]: [f32; 3]) -> Expr {
        Expr::call("vec3", &[&self.number(x), &self.number(y), &self.number(z)])
    }

    /// A value of a light.
    pub fn light(&mut self, field: Field, which: &Which) -> Expr {
        let (member, key) = keys(field);
        if self.is_written(field) {
            let value = match field {
                Field::Position | Field::PositionInEye => {
                    let place = self.context.answer.lab_light_position();
                    self.vec3(place.to_array())
                }
                Field::Ambient => self.number(LAB.strengths[0]),
                Field::Diffuse => self.number(LAB.strengths[1]),
                Field::Specular => self.number(LAB.strengths[2]),
                Field::Constant => self.number(LAB.attenuation[0]),
                Field::Linear => self.number(LAB.attenuation[1]),
                Field::Quadratic => self.number(LAB.attenuation[2]),
            };
            return self.constant(key, type_of(field), value);
        }
        let sent = self.sent(field);
        let member = self.name(member).text;
        match self.context.plan.container {
            Container::Plain => self.uniform(key, type_of(field), Meaning::OfLight(sent, 0)),
            Container::Arrays => {
                let name = self.context.names.get(key).to_owned();
                self.declare(&format!("uniform {}", type_of(field)), &format!("{name}[2]"));
                self.input(&name, Meaning::OfAll(sent));
                let index = match which {
                    Which::Indexed(index) => index.clone(),
                    _ => self.name("arg_light").text,
                };
                Expr::atom(format!("{name}[{index}]"))
            }
            Container::Block(instance) => {
                self.declare_block(instance);
                let name = self.name("light");
                if instance { name.field(self.context.names.get(key)) } else { self.name(key) }
            }
            container => {
                let base = self.struct_of(container, which);
                base.field(&member)
            }
        }
    }

    /// The lights that the program has uniforms for.
    fn lights(&self) -> usize {
        self.context.answer.lights
    }

    /// The struct of a light.
    pub fn struct_of(&mut self, container: Container, which: &Which) -> Expr {
        let members = self.members();
        let ty = self.name("light_type").text;
        let list: String = members
            .iter()
            .map(|field| format!("\t{} {};\n", type_of(*field), self.context.names.get(keys(*field).0)))
            .collect();
        self.declare(&format!("struct {ty} {{\n{list}}}"), "");
        let indexed = container == Container::StructArray;
        let name = self.name(if indexed { "lights" } else { "light" });
        let count = self.lights();
        let declared = if indexed { format!("{}[{count}]", name.text) } else { name.text.clone() };
        self.declare(&format!("uniform {ty}"), &declared);
        for (field, index) in members.iter().flat_map(|field| (0..count).map(move |index| (*field, index))) {
            let member = self.context.names.get(keys(field).0);
            let path =
                if indexed { format!("{}[{index}].{member}", name.text) } else { format!("{}.{member}", name.text) };
            self.input(&path, Meaning::OfLight(self.sent(field), index));
        }
        match which {
            Which::Argument => self.name("arg_light"),
            Which::Indexed(index) => Expr::atom(format!("{}[{index}]", name.text)),
            Which::One if indexed => Expr::atom(format!("{}[0]", name.text)),
            Which::One => name,
        }
    }

    fn declare_block(&mut self, instance: bool) {
        let ty = self.name("block_type").text;
        let list: String = self
            .members()
            .iter()
            .map(|field| format!("\t{} {};\n", type_of(*field), self.context.names.get(keys(*field).1)))
            .collect();
        let name = if instance { self.name("light").text } else { String::new() };
        self.declare(&format!("layout (std140) uniform {ty} {{\n{list}}}"), &name);
        for field in self.members() {
            let member = self.context.names.get(keys(field).1);
            let path = if instance { format!("{ty}.{member}") } else { member.to_owned() };
            self.input(&path, Meaning::OfLight(self.sent(field), 0));
        }
    }

    /// The members of the struct or block, in the same order in both stages.
    fn members(&self) -> Vec<Field> {
        let mut members: Vec<Field> =
            FIELDS.iter().map(|(field, ..)| *field).filter(|field| !self.is_written(*field)).collect();
        let mut random = self.context.random.named("members", 0);
        if random.chance(0.4) {
            for index in (1..members.len()).rev() {
                members.swap(index, random.below(index + 1));
            }
        }
        members
    }

    pub fn shininess(&mut self) -> Expr {
        if self.context.answer.writes.exponent {
            let value = self.number(LAB_SHININESS);
            let integers = self.context.style.has_integers() && self.version().converts_integers();
            return self.constant("shininess", "float", if integers { Expr::atom("32") } else { value });
        }
        self.uniform("shininess", "float", Meaning::Shininess)
    }

    pub fn material(&mut self) -> Expr {
        if self.context.answer.writes.material {
            let value = self.vec3(LAB_MATERIAL.to_array());
            return self.constant("material", "vec3", value);
        }
        self.uniform("material", "vec3", Meaning::Material)
    }

    /// The eye's position in the space of the light; `None` at the origin of eye space.
    pub fn eye(&mut self) -> Option<Expr> {
        match self.context.plan.space {
            Space::World => Some(self.uniform("view_pos", "vec3", Meaning::ViewPosition)),
            Space::Eye => None,
        }
    }
}
