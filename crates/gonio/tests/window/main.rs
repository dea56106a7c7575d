//! The window under an X server of its own. `xdotool` presses and types; the tests read the window's exported state.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, missing_docs)]

mod access;
mod basics;
mod capture;
mod driven;
mod exercise;
mod files;
mod pointer;
#[path = "../common/renderdoc.rs"]
mod renderdoc;
mod survival;
mod traced;
// Shared with the benchmarks.
#[path = "../../../../benches/src/screen.rs"]
mod screen;
