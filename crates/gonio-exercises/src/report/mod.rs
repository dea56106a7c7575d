//! Reports on verdicts for people and machines: test reports, graders' results, tables, pages, pictures.
//!
//! The functions return text or bytes, and write no files. Everything that students wrote (names, lines of source, messages)
//! is treated as hostile: see `text`.

mod address;
mod annotations;
mod graders;
mod html;
mod junit;
mod listing;
mod navigation;
mod overview;
mod page;
mod picture;
mod sarif;
mod sha256;
mod similarity;
mod table;
mod text;
mod thumbnail;
mod verdict_parts;

#[cfg(test)]
mod tests;

pub use address::{page_name, uri_of};
pub use annotations::{Annotation, AnnotationKind, COMPILER, VERDICT, WARNING, annotations, gcc, github};
pub use graders::{classroom, code_runner, gradescope};
pub use junit::junit;
pub use navigation::{in_page_order, with_neighbours};
pub use overview::{Overview, overview};
pub use page::page;
pub(crate) use picture::NAN_COLOUR;
pub use picture::contact_sheet;
pub use sarif::sarif;
pub use similarity::{Fingerprint, SimilarGroup, similar_groups, similar_pairs, similarity};
pub use table::{Row, RowMistake, csv};
pub use text::{is_hidden, points_line, push_visible, visible};
pub use thumbnail::SubmissionThumbnail;
