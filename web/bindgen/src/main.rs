//! `gonio-web-bindgen MODULE.wasm FOLDER NAME`: writes `NAME.js` and `NAME_bg.wasm` into the folder.
//!
//! The same as `wasm-bindgen --target web`, at the version of the lock file. `cargo xtask web` runs it.

use std::path::PathBuf;
use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [module, folder, name] = arguments.as_slice() else {
        eprintln!("usage: gonio-web-bindgen MODULE.wasm FOLDER NAME");
        return ExitCode::from(2);
    };
    let written = Bindgen::new().input_path(module).web(true).and_then(|bindgen| {
        // The page passes the module's address, because its name contains a hash.
        bindgen.out_name(&name.to_string_lossy()).typescript(false).omit_default_module_path(true).generate(folder)
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("gonio-web-bindgen: {}: {error:#}", module.display());
            ExitCode::from(2)
        }
    }
}
