//! The version: gonio's own, its commit, the OpenGL that it finds and the web page that it carries.

use crate::backend;
use crate::cli::BackendOptions;
use crate::commands::serve;
use crate::report::Reporter;
use gonio_gl::{DriverInfo, GlError};

/// The version and, where gonio was built from its repository, the commit and its date.
pub const SHORT: &str = env!("GONIO_VERSION");

/// What `--version` prints.
pub fn long() -> String {
    let opengl = match backend::find_driver(&BackendOptions::default()) {
        Ok(driver) => driver_line(&driver),
        Err(error) => format!("none: {}", first_line(&error)),
    };
    let page = if serve::has_embedded_page() { "embedded" } else { "not embedded" };
    format!("gonio {SHORT}\nOpenGL: {opengl}\nWeb page: {page}\n")
}

/// The version and the renderer of a driver.
pub fn driver_line(driver: &DriverInfo) -> String {
    format!("{}, GLSL {}, {}", driver.version, driver.glsl, driver.renderer)
}

/// Reports the driver with `--verbose`, for commands whose own context is elsewhere.
pub fn report_driver(reporter: &Reporter) {
    if reporter.is_verbose() {
        match backend::find_driver(&BackendOptions::default()) {
            Ok(driver) => reporter.verbose(format_args!("driver: {}", driver_line(&driver))),
            Err(error) => reporter.verbose(format_args!("driver: none: {}", first_line(&error))),
        }
    }
}

fn first_line(error: &GlError) -> &str {
    error.message.lines().next().unwrap_or_default()
}
