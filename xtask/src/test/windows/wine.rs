//! Wine with a system of its own, and a screen whose picture can be read.

use super::screen::Screen;
use crate::cases::{empty_folder, run};
use crate::process;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The size of the screen.
const SCREEN: [u32; 2] = [1024, 700];

const RANDOM_LIBRARY: &str = "bcryptprimitives.dll";
const RANDOM_SOURCE: &str = "\
#include <windows.h>
#include <ntsecapi.h>
__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T length) { return RtlGenRandom(data, (ULONG)length); }
";

/// A Windows of its own in a folder. Drive G: is its folder of work.
pub struct Wine {
    prefix: PathBuf,
    /// Drive G:.
    pub work: PathBuf,
    program: PathBuf,
    screen: Screen,
    /// The file in which the X server keeps its picture.
    picture: PathBuf,
}

impl Wine {
    /// Makes drives and settings below `folder`, empties drive G:, and starts a screen.
    pub fn new(folder: &Path, program: &Path) -> Result<Wine, String> {
        let (prefix, work) = (folder.join("prefix"), folder.join("work"));
        empty_folder(&work)?;
        let made = std::fs::create_dir_all(&prefix);
        made.map_err(|error| format!("cannot make {}: {error}", prefix.display()))?;
        let frames = folder.join("screen");
        empty_folder(&frames)?;
        let screen = Screen::new(SCREEN, &["-fbdir", &frames.to_string_lossy()])?;
        let picture = frames.join("Xvfb_screen0");
        let wine = Wine { prefix, work, program: program.to_owned(), screen, picture };
        run(wine.command("wineboot").arg("--init"))?.with_code(0)?;
        wine.add_random_numbers()?;
        let drive = wine.prefix.join("dosdevices/g:");
        if !drive.is_symlink() {
            link(&wine.work, &drive)?;
        }
        Ok(wine)
    }

    /// Adds the library with Windows' random numbers, which every program in Rust loads at its start. Wine has it since version 8.13; this
    /// one asks an older function.
    fn add_random_numbers(&self) -> Result<(), String> {
        if self.has_library(RANDOM_LIBRARY) {
            return Ok(());
        }
        let source = self.prefix.join("random.c");
        std::fs::write(&source, RANDOM_SOURCE).map_err(|error| format!("{}: {error}", source.display()))?;
        let mut compiler = Command::new("x86_64-w64-mingw32-gcc");
        compiler.arg("-shared").arg("-o").arg(self.prefix.join("drive_c/windows/system32").join(RANDOM_LIBRARY));
        process::stdout_of(compiler.arg(source).arg("-ladvapi32")).map(drop)
    }

    /// A program of Wine, in drive G:.
    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command
            .env("WINEPREFIX", &self.prefix)
            .env("WINEARCH", "win64")
            .env("WINEDEBUG", "-all")
            // Neither .NET nor a browser, which Wine would offer to download.
            .env("WINEDLLOVERRIDES", "mscoree,mshtml=")
            .env("DISPLAY", &self.screen.name)
            .env_remove("LANG")
            .env("LC_ALL", "C.UTF-8")
            .current_dir(&self.work);
        command
    }

    /// `gonio.exe` with arguments.
    pub fn gonio(&self, words: &[&str]) -> Command {
        let mut command = self.command("wine");
        command.arg(&self.program).args(words);
        command
    }

    /// Input as of a person, and questions to the screen.
    pub fn xdotool(&self, words: &[&str]) -> Result<String, String> {
        process::stdout_of(Command::new("xdotool").args(words).env("DISPLAY", &self.screen.name))
    }

    /// Whether the system has a library of this name.
    pub fn has_library(&self, name: &str) -> bool {
        self.prefix.join("drive_c/windows/system32").join(name.to_ascii_lowercase()).is_file()
    }

    /// What the screen shows: a row of `[blue, green, red]` for each line of pixels.
    pub fn picture(&self) -> Result<Vec<Vec<[u8; 3]>>, String> {
        let file = std::fs::read(&self.picture).map_err(|error| format!("{}: {error}", self.picture.display()))?;
        read_dump(&file).ok_or_else(|| format!("{} is not a picture of 32 bits per pixel", self.picture.display()))
    }

    /// Drive C:.
    pub fn drive_c(&self) -> PathBuf {
        self.prefix.join("drive_c")
    }
}

impl Drop for Wine {
    fn drop(&mut self) {
        // What still runs in this Windows, and nothing else.
        let _ = process::run(self.command("wineserver").arg("-k"));
    }
}

#[cfg(unix)]
fn link(target: &Path, link: &Path) -> Result<(), String> {
    std::os::unix::fs::symlink(target, link).map_err(|error| format!("cannot make {}: {error}", link.display()))
}

#[cfg(not(unix))]
fn link(_target: &Path, _link: &Path) -> Result<(), String> {
    Err("Wine is tested on Linux only".into())
}

/// Reads an X Window Dump (XWDFile.h, version 7) with 32 bits per pixel.
fn read_dump(file: &[u8]) -> Option<Vec<Vec<[u8; 3]>>> {
    let field = |index: usize| {
        let bytes = file.get(index * 4..index * 4 + 4)?;
        Some(u32::from_be_bytes(bytes.try_into().ok()?) as usize)
    };
    let [header, version, width, height] = [field(0)?, field(1)?, field(4)?, field(5)?];
    let [bits, stride, colours] = [field(11)?, field(12)?, field(19)?];
    if version != 7 || bits != 32 {
        return None;
    }
    // A colour map of 12 bytes each lies before the pixels.
    let pixels = file.get(header + colours * 12..)?;
    (0..height)
        .map(|y| {
            let row = pixels.get(y * stride..y * stride + width * 4)?;
            Some(row.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::read_dump;

    #[test]
    fn pixels_lie_behind_header_and_colours() {
        let mut fields = [0u32; 25];
        for (index, value) in [(0, 100), (1, 7), (4, 2), (5, 1), (11, 32), (12, 8), (19, 1)] {
            fields[index] = value;
        }
        let mut file: Vec<u8> = fields.iter().flat_map(|field| field.to_be_bytes()).collect();
        file.extend([9; 12]);
        file.extend([1, 2, 3, 0, 4, 5, 6, 0]);
        assert_eq!(read_dump(&file), Some(vec![vec![[1, 2, 3], [4, 5, 6]]]));
        assert_eq!(read_dump(&file[..file.len() - 1]), None);
    }
}
