//! The barest loop that draws a scene: what the frame benchmark holds [`Renderer::render`] against.

use super::Renderer;
use crate::scene_on_gpu::{GpuScene, wants_unshared};
use gonio_gl::GlError;

impl Renderer {
    /// Draws again what [`Renderer::render`] drew last, `frames` times, and waits for each: clear, one
    /// call for the one run of the one object, resolve. Program, uniforms, textures and target are as
    /// `render` left them; nothing is looked up, set, counted or labelled.
    ///
    /// Only for benchmarks: `scene` must be of one opaque object of one run, and must be the scene that
    /// was drawn last.
    pub fn bare_loop(&mut self, scene: &GpuScene, frames: usize) -> Result<(), GlError> {
        let wrong = || GlError::new("the bare loop draws one opaque object of one material that was rendered before");
        let gl = &self.shared.gl;
        let target = self.targets.last().ok_or_else(wrong)?;
        let [object] = scene.objects.as_slice() else { return Err(wrong()) };
        let [run] = object.opaque.as_slice() else { return Err(wrong()) };
        if !object.transparent.is_empty() {
            return Err(wrong());
        }
        let geometries = scene.geometries.get(object.object.mesh).ok_or_else(wrong)?;
        let geometry = if wants_unshared(object.object.shading) { &geometries.unshared } else { &geometries.shared };
        geometry.as_ref().ok_or_else(wrong)?.bind(gl);
        let first = run.first_triangle * 3 * size_of::<u32>();
        let count = run.triangle_count * 3;
        if object.object.closed {
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        }
        gl.front_face(if object.mirrored { glow::CW } else { glow::CCW });
        for _ in 0..frames {
            target.begin(gl, 0, target.size[1]);
            gl.draw_elements(glow::TRIANGLES, count as i32, glow::UNSIGNED_INT, first as i32);
            target.resolve(gl);
            gl.finish();
        }
        gl.disable(glow::CULL_FACE);
        gl.front_face(glow::CCW);
        gl.bind_vertex_array(None);
        self.shared.check_error("the bare loop")
    }
}
