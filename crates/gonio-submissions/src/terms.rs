//! Writes the specular factor, the attenuation, and the sum of the terms.

use crate::expression::{Expr, Site};
use crate::light_data::Which;
use crate::lit::Surface;
use crate::plan::{Functions, Mirror, SumForm};
use crate::scenes::Field;
use crate::writer::{Block, Writer};

/// The terms before they are added.
struct Terms {
    ambient: Expr,
    diffuse: Expr,
    specular: Expr,
    cosine: Expr,
    attenuation: Expr,
    material: Expr,
}

impl Writer<'_> {
    /// The specular factor: a power, gated or weighted if the answer is.
    pub fn specular_power(
        &mut self,
        block: &mut Block,
        surface: &Surface,
        light: &Expr,
        view: &Expr,
        to_light: &Expr,
        cosine: Option<Expr>,
    ) -> Expr {
        let answer = self.context.answer;
        let whole_vectors = self.slips("half-vector-of-unequal-vectors");
        let in_function =
            self.context.plan.functions == Functions::Terms && self.coin("specular function", 0.6) && !whole_vectors;
        let power = if in_function {
            let mut body = Block::default();
            let [n, l, e] = [self.name("arg_n"), self.name("arg_l"), self.name("arg_e")];
            let value = self.power_value(&mut body, [&n, &l, &e], None);
            self.statement(&mut body, format!("return {};", value.text));
            let name = self.name("f_specular").text;
            self.function(&format!("float {name}(vec3 {}, vec3 {}, vec3 {})", n.text, l.text, e.text), &body);
            Expr::call(&name, &[&surface.normal, light, view])
        } else {
            self.power_value(block, [&surface.normal, light, view], Some(to_light))
        };
        let power = if answer.cosine_weighted {
            let weight = cosine.unwrap_or_else(|| {
                Expr::call("max", &[&Expr::call("dot", &[&surface.normal, light]), &self.number(0.0)])
            });
            power.mul(&weight)
        } else {
            power
        };
        if !answer.gated {
            return self.value(block, "power", "float", power, 1);
        }
        let condition = format!("dot({}, {}) > {}", surface.normal.text, light.text, self.number(0.0).text);
        if self.coin("gate by if", 0.5) {
            let name = self.variable(block, "power", "float", &self.number(0.0));
            self.statement(block, format!("if ({condition}) {{\n\t{} = {};\n}}", name.text, power.text));
            return name;
        }
        let gated = Expr::choose(&format!("({condition})"), &power, &self.number(0.0));
        self.variable(block, "power", "float", &gated)
    }

    fn power_value(&mut self, block: &mut Block, vectors: [&Expr; 3], to_light: Option<&Expr>) -> Expr {
        let base = self.specular_cosine(block, vectors, to_light);
        let slip = self.slip(&[
            "specular-without-power",
            "specular-multiplied-by-exponent",
            "specular-exponent-wrong",
            "specular-power-swapped",
        ]);
        let exponent = self.shininess();
        match slip {
            None => Expr::call("pow", &[&base, &exponent]),
            Some("specular-without-power") => base,
            Some("specular-multiplied-by-exponent") => base.mul(&exponent),
            Some("specular-power-swapped") => Expr::call("pow", &[&exponent, &base]),
            Some(_) => {
                let forms = [self.number(8.0), self.number(128.0), self.number(2.0)];
                let scaled = [exponent.mul(&self.number(2.0)), exponent.div(&self.number(4.0))];
                // A literal exponent changes to another literal.
                let wrong = match (self.context.answer.writes.exponent, self.choice("wrong exponent", 3)) {
                    (false, at @ 0..=1) => scaled[at].clone(),
                    (_, at) => forms[at].clone(),
                };
                Expr::call("pow", &[&base, &wrong])
            }
        }
        .at(Site::Power)
    }

    fn specular_cosine(&mut self, block: &mut Block, [n, l, e]: [&Expr; 3], to_light: Option<&Expr>) -> Expr {
        let (a, b) = self.mirror(block, [n, l, e], to_light);
        let cosine = self.dot(&a, &b, "order of R and V");
        let slip = self.slip(&[
            "specular-not-clamped",
            "specular-absolute",
            "specular-with-normal",
            "specular-with-light",
            "specular-without-eye",
            "specular-with-normal-and-light",
            "specular-min-for-max",
        ]);
        let clamped = |a: &Expr, b: &Expr| Expr::call("max", &[&Expr::call("dot", &[a, b]), &self.number(0.0)]);
        let value = match slip {
            None => self.clamped(block, &cosine, "spec_cosine", "specular clamp"),
            Some("specular-not-clamped") => cosine,
            Some("specular-absolute") => Expr::call("abs", &[&cosine]),
            Some("specular-with-normal") => clamped(n, e),
            Some("specular-with-light") => clamped(l, e),
            Some("specular-without-eye") => clamped(&a, n),
            Some("specular-with-normal-and-light") => clamped(n, l),
            Some(_) => Expr::call("min", &[&cosine, &self.number(0.0)]),
        };
        value.at(Site::SpecularCosine)
    }

    /// The two vectors whose cosine is raised to a power: R and V, or N and H.
    fn mirror(&mut self, block: &mut Block, [n, l, e]: [&Expr; 3], to_light: Option<&Expr>) -> (Expr, Expr) {
        let two = self.number(2.0);
        let formula = |of: &Expr, about: &Expr| two.mul(&Expr::call("dot", &[about, of])).mul(about).sub(of);
        if self.context.answer.half_vector {
            let unit = |value: &Expr| Expr::call("normalize", &[value]);
            let slip =
                self.slip(&["half-vector-not-normalised", "half-vector-of-unequal-vectors", "half-vector-minus"]);
            let value = match slip {
                None => unit(&if self.coin("order of L and V", 0.3) { e.add(l) } else { l.add(e) }),
                Some("half-vector-not-normalised") => l.add(e),
                Some("half-vector-minus") => unit(&l.sub(e)),
                Some(_) => unit(&to_light.unwrap_or(l).add(e)),
            };
            let half = self.variable(block, "H", "vec3", &value.at(Site::Mirror));
            return (n.clone(), half);
        }
        let slip =
            self.slip(&["specular-reflect-sign", "specular-reflect-swapped", "formula-without-2", "formula-plus"]);
        let (value, other) = match (slip, self.context.plan.mirror) {
            (Some("specular-reflect-sign"), _) => (Expr::call("reflect", &[l, n]), e.clone()),
            (Some("specular-reflect-swapped"), _) => (Expr::call("reflect", &[n, &l.neg()]), e.clone()),
            (Some("formula-without-2"), _) => (Expr::call("dot", &[n, l]).mul(n).sub(l), e.clone()),
            (Some(_), _) => (two.mul(&Expr::call("dot", &[n, l])).mul(n).add(l), e.clone()),
            (None, Mirror::Reflect) => (Expr::call("reflect", &[&l.neg(), n]), e.clone()),
            (None, Mirror::Negated) => (Expr::call("reflect", &[l, n]).neg(), e.clone()),
            (None, Mirror::Formula) => (formula(l, n), e.clone()),
            (None, Mirror::OfView) => (Expr::call("reflect", &[&e.neg(), n]), l.clone()),
            (None, Mirror::TwoSigns) => (Expr::call("reflect", &[l, n]), e.neg()),
        };
        (self.value(block, "R", "vec3", value.at(Site::Mirror), 1), other)
    }

    fn distance(&mut self, block: &mut Block, surface: &Surface, which: &Which, to_light: &Expr, light: &Expr) -> Expr {
        let slip = self.slip(&[
            "attenuation-distance-of-direction",
            "attenuation-with-view-distance",
            "attenuation-plus-view-distance",
            "attenuation-distance-from-origin",
            "distance-of-surface-from-origin",
            "distance-light-to-eye",
            "distance-squared",
        ]);
        let length = |of: &Expr| Expr::call("length", &[of]);
        let position = surface.position.clone().unwrap_or_else(|| to_light.clone());
        let to_eye = match (&surface.passed, self.eye()) {
            (Some((_, to_eye)), _) => to_eye.clone(),
            (None, Some(eye)) => eye.sub(&position),
            (None, None) => position.clone(),
        };
        let value = match slip {
            None => match self.choice("distance form", 5) {
                0 if surface.passed.is_none() => {
                    let place = self.light_position(block, which);
                    Expr::call("distance", &[&place, &position])
                }
                1 => Expr::call("sqrt", &[&Expr::call("dot", &[to_light, to_light])]),
                _ => length(to_light),
            },
            Some("attenuation-distance-of-direction") => length(light),
            Some("attenuation-with-view-distance") => length(&to_eye),
            Some("attenuation-plus-view-distance") => length(to_light).add(&length(&to_eye)),
            Some("distance-of-surface-from-origin") => length(&position),
            Some("distance-squared") => Expr::call("dot", &[to_light, to_light]),
            Some(slip) => {
                let place = self.light_position(block, which);
                match self.eye() {
                    Some(eye) if slip == "distance-light-to-eye" => length(&place.sub(&eye)),
                    _ => length(&place),
                }
            }
        };
        self.variable(block, "d", "float", &value.at(Site::Distance))
    }

    pub fn attenuation(
        &mut self,
        block: &mut Block,
        surface: &Surface,
        which: &Which,
        to_light: &Expr,
        light: &Expr,
    ) -> Expr {
        let d = self.distance(block, surface, which, to_light, light);
        let own = self.context.plan.functions == Functions::Terms
            && matches!(which, Which::One)
            && self.coin("attenuation function", 0.6);
        if own {
            let mut body = Block::default();
            let x = self.name("arg_x");
            let value = self.attenuation_value(which, &x);
            self.statement(&mut body, format!("return {};", value.text));
            let name = self.name("f_attenuation").text;
            self.function(&format!("float {name}(float {})", x.text), &body);
            return self.value(block, "attenuation", "float", Expr::call(&name, &[&d]), 2);
        }
        let value = self.attenuation_value(which, &d);
        self.value(block, "attenuation", "float", value, 2)
    }

    fn attenuation_value(&mut self, which: &Which, d: &Expr) -> Expr {
        let [c, l, q] = [Field::Constant, Field::Linear, Field::Quadratic].map(|field| self.light(field, which));
        let one = self.number(1.0);
        let squared = match self.choice("square", 4) {
            0 => Expr::call("pow", &[d, &self.number(2.0)]),
            1 => Expr::atom(format!("({})", d.mul(d).text)),
            _ => d.clone(),
        };
        // `q * d * d`, or a square in one piece.
        let quadratic = |k: &Expr| if squared.text == d.text { k.mul(d).mul(d) } else { k.mul(&squared) };
        let whole = |c: &Expr, l: &Expr, q: &Expr| c.add(&l.mul(d)).add(&quadratic(q));
        let inverse = |of: &Expr| one.div(of);
        let slip = self.slip(&[
            "attenuation-missing",
            "attenuation-without-constant",
            "attenuation-without-linear",
            "attenuation-without-quadratic",
            "attenuation-distance-not-squared",
            "attenuation-inverse-square",
            "attenuation-inverse-distance",
            "attenuation-swapped",
            "attenuation-not-inverted",
            "attenuation-cubed",
            "attenuation-constant-outside",
            "attenuation-minus-linear",
        ]);
        match slip {
            None if self.choice("attenuation form", 8) == 0 => inverse(&c.add(&d.mul(&l.add(&q.mul(d))))),
            None => inverse(&whole(&c, &l, &q)),
            Some("attenuation-missing") => one.clone(),
            Some("attenuation-without-constant") => inverse(&l.mul(d).add(&quadratic(&q))),
            Some("attenuation-without-linear") => inverse(&c.add(&quadratic(&q))),
            Some("attenuation-without-quadratic") => inverse(&c.add(&l.mul(d))),
            Some("attenuation-distance-not-squared") => inverse(&c.add(&l.mul(d)).add(&q.mul(d))),
            Some("attenuation-inverse-square") => inverse(&d.mul(d)),
            Some("attenuation-inverse-distance") => inverse(d),
            Some("attenuation-swapped") => inverse(&whole(&c, &q, &l)),
            Some("attenuation-not-inverted") => whole(&c, &l, &q),
            Some("attenuation-cubed") => inverse(&c.add(&l.mul(d)).add(&q.mul(d).mul(d).mul(d))),
            // The precedence that a forgotten pair of parentheses gives.
            Some("attenuation-constant-outside") => inverse(&c).add(&l.mul(d)).add(&quadratic(&q)),
            Some(_) => inverse(&c.sub(&l.mul(d)).add(&quadratic(&q))),
        }
        .at(Site::Attenuation)
    }

    /// The terms with their strengths, and their sum.
    pub fn sum(
        &mut self,
        block: &mut Block,
        which: &Which,
        attenuation: Expr,
        cosine: Option<Expr>,
        power: Option<Expr>,
    ) -> Expr {
        let (cosine, power) = (cosine.unwrap_or_else(|| self.number(1.0)), power.unwrap_or_else(|| self.number(1.0)));
        let [ka, kd, ks] = [Field::Ambient, Field::Diffuse, Field::Specular].map(|field| self.light(field, which));
        let material = self.material();
        let ambient = match self.slip(&["ambient-strength-missing", "ambient-strength-is-diffuse"]) {
            None => ka.clone(),
            Some("ambient-strength-missing") => self.number(1.0),
            Some(_) => kd.clone(),
        };
        let slip = self.slip(&["diffuse-strength-missing", "diffuse-strength-is-specular", "diffuse-strength-squared"]);
        let diffuse = match slip {
            None => kd.mul(&cosine),
            Some("diffuse-strength-missing") => cosine.clone(),
            Some("diffuse-strength-is-specular") => ks.mul(&cosine),
            Some(_) => kd.mul(&kd).mul(&cosine),
        };
        let slip =
            self.slip(&["specular-strength-missing", "specular-strength-is-diffuse", "specular-strength-squared"]);
        let specular = match slip {
            None => ks.mul(&power),
            Some("specular-strength-missing") => power,
            Some("specular-strength-is-diffuse") => kd.mul(&power),
            Some(_) => ks.mul(&ks).mul(&power),
        };
        let plan = self.context.plan;
        let (coloured, vectors) = (plan.sum == SumForm::PerTerm, plan.vec3_terms);
        let white = self.context.answer.white_highlight;
        let ty = if coloured || vectors { "vec3" } else { "float" };
        let term = |block: &mut Block, key: &str, value: Expr, site: Site, coloured: bool| {
            let value = match (coloured, vectors) {
                (true, true) => Expr::call("vec3", &[&value]).mul(&material),
                (true, false) => value.mul(&material),
                (false, _) if ty == "vec3" => Expr::call("vec3", &[&value]),
                (false, _) => value,
            };
            self.value(block, key, ty, value.at(site), 1)
        };
        let ambient_is_coloured = coloured && !term_is_grey(plan.sum, self.context.slips);
        let terms = Terms {
            ambient: term(block, "ambient", ambient, Site::Ambient, ambient_is_coloured),
            diffuse: term(block, "diffuse", diffuse, Site::Diffuse, coloured),
            specular: term(block, "specular", specular, Site::Specular, coloured && !white),
            cosine,
            attenuation,
            material,
        };
        self.added(block, &terms, ty)
    }

    fn added(&mut self, block: &mut Block, terms: &Terms, ty: &str) -> Expr {
        let attenuated = |term: &Expr, is: bool| if is { terms.attenuation.mul(term) } else { term.clone() };
        let none = self.slips("terms-not-put-out");
        let twice = self.slips("attenuation-twice");
        let diffuse_attenuated = !self.slips("diffuse-not-attenuated") && !none;
        let specular_attenuated = !self.slips("specular-not-attenuated");
        let mut list = Vec::new();
        if !self.slips("ambient-missing") && !none {
            let ambient = match self.slip(&["ambient-twice", "ambient-times-diffuse"]) {
                None => terms.ambient.clone(),
                Some("ambient-twice") => self.number(2.0).mul(&terms.ambient),
                Some(_) => terms.ambient.mul(&terms.cosine),
            };
            list.push(attenuated(&ambient, self.slips("ambient-attenuated")));
        }
        if !self.slips("diffuse-missing") {
            let diffuse = if twice { attenuated(&terms.diffuse, true) } else { terms.diffuse.clone() };
            list.push(attenuated(&diffuse, diffuse_attenuated));
        }
        let white = self.context.answer.white_highlight && self.context.plan.sum != SumForm::PerTerm;
        let highlight = attenuated(&terms.specular, specular_attenuated);
        if !self.slips("specular-missing") && !none && !white {
            list.push(highlight.clone());
        }
        let material = &terms.material;
        if let Some(special) = self.special_sum(terms, ty) {
            let value = special.at(Site::Sum);
            return self.value(block, "result", "vec3", value, 1);
        }
        if self.slips("specular-subtracted")
            && let Some(last) = list.pop()
        {
            list.push(last.neg());
        }
        let coloured = |value: &Expr, this: &Self| match this.context.plan.sum {
            SumForm::PerTerm => value.clone(),
            _ if this.coin("colour last", 0.4) => value.mul(material),
            _ => material.mul(value),
        };
        let added = |list: &[Expr]| list.iter().skip(1).fold(list.first().cloned(), |sum, term| Some(sum?.add(term)));
        let empty = self.number(0.0);
        if self.context.plan.sum == SumForm::Accumulated {
            let start = Expr::call(ty, &[&empty]);
            let first = list.first().cloned().unwrap_or(start).at(Site::Sum);
            let total = self.variable(block, "sum", ty, &first);
            for term in list.iter().skip(1) {
                self.statement(block, format!("{} += {};", total.text, term.clone().at(Site::Sum).text));
            }
            let mut value = coloured(&total, self);
            if white && !self.slips("specular-missing") {
                value = value.add(&if ty == "float" { Expr::call("vec3", &[&highlight]) } else { highlight });
            }
            return self.value(block, "result", "vec3", value.at(Site::Sum), 1);
        }
        // The attenuation once, in front of both terms.
        let both = !none && !twice && list.len() == 3 && diffuse_attenuated && specular_attenuated;
        let factored = both && self.context.plan.sum == SumForm::Factored && !self.slips("ambient-attenuated");
        let sum = if factored && !self.slips("specular-subtracted") {
            let lit = terms.diffuse.add(&terms.specular);
            let lit = if self.coin("attenuation last", 0.4) {
                lit.mul(&terms.attenuation)
            } else {
                terms.attenuation.mul(&lit)
            };
            list.first().map(|ambient| ambient.add(&lit))
        } else {
            added(&list)
        };
        let sum = sum.unwrap_or(empty);
        let mut value = if self.coin("sum variable", 0.4) && self.context.plan.sum != SumForm::PerTerm {
            let name = self.variable(block, "sum", ty, &sum.at(Site::Sum));
            coloured(&name, self)
        } else {
            coloured(&sum, self)
        };
        if white && !self.slips("specular-missing") && !none {
            value = value.add(&if ty == "float" { Expr::call("vec3", &[&highlight]) } else { highlight });
        }
        self.value(block, "result", "vec3", value.at(Site::Sum), 1)
    }

    /// A sum that is no sum of the terms; only where the terms are not coloured yet.
    fn special_sum(&mut self, terms: &Terms, ty: &str) -> Option<Expr> {
        let Terms { ambient, diffuse, specular, attenuation, material, .. } = terms;
        let slip = self.slip(&[
            "ambient-as-maximum",
            "ambient-not-coloured",
            "terms-multiplied",
            "attenuation-added",
            "albedo-squared",
            "albedo-missing",
            "albedo-added",
            "diffuse-times-specular",
            "sum-minimum",
        ])?;
        let lit = attenuation.mul(&diffuse.add(specular));
        let whole = ambient.add(&lit);
        let vector = |value: &Expr| if ty == "float" { Expr::call("vec3", &[value]) } else { value.clone() };
        let bare = self.context.plan.sum == SumForm::PerTerm;
        let coloured = |value: Expr| if bare { value } else { material.mul(&value) };
        Some(match slip {
            "ambient-as-maximum" => coloured(Expr::call("max", &[ambient, &lit])),
            "sum-minimum" => coloured(Expr::call("min", &[&whole, &Expr::call(ty, &[&self.number(0.4)])])),
            "ambient-not-coloured" if bare => whole,
            "ambient-not-coloured" => vector(ambient).add(&material.mul(&lit)),
            "terms-multiplied" => material.mul(&ambient.add(&attenuation.mul(diffuse).mul(specular))),
            "diffuse-times-specular" => material.mul(&ambient.add(diffuse).mul(&attenuation.mul(specular))),
            "attenuation-added" => {
                let factor = if bare { Expr::call("vec3", &[attenuation]) } else { attenuation.clone() };
                let factor = if ty == "vec3" && !bare { Expr::call("vec3", &[&factor]) } else { factor };
                coloured(ambient.add(diffuse).add(specular).add(&factor))
            }
            "albedo-squared" if bare => material.mul(&whole),
            "albedo-squared" => material.mul(material).mul(&whole),
            "albedo-missing" => vector(&whole),
            _ => material.add(&whole),
        })
    }
}

/// Whether the ambient term loses its colour where it is computed.
fn term_is_grey(form: SumForm, slips: &[&str]) -> bool {
    form == SumForm::PerTerm && slips.contains(&"ambient-not-coloured")
}
