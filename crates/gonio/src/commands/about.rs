//! `gonio completions`, `gonio man` and `gonio licenses`: what gonio tells about itself.

use crate::cli;
use crate::output::{FileSet, OutputPath};
use crate::page::Page;
use crate::report::{self, CliError, Outcome, Reporter};
use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man;
use std::io;

/// Notices about everything in this program that others wrote, made by `cargo xtask licenses`.
const THIRD_PARTY: &str = include_str!("../../THIRD-PARTY.txt");

/// Print a completion script for a shell.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio completions bash > ~/.local/share/bash-completion/completions/gonio
  gonio completions zsh > ~/.zfunc/_gonio
      The folder must be in `fpath` before `compinit` runs.
  gonio completions fish > ~/.config/fish/completions/gonio.fish
  gonio completions powershell >> $PROFILE")]
pub struct CompletionsArgs {
    /// The shell.
    pub shell: Shell,
}

/// Print the manual page, or write those of all commands.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio man | man -l -
  gonio man ~/.local/share/man/man1
      Writes gonio.1, gonio-render.1, gonio-lab-check.1 and so on; then `man gonio-render` works.")]
pub struct ManArgs {
    /// Folder to write the pages of all commands to; without it, or as -, gonio(1) goes to stdout.
    #[arg(value_name = "DIR")]
    pub folder: Option<OutputPath>,
}

/// Print the licences of gonio and of everything in it.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio licenses | less
  gonio licenses > THIRD-PARTY.txt")]
pub struct LicensesArgs {}

pub fn completions(args: &CompletionsArgs) -> Result<Outcome, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut cli::command(), "gonio", &mut script);
    report::write_stdout(&script)?;
    Ok(Outcome::Done)
}

pub fn man(args: &ManArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let mut command = cli::command();
    command.build();
    let Some(folder) = args.folder.as_ref().and_then(OutputPath::file) else {
        report::write_stdout(&manual_page(command)?)?;
        return Ok(Outcome::Done);
    };
    let mut pages = Vec::new();
    manual_pages(command, &mut pages)?;
    let mut files = FileSet::new();
    files.make_folder(folder)?;
    for (name, page) in &pages {
        files.add(&folder.join(name), page)?;
    }
    files.commit()?;
    reporter.note(format!("wrote {} manual pages to `{}`", pages.len(), folder.display()));
    Ok(Outcome::Done)
}

/// The pages of a command and of those below it, each with the name of its file.
fn manual_pages(command: clap::Command, pages: &mut Vec<(String, Vec<u8>)>) -> Result<(), CliError> {
    let inner: Vec<clap::Command> =
        command.get_subcommands().filter(|inner| !inner.is_hide_set() && inner.get_name() != "help").cloned().collect();
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
    pages.push((format!("{name}.1"), manual_page(command)?));
    inner.into_iter().try_for_each(|inner| manual_pages(inner, pages))
}

fn manual_page(command: clap::Command) -> Result<Vec<u8>, CliError> {
    let mut page = Vec::new();
    let rendered: io::Result<()> = Man::new(command).render(&mut page);
    rendered.map_err(|error| CliError::io("the manual page cannot be made", &error))?;
    Ok(page)
}

pub fn licenses(reporter: &Reporter) -> Result<Outcome, CliError> {
    reporter.text(&Page::from_text(THIRD_PARTY))?;
    Ok(Outcome::Done)
}
