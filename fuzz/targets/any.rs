//! Whatever the content says it is, compressed or not.

#![no_main]

use gonio_fuzz::{Echo, check, limits};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let unpacked = match gonio_mesh::compression::unpack(data, &limits()) {
        Ok(unpacked) => unpacked,
        Err(_) => return,
    };
    let content = unpacked.as_deref().unwrap_or(data);
    if let Ok(format) = gonio_mesh::Format::detect(content, "")
        && let Ok(model) = format.read(content, &mut Echo(content), &limits())
    {
        check(model);
    }
});
