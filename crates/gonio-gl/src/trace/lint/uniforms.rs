//! Uniforms that were never set, and normal matrices that do not fit.

use super::super::data::{DrawRecord, UniformValue};
use super::{Issue, Rule};
use glam::{Mat3, Mat4, Vec3};

/// Two scales that differ by less than this share are even: f32, and what a composed matrix rounds.
const EVEN: f32 = 1e-3;

/// Checks every uniform of a draw.
pub fn check(draw: &DrawRecord, issues: &mut Vec<Issue>) {
    for uniform in &draw.uniforms {
        // The initial value in a shader is as good as one that was set.
        if uniform.sent || !uniform.value.is_zero() {
            continue;
        }
        let UniformValue { name, glsl_type, .. } = uniform;
        let advice = "set it (glUniform...) after linking, while the program is in use";
        issues.push(if glsl_type.starts_with("mat") {
            Issue::error(
                Rule::UniformNeverSent,
                format!("the {glsl_type} `{name}` was never set: it is 0, and so is every product with it"),
                advice,
            )
        } else {
            Issue::warning(
                Rule::UniformNeverSent,
                format!("the uniform `{name}` ({glsl_type}) was never set and is 0"),
                advice,
            )
        });
    }
    issues.extend(normal_matrix(draw));
}

/// The matrix of normals is the identity, or the model's own, while the model is scaled unevenly: then normals lean the
/// wrong way, and so does the light. (The right one is the inverse transpose.)
fn normal_matrix(draw: &DrawRecord) -> Option<Issue> {
    let is_normal = |name: &str| name.to_ascii_lowercase().contains("normal");
    let is_model = |name: &str| {
        let name = name.to_ascii_lowercase();
        // `clip_from_model` and its like project as well.
        name.contains("model") && !["normal", "clip", "proj", "mvp"].iter().any(|other| name.contains(other))
    };
    let matrices = || draw.uniforms.iter().filter_map(|uniform| Some((uniform, matrix(uniform)?)));
    let (normal_name, normal) = matrices().find(|(uniform, _)| is_normal(&uniform.name))?;
    let (model_name, model) = matrices().find(|(uniform, _)| is_model(&uniform.name))?;
    let scales = [model.x_axis, model.y_axis, model.z_axis].map(Vec3::length);
    let (least, most) = scales.iter().fold((f32::MAX, 0.0_f32), |(l, m), s| (l.min(*s), m.max(*s)));
    if most - least <= EVEN * most {
        return None;
    }
    let what = if normal.abs_diff_eq(Mat3::IDENTITY, EVEN) {
        "the identity".to_owned()
    } else if normal.abs_diff_eq(model, EVEN * most) {
        format!("`{}` itself", model_name.name)
    } else {
        return None;
    };
    let [x, y, z] = scales;
    Some(Issue::warning(
        Rule::NormalMatrix,
        format!(
            "`{}` is {what} while `{}` scales by {x:.3}, {y:.3}, {z:.3}: normals are no longer perpendicular to the \
             surface",
            normal_name.name, model_name.name
        ),
        format!("set it to the inverse transpose of the upper left 3 x 3 of `{}`", model_name.name),
    ))
}

/// A `mat3`, or the upper left of a `mat4`.
fn matrix(uniform: &UniformValue) -> Option<Mat3> {
    let numbers = uniform.value.floats()?;
    match uniform.glsl_type.as_str() {
        "mat3" => Some(Mat3::from_cols_array(numbers.try_into().ok()?)),
        "mat4" => Some(Mat3::from_mat4(Mat4::from_cols_array(numbers.try_into().ok()?))),
        _ => None,
    }
}
