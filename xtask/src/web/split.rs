//! The module in two: what runs until the first picture is shown, and the rest, which comes after it.
//!
//! What runs is found out by visiting the page in headless Chromium (`web/build/profile.mjs`). That a function is in the
//! wrong half costs time or bytes and breaks nothing: `web/split` says how.

use super::{checked, node, read, write};
use crate::process;
use std::path::Path;
use std::process::Command;

/// Splits `module`, as wasm-bindgen left it, into itself and `rest`. Leaves it whole, and writes no rest, where there is no
/// Chromium to visit the page with. As it was, with its names, it stays beside: `gonio_bg.before.wasm`.
pub fn split(web: &Path, splitter: &Path, module: &Path, rest: &Path, say: &mut dyn FnMut(&str)) -> Result<(), String> {
    let whole = module.with_extension("before.wasm");
    write(&whole, &read(module)?)?;
    let profile = module.with_extension("ran.txt");
    if !profiled(web, splitter, module, &profile, say)? {
        return Ok(());
    }
    say("splitting the module in two");
    checked(Command::new(splitter).arg("split").args([&whole, &profile]).args([module, rest]))
}

/// Makes sure that `profile` is of this module. Gives whether it is; it takes half a minute, and what it was made from is
/// kept beside it.
fn profiled(
    web: &Path,
    splitter: &Path,
    module: &Path,
    profile: &Path,
    say: &mut dyn FnMut(&str),
) -> Result<bool, String> {
    let script = web.join("build/profile.mjs");
    let instrumented = module.with_extension("instrumented.wasm");
    checked(Command::new(splitter).arg("instrument").args([module, &instrumented]))?;
    let made_from = module.with_extension("ran.from");
    let visits = [script.clone(), web.join("bench/model.mjs")];
    let visits: Vec<Vec<u8>> = visits.iter().map(|file| read(file)).collect::<Result<_, _>>()?;
    let fresh = [read(&instrumented)?, visits.concat()].concat();
    if profile.is_file() && std::fs::read(&made_from).is_ok_and(|bytes| bytes == fresh) {
        return Ok(true);
    }
    say("visiting the page, to see what its first picture needs");
    let _ = std::fs::remove_file(profile);
    let stage = module.parent().unwrap_or(Path::new("."));
    let page = stage.join("unsplit");
    process::stdout_of(node(web).arg("build/pack.mjs").arg(stage).arg(&page).arg("--plain"))?;
    let said = process::stdout_of(node(web).arg(&script).args([&page, &instrumented]).arg(profile))?;
    said.lines().for_each(|line| say(&format!("  {line}")));
    if !profile.is_file() {
        return Ok(false);
    }
    write(&made_from, &fresh)?;
    Ok(true)
}
