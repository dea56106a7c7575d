//! COLLADA.

#![no_main]

use gonio_fuzz::{Echo, check, limits};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    if let Ok(model) = gonio_mesh::collada::read(data, &mut Echo(data), &limits()) {
        check(model);
    }
});
