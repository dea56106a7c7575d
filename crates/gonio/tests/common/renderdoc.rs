//! Reads captures through RenderDoc's own Python module, in an X server of its own.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;

/// Two X servers that start at once may choose the same display.
static DISPLAY: Mutex<()> = Mutex::new(());

/// The packages of Debian that reading runs.
pub const INSTALL: &str = "apt-get install -y --no-install-recommends librenderdoc python3-renderdoc xvfb xauth";
/// Debian's Python, for which RenderDoc's module is built.
const PYTHON: &str = "/usr/bin/python3";

#[track_caller]
fn require(program: &str, args: &[&str]) {
    let outcome = Command::new(program).args(args).stdin(Stdio::null()).output();
    let works = outcome.as_ref().is_ok_and(|o| o.status.success());
    assert!(works, "`{program} {}` does not run, and this test needs it: {INSTALL}\n{outcome:?}", args.join(" "));
}

/// The content of a capture as JSON: `capture.py` says how.
#[track_caller]
pub fn read(capture: &Path) -> Value {
    require("xvfb-run", &["--help"]);
    require("xauth", &["-V"]);
    require(PYTHON, &["-c", "import renderdoc"]);
    let _display = DISPLAY.lock();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/capture.py");
    let folder = tempfile::tempdir().unwrap();
    let facts = folder.path().join("facts.json");
    let run = Command::new("xvfb-run").args(["-a", PYTHON]).args([&script, capture, &facts]).output().unwrap();
    let message = [run.stdout, run.stderr].map(|s| String::from_utf8_lossy(&s).into_owned()).concat();
    assert!(run.status.success(), "RenderDoc does not open {}: {message}", capture.display());
    serde_json::from_slice(&std::fs::read(&facts).unwrap()).unwrap()
}
