//! The report of a test run: one line per step, the full output of failures, and the totals.

use std::io::Write;
use std::time::{Duration, Instant};

/// The result of one step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    /// Tests or checks that passed.
    pub passed: usize,
    /// Tests or checks that failed.
    pub failed: usize,
    /// Shown in brackets on the step's line.
    pub remark: String,
    /// Shown below the step's line.
    pub details: String,
}

impl Findings {
    /// One check that passed.
    pub fn pass() -> Self {
        Findings { passed: 1, ..Findings::default() }
    }

    /// One check that failed, with its full output.
    pub fn fail(details: impl Into<String>) -> Self {
        Findings { failed: 1, details: details.into(), ..Findings::default() }
    }

    /// One check, which passed if there are no complaints.
    pub fn of_complaints(complaints: &[String]) -> Self {
        if complaints.is_empty() { Findings::pass() } else { Findings::fail(complaints.join("\n")) }
    }

    /// Adds a remark.
    pub fn remarking(mut self, remark: impl Into<String>) -> Self {
        self.remark = remark.into();
        self
    }
}

/// The steps that have run.
#[derive(Default)]
pub struct Report {
    /// Over all steps.
    pub passed: usize,
    /// Over all steps.
    pub failed: usize,
    failed_steps: Vec<String>,
}

impl Report {
    /// Runs a step and prints its line. Returns whether it passed.
    pub fn step(&mut self, name: &str, run: impl FnOnce() -> Findings) -> bool {
        print!("{name:<28} ");
        // Show the step's name while it runs; the next print reports a closed stdout.
        let _ = std::io::stdout().flush();
        let start = Instant::now();
        let findings = run();
        println!("{}", line(&findings, start.elapsed()));
        if !findings.details.is_empty() {
            for line in findings.details.trim_end().lines() {
                println!("    {line}");
            }
        }
        self.passed += findings.passed;
        self.failed += findings.failed;
        if findings.failed > 0 {
            self.failed_steps.push(name.to_owned());
        }
        findings.failed == 0
    }

    /// The last lines of a run: the steps that failed, then the totals on a line of their own.
    pub fn summary(&self) -> String {
        let mut text = String::new();
        if !self.failed_steps.is_empty() {
            text += &format!("failed: {}\n", self.failed_steps.join(", "));
        }
        text + &format!("{} passed, {} failed\n", self.passed, self.failed)
    }
}

fn line(findings: &Findings, time: Duration) -> String {
    let verdict = if findings.failed > 0 { "FAILED" } else { "ok" };
    let mut remarks = Vec::new();
    if findings.passed + findings.failed != 1 {
        remarks.push(format!("{} passed, {} failed", findings.passed, findings.failed));
    }
    if !findings.remark.is_empty() {
        remarks.push(findings.remark.clone());
    }
    let remarks = if remarks.is_empty() { String::new() } else { format!("  ({})", remarks.join("; ")) };
    format!("{verdict:<6} {:>7.1} s{remarks}", time.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_totals_stand_alone_on_the_last_line() {
        let mut report = Report::default();
        assert!(report.step("one", Findings::pass));
        assert!(!report.step("two", || Findings { passed: 3, failed: 2, ..Findings::default() }));
        assert_eq!(report.summary(), "failed: two\n4 passed, 2 failed\n");
    }

    #[test]
    fn complaints_make_a_failure() {
        assert_eq!(Findings::of_complaints(&[]).failed, 0);
        let findings = Findings::of_complaints(&["a".into(), "b".into()]);
        assert_eq!((findings.passed, findings.failed, findings.details.as_str()), (0, 1, "a\nb"));
    }

    #[test]
    fn a_line_says_verdict_time_and_counts() {
        let time = Duration::from_millis(1250);
        assert_eq!(line(&Findings::pass(), time), "ok         1.2 s");
        let many = Findings { passed: 7, failed: 1, ..Findings::default() }.remarking("2 ignored");
        assert_eq!(line(&many, time), "FAILED     1.2 s  (7 passed, 1 failed; 2 ignored)");
    }
}
