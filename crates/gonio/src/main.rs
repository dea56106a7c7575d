//! `gonio`: the light lab's command line.
//!
//! Each command turns options into calls of the libraries, and their results into reports and files. [`report`] is the only
//! module that prints. Exit codes: 0 success (also if the reader of stdout has gone), 1 a requested check failed, 2 error.

mod backend;
mod capture;
mod cli;
mod commands;
mod error;
mod loading;
mod options;
mod output;
mod report;
mod terminal;
mod user_drawing;

use clap::error::ErrorKind;
use error::{CliError, CommandOutcome};
use gonio_language::Language;
use report::Reporter;
use std::time::Instant;

fn main() {
    let start = Instant::now();
    std::panic::set_hook(Box::new(report::print_panic));
    let arguments = match cli::parse(std::env::args_os()) {
        Ok(arguments) => arguments,
        Err(error)
            if error.kind() == ErrorKind::DisplayVersion && std::env::args_os().any(|word| word == "--version") =>
        {
            std::process::exit(exit_code(
                &report::write_stdout(commands::about::version().as_bytes()).map(|()| CommandOutcome::Done),
            ));
        }
        Err(error) => std::process::exit(report::print_usage_error(&error, |words| cli::parse(words).err())),
    };
    let Some(command) =
        arguments.command.or_else(|| commands::view::alone().map(|args| cli::Command::View(Box::new(args))))
    else {
        std::process::exit(report::print_help_without_display(&mut cli::command()));
    };
    let reporter = Reporter::new(&command.general());
    command.general().language.unwrap_or_else(Language::of_system).make_current();
    // The hook has reported a panic, which is an error like any other.
    let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| command.run(&reporter)))
        .unwrap_or(Err(CliError::AlreadyReported));
    if let Err(error) = &result
        && !matches!(error, CliError::ClosedPipe | CliError::AlreadyReported)
    {
        reporter.error(error);
        if reporter.json() {
            // If stdout itself failed, the message on stderr must suffice.
            let report = serde_json::json!({ "command": command.name(), "error": error.to_string() });
            let _ = reporter.report(&report);
        }
    }
    reporter.verbose(format_args!("{} took {:.1} ms", command.name(), start.elapsed().as_secs_f64() * 1e3));
    // The system frees contexts and thread pools faster.
    std::process::exit(exit_code(&result));
}

fn exit_code(result: &Result<CommandOutcome, CliError>) -> i32 {
    match result {
        // The reader of stdout has stopped, as in `gonio inspect model.obj | head`.
        Ok(CommandOutcome::Done) | Err(CliError::ClosedPipe) => 0,
        Ok(CommandOutcome::CheckFailed) => 1,
        Err(_) => 2,
    }
}
