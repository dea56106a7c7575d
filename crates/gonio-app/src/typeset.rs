//! Typesets formulas by TeX's rules, in the fonts of [`crate::theme`].
//!
//! A [`Node`] is a formula; [`Laid`] has the position of each piece, in points from the start of its baseline;
//! [`paint`] draws it and returns the rectangles of tagged parts, to be clicked. Layout does not depend on a
//! window: a [`Measure`] returns the size of a piece of text.
//!
//! Distances are those of Computer Modern in TeX (D. E. Knuth, *The TeXbook*, 1986, appendix G):
//!
//! | distance | ems | TeX's name |
//! |---|---|---|
//! | height of the axis, on which fractions and sums are centred | 0.25 | sigma_22 |
//! | an exponent's baseline | 0.413 | sigma_13 |
//! | an index's baseline, alone and below an exponent | 0.15, 0.247 | sigma_16, sigma_17 |
//! | a fraction's upper and lower baseline in a line | 0.394, 0.345 | sigma_9, sigma_12 |
//! | thickness of its line | 0.04 | xi_8 |
//! | least gap below a sum's sign | 0.166 | xi_10 |
//! | size of an index | 0.7 | scriptstyle of a 10 point font |

use crate::theme;
use egui::{Color32, FontId, Galley, Painter, Pos2, Rect, Vec2, pos2, vec2};
use std::sync::Arc;

/// Measures text.
pub trait Measure {
    /// The size of `text` on one line, with `size` points per em.
    fn measure(&mut self, text: &str, face: MathFont, size: f32) -> Extent;
}

/// The size of a piece of text, points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Distance to the next piece.
    pub width: f32,
    /// Ink above the baseline.
    pub ascent: f32,
    /// Ink below the baseline.
    pub descent: f32,
}

/// Identifies a part of a formula, for its colour and for clicks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tag(pub u8);

/// A font style.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MathFont {
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
    Text(String, MathFont),
    /// Nodes in a row, on one baseline.
    Row(Vec<Node>),
    /// A space of this width, ems.
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
    /// A fraction: numerator and denominator.
    Fraction(Box<Node>, Box<Node>),
    /// A sum sign with its index below.
    Sum(Box<Node>),
    /// A part with a meaning of its own.
    Tagged(Tag, Box<Node>),
}

impl Node {
    /// A variable.
    pub fn variable(text: &str) -> Node {
        Node::Text(text.to_owned(), MathFont::Italic)
    }

    /// Digits, signs, names of functions.
    pub fn upright(text: &str) -> Node {
        Node::Text(text.to_owned(), MathFont::Upright)
    }

    /// A large bracket.
    pub fn large(text: &str) -> Node {
        Node::Text(text.to_owned(), MathFont::Large)
    }

    /// A thin space, between factors.
    pub fn thin() -> Node {
        Node::Space(1.0 / 6.0)
    }

    /// A binary operator, with space on both sides.
    pub fn binary(sign: &str) -> Node {
        Node::Row(vec![Node::Space(4.0 / 18.0), Node::upright(sign), Node::Space(4.0 / 18.0)])
    }

    /// A relation, with space on both sides.
    pub fn relation(sign: &str) -> Node {
        Node::Row(vec![Node::Space(5.0 / 18.0), Node::upright(sign), Node::Space(5.0 / 18.0)])
    }

    /// Nodes in a row.
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

    /// A fraction with this numerator.
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

const AXIS: f32 = 0.25;
const EXPONENT: f32 = 0.413;
const INDEX: f32 = 0.15;
const INDEX_BELOW_EXPONENT: f32 = 0.247;
const OVER: f32 = 0.394;
const UNDER: f32 = 0.345;
const RULE: f32 = 0.04;
const SUM_GAP: f32 = 0.166;
const SCRIPT: f32 = 0.7;
/// Spacing beside scripts and fractions, as in TeX.
const SCRIPT_SPACE: f32 = 0.05;
const FRACTION_SIDE: f32 = 0.12;
/// Smallest legible size of letters, points.
const SMALLEST: f32 = 8.5;

/// A drawable shape.
#[derive(Clone, Debug, PartialEq)]
pub enum PieceShape {
    /// Characters, with their font and size in points per em.
    Text(String, MathFont, f32),
    /// A filled rectangle of this size.
    Rule(Vec2),
}

/// A piece of a formula in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its shape.
    pub shape: PieceShape,
    /// The start of its baseline (of a rule: its upper left corner), from the start of the formula's; y down.
    pub at: Vec2,
    /// The innermost part that it belongs to.
    pub tag: Option<Tag>,
}

/// A formula that was laid out. Its baseline starts at the origin; y down.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laid {
    /// Width, points.
    pub width: f32,
    /// Above the baseline.
    pub ascent: f32,
    /// Below the baseline.
    pub descent: f32,
    /// Its pieces.
    pub pieces: Vec<Piece>,
    /// Tagged parts; a tag may have several.
    pub tagged: Vec<(Tag, Rect)>,
}

impl Laid {
    /// Width and height, points.
    pub fn size(&self) -> Vec2 {
        vec2(self.width, self.ascent + self.descent)
    }

    fn from_extent(extent: Extent) -> Self {
        Laid { width: extent.width, ascent: extent.ascent, descent: extent.descent, ..Laid::default() }
    }

    /// Adds another formula at a place, without changing the width.
    fn place(&mut self, other: Laid, at: Vec2) {
        self.ascent = self.ascent.max(other.ascent - at.y);
        self.descent = self.descent.max(other.descent + at.y);
        self.pieces.extend(other.pieces.into_iter().map(|piece| Piece { at: piece.at + at, ..piece }));
        self.tagged.extend(other.tagged.into_iter().map(|(tag, rect)| (tag, rect.translate(at))));
    }

    fn append(&mut self, other: Laid) {
        let (at, width) = (self.width, other.width);
        self.place(other, vec2(at, 0.0));
        self.width = at + width;
    }
}

/// Lays out a formula with `size` points per em.
pub fn lay(node: &Node, size: f32, fonts: &mut dyn Measure) -> Laid {
    match node {
        Node::Text(text, face) => {
            let mut laid = Laid::from_extent(fonts.measure(text, *face, size));
            let shape = PieceShape::Text(text.clone(), *face, size);
            laid.pieces.push(Piece { shape, at: Vec2::ZERO, tag: None });
            laid
        }
        Node::Space(ems) => Laid { width: ems * size, ..Laid::default() },
        Node::Row(nodes) => {
            let mut row = Laid::default();
            for node in nodes {
                row.append(lay(node, size, fonts));
            }
            row
        }
        Node::Scripts { base, below, above } => scripts(base, below.as_deref(), above.as_deref(), size, fonts),
        Node::Fraction(over, under) => fraction(over, under, size, fonts),
        Node::Sum(below) => sum(below, size, fonts),
        Node::Tagged(tag, inner) => {
            let mut laid = lay(inner, size, fonts);
            laid.pieces.iter_mut().for_each(|piece| piece.tag = piece.tag.or(Some(*tag)));
            let rect = Rect::from_min_max(pos2(0.0, -laid.ascent), pos2(laid.width, laid.descent));
            laid.tagged.push((*tag, rect));
            laid
        }
    }
}

fn scripts(base: &Node, below: Option<&Node>, above: Option<&Node>, size: f32, fonts: &mut dyn Measure) -> Laid {
    let mut laid = lay(base, size, fonts);
    let small = (SCRIPT * size).max(SMALLEST.min(size));
    let (start, mut end) = (laid.width, laid.width);
    let index = if above.is_some() { INDEX_BELOW_EXPONENT } else { INDEX };
    for (script, down) in [(below, index * size), (above, -EXPONENT * size)] {
        let Some(script) = script else { continue };
        let script = lay(script, small, fonts);
        end = end.max(start + script.width + SCRIPT_SPACE * size);
        laid.place(script, vec2(start, down));
    }
    laid.width = end;
    laid
}

fn fraction(over: &Node, under: &Node, size: f32, fonts: &mut dyn Measure) -> Laid {
    let small = (SCRIPT * size).max(SMALLEST.min(size));
    let (over, under) = (lay(over, small, fonts), lay(under, small, fonts));
    let inner = over.width.max(under.width) + 2.0 * SCRIPT_SPACE * size;
    let side = FRACTION_SIDE * size;
    let rule = (RULE * size).max(1.0);
    let clear = rule + 0.06 * size;
    let axis = AXIS * size;
    // Both keep a distance from the line.
    let up = (OVER * size).max(axis + clear + over.descent);
    let down = (UNDER * size).max(under.ascent + clear - axis);
    let mut laid = Laid { width: inner + 2.0 * side, ..Laid::default() };
    let place_of = |width: f32| side + 0.5 * (inner - width);
    let (over_at, under_at) = (place_of(over.width), place_of(under.width));
    laid.place(over, vec2(over_at, -up));
    laid.place(under, vec2(under_at, down));
    let shape = PieceShape::Rule(vec2(inner, rule));
    laid.pieces.push(Piece { shape, at: vec2(side, -axis - 0.5 * rule), tag: None });
    laid
}

fn sum(below: &Node, size: f32, fonts: &mut dyn Measure) -> Laid {
    let small = (SCRIPT * size).max(SMALLEST.min(size));
    let sign = lay(&Node::large("\u{2211}"), size, fonts);
    let below = lay(below, small, fonts);
    let width = sign.width.max(below.width);
    // Centred on the axis for every font.
    let shift = 0.5 * (sign.ascent - sign.descent) - AXIS * size;
    let bottom = sign.descent + shift;
    let mut laid = Laid { width, ..Laid::default() };
    let (sign_at, below_at) = (0.5 * (width - sign.width), 0.5 * (width - below.width));
    let down = bottom + SUM_GAP * size + below.ascent;
    laid.place(sign, vec2(sign_at, shift));
    laid.place(below, vec2(below_at, down));
    laid
}

/// Lays out a formula in lines of at most `width`, broken between its parts; lines after the first are indented.
pub fn broken(parts: &[Node], size: f32, width: f32, fonts: &mut dyn Measure) -> Vec<Laid> {
    const INDENT: f32 = 1.2;
    let mut lines: Vec<Laid> = Vec::new();
    for part in parts {
        let part = lay(part, size, fonts);
        match lines.last_mut() {
            Some(line) if line.width + part.width <= width => line.append(part),
            last => {
                let indent = if last.is_some() { INDENT * size } else { 0.0 };
                let mut line = Laid { width: indent, ..Laid::default() };
                line.append(part);
                lines.push(line);
            }
        }
    }
    lines
}

fn font(face: MathFont, size: f32) -> FontId {
    match face {
        MathFont::Upright => theme::math_font(size),
        MathFont::Italic => theme::math_italic_font(size),
        MathFont::Large => theme::math_large_font(size),
    }
}

/// The baseline of a line of text, from the galley's top.
fn baseline(galley: &Galley) -> f32 {
    let row = galley.rows.first();
    row.and_then(|row| row.glyphs.first().map(|glyph| row.pos.y + glyph.pos.y)).unwrap_or_default()
}

/// The window's fonts.
pub struct EguiFonts<'a>(pub &'a Painter);

impl EguiFonts<'_> {
    fn galley(&self, text: &str, face: MathFont, size: f32, color: Color32) -> Arc<Galley> {
        self.0.layout_no_wrap(text.to_owned(), font(face, size), color)
    }
}

impl Measure for EguiFonts<'_> {
    fn measure(&mut self, text: &str, face: MathFont, size: f32) -> Extent {
        let galley = self.galley(text, face, size, Color32::PLACEHOLDER);
        let base = baseline(&galley);
        let ink = galley.mesh_bounds;
        let (ascent, descent) =
            if ink.is_positive() { ((base - ink.top()).max(0.0), (ink.bottom() - base).max(0.0)) } else { (0.0, 0.0) };
        Extent { width: galley.rect.width(), ascent, descent }
    }
}

/// Draws a formula whose baseline begins at `start`. Returns the rectangles of tagged parts in the window.
pub fn paint(painter: &Painter, laid: &Laid, start: Pos2, color: &dyn Fn(Option<Tag>) -> Color32) -> Vec<(Tag, Rect)> {
    let fonts = EguiFonts(painter);
    for piece in &laid.pieces {
        let (at, color) = (start + piece.at, color(piece.tag));
        match &piece.shape {
            PieceShape::Text(text, face, size) => {
                let galley = fonts.galley(text, *face, *size, color);
                let top = at.y - baseline(&galley);
                painter.galley(Pos2::new(at.x, top), galley, color);
            }
            PieceShape::Rule(size) => {
                painter.rect_filled(Rect::from_min_size(at, *size), 0.0, color);
            }
        }
    }
    laid.tagged.iter().map(|(tag, rect)| (*tag, rect.translate(start.to_vec2()))).collect()
}
