//! `gonio environment convert`: any arrangement to any other.

use super::write::{EnvironmentPlan, WrittenEnvironment};
use crate::backend::{self, open_context};
use crate::error::{CliError, CommandOutcome};
use crate::options::{BackendChoice, BackendOptions, GeneralOptions, LimitOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout};
use crate::report::{Reporter, Times};

use clap::Args;
use gonio_environment::arrange::Arrangement;
use gonio_environment::builtin::Builtin;
use gonio_environment::convert::{Conversion, Filter};
use gonio_environment::encode::{Appearance, Container};
use gonio_environment::{Cubemap, Layout, Panorama};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_render::conversion::Converter;
use gonio_scene::environment::world_from_environment;
use gonio_scene::environment_file::{self, EnvironmentMap, EnvironmentReadOptions, OpenedEnvironment};
use std::path::Path;

/// Convert a panorama or a cubemap to six faces, a cross, a strip, a panorama or KTX2, of any size, rotated.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio environment convert panorama.hdr faces
      Writes faces/posx.exr to faces/negz.exr, as OpenGL samples them.
  gonio environment convert panorama.jpg faces --layout photographic --size 1024
  gonio environment convert faces back.hdr --size 2048
      A panorama of 2048 x 1024.
  gonio environment convert \"sky_*.png\" sky.ktx2
      The quotes keep the shell from expanding the pattern.
  gonio environment convert room cross.png --to cross --exposure 1 --tone-map aces
  gonio environment convert debug faces --layout photographic
  gonio environment convert sky - --format exr > sky.exr

Layouts: faces in the `opengl` layout are what texture(samplerCube, direction_in_world) expects; an image viewer shows them \
mirrored. Faces in the `photographic` layout look right in a viewer, and are what most sites offer. IN is read as photographic if it \
is six files, a cross or a strip; OUT is written as opengl. So --from-layout opengl reads what was written.

IN: a panorama (.hdr .exr .png .jpg), a cross, a strip, a .ktx2 or .dds cubemap, a folder of six faces, one of six faces, a pattern \
such as \"sky_*.png\", or debug, sky, room. OUT: a file, a folder for six faces, or - for stdout.")]
pub struct ConvertArgs {
    /// Environment to convert.
    #[arg(value_name = "IN")]
    pub input: String,
    /// File to write (.png .hdr .exr .ktx2), or folder for six faces; - is stdout.
    #[arg(value_name = "OUT")]
    pub output: OutputPath,
    /// Container to write; by default a panorama or KTX2 if OUT is a file, else six faces.
    #[arg(long, help_heading = "Output options", value_name = "CONTAINER",
          value_parser = values::named(Container::ALL, Container::name))]
    pub to: Option<Container>,
    /// Layout of the faces in OUT.
    #[arg(long, help_heading = "Output options", value_parser = values::named(Layout::ALL, Layout::name),
          default_value = "opengl")]
    pub layout: Layout,
    /// Texels along an edge of a face, or width of a panorama (half as high), or WxH; by default as fine as IN.
    #[arg(long, help_heading = "Output options", value_name = "N", value_parser = values::environment_size)]
    pub size: Option<(u32, Option<u32>)>,
    /// Format of six faces and of stdout; by default exr if IN has light above 1, else png.
    #[arg(long, help_heading = "Output options", value_parser = ["png", "exr", "hdr"])]
    pub format: Option<String>,
    /// Bits per channel of PNG: 8 or 16.
    #[arg(long, help_heading = "Output options", value_name = "N", value_parser = values::bits)]
    pub bits: Option<u8>,
    /// Exposure in stops, for PNG.
    #[arg(long, help_heading = "Output options", value_name = "STOPS", value_parser = values::number,
          allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// Tone mapping of light above 1, for PNG.
    #[arg(long, help_heading = "Output options", value_name = "OPERATOR",
          value_parser = values::named(ToneMap::ALL, ToneMap::name))]
    pub tone_map: Option<ToneMap>,
    /// Filter of lookups in IN; by default area if OUT is coarser than IN, else bilinear.
    #[arg(long, help_heading = "Conversion options", value_parser = values::named(Filter::ALL, Filter::name))]
    pub filter: Option<Filter>,
    /// Converter: the CPU (also for auto, since it is faster than reading a picture back), or OpenGL.
    #[arg(long, help_heading = "Conversion options", value_parser = values::named(BackendChoice::ALL, BackendChoice::name),
          default_value = "cpu")]
    pub backend: BackendChoice,
    /// Rotate the environment, in degrees.
    ///
    /// A positive yaw rotates the part ahead to the left, a positive pitch rotates it up.
    #[arg(long, help_heading = "Conversion options", value_name = "YAW,PITCH,ROLL", value_parser = values::angles,
          allow_hyphen_values = true)]
    pub rotate: Option<[f64; 3]>,
    /// Layout of IN's faces.
    #[arg(long, help_heading = "Input options", value_name = "LAYOUT",
          value_parser = values::named(Layout::ALL, Layout::name))]
    pub from_layout: Option<Layout>,
    /// Arrangement of IN, if its proportions are misleading.
    #[arg(long, help_heading = "Input options", value_name = "ARRANGEMENT",
          value_parser = values::named(Arrangement::ALL, Arrangement::name))]
    pub from: Option<Arrangement>,
    #[command(flatten)]
    pub limits: LimitOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &ConvertArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let times = Times::default();
    let plan = EnvironmentPlan::new(&args.output, args.to, args.format.as_deref(), args.bits)?;
    check_stdout([(&args.output, OutputKind::Binary)], reporter)?;
    plan.check_writable()?;
    if !plan.container.has_faces() && args.layout != Layout::OpenGl {
        return Err(CliError::new("--layout applies to faces, and a panorama has none"));
    }
    if plan.container == Container::Ktx2 && args.layout != Layout::OpenGl {
        return Err(CliError::new("KTX2 stores faces in OpenGL's layout only; leave out --layout"));
    }
    check_size(args, &plan)?;
    let opened = {
        let _busy = reporter.busy("reading the environment");
        let size = args.size.map(|(size, _)| size).filter(|_| plan.container.has_faces());
        // The debug cubemap shows the names of the files that its faces will have.
        let is_debug = environment_file::builtin_of(&args.input) == Some(Builtin::Debug);
        let from_layout = args.from_layout.or(is_debug.then_some(args.layout));
        let reading = EnvironmentReadOptions { layout: from_layout, arrangement: args.from, size };
        let files = args.limits.files([args.input.as_str()], reporter);
        times.measure("read", || {
            environment_file::open(&args.input, reading, Path::new(""), &files, &args.limits.limits())
        })?
    };
    reporter.diagnostics(&opened.diagnostics);
    let turn = args.rotate.map(|angles| world_from_environment(angles).transpose());
    let conversion = Conversion { filter: args.filter, source_from_target: turn.unwrap_or(glam::DMat3::IDENTITY) };
    let appearance = Appearance {
        layout: args.layout,
        transform: OutputTransform {
            exposure: args.exposure.unwrap_or(0.0),
            tone_map: args.tone_map.unwrap_or_default(),
            encoding: ColorEncoding::Srgb,
        },
        high_dynamic_range: opened.high_dynamic_range,
        exact: false,
    };
    plan.check_appearance(args.exposure.is_some() || args.tone_map.is_some(), opened.high_dynamic_range)?;
    let engine = Engine::new(args.backend, reporter)?;
    let busy = reporter.busy("converting");
    let (written, size, filter) = if plan.container.has_faces() {
        let size = face_size(args, &opened)?;
        let filter = conversion.filter_for(&opened.map.as_environment(), 2.0 / f64::from(size));
        let read = opened.description();
        let map = times.measure("convert", || engine.cubemap(opened.map, &conversion, size, reporter))?;
        let written = times.measure("write", || plan.write_cubemap(map, &appearance))?;
        let noun = if plan.container == Container::Faces {
            "six faces".into()
        } else {
            format!("{} of faces", plan.container)
        };
        note_conversion(reporter, &read, &format!("{noun} of {size} x {size}, {} layout", args.layout), filter);
        (written, (size, size), filter)
    } else {
        let (width, height) = panorama_size(args, &opened)?;
        let filter = conversion.filter_for(&opened.map.as_environment(), std::f64::consts::PI / f64::from(height));
        let read = opened.description();
        let panorama =
            times.measure("convert", || engine.panorama(opened.map, &conversion, width, height, reporter))?;
        let written = times.measure("write", || plan.write_panorama(&panorama, &appearance))?;
        note_conversion(reporter, &read, &format!("a panorama of {width} x {height}"), filter);
        (written, (width, height), filter)
    };
    drop(busy);
    let WrittenEnvironment { outputs, warnings } = written;
    warnings.iter().for_each(|w| reporter.warning(w));
    reporter.verbose_times(&times);
    if reporter.json() {
        reporter.report(&serde_json::json!({
            "command": "environment convert",
            "input": args.input,
            "from": { "arrangement": opened.arrangement.name(), "layout": opened.layout.map(Layout::name) },
            "to": plan.container.name(),
            "layout": plan.container.has_faces().then(|| args.layout.name()),
            "size": [size.0, size.1],
            "filter": filter.name(),
            "outputs": outputs.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "warnings": opened.diagnostics,
            "notes": warnings,
            "times_ms": times.to_json(),
        }))?;
    }
    Ok(CommandOutcome::Done)
}

fn note_conversion(reporter: &Reporter, read: &str, wrote: &str, filter: Filter) {
    reporter.note(format!("read {read}; wrote {wrote}; {filter} filter"));
}

/// The converter.
enum Engine {
    Cpu,
    Gl(Converter),
}

impl Engine {
    fn new(choice: BackendChoice, reporter: &Reporter) -> Result<Engine, CliError> {
        if choice != BackendChoice::Gl {
            return Ok(Engine::Cpu);
        }
        backend::report_driver(reporter);
        let context = open_context(&BackendOptions::default())?;
        Ok(Engine::Gl(Converter::new(context.gl().clone())?))
    }

    fn cubemap(
        &self,
        source: EnvironmentMap,
        conversion: &Conversion,
        size: u32,
        reporter: &Reporter,
    ) -> Result<Cubemap, CliError> {
        match (source, self) {
            // Unchanged: nothing to look up.
            (EnvironmentMap::Cubemap(map), _) if map.size() == size && conversion.is_not_turned() => Ok(map),
            (source, Engine::Cpu) => Ok(conversion.cubemap(source.as_environment(), size)),
            (source, Engine::Gl(converter)) => {
                let made = converter.cubemap(conversion, source.as_environment(), size)?;
                made.notes.iter().for_each(|note| reporter.note(note));
                Ok(made.environment)
            }
        }
    }

    fn panorama(
        &self,
        source: EnvironmentMap,
        conversion: &Conversion,
        width: u32,
        height: u32,
        reporter: &Reporter,
    ) -> Result<Panorama, CliError> {
        match (source, self) {
            (EnvironmentMap::Panorama(panorama), _)
                if (panorama.image.width, panorama.image.height) == (width, height) && conversion.is_not_turned() =>
            {
                Ok(panorama)
            }
            (source, Engine::Cpu) => Ok(conversion.panorama(source.as_environment(), width, height)),
            (source, Engine::Gl(converter)) => {
                let made = converter.panorama(conversion, source.as_environment(), width, height)?;
                made.notes.iter().for_each(|note| reporter.note(note));
                Ok(made.environment)
            }
        }
    }
}

/// Most pixels of an output: faces of 8192 and panoramas of 32768 x 16384.
const MOST_PIXELS: u64 = 1 << 29;

/// Checks `--size` before anything is read or allocated.
fn check_size(args: &ConvertArgs, plan: &EnvironmentPlan) -> Result<(), CliError> {
    match args.size {
        None => Ok(()),
        Some((_, Some(_))) if plan.container.has_faces() => {
            Err(CliError::new("--size of faces is one number N: they are square"))
        }
        Some((size, None)) if plan.container.has_faces() => check_faces(size),
        Some((width, height)) => check_panorama(width, height.unwrap_or(width / 2)),
    }
}

fn check_faces(size: u32) -> Result<(), CliError> {
    if 6 * u64::from(size) * u64::from(size) <= MOST_PIXELS {
        return Ok(());
    }
    Err(CliError::new(format!("six faces of {size} x {size} are too large: --size is at most 8192")))
}

fn check_panorama(width: u32, height: u32) -> Result<(), CliError> {
    if u64::from(width) * u64::from(height) <= MOST_PIXELS {
        return Ok(());
    }
    Err(CliError::new(format!("a panorama of {width} x {height} is too large: --size is at most 32768 (by 16384)")))
}

fn face_size(args: &ConvertArgs, opened: &OpenedEnvironment) -> Result<u32, CliError> {
    let size = args.size.map_or_else(|| opened.map.as_environment().natural_cubemap_size(), |(size, _)| size);
    check_faces(size).map(|()| size)
}

fn panorama_size(args: &ConvertArgs, opened: &OpenedEnvironment) -> Result<(u32, u32), CliError> {
    let (width, height) = match (args.size, &opened.map) {
        (Some((width, Some(height))), _) => (width, height),
        (Some((width, None)), _) => (width, (width / 2).max(1)),
        (None, EnvironmentMap::Panorama(panorama)) => (panorama.image.width, panorama.image.height),
        (None, source) => {
            let height = source.as_environment().natural_panorama_height();
            (height.saturating_mul(2), height)
        }
    };
    check_panorama(width, height).map(|()| (width, height))
}
