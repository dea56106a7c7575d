//! What is asked for that is not a change of the document.

use crate::document::Overlay;
use crate::saving::Product;
use crate::session::Tab;
use gonio_scene::SpecialView;

/// Asked for by a widget, a key or a menu; done by [`crate::App`] after the panels were shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Opens what the inputs name: `builtin:NAME`, or files.
    Open(Vec<String>),
    /// Opens files that a person named.
    OpenPaths(Vec<String>),
    /// Asks for files, and opens them.
    ChooseFiles,
    /// Asks where to save, and saves.
    Save(Product),
    /// Saves to a place.
    SaveTo(Product, String),
    /// Puts the current pane's picture on the clipboard.
    CopyPicture,
    /// Puts a link that carries the scene on the clipboard.
    CopyLink,
    /// Puts a text on the clipboard.
    CopyText(String),
    /// One step back.
    Undo,
    /// One step forth.
    Redo,
    /// Moves the camera until all objects are in the picture.
    Frame,
    /// Lets time run, or stops it.
    PlayOrPause,
    /// The time, seconds.
    SetTime(f64),
    /// Shows this tab of the panel at the side.
    Show(Tab),
    /// Shows the probe's tab, or the lights' again.
    ToggleProbe,
    /// Shows or hides the camera from outside.
    ToggleObserver,
    /// Lays something over the current pane's picture, or takes it away.
    Overlay(Overlay),
    /// Shows a special view in the current pane, or no longer.
    Special(SpecialView),
    /// Shows or hides the list of keys.
    ToggleHelp,
    /// Light or dark.
    ToggleTheme,
    /// Records what OpenGL is told for the current pane's picture.
    RecordFrame,
    /// Shows the laboratory: the exercises, or the one that is worked on.
    ShowExercise,
    /// Shows the laboratory's list of exercises.
    ListExercises,
    /// Begins an exercise in the laboratory: its word.
    StartExercise(String),
    /// A message was read.
    Dismiss(u64),
}
