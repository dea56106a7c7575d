//! The window itself, under an X server of its own: pressed and typed into by `xdotool`, looked at by its exported state.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, missing_docs)]

mod driven;
mod exercise;
mod files;
mod habits;
mod pointer;
mod refused;
mod survival;
// The benches' own.
#[path = "../../../../benches/src/screen.rs"]
mod screen;
