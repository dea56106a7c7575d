//! The OpenGL functions, and what must live as long as they are called.

use crate::Dialect;
use crate::trace::Mirror;
use glow::HasContext;
use std::any::Any;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

/// The functions of a context that is current on this thread. Cheap to clone; not `Send`, as a
/// context is current on one thread only. Make one for a context and clone it: clones know together what exists and what
/// is bound (see `record`).
#[derive(Clone)]
pub struct Gl {
    // Fields drop in the order of declaration: the functions before the context that they belong to.
    functions: Arc<glow::Context>,
    /// What exists and what is bound, for records of frames.
    mirror: Rc<Mirror>,
    _context: Option<Rc<dyn Any>>,
}

impl Gl {
    /// The functions of a context that somebody else keeps current: a window's, a web page's.
    pub fn of_window(functions: Arc<glow::Context>) -> Self {
        Gl { functions, mirror: Rc::default(), _context: None }
    }

    /// The functions of a context that ends with the last clone of this.
    #[cfg(feature = "headless")]
    pub(crate) fn keeping_alive(functions: Arc<glow::Context>, context: impl Any) -> Self {
        Gl { functions, mirror: Rc::default(), _context: Some(Rc::new(context)) }
    }

    /// The same functions, with a mirror that knows nothing yet: what is made through it is in no other's records, and
    /// whoever uses it puts bindings back through the other one when done.
    pub fn apart(&self) -> Gl {
        Gl { functions: self.functions.clone(), mirror: Rc::default(), _context: self._context.clone() }
    }

    /// The dialect of GLSL that the context compiles.
    pub fn dialect(&self) -> Dialect {
        if self.functions.version().is_embedded { Dialect::Es300 } else { Dialect::Core330 }
    }

    /// glow's functions, past our own of the same name: what is called here is not noted.
    pub fn functions(&self) -> &glow::Context {
        &self.functions
    }

    /// What exists and what is bound.
    pub(crate) fn mirror(&self) -> &Mirror {
        &self.mirror
    }
}

impl Deref for Gl {
    type Target = glow::Context;
    fn deref(&self) -> &glow::Context {
        &self.functions
    }
}
