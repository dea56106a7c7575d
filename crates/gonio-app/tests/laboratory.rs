//! The laboratory as a student uses it: the whole application, with OpenGL but without a window, checks in a thread.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Event, Key, Modifiers, Vec2, vec2};
use gonio_app::exported;
use gonio_app::laboratory::{GivenFile, Picture, Shown, Start};
use gonio_lab::exercise;
use serde_json::Value;
use std::time::Duration;
use support::Window;

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
        Window::with("builtin:cube", size)
    }

    /// The laboratory's part of the state.
    fn state(&self) -> Value {
        self.lab().state(&self.harness.ctx)["laboratory"].clone()
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

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // The next click is another one, and none of a double click.
        self.steps(30);
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
    window.drag(from, vec2(120.0, 0.0));
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
