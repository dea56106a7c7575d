//! The program with its window, and simulated input.

use crate::screen::Screen;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Time limit for a condition. No test depends on the clock; this only ends tests on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);
/// Interval between looks at the state.
const PERIOD: Duration = Duration::from_millis(50);

/// A running window.
pub struct Window {
    program: Child,
    screen: Screen,
    pub folder: tempfile::TempDir,
}

impl Window {
    /// Opens a window that fills a screen of this size, and waits for the first picture.
    pub fn open(width: u32, height: u32, inputs: &[&str]) -> Window {
        Window::open_in(tempfile::tempdir().unwrap(), width, height, inputs)
    }

    /// Opens a window in a folder with files.
    pub fn open_in(folder: tempfile::TempDir, width: u32, height: u32, inputs: &[&str]) -> Window {
        Window::start(folder, [width, height], &["view"], inputs, |_| {}).drawn()
    }

    /// Opens a window of a program whose environment `set` has changed.
    pub fn open_with(width: u32, height: u32, inputs: &[&str], set: impl FnOnce(&mut Command)) -> Window {
        Window::start(tempfile::tempdir().unwrap(), [width, height], &["view"], inputs, set).drawn()
    }

    /// The window when its first picture is there, with the focus.
    fn drawn(self) -> Window {
        let mut window = self;
        // First a preview, then the full picture.
        window.wait("the first picture", |s| s["frame"]["complete"] == true && s["busy"].is_null());
        window.focus();
        window
    }

    /// Opens an exercise in a folder with files: `gonio lab open`.
    pub fn exercise_in(folder: tempfile::TempDir, width: u32, height: u32, arguments: &[&str]) -> Window {
        let mut window = Window::start(folder, [width, height], &["lab", "open"], arguments, |_| {});
        window.wait("the exercise", |s| s["exercise"]["open"] == true && s["exercise"]["id"].is_string());
        window.focus();
        window
    }

    fn start(
        folder: tempfile::TempDir,
        [width, height]: [u32; 2],
        words: &[&str],
        inputs: &[&str],
        set: impl FnOnce(&mut Command),
    ) -> Window {
        let screen = Screen::new([width, height], &[]).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
        command
            .args(words)
            .args(["--state", "state.json", "--size", &format!("{width}x{height}")])
            .args(inputs)
            .current_dir(folder.path())
            .env("DISPLAY", &screen.name)
            .env("XDG_STATE_HOME", folder.path().join("home"))
            // The machine's own dialog programs are not tested.
            .env("PATH", "/nonexistent")
            .env_remove("WAYLAND_DISPLAY")
            .stdin(Stdio::null());
        set(&mut command);
        let program = command.spawn().unwrap();
        Window { program, screen, folder }
    }

    /// Gives the window the keyboard focus, because there is no window manager. The server may show the window later than it draws.
    fn focus(&self) {
        let start = Instant::now();
        while !self.xdotool(&["search", "--onlyvisible", "--name", "^gonio$", "windowfocus"]).status.success() {
            assert!(start.elapsed() < PATIENCE, "the window is not shown");
            std::thread::sleep(PERIOD);
        }
    }

    /// Kills the program (SIGKILL), and returns the folder with everything that it left.
    pub fn kill(mut self) -> tempfile::TempDir {
        self.program.kill().unwrap();
        self.program.wait().unwrap();
        // The next window in this folder writes its own state.
        std::fs::remove_file(self.path("state.json")).unwrap();
        std::mem::replace(&mut self.folder, tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// The state after the last frame.
    pub fn state(&self) -> Value {
        std::fs::read(self.path("state.json"))
            .ok()
            .and_then(|bytes| serde_json::from_slice(&bytes).ok())
            .unwrap_or(Value::Null)
    }

    /// Waits until the state fulfils a condition, and returns it.
    #[track_caller]
    pub fn wait(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        loop {
            let state = self.state();
            if !state.is_null() && expected(&state) {
                return state;
            }
            if let Some(status) = self.program.try_wait().unwrap() {
                panic!("waiting for {what}: the window ended with {status}");
            }
            if start.elapsed() > PATIENCE {
                let mut brief = state;
                brief["scene"] = Value::Null;
                panic!("waited in vain for {what}; the state is {brief:#}");
            }
            std::thread::sleep(PERIOD);
        }
    }

    /// Waits until the window stops painting, and returns the state.
    pub fn rest(&mut self) -> Value {
        let mut before = Value::Null;
        let start = Instant::now();
        loop {
            let state = self.state();
            if !state.is_null() && state["frame"]["frames"] == before["frame"]["frames"] && state["busy"].is_null() {
                return state;
            }
            assert!(start.elapsed() < PATIENCE, "it never rests");
            before = state;
            // Longer than any automatic change: tooltips, menus that fade in, the file watcher.
            std::thread::sleep(Duration::from_secs(2));
        }
    }

    /// The middle of a widget in pixels, as soon as it exists.
    pub fn find(&mut self, id: &str) -> (i64, i64) {
        let ([left, top, width, height], scale) = self.rect(id);
        (((left + width / 2.0) * scale) as i64, ((top + height / 2.0) * scale) as i64)
    }

    /// Left, top, width and height of a widget in points, as soon as it exists, and pixels per point.
    fn rect(&mut self, id: &str) -> ([f64; 4], f64) {
        let of = |state: &Value| state["widgets"].as_array()?.iter().find(|w| w["id"] == id).cloned();
        let state = self.wait(id, |state| of(state).is_some());
        let widget = of(&state).unwrap();
        let side = |index: usize| widget["rect"][index].as_f64().unwrap();
        ([side(0), side(1), side(2), side(3)], state["pixels_per_point"].as_f64().unwrap())
    }

    pub fn click(&mut self, id: &str) {
        let at = self.find(id);
        self.click_at(at);
    }

    /// Clicks near the upper left corner, because the middle of a long line of text is outside the window.
    pub fn click_corner(&mut self, id: &str) {
        let ([left, top, ..], scale) = self.rect(id);
        self.click_at((((left + 60.0) * scale) as i64, ((top + 60.0) * scale) as i64));
    }

    fn click_at(&self, (x, y): (i64, i64)) {
        self.do_it(&["mousemove", &x.to_string(), &y.to_string()]);
        // The widget under the pointer is known one frame later.
        std::thread::sleep(Duration::from_millis(300));
        self.do_it(&["click", "1"]);
    }

    pub fn key(&self, key: &str) {
        self.do_it(&["key", key]);
    }

    pub fn type_text(&self, text: &str) {
        self.do_it(&["type", "--delay", "30", text]);
    }

    /// Runs `xdotool` on this screen; it must succeed.
    pub fn do_it(&self, args: &[&str]) {
        let output = self.xdotool(args);
        assert!(output.status.success(), "xdotool {args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }

    fn xdotool(&self, args: &[&str]) -> Output {
        let output = Command::new("xdotool").args(args).env("DISPLAY", &self.screen.name).output();
        output.unwrap_or_else(|e| panic!("xdotool: {e}; apt-get install xdotool"))
    }

    /// Seconds of processor time that the program has used.
    pub fn cpu_seconds(&self) -> f64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.program.id())).unwrap();
        // After the name in brackets, user and system time are fields 12 and 13, in hundredths of a second.
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap().split_whitespace().collect();
        (fields[11].parse::<f64>().unwrap() + fields[12].parse::<f64>().unwrap()) / 100.0
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// Runs `gonio` with these arguments without this machine's display. Returns exit code and stderr.
pub fn without_display(args: &[&str], display: Option<&str>) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
    command.args(args).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").stdin(Stdio::null());
    if let Some(display) = display {
        command.env("DISPLAY", display);
    }
    let output = command.output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!stderr.contains("panicked"), "{stderr}");
    (output.status.code().unwrap_or(-1), stderr)
}

/// A built-in model, as a file of the repository.
pub fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/models").join(name)
}
