//! Courses: a folder with a teacher's own exercises, a measurement of how well the checker judges them, and packages for the
//! graders of learning platforms.
//!
//! | module | content |
//! |---|---|
//! | [`course`] | `course.toml` and the folders of exercises, read from files in memory |
//! | [`template`] | a course to start from |
//! | [`verify`] | mistakes and rewrites made from a reference, and what the checker says about them |
//! | [`package`] | files for Gradescope, CodeRunner, Moodle, GitHub Classroom and Docker |
//!
//! It opens and writes no file.
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod course;
pub mod package;
pub mod template;
pub mod verify;

pub use course::{Course, CourseExercise, CourseFile};
