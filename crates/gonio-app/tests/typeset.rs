//! Formulas, laid out with the window's fonts.

use egui::Rect;
use egui_kittest::Harness;
use gonio_app::theme;
use gonio_app::typeset::{EguiFonts, Laid, Node, Piece, PieceShape, Tag, broken, lay};

/// Runs `with` with the window's fonts.
fn in_window<T: Default + 'static>(with: impl Fn(&mut EguiFonts<'_>) -> T + 'static) -> T {
    let app = move |ui: &mut egui::Ui, out: &mut T| *out = with(&mut EguiFonts(ui.painter()));
    let mut harness = Harness::builder().with_context_setup(theme::install).build_ui_state(app, T::default());
    harness.run_steps(2);
    harness.into_state()
}

fn laid(node: Node, size: f32) -> Laid {
    in_window(move |fonts| lay(&node, size, fonts))
}

fn texts(laid: &Laid) -> Vec<(String, f32, f32, f32)> {
    let text = |piece: &Piece| match &piece.shape {
        PieceShape::Text(text, _, size) => Some((text.clone(), piece.at.x, piece.at.y, *size)),
        PieceShape::Rule(_) => None,
    };
    laid.pieces.iter().filter_map(text).collect()
}

#[test]
fn a_row_stands_on_one_baseline_in_order() {
    let row = Node::row([Node::variable("A"), Node::binary("+"), Node::variable("E"), Node::upright("(")]);
    let laid = laid(row, 20.0);
    let pieces = texts(&laid);
    assert_eq!(pieces.iter().map(|p| p.0.as_str()).collect::<Vec<_>>(), ["A", "+", "E", "("]);
    assert!(pieces.iter().all(|p| p.2 == 0.0));
    assert!(pieces.windows(2).all(|p| p[0].1 < p[1].1));
    // The sign has the same room on both sides, 4/18 em.
    let (a_end, plus) = (laid.pieces.first().map_or(0.0, |_| pieces[1].1 - 20.0 * 4.0 / 18.0), pieces[1].1);
    assert!(a_end > 5.0 && plus > a_end, "{pieces:?}");
    assert!(laid.width > pieces[3].1);
    // An A of Computer Modern is 0.683 em high (cmmi10); half a point is what glyphs are padded and rounded by.
    let a = in_window(|fonts| lay(&Node::variable("A"), 20.0, fonts));
    assert!((a.ascent - 0.683 * 20.0).abs() < 1.6, "{}", a.ascent);
    assert!(a.descent < 1.6, "{}", a.descent);
}

#[test]
fn scripts_are_smaller_and_above_or_below() {
    let both = Node::Scripts {
        base: Box::new(Node::variable("k")),
        below: Some(Box::new(Node::variable("s"))),
        above: Some(Box::new(Node::upright("2"))),
    };
    let laid = laid(both, 20.0);
    let pieces = texts(&laid);
    let [base, below, above] = &pieces[..] else { panic!("{pieces:?}") };
    assert!((below.3 - 14.0).abs() < 1e-4 && (above.3 - 14.0).abs() < 1e-4);
    assert!(below.2 > 0.0 && above.2 < 0.0);
    assert!(below.1 > base.1 && below.1 == above.1);
    assert!(laid.ascent > 0.4 * 20.0 && laid.descent >= 0.2 * 20.0);
}

#[test]
fn a_fraction_keeps_clear_of_its_line() {
    let node = Node::upright("1").over(Node::row([Node::variable("k"), Node::variable("d").sup(Node::upright("2"))]));
    let laid = laid(node, 20.0);
    let rule = laid.pieces.iter().find_map(|piece| match piece.shape {
        PieceShape::Rule(size) => Some(Rect::from_min_size(piece.at.to_pos2(), size)),
        PieceShape::Text(..) => None,
    });
    let rule = rule.unwrap_or_else(|| panic!("no line"));
    let pieces = texts(&laid);
    let (one, k) = (&pieces[0], &pieces[1]);
    // Centred on the axis, 0.25 em above the baseline.
    assert!((rule.center().y + 5.0).abs() < 1e-3);
    assert!(one.2 < rule.top(), "{one:?} {rule:?}");
    assert!(k.2 > rule.bottom());
    // Both lie within the line.
    assert!(one.1 >= rule.left() && k.1 >= rule.left() - 1e-3);
    let wider = in_window(|fonts| lay(&Node::upright("1"), 20.0, fonts)).ascent;
    assert!(laid.ascent > wider && laid.descent > 0.0);
}

#[test]
fn a_sum_has_its_index_below_and_in_the_middle() {
    let laid = laid(Node::Sum(Box::new(Node::variable("i"))), 20.0);
    let pieces = texts(&laid);
    let [sign, index] = &pieces[..] else { panic!("{pieces:?}") };
    assert!(index.2 > 0.5 * 20.0 && index.3 < sign.3);
    assert!(index.1 > sign.1 && index.1 < laid.width);
    // Taller than a line of text, and deeper by its index.
    assert!(laid.ascent > 0.8 * 20.0 && laid.descent > 20.0, "{laid:?}");
    // About the axis: as far above as below it, before the index.
    let alone = in_window(|fonts| lay(&Node::large("\u{2211}"), 20.0, fonts));
    let above = laid.ascent - 5.0;
    let half = 0.5 * (alone.ascent + alone.descent);
    assert!((above - half).abs() < 0.1, "{above} {half}");
}

#[test]
fn tags_know_their_place() {
    let (a, b) = (Tag(1), Tag(2));
    let inner = Node::variable("b").tagged(b);
    let node = Node::row([Node::variable("A"), Node::row([Node::upright("("), inner, Node::upright(")")]).tagged(a)]);
    let laid = laid(node, 16.0);
    let rect = |tag: Tag| laid.tagged.iter().find(|(t, _)| *t == tag).map(|(_, r)| *r);
    let (outer, inner) = (rect(a).unwrap_or(Rect::NOTHING), rect(b).unwrap_or(Rect::NOTHING));
    assert!(outer.contains_rect(inner.shrink(0.1)) && inner.is_positive());
    let tag_of = |text: &str| {
        let is = |piece: &&Piece| matches!(&piece.shape, PieceShape::Text(t, ..) if t == text);
        laid.pieces.iter().find(is).and_then(|piece| piece.tag)
    };
    assert_eq!((tag_of("A"), tag_of("("), tag_of("b")), (None, Some(a), Some(b)));
}

#[test]
fn a_long_formula_is_broken_between_its_parts() {
    let parts: Vec<Node> = (0..6).map(|_| Node::row([Node::binary("+"), Node::upright("spec")])).collect();
    let widths: Vec<(f32, f32)> = in_window(move |fonts| {
        let whole = broken(&parts, 20.0, 1e6, fonts)[0].width;
        let lines = broken(&parts, 20.0, 0.5 * whole, fonts);
        lines.iter().map(|line| (line.width, 0.5 * whole)).collect()
    });
    assert!(widths.len() >= 2);
    assert!(widths.iter().all(|(width, most)| width <= most), "{widths:?}");
}

/// A formula scales in proportion to its size.
#[test]
fn formulas_scale() {
    let node = Node::variable("k").below(Node::variable("d")).over(Node::variable("\u{3c0}"));
    let small = laid(node.clone(), 20.0);
    let large = laid(node, 40.0);
    // Glyphs are placed at whole pixels.
    assert!((large.width - 2.0 * small.width).abs() < 2.5, "{} {}", small.width, large.width);
    assert!((large.size().y - 2.0 * small.size().y).abs() < 4.0);
}
