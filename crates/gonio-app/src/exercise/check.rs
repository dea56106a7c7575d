//! The check of the files in the editor.

use super::work::{Judged, Page, Work};
use crate::platform::{CheckRequest, CheckResult, Pending, Platform};
use egui::Context;
use gonio_check::submission::SourceFile;
use gonio_exercises::buffers;
use gonio_exercises::exercise::ExerciseKind;

/// A check, and the texts that it is of.
#[derive(Default)]
pub struct Check {
    running: Option<(Vec<SourceFile>, Box<dyn Pending<CheckResult>>)>,
}

impl Check {
    /// Starts a check of the files in the editor.
    pub fn start(&mut self, ctx: &Context, work: &mut Work, platform: &mut dyn Platform) {
        let content = work.content();
        self.running = Some((content.clone(), platform.check(request(work, &content), ctx)));
        work.checking = true;
        work.page = Page::Verdict;
    }

    /// Stops waiting for the verdict.
    pub fn stop(&mut self, work: &mut Work) {
        self.running = None;
        work.checking = false;
    }

    /// Shows the verdict once it has arrived.
    pub fn poll(&mut self, work: &mut Work) {
        if let Some((_, pending)) = &mut self.running
            && let Some(verdict) = pending.poll()
            && let Some((of, _)) = self.running.take()
        {
            work.judged = Some(Judged { verdict, of });
            work.checking = false;
            work.page = Page::Verdict;
        }
    }
}

/// The files that a check or a trial gets.
pub fn request(work: &Work, content: &[SourceFile]) -> CheckRequest {
    // Of several OpenGL programs or buffers, the one in the editor is checked.
    let endings: &[&str] = match work.exercise.kind {
        ExerciseKind::GlProgram => &[".txt"],
        ExerciseKind::Buffers => &buffers::ENDINGS,
        ExerciseKind::Shaders | ExerciseKind::Faces => &[],
    };
    let is_one = |name: &str| endings.iter().any(|ending| name.to_ascii_lowercase().ends_with(ending));
    let in_editor = work.files.get(work.current).map(|file| file.name.as_str()).filter(|name| is_one(name));
    let is_meant = |name: &str| in_editor.is_none_or(|meant| meant == name || !is_one(name));
    // A submission of pictures alone may consist of one picture.
    let is_paper = |name: &str| name.ends_with(".svg") && work.exercise.file(name).is_some();
    let meant = content.iter().filter(|file| is_meant(&file.name) && !is_paper(&file.name));
    let files = meant.map(|file| (file.name.clone(), file.bytes.clone())).collect();
    CheckRequest { exercise: work.exercise.id.clone(), files, as_the_lab: work.as_the_lab }
}
