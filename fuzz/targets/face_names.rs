//! File names, one per line, of which six are assigned to faces.

#![no_main]

use gonio_environment::names::{assign, assign_with, siblings};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let names: Vec<&str> = text.lines().take(64).collect();
    if let Ok(assignment) = assign(&names) {
        let mut files = assignment.files.to_vec();
        files.sort_unstable();
        files.dedup();
        assert_eq!(files.len(), 6);
        assert!(files.iter().all(|i| *i < names.len()));
    }
    for name in names.iter().take(4) {
        let _ = assign_with(&names, name);
        for set in siblings(name) {
            // A set made from a name is found again, unless its names are ambiguous.
            if let Ok(assignment) = assign(&set) {
                assert!(assignment.files.iter().all(|i| *i < 6));
            }
        }
    }
});
