//! Generated hostile submissions. Whatever they contain, the program ends by itself within its limits of time and memory, never
//! calls a wrong answer correct, prints its own verdict only, leaves no process behind, and does not change its input.
#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]
#![cfg(target_os = "linux")]

mod case;
#[path = "../common/mod.rs"]
mod common;
mod forging;
mod intake;
mod resources;
mod runner;

use case::Case;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Families run one after the other; together they would exceed each other's time limits.
static TURN: Mutex<()> = Mutex::new(());

/// Runs all cases of a family, one per core at a time. `GONIO_HOSTILE` selects cases by a part of their names.
fn held(cases: &[Case], at_least: usize) {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    assert!(cases.len() >= at_least, "{} cases", cases.len());
    let selection = std::env::var("GONIO_HOSTILE").unwrap_or_default();
    let cases: Vec<&Case> = cases.iter().filter(|case| case.name.contains(&selection)).collect();
    assert!(!cases.is_empty(), "no case is called `{selection}`");
    let (next, reports) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let report = runner::run(case);
                    reports.lock().unwrap().push(report);
                }
            });
        }
    });
    let reports = reports.into_inner().unwrap();
    for report in &reports {
        let mark = if report.faults.is_empty() { "held" } else { "FAILED" };
        let (seconds, megabytes) = (report.seconds, report.most_kb / 1024);
        println!("{mark:6} {:46} {seconds:6.1} s {megabytes:5} MB  {}", report.name, report.outcome);
    }
    let failed: Vec<String> = reports
        .iter()
        .filter(|report| !report.faults.is_empty())
        .map(|report| format!("{}\n    {}", report.name, report.faults.join("\n    ")))
        .collect();
    assert!(failed.is_empty(), "{} of {} failed:\n{}", failed.len(), reports.len(), failed.join("\n"));
}

#[test]
fn nesting_does_not_exhaust_the_stack() {
    held(&resources::stack(), 30);
}

#[test]
fn no_text_exhausts_the_memory() {
    held(&resources::memory(), 30);
}

#[test]
fn endless_programs_are_stopped() {
    held(&resources::time(), 15);
}

#[test]
fn no_verdict_is_forged() {
    held(&forging::cases(), 30);
}

#[test]
fn every_submission_is_checked_or_rejected() {
    held(&intake::cases(), 50);
}
