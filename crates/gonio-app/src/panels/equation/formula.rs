//! The equation for the current settings, and its definitions.

use crate::session::Term;
use crate::typeset::{Node, Tag};
use gonio_language::tr;
use gonio_light::brdf::BrdfKind;
use gonio_light::{Convention, Specular};
use gonio_scene::SceneSettings;
use gonio_scene::settings::EquationSettings;

/// The tag of a term in formulas.
pub fn tag(term: Term) -> Tag {
    Tag(term as u8)
}

/// The term of a tag.
pub fn term(tag: Tag) -> Option<Term> {
    Term::ALL.iter().copied().find(|term| *term as u8 == tag.0)
}

fn v(name: &str) -> Node {
    Node::variable(name)
}

fn up(text: &str) -> Node {
    Node::upright(text)
}

fn indexed(name: Node) -> Node {
    name.below(v("i"))
}

fn n_dot_l() -> Node {
    Node::clamped_product(v("N"), indexed(v("L")))
}

/// Whether the cosine also weights the specular term. It is then outside of the brackets.
fn is_weighted(e: &EquationSettings) -> bool {
    e.brdf.is_some() || e.cosine_weighted
}

fn k(index: &str) -> Node {
    v("k").below(v(index))
}

/// The symbol of a factor or summand without its colour.
fn plain_symbol(term: Term) -> Node {
    match term {
        Term::Ambient => v("A"),
        Term::Emitted => v("E"),
        Term::Environment => v("L").below(up("env")),
        Term::Diffuse => up("diff"),
        Term::Specular => indexed(up("spec")),
        // The light's intensity. In the definitions, L_i is also the direction to the light.
        Term::Light => indexed(v("L")),
        Term::Attenuation => indexed(up("att")),
        Term::Spot => indexed(up("spot")),
        Term::Cosine => n_dot_l(),
    }
}

/// The symbol that the definition of a term starts with.
pub fn symbol(term: Term) -> Node {
    plain_symbol(term).tagged(tag(term))
}

/// A term as it appears in the equation: the diffuse and the specular term with their material colours.
fn summand(term: Term) -> Node {
    let node = match term {
        Term::Diffuse => Node::row([plain_symbol(term), Node::thin(), k("d")]),
        Term::Specular => Node::row([k("s"), Node::thin(), plain_symbol(term)]),
        _ => plain_symbol(term),
    };
    node.tagged(tag(term))
}

/// The equation for `scene` (with the settings of its pane), in parts between which lines may be broken. Every factor is shown,
/// also `spot_i` in a scene without spot lights: the equation is the same everywhere.
pub fn equation(scene: &SceneSettings) -> Vec<Node> {
    let e = &scene.equation;
    let mut parts = Vec::new();
    let mut terms = Vec::new();
    if e.brdf.is_none() {
        terms.push(symbol(Term::Ambient));
    }
    terms.push(symbol(Term::Emitted));
    if scene.environment.is_some() {
        terms.push(symbol(Term::Environment));
    }
    for (index, term) in terms.into_iter().enumerate() {
        let before =
            if index == 0 { Node::row([v("L").below(v("o")), Node::relation("=")]) } else { Node::binary("+") };
        parts.push(Node::row([before, term]));
    }
    let weighted = is_weighted(e);
    let mut inside =
        vec![Node::binary("+"), Node::Sum(Box::new(v("i"))), Node::thin(), up("["), summand(Term::Diffuse)];
    if !weighted {
        inside.extend([Node::thin(), symbol(Term::Cosine)]);
    }
    parts.push(Node::Row(inside));
    parts.push(Node::row([Node::binary("+"), summand(Term::Specular), up("]")]));
    let mut factors = Vec::new();
    for term in [Term::Light, Term::Attenuation, Term::Spot] {
        factors.extend([Node::thin(), symbol(term)]);
    }
    if e.shadows {
        factors.extend([Node::thin(), indexed(v("v"))]);
    }
    if weighted {
        factors.extend([Node::thin(), symbol(Term::Cosine)]);
    }
    parts.push(Node::Row(factors));
    parts
}

/// The definition of a term.
pub fn definition(scene: &SceneSettings, term: Term) -> Node {
    let e = &scene.equation;
    let is = |right: Node| Node::row([symbol(term), Node::relation("="), right]);
    match term {
        Term::Ambient => is(Node::row([k("a"), Node::thin(), v("L").below(v("a"))])),
        Term::Emitted => is(k("e")),
        Term::Environment => is(Node::row([
            k("d"),
            Node::thin(),
            v("D").below(up("env")),
            up("("),
            v("N"),
            up(")"),
            Node::binary("+"),
            k("s"),
            Node::thin(),
            v("S").below(up("env")),
            up("("),
            v("R").below(v("V")),
            up(")"),
        ])),
        Term::Diffuse => {
            let over_pi = e.brdf.is_some() || e.convention == Convention::Physical;
            is(if over_pi { up("1").over(v("\u{3c0}")) } else { up("1") })
        }
        Term::Specular => is(specular(e)),
        Term::Light => {
            is(Node::row([indexed(up("colour")), Node::thin(), up("\u{d7}"), Node::thin(), indexed(up("intensity"))]))
        }
        Term::Attenuation => {
            let squared = v("d").sup(up("2"));
            let terms = [k("c"), Node::binary("+"), k("l"), v("d"), Node::binary("+"), k("q"), squared];
            is(up("1").over(Node::row(terms)))
        }
        Term::Spot => is(Node::row([
            up("smoothstep("),
            up("cos"),
            Node::thin(),
            v("\u{3b2}").below(up("out")),
            up(", "),
            up("cos"),
            Node::thin(),
            v("\u{3b2}").below(up("in")),
            up(", \u{2212}"),
            indexed(v("L")),
            up("\u{22c5}"),
            indexed(v("S")),
            up(")"),
        ])),
        Term::Cosine => is(Node::row([up("max("), v("N"), up("\u{22c5}"), indexed(v("L")), up(", 0)")])),
    }
}

fn specular(e: &EquationSettings) -> Node {
    let exponent = || v("g");
    let phong = || Node::clamped_product(indexed(v("R")), v("V")).sup(exponent());
    let blinn = || Node::clamped_product(v("N"), indexed(v("H"))).sup(exponent());
    if let Some(brdf) = e.brdf {
        let exponent_plus = |n: &str| Node::row([exponent(), Node::binary("+"), up(n)]);
        let phong_factor = || exponent_plus("2").over(Node::row([up("2"), v("\u{3c0}")]));
        let lobe = match brdf {
            BrdfKind::Lambert => return up("0"),
            BrdfKind::Phong => phong(),
            BrdfKind::Blinn => blinn(),
            BrdfKind::Lafortune => {
                let product = [up("\u{27e8}\u{2212}"), indexed(v("L")), up("\u{22c5}"), v("A"), v("V"), up("\u{27e9}")];
                Node::Row(product.into()).sup(exponent())
            }
            BrdfKind::Ward => return ward(e.brdf_normalised),
        };
        return match (e.brdf_normalised, brdf) {
            (false, _) => lobe,
            (true, BrdfKind::Blinn) => {
                let over = Node::row([up("("), exponent_plus("2"), up(")("), exponent_plus("4"), up(")")]);
                let power = up("2").sup(Node::row([up("\u{2212}"), exponent(), up("/2")]));
                let under = Node::row([up("8"), v("\u{3c0}"), up("("), power, Node::binary("+"), exponent(), up(")")]);
                Node::row([over.over(under), lobe])
            }
            (true, _) => Node::row([phong_factor(), lobe]),
        };
    }
    let lobe = match e.specular {
        Specular::None => return up("0"),
        Specular::Phong => phong(),
        Specular::BlinnPhong => blinn(),
    };
    let mut whole = vec![lobe];
    if e.gated {
        whole.extend([up(tr!("scene-if")), v("N"), up("\u{22c5}"), indexed(v("L")), Node::relation(">"), up("0")]);
    }
    Node::Row(whole)
}

fn ward(normalised: bool) -> Node {
    let alpha_squared = || v("\u{3b1}").sup(up("2"));
    let tan_squared = Node::row([up("tan").sup(up("2")), v("\u{3b4}")]);
    let power = Node::row([up("\u{2212}"), tan_squared, up("/"), alpha_squared()]);
    let bell = v("e").sup(power);
    if normalised {
        let sum = || Node::row([indexed(v("L")), Node::binary("+"), v("V")]);
        let over = Node::row([up("|"), sum(), up("|").sup(up("2"))]);
        let under =
            Node::row([v("\u{3c0}"), alpha_squared(), up("("), v("N"), up("\u{22c5}("), sum(), up("))").sup(up("4"))]);
        return Node::row([over.over(under), Node::thin(), bell]);
    }
    let product = Node::row([n_dot_l(), Node::clamped_product(v("N"), v("V"))]);
    let under = Node::row([up("4"), v("\u{3c0}"), alpha_squared(), Node::thin(), product.sup(up("1/2"))]);
    Node::row([up("1").over(under), Node::thin(), bell])
}

/// The vectors of the definitions.
pub fn vectors(e: &EquationSettings) -> Vec<Node> {
    let r = Node::row([
        indexed(v("R")),
        Node::relation("="),
        up("2("),
        v("N"),
        up("\u{22c5}"),
        indexed(v("L")),
        up(")"),
        Node::thin(),
        v("N"),
        Node::binary("\u{2212}"),
        indexed(v("L")),
    ]);
    let sum = || Node::row([indexed(v("L")), Node::binary("+"), v("V")]);
    let h = Node::row([indexed(v("H")), Node::relation("="), sum().over(Node::row([up("|"), sum(), up("|")]))]);
    match (e.brdf, e.specular) {
        (Some(BrdfKind::Phong), _) | (None, Specular::Phong) => vec![r],
        (Some(BrdfKind::Blinn | BrdfKind::Ward), _) | (None, Specular::BlinnPhong) => vec![h],
        _ => Vec::new(),
    }
}
