//! `gonio lab check`.

use super::intake::{self, Gathered, Intake, Submissions};
use super::{batch, exercise, text};
use crate::cli::WordOptions;
use crate::output::FileSet;
use crate::report::{CliError, Outcome, Reporter};
use crate::values;
use clap::Args;
use gonio_app::platform::desktop::worker::{self, Answer, Request};
use gonio_check::CheckOptions;
use gonio_check::verdict::Outcome as Word;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::report;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Check a pair of shaders: what is right, what is wrong, and the mistake's name and line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio lab check ex04 mine
  gonio lab check ex07 light.vert light.frag --page verdict.html
  gonio lab check ex09 main.cpp --json
  gonio lab check ex02 cube.csv
  gonio lab check ex07 submissions -o results
      Each folder and each zip in `submissions` is one: a page for each, a table, an overview. What was checked
      before and has not changed is not checked again. A zip of the whole class does as well, and so do the downloads
      of Moodle, Canvas, Blackboard and Brightspace, in folders or flat.

Any names and endings will do, and any `#version`; names of attributes and uniforms are found by their words and types,
and names.toml beside the files says what gonio could not guess. Exit codes: 0 correct, 1 not, 2 error.")]
pub struct CheckArgs {
    /// Which: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// The student's files, or the folder or zip that they are in; or a folder of such folders and zips.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Of several pairs in the files: the one whose file or variable is called so.
    #[arg(long, value_name = "NAME")]
    pub pair: Option<String>,
    /// Pass what the lab's own solutions do too, where they differ from the textbook.
    #[arg(long)]
    pub as_the_lab: bool,
    /// Treat the files as one submission or as many, instead of deciding from names and contents.
    #[arg(long, value_name = "HOW-MANY", default_value = "auto")]
    pub submissions: Submissions,
    /// The folder for pages, table and overview of many submissions, outside of theirs; beside theirs, where none is
    /// named.
    #[arg(long, short, value_name = "FOLDER", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Write the verdict as a web page with pictures.
    #[arg(long, visible_alias = "html", value_name = "FILE.html", help_heading = "Output")]
    pub page: Option<PathBuf>,
    /// Write the pictures: yours, the reference's, the difference, the mistake's; a column a scene.
    #[arg(long, value_name = "FILE.png", help_heading = "Output")]
    pub sheet: Option<PathBuf>,
    /// Write the verdict, or those of many submissions, as JUnit XML.
    #[arg(long, value_name = "FILE.xml", help_heading = "Output")]
    pub junit: Option<PathBuf>,
    /// Write the verdict as Gradescope's results.json.
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub gradescope: Option<PathBuf>,
    /// Write the verdict as what Moodle's CodeRunner reads.
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub code_runner: Option<PathBuf>,
    /// Points of a right answer, for Gradescope.
    #[arg(long, value_name = "N", default_value = "100", value_parser = values::not_negative, help_heading = "Output")]
    pub points: f64,
    /// Seconds that a check may take.
    #[arg(long, value_name = "SECONDS", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=86_400),
          help_heading = "Output")]
    pub patience: u64,
    /// OpenGL ES 3 instead of OpenGL: what a browser has.
    #[arg(long, hide = true)]
    pub es: bool,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

impl CheckArgs {
    /// The name of the first folder or file.
    fn label(&self) -> String {
        let first = self.files.first().map_or(Path::new("submission"), PathBuf::as_path);
        first.file_stem().map_or_else(|| "submission".to_owned(), |name| name.to_string_lossy().into_owned())
    }

    /// The options that ask for a file of one submission's verdict.
    fn options_of_one(&self) -> impl Iterator<Item = &'static str> {
        let asked = [
            ("--page", self.page.is_some()),
            ("--sheet", self.sheet.is_some()),
            ("--gradescope", self.gradescope.is_some()),
            ("--code-runner", self.code_runner.is_some()),
        ];
        asked.into_iter().filter(|(_, is_asked)| *is_asked).map(|(option, _)| option)
    }

    /// The check that these options ask for. The page and the sheet that they may ask for are not part of it.
    pub fn request(&self, exercise: &Exercise, gathered: Gathered) -> Request {
        Request {
            exercise: exercise.id.clone(),
            files: gathered.files,
            left_out: gathered.left_out.iter().map(|what| format!("left aside: {what}")).collect(),
            options: CheckOptions { pair: self.pair.clone(), as_the_lab: self.as_the_lab },
            es: self.es,
            page: None,
            sheet: false,
        }
    }

    /// How long a check may take.
    pub fn patience(&self) -> Duration {
        Duration::from_secs(self.patience)
    }
}

/// Checks.
pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    // A folder for results is one for those of a class, be it a class of one.
    let as_class = args.output.is_some() || args.submissions == Submissions::Many;
    match intake::take(&args.files, exercise, args.submissions, as_class)? {
        Intake::Class(class) => {
            if let Some(option) = args.options_of_one().next() {
                return Err(CliError::new(format!(
                    "{option} writes the verdict of one submission, and these are {}; a page for each, a table and an \
                     overview go to the folder that `-o` names",
                    class.submissions.len()
                )));
            }
            batch::run(args, exercise, &class, reporter)
        }
        Intake::One(gathered) => check_one(args, exercise, gathered, reporter),
    }
}

/// One submission, in a process of its own.
fn check_one(
    args: &CheckArgs,
    exercise: &Exercise,
    gathered: Gathered,
    reporter: &Reporter,
) -> Result<Outcome, CliError> {
    let label = args.label();
    let mut request = args.request(exercise, gathered);
    request.page = args.page.is_some().then(|| label.clone());
    request.sheet = args.sheet.is_some();
    let program = super::own_program()?;
    let not_started = |error| CliError::io("gonio could not start itself for a check", &error);
    let worker = worker::start(&program, request, false).map_err(not_started)?;
    let answer = worker.wait(args.patience(), || false).map_err(CliError::new)?;
    write(args, &label, &answer)?;
    if reporter.json() {
        reporter.report(&answer.verdict)?;
    } else {
        reporter.text(&text::verdict(&answer.verdict))?;
    }
    Ok(if answer.verdict.verdict == Word::Correct { Outcome::Done } else { Outcome::CheckFailed })
}

fn write(args: &CheckArgs, label: &str, Answer { verdict, page, sheet }: &Answer) -> Result<(), CliError> {
    let mut files = FileSet::new();
    if let Some(path) = &args.page {
        // Of a check that was ended there are no pictures.
        let page = page.clone().unwrap_or_else(|| report::page(label, verdict, None).into_bytes());
        files.add(path, &page)?;
    }
    if let Some(path) = &args.sheet {
        let nothing = || CliError::new(format!("{}: nothing was drawn, so there is no sheet", path.display()));
        files.add(path, sheet.as_ref().ok_or_else(nothing)?)?;
    }
    if let Some(path) = &args.junit {
        files.add(path, report::junit(&[(label.to_owned(), verdict.clone())]).as_bytes())?;
    }
    if let Some(path) = &args.gradescope {
        files.add(path, report::gradescope(verdict, args.points).as_bytes())?;
    }
    if let Some(path) = &args.code_runner {
        files.add(path, report::code_runner(verdict).as_bytes())?;
    }
    files.commit()
}
