//! glTF: the result of each construct of the format, messages about odd files, and damaged files.

#![allow(clippy::unwrap_used, missing_docs)]

mod builder;
mod errors;
mod geometry;
mod materials;
mod oddities;
mod second_reader;
mod write;
