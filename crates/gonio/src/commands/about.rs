//! `gonio completions`, `gonio man`, `gonio licenses` and `gonio --version`.

use crate::backend::{self, driver_line};
use crate::commands::{reference, serve};
use crate::error::{CliError, CommandOutcome};
use crate::options::BackendOptions;
use crate::output::{OutputFiles, OutputPath};
use crate::report::{self, Reporter};
use crate::terminal::TerminalPage;
use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man;
use std::io;

/// The version and, where gonio was built from its repository, the commit and its date.
pub const VERSION: &str = env!("GONIO_VERSION");

/// The notices of third parties, made by `cargo xtask licenses`.
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
      Writes gonio.1, gonio-render.1, gonio-lab-check.1 and so on; then `man gonio-render` works.
  gonio man --markdown reference
      Writes the reference of gonio's book: commands, exercises, mistakes, models.")]
pub struct ManArgs {
    /// Folder to write the pages of all commands to; without it, or as -, gonio(1) goes to stdout.
    #[arg(value_name = "DIR")]
    pub folder: Option<OutputPath>,
    /// Write the reference of gonio's book, in Markdown, in place of manual pages.
    #[arg(long, help_heading = "Output options", requires = "folder")]
    pub markdown: bool,
}

/// Print the licences of gonio and its dependencies.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio licenses | less
  gonio licenses > THIRD-PARTY.txt")]
pub struct LicensesArgs {}

/// Prints the script for `command`, the whole command line.
pub fn completions(args: &CompletionsArgs, command: &mut clap::Command) -> Result<CommandOutcome, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, command, "gonio", &mut script);
    report::write_stdout(&script)?;
    Ok(CommandOutcome::Done)
}

/// Prints or writes the manual pages of `command`, the whole command line.
pub fn man(args: &ManArgs, mut command: clap::Command, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    command.build();
    let Some(folder) = args.folder.as_ref().and_then(OutputPath::file) else {
        if args.markdown {
            return Err(CliError::new("the reference is several files: name a folder for them, not -"));
        }
        report::write_stdout(&manual_page(command)?)?;
        return Ok(CommandOutcome::Done);
    };
    let mut pages = Vec::new();
    if args.markdown {
        pages.extend(reference::pages(command).into_iter().map(|(name, text)| (name, text.into_bytes())));
    } else {
        manual_pages(command, &mut pages)?;
    }
    let mut files = OutputFiles::new();
    files.make_folder(folder)?;
    for (name, page) in &pages {
        files.add(&folder.join(name), page)?;
    }
    files.commit()?;
    let kind = if args.markdown { "pages of the reference" } else { "manual pages" };
    reporter.note(format!("wrote {} {kind} to `{}`", pages.len(), folder.display()));
    Ok(CommandOutcome::Done)
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

pub fn licenses(reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    reporter.text(&TerminalPage::from_text(THIRD_PARTY))?;
    Ok(CommandOutcome::Done)
}

/// The text of `--version`: the version, the OpenGL of this machine, and whether this program contains the web page.
pub fn version() -> String {
    let opengl = match backend::find_driver(&BackendOptions::default()) {
        Ok(driver) => driver_line(&driver),
        Err(error) => format!("none: {}", backend::first_line(&error)),
    };
    let page = if serve::has_embedded_page() { "embedded" } else { "not embedded" };
    format!("gonio {VERSION}\nOpenGL: {opengl}\nWeb page: {page}\n")
}
