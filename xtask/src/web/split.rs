//! Splits the module into the functions that run before the first picture, and the rest.
//!
//! A visit of the page in headless Chromium (`web/build/profile.mjs`) records which functions run. A function in the wrong half
//! costs time or bytes and breaks nothing; `web/split` explains why.

use super::{checked, node, read, write};
use crate::process;
use std::path::Path;
use std::process::Command;

/// Splits `module` into itself and `rest`. Without Chromium the module stays whole and no `rest` is written. The original, with
/// its names, is kept as `gonio_bg.before.wasm`.
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

/// Records the profile of a module, which takes half a minute, unless `profile` is up to date already. Returns whether there
/// is a profile.
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
    say("recording which functions the first picture needs");
    let _ = std::fs::remove_file(profile);
    let stage = module.parent().unwrap_or(Path::new("."));
    let page = stage.join("unsplit");
    process::stdout_of(node(web).arg("build/pack.mjs").arg(stage).arg(&page).arg("--plain"))?;
    let output = process::stdout_of(node(web).arg(&script).args([&page, &instrumented]).arg(profile))?;
    output.lines().for_each(|line| say(&format!("  {line}")));
    if !profile.is_file() {
        return Ok(false);
    }
    write(&made_from, &fresh)?;
    Ok(true)
}
