//! The gonio window as a web page: the entry points that a browser calls.
//!
//! What the page's loader (`web/page/main.js`) calls stands in `page`, and what its worker (`web/page/checker.js`) calls in
//! `check`; elsewhere there is nothing to run.

#[cfg(target_arch = "wasm32")]
mod check;
#[cfg(target_arch = "wasm32")]
mod page;

fn main() {}
