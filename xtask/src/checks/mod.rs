//! The rules of the house that no compiler knows. Each check takes plain data and gives complaints,
//! so that each can be tried on a small bad example.

pub mod dependencies;
pub mod examples;
pub mod length;
pub mod output;
pub mod paths;
pub mod source;
pub mod tree;
pub mod unsafe_code;
