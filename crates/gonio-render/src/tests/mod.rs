//! Tests that need a context: on whatever driver there is, Mesa's llvmpipe in CI.

mod compile;
mod conversion;
mod difference;
mod environment;
mod overlays;
mod paint;
mod trace;
mod twins;
mod twins_optics;
mod user_program;

use gonio_gl::headless::{HeadlessContext, HeadlessOptions};

/// A context, or a panic that says what to install.
pub(crate) fn context(es: bool) -> HeadlessContext {
    HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() }).unwrap_or_else(|why| panic!("{why}"))
}
