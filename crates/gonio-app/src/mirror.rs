//! The accessibility tree as plain data, for a page that mirrors it with hidden elements, which screen readers read.
//!
//! egui describes all widgets in each frame. [`TreeMirror`] compares frames and tells only what changed.

use egui::accesskit::{Action, Node, NodeId, Role, Toggled, TreeUpdate};
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// The kind of an element of the mirror.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MirrorKind {
    /// A container without a meaning of its own.
    Group,
    /// A window or a menu over the others.
    Dialog,
    /// A row of tabs.
    TabList,
    /// One of them.
    Tab,
    /// A button; with a state it is a button that stays pressed.
    Button,
    /// A button that opens a list of choices.
    ComboBox,
    /// A box with a check mark.
    CheckBox,
    /// A switch.
    Switch,
    /// One of several exclusive choices.
    Radio,
    /// A slider, or the movable edge of a panel.
    Slider,
    /// A number that is typed or dragged.
    Number,
    /// A line of text to edit.
    Line,
    /// Several lines of text to edit.
    Lines,
    /// A picture with a description.
    Image,
    /// A bar that shows progress.
    Progress,
    /// A heading.
    Heading,
    /// Text.
    Text,
}

/// An element of the mirror.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MirrorNode {
    /// Decimal digits; JavaScript's numbers are too short for it.
    pub id: String,
    /// The kind of the element.
    pub kind: MirrorKind,
    /// The accessible name, or the text.
    pub name: String,
    /// The text in a field, or the choice of a combo box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// The number of a slider or a field.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number: Option<f64>,
    /// The ends of its range.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Whether it is on, checked or selected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Whether what it opens is open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expanded: Option<bool>,
    /// Whether it cannot be used now.
    pub disabled: bool,
    /// Whether its text cannot be edited.
    pub read_only: bool,
    /// Whether the keyboard reaches it.
    pub focusable: bool,
    /// Left, top, width and height in CSS pixels.
    pub rect: [i32; 4],
    /// The ids of its children, in reading order.
    pub children: Vec<String>,
}

/// The difference between two frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MirrorChange {
    /// The element that contains all others.
    pub root: String,
    /// New and changed elements.
    pub nodes: Vec<MirrorNode>,
    /// The ids of elements that are no more.
    pub removed: Vec<String>,
    /// The id of the focused element, if the focus has moved; the root's if nothing is focused.
    pub focus: Option<String>,
}

/// The elements of the last frame.
#[derive(Default)]
pub struct TreeMirror {
    nodes: HashMap<NodeId, (Node, MirrorNode)>,
    focus: Option<NodeId>,
    scale: f64,
}

impl TreeMirror {
    /// What changed in this frame, if anything did. `scale` is the number of CSS pixels per point.
    pub fn change(&mut self, update: TreeUpdate, scale: f64) -> Option<MirrorChange> {
        let root = update.tree.as_ref()?.root;
        let all: HashMap<NodeId, Node> = update.nodes.into_iter().filter(|(_, node)| is_mirrored(node)).collect();
        let rescaled = std::mem::replace(&mut self.scale, scale) != scale;
        // A name may be another node's text.
        let is_same = |id: &NodeId, node: &Node| {
            node.labelled_by().is_empty() && self.nodes.get(id).is_some_and(|(before, _)| before == node)
        };
        let mut nodes: Vec<(NodeId, MirrorNode)> = all
            .iter()
            .filter(|(id, node)| rescaled || !is_same(id, node))
            .map(|(id, node)| (*id, mirrored(*id, node, *id == root, &all, scale)))
            .filter(|(id, new)| self.nodes.get(id).is_none_or(|(_, before)| before != new))
            .collect();
        // The same order in each run.
        nodes.sort_by_key(|(id, _)| id.0);
        let kept: HashSet<NodeId> = all.keys().copied().collect();
        let mut removed: Vec<NodeId> = self.nodes.keys().copied().filter(|id| !kept.contains(id)).collect();
        removed.sort_by_key(|id| id.0);
        for id in &removed {
            self.nodes.remove(id);
        }
        for (id, node) in &nodes {
            if let Some(source) = all.get(id) {
                self.nodes.insert(*id, (source.clone(), node.clone()));
            }
        }
        let moved = self.focus.replace(update.focus) != Some(update.focus);
        if nodes.is_empty() && removed.is_empty() && !moved {
            return None;
        }
        Some(MirrorChange {
            root: text_of(root),
            nodes: nodes.into_iter().map(|(_, node)| node).collect(),
            removed: removed.into_iter().map(text_of).collect(),
            focus: moved.then(|| text_of(update.focus)),
        })
    }
}

fn text_of(id: NodeId) -> String {
    id.0.to_string()
}

/// The runs of a text repeat what the text says.
fn is_mirrored(node: &Node) -> bool {
    node.role() != Role::TextRun
}

fn kind_of(node: &Node, is_root: bool, all: &HashMap<NodeId, Node>) -> MirrorKind {
    match node.role() {
        Role::Button
        | Role::DefaultButton
        | Role::Link
        | Role::MenuItem
        | Role::ListBoxOption
        | Role::DisclosureTriangle
        | Role::ColorWell => MirrorKind::Button,
        Role::ComboBox => MirrorKind::ComboBox,
        Role::CheckBox => MirrorKind::CheckBox,
        Role::Switch => MirrorKind::Switch,
        Role::RadioButton => MirrorKind::Radio,
        Role::Tab => MirrorKind::Tab,
        Role::Slider | Role::Splitter if range_of(node).is_some() => MirrorKind::Slider,
        Role::SpinButton | Role::NumberInput => MirrorKind::Number,
        Role::TextInput | Role::SearchInput => MirrorKind::Line,
        Role::MultilineTextInput => MirrorKind::Lines,
        Role::Image => MirrorKind::Image,
        Role::ProgressIndicator => MirrorKind::Progress,
        Role::Heading => MirrorKind::Heading,
        Role::Label => MirrorKind::Text,
        Role::Window | Role::Dialog | Role::AlertDialog if !is_root => MirrorKind::Dialog,
        _ if has_tabs(node, all) => MirrorKind::TabList,
        _ => MirrorKind::Group,
    }
}

fn has_tabs(node: &Node, all: &HashMap<NodeId, Node>) -> bool {
    node.children().iter().any(|id| all.get(id).is_some_and(|child| child.role() == Role::Tab))
}

fn range_of(node: &Node) -> Option<[f64; 2]> {
    Some([node.min_numeric_value()?, node.max_numeric_value()?]).filter(|ends| ends.iter().all(|end| end.is_finite()))
}

/// A name without the icons in it, which are private characters of their font.
fn without_icons(name: &str) -> String {
    let spoken: String = name.chars().filter(|c| !('\u{e000}'..='\u{f8ff}').contains(c)).collect();
    spoken.trim().to_owned()
}

fn mirrored(id: NodeId, node: &Node, is_root: bool, all: &HashMap<NodeId, Node>, scale: f64) -> MirrorNode {
    let kind = kind_of(node, is_root, all);
    let text = |node: &Node| node.label().or(node.value()).map(str::to_owned);
    let labels = || node.labelled_by().iter().filter_map(|id| all.get(id).and_then(text)).collect::<Vec<_>>().join(" ");
    let name = match kind {
        MirrorKind::Text | MirrorKind::Heading => text(node).unwrap_or_default(),
        _ => node.label().map_or_else(labels, str::to_owned),
    };
    let has_value = matches!(kind, MirrorKind::Number | MirrorKind::Line | MirrorKind::Lines | MirrorKind::ComboBox);
    let rect = node.bounds().map_or([0; 4], |bounds| {
        let [left, top, right, bottom] = [bounds.x0, bounds.y0, bounds.x1, bounds.y1].map(|side| side * scale);
        [left, top, right - left, bottom - top].map(|side| side.round() as i32)
    });
    MirrorNode {
        id: text_of(id),
        kind,
        name: without_icons(&name),
        value: has_value.then(|| node.value().map(str::to_owned)).flatten(),
        number: node.numeric_value().filter(|number| number.is_finite()),
        range: range_of(node),
        on: node.toggled().map(|toggled| toggled == Toggled::True).or_else(|| node.is_selected()),
        expanded: node.is_expanded(),
        disabled: node.is_disabled(),
        read_only: node.is_read_only(),
        focusable: node.supports_action(Action::Focus),
        rect,
        children: node.children().iter().filter(|id| all.contains_key(id)).copied().map(text_of).collect(),
    }
}
