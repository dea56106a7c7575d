//! The application: one frame from files, keys and panels to the picture.

mod actions;
mod baking;
mod bench;
mod environment;
mod exercise;
mod gallery;
mod inspector;
pub mod loader;
mod scene_drafts;
mod stations;
pub mod unsaved;
mod up_axis;

use crate::action::Action;
use crate::app::bench::with_places;
use crate::app::loader::{LoadOutcome, LoadRequest, Loader, SceneOpening, names};
use crate::app::scene_drafts::SceneDraft;
use crate::app::unsaved::ReplacedScene;
use crate::bench::BenchView;
use crate::document::{Document, History};
use crate::exercise::ExerciseView;
use crate::files::{Adopted, Layered, base_name, short};
use crate::gallery::GalleryView;
use crate::missing_glyphs::MissingGlyphs;
use crate::platform::{Event, FrameShown, Platform, SceneInput};
use crate::scene_view::drawing::PaneRenderer;
use crate::session::{MessageCause, MessageSeverity, OwnShaders, Session, Tab};
use crate::stations::StationRoom;
use crate::truth::{TraceRequest, TracedPane};
use crate::{exported, focus, panels, scene_view, shortcuts, theme};
use egui::Ui;
use gonio_gl::Gl;
use gonio_language::tr;
use gonio_mesh::Severity as Found;
use gonio_scene::edit::{self, Edited};
use gonio_scene::files::{BUILTIN, FileSource};
use gonio_scene::settings::CameraSettings;
use gonio_scene::{Scene, SceneSettings};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use web_time::Instant;

/// The scene that is opened when nothing else is named.
pub const FIRST_SCENE: &str = "builtin:still-life";

/// The application.
pub struct App {
    document: Document,
    session: Session,
    history: History,
    loader: Loader,
    /// The source of the open scene's files.
    files: Arc<dyn FileSource>,
    /// The options that the scene was opened with, and its camera then.
    opened: SceneOpening,
    opened_camera: CameraSettings,
    /// The scene as it was opened or saved last.
    saved: SceneSettings,
    /// An edited scene that another one has replaced.
    replaced: Option<Box<ReplacedScene>>,
    scene_draft: SceneDraft,
    /// Files that changed on disk and have not been reloaded.
    changed: Vec<PathBuf>,
    /// Watched files of the open scene.
    read: Vec<PathBuf>,
    /// Files that the open scene names and that were not found.
    missing: Vec<PathBuf>,
    /// Watched files of the exercises.
    watched: Vec<PathBuf>,
    /// Whether closing the window was refused once because of unsaved text.
    asked_to_close: bool,
    platform: Box<dyn Platform>,
    pane_renderer: Option<PaneRenderer>,
    exercise: ExerciseView,
    bench: BenchView,
    stations: StationRoom,
    gallery: GalleryView,
    /// Tells when a sketch is on the screen. The full picture waits for that, because drawing it may delay the sketch.
    sketched: Option<FrameShown>,
    missing_glyphs: MissingGlyphs,
}

impl App {
    /// Creates the application for a context with the OpenGL `gl` (without it there is no picture). It opens `inputs`, or else
    /// the scene of a link, or [`FIRST_SCENE`].
    pub fn new(ctx: &egui::Context, gl: Option<Gl>, platform: Box<dyn Platform>, inputs: Vec<String>) -> Self {
        App::with_options(ctx, gl, platform, SceneOpening { inputs, ..SceneOpening::default() })
    }

    /// [`App::new`] with further options.
    pub fn with_options(
        ctx: &egui::Context,
        gl: Option<Gl>,
        platform: Box<dyn Platform>,
        mut opening: SceneOpening,
    ) -> Self {
        theme::install(ctx);
        let mut session = Session::default();
        let pane_renderer = gl.and_then(|gl| match PaneRenderer::new(gl) {
            Ok(pane_renderer) => Some(pane_renderer),
            Err(error) => {
                session
                    .messages
                    .report(MessageSeverity::Error, tr!("window-opengl-rendering-is-not-available", error = error));
                None
            }
        });
        session.settings = platform.settings();
        session.capture_access = platform.capture_access();
        let language = platform.asked_language().or(session.settings.language);
        let language = language.unwrap_or_else(|| platform.preferred_language());
        language.make_current();
        platform.announce_language(language);
        if let Some(dark) = session.settings.dark {
            ctx.set_theme(if dark { egui::Theme::Dark } else { egui::Theme::Light });
        }
        if let Some(pane_renderer) = &pane_renderer {
            session.facts.renderer = pane_renderer.driver().to_owned();
        }
        session.shaders = opening.shaders.take().map(|files| OwnShaders::new(files, None));
        if session.shaders.is_some() {
            session.tab = Tab::Shaders;
        }
        let document = Document::default();
        let mut app = App {
            history: History::new(&document),
            document,
            session,
            loader: Loader::default(),
            files: platform.files(),
            opened: SceneOpening::default(),
            opened_camera: CameraSettings::default(),
            saved: SceneSettings::default(),
            replaced: None,
            scene_draft: SceneDraft::default(),
            changed: Vec::new(),
            read: Vec::new(),
            missing: Vec::new(),
            watched: Vec::new(),
            asked_to_close: false,
            platform,
            pane_renderer,
            exercise: ExerciseView::default(),
            bench: BenchView::default(),
            stations: StationRoom::default(),
            gallery: GalleryView::default(),
            sketched: None,
            missing_glyphs: MissingGlyphs::default(),
        };
        app.missing_glyphs.observe(ctx);
        let mut files = app.files.clone();
        if opening.inputs.is_empty() {
            match app.platform.first() {
                Some(Ok(input)) => (opening.inputs, files) = (input.inputs, input.files),
                Some(Err(error)) => app.session.messages.report(MessageSeverity::Error, error),
                None => {}
            }
        }
        if let Some(link) = app.platform.linked_station() {
            app.begin_stations(link);
        }
        if opening.inputs.is_empty() {
            opening.inputs.push(FIRST_SCENE.to_owned());
        }
        app.exercise.outcomes.clone_from(&app.session.settings.outcomes);
        app.start(ctx, opening, files);
        app
    }

    /// Continues in another context with its OpenGL, after the first one was lost: a browser may take away a page's
    /// graphics and restore them later. Documents and open files are kept.
    pub fn resume(&mut self, ctx: &egui::Context, gl: Option<Gl>) {
        theme::install(ctx);
        self.missing_glyphs.observe(ctx);
        self.exercise.release();
        self.bench.release();
        self.stations.release();
        self.gallery.release();
        self.session.shaders.iter_mut().for_each(OwnShaders::release);
        self.session.baking.release();
        self.session.environment.release();
        self.pane_renderer = None;
        match gl.map(PaneRenderer::new) {
            Some(Ok(pane_renderer)) => {
                self.session.facts.renderer = pane_renderer.driver().to_owned();
                self.pane_renderer = Some(pane_renderer);
            }
            Some(Err(error)) => self
                .session
                .messages
                .report(MessageSeverity::Error, tr!("window-opengl-rendering-is-not-available", error = error)),
            None => {}
        }
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// State that is not undone.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The state as JSON: [`exported::state`].
    pub fn state(&self, ctx: &egui::Context) -> serde_json::Value {
        let state = exported::state(ctx, &self.document, &self.session, &self.history);
        let rooms = [self.exercise.state(), self.bench.state(), self.stations.state(), self.gallery.state()];
        with_places(state, &self.session, rooms)
    }

    /// Starts to load `inputs`.
    pub fn open(&mut self, ctx: &egui::Context, inputs: Vec<String>, files: Arc<dyn FileSource>) {
        self.start(ctx, SceneOpening { inputs, limits: self.opened.limits, ..SceneOpening::default() }, files);
    }

    fn start(&mut self, ctx: &egui::Context, opening: SceneOpening, files: Arc<dyn FileSource>) {
        self.session.busy = Some(tr!("window-reading", inputs = short(&opening.inputs)));
        let limits = opening.limits;
        self.loader.start(LoadRequest::Open(opening), files, limits, ctx);
    }

    /// One frame: input, actions, document, pictures, window.
    pub fn ui(&mut self, ui: &mut Ui) {
        theme::touch::fit(ui.ctx());
        focus::allow_slow_double_clicks(ui.ctx());
        focus::resume(ui.ctx());
        let reported = self.session.messages.count();
        let ctx = ui.ctx().clone();
        self.frame(ui, &ctx);
        self.missing_glyphs.follow(&ctx, self.platform.as_mut(), &mut self.session.messages);
        focus::ring(&ctx);
        // Messages of this frame are shown in the next one.
        if self.session.messages.count() != reported {
            ctx.request_repaint();
        }
    }

    fn frame(&mut self, ui: &mut Ui, ctx: &egui::Context) {
        let start = Instant::now();
        self.receive(ctx);
        if self.exercise.is_open {
            self.session.traced.iter_mut().for_each(TracedPane::stop);
            return self.exercise_ui(ui);
        }
        if self.bench.is_open {
            self.session.traced.iter_mut().for_each(TracedPane::stop);
            return self.bench_ui(ui);
        }
        if self.stations.is_open {
            self.session.traced.iter_mut().for_each(TracedPane::stop);
            return self.stations_ui(ui);
        }
        if self.gallery.is_open {
            self.session.traced.iter_mut().for_each(TracedPane::stop);
            return self.gallery_ui(ui);
        }
        self.advance(ctx);
        self.take_traced();
        for action in self.show_panels(ui) {
            self.act(ctx, action);
        }
        self.follow_inspector(ctx);
        self.follow_document(ctx);
        self.draw(ui);
        self.settle(ctx);
        self.note_learned();
        let end = Instant::now();
        self.session.traced.iter_mut().for_each(|traced| traced.take_times(start, end));
        self.publish(ctx);
    }

    /// Handles events of the platform, loaded files, and a request to close the window.
    fn receive(&mut self, ctx: &egui::Context) {
        exported::begin(ctx);
        self.session.facts.frames += 1;
        for event in self.platform.poll(self.purpose(), ctx) {
            self.handle(ctx, event);
        }
        if let Some(outcome) = self.loader.poll() {
            self.take(ctx, outcome);
        }
        self.follow_bake(ctx);
        self.follow_environment(ctx);
        self.before_closing(ctx);
    }

    /// Advances time: keeps drafts, reloads changed files, moves lights.
    fn advance(&mut self, ctx: &egui::Context) {
        for failure in self.exercise.follow_drafts(ctx, self.platform.as_mut()) {
            self.session.messages.report(MessageSeverity::Error, failure);
        }
        self.follow_scene_draft(ctx);
        self.read_again(ctx);
        self.follow_shaders(ctx);
        self.session.progress = self.loader.progress();
        let seconds = ctx.input(|i| f64::from(i.stable_dt));
        self.session.clock.advance(seconds);
        if self.session.clock.playing {
            ctx.request_repaint();
        }
    }

    /// Shows everything but the pictures. Returns the actions of keys and widgets.
    fn show_panels(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        self.step_by_keys(ui);
        shortcuts::handle(ui, &mut self.document, &mut self.session, &mut actions);
        panels::show(ui, &mut self.document, &mut self.session, &self.history, &mut actions);
        actions
    }

    /// Draws the scene into the rest of the window.
    fn draw(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        if self.sketched.as_ref().is_some_and(|shown| shown(&ctx)) {
            (self.session.sketching, self.sketched) = (false, None);
        }
        let pictures = self.session.facts.pictures;
        egui::CentralPanel::no_frame().show(ui, |ui| {
            self.frame_opened(&ctx, ui.available_size());
            let hid_ground = self.session.settings.hides_ground;
            let drawn = scene_view::show(ui, &mut self.document, &mut self.session, self.pane_renderer.as_mut());
            if let Err(error) = drawn {
                self.session.messages.report(MessageSeverity::Error, error.to_string());
            }
            if self.session.settings.hides_ground != hid_ground {
                self.platform.keep(&self.session.settings);
            }
        });
        self.trace(&ctx);
        self.step(&ctx);
        if self.session.sketching && self.sketched.is_none() && self.session.facts.pictures > pictures {
            self.sketched = Some(self.platform.shown(&ctx));
        }
    }

    /// Takes the newest traced pictures.
    fn take_traced(&mut self) {
        self.session.traced.resize_with(self.document.panes.list.len(), Default::default);
        for traced in &mut self.session.traced {
            if let Some(error) = traced.poll() {
                self.session.messages.report(MessageSeverity::Error, error);
            }
        }
    }

    /// Has the visible panes traced that show the truth, as they were just drawn.
    fn trace(&mut self, ctx: &egui::Context) {
        let panes = &self.document.panes;
        // The panels may have added one.
        self.session.traced.resize_with(panes.list.len(), Default::default);
        let seen = panes.seen();
        for (index, (pane, traced)) in panes.list.iter().zip(&mut self.session.traced).enumerate() {
            let Some(settings) = pane.truth else {
                *traced = TracedPane::default();
                continue;
            };
            let drawn = self.pane_renderer.as_ref().filter(|_| seen.contains(&index));
            let drawn = drawn.and_then(|drawn| Some((drawn.loaded(index)?, drawn.frame(index)?)));
            let Some((scene, frame)) = drawn else {
                traced.stop();
                continue;
            };
            let request = TraceRequest {
                scene: scene.clone(),
                frame: frame.clone(),
                settings,
                generation: self.session.generation,
                pixel: self.session.probing.pinned_pixel(index, frame),
                files: self.files.clone(),
                paths: self.read.clone(),
            };
            traced.follow(request, || self.platform.tracer(ctx));
        }
    }

    /// Publishes the state.
    fn publish(&mut self, ctx: &egui::Context) {
        let (document, session, history) = (&self.document, &self.session, &self.history);
        let state = || {
            let rooms = [self.exercise.state(), self.bench.state(), self.stations.state(), self.gallery.state()];
            with_places(exported::state(ctx, document, session, history), session, rooms)
        };
        self.platform.publish(&state);
    }

    /// Handles an event of the platform.
    fn handle(&mut self, ctx: &egui::Context, event: Event) {
        match event {
            Event::Open(input) => self.open_input(ctx, *input),
            Event::ExerciseFiles(files) => self.open_exercise_files(files),
            Event::BenchFiles(files) => self.open_bench_files(ctx, files),
            Event::SaveTo(product, place) => self.save(ctx, product, &place),
            Event::Changed(paths) => self.changed_on_disk(ctx, paths),
            Event::Failed(error) => {
                self.session.messages.report_about(MessageCause::Opening, MessageSeverity::Error, None, error);
            }
        }
    }

    /// Opens what the user chose or dropped: files that the open scene lacks, shaders, a scene, or an environment.
    fn open_input(&mut self, ctx: &egui::Context, input: SceneInput) {
        if input.inputs.is_empty() && input.shaders.is_none() && self.lacks(&input.names) {
            return self.adopt(ctx, &input);
        }
        let SceneInput { inputs, environment, shaders, problem, files, .. } = input;
        if let Some(problem) = problem {
            return self.session.messages.report_about(MessageCause::Opening, MessageSeverity::Error, None, problem);
        }
        if let Some(shaders) = shaders {
            self.open_shaders(ctx, shaders, files.clone());
        }
        if !inputs.is_empty() {
            self.stations.leave();
            self.gallery.leave();
            let limits = self.opened.limits;
            self.start(ctx, SceneOpening { inputs, environment, limits, ..SceneOpening::default() }, files);
        } else if let Some(image) = environment {
            // The environment may be in another place than the scene.
            self.files = Arc::new(Layered { first: files, then: self.files.clone() });
            self.document.scene.set_environment(&image);
        }
    }

    /// Whether the open scene names files that were not found and that are among these.
    fn lacks(&self, names: &[String]) -> bool {
        let lower = |name: &str| base_name(name).to_lowercase();
        let missing: Vec<String> = self.missing.iter().map(|path| lower(&path.to_string_lossy())).collect();
        self.session.loaded.is_some() && names.iter().any(|name| missing.contains(&lower(name)))
    }

    /// Reads the open scene again, with files that it lacked.
    fn adopt(&mut self, ctx: &egui::Context, input: &SceneInput) {
        let files = Arc::new(Adopted::new(self.files.clone(), input.files.clone(), &input.names));
        self.session.busy = Some(tr!("window-reading", inputs = short(&input.names)));
        let request = LoadRequest::Refresh(Box::new(self.document.scene.clone()));
        self.loader.start(request, files, self.opened.limits, ctx);
    }

    /// Reloads files that changed on disk. A changed scene file replaces the document's scene; for other files the
    /// document keeps its edits.
    fn read_again(&mut self, ctx: &egui::Context) {
        if self.changed.is_empty() || self.loader.is_running() || self.session.loaded.is_none() {
            return;
        }
        let changed = std::mem::take(&mut self.changed);
        let is_scene_file = |path: &PathBuf| {
            path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
                && self.opened.inputs.iter().any(|input| Path::new(input) == path)
        };
        let requested = match changed.iter().any(is_scene_file) {
            true => LoadRequest::Again(self.opened.clone()),
            false => LoadRequest::Refresh(Box::new(self.document.scene.clone())),
        };
        self.session.busy = Some(tr!("window-reloading", changed = names(&changed)));
        self.loader.start(requested, self.files.clone(), self.opened.limits, ctx);
    }

    /// Shows a loaded scene, or reports why it could not be loaded; then nothing changes.
    fn take(&mut self, ctx: &egui::Context, finished: LoadOutcome) {
        self.session.busy = None;
        let loaded = match finished.result {
            Ok(loaded) => loaded,
            Err(sentence) => {
                let messages = &mut self.session.messages;
                messages.report_about(MessageCause::Opening, MessageSeverity::Error, None, sentence);
                if matches!(finished.requested, LoadRequest::Scene(_)) {
                    self.history.revert(&mut self.document);
                }
                return;
            }
        };
        if matches!(finished.requested, LoadRequest::Open(_) | LoadRequest::Restore(_)) {
            self.keep_replaced();
        }
        self.files = finished.files;
        (self.read, self.missing) = (finished.paths, finished.missing);
        self.watch(ctx);
        self.session.messages.clear(MessageCause::Scene);
        if !matches!(finished.requested, LoadRequest::Scene(_)) {
            self.session.inspector.files_changed();
            self.session.messages.clear(MessageCause::Opening);
        }
        for found in &loaded.diagnostics {
            let severity = match found.severity {
                Found::Note => continue,
                Found::Warning => MessageSeverity::Warning,
            };
            let file = found.place.file.clone();
            self.session.messages.report_about(MessageCause::Scene, severity, file, found.to_string());
        }
        match finished.requested {
            LoadRequest::Restore(replaced) => self.take_restored(*replaced),
            LoadRequest::Open(opening) => {
                self.session.title = short(&opening.inputs);
                self.session.clock = Default::default();
                self.session.selection = Default::default();
                self.session.probing.forget();
                self.forget_bake();
                self.session.announcement = tr!("window-opened", named = self.session.title);
                self.document = Document::from_scene(loaded.settings.clone());
                self.session.clock.time = opening.time;
                if let Some(pane) = self.document.panes.current_mut() {
                    pane.view = opening.view;
                }
                self.history = History::new(&self.document);
                self.saved = loaded.settings.clone();
                self.opened_camera = loaded.settings.camera.clone();
                self.remember(&opening.inputs);
                self.session.inspector.forget();
                self.opened = opening;
                self.begin_scene_draft();
                self.offer_scene_draft();
                self.session.messages.clear(MessageCause::UpAxis);
                self.hint_at_up_axis();
                self.session.unframed = loaded.camera_was_framed;
                let is_sample =
                    self.opened.is_sample || self.opened.inputs.iter().all(|input| input.starts_with(BUILTIN));
                self.session.is_new_sample = is_sample && !self.session.unframed;
                self.sketched = None;
                // No picture of this scene is complete yet.
                self.session.facts.samples = 0;
                self.session.sketching = self.pane_renderer.as_ref().is_some_and(PaneRenderer::sketches);
            }
            LoadRequest::Again(_) => {
                let camera = self.document.scene.camera.clone();
                let was_moved = camera != self.opened_camera;
                self.session.unframed = loaded.camera_was_framed && !was_moved;
                self.opened_camera = loaded.settings.camera.clone();
                self.document.scene = loaded.settings.clone();
                self.saved = loaded.settings.clone();
                if was_moved {
                    // It is applied with the rest of the document below.
                    self.document.scene.camera = camera;
                }
                self.session.announcement = tr!("window-reloaded", title = self.session.title);
            }
            LoadRequest::Refresh(scene) => {
                self.session.announcement = tr!("window-reloaded-the-changed-files").into();
                // Edits since the request are kept.
                if *scene == self.document.scene {
                    self.document.scene = loaded.settings.clone();
                }
            }
            LoadRequest::Scene(_) => self.document.scene = loaded.settings.clone(),
            LoadRequest::Draft(_) => self.take_scene_draft(loaded.settings.clone()),
        }
        self.session.loaded = Some(Arc::new(loaded));
        self.session.generation += 1;
    }

    /// Frames a scene that was just opened in a picture of this size, if the scene has no camera
    /// of its own or is a sample. This is part of opening it and cannot be undone.
    fn frame_opened(&mut self, ctx: &egui::Context, size: egui::Vec2) {
        let (unframed, is_sample) = (self.session.unframed, self.session.is_new_sample);
        let Some(loaded) = self.session.loaded.as_ref().filter(|_| unframed || is_sample) else { return };
        (self.session.unframed, self.session.is_new_sample) = (false, false);
        let aspect = f64::from(size.x) / f64::from(size.y.max(1.0));
        let own = &loaded.settings.camera;
        let camera = if unframed { loaded.framed(own, aspect) } else { loaded.with_all_in(own, aspect) };
        if camera == *own {
            return;
        }
        self.opened_camera = camera.clone();
        self.document.scene.camera = camera;
        self.history = History::new(&self.document);
        self.follow_document(ctx);
    }

    /// Updates the loaded scene to that of the document.
    fn follow_document(&mut self, ctx: &egui::Context) {
        let Some(loaded) = &self.session.loaded else { return };
        if loaded.settings == self.document.scene || self.loader.is_running() {
            return;
        }
        match edit::apply(loaded, self.document.scene.clone()) {
            Ok(Edited::Done(applied)) => {
                // Defaults were filled in.
                self.document.scene = applied.loaded.settings.clone();
                if applied.geometry_changed || applied.materials_changed || is_seen_otherwise(loaded, &applied.loaded) {
                    self.session.generation += 1;
                }
                self.session.loaded = Some(Arc::new(applied.loaded));
            }
            Ok(Edited::NeedsFiles(scene)) => {
                self.session.busy = Some(tr!("window-reading-the-scene-s-files").into());
                self.loader.start(LoadRequest::Scene(scene), self.files.clone(), self.opened.limits, ctx);
            }
            Err(error) => {
                self.session.messages.report(MessageSeverity::Error, error.to_string());
                self.history.revert(&mut self.document);
            }
        }
    }

    /// Ends a frame: a finished gesture becomes a step of the history.
    fn settle(&mut self, ctx: &egui::Context) {
        let gesture =
            ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty() || i.smooth_scroll_delta().y != 0.0);
        self.follow_document(ctx);
        let was_undoable = self.history.can_undo(&self.document);
        if !self.loader.is_running() {
            self.history.observe(&self.document, gesture);
        }
        if was_undoable != self.history.can_undo(&self.document) {
            ctx.request_repaint();
        }
    }
}

/// Whether shading or environment differ, which need other data on the GPU.
fn is_seen_otherwise(before: &Scene, after: &Scene) -> bool {
    let environment = |scene: &Scene| scene.environment.as_ref().map(Arc::as_ptr);
    let shadings = |scene: &Scene| scene.objects.iter().map(|object| object.shading).collect::<Vec<_>>();
    environment(before) != environment(after) || shadings(before) != shadings(after)
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        App::ui(self, ui);
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        panels::ground(visuals).to_normalized_gamma_f32()
    }

    fn on_exit(&mut self, _: Option<&eframe::glow::Context>) {
        // No window is left to show errors in.
        let _ = self.exercise.flush_drafts(self.platform.as_mut());
        let _ = self.flush_scene_draft();
        // Buffers and textures are freed while their context exists.
        self.exercise.release();
        self.bench.release();
        self.stations.release();
        self.session.shaders = None;
        self.session.baking.release();
        self.pane_renderer = None;
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }
}
