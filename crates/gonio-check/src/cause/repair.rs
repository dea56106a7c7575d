//! Right values for wrong expressions, by what they have in common with the wrong ones.

use super::model::{INPUTS, Model, Quantity, Space};
use super::observed::{
    DIFFUSE_NAMES, Observed, Observer, SPECULAR_NAMES, SUMS, TERMS, has_space, is_name, is_single_token,
};
use super::program::Change;
use super::values::Values;
use gonio_threads::prelude::*;
use std::cell::OnceCell;
use std::sync::OnceLock;

/// How the right value is related to the wrong one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// A mistake of the catalogue computes the wrong value.
    Known,
    /// The same direction with another length.
    Length,
    /// The negative.
    Sign,
    /// The same in another space.
    Space,
    /// Clamped at 0, or not.
    Clamp,
    /// A factor is missing or superfluous.
    Factor,
    /// A summand is missing.
    Summand,
    /// A constant multiple.
    Scale,
    /// Another quantity of the same kind.
    Other,
}

/// The cost of another input.
const EXCHANGE: f32 = 3.0;
/// Scalars and colours of the equation that may be missing in a product, or superfluous.
pub(super) const FACTORS: [&str; 11] = [
    "attenuation",
    "materialColour",
    "light.ambient_strength",
    "light.diffuse_strength",
    "light.specular_strength",
    "d",
    "cos_theta",
    "shininess",
    "spec",
    "PI",
    "roughness",
];

/// The distance between surface and light.
const DISTANCE: &str = "d";
/// An input that no lamp's light depends on.
const REFRACTION_INDEX: &str = "refractionIndice";
/// The direction in which a cubemap is sampled, which is in the world.
const LOOKED_UP: &str = "looked_up";
/// The attenuation, and the constants that it is computed from.
const OF_ATTENUATION: [&str; 4] = ["attenuation", "light.constant", "light.linear", "light.quadratic"];

/// Those of the highlight, in programs that have one.
const OF_HIGHLIGHT: [&str; 2] = ["shininess", "spec"];

/// How the right values are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Make {
    /// A quantity of the model.
    Quantity(usize),
    /// The negative of the own value.
    Negative,
    /// The own vector with length 1.
    Unit,
    /// The own value, at least 0.
    NotNegative,
    /// The own value without a gamma curve.
    Linear,
    /// The own value times a quantity.
    Times(usize),
    /// The own value divided by a quantity.
    Over(usize),
    /// The own value plus that of another expression.
    Plus(usize),
}

/// A right value for an expression.
#[derive(Clone, Debug)]
pub(crate) struct Repair {
    /// Index in the observed expressions.
    pub of: usize,
    /// The relation of both values.
    pub relation: Relation,
    /// The right quantity in words or as a formula.
    pub should: String,
    /// How its values are made.
    pub make: Make,
    /// The cost: smaller ones are tried and preferred first.
    pub cost: f32,
}

impl Repair {
    /// The right quantity, by its index in the model.
    #[must_use]
    pub fn quantity(&self) -> Option<usize> {
        if let Make::Quantity(index) = self.make { Some(index) } else { None }
    }

    /// The change that makes it; `None` if that changes nothing.
    #[must_use]
    pub fn change(&self, observed: &[Observed], model: &Model) -> Option<Change> {
        let of = &observed[self.of];
        let (own, size) = (&of.values, of.values.size);
        let with = |other: &Values, f: &dyn Fn(f32, f32) -> f32| {
            own.map(size, |point, from, to| {
                let other = other.at(point);
                let numbers = to.iter_mut().zip(from).enumerate();
                numbers.for_each(|(c, (to, from))| *to = f(*from, other[c.min(other.len() - 1)]));
            })
        };
        let each = |f: &dyn Fn(f32) -> f32| {
            own.map(size, |_, from, to| to.iter_mut().zip(from).for_each(|(to, from)| *to = f(*from)))
        };
        let values = match self.make {
            Make::Quantity(index) => model.quantities[index].values.clone(),
            Make::Negative => each(&|x| -x),
            Make::Unit => own.unit(),
            Make::NotNegative => each(&|x| x.max(0.0)),
            Make::Linear => each(&|x| x.max(0.0).powf(2.2)),
            Make::Times(index) => own.times(&model.quantities[index].values),
            Make::Over(index) => with(&model.quantities[index].values, &|a, b| a / b),
            Make::Plus(other) => with(&observed[other].values, &|a, b| a + b),
        };
        let is_other = !values.is_same(own);
        is_other.then(|| Change { stage: of.stage, exprs: vec![of.expr], occurrence: of.occurrence, values })
    }
}

/// The repairs that are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// Those of values that are a mistake's own, and those of a gamma curve.
    Known,
    /// All.
    All,
}

impl Observer<'_> {
    /// All repairs worth trying, or some of them, by cost.
    #[must_use]
    pub fn repairs(&self, observed: &[Observed], asked: Asked) -> Vec<Repair> {
        let space = self.space(observed);
        // The terms that each expression is, right or with a known mistake.
        let terms: OnceLock<Vec<Vec<&str>>> = OnceLock::new();
        let contains_any = |seen: &Observed, names: &[&str]| {
            let terms = terms.get_or_init(|| observed.iter().map(|seen| self.terms(seen)).collect());
            observed.iter().zip(terms).any(|(other, terms)| {
                self.is_within(other, seen)
                    && self.tokens(other) != self.tokens(seen)
                    && terms.iter().any(|term| names.contains(term))
            })
        };
        let computed: Vec<usize> = (0..observed.len()).filter(|at| !observed[*at].is_assignment).collect();
        let of_one = |of: &usize| self.repairs_of(observed, *of, (asked, space), &contains_any);
        let mut all: Vec<Repair> = computed.par_iter().flat_map_iter(of_one).collect();
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all
    }

    /// The repairs of one expression. `contains_any`: whether a part of an expression is one of these terms.
    fn repairs_of(
        &self,
        observed: &[Observed],
        of: usize,
        (asked, space): (Asked, Space),
        contains_any: &dyn Fn(&Observed, &[&str]) -> bool,
    ) -> Vec<Repair> {
        let (model, seen) = (self.model, &observed[of]);
        let mut all = Vec::new();
        let known: Vec<&Quantity> = (model.quantities.iter())
            .filter(|q| q.stage == seen.stage && q.mistake.is_some() && q.values.is_same(&seen.values))
            .collect();
        let size = seen.values.size;
        // The curve is a power, and what is computed from it later.
        let may_be_curve = (size == 3 || size == 4) && self.text(seen).contains("pow");
        if asked == Asked::Known && known.is_empty() && !may_be_curve {
            return all;
        }
        let fits =
            |q: &Quantity| !has_space(&q.name) || q.space == if q.name == LOOKED_UP { Space::World } else { space };
        let is_right = seen.is.is_some_and(|is| fits(&model.quantities[is]));
        let length = self.text(seen).len() as f32;
        let is_literal = self.is_literal(seen) || self.is_zero(seen);
        let is_compared = self.runner.program.is_compared(seen.stage, seen.expr);
        // `vec3(ambient)` is as right as the number, and may only lack a colour.
        let grey = if seen.is.is_none() { seen.values.grey() } else { None };
        let is_right_grey = grey.is_some_and(|grey| self.recognise(seen.stage, &grey).is_some());
        let (is_same_in_scene, is_of_input, is_of_places) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        let mut push = |relation: Relation, should: String, make: Make, extra: f32| {
            let quantity = if let Make::Quantity(index) = make { Some(&model.quantities[index]) } else { None };
            // A literal stands for a constant, unless a known mistake writes it instead of a quantity.
            let is_bold = is_literal && quantity.is_none_or(|q| !q.values.is_constant());
            let is_of_number = match make {
                Make::Over(_) => true,
                Make::Times(by) => model.quantities[by].values.size == 1,
                _ => false,
            };
            if is_right_grey && is_of_number {
                return;
            }
            // A right quantity may be used where another one belongs, and an input where another input does.
            let is_exchanged = relation == Relation::Other && self.is_exchange(seen, quantity);
            let lacks_colour = self.is_set_to_term(seen) && !is_of_number && matches!(make, Make::Times(_));
            let is_enough = is_right && !is_exchanged && !lacks_colour;
            if is_enough && relation > Relation::Length || is_bold && relation != Relation::Known {
                return;
            }
            let is_whole = quantity.is_some_and(|q| SUMS.contains(&q.name.as_str()));
            let extra = extra + if is_whole && relation == Relation::Other { 2.0 } else { 0.0 };
            let extra = extra + if is_right { 2.0 } else { 0.0 } + if is_bold { 4.0 } else { 0.0 };
            // There are few inputs, and what is computed from a wrong one may be another quantity.
            let cost = if is_exchanged { EXCHANGE } else { relation as u8 as f32 + extra };
            let cost = cost + length * 0.002;
            all.push(Repair { of, relation, should, make, cost });
        };
        let has_no_attenuation =
            model.right("attenuation", seen.stage, false).is_some_and(|attenuation| attenuation.is_constant());
        for (index, quantity) in model.quantities.iter().enumerate() {
            let is_candidate = quantity.stage == seen.stage && quantity.mistake.is_none() && fits(quantity);
            if !is_candidate || quantity.values.size != size {
                continue;
            }
            let right = &quantity.values;
            // In an exercise without attenuation, it is 1 everywhere.
            if quantity.name == REFRACTION_INDEX && model.method.model.is_lit() {
                continue;
            }
            if has_no_attenuation && OF_ATTENUATION.contains(&quantity.name.as_str()) {
                continue;
            }
            let is_it = |k: &&Quantity| k.name == quantity.name && k.interpolated == quantity.interpolated;
            let is_known = known.iter().any(is_it);
            if asked == Asked::Known && !is_known {
                continue;
            }
            let relation = if is_known {
                Relation::Known
            } else if size == 3 && seen.values.is_parallel(right, 1.0) {
                Relation::Length
            } else if seen.values.is_scaled(right, -1.0) || size == 3 && seen.values.is_parallel(right, -1.0) {
                Relation::Sign
            } else if seen.is.is_some_and(|is| model.quantities[is].name == quantity.name) {
                Relation::Space
            } else if size == 1 && seen.values.is_clamped(right) {
                Relation::Clamp
            } else if !right.is_constant() && seen.values.factor_of(right).is_some() {
                Relation::Scale
            } else {
                Relation::Other
            };
            // No number that varies from place to place should be a constant or an input, nor one that decides something.
            let is_input = || INPUTS.iter().any(|(name, ..)| *name == quantity.name);
            let is_number = relation == Relation::Other && size == 1 && (right.is_constant() || is_input());
            if is_number && (is_compared || !*is_same_in_scene.get_or_init(|| self.is_same_in_each_scene(seen))) {
                continue;
            }
            // A number that is computed from inputs alone never varies from place to place.
            let is_varying = !is_number && relation == Relation::Other && size == 1 && !right.is_constant();
            // But the distance may be that of the wrong points.
            let may_be_distance =
                || quantity.name == DISTANCE && *is_of_places.get_or_init(|| self.is_of_places(observed, seen));
            if is_varying
                && !may_be_distance()
                && *is_same_in_scene.get_or_init(|| self.is_same_in_each_scene(seen))
                && *is_of_input.get_or_init(|| self.is_of_input(observed, seen))
            {
                continue;
            }
            // Where nothing resembles attenuated light, the plain term is tried.
            if relation == Relation::Other && ["diffuse_light", "specular_light"].contains(&quantity.name.as_str()) {
                continue;
            }
            // Ward's term contains cosines of its own.
            let drops = |names: &[&str], others: &[&str]| {
                !model.method.model.has_roughness()
                    && names.contains(&quantity.name.as_str())
                    && contains_any(seen, others)
            };
            if drops(&DIFFUSE_NAMES, &SPECULAR_NAMES) || drops(&SPECULAR_NAMES, &DIFFUSE_NAMES) {
                continue;
            }
            push(relation, quantity.name.clone(), Make::Quantity(index), 0.0);
        }
        if may_be_curve {
            push(Relation::Factor, "linear".to_owned(), Make::Linear, 0.0);
        }
        if asked == Asked::Known {
            return all;
        }
        push(Relation::Sign, "-".to_owned(), Make::Negative, 0.5);
        if size == 3 {
            push(Relation::Length, "unit".to_owned(), Make::Unit, 0.5);
        }
        if size == 1 {
            push(Relation::Clamp, "max(0)".to_owned(), Make::NotNegative, 0.5);
        }
        if size == 1 || size == 3 {
            self.scaled(observed, seen, &mut push);
            // A term that is computed but not added, which is never missing in a component of a vector.
            let last = self.text(seen).rsplit_once('.').map(|(_, component)| component);
            let is_component = size == 1 && is_name(self.text(seen)) && last.is_some_and(|last| last.len() == 1);
            let others = observed.iter().enumerate().filter(|_| !is_component);
            for (index, other) in others {
                if other.stage != seen.stage || other.values.size > size {
                    continue;
                }
                let is_term = other.is.is_some_and(|is| TERMS.contains(&model.quantities[is].name.as_str()));
                if other.expr == seen.expr || other.is_assignment || other.values.is_constant() && !is_term {
                    continue;
                }
                if !is_term && (other.values.size < size || !is_single_token(self.tokens(other))) {
                    continue;
                }
                let name = other.is.map_or("a term", |is| self.model.quantities[is].name.as_str());
                push(Relation::Summand, format!("+ {name}"), Make::Plus(index), 0.0);
            }
        }
        all
    }

    /// Whether a number is the same at all places of each scene.
    fn is_same_in_each_scene(&self, seen: &Observed) -> bool {
        let first = |scene| self.runner.first_point(seen.stage, scene);
        let is_same = |scene: usize| {
            let mut all = (first(scene)..first(scene + 1)).filter(|point| seen.values.present[*point]);
            let Some(one) = all.next().map(|point| seen.values.at(point)[0]) else { return true };
            // An input that is interpolated is only nearly the same.
            all.all(|point| (seen.values.at(point)[0] - one).abs() <= 1e-4 * one.abs().max(1.0))
        };
        seen.values.is_constant() || (0..self.runner.samples.len()).all(is_same)
    }

    /// Whether an input or a component of one is part of an expression.
    fn is_of_input(&self, observed: &[Observed], seen: &Observed) -> bool {
        let reads = |part: &Observed| {
            let of_vector = self.text(part).rsplit_once('.').filter(|(_, component)| component.len() == 1);
            let is_one = |is: usize| INPUTS.iter().any(|(name, ..)| *name == self.model.quantities[is].name);
            self.is_input(part)
                || part.is.is_some_and(is_one)
                || of_vector.is_some_and(|(vector, _)| self.runner.program.is_input(part.stage, vector.trim()))
        };
        let set = seen.defined_at.map(|of| &observed[of]);
        observed
            .iter()
            .any(|part| reads(part) && (self.is_within(part, seen) || set.is_some_and(|set| self.is_within(part, set))))
    }

    /// Whether a position that is an input is part of an expression.
    fn is_of_places(&self, observed: &[Observed], seen: &Observed) -> bool {
        let is_place = |part: &Observed| {
            part.is.is_some_and(|is| ["light_pos", "u_view_pos"].contains(&self.model.quantities[is].name.as_str()))
        };
        observed.iter().any(|part| is_place(part) && self.is_within(part, seen))
    }

    /// Whether a variable is set to a right term in a colour, which may lack that of the object.
    pub(super) fn is_set_to_term(&self, seen: &Observed) -> bool {
        let is_term = |is: usize| TERMS.contains(&self.model.quantities[is].name.as_str());
        seen.values.size == 3
            && seen.is.is_some_and(is_term)
            && self.runner.program.is_whole_value(seen.stage, seen.expr)
    }

    /// Whether an input stands where another one of its kind belongs.
    pub(super) fn is_exchange(&self, seen: &Observed, right: Option<&Quantity>) -> bool {
        const KINDS: [&[&str]; 3] = [
            &["light.ambient_strength", "light.diffuse_strength", "light.specular_strength"],
            &["light.constant", "light.linear", "light.quadratic"],
            &["light_pos", "u_view_pos"],
        ];
        let Some(right) = right.filter(|_| self.is_input(seen)) else { return false };
        let is_one = |name: &&&str| {
            let is_it = |q: &Quantity| q.stage == seen.stage && q.mistake.is_none() && q.name == **name;
            self.model.quantities.iter().any(|q| is_it(q) && q.values.is_same(&seen.values))
        };
        KINDS.iter().any(|kind| kind.contains(&right.name.as_str()) && kind.iter().any(|name| is_one(&name)))
    }

    /// Products and quotients with scalars and colours of the equation.
    fn scaled(&self, observed: &[Observed], seen: &Observed, push: &mut impl FnMut(Relation, String, Make, f32)) {
        // The numbers of a normalisation are no place for a factor that is missing elsewhere.
        if self.model.method.model.has_roughness() && seen.values.is_constant() {
            return;
        }
        // A condition says nothing about how bright something is.
        if self.runner.program.is_compared(seen.stage, seen.expr) {
            return;
        }
        let has_highlight = self.runner.program.has_exponent();
        for (index, quantity) in self.model.quantities.iter().enumerate() {
            let is_factor = quantity.stage == seen.stage && quantity.mistake.is_none() && !quantity.interpolated;
            let name = quantity.name.as_str();
            if !is_factor || !FACTORS.contains(&name) || quantity.values.size > seen.values.size {
                continue;
            }
            if OF_HIGHLIGHT.contains(&name) && !has_highlight {
                continue;
            }
            let unusual = if ["cos_theta", "spec", "shininess", "d"].contains(&name) { 2.0 } else { 0.0 };
            push(Relation::Factor, format!("* {name}"), Make::Times(index), unusual);
            // A superfluous factor is part of the expression.
            let is_part = |other: &&Observed| self.is_within(other, seen) && self.tokens(other) != self.tokens(seen);
            if observed.iter().filter(is_part).any(|part| part.values.is_same(&quantity.values)) {
                push(Relation::Factor, format!("/ {name}"), Make::Over(index), unusual + 0.2);
            }
        }
    }
}
