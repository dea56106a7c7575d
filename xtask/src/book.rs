//! `cargo xtask book`: writes what the program generates for the book in `docs`, and builds it with mdBook.
//!
//! ```text
//! gonio man --markdown    docs/reference/*.md
//! gonio scene --link      the line `[NAME]: ...` of each picture, in the pages that show it
//! gonio render, beyond    docs/pictures/NAME.png, with --pictures
//! mdbook                  target/site/book, and beside it the page of dist, if it was built
//! ```

use crate::process;
use crate::{root, target};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// What opens gonio's page, seen from `docs`: the book lies in a folder beside the page's `index.html`.
const PAGE: &str = "../index.html";

/// Writes the generated parts of the book and builds it.
pub fn run(words: &[&str]) -> ExitCode {
    let draws = match words {
        [] => false,
        ["--pictures"] => true,
        _ => {
            eprintln!("xtask: book: unknown option `{}`; the only option is --pictures", words.join(" "));
            return ExitCode::from(2);
        }
    };
    match generate(&root(), draws).and_then(|()| build(&root())) {
        Ok(message) => {
            println!("{message}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("xtask: book: {}", error.trim_end());
            ExitCode::from(2)
        }
    }
}

/// A picture of `docs/pictures.txt`.
#[derive(Debug, PartialEq)]
struct BookPicture {
    name: String,
    /// The words after `gonio`, without `-o`.
    arguments: Vec<String>,
}

fn generate(root: &Path, draws: bool) -> Result<(), String> {
    let program = program(root)?;
    let docs = root.join("docs");
    run_program(&program, root, &["man", "--markdown", "docs/reference"])?;
    let list = read(&docs.join("pictures.txt"))?;
    let pictures = list.lines().filter_map(parse).collect::<Result<Vec<BookPicture>, String>>()?;
    let mut links = Vec::new();
    for picture in &pictures {
        if draws {
            println!("docs/pictures/{}.png", picture.name);
            draw(&program, root, picture)?;
        }
        links.push((picture.name.as_str(), link(&program, root, picture)?));
    }
    for path in markdown_files(&docs)? {
        let text = read(&path)?;
        let depth = path.strip_prefix(&docs).map_or(1, |below| below.components().count());
        let written = with_links(&text, &links, depth - 1);
        if written != text {
            std::fs::write(&path, written).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        }
    }
    Ok(())
}

/// A line of `docs/pictures.txt`; `None` for comments and empty lines.
fn parse(line: &str) -> Option<Result<BookPicture, String>> {
    if line.is_empty() || line.starts_with('#') {
        return None;
    }
    let Some((name, command)) = line.split_once(": ") else {
        return Some(Err(format!("docs/pictures.txt: expected `NAME: COMMAND`, found `{line}`")));
    };
    // Every second part lies between quotes.
    let parts = command.split('"').enumerate();
    let words = parts.flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    Some(Ok(BookPicture { name: name.to_owned(), arguments: words.collect() }))
}

/// Replaces the definition `[NAME]: ...` of each picture's link. `depth` is the number of folders between the page and `docs`.
fn with_links(text: &str, links: &[(&str, String)], depth: usize) -> String {
    let mut written = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let name = line.strip_prefix('[').and_then(|rest| rest.split_once("]:")).map(|(name, _)| name);
        match links.iter().find(|(known, _)| Some(*known) == name) {
            Some((name, fragment)) => written += &format!("[{name}]: {}{PAGE}{fragment}\n", "../".repeat(depth)),
            None => written += line,
        }
    }
    written
}

/// What follows the page's address to open the scene of a picture.
fn link(program: &Path, root: &Path, picture: &BookPicture) -> Result<String, String> {
    let words: Vec<&str> = picture.arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["render", scene @ ..] => {
            Ok(run_program(program, root, &[&["scene"], scene, &["--link"]].concat())?.trim().to_owned())
        }
        ["beyond", station, ..] => Ok(format!("#station={station}")),
        _ => Err(format!("docs/pictures.txt: `{}` is drawn by neither render nor beyond", picture.name)),
    }
}

fn draw(program: &Path, root: &Path, picture: &BookPicture) -> Result<(), String> {
    let target = root.join("docs/pictures").join(format!("{}.png", picture.name));
    let words: Vec<&str> = picture.arguments.iter().map(String::as_str).collect();
    if let ["beyond", station, options @ ..] = words.as_slice() {
        let folder = target::target_folder(root).join("book-pictures");
        run_program(program, root, &[&words, &["-o", &folder.to_string_lossy()][..]].concat())?;
        let shown = options.iter().skip_while(|word| **word != "--picture").nth(1).copied().unwrap_or_default();
        let drawn = folder.join(format!("{station}-{shown}.png"));
        let copied = std::fs::copy(&drawn, &target).map(|_| ());
        return copied.map_err(|error| format!("cannot copy {} to {}: {error}", drawn.display(), target.display()));
    }
    run_program(program, root, &[&words, &["-o", &target.to_string_lossy()][..]].concat()).map(|_| ())
}

/// gonio: the program in the environment variable `GONIO_PROGRAM`, or built now.
pub fn program(root: &Path) -> Result<PathBuf, String> {
    if let Some(program) = std::env::var_os("GONIO_PROGRAM") {
        return Ok(root.join(program));
    }
    process::stdout_of(process::cargo(root).args(["build", "--quiet", "--locked"]))?;
    Ok(target::debug_program(root))
}

fn run_program(program: &Path, root: &Path, arguments: &[&str]) -> Result<String, String> {
    process::stdout_of(Command::new(program).current_dir(root).args(arguments))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

/// Every Markdown file in a folder and below.
fn markdown_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let entries = std::fs::read_dir(folder).map_err(|error| format!("cannot read {}: {error}", folder.display()))?;
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        if path.is_dir() {
            files.extend(markdown_files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            files.push(path);
        }
    }
    Ok(files)
}

/// Builds the book with mdBook; returns what to tell the user.
fn build(root: &Path) -> Result<String, String> {
    let site = target::target_folder(root).join("site");
    let mut mdbook = Command::new("mdbook");
    mdbook.arg("build").arg(root.join("docs")).arg("--dest-dir").arg(site.join("book"));
    match mdbook.output() {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Ok(
                "docs is up to date. To read it as a web site: `cargo install mdbook`, then this again.".to_owned()
            );
        }
        Err(error) => return Err(format!("cannot run mdbook: {error}")),
        Ok(output) if !output.status.success() => return Err(String::from_utf8_lossy(&output.stderr).into_owned()),
        Ok(_) => {}
    }
    let book = site.join("book/index.html");
    let dist = root.join("dist");
    if !dist.join("index.html").is_file() {
        return Ok(format!(
            "{}\nIts pictures link to gonio's page, which is not built: `cargo xtask web`, then this again.",
            book.display()
        ));
    }
    copy_folder(&dist, &site)?;
    Ok(format!(
        "{}\nThe pictures' links need a web server, such as `python3 -m http.server -d {}`.",
        book.display(),
        site.display()
    ))
}

fn copy_folder(from: &Path, to: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("cannot copy {} to {}: {error}", from.display(), to.display());
    std::fs::create_dir_all(to).map_err(failed)?;
    for entry in std::fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_folder(&entry.path(), &target)?;
        } else {
            std::fs::copy(entry.path(), target).map_err(failed)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_list_is_a_name_and_words() {
        let picture = parse("dark: render a --light \"directional direction=0,0,1\" --size 2x1");
        let words = ["render", "a", "--light", "directional direction=0,0,1", "--size", "2x1"];
        let arguments = words.map(str::to_owned).to_vec();
        assert_eq!(picture, Some(Ok(BookPicture { name: "dark".to_owned(), arguments })));
        assert_eq!(parse("# dark: render"), None);
        assert!(parse("dark").is_some_and(|picture| picture.is_err()));
    }

    #[test]
    fn the_definitions_of_pictures_are_written_and_no_others() {
        let links = [("a", "#scene=x".to_owned())];
        assert_eq!(
            with_links("[a]: old\n[b]: old\n[a](c)\n", &links, 1),
            "[a]: ../../index.html#scene=x\n[b]: old\n[a](c)\n"
        );
        assert_eq!(with_links("[a]:", &links, 0), "[a]: ../index.html#scene=x\n");
    }
}
