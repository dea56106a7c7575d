//! The lab window: one application for the desktop and the web page.
//!
//! [`Lab`] is the application. It draws through `gonio-gl`, the very renderer and GLSL of `gonio render`, into textures
//! that the window shows; what is edited is a [`document::Document`], plain data with undo.
//!
//! | room | what |
//! |---|---|
//! | [`document`] | what is edited, saved and undone |
//! | [`session`] | what is not: files read, time, selection, messages |
//! | [`action`] | what is asked for that is no change of the document |
//! | [`panels`] | the equation, the lists, the numbers: widgets over the document |
//! | [`viewport`] | the picture, and what pointer and keys do there |
//! | `drawing` | the panes' pictures, drawn when something changed |
//! | [`probing`] | the probed pixel and its numbers |
//! | `jobs` | reading files without blocking the window |
//! | [`files`] | files that a person gives: dropped, chosen, packed |
//! | [`saving`] | pictures and scenes as files |
//! | [`laboratory`] | the exercises: students' files, their picture, the checker; apart from the scene |
//! | [`platform`] | what desktop and web do each in their own way |
//! | [`widgets`] | numbers, colours, choices: what panels are made of |
//! | [`typeset`] | formulas as a textbook sets them |
//! | [`theme`] | fonts, colours, distances |
//! | [`exported`] | the state as JSON |

pub mod action;
pub mod document;
mod drawing;
pub mod exported;
pub mod files;
mod jobs;
mod lab;
pub mod laboratory;
pub mod panels;
pub mod platform;
pub mod probing;
pub mod saving;
pub mod session;
pub mod shortcuts;
pub mod theme;
pub mod typeset;
pub mod viewport;
pub mod widgets;

pub use jobs::{Adjust, Opening};
pub use lab::{FIRST_SCENE, Lab};
