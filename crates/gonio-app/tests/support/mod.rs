//! The whole application with OpenGL but without a window, driven by pointer and keys. Methods for one file of tests are in
//! that file, in another `impl Window`.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2, pos2, vec2};
use egui_kittest::Harness;
use gonio_app::exported::{self, Widget};
use gonio_app::platform::{
    ByCheck, CheckRequest, CheckResult, Event as PlatformEvent, FileDialog, FontSearch, Pending, Platform, Purpose,
    TrialOutcome,
};
use gonio_app::saving::Product;
use gonio_app::session::Settings;
use gonio_app::{App, theme};
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use gonio_exercises::Checker;
use gonio_exercises::exercise;
use gonio_gl::HeadlessContext;
use gonio_scene::files::{Disk, FileSource};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// A platform that checks in a thread with a context of its own, because there is no program to start.
#[derive(Clone, Default)]
pub struct Here {
    /// The next events.
    pub coming: Rc<RefCell<Vec<PlatformEvent>>>,
    /// The purpose of the last file dialog.
    pub asked: Rc<RefCell<Option<Purpose>>>,
    /// Trials with an outcome set by the test.
    pub trials: Rc<RefCell<Trials>>,
    /// Fonts of the system that were not found yet.
    pub fonts: Rc<RefCell<Option<Arc<dyn egui::FontProvider>>>>,
    /// Number of searches for fonts.
    pub searches: Rc<RefCell<usize>>,
    /// The drafts that were kept, by key.
    pub drafts: Rc<RefCell<BTreeMap<String, String>>>,
    /// How much verdicts tell, in place of the exercises' own setting.
    pub feedback: Option<Feedback>,
}

/// Trials whose outcome the test decides.
#[derive(Default)]
pub struct Trials {
    /// Whether every pair is tried; otherwise only those that may never end, by a check.
    pub is_on: bool,
    /// Number of trials that were started, and of those still running.
    pub begun: usize,
    pub running: usize,
    /// Outcome of the running or the next trial.
    pub outcome: Option<TrialOutcome>,
}

struct Scripted(Rc<RefCell<Trials>>);

impl Pending<TrialOutcome> for Scripted {
    fn poll(&mut self) -> Option<TrialOutcome> {
        self.0.borrow_mut().outcome.take()
    }
}

impl Drop for Scripted {
    fn drop(&mut self) {
        self.0.borrow_mut().running -= 1;
    }
}

struct Thread(Receiver<Result<Verdict, String>>);

impl Pending<CheckResult> for Thread {
    fn poll(&mut self) -> Option<Result<Verdict, String>> {
        self.0.try_recv().ok()
    }
}

impl Platform for Here {
    fn files(&self) -> Arc<dyn FileSource> {
        Arc::new(Disk)
    }
    fn choose_files(&mut self, purpose: Purpose, _: &egui::Context) -> FileDialog {
        *self.asked.borrow_mut() = Some(purpose);
        FileDialog::Unavailable
    }
    fn open_paths(&mut self, _: Vec<String>, _: Purpose, _: &egui::Context) {}
    fn choose_place(&mut self, _: Product, _: &str, _: &egui::Context) -> FileDialog {
        FileDialog::Unavailable
    }
    fn poll(&mut self, _: Purpose, _: &egui::Context) -> Vec<PlatformEvent> {
        std::mem::take(&mut *self.coming.borrow_mut())
    }
    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String> {
        std::fs::write(place, bytes).map(|()| place.to_owned()).map_err(|error| error.to_string())
    }
    fn link(&self, fragment: &str) -> String {
        fragment.to_owned()
    }
    fn settings(&self) -> Settings {
        Settings::default()
    }
    fn keep(&mut self, _: &Settings) {}
    fn find_fonts(&mut self, _: &BTreeSet<char>, ctx: &egui::Context) -> FontSearch {
        *self.searches.borrow_mut() += 1;
        match self.fonts.borrow_mut().take() {
            Some(provider) => {
                ctx.add_font_provider(provider);
                FontSearch::Installed
            }
            None => FontSearch::NotFound { advice: "install one".into() },
        }
    }
    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        self.drafts.borrow_mut().insert(key.to_owned(), text.to_owned());
        Ok(())
    }
    fn remove_draft(&mut self, key: &str) {
        self.drafts.borrow_mut().remove(key);
    }
    fn take_draft(&mut self, key: &str) -> Option<String> {
        self.drafts.borrow().get(key).cloned()
    }
    fn tries_every_pair(&self) -> bool {
        self.trials.borrow().is_on
    }
    fn trial(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        if !self.tries_every_pair() {
            return Box::new(ByCheck::new(self.check(request, ctx)));
        }
        let mut trials = self.trials.borrow_mut();
        (trials.begun, trials.running) = (trials.begun + 1, trials.running + 1);
        Box::new(Scripted(self.trials.clone()))
    }
    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<CheckResult>> {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        let feedback = self.feedback;
        std::thread::spawn(move || {
            let context = HeadlessContext::new().unwrap();
            let exercise = exercise::find(&request.exercise).unwrap();
            let files = request.files.into_iter().map(|(name, bytes)| SourceFile { name, bytes }).collect();
            let options = gonio_check::CheckOptions { pair: None, as_the_lab: request.as_the_lab };
            let feedback = feedback.unwrap_or(exercise.feedback);
            let verdict = gonio_exercises::check(&mut Checker::new(context.gl()), exercise, files, &options, feedback);
            let _ = sender.send(verdict.map(|(verdict, _)| verdict).map_err(|error| error.to_string()));
            ctx.request_repaint();
        });
        Box::new(Thread(receiver))
    }
}

/// The application after at least two frames.
pub struct Window {
    pub harness: Harness<'static, Option<App>>,
    // Not every file of tests uses it.
    #[allow(dead_code)]
    pub here: Here,
    // The application's OpenGL, which is dropped last.
    _context: HeadlessContext,
}

impl Window {
    /// Opens a model or a scene in a window of this size, in points.
    // Not every file of tests uses it.
    #[allow(dead_code)]
    pub fn with(input: &str, size: Vec2) -> Self {
        Self::on(Here::default(), input, size)
    }

    /// The same on this platform.
    pub fn on(here: Here, input: &str, size: Vec2) -> Self {
        let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
        let (gl, input) = (context.gl().clone(), input.to_owned());
        let platform = here.clone();
        let mut harness = Harness::builder().with_size(size).with_context_setup(theme::install).build_ui_state(
            move |ui, app: &mut Option<App>| {
                let new = || App::new(ui.ctx(), Some(gl.clone()), Box::new(platform.clone()), vec![input.clone()]);
                app.get_or_insert_with(new).ui(ui);
            },
            None,
        );
        harness.run_steps(2);
        Window { harness, here, _context: context }
    }

    pub fn app(&self) -> &App {
        self.harness.state().as_ref().unwrap_or_else(|| panic!("the application was not created"))
    }

    pub fn steps(&mut self, steps: usize) {
        self.harness.run_steps(steps);
    }

    pub fn widget(&self, id: &str) -> Widget {
        let widgets = exported::widgets(&self.harness.ctx);
        let found = widgets.iter().find(|widget| widget.id == id).cloned();
        found.unwrap_or_else(|| panic!("no `{id}` among {:?}", widgets.iter().map(|w| &w.id).collect::<Vec<_>>()))
    }

    pub fn center(&self, id: &str) -> Pos2 {
        let [x, y, width, height] = self.widget(id).rect;
        Rect::from_min_size(pos2(x, y), vec2(width, height)).center()
    }

    pub fn move_to(&mut self, at: Pos2) {
        self.harness.event(Event::PointerMoved(at));
        self.steps(2);
    }

    pub fn button(&mut self, at: Pos2, pressed: bool) {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        self.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
        self.steps(2);
    }

    // Not every file of tests uses it.
    #[allow(dead_code)]
    pub fn drag(&mut self, from: Pos2, way: Vec2) {
        self.move_to(from);
        self.button(from, true);
        for part in 1..=4 {
            self.move_to(from + way * (part as f32 / 4.0));
        }
        self.button(from + way, false);
        self.steps(3);
    }

    pub fn click_at(&mut self, at: Pos2) {
        self.move_to(at);
        self.button(at, true);
        self.button(at, false);
        self.steps(2);
    }

    // Not every file of tests uses it.
    #[allow(dead_code)]
    pub fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(3);
    }
}
