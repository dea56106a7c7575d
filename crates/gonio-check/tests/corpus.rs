//! Students' submissions, each with what is right or wrong about it: crates/gonio-check/corpus.
//!
//! The tolerances are the project's sixth issue's: no false alarm at all, single mistakes 97 %, pairs 85 %.
#![allow(clippy::unwrap_used)]

mod submissions;

use gonio_check::ShaderChecker;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_fixtures::selected;
use gonio_gl::HeadlessContext;
use submissions::{Submission, submissions};

/// The words of a list in `expected.toml`.
fn list(submission: &Submission, key: &str) -> Vec<String> {
    let words = submission.expected.get(key).and_then(toml::Value::as_array).cloned().unwrap_or_default();
    words.iter().map(|word| word.as_str().unwrap().to_owned()).collect()
}

fn checker() -> (HeadlessContext, ShaderChecker) {
    let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
    let checker = ShaderChecker::new(context.gl());
    (context, checker)
}

#[test]
fn what_is_right_is_never_called_wrong() {
    let (_context, mut checker) = checker();
    let all = submissions("correct");
    assert!(all.len() > 160, "{}", all.len());
    for submission in selected(all, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        assert_eq!(verdict.verdict, Outcome::Correct, "{}: {}", submission.name, verdict.summary);
    }
}

/// Whether the names are those expected, or ones that no picture tells from them.
fn is_named(submission: &Submission, verdict: &Verdict) -> bool {
    let (wanted, also) = (list(submission, "mistakes"), list(submission, "also_right"));
    let answers = |want: &String| {
        verdict.mistakes.iter().any(|found| found.id == *want || found.or.contains(want) || also.contains(&found.id))
    };
    verdict.mistakes.len() == wanted.len() && wanted.iter().all(answers)
}

#[test]
fn mistakes_are_named() {
    let (_context, mut checker) = checker();
    let (mut single, mut pairs, mut called) = ((0, 0), (0, 0), (0, 0));
    let mut missed = Vec::new();
    let all = submissions("wrong");
    let compiling: Vec<&Submission> = all.iter().filter(|s| s.expected.get("verdict").is_none()).collect();
    let pairs_found = compiling.iter().filter(|s| list(s, "mistakes").len() > 1).count();
    assert!(pairs_found > 30 && compiling.len() - pairs_found > 310, "{pairs_found} pairs of {}", compiling.len());
    for submission in selected(all, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        let does_not_compile = submission.expected.get("verdict").is_some();
        let wanted = if does_not_compile { Outcome::DoesNotCompile } else { Outcome::Wrong };
        called = (called.0 + usize::from(verdict.verdict == wanted), called.1 + 1);
        if does_not_compile {
            continue;
        }
        let count = if list(&submission, "mistakes").len() > 1 { &mut pairs } else { &mut single };
        let named = is_named(&submission, &verdict);
        *count = (count.0 + usize::from(named), count.1 + 1);
        if !named {
            let found: Vec<&str> = verdict.mistakes.iter().map(|found| found.id.as_str()).collect();
            missed.push(format!("{}: {:?} {found:?}", submission.name, verdict.verdict));
        }
    }
    let reaches = |least: f64, (right, all): (usize, usize)| right as f64 >= least * all as f64;
    let told = format!("single {single:?}, pairs {pairs:?}, verdicts {called:?}\n{}", missed.join("\n"));
    assert!(reaches(0.95, called), "{told}");
    assert!(reaches(0.97, single), "{told}");
    assert!(reaches(0.85, pairs), "{told}");
}

#[test]
fn what_does_not_compile_is_told_at_its_line() {
    let (_context, mut checker) = checker();
    let (mut right, mut all) = (0, 0);
    let mut missed = Vec::new();
    let broken: Vec<Submission> =
        submissions("wrong").into_iter().filter(|s| s.expected.get("verdict").is_some()).collect();
    assert!(broken.len() >= 15, "{}", broken.len());
    for submission in selected(broken, |submission| &submission.name) {
        let verdict = submission.check(&mut checker);
        let line = |key: &str| submission.expected.get(key).and_then(toml::Value::as_integer);
        let told: Vec<i64> = verdict.messages.iter().filter_map(|m| m.line).map(i64::from).collect();
        let is_right = line("line").or(line("reported_line")).is_none()
            || [line("line"), line("reported_line")].into_iter().flatten().any(|line| told.contains(&line));
        all += 1;
        right += usize::from(is_right);
        if !is_right {
            missed.push(format!("{}: {told:?} {}", submission.name, verdict.summary));
        }
    }
    assert!(right * 100 >= all * 85, "{right} of {all}\n{}", missed.join("\n"));
}
