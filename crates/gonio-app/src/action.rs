//! Requests that are not a change of the document.

use crate::document::PaneOverlay;
use crate::saving::Product;
use crate::session::Tab;
use gonio_language::Language;
use gonio_scene::SpecialView;

/// A request by a widget, a key or a menu; [`crate::App`] carries it out after the panels were shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Opens inputs: `builtin:NAME`, or files.
    Open(Vec<String>),
    /// Opens files by their paths.
    OpenPaths(Vec<String>),
    /// Shows the file dialog, and opens the chosen files.
    ChooseFiles,
    /// Shows the save dialog, and saves.
    Save(Product),
    /// Saves to a path.
    SaveTo(Product, String),
    /// Shows a line (from 1) of a file in the panel of files.
    ShowLine(String, u64),
    /// Copies the current pane's picture to the clipboard.
    CopyPicture,
    /// Copies a link with the scene in it to the clipboard.
    CopyLink,
    /// Copies a text to the clipboard.
    CopyText(String),
    /// Shows all texts in this language.
    SetLanguage(Language),
    /// Undoes a step.
    Undo,
    /// Redoes a step.
    Redo,
    /// Frames all objects.
    Frame,
    /// Plays or pauses.
    PlayOrPause,
    /// Sets the time, in seconds.
    SetTime(f64),
    /// Shows this tab of the side panel.
    Show(Tab),
    /// Switches between the probe and the lights.
    ToggleProbe,
    /// Shows or hides the observer's view.
    ToggleObserver,
    /// Shows or hides an overlay of the current pane.
    Overlay(PaneOverlay),
    /// Switches a special view of the current pane.
    Special(SpecialView),
    /// Switches between the traced picture and OpenGL's in the current pane.
    ToggleTruth,
    /// Shows or hides the ground below the objects.
    ToggleGround,
    /// Shows or hides the keyboard shortcuts.
    ToggleHelp,
    /// Switches between the light and the dark theme.
    ToggleTheme,
    /// Records the OpenGL calls of the current pane's picture.
    RecordFrame,
    /// Shows the BRDF bench.
    ShowBench,
    /// Shows the stations beyond the rendering equation.
    ShowStations,
    /// Shows the gallery.
    ShowGallery,
    /// Shows the settings of baking.
    ShowBake,
    /// Hides them, and the atlas.
    CloseBake,
    /// Bakes textures.
    StartBake,
    /// Cancels the bake at work.
    CancelBake,
    /// Shows the panel of the environment.
    ShowEnvironment,
    /// Hides it.
    CloseEnvironment,
    /// Repairs the environment.
    RepairEnvironment,
    /// Shows the open exercise, or the list of exercises.
    ShowExercise,
    /// Shows the list of exercises.
    ListExercises,
    /// Starts the exercise with this id.
    StartExercise(String),
    /// Closes the user's own shaders.
    CloseShaders,
    /// Dismisses a message.
    Dismiss(u64),
    /// Restores the edited scene that another one has replaced.
    RestoreScene,
    /// Restores the edits that an earlier window left of this scene.
    RestoreDraft,
    /// Discards them.
    DiscardDraft,
    /// Turns all STL models so that their z axis points up.
    TurnZUp,
    /// Dismisses all messages.
    DismissAll,
    /// Shows all messages, or only the newest.
    ExpandMessages,
}
