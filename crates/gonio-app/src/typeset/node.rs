//! The nodes of a formula.

/// Identifies a part of a formula, for its colour and for clicks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tag(pub u8);

/// A font style.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// Digits, signs, brackets, names of functions.
    Upright,
    /// Variables.
    Italic,
    /// Large signs: sums, large brackets.
    Large,
}

/// A formula, or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// Characters of one face.
    Text(String, Face),
    /// One after the other, on one baseline.
    Row(Vec<Node>),
    /// Nothing, so many ems wide.
    Space(f32),
    /// A node with a subscript, a superscript or both.
    Scripts {
        /// The base.
        base: Box<Node>,
        /// The index.
        below: Option<Box<Node>>,
        /// The exponent.
        above: Option<Box<Node>>,
    },
    /// One over the other.
    Fraction(Box<Node>, Box<Node>),
    /// A sum's sign with what it runs over below it.
    Sum(Box<Node>),
    /// A part with a meaning of its own.
    Tagged(Tag, Box<Node>),
}

impl Node {
    /// A variable.
    pub fn variable(text: &str) -> Node {
        Node::Text(text.to_owned(), Face::Italic)
    }

    /// Digits, signs, names of functions.
    pub fn upright(text: &str) -> Node {
        Node::Text(text.to_owned(), Face::Upright)
    }

    /// A large bracket.
    pub fn large(text: &str) -> Node {
        Node::Text(text.to_owned(), Face::Large)
    }

    /// Between factors: a thin space.
    pub fn thin() -> Node {
        Node::Space(1.0 / 6.0)
    }

    /// A sign between terms, with the room that it has on both sides.
    pub fn binary(sign: &str) -> Node {
        Node::Row(vec![Node::Space(4.0 / 18.0), Node::upright(sign), Node::Space(4.0 / 18.0)])
    }

    /// A sign between sides, with the room that it has on both sides.
    pub fn relation(sign: &str) -> Node {
        Node::Row(vec![Node::Space(5.0 / 18.0), Node::upright(sign), Node::Space(5.0 / 18.0)])
    }

    /// One after the other.
    pub fn row(nodes: impl IntoIterator<Item = Node>) -> Node {
        Node::Row(nodes.into_iter().collect())
    }

    /// Adds a subscript.
    pub fn below(self, below: Node) -> Node {
        Node::Scripts { base: Box::new(self), below: Some(Box::new(below)), above: None }
    }

    /// Adds a superscript.
    pub fn sup(self, above: Node) -> Node {
        Node::Scripts { base: Box::new(self), below: None, above: Some(Box::new(above)) }
    }

    /// Over another.
    pub fn over(self, under: Node) -> Node {
        Node::Fraction(Box::new(self), Box::new(under))
    }

    /// Adds a tag.
    pub fn tagged(self, tag: Tag) -> Node {
        Node::Tagged(tag, Box::new(self))
    }

    /// `<a . b>`: the product of two directions, or 0 where it is negative.
    pub fn clamped_product(a: Node, b: Node) -> Node {
        Node::row([Node::upright("\u{27e8}"), a, Node::upright("\u{22c5}"), b, Node::upright("\u{27e9}")])
    }
}
