//! GL programs, right and wrong, really carried out on whatever driver there is.

mod broken;
mod execution;
mod exercise;
mod hostile;
mod reader;
mod right;
mod support;
mod words;
