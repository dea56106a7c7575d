//! GLSL, parsed, checked and translated for both targets. Every span is within the text.

#![no_main]

use gonio_glsl::{OutputVersion, Stage, check, check_pair, leaves, parse, translate};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let both = [Stage::Vertex, Stage::Fragment].map(|stage| {
        let mut parsed = parse(text);
        let checked = check(&mut parsed, stage);
        for target in [OutputVersion::Core330, OutputVersion::Es300] {
            let translated = translate(&parsed, &checked, target);
            assert!(!translated.text.is_empty());
        }
        for problem in parsed.problems.iter().chain(&checked.problems) {
            assert!(text.get(problem.span.start as usize..problem.span.end as usize).is_some());
        }
        let _ = leaves(&checked.interface);
        checked
    });
    let _ = check_pair(&both[0], &both[1]);
});
