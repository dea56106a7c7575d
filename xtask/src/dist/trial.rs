//! Tries an archive as its user would: unpacked into an empty folder, without any environment variable.

use crate::cases::{Cases, PNG, begins_with, empty_folder, ensure, first_page, run};
use crate::process;
use crate::report::Findings;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Libraries that a program for Linux may need to start. OpenGL and windows are loaded when they are used.
const LIBRARIES: &[&str] =
    &["libc.so.6", "libm.so.6", "libgcc_s.so.1", "libdl.so.2", "libpthread.so.0", "ld-linux-x86-64.so.2"];

/// An archive to try instead of building one.
const ARCHIVE_VARIABLE: &str = "GONIO_ARCHIVE";

/// Builds the archive of this machine and tries it. It takes the page that is in `dist/`.
pub fn step(root: &Path) -> Findings {
    let build = || match std::env::var_os(ARCHIVE_VARIABLE) {
        Some(archive) => Ok(root.join(archive)),
        None => super::build(root, &super::Package::read(root)?, &super::host(root)?, &mut |_| {}),
    };
    match build() {
        Ok(archive) => try_archive(root, &archive),
        Err(error) => Findings::fail(error),
    }
}

/// Unpacks and tries an archive for Linux.
pub fn try_archive(root: &Path, archive: &Path) -> Findings {
    let start = Instant::now();
    let folder = crate::target::target_folder(root).join("packages/try");
    let unpacked = empty_folder(&folder).and_then(|()| {
        process::stdout_of(Command::new("tar").arg("-xzf").arg(archive).current_dir(&folder))?;
        let name = archive.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(Unpacked { top: folder.join(name.trim_end_matches(".tar.gz")), root, folder: folder.clone() })
    });
    let unpacked = match unpacked {
        Ok(unpacked) => unpacked,
        Err(error) => return Findings::fail(error),
    };
    let mut cases = Cases::default();
    unpacked.check(&mut cases);
    let seconds = start.elapsed().as_secs_f64();
    let size = std::fs::metadata(archive).map_or(0, |metadata| metadata.len());
    cases.findings().remarking(format!("{:.1} MB; unpacked and tried in {seconds:.0} s", size as f64 / 1e6))
}

struct Unpacked<'r> {
    root: &'r Path,
    /// Where commands run.
    folder: PathBuf,
    /// The folder of the archive.
    top: PathBuf,
}

impl Unpacked<'_> {
    /// The program, without any environment variable.
    fn gonio(&self, words: &[&str]) -> Command {
        let mut command = Command::new(self.top.join("gonio"));
        command.env_clear().current_dir(&self.folder).args(words);
        command
    }

    fn check(&self, cases: &mut Cases) {
        let version = env!("CARGO_PKG_VERSION");
        cases.case("the version, with OpenGL and the page", || {
            let ran = run(&mut self.gonio(&["--version"]))?.with_code(0)?;
            ran.printing(&[&format!("gonio {version}"), "Web page: embedded"]).map(drop)
        });
        cases.case("a picture by the preferred renderer", || {
            run(&mut self.gonio(&["render", "builtin:suzanne", "-o", "suzanne.png"]))?.with_code(0)?;
            begins_with(&self.folder.join("suzanne.png"), PNG)
        });
        cases.case("a picture by the CPU", || {
            let words = ["render", "builtin:cube", "--backend", "cpu", "--size", "64x64", "-o", "cube.png"];
            run(&mut self.gonio(&words))?.with_code(0)?;
            begins_with(&self.folder.join("cube.png"), PNG)
        });
        cases.case("an exercise, solved", || {
            run(&mut self.gonio(&["lab", "reference", "ex04", "-o", "solved"]))?.with_code(0)?;
            run(&mut self.gonio(&["lab", "check", "ex04", "solved"]))?.with_code(0).map(drop)
        });
        cases.case("an exercise, not solved", || {
            run(&mut self.gonio(&["lab", "start", "ex04", "mine"]))?.with_code(0)?;
            run(&mut self.gonio(&["lab", "check", "ex04", "mine"]))?.with_code(1).map(drop)
        });
        cases.case("the page, served", || self.serve());
        cases.case("documents, completions and manual pages", || self.accompanying());
        cases.case("no libraries but those of the system", || self.libraries());
        cases.case("no paths of the machine that built it", || self.paths());
    }

    fn serve(&self) -> Result<(), String> {
        let answer = first_page(&mut self.gonio(&["serve", "--port", "0", "--quiet"]))?;
        let is_page = answer.starts_with("HTTP/1.1 200") && answer.to_ascii_lowercase().contains("<!doctype html>");
        ensure(is_page, || format!("the answer is {answer:.300}"))
    }

    fn accompanying(&self) -> Result<(), String> {
        for (_, name) in super::DOCUMENTS {
            let path = self.top.join(name);
            ensure(std::fs::metadata(&path).is_ok_and(|file| file.len() > 0), || {
                format!("{} is missing", path.display())
            })?;
        }
        begins_with(&self.top.join("man/gonio.1"), b".ie")?;
        begins_with(&self.top.join("man/gonio-lab-check.1"), b".ie")?;
        for (_, name) in super::SHELLS {
            let path = self.top.join("completions").join(name);
            ensure(std::fs::metadata(&path).is_ok_and(|file| file.len() > 0), || {
                format!("{} is missing", path.display())
            })?;
        }
        run(Command::new("bash").arg("-n").arg(self.top.join("completions/gonio.bash")))?.with_code(0).map(drop)
    }

    fn libraries(&self) -> Result<(), String> {
        let list = process::stdout_of(Command::new("objdump").arg("-p").arg(self.top.join("gonio")))?;
        let needed = list.lines().filter_map(|line| line.trim().strip_prefix("NEEDED")).map(str::trim);
        let foreign: Vec<&str> = needed.filter(|library| !LIBRARIES.contains(library)).collect();
        ensure(foreign.is_empty(), || format!("it needs {}", foreign.join(", ")))
    }

    fn paths(&self) -> Result<(), String> {
        let program = std::fs::read(self.top.join("gonio")).map_err(|error| error.to_string())?;
        let home = std::env::home_dir().map(|home| home.join(".cargo"));
        for path in home.iter().map(PathBuf::as_path).chain([self.root]) {
            let text = path.to_string_lossy().into_owned();
            let bytes = text.as_bytes();
            // "/.cargo" and the like are in every program.
            let is_telling = bytes.len() > "/.cargo".len();
            let found = is_telling && program.windows(bytes.len()).any(|window| window == bytes);
            ensure(!found, || format!("the program contains {text}"))?;
        }
        Ok(())
    }
}
