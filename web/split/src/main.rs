//! Splits a WebAssembly module in two: the functions that ran in a profile, and the rest, which may be loaded later.
//!
//! ```text
//! gonio-web-split instrument MODULE OUT               OUT records which functions run (see `instrument`)
//! gonio-web-split split MODULE PROFILE PRIMARY REST   PROFILE: OUT's record, `1` or `0` for each function
//! ```
//!
//! PRIMARY is MODULE without the functions that did not run. Calls of those go through slots of the function table. Each slot
//! first contains a stub, which calls the imported function `rest.load` and then calls through the slot again. Instantiating
//! REST puts the functions into the slots. REST has no state of its own: PRIMARY exports its memory, table and globals to it.
//!
//! binaryen's `wasm-split` does the same, but npm's binaryen does not contain it, and its stubs call JavaScript with a name for
//! each function.

mod instrument;
mod plan;
mod primary;
mod rest;

use std::process::ExitCode;
use walrus::{FunctionId, Module, ModuleConfig};

/// The name of the module from which REST imports PRIMARY's exports.
const PRIMARY: &str = "primary";
/// The import of PRIMARY: a module and its function, which returns when REST is instantiated, or throws.
const LOAD: (&str, &str) = ("rest", "load");

const USAGE: &str = "usage: gonio-web-split instrument MODULE OUT
       gonio-web-split split MODULE PROFILE PRIMARY REST";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["instrument", module, out] => read(module).and_then(|bytes| write(out, &instrument::instrument(&bytes)?)),
        ["split", module, profile, primary, rest] => files(module, profile, primary, rest),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("gonio-web-split: {error}");
            ExitCode::from(2)
        }
    }
}

fn files(module: &str, profile: &str, primary: &str, rest: &str) -> Result<(), String> {
    let ran = String::from_utf8_lossy(&read(profile)?).trim().to_owned();
    let halves = split(&read(module)?, &ran)?;
    write(primary, &halves.primary)?;
    write(rest, &halves.rest)
}

/// The halves of a module.
struct Halves {
    primary: Vec<u8>,
    rest: Vec<u8>,
}

/// Splits a module. `ran` has a `1` for each of the module's own functions that goes into the primary half and a `0` for each
/// other, in the order of the file.
fn split(bytes: &[u8], ran: &str) -> Result<Halves, String> {
    // Read twice, because each half is made by removal. The n-th function is the same in both.
    let mut primary = parse(bytes)?;
    let mut rest = parse(bytes)?;
    let plan = plan::Plan::new(&primary, ran)?;
    let needed = rest::reduce(&mut rest, &plan)?;
    primary::reduce(&mut primary, &plan, &needed)?;
    Ok(Halves { primary: primary.emit_wasm(), rest: rest.emit_wasm() })
}

/// Reads a module with its names, by which wasm-opt groups related functions before it removes them.
fn parse(bytes: &[u8]) -> Result<Module, String> {
    let mut config = ModuleConfig::new();
    config.generate_name_section(true).generate_producers_section(false);
    config.parse(bytes).map_err(|e| format!("the module cannot be read: {e:#}"))
}

/// The functions that are not imported, in the order of the file.
fn own_functions(module: &Module) -> Vec<FunctionId> {
    module.funcs.iter_local().map(|(id, _)| id).collect()
}

fn read(path: &str) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|e| format!("cannot read {path}: {e}"))
}

fn write(path: &str, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {path}: {e}"))
}
