//! The options, as a person sees them.

use crate::backend::BackendChoice;
use crate::cli_environment::EnvironmentOptions;
use crate::commands;
use crate::memory;
use crate::values::{self, BackgroundValue};
use clap::{ArgAction, Args, Parser, Subcommand};
use gonio_light::brdf::BrdfKind;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::{Convention, Specular};
use gonio_mesh::Limits;
use gonio_scene::TextureFilter;
use gonio_scene::ViewSpec;
use gonio_scene::files::{Budgeted, DiskAndInput, FileSource, Sandbox};
use gonio_scene::scene_file::{LightSpec, MaterialOverride, Normals, Shading};

/// The light lab: loads a model, lights it with the light equation, shows every term at every pixel.
#[derive(Parser, Debug)]
#[command(name = "gonio", bin_name = "gonio", version, propagate_version = true, max_term_width = 110)]
#[command(disable_help_subcommand = true)]
#[command(help_template = "{about-with-newline}\n{usage-heading} {usage}{after-help}\n\nOptions:\n{options}")]
#[command(after_help = "\
Pictures:
  render   Draw a model or a scene: one picture, debug views, or an animation
  tour     Draw every technique on several models: a contact sheet and a web page
  serve    The lab as a web page, on this machine alone

Window:
  view     The lab window: see, change and take apart the light (also without any command)

Models:
  convert  Write a model as OBJ with MTL, as PLY or as GLB

Environments:
  environment  Convert panoramas and cubemaps into one another; check which way round they are

Laboratory:
  lab      Exercises, students' own shaders, and a checker that names the mistake

Understanding:
  inspect  What a model file holds, how each part and line was understood, what is odd
  probe    The light equation at one pixel, term by term and light by light
  frame    What OpenGL was told to draw a frame, and what is wrong with it
  diff     Compare two pictures: numbers, difference map, side by side, wipe
  scene    Print the complete effective scene of an input, or the JSON Schema of scene files

Examples:
  gonio
  gonio view model.obj
  gonio tour -o tour
  gonio render model.obj -o model.png
  gonio inspect model.obj
  gonio probe model.obj --at 512,384
  gonio frame model.obj
  gonio diff a.png b.png -o map.png

`gonio COMMAND --help` tells more. Exit codes: 0 done, 1 a check failed, 2 error.")]
pub struct Cli {
    /// What to do; the window where nothing is said.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Draw a model or a scene: one picture, debug views, or an animation.
    Render(Box<commands::render::RenderArgs>),
    /// The light equation at one pixel, term by term and light by light.
    Probe(Box<commands::probe::ProbeArgs>),
    /// The frame taken apart: passes, draw calls, programs, uniforms, samplers and the units they read.
    Frame(Box<commands::frame::FrameArgs>),
    /// Write a model as OBJ with MTL, as PLY or as GLB.
    Convert(commands::convert::ConvertArgs),
    /// Convert panoramas and cubemaps into one another; check which way round they are.
    #[command(subcommand)]
    Environment(commands::environment::EnvironmentCommand),
    /// Compare two pictures: numbers, difference map, side by side, wipe.
    Diff(commands::diff::DiffArgs),
    /// Say what a model file holds and how each part of it was understood.
    Inspect(commands::inspect::InspectArgs),
    /// Exercises, students' own shaders, and a checker that names the mistake.
    #[command(subcommand)]
    Lab(commands::lab::LabCommand),
    /// Print the complete effective scene of an input, or the JSON Schema of scene files.
    Scene(Box<commands::scene::SceneArgs>),
    /// Serve the lab as a web page, on this machine alone.
    Serve(commands::serve::ServeArgs),
    /// Draw every technique on several models: a contact sheet and a web page.
    Tour(commands::tour::TourArgs),
    /// The lab window: see, change and take apart the light.
    View(Box<commands::view::ViewArgs>),
}

impl Command {
    /// As written.
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
        }
    }

    /// `--quiet`
    pub fn quiet(&self) -> bool {
        self.words().quiet
    }

    /// `--json`
    pub fn json(&self) -> bool {
        self.words().json
    }

    fn words(&self) -> &WordOptions {
        match self {
            Command::Render(args) => &args.words,
            Command::Probe(args) => &args.words,
            Command::Frame(args) => &args.words,
            Command::Convert(args) => &args.words,
            Command::Environment(command) => command.words(),
            Command::Diff(args) => &args.words,
            Command::Inspect(args) => &args.words,
            Command::Lab(command) => command.words(),
            Command::Scene(args) => &args.words,
            Command::Serve(args) => &args.words,
            Command::Tour(args) => &args.words,
            Command::View(args) => &args.words,
        }
    }
}

/// What is said.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Words")]
pub struct WordOptions {
    /// Print one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors.
    #[arg(long, short)]
    pub quiet: bool,
}

/// Who draws.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Drawing")]
pub struct BackendOptions {
    /// Who draws: OpenGL, the CPU reference, or OpenGL where it can be had.
    #[arg(long, value_parser = values::named(BackendChoice::ALL, BackendChoice::name), default_value = "auto")]
    pub backend: BackendChoice,
    /// Threads of the CPU reference; all cores by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Load OpenGL's EGL from this library instead of the system's (for tests).
    #[arg(long, value_name = "FILE", hide = true)]
    pub egl_library: Option<String>,
}

/// Everything of a scene that an option can replace. The same for `render`, `probe` and `scene`.
#[derive(Args, Debug, Clone, Default)]
pub struct SceneOptions {
    /// Where the equation is evaluated.
    #[arg(long, help_heading = "Shading", value_parser = values::named(Shading::ALL, Shading::name))]
    pub shading: Option<Shading>,
    /// Which normals the meshes get.
    #[arg(long, help_heading = "Shading", value_parser = values::named(Normals::ALL, Normals::name))]
    pub normals: Option<Normals>,
    /// Of averaged normals: do not average faces that differ by more degrees than this.
    #[arg(long, help_heading = "Shading", value_name = "DEG", value_parser = values::crease_angle)]
    pub crease_angle: Option<f64>,
    /// Replace values of all materials: ambient, diffuse, specular, emitted (colours), shininess,
    /// refraction-index, opacity, textures (true or false). What shows the environment: mirror, glass, water, ice,
    /// diamond, air; reflectivity, transmission, fresnel (none, exact, schlick), tint, absorption, dispersion, surfaces
    /// (one, two).
    #[arg(long, help_heading = "Shading", value_name = "KEY=VALUE,...", value_parser = MaterialOverride::from_option_text)]
    pub material: Option<MaterialOverride>,
    /// How textures are sampled.
    #[arg(long, help_heading = "Shading", value_parser = values::named(TextureFilter::ALL, TextureFilter::name))]
    pub texture_filter: Option<TextureFilter>,

    /// The specular term.
    #[arg(long, help_heading = "Equation", value_parser = values::named(Specular::ALL, Specular::name))]
    pub specular: Option<Specular>,
    /// A BRDF in place of the diffuse and the specular term.
    #[arg(long, help_heading = "Equation", value_parser = values::named(BrdfKind::ALL, BrdfKind::name))]
    pub brdf: Option<BrdfKind>,
    /// The BRDF with the factor that keeps its energy in bounds.
    #[arg(long, help_heading = "Equation")]
    pub brdf_normalised: bool,
    /// Diffuse factor 1, or 1/pi and radiometric lights.
    #[arg(long, help_heading = "Equation", value_parser = values::named(Convention::ALL, Convention::name))]
    pub convention: Option<Convention>,
    /// Weight the specular term by <N.L>, or (=false) do not.
    #[arg(long, help_heading = "Equation", value_name = "BOOL", num_args = 0..=1, require_equals = true,
          default_missing_value = "true")]
    pub cosine_weighted: Option<bool>,
    /// Specular light also where N.L <= 0, as in the lab's own solutions.
    #[arg(long, help_heading = "Equation")]
    pub ungated: bool,
    /// Leave terms out of the sum (attenuation and spot then count as 1).
    #[arg(long, help_heading = "Equation", value_name = "TERM,...", value_delimiter = ',',
          value_parser = ["ambient", "emitted", "diffuse", "specular", "attenuation", "spot"])]
    pub without: Vec<String>,
    /// Turn the normal to the viewer on back faces.
    #[arg(long, help_heading = "Equation", conflicts_with = "one_sided")]
    pub two_sided: bool,
    /// Light back faces with the normal as it is.
    #[arg(long, help_heading = "Equation")]
    pub one_sided: bool,

    /// A light in place of the scene's; repeat it for several. KIND is ambient, directional, point or
    /// spot; keys: position, direction, color, intensity, constant, linear, quadratic, inner-angle,
    /// outer-angle, name; motion=oscillate|circle|path with period, amplitude, center, axis, points.
    #[arg(long, help_heading = "Lights", value_name = "KIND KEY=VALUE ...", action = ArgAction::Append,
          value_parser = LightSpec::from_option_text)]
    pub light: Vec<LightSpec>,

    /// A camera of the model's file, by its name or its number (from 1).
    #[arg(long, help_heading = "Camera", value_name = "NAME")]
    pub camera: Option<String>,
    /// The eye, world space.
    #[arg(long, help_heading = "Camera", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true)]
    pub camera_position: Option<[f64; 3]>,
    /// The point looked at, world space.
    #[arg(long, help_heading = "Camera", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true, conflicts_with_all = ["yaw", "pitch"])]
    pub camera_target: Option<[f64; 3]>,
    /// Viewing direction in degrees: -90 looks along -Z.
    #[arg(long, help_heading = "Camera", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub yaw: Option<f64>,
    /// Viewing direction in degrees: positive looks up.
    #[arg(long, help_heading = "Camera", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub pitch: Option<f64>,
    /// Which way is up: +Y (as by default), +Z, -X, ... or a vector.
    #[arg(long, help_heading = "Camera", value_name = "AXIS", value_parser = values::up, allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,
    /// Full vertical field of view in degrees.
    #[arg(long, help_heading = "Camera", value_name = "DEG", value_parser = values::field_of_view,
          allow_negative_numbers = true)]
    pub fov_y: Option<f64>,

    /// What surrounds the scene.
    #[command(flatten)]
    pub surroundings: EnvironmentOptions,

    /// Size in pixels.
    #[arg(long, help_heading = "Picture", value_name = "WxH", value_parser = values::size,
          allow_hyphen_values = true)]
    pub size: Option<(u32, u32)>,
    /// Samples per pixel: 1, 2, 4, 8 or 16.
    #[arg(long, help_heading = "Picture", value_name = "N", value_parser = values::samples)]
    pub samples: Option<u32>,
    /// sRGB encoding, or the sum as it is (as the lab's programs write it).
    #[arg(long, help_heading = "Picture", value_parser = values::named(ColorEncoding::ALL, ColorEncoding::name))]
    pub color: Option<ColorEncoding>,
    /// How light above 1 is brought into range.
    #[arg(long, help_heading = "Picture", value_parser = values::named(ToneMap::ALL, ToneMap::name))]
    pub tone_map: Option<ToneMap>,
    /// Exposure in stops.
    #[arg(long, help_heading = "Picture", value_name = "STOPS", value_parser = values::number,
          allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// What a file may make us allocate.
    #[command(flatten)]
    pub limits: LimitOptions,

    /// Behind the objects: COLOR, TOP:BOTTOM or transparent. A colour is #rrggbb (sRGB), r,g,b or one
    /// number (linear).
    #[arg(long, help_heading = "Picture", value_name = "COLOR", value_parser = values::background)]
    pub background: Option<BackgroundValue>,
}

/// What a file may make us allocate.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Limits")]
pub struct LimitOptions {
    /// Refuse models with more triangles.
    #[arg(long, value_name = "N")]
    pub max_triangles: Option<u64>,
    /// Refuse inputs that need more memory than this, together with all files that they name, unpacked and decoded:
    /// 512MiB, 16GiB. By default a quarter of the machine's memory.
    #[arg(long, value_name = "SIZE", value_parser = values::bytes)]
    pub max_memory: Option<u64>,
    /// Read only what lies in the folders of the inputs: models and scenes cannot name files elsewhere, by `..`, absolute
    /// paths or links.
    #[arg(long)]
    pub sandbox: bool,
}

impl LimitOptions {
    /// The usual limits, with what the options say in their place.
    pub fn limits(&self) -> Limits {
        let usual = Limits::default();
        Limits {
            max_triangles: self.max_triangles.map_or(usual.max_triangles, |most| most.min(usual.max_triangles)),
            max_bytes: self.max_memory.unwrap_or_else(memory::default_limit),
            ..usual
        }
    }

    /// The files that a command reads for what the user names: models, scenes, environments.
    pub fn files<'i>(&self, named: impl IntoIterator<Item = &'i str>) -> Box<dyn FileSource> {
        let named: Vec<&str> = named.into_iter().collect();
        let disk = DiskAndInput::new(named.iter().copied());
        let files: Box<dyn FileSource> =
            if self.sandbox { Box::new(Sandbox::new(disk, named)) } else { Box::new(disk) };
        Box::new(Budgeted::new(files, self.limits().max_bytes))
    }
}

/// A debug view in a list.
pub fn view_list() -> clap::builder::ValueParser {
    clap::builder::ValueParser::from(values::view as fn(&str) -> Result<ViewSpec, String>)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_options_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_command_has_examples_and_stands_in_the_overview() {
        let overview = Cli::command().render_long_help().to_string();
        for command in Cli::command().get_subcommands() {
            assert!(overview.contains(&format!("\n  {}", command.get_name())), "{}", command.get_name());
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(
                after.contains("Examples:") && after.contains(&format!("gonio {}", command.get_name())),
                "{command}"
            );
        }
    }
}
