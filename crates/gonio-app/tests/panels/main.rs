//! The panels, driven as a person does: a real scene, egui's own harness, pointer and keys; no OpenGL.
#![allow(missing_docs)]

mod compare;
mod equation;
mod probe;
mod scene_panels;

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2, pos2, vec2};
use egui_kittest::Harness;
use gonio_app::action::Action;
use gonio_app::document::{Document, History};
use gonio_app::exported::{self, Widget};
use gonio_app::session::{Session, Tab};
use gonio_app::{panels, theme};
use gonio_mesh::Limits;
use gonio_scene::edit::{Edited, apply};
use gonio_scene::files::Disk;
use gonio_scene::load;
use std::path::Path;
use std::sync::Arc;

/// The state that the panels edit.
pub struct TestApp {
    pub document: Document,
    pub session: Session,
    pub history: History,
    pub actions: Vec<Action>,
    /// Number of edits that needed files.
    pub file_edits: u32,
}

/// The panels in a harness.
pub struct Bench {
    pub harness: Harness<'static, TestApp>,
}

impl TestApp {
    fn open(input: &str) -> Self {
        let scene = load::describe(&[input], &Disk).unwrap_or_else(|e| panic!("{e}"));
        let loaded = read(scene);
        let document = Document::from_scene(loaded.settings.clone());
        let mut session = Session { loaded: Some(Arc::new(loaded)), title: input.to_owned(), ..Session::default() };
        session.facts.size = [800, 600];
        TestApp { history: History::new(&document), document, session, actions: Vec::new(), file_edits: 0 }
    }

    /// Updates the scene, as the application does after each frame.
    fn follow(&mut self) {
        let Some(loaded) = &self.session.loaded else { return };
        if loaded.settings == self.document.scene {
            return;
        }
        let next = match apply(loaded, self.document.scene.clone()).unwrap_or_else(|e| panic!("{e}")) {
            Edited::Done(applied) => applied.loaded,
            Edited::NeedsFiles(scene) => {
                self.file_edits += 1;
                read((&*scene).into())
            }
        };
        self.document.scene = next.settings.clone();
        self.session.loaded = Some(Arc::new(next));
    }

    fn ui(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        exported::begin(&ctx);
        let mut actions = Vec::new();
        panels::show(ui, &mut self.document, &mut self.session, &self.history, &mut actions);
        for action in &actions {
            match action {
                Action::Show(tab) => self.session.tab = *tab,
                Action::SetTime(time) => self.session.clock.time = *time,
                Action::PlayOrPause => self.session.clock.playing = !self.session.clock.playing,
                _ => {}
            }
        }
        self.actions.extend(actions);
        self.follow();
        let gesture = ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty());
        self.history.observe(&self.document, gesture);
    }
}

fn read(scene: gonio_scene::SceneFile) -> gonio_scene::Scene {
    load::load_within(scene, Path::new(""), &Disk, &Limits::default()).unwrap_or_else(|e| panic!("{e}"))
}

impl Bench {
    /// Opens `input` and a tab in a window that is high enough to show everything.
    pub fn new(input: &str, tab: Tab) -> Self {
        Self::sized(input, tab, vec2(1280.0, 3000.0))
    }

    pub fn sized(input: &str, tab: Tab, size: Vec2) -> Self {
        let mut app = TestApp::open(input);
        app.session.tab = tab;
        let builder = Harness::builder()
            .with_size(size)
            .with_max_steps(32)
            .with_step_dt(1.0 / 60.0)
            .with_context_setup(theme::install);
        let mut bench = Bench { harness: builder.build_ui_state(|ui, app: &mut TestApp| app.ui(ui), app) };
        bench.settle();
        bench
    }

    pub fn settle(&mut self) {
        self.harness.run_steps(4);
    }

    /// Waits half a second, so that the next click is not part of a double click.
    pub fn pause(&mut self) {
        self.harness.run_steps(30);
    }

    pub fn app(&mut self) -> &mut TestApp {
        self.harness.state_mut()
    }

    pub fn document(&self) -> &Document {
        &self.harness.state().document
    }

    pub fn widgets(&self) -> Vec<Widget> {
        exported::widgets(&self.harness.ctx)
    }

    #[track_caller]
    pub fn widget(&self, id: &str) -> Widget {
        let all = self.widgets();
        all.iter().find(|w| w.id == id).cloned().unwrap_or_else(|| {
            let ids: Vec<&str> = all.iter().map(|w| w.id.as_str()).collect();
            panic!("no widget `{id}` among {ids:?}")
        })
    }

    pub fn has(&self, id: &str) -> bool {
        self.widgets().iter().any(|w| w.id == id)
    }

    #[track_caller]
    pub fn rect(&self, id: &str) -> Rect {
        let [x, y, w, h] = self.widget(id).rect;
        Rect::from_min_size(pos2(x, y), vec2(w, h))
    }

    #[track_caller]
    pub fn click(&mut self, id: &str) {
        self.click_with(id, Modifiers::NONE);
    }

    #[track_caller]
    pub fn click_with(&mut self, id: &str, modifiers: Modifiers) {
        let place = self.rect(id).center();
        self.press(place, modifiers);
        self.pause();
    }

    #[track_caller]
    pub fn double_click(&mut self, id: &str) {
        let place = self.rect(id).center();
        self.press(place, Modifiers::NONE);
        self.press(place, Modifiers::NONE);
        self.pause();
    }

    fn press(&mut self, place: Pos2, modifiers: Modifiers) {
        self.harness.event(Event::PointerMoved(place));
        for pressed in [true, false] {
            let event = Event::PointerButton { pos: place, button: PointerButton::Primary, pressed, modifiers };
            self.harness.event_modifiers(event, modifiers);
            self.harness.run_steps(1);
        }
    }

    /// Drags a widget by some points.
    #[track_caller]
    pub fn drag(&mut self, id: &str, by: Vec2) {
        let from = self.rect(id).center();
        let modifiers = Modifiers::NONE;
        let button = PointerButton::Primary;
        self.harness.event(Event::PointerMoved(from));
        self.harness.event(Event::PointerButton { pos: from, button, pressed: true, modifiers });
        self.harness.run_steps(1);
        for step in 1..=4 {
            self.harness.event(Event::PointerMoved(from + by * (step as f32 / 4.0)));
            self.harness.run_steps(1);
        }
        self.harness.event(Event::PointerButton { pos: from + by, button, pressed: false, modifiers });
        self.settle();
    }

    /// Clicks into a number or a text, and replaces its content.
    #[track_caller]
    pub fn type_into(&mut self, id: &str, text: &str) {
        self.click(id);
        self.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        self.harness.run_steps(1);
        self.harness.event(Event::Text(text.to_owned()));
        self.harness.run_steps(1);
        self.harness.key_press(Key::Enter);
        self.pause();
    }

    pub fn undo(&mut self) {
        let app = self.app();
        assert!(app.history.undo(&mut app.document).is_some(), "nothing to undo");
        self.settle();
    }
}
