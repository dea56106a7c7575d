//! `gonio environment convert`: from any arrangement to any other.

use super::describe;
use super::write::{Kind, Look, Plan, Written};
use crate::backend::{BackendChoice, open_context};
use crate::cli::{BackendOptions, LimitOptions, WordOptions};
use crate::report::{CliError, Outcome, Reporter, Times};
use crate::values;
use clap::Args;
use gonio_environment::arrange::Arrangement;
use gonio_environment::builtin::Builtin;
use gonio_environment::convert::{Conversion, Filter};
use gonio_environment::{Cubemap, Layout, Panorama};
use gonio_light::color::{ColorEncoding, OutputTransform, ToneMap};
use gonio_render::conversion::Converter;
use gonio_scene::environment::world_from_environment;
use gonio_scene::environment_file::{self, OpenedEnvironment, Reading, Source};
use std::path::{Path, PathBuf};

/// Convert a panorama or a cubemap: to six faces, a cross, a strip, a panorama or KTX2, of any size, turned.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio environment convert panorama.hdr faces
      faces/posx.exr to faces/negz.exr, as OpenGL samples them.
  gonio environment convert panorama.jpg faces --layout photographic --size 1024
  gonio environment convert faces back.hdr --size 2048
      A panorama of 2048 x 1024.
  gonio environment convert \"sky_*.png\" sky.ktx2
      In quotes: the pattern is for gonio, not for the shell.
  gonio environment convert room cross.png --to cross --exposure 1 --tone-map aces
  gonio environment convert debug faces --layout photographic

Layouts: `opengl` faces are what texture(samplerCube, direction_in_world) wants; a viewer of images shows them mirrored.
`photographic` faces look right in a viewer, and are what most sites give away. IN is taken for photographic where it is
six files, a cross or a strip; OUT is written for opengl. So --from-layout opengl reads again what was written.

IN: a panorama (.hdr .exr .png .jpg), a cross, a strip, a .ktx2 or .dds cubemap, a folder of six faces, one of six
faces, a pattern such as \"sky_*.png\", or debug, sky, room. OUT: a file, or a folder for six faces.")]
pub struct ConvertArgs {
    /// What to convert.
    #[arg(value_name = "IN")]
    pub input: String,
    /// The file to write (.png .hdr .exr .ktx2), or the folder for six faces.
    #[arg(value_name = "OUT")]
    pub output: PathBuf,
    /// What to write; by default a panorama or KTX2 where OUT is a file's name, else six faces.
    #[arg(long, help_heading = "Output", value_parser = values::named(Kind::ALL, Kind::name))]
    pub to: Option<Kind>,
    /// The layout of the faces that are written.
    #[arg(long, help_heading = "Output", value_parser = values::named(Layout::ALL, Layout::name),
          default_value = "opengl")]
    pub layout: Layout,
    /// Texels along an edge of a face; of a panorama, its width (it is half as high), or WxH. By default as fine as IN.
    #[arg(long, help_heading = "Output", value_name = "N", value_parser = values::environment_size)]
    pub size: Option<(u32, Option<u32>)>,
    /// The format of six faces: png, exr or hdr; by default exr where IN has light above 1, else png.
    #[arg(long, help_heading = "Output", value_parser = ["png", "exr", "hdr"])]
    pub format: Option<String>,
    /// Bits a channel of PNG: 8 or 16.
    #[arg(long, help_heading = "Output", value_name = "N", value_parser = values::bits)]
    pub bits: Option<u8>,
    /// Exposure in stops, for PNG.
    #[arg(long, help_heading = "Output", value_name = "STOPS", value_parser = values::number,
          allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// How light above 1 is brought into range, for PNG.
    #[arg(long, help_heading = "Output", value_parser = values::named(ToneMap::ALL, ToneMap::name))]
    pub tone_map: Option<ToneMap>,
    /// How IN is looked up; by default area where OUT is coarser than IN, else bilinear.
    #[arg(long, help_heading = "Conversion", value_parser = values::named(Filter::ALL, Filter::name))]
    pub filter: Option<Filter>,
    /// Who converts: the CPU (also for auto: it is faster than reading a picture back), or OpenGL.
    #[arg(long, help_heading = "Conversion", value_parser = values::named(BackendChoice::ALL, BackendChoice::name),
          default_value = "cpu")]
    pub backend: BackendChoice,
    /// Turn the environment, in degrees: a positive yaw turns what is ahead to the left, a positive pitch upwards.
    #[arg(long, help_heading = "Conversion", value_name = "YAW,PITCH,ROLL", value_parser = values::angles,
          allow_hyphen_values = true)]
    pub rotate: Option<[f64; 3]>,
    /// The layout of IN's faces.
    #[arg(long, help_heading = "Input", value_parser = values::named(Layout::ALL, Layout::name))]
    pub from_layout: Option<Layout>,
    /// What IN is, where its proportions mislead.
    #[arg(long, help_heading = "Input", value_parser = values::named(Arrangement::ALL, Arrangement::name))]
    pub from: Option<Arrangement>,
    /// What a file may make us allocate.
    #[command(flatten)]
    pub limits: LimitOptions,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// Converts.
pub fn run(args: &ConvertArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let times = Times::default();
    let plan = Plan::new(&args.output, args.to, args.format.as_deref(), args.bits)?;
    plan.check_writable()?;
    if !plan.kind.has_faces() && args.layout != Layout::OpenGl {
        return Err(CliError::new("--layout is about faces, and a panorama has none"));
    }
    if plan.kind == Kind::Ktx2 && args.layout != Layout::OpenGl {
        return Err(CliError::new("KTX2 holds faces in OpenGL's layout only; leave --layout out"));
    }
    check_size(args, &plan)?;
    let opened = {
        let _busy = reporter.busy("reading the environment");
        let size = args.size.map(|(size, _)| size).filter(|_| plan.kind.has_faces());
        // The debug cubemap has the names of files written on it: those that it will have.
        let is_debug = environment_file::builtin_of(&args.input) == Some(Builtin::Debug);
        let from_layout = args.from_layout.or(is_debug.then_some(args.layout));
        let reading = Reading { layout: from_layout, arrangement: args.from, size };
        let files = args.limits.files([args.input.as_str()]);
        times.measure("read", || {
            environment_file::open(&args.input, reading, Path::new(""), &files, &args.limits.limits())
        })?
    };
    reporter.diagnostics(&opened.diagnostics);
    let turn = args.rotate.map(|angles| world_from_environment(angles).transpose());
    let conversion = Conversion { filter: args.filter, source_from_target: turn.unwrap_or(glam::DMat3::IDENTITY) };
    let look = Look {
        layout: args.layout,
        transform: OutputTransform {
            exposure: args.exposure.unwrap_or(0.0),
            tone_map: args.tone_map.unwrap_or_default(),
            encoding: ColorEncoding::Srgb,
        },
        high_dynamic_range: opened.high_dynamic_range,
        exact: false,
    };
    plan.check_look(args.exposure.is_some() || args.tone_map.is_some(), opened.high_dynamic_range)?;
    let engine = Engine::new(args.backend)?;
    let busy = reporter.busy("converting");
    let (written, size, filter) = if plan.kind.has_faces() {
        let size = face_size(args, &opened)?;
        let filter = conversion.filter_for(&opened.source.as_from(), 2.0 / f64::from(size));
        let read = describe(&opened);
        let map = times.measure("convert", || engine.cubemap(opened.source, &conversion, size, reporter))?;
        let written = times.measure("write", || plan.write_cubemap(map, &look))?;
        let what = if plan.kind == Kind::Faces { "six faces".into() } else { format!("{} of faces", plan.kind) };
        said(reporter, &read, &format!("{what} of {size} x {size}, {} layout", args.layout), filter);
        (written, (size, size), filter)
    } else {
        let (width, height) = panorama_size(args, &opened)?;
        let filter = conversion.filter_for(&opened.source.as_from(), std::f64::consts::PI / f64::from(height));
        let read = describe(&opened);
        let panorama =
            times.measure("convert", || engine.panorama(opened.source, &conversion, width, height, reporter))?;
        let written = times.measure("write", || plan.write_panorama(&panorama, &look))?;
        said(reporter, &read, &format!("a panorama of {width} x {height}"), filter);
        (written, (width, height), filter)
    };
    drop(busy);
    let Written { outputs, warnings } = written;
    warnings.iter().for_each(|w| reporter.warning(w));
    if reporter.json() {
        reporter.report(&serde_json::json!({
            "command": "environment convert",
            "input": args.input,
            "from": { "arrangement": opened.arrangement.name(), "layout": opened.layout.map(Layout::name) },
            "to": plan.kind.name(),
            "layout": plan.kind.has_faces().then(|| args.layout.name()),
            "size": [size.0, size.1],
            "filter": filter.name(),
            "outputs": outputs,
            "warnings": opened.diagnostics,
            "notes": warnings,
            "times_ms": times.to_json(),
        }))?;
    }
    Ok(Outcome::Done)
}

fn said(reporter: &Reporter, read: &str, wrote: &str, filter: Filter) {
    reporter.note(format!("read {read}; wrote {wrote}; {filter} filter"));
}

/// Who converts.
enum Engine {
    Cpu,
    Gl(Converter),
}

impl Engine {
    fn new(choice: BackendChoice) -> Result<Engine, CliError> {
        if choice != BackendChoice::Gl {
            return Ok(Engine::Cpu);
        }
        let context = open_context(&BackendOptions::default())?;
        Ok(Engine::Gl(Converter::new(context.gl().clone())?))
    }

    fn cubemap(
        &self,
        source: Source,
        conversion: &Conversion,
        size: u32,
        reporter: &Reporter,
    ) -> Result<Cubemap, CliError> {
        match (source, self) {
            // As it is: nothing is to be looked up.
            (Source::Cubemap(map), _) if map.size() == size && conversion.is_not_turned() => Ok(map),
            (source, Engine::Cpu) => Ok(conversion.cubemap(source.as_from(), size)),
            (source, Engine::Gl(converter)) => {
                let made = converter.cubemap(conversion, source.as_from(), size)?;
                made.notes.iter().for_each(|note| reporter.note(note));
                Ok(made.environment)
            }
        }
    }

    fn panorama(
        &self,
        source: Source,
        conversion: &Conversion,
        width: u32,
        height: u32,
        reporter: &Reporter,
    ) -> Result<Panorama, CliError> {
        match (source, self) {
            (Source::Panorama(panorama), _)
                if (panorama.image.width, panorama.image.height) == (width, height) && conversion.is_not_turned() =>
            {
                Ok(panorama)
            }
            (source, Engine::Cpu) => Ok(conversion.panorama(source.as_from(), width, height)),
            (source, Engine::Gl(converter)) => {
                let made = converter.panorama(conversion, source.as_from(), width, height)?;
                made.notes.iter().for_each(|note| reporter.note(note));
                Ok(made.environment)
            }
        }
    }
}

/// Most pixels of what is written: faces of 8192 and panoramas of 32768 x 16384.
const MOST_PIXELS: u64 = 1 << 29;

/// Whether what `--size` asks for can be written: before anything is read or made for it.
fn check_size(args: &ConvertArgs, plan: &Plan) -> Result<(), CliError> {
    match args.size {
        None => Ok(()),
        Some((_, Some(_))) if plan.kind.has_faces() => {
            Err(CliError::new("--size of faces is one number, N: they are square"))
        }
        Some((size, None)) if plan.kind.has_faces() => check_faces(size),
        Some((width, height)) => check_panorama(width, height.unwrap_or(width / 2)),
    }
}

fn check_faces(size: u32) -> Result<(), CliError> {
    if 6 * u64::from(size) * u64::from(size) <= MOST_PIXELS {
        return Ok(());
    }
    Err(CliError::new(format!("six faces of {size} x {size} are too many pixels; --size 8192 is the most")))
}

fn check_panorama(width: u32, height: u32) -> Result<(), CliError> {
    if u64::from(width) * u64::from(height) <= MOST_PIXELS {
        return Ok(());
    }
    Err(CliError::new(format!("a panorama of {width} x {height} is too large; --size 32768 (by 16384) is the most")))
}

fn face_size(args: &ConvertArgs, opened: &OpenedEnvironment) -> Result<u32, CliError> {
    let size = args.size.map_or_else(|| opened.source.as_from().natural_cubemap_size(), |(size, _)| size);
    check_faces(size).map(|()| size)
}

fn panorama_size(args: &ConvertArgs, opened: &OpenedEnvironment) -> Result<(u32, u32), CliError> {
    let (width, height) = match (args.size, &opened.source) {
        (Some((width, Some(height))), _) => (width, height),
        (Some((width, None)), _) => (width, (width / 2).max(1)),
        (None, Source::Panorama(panorama)) => (panorama.image.width, panorama.image.height),
        (None, source) => {
            let height = source.as_from().natural_panorama_height();
            (height.saturating_mul(2), height)
        }
    };
    check_panorama(width, height).map(|()| (width, height))
}
