//! The command line as a person sees it: commands, shared options and help.

use crate::backend::BackendChoice;
use crate::cli_environment::EnvironmentOptions;
use crate::commands;
use crate::memory;
use crate::report::Reporter;
use crate::values::{self, BackgroundValue};
use clap::{Arg, ArgAction, Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use gonio_light::brdf::BrdfKind;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::{Convention, Specular};
use gonio_mesh::Limits;
use gonio_scene::TextureFilter;
use gonio_scene::ViewSpec;
use gonio_scene::files::{Budgeted, DiskAndInput, FileSource, Sandbox};
use gonio_scene::scene_file::{LightSpec, MaterialOverride, Normals, Shading};
use std::ffi::OsString;

/// The commands by subject. A macro because `concat!` takes literals only.
macro_rules! overview {
    () => {
        "\
Pictures:
  render       Draw a model or a scene: one picture, debug views or an animation
  tour         Draw every technique on several models: a contact sheet and a web page
  serve        Serve the lab as a web page to this machine

Window:
  view         Open the gonio window; also the default without a command

Models:
  convert      Convert a model to OBJ with MTL, PLY or GLB

Environments:
  environment  Convert panoramas and cubemaps into one another; check their orientation

Laboratory:
  lab          Exercises, students' shaders, and a checker that names the mistake

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
  licenses     Print the licences of gonio and of everything in it"
    };
}

/// Lights 3D models with the light equation and shows every term of it at every pixel.
#[derive(Parser, Debug)]
#[command(name = "gonio", bin_name = "gonio", version = crate::version::SHORT, propagate_version = true)]
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
    Probe(Box<commands::probe::ProbeArgs>),
    Frame(Box<commands::frame::FrameArgs>),
    Convert(commands::convert::ConvertArgs),
    /// Convert panoramas and cubemaps into one another; check their orientation.
    #[command(subcommand)]
    Environment(commands::environment::EnvironmentCommand),
    Diff(commands::diff::DiffArgs),
    Inspect(commands::inspect::InspectArgs),
    /// Exercises, students' shaders, and a checker that names the mistake.
    #[command(subcommand)]
    Lab(commands::lab::LabCommand),
    Scene(Box<commands::scene::SceneArgs>),
    Serve(commands::serve::ServeArgs),
    Tour(commands::tour::TourArgs),
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
            Command::Probe(_) => "probe",
            Command::Frame(_) => "frame",
            Command::Convert(_) => "convert",
            Command::Environment(_) => "environment",
            Command::Diff(_) => "diff",
            Command::Inspect(_) => "inspect",
            Command::Lab(_) => "lab",
            Command::Scene(_) => "scene",
            Command::Serve(_) => "serve",
            Command::Tour(_) => "tour",
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
            Command::Probe(args) => &args.general,
            Command::Frame(args) => &args.general,
            Command::Convert(args) => &args.general,
            Command::Environment(command) => command.general(),
            Command::Diff(args) => &args.general,
            Command::Inspect(args) => &args.general,
            Command::Lab(command) => command.general(),
            Command::Scene(args) => &args.general,
            Command::Serve(args) => &args.general,
            Command::Tour(args) => &args.general,
            Command::View(args) => &args.general,
            Command::Completions(_) | Command::Man(_) | Command::Licenses(_) => return GeneralOptions::default(),
        };
        options.clone()
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
        .help("Print the version; --version tells more")
        .long_help("Print the version; --version adds OpenGL and the web page")
        .hide(!is_first);
    let names: Vec<String> = command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let command = command.disable_help_flag(true).disable_version_flag(true).args([help, version]);
    names
        .into_iter()
        .fold(command, |command, name| command.mut_subcommand(name, |command| with_help_options(command, false)))
}

const GENERAL: &str = "General options";

/// The options that every command has.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = GENERAL)]
pub struct GeneralOptions {
    /// Print one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long, short)]
    pub quiet: bool,
    /// Report the driver, the files read and timings on stderr.
    #[arg(long, short, conflicts_with = "quiet")]
    pub verbose: bool,
}

/// Which renderer draws, and how.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Drawing options")]
pub struct BackendOptions {
    /// Renderer: OpenGL, the CPU reference, or OpenGL where available.
    #[arg(long, value_parser = values::named(BackendChoice::ALL, BackendChoice::name), default_value = "auto")]
    pub backend: BackendChoice,
    /// Threads of the CPU reference; all cores by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Load OpenGL's EGL from this library instead of the system's (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub egl_library: Option<String>,
}

/// Options that replace values of a scene. The same for every command that reads one.
#[derive(Args, Debug, Clone, Default)]
pub struct SceneOptions {
    /// Where the equation is evaluated.
    ///
    /// flat: at each pixel, with one normal per triangle; flat-per-face: once per triangle, at its centroid; gouraud: at
    /// the vertices, interpolating the light; phong: at each pixel, interpolating the normal.
    #[arg(long, help_heading = "Shading options", value_parser = values::named(Shading::ALL, Shading::name))]
    pub shading: Option<Shading>,
    /// Source of the normals: the file, one per triangle, or averages over adjacent faces.
    #[arg(long, help_heading = "Shading options", value_parser = values::named(Normals::ALL, Normals::name))]
    pub normals: Option<Normals>,
    /// Largest angle between faces whose normals are averaged, in degrees.
    #[arg(long, help_heading = "Shading options", value_name = "DEG", value_parser = values::crease_angle)]
    pub crease_angle: Option<f64>,
    /// Replace values of all materials.
    ///
    /// Colours: ambient, diffuse, specular, emitted. Numbers: shininess, refraction-index, opacity. Textures:
    /// textures=false. For environments: one of mirror, glass, water, ice, diamond and air, or single values: reflectivity,
    /// transmission, fresnel (none, exact, schlick), tint, absorption, dispersion, surfaces (one, two).
    #[arg(long, help_heading = "Shading options", value_name = "KEY=VALUE,...",
          value_parser = MaterialOverride::from_option_text)]
    pub material: Option<MaterialOverride>,
    /// Texture filter.
    #[arg(long, help_heading = "Shading options", value_name = "FILTER",
          value_parser = values::named(TextureFilter::ALL, TextureFilter::name))]
    pub texture_filter: Option<TextureFilter>,

    /// Specular term.
    #[arg(long, help_heading = "Equation options", value_name = "MODEL",
          value_parser = values::named(Specular::ALL, Specular::name))]
    pub specular: Option<Specular>,
    /// BRDF that replaces the diffuse and the specular term.
    #[arg(long, help_heading = "Equation options", value_parser = values::named(BrdfKind::ALL, BrdfKind::name))]
    pub brdf: Option<BrdfKind>,
    /// Multiply the BRDF by the factor that conserves energy.
    #[arg(long, help_heading = "Equation options")]
    pub brdf_normalised: bool,
    /// Diffuse factor: 1 (lab), or 1/pi with radiometric lights (physical).
    #[arg(long, help_heading = "Equation options", value_parser = values::named(Convention::ALL, Convention::name))]
    pub convention: Option<Convention>,
    /// Multiply the specular term by <N.L>; =false switches that off.
    #[arg(long, help_heading = "Equation options", value_name = "BOOL", num_args = 0..=1, require_equals = true,
          default_missing_value = "true")]
    pub cosine_weighted: Option<bool>,
    /// Keep specular light where N.L <= 0, as the lab's own solutions do.
    #[arg(long, help_heading = "Equation options")]
    pub ungated: bool,
    /// Omit terms from the sum; attenuation and spot then count as 1.
    #[arg(long, help_heading = "Equation options", value_name = "TERM,...", value_delimiter = ',',
          value_parser = ["ambient", "emitted", "diffuse", "specular", "attenuation", "spot"])]
    pub without: Vec<String>,
    /// Turn the normals of back faces to the viewer.
    #[arg(long, help_heading = "Equation options", conflicts_with = "one_sided")]
    pub two_sided: bool,
    /// Light back faces with their normals unchanged.
    #[arg(long, help_heading = "Equation options")]
    pub one_sided: bool,

    /// A light that replaces the scene's lights; repeat it for several.
    ///
    /// KIND is ambient, directional, point or spot. Keys: position, direction, color, intensity, constant, linear,
    /// quadratic, inner-angle, outer-angle, name; motion=oscillate|circle|path with period, amplitude, center, axis,
    /// points.
    #[arg(long, help_heading = "Light options", value_name = "KIND KEY=VALUE ...", action = ArgAction::Append,
          value_parser = LightSpec::from_option_text)]
    pub light: Vec<LightSpec>,

    /// Camera of the model's file, by its name or its number (from 1).
    #[arg(long, help_heading = "Camera options", value_name = "NAME")]
    pub camera: Option<String>,
    /// Position of the eye in world space.
    #[arg(long, help_heading = "Camera options", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true)]
    pub camera_position: Option<[f64; 3]>,
    /// Point the camera looks at, in world space.
    #[arg(long, help_heading = "Camera options", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true, conflicts_with_all = ["yaw", "pitch"])]
    pub camera_target: Option<[f64; 3]>,
    /// Horizontal viewing direction in degrees: -90 looks along -Z.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub yaw: Option<f64>,
    /// Vertical viewing direction in degrees: positive looks up.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub pitch: Option<f64>,
    /// Up direction: +Y (the default), +Z, -X, ... or a vector.
    #[arg(long, help_heading = "Camera options", value_name = "AXIS", value_parser = values::up,
          allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,
    /// Full vertical field of view in degrees.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::field_of_view,
          allow_negative_numbers = true)]
    pub fov_y: Option<f64>,

    #[command(flatten)]
    pub surroundings: EnvironmentOptions,

    /// Size in pixels.
    #[arg(long, help_heading = "Picture options", value_name = "WxH", value_parser = values::size,
          allow_hyphen_values = true)]
    pub size: Option<(u32, u32)>,
    /// Samples per pixel: 1, 2, 4, 8 or 16.
    #[arg(long, help_heading = "Picture options", value_name = "N", value_parser = values::samples)]
    pub samples: Option<u32>,
    /// Encoding: sRGB, or the sum as it is, as the lab's programs write it.
    #[arg(long, help_heading = "Picture options", value_parser = values::named(ColorEncoding::ALL, ColorEncoding::name))]
    pub color: Option<ColorEncoding>,
    /// Tone mapping of light above 1.
    #[arg(long, help_heading = "Picture options", value_name = "OPERATOR",
          value_parser = values::named(ToneMap::ALL, ToneMap::name))]
    pub tone_map: Option<ToneMap>,
    /// Exposure in stops.
    #[arg(long, help_heading = "Picture options", value_name = "STOPS", value_parser = values::number,
          allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    #[command(flatten)]
    pub limits: LimitOptions,

    /// Background: COLOR, TOP:BOTTOM or transparent.
    ///
    /// A colour is #rrggbb (sRGB), r,g,b or one number (linear).
    #[arg(long, help_heading = "Picture options", value_name = "COLOR", value_parser = values::background)]
    pub background: Option<BackgroundValue>,
}

/// Limits on what a file may make gonio allocate.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Limit options")]
pub struct LimitOptions {
    /// Reject models with more triangles.
    #[arg(long, value_name = "N")]
    pub max_triangles: Option<u64>,
    /// Reject inputs that need more memory, for example 512MiB; by default a quarter of the machine's.
    ///
    /// Counts an input together with all files that it names, unpacked and decoded.
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub max_memory: Option<u64>,
    /// Read only files in the folders of the inputs.
    ///
    /// Models and scenes cannot name files elsewhere, neither by `..` nor by absolute paths or links.
    #[arg(long)]
    pub sandbox: bool,
}

impl LimitOptions {
    /// The default limits, with those of the options in their place.
    pub fn limits(&self) -> Limits {
        let usual = Limits::default();
        Limits {
            max_triangles: self.max_triangles.map_or(usual.max_triangles, |most| most.min(usual.max_triangles)),
            max_bytes: self.max_memory.unwrap_or_else(memory::default_limit),
            ..usual
        }
    }

    /// The files that a command reads for what the user names: models, scenes, environments.
    pub fn files<'i>(&self, named: impl IntoIterator<Item = &'i str>, reporter: &Reporter) -> Box<dyn FileSource> {
        let named: Vec<&str> = named.into_iter().collect();
        let disk = reporter.reporting_reads(DiskAndInput::new(named.iter().copied()));
        let files: Box<dyn FileSource> =
            if self.sandbox { Box::new(Sandbox::new(disk, named)) } else { Box::new(disk) };
        Box::new(Budgeted::new(files, self.limits().max_bytes))
    }
}

/// A parser for a list of debug views.
pub fn view_list() -> clap::builder::ValueParser {
    clap::builder::ValueParser::from(values::view as fn(&str) -> Result<ViewSpec, String>)
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
        let Err(help) = parse(words) else { panic!("{words:?} runs") };
        assert_eq!(help.exit_code(), 0, "{words:?}: {help}");
        help.to_string()
    }

    #[test]
    fn the_options_are_consistent() {
        command().debug_assert();
    }

    #[test]
    fn every_command_has_examples_and_stands_in_the_overview() {
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

    #[test]
    fn every_option_stands_under_one_of_a_few_headings() {
        const HEADINGS: [&str; 18] = [
            GENERAL,
            "Animation options",
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
            "Shading options",
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
            let ask = |flag| help_of(&[&words[..], &[flag]].concat());
            let (short, long) = (ask("-h"), ask("--help"));
            assert!(short.len() < long.len(), "{path}");
            assert!(!short.contains("Examples:"), "{path}");
            let has_examples = command.get_after_long_help().is_some_and(|text| text.to_string().contains("Examples:"));
            assert_eq!(long.contains("Examples:"), has_examples, "{path}");
            // `help` before the command is the same as `--help` behind it.
            let asked = [&words[..1], &["help"], &words[1..]].concat();
            assert_eq!(help_of(&asked), long, "{path}");
        }
        assert!(help_of(&["gonio", "help"]).contains("Examples:") && !help_of(&["gonio", "-h"]).contains("Examples:"));
    }

    /// A line of the source that ends within a sentence would be wrapped there and once more at the terminal's width.
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
