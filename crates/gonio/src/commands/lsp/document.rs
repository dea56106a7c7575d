//! Open documents.

use lsp_types::Uri;
use std::path::PathBuf;

/// A document that the editor has open; its text precedes the file's.
#[derive(Clone, Debug)]
pub struct OpenDocument {
    /// The editor's own URI.
    pub uri: Uri,
    /// Its path, if it is a file.
    pub path: Option<PathBuf>,
    /// The editor's version of the text.
    pub version: i32,
    /// The text.
    pub text: String,
}

impl OpenDocument {
    /// Its name, for messages and to find its stage.
    pub fn name(&self) -> String {
        let path = self.path.as_ref().and_then(|path| path.file_name()).map(|name| name.to_string_lossy().into_owned());
        path.unwrap_or_else(|| self.uri.as_str().rsplit(['/', ':']).next().unwrap_or_default().to_owned())
    }
}
