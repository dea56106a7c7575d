//! `gonio lab trial`, the process that tries shaders for the window: its answers for shaders of every kind.
#![allow(clippy::unwrap_used, missing_docs)]

use gonio_app::platform::desktop::trial;
use gonio_app::platform::{CheckRequest, Pending, TrialOutcome};
use gonio_exercises::exercise;
use std::path::Path;
use std::time::Duration;

/// The window's result for the reference solution of exercise 04, with `change` in place of the fragment shader's `void main() {`.
fn outcome(change: &str) -> TrialOutcome {
    let exercise = exercise::find("ex04").unwrap();
    let text = |(name, text): (&str, &str)| {
        let text = if name.ends_with(".frag") { text.replacen("void main() {", change, 1) } else { text.to_owned() };
        (name.to_owned(), text.into_bytes())
    };
    let files = exercise.reference_files().map(text).collect();
    let request = CheckRequest { exercise: "ex04".into(), files, as_the_lab: false };
    let mut process = trial::begin(Path::new(env!("CARGO_BIN_EXE_gonio")), &request, || ()).unwrap();
    loop {
        if let Some(outcome) = process.poll() {
            return outcome;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn what_compiles_and_what_does_not_is_harmless() {
    for change in [
        "void main() {",
        "void main() { int i; for (i = 0; i < 16; ++i) { }",
        "void mian() {",
        "void main( {",
        "#error no\nvoid main() {",
    ] {
        assert_eq!(outcome(change), TrialOutcome::Harmless, "{change}");
    }
}

/// What crashes a reader or a driver, or takes all memory, on some machine: the process comes back with a sentence, or with
/// the word that the compiler refuses it.
#[test]
fn hostile_texts_end_with_a_sentence() {
    let long = format!("void main() {{ float x = 1.0{};", "+0.0".repeat(40_000));
    let deep = format!("void main() {{ float x = {}1.0{};", "(".repeat(50_000), ")".repeat(50_000));
    let doubling: String = (1..40).map(|n| format!("#define M{n} M{} M{}\n", n - 1, n - 1)).collect();
    let macros = format!("#define M0 x += 1.0;\n{doubling}void main() {{ float x = 0.0; M39");
    let array = "void main() { int a[2147483647]; a[int(gl_FragCoord.x)] = 1;";
    let endless = "void main() { float z = 1.0; while (z > 0.0) { z += 1e-9; }";
    for text in [&long, &deep, &macros, array, endless] {
        match outcome(text) {
            TrialOutcome::Harmless => {}
            TrialOutcome::Refused(why) => {
                assert!(why.contains("the window does not draw it") && !why.contains('\n'), "{why}");
            }
            TrialOutcome::Unavailable(why) => panic!("{:.60}: {why}", text),
        }
    }
}

/// A loop that ends, but not soon: at the size of a window it would hold up everything.
#[test]
fn a_shader_that_would_hold_up_the_window_is_refused() {
    let slow =
        "void main() { float z = gl_FragCoord.x; for (int i = 0; i < 60000; ++i) { z = fract(sin(z) * 43758.5); }
        if (z > 2.0) discard;";
    let TrialOutcome::Refused(why) = outcome(slow) else { panic!("it counts as harmless") };
    assert!(why.contains("seconds"), "{why}");
}

#[test]
fn without_files_or_with_a_damaged_list_of_them_it_is_an_error() {
    for input in [&b""[..], b"\x01\0\0\0", b"\xff\xff\xff\xff"] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_gonio"));
        let mut child = command
            .args(["lab", "trial", "ex04"])
            .stdin(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        std::io::Write::write_all(&mut child.stdin.take().unwrap(), input).unwrap();
        let output = child.wait_with_output().unwrap();
        let words = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2));
        assert!(words.starts_with("error: ") && words.lines().count() == 1, "{words}");
    }
}
