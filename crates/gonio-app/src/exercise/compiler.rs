//! What is done with the work: pairs compiled as they are written, checks begun and heard, files saved and read again.

use super::preview::Preview;
use super::trials::{ContentKey, Trials};
use super::work::{Judged, OpenFile, Page, ProgramFacts, Work};
use super::{Command, editor};
use crate::files;
use crate::platform::{CheckRequest, Checking, Platform, TrialOutcome};
use crate::scene_view::drawing::PaneRenderer;
use egui::Context;
use gonio_check::submission::SourceFile;
use gonio_exercises::buffers;
use gonio_exercises::exercise::ExerciseKind;
use gonio_exercises::preview::{Note, NoteKind, SubmittedPair};
use gonio_scene::files::{Disk, FileBytes, FileSource};
use std::path::PathBuf;
use std::time::Duration;
use web_time::Instant;

/// Most bytes of a student's file that is read again.
const MOST_BYTES: u64 = 32 << 20;
/// After the last key a pair is compiled: sooner, and half-written words would be errors.
const PAUSE: Duration = Duration::from_millis(300);

/// What is under way.
#[derive(Default)]
pub struct Compiler {
    preview: Option<Preview>,
    /// The texts as they were seen last, and since when they are these.
    seen: Option<(Vec<SourceFile>, Instant)>,
    /// Those that were compiled.
    compiled: Option<Vec<SourceFile>>,
    trials: Trials,
    checking: Option<(Vec<SourceFile>, Box<dyn Checking>)>,
    failed: bool,
}

impl Compiler {
    /// What is on the GPU.
    pub fn preview(&self) -> Option<&Preview> {
        self.preview.as_ref()
    }

    /// What is on the GPU, to be drawn.
    pub fn preview_mut(&mut self) -> Option<&mut Preview> {
        self.preview.as_mut()
    }

    /// Forgets what lay on the GPU; it is made anew when there is one.
    pub fn release(&mut self) {
        (self.preview, self.compiled, self.failed) = (None, None, false);
    }

    /// Other files are open: they are compiled at once, not after a pause.
    pub fn begin_anew(&mut self) {
        self.seen = None;
    }

    /// To be called in every frame: compiles what was written a moment ago, and hears what came of checks.
    pub fn follow(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        pane_renderer: Option<&PaneRenderer>,
        platform: &mut dyn Platform,
        said: &mut Vec<String>,
    ) {
        if let (None, Some(pane_renderer), false) = (&self.preview, pane_renderer, self.failed) {
            match Preview::new(pane_renderer.gl(), work) {
                Ok(preview) => self.preview = Some(preview),
                Err(why) => {
                    // Told once, not in every frame.
                    self.failed = true;
                    said.push(why.to_string());
                }
            }
        }
        work.downloads = !platform.has_folders();
        self.hear(work);
        self.announce_trial(ctx, work);
        let content = work.content();
        match &self.seen {
            Some((seen, since)) if *seen == content => {
                let waited = since.elapsed();
                if self.compiled.as_ref() != Some(&content) && waited < PAUSE && !self.is_tried(&content) {
                    ctx.request_repaint_after(PAUSE - waited);
                    return;
                }
            }
            // What was opened, or undone, is compiled at once; what is being written, after a pause.
            seen => {
                let is_first = seen.is_none();
                self.seen = Some((content.clone(), Instant::now()));
                // The one that is running is of a text that was changed.
                self.trials.cancel();
                work.program.is_tried = false;
                if !is_first && !self.is_tried(&content) {
                    ctx.request_repaint_after(PAUSE);
                    return;
                }
            }
        }
        if self.compiled.as_ref() != Some(&content) {
            self.compile(ctx, work, content, platform);
        }
    }

    fn is_tried(&self, content: &[SourceFile]) -> bool {
        self.trials.known(ContentKey::new(content)).is_some()
    }

    /// Says that a trial is running only if it takes long: otherwise the words would flash up at each change.
    fn announce_trial(&self, ctx: &Context, work: &mut Work) {
        let slow = self.trials.slow();
        work.program.is_trial_slow = slow == Some(Ok(()));
        if let Some(Err(left)) = slow {
            ctx.request_repaint_after(left);
        }
    }

    fn compile(&mut self, ctx: &Context, work: &mut Work, content: Vec<SourceFile>, platform: &mut dyn Platform) {
        if work.exercise.kind != ExerciseKind::Shaders {
            self.compiled = Some(content);
            return;
        }
        let key = ContentKey::new(&content);
        let outcome = self.trials.known(key).cloned();
        if let Some(TrialOutcome::Refused(why)) = outcome {
            self.compiled = Some(content);
            return refuse(work, why);
        }
        // The exercise's own files are harmless.
        if outcome.is_none() && platform.tries_every_pair() && !is_start(work, &content) {
            return self.try_first(ctx, work, key, &content, platform);
        }
        let source = match SubmittedPair::gather(work.exercise, content.clone()) {
            Ok(source) => source,
            Err(why) => {
                self.compiled = Some(content);
                return refuse(work, why);
            }
        };
        match outcome {
            None if source.is_risky() => return self.try_first(ctx, work, key, &content, platform),
            Some(TrialOutcome::Unavailable(why)) if source.is_risky() => {
                self.compiled = Some(content);
                return refuse(work, format!("This shader is not drawn because it could not be tested: {why}"));
            }
            Some(_) | None => {}
        }
        self.compiled = Some(content);
        let Some(preview) = &mut self.preview else {
            // To be compiled when there is something to draw with.
            self.compiled = None;
            return;
        };
        let variables = std::mem::take(&mut work.program.variables);
        work.program = match preview.compile(&source) {
            Ok(pair) => ProgramFacts {
                notes: pair.notes.clone(),
                warnings: pair.warnings.clone(),
                unusable: (!pair.has_position()).then(|| {
                    "Nothing is drawn: no attribute was recognised as the position. Name it `position`, or declare it in \
                     names.toml"
                        .to_owned()
                }),
                is_drawn: true,
                ..ProgramFacts::default()
            },
            Err(notes) => {
                let is_drawn = work.program.is_drawn;
                ProgramFacts {
                    notes: without_repeats(notes),
                    is_drawn,
                    is_old: is_drawn,
                    variables,
                    ..ProgramFacts::default()
                }
            }
        };
    }

    /// Begins a trial, unless it is running already; the pair is compiled when that has ended.
    fn try_first(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        key: ContentKey,
        content: &[SourceFile],
        platform: &mut dyn Platform,
    ) {
        if !self.trials.is_running(key) {
            self.trials.start(key, platform.trial(request(work, content), ctx));
            work.program.is_tried = true;
            work.trials += 1;
        }
    }

    /// What came of the trial and of the check.
    fn hear(&mut self, work: &mut Work) {
        self.trials.poll();
        work.program.is_tried = self.trials.slow().is_some();
        if let Some((_, checking)) = &mut self.checking
            && let Some(verdict) = checking.poll()
            && let Some((of, _)) = self.checking.take()
        {
            work.judged = Some(Judged { verdict, of });
            work.checking = false;
            work.page = Page::Verdict;
        }
    }

    /// Does what was asked for.
    pub fn apply(
        &mut self,
        ctx: &Context,
        work: &mut Work,
        command: Command,
        platform: &mut dyn Platform,
        said: &mut Vec<String>,
    ) {
        let current = work.current;
        match command {
            Command::Check => {
                let content = work.content();
                self.checking = Some((content.clone(), platform.check(request(work, &content), ctx)));
                work.checking = true;
                work.page = Page::Verdict;
            }
            Command::StopChecking => {
                self.checking = None;
                work.checking = false;
            }
            Command::Save => {
                said.extend(save(work, platform));
                if work.asking.is_some() {
                    editor::let_go(ctx, work);
                }
            }
            Command::SaveInto(folder) => said.extend(save_into(work, &folder, platform)),
            Command::Undo | Command::Redo => {
                if let Some(file) = work.files.get_mut(current) {
                    editor::step(ctx, file, command == Command::Redo);
                }
            }
            Command::TakeOther(index) => {
                if let Some(file) = work.files.get_mut(index)
                    && let Some(other) = file.other.take()
                {
                    editor::remember(ctx, file);
                    file.take(other);
                }
            }
            Command::KeepMine(index) => {
                if let Some(file) = work.files.get_mut(index) {
                    // It is on the disk, so it is what a change is told against.
                    if let Some(other) = file.other.take() {
                        file.saved = other;
                    }
                    said.extend(save(work, platform));
                }
            }
            Command::DiscardRestored => {
                for file in work.files.iter_mut().filter(|file| file.is_restored() && file.other.is_none()) {
                    editor::remember(ctx, file);
                    file.take(file.saved.clone());
                }
            }
            Command::KeepRestored => work.files.iter_mut().for_each(|file| file.restored = None),
            Command::PutBack => {
                work.put_back();
                self.begin_anew();
                // Nobody watched them while they were away.
                let paths: Vec<PathBuf> = work.files.iter().filter_map(|file| file.path.clone()).collect();
                said.extend(read_again(ctx, work, &paths));
            }
            Command::BeginAgain => {
                work.begin_again();
                self.begin_anew();
            }
            Command::StartFiles => {
                let name = format!("{}.zip", work.exercise.id);
                said.extend(platform.write(&name, &start_files(work)).err());
            }
            Command::Begin(_) | Command::List | Command::Leave | Command::Open | Command::Theme => {}
        }
    }
}

/// There is no pair, or none that may be drawn here: the last one that was drawn stays.
fn refuse(work: &mut Work, why: String) {
    let is_drawn = work.program.is_drawn;
    let variables = std::mem::take(&mut work.program.variables);
    work.program =
        ProgramFacts { unusable: Some(why), is_drawn, is_old: is_drawn, variables, ..ProgramFacts::default() };
}

/// Whether these are the files that the exercise is begun with, unchanged.
fn is_start(work: &Work, content: &[SourceFile]) -> bool {
    let start = work.exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    start.eq(content.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))
}

/// What one starts from, as one file: texts and pictures.
fn start_files(work: &Work) -> Vec<u8> {
    let texts = work.exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    files::pack(&texts.chain(work.exercise.pictures()).collect::<Vec<_>>())
}

fn request(work: &Work, content: &[SourceFile]) -> CheckRequest {
    // Of several host programs or buffers the one in the editor is meant.
    let endings: &[&str] = match work.exercise.kind {
        ExerciseKind::GlProgram => &[".txt"],
        ExerciseKind::Buffers => &buffers::ENDINGS,
        ExerciseKind::Shaders | ExerciseKind::Faces => &[],
    };
    let is_one = |name: &str| endings.iter().any(|ending| name.to_ascii_lowercase().ends_with(ending));
    let in_editor = work.files.get(work.current).map(|file| file.name.as_str()).filter(|name| is_one(name));
    let is_meant = |name: &str| in_editor.is_none_or(|meant| meant == name || !is_one(name));
    // A single picture is the answer where nothing but pictures is handed in.
    let is_paper = |name: &str| name.ends_with(".svg") && work.exercise.file(name).is_some();
    let meant = content.iter().filter(|file| is_meant(&file.name) && !is_paper(&file.name));
    let files = meant.map(|file| (file.name.clone(), file.bytes.clone())).collect();
    CheckRequest { exercise: work.exercise.id.clone(), files, as_the_lab: work.as_the_lab }
}

/// What both compilers say of a line is said once.
fn without_repeats(notes: Vec<Note>) -> Vec<Note> {
    let mut kept: Vec<Note> = Vec::new();
    for note in notes {
        let is_known = kept.iter().any(|known| known.kind == NoteKind::Error && known.message == note.message);
        if !is_known {
            kept.push(note);
        }
    }
    kept
}

/// Saves the files that were changed: on the disk to where they lie, in memory to where the person says. What could not be
/// saved is a sentence each.
fn save(work: &mut Work, platform: &mut dyn Platform) -> Vec<String> {
    let in_memory = work.files.iter().all(|file| file.path.is_none());
    let mut said = Vec::new();
    if platform.has_folders() && work.files.iter().any(|file| file.path.is_none() && (in_memory || file.is_changed())) {
        // Beside those that have a place already.
        let beside = work.files.iter().find_map(|file| Some(file.path.as_ref()?.parent()?.display().to_string()));
        work.asking = Some(beside.unwrap_or_else(|| work.exercise.id.clone()));
        if in_memory {
            return said;
        }
    }
    let current = work.current;
    for (index, file) in work.files.iter_mut().enumerate() {
        // What changed on the disk meanwhile is not written over before the person has chosen.
        if file.locked || file.other.is_some() || !(file.is_changed() || (in_memory && index == current)) {
            continue;
        }
        let bytes = file.text.clone().into_bytes();
        let place = match &file.path {
            Some(path) => path.to_string_lossy(),
            None if platform.has_folders() => continue,
            // A download has no folders.
            None => file.name.rsplit('/').next().unwrap_or_default().into(),
        };
        match platform.write(&place, &bytes) {
            Ok(_) => file.saved = bytes,
            Err(why) => said.push(why),
        }
    }
    said
}

/// Saves files that are in memory into a folder, which is made where it is not there; nothing is written over. Where others
/// have a place already, those that nothing was written in stay in memory.
fn save_into(work: &mut Work, folder: &str, platform: &mut dyn Platform) -> Vec<String> {
    let folder = PathBuf::from(folder);
    let place = |name: &str| folder.join(name);
    let in_memory = work.files.iter().all(|file| file.path.is_none());
    let is_meant = |file: &OpenFile| file.path.is_none() && (in_memory || file.is_changed());
    if let Some(file) = work.files.iter().find(|file| is_meant(file) && place(&file.name).exists()) {
        return vec![format!("{} already exists: choose another folder", place(&file.name).display())];
    }
    for file in work.files.iter_mut().filter(|file| is_meant(file)) {
        let path = place(&file.name);
        let made = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        if let Err(why) = made {
            return vec![format!("{} could not be created: {why}", folder.display())];
        }
        let bytes = file.content();
        match platform.write(&path.to_string_lossy(), &bytes) {
            Ok(_) => (file.saved, file.path) = (bytes, Some(path)),
            Err(why) => return vec![why],
        }
    }
    Vec::new()
}

/// Reads files again that another program changed. What could not be read is a sentence each.
pub fn read_again(ctx: &Context, work: &mut Work, paths: &[PathBuf]) -> Vec<String> {
    let mut said = Vec::new();
    for file in &mut work.files {
        let Some(path) = file.path.as_ref().filter(|path| paths.contains(path)) else { continue };
        match Disk.read_within(path, MOST_BYTES).map(FileBytes::into_vec) {
            Ok(bytes) => {
                let before = file.clone();
                if file.is_now(bytes) {
                    editor::remember(ctx, &before);
                }
            }
            Err(why) => said.push(format!("{} could not be reloaded: {why}", path.display())),
        }
    }
    said
}
