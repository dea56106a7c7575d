//! Draws previews, with meshes, the sky and a white texture on the GPU.

use super::{CompiledPair, PreviewScene, PreviewShape};
use gonio_check::roles::{Bindings, Bound, Role, VariableKind};
use gonio_check::testbench::{
    CUBEMAP_UNIT, SKY_SIDE, TestScene, WHITE_UNIT, numbers_of, samplers, sky_faces, stream_of, unit,
};
use gonio_gl::{Gl, GlError};
use gonio_language::tr;
use gonio_render::user_program::{FloatTexture, Stream, StreamMesh};
use std::cell::RefCell;
use std::rc::Rc;

/// The role and the value of an attribute or a uniform.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VariableValue {
    /// Its name in OpenGL.
    pub name: String,
    /// The GLSL type.
    pub glsl_type: String,
    /// Its role and the evidence for it; `None` if unrecognised.
    pub role: Option<(String, String)>,
    /// The value, in readable form.
    pub value: String,
}

/// Meshes and textures on the GPU.
pub struct PreviewRenderer {
    gl: Gl,
    meshes: RefCell<[Option<Rc<StreamMesh>>; PreviewShape::ALL.len()]>,
    cubemap: FloatTexture,
    white: FloatTexture,
}

impl PreviewRenderer {
    /// Creates a renderer in this context, which must be current.
    pub fn new(gl: &Gl) -> Result<Self, GlError> {
        Ok(PreviewRenderer {
            gl: gl.clone(),
            meshes: RefCell::default(),
            cubemap: FloatTexture::cube(gl, SKY_SIDE, &sky_faces(), tr!("check-preview-the-exercise-s-sky"))?,
            white: FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "white")?,
        })
    }

    /// Uploads the meshes of a scene, before it is drawn.
    pub fn prepare(&self, scene: &PreviewScene) -> Result<(), GlError> {
        scene
            .objects
            .iter()
            .map(|object| object.shape)
            .chain([PreviewShape::Cube])
            .try_for_each(|shape| self.mesh(shape).map(drop))
    }

    fn mesh(&self, shape: PreviewShape) -> Result<Rc<StreamMesh>, GlError> {
        if let Some(mesh) = &self.meshes.borrow()[shape.index()] {
            return Ok(mesh.clone());
        }
        let mesh = shape.mesh();
        let stream = |name, components, numbers| Stream { name, components, numbers };
        let streams = [
            stream("position", 3, &mesh.positions[..]),
            stream("normal", 3, &mesh.normals),
            stream("tex_coord", 2, &mesh.tex_coords),
            stream("color", 3, &mesh.colors),
        ];
        let made = Rc::new(StreamMesh::new(&self.gl, &streams, &mesh.indices, &format!("{shape:?}"))?);
        self.meshes.borrow_mut()[shape.index()] = Some(made.clone());
        Ok(made)
    }

    /// Draws a program to the bound target, each shape with the values of its test scene. Unprepared shapes are left out.
    pub fn draw(&self, pair: &CompiledPair, objects: &[(PreviewShape, TestScene)]) {
        let feed: Vec<(u32, usize)> = of_kind(pair, VariableKind::Attribute)
            .filter_map(|b| Some((pair.program.attribute_location(&b.declared.name)?, stream_of(b.role)?)))
            .collect();
        self.cubemap.bind(CUBEMAP_UNIT);
        self.white.bind(WHITE_UNIT);
        pair.program.bind();
        for (index, values) in samplers(&pair.program, &pair.bindings) {
            pair.program.set_index(index, &values);
        }
        for fixed in &pair.bindings.fixed {
            pair.program.set(&fixed.declared.name, &fixed.values);
        }
        for (shape, test_scene) in objects {
            let is_number = |bound: &&Bound| unit(&bound.declared.name, &bound.declared.glsl_type).is_none();
            for bound in of_kind(pair, VariableKind::Uniform).filter(is_number) {
                if let Some(values) = held(&pair.bindings, bound, test_scene) {
                    pair.program.set(&bound.declared.name, &values);
                }
            }
            if let Some(mesh) = &self.meshes.borrow()[shape.index()] {
                mesh.draw(&pair.program, &feed);
            }
        }
    }
}

fn of_kind(pair: &CompiledPair, kind: VariableKind) -> impl Iterator<Item = &Bound> {
    pair.bindings.bound.iter().filter(move |bound| bound.declared.kind == kind)
}

/// The numbers of a uniform.
pub(crate) fn held(bindings: &Bindings, bound: &Bound, test_scene: &TestScene) -> Option<Vec<f32>> {
    let glsl_type = bound.declared.glsl_type.as_str();
    match unit(&bound.declared.name, glsl_type) {
        Some(unit) => Some(vec![unit as f32]),
        None => numbers_of(bindings, bound, test_scene),
    }
}

impl CompiledPair {
    /// Whether an attribute could be the position: without it, nothing is visible.
    pub fn has_position(&self) -> bool {
        self.bindings.bound.iter().any(|b| b.declared.kind == VariableKind::Attribute && b.role == Role::Position)
    }

    /// Every attribute and uniform, with its role and its value in a test scene.
    pub fn variable_values(&self, test_scene: &TestScene) -> Vec<VariableValue> {
        let bound = self.bindings.bound.iter().map(|bound| {
            let value = match (bound.declared.kind, held(&self.bindings, bound, test_scene)) {
                (VariableKind::Attribute, _) if stream_of(bound.role).is_some() => {
                    tr!("check-preview-from-the-mesh").to_owned()
                }
                (VariableKind::Attribute, _) => tr!("check-preview-0-0-0-1-not-in").to_owned(),
                (VariableKind::Uniform, None) => "0".to_owned(),
                (VariableKind::Uniform, Some(values)) => written(&bound.declared.glsl_type, &values),
            };
            VariableValue {
                name: bound.declared.name.clone(),
                glsl_type: bound.declared.glsl_type.clone(),
                role: Some((bound.role.to_string(), bound.how.to_string())),
                value,
            }
        });
        let fixed = self.bindings.fixed.iter().map(|fixed| VariableValue {
            name: fixed.declared.name.clone(),
            glsl_type: fixed.declared.glsl_type.clone(),
            role: Some((tr!("check-preview-a-value").to_owned(), tr!("check-inputs-by-names-toml").to_owned())),
            value: written(&fixed.declared.glsl_type, &fixed.values),
        });
        let unknown = self.bindings.unknown.iter().map(|declared| VariableValue {
            name: declared.name.clone(),
            glsl_type: declared.glsl_type.clone(),
            role: None,
            value: if declared.kind == VariableKind::Attribute { "0 0 0 1".to_owned() } else { "0".to_owned() },
        });
        bound.chain(fixed).chain(unknown).collect()
    }
}

/// Numbers in readable form: a matrix by its rows, a sampler by the texture that it samples.
fn written(glsl_type: &str, values: &[f32]) -> String {
    let number = |value: &f32| {
        let text = format!("{value:.3}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" { "0".to_owned() } else { text.to_owned() }
    };
    let line = |values: Vec<&f32>| values.into_iter().map(number).collect::<Vec<_>>().join("  ");
    match glsl_type {
        "samplerCube" => tr!("check-preview-unit-0-gonio-s-sky").to_owned(),
        "sampler2D" => tr!("check-preview-unit-1-white").to_owned(),
        "mat2" | "mat3" | "mat4" => {
            let side = glsl_type.bytes().last().map_or(4, |digit| usize::from(digit - b'0'));
            let row = |row| line(values.iter().skip(row).step_by(side).take(side).collect());
            (0..side).map(row).collect::<Vec<_>>().join("\n")
        }
        _ => {
            let count = match glsl_type {
                "vec2" => 2,
                "vec3" => 3,
                "float" | "int" | "bool" | "uint" => 1,
                _ => values.len(),
            };
            line(values.iter().take(count).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_read_them() {
        assert_eq!(written("vec3", &[1.0, -0.0001, 0.25, 1.0]), "1  0  0.25");
        assert_eq!(written("float", &[32.0]), "32");
        // Columns in memory, rows on paper.
        assert_eq!(written("mat2", &[1.0, 2.0, 3.0, 4.0]), "1  3\n2  4");
        assert_eq!(written("samplerCube", &[0.0]), "unit 0: gonio's sky");
    }

    #[test]
    fn samplers_of_two_types_beside_each_other_draw() {
        use gonio_check::submission::SourceFile;
        let exercise = crate::exercise::find("ex09").unwrap();
        let reference = |name: &str| exercise.file(name).unwrap().to_owned();
        // The second sampler is unknown: if it read unit 0, which has the sky, no draw would be valid.
        let fragment = reference("reference.frag")
            .replace("uniform vec3 u_view_pos;", "uniform sampler2D qqq; uniform vec3 u_view_pos;")
            .replace("void main() {", "void main() { vec4 leftover = texture(qqq, vec2(0.5)) - 1.0;")
            .replace("FragColor = ", "FragColor = leftover + ");
        assert!(fragment.matches("leftover").count() == 2 && fragment.contains("sampler2D qqq"), "{fragment}");
        let files = [("a.vert", reference("reference.vert")), ("a.frag", fragment)];
        let files = files.map(|(name, text)| SourceFile::new(name, text)).into();
        let context = gonio_gl::HeadlessContext::new().unwrap();
        let gl = context.gl();
        let pair = crate::preview::SubmittedPair::gather(exercise, files).unwrap().compile(gl).unwrap();
        let scene = crate::preview::scenes(exercise).remove(0);
        let renderer = PreviewRenderer::new(gl).unwrap();
        renderer.prepare(&scene).unwrap();
        let target = gonio_render::user_program::TileTarget::new(gl, 32, 1).unwrap();
        target.begin();
        target.select(0);
        renderer.draw(&pair, &scene.test_scenes(&scene.eye, 0.0, [32, 32]));
        assert_eq!(target.error(), None);
        let middle = target.read(1)[16 * 32 + 16];
        assert!(middle.iter().take(3).any(|channel| *channel > 0.05), "{middle:?}");
    }
}
