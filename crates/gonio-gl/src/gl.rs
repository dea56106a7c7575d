//! OpenGL of a context, the objects that must outlive its calls, and errors.

use crate::Dialect;
use crate::functions::Functions;
use crate::trace::recorder::Record;
use crate::trace::state::State;
use std::any::Any;
use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;
use std::sync::Arc;

/// The OpenGL of a context that is current on this thread. Cheap to clone; not `Send`, as a context is current on one
/// thread only. Make one for a context and clone it: clones share the record of objects and bindings (see
/// [`crate::trace`]).
///
/// Its methods are OpenGL's functions, named as in glow. They are safe: wrong arguments raise an error that
/// [`Gl::get_error`] gives, as in OpenGL itself. Calls that would read or write beyond their memory are not made, and raise
/// `GL_INVALID_OPERATION`.
#[derive(Clone)]
pub struct Gl {
    // Fields drop in the order of declaration: the functions before the context that they belong to.
    functions: Rc<Functions>,
    tracker: Rc<Tracker>,
    _context: Option<Rc<dyn Any>>,
}

/// The state of the context, as calls through a [`Gl`] and its clones have set it.
#[derive(Default)]
struct Tracker {
    state: RefCell<State>,
    /// While a recording runs.
    recorder: RefCell<Option<Box<dyn Record>>>,
    /// Whether each call is followed by `glGetError`, so that refused calls are not noted.
    asks_for_errors: bool,
}

impl Gl {
    /// Wraps a context that other code keeps current: the context of a window or of a web page. That code may use the context
    /// too, if [`crate::SavedState`] encloses each run of calls through this.
    pub fn of_window(context: Arc<glow::Context>) -> Self {
        Gl { functions: Rc::new(Functions::new(context)), tracker: Rc::default(), _context: None }
    }

    /// Wraps a context, and keeps it alive until the last clone is dropped.
    #[cfg(feature = "headless")]
    pub(crate) fn keeping_alive(functions: Arc<glow::Context>, context: impl Any) -> Self {
        Gl { _context: Some(Rc::new(context)), ..Gl::of_window(functions) }
    }

    /// Returns a separate `Gl` of the same context, for calls that may be wrong. It checks for an error after each call,
    /// and records only calls that succeeded. It does not share objects with the other `Gl`s; the caller restores bindings
    /// through the original when done.
    pub fn apart(&self) -> Gl {
        let tracker = Tracker { asks_for_errors: true, ..Tracker::default() };
        Gl { functions: self.functions.clone(), tracker: Rc::new(tracker), _context: self._context.clone() }
    }

    /// The dialect of GLSL that the context compiles.
    pub fn dialect(&self) -> Dialect {
        if self.is_embedded() { Dialect::Es300 } else { Dialect::Core330 }
    }

    /// Whether the context is one of OpenGL ES, as WebGL2 is.
    pub fn is_embedded(&self) -> bool {
        self.functions.is_embedded()
    }

    /// The context's version: major, minor.
    pub fn version(&self) -> (u32, u32) {
        self.functions.version()
    }

    /// Whether the context has an extension.
    pub fn supports(&self, extension: &str) -> bool {
        self.functions.supports(extension)
    }

    /// Fetches and clears an error; `GL_NO_ERROR` where there is none.
    #[inline]
    pub fn get_error(&self) -> u32 {
        self.functions.get_error()
    }

    /// The functions, without taking notes.
    #[inline]
    pub(crate) fn functions(&self) -> &Functions {
        &self.functions
    }

    /// Reads or changes the tracked state. Calls must not be nested.
    #[inline]
    pub(crate) fn with_state<T>(&self, f: impl FnOnce(&mut State) -> T) -> T {
        f(&mut self.tracker.state.borrow_mut())
    }

    /// Notes a call that was made, if OpenGL accepted it.
    #[inline]
    pub(crate) fn note(&self, f: impl FnOnce(&mut State)) {
        if self.is_noted() {
            self.with_state(f);
        }
    }

    /// Whether to note the previous call: a [`Gl`] that is apart leaves out refused calls. The error is kept for
    /// [`Gl::get_error`].
    #[inline]
    pub(crate) fn is_noted(&self) -> bool {
        if !self.tracker.asks_for_errors {
            return true;
        }
        match self.functions.get_own_error() {
            glow::NO_ERROR => true,
            error => {
                self.functions.raise(error);
                false
            }
        }
    }

    /// Calls `f` with the recorder if a recording is running.
    #[inline]
    pub(crate) fn recorded(&self, f: impl FnOnce(&mut dyn Record, &mut State, &Functions)) {
        if let Some(recorder) = self.tracker.recorder.borrow_mut().as_deref_mut() {
            self.with_state(|state| f(recorder, state, &self.functions));
        }
    }

    /// Begins or ends a recording, and returns the recorder that ran until now.
    pub(crate) fn exchange_recorder(&self, recorder: Option<Box<dyn Record>>) -> Option<Box<dyn Record>> {
        self.with_state(|state| state.is_recording = recorder.is_some());
        self.tracker.recorder.replace(recorder)
    }
}

/// An error of OpenGL or of a driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GlError {
    /// One sentence: the error, its place, and a remedy. A driver's log may follow.
    pub message: String,
    /// A remedy that some programs offer as an option.
    pub remedy: Option<Remedy>,
}

/// A remedy for an error, in programs that have an option for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Drawing on the CPU, which needs no OpenGL.
    CpuRenderer,
    /// A picture of fewer pixels, or fewer samples per pixel.
    SmallerPicture,
}

impl GlError {
    /// Creates an error without a remedy.
    pub fn new(message: impl Into<String>) -> Self {
        GlError { message: message.into(), remedy: None }
    }

    /// The same error with a remedy.
    pub fn with_remedy(self, remedy: Remedy) -> Self {
        GlError { remedy: Some(remedy), ..self }
    }
}

impl fmt::Display for GlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for GlError {}
