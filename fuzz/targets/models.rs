//! The readers of models: one source for the targets `obj`, `mtl`, `gltf`, `collada`, `ply`, `stl`, `medit`, `any` and
//! `explain`, which Cargo compiles once for each of these names.

#![no_main]

use gonio_fuzz::{Echo, check, limits};
use gonio_mesh::{Format, Model, collada, compression, explain, gltf, medit, mtl, obj, ply, stl};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| match env!("CARGO_BIN_NAME") {
    "mtl" => check(Model { materials: mtl::read(data).0, ..Model::default() }),
    "explain" => explain_line(data),
    target => check_model(target, data),
});

/// Explains a single line of OBJ and MTL, whose number is the first byte.
fn explain_line(data: &[u8]) {
    let Some((&line, text)) = data.split_first() else { return };
    let _ = explain::line(text, u64::from(line));
    let _ = explain::mtl_line(text, u64::from(line));
}

fn check_model(target: &str, data: &[u8]) {
    let read = match target {
        // Its material library is in the same bytes.
        "obj" => obj::read(data, &mut Echo(data), &limits()),
        "gltf" => gltf::read(data, &mut Echo(data), &limits()),
        "collada" => collada::read(data, &mut Echo(data), &limits()),
        "ply" => ply::read(data, &mut Echo(data), &limits()),
        "stl" => stl::read(data, &mut Echo(data), &limits()),
        "medit" => medit::read(data, &mut Echo(data), &limits()),
        "any" => return read_any(data).into_iter().for_each(check),
        unknown => unreachable!("{unknown} in fuzz/Cargo.toml"),
    };
    if let Ok(model) = read {
        check(model);
    }
}

/// Reads a model of the format that its content shows, compressed or not.
fn read_any(data: &[u8]) -> Option<Model> {
    let unpacked = compression::unpack(data, &limits()).ok()?;
    let content = unpacked.as_deref().unwrap_or(data);
    Format::detect(content, "").ok()?.read(content, &mut Echo(content), &limits()).ok()
}
