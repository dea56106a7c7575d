//! The same verdict in OpenGL ES 3, which is what a browser has, as in OpenGL.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;
use gonio_lab::check::Checker;
use gonio_lab::verdict::{Outcome, Verdict};
use submissions::{Submission, submissions};

/// Submissions of each exercise and kind: all of them would take minutes.
const OF_EACH: usize = 4;

/// Of each exercise some right ones and some wrong ones, from all over the list.
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

/// What has to be the same: the word, the names, their lines, and for what does not compile the lines of the messages.
#[derive(Debug, PartialEq)]
struct Said {
    verdict: Outcome,
    mistakes: Vec<(String, Option<String>, Option<u32>)>,
    peculiarities: Vec<String>,
    messages: Vec<(String, Option<u32>)>,
}

impl Said {
    fn by(verdict: Verdict) -> Self {
        Said {
            verdict: verdict.verdict,
            mistakes: verdict.mistakes.into_iter().map(|m| (m.id, m.file, m.line)).collect(),
            peculiarities: verdict.peculiarities.into_iter().map(|p| p.id).collect(),
            // What a compiler complains of after its first message is its own affair.
            messages: verdict.messages.into_iter().take(1).map(|m| (m.file, m.line)).collect(),
        }
    }
}

fn said(sample: &[Submission], es: bool) -> Vec<Said> {
    let context = HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
        .unwrap_or_else(|why| panic!("{why}"));
    let mut checker = Checker::new(context.gl());
    sample.iter().map(|submission| Said::by(submission.check(&mut checker))).collect()
}

#[test]
fn verdicts_are_the_same_in_opengl_es() {
    let sample = sample();
    assert!(sample.len() >= 60, "{}", sample.len());
    // Each context is current in a thread of its own.
    let (desktop, embedded) = std::thread::scope(|scope| {
        let desktop = scope.spawn(|| said(&sample, false));
        let embedded = said(&sample, true);
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

#[test]
fn a_loop_without_end_ends_in_a_verdict() {
    let context = HeadlessContext::with_options(&HeadlessOptions { es: true, ..Default::default() })
        .unwrap_or_else(|why| panic!("{why}"));
    let mut checker = Checker::new(context.gl());
    let right =
        submissions("correct").into_iter().find(|submission| submission.name == "ex04/correct/lab-plain").unwrap();
    let endless = |stage: &str, body: &str| {
        let mut files = right.files.clone();
        let file = files.iter_mut().find(|file| file.name.contains(stage)).unwrap();
        let text = String::from_utf8(file.bytes.clone()).unwrap();
        let (head, main) = text.split_once("main").unwrap();
        let (open, rest) = main.split_once('{').unwrap();
        file.bytes = format!("{head}main{open}{{ {body}{rest}").into_bytes();
        Submission { files, name: String::new(), exercise: right.exercise.clone(), expected: toml::Table::new() }
    };
    for stage in ["vert", "frag"] {
        for body in ["while (true) { }", "for (;;) ;", "int i = 0; do { i = 0; } while (i < 1);"] {
            let verdict = endless(stage, body).check(&mut checker);
            assert_eq!(verdict.verdict, Outcome::Unsure, "{stage}: {body}: {}", verdict.summary);
            assert!(verdict.summary.contains("never ends"), "{stage}: {body}: {}", verdict.summary);
        }
        // What ends is no mistake, and is no variable of the student's.
        let verdict = endless(stage, "for (int i = 0; i < 500; i++) { if (i > 400) continue; }").check(&mut checker);
        assert_eq!(verdict.verdict, Outcome::Correct, "{stage}: {}", verdict.summary);
        assert!(verdict.bound.iter().all(|bound| !bound.name.contains("gonio")), "{:?}", verdict.bound);
    }
}
