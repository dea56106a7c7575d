//! A GL program: its calls are executed, its picture is written, its frame is listed.

use super::DrawArgs;
use crate::capture::CaptureRecorder;
use crate::commands::frame;
use crate::error::{CliError, CommandOutcome};
use crate::output::OutputPath;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use gonio_check::submission::SourceFile;
use gonio_exercises::gl_program::{self, GlProgram};
use gonio_gl::trace::Severity;
use gonio_render::gl_program::{GlProgramOptions, GlProgramRun};
use serde_json::json;

pub fn run(args: &DrawArgs, files: Vec<SourceFile>, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let program = the_program(&files)?;
    let recorder = args.capture.as_deref().map(CaptureRecorder::new).transpose()?;
    let context = super::context()?;
    let run = execute(args, &program, &files, recorder, &context)?;
    super::write_picture(args, run.size, upright(&run))?;
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
