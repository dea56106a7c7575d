//! Records of wrong sequences of calls.

mod lab;
mod samplers;
mod vertices;
