//! The folder of a course: where it is, and what is read of it.

use crate::error::{CliError, io_reason};
use crate::options::CourseOptions;
use crate::report::Reporter;
use gonio_course::course::{COURSE_FILE, EXERCISE_FILE};
use gonio_course::{Course, CourseFile};
use gonio_exercises::exercise;
use std::fs;
use std::path::{Path, PathBuf};

/// Most files of a course.
const MOST_FILES: usize = 4000;
/// Most bytes of all its files.
const MOST_BYTES: u64 = 128 << 20;
/// Most folders within each other.
const DEEPEST: usize = 8;

/// Makes the exercises of a course known to this process: of the one that is named, or of the one around the current folder, which a
/// note mentions.
pub fn install(options: &CourseOptions, reporter: &Reporter) -> Result<(), CliError> {
    let folder = match &options.course {
        Some(folder) => folder.clone(),
        None => match around_here() {
            Some(folder) => folder,
            None => return Ok(()),
        },
    };
    let (_, course) = read(&folder)?;
    if options.course.is_none() {
        reporter.note(format!("the exercises are those of the course \"{}\" in {}", course.name, folder.display()));
    }
    let absolute = std::path::absolute(&folder).unwrap_or(folder);
    exercise::install(absolute, course.installed());
    Ok(())
}

/// The current folder, or the nearest one around it, with a `course.toml`.
pub fn around_here() -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    here.ancestors().find(|folder| folder.join(COURSE_FILE).is_file()).map(Path::to_owned)
}

/// Reads the course in a folder, with its files.
pub fn read(folder: &Path) -> Result<(Vec<CourseFile>, Course), CliError> {
    let top = folder.join(COURSE_FILE);
    if !top.is_file() {
        return Err(CliError::new(format!(
            "there is no {COURSE_FILE} in `{}`; `gonio course new FOLDER` begins a course",
            folder.display()
        )));
    }
    let mut files = Files { all: Vec::new(), bytes: 0 };
    files.add(&top, COURSE_FILE.to_owned())?;
    let mut folders = names_in(folder)?;
    folders.retain(|name| folder.join(name).join(EXERCISE_FILE).is_file());
    for name in folders {
        files.add_folder(&folder.join(&name), &name, 0)?;
    }
    let course = Course::read(&files.all).map_err(|error| CliError::new(format!("{}/{error}", folder.display())))?;
    Ok((files.all, course))
}

struct Files {
    all: Vec<CourseFile>,
    bytes: u64,
}

impl Files {
    fn add(&mut self, path: &Path, name: String) -> Result<(), CliError> {
        let unread = |error| CliError::io(format!("cannot read `{}`", path.display()), &error);
        let size = fs::metadata(path).map_err(unread)?.len();
        self.bytes = self.bytes.saturating_add(size);
        if self.all.len() >= MOST_FILES || self.bytes > MOST_BYTES {
            return Err(CliError::new(format!(
                "`{}`: a course has at most {MOST_FILES} files and {} MB; move what does not belong to it elsewhere",
                path.display(),
                MOST_BYTES >> 20
            )));
        }
        self.all.push(CourseFile::new(name, fs::read(path).map_err(unread)?));
        Ok(())
    }

    fn add_folder(&mut self, folder: &Path, name: &str, depth: usize) -> Result<(), CliError> {
        if depth > DEEPEST {
            return Err(CliError::new(format!("`{}`: too many folders within each other", folder.display())));
        }
        for entry in names_in(folder)? {
            let path = folder.join(&entry);
            // Links may lead anywhere.
            let Ok(kind) = fs::symlink_metadata(&path).map(|data| data.file_type()) else { continue };
            let inner = format!("{name}/{entry}");
            if kind.is_dir() {
                self.add_folder(&path, &inner, depth + 1)?;
            } else if kind.is_file() {
                self.add(&path, inner)?;
            }
        }
        Ok(())
    }
}

/// The names in a folder, sorted, without hidden ones.
fn names_in(folder: &Path) -> Result<Vec<String>, CliError> {
    let unread = |error: std::io::Error| {
        CliError::new(format!("cannot read the folder `{}`: {}", folder.display(), io_reason(&error)))
    };
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(unread)? {
        // A name that is not Unicode is in no exercise.
        if let Ok(name) = entry.map_err(unread)?.file_name().into_string()
            && !name.starts_with('.')
        {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
