//! The outline of parts of the objects, drawn onto a texture of its own that a window shows over the picture.

use super::Renderer;
use super::shared::{PANES, Shared};
use super::special::{clip_from_world, is_flipped};
use crate::display::DisplayTexture;
use crate::glsl::SpecialProgram;
use crate::scene_on_gpu::GpuScene;
use glam::{DMat4, DVec4, Vec2};
use gonio_gl::objects::DebugGroup;
use gonio_gl::target::{ColorPrecision, Target};
use gonio_gl::{GlError, SavedState};
use gonio_scene::Frame;

/// Pixels around the part's box: the line, with a margin.
const AROUND: f64 = 4.0;

/// A part of an object to be outlined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlinedPart {
    /// Index into the scene's objects.
    pub object: usize,
    /// Index into the object's parts.
    pub part: usize,
    /// The line's colour: display-encoded, not premultiplied.
    pub color: [f32; 4],
}

impl Renderer {
    /// Draws the outline of a part's silhouette onto `layer`, which takes the frame's size: premultiplied colours, transparent
    /// elsewhere. Objects in front of the part do not hide it. Does not wait, and leaves the window's state as
    /// [`Renderer::paint`] does. A part that the scene does not have has no outline.
    pub fn paint_outline(
        &mut self,
        scene: &GpuScene,
        frame: &Frame,
        outlined: &OutlinedPart,
        layer: &mut DisplayTexture,
    ) -> Result<(), GlError> {
        let shared = self.shared.clone();
        let gl = &shared.gl;
        let _state = SavedState::save(gl);
        let _group = DebugGroup::new(gl, "outline");
        let frame = Frame { samples: 1, ..frame.clone() };
        let height = frame.height as i32;
        let target = self.target_for(scene, &frame, height, ColorPrecision::Half, PANES, &mut Vec::new())?;
        layer.fit([frame.width, frame.height])?;
        target.begin(gl, 0, height);
        gl.disable(glow::DEPTH_TEST);
        gl.disable(glow::BLEND);
        let clip_from_world = clip_from_world(&frame);
        shared.draw_part(scene, outlined, &clip_from_world)?;
        target.resolve(gl);
        layer.output().bind(gl);
        gl.viewport(0, 0, target.size[0], target.size[1]);
        gl.clear_color(0.0, 0.0, 0.0, 0.0);
        gl.clear(glow::COLOR_BUFFER_BIT);
        let Some([x, y, width, rows]) = scissor(scene, &frame, outlined, &clip_from_world) else { return Ok(()) };
        gl.enable(glow::SCISSOR_TEST);
        gl.scissor(x, y, width, rows);
        let drawn = shared.draw_outline(&target, outlined.color);
        gl.disable(glow::SCISSOR_TEST);
        drawn
    }
}

/// The pixels of the layer, whose top row is first, that the outline can have: left, first row, width and rows. `None` if there
/// are none.
fn scissor(scene: &GpuScene, frame: &Frame, outlined: &OutlinedPart, clip_from_world: &DMat4) -> Option<[i32; 4]> {
    let object = &scene.objects.get(outlined.object)?.object;
    let part = object.parts.get(outlined.part)?;
    let mesh = scene.meshes.get(object.mesh)?;
    let clip_from_model = *clip_from_world * object.world_from_model;
    let size = [f64::from(frame.width), f64::from(frame.height)];
    let (mut least, mut most) = (size, [0.0_f64; 2]);
    for triangle in part.first_triangle..part.first_triangle + part.triangle_count {
        for corner in mesh.triangle_positions(triangle) {
            let at: DVec4 = clip_from_model * corner.as_dvec3().extend(1.0);
            if at.w <= 0.0 {
                return Some([0, 0, frame.width as i32, frame.height as i32]);
            }
            let place = [(0.5 + 0.5 * at.x / at.w) * size[0], (0.5 - 0.5 * at.y / at.w) * size[1]];
            for axis in 0..2 {
                least[axis] = least[axis].min(place[axis]);
                most[axis] = most[axis].max(place[axis]);
            }
        }
    }
    let [x, y] = [0, 1].map(|axis| (least[axis] - AROUND).clamp(0.0, size[axis]).floor());
    let [right, bottom] = [0, 1].map(|axis| (most[axis] + AROUND).clamp(0.0, size[axis]).ceil());
    (right > x && bottom > y).then(|| [x, y, right - x, bottom - y].map(|side| side as i32))
}

impl Shared {
    /// Draws the triangles of a part with ones.
    fn draw_part(&self, scene: &GpuScene, outlined: &OutlinedPart, clip_from_world: &DMat4) -> Result<(), GlError> {
        let Some(object) = scene.objects.get(outlined.object) else { return Ok(()) };
        let Some(part) = object.object.parts.get(outlined.part) else { return Ok(()) };
        let gl = &self.gl;
        let program = self.special_program(SpecialProgram::Count)?;
        program.bind();
        self.set_plain_object(&program, scene, object, clip_from_world, is_flipped(clip_from_world))?;
        let [first, count] = [part.first_triangle, part.triangle_count].map(|triangles| triangles * 3);
        let offset = (first * size_of::<u32>()) as i32;
        gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, offset);
        gl.disable(glow::CULL_FACE);
        gl.front_face(glow::CCW);
        gl.bind_vertex_array(None);
        Ok(())
    }

    fn draw_outline(&self, mask: &Target, color: [f32; 4]) -> Result<(), GlError> {
        let program = self.special_program(SpecialProgram::Outline)?;
        program.bind();
        program.set_i32("linear_picture", 0);
        program.set_vec2("picture_size", Vec2::new(mask.size[0] as f32, mask.size[1] as f32));
        program.set_vec4("line_color", color);
        self.draw_over_all(mask);
        Ok(())
    }
}
