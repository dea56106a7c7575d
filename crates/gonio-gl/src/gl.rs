//! The OpenGL functions, and what must live as long as they are called.

use std::any::Any;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

/// The functions of a context that is current on this thread. Cheap to clone; not `Send`, as a
/// context is current on one thread only.
#[derive(Clone)]
pub struct Gl {
    // Fields drop in the order of declaration: the functions before the context that they belong to.
    functions: Arc<glow::Context>,
    _context: Option<Rc<dyn Any>>,
}

impl Gl {
    /// The functions of a context that somebody else keeps current: a window's, a web page's.
    pub fn of_window(functions: Arc<glow::Context>) -> Self {
        Gl { functions, _context: None }
    }

    /// The functions of a context that ends with the last clone of this.
    pub(crate) fn keeping_alive(functions: Arc<glow::Context>, context: impl Any) -> Self {
        Gl { functions, _context: Some(Rc::new(context)) }
    }
}

impl Deref for Gl {
    type Target = glow::Context;
    fn deref(&self) -> &glow::Context {
        &self.functions
    }
}
