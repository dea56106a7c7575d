//! Compares hypotheses with a program's picture on the CPU, thousands per second.

use super::compare::{Comparison, SceneDifference, channel_difference};
use super::fit::{Plane, strengths};
use super::predict::{CompiledModel, Lit, ModelInputs, Strengths, model_names};
use crate::interpreter::{EvaluationPlan, InputSet, Points, Run, Value};
use crate::mistakes::Hypothesis;
use crate::roles::{self, Declared};
use crate::testbench::{Atlas, TILE, TestScene, Testbench, numbers};
use gonio_gl::GlError;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// The resolution of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComparisonDetail {
    /// Every fourth pixel: enough to rank by.
    Coarse,
    /// Every pixel.
    Full,
}

/// A model solution with its inputs, and the picture that it is compared with.
pub struct CpuComparer<'a> {
    testbench: &'a Testbench,
    model: &'a CompiledModel,
    seen: &'a Atlas,
    test_scenes: usize,
    plan: Rc<EvaluationPlan>,
    points: Rc<Points>,
    /// The terms whose strengths are fitted.
    terms: Vec<usize>,
    /// For each light, the inputs without those terms, and then with each of them alone.
    input_sets: Rc<Vec<InputSet>>,
    /// For each light, the inputs with all terms.
    whole: Rc<Vec<InputSet>>,
    /// For each light, whether the hypothesis applies to it.
    is_changed: Vec<bool>,
    /// The covered pixels by the expression assigned to `gl_Position`.
    known: RefCell<HashMap<(String, ComparisonDetail), Rc<CoveredPixels>>>,
}

/// The pixels that an expression for `gl_Position` covers, and the program's picture there.
struct CoveredPixels {
    by_terms: Run,
    whole: OnceCell<Run>,
    surface: crate::testbench::CoverageMap,
    seen: [Plane; 3],
    /// For each test scene, the number of pixels that only one of the two draws.
    lost: Vec<usize>,
}

impl<'a> CpuComparer<'a> {
    /// Returns `None` for models that only the driver can draw.
    pub fn new(
        testbench: &'a Testbench,
        model: &'a CompiledModel,
        inputs: &ModelInputs,
        seen: &'a Atlas,
        test_scenes: usize,
    ) -> Option<Self> {
        let plan = Rc::clone(model.plan.as_ref()?);
        let lights = inputs.lights.each();
        let input_set =
            |light: usize, lit| input_set(&plan, testbench, inputs, |test_scene| inputs.apply(test_scene, light, lit));
        let lit = || std::iter::once(Lit::Known).chain(inputs.terms.iter().map(|&term| Lit::Term(term)));
        let input_sets = lights.iter().flat_map(|&(light, _)| lit().map(move |lit| (light, lit)));
        let input_sets = input_sets.map(|(light, lit)| input_set(light, lit)).collect();
        let whole = lights.iter().map(|&(light, _)| input_set(light, Lit::Whole)).collect();
        Some(CpuComparer {
            testbench,
            model,
            seen,
            test_scenes,
            points: Rc::new(testbench.points(test_scenes)),
            terms: inputs.terms.clone(),
            input_sets: Rc::new(input_sets),
            whole: Rc::new(whole),
            is_changed: lights.iter().map(|(_, is_changed)| *is_changed).collect(),
            plan,
            known: RefCell::default(),
        })
    }

    /// Returns the residual of a hypothesis and the strengths that were fitted for it.
    pub fn compare(
        &self,
        hypothesis: &Hypothesis,
        detail: ComparisonDetail,
    ) -> Result<(Comparison, Strengths), GlError> {
        let place = self.model.hypotheses.text_of("gl_Position", hypothesis).unwrap_or_default();
        let covered = self.covered(place, detail)?;
        let is_whole = !self.terms.is_empty() && self.model.is_whole(hypothesis);
        let run = if is_whole {
            covered.whole.get_or_init(|| {
                let drawn = covered.surface.drawn.clone();
                Run::new(Rc::clone(&self.plan), Rc::clone(&self.points), drawn, Rc::clone(&self.whole))
            })
        } else {
            &covered.by_terms
        };
        let colours = self.colours(run, hypothesis);
        let spans = &covered.surface.drawn.spans;
        let count = if is_whole { 1 } else { self.terms.len() };
        // A common factor is fitted, so no part of the picture is known.
        let first_term = usize::from(!is_whole);
        let mut predicted: Vec<Plane> = Vec::with_capacity(3);
        let (mut found, mut shows) = (vec![Vec::with_capacity(3); count], vec![false; count]);
        for channel in 0..3 {
            let added = |set: usize| added(&colours, set, first_term + count, channel, spans);
            let known = if is_whole { vec![0.0; covered.surface.places.len()] } else { added(0) };
            let planes: Vec<Plane> = (0..count).map(|term| added(first_term + term)).collect();
            let terms: Vec<&[f32]> = planes.iter().map(Vec::as_slice).collect();
            let mut sum = known.clone();
            let strengths = if count == 0 { Vec::new() } else { strengths(&covered.seen[channel], &known, &terms) };
            for (index, (term, strength)) in terms.iter().zip(strengths).enumerate() {
                found[index].push(strength);
                shows[index] |= term.iter().zip(&known).any(|(a, b)| a != b);
                let strength = strength as f32;
                for (sum, (term, known)) in sum.iter_mut().zip(term.iter().zip(&known)) {
                    *sum += strength * (term - known);
                }
            }
            predicted.push(sum);
        }
        let mut strengths = [None; 3];
        if !is_whole {
            for ((&term, found), shows) in self.terms.iter().zip(found).zip(shows) {
                strengths[term] = <[f64; 3]>::try_from(found).ok().filter(|_| shows);
            }
        }
        Ok((covered.comparison(&predicted), strengths))
    }

    /// Returns the colours of the model for each light and input set.
    fn colours(&self, run: &Run, hypothesis: &Hypothesis) -> Vec<Rc<Value>> {
        let changed = run.colours(&hypothesis.choices);
        if self.is_changed.iter().all(|is_changed| *is_changed) {
            return changed;
        }
        let own = run.colours(&BTreeMap::new());
        let per_light = (own.len() / self.is_changed.len().max(1)).max(1);
        let is_changed = |set: usize| self.is_changed.get(set / per_light).copied().unwrap_or(true);
        let both = changed.into_iter().zip(own).enumerate();
        both.map(|(set, (changed, own))| if is_changed(set) { changed } else { own }).collect()
    }

    fn covered(&self, place: &str, detail: ComparisonDetail) -> Result<Rc<CoveredPixels>, GlError> {
        let key = (place.to_owned(), detail);
        if let Some(known) = self.known.borrow().get(&key) {
            return Ok(Rc::clone(known));
        }
        let counts = |place: u32| {
            let (x, y) = (place % TILE, place / TILE % TILE);
            detail == ComparisonDetail::Full || (x % 2 == 0 && y % 2 == 0)
        };
        let all = self.testbench.surface(place)?;
        let is_seen = |place: u32| self.seen.pixels.get(place as usize).is_some_and(Atlas::is_drawn);
        let surface = all.filtered(self.test_scenes, |place| counts(place) && is_seen(place));
        let size = TILE * TILE;
        let lost = |test_scene: usize| {
            let tile = test_scene as u32 * size..(test_scene as u32 + 1) * size;
            let seen = tile.filter(|&place| counts(place) && is_seen(place)).count();
            let span = all.drawn.spans.get(test_scene).cloned().unwrap_or_default();
            let drawn = span.filter(|&index| counts(all.places[index])).count();
            let both = surface.drawn.spans.get(test_scene).map_or(0, ExactSizeIterator::len);
            (seen - both) + (drawn - both)
        };
        let plane = |channel: usize| -> Plane {
            surface.places.iter().map(|&place| self.seen.pixels[place as usize][channel]).collect()
        };
        let drawn = surface.drawn.clone();
        let covered = Rc::new(CoveredPixels {
            by_terms: Run::new(Rc::clone(&self.plan), Rc::clone(&self.points), drawn, Rc::clone(&self.input_sets)),
            whole: OnceCell::new(),
            seen: std::array::from_fn(plane),
            lost: (0..self.test_scenes).map(lost).collect(),
            surface,
        });
        self.known.borrow_mut().insert(key, Rc::clone(&covered));
        Ok(covered)
    }
}

impl CoveredPixels {
    fn comparison(&self, predicted: &[Plane]) -> Comparison {
        let tally = |(span, lost): (&std::ops::Range<usize>, &usize)| {
            let mut tally = SceneDifference::default();
            for index in span.clone() {
                let channels = predicted.iter().zip(&self.seen);
                let difference = channels.map(|(p, s)| channel_difference(p[index], s[index])).fold(0.0, f32::max);
                tally.add(difference);
            }
            tally.add_lost(*lost);
            tally
        };
        self.surface.drawn.spans.iter().zip(&self.lost).map(tally).collect()
    }
}

/// Returns a channel of an input set, summed over all lights; there are `input_sets` sets for each light.
fn added(
    colours: &[Rc<Value>],
    set: usize,
    input_sets: usize,
    channel: usize,
    spans: &[std::ops::Range<usize>],
) -> Plane {
    let mut lights = colours.iter().skip(set).step_by(input_sets.max(1)).map(|colour| colour.plane(channel, spans));
    let mut sum = lights.next().unwrap_or_default();
    for light in lights {
        sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
    }
    sum
}

/// Returns the values of all uniforms of a model solution.
fn input_set(
    plan: &EvaluationPlan,
    testbench: &Testbench,
    inputs: &ModelInputs,
    change: impl Fn(&mut TestScene),
) -> InputSet {
    let declared: Vec<Declared> = plan
        .inputs
        .iter()
        .filter(|input| input.name != WRITTEN_EXPONENT)
        .map(|input| Declared::uniform(&input.name, &input.glsl_type))
        .collect();
    let roles: HashMap<String, _> =
        roles::bind(&declared, &model_names()).bound.into_iter().map(|b| (b.declared.name, b.role)).collect();
    let test_scenes: Vec<TestScene> = testbench
        .test_scenes()
        .iter()
        .cloned()
        .map(|mut test_scene| {
            change(&mut test_scene);
            test_scene
        })
        .collect();
    let value = |name: &str, glsl_type: &str| {
        let of = |test_scene: &TestScene| match roles.get(name) {
            Some(role) => numbers(*role, glsl_type, test_scene).unwrap_or_default(),
            None if name == WRITTEN_EXPONENT => vec![inputs.exponent],
            None => Vec::new(),
        };
        let numbers = test_scenes.iter().map(of);
        let padded =
            |numbers: Vec<f32>| -> [f32; 16] { std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0)) };
        match glsl_type {
            "mat4" => Value::Matrix(4, numbers.map(|n| glam::Mat4::from_cols_array(&padded(n))).collect()),
            _ => {
                let width = glsl_type.strip_prefix("vec").and_then(|digits| digits.parse().ok()).unwrap_or(1);
                let first = |n: Vec<f32>| -> [f32; 4] { std::array::from_fn(|i| padded(n.clone())[i]) };
                Value::Same(width, numbers.map(first).collect())
            }
        }
    };
    plan.inputs.iter().map(|input| Rc::new(value(&input.name, &input.glsl_type))).collect()
}

/// The uniform for the exponent that is a constant in the student's source.
const WRITTEN_EXPONENT: &str = "written_exponent";

#[cfg(test)]
mod tests {
    use super::super::compare::Comparison;
    use super::super::on_cpu::{ComparisonDetail, CpuComparer};
    use super::super::parameterisation::{Lights, Parameterisation};
    use super::super::predict::CompiledModel;
    use super::super::task::Task;
    use crate::roles::Bindings;
    use crate::rules::SourceConstants;
    use crate::testbench::Testbench;
    use gonio_gl::HeadlessContext;

    /// The share of pixels that may differ because of rounding: half of what a verdict allows.
    const MOST_BEYOND: f64 = 0.005;

    #[test]
    fn the_cpu_and_the_driver_agree_on_every_hypothesis() {
        let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
        let mut tried = 0;
        for exercise in ["ex05", "ex07"] {
            let task = Task::find(exercise).unwrap();
            let (test_scenes, [whole, _]) = task.test_scenes();
            let testbench = Testbench::new(context.gl(), test_scenes).unwrap();
            // Without inputs, every strength is fitted.
            let parameterisation =
                Parameterisation::new(task, &Bindings::default(), &Bindings::default(), &SourceConstants::default());
            for model in [Some(task.model), task.other.map(|(model, _)| model)].into_iter().flatten() {
                let compiled = CompiledModel::new(context.gl(), model);
                let inputs = compiled.inputs(&parameterisation, Lights::One);
                for hypothesis in compiled.hypotheses.singles.iter().step_by(3) {
                    let black = crate::testbench::Atlas { pixels: vec![[0.5, 0.25, 0.125, 1.0]; whole * 1024] };
                    let driver = compiled.predict(&testbench, &inputs, &black, hypothesis, whole).unwrap();
                    let comparers = CpuComparer::new(&testbench, &compiled, &inputs, &driver.atlas, whole).unwrap();
                    let (residual, _) = comparers.compare(hypothesis, ComparisonDetail::Full).unwrap();
                    let id = &compiled.hypotheses.mistakes[hypothesis.mistakes[0]].id;
                    let worst = residual.beyond.iter().copied().fold(0.0, f64::max);
                    assert!(residual.is_same() && worst <= MOST_BEYOND, "{exercise} {model:?} {id}: {residual:?}");
                    let plain = compiled.predict(&testbench, &inputs, &black, &Default::default(), whole).unwrap();
                    let shows = !Comparison::new(&plain.atlas, &driver.atlas, whole).is_same();
                    tried += usize::from(shows);
                }
            }
        }
        assert!(tried >= 40, "{tried}");
    }
}
