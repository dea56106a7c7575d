//! `gonio course new`: a course to start from.

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::output::{OutputFiles, check_folder};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_course::template;
use gonio_language::Language;
use gonio_scene::nearest_word;
use std::path::PathBuf;

/// Write a course with one exercise, which verifies as it is.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio course new graphics
      With a copy of ex07, judged by the model solution of ex07: mistakes have names and lines.
  gonio course new graphics --from reference
      With an exercise about rim light, judged by the pictures of its own reference.
  gonio course new cours --from ex04 --language fr")]
pub struct NewArgs {
    /// Folder, created if it does not exist; existing files are never overwritten.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Exercise to begin with: a copy of a built-in one for shaders, or `reference`.
    #[arg(long, value_name = "EX", default_value = "ex07", help_heading = "Input options")]
    pub from: String,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &NewArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    check_folder(&args.folder, "`gonio course new`")?;
    let files = template::files(&args.from, Language::current()).ok_or_else(|| {
        let known: Vec<&str> = template::sources().collect();
        let meant = nearest_word(&args.from, known.iter().copied());
        let meant = meant.map_or(String::new(), |word| format!("; did you mean `{word}`?"));
        CliError::new(format!("no course begins with `{}`, expected {}{meant}", args.from, known.join(", ")))
    })?;
    if let Some(taken) = files.iter().map(|file| args.folder.join(&file.path)).find(|path| path.exists()) {
        return Err(CliError::new(format!(
            "{} exists, and existing files are never overwritten; name another folder",
            taken.display()
        )));
    }
    let mut set = OutputFiles::new();
    for file in &files {
        let path = args.folder.join(&file.path);
        set.make_folder(path.parent().unwrap_or(&args.folder))?;
        set.add(&path, &file.bytes)?;
    }
    set.commit()?;
    let names: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    if reporter.json() {
        reporter.report(&serde_json::json!({ "folder": args.folder, "files": names }))?;
        return Ok(CommandOutcome::Done);
    }
    let folder = args.folder.display();
    let mut page = TerminalPage::new();
    page.line(format_args!("{folder}: {}", names.join(", ")));
    page.blank();
    page.line("Change the files, and measure how well the checker judges the exercise:");
    page.line(format_args!("  gonio course verify {folder}"));
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}
