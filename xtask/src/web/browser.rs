//! Tests the page in a browser with Node's test runner.

use super::sizes::{MOST_BYTES, MOST_MODULE_BYTES, MOST_START_BYTES};
use super::{Build, build_page, node};
use crate::process;
use crate::report::Findings;
use crate::target::{build_program, debug_program};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// How long all tests of the page may take where nothing else runs. CI would otherwise wait for one that hangs until its own limit,
/// and report nothing.
const LIMIT: Duration = Duration::from_secs(25 * 60);

/// Builds the page. Also fails if a first visit would load too much.
pub fn build(root: &Path, build: Build) -> Findings {
    match build_page(root, build, &mut |_| {}) {
        Ok(sizes) => {
            let bytes = sizes.first_visit();
            let (module, start) = (sizes.first_module(), sizes.start());
            let most = [MOST_BYTES, MOST_MODULE_BYTES, MOST_START_BYTES].map(|most| most / 1000);
            let remark = format!(
                "{} kB (brotli) until the first picture, at most {}; {} kB of them draw it, at most {}; {} kB until the \
                 application runs, at most {}",
                bytes.div_ceil(1000),
                most[0],
                module.div_ceil(1000),
                most[1],
                start.div_ceil(1000),
                most[2]
            );
            let is_small = bytes <= MOST_BYTES && module <= MOST_MODULE_BYTES && start <= MOST_START_BYTES;
            // The development build is never small.
            if build == Build::Shipped && !is_small {
                let advice = "web/build/weigh.mjs shows where the bytes of a module go";
                return Findings::fail(format!("a first visit loads too much; {advice}\n{}", sizes.table()))
                    .remarking(remark);
            }
            Findings::pass().remarking(remark)
        }
        Err(error) => Findings::fail(error),
    }
}

/// A build of the page that runs while the tests do.
pub struct BackgroundBuild(Option<std::process::Child>);

/// Starts building the page with the lowest priority: tests leave a core idle for part of the time, and link-time optimisation
/// of the module uses one. `build` then finds everything built. A failure here is not reported, because `build` repeats it.
pub fn build_in_background() -> BackgroundBuild {
    let program = std::env::current_exe().ok().filter(|_| cfg!(unix));
    let child = program.and_then(|program| {
        let mut command = Command::new("nice");
        command.args(["-n", "19"]).arg(program).arg("web");
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok()
    });
    BackgroundBuild(child)
}

impl BackgroundBuild {
    /// Waits until the build has ended.
    pub fn wait(self) {
        if let Some(mut child) = self.0 {
            // Its exit code does not matter: `build` reports failures.
            let _ = child.wait();
        }
    }
}

/// Runs the tests in `web/tests` on the page in `dist`, served by gonio itself. `program_is_built`: the workspace's tests
/// were built, and the program with them.
pub fn test(root: &Path, program_is_built: bool) -> Findings {
    let program = if program_is_built { Ok(debug_program(root)) } else { build_program(root) };
    let program = match program {
        Ok(program) => program,
        Err(error) => return Findings::fail(error),
    };
    let web = root.join("web");
    let mut command = node(&web);
    command.args(["--test-reporter=tap", "tests/all.mjs"]).env("GONIO_PROGRAM", &program);
    let outcome = process::run_within(&mut command, LIMIT);
    findings(outcome.success, &outcome.text)
}

/// Reads the totals (`# pass 3` and so on) that Node's test runner prints last (TAP, version 13).
fn findings(success: bool, text: &str) -> Findings {
    let number = |what: &str| {
        let start = format!("# {what} ");
        text.lines().rev().find_map(|line| line.strip_prefix(&start)?.trim().parse::<usize>().ok()).unwrap_or(0)
    };
    let mut findings = Findings { passed: number("pass"), failed: number("fail"), ..Findings::default() };
    // None of these passed, so none may go unnoticed.
    findings.failed += number("cancelled") + number("skipped") + number("todo");
    if findings.failed == 0 && (!success || findings.passed == 0) {
        findings.failed = 1;
    }
    if findings.failed > 0 {
        findings.details =
            text.lines().filter(|line| !line.starts_with("ok ")).map(|line| format!("{line}\n")).collect();
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOTALS: &str =
        "TAP version 13\nok 1 - opens\n1..2\n# tests 2\n# pass 2\n# fail 0\n# cancelled 0\n# skipped 0\n";

    #[test]
    fn tests_of_node_are_counted() {
        let found = findings(true, TOTALS);
        assert_eq!((found.passed, found.failed), (2, 0));
        let text = TOTALS.replace("pass 2", "pass 1").replace("fail 0", "fail 1");
        let found = findings(false, &format!("not ok 2 - closes\n{text}"));
        assert_eq!((found.passed, found.failed), (1, 1));
        assert!(found.details.contains("not ok 2 - closes") && !found.details.contains("ok 1 - opens"));
    }

    #[test]
    fn tests_that_did_not_run_have_failed() {
        assert_eq!(findings(true, &TOTALS.replace("skipped 0", "skipped 1")).failed, 1);
        assert_eq!(findings(true, &TOTALS.replace("cancelled 0", "cancelled 1")).failed, 1);
        assert_eq!(findings(false, "cannot run `node`\n").failed, 1);
        assert_eq!(findings(true, "# pass 0\n").failed, 1);
    }
}
