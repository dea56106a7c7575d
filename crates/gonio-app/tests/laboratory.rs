//! The laboratory as a student uses it: the whole application, with OpenGL but without a window, checks in a thread.
#![allow(missing_docs, clippy::unwrap_used)]

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2, pos2, vec2};
use egui_kittest::Harness;
use gonio_app::exported::{self, Widget};
use gonio_app::laboratory::{GivenFile, Picture, Shown, Start};
use gonio_app::platform::{Asked, CheckRequest, Checking, Event as FromOutside, Platform, Settings};
use gonio_app::saving::Product;
use gonio_app::{Lab, theme};
use gonio_gl::HeadlessContext;
use gonio_lab::check::Checker;
use gonio_lab::exercise;
use gonio_lab::submission::SourceFile;
use gonio_lab::verdict::Verdict;
use gonio_scene::files::{Disk, FileSource};
use serde_json::Value;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// A platform that checks in a thread with a context of its own, as no program is there to be started.
struct Here;

struct Thread(Receiver<Result<Verdict, String>>);

impl Checking for Thread {
    fn poll(&mut self) -> Option<Result<Verdict, String>> {
        self.0.try_recv().ok()
    }
}

impl Platform for Here {
    fn files(&self) -> Arc<dyn FileSource> {
        Arc::new(Disk)
    }
    fn choose_files(&mut self, _: &egui::Context) -> Asked {
        Asked::ByNobody
    }
    fn open_paths(&mut self, _: Vec<String>, _: &egui::Context) {}
    fn choose_place(&mut self, _: Product, _: &str, _: &egui::Context) -> Asked {
        Asked::ByNobody
    }
    fn poll(&mut self, _: &egui::Context) -> Vec<FromOutside> {
        Vec::new()
    }
    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String> {
        std::fs::write(place, bytes).map(|()| place.to_owned()).map_err(|why| why.to_string())
    }
    fn link(&self, fragment: &str) -> String {
        fragment.to_owned()
    }
    fn settings(&self) -> Settings {
        Settings::default()
    }
    fn keep(&mut self, _: &Settings) {}
    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Checking> {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let context = HeadlessContext::new().unwrap();
            let exercise = exercise::find(&request.exercise).unwrap();
            let files = request.files.into_iter().map(|(name, bytes)| SourceFile { name, bytes }).collect();
            let options = gonio_lab::CheckOptions { pair: None, as_the_lab: request.as_the_lab };
            let verdict = gonio_lab::check(&mut Checker::new(context.gl()), exercise, files, &options);
            let _ = sender.send(verdict.map(|(verdict, _)| verdict).map_err(|why| why.to_string()));
            ctx.request_repaint();
        });
        Box::new(Thread(receiver))
    }
}

struct Window {
    harness: Harness<'static, Option<Lab>>,
    // The application's OpenGL; it goes last.
    _context: HeadlessContext,
}

/// The right answer of an exercise, changed.
fn answer(id: &str, change: impl Fn(&str, &str) -> String) -> Start {
    let exercise = exercise::find(id).unwrap();
    let file = |(name, text): (&'static str, &'static str)| GivenFile {
        name: name.to_owned(),
        path: None,
        bytes: change(name, text).into_bytes(),
    };
    Start { exercise: id.to_owned(), files: exercise.reference_files().map(file).collect() }
}

fn right(id: &str) -> Start {
    answer(id, |_, text| text.to_owned())
}

impl Window {
    fn open(start: Start, size: Vec2) -> Self {
        let mut window = Window::empty(size);
        let ctx = window.harness.ctx.clone();
        window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
        window.steps(4);
        window
    }

    fn empty(size: Vec2) -> Self {
        let context = HeadlessContext::new().unwrap_or_else(|why| panic!("{why}"));
        let gl = context.gl().clone();
        let mut harness = Harness::builder().with_size(size).with_context_setup(theme::install).build_ui_state(
            move |ui, lab: &mut Option<Lab>| {
                let new = || Lab::new(ui.ctx(), Some(gl.clone()), Box::new(Here), vec!["builtin:cube".to_owned()]);
                lab.get_or_insert_with(new).ui(ui);
            },
            None,
        );
        harness.run_steps(2);
        Window { harness, _context: context }
    }

    fn lab(&self) -> &Lab {
        self.harness.state().as_ref().unwrap()
    }

    /// The laboratory's part of the state.
    fn state(&self) -> Value {
        self.lab().state(&self.harness.ctx)["laboratory"].clone()
    }

    fn steps(&mut self, steps: usize) {
        self.harness.run_steps(steps);
    }

    /// Goes on until it is so: a check takes its time, and a text is compiled after a pause.
    #[track_caller]
    fn wait(&mut self, what: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..1200 {
            self.steps(1);
            let state = self.state();
            if wanted(&state) {
                return state;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("waited in vain for {what}: {:#}", self.state());
    }

    fn widget(&self, id: &str) -> Widget {
        let widgets = exported::widgets(&self.harness.ctx);
        let found = widgets.iter().find(|widget| widget.id == id).cloned();
        found.unwrap_or_else(|| panic!("no `{id}` among {:?}", widgets.iter().map(|w| &w.id).collect::<Vec<_>>()))
    }

    fn center(&self, id: &str) -> Pos2 {
        let [x, y, width, height] = self.widget(id).rect;
        Rect::from_min_size(pos2(x, y), vec2(width, height)).center()
    }

    fn click_at(&mut self, at: Pos2) {
        self.harness.event(Event::PointerMoved(at));
        self.steps(1);
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            self.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
            self.steps(1);
        }
        // The next click is another one, and none of a double click.
        self.steps(30);
    }

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
    }

    fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(2);
    }

    fn text(&self) -> String {
        let work = self.lab().laboratory().work.as_ref().unwrap();
        work.files[work.current].text.clone()
    }

    fn pixels(&self, picture: Picture) -> (Vec<u8>, [u32; 2]) {
        self.lab().laboratory().pixels(picture).unwrap()
    }
}

const DESK: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

/// How many pixels of two pictures differ by more than two steps of 8 bits.
fn differing(a: &[u8], b: &[u8]) -> usize {
    assert_eq!(a.len(), b.len());
    a.chunks(4).zip(b.chunks(4)).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2)).count()
}

#[test]
fn the_right_answer_looks_like_the_reference_in_every_exercise() {
    for exercise in exercise::all().iter().filter(|exercise| exercise.kind == exercise::Kind::Shaders) {
        let mut window = Window::open(right(&exercise.id), DESK);
        window.wait("the program", |s| s["drawn"] == true);
        window.click("shown-both");
        window.steps(2);
        let (yours, size) = window.pixels(Picture::Yours);
        let (reference, _) = window.pixels(Picture::Reference);
        // Time may run: both are drawn in the same frame.
        assert_eq!(differing(&yours, &reference), 0, "{}", exercise.id);
        let first = yours[..4].to_vec();
        let drawn = yours.chunks(4).filter(|pixel| **pixel != first).count();
        assert!(drawn > (size[0] * size[1] / 20) as usize, "{}: {drawn} pixels are drawn", exercise.id);
    }
}

#[test]
fn a_mistake_is_seen_and_named_and_its_line_is_a_click_away() {
    let start = answer("ex04", |_, text| text.replace("mat3(itM)", "mat3(M)"));
    let mut window = Window::open(start, DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.click("shown-both");
    // The lab's own scene hides it.
    let of = |window: &Window| differing(&window.pixels(Picture::Yours).0, &window.pixels(Picture::Reference).0);
    assert_eq!(of(&window), 0);
    window.click("scene-stretched");
    assert!(of(&window) > 1000, "{} pixels differ", of(&window));
    window.press(Modifiers::COMMAND, Key::Enter);
    assert_eq!(window.state()["checking"], true);
    let state = window.wait("the verdict", |s| s["verdict"].is_object());
    assert_eq!(
        (&state["verdict"]["word"], &state["verdict"]["mistakes"][0]),
        (&"wrong".into(), &"normal-by-model-matrix".into())
    );
    assert_eq!((&state["page"], &state["file"]), (&"verdict".into(), &"reference.frag".into()));
    window.steps(2);
    window.click("mistake-0");
    assert_eq!(window.state()["file"], "reference.vert");
}

#[test]
fn what_does_not_compile_is_said_at_its_line_and_the_last_picture_stays() {
    let mut window = Window::open(right("ex06"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.steps(2);
    let (before, _) = window.pixels(Picture::Yours);
    window.click("editor");
    window.press(Modifiers::COMMAND, Key::End);
    window.harness.event(Event::Text("\nvoid broken(".into()));
    let state = window.wait("the error", |s| s["older"] == true);
    let lines = window.text().lines().count() as u64;
    let said = state["said"].as_array().unwrap();
    assert!(
        said.iter().any(|n| n["kind"] == "error" && n["line"].as_u64().is_some_and(|l| l + 1 >= lines)),
        "{said:?}"
    );
    window.widget("older-program");
    assert_eq!(differing(&window.pixels(Picture::Yours).0, &before), 0);
    assert_eq!(window.state()["files"][0]["changed"], true);
    // By the key, and by the button.
    let text = window.text();
    window.steps(90);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_ne!(window.text(), text);
    window.wait("it to be well again", |s| s["older"] == false && s["said"].as_array().is_some_and(Vec::is_empty));
    window.click("redo");
    assert_eq!(window.text(), text);
}

#[test]
fn each_file_has_its_own_undo() {
    let mut window = Window::open(right("ex04"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    let type_into = |window: &mut Window, file: &str, text: &str| {
        window.click(file);
        window.click("editor");
        window.harness.event(Event::Text(text.into()));
        window.steps(90);
        window.text()
    };
    let first = window.text();
    type_into(&mut window, "file-0", "// one\n");
    let second = type_into(&mut window, "file-1", "// two\n");
    window.click("file-0");
    window.click("undo");
    assert_eq!(window.text(), first);
    window.click("file-1");
    assert_eq!(window.text(), second);
}

#[test]
fn the_exercises_are_listed_begun_and_left_and_the_scene_stays() {
    for size in [DESK, PHONE] {
        let mut window = Window::empty(size);
        let scene = window.lab().document().clone();
        if size == PHONE {
            window.click("menu");
        }
        window.click("laboratory");
        assert_eq!(window.state()["open"], true);
        window.click("exercise-ex03");
        window.wait("the exercise", |s| s["exercise"] == "ex03" && s["drawn"] == true);
        let names: Vec<Value> = window.state()["files"].as_array().unwrap().iter().map(|f| f["name"].clone()).collect();
        assert!(names.contains(&"start.vert".into()), "{names:?}");
        window.click("leave");
        assert_eq!(window.state()["open"], false);
        window.widget("term-diffuse");
        assert_eq!(window.lab().document().panes, scene.panes);
    }
}

#[test]
fn a_file_is_not_lost_to_another_exercise() {
    let mut window = Window::open(right("ex04"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.click("editor");
    window.harness.event(Event::Text("// mine".into()));
    window.steps(2);
    let text = window.text();
    window.click("exercises");
    window.click("exercise-ex03");
    window.wait("the other", |s| s["exercise"] == "ex03" && s["drawn"] == true);
    window.click("exercises");
    window.click("exercise-ex04");
    assert_eq!((&window.state()["exercise"], window.text()), (&"ex04".into(), text));
    window.wait("its picture", |s| s["drawn"] == true);
}

#[test]
fn a_camera_turns_around_the_object_and_both_pictures_follow() {
    let mut window = Window::open(right("ex09"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.steps(2);
    let (before, _) = window.pixels(Picture::Yours);
    let from = window.center("picture-yours");
    window.harness.event(Event::PointerMoved(from));
    window.steps(1);
    let press = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.harness.event(press(from, true));
    for part in 1..=4 {
        window.harness.event(Event::PointerMoved(from + vec2(30.0 * part as f32, 0.0)));
        window.steps(1);
    }
    window.harness.event(press(from + vec2(120.0, 0.0), false));
    window.steps(2);
    assert!(differing(&window.pixels(Picture::Yours).0, &before) > 5000);
}

#[test]
fn every_page_of_every_exercise_fits_a_phone() {
    for exercise in exercise::all() {
        let start = Start { exercise: exercise.id.clone(), files: Vec::new() };
        let mut window = Window::open(start, PHONE);
        for page in ["files", "text", "verdict", "given"] {
            window.click(&format!("page-{page}"));
            for widget in exported::widgets(&window.harness.ctx) {
                let [left, _, width, _] = widget.rect;
                let is_scrolled = widget.id == "editor";
                assert!(
                    is_scrolled || (left >= 0.0 && left + width <= PHONE.x + 1.0),
                    "{}: {page}: {widget:?}",
                    exercise.id
                );
            }
        }
    }
}

#[test]
fn a_word_for_each_way_to_look() {
    let mut window = Window::open(right("ex07"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    for (id, shown) in [("reference", Shown::Reference), ("difference", Shown::Difference), ("yours", Shown::Yours)] {
        window.click(&format!("shown-{id}"));
        assert_eq!(window.state()["shown"], id);
        assert_eq!(window.lab().laboratory().work.as_ref().unwrap().shown, shown);
    }
    // The right answer differs nowhere from itself: the map is of one colour.
    window.click("shown-difference");
    let (map, _) = window.pixels(Picture::Difference);
    assert!(map.chunks(4).all(|pixel| pixel == &map[..4]));
}
