//! Counts the tests in the output of `cargo test`.

use crate::report::Findings;

/// The counts of one or more test programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Programs that printed their totals.
    pub programs: usize,
    /// Tests.
    pub passed: usize,
    /// Tests.
    pub failed: usize,
    /// Tests marked `#[ignore]`: not run.
    pub ignored: usize,
}

/// Adds up the lines `test result: ok. 3 passed; 0 failed; 1 ignored; ...`.
pub fn count(text: &str) -> Counts {
    let mut counts = Counts::default();
    for line in text.lines() {
        let Some((_, rest)) = line.split_once("test result: ") else { continue };
        counts.programs += 1;
        let number = |what: &str| {
            let words: Vec<&str> = rest.split([' ', ';', '.']).filter(|w| !w.is_empty()).collect();
            words.windows(2).find(|w| w[1] == what).and_then(|w| w[0].parse::<usize>().ok()).unwrap_or(0)
        };
        counts.passed += number("passed");
        counts.failed += number("failed");
        counts.ignored += number("ignored");
    }
    counts
}

/// Programs named in the report of a run, see [`slowest`].
const NAMED: usize = 8;

/// The test programs that took longest, with their seconds: a run has to end in time, and this is where to look first.
pub fn slowest(text: &str) -> Vec<(String, f64)> {
    let mut all: Vec<(String, f64)> = Vec::new();
    let mut program = String::new();
    for line in text.lines() {
        // `Running tests/lab.rs (target/debug/deps/lab-0123456789abcdef)`
        if let Some((_, path)) = line.trim_start().strip_prefix("Running ").and_then(|rest| rest.split_once(" (")) {
            let file = path.trim_end_matches(')').rsplit(['/', '\\']).next().unwrap_or_default();
            file.rsplit_once('-').map_or(file, |(name, _)| name).clone_into(&mut program);
        }
        let seconds =
            line.rsplit_once("finished in ").and_then(|(_, time)| time.trim().strip_suffix('s')?.parse().ok());
        if let Some(seconds) = seconds.filter(|_| line.contains("test result: ") && !program.is_empty()) {
            all.push((program.clone(), seconds));
        }
    }
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all.truncate(NAMED);
    all
}

/// The findings of a `cargo test` run. A run without any test is a failure.
pub fn findings(success: bool, text: &str) -> Findings {
    let counts = count(text);
    let mut findings = Findings { passed: counts.passed, failed: counts.failed, ..Findings::default() };
    if counts.ignored > 0 {
        findings.remark = format!("{} ignored", counts.ignored);
    }
    let slow: Vec<String> = slowest(text).iter().map(|(name, seconds)| format!("{name} {seconds:.0} s")).collect();
    if !slow.is_empty() {
        findings.details = format!("slowest: {}\n", slow.join(", "));
    }
    if !success && counts.failed == 0 {
        // It did not build, or a test program ended before it printed its totals.
        findings.failed = 1;
    }
    if success && counts.passed == 0 {
        findings.failed = 1;
        findings.details = "no test ran\n".into();
    }
    if findings.failed > 0 {
        findings.details += &without_noise(text);
    }
    findings
}

/// Removes the lines of passed tests and of built packages.
pub fn without_noise(text: &str) -> String {
    let noise = |line: &str| {
        let trimmed = line.trim_start();
        (trimmed.starts_with("test ") && trimmed.ends_with("... ok"))
            || [
                "Compiling ",
                "Checking ",
                "Downloaded ",
                "Downloading ",
                "Documenting ",
                "Blocking ",
                "Fresh ",
                "Locking ",
            ]
            .iter()
            .any(|start| trimmed.starts_with(start) && line.starts_with(' '))
    };
    text.lines().filter(|line| !noise(line)).map(|line| format!("{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "   Compiling a v0.1.0\nrunning 2 tests\ntest a ... ok\ntest b ... ignored\n\n\
        test result: ok. 1 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.00s\n\n\
        running 4 tests\ntest result: ok. 4 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out\n";
    const BAD: &str = "running 2 tests\ntest a ... ok\ntest b ... FAILED\n\n---- b stdout ----\nleft: 1\n\n\
        test result: FAILED. 1 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s\n";

    #[test]
    fn totals_are_added_up() {
        assert_eq!(count(GOOD), Counts { programs: 2, passed: 5, failed: 0, ignored: 1 });
        let found = findings(true, GOOD);
        assert_eq!((found.passed, found.failed, found.remark.as_str()), (5, 0, "1 ignored"));
        assert!(found.details.is_empty());
    }

    #[test]
    fn slow_programs_are_named() {
        let text = "     Running unittests src/lib.rs (target/debug/deps/gonio_light-01ab)\n\
            test result: ok. 2 passed; 0 failed; finished in 1.50s\n\
            \x20    Running tests/lab.rs (target/debug/deps/lab-89ef)\n\
            test result: ok. 3 passed; 0 failed; finished in 20.04s\n";
        assert_eq!(slowest(text), [("lab".to_owned(), 20.04), ("gonio_light".to_owned(), 1.5)]);
        assert_eq!(findings(true, text).details, "slowest: lab 20 s, gonio_light 2 s\n");
    }

    #[test]
    fn failures_are_shown_without_passed_tests() {
        let found = findings(false, &format!("{GOOD}{BAD}"));
        assert_eq!((found.passed, found.failed), (6, 1));
        assert!(found.details.contains("left: 1") && found.details.contains("test b ... FAILED"));
        assert!(!found.details.contains("test a ... ok") && !found.details.contains("Compiling"));
    }

    #[test]
    fn a_run_without_totals_has_failed() {
        let found = findings(false, "error: could not compile\n");
        assert_eq!((found.passed, found.failed, found.details.as_str()), (0, 1, "error: could not compile\n"));
        // One program passed, another crashed.
        assert_eq!(findings(false, GOOD).failed, 1);
    }

    #[test]
    fn a_run_without_tests_has_failed() {
        assert_eq!(findings(true, "").failed, 1);
    }
}
