//! `gonio lab check`: the verdict about a student's answer, or about those of a class.

use super::format::{self, CheckFormat};
use super::intake::{self, GatheredFiles, Intake, Submissions};
use super::{batch, child_process, exercise, watch};
use crate::backend;
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions, values};
use crate::output::{OutputFiles, OutputKind, OutputPath, check_folder, check_stdout};
use crate::report::Reporter;

use clap::Args;
use gonio_app::platform::desktop::worker::{self, WorkerAnswer, WorkerRequest};
use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::verdict::Outcome as Word;
use gonio_exercises::exercise::Exercise;
use gonio_exercises::report;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Check a student's answer: what is right, what is wrong, and the mistake's name and line.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio lab check ex04 mine
  gonio lab check ex07 light.vert light.frag --page verdict.html
  gonio lab check ex09 main.cpp --json
  gonio lab check ex04 mine --watch
      Checks again whenever a file changes, until Ctrl-C.
  gonio lab check ex04 mine --format gcc
      The mistakes as a compiler's messages, for an editor.
  gonio lab check ex02 cube.csv
  gonio lab check ex07 mine --feedback verdict
      Only whether it is right, and in which test scenes.
  gonio lab check ex07 submissions -o results
      Each folder and each zip in `submissions` is one submission; the results are a page for each, a table (.csv) and an overview \
(index.html) with pictures, which sorts by any column. Submissions that have not changed since the last check are not checked again. A zip of the whole class works too, and so do the \
downloads of Moodle, Canvas, Blackboard and Brightspace, in folders or flat.

Any names and extensions work, and any `#version`. The checker recognises attributes and uniforms by the words in their names and by \
their types; a file names.toml beside the shaders can state the rest.

Exit codes: 0 correct, 1 not correct, 2 error.")]
pub struct CheckArgs {
    /// Exercise: ex04, or 4.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// The student's files, or their folder or zip; or a folder of such folders and zips.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Pair of shaders to check, by the name of a file or variable, if there are several.
    #[arg(long, value_name = "NAME", help_heading = "Check options")]
    pub pair: Option<String>,
    /// Accept what the lab's own solutions do where they differ from the textbook.
    #[arg(long, help_heading = "Check options")]
    pub as_the_lab: bool,
    /// How much to show: right or wrong alone, also the mistakes' names, also their lines and what belongs there, also the change
    /// that makes it right. By default as the exercise states: line.
    #[arg(long, value_name = "LEVEL", value_parser = values::named(&Feedback::ALL, Feedback::word),
          help_heading = "Check options")]
    pub feedback: Option<Feedback>,
    /// Number of submissions in the files, instead of deciding by names and contents.
    #[arg(long, value_name = "NUMBER", default_value = "auto", help_heading = "Check options")]
    pub submissions: Submissions,
    /// Check again whenever a file changes, until Ctrl-C.
    #[arg(long, help_heading = "Check options")]
    pub watch: bool,
    /// Time limit of a check, in seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=86_400),
          help_heading = "Check options")]
    pub patience: u64,
    /// Form of the verdict on stdout: for people, one JSON object (as --json), the same text with workflow commands for GitHub
    /// Actions, SARIF 2.1.0, or one line for each message, as compilers print them.
    #[arg(long, value_name = "FORMAT", value_parser = values::named(&CheckFormat::ALL, CheckFormat::word),
          default_value = "text", help_heading = "Output options")]
    pub format: CheckFormat,
    /// Folder for the pages, table and overview of many submissions.
    ///
    /// It must be outside the submissions; by default it is created beside them.
    #[arg(long, short, value_name = "FOLDER", help_heading = "Output options")]
    pub output: Option<PathBuf>,
    /// Write the verdict as a web page with pictures; - is stdout.
    #[arg(long, visible_alias = "html", value_name = "FILE.html", help_heading = "Output options")]
    pub page: Option<OutputPath>,
    /// Write the pictures: the student's, the reference's, the difference, the mistake's; one column per scene.
    #[arg(long, value_name = "FILE.png", help_heading = "Output options")]
    pub sheet: Option<OutputPath>,
    /// Write the verdict, or those of many submissions, as JUnit XML.
    #[arg(long, value_name = "FILE.xml", help_heading = "Output options")]
    pub junit: Option<OutputPath>,
    /// Write the verdict as Gradescope's results.json.
    #[arg(long, value_name = "FILE.json", help_heading = "Output options")]
    pub gradescope: Option<OutputPath>,
    /// Write the verdict as JSON for Moodle's CodeRunner.
    #[arg(long, value_name = "FILE.json", help_heading = "Output options")]
    pub code_runner: Option<OutputPath>,
    /// Write the verdict as JSON for GitHub Classroom's autograding reporter.
    #[arg(long, value_name = "FILE.json", help_heading = "Output options")]
    pub classroom: Option<OutputPath>,
    /// Points for a correct answer, in the files for Gradescope and GitHub Classroom and in the table and overview of many
    /// submissions. By default as the exercise states, else 100.
    #[arg(long, value_name = "N", value_parser = values::not_negative, help_heading = "Output options")]
    pub points: Option<f64>,
    /// Check with OpenGL ES 3, as a browser does, instead of OpenGL.
    #[arg(long, hide = true)]
    pub es: bool,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

impl CheckArgs {
    /// The label of the submission: the name of the first folder or file.
    fn label(&self) -> String {
        let first = self.files.first().map_or(Path::new("submission"), PathBuf::as_path);
        first.file_stem().map_or_else(|| "submission".to_owned(), |name| name.to_string_lossy().into_owned())
    }

    /// The options for files about a single submission.
    fn options_of_one(&self) -> impl Iterator<Item = &'static str> {
        let options = [
            ("--page", self.page.is_some()),
            ("--sheet", self.sheet.is_some()),
            ("--gradescope", self.gradescope.is_some()),
            ("--code-runner", self.code_runner.is_some()),
            ("--classroom", self.classroom.is_some()),
        ];
        options.into_iter().filter(|(_, is_used)| *is_used).map(|(option, _)| option)
    }

    /// The files that the command writes, none of which is an answer.
    fn output_files(&self) -> impl Iterator<Item = PathBuf> {
        let outputs = [&self.page, &self.sheet, &self.junit, &self.gradescope, &self.code_runner, &self.classroom];
        outputs.into_iter().flatten().filter_map(OutputPath::file).map(Path::to_owned)
    }

    /// The request for a worker process, without a page and a sheet.
    pub fn request(&self, exercise: &Exercise, gathered: GatheredFiles) -> WorkerRequest {
        WorkerRequest {
            exercise: exercise.id.clone(),
            files: gathered.files,
            left_out: gathered.left_out.iter().map(|what| format!("ignored: {what}")).collect(),
            options: CheckOptions { pair: self.pair.clone(), as_the_lab: self.as_the_lab },
            feedback: self.feedback,
            es: self.es,
            page: None,
            sheet: false,
        }
    }

    /// The points of a correct answer.
    pub fn most_points(&self, exercise: &Exercise) -> f64 {
        let stated = exercise.points.as_ref().map(|scheme| scheme.total);
        self.points.or(stated).unwrap_or(100.0)
    }

    /// The time limit of a check.
    pub fn patience(&self) -> Duration {
        Duration::from_secs(self.patience)
    }
}

pub fn run(args: &CheckArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    if let Some(folder) = &args.output {
        check_folder(folder, "-o")?;
    }
    if let (Some(_), false) = (&args.sheet, exercise.shows_reference) {
        return Err(CliError::new(format!(
            "--sheet shows the pictures of the reference solution of {}, which is not shown in this course, as its \
             exercise.toml states",
            exercise.id
        )));
    }
    let texts = [&args.page, &args.junit, &args.gradescope, &args.code_runner, &args.classroom].into_iter().flatten();
    let texts = texts.map(|output| (output, OutputKind::Text));
    let is_stdout_taken = check_stdout(texts.chain(args.sheet.iter().map(|o| (o, OutputKind::Binary))), reporter)?;
    args.format.check(args.general.json, is_stdout_taken)?;
    // A folder for results is for those of a class, even a class of one.
    let as_class = args.output.is_some() || args.submissions == Submissions::Many;
    match intake::take(&args.files, exercise, args.submissions, as_class)? {
        Intake::Class(class) => {
            if let Some(option) = args.options_of_one().next() {
                return Err(CliError::new(format!(
                    "{option} writes the verdict of one submission, and these are {}; -o names a folder for a page of each, \
                     a table and an overview",
                    class.submissions.len()
                )));
            }
            let of_one = [("--watch", args.watch), ("--format", args.format.lists_places())];
            if let Some((option, _)) = of_one.into_iter().find(|(_, is_used)| *is_used) {
                return Err(CliError::new(format!(
                    "{option} is for the files of one submission, and these are {} submissions",
                    class.submissions.len()
                )));
            }
            batch::run(args, exercise, &class, reporter)
        }
        Intake::One(gathered) => {
            for file in &gathered.files {
                reporter.verbose(format_args!("read `{}`, {} bytes", file.name, file.bytes.len()));
            }
            backend::report_driver(reporter);
            let check = |gathered, given_up: &dyn Fn() -> bool| {
                check_one(args, exercise, gathered, is_stdout_taken, given_up, reporter)
            };
            match args.watch {
                true => watch::run(&args.files, args.output_files(), reporter, |given_up| {
                    check(intake::gather_files(&args.files)?, given_up)
                }),
                false => check(gathered, &|| false),
            }
        }
    }
}

/// Checks one submission, in a process of its own.
fn check_one(
    args: &CheckArgs,
    exercise: &Exercise,
    gathered: GatheredFiles,
    is_stdout_taken: bool,
    given_up: &dyn Fn() -> bool,
    reporter: &Reporter,
) -> Result<CommandOutcome, CliError> {
    let label = args.label();
    let mut request = args.request(exercise, gathered);
    request.page = args.page.is_some().then(|| label.clone());
    request.sheet = args.sheet.is_some();
    let program = child_process::own_program()?;
    let not_started = |error| CliError::io("gonio cannot start itself for a check", &error);
    let mut worker = worker::start(&program, request, false).map_err(not_started)?;
    let answer = worker.wait(args.patience(), given_up).map_err(CliError::new)?;
    if given_up() {
        // Ctrl-C ended the worker too, which is no crash.
        return Ok(CommandOutcome::Done);
    }
    write(args, exercise, &label, &answer)?;
    format::print(args.format, &args.files, &answer.verdict, is_stdout_taken, reporter)?;
    Ok(if answer.verdict.verdict == Word::Correct { CommandOutcome::Done } else { CommandOutcome::CheckFailed })
}

fn write(
    args: &CheckArgs,
    exercise: &Exercise,
    label: &str,
    WorkerAnswer { verdict, page, sheet, .. }: &WorkerAnswer,
) -> Result<(), CliError> {
    let mut files = OutputFiles::new();
    if let Some(output) = &args.page {
        // The check that makes the pictures may have been stopped.
        let page = page.clone().unwrap_or_else(|| report::page(label, verdict, None, &[]).into_bytes());
        files.add_output(output, page)?;
    }
    if let Some(output) = &args.sheet {
        let nothing = || CliError::new(format!("{output}: nothing was drawn, so there is no sheet"));
        files.add_output(output, sheet.clone().ok_or_else(nothing)?)?;
    }
    if let Some(output) = &args.junit {
        files.add_output(output, report::junit(&[(label.to_owned(), verdict.clone())]).into_bytes())?;
    }
    if let Some(output) = &args.gradescope {
        files.add_output(output, report::gradescope(verdict, args.most_points(exercise)).into_bytes())?;
    }
    if let Some(output) = &args.classroom {
        files.add_output(output, report::classroom(verdict, args.most_points(exercise)).into_bytes())?;
    }
    if let Some(output) = &args.code_runner {
        files.add_output(output, report::code_runner(verdict).into_bytes())?;
    }
    files.commit()
}
