//! `gonio lab check`.

use super::{batch, exercise, files, text};
use crate::cli::WordOptions;
use crate::output::atomic;
use crate::report::{CliError, Outcome, Reporter};
use clap::Args;
use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;
use gonio_lab::check::{Checker, Evidence};
use gonio_lab::exercise::Exercise;
use gonio_lab::formats::{self, Row};
use gonio_lab::verdict::{Outcome as Word, Verdict};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

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
      before and has not changed is not checked again.

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
    /// Of many submissions: the folder for pages, table and overview.
    #[arg(long, short, value_name = "FOLDER", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Write the verdict as a web page with pictures.
    #[arg(long, visible_alias = "html", value_name = "FILE.html", help_heading = "Output")]
    pub page: Option<PathBuf>,
    /// Write the pictures: yours, the reference's, the difference, the mistake's; a column a scene.
    #[arg(long, value_name = "FILE.png", help_heading = "Output")]
    pub sheet: Option<PathBuf>,
    /// Write the verdict as JUnit XML.
    #[arg(long, value_name = "FILE.xml", help_heading = "Output")]
    pub junit: Option<PathBuf>,
    /// Write the verdict as Gradescope's results.json.
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub gradescope: Option<PathBuf>,
    /// Write the verdict as what Moodle's CodeRunner reads.
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub code_runner: Option<PathBuf>,
    /// Points of a right answer, for Gradescope.
    #[arg(long, value_name = "N", default_value = "100", help_heading = "Output")]
    pub points: f64,
    /// Seconds that a check may take.
    #[arg(long, value_name = "SECONDS", default_value_t = 30, help_heading = "Output")]
    pub patience: u64,
    /// The row of a batch's table goes here.
    #[arg(long, value_name = "FILE", hide = true)]
    pub row: Option<PathBuf>,
    /// What the submission is called in pages.
    #[arg(long, value_name = "NAME", hide = true)]
    pub label: Option<String>,
    /// OpenGL ES 3 instead of OpenGL: what a browser has.
    #[arg(long, hide = true)]
    pub es: bool,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

impl CheckArgs {
    /// What the submission is called: its folder's or first file's name.
    fn label(&self) -> String {
        let first = self.files.first().map_or(Path::new("submission"), PathBuf::as_path);
        let name = first.file_stem().map(|name| name.to_string_lossy().into_owned());
        self.label.clone().or(name).unwrap_or_else(|| "submission".to_owned())
    }
}

/// Checks.
pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if let [folder] = args.files.as_slice()
        && let Some(submissions) = files::submissions(folder)?
    {
        return batch::run(args, exercise, folder, &submissions, reporter);
    }
    let (verdict, evidence, seconds) = check_within(args, exercise)?;
    write(args, &verdict, evidence.as_ref(), seconds)?;
    if reporter.json() {
        reporter.report(&verdict)?;
    } else if args.row.is_none() {
        reporter.text(&text::verdict(&verdict))?;
    }
    Ok(if verdict.verdict == Word::Correct { Outcome::Done } else { Outcome::CheckFailed })
}

/// What a check gives, and how many seconds it took.
type Checked = (Verdict, Option<Evidence>, f64);

/// Checks in a thread of its own: a shader with an endless loop never comes back.
fn check_within(args: &CheckArgs, exercise: &'static Exercise) -> Result<Checked, CliError> {
    let submitted = files::read(&args.files)?;
    let options = gonio_lab::CheckOptions { pair: args.pair.clone(), as_the_lab: args.as_the_lab };
    let es = args.es;
    let (done, checked) = std::sync::mpsc::channel();
    let start = Instant::now();
    let checking = std::thread::spawn(move || {
        let outcome = HeadlessContext::with_options(&HeadlessOptions { es, ..Default::default() })
            .map_err(|why| CliError::new(why.message.replace("; `--backend cpu` needs none", "")))
            .and_then(|context| {
                let mut checker = Checker::new(context.gl());
                let outcome = gonio_lab::check(&mut checker, exercise, submitted, &options)?;
                // As in render: the process ends next.
                std::mem::forget((checker, context));
                Ok(outcome)
            });
        // Whoever waited may have given up.
        let _ = done.send(outcome);
    });
    let seconds = || start.elapsed().as_secs_f64();
    match checked.recv_timeout(Duration::from_secs(args.patience)) {
        Ok(outcome) => {
            // Mesa tidies up at a thread's end and at the process': both at once have been seen to end in a crash.
            let _ = checking.join();
            outcome.map(|(verdict, evidence)| (verdict, evidence, seconds()))
        }
        Err(_) => Ok((Verdict::endless(&exercise.id, args.patience), None, seconds())),
    }
}

fn write(args: &CheckArgs, verdict: &Verdict, evidence: Option<&Evidence>, seconds: f64) -> Result<(), CliError> {
    let label = args.label();
    if let Some(path) = &args.page {
        atomic::write(path, formats::page(&label, verdict, evidence).as_bytes())?;
    }
    if let Some(path) = &args.sheet {
        let evidence = evidence
            .ok_or_else(|| CliError::new(format!("{}: nothing was drawn, so there is no sheet", path.display())))?;
        atomic::write(path, &formats::sheet(evidence, verdict))?;
    }
    if let Some(path) = &args.junit {
        atomic::write(path, formats::junit(&[(label.clone(), verdict.clone())]).as_bytes())?;
    }
    if let Some(path) = &args.gradescope {
        atomic::write(path, formats::gradescope(verdict, args.points).as_bytes())?;
    }
    if let Some(path) = &args.code_runner {
        atomic::write(path, formats::code_runner(verdict).as_bytes())?;
    }
    if let Some(path) = &args.row {
        let row = serde_json::to_vec(&Row::of(&label, verdict, seconds))
            .map_err(|error| CliError::new(format!("the row could not be written: {error}")))?;
        atomic::write(path, &row)?;
    }
    Ok(())
}
