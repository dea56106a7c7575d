//! Other programs that draw the same model: the f3d wheel and a VTK script, in a virtual environment below `target/`.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The installed packages, pinned so that ratios of different days can be compared.
const PACKAGES: &[&str] = &["f3d==4.0.0", "vtk==9.7.2"];

/// Another program that draws a model.
pub struct Peer {
    /// The name in tables.
    pub name: &'static str,
    script: &'static str,
    python: PathBuf,
}

impl Peer {
    /// Returns the command that draws `model` to `out`.
    pub fn command(&self, model: &Path, out: &Path, width: u32, height: u32) -> Command {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers").join(self.script);
        let mut command = Command::new(&self.python);
        command.arg(script).arg(model).arg(out).arg(width.to_string()).arg(height.to_string());
        command
    }
}

/// Returns both, installed on first use.
pub fn install(folder: &Path) -> Result<Vec<Peer>, String> {
    let python = python_with(folder, "venv", PACKAGES)?;
    let peer = |name, script| Peer { name, script, python: python.clone() };
    Ok(vec![peer("f3d 4.0 (Python API)", "f3d_render.py"), peer("VTK 9.7 (script)", "vtk_render.py")])
}

/// Returns Python with packages, in a virtual environment called `venv` in the folder; installed on first use.
pub fn python_with(folder: &Path, venv: &str, packages: &[&str]) -> Result<PathBuf, String> {
    let venv = folder.join(venv);
    let bin = if cfg!(windows) { "Scripts" } else { "bin" };
    let python = venv.join(bin).join(if cfg!(windows) { "python.exe" } else { "python" });
    let wanted = packages.join("\n");
    let stamp = venv.join("gonio-installed.txt");
    if std::fs::read_to_string(&stamp).ok().as_deref() != Some(wanted.as_str()) {
        println!("installing {} into {}", packages.join(" and "), venv.display());
        if !python.exists() {
            run(Command::new("python3").args(["-m", "venv"]).arg(&venv))
                .map_err(|e| format!("{e}\nthe other programs need Python: install python3 python3-venv"))?;
        }
        run(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(packages))?;
        std::fs::write(&stamp, wanted).map_err(|e| format!("cannot write {}: {e}", stamp.display()))?;
    }
    Ok(python)
}

fn run(command: &mut Command) -> Result<(), String> {
    let output = command.output().map_err(|e| format!("cannot run {}: {e}", command.get_program().display()))?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    Err(format!("{} failed: {text}", command.get_program().display()))
}
