//! Views that are not quantities of the equation, and lines over a finished picture: edges of triangles, normals, boxes.

use super::shared::{PANES, Shared};
use super::{Renderer, sorted_transparent};
use crate::display::DisplayTexture;
use crate::geometry::Form;
use crate::glsl::{ATTRIBUTES, SpecialProgram};
use crate::scene_on_gpu::{GpuCache, GpuObject, GpuScene, wants_unshared};
use glam::{DMat4, DVec3, Mat3, Mat4, Vec2};
use gonio_gl::GlError;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use gonio_gl::target::{ColorPrecision, OutputTarget, Target};
use gonio_scene::{Frame, Overlays, SpecialView};
use std::rc::Rc;

impl Shared {
    /// A program, linked at its first use.
    pub(super) fn special_program(&self, which: SpecialProgram) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.special_programs.borrow().get(&which) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = which.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, which.name(), &vertex, &fragment, &ATTRIBUTES)?);
        self.special_programs.borrow_mut().insert(which, program.clone());
        Ok(program)
    }

    /// Draws all objects with one program of plain.vert: opaque ones, then transparent triangles from back to front, as
    /// the picture does. Returns the number of draw calls.
    pub(super) fn draw_plainly(
        &self,
        which: SpecialProgram,
        scene: &GpuScene,
        frame: &Frame,
        clip_from_world: &DMat4,
    ) -> Result<u32, GlError> {
        let program = self.special_program(which)?;
        program.bind();
        program.set_dvec3("eye_in_world", frame.camera.position);
        let opaque = scene.objects.iter().flat_map(|object| object.opaque.iter().map(move |run| (object, run.clone())));
        let transparent = sorted_transparent(scene, frame).into_iter().map(|draw| (draw.object, draw.run));
        let flipped = is_flipped(clip_from_world);
        let mut calls = 0;
        let mut before: Option<&GpuObject> = None;
        for (object, run) in opaque.chain(transparent) {
            if !before.is_some_and(|before| std::ptr::eq(before, object)) {
                before = Some(object);
                self.set_plain_object(&program, scene, object, clip_from_world, flipped)?;
            }
            let first = run.first_triangle * 3 * size_of::<u32>();
            let count = run.triangle_count * 3;
            self.gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, first as i32);
            calls += 1;
        }
        self.gl.disable(glow::CULL_FACE);
        self.gl.front_face(glow::CCW);
        self.gl.bind_vertex_array(None);
        Ok(calls)
    }

    pub(super) fn set_plain_object(
        &self,
        program: &Program,
        scene: &GpuScene,
        object: &GpuObject,
        clip_from_world: &DMat4,
        flipped: bool,
    ) -> Result<(), GlError> {
        let gl = &self.gl;
        scene.geometry_of(object)?.bind(gl);
        program.set_mat4("clip_from_model", &(*clip_from_world * object.world_from_model).as_mat4());
        program.set_mat4("world_from_model", &object.world_from_model.as_mat4());
        program.set_mat3("normal_world_from_model", &object.normal_world_from_model);
        if object.object.closed {
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        } else {
            gl.disable(glow::CULL_FACE);
        }
        gl.front_face(if object.mirrored != flipped { glow::CW } else { glow::CCW });
        Ok(())
    }

    /// Draws a special view into a target; returns the number of draw calls.
    pub(super) fn draw_special(
        &self,
        view: SpecialView,
        scene: &GpuScene,
        frame: &Frame,
        target: &Target,
    ) -> Result<u32, GlError> {
        let gl = &self.gl;
        let _group = DebugGroup::new(gl, view.name());
        target.begin(gl, 0, frame.height as i32);
        gl.enable(glow::DEPTH_TEST);
        gl.depth_func(glow::LESS);
        gl.disable(glow::BLEND);
        let clip_from_world = clip_from_world(frame);
        match view {
            SpecialView::Nothing => Ok(0),
            SpecialView::UvChecker => self.draw_plainly(SpecialProgram::UvChecker, scene, frame, &clip_from_world),
            SpecialView::Overdraw => {
                gl.enable(glow::BLEND);
                gl.blend_func(glow::ONE, glow::ONE);
                let drawn = self.draw_plainly(SpecialProgram::Count, scene, frame, &clip_from_world);
                gl.disable(glow::BLEND);
                drawn
            }
        }
    }

    /// The counts of a target as colours, the top row first.
    pub(super) fn overdraw_into(&self, output: &OutputTarget, target: &Target) -> Result<(), GlError> {
        let gl = &self.gl;
        let program = self.special_program(SpecialProgram::Overdraw)?;
        program.bind();
        program.set_i32("linear_picture", 0);
        program.set_vec2("picture_size", Vec2::new(target.size[0] as f32, target.size[1] as f32));
        output.bind(gl);
        self.draw_over_all(target);
        Ok(())
    }
}

impl Renderer {
    /// Counts the fragments shaded for a frame's objects, one sample per pixel: the sum of what
    /// [`SpecialView::Overdraw`] shows. Counted by drawing, so it is exact and works on every driver; waits for the GPU.
    /// The framebuffer's binding and the state of a window are left as [`Self::paint`] leaves them.
    pub fn count_fragments(&mut self, scene: &GpuScene, frame: &Frame) -> Result<u64, GlError> {
        let shared = self.shared.clone();
        let _state = gonio_gl::SavedState::save(&shared.gl);
        let frame = Frame { samples: 1, ..frame.clone() };
        let target =
            self.target_for(scene, &frame, frame.height as i32, ColorPrecision::Half, PANES, &mut Vec::new())?;
        shared.draw_special(SpecialView::Overdraw, scene, &frame, &target)?;
        let counts = target.read_single(&shared.gl);
        shared.check_error("counting fragments")?;
        Ok(counts.iter().step_by(4).map(|count| *count as u64).sum())
    }
}

/// Returns whether a picture is drawn upside down, which reverses the winding of triangles. Clip space is left-handed and the
/// world is not: the determinant of a usual projection is negative.
pub(super) fn is_flipped(clip_from_world: &DMat4) -> bool {
    clip_from_world.determinant() > 0.0
}

/// From the world to a frame's clip space.
pub(super) fn clip_from_world(frame: &Frame) -> DMat4 {
    let aspect = f64::from(frame.width) / f64::from(frame.height);
    frame.camera.clip_from_view(aspect) * frame.camera.view_from_world()
}

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
        canvas.begin_with_depth()?;
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

    /// Binds the program of lines, with the uniforms of one colour.
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
