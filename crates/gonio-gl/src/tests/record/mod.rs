//! Records of frames: our own, and wrong ones.

mod frames;
mod lab;
mod samplers;
mod vertices;
