//! What CI runs, anyone can run: `cargo xtask help`.

mod bench;
mod checks;
mod fuzz;
mod process;
mod report;
mod score;
mod setup;
mod test;
mod web;

use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
cargo xtask test             everything that CI runs; needs nothing but rustup and a C compiler to start from
cargo xtask test --fast      the same without the other platforms and without installing anything
cargo xtask test --house     only the rules of the house that no compiler knows: a second
cargo xtask test --web [--dev]
                             only the web page: builds it and tries it in headless Chromium
cargo xtask bench [NAME...]  measures; all of them without a name
    render                   a 5,000-triangle model to a PNG, whole process, against f3d and a VTK script
    render-large             the same of 1 million triangles
    frame                    a frame of 1 million triangles against the barest OpenGL loop
    lights                   the cost of a light, from 1 to 1,000 of them
    obj                      reading OBJ files of 1 and 5 million triangles, against tobj and others
    environment              a panorama into a cubemap, against OpenCV and ffmpeg
    window                   dragging a light in the lab window, against the renderer alone; wants Xvfb
cargo xtask bench web        the page in headless Chromium against a page of three.js: first frame, memory
cargo xtask fuzz [TARGET...] [--minutes N]
                             made-up files for every reader, 20 minutes each; wants cargo-fuzz and nightly
cargo xtask web [--dev]      builds the web page into dist and says how large it is; wants node and npm
cargo xtask schema           brings assets/scene.schema.json up to date with the code
cargo xtask score            measures the laboratory's checker, and writes its table into exercises/README.md
cargo xtask help             this text

Exit code: 0 done, 1 a check failed, 2 error.
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["test"] => test::run(test::Extent::Everything),
        ["test", "--fast"] => test::run(test::Extent::Fast),
        ["test", "--house"] => test::run(test::Extent::House),
        ["test", "--web"] => test::run(test::Extent::Web(web::Build::Shipped)),
        ["test", "--web", "--dev"] => test::run(test::Extent::Web(web::Build::Dev)),
        ["bench", "web"] => bench::web(),
        ["bench", names @ ..] => bench::run(names),
        ["fuzz", words @ ..] => fuzz::run(words),
        ["web", words @ ..] => web::run(words),
        ["schema"] => schema(),
        ["score"] => score::run(),
        [] | ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("xtask: `{}` is no task of mine\n\n{HELP}", words.join(" "));
            ExitCode::from(2)
        }
    }
}

/// The top of the repository.
fn root() -> PathBuf {
    // This crate's folder is known when it is built, and it always lies one below the top.
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).parent().map(PathBuf::from).unwrap_or_default()
}

fn schema() -> ExitCode {
    let file = root().join("assets/scene.schema.json");
    let mut gonio = process::cargo(&root());
    let schema = match process::stdout_of(gonio.args(["run", "--quiet", "--locked", "--", "scene", "--schema"])) {
        Ok(schema) => schema,
        Err(error) => {
            eprintln!("xtask: {error}");
            return ExitCode::from(2);
        }
    };
    match std::fs::write(&file, schema) {
        Ok(()) => {
            println!("{}", file.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("xtask: cannot write {}: {error}", file.display());
            ExitCode::from(2)
        }
    }
}
