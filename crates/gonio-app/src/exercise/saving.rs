//! The student's files on disk: saved, and read again.

use super::editor;
use super::work::{OpenFile, Work};
use crate::files;
use crate::platform::Platform;
use egui::Context;
use gonio_language::tr;
use gonio_scene::files::{Disk, FileBytes, FileSource};
use std::path::PathBuf;

/// Most bytes of a student's file that is read again.
const MOST_BYTES: u64 = 32 << 20;

/// Saves the changed files: those on disk in place, those in memory to a folder that the user names. Returns a sentence
/// for each file that could not be saved.
pub fn save(work: &mut Work, platform: &mut dyn Platform) -> Vec<String> {
    let in_memory = work.files.iter().all(|file| file.path.is_none());
    let mut failures = Vec::new();
    if platform.has_folders() && work.files.iter().any(|file| file.path.is_none() && (in_memory || file.is_changed())) {
        // The proposed folder is that of the files that have one.
        let beside = work.files.iter().find_map(|file| Some(file.path.as_ref()?.parent()?.display().to_string()));
        work.asking = Some(beside.unwrap_or_else(|| work.exercise.id.clone()));
        if in_memory {
            return failures;
        }
    }
    let current = work.current;
    for (index, file) in work.files.iter_mut().enumerate() {
        // A file that changed on disk is not overwritten before the user has chosen a version.
        if file.locked || file.other.is_some() || !(file.is_changed() || (in_memory && index == current)) {
            continue;
        }
        let bytes = file.text.clone().into_bytes();
        let place = match &file.path {
            Some(path) => path.to_string_lossy(),
            None if platform.has_folders() => continue,
            // A download has no folders.
            None => file.name.rsplit('/').next().unwrap_or_default().into(),
        };
        match platform.write(&place, &bytes) {
            Ok(_) => file.saved = bytes,
            Err(error) => failures.push(error),
        }
    }
    failures
}

/// Saves files in memory to a folder, which is created if needed; nothing is overwritten. If other files
/// have a path already, unchanged ones stay in memory.
pub fn save_into(work: &mut Work, folder: &str, platform: &mut dyn Platform) -> Vec<String> {
    let folder = PathBuf::from(folder);
    let place = |name: &str| folder.join(name);
    let in_memory = work.files.iter().all(|file| file.path.is_none());
    let is_meant = |file: &OpenFile| file.path.is_none() && (in_memory || file.is_changed());
    if let Some(file) = work.files.iter().find(|file| is_meant(file) && place(&file.name).exists()) {
        return vec![tr!("exercise-already-exists-choose-another-folder", name = place(&file.name).display())];
    }
    for file in work.files.iter_mut().filter(|file| is_meant(file)) {
        let path = place(&file.name);
        let made = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        if let Err(error) = made {
            return vec![tr!("exercise-could-not-be-created", folder = folder.display(), error = error)];
        }
        let bytes = file.content();
        match platform.write(&path.to_string_lossy(), &bytes) {
            Ok(_) => (file.saved, file.path) = (bytes, Some(path)),
            Err(error) => return vec![error],
        }
    }
    Vec::new()
}

/// Reloads files that another program changed. Returns a sentence for each that could not be read.
pub fn read_again(ctx: &Context, work: &mut Work, paths: &[PathBuf]) -> Vec<String> {
    let mut failures = Vec::new();
    for file in &mut work.files {
        let Some(path) = file.path.as_ref().filter(|path| paths.contains(path)) else { continue };
        match Disk.read_within(path, MOST_BYTES).map(FileBytes::into_vec) {
            Ok(bytes) => {
                let before = file.clone();
                if file.reload(bytes) {
                    editor::remember(ctx, &before);
                }
            }
            Err(error) => failures.push(tr!("exercise-could-not-be-reloaded", path = path.display(), error = error)),
        }
    }
    failures
}

/// The original files of the exercise as a zip file.
pub fn start_files(work: &Work) -> Vec<u8> {
    let texts = work.exercise.start_files().map(|(name, text)| (name, text.as_bytes()));
    files::pack(&texts.chain(work.exercise.pictures()).collect::<Vec<_>>())
}
