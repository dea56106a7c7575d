//! Tests that need a context, on the driver of this machine: Mesa's llvmpipe in CI.

mod environment;
mod overlays;
mod paint;
mod programs;
mod trace;
mod twins;

use gonio_gl::headless::{HeadlessContext, HeadlessOptions};

/// A context; panics with the packages to install if there is none.
pub(crate) fn context(es: bool) -> HeadlessContext {
    HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
        .unwrap_or_else(|error| panic!("{error}"))
}
