//! The gonio window as a web page: the entry points that a browser calls.
//!
//! `page` has the functions for the page's loader (`web/page/main.js`). `access` connects screen readers. The checker and the path
//! tracer are programs of their own, `gonio-web-check` and `gonio-web-trace`. On other targets the program does nothing.

#[cfg(target_arch = "wasm32")]
mod access;
#[cfg(target_arch = "wasm32")]
mod page;

fn main() {}
