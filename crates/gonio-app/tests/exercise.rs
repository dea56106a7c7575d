//! The exercises as a student uses them: the whole application, with OpenGL but without a window; checks run in a thread.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Event, Key, Modifiers, Vec2, vec2};
use gonio_app::exercise::{PictureMode, PreviewPicture, Start};
use gonio_app::exported;
use gonio_app::files::ExerciseFile;
use gonio_app::platform::{Event as PlatformEvent, Purpose, TrialOutcome};
use gonio_exercises::exercise;
use serde_json::Value;
use std::time::Duration;
use support::Window;

/// The correct answer of an exercise, with a change.
fn answer(id: &str, change: impl Fn(&str, &str) -> String) -> Start {
    let exercise = exercise::find(id).unwrap();
    let file = |(name, text): (&'static str, &'static str)| ExerciseFile {
        name: name.to_owned(),
        path: None,
        bytes: change(name, text).into_bytes(),
    };
    Start { exercise: id.to_owned(), files: exercise.reference_files().unwrap().map(file).collect() }
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

    /// Delivers files as if they were dropped.
    fn hand(&mut self, files: &[(&str, &[u8])]) {
        let file =
            |(name, bytes): &(&str, &[u8])| ExerciseFile { name: (*name).into(), path: None, bytes: bytes.to_vec() };
        self.here.coming.borrow_mut().push(PlatformEvent::ExerciseFiles(files.iter().map(file).collect()));
        self.steps(2);
    }

    /// The messages that were not dismissed.
    fn messages(&self) -> Vec<String> {
        self.app().session().messages.list().iter().map(|message| message.text.clone()).collect()
    }

    /// The exercise's part of the state.
    fn state(&self) -> Value {
        self.app().state(&self.harness.ctx)["exercise"].clone()
    }

    /// Runs frames until a condition holds: checks take time, and texts are compiled after a pause.
    #[track_caller]
    fn wait(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..1200 {
            self.steps(1);
            let state = self.state();
            if expected(&state) {
                return state;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("timed out waiting for {what}: {:#}", self.state());
    }

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // A pause, so that the next click is not part of a double click.
        self.steps(30);
    }

    fn text(&self) -> String {
        let work = self.app().exercise().work.as_ref().unwrap();
        work.files[work.current].text.clone()
    }

    fn pixels(&self, picture: PreviewPicture) -> (Vec<u8>, [u32; 2]) {
        self.app().exercise().pixels(picture).unwrap()
    }
}

const DESK: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

/// Number of pixels that differ by more than two 8-bit steps.
fn differing(a: &[u8], b: &[u8]) -> usize {
    assert_eq!(a.len(), b.len());
    a.chunks(4).zip(b.chunks(4)).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2)).count()
}

#[test]
fn the_right_answer_looks_like_the_reference_in_every_exercise() {
    for exercise in exercise::all().iter().filter(|exercise| exercise.kind == exercise::ExerciseKind::Shaders) {
        let mut window = Window::open(right(&exercise.id), DESK);
        window.wait("the program", |s| s["drawn"] == true);
        window.click("shown-both");
        window.steps(2);
        let (yours, size) = window.pixels(PreviewPicture::Yours);
        let (reference, _) = window.pixels(PreviewPicture::Reference);
        // Both are drawn in the same frame, even if time runs.
        assert_eq!(differing(&yours, &reference), 0, "{}", exercise.id);
        let first = yours[..4].to_vec();
        let drawn = yours.chunks(4).filter(|pixel| **pixel != first).count();
        assert!(drawn > (size[0] * size[1] / 20) as usize, "{}: {drawn} pixels are drawn", exercise.id);
    }
}

#[test]
fn a_mistake_is_named_and_its_line_is_a_click_away() {
    let start = answer("ex04", |_, text| text.replace("mat3(itM)", "mat3(M)"));
    let mut window = Window::open(start, DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.click("shown-both");
    // The lab's own scene hides it.
    let of = |window: &Window| {
        differing(&window.pixels(PreviewPicture::Yours).0, &window.pixels(PreviewPicture::Reference).0)
    };
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
    assert_eq!((&state["page"], &state["file"]), (&"verdict".into(), &"reference.vert".into()));
    window.steps(2);
    window.click("file-0");
    assert_eq!(window.state()["file"], "reference.frag");
    window.click("mistake-0");
    assert_eq!(window.state()["file"], "reference.vert");
}

#[test]
fn a_verdict_shows_the_scene_that_differs_most_and_each_other_one_at_a_click() {
    let start = answer("ex04", |_, text| text.replace("mat3(itM)", "mat3(M)"));
    // All scenes of the verdict are visible.
    let mut window = Window::open(start, vec2(1280.0, 1600.0));
    window.wait("the program", |s| s["drawn"] == true);
    window.click("shown-both");
    assert_eq!((&window.state()["scene"], &window.state()["test"]), (&"the lab's".into(), &false.into()));
    window.press(Modifiers::COMMAND, Key::Enter);
    let state = window.wait("the verdict", |s| s["verdict"].is_object());
    assert_eq!(state["test"], true);
    window.steps(2);
    let of = |window: &Window| {
        differing(&window.pixels(PreviewPicture::Yours).0, &window.pixels(PreviewPicture::Reference).0)
    };
    let shown = state["scene"].as_str().unwrap().to_owned();
    assert!(of(&window) > 1000, "{shown}: {} pixels differ", of(&window));
    // The lab's own scene hides the mistake.
    window.click("test-scene-lab");
    assert_eq!((&window.state()["scene"], of(&window)), (&"lab".into(), 0));
    window.click(&format!("test-scene-{shown}"));
    assert_eq!(window.state()["scene"], shown.as_str());
    // The scenes to look at are still offered.
    window.click("scene-stretched");
    assert_eq!((&window.state()["scene"], &window.state()["test"]), (&"stretched".into(), &false.into()));
}

#[test]
fn hints_go_from_the_symptom_to_the_fix() {
    let start = answer("ex04", |_, text| text.replace("mat3(itM)", "mat3(M)"));
    let mut window = Window::open(start, DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the verdict", |s| s["verdict"].is_object());
    window.steps(2);
    let marks = |window: &Window| window.state()["marks"].as_array().unwrap().len();
    let has = |window: &Window, id: &str| exported::widgets(&window.harness.ctx).iter().any(|widget| widget.id == id);
    assert_eq!((window.state()["hints"].clone(), marks(&window), has(&window, "mistake-0")), ("line".into(), 1, true));
    window.click("hints-symptom");
    assert_eq!((marks(&window), has(&window, "mistake-0")), (0, false));
    let told = |window: &Window| {
        let widgets = exported::widgets(&window.harness.ctx);
        widgets.into_iter().find(|widget| widget.id == "verdict").unwrap().value
    };
    assert!(!told(&window).to_string().contains("inverse transpose"), "{}", told(&window));
    window.click("hints-name");
    assert!(told(&window).to_string().contains("inverse transpose"), "{}", told(&window));
    assert_eq!((marks(&window), has(&window, "mistake-0")), (0, false));
    window.click("file-0");
    window.click("hints-fix");
    assert_eq!((marks(&window), window.state()["file"].clone()), (1, "reference.vert".into()));
    let mark = window.state()["marks"][0]["text"].as_str().unwrap().to_owned();
    assert!(mark.contains("itM"), "{mark}");
}

#[test]
fn the_lamp_is_dragged_in_the_picture() {
    let mut window = Window::open(right("ex04"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.steps(2);
    let lamp = |window: &Window| -> Vec<f64> { serde_json::from_value(window.state()["lamp"].clone()).unwrap() };
    let (before, from) = (lamp(&window), window.center("lamp-0"));
    let (pixels, _) = window.pixels(PreviewPicture::Yours);
    window.drag(from, vec2(-60.0, 30.0));
    let after = lamp(&window);
    assert!(after[0] < before[0] - 0.1 && after[1] < before[1] - 0.05, "{before:?} {after:?}");
    assert!(differing(&pixels, &window.pixels(PreviewPicture::Yours).0) > 1000);
    let (yours, reference) = (window.pixels(PreviewPicture::Yours).0, window.pixels(PreviewPicture::Reference).0);
    assert_eq!(differing(&yours, &reference), 0, "both pictures have the same lamp");
    assert!((window.center("lamp-0") - (from + vec2(-60.0, 30.0))).length() < 2.0);
    window.click("frame");
    assert_eq!(lamp(&window), before);
    // A mirror has no lamp, and nothing plays where nothing moves.
    let window = Window::open(right("ex09"), DESK);
    assert_eq!(window.state()["lamp"], Value::Null);
    let has = |window: &Window, id: &str| exported::widgets(&window.harness.ctx).iter().any(|widget| widget.id == id);
    assert!(!has(&window, "play"));
    assert!(has(&Window::open(right("ex07"), DESK), "play"));
}

#[test]
fn the_editor_indents_comments_and_finds() {
    let mut window = Window::open(right("ex04"), DESK);
    window.click("editor");
    window.press(Modifiers::COMMAND, Key::End);
    let before = window.text();
    let typed = |window: &mut Window, text: &str| {
        window.harness.event(Event::Text(text.into()));
        window.steps(1);
    };
    window.press(Modifiers::NONE, Key::Enter);
    typed(&mut window, "void f() {");
    window.press(Modifiers::NONE, Key::Enter);
    typed(&mut window, "int findable;");
    window.press(Modifiers::NONE, Key::Enter);
    typed(&mut window, "}");
    assert_eq!(window.text(), format!("{before}\nvoid f() {{\n    int findable;\n}}"));
    window.press(Modifiers::COMMAND, Key::Slash);
    assert!(window.text().ends_with("\n// }"), "{}", window.text());
    window.press(Modifiers::COMMAND, Key::F);
    typed(&mut window, "INDABLE");
    window.steps(2);
    let found = exported::widgets(&window.harness.ctx).into_iter().find(|widget| widget.id == "found").unwrap();
    assert_eq!(found.value, "1 of 1");
    // Escape goes back to the text, with the match selected.
    window.press(Modifiers::NONE, Key::Escape);
    window.steps(2);
    typed(&mut window, "x");
    assert!(window.text().contains("int fx;"), "{}", window.text());
}

#[test]
fn the_list_tells_what_was_checked() {
    let mut window = Window::open(answer("ex04", |_, text| text.replace("mat3(itM)", "mat3(M)")), DESK);
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the verdict", |s| s["verdict"].is_object());
    window.click("exercises");
    window.steps(30);
    let state = |window: &Window, id: &str| {
        let widgets = exported::widgets(&window.harness.ctx);
        widgets.into_iter().find(|widget| widget.id == id).unwrap().value
    };
    assert_eq!(state(&window, "exercise-ex04"), "wrong");
    assert_eq!(state(&window, "exercise-ex03"), "not started");
    assert_eq!(window.app().session().settings.outcomes.len(), 1, "it is kept for the next window");
}

#[test]
fn compiler_errors_are_marked_and_the_last_picture_stays() {
    let mut window = Window::open(right("ex06"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.steps(2);
    let (before, _) = window.pixels(PreviewPicture::Yours);
    window.click("editor");
    window.press(Modifiers::COMMAND, Key::End);
    window.harness.event(Event::Text("\nvoid broken(".into()));
    let state = window.wait("the error", |s| s["older"] == true);
    let lines = window.text().lines().count() as u64;
    let marks = state["marks"].as_array().unwrap();
    assert!(
        marks.iter().any(|n| n["kind"] == "error" && n["line"].as_u64().is_some_and(|l| l + 1 >= lines)),
        "{marks:?}"
    );
    window.widget("older-program");
    assert_eq!(differing(&window.pixels(PreviewPicture::Yours).0, &before), 0);
    assert_eq!(window.state()["files"][0]["changed"], true);
    // Undo by key, redo by button.
    let text = window.text();
    window.steps(90);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_ne!(window.text(), text);
    window.wait("it to compile again", |s| s["older"] == false && s["marks"].as_array().is_some_and(Vec::is_empty));
    window.click("redo");
    assert_eq!(window.text(), text);
}

#[test]
fn programs_reach_the_windows_opengl_only_after_their_trial() {
    let mut window = Window::empty(DESK);
    let trials = window.here.trials.clone();
    trials.borrow_mut().is_on = true;
    let ctx = window.harness.ctx.clone();
    window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, right("ex04"));
    window.wait("the trial", |s| s["tried"] == true);
    window.steps(20);
    assert_eq!((&window.state()["drawn"], trials.borrow().begun), (&false.into(), 1));
    trials.borrow_mut().outcome = Some(TrialOutcome::Harmless);
    window.wait("the program", |s| s["drawn"] == true && s["tried"] == false);
    window.steps(2);
    let (before, text) = (window.pixels(PreviewPicture::Yours).0, window.text());
    // Changing a text stops its trial.
    window.click("editor");
    window.press(Modifiers::COMMAND, Key::End);
    window.harness.event(Event::Text("// a".into()));
    window.wait("a trial", |s| s["tried"] == true);
    window.harness.event(Event::Text("b".into()));
    window.steps(2);
    assert_eq!((trials.borrow().begun, trials.borrow().running), (2, 0));
    window.wait("another trial", |s| s["tried"] == true);
    trials.borrow_mut().outcome = Some(TrialOutcome::Refused("It crashed.".into()));
    let state = window.wait("the sentence", |s| s["unusable"].is_string());
    assert_eq!(
        (&state["unusable"], &state["older"], &state["tried"]),
        (&"It crashed.".into(), &true.into(), &false.into())
    );
    window.widget("older-program");
    assert_eq!(differing(&window.pixels(PreviewPicture::Yours).0, &before), 0, "the last picture stays");
    // Outcomes of trials are remembered.
    window.steps(90);
    while window.text() != text {
        window.press(Modifiers::COMMAND, Key::Z);
    }
    let state = window.wait("the program of before", |s| s["older"] == false && s["unusable"].is_null());
    assert_eq!((&state["drawn"], trials.borrow().begun), (&true.into(), 3));
}

#[test]
fn without_trials_only_programs_that_cannot_hang_are_drawn() {
    let outcome = TrialOutcome::Unavailable("there is no OpenGL".into());
    let looping =
        |_: &str, text: &str| text.replacen("void main() {", "void main() {\n    for (int i = 0; i < 2; ++i) {}", 1);
    for (start, is_drawn) in [(right("ex04"), true), (answer("ex04", looping), false)] {
        let mut window = Window::empty(DESK);
        *window.here.trials.borrow_mut() =
            support::Trials { is_on: true, outcome: Some(outcome.clone()), ..Default::default() };
        let ctx = window.harness.ctx.clone();
        window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
        let state = window.wait("the end of the trial", |s| s["drawn"] == true || s["unusable"].is_string());
        assert_eq!(state["drawn"], is_drawn);
        assert_eq!(is_drawn, state["unusable"].is_null(), "{}", state["unusable"]);
    }
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

/// Pairs of shaders have drawn pictures; the goals of other exercises are built in.
#[test]
fn exercises_without_shaders_show_their_goals_too() {
    let mut window = Window::empty(vec2(1000.0, 2000.0));
    window.click("exercises");
    window.steps(3);
    for exercise in exercise::all().iter().filter(|exercise| exercise.kind != exercise::ExerciseKind::Shaders) {
        let picture = window.widget(&format!("goal-{}", exercise.id));
        assert_eq!((picture.role, picture.label.as_str()), (exported::WidgetRole::Picture, exercise.title()));
    }
}

#[test]
fn the_exercises_are_listed_begun_and_left_and_the_scene_stays() {
    for size in [DESK, PHONE] {
        let mut window = Window::empty(size);
        let scene = window.app().document().clone();
        if size == PHONE {
            window.click("menu");
        }
        window.click("exercises");
        assert_eq!(window.state()["open"], true);
        window.click("exercise-ex03");
        window.wait("the exercise", |s| s["id"] == "ex03" && s["drawn"] == true);
        let names: Vec<Value> = window.state()["files"].as_array().unwrap().iter().map(|f| f["name"].clone()).collect();
        assert!(names.contains(&"start.vert".into()), "{names:?}");
        window.click("leave");
        assert_eq!(window.state()["open"], false);
        window.widget("term-diffuse");
        assert_eq!(window.app().document().panes, scene.panes);
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
    window.wait("the other", |s| s["id"] == "ex03" && s["drawn"] == true);
    window.click("exercises");
    window.click("exercise-ex04");
    assert_eq!((&window.state()["id"], window.text()), (&"ex04".into(), text));
    window.wait("its picture", |s| s["drawn"] == true);
}

#[test]
fn a_camera_turns_around_the_object_and_both_pictures_follow() {
    let mut window = Window::open(right("ex09"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.steps(2);
    let (before, _) = window.pixels(PreviewPicture::Yours);
    let from = window.center("picture-yours");
    window.drag(from, vec2(120.0, 0.0));
    assert!(differing(&window.pixels(PreviewPicture::Yours).0, &before) > 5000);
}

#[test]
fn every_page_of_every_exercise_fits_a_phone() {
    for exercise in exercise::all() {
        let start = Start { exercise: exercise.id.clone(), files: Vec::new() };
        let mut window = Window::open(start, PHONE);
        for page in ["files", "text", "verdict", "variables"] {
            window.click(&format!("page-{page}"));
            for widget in exported::widgets(&window.harness.ctx) {
                let [left, _, width, _] = widget.rect;
                let is_scrolled = widget.id == "editor" || widget.id.starts_with("figure-");
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
fn each_picture_mode_has_its_word() {
    let mut window = Window::open(right("ex07"), DESK);
    window.wait("the program", |s| s["drawn"] == true);
    for (id, shown) in
        [("reference", PictureMode::Reference), ("difference", PictureMode::Difference), ("yours", PictureMode::Yours)]
    {
        window.click(&format!("shown-{id}"));
        assert_eq!(window.state()["shown"], id);
        assert_eq!(window.app().exercise().work.as_ref().unwrap().shown, shown);
    }
    // The correct answer does not differ from itself, so the map has one colour.
    window.click("shown-difference");
    let (map, _) = window.pixels(PreviewPicture::Difference);
    assert!(map.chunks(4).all(|pixel| pixel == &map[..4]));
}

const GREEN: &[u8] = b"#version 330 core\nout vec4 FragColor;\nvoid main() { FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n";

#[test]
fn an_opened_file_replaces_its_kind_and_edits_can_be_put_back() {
    let mut window = Window::open(Start { exercise: "ex04".into(), files: Vec::new() }, DESK);
    window.wait("the program", |s| s["drawn"] == true);
    window.click("editor");
    window.harness.event(Event::Text("// not saved\n".into()));
    window.steps(2);
    let written = window.text();
    window.hand(&[("My shader.txt", GREEN), ("notes.md", b"to do")]);
    let state = window.wait("the picture", |s| s["file"] == "My shader.txt" && s["drawn"] == true);
    let shown: Vec<&Value> = state["files"].as_array().unwrap().iter().filter(|f| f["shown"] == true).collect();
    assert_eq!(shown.iter().map(|f| f["name"].as_str().unwrap()).collect::<Vec<_>>(), ["start.vert", "My shader.txt"]);
    assert!(window.messages().iter().any(|m| m.contains("notes.md")), "{:?}", window.messages());
    window.steps(2);
    let (pixels, _) = window.pixels(PreviewPicture::Yours);
    assert!(pixels.chunks(4).any(|pixel| pixel[..3] == [0, 255, 0]), "it is drawn");
    window.click("put-back");
    assert_eq!((window.text(), window.state()["file"].as_str()), (written.clone(), Some("start.frag")));
    // Each file has its own undo history.
    window.click("undo");
    assert_ne!(window.text(), written);
    window.click("put-back");
    assert_eq!(window.text().as_bytes(), GREEN);
}

#[test]
fn a_program_replaces_both_shaders_and_a_model_is_refused() {
    let mut window = Window::open(Start { exercise: "ex04".into(), files: Vec::new() }, PHONE);
    let exercise = exercise::find("ex04").unwrap();
    let [vertex, fragment] = ["reference.vert", "reference.frag"].map(|name| exercise.file(name).unwrap());
    let program = format!("const char* vs = R\"({vertex})\";\nconst char* fs = R\"({fragment})\";\n");
    window.hand(&[("main.cpp", program.as_bytes())]);
    let state = window.wait("the picture", |s| s["file"] == "main.cpp" && s["drawn"] == true);
    assert_eq!(state["files"].as_array().unwrap().iter().filter(|f| f["shown"] == true).count(), 1);
    let scene = window.app().document().clone();
    window.hand(&[("cow.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    assert!(window.messages().iter().any(|m| m.starts_with("cow.obj is a model")), "{:?}", window.messages());
    assert_eq!((window.state()["open"].as_bool(), window.state()["file"].as_str()), (Some(true), Some("main.cpp")));
    assert!(window.app().document().scene == scene.scene);
    // The button opens files for the exercise. In the list, no exercise is selected for them.
    window.click("open-files");
    assert_eq!(window.here.asked.take(), Some(Purpose::Exercise));
    window.click("path-cancel");
    window.click("exercises");
    window.hand(&[("a.frag", GREEN)]);
    assert!(window.messages().iter().any(|m| m.starts_with("select the exercise first")), "{:?}", window.messages());
}

#[test]
fn the_buffer_in_the_editor_is_checked() {
    let mut window = Window::open(Start { exercise: "ex02".into(), files: Vec::new() }, DESK);
    let table = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../gonio-exercises/tests/buffers.txt");
    let table = gonio_fixtures::FixtureTable::read(table).unwrap();
    let [right, wrong] = ["house.reference.csv", "house.start.csv"].map(|name| table.get(name).unwrap().to_vec());
    let floats = [0_u8; 96];
    window.hand(&[("house.csv", &right), ("house2.csv", &wrong), ("cube.bin", &floats)]);
    for (tab, word) in [("house.csv", "correct"), ("house2.csv", "wrong")] {
        let work = window.app().exercise().work.as_ref().unwrap();
        let index = work.file_named(tab).unwrap();
        window.click(&format!("file-{index}"));
        window.press(Modifiers::COMMAND, Key::Enter);
        let state = window.wait(tab, |s| s["checking"] == false && s["verdict"]["stale"] == false);
        assert_eq!(state["verdict"]["word"], word, "{tab}: {}", state["verdict"]);
    }
    let work = window.app().exercise().work.as_ref().unwrap();
    assert_eq!(work.files[work.file_named("cube.bin").unwrap()].text, "96 bytes of binary data.\n");
}

#[test]
fn starting_over_loses_no_text() {
    let mut window = Window::open(right("ex08"), DESK);
    let before = window.text();
    // The button is below the text.
    window.click("page-text");
    let middle = window.center("page-text") + vec2(0.0, 80.0);
    window.harness.event(Event::PointerMoved(middle));
    for _ in 0..60 {
        window.harness.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: vec2(0.0, -400.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
            modifiers: Modifiers::NONE,
        });
        window.steps(1);
    }
    window.steps(30);
    window.click("begin-again");
    assert_eq!(window.state()["file"], "start.frag");
    window.click("put-back");
    assert_eq!((window.state()["file"].as_str(), window.text()), (Some("reference.frag"), before));
}

#[test]
fn every_text_shows_its_figures() {
    for size in [DESK, PHONE] {
        for exercise in exercise::all() {
            let figures: Vec<&str> = exercise.start_files().map(|(n, _)| n).filter(|n| n.ends_with(".svg")).collect();
            let mut window = Window::open(Start { exercise: exercise.id.clone(), files: Vec::new() }, size);
            window.click("page-text");
            for figure in figures {
                let [_, _, width, height] = window.widget(&format!("figure-{figure}")).rect;
                assert!(width > 300.0 && height > 100.0, "{figure}: {width} x {height}");
            }
        }
    }
}
