//! Development tasks: tests, benchmarks, fuzzing, the web page. `cargo xtask help` lists them.

mod bench;
mod book;
mod cases;
mod checks;
mod dist;
mod editors;
mod fixtures;
mod fuzz;
mod house;
mod licenses;
mod process;
mod report;
mod score;
mod setup;
mod target;
mod test;
mod web;

use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
cargo xtask test             run everything that CI runs; needs only rustup and a C compiler to start
cargo xtask test --all       also the rest of the page's tests, the checker's score, other platforms, Windows under Wine, the Python
                             package, the release archive, the crates to publish, licences
cargo xtask test --fast      without the web page, and without installing anything
cargo xtask test --web [--dev]
                             build the web page and run all of its tests in headless Chromium
cargo xtask test --only windows|archive|crates|python
                             one of the steps that --all adds
cargo xtask house            figures about the code base, and the rules that no compiler enforces; takes a second
cargo xtask bench [NAME...]  run benchmarks; without a name, all of them
    render                   a 5,000-triangle model to a PNG, whole process, against f3d and a VTK script
    render-large             the same with 1 million triangles
    frame                    a frame of 1 million triangles against a minimal OpenGL loop
    lights                   the cost of a light, from 1 to 1,000 lights
    obj                      reading OBJ files of 1 and 5 million triangles, against tobj and others
    environment              converting a panorama to a cubemap, against OpenCV and ffmpeg
    trace                    paths per CPU second and their error, against Mitsuba 3; needs `pip install mitsuba`
    unwrap                   texture coordinates of several models, their speed and that of a bake, against xatlas and Blender
    bench                    a frame of the BRDF bench when the angle of incidence changes
    window                   dragging a light in the window, against the renderer alone; needs Xvfb
    python                   a picture from Python against the same from Rust; needs python3, and pip for the package
    ray                      10,000 pictures by a Ray cluster, of which a worker is killed, against one plain process for each core
cargo xtask bench web        the page in headless Chromium against a three.js page: first frame, memory
cargo xtask fuzz [TARGET...] [--minutes N]
                             fuzz every reader, 20 minutes each; needs cargo-fuzz and nightly Rust
cargo xtask web [--dev]      build the web page into dist and print its size; needs node and npm
cargo xtask dist [--target T] [--built-page] [--manifests] [--wheel]
                             build the archive of a release into target/packages, with checksums and manifests
    --built-page             embed the page that is in dist instead of building it
    --manifests              write checksums and manifests of the archives that are there, and build nothing
    --wheel                  build the wheel of the Python package instead of the archive; needs python3
cargo xtask vscode           build the extension for VS Code into editors/vscode/dist; needs node and npm
cargo xtask book [--pictures]
                             write what the program generates for the book in docs, and build it; needs mdbook
    --pictures               also draw the book's pictures
cargo xtask schema           update assets/scene.schema.json
cargo xtask score            measure the checker and update the table in exercises/README.md
cargo xtask licenses         update the third-party notices that `gonio licenses` prints
cargo xtask help             print this text

Exit codes: 0 success, 1 a check failed, 2 error.
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["test"] => test::run(test::Extent::Continuous),
        ["test", "--all"] => test::run(test::Extent::All),
        ["test", "--fast"] => test::run(test::Extent::Fast),
        ["test", "--only", word] if let Some(extra) = test::Extra::named(word) => test::run(test::Extent::Only(extra)),
        ["house"] => test::run(test::Extent::House),
        ["test", "--web"] => test::run(test::Extent::Web(web::Build::Shipped)),
        ["test", "--web", "--dev"] => test::run(test::Extent::Web(web::Build::Dev)),
        ["bench", "web"] => bench::web(),
        ["bench", names @ ..] => bench::run(names),
        ["fuzz", words @ ..] => fuzz::run(words),
        ["web", words @ ..] => web::run(words),
        ["dist", words @ ..] => dist::run(words),
        ["vscode"] => editors::run(&root()),
        ["book", words @ ..] => book::run(words),
        ["schema"] => schema(),
        ["score"] => score::run(),
        ["licenses"] => licenses::run(&root()),
        [] | ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("xtask: unknown task `{}`\n\n{HELP}", words.join(" "));
            ExitCode::from(2)
        }
    }
}

/// The repository's root folder.
fn root() -> PathBuf {
    // `CARGO_MANIFEST_DIR` is the `xtask` folder.
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
