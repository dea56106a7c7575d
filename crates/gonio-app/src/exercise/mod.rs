//! The exercise view: an exercise's text, the student's files in an editor, their picture beside the correct answer's,
//! and the verdict.
//!
//! | file | contents |
//! |---|---|
//! | `work` | the open exercise as plain data |
//! | `file_sets`, `saving` | a student's files in place of the open ones; files on disk |
//! | `command` | commands of widgets and keys, and the exercise to start |
//! | `check` | checks, and trials of shaders outside of the window |
//! | `compiler`, `preview` | shaders compiled as they are typed; their pictures |
//! | `drafts` | unsaved text, kept for the next window |
//! | `fix` | the proposed fix of a verdict |
//! | `editor` | the files' texts, with colours and marked lines |
//! | `toolbar`, `list` | the toolbar; the exercises |
//! | `thumbnails`, `goal_pictures` | the pictures of their goals: drawn, or built in |
//! | `pictures`, `lamp` | the pictures and their settings; the lamp in them |
//! | `markdown`, `figure`, `pages` | the pages: the text and its figures; the verdict and the variables |
//! | `state_json` | its part of the exported state |
//!
//! It is independent of the scene and its document.

mod check;
mod command;
mod compiler;
pub(crate) mod drafts;
mod editor;
mod figure;
mod file_sets;
mod fix;
mod goal_pictures;
mod lamp;
mod list;
mod markdown;
mod pages;
mod picture_files;
mod pictures;
mod preview;
mod saving;
mod state_json;
mod thumbnails;
mod toolbar;
mod work;

pub use crate::step::code::{Mark, MarkKind};
pub use command::{ExerciseCommand, Start};
pub use drafts::MOST_AGE as MOST_AGE_OF_DRAFTS;
pub use file_sets::{OpenFileSet, ReplaceOutcome};
pub use preview::PreviewPicture;
pub use work::{ExercisePage, Hints, Judged, OpenFile, PictureMode, ProgramFacts, Work};

use crate::action::Action;
use crate::exported::{self, WidgetRole};
use crate::files::ExerciseFile;
use crate::platform::Platform;
use crate::scene_view::drawing::PaneRenderer;
use crate::step::{self, Stepper};
use crate::widgets::page_tabs;
use check::Check;
use compiler::Compiler;
use drafts::Drafts;
use egui::{Context, Frame, Margin, Panel, ScrollArea, Ui};
use goal_pictures::GoalPictures;
use gonio_check::verdict::Outcome;
use gonio_exercises::exercise::ExerciseKind;
use gonio_gl::GlError;
use gonio_language::tr;
use std::collections::BTreeMap;
use std::path::PathBuf;
use thumbnails::Thumbnails;

/// Below this width (points) everything is stacked: a phone in portrait orientation.
const NARROW: f32 = 720.0;

/// The exercise view.
#[derive(Default)]
pub struct ExerciseView {
    /// Whether it is shown in place of the scene.
    pub is_open: bool,
    /// The open exercise.
    pub work: Option<Work>,
    /// Other exercises in progress, with all edits.
    aside: Vec<Work>,
    /// Whether the list of exercises is shown.
    is_listing: bool,
    compiler: Compiler,
    check: Check,
    drafts: Drafts,
    stepper: Stepper,
    thumbnails: Option<Thumbnails>,
    goal_pictures: GoalPictures,
    /// The outcome of the last check of each exercise, by id.
    pub outcomes: BTreeMap<String, Outcome>,
    /// A verdict that has just arrived, in words for screen readers.
    pub announcement: Option<String>,
}

impl ExerciseView {
    /// Starts an exercise with these files; without any, resumes it, or starts with the original files. An unknown
    /// id gives an error of one sentence.
    pub fn begin(&mut self, start: Start) -> Result<(), String> {
        let exercise = gonio_exercises::exercise::find(&start.exercise)
            .ok_or_else(|| tr!("exercise-unknown-exercise-select-one-from-the", exercise = start.exercise))?;
        (self.is_open, self.is_listing) = (true, false);
        if start.files.is_empty() && self.work.as_ref().is_some_and(|work| work.exercise.id == exercise.id) {
            return Ok(());
        }
        let known = self.aside.iter().position(|work| start.files.is_empty() && work.exercise.id == exercise.id);
        let next = match known {
            Some(index) => self.aside.remove(index).resumed(),
            None => Work::new(exercise, start.files),
        };
        (self.compiler, self.check) = (Compiler::default(), Check::default());
        self.stepper = Stepper::default();
        self.aside.extend(self.work.replace(next));
        Ok(())
    }

    /// Shows the list of exercises.
    pub fn list(&mut self) {
        (self.is_open, self.is_listing) = (true, true);
    }

    /// All exercises in progress.
    pub fn works(&self) -> impl Iterator<Item = &Work> {
        self.work.iter().chain(&self.aside)
    }

    /// Restores unsaved text of an earlier window into the open files. Returns a sentence for each failure.
    pub fn restore_drafts(&mut self, ctx: &egui::Context, platform: &mut dyn Platform) -> Vec<String> {
        self.work.as_mut().map_or_else(Vec::new, |work| self.drafts.restore(ctx, work, platform))
    }

    /// Keeps unsaved text for the next window, a moment after it was typed; called in every frame.
    pub fn follow_drafts(&mut self, ctx: &egui::Context, platform: &mut dyn Platform) -> Vec<String> {
        self.drafts.follow(ctx, self.work.iter().chain(&self.aside), platform)
    }

    /// Keeps unsaved text for the next window now.
    pub fn flush_drafts(&mut self, platform: &mut dyn Platform) -> Vec<String> {
        self.drafts.flush(self.work.iter().chain(&self.aside), platform)
    }

    /// Number of drafts.
    pub fn drafts(&self) -> usize {
        self.drafts.count()
    }

    /// Files on disk to watch.
    pub fn paths(&self) -> Vec<std::path::PathBuf> {
        self.works().flat_map(|work| work.files.iter().filter_map(|file| file.path.clone())).collect()
    }

    /// Opens a student's files in place of those for the same purpose.
    pub fn take(&mut self, files: Vec<ExerciseFile>) -> ReplaceOutcome {
        match self.work.as_mut().filter(|_| !self.is_listing) {
            Some(work) => {
                let taken = work.take(files);
                self.compiler.restart();
                taken
            }
            None => {
                let ignored = tr!("exercise-select-the-exercise-first-then-open");
                ReplaceOutcome { announcement: None, ignored: Some(ignored.to_owned()) }
            }
        }
    }

    /// The exercise's part of the exported state: see [`exported::state`].
    pub fn state(&self) -> serde_json::Value {
        state_json::build(self)
    }

    /// Drops everything on the GPU, because its context is lost or will be.
    pub fn release(&mut self) {
        self.compiler.release();
        self.thumbnails = None;
    }

    /// The pixels of a picture as last drawn, for tests: RGBA, the top row first; and its width and height.
    pub fn pixels(&self, picture: PreviewPicture) -> Option<(Vec<u8>, [u32; 2])> {
        self.compiler.preview()?.pixels(picture)
    }

    /// Number of pictures drawn since the exercise was opened.
    pub fn pictures(&self) -> u64 {
        self.compiler.preview().map_or(0, |preview| preview.pictures)
    }

    /// Shows a frame. Returns errors, a sentence each.
    pub fn ui(
        &mut self,
        ui: &mut Ui,
        pane_renderer: Option<&mut PaneRenderer>,
        platform: &mut dyn Platform,
        actions: &mut Vec<Action>,
    ) -> Vec<String> {
        let mut failures = Vec::new();
        let mut commands = Vec::new();
        let ctx = ui.ctx().clone();
        let work = self.work.as_mut().filter(|_| !self.is_listing);
        toolbar::keys(ui, work.as_deref(), &mut commands);
        if work.as_ref().is_some_and(|work| work.asking.is_none() && work.exercise.kind == ExerciseKind::Shaders) {
            step::bar::keys(ui, &mut self.stepper);
        }
        let Some(work) = work else {
            toolbar::show(ui, None, &mut commands);
            failures.extend(
                self.show_list(ui, pane_renderer, platform, &mut commands).err().map(|error| error.to_string()),
            );
            self.apply(&ctx, commands, platform, actions, &mut failures);
            return failures;
        };
        let seconds = ctx.input(|i| f64::from(i.stable_dt));
        work.clock.advance(seconds);
        self.check.expect(platform);
        let was_checking = work.checking;
        if let Some(outcome) = self.check.poll(work) {
            self.outcomes.insert(work.exercise.id.clone(), outcome);
        }
        if was_checking && !work.checking {
            self.announcement = pages::spoken(work);
        }
        self.compiler.follow(&ctx, work, pane_renderer.as_deref(), platform, &mut failures);
        toolbar::show(ui, Some(work), &mut commands);
        let drawn = if ui.available_width() < NARROW {
            narrow(ui, work, self.compiler.preview_mut(), pane_renderer, &mut self.stepper, &mut commands)
        } else {
            wide(ui, work, self.compiler.preview_mut(), pane_renderer, &mut self.stepper, &mut commands)
        };
        if let Err(error) = drawn {
            failures.push(error.to_string());
        }
        self.stepper.follow(&ctx, platform);
        if work.clock.playing {
            ctx.request_repaint();
        }
        self.apply(&ctx, commands, platform, actions, &mut failures);
        failures
    }

    fn show_list(
        &mut self,
        ui: &mut Ui,
        panes: Option<&mut PaneRenderer>,
        platform: &dyn Platform,
        commands: &mut Vec<ExerciseCommand>,
    ) -> Result<(), GlError> {
        if let (None, Some(panes)) = (&self.thumbnails, &panes) {
            self.thumbnails = Some(Thumbnails::new(panes.gl())?);
        }
        let begun: Vec<&Work> = self.work.iter().chain(&self.aside).collect();
        let progress = list::ExerciseProgress { begun: &begun, outcomes: &self.outcomes };
        let files = platform.files();
        let goals = list::Goals { drawn: self.thumbnails.as_mut(), built_in: &mut self.goal_pictures, files: &*files };
        list::show(ui, &progress, goals, panes, commands)
    }

    /// Applies commands.
    fn apply(
        &mut self,
        ctx: &egui::Context,
        commands: Vec<ExerciseCommand>,
        platform: &mut dyn Platform,
        actions: &mut Vec<Action>,
        failures: &mut Vec<String>,
    ) {
        for command in commands {
            ctx.request_repaint();
            match command {
                ExerciseCommand::Begin(exercise) => actions.push(Action::StartExercise(exercise)),
                ExerciseCommand::List => actions.push(Action::ListExercises),
                ExerciseCommand::Open => {
                    // The path field gets the keyboard focus, if there is one.
                    self.work.as_ref().inspect(|work| editor::release_focus(ctx, work));
                    actions.push(Action::ChooseFiles);
                }
                ExerciseCommand::Leave => self.is_open = false,
                ExerciseCommand::Theme => actions.push(Action::ToggleTheme),
                ExerciseCommand::SetLanguage(language) => actions.push(Action::SetLanguage(language)),
                other => {
                    if let Some(work) = &mut self.work {
                        failures.extend(apply_to_work(ctx, other, work, &mut self.compiler, &mut self.check, platform));
                    }
                }
            }
        }
    }

    /// Reloads files that another program changed on disk. Returns a sentence for each failure.
    pub fn changed(&mut self, ctx: &egui::Context, paths: &[std::path::PathBuf]) -> Vec<String> {
        let works = self.work.iter_mut().chain(&mut self.aside);
        works.flat_map(|work| saving::read_again(ctx, work, paths)).collect()
    }
}

type Drawn = Result<(), gonio_gl::GlError>;

/// The layout of a wide window: the editor at the left, the picture above a page at the right.
fn wide(
    ui: &mut Ui,
    work: &mut Work,
    preview: Option<&mut preview::Preview>,
    pane_renderer: Option<&mut PaneRenderer>,
    stepper: &mut Stepper,
    commands: &mut Vec<ExerciseCommand>,
) -> Drawn {
    if work.page == ExercisePage::Editor {
        work.page = ExercisePage::Text;
    }
    let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 6));
    let width = 0.48 * ui.available_width();
    Panel::left("exercise files").frame(inside).default_size(width).size_range(280.0..=1200.0).show(ui, |ui| {
        edit(ui, work, stepper, commands);
    });
    let height = 0.5 * ui.available_height();
    let page = Panel::bottom("exercise page").frame(inside).default_size(height).size_range(120.0..=1200.0);
    page.resizable(true).show(ui, |ui| {
        pages(ui, work, &[ExercisePage::Text, ExercisePage::Verdict, ExercisePage::Variables]);
        page_of(ui, work, commands);
    });
    egui::CentralPanel::no_frame().show(ui, |ui| pictures::show(ui, work, preview, pane_renderer, stepper)).inner
}

/// The layout of a narrow window: the picture above one page.
fn narrow(
    ui: &mut Ui,
    work: &mut Work,
    preview: Option<&mut preview::Preview>,
    pane_renderer: Option<&mut PaneRenderer>,
    stepper: &mut Stepper,
    commands: &mut Vec<ExerciseCommand>,
) -> Drawn {
    let height = (0.36 * ui.available_height()).max(120.0);
    let drawn = Panel::top("exercise picture").frame(Frame::NONE).exact_size(height).resizable(false);
    let drawn = drawn.show(ui, |ui| pictures::show(ui, work, preview, pane_renderer, stepper)).inner;
    let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 6));
    egui::CentralPanel::default().frame(inside).show(ui, |ui| {
        pages(ui, work, &[ExercisePage::Editor, ExercisePage::Text, ExercisePage::Verdict, ExercisePage::Variables]);
        if work.page == ExercisePage::Editor {
            edit(ui, work, stepper, commands);
        } else {
            page_of(ui, work, commands);
        }
    });
    drawn
}

fn edit(ui: &mut Ui, work: &mut Work, stepper: &mut Stepper, commands: &mut Vec<ExerciseCommand>) {
    commands.extend(editor::show(ui, work, stepper));
}

/// The tabs of the pages.
fn pages(ui: &mut Ui, work: &mut Work, pages: &[ExercisePage]) {
    let tab = |page: &ExercisePage| match page {
        ExercisePage::Editor => (*page, tr!("exercise-files"), "files"),
        ExercisePage::Text => (*page, tr!("exercise-exercise"), "text"),
        ExercisePage::Verdict => (*page, tr!("exercise-verdict"), "verdict"),
        ExercisePage::Variables => (*page, tr!("exercise-variables"), "variables"),
    };
    page_tabs(ui, &mut work.page, &pages.iter().map(tab).collect::<Vec<_>>());
}

fn page_of(ui: &mut Ui, work: &mut Work, commands: &mut Vec<ExerciseCommand>) {
    let salt = (work.exercise.id.as_str(), work.page as u8);
    ScrollArea::vertical().id_salt(salt).auto_shrink([false, false]).show(ui, |ui| match work.page {
        ExercisePage::Text | ExercisePage::Editor => {
            markdown::show(ui, work.exercise);
            start_files(ui, work, commands);
        }
        ExercisePage::Verdict => pages::verdict(ui, work, commands),
        ExercisePage::Variables => pages::variables(ui, work),
    });
}

/// Buttons to start over and to download the original files.
fn start_files(ui: &mut Ui, work: &Work, commands: &mut Vec<ExerciseCommand>) {
    ui.horizontal_wrapped(|ui| {
        let mut button = |id: &str, label: &str, tip: &str, command: ExerciseCommand| {
            let button = ui.button(label);
            exported::note(ui, &button, id, WidgetRole::Button, label, "");
            if button.on_hover_text(tip).clicked() {
                commands.push(command);
            }
        };
        let tip = tr!("exercise-start-over-with-the-original-files");
        button("begin-again", tr!("exercise-start-over"), tip, ExerciseCommand::BeginAgain);
        if work.downloads {
            let label = tr!("exercise-download-zip", id = work.exercise.id);
            let tip = tr!("exercise-the-text-its-figures-and-the");
            button("start-files", &label, tip, ExerciseCommand::StartFiles);
        }
    });
    ui.add_space(40.0);
}

/// Applies a command to the open exercise. Returns a sentence for each thing that failed.
fn apply_to_work(
    ctx: &Context,
    command: ExerciseCommand,
    work: &mut Work,
    compiler: &mut Compiler,
    check: &mut Check,
    platform: &mut dyn Platform,
) -> Vec<String> {
    let current = work.current;
    match command {
        ExerciseCommand::Check => check.start(ctx, work, platform),
        ExerciseCommand::StopChecking => check.stop(work),
        ExerciseCommand::Find => {
            if let Some(file) = work.files.get(work.current) {
                crate::step::find::open(ctx, file.id());
            }
        }
        ExerciseCommand::Save => {
            let failures = saving::save(work, platform);
            if work.asking.is_some() {
                editor::release_focus(ctx, work);
            }
            return failures;
        }
        ExerciseCommand::SaveInto(folder) => return saving::save_into(work, &folder, platform),
        ExerciseCommand::Undo | ExerciseCommand::Redo => {
            if let Some(file) = work.files.get_mut(current) {
                editor::undo_step(ctx, file, command == ExerciseCommand::Redo);
            }
        }
        ExerciseCommand::TakeOther(index) => {
            if let Some(file) = work.files.get_mut(index)
                && let Some(other) = file.other.take()
            {
                editor::remember(ctx, file);
                file.take(other);
            }
        }
        ExerciseCommand::KeepMine(index) => {
            if let Some(file) = work.files.get_mut(index) {
                // Changes are compared with the version on disk.
                if let Some(other) = file.other.take() {
                    file.saved = other;
                }
                return saving::save(work, platform);
            }
        }
        ExerciseCommand::DiscardRestored => {
            for file in work.files.iter_mut().filter(|file| file.is_restored() && file.other.is_none()) {
                editor::remember(ctx, file);
                file.take(file.saved.clone());
            }
        }
        ExerciseCommand::ApplyFix => {
            for (index, text) in work.fixed_texts().unwrap_or_default() {
                if let Some(file) = work.files.get_mut(index) {
                    editor::remember(ctx, file);
                    file.text = text;
                }
            }
        }
        ExerciseCommand::KeepRestored => work.files.iter_mut().for_each(|file| file.restored = None),
        ExerciseCommand::PutBack => {
            work.put_back();
            compiler.restart();
            // They were not watched while they were replaced.
            let paths: Vec<PathBuf> = work.files.iter().filter_map(|file| file.path.clone()).collect();
            return saving::read_again(ctx, work, &paths);
        }
        ExerciseCommand::BeginAgain => {
            work.begin_again();
            compiler.restart();
        }
        ExerciseCommand::StartFiles => {
            let name = format!("{}.zip", work.exercise.id);
            return platform.write(&name, &saving::start_files(work)).err().into_iter().collect();
        }
        // These concern the application: see `ExerciseView::apply`.
        ExerciseCommand::Begin(_)
        | ExerciseCommand::List
        | ExerciseCommand::Leave
        | ExerciseCommand::Open
        | ExerciseCommand::SetLanguage(_)
        | ExerciseCommand::Theme => {}
    }
    Vec::new()
}
