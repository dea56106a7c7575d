//! The state that all parts of the renderer share: the context, the driver's limits and the linked programs.

use crate::glsl::{ATTRIBUTES, OutputKey, SceneKey, SpecialProgram};
use gonio_gl::objects::VertexArray;
use gonio_gl::program::Program;
use gonio_gl::{DriverInfo, Gl, GlError};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// The context, the driver's limits and the linked programs: shared with every finished frame.
pub struct Shared {
    pub gl: Gl,
    pub info: DriverInfo,
    pub scene_programs: RefCell<HashMap<SceneKey, Rc<Program>>>,
    pub output_programs: RefCell<HashMap<OutputKey, Rc<Program>>>,
    pub special_programs: RefCell<HashMap<SpecialProgram, Rc<Program>>>,
    pub sky: RefCell<Option<Rc<Program>>>,
    pub difference: RefCell<Option<Rc<Program>>>,
    /// Core profiles draw nothing without a vertex array, even where no attribute is read.
    pub no_attributes: VertexArray,
}

impl Shared {
    pub fn scene_program(&self, key: SceneKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.scene_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = key.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, &key.name(), &vertex, &fragment, &ATTRIBUTES)?);
        self.scene_programs.borrow_mut().insert(key, program.clone());
        Ok(program)
    }

    pub fn output_program(&self, key: OutputKey) -> Result<Rc<Program>, GlError> {
        if let Some(program) = self.output_programs.borrow().get(&key) {
            return Ok(program.clone());
        }
        let [vertex, fragment] = key.sources(self.info.dialect);
        let program = Rc::new(Program::new(&self.gl, &format!("output {key:?}"), &vertex, &fragment, &[])?);
        self.output_programs.borrow_mut().insert(key, program.clone());
        Ok(program)
    }

    /// Clears OpenGL's error flags, of which it has a few.
    pub fn forget_errors(&self) {
        (0..8).take_while(|_| self.gl.get_error() != glow::NO_ERROR).for_each(drop);
    }

    /// Turns OpenGL's error flag into an error; `doing` completes "... while".
    pub fn check_error(&self, doing: &str) -> Result<(), GlError> {
        match self.gl.get_error() {
            glow::NO_ERROR => Ok(()),
            glow::OUT_OF_MEMORY => Err(GlError::new(format!(
                "the driver ran out of memory while {doing}; a smaller picture or model may work"
            ))),
            code => Err(GlError::new(format!("OpenGL reported error {code:#06x} while {doing}"))),
        }
    }
}
