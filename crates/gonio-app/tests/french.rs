//! The window in French. The language is one per process, so these tests have a process of their own.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Event, Key, MissingGlyphPolicy, Modifiers, vec2};
use egui_kittest::kittest::NodeT;
use gonio_app::exercise::Start;
use gonio_app::exported;
use gonio_app::files::ExerciseFile;
use gonio_app::session::Tab;
use gonio_check::feedback::Feedback;
use gonio_exercises::exercise;
use gonio_language::{Language, name_id, text_in};
use std::collections::BTreeSet;
use std::time::Duration;
use support::{Here, Window};

/// Words that are English and not French.
const ENGLISH: &[&str] = &[
    "the", "of", "is", "are", "and", "with", "without", "from", "show", "shows", "this", "that", "these", "by",
    "click", "open", "save", "lights", "colour", "picture", "not", "each", "all", "as", "at", "when", "your", "file",
    "files", "to", "in", "where", "off",
];

impl Window {
    /// The texts of the accessibility tree: names and values of widgets.
    fn texts(&self) -> BTreeSet<String> {
        let mut texts = BTreeSet::new();
        let mut open = vec![self.harness.root()];
        while let Some(node) = open.pop() {
            let own = node.accesskit_node();
            // Code is the student's.
            if own.role() == egui::accesskit::Role::MultilineTextInput {
                continue;
            }
            texts.extend([own.label(), own.value(), own.description()].into_iter().flatten());
            open.extend(node.children());
        }
        texts
    }

    #[track_caller]
    fn is_in_french(&self, place: &str) {
        for text in self.texts() {
            // Neither code, nor headings of the lecture, nor titles of papers.
            let text = text.split(['`', '"', '\u{ab}', '\u{bb}']).step_by(2).collect::<String>();
            let text = text.replace("Communications of the ACM", "");
            // Formulas of the text are those of the code.
            if text.contains(" = ") {
                continue;
            }
            let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '\'' && c != '.' && c != '_' && c != '-');
            let english = words.find(|word| ENGLISH.contains(&word.to_lowercase().as_str()));
            assert_eq!(english, None, "{place}: {text}");
        }
    }

    /// Moves the focus by Tab to a widget.
    #[track_caller]
    fn tab_to(&mut self, id: &str) {
        let mut passed = BTreeSet::new();
        for _ in 0..200 {
            passed.extend(
                exported::widgets(&self.harness.ctx)
                    .into_iter()
                    .filter(|widget| widget.focused)
                    .map(|widget| widget.id),
            );
            if exported::widgets(&self.harness.ctx).iter().any(|widget| widget.id == id && widget.focused) {
                return;
            }
            // The editor keeps Tab for itself until Escape leaves it; Tab then goes on behind it.
            if exported::widgets(&self.harness.ctx).iter().any(|widget| widget.id == "editor" && widget.focused) {
                self.press(Modifiers::NONE, Key::Escape);
            }
            self.press(Modifiers::NONE, Key::Tab);
        }
        panic!("Tab does not reach `{id}`, but {passed:?}");
    }

    /// Waits until a condition holds.
    #[track_caller]
    fn wait(&mut self, awaited: &str, holds: impl Fn(&Window) -> bool) {
        for _ in 0..1200 {
            self.steps(1);
            if holds(self) {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("timed out waiting for {awaited}");
    }

    fn verdict(&self) -> serde_json::Value {
        self.app().state(&self.harness.ctx)["exercise"]["verdict"].clone()
    }
}

#[test]
fn every_panel_is_in_french() {
    Language::French.make_current();
    let mut window = Window::with("builtin:cube", vec2(1280.0, 2400.0));
    window.wait("the scene", |window| window.app().session().loaded.is_some());
    for tab in
        Tab::ALL.into_iter().filter(|tab| !matches!(tab, Tab::Shaders | Tab::Bake | Tab::Environment | Tab::File))
    {
        let at = window.center(&format!("tab-{}", tab.id()));
        window.click_at(at);
        window.steps(4);
        window.is_in_french(tab.title());
    }
    for id in ["help", "exercises"] {
        let at = window.center(id);
        window.click_at(at);
        window.steps(4);
        window.is_in_french(id);
        window.press(Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn names_that_other_crates_have_in_english_have_french_texts() {
    let mut missing = BTreeSet::new();
    let mut require = |words: &str| {
        let id = name_id(words.trim());
        if text_in(Language::French, &id).is_none() {
            missing.insert(format!("{id} = {}", words.trim()));
        }
    };
    macro_rules! require_all {
        ($($Enum:ty),+ $(,)?) => {
            $(for variant in <$Enum>::ALL {
                require(variant.name());
                require(variant.description());
            })+
        };
    }
    require_all!(
        gonio_light::Convention,
        gonio_light::Fresnel,
        gonio_light::Quantity,
        gonio_light::Simplification,
        gonio_light::Specular,
        gonio_light::Surfaces,
        gonio_light::color::ColorEncoding,
        gonio_light::color::ToneMap,
        gonio_plot::PlotKind,
        gonio_plot::PlotScale,
        gonio_plot::PlottedAngle,
        gonio_scene::SpecialView,
        gonio_scene::TextureFilter,
        gonio_scene::scene_file::LightSourceKind,
        gonio_scene::scene_file::Normals,
        gonio_scene::scene_file::Shading,
    );
    assert!(missing.is_empty(), "names.ftl lacks\n{}", missing.into_iter().collect::<Vec<_>>().join("\n"));
}

#[test]
fn a_student_s_evening_works_with_the_keyboard_alone() {
    Language::French.make_current();
    let mut window = Window::with("builtin:cube", vec2(1280.0, 800.0));
    // The fonts of the system have Chinese; here none is installed.
    window.harness.ctx.set_missing_glyph_policy(MissingGlyphPolicy::Tofu);
    window.tab_to("exercises");
    window.press(Modifiers::NONE, Key::Enter);
    window.tab_to("exercise-ex04");
    window.press(Modifiers::NONE, Key::Enter);
    window.wait("the exercise", |window| window.app().exercise().work.is_some());
    // The reference with one mistake and a comment in Chinese, typed over the start files.
    let answer = exercise::find("ex04").unwrap().reference_files().unwrap();
    for (name, text) in answer {
        let text = format!("{}// \u{6cd5}\u{7ebf}\u{5f52}\u{4e00}\u{5316}\n", text.replace("mat3(itM)", "mat3(M)"));
        let ending = name.split_once('.').unwrap().1;
        let mut widgets = exported::widgets(&window.harness.ctx).into_iter();
        let tab = widgets.find(|widget| widget.id.starts_with("file-") && widget.label.ends_with(ending)).unwrap();
        window.tab_to(&tab.id);
        window.press(Modifiers::NONE, Key::Enter);
        window.tab_to("editor");
        window.press(Modifiers::COMMAND, Key::A);
        window.harness.event(Event::Paste(text.clone()));
        window.steps(3);
        let work = window.app().exercise().work.as_ref().unwrap();
        assert_eq!(work.files[work.current].text, text, "{name}");
        window.press(Modifiers::NONE, Key::Escape);
    }
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the verdict", |window| window.verdict().is_object());
    let verdict = window.verdict();
    assert_eq!((&verdict["word"], &verdict["mistakes"][0]), (&"wrong".into(), &"normal-by-model-matrix".into()));
    window.is_in_french("verdict");
    // The editor takes the focus to show the line; the student corrects it.
    window.steps(4);
    window.tab_to("editor");
    let work = window.app().exercise().work.as_ref().unwrap();
    let fixed = work.files[work.current].text.replace("mat3(M)", "mat3(itM)");
    window.press(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Paste(fixed));
    window.steps(3);
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the second verdict", |window| window.verdict()["word"] == "correct");
    assert!(
        window.texts().iter().any(|text| text.contains("Juste") || text.contains("Correct")),
        "{:?}",
        window.texts()
    );
    window.is_in_french("second verdict");
}

#[test]
fn the_proven_fix_is_applied_with_the_keyboard_alone() {
    Language::French.make_current();
    let here = Here { feedback: Some(Feedback::Fix), ..Here::default() };
    let mut window = Window::on(here, "builtin:cube", vec2(1280.0, 800.0));
    let ctx = window.harness.ctx.clone();
    let files = exercise::find("ex04").unwrap().reference_files().unwrap().map(|(name, text)| ExerciseFile {
        name: name.to_owned(),
        bytes: text.replace("mat3(itM)", "mat3(M)").into_bytes(),
        path: None,
    });
    let start = Start { exercise: "ex04".into(), files: files.collect() };
    window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
    window.wait("the exercise", |window| window.app().exercise().work.is_some());
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the verdict", |window| window.verdict()["word"] == "wrong");
    window.steps(4);
    // The editor has the focus, to show the line.
    window.press(Modifiers::NONE, Key::Escape);
    window.tab_to("hints-fix");
    window.press(Modifiers::NONE, Key::Enter);
    window.steps(2);
    window.tab_to("apply-fix");
    window.press(Modifiers::NONE, Key::Enter);
    window.steps(2);
    window.press(Modifiers::COMMAND, Key::Enter);
    window.wait("the second verdict", |window| window.verdict()["word"] == "correct");
}

#[test]
fn a_start_of_an_exercise_has_its_text_in_french() {
    Language::French.make_current();
    let mut window = Window::with("builtin:cube", vec2(1280.0, 2000.0));
    let ctx = window.harness.ctx.clone();
    let start = Start { exercise: "ex07".into(), files: Vec::new() };
    window.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
    window.steps(4);
    window.is_in_french("ex07");
}
