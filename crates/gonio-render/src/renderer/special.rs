//! Views that are not quantities of the equation: texture coordinates as squares, and overdraw.

use super::shared::Shared;
use super::targets::PANES;
use super::{Renderer, sorted_transparent};
use crate::glsl::{ATTRIBUTES, SpecialProgram};
use crate::scene_on_gpu::{GpuObject, GpuScene, wants_unshared};
use glam::{DMat4, Vec2};
use gonio_gl::GlError;
use gonio_gl::objects::DebugGroup;
use gonio_gl::program::Program;
use gonio_gl::target::{OutputTarget, Precision, Target};
use gonio_scene::Frame;
use gonio_scene::SpecialView;
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
    /// the picture does. Gives the number of draw calls.
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

    fn set_plain_object(
        &self,
        program: &Program,
        scene: &GpuScene,
        object: &GpuObject,
        clip_from_world: &DMat4,
        flipped: bool,
    ) -> Result<(), GlError> {
        let gl = &self.gl;
        let geometries = scene.geometries.get(object.object.mesh);
        let flat = wants_unshared(object.object.shading);
        let geometry = geometries.and_then(|g| if flat { g.unshared.as_ref() } else { g.shared.as_ref() });
        let missing = || GlError::new(format!("`{}` was not uploaded", object.object.name));
        geometry.ok_or_else(missing)?.bind(gl);
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

    /// Draws a special view into a target; gives the number of draw calls.
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
    /// [`SpecialView::Overdraw`] shows. Counted by drawing, so it is exact, and there on every driver; waits for the GPU.
    /// The framebuffer's binding and the state of a window are left as [`Self::paint`] leaves them.
    pub fn count_fragments(&mut self, scene: &GpuScene, frame: &Frame) -> Result<u64, GlError> {
        let shared = self.shared.clone();
        let _state = gonio_gl::SavedState::save(&shared.gl);
        let frame = Frame { samples: 1, ..frame.clone() };
        let target = self.target_for(scene, &frame, frame.height as i32, Precision::Half, PANES, &mut Vec::new())?;
        shared.draw_special(SpecialView::Overdraw, scene, &frame, &target)?;
        let counts = target.read_single(&shared.gl);
        shared.check_error("counting fragments")?;
        Ok(counts.iter().step_by(4).map(|count| *count as u64).sum())
    }
}

/// Returns whether a picture is drawn upside down, which reverses the winding of triangles. Clip space is left-handed and the world
/// is not: the determinant of a usual projection is negative.
pub(super) fn is_flipped(clip_from_world: &DMat4) -> bool {
    clip_from_world.determinant() > 0.0
}

/// From the world to a frame's clip space.
pub(super) fn clip_from_world(frame: &Frame) -> DMat4 {
    let aspect = f64::from(frame.width) / f64::from(frame.height);
    frame.camera.clip_from_view(aspect) * frame.camera.view_from_world()
}
