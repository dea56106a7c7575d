//! Parses a document into a tree: elements in one array, texts as slices of the file.
//!
//! Nothing here recurses, entities that a document defines are errors, and the tree takes memory proportional to the
//! file, so deep nesting and entity expansion do no harm.

use crate::text::{LineIndex, quote};
use crate::{Limits, ReadError};
use quick_xml::Reader;
use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesStart, Event};
use std::borrow::Cow;

/// Most levels of nested elements.
const DEEPEST: usize = 512;

const NONE: u32 = u32::MAX;

pub(super) struct Tree<'a> {
    text: &'a str,
    nodes: Vec<Node<'a>>,
    /// Names and values as written.
    attributes: Vec<(&'a str, Cow<'a, str>)>,
    pieces: Vec<Piece>,
}

struct Node<'a> {
    /// The name without its prefix.
    name: &'a str,
    /// The byte of its `<`.
    at: usize,
    first_attribute: u32,
    attribute_count: u32,
    first_child: u32,
    last_child: u32,
    next: u32,
    first_piece: u32,
    last_piece: u32,
}

/// A piece of text inside an element.
struct Piece {
    start: usize,
    end: usize,
    next: u32,
    /// The character of a reference (`&amp;`).
    reference: Option<char>,
}

impl<'a> Tree<'a> {
    /// Parses a document, whose root must be `COLLADA`.
    pub(super) fn parse(text: &'a str, lines: &LineIndex<'a>, limits: &Limits) -> Result<Self, ReadError> {
        let tree = Tree { text, nodes: Vec::new(), attributes: Vec::new(), pieces: Vec::new() };
        let mut parser = Parser { tree, lines, limits, open: Vec::new() };
        let mut reader = Reader::from_str(text);
        loop {
            let start = position(reader.buffer_position());
            let event = match reader.read_event() {
                Ok(event) => event,
                Err(error) => {
                    return Err(parser.error(position(reader.error_position()), format!("invalid XML: {error}")));
                }
            };
            let end = position(reader.buffer_position());
            match event {
                Event::Start(tag) => {
                    let index = parser.element(&tag, start)?;
                    parser.open.push(index);
                }
                Event::Empty(tag) => drop(parser.element(&tag, start)?),
                Event::End(_) => drop(parser.open.pop()),
                Event::Text(_) => parser.piece(start, end, None),
                Event::CData(_) => parser.piece(start + "<![CDATA[".len(), end.saturating_sub("]]>".len()), None),
                Event::GeneralRef(reference) => {
                    let meaning = reference.resolve_char_ref().ok().flatten().or_else(|| predefined(&reference));
                    let Some(meaning) = meaning else {
                        let message = format!(
                            "the entity {} is not predefined in XML: it is not expanded",
                            quote(reference.as_bytes())
                        );
                        return Err(parser.error(start, message));
                    };
                    parser.piece(start, end, Some(meaning));
                }
                Event::Eof => break,
                Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {}
            }
        }
        parser.finish()
    }

    pub(super) fn root(&self) -> Element<'_> {
        Element { tree: self, index: 0 }
    }

    /// Returns all elements in document order.
    pub(super) fn elements(&self) -> impl Iterator<Item = Element<'_>> {
        (0..self.nodes.len() as u32).map(|index| Element { tree: self, index })
    }
}

/// The file is in memory, so a byte position fits.
fn position(at: u64) -> usize {
    usize::try_from(at).unwrap_or(usize::MAX)
}

fn predefined(name: &str) -> Option<char> {
    match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => None,
    }
}

struct Parser<'a, 'l> {
    tree: Tree<'a>,
    lines: &'l LineIndex<'a>,
    limits: &'l Limits,
    open: Vec<u32>,
}

impl<'a> Parser<'a, '_> {
    #[cold]
    fn error(&self, at: usize, message: String) -> ReadError {
        let (line, column) = self.lines.place(at.min(self.tree.text.len()));
        ReadError::new(message).at(line, Some(column))
    }

    fn element(&mut self, tag: &BytesStart<'_>, at: usize) -> Result<u32, ReadError> {
        if self.open.len() >= DEEPEST {
            return Err(self.error(at, format!("elements are nested deeper than {DEEPEST}, which is the limit")));
        }
        let index = self.tree.nodes.len();
        let size = index.saturating_mul(size_of::<Node<'_>>()) as u64;
        if size > self.limits.max_bytes || index >= NONE as usize {
            return Err(self.error(at, format!("contains more than {index} elements, which is the limit")));
        }
        let index = index as u32;
        // Name and attributes as slices of the file, which outlives the event.
        let source = self.tree.text.get(at + 1..).and_then(|rest| rest.get(..tag.len())).unwrap_or_default();
        let name = source.get(..tag.name().as_ref().len()).unwrap_or_default();
        let first_attribute = self.tree.attributes.len() as u32;
        // Checking for duplicates would take time proportional to the square of their number.
        for attribute in Attributes::new(source, name.len()).with_checks(false) {
            let attribute = attribute
                .map_err(|error| self.error(at, format!("invalid attribute in <{}>: {error}", short(name))))?;
            self.tree.attributes.push((local(attribute.key.into_inner()), attribute.value));
        }
        let attribute_count = self.tree.attributes.len() as u32 - first_attribute;
        match self.open.last() {
            Some(&parent) => self.attach(parent, index),
            None if index > 0 => {
                return Err(self.error(at, format!("a second root, <{}>, follows the first one", short(name))));
            }
            None if local(name) != "COLLADA" => {
                let message = format!("this is not a COLLADA file: its root element is <{}>", short(name));
                return Err(self.error(at, message));
            }
            None => {}
        }
        self.tree.nodes.push(Node {
            name: local(name),
            at,
            first_attribute,
            attribute_count,
            first_child: NONE,
            last_child: NONE,
            next: NONE,
            first_piece: NONE,
            last_piece: NONE,
        });
        Ok(index)
    }

    fn attach(&mut self, parent: u32, child: u32) {
        let parent = &mut self.tree.nodes[parent as usize];
        let before = std::mem::replace(&mut parent.last_child, child);
        if before == NONE {
            parent.first_child = child;
        } else {
            self.tree.nodes[before as usize].next = child;
        }
    }

    fn piece(&mut self, start: usize, end: usize, reference: Option<char>) {
        let Some(&parent) = self.open.last() else { return };
        let text = self.tree.text.get(start..end).unwrap_or_default();
        if reference.is_none() && text.bytes().all(|byte| byte.is_ascii_whitespace()) {
            return;
        }
        let index = self.tree.pieces.len() as u32;
        self.tree.pieces.push(Piece { start, end, next: NONE, reference });
        let parent = &mut self.tree.nodes[parent as usize];
        let before = std::mem::replace(&mut parent.last_piece, index);
        if before == NONE {
            parent.first_piece = index;
        } else {
            self.tree.pieces[before as usize].next = index;
        }
    }

    fn finish(self) -> Result<Tree<'a>, ReadError> {
        let end = self.tree.text.len();
        if let Some(open) = self.open.last().and_then(|&open| self.tree.nodes.get(open as usize)) {
            let line = self.lines.place(open.at).0;
            let message = format!("the file ends inside the <{}> on line {line}: is it cut off?", short(open.name));
            return Err(self.error(end, message));
        }
        if self.tree.nodes.is_empty() {
            return Err(self.error(end, "this is not a COLLADA file: it has no element".to_owned()));
        }
        Ok(self.tree)
    }
}

/// Removes the prefix of a namespace.
fn local(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, local)| local)
}

/// Shortens a name for a message.
fn short(name: &str) -> String {
    let quoted = quote(name.as_bytes());
    quoted.trim_matches('"').to_owned()
}

#[derive(Clone, Copy)]
pub(super) struct Element<'t> {
    tree: &'t Tree<'t>,
    pub(super) index: u32,
}

impl<'t> Element<'t> {
    fn node(self) -> &'t Node<'t> {
        &self.tree.nodes[self.index as usize]
    }

    /// The name without its prefix.
    pub(super) fn name(self) -> &'t str {
        self.node().name
    }

    /// The byte where it begins.
    pub(super) fn at(self) -> usize {
        self.node().at
    }

    /// Returns an attribute with its references resolved.
    pub(super) fn attribute(self, name: &str) -> Option<Cow<'t, str>> {
        let node = self.node();
        let first = node.first_attribute as usize;
        let attributes = self.tree.attributes.get(first..first + node.attribute_count as usize)?;
        let value = attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| value.as_ref())?;
        Some(quick_xml::escape::unescape(value).unwrap_or(Cow::Borrowed(value)))
    }

    /// The child elements.
    pub(super) fn children(self) -> impl Iterator<Item = Element<'t>> {
        let tree = self.tree;
        let at = |index: u32| (index != NONE).then_some(Element { tree, index });
        std::iter::successors(at(self.node().first_child), move |child| at(child.node().next))
    }

    /// The child elements with this name.
    pub(super) fn all(self, name: &'static str) -> impl Iterator<Item = Element<'t>> {
        self.children().filter(move |child| child.name() == name)
    }

    /// The first child element with this name.
    pub(super) fn child(self, name: &str) -> Option<Element<'t>> {
        self.children().find(|child| child.name() == name)
    }

    /// Follows a path of names, taking the first element each time.
    pub(super) fn path(self, names: &[&str]) -> Option<Element<'t>> {
        names.iter().try_fold(self, |here, name| here.child(name))
    }

    /// Its own text, trimmed, without that of child elements.
    pub(super) fn text(self) -> Cow<'t, str> {
        let mut pieces = self.pieces();
        let Some(first) = pieces.next() else { return Cow::Borrowed("") };
        if self.node().first_piece == self.node().last_piece && first.reference.is_none() {
            return Cow::Borrowed(first.text.trim());
        }
        let mut text = String::new();
        for piece in std::iter::once(first).chain(pieces) {
            match piece.reference {
                Some(meaning) => text.push(meaning),
                None => text.push_str(piece.text),
            }
        }
        Cow::Owned(text.trim().to_owned())
    }

    /// The words of its text and the bytes where they begin.
    pub(super) fn words(self) -> impl Iterator<Item = (usize, &'t str)> {
        self.pieces().filter(|piece| piece.reference.is_none_or(|c| !c.is_whitespace())).flat_map(|piece| {
            let origin = piece.text.as_ptr() as usize;
            // A word is a slice of the piece: the distance from the start of the piece gives its position.
            piece.text.split_ascii_whitespace().map(move |word| (piece.at + (word.as_ptr() as usize - origin), word))
        })
    }

    fn pieces(self) -> impl Iterator<Item = TextPiece<'t>> {
        let tree = self.tree;
        let at = |index: u32| tree.pieces.get(index as usize);
        std::iter::successors(at(self.node().first_piece), move |piece| at(piece.next)).map(move |piece| TextPiece {
            at: piece.start,
            text: tree.text.get(piece.start..piece.end).unwrap_or_default(),
            reference: piece.reference,
        })
    }
}

struct TextPiece<'t> {
    at: usize,
    text: &'t str,
    reference: Option<char>,
}
