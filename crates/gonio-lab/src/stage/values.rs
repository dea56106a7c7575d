//! What a uniform of a known meaning holds in a situation.

use super::Situation;
use crate::names::Role;
use glam::{Mat4, Vec3};

/// The light that a situation has; lights of other numbers give none.
const THE_LIGHT: u32 = 0;

/// The numbers for a uniform of this meaning and type; `None` where the situation has nothing to say of it.
pub fn numbers(role: Role, glsl_type: &str, situation: &Situation) -> Option<Vec<f32>> {
    let light = &situation.light;
    let view = situation.view_from_world();
    let model = situation.world_from_model;
    let projection = situation.clip_from_view();
    let matrix = |m: Mat4| match glsl_type {
        "mat3" => glam::Mat3::from_mat4(m).to_cols_array().to_vec(),
        _ => m.to_cols_array().to_vec(),
    };
    let point = |p: Vec3| vec![p.x, p.y, p.z, 1.0];
    let direction = |p: Vec3| vec![p.x, p.y, p.z, 0.0];
    // A strength may be written as a number or as a grey colour.
    let grey = |x: f32| match glsl_type {
        "float" | "int" => vec![x],
        _ => vec![x, x, x, 1.0],
    };
    let colour = |c: Vec3| vec![c.x, c.y, c.z, 1.0];
    // Lights that a program has besides are dark.
    let on = |index: u32, x: f32| if index == THE_LIGHT { x } else { 0.0 };
    Some(match role {
        Role::Model => matrix(model),
        Role::View => matrix(view),
        Role::Projection => matrix(projection),
        Role::ModelView => matrix(view * model),
        Role::ViewProjection => matrix(projection * view),
        Role::ModelViewProjection => matrix(projection * view * model),
        Role::NormalMatrix => matrix(situation.normal_matrix()),
        Role::NormalMatrixOfModelView => matrix(Mat4::from_mat3(situation.view_normal_matrix())),
        Role::ViewPos => point(situation.eye),
        Role::ViewFront => direction((situation.target - situation.eye).normalize()),
        Role::LightPos(_) => point(light.position),
        Role::LightPosInView(_) => point(view.transform_point3(light.position)),
        Role::LightDirection(_) => {
            direction((situation.world_from_model.w_axis.truncate() - light.position).normalize())
        }
        Role::LightColor(index) => grey(on(index, 1.0)),
        Role::AmbientColor(index) | Role::AmbientStrength(index) => grey(on(index, light.ambient)),
        Role::DiffuseColor(index) | Role::DiffuseStrength(index) => grey(on(index, light.diffuse)),
        Role::SpecularColor(index) | Role::SpecularStrength(index) => grey(on(index, light.specular)),
        Role::AttenuationConstant(_) => grey(light.attenuation[0]),
        Role::AttenuationLinear(_) => grey(light.attenuation[1]),
        Role::AttenuationQuadratic(_) => grey(light.attenuation[2]),
        Role::LightCount => vec![1.0],
        Role::Shininess => grey(situation.shininess),
        Role::MaterialColor | Role::MaterialAmbient | Role::MaterialDiffuse | Role::MaterialSpecular => match glsl_type
        {
            "float" => vec![1.0],
            _ => colour(situation.material),
        },
        Role::Emitted => colour(Vec3::ZERO),
        Role::RefractionIndex => grey(situation.refraction_index),
        Role::RefractionRatio => grey(1.0 / situation.refraction_index),
        Role::Time => grey(situation.time),
        Role::Gamma => grey(1.0),
        _ => return None,
    })
}
