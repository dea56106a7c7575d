//! The panels, driven as a person does: a real scene, egui's own harness, pointer and keys.

mod bench;
mod camera;
mod compare;
mod equation;
mod lights;
mod objects;
mod picture;
