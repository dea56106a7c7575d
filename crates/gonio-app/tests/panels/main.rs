//! The panels, driven as a person does: a real scene, egui's own harness, pointer and keys.

mod bench;
mod compare;
mod equation;
mod scene_panels;
