//! The gonio window as a web page: the entry points that a browser calls.
//!
//! `page` has the functions for the page's loader (`web/page/main.js`), `check` those for its worker (`web/page/checker.js`). `access`
//! connects screen readers. The path tracer is another program, `gonio-web-trace`. On other targets the program does nothing.

#[cfg(target_arch = "wasm32")]
mod access;
#[cfg(target_arch = "wasm32")]
mod check;
#[cfg(target_arch = "wasm32")]
mod page;

fn main() {}
