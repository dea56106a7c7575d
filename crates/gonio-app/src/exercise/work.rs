//! The open exercise as plain data: the student's files, compiler messages, verdict.

use super::file_sets::OpenFileSet;
use crate::files::ExerciseFile;
use crate::session::Clock;
use crate::step::code::{Mark, MarkKind};
use egui::Id;
use glam::Vec3;
use gonio_check::roles::Role;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{FoundMistake, SceneVerdict, Verdict};
use gonio_exercises::exercise::{Exercise, ExerciseKind};
use gonio_exercises::preview::{self, Note, NoteKind, PreviewScene, VariableValue};
use gonio_language::tr;
use gonio_scene::settings::{Aim, CameraSettings};
use std::path::PathBuf;

/// A file in the editor.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenFile {
    /// The name in the exercise.
    pub name: String,
    /// The path on disk; `None` for a file in memory.
    pub path: Option<PathBuf>,
    /// The text in the editor.
    pub text: String,
    /// The saved content.
    pub saved: Vec<u8>,
    /// A conflicting version on disk, until the user chooses one.
    pub other: Option<Vec<u8>>,
    /// Whether it cannot be edited, because it is not UTF-8 text.
    pub locked: bool,
    /// The age of the restored draft, if the text is one: "5 minutes ago".
    pub restored: Option<String>,
    /// Whether a draft of this file was looked for.
    pub(super) draft_was_checked: bool,
    /// Id of the editor's widget.
    id: Id,
    /// Whether it has a tab.
    is_shown: bool,
}

/// Extensions of files that come with an exercise and are not part of the answer.
const PAPERS: [&str; 5] = [".md", ".svg", ".obj", ".png", ".jpg"];

impl OpenFile {
    /// Opens a file. `number` distinguishes files of the same name that are opened at different times.
    pub(super) fn new(exercise: &Exercise, file: ExerciseFile, number: (u64, usize)) -> Self {
        let (text, locked) = decoded(&file.bytes);
        let id = Id::unique("exercise editor").with((&exercise.id, number, &file.name));
        let name = file.name.to_ascii_lowercase();
        let is_shown = !PAPERS.iter().any(|end| name.ends_with(end));
        OpenFile {
            name: file.name,
            path: file.path,
            text,
            saved: file.bytes,
            other: None,
            locked,
            restored: None,
            draft_was_checked: false,
            id,
            is_shown,
        }
    }

    /// The same file with a tab, whatever its name, because the student opened it as an answer.
    pub(super) fn shown(self) -> Self {
        OpenFile { is_shown: true, ..self }
    }

    /// Whether it was read from this file and is unchanged.
    pub(super) fn is_same(&self, file: &ExerciseFile) -> bool {
        self.path == file.path && self.name == file.name && self.saved == file.bytes && !self.is_changed()
    }

    /// Whether it has unsaved changes.
    pub fn is_changed(&self) -> bool {
        !self.locked && self.text.as_bytes() != self.saved
    }

    /// Whether it has a tab: texts and figures of the exercise have none.
    pub fn is_shown(&self) -> bool {
        self.is_shown
    }

    /// Its content for a check; a file that is not text is unchanged.
    pub fn content(&self) -> Vec<u8> {
        if self.locked { self.saved.clone() } else { self.text.clone().into_bytes() }
    }

    /// Id of the editor's widget, which has its own undo history.
    pub fn id(&self) -> Id {
        self.id
    }

    /// Loads the content of the changed file on disk. Returns whether it replaced the text; with unsaved changes both versions are
    /// kept, and the user chooses one.
    pub fn reload(&mut self, bytes: Vec<u8>) -> bool {
        if bytes == self.saved {
            return false;
        }
        if self.is_changed() && self.text.as_bytes() != bytes {
            self.other = Some(bytes);
            return false;
        }
        self.take(bytes);
        true
    }

    /// Replaces the text by the content on disk.
    pub fn take(&mut self, bytes: Vec<u8>) {
        (self.text, self.locked) = decoded(&bytes);
        self.saved = bytes;
        self.other = None;
        self.restored = None;
    }

    /// Whether its text is a draft that an earlier window left, and is not saved yet.
    pub fn is_restored(&self) -> bool {
        self.restored.is_some() && self.is_changed()
    }
}

/// Decodes a text. The second value is true if it could not be written back unchanged.
fn decoded(bytes: &[u8]) -> (String, bool) {
    match std::str::from_utf8(bytes) {
        // Binary data is useless as text, and its lines may be very long.
        _ if bytes.contains(&0) => (tr!("exercise-bytes-of-binary-data", count = bytes.len()) + "\n", true),
        Ok(text) => (text.to_owned(), false),
        Err(_) => (String::from_utf8_lossy(bytes).into_owned(), true),
    }
}

/// The pictures that are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureMode {
    /// The student's picture.
    Yours,
    /// The picture of the correct answer.
    Reference,
    /// Both side by side.
    #[default]
    Both,
    /// The difference of both.
    Difference,
}

/// The page beside the editor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExercisePage {
    /// The editor itself, in a narrow window.
    Editor,
    /// The exercise's text.
    #[default]
    Text,
    /// The verdict.
    Verdict,
    /// The meaning of the program's variables.
    Variables,
}

/// How much of a verdict is shown: each step is a further hint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hints {
    /// Whether it is right, and what can be seen in the picture.
    Symptom,
    /// Also the mistakes by name.
    Name,
    /// Also their lines, which are marked in the editor.
    #[default]
    Line,
    /// Also how to fix them.
    Fix,
}

impl Hints {
    /// All steps, each showing more than the one before.
    pub const ALL: [Hints; 4] = [Hints::Symptom, Hints::Name, Hints::Line, Hints::Fix];
}

/// Facts about the pair in the editor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProgramFacts {
    /// Messages about lines.
    pub notes: Vec<Note>,
    /// The reason why the pair cannot be drawn, in one sentence.
    pub unusable: Option<String>,
    /// Warnings about guesses and corrections.
    pub warnings: Vec<String>,
    /// Whether a pair was compiled and can be drawn: this one, or an earlier one.
    pub is_drawn: bool,
    /// Whether the drawn pair is an earlier one, because the one in the editor does not compile.
    pub is_old: bool,
    /// Whether it is being tried outside of the window, because it may crash the driver or never end.
    pub is_tried: bool,
    /// Whether the trial takes so long that it should be announced.
    pub is_trial_slow: bool,
    /// Meaning and value of its variables in the last picture.
    pub variables: Vec<VariableValue>,
}

/// A verdict, with the texts that were checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The verdict, or why there is none.
    pub verdict: Result<Verdict, String>,
    /// [`Work::content`] at the time.
    pub of: Vec<SourceFile>,
}

/// An exercise that is being worked on.
#[derive(Clone, Debug)]
pub struct Work {
    /// The exercise.
    pub exercise: &'static Exercise,
    /// The student's files.
    pub files: Vec<OpenFile>,
    /// The file in the editor.
    pub current: usize,
    /// The pictures that are shown.
    pub shown: PictureMode,
    /// The page beside the editor.
    pub page: ExercisePage,
    /// The scenes of the preview, then the checker's.
    pub scenes: Vec<PreviewScene>,
    /// Index of the current scene.
    pub scene: usize,
    /// The camera.
    pub camera: CameraSettings,
    /// The animation's time.
    pub clock: Clock,
    /// The lamp's way from its place in the scene, in world space: the user may drag it.
    pub lamp_offset: Vec3,
    /// Whether variants of the lab's own solutions are accepted.
    pub as_the_lab: bool,
    /// Facts about the pair in the editor.
    pub program: ProgramFacts,
    /// Number of trials.
    pub trials: u32,
    /// The last verdict.
    pub judged: Option<Judged>,
    /// How much of the verdict is shown.
    pub hints: Hints,
    /// Whether a check is running.
    pub checking: bool,
    /// The line to scroll to: file and line.
    pub jump: Option<(usize, u32)>,
    /// The text of the dialog that asks for a folder to save to, if it is open.
    pub asking: Option<String>,
    /// Files that were open before these, the latest last.
    pub before: Vec<OpenFileSet>,
    /// Whether files are saved as downloads, because there are no folders.
    pub downloads: bool,
    /// Counts the sets of files that were opened.
    pub(super) sets: u64,
}

impl Work {
    /// Starts an exercise with these files, or with its original files if there are none.
    pub fn new(exercise: &'static Exercise, files: Vec<ExerciseFile>) -> Self {
        let opened = |(index, file)| OpenFile::new(exercise, file, (0, index));
        let files: Vec<OpenFile> = match files.is_empty() {
            true => Work::start_files(exercise, 0),
            false => files.into_iter().enumerate().map(opened).collect(),
        };
        let current = Work::first_shown(exercise, &files);
        let scenes = preview::scenes(exercise).into_iter().chain(preview::test_scenes(exercise)).collect();
        let mut work = Work {
            exercise,
            files,
            current,
            shown: if exercise.shows_reference { PictureMode::default() } else { PictureMode::Yours },
            page: ExercisePage::default(),
            scenes,
            scene: 0,
            camera: CameraSettings::default(),
            clock: Clock::default(),
            lamp_offset: Vec3::ZERO,
            as_the_lab: false,
            program: ProgramFacts::default(),
            trials: 0,
            judged: None,
            hints: Hints::default(),
            checking: false,
            jump: None,
            asking: None,
            before: Vec::new(),
            downloads: false,
            sets: 0,
        };
        work.look_at(0);
        work
    }

    /// The exercise's original files, as the set of this number.
    pub(super) fn start_files(exercise: &Exercise, set: u64) -> Vec<OpenFile> {
        let file = |(name, text): (&str, &str)| ExerciseFile { name: name.into(), path: None, bytes: text.into() };
        let opened = |(index, file)| OpenFile::new(exercise, file, (set, index));
        exercise.start_files().map(file).enumerate().map(opened).collect()
    }

    /// The file that is in the editor at first: one with something to do.
    pub(super) fn first_shown(exercise: &Exercise, files: &[OpenFile]) -> usize {
        let answers = if exercise.kind == ExerciseKind::GlProgram { ".txt" } else { ".frag" };
        let is_answer = |file: &OpenFile| file.is_shown() && file.name.ends_with(answers);
        let has_to_do = |file: &OpenFile| file.is_shown() && file.text.contains("TODO");
        let to_do = files.iter().position(|file| is_answer(file) && has_to_do(file));
        let to_do = to_do.or_else(|| files.iter().position(has_to_do)).or_else(|| files.iter().position(is_answer));
        let is_text = |file: &OpenFile| file.is_shown() && !file.locked;
        let first = || files.iter().position(is_text).or_else(|| files.iter().position(OpenFile::is_shown));
        to_do.or_else(first).unwrap_or(0)
    }

    /// The work as it is resumed: nothing is compiled yet.
    pub fn resumed(self) -> Self {
        Work { program: ProgramFacts::default(), checking: false, ..self }
    }

    /// Switches to another scene, with its own camera.
    pub fn look_at(&mut self, scene: usize) {
        self.scene = scene.min(self.scenes.len().saturating_sub(1));
        let Some(scene) = self.scenes.get(self.scene) else { return };
        let eye = scene.eye;
        self.camera = CameraSettings {
            position: eye.position.as_dvec3().to_array(),
            aim: Aim::Target(eye.target.as_dvec3().to_array()),
            up: eye.up.as_dvec3().to_array(),
            fov_y: f64::from(eye.fov_rad).to_degrees(),
            ..CameraSettings::default()
        };
        self.clock = Clock { time: 0.0, playing: scene.swing.length() > 0.0 };
        self.lamp_offset = Vec3::ZERO;
    }

    /// Switches to the checker's scene of this name. Returns whether there is one.
    pub fn look_at_test(&mut self, name: &str) -> bool {
        let index = self.scenes.iter().position(|scene| scene.is_test && scene.name == name);
        index.inspect(|&index| self.look_at(index)).is_some()
    }

    /// Takes a verdict: shows its page, the scene that differs most, and the first line that is named.
    pub fn take_verdict(&mut self, judged: Judged) {
        self.page = ExercisePage::Verdict;
        self.checking = false;
        if let Ok(verdict) = &judged.verdict {
            // Differences of single terms are part of those of whole scenes.
            let differing = || verdict.scenes.iter().filter(|scene| !scene.right);
            let whole = differing().filter(|scene| !scene.scene.ends_with(" alone"));
            let by_share = |a: &&SceneVerdict, b: &&SceneVerdict| a.pixels_beyond.total_cmp(&b.pixels_beyond);
            // Of several that differ as much, the first: the scenes that distinguish most mistakes go first.
            let most = |scenes: Vec<&SceneVerdict>| scenes.into_iter().rev().max_by(by_share).cloned();
            let most = most(whole.collect()).or_else(|| most(differing().collect()));
            if let Some(most) = most {
                self.look_at_test(&most.scene);
            }
        }
        self.judged = Some(judged);
        self.go_to_first_line();
    }

    /// Shows the first line that the verdict names, if the hints tell it.
    pub fn go_to_first_line(&mut self) {
        let Some(Judged { verdict: Ok(verdict), .. }) = &self.judged else { return };
        let of_mistake = verdict.mistakes.iter().filter(|_| self.hints >= Hints::Line);
        let of_mistake = of_mistake.filter_map(|mistake| Some((mistake.file.clone()?, mistake.line?)));
        let of_compiler = verdict.messages.iter().filter_map(|message| Some((message.file.clone(), message.line?)));
        if let Some((file, line)) = of_compiler.chain(of_mistake).next() {
            self.go_to(&file, line);
        }
    }

    /// The lamp's place at this moment, in world space; `None` in scenes without a lamp.
    pub fn lamp(&self) -> Option<Vec3> {
        let scene = self.scene().filter(|scene| scene.has_lamp)?;
        Some(scene.values.light.position + scene.swing * (self.clock.time as f32).sin() + self.lamp_offset)
    }

    /// Whether anything changes with the time: the lamp swings, or the program reads the time.
    pub fn moves(&self) -> bool {
        let is_time =
            |variable: &VariableValue| variable.role.as_ref().is_some_and(|(role, _)| *role == Role::Time.to_string());
        self.scene().is_some_and(|scene| scene.swing.length() > 0.0) || self.program.variables.iter().any(is_time)
    }

    /// The current scene.
    pub fn scene(&self) -> Option<&PreviewScene> {
        self.scenes.get(self.scene)
    }

    /// All files as they are in the editor.
    pub fn content(&self) -> Vec<SourceFile> {
        self.files.iter().map(|file| SourceFile::new(file.name.clone(), file.content())).collect()
    }

    /// Whether any file has unsaved changes.
    pub fn is_changed(&self) -> bool {
        self.files.iter().any(OpenFile::is_changed)
    }

    /// Whether the files have changed since the last check.
    pub fn is_judged_before(&self) -> bool {
        self.judged.as_ref().is_some_and(|judged| judged.of != self.content())
    }

    /// The index of a file by its name.
    pub fn file_named(&self, name: &str) -> Option<usize> {
        self.files.iter().position(|file| file.name == name)
    }

    /// Shows a line of a file.
    pub fn go_to(&mut self, file: &str, line: u32) {
        if let Some(index) = self.file_named(file) {
            self.current = index;
            self.jump = Some((index, line));
        }
    }

    /// The marked lines of a file, by compilers and by the last check if the texts have not changed since.
    pub fn marks(&self, file: usize) -> Vec<Mark> {
        let Some(file) = self.files.get(file) else { return Vec::new() };
        let notes = self.program.notes.iter().filter(|note| note.message.file == file.name).map(|note| {
            let message = &note.message;
            let help = message.explanation.as_ref().map_or(String::new(), |help| format!("\n{help}"));
            let severity = if note.kind == NoteKind::Error { MarkKind::Error } else { MarkKind::Warning };
            Mark { line: message.line.unwrap_or(1), kind: severity, text: format!("{}{help}", message.text) }
        });
        let mut marks: Vec<Mark> = notes.collect();
        if let Some(Judged { verdict: Ok(verdict), .. }) = self.judged.as_ref().filter(|_| !self.is_judged_before()) {
            let of_file = |mistake: &&FoundMistake| mistake.file.as_ref() == Some(&file.name);
            for mistake in verdict.mistakes.iter().filter(of_file).filter(|_| self.hints >= Hints::Line) {
                let text = match self.hints {
                    Hints::Fix => format!("{}\n{}", mistake.name, mistake.fix),
                    _ => mistake.name.clone(),
                };
                marks.extend(mistake.line.map(|line| Mark { line, kind: MarkKind::Mistake, text }));
            }
            let known = |line: u32, marks: &[Mark]| marks.iter().any(|mark| mark.line == line);
            for message in verdict.messages.iter().filter(|message| message.file == file.name) {
                if let Some(line) = message.line.filter(|&line| !known(line, &marks)) {
                    marks.push(Mark { line, kind: MarkKind::Error, text: message.text.clone() });
                }
            }
        }
        marks.sort_by_key(|mark| mark.line);
        marks
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_exercises::exercise;

    fn file(text: &str) -> OpenFile {
        opened(text.into())
    }

    fn opened(bytes: Vec<u8>) -> OpenFile {
        let ex04 = exercise::find("ex04").unwrap();
        OpenFile::new(ex04, ExerciseFile { name: "a.vert".into(), path: None, bytes }, (0, 0))
    }

    #[test]
    fn a_reload_never_overwrites_unsaved_text() {
        let mut file = file("one");
        assert!(file.reload(b"two".to_vec()), "without changes here, the version on disk is loaded");
        assert_eq!((file.text.as_str(), file.is_changed()), ("two", false));
        file.text = "mine".into();
        assert!(!file.reload(b"three".to_vec()));
        assert_eq!((file.text.as_str(), file.other.as_deref()), ("mine", Some(&b"three"[..])));
        file.take(b"three".to_vec());
        assert_eq!((file.text.as_str(), file.other), ("three", None));
    }

    #[test]
    fn binary_files_are_locked_and_unchanged() {
        let bytes = b"// caf\xe9".to_vec();
        let file = opened(bytes.clone());
        assert!(file.locked && !file.is_changed());
        assert_eq!(file.content(), bytes);
        let floats = opened([0.5_f32, -1.0].iter().flat_map(|number| number.to_le_bytes()).collect());
        assert!(floats.locked && floats.content().len() == 8);
        assert_eq!(floats.text, "8 bytes of binary data.\n");
    }

    #[test]
    fn without_files_the_original_ones_are_opened() {
        let work = Work::new(exercise::find("ex04").unwrap(), Vec::new());
        let shown: Vec<&str> = work.files.iter().filter(|f| f.is_shown()).map(|f| f.name.as_str()).collect();
        assert_eq!(shown, ["start.frag", "start.vert"]);
        assert_eq!(work.files[work.current].name, "start.frag");
        // ex01 has nothing to do in its fragment shader, and ex11 has no shaders.
        for (id, end) in [("ex01", "start.vert"), ("ex11", ".txt")] {
            let work = Work::new(exercise::find(id).unwrap(), Vec::new());
            assert!(work.files[work.current].name.ends_with(end), "{}", work.files[work.current].name);
        }
        assert!(!work.is_changed() && !work.scenes.is_empty());
    }
}
