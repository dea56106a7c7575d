//! The proposed fix of a verdict as an edit of the editor.

use super::document::OpenDocument;
use super::positions::Lines;
use super::sources::Sources;
use super::uri::uri_of_path;
use gonio_check::proposed_fix::applied;
use gonio_check::source_problems::SourceRenaming;
use gonio_check::verdict::ProposedEdit;
use lsp_types::{
    DocumentChanges, OneOf, OptionalVersionedTextDocumentIdentifier, Range, TextDocumentEdit, TextEdit, Uri,
    WorkspaceEdit,
};
use std::collections::{BTreeMap, BTreeSet};

/// The edit that applies all of a verdict's changes; `None` if a text is no longer the one that was checked. With
/// `has_versions` it names the versions of documents, so that the editor refuses it once they have changed.
pub fn workspace_edit(
    edits: &[ProposedEdit],
    sources: &Sources,
    open: &BTreeMap<String, OpenDocument>,
    has_versions: bool,
) -> Option<WorkspaceEdit> {
    let names: BTreeSet<&str> = edits.iter().map(|edit| edit.file.as_str()).collect();
    let mut changes: Vec<(Uri, Option<i32>, TextEdit)> = Vec::new();
    for name in names {
        let path = sources.folder.as_ref()?.join(name);
        let document = open.values().find(|document| document.path.as_ref() == Some(&path));
        let (uri, version, text) = match document {
            Some(document) => (document.uri.clone(), Some(document.version), document.text.clone()),
            None => (uri_of_path(&path)?, None, std::fs::read_to_string(&path).ok()?),
        };
        let edit = difference(&text, &applied(edits, name, &text)?);
        changes.push((uri, version, edit));
    }
    in_protocol(changes, has_versions)
}

/// Edits of documents with their versions.
fn in_protocol(changes: Vec<(Uri, Option<i32>, TextEdit)>, has_versions: bool) -> Option<WorkspaceEdit> {
    Some(match has_versions {
        true => {
            let edit = |(uri, version, edit)| TextDocumentEdit {
                text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
                edits: vec![OneOf::Left(edit)],
            };
            let edits = changes.into_iter().map(edit).collect();
            WorkspaceEdit { document_changes: Some(DocumentChanges::Edits(edits)), ..WorkspaceEdit::default() }
        }
        false => {
            let edit = |(uri, _, edit): (Uri, _, TextEdit)| (uri.as_str().to_owned(), serde_json::json!([edit]));
            let edits: serde_json::Map<String, serde_json::Value> = changes.into_iter().map(edit).collect();
            serde_json::from_value(serde_json::json!({ "changes": edits })).ok()?
        }
    })
}

/// The edit that replaces a misspelt name in a document.
pub fn renaming_edit(renaming: &SourceRenaming, document: &OpenDocument, has_versions: bool) -> Option<WorkspaceEdit> {
    let range = Lines::new(&document.text).range(renaming.start, renaming.end);
    let edit = TextEdit { range, new_text: renaming.name.clone() };
    in_protocol(vec![(document.uri.clone(), Some(document.version), edit)], has_versions)
}

/// One edit from a text to another: the lines between those that both have.
fn difference(old: &str, new: &str) -> TextEdit {
    let [olds, news] = [old, new].map(|text| text.split_inclusive('\n').collect::<Vec<&str>>());
    let start = olds.iter().zip(&news).take_while(|(a, b)| a == b).count();
    let most = olds.len().min(news.len()) - start;
    let end = olds.iter().rev().zip(news.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    let line = |index: usize| u32::try_from(index + 1).unwrap_or(u32::MAX);
    let lines = Lines::new(old);
    let last = match olds.len() - end {
        // The last line may have no end.
        all if all == olds.len() => lines.position([u32::MAX, u32::MAX]),
        index => lines.position([line(index), 1]),
    };
    let range = Range::new(lines.position([line(start), 1]), last);
    TextEdit { range, new_text: news[start..news.len() - end].concat() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsp_types::Position;

    #[test]
    fn the_difference_is_the_lines_that_change() {
        for (old, new, (from, to), text) in [
            ("a\nb\nc\n", "a\nB\nc\n", ((1, 0), (2, 0)), "B\n"),
            ("a\r\nb\r\n", "a\r\nx\r\nb\r\n", ((1, 0), (1, 0)), "x\r\n"),
            ("a\nb\nc", "a\nc", ((1, 0), (2, 0)), ""),
            ("a\nbé😀", "a\nB", ((1, 0), (1, 4)), "B"),
            ("a", "a\nb\n", ((0, 0), (0, 1)), "a\nb\n"),
        ] {
            let position = |(line, character)| Position::new(line, character);
            let edit = TextEdit { range: Range::new(position(from), position(to)), new_text: text.to_owned() };
            assert_eq!(difference(old, new), edit, "{old:?}");
        }
    }
}
