//! The packages of Node that build, test and measure the page, as the lock file has them.

use super::checked;
use std::path::Path;
use std::process::Command;

/// Runs `npm ci` in `web/` where what is installed is not what the lock file says.
pub fn install(web: &Path, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let lock = web.join("package-lock.json");
    let wanted = std::fs::read(&lock).map_err(|e| format!("cannot read {}: {e}", lock.display()))?;
    // Written last, so that an installation that broke off is begun anew.
    let stamp = web.join("node_modules/.gonio-installed");
    if std::fs::read(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(());
    }
    say("installing what the page is built with (npm ci)");
    // No package of ours wants to run a script when it is installed.
    checked(Command::new("npm").current_dir(web).args(["ci", "--ignore-scripts", "--no-fund", "--no-audit"]))?;
    std::fs::write(&stamp, wanted).map_err(|e| format!("cannot write {}: {e}", stamp.display()))
}
