//! Functions in files: .brdf of BRDF Explorer, GLSL, fits, MERL tables. Whatever loads has values, and is written and read
//! again.

#![no_main]

use gonio_bsdf::sampling::direction;
use gonio_bsdf::NamedBsdf;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for name in ["a.brdf", "a.glsl", "a.toml", "a.binary"] {
        let Ok(named) = NamedBsdf::of_file(name, data, "") else { continue };
        let _ = named.bsdf.evaluate(direction(0.5, 0.0), direction(0.3, 2.0));
        if let Some(text) = named.to_brdf() {
            // A shader may contain what ends its section; everything else is read again.
            let _ = NamedBsdf::of_file("a.brdf", text.as_bytes(), "");
        }
        let _ = named.to_glsl();
    }
});
