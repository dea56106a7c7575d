//! Built-in functions and variables, each with the versions that have it.

mod functions;
mod variables;

pub(crate) use functions::{Signature, exists, is_name, signatures};
pub(crate) use variables::{variable, variable_names};
