//! What every panel is made of: numbers, vectors, colours, choices, switches.
//!
//! Each notes itself ([`crate::exported::note`]) under a stable id, tells screen readers what it is called, and goes back
//! to its default by a double click. They edit the document in place: undo needs no word from them.

mod button;
mod choice;
mod color;
mod digits;
mod number;
mod row;
mod vector;

pub use button::{icon_button, toggle, tool_button};
pub(crate) use choice::named_options;
pub use choice::{choice, dropdown, slug};
pub use color::{color, color_swatch, shown};
pub use digits::{NO_BREAK, SPACE, grouped};
pub use number::{Number, compact};
pub use row::{LABEL_WIDTH, heading, row};
pub use vector::{Vector, axes};
