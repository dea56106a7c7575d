//! Verdicts are the same in OpenGL ES 3, which browsers have, as in OpenGL; loops without end give a verdict in both.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::ShaderChecker;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;
use submissions::{Submission, submissions};

/// Number of submissions of each exercise and kind: all of them would take minutes.
const OF_EACH: usize = 4;

/// Returns some right and some wrong submissions of each exercise, spread over the list.
fn sample() -> Vec<Submission> {
    let mut sample = Vec::new();
    for kind in ["correct", "wrong"] {
        let mut all = submissions(kind);
        let mut exercises: Vec<String> = all.iter().map(|submission| submission.exercise.clone()).collect();
        exercises.dedup();
        for exercise in exercises {
            let (mut of_it, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|s| s.exercise == exercise);
            let step = (of_it.len() / OF_EACH).max(1);
            of_it.truncate(step * OF_EACH);
            sample.extend(of_it.into_iter().step_by(step));
            all = others;
        }
    }
    sample
}

/// The parts of a verdict that must be the same: outcome, mistakes with their lines, and for shaders that do not
/// compile the lines of the messages.
#[derive(Debug, PartialEq)]
struct Essentials {
    verdict: Outcome,
    mistakes: Vec<(String, Option<String>, Option<u32>)>,
    peculiarities: Vec<String>,
    messages: Vec<(String, Option<u32>)>,
}

impl Essentials {
    fn by(verdict: Verdict) -> Self {
        Essentials {
            verdict: verdict.verdict,
            mistakes: verdict.mistakes.into_iter().map(|m| (m.id, m.file, m.line)).collect(),
            peculiarities: verdict.peculiarities.into_iter().map(|p| p.id).collect(),
            // Compilers differ in the messages after the first.
            messages: verdict.messages.into_iter().take(1).map(|m| (m.file, m.line)).collect(),
        }
    }
}

fn essentials(sample: &[Submission], es: bool) -> Vec<Essentials> {
    let context = HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
        .unwrap_or_else(|error| panic!("{error}"));
    let mut checker = ShaderChecker::new(context.gl());
    sample.iter().map(|submission| Essentials::by(submission.check(&mut checker))).collect()
}

#[test]
fn verdicts_are_the_same_in_opengl_es() {
    let sample = sample();
    assert!(sample.len() >= 60, "{}", sample.len());
    // Each context is current in its own thread.
    let (desktop, embedded) = std::thread::scope(|scope| {
        let desktop = scope.spawn(|| essentials(&sample, false));
        let embedded = essentials(&sample, true);
        (desktop.join().unwrap(), embedded)
    });
    let differ: Vec<String> = sample
        .iter()
        .zip(desktop.iter().zip(&embedded))
        .filter(|(_, (desktop, embedded))| desktop != embedded)
        .map(|(submission, (desktop, embedded))| format!("{}\n  {desktop:?}\n  {embedded:?}", submission.name))
        .collect();
    assert!(differ.is_empty(), "{} of {}:\n{}", differ.len(), sample.len(), differ.join("\n"));
}

/// Returns the right answer of exercise 04 with more text: `globals` before `main` and `body` at its start, in one
/// stage.
fn changed(stage: &str, globals: &str, body: &str) -> Submission {
    let right =
        submissions("correct").into_iter().find(|submission| submission.name == "ex04/correct/lab-plain").unwrap();
    let mut files = right.files;
    let file = files.iter_mut().find(|file| file.name.contains(stage)).unwrap();
    let text = String::from_utf8(file.bytes.clone()).unwrap();
    let (head, main) = text.split_once("void main").unwrap();
    let (open, rest) = main.split_once('{').unwrap();
    file.bytes = format!("{head}{globals}\nvoid main{open}{{ {body}{rest}").into_bytes();
    Submission { files, name: String::new(), exercise: right.exercise, expected: toml::Table::new() }
}

/// Loops that never end: the text before `main`, and the text in it.
const ENDLESS: &[(&str, &str)] = &[
    ("", "while (true) { }"),
    ("", "for (;;) ;"),
    ("", "int i = 0; do { i = 0; } while (i < 1);"),
    ("", "for (int i = 0; i < 10; i++) i--;"),
    ("", "for (int i = 0; ; i++) if (i < 0) break;"),
    ("", "int i = 0; while (i < 10) { if (i > 20) return; }"),
    ("void spin() { while (true) { } }", "spin();"),
    ("uniform float unset;", "for (float x = 0.0; x < 1.0; x += unset) { }"),
    ("", "for (int i = 0; i < 4; i++) { int j = 0; while (j < 4) { for (int k = 0; k < 4; k++) { } } }"),
    ("#define FOREVER for (;;) { }", "FOREVER"),
];

/// Loops that end and change nothing.
const ENDING: &[(&str, &str)] = &[
    ("", "for (int i = 0; i < 500; i++) { if (i > 400) continue; }"),
    ("", "int i = 0; while (i < 20000) i++;"),
    ("", "int n = 0; for (int i = 0; i < 20000; i++) n += i; if (n == 1) return;"),
    (
        "int f(int n) { int s = 0; for (int i = 0; i < n; i++) s += i; return s; }",
        "if (f(9999) + f(9999) == 1) return;",
    ),
];

fn check_endless_and_ending_loops(es: bool) {
    let context = HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
        .unwrap_or_else(|error| panic!("{error}"));
    let mut checker = ShaderChecker::new(context.gl());
    let of_fragments = [
        ("", "if (gl_FragCoord.x < 9.0 && gl_FragCoord.y < 20.0) while (true) { }"),
        ("", "while (true) { } discard;"),
        ("", "while (true) { if (gl_FragCoord.x < -1.0) discard; }"),
    ];
    let of_vertices = [("", "if (gl_VertexID % 50 == 7) while (true) { }")];
    for (stage, more) in [("vert", &of_vertices[..]), ("frag", &of_fragments[..])] {
        for (globals, body) in ENDLESS.iter().chain(more) {
            let verdict = changed(stage, globals, body).check(&mut checker);
            assert_eq!(verdict.verdict, Outcome::Unsure, "{stage}: {body}: {}", verdict.summary);
            assert!(verdict.summary.contains("never ends"), "{stage}: {body}: {}", verdict.summary);
        }
        // Loops that end are not mistakes, and add no variables to the verdict.
        for (globals, body) in ENDING {
            let verdict = changed(stage, globals, body).check(&mut checker);
            assert_eq!(verdict.verdict, Outcome::Correct, "{stage}: {body}: {}", verdict.summary);
            assert!(verdict.bound.iter().all(|bound| !bound.name.contains("gonio")), "{:?}", verdict.bound);
        }
    }
}

#[test]
fn endless_loops_give_a_verdict_in_opengl() {
    check_endless_and_ending_loops(false);
}

#[test]
fn endless_loops_give_a_verdict_in_opengl_es() {
    check_endless_and_ending_loops(true);
}
