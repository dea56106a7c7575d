//! `gonio lab list`, `show`, `start` and `reference`: the exercises themselves.

use super::{draw, exercise};
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions};
use crate::output::{OutputFiles, OutputPath, check_folder};
use crate::report::Reporter;
use crate::terminal::{Style, TerminalPage};
use clap::Args;
use gonio_exercises::exercise::{self as exercises, Exercise, ExerciseKind};
use gonio_exercises::{GOAL, preview};
use gonio_scene::files::builtin;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// List the exercises, one per line.
#[derive(Args, Debug)]
pub struct ListArgs {
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Print the text of an exercise.
#[derive(Args, Debug)]
pub struct ShowArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Write an exercise's text and the files to start from into a folder.
#[derive(Args, Debug)]
pub struct StartArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// Folder, created if it does not exist; existing files are never overwritten.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Print the reference solution, or write it into a folder.
///
/// Courses can hide it: `show_reference = false` in the course.toml of a course or the exercise.toml of an exercise.
#[derive(Args, Debug)]
pub struct ReferenceArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// Folder to write its files to; - prints them, as by default.
    #[arg(long, short, value_name = "FOLDER", help_heading = "Output options")]
    pub output: Option<OutputPath>,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

#[derive(Serialize)]
struct Listed<'a> {
    id: &'a str,
    folder: &'a str,
    title: &'a str,
    summary: &'a str,
    kind: exercises::ExerciseKind,
    builds_on: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<f64>,
}

pub fn list(_: &ListArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let all = exercises::all();
    if reporter.json() {
        let listed: Vec<Listed<'_>> = all
            .iter()
            .map(|e| Listed {
                id: &e.id,
                folder: e.folder,
                title: e.title(),
                summary: e.summary(),
                kind: e.kind,
                builds_on: &e.builds_on,
                points: e.points.as_ref().map(|scheme| scheme.total),
            })
            .collect();
        reporter.report(&listed)?;
        return Ok(CommandOutcome::Done);
    }
    let (bold, dim) = (Style::Bold, Style::Dim);
    let width = all.iter().map(|e| e.title().chars().count()).max().unwrap_or(0);
    let mut page = TerminalPage::new();
    for e in all {
        page.line(format_args!("{bold}{:<5}{bold:#} {:<width$}  {dim}{}{dim:#}", e.id, e.title(), e.summary()));
    }
    page.blank();
    let example = all.iter().find(|e| e.id == "ex04").or(all.first()).map_or("ex04", |e| e.id.as_str());
    page.line(format_args!(
        "`gonio lab show {example}` prints its text, `gonio lab start {example} mine` begins it in the folder `mine`."
    ));
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

pub fn show(args: &ShowArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if reporter.json() {
        reporter.report(&serde_json::json!({
            "id": exercise.id, "title": exercise.title(), "summary": exercise.summary(), "text": exercise.text(),
            "look_for": exercise.look_for().iter().map(|l| &l.text).collect::<Vec<_>>(),
        }))?;
    } else {
        reporter.text(&TerminalPage::from_text(exercise.text()))?;
    }
    Ok(CommandOutcome::Done)
}

pub fn start(args: &StartArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    check_folder(&args.folder, "`gonio lab start`")?;
    let texts = exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    let mut set = OutputFiles::new();
    let given = exercise.given.iter().filter_map(|path| Some((Exercise::given_name(path), builtin(path)?)));
    let mut written = add_all(&mut set, texts.chain(exercise.pictures()).chain(given), &args.folder)?;
    let goal = args.folder.join(GOAL);
    let has_goal = preview::is_drawn(exercise) || exercise.kind == ExerciseKind::Baking;
    let mut is_drawn = exercise.shows_reference && has_goal && !goal.exists();
    if is_drawn {
        match draw::goal(exercise, reporter) {
            Ok(picture) => {
                set.add(&goal, &picture)?;
                written.push(GOAL.to_owned());
            }
            // The exercise works without it.
            Err(error) => {
                is_drawn = false;
                reporter.warning(format!("{GOAL}, the picture to reach, was not drawn: {error}"));
            }
        }
    }
    set.commit()?;
    if reporter.json() {
        reporter.report(&serde_json::json!({ "exercise": exercise.id, "folder": args.folder, "files": written }))?;
        return Ok(CommandOutcome::Done);
    }
    let folder = args.folder.display();
    let look = if is_drawn { format!(", and look at {GOAL}") } else { String::new() };
    let mut page = TerminalPage::new();
    page.line(format_args!("{}: {}", exercise.id, exercise.title()));
    page.blank();
    page.line(format_args!("{folder}: {}", written.join(", ")));
    page.blank();
    page.line(format_args!("Read text.md first{look}; then change the files, and check them as often as you like:"));
    page.line(format_args!("  gonio lab check {} {folder}", exercise.id));
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

pub fn reference(args: &ReferenceArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise: &Exercise = exercise(&args.exercise)?;
    let files = exercise.reference_files().map_err(CliError::new)?;
    if let Some(folder) = args.output.as_ref().and_then(OutputPath::file) {
        let mut set = OutputFiles::new();
        let files = files.map(|(name, text)| (name, text.as_bytes()));
        let written = add_all(&mut set, files, folder)?;
        set.commit()?;
        reporter.note(format!("wrote {} into {}", written.join(", "), folder.display()));
        return Ok(CommandOutcome::Done);
    }
    if reporter.json() {
        let files: serde_json::Map<String, serde_json::Value> =
            files.map(|(name, text)| (name.to_owned(), text.into())).collect();
        reporter.report(&serde_json::json!({ "exercise": exercise.id, "files": files }))?;
        return Ok(CommandOutcome::Done);
    }
    let bold = Style::Bold;
    let mut page = TerminalPage::new();
    for (name, content) in files {
        page.line(format_args!("{bold}// {name}{bold:#}"));
        page.text(content);
        page.blank();
    }
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

/// Adds the files of a folder; an error if one of them exists.
fn add_all<'a>(
    set: &mut OutputFiles,
    files: impl Iterator<Item = (&'a str, &'a [u8])>,
    folder: &Path,
) -> Result<Vec<String>, CliError> {
    let files: Vec<(&str, &[u8])> = files.collect();
    if let Some((name, _)) = files.iter().find(|(name, _)| folder.join(name).exists()) {
        return Err(CliError::new(format!(
            "{} exists, and existing files are never overwritten; name another folder",
            folder.join(name).display()
        )));
    }
    for (name, content) in &files {
        let path = folder.join(name);
        set.make_folder(path.parent().unwrap_or(folder))?;
        set.add(&path, content)?;
    }
    Ok(files.into_iter().map(|(name, _)| name.to_owned()).collect())
}
