//! glTF: what each construct of the format gives, what is said about what is odd, and that nothing brings it down.

#![allow(clippy::unwrap_used, missing_docs)]

mod builder;
mod errors;
mod geometry;
mod materials;
mod oddities;
mod second_reader;
mod write;
