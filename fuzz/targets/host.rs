//! A host program's calls as text. They are read, not carried out: that is OpenGL's part, with guards of its own.

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
