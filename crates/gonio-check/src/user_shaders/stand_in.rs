//! Writes the stage that the user left out: a vertex shader that feeds a fragment shader by the names of its inputs, or a
//! fragment shader that shows the shape.

use super::uniforms::components;
use crate::roles::{self, Bindings, Declared, How, Meaning, NamesFile, Role};
use crate::submission::StageText;
use crate::words::words_of;
use gonio_glsl::{Interface, Storage, Type, Variable};
use gonio_language::tr;
use std::fmt::Write as _;

/// The inputs of the stand-ins, under names that no user's shader has.
const INPUTS: [(&str, &str, &str, Role); 13] = [
    ("in", "vec3", "gonio_position", Role::Position),
    ("in", "vec3", "gonio_normal", Role::Normal),
    ("in", "vec2", "gonio_tex_coord", Role::TexCoord),
    ("in", "vec4", "gonio_color", Role::Color),
    ("in", "vec4", "gonio_tangent", Role::Tangent),
    ("uniform", "mat4", "gonio_model", Role::Model),
    ("uniform", "mat4", "gonio_view", Role::View),
    ("uniform", "mat4", "gonio_projection", Role::Projection),
    ("uniform", "mat3", "gonio_normal_matrix", Role::NormalMatrix),
    ("uniform", "vec3", "gonio_view_pos", Role::ViewPos),
    ("uniform", "vec3", "gonio_light_pos", Role::LightPos(0)),
    ("uniform", "vec3", "gonio_diffuse", Role::MaterialDiffuse),
    ("uniform", "vec2", "gonio_resolution", Role::Resolution),
];

/// The roles of the stand-ins' inputs.
pub(super) fn names() -> NamesFile {
    NamesFile {
        names: INPUTS.iter().map(|(.., name, role)| ((*name).to_owned(), Meaning::Role(*role))).collect(),
        ..NamesFile::default()
    }
}

/// Whether this is the name of one of those inputs.
pub(super) fn is_input(name: &str) -> bool {
    INPUTS.iter().any(|(_, _, input, _)| *input == name)
}

/// The declarations of those inputs that a text uses.
fn declarations(body: &str, with_attributes: bool) -> String {
    let used =
        INPUTS.iter().filter(|(kind, _, name, _)| (*kind == "uniform" || with_attributes) && body.contains(name));
    used.fold(String::new(), |text, (kind, ty, name, _)| text + &format!("{kind} {ty} {name};\n"))
}

/// Computed once where an input needs it.
const WORLD: &str = "vec4 gonio_world = gonio_model * vec4(gonio_position, 1.0);\n";

/// A vertex shader for this fragment shader. Inputs that it cannot provide are 0, with a warning.
pub(super) fn vertex(
    fragment: Option<(&StageText, &Interface)>,
    names: &NamesFile,
    warnings: &mut Vec<String>,
) -> StageText {
    let (mut outputs, mut body) = (String::new(), String::new());
    if let Some((text, interface)) = fragment {
        let by_role = Varyings::new(interface, names);
        for input in &interface.inputs {
            let Some(ty) = declarable(input) else { continue };
            let _ = writeln!(outputs, "{}out {ty} {};", interpolation(input), input.name);
            by_role.assign(&input.name, input, text, &mut body, warnings);
        }
        for block in interface.blocks.iter().filter(|block| block.storage == Storage::In) {
            let members: String = block
                .members
                .iter()
                .filter_map(|member| {
                    Some(format!("{}{} {}; ", interpolation(member), declarable(member)?, member.name))
                })
                .collect();
            let instance = block.instance.as_deref().unwrap_or_default();
            let _ = writeln!(outputs, "out {} {{ {members}}} {instance};", block.name);
            for member in block.members.iter().filter(|member| declarable(member).is_some()) {
                let prefix = if instance.is_empty() { String::new() } else { format!("{instance}.") };
                by_role.assign(&format!("{prefix}{}", member.name), member, text, &mut body, warnings);
            }
        }
    }
    body.push_str("gl_Position = gonio_projection * (gonio_view * gonio_world);\n");
    let text = format!(
        "#version 330 core\n{}{outputs}void main() {{\n{WORLD}{body}}}\n",
        declarations(&format!("{WORLD}{body}"), true)
    );
    StageText::whole(tr!("check-inputs-gonio-s-vertex-shader"), text)
}

/// A fragment shader for this vertex shader: its colour if it has one, otherwise the material's in the light of a lamp at the
/// camera. The normal is that of the surface as the vertex shader placed it.
pub(super) fn fragment(vertex: Option<&Interface>) -> StageText {
    let is_color = |output: &&Variable| {
        let ty = output.ty.as_ref().map(Type::written).unwrap_or_default();
        let declared = Declared::attribute(&output.name, &ty);
        matches!(ty.as_str(), "vec3" | "vec4")
            && roles::bind(&[declared], &NamesFile::default()).bound.iter().any(|bound| bound.role == Role::Color)
    };
    let color = vertex.and_then(|interface| interface.outputs.iter().find(is_color));
    let (input, body) = match color {
        Some(output) => {
            let ty = output.ty.as_ref().map(Type::written).unwrap_or_default();
            let input = format!("{}in {ty} {};\n", interpolation(output), output.name);
            (input, format!("gonio_out = vec4({}.rgb, 1.0);\n", output.name))
        }
        None => (
            String::new(),
            "\
vec4 point = inverse(gonio_projection) * vec4(2.0 * gl_FragCoord.xyz / vec3(gonio_resolution, 1.0) - 1.0, 1.0);
vec3 place = point.xyz / point.w;
vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
gonio_out = vec4(gonio_diffuse * (0.15 + 0.85 * abs(normal.z)), 1.0);
"
            .to_owned(),
        ),
    };
    let text = format!(
        "#version 330 core\n{}{input}out vec4 gonio_out;\nvoid main() {{\n{body}}}\n",
        declarations(&body, false)
    );
    StageText::whole(tr!("check-inputs-gonio-s-fragment-shader"), text)
}

fn interpolation(variable: &Variable) -> String {
    let is_whole = variable.ty.as_ref().and_then(Type::scalar).is_some_and(|s| s != gonio_glsl::Scalar::Float);
    match &variable.interpolation {
        Some(word) => format!("{word} "),
        None if is_whole => "flat ".to_owned(),
        None => String::new(),
    }
}

/// The type of an input that the stand-in declares; arrays and structs are left out, and do not link.
fn declarable(variable: &Variable) -> Option<String> {
    let ty = variable.ty.as_ref()?;
    matches!(ty, Type::Scalar(_) | Type::Vector(..) | Type::Matrix { .. }).then(|| ty.written())
}

/// The roles of all inputs of a fragment shader: one whose name says nothing gets what its type suggests.
struct Varyings {
    bindings: Bindings,
}

impl Varyings {
    fn new(interface: &Interface, names: &NamesFile) -> Self {
        let members = interface.blocks.iter().filter(|block| block.storage == Storage::In).flat_map(|b| &b.members);
        let declared: Vec<Declared> = interface
            .inputs
            .iter()
            .chain(members)
            .map(|input| Declared::attribute(&input.name, input.ty.as_ref().map(Type::written).unwrap_or_default()))
            .collect();
        Varyings { bindings: roles::bind(&declared, names) }
    }

    /// The value of an input in GLSL; `None` if nobody knows what it is.
    fn value(&self, name: &str, ty: &str) -> Option<String> {
        if let Some(fixed) = self.bindings.fixed.iter().find(|fixed| fixed.declared.name == name) {
            let is_whole = [1, components(ty)].contains(&fixed.values.len());
            let numbers: Vec<String> = fixed.values.iter().map(|number| format!("{number:?}")).collect();
            return is_whole.then(|| format!("{ty}({})", numbers.join(", ")));
        }
        let bound = self.bindings.bound.iter().find(|bound| bound.declared.name == name);
        // The words of a name that names.toml explains do not count.
        let words = bound.filter(|bound| bound.how == How::NamesFile).map_or(name, |_| "");
        let (value, size, w) = value(words, bound.map(|bound| bound.role))?;
        converted(&value, size, w, ty)
    }

    /// Appends the assignment of an input.
    fn assign(&self, target: &str, input: &Variable, text: &StageText, body: &mut String, warnings: &mut Vec<String>) {
        let ty = input.ty.as_ref().map(Type::written).unwrap_or_default();
        let value = self.value(&input.name, &ty).unwrap_or_else(|| {
            if input.is_used {
                let (file, line, column) = text.place(input.span.line, input.span.column);
                warnings.push(tr!(
                    "check-inputs-gonio-s-vertex-shader-does-not",
                    file = file,
                    line = line,
                    column = column,
                    name = input.name
                ));
            }
            format!("{ty}(0)")
        });
        let _ = writeln!(body, "{target} = {value};");
    }
}

/// The expression for an input with this name, its number of components (9: a 3x3 matrix), and the fourth component of a vec4.
fn value(name: &str, role: Option<Role>) -> Option<(String, u8, &'static str)> {
    let words = words_of(name);
    let has = |any: &[&str]| words.iter().any(|word| any.contains(&word.as_str()));
    const EYE: [&str; 7] = ["view", "eye", "camera", "cam", "ec", "es", "viewspace"];
    const DIRECTION: [&str; 6] = ["dir", "direction", "vec", "vector", "to", "ray"];
    const OBJECT: [&str; 7] = ["model", "object", "local", "obj", "os", "oc", "raw"];
    const CLIP: [&str; 3] = ["clip", "ndc", "screen"];
    let world_normal = "(gonio_normal_matrix * gonio_normal)";
    let world_tangent = "(mat3(gonio_model) * gonio_tangent.xyz)";
    let bitangent = format!("(cross({world_normal}, {world_tangent}) * gonio_tangent.w)");
    // A normal from world to view space: V is a rotation.
    let placed = |model: &str, world: &str| match () {
        () if has(&OBJECT) => model.to_owned(),
        () if has(&EYE) => format!("(mat3(gonio_view) * {world})"),
        () => world.to_owned(),
    };
    if has(&["tbn"]) {
        let columns = [world_tangent, &bitangent, world_normal].map(|column| format!("normalize({column})"));
        return Some((format!("mat3({})", columns.join(", ")), 9, ""));
    }
    if has(&["bitangent", "binormal", "bitan"]) {
        return Some((format!("normalize({})", placed(&bitangent, &bitangent)), 3, "0.0"));
    }
    if has(&["light", "l", "lamp", "sun"]) {
        let direction = "normalize(gonio_light_pos - gonio_world.xyz)";
        return (has(&DIRECTION) || words == ["l"]).then(|| (direction.to_owned(), 3, "0.0"));
    }
    if words == ["v"] || has(&EYE) && has(&DIRECTION) {
        return Some(("normalize(gonio_view_pos - gonio_world.xyz)".to_owned(), 3, "0.0"));
    }
    if words == ["n"] {
        return Some((format!("normalize({world_normal})"), 3, "0.0"));
    }
    Some(match role? {
        Role::Position if has(&CLIP) => ("(gonio_projection * (gonio_view * gonio_world))".to_owned(), 4, ""),
        Role::Position if has(&OBJECT) => ("gonio_position".to_owned(), 3, "1.0"),
        Role::Position if has(&EYE) => ("(gonio_view * gonio_world).xyz".to_owned(), 3, "1.0"),
        Role::Position => ("gonio_world.xyz".to_owned(), 3, "1.0"),
        Role::Normal => (format!("normalize({})", placed("gonio_normal", world_normal)), 3, "0.0"),
        Role::Tangent => (format!("normalize({})", placed("gonio_tangent.xyz", world_tangent)), 3, "gonio_tangent.w"),
        Role::TexCoord => ("gonio_tex_coord".to_owned(), 2, "1.0"),
        Role::Color => ("gonio_color".to_owned(), 4, ""),
        _ => return None,
    })
}

/// An expression of `size` floats as one of another type; `None` if that makes no sense.
fn converted(value: &str, size: u8, w: &str, ty: &str) -> Option<String> {
    Some(match (size, ty) {
        (9, "mat3") | (4, "vec4") | (3, "vec3") | (2, "vec2") => value.to_owned(),
        (2, "vec3") => format!("vec3({value}, 0.0)"),
        (2, "vec4") => format!("vec4({value}, 0.0, {w})"),
        (3, "vec4") => format!("vec4({value}, {w})"),
        (3 | 4, "vec2") => format!("{value}.xy"),
        (4, "vec3") => format!("{value}.xyz"),
        (2..=4, "float") => format!("{value}.x"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_glsl::Stage;

    fn interface(text: &str, stage: Stage) -> Interface {
        let mut parsed = gonio_glsl::parse(text);
        gonio_glsl::check(&mut parsed, stage).interface
    }

    /// The stand-in of a fragment shader, and the warnings.
    fn vertex_of(fragment: &str) -> (String, Vec<String>) {
        let mut warnings = Vec::new();
        let text = StageText::whole("a.frag", fragment);
        let names = NamesFile::default();
        let made = vertex(Some((&text, &interface(fragment, Stage::Fragment))), &names, &mut warnings);
        (made.text, warnings)
    }

    #[test]
    fn inputs_are_fed_by_their_names() {
        for (input, expected) in [
            ("in vec3 normal;", "normal = normalize((gonio_normal_matrix * gonio_normal));"),
            ("in vec3 vNormal;", "vNormal = normalize((gonio_normal_matrix * gonio_normal));"),
            ("in vec3 eyeNormal;", "eyeNormal = normalize((mat3(gonio_view) * (gonio_normal_matrix * gonio_normal)));"),
            ("in vec3 FragPos;", "FragPos = gonio_world.xyz;"),
            ("in vec4 worldPosition;", "worldPosition = vec4(gonio_world.xyz, 1.0);"),
            ("in vec3 v_eye_pos;", "v_eye_pos = (gonio_view * gonio_world).xyz;"),
            ("in vec3 local_pos;", "local_pos = gonio_position;"),
            ("in vec2 TexCoords;", "TexCoords = gonio_tex_coord;"),
            ("in vec2 vUv;", "vUv = gonio_tex_coord;"),
            ("in vec3 v_color;", "v_color = gonio_color.xyz;"),
            ("in vec3 viewDir;", "viewDir = normalize(gonio_view_pos - gonio_world.xyz);"),
            ("in vec3 L;", "L = normalize(gonio_light_pos - gonio_world.xyz);"),
            ("flat in int part;", "part = int(0);"),
            ("in VS { vec3 FragPos; vec2 uv; } fs;", "fs.uv = gonio_tex_coord;"),
        ] {
            let fragment = format!("#version 330 core\n{input}\nout vec4 c;\nvoid main() {{ c = vec4(1.0); }}\n");
            let (text, _) = vertex_of(&fragment);
            assert!(text.contains(expected), "{input}: {text}");
        }
    }

    #[test]
    fn an_input_that_nobody_knows_is_a_warning_with_its_place() {
        let (text, warnings) = vertex_of(
            "#version 330 core\nin vec3 normal;\nin float glow;\nout vec4 c;\nvoid main() { c = vec4(glow * normal, 1.0); }\n",
        );
        assert!(text.contains("glow = float(0);"), "{text}");
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].starts_with("a.frag:3:10: ") && warnings[0].contains("`glow`"), "{warnings:?}");
    }

    #[test]
    fn names_toml_gives_inputs_roles_and_values() {
        let fragment =
            "#version 330 core\nin vec3 uv;\nin vec2 glow;\nout vec4 c;\nvoid main() { c = vec4(glow, uv.xy); }\n";
        let names = NamesFile::parse("[names]\nuv = \"normal\"\nglow = [0.5, 2]\n").unwrap();
        let mut warnings = Vec::new();
        let text = StageText::whole("a.frag", fragment);
        let made = vertex(Some((&text, &interface(fragment, Stage::Fragment))), &names, &mut warnings).text;
        assert!(made.contains("uv = normalize((gonio_normal_matrix * gonio_normal));"), "{made}");
        assert!(made.contains("glow = vec2(0.5, 2.0);") && warnings.is_empty(), "{made} {warnings:?}");
    }

    #[test]
    fn a_fragment_stand_in_shows_the_vertex_shaders_colour() {
        let with_color =
            interface("#version 330 core\nin vec3 p; out vec3 vColor; void main() { vColor = p; }", Stage::Vertex);
        assert!(fragment(Some(&with_color)).text.contains("gonio_out = vec4(vColor.rgb, 1.0);"));
        let without = interface("#version 330 core\nin vec3 p; out vec3 n; void main() { n = p; }", Stage::Vertex);
        assert!(fragment(Some(&without)).text.contains("gonio_diffuse"));
    }
}
