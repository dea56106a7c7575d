//! The quantities that a program computes, right or as a known mistake makes them: where a quantity is right, no mistake
//! is made with it or with what it is computed from.

use super::answer::{LightingMethod, has_space};
use super::model::{AnswerMethod, Mistakes, Model, Quantity, Recorded, STAGES, Space, TELLING, observe};
use super::observed::SCALED;
use super::program::{Program, Runner};
use super::samples::SceneSamples;
use super::solutions::ModelSolutions;
use crate::mistakes::{Hypotheses, Hypothesis, Mistake};
use crate::testbench::TestScene;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

/// Places in each scene at which values are compared.
const PLACES: usize = 20;
/// The quantity that is the unit normal.
const NORMAL: &str = "N";

/// The quantities that a program computes, compared with one model solution.
pub(crate) struct Shown {
    solutions: Arc<ModelSolutions>,
    program: Program,
    samples: Vec<SceneSamples>,
    method: LightingMethod,
    written_exponent: f32,
    /// Whether the program interpolates normals that were not normalised, with right values.
    keeps_normal: bool,
    /// Names of quantities with right values.
    right: BTreeSet<String>,
    /// Variables with right values, and those that they are computed from.
    variables: BTreeSet<String>,
    /// Whether a position or a direction of the program is in view space.
    is_in_view: bool,
    /// The positions and directions of the program that are in world space alone, and in view space alone.
    in_spaces: [usize; 2],
    /// Mistakes by their ids, and whether the program computes their own wrong values.
    suspects: OnceLock<BTreeMap<&'static str, bool>>,
}

impl Shown {
    /// Observes a program in the first scenes.
    ///
    /// # Errors
    /// The model solution cannot be compiled; a test ensures that all can.
    pub fn new(
        solutions: &Arc<ModelSolutions>,
        program: &Program,
        scenes: &[(TestScene, SceneSamples)],
        method: LightingMethod,
        written_exponent: f32,
    ) -> Result<Self, String> {
        let hypotheses = &solutions.hypotheses(method.model);
        let samples: Vec<SceneSamples> = scenes.iter().take(TELLING).map(|(_, samples)| samples.few(PLACES)).collect();
        let observed = observed(program, &samples);
        let mut right: BTreeSet<String> = BTreeSet::new();
        let (mut is_in_view, mut in_spaces) = (false, [0; 2]);
        // The view matrix is called V too.
        let is_vector = |q: &&Quantity| q.values.size <= 4 && is_observed(&observed, q, false);
        let none = Mistakes::These(&[]);
        for answer in answers(method, false) {
            let model = Model::new(solutions, answer, Space::World, &samples, written_exponent, none)?;
            let in_space = |space: Space| -> BTreeSet<&str> {
                let is_there = |q: &&Quantity| q.space == space && has_space(&q.name);
                let there = model.quantities.iter().filter(is_there).filter(|q| is_observed(&observed, q, false));
                there.map(|q| q.name.as_str()).collect()
            };
            let [in_world, in_view] = [Space::World, Space::View].map(in_space);
            is_in_view |= !in_view.is_empty();
            in_spaces = [
                in_spaces[0].max(in_world.difference(&in_view).count()),
                in_spaces[1].max(in_view.difference(&in_world).count()),
            ];
            right.extend(first_of_same(&model.quantities.iter().filter(is_vector).collect::<Vec<_>>(), hypotheses));
        }
        let mut keeps_normal = false;
        if !method.model.is_per_vertex() && !right.contains(NORMAL) {
            for answer in answers(method, true) {
                let model = Model::new(solutions, answer, Space::World, &samples, written_exponent, none)?;
                let found = first_of_same(&model.quantities.iter().filter(is_vector).collect::<Vec<_>>(), hypotheses);
                if found.contains(NORMAL) {
                    keeps_normal = true;
                    right.extend(found);
                }
            }
        }
        let variables = hypotheses.with_parts(&right);
        let program = program.clone();
        let solutions = Arc::clone(solutions);
        let suspects = OnceLock::new();
        Ok(Shown {
            solutions,
            program,
            samples,
            method,
            written_exponent,
            keeps_normal,
            right,
            variables,
            is_in_view,
            in_spaces,
            suspects,
        })
    }

    /// Whether some position or direction that the program computes is in view space. The position alone may be a step
    /// towards `gl_Position`.
    pub fn is_in_view(&self) -> bool {
        self.is_in_view
    }

    /// Whether more positions and directions are in view space than in world space.
    pub fn is_mostly_in_view(&self) -> bool {
        self.in_spaces[1] > self.in_spaces[0]
    }

    /// Whether the program uses the half vector; `None` if its values do not tell.
    pub fn half_vector(&self) -> Option<bool> {
        if !self.method.model.has_exponent() {
            return None;
        }
        let has = |names: &[&str]| names.iter().any(|name| self.right.contains(*name));
        match (has(&["H", "dot(N, H)", "L + V"]), has(&["R", "dot(R, V)"])) {
            (true, false) => Some(true),
            (false, true) => Some(false),
            _ => None,
        }
    }

    /// Whether no right value contradicts the changes of a hypothesis.
    pub fn allows(&self, hypotheses: &Hypotheses, hypothesis: &Hypothesis) -> bool {
        is_free(&self.variables, hypotheses, hypothesis)
    }

    /// Whether the program has the own wrong value of a mistake, or that is a constant.
    pub fn is_suspect(&self, mistake: &Mistake) -> bool {
        self.suspects().contains_key(mistake.id.as_str())
    }

    /// Whether the program computes the own wrong value of a mistake: an input or a constant is no evidence.
    pub fn is_evident(&self, mistake: &Mistake) -> bool {
        self.suspects().get(mistake.id.as_str()) == Some(&true)
    }

    /// The mistakes whose own wrong values the program has, or are constants.
    pub fn suspects(&self) -> &BTreeMap<&'static str, bool> {
        self.suspects.get_or_init(|| {
            let observed = observed(&self.program, &self.samples);
            let is_input =
                |seen: &&Recorded| self.program.is_input(seen.stage, self.program.text(seen.stage, seen.expr));
            let inputs: Vec<&Recorded> = observed.iter().filter(is_input).collect();
            let is_given = |quantity: &Quantity| {
                inputs.iter().any(|input| input.stage == quantity.stage && input.values.is_same(&quantity.values))
            };
            let mut found = BTreeMap::new();
            for model in self.models(Mistakes::OwnValues) {
                for quantity in &model.quantities {
                    let Some(mistake) = quantity.mistake else { continue };
                    let is_seen = is_observed(&observed, quantity, true);
                    let is_evident = is_seen && !is_given(quantity);
                    // A constant is no evidence, neither for a mistake nor against it.
                    if is_seen || quantity.values.is_constant() {
                        *found.entry(mistake.id.as_str()).or_default() |= is_evident;
                    }
                }
            }
            found
        })
    }

    fn models(&self, mistakes: Mistakes<'_>) -> Vec<Model> {
        let Shown { solutions, method, samples, written_exponent, keeps_normal, .. } = self;
        let model = |answer| Model::new(solutions, answer, method.space, samples, *written_exponent, mistakes);
        // A test ensures that all model solutions can be compiled.
        answers(*method, *keeps_normal).filter_map(|answer| model(answer).ok()).collect()
    }
}

fn answers(method: LightingMethod, normal_kept: bool) -> impl Iterator<Item = AnswerMethod> {
    let highlights = if method.model.has_exponent() { &[false, true][..] } else { &[false] };
    let answer = move |half_vector: &bool| AnswerMethod {
        half_vector: *half_vector,
        normal_kept,
        ..AnswerMethod::new(method.model)
    };
    highlights.iter().map(answer)
}

fn observed(program: &Program, samples: &[SceneSamples]) -> Vec<Recorded> {
    let exprs = STAGES.map(|stage| program.numbers(stage));
    observe(&Runner::new(program, samples), &[], 0..samples.len(), [&exprs[0], &exprs[1]])
}

/// Whether a program has the values of a quantity, or multiples of a term. Constants are no evidence.
fn is_observed(observed: &[Recorded], quantity: &Quantity, is_scaled: bool) -> bool {
    let is_scaled = is_scaled && SCALED.contains(&quantity.name.as_str());
    let is_it = |seen: &Recorded| {
        seen.stage == quantity.stage
            && (seen.values.is_same(&quantity.values) || is_scaled && seen.values.factor_of(&quantity.values).is_some())
    };
    !quantity.values.is_constant() && observed.iter().any(is_it)
}

/// The names of quantities, without those that are computed from another one and have its values: a strength of 1 or a
/// plain copy is no evidence.
fn first_of_same(shown: &[&Quantity], hypotheses: &Hypotheses) -> BTreeSet<String> {
    let is_copy = |quantity: &&&Quantity| {
        let parts = hypotheses.with_parts(&BTreeSet::from([quantity.name.clone()]));
        let is_original = |other: &&Quantity| {
            other.name != quantity.name
                && parts.contains(&other.name)
                && other.stage == quantity.stage
                && other.values.is_same(&quantity.values)
        };
        shown.iter().any(is_original)
    };
    shown.iter().filter(|quantity| !is_copy(quantity)).map(|quantity| quantity.name.clone()).collect()
}

/// Whether a hypothesis changes none of these variables.
fn is_free(variables: &BTreeSet<String>, hypotheses: &Hypotheses, hypothesis: &Hypothesis) -> bool {
    hypothesis.choices.keys().all(|line| !variables.contains(&hypotheses.variables[*line]))
}
