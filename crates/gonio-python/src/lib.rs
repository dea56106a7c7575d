//! The native part of the Python package `gonio`, the module `gonio._native`.
//!
//! The package's Python files (`python/gonio`) have what users call: names, defaults, arrays, notebooks. They give options as
//! JSON, which this crate lays over a scene file, and get pixels as buffers and reports as JSON. Whatever takes time runs
//! without Python's lock. No panic gets through: it becomes `gonio.Error`.

mod array;
mod brdf;
mod check;
mod draw;
mod error;
mod options;
mod picture;
mod scene;
mod session;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::array::NativeArray;
    #[pymodule_export]
    use crate::brdf::{NativeBrdf, brdf_models};
    #[pymodule_export]
    use crate::check::{check_submission, exercises, stopped_check};
    #[pymodule_export]
    use crate::error::Error;
    #[pymodule_export]
    use crate::picture::{NativePicture, encode_exr};
    #[pymodule_export]
    use crate::scene::{NativeScene, inspect, view_names};
    #[pymodule_export]
    use crate::session::NativeSession;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

/// A value as JSON text, which Python reads: numbers as the reports of the command line have them.
fn json(value: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_value(value).map(|value| value.to_string()).map_err(|error| error::bug(&error))
}
