//! The one exception of the package, and the guard that work without Python's lock runs in.

use gonio_gl::GlError;
use gonio_image::ImageError;
use gonio_mesh::{Cause, ReadError};
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use std::any::Any;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

create_exception!(gonio, Error, PyException, "Something is wrong with a file, an argument or the machine.");

/// What went wrong, as one sentence.
#[derive(Clone, Debug)]
pub struct Failure(pub String);

impl Failure {
    /// A failure with this sentence.
    pub fn new(message: impl Display) -> Self {
        Failure(message.to_string())
    }

    /// The failure that a panic is.
    pub fn of_panic(panic: &(dyn Any + Send)) -> Self {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
        Failure(format!("{text}; this is a bug in gonio, please report it"))
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Error::new_err(failure.0)
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Failure(format!("{error}{}", hint(error.cause)))
    }
}

impl From<GlError> for Failure {
    fn from(error: GlError) -> Self {
        Failure(error.message)
    }
}

impl From<ImageError> for Failure {
    fn from(error: ImageError) -> Self {
        Failure::new(error)
    }
}

/// The argument that helps, where one does.
pub fn hint(cause: Option<Cause>) -> &'static str {
    match cause {
        None => "",
        Some(Cause::MemoryLimit) => "; max_memory=BYTES raises the limit",
        Some(Cause::Sandbox) => "; without sandbox=True it is read",
        Some(Cause::EnvironmentAsModel) => ": environment=NAME",
        Some(Cause::NoEnvironment) => "; environment=\"sky\" adds one",
        Some(Cause::GuessedLayout) => ": environment={\"layout\": ...}",
        Some(Cause::CoarseEnvironment) => ": environment={\"size\": ...}",
    }
}

/// The exception for something that cannot happen.
pub fn bug(error: &dyn Display) -> PyErr {
    Error::new_err(format!("{error}; this is a bug in gonio, please report it"))
}

/// Runs `work` while other threads of Python run. A panic is a failure.
pub fn without_lock<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T, Failure> + Send) -> PyResult<T> {
    let result = py
        .detach(|| catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(Failure::of_panic(panic.as_ref()))));
    Ok(result?)
}
