//! The same for programs, uniforms and draws.

use super::data::Subject;
use super::hooks::passed_on;
use super::recorder::Call;
use super::state::base_name;
use crate::Gl;
use glow::HasContext;
use std::rc::Rc;

/// Programs.
impl Gl {
    pub unsafe fn delete_program(&self, program: glow::Program) {
        self.mirror().with(|state| state.programs.remove(&program));
        passed_on!(self.delete_program(program));
    }

    pub unsafe fn create_shader(&self, kind: u32) -> Result<glow::Shader, String> {
        let shader = passed_on!(self.create_shader(kind))?;
        self.mirror().with(|state| {
            if state.recorder.is_some() {
                state.shaders.insert(shader, (kind, String::new()));
            }
        });
        Ok(shader)
    }

    pub unsafe fn shader_source(&self, shader: glow::Shader, source: &str) {
        self.mirror().with(|state| {
            if let Some((_, kept)) = state.shaders.get_mut(&shader) {
                *kept = source.to_owned();
            }
        });
        passed_on!(self.shader_source(shader, source));
    }

    pub unsafe fn delete_shader(&self, shader: glow::Shader) {
        self.mirror().with(|state| state.shaders.remove(&shader));
        passed_on!(self.delete_shader(shader));
    }

    pub unsafe fn attach_shader(&self, program: glow::Program, shader: glow::Shader) {
        self.mirror().with(|state| {
            let (Some((kind, source)), Some(program)) = (state.shaders.get(&shader), state.programs.get_mut(&program))
            else {
                return;
            };
            let [vertex, fragment] = &mut program.sources;
            *(if *kind == glow::VERTEX_SHADER { vertex } else { fragment }) = source.clone();
        });
        passed_on!(self.attach_shader(program, shader));
    }

    pub unsafe fn link_program(&self, program: glow::Program) {
        self.mirror().with(|state| {
            let recording = state.recorder.is_some();
            if let Some(program) = state.programs.get_mut(&program) {
                // Linking puts all uniforms to 0.
                program.is_fresh = recording;
                program.sent.clear();
                program.looked_up.clear();
            }
        });
        passed_on!(self.link_program(program));
    }

    pub unsafe fn use_program(&self, program: Option<glow::Program>) {
        self.mirror().with(|state| state.program = program);
        passed_on!(self.use_program(program));
    }

    pub unsafe fn get_uniform_location(&self, program: glow::Program, name: &str) -> Option<glow::UniformLocation> {
        let location = passed_on!(self.get_uniform_location(program, name))?;
        self.mirror().with(|state| {
            if let Some(program) = state.programs.get_mut(&program) {
                #[allow(clippy::clone_on_copy)] // not Copy on the web
                program.looked_up.push((location.clone(), name.to_owned()));
            }
        });
        Some(location)
    }

    /// Notes that a uniform of the current program is set, and to which whole numbers.
    fn sent(&self, location: Option<&glow::UniformLocation>, numbers: Option<&[i32]>) {
        self.mirror().with(|state| {
            // Often called: nothing is looked for where nobody listens.
            if state.recorder.is_none() {
                return;
            }
            let program = state.program.and_then(|program| state.programs.get_mut(&program));
            let (Some(program), Some(location)) = (program, location) else { return };
            let name = program.looked_up.iter().find(|(known, _)| known == location);
            if let Some(name) = name.map(|(_, name)| base_name(name).to_owned()) {
                program.sent.insert(name, numbers.map(<[i32]>::to_vec));
            }
        });
    }
}

/// Functions that set uniforms: what they are given, and the whole numbers in it.
macro_rules! uniforms {
    ($($call:ident($($argument:ident: $Type:ty),*) => $numbers:expr;)*) => {
        impl Gl {
            $(
                #[allow(clippy::too_many_arguments)] // OpenGL's own
                pub unsafe fn $call(&self, location: Option<&glow::UniformLocation>, $($argument: $Type),*) {
                    let numbers: Option<&[i32]> = $numbers;
                    self.sent(location, numbers);
                    passed_on!(self.$call(location, $($argument),*));
                }
            )*
        }
    };
}

uniforms! {
    uniform_1_i32(x: i32) => Some(&[x]);
    uniform_2_i32(x: i32, y: i32) => Some(&[x, y]);
    uniform_1_i32_slice(v: &[i32]) => Some(v);
    uniform_1_f32(x: f32) => None;
    uniform_2_f32(x: f32, y: f32) => None;
    uniform_3_f32(x: f32, y: f32, z: f32) => None;
    uniform_4_f32(x: f32, y: f32, z: f32, w: f32) => None;
    uniform_1_f32_slice(v: &[f32]) => None;
    uniform_3_f32_slice(v: &[f32]) => None;
    uniform_4_f32_slice(v: &[f32]) => None;
    uniform_matrix_3x2_f32_slice(transpose: bool, v: &[f32]) => None;
    uniform_matrix_3_f32_slice(transpose: bool, v: &[f32]) => None;
    uniform_matrix_4_f32_slice(transpose: bool, v: &[f32]) => None;
}

/// Draws.
impl Gl {
    pub unsafe fn draw_arrays(&self, mode: u32, first: i32, count: i32) {
        self.before(&Call { mode, first, count, index_type: None, instances: 1 });
        passed_on!(self.draw_arrays(mode, first, count));
        self.after();
    }

    pub unsafe fn draw_elements(&self, mode: u32, count: i32, index_type: u32, offset: i32) {
        self.before(&Call { mode, first: offset, count, index_type: Some(index_type), instances: 1 });
        passed_on!(self.draw_elements(mode, count, index_type, offset));
        self.after();
    }

    pub unsafe fn draw_arrays_instanced(&self, mode: u32, first: i32, count: i32, instances: i32) {
        self.before(&Call { mode, first, count, index_type: None, instances });
        passed_on!(self.draw_arrays_instanced(mode, first, count, instances));
        self.after();
    }

    /// Notes a draw that is not made, because it would read what is not there: the record has all that it would have read.
    pub fn refused_draw(&self, mode: u32, first: i32, count: i32, index_type: Option<u32>) {
        self.before(&Call { mode, first, count, index_type, instances: 1 });
        self.after();
    }

    fn before(&self, call: &Call) {
        self.recorded(|recorder, state, gl| recorder.before_draw(state, gl, call));
    }

    fn after(&self) {
        self.recorded(|recorder, _, gl| recorder.after_draw(gl));
    }

    /// Opens a debug group in the record.
    pub(crate) fn group_opened(&self, name: &str) {
        self.recorded(|recorder, _, _| recorder.groups.push(name.to_owned()));
    }

    /// Closes it.
    pub(crate) fn group_closed(&self) {
        self.recorded(|recorder, _, _| drop(recorder.groups.pop()));
    }

    /// Says what the calls up to the returned guard's end are for. What is bound meanwhile is bound for that.
    pub fn drawing(&self, subject: impl FnOnce() -> Subject) -> Drawing<'_> {
        self.recorded(|recorder, _, _| {
            recorder.subjects += 1;
            recorder.subject = Some((recorder.subjects, Rc::new(subject())));
        });
        Drawing { gl: self }
    }
}

/// While something is drawn that has a name.
pub struct Drawing<'a> {
    gl: &'a Gl,
}

impl Drop for Drawing<'_> {
    fn drop(&mut self) {
        self.gl.recorded(|recorder, _, _| recorder.subject = None);
    }
}
