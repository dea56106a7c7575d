//! The shaders that belong to a document: the pair of its exercise's folder, or the document alone.

use super::document::OpenDocument;
use crate::commands::lab::intake;
use gonio_check::source_problems::{SourceProblem, SourceStage, pair_problems};
use gonio_check::submission::{self, SourceFile, StageText, Submission};
use gonio_exercises::exercise::{Exercise, ExerciseKind};
use gonio_exercises::preview::SubmittedPair;
use gonio_exercises::{content_hash, exercise_of_folder};
use gonio_glsl::{Severity, Stage};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Folders above a file that are tried.
const MOST_FOLDERS: usize = 6;
/// States the exercise, and the roles of variables.
const NAMES: &str = "names.toml";
/// Larger files are no shaders.
const MOST_BYTES: usize = 1 << 20;

/// Files of folders, as they were when they were last read.
#[derive(Default)]
pub struct FolderCache(HashMap<PathBuf, Vec<SourceFile>>);

impl FolderCache {
    /// Reads folders again when they are next asked for.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    fn read(&mut self, folder: &Path) -> &[SourceFile] {
        self.0.entry(folder.to_owned()).or_insert_with(|| {
            let mut files = intake::read(&[folder.to_owned()]).unwrap_or_default();
            files.retain(|file| file.bytes.len() <= MOST_BYTES);
            files
        })
    }
}

/// The shaders of a document, and what gonio's own front end finds in them.
#[derive(Clone)]
pub struct Sources {
    /// The same for all documents of a pair.
    pub key: String,
    /// A hash of everything that a check depends on.
    pub content: u64,
    /// The exercise, if a check is possible.
    pub exercise: Option<&'static Exercise>,
    /// The folder of the files.
    pub folder: Option<PathBuf>,
    /// The submission.
    pub files: Vec<SourceFile>,
    /// The name of the pair, if there are several.
    pub pair: Option<String>,
    /// The pair, if the exercise has one.
    pub submitted: Option<SubmittedPair>,
    /// The shaders with their stages.
    pub texts: Vec<(Stage, StageText)>,
    /// Problems by file and line.
    pub problems: Vec<SourceProblem>,
    /// The reason why there is no pair for the exercise, in one sentence.
    pub complaint: Option<String>,
}

impl Sources {
    /// Finds the shaders of a document.
    pub fn of(
        document: &OpenDocument,
        open: &BTreeMap<String, OpenDocument>,
        stated: Option<&'static Exercise>,
        folders: &mut FolderCache,
    ) -> Sources {
        let place = document.path.as_deref().and_then(|path| Some((path, located(path, stated)?)));
        let Some((path, (top, exercise))) = place else { return Sources::alone(document) };
        if !matches!(exercise.kind, ExerciseKind::Shaders | ExerciseKind::Faces) {
            return Sources::alone(document);
        }
        let mut complaint = None;
        for folder in path.ancestors().skip(1).take_while(|folder| folder.starts_with(&top)) {
            let mut files = with_documents(folder, folders.read(folder), open);
            files.extend(names_above(folder, &top, &files));
            let name = name_in(folder, path);
            match pair_with(exercise, &files, &name) {
                Ok(Some((submitted, pair))) => return Sources::of_pair(exercise, folder, files, submitted, pair),
                // A shader of something else in the folder, such as a skybox.
                Ok(None) => return Sources::alone(document),
                Err(why) => complaint = Some(why),
            }
        }
        Sources { complaint, ..Sources::alone(document) }
    }

    fn of_pair(
        exercise: &'static Exercise,
        folder: &Path,
        files: Vec<SourceFile>,
        submitted: SubmittedPair,
        pair: Option<String>,
    ) -> Sources {
        let texts = [Stage::Vertex, Stage::Fragment].map(|stage| (stage, submitted.text(stage).clone()));
        let names = [exercise.id.as_str(), pair.as_deref().unwrap_or_default()];
        let parts = files.iter().flat_map(|file| [file.name.as_bytes(), &file.bytes]);
        Sources {
            key: [&*folder.to_string_lossy(), &texts[0].1.file, &texts[1].1.file].join("\n"),
            content: content_hash(names.iter().map(|name| name.as_bytes()).chain(parts)),
            exercise: Some(exercise),
            folder: Some(folder.to_owned()),
            problems: submitted.source_problems(),
            files,
            pair,
            submitted: Some(submitted),
            texts: texts.into(),
            complaint: None,
        }
    }

    /// A document without an exercise: one stage, or both in one file.
    fn alone(document: &OpenDocument) -> Sources {
        let name = document.name();
        let file = SourceFile::new(&name, document.text.as_bytes());
        let texts = match Submission::gather(vec![file.clone()]) {
            Ok(both) => vec![(Stage::Vertex, both.vertex), (Stage::Fragment, both.fragment)],
            Err(_) => {
                let text = document.text.replace("\r\n", "\n").replace('\r', "\n");
                let stage = submission::stage_of(&name, &text).unwrap_or(Stage::Fragment);
                vec![(stage, StageText::whole(&name, text))]
            }
        };
        let stages: Vec<SourceStage<'_>> = texts.iter().map(|(stage, text)| SourceStage::new(text, *stage)).collect();
        let problems = match stages.as_slice() {
            [vertex, fragment] => pair_problems(vertex, fragment),
            _ if document.text.trim().is_empty() => Vec::new(),
            stages => stages.iter().flat_map(SourceStage::problems).collect(),
        };
        Sources {
            key: document.uri.as_str().to_owned(),
            content: content_hash(std::iter::once(document.text.as_bytes())),
            exercise: None,
            folder: document.path.as_ref().and_then(|path| path.parent()).map(Path::to_owned),
            files: vec![file],
            pair: None,
            submitted: None,
            problems,
            texts,
            complaint: None,
        }
    }

    /// Whether gonio's own front end rejects a shader.
    pub fn has_errors(&self) -> bool {
        self.problems.iter().any(|problem| problem.severity == Severity::Error)
    }

    /// The name of a document in the submission.
    pub fn name_of(&self, document: &OpenDocument) -> String {
        match (&self.submitted, &self.folder, &document.path) {
            (Some(_), Some(folder), Some(path)) => name_in(folder, path),
            _ => document.name(),
        }
    }
}

/// The nearest folder around a file that is for an exercise, and the exercise; with a stated one, the file's own folder.
fn located(file: &Path, stated: Option<&'static Exercise>) -> Option<(PathBuf, &'static Exercise)> {
    if let Some(exercise) = stated {
        return Some((file.parent()?.to_owned(), exercise));
    }
    file.ancestors().skip(1).take(MOST_FOLDERS).find_map(|folder| {
        let text = |name: &str| small_file(&folder.join(name));
        let name = folder.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
        let found = exercise_of_folder(&name, text(NAMES).as_deref(), text("text.md").as_deref())?;
        Some((folder.to_owned(), found))
    })
}

/// The pair that a file belongs to, and its name if it is not the one that the exercise prefers. `None` if the file is in no pair.
///
/// # Errors
/// The reason why there is no pair, in one sentence.
fn pair_with(
    exercise: &Exercise,
    files: &[SourceFile],
    name: &str,
) -> Result<Option<(SubmittedPair, Option<String>)>, String> {
    let contains = |pair: &SubmittedPair| [Stage::Vertex, Stage::Fragment].iter().any(|s| pair.text(*s).has_file(name));
    let preferred = SubmittedPair::gather(exercise, files.to_vec())?;
    if contains(&preferred) {
        return Ok(Some((preferred, None)));
    }
    let chosen = SubmittedPair::gather_choosing(exercise, files.to_vec(), Some(name)).ok().filter(contains);
    Ok(chosen.map(|pair| (pair, Some(name.to_owned()))))
}

/// The `names.toml` of a folder above, up to that of the exercise, for a folder without one.
fn names_above(folder: &Path, top: &Path, files: &[SourceFile]) -> Option<SourceFile> {
    let is_names = |file: &SourceFile| file.name == NAMES || file.name.ends_with("/names.toml");
    if files.iter().any(is_names) {
        return None;
    }
    let above = folder.ancestors().skip(1).take_while(|above| above.starts_with(top));
    above.filter_map(|above| small_file(&above.join(NAMES))).map(|text| SourceFile::new(NAMES, text)).next()
}

/// The text of a small ordinary file.
fn small_file(path: &Path) -> Option<String> {
    let is_small = path.metadata().is_ok_and(|found| found.is_file() && found.len() <= MOST_BYTES as u64);
    if is_small { std::fs::read_to_string(path).ok() } else { None }
}

/// The name of a file in its folder.
fn name_in(folder: &Path, path: &Path) -> String {
    path.strip_prefix(folder).unwrap_or(path).to_string_lossy().replace('\\', if cfg!(windows) { "/" } else { "\\" })
}

/// The files of a folder with the texts of open documents.
fn with_documents(folder: &Path, files: &[SourceFile], open: &BTreeMap<String, OpenDocument>) -> Vec<SourceFile> {
    let mut files = files.to_vec();
    for document in open.values() {
        let Some(path) = document.path.as_deref().filter(|path| path.starts_with(folder)) else { continue };
        let name = name_in(folder, path);
        let bytes = document.text.clone().into_bytes();
        match files.iter_mut().find(|file| file.name == name) {
            Some(file) => file.bytes = bytes,
            None => files.push(SourceFile { name, bytes }),
        }
    }
    files
}
