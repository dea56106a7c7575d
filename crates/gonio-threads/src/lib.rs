//! Parallel iterators: rayon's, or sequential ones of the same names on the web, where there is one thread.
//!
//! There rayon would run everything on that thread too, but its pool and its splitting of work are a tenth of a small
//! module. [`sequential`] has the part of rayon's interface that gonio uses; it is compiled everywhere, so that it is tested.
#![forbid(unsafe_code)]

pub mod sequential;

/// Whether there can be more than one thread. Code for several is left out of the module where this is `false`.
pub const HAS_THREADS: bool = !cfg!(target_family = "wasm");

#[cfg(not(target_family = "wasm"))]
pub use rayon::{current_num_threads, join, prelude};
#[cfg(target_family = "wasm")]
pub use sequential::{current_num_threads, join, prelude};
