//! Text in scripts that gonio's fonts lack: the whole application, with a platform that has a font, or none.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{
    Color32, FallbackRequest, FontData, FontFamily, FontId, FontInsert, FontProvider, MissingGlyphPolicy, vec2,
};
use gonio_app::exercise::Start;
use gonio_app::files::ExerciseFile;
use gonio_app::platform::{Event as PlatformEvent, SceneInput};
use gonio_app::session::{MessageSeverity, UserMessage};
use gonio_scene::files::Disk;
use std::path::Path;
use std::sync::{Arc, Mutex};
use support::Window;

const INTER: &[u8] = include_bytes!("../../../assets/fonts/Inter-Regular.ttf");
/// In no font: an unassigned code point.
const NOWHERE: char = '\u{378}';

/// Inter with another character map, as a font of these characters.
fn font_of(characters: &str) -> Vec<u8> {
    let mut map = [[0, 0, 0, 1, 0, 3, 0, 10].as_slice(), &12_u32.to_be_bytes(), &[0, 12, 0, 0]].concat();
    let mut sorted: Vec<char> = characters.chars().collect();
    sorted.sort_unstable();
    for value in [16 + 12 * sorted.len() as u32, 0, sorted.len() as u32] {
        map.extend(value.to_be_bytes());
    }
    for (glyph, &character) in (20_u32..).zip(&sorted) {
        [character.into(), character.into(), glyph].iter().for_each(|value: &u32| map.extend(value.to_be_bytes()));
    }
    let number = |at: usize| u32::from_be_bytes(INTER[at..at + 4].try_into().unwrap());
    let tables = usize::from(u16::from_be_bytes(INTER[4..6].try_into().unwrap()));
    let (mut head, mut body) = (INTER[..12].to_vec(), Vec::new());
    for record in (0..tables).map(|index| 12 + 16 * index) {
        let (start, length) = (number(record + 8) as usize, number(record + 12) as usize);
        let table = if &INTER[record..record + 4] == b"cmap" { &map } else { &INTER[start..start + length] };
        head.extend(&INTER[record..record + 8]);
        head.extend(((12 + 16 * tables + body.len()) as u32).to_be_bytes());
        head.extend((table.len() as u32).to_be_bytes());
        body.extend(table);
        body.resize(body.len().next_multiple_of(4), 0);
    }
    [head, body].concat()
}

/// A font of these characters that records what it is asked for.
struct RecordedFont {
    characters: &'static str,
    asked: Mutex<Vec<(FontFamily, String)>>,
}

impl FontProvider for RecordedFont {
    fn font_for(&self, request: &FallbackRequest<'_>) -> Option<FontInsert> {
        self.asked.lock().unwrap().push((request.family.clone(), request.cluster.to_owned()));
        let has = self.characters.contains(request.cluster);
        has.then(|| FontInsert::new("other scripts", FontData::from_owned(font_of(self.characters)), Vec::new()))
    }
}

impl Window {
    /// A window that displays characters without a font as boxes.
    fn with_boxes() -> Self {
        let window = Window::with("builtin:cube", vec2(1280.0, 800.0));
        window.harness.ctx.set_missing_glyph_policy(MissingGlyphPolicy::Tofu);
        window
    }

    /// Opens a model and waits for it.
    fn open(&mut self, path: &Path) {
        let inputs = vec![path.to_string_lossy().into_owned()];
        let (names, problem) = (Vec::new(), None);
        let input = SceneInput { inputs, environment: None, shaders: None, names, problem, files: Arc::new(Disk) };
        self.here.coming.borrow_mut().push(PlatformEvent::Open(Box::new(input)));
        while self.app().session().title != path.file_name().unwrap().to_string_lossy() {
            self.steps(1);
        }
    }

    /// Opens an exercise with one file.
    fn comment(&mut self, name: &str, comment: &str) {
        let text = format!("#version 330 core\n// {comment}\nout vec4 c;\nvoid main() {{ c = vec4(1.0); }}\n");
        let file = ExerciseFile { name: name.into(), path: None, bytes: text.into_bytes() };
        let start = Start { exercise: "ex04".into(), files: vec![file] };
        let ctx = self.harness.ctx.clone();
        self.harness.state_mut().as_mut().unwrap().begin_exercise(&ctx, start);
        self.steps(4);
    }

    fn say(&mut self, text: &str) {
        self.here.coming.borrow_mut().push(PlatformEvent::Failed(text.to_owned()));
        self.steps(4);
    }

    fn notes(&self) -> Vec<UserMessage> {
        let list = self.app().session().messages.list().iter();
        list.filter(|message| message.severity == MessageSeverity::Note).cloned().collect()
    }

    /// The pixels of a character as the window draws it.
    fn pixels(&self, character: char) -> (usize, Vec<Color32>) {
        self.harness.ctx.fonts_mut(|fonts| {
            let galley = fonts.layout_no_wrap(character.into(), FontId::monospace(12.5), Color32::WHITE);
            let uv = galley.rows[0].row.glyphs[0].uv_rect;
            let image = fonts.image();
            let [left, right] = [uv.min[0], uv.max[0]].map(usize::from);
            let rows = usize::from(uv.min[1])..usize::from(uv.max[1]);
            let pixels = rows.flat_map(|y| image.pixels[y * image.width() + left..y * image.width() + right].to_vec());
            (right - left, pixels.collect())
        })
    }
}

#[test]
fn a_comment_a_file_name_a_model_and_a_message_are_drawn_with_the_platforms_font() {
    let folder = std::env::temp_dir().join(format!("gonio-glyphs-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let model = folder.join("Чаша.obj");
    std::fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let font = Arc::new(RecordedFont { characters: "漫反射Чашанемкуд法線", asked: Mutex::default() });
    let mut window = Window::with_boxes();
    window.steps(1);
    assert!(!window.pixels('漫').1.is_empty());
    assert_eq!(window.pixels('漫'), window.pixels(NOWHERE), "it is a box before");
    *window.here.fonts.borrow_mut() = Some(font.clone());
    window.open(&model);
    window.steps(4);
    // From here on, any box is a panic.
    window.harness.ctx.set_missing_glyph_policy(MissingGlyphPolicy::Panic);
    window.steps(4);
    window.comment("куда.frag", "漫反射");
    window.say("法線: нема");
    let asked = font.asked.lock().unwrap().clone();
    for (family, character) in [(FontFamily::Monospace, "漫"), (FontFamily::Proportional, "Ч")] {
        assert!(asked.contains(&(family.clone(), character.to_owned())), "{family:?} {character}: {asked:?}");
    }
    window.harness.ctx.set_missing_glyph_policy(MissingGlyphPolicy::Tofu);
    window.steps(1);
    for character in "漫射уЧ線".chars() {
        assert_ne!(window.pixels(character), window.pixels(NOWHERE), "{character}");
    }
    assert_eq!(window.notes(), []);
    assert_eq!(*window.here.searches.borrow(), 1);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn characters_without_a_font_are_reported_once() {
    let mut window = Window::with_boxes();
    window.comment("a.frag", "ህ");
    window.steps(10);
    let notes = window.notes();
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(notes[0].text.starts_with("No font has the character ህ (U+1205), displayed as a box: "), "{notes:?}");
    // In another family too, and beside what has a font.
    window.say("ህ in a message");
    window.steps(10);
    assert_eq!((window.notes(), *window.here.searches.borrow()), (notes, 1));
    window.say("ሎ in another");
    let notes = window.notes();
    assert_eq!((notes.len(), notes[0].times, *window.here.searches.borrow()), (1, 1, 2), "{notes:?}");
    assert!(notes[0].text.contains("ህ (U+1205) and ሎ (U+120E), "), "{notes:?}");
    window.click_at(window.center(&format!("dismiss-{}", notes[0].id)));
    window.steps(10);
    assert_eq!((window.notes(), *window.here.searches.borrow()), (Vec::new(), 2));
}
