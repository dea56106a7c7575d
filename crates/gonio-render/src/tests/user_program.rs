//! Other people's programs on a canvas: upright, numbers as they are, in a square that the picture is a part of.

use super::context;
use crate::DisplayTexture;
use crate::renderer::Renderer;
use crate::user_program::{Stream, StreamMesh, UserProgram};
use gonio_gl::Gl;

const BODY: [&str; 2] = [
    "in vec2 place;\nvoid main() { gl_Position = vec4(place, 1.0, 1.0); }\n",
    // No alpha, and more light than can be shown.
    "precision highp float;\nout vec4 color;\nvoid main() { color = vec4(2.0, 0.5, 0.0, 0.0); }\n",
];

/// A square from the middle to the upper right corner of the viewport, at the farthest depth.
fn quarter(gl: &Gl, es: bool) -> (UserProgram, StreamMesh) {
    let version = if es { "#version 300 es\n" } else { "#version 330 core\n" };
    let [vertex, fragment] = BODY.map(|body| format!("{version}{body}"));
    let program = UserProgram::new(gl, &vertex, &fragment).unwrap_or_else(|why| panic!("{why}"));
    let numbers = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let streams = [Stream { name: "place", components: 2, numbers: &numbers }];
    let mesh = StreamMesh::new(gl, &streams, &[0, 1, 2, 0, 2, 3], "quarter").unwrap_or_else(|why| panic!("{why}"));
    (program, mesh)
}

#[test]
fn a_foreign_picture_is_the_middle_of_a_square_and_as_its_numbers_say() {
    for es in [false, true] {
        let context = context(es);
        let gl = context.gl();
        let mut renderer = Renderer::new(gl.clone()).unwrap_or_else(|why| panic!("{why}"));
        let (program, mesh) = quarter(gl, es);
        let location = program.attribute_location("place").unwrap_or_else(|| panic!("no attribute"));
        let mut canvas = DisplayTexture::new(gl, [1, 1]).unwrap_or_else(|why| panic!("{why}"));
        for [width, height] in [[40_u32, 20], [20, 40], [16, 16]] {
            let painted = renderer.paint_user_program(&mut canvas, [width, height], [0.0, 0.0, 1.0], || {
                program.bind();
                mesh.draw(&program, &[(location, 0)]);
            });
            painted.unwrap_or_else(|why| panic!("{why}"));
            assert_eq!(canvas.size(), [width, height]);
            let pixels = canvas.read8();
            for (index, pixel) in pixels.chunks_exact(4).enumerate() {
                let (x, y) = (index as u32 % width, index as u32 / width);
                let inside = x >= width / 2 && y < height / 2;
                // 0.5 is between two steps of 8 bits.
                let wanted = if inside { [255, pixel[1].clamp(127, 128), 0, 255] } else { [0, 0, 255, 255] };
                assert_eq!(pixel, wanted, "es {es}, {width} x {height}: {x}, {y}");
            }
        }
    }
}
