//! MTL.

#![no_main]

use gonio_fuzz::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let (materials, _) = gonio_mesh::mtl::read(data);
    check(gonio_mesh::Model { materials, ..gonio_mesh::Model::default() });
});
