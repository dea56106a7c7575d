//! `gonio`: the light lab's command line.
//!
//! Thin: options in, a call into the libraries, words and files out. [`report`] is the only place that
//! prints. Exit codes: 0 done, 1 a check that was asked for failed, 2 an error (a closed stdout too,
//! silently).

mod backend;
mod capture;
mod cli;
mod cli_environment;
mod commands;
mod escapes;
mod hints;
mod limits;
mod loading;
mod memory;
mod output;
mod overrides;
mod page;
mod report;
mod values;

use clap::{CommandFactory, Parser};
use report::{CliError, Outcome, Reporter};

fn main() {
    std::panic::set_hook(Box::new(report::panicked));
    let arguments = match cli::Cli::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => std::process::exit(report::refused_arguments::<cli::Cli>(&error)),
    };
    let Some(command) =
        arguments.command.or_else(|| commands::view::alone().map(|args| cli::Command::View(Box::new(args))))
    else {
        std::process::exit(report::help_instead_of_a_window(&mut cli::Cli::command()));
    };
    let reporter = Reporter::new(command.quiet(), command.json());
    // A panic was reported by the hook, and is an error like any other.
    let ended = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| commands::run(&command, &reporter)));
    let code = match ended {
        Ok(Ok(Outcome::Done)) => 0,
        Ok(Ok(Outcome::CheckFailed)) => 1,
        Err(_) | Ok(Err(CliError::ClosedPipe | CliError::AlreadySaid)) => 2,
        Ok(Err(error)) => {
            reporter.error(&error);
            if reporter.json() {
                // stdout may be what failed; the sentence on stderr has been said.
                let report = serde_json::json!({ "command": command.name(), "error": error.to_string() });
                let _ = reporter.report(&report);
            }
            2
        }
    };
    // No tearing down of contexts and thread pools: the system does that faster.
    std::process::exit(code);
}
