//! Rules that no compiler enforces. Each check is a function from plain data to complaints, so each is tested with small bad
//! examples.

pub mod cycles;
pub mod dependencies;
pub mod examples;
pub mod length;
pub mod lints;
pub mod paths;
pub mod source;
pub mod tree;
pub mod words;
