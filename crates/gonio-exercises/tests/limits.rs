//! Shaders that are too large or too deep for a driver give a verdict with a line, and never reach the driver.
#![allow(clippy::unwrap_used)]

#[path = "../../gonio-glsl/tests/hostile/mod.rs"]
mod hostile;

use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Outcome;
use gonio_exercises::Checker;
use gonio_exercises::exercise;
use gonio_exercises::preview::SubmittedPair;
use gonio_gl::HeadlessContext;

fn files(pair: &hostile::Pair) -> Vec<SourceFile> {
    vec![SourceFile::new("a.vert", pair.vertex.clone()), SourceFile::new("a.frag", pair.fragment.clone())]
}

#[test]
fn shaders_that_are_too_large_give_a_verdict_and_no_crash() {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let mut checker = Checker::new(context.gl());
    let exercise = exercise::find("ex04").unwrap();
    let mut refused = 0;
    for pair in hostile::pairs().iter().filter(|pair| pair.limit.is_some()) {
        let (verdict, _) =
            gonio_exercises::check(&mut checker, exercise, files(pair), &CheckOptions::default(), Feedback::Fix)
                .unwrap();
        assert_eq!(verdict.verdict, Outcome::DoesNotCompile, "{}: {}", pair.name, verdict.summary);
        assert!(verdict.messages[0].line.is_some_and(|line| line > 1), "{}: {:?}", pair.name, verdict.messages[0]);
        assert!(verdict.summary.starts_with("a.") && verdict.summary.lines().count() == 1, "{}", verdict.summary);
        // A live preview does not pass it to the driver either.
        let source = SubmittedPair::gather(exercise, files(pair)).unwrap();
        assert!(source.compile(context.gl()).is_err_and(|notes| !notes.is_empty()), "{}", pair.name);
        refused += 1;
    }
    assert!(refused >= 50, "{refused}");
}

#[test]
fn deep_shaders_within_the_limits_are_checked_on_a_thread_of_their_own() {
    let names = [
        "a sum of 240 terms",
        "240 parentheses",
        "240 calls within calls",
        "240 unary minus",
        "240 braces",
        "240 else ifs",
        "240 swizzles",
        "200 functions that call each other",
    ];
    // This thread has a stack of 2 MiB, the default of threads.
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let mut checker = Checker::new(context.gl());
    let exercise = exercise::find("ex04").unwrap();
    for name in names {
        let pair = hostile::pairs().into_iter().find(|pair| pair.name == name).unwrap();
        let (verdict, _) =
            gonio_exercises::check(&mut checker, exercise, files(&pair), &CheckOptions::default(), Feedback::Fix)
                .unwrap();
        assert_eq!(verdict.verdict, Outcome::Wrong, "{name}: {}", verdict.summary);
    }
}
