//! The exercises themselves: listed, shown, begun.

use super::{draw, exercise};
use crate::cli::WordOptions;
use crate::output::atomic;
use crate::report::{CliError, Outcome, Reporter};
use anstyle::Style;
use clap::Args;
use gonio_lab::exercise::{self as exercises, Exercise};
use gonio_lab::{GOAL, live};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The exercises, a line each.
#[derive(Args, Debug)]
pub struct ListArgs {
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// An exercise's text.
#[derive(Args, Debug)]
pub struct ShowArgs {
    /// Which: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Write an exercise's text and the files to start from into a folder.
#[derive(Args, Debug)]
pub struct StartArgs {
    /// Which: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// Where: made if it is not there; files that are there already are never written over.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Print or write the right answer.
#[derive(Args, Debug)]
pub struct ReferenceArgs {
    /// Which: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// Write its files into this folder instead of printing them.
    #[arg(long, short, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

#[derive(Serialize)]
struct Listed<'a> {
    id: &'a str,
    folder: &'a str,
    title: &'a str,
    summary: &'a str,
    kind: exercises::Kind,
    builds_on: &'a [String],
}

/// The exercises, a line each.
pub fn list(_: &ListArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let all = exercises::all();
    if reporter.json() {
        let listed: Vec<Listed<'_>> = all
            .iter()
            .map(|e| Listed {
                id: &e.id,
                folder: e.folder,
                title: &e.title,
                summary: &e.summary,
                kind: e.kind,
                builds_on: &e.builds_on,
            })
            .collect();
        reporter.report(&listed)?;
        return Ok(Outcome::Done);
    }
    let (bold, dim) = (Style::new().bold(), Style::new().dimmed());
    let width = all.iter().map(|e| e.title.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for e in all {
        text.push_str(&format!("{bold}{:<5}{bold:#} {:<width$}  {dim}{}{dim:#}\n", e.id, e.title, e.summary));
    }
    text.push_str("\n`gonio lab show ex04` shows one, `gonio lab start ex04 mine` begins it.\n");
    reporter.text(&text)?;
    Ok(Outcome::Done)
}

/// An exercise's text.
pub fn show(args: &ShowArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if reporter.json() {
        reporter.report(&serde_json::json!({
            "id": exercise.id, "title": exercise.title, "summary": exercise.summary, "text": exercise.text(),
            "look_for": exercise.look_for.iter().map(|l| &l.text).collect::<Vec<_>>(),
        }))?;
    } else {
        reporter.text(exercise.text())?;
    }
    Ok(Outcome::Done)
}

/// Writes an exercise's text and the files to start from.
pub fn start(args: &StartArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    let texts = exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    let mut written = write_all(texts.chain(exercise.pictures()), &args.folder)?;
    let goal = args.folder.join(GOAL);
    let is_drawn = live::is_drawn(exercise) && !goal.exists();
    if is_drawn {
        match draw::goal(exercise) {
            Ok(picture) => {
                atomic::write(&goal, &picture)?;
                written.push(GOAL.to_owned());
            }
            // Everything else is there, and is no worse for it.
            Err(why) => reporter.warning(format!("{GOAL}, the picture of what to reach, was not drawn: {why}")),
        }
    }
    if reporter.json() {
        reporter.report(&serde_json::json!({ "exercise": exercise.id, "folder": args.folder, "files": written }))?;
        return Ok(Outcome::Done);
    }
    let folder = args.folder.display();
    let look = if is_drawn { format!(", and look at {GOAL}") } else { String::new() };
    reporter.text(&format!(
        "{}: {}\n\n{folder}: {}\n\nRead text.md first{look}; then change the files and ask as often as you like:\n  gonio lab check {} {folder}\n",
        exercise.id,
        exercise.title,
        written.join(", "),
        exercise.id
    ))?;
    Ok(Outcome::Done)
}

/// Prints or writes the right answer.
pub fn reference(args: &ReferenceArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise: &Exercise = exercise(&args.exercise)?;
    if let Some(folder) = &args.output {
        let written = write_all(exercise.reference_files().map(|(name, text)| (name, text.as_bytes())), folder)?;
        reporter.note(format!("wrote {} into {}", written.join(", "), folder.display()));
        return Ok(Outcome::Done);
    }
    if reporter.json() {
        let files: serde_json::Map<String, serde_json::Value> =
            exercise.reference_files().map(|(name, text)| (name.to_owned(), text.into())).collect();
        reporter.report(&serde_json::json!({ "exercise": exercise.id, "files": files }))?;
        return Ok(Outcome::Done);
    }
    let style = Style::new().bold();
    let mut text = String::new();
    for (name, content) in exercise.reference_files() {
        text.push_str(&format!("{style}// {name}{style:#}\n{content}\n"));
    }
    reporter.text(&text)?;
    Ok(Outcome::Done)
}

/// Writes files into a folder that none of them is in; nothing is written where one is.
fn write_all<'a>(files: impl Iterator<Item = (&'a str, &'a [u8])>, folder: &Path) -> Result<Vec<String>, CliError> {
    let files: Vec<(&str, &[u8])> = files.collect();
    if let Some((name, _)) = files.iter().find(|(name, _)| folder.join(name).exists()) {
        return Err(CliError::new(format!(
            "{} is there already, and nothing is written over; name another folder",
            folder.join(name).display()
        )));
    }
    for (name, content) in &files {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        let failed = |error: std::io::Error| CliError::io(format!("{} could not be written", path.display()), &error);
        std::fs::create_dir_all(parent).map_err(failed)?;
        atomic::write(&path, content)?;
    }
    Ok(files.into_iter().map(|(name, _)| name.to_owned()).collect())
}
