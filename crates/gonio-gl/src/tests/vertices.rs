//! Each rule about uniforms, attributes and draws, on a sequence of calls that does just that wrong.

use super::{CORNERS, LIT, Lab, NORMALS, both, only};
use crate::trace::{AttributeSource, Rule, Severity, UniformNumbers};
use glam::{Mat3, Mat4, Vec3};

const COLOR: &str = "uniform vec4 color;\nout vec4 c;\nvoid main() { c = color; }\n";

/// The lit program with its matrices.
fn lit(lab: &mut Lab, model: Mat4, normal: Mat3) {
    lab.program(LIT, NORMALS);
    lab.used().set_mat4("model", &model);
    lab.used().set_mat3("normal_matrix", &normal);
}

#[test]
fn a_correct_sequence_has_no_finding_and_lists_its_attributes() {
    both(|mut lab| {
        let scale = Mat4::from_scale(Vec3::new(1.0, 2.0, 4.0));
        lit(&mut lab, scale, Mat3::from_mat4(scale).inverse().transpose());
        let _buffer = lab.vertices([24, 24]);
        lab.draw();
        let (record, findings) = lab.finish();
        assert_eq!(findings, []);
        let draw = &record.draws[0];
        assert_eq!((draw.count, draw.highest_vertex, draw.primitive.as_str()), (3, Some(2), "triangles"));
        let model = draw.uniforms.iter().find(|u| u.name == "model").unwrap_or_else(|| panic!("{:?}", draw.uniforms));
        assert_eq!(model.value, UniformNumbers::Float(scale.to_cols_array().to_vec()));
        let AttributeSource::Array(normal) = &draw.attributes[1].source else { panic!("{:?}", draw.attributes) };
        assert_eq!((normal.offset, normal.stride, normal.buffer_bytes), (12, 24, 72));
        // llvmpipe counts in OpenGL, and has no extension for it in OpenGL ES.
        if let Some(vertices) = draw.vertices_shaded {
            assert_eq!(vertices, 3);
            assert!(draw.fragments_shaded >= Some(256), "{:?}", draw.fragments_shaded);
        }
    });
}

#[test]
fn a_uniform_that_was_never_sent() {
    both(|mut lab| {
        lab.program(CORNERS, COLOR);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::UniformNeverSent, 1);
        assert_eq!(finding.severity, Severity::Warning);
        assert!(finding.message.contains("`color` (vec4) was never set"), "{}", finding.message);
    });
    both(|mut lab| {
        lab.program(LIT, NORMALS);
        lab.used().set_mat3("normal_matrix", &Mat3::IDENTITY);
        let _buffer = lab.vertices([24, 24]);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::UniformNeverSent, 1);
        assert_eq!(finding.severity, Severity::Error, "all vertices in one place");
        assert!(finding.message.contains("the mat4 `model`"), "{}", finding.message);
    });
    both(|mut lab| {
        // 0 is a value like any other.
        lab.program(CORNERS, COLOR);
        lab.used().set_vec4("color", [0.0; 4]);
        lab.draw();
        let (_, findings) = lab.finish();
        assert_eq!(findings, []);
    });
}

#[test]
fn normals_multiplied_with_a_matrix_that_does_not_fit() {
    let uneven = Mat4::from_scale(Vec3::new(1.0, 2.0, 4.0));
    for (normal, words) in [(Mat3::IDENTITY, "is the identity"), (Mat3::from_mat4(uneven), "is `model` itself")] {
        both(|mut lab| {
            lit(&mut lab, uneven, normal);
            let _buffer = lab.vertices([24, 24]);
            lab.draw();
            let (_, findings) = lab.finish();
            let finding = only(&findings, Rule::NormalMatrix, 1);
            assert!(finding.message.contains(words), "{}", finding.message);
            assert!(finding.message.contains("1.000, 2.000, 4.000"), "{}", finding.message);
        });
    }
    both(|mut lab| {
        // An even scale changes no direction.
        lit(&mut lab, Mat4::from_scale(Vec3::splat(3.0)), Mat3::IDENTITY);
        let _buffer = lab.vertices([24, 24]);
        lab.draw();
        let (_, findings) = lab.finish();
        assert_eq!(findings, []);
    });
}

#[test]
fn an_attribute_without_an_array() {
    both(|mut lab| {
        lit(&mut lab, Mat4::IDENTITY, Mat3::IDENTITY);
        let _buffer = lab.vertices([24, 24]);
        lab.gl().disable_vertex_attrib_array(1);
        lab.draw();
        let (_, findings) = lab.finish();
        let finding = only(&findings, Rule::AttributeWithoutArray, 1);
        assert!(finding.message.contains("`normal` (location 1) has no array"), "{}", finding.message);
    });
    both(|mut lab| {
        // One normal for all vertices is intended if it was set.
        lit(&mut lab, Mat4::IDENTITY, Mat3::IDENTITY);
        let _buffer = lab.vertices([24, 24]);
        lab.gl().disable_vertex_attrib_array(1);
        lab.gl().vertex_attrib_4_f32(1, 0.0, 0.0, 0.0, 1.0);
        lab.draw();
        let (_, findings) = lab.finish();
        assert_eq!(findings, []);
    });
}

#[test]
fn a_stride_that_does_not_fit() {
    // Tightly packed, as if there were nothing else in the buffer; and shorter than an element.
    for (strides, words) in [([0, 0], "read each other's bytes"), ([24, 8], "stride of 8 bytes, less than the 12")] {
        both(|mut lab| {
            lit(&mut lab, Mat4::IDENTITY, Mat3::IDENTITY);
            let _buffer = lab.vertices(strides);
            lab.draw();
            let (_, findings) = lab.finish();
            let finding = only(&findings, Rule::WrongStride, 1);
            assert!(finding.message.contains(words), "{}", finding.message);
        });
    }
}

#[test]
fn vertices_beyond_the_buffer() {
    both(|mut lab| {
        lit(&mut lab, Mat4::IDENTITY, Mat3::IDENTITY);
        let _buffer = lab.vertices([24, 24]);
        lab.draw_vertices(6);
        let (_, mut findings) = lab.finish();
        // Both attributes are in it.
        let second = findings.pop().unwrap_or_else(|| panic!("two findings"));
        assert_eq!(second.rule, Rule::BeyondBuffer);
        let finding = only(&findings, Rule::BeyondBuffer, 1);
        assert!(finding.message.contains("up to byte 132 (vertex 5"), "{}", finding.message);
    });
}

#[test]
fn a_draw_of_nothing() {
    both(|mut lab| {
        lab.program(CORNERS, COLOR);
        lab.used().set_vec4("color", [1.0; 4]);
        lab.draw_vertices(0);
        let (_, findings) = lab.finish();
        assert!(only(&findings, Rule::NothingToDraw, 1).message.contains("0 vertices"));
    });
}

#[test]
fn an_error_of_opengl_that_nothing_else_explains() {
    both(|mut lab| {
        lab.program(CORNERS, COLOR);
        lab.used().set_vec4("color", [1.0; 4]);
        // A vec4 is not a mat4.
        lab.used().set_mat4("color", &Mat4::IDENTITY);
        lab.draw();
        let (record, findings) = lab.finish();
        assert!(only(&findings, Rule::OpenGlError, 1).message.contains("INVALID_OPERATION"));
        assert_eq!(record.draws[0].errors, ["INVALID_OPERATION"]);
    });
}
