//! A vertex buffer as a student's program writes it: CSV, JSON or raw floats, compared with the cube.

#![no_main]

use gonio_exercises::buffers::{Expected, compare, read_buffer};
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

static CUBE: LazyLock<Expected> = LazyLock::new(|| {
    let cube = include_bytes!("../../exercises/ex02-object-reader/models/cube.obj");
    Expected::from_obj(cube).expect("the exercise's own cube")
});

fuzz_target!(|data: &[u8]| {
    for name in ["cube.csv", "cube.json", "cube.raw"] {
        if let Ok(buffer) = read_buffer(name, data) {
            compare(&CUBE, &buffer);
        }
    }
});
