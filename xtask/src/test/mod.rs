//! `cargo xtask test`: runs the steps in an order that lets later steps reuse earlier builds.

mod cargo_output;
mod publish;
pub mod python;
mod windows;

use crate::checks::{dependencies, lints, source, text, translations, workflows};
use crate::dist::trial;
use crate::report::{Findings, Report};
use crate::web::Build;
use crate::web::browser::{self, BackgroundBuild, Tests};
use crate::{editors, house as figures, licenses, process, root, score, setup};
use std::path::Path;
use std::process::ExitCode;

/// The extent of a test run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Also what takes too long for CI: more tests of the page, the checker's score, other platforms, Windows under Wine, the Python
    /// package, the archive that users get, the crates to publish, and the dependencies against `deny.toml`.
    All,
    /// Everything that CI runs.
    Continuous,
    /// Without the page, installing nothing.
    Fast,
    /// Only the rules that no compiler enforces.
    House,
    /// Only the web page, in a browser.
    Web(Build),
    /// Only one of the steps that [`Extent::All`] adds.
    Only(Extra),
}

/// A step that takes too long for CI.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extra {
    /// The program for Windows, under Wine.
    Windows,
    /// The archive that users get.
    Archive,
    /// The crates to publish.
    Crates,
    /// The Python package.
    Python,
}

impl Extra {
    /// Each with its word on the command line.
    const ALL: [(&str, Extra); 4] = [
        ("windows", Extra::Windows),
        ("archive", Extra::Archive),
        ("crates", Extra::Crates),
        ("python", Extra::Python),
    ];

    /// The step of a word.
    pub fn named(word: &str) -> Option<Extra> {
        Extra::ALL.iter().find(|(name, _)| *name == word).map(|(_, extra)| *extra)
    }

    fn run(self, report: &mut Report, root: &Path) {
        match self {
            Extra::Windows => report.step("Windows, under Wine", || windows::step(root)),
            // With the page that is in `dist`.
            Extra::Archive => report.step("release archive", || trial::step(root)),
            Extra::Crates => report.step("crates to publish", || publish::step(root)),
            Extra::Python => report.step("Python package", || python::step(root)),
        };
    }
}

/// Desktop platforms that are compiled but not run, which needs no linker.
const DESKTOPS: &[&str] = &["x86_64-pc-windows-msvc", "aarch64-apple-darwin", "x86_64-apple-darwin"];
/// The repository's own tools, which are not built for other platforms.
const NOT_SHIPPED: &[&str] = &["xtask", "gonio-bench", "gonio-web-bindgen"];

/// Runs every step, also after one has failed.
pub fn run(extent: Extent) -> ExitCode {
    let root = root();
    let mut report = Report::default();
    if matches!(extent, Extent::All | Extent::Continuous) {
        report.step("system packages", setup::packages);
        report.step("toolchain", || setup::toolchain(&root, &[setup::WASM]));
    }
    match extent {
        Extent::Web(build) => page(&mut report, &root, build, Tests::All, Built::default()),
        Extent::House => house(&mut report, &root),
        Extent::Only(extra) => extra.run(&mut report, &root),
        Extent::Fast => {
            house(&mut report, &root);
            cargo_steps(&mut report, &root, extent);
        }
        Extent::All | Extent::Continuous => {
            house(&mut report, &root);
            let built = cargo_steps(&mut report, &root, extent);
            let tests = if extent == Extent::All { Tests::All } else { Tests::Continuous };
            page(&mut report, &root, Build::Shipped, tests, built);
            if extent == Extent::All {
                Extra::Archive.run(&mut report, &root);
            }
        }
    }
    print!("\n{}", report.summary());
    if report.failed > 0 { ExitCode::from(1) } else { ExitCode::SUCCESS }
}

/// What the cargo steps have built.
#[derive(Default)]
struct Built {
    /// Whether the tests, and with them every program, were built.
    tests: bool,
    /// The page's build, which may go on.
    page: Option<BackgroundBuild>,
}

/// Builds the page and tests it in a browser.
fn page(report: &mut Report, root: &Path, build: Build, tests: Tests, built: Built) {
    if report.step("web page, build", || browser::build(root, build, built.page)) {
        report.step("web page, in Chromium", || browser::test(root, tests, built.tests));
    } else {
        report.step("web page, in Chromium", || Findings::fail("not run, because the page was not built"));
    }
}

/// The cargo steps. The page is built beside them, once the tests are.
fn cargo_steps(report: &mut Report, root: &Path, extent: Extent) -> Built {
    report.step("rustfmt", || cargo_check(root, &["fmt", "--all", "--check"], &[]));
    report.step("clippy", || {
        let arguments = ["clippy", "--locked", "--workspace", "--all-targets", "--", "-D", "warnings"];
        cargo_check(root, &arguments, &[])
    });
    report.step("rustdoc", || {
        cargo_check(root, &["doc", "--locked", "--workspace", "--no-deps"], &[("RUSTDOCFLAGS", "-D warnings")])
    });
    let built = report.step("build of the tests", || {
        cargo_check(root, &["test", "--locked", "--workspace", "--all-targets", "--no-run"], &[])
    });
    let page = (built && extent != Extent::Fast).then(browser::build_in_background);
    if built {
        report.step("tests", || cargo_test(root));
        // The tests of the corpus judge the same submissions, one by one.
        if extent == Extent::All {
            report.step("checker, score", || score::check(root));
        }
        report.step("checker, generated", || score::check_generated(root));
        // It installs packages.
        if extent != Extent::Fast {
            report.step("extension for VS Code", || editors::test(root));
        }
    } else {
        report.step("tests", || Findings::fail("not run, because the tests did not build"));
    }
    if extent == Extent::All {
        report.step("toolchain, other platforms", || setup::toolchain(root, DESKTOPS));
        report.step("licences and duplicates", || check_dependencies(root));
        for target in DESKTOPS {
            report.step(target, || check_desktop(root, target));
        }
        Extra::Windows.run(report, root);
        Extra::Python.run(report, root);
        Extra::Crates.run(report, root);
    }
    Built { tests: built, page }
}

/// The rules that no compiler enforces, and figures about the code base.
fn house(report: &mut Report, root: &Path) {
    report.step("dependencies point one way", || {
        let metadata = process::stdout_of(process::cargo(root).args([
            "metadata",
            "--locked",
            "--no-deps",
            "--format-version",
            "1",
        ]));
        match metadata.and_then(|json| dependencies::read_metadata(&json)) {
            Ok((crates, edges)) => Findings::of_complaints(&dependencies::check(
                &crates,
                &edges,
                dependencies::RULES,
                dependencies::GUARDED,
            )),
            Err(error) => Findings::fail(error),
        }
    });
    let files = match source::text_files(root) {
        Ok(files) => files,
        Err(error) => {
            report.step("files of the repository", || Findings::fail(error));
            return;
        }
    };
    report.step("lints are allowed where declared", || {
        let mut complaints = lints::check(&files, lints::GUARDED, lints::CONFIGURATIONS);
        complaints.extend(lints::check_manifests(&files));
        Findings::of_complaints(&complaints)
    });
    report.step("unsafe blocks", || figures::check_unsafe(&files));
    report.step("tracked files", || figures::check_tracked(root));
    report.step("import cycles", || figures::check_cycles(&files));
    report.step("length of files", || figures::check_length(&files));
    report.step("one meaning per word", || figures::check_words(&files));
    report.step("examples are tests", || Findings::of_complaints(&text::check_examples(&files)));
    report.step("texts have uses", || Findings::of_complaints(&translations::check(&files)));
    report.step("third-party notices", || licenses::step(root));
    report.step("workflows are pinned", || Findings::of_complaints(&workflows::check(&files)));
    report.step("no machine's paths", || Findings::of_complaints(&text::check_paths(&files)));
}

/// Runs a cargo command that passes or fails as a whole.
fn cargo_check(root: &Path, arguments: &[&str], variables: &[(&str, &str)]) -> Findings {
    let outcome = process::run(process::cargo(root).args(arguments).envs(variables.iter().copied()));
    if outcome.success { Findings::pass() } else { Findings::fail(cargo_output::without_noise(&outcome.text)) }
}

/// Runs all tests. There are no doc tests, see `checks::examples`.
fn cargo_test(root: &Path) -> Findings {
    let arguments = ["test", "--locked", "--workspace", "--no-fail-fast", "--all-targets"];
    let outcome = process::run(process::cargo(root).args(arguments));
    cargo_output::findings(outcome.success, &outcome.text)
}

/// Compares the dependencies with `deny.toml`. Advisories need a database from the network: `cargo deny check advisories`.
fn check_dependencies(root: &Path) -> Findings {
    if let Err(error) = setup::cargo_deny(root) {
        return Findings::fail(error);
    }
    cargo_check(root, &["deny", "--locked", "--log-level", "warn", "check", "bans", "licenses", "sources"], &[])
        .remarking("advisories: `cargo deny check advisories`")
}

fn check_desktop(root: &Path, target: &str) -> Findings {
    let mut arguments = vec!["check", "--locked", "--workspace", "--target", target];
    for krate in NOT_SHIPPED {
        arguments.extend(["--exclude", krate]);
    }
    cargo_check(root, &arguments, &[])
}
