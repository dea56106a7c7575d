//! Commands of the exercise view: pushed by widgets and keys, applied after the frame is laid out.

/// A command of the exercise view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Command {
    /// Begin an exercise: its word.
    Begin(String),
    /// The list of exercises.
    List,
    /// Back to the scene.
    Leave,
    /// Check what is in the editor.
    Check,
    /// No longer wait for the check.
    StopChecking,
    /// Open files in place of these.
    Open,
    /// The files that were open before these.
    PutBack,
    /// The files to start from in place of these.
    BeginAgain,
    /// The files to start from, handed out as they are.
    StartFiles,
    /// Save the files that were changed.
    Save,
    /// Save the files that are in memory into this folder.
    SaveInto(String),
    /// A step back in the current file.
    Undo,
    /// A step forth in the current file.
    Redo,
    /// The current file as it is on the disk.
    TakeOther(usize),
    /// The file as it is in the editor, also on the disk.
    KeepMine(usize),
    /// The saved texts in place of the drafts that were restored.
    DiscardRestored,
    /// The drafts stay; the note about them goes.
    KeepRestored,
    /// Switches between the light and the dark theme.
    Theme,
}
