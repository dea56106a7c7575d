//! Reports on verdicts for people and machines: test reports, graders' results, tables, pages, pictures.
//!
//! The functions return text or bytes, and write no files. Everything that students wrote (names, lines of source, messages)
//! is treated as hostile: see `text`.

mod graders;
mod html;
mod junit;
mod overview;
mod page;
mod picture;
mod similarity;
mod table;
mod text;

#[cfg(test)]
mod tests;

pub use graders::{code_runner, gradescope};
pub use html::page_name;
pub use junit::junit;
pub use overview::overview;
pub use page::page;
pub(crate) use picture::NAN_COLOUR;
pub use picture::contact_sheet;
pub use similarity::{Fingerprint, similar_pairs, similarity};
pub use table::{Row, RowMistake, csv};
pub use text::{is_hidden, push_visible, visible};
