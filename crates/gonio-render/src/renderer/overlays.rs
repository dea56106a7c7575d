//! Lines laid over a finished picture: edges of triangles, normals, boxes.
//!
//! They are drawn onto the encoded picture, so that neither exposure nor a view's scale changes their colours, with a
//! depth buffer of one sample that is filled anew for them: what is in front of a line hides it.

use super::shared::Shared;
use super::special::{clip_from_world, is_flipped};
use crate::display_texture::DisplayTexture;
use crate::geometry::Form;
use crate::glsl::SpecialProgram;
use crate::gpu_cache::GpuCache;
use crate::scene_on_gpu::{GpuObject, GpuScene, wants_unshared};
use glam::{DMat4, DVec3, Mat3, Mat4, Vec2};
use gonio_gl::GlError;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use gonio_scene::Frame;
use gonio_scene::Overlays;

/// Dark blue, which contrasts with clay and with a grey background; display-encoded, not premultiplied.
const WIREFRAME_COLOR: [f32; 4] = [0.02, 0.06, 0.16, 0.85];
/// The colour of normals.
const NORMAL_COLOR: [f32; 4] = [0.05, 0.60, 0.95, 0.9];
/// The colour of boxes.
const BOX_COLOR: [f32; 4] = [0.98, 0.62, 0.10, 1.0];
/// Half of a line's width, pixels.
const HALF_WIDTH: f32 = 0.75;
/// Half of a normal's width, pixels: there are many.
const NORMAL_HALF_WIDTH: f32 = 0.5;
/// Length of the normals, of the diagonal of the box around all objects, ...
const NORMAL_LENGTH: f64 = 0.02;
/// ... up to so many triangles; of more they are shorter, as their triangles are, ...
const SPARSE: f64 = 2000.0;
/// ... but never less than this share of it.
const SHORTEST: f64 = 0.25;

impl Shared {
    /// Draws the overlays onto a display texture that shows the frame.
    pub(super) fn draw_overlays(
        &self,
        overlays: Overlays,
        scene: &GpuScene,
        cache: &mut GpuCache,
        frame: &Frame,
        canvas: &mut DisplayTexture,
    ) -> Result<u32, GlError> {
        let gl = &self.gl;
        let _group = DebugGroup::new(gl, "overlays");
        canvas.begin_overlays()?;
        // The texture's first row is the picture's top.
        let clip_from_world = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)) * clip_from_world(frame);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LEQUAL);
        gl.disable(glow::BLEND);
        gl.color_mask(false, false, false, false);
        gl.enable(glow::POLYGON_OFFSET_FILL);
        gl.polygon_offset(1.0, 2.0);
        let filled = self.draw_plainly(SpecialProgram::Count, scene, frame, &clip_from_world);
        gl.color_mask(true, true, true, true);
        gl.disable(glow::POLYGON_OFFSET_FILL);
        gl.polygon_offset(0.0, 0.0);
        gl.depth_mask(false);
        gl.enable(glow::BLEND);
        gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
        let mut lines = Lines { shared: self, scene, cache, frame, clip_from_world, calls: filled? };
        if overlays.wireframe {
            lines.wireframe()?;
        }
        if overlays.boxes {
            lines.boxes()?;
        }
        if overlays.normals {
            lines.normals()?;
        }
        let calls = lines.calls;
        gl.disable(glow::BLEND);
        gl.disable(glow::DEPTH_TEST);
        gl.depth_mask(true);
        gl.bind_vertex_array(None);
        Ok(calls)
    }
}

struct Lines<'a> {
    shared: &'a Shared,
    scene: &'a GpuScene,
    cache: &'a mut GpuCache,
    frame: &'a Frame,
    clip_from_world: DMat4,
    calls: u32,
}

impl Lines<'_> {
    fn wireframe(&mut self) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let _group = DebugGroup::new(gl, "wireframe");
        let program = self.shared.special_program(SpecialProgram::Wireframe)?;
        program.bind();
        program.set_vec4("line_color", WIREFRAME_COLOR);
        let flipped = is_flipped(&self.clip_from_world);
        for object in &self.scene.objects {
            let geometry = self.scene.overlay_geometry(gl, self.cache, object, Form::Corners)?;
            geometry.bind(gl);
            program.set_mat4("clip_from_model", &(self.clip_from_world * object.world_from_model).as_mat4());
            // Back faces of closed objects are hidden anyway; their edges would show through at silhouettes.
            if object.object.closed {
                gl.enable(glow::CULL_FACE);
                gl.cull_face(glow::BACK);
            }
            gl.front_face(if object.mirrored != flipped { glow::CW } else { glow::CCW });
            gl.draw_arrays(glow::TRIANGLES, 0, geometry.count as i32);
            gl.disable(glow::CULL_FACE);
            gl.front_face(glow::CCW);
            self.calls += 1;
        }
        Ok(())
    }

    fn normals(&mut self) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let _group = DebugGroup::new(gl, "normals");
        let program = self.lines(NORMAL_COLOR)?;
        let diagonal = (self.frame.bounds_max - self.frame.bounds_min).length();
        let length = if diagonal > 0.0 { NORMAL_LENGTH * diagonal } else { 1.0 };
        let density = (SPARSE / self.scene.triangle_count.max(1) as f64).sqrt().clamp(SHORTEST, 1.0);
        program.set_f32("line_length", (length * density) as f32);
        program.set_f32("half_width", NORMAL_HALF_WIDTH);
        for object in &self.scene.objects {
            let flat = wants_unshared(object.object.shading);
            let form = if flat { Form::FaceNormals } else { Form::VertexNormals };
            let normal_matrix = object.normal_world_from_model;
            self.draw(&program, object, form, normal_matrix)?;
        }
        Ok(())
    }

    fn boxes(&mut self) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let _group = DebugGroup::new(gl, "boxes");
        let program = self.lines(BOX_COLOR)?;
        program.set_f32("line_length", 0.0);
        for object in &self.scene.objects {
            let directions = Mat3::from_mat4(object.world_from_model.as_mat4());
            self.draw(&program, object, Form::Box, directions)?;
        }
        Ok(())
    }

    /// The program of lines, with what all lines of a colour share.
    fn lines(&self, color: [f32; 4]) -> Result<std::rc::Rc<Program>, GlError> {
        let program = self.shared.special_program(SpecialProgram::Line)?;
        program.bind();
        program.set_vec4("line_color", color);
        program.set_f32("half_width", HALF_WIDTH);
        program.set_vec2("half_picture", 0.5 * Vec2::new(self.frame.width as f32, self.frame.height as f32));
        program.set_mat4("clip_from_world", &self.clip_from_world.as_mat4());
        Ok(program)
    }

    fn draw(&mut self, program: &Program, object: &GpuObject, form: Form, way: Mat3) -> Result<(), GlError> {
        let gl = &self.shared.gl;
        let geometry = self.scene.overlay_geometry(gl, self.cache, object, form)?;
        geometry.bind(gl);
        let world_from_model: Mat4 = object.world_from_model.as_mat4();
        program.set_mat4("world_from_model", &world_from_model);
        program.set_mat3("way_world_from_model", &way);
        gl.draw_arrays_instanced(glow::TRIANGLE_STRIP, 0, 4, geometry.count as i32);
        self.calls += 1;
        Ok(())
    }
}
