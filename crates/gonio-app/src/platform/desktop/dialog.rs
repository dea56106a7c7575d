//! The system's file dialogs.
//!
//! On Linux these are other programs (zenity of GNOME, kdialog of KDE), because the crate for their D-Bus service would add an
//! async runtime and thirty crates. Without either program the window shows a path field.

use super::{Access, open};
use crate::platform::{Event, FileDialog, Purpose};
use crate::saving::Product;
use std::sync::mpsc::Sender;

/// Shows the dialog for opening files.
pub fn open(purpose: Purpose, access: Access, sender: Sender<Event>, ctx: &egui::Context) -> FileDialog {
    let inner = ctx.clone();
    ask(Question::Open, ctx, move |paths| {
        if !paths.is_empty() {
            open::in_thread(paths, purpose, access, sender, &inner);
        }
    })
}

/// Shows the dialog for saving.
pub fn save(product: Product, name: &str, sender: Sender<Event>, ctx: &egui::Context) -> FileDialog {
    ask(Question::Save(name.to_owned()), ctx, move |paths| {
        if let Some(path) = paths.into_iter().next() {
            // The window may be closed by now.
            let _ = sender.send(Event::SaveTo(product, path));
        }
    })
}

enum Question {
    Open,
    /// Saving, with a proposed name.
    Save(String),
}

#[cfg(not(any(windows, target_os = "macos")))]
fn ask(question: Question, ctx: &egui::Context, answer: impl FnOnce(Vec<String>) + Send + 'static) -> FileDialog {
    use std::process::{Command, Stdio};
    let Some((program, is_zenity)) =
        [("zenity", true), ("kdialog", false)].into_iter().find(|(name, _)| is_there(name))
    else {
        return FileDialog::Unavailable;
    };
    let mut command = Command::new(program);
    match (&question, is_zenity) {
        (Question::Open, true) => command.args(["--file-selection", "--multiple", "--separator=\n", "--title=Open"]),
        (Question::Save(name), true) => command
            .args(["--file-selection", "--save", "--confirm-overwrite", "--title=Save"])
            .arg(format!("--filename={name}")),
        (Question::Open, false) => command.args(["--getopenfilename", ".", "--multiple", "--separate-output"]),
        (Question::Save(name), false) => command.args(["--getsavefilename", name.as_str()]),
    };
    command.stdin(Stdio::null()).stderr(Stdio::null());
    let ctx = ctx.clone();
    std::thread::spawn(move || {
        // The output is empty if the dialog was cancelled or could not be shown.
        let output = command.output().map(|finished| finished.stdout).unwrap_or_default();
        let output = String::from_utf8_lossy(&output);
        answer(output.lines().filter(|line| !line.is_empty()).map(str::to_owned).collect());
        ctx.request_repaint();
    });
    FileDialog::Opened
}

/// Whether a program is in PATH.
#[cfg(not(any(windows, target_os = "macos")))]
fn is_there(program: &str) -> bool {
    std::env::var_os("PATH")
        .is_some_and(|path| std::env::split_paths(&path).any(|folder| folder.join(program).is_file()))
}

#[cfg(any(windows, target_os = "macos"))]
fn ask(question: Question, ctx: &egui::Context, answer: impl FnOnce(Vec<String>) + Send + 'static) -> FileDialog {
    let text = |path: std::path::PathBuf| path.to_string_lossy().into_owned();
    let run = move || match question {
        Question::Open => rfd::FileDialog::new().pick_files().unwrap_or_default().into_iter().map(text).collect(),
        Question::Save(name) => rfd::FileDialog::new().set_file_name(name).save_file().into_iter().map(text).collect(),
    };
    if cfg!(target_os = "macos") {
        // macOS shows dialogs on the window's thread only.
        answer(run());
        ctx.request_repaint();
    } else {
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            answer(run());
            ctx.request_repaint();
        });
    }
    FileDialog::Opened
}
