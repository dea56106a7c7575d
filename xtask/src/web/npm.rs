//! Installs the Node packages that build, test and measure the page, as locked.

use super::checked;
use std::path::Path;
use std::process::Command;

/// Runs `npm ci` in `web/` unless the packages of the lock file are installed.
pub fn install(web: &Path, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let lock = web.join("package-lock.json");
    let wanted = std::fs::read(&lock).map_err(|e| format!("cannot read {}: {e}", lock.display()))?;
    // Written last, so an interrupted installation is repeated.
    let stamp = web.join("node_modules/.gonio-installed");
    if std::fs::read(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(());
    }
    say("installing Node packages (npm ci)");
    // None of the packages needs its install script.
    checked(Command::new("npm").current_dir(web).args(["ci", "--ignore-scripts", "--no-fund", "--no-audit"]))?;
    std::fs::write(&stamp, wanted).map_err(|e| format!("cannot write {}: {e}", stamp.display()))
}
