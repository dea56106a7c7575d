//! The laboratory: exercises, students' own files as they are, and a checker that names the mistake.
