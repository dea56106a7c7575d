//! `gonio lab draw`: the picture of a student's files, and the OpenGL calls behind it.

pub mod shaders;
pub mod show;

use super::{child_process, exercise, intake};
use crate::backend;
use crate::capture::{self, CaptureRecorder};
use crate::commands::frame::{self, Shown};
use crate::error::{CliError, CommandOutcome};
use crate::loading;
use crate::options::{CourseOptions, GeneralOptions, SceneOptions, values};
use crate::output::{OutputKind, OutputPath, check_stdout, color_tag};
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use gonio_check::submission::SourceFile;
use gonio_exercises::exercise::{Exercise, ExerciseKind};
use gonio_exercises::gl_program::{self, GlProgram};
use gonio_exercises::preview;
use gonio_gl::HeadlessContext;
use gonio_gl::trace::Severity;
use gonio_image::EncodedPicture;
use gonio_image::encode::png::{self, ColorTag, encode8};
use gonio_reference::ReferenceScene;
use gonio_render::gl_program::{GlProgramOptions, GlProgramRun};
use gonio_scene::DisplayMap;
use gonio_scene::files::BUILTIN;
use serde_json::json;
use show::ShownStage;
use std::path::PathBuf;

/// Draw a student's files, and list the OpenGL calls of the frame.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio lab draw ex07 mine -o mine.png
      The picture of a pair of shaders in the lab's own scene. --scene stretched shows what that scene hides.
  gonio lab draw ex07 mine --show 26:10 -o normals.png
      The values of the smallest expression around line 26, column 10 of the fragment shader, as colours. If gonio knows \
what they should be, the right ones are beside them.
  gonio lab draw ex11 host/texture-name-as-unit.txt -o triangle.png
      The picture of a GL program, whose OpenGL calls are executed.
  gonio lab draw ex11 host/texture-name-as-unit.txt --frame
      Its draw calls, samplers, the units and textures that they read, and what is wrong with them.
  gonio lab draw ex11 host/texture-name-as-unit.txt --capture triangle.rdc
      A capture for RenderDoc.
  gonio lab draw ex11 -o right.png
      Without files, the reference solution.")]
pub struct DrawArgs {
    /// Exercise: ex11, or 11.
    #[arg(value_name = "EX")]
    pub exercise: String,
    /// The student's files, or their folder or zip; by default the reference solution.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write the picture; - is stdout.
    #[arg(long, short, value_name = "FILE.png", help_heading = "Output options")]
    pub output: Option<OutputPath>,
    /// Pixels along each side of the picture.
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096),
          help_heading = "Output options")]
    pub size: u32,
    /// Also write a RenderDoc capture.
    #[arg(long, value_name = "FILE.rdc", help_heading = "Output options")]
    pub capture: Option<PathBuf>,
    /// Scene for a pair of shaders, by its name; by default the lab's own.
    #[arg(long, value_name = "NAME", help_heading = "Detail options")]
    pub scene: Option<String>,
    /// Instead of the shader's colours, show the values of the expression here.
    #[arg(long, value_name = "LINE:COLUMN", value_parser = show::line_and_column, conflicts_with = "capture",
          help_heading = "Detail options")]
    pub show: Option<[u32; 2]>,
    /// The shader that --show points into.
    #[arg(
        long,
        value_name = "STAGE",
        value_enum,
        default_value = "fragment",
        requires = "show",
        help_heading = "Detail options"
    )]
    pub file: ShownStage,
    /// List the draw calls, samplers, textures and programs of a GL program's frame.
    #[arg(long, help_heading = "Detail options")]
    pub frame: bool,
    /// Show one draw call of a GL program with everything it read, by its number.
    #[arg(long, value_name = "N", help_heading = "Detail options", conflicts_with = "program")]
    pub draw: Option<usize>,
    /// Show a program of a GL program with its GLSL, by its number.
    #[arg(long, value_name = "N", help_heading = "Detail options")]
    pub program: Option<usize>,
    /// Time in seconds, for a light that moves.
    #[arg(long, value_name = "SECONDS", value_parser = values::number, allow_negative_numbers = true, default_value = "0",
          help_heading = "Detail options")]
    pub time: f64,
    /// Draw in this process, which the caller guards.
    #[arg(long, hide = true)]
    pub in_this_process: bool,
    #[command(flatten)]
    pub course: CourseOptions,
    #[command(flatten)]
    pub general: GeneralOptions,
}

impl DrawArgs {
    /// The part of the frame to list.
    fn shown(&self) -> Option<Shown> {
        match (self.draw, self.program) {
            (Some(number), _) => Some(Shown::Draw(number)),
            (None, Some(number)) => Some(Shown::Program(number)),
            (None, None) => self.frame.then_some(Shown::Everything),
        }
    }
}

pub fn run(args: &DrawArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let exercise = exercise(&args.exercise)?;
    check_stdout(args.output.iter().map(|output| (output, OutputKind::Binary)), reporter)?;
    if !args.in_this_process {
        return child_process::run_again("--in-this-process");
    }
    if let Some(target) = &args.capture {
        capture::prepare(target)?;
    }
    if args.output.is_none() && args.capture.is_none() && args.shown().is_none() && !reporter.json() {
        return Err(CliError::new("no output was requested; `-o picture.png` writes the picture"));
    }
    child_process::end_with_the_caller();
    let submitted = match args.files.as_slice() {
        [] => {
            exercise.reference_files().map_err(CliError::new)?.map(|(name, text)| SourceFile::new(name, text)).collect()
        }
        named => intake::read(named)?,
    };
    for file in &submitted {
        reporter.verbose(format_args!("read `{}`, {} bytes", file.name, file.bytes.len()));
    }
    backend::report_driver(reporter);
    if let Some(place) = args.show {
        return show::run(args, place, exercise, submitted, reporter);
    }
    match exercise.kind {
        ExerciseKind::GlProgram => draw_gl_program(args, submitted, reporter),
        ExerciseKind::Shaders if preview::is_drawn(exercise) => shaders::run(args, exercise, submitted, reporter),
        _ => Err(CliError::new(format!("{} has no picture to draw", exercise.id))),
    }
}

/// The picture that the right answer draws, as PNG; an error if it cannot be drawn here.
pub fn goal(exercise: &'static Exercise, reporter: &Reporter) -> Result<Vec<u8>, CliError> {
    match exercise.kind {
        ExerciseKind::Baking => given_model(exercise, reporter),
        _ => shaders::goal(exercise),
    }
}

/// The model that the exercise hands out, by the CPU reference and without highlights, which no texture contains.
fn given_model(exercise: &Exercise, reporter: &Reporter) -> Result<Vec<u8>, CliError> {
    let model = exercise.given.first().ok_or_else(|| CliError::new(format!("{} has no model", exercise.id)))?;
    let options = SceneOptions { size: Some((512, 512)), ..SceneOptions::default() };
    let mut scene = loading::load_scene(&[format!("{BUILTIN}{model}")], &options, reporter)?;
    scene.materials.iter_mut().for_each(|material| material.material.specular = [0.0; 3]);
    let frame = scene.frame(0.0);
    let rendered = ReferenceScene::new(&scene).render(&frame, None, &|_| ());
    let map = DisplayMap::for_view(None, &frame);
    Ok(encode8(&rendered.picture.encode8(&map), color_tag(&map))?)
}

/// A context without a window.
pub fn context() -> Result<HeadlessContext, CliError> {
    HeadlessContext::new().map_err(|error| CliError::new(error.message))
}

/// Writes RGBA rows, the top row first, if there is an output. The lab's colours are written without encoding.
fn write_picture(args: &DrawArgs, size: [u32; 2], rgba: Vec<u8>) -> Result<(), CliError> {
    let Some(output) = &args.output else { return Ok(()) };
    if let Some(path) = output.file()
        && !path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"))
    {
        return Err(CliError::new(format!("`{output}`: pictures are written as .png only")));
    }
    output.write(&encoded(size, rgba)?)
}

fn encoded([width, height]: [u32; 2], rgba: Vec<u8>) -> Result<Vec<u8>, CliError> {
    Ok(png::encode8(&EncodedPicture { width, height, rgba }, ColorTag::Srgb)?)
}

fn draw_gl_program(args: &DrawArgs, files: Vec<SourceFile>, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let program = the_program(&files)?;
    let recorder = args.capture.as_deref().map(CaptureRecorder::new).transpose()?;
    let context = context()?;
    let run = execute(args, &program, &files, recorder, &context)?;
    write_picture(args, run.size, upright(&run))?;
    if reporter.json() {
        let refused = |error: &gonio_render::gl_program::CallError| {
            json!({
                "file": program.file, "line": error.line, "call": error.call, "error": error.code, "why": error.why,
            })
        };
        reporter.report(&json!({
            "command": "lab draw",
            "exercise": "ex11",
            "file": program.file,
            "size": run.size,
            "refused": run.errors.iter().map(refused).collect::<Vec<_>>(),
            "draw_lines": run.draw_lines,
            "findings": run.findings,
            "frame": run.record,
        }))?;
    } else {
        for error in &run.errors {
            reporter.warning(format!(
                "{}:{}: OpenGL rejects {} ({}): {}",
                program.file, error.line, error.call, error.code, error.why
            ));
        }
        if let Some(shown) = args.shown() {
            let page = page(&program, &run, shown)?;
            if args.output.as_ref().is_some_and(OutputPath::is_stdout) {
                reporter.text_on_stderr(&page);
            } else {
                reporter.text(&page)?;
            }
        }
    }
    std::mem::forget(context);
    Ok(CommandOutcome::Done)
}

/// The pixels in 8 bits, the top row first.
fn upright(run: &GlProgramRun) -> Vec<u8> {
    let rows = run.pixels.chunks_exact(run.size[0] as usize).rev();
    let byte = |channel: f32| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    rows.flatten().flat_map(|&[r, g, b, _]| [byte(r), byte(g), byte(b), u8::MAX]).collect()
}

fn the_program(files: &[SourceFile]) -> Result<GlProgram, CliError> {
    let programs: Vec<&SourceFile> = files.iter().filter(|file| file.name.ends_with(".txt")).collect();
    let [file] = programs.as_slice() else {
        return Err(CliError::new(match programs.len() {
            0 => "there is no GL program among the files; the exercise's text describes its .txt file".to_owned(),
            count => format!("there are {count} GL programs among the files; name the one to draw"),
        }));
    };
    GlProgram::parse_bytes(&file.bytes, &file.name)
        .map_err(|errors| CliError::lines(errors.iter().map(ToString::to_string)))
}

fn execute(
    args: &DrawArgs,
    program: &GlProgram,
    files: &[SourceFile],
    recorder: Option<CaptureRecorder>,
    context: &gonio_gl::HeadlessContext,
) -> Result<GlProgramRun, CliError> {
    let mut known = gl_program::exercise_files();
    // The student's shaders, by their names without folders: `create_program` looks for them beside the program.
    for file in files.iter().filter(|file| !file.name.ends_with(".txt")) {
        let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
        if let Ok(text) = std::str::from_utf8(&file.bytes) {
            known.shaders.insert(name.to_owned(), text.to_owned());
        }
    }
    let known = gl_program::for_context(context.gl(), &known);
    let options = GlProgramOptions { size: [args.size; 2], float: false, thumbnails: false };
    let mut recorder = recorder;
    if let Some(recorder) = &mut recorder {
        recorder.start();
    }
    let run = gl_program::run(context.gl(), &program.steps, &known, options);
    if let Some(recorder) = recorder {
        recorder.finish(context.gl())?;
    }
    run.map_err(|failure| CliError::new(format!("{}: {failure}", program.file)))
}

/// The frame as text, with the program's line of each draw call.
fn page(program: &GlProgram, run: &GlProgramRun, shown: frame::Shown) -> Result<TerminalPage, CliError> {
    let about = format!("frame of {}, {} x {} pixels", program.file, run.size[0], run.size[1]);
    let mut text = frame::page(&about, &run.record, &run.findings, shown)?;
    if shown == frame::Shown::Everything {
        let wrong = run.findings.iter().any(|finding| finding.severity == Severity::Error);
        for (number, line) in run.draw_lines.iter().enumerate() {
            let quoted = program.quoted(*line).unwrap_or_default();
            if number == 0 {
                text.blank();
            }
            text.line(format_args!("draw {number} is line {line}: {}", quoted.replace('\t', "    ")));
        }
        if wrong {
            text.line("`--draw 0` shows everything that the first one read.");
        }
    }
    Ok(text)
}
