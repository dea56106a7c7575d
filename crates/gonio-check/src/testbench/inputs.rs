//! The inputs of programs in a test scene: the value of each uniform with a known role, and the texture of each sampler.

use super::{TestLight, TestScene};
use crate::roles::{Bindings, Bound, Role, VariableKind};
use glam::{Mat3, Mat4, Vec3};
use gonio_glsl::{Scalar, Type};
use gonio_render::user_program::UserProgram;

/// Returns the value of a uniform with this role and type; `None` if the test scene has none.
pub fn numbers(role: Role, glsl_type: &str, test_scene: &TestScene) -> Option<Vec<f32>> {
    // Additional lights are dark.
    let light_of = |index: u32| match (index, test_scene.other) {
        (0, _) => test_scene.light,
        (1, Some(other)) => other,
        _ => test_scene.light.dark(),
    };
    let view = test_scene.view_from_world();
    let model = test_scene.world_from_model;
    let projection = test_scene.clip_from_view();
    let matrix = |m: Mat4| match glsl_type {
        "mat3" => Mat3::from_mat4(m).to_cols_array().to_vec(),
        _ => m.to_cols_array().to_vec(),
    };
    let point = |p: Vec3| vec![p.x, p.y, p.z, 1.0];
    let direction = |p: Vec3| vec![p.x, p.y, p.z, 0.0];
    let centre = model.w_axis.truncate();
    let to_light_in_centre = |light: TestLight| (light.position - centre).normalize();
    // A strength may be declared as a number or as a grey colour.
    let grey = |x: f32| match glsl_type {
        "float" | "int" => vec![x],
        _ => vec![x, x, x, 1.0],
    };
    let colour = |c: Vec3| vec![c.x, c.y, c.z, 1.0];
    Some(match role {
        Role::Model => matrix(model),
        Role::View => matrix(view),
        Role::Projection => matrix(projection),
        Role::ModelView => matrix(view * model),
        Role::ViewProjection => matrix(projection * view),
        Role::ModelViewProjection => matrix(projection * view * model),
        Role::NormalMatrix => matrix(test_scene.normal_matrix()),
        Role::NormalMatrixOfModelView => matrix(Mat4::from_mat3(test_scene.view_normal_matrix())),
        Role::ModelInverse => matrix(model.inverse()),
        Role::ViewInverse => matrix(view.inverse()),
        Role::ModelViewInverse => matrix((view * model).inverse()),
        Role::ViewRotation => matrix(Mat4::from_mat3(Mat3::from_mat4(view))),
        Role::ViewProjectionRotation => matrix(projection * Mat4::from_mat3(Mat3::from_mat4(view))),
        Role::ViewPos => point(test_scene.eye),
        Role::ViewFront => direction(test_scene.front()),
        Role::WorldUp => direction(test_scene.up.normalize()),
        Role::ViewRight => direction(test_scene.right()),
        Role::ViewUp => direction(test_scene.right().cross(test_scene.front())),
        Role::ViewTarget => point(test_scene.target),
        Role::Yaw => vec![test_scene.front().z.atan2(test_scene.front().x).to_degrees()],
        Role::Pitch => vec![test_scene.front().y.asin().to_degrees()],
        Role::LightPos(index) => point(light_of(index).position),
        Role::LightPosInView(index) => point(view.transform_point3(light_of(index).position)),
        Role::LightDirection(index) => {
            let to_light = to_light_in_centre(light_of(index));
            direction(if light_of(index).points_to_light { to_light } else { -to_light })
        }
        Role::LightDirectionInView(index) => {
            let to_light = view.transform_vector3(to_light_in_centre(light_of(index)));
            direction(if light_of(index).points_to_light { to_light } else { -to_light })
        }
        Role::LightHalfVector(index) => {
            let to_light = view.transform_vector3(to_light_in_centre(light_of(index)));
            direction((to_light + Vec3::Z).normalize_or_zero())
        }
        Role::LightColor(index) => grey(light_of(index).brightness),
        Role::AmbientColor(index) | Role::AmbientStrength(index) => grey(light_of(index).ambient),
        Role::DiffuseColor(index) | Role::DiffuseStrength(index) => grey(light_of(index).diffuse),
        Role::SpecularColor(index) | Role::SpecularStrength(index) => grey(light_of(index).specular),
        Role::Strengths(index) => {
            let light = light_of(index);
            vec![light.ambient, light.diffuse, light.specular, 1.0]
        }
        Role::AttenuationConstant(index) => grey(light_of(index).attenuation[0]),
        Role::AttenuationLinear(index) => grey(light_of(index).attenuation[1]),
        Role::AttenuationQuadratic(index) => grey(light_of(index).attenuation[2]),
        Role::Attenuation(index) => light_of(index).attenuation.to_vec(),
        Role::LightCount => vec![if test_scene.other.is_some() { 2.0 } else { 1.0 }],
        Role::Shininess => grey(test_scene.shininess),
        Role::Roughness => grey(test_scene.roughness),
        Role::MaterialColor | Role::MaterialAmbient | Role::MaterialDiffuse | Role::MaterialSpecular => match glsl_type
        {
            "float" => vec![1.0],
            _ => colour(test_scene.material),
        },
        Role::Emitted => colour(Vec3::ZERO),
        Role::RefractionIndex => grey(test_scene.refraction_index),
        Role::RefractionRatio => grey(1.0 / test_scene.refraction_index),
        Role::Time => grey(test_scene.time),
        Role::Gamma | Role::Tint => grey(1.0),
        _ => return None,
    })
}

/// Returns the value of a variable with a role; `None` if the test scene has none.
pub fn numbers_of(bindings: &Bindings, bound: &Bound, test_scene: &TestScene) -> Option<Vec<f32>> {
    let declared = &bound.declared;
    let mut values = numbers_of_array(bound.role, &declared.glsl_type, declared.array, test_scene)?;
    if let Some(last) = bindings.last_of(declared) {
        values.resize(4, 1.0);
        values[3] = *numbers(last.role, &last.declared.glsl_type, test_scene)?.first()?;
    }
    Some(values)
}

/// Returns the value of an array: elements of lights belong to consecutive lights, others are all the same.
fn numbers_of_array(role: Role, glsl_type: &str, elements: u32, test_scene: &TestScene) -> Option<Vec<f32>> {
    if elements <= 1 {
        return numbers(role, glsl_type, test_scene);
    }
    let size = match glsl_type.strip_prefix("vec").and_then(|digits| digits.parse().ok()) {
        Some(size) => size,
        None => numbers(role, glsl_type, test_scene)?.len(),
    };
    let first = role.light().unwrap_or(0);
    // No driver has more uniforms.
    let elements = (0..elements.min(256)).map(|element| {
        let mut numbers = numbers(role.with_light(first.saturating_add(element)), glsl_type, test_scene)?;
        numbers.resize(size, 0.0);
        Some(numbers)
    });
    elements.collect::<Option<Vec<_>>>().map(|elements| elements.concat())
}

/// Returns the value of a uniform in bits, as OpenGL's calls convert numbers: integers and booleans are rounded, missing ones are 0.
pub fn uniform_bits(ty: &Type, count: u32, values: &[f32]) -> Vec<u32> {
    let size = ty.components().unwrap_or(1) * count;
    let number = |at: u32| values.get(at as usize).copied().unwrap_or(0.0);
    let convert = |x: f32| match ty.scalar() {
        Some(Scalar::Float | Scalar::Double) => x.to_bits(),
        Some(Scalar::Bool) => u32::from(x.round() != 0.0),
        Some(Scalar::Int) => x.round() as i32 as u32,
        Some(Scalar::UInt) | None => x.round() as u32,
    };
    (0..size).map(|at| convert(number(at))).collect()
}

/// The texture unit of the environment.
pub const CUBEMAP_UNIT: u32 = 0;
/// The texture unit of the white texture.
pub const WHITE_UNIT: u32 = 1;
/// A unit without a texture.
const BLACK_UNIT: u32 = 2;
/// Longer arrays of samplers are not supported.
const MOST_ELEMENTS: u32 = 64;

/// Whether a texture has light that the material emits, which test scenes do not have.
fn is_emission(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["emission", "emissive", "emitted"].iter().any(|word| name.contains(word))
}

/// Returns the texture unit of a sampler with this name and type. Each type has its own, because a unit cannot be read in
/// two ways. A type without a texture reads an empty unit, which is black; an unknown 2D texture is white, like a shadow
/// map without shadows.
pub fn unit(name: &str, glsl_type: &str) -> Option<u32> {
    const EMPTY: [&str; 8] = [
        "sampler2DShadow",
        "samplerCubeShadow",
        "sampler2DArray",
        "sampler3D",
        "sampler1D",
        "sampler2DArrayShadow",
        "sampler2DMS",
        "samplerBuffer",
    ];
    match glsl_type {
        "samplerCube" => Some(CUBEMAP_UNIT),
        "sampler2D" if is_emission(name) => Some(BLACK_UNIT),
        "sampler2D" => Some(WHITE_UNIT),
        _ => {
            let place = EMPTY.iter().position(|known| *known == glsl_type).unwrap_or(EMPTY.len());
            glsl_type.contains("sampler").then_some(1 + BLACK_UNIT + place as u32)
        }
    }
}

/// Returns the indices and units of all samplers of a program, including unknown ones.
pub fn samplers(program: &UserProgram, bindings: &Bindings) -> Vec<(usize, Vec<f32>)> {
    let unknown = bindings.unknown.iter().filter(|declared| declared.kind == VariableKind::Uniform);
    let all = bindings.bound.iter().map(|bound| &bound.declared).chain(unknown);
    all.filter_map(|declared| {
        let elements = declared.array.clamp(1, MOST_ELEMENTS) as usize;
        Some((
            program.uniform_index(&declared.name)?,
            vec![unit(&declared.name, &declared.glsl_type)? as f32; elements],
        ))
    })
    .collect()
}
