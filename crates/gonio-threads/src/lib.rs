//! Parallel iterators: rayon's, or sequential ones of the same names on the web, where there is one thread.
//!
//! There rayon would run everything on that thread too, but its pool and its splitting of work are a tenth of a small
//! module. [`sequential`] has the part of rayon's interface that gonio uses; it is compiled everywhere, so that it is tested.
#![forbid(unsafe_code)]

pub mod sequential;

/// Whether there can be more than one thread. Code for several is left out of the module where this is `false`.
pub const HAS_THREADS: bool = !cfg!(target_family = "wasm");

/// Runs `other` on another thread, if there is one, and `here` on this one meanwhile: it may use what cannot leave its thread.
#[cfg(not(target_family = "wasm"))]
pub fn beside<A: Send, B>(other: impl FnOnce() -> A + Send, here: impl FnOnce() -> B) -> (A, B) {
    if rayon::current_num_threads() == 1 {
        return (other(), here());
    }
    let mut found = None;
    let result = rayon::in_place_scope(|scope| {
        scope.spawn(|_| found = Some(other()));
        here()
    });
    // The scope ends when the other thread has finished, or has panicked, and this one panics with it.
    (found.unwrap_or_else(|| unreachable!("the scope waits for `other`")), result)
}

#[cfg(not(target_family = "wasm"))]
pub use rayon::{broadcast, current_num_threads, join, prelude};
#[cfg(target_family = "wasm")]
pub use sequential::{beside, broadcast, current_num_threads, join, prelude};
