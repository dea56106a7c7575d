//! The command line as a person sees it: commands, their overview and help. [`crate::options`] has the shared options.

use crate::commands;
use crate::commands::lab::LabCommand;
use crate::commands::lab::format::CheckFormat;
use crate::error::{CliError, CommandOutcome};
use crate::options::{GENERAL, GeneralOptions};
use crate::output::check_folder;
use crate::report::Reporter;
use clap::{Arg, ArgAction, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;

/// The commands by subject. A macro because `concat!` takes literals only.
macro_rules! overview {
    () => {
        "\
Pictures:
  render       Draw a model or a scene: one picture, debug views or an animation
  trace        Trace the paths of light: shadows and light between surfaces
  simplify     Simplify the rendering equation step by step to the light equation
  beyond       Show what the rendering equation leaves out: polarisation, interference, ...
  tour         Draw every technique on several models: a contact sheet and a web page
  serve        Serve gonio as a web page on this machine

Window:
  view         Open the gonio window; also the default without a command

Models:
  convert      Convert a model to OBJ with MTL, PLY or GLB
  unwrap       Give a model new texture coordinates: charts packed into one square
  bake         Bake materials, normals or light into textures for new coordinates

Environments:
  environment  Convert between panoramas and cubemaps; check their orientation

Materials:
  brdf         Models of reflection: plots, checks, exports, fits to measured materials

Exercises:
  lab          Exercises, students' shaders, and a checker that names the mistake
  course       Exercises of your own: write, verify, package for graders
  lsp          Serve an editor: messages of compilers, mistakes at their lines, values of variables

Understanding:
  inspect      Show what a model file contains and how each part was interpreted
  probe        Evaluate the light equation at one pixel, term by term and light by light
  frame        List the OpenGL calls of a frame and what is wrong with them
  diff         Compare two pictures: numbers, difference map, side by side, wipe
  scene        Print the complete effective scene of an input, or the JSON Schema of scene files

About gonio:
  help         Print the help of a command
  completions  Print a completion script for a shell
  man          Print or write the manual pages
  licenses     Print the licences of gonio and its dependencies"
    };
}

/// Lights 3D models with the light equation and shows every term of it at every pixel.
#[derive(Parser, Debug)]
#[command(name = "gonio", bin_name = "gonio", version = commands::about::VERSION, propagate_version = true)]
#[command(help_template = "{about-with-newline}\n{usage-heading} {usage}{after-help}\n\nOptions:\n{options}")]
#[command(after_help = concat!(overview!(), "\n\n`gonio COMMAND -h` lists the options of a command, `gonio help COMMAND` explains them."))]
#[command(after_long_help = concat!(overview!(), "

Examples:
  gonio
  gonio view model.obj
  gonio tour -o tour
  gonio render model.obj -o model.png
  gonio inspect model.obj
  gonio probe model.obj --at 512,384
  gonio frame model.obj
  gonio diff a.png b.png -o map.png

`gonio COMMAND -h` lists the options of a command, `gonio help COMMAND` explains them.

Exit codes: 0 success, 1 a check failed, 2 error. A closed pipe, as in `gonio inspect model.obj | head`, is a success."))]
pub struct Cli {
    /// The command; without one, the window opens.
    #[command(subcommand)]
    pub command: Option<Command>,
}

// A command's help is the doc comment of its options.
#[derive(Subcommand, Debug)]
pub enum Command {
    Render(Box<commands::render::RenderArgs>),
    Trace(Box<commands::trace::TraceArgs>),
    Simplify(Box<commands::simplify::SimplifyArgs>),
    Beyond(Box<commands::beyond::BeyondArgs>),
    Probe(Box<commands::probe::ProbeArgs>),
    Frame(Box<commands::frame::FrameArgs>),
    Bake(Box<commands::bake::BakeArgs>),
    Convert(commands::convert::ConvertArgs),
    /// Exercises of your own: write, verify, package for graders.
    #[command(subcommand)]
    Course(commands::course::CourseCommand),
    /// Convert between panoramas and cubemaps; check their orientation.
    #[command(subcommand)]
    Environment(commands::environment::EnvironmentCommand),
    /// Models of reflection: plots, checks, exports, fits to measured materials.
    #[command(subcommand)]
    Brdf(commands::brdf::BrdfCommand),
    Diff(commands::diff::DiffArgs),
    Inspect(commands::inspect::InspectArgs),
    /// Exercises, students' shaders, and a checker that names the mistake.
    #[command(subcommand)]
    Lab(commands::lab::LabCommand),
    Lsp(commands::lsp::LspArgs),
    Scene(Box<commands::scene::SceneArgs>),
    Serve(commands::serve::ServeArgs),
    Tour(commands::tour::TourArgs),
    Unwrap(commands::unwrap::UnwrapArgs),
    View(Box<commands::view::ViewArgs>),
    Completions(commands::about::CompletionsArgs),
    Man(commands::about::ManArgs),
    Licenses(commands::about::LicensesArgs),
}

impl Command {
    /// The name on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Command::Render(_) => "render",
            Command::Trace(_) => "trace",
            Command::Simplify(_) => "simplify",
            Command::Beyond(_) => "beyond",
            Command::Probe(_) => "probe",
            Command::Frame(_) => "frame",
            Command::Bake(_) => "bake",
            Command::Convert(_) => "convert",
            Command::Course(_) => "course",
            Command::Environment(_) => "environment",
            Command::Brdf(_) => "brdf",
            Command::Diff(_) => "diff",
            Command::Inspect(_) => "inspect",
            Command::Lab(_) => "lab",
            Command::Lsp(_) => "lsp",
            Command::Scene(_) => "scene",
            Command::Serve(_) => "serve",
            Command::Tour(_) => "tour",
            Command::Unwrap(_) => "unwrap",
            Command::View(_) => "view",
            Command::Completions(_) => "completions",
            Command::Man(_) => "man",
            Command::Licenses(_) => "licenses",
        }
    }

    /// The options that every command has.
    pub fn general(&self) -> GeneralOptions {
        let options = match self {
            Command::Render(args) => &args.general,
            Command::Trace(args) => &args.general,
            Command::Simplify(args) => &args.general,
            Command::Beyond(args) => &args.general,
            Command::Probe(args) => &args.general,
            Command::Frame(args) => &args.general,
            Command::Bake(args) => &args.general,
            Command::Convert(args) => &args.general,
            Command::Course(command) => command.general(),
            Command::Environment(command) => command.general(),
            Command::Brdf(command) => command.general(),
            Command::Diff(args) => &args.general,
            Command::Inspect(args) => &args.general,
            Command::Lab(command) => command.general(),
            Command::Lsp(args) => &args.general,
            Command::Scene(args) => &args.general,
            Command::Serve(args) => &args.general,
            Command::Tour(args) => &args.general,
            Command::Unwrap(args) => &args.general,
            Command::View(args) => &args.general,
            Command::Completions(_) | Command::Man(_) | Command::Licenses(_) => return GeneralOptions::default(),
        };
        let mut options = options.clone();
        options.json |= matches!(self, Command::Lab(LabCommand::Check(args)) if args.format == CheckFormat::Json);
        options
    }

    /// Runs the command.
    pub fn run(&self, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
        match self {
            Command::Render(args) => commands::render::run(args, reporter),
            Command::Trace(args) => commands::trace::run(args, reporter),
            Command::Simplify(args) => commands::simplify::run(args, reporter),
            Command::Beyond(args) => commands::beyond::run(args, reporter),
            Command::Probe(args) => commands::probe::run(args, reporter),
            Command::Frame(args) => commands::frame::run(args, reporter),
            Command::Bake(args) => commands::bake::run(args, reporter),
            Command::Convert(args) => commands::convert::run(args, reporter),
            Command::Course(command) => commands::course::run(command, reporter),
            Command::Environment(command) => commands::environment::run(command, reporter),
            Command::Brdf(command) => commands::brdf::run(command, reporter),
            Command::Diff(args) => commands::diff::run(args, reporter),
            Command::Inspect(args) => commands::inspect::run(args, reporter),
            Command::Lab(command) => commands::lab::run(command, reporter),
            Command::Lsp(args) => commands::lsp::run(args, reporter),
            Command::Scene(args) => commands::scene::run(args, reporter),
            Command::Serve(args) => commands::serve::run(args, reporter),
            Command::Tour(args) => {
                check_folder(&args.output, "`gonio tour`")?;
                commands::tour::run(args, reporter)
            }
            Command::Unwrap(args) => commands::unwrap::run(args, reporter),
            Command::View(args) => commands::view::run(args),
            Command::Completions(args) => commands::about::completions(args, &mut self::command()),
            Command::Man(args) => commands::about::man(args, self::command(), reporter),
            Command::Licenses(_) => commands::about::licenses(reporter),
        }
    }
}

/// Parses a command line; the first word is the program's name.
pub fn parse(words: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Cli, clap::Error> {
    let mut command = command();
    let matches = command.try_get_matches_from_mut(words)?;
    Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
}

/// The whole command line, for parsing and for what is generated from it.
pub fn command() -> clap::Command {
    with_help_options(Cli::command(), true)
}

/// Adds `--help` and `--version` under one heading to a command and to all below it, where only the first lists `--version`.
fn with_help_options(command: clap::Command, is_first: bool) -> clap::Command {
    let help = Arg::new("help").short('h').long("help").action(ArgAction::Help).help_heading(GENERAL);
    let help =
        help.help("Print a summary; --help explains everything").long_help("Print this help; -h prints a summary");
    let version = Arg::new("version").short('V').long("version").action(ArgAction::Version).help_heading(GENERAL);
    let version = version
        .help("Print the version; --version prints more")
        .long_help("Print the version; --version adds OpenGL and the web page")
        .hide(!is_first);
    let names: Vec<String> = command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let command = command.disable_help_flag(true).disable_version_flag(true).args([help, version]);
    names
        .into_iter()
        .fold(command, |command, name| command.mut_subcommand(name, |command| with_help_options(command, false)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Every command that is not hidden, with the names that lead to it.
    fn all_commands(command: &clap::Command, path: &str, all: &mut Vec<(String, clap::Command)>) {
        for inner in command.get_subcommands().filter(|inner| !inner.is_hide_set()) {
            let path = format!("{path} {}", inner.get_name());
            all_commands(inner, &path, all);
            all.push((path, inner.clone()));
        }
    }

    fn every_command() -> Vec<(String, clap::Command)> {
        let mut all = Vec::new();
        all_commands(&command(), "gonio", &mut all);
        assert!(all.len() > 20, "{}", all.len());
        all
    }

    fn help_of(words: &[&str]) -> String {
        let Err(help) = parse(words) else { panic!("{words:?} was not a request for help") };
        assert_eq!(help.exit_code(), 0, "{words:?}: {help}");
        help.to_string()
    }

    #[test]
    fn the_options_are_consistent() {
        command().debug_assert();
    }

    #[test]
    fn every_command_has_examples_and_is_in_the_overview() {
        let overview = command().render_long_help().to_string();
        for command in command().get_subcommands() {
            assert!(overview.contains(&format!("\n  {} ", command.get_name())), "{}", command.get_name());
            let after = command.get_after_long_help().map(ToString::to_string).unwrap_or_default();
            assert!(
                after.contains("Examples:") && after.contains(&format!("gonio {}", command.get_name())),
                "{command}"
            );
        }
    }

    /// clap's own command `help` repeats the others and has none.
    #[test]
    fn every_command_has_its_section_in_the_reference() {
        let pages = commands::reference::pages(command());
        for command in command().get_subcommands().filter(|command| command.get_name() != "help") {
            let heading = format!("\n## gonio {}\n", command.get_name());
            assert_eq!(pages.iter().filter(|(_, text)| text.contains(&heading)).count(), 1, "{heading}");
        }
    }

    #[test]
    fn every_option_has_one_of_a_few_headings() {
        const HEADINGS: [&str; 22] = [
            GENERAL,
            "Animation options",
            "Atlas options",
            "Camera options",
            "Check options",
            "Comparison options",
            "Conversion options",
            "Detail options",
            "Drawing options",
            "Environment options",
            "Equation options",
            "Input options",
            "Light options",
            "Limit options",
            "Output options",
            "Picture options",
            "Server options",
            "Shader options",
            "Shading options",
            "Station options",
            "Trace options",
            "Window options",
        ];
        for (path, command) in every_command() {
            for option in command.get_arguments().filter(|arg| !arg.is_positional()) {
                let heading = option.get_help_heading();
                let is_known = heading.is_some_and(|heading| HEADINGS.contains(&heading));
                assert!(option.is_hide_set() || is_known, "{path} --{}: {heading:?}", option.get_id());
            }
        }
    }

    #[test]
    fn short_help_is_short_and_long_help_has_everything() {
        for (path, command) in every_command() {
            let words: Vec<&str> = path.split(' ').collect();
            let help = |flag| help_of(&[&words[..], &[flag]].concat());
            let (short, long) = (help("-h"), help("--help"));
            assert!(short.len() < long.len(), "{path}");
            assert!(!short.contains("Examples:"), "{path}");
            let has_examples = command.get_after_long_help().is_some_and(|text| text.to_string().contains("Examples:"));
            assert_eq!(long.contains("Examples:"), has_examples, "{path}");
            // `gonio help COMMAND` prints the same as `gonio COMMAND --help`.
            let with_help = [&words[..1], &["help"], &words[1..]].concat();
            assert_eq!(help_of(&with_help), long, "{path}");
        }
        assert!(help_of(&["gonio", "help"]).contains("Examples:") && !help_of(&["gonio", "-h"]).contains("Examples:"));
    }

    /// A line break within a sentence of the source would remain in the help, which wraps again at the terminal's width.
    #[test]
    fn help_is_wrapped_once() {
        for (path, command) in every_command() {
            let Some(text) = command.get_after_long_help().map(ToString::to_string) else { continue };
            for (line, next) in text.lines().zip(text.lines().skip(1)) {
                let indentation = |line: &str| line.len() - line.trim_start().len();
                let is_wrapped = line.len() > 60
                    && !next.is_empty()
                    && indentation(line) == indentation(next)
                    && !line.ends_with(['.', ':'])
                    && !next.trim_start().starts_with("gonio ");
                assert!(!is_wrapped, "gonio {path}: a line ends within a sentence: {line}");
            }
        }
    }
}
