//! The OpenGL state of a window's toolkit, restored after gonio has drawn.

use crate::Gl;

/// Capabilities that are saved.
const SWITCHES: [u32; 5] = [glow::SCISSOR_TEST, glow::BLEND, glow::DEPTH_TEST, glow::CULL_FACE, glow::STENCIL_TEST];

/// The factors of blending.
const BLENDING: [u32; 4] = [glow::BLEND_SRC_RGB, glow::BLEND_DST_RGB, glow::BLEND_SRC_ALPHA, glow::BLEND_DST_ALPHA];

/// The state at a moment, put back when it is dropped.
///
/// egui's painter sets most of it anew before it draws (viewport, scissor, blending, culling, depth test, colour mask, program,
/// vertex array, unit 0) and relies on the rest being what it was: the framebuffer, the depth mask and function. gonio never
/// changes samplers and the stencil's state. It changes the layout of pixels in memory, which all code sets before use.
///
/// On the web nothing is queried: an unbound framebuffer cannot be, and other queries wait for the GPU's process. There the state
/// becomes that of a new context, which egui's painter expects; no framebuffer is bound.
pub struct SavedState<'a> {
    gl: &'a Gl,
    saved: Option<Saved>,
}

struct Saved {
    framebuffers: [Option<glow::Framebuffer>; 2],
    viewport: [i32; 4],
    scissor: [i32; 4],
    switches: [bool; SWITCHES.len()],
    blending: [u32; BLENDING.len()],
    depth_mask: bool,
    depth_function: u32,
    active_texture: u32,
}

impl<'a> SavedState<'a> {
    /// Saves the current state. The stencil test, which gonio does not use, is switched off, and the toolkit's vertex array,
    /// buffer and program are unbound.
    pub fn save(gl: &'a Gl) -> Self {
        let saved = if cfg!(target_arch = "wasm32") { None } else { Some(Saved::now(gl)) };
        gl.bind_vertex_array(None);
        gl.bind_buffer(glow::ARRAY_BUFFER, None);
        gl.use_program(None);
        gl.disable(glow::STENCIL_TEST);
        gl.blend_equation(glow::FUNC_ADD);
        SavedState { gl, saved }
    }
}

impl Saved {
    fn now(gl: &Gl) -> Self {
        Saved {
            framebuffers: [glow::DRAW_FRAMEBUFFER, glow::READ_FRAMEBUFFER].map(|target| gl.get_framebuffer(target)),
            viewport: gl.get_rectangle(glow::VIEWPORT),
            scissor: gl.get_rectangle(glow::SCISSOR_BOX),
            switches: SWITCHES.map(|switch| gl.is_enabled(switch)),
            blending: BLENDING.map(|factor| gl.get_parameter_i32(factor) as u32),
            depth_mask: gl.get_depth_mask(),
            depth_function: gl.get_parameter_i32(glow::DEPTH_FUNC) as u32,
            active_texture: gl.get_parameter_i32(glow::ACTIVE_TEXTURE) as u32,
        }
    }

    fn put_back(&self, gl: &Gl) {
        gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, self.framebuffers[0]);
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, self.framebuffers[1]);
        let [x, y, width, height] = self.viewport;
        gl.viewport(x, y, width, height);
        let [x, y, width, height] = self.scissor;
        gl.scissor(x, y, width, height);
        for (switch, on) in SWITCHES.into_iter().zip(self.switches) {
            if on { gl.enable(switch) } else { gl.disable(switch) }
        }
        let [source, destination, source_alpha, destination_alpha] = self.blending;
        gl.blend_func_separate(source, destination, source_alpha, destination_alpha);
        gl.depth_mask(self.depth_mask);
        gl.depth_func(self.depth_function);
        gl.active_texture(self.active_texture);
    }
}

impl Drop for SavedState<'_> {
    fn drop(&mut self) {
        let gl = self.gl;
        gl.bind_vertex_array(None);
        gl.use_program(None);
        if let Some(saved) = &self.saved {
            saved.put_back(gl);
            return;
        }
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        SWITCHES.into_iter().for_each(|switch| gl.disable(switch));
        gl.depth_mask(true);
        gl.depth_func(glow::LESS);
        gl.active_texture(glow::TEXTURE0);
    }
}
