//! What is done with the program under Wine, and compared with the program for this machine.

use super::wine::Wine;
use crate::cases::{Cases, PNG, Ran, begins_with, ensure, first_page, run};
use crate::process;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The two programs.
pub struct Programs<'p> {
    pub wine: &'p Wine,
    pub windows: &'p Path,
    pub native: &'p Path,
}

/// A window's picture and verdict take less; only a window that never shows them is ended by it.
const PATIENCE: Duration = Duration::from_secs(300);
/// Numbers of the two programs differ by their mathematical libraries' last digits.
const NUMBERS: f64 = 1e-9;

type Check = fn(&Programs) -> Result<(), String>;

/// Every case: what it shows, and its check.
const ALL: &[(&str, Check)] = &[
    ("it needs no libraries but those of Windows", libraries),
    ("the version, and OpenGL by WGL", version),
    ("inspect: the same of a model", inspect),
    ("render: the CPU's picture", |p| same_picture(p, "cpu")),
    ("render: WGL's picture", |p| same_picture(p, "gl")),
    ("render: an existing file is replaced", replaced),
    ("probe: the same numbers", probe),
    ("lab check: a wrong answer, its mistake and line", wrong_answer),
    ("lab check: a right answer", |p| p.gonio(&["lab", "check", "ex04", r"class\block"])?.with_code(0).map(drop)),
    ("lab check: the same of a file with CRLF", wrong_answer_crlf),
    ("lab check: a class", class),
    ("lab check: a driver's context in each of several processes", |p| {
        // With --verbose a second context is made in the first process.
        p.gonio(&["lab", "check", "ex04", "class/block", "--verbose"])?.with_code(0).map(drop)
    }),
    ("spaces, letters beyond ASCII and a drive", spaces),
    ("another drive", other_drive),
    ("OBJ, MTL and TOML with CRLF", crlf_scene),
    ("GLSL with CRLF", crlf_shader),
    ("the sandbox: a path with ..", |p| sandboxed(p, r"sandbox\inside.obj")),
    ("the sandbox: a path with a drive", |p| sandboxed(p, r"sandbox\drive.obj")),
    ("a file that is missing", missing),
    ("a message in French", french),
    ("a page, served", serve),
    ("the window opens and draws", window),
    ("the window checks an exercise after a click", window_checks),
];

/// Runs them.
pub fn all(programs: &Programs, cases: &mut Cases) {
    for (name, check) in ALL {
        cases.case(name, || check(programs));
    }
}

impl Programs<'_> {
    fn gonio(&self, words: &[&str]) -> Result<Ran, String> {
        run(&mut self.wine.gonio(words))
    }

    /// The program for this machine, with the same files.
    fn native(&self, words: &[&str]) -> Result<Ran, String> {
        run(Command::new(self.native).args(words).current_dir(&self.wine.work))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.wine.work.join(name)
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(self.path(name)).map_err(|error| format!("{name}: {error}"))
    }

    /// An error unless both pictures have the same bytes.
    fn same_files(&self, a: &str, b: &str) -> Result<(), String> {
        begins_with(&self.path(a), PNG)?;
        ensure(self.bytes(a)? == self.bytes(b)?, || format!("{a} and {b} differ"))
    }
}

fn libraries(p: &Programs) -> Result<(), String> {
    let list = process::stdout_of(Command::new("x86_64-w64-mingw32-objdump").arg("-p").arg(p.windows))?;
    let names: Vec<&str> = list.lines().filter_map(|line| line.trim().strip_prefix("DLL Name: ")).collect();
    ensure(!names.is_empty(), || "no libraries are listed".into())?;
    let foreign: Vec<&str> = names
        .into_iter()
        // Names of parts of Windows, which its loader knows.
        .filter(|name| !name.starts_with("api-ms-win-") && !p.wine.has_library(name))
        .collect();
    ensure(foreign.is_empty(), || format!("Windows has no {}", foreign.join(", ")))
}

fn version(p: &Programs) -> Result<(), String> {
    let version = format!("gonio {}", env!("CARGO_PKG_VERSION"));
    p.gonio(&["--version"])?.with_code(0)?.printing(&[&version, "OpenGL: ", "llvmpipe"]).map(drop)
}

fn inspect(p: &Programs) -> Result<(), String> {
    let here = p.gonio(&["inspect", r"models\cube.obj", "--json"])?.with_code(0)?.json()?;
    let there = p.native(&["inspect", "models/cube.obj", "--json"])?.with_code(0)?.json()?;
    ensure(here["model"]["contents"].is_array(), || "there are no contents".into())?;
    same(&here["model"]["contents"], &there["model"]["contents"], "contents")
}

fn same_picture(p: &Programs, backend: &str) -> Result<(), String> {
    fn words<'w>(model: &'w str, backend: &'w str, output: &'w str) -> [&'w str; 9] {
        ["render", model, "--backend", backend, "--size", "160x120", "-o", output, "--json"]
    }
    let [windows, native] = [format!("windows-{backend}.png"), format!("native-{backend}.png")];
    let report = p.gonio(&words(r"models\suzanne.obj", backend, &windows))?.with_code(0)?.json()?;
    p.native(&words("models/suzanne.obj", backend, &native))?.with_code(0)?;
    ensure(report["backend"]["name"] == backend, || format!("drawn by {}", report["backend"]))?;
    // One step, as between machines: CONTRIBUTING.md, tolerances.
    p.native(&["diff", &windows, &native, "--max-difference", "1"])?.with_code(0).map(drop)
}

fn replaced(p: &Programs) -> Result<(), String> {
    std::fs::write(p.path("old.png"), "old").map_err(|error| error.to_string())?;
    p.gonio(&["render", "builtin:cube", "--backend", "cpu", "--size", "16x16", "-o", "old.png"])?.with_code(0)?;
    begins_with(&p.path("old.png"), PNG)
}

fn probe(p: &Programs) -> Result<(), String> {
    let words = ["--at", "80,60", "--size", "160x120", "--backend", "cpu", "--json"];
    let here = p.gonio(&[&["probe", r"G:\models\suzanne.obj"], &words[..]].concat())?.with_code(0)?.json()?;
    let there = p.native(&[&["probe", "models/suzanne.obj"], &words[..]].concat())?.with_code(0)?.json()?;
    ensure(here["hit"] == true, || "nothing was hit".into())?;
    same(&here["probe"], &there["probe"], "probe")
}

/// An error unless two values are the same, numbers within their last digits.
fn same(a: &Value, b: &Value, place: &str) -> Result<(), String> {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) if a.len() == b.len() => a
            .iter()
            .try_for_each(|(key, value)| same(value, b.get(key).unwrap_or(&Value::Null), &format!("{place}.{key}"))),
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().try_for_each(|(index, (a, b))| same(a, b, &format!("{place}[{index}]")))
        }
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64().unwrap_or(f64::NAN), y.as_f64().unwrap_or(f64::NAN));
            ensure((x - y).abs() <= NUMBERS * x.abs().max(1.0), || format!("{place}: {x} and {y}"))
        }
        _ => ensure(a == b, || format!("{place}: {a} and {b}")),
    }
}

fn wrong_answer(p: &Programs) -> Result<(), String> {
    let ran = p.gonio(&["lab", "check", "ex04", r"G:\class\absolute"])?.with_code(1)?;
    ran.printing(&["diffuse-absolute", "frag.txt:13"]).map(drop)
}

fn wrong_answer_crlf(p: &Programs) -> Result<(), String> {
    let verdict = |folder: &str| -> Result<Vec<String>, String> {
        let ran = p.gonio(&["lab", "check", "ex04", folder])?.with_code(1)?;
        ran.printing(&["diffuse-absolute"]).map(|ran| ran.out.lines().skip(1).map(str::to_owned).collect())
    };
    let (lf, crlf) = (verdict("class/absolute")?, verdict("class/absolute crlf")?);
    ensure(lf == crlf, || format!("{}\n{}", lf.join("\n"), crlf.join("\n")))
}

fn class(p: &Programs) -> Result<(), String> {
    p.gonio(&["lab", "check", "ex04", r"G:\class", "-o", r"G:\the results"])?.with_code(1)?;
    let folder = p.path("the results");
    let names: Vec<String> = std::fs::read_dir(&folder)
        .map_err(|error| format!("{}: {error}", folder.display()))?
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        .collect();
    let table = names.iter().find(|name| name.ends_with(".csv")).ok_or_else(|| format!("no table among {names:?}"))?;
    let table = std::fs::read_to_string(folder.join(table)).map_err(|error| error.to_string())?;
    let rows = |outcome: &str| table.lines().filter(|line| line.contains(outcome)).count();
    ensure(rows("diffuse-absolute") == 2 && table.lines().count() == 4, || format!("the table is\n{table}"))?;
    ensure(names.iter().any(|name| name == "index.html"), || format!("no overview among {names:?}"))
}

fn spaces(p: &Programs) -> Result<(), String> {
    let folder = p.path("my models, für Übung 4");
    let made = std::fs::create_dir_all(&folder).and_then(|()| {
        std::fs::copy(p.path("models/cube.mtl"), folder.join("cube.mtl"))?;
        std::fs::copy(p.path("models/cube.obj"), folder.join("Würfel 立方体.obj")).map(drop)
    });
    made.map_err(|error| error.to_string())?;
    let (model, output) = (r"G:\my models, für Übung 4\Würfel 立方体.obj", r"G:\my models, für Übung 4\Bild 1.png");
    p.gonio(&["render", model, "--size", "32x32", "-o", output])?.with_code(0)?;
    begins_with(&folder.join("Bild 1.png"), PNG)
}

fn other_drive(p: &Programs) -> Result<(), String> {
    std::fs::create_dir_all(p.wine.drive_c().join("pictures")).map_err(|error| error.to_string())?;
    let words = ["render", r"G:models\cube.obj", "--size", "32x32", "-o", r"C:\pictures\cube.png"];
    p.gonio(&words)?.with_code(0)?;
    begins_with(&p.wine.drive_c().join("pictures/cube.png"), PNG)
}

fn crlf_scene(p: &Programs) -> Result<(), String> {
    for kind in ["lf", "crlf"] {
        let (scene, output) = (format!(r"{kind}\roof.toml"), format!("roof-{kind}.png"));
        let ran = p.gonio(&["render", &scene, "-o", &output])?.with_code(0)?;
        ensure(!ran.err.contains("warning"), || ran.err.clone())?;
    }
    p.same_files("roof-lf.png", "roof-crlf.png")
}

fn crlf_shader(p: &Programs) -> Result<(), String> {
    for kind in ["lf", "crlf"] {
        let (shader, output) = (format!("{kind}/toon.frag"), format!("toon-{kind}.png"));
        let words = ["render", r".\models\suzanne.obj", "--fragment", &shader, "--size", "64x64", "-o", &output];
        p.gonio(&words)?.with_code(0)?;
    }
    p.same_files("toon-lf.png", "toon-crlf.png")
}

fn sandboxed(p: &Programs, model: &str) -> Result<(), String> {
    let words = ["render", model, "--size", "16x16", "-o", "sandbox.png"];
    let open = p.gonio(&words)?.with_code(0)?;
    ensure(!open.err.contains("warning"), || format!("without a sandbox: {}", open.err))?;
    let shut = p.gonio(&[&words[..], &["--sandbox"]].concat())?.with_code(0)?;
    ensure(shut.err.contains("the sandbox forbids"), || format!("with a sandbox: {}", shut.err))
}

fn missing(p: &Programs) -> Result<(), String> {
    let ran = p.gonio(&["inspect", r"G:\models\missing.obj"])?.with_code(2)?;
    ensure(ran.err.contains("there is no such file") && ran.err.lines().count() == 1, || ran.err.clone())
}

fn french(p: &Programs) -> Result<(), String> {
    p.gonio(&["lab", "list", "--language", "fr"])?.with_code(0)?.printing(&["é"]).map(drop)
}

fn serve(p: &Programs) -> Result<(), String> {
    let answer = first_page(&mut p.wine.gonio(&["serve", "--port", "0", "--quiet", "--from", r"G:\page"]))?;
    ensure(answer.starts_with("HTTP/1.1 200") && answer.contains("served by gonio"), || answer.clone())
}

fn window(p: &Programs) -> Result<(), String> {
    let blank = colours(p)?;
    let mut window = Window::open(p, &["view", r"G:\models\suzanne.obj"])?;
    window.wait("a picture", |state| state["frame"]["complete"] == true && state["busy"].is_null())?;
    // The server may show a frame later than it was drawn.
    std::thread::sleep(Duration::from_secs(2));
    let shown = colours(p)?;
    // Panels and text have a hundred colours, and a smoothly lit model some hundred more.
    ensure(blank < 10 && shown > 300, || format!("the screen has {shown} colours, and {blank} without the window"))
}

/// A click starts a check, which runs in a process of its own.
fn window_checks(p: &Programs) -> Result<(), String> {
    p.gonio(&["lab", "start", "ex04", r"G:\my exercise"])?.with_code(0)?;
    let mut window = Window::open(p, &["lab", "open", "ex04", r"G:\my exercise"])?;
    let state = window.wait("the exercise", |state| state["exercise"]["open"] == true)?;
    let widgets = state["widgets"].as_array().cloned().unwrap_or_default();
    let check = widgets.iter().find(|widget| widget["id"] == "check").ok_or("there is no button `check`")?;
    let middle = |axis: usize| {
        let rect = |index: usize| check["rect"][index].as_f64().unwrap_or_default();
        (rect(axis) + rect(axis + 2) / 2.0).to_string()
    };
    let id = shown_window(p)?;
    p.wine.xdotool(&["mousemove", "--window", &id, &middle(0), &middle(1), "click", "1"])?;
    let state = window.wait("the verdict", |state| state["exercise"]["verdict"].is_object())?;
    let verdict = &state["exercise"]["verdict"];
    let named = verdict["mistakes"].as_array().is_some_and(|all| all.iter().any(|id| id == "diffuse-missing"));
    ensure(verdict["word"] == "wrong" && named, || format!("the verdict is {verdict}"))
}

/// A window of gonio, ended when this is dropped.
struct Window {
    program: Child,
    state: PathBuf,
}

impl Window {
    fn open(p: &Programs, words: &[&str]) -> Result<Window, String> {
        let state = p.path("state.json");
        if state.exists() {
            std::fs::remove_file(&state).map_err(|error| error.to_string())?;
        }
        let options = ["--state", r"G:\state.json", "--size", "900x620"];
        let mut command = p.wine.gonio(&[words, &options[..]].concat());
        let program = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        Ok(Window { program: program.map_err(|error| error.to_string())?, state })
    }

    /// Waits until the window's exported state fulfils a condition, and returns it.
    fn wait(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Result<Value, String> {
        let start = Instant::now();
        loop {
            let bytes = std::fs::read(&self.state).unwrap_or_default();
            let state: Value = serde_json::from_slice(&bytes).unwrap_or_default();
            if expected(&state) {
                return Ok(state);
            }
            if let Ok(Some(status)) = self.program.try_wait() {
                return Err(format!("the window ended with {status}"));
            }
            if start.elapsed() > PATIENCE {
                return Err(format!("waited in vain for {what}; the state is {:.500}", state.to_string()));
            }
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// The X server's number of the window, once it shows it: gonio may have drawn, and said so, before.
fn shown_window(p: &Programs) -> Result<String, String> {
    let start = Instant::now();
    loop {
        // xdotool fails while no window matches.
        let ids = p.wine.xdotool(&["search", "--onlyvisible", "--name", "^gonio$"]);
        if let Some(id) = ids.as_ref().ok().and_then(|ids| ids.lines().next()) {
            return Ok(id.to_owned());
        }
        if start.elapsed() > PATIENCE {
            return Err(format!("the window is not shown; xdotool: {ids:?}"));
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// The number of different colours on the screen.
fn colours(p: &Programs) -> Result<usize, String> {
    let picture = p.wine.picture()?;
    Ok(picture.iter().flatten().collect::<BTreeSet<_>>().len())
}
