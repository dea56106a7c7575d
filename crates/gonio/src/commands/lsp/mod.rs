//! `gonio lsp`: a language server, through which editors show what gonio knows of a student's shaders.
//!
//! | thread | work |
//! |---|---|
//! | reader, writer | `lsp-server`'s: messages on stdin and stdout |
//! | server | documents, gonio's own front end, diagnostics: milliseconds |
//! | one for each check | waits for a worker process, which a shader may crash or keep busy |
//! | hover | runs the shaders on the CPU, within a bound |
//!
//! Everything that takes longer is cancelled or dropped when its text changes.

mod check;
mod diagnostics;
mod document;
mod fix;
mod hover;
mod positions;
mod server;
mod sources;
mod uri;

use super::lab::child_process;
use crate::commands::course::folder;
use crate::error::{CliError, CommandOutcome};
use crate::options::{CourseOptions, GeneralOptions, values};
use crate::report::Reporter;
use clap::Args;
use gonio_check::feedback::Feedback;
use gonio_exercises::exercise::Exercise;
use std::io::IsTerminal;
use std::path::PathBuf;
use std::time::Duration;

/// Serve an editor: messages of compilers, mistakes at their lines, values of variables.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio lsp
      An editor starts it, and speaks the Language Server Protocol on its stdin and stdout.
  gonio lsp --feedback fix
      With the change that makes the shaders right, as a quick fix.
  gonio lsp --exercise ex04
      For folders of any name.

The exercise of a folder is the one that its names.toml states (exercise = \"ex04\"), else that of its text.md, which `gonio lab start` \
writes, else the one in the folder's name (ex04-mine). Folders further up are tried too. Shaders without an exercise get messages of \
gonio's own compiler.

Exit codes: 0 the editor ended it, 1 it ended without `shutdown`, 2 error.")]
pub struct LspArgs {
    /// Exercise of every shader, instead of the one that its folder is for: ex04, or 4.
    #[arg(long, value_name = "EX", help_heading = "Check options")]
    pub exercise: Option<String>,
    /// How much to show, as for `gonio lab check`. By default as the exercise states: line.
    #[arg(long, value_name = "LEVEL", value_parser = values::named(&Feedback::ALL, Feedback::word),
          help_heading = "Check options")]
    pub feedback: Option<Feedback>,
    /// Time limit of a check, in seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=86_400),
          help_heading = "Check options")]
    pub patience: u64,
    #[command(flatten)]
    pub course: CourseOptions,
    /// Speak on stdin and stdout, which it does anyway; some editors add it.
    #[arg(long, hide = true)]
    pub stdio: bool,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// What the command line states.
struct LspOptions {
    exercise: Option<&'static Exercise>,
    feedback: Option<Feedback>,
    patience: Duration,
    /// gonio's own program, for checks.
    program: PathBuf,
    has_language: bool,
}

/// Stack of the server's thread, which parses shaders.
const STACK_BYTES: usize = 64 << 20;

pub fn run(args: &LspArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    // An editor needs the messages of compilers also while a teacher edits the course.
    if let Err(error) = folder::install(&args.course, reporter) {
        reporter.warning(error.to_string());
    }
    let options = LspOptions {
        exercise: args.exercise.as_deref().map(super::lab::exercise).transpose()?,
        feedback: args.feedback,
        patience: Duration::from_secs(args.patience),
        program: child_process::own_program()?,
        has_language: args.general.language.is_some(),
    };
    if std::io::stdin().is_terminal() {
        reporter
            .note("an editor starts `gonio lsp`, and speaks the Language Server Protocol with it on stdin and stdout");
    }
    let (connection, threads) = lsp_server::Connection::stdio();
    let server = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(move || server::serve(connection, options));
    let server = server.map_err(|error| CliError::io("cannot start the server", &error))?;
    let outcome = server.join().unwrap_or(Err(CliError::AlreadyReported))?;
    // After `exit`, the reader has ended. Otherwise stdin has, or a message was damaged.
    if outcome == server::ServerEnd::WithoutExit {
        threads.join().map_err(|error| CliError::io("cannot read the editor's messages", &error))?;
    }
    Ok(match outcome {
        server::ServerEnd::AfterShutdown => CommandOutcome::Done,
        // The protocol asks for exit code 1.
        server::ServerEnd::BeforeShutdown | server::ServerEnd::WithoutExit => CommandOutcome::CheckFailed,
    })
}
