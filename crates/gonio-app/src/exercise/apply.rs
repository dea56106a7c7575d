//! Application of commands to the open exercise.

use super::check::Check;
use super::command::Command;
use super::compiler::Compiler;
use super::work::Work;
use super::{editor, saving};
use crate::platform::Platform;
use egui::Context;
use std::path::PathBuf;

/// Applies a command to the open exercise. Returns a sentence for each thing that failed.
pub fn apply(
    ctx: &Context,
    command: Command,
    work: &mut Work,
    compiler: &mut Compiler,
    check: &mut Check,
    platform: &mut dyn Platform,
) -> Vec<String> {
    let current = work.current;
    match command {
        Command::Check => check.start(ctx, work, platform),
        Command::StopChecking => check.stop(work),
        Command::Save => {
            let failures = saving::save(work, platform);
            if work.asking.is_some() {
                editor::let_go(ctx, work);
            }
            return failures;
        }
        Command::SaveInto(folder) => return saving::save_into(work, &folder, platform),
        Command::Undo | Command::Redo => {
            if let Some(file) = work.files.get_mut(current) {
                editor::step(ctx, file, command == Command::Redo);
            }
        }
        Command::TakeOther(index) => {
            if let Some(file) = work.files.get_mut(index)
                && let Some(other) = file.other.take()
            {
                editor::remember(ctx, file);
                file.take(other);
            }
        }
        Command::KeepMine(index) => {
            if let Some(file) = work.files.get_mut(index) {
                // The version on disk is what changes are compared with.
                if let Some(other) = file.other.take() {
                    file.saved = other;
                }
                return saving::save(work, platform);
            }
        }
        Command::DiscardRestored => {
            for file in work.files.iter_mut().filter(|file| file.is_restored() && file.other.is_none()) {
                editor::remember(ctx, file);
                file.take(file.saved.clone());
            }
        }
        Command::KeepRestored => work.files.iter_mut().for_each(|file| file.restored = None),
        Command::PutBack => {
            work.put_back();
            compiler.begin_anew();
            // They were not watched while they were put away.
            let paths: Vec<PathBuf> = work.files.iter().filter_map(|file| file.path.clone()).collect();
            return saving::read_again(ctx, work, &paths);
        }
        Command::BeginAgain => {
            work.begin_again();
            compiler.begin_anew();
        }
        Command::StartFiles => {
            let name = format!("{}.zip", work.exercise.id);
            return platform.write(&name, &saving::start_files(work)).err().into_iter().collect();
        }
        // These concern the application: see `ExerciseView::apply`.
        Command::Begin(_) | Command::List | Command::Leave | Command::Open | Command::Theme => {}
    }
    Vec::new()
}
