//! Warnings about GL programs that run here and may not elsewhere.

use super::findings::GlProgramWarning;
use super::program::GlProgram;
use gonio_gl::trace::{Rule, Severity};
use gonio_render::gl_program::{Call, GlProgramRun, Selector};

/// Warnings about a program; about one whose picture is wrong only what has nothing to do with that.
pub fn collect(program: &GlProgram, run: &GlProgramRun, right: bool) -> Vec<GlProgramWarning> {
    let mut warnings = Vec::new();
    if right {
        // Refused calls are told below, at their own lines.
        for finding in run.findings.iter().filter(|finding| finding.rule != Rule::OpenGlError) {
            let line = run.draw_lines.get(finding.draw).copied();
            let text = match finding.severity {
                Severity::Warning => format!("{} ({})", finding.message, finding.advice),
                Severity::Error => format!("{}, although the picture is right", finding.message),
            };
            warnings.push(GlProgramWarning { line, text });
        }
        for error in &run.errors {
            let text = format!("OpenGL rejects {} with {}: {}", error.call, error.code, error.why);
            warnings.push(GlProgramWarning { line: Some(error.line), text });
        }
    }
    depth_never_cleared(program, &mut warnings);
    dark_edges(program, &mut warnings);
    unknown_uniforms(program, run, &mut warnings);
    warnings
}

/// A program draws many frames: in the second one, the depths of the first are still there.
fn depth_never_cleared(program: &GlProgram, warnings: &mut Vec<GlProgramWarning>) {
    let on =
        program.steps.iter().find(|s| matches!(&s.call, Call::Switch { what, on: true } if what.name == "DEPTH_TEST"));
    let cleared = program
        .steps
        .iter()
        .any(|step| matches!(&step.call, Call::Clear(bits) if bits.iter().any(|bit| bit.name == "DEPTH_BUFFER_BIT")));
    if let (Some(step), false) = (on, cleared) {
        let text = "DEPTH_TEST is on and no call clears DEPTH_BUFFER_BIT: a second frame would stay empty".to_owned();
        warnings.push(GlProgramWarning { line: Some(step.line), text });
    }
}

/// OpenGL passes over them without a word.
fn unknown_uniforms(program: &GlProgram, run: &GlProgramRun, warnings: &mut Vec<GlProgramWarning>) {
    let Some(drawn) = run.record.draws.last().and_then(|draw| run.record.program_of(draw)) else { return };
    for step in &program.steps {
        let Call::Uniform { uniform, .. } = &step.call else { continue };
        let bare = uniform.strip_suffix("[0]").unwrap_or(uniform);
        if !drawn.uniforms.iter().any(|known| known.name == bare) {
            let text = format!("the program needs no uniform `{uniform}`, and OpenGL says nothing");
            warnings.push(GlProgramWarning { line: Some(step.line), text });
        }
    }
}

/// One does not see it where the coordinates end with the triangle.
fn dark_edges(program: &GlProgram, warnings: &mut Vec<GlProgramWarning>) {
    for step in &program.steps {
        let Call::TexParameter { value: Selector::Constant(value), .. } = &step.call else { continue };
        if value.name == "CLAMP_TO_BORDER" {
            let text = "CLAMP_TO_BORDER mixes the border's colour, black, into the texture's edge".to_owned();
            warnings.push(GlProgramWarning { line: Some(step.line), text });
        }
    }
}
