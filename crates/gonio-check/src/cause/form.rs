//! Names by the form of a wrong value: a factor or a summand that is missing or superfluous, terms that are multiplied.

use super::model::Quantity;
use super::observed::{DIFFUSE_NAMES, Observed, Observer, SPECULAR_NAMES, SUMS, TERMS};
use super::repair::{FACTORS, Repair};
use crate::mistakes::{Mistake, ModelSolution};

/// The mistakes that a missing or superfluous factor or summand may be, in an expression that contains these terms: the
/// likeliest first.
fn structural(should: &str, terms: &[&str], model: ModelSolution) -> Vec<&'static str> {
    match should {
        "* cos_theta" if model.has_roughness() => {
            return vec!["specular-light-cosine-missing", "diffuse-without-cosine"];
        }
        "/ cos_theta" if model.has_roughness() => return vec!["specular-light-cosine-twice"],
        "* PI" if model.has_roughness() => {
            return vec!["lamp-missing", "specular-lamp-missing", "diffuse-lamp-missing"];
        }
        "/ PI" if model.has_roughness() => return vec!["specular-pi-missing", "diffuse-pi-missing"],
        _ => {}
    }
    let has = |names: &[&str]| terms.iter().any(|term| names.contains(term));
    let (both, of_diffuse, of_specular) = ("attenuation-missing", "diffuse-not-attenuated", "specular-not-attenuated");
    if should == "* attenuation" {
        return match (has(&DIFFUSE_NAMES), has(&SPECULAR_NAMES)) {
            (false, true) => vec![of_specular, both, of_diffuse],
            (true, false) => vec![of_diffuse, both, of_specular],
            _ => vec![both, of_diffuse, of_specular],
        };
    }
    vec![match should {
        "/ attenuation" if !has(&DIFFUSE_NAMES) && !has(&SPECULAR_NAMES) => "ambient-attenuated",
        "* materialColour" => "albedo-missing",
        "/ materialColour" => "albedo-squared",
        "/ cos_theta of ambient" => "ambient-times-diffuse",
        "* light.ambient_strength" => "ambient-strength-missing",
        "* light.diffuse_strength" => "diffuse-strength-missing",
        "* light.specular_strength" => "specular-strength-missing",
        "* cos_theta" => "diffuse-without-cosine",
        "+ diffuse" | "+ cos_theta" | "+ dot(N, L)" => "diffuse-missing",
        "+ specular" | "+ spec" => "specular-missing",
        "+ ambient" => "ambient-missing",
        "linear" => "gamma-applied",
        _ => return Vec::new(),
    }]
}

impl Observer<'_> {
    /// The mistakes that the form of a wrong value may be, the likeliest first.
    pub(super) fn of_form(&self, observed: &[Observed], seen: &Observed, repair: &Repair) -> Vec<&'static Mistake> {
        let form = self.form(repair, seen).unwrap_or_else(|| repair.should.clone());
        let mut ids = structural(&form, &self.terms_within(observed, seen), self.model.method.model);
        let is_sum = |q: usize| SUMS.iter().any(|sum| self.model.quantities[q].name.ends_with(sum));
        if ids.is_empty() && repair.quantity().is_some_and(is_sum) && self.multiplies_terms(observed, seen) {
            ids.push("terms-multiplied");
        }
        ids.into_iter().filter_map(crate::mistakes::find).collect()
    }

    /// The terms that an expression or its parts are.
    fn terms_within(&self, observed: &[Observed], seen: &Observed) -> Vec<&str> {
        observed.iter().filter(|other| self.is_within(other, seen)).flat_map(|other| self.terms(other)).collect()
    }

    /// Whether an expression has a product of different terms.
    fn multiplies_terms(&self, observed: &[Observed], seen: &Observed) -> bool {
        let source = &self.runner.program.stage(seen.stage).source;
        let text = self.runner.program.source_text(seen.stage);
        let within: Vec<&Observed> = observed.iter().filter(|other| self.is_within(other, seen)).collect();
        let span = |of: &Observed| source.expressions[of.expr.0 as usize].span;
        let kinds = |of: &Observed| {
            let mut kinds = [false; 3];
            for other in within.iter().filter(|other| self.is_within(other, of)) {
                let is = other.is.map(|is| self.model.quantities[is].name.as_str());
                let is_multiple = |q: &&Quantity| {
                    q.stage == seen.stage && q.mistake.is_none() && other.values.factor_of(&q.values).is_some()
                };
                let of_terms = self.model.quantities.iter().filter(|q| TERMS.contains(&q.name.as_str()));
                let multiples = of_terms.filter(|_| !other.values.is_constant()).filter(is_multiple);
                let terms: Vec<&str> = multiples.map(|q| q.name.as_str()).chain(is).collect();
                // `materialColour * ambient` is a term too.
                let is_of = |names: &[&str]| terms.iter().any(|term| names.iter().any(|name| term.ends_with(name)));
                kinds[0] |= is_of(&["ambient"]);
                kinds[1] |= is_of(&DIFFUSE_NAMES);
                kinds[2] |= is_of(&SPECULAR_NAMES);
            }
            kinds
        };
        within.iter().any(|left| {
            let is_factor = |right: &&&Observed| {
                let between = text.get(span(left).end as usize..span(right).start as usize);
                self.tokens(left).1 + 2 == self.tokens(right).0 && between.is_some_and(|text| text.trim() == "*")
            };
            within.iter().filter(is_factor).any(|right| {
                let (left, right) = (kinds(left), kinds(right));
                left.contains(&true) && right.contains(&true) && (0..3).all(|kind| !(left[kind] && right[kind]))
            })
        })
    }

    /// The factor by which a value differs from a right quantity, as repairs by factors write it.
    fn form(&self, repair: &Repair, seen: &Observed) -> Option<String> {
        let right = &self.model.quantities[repair.quantity()?];
        FACTORS.iter().find_map(|name| {
            let factor = self.model.right(name, seen.stage, false)?;
            let of_ambient = *name == "cos_theta" && right.name.ends_with("ambient");
            let (own, right) = (&seen.values, &right.values);
            match (own.is_factor_of(factor, right), right.is_factor_of(factor, own)) {
                (true, _) => Some(format!("* {name}")),
                (_, true) if of_ambient => Some("/ cos_theta of ambient".to_owned()),
                (_, true) => Some(format!("/ {name}")),
                _ => None,
            }
        })
    }
}
