//! Rules that no compiler enforces. Each check is a function from plain data to complaints, so each is tested with small bad
//! examples.

pub mod cycles;
pub mod dependencies;
pub mod lints;
pub mod source;
pub mod text;
pub mod translations;
pub mod words;
pub mod workflows;
