//! A host program's calls as text. They are parsed but not executed.

#![no_main]

use gonio_exercises::gl_program::GlProgram;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| match GlProgram::parse_bytes(data, "host.txt") {
    Ok(program) => {
        for line in 0..64 {
            program.quoted(line);
        }
    }
    Err(errors) => assert!(!errors.is_empty()),
});
