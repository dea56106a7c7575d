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
mod limits;
mod loading;
mod memory;
mod output;
mod overrides;
mod report;
mod values;

use clap::{CommandFactory, Parser};
use report::{CliError, Outcome, Reporter};

fn main() {
    let Some(command) =
        cli::Cli::parse().command.or_else(|| commands::view::alone().map(|args| cli::Command::View(Box::new(args))))
    else {
        std::process::exit(report::help_instead_of_a_window(&mut cli::Cli::command()));
    };
    let reporter = Reporter::new(command.quiet(), command.json());
    let code = match commands::run(&command, &reporter) {
        Ok(Outcome::Done) => 0,
        Ok(Outcome::CheckFailed) => 1,
        Err(CliError::ClosedPipe) => 2,
        Err(error) => {
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
