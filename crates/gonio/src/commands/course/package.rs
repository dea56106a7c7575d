//! `gonio course package`: what is uploaded to a grader.

use super::folder;
use super::verify::find;
use crate::commands::about::VERSION;
use crate::commands::lab::child_process::own_program;
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions, values};
use crate::output::atomic;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_app::files::{PackedFile, pack_all};
use gonio_check::feedback::Feedback;
use gonio_course::course::{CourseExercise, CoursePolicy, with_policy};
use gonio_course::package::{GradingPlatform, Package, PackageRequest, PackagedFile, package};
use gonio_course::{Course, CourseFile};
use gonio_exercises::exercise::{self, ExerciseKind};
use gonio_gl::HeadlessContext;
use gonio_language::Language;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Write what is uploaded to a grader, without the reference.
#[derive(Args, Debug)]
#[command(after_long_help = "\
A folder gets `upload/`, `students/` and a README.md with the steps; a zip gets what is uploaded alone. An exercise that is judged by \
its own reference is packaged with the pictures of that reference, not with its source.

Examples:
  gonio course package ex04 --for gradescope -o ex04.zip
      A built-in exercise, as it is.
  gonio course package rim-light --course graphics --for coderunner -o rim-light
  gonio course package rim-light --course graphics --for github-classroom -o template
  gonio course package rim-light --course graphics --for docker -o grader --program none

Platforms: gradescope, coderunner (with a Jobe server), github-classroom, moodle (without CodeRunner: graded by hand), docker. The book's \
chapter \"Grading 100 submissions\" compares them.")]
pub struct PackageArgs {
    /// Exercise, by its id or folder.
    #[arg(value_name = "EXERCISE")]
    pub exercise: String,
    /// Platform: gradescope, coderunner, github-classroom, moodle, docker.
    #[arg(long = "for", value_name = "PLATFORM", value_parser = values::named(&GradingPlatform::ALL, GradingPlatform::word),
          help_heading = "Output options")]
    pub platform: GradingPlatform,
    /// Folder, which must not exist, or a file that ends in .zip.
    #[arg(long, short, value_name = "FOLDER", help_heading = "Output options")]
    pub output: PathBuf,
    /// gonio's program for Gradescope and Docker, whose machines run Linux; `none` lets them download it. By default this program.
    #[arg(long, value_name = "FILE", help_heading = "Output options")]
    pub program: Option<PathBuf>,
    /// Address of an archive (.tar.gz) with gonio's program, for machines that download it. By default that of this version's release.
    #[arg(long, value_name = "URL", help_heading = "Output options")]
    pub program_url: Option<String>,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &PackageArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let is_zip = args.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("zip"));
    if !is_zip && args.output.exists() {
        return Err(CliError::new(format!(
            "`{}` exists, and nothing is overwritten; name another folder",
            args.output.display()
        )));
    }
    if let Some(url) = args.program_url.as_deref().filter(|url| !is_address(url)) {
        return Err(CliError::new(format!("`{url}` is not an address such as https://example.org/gonio.tar.gz")));
    }
    let (files, course) = course(args)?;
    let of = find(&course, &args.exercise)?;
    let takes_any_kind = matches!(args.platform, GradingPlatform::Gradescope | GradingPlatform::Docker);
    if of.exercise.kind != ExerciseKind::Shaders && !takes_any_kind {
        return Err(CliError::new(format!(
            "{} is not answered with a pair of shaders, and {} takes only those; gradescope and docker take it",
            of.exercise.id,
            args.platform.word()
        )));
    }
    let pictures = pictures(of)?;
    let request = PackageRequest {
        course: &course,
        files: &files,
        of,
        pictures: pictures.as_ref(),
        program: program(args)?,
        program_url: args.program_url.clone().unwrap_or_else(release),
        version: VERSION,
        zip,
        language: Language::current(),
    };
    let made = package(args.platform, &request);
    if is_zip {
        atomic::write(&args.output, &zip(&made.upload))?;
    } else {
        write_folder(&args.output, &made)?;
    }
    let count = made.upload.len();
    if reporter.json() {
        let names = |files: &[PackagedFile]| files.iter().map(|file| file.path.clone()).collect::<Vec<_>>();
        reporter.report(&serde_json::json!({
            "exercise": of.exercise.id, "for": args.platform.word(), "output": args.output,
            "upload": names(&made.upload), "students": names(&made.students),
        }))?;
        return Ok(CommandOutcome::Done);
    }
    let mut page = TerminalPage::new();
    page.line(format_args!("{}: {count} files for {}", args.output.display(), args.platform.word()));
    page.blank();
    page.text(&made.readme);
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

/// The course that is named or around the current folder; without one, a course of the built-in exercises.
fn course(args: &PackageArgs) -> Result<(Vec<CourseFile>, Course), CliError> {
    if let Some(folder) = args.course.course.clone().or_else(folder::around_here) {
        return folder::read(&folder);
    }
    let policy = CoursePolicy {
        languages: Language::ALL.to_vec(),
        feedback: Feedback::Line,
        show_reference: false,
        points: None,
    };
    let exercises = exercise::built_in().iter().map(|built_in| with_policy(built_in, &policy)).collect();
    Ok((Vec::new(), Course { name: "gonio".to_owned(), policy, exercises }))
}

/// The pictures of the reference of an exercise that is judged by them.
fn pictures(of: &CourseExercise) -> Result<Option<gonio_check::picture_judge::StoredPictures>, CliError> {
    let Some(judge) = of.exercise.picture_judge() else { return Ok(None) };
    let context = HeadlessContext::new().map_err(CliError::from)?;
    let stored = judge.stored(context.gl());
    // The system frees it faster.
    std::mem::forget(context);
    Ok(Some(stored?))
}

fn program(args: &PackageArgs) -> Result<Option<Vec<u8>>, CliError> {
    if !args.platform.carries_program() {
        return Ok(None);
    }
    let path = match &args.program {
        Some(path) if path.as_os_str() == "none" => return Ok(None),
        Some(path) => path.clone(),
        // A grader's machine runs Linux, and downloads a program if this one is for another system.
        None if cfg!(target_os = "linux") => own_program()?,
        None => return Ok(None),
    };
    let unread = |error| CliError::io(format!("cannot read the program `{}`", path.display()), &error);
    fs::read(&path).map(Some).map_err(unread)
}

/// The archive of this version's release.
fn release() -> String {
    let (repository, version) = (env!("CARGO_PKG_REPOSITORY"), env!("CARGO_PKG_VERSION"));
    format!("{repository}/releases/download/v{version}/gonio-{version}-x86_64-unknown-linux-gnu.tar.gz")
}

fn is_address(url: &str) -> bool {
    ["https://", "http://", "file://"].iter().any(|begin| url.starts_with(begin)) && !url.contains(char::is_control)
}

fn zip(files: &[PackagedFile]) -> Vec<u8> {
    let packed = files.iter().map(|PackagedFile { path, bytes, is_executable }| PackedFile {
        name: path,
        bytes,
        is_executable: *is_executable,
    });
    pack_all(&packed.collect::<Vec<_>>())
}

/// Writes the folder beside its place, and renames it when it is complete.
fn write_folder(folder: &Path, made: &Package) -> Result<(), CliError> {
    let beside = atomic::folder_beside(folder)?;
    let root = beside.path().join("package");
    let write = || -> io::Result<()> {
        for (part, files) in [("upload", &made.upload), ("students", &made.students)] {
            for file in files {
                let path = root.join(part).join(&file.path);
                fs::create_dir_all(path.parent().unwrap_or(&root))?;
                fs::write(&path, &file.bytes)?;
                if file.is_executable {
                    make_executable(&path)?;
                }
            }
        }
        fs::create_dir_all(&root)?;
        fs::write(root.join("README.md"), &made.readme)?;
        fs::rename(&root, folder)
    };
    write().map_err(|error| atomic::write_error(folder, &error))
}

#[cfg(unix)]
fn make_executable(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> io::Result<()> {
    Ok(())
}
