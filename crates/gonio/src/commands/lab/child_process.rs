//! Processes of gonio's own, which a shader may crash.
//!
//! A command runs again in one, and `gonio lab check-worker` is the one that a check runs in (see
//! [`gonio_app::platform::desktop::worker`]).

use super::exercise;
use crate::error::{CliError, CommandOutcome};
use crate::report;
use gonio_app::platform::desktop::child;
use gonio_app::platform::desktop::worker::{self, Answer, Request};
use gonio_exercises::Checker;
use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Stdio;
use std::time::Duration;

/// Seconds that it may take; an endless loop takes more.
const PATIENCE_S: u64 = 30;

/// Runs this program with its own arguments and `flag` after the command's name of two words. The process prints and writes by
/// itself; the error here is that it was stopped or crashed.
pub fn run_again(flag: &str) -> Result<CommandOutcome, CliError> {
    let not_started = |error| CliError::io("gonio cannot start itself", &error);
    let mut arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    arguments.insert(arguments.len().min(2), flag.into());
    let mut command = child::command(&own_program()?).map_err(not_started)?;
    command.env_remove("LP_NUM_THREADS").args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::inherit()).stderr(Stdio::inherit());
    let mut child = command.spawn().map_err(not_started)?;
    // Its stdin stays open as long as this process waits.
    let ended = child::wait(&mut child, Duration::from_secs(PATIENCE_S), || false);
    match ended.map_err(|error| CliError::io("cannot wait for gonio's own process", &error))? {
        child::Ended::ByItself(status) => match status.code() {
            Some(0) => Ok(CommandOutcome::Done),
            Some(1) => Ok(CommandOutcome::CheckFailed),
            Some(2) => Err(CliError::AlreadyReported),
            _ => Err(CliError::new("drawing crashed: the graphics driver cannot compile or run this shader")),
        },
        child::Ended::TooLong => Err(CliError::new(format!(
            "drawing did not finish within {PATIENCE_S} seconds; does a shader contain an endless loop?"
        ))),
        child::Ended::TooLarge => Err(CliError::new(
            "drawing took more than a gigabyte of memory and was stopped; does a shader contain a giant array?",
        )),
        child::Ended::GivenUp => Err(CliError::new("drawing was stopped")),
    }
}

/// Ends this process when the one that waits for it has ended.
pub fn end_with_the_caller() {
    std::thread::spawn(|| worker::end_with(std::io::stdin()));
}

/// Stack of the thread that reads, compiles and draws: drivers recurse along the shader. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;

/// Reads one request from stdin and writes one answer to stdout.
pub fn check_worker() -> Result<CommandOutcome, CliError> {
    let failed = |error| CliError::io("cannot answer the check", &error);
    worker::serve(std::io::stdin(), report::output_for_gonio(), |request| {
        let checking = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(move || check(request));
        let checking = checking.map_err(|error| format!("cannot start the check: {error}"))?;
        // The panic has been reported on stderr; without an answer the process counts as crashed.
        checking.join().unwrap_or_else(|_| std::process::abort())
    })
    .map_err(failed)?;
    Ok(CommandOutcome::Done)
}

fn check(request: Request) -> Result<Answer, String> {
    let exercise = exercise(&request.exercise).map_err(|error| error.to_string())?;
    let context = HeadlessContext::with_options(&HeadlessOptions { es: request.es, ..Default::default() })
        .map_err(|why| why.message)?;
    let mut checker = Checker::new(context.gl());
    let (mut verdict, evidence) = gonio_exercises::check(&mut checker, exercise, request.files, &request.options)
        .map_err(|error| CliError::from(error).to_string())?;
    // The process ends next, and the system frees it faster.
    std::mem::forget((checker, context));
    verdict.warnings.extend(request.left_out);
    let page =
        request.page.map(|label| gonio_exercises::report::page(&label, &verdict, evidence.as_ref()).into_bytes());
    let sheet =
        evidence.filter(|_| request.sheet).map(|evidence| gonio_exercises::report::contact_sheet(&evidence, &verdict));
    Ok(Answer { verdict, page, sheet })
}

/// gonio's own program, for processes that a shader may crash.
pub fn own_program() -> Result<PathBuf, CliError> {
    std::env::current_exe().map_err(|error| CliError::io("cannot find gonio's own program", &error))
}
