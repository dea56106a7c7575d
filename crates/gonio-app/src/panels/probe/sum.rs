//! The equation with numbers, typeset: a line per channel, each term in its colour.

use super::short;
use crate::session::probing::Reading;
use crate::theme::colors;
use crate::typeset::{self, EguiFonts, Node, Tag};
use egui::{Color32, RichText, Sense, Ui, pos2, vec2};
use gonio_language::tr;
use gonio_reference::Probe;

/// Points per em, and between lines.
const SIZE: f32 = 15.0;
const GAP: f32 = 4.0;

const TOTAL: Tag = Tag(0);
const AMBIENT: Tag = Tag(1);
const EMITTED: Tag = Tag(2);
const DIFFUSE: Tag = Tag(3);
const SPECULAR: Tag = Tag(4);
const LIGHT: Tag = Tag(5);

pub fn show(ui: &mut Ui, reading: &Reading, probe: &Probe) {
    formula(ui, &symbols(probe));
    ui.add_space(2.0);
    for channel in 0..3 {
        formula(ui, &numbers(probe, channel));
    }
    if reading.frame.equation.terms != gonio_light::TermSwitches::default() {
        let remark = tr!("scene-terms-that-are-switched-off-count");
        ui.label(RichText::new(remark).small().weak());
    }
    if probe.radiance != probe.lit {
        let [r, g, b] = probe.radiance.to_array().map(short);
        let text = tr!("scene-with-the-reflected-and-refracted-environment", r = r, g = g, b = b);
        ui.label(RichText::new(text).small().color(colors::ENVIRONMENT.of(ui)));
    }
}

fn up(text: &str) -> Node {
    Node::upright(text)
}

fn v(text: &str) -> Node {
    Node::variable(text)
}

/// Factors with dots between them.
fn product(factors: impl IntoIterator<Item = Node>) -> Node {
    let mut row = Vec::new();
    for factor in factors {
        if !row.is_empty() {
            row.extend([Node::Space(0.08), up("\u{22c5}"), Node::Space(0.08)]);
        }
        row.push(factor);
    }
    Node::Row(row)
}

fn plus(node: Node) -> Node {
    Node::row([Node::binary("+"), node])
}

/// The equation in symbols, in the order of the numbers below.
fn symbols(probe: &Probe) -> Vec<Node> {
    let k = |index: &str| v("k").below(v(index));
    let mut parts = vec![
        Node::row([v("L").below(v("o")).tagged(TOTAL), Node::relation("="), v("A").tagged(AMBIENT)]),
        plus(v("E").tagged(EMITTED)),
    ];
    if probe.interpolated.is_some() {
        parts.push(plus(Node::row([k("d"), Node::thin(), up(tr!("scene-diffuse-light"))]).tagged(DIFFUSE)));
        parts.push(plus(Node::row([k("s"), Node::thin(), up(tr!("scene-specular-light"))]).tagged(SPECULAR)));
        return parts;
    }
    let i = || v("i");
    let cosine = Node::clamped_product(v("N"), v("L").below(i()));
    let diffuse = Node::row([up("diff"), Node::thin(), k("d"), Node::thin(), cosine]).tagged(DIFFUSE);
    let specular = Node::row([k("s"), Node::thin(), up("spec").below(i())]).tagged(SPECULAR);
    let light = [v("L").below(i()), Node::thin(), up("att").below(i()), Node::thin(), up("spot").below(i())];
    parts.push(Node::row([Node::binary("+"), Node::Sum(Box::new(i())), Node::thin(), up("["), diffuse]));
    parts.push(Node::row([Node::binary("+"), specular, up("]"), Node::thin(), Node::row(light).tagged(LIGHT)]));
    parts
}

/// The equation in numbers, for one channel: 0 red, 1 green, 2 blue.
fn numbers(probe: &Probe, channel: usize) -> Vec<Node> {
    let (terms, surface) = (&probe.terms, &probe.surface);
    let of = |color: glam::DVec3| up(&short(color.to_array()[channel % 3]));
    let name = ["R", "G", "B"][channel % 3];
    let mut parts = vec![
        Node::row([
            v("L").below(up(name)),
            Node::relation("="),
            of(probe.lit).tagged(TOTAL),
            Node::relation("="),
            of(terms.ambient).tagged(AMBIENT),
        ]),
        plus(of(terms.emitted).tagged(EMITTED)),
    ];
    if let Some(sums) = &probe.interpolated {
        parts.push(plus(product([of(surface.diffuse), of(sums.diffuse)]).tagged(DIFFUSE)));
        parts.push(plus(product([of(surface.specular), of(sums.specular)]).tagged(SPECULAR)));
        return parts;
    }
    for light in &terms.lights {
        let cosine = up(&short(light.cos_theta.max(0.0)));
        let diffuse = product([up(&short(light.diff)), of(surface.diffuse), cosine]).tagged(DIFFUSE);
        let specular = product([of(surface.specular), up(&short(light.spec))]).tagged(SPECULAR);
        let arriving = of(light.incident).tagged(LIGHT);
        let inside = Node::row([up("["), diffuse, Node::binary("+"), specular, up("]")]);
        parts.push(plus(product([inside, arriving])));
    }
    parts
}

/// A formula, broken into lines.
fn formula(ui: &mut Ui, parts: &[Node]) {
    let width = ui.available_width();
    let lines = typeset::broken(parts, SIZE, width, &mut EguiFonts(ui.painter()));
    let height: f32 = lines.iter().map(|line| line.size().y + GAP).sum();
    let (room, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let plain = ui.visuals().weak_text_color();
    let color = |tag: Option<Tag>| -> Color32 {
        match tag {
            Some(TOTAL) => ui.visuals().strong_text_color(),
            Some(AMBIENT) => colors::AMBIENT.of(ui),
            Some(EMITTED) => colors::EMITTED.of(ui),
            Some(DIFFUSE) => colors::DIFFUSE.of(ui),
            Some(SPECULAR) => colors::SPECULAR.of(ui),
            Some(LIGHT) => colors::LIGHT.of(ui),
            _ => plain,
        }
    };
    let mut top = room.top();
    for line in &lines {
        typeset::paint(ui.painter(), line, pos2(room.left(), top + line.ascent), &color);
        top += line.size().y + GAP;
    }
}
