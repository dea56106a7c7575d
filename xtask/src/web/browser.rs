//! Tests the page in a browser with Node's test runner.

use super::sizes::{MOST_BYTES, MOST_MODULE_BYTES, MOST_START_BYTES, Sizes};
use super::{Build, build_page, node, sizes_file};
use crate::process;
use crate::report::Findings;
use crate::target::{build_program, debug_program};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The tests of the page to run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Tests {
    /// Those that CI has the time for.
    Continuous,
    /// Every one.
    All,
}

impl Tests {
    /// The file in `web/tests` that imports them.
    fn file(self) -> &'static str {
        match self {
            Tests::Continuous => "continuous.mjs",
            Tests::All => "all.mjs",
        }
    }

    /// How long they may take where nothing else runs. CI would otherwise wait for one that hangs until its own limit, and report
    /// nothing.
    fn limit(self) -> Duration {
        let minutes = match self {
            Tests::Continuous => 25,
            Tests::All => 45,
        };
        Duration::from_secs(minutes * 60)
    }
}

/// Builds the page, or waits for its build in the background. Also fails if a first visit would load too much.
pub fn build(root: &Path, build: Build, background: Option<BackgroundBuild>) -> Findings {
    let built = background.and_then(|background| background.wait(root));
    match built.map_or_else(|| build_page(root, build, &mut |_| {}), Ok) {
        Ok(sizes) => weighed(&sizes, build),
        Err(error) => Findings::fail(error),
    }
}

fn weighed(sizes: &Sizes, build: Build) -> Findings {
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
        return Findings::fail(format!("a first visit loads too much; {advice}\n{}", sizes.table())).remarking(remark);
    }
    Findings::pass().remarking(remark)
}

/// A build of the page that runs while the tests do.
pub struct BackgroundBuild(Option<std::process::Child>);

/// Starts building the page with the lowest priority: tests leave a core idle for part of the time, and link-time optimisation
/// of the module uses one. A failure here is not reported, because `build` repeats it.
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
    /// Waits until the build has ended. Returns nothing if it failed.
    fn wait(self, root: &Path) -> Option<Sizes> {
        let status = self.0?.wait().ok()?;
        let written = status.success().then(|| std::fs::read_to_string(sizes_file(root)).ok())??;
        Sizes::read(&written).ok()
    }
}

/// Runs tests in `web/tests` on the page in `dist`, served by gonio itself. `program_is_built`: the workspace's tests
/// were built, and the program with them.
pub fn test(root: &Path, tests: Tests, program_is_built: bool) -> Findings {
    let program = if program_is_built { Ok(debug_program(root)) } else { build_program(root) };
    let program = match program {
        Ok(program) => program,
        Err(error) => return Findings::fail(error),
    };
    let web = root.join("web");
    let mut command = node(&web);
    command.arg("--test-reporter=tap").arg(format!("tests/{}", tests.file())).env("GONIO_PROGRAM", &program);
    let outcome = process::run_within(&mut command, tests.limit());
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
    fn every_file_of_tests_is_imported_once() {
        let folder = crate::root().join("web/tests");
        let imported: Vec<String> = [Tests::All, Tests::Continuous]
            .into_iter()
            .flat_map(|tests| {
                let text = std::fs::read_to_string(folder.join(tests.file())).expect("a file of web/tests");
                let names = text.lines().filter_map(|line| line.strip_prefix("import \"./")?.strip_suffix("\";"));
                names.map(str::to_owned).collect::<Vec<_>>()
            })
            .collect();
        assert!(imported.iter().any(|name| name == Tests::Continuous.file()), "{imported:?}");
        for entry in std::fs::read_dir(&folder).expect("web/tests") {
            let name = entry.expect("an entry").file_name().into_string().expect("a name in Unicode");
            let times = imported.iter().filter(|known| **known == name).count();
            assert_eq!(times, usize::from(name.ends_with(".test.mjs") || name == Tests::Continuous.file()), "{name}");
        }
    }

    #[test]
    fn tests_that_did_not_run_have_failed() {
        assert_eq!(findings(true, &TOTALS.replace("skipped 0", "skipped 1")).failed, 1);
        assert_eq!(findings(true, &TOTALS.replace("cancelled 0", "cancelled 1")).failed, 1);
        assert_eq!(findings(false, "cannot run `node`\n").failed, 1);
        assert_eq!(findings(true, "# pass 0\n").failed, 1);
    }
}
