//! Inputs of a draw: uniforms, normal matrices and attributes; draws without effect.

use super::super::data::{ArraySource, AttributeRecord, AttributeSource, DrawRecord, UniformValue};
use super::{Issue, Rule};
use glam::{Mat3, Mat4, Vec3};

/// Two scales that differ by less than this share are even: f32, and what a composed matrix rounds.
const EVEN: f32 = 1e-3;

/// Checks every uniform of a draw.
pub fn check_uniforms(draw: &DrawRecord, issues: &mut Vec<Issue>) {
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

/// Checks a draw and its attributes.
pub fn check_attributes(draw: &DrawRecord, issues: &mut Vec<Issue>) {
    if let Some(finding) = nothing_to_draw(draw) {
        // It reads no attributes.
        issues.push(finding);
        return;
    }
    for (place, attribute) in draw.attributes.iter().enumerate() {
        let finding = match &attribute.source {
            AttributeSource::Constant { set: true, .. } => None,
            AttributeSource::Constant { value: [x, y, z, w], .. } => Some(Issue::error(
                Rule::AttributeWithoutArray,
                format!(
                    "the attribute `{}` (location {}) has no array: every vertex reads ({x}, {y}, {z}, {w})",
                    attribute.name, attribute.location
                ),
                "describe it (glVertexAttribPointer) and enable it (glEnableVertexAttribArray) in the vertex array",
            )),
            AttributeSource::Array(array) => without_buffer(attribute, array)
                .or_else(|| short_stride(attribute, array))
                .or_else(|| interleaved_wrongly(draw, place, attribute, array))
                .or_else(|| beyond_buffer(draw, attribute, array)),
        };
        issues.extend(finding);
    }
}

fn nothing_to_draw(draw: &DrawRecord) -> Option<Issue> {
    let [.., width, height] = draw.state.viewport;
    let (why, advice) = if draw.program.is_none() {
        ("no program is in use", "use one (glUseProgram) before drawing")
    } else if draw.count == 0 {
        ("it has 0 vertices", "pass the number of vertices, or of indices")
    } else if draw.instances == 0 {
        ("it has 0 instances", "pass at least 1")
    } else if width == 0 || height == 0 {
        ("the viewport has no pixels", "set it to the size of the picture (glViewport)")
    } else if draw.primitive.starts_with("triangle") && draw.state.cull.as_deref() == Some("front and back") {
        ("front and back faces are culled", "cull only back faces (glCullFace), or none")
    } else if draw.state.color_mask == [false; 4] && !draw.state.depth_mask {
        ("neither colours nor depths are written", "enable one of them (glColorMask, glDepthMask)")
    } else {
        return None;
    };
    Some(Issue::warning(Rule::NothingToDraw, format!("this draw has no effect: {why}"), advice))
}

fn without_buffer(attribute: &AttributeRecord, array: &ArraySource) -> Option<Issue> {
    (array.buffer == 0).then(|| {
        Issue::error(
            Rule::AttributeWithoutArray,
            format!(
                "the attribute `{}` is enabled, but no buffer was bound when glVertexAttribPointer described it",
                attribute.name
            ),
            "bind the buffer to GL_ARRAY_BUFFER before glVertexAttribPointer",
        )
    })
}

fn short_stride(attribute: &AttributeRecord, array: &ArraySource) -> Option<Issue> {
    (array.stride != 0 && array.stride < array.element_bytes).then(|| {
        Issue::error(
            Rule::WrongStride,
            format!(
                "the attribute `{}` has a stride of {} bytes, less than the {} bytes of its {} x {}",
                attribute.name, array.stride, array.element_bytes, array.components, array.component_type
            ),
            "the stride is the distance in bytes from one vertex to the next, at least the size of a vertex in the buffer; 0 \
             means tightly packed",
        )
    })
}

/// Two attributes in one buffer read each other's bytes.
fn interleaved_wrongly(draw: &DrawRecord, place: usize, me: &AttributeRecord, mine: &ArraySource) -> Option<Issue> {
    let highest = draw.highest_vertex?;
    let end = |a: &ArraySource| u64::from(a.offset) + span(a, highest);
    for other in draw.attributes.get(..place)? {
        let AttributeSource::Array(theirs) = &other.source else { continue };
        let is_same = [theirs.offset, theirs.effective_stride(), theirs.element_bytes]
            == [mine.offset, mine.effective_stride(), mine.element_bytes];
        if theirs.buffer != mine.buffer || theirs.divisor != mine.divisor || is_same {
            continue;
        }
        let apart = end(theirs) <= u64::from(mine.offset) || end(mine) <= u64::from(theirs.offset);
        let (first, second) = if theirs.offset <= mine.offset { (theirs, mine) } else { (mine, theirs) };
        let side_by_side = first.effective_stride() == second.effective_stride()
            && first.offset + first.element_bytes <= second.offset
            && second.offset + second.element_bytes - first.offset <= first.effective_stride();
        if apart || side_by_side {
            continue;
        }
        return Some(Issue::error(
            Rule::WrongStride,
            format!(
                "`{}` (offset {}, stride {}) and `{}` (offset {}, stride {}) read each other's bytes in the buffer {}",
                other.name,
                theirs.offset,
                theirs.effective_stride(),
                me.name,
                mine.offset,
                mine.effective_stride(),
                buffer_name(mine)
            ),
            format!(
                "if attributes are interleaved in a buffer, the stride of each is the size of all of them: {} bytes here, \
                 if there are no others",
                theirs.element_bytes + mine.element_bytes
            ),
        ));
    }
    None
}

fn beyond_buffer(draw: &DrawRecord, attribute: &AttributeRecord, array: &ArraySource) -> Option<Issue> {
    let highest = match array.divisor {
        0 => draw.highest_vertex?,
        divisor => (draw.instances.max(1) - 1) / divisor,
    };
    let end = u64::from(array.offset) + span(array, highest);
    (end > array.buffer_bytes).then(|| {
        Issue::error(
            Rule::BeyondBuffer,
            format!(
                "`{}` is read up to byte {end} (vertex {highest}, offset {}, stride {}), and the buffer {} has {}",
                attribute.name,
                array.offset,
                array.effective_stride(),
                buffer_name(array),
                array.buffer_bytes
            ),
            "check the vertex count, the indices, the stride and the offset",
        )
    })
}

/// Bytes from an array's first to the end of its vertex `highest`.
fn span(array: &ArraySource, highest: u32) -> u64 {
    u64::from(array.effective_stride()) * u64::from(highest) + u64::from(array.element_bytes)
}

fn buffer_name(array: &ArraySource) -> String {
    if array.buffer_name.is_empty() { array.buffer.to_string() } else { format!("`{}`", array.buffer_name) }
}
