//! Single lines of OBJ and MTL, explained.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((&line, text)) = data.split_first() else { return };
    let _ = gonio_mesh::explain::line(text, u64::from(line));
    let _ = gonio_mesh::explain::mtl_line(text, u64::from(line));
});
